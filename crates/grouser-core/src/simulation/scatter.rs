//! What scatters in a run: the soil from place to place, the motors' speeds from wheel to wheel.

use crate::elementary;
use crate::error::{ParameterError, not_negative, positive};
use crate::random::Random;
use crate::terrain::{SoilField, SoilScatter};

/// A bed that was not raked evenly, and motors that do not turn alike: standard deviations, and
/// which of the beds and motors that they describe a run has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatter {
    /// Scatter of the soil, from place to place.
    pub soil: SoilScatter,
    /// Standard deviation of the logarithm of each wheel's speed over the commanded one [-]; it
    /// stays over a run.
    pub speed: f64,
    /// Which realisation.
    pub seed: u64,
}

/// The largest seed of a document.
pub use crate::random::LARGEST_SEED;

/// The stream of random numbers that speeds are made of.
const SPEEDS: u64 = 1;

impl Scatter {
    /// A length to begin with [m]. Source: ours, about that of a wheel's rut or a rake's pass.
    pub const USUAL_LENGTH: f64 = 0.3;

    /// None: what a scenario says holds everywhere.
    pub const NONE: Self = Self {
        soil: SoilScatter {
            friction_angle: 0.0,
            stiffness: 0.0,
            correlation_length: Self::USUAL_LENGTH,
        },
        speed: 0.0,
        seed: 0,
    };

    /// Whether anything scatters.
    #[must_use]
    pub fn is_any(&self) -> bool {
        self.has_soil() || self.speed > 0.0
    }

    /// The same scatter in the realisation of a case: it depends on the seed and the case alone.
    #[must_use]
    pub fn of_case(self, seed: u64, case: u64) -> Self {
        let seed = Random::of_case(seed, case);
        Self { seed, ..self }
    }

    /// How the soil differs by place, if it scatters.
    #[must_use]
    pub fn soil_field(&self) -> Option<SoilField> {
        self.has_soil().then(|| SoilField::new(self.soil, self.seed))
    }

    /// Factors on the wheels' speeds [-], in the mounts' order.
    pub fn speed_factors(&self) -> impl Iterator<Item = f64> + use<> {
        let (mut random, deviation) = (Random::stream(self.seed, SPEEDS), self.speed);
        std::iter::repeat_with(move || elementary::exp(deviation * random.normal()))
    }

    /// Checks that no deviation is negative, and that the correlation length is positive.
    ///
    /// # Errors
    /// [`ParameterError`] for the first value that is wrong.
    pub fn check(&self) -> Result<(), ParameterError> {
        not_negative("scatter of the friction angle [rad]", self.soil.friction_angle)?;
        not_negative("scatter of the stiffness", self.soil.stiffness)?;
        not_negative("scatter of the speed", self.speed)?;
        positive("correlation length [m]", self.soil.correlation_length)
    }

    fn has_soil(&self) -> bool {
        self.soil.friction_angle > 0.0 || self.soil.stiffness > 0.0
    }
}
