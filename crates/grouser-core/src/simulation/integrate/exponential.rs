//! One step of an exponential method: the motion as it is to first order is followed exactly,
//! however fast it dies out, and stages see only what that leaves out.
//!
//! ```text
//! y' = f(y) = f_0 + J (y − y_0) + g(y)         y_1 = y_0 + h φ_1(hJ) f_0 + h ∫ e^((1−θ) hJ) g dθ
//! ```
//!
//! Where wheels change their speeds by a little, slip settles on another steady state along an
//! exponential, and one step leads there, where a polynomial would need several within each of its
//! milliseconds. An evaluation more than the Jacobian and the two of its stages is not needed.
//!
//! Source: Hochbruck, Ostermann and Schweitzer (2009), SIAM J. Numer. Anal. 47, 786-803, the method
//! exprb43: of order 4, stiff problems included, with an embedded one of order 3.

use super::rosenbrock::Linear;
use super::step::{Numbers, Step};

/// A step of a span [s] from a point; none where a stage has no rates. It has no points between its
/// ends.
pub(super) fn exponential_step<const N: usize>(
    from: &Numbers<N>,
    linear: &Linear<N>,
    span: f64,
    rates_at: &impl Fn(&Numbers<N>) -> Option<Numbers<N>>,
) -> Option<Step<N>> {
    let functions = Functions::of(linear, span);
    // What the rates at a point leave out of the linear motion.
    let rest = |moved: &Numbers<N>| -> Option<Numbers<N>> {
        let there = rates_at(&std::array::from_fn(|i| from[i] + moved[i]))?;
        let along = linear.along(moved);
        Some(std::array::from_fn(|i| there[i] - linear.rates[i] - along[i]))
    };
    let half = functions.half(&linear.rates);
    let whole = functions.whole(1, &linear.rates);
    let two = rest(&half)?;
    let bend = functions.whole(1, &two);
    let three = rest(&std::array::from_fn(|i| whole[i] + bend[i]))?;
    let third = functions.whole(3, &std::array::from_fn(|i| 16.0 * two[i] - 2.0 * three[i]));
    let error = functions.whole(4, &std::array::from_fn(|i| 12.0 * three[i] - 48.0 * two[i]));
    let to: Numbers<N> = std::array::from_fn(|i| from[i] + whole[i] + third[i] + error[i]);
    let bends = [[0.0; N]; 3];
    to.iter().all(|part| part.is_finite()).then_some(Step { from: *from, to, bends, error })
}

/// A matrix of the coupled components, as many of its rows and columns as there are of them.
type Square<const N: usize> = [[f64; N]; N];

/// The highest of the functions.
const HIGHEST: usize = 5;

/// The functions φ_0 = eᶻ and φ_k(z) = (φ_{k−1}(z) − 1/(k−1)!)/z of a step's Jacobian, z = hJ.
///
/// The components that nothing depends on only gather what the others do:
///
/// ```text
/// J = (A 0; B 0)        φ_k(hJ) = (φ_k(hA) 0; h B φ_{k+1}(hA) 1/k!)
/// ```
struct Functions<'a, const N: usize> {
    linear: &'a Linear<N>,
    span: f64,
    /// φ_0 to φ_5 of hA.
    whole: [Square<N>; HIGHEST + 1],
    /// Those of hA/2.
    half: [Square<N>; HIGHEST + 1],
}

/// 1/k!
const INVERSE_FACTORIALS: [f64; HIGHEST + 1] = [1.0, 1.0, 0.5, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0];

impl<'a, const N: usize> Functions<'a, N> {
    /// By the series of φ_5 where the matrix is small, and doubling from there.
    fn of(linear: &'a Linear<N>, span: f64) -> Self {
        let size = linear.coupled().len();
        let mut matrix = [[0.0; N]; N];
        for (row, index) in linear.coupled().enumerate() {
            for (column, of_column) in linear.columns().iter().enumerate().take(size) {
                matrix[row][column] = span * of_column[index];
            }
        }
        let rows = matrix.iter().map(|row| row.iter().map(|part| part.abs()).sum::<f64>());
        let norm = rows.fold(0.0, f64::max);
        let mut doublings = 1;
        let mut scale = 0.5;
        while scale * norm > 1.0 && doublings < MOST_DOUBLINGS {
            (doublings, scale) = (doublings + 1, 0.5 * scale);
        }
        let small = matrix.map(|row| row.map(|part| scale * part));
        let mut half = series(&small, size);
        let mut whole = doubled(&half, size);
        for _ in 1..doublings {
            half = whole;
            whole = doubled(&half, size);
        }
        Self { linear, span, whole, half }
    }

    /// h φ_k(hJ) v
    fn whole(&self, k: usize, v: &Numbers<N>) -> Numbers<N> {
        self.applied(&self.whole, k, self.span, v)
    }

    /// h/2 φ_1(hJ/2) v
    fn half(&self, v: &Numbers<N>) -> Numbers<N> {
        self.applied(&self.half, 1, 0.5 * self.span, v)
    }

