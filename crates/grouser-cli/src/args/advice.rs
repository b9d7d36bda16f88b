//! Arguments of `learn` about its advice.

use clap::{Args, ValueEnum};
use grouser::studies::learn::advice::TestCost;

use crate::list::{self, Numbers};

#[derive(Debug, Args)]
#[command(next_help_heading = "Advice")]
pub(crate) struct AdviceArgs {
    /// Also advise: the heading to set on each slope, how often to look at the slip, and which test
    /// drive would tell most of these slopes for its cost.
    #[arg(long)]
    pub(crate) advice: bool,
    /// A heading is advised only if it slips at most this much ...
    #[arg(long, value_name = "S", value_parser = list::parse, default_value = "0.6", allow_hyphen_values = true, requires = "advice")]
    pub(crate) no_go_slip_ratio: Numbers,
    /// ... on all but less than this share of the samples.
    #[arg(long, value_name = "P", value_parser = list::parse, default_value = "0.2", allow_hyphen_values = true, requires = "advice")]
    pub(crate) no_go_probability: Numbers,
    /// Looks at the slip are to be so many that the rover gets stuck on at most this share of the
    /// ways of 10 m.
    #[arg(long, value_name = "P", value_parser = list::parse, default_value = "0.01", allow_hyphen_values = true, requires = "advice")]
    pub(crate) stuck_probability: Numbers,
    /// A look may end at most this share of the ways on which the rover would not get stuck.
    #[arg(long, value_name = "P", value_parser = list::parse, default_value = "0.05", allow_hyphen_values = true, requires = "advice")]
    pub(crate) false_stops: Numbers,
    /// Relative error of odometry over the way between two looks.
    #[arg(long, value_name = "Q", value_parser = list::parse, default_value = "0.02", allow_hyphen_values = true, requires = "advice")]
    pub(crate) odometry_error: Numbers,
    /// The soil is another once on so many metres on the mean [m]; 0 where it never is.
    #[arg(long, value_name = "M", value_parser = list::parse, default_value = "200", allow_hyphen_values = true, requires = "advice")]
    pub(crate) soil_change_m: Numbers,
    /// Ways that are simulated to find how often to look, 100 to 100000.
    #[arg(long, value_name = "N", default_value_t = 1000, requires = "advice")]
    #[arg(value_parser = clap::value_parser!(u32).range(100..=100_000), allow_negative_numbers = true)]
    pub(crate) ways: u32,
    /// Time that odometry needs for a look at the slip while the rover goes on [s]; 0 where it
    /// stands meanwhile.
    #[arg(long, value_name = "S", value_parser = list::parse, default_value = "0", allow_hyphen_values = true, requires = "advice")]
    pub(crate) look_s: Numbers,
    /// Slopes that there are for test drives [°]: a list (0,5) or a range (0:10:5).
    #[arg(long, value_name = "LIST", value_parser = list::parse, default_value = "0,5,8", allow_hyphen_values = true, requires = "advice")]
    pub(crate) test_slope_deg: Numbers,
    /// Way of the rims of a test drive [m].
    #[arg(long, value_name = "M", value_parser = list::parse, default_value = "1", allow_hyphen_values = true, requires = "advice")]
    pub(crate) test_way_m: Numbers,
    /// What a test drive costs.
    #[arg(long, value_enum, default_value_t, requires = "advice")]
    pub(crate) test_cost: CostChoice,
}

/// What a test drive costs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum CostChoice {
    /// Work of the wheels that pull, and that by which lost height is won back.
    #[default]
    Energy,
    /// Way of the rims.
    Way,
}

impl From<CostChoice> for TestCost {
    fn from(choice: CostChoice) -> Self {
        match choice {
            CostChoice::Energy => Self::Energy,
            CostChoice::Way => Self::Way,
        }
    }
}
