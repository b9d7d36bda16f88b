//! Maps of heights in memory, which runs share.

use std::path::PathBuf;
use std::sync::Arc;

use grouser::document::unit::DEG;
use grouser::document::{BEYOND, HeldMap, Placement, ReadOptions, fnv_1a, read_map};
use grouser::error::ParameterError;
use grouser::terrain::elevation::{above, round_base};
use grouser::terrain::lunar::{LunarGround, LunarModel, LunarSite};
use grouser::terrain::{ElevationGrid, ElevationModel, Extent};
use grouser::units::{Vec2, Vec3};
use grouser_raster::{
    CoordinateSystem, Fault, GeoKeys, MapSite, check_grid, check_system, remarks,
};
use numpy::{
    PyArray1, PyArray2, PyArrayMethods as _, PyReadonlyArray1, PyReadonlyArray2,
    PyUntypedArrayMethods as _,
};
use pyo3::prelude::*;
use toml::{Table, Value};

use crate::errors;
use crate::threads::released;

/// The coordinate system of a map that has no file, which is checked.
///
/// * `text`: the system as well-known text, or as a code
fn system_of(
    py: Python<'_>,
    text: Option<&str>,
    grid: &ElevationGrid,
) -> PyResult<CoordinateSystem> {
    let Extent { south_west, north_east } = grid.extent();
    let size = north_east - south_west;
    let site = MapSite { middle: south_west + 0.5 * size, cell: grid.spacing.y, size };
    let found = match text {
        Some(text) => check_system(text, site),
        None => check_grid(grid).map(|()| None),
    };
    errors::warn(py, found.map_err(|fault| of_map(&fault))?)?;
    Ok(text.map(CoordinateSystem::of_text).unwrap_or_default())
}

/// A map without a file that is no map in metres.
fn of_map(fault: &Fault) -> PyErr {
    let (problem, hint) = fault.in_parts("map", None);
    let message = hint.into_iter().fold(problem, |all, hint| format!("{all}\nhint: {hint}"));
    errors::parameter(message, "heights_m", None, "coordinates and heights in metres")
}

/// Checks the unit that heights are stated in.
#[pyfunction]
pub(crate) fn check_height_unit(unit: &str) -> PyResult<()> {
    grouser_raster::check_unit(unit).map_err(|fault| of_map(&fault))
}

/// A map of heights.
#[pyclass(frozen, module = "grouser._core")]
pub(crate) struct Terrain {
    pub(crate) map: HeldMap,
}

/// How a file was read: cell size, and x and y of the point farthest to the south and west [m]; the
/// band; and the height that stands for a missing one [m].
type Reading = (Option<[f64; 3]>, Option<usize>, Option<f64>);
/// A map as numbers: its name, how its file was read, base [m], place of the first point and
/// distances of neighbours [m], heights above the base [m] in rows from south to north, and the system
/// of the coordinates.
type Parts<'py> = (
    String,
    Option<Reading>,
    f64,
    [f64; 2],
    [f64; 2],
    Bound<'py, PyArray2<f32>>,
    Option<SystemKeys>,
);
/// A system of coordinates as its keys: whole numbers, real ones and text.
type SystemKeys = (Vec<u16>, Vec<f64>, String);

