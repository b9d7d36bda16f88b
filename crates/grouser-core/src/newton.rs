//! The zero of as many functions as there are unknowns, near a guess.

use nalgebra::allocator::Allocator;
use nalgebra::{DMatrix, DVector, DefaultAllocator, Dim, OMatrix, OVector, U1};

/// A zero, and what was learnt on the way to it.
pub struct Zero<T, D: Dim>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Where it is.
    pub at: OVector<f64, D>,
    /// What the functions come from there.
    pub value: T,
    /// The step that is left, as the inverse says, too short to look where it leads.
    pub left: OVector<f64, D>,
    /// The inverse Jacobian, as far as it was needed.
    pub inverse: OMatrix<f64, D, D>,
}

/// Steps after which a search is given up.
const MOST_STEPS: usize = 12;

/// The zero nearest to a guess: Newton's method with Broyden's updates of the inverse Jacobian, so
/// that a step costs one evaluation. None where a step is not shorter than the one before it, where
/// it is longer than `longest`, or where the functions have no value.
///
/// * `f`: their values, and what those come from
/// * `size`: of a step
/// * `is_zero`: gets the values and the step that they would lead to
pub fn zero_near<T, D: Dim>(
    f: impl Fn(&OVector<f64, D>) -> Option<(OVector<f64, D>, T)>,
    guess: &OVector<f64, D>,
    inverse: OMatrix<f64, D, D>,
    size: impl Fn(&OVector<f64, D>) -> f64,
    longest: f64,
    is_zero: impl Fn(&OVector<f64, D>, &OVector<f64, D>) -> bool,
) -> Option<Zero<T, D>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D> + Allocator<U1, D>,
{
    let start = f(guess)?;
    zero_from(|at, _| f(at), (guess.clone(), start), inverse, size, longest, is_zero)
}

/// The zero nearest to a guess, as [`zero_near`] finds it, from values that are known there.
///
/// * `f`: gets the size of the step that leads there, too: before the zero is near, values need be
///   no more exact than the next step is short
pub fn zero_from<T, D: Dim>(
    f: impl Fn(&OVector<f64, D>, f64) -> Option<(OVector<f64, D>, T)>,
    (mut at, (mut here, mut value)): (OVector<f64, D>, (OVector<f64, D>, T)),
    mut inverse: OMatrix<f64, D, D>,
    size: impl Fn(&OVector<f64, D>) -> f64,
    longest: f64,
    is_zero: impl Fn(&OVector<f64, D>, &OVector<f64, D>) -> bool,
) -> Option<Zero<T, D>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D> + Allocator<U1, D>,
{
    let mut step = -(&inverse * &here);
    for _ in 0..MOST_STEPS {
        if is_zero(&here, &step) {
            return Some(Zero { at, value, left: step, inverse });
        }
        let length = size(&step);
        if length.is_nan() || length > longest {
            return None;
        }
        at += &step;
        let (there, value_there) = f(&at, length)?;
        inverse = updated(&inverse, &step, &(&there - &here))?;
        (here, value) = (there, value_there);
        step = -(&inverse * &here);
        if size(&step) >= length {
            // As near as rounding lets it come, or going away.
            let is_found = is_zero(&here, &step);
            return is_found.then_some(Zero { at, value, left: step, inverse });
        }
    }
    None
}

/// The zero that damped steps lead to from a guess, however far they must go: Newton's steps with a
/// Jacobian by differences, each as long as the functions become smaller along it; where none is, a
/// share of the step that the functions themselves are. None where neither leads on.
///
/// * `f`: values [in units of the unknowns], and what those come from; none where there are none
/// * `scale`: size of the unknowns
/// * `agreed`: values that are zero, of any of them
pub fn damped_zero<T>(
    f: impl Fn(&DVector<f64>) -> Option<(DVector<f64>, T)>,
    guess: &DVector<f64>,
    scale: f64,
    agreed: f64,
) -> Option<(DVector<f64>, T)> {
    const MOST_STEPS: usize = 100;
    /// Shares of a step that are tried, the longest first [-]: halves, down to a thousandth.
    const SHARES: usize = 11;
    /// A step of this length promises so much less; a thousandth of it must come.
    const DESCENT: f64 = 1e-3;
    let mut at = guess.clone();
    let (mut here, mut value) = f(&at)?;
    for _ in 0..MOST_STEPS {
        if here.amax() <= agreed {
            return Some((at, value));
        }
        let newton = jacobian(&f, &at, &here, scale).and_then(|it| it.lu().solve(&-&here));
        let ways = newton.into_iter().chain([-&here, here.clone()]);
        let next = ways
            .flat_map(|way| {
                let shares = std::iter::successors(Some(1.0), |share: &f64| Some(0.5 * share));
                shares.take(SHARES).map(move |share| (way.clone(), share))
            })
            .find_map(|(way, share)| {
                let there = &at + share * way;
                let (values, value) = f(&there)?;
                let is_less = values.norm() <= (1.0 - DESCENT * share) * here.norm();
                is_less.then_some((there, values, value))
            });
        (at, here, value) = next?;
    }
    None
}

