//! Motors of data sheets: whether their numbers agree, and how a rover names one and changes single
//! keys.

use grouser::document::{
    DocumentError, Kind, LoadedRover, Overrides, Source, preset, presets, read_motor, read_rover,
};
use grouser::vehicle::Motor;

fn motor(name: &str) -> Motor {
    let source = Source::find(Kind::Motor, name).expect("a preset");
    read_motor(&source, &Overrides::none()).expect("a motor").value
}

/// Source: the data sheets that the presets name: nominal voltage [V], speed without load [rpm],
/// stall torque [mN·m].
const PRINTED: [(&str, f64, f64, f64); 5] = [
    ("maxon-a-max-22", 12.0, 10400.0, 24.3),
    ("maxon-re-25", 12.0, 4860.0, 129.0),
    ("maxon-re-25-24-v", 24.0, 9560.0, 243.0),
    ("maxon-re-30", 24.0, 8810.0, 1020.0),
    ("faulhaber-1331", 12.0, 9900.0, 9.90),
];

/// (V − R i_0)/k is the speed without load, k V/R the torque that stalls. A tolerance of 3 % for
/// the speed: friction grows with it, most under graphite brushes; and of 1.5 % for the torque,
/// which is printed with or without friction.
#[test]
fn numbers_of_a_data_sheet_agree() {
    assert_eq!(presets(Kind::Motor).count(), PRINTED.len());
    for (name, voltage, rpm, torque) in PRINTED {
        let motor = motor(name);
        let speed = motor.no_load_speed(voltage) * motor.gear_ratio * 60.0 / std::f64::consts::TAU;
        assert!((speed / rpm - 1.0).abs() < 0.03, "{name}: {speed} rpm");
        let stall = 1e3 * motor.torque_constant * motor.stall_current(voltage);
        assert!((stall / torque - 1.0).abs() < 0.015, "{name}: {stall} mN·m");
    }
}

/// Each keeps 150 s or more of an overload's heat, and its winding is a part of that: what the two
/// bodies of the data sheet are to be as one.
#[test]
fn a_winding_and_its_housing_warm_as_slowly_as_the_data_sheet_says() {
    for (name, seconds) in
        [("maxon-re-25", 612.0), ("maxon-re-30", 593.0), ("faulhaber-1331", 190.0)]
    {
        let winding = motor(name).winding.expect("thermal data");
        let constant = winding.thermal_resistance * winding.heat_capacity;
        assert!((constant / seconds - 1.0_f64).abs() < 2e-3, "{name}: {constant} s");
    }
}

fn rover(motor: &str, overrides: &[&str]) -> Result<LoadedRover, DocumentError> {
    let text = preset(Kind::Rover, "hakuto").expect("it comes with the library").text;
    let text = text.replace("[body]", &format!("{motor}\n[body]"));
    read_rover(&Source::text("rover", text), &Overrides::parse(overrides)?)
}

#[test]
fn a_rover_names_the_motor_of_all_wheels_or_of_one() {
    let named = rover("motor = \"maxon-re-25\"", &[]).expect("a rover");
    for mount in named.value.mounts() {
        assert_eq!(mount.unit.motor, Some(motor("maxon-re-25")));
    }
    let set = rover("", &["rover.motor=maxon-re-25"]).expect("a rover");
    assert_eq!(set.value.mounts(), named.value.mounts());
    let says =
        |rover: &LoadedRover, what: &str| rover.assumptions.iter().any(|it| it.contains(what));
    assert!(says(&named, "motor maxon RE 25 with GP 32 A 246:1: gear_efficiency"));

    let one = rover("", &["rover.mount.1.motor=maxon-re-30"]).expect("a rover");
    let motors: Vec<_> = one.value.mounts().iter().map(|mount| mount.unit.motor).collect();
    assert_eq!(motors, [None, Some(motor("maxon-re-30")), None, None]);
}

