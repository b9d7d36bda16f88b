//! Cubic convolution along one axis.

/// How many points an axis reads.
pub(super) const POINTS: usize = 4;

/// Weights of the points about a place, along one axis.
///
/// The kernel of [Keys1981], Eq. (15): of the cubic ones that go through their points it is the one
/// of third order. At an edge the source's conditions, Eqs. (19) and (25), give the point that is
/// missing there: a parabola through the three nearest. Its weight goes to those, so that no place
/// needs more than the grid has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stencil {
    /// The first of the points, which are neighbours.
    pub(super) first: usize,
    /// Their weights; zero for points that a short axis does not have.
    pub(super) weights: [f64; POINTS],
}

impl Stencil {
    /// For the height.
    ///
    /// * `place`: in cells from the first point; the nearest end stands for places beyond it
    /// * `count`: points along the axis, 2 or more
    pub(super) fn of_height(place: f64, count: usize) -> Self {
        let (cell, t) = cell(place, count);
        let (t2, t3) = (t * t, t * t * t);
        let weights = [
            0.5 * (2.0 * t2 - t3 - t),
            0.5 * (2.0 - 5.0 * t2 + 3.0 * t3),
            0.5 * (t + 4.0 * t2 - 3.0 * t3),
            0.5 * (t3 - t2),
        ];
        Self::new(cell, count, weights)
    }

    /// For the height's derivative along the axis; zero beyond the ends.
    ///
    /// * `spacing`: of the points [m]
    pub(super) fn of_slope(place: f64, count: usize, spacing: f64) -> Self {
        let (cell, t) = cell(place, count);
        if !(0.0..=(count - 1) as f64).contains(&place) {
            return Self::new(cell, count, [0.0; POINTS]);
        }
        let t2 = t * t;
        let weights = [
            0.5 * (4.0 * t - 3.0 * t2 - 1.0),
            0.5 * (9.0 * t2 - 10.0 * t),
            0.5 * (1.0 + 8.0 * t - 9.0 * t2),
            0.5 * (3.0 * t2 - 2.0 * t),
        ];
        Self::new(cell, count, weights.map(|weight| weight / spacing))
    }

    /// The stencil about a cell, with the weights of points beyond the ends given to those inside.
    fn new(cell: usize, count: usize, weights: [f64; POINTS]) -> Self {
        let [before, first, second, after] = weights;
        if cell > 0 && cell + 2 < count {
            return Self { first: cell - 1, weights };
        }
        let weights = match (cell, count) {
            // A straight line through two points: 2 z_0 − z_1 before it, 2 z_1 − z_0 after it.
            (_, 2) => [first + 2.0 * before - after, second + 2.0 * after - before, 0.0, 0.0],
            // 3 z_0 − 3 z_1 + z_2 before the first point.
            (0, _) => [first + 3.0 * before, second - 3.0 * before, after + before, 0.0],
            (_, 3) => [before + after, first - 3.0 * after, second + 3.0 * after, 0.0],
            _ => [0.0, before + after, first - 3.0 * after, second + 3.0 * after],
        };
        Self { first: if cell == 0 { 0 } else { count.max(POINTS) - POINTS }, weights }
    }

    /// The weighted sum of four values: the outer ones first, so that a mirrored one has the same
    /// bits.
    pub(super) fn sum(&self, values: [f64; POINTS]) -> f64 {
        let [a, b, c, d] = self.weights;
        let [z_a, z_b, z_c, z_d] = values;
        (a * z_a + d * z_d) + (b * z_b + c * z_c)
    }
}

/// The cell of a place, and how far in it the place is [-].
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a place between zero and the number of cells"
)]
fn cell(place: f64, count: usize) -> (usize, f64) {
    // A place that is no number is put at the start: heights stay finite.
    let inside = place.max(0.0).min((count - 1) as f64);
    let cell = (inside as usize).min(count - 2);
    (cell, inside - cell as f64)
}
