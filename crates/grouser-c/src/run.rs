//! A rover step by step, its state saved and restored.

use std::ffi::c_char;
use std::sync::Mutex;

use grouser_core::simulation::{BadState, Record, Run as CoreRun, Scenario, State as CoreState};
use grouser_io::{Kind, read_scenario};

use crate::documents::{changes, source};
use crate::handles::{self, lock};
use crate::pointers::{array, numbers, place, room, text, write_text, wrong_size};
use crate::status::{Failure, Status, guarded};
use crate::time_step::finite;
use crate::values::{Attitude, Outcome, Pose, Wheel};
use crate::wheel_test::{in_range, required};

/// A rover on its way through a scenario; it is for one thread at a time.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Run {
    /// The handle's number; 0 is no handle.
    pub id: u64,
}

/// All that changes in a run, as it was when it was saved: never changed, so that any number of
/// threads may use it at once.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct State {
    /// The handle's number; 0 is no handle.
    pub id: u64,
}

/// What a [`Run`] stands for.
#[derive(Clone)]
struct Led {
    /// The scenario as it was read.
    scenario: Scenario,
    run: CoreRun,
    /// Shearing radius of each wheel [m].
    radii: Vec<f64>,
    /// Room for a command: the rim speed of each wheel [m/s].
    rim_speeds: Vec<f64>,
}

/// What a [`State`] stands for.
struct Saved {
    scenario: Scenario,
    state: CoreState,
}

/// Makes the run of a scenario, at its start.
///
/// scenario: the name of a preset, the path of a file, or a TOML document.
/// changes: values to change, one "document.key=value" a line; NULL for none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_run_new(
    scenario: *const c_char,
    changes: *const c_char,
    out: *mut Run,
) -> Status {
    guarded(|| {
        // SAFETY: the caller's pointers are as the header says.
        let (scenario, changed, out) =
            unsafe { (text("scenario", scenario)?, text("changes", changes)?, place("out", out)?) };
        let source = source(Kind::Scenario, required("scenario", scenario)?)?;
        let kinds = [Kind::Scenario, Kind::Rover, Kind::Soil, Kind::Wheel];
        let changes = self::changes(changed, &kinds)?;
        let led = Led::new(read_scenario(&source, &changes)?.value)?;
        out.write(Run { id: handles::insert(Mutex::new(led)) });
        Ok(())
    })
}

/// Frees a run.
#[unsafe(no_mangle)]
pub extern "C" fn grouser_run_free(run: Run) -> Status {
    guarded(|| handles::remove::<Mutex<Led>>(run.id))
}

/// Makes another run that goes on as this one would, bit for bit.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_run_copy(run: Run, out: *mut Run) -> Status {
    with(run, |led| {
        // SAFETY: the caller's pointer is as the header says.
        let out = unsafe { place("out", out) }?;
        out.write(Run { id: handles::insert(Mutex::new(led.clone())) });
        Ok(())
    })
}

/// How many wheels the rover has, into out.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_run_wheel_count(run: Run, out: *mut usize) -> Status {
    with(run, |led| {
        // SAFETY: the caller's pointer is as the header says.
        unsafe { place("out", out) }?.write(led.radii.len());
        Ok(())
    })
}

/// The name of a wheel, with its zero, into a buffer of some bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_run_wheel_name(
    run: Run,
    wheel: usize,
    buffer: *mut c_char,
    bytes: usize,
) -> Status {
    with(run, |led| {
        let mounts = led.scenario.rover.mounts();
        let mount = mounts.get(wheel).ok_or_else(|| {
            let text = format!("wheel is {wheel}, the rover has {} wheels", mounts.len());
            Failure::new(Status::OutOfRange, text)
        })?;
        // SAFETY: the caller's pointer is as the header says.
        write_text(unsafe { room("buffer", buffer, bytes) }?, &mount.name)
    })
}

