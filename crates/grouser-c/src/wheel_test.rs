//! A wheel on a soil, as in a wheel test: forces and sinkage of arrays of wheels.

use std::f64::consts::FRAC_PI_2;
use std::ffi::c_char;
use std::mem::MaybeUninit;
use std::ops::RangeInclusive;

use grouser_core::contact::{Contact, Model, Slip, forces_many, settle, settle_many};
use grouser_core::soil::Soil;
use grouser_core::wheel::Wheel;
use grouser_io::{Kind, Source, read_scenario, read_soil, read_wheel};

use crate::documents::{changes, source};
use crate::handles;
use crate::pointers::{numbers, place, room, text};
use crate::status::{Failure, Status, guarded};
use crate::values::{Reaction, Settled};

/// A wheel on a soil, with a wheel-soil model and a gravity: never changed, so that any number of
/// threads may use it at once.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WheelTest {
    /// The handle's number; 0 is no handle.
    pub id: u64,
}

/// What a [`WheelTest`] stands for.
pub(crate) struct WheelOnSoil {
    pub(crate) wheel: Wheel,
    pub(crate) soil: Soil,
    pub(crate) model: Model,
    gravity: f64,
}

/// Slip ratios and slip angles [rad] of a wheel test: those of [`Slip::on_test_stand`].
const SLIP_RATIOS: RangeInclusive<f64> = -2.0..=2.0;
const SLIP_ANGLES: RangeInclusive<f64> = -FRAC_PI_2..=FRAC_PI_2;
/// Loads [N].
const LOADS: RangeInclusive<f64> = 0.0..=1e5;

/// So many wheels settle together as lanes of vectors, which takes memory for them; fewer settle
/// one by one, without allocating. Each has the same bits either way. Source: ours.
const BATCH: usize = 64;

/// Makes a wheel test.
///
/// soil, wheel: each the name of a preset, the path of a file, or a TOML document.
/// setting: a scenario that gives gravity, and a wheel-soil model where it names one; NULL for the
/// Earth and the soil's own model.
/// changes: values to change, one "document.key=value" a line; NULL for none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_wheel_test_new(
    soil: *const c_char,
    wheel: *const c_char,
    setting: *const c_char,
    changes: *const c_char,
    out: *mut WheelTest,
) -> Status {
    guarded(|| {
        // SAFETY: the caller's pointers are as the header says.
        let (soil, wheel, setting, changes, out) = unsafe {
            (
                text("soil", soil)?,
                text("wheel", wheel)?,
                text("setting", setting)?,
                text("changes", changes)?,
                place("out", out)?,
            )
        };
        let test = WheelOnSoil::read(
            required("soil", soil)?,
            required("wheel", wheel)?,
            setting,
            changes,
        )?;
        out.write(WheelTest { id: handles::insert(test) });
        Ok(())
    })
}

/// Frees a wheel test.
#[unsafe(no_mangle)]
pub extern "C" fn grouser_wheel_test_free(test: WheelTest) -> Status {
    guarded(|| handles::remove::<WheelOnSoil>(test.id))
}

/// How large a wheel is.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelSize {
    /// Radius of the rim, without grousers.
    pub rim_radius_m: f64,
    /// Radius of the grousers' tips, over which speeds of rims are taken.
    pub shearing_radius_m: f64,
    /// Width.
    pub width_m: f64,
}

/// How large the wheel is, into out.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_wheel_test_size(test: WheelTest, out: *mut WheelSize) -> Status {
    guarded(|| {
        let test = handles::get::<WheelOnSoil>(test.id)?;
        let wheel = &test.wheel;
        // SAFETY: the caller's pointer is as the header says.
        unsafe { place("out", out) }?.write(WheelSize {
            rim_radius_m: wheel.radius,
            shearing_radius_m: wheel.shearing_radius(),
            width_m: wheel.width,
        });
        Ok(())
    })
}

/// The sinkages at which wheels carry their loads, and the forces there.
///
/// load_n (0 to 1e5), slip_ratio (-2 to 2), slip_angle_rad (-pi/2 to pi/2), out: arrays of count.
/// A wheel that the soil does not carry is no error: its entry says so. Up to 63 wheels settle
/// without allocating memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_settle(
    test: WheelTest,
    count: usize,
    load_n: *const f64,
    slip_ratio: *const f64,
    slip_angle_rad: *const f64,
    out: *mut Settled,
) -> Status {
    guarded(|| {
        let test = handles::get::<WheelOnSoil>(test.id)?;
        // SAFETY: the caller's pointers are as the header says.
        let (loads, out, motions) = unsafe {
            (
                numbers("load_n", load_n, count)?,
                room("out", out, count)?,
                Motions::new(count, slip_ratio, slip_angle_rad)?,
            )
        };
        in_range("load_n", loads, &LOADS)?;
        let model = test.model.as_ref();
        if count < BATCH {
            for (place, out) in out.iter_mut().enumerate() {
                let settled = settle(model, &test.contact(&motions, place), loads[place]);
                out.write(settled.into());
            }
            return Ok(());
        }
        let wheels: Vec<_> =
            loads.iter().enumerate().map(|(k, load)| (test.contact(&motions, k), *load)).collect();
        write_all(out, settle_many(model, &wheels).into_iter().map(Settled::from));
        Ok(())
    })
}

