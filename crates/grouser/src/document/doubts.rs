//! What is valid in a document, and hardly meant: asked about by `check`.

use super::columns::flags::in_words;
use super::{
    DEFAULT_SOIL, DocumentError, Kind, Loaded, Overrides, Source, kind_of_source, read_mission,
    read_rover, read_scenario, read_soil,
};
use crate::contact::validity::{Finding, Flag, Situation};
use crate::contact::{Contact, Slip, settle};
use crate::simulation::Scenario;
use crate::studies::validity::RoverOnSlope;
use crate::units::Vec2;
use crate::vehicle::load::wheel_loads;
use crate::vehicle::{LoadSharing, WheelReaction};

/// What a document says that is hardly meant, a sentence each: Bekker's moduli that look like kN; a
/// rover that the soil does not carry, or its flags, as it stands on level ground; what is odd about a
/// map of heights.
///
/// A rover stands on the default soil.
///
/// # Errors
/// [`DocumentError`] for the first fault of the document.
pub fn doubts(source: &Source) -> Result<Vec<String>, DocumentError> {
    let none = Overrides::none();
    let base = || Ok(read_scenario(&Source::default_scenario(), &Overrides::none())?.value);
    Ok(match kind_of_source(source)? {
        Kind::Soil => {
            let soil = read_soil(source, &none)?;
            let mut scenario: Scenario = base()?;
            scenario.ground.soil = soil.value;
            let wheel = &scenario.rover.mounts()[0].unit.wheel;
            let situation = Situation {
                model: &soil.document.usual_model(""),
                wheel,
                soil: &soil.value,
                gravity: scenario.gravity,
                slope: 0.0,
                load: None,
                slip: None,
                settled: None,
            };
            // All others are of the wheel, which is not the document's.
            let of_soil = |finding: &Finding| finding.flag == Flag::ModulusDoubtful;
            let doubts = situation.findings().into_iter().filter(of_soil);
            doubts.map(|finding| modulus_question(&finding)).collect()
        }
        Kind::Rover => {
            let scenario = Scenario { rover: read_rover(source, &none)?.value, ..base()? };
            let on_soil = |doubt: String| format!("on the soil {DEFAULT_SOIL}, {doubt}");
            of_standing(&scenario).into_iter().map(on_soil).collect()
        }
        Kind::Scenario => {
            let Loaded { value, notes, .. } = read_scenario(source, &none)?;
            [notes, of_standing(&value)].concat()
        }
        Kind::Mission => {
            let Loaded { value, notes, .. } = read_mission(source, &none)?;
            [notes, of_standing(&value.scenario)].concat()
        }
        Kind::Wheel
        | Kind::Motor
        | Kind::DataSet
        | Kind::Campaign
        | Kind::Design
        | Kind::Prior
        | Kind::TelemetryMapping => Vec::new(),
    })
}

fn modulus_question(finding: &Finding) -> String {
    format!("{}: are the moduli in kN? then write k_c_kn and k_phi_kn", in_words(finding))
}

/// The rover of a scenario at rest on level ground.
fn of_standing(scenario: &Scenario) -> Vec<String> {
    let Scenario { rover, ground, gravity, model, .. } = scenario;
    let gravity = *gravity;
    let weight = rover.mass() * gravity;
    let Ok(loads) = wheel_loads(rover, LoadSharing::QuasiStatic, weight, Vec2::zeros()) else {
        return vec!["the rover tips over on level ground".to_owned()];
    };
    let slip = Slip::on_test_stand(0.0, 0.0);
    let (mut doubts, mut standing) = (Vec::new(), Vec::new());
    for (mount, load) in rover.mounts().iter().zip(loads) {
        let contact = Contact { wheel: mount.unit.wheel, soil: ground.soil, slip, gravity };
        match settle(model.as_ref(), &contact, load) {
            Ok(settled) => standing.push(WheelReaction { slip, load, settled }),
            Err(error) => doubts.push(format!("the wheel `{}` finds no hold: {error}", mount.name)),
        }
    }
    if standing.len() == rover.wheel_count() {
        let level = RoverOnSlope { slope: 0.0, ..RoverOnSlope::of(scenario) };
        let findings = level.findings(standing.iter());
        doubts.extend(findings.iter().map(|finding| match finding.flag {
            Flag::ModulusDoubtful => modulus_question(finding),
            _ => format!("at rest on level ground, {}", in_words(finding)),
        }));
    }
    doubts
}
