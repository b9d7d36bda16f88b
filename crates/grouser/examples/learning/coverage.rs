//! How often 95 % bands hold what is true one slope ahead, and whether the true values are anywhere
//! in them alike.

use grouser::document::LoadedScenario;
use grouser::studies::ensemble::Band;
use grouser::studies::ensemble::samples::Sample;
use grouser::studies::heading::HeadingStudy;
use grouser::studies::learn::{Learner, LearntSample};
use grouser::units::deg;
use rayon::prelude::*;

use super::drive::{Drive, INSTRUMENTS, Leg, learner};

/// A level start, a slope along the contour and across it, and a steeper one.
pub(crate) const LEGS: [Leg; 4] =
    [(0.0, 0.0, 0.6), (5.0, 3.0, 1.0), (6.0, 40.0, 0.6), (8.0, 5.0, 1.0)];
/// The slope that comes next [°].
pub(crate) const NEXT: f64 = 12.0;
/// The keys that a drive tells most of.
pub(crate) const KEYS: [&str; 2] = ["shear.longitudinal_m", "shear.lateral_m"];

/// What is asked of many drives.
#[derive(Clone, Copy)]
pub(crate) struct Trial<'a> {
    /// What the learner knows beforehand.
    pub(crate) prior: &'a LoadedScenario,
    /// What hidden soils are drawn from.
    pub(crate) hidden: &'a LoadedScenario,
    /// Whether the ground is uneven.
    pub(crate) uneven: bool,
    /// Samples of a prediction.
    pub(crate) samples: u32,
    /// Hidden soils, instruments and samples are those of this seed.
    pub(crate) seed: u64,
}

/// What is predicted for the next slope before a drive and after it, and what is true there: of
/// slip and of yaw [rad].
#[derive(Clone, Debug)]
pub(crate) struct Answer {
    pub(crate) truth: [f64; 2],
    pub(crate) before: [Band; 2],
    pub(crate) after: [Band; 2],
    /// The shares of the samples below the truth, of slip, yaw and [`KEYS`].
    pub(crate) ranks: Vec<f64>,
}

/// What samples say of the next slope: slips, and yaws of those that hold the contour [rad].
pub(crate) struct Predicted {
    slips: Vec<f64>,
    pub(crate) yaws: Vec<f64>,
}

impl Predicted {
    pub(crate) fn of(study: &HeadingStudy, samples: &[LearntSample]) -> Self {
        let (mut slips, mut yaws) = (Vec::new(), Vec::new());
        for sample in samples {
            let study = study.of_sample(&sample.sample);
            let curve = study.curve().expect("a sample is a soil");
            if let Ok(there) = curve.at(deg(NEXT)) {
                slips.push(there.slip_ratio);
                yaws.push(there.yaw);
            }
        }
        Self { slips, yaws }
    }

    /// The bands, with a slip of 1 where no heading holds the contour.
    fn bands(&self, samples: usize) -> Option<[Band; 2]> {
        let stuck = std::iter::repeat_n(1.0, samples - self.slips.len());
        let slips = Band::of(self.slips.iter().copied().chain(stuck))?;
        Some([slips, Band::of(self.yaws.iter().copied())?])
    }
}

