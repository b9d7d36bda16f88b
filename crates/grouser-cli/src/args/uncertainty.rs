//! Arguments of everything that gives bands.

use clap::Args;
use grouser::answers::Sampling;

/// Samples of soil and model.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct SamplingArgs {
    /// Add 95 % bands over samples of what is uncertain: the soil, where its document says so, and
    /// the wheel-soil model, where no --model is given.
    #[arg(long, group = DRAWN)]
    pub(crate) uncertainty: bool,
    /// Number of samples, 2 to 100000.
    #[arg(long, value_name = "N", default_value_t = 200, requires = "uncertainty")]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=100_000), allow_negative_numbers = true)]
    pub(crate) samples: u32,
}

/// Samples of soil and model, and their seed.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct UncertaintyArgs {
    #[command(flatten)]
    pub(crate) sampling: SamplingArgs,
    /// Seed of the samples: the same seed gives the same soils and models.
    #[arg(long, value_name = "S", default_value_t = 1, requires = DRAWN)]
    #[arg(allow_negative_numbers = true)]
    pub(crate) seed: u64,
}

impl SamplingArgs {
    /// The samples that are asked for, if any are.
    pub(crate) fn with_seed(self, seed: u64) -> Option<Sampling> {
        self.uncertainty.then_some(Sampling { count: self.samples, seed })
    }
}

impl UncertaintyArgs {
    /// The samples that are asked for, if any are.
    pub(crate) fn sampling(self) -> Option<Sampling> {
        self.sampling.with_seed(self.seed)
    }
}

/// The arguments that need a seed.
pub(super) const DRAWN: &str = "drawn";
