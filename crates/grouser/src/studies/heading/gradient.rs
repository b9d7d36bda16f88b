//! How a heading, and the steepest slope, change with numbers of rover, soil and ground.
//!
//! On a slope α the slip ratio and the crab angle x = (s, c) balance the forces, R(x, α, p) = 0, and
//! follow a number p by
//!
//! ```text
//! dx/dp = −(∂R/∂x)⁻¹ ∂R/∂p
//! ```
//!
//! At the fold, where ∂R/∂x has no inverse, its left null vector w gives the steepest slope's
//! derivative: dα/dp = −(w·∂R/∂p)/(w·∂R/∂α). The partial derivatives are differences of settled
//! rovers at one place; no balance is sought twice.

use super::path::{Gradients, Held, MOST_SLIP, Path, Place, Point};
use super::study::HeadingStudy;
use super::{HeadingCurve, HeadingOffset, LimitedBy, NoHeading};
use crate::difference::{Derivative, StepLengths, Variable, derivatives};
use crate::elementary::wide::hypot;
use crate::soil::Span;
use crate::vehicle::Rover;

/// A study and its course [rad] with values for some numbers; none where they are no rover and soil
/// together.
pub type StudyWith<'a> = dyn Fn(&[f64]) -> Option<(HeadingStudy, f64)> + 'a;

/// A study whose numbers may be changed.
#[derive(Clone, Copy)]
pub struct ChangeableStudy<'a> {
    /// The numbers.
    pub variables: &'a [Variable],
    /// The study with other values for all of them.
    pub with: &'a StudyWith<'a>,
    /// The results of a heading that are differentiated, in any units.
    pub results: &'a dyn Fn(&HeadingOffset, &Rover) -> Vec<f64>,
    /// What a change of each of them is small against where it is near zero.
    pub sizes: &'a [f64],
}

/// The derivatives of results at a point of a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadingDerivatives {
    /// Those of each result by each number; none by a number that can be changed to neither side.
    pub by_variable: Vec<Option<Vec<Derivative>>>,
    /// Those by the slope [1/rad].
    pub by_slope: Option<Vec<Derivative>>,
}

/// Side walls whose law jumps hold a rover on slopes of more than this [rad].
const JUMP: f64 = 1e-6;
/// An imbalance whose determinant is smaller, over its terms, is that of a fold [-].
const FOLDED: f64 = 1e-4;

/// Slip that is small: steps of smaller ones are shares of it [-].
const SMALL_SLIP: f64 = 0.1;
/// An angle that is small [rad].
const SMALL_ANGLE: f64 = 0.1;

/// How many equations balance a rover that holds its course.
const EQUATIONS: usize = 2;
/// Places of slip ratio, crab angle and slope among a point's coordinates.
const SLIP: usize = 0;
const CRAB: usize = 1;
const SLOPE: usize = 2;

/// Partial derivatives at a point, with its place fixed.
struct Partials {
    /// By each number, then by slip ratio, crab angle and slope: of the results, then of the two
    /// imbalances.
    by_variable: Vec<Option<Vec<Derivative>>>,
    results: usize,
}

impl HeadingCurve {
    /// The derivatives of a heading on a slope [rad].
    ///
    /// # Errors
    /// [`NoHeading`] if no heading holds the course there.
    pub fn gradient(
        &self,
        slope: f64,
        changeable: &ChangeableStudy<'_>,
    ) -> Result<HeadingDerivatives, NoHeading> {
        let (point, _) = self.point_on(slope)?;
        let partials = self.partials(&point, changeable);
        // Side walls that hold the rover without any crab hold it beside this number, too. Where
        // their law does not jump the curve starts on level ground, but for rounding.
        let is_held = self.held_below > JUMP && slope <= self.held_below;
        let is_held = is_held || Path::new(&self.study, self.held).is_straight();
        let unknowns: &[usize] = if is_held { &[SLIP] } else { &[SLIP, CRAB] };
        let numbers = changeable.variables.len();
        let by_variable = (0..numbers).map(|variable| partials.along(variable, unknowns)).collect();
        Ok(HeadingDerivatives { by_variable, by_slope: partials.along(numbers + SLOPE, unknowns) })
    }

