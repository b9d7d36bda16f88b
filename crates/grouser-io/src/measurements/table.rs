//! CSV as it comes: line ends of every kind, and fields that are parted by something else.

use std::borrow::Cow;
use std::io::{self, Read};

use csv::StringRecord;

use super::error::{MeasurementError, MeasurementProblem};
use super::limits::{Excess, Limits};

/// A table read row by row, its fields trimmed, within limits.
pub struct Table<'a, R> {
    label: Cow<'a, str>,
    reader: csv::Reader<LineEnds<R>>,
    limits: Limits,
    rows: usize,
}

impl<'a, R: Read> Table<'a, R> {
    /// * `label`: what messages call the source
    pub fn new(label: impl Into<Cow<'a, str>>, source: R, delimiter: u8, limits: Limits) -> Self {
        let mut builder = csv::ReaderBuilder::new();
        builder.delimiter(delimiter).trim(csv::Trim::All);
        let source = LineEnds { longest_row: Limits::LONGEST_ROW, ..LineEnds::of(source, limits) };
        Self { label: label.into(), reader: builder.from_reader(source), limits, rows: 0 }
    }

    /// The names of the columns.
    ///
    /// # Errors
    /// [`MeasurementError`] for a file that cannot be read, is empty, or is larger than its limits.
    pub fn header(&mut self) -> Result<StringRecord, MeasurementError> {
        let found = self.reader.headers().cloned();
        let header = found.map_err(|error| MeasurementError::csv(&self.label, &error, 1))?;
        if header.len() > Limits::CELLS {
            return Err(
                self.too_large(1, Excess::Cells { count: header.len(), most: Limits::CELLS })
            );
        }
        self.check_cells(&header, 1)?;
        Ok(header)
    }

    /// Reads the next row, if there is one; its position is that of its own first line.
    ///
    /// The library says where it stood before it passed empty lines and the `\n` of `\r\n`, which
    /// spreadsheets write. Here it is asked where it stands behind the row.
    ///
    /// # Errors
    /// [`MeasurementError`] with the line, for a row that cannot be read or is larger than its
    /// limits.
    pub fn next_row(&mut self, row: &mut StringRecord) -> Result<bool, MeasurementError> {
        let start = self.reader.position().clone();
        self.reader.get_mut().row_starts_at(start.byte());
        let found = self.reader.read_record(row);
        if !found.map_err(|error| MeasurementError::csv(&self.label, &error, start.line()))? {
            return Ok(false);
        }
        let inside: usize = row.iter().map(|field| field.matches('\n').count()).sum();
        let mut position = self.reader.position().clone();
        let line = position.line().saturating_sub(1 + inside as u64);
        position.set_line(line);
        row.set_position(Some(position));
        self.check_cells(row, line)?;
        self.rows += 1;
        if self.rows > self.limits.rows {
            return Err(self.too_large(line, Excess::Rows { most: self.limits.rows }));
        }
        Ok(true)
    }

    /// How many rows were read so far.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.rows as u64
    }

    fn check_cells(&self, row: &StringRecord, line: u64) -> Result<(), MeasurementError> {
        match row.iter().map(str::len).find(|length| *length > Limits::LONGEST_CELL) {
            None => Ok(()),
            Some(length) => {
                Err(self.too_large(line, Excess::Cell { length, most: Limits::LONGEST_CELL }))
            }
        }
    }

    fn too_large(&self, line: u64, excess: Excess) -> MeasurementError {
        self.failed(line, MeasurementProblem::TooLarge(excess))
    }

    /// An error in a line of it.
    #[must_use]
    pub fn failed(&self, line: u64, problem: MeasurementProblem) -> MeasurementError {
        MeasurementError::at(&self.label, line, problem)
    }
}

/// How the fields of a table are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dialect {
    /// What parts fields.
    pub delimiter: u8,
    /// Whether decimals may be written with a comma, which then parts no fields.
    pub has_decimal_commas: bool,
}

/// A source whose first lines were looked at.
pub type LookedAt<R> = io::Chain<io::Cursor<Vec<u8>>, R>;

