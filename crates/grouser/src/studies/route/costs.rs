//! What a metre of way costs, by how steeply the ground rises along it and across it.

use rayon::prelude::*;

use super::hazard::Danger;
use super::study::{Limits, Objective, RouteStudy, STUCK_WAY, WORST_SHARE};
use crate::elementary::wide::cos;
use crate::error::ParameterError;
use crate::studies::ensemble::samples::{Sample, outputs_of_samples};
use crate::studies::heading::{HeadingCurve, LimitedBy, STRAIGHT_UP};
use crate::studies::mobility::{
    Beyond, Detail, Mobility, MobilityTable, advised_place, slope_and_course,
};
use crate::studies::verdict::{Judgement, SpotTurns};

/// Courses from straight down to straight up are so far apart [rad]: 7.5°.
const COURSE_STEP: f64 = std::f64::consts::PI / 24.0;
/// How many courses have a table: straight down, …, straight up.
pub const COURSES: usize = 25;
/// On so many of them, every other one, the samples are followed.
pub(super) const SAMPLED_COURSES: usize = COURSES / 2 + 1;
/// Points along the axes of the table: from the steepest way down to the steepest way up, and from
/// level to the steepest across.
const ALONG: usize = 401;
const ACROSS: usize = 201;

/// A metre of way, measured on the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Metre {
    /// Length over the ground [m].
    pub(super) length: f64,
    /// Time [s].
    pub(super) time: f64,
    /// Work of the wheels [J].
    pub(super) energy: f64,
    /// What motors and electronics draw [J]; NaN where no motor is known.
    pub(super) drawn: f64,
    /// Slip ratio [-].
    pub(super) slip_ratio: f64,
}

/// Motions on every slope and course, and where nobody may go.
#[derive(Clone, Debug)]
pub struct RouteTables {
    tables: Vec<MobilityTable>,
    limits: Limits,
    risk: Option<Risk>,
    step: f64,
    /// The least slope of each sampled course that has the verdict no-go [rad], where that has been
    /// looked for, with the reason.
    no_go_from: [Option<(f64, Judgement)>; SAMPLED_COURSES],
    /// Turns on the spot.
    pub(super) turns: SpotTurns,
    /// The least slope on which none is made [rad].
    no_turn_from: f64,
}

/// What a metre costs that has the least of one thing.
pub(super) struct Costs<'a> {
    pub(super) of: &'a RouteTables,
    /// What is sought, for a metre: infinite where nobody may go.
    table: Vec<f32>,
    /// What a metre costs at least. Downhill wheels may do less work than none, and motors that feed
    /// back draw less: what they take out of the height is not lost before it is gained, so that all that is above the bound is
    /// positive.
    pub(super) bound: Bound,
}

/// A plane below all costs: `level + climb · rise`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bound {
    pub(super) level: f64,
    pub(super) climb: f64,
}

