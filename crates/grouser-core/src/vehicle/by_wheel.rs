//! What differs from wheel to wheel: the soil below it, and how fast its motor turns it.

use super::ruts::Ruts;
use crate::error::{ParameterError, finite, positive};
use crate::soil::{Compaction, Soil, SoilDifference};
use crate::terrain::SoilField;
use crate::units::Vec2;

/// A number for all wheels, or one for each.
#[derive(Clone, Debug, PartialEq)]
pub enum PerWheel {
    /// The same for all.
    All(f64),
    /// One for each, in the mounts' order.
    Each(Vec<f64>),
}

impl PerWheel {
    /// Returns the number for a wheel, by its place among the mounts.
    #[must_use]
    pub fn of(&self, wheel: usize) -> f64 {
        match self {
            Self::All(one) => *one,
            Self::Each(all) => all[wheel],
        }
    }

    /// Its numbers.
    #[must_use]
    pub fn numbers(&self) -> &[f64] {
        match self {
            Self::All(one) => std::slice::from_ref(one),
            Self::Each(all) => all,
        }
    }

    /// Returns the number for a wheel, or the one for all at place 0, to be changed.
    pub fn number_mut(&mut self, place: usize) -> Option<&mut f64> {
        match self {
            Self::All(one) if place == 0 => Some(one),
            Self::All(_) => None,
            Self::Each(all) => all.get_mut(place),
        }
    }

    /// Checks that there is one number for each wheel, if not one for all.
    pub(super) fn check(
        &self,
        name: &'static str,
        wheels: usize,
        each: fn(&'static str, f64) -> Result<(), ParameterError>,
    ) -> Result<(), ParameterError> {
        if let Self::Each(all) = self
            && all.len() != wheels
        {
            let name = format!("the number of values of the {name}");
            let expected = "one for all wheels, or one for each wheel of the rover";
            return Err(ParameterError::new(name, all.len() as f64, expected));
        }
        self.numbers().iter().try_for_each(|number| each(name, *number))
    }
}

/// How each wheel's soil and speed differ from those that a scenario states.
///
/// How far does the nose fall if the sand below the downhill wheels has 1° less of friction?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::simulation::{Run, RunError, Scenario};
/// use grouser_core::units::deg;
/// use grouser_core::vehicle::{ByWheel, PerWheel};
///
/// let alike = paper::traverse()?;
/// let weaker = |mount: &grouser_core::vehicle::Mount| if mount.position.y < 0.0 { deg(-1.0) } else { 0.0 };
/// let offsets = alike.rover.mounts().iter().map(weaker).collect();
/// let by_wheel = ByWheel { friction_angle: PerWheel::Each(offsets), ..ByWheel::ALIKE };
/// let yaw = |scenario: &Scenario| -> Result<String, RunError> {
///     Ok(format!("{:.2}°", Run::new(scenario)?.to_end()?.last().state.yaw.to_degrees()))
/// };
/// assert_eq!(yaw(&alike)?, "0.07°");
/// assert_eq!(yaw(&Scenario { by_wheel, ..alike.clone() })?, "-0.20°");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ByWheel {
    /// Added to the soil's angle of internal friction [rad].
    pub friction_angle: PerWheel,
    /// Factor on the soil's stiffness [-]; see [`SoilDifference::stiffness`].
    pub stiffness: PerWheel,
    /// Factor on the speed that is commanded of the motor [-].
    pub speed: PerWheel,
}

impl ByWheel {
    /// All wheels alike.
    pub const ALIKE: Self = Self {
        friction_angle: PerWheel::All(0.0),
        stiffness: PerWheel::All(1.0),
        speed: PerWheel::All(1.0),
    };

    /// How a wheel's soil differs.
    #[must_use]
    pub fn soil(&self, wheel: usize) -> SoilDifference {
        SoilDifference {
            friction_angle: self.friction_angle.of(wheel),
            stiffness: self.stiffness.of(wheel),
        }
    }

    /// Checks that the numbers fit a rover.
    ///
    /// * `wheels`: how many it has
    ///
    /// # Errors
    /// [`ParameterError`] for lists of another length, and numbers that nothing can have.
    pub fn check(&self, wheels: usize) -> Result<(), ParameterError> {
        self.friction_angle.check("friction angle offset [rad]", wheels, finite)?;
        self.stiffness.check("stiffness factor", wheels, positive)?;
        self.speed.check("speed factor", wheels, positive)
    }
}

/// How the soil below each wheel differs from what the ground says: by wheel, by place, and by the
/// wheels before it.
#[derive(Clone, Copy)]
pub struct Differences<'a> {
    /// By wheel; without it all are alike.
    pub by_wheel: Option<&'a ByWheel>,
    /// By place; without it the ground is as it says.
    pub by_place: Option<SoilField>,
    /// By the wheels that passed before.
    pub ruts: Ruts,
}

impl Differences<'_> {
    /// None.
    pub const NONE: Self = Self { by_wheel: None, by_place: None, ruts: Ruts::Fresh };

    /// How the soil below a wheel differs that stands at a place, if it does.
    pub(super) fn of(&self, wheel: usize, place: Vec2) -> Option<SoilDifference> {
        let by_wheel = self.by_wheel.map(|all| all.soil(wheel));
        let by_place = self.by_place.as_ref().map(|field| field.at(place));
        match (by_wheel, by_place) {
            (Some(one), Some(other)) => Some(one.and(other)),
            (one, other) => one.or(other),
        }
    }

    /// The soil below a wheel on a slope.
    ///
    /// * `steepness`: tangent of the slope [-]
    /// * `rut`: what the wheels before it left
    /// * `soil`: that of the ground
    pub(super) fn soil_on(
        &self,
        steepness: f64,
        wheel: usize,
        place: Vec2,
        rut: Option<Compaction>,
        soil: &Soil,
    ) -> Soil {
        let rut = rut.filter(|rut| *rut != Compaction::NONE);
        match (self.of(wheel, place), rut) {
            (None, None) => soil.on_slope(steepness),
            (Some(difference), None) => soil.differing(difference).on_slope(steepness),
            (None, Some(rut)) => soil.compacted(rut).on_slope(steepness),
            (Some(difference), Some(rut)) => {
                soil.differing(difference).compacted(rut).on_slope(steepness)
            }
        }
    }
}
