//! What can be asked on the command line.

use std::path::PathBuf;

use clap::builder::NonEmptyStringValueParser;
use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use grouser::document::calibration::STEPS;
use grouser::document::measurements::{Condition, Limits, Mapping};
use grouser::document::{FitKey, Kind};
use grouser_store::Part;

use crate::list::{self, Numbers};
use crate::output::Format;

/// Predicts how a wheeled rover moves on loose soil: sinkage, slip, drift, the yaw that keeps a
/// traverse level on a slope, energy.
#[derive(Debug, Parser)]
#[command(name = "grouser", version, max_term_width = 100, arg_required_else_help = true)]
#[command(after_help = "Start with `grouser reproduce`: the source paper's study, as a page to \
                        open in a browser. Exit codes: 0 done, 1 the run or the disk failed, 2 \
                        wrong use or a bad document, 3 some runs of a campaign failed, 130 interrupted.")]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Run the source paper's study and write its report.
    Reproduce(ReproduceArgs),
    /// Drive a rover across a slope and say where it ends up.
    Traverse(TraverseArgs),
    /// Forces, torque and sinkage of one wheel over load, slip ratio and slip angle.
    WheelTest(WheelTestArgs),
    /// The yaw that keeps a traverse level on a slope, and the steepest slope that has one.
    Attitude(AttitudeArgs),
    /// The yaw that keeps a course on a slope, over slope, course and soil.
    AttitudeMap(AttitudeMapArgs),
    /// The operator's card: heading, slip, drift, power and go or no-go for each slope, on one page.
    Card(CardArgs),
    /// Compare a theory with measured wheel tests, or rank all theories.
    Validate(ValidateArgs),
    /// Find the soil that measured wheel tests, or plate tests, speak for, and how surely.
    Calibrate(CalibrateArgs),
    /// Many runs over what is not known exactly, and what they say together.
    Campaign(CampaignArgs),
    /// Turn another laboratory's CSV into the layout that `validate` reads.
    Import(ImportArgs),
    /// Measure how fast and how accurately this machine computes.
    Bench(BenchArgs),
    /// Check documents: soils, wheels, rovers, scenarios.
    Check(CheckArgs),
    /// List the presets with their sources, or print one as TOML.
    Presets(PresetsArgs),
    /// Print the JSON Schema of a kind of document.
    Schema(SchemaArgs),
    /// Print a completion script for a shell.
    Completions(CompletionsArgs),
}

#[derive(Debug, Args)]
pub(crate) struct ReproduceArgs {
    /// Folder for the report; without it `reproduction/`, where an earlier report is replaced.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Replace files of the same names in DIR.
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
}

/// Where results go, and in which form.
#[derive(Debug, Args)]
pub(crate) struct OutputArgs {
    /// Form of what is printed.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
    /// Also write results, figure and the resolved documents to a folder.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Replace files of the same names in DIR.
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
}

/// How much of a file of measurements is read.
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

/// What most commands can change about their documents.
#[derive(Debug, Args)]
pub(crate) struct SettingArgs {
    /// Override a key of a document, such as `soil.cohesion_kpa=0.5`; can be repeated.
    #[arg(long = "set", value_name = "DOCUMENT.KEY=VALUE")]
    pub(crate) settings: Vec<String>,
    /// The theory: `ishigami`, `bekker`, `extended` or `rft`; without it the soil's own, or else `ishigami`.
    #[arg(long, value_name = "NAME")]
    pub(crate) model: Option<String>,
    /// Gravity [m/s²], or `earth`, `moon`, `mars`.
    #[arg(long = "gravity-m-s2", value_name = "G", allow_hyphen_values = true)]
    pub(crate) gravity: Option<String>,
}

