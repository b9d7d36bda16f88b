//! Animations of runs: where they go, what they are called, and how far they are.

use std::path::Path;

use grouser::document::escape;
use grouser_pictures::{Animation, Form, Shown, VideoError};

use crate::failure::Failure;
use crate::output;
use crate::output::file;
use crate::output::folder::OutputFolder;

/// Where an animation goes, and as what.
pub(super) struct Target<'a> {
    path: &'a Path,
    form: Form,
    /// Whether it goes into the folder of the other results, as a name alone does.
    is_in_folder: bool,
}

impl<'a> Target<'a> {
    /// What would fail once the runs are done fails now.
    ///
    /// * `has_folder`: whether other results go into a folder
    pub(super) fn of(path: &'a Path, has_folder: bool, may_replace: bool) -> Result<Self, Failure> {
        let form = Form::of_path(path).map_err(|error| {
            Failure::Usage(format!("--animate {}: {error}", escape::path(path)))
        })?;
        let is_in_folder = has_folder && path.parent() == Some(Path::new(""));
        if !is_in_folder {
            file::check_new(path, may_replace)?;
        }
        Ok(Self { path, form, is_in_folder })
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
        match folder.filter(|_| self.is_in_folder) {
            Some(folder) => {
                folder.add(self.path.to_string_lossy(), bytes);
                Ok(())
            }
            None => file::write(self.path, &bytes),
        }
    }
}