    /// The derivatives of the steepest slope [rad] by each number; none where it can be changed to
    /// neither side, or where what ends the curve has no derivative.
    #[must_use]
    pub fn limit_gradient(&self, changeable: &ChangeableStudy<'_>) -> Vec<Option<Derivative>> {
        let none = || vec![None; changeable.variables.len()];
        match self.limited_by() {
            Some(LimitedBy::Wheels) => {
                self.points.last().map_or_else(none, |last| self.fold_gradient(last, changeable))
            }
            Some(LimitedBy::GroundStrength) => self.strength_gradient(changeable),
            Some(LimitedBy::Range) => {
                vec![Some(Derivative::smooth(0.0)); changeable.variables.len()]
            }
            Some(LimitedBy::NotFound) | None => none(),
        }
    }

    fn fold_gradient(
        &self,
        last: &Point,
        changeable: &ChangeableStudy<'_>,
    ) -> Vec<Option<Derivative>> {
        /// Flatter than this the curve folds at its last point [-].
        const FLAT: f64 = 1e-3;
        let numbers = changeable.variables.len();
        let partials = self.partials(last, changeable);
        let Some([slip, crab, slope]) = partials.of_place(numbers) else {
            return vec![None; numbers];
        };
        let gradients: Gradients = [0, 1].map(|row| Place::new(slip[row], crab[row], slope[row]));
        let tangent = gradients[0].cross(&gradients[1]);
        if tangent.z.abs() > FLAT * tangent.norm() {
            return self.end_gradient(last, &partials);
        }
        let size = |column: [f64; 2]| hypot(column[0], column[1]);
        let column = if size(slip) > size(crab) { slip } else { crab };
        let null = [-column[1], column[0]];
        let along = |by: [f64; 2]| null[0] * by[0] + null[1] * by[1];
        let rise = along(slope);
        let of = |variable: usize| {
            let by = partials.imbalances(variable)?;
            Some(Derivative::each(|side| -along(by.map(|it| it.at(side))) / rise))
        };
        (0..numbers).map(of).collect()
    }

    /// The same where the curve ends while it rises: wheels that spin on the spot keep their slip.
    /// Where wheels tip over or sink the end has no equation of its own here, and no derivative.
    fn end_gradient(&self, last: &Point, partials: &Partials) -> Vec<Option<Derivative>> {
        let numbers = partials.by_variable.len() - 3;
        if (last.place.x.abs() - MOST_SLIP).abs() > 1e-9 {
            return vec![None; numbers];
        }
        let is_straight = Path::new(&self.study, self.held).is_straight();
        let unknowns: &[usize] = if is_straight { &[SLOPE] } else { &[CRAB, SLOPE] };
        let of = |variable: usize| {
            let by = partials.imbalances(variable)?;
            let rise = |side| partials.solved(by.map(|it| it.at(side)), unknowns)?.last().copied();
            let sides = [rise(Some(0))?, rise(Some(1))?];
            Some(Derivative { value: rise(None)?, sides })
        };
        (0..numbers).map(of).collect()
    }

    /// The same where the ground's own strength ends.
    fn strength_gradient(&self, changeable: &ChangeableStudy<'_>) -> Vec<Option<Derivative>> {
        let here = [self.study.ground_limit()];
        let mut evaluate = |points: &[Vec<f64>]| {
            let limit = |numbers: &Vec<f64>| {
                (changeable.with)(numbers).map(|(study, _)| vec![study.ground_limit()])
            };
            points.iter().map(limit).collect()
        };
        let found =
            derivatives(changeable.variables, &here, &[1.0], StepLengths::EXACT, &mut evaluate);
        found.by_variable.into_iter().map(|it| it?.first().copied()).collect()
    }

    fn partials(&self, point: &Point, changeable: &ChangeableStudy<'_>) -> Partials {
        let place = |value: f64, small: f64, range: Span| Variable {
            value,
            scale: value.abs().max(small),
            range,
        };
        let of_place = [
            place(point.place.x, SMALL_SLIP, Span::new(-1.0, 1.0)),
            place(point.place.y, SMALL_ANGLE, Span::at_least(0.0)),
            place(point.place.z, SMALL_ANGLE, Span::at_least(0.0)),
        ];
        let variables: Vec<Variable> =
            changeable.variables.iter().copied().chain(of_place).collect();
        let mut evaluate = |points: &[Vec<f64>]| {
            points.iter().map(|it| self.changed(it, point, changeable)).collect()
        };
        let values: Vec<f64> = variables.iter().map(|it| it.value).collect();
        let Some(here) = self.changed(&values, point, changeable) else {
            return Partials { by_variable: vec![None; variables.len()], results: 0 };
        };
        let results = here.len() - EQUATIONS;
        let sizes = here[..results].iter().zip(changeable.sizes).map(|(it, size)| it.abs() + size);
        let sizes: Vec<f64> = sizes.chain([1.0; EQUATIONS]).collect();
        let found = derivatives(&variables, &here, &sizes, StepLengths::SETTLED, &mut evaluate);
        Partials { by_variable: found.by_variable, results }
    }

