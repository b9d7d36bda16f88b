//! Numbers of a rover that are found instead of guessed: the least of an aim under limits.
//!
//! Some numbers of a rover are free between bounds. Every design is measured by the curve of its
//! headings on a course: the steepest slope, and on one slope the slip, the sinkage and the work. The
//! aim is the least of one such measure, or of a sum of them; the limits are on others. Both are
//! smooth but for kinks where another wheel is the deepest, so that sequential least-squares
//! programming finds a minimum and what each limit costs (Kraft 1988). It is sought from several
//! starts, and looked at again by designs around it.
//!
//! Where the soil is uncertain, a limit is to be kept with a probability. Samples of soil and model
//! are the same for every design, and a limit is on the mean of a measure and z of its standard
//! deviations to the worse side, which is smooth. What z has to be for the share of samples that is
//! asked for is found with the design: it is looked up in the samples there, and the search goes on
//! from there. Samples that took no part say in the end which share keeps each limit.
//!
//! A wheel that grows gets heavier by a rule: it is of one sheet, rim and grousers, whose mass per
//! area is that of the rover's own wheel. What its mass adds to the load counts.
//!
//! Samples make each design forty times as dear, so that a search among them starts where the least is
//! without them, and two others only show whether it is the least.
//!
//! A design that does not cross the slope is measured where its curve ends, and that it crosses the
//! slope is a limit like others: a search that starts below may climb.

mod measured;
mod slsqp;

use grouser_io::Described as _;
use grouser_io::design::Measure;
use grouser_io::design_task::{DesignTask, RoverChoice};
use grouser_io::statistics::NothingAccepted;
use grouser_io::statistics::normal::normal_score;
use rayon::prelude::*;

use self::measured::MeasuredGround;
pub use self::measured::Measures;
use self::slsqp::{Effort, Minimum, Smooth};
use crate::contact::Model;
use crate::contact::validity::Finding;
use crate::difference::{Derivative, StepLengths, Variable, derivatives};
use crate::soil::Span;
use crate::studies::ensemble::design::{self as points, Sampling};
use crate::vehicle::Rover;

/// Asked before each design that is measured, from any thread, whether to go on.
pub type GoOn<'a> = &'a (dyn Fn() -> bool + Sync);

/// The least of an aim under limits.
#[derive(Clone, Debug)]
pub struct DesignStudy {
    /// What is free, what is to be least, and what is limited.
    pub task: DesignTask,
    /// Whether soils are taken as their documents have them.
    pub is_nominal: bool,
    /// With which random numbers soils are drawn.
    pub seed: u64,
}

/// A limit of a measure on one of the grounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DesignLimit {
    /// On which ground, as numbered in [`RoverChoice::grounds`].
    pub ground: usize,
    /// What is limited.
    pub measure: Measure,
    /// To which side.
    pub side: LimitSide,
    /// The limit, in SI.
    pub bound: f64,
}

/// To which side a measure is limited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LimitSide {
    /// It is to be as large or larger.
    AtLeast,
    /// It is to be as small or smaller.
    AtMost,
}

/// A limit, and how a design keeps it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeptLimit {
    /// The limit.
    pub limit: DesignLimit,
    /// What the design has, in SI; where the soil is uncertain, what it has or does better with the
    /// probability that is asked for.
    pub value: f64,
    /// By how much the aim falls if the limit is loosened by one, each in its unit; 0 for one that does
    /// not hold the design back.
    pub price: f64,
    /// The share of fresh samples that keeps it, where the soil is uncertain.
    pub share: Option<f64>,
}

/// A design that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct BestDesign {
    /// The rover, by its place among those that may be chosen.
    pub candidate: usize,
    /// The free numbers, in their keys' units.
    pub values: Vec<f64>,
    /// All numbers of the rover that it changes, by their keys: the free ones, and what the masses
    /// of the wheels follow from.
    pub numbers: Vec<(String, f64)>,
    /// The aim.
    pub objective: f64,
    /// What is measured of it on the first ground, on average over samples where there are any.
    pub measures: Measures,
    /// Every limit.
    pub kept: Vec<KeptLimit>,
    /// What shows that it is the least.
    pub certificate: Certificate,
}

/// What shows that a design is the least.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Certificate {
    /// Searches that were started.
    pub starts: usize,
    /// Those that came to this design.
    pub agreed: usize,
    /// Designs around it that were looked at.
    pub probes: usize,
    /// Those that keep all limits and are better; none for a minimum.
    pub better: usize,
}

