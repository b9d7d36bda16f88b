//! The documents that come with the program: those of the crate's folder `data/`.

mod advice;

use serde::Serialize;

use super::kind::Kind;

pub use advice::Advice;

/// A document that comes with the program.
#[derive(Debug, PartialEq, Eq)]
pub struct Preset {
    /// The kind of document.
    pub kind: Kind,
    /// The name it is called by: that of its file.
    pub name: &'static str,
    /// The document, with its comments.
    pub text: &'static str,
    /// The measured rows of a data set, as CSV; other kinds have none.
    pub rows: Option<&'static str>,
}

/// A preset in a list.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PresetRecord {
    /// The kind of document.
    pub kind: &'static str,
    /// The name it is called by.
    pub name: &'static str,
    /// The document's name.
    pub title: String,
    /// The stated source of its values.
    pub source: String,
    /// The world that it is of; soils and rovers have one.
    pub world: Option<&'static str>,
    /// What it is good for; soils and rovers say so.
    pub advice: Option<&'static str>,
}

impl Preset {
    /// Its row in a list.
    #[must_use]
    pub fn record(&'static self) -> PresetRecord {
        let (title, source) = self.title_and_source();
        let (world, advice) = self.advice().map(|it| (it.world, it.text)).unzip();
        PresetRecord { kind: self.kind.name(), name: self.name, title, source, world, advice }
    }
}

/// All presets of a kind, in the order in which they are listed.
pub fn presets(kind: Kind) -> impl Iterator<Item = &'static Preset> {
    PRESETS.iter().filter(move |preset| preset.kind == kind)
}

/// The preset of a kind and a name.
///
/// Where do the values of the soil `lunar-nominal` come from?
///
/// ```
/// use grouser_io::{Kind, preset};
///
/// let soil = preset(Kind::Soil, "lunar-nominal").expect("it comes with the library");
/// let (title, source) = soil.title_and_source();
/// assert_eq!(title, "Lunar soil, nominal");
/// assert!(source.starts_with("Apollo and Lunar Roving Vehicle wheel constants"));
/// ```
#[must_use]
pub fn preset(kind: Kind, name: &str) -> Option<&'static Preset> {
    presets(kind).find(|preset| preset.name == name)
}

macro_rules! preset {
    ($kind:ident, $folder:literal, $name:literal) => {
        Preset {
            kind: Kind::$kind,
            name: $name,
            text: include_str!(concat!("../data/", $folder, "/", $name, ".toml")),
            rows: None,
        }
    };
    ($kind:ident, $folder:literal, $name:literal, $rows:literal) => {
        Preset {
            rows: Some(include_str!(concat!("../data/", $folder, "/", $rows))),
            ..preset!($kind, $folder, $name)
        }
    };
}

