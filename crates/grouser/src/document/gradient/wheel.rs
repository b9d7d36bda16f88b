//! Derivatives of a wheel on a test stand.

use super::{AskedKey, GradientKeys, NoSuchKey, asked};
use crate::contact::gradient::{ChangeableWheel, WheelDerivative, gradient};
use crate::contact::{Contact, Model, Settled, Slip};
use crate::difference::Variable;
use crate::document::columns::{LOAD, SLIP_ANGLE, SLIP_RATIO};
use crate::document::varied::{Numbers as _, Varied};
use crate::document::{Described as _, Kind, LoadedSoil, LoadedWheel, range, study};
use crate::soil::Soil;
use crate::studies::wheel_test::{WheelTest, WheelTestRow};
use crate::wheel::Wheel;

/// The numbers of a wheel test: those of its soil and its wheel, and its settings.
#[derive(Clone, Debug)]
pub struct WheelKeys {
    soil: Varied<Soil>,
    wheel: Varied<Wheel>,
    keys: Vec<(AskedKey, WheelPlace)>,
}

/// Where a number stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum WheelPlace {
    Soil,
    Wheel,
    Gravity,
    Load,
    SlipRatio,
    SlipAngle,
}

/// What is set on a test stand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StandSetting {
    /// Gravity, *g* [m/s²].
    pub gravity: f64,
    /// Load [N].
    pub load: f64,
    /// Slip ratio [-].
    pub slip_ratio: f64,
    /// Slip angle [rad].
    pub slip_angle: f64,
}

/// Numbers under keys of the soil and the wheel that differ from their documents'.
#[derive(Clone, Copy, Debug, Default)]
pub struct ChangedKeys<'a> {
    /// Of the soil, without its name before the key.
    pub soil: &'a [(&'a str, f64)],
    /// Of the wheel.
    pub wheel: &'a [(&'a str, f64)],
}

const SOIL: &str = "soil.";
const WHEEL: &str = "wheel.";
const GRAVITY: &str = "gravity_m_s2";

impl WheelKeys {
    /// The numbers that are asked for.
    ///
    /// # Errors
    /// [`NoSuchKey`] for one that is none of soil, wheel and settings.
    pub fn of(
        soil: &LoadedSoil,
        wheel: &LoadedWheel,
        asked_for: &GradientKeys,
    ) -> Result<Self, NoSuchKey> {
        let document = soil.document.clone();
        let soil = Varied::of(soil.value, document);
        let document = wheel.document.clone();
        let wheel = Varied::of(wheel.value, document);
        let mut keys = Self { soil, wheel, keys: Vec::new() };
        let names = match asked_for {
            GradientKeys::These(names) => names.clone(),
            GradientKeys::All => keys.all(),
        };
        keys.keys = names.iter().map(|name| keys.key(name)).collect::<Result<_, _>>()?;
        Ok(keys)
    }

