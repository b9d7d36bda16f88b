//! Missions of rovers whose motors and battery are known: what legs take, and limits on it.

use grouser::document::table::Table;
use grouser::document::{Overrides, Source, read_campaign, read_mission};
use grouser::mission::{
    Cause, Leg, LegOutcome, Limited, Manoeuvre, Mission, MissionReport, MissionRun, Stop, Then,
};
use grouser::simulation::{Approach, CONTROL_PERIOD, Outcome, PowerLost, Record};
use grouser::studies::mission::DrivenMission;
use grouser::units::deg;
use grouser::vehicle::{Battery, Motor};

use super::motors::{BATTERY, MOTOR, WINDING, across, powered, with};

const LIMITED: [Limited; 3] = [Limited::Current, Limited::Temperature, Limited::Discharge];

fn legs() -> Vec<Leg> {
    let climb = Leg { yaw: Some(deg(30.0)), ..Leg::new(Manoeuvre::drive(0.3)) };
    vec![Leg::new(Manoeuvre::drive(0.5)), climb, Leg::new(Manoeuvre::Wait { time: 2.0 })]
}

/// Records stand where a rover is looked at.
fn mission(battery: Battery, approach: Approach) -> Mission {
    let motor = Motor { winding: Some(WINDING), ..MOTOR };
    let mut scenario = powered(motor, battery, across(10.0));
    scenario.numerics.approach = approach;
    scenario.numerics.sample_interval = CONTROL_PERIOD;
    Mission { scenario, legs: legs(), stops: Vec::new(), sensors: None }
}

fn driven(mission: &Mission) -> MissionReport {
    MissionRun::new(mission).expect("a mission").to_end().expect("it can be computed")
}

fn current(record: &Record) -> f64 {
    let currents = record.wheels.iter().filter_map(|wheel| Some(wheel.electrical?.current.abs()));
    currents.fold(0.0, f64::max)
}

fn temperature(record: &Record) -> f64 {
    record.wheels.iter().filter_map(|wheel| wheel.temperature).fold(0.0, f64::max)
}

fn limited(record: &Record, limited: Limited) -> f64 {
    match limited {
        Limited::Current => current(record),
        Limited::Temperature => temperature(record),
        _ => 1.0 - record.battery.expect("a battery").charge,
    }
}

/// Legs add up to the run: what its records have of energy, current, temperature and charge.
#[test]
fn legs_say_what_motors_and_battery_took() {
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let report = driven(&mission(BATTERY, approach));
        assert_eq!(report.outcome(), "completed");
        let (taken, last) = (report.taken().expect("motors"), report.last());
        let off = taken.energy / last.energy.electrical - 1.0;
        assert!(off.abs() < 1e-12, "{approach:?}: {off}");
        assert_eq!(taken.charge, Some(last.battery.expect("a battery").charge));
        for (leg, records) in report.legs_with_records() {
            let taken = leg.taken.expect("motors");
            let (first, last) = (&records[0], &records[records.len() - 1]);
            let energy = last.energy.electrical - first.energy.electrical;
            // The last record of a leg is up to a control period before its end.
            let rest = 6.0 * CONTROL_PERIOD;
            assert!((taken.energy - energy).abs() < rest, "{} J, {energy} J", taken.energy);
            assert!(taken.energy > leg.energy, "losses and electronics");
            let most = records[1..].iter().map(current).fold(0.0, f64::max);
            // A leg may end between two records.
            assert!(taken.current >= most && taken.current < 1.02 * most + 1e-9, "{most} A");
            let warmest = records.iter().map(temperature).fold(0.0, f64::max);
            let highest = taken.temperature.expect("windings");
            assert!(highest >= warmest && highest < warmest + 0.1, "{highest} °C, {warmest} °C");
        }
        // Set to stand, motors take nothing, and the electronics go on.
        let wait = report.legs[2].taken.expect("motors");
        assert!((wait.energy / (3.0 * 2.0) - 1.0).abs() < 0.1, "{} J", wait.energy);
    }
}

/// What is said of them does not depend on who takes the records.
#[test]
fn a_mission_without_records_takes_the_same() {
    let mission = mission(BATTERY, Approach::Dynamic);
    let ways = DrivenMission::all_ends(&[(String::new(), mission.clone())]).expect("it is driven");
    let taken =
        |report: &MissionReport| -> Vec<_> { report.legs.iter().map(|it| it.taken).collect() };
    assert_eq!(taken(&ways[0].report), taken(&driven(&mission)));
}