impl<'a, R: Read> Table<'a, LookedAt<R>> {
    /// A table of which nobody says how it is written: its header does. Lines that begin with `#`
    /// are comments; where all lines of words do, the last of them is the header.
    ///
    /// * `label`: what messages call the source
    ///
    /// # Errors
    /// [`MeasurementError`] where reading fails.
    pub fn of_any_dialect(
        label: impl Into<Cow<'a, str>>,
        mut source: R,
        limits: Limits,
    ) -> Result<(Self, Dialect), MeasurementError> {
        let label = label.into();
        let start = first_lines(&mut source);
        let mut start = start.map_err(|error| MeasurementError::io(&label, &error, 1))?;
        let dialect = dialect_of(&mut start);
        let mut builder = csv::ReaderBuilder::new();
        builder.delimiter(dialect.delimiter).trim(csv::Trim::All).comment(Some(b'#'));
        let source = LineEnds::of(io::Cursor::new(start).chain(source), limits);
        let spaces = (dialect.delimiter == b' ').then_some(false);
        let source = LineEnds { longest_row: Limits::LONGEST_ROW, spaces, ..source };
        Ok((Self { label, reader: builder.from_reader(source), limits, rows: 0 }, dialect))
    }
}

/// The start of a source, up to the end of the first line that is no comment.
fn first_lines(source: &mut impl Read) -> io::Result<Vec<u8>> {
    /// So much of a source is looked at, at most [bytes].
    const MOST: usize = 1 << 16;
    let mut start = Vec::new();
    let has_line = |start: &[u8]| {
        let ended = start.iter().rposition(|byte| is_line_end(*byte)).unwrap_or(0);
        lines_of(&start[..ended]).any(|line| !is_comment(line))
    };
    while start.len() < MOST && !has_line(&start) {
        let before = start.len();
        start.resize(before + 4096, 0);
        let read = source.read(&mut start[before..])?;
        start.truncate(before + read);
        if read == 0 {
            break;
        }
    }
    Ok(start)
}

/// How a table is written that begins so; a header behind a `#` becomes one without.
fn dialect_of(start: &mut [u8]) -> Dialect {
    let mut comment = None;
    let mut header: &[u8] = &[];
    for line in lines_of(start) {
        if !is_comment(line) {
            header = line;
            break;
        }
        if line.contains(&b'#') {
            comment = Some(line);
        }
    }
    let is_word = |byte: &u8| byte.is_ascii_alphabetic() && !b"TZe".contains(byte);
    let is_numbers = !header.iter().any(is_word);
    // Of numbers with decimal commas only words tell what parts them.
    let words = comment.filter(|_| is_numbers);
    let parted = |delimiter: u8| header.contains(&delimiter);
    let by_words = words.map(delimiter_of).filter(|delimiter| parted(*delimiter));
    let delimiter = by_words.unwrap_or_else(|| delimiter_of(header));
    let cells = |line: &[u8]| {
        let line = line.trim_ascii_start().strip_prefix(b"#").unwrap_or(line).trim_ascii();
        let cells = line.split(|byte| *byte == delimiter);
        cells.filter(|cell| delimiter != b' ' || !cell.is_empty()).count()
    };
    let behind = words.filter(|line| cells(line) == cells(header));
    let mark = behind.and_then(|line| {
        let offset = line.as_ptr() as usize - start.as_ptr() as usize;
        Some(offset + line.iter().position(|byte| *byte == b'#')?)
    });
    if let Some(mark) = mark {
        start[mark] = b' ';
    }
    Dialect { delimiter, has_decimal_commas: delimiter != b',' }
}

/// What parts the fields of a header.
fn delimiter_of(header: &[u8]) -> u8 {
    let header = header.trim_ascii();
    let count = |delimiter: u8| header.split(|byte| *byte == delimiter).count();
    let others = [b';', b'\t', b'|'].into_iter().max_by_key(|it| count(*it)).unwrap_or(b';');
    if count(others) > count(b',') {
        others
    } else if count(b',') == 1 && header.contains(&b' ') {
        // Only where nothing else parts fields: names may have spaces.
        b' '
    } else {
        b','
    }
}

fn is_line_end(byte: u8) -> bool {
    matches!(byte, b'\n' | b'\r')
}

fn lines_of(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split(|byte| is_line_end(*byte))
}

/// Whether a line has nothing, or begins with `#`.
fn is_comment(line: &[u8]) -> bool {
    let line = line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(line).trim_ascii_start();
    line.first().is_none_or(|byte| *byte == b'#')
}

