//! What a call allocates, counted.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use grouser_c::run::{grouser_run_pose, grouser_run_step};
use grouser_c::status::Status;
use grouser_c::values::{Pose, Reaction, Settled};
use grouser_c::wheel_test::{grouser_forces, grouser_settle};

use super::{made, run_of, wheel_test};

/// The system's allocator, which counts what each thread asks of it.
struct Counting;

thread_local! {
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

// SAFETY: all that is asked goes to the system's allocator as it is.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let _ = COUNT.try_with(|count| count.set(count.get() + 1));
        // SAFETY: as this function's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as this function's.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// How often the thread allocates meanwhile.
fn allocations(act: impl FnOnce()) -> u64 {
    let before = COUNT.get();
    act();
    COUNT.get() - before
}

#[test]
fn wheels_settle_without_allocating() {
    const COUNT: usize = 63;
    let test = wheel_test();
    let loads = [17.0; COUNT];
    let slips: [f64; COUNT] = std::array::from_fn(|place| place as f64 / COUNT as f64);
    let (sinkages, angles) = ([0.012; COUNT], [0.1; COUNT]);
    let [slip, angle] = [slips.as_ptr(), angles.as_ptr()];
    let mut settled = Vec::<Settled>::with_capacity(COUNT);
    let mut reactions = Vec::<Reaction>::with_capacity(COUNT);
    let mut statuses = [Status::Panic; 2];
    let count = allocations(|| {
        // SAFETY: all arrays have room for as many values.
        statuses = unsafe {
            [
                grouser_settle(test, COUNT, loads.as_ptr(), slip, angle, settled.as_mut_ptr()),
                grouser_forces(test, COUNT, sinkages.as_ptr(), slip, angle, reactions.as_mut_ptr()),
            ]
        };
    });
    assert_eq!((statuses, count), ([Status::Ok; 2], 0));
}

/// Steps allocate in the core: lists with an entry for each wheel, and the times of looks. This
/// limit only falls.
#[test]
fn a_step_of_a_run_allocates_little_and_a_pose_nothing() {
    const STEPS: u64 = 50;
    for (changes, most) in [(c"", 20), (c"scenario.simulation=\"quasi-steady\"", 43)] {
        let run = run_of(changes);
        let speeds = [0.5, 0.5, 0.6, 0.6];
        // SAFETY: there is a speed for each wheel.
        let step =
            || assert_eq!(unsafe { grouser_run_step(run, 4, speeds.as_ptr(), 0.1) }, Status::Ok);
        // In the first one slip settles.
        step();
        let steps = allocations(|| (0..STEPS).for_each(|_| step()));
        let pose = allocations(|| {
            // SAFETY: `made` gives a place for the result.
            made::<Pose>(|out| unsafe { grouser_run_pose(run, out) });
        });
        assert!(steps <= most * STEPS, "{changes:?}: {steps} in {STEPS} steps");
        assert_eq!(pose, 0);
    }
}
