//! What a caller says of a rover beside its URDF.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

/// What URDF cannot say.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UrdfOptions {
    /// Names of the links that are wheels, with `*` for any letters; without any, what rolls about
    /// an axis across the rover, reaches the ground and comes in pairs.
    pub wheels: Vec<String>,
    /// Names of links that roll and are no driven wheels (casters, drums), likewise: they belong to
    /// the body.
    pub passive: Vec<String>,
    /// Radius of the wheels [m], where their shapes do not tell it, or another.
    pub wheel_radius: Option<f64>,
    /// Width of the wheels [m], likewise.
    pub wheel_width: Option<f64>,
    /// Which way of the root link is forward.
    pub forward: Forward,
    /// Whether a differential joins the rockers of both sides.
    pub has_differential: bool,
    /// Whether rockers and bogies are taken as they stand.
    pub is_rigid: bool,
}

/// A way along an axis of the root link; its z axis is up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Forward {
    /// Along x, as REP 103 has it.
    #[default]
    X,
    /// Along y.
    Y,
    /// Against x.
    MinusX,
    /// Against y.
    MinusY,
}

impl Forward {
    /// Every way, with its name.
    pub const ALL: [(&str, Self); 4] =
        [("x", Self::X), ("y", Self::Y), ("-x", Self::MinusX), ("-y", Self::MinusY)];

    /// The way of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|(own, _)| *own == name).map(|(_, way)| way)
    }

    /// The root link's frame in the rover's, which has x forward.
    pub(super) fn turned(self) -> Isometry3<f64> {
        let quarters = match self {
            Self::X => 0.0,
            Self::Y => -1.0,
            Self::MinusX => 2.0,
            Self::MinusY => 1.0,
        };
        let angle = quarters * std::f64::consts::FRAC_PI_2;
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle);
        Isometry3::from_parts(Translation3::identity(), turn)
    }
}
