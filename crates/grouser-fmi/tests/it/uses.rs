//! Uses, right and wrong: the bits of runs, and errors with a sentence.

use std::sync::Mutex;

use grouser::document::{Kind, Overrides, Source, preset, read_mission};
use grouser::mission::MissionRun;
use grouser::simulation::{OutcomeKind, Run};
use grouser_fmi::contents;
use grouser_fmi::drive::Drive;
use grouser_fmi::functions::{
    FmiStatus, fmi3DoStep, fmi3EnterEventMode, fmi3EnterInitializationMode, fmi3FreeInstance,
    fmi3GetFloat32, fmi3GetFloat64, fmi3GetInt64, fmi3Reset, fmi3SetFloat64, fmi3Terminate,
};

use super::{FEATURES, Instance, Unpacked, scenario};

impl Instance<'_> {
    fn outcome(&self) -> i64 {
        let (reference, mut value) = (self.fmu.reference("outcome"), -1);
        // SAFETY: there is room for a value.
        let status =
            unsafe { fmi3GetInt64(self.handle, &raw const reference, 1, &raw mut value, 1) };
        assert_eq!(status, FmiStatus::Ok, "{}", self.said());
        value
    }

    fn advance(&self, from: f64, span: f64) -> (FmiStatus, f64) {
        let (mut last, null) = (f64::NAN, std::ptr::null_mut());
        // SAFETY: there is a place for the time, and none for what is not asked for.
        let status =
            unsafe { fmi3DoStep(self.handle, from, span, true, null, null, null, &raw mut last) };
        (status, last)
    }
}

/// The wheels turn as the same speeds turn those of a run, in steps of different lengths.
#[test]
fn steps_have_the_bits_of_a_run() {
    for (feature, settings) in FEATURES {
        let fmu = Unpacked::of_scenario(settings);
        let loaded = scenario(settings);
        let mounts = loaded.value.rover.mounts();
        let instance = Instance::new(&fmu).initialized();
        let mut run = Run::new(&loaded.value).expect("a run");
        let mut time = 0.0;
        for (step, span) in [0.05, 0.2, 0.013, 0.1].into_iter().enumerate() {
            let speed = |wheel: usize| 0.5 + 0.03 * step as f64 + 0.05 * wheel as f64;
            let mut rims = Vec::new();
            for (wheel, mount) in mounts.iter().enumerate() {
                let name = format!("{}.commanded_wheel_speed_rad_s", mount.name);
                assert_eq!(instance.try_set(&name, speed(wheel)), FmiStatus::Ok);
                rims.push(speed(wheel) * mount.shearing_radius());
            }
            assert_eq!(
                instance.advance(time, span).0,
                FmiStatus::Ok,
                "{feature}: {}",
                instance.said()
            );
            run.step(&rims, span).expect(feature);
            time += span;
            let record = run.now();
            let found = ["x_m", "y_m", "energy_j"].map(|name| instance.get(name).to_bits());
            let expected = [record.place().x, record.place().y, record.energy.motors];
            assert_eq!(found, expected.map(f64::to_bits), "{feature}");
            for (wheel, mount) in record.wheels.iter().zip(mounts) {
                let found = instance.get(&format!("{}.load_n", mount.name));
                assert_eq!(found.to_bits(), wheel.reaction.load.to_bits(), "{feature}");
            }
        }
    }
}

#[test]
fn a_parameter_changes_what_the_same_setting_of_a_document_changes() {
    let changes = [
        ("soil.cohesion_kpa", "soil.cohesion_kpa", 0.5),
        ("slope_deg", "scenario.slope_deg", 14.0),
        ("gravity_m_s2", "scenario.gravity_m_s2", 1.62),
        // Of larger wheels the rims are faster.
        ("rover.wheel_unit.wheel.radius_m", "wheel.radius_m", 0.12),
    ];
    let fmu = Unpacked::of_scenario(&[]);
    let end = |instance: &Instance<'_>| {
        for wheel in ["front-left", "rear-left", "rear-right", "front-right"] {
            let name = format!("{wheel}.commanded_wheel_speed_rad_s");
            assert_eq!(instance.try_set(&name, 0.6), FmiStatus::Ok);
        }
        assert_eq!(instance.advance(0.0, 0.5).0, FmiStatus::Ok, "{}", instance.said());
        instance.get("x_m").to_bits()
    };
    let usual = end(&Instance::new(&fmu).initialized());
    for (name, key, value) in changes {
        let set = Unpacked::of_scenario(&[&format!("{key}={value}")]);
        let expected = end(&Instance::new(&set).initialized());
        let instance = Instance::new(&fmu);
        assert_eq!(instance.try_set(name, value), FmiStatus::Ok, "{}", instance.said());
        assert_eq!(end(&instance.initialized()), expected, "{name}");
        assert_ne!(expected, usual, "{name}");
    }
}

