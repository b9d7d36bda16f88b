//! The path of a file, and how it and the files beside it are opened.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

/// The path of a file, and how it and the files beside it are opened.
///
/// A path alone is opened as the system does. Who reads files of one folder only opens them so that
/// no link leads out of it.
///
/// ```
/// use std::io;
/// use std::path::Path;
///
/// use grouser_raster::{MapPath, ReadOptions};
///
/// let path = Path::new("hills.tif");
/// let refused = |_: &Path| Err(io::ErrorKind::PermissionDenied.into());
/// let read = grouser_raster::read(MapPath { path, open: &refused }, &ReadOptions::default());
/// assert!(read.is_err());
/// ```
#[derive(Clone, Copy)]
pub struct MapPath<'p> {
    /// The path.
    pub path: &'p Path,
    /// Opens it, and those beside it.
    pub open: &'p dyn Fn(&Path) -> io::Result<File>,
}

impl<'p> From<&'p Path> for MapPath<'p> {
    fn from(path: &'p Path) -> Self {
        Self { path, open: &|path: &Path| File::open(path) }
    }
}

impl<'p> From<&'p PathBuf> for MapPath<'p> {
    fn from(path: &'p PathBuf) -> Self {
        path.as_path().into()
    }
}

impl MapPath<'_> {
    /// The file, opened.
    pub(crate) fn opened(self) -> io::Result<File> {
        (self.open)(self.path)
    }
}
