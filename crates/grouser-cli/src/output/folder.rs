//! An output folder: written beside and renamed; old files are replaced only on request.

mod claim;

use std::fs;
use std::io::Write as _;
use std::path::{Component, Path, PathBuf};
use std::time::Duration;

use grouser::document::{Loaded, escape, file};
use tempfile::TempDir;

use crate::args::OutputArgs;
use crate::failure::Failure;
use crate::interrupt;
use crate::output::terminal;
use crate::report::REPORT;
pub(crate) use claim::make_folder;

/// Start of the names of temporary folders. A killed program may leave one behind.
const TEMPORARY: &str = ".grouser-";
/// A temporary folder of this age was left by a program that was killed: files are written to it
/// when all are there. Source: ours.
const LEFT_BEHIND: Duration = Duration::from_secs(3600);

/// Files that appear in a folder together, or not at all.
///
/// They are kept in memory, then written to a temporary folder on the same disk. Only when all are
/// whole do they go to their place: a new folder in one step, so that a full disk or a kill leaves
/// all of it or nothing; into a folder that is there already file by file, each of them whole.
pub(crate) struct OutputFolder {
    target: PathBuf,
    /// The target if it is there, or else the nearest folder above it that is.
    base: PathBuf,
    /// The way from there to the target; empty if that is there.
    missing: PathBuf,
    files: Vec<(String, Vec<u8>)>,
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

    /// Prepares for writing to a folder: what would fail later fails now, and nothing is made yet.
    pub(crate) fn open(target: &Path, old_files: OldFiles) -> Result<Self, Failure> {
        let shown = escape::path(target);
        if let Some(missing) = file::broken_link(target) {
            let missing = escape::path(&missing);
            return Err(Failure::Usage(format!(
                "{shown} is a link to {missing}, which does not exist: make that folder, or name \
                 another"
            )));
        }
        if target.symlink_metadata().is_ok() && !target.is_dir() {
            return Err(Failure::Usage(format!(
                "{shown} is a file: the output needs a folder, a new one or an empty one"
            )));
        }
        if let Some(ending) = file_ending(target).filter(|_| !target.is_dir()) {
            return Err(Failure::Usage(format!(
                "{shown}: the output is a folder of files, and no name of a folder ends in \
                 .{ending}\nhint: --format prints rows for a file; a folder has a page, which \
                 prints as PDF from any browser"
            )));
        }
        if old_files == OldFiles::Keep && has_entries(target)? {
            return Err(Failure::Usage(format!(
                "the folder {shown} is not empty: choose another, or add --force to replace the \
                 files of the same names"
            )));
        }
        let (base, missing) = split_at_existing(target)?;
        if target.is_dir() {
            claim::take(target)?;
        }
        clear_leftovers(&base);
        check_writable(&base)?;
        Ok(Self { target: target.to_owned(), base, missing, files: Vec::new() })
    }

    /// Adds a file; folders in its name are made.
    pub(crate) fn add(&mut self, name: impl Into<String>, content: impl Into<Vec<u8>>) {
        self.files.push((name.into(), content.into()));
    }

    /// Adds a resolved document with the files that it names.
    pub(crate) fn add_document<V>(&mut self, name: &str, document: &Loaded<V>) {
        self.add(name, document.to_toml());
        for companion in &document.companions {
            self.add(companion.name.clone(), companion.content.clone());
        }
    }

    /// Writes all files and moves them to their place; a terminal is told where they are.
    pub(crate) fn finish(self) -> Result<(), Failure> {
        let summary = self.summary();
        self.write_all()?;
        if terminal::has_progress() {
            super::message(&summary);
        }
        Ok(())
    }

    /// What was written, with the file to open first.
    fn summary(&self) -> String {
        let is_first = |name: &&str| *name == REPORT;
        let names = || self.files.iter().map(|(name, _)| &**name);
        let first = names().find(is_first).or(names().next()).unwrap_or_default();
        let first = escape::path(&self.target.join(first));
        match self.files.len() {
            0 | 1 => format!("wrote {first}"),
            2 => format!("wrote {first} and another file"),
            count => format!("wrote {first} and {} more files", count - 1),
        }
    }

