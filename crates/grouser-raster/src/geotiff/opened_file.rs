//! A file that was opened, as the decoder reads it.

use std::fs::File;
use std::io::{self, Read as _, Seek as _, SeekFrom};
use std::sync::{Mutex, PoisonError};

use tiff_reader::TiffError;
use tiff_reader::source::TiffSource;

use crate::MapPath;

/// A file that was opened, for the decoder.
pub(super) struct OpenedFile {
    file: Mutex<File>,
    pub(super) length: u64,
    name: String,
}

impl OpenedFile {
    pub(super) fn of(path: MapPath<'_>) -> io::Result<Self> {
        let file = path.opened()?;
        let length = file.metadata()?.len();
        Ok(Self { file: Mutex::new(file), length, name: path.path.display().to_string() })
    }
}

impl TiffSource for OpenedFile {
    fn len(&self) -> u64 {
        self.length
    }

    fn read_exact_at(&self, offset: u64, len: usize) -> Result<Vec<u8>, TiffError> {
        let (length, data_len) = (len as u64, self.length);
        if offset.checked_add(length).is_none_or(|end| end > data_len) {
            return Err(TiffError::OffsetOutOfBounds { offset, length, data_len });
        }
        let mut bytes = vec![0; len];
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let read = file.seek(SeekFrom::Start(offset)).and_then(|_| file.read_exact(&mut bytes));
        read.map_err(|error| TiffError::Io(error, self.name.clone()))?;
        Ok(bytes)
    }
}
