//! The documents that come with the program: those of `data/` and `scenarios/`.

use super::{Kind, Overrides, Source, written};

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
        let document = written(self.kind, &Source::Preset(self), &Overrides::none())
            .expect("every preset is read by a test")
            .document;
        (document.name().to_owned(), document.source().to_owned())
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
    preset!(Soil, "data/soils", "toyoura-uncertain"),
    preset!(Soil, "data/soils", "toyoura-as-printed"),
    preset!(Soil, "data/soils", "toyoura-lab-2007"),
    preset!(Soil, "data/soils", "toyoura-lab-2012"),
    preset!(Soil, "data/soils", "simulant-2007"),
    preset!(Soil, "data/soils", "lunar-nominal"),
    preset!(Soil, "data/soils", "lunar-umd"),
    preset!(Soil, "data/soils", "lunar-chrono"),
    preset!(Soil, "data/soils", "hit-lss1"),
    preset!(Soil, "data/soils", "mars-simulant"),
    preset!(Soil, "data/soils", "mars-regolith"),
    preset!(Soil, "data/soils", "mars-sand"),
    preset!(Soil, "data/soils", "mines-lunar"),
    preset!(Soil, "data/soils", "dry-sand"),
    preset!(Soil, "data/soils", "clay"),
    preset!(Soil, "data/soils", "direct-90"),
    preset!(Soil, "data/soils", "direct-90-grousers"),
    preset!(Soil, "data/soils", "cmu-direct90-smooth"),
    preset!(Soil, "data/soils", "cmu-direct90-grouser"),
    preset!(Soil, "data/soils", "krex-granite"),
    preset!(Soil, "data/soils", "mit-rig-a"),
    preset!(Soil, "data/soils", "mit-rig-b"),
    preset!(Wheel, "data/wheels", "hakuto"),
    preset!(Wheel, "data/wheels", "el-dorado-2"),
    preset!(Wheel, "data/wheels", "jfr-2007"),
    preset!(Wheel, "data/wheels", "lab-2007"),
    preset!(Wheel, "data/wheels", "cmu-smooth"),
    preset!(Wheel, "data/wheels", "cmu-grouser"),
    preset!(Wheel, "data/wheels", "mit-rig"),
    preset!(Rover, "data/rovers", "hakuto"),
    preset!(Rover, "data/rovers", "hakuto-flight"),
    preset!(Rover, "data/rovers", "el-dorado-2"),
    preset!(Scenario, "scenarios", "traverse-10-deg"),
    preset!(Scenario, "scenarios", "traverse-10-deg-compensated"),
    preset!(Scenario, "scenarios", "traverse-10-deg-torque"),
    preset!(Scenario, "scenarios", "spot-turn"),
    preset!(Scenario, "scenarios", "skid-steered-arc"),
    preset!(Scenario, "scenarios", "reverse"),
    preset!(Scenario, "scenarios", "start-from-rest"),
    preset!(Scenario, "scenarios", "eq18-as-printed"),
    preset!(Scenario, "scenarios", "eq18-corrected"),
    preset!(Scenario, "scenarios", "moon-10-deg"),
    preset!(Scenario, "scenarios", "too-steep"),
    preset!(DataSet, "data/measurements", "cmu-single-wheel"),
    preset!(Campaign, "scenarios", "campaign-attitude"),
    preset!(Campaign, "scenarios", "campaign-traverse"),
    preset!(Campaign, "scenarios", "campaign-wheel-test"),
];
