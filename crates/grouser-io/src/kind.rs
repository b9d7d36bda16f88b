//! Kinds of documents: their names, versions, and the documents that each names.

use std::fmt;

/// What a document describes.
///
/// Which rovers come with the library, and how does a document say that it describes one?
///
/// ```
/// use grouser_io::{Kind, presets};
///
/// let rovers: Vec<&str> = presets(Kind::Rover).map(|preset| preset.name).collect();
/// assert!(rovers.contains(&"hakuto") && rovers.contains(&"curiosity"), "{rovers:?}");
/// assert_eq!(Kind::Rover.tag(), "rover/1");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A soil, `soil/1`.
    Soil,
    /// A wheel, `wheel/1`.
    Wheel,
    /// A motor with its gear, `motor/1`.
    Motor,
    /// A rover, `rover/1`.
    Rover,
    /// A run, `scenario/1`.
    Scenario,
    /// Legs that a rover drives one after the other, `mission/1`.
    Mission,
    /// A file of measurements, `data-set/1`.
    DataSet,
    /// Many runs over what is not known exactly, `campaign/1`.
    Campaign,
    /// Numbers of a rover that are free, and what they are to be the best for, `design/1`.
    Design,
    /// What is believed of a soil's numbers that its source does not print, `prior/1`.
    Prior,
    /// Which topics and fields of a log of messages are which columns of telemetry,
    /// `telemetry-mapping/1`.
    TelemetryMapping,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Soil,
        Self::Wheel,
        Self::Motor,
        Self::Rover,
        Self::Scenario,
        Self::Mission,
        Self::DataSet,
        Self::Campaign,
        Self::Design,
        Self::Prior,
        Self::TelemetryMapping,
    ];

    /// Its name in commands and overrides.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Soil => "soil",
            Self::Wheel => "wheel",
            Self::Motor => "motor",
            Self::Rover => "rover",
            Self::Scenario => "scenario",
            Self::Mission => "mission",
            Self::DataSet => "data-set",
            Self::Campaign => "campaign",
            Self::Design => "design",
            Self::Prior => "prior",
            Self::TelemetryMapping => "telemetry-mapping",
        }
    }

    /// What the document's `schema` key says.
    #[must_use]
    pub const fn tag(self) -> &'static str {
        match self {
            Self::Soil => "soil/1",
            Self::Wheel => "wheel/1",
            Self::Motor => "motor/1",
            Self::Rover => "rover/1",
            Self::Scenario => "scenario/1",
            Self::Mission => "mission/1",
            Self::DataSet => "data-set/1",
            Self::Campaign => "campaign/1",
            Self::Design => "design/1",
            Self::Prior => "prior/1",
            Self::TelemetryMapping => "telemetry-mapping/1",
        }
    }

    /// The key of its soil, as a kind that is about one: nothing where it is a soil itself.
    pub(crate) const fn soil_key(self) -> Option<&'static str> {
        match self {
            Self::Soil => Some(""),
            Self::Scenario | Self::Mission | Self::Design => Some("soil"),
            Self::Wheel
            | Self::Motor
            | Self::Rover
            | Self::DataSet
            | Self::Campaign
            | Self::Prior
            | Self::TelemetryMapping => None,
        }
    }

    /// The keys under which it names other documents, and the preset that stands there if it does
    /// not.
    pub(super) const fn parts(self) -> &'static [Part] {
        match self {
            Self::Wheel | Self::Motor | Self::DataSet | Self::Prior | Self::TelemetryMapping => &[],
            Self::Soil => {
                &[Part { kind: Self::Prior, path: &[PRIORS_KEY], default: Some(DEFAULT_PRIORS) }]
            }
            Self::Rover => &[
                Part { kind: Self::Wheel, path: &["wheel_unit", "wheel"], default: None },
                Part { kind: Self::Wheel, path: &["mount", EACH, "wheel"], default: None },
                Part { kind: Self::Motor, path: &["motor"], default: None },
                Part { kind: Self::Motor, path: &["mount", EACH, "motor"], default: None },
            ],
            Self::Scenario | Self::Mission => &[
                Part { kind: Self::Rover, path: &["rover"], default: Some(DEFAULT_ROVER) },
                Part { kind: Self::Soil, path: &["soil"], default: Some(DEFAULT_SOIL) },
                Part { kind: Self::Soil, path: &["terrain", "zone", EACH, "soil"], default: None },
            ],
            Self::Design => &[
                Part { kind: Self::Rover, path: &["rover"], default: Some(DEFAULT_ROVER) },
                Part { kind: Self::Soil, path: &["soil"], default: Some(DEFAULT_SOIL) },
            ],
            Self::Campaign => &[
                Part { kind: Self::Scenario, path: &["scenario"], default: None },
                Part { kind: Self::Mission, path: &["mission"], default: None },
                Part { kind: Self::Soil, path: &["wheel_test", "soil"], default: None },
                Part { kind: Self::Wheel, path: &["wheel_test", "wheel"], default: None },
            ],
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The rover of a scenario or mission that names none.
pub const DEFAULT_ROVER: &str = "hakuto";
/// The soil of a scenario or mission that names none.
pub const DEFAULT_SOIL: &str = "toyoura";

/// The key of a soil under which its priors stand.
pub(crate) const PRIORS_KEY: &str = "priors";

/// The priors of a soil that names none.
pub const DEFAULT_PRIORS: &str = "general";

/// A document inside another.
pub(super) struct Part {
    pub kind: Kind,
    /// The keys that lead to it, with [`EACH`] for every entry of a list.
    pub path: &'static [&'static str],
    pub default: Option<&'static str>,
}

/// In the path of a [`Part`]: each entry of a list.
pub(super) const EACH: &str = "*";

impl Part {
    /// Whether there may be several, one in each entry of a list. What is set for the documents of
    /// its kind does not reach into those: only what is set at their own place does.
    pub(super) fn is_listed(&self) -> bool {
        self.path.contains(&EACH)
    }

    /// Whether a key lies within it.
    pub(super) fn holds(&self, path: &[String]) -> bool {
        let meets = |(step, key): (&String, &&str)| step == key || *key == EACH;
        path.len() > self.path.len() && path.iter().zip(self.path).all(meets)
    }
}

/// `scenario.soil.cohesion_kpa` is the soil's `cohesion_kpa`, whether the scenario names its soil
/// or holds it.
pub(crate) fn without_parts(mut kind: Kind, mut path: Vec<String>) -> (Kind, Vec<String>) {
    while let Some(part) = kind.parts().iter().find(|part| !part.is_listed() && part.holds(&path)) {
        path.drain(..part.path.len());
        kind = part.kind;
    }
    (kind, path)
}
