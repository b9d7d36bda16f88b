//! A part of a log, of any kind, record by record: a table, or files of MCAP that follow one another or
//! were recorded side by side.

use std::cell::Cell;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek as _};
use std::path::{Path, PathBuf};
use std::rc::Rc;

use flate2::read::MultiGzDecoder;
use grouser_core::vehicle::Rover;
use grouser_io::given_file::GivenFile;
use grouser_io::measurements::telemetry::{
    Lost, Odometry, TelemetryReader, TelemetryRecord, TelemetryRows,
};
use grouser_io::{escape, file};

use super::arrow::{self, ArrowText};
use super::mapped::{MappedTable, Rows};
use super::mcap::{McapFile, McapLog};
use super::options::LogOptions;
use super::other_kind::OtherKind;
use super::parquet::{self, ParquetCells, ParquetLog};
use crate::error::{OverBudget, Problem, TelemetryError};
use crate::mapping::messages::MessageRows;
use crate::mcap::format::MAGIC;

/// How a file that is packed by gzip begins.
const GZIP: &[u8] = &[0x1f, 0x8b];

/// What a part is read from.
#[derive(Clone, Debug)]
pub(super) enum PartFiles {
    /// MCAP alone, one file or several.
    Mcap(Vec<PathBuf>),
    /// A file of any kind.
    One(PathBuf),
}

/// A part of a log, opened.
pub(super) struct LogPart {
    label: String,
    source: Source,
    /// Has the budget of what is packed by gzip, once that was over.
    over: Rc<Cell<Option<OverBudget>>>,
}

enum Source {
    Csv { reader: Box<TelemetryReader<'static, LastByte>>, ended_in_row: Rc<Cell<bool>> },
    Mapped { table: Box<MappedTable<LastByte>>, ended_in_row: Rc<Cell<bool>> },
    Parquet(Box<ParquetLog>),
    Mcap(Box<McapLog>),
}

impl LogPart {
    fn of(label: &str, source: Source) -> Self {
        Self { label: label.to_owned(), source, over: Rc::default() }
    }

    /// Opens a part; what a file is, its first bytes say.
    pub(super) fn open(
        files: &PartFiles,
        rover: &Rover,
        options: &LogOptions,
    ) -> Result<Self, TelemetryError> {
        match files {
            PartFiles::Mcap(paths) => Self::of_mcap(paths, rover, options),
            PartFiles::One(path) => Self::of_file(path, rover, options),
        }
    }

    fn of_mcap(
        paths: &[PathBuf],
        rover: &Rover,
        options: &LogOptions,
    ) -> Result<Self, TelemetryError> {
        let label = label_of(paths);
        let look = |path: &PathBuf| McapFile::look(path, options, paths.len() > 1);
        let files = paths.iter().map(look).collect::<Result<_, _>>()?;
        let log = McapLog::new(&label, files, rover, options)?;
        Ok(Self::of(&label, Source::Mcap(Box::new(log))))
    }

    fn of_file(path: &Path, rover: &Rover, options: &LogOptions) -> Result<Self, TelemetryError> {
        let label = escape::path(path);
        let of_disk = |error| TelemetryError::new(&label, Problem::Unreadable(error));
        let mut file =
            file::open(path).map_err(|problem| TelemetryError::new(&label, problem.into()))?;
        let start = first_bytes(&mut file).map_err(of_disk)?;
        // What is a pipe cannot be sought in.
        if file.rewind().is_err() {
            let source = Box::new(BufReader::new(io::Cursor::new(start).chain(file)));
            return Self::of_table(&label, source, rover, options);
        }
        if let Some(kind) = OtherKind::beginning_with(&start) {
            return Err(TelemetryError::new(&label, Problem::OtherKind(kind)));
        }
        if start.starts_with(&MAGIC) {
            return Self::of_mcap(&[path.to_owned()], rover, options);
        }
        if start.starts_with(parquet::MAGIC) {
            return Self::of_parquet(&label, file, rover, options);
        }
        let is_file = start.starts_with(arrow::MAGIC);
        if !is_file && !start.starts_with(arrow::CONTINUATION) && !start.starts_with(GZIP) {
            return Self::of_table(&label, Box::new(BufReader::new(file)), rover, options);
        }
        let budget = options.budget(&file).map_err(of_disk)?;
        let file = BufReader::new(file);
        let source: Box<dyn Read> = if start.starts_with(GZIP) {
            Box::new(MultiGzDecoder::new(file))
        } else {
            let text = ArrowText::new(file, is_file);
            Box::new(text.map_err(|error| TelemetryError::of_reading(&label, error))?)
        };
        Self::of_unpacked(&label, (source, budget), rover, options)
    }

