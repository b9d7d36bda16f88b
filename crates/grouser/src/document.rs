//! Documents with units in their names, and what they mean: those of `grouser-io`, and beside them
//! the documents and results of studies.

mod bevameter;
pub mod calibration;
pub mod campaign;
pub mod checkpoint;
pub mod columns;
mod doubts;
pub mod experiment;
pub mod forecast;
pub mod gradient;
pub mod learn;
pub mod plates;
pub mod ranking;
pub mod route;
pub mod sensors;
pub mod shear_tests;
pub mod simulated_test;
mod soil_family;
pub mod study;
pub mod validation;
pub mod validity;
mod zones;

pub use grouser_io::*;

pub use campaign::{Campaign, read_campaign};
pub use doubts::doubts;
pub use soil_family::{FitKey, SoilFamily};
pub use zones::given_to_drives;

/// Checks a document of any kind, named by its `schema`.
///
/// # Errors
/// [`DocumentError`] for the first fault found.
pub fn check(source: &Source) -> Result<Kind, DocumentError> {
    checked(source).map(|checked| checked.kind)
}

/// A document without a fault.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    /// Its kind.
    pub kind: Kind,
    /// The keys that it, or its soil, takes from priors because they are not stated.
    pub assumed: Vec<Assumed>,
}

/// Checks a document of any kind, named by its `schema`, and says what it leaves to priors.
///
/// # Errors
/// [`DocumentError`] for the first fault found.
pub fn checked(source: &Source) -> Result<Checked, DocumentError> {
    let kind = kind_of_source(source)?;
    let overrides = Overrides::none();
    let assumed = match kind {
        Kind::Soil => read_soil(source, &overrides)?.assumed,
        Kind::Scenario => read_scenario(source, &overrides)?.assumed,
        Kind::Mission => read_mission(source, &overrides)?.assumed,
        Kind::Wheel => read_wheel(source, &overrides)?.assumed,
        Kind::Motor => read_motor(source, &overrides)?.assumed,
        Kind::Rover => read_rover(source, &overrides)?.assumed,
        Kind::DataSet => read_data_set(source, &overrides)?.assumed,
        Kind::Campaign => read_campaign(source, &overrides).map(|_| Vec::new())?,
        Kind::Design => read_design(source, &overrides)?.assumed,
        Kind::Prior => read_priors(source, &overrides).map(|_| Vec::new())?,
        Kind::TelemetryMapping => read_telemetry_mapping(source, &overrides)?.assumed,
    };
    Ok(Checked { kind, assumed })
}
