//! Errors of documents, with place, value, allowed values and a hint.

use std::fmt;
use std::io;
use std::ops::Range;

use super::escape;
use super::file::FileProblem;
use super::kind::Kind;
use super::tree::{Origin, Text, number};
use crate::statistics::{Contradiction, NothingAccepted};
use grouser_core::error::ParameterError;

/// A document, or a value set on the command line, that cannot be used.
///
/// Displayed it reads as a compiler's message: place and problem, the line with a mark under the
/// value, and a hint.
#[derive(Clone, Debug, PartialEq)]
pub struct DocumentError {
    // Boxed, so that a result is not mostly room for an error.
    parts: Box<Parts>,
}

#[derive(Clone, Debug, PartialEq)]
struct Parts {
    place: Place,
    problem: Problem,
    hint: Option<String>,
    meant: Vec<String>,
    /// Where another document names the one that is wrong.
    named_at: Option<Place>,
}

/// Where in a document something stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file, `preset toyoura`, or the argument, such as `--set soil.density_kg_m3=-1`.
    pub document: String,
    /// The spot in it, where there is one.
    pub spot: Option<Spot>,
}

/// A line and a column, with the line itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spot {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    excerpt: Option<Excerpt>,
}

/// The part of a line that a terminal holds, and what to mark in it.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Excerpt {
    shown: String,
    mark_from: usize,
    mark_width: usize,
}

