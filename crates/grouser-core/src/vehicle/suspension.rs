//! How the wheels are joined to the body: rockers on both sides, with or without bogies.
//!
//! A rocker turns about an axis across the body; a differential makes the right one turn against
//! the left one. A bogie turns about an axis across its rocker and carries two wheels. The joints
//! are free: they lead no moment about their axes but the differential's.

use crate::units::Vec2;

/// Rockers with a differential, alike on both sides.
///
/// Which wheels does a bogie of six wheels carry that is at the rear?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::units::{Vec2, Vec3};
/// use grouser_core::vehicle::{Bogie, End, Mount, Suspension};
///
/// let unit = paper::hakuto()?.mounts()[0].unit;
/// let mount = |(name, x): (&str, f64)| Mount {
///     name: name.to_owned(),
///     joint: None,
///     position: Vec3::new(x, 0.3, -0.1),
///     unit,
///     steering: 0.0,
///     steering_axis: None,
/// };
/// let left: Vec<Mount> = [("front", 0.4), ("middle", 0.0), ("rear", -0.4)].map(mount).to_vec();
/// let bogie = Bogie { pivot: Vec2::new(-0.2, 0.0), end: End::Rear };
/// let suspension = Suspension { pivot: Vec2::zeros(), bogie: Some(bogie) };
///
/// let carried = left.iter().filter(|mount| suspension.is_on_bogie(mount, &left));
/// assert_eq!(carried.map(|mount| &*mount.name).collect::<Vec<_>>(), ["middle", "rear"]);
/// # Ok::<(), grouser_core::error::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Suspension {
    /// The axis of the rockers, seen from the side, (x, z) in the body frame [m].
    pub pivot: Vec2,
    /// The bogie of each rocker of a rover with three wheels on a side.
    pub bogie: Option<Bogie>,
}

/// A link that carries two wheels of a side, joined to a rocker.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bogie {
    /// Its axis, seen from the side, (x, z) in the body frame where the rover stands on a plane
    /// [m].
    pub pivot: Vec2,
    /// The end of the rover at which it is.
    pub end: End,
}

/// An end of the rover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// Where its nose is.
    Front,
    /// Where its tail is.
    Rear,
}

/// Angles of the joints [rad], zero where the rover stands on a plane; positive with the front up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Joints {
    /// Angle of the left rocker against the body; the right one has the opposite angle.
    pub rocker: f64,
    /// Angles of the left and of the right bogie against its rocker.
    pub bogies: [f64; 2],
}

impl Suspension {
    /// How many joints it has.
    #[must_use]
    pub fn joint_count(&self) -> usize {
        if self.bogie.is_some() { 3 } else { 1 }
    }
}

impl Joints {
    /// With the changes of a step of a search: of the rockers, and of both bogies.
    pub(super) fn moved(self, by: &[f64]) -> Self {
        let of = |joint: usize| by.get(joint).copied().unwrap_or(0.0);
        let [left, right] = self.bogies;
        Self { rocker: self.rocker + of(0), bogies: [left + of(1), right + of(2)] }
    }
}
