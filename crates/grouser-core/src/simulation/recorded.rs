//! The wheels of the last records of a dynamic motion, which tell where those of the next settle.
//!
//! Records fall between the steps of the integrator, and each settles all wheels. Along a smooth
//! motion the parabola through the last three records meets the next one, so that one look at every
//! wheel settles it; anywhere else the search goes on from there.

use std::collections::VecDeque;

use super::equations::Equations;
use super::point::Point;
use crate::lagrange;
use crate::stored::stored;
use crate::vehicle::settling::Known;
use crate::vehicle::{ReactionError, WheelReaction};

/// What is known of the wheels at the last records, the oldest first, and their times [s].
#[derive(Clone, Debug, Default)]
pub(super) struct RecordedWheels {
    last: VecDeque<(f64, Vec<Known>)>,
}

stored!(struct RecordedWheels { last });

/// Records that a parabola goes through.
const POINTS: usize = 3;

impl RecordedWheels {
    /// The wheels at a point of a run, which is a record.
    ///
    /// * `time`: after those of all records before [s]
    pub(super) fn next(
        &mut self,
        equations: &Equations<'_>,
        time: f64,
        point: &Point,
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        if equations.is_uneven() {
            return equations.reactions_of(point);
        }
        let (wheels, known) = equations.reactions_near(point, self.at(time))?;
        if self.last.len() == POINTS {
            self.last.pop_front();
        }
        self.last.push_back((time, known));
        Ok(wheels)
    }

    /// What the last records tell of the wheels at a time [s]; nothing where there is none.
    fn at(&self, time: f64) -> Vec<Known> {
        let Some((_, latest)) = self.last.back() else { return Vec::new() };
        let same = || self.last.iter().filter(|(_, wheels)| wheels.len() == latest.len());
        let times: Vec<f64> = same().map(|(time, _)| *time).collect();
        let weights: [f64; POINTS] = lagrange::weights(&times, time);
        let of = |wheel: usize| Known::blended(same().map(|(_, it)| &it[wheel]).zip(weights));
        (0..latest.len()).filter_map(of).collect()
    }
}
