//! What can go wrong with a map's files.

use std::io;
use std::path::{Path, PathBuf};

/// A file of a map that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("{}: {fault}", file.display())]
pub struct MapError {
    /// The file.
    pub file: PathBuf,
    #[source]
    fault: Fault,
}

#[derive(Debug, thiserror::Error)]
pub(crate) enum Fault {
    #[error("cannot be written: {0}")]
    Disk(#[from] io::Error),
    /// What the encoder says.
    #[error("cannot be encoded: {0}")]
    Encoder(geotiff_writer::Error),
    #[error("{cells} cells in a row or column are more than a GeoTIFF can have")]
    TooLarge { cells: usize },
}

impl From<geotiff_writer::Error> for Fault {
    fn from(error: geotiff_writer::Error) -> Self {
        match error {
            geotiff_writer::Error::Io(error) => Self::Disk(error),
            error => Self::Encoder(error),
        }
    }
}

impl MapError {
    pub(crate) fn new(file: &Path, fault: Fault) -> Self {
        Self { file: file.to_owned(), fault }
    }
}
