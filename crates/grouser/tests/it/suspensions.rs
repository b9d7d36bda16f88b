//! Suspensions of documents: what they mean, what is refused, and the presets that have one.

use grouser::document::{Kind, LoadedRover, Overrides, Source, read_rover, read_scenario};
use grouser::simulation::{Outcome, Run};
use grouser::units::Vec2;
use grouser::vehicle::{Bogie, End, Suspension};

fn preset(name: &str, settings: &[&str]) -> Result<LoadedRover, String> {
    let source = Source::find(Kind::Rover, name).expect("a preset");
    let overrides = Overrides::parse(settings.iter().copied()).expect("good settings");
    read_rover(&source, &overrides).map_err(|error| error.to_string())
}

#[test]
fn a_document_has_rockers_and_bogies() {
    let loaded = preset("curiosity-rocker-bogie", &["rover.suspension.pivot_m.1=0.1"]).expect("it");
    let bogie = Bogie { pivot: Vec2::new(-0.55, -0.49), end: End::Rear };
    let suspension = Suspension { pivot: Vec2::new(0.0, 0.1), bogie: Some(bogie) };
    assert_eq!(loaded.value.suspension(), Some(&suspension));
    let again = Source::text("again", loaded.to_toml());
    let again = read_rover(&again, &Overrides::none()).expect("it was written");
    assert_eq!(again.value, loaded.value);
    assert_eq!(preset("hakuto", &[]).expect("it").value.suspension(), None);
}

/// The rovers on rockers are those that they are named for in all but their suspension.
#[test]
fn presets_on_rockers_have_the_numbers_of_the_rigid_ones() {
    for (rigid, on_rockers) in
        [("hakuto", "hakuto-rockers"), ("curiosity", "curiosity-rocker-bogie")]
    {
        let [rigid, on_rockers] =
            [rigid, on_rockers].map(|name| preset(name, &[]).expect("it").value);
        let suspension = *on_rockers.suspension().expect("rockers");
        assert_eq!(rigid.on_rockers(suspension).expect("they fit"), on_rockers);
    }
}

#[test]
fn suspensions_that_do_not_fit_the_wheels_are_refused() {
    let bogie = ["rover.suspension.bogie.pivot_m=[-0.5,0]", "rover.suspension.bogie.end=rear"];
    let pivot = "rover.suspension.pivot_m=[0,0]";
    for (name, settings, expected) in [
        (
            "curiosity",
            vec![pivot],
            ["the number of wheels on the left", "with [suspension.bogie] three"],
        ),
        (
            "hakuto",
            vec![pivot, bogie[0], bogie[1]],
            ["the number of wheels on the left", "two wheels on a side"],
        ),
        (
            "hakuto",
            vec![pivot, bogie[0]],
            ["`suspension.bogie.end` is missing", "end of the rover"],
        ),
        ("hakuto", vec!["rover.suspension.pivot_m=[0,1e3]"], ["1000", "-10 to 10"]),
        ("hakuto", vec!["rover.suspension.pivot_m=[0]"], ["1 entries", "2"]),
        (
            "hakuto",
            vec!["rover.suspension.pivot_m=[0.3,0]"],
            ["pivot x of the rocker", "between its two wheels"],
        ),
        (
            "hakuto",
            vec!["rover.suspension.pivot_m=[0,5]"],
            ["pivot z of the rocker", "no further above or below"],
        ),
        (
            "curiosity-rocker-bogie",
            vec!["rover.suspension.bogie.end=front"],
            ["pivot x of the bogie", "between its two wheels"],
        ),
        (
            "curiosity-rocker-bogie",
            vec!["rover.suspension.pivot_m=[-0.9,0]"],
            ["pivot x of the rocker", "between its wheel and the pivot of its bogie"],
        ),
    ] {
        let refused = preset(name, &settings).expect_err("it does not fit");
        assert!(expected.iter().all(|it| refused.contains(it)), "{refused}");
    }
}

/// The preset over a crater is driven to its end, on all wheels.
#[test]
fn the_crater_is_crossed() {
    let source = Source::find(Kind::Scenario, "into-a-crater").expect("a preset");
    let scenario = read_scenario(&source, &Overrides::none()).expect("a scenario").value;
    let run = Run::new(&scenario).expect("a run").to_end().expect("an end");
    assert_eq!(run.outcome, Outcome::Completed);
    let heights = run.records.iter().map(|record| record.standing().expect("it stands").height);
    let [low, high] = heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], height| {
        [low.min(height), high.max(height)]
    });
    // From the rim's crest to the floor off its middle.
    assert!((0.35..0.5).contains(&(high - low)), "{low} {high}");
    for wheel in run.records.iter().flat_map(|record| &record.wheels) {
        assert!(wheel.reaction.load > 1.0, "{}", wheel.reaction.load);
    }
}
