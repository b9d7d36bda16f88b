//! A simulated wheel test: what a test stand might have read if a theory, a soil and a wheel were
//! the truth. For tutorials, and for tests of what is fitted to measurements.
//!
//! Every reading is the theory's value with normal noise added. Noise is drawn from (seed, row), so
//! that a row stays as it is when rows are added after it, on any number of threads.

use super::measurement::{PerQuantity, Quantity};
use super::random;
use super::wheel_test::WheelTest;
use crate::contact::SettleError;

/// A test plan that is run several times on a stand that does not read exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulatedTest {
    /// The settings, and what is taken for the truth.
    pub plan: WheelTest,
    /// How often each setting is run.
    pub trials: usize,
    /// Standard deviation of each reading, in SI units; not negative.
    pub noise: PerQuantity<f64>,
    /// What the noise is drawn from.
    pub seed: u64,
}

/// One run of one setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimulatedTrial {
    /// Load [N].
    pub load: f64,
    /// Slip angle [rad].
    pub slip_angle: f64,
    /// Slip ratio [-].
    pub slip_ratio: f64,
    /// Which run of the setting, from 1.
    pub trial: usize,
    /// What the stand read, in SI units, or why the wheel did not settle.
    pub readings: Result<PerQuantity<f64>, SettleError>,
}

impl SimulatedTest {
    /// Runs every setting, in the order of the plan, with its trials one after another.
    #[must_use]
    pub fn run(&self) -> Vec<SimulatedTrial> {
        let settings = self.plan.run();
        let trials =
            settings.iter().flat_map(|row| (1..=self.trials).map(move |trial| (row, trial)));
        let read = |(place, (row, trial)): (usize, (&super::wheel_test::WheelTestRow, usize))| {
            let readings = row.result.map(|settled| {
                let noise = self.noise_of(place as u64);
                PerQuantity::from_fn(|quantity| quantity.of(&settled) + noise[quantity])
            });
            let (load, slip_angle, slip_ratio) = (row.load, row.slip_angle, row.slip_ratio);
            SimulatedTrial { load, slip_angle, slip_ratio, trial, readings }
        };
        trials.enumerate().map(read).collect()
    }

    /// The noise of a row, by its place among all rows.
    fn noise_of(&self, row: u64) -> PerQuantity<f64> {
        let mut random = random::generator(self.seed, row);
        let mut noise = PerQuantity::default();
        for quantity in Quantity::ALL {
            noise[quantity] = self.noise[quantity] * random::standard_normal(&mut random);
        }
        noise
    }
}
