//! Does a rover hold the contour of a slope if it measures its yaw and steers by it?
//!
//! A rover that starts with the right heading offset slowly loses it: the wheels' torque moves load
//! to the rear wheels, and the nose turns downhill. A controller that reads the yaw ten times a
//! second, to a tenth of a degree, and turns the wheels of both sides at different speeds holds it
//! to a fifth of a degree.
//!
//! ```sh
//! cargo run --release -p grouser --example closed_loop
//! ```

use std::error::Error;

use grouser::document::{DocumentError, Kind, Overrides, Source, read_scenario};
use grouser::simulation::{Controller, Observation, Record, Run, RunError, Scenario};

/// What the yaw is measured in: a tenth of a degree [rad].
const READING: f64 = 0.1 * std::f64::consts::PI / 180.0;
/// How much faster the right rims turn than the left ones for a lack of yaw, over the rims' speed
/// [1/rad].
const GAIN: f64 = 10.0;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let scenario = scenario()?;
    let open = led_by(&scenario, &mut scenario.drive.clone())?;
    let closed = led_by(&scenario, &mut holding(&scenario))?;
    println!("time_s  yaw_open_deg  yaw_closed_deg  drift_open_mm  drift_closed_mm");
    for (open, closed) in open.iter().zip(&closed).step_by(100) {
        let yaws = [open, closed].map(|record| record.state.yaw.to_degrees());
        let drifts = [open, closed].map(drift_mm);
        print!("{:6.0}  {:12.2}  {:14.2}  ", open.time, yaws[0], yaws[1]);
        println!("{:13.0}  {:15.1}", drifts[0], drifts[1]);
    }
    Ok(())
}

/// A minute on a slope of 10°, from the heading offset that holds the contour.
pub(crate) fn scenario() -> Result<Scenario, DocumentError> {
    let source = Source::find(Kind::Scenario, "traverse-10-deg-torque")?;
    Ok(read_scenario(&source, &Overrides::parse(["scenario.duration_s=60"])?)?.value)
}

/// A controller that keeps the yaw of a scenario's start.
pub(crate) fn holding(scenario: &Scenario) -> impl Controller + use<> {
    let (wanted, speed) = (scenario.start.yaw, scenario.drive.nominal_rim_speed());
    move |seen: &Observation<'_>, rim_speeds: &mut [f64]| {
        let measured = (seen.rover().yaw / READING).round() * READING;
        let turn = GAIN * (wanted - measured);
        for (rim_speed, mount) in rim_speeds.iter_mut().zip(seen.scenario().rover.mounts()) {
            *rim_speed = speed * (1.0 - 0.5 * turn * mount.position.y.signum());
        }
    }
}

/// The scenario's records, ten for each second, with wheels that turn as a controller has it.
pub(crate) fn led_by(
    scenario: &Scenario,
    controller: &mut dyn Controller,
) -> Result<Vec<Record>, RunError> {
    let mut run = Run::with_controller(scenario, controller)?;
    run.advance(controller, scenario.duration)?;
    Ok(run.finish().records)
}

/// Way downhill [mm].
pub(crate) fn drift_mm(record: &Record) -> f64 {
    0.0 - 1e3 * record.state.position.y
}
