//! Bands in colours.

use grouser::document::columns::quantity;
use grouser::studies::mobility::{Ground, MobilityMap};
use grouser_draw::map::map_picture;
use grouser_map::{BandSummary, Look, MapColumn};

/// What a band is called in pictures and styles.
pub(super) fn label(band: &MapColumn) -> String {
    let words = quantity(band.name, band.unit).label();
    match band.unit.symbol {
        "" | "-" => words,
        unit => format!("{words} [{unit}]"),
    }
}

/// A band in colours, north up.
pub(super) fn of(
    (ground, map): (Ground<'_>, &MobilityMap),
    band: &MapColumn,
    of: &BandSummary,
) -> String {
    let number = |column: usize, row: usize| Some(band.number(&ground.at(map, column, row)?));
    let scale = Look::of(band.name).scale(of);
    map_picture(&label(band), &ground.raster().grid, &number, &scale)
}
