//! A log of any kind, record by record.

mod arrow;
mod mapped;
pub(crate) mod mcap;
pub(crate) mod options;
pub(crate) mod other_kind;
mod parquet;
mod part;
pub(crate) mod writer;

use std::collections::VecDeque;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use grouser_core::vehicle::Rover;
use grouser_io::escape;
use grouser_io::file::FileProblem;
use grouser_io::given_file::GivenFile;
use grouser_io::measurements::telemetry::{Lost, TelemetryRecord};

use self::options::LogOptions;
use self::other_kind::OtherKind;
use self::part::{LogPart, PartFiles, is_mcap, label_of};
use crate::error::{Problem, TelemetryError};

/// Telemetry of a drive, opened.
///
/// It may be of several files by one clock: files of MCAP, which follow one another or, with topics of
/// their own, were recorded side by side, are read as one log, and of others each after the one
/// before.
pub struct TelemetryLog {
    label: String,
    /// Parts that were read, and last the one that is.
    parts: Vec<LogPart>,
    /// What was left out of all but the last.
    lost_before: Lost,
    later: VecDeque<Later>,
    /// Whether the next way may lack some since the file before.
    is_after_border: bool,
}

/// A part that is read later.
struct Later {
    files: PartFiles,
    label: String,
    /// Time of its first record [s].
    begins: f64,
    rover: Rover,
    options: LogOptions,
}

impl TelemetryLog {
    /// Opens a file, whose first bytes say what it is, or a folder of MCAP files.
    ///
    /// * `rover`: the rover that was driven, for the names of its wheels
    /// * `options`: how it is read; of a table a mapping says which columns are which, as it says of
    ///   the fields of messages
    ///
    /// # Errors
    /// [`TelemetryError`] for a file that cannot be opened, or is no telemetry of this rover; with
    /// [`Problem::Ambiguous`] another call can make the choice.
    pub fn open(path: &Path, rover: &Rover, options: &LogOptions) -> Result<Self, TelemetryError> {
        Self::open_all(&[path.to_owned()], rover, options)
    }

    /// Opens files of one drive, in any order.
    ///
    /// * `paths`: one or more, each as [`open`](Self::open) has it
    /// * `rover`, `options`: as there
    ///
    /// # Errors
    /// As [`open`](Self::open), and [`Problem::NoRows`] for one of several that has none; that files
    /// overlap may be found only while they are read.
    pub fn open_all(
        paths: &[PathBuf],
        rover: &Rover,
        options: &LogOptions,
    ) -> Result<Self, TelemetryError> {
        let label = Self::label_of(paths);
        let mut parts = parts_of(paths)?;
        if let [files] = &parts[..] {
            let part = LogPart::open(files, rover, options)?;
            return Ok(Self::of_part(label, part, VecDeque::new()));
        }
        let later = |files: PartFiles| Later::look(files, rover, options);
        let mut later = parts.drain(..).map(later).collect::<Result<Vec<_>, _>>()?;
        later.sort_by(|one, other| one.begins.total_cmp(&other.begins));
        let mut later = VecDeque::from(later);
        let Some(first) = later.pop_front() else {
            return Err(TelemetryError::new(&label, FileProblem::NoSuchFile.into()));
        };
        let part = first.open()?;
        Ok(Self::of_part(label, part, later))
    }

    /// Reads CSV as it comes, whose columns are fields of messages by a mapping, or else those of
    /// telemetry.
    ///
    /// * `label`: what messages call the source
    /// * `options`: as [`open`](Self::open) has them
    ///
    /// # Errors
    /// [`TelemetryError`] for a header of which the mapping reads nothing, or that is no telemetry
    /// of this rover.
    pub fn of_table(
        label: &str,
        source: Box<dyn Read>,
        rover: &Rover,
        options: &LogOptions,
    ) -> Result<Self, TelemetryError> {
        let part = LogPart::of_table(label, source, rover, options)?;
        Ok(Self::of_part(label.to_owned(), part, VecDeque::new()))
    }

    fn of_part(label: String, part: LogPart, later: VecDeque<Later>) -> Self {
        let lost_before = Lost::default();
        Self { label, parts: vec![part], lost_before, later, is_after_border: false }
    }

    /// What messages call files of a drive.
    #[must_use]
    pub fn label_of(paths: &[PathBuf]) -> String {
        label_of(paths)
    }

    /// What messages call it.
    #[must_use]
    pub fn label(&self) -> &str {
        &self.label
    }

    /// The next record, if there is one; times rise from record to record.
    ///
    /// # Errors
    /// [`TelemetryError`] where reading fails, what comes cannot be telemetry, or a file goes on when
    /// the next has begun.
    pub fn next_record(&mut self) -> Result<Option<TelemetryRecord>, TelemetryError> {
        loop {
            let part = self.last_mut();
            let Some(mut record) = part.next_record()? else {
                let Some(next) = self.later.pop_front() else { return Ok(None) };
                self.lost_before = self.lost();
                self.parts.push(next.open()?);
                self.is_after_border = true;
                continue;
            };
            if let Some(next) = self.later.front().filter(|it| record.time >= it.begins) {
                let (next, begins) = (next.label.clone(), next.begins);
                let problem = Problem::Overlap { next, ends: record.time, begins };
                return Err(TelemetryError::new(self.last().label(), problem));
            }
            if self.is_after_border {
                record.is_way_incomplete = true;
                let has_way = record.displacement.iter().any(Option::is_some);
                self.is_after_border = !has_way && record.rotation.is_none();
            }
            return Ok(Some(record));
        }
    }

