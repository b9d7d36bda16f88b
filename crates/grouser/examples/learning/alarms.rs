//! False alarms: how much is warned of on soil that stays the same.

use std::collections::BTreeMap;

use grouser::document::LoadedScenario;
use grouser::studies::ensemble::samples::Sample;
use grouser::studies::learn::{TelemetryRecord, Warning, WarningKind};
use grouser::studies::simulated_telemetry::SensorModels;
use grouser_io::statistics::random::{generator, uniform};

use super::coverage::Trial;
use super::drive::{Drive, INSTRUMENTS, RIM_SPEED, learner};

/// Instruments, with what is the matter with them.
pub(crate) fn instruments() -> [(&'static str, SensorModels); 4] {
    let noisy = |mut models: SensorModels| {
        for fault in [&mut models.attitude, &mut models.odometry, &mut models.torque] {
            fault.noise *= 2.0;
            fault.relative_noise *= 2.0;
        }
        models
    };
    [
        ("usual, 5 % outliers", INSTRUMENTS),
        ("twice the noise, 5 % outliers", noisy(INSTRUMENTS)),
        ("30 % gaps, 5 % outliers", SensorModels { dropouts: 0.3, ..INSTRUMENTS }),
        ("one reading a second, 5 % outliers", SensorModels { rate: 1.0, ..INSTRUMENTS }),
    ]
}

/// The way that was driven, and the warnings of each kind.
#[derive(Clone, Debug, Default)]
pub(crate) struct Alarms {
    /// The wheels' way [m].
    pub(crate) way: f64,
    /// How often each kind was warned of.
    pub(crate) counts: BTreeMap<WarningKind, u32>,
}

/// Wheels that slip more than this may be called stuck [-].
const DEEP: f64 = 0.5;
/// The wheels' way of a drive [m].
const WAY: f64 = 30.0;

/// The alarms on some hidden soils.
pub(crate) fn alarms(trial: &Trial<'_>, models: SensorModels, soils: u32) -> Alarms {
    let truths = learner(trial.hidden).samples(trial.seed, soils).expect("soils are drawn");
    let mut all = Alarms::default();
    for (truth, index) in truths.iter().zip(0..) {
        let seed = 1000 * trial.seed + index;
        let drive = wandering(trial, &truth.sample, seed);
        all.way += drive.time() * RIM_SPEED;
        for warning in warned(trial.prior, &drive.seen(models, seed)) {
            *all.counts.entry(warning.kind).or_default() += 1;
        }
    }
    all
}

fn warned(prior: &LoadedScenario, seen: &[TelemetryRecord]) -> Vec<Warning> {
    let mut learner = learner(prior);
    let lessons = seen.iter().filter_map(|record| learner.update(record.clone()));
    lessons.flat_map(|it| it.warnings).collect()
}

/// A drive over slopes of 0 to 10° on any course that goes along or up them, from one to the next over half a metre; of
/// slopes up which wheels would spin it has less.
fn wandering(trial: &Trial<'_>, truth: &Sample, seed: u64) -> Drive {
    const STREAM: u64 = 0xF6 << 56;
    /// Steps from one slope to the next, and the way of each [m].
    const STEPS: u32 = 8;
    const RAMP: f64 = 0.06;
    let mut random = generator(seed, STREAM);
    let mut within = |low: f64, high: f64| low + (high - low) * uniform(&mut random);
    let mut drive = trial.drive(truth, seed);
    let mut here = [0.0, 0.0];
    while drive.time() * RIM_SPEED < WAY {
        let (mut there, way) = ([within(0.0, 10.0), within(-20.0, 70.0)], within(0.5, 3.0));
        while !is_passable(&drive, there) {
            there[0] *= 0.8;
        }
        for step in 1..=STEPS {
            let share = f64::from(step) / f64::from(STEPS);
            let at = [0, 1].map(|axis| here[axis] + share * (there[axis] - here[axis]));
            let way = if step == STEPS { way } else { RAMP };
            // Ground that leans may hold a rover up: the drive goes on with what follows.
            let _ = drive.leg((at[0], at[1], way));
        }
        here = there;
    }
    drive
}

/// Whether wheels do not spin on a slope at a yaw [°].
fn is_passable(drive: &Drive, [slope, yaw]: [f64; 2]) -> bool {
    let [slope, yaw] = [slope, yaw].map(f64::to_radians);
    let found = drive.study().steady_motion(slope, yaw, RIM_SPEED);
    found.is_ok_and(|it| it.slip_ratio() < DEEP)
}

impl Alarms {
    /// Adds others.
    pub(crate) fn add(&mut self, other: &Self) {
        self.way += other.way;
        for (kind, count) in &other.counts {
            *self.counts.entry(*kind).or_default() += count;
        }
    }

    /// The counts of all kinds, as cells of a table.
    pub(crate) fn cells(&self) -> String {
        WarningKind::ALL.map(|kind| self.count(kind).to_string()).join(" | ")
    }

    fn count(&self, kind: WarningKind) -> u32 {
        self.counts.get(&kind).copied().unwrap_or_default()
    }

    /// The most alarms of a kind in 100 m that go with the count, by 95 %: the end of Garwood's interval (1936) for
    /// numbers of rare events.
    pub(crate) fn at_most(&self, kind: WarningKind) -> f64 {
        let count = f64::from(self.count(kind));
        // The mean under which as few have a probability of 5 %: by bisection.
        let (mut low, mut high) = (count, 4.0 * count + 10.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if as_few(count, middle) > 0.05 { low = middle } else { high = middle }
        }
        100.0 * high / self.way
    }
}

/// The probability of a count or less of rare events where there are so many on the mean.
fn as_few(count: f64, mean: f64) -> f64 {
    let (mut term, mut sum, mut events) = ((-mean).exp(), (-mean).exp(), 0.0);
    while events < count {
        events += 1.0;
        term *= mean / events;
        sum += term;
    }
    sum
}
