//! What driving tells of a soil: telemetry in, and the slip and heading of the next slopes out,
//! with bands that narrow.
//!
//! [FourWheel] ends with the wish to learn the relation of slope and attitude during the mission. A
//! [`Learner`] does so stretch by stretch of a decimetre or so:
//!
//! 1. the instruments' readings become means with their uncertainty ([`Stretch`]), outliers left
//!    out;
//! 2. a soil and a wheel–soil model say which forces and torques go with the motion that was seen,
//!    and what is left over of the balance of forces is the observation (`motion`);
//! 3. an iterated Kalman filter moves what is believed of the soil's numbers, and of what the model
//!    gets wrong in it, in coordinates that were standard normal beforehand (`filter`, `gaussian`,
//!    `unknowns`);
//! 4. several models do so side by side, and their shares follow how well each of them expected
//!    what came (`bank`).
//!
//! A Kalman filter and not particles: what is learnt lies in some ten to twenty coordinates, of
//! which a drive tells three or four, and the answer has to be the same whatever way the telemetry
//! is cut. What no reading bears upon stays what it was, so that without telemetry predictions are
//! those of the soil as it was, sample by sample.

pub mod advice;
mod archive;
mod bank;
mod by_record;
mod change;
mod contradiction;
mod currents;
mod drive;
mod filter;
mod fitted;
mod gaussian;
mod gross;
mod information;
mod middle;
mod motion;
mod noise;
mod one_sided;
mod passed;
mod settings;
mod state;
mod straight_line;
mod stretch;
mod trail;
mod unexplained;
mod unknowns;
mod warnings;
mod watch;

use std::collections::BTreeMap;

pub use self::archive::Archive;
use self::bank::{Bank, Taught};
use self::change::SoilChange;
pub use self::contradiction::Contradiction;
pub use self::currents::motor_log;
pub use self::drive::{Drive, RecordDigest};
pub use self::filter::Wandering;
use self::filter::{Filter, Taken, last_before};
pub(super) use self::gross::GrossFaults;
pub use self::gross::{GrossFault, Suspect};
pub use self::information::InformationByKind;
pub use self::motion::NotUsed;
use self::motion::{Expected, SeenMotion};
pub(super) use self::motion::{ODOMETRY, SHALLOWEST, steady_attitude, steered};
pub use self::noise::ModelNoise;
pub use self::one_sided::OneSided;
pub use self::settings::LearnSettings;
pub(super) use self::stretch::{GAP, Gatherer};
pub use self::stretch::{Reading, Stretch};
pub use self::unknowns::LearntSample;
pub use self::warnings::{Evidence, Warning, WarningKind};
use self::watch::{DEEP, Seen, Watch};
use super::ensemble::models::ModelSpread;
use super::ensemble::samples::{BandInputs, Sample};
use super::heading::HeadingStudy;
use super::heading_band::HeadingBand;
use crate::contact::Model;
use crate::error::ParameterError;
use crate::vehicle::Mount;
use grouser_io::LoadedScenario;
pub use grouser_io::measurements::telemetry::{TelemetryRecord, WheelTelemetry};
use grouser_io::statistics::NothingAccepted;

/// Learns from telemetry, record by record.
///
/// Stretches, and so all that is learnt, depend on the records alone: it does not matter how many
/// are given at once.
#[derive(Clone, Debug)]
pub struct Learner {
    study: HeadingStudy,
    settings: LearnSettings,
    gatherer: Gatherer,
    gross: GrossFaults,
    /// Warnings of stretches that taught nothing, for the next one that does.
    pending: Vec<Warning>,
    bank: Bank,
    change: SoilChange,
    watch: Watch,
    learnt: Learnt,
}

/// On less slope than this nothing is said of the slopes ahead [rad].
const LEVEL: f64 = 0.03;

/// What the keys of what a model gets wrong begin with.
const DISCREPANCY: &str = "discrepancy.";

/// How much was learnt from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Learnt {
    /// Records that were given.
    pub records: u64,
    /// Readings that were outliers in their stretch.
    pub outliers: u64,
    /// Stretches that taught something.
    pub stretches: u64,
    /// Those of them whose lessons were forgotten: a gross fault was in their readings.
    pub forgotten: u64,
    /// The rims' way over all stretches [m].
    pub way: f64,
    /// Stretches that taught nothing, by why.
    pub not_used: BTreeMap<NotUsed, u64>,
}

