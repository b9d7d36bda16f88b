//! The wheel–soil models by name.

use super::bekker::Bekker;
use super::ishigami::Ishigami;
use super::model::WheelSoilModel;
use super::rft::Rft;
use super::small_wheel::SmallWheel;

/// A wheel–soil model, by the name that a document or a command has for it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theory {
    /// The source paper's: stresses along the arc.
    #[default]
    Ishigami,
    /// Bekker's closed form, as a cross-check.
    Bekker,
    /// The source paper's with the terms that small wheels need.
    SmallWheel,
    /// Resistive force theory on the wheel's facets, independent of the others.
    Rft,
}

impl Theory {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Ishigami, Self::Bekker, Self::SmallWheel, Self::Rft];

    /// Its name in documents and commands.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ishigami => "ishigami",
            Self::Bekker => "bekker",
            Self::SmallWheel => "small-wheel",
            Self::Rft => "rft",
        }
    }

    /// The model itself.
    #[must_use]
    pub fn model(self) -> &'static dyn WheelSoilModel {
        static ISHIGAMI: Ishigami = Ishigami::DEFAULT;
        static BEKKER: Bekker = Bekker;
        static SMALL_WHEEL: SmallWheel = SmallWheel::DEFAULT;
        static RFT: Rft = Rft::DEFAULT;
        match self {
            Self::Ishigami => &ISHIGAMI,
            Self::Bekker => &BEKKER,
            Self::SmallWheel => &SMALL_WHEEL,
            Self::Rft => &RFT,
        }
    }
}