static PRESETS: &[Preset] = &[
    preset!(Soil, "soils", "toyoura"),
    preset!(Soil, "soils", "toyoura-uncertain"),
    preset!(Soil, "soils", "toyoura-as-printed"),
    preset!(Soil, "soils", "toyoura-lab-2007"),
    preset!(Soil, "soils", "toyoura-lab-2012"),
    preset!(Soil, "soils", "simulant-2007"),
    preset!(Soil, "soils", "lunar-nominal"),
    preset!(Soil, "soils", "lunar-umd"),
    preset!(Soil, "soils", "lunar-chrono"),
    preset!(Soil, "soils", "lunar-0-15-cm"),
    preset!(Soil, "soils", "lunar-0-30-cm"),
    preset!(Soil, "soils", "lunar-30-60-cm"),
    preset!(Soil, "soils", "hit-lss1"),
    preset!(Soil, "soils", "hit-lss1-2011"),
    preset!(Soil, "soils", "fjs-1-loose"),
    preset!(Soil, "soils", "grc-1"),
    preset!(Soil, "soils", "grc-1-second-hand"),
    preset!(Soil, "soils", "grc-3"),
    preset!(Soil, "soils", "mars-simulant"),
    preset!(Soil, "soils", "mars-regolith"),
    preset!(Soil, "soils", "mars-sand"),
    preset!(Soil, "soils", "mines-lunar"),
    preset!(Soil, "soils", "dry-sand"),
    preset!(Soil, "soils", "clay"),
    preset!(Soil, "soils", "direct-90"),
    preset!(Soil, "soils", "direct-90-grousers"),
    preset!(Soil, "soils", "cmu-direct90-smooth"),
    preset!(Soil, "soils", "cmu-direct90-grouser"),
    preset!(Soil, "soils", "krex-granite"),
    preset!(Soil, "soils", "mit-rig-a"),
    preset!(Soil, "soils", "mit-rig-b"),
    preset!(Wheel, "wheels", "hakuto"),
    preset!(Wheel, "wheels", "el-dorado-2"),
    preset!(Wheel, "wheels", "jfr-2007"),
    preset!(Wheel, "wheels", "lab-2007"),
    preset!(Wheel, "wheels", "cmu-smooth"),
    preset!(Wheel, "wheels", "cmu-grouser"),
    preset!(Wheel, "wheels", "mit-rig"),
    preset!(Wheel, "wheels", "ding-2011-smooth"),
    preset!(Wheel, "wheels", "rashid-1"),
    preset!(Wheel, "wheels", "viper-engineering"),
    preset!(Wheel, "wheels", "pragyan"),
    preset!(Wheel, "wheels", "yutu-2"),
    preset!(Wheel, "wheels", "sojourner"),
    preset!(Wheel, "wheels", "spirit"),
    preset!(Wheel, "wheels", "curiosity"),
    preset!(Wheel, "wheels", "lrv"),
    preset!(Motor, "motors", "maxon-a-max-22"),
    preset!(Motor, "motors", "maxon-re-25"),
    preset!(Motor, "motors", "maxon-re-25-24-v"),
    preset!(Motor, "motors", "maxon-re-30"),
    preset!(Motor, "motors", "faulhaber-1331"),
    preset!(Rover, "rovers", "hakuto"),
    preset!(Rover, "rovers", "hakuto-flight"),
    preset!(Rover, "rovers", "hakuto-steered"),
    preset!(Rover, "rovers", "hakuto-rockers"),
    preset!(Rover, "rovers", "el-dorado-2"),
    preset!(Rover, "rovers", "mgru3"),
    preset!(Rover, "rovers", "viper"),
    preset!(Rover, "rovers", "rashid"),
    preset!(Rover, "rovers", "pragyan"),
    preset!(Rover, "rovers", "yutu-2"),
    preset!(Rover, "rovers", "sojourner"),
    preset!(Rover, "rovers", "spirit"),
    preset!(Rover, "rovers", "curiosity"),
    preset!(Rover, "rovers", "curiosity-rocker-bogie"),
    preset!(Rover, "rovers", "lrv"),
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
    preset!(Scenario, "scenarios", "into-a-crater"),
    preset!(Mission, "missions", "blank"),
    preset!(Mission, "missions", "there-and-back"),
    preset!(Mission, "missions", "switchbacks-15-deg"),
    preset!(Mission, "missions", "two-steps-forward"),
    preset!(Mission, "missions", "crab-or-yaw"),
    preset!(Mission, "missions", "spot-turn"),
    preset!(Mission, "missions", "arc"),
    preset!(Mission, "missions", "slip-check"),
    preset!(Mission, "missions", "back-out"),
    preset!(DataSet, "measurements", "cmu-single-wheel", "cmu_single_wheel.csv"),
    preset!(DataSet, "measurements", "published-wheel-tests", "published_wheel_tests.csv"),
    preset!(DataSet, "measurements", "viper-slip-slope", "viper_slip_slope.csv"),
    preset!(DataSet, "measurements", "hakuto-slope", "hakuto_slope.csv"),
    preset!(Design, "designs", "design-climbing-wheels"),
    preset!(Design, "designs", "design-lighter-wheels"),
    preset!(Campaign, "campaigns", "campaign-heading"),
    preset!(Campaign, "campaigns", "campaign-mission"),
    preset!(Campaign, "campaigns", "campaign-traverse"),
    preset!(Campaign, "campaigns", "campaign-wheel-test"),
    preset!(Prior, "priors", "general"),
    preset!(Prior, "priors", "none"),
    preset!(TelemetryMapping, "mappings", "grouser"),
    preset!(TelemetryMapping, "mappings", "ros"),
    preset!(TelemetryMapping, "mappings", "foxglove"),
    preset!(TelemetryMapping, "mappings", "mines"),
    preset!(TelemetryMapping, "mappings", "enav"),
    preset!(TelemetryMapping, "mappings", "baseprod"),
];
