//! Does a rover come round a dune of one's own, along the contour?
//!
//! Any shape of ground is a `Terrain`: heights and normals under a footprint. A run takes it by its
//! `Ground`, and so do missions, limits and whatever else asks which way is uphill.
//!
//! ```sh
//! cargo run --release -p grouser --example own_ground
//! ```

use std::error::Error;

use grouser::document::{Overrides, Source, read_scenario};
use grouser::mission::{Heading, Leg, Manoeuvre, Mission, MissionReport, MissionRun};
use grouser::simulation::{Approach, Scenario};
use grouser::terrain::{Footprint, Ground, Patch, Terrain};
use grouser::units::Vec2;

/// A round dune whose height falls off as a bell.
struct Dune {
    /// [m]
    height: f64,
    /// Distance from its top at which it is steepest [m].
    spread: f64,
}

impl Dune {
    fn height_at(&self, place: Vec2) -> f64 {
        self.height * (-0.5 * place.norm_squared() / self.spread.powi(2)).exp()
    }
}

impl Terrain for Dune {
    fn patch(&self, at: Vec2, footprint: Footprint) -> Patch {
        footprint.fit(&footprint.points(at).map(|place| self.height_at(place)))
    }

    fn height_from(&self, origin: Vec2, at: Vec2) -> f64 {
        self.height_at(origin + at)
    }
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let report = drive(10.0)?;
    println!("  x_m    y_m  height_m  slip");
    for record in report.trajectory.records.iter().step_by(300) {
        let (place, wheels) = (record.place(), &record.wheels);
        let slips = wheels.iter().map(|wheel| wheel.reaction.slip.ratio);
        let slip = slips.sum::<f64>() / wheels.len() as f64;
        println!("{:5.2}  {:5.2}  {:8.3}  {slip:.3}", place.x, place.y, dune().height_at(place));
    }
    println!("{}", report.trajectory.outcome.name());
    Ok(())
}

fn dune() -> Dune {
    Dune { height: 1.0, spread: 3.0 }
}

/// A scenario on the south side of the dune, with the nose to the east.
pub(crate) fn scenario() -> Result<Scenario, Box<dyn Error>> {
    let mut scenario = read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
    scenario.ground = Ground::own(scenario.ground.soil, dune()).starting_at(Vec2::new(0.0, -3.0));
    scenario.numerics.approach = Approach::QuasiSteady;
    Ok(scenario)
}

/// A drive along the contour.
///
/// * `distance`: [m]
pub(crate) fn drive(distance: f64) -> Result<MissionReport, Box<dyn Error>> {
    let leg = Leg { heading: Heading::Contour, ..Leg::new(Manoeuvre::drive(distance)) };
    let scenario = scenario()?;
    let mission = Mission { scenario, legs: vec![leg], stops: Vec::new(), sensors: None };
    Ok(MissionRun::new(&mission)?.to_end()?)
}
