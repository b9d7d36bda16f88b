//! The soil's reaction over a time step of another engine, whose wheels it moves.

use std::sync::Arc;

use grouser_core::contact::mechanism::{self, Mechanism, Response};
use grouser_core::contact::{self, SteppingWheel, TimeStep};
use grouser_core::error::positive;
use grouser_core::units::Vec3;
use grouser_core::wheel::Wheel;
use nalgebra::{DMatrix, DVector};

use crate::handles;
use crate::pointers::{array, numbers, optional_place, place, room, wrong_size};
use crate::status::{Failure, Status, guarded};
use crate::values::{MountedWheel, Stepped, Wrench};
use crate::wheel_test::{WheelOnSoil, WheelTest, in_range};

/// Wheels that another engine moves: never changed, so that any number of threads may use them at
/// once.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SteppingWheels {
    /// The handle's number; 0 is no handle.
    pub id: u64,
}

/// What [`SteppingWheels`] stand for.
pub(crate) struct Wheels {
    each: Vec<Arc<WheelOnSoil>>,
    damping: f64,
    rest_speed: f64,
}

/// Velocities of a wheel in its frame: of the hub along x, y and z, and of the rim over the shearing
/// radius.
pub const MOTIONS: usize = 4;
/// Forces on a wheel: along x, y and z, the torque's at the rim (against the rim's motion where it
/// drives), and the moments about x and z.
pub const FORCES: usize = 6;
/// Default of the sinkage damping [s/m].
pub const SINKAGE_DAMPING_S_M: f64 = 5.0;
/// Default of the rest speed [m/s].
pub const REST_SPEED_M_S: f64 = 1e-4;

/// The one declaration is the core's; C's are numbers of their own.
const _: () = {
    assert!(MOTIONS == contact::time_step::MOTIONS);
    assert!(FORCES == contact::time_step::FORCES);
    assert!(SINKAGE_DAMPING_S_M == contact::time_step::SINKAGE_DAMPING);
    assert!(REST_SPEED_M_S == contact::time_step::REST_SPEED);
};

/// A step of another engine.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EngineStep {
    /// Its length.
    pub duration_s: f64,
    /// Gravity, which gives the soil its weight.
    pub gravity_m_s2: f64,
}

/// Makes wheels that another engine moves, one for each wheel test, whose gravity does not count
/// here. The wheel tests may be freed.
///
/// sinkage_damping_s_m: zero or more, usually GROUSER_SINKAGE_DAMPING_S_M.
/// rest_speed_m_s: below it stresses fade; above zero, usually GROUSER_REST_SPEED_M_S.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_stepping_wheels_new(
    count: usize,
    tests: *const WheelTest,
    sinkage_damping_s_m: f64,
    rest_speed_m_s: f64,
    out: *mut SteppingWheels,
) -> Status {
    guarded(|| {
        // SAFETY: the caller's pointers are as the header says.
        let (tests, out) = unsafe { (array("tests", tests, count)?, place("out", out)?) };
        finite("sinkage_damping_s_m", sinkage_damping_s_m)?;
        finite("rest_speed_m_s", rest_speed_m_s)?;
        in_range("sinkage_damping_s_m", &[sinkage_damping_s_m], &(0.0..=f64::MAX))?;
        positive("rest_speed_m_s", rest_speed_m_s)?;
        let wheels = tests.iter().map(|test| handles::get::<WheelOnSoil>(test.id));
        let wheels = Wheels {
            each: wheels.collect::<Result<_, _>>()?,
            damping: sinkage_damping_s_m,
            rest_speed: rest_speed_m_s,
        };
        out.write(SteppingWheels { id: handles::insert(wheels) });
        Ok(())
    })
}

/// Frees wheels that another engine moves.
#[unsafe(no_mangle)]
pub extern "C" fn grouser_stepping_wheels_free(wheels: SteppingWheels) -> Status {
    guarded(|| handles::remove::<Wheels>(wheels.id))
}

