//! Many runs that differ in a few numbers of one scenario, without a document for each.
//!
//! A number that varies has the key of the documents, and the range; what only several values
//! together can show is checked by [`Scenario::check`], as it is for a document.

use std::ops::RangeInclusive;
use std::sync::OnceLock;

use super::values::{Described, check_sample_count};
use super::{Kind, range};
use crate::error::ParameterError;
use crate::simulation::Scenario;
use crate::vehicle::DriveLaw;

/// A number of a scenario that may vary from run to run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Varied {
    /// Its key in a scenario's document.
    key: &'static str,
    place: usize,
}

/// The keys of the numbers that may vary.
const KEYS: [&str; 5] =
    ["slope_deg", "start.yaw_deg", "drive.speed_m_s", "gravity_m_s2", "duration_s"];
const SPEED: &str = KEYS[2];
const DURATION: &str = KEYS[4];

impl Varied {
    /// All of them.
    pub const ALL: [Self; KEYS.len()] = {
        let mut all = [Self { key: "", place: 0 }; KEYS.len()];
        let mut place = 0;
        while place < KEYS.len() {
            all[place] = Self { key: KEYS[place], place };
            place += 1;
        }
        all
    };

    /// Its word: the key without its tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.key.rsplit('.').next().unwrap_or(self.key)
    }

    /// The key in a scenario's document.
    #[must_use]
    pub const fn key(self) -> &'static str {
        self.key
    }

    /// Where its values may lie, ends included. What a speed may be depends on the law of the drive, too,
    /// which checks it.
    #[must_use]
    pub fn range(self) -> RangeInclusive<f64> {
        static RANGES: OnceLock<[RangeInclusive<f64>; KEYS.len()]> = OnceLock::new();
        let of = |key| range(Kind::Scenario, key).unwrap_or(f64::MIN..=f64::MAX);
        RANGES.get_or_init(|| KEYS.map(of))[self.place].clone()
    }

    /// Puts a value in its place.
    ///
    /// # Errors
    /// [`VariationError`] for a value out of its range, or that the drive cannot have.
    pub fn put(self, scenario: &mut Scenario, value: f64) -> Result<(), VariationError> {
        let range = self.range();
        if !range.contains(&value) {
            let expected = format!("{} to {}", range.start(), range.end());
            return Err(VariationError { name: self.name().to_owned(), value, expected });
        }
        if self.key == SPEED && matches!(scenario.drive, DriveLaw::ConstantEach(_)) {
            scenario.drive = DriveLaw::Constant(value);
        }
        if let Some(reached) = Scenario::table().reach(scenario, self.key) {
            reached.set(value);
        }
        if self.key == DURATION {
            check_sample_count(value, scenario.numerics.sample_interval)?;
        }
        Ok(scenario.check()?)
    }
}

/// A value that a scenario cannot have.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{name} is {value}, it must be {expected}")]
pub struct VariationError {
    /// What varies, or what it made of the run.
    pub name: String,
    /// The value that was given.
    pub value: f64,
    /// What would have been allowed.
    pub expected: String,
}

impl From<ParameterError> for VariationError {
    fn from(error: ParameterError) -> Self {
        let ParameterError { name, value, expected } = error;
        Self { name, value, expected: expected.to_owned() }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Overrides, Source, read_scenario};
    use super::*;

    fn with(settings: &[&str]) -> Scenario {
        let overrides = Overrides::parse(settings).unwrap();
        read_scenario(&Source::default_scenario(), &overrides).unwrap().value
    }

    /// The key in a document and the number put in its place mean the same, for each drive.
    #[test]
    fn what_is_put_is_what_a_document_says() {
        for law in ["constant", "eq18"] {
            let law = format!("scenario.drive.law={law}");
            for (varied, value) in Varied::ALL.into_iter().zip([21.5, -7.25, 0.045, 1.62, 12.5]) {
                let mut put = with(&[&law]);
                varied.put(&mut put, value).unwrap();
                assert_eq!(put, with(&[&law, &format!("scenario.{}={value}", varied.key())]));
            }
        }
    }

    #[test]
    fn ranges_are_those_of_the_document() {
        let [slope, yaw, speed, gravity, duration] = Varied::ALL;
        for (varied, value) in [
            (slope, 60.1),
            (yaw, f64::NAN),
            (speed, 11.0),
            (gravity, 0.0),
            (duration, 0.0),
            (duration, 1e6),
        ] {
            let error = varied.put(&mut with(&[]), value).unwrap_err();
            assert!(error.to_string().contains(varied.name()) || value == 0.0, "{error}");
        }
    }
}