/// Turns the wheels at the given speeds for a while. A rover whose outcome is known stays where it
/// is.
///
/// wheel_count: as many as the rover has; wheel_speed_rad_s: a speed for each.
/// duration_s: from 1e-6 to 86400.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_run_step(
    run: Run,
    wheel_count: usize,
    wheel_speed_rad_s: *const f64,
    duration_s: f64,
) -> Status {
    with(run, |led| {
        if wheel_count != led.radii.len() {
            return Err(wrong_size("wheel_speed_rad_s", wheel_count, led.radii.len()));
        }
        // SAFETY: the caller's pointer is as the header says.
        let speeds = unsafe { numbers("wheel_speed_rad_s", wheel_speed_rad_s, wheel_count) }?;
        finite("duration_s", duration_s)?;
        for (rim, (speed, radius)) in led.rim_speeds.iter_mut().zip(speeds.iter().zip(&led.radii)) {
            *rim = speed * radius;
        }
        Ok(led.run.step(&led.rim_speeds, duration_s)?)
    })
}

/// Turns the wheels as the scenario's drive says for a while, at most to the end of the scenario.
/// The drive is asked at the start of the call and after each 0.1 s: durations that are multiples of
/// it lead where one call to the end does.
///
/// duration_s: from 1e-6 to 86400.
#[unsafe(no_mangle)]
pub extern "C" fn grouser_run_play(run: Run, duration_s: f64) -> Status {
    with(run, |led| {
        finite("duration_s", duration_s)?;
        in_range("duration_s", &[duration_s], &(1e-6..=86400.0))?;
        Ok(led.run.play(duration_s)?)
    })
}

/// Where the rover is and how it moves, into out.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_run_pose(run: Run, out: *mut Pose) -> Status {
    with(run, |led| {
        // SAFETY: the caller's pointer is as the header says.
        unsafe { place("out", out) }?.write(led.run.state().into());
        Ok(())
    })
}

/// How the rover stands on ground with heights, or on a suspension, into out.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_run_attitude(run: Run, out: *mut Attitude) -> Status {
    with(run, |led| {
        // SAFETY: the caller's pointer is as the header says.
        unsafe { place("out", out) }?.write(led.run.now().into());
        Ok(())
    })
}

/// The wheels of the rover, into out, an array of wheel_count, as many as the rover has. All numbers
/// are NaN where the rover has just tipped over or sunk.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_run_wheels(
    run: Run,
    wheel_count: usize,
    out: *mut Wheel,
) -> Status {
    with(run, |led| {
        if wheel_count != led.radii.len() {
            return Err(wrong_size("out", wheel_count, led.radii.len()));
        }
        // SAFETY: the caller's pointer is as the header says.
        let out = unsafe { room("out", out, wheel_count) }?;
        let Record { wheels, .. } = led.run.now();
        for (place, out) in out.iter_mut().enumerate() {
            out.write(wheels.get(place).map_or(Wheel::NONE, Wheel::from));
        }
        Ok(())
    })
}

/// What became of the rover, into out, and why with its zero, into a buffer of some bytes; NULL and
/// 0 if that is not wanted. A rover under way, and one that did what was asked for, have no reason.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_run_outcome(
    run: Run,
    out: *mut Outcome,
    reason: *mut c_char,
    bytes: usize,
) -> Status {
    with(run, |led| {
        // SAFETY: the caller's pointers are as the header says.
        let (out, reason) = unsafe { (place("out", out)?, room("reason", reason, bytes)?) };
        let outcome = led.run.outcome();
        if !reason.is_empty() {
            let text = outcome.and_then(grouser_core::simulation::Outcome::reason);
            write_text(reason, &text.unwrap_or_default())?;
        }
        let is_over = led.run.state().time() >= led.scenario.duration;
        out.write(match outcome {
            Some(outcome) => outcome.kind().into(),
            None if is_over => Outcome::Completed,
            None => Outcome::UnderWay,
        });
        Ok(())
    })
}

