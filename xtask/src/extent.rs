//! How much is tested.

/// How much is tested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Extent {
    /// All but the tests marked `#[ignore]`.
    Usual,
    /// Those too.
    Full,
}
