//! Where the results of a run go, besides what is printed.

use super::{animation, log, telemetry};
use crate::args::{OutputArgs, RunArgs};
use crate::failure::Failure;
use crate::output::folder::OutputFolder;

/// The folder, the animation, the log and the telemetry that flags ask for.
pub(super) struct Destinations<'a> {
    pub(super) folder: Option<OutputFolder>,
    pub(super) animation: Option<animation::Target<'a>>,
    pub(super) log: Option<log::Target<'a>>,
    pub(super) telemetry: Option<telemetry::Target<'a>>,
}

impl<'a> Destinations<'a> {
    /// What would fail once the run is done fails now.
    pub(super) fn of(run: &'a RunArgs, output: &OutputArgs) -> Result<Self, Failure> {
        let folder = OutputFolder::for_args(output)?;
        let (has_folder, may_replace) = (folder.is_some(), output.force);
        let animation = run.animate.as_deref();
        let animation = animation.map(|it| animation::Target::of(it, has_folder, may_replace));
        let animation = animation.transpose()?;
        let log = run.mcap.as_deref().map(|it| log::Target::of(it, has_folder, may_replace));
        let telemetry = telemetry::Target::of(run, has_folder, may_replace)?;
        Ok(Self { animation, log: log.transpose()?, telemetry, folder })
    }
}
