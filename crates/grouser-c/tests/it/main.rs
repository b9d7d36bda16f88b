//! What C can rely on: the bits, the codes, and what a call allocates.
//!
//! These tests call the functions that C calls. `cargo xtask c` compares the header, compiles
//! the programs in `examples` and `tests/wrong_uses.c`, and compares what they print.

#![expect(unsafe_code, reason = "functions for C take pointers")]

mod allocations;
mod bits;
mod codes;

use std::ffi::CStr;
use std::mem::MaybeUninit;

use grouser_c::run::{Run, grouser_run_new};
use grouser_c::status::{Status, grouser_last_error};
use grouser_c::wheel_test::{WheelTest, grouser_wheel_test_new};

/// What a call writes to its last argument.
///
/// # Panics
/// If the call fails.
fn made<T>(call: impl FnOnce(*mut T) -> Status) -> T {
    let mut out = MaybeUninit::uninit();
    let status = call(out.as_mut_ptr());
    assert_eq!(status, Status::Ok, "{}", last_error());
    // SAFETY: a call that succeeds has written its result.
    unsafe { out.assume_init() }
}

fn last_error() -> String {
    // SAFETY: the text is this thread's, which makes no call meanwhile.
    unsafe { CStr::from_ptr(grouser_last_error()) }.to_string_lossy().into_owned()
}

/// HAKUTO's wheel on Toyoura sand.
fn wheel_test() -> WheelTest {
    let null = std::ptr::null();
    let (soil, wheel) = (c"toyoura".as_ptr(), c"hakuto".as_ptr());
    // SAFETY: texts end with a zero, and `made` gives a place for the result.
    made(|out| unsafe { grouser_wheel_test_new(soil, wheel, null, null, out) })
}

/// HAKUTO on a slope of 10°, with changes.
fn run_of(changes: &CStr) -> Run {
    let scenario = c"schema = \"scenario/1\"\nname = \"traverse\"\n".as_ptr();
    // SAFETY: texts end with a zero, and `made` gives a place for the result.
    made(|out| unsafe { grouser_run_new(scenario, changes.as_ptr(), out) })
}
