//! Where the cells of a GeoTIFF lie.

use grouser_core::terrain::ElevationGrid;
use grouser_core::units::Vec2;

use super::affine::Affine;
use super::beside::Sidecars;
use crate::coordinate_system::{CoordinateSystem, key};
use crate::error::Fault;
use crate::meaning::{MapSite, check_keys, check_system};
use crate::remark::Remark;
use crate::{Placement, RowOrder};

/// What a file says of its place.
pub(super) struct Georeference<'s> {
    /// The system of the file itself.
    pub(super) system: CoordinateSystem,
    /// What lies beside the file.
    pub(super) beside: &'s Sidecars,
    /// Size of a cell: `ModelPixelScaleTag`.
    pub(super) scale: Vec<f64>,
    /// A place in the raster, and on the map: `ModelTiepointTag`.
    pub(super) tiepoint: Vec<f64>,
    /// The same as a matrix, four by four: `ModelTransformationTag`.
    pub(super) matrix: Vec<f64>,
}

/// The points of a grid.
pub(super) struct PlacedGrid {
    pub(super) grid: ElevationGrid,
    /// Which row comes first.
    pub(super) order: RowOrder,
    /// The system of its coordinates.
    pub(super) system: CoordinateSystem,
    /// What is odd about the system of their coordinates.
    pub(super) remark: Option<Remark>,
}

impl Georeference<'_> {
    /// The points of the grid.
    ///
    /// * `placement`: for files that do not say so themselves
    pub(super) fn grid(
        self,
        columns: usize,
        rows: usize,
        placement: Option<Placement>,
    ) -> Result<PlacedGrid, Fault> {
        let own = || self.affine().or(self.beside.world);
        let Some(affine) = self.beside.notes.place.or_else(own).filter(Affine::is_regular) else {
            let placement = placement.ok_or(Fault::NotReferenced)?;
            let (grid, order) = (placement.grid(columns, rows), placement.rows);
            return Ok(PlacedGrid { grid, order, system: self.system, remark: None });
        };
        let middle = affine.middle(0.5 * (columns as f64 - 1.0), 0.5 * (rows as f64 - 1.0));
        let size = Vec2::new(columns as f64 * affine.a.abs(), rows as f64 * affine.d.abs());
        let site = MapSite { middle, cell: affine.d.abs(), size };
        let noted = self.beside.notes.system.as_deref();
        let remark =
            noted.map_or_else(|| check_keys(&self.system, site), |it| check_system(it, site))?;
        let system = noted.map_or(self.system, CoordinateSystem::of_text);
        // What the rounding of sines may leave of a rotation by nothing [-].
        const LEVEL: f64 = 1e-9;
        let Affine { a, b, c, d, .. } = affine;
        if b.abs().max(c.abs()) > LEVEL * a.abs().min(d.abs()) || a <= 0.0 {
            return Err(Fault::Rotated);
        }
        let order = if d < 0.0 { RowOrder::NorthFirst } else { RowOrder::SouthFirst };
        let southern = if d < 0.0 { (rows - 1) as f64 } else { 0.0 };
        let south_west = affine.middle(0.0, southern);
        let spacing = Vec2::new(a, d.abs());
        let grid = ElevationGrid { columns, rows, south_west, spacing };
        Ok(PlacedGrid { grid, order, system, remark })
    }

    /// The place of the cells, by tiepoint and scale, else by the matrix, as GDAL takes them.
    fn affine(&self) -> Option<Affine> {
        // What is counted from the middle of the first cell is half a cell off the corner.
        let shift =
            if self.system.number(key::POINTS_OR_AREAS) == Some(POINTS) { 0.5 } else { 0.0 };
        match (&*self.scale, &*self.tiepoint, &*self.matrix) {
            ([width, height, ..], [i, j, _, x, y, ..], _) if *width != 0.0 && *height != 0.0 => {
                let (column, row) = (i + shift, j + shift);
                let height = height.abs();
                let (x0, y0) = (x - column * width, y + row * height);
                Some(Affine { x0, y0, a: *width, b: 0.0, c: 0.0, d: -height })
            }
            (_, _, [a, b, _, x, c, d, _, y, ..]) => {
                let (x0, y0) = (x - shift * (a + b), y - shift * (c + d));
                Some(Affine { x0, y0, a: *a, b: *b, c: *c, d: *d })
            }
            _ => None,
        }
    }
}

/// Value of the key `GTRasterTypeGeoKey`: cells are points.
const POINTS: u16 = 2;
