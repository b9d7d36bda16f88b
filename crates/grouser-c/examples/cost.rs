//! Measures what a step of a run costs through the C interface, beside the Rust library.
//!
//! `cargo run --release -p grouser-c --example cost`

#![expect(unsafe_code, reason = "functions for C take pointers")]

use std::error::Error;
use std::hint::black_box;
use std::mem::MaybeUninit;
use std::time::Instant;

use grouser_c::run::{
    Run, grouser_run_free, grouser_run_new, grouser_run_pose, grouser_run_step, grouser_run_wheels,
};
use grouser_c::status::Status;
use grouser_c::values::{Pose, Wheel};
use grouser_core::simulation::Run as CoreRun;
use grouser_io::{Overrides, Source, read_scenario};

/// Steps of a run; some of their time is that of its start, in which slip settles.
const STEPS: usize = 190;
/// Runs, of which the fastest counts: nothing disturbed it.
const RUNS: usize = 30;
const DURATION: f64 = 0.1;
const WHEEL_SPEED: f64 = 0.5;

fn main() -> Result<(), Box<dyn Error>> {
    let by_rust = fastest(of_rust)?;
    let by_c = fastest(of_c)?;
    println!("a step of {DURATION} s, with pose and wheels: Rust {by_rust:.2} µs, C {by_c:.2} µs");
    println!("a pose alone by C: {:.0} ns", fastest(of_poses)? * 1e3);
    Ok(())
}

/// The least time of a step in some runs [µs].
fn fastest(run: impl Fn() -> Result<f64, Box<dyn Error>>) -> Result<f64, Box<dyn Error>> {
    (0..RUNS).try_fold(f64::INFINITY, |least, _| Ok(run()?.min(least)))
}

fn of_rust() -> Result<f64, Box<dyn Error>> {
    let scenario = read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
    let mut run = CoreRun::new(&scenario)?;
    let mounts = scenario.rover.mounts().iter();
    let rims: Vec<f64> = mounts.map(|mount| WHEEL_SPEED * mount.shearing_radius()).collect();
    let start = Instant::now();
    for _ in 0..STEPS {
        run.step(&rims, DURATION)?;
        black_box((run.state().rover(), run.now()));
    }
    Ok(start.elapsed().as_secs_f64() * 1e6 / STEPS as f64)
}

fn of_c() -> Result<f64, Box<dyn Error>> {
    let run = new_run()?;
    let (speeds, start) = ([WHEEL_SPEED; 4], Instant::now());
    let mut pose = MaybeUninit::<Pose>::uninit();
    let mut wheels = [const { MaybeUninit::<Wheel>::uninit() }; 4];
    for _ in 0..STEPS {
        // SAFETY: there is a speed, and room, for each wheel, and a place for the pose.
        let statuses = unsafe {
            [
                grouser_run_step(run, 4, speeds.as_ptr(), DURATION),
                grouser_run_pose(run, pose.as_mut_ptr()),
                grouser_run_wheels(run, 4, wheels.as_mut_ptr().cast()),
            ]
        };
        assert_eq!(statuses, [Status::Ok; 3]);
    }
    let time = start.elapsed().as_secs_f64() * 1e6 / STEPS as f64;
    grouser_run_free(run);
    Ok(time)
}

fn of_poses() -> Result<f64, Box<dyn Error>> {
    const POSES: usize = 100_000;
    let run = new_run()?;
    let start = Instant::now();
    let mut pose = MaybeUninit::<Pose>::uninit();
    for _ in 0..POSES {
        // SAFETY: there is a place for the pose.
        assert_eq!(unsafe { grouser_run_pose(run, pose.as_mut_ptr()) }, Status::Ok);
    }
    let time = start.elapsed().as_secs_f64() * 1e6 / POSES as f64;
    grouser_run_free(run);
    Ok(time)
}

fn new_run() -> Result<Run, Box<dyn Error>> {
    let scenario = c"schema = \"scenario/1\"\nname = \"traverse\"\n".as_ptr();
    let mut run = Run::default();
    // SAFETY: the text ends with a zero, and there is a place for the run.
    match unsafe { grouser_run_new(scenario, std::ptr::null(), &raw mut run) } {
        Status::Ok => Ok(run),
        status => Err(format!("{status:?}").into()),
    }
}
