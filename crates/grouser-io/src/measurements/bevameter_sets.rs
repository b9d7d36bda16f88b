//! Raw plate and shear tests that come with the program, by name.

use std::borrow::Cow;
use std::path::Path;

use super::error::MeasurementError;
use super::limits::Limits;
use super::read_bytes;

/// Rows of a bevameter that come with the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BevameterSet {
    /// What `--plates` and `--shear` call it.
    pub name: &'static str,
    /// Its rows, as CSV.
    pub rows: &'static str,
    /// What was tested, and by whom.
    pub about: &'static str,
}

/// The sets. Sources and licences: `data/measurements/README.md`.
pub const BEVAMETER_SETS: [BevameterSet; 3] = [
    BevameterSet {
        name: "grc-1-plates",
        rows: include_str!("../../data/measurements/grc1_plates.csv"),
        about: "GRC-1 at 1670 kg/m³ under three round plates, five repeats each (Oravec 2009)",
    },
    BevameterSet {
        name: "cullinan-plates",
        rows: include_str!("../../data/measurements/cullinan_plates.csv"),
        about: "Cullinan sand, lightly compacted, under one round plate, three repeats (Kruger et \
                al. 2023)",
    },
    BevameterSet {
        name: "cullinan-shear",
        rows: include_str!("../../data/measurements/cullinan_shear.csv"),
        about: "Cullinan sand, lightly compacted, sheared under one normal stress (Kruger et al. \
                2023)",
    },
];

/// The rows of a set of this name, or of a file.
///
/// # Errors
/// [`MeasurementError`] for a file that cannot be read.
pub fn rows_of(path: &Path, limits: Limits) -> Result<Cow<'static, [u8]>, MeasurementError> {
    let set = BEVAMETER_SETS.iter().find(|set| Path::new(set.name) == path);
    match set {
        Some(set) => Ok(Cow::Borrowed(set.rows.as_bytes())),
        None => read_bytes(path, limits).map(Cow::Owned),
    }
}
