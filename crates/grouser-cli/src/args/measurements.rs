//! Arguments of `validate`, `calibrate` and `import`.

use std::path::PathBuf;

use clap::builder::NonEmptyStringValueParser;
use clap::{Arg, ArgGroup, Args, ValueEnum};
use grouser::document::FitKey;
use grouser::document::calibration::{AimWords, STEPS, USUAL_STEPS};
use grouser::document::measurements::{Condition, Limits, Mapping};

use super::{OutputArgs, SettingArgs, TelemetryArgs};
use crate::list::{self, Numbers};

/// Limit on files of measurements.
#[derive(Debug, Args)]
pub(crate) struct ReadArgs {
    /// The most rows that are read of a file of measurements, and 256 bytes for each.
    #[arg(long, value_name = "N", default_value_t = Limits::ROWS)]
    pub(crate) max_rows: usize,
}

impl ReadArgs {
    pub(crate) fn limits(&self) -> Limits {
        Limits { rows: self.max_rows }
    }
}

#[derive(Debug, Args)]
#[command(
    override_usage = "grouser validate --data NAME|FILE.csv --wheel NAME|FILE --soil NAME|FILE [OPTIONS]\n       \
                      grouser validate --data NAME|FILE.csv --rover NAME|FILE --soil NAME|FILE [OPTIONS]\n       \
                      grouser validate --data NAME|FILE.toml [OPTIONS]\n       \
                      grouser validate --all [--data-dir DIR] [OPTIONS]\n       \
                      grouser validate --drives DIR --rover NAME|FILE --soil NAME|FILE [OPTIONS]",
    after_help = "Errors are of means over the trials of a cell, which are rows that repeat each \
                  other; every cell weighs the same. Beside them stand predictions without \
                  physics: the mean, and interpolation between the other cells. docs/guide/data.md \
                  lists the columns of FILE.csv, docs/validation.md what the numbers mean."
)]
#[command(group(ArgGroup::new("measured").args(["data", "drives"])))]
#[command(mut_args(only_with_drives))]
pub(crate) struct ValidateArgs {
    /// Measured wheel tests, or a rover's measured slip or yaw over slope: a data set that comes
    /// with the program (`published-wheel-tests`), or a CSV file (docs/guide/data.md lists its
    /// columns). Without a wheel or rover: every model is ranked on the data set.
    #[arg(long, value_name = "NAME|FILE.csv", required_unless_present_any = ["all", "drives"])]
    pub(crate) data: Option<PathBuf>,
    /// Telemetry of drives instead: every log below a folder (CSV, Parquet, Arrow or MCAP, read as `replay`
    /// reads one; files of MCAP in one folder that share no topic are one drive), predicted by every
    /// model from its wheel speeds and attitudes alone. A data set of slopes by its name stands for
    /// its drives.
    #[arg(long, value_name = "DIR|NAME")]
    pub(crate) drives: Option<PathBuf>,
    /// The wheel that was tested: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new(), requires = "data", requires = "soil")]
    pub(crate) wheel: Option<String>,
    /// The rover that was driven on slopes: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new(), requires = "measured", requires = "soil", conflicts_with = "wheel")]
    pub(crate) rover: Option<String>,
    /// The soil of the predictions: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new(), requires = "measured")]
    pub(crate) soil: Option<String>,
    /// Only rows where a column has one of some values, or none of them:
    /// `slip_angle_deg=0,15`, `wheel!=smooth`; can be repeated. `line!=17` leaves out the row on
    /// line 17 of the file.
    #[arg(long = "where", value_name = "COLUMN=VALUES", value_parser = Condition::parse, requires = "data")]
    pub(crate) conditions: Vec<Condition>,
    /// Rank every model, with its own soils, on every data set that comes with the program.
    #[arg(long, conflicts_with_all = ["data", "drives", "wheel", "rover", "soil", "conditions", "settings", "model", "gravity"])]
    pub(crate) all: bool,
    /// Rank on the data sets of a folder instead (docs/guide/data.md explains how a document
    /// describes one).
    #[arg(long, value_name = "DIR", requires = "all")]
    pub(crate) data_dir: Option<PathBuf>,
    /// Accept no extrapolation: a cell that carries a flag of validity is an error, exit code 2.
    #[arg(long, requires = "data")]
    pub(crate) strict: bool,
    #[command(flatten)]
    pub(crate) telemetry: TelemetryArgs,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

/// How telemetry is read is asked of telemetry alone.
fn only_with_drives(argument: Arg) -> Arg {
    let is_of_telemetry =
        ["mapping", "topics", "accept_loss", "odometry"].contains(&argument.get_id().as_str());
    if is_of_telemetry { argument.conflicts_with_all(["data", "all"]) } else { argument }
}

#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  grouser calibrate --data tests.csv --wheel hakuto --soil toyoura \\\n    \
                        --fit soil.pressure_sinkage.k_phi,soil.shear.longitudinal_m=0.001:0.1 --out fit\n  \
                        grouser calibrate --plates plates.csv --shear shear.csv --plate-law bekker \\\n    \
                        --soil dry-sand --out fit\n\
                        The same command goes on with a run that was interrupted."
)]
pub(crate) struct CalibrateArgs {
    /// Measured wheel tests: a data set that comes with the program (`cmu-single-wheel`), or a CSV
    /// file (docs/guide/data.md lists its columns).
    #[arg(
        long,
        value_name = "NAME|FILE.csv",
        required_unless_present_any = ["plates", "shear"],
        requires = "wheel",
        requires = "fit"
    )]
    pub(crate) data: Option<PathBuf>,
    /// The wheel that was tested: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new(), requires = "data")]
    pub(crate) wheel: Option<String>,
    /// The soil to start from, for all values that are not fitted: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) soil: String,
    /// Keys to fit, separated by commas, each with bounds if you like:
    /// `soil.stress_peak.a0=0.2:0.8`.
    #[arg(long, value_name = "KEYS", value_delimiter = ',', value_parser = FitKey::parse, requires = "data")]
    pub(crate) fit: Vec<FitKey>,
    /// Only rows where a column has one of some values, or none of them; can be repeated.
    /// `line!=17` leaves out the row on line 17 of the file.
    #[arg(long = "where", value_name = "COLUMN=VALUES", value_parser = Condition::parse, requires = "data")]
    pub(crate) conditions: Vec<Condition>,
    /// A file of plate-sinkage curves instead: `plate_width_mm`, `plate_diameter_mm` or
    /// `plate_radius_mm`; `sinkage_mm`, `pressure_kpa`.
    #[arg(long, value_name = "FILE.csv", conflicts_with = "data")]
    pub(crate) plates: Option<PathBuf>,
    /// A file of shear tests, alone or beside plates: `shear_displacement_mm`, `shear_stress_kpa`,
    /// `normal_stress_kpa`.
    #[arg(long, value_name = "FILE.csv", conflicts_with = "data")]
    pub(crate) shear: Option<PathBuf>,
    /// The law of the plates; without it the soil's own.
    #[arg(long, value_enum, requires = "plates")]
    pub(crate) plate_law: Option<PlateLawChoice>,
    /// Seed of all random numbers.
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    /// Steps of each walker of the posterior.
    #[arg(long, default_value_t = USUAL_STEPS, value_parser = clap::value_parser!(u64).range(STEPS))]
    pub(crate) steps: u64,
    /// Least squares only, without a posterior.
    #[arg(long)]
    pub(crate) point_fit: bool,
    /// Also fit without each slip angle in turn, and compare there.
    #[arg(long, requires = "data")]
    pub(crate) cross_validate: bool,
    /// The prediction whose uncertainty the proposed runs should reduce most, such as
    /// `side_force_n:load_n=17,slip_ratio=0.2,slip_angle_deg=15`.
    #[arg(long, value_name = "QUANTITY[:SETTINGS]", default_value = AimWords::USUAL_TARGET)]
    pub(crate) target: String,
    /// Number of runs to propose.
    #[arg(long, value_name = "N", default_value_t = AimWords::USUAL_PROPOSALS)]
    pub(crate) propose: usize,
    /// Loads that the stand can run [N]; without it half, once and twice the tests' own.
    #[arg(long, value_name = "LIST", value_parser = list::parse, requires = "data", allow_hyphen_values = true)]
    pub(crate) candidate_load_n: Option<Numbers>,
    /// Slip ratios that the stand can run.
    #[arg(long, value_name = "LIST", value_parser = list::parse, default_value = "-0.6:0.9:0.3", allow_hyphen_values = true)]
    pub(crate) candidate_slip_ratio: Numbers,
    /// Slip angles that the stand can run [°].
    #[arg(long, value_name = "LIST", value_parser = list::parse, default_value = "0,15,30,45", allow_hyphen_values = true)]
    pub(crate) candidate_slip_angle_deg: Numbers,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

