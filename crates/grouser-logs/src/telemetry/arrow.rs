//! Telemetry of Arrow: files (Feather 2) and streams, read batch by batch, and handed on as the CSV
//! that they are otherwise. Source: Arrow, *Columnar Format*.
//!
//! A file is a stream between two magic words, with a table of contents behind it, which is not
//! needed: its messages are read in their order.

mod cell;
mod column;
mod flatbuffer;

use std::io::{self, Read};

use self::cell::{damage, quoted};
use self::column::ArrowColumn;
use self::flatbuffer::FlatTable;

/// How a file begins, with what fills it up to eight bytes.
pub(super) const MAGIC: &[u8] = b"ARROW1";
const BEGINNING: u64 = 8;
/// What each message begins with.
pub(super) const CONTINUATION: &[u8] = &[0xff; 4];
/// No message has a larger description, and no batch more bytes, however often it says so.
const LARGEST_ABOUT: u64 = 16 << 20;
const LARGEST_BATCH: u64 = 1 << 30;
/// So many rows are written at a time.
const ROWS: usize = 1024;

/// Kinds of messages.
const SCHEMA: u8 = 1;
const BATCH: u8 = 3;

/// A table of Arrow, as CSV.
pub(super) struct ArrowText<R> {
    source: R,
    columns: Vec<ArrowColumn>,
    /// What is written and not read yet, from a place on.
    text: Vec<u8>,
    at: usize,
    /// Rows of the batch, and the next of them.
    rows: usize,
    next: usize,
}

impl<R: Read> ArrowText<R> {
    /// Reads the names and types of the columns.
    ///
    /// * `is_file`: whether it begins with [`MAGIC`], which is not read yet
    ///
    /// # Errors
    /// Those of the source, and of what is no Arrow of columns with one value in each row.
    pub(super) fn new(mut source: R, is_file: bool) -> io::Result<Self> {
        if is_file {
            exactly(&mut source, BEGINNING, BEGINNING)?;
        }
        let message = ArrowMessage::read(&mut source)?;
        let message = message.ok_or_else(|| damage("it has no description of its columns"))?;
        let columns = message.columns()?;
        let names: Vec<String> = columns.iter().map(|it| quoted(&it.name)).collect();
        let text = format!("{}\n", names.join(",")).into_bytes();
        Ok(Self { source, columns, text, at: 0, rows: 0, next: 0 })
    }

    /// Writes the next rows; whether there are any.
    fn fill(&mut self) -> io::Result<bool> {
        while self.next >= self.rows {
            let Some(message) = ArrowMessage::read(&mut self.source)? else { return Ok(false) };
            if message.kind == BATCH {
                self.rows = message.take_batch(&mut self.columns)?;
                self.next = 0;
            }
        }
        self.text.clear();
        self.at = 0;
        let until = self.rows.min(self.next.saturating_add(ROWS));
        for row in self.next..until {
            for (place, column) in self.columns.iter().enumerate() {
                if place > 0 {
                    self.text.push(b',');
                }
                column.write(row, &mut self.text)?;
            }
            self.text.push(b'\n');
        }
        self.next = until;
        Ok(true)
    }
}

impl<R: Read> Read for ArrowText<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.at >= self.text.len() && !self.fill()? {
            return Ok(0);
        }
        let rest = &self.text[self.at..];
        let count = rest.len().min(buffer.len());
        buffer[..count].copy_from_slice(&rest[..count]);
        self.at += count;
        Ok(count)
    }
}

/// A message, with its body.
struct ArrowMessage {
    kind: u8,
    about: Vec<u8>,
    body: Vec<u8>,
}

impl ArrowMessage {
    /// The next message; nothing at the end.
    fn read(source: &mut impl Read) -> io::Result<Option<Self>> {
        let Some(mut length) = word(source)? else { return Ok(None) };
        // Before version 0.15 messages began with their length.
        if length.to_le_bytes() == CONTINUATION {
            match word(source)? {
                Some(it) => length = it,
                None => return Ok(None),
            }
        }
        if length == 0 {
            return Ok(None);
        }
        let about = exactly(source, u64::from(length), LARGEST_ABOUT)?;
        let table = FlatTable::root(&about).ok_or_else(|| damage("a message has no contents"))?;
        let kind = table.byte(1).unwrap_or(0);
        let size = u64::try_from(table.long(3).unwrap_or(0));
        let size = size.map_err(|_| damage("a message is shorter than nothing"))?;
        let body = exactly(source, size, LARGEST_BATCH)?;
        Ok(Some(Self { kind, about, body }))
    }

    /// What the message has.
    fn contents(&self) -> Option<FlatTable<'_>> {
        FlatTable::root(&self.about)?.table(2)
    }

    fn columns(&self) -> io::Result<Vec<ArrowColumn>> {
        let schema = self.contents().filter(|_| self.kind == SCHEMA);
        let schema = schema.ok_or_else(|| damage("it has no description of its columns"))?;
        if schema.short(0).unwrap_or(0) != 0 {
            return Err(damage("its numbers have their largest byte first"));
        }
        let fields = schema.tables(1).unwrap_or_default();
        let column = |field: &FlatTable<'_>| {
            let name = field.text(0).unwrap_or_default();
            ArrowColumn::of(field).ok_or_else(|| {
                damage(&format!("the column `{name}` is of a type that is not known"))
            })
        };
        fields.iter().map(column).collect()
    }

    /// Gives the columns their part of a batch; how many rows it has.
    fn take_batch(&self, columns: &mut [ArrowColumn]) -> io::Result<usize> {
        let short = || damage("a batch is shorter than it says");
        let batch = self.contents().ok_or_else(short)?;
        let rows = usize::try_from(batch.long(0).unwrap_or(0)).map_err(|_| short())?;
        let codec = batch.table(3).map(|it| it.byte(0).unwrap_or(0));
        let buffers = batch.pairs(2).unwrap_or_default();
        let part = |[offset, length]: [i64; 2]| {
            let start = usize::try_from(offset).ok()?;
            self.body.get(start..start.checked_add(usize::try_from(length).ok()?)?)
        };
        let mut next = buffers.into_iter();
        for column in columns {
            let parts = next.by_ref().take(column.buffers).map(part).collect::<Option<Vec<_>>>();
            let parts = parts.filter(|it| it.len() == column.buffers).ok_or_else(short)?;
            column.take(&parts, codec, rows)?;
        }
        Ok(rows)
    }
}

/// A length; nothing at the end of the source.
fn word(source: &mut impl Read) -> io::Result<Option<u32>> {
    let bytes = upto(source, 4)?;
    Ok(bytes.try_into().ok().map(u32::from_le_bytes))
}

/// So many bytes.
fn exactly(source: &mut impl Read, count: u64, most: u64) -> io::Result<Vec<u8>> {
    if count > most {
        return Err(damage(&format!("a part has {count} bytes, {most} are the most")));
    }
    let bytes = upto(source, count)?;
    if bytes.len() as u64 == count { Ok(bytes) } else { Err(damage("it ends in a message")) }
}

/// So many bytes, or those that there are.
fn upto(source: &mut impl Read, count: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.take(count).read_to_end(&mut bytes)?;
    Ok(bytes)
}
