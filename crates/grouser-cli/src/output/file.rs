//! A single output file: written beside and renamed, never over an old one unless told to.

use std::io::Write as _;
use std::path::Path;

use crate::failure::Failure;
use crate::interrupt;

/// That a file may be written: it is not there yet, or may be replaced.
pub(crate) fn check_new(out: &Path, may_replace: bool) -> Result<(), Failure> {
    if out.is_dir() {
        let out = out.display();
        return Err(Failure::Usage(format!("{out} is a folder, not a file")));
    }
    if out.exists() && !may_replace {
        let out = out.display();
        return Err(Failure::Usage(format!(
            "{out} exists already: choose another name, or add --force to replace it"
        )));
    }
    Ok(())
}

/// Writes beside and renames, so that the file is whole or not there.
pub(crate) fn write(out: &Path, content: &[u8]) -> Result<(), Failure> {
    let _not_now = interrupt::not_now();
    let folder = match out.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let failed = || Failure::at("cannot write", out);
    let mut file = tempfile::NamedTempFile::new_in(folder).map_err(failed())?;
    file.write_all(content).map_err(failed())?;
    file.persist(out).map(drop).map_err(|error| failed()(error.error))
}
