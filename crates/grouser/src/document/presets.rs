//! The documents that come with the program: those of `data/` and `scenarios/`.

use super::{Document, Kind, Overrides, Source};
use super::{RoverDocument, ScenarioDocument, SoilDocument, WheelDocument, read};

/// A document that comes with the program.
#[derive(Debug, PartialEq, Eq)]
pub struct Preset {
    /// What it describes.
    pub kind: Kind,
    /// The name it is called by: that of its file.
    pub name: &'static str,
    /// The document, with its comments.
    pub text: &'static str,
}

/// All presets of a kind, in the order in which they are listed.
pub fn presets(kind: Kind) -> impl Iterator<Item = &'static Preset> {
    PRESETS.iter().filter(move |preset| preset.kind == kind)
}

/// The preset of a kind and a name.
#[must_use]
pub fn preset(kind: Kind, name: &str) -> Option<&'static Preset> {
    presets(kind).find(|preset| preset.name == name)
}

impl Preset {
    /// What the document calls itself, and where it says its values are from.
    #[must_use]
    pub fn title_and_source(&'static self) -> (String, String) {
        match self.kind {
            Kind::Soil => self.header(|soil: &SoilDocument| (&soil.name, &soil.source)),
            Kind::Wheel => self.header(|wheel: &WheelDocument| (&wheel.name, &wheel.source)),
            Kind::Rover => self.header(|rover: &RoverDocument| (&rover.name, &rover.source)),
            Kind::Scenario => self.header(|run: &ScenarioDocument| (&run.name, &run.source)),
        }
    }

    fn header<D: Document>(&'static self, words: fn(&D) -> (&String, &String)) -> (String, String) {
        let loaded = read::<D>(&Source::Preset(self), &Overrides::none())
            .expect("every preset is read by a test");
        let (name, source) = words(&loaded.document);
        (name.clone(), source.clone())
    }
}

macro_rules! preset {
    ($kind:ident, $folder:literal, $name:literal) => {
        Preset {
            kind: Kind::$kind,
            name: $name,
            text: include_str!(concat!("../../../../", $folder, "/", $name, ".toml")),
        }
    };
}

static PRESETS: &[Preset] = &[
    preset!(Soil, "data/soils", "toyoura"),
    preset!(Wheel, "data/wheels", "hakuto"),
    preset!(Rover, "data/rovers", "hakuto"),
];
