//! What a caller says of a rover beside its URDF.

/// What URDF cannot say.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UrdfOptions {
    /// Names of the links that are wheels, with `*` for any letters; without any, all cylinders
    /// that roll without end about an axis across the rover.
    pub wheels: Vec<String>,
    /// Whether a differential joins the rockers of both sides.
    pub has_differential: bool,
}