    /// Reads CSV that something is unpacked to, within a budget.
    fn of_unpacked(
        label: &str,
        (source, budget): (Box<dyn Read>, OverBudget),
        rover: &Rover,
        options: &LogOptions,
    ) -> Result<Self, TelemetryError> {
        let over = Rc::new(Cell::new(None));
        let rest = budget.most_unpacked();
        let source = Box::new(Unpacked { source, rest, budget, over: over.clone() });
        let part = Self::of_table(label, source, rover, options);
        let part = part.map_err(|error| over_budget(label, &over, error))?;
        Ok(Self { over, ..part })
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
    pub(super) fn of_table(
        label: &str,
        source: Box<dyn Read>,
        rover: &Rover,
        options: &LogOptions,
    ) -> Result<Self, TelemetryError> {
        let Some(mapping) = options.mapping_of_table(label)? else {
            return Self::of_csv(label, source, rover, options);
        };
        let (source, ended_in_row) = LastByte::of(source);
        let rows = Rows::of_csv(label, source)?;
        let table = Box::new(MappedTable::new(label, rows, mapping, rover, options)?);
        Ok(Self::of(label, Source::Mapped { table, ended_in_row }))
    }

    fn of_parquet(
        label: &str,
        file: File,
        rover: &Rover,
        options: &LogOptions,
    ) -> Result<Self, TelemetryError> {
        let mapping = options.mapping_of_table(label)?;
        let cells = ParquetCells::new(label, file)?;
        let source = if let Some(mapping) = mapping {
            let rows = Rows::Parquet(Box::new(cells.with_numbers()));
            let table = Box::new(MappedTable::new(label, rows, mapping, rover, options)?);
            Source::Mapped { table, ended_in_row: Rc::default() }
        } else {
            Source::Parquet(Box::new(ParquetLog::new(cells, rover, options.odometry)?))
        };
        Ok(Self::of(label, source))
    }

    /// Reads CSV as it comes, such as from standard input.
    ///
    /// * `label`: what messages call the source
    /// * `options`: a mapping and choices of topics have no meaning here
    ///
    /// # Errors
    /// [`TelemetryError`] for a header that is no telemetry of this rover.
    fn of_csv(
        label: &str,
        source: Box<dyn Read>,
        rover: &Rover,
        options: &LogOptions,
    ) -> Result<Self, TelemetryError> {
        let (source, ended_in_row) = LastByte::of(source);
        let reader = TelemetryReader::new(label.to_owned(), source, rover)?;
        let reader = Box::new(reader.measured_by(options.odometry.unwrap_or(Odometry::Visual)));
        Ok(Self::of(label, Source::Csv { reader, ended_in_row }))
    }

    /// What messages call it.
    pub(super) fn label(&self) -> &str {
        &self.label
    }

    /// The next record, if there is one; times rise from record to record.
    ///
    /// # Errors
    /// [`TelemetryError`] where reading fails, or what comes cannot be telemetry.
    pub(super) fn next_record(&mut self) -> Result<Option<TelemetryRecord>, TelemetryError> {
        let record = match &mut self.source {
            Source::Csv { reader, .. } => reader.next_record().map_err(TelemetryError::from),
            Source::Mapped { table, .. } => table.next_record(),
            Source::Parquet(log) => log.next_record(),
            Source::Mcap(log) => log.next_record(),
        };
        record.map_err(|error| over_budget(&self.label, &self.over, error))
    }

    /// How many rows were read so far.
    pub(super) fn rows(&self) -> u64 {
        self.table().rows()
    }

    /// Whether the row of the last record has its end: the last row of CSV that is being written
    /// may not.
    pub(super) fn is_whole(&self) -> bool {
        match &self.source {
            Source::Csv { ended_in_row, .. } | Source::Mapped { ended_in_row, .. } => {
                !ended_in_row.get()
            }
            Source::Parquet(_) | Source::Mcap(_) => true,
        }
    }

    /// What was left out of its rows so far.
    pub(super) fn lost(&self) -> &Lost {
        self.table().lost()
    }

    /// What it gave so far, and what a mapping of the user's did.
    pub(super) fn given(&self) -> Vec<GivenFile> {
        let mut files: Vec<GivenFile> = match &self.source {
            Source::Mcap(log) => log.given(),
            _ => vec![self.table().given(self.label())],
        };
        files[0].there += self.parquet().map_or(0, ParquetCells::unread);
        files.extend(self.messages().and_then(MessageRows::given_mapping).cloned());
        files
    }

    /// The share of its rows, or readings, that was used so far [-].
    pub(super) fn share_used(&self) -> f64 {
        let rows = || self.table().share_used();
        let of_read = self.messages().map_or_else(rows, MessageRows::share_used);
        self.parquet().map_or(of_read, |cells| cells.share_used(of_read))
    }

    /// What is not used, and what was left out besides [`lost`](Self::lost): a sentence each.
    pub(super) fn notes_of_source(&self) -> Vec<String> {
        let of_kind = match &self.source {
            Source::Csv { .. } => Vec::new(),
            Source::Mapped { table, .. } => table.notes(),
            Source::Parquet(log) => log.cells().notes(),
            Source::Mcap(log) => log.notes(),
        };
        let table = self.table();
        let of_table = [
            table.sentence_of_odometry(),
            table.sentence_of_time(),
            table.sentence_of_times(),
            table.sentence_of_sides(),
            table.sentence_of_unused(),
        ];
        of_kind.into_iter().chain(of_table.into_iter().flatten()).collect()
    }

    fn table(&self) -> &TelemetryRows {
        match &self.source {
            Source::Csv { reader, .. } => reader.rows(),
            Source::Mapped { table, .. } => table.messages().rows(),
            Source::Parquet(log) => log.rows(),
            Source::Mcap(log) => log.messages().rows(),
        }
    }

    /// The messages that become records, of what is read by a mapping.
    fn messages(&self) -> Option<&MessageRows> {
        match &self.source {
            Source::Csv { .. } | Source::Parquet(_) => None,
            Source::Mapped { table, .. } => Some(table.messages()),
            Source::Mcap(log) => Some(log.messages()),
        }
    }

    /// The file of Parquet that it is, if it is one.
    fn parquet(&self) -> Option<&ParquetCells> {
        match &self.source {
            Source::Csv { .. } | Source::Mcap(_) => None,
            Source::Mapped { table, .. } => table.parquet(),
            Source::Parquet(log) => Some(log.cells()),
        }
    }
}

/// An error of a table, or the budget that was over, which it has as a text alone.
fn over_budget(
    label: &str,
    over: &Cell<Option<OverBudget>>,
    error: TelemetryError,
) -> TelemetryError {
    let budget = over.get().map(|it| TelemetryError::new(label, Problem::OverBudget(it)));
    budget.unwrap_or(error)
}

/// What messages call some files, of which there is one at least.
pub(super) fn label_of(paths: &[PathBuf]) -> String {
    let first = paths.first().map(|it| escape::path(it)).unwrap_or_default();
    match paths.len() {
        0 | 1 => first,
        count => format!("{first} and {} more", count - 1),
    }
}

/// Whether a file is MCAP; what cannot be read is another matter.
pub(super) fn is_mcap(path: &Path) -> bool {
    let start = file::open(path).ok().and_then(|mut file| first_bytes(&mut file).ok());
    start.is_some_and(|it| it.starts_with(&MAGIC))
}

/// Reads as many bytes as show what a file is, or all that it has.
fn first_bytes(file: &mut File) -> io::Result<Vec<u8>> {
    const ENOUGH: u64 = 16;
    let mut start = Vec::new();
    file.take(ENOUGH).read_to_end(&mut start)?;
    Ok(start)
}

/// What a source unpacks to, within a budget.
struct Unpacked<R> {
    source: R,
    /// What is left of the budget [bytes].
    rest: u64,
    budget: OverBudget,
    /// Has the budget once it was over.
    over: Rc<Cell<Option<OverBudget>>>,
}

impl<R: Read> Read for Unpacked<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.source.read(buffer)?;
        if let Some(rest) = self.rest.checked_sub(count as u64) {
            self.rest = rest;
            return Ok(count);
        }
        self.over.set(Some(self.budget));
        Err(io::Error::other(self.budget))
    }
}

/// Notices whether a source ends within a row.
struct LastByte {
    source: Box<dyn Read>,
    last: u8,
    ended_in_row: Rc<Cell<bool>>,
}

impl LastByte {
    /// The source, and whether it ended within a row.
    fn of(source: Box<dyn Read>) -> (Self, Rc<Cell<bool>>) {
        let ended_in_row = Rc::new(Cell::new(false));
        (Self { source, last: b'\n', ended_in_row: ended_in_row.clone() }, ended_in_row)
    }
}

impl Read for LastByte {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.source.read(buffer)?;
        match buffer[..count].last() {
            Some(last) => self.last = *last,
            None if !buffer.is_empty() => {
                self.ended_in_row.set(!matches!(self.last, b'\n' | b'\r'));
            }
            None => {}
        }
        Ok(count)
    }
}
