//! `wheel/1`: the geometry of a wheel.

use super::super::field::{At, M, Table, number, table, whole};
use super::about::{assumed, name, notes, schema, source};
use grouser_core::wheel::{Grousers, Wheel};

/// A wheel before its numbers are put in.
pub(crate) const BLANK: Wheel = Wheel { radius: 0.0, width: 0.0, grousers: None };

const NO_BARS: Grousers = Grousers { height: 0.0, count: 0 };

pub(crate) static WHEEL: Table<Wheel> = Table {
    doc: "A rigid wheel with a flat rim.",
    fields: &[
        schema("wheel/1"),
        name(),
        source(),
        notes(),
        assumed(),
        number("radius_m", M, 0.01..=1.0, "Radius of the rim, without grousers, r", |wheel| {
            Some(&mut wheel.radius)
        }),
        number("width_m", M, 0.01..=1.0, "Width of the rim, b", |wheel| Some(&mut wheel.width)),
        table(
            "grousers",
            "Bars across the rim; left out for a smooth wheel.",
            &At { inner: &GROUSERS, at: |wheel: &mut Wheel| wheel.grousers.get_or_insert(NO_BARS) },
        )
        .optional(),
    ],
};

static GROUSERS: Table<Grousers> = Table {
    doc: "Bars across the rim.",
    fields: &[
        number("height_m", M, 0.0..=0.1, "Height over the rim, h_g", |bars| Some(&mut bars.height)),
        whole("count", 1..=10_000, "uint32", "How many there are.", |bars, count| {
            bars.count = u32::try_from(count).unwrap_or(u32::MAX);
        }),
    ],
};