    /// The names of the keys, in the order of derivatives.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.keys.iter().map(|(key, _)| &*key.name)
    }

    /// The keys that the documents give no value.
    pub fn lacking(&self) -> impl Iterator<Item = &str> {
        self.keys.iter().filter(|(key, _)| key.key.is_none()).map(|(key, _)| &*key.name)
    }

    /// The derivatives of a row of a test by each key; none by a key that the documents lack or
    /// that can be changed to neither side, none at all where the wheel does not settle.
    #[must_use]
    pub fn of_row(&self, test: &WheelTest, row: &WheelTestRow) -> Vec<Option<WheelDerivative>> {
        let Ok(settled) = &row.result else { return vec![None; self.keys.len()] };
        let WheelTestRow { load, slip_ratio, slip_angle, .. } = *row;
        let setting = StandSetting { gravity: test.gravity, load, slip_ratio, slip_angle };
        self.of_wheel(&test.model, &setting, &ChangedKeys::default(), settled)
    }

    /// The same of a wheel that has settled in some setting, with other numbers than its documents
    /// have.
    #[must_use]
    pub fn of_wheel(
        &self,
        model: &Model,
        setting: &StandSetting,
        changed: &ChangedKeys<'_>,
        settled: &Settled,
    ) -> Vec<Option<WheelDerivative>> {
        let values: Vec<Option<f64>> =
            self.keys.iter().map(|(key, place)| changed.value(key, *place, setting)).collect();
        let variables: Vec<Variable> =
            self.keys.iter().zip(&values).map(|((key, _), value)| key.variable(*value)).collect();
        let as_they_are: Vec<f64> = variables.iter().map(|it| it.value).collect();
        let with = |numbers: &[f64]| self.with(setting, changed, numbers);
        let Some((contact, _)) = with(&as_they_are) else { return vec![None; self.keys.len()] };
        let changeable = ChangeableWheel { model: model.as_ref(), with: &with };
        gradient(&changeable, &variables, &contact, settled).by_variable
    }

    /// Every number that there is.
    fn all(&self) -> Vec<String> {
        let soil = self.soil.document.number_keys().into_iter();
        let soil =
            soil.filter(|path| self.soil.key(path).is_ok()).map(|path| SOIL.to_owned() + &path);
        let wheel =
            self.wheel.document.number_keys().into_iter().map(|path| WHEEL.to_owned() + &path);
        let settings = [GRAVITY, LOAD.name, SLIP_RATIO.name, SLIP_ANGLE.name].map(String::from);
        soil.chain(wheel).chain(settings).collect()
    }

    /// The number of a name.
    fn key(&self, name: &str) -> Result<(AskedKey, WheelPlace), NoSuchKey> {
        let setting = |place, range| Ok((AskedKey::setting(name, range), place));
        if let Some(path) = name.strip_prefix(SOIL) {
            return Ok((asked(name, path, &self.soil)?, WheelPlace::Soil));
        }
        if let Some(path) = name.strip_prefix(WHEEL) {
            return Ok((asked(name, path, &self.wheel)?, WheelPlace::Wheel));
        }
        match name {
            GRAVITY => setting(WheelPlace::Gravity, range(Kind::Scenario, GRAVITY)),
            _ if name == LOAD.name => setting(WheelPlace::Load, Some(study::LOAD_N)),
            _ if name == SLIP_RATIO.name => setting(WheelPlace::SlipRatio, Some(study::SLIP_RATIO)),
            _ if name == SLIP_ANGLE.name => {
                setting(WheelPlace::SlipAngle, Some(study::SLIP_ANGLE_DEG))
            }
            _ => Err(NoSuchKey::among(name, &self.all())),
        }
    }

    /// The contact and load [N] with other numbers.
    fn with(
        &self,
        setting: &StandSetting,
        changed: &ChangedKeys<'_>,
        numbers: &[f64],
    ) -> Option<(Contact, f64)> {
        let mut set = *setting;
        let (mut soil, mut wheel) = (changed.soil.to_vec(), changed.wheel.to_vec());
        for ((asked, place), number) in self.keys.iter().zip(numbers) {
            let Some(key) = &asked.key else { continue };
            match place {
                WheelPlace::Soil => soil.push((&*key.path, *number)),
                WheelPlace::Wheel => wheel.push((&*key.path, *number)),
                WheelPlace::Gravity => set.gravity = *number,
                WheelPlace::Load => set.load = *number,
                WheelPlace::SlipRatio => set.slip_ratio = *number,
                WheelPlace::SlipAngle => set.slip_angle = SLIP_ANGLE.unit.to_si(*number),
            }
        }
        let contact = Contact {
            soil: self.soil.value.with(soil).ok()?,
            wheel: self.wheel.value.with(wheel).ok()?,
            slip: Slip::on_test_stand(set.slip_ratio, set.slip_angle),
            gravity: set.gravity,
        };
        Some((contact, set.load))
    }
}

impl ChangedKeys<'_> {
    /// Where a number stands, if not where its document has it.
    fn value(&self, asked: &AskedKey, place: WheelPlace, setting: &StandSetting) -> Option<f64> {
        let among = |changed: &[(&str, f64)]| {
            let path = &asked.key.as_ref()?.path;
            changed.iter().rev().find(|(key, _)| key == path).map(|(_, value)| *value)
        };
        match place {
            WheelPlace::Soil => among(self.soil),
            WheelPlace::Wheel => among(self.wheel),
            WheelPlace::Gravity => Some(setting.gravity),
            WheelPlace::Load => Some(setting.load),
            WheelPlace::SlipRatio => Some(setting.slip_ratio),
            WheelPlace::SlipAngle => Some(SLIP_ANGLE.unit.from_si(setting.slip_angle)),
        }
    }
}
