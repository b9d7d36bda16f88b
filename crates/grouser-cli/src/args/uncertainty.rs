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

/// Samples of soil and model by which a question is answered, or none.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct BeliefArgs {
    /// Answer by the soil as its document has it and by one model, without samples.
    #[arg(long, conflicts_with_all = ["samples", "seed", "uncertainty"])]
    pub(crate) nominal: bool,
    /// Number of samples of soil and model, 2 to 100000. Without it a draft of 40.
    #[arg(long, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=100_000), allow_negative_numbers = true)]
    pub(crate) samples: Option<u32>,
    /// Seed of the samples: the same seed gives the same soils and models. Without it 1.
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    pub(crate) seed: Option<u64>,
    /// Samples are the usual answer: it changes nothing.
    #[arg(long, hide = true)]
    pub(crate) uncertainty: bool,
}

impl BeliefArgs {
    /// How many samples a first answer has: its bands are rough, and it comes at once.
    const DRAFT: u32 = 40;

    /// The samples, unless the question is about the soil as written.
    pub(crate) fn sampling(self) -> Option<Sampling> {
        let (count, seed) = (self.samples.unwrap_or(Self::DRAFT), self.seed.unwrap_or(1));
        (!self.nominal).then_some(Sampling { count, seed })
    }

    /// Whether samples are asked for by name.
    pub(crate) fn is_asked_for(self) -> bool {
        self.uncertainty || self.samples.is_some() || self.seed.is_some()
    }
}

/// The arguments that need a seed.
pub(super) const DRAWN: &str = "drawn";
