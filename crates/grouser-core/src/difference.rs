//! Derivatives of results by the numbers that they depend on, by differences of two step lengths.
//!
//! A difference cannot tell a slope from a kink, and a step that is right for one function is wrong
//! for another. So there are always two steps. All variables together are moved by the shorter one,
//! along one direction, and what changes there is compared with the sum of the single slopes. Only
//! where the two part is each variable moved by the shorter step, too, and where that does not
//! agree either, or the slopes to both sides differ, the derivative is
//! [one-sided](Derivative::is_one_sided).

use crate::soil::Span;

/// A number that results are differentiated by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variable {
    /// Where it stands.
    pub value: f64,
    /// How far it has to go for results to change by as much as they are: steps are shares of it.
    pub scale: f64,
    /// What it may be; at an end differences are taken to the inner side.
    pub range: Span,
}

/// Two step lengths, and how far their slopes may part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepLengths {
    /// The longer step, over a variable's scale [-].
    pub long: f64,
    /// The shorter one [-].
    pub short: f64,
    /// How far slopes may part, over the result's size and its change over one scale [-].
    pub tolerance: f64,
}

impl StepLengths {
    /// Those for results that are exact but for rounding.
    pub const EXACT: Self = Self { long: 1e-5, short: 1e-6, tolerance: 1e-7 };
    /// Those for results that a search has settled, to a share of 1e-11 or so.
    pub const SETTLED: Self = Self { long: 1e-4, short: 1e-5, tolerance: 1e-5 };
}

/// The slope of a result along a variable, in units of both.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Derivative {
    /// The slope; where both sides differ, their mean.
    pub value: f64,
    /// The slopes below and above the variable's value; alike where the result is smooth.
    pub sides: [f64; 2],
}

impl Derivative {
    /// One that is the same on both sides.
    #[must_use]
    pub const fn smooth(value: f64) -> Self {
        Self { value, sides: [value, value] }
    }

    /// What a function of slopes gives: of their values, and of those on either side.
    ///
    /// * `of`: asked with the side for [`at`](Self::at)
    pub fn each(of: impl Fn(Option<usize>) -> f64) -> Self {
        Self { value: of(None), sides: [of(Some(0)), of(Some(1))] }
    }

    /// The slope on a side, 0 below and 1 above; without one its value.
    #[must_use]
    pub fn at(self, side: Option<usize>) -> f64 {
        side.map_or(self.value, |side| self.sides[side])
    }

    /// The same in other units.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self { value: self.value * factor, sides: self.sides.map(|it| it * factor) }
    }

    /// Whether the slopes below and above differ by more than rounding: the result has a kink or a
    /// jump there, or bends within a step.
    #[must_use]
    pub fn is_one_sided(self) -> bool {
        self.sides[0] != self.sides[1]
    }
}

/// The slopes of all results along all variables; none along a variable that can be moved to
/// neither side.
#[derive(Clone, Debug, PartialEq)]
pub struct Derivatives {
    /// A list for each variable, with an entry for each result.
    pub by_variable: Vec<Option<Vec<Derivative>>>,
    /// At how many points the results were computed.
    pub evaluations: usize,
}

/// Results at many points at once, in their order; none at a point where there are none.
pub type Evaluate<'a> = dyn FnMut(&[Vec<f64>]) -> Vec<Option<Vec<f64>>> + 'a;

