//! The folder whose documents may be opened, and nothing outside of it.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use grouser::document::file::{self, FileProblem, confined_map, opener};
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

/// A file of the folder that is no document.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ListedFile {
    /// `map`, `areas` or `measurements`.
    pub(crate) kind: &'static str,
    /// Its path in the folder.
    pub(crate) path: String,
}

/// Ends of names, and what such files have.
const ENDINGS: [(&str, &str); 5] = [
    ("tif", "map"),
    ("tiff", "map"),
    ("xyz", "map"),
    ("geojson", "areas"),
    ("csv", "measurements"),
];

/// Levels of folders that are listed.
const DEEPEST: usize = 3;
/// Entries that are looked at.
const MOST: usize = 2000;

impl ServedFolder {
    /// No folder: there are presets alone.
    #[cfg(not(feature = "server"))]
    pub(crate) fn none() -> Self {
        Self(None)
    }

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

    /// The path of a map, or of areas, which lies in the folder with all that is read with it.
    pub(crate) fn find_map(&self, name: &str) -> Result<PathBuf, FileProblem> {
        confined_map(Path::new(name), self.within())
    }

    /// Reads a file of the folder, and none outside of it.
    ///
    /// * `limit`: how many bytes it may have
    pub(crate) fn read(&self, path: &Path, limit: u64) -> Result<Vec<u8>, FileProblem> {
        file::read_in(path, Some(self.within()), limit)
    }

    /// Opens a file of the folder, and none outside of it.
    pub(crate) fn open_file(&self, path: &Path) -> io::Result<fs::File> {
        opener(Some(self.within()))(path)
    }

    /// The documents of the folder, each known by its `schema`.
    pub(crate) fn list(&self) -> Vec<Listed> {
        let Some(root) = &self.0 else { return Vec::new() };
        let documents = self.walk().into_iter().filter(|path| end_of(path) == "toml");
        let known = |path: String| {
            let source = Source::find_within(root, Kind::Scenario, &path).ok()?;
            let kind = document::kind_of_source(&source).ok()?;
            Some(Listed { kind, path: path.replace('\\', "/") })
        };
        documents.filter_map(known).collect()
    }

    /// The maps of heights and the areas of the folder.
    pub(crate) fn list_files(&self) -> Vec<ListedFile> {
        let known = |path: String| {
            let end = end_of(&path);
            let (_, kind) = ENDINGS.into_iter().find(|(ending, _)| *ending == end)?;
            Some(ListedFile { kind, path: path.replace('\\', "/") })
        };
        self.walk().into_iter().filter_map(known).collect()
    }

    /// The paths of all files of the folder, in order.
    fn walk(&self) -> Vec<String> {
        let mut found = Vec::new();
        if let Some(folder) = &self.0 {
            let mut rest = MOST;
            collect(folder, folder, DEEPEST, &mut rest, &mut found);
            found.sort();
        }
        found
    }

    /// Without a folder no path is inside.
    fn within(&self) -> &Path {
        self.0.as_deref().unwrap_or(Path::new(NOWHERE))
    }
}

/// The end of a file's name.
fn end_of(path: &str) -> String {
    let end = Path::new(path).extension().and_then(|end| end.to_str());
    end.unwrap_or_default().to_ascii_lowercase()
}

/// A folder that no path leads into: no file of a system has this name.
const NOWHERE: &str = "/\u{0}";

fn collect(root: &Path, folder: &Path, deep: usize, rest: &mut usize, found: &mut Vec<String>) {
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
        } else if kind.is_file() {
            let inside = path.strip_prefix(root).ok().and_then(Path::to_str);
            found.extend(inside.map(str::to_owned));
        }
    }
}