impl RouteStudy {
    /// The tables that routes are sought with; `None` if `go_on` was false before the end.
    ///
    /// * `samples`: of soil and model; with none the soil as written is judged by
    /// * `with_risk`: whether ways of the least risk are to be sought
    /// * `go_on`: asked before each sample of each course, from any thread
    ///
    /// # Errors
    /// [`ParameterError`] for invalid inputs.
    pub fn tables(
        &self,
        samples: &[Sample],
        with_risk: bool,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<RouteTables>, ParameterError> {
        // Of the samples every other course is followed, and between two of them lies the mean.
        let table = |(number, course): (usize, f64)| {
            let samples = if number % 2 == 0 { samples } else { &[] };
            self.mobility.table_of(course, samples, Detail::Rough, go_on)
        };
        let tables = courses().enumerate().map(table).collect::<Result<Option<Vec<_>>, _>>()?;
        let Some(mut tables) = tables else { return Ok(None) };
        for number in (1..COURSES - 1).step_by(2) {
            let (before, rest) = tables.split_at_mut(number);
            let (between, after) = rest.split_at_mut(1);
            between[0].set_samples_between(&before[number - 1], &after[0]);
        }
        let mut risk = None;
        if with_risk {
            let Some(found) = Risk::of(self, samples, go_on)? else { return Ok(None) };
            risk = Some(found);
        }
        let steepest = tables.iter().filter_map(MobilityTable::limit).fold(0.05, f64::max);
        let step = crate::elementary::wide::tan(steepest) / (ACROSS - 1) as f64;
        let no_go_from = [None; SAMPLED_COURSES];
        let turns = SpotTurns::of(&self.mobility, samples);
        Ok(Some(RouteTables {
            tables,
            limits: self.limits,
            risk,
            step,
            no_go_from,
            turns,
            no_turn_from: f64::INFINITY,
        }))
    }
}

impl<'a> Costs<'a> {
    /// * `of`: with the risk, if that is the objective
    pub(super) fn of(of: &'a RouteTables, objective: Objective) -> Self {
        let price = |along: f64, across: f64| {
            let metre = of.metre(along, across)?;
            Some(match objective {
                Objective::Time => metre.time,
                Objective::Energy => drawn_or_work(metre.drawn, metre.energy),
                Objective::Risk => metre.length * of.risk.as_ref()?.at(along, across),
            })
        };
        let all = (0..ALONG * ACROSS).into_par_iter().map(|place| {
            let (along, across) = of.point(place);
            #[expect(clippy::cast_possible_truncation, reason = "seven digits are enough to seek")]
            price(along, across).map_or(f32::INFINITY, |price| price as f32)
        });
        let mut costs = Self { of, table: all.collect(), bound: Bound { level: 0.0, climb: 0.0 } };
        costs.bound = costs.largest_bound();
        if costs.bound.level <= 0.0 {
            // Nothing may cost less than nothing all the way round.
            costs.table.iter_mut().for_each(|price| *price = price.max(0.0));
            costs.bound = Bound { level: 0.0, climb: 0.0 };
        }
        costs
    }

    /// What is sought, for a metre on the map; infinite where nobody may go.
    ///
    /// * `along`, `across`: how steeply the ground rises along the way, and to its side [m/m]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "places in the table"
    )]
    pub(super) fn price(&self, along: f64, across: f64) -> f64 {
        let x = along / self.of.step + (ALONG / 2) as f64;
        let y = across.abs() / self.of.step;
        if !(0.0..=(ALONG - 1) as f64).contains(&x) || y > (ACROSS - 1) as f64 {
            return f64::INFINITY;
        }
        let (column, row) = ((x as usize).min(ALONG - 2), (y as usize).min(ACROSS - 2));
        let (u, v) = (x - column as f64, y - row as f64);
        let at = |column: usize, row: usize| f64::from(self.table[row * ALONG + column]);
        let mixed = |row: usize| {
            let (one, other) = (at(column, row), at(column + 1, row));
            // Nothing of what is infinite is nothing.
            if u == 0.0 { one } else { one + u * (other - one) }
        };
        let price =
            if v == 0.0 { mixed(row) } else { mixed(row) + v * (mixed(row + 1) - mixed(row)) };
        if price.is_nan() { f64::INFINITY } else { price }
    }

    /// The plane that lies highest over a level way and below all prices.
    fn largest_bound(&self) -> Bound {
        /// Thirds that are taken off an interval: to less than 1e-9 of it.
        const STEPS: usize = 54;
        let open = || self.table.iter().enumerate().filter(|(_, price)| price.is_finite());
        let under = |climb: f64| {
            let left =
                |(place, price): (usize, &f32)| f64::from(*price) - climb * self.of.point(place).0;
            open().map(left).fold(f64::INFINITY, f64::min)
        };
        let dearest = open().map(|(_, price)| f64::from(*price)).fold(0.0, f64::max);
        // The least of many planes is concave in their common slope.
        let reach = dearest / self.of.step.max(f64::MIN_POSITIVE) / ALONG as f64;
        let (mut low, mut high) = (-reach, reach);
        for _ in 0..STEPS {
            let third = (high - low) / 3.0;
            if under(low + third) < under(high - third) {
                low += third;
            } else {
                high -= third;
            }
        }
        let climb = f64::midpoint(low, high);
        let level = under(climb);
        // A little less, for what single precision takes off.
        Bound { level: if level.is_finite() { level * (1.0 - 1e-6) } else { 0.0 }, climb }
    }
}

