//! What a map has in all, before it is written.

use grouser::answers::map::{MapFile, VerdictCounts};
use grouser::document::columns::map::verdict_number;
use grouser::studies::mobility::{CellMotion, Ground, MobilityMap};
use rayon::prelude::*;

use crate::MapColumn;

/// The numbers of a band in all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandSummary {
    /// How many places have a number.
    pub known: u64,
    /// The least, in the band's unit; NaN if there is none.
    pub least: f64,
    /// The largest.
    pub most: f64,
    /// Their mean.
    pub mean: f64,
}

/// The file of each band, and the band's numbers in all.
///
/// * `path_of`: where a file of a name is
#[must_use]
pub fn band_files(
    bands: &[MapColumn],
    sums: &[BandSummary],
    path_of: &dyn Fn(&str) -> String,
) -> Vec<MapFile> {
    let file = |(band, of): (&MapColumn, &BandSummary)| MapFile {
        name: band.name,
        unit: band.unit,
        about: band.doc,
        least: of.least,
        mean: of.mean,
        most: of.most,
        cells: of.known,
        path: path_of(&format!("{}.tif", band.name)),
    };
    bands.iter().zip(sums).map(file).collect()
}

/// The summary of each band, and how many places have each verdict.
#[must_use]
pub fn summaries(
    ground: Ground<'_>,
    map: &MobilityMap,
    bands: &[MapColumn],
) -> (Vec<BandSummary>, VerdictCounts) {
    let grid = &ground.raster().grid;
    let of_row = |row: usize| {
        let mut all = Sums::new(bands.len());
        for column in 0..grid.columns {
            all.add(ground.at(map, column, row), bands);
        }
        all
    };
    // Sums of rows are added in their order, so that the means have the same bits on every machine.
    let rows: Vec<Sums> = (0..grid.rows).into_par_iter().map(of_row).collect();
    let all = rows.iter().fold(Sums::new(bands.len()), Sums::with);
    let [unknown, go, caution, no_go, cannot_tell] = all.verdicts;
    let verdicts = VerdictCounts { go, caution, cannot_tell, no_go, unknown };
    (all.bands.iter().map(Sum::summary).collect(), verdicts)
}

struct Sums {
    bands: Vec<Sum>,
    verdicts: [u64; 5],
}

#[derive(Clone, Copy)]
struct Sum {
    known: u64,
    least: f64,
    most: f64,
    total: f64,
}

impl Sums {
    fn new(bands: usize) -> Self {
        let none = Sum { known: 0, least: f64::NAN, most: f64::NAN, total: 0.0 };
        Self { bands: vec![none; bands], verdicts: [0; 5] }
    }

    fn add(&mut self, cell: Option<CellMotion>, bands: &[MapColumn]) {
        let Some(cell) = cell else {
            self.verdicts[0] += 1;
            return;
        };
        self.verdicts[usize::from(verdict_number(cell.verdict))] += 1;
        for (sum, band) in self.bands.iter_mut().zip(bands) {
            let number = band.number(&cell);
            if !number.is_nan() {
                sum.add(&Sum { known: 1, least: number, most: number, total: number });
            }
        }
    }

    fn with(mut self, other: &Self) -> Self {
        self.bands.iter_mut().zip(&other.bands).for_each(|(sum, other)| sum.add(other));
        self.verdicts.iter_mut().zip(other.verdicts).for_each(|(sum, other)| *sum += other);
        self
    }
}

impl Sum {
    fn add(&mut self, other: &Self) {
        self.known += other.known;
        self.least = self.least.min(other.least);
        self.most = self.most.max(other.most);
        self.total += other.total;
    }

    fn summary(&self) -> BandSummary {
        let mean = self.total / self.known as f64;
        BandSummary { known: self.known, least: self.least, most: self.most, mean }
    }
}
