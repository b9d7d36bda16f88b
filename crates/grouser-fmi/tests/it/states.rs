//! States are values: copied, written as bytes, set.

use std::ffi::c_void;

use grouser::simulation::{
    Approach, BadState, Controller, Numerics, Observation, Run, Scenario, State,
};
use grouser::vehicle::{Battery, Motor, Rover, SpeedControl, Winding};
use grouser_fmi::functions::{
    FmiStatus, fmi3DeserializeFMUState, fmi3DoStep, fmi3FreeFMUState, fmi3GetFMUState,
    fmi3SerializeFMUState, fmi3SerializedFMUStateSize, fmi3SetFMUState,
};

use super::{FEATURES, Instance, Unpacked, scenario};

/// Rim speeds that differ from step to step and from side to side [m/s].
fn rims(step: u32, wheels: usize) -> Vec<f64> {
    (0..wheels).map(|wheel| 0.05 + 0.002 * f64::from(step % 3) + 0.003 * wheel as f64).collect()
}

/// Whatever a run has met, its state as bytes goes on as the run does.
#[test]
fn a_run_goes_on_from_its_bytes_bit_for_bit() {
    for (feature, settings) in FEATURES {
        let scenario = scenario(settings).value;
        let wheels = scenario.rover.wheel_count();
        let mut run = Run::new(&scenario).expect("a run");
        for step in 0..3 {
            let bytes = run.state().to_bytes();
            let state = State::from_bytes(&bytes, &scenario).expect(feature);
            assert_eq!(state.to_bytes(), bytes, "{feature}");
            let mut other = Run::resume(&scenario, state);
            // In a step the wheels keep their speeds once, so that what a solver knows counts.
            for span in [0.13, 0.1] {
                run.step(&rims(step, wheels), span).expect(feature);
                other.step(&rims(step, wheels), span).expect(feature);
            }
            assert_eq!(run.now(), other.now(), "{feature}");
            assert_eq!(run.state().to_bytes(), other.state().to_bytes(), "{feature}");
        }
    }
}

/// A rover with small motors behind controllers, their windings, and a battery of two cells: wheels
/// have speeds of their own, and a supply that changes.
fn powered(approach: Approach) -> Scenario {
    let scenario = scenario(&[]).value;
    let winding = Winding {
        thermal_resistance: 20.0,
        heat_capacity: 2.0,
        surroundings: 20.0,
        highest: 125.0,
        derated_from: None,
    };
    let control = SpeedControl { gain: 0.5, integral: 2.0, voltage: None, current: None };
    let motor = Motor {
        resistance: 10.0,
        torque_constant: 0.010,
        gear_ratio: 250.0,
        efficiency: 0.6,
        friction: 1e-3,
        is_self_locking: false,
        feeds_back: false,
        control: Some(control),
        winding: Some(winding),
    };
    let battery = Battery {
        capacity: 72e3,
        full_voltage: 8.4,
        empty_voltage: 6.4,
        resistance: 0.3,
        cutoff_voltage: 5.5,
        electronics: 3.0,
        charge: 1.0,
    };
    let mut parts = scenario.rover.parts().clone();
    (parts.wheel_unit.motor, parts.battery) = (Some(motor), Some(battery));
    let numerics = Numerics { approach, ..scenario.numerics };
    Scenario { rover: Rover::draft(parts).checked().expect("a rover"), numerics, ..scenario }
}

#[test]
fn motors_windings_and_battery_go_on_from_bytes() {
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let scenario = powered(approach);
        let mut run = Run::new(&scenario).expect("a run");
        run.step(&[0.05; 4], 1.3).expect("a step");
        let state = State::from_bytes(&run.state().to_bytes(), &scenario).expect("a state");
        assert!(state.battery().is_some_and(|battery| battery.charge < 1.0));
        assert!(state.warmest().is_some_and(|warmest| warmest > 20.0));
        let mut other = Run::resume(&scenario, state);
        run.step(&[0.06; 4], 2.1).expect("a step");
        other.step(&[0.06; 4], 2.1).expect("a step");
        assert_eq!(run.now(), other.now());
        assert_eq!(run.state().to_bytes(), other.state().to_bytes());
    }
}

/// The wheels of a mission are steered: its state has their angles.
#[test]
fn steered_wheels_go_on_from_bytes() {
    struct ToTheLeft;
    impl Controller for ToTheLeft {
        fn command(&mut self, _seen: &Observation<'_>, rim_speeds: &mut [f64]) {
            rim_speeds.fill(0.05);
        }
        fn steer(&mut self, _seen: &Observation<'_>, angles: &mut [f64]) {
            angles.fill(0.2);
        }
        fn period(&self) -> Option<f64> {
            Some(0.1)
        }
    }
    let scenario = scenario(&["scenario.rover=hakuto-steered"]).value;
    let mut run = Run::new(&scenario).expect("a run");
    run.advance(&mut ToTheLeft, 1.0).expect("a motion");
    let state = State::from_bytes(&run.state().to_bytes(), &scenario).expect("a state");
    let mut other = Run::resume(&scenario, state);
    assert!(other.now().wheels.iter().any(|wheel| wheel.steering > 0.0));
    run.advance(&mut ToTheLeft, 2.0).expect("a motion");
    other.advance(&mut ToTheLeft, 2.0).expect("a motion");
    assert_eq!(run.now(), other.now());
}