/// A text with every line end, the last one too, as a line feed, and of limited length.
pub struct LineEnds<R> {
    source: R,
    after_return: bool,
    /// Where spaces in a row are one, and those at the ends of a line none: whether one stands
    /// before the next byte, if the line goes on.
    spaces: Option<bool>,
    in_line: bool,
    /// Bytes that were read from the source, and that were passed on.
    read: u64,
    passed: u64,
    most: u64,
    /// Where the row started that is being read, among the bytes passed on.
    row_start: u64,
    longest_row: u64,
}

impl<R> LineEnds<R> {
    pub(crate) fn of(source: R, limits: Limits) -> Self {
        Self {
            source,
            after_return: false,
            spaces: None,
            in_line: false,
            read: 0,
            passed: 0,
            most: limits.bytes(),
            row_start: 0,
            longest_row: u64::MAX,
        }
    }

    fn row_starts_at(&mut self, byte: u64) {
        self.row_start = byte;
    }

    fn check(&self) -> io::Result<()> {
        if self.read > self.most {
            return Err(io::Error::other(Excess::Bytes { most: self.most }));
        }
        // The reader asks for more only where the row it reads has not ended.
        if self.passed - self.row_start.min(self.passed) > self.longest_row {
            return Err(io::Error::other(Excess::Row { most: self.longest_row }));
        }
        Ok(())
    }
}

impl<R: Read> Read for LineEnds<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if buffer.is_empty() {
            return Ok(0);
        }
        self.check()?;
        loop {
            let start = usize::from(self.spaces == Some(true));
            let count = self.source.read(&mut buffer[start..])?;
            if count == 0 {
                // The last line ends, too.
                buffer[0] = b'\n';
                return Ok(usize::from(std::mem::take(&mut self.in_line)));
            }
            self.read += count as u64;
            self.check()?;
            let mut kept = 0;
            for place in start..start + count {
                let byte = buffer[place];
                let is_second = byte == b'\n' && self.after_return;
                self.after_return = byte == b'\r';
                if self.spaces.is_some() && byte == b' ' {
                    self.spaces = Some(self.in_line);
                } else if !is_second {
                    let spaces = self.spaces.map(|_| false);
                    let before = std::mem::replace(&mut self.spaces, spaces);
                    if before == Some(true) && !is_line_end(byte) {
                        buffer[kept] = b' ';
                        kept += 1;
                    }
                    buffer[kept] = if self.after_return { b'\n' } else { byte };
                    self.in_line = buffer[kept] != b'\n';
                    kept += 1;
                }
            }
            // Nothing kept of something read is not the end.
            if kept > 0 {
                self.passed += kept as u64;
                return Ok(kept);
            }
        }
    }
}

/// What parts the fields of a header that was read as a single one, as `--delimiter` calls it.
#[must_use]
pub fn other_delimiter(header: &[String]) -> Option<&'static str> {
    let [only] = header else { return None };
    let others = [(';', "';'"), ('\t', "tab"), ('|', "'|'"), (' ', "' '")];
    others.into_iter().find(|(it, _)| only.contains(*it)).map(|(_, name)| name)
}

