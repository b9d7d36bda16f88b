//! The theories by name.

use super::bekker::Bekker;
use super::extended::Extended;
use super::ishigami::Ishigami;
use super::model::WheelSoilModel;
use super::rft::Rft;

/// A theory that a document or a command can name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theory {
    /// The source paper's: stresses along the arc.
    #[default]
    Ishigami,
    /// Bekker's closed form, as a cross-check.
    Bekker,
    /// The source paper's with the terms that small wheels need.
    Extended,
    /// Resistive force theory on the wheel's facets, independent of the others.
    Rft,
}

impl Theory {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Ishigami, Self::Bekker, Self::Extended, Self::Rft];

    /// Its name in documents and commands.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ishigami => "ishigami",
            Self::Bekker => "bekker",
            Self::Extended => "extended",
            Self::Rft => "rft",
        }
    }

    /// The theory itself.
    #[must_use]
    pub fn model(self) -> &'static dyn WheelSoilModel {
        static ISHIGAMI: Ishigami = Ishigami::DEFAULT;
        static BEKKER: Bekker = Bekker;
        static EXTENDED: Extended = Extended::DEFAULT;
        static RFT: Rft = Rft::DEFAULT;
        match self {
            Self::Ishigami => &ISHIGAMI,
            Self::Bekker => &BEKKER,
            Self::Extended => &EXTENDED,
            Self::Rft => &RFT,
        }
    }
}
