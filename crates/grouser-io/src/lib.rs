//! Documents of Grouser: soils, wheels, rovers, runs and measurements with units in their names,
//! and what they mean in SI.
//!
//! A soil, a wheel, a rover, a scenario, a mission, a data set and a [`campaign`] each have a TOML
//! document. It is read in these steps:
//!
//! 1. [`Source`]: a preset, a file or a text is [found](Source::find) and read.
//! 2. [`Overrides`]: values set from outside replace those of the document.
//! 3. Named parts (a scenario's rover and soil, a rover's wheel) are read and put in their place.
//!    Relative paths start from the folder of the document they stand in.
//! 4. The tree is checked against the [`schema()`] of its kind: keys, types, keywords, ranges.
//! 5. The rows of its kind's table fill in what it leaves out, and put its numbers into the
//!    domain's value, in SI units and radians; what only several values together can show is
//!    checked there.
//! 6. What is uncertain about a soil is read, with the samples that it names.
//!
//! The result is [`Loaded`]: the value, and the resolved document, which written back as TOML
//! repeats the run on its own. An error is a [`DocumentError`], with the line and the column.
//!
//! Units and degrees are converted here and nowhere else. A number of a document (its key, unit,
//! range, meaning and place in the value) is one row of a table; a result (its name, unit, meaning
//! and origin) is one entry of [`columns`].
//!
//! Most users take the crate `grouser`, where all of this is the module `document`.
//!
//! ```
//! use grouser_io::{Kind, Overrides, Source};
//!
//! let overrides = Overrides::parse(["soil.cohesion_kpa=0.5"])?;
//! let toyoura = grouser_io::read_soil(&Source::find(Kind::Soil, "toyoura")?, &overrides)?;
//! assert_eq!(toyoura.value.cohesion, 500.0);
//! # Ok::<(), grouser_io::DocumentError>(())
//! ```

pub mod answer;
mod base;
pub mod campaign;
mod cell;
mod check;
pub mod columns;
mod data_set;
mod describe;
pub mod design;
pub mod design_task;
mod document;
pub mod draft;
pub mod error;
pub mod escape;
mod field;
pub mod figure;
pub mod file;
pub mod given_file;
mod gravity;
pub mod guard;
pub mod json;
mod json_schema;
mod kind;
mod legs_file;
mod limits;
mod lines;
mod loaded;
pub mod measurements;
mod mission;
mod notes;
mod overrides;
mod presets;
mod priors;
mod raster_file;
mod read;
pub mod reading;
mod rows;
mod samples;
mod schema;
pub mod soil_coordinates;
mod source;
mod stated;
pub mod statistics;
mod stop_file;
pub mod table;
pub mod telemetry_mapping;
mod terrain_file;
mod text;
mod tree;
mod uncertain_soil;
pub mod uncertainty;
pub mod unit;
pub mod urdf;
mod values;
pub mod varied;
mod withdrawn;
mod zones_file;

pub use check::{meant_keys, nearest};
pub use data_set::{DataSet, DataSetCase, LoadedDataSet, Tested, read_data_set};
pub use describe::scenario::RIM_SPEED_M_S;
pub use design_task::{DesignTask, LoadedDesign, read_design};
pub use document::{Document, to_toml};
pub use error::{DocumentError, Place, Problem, Spot};
pub use gravity::{GRAVITIES, gravity};
pub use kind::{DEFAULT_PRIORS, DEFAULT_ROVER, DEFAULT_SOIL, Kind};
pub use limits::read_limits;
pub use loaded::{Loaded, fnv_1a, mark_of};
pub use mission::{Plan, limited_quantity};
pub use overrides::Overrides;
pub use presets::{Advice, Preset, PresetRecord, preset, presets};
pub use priors::{Assumed, assumed, stated_by_priors, with_priors_held, without_priors_of};
pub use read::{
    LoadedMission, LoadedMotor, LoadedRover, LoadedScenario, LoadedSoil, LoadedWheel, Written,
    kind_of_source, place_of, read_mission, read_motor, read_priors, read_rover, read_scenario,
    read_soil, read_wheel, written,
};
pub use samples::{MODEL as SAMPLES_MODEL, RowsOfModel, WEIGHT as SAMPLES_WEIGHT};
pub use schema::{meaning, range, schema};
pub use source::{LARGEST_FILE, Source};
pub use stop_file::{Overruled, overruled};
pub use telemetry_mapping::read_telemetry_mapping;
pub use terrain_file::{map_of, read_map};
pub use text::nests_too_deep;
pub use tree::{Beside, Companion, Entry, HeldMap, Node, Origin};
pub use uncertain_soil::{SAMPLES_FILE, UncertainSoil, stated_of, without_uncertainty};
pub use unit::{UNITS, Unit, label_of, unit_of};
pub use values::{Described, Misfit};
pub use varied::scenario_with;
pub use withdrawn::present_names;

pub use grouser_raster::{BEYOND, Placement, ReadOptions};