/// Why no design was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoDesign {
    /// No rover within the bounds moves, or none that was looked at.
    #[error("no rover that was looked at within these bounds moves on this ground")]
    NothingMoves,
    /// No design was found that keeps all limits.
    #[error("no design was found within these bounds that keeps every limit")]
    Unreachable(Box<Nearest>),
    /// No search came to an end.
    #[error(
        "no search for a design came to an end, from any start: this is no finding about rover and soil"
    )]
    NotFound,
    /// The aim does not depend on what is free.
    #[error("the aim does not depend on any number that is free")]
    Constant,
    /// A slope is to be crossed that is steeper than the ground itself stands.
    #[error("no rover crosses a slope on which the ground itself does not stand")]
    BeyondGround {
        /// The limit.
        limit: DesignLimit,
        /// The steepest slope on which that ground stands by its own strength [rad].
        stands: f64,
    },
    /// It was stopped on the way.
    #[error("the search for a design was stopped before its end")]
    Stopped,
    /// No soil can be drawn.
    #[error(transparent)]
    NoSample(#[from] NothingAccepted),
}

/// The design that comes nearest to keeping all limits.
#[derive(Clone, Debug, PartialEq)]
pub struct Nearest {
    /// The rover, by its place among those that may be chosen.
    pub candidate: usize,
    /// The free numbers, in their keys' units.
    pub values: Vec<f64>,
    /// Limits that it misses, and what it has, in SI.
    pub missed: Vec<(DesignLimit, f64)>,
}

/// What a change of a measure is small against, in its unit: aims and limits are counted in it.
const fn size(measure: Measure) -> f64 {
    match measure {
        Measure::LimitSlope | Measure::Crab | Measure::TippingSlope => 5.0,
        Measure::SinkageRatio | Measure::SlipRatio | Measure::Width | Measure::Current => 0.1,
        Measure::EnergyPerMetre => 10.0,
        Measure::Torque | Measure::BrakingTorque | Measure::WheelMass => 1.0,
    }
}

/// The same, in SI.
fn size_in_si(measure: Measure) -> f64 {
    measure.unit().to_si(size(measure))
}

impl LimitSide {
    /// Its key in documents.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::AtLeast => "at_least",
            Self::AtMost => "at_most",
        }
    }

    /// One where more is worse, minus one where less is.
    const fn sign(self) -> f64 {
        match self {
            Self::AtLeast => -1.0,
            Self::AtMost => 1.0,
        }
    }
}

impl DesignLimit {
    /// Whether a value of its measure, in SI, keeps it but for rounding.
    #[must_use]
    pub fn holds(&self, value: f64) -> bool {
        self.excess(value) <= 1e-6
    }

    fn is_of_slope(&self) -> bool {
        self.measure == Measure::LimitSlope
    }

    /// By how much something misses it, over the measure's size; not above 0 where it keeps it.
    fn excess(&self, value: f64) -> f64 {
        self.side.sign() * (value - self.bound) / size_in_si(self.measure)
    }
}

impl DesignStudy {
    /// How many soils are drawn for a search.
    pub const SAMPLES: u32 = 40;
    /// How many are drawn in the end.
    pub const FRESH_SAMPLES: u32 = 200;

    /// The study of a task.
    ///
    /// * `is_nominal`: whether soils are taken as their documents have them
    #[must_use]
    pub fn of(task: DesignTask, is_nominal: bool, seed: u64) -> Self {
        Self { task, is_nominal, seed }
    }

    /// Whether any limit is kept with a probability.
    #[must_use]
    pub fn is_uncertain(&self) -> bool {
        let all = self.task.candidates.iter().flat_map(|it| &it.grounds);
        !self.is_nominal && all.into_iter().any(|it| it.scenario.soils_of_bands().is_some())
    }

    /// The least of the aim.
    ///
    /// # Errors
    /// [`NoDesign`] where no design moves, none keeps all limits, or no soil can be drawn.
    pub fn design(&self) -> Result<BestDesign, NoDesign> {
        self.design_while(&|| true)
    }

    /// The same, as long as it is to go on.
    ///
    /// # Errors
    /// The same as [`design`](Self::design), and [`NoDesign::Stopped`].
    pub fn design_while(&self, go_on: GoOn<'_>) -> Result<BestDesign, NoDesign> {
        self.least(&Sought { weights: &self.task.weights, extra: None, near: None, go_on })
    }

