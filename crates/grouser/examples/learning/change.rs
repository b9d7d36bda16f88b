//! How soon another soil is flagged: one whose friction, or whose shear moduli, change half-way.

use grouser::soil::{Shear, ShearModulus, Soil};
use grouser::studies::ensemble::samples::Sample;
use grouser::studies::learn::{LearntSample, Warning, WarningKind};
use rayon::prelude::*;

use super::coverage::Trial;
use super::drive::{Drive, INSTRUMENTS, Leg, RIM_SPEED, learner};

/// How a soil changes.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Change {
    /// The friction angle, by a factor.
    Friction(f64),
    /// The shear modulus along the wheel, by a factor.
    ShearAlong(f64),
    /// The shear modulus across the wheel, by a factor.
    ShearAcross(f64),
}

impl Change {
    /// Changes that a rover feels.
    pub(crate) const ALL: [Self; 4] =
        [Self::Friction(0.7), Self::ShearAlong(3.0), Self::ShearAcross(3.0), Self::Friction(1.2)];

    /// What it is, for a table.
    pub(crate) fn name(self) -> String {
        let (what, factor) = match self {
            Self::Friction(factor) => ("friction angle", factor),
            Self::ShearAlong(factor) => ("shear modulus along the wheel", factor),
            Self::ShearAcross(factor) => ("shear modulus across the wheel", factor),
        };
        format!("{what} × {factor}")
    }

    /// The soil after it.
    fn of(self, sample: &Sample) -> Sample {
        let mut soil = sample.soil;
        match self {
            Self::Friction(factor) => soil.friction_angle *= factor,
            Self::ShearAlong(factor) => scale(&mut soil, [factor, 1.0]),
            Self::ShearAcross(factor) => scale(&mut soil, [1.0, factor]),
        }
        Sample { soil, ..sample.clone() }
    }
}

/// A soil with shear moduli that are larger by a factor.
pub(crate) fn scaled(soil: &Soil, factor: f64) -> Soil {
    let mut scaled = *soil;
    scale(&mut scaled, [factor; 2]);
    scaled
}

/// Scales the shear moduli along the wheel and across it.
fn scale(soil: &mut Soil, [along, across]: [f64; 2]) {
    if let Shear::Anisotropic { longitudinal, lateral } = &mut soil.shear {
        for (modulus, factor) in [(longitudinal, along), (lateral, across)] {
            if let ShearModulus::Linear { at_zero, per_radian } = modulus {
                *at_zero *= factor;
                *per_radian *= factor;
            }
        }
    }
}

/// Before and after the change: across the slope, so that all of the soil shows.
const BEFORE: Leg = (6.0, 40.0, 2.0);
const AFTER: Leg = (6.0, 40.0, 1.0);
/// By so much the slip ratio, or the way to the side over that of the rims, has to differ for a
/// change to matter [-].
const MATTERS: f64 = 0.1;

/// What became of one change.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flagged {
    /// The rims' way until it was flagged [m]; `None` where it was not.
    pub(crate) way: Option<f64>,
    /// Whether the motion became another.
    pub(crate) matters: bool,
    /// Whether something was flagged before it.
    pub(crate) early: bool,
}

/// What became of a change on some hidden soils; none of those on which the rover stands.
pub(crate) fn flagged(trial: &Trial<'_>, change: Change, repeats: u32) -> Vec<Flagged> {
    let truths = learner(trial.hidden).samples(trial.seed, repeats).expect("soils are drawn");
    let one = |(index, truth): (usize, &LearntSample)| {
        let truth = &truth.sample;
        let seed = 1000 * trial.seed + index as u64;
        let mut drive = trial.drive(truth, seed);
        drive.leg(BEFORE)?;
        let changed = drive.time();
        let before = velocity(&drive)?;
        drive.change(&change.of(truth));
        drive.leg(AFTER)?;
        let after = velocity(&drive)?;
        let differs = [0, 1].map(|axis| (after[axis] - before[axis]).abs() / RIM_SPEED);
        let flags = warnings(trial, &drive, seed).into_iter();
        let times: Vec<f64> =
            flags.filter(|it| it.kind == WarningKind::SoilChange).map(|it| it.time).collect();
        Some(Flagged {
            way: times.iter().find(|it| **it > changed).map(|it| (it - changed) * RIM_SPEED),
            matters: differs.into_iter().fold(0.0, f64::max) > MATTERS,
            early: times.iter().any(|it| *it <= changed),
        })
    };
    truths.par_iter().enumerate().filter_map(one).collect()
}

/// Velocity along the body and to its left over the last half metre of the rims' way [m/s].
fn velocity(drive: &Drive) -> Option<[f64; 2]> {
    const WAY: f64 = 0.5;
    let last = drive.records.iter().rev().take_while(|it| it.time > drive.time() - WAY / RIM_SPEED);
    let mut sums = [0.0; 2];
    for record in last {
        let [forward, leftward] = record.displacement;
        sums = [sums[0] + forward?, sums[1] + leftward?];
    }
    Some(sums.map(|way| way / (WAY / RIM_SPEED)))
}

/// What a learner warns of on a drive.
pub(crate) fn warnings(trial: &Trial<'_>, drive: &Drive, seed: u64) -> Vec<Warning> {
    let mut learner = learner(trial.prior);
    let seen = drive.seen(INSTRUMENTS, seed).into_iter();
    seen.filter_map(|record| learner.update(record)).flat_map(|it| it.warnings).collect()
}
