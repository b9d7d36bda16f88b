//! Polynomials through some points, by weights of their values.

/// Weights of the values at some places, up to `N` of them, in the polynomial through them
/// (Lagrange); those beyond are 0. No two places are the same.
///
/// ```text
/// w_i = Π (x − x_j)/(x_i − x_j)        over all j ≠ i
/// ```
///
/// * `at`: where the polynomial is asked, *x*
pub(crate) fn weights<const N: usize>(places: &[f64], at: f64) -> [f64; N] {
    let mut weights = [0.0; N];
    for (index, (weight, place)) in weights.iter_mut().zip(places).enumerate() {
        let others = places.iter().enumerate().filter(|(other, _)| *other != index);
        *weight = others.map(|(_, other)| (at - other) / (place - other)).product();
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_found_from_three_of_its_points() {
        let parabola = |x: f64| 2.0 - 3.0 * x + 0.5 * x * x;
        let places = [-1.0, 0.5, 2.0];
        for at in [-3.0, 0.0, 0.5, 7.0] {
            let weights: [f64; 5] = weights(&places, at);
            let found: f64 =
                places.iter().zip(weights).map(|(x, weight)| weight * parabola(*x)).sum();
            assert!((found - parabola(at)).abs() < 1e-13, "{found} at {at}");
            assert_eq!(weights[3..], [0.0; 2]);
        }
    }
}
