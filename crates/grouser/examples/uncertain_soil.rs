//! How uncertain is the heading offset that holds the contour, if the sand is known only roughly,
//! and any of several wheel–soil models may be right?
//!
//! 200 samples of sand and model are drawn, the sand from the deviations that its document states.
//! The band holds the middle 95 % of their heading offsets; the probability, with its 95 %
//! confidence interval, is the share of samples that have one.
//!
//! ```sh
//! cargo run --release -p grouser --example uncertain_soil
//! ```

use std::error::Error;

use grouser::document::{Overrides, Source, read_scenario};
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::heading::HeadingStudy;
use grouser::studies::heading_band::{HeadingBand, SlopeBand};
use grouser::units::deg;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    println!("slope_deg  low_deg  median_deg  high_deg  probability  from    to");
    for band in bands(200, &[5.0, 10.0, 15.0, 20.0])? {
        let slope_deg = band.slope.to_degrees();
        let (probability, interval) = (band.level.estimate(), band.level.interval());
        match band.yaw {
            Some(yaw) => {
                let [low, median, high] = [yaw.low, yaw.median, yaw.high].map(f64::to_degrees);
                print!("{slope_deg:9.1}  {low:7.1}  {median:10.1}  {high:8.1}  ");
            }
            None => print!("{slope_deg:9.1}  {:>7}  {:>10}  {:>8}  ", "-", "-", "-"),
        }
        println!("{probability:11.2}  {:4.2}  {:4.2}", interval.0, interval.1);
    }
    Ok(())
}

/// The default rover on some slopes [°] of a sand that is known only roughly.
pub(crate) fn bands(samples: u32, slopes_deg: &[f64]) -> Result<Vec<SlopeBand>, Box<dyn Error>> {
    /// Another seed gives other sands.
    const SEED: u64 = 1;
    let overrides = Overrides::parse(["scenario.soil=toyoura-uncertain"])?;
    let scenario = read_scenario(&Source::default_scenario(), &overrides)?;
    let samples = BandInputs::of_scenario(&scenario).samples(SEED, samples)?;
    let slopes: Vec<f64> = slopes_deg.iter().map(|slope| deg(*slope)).collect();
    let study = HeadingStudy::of(&scenario.value);
    let band = HeadingBand::of(&study, &samples, &slopes, &|| true)?;
    Ok(band.map_or_else(Vec::new, |band| band.slopes))
}