/// The fault of a document.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Problem {
    /// Neither a preset nor a file.
    #[error("there is no {kind} preset and no file called `{name}`")]
    NoSuchPresetOrFile {
        /// What was looked for.
        kind: Kind,
        /// Under which name.
        name: String,
    },
    /// A path that leads nowhere.
    #[error("there is no such file")]
    NoSuchFile,
    /// A folder where a file should be.
    #[error("this is a folder, not a file")]
    Folder,
    /// A link without a file, a device, a pipe with a name.
    #[error("{0}")]
    NotAFile(FileProblem),
    /// The disk, or permission for it, failed.
    #[error("cannot be read: {message}")]
    Unreadable {
        /// What failed.
        kind: io::ErrorKind,
        /// The system's words.
        message: String,
    },
    /// More than a document, or a table of samples, may be.
    #[error("is larger than {limit} bytes, the most that is read")]
    TooLarge {
        /// The most that is read.
        limit: u64,
    },
    /// Bytes that are no text.
    #[error("is not a text: no UTF-8 after byte {valid_up_to}")]
    NotText {
        /// How far it was.
        valid_up_to: usize,
    },
    /// Nothing but blanks and comments.
    #[error("is empty: a document has at least a `schema`")]
    Empty,
    /// Not TOML.
    #[error("not TOML: {0}")]
    Syntax(String),
    /// Tables in tables in tables.
    #[error("nested more than {limit} levels deep")]
    TooDeep {
        /// The most that is followed.
        limit: usize,
    },
    /// A key that does not exist here.
    #[error("unknown key `{key}`")]
    UnknownKey {
        /// The key, with the tables it stands in.
        key: String,
    },
    /// A number under its key and under that for thousands of its unit.
    #[error("`{key}` is `{other}` in thousands of its unit, and that is given too")]
    GivenInThousands {
        /// The key for thousands, with the tables it stands in.
        key: String,
        /// The other key.
        other: String,
    },
    /// A key that must be there.
    #[error("`{key}` is missing")]
    MissingKey {
        /// The key, with the tables it should stand in.
        key: String,
    },
    /// A value of another type.
    #[error("`{key}` is {found}, it must be {expected}")]
    WrongType {
        /// The key.
        key: String,
        /// Value and type that were found.
        found: String,
        /// Types that would do.
        expected: String,
    },
    /// TOML's `nan` and `inf`.
    #[error("`{key}` is {value}, it must be a finite number{range}")]
    NotFinite {
        /// The key.
        key: String,
        /// The value.
        value: f64,
        /// The range, after a comma, or nothing.
        range: String,
    },
    /// A number outside its range.
    #[error("`{key}` is {}, it must be {range}", number(*value))]
    OutOfRange {
        /// The key.
        key: String,
        /// The value.
        value: f64,
        /// What is allowed.
        range: String,
    },
    /// A word that is not among the allowed ones.
    #[error("`{key}` is \"{value}\", it must be {allowed}")]
    NotAllowed {
        /// The key.
        key: String,
        /// The word.
        value: String,
        /// The allowed ones.
        allowed: String,
    },
    /// A table, named first, with none of some keys.
    #[error("{0} needs {1}")]
    NoneOf(String, String),
    /// A table, named first, with two keys that exclude each other.
    #[error("{0} has {1}, which exclude each other")]
    SeveralOf(String, String),
    /// A key that means nothing without another one.
    #[error("`{key}` goes with `{other}`, which is not given")]
    GoesWith {
        /// The key.
        key: String,
        /// The other key of its table.
        other: String,
    },
    /// A text with too few characters.
    #[error("`{key}` is too short a text, it must have {least} or more characters")]
    TooShort {
        /// The key.
        key: String,
        /// How many characters it must have.
        least: u64,
    },
    /// A list that is too short or too long.
    #[error("`{key}` has {count} entries, it must have {allowed}")]
    WrongLength {
        /// The key.
        key: String,
        /// How many there are.
        count: usize,
        /// How many there may be.
        allowed: String,
    },
    /// Two of the same name.
    #[error("`{key}` is \"{name}\" a second time, names must differ")]
    RepeatedName {
        /// The key.
        key: String,
        /// The name.
        name: String,
    },
    /// A document of one kind where another is needed.
    #[error("this is a `{found}` document, a `{expected}` document is needed")]
    WrongKind {
        /// What its `schema` says.
        found: String,
        /// What it should say.
        expected: &'static str,
    },
    /// Values that are fine one by one, but not together.
    #[error("{0}")]
    Unfit(#[from] ParameterError),
    /// Something that cannot be uncertain.
    #[error("`{key}` is not a number of {whole}, only numbers can be uncertain")]
    NotANumber {
        /// The key.
        key: String,
        /// What has the key.
        whole: &'static str,
    },
    /// A correlation of a key that is not uncertain.
    #[error("`{key}` has a correlation, but no standard deviation")]
    NotUncertain {
        /// The key.
        key: String,
    },
    /// A leg of a mission that no rover can drive.
    #[error("leg {number} {what}")]
    Leg {
        /// Its number, counted from 1.
        number: usize,
        /// What is wrong with it, as the rest of a sentence.
        what: String,
    },
    /// An invalid file of legs.
    #[error("not a file of legs: {0}")]
    NoLegs(String),
    /// An invalid map of heights, or a place beyond it.
    #[error("{0}")]
    NoTerrain(String),
    /// Parts of a document that do not go together.
    #[error("{0}")]
    Conflict(&'static str),
    /// Correlations that no soil can have.
    #[error("{0}")]
    Contradiction(#[from] Contradiction),
    /// A distribution outside the ranges of its keys.
    #[error("the uncertainty reaches too far: {0}")]
    NoDraws(#[from] NothingAccepted),
    /// A distribution far from its key's range.
    #[error("less than 1 % of the samples of `{key}` would be in its range, {range}")]
    OutsideRange {
        /// The key.
        key: String,
        /// Its range.
        range: String,
    },
    /// A file of samples that is not there.
    #[error("there is no file of samples {name}")]
    NoSamples {
        /// Its path.
        name: String,
    },
    /// A text that is no table of samples.
    #[error("not a table of samples: {0}")]
    NoTable(String),
    /// An argument that is not `document.key=value`.
    #[error("{0}")]
    Malformed(&'static str),
}

impl From<FileProblem> for Problem {
    fn from(problem: FileProblem) -> Self {
        match problem {
            FileProblem::NoSuchFile => Self::NoSuchFile,
            FileProblem::Folder => Self::Folder,
            FileProblem::TooLarge { limit } => Self::TooLarge { limit },
            FileProblem::Unreadable { kind, message } => Self::Unreadable { kind, message },
            FileProblem::BrokenLink { .. }
            | FileProblem::NotAFile { .. }
            | FileProblem::Outside => Self::NotAFile(problem),
        }
    }
}

impl DocumentError {
    /// An error at a spot of a text.
    #[must_use]
    pub fn at(origin: &Origin, problem: Problem) -> Self {
        Self::of(Place::of(origin), problem)
    }

    /// An error that concerns a text as a whole.
    pub(crate) fn whole(document: impl Into<String>, problem: Problem) -> Self {
        Self::of(Place { document: document.into(), spot: None }, problem)
    }

    fn of(place: Place, problem: Problem) -> Self {
        Self {
            parts: Box::new(Parts {
                place,
                problem,
                hint: None,
                meant: Vec::new(),
                named_at: None,
            }),
        }
    }

    /// The same with a hint.
    #[must_use]
    pub fn with_hint(mut self, hint: impl Into<Option<String>>) -> Self {
        self.parts.hint = hint.into();
        self
    }

    /// The same with another sentence after its hint.
    pub(crate) fn also(mut self, hint: &str) -> Self {
        let own = self.parts.hint.take().map_or(String::new(), |own| format!("{own} "));
        self.parts.hint = Some(own + hint);
        self
    }

    /// The same with the keys that an unknown one was probably meant to be.
    pub(crate) fn with_meant(mut self, keys: Vec<String>) -> Self {
        self.parts.meant = keys;
        self
    }

    /// The same, with the place where another document names the wrong one.
    pub(crate) fn seen_from(mut self, origin: &Origin) -> Self {
        self.parts.place = Place::of(origin);
        self
    }

    /// The same, with the spot where another document names the one that is wrong. Arguments have
    /// no lines to look at, and show the name themselves.
    pub(crate) fn named_by(mut self, origin: &Origin) -> Self {
        let place = &self.parts.place;
        let is_argument = |spot: &Spot| spot.excerpt.is_none();
        let is_elsewhere = place.document == origin.text.label
            || place.spot.as_ref().is_some_and(is_argument)
            || origin.text.is_argument;
        if self.parts.named_at.is_none() && !is_elsewhere {
            self.parts.named_at = Some(Place::of(origin));
        }
        self
    }

    /// The same, as an argument's, such as `--soil moon`, if that names nothing there is.
    #[must_use]
    pub fn in_argument(mut self, argument: String) -> Self {
        if matches!(self.problem(), Problem::NoSuchPresetOrFile { .. }) {
            self.parts.place = Place { document: argument, spot: None };
        }
        self
    }

    /// The place of the fault.
    #[must_use]
    pub fn place(&self) -> &Place {
        &self.parts.place
    }

    /// Where another document names the one that is wrong, if one does.
    #[must_use]
    pub fn named_at(&self) -> Option<&Place> {
        self.parts.named_at.as_ref()
    }

    /// What it is.
    #[must_use]
    pub fn problem(&self) -> &Problem {
        &self.parts.problem
    }

    /// A hint to correct it.
    #[must_use]
    pub fn hint(&self) -> Option<&str> {
        self.parts.hint.as_deref()
    }

    /// The keys that an unknown one was probably meant to be, with the tables they stand in, as the
    /// hint has them.
    #[must_use]
    pub fn meant(&self) -> &[String] {
        &self.parts.meant
    }

    /// Whether the disk or its permissions failed, rather than the document or its name: a program
    /// then ends with 1 instead of 2.
    #[must_use]
    pub fn is_environment(&self) -> bool {
        matches!(self.problem(), Problem::Unreadable { .. })
    }
}

impl Place {
    pub(crate) fn of(origin: &Origin) -> Self {
        Self { document: origin.text.label.clone(), spot: Some(Spot::of(origin)) }
    }
}

impl Spot {
    fn of(origin: &Origin) -> Self {
        let Origin { text, span } = origin;
        let line = text.line_around(span.start);
        let number = text.content[..line.start].matches('\n').count() + 1;
        let column = text.content[line.start..span.start.min(line.end)].chars().count();
        let excerpt = (!text.is_argument).then(|| Excerpt::of(text, &line, span));
        Self { line: number, column: column + 1, excerpt }
    }
}

impl Excerpt {
    fn of(text: &Text, line: &Range<usize>, span: &Range<usize>) -> Self {
        /// Characters of a line that are shown, and how many of them stand before the mark.
        const WIDTH: usize = 100;
        const BEFORE: usize = 40;
        let content = &text.content[line.clone()];
        let to_chars = |byte: usize| {
            content.char_indices().take_while(|(at, _)| *at + line.start < byte).count()
        };
        let (from, to) = (to_chars(span.start), to_chars(span.end));
        let skipped =
            if content.chars().nth(WIDTH).is_some() { from.saturating_sub(BEFORE) } else { 0 };
        let shown: String = content
            .chars()
            .skip(skipped)
            .take(WIDTH)
            .map(|c| if escape::is_hidden(c) { ' ' } else { c })
            .collect();
        let mark_from = from - skipped;
        let room = WIDTH.saturating_sub(mark_from).max(1);
        Self { shown, mark_from, mark_width: (to - from).clamp(1, room) }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&escape::line(&self.document))?;
        match &self.spot {
            Some(Spot { line, column, excerpt: Some(_) }) => write!(f, ":{line}:{column}"),
            _ => Ok(()),
        }
    }
}

/// Characters of a problem or a hint: a key may be as long as a document.
const LONGEST_MESSAGE: usize = 2000;

impl fmt::Display for DocumentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let problem = self.problem().to_string();
        write!(f, "{}: {}", self.place(), escape::short_line(&problem, LONGEST_MESSAGE))?;
        if let Some(Spot { line, excerpt: Some(excerpt), .. }) = &self.place().spot {
            let margin = " ".repeat(line.to_string().len());
            let Excerpt { shown, mark_from, mark_width } = excerpt;
            let mark = format!("{}{}", " ".repeat(*mark_from), "^".repeat(*mark_width));
            write!(f, "\n{margin} |\n{line} | {}\n{margin} | {mark}", shown.trim_end())?;
        }
        if let Some(place) = self.named_at() {
            write!(f, "\nthe file is named by {place}")?;
        }
        match self.hint() {
            Some(hint) => write!(f, "\nhint: {}", escape::short_line(hint, LONGEST_MESSAGE)),
            None => Ok(()),
        }
    }
}

impl std::error::Error for DocumentError {}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;

    fn message(content: &str, marked: &str) -> String {
        let start = content.find(marked).expect("it is there");
        let text = Arc::new(Text {
            label: "a.toml".to_owned(),
            content: content.to_owned(),
            ..Text::default()
        });
        let origin = Origin { text, span: start..start + marked.len() };
        DocumentError::at(&origin, Problem::Empty).to_string()
    }

    #[test]
    fn the_mark_stands_under_the_value_whatever_the_characters_before_it() {
        let message = message("x = 1\n\"φρ\" = 25 # µ\n", "25");
        let lines: Vec<_> = message.lines().collect();
        assert!(lines[0].starts_with("a.toml:2:8: "), "{message}");
        assert_eq!(lines[2], "2 | \"φρ\" = 25 # µ");
        assert_eq!(lines[3], "  |        ^^");
    }

    #[test]
    fn a_long_line_is_shown_around_the_mark() {
        let content = format!("{}25{}", "a".repeat(5000), "b".repeat(5000));
        let message = message(&content, "25");
        assert!(message.starts_with("a.toml:1:5001: "), "{message}");
        let lines: Vec<_> = message.lines().collect();
        assert!(lines[2].len() < 120 && lines[2].contains("a25b"), "{message}");
        assert_eq!(lines[3].find('^'), lines[2].find("25"));
    }
}
