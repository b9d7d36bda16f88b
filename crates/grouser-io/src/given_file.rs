//! What files gave that an answer was computed from.

use serde::ser::{Serialize, SerializeMap as _, Serializer};

/// A file that was given, and how much of what it has counts.
///
/// ```
/// use grouser_io::given_file::{FileContent, GivenFile};
///
/// let log = GivenFile::new("drive.csv", FileContent::Telemetry, 301, 299);
/// assert_eq!(log.sentence(), "drive.csv: telemetry, 299 of 301 rows");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GivenFile {
    /// Its name.
    pub file: String,
    /// What it has.
    pub content: FileContent,
    /// How many there are.
    pub there: u64,
    /// How many of them count.
    pub used: u64,
    /// Zones with soils of their own, each with whether the drive met it; empty of other files, and
    /// where no drive was looked at.
    pub zones: Vec<(String, bool)>,
}

/// What a file has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileContent {
    /// A map of heights, in cells; those that count have a height.
    Heights,
    /// Zones of soil as a raster, in cells; those that count have a zone and lie on the ground.
    ZoneCells,
    /// Zones of soil as areas; those count whose span meets that of the ground.
    Zones,
    /// Areas to keep out of; those count whose span meets that of the ground.
    KeepOut,
    /// Places of a way; those that count lie on the ground.
    Way,
    /// Legs of a mission.
    Legs,
    /// Limits of a mission; those count that it does not have itself.
    Stops,
    /// Samples of a soil, in rows.
    Samples,
    /// A mapping of telemetry, in readings; those that find a topic or a column count.
    Mapping,
    /// Tests of a wheel, in rows.
    WheelTests,
    /// A rover on slopes, in rows.
    SlopeTests,
    /// Plate tests, in rows.
    PlateTests,
    /// Shear tests, in rows.
    ShearTests,
    /// Telemetry, in rows; those that count became records.
    Telemetry,
    /// A log of motors, in readings of a wheel.
    MotorLog,
}

impl FileContent {
    /// What it is.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Heights => "heights",
            Self::ZoneCells | Self::Zones => "zones of soil",
            Self::KeepOut => "areas to keep out of",
            Self::Way => "a way",
            Self::Legs => "legs",
            Self::Stops => "limits",
            Self::Samples => "samples of a soil",
            Self::Mapping => "a mapping of telemetry",
            Self::WheelTests => "wheel tests",
            Self::SlopeTests => "a rover on slopes",
            Self::PlateTests => "plate tests",
            Self::ShearTests => "shear tests",
            Self::Telemetry => "telemetry",
            Self::MotorLog => "a log of motors",
        }
    }

    /// What is counted.
    #[must_use]
    pub const fn counted(self) -> &'static str {
        match self {
            Self::Heights | Self::ZoneCells => "cells",
            Self::Zones | Self::KeepOut => "areas",
            Self::Way => "places",
            Self::Legs => "legs",
            Self::Stops => "limits",
            Self::MotorLog | Self::Mapping => "readings",
            Self::Samples
            | Self::WheelTests
            | Self::SlopeTests
            | Self::PlateTests
            | Self::ShearTests
            | Self::Telemetry => "rows",
        }
    }
}

impl GivenFile {
    /// * `there`: how many there are
    /// * `used`: how many of them count
    pub fn new(file: impl Into<String>, content: FileContent, there: u64, used: u64) -> Self {
        Self { file: file.into(), content, there, used, zones: Vec::new() }
    }

    /// What it gave, without a full stop.
    #[must_use]
    pub fn sentence(&self) -> String {
        let Self { file, content, there, used, .. } = self;
        let met = |what: &str, is_met: bool| {
            let names = self.zones_met(is_met).join(", ");
            if names.is_empty() { String::new() } else { format!("; {what}: {names}") }
        };
        let (content, counted) = (content.name(), content.counted());
        let (met, not_met) = (met("met", true), met("not met", false));
        format!("{file}: {content}, {used} of {there} {counted}{met}{not_met}")
    }

    /// The names of zones that the drive met, or did not meet.
    #[must_use]
    pub fn zones_met(&self, is_met: bool) -> Vec<&str> {
        let zones = self.zones.iter().filter(|(_, it)| *it == is_met);
        zones.map(|(name, _)| name.as_str()).collect()
    }
}

/// An object: the zones are two lists of names.
impl Serialize for GivenFile {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_map(None)?;
        object.serialize_entry("file", &self.file)?;
        object.serialize_entry("content", self.content.name())?;
        object.serialize_entry("counted", self.content.counted())?;
        object.serialize_entry("there", &self.there)?;
        object.serialize_entry("used", &self.used)?;
        if !self.zones.is_empty() {
            object.serialize_entry("zones_met", &self.zones_met(true))?;
            object.serialize_entry("zones_not_met", &self.zones_met(false))?;
        }
        object.end()
    }
}

/// What there is to say of the files that a document names.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NamedFiles {
    /// What each gave.
    pub given: Vec<GivenFile>,
    /// What is odd about them.
    pub notes: Vec<String>,
}
