//! Slip from the currents of motors, for arrays of readings.

use grouser::document::columns::slip_from_current::ESTIMATE;
use grouser::document::columns::{
    COURSE, CURRENT, LOAD, Quantity, SLIP_ANGLE, SLOPE, STEERING, WHEEL_SPEED, YAW,
};
use grouser::document::measurements::motor_log::COLUMNS;
use grouser::document::table::Table;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::slip_from_current::{
    MotorLog, MotorReading, MotorRecord, NoEstimator, SlipEstimate, SlipEstimator, SlipSettings,
    TorqueNoise,
};
use numpy::ndarray::ArrayView2;
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::table_to_python;
use crate::descriptions::Document;
use crate::studies::Problem;
use crate::wheels::check_or_nan;
use crate::{errors, threads};

/// An estimator, prepared for a rover and a soil.
#[pyclass(frozen, module = "grouser._core")]
pub(crate) struct SlipFromCurrent {
    estimator: SlipEstimator,
}

/// Arrays of records and wheels, by their quantities, in the units of their names.
type OfWheels<'py> = PyReadonlyArray2<'py, f64>;
type OfRecords<'py> = PyReadonlyArray1<'py, f64>;

#[pymethods]
impl SlipFromCurrent {
    /// * `samples`: of soil and model; 0 to take the soil as known
    #[new]
    fn new(
        py: Python<'_>,
        scenario: &Document,
        noise: [f64; 2],
        slips: [f64; 2],
        samples: u32,
        seed: u64,
    ) -> PyResult<Self> {
        let loaded = scenario.scenario()?;
        let [relative, absolute] = noise;
        let settings = SlipSettings { noise: TorqueNoise { relative, absolute }, slips };
        let inputs = BandInputs::of_scenario(loaded);
        let samples = threads::detached(py, || inputs.samples(seed, samples))?;
        let samples = samples.map_err(|error| Problem::Sampling(error).raised())?;
        let estimator = SlipEstimator::new(&loaded.value, samples, settings);
        let estimator = estimator.map_err(|error| match error {
            NoEstimator::NoMotor => {
                errors::parameter(error.to_string(), "rover", None, "a rover with a motor")
            }
            NoEstimator::Parameter(error) => errors::of_parameter(&error),
        })?;
        Ok(Self { estimator })
    }

    /// The names of the wheels.
    #[getter]
    fn wheel_names(&self) -> Vec<String> {
        self.estimator.rover().mounts().iter().map(|mount| mount.name.clone()).collect()
    }

    /// Columns of [`ESTIMATE`], a row for each record and wheel in turn. What is NaN was not read;
    /// a row without current or speed is NaN and None.
    ///
    /// * `of_wheels`: current, speed, load, slip angle and steering angle: a row for each record, a
    ///   column for each wheel
    /// * `of_records`: slope, yaw and course
    #[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
    fn estimate<'py>(
        &self,
        py: Python<'py>,
        of_wheels: [OfWheels<'py>; 5],
        of_records: [OfRecords<'py>; 3],
    ) -> PyResult<Bound<'py, PyDict>> {
        for (quantity, array) in
            [CURRENT, WHEEL_SPEED, LOAD, SLIP_ANGLE, STEERING].iter().zip(&of_wheels)
        {
            check(*quantity, array.as_slice()?)?;
        }
        for (quantity, array) in [SLOPE, YAW, COURSE].iter().zip(&of_records) {
            check(*quantity, array.as_slice()?)?;
        }
        let [currents, speeds, loads, angles, steerings] =
            of_wheels.each_ref().map(|it| it.as_array());
        let [slopes, yaws, courses] = of_records.each_ref().map(|it| it.as_array());
        let (count, wheels) = (currents.shape()[0], self.estimator.rover().mounts().len());
        let known = |number: f64, quantity: Quantity| {
            (!number.is_nan()).then(|| quantity.unit.to_si(number))
        };
        let at = |array: &ArrayView2<'_, f64>, quantity, record: usize, wheel: usize| {
            known(array[[record, wheel]], quantity)
        };
        let reading = |record, wheel| {
            Some(MotorReading {
                current: at(&currents, CURRENT, record, wheel)?,
                wheel_speed: at(&speeds, WHEEL_SPEED, record, wheel)?,
                load: at(&loads, LOAD, record, wheel),
                slip_angle: at(&angles, SLIP_ANGLE, record, wheel),
                steering: at(&steerings, STEERING, record, wheel),
                slip_ratio: None,
            })
        };
        let records = (0..count).map(|record| MotorRecord {
            time: 0.0,
            slope: known(slopes[record], SLOPE),
            yaw: known(yaws[record], YAW),
            course: known(courses[record], COURSE),
            wheels: (0..wheels).map(|wheel| reading(record, wheel)).collect(),
        });
        let log = MotorLog { records: records.collect() };
        let found = threads::detached(py, || self.estimator.of_log(&log, &|| true))?;
        // It is not stopped.
        let found = found.unwrap_or_default();
        let rows: Vec<Option<&SlipEstimate>> = found.iter().flatten().map(Option::as_ref).collect();
        table_to_python(py, Table::default().and(&ESTIMATE, &rows))
    }
}

/// Checks that numbers are in the range of a log's column, or NaN where nothing was read.
fn check(quantity: Quantity, values: &[f64]) -> PyResult<()> {
    let column = COLUMNS.iter().find(|column| column.name == quantity.name);
    column.map_or(Ok(()), |column| check_or_nan(quantity.name, values, &column.range))
}
