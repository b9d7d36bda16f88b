//! The search's usual way: interpolation through all sinkages seen.

/// A point of a search: ln h and ln(F_z/W).
pub(super) type Point = (f64, f64);

/// |F_z − W| / W below which a wheel counts as settled [-].
pub(super) const LOAD_TOLERANCE: f64 = 1e-12;

/// No step goes further than this at once [ln h]: past the highest F_z the law has no meaning.
pub(super) const LONGEST_STEP: f64 = 1.0;

/// Points are used up to this many: a cubic.
const MOST_POINTS: usize = 4;

/// A search by interpolation, as far as it has come.
///
/// The sinkage is interpolated as a polynomial of the excess, which is nearly a straight line of
/// known slope, as long as the points close in on the root.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interpolation {
    /// ln r_s.
    axle: f64,
    /// With which F_z grows for shallow sinkage: n + ½.
    exponent: f64,
    points: [Point; MOST_POINTS],
    count: usize,
    steps: u32,
}

/// What an interpolation does next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Next {
    /// It asks for the excess at this ln h.
    Try(f64),
    /// The same, where it expects to end: all forces will do.
    TryLast(f64),
    /// It has ended at this ln h.
    Found(f64),
    /// F_z does not grow as a power of the sinkage does.
    Lost,
}

impl Interpolation {
    /// * `axle`: ln r_s
    pub(super) fn new(axle: f64, exponent: f64, start: Point) -> Self {
        Self { axle, exponent, points: [start; MOST_POINTS], count: 1, steps: 0 }
    }

    /// What it does now.
    pub(super) fn next(&self) -> Next {
        /// Sinkages that are tried: every usual law is solved by then.
        const MOST_STEPS: u32 = 8;
        /// The next point's error is below the product of the last points' (three, or the only
        /// two), times this.
        const CURVATURE: f64 = 0.05;
        let Self { axle, exponent, ref points, count, steps } = *self;
        let (here, excess) = points[count - 1];
        if excess.abs() <= LOAD_TOLERANCE {
            return Next::Found(here);
        }
        if steps == MOST_STEPS {
            return Next::Lost;
        }
        let next = if count == 1 {
            here - excess / exponent
        } else {
            let (before, excess_before) = points[count - 2];
            let slope = (excess - excess_before) / (here - before);
            if !grows_as_usual(slope, exponent) {
                return Next::Lost;
            }
            interpolate_at_zero(&points[..count])
        };
        if !is_usual_step(here, next, axle) {
            return Next::Lost;
        }
        let error: f64 = points[count.saturating_sub(3)..count].iter().map(|p| p.1.abs()).product();
        let last = count >= 2 && CURVATURE * error < LOAD_TOLERANCE;
        if last || count == MOST_POINTS { Next::TryLast(next) } else { Next::Try(next) }
    }

    /// How many excesses it has taken, that of its start included.
    pub(super) fn evaluations(&self) -> u32 {
        self.steps + 1
    }

    /// Takes the excess at the point that it asked for.
    pub(super) fn take(&mut self, point: Point) {
        self.steps += 1;
        if self.count == MOST_POINTS {
            self.points.rotate_left(1);
        } else {
            self.count += 1;
        }
        self.points[self.count - 1] = point;
    }
}

/// Whether F_z grows with the sinkage about as it does for a shallow wheel; NaN does not.
///
/// * `growth`: the power with which it grows [-], and `exponent`: that of a shallow wheel
pub(crate) fn grows_as_usual(growth: f64, exponent: f64) -> bool {
    /// F_z grows with a power of h that is this many times its shallow one at most, or at least.
    const STEEPEST: f64 = 4.0;
    growth * STEEPEST > exponent && growth < exponent * STEEPEST
}

/// Whether a step of a search ends above the axle and is not too long; none to NaN does.
///
/// * `here`, `next`, `axle`: ln h before and after the step, and ln r_s
pub(crate) fn is_usual_step(here: f64, next: f64, axle: f64) -> bool {
    next < axle && (next - here).abs() < LONGEST_STEP
}

/// The polynomial x(f) through some points, at f = 0 (Neville).
fn interpolate_at_zero(points: &[Point]) -> f64 {
    let mut x = [0.0; 4];
    for (x, point) in x.iter_mut().zip(points) {
        *x = point.0;
    }
    for order in 1..points.len() {
        for k in 0..points.len() - order {
            let (f_low, f_high) = (points[k].1, points[k + order].1);
            x[k] += f_low * (x[k + 1] - x[k]) / (f_low - f_high);
        }
    }
    x[0]
}
