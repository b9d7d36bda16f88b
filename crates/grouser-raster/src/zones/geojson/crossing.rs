//! Rings whose edge crosses itself.

use grouser_core::units::Vec2;

/// More edges lie beside each other than are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tangled;

/// A place where the edge of a ring crosses itself, if it does.
///
/// Edges are looked at from the west to the east, each beside those that reach as far east as it
/// begins.
///
/// * `ring`: its corners, each once
///
/// # Errors
/// [`Tangled`] for an edge that runs over the same places again and again.
pub(super) fn crossing(ring: &[Vec2]) -> Result<Option<Vec2>, Tangled> {
    /// Pairs of edges that are compared, for each and of all: of a coast some dozens are for each.
    const PAIRS: [usize; 2] = [500, 20_000_000];
    let count = ring.len();
    let mut rest = PAIRS[0].saturating_mul(count).saturating_add(PAIRS[1]);
    let edge = |place: usize| (ring[place], ring[(place + 1) % count]);
    let west = |place: &usize| {
        let (one, other) = edge(*place);
        one.x.min(other.x)
    };
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|one, other| west(one).total_cmp(&west(other)));
    let mut near: Vec<usize> = Vec::new();
    for place in order {
        let begins = west(&place);
        near.retain(|other| {
            let (from, to) = edge(*other);
            from.x.max(to.x) >= begins
        });
        rest = rest.checked_sub(near.len()).ok_or(Tangled)?;
        for other in &near {
            let apart = place.abs_diff(*other);
            // Neighbours share a corner.
            if apart > 1
                && apart < count - 1
                && let Some(at) = common(edge(place), edge(*other))
            {
                return Ok(Some(at));
            }
        }
        near.push(place);
    }
    Ok(None)
}

/// Where two edges cross; one that only touches the other does not.
fn common((a, b): (Vec2, Vec2), (c, d): (Vec2, Vec2)) -> Option<Vec2> {
    let (along, across) = (b - a, d - c);
    let area = along.perp(&across);
    if area == 0.0 {
        return None;
    }
    let (t, u) = ((c - a).perp(&across) / area, (c - a).perp(&along) / area);
    let inside = |share: f64| share > 0.0 && share < 1.0;
    (inside(t) && inside(u)).then(|| a + t * along)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(corners: &[(f64, f64)]) -> Vec<Vec2> {
        corners.iter().map(|(x, y)| Vec2::new(*x, *y)).collect()
    }

    #[test]
    fn a_bow_tie_crosses_itself_and_a_star_with_dents_does_not() {
        let tie = ring(&[(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 4.0)]);
        assert_eq!(crossing(&tie), Ok(Some(Vec2::new(2.0, 2.0))));
        let star: Vec<Vec2> = (0..2000)
            .map(|place| {
                let (sin, cos) = (f64::from(place) * std::f64::consts::TAU / 2000.0).sin_cos();
                (if place % 2 == 0 { 5.0 } else { 3.0 }) * Vec2::new(cos, sin)
            })
            .collect();
        assert_eq!(crossing(&star), Ok(None));
        let mut crossed = star;
        crossed.swap(700, 704);
        assert!(crossing(&crossed).is_ok_and(|at| at.is_some()));
    }

    /// A ring that goes round and round over the same three corners.
    #[test]
    fn an_edge_that_runs_over_itself_ever_again_is_refused() {
        let corners = [(0.0, 0.0), (4.0, 0.0), (0.0, 4.0)];
        let ring = ring(&corners.repeat(7_000));
        assert_eq!(crossing(&ring), Err(Tangled));
    }
}
