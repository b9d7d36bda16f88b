//! An output folder: written beside and renamed, never over old files unless told to.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use crate::args::OutputArgs;
use crate::failure::Failure;
use crate::interrupt;

/// Files that appear in a folder together, or not at all.
///
/// They are kept in memory, then written to a temporary folder beside the target. Only when all
/// are on the disk are they moved to their place, so that a full disk or a kill leaves nothing
/// half-written.
pub(crate) struct OutputFolder {
    target: PathBuf,
    parent: PathBuf,
    files: Vec<(String, String)>,
}

/// What may happen to files that are there already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OldFiles {
    /// The folder must be empty or absent.
    Keep,
    /// Files of the same names are replaced.
    Replace,
}

impl OutputFolder {
    /// The folder that flags ask for, if they do.
    pub(crate) fn for_args(args: &OutputArgs) -> Result<Option<Self>, Failure> {
        let old_files = if args.force { OldFiles::Replace } else { OldFiles::Keep };
        args.out.as_ref().map(|target| Self::open(target, old_files)).transpose()
    }

    /// Prepares for writing to a folder: what would fail later fails now.
    pub(crate) fn open(target: &Path, old_files: OldFiles) -> Result<Self, Failure> {
        let shown = target.display();
        if target.exists() && !target.is_dir() {
            return Err(Failure::Usage(format!("--out {shown}: there is a file of that name")));
        }
        let parent = match target.parent() {
            Some(parent) if parent != Path::new("") => parent,
            _ => Path::new("."),
        };
        if old_files == OldFiles::Keep && has_entries(target)? {
            return Err(Failure::Usage(format!(
                "--out {shown}: the folder is not empty; choose another, or add --force to \
                 replace the files of the same names"
            )));
        }
        fs::create_dir_all(parent).map_err(Failure::at(parent))?;
        check_writable(if target.is_dir() { target } else { parent })?;
        Ok(Self { target: target.to_owned(), parent: parent.to_owned(), files: Vec::new() })
    }

    /// Adds a file; folders in its name are made.
    pub(crate) fn add(&mut self, name: &str, content: String) {
        self.files.push((name.to_owned(), content));
    }

    /// Writes all files and moves them to their place.
    pub(crate) fn finish(self) -> Result<(), Failure> {
        let _not_now = interrupt::not_now();
        let staging = tempfile::Builder::new()
            .prefix(".grouser-")
            .tempdir_in(&self.parent)
            .map_err(Failure::at(&self.parent))?;
        for (name, content) in &self.files {
            write(&staging.path().join(name), content)
                .map_err(Failure::at(&self.target.join(name)))?;
        }
        move_entries(staging.path(), &self.target)
    }
}

fn write(path: &Path, content: &str) -> std::io::Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    let mut file = fs::File::create(path)?;
    file.write_all(content.as_bytes())?;
    file.sync_all()
}

fn has_entries(folder: &Path) -> Result<bool, Failure> {
    if !folder.is_dir() {
        return Ok(false);
    }
    let mut entries = fs::read_dir(folder).map_err(Failure::at(folder))?;
    Ok(entries.next().is_some())
}

/// A folder that cannot be written to is found before anything is computed.
fn check_writable(folder: &Path) -> Result<(), Failure> {
    tempfile::Builder::new()
        .prefix(".grouser-")
        .tempfile_in(folder)
        .map(drop)
        .map_err(Failure::at(folder))
}

fn move_entries(from: &Path, to: &Path) -> Result<(), Failure> {
    fs::create_dir_all(to).map_err(Failure::at(to))?;
    for entry in fs::read_dir(from).map_err(Failure::at(from))? {
        let entry = entry.map_err(Failure::at(from))?;
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            move_entries(&entry.path(), &target)?;
        } else {
            fs::rename(entry.path(), &target).map_err(Failure::at(&target))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_appear_together_and_old_ones_are_kept() {
        let place = tempfile::tempdir().unwrap();
        let target = place.path().join("a/b");
        let mut folder = OutputFolder::open(&target, OldFiles::Keep).unwrap();
        folder.add("one.csv", "1\n".into());
        folder.add("figures/two.svg", "2\n".into());
        assert!(!target.exists());
        folder.finish().unwrap();
        assert_eq!(fs::read_to_string(target.join("figures/two.svg")).unwrap(), "2\n");
        assert_eq!(fs::read_dir(place.path().join("a")).unwrap().count(), 1);

        let refused = OutputFolder::open(&target, OldFiles::Keep).err().unwrap();
        assert!(refused.to_string().contains("--force"));
        let mut again = OutputFolder::open(&target, OldFiles::Replace).unwrap();
        again.add("one.csv", "3\n".into());
        again.finish().unwrap();
        assert_eq!(fs::read_to_string(target.join("one.csv")).unwrap(), "3\n");
        assert_eq!(fs::read_to_string(target.join("figures/two.svg")).unwrap(), "2\n");
    }

    #[test]
    fn what_is_given_up_leaves_nothing() {
        let place = tempfile::tempdir().unwrap();
        let target = place.path().join("out");
        let mut folder = OutputFolder::open(&target, OldFiles::Keep).unwrap();
        folder.add("one.csv", "1\n".into());
        drop(folder);
        assert_eq!(fs::read_dir(place.path()).unwrap().count(), 0);
    }
}