#[pymethods]
impl Terrain {
    /// * `heights`: in rows along x [m]; NaN where they are missing
    /// * `south_west_m`: the point farthest to the south and west
    /// * `spacing_m`: distance between neighbours along x and y
    /// * `north_first`: whether the first row is the northern one
    /// * `crs`: the system of the coordinates, as well-known text or as a code
    #[new]
    #[allow(clippy::needless_pass_by_value, reason = "how an array comes from Python")]
    fn new(
        py: Python<'_>,
        heights: PyReadonlyArray2<'_, f64>,
        south_west_m: [f64; 2],
        spacing_m: [f64; 2],
        north_first: bool,
        crs: Option<&str>,
    ) -> PyResult<Self> {
        let heights = heights.as_array();
        let (rows, columns) = heights.dim();
        let grid = grid(rows, columns, south_west_m, spacing_m);
        let system = system_of(py, crs, &grid)?;
        let model = released(py, || {
            let row = |from_south: usize| {
                heights.row(if north_first { rows - 1 - from_south } else { from_south })
            };
            // From north to south, as files of the same heights are read: with the same base, the
            // same bits.
            let mut from_north = (0..rows).rev().flat_map(row);
            let base =
                from_north.find(|height| is_known(**height)).map_or(0.0, |it| round_base(*it));
            let kept =
                |height: &f64| if is_known(*height) { above(*height, base) } else { f32::NAN };
            let kept = (0..rows).flat_map(row).map(kept).collect();
            ElevationModel::above_base(grid, base, kept)
        })?;
        let model = model.map_err(|error| refused(&error.to_string()))?;
        let above: Vec<f32> = model.heights_above_base().collect();
        errors::warn(py, remarks(model.grid(), model.base(), &above))?;
        Ok(Self::of_model(model, system))
    }

    /// Reads a file.
    #[staticmethod]
    #[allow(clippy::needless_pass_by_value, reason = "how a path comes from Python")]
    fn from_file(py: Python<'_>, path: PathBuf, reading: Reading) -> PyResult<Self> {
        let read = released(py, || read_map(&path, options(reading)))?;
        let (map, remarks) = read.map_err(|error| errors::of_document(&error, &[]))?;
        errors::warn(py, remarks)?;
        Ok(Self { map })
    }

    /// Makes lunar ground.
    ///
    /// * `size_m`, `cell_size_m`, `largest_crater_m`: sides, distance of neighbours, largest
    ///   diameter
    #[staticmethod]
    fn lunar(
        py: Python<'_>,
        size_m: f64,
        cell_size_m: f64,
        ground: &str,
        crater_share: f64,
        largest_crater_m: f64,
        seed: u64,
    ) -> PyResult<Self> {
        let ground = LunarGround::ALL.into_iter().find(|it| it.name() == ground);
        let ground = ground.ok_or_else(|| {
            let names = LunarGround::ALL.map(LunarGround::name).join("' or '");
            errors::parameter(
                format!("ground must be '{names}'"),
                "ground",
                None,
                "a kind of ground",
            )
        })?;
        let site = LunarSite {
            size: size_m,
            cell_size: cell_size_m,
            ground,
            crater_share,
            largest_crater: largest_crater_m,
            seed,
        };
        let made = released(py, || {
            let LunarModel { grid, heights, .. } = site.model()?;
            // As files have them, and with the base of those that are read: its northern row comes
            // first.
            let north_west = heights[(grid.rows - 1) * grid.columns];
            let base = round_base(f64::from(above(north_west, 0.0)));
            let kept = |height: &f64| above(f64::from(above(*height, 0.0)), base);
            let kept = heights.iter().map(kept).collect();
            Ok(ElevationModel::above_base(grid, base, kept))
        })?;
        let model = made.map_err(|error: ParameterError| errors::of_parameter(&error))?;
        let of_model = |model| Self::of_model(model, CoordinateSystem::default());
        model.map(of_model).map_err(|error| refused(&error.to_string()))
    }

    /// The map that [`parts`](Self::parts) are of.
    #[staticmethod]
    #[allow(clippy::needless_pass_by_value, reason = "how an array comes from Python")]
    fn of_parts(
        name: String,
        reading: Option<Reading>,
        base: f64,
        south_west_m: [f64; 2],
        spacing_m: [f64; 2],
        heights: PyReadonlyArray2<'_, f32>,
        system: Option<SystemKeys>,
    ) -> PyResult<Self> {
        let heights = heights.as_array();
        let (rows, columns) = heights.dim();
        let grid = grid(rows, columns, south_west_m, spacing_m);
        let heights = heights.iter().copied().collect();
        let model = ElevationModel::above_base(grid, base, heights)
            .map_err(|error| refused(&error.to_string()))?;
        let (model, options) = (Arc::new(model), reading.map(options));
        let of_keys =
            |(directory, doubles, text)| CoordinateSystem::of_keys(directory, doubles, text);
        Ok(Self { map: HeldMap { name, model, options, system: system.map(of_keys) } })
    }

