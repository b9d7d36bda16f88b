//! The bits of the library, through the functions for C.

use grouser_c::mission::{
    Mission, grouser_mission_copy, grouser_mission_new, grouser_mission_next_leg,
    grouser_mission_pose,
};
use grouser_c::run::{
    Run, grouser_run_copy, grouser_run_free, grouser_run_play, grouser_run_pose,
    grouser_run_restore, grouser_run_save, grouser_run_step, grouser_run_wheel_name,
    grouser_run_wheels, grouser_state_free, grouser_state_read, grouser_state_size,
    grouser_state_write,
};
use grouser_c::status::Status;
use grouser_c::time_step::{
    EngineStep, MechanismState, grouser_mechanism_step, grouser_stepping_wheels_free,
    grouser_stepping_wheels_new,
};
use grouser_c::values::{MountedWheel, Pose, Settled, Stepped, Wheel, Wrench};
use grouser_c::wheel_test::{grouser_settle, grouser_wheel_test_free};
use grouser_core::contact::mechanism::{self, Mechanism};
use grouser_core::contact::time_step::{REST_SPEED, SINKAGE_DAMPING};
use grouser_core::contact::{Contact, Ishigami, Slip, SteppingWheel, TimeStep, settle};
use grouser_core::mission::MissionRun;
use grouser_core::paper;
use grouser_core::simulation::{Run as CoreRun, Scenario};
use grouser_core::units::{EARTH_GRAVITY, Vec3};
use grouser_core::vehicle::Mount;
use grouser_io::columns::wheel::WHEEL;
use grouser_io::{Overrides, Source, read_mission, read_scenario};

use super::{made, run_of, wheel_test};

fn pose(run: Run) -> Pose {
    // SAFETY: `made` gives a place for the result.
    made(|out| unsafe { grouser_run_pose(run, out) })
}

fn wheels(run: Run) -> [Wheel; 4] {
    // SAFETY: there is room for each wheel.
    made::<[Wheel; 4]>(|out| unsafe { grouser_run_wheels(run, 4, out.cast()) })
}

fn step(run: Run, speeds: [f64; 4]) {
    // SAFETY: there is a speed for each wheel.
    assert_eq!(unsafe { grouser_run_step(run, 4, speeds.as_ptr(), 0.1) }, Status::Ok);
}

fn default_scenario() -> Scenario {
    read_scenario(&Source::default_scenario(), &Overrides::none()).expect("it is read").value
}

#[test]
fn wheels_have_the_bits_of_the_library_in_any_number() {
    for count in [1, 63, 64, 200] {
        let test = wheel_test();
        let slips: Vec<f64> = (0..count).map(|k| f64::from(k) / f64::from(count)).collect();
        let loads: Vec<f64> = (0..count).map(|k| 5.0 + f64::from(k)).collect();
        let angles: Vec<f64> = slips.iter().map(|slip| 0.3 - slip).collect();
        let mut found = Vec::<Settled>::with_capacity(slips.len());
        let [load, slip, angle] = [&loads, &slips, &angles].map(Vec::as_ptr);
        // SAFETY: all arrays have room for as many values.
        let status =
            unsafe { grouser_settle(test, slips.len(), load, slip, angle, found.as_mut_ptr()) };
        assert_eq!(status, Status::Ok);
        // SAFETY: a call that succeeds has written as many.
        unsafe { found.set_len(slips.len()) };
        for (k, found) in found.iter().enumerate() {
            let slip = Slip::on_test_stand(slips[k], angles[k]);
            let (wheel, soil) = (paper::hakuto_wheel(), paper::toyoura());
            let contact = Contact { wheel, soil, slip, gravity: EARTH_GRAVITY };
            let settled = settle(&Ishigami::DEFAULT, &contact, loads[k]).expect("it is carried");
            let reaction = found.reaction;
            let fields = [
                reaction.sinkage_m,
                reaction.entry_angle_rad,
                reaction.exit_angle_rad,
                reaction.max_stress_angle_rad,
                reaction.drawbar_pull_n,
                reaction.side_force_n,
                reaction.side_force_from_shear_n,
                reaction.bulldozing_load_n,
                reaction.normal_force_n,
                reaction.torque_nm,
                reaction.overturning_moment_nm,
                reaction.aligning_moment_nm,
                reaction.thrust_n,
                reaction.motion_resistance_n,
                reaction.max_normal_stress_pa,
            ];
            let columns = WHEEL
                .iter()
                .map(|column| (column.name, column.unit.to_si(column.number(&settled))));
            for (found, (name, expected)) in fields.into_iter().zip(columns) {
                // Columns are in their own units, and back from there to the last digit but one.
                let tolerance = 4.0 * f64::EPSILON * expected.abs();
                assert!((found - expected).abs() <= tolerance, "{name}: {found}, not {expected}");
            }
            assert_eq!(reaction.sinkage_m.to_bits(), settled.sinkage.to_bits());
            assert_eq!(reaction.torque_nm.to_bits(), settled.forces.torque.to_bits());
        }
        assert_eq!(grouser_wheel_test_free(test), Status::Ok);
    }
}

