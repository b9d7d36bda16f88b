//! What to do tomorrow, by what was learnt: the heading to set, how often to look at the slip, and
//! which test drive would tell most for its cost.
//!
//! Forces of the soil do not depend on how fast it is sheared, so that slip, heading and the way
//! over which a rover digs itself in are the same at every speed. Speed sets the time and the
//! power, and no more: the advice is the speed that was asked for, unless odometry would then not
//! be ready for each look at the slip.

mod course;
mod instruments;
mod leg;
mod limits;
mod slip_check;
mod soil_ahead;
mod test_drive;

pub use self::course::{AdvisedHeading, HeadingAdvice};
pub use self::instruments::Instruments;
pub use self::leg::TestLeg;
pub use self::limits::Limits;
pub use self::slip_check::{Check, CheckAdvice, CheckSettings, WAY_AHEAD};
pub use self::soil_ahead::SoilAhead;
use self::soil_ahead::SoilWay;
use self::test_drive::Planner;
pub use self::test_drive::{TestCost, TestDrive, TestDrives, TestSettings};
use super::Learner;
use crate::error::ParameterError;
use crate::studies::ensemble::samples::Sample;
use crate::studies::heading_band::HeadingBand;
use grouser_io::statistics::NothingAccepted;

/// What advice is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct AdviceSettings {
    /// The slip to keep.
    pub limits: Limits,
    /// How slip is checked.
    pub checks: CheckSettings,
    /// Time that odometry needs for a look at the slip while the rover goes on [s]; 0 where it
    /// stands meanwhile.
    pub look_time: f64,
    /// The test drives that there may be.
    pub tests: TestSettings,
    /// Seed of the soils ahead.
    pub seed: u64,
}

/// What to do tomorrow.
#[derive(Clone, Debug, PartialEq)]
pub struct DriveAdvice {
    /// On each slope that was asked for, in that order.
    pub slopes: Vec<SlopeAdvice>,
    /// Which test drives tell most of these slopes for their cost.
    pub tests: TestDrives,
    /// What test drives cost.
    pub cost: TestCost,
}

/// What to do on a slope.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeAdvice {
    /// The heading to set.
    pub heading: HeadingAdvice,
    /// How often to look at the slip at that heading; `None` without one.
    pub check: Option<CheckAdvice>,
    /// The rim speed to set [m/s]: that which was asked for, or as slow as looks at the slip need
    /// it; `None` without a heading.
    pub rim_speed: Option<f64>,
}

/// Why there is no advice.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoAdvice {
    /// A setting out of range.
    #[error(transparent)]
    Setting(#[from] ParameterError),
    /// No soil can be drawn.
    #[error("the soil's uncertainty reaches too far: {0}")]
    Soil(#[from] NothingAccepted),
}

impl AdviceSettings {
    /// The usual ones.
    ///
    /// * `rim_speed`: that is asked for [m/s]
    /// * `tests`: the test drives that there may be
    #[must_use]
    pub fn usual(rim_speed: f64, tests: TestSettings) -> Self {
        let (limits, checks) = (Limits::usual(rim_speed), CheckSettings::USUAL);
        Self { limits, checks, look_time: 0.0, tests, seed: 1 }
    }

    /// # Errors
    /// [`ParameterError`] for the first setting out of range.
    pub fn check(&self) -> Result<(), ParameterError> {
        let Self { limits, checks, tests, .. } = self;
        let share = |name: &str, value: f64| {
            let inside = (0.0..=1.0).contains(&value);
            inside.then_some(()).ok_or_else(|| ParameterError::new(name, value, "0 to 1"))
        };
        crate::error::positive("rim speed [m/s]", limits.rim_speed)?;
        share("the no-go slip ratio", limits.slip_ratio)?;
        share("the no-go probability", limits.no_go_probability)?;
        share("the probability of getting stuck", checks.stuck_probability)?;
        share("the share of false stops", checks.false_stops)?;
        share("the error of odometry", checks.odometry_error)?;
        if checks.ways == 0 {
            return Err(ParameterError::new("number of ways", 0.0, "one at least"));
        }
        if let Some(way) = checks.soil.change_way {
            crate::error::positive("way between changes of the soil [m]", way)?;
        }
        if !(self.look_time >= 0.0 && self.look_time.is_finite()) {
            let expected = "0 or more";
            return Err(ParameterError::new(
                "time of a look at the slip [s]",
                self.look_time,
                expected,
            ));
        }
        tests
            .legs
            .iter()
            .try_for_each(|leg| crate::error::positive("way of a test drive [m]", leg.way))
    }
}

impl Learner {
    /// What to do on the slopes of a prediction.
    ///
    /// * `samples`, `band`: of what is believed now, and of [`predict`](Self::predict)
    /// * `go_on`: asked often, from any thread; without it there is no result
    ///
    /// # Errors
    /// [`NoAdvice`] for a setting out of range, and if no soil can be drawn.
    pub fn advice(
        &self,
        samples: &[Sample],
        band: &HeadingBand,
        settings: &AdviceSettings,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<DriveAdvice>, NoAdvice> {
        settings.check()?;
        let mut slopes = Vec::new();
        for band in &band.slopes {
            let limits = &settings.limits;
            let heading = HeadingAdvice::on_slope(&self.study, samples, band, limits, go_on);
            let Some(heading) = heading else { return Ok(None) };
            let Some(advice) = self.slope_advice(heading, settings, go_on)? else {
                return Ok(None);
            };
            slopes.push(advice);
        }
        let planner = Planner {
            study: &self.study,
            settings: &self.settings,
            filter: self.bank.best(&self.settings),
            limits: &settings.limits,
            tests: &settings.tests,
        };
        let ahead: Vec<f64> = band.slopes.iter().map(|it| it.slope).collect();
        let tests = planner.plan(samples, &ahead, go_on);
        Ok(tests.map(|tests| DriveAdvice { slopes, tests, cost: settings.tests.cost }))
    }

    fn slope_advice(
        &self,
        heading: HeadingAdvice,
        settings: &AdviceSettings,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<SlopeAdvice>, NoAdvice> {
        let Some(advised) = heading.advised else {
            return Ok(Some(SlopeAdvice { heading, check: None, rim_speed: None }));
        };
        let asked = settings.limits.rim_speed;
        let check = CheckAdvice::on_course(
            &self.study,
            (&self.bank, &self.settings),
            ((heading.slope, advised.yaw), asked),
            (&settings.checks, settings.seed),
            go_on,
        )?;
        let Some(check) = check else { return Ok(None) };
        let every = check.check.map_or(f64::INFINITY, |it| it.every);
        let rim_speed = asked.min(every / settings.look_time.max(f64::MIN_POSITIVE));
        Ok(Some(SlopeAdvice { heading, check: Some(check), rim_speed: Some(rim_speed) }))
    }

    /// The soils at places along a way ahead, a realisation that depends on the seed and its number
    /// alone: the first is that of [`samples`](Self::samples), the others wander and change from
    /// there.
    ///
    /// * `places`: ways over the ground from each to the next [m]
    ///
    /// # Errors
    /// [`NothingAccepted`] if no soil can be drawn.
    pub fn soils_ahead(
        &self,
        ahead: SoilAhead,
        (seed, index): (u64, u64),
        places: &[f64],
    ) -> Result<Vec<Sample>, NothingAccepted> {
        let mut soil = SoilWay::new((&self.bank, &self.settings), ahead, (seed, index))?;
        let mut soils = vec![soil.sample().clone()];
        for way in places {
            soil.advance(*way)?;
            soils.push(soil.sample().clone());
        }
        Ok(soils)
    }
}
