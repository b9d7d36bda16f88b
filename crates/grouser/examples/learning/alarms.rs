//! False alarms: how much is warned of on soil that stays the same.

use std::collections::BTreeMap;

use grouser::document::LoadedScenario;
use grouser::studies::ensemble::samples::Sample;
use grouser::studies::learn::{LearntSample, TelemetryRecord, Warning, WarningKind};
use grouser::studies::simulated_telemetry::SensorModels;
use grouser_io::statistics::random::{generator, uniform};
use rayon::prelude::*;

use super::coverage::Trial;
use super::drive::{Drive, INSTRUMENTS, RIM_SPEED, learner};

/// A ground and instruments on which there should be no alarms.
pub(crate) struct Course {
    /// What they are, for a table.
    pub(crate) name: &'static str,
    uneven: bool,
    instruments: SensorModels,
    /// Drives for each that is asked for: what is usual is to be known best.
    times: u32,
}

/// All courses.
pub(crate) fn courses() -> [Course; 6] {
    let mut noisy = INSTRUMENTS;
    for fault in [&mut noisy.attitude, &mut noisy.odometry, &mut noisy.torque] {
        fault.noise *= 2.0;
        fault.relative_noise *= 2.0;
    }
    let gaps = SensorModels { dropouts: 0.3, ..INSTRUMENTS };
    let seldom = SensorModels { rate: 1.0, ..INSTRUMENTS };
    let course = |name, uneven, instruments, times| Course { name, uneven, instruments, times };
    [
        course("even", false, INSTRUMENTS, 34),
        course("even, twice the noise", false, noisy, 1),
        course("even, 30 % gaps", false, gaps, 1),
        course("even, one reading a second", false, seldom, 1),
        course("uneven", true, INSTRUMENTS, 3),
        course("uneven, twice the noise", true, noisy, 1),
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
pub(crate) fn alarms(trial: &Trial<'_>, course: &Course, soils: u32) -> Alarms {
    let trial = Trial { uneven: course.uneven, ..*trial };
    let truths = learner(trial.hidden).samples(trial.seed, course.times * soils);
    let one = |(index, truth): (usize, &LearntSample)| {
        let seed = 1000 * trial.seed + index as u64;
        let drive = wandering(&trial, &truth.sample, seed);
        let mut found = Alarms { way: drive.time() * RIM_SPEED, ..Alarms::default() };
        for warning in warned(trial.prior, &drive.seen(course.instruments, seed)) {
            *found.counts.entry(warning.kind).or_default() += 1;
        }
        found
    };
    truths
        .expect("soils are drawn")
        .par_iter()
        .enumerate()
        .map(one)
        .reduce(Alarms::default, Alarms::and)
}

fn warned(prior: &LoadedScenario, seen: &[TelemetryRecord]) -> Vec<Warning> {
    let mut learner = learner(prior);
    let lessons = seen.iter().filter_map(|record| learner.update(record.clone()));
    lessons.flat_map(|it| it.warnings).collect()
}

/// A drive over slopes of 0 to 10° on any course that goes along or up them, from one to the next
/// over half a metre; of slopes up which wheels would spin it has less.
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
    /// These and others.
    fn and(mut self, other: Self) -> Self {
        self.way += other.way;
        for (kind, count) in other.counts {
            *self.counts.entry(kind).or_default() += count;
        }
        self
    }

    /// The counts of all kinds, as cells of a table, with the most that they are in 100 m.
    pub(crate) fn cells(&self) -> String {
        let cell = |kind| format!("{} (≤ {:.2})", self.count(kind), self.at_most(kind));
        WarningKind::ALL.map(cell).join(" | ")
    }

    fn count(&self, kind: WarningKind) -> u32 {
        self.counts.get(&kind).copied().unwrap_or_default()
    }

    /// The most alarms of a kind in 100 m that go with the count, by 95 %: the end of Garwood's
    /// interval (1936) for numbers of rare events.
    fn at_most(&self, kind: WarningKind) -> f64 {
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
