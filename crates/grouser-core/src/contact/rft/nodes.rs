//! How the integrals over facets are computed.

use crate::contact::gauss::Rule;

/// The rules of the integrals over facets.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nodes {
    /// Over half the arc; they fill the lanes.
    pub(super) arc: &'static Rule,
    /// Along a ray of the side face.
    pub(super) disc: &'static Rule,
    /// Over the height of a grouser.
    pub(super) height: &'static Rule,
}