    fn write_all(self) -> Result<(), Failure> {
        let _deferred = interrupt::defer_ctrl_c();
        let staging = temporary_folder(&self.base)?;
        let staged = staging.path().join(&self.missing);
        for (name, content) in &self.files {
            let place = self.target.join(name);
            write(&staged.join(name), content).map_err(Failure::at("cannot write", &place))?;
        }
        // A long run may have made its folder meanwhile, to keep there how far it is.
        let Some(first) = self.missing.iter().next().filter(|_| !self.target.is_dir()) else {
            self.check_ours()?;
            self.check_room()?;
            return move_entries(&staged, &self.target);
        };
        let place = self.base.join(first);
        fs::rename(staging.path().join(first), &place)
            .map_err(Failure::at("cannot make the folder", &place))
    }

    /// Checks that a folder that was made meanwhile was made by this program.
    fn check_ours(&self) -> Result<(), Failure> {
        let is_new = !self.missing.as_os_str().is_empty();
        let was_ours = claim::take(&self.target)?;
        if was_ours || !is_new || !has_entries(&self.target)? {
            return Ok(());
        }
        let shown = escape::path(&self.target);
        Err(Failure::Run(format!(
            "{shown} was written meanwhile by another program: nothing of this one is in it\nhint: \
             choose another folder"
        )))
    }

    /// Checks that no folder stands where a file has to go, and no file where a folder has to.
    fn check_room(&self) -> Result<(), Failure> {
        for (name, _) in &self.files {
            let place = self.target.join(name);
            let above = place.parent().filter(|above| above.exists() && !above.is_dir());
            if let Some(file) = above {
                let file = escape::path(file);
                return Err(Failure::Usage(format!("{file} is a file where a folder has to be")));
            }
            if place.is_dir() {
                let folder = escape::path(&place);
                return Err(Failure::Usage(format!("{folder} is a folder where a file has to be")));
            }
        }
        Ok(())
    }
}

/// The ending of a name by which a file is meant.
fn file_ending(target: &Path) -> Option<String> {
    const FILES: [&str; 16] = [
        "csv", "geojson", "gif", "glb", "html", "json", "mcap", "mp4", "npy", "parquet", "pdf",
        "png", "svg", "tif", "tiff", "toml",
    ];
    let ending = target.extension()?.to_string_lossy().to_lowercase();
    FILES.contains(&&*ending).then_some(ending)
}

/// Whether there is something in a folder; there is nothing in one that does not exist.
pub(crate) fn has_entries(folder: &Path) -> Result<bool, Failure> {
    if !folder.is_dir() {
        return Ok(false);
    }
    let mut entries = fs::read_dir(folder).map_err(Failure::at("cannot look into", folder))?;
    Ok(entries.next().is_some())
}

/// The part of a path that is there, and the way from it to the end.
fn split_at_existing(target: &Path) -> Result<(PathBuf, PathBuf), Failure> {
    let is_there = |path: &Path| path == Path::new("") || path.symlink_metadata().is_ok();
    let there = target.ancestors().find(|path| is_there(path)).unwrap_or(Path::new(""));
    let missing = target.strip_prefix(there).unwrap_or(target).to_owned();
    let base = if there == Path::new("") { PathBuf::from(".") } else { there.to_owned() };
    if !base.is_dir() {
        return Err(Failure::Run(format!(
            "cannot make the folder {}: {} is a file",
            escape::path(target),
            escape::path(&base)
        )));
    }
    if missing.components().any(|step| step == Component::ParentDir) {
        let shown = escape::path(target);
        return Err(Failure::Usage(format!("{shown} leads through a folder that does not exist")));
    }
    // `a/./b` is `a/b`.
    Ok((base, missing.components().collect()))
}

fn temporary_folder(base: &Path) -> Result<TempDir, Failure> {
    tempfile::Builder::new()
        .prefix(TEMPORARY)
        .tempdir_in(base)
        .map_err(Failure::at("cannot write to the folder", base))
}