/// The Jacobian, by differences to the one side or, where the functions have no value there, to the
/// other.
fn jacobian<T>(
    f: &impl Fn(&DVector<f64>) -> Option<(DVector<f64>, T)>,
    at: &DVector<f64>,
    here: &DVector<f64>,
    scale: f64,
) -> Option<DMatrix<f64>> {
    /// Over the size of the unknowns [-]: rounding of 1e-13 is a millionth of it.
    const STEP: f64 = 1e-7;
    let mut jacobian = DMatrix::zeros(here.len(), at.len());
    for axis in 0..at.len() {
        let beside = |step: f64| {
            let mut there = at.clone();
            there[axis] += step;
            Some((f(&there)?.0 - here) / step)
        };
        let column = beside(STEP * scale).or_else(|| beside(-STEP * scale))?;
        jacobian.set_column(axis, &column);
    }
    Some(jacobian)
}

/// Broyden's update of an inverse Jacobian *B*, the one nearest to the old that explains a step:
///
/// ```text
/// B' = B + (Δx − B Δf) (Δxᵀ B) / (Δxᵀ B Δf)                            Broyden (1965)
/// ```
fn updated<D: Dim>(
    inverse: &OMatrix<f64, D, D>,
    step: &OVector<f64, D>,
    change: &OVector<f64, D>,
) -> Option<OMatrix<f64, D, D>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D> + Allocator<U1, D>,
{
    let predicted = inverse * change;
    let divisor = step.dot(&predicted);
    let is_sound = divisor != 0.0 && divisor.is_finite();
    is_sound.then(|| inverse + (step - predicted) * (step.transpose() * inverse) / divisor)
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};

    use super::*;

    fn curved(x: &Vector3<f64>) -> Vector3<f64> {
        Vector3::new(x.x + 0.1 * x.y * x.z - 1.0, x.y.sin() - 0.2, x.z.exp() - x.x)
    }

    #[test]
    fn a_nearby_zero_is_found_from_a_rough_jacobian() {
        let found = zero_near(
            |x| Some((curved(x), ())),
            &Vector3::new(0.9, 0.1, 0.1),
            Matrix3::identity(),
            Vector3::norm,
            1.0,
            |value, _| value.norm() < 1e-12,
        );
        let zero = found.expect("it is near").at;
        assert!(curved(&zero).norm() < 1e-12, "{zero}");
    }

    /// Turn by turn, x ← 1 − 3 max(x, 0) runs away from 1/4, and Newton's step from 5 crosses the
    /// corner.
    #[test]
    fn damped_steps_find_a_zero_behind_a_corner_that_turns_run_away_from() {
        let f = |x: &DVector<f64>| {
            let value = x[0] - (1.0 - 3.0 * x[0].max(0.0) + 0.5 * x[1].min(0.0));
            (x.amax() < 10.0).then(|| (DVector::from_vec(vec![value, x[1] + x[0].abs() - 2.0]), ()))
        };
        for guess in [[5.0, 1.0], [-3.0, -4.0], [0.0, 0.0]] {
            let guess = DVector::from_row_slice(&guess);
            let (zero, ()) = damped_zero(f, &guess, 1.0, 1e-12).expect("there is one");
            assert!((zero[0] - 0.25).abs() < 1e-9 && (zero[1] - 1.75).abs() < 1e-9, "{zero}");
        }
    }

    #[test]
    fn where_there_is_none_none_is_found() {
        let above = |x: &Vector3<f64>| Some((Vector3::new(1.0 + x.x * x.x, x.y, x.z), ()));
        let inverse = Matrix3::identity();
        let size = |step: &Vector3<f64>| step.norm();
        let found = zero_near(above, &Vector3::zeros(), inverse, size, 10.0, |value, _| {
            value.norm() < 1e-9
        });
        assert!(found.is_none());
    }
}