/// How the weight acts on the wheels.
#[derive(Debug, Args)]
pub(crate) struct BalanceArgs {
    /// Sharing of the weight: `quasi-static`, `quasi-static-torque` or `uniform`.
    #[arg(long, value_name = "LAW")]
    pub(crate) loads: Option<String>,
    /// The wheels' own moments: `neglected` or `included`.
    #[arg(long, value_name = "WORD")]
    pub(crate) moments: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct TraverseArgs {
    /// A scenario's file or preset; without it the default scenario.
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub(crate) scenario: Option<String>,
    /// The rover: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) rover: Option<String>,
    /// The soil: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) soil: Option<String>,
    /// Inclination of the slope [°].
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    pub(crate) slope_deg: Option<String>,
    /// Yaw at the start [°], positive uphill.
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    pub(crate) yaw_deg: Option<String>,
    /// Length of the run [s].
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub(crate) duration_s: Option<String>,
    /// Rim speed [m/s], or one for each wheel: `-0.06,-0.06,0.06,0.06`.
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    pub(crate) speed_m_s: Option<String>,
    /// What turns the wheels: `constant`, `eq18-as-printed` or `eq18`.
    #[arg(long, value_name = "LAW")]
    pub(crate) drive: Option<String>,
    /// Reference slip ratio of the Eq. 18 drives.
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub(crate) reference_slip_ratio: Option<String>,
    /// Motion at the start: `rolling` or `rest`.
    #[arg(long, value_name = "WORD")]
    pub(crate) start: Option<String>,
    /// `dynamic`, or `quasi-steady`: velocities in balance at every instant, many times faster.
    #[arg(long, value_name = "WORD")]
    pub(crate) simulation: Option<String>,
    #[command(flatten)]
    pub(crate) balance: BalanceArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

#[derive(Debug, Args)]
pub(crate) struct WheelTestArgs {
    /// The soil: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new(), default_value = "toyoura")]
    pub(crate) soil: String,
    /// The wheel: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new(), default_value = "hakuto")]
    pub(crate) wheel: String,
    /// Loads on the wheel [N]: a list (5,10) or a range (0:20:5).
    #[arg(long, value_name = "LIST", value_parser = list::parse, default_value = "17", allow_hyphen_values = true)]
    pub(crate) load_n: Numbers,
    /// Slip ratios, -2 to 2: driving above 0, skid down to -1 (locked); beyond ±1 rim and hub
    /// oppose each other.
    #[arg(long, value_name = "LIST", value_parser = list::parse, default_value = "0:0.9:0.1", allow_hyphen_values = true)]
    pub(crate) slip_ratio: Numbers,
    /// Slip angles [°], -90 to 90, positive where the hub moves to the left.
    #[arg(long, value_name = "LIST", value_parser = list::parse, default_value = "0", allow_hyphen_values = true)]
    pub(crate) slip_angle_deg: Numbers,
    #[command(flatten)]
    pub(crate) stand: StandArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

/// A test stand that does not read exactly.
#[derive(Debug, Args)]
pub(crate) struct StandArgs {
    /// Simulate a test stand: run each setting N times, with noise on what the stand reads.
    #[arg(long, value_name = "N")]
    pub(crate) trials: Option<usize>,
    /// Standard deviation of the simulated forces [N].
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0.3,
        requires = "trials",
        allow_negative_numbers = true
    )]
    pub(crate) noise_n: f64,
    /// Standard deviation of the simulated sinkage [mm].
    #[arg(
        long,
        value_name = "MM",
        default_value_t = 0.5,
        requires = "trials",
        allow_negative_numbers = true
    )]
    pub(crate) noise_mm: f64,
    /// Standard deviation of the simulated torque [N·m].
    #[arg(
        long,
        value_name = "NM",
        default_value_t = 0.02,
        requires = "trials",
        allow_negative_numbers = true
    )]
    pub(crate) noise_nm: f64,
    /// What the noise is drawn from: the same seed makes the same test.
    #[arg(long, default_value_t = 1, requires = "trials")]
    pub(crate) seed: u64,
}

