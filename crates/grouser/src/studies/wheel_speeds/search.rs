//! The best point of a surface that equations define, within bounds: a search by directions, for
//! functions that are continuous and have kinks.
//!
//! From a point on the surface it looks along the value's own gradient and along further
//! directions, each laid into the surface's tangent, and comes back onto the surface by Gauss and
//! Newton's steps. What leaves the bounds comes back onto them too. A step that finds nothing
//! better is halved (Kolda, Lewis and Torczon 2003).

use nalgebra::{DMatrix, DVector};

/// A place.
pub(super) type Place = DVector<f64>;

/// What is sought.
pub(super) trait Problem {
    /// The equations' values, which are 0 on the surface, and the value that is to be large; none
    /// where there is nothing.
    fn evaluate(&self, place: &Place) -> Option<(DVector<f64>, f64)>;
    /// Numbers that are to be 0 or more.
    fn bounds(&self, place: &Place) -> DVector<f64>;
}

/// A point of the surface.
#[derive(Clone)]
pub(super) struct Found {
    pub(super) place: Place,
    pub(super) value: f64,
}

/// On the surface: the equations are met to this.
const MET: f64 = 1e-10;
/// Within the bounds: by this much they may be missed.
const WITHIN: f64 = 1e-10;
/// Steps for derivatives: forces are exact to 1e-11.
const STEP: f64 = 1e-7;
/// The first, the longest and the shortest step of the search.
const STEPS: [f64; 3] = [0.02, 0.1, 1e-5];
/// Looks after which a search ends as it is.
const MOST_LOOKS: u32 = 400;

/// Derivatives of the equations, and of the value, at a point.
struct Tangent {
    equations: DMatrix<f64>,
    value: DVector<f64>,
}

/// The point of the surface next to a guess, within the bounds.
pub(super) fn onto_surface(problem: &dyn Problem, guess: &Place) -> Option<Found> {
    let mut place = guess.clone();
    for _ in 0..12 {
        let tangent = tangent(problem, &place)?;
        if let Some(found) = back(problem, &place, &tangent.equations) {
            return Some(found);
        }
        let (left, _) = problem.evaluate(&place)?;
        place -= solve(&tangent.equations, &left)?;
    }
    None
}

/// The best point that is found from one of the surface.
///
/// * `enough`: a value at which the search may end
pub(super) fn best(problem: &dyn Problem, start: Found, enough: f64) -> Found {
    let [mut step, longest, shortest] = STEPS;
    let mut here = start;
    let mut last: Option<Place> = None;
    for _ in 0..MOST_LOOKS {
        if step < shortest || here.value >= enough {
            break;
        }
        let Some(tangent) = tangent(problem, &here.place) else { break };
        let ways = ways(&tangent, last.as_ref());
        let better = loop {
            let mut tries = ways
                .iter()
                .filter_map(|way| back(problem, &(&here.place + way * step), &tangent.equations));
            // A rise that rounding could make does not count.
            let better = tries.find(|there| there.value > here.value + 1e-3 * step * step);
            if better.is_some() || step < shortest {
                break better;
            }
            step *= 0.5;
        };
        let Some(there) = better else { break };
        last = Some(&there.place - &here.place);
        here = there;
        step = (2.0 * step).min(longest);
    }
    here
}

/// Unit vectors of the surface's tangent to look along, the most promising first.
fn ways(tangent: &Tangent, last: Option<&Place>) -> Vec<Place> {
    let size = tangent.value.len();
    let axes = (0..size).flat_map(|axis| {
        let mut way = Place::zeros(size);
        way[axis] = 1.0;
        [way.clone(), -way]
    });
    // Pairs of axes: along a kink that no axis follows.
    let pairs = (0..size).flat_map(|one| {
        (one + 1..size).flat_map(move |other| {
            [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(|signs| {
                let mut way = Place::zeros(size);
                (way[one], way[other]) = (signs[0], signs[1]);
                way
            })
        })
    });
    let first = [Some(&tangent.value), last].into_iter().flatten().cloned();
    let within = |way: Place| {
        let off = solve(&tangent.equations, &(&tangent.equations * &way))?;
        let way = way - off;
        // What is left of a direction across the surface is rounding.
        (way.norm() > 1e-6).then(|| way.normalize())
    };
    first.chain(axes).chain(pairs).filter_map(within).collect()
}

/// A place brought back onto the surface, and into the bounds if it lies beyond them.
fn back(problem: &dyn Problem, place: &Place, equations: &DMatrix<f64>) -> Option<Found> {
    let found = corrected(problem, place, equations, &[])?;
    let beyond = missed(&problem.bounds(&found.place));
    if beyond.is_empty() {
        return Some(found);
    }
    let found = corrected(problem, &found.place, equations, &beyond)?;
    missed(&problem.bounds(&found.place)).is_empty().then_some(found)
}

fn missed(bounds: &DVector<f64>) -> Vec<usize> {
    (0..bounds.len()).filter(|bound| bounds[*bound] < -WITHIN).collect()
}

/// Newton's steps, each the shortest, with derivatives from nearby.
///
/// * `met`: bounds that are to be met
fn corrected(
    problem: &dyn Problem,
    place: &Place,
    equations: &DMatrix<f64>,
    met: &[usize],
) -> Option<Found> {
    const MOST_STEPS: usize = 20;
    let mut place = place.clone();
    let of = |place: &Place| {
        let bounds = problem.bounds(place);
        DVector::from_iterator(met.len(), met.iter().map(|bound| bounds[*bound]))
    };
    let here = of(&place);
    let columns = (0..place.len()).map(|axis| {
        let mut beside = place.clone();
        beside[axis] += STEP;
        (of(&beside) - &here) / STEP
    });
    let columns: Vec<_> = columns.collect();
    let rows = equations.nrows();
    let all = DMatrix::from_fn(rows + met.len(), place.len(), |row, column| {
        if row < rows { equations[(row, column)] } else { columns[column][row - rows] }
    });
    let mut before = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let (left, value) = problem.evaluate(&place)?;
        let bounds = of(&place);
        let size = left.amax().max(if met.is_empty() { 0.0 } else { bounds.amax() });
        if size <= MET {
            return Some(Found { place, value });
        }
        if size > 0.7 * before {
            return None;
        }
        before = size;
        let left = DVector::from_iterator(all.nrows(), left.iter().chain(bounds.iter()).copied());
        place -= solve(&all, &left)?;
    }
    None
}

fn tangent(problem: &dyn Problem, place: &Place) -> Option<Tangent> {
    let (here, value_here) = problem.evaluate(place)?;
    let mut equations = DMatrix::zeros(here.len(), place.len());
    let mut value = DVector::zeros(place.len());
    for axis in 0..place.len() {
        let mut beside = place.clone();
        beside[axis] += STEP;
        let (there, value_there) = problem.evaluate(&beside)?;
        equations.set_column(axis, &((there - &here) / STEP));
        value[axis] = (value_there - value_here) / STEP;
    }
    Some(Tangent { equations, value })
}

/// The shortest solution of fewer equations than unknowns.
fn solve(equations: &DMatrix<f64>, right: &DVector<f64>) -> Option<Place> {
    let square = equations * equations.transpose();
    Some(equations.transpose() * square.cholesky()?.solve(right))
}