/// The slopes of results along variables.
///
/// * `here`: the results where all variables stand
/// * `sizes`: what a change of each result is small against
///
/// ```
/// use grouser_core::difference::{StepLengths, Variable, derivatives};
/// use grouser_core::soil::Span;
///
/// let variable = |value| Variable { value, scale: 1.0, range: Span::ANY };
/// let f = |x: f64, y: f64| x * x * y + y.abs();
/// let mut evaluate = |points: &[Vec<f64>]| {
///     points.iter().map(|it| Some(vec![f(it[0], it[1])])).collect()
/// };
/// let found = derivatives(&[variable(3.0), variable(0.0)], &[0.0], &[1.0], StepLengths::EXACT, &mut evaluate);
/// let [by_x, by_y] = &found.by_variable[..] else { unreachable!() };
/// assert!(by_x.as_ref().unwrap()[0].value.abs() < 1e-9);
/// let by_y = by_y.as_ref().unwrap()[0];
/// assert!(by_y.is_one_sided() && (by_y.value - 9.0).abs() < 1e-9);
/// assert_eq!(by_y.sides.map(f64::round), [8.0, 10.0]);
/// ```
pub fn derivatives(
    variables: &[Variable],
    here: &[f64],
    sizes: &[f64],
    steps: StepLengths,
    evaluate: &mut Evaluate<'_>,
) -> Derivatives {
    let mut differences =
        DifferencesHere { variables, here, sizes, steps, evaluate, evaluations: 0 };
    let by_variable = differences.all();
    Derivatives { by_variable, evaluations: differences.evaluations }
}

/// On which side of a variable its differences are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum DifferencePoints {
    /// One step below, and one above.
    Central,
    /// One and two steps above.
    Above,
    /// One and two steps below.
    Below,
}

/// Differences along one variable.
#[derive(Clone, Debug)]
struct Difference {
    stencil: DifferencePoints,
    /// The step [unit of the variable].
    step: f64,
    /// The results at the stencil's two points.
    there: [Vec<f64>; 2],
}

impl DifferencePoints {
    /// The one that stays in a range.
    fn within(variable: &Variable, step: f64) -> Option<Self> {
        let Variable { value, range, .. } = variable;
        let has_room = |steps: f64| value - steps * step >= range.low;
        let has_room_above = |steps: f64| value + steps * step <= range.high;
        match (has_room(1.0), has_room_above(1.0)) {
            (true, true) => Some(Self::Central),
            (_, true) => has_room_above(2.0).then_some(Self::Above),
            _ => has_room(2.0).then_some(Self::Below),
        }
    }

    /// Where its points are, in steps.
    const fn places(self) -> [f64; 2] {
        match self {
            Self::Central => [-1.0, 1.0],
            Self::Above => [1.0, 2.0],
            Self::Below => [-1.0, -2.0],
        }
    }

    /// Sense of its direction.
    const fn sense(self) -> f64 {
        match self {
            Self::Central | Self::Above => 1.0,
            Self::Below => -1.0,
        }
    }
}

impl Difference {
    /// The difference of the next two of some results, where both are there.
    fn next(
        stencil: DifferencePoints,
        step: f64,
        results: &mut impl Iterator<Item = Option<Vec<f64>>>,
    ) -> Option<Self> {
        let [one, two] = [results.next().flatten(), results.next().flatten()];
        Some(Self { stencil, step, there: [one?, two?] })
    }

    /// The slope of a result that is `here` at the middle.
    fn slope(&self, result: usize, here: f64) -> f64 {
        let [one, two] = [self.there[0][result], self.there[1][result]];
        match self.stencil {
            DifferencePoints::Central => (two - one) / (2.0 * self.step),
            DifferencePoints::Above | DifferencePoints::Below => {
                self.stencil.sense() * (4.0 * (one - here) - (two - here)) / (2.0 * self.step)
            }
        }
    }

    /// By how much the slope grows from one step to the next.
    fn bend(&self, result: usize, here: f64) -> f64 {
        let [one, two] = [self.there[0][result], self.there[1][result]];
        let sense = self.stencil.sense();
        match self.stencil {
            DifferencePoints::Central => ((two - here) + (one - here)) / self.step,
            DifferencePoints::Above | DifferencePoints::Below => {
                sense * ((two - one) - (one - here)) / self.step
            }
        }
    }
}

struct DifferencesHere<'a, 'e> {
    variables: &'a [Variable],
    here: &'a [f64],
    sizes: &'a [f64],
    steps: StepLengths,
    evaluate: &'a mut Evaluate<'e>,
    evaluations: usize,
}

