//! Sums of pairs of numbers, for a straight line through them.

use super::archive::{Archive, named};

/// Sums of pairs.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct StraightLine {
    pub(super) count: f64,
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) xx: f64,
    pub(super) xy: f64,
    pub(super) yy: f64,
}

impl StraightLine {
    pub(super) fn add(&mut self, x: f64, y: f64) {
        self.count += 1.0;
        self.x += x;
        self.y += y;
        self.xx += x * x;
        self.xy += x * y;
        self.yy += y * y;
    }

    pub(super) fn walk(&mut self, name: &str, archive: &mut dyn Archive) {
        let Self { count, x, y, xx, xy, yy } = self;
        archive.group(name);
        let sums = [("count", count), ("x", x), ("y", y), ("xx", xx), ("xy", xy), ("yy", yy)];
        named(archive, sums);
        archive.end();
    }

    /// Whether x moves by more than `least` on the root of the mean square.
    pub(super) fn moves(&self, least: f64) -> bool {
        self.xx / self.count - (self.x / self.count).powi(2) > least * least
    }

    /// The root of the mean square of x.
    pub(super) fn size_of_x(&self) -> f64 {
        (self.xx / self.count).sqrt()
    }

    /// What y rises by for each x, where it goes with x and moves by more than `least` on the root
    /// of the mean square.
    pub(super) fn rise(&self, least: f64) -> Option<f64> {
        /// Fewer points say little.
        const FEW: f64 = 5.0;
        /// Share of the squares that the line explains [-].
        const GOES_WITH: f64 = 0.6;
        let of =
            |sum: f64, one: f64, other: f64| sum / self.count - one * other / self.count.powi(2);
        let xx = of(self.xx, self.x, self.x);
        let (xy, yy) = (of(self.xy, self.x, self.y), of(self.yy, self.y, self.y));
        let is_seen = self.count >= FEW && xx > 0.0 && yy > least * least;
        (is_seen && xy * xy > GOES_WITH * xx * yy).then(|| xy / xx)
    }
}
