//! Heights as text: a point in each line, x, y and z in metres, east, north and up.
//!
//! Numbers stand apart by spaces, tabs, commas or semicolons. A first line with a name for each
//! column says which are x, y and z; without one they are the first three, and those after them are
//! not used, which is said. Lines may come in any order. Empty lines, those that start with `#` or
//! `//`, and a title are passed over. Points lie on a regular grid, of which some may be
//! missing; a z of NaN is missing, too.

mod axis;
mod header;

use std::io::{BufRead, BufReader, Read, Write};

use grouser_core::terrain::ElevationGrid;
use grouser_core::units::Vec2;

use crate::error::{Fault, InnerFault, RasterError};
use crate::heights::{Heights, checked_cells};
use crate::{CELLS, CoordinateSystem, MapPath, Raster, ReadOptions, Remark, RowOrder};
use axis::Axis;
use header::{TextColumns, words};

/// Bytes of a line, at most.
const LONGEST: u64 = 1_000;
/// Cells of a grid for each point in the file, at most.
const EMPTY: u64 = 1_000;

/// Reads a file.
///
/// # Errors
/// [`RasterError`] with the file's name, and what to do.
pub fn read<'p>(
    path: impl Into<MapPath<'p>>,
    options: &ReadOptions,
) -> Result<Raster, RasterError> {
    let path = path.into();
    let raster = || decode(BufReader::new(path.opened()?), options);
    raster().map_err(|fault| RasterError::new(path.path, fault))
}

/// The text of a raster, a line for each point whose height is known, in rows from south to north.
///
/// # Errors
/// Those of the writer.
pub fn write(to: &mut impl Write, raster: &Raster) -> std::io::Result<()> {
    for row in 0..raster.grid.rows {
        for column in 0..raster.grid.columns {
            let Some(height) = raster.height(column, row) else { continue };
            let at = raster.grid.point(column, row);
            writeln!(to, "{} {} {}", at.x, at.y, height)?;
        }
    }
    Ok(())
}

/// Reads text.
///
/// # Errors
/// [`Fault`] if it does not have points of a grid, with the number of the line.
pub fn decode(text: impl BufRead, options: &ReadOptions) -> Result<Raster, Fault> {
    let points = TextPoints::read(text, options)?;
    let columns = Axis::of(&points.x).map_err(|fault| points.fault("x", &fault))?;
    let rows = Axis::of(&points.y).map_err(|fault| points.fault("y", &fault))?;
    let cells = checked_cells(columns.count, rows.count, options.cells.unwrap_or(CELLS))?;
    if cells as u64 / EMPTY > points.x.len() as u64 {
        let points = points.x.len();
        return Err(Fault::Sparse { points, columns: columns.count, rows: rows.count });
    }
    let across = usize::try_from(columns.count).unwrap_or(cells);
    let mut heights = Heights::new(cells, options.content);
    heights.fill()?;
    let mut taken = vec![0_u64; cells.div_ceil(64)];
    for (at, z) in points.z.iter().enumerate() {
        let (column, row) = (columns.index(points.x[at]), rows.index(points.y[at]));
        let cell = row * across + column;
        if (taken[cell / 64] >> (cell % 64)) & 1 == 1 {
            let problem = "this point was there before: each has one height".to_owned();
            return Err(Fault::Line { line: points.line(at), flaw: problem.into() });
        }
        taken[cell / 64] |= 1 << (cell % 64);
        if Some(*z) != options.missing {
            heights.set(cell, *z);
        }
    }
    let grid = ElevationGrid {
        columns: across,
        rows: usize::try_from(rows.count).unwrap_or(cells),
        south_west: Vec2::new(columns.first, rows.first),
        spacing: Vec2::new(columns.spacing, rows.spacing),
    };
    let mut raster = heights.raster(grid, RowOrder::SouthFirst, CoordinateSystem::default())?;
    raster.remarks.extend(points.remarks);
    Ok(raster)
}

/// The points of a file.
#[derive(Debug, Default)]
struct TextPoints {
    x: Vec<f64>,
    y: Vec<f64>,
    z: Vec<f64>,
    /// The number of each point's line, from 1.
    lines: Vec<u32>,
    /// What is odd about the columns.
    remarks: Vec<Remark>,
}

impl TextPoints {
    fn read(mut text: impl BufRead, options: &ReadOptions) -> Result<Self, Fault> {
        let limit = options.cells.unwrap_or(CELLS);
        let mut points = Self::default();
        let mut line = Vec::new();
        // The first words that are no numbers, and where the columns are once a point was seen.
        let (mut first, mut columns) = (None, None);
        for number in 1_u32.. {
            line.clear();
            if text.by_ref().take(LONGEST + 1).read_until(b'\n', &mut line)? == 0 {
                break;
            }
            let fault =
                |problem: String| Fault::Line { line: number as usize, flaw: problem.into() };
            if line.len() as u64 > LONGEST {
                return Err(fault(format!("it is longer than {LONGEST} bytes")));
            }
            let line = String::from_utf8_lossy(&line);
            let line = line.trim_start_matches('\u{feff}').trim();
            if line.is_empty() || header::is_comment(line) {
                first = first.or_else(|| header::of_comment(line));
                continue;
            }
            let words = words(line);
            if columns.is_none() && number == 1 && words.iter().all(|it| it.parse::<f64>().is_err())
            {
                first = Some(words.into_iter().map(str::to_owned).collect());
                continue;
            }
            if columns.is_none() {
                let found = TextColumns::of(first.take(), words.len())
                    .map_err(|flaw| Fault::Line { line: 1, flaw })?;
                points.remarks.extend(found.remark());
                columns = Some(found);
            }
            let point = columns.as_ref().map(|columns| columns.numbers(&words));
            let Some([x, y, z]) = point.transpose().map_err(fault)? else { continue };
            if !x.is_finite() || !y.is_finite() {
                return Err(fault("x and y must be finite".into()));
            }
            if points.x.len() as u64 == limit {
                return Err(Fault::TooLarge { columns: limit + 1, rows: 1, limit });
            }
            points.push([x, y, z], number);
        }
        if points.x.is_empty() { Err(Fault::NoPoints) } else { Ok(points) }
    }

    fn push(&mut self, [x, y, z]: [f64; 3], line: u32) {
        self.x.push(x);
        self.y.push(y);
        self.z.push(z);
        self.lines.push(line);
    }

    fn line(&self, point: usize) -> usize {
        self.lines[point] as usize
    }

    /// What is wrong along one axis, with the line where it shows.
    fn fault(&self, axis: &str, fault: &axis::Irregular) -> Fault {
        let flaw = match fault {
            axis::Irregular::OneValue => {
                format!("all points have the {axis} of this one: they make a line, not a grid")
                    .into()
            }
            axis::Irregular::Between { spacing, .. } => InnerFault::with_hint(
                format!(
                    "its {axis} is not on the grid of the other points, which are {spacing} m apart"
                ),
                |_| "gdal_grid makes a grid of scattered points".to_owned(),
            ),
        };
        let point = match fault {
            axis::Irregular::OneValue => 0,
            axis::Irregular::Between { point, .. } => *point,
        };
        Fault::Line { line: self.line(point), flaw }
    }
}