impl RouteTables {
    /// Rises along and across at a place of the table.
    fn point(&self, place: usize) -> (f64, f64) {
        let along = (place % ALONG) as f64 - (ALONG / 2) as f64;
        (along * self.step, (place / ALONG) as f64 * self.step)
    }

    /// A metre of way; none where nobody may go.
    pub(super) fn metre(&self, along: f64, across: f64) -> Option<Metre> {
        let metre = self.steady_metre(along, across)?;
        self.limits_exceeded(along, across, &metre).next().is_none().then_some(metre)
    }

    /// A metre of way, whatever the limits; none where no heading holds the course.
    pub(super) fn steady_metre(&self, along: f64, across: f64) -> Option<Metre> {
        let (slope, course) = slope_and_course(along, across);
        let motion = self.motion(slope, course)?;
        let length = (1.0 + along * along).sqrt();
        Some(Metre {
            length,
            time: length / motion.speed,
            energy: length * motion.energy_per_metre(),
            drawn: length * motion.drawn_power / motion.speed,
            slip_ratio: motion.slip_ratio,
        })
    }

    /// The limits that a metre of way does not keep to, each with the number that is beyond it.
    pub(super) fn limits_exceeded(
        &self,
        along: f64,
        across: f64,
        metre: &Metre,
    ) -> impl Iterator<Item = (Danger, f64)> {
        let (slope, course) = slope_and_course(along, across);
        let Limits { most_slope, most_slip_ratio, most_no_go } = self.limits;
        let slip = metre.slip_ratio;
        let steep = (slope > most_slope).then_some((Danger::TooSteep, slope));
        let slips =
            (slip.is_nan() || slip > most_slip_ratio).then_some((Danger::TooMuchSlip, slip));
        let no_go = move || {
            let probability = self.probability_no_go(slope, course);
            let is_too_often = probability > 0.0 && probability >= most_no_go;
            is_too_often.then_some((Danger::NoGo, probability))
        };
        let verdict = self.verdict_of_no_go(slope, course).map(|it| (Danger::Verdict(it), slope));
        // The last one takes long, and is not asked for if one before it is enough.
        let first = steep.into_iter().chain(slips).chain(verdict);
        first.chain(std::iter::once_with(no_go).flatten())
    }

    /// Keeps ways off slopes of a course that have the verdict no-go; returns whether that is new.
    ///
    /// * `from`: the least of them [rad], a class of slopes
    pub(super) fn keep_off(&mut self, course: f64, from: f64, why: Judgement) -> bool {
        let known = &mut self.no_go_from[nearest_course(course)];
        let is_new = known.is_none_or(|(known, _)| from < known);
        if is_new {
            *known = Some((from, why.of_several()));
        }
        is_new
    }

    /// Keeps ways from turning on the spot on slopes from one on [rad]; whether they did.
    pub(super) fn keep_turns_off(&mut self, from: f64) -> bool {
        let is_new = from < self.no_turn_from;
        self.no_turn_from = from.min(self.no_turn_from);
        is_new
    }

    /// Whether a way may turn on the spot where the ground rises so steeply [m/m].
    pub(super) fn may_turn(&self, rise: f64) -> bool {
        advised_place(slope_and_course(rise, 0.0)).0 < self.no_turn_from
    }

    /// Why a slope and course have the verdict no-go, if that has been found.
    fn verdict_of_no_go(&self, slope: f64, course: f64) -> Option<Judgement> {
        let (from, why) = self.no_go_from[nearest_course(course)]?;
        (advised_place((slope, course)).0 >= from).then_some(why)
    }

