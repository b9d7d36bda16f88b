//! Arguments of `import-urdf`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::PossibleValuesParser;
use grouser::document::urdf::Forward;

#[derive(Debug, Args)]
#[command(
    after_help = "What rolls about an axis across the rover, reaches the ground and comes in pairs \
                  is a wheel, all else the body; the table of wheels is what was guessed. Joints \
                  about an axis across the rover between the two are rockers and bogies, joints \
                  about an upright axis steer, and a `<mimic>` between rockers that turn against \
                  each other is a differential. What was taken for granted stands under `assumed` \
                  in the document, and on stderr."
)]
pub(crate) struct ImportUrdfArgs {
    /// The URDF: of xacro, what `xacro FILE` prints.
    pub(crate) file: PathBuf,
    /// A link that is a wheel, with `*` for any letters; can be repeated. Without it the wheels are
    /// guessed.
    #[arg(long, value_name = "PATTERN")]
    pub(crate) wheels: Vec<String>,
    /// A link that rolls and is no driven wheel (a caster, a drum): it belongs to the body; can be
    /// repeated.
    #[arg(long, value_name = "PATTERN", conflicts_with = "wheels")]
    pub(crate) passive: Vec<String>,
    /// Radius of the wheels [m], where their shapes do not tell it, or another.
    #[arg(long, value_name = "M", value_parser = parse_size, allow_negative_numbers = true)]
    pub(crate) wheel_radius_m: Option<f64>,
    /// Width of the wheels [m], likewise.
    #[arg(long, value_name = "M", value_parser = parse_size, allow_negative_numbers = true)]
    pub(crate) wheel_width_m: Option<f64>,
    /// Which way of the root link is the rover's way forward.
    #[arg(long, value_name = "AXIS", default_value = "x", allow_hyphen_values = true, value_parser = PossibleValuesParser::new(Forward::ALL.map(|(name, _)| name)))]
    pub(crate) forward: String,
    /// A differential joins the rockers of both sides, where no `<mimic>` says so.
    #[arg(long, conflicts_with = "rigid")]
    pub(crate) differential: bool,
    /// Rockers, bogies and other joints of the suspension are taken as they stand.
    #[arg(long)]
    pub(crate) rigid: bool,
    /// The file to write; without it the document is printed.
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Replace the file if it is there.
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
}

/// A size of a wheel [m].
fn parse_size(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|it| *it > 0.0 && *it <= 10.0);
    number.ok_or_else(|| "it is no number above 0 and up to 10".to_owned())
}