/// A pressure-sinkage law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PlateLawChoice {
    /// p = (k_c/b + k_phi) z^n.
    Bekker,
    /// p = (c k_c + density g b k_phi) (z/b)^n.
    Reece,
}

impl PlateLawChoice {
    /// The keyword in documents.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Bekker => "bekker",
            Self::Reece => "reece",
        }
    }
}

#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  grouser import lab.csv --column 'drawbar_pull_n=Fx [kN]:kN' \\\n    \
                        --column 'slip_ratio=slip:%' --column load_n=W --out ours.csv\n\
                        Columns that have Grouser's names already are kept."
)]
pub(crate) struct ImportArgs {
    /// The file (CSV).
    #[arg(value_name = "FILE.csv")]
    pub(crate) file: PathBuf,
    /// One of Grouser's columns from one of the file's, with the unit there; a minus turns the
    /// sign. Can be repeated.
    #[arg(long = "column", value_name = "OURS=[-]THEIRS[:UNIT]", value_parser = Mapping::parse)]
    pub(crate) columns: Vec<Mapping>,
    /// How the file's slip ratio is defined, with the rim's speed wr and the hub's v.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) slip_definition: SlipChoice,
    /// The character between two fields, or `tab`.
    #[arg(long, value_name = "CHAR", default_value = ",")]
    pub(crate) delimiter: String,
    /// Decimals are written with a comma.
    #[arg(long)]
    pub(crate) decimal_comma: bool,
    /// Lines before the header.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) skip_lines: usize,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
    /// Write to a file instead of the standard output.
    #[arg(long, value_name = "FILE.csv")]
    pub(crate) out: Option<PathBuf>,
    /// Replace that file.
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
}

/// A definition of the slip ratio.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum SlipChoice {
    /// (wr - v)/max(wr, v): Grouser's.
    #[default]
    Larger,
    /// 1 - v/wr, in braking too.
    Rim,
    /// wr/v - 1, in driving too.
    Hub,
}