#[derive(Debug, Args)]
pub(crate) struct AttitudeArgs {
    /// A scenario's file or preset, for its rover, soil, gravity and balance; without it the
    /// default scenario.
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub(crate) scenario: Option<String>,
    /// The rover: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) rover: Option<String>,
    /// The soil: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) soil: Option<String>,
    /// Slopes [°]: a list (5,10) or a range (0:20:2.5).
    #[arg(long, value_name = "LIST", value_parser = list::parse, default_value = "5,10,15,20", allow_hyphen_values = true)]
    pub(crate) slope_deg: Numbers,
    #[command(flatten)]
    pub(crate) uncertainty: UncertaintyArgs,
    #[command(flatten)]
    pub(crate) balance: BalanceArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

#[derive(Debug, Args)]
#[command(after_help = "A course is a direction of travel, counted from the contour and positive \
                        uphill; course 0 is what `attitude` asks. A row without an attitude says \
                        why in its status.")]
pub(crate) struct AttitudeMapArgs {
    /// A scenario's file or preset, for its rover, soil, gravity and balance; without it the
    /// default scenario.
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub(crate) scenario: Option<String>,
    /// The rover: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) rover: Option<String>,
    /// The soils, separated by commas: presets or files.
    #[arg(long, value_name = "NAMES|FILES", value_delimiter = ',', value_parser = NonEmptyStringValueParser::new())]
    pub(crate) soil: Vec<String>,
    /// Slopes [°]: a list (5,10) or a range (0:20:2.5).
    #[arg(long, value_name = "LIST", value_parser = list::parse, default_value = "0:24:2", allow_hyphen_values = true)]
    pub(crate) slope_deg: Numbers,
    /// Courses [°], -90 to 90: 0 along the contour, positive uphill.
    #[arg(long, value_name = "LIST", value_parser = list::parse, default_value = "-60:60:15", allow_hyphen_values = true)]
    pub(crate) course_deg: Numbers,
    /// Rim speed [m/s], for the power.
    #[arg(long, value_name = "V", value_parser = list::parse, default_value = "0.06", allow_hyphen_values = true)]
    pub(crate) speed_m_s: Numbers,
    #[command(flatten)]
    pub(crate) balance: BalanceArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

/// Whether a soil's uncertainty is followed, and by how many draws.
#[derive(Debug, Args)]
pub(crate) struct UncertaintyArgs {
    /// Draw soils as the soil's `[uncertainty]` says, and add 95 % bands and the probability of a
    /// level traverse.
    #[arg(long)]
    pub(crate) uncertainty: bool,
    /// Number of draws, 2 to 100000.
    #[arg(long, value_name = "N", default_value_t = 500, requires = "uncertainty")]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=100_000), allow_negative_numbers = true)]
    pub(crate) samples: u32,
    /// Seed of the draws: the same seed, the same soils.
    #[arg(long, value_name = "S", default_value_t = 1, requires = "uncertainty")]
    #[arg(allow_negative_numbers = true)]
    pub(crate) seed: u64,
}

#[derive(Debug, Args)]
#[command(
    after_help = "A soil with an [uncertainty] is drawn N times, and every number has a 95 % \
                        band; on any other soil there is no band, and slopes are judged with a \
                        margin. docs/guide/card.md shows a card and tells how to read it."
)]
pub(crate) struct CardArgs {
    /// A scenario's file or preset, for its rover, soil, gravity, balance and rim speed; without
    /// it the default scenario.
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub(crate) scenario: Option<String>,
    /// The rover: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) rover: Option<String>,
    /// The soil: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) soil: Option<String>,
    /// The side of the rover that is uphill. On a rover that is its own mirror image it does not
    /// matter.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) uphill: SideWord,
    /// Rim speed [m/s], for the power; without it the scenario's.
    #[arg(long, value_name = "V", value_parser = list::parse, allow_hyphen_values = true)]
    pub(crate) speed_m_s: Option<Numbers>,
    /// Number of drawn soils, 2 to 100000.
    #[arg(long, value_name = "N", default_value_t = 500)]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=100_000), allow_negative_numbers = true)]
    pub(crate) samples: u32,
    /// Seed of the draws: the same seed, the same soils.
    #[arg(long, value_name = "S", default_value_t = 1, allow_negative_numbers = true)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) rule: RuleArgs,
    /// Compare with measured yaws (CSV): a column `slope_deg`, and others that end in `yaw_deg`. The
    /// table is then the comparison, and the card shows them as crosses.
    #[arg(long, value_name = "FILE.csv")]
    pub(crate) measured: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
    #[command(flatten)]
    pub(crate) balance: BalanceArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    /// Form of what is printed.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
    /// Write the card: a file that ends in .html, .pdf, .png or .svg, or a folder for all of them
    /// with the numbers and the resolved documents.
    #[arg(long, value_name = "FILE|DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Replace that file, or files of the same names in that folder.
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
}

