//! The native half of the Python package `grouser`: words and arrays in, the library's answers out.
//!
//! Python's own half, `python/grouser`, has the names, the docstrings and the shapes; this one reads
//! documents ([`descriptions`]), settles arrays of wheels ([`wheels`]), runs studies
//! ([`studies`]) and campaigns ([`campaign`]), without Python's lock and with an ear for Ctrl-C
//! ([`interrupt`]). Nothing here computes physics, and nothing below knows of Python.

mod campaign;
mod columns;
mod descriptions;
mod errors;
mod interrupt;
mod studies;
mod validation;
mod values;
mod wheels;

/// The module `grouser._core`.
#[pyo3::pymodule]
mod _core {
    #[pymodule_export]
    use super::campaign::{
        CampaignFolder, campaign_facts, campaign_manifest, campaign_row, campaign_shard,
        campaign_summary, check_shard, find_campaign, merge_campaign, read_shard, study_difference,
    };
    #[pymodule_export]
    use super::descriptions::{
        Document, find_document, presets, read_document_file, read_document_table,
        read_document_text, to_toml,
    };
    #[pymodule_export]
    use super::studies::{attitude, attitude_map, rollout, simulate};
    #[pymodule_export]
    use super::validation::validate;
    #[pymodule_export]
    use super::wheels::{not_carried, settle, wheel_forces};

    /// Gravities by name [m/s²].
    #[pymodule_init]
    fn init(module: &pyo3::Bound<'_, pyo3::types::PyModule>) -> pyo3::PyResult<()> {
        use pyo3::types::PyModuleMethods;
        for (name, value) in grouser::document::GRAVITIES {
            module.add(format!("{}_GRAVITY", name.to_uppercase()), value)?;
        }
        module.add("FAILED_STATUSES", grouser::document::campaign::FAILED.to_vec())?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
