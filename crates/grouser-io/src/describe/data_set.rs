//! `data-set/1`: wheel, soils and gravity of a file of measurements.

use super::super::data_set::DataSet;
use super::super::field::{Field, Shape, Table, Texts, field, list, note, text, texts};
use super::{NOT_STATED, gravity, name, notes, schema};

pub static DATA_SET: Table<DataSet> = Table {
    doc: "A file of measured wheel tests, and the wheels and soils in it.",
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
        list("case", "Its parts, each with one wheel.", &CASE, 1),
    ],
};

static CASE: Table<DataSet> = Table {
    doc: "A part of a data set: one wheel.",
    fields: &[
        note("name", "What people call it."),
        note("wheel", "The wheel: a preset, or a path from the folder of this document."),
        texts(
            "where",
            "Which rows of the file belong to it, such as `wheel=smooth`; all conditions together.",
        ),
        SOILS,
    ],
};

const SOILS: Field<DataSet> = field(
    "soils",
    "Soils of the predictions: presets, or paths. A soil that names its `model` is used with it, another\n\
     with every model.",
    Shape::Texts(Texts { least: 1, most: None, put: |_, _, _| {} }),
);
