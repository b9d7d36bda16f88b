//! Arguments of `import-urdf`.

use std::path::PathBuf;

use clap::Args;

#[derive(Debug, Args)]
#[command(
    after_help = "Links that roll are wheels, all others the body. Joints about an axis across the \
                  rover between the two are rockers and bogies, joints about an upright axis \
                  steer. What was taken for granted stands under `assumed` in the document, and on \
                  stderr."
)]
pub(crate) struct ImportUrdfArgs {
    /// The URDF: of xacro, what `xacro FILE` prints.
    pub(crate) file: PathBuf,
    /// A link that is a wheel, with `*` for any letters; can be repeated. Without it all cylinders
    /// that roll without end about an axis across the rover.
    #[arg(long, value_name = "PATTERN")]
    pub(crate) wheels: Vec<String>,
    /// A differential joins the rockers of both sides, which URDF cannot say.
    #[arg(long)]
    pub(crate) differential: bool,
    /// The file to write; without it the document is printed.
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Replace the file if it is there.
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
}