    /// The designs between the best of one measure and the best of another: each has the best of the
    /// first with no worse than so much of the second.
    ///
    /// # Errors
    /// The same as [`design_while`](Self::design_while), where one of the two ends has none.
    pub fn trade_off(
        &self,
        measures: [Measure; 2],
        count: usize,
        go_on: GoOn<'_>,
    ) -> Result<Vec<BestDesign>, NoDesign> {
        let weights = measures.map(|measure| {
            let mut weights = [0.0; Measure::COUNT];
            weights[measure.place()] = if measure.is_to_be_large() { -1.0 } else { 1.0 };
            weights
        });
        let of = |weights| Sought { weights, extra: None, near: None, go_on };
        let [first, last] = [self.least(&of(&weights[0]))?, self.least(&of(&weights[1]))?];
        let second = measures[1];
        let side = if second.is_to_be_large() { LimitSide::AtLeast } else { LimitSide::AtMost };
        let [from, to] = [&first, &last].map(|end| end.measures[second.place()]);
        let mut designs = vec![first];
        for number in 1..count.saturating_sub(1) {
            let share = number as f64 / (count - 1) as f64;
            let bound = from + share * (to - from);
            let extra = Some(DesignLimit { ground: 0, measure: second, side, bound });
            match self.least(&Sought { extra, near: designs.last(), ..of(&weights[0]) }) {
                Ok(design) => designs.push(design),
                Err(NoDesign::Stopped) => return Err(NoDesign::Stopped),
                Err(_) => {}
            }
        }
        designs.push(last);
        Ok(designs)
    }

    /// The rover with the numbers of a design.
    #[must_use]
    pub fn rover(&self, design: &BestDesign) -> Option<Rover> {
        let ground = self.task.candidates[design.candidate].grounds.first()?;
        let numbers = design.numbers.iter().map(|(key, value)| (&**key, *value));
        Some(ground.scenario.value.with(numbers).ok()?.rover)
    }

    /// Where a rover with other numbers is outside of what models and soils were tested for: on each
    /// ground, on the soil as its document has it, each flag once.
    ///
    /// * `model`: instead of each ground's own
    #[must_use]
    pub fn findings(
        &self,
        candidate: usize,
        values: &[f64],
        model: Option<&Model>,
    ) -> Vec<Finding> {
        let candidate = &self.task.candidates[candidate];
        let Some(numbers) = measured::numbers(&self.task.free, candidate, values) else {
            return Vec::new();
        };
        let grounds = candidate.grounds.iter().map(MeasuredGround::nominal);
        let mut found: Vec<Finding> = grounds
            .flat_map(|ground| match model {
                Some(model) => ground.with_model(model).findings(&numbers),
                None => ground.findings(&numbers),
            })
            .collect();
        found.sort_by_key(|finding| finding.flag);
        found.dedup_by_key(|finding| finding.flag);
        found
    }

    /// What a rover measures with other numbers, by a model and the soils as documents have them;
    /// nothing where it does not move.
    #[must_use]
    pub fn nominal_measures(
        &self,
        candidate: usize,
        values: &[f64],
        model: &Model,
    ) -> Option<Measures> {
        let candidate = &self.task.candidates[candidate];
        let numbers = measured::numbers(&self.task.free, candidate, values)?;
        let ground = MeasuredGround::nominal(candidate.grounds.first()?).with_model(model);
        Some(ground.where_crossed(ground.measures(&numbers).pop()??))
    }

    /// The best of the rovers that may be chosen.
    fn least(&self, sought: &Sought<'_>) -> Result<BestDesign, NoDesign> {
        let (mut best, mut none): (Option<BestDesign>, Vec<NoDesign>) = (None, Vec::new());
        for place in 0..self.task.candidates.len() {
            match DesignSearch::of(self, place, sought, self.is_nominal)?.design() {
                Ok(design) if best.as_ref().is_none_or(|it| design.objective < it.objective) => {
                    best = Some(design);
                }
                Ok(_) => {}
                Err(why) => none.push(why),
            }
            if !(sought.go_on)() {
                return Err(NoDesign::Stopped);
            }
        }
        let nearer = |one: &NoDesign| match one {
            NoDesign::Unreachable(nearest) => {
                nearest.missed.iter().map(|(limit, value)| limit.excess(*value)).fold(0.0, f64::max)
            }
            _ => f64::INFINITY,
        };
        best.ok_or_else(|| {
            let nearest =
                none.into_iter().min_by(|one, other| nearer(one).total_cmp(&nearer(other)));
            nearest.unwrap_or(NoDesign::NothingMoves)
        })
    }
}

/// What a search is for.
#[derive(Clone, Copy)]
struct Sought<'a> {
    /// The weights of the aim, each over one in its unit.
    weights: &'a [f64],
    /// A limit beside those that are stated.
    extra: Option<DesignLimit>,
    /// A design that may lie near the least.
    near: Option<&'a BestDesign>,
    go_on: GoOn<'a>,
}

/// A search over the numbers of one rover.
struct DesignSearch<'a> {
    study: &'a DesignStudy,
    place: usize,
    candidate: &'a RoverChoice,
    sought: &'a Sought<'a>,
    /// What the aim is counted in.
    aim_size: f64,
    limits: Vec<DesignLimit>,
    /// How many of them the task has.
    stated: usize,
    /// How many standard deviations each limit keeps off its bound.
    scores: Vec<f64>,
    grounds: Vec<MeasuredGround>,
}