    /// What the map is made of.
    fn parts<'py>(&self, py: Python<'py>) -> PyResult<Parts<'py>> {
        let model = &self.map.model;
        let ElevationGrid { columns, rows, south_west, spacing } = *model.grid();
        let heights = PyArray1::from_iter(py, model.heights_above_base());
        let heights = heights.reshape([rows, columns])?;
        let reading = self.map.options.map(|ReadOptions { placement, band, missing, .. }| {
            let place = |it: Placement| [it.spacing.x, it.south_west.x, it.south_west.y];
            (placement.map(place), band, missing)
        });
        let name = self.map.name.clone();
        let system = self.map.system.as_ref().map(|system| {
            let GeoKeys { directory, doubles, text } = system.keys();
            (directory.to_vec(), doubles.to_vec(), text.to_owned())
        });
        Ok((name, reading, model.base(), south_west.into(), spacing.into(), heights, system))
    }

    /// x and y of its outermost points: of those to the west and south, and of those to the east
    /// and north [m].
    #[getter]
    fn extent(&self) -> [f64; 4] {
        let Extent { south_west, north_east } = self.map.model.extent();
        [south_west.x, south_west.y, north_east.x, north_east.y]
    }

    /// Rows and columns.
    #[getter]
    fn shape(&self) -> (usize, usize) {
        let grid = self.map.model.grid();
        (grid.rows, grid.columns)
    }

    /// Distance between neighbours along x and y [m].
    #[getter]
    fn spacing(&self) -> [f64; 2] {
        self.map.model.grid().spacing.into()
    }

    /// The system of the coordinates as text; none where it is not known.
    #[getter]
    fn crs(&self) -> Option<String> {
        self.map.system.as_ref()?.to_text()
    }

    /// The number of points whose height is missing.
    #[getter]
    fn missing(&self) -> usize {
        self.map.model.missing()
    }

    /// Heights of the ground over places [m], NaN where they are not known.
    #[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
    fn heights<'py>(
        &self,
        py: Python<'py>,
        x: PyReadonlyArray1<'py, f64>,
        y: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.each(py, &x, &y, ElevationModel::height)
    }

    /// Inclination of the ground at places, in degrees, NaN where it is not known.
    #[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
    fn slopes<'py>(
        &self,
        py: Python<'py>,
        x: PyReadonlyArray1<'py, f64>,
        y: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.each(py, &x, &y, |map, at| DEG.from_si(map.gradient(at).norm().atan()))
    }

    /// Unit vectors that stand on the ground at places, a row for each; NaN where it is not known.
    #[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
    fn normals<'py>(
        &self,
        py: Python<'py>,
        x: PyReadonlyArray1<'py, f64>,
        y: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let axes = [0, 1, 2].map(|axis| self.each(py, &x, &y, |map, at| normal(map, at)[axis]));
        let [x, y, z] = axes;
        let (x, y, z) = (x?.readonly(), y?.readonly(), z?.readonly());
        let (x, y, z) = (x.as_array(), y.as_array(), z.as_array());
        let rows = (0..x.len()).flat_map(|place| [x[place], y[place], z[place]]);
        PyArray1::from_iter(py, rows.collect::<Vec<_>>()).reshape([x.len(), 3])
    }

    /// Heights over places [m] as a wheel meets them: beyond what is known they go on as at the
    /// nearest edge.
    #[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
    fn ground<'py>(
        &self,
        py: Python<'py>,
        x: PyReadonlyArray2<'py, f64>,
        y: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let shape = [x.shape()[0], x.shape()[1]];
        let places = x.as_array().into_iter().copied().zip(y.as_array().into_iter().copied());
        let heights = places.map(|(x, y)| self.map.model.height(Vec2::new(x, y)));
        PyArray1::from_iter(py, heights).reshape(shape)
    }

    /// Whether both have the same heights at the same places.
    fn __eq__(&self, other: &Self) -> bool {
        let (one, other) = (&self.map.model, &other.map.model);
        let is_like = || {
            let bits = |model: &ElevationModel| model.base().to_bits();
            let heights = one.heights_above_base().map(f32::to_bits);
            one.grid() == other.grid()
                && bits(one) == bits(other)
                && heights.eq(other.heights_above_base().map(f32::to_bits))
        };
        Arc::ptr_eq(one, other) || is_like()
    }
}

