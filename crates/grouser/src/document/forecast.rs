//! The words and ranges of a forecast: sites, choices, and the gravity that a soil was measured
//! under.

use std::ops::RangeInclusive;

use super::{GRAVITIES, LoadedScenario, gravity};
use crate::soil::{GravityScaling, Soil};
use crate::studies::forecast::{Choices, ForecastStudy, RoverMass};
use crate::studies::heading::HeadingStudy;
use crate::studies::verdict::Rule;
use crate::units::EARTH_GRAVITY;

/// Mass factors that a rover may have [-].
pub const MASS_FACTOR: RangeInclusive<f64> = 1e-3..=1e3;
/// Gravities of sites, and of measurements [m/s²].
pub const GRAVITY: RangeInclusive<f64> = 1e-3..=100.0;

/// A place to forecast for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// Its name: that of its gravity.
    pub name: &'static str,
    /// Gravity [m/s²].
    pub gravity: f64,
    /// Soils that are known there: what the ground may be besides the soil as it was measured.
    pub grounds: &'static [&'static str],
}

/// What the ground of the Moon may be: as the Lunar Roving Vehicle's wheels found it, and as the
/// Lunar Sourcebook recommends for the uppermost 15 cm between craters.
const OF_THE_MOON: [&str; 2] = ["lunar-nominal", "lunar-0-15-cm"];

/// The sites that have a name, one for each named gravity.
#[must_use]
pub fn sites() -> Vec<Site> {
    let site = |(name, gravity): (&'static str, f64)| Site {
        name,
        gravity,
        grounds: if name == "moon" { &OF_THE_MOON } else { &[] },
    };
    GRAVITIES.into_iter().map(site).collect()
}

/// How many samples of the soil a forecast may have.
pub const SAMPLES: RangeInclusive<u32> = 2..=10_000;
/// How many of what a model gets wrong.
pub const DISCREPANCIES: RangeInclusive<u32> = 2..=1000;

/// The study of a scenario whose gravity is that of the site: with every scaling, on the soil as
/// measured, for the rover's own mass, over 12 samples of the soil and 4 of what a model gets
/// wrong.
///
/// * `measured_under`: gravity under which the soil was measured [m/s²]; `None` for that of its
///   document, or else the Earth's
#[must_use]
pub fn study_of(scenario: &LoadedScenario, measured_under: Option<f64>) -> ForecastStudy {
    let heading = HeadingStudy::of(&scenario.value);
    let stated = measured_under.or_else(|| self::measured_under(&heading.soil));
    ForecastStudy {
        measured_under: stated.unwrap_or(EARTH_GRAVITY),
        heading,
        rim_speed: scenario.value.drive.nominal_rim_speed(),
        no_go_slip_ratio: Rule::DEFAULT.no_go_slip_ratio,
        choices: Choices::of_scalings(GravityScaling::ALL),
        samples: [12, 4],
        seed: 1,
    }
}

/// What the ground may be if nobody says so: the soil as measured and, where it was measured under
/// another gravity, what is known of the site.
#[must_use]
pub fn usual_grounds(study: &ForecastStudy) -> Vec<&'static str> {
    let gravity = study.heading.gravity;
    let is_away = gravity != study.measured_under;
    let site = sites().into_iter().find(|site| site.gravity == gravity && is_away);
    let known = site.map_or(&[][..], |site| site.grounds);
    [AS_MEASURED].iter().chain(known).copied().collect()
}

/// What has to be said beside the numbers, a sentence each.
///
/// * `scenario`: that of the study
/// * `is_measured_under_stated`: whether the caller says under which gravity the soil was measured
#[must_use]
pub fn notes(
    study: &ForecastStudy,
    scenario: &LoadedScenario,
    is_measured_under_stated: bool,
) -> Vec<String> {
    let (gravity, measured) = (study.heading.gravity, study.measured_under);
    let is_known = is_measured_under_stated || measured_under(&study.heading.soil).is_some();
    let source = if is_known { "" } else { ", which is assumed" };
    let mut notes = vec![format!(
        "the soil was measured under {measured} m/s²{source}; the site has {gravity} m/s²"
    )];
    if study.choices.grounds.len() > 1 {
        notes.push(NOT_AVERAGED.to_owned());
    }
    if gravity != measured && study.choices.scalings.contains(&GravityScaling::Bekker) {
        notes.push(BEKKER_IS_CARRIED.to_owned());
    }
    if scenario.stated_uncertainty().is_none() {
        notes.push(match &scenario.uncertain {
            Some(_) => {
                "no uncertainty of this soil is stated: its samples are of priors".to_owned()
            }
            None => {
                "nothing of this soil is uncertain: the budget has no part of its numbers, and \
                     none of what a model gets wrong"
                    .to_owned()
            }
        });
    }
    notes.push("power is mechanical: motors and their losses come on top".to_owned());
    notes
}

