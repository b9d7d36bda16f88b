//! The native half of the Python package `grouser`: documents and arrays in, the library's results
//! out.
//!
//! Python's own half, `python/grouser`, has the names, the docstrings and the shapes; this one
//! reads documents ([`descriptions`]), settles arrays of wheels ([`wheels`]), steps rovers
//! ([`simulators`], on [`paths`]), reads slip from currents ([`slip_from_current`]), learns from
//! telemetry ([`learning`]), runs studies ([`studies`], [`missions`], [`validation`],
//! [`calibration`]), many at once by what varies ([`runs`]: [`rollouts`], [`sweeps`]), and campaigns ([`campaign`]), computes the soil's reaction for other engines
//! ([`time_step`], and the [`ground`] under their wheels), reads [`telemetry`], exports tables ([`arrow`]) and
//! serves the [`console`]. It does so without Python's lock, with threads that a forked process has too
//! ([`threads`]), and Ctrl-C interrupts it ([`interrupt`]). Nothing here computes physics, and the
//! library knows nothing of Python.

mod animation;
mod arrow;
mod calibration;
mod campaign;
mod columns;
mod console;
mod descriptions;
mod designs;
mod errors;
mod gradients;
mod ground;
mod interrupt;
mod learning;
mod maps;
mod measurements;
mod missions;
mod outcomes;
mod paths;
mod replay;
mod rollouts;
mod routes;
mod runs;
mod simulators;
mod slip_from_current;
mod studies;
mod style;
mod sweeps;
mod telemetry;
mod terrain;
mod threads;
mod time_step;
mod urdf;
mod validation;
mod validity;
mod values;
mod varied;
mod wheels;

/// The module `grouser._core`.
#[pyo3::pymodule]
mod _core {
    #[pymodule_export]
    use super::animation::animation;
    #[pymodule_export]
    use super::arrow::arrow_stream;
    #[pymodule_export]
    use super::calibration::{calibrate_bevameter, calibrate_wheel_tests};
    #[pymodule_export]
    use super::campaign::{
        CampaignFolder, CampaignManifest, campaign_facts, campaign_frequencies, campaign_manifest,
        campaign_row, campaign_shard, campaign_summary, check_shard, find_campaign, merge_campaign,
        most_shard_bytes, seal_manifest, study_difference,
    };
    #[pymodule_export]
    use super::columns::{result_columns, unit_of};
    #[pymodule_export]
    use super::console::ConsoleServer;
    #[pymodule_export]
    use super::descriptions::{
        Document, check_document, find_document, meant_keys, present_names, presets,
        read_document_file, read_document_table, read_document_text, to_toml,
    };
    #[pymodule_export]
    use super::designs::design;
    #[pymodule_export]
    use super::gradients::settle_gradients;
    #[pymodule_export]
    use super::ground::Footprints;
    #[pymodule_export]
    use super::interrupt::panic;
    #[pymodule_export]
    use super::learning::Learner;
    #[pymodule_export]
    use super::maps::mobility_map;
    #[pymodule_export]
    use super::measurements::import_wheel_tests;
    #[pymodule_export]
    use super::missions::drive_mission;
    #[pymodule_export]
    use super::outcomes::outcomes;
    #[pymodule_export]
    use super::paths::PathTask;
    #[pymodule_export]
    use super::replay::replay;
    #[pymodule_export]
    use super::rollouts::rollout;
    #[pymodule_export]
    use super::routes::routes;
    #[pymodule_export]
    use super::simulators::{Simulators, path_columns, simulator_columns};
    #[pymodule_export]
    use super::slip_from_current::SlipFromCurrent;
    #[pymodule_export]
    use super::studies::{
        card, card_rule, forecast, gravity_of, heading, heading_map, heading_map_band, simulate,
        simulate_band, simulated_wheel_test, wheel_speeds, wheel_test_band,
    };
    #[pymodule_export]
    use super::style::{spread_labels, style_colours};
    #[pymodule_export]
    use super::sweeps::{heading_map_sweep, heading_sweep, mission_sweep, wheel_speeds_sweep};
    #[pymodule_export]
    use super::telemetry::{TelemetryMessages, import_telemetry};
    #[pymodule_export]
    use super::terrain::{Terrain, check_height_unit};
    #[pymodule_export]
    use super::time_step::SteppingWheels;
    #[pymodule_export]
    use super::urdf::rover_of_urdf;
    #[pymodule_export]
    use super::validation::{validate, validate_all, validate_drives, validate_slopes};
    #[pymodule_export]
    use super::validity::{flag_names, flags};
    #[pymodule_export]
    use super::varied::range_of;
    #[pymodule_export]
    use super::wheels::{not_carried, settle, wheel_forces};

    /// Gravities by name [m/s²], defaults, and the version.
    #[pymodule_init]
    fn init(module: &pyo3::Bound<'_, pyo3::types::PyModule>) -> pyo3::PyResult<()> {
        use pyo3::types::PyModuleMethods;
        for (name, value) in grouser::document::GRAVITIES {
            module.add(format!("{}_GRAVITY", name.to_uppercase()), value)?;
        }
        for (name, value) in super::time_step::DEFAULTS {
            module.add(name, value)?;
        }
        let models = grouser::contact::Model::ALL.map(|model| model.name());
        module.add("MODELS", models.to_vec())?;
        module.add("FAILED_STATUSES", grouser::document::campaign::FAILED.to_vec())?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
