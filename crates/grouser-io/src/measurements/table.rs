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

    fn check_cells(&self, row: &StringRecord, line: u64) -> Result<(), MeasurementError> {
        match row.iter().map(str::len).find(|length| *length > Limits::LONGEST_CELL) {
            None => Ok(()),
            Some(length) => {
                Err(self.too_large(line, Excess::Cell { length, most: Limits::LONGEST_CELL }))
            }
        }
    }

    fn too_large(&self, line: u64, excess: Excess) -> MeasurementError {
        MeasurementError::at(&self.label, line, MeasurementProblem::TooLarge(excess))
    }
}

/// A text with every line end, the last one too, as a line feed, and of limited length.
pub struct LineEnds<R> {
    source: R,
    after_return: bool,
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
            let count = self.source.read(buffer)?;
            if count == 0 {
                // The last line ends, too.
                buffer[0] = b'\n';
                return Ok(usize::from(std::mem::take(&mut self.in_line)));
            }
            self.read += count as u64;
            self.check()?;
            let mut kept = 0;
            for place in 0..count {
                let byte = buffer[place];
                let is_second = byte == b'\n' && self.after_return;
                self.after_return = byte == b'\r';
                if !is_second {
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

/// What parts the fields of a header that was read as a single one: the character, and how
/// `--delimiter` calls it.
#[must_use]
pub fn other_delimiter(header: &[String]) -> Option<(char, &'static str)> {
    let [only] = header else { return None };
    [(';', "';'"), ('\t', "tab")].into_iter().find(|(character, _)| only.contains(*character))
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
