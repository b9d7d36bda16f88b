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

mod answer;
mod limits;
mod measured;
mod nearest;
mod problem;
mod search;
mod slsqp;

use grouser_io::Described as _;
use grouser_io::design::Measure;
use grouser_io::design_task::DesignTask;

pub use self::answer::{BestDesign, Certificate, KeptLimit, Nearest, NoDesign};
use self::limits::size;
pub use self::limits::{DesignLimit, LimitSide};
use self::measured::MeasuredGround;
pub use self::measured::Measures;
pub use self::problem::GoOn;
use self::problem::{DesignProblem, Sought};
use crate::contact::Model;
use crate::contact::validity::Finding;
use crate::vehicle::Rover;

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

impl DesignStudy {
    /// How many soils are drawn for a search.
    pub const SAMPLES: u32 = DesignProblem::SAMPLES;
    /// How many are drawn in the end.
    pub const FRESH_SAMPLES: u32 = DesignProblem::FRESH_SAMPLES;

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

    /// The least of the aim, searched while `go_on` is true.
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
        /// What the other measure counts, which decides between designs that are alike in the one, over
        /// the sizes of both [-].
        const OTHER: f64 = 1e-6;
        let of_ends = [measures, [measures[1], measures[0]]];
        let weights = of_ends.map(|[one, other]| {
            let mut weights = [0.0; Measure::COUNT];
            let sign = |it: Measure| if it.is_to_be_large() { -1.0 } else { 1.0 };
            weights[one.place()] = sign(one);
            weights[other.place()] = sign(other) * OTHER * size(one) / size(other);
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
        let Some(numbers) = measured::numbers(&self.task, candidate, values) else {
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
        let numbers = measured::numbers(&self.task, candidate, values)?;
        let ground = MeasuredGround::nominal(candidate.grounds.first()?).with_model(model);
        Some(ground.where_crossed(ground.measures(&numbers).pop()??))
    }

    /// The best of the rovers that may be chosen.
    fn least(&self, sought: &Sought<'_>) -> Result<BestDesign, NoDesign> {
        let (mut best, mut none): (Option<BestDesign>, Vec<NoDesign>) = (None, Vec::new());
        for place in 0..self.task.candidates.len() {
            let problem = DesignProblem::of(&self.task, self.seed, place, sought, self.is_nominal)?;
            match problem.design() {
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