/// When to go and when not to.
#[derive(Debug, Args)]
pub(crate) struct RuleArgs {
    /// Go: a level traverse slips at most this much ...
    #[arg(long, value_name = "S", value_parser = list::parse, default_value = "0.3", allow_hyphen_values = true)]
    pub(crate) go_slip_ratio: Numbers,
    /// ... on at least this share of the drawn soils.
    #[arg(long, value_name = "P", value_parser = list::parse, default_value = "0.95", allow_hyphen_values = true)]
    pub(crate) go_probability: Numbers,
    /// No-go: a level traverse slips at most this much ...
    #[arg(long, value_name = "S", value_parser = list::parse, default_value = "0.6", allow_hyphen_values = true)]
    pub(crate) no_go_slip_ratio: Numbers,
    /// ... on less than this share of the drawn soils.
    #[arg(long, value_name = "P", value_parser = list::parse, default_value = "0.8", allow_hyphen_values = true)]
    pub(crate) no_go_probability: Numbers,
    /// On a soil without stated uncertainty a slope is judged as if it were steeper by this [°].
    #[arg(long, value_name = "DEG", value_parser = list::parse, default_value = "5", allow_hyphen_values = true)]
    pub(crate) margin_deg: Numbers,
}

/// A side of the rover.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum SideWord {
    /// Uphill is on the left.
    #[default]
    Left,
    /// Uphill is on the right.
    Right,
}

#[derive(Debug, Args)]
#[command(
    override_usage = "grouser validate --data NAME|FILE.csv --wheel NAME|FILE --soil NAME|FILE [OPTIONS]\n       \
                      grouser validate --all [--data-dir DIR] [OPTIONS]",
    after_help = "Errors are of means over the trials of a cell, which are rows that repeat each \
                  other; every cell weighs the same. docs/guide/data.md tells the columns of FILE.csv, \
                  docs/validation.md what the numbers mean."
)]
pub(crate) struct ValidateArgs {
    /// Measured wheel tests: a data set that comes with the program (`cmu-single-wheel`), or a CSV file
    /// (docs/guide/data.md tells its columns).
    #[arg(
        long,
        value_name = "NAME|FILE.csv",
        required_unless_present = "all",
        requires = "wheel",
        requires = "soil"
    )]
    pub(crate) data: Option<PathBuf>,
    /// The wheel that was tested: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new(), requires = "data")]
    pub(crate) wheel: Option<String>,
    /// The soil to judge: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new(), requires = "data")]
    pub(crate) soil: Option<String>,
    /// Only rows where a column has one of some values, or none of them:
    /// `slip_angle_deg=0,15`, `wheel!=smooth`; can be repeated.
    #[arg(long = "where", value_name = "COLUMN=VALUES", value_parser = Condition::parse, requires = "data")]
    pub(crate) conditions: Vec<Condition>,
    /// Rank every theory, with its own soils, on every data set that comes with the program.
    #[arg(long, conflicts_with_all = ["data", "wheel", "soil", "conditions", "settings", "model", "gravity"])]
    pub(crate) all: bool,
    /// Rank on the data sets of a folder instead (docs/guide/data.md tells how a document describes one).
    #[arg(long, value_name = "DIR", requires = "all")]
    pub(crate) data_dir: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  grouser calibrate --data tests.csv --wheel hakuto --soil toyoura \\\n    \
                        --fit soil.pressure_sinkage.k_phi,soil.shear.longitudinal_m=0.001:0.1 --out fit\n  \
                        grouser calibrate --plates plates.csv --plate-law bekker --soil dry-sand --out fit\n\
                        The same command goes on with a run that was interrupted."
)]
pub(crate) struct CalibrateArgs {
    /// Measured wheel tests: a data set that comes with the program (`cmu-single-wheel`), or a CSV file
    /// (docs/guide/data.md tells its columns).
    #[arg(
        long,
        value_name = "NAME|FILE.csv",
        required_unless_present = "plates",
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
    /// Keys to fit, separated by commas, each with bounds if you like: `soil.stress_peak.a0=0.2:0.8`.
    #[arg(long, value_name = "KEYS", value_delimiter = ',', value_parser = FitKey::parse, requires = "data")]
    pub(crate) fit: Vec<FitKey>,
    /// Only rows where a column has one of some values, or none of them; can be repeated.
    #[arg(long = "where", value_name = "COLUMN=VALUES", value_parser = Condition::parse, requires = "data")]
    pub(crate) conditions: Vec<Condition>,
    /// A file of plate-sinkage curves instead: `plate_width_mm`, `sinkage_mm`, `pressure_kpa`.
    #[arg(long, value_name = "FILE.csv", conflicts_with = "data")]
    pub(crate) plates: Option<PathBuf>,
    /// The law of the plates; without it the soil's own.
    #[arg(long, value_enum, requires = "plates")]
    pub(crate) plate_law: Option<PlateLawWord>,
    /// Seed of all random numbers.
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    /// Steps of each walker of the posterior.
    #[arg(long, default_value_t = 400, value_parser = clap::value_parser!(u64).range(STEPS))]
    pub(crate) steps: u64,
    /// Only least squares, no posterior.
    #[arg(long)]
    pub(crate) point_fit: bool,
    /// Also fit without each slip angle in turn, and judge there.
    #[arg(long, requires = "data")]
    pub(crate) cross_validate: bool,
    /// The prediction that the next runs should make sure of, such as
    /// `side_force_n:load_n=17,slip_ratio=0.2,slip_angle_deg=15`.
    #[arg(
        long,
        value_name = "QUANTITY[:SETTINGS]",
        default_value = "drawbar_pull_n:slip_ratio=0.2"
    )]
    pub(crate) target: String,
    /// How many runs to propose.
    #[arg(long, value_name = "N", default_value_t = 3)]
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
pub(crate) enum PlateLawWord {
    /// p = (k_c/b + k_phi) z^n.
    Bekker,
    /// p = (c k_c + density g b k_phi) (z/b)^n.
    Reece,
}

