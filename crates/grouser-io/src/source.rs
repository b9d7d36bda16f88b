//! The source of a document: a preset, a file, or a text in memory.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::check::nearest;
use super::error::{DocumentError, Problem};
use super::escape;
use super::file;
use super::kind::Kind;
use super::presets::{self, Preset};
use super::tree::{Beside, Text};

/// The source of a document.
///
/// What is the cohesion of a soil that is written as TOML, in a file or in memory?
///
/// ```
/// use grouser_io::{Kind, Overrides, Source, preset, read_soil};
///
/// let sand = preset(Kind::Soil, "toyoura").expect("it comes with the library").text;
/// let damp = sand.replace("cohesion_kpa       = 0.0", "cohesion_kpa = 0.35");
/// let soil = read_soil(&Source::text("damp sand", damp), &Overrides::none())?.value;
/// assert_eq!(format!("{:.0} Pa", soil.cohesion), "350 Pa");
/// # Ok::<(), grouser_io::DocumentError>(())
/// ```
#[derive(Clone, Debug)]
pub enum Source {
    /// A document that comes with the program.
    Preset(&'static Preset),
    /// A file.
    File(PathBuf),
    /// A file in a folder that neither it nor what it names may lead out of.
    Confined {
        /// The file, without links.
        path: PathBuf,
        /// The folder, without links.
        within: PathBuf,
    },
    /// A text with a name for messages; its relative paths start from the current folder.
    Text {
        /// What messages call it.
        label: String,
        /// The document.
        content: String,
        /// What it may name, before the files of the current folder.
        beside: Beside,
    },
}

/// The largest file that is read [bytes]: a document has a few kilobytes.
pub const LARGEST_FILE: u64 = 1 << 20;

impl Source {
    /// The preset of that name, or else the file at that path.
    ///
    /// What ends in `.toml` or has a slash in it is a path.
    ///
    /// # Errors
    /// [`DocumentError`] if there is neither.
    pub fn find(kind: Kind, name: &str) -> Result<Self, DocumentError> {
        Self::named_in(&Text::default(), kind, name)
    }

    /// The preset of that name, or else the file at that path in a folder. Neither it nor a file
    /// that it names may be outside, links included.
    ///
    /// * `within`: the folder, without links ([`std::fs::canonicalize`])
    ///
    /// # Errors
    /// [`DocumentError`] if there is neither, or it is outside.
    pub fn find_within(within: &Path, kind: Kind, name: &str) -> Result<Self, DocumentError> {
        let beside = Beside { within: Some(within.to_owned()), ..Beside::default() };
        Self::named_in(&Text { beside, ..Text::default() }, kind, name)
    }

    /// A file.
    #[must_use]
    pub fn file(path: impl Into<PathBuf>) -> Self {
        Self::File(path.into())
    }

    /// A text in memory.
    #[must_use]
    pub fn text(label: impl Into<String>, content: impl Into<String>) -> Self {
        Self::text_with(label, content, Beside::default())
    }

    /// A text in memory, and the files and maps beside it.
    #[must_use]
    pub fn text_with(
        label: impl Into<String>,
        content: impl Into<String>,
        beside: impl Into<Beside>,
    ) -> Self {
        Self::Text { label: label.into(), content: content.into(), beside: beside.into() }
    }

    /// The empty scenario: every value is the default of its key.
    #[must_use]
    pub fn default_scenario() -> Self {
        Self::text("the default scenario", "schema = \"scenario/1\"\nname = \"traverse\"\n")
    }

    /// [`find`](Self::find), with the paths that a text may name.
    pub(crate) fn named_in(text: &Text, kind: Kind, name: &str) -> Result<Self, DocumentError> {
        if let Some(preset) = presets::preset(kind, name) {
            return Ok(Self::Preset(preset));
        }
        let is_toml = Path::new(name).extension().is_some_and(|end| end == "toml");
        let is_path = is_toml || name.contains(['/', '\\']);
        // A link is there even if its file is not: reading it says so.
        let is_there = |path: &Path| !name.is_empty() && path.symlink_metadata().is_ok();
        if let Some(within) = &text.beside.within {
            match text.path_of(name) {
                Ok(path) if !name.is_empty() => {
                    return Ok(Self::Confined { path, within: within.clone() });
                }
                Err(problem) if is_path => {
                    return Err(DocumentError::whole(escape::line(name), problem.into()));
                }
                _ => {}
            }
        } else {
            let path = text.folder.join(name);
            if is_path || is_there(&path) {
                return Ok(Self::File(path));
            }
        }
        let problem = Problem::NoSuchPresetOrFile { kind, name: escape::line(name).into_owned() };
        let names: Vec<_> = presets::presets(kind).map(|preset| preset.name).collect();
        let hint = nearest(name, names.iter().copied()).map_or_else(
            || format!("the {kind} presets are {}", names.join(", ")),
            |meant| format!("did you mean `{meant}`?"),
        );
        Err(DocumentError::whole(escape::line(name).into_owned(), problem).with_hint(hint))
    }

    pub(crate) fn read(&self) -> Result<Arc<Text>, DocumentError> {
        let mut named = Beside::default();
        let (label, content, folder) = match self {
            Self::Preset(preset) => {
                (format!("preset {}", preset.name), preset.text.to_owned(), PathBuf::new())
            }
            Self::Text { label, content, beside } => {
                named.clone_from(beside);
                (label.clone(), content.clone(), PathBuf::new())
            }
            Self::File(path) | Self::Confined { path, .. } => {
                if let Self::Confined { within, .. } = self {
                    named.within = Some(within.clone());
                }
                let within = named.within.as_deref();
                let label = path.display().to_string();
                let content = read_file(path, within, LARGEST_FILE).map_err(|problem| {
                    let hint = (problem == Problem::NoSuchFile).then(|| meant_file(path)).flatten();
                    DocumentError::whole(&label, problem).with_hint(hint)
                })?;
                (label, content, path.parent().unwrap_or(Path::new("")).to_owned())
            }
        };
        Ok(Arc::new(Text { label, content, folder, is_argument: false, beside: named }))
    }
}

/// What was probably meant by a path to no file: a document of a similar name beside it. Where
/// there is no such folder either, that is said.
fn meant_file(path: &Path) -> Option<String> {
    /// Entries of a folder that are looked at.
    const MOST: usize = 1000;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let Ok(entries) = fs::read_dir(folder.unwrap_or(Path::new("."))) else {
        let folder = escape::path(folder?);
        return Some(format!("there is no folder `{folder}`"));
    };
    let names = entries.take(MOST).filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let is_toml = |name: &String| Path::new(name).extension().is_some_and(|end| end == "toml");
    let documents: Vec<String> = names.filter(is_toml).collect();
    let name = path.file_name()?.to_str()?;
    let meant = nearest(name, documents.iter().map(String::as_str))?;
    Some(format!("did you mean `{}`?", escape::path(&path.with_file_name(meant))))
}

/// The text of a file of at most `limit` bytes.
///
/// * `within`: the folder that it has to be in
pub(crate) fn read_file(path: &Path, within: Option<&Path>, limit: u64) -> Result<String, Problem> {
    let bytes = file::read_in(path, within, limit).map_err(Problem::from)?;
    String::from_utf8(bytes)
        .map_err(|error| Problem::NotText { valid_up_to: error.utf8_error().valid_up_to() })
}
