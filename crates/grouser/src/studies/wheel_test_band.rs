//! A wheel test where soil and model are uncertain: sinkage, forces and torque of each setting,
//! with quantiles over samples.
//!
//! Bands are over all samples. Where the soil does not carry the wheel there is no reaction in
//! balance with the load, and [`SettledBand`] says what such a sample counts as: values on the safe
//! side of what a driver of the wheel may count on, not those of a measurement.

use super::ensemble::samples::{Sample, outputs_of_samples};
use super::ensemble::{Band, Probability};
use super::wheel_test::{WheelTest, WheelTestRow};
use crate::contact::{Contact, Model, SettleError};

/// One setting of the test stand, with quantiles over the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SettledBand {
    /// In how many of the samples the soil carries the wheel.
    pub carried: Probability,
    /// Sinkage [m]; down to the axle where the soil does not carry the wheel.
    pub sinkage: Option<Band>,
    /// Drawbar pull [N]; there the load's own weight backwards, the pull of a load that is dragged
    /// on ground of friction 1.
    pub drawbar_pull: Option<Band>,
    /// Side force [N]; none there.
    pub side_force: Option<Band>,
    /// Torque [N·m]; there what turns the wheel against friction 1 at its rim under the whole load,
    /// in the direction in which the rim slips.
    pub torque: Option<Band>,
}

/// Results of a sample that the bands need.
#[derive(Clone, Copy)]
struct Kept {
    is_carried: bool,
    sinkage: f64,
    drawbar_pull: f64,
    side_force: f64,
    torque: f64,
}

/// What a wheel that the soil does not carry counts as.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sunk {
    /// Down to the axle [m].
    pub sinkage: f64,
    /// What the model has at the axle's depth, or the load's own weight backwards if that is less
    /// [N].
    pub drawbar_pull: f64,
    /// None [N].
    pub side_force: f64,
    /// Torque that turns the rim against the whole load, or the model's at that depth if that is
    /// larger [N·m].
    pub torque: f64,
}

impl Sunk {
    /// * `load`: [N]
    #[must_use]
    pub fn of(model: &Model, contact: &Contact, load: f64) -> Self {
        let sinkage = contact.wheel.shearing_radius();
        let at_axle = model.as_ref().forces(contact, sinkage);
        let torque = (load * sinkage).max(at_axle.torque.abs()).copysign(contact.slip.ratio);
        Self { sinkage, drawbar_pull: at_axle.drawbar_pull.min(-load), side_force: 0.0, torque }
    }
}

impl WheelTest {
    /// The bands of each setting, in the order of [`run`](Self::run); `self.soil` and `self.model`
    /// are not used. `None` if `go_on` was false before the end. The samples are shared among
    /// threads and keep their order: the result is the same for any number of threads.
    ///
    /// How hard does the wheel of HAKUTO pull under 17 N at a slip ratio of 0.4, if any of three
    /// models may be right?
    ///
    /// ```
    /// use grouser::document::{self, Overrides, Source};
    /// use grouser::studies::ensemble::samples::BandInputs;
    /// use grouser::studies::wheel_test::WheelTest;
    ///
    /// // What the soil's document prints is taken as exact.
    /// let overrides = Overrides::parse(["soil.priors=none"])?;
    /// let scenario = document::read_scenario(&Source::default_scenario(), &overrides)?;
    /// let test = WheelTest {
    ///     wheel: scenario.value.rover.mounts()[0].unit.wheel,
    ///     soil: scenario.value.ground.soil,
    ///     gravity: scenario.value.gravity,
    ///     model: scenario.value.model.clone(),
    ///     loads: vec![17.0],
    ///     slip_angles: vec![0.0],
    ///     slip_ratios: vec![0.4],
    /// };
    /// let samples = BandInputs::of_scenario(&scenario).samples(1, 30)?;
    /// let bands = test.bands(&samples, &|| true).expect("not stopped");
    /// let pull = bands[0].drawbar_pull.expect("there are samples");
    /// assert_eq!(format!("{:.1} N", pull.low), "3.6 N");
    /// assert!(pull.high > 5.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// * `go_on`: asked before each sample, from any thread
    #[must_use]
    pub fn bands(
        &self,
        samples: &[Sample],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<SettledBand>> {
        let one = |sample: &Sample| {
            let test = Self { soil: sample.soil, model: sample.model.clone(), ..self.clone() };
            test.run().iter().map(|row| Kept::of(row, &test)).collect::<Vec<_>>()
        };
        let all = outputs_of_samples(samples, go_on, one)?;
        let settings = self.loads.len() * self.slip_angles.len() * self.slip_ratios.len();
        let band = |place| SettledBand::over(all.iter().filter_map(|rows| rows[place]));
        Some((0..settings).map(band).collect())
    }
}

impl SettledBand {
    fn over(samples: impl Iterator<Item = Kept>) -> Self {
        let all: Vec<Kept> = samples.collect();
        let band = |quantity: fn(&Kept) -> f64| Band::of(all.iter().map(quantity));
        let successes = all.iter().filter(|kept| kept.is_carried).count();
        Self {
            carried: Probability { successes, trials: all.len() },
            sinkage: band(|kept| kept.sinkage),
            drawbar_pull: band(|kept| kept.drawbar_pull),
            side_force: band(|kept| kept.side_force),
            torque: band(|kept| kept.torque),
        }
    }
}

impl Kept {
    /// What a row counts as; `None` for an invalid load.
    fn of(row: &WheelTestRow, test: &WheelTest) -> Option<Self> {
        match row.result {
            Ok(settled) => Some(Self {
                is_carried: true,
                sinkage: settled.sinkage,
                drawbar_pull: settled.forces.drawbar_pull,
                side_force: settled.forces.side_force,
                torque: settled.forces.torque,
            }),
            Err(SettleError::SunkToAxle { load, .. }) => {
                let contact = test.contact(row.slip_angle, row.slip_ratio);
                let sunk = Sunk::of(&test.model, &contact, load);
                Some(Self {
                    is_carried: false,
                    sinkage: sunk.sinkage,
                    drawbar_pull: sunk.drawbar_pull,
                    side_force: sunk.side_force,
                    torque: sunk.torque,
                })
            }
            Err(SettleError::BadLoad { .. }) => None,
        }
    }
}
