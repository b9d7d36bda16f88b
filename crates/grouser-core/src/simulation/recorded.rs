//! The wheels of the last records of a dynamic motion, which tell where those of the next settle.
//!
//! Records fall between the steps of the integrator, and each settles all wheels. Along a smooth
//! motion the parabola through the last three records meets the next one, so that one look at every
//! wheel settles it; anywhere else the search goes on from there.

use std::collections::VecDeque;

use super::equations::Equations;
use super::point::Point;
use super::times::is_same_time;
use crate::lagrange;
use crate::stored::stored;
use crate::vehicle::settling::Known;
use crate::vehicle::{ReactionError, WheelReaction};

/// The wheels at the last records of one motion, the oldest first.
#[derive(Clone, Debug, Default)]
pub(super) struct RecordedWheels {
    last: VecDeque<Recorded>,
}

stored!(struct RecordedWheels { last });

/// The wheels at a record.
#[derive(Clone, Debug)]
struct Recorded {
    /// [s]
    time: f64,
    wheels: Vec<WheelReaction>,
    /// What is known of them for a record nearby.
    known: Vec<Known>,
}

stored!(struct Recorded { time, wheels, known });

/// Records that a parabola goes through.
const POINTS: usize = 3;

impl RecordedWheels {
    /// Whether a rover with so many wheels can have it.
    pub(super) fn is_of(&self, count: usize) -> bool {
        let is_record = |it: &Recorded| {
            it.time.is_finite() && it.wheels.len() == count && [0, count].contains(&it.known.len())
        };
        self.last.len() <= POINTS && self.last.iter().all(is_record)
    }

    /// Forgets them: the motion goes on otherwise.
    pub(super) fn clear(&mut self) {
        self.last.clear();
    }

    /// The wheels of the last record, if that is of this time [s].
    pub(super) fn wheels_at(&self, time: f64) -> Option<&[WheelReaction]> {
        let last = self.last.back().filter(|last| is_same_time(last.time, time))?;
        Some(&last.wheels)
    }

    /// The wheels at a point of a run, which is a record.
    ///
    /// * `time`: after those of all records before [s]
    pub(super) fn next(
        &mut self,
        equations: &Equations<'_>,
        time: f64,
        point: &Point,
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        if self.last.is_empty() || equations.is_uneven() {
            self.clear();
            let wheels = equations.reactions_of(point)?;
            let known = equations.known_of(&wheels);
            self.last.push_back(Recorded { time, wheels: wheels.clone(), known });
            return Ok(wheels);
        }
        let Ok((wheels, known)) = equations.reactions_near(point, self.at(time)) else {
            self.clear();
            return equations.reactions_of(point);
        };
        if self.last.len() == POINTS {
            self.last.pop_front();
        }
        self.last.push_back(Recorded { time, wheels: wheels.clone(), known });
        Ok(wheels)
    }

    /// What the last records tell of the wheels at a time [s].
    fn at(&self, time: f64) -> Vec<Known> {
        let count = self.last.back().map_or(0, |last| last.known.len());
        let same = || self.last.iter().filter(|it| it.known.len() == count);
        let times: Vec<f64> = same().map(|it| it.time).collect();
        let weights: [f64; POINTS] = lagrange::weights(&times, time);
        let of = |wheel: usize| Known::blended(same().map(|it| &it.known[wheel]).zip(weights));
        (0..count).filter_map(of).collect()
    }
}
