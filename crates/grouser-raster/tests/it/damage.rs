//! Damaged files give an error, or a raster no larger than what was allowed; never a panic.

use std::fs;

use fastrand::Rng;
use grouser_core::units::Vec2;
use grouser_raster::zones::geojson;
use grouser_raster::{Fault, Placement, Raster, ReadOptions, geotiff, npy, xyz};

use crate::ground;

/// Cells that damaged files may claim.
const CELLS: u64 = 1 << 16;
/// Damages of a file in the usual run.
const USUAL: u64 = 2_000;
/// And in the full one.
const FULL: u64 = 100_000;

type Decode = fn(&[u8], &ReadOptions) -> Result<Raster, Fault>;

fn decode_tiff(bytes: &[u8], options: &ReadOptions) -> Result<Raster, Fault> {
    geotiff::decode(bytes.to_vec(), options)
}

fn decode_xyz(bytes: &[u8], options: &ReadOptions) -> Result<Raster, Fault> {
    xyz::decode(bytes, options)
}

/// Every fixture, and a file of each other format.
fn files() -> Vec<(String, Vec<u8>, Decode)> {
    let folder = fs::read_dir(ground::fixture("")).expect("a folder");
    let mut files: Vec<(String, Vec<u8>, Decode)> = Vec::new();
    for entry in folder {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|extension| extension == "tif") {
            let bytes = fs::read(&path).expect("a file");
            files.push((path.display().to_string(), bytes, decode_tiff));
        }
    }
    files.sort_by(|one, other| one.0.cmp(&other.0));
    assert!(files.len() > 15, "{}", files.len());
    let header = "{'descr': '<f4', 'fortran_order': False, 'shape': (5, 4), }\n";
    let mut array = b"\x93NUMPY\x01\0".to_vec();
    array.extend([u8::try_from(header.len()).expect("short"), 0]);
    array.extend(header.bytes());
    array.extend((0..20_u8).flat_map(|i| f32::from(i).to_le_bytes()));
    files.push(("npy".into(), array, npy::decode));
    let points = (0..30).map(|i| format!("{} {}.5\t{}\n", i % 6, 10 * (i / 6), i * i));
    files.push(("xyz".into(), points.collect::<String>().into_bytes(), decode_xyz));
    files
}

fn options() -> ReadOptions {
    let placement = Placement::north_first(Vec2::zeros(), 1.0);
    ReadOptions { placement: Some(placement), cells: Some(CELLS), ..ReadOptions::default() }
}

fn check(name: &str, case: &str, result: Result<Raster, Fault>) {
    match result {
        Ok(raster) => {
            let cells = raster.grid.columns * raster.grid.rows;
            assert_eq!(raster.heights.len(), cells, "{name}, {case}");
            assert!(cells as u64 <= CELLS, "{name}, {case}: {cells} cells");
            assert!(raster.base.is_finite() && raster.heights.iter().all(|h| !h.is_infinite()));
        }
        Err(fault) => {
            let text = fault.to_string();
            assert!(!text.is_empty() && text.len() < 2_000, "{name}, {case}: {text}");
        }
    }
}

/// Changes bits, bytes, and words of two and four bytes, as headers have them.
fn damage(bytes: &mut Vec<u8>, dice: &mut Rng) {
    for _ in 0..=dice.usize(..3) {
        // Headers are at the start more often than not.
        let reach = if dice.bool() { bytes.len().min(600) } else { bytes.len() };
        if reach < 5 {
            return;
        }
        let at = dice.usize(..reach - 4);
        match dice.u8(..8) {
            0..4 => bytes[at] ^= 1 << dice.u8(..8),
            4 => bytes[at] = dice.u8(..),
            5 => bytes[at..at + 2].copy_from_slice(&[0xff, 0xff]),
            6 => bytes[at..at + 4].copy_from_slice(&dice.u32(..).to_le_bytes()),
            _ => {
                bytes.remove(at);
            }
        }
    }
}

fn check_damages(count: u64) {
    for (name, bytes, decode) in files() {
        for seed in 0..count {
            let mut damaged = bytes.clone();
            damage(&mut damaged, &mut Rng::with_seed(seed));
            check(&name, &format!("seed {seed}"), decode(&damaged, &options()));
        }
    }
}

#[test]
fn every_truncation_is_refused_or_read() {
    for (name, bytes, decode) in files() {
        for length in 0..bytes.len() {
            let result = decode(&bytes[..length], &options());
            check(&name, &format!("{length} bytes"), result);
        }
    }
}

#[test]
fn damaged_files_are_refused_or_read() {
    check_damages(USUAL);
}

/// Polygons are finite and make zones, whatever was damaged.
#[test]
fn damaged_geojson_is_refused_or_read() {
    let text = br#"{"type": "FeatureCollection", "crs": {"properties": {"name": "EPSG:32633"}}, "features": [
        {"type": "Feature", "properties": {"soil": "dune"}, "geometry": {"type": "MultiPolygon",
            "coordinates": [[[[0, 0], [10.5, 0], [10, 1e1], [0, 0]], [[1, 1], [2, 1], [2, 2], [1, 1]]]]}},
        {"type": "Feature", "properties": {"soil": -3}, "geometry": {"type": "Polygon",
            "coordinates": [[[0, 0, 5], [10.5, 0, 7], [10, 10, 7], [0, 0, 5]]]}}]}"#;
    let mut read = 0;
    for seed in 0..USUAL {
        let mut damaged = text.to_vec();
        damage(&mut damaged, &mut Rng::with_seed(seed));
        match geojson::decode(&damaged) {
            Ok(map) => {
                read += 1;
                let legend: Vec<_> = map.keys().iter().map(|key| (key.clone(), None)).collect();
                let zones = map.with_legend(&legend, Vec::new());
                let zones = zones.unwrap_or_else(|fault| panic!("seed {seed}: {fault}"));
                assert_eq!(zones.zone(Vec2::new(5.0, 1.0)), None);
            }
            Err(fault) => {
                let text = fault.to_string();
                assert!(!text.is_empty() && text.len() < 2_000, "seed {seed}: {text}");
            }
        }
    }
    assert!(read > 10, "{read}");
}

#[test]
#[ignore = "half a minute"]
fn many_damaged_files_are_refused_or_read() {
    check_damages(FULL);
}