/// Saves all that changes in a run, into out.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_run_save(run: Run, out: *mut State) -> Status {
    with(run, |led| {
        // SAFETY: the caller's pointer is as the header says.
        let out = unsafe { place("out", out) }?;
        let saved = Saved { scenario: led.scenario.clone(), state: led.run.state().clone() };
        out.write(State { id: handles::insert(saved) });
        Ok(())
    })
}

/// Sets a run to a saved state, from which it goes on as the saved one did, bit for bit. The state
/// may be that of another run of the same scenario, and may be used again.
#[unsafe(no_mangle)]
pub extern "C" fn grouser_run_restore(run: Run, state: State) -> Status {
    with(run, |led| {
        let saved = handles::get::<Saved>(state.id)?;
        if saved.scenario != led.scenario {
            let text = "the state is of another scenario than the run";
            return Err(Failure::new(Status::OtherScenario, text));
        }
        led.run = CoreRun::resume(&led.scenario, saved.state.clone());
        Ok(())
    })
}

/// How many bytes a saved state has, into out.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_state_size(state: State, out: *mut usize) -> Status {
    guarded(|| {
        // SAFETY: the caller's pointer is as the header says.
        let out = unsafe { place("out", out) }?;
        out.write(handles::get::<Saved>(state.id)?.state.to_bytes().len());
        Ok(())
    })
}

/// Writes a saved state as bytes, for files and other processes, into out, an array of size, as many
/// as grouser_state_size says. The same version of Grouser reads them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_state_write(state: State, size: usize, out: *mut u8) -> Status {
    guarded(|| {
        let bytes = handles::get::<Saved>(state.id)?.state.to_bytes();
        if size != bytes.len() {
            return Err(wrong_size("out", size, bytes.len()));
        }
        // SAFETY: the caller's pointer is as the header says.
        for (out, byte) in unsafe { room("out", out, size) }?.iter_mut().zip(bytes) {
            out.write(byte);
        }
        Ok(())
    })
}

/// Reads a state that grouser_state_write wrote, into out: one of the run's scenario, which is the
/// caller's to see to; another number of wheels is an error, as damaged bytes are.
///
/// size: of the array bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_state_read(
    run: Run,
    size: usize,
    bytes: *const u8,
    out: *mut State,
) -> Status {
    with(run, |led| {
        // SAFETY: the caller's pointers are as the header says.
        let (bytes, out) = unsafe { (array("bytes", bytes, size)?, place("out", out)?) };
        let state = CoreState::from_bytes(bytes, &led.scenario).map_err(|error| {
            let status = match error {
                BadState::Unreadable => Status::OutOfRange,
                BadState::OtherWheels { .. } | BadState::OtherPath => Status::OtherScenario,
            };
            Failure::new(status, error.to_string())
        })?;
        let saved = Saved { scenario: led.scenario.clone(), state };
        out.write(State { id: handles::insert(saved) });
        Ok(())
    })
}

/// Frees a saved state.
#[unsafe(no_mangle)]
pub extern "C" fn grouser_state_free(state: State) -> Status {
    guarded(|| handles::remove::<Saved>(state.id))
}

impl Led {
    fn new(scenario: Scenario) -> Result<Self, Failure> {
        let run = CoreRun::new(&scenario)?;
        let radii: Vec<f64> = scenario
            .rover
            .mounts()
            .iter()
            .map(grouser_core::vehicle::Mount::shearing_radius)
            .collect();
        let rim_speeds = vec![0.0; radii.len()];
        Ok(Self { scenario, run, radii, rim_speeds })
    }
}

/// Does what a call does with a run.
fn with(run: Run, act: impl FnOnce(&mut Led) -> Result<(), Failure>) -> Status {
    guarded(|| act(&mut *lock(&*handles::get::<Mutex<Led>>(run.id)?)?))
}
