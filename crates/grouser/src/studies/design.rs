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
mod nearest;
mod search;
mod slsqp;

use grouser_io::Described as _;
use grouser_io::design::Measure;
use grouser_io::design_task::DesignTask;
use grouser_io::statistics::NothingAccepted;

use self::measured::MeasuredGround;
pub use self::measured::Measures;
use self::search::{DesignSearch, Sought};
use crate::contact::Model;
use crate::contact::validity::Finding;
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
    /// On which ground, as numbered in
    /// [`RoverChoice::grounds`](grouser_io::design_task::RoverChoice::grounds).
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