#[test]
fn a_rover_changes_single_keys_of_a_motor_and_says_so() {
    let expected = Motor { gear_ratio: 500.0, ..motor("maxon-re-25") };
    let in_document = "[motor]\npreset = \"maxon-re-25\"\ngear_ratio = 500.0";
    let from_document = rover(in_document, &[]).expect("a rover");
    let from_outside =
        rover("motor = \"maxon-re-25\"", &["motor.gear_ratio=500"]).expect("a rover");
    let by_rover = rover("motor = \"maxon-re-25\"", &["rover.motor.gear_ratio=500"]);
    for changed in [&from_document, &from_outside, &by_rover.expect("a rover")] {
        assert_eq!(changed.value.mounts()[0].unit.motor, Some(expected));
        let note = changed.assumptions.iter().find(|it| it.contains("gear_ratio: set "));
        assert!(note.is_some(), "{:?}", changed.assumptions);
    }
    let source = from_document.document.text("motor.source").expect("that of the preset");
    assert!(source.starts_with("maxon data sheet RE 25"), "{source}");
    // The resolved document stands on its own, and has the same notes.
    let resolved = Source::text("resolved", from_document.to_toml());
    let again = read_rover(&resolved, &Overrides::none()).expect("a rover");
    assert_eq!(again.to_toml(), from_document.to_toml());
    assert_eq!(again.assumptions, from_document.assumptions);

    // Tables are changed key by key, too, and may be added.
    let table = "[motor]\npreset = \"maxon-re-25\"\nwinding.highest_degc = 80.0\ncontrol.gain_v_s_rad = 2.0";
    let motor = rover(table, &[]).expect("a rover").value.mounts()[0].unit.motor.expect("a motor");
    let winding = motor.winding.expect("the preset's");
    assert!(
        (winding.highest - 80.0).abs() < 1e-12 && (winding.thermal_resistance - 17.1).abs() < 1e-12
    );
    assert!((motor.control.expect("the document's").gain - 2.0).abs() < 1e-12);
}

/// Another motor takes the place of all keys that the document has; those that are set beside it
/// stay.
#[test]
fn another_motor_can_be_set_from_outside() {
    let document = "[motor]\npreset = \"maxon-re-25\"\ngear_ratio = 500.0";
    let other = rover(document, &["motor.preset=maxon-re-30", "motor.self_locking=true"]);
    let expected = Motor { is_self_locking: true, ..motor("maxon-re-30") };
    assert_eq!(other.expect("a rover").value.mounts()[0].unit.motor, Some(expected));
}

#[test]
fn an_unknown_motor_names_its_neighbours() {
    let check = |motor: &str, overrides: &[&str], parts: &[&str]| {
        let error = rover(motor, overrides).expect_err("no such motor").to_string();
        for part in parts {
            assert!(error.contains(part), "{motor} {overrides:?}: {error}");
        }
    };
    check("motor = \"maxon-re-52\"", &[], &["maxon-re-52", "did you mean `maxon-re-25`?"]);
    check("", &["rover.motor=wheelbarrow"], &["the motor presets are maxon-a-max-22, maxon-re-25"]);
    let by_preset = "[motor]\npreset = \"maxon-re-31\"";
    check(by_preset, &[], &["rover:", "did you mean `maxon-re-30`?"]);
    check("[motor]\npreset = \"mine.toml\"", &[], &["is the name of a preset, not a path"]);
    check("[motor]\npreset = 3", &[], &["motor.preset", "text"]);
    // Keys of a motor that is not there are not left out in silence.
    check("", &["motor.gear_ratio=500"], &["motor.resistance_ohm"]);
    check("motor = \"maxon-re-25\"", &["motor=maxon-re-30"], &["rover.motor=NAME"]);
    check("motor = \"maxon-re-25\"", &["motor.gear_ratio=-5"], &["motor.gear_ratio"]);
}