impl Trial<'_> {
    /// A drive on a hidden soil that has not begun.
    pub(crate) fn drive(&self, truth: &Sample, seed: u64) -> Drive {
        if self.uneven {
            Drive::uneven(self.prior, truth, seed)
        } else {
            Drive::new(self.prior, truth)
        }
    }

    /// The answers of some hidden soils; none of those on which the rover cannot drive there.
    pub(crate) fn answers(&self, repeats: u32) -> Vec<Answer> {
        let prior = learner(self.prior).samples(self.seed, self.samples).expect("soils are drawn");
        let study = HeadingStudy::of(&self.prior.value);
        let before =
            Predicted::of(&study, &prior).bands(prior.len()).expect("some hold the contour");
        let hidden = learner(self.hidden);
        let keys: Vec<String> = hidden.keys().map(str::to_owned).collect();
        let truths = hidden.samples(self.seed, repeats).expect("soils are drawn");
        let each = truths.par_iter().enumerate();
        each.filter_map(|(index, truth)| self.answer(before, (truth, &keys), index as u64))
            .collect()
    }

    fn answer(
        &self,
        before: [Band; 2],
        (truth, keys): (&LearntSample, &[String]),
        index: u64,
    ) -> Option<Answer> {
        let seed = 1000 * self.seed + index;
        let mut drive = self.drive(&truth.sample, seed);
        for leg in LEGS {
            drive.leg(leg)?;
        }
        let there = drive.study().curve().ok()?.at(deg(NEXT)).ok()?;
        let learner = taught(learner(self.prior), &drive, seed);
        let after = learner.samples(seed, self.samples).expect("soils are drawn");
        let truth_there = [there.slip_ratio, there.yaw];
        let found = Predicted::of(drive.study(), &after);
        let mut ranks =
            vec![below(&found.slips, truth_there[0]), below(&found.yaws, truth_there[1])];
        for key in KEYS {
            let of_truth = keys.iter().position(|it| it == key);
            let of_learner = learner.keys().position(|it| it == key);
            if let (Some(own), Some(place)) = (of_truth, of_learner) {
                let values: Vec<f64> = after.iter().map(|it| it.values[place]).collect();
                ranks.push(below(&values, truth.values[own]));
            }
        }
        Some(Answer { truth: truth_there, before, after: found.bands(after.len())?, ranks })
    }
}

/// A learner after a drive.
pub(crate) fn taught(mut learner: Learner, drive: &Drive, seed: u64) -> Learner {
    for record in drive.seen(INSTRUMENTS, seed) {
        learner.update(record);
    }
    learner.finish();
    learner
}

/// The share of some values that are below one [-].
fn below(values: &[f64], truth: f64) -> f64 {
    values.iter().filter(|it| **it < truth).count() as f64 / values.len() as f64
}

/// The share of the answers whose bands hold the truth, of slip and of yaw [-].
pub(crate) fn held(answers: &[Answer]) -> [f64; 2] {
    [0, 1].map(|place| {
        let holds = |it: &&Answer| {
            let band = it.after[place];
            (band.low..=band.high).contains(&it.truth[place])
        };
        answers.iter().filter(holds).count() as f64 / answers.len() as f64
    })
}

/// Mean error of the median yaw, before the drives and after them [rad].
pub(crate) fn yaw_errors(answers: &[Answer]) -> [f64; 2] {
    let mean = |of: &dyn Fn(&Answer) -> f64| {
        answers.iter().map(|it| (of(it) - it.truth[1]).abs()).sum::<f64>() / answers.len() as f64
    };
    [mean(&|it| it.before[1].median), mean(&|it| it.after[1].median)]
}

/// The probability that shares which are uniform lie as far from even as these: Kolmogorov's and
/// Smirnov's test, with the correction of Stephens (1970) for few of them.
pub(crate) fn uniformity(shares: impl Iterator<Item = f64>) -> f64 {
    const TERMS: i32 = 100;
    let mut shares: Vec<f64> = shares.collect();
    shares.sort_by(f64::total_cmp);
    let count = shares.len() as f64;
    let farthest = shares.iter().enumerate().map(|(place, share)| {
        let (below, until) = (place as f64 / count, (place + 1) as f64 / count);
        (share - below).max(until - share)
    });
    let root = count.sqrt();
    let scaled = (root + 0.12 + 0.11 / root) * farthest.fold(0.0, f64::max);
    let term = |k: i32| {
        let sign = if k % 2 == 1 { 1.0 } else { -1.0 };
        sign * (-2.0 * f64::from(k * k) * scaled * scaled).exp()
    };
    (2.0 * (1..=TERMS).map(term).sum::<f64>()).clamp(0.0, 1.0)
}
