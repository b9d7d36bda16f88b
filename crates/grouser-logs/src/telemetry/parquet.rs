//! Telemetry of Parquet: the same table, column by column in groups of rows, read batch by batch.
//!
//! A file's pages are unpacked here and not by the library, which would take as much memory as a
//! page claims to need.

mod pages;

use std::fs::File;
use std::sync::Arc;

use grouser_core::vehicle::Rover;
use grouser_io::guard::guarded;
use grouser_io::measurements::telemetry::{Cell, Odometry, TelemetryRecord, TelemetryRows};
use parquet::basic::{LogicalType, TimeUnit, Type as PhysicalType};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl, get_column_reader};
use parquet::data_type::{ByteArray, DataType};
use parquet::errors::{ParquetError, Result as ParquetResult};
use parquet::file::metadata::{ParquetMetaData, ParquetMetaDataReader};
use parquet::schema::types::ColumnDescriptor;

use self::pages::{Bounded, Pages};
use crate::error::{Problem, TelemetryError};

/// How a file begins.
pub(crate) const MAGIC: &[u8] = b"PAR1";
/// So many rows are read at a time.
const BATCH: usize = 1024;

/// A file of Parquet, row by row.
pub(crate) struct ParquetCells {
    label: String,
    file: Arc<Bounded>,
    about: Arc<ParquetMetaData>,
    /// The names of its columns.
    names: Vec<String>,
    /// Places of the columns that are read.
    read: Vec<usize>,
    /// The group of rows that is read next.
    next_group: usize,
    group: Option<Group>,
    /// Cells of a batch, for each column; those that are not read stay empty.
    batch: Vec<Vec<Cell>>,
    at: usize,
    in_batch: usize,
    row: Vec<Cell>,
    rows: u64,
    /// Rows that a group has no cells for, since it is damaged.
    unread: u64,
    why_unread: Option<String>,
    /// Whether some of them lie before the next row.
    has_lost: bool,
}

/// A file of Parquet whose columns are those of telemetry, record by record.
pub(crate) struct ParquetLog {
    cells: ParquetCells,
    table: TelemetryRows,
}

/// Calls the library, which panics on some damaged files.
fn checked<T>(call: impl FnOnce() -> ParquetResult<T>) -> ParquetResult<T> {
    guarded(call).unwrap_or_else(|why| {
        Err(ParquetError::General(format!("it is damaged: copy it again ({why})")))
    })
}

/// A group of rows on its way.
struct Group {
    columns: Vec<(usize, ColumnReader, Scale)>,
    rows_left: usize,
}

/// What a stored number is in the unit of its column.
#[derive(Clone, Copy, Debug)]
enum Scale {
    Same,
    /// A time that counts so many in a second.
    PerSecond(f64),
}

impl ParquetLog {
    pub(crate) fn new(
        mut cells: ParquetCells,
        rover: &Rover,
        odometry: Option<Odometry>,
    ) -> Result<Self, TelemetryError> {
        let table = TelemetryRows::new(&cells.label, &cells.names, rover)?
            .measured_by(odometry.unwrap_or(Odometry::Visual));
        cells.read.retain(|place| table.is_used(*place));
        for place in &cells.read {
            cells.check(*place).map_err(|why| cells.failure(why))?;
        }
        Ok(Self { cells, table })
    }

    pub(crate) fn next_record(&mut self) -> Result<Option<TelemetryRecord>, TelemetryError> {
        loop {
            let Some((cells, has_lost)) = self.cells.next_row()? else { return Ok(None) };
            if has_lost {
                self.table.lose_way();
            }
            if let Some(record) = self.table.record(cells.iter().copied()) {
                return Ok(Some(record));
            }
        }
    }

    pub(crate) fn rows(&self) -> &TelemetryRows {
        &self.table
    }

    pub(crate) fn cells(&self) -> &ParquetCells {
        &self.cells
    }
}

impl ParquetCells {
    pub(crate) fn new(label: &str, file: File) -> Result<Self, TelemetryError> {
        let failed = |error: ParquetError| of_parquet(label, &error);
        let file = Bounded::new(file).map_err(failed)?;
        let about = checked(|| ParquetMetaDataReader::new().parse_and_finish(&file));
        let about = about.map_err(failed)?;
        let columns = about.file_metadata().schema_descr().columns();
        // A column inside another is not a column of the table.
        let names: Vec<String> = columns.iter().map(|it| it.path().string()).collect();
        Ok(Self {
            label: label.to_owned(),
            file: Arc::new(file),
            read: (0..names.len()).collect(),
            batch: vec![Vec::with_capacity(BATCH); names.len()],
            names,
            about: Arc::new(about),
            next_group: 0,
            group: None,
            at: 0,
            in_batch: 0,
            row: Vec::new(),
            rows: 0,
            unread: 0,
            why_unread: None,
            has_lost: false,
        })
    }