impl Terrain {
    /// The map of a document that was read with it.
    pub(crate) fn of_map(map: HeldMap) -> Self {
        Self { map }
    }

    fn of_model(model: ElevationModel, system: CoordinateSystem) -> Self {
        let name = format!("heights-{:016x}", fingerprint(&model));
        let (model, system) = (Arc::new(model), Some(system));
        Self { map: HeldMap { name, model, options: None, system } }
    }

    /// The table of a document that names the map.
    pub(crate) fn table(&self) -> Table {
        let mut table = Table::new();
        table.insert("file".to_owned(), Value::String(self.map.name.clone()));
        let Some(options) = &self.map.options else { return table };
        if let Some(placement) = &options.placement {
            table.insert("cell_size_m".to_owned(), Value::Float(placement.spacing.x));
            let place: [f64; 2] = placement.south_west.into();
            let place = place.into_iter().map(Value::Float).collect();
            table.insert("south_west_m".to_owned(), Value::Array(place));
        }
        if let Some(band) = options.band.and_then(|band| i64::try_from(band).ok()) {
            table.insert("band".to_owned(), Value::Integer(band));
        }
        if let Some(missing) = options.missing {
            table.insert("missing_m".to_owned(), Value::Float(missing));
        }
        table
    }

    fn each<'py>(
        &self,
        py: Python<'py>,
        x: &PyReadonlyArray1<'py, f64>,
        y: &PyReadonlyArray1<'py, f64>,
        number: impl Fn(&ElevationModel, Vec2) -> f64 + Sync,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let (x, y, model) = (x.as_slice()?, y.as_slice()?, &*self.map.model);
        let at = |(x, y): (&f64, &f64)| {
            let place = Vec2::new(*x, *y);
            if model.is_known(place) { number(model, place) } else { f64::NAN }
        };
        let found: Vec<f64> = released(py, || x.iter().zip(y).map(at).collect())?;
        Ok(PyArray1::from_vec(py, found))
    }
}

fn options((placement, band, missing): Reading) -> ReadOptions {
    let placement = placement.map(|[size, x, y]| Placement::north_first(Vec2::new(x, y), size));
    ReadOptions { placement, band, missing, ..ReadOptions::default() }
}

/// Whether a height is not missing.
fn is_known(height: f64) -> bool {
    height.abs() < BEYOND
}

/// The unit vector that stands on the ground.
fn normal(map: &ElevationModel, at: Vec2) -> Vec3 {
    let rise = map.gradient(at);
    Vec3::new(-rise.x, -rise.y, 1.0).normalize()
}

fn grid(rows: usize, columns: usize, south_west: [f64; 2], spacing: [f64; 2]) -> ElevationGrid {
    ElevationGrid { columns, rows, south_west: south_west.into(), spacing: spacing.into() }
}

/// A number by which a map is known again.
fn fingerprint(model: &ElevationModel) -> u64 {
    let ElevationGrid { columns, south_west, spacing, .. } = *model.grid();
    let numbers = [south_west.x, south_west.y, spacing.x, spacing.y, model.base()];
    let place = numbers.into_iter().flat_map(f64::to_le_bytes);
    let heights = model.heights_above_base().flat_map(|height| height.to_bits().to_le_bytes());
    fnv_1a((columns as u64).to_le_bytes().into_iter().chain(place).chain(heights))
}

fn refused(message: &str) -> PyErr {
    errors::parameter(message.to_owned(), "heights", None, "a map of heights")
}
