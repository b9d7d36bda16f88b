//! Work that the units take, counted: the same on every machine.

use std::fmt::Write as _;

use grouser::contact::{Model, settle};
use grouser::document::{self, Overrides, Source};
use grouser::simulation::{Approach, Run, Scenario};
use grouser_bench::{Fixtures, StepCommands, Unit, controlled};

/// A slow-down by more evaluations, steps or settled wheels shows here as a difference.
#[test]
fn the_work_is_as_much_as_it_was() {
    let fixtures = Fixtures::new().expect("the presets can be read");
    let mut text = String::from("evaluations of the theory for a settled wheel: mean, most\n");
    for model in Model::ALL {
        let counts: Vec<u32> = fixtures
            .wheels
            .iter()
            .filter_map(|wheel| settle(model.as_ref(), &wheel.contact, wheel.load).ok())
            .map(|settled| settled.evaluations)
            .collect();
        let mean = f64::from(counts.iter().sum::<u32>()) / counts.len() as f64;
        let most = counts.iter().max().expect("some settle");
        let _ = writeln!(text, "{:<10} {mean:.2} {most}", model.name());
    }
    text.push_str("\nwork for a traverse of 20 s on 10°\n");
    let read = |file: &str| -> Scenario {
        let path =
            concat!(env!("CARGO_MANIFEST_DIR"), "/../grouser-io/data/scenarios/").to_owned() + file;
        let loaded = document::read_scenario(&Source::file(path), &Overrides::none());
        loaded.expect("a ready scenario").value
    };
    let eq18 = read("eq18-corrected.toml");
    for (name, scenario) in [("constant speed", &fixtures.scenario), ("eq18", &eq18)] {
        for approach in [Approach::Dynamic, Approach::QuasiSteady] {
            let mut scenario = scenario.clone();
            scenario.numerics.approach = approach;
            let run = Run::new(&scenario).and_then(Run::to_end).expect("it runs");
            let _ = writeln!(text, "{name}, {}: {:?}", run.method.name(), run.work);
        }
    }
    text.push_str("\nwork for 250 steps of 20 ms at new speeds on 10°\n");
    for commands in [StepCommands::Gentle, StepCommands::Random, StepCommands::StopAndGo] {
        for scenario in [&fixtures.scenario, &fixtures.quasi_steady()] {
            let run = controlled(scenario, commands);
            let method = run.state().method().name();
            let _ = writeln!(text, "{commands:?}, {method}: {:?}", run.state().work());
        }
    }
    insta::assert_snapshot!(text);
}

/// Two calls do the same: what is measured does not depend on what was measured before.
#[test]
fn units_of_work_repeat() {
    let fixtures = Fixtures::new().expect("the presets can be read");
    for unit in Unit::ALL.into_iter().filter(|unit| *unit != Unit::Campaign) {
        let [one, other] = [fixtures.work(unit), fixtures.work(unit)];
        assert_eq!(one.checksum.to_bits(), other.checksum.to_bits(), "{unit:?}");
        assert!(one.count > 0 && one.count == other.count);
    }
}
