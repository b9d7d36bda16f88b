//! The mapping by which a log of messages is read: one that is named, or the built-in one that
//! fits.

pub(crate) mod clock;
pub(crate) mod merge;
pub(crate) mod messages;
pub(crate) mod plan;
pub(crate) mod pose;
pub(crate) mod topic;
pub(crate) mod turning;

use std::path::Path;

use grouser_io::telemetry_mapping::TelemetryMapping;
use grouser_io::{Kind, Overrides, Problem, Source, escape, presets, read_telemetry_mapping};

use crate::error::TelemetryError;
use crate::mapping::topic::Topic;

/// Which topics and fields of a log are which columns.
#[derive(Clone, Debug)]
pub struct Mapping {
    /// What messages call it.
    pub(crate) label: String,
    /// Whether it is no built-in one.
    pub(crate) is_file: bool,
    pub(crate) rules: TelemetryMapping,
}

impl Mapping {
    /// Reads the document of a file, or takes the built-in one of that name.
    ///
    /// # Errors
    /// [`TelemetryError`] for a file that cannot be read or is no mapping.
    pub fn find(name: &Path) -> Result<Self, TelemetryError> {
        let source = match name.to_str() {
            Some(name) => Source::find(Kind::TelemetryMapping, name)?,
            None => Source::file(name),
        };
        Self::read(&source)
    }

    /// Reads the text of a document.
    ///
    /// * `label`: what messages call it
    ///
    /// # Errors
    /// [`TelemetryError`] with line and column for a text that is no mapping.
    pub fn parse(label: &str, text: &str) -> Result<Self, TelemetryError> {
        Self::read(&Source::text(label, text))
    }

    fn read(source: &Source) -> Result<Self, TelemetryError> {
        let label = match source {
            Source::Preset(preset) => format!("mapping {}", preset.name),
            Source::File(path) | Source::Confined { path, .. } => escape::path(path),
            Source::Text { label, .. } => label.clone(),
        };
        let read = read_telemetry_mapping(source, &Overrides::none());
        let read = read.map_err(|error| match (error.problem(), error.hint()) {
            (Problem::NoSuchFile, None) => {
                let names: Vec<_> = presets(Kind::TelemetryMapping).map(|it| it.name).collect();
                error.with_hint(format!("the built-in mappings are {}", names.join(", ")))
            }
            _ => error,
        });
        let is_file = !matches!(source, Source::Preset(_));
        Ok(Self { label, is_file, rules: read?.value })
    }

    /// The built-in mappings.
    pub(crate) fn built_in() -> impl Iterator<Item = Self> {
        let built_in = presets(Kind::TelemetryMapping).map(Source::Preset);
        built_in.filter_map(|source| Self::read(&source).ok())
    }

    /// The first built-in mapping that reads a log; nothing if none knows one of its topics.
    pub(crate) fn for_topics(topics: &[Topic]) -> Option<Self> {
        Self::built_in().find(|mapping| {
            let mut readings = mapping.rules.readings.iter();
            readings.any(|it| topics.iter().any(|topic| it.reads(&topic.name, &topic.message, "*")))
        })
    }
}