impl PlateLawWord {
    /// The word in documents.
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
                        Columns that have our names already are taken along."
)]
pub(crate) struct ImportArgs {
    /// The file (CSV).
    #[arg(value_name = "FILE.csv")]
    pub(crate) file: PathBuf,
    /// A column of ours from one of theirs, with its unit; a minus turns the sign. Can be
    /// repeated.
    #[arg(long = "column", value_name = "OURS=[-]THEIRS[:UNIT]", value_parser = Mapping::parse)]
    pub(crate) columns: Vec<Mapping>,
    /// How the file's slip ratio is defined, with the rim's speed wr and the hub's v.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) slip_definition: SlipWord,
    /// What stands between two fields: a character, or `tab`.
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
pub(crate) enum SlipWord {
    /// (wr - v)/max(wr, v): Grouser's.
    #[default]
    Larger,
    /// 1 - v/wr, in braking too.
    Rim,
    /// wr/v - 1, in driving too.
    Hub,
}

#[derive(Debug, Args)]
pub(crate) struct CampaignArgs {
    #[command(subcommand)]
    pub(crate) command: CampaignCommand,
}

#[derive(Debug, Subcommand)]
pub(crate) enum CampaignCommand {
    /// Compute a campaign's runs, or those that are missing.
    Run(CampaignRunArgs),
    /// Compute one run again, and compare it with what is stored.
    Rerun(CampaignRerunArgs),
    /// Bring the parts of an array of jobs together.
    Merge(CampaignMergeArgs),
    /// What the runs say together: quantiles, probabilities, convergence, sensitivities.
    Summarise(CampaignSummariseArgs),
    /// The SHA-256 over all results.
    Digest(CampaignDigestArgs),
    /// Measure what studies cost: runs per core and second, bytes per run, and what that means for many.
    Cost(CampaignCostArgs),
}

#[derive(Debug, Args)]
#[command(
    after_help = "The same command goes on with a campaign that was interrupted in any way. Exit codes: 0 all \
                        runs are there, 3 some of them failed (their rows say why), 130 interrupted."
)]
pub(crate) struct CampaignRunArgs {
    /// The study: a campaign document's file or preset.
    #[arg(value_name = "STUDY", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) study: String,
    /// Folder for the results: a new one, or that of the same study.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Threads, or worker processes; without it as many as there are cores.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    pub(crate) threads: Option<u16>,
    /// Only part I of N of an array of jobs, counted from 1; `campaign merge` brings parts together.
    #[arg(long, value_name = "I/N", value_parser = parse_part)]
    pub(crate) shard: Option<Part>,
    /// What computes: threads of this program, or the Python package with its processes, Dask or Ray.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) executor: ExecutorWord,
    /// Where the cluster's scheduler listens, for `dask` and `ray`.
    #[arg(long, value_name = "ADDRESS")]
    pub(crate) scheduler: Option<String>,
    /// Override a key of the study, such as `campaign.runs=100`; can be repeated.
    #[arg(long = "set", value_name = "DOCUMENT.KEY=VALUE")]
    pub(crate) settings: Vec<String>,
    /// `json`: a line now and then of how far it is, and one at the end.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: TableOrJson,
}

