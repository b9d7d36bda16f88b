//! The soil's reaction over the time steps of an engine of rigid bodies.

use grouser::contact::mechanism::{Mechanism, MountedWheel, Response, Wrench};
use grouser::contact::time_step::{REST_SPEED, SINKAGE_DAMPING};
use grouser::contact::{Model, Settled, SteppedWheel, SteppingWheel, TimeStep};
use grouser::document::columns::wheel::WHEEL;
use grouser::document::columns::{SLIP_ANGLE, SLIP_RATIO};
use grouser::document::{Kind, range};
use grouser::soil::Soil;
use grouser::units::Vec3;
use grouser::wheel::Wheel;
use numpy::ndarray::ArrayView2;
use numpy::{
    PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3,
};
use pyo3::prelude::*;

use crate::columns::{wheel_names, wheel_row};
use crate::descriptions::Document;
use crate::errors;
use crate::threads::released;
use crate::wheels::{check, check_under, model_and_gravity};

/// The key of gravity in a scenario.
const GRAVITY: &str = "gravity_m_s2";

/// Wheels and the soils under them, whose reaction is computed at every step.
#[pyclass(frozen, module = "grouser._core")]
pub(crate) struct SteppingWheels {
    wheels: Vec<(Wheel, Soil, Model)>,
    /// Under which they were checked [m/s²].
    gravity: f64,
    damping: f64,
    rest_speed: f64,
}

/// Wrenches, a row for each wheel; results of wheels, a row for each name; and how far the motion
/// is from the forces' [m/s].
type Answer<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>, f64);

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
        let gravity = setting.scenario()?.value.gravity;
        let made = soils.iter().zip(&wheels).map(|(soil, wheel)| {
            let (model, _) = model_and_gravity(soil, setting)?;
            let (soil, wheel) = (soil.soil()?.value, wheel.wheel()?.value);
            check_under(&soil, &wheel, gravity)?;
            Ok((wheel, soil, model))
        });
        Ok(Self {
            wheels: made.collect::<PyResult<_>>()?,
            gravity,
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

    /// The reaction over a step that a preliminary step led to: a wrench on each wheel's body about
    /// its centre of mass, in the world; results of wheels; and how far the motion is from the
    /// forces' [m/s].
    ///
    /// * `poses`: hubs [m], directions of axles, centres of mass of the bodies [m], and normals of
    ///   the ground, a row for each wheel, in the world
    /// * `distances`: of the hubs from the ground [m]
    /// * `jacobians`: of each hub, three rows of velocity and three of angular velocity
    /// * `inertia`, `velocities`: of the mechanism
    /// * `held`: force and moment on each body in the preliminary step
    /// * `gravity_m_s2`: now, which an engine may change
    #[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
    #[allow(clippy::too_many_arguments, reason = "arrays, as they come from Python")]
    fn apply<'py>(
        &self,
        py: Python<'py>,
        duration_s: f64,
        poses: [PyReadonlyArray2<'py, f64>; 4],
        distances: PyReadonlyArray1<'py, f64>,
        jacobians: PyReadonlyArray3<'py, f64>,
        inertia: PyReadonlyArray2<'py, f64>,
        velocities: PyReadonlyArray1<'py, f64>,
        held: PyReadonlyArray2<'py, f64>,
        with_moments: bool,
        gravity_m_s2: f64,
    ) -> PyResult<Answer<'py>> {
        self.check_gravity(gravity_m_s2)?;
        let count = self.wheels.len();
        let wheels = self.mounted(&poses, &distances, &held).ok_or_else(not_finite)?;
        let mechanism = Mechanism {
            wheels: &wheels,
            jacobians: jacobians.as_slice()?,
            inertia: inertia.as_slice()?,
            velocities: velocities.as_slice()?,
            with_moments,
        };
        let response = errors::caught(|| mechanism.response(duration_s))?;
        let response = response.filter(Response::is_finite).ok_or_else(not_finite)?;
        let sinkages: Vec<f64> = wheels.iter().map(MountedWheel::sinkage).collect();
        if !sinkages.iter().all(|sinkage| sinkage.is_finite()) {
            return Err(not_finite());
        }
        let step = TimeStep {
            duration: duration_s,
            gravity: gravity_m_s2,
            damping: self.damping,
            rest_speed: self.rest_speed,
            inverse_mass: &response.inverse_mass,
            free: &response.free,
        };
        let stepping = self.wheels.iter().zip(sinkages);
        let stepping = stepping.map(|(&(wheel, soil, ref model), sinkage)| SteppingWheel {
            model: model.as_ref(),
            wheel,
            soil,
            sinkage,
        });
        let stepping: Vec<SteppingWheel<'_>> = stepping.collect();
        let stepped = released(py, || step.reaction_near(&stepping, &response.preliminary))?;
        let results = PyArray2::zeros(py, [WHEEL.len() + 2, count], false);
        let wrenches = PyArray2::zeros(py, [count, 6], false);
        {
            let (mut cells, mut parts) = (results.readwrite(), wrenches.readwrite());
            let (cells, parts) = (cells.as_slice_mut()?, parts.as_slice_mut()?);
            for (place, (wheel, mounted)) in stepped.wheels.iter().zip(&wheels).enumerate() {
                for (row, value) in row(wheel).into_iter().enumerate() {
                    cells[row * count + place] = value;
                }
                let Wrench { force, moment } = mounted.wrench(&wheel.forces, with_moments);
                let own = &mut parts[6 * place..][..6];
                own[..3].copy_from_slice(force.as_slice());
                own[3..].copy_from_slice(moment.as_slice());
            }
        }
        Ok((wrenches, results, stepped.residual))
    }
}