impl Learnt {
    /// Whether there is something that was learnt, and not forgotten.
    #[must_use]
    pub fn is_something(&self) -> bool {
        self.stretches > self.forgotten
    }
}

/// What one stretch taught.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lesson {
    /// The stretch.
    pub stretch: Stretch,
    /// The rims' way until its end, of all stretches that taught something [m].
    pub way: f64,
    /// Mean slip ratio of the wheels as it was seen [-]; nothing where no way was read.
    pub slip_ratio: Option<f64>,
    /// The same as it was expected before [-].
    pub expected_slip: f64,
    /// How much it narrowed what is believed of the soil [nat], under the model with the greatest
    /// share.
    pub information: f64,
    /// The same of each kind of observation.
    pub by_kind: InformationByKind,
    /// How far each number of the observation was from what was expected [standard deviations]: the
    /// velocity along the body, that to its left, the yaw rate, then torques and sinkages.
    pub scores: Vec<f64>,
    /// What to warn of.
    pub warnings: Vec<Warning>,
}

/// Why there is nothing to learn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("all numbers of the soil are taken as exact, so that no drive tells more of them")]
pub struct NothingToLearn;

impl Learner {
    /// A learner that knows what a scenario's soil document knows; the slope of the scenario stands
    /// in where telemetry has neither roll nor pitch.
    ///
    /// * `slope_is_known`: whether the scenario's slope is that of the drive
    ///
    /// # Errors
    /// [`NothingToLearn`] if the soil's numbers are all exact.
    pub fn new(
        scenario: &LoadedScenario,
        slope_is_known: bool,
        settings: LearnSettings,
    ) -> Result<Self, NothingToLearn> {
        let study = HeadingStudy::of(&scenario.value);
        let slope = scenario.value.ground.plane_slope().filter(|_| slope_is_known);
        let bank = Bank::new(&BandInputs::of_scenario(scenario)).ok_or(NothingToLearn)?;
        let gatherer = Gatherer::new(&study.rover, slope);
        let (gross, pending, change, watch, learnt) = Default::default();
        Ok(Self { study, settings, gatherer, gross, pending, bank, change, watch, learnt })
    }

    /// Takes a record; what was learnt, where it completes a stretch that teaches something.
    pub fn update(&mut self, record: TelemetryRecord) -> Option<Lesson> {
        self.learnt.records += 1;
        self.gross.read(&record);
        let stretch = self.gatherer.push(record)?;
        self.learn(stretch)
    }

    /// Takes the records that are too few for a stretch of their own, at the end of a drive.
    pub fn finish(&mut self) -> Option<Lesson> {
        let stretch = self.gatherer.take()?;
        self.learn(stretch)
    }

    fn learn(&mut self, mut stretch: Stretch) -> Option<Lesson> {
        self.learnt.outliers += stretch.outliers as u64;
        self.look_for_gross_faults(&mut stretch);
        let motion = SeenMotion::of(&stretch, &self.study.rover);
        let taught = motion.and_then(|motion| {
            let before = self.bank.best(&self.settings).clone();
            let taught = self.bank.learn(&self.study, &motion, &self.settings, stretch.way)?;
            Ok((before, motion, taught))
        });
        let (before, motion, taught) = match taught {
            Ok(taught) => taught,
            Err(why) => {
                *self.learnt.not_used.entry(why).or_default() += 1;
                return None;
            }
        };
        self.learnt.stretches += 1;
        self.learnt.way += stretch.way;
        let (expected_slip, of_soil) = self.look(&stretch, &motion, &before, &taught);
        let mut warnings = std::mem::take(&mut self.pending);
        warnings.extend(of_soil);
        let Taught { taken, information, .. } = taught;
        Some(Lesson {
            way: self.learnt.way,
            slip_ratio: motion.is_way_known().then(|| motion.slip_and_drift()[0]),
            expected_slip,
            information,
            by_kind: InformationByKind::of(&stretch, &taken.by_number),
            scores: taken.surprise.scores.as_slice().to_vec(),
            warnings,
            stretch,
        })
    }

