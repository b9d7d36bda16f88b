//! Bands and elevation models as cloud-optimised GeoTIFF, written through `geotiff-writer`, which
//! no other file of ours knows.
//!
//! Tiles of 512 × 512 cells, north up; overviews of half the size down to one tile, each with every
//! second cell of the one before it, since neither directions nor verdicts have a mean; deflate.
//! Coordinates are those of the elevation model, key by key, and its points are the cells' middles.

use std::fs::File;
use std::io::{BufWriter, Cursor, Seek, Write};
use std::path::Path;

use geotiff_writer::{
    CogBuilder, Compression, GeoKeyValue, GeoTiffBuilder, NumericSample, Predictor, Resampling,
};
use grouser::document::columns::map::VERDICT;
use grouser::studies::mobility::{Ground, MobilityMap};
use grouser_raster::{CoordinateSystem, GeoKeys, Raster};
use ndarray::ArrayView2;

use crate::error::Fault;
use crate::{MapColumn, MapError};

/// Cells of a tile to either side.
const TILE: usize = 512;

/// Writes a band.
///
/// * `tick`: called after every row of tiles with the cells that it had
///
/// # Errors
/// [`MapError`] if the file cannot be written.
pub fn write_band(
    file: &Path,
    ground: Ground<'_>,
    map: &MobilityMap,
    band: &MapColumn,
    tick: &(dyn Fn(u64) + Sync),
) -> Result<(), MapError> {
    let written = if band.name == VERDICT {
        // Whole numbers up to 3.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1, 2 or 3")]
        let class = |number: Option<f64>| number.unwrap_or(0.0) as u8;
        write(file, ground, (map, band), ("0", Predictor::None), class, tick)
    } else {
        #[expect(clippy::cast_possible_truncation, reason = "seven digits are more than are known")]
        let real = |number: Option<f64>| number.map_or(f32::NAN, |number| number as f32);
        write(file, ground, (map, band), ("nan", Predictor::FloatingPoint), real, tick)
    };
    written.map_err(|fault| MapError::new(file, fault))
}

fn write<T: NumericSample>(
    file: &Path,
    ground: Ground<'_>,
    (map, band): (&MobilityMap, &MapColumn),
    format: (&str, Predictor),
    cell: impl Fn(Option<f64>) -> T,
    tick: &(dyn Fn(u64) + Sync),
) -> Result<(), Fault> {
    let of_place = |column: usize, row: usize| {
        cell(ground.at(map, column, row).map(|motion| band.number(&motion)))
    };
    let file = BufWriter::new(File::create(file)?);
    let mut sink = encode(file, ground.raster(), format, of_place, tick)?;
    sink.flush()?;
    sink.get_ref().sync_all()?;
    Ok(())
}

/// An elevation model as the content of a file, with real numbers of single precision and in the
/// raster's coordinates.
///
/// * `name`: of the file that it will be, for errors
///
/// # Errors
/// [`MapError`] if it cannot be encoded.
pub fn elevation_model(name: &Path, raster: &Raster) -> Result<Vec<u8>, MapError> {
    #[expect(clippy::cast_possible_truncation, reason = "the precision of the raster itself")]
    let height = |column, row| raster.height(column, row).map_or(f32::NAN, |height| height as f32);
    let format = ("nan", Predictor::FloatingPoint);
    let file = encode(Cursor::new(Vec::new()), raster, format, height, &|_| ());
    file.map(Cursor::into_inner).map_err(|fault| MapError::new(name, fault))
}

