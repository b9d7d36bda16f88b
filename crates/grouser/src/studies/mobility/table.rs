//! Motions along one course, by slope.

use rayon::prelude::*;

use super::detail::Detail;
use super::median_slip::MedianSlip;
use super::thresholds::{Beyond, Thresholds};
use crate::elementary::wide::sin;
use crate::error::ParameterError;
use crate::studies::ensemble::samples::Sample;
use crate::studies::heading::{HeadingCurve, HeadingOffset};
use crate::studies::verdict::SlopeStudy;

/// The steady motion of a rover on a slope along a course.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mobility {
    /// Crab angle, *c* [rad]: how far the nose points uphill of the course.
    pub crab: f64,
    /// Slip ratio of every wheel, *s* [-].
    pub slip_ratio: f64,
    /// Mean sinkage of the wheels [m].
    pub sinkage: f64,
    /// Power of the wheels [W].
    pub power: f64,
    /// Power that motors, and with a battery the electronics, draw [W]; NaN where no motor is known.
    pub drawn_power: f64,
    /// Speed along the course [m/s].
    pub speed: f64,
    /// Drift downhill per metre of way, if the nose pointed along the course instead [m/m]; NaN
    /// where nothing holds the rover then.
    pub drift: f64,
}

/// Motions along one course on all slopes of one soil.
#[derive(Clone, Debug, PartialEq)]
pub struct MobilityTable {
    course: f64,
    /// The steepest slope on which a heading holds the course [rad]; none where the rover cannot
    /// move.
    limit: Option<f64>,
    nodes: Vec<Mobility>,
    largest_errors: Mobility,
    thresholds: Thresholds,
}

/// What a table says of a slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnSlope {
    /// The motion, if a heading holds the course.
    pub motion: Option<Mobility>,
    /// In which share of the samples no heading holds the course, or it slips more than the rule
    /// allows [-]; over the samples for which that is known, NaN where there is none.
    pub probability_no_go: f64,
}

impl SlopeStudy {
    /// The table of a course; `None` if `go_on` was false before the end. The result is the same
    /// for any number of threads.
    ///
    /// What does the rover do along the contour of 10°, and is that as exact as following its
    /// curve?
    ///
    /// ```
    /// use grouser::document::{self, Overrides, Source};
    /// use grouser::studies::verdict::SlopeStudy;
    /// use grouser::units::deg;
    ///
    /// let scenario = document::read_scenario(&Source::default_scenario(), &Overrides::none())?;
    /// let study = SlopeStudy::of(&scenario);
    /// let table = study.table(0.0, &[], &|| true)?.expect("not stopped");
    /// let motion = table.at(deg(10.0)).motion.expect("a heading holds the contour");
    /// let exact = study.heading.curve()?.at(deg(10.0))?;
    /// assert!((motion.crab - exact.yaw).abs() <= table.largest_errors().crab.max(1e-6));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// * `course`: *χ* [rad], −π/2 to π/2, positive uphill
    /// * `samples`: of soil and model; with none the soil as written is judged by
    /// * `go_on`: asked before each sample, from any thread
    ///
    /// # Errors
    /// [`ParameterError`] for a rule, a rim speed or a course out of range, and the first invalid
    /// soil.
    pub fn table(
        &self,
        course: f64,
        samples: &[Sample],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<MobilityTable>, ParameterError> {
        self.table_of(course, samples, Detail::Full, go_on)
    }

    /// The same in as much detail as is needed.
    pub(in crate::studies) fn table_of(
        &self,
        course: f64,
        samples: &[Sample],
        detail: Detail,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<MobilityTable>, ParameterError> {
        self.check()?;
        let curve = self.heading.curve_on(course)?;
        let drift = match detail {
            Detail::Full => Some(self.heading.drift_curve_along(course)?),
            Detail::Rough => None,
        };
        let Some(thresholds) = Thresholds::of(self, course, samples, detail, go_on)? else {
            return Ok(None);
        };
        let limit = curve.limit().ok().map(|(slope, _)| slope);
        let found = Nodes {
            study: self,
            curve: &curve,
            drift: drift.as_ref(),
            limit: limit.unwrap_or(0.0),
            intervals: detail.intervals(),
        };
        let (nodes, largest_errors) =
            limit.map_or_else(Default::default, |_| (found.all(), Mobility::default()));
        let mut table = MobilityTable { course, limit, nodes, largest_errors, thresholds };
        if limit.is_some() && detail == Detail::Full {
            table.largest_errors = found.largest_errors(&table);
        }
        Ok(Some(table))
    }
}

/// Where the numbers of a table come from.
struct Nodes<'a> {
    study: &'a SlopeStudy,
    curve: &'a HeadingCurve,
    drift: Option<&'a HeadingCurve>,
    limit: f64,
    intervals: usize,
}

impl Nodes<'_> {
    fn all(&self) -> Vec<Mobility> {
        let places: Vec<f64> = (0..=self.intervals).map(|node| node as f64).collect();
        let mut nodes: Vec<Mobility> =
            places.par_iter().map(|it| self.motion(it / self.intervals as f64)).collect();
        // A slope at which no point of the curve is found, as one of rounding at its end, is as its
        // neighbour.
        for place in 1..nodes.len() {
            if nodes[place].slip_ratio.is_nan() {
                nodes[place] = nodes[place - 1];
            }
        }
        nodes
    }