#[test]
fn a_run_by_steps_has_the_bits_of_the_library() {
    let run = run_of(c"");
    let scenario = default_scenario();
    let mut core = CoreRun::new(&scenario).expect("it starts");
    for k in 0..40_u32 {
        let speeds = [0.5, 0.5, 0.6, 0.5 + 0.01 * f64::from(k % 7)];
        step(run, speeds);
        let radii = scenario.rover.mounts().iter().map(Mount::shearing_radius);
        let rims: Vec<f64> = radii.zip(speeds).map(|(radius, speed)| speed * radius).collect();
        core.step(&rims, 0.1).expect("it goes on");
        assert_eq!(pose(run), Pose::from(core.state()));
    }
    let expected: Vec<Wheel> = core.now().wheels.iter().map(Wheel::from).collect();
    for (found, expected) in wheels(run).iter().zip(&expected) {
        // Without motors there is no current.
        assert!(found.current_a.is_nan());
        assert_eq!(Wheel { current_a: 0.0, ..*found }, Wheel { current_a: 0.0, ..*expected });
    }
    assert_eq!(grouser_run_free(run), Status::Ok);
}

#[test]
fn a_run_that_plays_its_drive_has_the_bits_of_one_call_to_the_end() {
    let run = run_of(c"");
    let whole = CoreRun::new(&default_scenario()).expect("it starts").to_end().expect("it ends");
    for record in whole.records.iter().skip(1) {
        assert_eq!(grouser_run_play(run, 0.1), Status::Ok);
        let (found, state) = (pose(run), record.state);
        assert_eq!(found.time_s, record.time);
        assert_eq!(
            (found.x_m, found.y_m, found.yaw_rad),
            (state.position.x, state.position.y, state.yaw)
        );
        for (found, expected) in wheels(run).iter().zip(&record.wheels) {
            assert_eq!(found.reaction, Wheel::from(expected).reaction);
        }
    }
    let end = pose(run);
    assert_eq!(grouser_run_play(run, 0.1), Status::Ok);
    assert_eq!(pose(run), end);
}

