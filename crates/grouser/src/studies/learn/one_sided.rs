//! Readings that stay on one side of what is expected, however much is learnt: wheels that are named
//! otherwise, or an attitude that is another, which no soil explains.

use super::archive::Archive;
use super::stretch::Stretch;
use crate::vehicle::Rover;

/// Readings that stay on one side of what is expected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OneSided {
    /// Torques of the wheels in front against those in the rear.
    FrontTorques,
    /// Torques of the wheels on the left against those on the right.
    LeftTorques,
    /// Ways to the left.
    Leftward,
}

impl OneSided {
    pub(super) const ALL: [Self; 3] = [Self::FrontTorques, Self::LeftTorques, Self::Leftward];

    /// One word.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::FrontTorques => "front-torques",
            Self::LeftTorques => "left-torques",
            Self::Leftward => "leftward",
        }
    }
}

/// Means of scores over the way, by [`OneSided::ALL`].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct OneSides([Mean; 3]);

#[derive(Clone, Copy, Debug, Default)]
struct Mean {
    /// Over this way of the rims [m].
    way: f64,
    sum: f64,
}

impl OneSides {
    /// Takes a stretch.
    ///
    /// * `scores`: how far velocities, then torques that were read, are from what was expected
    ///   [standard deviations]
    /// * `all_wheels_pull`: a wheel that does not is one side of its own
    pub(super) fn add(
        &mut self,
        stretch: &Stretch,
        scores: &[f64],
        rover: &Rover,
        all_wheels_pull: bool,
    ) {
        /// Velocities come before torques.
        const MOTION: usize = 3;
        let [front, left, leftward] = &mut self.0;
        let read = (0..rover.wheel_count()).filter(|it| stretch.torques[*it].is_some());
        let torques: Vec<(usize, f64)> = read.zip(scores.iter().skip(MOTION).copied()).collect();
        let places = |place: fn(&crate::vehicle::Mount) -> f64| -> Vec<f64> {
            rover.mounts().iter().map(place).collect()
        };
        if all_wheels_pull {
            front.add(stretch.way, contrast(&torques, &places(|it| it.position.x)));
            left.add(stretch.way, contrast(&torques, &places(|it| it.position.y)));
        }
        let across = stretch.velocity[1].and_then(|_| scores.get(1).copied());
        leftward.add(stretch.way, across);
    }

    /// What is on one side, with its mean score.
    pub(super) fn found(&self) -> impl Iterator<Item = (OneSided, f64)> {
        /// Less of the way tells little [m].
        const WAY: f64 = 1.2;
        /// What is left over of a right soil is the same over so much of the way [m]; means over many
        /// such patches are smaller than this, and than that over their root [standard deviations].
        /// 90 drives of all rovers had 0.31 and 0.62 of torques, and 0.52 and 1.04 of ways to the
        /// side, at the most.
        const PATCH: f64 = 0.5;
        const MEAN: f64 = 0.5;
        const OVER_ROOT: [f64; 3] = [1.4, 1.4, 1.7];
        let means = OneSided::ALL.into_iter().zip(self.0).zip(OVER_ROOT);
        means.filter_map(|((what, Mean { way, sum }), most)| {
            let score = sum / way;
            let is_large = score.abs() > MEAN.max(most / (way / PATCH).sqrt());
            (way >= WAY && is_large).then_some((what, score))
        })
    }

    pub(super) fn walk(&mut self, archive: &mut dyn Archive) {
        for (what, mean) in OneSided::ALL.into_iter().zip(&mut self.0) {
            archive.group(what.name());
            archive.number("way", &mut mean.way);
            archive.number("sum", &mut mean.sum);
            archive.end();
        }
    }
}

impl Mean {
    fn add(&mut self, way: f64, score: Option<f64>) {
        /// On the first stretches of another soil scores are larger, and are no side: no more counts
        /// [standard deviations].
        const MOST: f64 = 2.0;
        if let Some(score) = score {
            self.way += way;
            self.sum += way * score.clamp(-MOST, MOST);
        }
    }
}

/// Half of what the scores of wheels at one end, or on one side, are above those at the other;
/// nothing where none of either was read.
///
/// * `places`: of all wheels, along the axis [m]
fn contrast(scores: &[(usize, f64)], places: &[f64]) -> Option<f64> {
    let (least, most) = places
        .iter()
        .fold((f64::MAX, f64::MIN), |(least, most), it| (least.min(*it), most.max(*it)));
    let (middle, quarter) = (0.5 * (least + most), 0.25 * (most - least));
    let mean = |is_there: &dyn Fn(f64) -> bool| {
        let there: Vec<f64> =
            scores.iter().filter(|it| is_there(places[it.0])).map(|it| it.1).collect();
        (!there.is_empty()).then(|| there.iter().sum::<f64>() / there.len() as f64)
    };
    let ahead = mean(&|place| place > middle + quarter)?;
    let behind = mean(&|place| place < middle - quarter)?;
    Some(0.5 * (ahead - behind))
}