/// The mean of a measure over samples, and its standard deviation.
#[derive(Clone, Copy, Debug, Default)]
struct Moments {
    mean: f64,
    deviation: f64,
}

/// A measure of each sample of a ground.
fn each(samples: &[Measures], measure: Measure) -> impl Iterator<Item = f64> + Clone {
    samples.iter().map(move |it| it[measure.place()])
}

impl Moments {
    fn of(samples: &[Measures], measure: Measure) -> Self {
        let values = each(samples, measure);
        let count = values.clone().count() as f64;
        let mean = values.clone().sum::<f64>() / count;
        let variance = values.map(|it| (it - mean).powi(2)).sum::<f64>() / count;
        Self { mean, deviation: variance.sqrt() }
    }
}

impl<'a> DesignSearch<'a> {
    fn of(
        study: &'a DesignStudy,
        place: usize,
        sought: &'a Sought<'a>,
        is_nominal: bool,
    ) -> Result<Self, NoDesign> {
        let candidate = &study.task.candidates[place];
        let grounds = candidate.grounds.iter().map(|there| {
            if is_nominal {
                return Ok(MeasuredGround::nominal(there));
            }
            MeasuredGround::drawn(there, study.seed, DesignStudy::SAMPLES)
        });
        let grounds = grounds.collect::<Result<Vec<MeasuredGround>, NothingAccepted>>()?;
        let sizes = Measure::ALL.into_iter().zip(sought.weights);
        let aim_size = sizes.map(|(measure, weight)| weight.abs() * size(measure)).sum();
        let own = limits_of(&study.task, candidate);
        let stated = own.len();
        let limits: Vec<DesignLimit> = own.into_iter().chain(sought.extra).collect();
        let score = |limit: &DesignLimit| {
            let is_uncertain = grounds[limit.ground].is_uncertain();
            if is_uncertain { normal_score(study.task.probability) } else { 0.0 }
        };
        // What is traded is bounded by its mean.
        let scores = limits[..stated].iter().map(score).chain(sought.extra.map(|_| 0.0)).collect();
        Ok(Self { study, place, candidate, sought, aim_size, limits, stated, scores, grounds })
    }

    /// Whether each design is measured by samples.
    fn is_sampled(&self) -> bool {
        self.grounds.iter().any(MeasuredGround::is_uncertain)
    }

    fn effort(&self) -> Effort {
        if self.is_sampled() { Effort::SAMPLED } else { Effort::SMOOTH }
    }

    fn design(self) -> Result<BestDesign, NoDesign> {
        self.check_ground()?;
        let starts = self.starts();
        self.check_aim(&starts)?;
        if self.is_sampled() {
            return self.design_by_samples(&starts);
        }
        let (best, agreed) = self.search(&starts)?;
        let certificate = self.certificate(&best, starts.len(), agreed);
        self.found(&best, certificate)
    }

    /// The design where soils are uncertain.
    fn design_by_samples(mut self, starts: &[Vec<f64>]) -> Result<BestDesign, NoDesign> {
        /// How often what samples say of a limit is looked up again.
        const LOOKS: usize = 4;
        /// Searches that only show whether it is the least.
        const OTHERS: usize = 2;
        let (mut best, _) = self.search(&[self.without_samples(starts)?])?;
        for _ in 0..LOOKS {
            if !self.look_up_scores(&best) {
                break;
            }
            (best, _) = self.search(std::slice::from_ref(&best.point))?;
        }
        let is_alone = self.sought.near.is_none();
        let others: &[Vec<f64>] = if is_alone { &starts[starts.len() - OTHERS..] } else { &[] };
        let all = [std::slice::from_ref(&best.point), others].concat();
        let (best, agreed) = self.search(&all)?;
        let certificate = self.certificate(&best, all.len(), agreed);
        self.found(&best, certificate)
    }

    /// Where the least is without samples, or what is nearest to keeping limits there.
    fn without_samples(&self, starts: &[Vec<f64>]) -> Result<Vec<f64>, NoDesign> {
        if let Some(near) = self.near() {
            return Ok(near);
        }
        let nominal = DesignSearch::of(self.study, self.place, self.sought, true)?;
        match nominal.search(starts) {
            Ok((best, _)) => Ok(best.point),
            Err(NoDesign::Unreachable(nearest)) => Ok(self.point(&nearest.values)),
            Err(NoDesign::Stopped) => Err(NoDesign::Stopped),
            Err(_) => Ok(starts[0].clone()),
        }
    }

