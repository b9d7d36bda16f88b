//! What was found, for people to look at.

/// A wheel that was found in URDF.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundWheel {
    /// Its link.
    pub link: String,
    /// The joint that turns it.
    pub joint: String,
    /// [m]
    pub radius: f64,
    /// [m]
    pub width: f64,
    /// Its middle, from the body's centre of mass, forward, left and up [m].
    pub position: [f64; 3],
    /// The joint that steers it, if one does.
    pub steered_by: Option<String>,
    /// The joints of rocker and bogie that it hangs on, from the body out.
    pub hangs_on: Vec<String>,
}
