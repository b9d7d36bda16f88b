//! How far ahead entrapment is called: up slopes that steepen, and on soil that grows weaker, until
//! the rover stands.

use grouser::studies::ensemble::samples::Sample;
use grouser::studies::learn::{LearntSample, WarningKind};
use rayon::prelude::*;

use super::change::warnings;
use super::coverage::Trial;
use super::drive::{Drive, RIM_SPEED, learner};

/// How a rover gets stuck.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Way {
    /// The slope steepens by this for each metre of the wheels' way [°].
    Steepening(f64),
    /// The tangent of the friction angle falls by this share for each metre over the ground [-], up
    /// a slope of 8°: the soil is weaker ahead.
    WeakerAhead(f64),
    /// The same for each metre of the wheels' way: they dig themselves in.
    DiggingIn(f64),
}

/// How far ahead it was called.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lead {
    /// Way over the ground [m].
    pub(crate) way: f64,
    /// Time [s].
    pub(crate) time: f64,
}

/// What became of one rover.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Case {
    /// How far ahead its end was called; `None` where it was not.
    pub(crate) lead: Option<Lead>,
    /// Its way over the ground from where the ground begins to change [m].
    pub(crate) left: f64,
}

/// Slower than this share of the rims' speed a rover is stuck [-].
const STUCK: f64 = 0.1;
/// What is one attitude and one soil [m of the wheels' way].
const STEP: f64 = 0.06;
/// So far a soil that grows weaker is as it was: there is something to learn [m].
const FIRST: f64 = 1.0;
/// Farther than this no rover goes [m of the wheels' way].
const FARTHEST: f64 = 40.0;

impl Way {
    /// What it is, for a table.
    pub(crate) fn name(self) -> String {
        match self {
            Self::Steepening(by) => format!("the slope steepens by {by}° per metre"),
            Self::WeakerAhead(by) => {
                format!("up 8°, the friction falls by {:.0} % per metre of ground", 100.0 * by)
            }
            Self::DiggingIn(by) => {
                format!(
                    "up 8°, the friction falls by {:.0} % per metre of the wheels' way",
                    100.0 * by
                )
            }
        }
    }

    /// How far the ground has changed after a way of the wheels, and one over the ground [m].
    fn changed(self, way: f64, over_ground: f64) -> f64 {
        match self {
            Self::Steepening(_) => way,
            Self::WeakerAhead(_) => (over_ground - FIRST).max(0.0),
            Self::DiggingIn(_) => (way - FIRST).max(0.0),
        }
    }

    /// Slope [°] and soil where the ground has changed so far [m].
    fn at(self, truth: &Sample, changed: f64) -> (f64, Sample) {
        match self {
            Self::Steepening(by) => (3.0 + by * changed, truth.clone()),
            Self::WeakerAhead(by) | Self::DiggingIn(by) => {
                let left = (1.0 - by * changed).max(0.05);
                let mut soil = truth.soil;
                soil.friction_angle = (soil.friction_angle.tan() * left).atan();
                (8.0, Sample { soil, ..truth.clone() })
            }
        }
    }
}

/// What became of some rovers on hidden soils; none of those that hold the rover for good, or not
/// at all.
pub(crate) fn cases(trial: &Trial<'_>, entrapment: Way, repeats: u32) -> Vec<Case> {
    let truths = learner(trial.hidden).samples(trial.seed, repeats).expect("soils are drawn");
    let one = |(index, truth): (usize, &LearntSample)| {
        let truth = &truth.sample;
        let seed = 1000 * trial.seed + index as u64;
        let mut drive = trial.drive(truth, seed);
        let (mut way, mut over_ground, mut begin) = (0.0, 0.0, 0.0);
        while !is_stuck(&drive) {
            let changed = entrapment.changed(way, over_ground);
            if changed == 0.0 {
                begin = over_ground;
            }
            let (slope, soil) = entrapment.at(truth, changed);
            drive.change(&soil);
            let before = drive.records.len();
            if drive.leg((slope, 90.0, STEP)).is_none() {
                break;
            }
            way += STEP;
            let moved = drive.records[before..].iter().filter_map(|it| it.displacement[0]);
            over_ground += moved.sum::<f64>();
            if way > FARTHEST {
                return None;
            }
        }
        // A way that is too short to learn from is no case.
        (way > 1.0).then(|| Case { lead: lead(trial, &drive, seed), left: over_ground - begin })
    };
    truths.par_iter().enumerate().filter_map(one).collect()
}

fn is_stuck(drive: &Drive) -> bool {
    let way = drive.records.last().and_then(|it| it.displacement[0]);
    way.is_some_and(|way| way < STUCK * RIM_SPEED * super::drive::STEP)
}

/// How far ahead the end of a drive was called.
fn lead(trial: &Trial<'_>, drive: &Drive, seed: u64) -> Option<Lead> {
    let all = warnings(trial, drive, seed);
    let called = all.iter().find(|it| it.kind == WarningKind::Entrapment)?;
    let left = drive.records.iter().filter(|it| it.time > called.time);
    let way = left.filter_map(|it| it.displacement[0]).sum();
    Some(Lead { way, time: drive.time() - called.time })
}
