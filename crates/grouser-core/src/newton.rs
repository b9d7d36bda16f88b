//! The zero of as many functions as there are unknowns, near a guess.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix, OVector, U1};

/// A zero, and what was learnt on the way to it.
pub struct Zero<T, D: Dim>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Where it is.
    pub at: OVector<f64, D>,
    /// What the functions come from there.
    pub value: T,
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
    mut inverse: OMatrix<f64, D, D>,
    size: impl Fn(&OVector<f64, D>) -> f64,
    longest: f64,
    is_zero: impl Fn(&OVector<f64, D>, &OVector<f64, D>) -> bool,
) -> Option<Zero<T, D>>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D> + Allocator<U1, D>,
{
    let mut at = guess.clone();
    let (mut here, mut value) = f(&at)?;
    let mut step = -(&inverse * &here);
    for _ in 0..MOST_STEPS {
        if is_zero(&here, &step) {
            return Some(Zero { at, value, inverse });
        }
        let length = size(&step);
        if length.is_nan() || length > longest {
            return None;
        }
        at += &step;
        let (there, value_there) = f(&at)?;
        inverse = updated(&inverse, &step, &(&there - &here))?;
        (here, value) = (there, value_there);
        step = -(&inverse * &here);
        if size(&step) >= length {
            // As near as rounding lets it come, or going away.
            return is_zero(&here, &step).then_some(Zero { at, value, inverse });
        }
    }
    None
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
