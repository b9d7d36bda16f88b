//! Areas of a map where nobody may go, as GeoJSON in the metres of the map: what a route reads to
//! keep out of them.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use grouser::studies::mobility::{Ground, MobilityMap};
use grouser::studies::verdict::Verdict;
use grouser_raster::zones::geojson::LARGEST_FILE;
use rayon::prelude::*;

/// Verdicts of places that are kept out of.
const KEPT_OUT: [Verdict; 2] = [Verdict::NoGo, Verdict::CannotTell];

/// By which part of its size a cell's area is smaller than the cell on each side [-]: what touches
/// the cell beside it would close that one, too. Source: ours.
const INSET: f64 = 0.01;

/// Cells side by side and above each other: the first column and the one after the last, and the
/// first row and the one after the last.
type Block = [[usize; 2]; 2];

/// The areas of places that are a no-go, and of those of which nobody can tell, as a file that a
/// route keeps out of: a feature for each of both, with its `verdict`.
///
/// # Errors
/// Why there is no such file, as a part of a sentence.
pub fn keep_out(ground: Ground<'_>, map: &MobilityMap) -> Result<String, &'static str> {
    let grid = &ground.raster().grid;
    let verdicts_of = |row: usize| -> Vec<Option<Verdict>> {
        (0..grid.columns).map(|column| Some(ground.at(map, column, row)?.verdict)).collect()
    };
    let runs_of = |row: usize| {
        let verdicts = verdicts_of(row);
        let is_open = verdicts.iter().flatten().any(|it| !KEPT_OUT.contains(it));
        (KEPT_OUT.map(|verdict| runs(&verdicts, verdict)), is_open)
    };
    let rows: Vec<_> = (0..grid.rows).into_par_iter().map(runs_of).collect();
    if !rows.iter().any(|(_, is_open)| *is_open) {
        return Err("no cell is a go or a caution: nothing would be left to drive on");
    }
    let blocks = [0, 1].map(|of| blocks(rows.iter().map(|(runs, _)| &runs[of])));
    if blocks.iter().all(Vec::is_empty) {
        return Err("every cell is a go or a caution");
    }
    let system = ground.raster().coordinates.geojson_member();
    let mut text = format!("{{\"type\":\"FeatureCollection\",{system}\"features\":[");
    let there = KEPT_OUT.iter().zip(&blocks).filter(|(_, blocks)| !blocks.is_empty());
    for (place, (verdict, blocks)) in there.enumerate() {
        let comma = if place == 0 { "" } else { "," };
        let _ = write!(
            text,
            "{comma}\n{{\"type\":\"Feature\",\"properties\":{{\"verdict\":\"{}\"}},\
             \"geometry\":{{\"type\":\"MultiPolygon\",\"coordinates\":[",
            verdict.name()
        );
        for (place, block) in blocks.iter().enumerate() {
            text += if place == 0 { "\n" } else { ",\n" };
            add_ring(&mut text, corners(ground, block));
            if text.len() as u64 > LARGEST_FILE {
                return Err("its areas are more than a file of areas may have");
            }
        }
        text += "]}}";
    }
    Ok(text + "\n]}\n")
}

/// The runs of a verdict in a row: each with its first column and the one after its last.
fn runs(verdicts: &[Option<Verdict>], verdict: Verdict) -> Vec<[usize; 2]> {
    let mut runs = Vec::new();
    let mut begins = None;
    for (column, is_it) in verdicts.iter().map(|it| *it == Some(verdict)).chain([false]).enumerate()
    {
        match (begins, is_it) {
            (None, true) => begins = Some(column),
            (Some(first), false) => {
                runs.push([first, column]);
                begins = None;
            }
            _ => {}
        }
    }
    runs
}

/// Runs of one row after another that are alike, as one block.
fn blocks<'r>(rows: impl Iterator<Item = &'r Vec<[usize; 2]>>) -> Vec<Block> {
    let mut blocks: Vec<Block> = Vec::new();
    // The block of each run of the row before.
    let mut open: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    for (row, runs) in rows.enumerate() {
        let block_of = |run: &[usize; 2]| {
            let place = open.get(run).copied().unwrap_or_else(|| {
                blocks.push([*run, [row, row]]);
                blocks.len() - 1
            });
            blocks[place][1][1] = row + 1;
            (*run, place)
        };
        open = runs.iter().map(block_of).collect();
    }
    blocks
}

/// The south-western and the north-eastern corner of a block's cells [m].
fn corners(ground: Ground<'_>, [columns, rows]: &Block) -> [[f64; 2]; 2] {
    let grid = &ground.raster().grid;
    let edge = |place: usize, south_west: f64, spacing: f64, inset: f64| {
        // To the micrometre, which no map has.
        ((south_west + (place as f64 - 0.5 + inset) * spacing) * 1e6).round() / 1e6
    };
    let corner = |end: usize, inset: f64| {
        [
            edge(columns[end], grid.south_west.x, grid.spacing.x, inset),
            edge(rows[end], grid.south_west.y, grid.spacing.y, inset),
        ]
    };
    [corner(0, INSET), corner(1, -INSET)]
}

/// A polygon of one ring.
fn add_ring(text: &mut String, [[west, south], [east, north]]: [[f64; 2]; 2]) {
    let _ = write!(
        text,
        "[[[{west},{south}],[{east},{south}],[{east},{north}],[{west},{north}],[{west},{south}]]]"
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two rows alike are one block, and a gap ends it.
    #[test]
    fn runs_that_are_alike_are_one_block() {
        let (no, go) = (Some(Verdict::NoGo), Some(Verdict::Go));
        let rows = [[no, no, go, no], [no, no, None, go], [go, go, go, go], [no, no, go, go]];
        let rows = rows.map(|row| runs(&row, Verdict::NoGo));
        assert_eq!(rows[0], [[0, 2], [3, 4]]);
        let expected = [[[0, 2], [0, 2]], [[3, 4], [0, 1]], [[0, 2], [3, 4]]];
        assert_eq!(blocks(rows.iter()), expected);
    }
}