/// A bend beyond this share of a result's size, over a long step, may be a kink [-].
const SUSPICIOUS: f64 = 1e-3;

impl DifferencesHere<'_, '_> {
    fn all(&mut self) -> Vec<Option<Vec<Derivative>>> {
        let stencils: Vec<Option<DifferencePoints>> = self
            .variables
            .iter()
            .map(|it| DifferencePoints::within(it, self.steps.long * it.scale))
            .collect();
        let (found, along) = self.long_and_along(&stencils);
        let found = self.on_other_sides(found);
        let is_straight = self.is_straight(&found, along.as_ref());
        let is_open = |difference: &Option<Difference>, place: usize| {
            difference.as_ref().is_some_and(|it| !is_straight || self.bends(place, it))
        };
        let open: Vec<bool> =
            found.iter().enumerate().map(|(place, it)| is_open(it, place)).collect();
        let short = self.short(&found, &open);
        let pairs = found.into_iter().zip(short).enumerate();
        let slopes = pairs.map(|(place, (long, short))| {
            let long = long?;
            let results = 0..self.here.len();
            Some(results.map(|it| self.slope(place, it, &long, short.as_ref())).collect())
        });
        slopes.collect()
    }

    /// Differences by the long step along each variable, and by the short one along all at once.
    fn long_and_along(
        &mut self,
        stencils: &[Option<DifferencePoints>],
    ) -> (Vec<Option<Difference>>, Option<Difference>) {
        let long = self.steps.long;
        let mut points: Vec<Vec<f64>> = Vec::new();
        for (place, stencil) in stencils.iter().enumerate() {
            points.extend(stencil.iter().flat_map(|it| self.moved(place, *it, long)));
        }
        let is_central = stencils.iter().flatten().all(|it| *it == DifferencePoints::Central);
        let along = if is_central { DifferencePoints::Central } else { DifferencePoints::Above };
        let short = self.steps.short;
        points.extend(along.places().map(|steps| {
            let pairs = self.variables.iter().zip(stencils);
            let moved = pairs.map(|(it, stencil)| {
                let sense = stencil.map_or(0.0, DifferencePoints::sense);
                it.value + steps * sense * short * it.scale
            });
            moved.collect()
        }));
        let mut results = self.evaluated(&points).into_iter();
        let mut next = |stencil, step| Difference::next(stencil, step, &mut results);
        let each = stencils.iter().zip(self.variables);
        let found = each.map(|(stencil, it)| next((*stencil)?, long * it.scale)).collect();
        (found, next(along, short))
    }

    /// The same, with the variables that could not be moved to both sides moved to one.
    fn on_other_sides(&mut self, found: Vec<Option<Difference>>) -> Vec<Option<Difference>> {
        let found = found.into_iter().enumerate();
        found
            .map(|(place, difference)| {
                difference.or_else(|| {
                    let sides = [DifferencePoints::Above, DifferencePoints::Below];
                    sides.into_iter().find_map(|side| self.one(place, side, self.steps.long))
                })
            })
            .collect()
    }

    /// Differences along one variable, where there are results.
    fn one(&mut self, place: usize, stencil: DifferencePoints, step: f64) -> Option<Difference> {
        let variable = self.variables[place];
        let points = self.moved(place, stencil, step);
        let is_allowed =
            |point: &Vec<f64>| (variable.range.low..=variable.range.high).contains(&point[place]);
        if !points.iter().all(is_allowed) {
            return None;
        }
        let mut results = self.evaluated(&points).into_iter();
        Difference::next(stencil, step * variable.scale, &mut results)
    }

