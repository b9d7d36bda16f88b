//! The yaw that a rover loses on its way across a slope: what its loads take, and what the scatter
//! of the soil and of the motors adds or takes back.
//!
//! By the complete load transfer the nose of a rover falls downhill, on every soil and every motor
//! alike. No bed is even and no two motors turn alike: so a measured run is one of many, and
//! comparable with their distribution alone. This study has that distribution, and the part of each
//! cause in it.

use super::comparison::MeasuredTraverse;
use super::ensemble::{Band, Probability, outputs};
use crate::simulation::{Integrator, Numerics, Run, RunError, Scatter, Scenario, Start};
use crate::terrain::SoilScatter;
use crate::vehicle::Ruts;

/// Runs from the measured starts, with soil and speeds that scatter.
///
/// How much yaw does the rover lose on 10° in nine runs of ten, if the sand's friction scatters by
/// 1°?
///
/// ```
/// use grouser::document::{self, Overrides, Source, experiment};
/// use grouser::simulation::Scatter;
/// use grouser::studies::lost_yaw::LostYawPlan;
/// use grouser::terrain::SoilScatter;
/// use grouser::units::deg;
///
/// let soil = SoilScatter { friction_angle: deg(1.0), stiffness: 0.0, correlation_length: 0.3 };
/// let plan = LostYawPlan {
///     scenario: document::read_scenario(&Source::default_scenario(), &Overrides::none())?.value,
///     measured: vec![experiment::table_4()[1]],
///     scatter: Scatter { soil, ..Scatter::NONE },
///     other_lengths: vec![],
///     samples: 20,
///     seed: 1,
/// };
/// let slope = &plan.run(&mut |_| ())?[0];
/// assert_eq!(format!("{:.2}°", slope.by_loads.to_degrees()), "1.30°");
/// let band = slope.together.losses;
/// assert!(band.low < slope.by_loads && slope.by_loads < band.high);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct LostYawPlan {
    /// Rover, mean soil, drive, load transfer and duration; slope, start and scatter are set for
    /// each run.
    pub scenario: Scenario,
    /// The measured traverses.
    pub measured: Vec<MeasuredTraverse>,
    /// What scatters.
    pub scatter: Scatter,
    /// Correlation lengths that are tried besides that of the scatter [m].
    pub other_lengths: Vec<f64>,
    /// Runs for each cause on each slope.
    pub samples: u32,
    /// Seed of their realisations.
    pub seed: u64,
}

/// The yaw lost on one slope [rad].
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeLoss {
    /// What was measured.
    pub measured: MeasuredTraverse,
    /// Lost without any scatter: by the loads alone.
    pub by_loads: f64,
    /// The same with wheels that roll in compacted [ruts](Ruts::Compacted).
    pub by_ruts: f64,
    /// With all that scatters.
    pub together: Losses,
    /// With one cause of scatter alone, in the order of [`Cause::ALL`].
    pub alone: [Losses; Cause::ALL.len()],
    /// With all, by the plan's other correlation lengths.
    pub by_length: Vec<Losses>,
    /// In how many of the runs with all less was lost than measured.
    pub below_measured: Probability,
}

/// Yaw lost in many runs [rad].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Losses {
    /// Its quantiles.
    pub losses: Band,
    /// Its standard deviation.
    pub deviation: f64,
    /// In how many of the runs the rover slid, got stuck or tipped over before the end: they count
    /// with the yaw that they had then.
    pub ended_early: Probability,
}

/// A cause of scatter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The soil's friction angle differs from place to place.
    FrictionAngle,
    /// The soil's stiffness does.
    Stiffness,
    /// The wheels turn at different speeds.
    Speed,
}

impl Cause {
    /// All.
    pub const ALL: [Self; 3] = [Self::FrictionAngle, Self::Stiffness, Self::Speed];

    /// A scatter by this cause alone.
    fn of(self, all: Scatter) -> Scatter {
        let none = SoilScatter { friction_angle: 0.0, stiffness: 0.0, ..all.soil };
        let still = Scatter { soil: none, speed: 0.0, ..all };
        match self {
            Self::FrictionAngle => {
                let friction_angle = all.soil.friction_angle;
                Scatter { soil: SoilScatter { friction_angle, ..none }, ..still }
            }
            Self::Stiffness => {
                let stiffness = all.soil.stiffness;
                Scatter { soil: SoilScatter { stiffness, ..none }, ..still }
            }
            Self::Speed => Scatter { speed: all.speed, ..still },
        }
    }
}