    fn last(&self) -> &LogPart {
        &self.parts[self.parts.len() - 1]
    }

    fn last_mut(&mut self) -> &mut LogPart {
        let last = self.parts.len() - 1;
        &mut self.parts[last]
    }

    /// How many rows were read so far.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.parts.iter().map(LogPart::rows).sum()
    }

    /// Whether the row of the last record has its end: the last row of CSV that is being written
    /// may not.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        !self.later.is_empty() || self.last().is_whole()
    }

    /// What was left out of its rows so far.
    #[must_use]
    pub fn lost(&self) -> Lost {
        self.lost_before.and(self.last().lost())
    }

    /// What its files gave so far, and what a mapping of the user's did.
    #[must_use]
    pub fn given(&self) -> Vec<GivenFile> {
        let mut given = Vec::new();
        for file in self.parts.iter().flat_map(LogPart::given) {
            // A mapping reads the same of files that are alike.
            if !given.contains(&file) {
                given.push(file);
            }
        }
        given
    }

    /// What to say of a log, or of a folder of them, of which too little was used to rely on it
    /// without a word.
    ///
    /// * `share`: of its rows or readings [-]
    #[must_use]
    pub fn little_used(share: f64) -> Option<String> {
        /// Source: ours.
        const LEAST: f64 = 0.5;
        (share < LEAST)
            .then(|| format!("only {} % of the log could be used", (100.0 * share).floor()))
    }

    /// The share of its rows, or readings, that was used so far [-].
    #[must_use]
    pub fn share_used(&self) -> f64 {
        let rows: f64 = self.parts.iter().map(|it| it.rows() as f64).sum();
        let used = self.parts.iter().map(|it| it.rows() as f64 * it.share_used());
        if rows == 0.0 { self.last().share_used() } else { used.sum::<f64>() / rows }
    }

    /// What was left out so far, and what is not used: a sentence each.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        self.lost().sentences().into_iter().chain(self.notes_of_source()).collect()
    }

    /// The same without what was left out of its rows, which is [`lost`](Self::lost).
    #[must_use]
    pub fn notes_of_source(&self) -> Vec<String> {
        let all: Vec<_> = self.parts.iter().map(|it| (it.label(), it.notes_of_source())).collect();
        let is_of_all = |note: &String| all.iter().all(|(_, notes)| notes.contains(note));
        let of_one = all.iter().flat_map(|(label, notes)| {
            notes.iter().filter(|it| !is_of_all(it)).map(move |it| format!("{label}: {it}"))
        });
        all[0].1.iter().filter(|it| is_of_all(it)).cloned().chain(of_one).collect()
    }
}

impl Later {
    /// Reads the first record of a part.
    fn look(files: PartFiles, rover: &Rover, options: &LogOptions) -> Result<Self, TelemetryError> {
        let mut part = LogPart::open(&files, rover, options)?;
        let label = part.label().to_owned();
        let Some(record) = part.next_record()? else {
            return Err(TelemetryError::new(&label, Problem::NoRows));
        };
        let (rover, options) = (rover.clone(), options.clone());
        Ok(Self { files, label, begins: record.time, rover, options })
    }

    fn open(&self) -> Result<LogPart, TelemetryError> {
        LogPart::open(&self.files, &self.rover, &self.options)
    }
}

/// The parts of a log: files of MCAP are one part, if there are no others.
fn parts_of(paths: &[PathBuf]) -> Result<Vec<PartFiles>, TelemetryError> {
    let mut files = Vec::new();
    for path in paths {
        if path.is_dir() {
            files.extend(logs_in(path)?);
        } else {
            files.push(path.clone());
        }
    }
    let is_stream = |it: &&PathBuf| fs::metadata(it).is_ok_and(|it| !it.is_file());
    if let (true, Some(path)) = (files.len() > 1, files.iter().find(is_stream)) {
        return Err(TelemetryError::new(&escape::path(path), Problem::NotAmongSeveral));
    }
    if files.len() > 1 && files.iter().all(|it| is_mcap(it)) {
        return Ok(vec![PartFiles::Mcap(files)]);
    }
    Ok(files.into_iter().map(PartFiles::One).collect())
}

/// The files of MCAP in a folder, as recorders part a log, by their names.
fn logs_in(folder: &Path) -> Result<Vec<PathBuf>, TelemetryError> {
    let failed = |problem| TelemetryError::new(&escape::path(folder), problem);
    let of_disk = |error| failed(Problem::Unreadable(error));
    let mut all = Vec::new();
    for entry in fs::read_dir(folder).map_err(of_disk)? {
        all.push(entry.map_err(of_disk)?.path());
    }
    all.sort();
    let has_ending = |it: &PathBuf, ending: &str| {
        it.extension().is_some_and(|it| it.eq_ignore_ascii_case(ending))
    };
    let has_bag = all.iter().any(|it| has_ending(it, "db3"));
    all.retain(|it| has_ending(it, "mcap"));
    match (all.is_empty(), has_bag) {
        (false, _) => Ok(all),
        (true, true) => Err(failed(Problem::OtherKind(OtherKind::ROS_2))),
        (true, false) => Err(failed(Problem::NoLogInFolder)),
    }
}