/// The soil's reaction on wheels at given sinkages.
///
/// sinkage_m (0 to the shearing radius), slip_ratio, slip_angle_rad as in grouser_settle, out:
/// arrays of count. Up to 63 wheels are computed without allocating memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_forces(
    test: WheelTest,
    count: usize,
    sinkage_m: *const f64,
    slip_ratio: *const f64,
    slip_angle_rad: *const f64,
    out: *mut Reaction,
) -> Status {
    guarded(|| {
        let test = handles::get::<WheelOnSoil>(test.id)?;
        // SAFETY: the caller's pointers are as the header says.
        let (sinkages, out, motions) = unsafe {
            (
                numbers("sinkage_m", sinkage_m, count)?,
                room("out", out, count)?,
                Motions::new(count, slip_ratio, slip_angle_rad)?,
            )
        };
        in_range("sinkage_m", sinkages, &(0.0..=test.wheel.shearing_radius()))?;
        for start in (0..count).step_by(BATCH) {
            let end = (start + BATCH).min(count);
            test.forces(&motions, &sinkages[..end], start, &mut out[start..end]);
        }
        Ok(())
    })
}

/// How wheels move against the soil.
struct Motions<'a> {
    slip_ratios: &'a [f64],
    slip_angles: &'a [f64],
}

impl Motions<'_> {
    /// # Safety
    /// As [`numbers`].
    unsafe fn new(
        count: usize,
        slip_ratio: *const f64,
        slip_angle_rad: *const f64,
    ) -> Result<Self, Failure> {
        // SAFETY: as this function's.
        let (slip_ratios, slip_angles) = unsafe {
            (
                numbers("slip_ratio", slip_ratio, count)?,
                numbers("slip_angle_rad", slip_angle_rad, count)?,
            )
        };
        in_range("slip_ratio", slip_ratios, &SLIP_RATIOS)?;
        in_range("slip_angle_rad", slip_angles, &SLIP_ANGLES)?;
        Ok(Self { slip_ratios, slip_angles })
    }
}

impl WheelOnSoil {
    fn read(
        soil: &str,
        wheel: &str,
        setting: Option<&str>,
        changed: Option<&str>,
    ) -> Result<Self, Failure> {
        let kinds = [Kind::Soil, Kind::Wheel, Kind::Scenario];
        let overrides = changes(changed, &kinds)?;
        let soil = read_soil(&source(Kind::Soil, soil)?, &overrides)?;
        let wheel = read_wheel(&source(Kind::Wheel, wheel)?, &overrides)?.value;
        let setting = match setting {
            Some(setting) => source(Kind::Scenario, setting)?,
            None => Source::default_scenario(),
        };
        let setting = read_scenario(&setting, &overrides)?;
        let model = match setting.document.model() {
            Some(_) => setting.value.model,
            None => soil.document.usual_model(""),
        };
        let gravity = setting.value.gravity;
        soil.value.check_under(&wheel, gravity)?;
        Ok(Self { wheel, soil: soil.value, model, gravity })
    }

    fn contact(&self, motions: &Motions<'_>, place: usize) -> Contact {
        let slip = Slip::on_test_stand(motions.slip_ratios[place], motions.slip_angles[place]);
        Contact { wheel: self.wheel, soil: self.soil, slip, gravity: self.gravity }
    }

    /// The reaction on some of the wheels.
    ///
    /// * `sinkages`: of all wheels up to the last of them [m]
    /// * `start`: the first of them
    fn forces(
        &self,
        motions: &Motions<'_>,
        sinkages: &[f64],
        start: usize,
        out: &mut [MaybeUninit<Reaction>],
    ) {
        let wheel = |k: usize| (self.contact(motions, k), sinkages[k]);
        if out.len() < BATCH && self.soil.discrepancy.is_none() {
            for (k, out) in (start..).zip(out) {
                let (contact, sinkage) = wheel(k);
                let forces = self.model.as_ref().forces(&contact, sinkage);
                out.write(Reaction::new(sinkage, &forces));
            }
            return;
        }
        let wheels: Vec<_> = (start..sinkages.len()).map(wheel).collect();
        let forces = forces_many(self.model.as_ref(), &wheels);
        write_all(out, forces.iter().zip(&sinkages[start..]).map(|(f, h)| Reaction::new(*h, f)));
    }
}

fn write_all<T>(out: &mut [MaybeUninit<T>], results: impl Iterator<Item = T>) {
    for (out, result) in out.iter_mut().zip(results) {
        out.write(result);
    }
}

/// Checks that numbers are in their range.
///
/// # Errors
/// [`Status::OutOfRange`] names the first that is not.
pub(crate) fn in_range(
    name: &str,
    numbers: &[f64],
    range: &RangeInclusive<f64>,
) -> Result<(), Failure> {
    let Some(place) = numbers.iter().position(|number| !range.contains(number)) else {
        return Ok(());
    };
    let (number, least, most) = (numbers[place], range.start(), range.end());
    let text = format!("{name}[{place}] is {number}, it must be from {least} to {most}");
    Err(Failure::new(Status::OutOfRange, text))
}

/// A text that must be there.
///
/// # Errors
/// [`Status::NullPointer`].
pub(crate) fn required<'a>(name: &str, text: Option<&'a str>) -> Result<&'a str, Failure> {
    text.ok_or_else(|| Failure::new(Status::NullPointer, format!("{name} is null")))
}
