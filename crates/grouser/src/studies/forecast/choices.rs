//! What no sample of a soil decides: how moduli scale, what the ground of the site is, what the
//! rover weighs.

use grouser_io::{LoadedSoil, UncertainSoil};

use crate::error::{ParameterError, positive};
use crate::soil::{GravityScaling, Soil};
use crate::studies::ensemble::NothingAccepted;

/// The named choices of a forecast; of each at least one.
#[derive(Clone, Debug)]
pub struct Choices {
    /// How moduli scale with gravity.
    pub scalings: Vec<GravityScaling>,
    /// Whose strength and density the ground of the site has.
    pub grounds: Vec<Ground>,
    /// What the rover weighs there.
    pub masses: Vec<RoverMass>,
}

/// The ground of the site.
#[derive(Clone, Debug)]
pub enum Ground {
    /// The soil as it was measured.
    AsMeasured,
    /// The measured soil with cohesion, friction angle and density of another one, which is known
    /// for the site; moduli and all else stay.
    Site(Box<SiteSoil>),
}

/// A soil that is known for a site.
#[derive(Clone, Debug)]
pub struct SiteSoil {
    /// The name by which it was asked for.
    pub name: String,
    /// The soil as its document has it.
    pub soil: Soil,
    /// The soils that it may be, if its document leaves any of that open.
    pub soils: Option<UncertainSoil>,
}

/// A rover's mass, by a name.
#[derive(Clone, Debug, PartialEq)]
pub struct RoverMass {
    /// Its name: `equal-mass`.
    pub name: String,
    /// The mass over that of the rover's document [-].
    pub factor: f64,
}

impl Choices {
    /// Scalings for the soil and the rover as they are.
    #[must_use]
    pub fn of_scalings(scalings: impl IntoIterator<Item = GravityScaling>) -> Self {
        Self {
            scalings: scalings.into_iter().collect(),
            grounds: vec![Ground::AsMeasured],
            masses: vec![RoverMass { name: "equal-mass".to_owned(), factor: 1.0 }],
        }
    }

    /// Checks that there is at least one scaling, ground and mass, and that every mass factor is
    /// positive.
    pub(super) fn check(&self) -> Result<(), ParameterError> {
        let counts = [
            ("the number of gravity scalings", self.scalings.len()),
            ("the number of grounds", self.grounds.len()),
            ("the number of rover masses", self.masses.len()),
        ];
        for (name, count) in counts {
            positive(name, count as f64)?;
        }
        self.masses.iter().try_for_each(|mass| positive("mass factor", mass.factor))
    }
}

/// Soils of the site are drawn by another seed than those that were measured: the two have nothing
/// in common.
fn seed_of_site(seed: u64) -> u64 {
    !seed
}

impl Ground {
    /// The ground of a soil's document.
    #[must_use]
    pub fn of_soil(name: &str, soil: &LoadedSoil) -> Self {
        let (name, soils) = (name.to_owned(), soil.uncertain.clone());
        Self::Site(Box::new(SiteSoil { name, soil: soil.value, soils }))
    }

    /// Its name: `as-measured`, or that of the soil.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::AsMeasured => "as-measured",
            Self::Site(site) => &site.name,
        }
    }

    /// Whether it differs from sample to sample by itself.
    #[must_use]
    pub fn is_uncertain(&self) -> bool {
        matches!(self, Self::Site(site) if site.soils.is_some())
    }

    /// The soil of the site in sample `number`, if the ground is not as measured.
    pub(super) fn drawn(&self, seed: u64, number: u64) -> Result<Option<Soil>, NothingAccepted> {
        match self {
            Self::AsMeasured => Ok(None),
            Self::Site(site) => match &site.soils {
                Some(soils) => soils.draw(seed_of_site(seed), number).map(Some),
                None => Ok(Some(site.soil)),
            },
        }
    }

    /// The same as its document is written.
    pub(super) fn as_written(&self) -> Option<Soil> {
        match self {
            Self::AsMeasured => None,
            Self::Site(site) => Some(site.soil),
        }
    }
}

/// A soil with cohesion, friction angle and density of the site's, if there is one.
pub(super) fn with_strength_of(soil: Soil, site: Option<Soil>) -> Soil {
    let Some(Soil { cohesion, friction_angle, density, .. }) = site else { return soil };
    Soil { cohesion, friction_angle, density, ..soil }
}
