//! Derivatives of headings, and of the steepest slope.

use super::{AskedKey, GradientKeys, NoSuchKey, asked};
use crate::difference::{Derivative, Variable};
use crate::document::columns::heading::{Held, YAW_MOMENT, held, steered};
use crate::document::columns::{
    COURSE, Column, ENERGY_PER_METRE, LIMIT_SLOPE, POWER, SLIP_RATIO, SLOPE, TORQUE,
};
use crate::document::varied::{Numbers as _, Varied};
use crate::document::{Described as _, LoadedScenario, study};
use crate::simulation::Scenario;
use crate::studies::heading::{
    ChangeableStudy, HeadingCurve, HeadingDerivatives, HeadingOffset, HeadingStudy, Steering,
};
use crate::studies::verdict::Side;
use crate::units::STEEPEST_SLOPE;
use crate::vehicle::Rover;

/// The numbers of headings: those of rover, soil and ground, the slope and the course.
#[derive(Clone, Debug)]
pub struct HeadingKeys {
    scenario: Varied<Scenario>,
    steering: Steering,
    uphill: Side,
    keys: Vec<(AskedKey, HeadingPlace)>,
}

/// Where a number stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum HeadingPlace {
    Scenario,
    Slope,
    Course,
}

/// The tables and keys of a scenario from which headings are computed.
const ACTING: [&str; 4] = ["rover.", "soil.", "slope_stability.", "gravity_m_s2"];

impl HeadingKeys {
    /// The numbers that are asked for.
    ///
    /// # Errors
    /// [`NoSuchKey`] for one that is none of rover, soil and settings.
    pub fn of(
        scenario: &LoadedScenario,
        steering: Steering,
        asked_for: &GradientKeys,
    ) -> Result<Self, NoSuchKey> {
        let document = scenario.document.clone();
        let scenario = Varied::of(scenario.value.clone(), document);
        let mut keys = Self { scenario, steering, uphill: Side::Left, keys: Vec::new() };
        let names = match asked_for {
            GradientKeys::These(names) => names.clone(),
            GradientKeys::All => keys.all(),
        };
        keys.keys = names.iter().map(|name| keys.key(name)).collect::<Result<_, _>>()?;
        Ok(keys)
    }

    /// The same of curves with this side uphill, which is the left one otherwise.
    #[must_use]
    pub fn with_uphill(self, uphill: Side) -> Self {
        Self { uphill, ..self }
    }