impl LostYawPlan {
    /// How many steps [`run`](Self::run) reports.
    #[must_use]
    pub fn step_count(&self) -> usize {
        self.measured.len()
    }

    /// Runs the study, a slope after the other, in the measured ones' order; `progress` gets the
    /// name of each step as it begins. The runs are shared among threads, which changes no result.
    ///
    /// # Errors
    /// [`RunError`] of the first run that cannot be computed.
    ///
    /// # Panics
    /// If there are no samples.
    pub fn run(&self, progress: &mut dyn FnMut(&str)) -> Result<Vec<SlopeLoss>, RunError> {
        assert!(self.samples > 0, "a distribution needs samples");
        let slope = |measured: &MeasuredTraverse| {
            progress("scattered traverses");
            self.on_slope(measured)
        };
        self.measured.iter().map(slope).collect()
    }

    fn on_slope(&self, measured: &MeasuredTraverse) -> Result<SlopeLoss, RunError> {
        let all = self.losses(measured, self.scatter)?;
        let less = all.iter().filter(|run| run.loss < measured.yaw_loss()).count();
        let alone = Cause::ALL.map(|cause| self.losses(measured, cause.of(self.scatter)));
        let [friction_angle, stiffness, speed] = alone;
        let of_length = |length: &f64| {
            let soil = SoilScatter { correlation_length: *length, ..self.scatter.soil };
            let losses = self.losses(measured, Scatter { soil, ..self.scatter });
            losses.map(|losses| Losses::of(&losses))
        };
        Ok(SlopeLoss {
            measured: *measured,
            by_loads: self.one(measured, Scatter::NONE)?.loss,
            by_ruts: self.in_ruts(Ruts::Compacted).one(measured, Scatter::NONE)?.loss,
            together: Losses::of(&all),
            alone: [Losses::of(&friction_angle?), Losses::of(&stiffness?), Losses::of(&speed?)],
            by_length: self.other_lengths.iter().map(of_length).collect::<Result<_, _>>()?,
            below_measured: Probability { successes: less, trials: all.len() },
        })
    }

    /// The plan with other ruts.
    fn in_ruts(&self, ruts: Ruts) -> Self {
        Self { scenario: Scenario { ruts, ..self.scenario.clone() }, ..self.clone() }
    }

    /// Yaws lost in runs whose realisations depend on the seed and the run's number alone: causes
    /// alone and together meet the same beds and motors.
    fn losses(&self, measured: &MeasuredTraverse, scatter: Scatter) -> Result<Vec<Lost>, RunError> {
        let one = |sample: u32| self.one(measured, scatter.of_case(self.seed, sample.into()));
        outputs(0..self.samples, one).into_iter().collect()
    }

    /// One run. One that ends early keeps the yaw with which it ended.
    fn one(&self, measured: &MeasuredTraverse, scatter: Scatter) -> Result<Lost, RunError> {
        let base = self.scenario.clone();
        let numerics =
            Numerics { integrator: Integrator::Adaptive { tolerance: TOLERANCE }, ..base.numerics };
        let ground = base.ground.with_slope(measured.slope);
        let start = Start { yaw: measured.initial_yaw, ..base.start };
        let run = Run::new(&Scenario { scatter, ground, start, numerics, ..base })?.to_outcome()?;
        let loss = measured.initial_yaw - run.last().state.yaw;
        Ok(Lost { loss, is_whole: run.outcome.is_completed() })
    }
}

/// What became of one run.
struct Lost {
    /// Yaw lost [rad].
    loss: f64,
    /// Whether it went to its end.
    is_whole: bool,
}

/// Relative tolerance of the runs [-]: they differ from each other by a thousand times as much.
const TOLERANCE: f64 = 1e-4;

impl Losses {
    fn of(runs: &[Lost]) -> Self {
        let (count, losses) = (runs.len() as f64, || runs.iter().map(|run| run.loss));
        let mean = losses().sum::<f64>() / count;
        let squares: f64 = losses().map(|loss| (loss - mean) * (loss - mean)).sum();
        let early = runs.iter().filter(|run| !run.is_whole).count();
        Self {
            losses: Band::of(losses()).expect("there are samples"),
            deviation: (squares / (count - 1.0).max(1.0)).sqrt(),
            ended_early: Probability { successes: early, trials: runs.len() },
        }
    }
}
