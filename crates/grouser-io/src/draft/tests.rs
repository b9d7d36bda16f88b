//! Drafts are read back, and hostile answers are refused.

use super::Draft;
use crate::{
    Kind, Overrides, Source, presets, read_mission, read_rover, read_scenario, read_soil,
    read_wheel,
};
use grouser_core::vehicle::Inertia;

const KINDS: [Kind; 5] = [Kind::Rover, Kind::Wheel, Kind::Soil, Kind::Scenario, Kind::Mission];

fn draft(kind: Kind, answers: &[(&str, &str)]) -> Draft {
    let mut draft = Draft::new(kind).expect("it has questions");
    for (key, answer) in answers {
        draft.answer(key, answer).unwrap_or_else(|error| panic!("{key} = {answer}: {error}"));
    }
    draft
}

fn source(draft: &Draft) -> Source {
    Source::text("draft", draft.finish().expect("the answers go together"))
}

fn read(kind: Kind, source: &Source) {
    let none = Overrides::none();
    let read = match kind {
        Kind::Rover => read_rover(source, &none).map(drop),
        Kind::Wheel => read_wheel(source, &none).map(drop),
        Kind::Soil => read_soil(source, &none).map(drop),
        Kind::Mission => read_mission(source, &none).map(drop),
        _ => read_scenario(source, &none).map(drop),
    };
    read.unwrap_or_else(|error| panic!("{kind}: {error}\n{source:?}"));
}

#[test]
fn without_answers_each_draft_is_a_document() {
    for kind in KINDS {
        read(kind, &source(&draft(kind, &[])));
    }
    assert!(Draft::new(Kind::Prior).is_none());
}

/// Every question has a sentence, and every number its range.
#[test]
fn questions_are_those_of_the_rows() {
    for kind in KINDS {
        let draft = draft(kind, &[]);
        for key in draft.keys() {
            let question = draft.question(key).expect("a question");
            assert!(question.doc.ends_with('.'), "{kind} {key}: {:?}", question.doc);
            let is_number = question.usual.as_ref().is_some_and(serde_json::Value::is_number);
            assert!(!is_number || question.range.is_some(), "{kind} {key}");
        }
    }
    let question = draft(Kind::Wheel, &[]).question("radius_m").expect("a question");
    assert_eq!(question.doc, "Radius of the rim, without grousers, r [m].");
    assert_eq!(question.range.as_deref(), Some("0.01 to 1"));
}

/// What is answered stands in the rover, and what is estimated follows from it by the library's
/// formulas.
#[test]
fn a_rover_has_what_its_data_sheet_says() {
    let answers = [
        ("name", "Grasshopper"),
        ("source", "its data sheet"),
        ("total_mass_kg", "30"),
        ("axle_count", "3"),
        ("wheelbase_m", "0.8"),
        ("track_m", "0.7"),
        ("centre_of_mass_height_m", "0.31"),
        ("wheel_unit.mass_kg", "1.5"),
        ("wheel_unit.wheel.radius_m", "0.09"),
        ("wheel_unit.wheel.width_m", "0.1"),
        ("wheel_unit.wheel.grousers.height_m", "0.01"),
        ("wheel_unit.wheel.grousers.count", "18"),
        ("body_length_m", "0.9"),
        ("body_width_m", "0.5"),
        ("body_height_m", "0.25"),
    ];
    let draft = draft(Kind::Rover, &answers);
    assert!(draft.keys().iter().all(|key| draft.is_answered(key)));
    let loaded = read_rover(&source(&draft), &Overrides::none()).expect("a rover");
    let rover = &loaded.value;
    assert!((rover.mass() - 30.0).abs() < 1e-5, "{}", rover.mass());
    // Hubs are written in micrometres.
    assert!((rover.centre_height() - 0.31).abs() < 2e-6, "{}", rover.centre_height());
    let mounts = rover.mounts();
    assert_eq!(mounts.len(), 6);
    assert_eq!((mounts[0].name.as_str(), mounts[1].name.as_str()), ("front-left", "middle-left"));
    assert_eq!(mounts[0].position.x - mounts[2].position.x, 0.8);
    assert_eq!(mounts[0].position.y - mounts[5].position.y, 0.7);
    let parts = rover.parts();
    let bars = parts.wheel_unit.wheel.grousers.expect("grousers");
    assert_eq!((bars.height, bars.count), (0.01, 18));
    let expected = Inertia::of_uniform_box(21.0, [0.9, 0.5, 0.25]);
    for (found, expected) in [
        (parts.body.inertia.xx, expected.xx),
        (parts.body.inertia.yy, expected.yy),
        (parts.body.inertia.zz, expected.zz),
        (parts.wheel_unit.inertia.yy, 1.5 * 0.09 * 0.09 / 2.0),
    ] {
        assert!((found / expected - 1.0).abs() < 1e-3, "{found}, {expected}");
    }
    // Nothing but inertias and the place of the centre is assumed.
    let assumed = loaded.document.get("assumed").and_then(|all| all.as_array().cloned());
    assert_eq!(assumed.expect("a list").len(), 3);
}

