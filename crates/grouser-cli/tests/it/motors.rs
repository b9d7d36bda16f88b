//! Rovers with motors: what a run says of currents and of the battery.

use crate::bad_input::check_is_refusal;
use crate::program::{Place, changed_preset, keys, number};

pub(crate) const MOTOR: &str = "torque_constant_nm_a = 0.01\ngear_ratio = 250.0\ngear_efficiency = 0.6\nfriction_torque_nm = 0.001\n";

pub(crate) fn rover(motor: &str) -> String {
    changed_preset("rover", "hakuto", "[body]", &format!("[motor]\n{motor}\n[body]"))
}

/// The command's contract: mechanical numbers stay, electrical ones stand beside them.
#[test]
fn a_rover_with_motors_says_what_they_take() {
    let place = Place::new();
    place.write("r.toml", rover(&format!("resistance_ohm = 10.0\n{MOTOR}")));
    let line = "traverse --duration-s 2 --rover";
    let [with, without] = ["r.toml", "hakuto"].map(|rover| place.json(&format!("{line} {rover}")));
    assert_eq!(with["energy_j"], without["energy_j"]);
    assert!(number(&with["battery_energy_j"]) > 3.0 * number(&with["energy_j"]));
    assert!(!keys(&without).contains(&"battery_energy_j"));
    let (end, plain) = (&with["final"], &without["final"]);
    assert_eq!((&end["x_m"], &end["power_w"]), (&plain["x_m"], &plain["power_w"]));
    let wheels = end["wheels"].as_array().expect("wheels");
    let sum: f64 = wheels.iter().map(|wheel| number(&wheel["electrical_power_w"])).sum();
    assert!((sum - number(&end["electrical_power_w"])).abs() < 1e-12);
    for wheel in wheels {
        let current = (number(&wheel["torque_nm"]) / 150.0 + 0.001) / 0.01;
        assert!((number(&wheel["current_a"]) - current).abs() < 1e-12, "{wheel}");
    }
    assert_eq!(place.line("mission arc --rover r.toml --out out").code(), 0);
    let first = place.read("out/records.csv").lines().next().expect("columns").to_owned();
    assert!(first.contains(",battery_energy_j,") && first.contains(",front-left.current_a,"));
    let page = place.read("out/report.html");
    assert!(page.contains("Current of its motor") && page.contains("battery_energy_j"));
}

/// Legs and the whole say what they took where that is known, in every format; a limit on what is
/// not known is refused with its place, and what to add.
#[test]
fn missions_say_what_motors_and_battery_take() {
    let place = Place::new();
    let battery = "[battery]\ncapacity_wh = 10.0\nfull_voltage_v = 8.4\nempty_voltage_v = 6.4\n";
    place.write("r.toml", rover(&format!("resistance_ohm = 10.0\n{MOTOR}{battery}")));
    let mission = "schema = \"mission/1\"\nname = \"m\"\n[stop]\ncurrent_a = { above = 9.0 }\n[[leg]]\ndrive_m = 0.2\n[[leg]]\nwait_s = 1.0\n";
    place.write("m.toml", mission);
    let all = place.json("mission m.toml --rover r.toml --out out");
    let legs = all["legs"].as_array().expect("legs");
    let sum: f64 = legs.iter().map(|leg| number(&leg["battery_energy_j"])).sum();
    assert!((sum / number(&all["battery_energy_j"]) - 1.0).abs() < 1e-12 && sum > 0.0);
    assert_eq!(all["state_of_charge"], legs[1]["state_of_charge"]);
    assert!(number(&all["current_a"]) > 0.0 && !keys(&all).contains(&"winding_temperature_degc"));
    let head = place.read("out/legs.csv").lines().next().expect("columns").to_owned();
    assert!(head.ends_with(",battery_energy_j,current_a,state_of_charge"), "{head}");
    let page = place.read("out/report.html");
    assert!(page.contains("Largest current of a motor, with the turn before it"));
    let table = place.line("mission m.toml --rover r.toml").stdout;
    assert!(table.contains("battery") && table.contains(" J electrical"), "{table}");
    let refused = check_is_refusal(&place.line("mission m.toml"), 2);
    for expected in ["m.toml:4", "current_a", "no [motor]", "add [motor] to the rover's document"] {
        assert!(refused.contains(expected), "{refused}");
    }
}

#[test]
fn bad_motors_are_refused() {
    let place = Place::new();
    let bad =
        [MOTOR.to_owned(), format!("resistance_ohm = 0.0\n{MOTOR}"), MOTOR.replace("0.6", "60.0")];
    for motor in bad {
        place.write("r.toml", rover(&motor));
        let refused = check_is_refusal(&place.line("traverse --rover r.toml"), 2);
        assert!(refused.contains("motor."), "{refused}");
    }
}