    /// The motion at a place of the table, *v*.
    fn motion(&self, v: f64) -> Mobility {
        let slope = self.limit * v * (2.0 - v);
        let none = Mobility { slip_ratio: f64::NAN, ..Mobility::default() };
        self.curve.at(slope).map_or(none, |heading| self.of(slope, &heading))
    }

    fn of(&self, slope: f64, heading: &HeadingOffset) -> Mobility {
        let study = self.study;
        let drifting = self.drift.and_then(|curve| curve.at(slope).ok());
        let drift = drifting.map_or(f64::NAN, |it| sin(it.crab()));
        let drawn = heading.drawn_power(&study.heading.rover, study.rim_speed);
        Mobility {
            crab: heading.crab(),
            slip_ratio: heading.slip_ratio,
            sinkage: heading.mean_sinkage(),
            power: heading.power(&study.heading.rover, study.rim_speed),
            drawn_power: drawn.unwrap_or(f64::NAN),
            speed: study.rim_speed / heading.speed_ratio(),
            drift,
        }
    }

    /// The largest differences from the curve half-way between nodes.
    fn largest_errors(&self, table: &MobilityTable) -> Mobility {
        /// Number of intervals of which one is looked at.
        const EVERY: usize = 16;
        let middles: Vec<f64> =
            (0..self.intervals).step_by(EVERY).map(|at| at as f64 + 0.5).collect();
        let errors = middles.par_iter().filter_map(|middle| {
            let v = middle / self.intervals as f64;
            let (exact, read) = (self.motion(v), table.between_nodes(*middle));
            (!exact.slip_ratio.is_nan())
                .then(|| exact.with(&read, |one, other| (one - other).abs()))
        });
        errors
            .collect::<Vec<_>>()
            .iter()
            .fold(Mobility::default(), |worst, it| worst.with(it, f64::max))
    }
}

impl Mobility {
    /// Each number of this one and another's.
    pub(super) fn with(&self, other: &Self, of: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            crab: of(self.crab, other.crab),
            slip_ratio: of(self.slip_ratio, other.slip_ratio),
            sinkage: of(self.sinkage, other.sinkage),
            power: of(self.power, other.power),
            drawn_power: of(self.drawn_power, other.drawn_power),
            speed: of(self.speed, other.speed),
            drift: of(self.drift, other.drift),
        }
    }

    /// Work per metre along the course [J/m].
    #[must_use]
    pub fn energy_per_metre(&self) -> f64 {
        self.power / self.speed
    }

    /// What lies between two motions.
    ///
    /// * `share`: of the other, 0 to 1
    #[must_use]
    pub(in crate::studies) fn towards(&self, other: &Self, share: f64) -> Self {
        // One that is not known does not spoil the other.
        self.with(other, |one, other| if share == 0.0 { one } else { one + share * (other - one) })
    }
}

