//! The factors of a forecast: what they are called, their levels, and what would make each of them
//! smaller.

use crate::studies::ensemble::models::ModelSpread;

/// What a forecast does not know of one ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FactorKind {
    /// How moduli scale with gravity.
    GravityScaling,
    /// The rover's mass.
    RoverMass,
    /// The wheel–soil model.
    Model,
    /// The numbers of the soil.
    SoilParameters,
    /// What the model gets wrong under this wheel.
    ModelDiscrepancy,
}

impl FactorKind {
    /// All of them, in the order of their levels in a case: the last varies fastest.
    pub const ALL: [Self; 5] = [
        Self::RoverMass,
        Self::Model,
        Self::SoilParameters,
        Self::ModelDiscrepancy,
        Self::GravityScaling,
    ];

    /// The name: `gravity-scaling`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::GravityScaling => "gravity-scaling",
            Self::RoverMass => "rover-mass",
            Self::Model => "model",
            Self::SoilParameters => "soil-parameters",
            Self::ModelDiscrepancy => "model-discrepancy",
        }
    }

    /// What would make its part smaller, a sentence.
    #[must_use]
    pub const fn remedy(self) -> &'static str {
        match self {
            Self::GravityScaling => {
                "plate and wheel tests of one soil under several gravities, in partial-gravity \
                 flights, a drop tower or at the site, tell which moduli grow with gravity"
            }
            Self::RoverMass => "the mass of the rover that flies, in place of the variants",
            Self::Model => {
                "wheel tests with the wheel that flies, over slip and slip angle, rank the models; \
                 a soil made for one of them keeps it in four fifths of the cases"
            }
            Self::SoilParameters => {
                "wheel or plate tests of the soil: a calibration narrows its numbers, and shows \
                 which of them matter"
            }
            Self::ModelDiscrepancy => {
                "wheel tests with the wheel that flies: a calibration finds what the model gets \
                 wrong under it"
            }
        }
    }
}

/// What would make the part smaller that no factor has alone.
pub const REMEDY_OF_INTERACTIONS: &str = "no measurement of its own: it comes down with the \
                                          factors whose total is much larger than their part";

/// A factor with its levels.
#[derive(Clone, Debug, PartialEq)]
pub struct Factor {
    /// What it is.
    pub kind: FactorKind,
    /// Its levels; one where nothing is open.
    pub levels: Vec<Level>,
}

/// A level of a factor.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Its name: that of a choice or a model, or the number of a sample.
    pub name: String,
    /// How often it counts.
    pub count: u32,
}

impl Factor {
    /// Choices, of which all count alike.
    pub(super) fn named<'a>(kind: FactorKind, names: impl Iterator<Item = &'a str>) -> Self {
        let level = |name: &str| Level { name: name.to_owned(), count: 1 };
        Self { kind, levels: names.map(level).collect() }
    }

    /// Samples.
    pub(super) fn numbered(kind: FactorKind, count: u32) -> Self {
        let level = |number: u32| Level { name: number.to_string(), count: 1 };
        Self { kind, levels: (0..count).map(level).collect() }
    }

    /// Models by their shares.
    pub(super) fn of_models(models: &ModelSpread) -> Self {
        let shares = models.shares();
        /// Into how many parts shares are cut: outputs are repeated as often as they count.
        const PARTS: f64 = 20.0;
        let level = |(model, share): &(crate::contact::Model, f64)| {
            // At most all parts, and no negative number.
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let count = (PARTS * share).round().max(1.0) as u32;
            Level { name: model.name().to_owned(), count }
        };
        Self { kind: FactorKind::Model, levels: shares.iter().map(level).collect() }
    }

    /// Whether it is a choice or the model, whose levels have names.
    #[must_use]
    pub fn is_named(&self) -> bool {
        !matches!(self.kind, FactorKind::SoilParameters | FactorKind::ModelDiscrepancy)
    }

    /// How often each of its levels counts.
    pub(super) fn counts(&self) -> Vec<u32> {
        self.levels.iter().map(|level| level.count).collect()
    }

    /// The share of a level [-].
    #[must_use]
    pub fn share(&self, level: &Level) -> f64 {
        let all: u32 = self.levels.iter().map(|it| it.count).sum();
        f64::from(level.count) / f64::from(all)
    }
}