    /// The names of the keys, in the order of derivatives.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.keys.iter().map(|(key, _)| &*key.name)
    }

    /// The keys that the documents give no value.
    pub fn lacking(&self) -> impl Iterator<Item = &str> {
        self.keys.iter().filter(|(key, _)| key.key.is_none()).map(|(key, _)| &*key.name)
    }

    /// The names of the results that are differentiated.
    #[must_use]
    pub fn results(&self) -> Vec<&'static str> {
        results(self.steering).map(|column| column.name).collect()
    }

    /// The derivatives of each [result](Self::results) on a slope [rad] by each key, in the units
    /// of both; none by a key that the documents lack or that can be changed to neither side, none
    /// at all where no heading holds the course.
    #[must_use]
    pub fn on_slope(&self, curve: &HeadingCurve, slope: f64) -> Vec<Option<Vec<Derivative>>> {
        let found = self.with_study(curve, |changeable| curve.gradient(slope, changeable));
        let Ok(HeadingDerivatives { by_variable, by_slope }) = found else {
            return vec![None; self.keys.len()];
        };
        let degrees = SLOPE.unit.to_si(1.0);
        let of_key = |((_, place), own): (&(AskedKey, HeadingPlace), Option<Vec<Derivative>>)| {
            let (slopes, factor) = match place {
                HeadingPlace::Slope => (by_slope.clone()?, degrees),
                HeadingPlace::Scenario | HeadingPlace::Course => (own?, 1.0),
            };
            Some(slopes.into_iter().map(|slope| slope.times(factor)).collect())
        };
        self.keys.iter().zip(by_variable).map(of_key).collect()
    }

    /// The derivatives of the steepest slope [°] by each key.
    #[must_use]
    pub fn of_limit(&self, curve: &HeadingCurve) -> Vec<Option<Derivative>> {
        let found = self.with_study(curve, |changeable| curve.limit_gradient(changeable));
        let factor = LIMIT_SLOPE.unit.from_si(1.0);
        let of_key =
            |((_, place), slope): (&(AskedKey, HeadingPlace), Option<Derivative>)| match place {
                // The steepest slope does not depend on the slope that is looked at.
                HeadingPlace::Slope => Some(Derivative::smooth(0.0)),
                HeadingPlace::Scenario | HeadingPlace::Course => Some(slope?.times(factor)),
            };
        self.keys.iter().zip(found).map(of_key).collect()
    }

    fn with_study<T>(
        &self,
        curve: &HeadingCurve,
        ask: impl FnOnce(&ChangeableStudy<'_>) -> T,
    ) -> T {
        let course = COURSE.unit.from_si(curve.course());
        let variables: Vec<Variable> = self
            .keys
            .iter()
            .map(|(key, place)| match place {
                HeadingPlace::Scenario => key.variable(None),
                HeadingPlace::Course => key.variable(Some(course)),
                // The curve has its own derivatives by the slope.
                HeadingPlace::Slope => AskedKey { key: None, ..key.clone() }.variable(None),
            })
            .collect();
        let with = |numbers: &[f64]| self.changed(course, numbers);
        let results = |heading: &HeadingOffset, rover: &Rover| {
            let held = Held { heading, rover, rim_speed: None };
            results(self.steering).map(|column| column.number(&held)).collect()
        };
        let sizes: Vec<f64> = self.sizes();
        ask(&ChangeableStudy {
            variables: &variables,
            with: &with,
            results: &results,
            sizes: &sizes,
        })
    }

    /// What a change of each result is small against where it is near zero: a degree, a percent, a
    /// millimetre, and for forces a hundredth of the weight, with a lever of a metre.
    fn sizes(&self) -> Vec<f64> {
        let weight = self.scenario.value.rover.mass() * self.scenario.value.gravity;
        let size = |name: &str| match name {
            _ if name == SLIP_RATIO.name => 0.01,
            _ if [TORQUE.name, YAW_MOMENT.name, ENERGY_PER_METRE.name].contains(&name) => {
                0.01 * weight
            }
            _ => 1.0,
        };
        self.results().into_iter().map(size).collect()
    }

    /// The study with other numbers, and its course [rad].
    fn changed(&self, mut course: f64, numbers: &[f64]) -> Option<(HeadingStudy, f64)> {
        let mut changed = Vec::new();
        for ((asked, place), number) in self.keys.iter().zip(numbers) {
            match (place, &asked.key) {
                (HeadingPlace::Scenario, Some(key)) => changed.push((&*key.path, *number)),
                (HeadingPlace::Course, _) => course = *number,
                (HeadingPlace::Slope | HeadingPlace::Scenario, _) => {}
            }
        }
        let scenario = self.scenario.value.with(changed).ok()?;
        let mut study = HeadingStudy { steering: self.steering, ..HeadingStudy::of(&scenario) };
        if self.uphill == Side::Right {
            study.rover = study.rover.mirrored();
        }
        Some((study, COURSE.unit.to_si(course)))
    }

    /// Every number that headings are computed from.
    fn all(&self) -> Vec<String> {
        let keys = self.scenario.document.number_keys().into_iter();
        let acts = |key: &String| ACTING.iter().any(|start| key.starts_with(start));
        let keys = keys.filter(acts).filter(|key| self.scenario.key(key).is_ok());
        keys.chain([SLOPE.name.to_owned()]).collect()
    }

    /// The number of a name.
    fn key(&self, name: &str) -> Result<(AskedKey, HeadingPlace), NoSuchKey> {
        if name == SLOPE.name {
            let range = 0.0..=SLOPE.unit.from_si(STEEPEST_SLOPE);
            return Ok((AskedKey::setting(name, Some(range)), HeadingPlace::Slope));
        }
        if name == COURSE.name {
            return Ok((AskedKey::setting(name, Some(study::COURSE_DEG)), HeadingPlace::Course));
        }
        Ok((asked(name, name, &self.scenario)?, HeadingPlace::Scenario))
    }
}

/// The columns that every heading has.
fn results<'a>(steering: Steering) -> impl Iterator<Item = Column<Held<'a>>> {
    let steered = (steering == Steering::Crab).then(steered).into_iter().flatten();
    steered.chain(held().into_iter().filter(|column| column.name != POWER.name))
}
