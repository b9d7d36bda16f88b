//! The soil's reaction over the time steps of an engine of rigid bodies.

use grouser::contact::time_step::{FORCES, MOTIONS, REST_SPEED, SINKAGE_DAMPING};
use grouser::contact::{Settled, SteppedWheel, SteppingWheel, Theory, TimeStep};
use grouser::document::columns::wheel::WHEEL;
use grouser::document::columns::{SLIP_ANGLE, SLIP_RATIO};
use grouser::soil::Soil;
use grouser::wheel::Wheel;
use nalgebra::{DMatrix, DVector};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::columns::{wheel_names, wheel_row};
use crate::descriptions::Document;
use crate::errors;
use crate::wheels::model_and_gravity;

/// Wheels and the soils under them, whose reaction is computed at every step.
#[pyclass(frozen, module = "grouser._core")]
pub(crate) struct SteppingWheels {
    wheels: Vec<(Wheel, Soil, Theory)>,
    gravity: f64,
    damping: f64,
    rest_speed: f64,
}

/// Results of wheels, a row for each name; and how far the motion is from the forces' [m/s].
type Answer<'py> = (Bound<'py, PyArray2<f64>>, f64);

#[pymethods]
impl SteppingWheels {
    /// * `soils`, `wheels`: one for each wheel
    /// * `setting`: a scenario that gives gravity, and a wheel–soil model where it names one
    #[new]
    #[allow(clippy::needless_pass_by_value, reason = "how lists come from Python")]
    fn new(
        soils: Vec<PyRef<'_, Document>>,
        wheels: Vec<PyRef<'_, Document>>,
        setting: &Document,
        sinkage_damping_s_m: f64,
        rest_speed_m_s: f64,
    ) -> PyResult<Self> {
        for (name, value, least) in [
            ("sinkage_damping_s_m", sinkage_damping_s_m, 0.0),
            ("rest_speed_m_s", rest_speed_m_s, f64::MIN_POSITIVE),
        ] {
            if !(value.is_finite() && value >= least) {
                let expected = if least > 0.0 { "above zero" } else { "zero or more" };
                let message = format!("{name} is {value}, it must be {expected}");
                return Err(errors::parameter(message, name, Some(value), expected));
            }
        }
        let made = soils.iter().zip(&wheels).map(|(soil, wheel)| {
            let (theory, _) = model_and_gravity(soil, setting)?;
            Ok((wheel.wheel()?.value, soil.soil()?.value, theory))
        });
        Ok(Self {
            wheels: made.collect::<PyResult<_>>()?,
            gravity: setting.scenario()?.value.site.gravity,
            damping: sinkage_damping_s_m,
            rest_speed: rest_speed_m_s,
        })
    }

    /// Names of the results.
    #[getter]
    #[allow(clippy::unused_self, reason = "how a property comes from Python")]
    fn names(&self) -> Vec<&'static str> {
        wheel_names().chain([SLIP_RATIO.name, SLIP_ANGLE.name]).collect()
    }

    /// Shearing radius of each wheel [m].
    #[getter]
    fn shearing_radius_m<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, self.wheels.iter().map(|(wheel, ..)| wheel.shearing_radius()))
    }

    /// The reaction over a step.
    ///
    /// * `sinkage`: at its start [m]
    /// * `free`: velocities at its end without the soil [m/s], four for each wheel
    /// * `inverse_mass`: the effective inverse mass J M⁻¹ Jᵀ (Delassus matrix): a row for each velocity, a column
    ///   for each of six forces a wheel
    #[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
    fn reaction<'py>(
        &self,
        py: Python<'py>,
        duration_s: f64,
        sinkage: PyReadonlyArray1<'py, f64>,
        free: PyReadonlyArray1<'py, f64>,
        inverse_mass: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Answer<'py>> {
        let (sinkages, free, inverse_mass) =
            (sinkage.as_slice()?, free.as_slice()?, inverse_mass.as_slice()?);
        let count = self.wheels.len();
        let (rows, columns) = (MOTIONS * count, FORCES * count);
        let lengths = [sinkages.len(), free.len(), inverse_mass.len()];
        let all = sinkages.iter().chain(free).chain(inverse_mass);
        if lengths != [count, rows, rows * columns] || !all.copied().all(f64::is_finite) {
            let message = "the motion of the wheels is not finite, or not theirs".to_owned();
            return Err(errors::parameter(message, "data", None, "a motion of the model"));
        }
        let step = TimeStep {
            duration: duration_s,
            gravity: self.gravity,
            damping: self.damping,
            rest_speed: self.rest_speed,
            inverse_mass: &DMatrix::from_row_slice(rows, columns, inverse_mass),
            free: &DVector::from_column_slice(free),
        };
        let wheels = self.wheels.iter().zip(sinkages);
        let wheels = wheels.map(|(&(wheel, soil, theory), &sinkage)| SteppingWheel {
            model: theory.model(),
            wheel,
            soil,
            sinkage,
        });
        let stepped = step.reaction(&wheels.collect::<Vec<_>>());
        let results = PyArray2::zeros(py, [WHEEL.len() + 2, count], false);
        {
            let mut cells = results.readwrite();
            let cells = cells.as_slice_mut()?;
            for (place, wheel) in stepped.wheels.iter().enumerate() {
                for (row, value) in row(wheel).into_iter().enumerate() {
                    cells[row * count + place] = value;
                }
            }
        }
        Ok((results, stepped.residual))
    }
}

fn row(wheel: &SteppedWheel) -> impl IntoIterator<Item = f64> {
    let SteppedWheel { sinkage, slip, forces } = *wheel;
    let settled = Settled { sinkage, forces, evaluations: 1 };
    wheel_row(&settled).into_iter().chain([slip.ratio, SLIP_ANGLE.unit.from_si(slip.angle)])
}

/// Defaults of the sinkage damping [s/m] and of the rest speed [m/s].
pub(crate) const DEFAULTS: [(&str, f64); 2] =
    [("SINKAGE_DAMPING_S_M", SINKAGE_DAMPING), ("REST_SPEED_M_S", REST_SPEED)];