/// The reaction over a step on wheels that a mechanism couples, from the mechanism's response.
///
/// count: of the wheels, as many as the handle has.
/// sinkage_m: of each wheel at the start of the step; negative above the ground.
/// inverse_mass: how forces change velocities, in 1/kg (of moments in 1/(kg m)): row by row, a row
/// for each of the 4 count velocities (GROUSER_MOTIONS), a column for each of the 6 count forces
/// (GROUSER_FORCES).
/// free_m_s: the 4 count velocities at the end of the step without the soil.
/// out: the wheels, count of them.
/// residual_m_s: how far velocities and forces are from each other; NULL if not wanted.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_time_step(
    wheels: SteppingWheels,
    step: EngineStep,
    count: usize,
    sinkage_m: *const f64,
    inverse_mass: *const f64,
    free_m_s: *const f64,
    out: *mut Stepped,
    residual_m_s: *mut f64,
) -> Status {
    guarded(|| {
        let wheels = handles::get::<Wheels>(wheels.id)?;
        wheels.check(count, step)?;
        let motions = MOTIONS * count;
        let forces = FORCES * count;
        // SAFETY: the caller's pointers are as the header says.
        let (sinkages, inverse_mass, free, out, residual) = unsafe {
            (
                numbers("sinkage_m", sinkage_m, count)?,
                numbers("inverse_mass", inverse_mass, motions * forces)?,
                numbers("free_m_s", free_m_s, motions)?,
                room("out", out, count)?,
                optional_place("residual_m_s", residual_m_s)?,
            )
        };
        let inverse_mass = DMatrix::from_row_slice(motions, forces, inverse_mass);
        let free = DVector::from_row_slice(free);
        let response = Response { inverse_mass, preliminary: free.clone(), free };
        let stepped = wheels.reaction(step, sinkages.iter().copied(), &response);
        out.iter_mut().zip(&stepped.wheels).for_each(|(out, wheel)| {
            out.write(wheel.into());
        });
        if let Some(residual) = residual {
            residual.write(stepped.residual);
        }
        Ok(())
    })
}

/// A mechanism at the end of a preliminary step.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MechanismState {
    /// How many wheels there are, as many as the handle has.
    pub wheel_count: usize,
    /// The wheels, wheel_count of them.
    pub wheels: *const MountedWheel,
    /// How many generalised velocities there are.
    pub velocity_count: usize,
    /// The generalised velocities after the preliminary step.
    pub velocities: *const f64,
    /// For each wheel how the velocity of its hub, three rows, and its angular velocity, three more,
    /// follow from the generalised velocities, in the axes of the world: 6 wheel_count rows of
    /// velocity_count.
    pub jacobians: *const f64,
    /// The inertia that the engine steps with: velocity_count rows of velocity_count.
    pub inertia: *const f64,
    /// Whether overturning and aligning moments act.
    pub with_moments: bool,
}

/// The reaction over a step on the wheels of a mechanism, from its Jacobians and inertia; as
/// wrenches on the wheels' bodies about their centres of mass, in the axes of the world.
///
/// wrenches, out: of each wheel; residual_m_s as in grouser_time_step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_mechanism_step(
    wheels: SteppingWheels,
    step: EngineStep,
    state: *const MechanismState,
    wrenches: *mut Wrench,
    out: *mut Stepped,
    residual_m_s: *mut f64,
) -> Status {
    guarded(|| {
        let wheels = handles::get::<Wheels>(wheels.id)?;
        // SAFETY: the caller's pointer is as the header says.
        let state = &unsafe { array("state", state, 1) }?[0];
        let (count, size) = (state.wheel_count, state.velocity_count);
        wheels.check(count, step)?;
        let entries = |rows: usize| {
            rows.checked_mul(size).ok_or_else(|| wrong_size("velocities", size, usize::MAX / rows))
        };
        // SAFETY: the caller's pointers are as the header says.
        let (mounted, velocities, jacobians, inertia, wrenches, out, residual) = unsafe {
            (
                array("wheels", state.wheels, count)?,
                numbers("velocities", state.velocities, size)?,
                numbers("jacobians", state.jacobians, entries(6 * count)?)?,
                numbers("inertia", state.inertia, entries(size)?)?,
                room("wrenches", wrenches, count)?,
                room("out", out, count)?,
                optional_place("residual_m_s", residual_m_s)?,
            )
        };
        let mounted = wheels.mounted(mounted)?;
        let with_moments = state.with_moments;
        let mechanism =
            Mechanism { wheels: &mounted, jacobians, inertia, velocities, with_moments };
        let response = mechanism.response(step.duration_s);
        let response = response.ok_or_else(|| {
            Failure::new(Status::Computation, "the inertia of the mechanism is singular")
        })?;
        if !response.is_finite() {
            let text = "the response of the mechanism is not finite";
            return Err(Failure::new(Status::NotFinite, text));
        }
        let sinkages = mounted.iter().map(mechanism::MountedWheel::sinkage);
        let stepped = wheels.reaction(step, sinkages, &response);
        for (place, (wheel, mounted)) in stepped.wheels.iter().zip(&mounted).enumerate() {
            let wrench = mounted.wrench(&wheel.forces, with_moments);
            let (force_n, moment_nm) = (wrench.force.into(), wrench.moment.into());
            wrenches[place].write(Wrench { force_n, moment_nm });
            out[place].write(wheel.into());
        }
        if let Some(residual) = residual {
            residual.write(stepped.residual);
        }
        Ok(())
    })
}