    /// Differences by the short step along some variables.
    fn short(&mut self, long: &[Option<Difference>], are_open: &[bool]) -> Vec<Option<Difference>> {
        let short = self.steps.short;
        let mut points: Vec<Vec<f64>> = Vec::new();
        let is_open = |place: usize| long[place].as_ref().filter(|_| are_open[place]);
        for place in 0..long.len() {
            points
                .extend(is_open(place).iter().flat_map(|it| self.moved(place, it.stencil, short)));
        }
        if points.is_empty() {
            return vec![None; long.len()];
        }
        let mut results = self.evaluated(&points).into_iter();
        let mut of = |place: usize| {
            let step = short * self.variables[place].scale;
            Difference::next(is_open(place)?.stencil, step, &mut results)
        };
        (0..long.len()).map(&mut of).collect()
    }

    /// Whether results change along all variables at once as the sum of single slopes says.
    fn is_straight(&self, found: &[Option<Difference>], along: Option<&Difference>) -> bool {
        let Some(along) = along else { return false };
        (0..self.here.len()).all(|result| {
            let here = self.here[result];
            let single = found.iter().zip(self.variables).filter_map(|(it, variable)| {
                let it = it.as_ref()?;
                Some(it.stencil.sense() * variable.scale * it.slope(result, here))
            });
            let (sum, size) = single
                .fold((0.0, self.sizes[result]), |(sum, size), one| (sum + one, size + one.abs()));
            (along.slope(result, here) - sum).abs() <= self.steps.tolerance * size
        })
    }

    /// Whether some result bends so much within a step that there may be a kink.
    fn bends(&self, place: usize, difference: &Difference) -> bool {
        (0..self.here.len()).any(|result| {
            let here = self.here[result];
            let scale = self.variables[place].scale;
            let size = self.size(result, scale * difference.slope(result, here));
            (difference.bend(result, here) * scale).abs() > SUSPICIOUS * size
        })
    }

    fn size(&self, result: usize, change: f64) -> f64 {
        self.sizes[result] + change.abs()
    }

    /// A slope from the long step alone, or from both.
    fn slope(
        &self,
        place: usize,
        result: usize,
        long: &Difference,
        short: Option<&Difference>,
    ) -> Derivative {
        let (here, scale) = (self.here[result], self.variables[place].scale);
        let value = long.slope(result, here);
        let Some(short) = short else { return Derivative::smooth(value) };
        let nearer = short.slope(result, here);
        let tolerance = self.steps.tolerance * self.size(result, nearer * scale) / scale;
        // What bends grows with the step; a kink at the value itself does not.
        let ratio = long.step / short.step;
        let bends = [long.bend(result, here), short.bend(result, here)];
        let kink = (ratio * bends[1] - bends[0]) / (ratio - 1.0);
        let parts = (value - nearer).abs();
        // A kink is the difference of two slopes of half the accuracy.
        const KINK: f64 = 10.0;
        if parts <= tolerance && kink.abs() <= KINK * tolerance {
            return Derivative::smooth(value);
        }
        let half = bends[1] / 2.0;
        match short.stencil {
            DifferencePoints::Central => {
                Derivative { value: nearer, sides: [nearer - half, nearer + half] }
            }
            // Only one side is known: both values are those of the two steps.
            DifferencePoints::Above | DifferencePoints::Below => {
                Derivative { value: nearer, sides: [value, nearer] }
            }
        }
    }

    /// All variables, with one of them moved.
    fn moved(&self, place: usize, stencil: DifferencePoints, step: f64) -> [Vec<f64>; 2] {
        stencil.places().map(|steps| {
            let mut point: Vec<f64> = self.variables.iter().map(|it| it.value).collect();
            point[place] += steps * step * self.variables[place].scale;
            point
        })
    }

