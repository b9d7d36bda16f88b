//! Where a file goes that a command writes beside its answer.

use std::io::Write;
use std::path::Path;

use crate::failure::Failure;
use crate::output::file;
use crate::output::folder::OutputFolder;

/// A file's place: on its own, or in the folder of the other results, where a name alone goes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place<'a> {
    path: &'a Path,
    is_in_folder: bool,
}

impl<'a> Place<'a> {
    /// What would fail once the runs are done fails now.
    ///
    /// * `has_folder`: whether other results go into a folder
    pub(super) fn of(path: &'a Path, has_folder: bool, may_replace: bool) -> Result<Self, Failure> {
        let is_in_folder = has_folder && path.parent() == Some(Path::new(""));
        if !is_in_folder {
            file::check_new(path, may_replace)?;
        }
        Ok(Self { path, is_in_folder })
    }

    /// Writes the file, or adds it to the folder.
    ///
    /// * `content`: writes it
    pub(super) fn write(
        &self,
        folder: Option<&mut OutputFolder>,
        content: impl FnOnce(&mut dyn Write) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let Some(folder) = folder.filter(|_| self.is_in_folder) else {
            return file::write_by(self.path, content).inspect(|()| file::say_written(self.path));
        };
        let mut bytes = Vec::new();
        content(&mut bytes)?;
        folder.add(self.path.to_string_lossy(), bytes);
        Ok(())
    }

    /// The failure of a file that the system could not write.
    pub(super) fn failed(&self) -> impl FnOnce(std::io::Error) -> Failure + 'a {
        Failure::at("cannot write", self.path)
    }
}
