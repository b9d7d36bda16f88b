//! What C hands over by pointers, checked before it is used: arrays, texts and places for results.
//!
//! A pointer that is not null is taken at its word: it points to as much as the call's count says,
//! and nobody else writes there meanwhile. No library can check that.

use std::ffi::{CStr, c_char};
use std::mem::MaybeUninit;
use std::slice;

use crate::status::{Failure, Status};

/// An array of the caller's. A count of zero needs no array.
///
/// # Safety
/// The pointer is null, or points to that many values, which nobody changes during the call.
///
/// # Errors
/// [`Status::NullPointer`], and [`Status::WrongSize`] for more than a memory has.
pub(crate) unsafe fn array<'a, T>(
    name: &str,
    pointer: *const T,
    count: usize,
) -> Result<&'a [T], Failure> {
    if count == 0 {
        return Ok(&[]);
    }
    check::<T>(name, pointer.is_null(), pointer.is_aligned(), count)?;
    // SAFETY: it is not null, aligned, no longer than a memory, and as long as the caller says.
    Ok(unsafe { slice::from_raw_parts(pointer, count) })
}

/// An array of numbers of the caller's, all finite.
///
/// # Safety
/// As [`array`].
///
/// # Errors
/// As [`array`]; [`Status::NotFinite`] names the first number that is not finite.
pub(crate) unsafe fn numbers<'a>(
    name: &str,
    pointer: *const f64,
    count: usize,
) -> Result<&'a [f64], Failure> {
    // SAFETY: as this function's.
    let all = unsafe { array(name, pointer, count) }?;
    match all.iter().position(|number| !number.is_finite()) {
        None => Ok(all),
        Some(place) => {
            let text = format!("{name}[{place}] is {}, it must be finite", all[place]);
            Err(Failure::new(Status::NotFinite, text))
        }
    }
}

/// An array for results of the caller's, which may be uninitialised.
///
/// # Safety
/// The pointer is null, or points to room for that many values, which nobody else uses during the
/// call.
///
/// # Errors
/// As [`array`].
pub(crate) unsafe fn room<'a, T>(
    name: &str,
    pointer: *mut T,
    count: usize,
) -> Result<&'a mut [MaybeUninit<T>], Failure> {
    if count == 0 {
        return Ok(&mut []);
    }
    check::<T>(name, pointer.is_null(), pointer.is_aligned(), count)?;
    // SAFETY: it is not null, aligned, no longer than a memory, and as long as the caller says;
    // what is uninitialised is a `MaybeUninit`.
    Ok(unsafe { slice::from_raw_parts_mut(pointer.cast(), count) })
}

/// A place for one result.
///
/// # Safety
/// As [`room`], for one value.
///
/// # Errors
/// As [`array`].
pub(crate) unsafe fn place<'a, T>(
    name: &str,
    pointer: *mut T,
) -> Result<&'a mut MaybeUninit<T>, Failure> {
    // SAFETY: as this function's.
    let room = unsafe { room(name, pointer, 1) }?;
    Ok(&mut room[0])
}

/// A place for a result that may be unwanted; nothing if the pointer is null.
///
/// # Safety
/// As [`place`].
///
/// # Errors
/// As [`array`].
pub(crate) unsafe fn optional_place<'a, T>(
    name: &str,
    pointer: *mut T,
) -> Result<Option<&'a mut MaybeUninit<T>>, Failure> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: as this function's.
    unsafe { place(name, pointer) }.map(Some)
}

/// A text of the caller's; nothing if the pointer is null.
///
/// # Safety
/// The pointer is null, or points to a text that ends with a zero and that nobody changes during
/// the call.
///
/// # Errors
/// [`Status::NotUtf8`].
pub(crate) unsafe fn text<'a>(
    name: &str,
    pointer: *const c_char,
) -> Result<Option<&'a str>, Failure> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: it is not null, and ends with a zero as the caller says.
    let text = unsafe { CStr::from_ptr(pointer) };
    let text = text
        .to_str()
        .map_err(|error| Failure::new(Status::NotUtf8, format!("{name} is not UTF-8: {error}")))?;
    Ok(Some(text))
}

/// Writes a text with its zero into a buffer of the caller's.
///
/// # Errors
/// [`Status::WrongSize`] if it is too short, with the size that is needed.
pub(crate) fn write_text(room: &mut [MaybeUninit<c_char>], text: &str) -> Result<(), Failure> {
    let needed = text.len() + 1;
    if room.len() < needed {
        let text = format!("the buffer has {} bytes, the text needs {needed}", room.len());
        return Err(Failure::new(Status::WrongSize, text));
    }
    for (place, byte) in room.iter_mut().zip(text.bytes().chain([0])) {
        place.write(c_char::from_ne_bytes([byte]));
    }
    Ok(())
}

/// A failure for an array of another length than it must have.
pub(crate) fn wrong_size(name: &str, found: usize, expected: usize) -> Failure {
    let text = format!("{name} has {found} entries, it must have {expected}");
    Failure::new(Status::WrongSize, text)
}

fn check<T>(name: &str, is_null: bool, is_aligned: bool, count: usize) -> Result<(), Failure> {
    if is_null {
        return Err(Failure::new(Status::NullPointer, format!("{name} is null")));
    }
    if !is_aligned {
        return Err(Failure::new(Status::WrongSize, format!("{name} is not aligned")));
    }
    let most = isize::MAX.unsigned_abs() / size_of::<T>().max(1);
    if count > most {
        let text = format!("{name} has {count} entries, more than any memory");
        return Err(Failure::new(Status::WrongSize, text));
    }
    Ok(())
}
