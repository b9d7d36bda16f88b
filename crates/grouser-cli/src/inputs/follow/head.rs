//! The lines of a table before its rows.

/// Comments and the line of the columns, of a file and of those that take its place.
#[derive(Debug, Default)]
pub(super) struct TableHead {
    /// Of the first file, as far as it was read.
    first: Vec<u8>,
    /// Of another, as far as it was read.
    other: Option<Vec<u8>>,
}

/// A head has no more bytes. Source: ours.
const LONGEST: usize = 1 << 16;

impl TableHead {
    /// Another file begins, which has the same head.
    pub(super) fn begin_another(&mut self) {
        self.other = Some(Vec::new());
    }

    /// Takes bytes of a file, and gives those that are to be read: all of the first file, and rows
    /// of another.
    pub(super) fn take(&mut self, bytes: &[u8]) -> Result<Vec<u8>, &'static str> {
        let Some(other) = &mut self.other else {
            if end(&self.first).is_none() && self.first.len() < LONGEST {
                self.first.extend(bytes);
                let whole = end(&self.first).unwrap_or(self.first.len());
                self.first.truncate(whole);
            }
            return Ok(bytes.to_vec());
        };
        other.extend(bytes);
        let columns = |head: &[u8]| {
            head.trim_ascii_end().rsplit(|it| *it == b'\n').next().map(<[u8]>::to_vec)
        };
        match end(other) {
            Some(end) if columns(&other[..end]) == columns(&self.first) => {
                let rows = other.split_off(end);
                self.other = None;
                Ok(rows)
            }
            None if other.len() < LONGEST => Ok(Vec::new()),
            _ => Err("the file that took its place has other columns"),
        }
    }
}

/// Where the line of the columns ends, if it does.
fn end(bytes: &[u8]) -> Option<usize> {
    let mut end = 0;
    for line in bytes.split_inclusive(|byte| *byte == b'\n') {
        end += line.len();
        let text = line.trim_ascii();
        if line.ends_with(b"\n") && !text.is_empty() && !text.starts_with(b"#") {
            return Some(end);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// However bytes come, the rows of another file follow those of the first.
    #[test]
    fn heads_of_other_files_are_left_out() {
        let (first, other) = (b"# day 1\na,b\n1,2\n", b"# day 2\n\na,b\n3,4\n");
        for size in 1..20 {
            let mut head = TableHead::default();
            let mut read = Vec::new();
            for part in first.chunks(size) {
                read.extend(head.take(part).unwrap());
            }
            head.begin_another();
            for part in other.chunks(size) {
                read.extend(head.take(part).unwrap());
            }
            assert_eq!(read, b"# day 1\na,b\n1,2\n3,4\n");
        }
    }

    #[test]
    fn other_columns_are_refused() {
        let mut head = TableHead::default();
        head.take(b"a,b\n1,2\n").unwrap();
        head.begin_another();
        assert!(head.take(b"a,c\n").is_err());
    }
}
