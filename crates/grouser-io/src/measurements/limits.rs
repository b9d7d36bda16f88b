//! Limits on the size of tables, so that neither a wrong file nor an endless pipe fills the memory.

/// How many rows of a file are read, and from that how many bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// The most rows; it can be raised.
    pub rows: usize,
}

impl Limits {
    /// Rows that are read where nobody asks for more: a test stand makes thousands.
    pub const ROWS: usize = 1_000_000;
    /// Bytes of a row, averaged over the file. The rows of test stands have about 150.
    pub const BYTES_PER_ROW: u64 = 256;
    /// Files up to this size are read however few rows are allowed [bytes].
    pub const SMALL_FILE: u64 = 1 << 20;
    /// Bytes of a single row.
    pub const LONGEST_ROW: u64 = 1 << 20;
    /// Cells of a row.
    pub const CELLS: usize = 1000;
    /// Bytes of a cell.
    pub const LONGEST_CELL: usize = 10_000;

    /// Cells that are kept of a table of texts: eight for each row.
    #[must_use]
    pub const fn cells(self) -> usize {
        self.rows.saturating_mul(8)
    }

    /// The most bytes of a file.
    #[must_use]
    pub const fn bytes(self) -> u64 {
        let bytes = (self.rows as u64).saturating_mul(Self::BYTES_PER_ROW);
        if bytes > Self::SMALL_FILE { bytes } else { Self::SMALL_FILE }
    }
}

impl Default for Limits {
    fn default() -> Self {
        Self { rows: Self::ROWS }
    }
}

/// What is larger than it may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Excess {
    /// The whole file.
    #[error(
        "is larger than {most} bytes, the most that is read: split the file, or raise the limit of \
         rows"
    )]
    Bytes {
        /// The most.
        most: u64,
    },
    /// Its rows.
    #[error(
        "has more than {most} rows, the most that are read: split the file, or raise the limit"
    )]
    Rows {
        /// The most.
        most: usize,
    },
    /// The cells of all its rows.
    #[error(
        "has more than {most} cells, the most that are read: split the file, or raise the limit"
    )]
    AllCells {
        /// The most.
        most: usize,
    },
    /// The length of a row.
    #[error("this row is longer than {most} bytes: is a quotation mark left open?")]
    Row {
        /// The most.
        most: u64,
    },
    /// The cells of a row.
    #[error("has {count} columns, it must have at most {most}")]
    Cells {
        /// How many there are.
        count: usize,
        /// The most.
        most: usize,
    },
    /// The length of a cell.
    #[error("this row has a cell of {length} bytes, the most is {most}")]
    Cell {
        /// How long it is.
        length: usize,
        /// The most.
        most: usize,
    },
}

impl Excess {
    /// Whether a higher [`Limits::rows`] admits it.
    #[must_use]
    pub fn can_be_raised(self) -> bool {
        matches!(self, Self::Bytes { .. } | Self::Rows { .. } | Self::AllCells { .. })
    }
}
