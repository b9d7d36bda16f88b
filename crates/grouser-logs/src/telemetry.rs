//! A log of any kind, record by record.

mod mapped;
mod mcap;
pub(crate) mod options;
mod parquet;
pub(crate) mod writer;

use std::cell::Cell;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek as _};
use std::iter;
use std::path::Path;
use std::rc::Rc;

use flate2::read::MultiGzDecoder;
use grouser_core::vehicle::Rover;
use grouser_io::given_file::GivenFile;
use grouser_io::measurements::telemetry::{
    Lost, Odometry, TelemetryReader, TelemetryRecord, TelemetryRows,
};
use grouser_io::{escape, file};

use self::mapped::{MappedTable, Rows};
use self::mcap::McapLog;
use self::options::LogOptions;
use self::parquet::{ParquetCells, ParquetLog};
use crate::error::{OverBudget, Problem, TelemetryError};
use crate::mapping::messages::MessageRows;
use crate::mcap::format::MAGIC;

/// How a file that is packed by gzip begins.
const GZIP: &[u8] = &[0x1f, 0x8b];

/// Telemetry of a drive, opened.
pub struct TelemetryLog {
    label: String,
    source: Source,
}

enum Source {
    Csv { reader: Box<TelemetryReader<'static, LastByte>>, ended_in_row: Rc<Cell<bool>> },
    Mapped { table: Box<MappedTable<LastByte>>, ended_in_row: Rc<Cell<bool>> },
    Parquet(Box<ParquetLog>),
    Mcap(Box<McapLog>),
}

impl TelemetryLog {
    /// Opens a file; its first bytes say what it is.
    ///
    /// * `rover`: the rover that was driven, for the names of its wheels
    /// * `options`: how it is read; of a table a mapping says which columns are which, as it says of
    ///   the fields of messages
    ///
    /// # Errors
    /// [`TelemetryError`] for a file that cannot be opened, or is no telemetry of this rover; with
    /// [`Problem::Ambiguous`] another call can make the choice.
    pub fn open(path: &Path, rover: &Rover, options: &LogOptions) -> Result<Self, TelemetryError> {
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
        let bags: [(&[u8], &str); 2] =
            [(b"#ROSBAG V", "a bag of ROS 1"), (b"SQLite format 3", "a bag of ROS 2 in SQLite")];
        if let Some((_, kind)) = bags.iter().find(|(magic, _)| start.starts_with(magic)) {
            return Err(TelemetryError::new(&label, Problem::OtherKind(kind)));
        }
        if start.starts_with(&MAGIC) {
            let log = McapLog::new(&label, file, rover, options)?;
            return Ok(Self { label, source: Source::Mcap(Box::new(log)) });
        }
        if start.starts_with(parquet::MAGIC) {
            return Self::of_parquet(&label, file, rover, options);
        }
        let source: Box<dyn Read> = if start.starts_with(GZIP) {
            let budget = options.budget(&file).map_err(of_disk)?;
            let source = MultiGzDecoder::new(BufReader::new(file));
            Box::new(Unpacked { source, rest: budget.most_unpacked(), budget })
        } else {
            Box::new(BufReader::new(file))
        };
        Self::of_table(&label, source, rover, options)
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
        let Some(mapping) = options.mapping_of_table(label)? else {
            return Self::of_csv(label, source, rover, options);
        };
        let (source, ended_in_row) = LastByte::of(source);
        let rows = Rows::of_csv(label, source)?;
        let table = Box::new(MappedTable::new(label, rows, mapping, rover, options)?);
        Ok(Self { label: label.to_owned(), source: Source::Mapped { table, ended_in_row } })
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
        Ok(Self { label: label.to_owned(), source })
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
        Ok(Self { label: label.to_owned(), source: Source::Csv { reader, ended_in_row } })
    }

    /// What messages call it.
    #[must_use]
    pub fn label(&self) -> &str {
        &self.label
    }

    /// The next record, if there is one; times rise from record to record.
    ///
    /// # Errors
    /// [`TelemetryError`] where reading fails, or what comes cannot be telemetry.
    pub fn next_record(&mut self) -> Result<Option<TelemetryRecord>, TelemetryError> {
        match &mut self.source {
            Source::Csv { reader, .. } => Ok(reader.next_record()?),
            Source::Mapped { table, .. } => table.next_record(),
            Source::Parquet(log) => log.next_record(),
            Source::Mcap(log) => log.next_record(),
        }
    }

    /// How many rows were read so far.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.table().rows()
    }

    /// Whether the row of the last record has its end: the last row of CSV that is being written
    /// may not.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        match &self.source {
            Source::Csv { ended_in_row, .. } | Source::Mapped { ended_in_row, .. } => {
                !ended_in_row.get()
            }
            Source::Parquet(_) | Source::Mcap(_) => true,
        }
    }

    /// What was left out of its rows so far.
    #[must_use]
    pub fn lost(&self) -> &Lost {
        self.table().lost()
    }

    /// What it gave so far, and what a mapping of the user's did.
    #[must_use]
    pub fn given(&self) -> Vec<GivenFile> {
        let log = self.table().given(self.label());
        let unread = self.parquet().map_or(0, ParquetCells::unread);
        let log = GivenFile { there: log.there + unread, ..log };
        let mapping = self.messages().and_then(MessageRows::given_mapping).cloned();
        iter::once(log).chain(mapping).collect()
    }

    /// The share of its rows, or readings, that was used so far [-].
    #[must_use]
    pub fn share_used(&self) -> f64 {
        let rows = || self.table().share_used();
        let of_read = self.messages().map_or_else(rows, MessageRows::share_used);
        self.parquet().map_or(of_read, |cells| cells.share_used(of_read))
    }

    /// What was left out so far, and what is not used: a sentence each.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        self.lost().sentences().into_iter().chain(self.notes_of_source()).collect()
    }

    /// The same without what was left out of its rows, which is [`lost`](Self::lost).
    #[must_use]
    pub fn notes_of_source(&self) -> Vec<String> {
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
}

impl<R: Read> Read for Unpacked<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.source.read(buffer)?;
        let over =
            || io::Error::other(format!("{}; a larger `max_unpacked_mib` reads more", self.budget));
        self.rest = self.rest.checked_sub(count as u64).ok_or_else(over)?;
        Ok(count)
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