    /// The results and the imbalances with other numbers, and at another place behind them.
    fn changed(
        &self,
        values: &[f64],
        near: &Point,
        changeable: &ChangeableStudy<'_>,
    ) -> Option<Vec<f64>> {
        let (numbers, place) = values.split_at(changeable.variables.len());
        let (study, course) = (changeable.with)(numbers)?;
        let held = match self.held {
            Held::Yaw(_) => Held::Yaw(course),
            Held::Course(_) | Held::Body(_) => study.held(course),
        };
        let path = Path::new(&study, held);
        path.begin_at(near);
        let place = Place::from_column_slice(place);
        let (left_over, wheels) = path.balance(&place).ok()?;
        let point = Point { place, gradients: Gradients::default(), wheels };
        let heading = Self::heading_of(&study, held, &point, 0);
        Some((changeable.results)(&heading, &study.rover).into_iter().chain(left_over).collect())
    }
}

impl Partials {
    /// The partial derivatives of the imbalances along a variable.
    fn imbalances(&self, variable: usize) -> Option<[Derivative; EQUATIONS]> {
        let slopes = self.by_variable[variable].as_ref()?;
        Some([slopes[self.results], slopes[self.results + 1]])
    }

    /// The same by slip ratio, crab angle and slope, behind so many numbers.
    fn of_place(&self, numbers: usize) -> Option<[[f64; EQUATIONS]; 3]> {
        let values =
            |axis: usize| self.imbalances(numbers + axis).map(|it| it.map(|slope| slope.value));
        Some([values(SLIP)?, values(CRAB)?, values(SLOPE)?])
    }

    /// How fast the unknowns, one or two of a point's coordinates, change so that the imbalances
    /// stay zero; nothing where the curve folds, so that none follow.
    ///
    /// * `by`: how fast the imbalances change by themselves
    fn solved(&self, by: [f64; EQUATIONS], unknowns: &[usize]) -> Option<Vec<f64>> {
        let of_place = self.of_place(self.by_variable.len() - 3)?;
        if let [one] = unknowns {
            return Some(vec![-by[0] / of_place[*one][0]]).filter(|it| it[0].is_finite());
        }
        let [one, other] = [of_place[unknowns[0]], of_place[unknowns[1]]];
        let terms = [one[0] * other[1], other[0] * one[1]];
        let determinant = terms[0] - terms[1];
        if determinant.abs() <= FOLDED * (terms[0].abs() + terms[1].abs()) {
            return None;
        }
        Some(vec![
            -(by[0] * other[1] - other[0] * by[1]) / determinant,
            -(one[0] * by[1] - by[0] * one[1]) / determinant,
        ])
    }

    /// The derivatives of the results along a variable, with the unknowns that follow it.
    fn along(&self, variable: usize, unknowns: &[usize]) -> Option<Vec<Derivative>> {
        let numbers = self.by_variable.len() - 3;
        let own = self.by_variable[variable].as_ref()?;
        let by = self.imbalances(variable)?;
        let way_at = |side| self.solved(by.map(|it| it.at(side)), unknowns);
        let ways = [way_at(Some(0))?, way_at(Some(1))?];
        let way = way_at(None)?;
        let result = |result: usize| {
            let partial = |axis: usize| {
                let slopes = self.by_variable[numbers + axis].as_ref();
                slopes.map_or_else(Derivative::default, |it| it[result])
            };
            Derivative::each(|side| {
                let way = side.map_or(&way, |side| &ways[side]);
                let terms = unknowns.iter().zip(way).map(|(axis, way)| {
                    // An unknown that falls as the number rises comes to its other side.
                    let other = side.map(|side| if *way < 0.0 { 1 - side } else { side });
                    partial(*axis).at(other) * way
                });
                own[result].at(side) + terms.sum::<f64>()
            })
        };
        Some((0..self.results).map(result).collect())
    }
}
