//! Documents with units in their names, and what they mean: those of `grouser-io`, and beside them the documents
//! and results of studies.

pub mod calibration;
pub mod campaign;
pub mod card;
pub mod checkpoint;
pub mod columns;
mod doubts;
pub mod experiment;
pub mod plates;
pub mod ranking;
pub mod simulated_test;
mod soil_family;
pub mod study;
pub mod validation;
pub mod validity;

pub use grouser_io::*;

pub use campaign::{Campaign, read_campaign};
pub use doubts::doubts;
pub use soil_family::{FitKey, SoilFamily};

/// Checks a document of any kind, named by its `schema`.
///
/// # Errors
/// [`DocumentError`] for the first fault found.
pub fn check(source: &Source) -> Result<Kind, DocumentError> {
    let kind = kind_of_source(source)?;
    let overrides = Overrides::none();
    match kind {
        Kind::Soil => read_soil(source, &overrides).map(drop),
        Kind::Wheel => read_wheel(source, &overrides).map(drop),
        Kind::Rover => read_rover(source, &overrides).map(drop),
        Kind::Scenario => read_scenario(source, &overrides).map(drop),
        Kind::DataSet => read_data_set(source, &overrides).map(drop),
        Kind::Campaign => read_campaign(source, &overrides).map(drop),
        Kind::Prior => read_priors(source, &overrides).map(drop),
    }?;
    Ok(kind)
}