    /// The least that searches come to, and how many come to it.
    fn search(&self, starts: &[Vec<f64>]) -> Result<(Minimum, usize), NoDesign> {
        let effort = self.effort();
        let from = |start: &Vec<f64>| {
            let found = slsqp::minimum(self, start, effort);
            // One that cannot keep its limits from there is led to where they are kept first.
            let nearest = || self.nearest(start).filter(|it| it.excess == 0.0);
            found.or_else(|| slsqp::minimum(self, &nearest()?.point, effort))
        };
        let found: Vec<Option<Minimum>> = starts.par_iter().map(from).collect();
        let best =
            found.iter().flatten().min_by(|one, other| one.objective.total_cmp(&other.objective));
        let Some(best) = best.cloned() else { return Err(self.why_none(starts)) };
        let apart = if self.is_sampled() { AGREED_BY_SAMPLES } else { AGREED };
        let agrees = |it: &&Minimum| {
            (it.objective - best.objective).abs() <= apart * best.objective.abs().max(1.0)
        };
        let agreed = found.iter().flatten().filter(agrees).count();
        Ok((best, agreed))
    }

    /// Where searches start: a design that may be near, the rover's own numbers, then points spread
    /// over the bounds.
    fn starts(&self) -> Vec<Vec<f64>> {
        /// Searches from points that are spread.
        const SPREAD: usize = 4;
        let own = self.point(&self.candidate.given);
        self.near().into_iter().chain([own]).chain(spread(self.free()).take(SPREAD)).collect()
    }

    /// The design that may be near, if it is one of this rover.
    fn near(&self) -> Option<Vec<f64>> {
        let near = self.sought.near.filter(|it| it.candidate == self.place)?;
        Some(self.point(&near.values))
    }

    /// The point of the unit cube that has some free numbers, or the next to them.
    fn point(&self, values: &[f64]) -> Vec<f64> {
        let ends = self.study.task.free.iter().map(|(_, ends)| ends);
        let share = |(value, [least, most]): (&f64, &[f64; 2])| (value - least) / (most - least);
        values.iter().zip(ends).map(share).map(|share| share.clamp(0.0, 1.0)).collect()
    }

    /// The free numbers at a point of the unit cube, in their keys' units.
    fn values(&self, point: &[f64]) -> Vec<f64> {
        let pairs = self.study.task.free.iter().zip(point);
        pairs.map(|((_, [least, most]), share)| least + share * (most - least)).collect()
    }

    /// What every sample measures on every ground; nothing where the numbers are no rover, or where too
    /// few samples move.
    fn measured(&self, point: &[f64]) -> Option<Vec<Vec<Measures>>> {
        if !(self.sought.go_on)() {
            return None;
        }
        let values = self.values(point);
        let numbers = measured::numbers(&self.study.task.free, self.candidate, &values)?;
        let of_ground = |ground: &MeasuredGround| {
            let all: Vec<Measures> = ground.measures(&numbers).into_iter().flatten().collect();
            let enough = all.len() as f64 >= self.study.task.probability * ground.count() as f64;
            (enough && !all.is_empty()).then_some(all)
        };
        self.grounds.iter().map(of_ground).collect()
    }

    /// The aim, over its size.
    fn aim(&self, measured: &[Vec<Measures>]) -> f64 {
        let of = |measure: Measure| measure.unit().from_si(Moments::of(&measured[0], measure).mean);
        let weights =
            Measure::ALL.into_iter().zip(self.sought.weights).filter(|(_, it)| **it != 0.0);
        weights.map(|(measure, weight)| weight * of(measure)).sum::<f64>() / self.aim_size
    }

    /// What a limit is on: a measure's mean, and so many deviations from it.
    fn limited(&self, limit: usize, measured: &[Vec<Measures>]) -> f64 {
        let (limit, score) = (&self.limits[limit], self.scores[limit]);
        let Moments { mean, deviation } = Moments::of(&measured[limit.ground], limit.measure);
        mean + limit.side.sign() * score * deviation
    }

    fn excesses(&self, measured: &[Vec<Measures>]) -> Vec<f64> {
        let of = |place: usize| self.limits[place].excess(self.limited(place, measured));
        (0..self.limits.len()).map(of).collect()
    }

    /// Aim and limits of a design.
    fn outcome(&self, point: &[f64]) -> Option<Vec<f64>> {
        let measured = self.measured(point)?;
        let aim = self.aim(&measured);
        Some(std::iter::once(aim).chain(self.excesses(&measured)).collect())
    }