#[test]
fn a_document_turns_the_wheels_of_its_own_fmu_as_a_traverse_does() {
    for settings in [&["scenario.drive.law=eq18"][..], &["scenario.duration_s=2"]] {
        let loaded = scenario(settings);
        let fmu =
            Unpacked::of(contents::of_scenario(&loaded, Drive::Document).expect("an FMU").files);
        let instance = Instance::new(&fmu).initialized();
        let run = Run::new(&loaded.value).expect("a run").to_end().expect("an end");
        let steps = (10.0 * loaded.value.duration).round();
        let mut step = 0.0;
        while step < steps {
            assert_eq!(instance.advance(step / 10.0, 0.1).0, FmiStatus::Ok, "{}", instance.said());
            step += 1.0;
        }
        assert_eq!(instance.get("x_m").to_bits(), run.last().state.position.x.to_bits());
        // Past its end it stays there.
        assert_eq!(instance.advance(steps / 10.0, 1.0).0, FmiStatus::Ok);
        assert_eq!(instance.get("x_m").to_bits(), run.last().state.position.x.to_bits());
    }
}

#[test]
fn a_mission_is_driven_by_its_legs() {
    let source = Source::Preset(preset(Kind::Mission, "there-and-back").expect("a preset"));
    let loaded = read_mission(&source, &Overrides::none()).expect("a mission");
    let refusal = contents::of_mission(&loaded, Drive::Inputs).expect_err("no inputs");
    assert!(refusal.contains("legs"), "{refusal}");
    let fmu = Unpacked::of(contents::of_mission(&loaded, Drive::Document).expect("an FMU").files);
    let (_, mission) = loaded.value.missions().remove(0);
    let report = MissionRun::new(&mission).expect("a mission").to_end().expect("an end");
    let instance = Instance::new(&fmu).initialized();
    let mut time = 0.0;
    for record in report.trajectory.records.iter().filter(|it| it.time > 0.0) {
        let (status, _) = instance.advance(time, record.time - time);
        assert_eq!(status, FmiStatus::Ok, "{}", instance.said());
        // Where two legs meet a time has two records.
        if record.time > time {
            let found = instance.get("x_m");
            assert!((found - record.place().x).abs() < 1e-12, "{found} at {}", record.time);
        }
        time = record.time;
    }
    let last = report.trajectory.last();
    assert_eq!(instance.get("x_m").to_bits(), last.place().x.to_bits());
    assert_eq!(instance.advance(time, 10.0).0, FmiStatus::Ok, "{}", instance.said());
    assert_eq!(instance.get("x_m").to_bits(), last.place().x.to_bits());
    assert_eq!(OutcomeKind::ALL[0], OutcomeKind::Completed);
    assert_eq!((report.kind(), instance.outcome()), (OutcomeKind::Completed, 1));
    let between = Instance::new(&fmu).initialized();
    assert_eq!(between.advance(0.0, 0.0437).0, FmiStatus::Error);
    assert!(between.said().contains("sample_interval_s"), "{}", between.said());
}

#[test]
fn alternatives_of_a_mission_are_refused_by_name() {
    let source = Source::Preset(preset(Kind::Mission, "crab-or-yaw").expect("a preset"));
    let loaded = read_mission(&source, &Overrides::none()).expect("a mission");
    let refusal = contents::of_mission(&loaded, Drive::Document).expect_err("alternatives");
    assert!(refusal.contains("alternatives"), "{refusal}");
}