    /// Warns of gross faults, forgets what they taught, and leaves out what they are of.
    fn look_for_gross_faults(&mut self, stretch: &mut Stretch) {
        let new = self.gross.look(stretch, &self.study.rover, self.study.gravity);
        if !new.is_empty() {
            self.bank.forget();
            self.change = SoilChange::default();
            self.watch.believed(None);
            self.watch.forget_sides();
            self.learnt.forgotten = self.learnt.stretches;
        }
        let warning = |fault| Warning {
            kind: WarningKind::LyingSensor,
            time: stretch.time[1],
            way: self.learnt.way + stretch.way,
            lead_time: None,
            lead_way: None,
            evidence: Evidence::Gross(fault),
        };
        self.pending.extend(new.into_iter().map(warning));
        self.gross.leave_out(stretch);
    }

    /// Gross faults of the telemetry: what they are of was left out.
    #[must_use]
    pub fn gross_faults(&self) -> &[GrossFault] {
        self.gross.found()
    }

    /// What was learnt that contradicts what was believed beforehand, under the model with the
    /// greatest share.
    #[must_use]
    pub fn contradictions(&self) -> Vec<Contradiction> {
        self.bank.best(&self.settings).contradictions()
    }

    /// What stays on one side of what is expected, whatever is learnt, and by how many standard
    /// deviations.
    pub fn on_one_side(&self) -> impl Iterator<Item = (OneSided, f64)> {
        self.watch.on_one_side()
    }

    /// Warnings that no lesson has.
    fn take_pending(&mut self) -> Vec<Warning> {
        std::mem::take(&mut self.pending)
    }

    /// The slip ratio that was expected, and what there is to warn of. Where the soil is another,
    /// what was learnt is forgotten.
    ///
    /// * `before`: what was believed before the stretch
    fn look(
        &mut self,
        stretch: &Stretch,
        motion: &SeenMotion,
        before: &Filter,
        taught: &Taught,
    ) -> (f64, Vec<Warning>) {
        let (study, patch) = (&self.study, self.settings.noise.way);
        let Taken { passed, push, surprise, .. } = &taught.taken;
        let filter = taught.filter as u64;
        let expected = before.expected(study, motion);
        let slip_and_drift = expected.as_ref().map(|it| motion.expected_slip_and_drift(it));
        let [expected_slip, expected_drift] = slip_and_drift.unwrap_or([1.0, 0.0]);
        let seen = motion.is_way_known().then(|| motion.slip_and_drift());
        let [slip_ratio, drift] = seen.unwrap_or([expected_slip, expected_drift]);
        let expected_torques: Vec<f64> = expected.iter().flat_map(Expected::torques).collect();
        let thrust_of = |(mount, torque): (&Mount, &f64)| torque / mount.shearing_radius();
        let thrust: f64 = study.rover.mounts().iter().zip(&expected_torques).map(thrust_of).sum();
        let seen = Seen {
            stretch,
            slip_ratio,
            drift,
            is_slip_known: motion.is_way_known(),
            expected_slip,
            expected_drift,
            expected_torques: &expected_torques,
            thrust: thrust.abs() / (study.rover.mass() * study.gravity),
            noise: self.settings.noise,
            filter,
            push: push.as_ref(),
            scores: surprise.scores.as_slice(),
            is_another_soil: self.change.look(filter, passed.clone(), patch),
            deep_slope: &|steeper| deep_slope(study, before, motion, steeper),
            holds_against: &|| before.holds_against(study, motion, DEEP),
        };
        let warnings = self.watch.look(&seen, &study.rover);
        if warnings.iter().any(|it| it.kind == WarningKind::SoilChange) {
            self.bank.forget();
        }
        let after = &self.bank.filter(taught.filter).belief;
        let learnt = push.as_ref().map(|push| push.learnt(&passed.belief.mean, &after.mean));
        self.watch.believed(learnt);
        (expected_slip, warnings)
    }

    /// How much was learnt from.
    #[must_use]
    pub fn learnt(&self) -> &Learnt {
        &self.learnt
    }