/// What computes a campaign.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum ExecutorWord {
    /// This program.
    #[default]
    Threads,
    /// Processes of this machine, by the Python package.
    Processes,
    /// Dask distributed, by the Python package.
    Dask,
    /// Ray, by the Python package.
    Ray,
}

/// How results are printed that are no rows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum TableOrJson {
    /// For reading.
    #[default]
    Table,
    /// For programs: every digit.
    Json,
}

fn parse_part(text: &str) -> Result<Part, String> {
    let numbers = text.split_once('/').and_then(|(index, of)| {
        Some(Part { index: index.trim().parse().ok()?, of: of.trim().parse().ok()? })
    });
    numbers
        .filter(|part| (1..=part.of).contains(&part.index))
        .ok_or_else(|| "it must be I/N with I from 1 to N, such as 2/8".to_owned())
}

#[derive(Debug, Args)]
pub(crate) struct CampaignRerunArgs {
    /// A campaign's folder.
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
    /// The run's number, from 0.
    #[arg(value_name = "RUN")]
    pub(crate) run: u64,
    /// Form of what is printed.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: TableOrJson,
}

#[derive(Debug, Args)]
pub(crate) struct CampaignMergeArgs {
    /// Folder for all of it: a new one, or one that an earlier merge left unfinished.
    #[arg(value_name = "OUT")]
    pub(crate) out: PathBuf,
    /// The folders of the parts.
    #[arg(value_name = "DIR", required = true)]
    pub(crate) folders: Vec<PathBuf>,
    /// Form of what is printed.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: TableOrJson,
}

#[derive(Debug, Args)]
pub(crate) struct CampaignSummariseArgs {
    /// A campaign's folder.
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

#[derive(Debug, Args)]
pub(crate) struct CampaignDigestArgs {
    /// A campaign's folder.
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
    /// Form of what is printed.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: TableOrJson,
}

#[derive(Debug, Args)]
pub(crate) struct CampaignCostArgs {
    /// Studies: campaign documents' files or presets.
    #[arg(value_name = "STUDY", required = true)]
    pub(crate) studies: Vec<String>,
    /// How many runs to tell the cost of.
    #[arg(long, value_name = "N", default_value_t = 1_000_000_000, value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) runs: u64,
    /// How long to measure, in all [s].
    #[arg(long, value_name = "S", default_value_t = 10.0, value_parser = bench_seconds)]
    pub(crate) seconds: f64,
    /// Form of what is printed.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: TableOrJson,
}

#[derive(Debug, Args)]
pub(crate) struct BenchArgs {
    /// How long to measure, in all [s]: the longer, the less other work on the machine counts.
    #[arg(long, value_name = "S", default_value_t = 10.0, value_parser = bench_seconds)]
    pub(crate) seconds: f64,
    /// Form of what is printed.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

fn bench_seconds(text: &str) -> Result<f64, String> {
    let seconds: f64 = text.parse().map_err(|_| format!("'{text}' is no number"))?;
    let range = 0.1..=600.0;
    range.contains(&seconds).then_some(seconds).ok_or_else(|| "it must be 0.1 to 600".to_owned())
}

#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    /// Documents to check.
    #[arg(required = true, value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct PresetsArgs {
    /// The preset to print as TOML; where kinds share its name, --kind says which.
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub(crate) name: Option<String>,
    /// Only presets of this kind.
    #[arg(long, value_enum)]
    pub(crate) kind: Option<KindWord>,
    /// Form of the list.
    #[arg(long, value_enum, default_value_t, conflicts_with = "name")]
    pub(crate) format: Format,
}

#[derive(Debug, Args)]
pub(crate) struct SchemaArgs {
    /// The kind of document; without it, the names of all kinds.
    #[arg(value_enum)]
    pub(crate) kind: Option<KindWord>,
}

#[derive(Debug, Args)]
pub(crate) struct CompletionsArgs {
    /// The shell.
    #[arg(value_enum)]
    pub(crate) shell: Shell,
}

/// A kind of document.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum KindWord {
    Soil,
    Wheel,
    Rover,
    Scenario,
    DataSet,
    Campaign,
}

impl From<KindWord> for Kind {
    fn from(word: KindWord) -> Self {
        match word {
            KindWord::Soil => Self::Soil,
            KindWord::Wheel => Self::Wheel,
            KindWord::Rover => Self::Rover,
            KindWord::Scenario => Self::Scenario,
            KindWord::DataSet => Self::DataSet,
            KindWord::Campaign => Self::Campaign,
        }
    }
}