    fn motion(&self, slope: f64, course: f64) -> Option<Mobility> {
        let (below, share) = self.between(course);
        let one = self.tables[below].motion(slope)?;
        if share == 0.0 {
            return Some(one);
        }
        Some(one.towards(&self.tables[below + 1].motion(slope)?, share))
    }

    /// The number of the table of the course below this one, and how far it is to the next [-].
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place in a list"
    )]
    fn between(&self, course: f64) -> (usize, f64) {
        let place = (course + STRAIGHT_UP) / COURSE_STEP;
        let below = (place.max(0.0) as usize).min(self.tables.len() - 2);
        (below, (place - below as f64).clamp(0.0, 1.0))
    }

    /// Why each sample may go no farther over ground that rises along the way and across it, as the
    /// `danger` of its end; nothing of one that may.
    pub(super) fn fates(
        &self,
        along: f64,
        across: f64,
    ) -> impl Iterator<Item = Option<Option<Danger>>> {
        let (slope, course) = slope_and_course(along, across);
        let (below, share) = self.between(course);
        let [one, other] = [below, below + 1].map(|it| self.tables[it].beyond());
        let beyond = one.iter().zip(other).map(move |(one, other)| match share {
            0.0 => *one,
            share if share > 0.5 => other.and(*one),
            _ => one.and(*other),
        });
        let danger = |beyond: Beyond| match beyond {
            Beyond::NoHeading => Some(Danger::NoHeading),
            Beyond::TooMuchSlip => Some(Danger::TooMuchSlip),
            Beyond::NotFound => None,
        };
        let fates = self.fails_on(slope, course).zip(beyond);
        fates.map(move |(fails, beyond)| fails.then(|| danger(beyond)))
    }

    /// Whether each sample may go no farther on a slope and course.
    fn fails_on(&self, slope: f64, course: f64) -> impl Iterator<Item = bool> {
        let (below, share) = self.between(course);
        let pairs = self.tables[below]
            .steepest_of_samples()
            .iter()
            .zip(self.tables[below + 1].steepest_of_samples());
        pairs.map(move |(one, other)| slope > one + share * (other - one))
    }

    /// The median over the samples of the slip ratio with which each holds a course by its own
    /// heading [-]; NaN where none is known.
    pub(super) fn median_slip(&self, slope: f64, course: f64) -> f64 {
        let (below, share) = self.between(course);
        let one = self.tables[below].median_slip(slope);
        if share == 0.0 {
            return one;
        }
        one + share * (self.tables[below + 1].median_slip(slope) - one)
    }

    /// In which share of the samples a slope and course are a no-go [-].
    pub(super) fn probability_no_go(&self, slope: f64, course: f64) -> f64 {
        let failed = self.fails_on(slope, course).filter(|fails| *fails).count();
        failed as f64 / self.tables[0].steepest_of_samples().len() as f64
    }
}

/// The energy that a way is to have least of: what is drawn, or work where no motor is known.
pub(super) fn drawn_or_work(drawn: f64, work: f64) -> f64 {
    if drawn.is_nan() { work } else { drawn }
}

/// Which of the sampled courses is nearest, by its number.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place in a list")]
pub(super) fn nearest_course(course: f64) -> usize {
    let place = ((course + STRAIGHT_UP) / (2.0 * COURSE_STEP)).round();
    place.clamp(0.0, (SAMPLED_COURSES - 1) as f64) as usize
}

/// The courses of the tables [rad].
fn courses() -> impl Iterator<Item = f64> {
    (0..COURSES).map(|number| number as f64 * COURSE_STEP - STRAIGHT_UP)
}

/// The time of a metre that the worst of the samples need.
#[derive(Clone, Debug)]
struct Risk {
    /// By every other course, and slope.
    times: Vec<Vec<f64>>,
}

/// Slopes of the risk are so far apart [rad], half a degree, and there are so many.
const SLOPE_STEP: f64 = std::f64::consts::PI / 360.0;
const SLOPES: usize = 121;