    /// Looks up how many deviations each limit has to keep off for the share of samples that is
    /// asked for; whether any has changed.
    fn look_up_scores(&mut self, best: &Minimum) -> bool {
        /// What is exact enough, over a measure's size [-].
        const EXACT: f64 = 2e-3;
        let Some(measured) = self.measured(&best.point) else { return false };
        let (mut scores, mut has_changed) = (self.scores.clone(), false);
        for (place, limit) in self.limits[..self.stated].iter().enumerate() {
            let ground = &self.grounds[limit.ground];
            if !ground.is_uncertain() {
                continue;
            }
            let sign = limit.side.sign();
            let samples = &measured[limit.ground];
            let Moments { mean, deviation } = Moments::of(samples, limit.measure);
            if deviation <= 1e-9 * size_in_si(limit.measure) {
                continue;
            }
            let all = each(samples, limit.measure);
            let mut worse: Vec<f64> = all.map(|it| sign * (it - mean) / deviation).collect();
            worse.sort_by(f64::total_cmp);
            let asked = self.study.task.probability * ground.count() as f64;
            let kept = (1..worse.len()).find(|count| *count as f64 >= asked);
            let score = worse[kept.unwrap_or(worse.len()) - 1];
            let change = (score - self.scores[place]).abs() * deviation;
            has_changed |= change > EXACT * size_in_si(limit.measure);
            scores[place] = score;
        }
        if has_changed {
            self.scores = scores;
        }
        has_changed
    }

    fn found(&self, best: &Minimum, certificate: Certificate) -> Result<BestDesign, NoDesign> {
        let values = self.values(&best.point);
        let numbers = measured::numbers(&self.study.task.free, self.candidate, &values);
        let (Some(measured), Some(numbers)) = (self.measured(&best.point), numbers) else {
            return Err(NoDesign::NothingMoves);
        };
        let mean = |measure: Measure| Moments::of(&measured[0], measure).mean;
        let fresh = self.fresh(&numbers)?;
        let kept = self.limits.iter().enumerate().map(|(place, limit)| {
            let multiplier = best.multipliers.get(place).copied().unwrap_or(0.0);
            KeptLimit {
                limit: *limit,
                value: self.limited(place, &measured),
                price: multiplier * self.aim_size / size(limit.measure),
                share: fresh[limit.ground].as_ref().map(|all| share(limit, all)),
            }
        });
        Ok(BestDesign {
            candidate: self.place,
            objective: best.objective * self.aim_size,
            measures: Measure::ALL.map(mean),
            kept: kept.collect(),
            values,
            numbers,
            certificate,
        })
    }

    /// What samples measure that took no part, on each ground that is uncertain.
    fn fresh(
        &self,
        numbers: &[(String, f64)],
    ) -> Result<Vec<Option<Vec<Option<Measures>>>>, NothingAccepted> {
        let of_ground = |(place, ground): (usize, &MeasuredGround)| {
            if !ground.is_uncertain() {
                return Ok(None);
            }
            let there = &self.candidate.grounds[place];
            let seed = self.study.seed.wrapping_add(1);
            let fresh = MeasuredGround::drawn(there, seed, DesignStudy::FRESH_SAMPLES)?;
            let measured = fresh.measures(numbers).into_iter();
            Ok(Some(measured.map(|it| Some(fresh.where_crossed(it?))).collect()))
        };
        self.grounds.iter().enumerate().map(of_ground).collect()
    }

    /// Looks at designs around the best, 1 % of the bounds away along each number and between.
    fn certificate(&self, best: &Minimum, starts: usize, agreed: usize) -> Certificate {
        /// How far away, over the bounds [-].
        const AWAY: f64 = 0.01;
        /// Better by less than this is rounding, over the aim's size; and where searches among samples
        /// end [-].
        const ROUNDING: [f64; 2] = [1e-6, 1e-3];
        /// Designs in all directions; fewer where each is measured by samples.
        const DIRECTIONS: [usize; 2] = [60, 20];
        let along = (0..self.free()).flat_map(|axis| {
            [0.0, 1.0].map(move |side| {
                (0..self.free()).map(move |it| if it == axis { side } else { 0.5 })
            })
        });
        let along = along.map(Iterator::collect::<Vec<f64>>);
        let cost = usize::from(self.is_sampled());
        let (directions, rounding) = (DIRECTIONS[cost], ROUNDING[cost]);
        let shares: Vec<Vec<f64>> = along.chain(spread(self.free()).take(directions)).collect();
        let is_better = |share: &&Vec<f64>| {
            let moved = best.point.iter().zip(*share);
            let moved = moved.map(|(it, share)| (it + AWAY * (2.0 * share - 1.0)).clamp(0.0, 1.0));
            let outcome = self.outcome(&moved.collect::<Vec<f64>>());
            outcome.is_some_and(|outcome| {
                outcome[0] < best.objective - rounding && outcome[1..].iter().all(|it| *it <= 0.0)
            })
        };
        let better = shares.par_iter().filter(is_better).count();
        Certificate { starts, agreed, probes: shares.len(), better }
    }

    /// Checks that every ground stands where a slope is to be crossed: whatever the rover, none
    /// crosses another.
    fn check_ground(&self) -> Result<(), NoDesign> {
        let to_cross = |it: &&DesignLimit| it.is_of_slope() && it.side == LimitSide::AtLeast;
        for limit in self.limits.iter().filter(to_cross) {
            let stands = self.grounds[limit.ground].strength();
            if limit.bound > stands {
                return Err(NoDesign::BeyondGround { limit: *limit, stands });
            }
        }
        Ok(())
    }