#[test]
fn wrong_uses_are_errors_with_a_sentence_and_change_nothing() {
    let fmu = Unpacked::of_scenario(&[]);
    let instance = Instance::new(&fmu);
    let refused = |status: FmiStatus, words: &str| {
        assert_eq!(status, FmiStatus::Error, "{words}");
        assert!(instance.said().contains(words), "{words}: {}", instance.said());
    };
    let input = "front-left.commanded_wheel_speed_rad_s";
    // Before the initialization.
    refused(instance.advance(0.0, 0.1).0, "before the initialization");
    refused(instance.try_get(fmu.reference("x_m")).0, "before the initialization");
    refused(fmi3Terminate(instance.handle), "before the initialization");
    refused(instance.try_set("soil.cohesion_kpa", f64::NAN), "NaN");
    refused(instance.try_set("soil.cohesion_kpa", -1.0), "from 0 to 100");
    refused(instance.try_set("x_m", 1.0), "cannot be set");
    refused(
        fmi3EnterInitializationMode(instance.handle, false, 0.0, f64::NAN, false, 0.0),
        "start time",
    );
    let instance = instance.initialized();
    let refused = |status: FmiStatus, words: &str| {
        assert_eq!(status, FmiStatus::Error, "{words}");
        assert!(instance.said().contains(words), "{words}: {}", instance.said());
    };
    assert_eq!(instance.advance(0.0, 0.1), (FmiStatus::Ok, 0.1));
    let before = instance.get("x_m");
    refused(instance.try_set("soil.cohesion_kpa", 1.0), "after the initialization");
    refused(instance.try_set(input, f64::NAN), "finite");
    refused(instance.try_set(input, f64::INFINITY), "finite");
    refused(instance.try_get(100_000).0, "no variable with the reference 100000");
    refused(instance.try_get(fmu.reference("outcome")).0, "Int64");
    refused(instance.advance(0.0, 0.1).0, "begins at 0 s");
    refused(instance.advance(0.2, 0.1).0, "begins at 0.2 s");
    for span in [0.0, -0.1, f64::NAN, f64::INFINITY, 1e-9] {
        refused(instance.advance(0.1, span).0, "from 1e-6 to 86400");
    }
    let (reference, mut value) = (fmu.reference("x_m"), 0.0);
    // SAFETY: null pointers and counts that differ are what is tried.
    unsafe {
        let null = std::ptr::null_mut();
        refused(fmi3GetFloat64(instance.handle, &raw const reference, 1, null, 1), "null");
        refused(fmi3SetFloat64(instance.handle, std::ptr::null(), 1, &raw const value, 1), "null");
        let status = fmi3GetFloat64(instance.handle, &raw const reference, 1, &raw mut value, 2);
        refused(status, "1 references and 2 values");
    }
    refused(fmi3EnterEventMode(instance.handle), "event mode");
    let nothing = std::ptr::null_mut();
    refused(fmi3GetFloat32(instance.handle, &raw const reference, 1, nothing, 1), "type");
    assert_eq!(instance.get("x_m").to_bits(), before.to_bits());
    assert_eq!(instance.advance(0.1, 0.1), (FmiStatus::Ok, 0.2));
    assert_eq!(fmi3Reset(instance.handle), FmiStatus::Ok);
    refused(instance.advance(0.0, 0.1).0, "before the initialization");
}

#[test]
fn a_freed_instance_and_none_are_errors() {
    let fmu = Unpacked::of_scenario(&[]);
    let instance = Instance::new(&fmu);
    fmi3FreeInstance(instance.handle);
    assert_eq!(fmi3Reset(instance.handle), FmiStatus::Error);
    assert_eq!(fmi3Reset(std::ptr::null_mut()), FmiStatus::Error);
    fmi3FreeInstance(std::ptr::null_mut());
}

#[test]
fn a_document_that_was_changed_is_refused() {
    let fmu = Unpacked::of_scenario(&[]);
    let log = Mutex::new(Vec::new());
    assert!(fmu.instantiated_with("another", &log).is_null());
    let path = fmu.folder.path().join("resources/scenario.toml");
    let text = std::fs::read_to_string(&path).expect("a document") + "# changed\n";
    std::fs::write(&path, text).expect("a file");
    assert!(fmu.instantiated(&log).is_null());
    std::fs::remove_file(&path).expect("a file");
    assert!(fmu.instantiated(&log).is_null());
    let said = log.lock().expect("a log").clone();
    let words = ["instantiation token", "instantiation token", "no document"];
    assert!(said.iter().zip(words).all(|(text, word)| text.contains(word)), "{said:?}");
}

/// Rovers in one process know nothing of each other.
#[test]
fn instances_on_several_threads_have_the_bits_of_one() {
    let fmu = Unpacked::of_scenario(&[]);
    let driven = || {
        let instance = Instance::new(&fmu).initialized();
        for step in 0..5 {
            let time = f64::from(step) * 0.1;
            assert_eq!(instance.advance(time, 0.1).0, FmiStatus::Ok, "{}", instance.said());
        }
        instance.get("x_m").to_bits()
    };
    let alone = driven();
    std::thread::scope(|scope| {
        let all: Vec<_> = (0..4).map(|_| scope.spawn(driven)).collect();
        for one in all {
            assert_eq!(one.join().expect("a thread"), alone);
        }
    });
}

#[test]
fn a_rover_that_tips_over_stays_and_says_so() {
    let fmu = Unpacked::of_scenario(&["scenario.slope_deg=55"]);
    let instance = Instance::new(&fmu).initialized();
    for step in 0..30 {
        let (status, _) = instance.advance(f64::from(step) * 0.1, 0.1);
        assert_eq!(status, FmiStatus::Ok, "{}", instance.said());
    }
    assert_ne!(instance.outcome(), 0);
    let place = instance.get("x_m");
    assert_eq!(instance.advance(3.0, 1.0).0, FmiStatus::Ok);
    assert_eq!(instance.get("x_m").to_bits(), place.to_bits());
}