/// A rover stops at the first look at which a number is above its limit, as it would have been
/// without.
#[test]
fn missions_stop_where_current_temperature_or_discharge_pass_their_limit() {
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let free = mission(BATTERY, approach);
        let whole = driven(&free);
        let (_, records) = whole.legs_with_records()[0];
        for what in LIMITED {
            let late = &records[records.len() * 2 / 3];
            let early = records[1..records.len() / 3].iter().map(|it| limited(it, what));
            let above = 0.5 * (limited(late, what) + early.fold(0.0, f64::max));
            let passed = records[1..].iter().find(|record| limited(record, what) > above);
            let passed = passed.unwrap_or_else(|| panic!("{what:?} stays below {above}"));
            for then in [Then::End, Then::NextLeg, Then::BackOut(0.05)] {
                let mut plan = free.clone();
                plan.legs[0].stops = vec![Stop { then, ..Stop::above(what, above) }];
                let report = driven(&plan);
                let LegOutcome::Stopped(stopped) = &report.legs[0].outcome else {
                    panic!("{what:?}: {:?}", report.legs[0].outcome)
                };
                let Cause::Limit { stop, value } = stopped.cause else { panic!("{stopped:?}") };
                assert_eq!((stop.limited, stop.then), (what, then));
                let time = report.legs[0].time;
                assert!((time - passed.time).abs() < 1e-6, "{what:?}: {time} s, {} s", passed.time);
                let expected = limited(passed, what);
                // Steady states are sought within 1e-7 of the rims' speed.
                assert!((value - expected).abs() < 1e-8, "{what:?}: {value}, {expected}");
                let begun = if then == Then::NextLeg { 3 } else { 1 };
                assert_eq!(report.legs.len(), begun, "{what:?}, {then:?}");
                let back = report.legs[0].back_out.as_ref().map(|back| back.distance);
                assert_eq!(back.is_some(), then == Then::BackOut(0.05));
                assert!(back.is_none_or(|back| (back - 0.05).abs() < 1e-6));
                let whole = report.taken().expect("motors").energy;
                assert!((whole / report.last().energy.electrical - 1.0).abs() < 1e-12);
            }
        }
    }
}

/// An empty battery ends a mission: legs after it are not begun.
#[test]
fn a_mission_ends_where_the_battery_fails() {
    let report = driven(&mission(Battery { capacity: 40.0, ..BATTERY }, Approach::Dynamic));
    assert_eq!((report.legs.len(), report.outcome()), (1, "brown_out"));
    let leg = &report.legs[0];
    let LegOutcome::Ended(outcome) = &leg.outcome else { panic!("{:?}", leg.outcome) };
    assert!(matches!(outcome, Outcome::BrownOut { because: PowerLost::Empty, .. }), "{outcome:?}");
    assert_eq!(outcome.reason().as_deref(), Some("its battery is empty"));
    assert_eq!(leg.taken.expect("motors").charge, Some(0.0));
}

/// Rows have what is known of a rover, and nothing else.
#[test]
fn columns_stand_where_motors_windings_and_battery_are_known() {
    let table =
        |mission: Mission| DrivenMission::drive("", &mission).expect("it is driven").table();
    let all = ["battery_energy_j", "current_a", "winding_temperature_degc", "state_of_charge"];
    let has = |table: &Table| all.map(|name| table.column(name).is_some());
    let drives = |scenario| Mission { scenario, legs: legs(), stops: Vec::new(), sensors: None };
    assert_eq!(has(&table(drives(across(5.0)))), [false; 4]);
    assert_eq!(has(&table(drives(with(MOTOR, across(5.0))))), [true, true, false, false]);
    assert_eq!(
        has(&table(drives(powered(MOTOR, BATTERY, across(5.0))))),
        [true, true, false, true]
    );
    assert_eq!(has(&table(mission(BATTERY, Approach::QuasiSteady))), [true; 4]);
}

