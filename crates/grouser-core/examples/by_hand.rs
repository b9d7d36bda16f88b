//! How far does a rover drift down a slope that it crosses with its nose along the contour, and how
//! far with its nose a little uphill? With every value of soil, wheel and rover made by hand,
//! without any document.
//!
//! ```sh
//! cargo run --release -p grouser-core --example by_hand
//! ```

use std::error::Error;

use grouser_core::paper;
use grouser_core::simulation::{Run, Scenario, Start};
use grouser_core::units::deg;

fn main() -> Result<(), Box<dyn Error>> {
    println!("yaw_deg  x_m    y_m     outcome");
    for yaw_deg in [0.0, 2.5, 5.0, 7.5] {
        let traverse = paper::traverse()?;
        let start = Start { yaw: deg(yaw_deg), ..traverse.start };
        let trajectory = Run::new(&Scenario { start, ..traverse })?.to_end()?;
        let position = trajectory.last().state.position;
        let outcome = trajectory.outcome.name();
        println!("{yaw_deg:7.1}  {:.3}  {:+.3}  {outcome}", position.x, position.y);
    }
    Ok(())
}
