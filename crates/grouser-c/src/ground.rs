//! The ground of another engine under wheels that it moves.

use std::mem::MaybeUninit;

use grouser_core::terrain::{GroundFrame, HeightField};
use grouser_core::units::{Vec2, Vec3};

use crate::handles;
use crate::pointers::{array, numbers, room, wrong_size};
use crate::status::{Failure, Status, guarded};
use crate::time_step::{SteppingWheels, Wheels, finite};

/// A field of heights over x and y of a frame of its own, bilinear between its points; beyond its
/// edges it goes on as high as there.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GroundField {
    /// Points along x, two or more.
    pub columns: usize,
    /// Points along y, two or more.
    pub rows: usize,
    /// Heights in rows along x, one after the other along y: rows times columns.
    pub heights: *const f32,
    /// What a height of 1 means.
    pub unit_m: f64,
    /// Half of its size along x and y.
    pub half_size_m: [f64; 2],
    /// Its middle in the world.
    pub origin_m: [f64; 3],
    /// Its axes in the world, as columns of a matrix, row by row.
    pub axes: [f64; 9],
}

/// The plane under each wheel on a field of heights: the least-squares plane through nine points of
/// its footprint, as long as its shearing radius and as wide as the wheel.
///
/// count: of the wheels, as many as the handle has.
/// hubs_m, axles: of each wheel, in the axes of the world, an axle as a unit vector to the left: 3
/// count numbers each.
/// normals: of the planes, 3 count numbers; hub_heights_m: of the hubs above them, count.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grouser_planes_on_field(
    wheels: SteppingWheels,
    field: *const GroundField,
    count: usize,
    hubs_m: *const f64,
    axles: *const f64,
    normals: *mut f64,
    hub_heights_m: *mut f64,
) -> Status {
    guarded(|| {
        let wheels = handles::get::<Wheels>(wheels.id)?;
        wheels.check_count(count)?;
        // SAFETY: the caller's pointers are as the header says.
        let (field, hubs, axles, normals, heights) = unsafe {
            (
                &array("field", field, 1)?[0],
                numbers("hubs_m", hubs_m, 3 * count)?,
                numbers("axles", axles, 3 * count)?,
                room("normals", normals, 3 * count)?,
                room("hub_heights_m", hub_heights_m, count)?,
            )
        };
        // SAFETY: the caller's pointer is as the header says.
        let (frame, field) = unsafe { read(field)? };
        let vector = |of: &[f64], place: usize| Vec3::from_column_slice(&of[3 * place..][..3]);
        for (place, wheel) in wheels.sizes().enumerate() {
            let (hub, axle) = (vector(hubs, place), vector(axles, place));
            let (footprint, hub) = frame.footprint(hub, axle, wheel.shearing_radius(), wheel.width);
            let (normal, height) = frame.plane_on(&field, footprint, hub);
            let row: &mut [MaybeUninit<f64>] = &mut normals[3 * place..][..3];
            row.iter_mut().zip(normal.iter()).for_each(|(out, part)| {
                out.write(*part);
            });
            heights[place].write(height);
        }
        Ok(())
    })
}

/// The frame of a field, and its heights.
///
/// # Safety
/// The pointer to the heights is as [`array`] asks.
unsafe fn read(field: &GroundField) -> Result<(GroundFrame, HeightField<'_>), Failure> {
    let [x, y] = field.half_size_m;
    for number in field.origin_m.iter().chain(&field.axes).chain([&field.unit_m, &x, &y]) {
        finite("a number of the field", *number)?;
    }
    let points = field
        .rows
        .checked_mul(field.columns)
        .ok_or_else(|| wrong_size("the field", usize::MAX, usize::MAX / field.columns.max(1)))?;
    // SAFETY: as this function's.
    let heights = unsafe { array("heights", field.heights, points) }?;
    let made = HeightField::new(heights, field.columns, Vec2::new(x, y), field.unit_m);
    let made = made.filter(|_| x > 0.0 && y > 0.0).ok_or_else(|| {
        let text = "the field has fewer than two rows or columns, or no size".to_owned();
        Failure::new(Status::OutOfRange, text)
    })?;
    Ok((GroundFrame::new(field.origin_m, field.axes), made))
}
