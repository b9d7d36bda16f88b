//! The folder whose documents may be opened, and nothing outside of it.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use grouser::document::{self, Beside, DocumentError, Kind, Overrides, Source};

/// The folder of documents, or none.
#[derive(Clone, Debug)]
pub(crate) struct ServedFolder(Option<PathBuf>);

/// A document of the folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Listed {
    pub(crate) kind: Kind,
    /// Its path in the folder.
    pub(crate) path: String,
}

/// Levels of folders that are listed.
const DEEPEST: usize = 3;
/// Entries that are looked at.
const MOST: usize = 2000;

impl ServedFolder {
    /// * `path`: without one there are presets alone
    pub(crate) fn open(path: Option<&Path>) -> io::Result<Self> {
        let Some(path) = path else { return Ok(Self(None)) };
        let whole = fs::canonicalize(path)?;
        // Whether it is a folder that may be read.
        fs::read_dir(&whole)?;
        Ok(Self(Some(whole)))
    }

    /// The preset of that name, or the document at that path in the folder.
    pub(crate) fn find(&self, kind: Kind, name: &str) -> Result<Source, DocumentError> {
        Source::find_within(self.within(), kind, name)
    }

    /// What overrides may name.
    pub(crate) fn beside(&self) -> Beside {
        Beside { within: Some(self.within().to_owned()), ..Beside::default() }
    }

    /// Sets a key of a document, in the words of documents.
    ///
    /// * `value`: as TOML
    pub(crate) fn set(
        &self,
        overrides: &mut Overrides,
        key: &str,
        value: &str,
    ) -> Result<(), DocumentError> {
        overrides.change(key, value, self.beside())
    }

    /// The documents of the folder, each known by its `schema`.
    pub(crate) fn list(&self) -> Vec<Listed> {
        let mut found = Vec::new();
        if let Some(folder) = &self.0 {
            let mut rest = MOST;
            collect(folder, folder, DEEPEST, &mut rest, &mut found);
            found.sort_by(|one, other| one.path.cmp(&other.path));
        }
        found
    }

    /// Without a folder no path is inside.
    fn within(&self) -> &Path {
        self.0.as_deref().unwrap_or(Path::new(NOWHERE))
    }
}

/// A folder that no path leads into: no file of a system has this name.
const NOWHERE: &str = "/\u{0}";

fn collect(root: &Path, folder: &Path, deep: usize, rest: &mut usize, found: &mut Vec<Listed>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        if *rest == 0 {
            return;
        }
        *rest -= 1;
        // Links are followed when a document is opened, and then have to stay inside.
        let Ok(kind) = entry.file_type() else { continue };
        let path = entry.path();
        let is_hidden = entry.file_name().to_string_lossy().starts_with('.');
        if kind.is_dir() && deep > 1 && !is_hidden {
            collect(root, &path, deep - 1, rest, found);
        } else if kind.is_file() && path.extension().is_some_and(|end| end == "toml") {
            let Ok(inside) = path.strip_prefix(root) else { continue };
            let Some(name) = inside.to_str() else { continue };
            let source = Source::find_within(root, Kind::Scenario, name);
            if let Some(kind) = source.ok().and_then(|it| document::kind_of_source(&it).ok()) {
                found.push(Listed { kind, path: name.replace('\\', "/") });
            }
        }
    }
}
