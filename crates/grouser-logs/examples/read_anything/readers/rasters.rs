//! Maps of heights, and zones of soil.

use std::error::Error;
use std::fs;

use grouser_core::terrain::Extent;
use grouser_core::units::Vec2;
use grouser_raster::zones::{ZoneMap, geojson};
use grouser_raster::{
    CoordinateSystem, Fault, MapFrame, Placement, Raster, ReadOptions, Remark, geotiff, npy, read,
    read_areas, read_line_string, read_zones, xyz, zone_names,
};

use super::{Outcome, Reader, Stage, finite, refused};
use crate::corpus;

/// The folder of the maps that the crate's own tests have.
const MAPS: &str = "grouser-raster/tests/fixtures";
/// One of them has its mask in a file beside it.
const MASKED: &str = "mask-beside.tif";

pub(super) fn all() -> Result<Vec<Reader>, Box<dyn Error>> {
    let points = vec![corpus::POINTS.into()];
    let mut of_zones = vec![fs::read(crate::beside(MAPS).join("classes-palette-u8.tif"))?];
    of_zones.extend([corpus::array_of_classes(), corpus::POINTS_OF_CLASSES.into()]);
    let mask = fs::read(crate::beside(MAPS).join(format!("{MASKED}.msk")))?;
    Ok(vec![
        Reader::new("GeoTIFF", 20, maps()?, |bytes, _| {
            heights(geotiff::decode(bytes.to_vec(), &placed()))
        }),
        Reader::new("mask of a GeoTIFF", 5, vec![mask], masked),
        Reader::new("NumPy", 10, corpus::arrays(), |bytes, _| {
            heights(npy::decode(bytes, &placed()))
        }),
        Reader::new("xyz", 10, points, |bytes, _| heights(xyz::decode(bytes, &placed()))),
        Reader::new("map of any format", 5, any_format()?, |bytes, stage| {
            let read = read(&stage.file("map", bytes), &ReadOptions::default());
            heights(read.map_err(|error| error.fault))
        }),
        Reader::new("zones, raster", 10, of_zones, |bytes, stage| {
            zones(read_zones(&stage.file("zones", bytes), &placed(), None))
        }),
        Reader::new("zones, GeoJSON", 10, vec![corpus::ZONES.into()], |bytes, stage| {
            let path = stage.file("zones.geojson", bytes);
            if let Err(error) = zone_names(&path) {
                return refused(&error);
            }
            zones(read_zones(&path, &ReadOptions::default(), None))
        }),
        Reader::new("areas", 10, vec![corpus::ZONES.into()], |bytes, stage| {
            zones(read_areas(
                &stage.file("areas.geojson", bytes),
                &site(&CoordinateSystem::default()),
            ))
        }),
        Reader::new("line", 10, vec![corpus::LINE.into()], |bytes, stage| {
            let file = stage.file("line.geojson", bytes);
            finite(&read_line_string(&file, &site(&CoordinateSystem::default())))
        }),
        Reader::new("coordinate system", 10, vec![corpus::ZONES.into()], |bytes, _| {
            finite(&geojson::compare_system(bytes, &CoordinateSystem::default()))
        }),
    ])
}

/// A map of two kilometres.
fn site(system: &CoordinateSystem) -> MapFrame<'_> {
    let [south_west, north_east] = [-1e3, 1e3].map(|it| Vec2::new(it, it));
    MapFrame { system: Some(system), extent: Extent { south_west, north_east } }
}

/// All maps of the tests, sorted.
fn maps() -> Result<Vec<Vec<u8>>, Box<dyn Error>> {
    let mut paths = Vec::new();
    for entry in fs::read_dir(crate::beside(MAPS))? {
        let path = entry?.path();
        if path.extension().is_some_and(|it| it == "tif") {
            paths.push(path);
        }
    }
    paths.sort();
    Ok(paths.into_iter().map(fs::read).collect::<Result<_, _>>()?)
}

fn any_format() -> Result<Vec<Vec<u8>>, Box<dyn Error>> {
    let mut all = maps()?;
    all.extend(corpus::arrays());
    all.push(corpus::POINTS.into());
    Ok(all)
}

/// How files are read that do not say where they lie.
fn placed() -> ReadOptions {
    let placement = Placement::north_first(Vec2::zeros(), 1.0);
    ReadOptions { placement: Some(placement), ..ReadOptions::default() }
}

/// A map whose mask this is.
fn masked(bytes: &[u8], stage: &Stage) -> Outcome {
    let map = fs::read(crate::beside(MAPS).join(MASKED));
    let map = map.unwrap_or_else(|error| panic!("{MASKED}: {error}"));
    stage.file("masked.tif.msk", bytes);
    let read = read(&stage.file("masked.tif", &map), &ReadOptions::default());
    heights(read.map_err(|error| error.fault))
}

/// Whether heights are finite or missing, and as many as the grid has; what becomes of them.
fn heights(read: Result<Raster, Fault>) -> Outcome {
    let raster = match read {
        Ok(raster) => raster,
        Err(fault) => return refused(&fault),
    };
    let Raster { grid, base, heights, .. } = &raster;
    assert_eq!(heights.len(), grid.columns * grid.rows, "as many heights as points");
    if let fault @ Outcome::Wrong(_) = crate::finite::finite(&(grid, base)) {
        return fault;
    }
    if heights.iter().any(|height| height.is_infinite()) {
        return Outcome::Wrong("not finite: a height".to_owned());
    }
    super::any(&raster.model())
}

/// What becomes of zones: each key a soil of its own, or the scenario's.
fn zones<E: std::fmt::Display>(read: Result<(ZoneMap, Option<Remark>), E>) -> Outcome {
    let map = match read {
        Ok((map, _)) => map,
        Err(error) => return refused(&error),
    };
    if let fault @ Outcome::Wrong(_) = crate::finite::finite(&map.extent()) {
        return fault;
    }
    let legend: Vec<_> = map.keys().iter().map(|key| (key.clone(), None)).collect();
    match map.with_legend(&legend, Vec::new()) {
        Ok(zones) => {
            let _ = std::hint::black_box(zones.zone(Vec2::new(5.0, 1.0)));
            Outcome::Read
        }
        Err(fault) => refused(&fault),
    }
}