    /// Leaves out what has no number or text in each row.
    pub(crate) fn with_numbers(mut self) -> Self {
        let mut read = std::mem::take(&mut self.read);
        read.retain(|place| self.check(*place).is_ok());
        Self { read, ..self }
    }

    pub(crate) fn names(&self) -> &[String] {
        &self.names
    }

    /// The next row, if there is one, and whether damaged ones are before it.
    pub(crate) fn next_row(&mut self) -> Result<Option<(&[Cell], bool)>, TelemetryError> {
        if self.at >= self.in_batch && !self.fill()? {
            return Ok(None);
        }
        let at = self.at;
        self.at += 1;
        self.rows += 1;
        self.row.clear();
        let cell = |cells: &Vec<Cell>| cells.get(at).copied().unwrap_or(Cell::Gap);
        self.row.extend(self.batch.iter().map(cell));
        Ok(Some((&self.row, std::mem::take(&mut self.has_lost))))
    }

    /// # Errors
    /// A sentence, for a column that has no number or text in each row.
    fn check(&self, place: usize) -> Result<(), String> {
        check_column(&self.about.file_metadata().schema_descr().columns()[place])
    }

    fn failure(&self, why: String) -> TelemetryError {
        TelemetryError::new(&self.label, Problem::Damaged(why))
    }

    /// Reads the next batch; whether there is one.
    fn fill(&mut self) -> Result<bool, TelemetryError> {
        loop {
            let group = match self.group.take() {
                Some(group) if group.rows_left > 0 => Some(group),
                _ => self.next_group(),
            };
            let Some(mut group) = group else {
                // Where nothing could be read, the file is damaged, not short.
                return match &self.why_unread {
                    Some(why) if self.rows == 0 => Err(self.failure(why.clone())),
                    _ => Ok(false),
                };
            };
            let rows = group.rows_left.min(BATCH);
            match checked(|| group.read(rows, &mut self.batch)) {
                Ok(()) => {
                    group.rows_left -= rows;
                    (self.at, self.in_batch) = (0, rows);
                    self.group = Some(group);
                    return Ok(true);
                }
                Err(error) => self.lose(group.rows_left, &error),
            }
        }
    }

    /// The next group of rows whose columns can be opened.
    fn next_group(&mut self) -> Option<Group> {
        while self.next_group < self.about.num_row_groups() {
            let place = self.next_group;
            self.next_group += 1;
            let rows = usize::try_from(self.about.row_group(place).num_rows()).unwrap_or(0);
            match checked(|| self.open(place, rows)) {
                Ok(group) => return Some(group),
                Err(error) => self.lose(rows, &error),
            }
        }
        None
    }

    fn open(&self, place: usize, rows: usize) -> ParquetResult<Group> {
        let group = self.about.row_group(place);
        let columns = self.read.iter().map(|column| {
            let chunk = group.columns().get(*column);
            let chunk = chunk.ok_or_else(|| ParquetError::EOF("a column is missing".into()))?;
            let descriptor = chunk.column_descr_ptr();
            let scale = scale_of(&descriptor);
            let pages = Pages::new(Arc::clone(&self.file), chunk, rows)?;
            Ok((*column, get_column_reader(descriptor, Box::new(pages)), scale))
        });
        Ok(Group { columns: columns.collect::<ParquetResult<_>>()?, rows_left: rows })
    }

    fn lose(&mut self, rows: usize, error: &ParquetError) {
        self.unread += rows as u64;
        self.has_lost = true;
        self.why_unread.get_or_insert_with(|| error.to_string());
    }

    /// Damaged rows so far.
    pub(crate) fn unread(&self) -> u64 {
        self.unread
    }

    /// The share of its rows that was used so far, of that of those that could be read.
    pub(crate) fn share_used(&self, of_read: f64) -> f64 {
        let read = self.rows as f64;
        if read == 0.0 { of_read } else { of_read * read / (read + self.unread as f64) }
    }

