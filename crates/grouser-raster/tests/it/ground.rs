//! The ground of the fixtures, as `tests/fixtures/make.py` has it.

use std::path::{Path, PathBuf};

use grouser_raster::Raster;

pub(crate) const COLUMNS: usize = 40;
pub(crate) const ROWS: usize = 30;
/// Height of the north-western cell [m].
pub(crate) const BASE: f64 = -2613.0;

/// The height at a cell, its row counted from the north [m]; none where it is missing.
pub(crate) fn height(column: usize, row: usize) -> Option<f64> {
    let plane = BASE + 0.25 * column as f64 - 0.5 * row as f64;
    let bump = if (column, row) == (20, 10) { 8.0 } else { 0.0 };
    (row != 29 || column >= 3).then_some(plane + bump)
}

/// Checks that a raster has these heights; rows are counted from the north.
pub(crate) fn check(raster: &Raster, within: f64, expected: impl Fn(usize, usize) -> Option<f64>) {
    assert_eq!((raster.grid.columns, raster.grid.rows), (COLUMNS, ROWS));
    for (column, row) in (0..ROWS).flat_map(|row| (0..COLUMNS).map(move |column| (column, row))) {
        let (found, expected) = (raster.height(column, ROWS - 1 - row), expected(column, row));
        let near = match (found, expected) {
            (Some(found), Some(expected)) => (found - expected).abs() <= within,
            (found, expected) => found == expected,
        };
        assert!(near, "{found:?}, not {expected:?}, at column {column}, row {row}");
    }
}

pub(crate) fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(name)
}
