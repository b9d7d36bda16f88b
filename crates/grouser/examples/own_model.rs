//! Which heading holds a rover on the contour, by a wheel–soil model of one's own?
//!
//! Any law from a contact to forces is a `WheelSoilModel`. Runs, missions, wheel tests, headings
//! and bands take it by their `Model`. This one is friction: the soil drives a wheel along the way
//! its rim slides, by a share of the load that grows with the sliding. For it the heading has a
//! closed form, whatever the rover:
//!
//! ```text
//! γ = asin(−k ln(1 − tan α/μ))
//! ```
//!
//! ```sh
//! cargo run --release -p grouser --example own_model
//! ```

use std::error::Error;

use grouser::contact::{Contact, Model, WheelForces, WheelSoilModel};
use grouser::document::{Overrides, Source, read_scenario};
use grouser::simulation::{Run, Scenario, Trajectory};
use grouser::studies::heading::HeadingStudy;
use grouser::units::{Vec2, deg};

/// Ground like springs, with friction that sliding mobilises.
pub(crate) struct Friction {
    /// Load for each metre of sinkage [N/m].
    pub(crate) stiffness: f64,
    /// The most friction, *μ* [-].
    pub(crate) coefficient: f64,
    /// Speed at which the rim slides over that at which it turns, *k* [-]: there friction is 63 %
    /// of the most.
    pub(crate) sliding: f64,
}

impl WheelSoilModel for Friction {
    fn forces(&self, contact: &Contact, sinkage: f64) -> WheelForces {
        let slip = &contact.slip;
        let slides = Vec2::new(slip.rim - slip.forward, -slip.lateral);
        let speed = slides.norm();
        // Its limit at rest is along the sliding, too: μ/k of the load for each unit of it.
        let share = if speed > 0.0 { -(-speed / self.sliding).exp_m1() / speed } else { 0.0 };
        let normal_force = self.stiffness * sinkage;
        let friction = self.coefficient * normal_force * share * slides;
        WheelForces {
            normal_force,
            drawbar_pull: friction.x,
            side_force: friction.y,
            torque: friction.x * contact.wheel.shearing_radius(),
            ..WheelForces::default()
        }
    }
}

pub(crate) const FRICTION: Friction = Friction { stiffness: 4e3, coefficient: 0.6, sliding: 0.3 };

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let scenario = scenario()?;
    let curve = HeadingStudy::of(&scenario).curve()?;
    println!("slope_deg  yaw_deg  closed_form_deg  drift_mm");
    for slope_deg in [5.0, 10.0, 15.0, 20.0] {
        let heading = curve.at(deg(slope_deg))?;
        let end = traverse(&scenario, slope_deg, heading.yaw)?.last().state.position;
        let by_hand = closed_form(deg(slope_deg)).to_degrees();
        print!("{slope_deg:9.1}  {:7.3}  {by_hand:15.3}  ", heading.yaw.to_degrees());
        println!("{:8.1}", 1e3 * end.y);
    }
    Ok(())
}

/// The heading that holds the contour, *γ* [rad].
///
/// * `slope`: *α* [rad]
pub(crate) fn closed_form(slope: f64) -> f64 {
    (-FRICTION.sliding * (-slope.tan() / FRICTION.coefficient).ln_1p()).asin()
}

/// The default scenario, with that model.
pub(crate) fn scenario() -> Result<Scenario, Box<dyn Error>> {
    let scenario = read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
    Ok(Scenario { model: Model::own(FRICTION), ..scenario })
}

/// A drive from rest at a yaw [rad].
pub(crate) fn traverse(
    scenario: &Scenario,
    slope_deg: f64,
    yaw: f64,
) -> Result<Trajectory, Box<dyn Error>> {
    let mut scenario = scenario.clone();
    scenario.ground = scenario.ground.with_slope(deg(slope_deg));
    scenario.start.yaw = yaw;
    Ok(Run::new(&scenario)?.to_end()?)
}