/// What to do about such a header, where a reader takes commas alone.
#[must_use]
pub fn delimiter_hint(header: &[String]) -> Option<String> {
    let found = other_delimiter(header)?;
    Some(format!(
        "part the fields with commas in place of {found}, and write decimals with a point"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gives its bytes one at a time.
    struct Slowly<'a>(&'a [u8]);

    impl Read for Slowly<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let count = self.0.len().min(buffer.len()).min(1);
            buffer[..count].copy_from_slice(&self.0[..count]);
            self.0 = &self.0[count..];
            Ok(count)
        }
    }

    #[test]
    fn every_line_end_becomes_a_line_feed() {
        for (text, expected) in [
            ("a\r\nb\r\n", "a\nb\n"),
            ("a\rb\r", "a\nb\n"),
            ("a\n\r\r\n\nb", "a\n\n\n\nb\n"),
            ("", ""),
        ] {
            for slow in [false, true] {
                let mut found = String::new();
                let source: Box<dyn Read> = if slow {
                    Box::new(Slowly(text.as_bytes()))
                } else {
                    Box::new(text.as_bytes())
                };
                LineEnds::of(source, Limits::default()).read_to_string(&mut found).unwrap();
                assert_eq!(found, expected, "{text:?}");
            }
        }
    }

    #[test]
    fn a_header_says_how_a_table_is_written() {
        for (text, delimiter, names) in [
            ("a,b\n1,2\n", b',', ["a", "b"]),
            ("a;b\r\n1,5;2\r\n", b';', ["a", "b"]),
            ("# of a drive, in sand\n\na\tb\n1\t2\n", b'\t', ["a", "b"]),
            ("# a,b\n1,2\n", b',', ["a", "b"]),
            ("# of a drive\n# a;b\n1,5;2e-3\n", b';', ["a", "b"]),
            ("a | b\n1 | 2\n", b'|', ["a", "b"]),
            ("  a   b\r\n  1  2 \r\n", b' ', ["a", "b"]),
            ("# a b\n1.0 2.0\n", b' ', ["a", "b"]),
            ("\u{feff}a;b", b';', ["a", "b"]),
        ] {
            for slow in [false, true] {
                let source: Box<dyn Read> = if slow {
                    Box::new(Slowly(text.as_bytes()))
                } else {
                    Box::new(text.as_bytes())
                };
                let opened = Table::of_any_dialect("a.csv", source, Limits::default());
                let (mut table, dialect) = opened.unwrap();
                assert_eq!(dialect.delimiter, delimiter, "{text:?}");
                let header = table.header().unwrap();
                assert_eq!(header.iter().collect::<Vec<_>>(), names, "{text:?}");
                let mut row = StringRecord::new();
                assert_eq!(table.next_row(&mut row).unwrap(), text.contains('1'), "{text:?}");
            }
        }
    }

    #[test]
    fn a_row_has_the_line_in_which_it_stands() {
        for end in ["\n", "\r\n", "\r"] {
            for last in ["", end] {
                let text = ["a,b", "1,2", "", "\"x", "y\",4", "5,6"].join(end) + last;
                let mut table = Table::new("a.csv", text.as_bytes(), b',', Limits::default());
                let (mut row, mut lines) = (StringRecord::new(), Vec::new());
                while table.next_row(&mut row).unwrap() {
                    lines.push(row.position().map(csv::Position::line));
                }
                assert_eq!(lines, [Some(2), Some(4), Some(6)], "{end:?}");
            }
        }
    }

    /// What is refused of a table, and in which line.
    fn refusal(source: impl Read, rows: usize) -> (Option<u64>, MeasurementProblem) {
        let mut table = Table::new("a.csv", source, b',', Limits { rows });
        let mut row = StringRecord::new();
        let error = loop {
            match table.header().and_then(|_| table.next_row(&mut row)) {
                Ok(true) => {}
                Ok(false) => panic!("nothing was refused"),
                Err(error) => break error,
            }
        };
        (error.line(), error.problem().clone())
    }

    #[test]
    fn what_is_too_large_is_refused_before_it_fills_the_memory() {
        let endless = || io::repeat(b'1');
        let row = Excess::Row { most: Limits::LONGEST_ROW };
        assert_eq!(refusal(endless(), 10_000), (Some(1), MeasurementProblem::TooLarge(row)));
        let open_quote = b"a,b\n1,\"".chain(endless());
        assert_eq!(refusal(open_quote, 10_000), (Some(2), MeasurementProblem::TooLarge(row)));
        let bytes = Excess::Bytes { most: Limits::SMALL_FILE };
        assert_eq!(refusal(&*"a\n".repeat(1 << 20).into_bytes(), 1), {
            (Some(3), MeasurementProblem::TooLarge(Excess::Rows { most: 1 }))
        });
        // Empty lines are no rows: only the size ends them.
        let found = refusal(b"a\n".chain(io::repeat(b'\n')), 1);
        assert_eq!(found.1, MeasurementProblem::TooLarge(bytes));
        let wide = vec!["a"; Limits::CELLS + 1].join(",");
        let cells = Excess::Cells { count: Limits::CELLS + 1, most: Limits::CELLS };
        assert_eq!(refusal(wide.as_bytes(), 9), (Some(1), MeasurementProblem::TooLarge(cells)));
        let long = "x".repeat(Limits::LONGEST_CELL + 1);
        let cell = Excess::Cell { length: long.len(), most: Limits::LONGEST_CELL };
        let text = format!("a\n1\n{long}\n");
        assert_eq!(refusal(text.as_bytes(), 9), (Some(3), MeasurementProblem::TooLarge(cell)));
    }
}