/// Encodes cells.
///
/// * `missing`, `predictor`: what stands for a cell without a number, and how numbers are prepared
///   for compression
/// * `cell`: the content of a point of the raster's grid, by its column and row
fn encode<T: NumericSample, W: Write + Seek>(
    sink: W,
    raster: &Raster,
    (missing, predictor): (&str, Predictor),
    cell: impl Fn(usize, usize) -> T,
    tick: &(dyn Fn(u64) + Sync),
) -> Result<W, Fault> {
    let grid = &raster.grid;
    let (columns, rows) = (grid.columns, grid.rows);
    let image = image(raster)?.nodata(missing).predictor(predictor);
    let cog = CogBuilder::new(image)
        .overview_levels(overviews(columns.max(rows)))
        .resampling(Resampling::NearestNeighbor);
    let mut writer = cog.tile_writer::<T, _>(sink)?;
    let mut tile = Vec::with_capacity(TILE * TILE);
    for top in (0..rows).step_by(TILE) {
        let height = TILE.min(rows - top);
        for left in (0..columns).step_by(TILE) {
            let width = TILE.min(columns - left);
            tile.clear();
            for row in top..top + height {
                // Rows of the file are from north to south, those of the grid from south to north.
                let row = rows - 1 - row;
                tile.extend((left..left + width).map(|column| cell(column, row)));
            }
            let view = ArrayView2::from_shape((height, width), &tile)
                .unwrap_or_else(|_| unreachable!("as many cells as rows and columns make"));
            writer.write_tile(left, top, &view)?;
        }
        tick((height * columns) as u64);
    }
    Ok(writer.finish()?)
}

/// The factors of the overviews: the last is no larger than a tile.
fn overviews(cells: usize) -> Vec<u32> {
    let factors = std::iter::successors(Some(2_u32), |factor| factor.checked_mul(2));
    factors.take_while(|factor| cells.div_ceil(*factor as usize) * 2 > TILE).collect()
}

/// An image on a raster's grid.
fn image(raster: &Raster) -> Result<GeoTiffBuilder, Fault> {
    let grid = &raster.grid;
    let count = |cells: usize| u32::try_from(cells).map_err(|_| Fault::TooLarge { cells });
    let north_west = grid.point(0, grid.rows - 1);
    let (width, height) = (grid.spacing.x, grid.spacing.y);
    let tile = u32::try_from(TILE).map_err(|_| Fault::TooLarge { cells: TILE })?;
    let image = GeoTiffBuilder::new(count(grid.columns)?, count(grid.rows)?)
        .pixel_scale(width, height)
        .origin(north_west.x - 0.5 * width, north_west.y + 0.5 * height)
        .tile_size(tile, tile)
        .compression(Compression::Deflate)
        .deflate_level(4);
    Ok(geo_keys(&raster.coordinates)
        .into_iter()
        .fold(image, |image, (id, value)| image.geokey(id, value)))
}

/// A name that the encoder takes: of a list such as `GCS Name = Moon 2000|Datum = …`, whose bars it
/// refuses, the first name, and without characters that are not in ASCII. Numbers of the system are
/// in keys of their own.
fn name_of(words: &str) -> String {
    let first = words.split('|').next().unwrap_or_default();
    let name = if words.contains('|') {
        first.split_once("Name = ").map_or(first, |(_, name)| name)
    } else {
        first
    };
    name.chars().filter(char::is_ascii).collect::<String>().trim().to_owned()
}

/// The keys of a system of coordinates, with cells that are areas.
fn geo_keys(coordinates: &CoordinateSystem) -> Vec<(u16, GeoKeyValue)> {
    /// `GTRasterTypeGeoKey`, and its value for areas.
    const RASTER_TYPE: u16 = 1025;
    const AREAS: u16 = 1;
    /// Tags in which values stand that are no whole numbers.
    const DOUBLES: u16 = 34736;
    const TEXT: u16 = 34737;
    let GeoKeys { directory, doubles, text } = coordinates.keys();
    let value = |entry: &[u16]| {
        let (tag, count, place) = (entry[1], usize::from(entry[2]), usize::from(entry[3]));
        match tag {
            0 => Some(GeoKeyValue::Short(entry[3])),
            DOUBLES => doubles.get(place..place + count).map(|it| GeoKeyValue::Double(it.to_vec())),
            TEXT => {
                let bytes = text.as_bytes().get(place..(place + count).min(text.len()))?;
                let words = String::from_utf8_lossy(bytes);
                Some(GeoKeyValue::Ascii(name_of(words.trim_end_matches(['|', '\0']))))
            }
            _ => None,
        }
    };
    let entries = directory.get(4..).unwrap_or_default().chunks_exact(4);
    let kept = entries.filter(|entry| entry[0] != RASTER_TYPE);
    let mut keys: Vec<_> = kept.filter_map(|entry| Some((entry[0], value(entry)?))).collect();
    keys.push((RASTER_TYPE, GeoKeyValue::Short(AREAS)));
    keys
}
