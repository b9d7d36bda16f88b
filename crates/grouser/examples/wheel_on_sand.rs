//! How hard does a wheel pull on sand, how deep does it sink and which torque does it take, as its
//! slip grows? And at which slip ratio does it begin to pull at all?
//!
//! ```sh
//! cargo run --release -p grouser --example wheel_on_sand
//! ```

use std::error::Error;

use grouser::contact::Model;
use grouser::document::{DocumentError, Kind, Overrides, Source, read_soil, read_wheel};
use grouser::studies::wheel_test::{WheelTest, WheelTestRow};
use grouser::units::EARTH_GRAVITY;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let rows = rows()?;
    println!("slip_ratio  drawbar_pull_n  sinkage_mm  torque_nm");
    for row in &rows {
        let settled = row.result?;
        let (pull, torque) = (settled.forces.drawbar_pull, settled.forces.torque);
        let sinkage_mm = 1e3 * settled.sinkage;
        println!("{:10.2}  {pull:14.2}  {sinkage_mm:10.1}  {torque:9.3}", row.slip_ratio);
    }
    if let Some(slip_ratio) = first_pull(&rows) {
        println!("the wheel begins to pull at a slip ratio of {slip_ratio:.3}");
    }
    Ok(())
}

/// The wheel of HAKUTO on Toyoura sand under 17 N, at slip ratios from −0.2 to 0.9.
pub(crate) fn rows() -> Result<Vec<WheelTestRow>, DocumentError> {
    let none = Overrides::none();
    let test = WheelTest {
        wheel: read_wheel(&Source::find(Kind::Wheel, "hakuto")?, &none)?.value,
        soil: read_soil(&Source::find(Kind::Soil, "toyoura")?, &none)?.value,
        gravity: EARTH_GRAVITY,
        model: Model::Ishigami,
        loads: vec![17.0],
        slip_angles: vec![0.0],
        slip_ratios: (-2..=9).map(|tenths| f64::from(tenths) / 10.0).collect(),
    };
    Ok(test.run())
}

/// The slip ratio at which the drawbar pull passes zero, between the two rows where it does.
pub(crate) fn first_pull(rows: &[WheelTestRow]) -> Option<f64> {
    let pulls = rows.iter().filter_map(|row| {
        let settled = row.result.ok()?;
        Some((row.slip_ratio, settled.forces.drawbar_pull))
    });
    let pulls: Vec<(f64, f64)> = pulls.collect();
    let (low, high) = pulls
        .windows(2)
        .map(|pair| (pair[0], pair[1]))
        .find(|(low, high)| low.1 <= 0.0 && high.1 > 0.0)?;
    Some(low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1))
}