    pub(crate) fn notes(&self) -> Vec<String> {
        let why = self.why_unread.iter();
        why.map(|why| format!("{} rows are damaged and left out: {why}", self.unread)).collect()
    }
}

impl Group {
    /// Reads so many rows of every column.
    fn read(&mut self, rows: usize, batch: &mut [Vec<Cell>]) -> ParquetResult<()> {
        for (column, reader, scale) in &mut self.columns {
            let cells = &mut batch[*column];
            cells.clear();
            read_cells(reader, *scale, rows, cells)?;
        }
        Ok(())
    }
}

fn of_parquet(label: &str, error: &ParquetError) -> TelemetryError {
    TelemetryError::new(label, Problem::Damaged(format!("no Parquet that can be read: {error}")))
}

/// # Errors
/// A sentence, for a column that has no number or text in each row.
fn check_column(column: &ColumnDescriptor) -> Result<(), String> {
    let name = column.path().string();
    if column.max_rep_level() > 0 || column.max_def_level() > 1 {
        return Err(format!("the column `{name}` has lists, not numbers"));
    }
    match column.physical_type() {
        PhysicalType::INT96 | PhysicalType::FIXED_LEN_BYTE_ARRAY => Err(format!(
            "the column `{name}` has {}, which is no number of telemetry: write it as a double",
            column.physical_type()
        )),
        _ => Ok(()),
    }
}

/// Times that count milliseconds, say, are times all the same.
fn scale_of(column: &ColumnDescriptor) -> Scale {
    let unit = match column.logical_type_ref() {
        Some(LogicalType::Timestamp(it) | LogicalType::Time(it)) => it.unit,
        _ => return Scale::Same,
    };
    Scale::PerSecond(match unit {
        TimeUnit::MILLIS => 1e3,
        TimeUnit::MICROS => 1e6,
        TimeUnit::NANOS => 1e9,
    })
}

fn read_cells(
    reader: &mut ColumnReader,
    scale: Scale,
    rows: usize,
    cells: &mut Vec<Cell>,
) -> ParquetResult<()> {
    let scaled = |number: f64| match scale {
        Scale::Same => Cell::of_number(number),
        Scale::PerSecond(count) => Cell::of_number(number / count),
    };
    match reader {
        ColumnReader::DoubleColumnReader(it) => read_as(it, rows, cells, |value| scaled(*value)),
        ColumnReader::FloatColumnReader(it) => {
            read_as(it, rows, cells, |value| scaled(f64::from(*value)))
        }
        ColumnReader::Int32ColumnReader(it) => {
            read_as(it, rows, cells, |value| scaled(f64::from(*value)))
        }
        ColumnReader::Int64ColumnReader(it) => {
            read_as(it, rows, cells, |value| scaled(*value as f64))
        }
        ColumnReader::BoolColumnReader(it) => {
            read_as(it, rows, cells, |value| Cell::Number(f64::from(u8::from(*value))))
        }
        ColumnReader::ByteArrayColumnReader(it) => {
            let of_text = |value: &ByteArray| {
                std::str::from_utf8(value.data())
                    .map_or(Cell::Damaged, |it| Cell::of_text(it.trim()))
            };
            read_as(it, rows, cells, of_text)
        }
        _ => Err(ParquetError::General("a column that has no numbers".into())),
    }
}

fn read_as<T: DataType>(
    reader: &mut ColumnReaderImpl<T>,
    rows: usize,
    cells: &mut Vec<Cell>,
    cell: impl Fn(&T::T) -> Cell,
) -> ParquetResult<()> {
    let (mut present, mut levels) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
    let mut read = 0;
    while read < rows {
        let (records, ..) =
            reader.read_records(rows - read, Some(&mut levels), None, &mut present)?;
        if records == 0 {
            return Err(ParquetError::EOF("a column ends too early".into()));
        }
        read += records;
    }
    // A column that is never empty has no levels.
    if levels.is_empty() {
        cells.extend(present.iter().map(cell));
        return Ok(());
    }
    let mut present = present.iter();
    let of_level =
        |level: i16| if level == 0 { Some(Cell::Gap) } else { present.next().map(&cell) };
    cells.extend(levels.into_iter().map_while(of_level));
    if cells.len() < rows {
        return Err(ParquetError::EOF("a column has fewer numbers than it says".into()));
    }
    Ok(())
}