    /// Whether what is free acts on the aim at any start.
    fn check_aim(&self, starts: &[Vec<f64>]) -> Result<(), NoDesign> {
        let mut aims = starts.iter().filter_map(|start| Some(self.aim(&self.measured(start)?)));
        let Some(first) = aims.next() else { return Ok(()) };
        let mut others = aims.peekable();
        if others.peek().is_some() && others.all(|aim| aim == first) {
            return Err(NoDesign::Constant);
        }
        Ok(())
    }

    /// The point from a start that comes nearest to keeping all limits. Slopes are climbed first: on
    /// one that is not crossed nothing else has a meaning.
    fn nearest(&self, start: &[f64]) -> Option<NearestPoint> {
        let climbed = self.nearest_of(start, DesignLimit::is_of_slope)?;
        if climbed.excess > 0.0 { Some(climbed) } else { self.nearest_of(&climbed.point, |_| true) }
    }

    /// The point from a start that misses the worst of some limits by the least.
    fn nearest_of(
        &self,
        start: &[f64],
        is_meant: fn(&DesignLimit) -> bool,
    ) -> Option<NearestPoint> {
        let excesses = self.outcome(start)?;
        let meant = self.limits.iter().zip(&excesses[1..]).filter(|(limit, _)| is_meant(limit));
        let worst = meant.map(|(_, excess)| *excess).fold(0.0, f64::max);
        let elastic = Elastic { search: self, is_meant, most: 2.0 * worst.max(1.0) };
        let mut point = start.to_vec();
        point.push(worst / elastic.most);
        let found = slsqp::minimum(&elastic, &point, self.effort())?;
        // What is missed by less than the search is exact to is kept.
        let exact = 1000.0 * self.effort().accuracy;
        let excess = if found.objective < exact { 0.0 } else { found.objective };
        Some(NearestPoint { point: found.point[..self.free()].to_vec(), excess, is_meant })
    }

    /// Why no search found a design: which limits the nearest one misses.
    fn why_none(&self, starts: &[Vec<f64>]) -> NoDesign {
        if !(self.sought.go_on)() {
            return NoDesign::Stopped;
        }
        let nearest: Vec<NearestPoint> =
            starts.par_iter().filter_map(|start| self.nearest(start)).collect();
        let crosses = |it: &&NearestPoint| self.limits.iter().all(it.is_meant);
        let by_excess =
            |one: &&NearestPoint, other: &&NearestPoint| one.excess.total_cmp(&other.excess);
        let of_all = nearest.iter().filter(crosses).min_by(by_excess);
        let Some(nearest) = of_all.or_else(|| nearest.iter().min_by(by_excess)) else {
            let moves = starts.iter().any(|start| self.measured(start).is_some());
            return if moves { NoDesign::NotFound } else { NoDesign::NothingMoves };
        };
        let Some(measured) = self.measured(&nearest.point) else { return NoDesign::NothingMoves };
        let all = self.limits.iter().enumerate().filter(|(_, limit)| (nearest.is_meant)(limit));
        let all = all.map(|(place, limit)| (*limit, self.limited(place, &measured)));
        let missed: Vec<(DesignLimit, f64)> =
            all.filter(|(limit, value)| !limit.holds(*value)).collect();
        if missed.is_empty() {
            return NoDesign::NotFound;
        }
        NoDesign::Unreachable(Box::new(Nearest {
            candidate: self.place,
            values: self.values(&nearest.point),
            missed,
        }))
    }
}

/// Searches that differ by less came to one design [-].
const AGREED: f64 = 1e-4;
/// The same of means over samples, whose kinks end searches early [-].
const AGREED_BY_SAMPLES: f64 = 1e-3;

/// The limits on every ground; that the slope is crossed is one, unless a stricter one is stated.
fn limits_of(task: &DesignTask, candidate: &RoverChoice) -> Vec<DesignLimit> {
    let of_ground = |(ground, slope): (usize, f64)| {
        let both = Measure::ALL.into_iter().zip(task.limits).flat_map(move |(measure, ends)| {
            let least = match measure {
                Measure::LimitSlope if slope > 0.0 => ends.least.max(slope),
                _ => ends.least,
            };
            let of = |side, bound| DesignLimit { ground, measure, side, bound };
            [of(LimitSide::AtLeast, least), of(LimitSide::AtMost, ends.most)]
        });
        // What no ground changes is limited once.
        both.filter(move |it| it.bound.is_finite() && (ground == 0 || !it.measure.is_of_rover()))
    };
    let slopes = candidate.grounds.iter().map(|there| there.slope);
    slopes.enumerate().flat_map(of_ground).collect()
}