impl SteppingWheels {
    /// Checks that the soils bear the wheels under another gravity than at first.
    fn check_gravity(&self, gravity: f64) -> PyResult<()> {
        if gravity == self.gravity {
            return Ok(());
        }
        let range = range(Kind::Scenario, GRAVITY).unwrap_or(f64::MIN_POSITIVE..=f64::MAX);
        check(GRAVITY, &[gravity], &range)?;
        self.wheels.iter().try_for_each(|(wheel, soil, _)| check_under(soil, wheel, gravity))
    }

    /// The wheels where a preliminary step led them; nothing if arrays do not fit.
    fn mounted(
        &self,
        poses: &[PyReadonlyArray2<'_, f64>; 4],
        distances: &PyReadonlyArray1<'_, f64>,
        held: &PyReadonlyArray2<'_, f64>,
    ) -> Option<Vec<MountedWheel>> {
        let [hubs, axles, centres, normals] = poses.each_ref().map(|all| all.as_array());
        let (distances, held) = (distances.as_array(), held.as_array());
        let count = self.wheels.len();
        let are_rows = [hubs, axles, centres, normals].iter().all(|all| all.dim() == (count, 3));
        if !are_rows || distances.dim() != count || held.dim() != (count, 6) {
            return None;
        }
        let mounted = |(place, (wheel, ..)): (usize, &(Wheel, Soil, Model))| {
            let vector = |all: &ArrayView2<'_, f64>, start: usize| {
                Vec3::new(all[[place, start]], all[[place, start + 1]], all[[place, start + 2]])
            };
            MountedWheel {
                radius: wheel.shearing_radius(),
                axle: vector(&axles, 0),
                arm: vector(&hubs, 0) - vector(&centres, 0),
                normal: vector(&normals, 0),
                distance: distances[place],
                held: Wrench { force: vector(&held, 0), moment: vector(&held, 3) },
            }
        };
        Some(self.wheels.iter().enumerate().map(mounted).collect())
    }
}

fn not_finite() -> PyErr {
    let message = "the motion of the wheels is not finite, or not theirs".to_owned();
    errors::parameter(message, "data", None, "a motion of the model")
}

fn row(wheel: &SteppedWheel) -> impl IntoIterator<Item = f64> {
    let SteppedWheel { sinkage, slip, forces } = *wheel;
    let settled = Settled { sinkage, forces, evaluations: 1 };
    wheel_row(&settled).into_iter().chain([slip.ratio, SLIP_ANGLE.unit.from_si(slip.angle)])
}

/// Defaults of the sinkage damping [s/m] and of the rest speed [m/s].
pub(crate) const DEFAULTS: [(&str, f64); 2] =
    [("SINKAGE_DAMPING_S_M", SINKAGE_DAMPING), ("REST_SPEED_M_S", REST_SPEED)];