/// Removes what programs that were killed left in a folder. One that cannot be removed stays.
fn clear_leftovers(base: &Path) {
    let is_old = |entry: &fs::DirEntry| {
        let changed = entry.metadata().and_then(|it| it.modified());
        changed.is_ok_and(|at| at.elapsed().is_ok_and(|age| age > LEFT_BEHIND))
    };
    let entries = fs::read_dir(base).into_iter().flatten().flatten();
    let ours = entries.filter(|entry| entry.file_name().to_string_lossy().starts_with(TEMPORARY));
    for entry in ours.filter(is_old) {
        drop(fs::remove_dir_all(entry.path()));
    }
}

/// A folder that cannot be written to is found before anything is computed.
fn check_writable(folder: &Path) -> Result<(), Failure> {
    let _deferred = interrupt::defer_ctrl_c();
    temporary_folder(folder).map(drop)
}

fn write(path: &Path, content: &[u8]) -> std::io::Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    let mut file = fs::File::create(path)?;
    file.write_all(content)?;
    file.sync_all()
}

/// Moves what is in a folder to another, whole folders where the other has none of the name.
fn move_entries(from: &Path, to: &Path) -> Result<(), Failure> {
    for entry in fs::read_dir(from).map_err(Failure::at("cannot look into", from))? {
        let entry = entry.map_err(Failure::at("cannot look into", from))?;
        let target = to.join(entry.file_name());
        if target.is_dir() {
            move_entries(&entry.path(), &target)?;
        } else {
            super::file::check_ordinary(&target)?;
            fs::rename(entry.path(), &target).map_err(Failure::at("cannot write", &target))?;
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
        folder.add("one.csv", "1\n");
        folder.add("figures/two.svg", "2\n");
        assert!(!place.path().join("a").exists());
        folder.finish().unwrap();
        assert_eq!(fs::read_to_string(target.join("figures/two.svg")).unwrap(), "2\n");
        assert_eq!(fs::read_dir(place.path()).unwrap().count(), 1);
        assert_eq!(fs::read_dir(place.path().join("a")).unwrap().count(), 1);

        let refused = OutputFolder::open(&target, OldFiles::Keep).err().unwrap();
        assert!(refused.to_string().contains("--force"));
        let mut again = OutputFolder::open(&target, OldFiles::Replace).unwrap();
        again.add("one.csv", "3\n");
        again.add("figures/three.svg", "3\n");
        again.finish().unwrap();
        assert_eq!(fs::read_to_string(target.join("one.csv")).unwrap(), "3\n");
        assert_eq!(fs::read_to_string(target.join("figures/two.svg")).unwrap(), "2\n");
        assert_eq!(fs::read_to_string(target.join("figures/three.svg")).unwrap(), "3\n");
        assert_eq!(fs::read_dir(&target).unwrap().count(), 2);
    }

    #[test]
    fn the_summary_names_the_page_to_open() {
        let place = tempfile::tempdir().unwrap();
        let mut folder = OutputFolder::open(&place.path().join("out"), OldFiles::Keep).unwrap();
        folder.add("a.csv", "1\n");
        assert!(folder.summary().ends_with("a.csv"), "{}", folder.summary());
        folder.add(REPORT, "<html>");
        folder.add("b.csv", "1\n");
        let summary = folder.summary();
        assert!(summary.ends_with("report.html and 2 more files"), "{summary}");
    }

    #[test]
    fn what_is_given_up_leaves_nothing() {
        let place = tempfile::tempdir().unwrap();
        let target = place.path().join("a/out");
        let mut folder = OutputFolder::open(&target, OldFiles::Keep).unwrap();
        folder.add("one.csv", "1\n");
        drop(folder);
        assert_eq!(fs::read_dir(place.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_folder_in_the_way_of_a_file_is_found_before_anything_is_replaced() {
        let place = tempfile::tempdir().unwrap();
        fs::write(place.path().join("a.csv"), "old").unwrap();
        fs::create_dir(place.path().join("b.csv")).unwrap();
        let mut folder = OutputFolder::open(place.path(), OldFiles::Replace).unwrap();
        folder.add("a.csv", "new");
        folder.add("b.csv", "new");
        assert!(folder.finish().is_err());
        assert_eq!(fs::read_to_string(place.path().join("a.csv")).unwrap(), "old");
        assert_eq!(fs::read_dir(place.path()).unwrap().count(), 2);
    }
}
