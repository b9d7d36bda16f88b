//! Arcs and turns are complete when their yaw is, and say how far they fell short where it is not.

use grouser::document::{Overrides, Source, read_mission};
use grouser::mission::{
    FellShort, Leg, LegOutcome, LegReport, Limited, Manoeuvre, Mission, MissionReport, MissionRun,
    ShortBecause, Stop, Then,
};
use grouser::studies::mission::DrivenMission;
use grouser::units::deg;
use rayon::prelude::*;

use super::given::complete_traverse;

/// What a turn may lack without a word in its leg.
const TOLERANCE_DEG: f64 = 2.0;

fn mission_of(text: &str) -> Mission {
    let text = format!("schema = \"mission/1\"\n{text}");
    let read = read_mission(&Source::text("a mission", text), &Overrides::none());
    read.expect("a mission").value.mission()
}

fn driven(mission: &Mission) -> MissionReport {
    MissionRun::new(mission).expect("a mission").to_end().expect("it can be computed")
}

fn shortfall(leg: &LegReport) -> &FellShort {
    let LegOutcome::FellShort(short) = &leg.outcome else { panic!("{:?}", leg.outcome) };
    short
}

/// Yaw that a leg really turned [°].
fn turned(leg: &LegReport) -> f64 {
    leg.turned.expect("it turned").to_degrees()
}

/// By the way of its circle alone, this arc ended at 57.6°.
#[test]
fn a_tight_arc_of_90_degrees_turns_by_90_degrees() {
    let arc = "rover = \"hakuto\"\nsoil = \"toyoura\"\n\
        [[leg]]\narc = { radius_m = 0.5, angle_deg = 90.0 }\nspeed_m_s = 0.06\n";
    let report = driven(&mission_of(arc));
    let leg = &report.legs[0];
    assert_eq!(report.outcome(), "completed");
    assert!((turned(leg) - 90.0).abs() < 1e-4, "{}°", turned(leg));
    assert!((report.last().state.yaw.to_degrees() - 90.0).abs() < 1e-4);
    let radius = leg.radius().expect("it drove an arc");
    assert!(radius > 0.5 && radius < 1.0, "{radius} m");
}

/// Rover, soil, how it is led, and the slope [°].
const DRIVES: [(&str, &str); 4] = [
    ("hakuto", "sides"),
    ("mgru3", "sides"),
    ("mgru3", "ackermann"),
    ("hakuto-steered", "ackermann"),
];

/// Whatever the radius, the angle, the rover and the slope.
#[test]
fn an_arc_reaches_its_yaw_or_says_what_it_lacks() {
    let mut arcs = Vec::new();
    for (rover, steering) in DRIVES {
        for slope in [0.0, 8.0] {
            for radius in [0.3, 0.5, 1.0, 2.0, 3.0] {
                for angle in [30.0_f64, -30.0, 90.0, -90.0, 270.0, -270.0] {
                    // Longer ways say nothing more.
                    if radius * deg(angle.abs()) < 6.0 {
                        arcs.push((rover, steering, slope, radius, angle));
                    }
                }
            }
        }
    }
    let ends: Vec<(bool, String)> = arcs.par_iter().filter_map(end_of_arc).collect();
    for (_, end) in &ends {
        println!("{end}");
    }
    let short = ends.iter().filter(|(is_short, _)| *is_short).count();
    assert!(ends.len() > 120 && short > 0 && short < ends.len() / 2, "{short} of {}", ends.len());
}

/// Whether an arc fell short, checked, and a line that says so; nothing where the wheels cannot be
/// steered so far.
fn end_of_arc(
    (rover, steering, slope, radius, angle): &(&str, &str, f64, f64, f64),
) -> Option<(bool, String)> {
    let text = format!(
        "schema = \"mission/1\"\nrover = \"{rover}\"\nsoil = \"toyoura\"\nslope_deg = {slope}\n\
         [[leg]]\narc = {{ radius_m = {radius}, angle_deg = {angle} }}\nsteering = \"{steering}\"\n"
    );
    let read = read_mission(&Source::text("an arc", text.as_str()), &Overrides::none()).ok()?;
    let report = driven(&read.value.mission());
    let leg = &report.legs[0];
    let line = format!(
        "{rover}, {steering}, {slope}°: {radius} m, {angle}°: {} with {:.2}° on {:.3} m",
        leg.outcome.name(),
        turned(leg),
        leg.distance,
    );
    match &leg.outcome {
        LegOutcome::Completed => {
            assert!((turned(leg) - angle).abs() <= TOLERANCE_DEG, "{text}: {leg:?}");
            Some((false, line))
        }
        LegOutcome::FellShort(short) => {
            let lacking = short.shortfall().to_degrees();
            assert!(lacking > TOLERANCE_DEG, "{text}: {short:?}");
            assert!(((turned(leg) - angle).abs() - lacking).abs() < 1e-9, "{text}: {short:?}");
            Some((true, line))
        }
        other => panic!("{text}: {other:?}"),
    }
}