    fn applied(
        &self,
        functions: &[Square<N>; HIGHEST + 1],
        k: usize,
        span: f64,
        v: &Numbers<N>,
    ) -> Numbers<N> {
        let coupled = self.linear.coupled();
        let (mut own, mut gathered) = ([0.0; N], [0.0; N]);
        for (row, index) in coupled.clone().enumerate() {
            for (column, other) in coupled.clone().enumerate() {
                own[index] += functions[k][row][column] * v[other];
                gathered[index] += functions[k + 1][row][column] * v[other];
            }
        }
        let along = self.linear.along(&gathered);
        std::array::from_fn(|i| {
            let part = if coupled.contains(&i) {
                own[i]
            } else {
                INVERSE_FACTORIALS[k] * v[i] + span * along[i]
            };
            span * part
        })
    }
}

/// 2⁻ᵏ
const HALVES: [f64; HIGHEST + 1] = [1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125];

/// So many doublings reach a rate of 1e9 times the step.
const MOST_DOUBLINGS: usize = 31;

/// φ_0 to φ_5 of a matrix whose norm is at most 1, by the series of the last.
fn series<const N: usize>(matrix: &Square<N>, size: usize) -> [Square<N>; HIGHEST + 1] {
    /// Terms of the series: the next is below rounding.
    const TERMS: usize = 13;
    let mut all = [[[0.0; N]; N]; HIGHEST + 1];
    // Horner: each factor is 1/(5 + j) of the one before it.
    let mut sum = identity(size);
    for term in (1..=TERMS).rev() {
        let factor = 1.0 / (HIGHEST + term) as f64;
        sum = plus_identity(&product(matrix, &sum, size), factor, 1.0, size);
    }
    all[HIGHEST] = sum.map(|row| row.map(|part| INVERSE_FACTORIALS[HIGHEST] * part));
    for k in (0..HIGHEST).rev() {
        let times = product(matrix, &all[k + 1], size);
        all[k] = plus_identity(&times, 1.0, INVERSE_FACTORIALS[k], size);
    }
    all
}

/// φ_k(2z) = (φ_0(z) φ_k(z) + Σ_{j=1}^{k} φ_j(z)/(k−j)!)/2ᵏ
fn doubled<const N: usize>(
    all: &[Square<N>; HIGHEST + 1],
    size: usize,
) -> [Square<N>; HIGHEST + 1] {
    std::array::from_fn(|k| {
        let mut sum = product(&all[0], &all[k], size);
        for j in 1..=k {
            for (row, of_row) in sum.iter_mut().zip(&all[j]).take(size) {
                for (part, of_part) in row.iter_mut().zip(of_row).take(size) {
                    *part += INVERSE_FACTORIALS[k - j] * of_part;
                }
            }
        }
        sum.map(|row| row.map(|part| HALVES[k] * part))
    })
}

fn identity<const N: usize>(size: usize) -> Square<N> {
    let mut identity = [[0.0; N]; N];
    for (at, row) in identity.iter_mut().enumerate().take(size) {
        row[at] = 1.0;
    }
    identity
}

/// A matrix times a factor, and so much of the identity.
fn plus_identity<const N: usize>(
    matrix: &Square<N>,
    factor: f64,
    share: f64,
    size: usize,
) -> Square<N> {
    let mut sum = matrix.map(|row| row.map(|part| factor * part));
    for (at, row) in sum.iter_mut().enumerate().take(size) {
        row[at] += share;
    }
    sum
}

fn product<const N: usize>(one: &Square<N>, other: &Square<N>, size: usize) -> Square<N> {
    let mut product = [[0.0; N]; N];
    for (sum, row) in product.iter_mut().zip(one).take(size) {
        for (part, of_other) in row.iter().zip(other).take(size) {
            for (sum, factor) in sum.iter_mut().zip(of_other).take(size) {
                *sum += part * factor;
            }
        }
    }
    product
}

#[cfg(test)]
mod tests {
    use super::super::SIZE;
    use super::super::step::COUPLED;
    use super::*;

    /// y' = −λ y, and another number that gathers y: one step of any length ends at the closed
    /// form.
    #[test]
    fn a_linear_motion_is_followed_exactly_however_stiff() {
        let (fast, slow) = (COUPLED.start, SIZE - 1);
        for rate in [0.0, 1e-3, 1.0, 30.0, 1e3, 1e6] {
            let rates_at = |y: &Numbers<SIZE>| {
                let mut rates = [0.0; SIZE];
                (rates[fast], rates[slow]) = (1.0 - rate * y[fast], y[fast]);
                Some(rates)
            };
            let from = [0.0; SIZE];
            let rates = rates_at(&from).expect("it has rates");
            let linear = Linear::at(&from, rates, COUPLED, &rates_at).expect("it has rates");
            let span = 0.7;
            let step = exponential_step(&from, &linear, span, &rates_at).expect("it has rates");
            let z = rate * span;
            let grown = if z < 1e-6 { span } else { -(-z).exp_m1() / rate };
            let gathered = if z < 1e-2 {
                span * span * (0.5 - z / 6.0 + z * z / 24.0)
            } else {
                (span - grown) / rate
            };
            for (found, exact) in [(step.to[fast], grown), (step.to[slow], gathered)] {
                assert!((found / exact - 1.0).abs() < 1e-6, "{rate}: {found} and {exact}");
            }
        }
    }
}