impl MobilityTable {
    /// The course, *χ* [rad].
    #[must_use]
    pub fn course(&self) -> f64 {
        self.course
    }

    /// The steepest slope on which a heading holds the course [rad]; none where the rover cannot
    /// move.
    #[must_use]
    pub fn limit(&self) -> Option<f64> {
        self.limit
    }

    /// How far numbers of the table are from those of the curve, at most: of each kind the largest
    /// difference found half-way between nodes.
    #[must_use]
    pub fn largest_errors(&self) -> &Mobility {
        &self.largest_errors
    }

    /// What the rover does on a slope [rad].
    #[must_use]
    pub fn at(&self, slope: f64) -> OnSlope {
        OnSlope {
            motion: self.motion(slope),
            probability_no_go: self.thresholds.probability_no_go(slope),
        }
    }

    /// The motion on a slope [rad], if a heading holds the course.
    #[must_use]
    pub fn motion(&self, slope: f64) -> Option<Mobility> {
        let limit = self.limit.filter(|limit| slope <= *limit)?;
        let v = if limit > 0.0 { 1.0 - (1.0 - slope / limit).max(0.0).sqrt() } else { 0.0 };
        Some(self.between_nodes(v * (self.nodes.len() - 1) as f64))
    }

    /// The steepest slope at a node on which the rover drifts, instead of sliding [rad].
    pub(super) fn steepest_with_drift(&self) -> Option<f64> {
        let node = self.nodes.iter().rposition(|node| node.drift.is_finite())?;
        let v = node as f64 / (self.nodes.len() - 1) as f64;
        Some(self.limit? * v * (2.0 - v))
    }

    /// The steepest slope of each sample that is no no-go [rad], in the order of the samples; below
    /// 0 where it cannot move at all.
    #[must_use]
    pub fn steepest_of_samples(&self) -> &[f64] {
        &self.thresholds.of_samples
    }

    /// What is beyond the steepest slope of each sample, in the order of the samples.
    pub(in crate::studies) fn beyond(&self) -> &[Beyond] {
        &self.thresholds.beyond
    }

    /// The median over the samples of the slip ratio with which each holds the course on a slope
    /// [rad] by its own heading [-]: 1 in those in which none does, or that slip more than a no-go;
    /// NaN where none is known.
    pub(in crate::studies) fn median_slip(&self, slope: f64) -> f64 {
        self.thresholds.median_slip.at(slope)
    }

    /// Takes for what the samples say the mean of what they say on two other courses.
    pub(in crate::studies) fn set_samples_between(&mut self, one: &Self, other: &Self) {
        let slips = [one, other].map(|it| &it.thresholds.median_slip);
        self.thresholds.median_slip = MedianSlip::between(slips[0], slips[1]);
        let beyond = one.beyond().iter().zip(other.beyond());
        self.thresholds.beyond = beyond.map(|(one, other)| one.and(*other)).collect();
        let pairs = one.steepest_of_samples().iter().zip(other.steepest_of_samples());
        self.thresholds.of_samples =
            pairs.map(|(one, other)| f64::midpoint(*one, *other)).collect();
    }

    /// In which share of the samples a slope [rad] is a no-go [-].
    #[must_use]
    pub fn probability_no_go(&self, slope: f64) -> f64 {
        self.thresholds.probability_no_go(slope)
    }

    /// For how many samples the search for a heading gave up before it was known whether a slope
    /// [rad] is a no-go.
    #[must_use]
    pub fn not_found(&self, slope: f64) -> usize {
        self.thresholds.not_found(slope)
    }

    /// * `place`: in intervals from the first node
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place between zero and the number of intervals"
    )]
    fn between_nodes(&self, place: f64) -> Mobility {
        let below = (place.max(0.0) as usize).min(self.nodes.len() - 2);
        self.nodes[below].towards(&self.nodes[below + 1], place - below as f64)
    }
}
