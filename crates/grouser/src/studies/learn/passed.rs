//! A stretch that was passed, as a line over what was believed before it.

use nalgebra::{DMatrix, DVector};

use super::archive::{Archive, counts, matrix, vector};
use super::gaussian::Gaussian;

/// A stretch as it was expected and seen.
#[derive(Clone, Debug)]
pub(super) struct Passed {
    /// The rims' way of it [m].
    pub(super) way: f64,
    /// What was believed before it.
    pub(super) belief: Gaussian,
    /// Which of the rover's readings each number is.
    pub(super) readings: Vec<u64>,
    /// What was seen, less what the line has where all unknowns are 0.
    pub(super) seen: DVector<f64>,
    /// How what is expected goes with the unknowns.
    pub(super) jacobian: DMatrix<f64>,
    /// A covariance of what no soil explains, the same over a patch of the ground.
    pub(super) of_patch: DMatrix<f64>,
    /// Variances of the stretch's own readings.
    pub(super) own: DVector<f64>,
}

impl Passed {
    /// With some of its readings alone, all of which it has.
    pub(super) fn with(&self, readings: &[u64]) -> Self {
        let place = |reading: &u64| self.readings.iter().position(|it| it == reading);
        let rows: Vec<usize> = readings.iter().filter_map(place).collect();
        Self {
            way: self.way,
            belief: self.belief.clone(),
            readings: readings.to_vec(),
            seen: self.seen.select_rows(&rows),
            jacobian: self.jacobian.select_rows(&rows),
            of_patch: self.of_patch.select_rows(&rows).select_columns(&rows),
            own: self.own.select_rows(&rows),
        }
    }

    /// One to read into.
    pub(super) fn blank() -> Self {
        Self {
            way: 0.0,
            belief: Gaussian::standard(0),
            readings: Vec::new(),
            seen: DVector::zeros(0),
            jacobian: DMatrix::zeros(0, 0),
            of_patch: DMatrix::zeros(0, 0),
            own: DVector::zeros(0),
        }
    }

    pub(super) fn walk(&mut self, archive: &mut dyn Archive) {
        let Self { way, belief, readings, seen, jacobian, of_patch, own } = self;
        archive.number("way", way);
        archive.group("belief");
        belief.walk(archive);
        archive.end();
        counts(archive, "readings", readings);
        vector(archive, "seen", seen);
        matrix(archive, "jacobian", jacobian);
        matrix(archive, "of_patch", of_patch);
        vector(archive, "own", own);
    }

    /// Whether its numbers are as many as its readings, and go with so many unknowns.
    pub(super) fn is_whole(&self, unknowns: usize) -> bool {
        let count = self.readings.len();
        self.belief.is_of(unknowns)
            && self.seen.len() == count
            && self.own.len() == count
            && self.jacobian.shape() == (count, unknowns)
            && self.of_patch.shape() == (count, count)
    }
}
