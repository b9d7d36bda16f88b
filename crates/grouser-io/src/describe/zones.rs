//! Zones of soil in `[terrain]`: a file of zones, and which soil each has.

use std::sync::Arc;

use super::super::field::{At, Each, Field, Table, list, note, part, whole};
use super::super::kind::Kind;
use super::soil;
use grouser_core::soil::Soil;
use grouser_core::terrain::Ground;

/// The key of the file of zones, in the table of the terrain.
pub(crate) const FILE: &str = "soil_file";
/// The key of the legend, in the table of the terrain.
pub(crate) const LEGEND: &str = "zone";
/// The number of a zone, in a row of the legend.
pub(crate) const CLASS: &str = "class";
/// Its name.
pub(crate) const NAME: &str = "name";
/// Its soil.
pub(crate) const SOIL: &str = "soil";

/// The largest class number: single precision has all whole numbers up to here.
const LARGEST_CLASS: u64 = 1 << 24;

pub(super) const SOIL_FILE: Field<Ground> = note(
    FILE,
    "Zones of soil: a raster of class numbers (GeoTIFF, .npy, xyz text), or GeoJSON polygons in \
     metres with a property `soil`; a path from this document's folder. Where no zone is, the soil \
     is the scenario's.",
)
.optional();

const ROWS: &Each<Ground, Soil> = &Each {
    inner: &ZONE,
    list: |terrain| &mut Arc::make_mut(terrain.zones.get_or_insert_default()).soils,
    blank: || soil::BLANK,
};

pub(super) const ZONES: Field<Ground> =
    list(LEGEND, "The soil of each class, or of each name that is not a preset's.", ROWS, 0)
        .optional();

static ZONE: Table<Soil> = Table {
    doc: "The soil of a zone.",
    fields: &[
        whole(
            CLASS,
            0..=LARGEST_CLASS,
            "uint32",
            "The zone's class number in the file.",
            |_, _| {},
        )
        .optional(),
        note(NAME, "The zone's name in the file, in place of a class number.").optional(),
        part(
            SOIL,
            Kind::Soil,
            "Its soil: a preset's name, a path from this document's folder, or a soil's keys; left \
             out, the scenario's.",
            &At { inner: &soil::SOIL, at: |soil: &mut Soil| soil },
        )
        .optional(),
    ],
};