#[test]
fn a_run_that_has_ended_keeps_its_outcome_in_its_bytes() {
    let steep = scenario(&["scenario.slope_deg=35"]).value;
    let mut run = Run::new(&steep).expect("a run");
    run.run_to_end().expect("an end");
    let outcome = run.outcome().cloned();
    assert!(outcome.is_some());
    let state = State::from_bytes(&run.state().to_bytes(), &steep).expect("a state");
    assert_eq!(state.outcome().cloned(), outcome);
}

#[test]
fn damaged_bytes_are_refused() {
    let on_plane = scenario(&[]).value;
    let bytes = Run::new(&on_plane).expect("a run").state().to_bytes();
    for length in 0..bytes.len() {
        let error = State::from_bytes(&bytes[..length], &on_plane).err();
        assert_eq!(error, Some(BadState::Unreadable), "{length} bytes");
    }
    for place in 0..bytes.len() {
        let mut damaged = bytes.clone();
        damaged[place] ^= 1;
        let error = State::from_bytes(&damaged, &on_plane).err();
        assert_eq!(error, Some(BadState::Unreadable), "byte {place}");
    }
    let six = scenario(&["scenario.rover=curiosity"]).value;
    let error = State::from_bytes(&bytes, &six).err();
    assert_eq!(error, Some(BadState::OtherWheels { found: 4, expected: 6 }));
}

impl Instance<'_> {
    fn step(&self, from: f64, span: f64) -> FmiStatus {
        let null = std::ptr::null_mut();
        // SAFETY: results that are not asked for have no place.
        unsafe { fmi3DoStep(self.handle, from, span, true, null, null, null, std::ptr::null_mut()) }
    }

    fn state(&self) -> *mut c_void {
        let mut state = std::ptr::null_mut();
        // SAFETY: there is a place for the state.
        assert_eq!(unsafe { fmi3GetFMUState(self.handle, &raw mut state) }, FmiStatus::Ok);
        state
    }

    fn bytes(&self) -> Vec<u8> {
        let (mut state, mut size) = (self.state(), 0);
        // SAFETY: there is room for the size and for as many bytes.
        unsafe {
            assert_eq!(
                fmi3SerializedFMUStateSize(self.handle, state, &raw mut size),
                FmiStatus::Ok
            );
            let mut bytes = vec![0; size];
            let written = fmi3SerializeFMUState(self.handle, state, bytes.as_mut_ptr(), size);
            assert_eq!(written, FmiStatus::Ok);
            assert_eq!(fmi3FreeFMUState(self.handle, &raw mut state), FmiStatus::Ok);
            bytes
        }
    }

    fn read(&self, bytes: &[u8]) -> (FmiStatus, *mut c_void) {
        let mut state = std::ptr::null_mut();
        // SAFETY: there are as many bytes, and a place for the state.
        let status = unsafe {
            fmi3DeserializeFMUState(self.handle, bytes.as_ptr(), bytes.len(), &raw mut state)
        };
        (status, state)
    }
}

/// Steps between looks of their own, with a state copied and another written as bytes on the way,
/// set in the same instance and in one that was just made.
#[test]
fn an_instance_goes_on_from_a_copy_and_from_bytes_bit_for_bit() {
    for (feature, settings) in FEATURES {
        let fmu = Unpacked::of_scenario(settings);
        let one = Instance::new(&fmu).initialized();
        let name = |place: usize| {
            let loaded = scenario(settings);
            format!("{}.commanded_wheel_speed_rad_s", loaded.value.rover.mounts()[place].name)
        };
        assert_eq!(one.step(0.0, 0.13), FmiStatus::Ok, "{feature}: {}", one.said());
        let (copy, bytes) = (one.state(), one.bytes());
        let go_on = |instance: &Instance<'_>| {
            assert_eq!(instance.try_set(&name(1), 0.7), FmiStatus::Ok);
            assert_eq!(instance.step(0.13, 0.21), FmiStatus::Ok);
            instance.bytes()
        };
        let expected = go_on(&one);
        assert_eq!(fmi3SetFMUState(one.handle, copy), FmiStatus::Ok);
        assert_eq!(go_on(&one), expected, "{feature}");
        let other = Instance::new(&fmu);
        let (status, state) = other.read(&bytes);
        assert_eq!(status, FmiStatus::Ok, "{feature}: {}", other.said());
        assert_eq!(fmi3SetFMUState(other.handle, state), FmiStatus::Ok);
        assert_eq!(go_on(&other), expected, "{feature}");
        assert_eq!(other.get("x_m").to_bits(), one.get("x_m").to_bits(), "{feature}");
    }
}

#[test]
fn bytes_of_another_fmu_and_damaged_ones_are_errors() {
    let (plane, moon) =
        (Unpacked::of_scenario(&[]), Unpacked::of_scenario(&["scenario.gravity_m_s2=1.62"]));
    let (one, other) = (Instance::new(&plane).initialized(), Instance::new(&moon));
    let bytes = one.bytes();
    let (status, state) = other.read(&bytes);
    assert_eq!((status, state.is_null()), (FmiStatus::Error, true));
    assert!(other.said().contains("another FMU"), "{}", other.said());
    for length in [0, 5, bytes.len() / 2, bytes.len() - 1] {
        assert_eq!(one.read(&bytes[..length]).0, FmiStatus::Error, "{length}");
        assert!(one.said().contains("damaged"), "{}", one.said());
    }
    let mut state = one.state();
    let other_state = state;
    // SAFETY: the place is one of a state.
    assert_eq!(unsafe { fmi3FreeFMUState(one.handle, &raw mut state) }, FmiStatus::Ok);
    assert!(state.is_null());
    assert_eq!(fmi3SetFMUState(one.handle, other_state), FmiStatus::Error);
    assert!(one.said().contains("freed"), "{}", one.said());
}