/// No rover of its size turns on 0.1 m by its sides' speeds.
#[test]
fn an_arc_falls_short_after_twice_its_way() {
    let arc = Manoeuvre::Arc { radius: 0.1, angle: deg(180.0), reverse: false };
    let legs = vec![Leg::new(arc), Leg::new(Manoeuvre::drive(0.2))];
    let scenario = complete_traverse(0.0, 0.0);
    let mission = Mission { scenario, legs, stops: Vec::new(), sensors: None };
    let report = driven(&mission);
    assert_eq!((report.outcome(), report.legs.len()), ("fell_short", 1));
    let (leg, way) = (&report.legs[0], 0.1 * deg(180.0));
    let short = shortfall(leg);
    assert_eq!(short.because, ShortBecause::TwiceTheWay);
    assert!(leg.distance >= 2.0 * way && leg.distance < 2.1 * way, "{} m", leg.distance);
    assert_eq!(short.asked, deg(180.0));

    // The rule for a leg that was stopped.
    let stop = Stop { then: Then::NextLeg, ..Stop::above(Limited::Shortfall, deg(2.0)) };
    let report = driven(&Mission { stops: vec![stop], ..mission.clone() });
    let ends: Vec<&str> = report.legs.iter().map(|leg| leg.outcome.name()).collect();
    assert_eq!(ends, ["fell_short", "completed"]);
    let stop = Stop { then: Then::BackOut(0.1), ..stop };
    let report = driven(&Mission { stops: vec![stop], ..mission.clone() });
    let back = report.legs[0].back_out.as_ref().expect("it backed out");
    assert!(back.outcome.is_completed() && (back.distance - 0.1).abs() < 1e-6);

    // A leg may allow more.
    let mut mission = mission;
    mission.legs[0].stops = vec![Stop::above(Limited::Shortfall, short.shortfall() + 1e-9)];
    let report = driven(&mission);
    assert_eq!(report.outcome(), "completed");
    assert!((turned(&report.legs[0]) - short.turned.to_degrees()).abs() < 1e-9);
}

/// The sentence has the turn, the shortfall and the reason; columns have turn and radius.
#[test]
fn a_table_of_legs_says_how_far_a_turn_fell_short() {
    let mission = mission_of(
        "rover = \"hakuto\"\nsoil = \"toyoura\"\n\
         [[leg]]\narc = { radius_m = 0.1, angle_deg = -180.0 }\n\
         stop = { shortfall_deg = { above = 5.0, then = \"next-leg\" } }\n\
         [[leg]]\narc = { radius_m = 1.0, angle_deg = -30.0 }\n\
         [[leg]]\nturn_deg = 20.0\n[[leg]]\ndrive_m = 0.1\n",
    );
    let driven = DrivenMission::drive("", &mission).expect("it can be computed");
    let table = driven.table();
    assert_eq!(table.texts("outcome")[0].as_deref(), Some("fell_short"));
    assert_eq!(table.texts("stopped_by")[0].as_deref(), Some("shortfall_deg"));
    let reason = table.texts("reason")[0].clone().expect("a reason");
    assert!(
        reason.contains("of -180.0°") && reason.contains("° short: it drove twice"),
        "{reason}"
    );
    let (turned, radius) = (table.numbers("yaw_turned_deg"), table.numbers("radius_m"));
    assert!((turned[1].expect("an arc") + 30.0).abs() < 1e-4);
    assert!((turned[2].expect("a turn") - 20.0).abs() < 1e-4);
    assert_eq!((turned[3], radius[2], radius[3]), (None, None, None));
    assert!(radius[1].is_some_and(|radius| radius > 0.9 && radius < 1.5), "{radius:?}");
}
