//! How far uphill must a rover turn its nose to cross a slope along the contour, and does it then
//! stay there?
//!
//! The heading offset is what balances the forces; a run of 20 s that starts with it, and another
//! one with the nose along the contour, show where the rover ends. The wheels' torque turns the
//! nose downhill meanwhile, so that a tenth of the drift is left: a driver corrects that on the
//! way.
//!
//! ```sh
//! cargo run --release -p grouser --example heading_on_a_slope
//! ```

use std::error::Error;

use grouser::document::{Overrides, Source, read_scenario};
use grouser::simulation::{Run, RunError, Scenario, Start};
use grouser::studies::heading::HeadingStudy;
use grouser::units::deg;

/// A slope, the heading offset that holds the contour on it, and where runs end.
pub(crate) struct Row {
    pub(crate) slope_deg: f64,
    pub(crate) heading_deg: f64,
    pub(crate) slip_ratio: f64,
    /// Uphill, with the nose along the contour [mm].
    pub(crate) straight_mm: f64,
    /// Uphill, with the heading offset [mm].
    pub(crate) offset_mm: f64,
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    println!("slope_deg  heading_deg  slip_ratio  y_straight_mm  y_offset_mm");
    for row in rows(&[5.0, 10.0, 15.0])? {
        let Row { slope_deg, heading_deg, slip_ratio, straight_mm, offset_mm } = row;
        print!("{slope_deg:9.1}  {heading_deg:11.2}  {slip_ratio:10.3}  ");
        println!("{straight_mm:13.0}  {offset_mm:11.1}");
    }
    Ok(())
}

/// The default rover and soil on some slopes [°].
pub(crate) fn rows(slopes_deg: &[f64]) -> Result<Vec<Row>, Box<dyn Error>> {
    let scenario = read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
    let curve = HeadingStudy::of(&scenario).curve()?;
    let row = |&slope_deg: &f64| {
        let heading = curve.at(deg(slope_deg))?;
        Ok(Row {
            slope_deg,
            heading_deg: heading.yaw.to_degrees(),
            slip_ratio: heading.slip_ratio,
            straight_mm: end_mm(&scenario, slope_deg, 0.0)?,
            offset_mm: end_mm(&scenario, slope_deg, heading.yaw)?,
        })
    };
    slopes_deg.iter().map(row).collect()
}

/// Where a run ends, uphill [mm].
fn end_mm(scenario: &Scenario, slope_deg: f64, yaw: f64) -> Result<f64, RunError> {
    let ground = scenario.ground.with_slope(deg(slope_deg));
    let start = Start { yaw, ..scenario.start };
    let run = Run::new(&Scenario { ground, start, ..scenario.clone() })?.to_end()?;
    Ok(1e3 * run.last().state.position.y)
}