impl Risk {
    fn of(
        study: &RouteStudy,
        samples: &[Sample],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Self>, ParameterError> {
        let mobility = &study.mobility;
        let nominal =
            [Sample { soil: mobility.heading.soil, model: mobility.heading.model.clone() }];
        let samples = if samples.is_empty() { &nominal } else { samples };
        let stuck = STUCK_WAY / mobility.rim_speed;
        let mut times = Vec::new();
        for course in courses().step_by(2) {
            let one = |sample: &Sample| -> Result<Vec<f64>, ParameterError> {
                let most = mobility.rule.no_go_slip_ratio;
                let curve = mobility.heading.of_sample(sample).curve_up_to(course, most)?;
                let time = |slip: f64, crab: f64| cos(crab) / (1.0 - slip) / mobility.rim_speed;
                let times = times_of(&curve, most, time);
                // Where the search gave up nothing is known of the time: NaN is left out.
                let gave_up = curve.limited_by() == Some(LimitedBy::NotFound)
                    || curve.limit().is_err_and(|none| none.is_not_found());
                let beyond = if gave_up { f64::NAN } else { stuck };
                Ok((0..SLOPES).map(|slope| times(slope).unwrap_or(beyond)).collect())
            };
            let Some(found) = outputs_of_samples(samples, go_on, one) else { return Ok(None) };
            let found = found.into_iter().collect::<Result<Vec<_>, ParameterError>>()?;
            times.push(
                (0..SLOPES).map(|slope| mean_of_worst(&found, slope).unwrap_or(stuck)).collect(),
            );
        }
        Ok(Some(Self { times }))
    }

    /// Time of a metre of ground [s].
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "places in the table"
    )]
    fn at(&self, along: f64, across: f64) -> f64 {
        let (slope, course) = slope_and_course(along, across);
        let x = (slope / SLOPE_STEP).min((SLOPES - 1) as f64);
        let y = (course + STRAIGHT_UP) / (2.0 * COURSE_STEP);
        let (column, row) =
            ((x as usize).min(SLOPES - 2), (y.max(0.0) as usize).min(self.times.len() - 2));
        let (u, v) = (x - column as f64, (y - row as f64).clamp(0.0, 1.0));
        let mixed = |row: usize| {
            let times = &self.times[row];
            times[column] + u * (times[column + 1] - times[column])
        };
        mixed(row) + v * (mixed(row + 1) - mixed(row))
    }
}

/// The time of a metre on each slope by its number, between the points of a curve; none where it
/// ends, or slips more than it may.
fn times_of(
    curve: &HeadingCurve,
    most_slip: f64,
    time: impl Fn(f64, f64) -> f64,
) -> impl Fn(usize) -> Option<f64> {
    let points: Vec<[f64; 3]> = curve.points().collect();
    move |place| {
        let slope = place as f64 * SLOPE_STEP;
        let above = points.iter().position(|point| point[0] >= slope)?;
        let (low, high) = (points[above.saturating_sub(1)], points[above]);
        let rise = high[0] - low[0];
        let share = if rise > 0.0 { (slope - low[0]) / rise } else { 1.0 };
        let [slip, crab] = [1, 2].map(|it| low[it] + share * (high[it] - low[it]));
        (slip <= most_slip)
            .then(|| if slip < 0.0 { time(0.0, crab) * (1.0 + slip) } else { time(slip, crab) })
    }
}

/// The conditional value at risk: the mean of the worst of all samples.
///
/// Over the samples of which the time is known, if there are any.
fn mean_of_worst(samples: &[Vec<f64>], slope: usize) -> Option<f64> {
    let known = samples.iter().map(|times| times[slope]).filter(|time| !time.is_nan());
    let mut times: Vec<f64> = known.collect();
    if times.is_empty() {
        return None;
    }
    times.sort_by(f64::total_cmp);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a share of a count"
    )]
    let worst = ((times.len() as f64 * WORST_SHARE).ceil() as usize).clamp(1, times.len());
    Some(times[times.len() - worst..].iter().sum::<f64>() / worst as f64)
}
