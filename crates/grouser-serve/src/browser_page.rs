//! The file that a browser is opened with.

use std::io::{self, Write as _};
use std::path::Path;

use tempfile::NamedTempFile;

/// A page in a file that leads a browser to the console. Command lines can be read by all users of a
/// machine, so that the address with its token stands on none: this file only its user can read. It
/// is there until this is dropped.
#[derive(Debug)]
pub struct BrowserPage(NamedTempFile);

impl BrowserPage {
    pub(crate) fn of(url: &str) -> io::Result<Self> {
        let mut file = tempfile::Builder::new().prefix("grouser-").suffix(".html").tempfile()?;
        write!(
            file,
            "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n\
             <meta name=\"referrer\" content=\"no-referrer\">\n\
             <meta http-equiv=\"refresh\" content=\"0; url={url}\">\n\
             <title>Grouser</title>\n<a href=\"{url}\">The console of Grouser</a>\n"
        )?;
        Ok(Self(file))
    }

    /// The file.
    #[must_use]
    pub fn path(&self) -> &Path {
        self.0.path()
    }
}
