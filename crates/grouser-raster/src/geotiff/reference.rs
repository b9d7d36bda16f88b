//! Where the cells of a GeoTIFF lie.

use grouser_core::terrain::ElevationGrid;
use grouser_core::units::Vec2;

use super::advice;
use super::affine::Affine;
use crate::coordinate_system::{CoordinateSystem, key};
use crate::error::Fault;
use crate::{Placement, RowOrder};

/// What a file says of its place.
#[derive(Clone, Debug)]
pub(super) struct Georeference<'s> {
    pub(super) system: &'s CoordinateSystem,
    /// Size of a cell: `ModelPixelScaleTag`.
    pub(super) scale: Vec<f64>,
    /// A place in the raster, and on the map: `ModelTiepointTag`.
    pub(super) tiepoint: Vec<f64>,
    /// The same as a matrix, four by four: `ModelTransformationTag`.
    pub(super) matrix: Vec<f64>,
}

impl Georeference<'_> {
    /// The points of the grid, and which row comes first.
    ///
    /// * `placement`: for files that do not say so themselves
    pub(super) fn grid(
        &self,
        columns: usize,
        rows: usize,
        placement: Option<Placement>,
    ) -> Result<(ElevationGrid, RowOrder), Fault> {
        let Some(affine) = self.affine() else {
            let placement = placement.ok_or(Fault::NotReferenced)?;
            return Ok((placement.grid(columns, rows), placement.rows));
        };
        self.check_coordinates(&affine, columns, rows)?;
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
        Ok((ElevationGrid { columns, rows, south_west, spacing }, order))
    }

    /// The place of the cells, by tiepoint and scale, else by the matrix, as GDAL takes them.
    fn affine(&self) -> Option<Affine> {
        // What is counted from the middle of the first cell is half a cell off the corner.
        let shift =
            if self.system.number(key::POINTS_OR_AREAS) == Some(POINTS) { 0.5 } else { 0.0 };
        let affine = match (&*self.scale, &*self.tiepoint, &*self.matrix) {
            ([width, height, ..], [i, j, _, x, y, ..], _) if *width != 0.0 && *height != 0.0 => {
                let (column, row) = (i + shift, j + shift);
                let height = height.abs();
                let (x0, y0) = (x - column * width, y + row * height);
                Affine { x0, y0, a: *width, b: 0.0, c: 0.0, d: -height }
            }
            (_, _, [a, b, _, x, c, d, _, y, ..]) => {
                let (x0, y0) = (x - shift * (a + b), y - shift * (c + d));
                Affine { x0, y0, a: *a, b: *b, c: *c, d: *d }
            }
            _ => return None,
        };
        let Affine { x0, y0, a, b, c, d } = affine;
        let finite = [x0, y0, a, b, c, d].into_iter().all(f64::is_finite);
        (finite && a * d - b * c != 0.0).then_some(affine)
    }

    /// Checks that coordinates are those of a map, in metres.
    fn check_coordinates(&self, affine: &Affine, columns: usize, rows: usize) -> Result<(), Fault> {
        let system = self.system;
        let is_projected =
            system.number(key::PROJECTED).or(system.number(key::PROJECTION)).is_some();
        let model = system.number(key::MODEL);
        if model == Some(GEOCENTRIC) {
            return Err(Fault::Geocentric);
        }
        let has_degrees = model == Some(GEOGRAPHIC) || system.number(key::GEODETIC).is_some();
        if model != Some(PROJECTED) && !is_projected && has_degrees {
            let command = advice::projection(system, affine, columns, rows);
            return Err(Fault::Degrees { command });
        }
        if let Some(unit) = self.foreign_unit() {
            return Err(Fault::Unit { unit });
        }
        match system.number(key::VERTICAL_UNIT) {
            None | Some(0 | METRE) => Ok(()),
            Some(code) => Err(Fault::HeightUnit { unit: unit_name(code) }),
        }
    }

    /// The unit of the coordinates, if that is not the metre.
    fn foreign_unit(&self) -> Option<String> {
        match self.system.number(key::LINEAR_UNIT) {
            // Registered systems without a unit of their own have that of the register, mostly
            // metres.
            None | Some(0 | METRE) => None,
            Some(key::USER_DEFINED) => {
                let size = self.system.real(key::LINEAR_UNIT_SIZE).unwrap_or(1.0);
                (size != 1.0).then(|| format!("units of {size} m"))
            }
            Some(code) => Some(unit_name(code)),
        }
    }
}

/// Values of the key `GTModelTypeGeoKey`.
const PROJECTED: u16 = 1;
const GEOGRAPHIC: u16 = 2;
const GEOCENTRIC: u16 = 3;
/// Value of the key `GTRasterTypeGeoKey`: cells are points.
const POINTS: u16 = 2;
/// The metre's code in the EPSG register.
const METRE: u16 = 9001;

/// A unit by its code in the EPSG register.
fn unit_name(code: u16) -> String {
    match code {
        9002 => "feet".into(),
        9003 => "US survey feet".into(),
        9036 => "kilometres".into(),
        code => format!("a unit with the code EPSG:{code}"),
    }
}
