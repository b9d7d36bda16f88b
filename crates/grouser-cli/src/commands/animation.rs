//! Animations of runs: where they go, what they are called, and how far they are.

use std::path::Path;

use grouser::document::escape;
use grouser_draw::{Animation, Form, Shown, VideoError};

use super::place::Place;
use crate::failure::Failure;
use crate::output;
use crate::output::folder::OutputFolder;

/// Where an animation goes, and as what.
pub(super) struct Target<'a> {
    place: Place<'a>,
    form: Form,
}

impl<'a> Target<'a> {
    /// What would fail once the runs are done fails now.
    ///
    /// * `has_folder`: whether other results go into a folder
    pub(super) fn of(path: &'a Path, has_folder: bool, may_replace: bool) -> Result<Self, Failure> {
        let form = Form::of_path(path).map_err(|error| {
            Failure::Usage(format!("--animate {}: {error}", escape::path(path)))
        })?;
        Ok(Self { place: Place::of(path, has_folder, may_replace)?, form })
    }

    /// Draws runs and writes them, or adds them to the folder.
    pub(super) fn write(
        &self,
        title: &str,
        runs: &[Shown<'_>],
        folder: Option<&mut OutputFolder>,
    ) -> Result<(), Failure> {
        let animation = Animation::of(title, runs);
        let bar = output::progress_bar(animation.len() as u64);
        bar.set_message("pictures");
        let bytes = animation.to_bytes(self.form, &mut || bar.inc(1));
        bar.finish_and_clear();
        let bytes = bytes.map_err(|error| match error {
            VideoError::NoProgram => Failure::Usage(error.to_string()),
            other => Failure::Run(other.to_string()),
        })?;
        self.place.write(folder, |out| out.write_all(&bytes).map_err(self.place.failed()))
    }
}
