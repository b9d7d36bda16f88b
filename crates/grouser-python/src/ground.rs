//! The planes under wheels on uneven ground, for engines of rigid bodies.

use grouser::terrain::footprint::POINTS;
use grouser::terrain::{Footprint, GroundFrame, HeightField};
use grouser::units::{Vec2, Vec3};
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::errors;

/// The footprints of some wheels.
#[pyclass(frozen, module = "grouser._core")]
pub(crate) struct Footprints {
    /// Shearing radius and width of each wheel [m].
    sizes: Vec<(f64, f64)>,
}

/// x and y of points, a row for each wheel [m].
type Points<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>);
/// The plane under each wheel: its normal in the world, and the hub's distance from it [m].
type Planes<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>);

#[pymethods]
impl Footprints {
    #[new]
    #[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
    fn new(
        shearing_radius_m: PyReadonlyArray1<'_, f64>,
        width_m: PyReadonlyArray1<'_, f64>,
    ) -> Self {
        let (radii, widths) = (shearing_radius_m.as_array(), width_m.as_array());
        Self { sizes: radii.iter().copied().zip(widths.iter().copied()).collect() }
    }

    /// The places whose heights tell the ground under each wheel, in the ground's frame.
    ///
    /// * `origin`, `axes`: of the ground's frame in the world, the axes as columns of a matrix
    /// * `hubs`, `axles`: of each wheel, in the world
    #[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
    fn points<'py>(
        &self,
        py: Python<'py>,
        origin: [f64; 3],
        axes: [f64; 9],
        hubs: PyReadonlyArray2<'py, f64>,
        axles: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Points<'py>> {
        let wheels = self.wheels(&GroundFrame::new(origin, axes), &hubs, &axles)?;
        let points: Vec<_> =
            wheels.iter().map(|(footprint, hub)| footprint.points(hub.xy())).collect();
        let rows = |axis: usize| {
            let row = |points: &[Vec2; POINTS]| points.iter().map(|point| point[axis]).collect();
            let rows: Vec<Vec<f64>> = points.iter().map(row).collect();
            PyArray2::from_vec2(py, &rows)
        };
        Ok((rows(0)?, rows(1)?))
    }

    /// The plane under each wheel through the ground at those places.
    ///
    /// * `heights`: there [m]
    #[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
    fn planes<'py>(
        &self,
        py: Python<'py>,
        origin: [f64; 3],
        axes: [f64; 9],
        hubs: PyReadonlyArray2<'py, f64>,
        axles: PyReadonlyArray2<'py, f64>,
        heights: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Planes<'py>> {
        let heights = heights.as_array();
        if heights.dim() != (self.sizes.len(), POINTS) {
            let expected = format!("shape ({}, {POINTS})", self.sizes.len());
            let message =
                format!("the heights have shape {:?}, it must be {expected}", heights.dim());
            return Err(errors::parameter(message, "ground", None, expected));
        }
        let frame = GroundFrame::new(origin, axes);
        let wheels = self.wheels(&frame, &hubs, &axles)?;
        planes(
            py,
            wheels.iter().enumerate().map(|(place, (footprint, hub))| {
                let heights = std::array::from_fn(|point| heights[(place, point)]);
                frame.plane(footprint.fit(&heights), *hub)
            }),
        )
    }

    /// The same on a height field.
    ///
    /// * `field`: heights in rows along x
    /// * `half_size`: half of its size along x and y [m]
    /// * `unit`: what a height of 1 means [m]
    #[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
    #[allow(clippy::too_many_arguments, reason = "a frame, wheels and a field")]
    fn planes_on_field<'py>(
        &self,
        py: Python<'py>,
        origin: [f64; 3],
        axes: [f64; 9],
        hubs: PyReadonlyArray2<'py, f64>,
        axles: PyReadonlyArray2<'py, f64>,
        field: PyReadonlyArray2<'py, f32>,
        half_size: [f64; 2],
        unit: f64,
    ) -> PyResult<Planes<'py>> {
        let (columns, heights) = (field.as_array().ncols(), field.as_slice()?);
        let Some(field) = HeightField::new(heights, columns, half_size.into(), unit) else {
            let message = "the height field has fewer than two rows or columns".to_owned();
            return Err(errors::parameter(message, "ground", None, "two rows and columns or more"));
        };
        let frame = GroundFrame::new(origin, axes);
        let wheels = self.wheels(&frame, &hubs, &axles)?;
        planes(py, wheels.iter().map(|(footprint, hub)| frame.plane_on(&field, *footprint, *hub)))
    }
}

impl Footprints {
    /// The footprint of each wheel and its hub, in the ground's frame.
    fn wheels(
        &self,
        frame: &GroundFrame,
        hubs: &PyReadonlyArray2<'_, f64>,
        axles: &PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Vec<(Footprint, Vec3)>> {
        let (hubs, axles) = (hubs.as_array(), axles.as_array());
        if [hubs.dim(), axles.dim()] != [(self.sizes.len(), 3); 2] {
            let expected = format!("shape ({}, 3)", self.sizes.len());
            let message = format!("hubs and axles must have {expected}");
            return Err(errors::parameter(message, "hubs", None, expected));
        }
        let wheels = self.sizes.iter().enumerate().map(|(place, &(radius, width))| {
            let [hub, axle] = [hubs, axles]
                .map(|all| Vec3::new(all[(place, 0)], all[(place, 1)], all[(place, 2)]));
            frame.footprint(hub, axle, radius, width)
        });
        Ok(wheels.collect())
    }
}

/// Normals and distances as arrays.
fn planes(py: Python<'_>, planes: impl Iterator<Item = (Vec3, f64)>) -> PyResult<Planes<'_>> {
    let rows = planes.map(|(normal, distance)| (normal.as_slice().to_vec(), distance));
    let (normals, distances): (Vec<Vec<f64>>, Vec<f64>) = rows.unzip();
    Ok((PyArray2::from_vec2(py, &normals)?, PyArray1::from_vec(py, distances)))
}
