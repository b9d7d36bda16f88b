//! Zones by the class numbers of a raster.

use grouser_core::terrain::zones::NO_ZONE;

use super::key::ZoneKey;
use super::map::{ZoneMap, check_count};
use crate::Raster;
use crate::error::Fault;

/// The zones of a raster of whole numbers; where a number is missing there is no zone.
pub(super) fn of(raster: &Raster) -> Result<ZoneMap, Fault> {
    let mut keys: Vec<i64> = Vec::new();
    let mut last = None;
    for (cell, above) in raster.heights.iter().enumerate().filter(|(_, above)| above.is_finite()) {
        let class = class_of(raster, cell, *above)?;
        if last != Some(class)
            && let Err(place) = keys.binary_search(&class)
        {
            keys.insert(place, class);
            // Heights, say, have ever more of them.
            check_count(&keys_of(&keys))?;
        }
        last = Some(class);
    }
    let number = |above: &f32| {
        let Some(class) = whole(raster.base + f64::from(*above)) else { return NO_ZONE };
        keys.binary_search(&class).ok().and_then(|at| u8::try_from(at).ok()).unwrap_or(NO_ZONE)
    };
    let cells = raster.heights.iter().map(number).collect();
    Ok(ZoneMap::of_cells(keys_of(&keys), raster.grid, cells, raster.coordinates.clone()))
}

fn keys_of(classes: &[i64]) -> Vec<ZoneKey> {
    classes.iter().copied().map(ZoneKey::Class).collect()
}

/// The class of a cell.
///
/// * `above`: its number above the raster's base
fn class_of(raster: &Raster, cell: usize, above: f32) -> Result<i64, Fault> {
    /// Single precision has all whole numbers up to here.
    const LARGEST: f32 = 16_777_216.0;
    let number = raster.base + f64::from(above);
    let class = whole(number).filter(|_| above.abs() < LARGEST);
    class.ok_or_else(|| {
        let columns = raster.grid.columns;
        let at = raster.grid.point(cell % columns, cell / columns);
        Fault::NoClass { number, x: at.x, y: at.y }
    })
}

/// A whole number, if it is one.
#[expect(clippy::cast_possible_truncation, reason = "whole, and far from the largest")]
fn whole(number: f64) -> Option<i64> {
    /// Above this not every whole number is one of double precision.
    const LARGEST: f64 = 9e15;
    (number.fract() == 0.0 && number.abs() < LARGEST).then_some(number as i64)
}
