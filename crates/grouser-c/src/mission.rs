//! A mission leg by leg.

use std::ffi::c_char;
use std::sync::Mutex;

use grouser_core::mission::MissionRun;
use grouser_io::{Kind, read_mission};

use crate::documents::{changes, source};
use crate::handles::{self, lock};
use crate::pointers::{place, text};
use crate::status::{Failure, Status, guarded};
use crate::values::{Leg, Pose};
use crate::wheel_test::required;

/// A rover on its way through a mission; it is for one thread at a time.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mission {
    /// The handle's number; 0 is no handle.
    pub id: u64,
}

/// Makes a mission, at its start.
///
/// mission: the name of a preset, the path of a file, or a TOML document.
/// alternative: the name of one of its ways; NULL for the first.
/// changes: values to change, one "document.key=value" a line; NULL for none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_mission_new(
    mission: *const c_char,
    alternative: *const c_char,
    changes: *const c_char,
    out: *mut Mission,
) -> Status {
    guarded(|| {
        // SAFETY: the caller's pointers are as the header says.
        let (mission, alternative, changed, out) = unsafe {
            (
                text("mission", mission)?,
                text("alternative", alternative)?,
                text("changes", changes)?,
                place("out", out)?,
            )
        };
        let source = source(Kind::Mission, required("mission", mission)?)?;
        let changes =
            self::changes(changed, &[Kind::Mission, Kind::Rover, Kind::Soil, Kind::Wheel])?;
        let plan = read_mission(&source, &changes)?.value;
        let ways = plan.missions();
        let mut ways = ways.iter();
        let (_, mission) = match alternative {
            None => ways.next(),
            Some(wanted) => ways.find(|(name, _)| name == wanted),
        }
        .ok_or_else(|| {
            let text = format!("there is no alternative {:?}", alternative.unwrap_or_default());
            Failure::new(Status::OutOfRange, text)
        })?;
        let run = MissionRun::new(mission)?;
        out.write(Mission { id: handles::insert(Mutex::new(run)) });
        Ok(())
    })
}

/// Frees a mission.
#[unsafe(no_mangle)]
pub extern "C" fn grouser_mission_free(mission: Mission) -> Status {
    guarded(|| handles::remove::<Mutex<MissionRun>>(mission.id))
}

/// Makes another mission that goes on as this one would, bit for bit: its state saved.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_mission_copy(mission: Mission, out: *mut Mission) -> Status {
    with(mission, |run| {
        // SAFETY: the caller's pointer is as the header says.
        let out = unsafe { place("out", out) }?;
        out.write(Mission { id: handles::insert(Mutex::new(run.clone())) });
        Ok(())
    })
}

/// Drives the next leg, into out.
///
/// driven: whether there was one; where there was none, the mission is over and out is left as it
/// is.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_mission_next_leg(
    mission: Mission,
    out: *mut Leg,
    driven: *mut bool,
) -> Status {
    with(mission, |run| {
        // SAFETY: the caller's pointers are as the header says.
        let (out, driven) = unsafe { (place("out", out)?, place("driven", driven)?) };
        // Nobody asks for records here, and missions of weeks must not need memory for them.
        let leg = run.next_leg_watched(&mut |_| true)?;
        driven.write(leg.is_some());
        if let Some(leg) = leg {
            out.write(Leg {
                outcome: leg.outcome.kind().into(),
                distance_m: leg.distance,
                duration_s: leg.time,
                motor_energy_j: leg.energy,
                slip_ratio: leg.slip_ratio.unwrap_or(f64::NAN),
                turned_rad: leg.turned.unwrap_or(f64::NAN),
            });
        }
        Ok(())
    })
}

/// Where the rover is and how it moves, into out.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_mission_pose(mission: Mission, out: *mut Pose) -> Status {
    with(mission, |run| {
        // SAFETY: the caller's pointer is as the header says.
        unsafe { place("out", out) }?.write(run.state().into());
        Ok(())
    })
}

/// Does what a call does with a mission.
fn with(mission: Mission, act: impl FnOnce(&mut MissionRun) -> Result<(), Failure>) -> Status {
    guarded(|| act(&mut *lock(&*handles::get::<Mutex<MissionRun>>(mission.id)?)?))
}