/// What is not answered is listed with its value and its reason.
#[test]
fn what_is_estimated_is_marked() {
    let text = draft(Kind::Rover, &[("total_mass_kg", "8")]).finish().expect("a rover");
    for line in [
        "\"mount.position_m: wheelbase_m 0.48, 0.24 m times the cube root of the mass in kg",
        "\"wheel_unit.mass_kg: 0.4, all wheels with their motors have a fifth of the mass\"",
        "mass_kg = 6.4   # 8 kg less 4 wheels of 0.4 kg",
        "# The wheel's centre, at a steering angle of zero, from the body's centre of mass: x \
         forward, y left, z up [m].",
        "# Moments of inertia about its centre of mass [kg·m²].",
    ] {
        assert!(text.contains(line), "{line}\n{text}");
    }
    assert!(!text.contains("body.mass_kg: total_mass_kg"), "{text}");
}

/// Every preset of a soil is one to start from.
#[test]
fn soils_may_be_like_any_preset() {
    for preset in presets(Kind::Soil) {
        let draft = draft(Kind::Soil, &[("like", preset.name), ("friction_angle_deg", "31.5")]);
        let soil = read_soil(&source(&draft), &Overrides::none());
        let soil = soil.unwrap_or_else(|error| panic!("{}: {error}", preset.name));
        assert_eq!(soil.document.number("friction_angle_deg"), Some(31.5), "{}", preset.name);
        let assumed = soil.document.get("assumed").map(ToString::to_string).unwrap_or_default();
        assert!(assumed.contains(&format!("that of the preset `{}`", preset.name)), "{assumed}");
        assert!(!assumed.contains("friction_angle_deg"), "{assumed}");
        // Nobody said how this angle was found, and nobody measured the rest on this bed.
        assert!(soil.document.get("friction_test").is_none(), "{}", preset.name);
        let known = |key: &str| soil.document.get(key).map(|it| it.to_string().contains("copied"));
        assert_eq!(known("known_from.pressure_sinkage"), Some(true), "{}", preset.name);
        assert_eq!(known("known_from.strength"), None, "{}", preset.name);
    }
}

#[test]
fn a_scenario_takes_words_for_gravity_and_names_for_parts() {
    let draft = draft(
        Kind::Scenario,
        &[
            ("rover", "curiosity"),
            ("soil", "mars-sand"),
            ("gravity_m_s2", "mars"),
            ("slope_deg", "5"),
        ],
    );
    let scenario = read_scenario(&source(&draft), &Overrides::none()).expect("a scenario").value;
    assert_eq!(scenario.gravity, crate::gravity("mars").expect("a world"));
    assert_eq!(scenario.rover.wheel_count(), 6);
}

/// Whatever is no answer is refused with the key, and changes nothing.
#[test]
fn hostile_answers_are_refused() {
    for (kind, key, answer) in [
        (Kind::Rover, "total_mass_kg", "heavy"),
        (Kind::Rover, "total_mass_kg", "nan"),
        (Kind::Rover, "total_mass_kg", "inf"),
        (Kind::Rover, "total_mass_kg", "-3"),
        (Kind::Rover, "total_mass_kg", "1e9"),
        (Kind::Rover, "total_mass_kg", ""),
        (Kind::Rover, "total_mass_kg", "[1, 2]"),
        (Kind::Rover, "total_mass_kg", "1\n2"),
        (Kind::Rover, "axle_count", "2.5"),
        (Kind::Rover, "axle_count", "1"),
        (Kind::Rover, "wheel_unit.wheel.grousers.count", "0"),
        (Kind::Wheel, "radius_m", "1.01"),
        (Kind::Soil, "like", "tojoura"),
        (Kind::Soil, "friction_angle_deg", "95"),
        (Kind::Scenario, "rover", "nowhere.toml"),
        (Kind::Scenario, "gravity_m_s2", "venus"),
    ] {
        let mut draft = draft(kind, &[]);
        let before = draft.finish().expect("a document");
        let error = draft.answer(key, answer).expect_err(&format!("{key} = {answer:?}"));
        let is_named = error.to_string().contains(key) || answer == "nowhere.toml";
        assert!(is_named, "{key} = {answer:?}: {error}");
        assert_eq!(draft.finish().expect("a document"), before);
    }
    assert!(draft(Kind::Rover, &[]).answer("wheel_base", "1").is_err());
}

#[test]
fn wheels_heavier_than_the_rover_are_refused() {
    let draft = draft(Kind::Rover, &[("total_mass_kg", "2"), ("wheel_unit.mass_kg", "0.5")]);
    let error = draft.finish().expect_err("no body is left").to_string();
    assert!(error.contains("4 wheels of 0.5 kg are 2 kg, the rover has 2 kg"), "{error}");
}

/// A name may hold whatever a keyboard has.
#[test]
fn names_are_quoted() {
    for name in ["it's \"mine\"", "a\\b", "# no comment", "\u{1b}[31mred", "x = [1"] {
        let draft = draft(Kind::Wheel, &[("name", name)]);
        let wheel = read_wheel(&source(&draft), &Overrides::none());
        let wheel = wheel.unwrap_or_else(|error| panic!("{name:?}: {error}"));
        assert_eq!(wheel.document.name(), name);
    }
}