impl Wheels {
    /// Checks that there are as many wheels as a caller has.
    pub(crate) fn check_count(&self, count: usize) -> Result<(), Failure> {
        if count != self.each.len() {
            return Err(wrong_size("the array of wheels", count, self.each.len()));
        }
        Ok(())
    }

    /// The wheels themselves, for their sizes.
    pub(crate) fn sizes(&self) -> impl Iterator<Item = Wheel> {
        self.each.iter().map(|of| of.wheel)
    }

    /// Checks that a step is one, of these wheels, on soils that bear them under its gravity.
    fn check(&self, count: usize, step: EngineStep) -> Result<(), Failure> {
        self.check_count(count)?;
        finite("duration_s", step.duration_s)?;
        finite("gravity_m_s2", step.gravity_m_s2)?;
        positive("duration_s", step.duration_s)?;
        positive("gravity_m_s2", step.gravity_m_s2)?;
        for of in &self.each {
            of.soil.check_under(&of.wheel, step.gravity_m_s2)?;
        }
        Ok(())
    }

    fn reaction(
        &self,
        step: EngineStep,
        sinkages: impl Iterator<Item = f64>,
        response: &Response,
    ) -> contact::Stepped {
        let stepping = self.each.iter().zip(sinkages).map(|(of, sinkage)| SteppingWheel {
            model: of.model.as_ref(),
            wheel: of.wheel,
            soil: of.soil,
            sinkage,
        });
        let step = TimeStep {
            duration: step.duration_s,
            gravity: step.gravity_m_s2,
            damping: self.damping,
            rest_speed: self.rest_speed,
            inverse_mass: &response.inverse_mass,
            free: &response.free,
        };
        step.reaction_near(&stepping.collect::<Vec<_>>(), &response.preliminary)
    }

    /// The wheels as the mechanism has them.
    fn mounted(&self, mounted: &[MountedWheel]) -> Result<Vec<mechanism::MountedWheel>, Failure> {
        let each = self.each.iter().zip(mounted).enumerate();
        each.map(|(place, (of, it))| {
            let vectors = [it.axle, it.arm_m, it.normal, it.held.force_n, it.held.moment_nm];
            let all = vectors.iter().flatten().chain([&it.hub_height_m]);
            if !all.copied().all(f64::is_finite) {
                let text = format!("wheels[{place}] has a number that is not finite");
                return Err(Failure::new(Status::NotFinite, text));
            }
            let [axle, arm, normal, force, moment] = vectors.map(Vec3::from);
            let (radius, distance) = (of.wheel.shearing_radius(), it.hub_height_m);
            let held = mechanism::Wrench { force, moment };
            Ok(mechanism::MountedWheel { radius, axle, arm, normal, distance, held })
        })
        .collect()
    }
}

/// Checks that a number is finite.
///
/// # Errors
/// [`Status::NotFinite`].
pub(crate) fn finite(name: &str, number: f64) -> Result<(), Failure> {
    if number.is_finite() {
        return Ok(());
    }
    Err(Failure::new(Status::NotFinite, format!("{name} is {number}, it must be finite")))
}
