//! CSV as it comes: line ends of every kind, and fields that are parted by something else.

use std::io::{self, Read};

/// A reader of a table whose fields are trimmed.
pub(in crate::document) fn reader<R: Read>(source: R, delimiter: u8) -> csv::Reader<LineEnds<R>> {
    let mut builder = csv::ReaderBuilder::new();
    builder.delimiter(delimiter).trim(csv::Trim::All);
    builder.from_reader(LineEnds::of(source))
}

/// Reads the next row, if there is one; its position is that of its own first line.
///
/// The library tells where it stood before it passed empty lines and the `\n` of `\r\n`, which
/// spreadsheets write. Here it is asked where it stands behind the row.
pub(in crate::document) fn next_row<R: Read>(
    reader: &mut csv::Reader<LineEnds<R>>,
    row: &mut csv::StringRecord,
) -> Result<bool, csv::Error> {
    if !reader.read_record(row)? {
        return Ok(false);
    }
    let inside: usize = row.iter().map(|field| field.matches('\n').count()).sum();
    let mut position = reader.position().clone();
    let line = position.line().saturating_sub(1 + inside as u64);
    position.set_line(line);
    row.set_position(Some(position));
    Ok(true)
}

/// A text with every line end, the last one too, as a line feed.
pub(in crate::document) struct LineEnds<R> {
    source: R,
    after_return: bool,
    in_line: bool,
}

impl<R> LineEnds<R> {
    pub(in crate::document) fn of(source: R) -> Self {
        Self { source, after_return: false, in_line: false }
    }
}

impl<R: Read> Read for LineEnds<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if buffer.is_empty() {
            return Ok(0);
        }
        loop {
            let count = self.source.read(buffer)?;
            if count == 0 {
                // The last line ends, too.
                buffer[0] = b'\n';
                return Ok(usize::from(std::mem::take(&mut self.in_line)));
            }
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
                return Ok(kept);
            }
        }
    }
}

/// What parts the fields of a header that was read as a single one: the character, and how
/// `--delimiter` calls it.
pub(in crate::document) fn other_delimiter(header: &[String]) -> Option<(char, &'static str)> {
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
                LineEnds::of(source).read_to_string(&mut found).unwrap();
                assert_eq!(found, expected, "{text:?}");
            }
        }
    }

    #[test]
    fn a_row_has_the_line_in_which_it_stands() {
        for end in ["\n", "\r\n", "\r"] {
            for last in ["", end] {
                let text = ["a,b", "1,2", "", "\"x", "y\",4", "5,6"].join(end) + last;
                let mut reader = reader(text.as_bytes(), b',');
                let (mut row, mut lines) = (csv::StringRecord::new(), Vec::new());
                while next_row(&mut reader, &mut row).unwrap() {
                    lines.push(row.position().map(csv::Position::line));
                }
                assert_eq!(lines, [Some(2), Some(4), Some(6)], "{end:?}");
            }
        }
    }
}