/// The share of samples that keeps a limit; one that does not move keeps none.
fn share(limit: &DesignLimit, samples: &[Option<Measures>]) -> f64 {
    let keeps =
        |it: &&Option<Measures>| it.is_some_and(|it| limit.holds(it[limit.measure.place()]));
    samples.iter().filter(keeps).count() as f64 / samples.len() as f64
}

/// Points that fill the unit cube evenly.
fn spread(dimensions: usize) -> impl Iterator<Item = Vec<f64>> {
    /// More than are asked for.
    const POINTS: u64 = 128;
    let set = points::Design { sampling: Sampling::Sobol, points: POINTS, dimensions, seed: 1 };
    (0..POINTS).map(move |index| set.point(index))
}

impl Smooth for DesignSearch<'_> {
    fn free(&self) -> usize {
        self.study.task.free.len()
    }

    fn constraints(&self) -> usize {
        self.limits.len()
    }

    fn results(&self, point: &[f64]) -> Option<Vec<f64>> {
        self.outcome(point)
    }

    fn gradients(&self, point: &[f64], here: &[f64]) -> Option<Vec<Vec<f64>>> {
        let by = if self.is_sampled() {
            self.differences(point, here)?
        } else {
            let variable =
                |value: &f64| Variable { value: *value, scale: 1.0, range: Span::new(0.0, 1.0) };
            let variables: Vec<Variable> = point.iter().map(variable).collect();
            let sizes = vec![1.0; here.len()];
            let mut evaluate =
                |points: &[Vec<f64>]| points.par_iter().map(|it| self.outcome(it)).collect();
            let found = derivatives(&variables, here, &sizes, StepLengths::SETTLED, &mut evaluate);
            let slopes =
                |by: Vec<Derivative>| -> Vec<f64> { by.into_iter().map(|it| it.value).collect() };
            found.by_variable.into_iter().map(|by| by.map(slopes)).collect::<Option<_>>()?
        };
        let gradient = |result: usize| -> Vec<f64> { by.iter().map(|of| of[result]).collect() };
        Some((0..here.len()).map(gradient).collect())
    }
}

impl DesignSearch<'_> {
    /// Derivatives by each free number, to one side: means over samples have kinks everywhere, of
    /// which none counts for much.
    fn differences(&self, point: &[f64], here: &[f64]) -> Option<Vec<Vec<f64>>> {
        /// The step, over the bounds [-].
        const STEP: f64 = 1e-4;
        let by = |axis: usize| -> Option<Vec<f64>> {
            let step = if point[axis] + STEP > 1.0 { -STEP } else { STEP };
            let mut moved = point.to_vec();
            moved[axis] += step;
            let there = self.outcome(&moved)?;
            Some(there.iter().zip(here).map(|(there, here)| (there - here) / step).collect())
        };
        (0..self.free()).into_par_iter().map(by).collect()
    }
}

/// A point that comes near to keeping limits.
struct NearestPoint {
    /// Where it is, in the unit cube.
    point: Vec<f64>,
    /// By how much it misses the worst of them, over its size; 0 where it keeps them.
    excess: f64,
    /// Which limits were looked at.
    is_meant: fn(&DesignLimit) -> bool,
}

/// The least by which the worst of some limits is missed: a last number that each may be missed by.
struct Elastic<'a> {
    search: &'a DesignSearch<'a>,
    is_meant: fn(&DesignLimit) -> bool,
    /// What the last number is a share of.
    most: f64,
}

impl Smooth for Elastic<'_> {
    fn free(&self) -> usize {
        self.search.free() + 1
    }

    fn constraints(&self) -> usize {
        self.search.constraints()
    }

    fn results(&self, point: &[f64]) -> Option<Vec<f64>> {
        let (share, own) = point.split_last()?;
        let slack = share * self.most;
        let limits = self.search.limits.iter();
        let excesses = self.search.outcome(own)?.split_off(1).into_iter().zip(limits);
        // What is not meant is kept, whatever the point.
        let constraint = |(excess, limit): (f64, &DesignLimit)| {
            if (self.is_meant)(limit) { excess - slack } else { -1.0 }
        };
        Some(std::iter::once(slack).chain(excesses.map(constraint)).collect())
    }

    fn gradients(&self, point: &[f64], _: &[f64]) -> Option<Vec<Vec<f64>>> {
        let own = &point[..self.search.free()];
        let here = self.search.outcome(own)?;
        let mut gradients = self.search.gradients(own, &here)?;
        let [aim, limits @ ..] = &mut gradients[..] else { return None };
        aim.fill(0.0);
        aim.push(self.most);
        for (limit, gradient) in self.search.limits.iter().zip(limits) {
            let is_meant = (self.is_meant)(limit);
            if !is_meant {
                gradient.fill(0.0);
            }
            gradient.push(if is_meant { -self.most } else { 0.0 });
        }
        Some(gradients)
    }
}