/// The table names as a limit what is not known of the rover, and says what to add.
#[test]
fn a_limit_on_what_is_not_known_says_what_to_add() {
    let refused = |limit: &str| {
        let text = format!(
            "schema = \"mission/1\"\nname = \"one\"\nrover = \"hakuto\"\n[stop]\n{limit}\n[[leg]]\ndrive_m = 1.0\n"
        );
        let read = read_mission(&Source::text("mission", text), &Overrides::none());
        read.expect_err(limit).to_string()
    };
    for (limit, part) in [
        ("current_a = { above = 1.0 }", "[motor]"),
        ("winding_temperature_degc = { above = 90.0 }", "[motor.winding]"),
        ("depth_of_discharge = { above = 0.5 }", "[battery]"),
    ] {
        let message = refused(limit);
        let key = limit.split(' ').next().expect("a key");
        for expected in [key, part, "mission:5", "to the rover's document, or leave the limit out"]
        {
            assert!(message.contains(expected), "{message}");
        }
    }
}

/// The table of the HAKUTO rover with a motor and a battery, under a key.
fn rover_at(key: &str) -> String {
    let rover = include_str!("../../../grouser-io/data/rovers/hakuto.toml");
    let motor = "[motor]\nresistance_ohm = 10.0\ntorque_constant_nm_a = 0.01\ngear_ratio = 250.0\n\
        gear_efficiency = 0.6\n[battery]\ncapacity_wh = 10.0\nfull_voltage_v = 8.4\n\
        empty_voltage_v = 6.4\n";
    let line = |line: &str| match (line.strip_prefix("[["), line.strip_prefix('[')) {
        (Some(rest), _) => format!("[[{key}.{rest}\n"),
        (None, Some(rest)) => format!("[{key}.{rest}\n"),
        (None, None) => format!("{line}\n"),
    };
    let lines: String = rover.lines().chain(motor.lines()).map(line).collect();
    format!("[{key}]\n{lines}")
}

/// Numbers of motors and battery are inputs as others, and rows have what they lead to.
#[test]
fn campaigns_vary_motors_and_battery() {
    for (study, base, legs) in [
        ("traverse", "scenario", "[scenario]\nduration_s = 1.0\n"),
        ("mission", "mission", "[[mission.leg]]\ndrive_m = 0.1\n[[mission.leg]]\nwait_s = 1.0\n"),
    ] {
        for (key, low, high) in [
            ("rover.motor.resistance_ohm", 5.0, 20.0),
            ("rover.motor.gear_efficiency", 0.4, 0.8),
            ("rover.battery.capacity_wh", 5.0, 20.0),
        ] {
            let text = format!(
                "schema = \"campaign/1\"\nname = \"power\"\nstudy = \"{study}\"\nruns = 4\n{legs}{}\
                 [[parameter]]\nkey = \"{key}\"\ndistribution = \"uniform\"\nlow = {low:?}\nhigh = {high:?}\n",
                rover_at(&format!("{base}.rover"))
            );
            let campaign = read_campaign(&Source::text("campaign", text), &Overrides::none());
            let campaign = campaign.unwrap_or_else(|error| panic!("{study}, {key}: {error}"));
            let table = campaign.shard(0, &|| true).expect("nobody stops it");
            let column = |name: &str| -> Vec<f64> {
                table.numbers(name).iter().map(|it| it.unwrap_or(f64::NAN)).collect()
            };
            let (inputs, energy) = (column(key), column("battery_energy_j"));
            let (current, work) = (column("current_a"), column("energy_j"));
            for row in 0..4 {
                assert!(
                    energy[row] > work[row] && current[row] > 0.0,
                    "{study}, {key}: {energy:?}"
                );
            }
            // More resistance takes more, a better gear less; of a larger battery nothing is felt.
            let slope = (energy[1] - energy[0]) / (inputs[1] - inputs[0]);
            let sign = [("resistance", 1.0), ("efficiency", -1.0), ("capacity", 0.0)];
            let (_, sign) = sign.into_iter().find(|(name, _)| key.contains(name)).expect("one");
            if sign == 0.0 {
                assert!(slope.abs() < 1e-9, "{study}: {slope}");
            } else {
                assert!(slope * sign > 0.0, "{study}, {key}: {slope}");
            }
            if study == "mission" {
                let legs = ["leg_1", "leg_2"].map(|leg| column(&format!("{leg}.battery_energy_j")));
                assert!((legs[0][0] + legs[1][0] - energy[0]).abs() < 1e-9 * energy[0]);
                assert_eq!(column("leg_1.current_a")[0], current[0]);
            }
        }
    }
}