    /// The wheel–soil models with their shares.
    #[must_use]
    pub fn models(&self) -> ModelSpread {
        self.bank.models(&self.settings)
    }

    /// Standard deviation of each of the soil's uncertain keys over what it was beforehand [-],
    /// over some samples of the model with the greatest share: 1 where nothing was learnt. What
    /// models get wrong is left out.
    ///
    /// # Errors
    /// The same as [`samples`](Self::samples).
    pub fn narrowed(
        &self,
        seed: u64,
        count: u32,
    ) -> Result<BTreeMap<String, f64>, NothingAccepted> {
        let filter = self.bank.best(&self.settings);
        let (before, after): (Vec<_>, Vec<_>) = (0..count)
            .map(|index| {
                Ok((filter.values_before(seed, index.into())?, filter.sample(seed, index.into())?))
            })
            .collect::<Result<Vec<_>, NothingAccepted>>()?
            .into_iter()
            .unzip();
        let of_key = |(place, key): (usize, &str)| {
            let before = deviation(before.iter().map(|it: &Vec<f64>| it[place]));
            let after = deviation(after.iter().map(|it: &LearntSample| it.values[place]));
            (before > 0.0).then(|| (key.to_owned(), after / before))
        };
        let keys = self.keys().enumerate().filter(|(_, key)| !key.starts_with(DISCREPANCY));
        Ok(keys.filter_map(of_key).collect())
    }

    /// Samples of what is believed now.
    ///
    /// # Errors
    /// [`NothingAccepted`] if no soil can be drawn.
    pub fn samples(&self, seed: u64, count: u32) -> Result<Vec<LearntSample>, NothingAccepted> {
        (0..count).map(|index| self.bank.sample(&self.settings, seed, index.into())).collect()
    }

    /// Samples of what is believed now under the model with the greatest share, and that model.
    ///
    /// # Errors
    /// The same as [`samples`](Self::samples).
    pub fn samples_of_best(
        &self,
        seed: u64,
        count: u32,
    ) -> Result<(Model, Vec<LearntSample>), NothingAccepted> {
        let model = self.bank.best(&self.settings).unknowns.model().clone();
        let all = self.samples_of(&model, seed, count)?;
        Ok((model, all))
    }

    /// Samples of what is believed now under one of its models.
    ///
    /// # Errors
    /// The same as [`samples`](Self::samples).
    pub fn samples_of(
        &self,
        model: &Model,
        seed: u64,
        count: u32,
    ) -> Result<Vec<LearntSample>, NothingAccepted> {
        (0..count).map(|index| self.bank.sample_of(model, seed, index.into())).collect()
    }

    /// The keys of the soil that are uncertain, as samples have their values.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.bank.keys()
    }

    /// The heading that holds the contour, and the slip there, on some slopes [rad], over samples
    /// of what is believed now.
    ///
    /// * `go_on`: asked before each sample, from any thread; without it there is no result
    ///
    /// # Errors
    /// [`ParameterError`] for the first invalid soil.
    ///
    /// # Panics
    /// If there are no samples.
    pub fn predict(
        &self,
        samples: &[Sample],
        slopes: &[f64],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<HeadingBand>, ParameterError> {
        HeadingBand::of(&self.study, samples, slopes, go_on)
    }
}

/// The slope on which the wheels' slip is [`DEEP`] on a course [rad], by what was believed before;
/// nothing where it is steeper by more than an angle [rad], or than ten degrees.
fn deep_slope(
    study: &HeadingStudy,
    before: &Filter,
    motion: &SeenMotion,
    steeper: f64,
) -> Option<f64> {
    /// So much steeper is looked at [rad].
    const FARTHEST: f64 = 0.175;
    let is_deep = |slope: f64| {
        let slip = before.expected_slip(study, motion, slope);
        slip.is_none_or(|slip| slip >= DEEP)
    };
    let slope = motion.slope();
    if slope < LEVEL {
        return None;
    }
    last_before(is_deep, slope, slope + steeper.min(FARTHEST))
}

/// Standard deviation of some values.
fn deviation(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let count = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / count;
    (values.map(|it| (it - mean) * (it - mean)).sum::<f64>() / count).sqrt()
}