#[test]
fn a_restored_run_goes_on_with_the_same_bits() {
    let run = run_of(c"");
    (0..15).for_each(|_| step(run, [0.5, 0.5, 0.6, 0.6]));
    // SAFETY: `made` gives a place for the result.
    let (state, copy) =
        unsafe { (made(|out| grouser_run_save(run, out)), made(|out| grouser_run_copy(run, out))) };
    let go_on = |run| {
        (0..15).for_each(|_| step(run, [0.7, 0.6, 0.6, 0.6]));
        pose(run)
    };
    let first = go_on(run);
    assert_eq!(grouser_run_restore(run, state), Status::Ok);
    let other = run_of(c"");
    assert_eq!(grouser_run_restore(other, state), Status::Ok);
    assert_eq!([go_on(run), go_on(copy), go_on(other)], [first; 3]);
    // The same from bytes.
    let mut size = 0;
    // SAFETY: there are places for the size and for as many bytes.
    let bytes = unsafe {
        assert_eq!(grouser_state_size(state, &raw mut size), Status::Ok);
        let mut bytes = vec![0; size];
        assert_eq!(grouser_state_write(state, size, bytes.as_mut_ptr()), Status::Ok);
        assert_eq!(grouser_state_write(state, size - 1, bytes.as_mut_ptr()), Status::WrongSize);
        bytes
    };
    // SAFETY: there are as many bytes, and `made` gives a place for the result.
    let read = made(|out| unsafe { grouser_state_read(other, size, bytes.as_ptr(), out) });
    assert_eq!(grouser_run_restore(other, read), Status::Ok);
    assert_eq!(go_on(other), first);
    // What does not change is no part of a state.
    let steeper = run_of(c"scenario.slope_deg=12");
    assert_eq!(grouser_run_restore(steeper, state), Status::OtherScenario);
    assert_eq!(grouser_state_free(state), Status::Ok);
}

/// Where a mission ends that is driven to its end from where it is.
fn drive_on(mission: Mission) -> Pose {
    let mut driven = true;
    let mut leg = std::mem::MaybeUninit::uninit();
    while driven {
        // SAFETY: both places are ours.
        let status =
            unsafe { grouser_mission_next_leg(mission, leg.as_mut_ptr(), &raw mut driven) };
        assert_eq!(status, Status::Ok);
    }
    // SAFETY: `made` gives a place for the result.
    made(|out| unsafe { grouser_mission_pose(mission, out) })
}

#[test]
fn a_mission_has_the_bits_of_the_library() {
    let text = "schema = \"mission/1\"\nname = \"two legs\"\n[[leg]]\ndrive_m = 0.2\n[[leg]]\nturn_deg = 10.0\n";
    let plan = read_mission(&Source::text("m", text), &Overrides::none()).expect("it is read");
    let report =
        MissionRun::new(&plan.value.mission()).expect("it starts").to_end().expect("it ends");
    let text = std::ffi::CString::new(text).expect("it has no zero");
    let null = std::ptr::null();
    // SAFETY: texts end with a zero, and `made` gives a place for the result.
    let mission = made(|out| unsafe { grouser_mission_new(text.as_ptr(), null, null, out) });
    // SAFETY: `made` gives a place for the result.
    let copy = made(|out| unsafe { grouser_mission_copy(mission, out) });
    for leg in &report.legs {
        let mut driven = false;
        // SAFETY: both places are ours.
        let found: grouser_c::values::Leg =
            made(|out| unsafe { grouser_mission_next_leg(mission, out, &raw mut driven) });
        assert!(driven);
        assert_eq!((found.distance_m, found.duration_s), (leg.distance, leg.time));
        assert_eq!(found.outcome, leg.outcome.kind().into());
    }
    assert_eq!(drive_on(copy), drive_on(mission));
    // SAFETY: `made` gives a place for the result.
    let end: Pose = made(|out| unsafe { grouser_mission_pose(mission, out) });
    let expected = report.legs.last().expect("two legs").end;
    assert_eq!(
        (end.x_m, end.y_m, end.yaw_rad),
        (expected.position.x, expected.position.y, expected.yaw)
    );
}