/// The name of the soil itself among grounds.
pub const AS_MEASURED: &str = "as-measured";

/// The gravity under which a soil's constants were measured [m/s²], if its document says so: the
/// named one within its range, or else the range's middle.
#[must_use]
pub fn measured_under(soil: &Soil) -> Option<f64> {
    let range = soil.domain.gravity;
    let is_bounded = range.low.is_finite() && range.high.is_finite();
    let named = GRAVITIES.iter().find(|(_, gravity)| range.holds(*gravity));
    let middle = 0.5 * (range.low + range.high);
    is_bounded.then(|| named.map_or(middle, |(_, gravity)| *gravity))
}

/// A gravity by its name or as a number [m/s²].
#[must_use]
pub fn gravity_of(text: &str) -> Option<f64> {
    gravity(text.trim()).or_else(|| text.trim().parse().ok())
}

/// How moduli scale, by its keyword.
#[must_use]
pub fn scaling_of(text: &str) -> Option<GravityScaling> {
    GravityScaling::ALL.into_iter().find(|scaling| scaling.name() == text)
}

/// Keywords of masses.
pub const MASSES: [&str; 2] = ["equal-mass", "equal-weight"];

/// A rover's mass: `equal-mass`, the mass of its document; `equal-weight`, a document of a test
/// rover that was lightened until it weighed where the soil was measured what the one that flies
/// weighs at the site; or another factor as NAME=FACTOR.
///
/// * `q`: gravity at the site over that of the measurement [-]
///
/// # Errors
/// A sentence, if the text is not one of these.
pub fn mass_of(text: &str, q: f64) -> Result<RoverMass, String> {
    let mass = |name: &str, factor: f64| RoverMass { name: name.to_owned(), factor };
    match text {
        "equal-mass" => return Ok(mass(text, 1.0)),
        "equal-weight" => return Ok(mass(text, 1.0 / q)),
        _ => {}
    }
    let Some((name, factor)) = text.split_once('=') else {
        return Err(format!(
            "'{text}' is no mass: write {}, or a name with the factor on the document's mass, such \
             as flight=0.65",
            MASSES.join(", ")
        ));
    };
    let (name, number) = (name.trim(), factor.trim().parse::<f64>());
    match number {
        _ if MASSES.contains(&name) => Err(format!(
            "'{text}': {name} has its factor already; give another name to another mass"
        )),
        Ok(factor) if MASS_FACTOR.contains(&factor) && !name.is_empty() => Ok(mass(name, factor)),
        _ => {
            let (from, to) = (MASS_FACTOR.start(), MASS_FACTOR.end());
            Err(format!("'{text}': expected NAME=FACTOR with a factor from {from} to {to}"))
        }
    }
}

/// What is to be said where constants that do not know gravity are carried to another one.
pub const BEKKER_IS_CARRIED: &str = "`bekker` keeps moduli that were measured under another \
     gravity: no measurement supports it and it obeys no scaling law, so that its rows stand apart; \
     under a smaller gravity a rover sinks too little, and may slip less or more";

/// What is to be said where the site may have several grounds.
const NOT_AVERAGED: &str = "each ground has rows of its own and nothing is averaged over grounds: \
     only cohesion, friction angle and density measured at the site tell which one it is";

#[cfg(test)]
mod tests {
    use super::super::{Kind, Overrides, Source, read_soil};
    use super::*;
    use crate::units::{EARTH_GRAVITY, MOON_GRAVITY};

    fn soil(name: &str) -> Soil {
        let source = Source::find(Kind::Soil, name).unwrap();
        read_soil(&source, &Overrides::none()).unwrap().value
    }

    #[test]
    fn soils_say_under_which_gravity_they_were_measured() {
        assert_eq!(measured_under(&soil("toyoura")), Some(EARTH_GRAVITY));
        assert_eq!(measured_under(&soil("lunar-0-15-cm")), Some(MOON_GRAVITY));
        assert_eq!(measured_under(&soil("dry-sand")), None);
    }

    #[test]
    fn a_site_has_soils_that_are_there() {
        for site in sites() {
            assert_eq!(gravity(site.name), Some(site.gravity));
            for name in site.grounds {
                assert_eq!(measured_under(&soil(name)), Some(site.gravity), "{name}");
            }
        }
    }

    #[test]
    fn masses_have_names() {
        let q = MOON_GRAVITY / EARTH_GRAVITY;
        assert_eq!(mass_of("equal-mass", q).unwrap().factor, 1.0);
        assert_eq!(mass_of("equal-weight", q).unwrap().factor, 1.0 / q);
        let flight = mass_of("flight=0.65", q).unwrap();
        assert_eq!((flight.name.as_str(), flight.factor), ("flight", 0.65));
        for wrong in ["", "heavy", "=1", "a=b", "a=-1", "a=nan", "a=inf", "a=0"] {
            assert!(mass_of(wrong, q).is_err(), "{wrong}");
        }
    }
}
