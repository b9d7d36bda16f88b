//! What there is to say of a log besides what is in it.

use std::fs::File;
use std::io;

use grouser_io::measurements::telemetry::Odometry;

use crate::error::{Problem, TelemetryError};
use crate::mapping::Mapping;
use crate::mapping::plan::TopicChoices;
use crate::mcap::read::OverBudget;

/// How a log is read; as it is without any of it.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct LogOptions {
    /// Which fields of messages, or columns of a table, are which columns of telemetry; without it the
    /// built-in one that fits messages, and the names of a table's columns.
    pub mapping: Option<Mapping>,
    /// Of such a log, the topic that is meant where several fit.
    pub topics: TopicChoices,
    /// What measured ways and rotations, in place of what the mapping says; of a table without it
    /// cameras, as the names of its columns say.
    pub odometry: Option<Odometry>,
    /// The most that is unpacked of a packed log, in place of what its size allows [bytes].
    pub most_unpacked: Option<u64>,
}

impl LogOptions {
    /// The same with a mapping, if there is one.
    #[must_use]
    pub fn with_mapping(self, mapping: Option<Mapping>) -> Self {
        Self { mapping, ..self }
    }

    /// The same with choices of topics.
    #[must_use]
    pub fn with_topics(self, topics: TopicChoices) -> Self {
        Self { topics, ..self }
    }

    /// The same with what measured ways and rotations, if that is stated.
    #[must_use]
    pub fn with_odometry(self, odometry: Option<Odometry>) -> Self {
        Self { odometry, ..self }
    }

    /// The same with the most that is unpacked of a packed log [bytes], if that is stated.
    #[must_use]
    pub fn with_most_unpacked(self, most_unpacked: Option<u64>) -> Self {
        Self { most_unpacked, ..self }
    }

    /// The mapping by which a table is read, if it is read by one.
    ///
    /// # Errors
    /// [`Problem::NoMessages`] for topics without a mapping: no column has one by its name alone.
    pub(crate) fn mapping_of_table(&self, label: &str) -> Result<Option<&Mapping>, TelemetryError> {
        if self.mapping.is_none() && !self.topics.is_empty() {
            return Err(TelemetryError::new(label, Problem::NoMessages));
        }
        Ok(self.mapping.as_ref())
    }

    /// How much of a log is read.
    pub(crate) fn budget(&self, file: &File) -> io::Result<OverBudget> {
        Ok(OverBudget { length: file.metadata()?.len(), allowed: self.most_unpacked })
    }
}