    fn evaluated(&mut self, points: &[Vec<f64>]) -> Vec<Option<Vec<f64>>> {
        self.evaluations += points.len();
        (self.evaluate)(points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(value: f64) -> Variable {
        Variable { value, scale: 1.0, range: Span::ANY }
    }

    /// The slope of one function of one variable, and at how many points it took.
    fn of(f: impl Fn(f64) -> Option<f64>, variable: Variable) -> (Option<Derivative>, usize) {
        let here = [f(variable.value).unwrap()];
        let mut evaluate =
            |points: &[Vec<f64>]| points.iter().map(|it| f(it[0]).map(|it| vec![it])).collect();
        let found = derivatives(&[variable], &here, &[1.0], StepLengths::EXACT, &mut evaluate);
        (found.by_variable[0].as_ref().map(|it| it[0]), found.evaluations)
    }

    #[test]
    fn smooth_functions_cost_two_points_and_two_more_for_all() {
        let (slope, evaluations) = of(|x| Some(x.sin()), at(0.7));
        let slope = slope.unwrap();
        assert!((slope.value - 0.7_f64.cos()).abs() < 1e-10, "{slope:?}");
        assert!(!slope.is_one_sided());
        assert_eq!(evaluations, 4);
    }

    #[test]
    fn at_the_end_of_a_range_the_inner_side_counts() {
        for (range, x) in [(Span::at_least(1.0), 1.0), (Span::at_most(1.0), 1.0)] {
            let (slope, _) =
                of(|x: f64| (x.is_finite()).then_some(x.powi(3)), Variable { range, ..at(x) });
            let slope = slope.unwrap();
            assert!((slope.value - 3.0).abs() < 1e-8, "{slope:?}");
            assert!(!slope.is_one_sided());
        }
        let nowhere = Variable { range: Span::new(1.0, 1.0), ..at(1.0) };
        assert_eq!(of(Some, nowhere).0, None);
    }

    #[test]
    fn where_one_side_has_no_results_the_other_counts() {
        let (slope, _) = of(|x| (x >= 2.0).then_some(x * x), at(2.0));
        assert!((slope.unwrap().value - 4.0).abs() < 1e-8);
        let (slope, _) = of(|x| (x == 2.0).then_some(x), at(2.0));
        assert_eq!(slope, None);
    }

    /// At a kink, beside it within either step, and beyond both.
    #[test]
    fn a_kink_is_one_sided_as_far_as_a_step_reaches() {
        let f = |x: f64| Some(if x < 1.0 { 2.0 * x } else { 5.0 * x - 3.0 });
        for x in [1.0, 1.0 - 5e-7, 1.0 + 5e-6] {
            let (slope, _) = of(f, at(x));
            assert!(slope.unwrap().is_one_sided(), "{x}: {slope:?}");
        }
        let sides = of(f, at(1.0)).0.unwrap().sides;
        assert!((sides[0] - 2.0).abs() < 1e-8 && (sides[1] - 5.0).abs() < 1e-8, "{sides:?}");
        for (x, expected) in [(1.0 - 2e-5, 2.0), (1.0 + 2e-5, 5.0)] {
            let slope = of(f, at(x)).0.unwrap();
            assert!(!slope.is_one_sided() && (slope.value - expected).abs() < 1e-9, "{slope:?}");
        }
    }

    #[test]
    fn only_what_parts_is_looked_at_twice() {
        let mut evaluate = |points: &[Vec<f64>]| {
            points.iter().map(|it| Some(vec![it[0].sin() + it[1].abs() + it[2]])).collect()
        };
        let variables = [at(0.3), at(0.0), at(2.0)];
        let here = [0.3_f64.sin() + 2.0];
        let found = derivatives(&variables, &here, &[1.0], StepLengths::EXACT, &mut evaluate);
        let slopes: Vec<Derivative> =
            found.by_variable.into_iter().map(|it| it.unwrap()[0]).collect();
        assert_eq!(
            slopes.iter().map(|it| it.is_one_sided()).collect::<Vec<_>>(),
            [false, true, false]
        );
        assert_eq!(slopes[1].value, 0.0);
        // Two for each and for all; the kink's slope is symmetric, so that all agree, and one bends.
        assert_eq!(found.evaluations, 10);
    }
}
