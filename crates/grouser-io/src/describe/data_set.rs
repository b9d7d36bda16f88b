//! `data-set/1`: wheel or rover, soils and gravity of a file of measurements.

use super::super::field::{Allowed, Field, Shape, Table, Texts, field, list, note, text, texts};
use super::about::{NOT_STATED, gravity, name, notes, schema};

/// What a data set says besides its parts.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Common {
    /// The CSV file with its rows, from the folder of this document.
    pub(crate) file: String,
    /// Gravity where it was measured, *g* [m/s²].
    pub(crate) gravity: f64,
}

pub(crate) static DATA_SET: Table<Common> = Table {
    doc: "A file of measured wheel tests, or of a rover on slopes, and the wheels, rovers and \
          soils in it.",
    fields: &[
        schema("data-set/1"),
        name(),
        note("source", "Who measured it, and where it is public.").otherwise(NOT_STATED),
        notes(),
        texts("assumed", "What is assumed, each as `key: why this value`."),
        text(
            "file",
            0,
            "The CSV file with its rows, from the folder of this document.",
            |set, file| {
                file.clone_into(&mut set.file);
            },
        ),
        gravity("Gravity where it was measured", |set| Some(&mut set.gravity)),
        list(
            "case",
            "Its parts, each with one wheel on a test stand or one rover on slopes.",
            &CASE,
            1,
        ),
    ],
};

/// What a part is about.
const TESTED: &[&str] = &["wheel", "rover"];

static CASE: Table<Common> = Table {
    doc: "A part of a data set: one wheel on a test stand, or one rover on slopes.",
    fields: &[
        note("name", "What people call it."),
        note("wheel", "The wheel: a preset, or a path from the folder of this document.")
            .one_of(TESTED),
        note(
            "rover",
            "The rover, in place of a wheel: a preset, or a path. The rows are slip, yaw or both, \
             over slope.",
        )
        .one_of(TESTED),
        texts(
            "where",
            "Which rows of the file belong to it, such as `wheel=smooth`; all conditions together.",
        ),
        SOILS,
        texts(
            "fitted",
            "Those of the soils that were fitted to these rows: their errors are in sample.",
        ),
    ],
};

const SOILS: Field<Common> = field(
    "soils",
    "Soils of the predictions: presets, or paths. A soil that names its `model` is used with it, another\n\
     with every model.",
    Shape::Texts(Texts { least: 1, most: None, allowed: Allowed::All, put: |_, _, _| {} }),
);