/// A free body of 1.7 kg on one wheel, 10 mm deep.
#[test]
fn a_step_of_a_mechanism_has_the_bits_of_the_library() {
    let (wheel, soil, model) = (paper::hakuto_wheel(), paper::toyoura(), Ishigami::DEFAULT);
    let distance = wheel.shearing_radius() - 0.01;
    let jacobians: [f64; 36] = std::array::from_fn(|k| if k % 7 == 0 { 1.0 } else { 0.0 });
    let masses = [1.7, 1.7, 1.7, 0.1, 0.2, 0.1];
    let inertia: [f64; 36] = std::array::from_fn(|k| jacobians[k] * masses[k % 6]);
    let velocities = [0.05, 0.01, -0.02, 0.0, 0.4, 0.0];
    let held = mechanism::Wrench { force: Vec3::new(0.1, 0.0, 3.0), moment: Vec3::zeros() };
    let (axle, arm, normal) = (Vec3::y(), Vec3::new(0.0, 0.02, 0.0), Vec3::z());
    let radius = wheel.shearing_radius();
    let mounted = [mechanism::MountedWheel { radius, axle, arm, normal, distance, held }];
    let (jacobians, inertia, velocities) = (&jacobians[..], &inertia[..], &velocities[..]);
    let with_moments = true;
    let of_core = Mechanism { wheels: &mounted, jacobians, inertia, velocities, with_moments };
    let response = of_core.response(2e-3).expect("it has an inertia");
    let step = TimeStep {
        duration: 2e-3,
        gravity: 1.62,
        damping: SINKAGE_DAMPING,
        rest_speed: REST_SPEED,
        inverse_mass: &response.inverse_mass,
        free: &response.free,
    };
    let sinkage = mounted[0].sinkage();
    let stepping = [SteppingWheel { model: &model, wheel, soil, sinkage }];
    let expected = step.reaction_near(&stepping, &response.preliminary);
    let wrench = mounted[0].wrench(&expected.wheels[0].forces, with_moments);

    let test = wheel_test();
    // SAFETY: there is one wheel test, and `made` gives a place for the result.
    let wheels = made(|out| unsafe {
        grouser_stepping_wheels_new(1, &raw const test, SINKAGE_DAMPING, REST_SPEED, out)
    });
    let held = Wrench { force_n: held.force.into(), moment_nm: held.moment.into() };
    let mounted = MountedWheel {
        axle: axle.into(),
        arm_m: arm.into(),
        normal: normal.into(),
        hub_height_m: distance,
        held,
    };
    let state = MechanismState {
        wheel_count: 1,
        wheels: &raw const mounted,
        velocity_count: 6,
        velocities: velocities.as_ptr(),
        jacobians: jacobians.as_ptr(),
        inertia: inertia.as_ptr(),
        with_moments,
    };
    let step = EngineStep { duration_s: 2e-3, gravity_m_s2: 1.62 };
    let (mut residual, mut stepped) = (f64::NAN, std::mem::MaybeUninit::<Stepped>::uninit());
    // SAFETY: the state's arrays are as long as it says, and all places are ours.
    let found: Wrench = made(|out| unsafe {
        let (state, residual) = (&raw const state, &raw mut residual);
        grouser_mechanism_step(wheels, step, state, out, stepped.as_mut_ptr(), residual)
    });
    // SAFETY: a call that succeeds has written its results.
    let stepped = unsafe { stepped.assume_init() };
    assert!(stepped.reaction.normal_force_n > 1.0, "the soil carries something");
    assert_eq!(stepped, Stepped::from(&expected.wheels[0]));
    assert_eq!(
        (Vec3::from(found.force_n), Vec3::from(found.moment_nm)),
        (wrench.force, wrench.moment)
    );
    assert_eq!(residual.to_bits(), expected.residual.to_bits());
    assert_eq!(grouser_stepping_wheels_free(wheels), Status::Ok);
}

#[test]
fn wheels_have_their_names() {
    let (run, mut buffer) = (run_of(c""), [0; 32]);
    // SAFETY: the buffer has as many bytes.
    let status = unsafe { grouser_run_wheel_name(run, 2, buffer.as_mut_ptr(), buffer.len()) };
    // SAFETY: a call that succeeds has written a text with its zero.
    let name = unsafe { std::ffi::CStr::from_ptr(buffer.as_ptr()) };
    let expected = default_scenario().rover.mounts()[2].name.clone();
    assert_eq!((status, name.to_str()), (Status::Ok, Ok(expected.as_str())));
}
