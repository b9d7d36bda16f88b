//! `modelDescription.xml` says what the rows of documents and columns of results say.

use std::collections::BTreeSet;

use grouser::document::columns::run;
use grouser::document::{Kind, range, unit_of};
use grouser::simulation::{OutcomeKind, Run};
use grouser_fmi::contents;
use grouser_fmi::drive::Drive;

use super::{FEATURES, Unpacked, scenario};

/// The names of a description's variables of one causality.
fn names(fmu: &Unpacked, causality: &str) -> Vec<String> {
    let xml = roxmltree::Document::parse(&fmu.description).expect("XML");
    let variables = xml.descendants().filter(|it| it.attribute("causality") == Some(causality));
    variables.map(|it| it.attribute("name").expect("a name").to_owned()).collect()
}

#[test]
fn outputs_are_the_columns_of_a_trajectory() {
    for (feature, settings) in FEATURES {
        let loaded = scenario(settings);
        let fmu = Unpacked::of_scenario(settings);
        let run = Run::new(&loaded.value).expect("a run").finish();
        let columns: BTreeSet<String> =
            run::table(&run, &loaded.value).names().into_iter().collect();
        let outputs: BTreeSet<String> = names(&fmu, "output").into_iter().collect();
        // A record says its time and its flags besides, an FMU what became of the rover.
        let only = |one: &BTreeSet<String>, other: &BTreeSet<String>| {
            one.difference(other).cloned().collect::<Vec<_>>()
        };
        assert_eq!(only(&columns, &outputs), ["flags", "time_s"], "{feature}");
        assert_eq!(only(&outputs, &columns), ["outcome", "reason"], "{feature}");
    }
}

#[test]
fn parameters_have_the_values_units_and_ranges_of_the_document() {
    let loaded = scenario(&[]);
    let fmu = Unpacked::of_scenario(&[]);
    let parameters = names(&fmu, "parameter");
    for wanted in ["soil.cohesion_kpa", "soil.friction_angle_deg", "slope_deg", "gravity_m_s2"] {
        assert!(parameters.iter().any(|name| name == wanted), "{wanted}: {parameters:?}");
    }
    for name in &parameters {
        let number = |attribute: &str| {
            fmu.attribute(name, attribute).and_then(|text| text.parse::<f64>().ok())
        };
        assert_eq!(number("start"), loaded.document.number(name), "{name}");
        let (least, most) = (number("min").expect("a range"), number("max").expect("a range"));
        if let Some(all) = range(Kind::Scenario, name) {
            assert!(*all.start() <= least && most <= *all.end(), "{name}: {least} to {most}");
        }
        let unit = unit_of(name).map(|unit| unit.symbol.to_owned());
        assert_eq!(fmu.attribute(name, "unit"), unit, "{name}");
        assert_ne!(fmu.attribute(name, "description"), Some(String::new()), "{name}");
    }
}

/// In every description: names and references are unique, and units that are used are declared.
#[test]
fn a_description_is_consistent() {
    for (feature, settings) in FEATURES {
        let fmu = Unpacked::of_scenario(settings);
        let xml = roxmltree::Document::parse(&fmu.description).expect("XML");
        let variables: Vec<_> =
            xml.descendants().filter(|it| it.has_attribute("causality")).collect();
        let each = |attribute| variables.iter().filter_map(move |it| it.attribute(attribute));
        let unique: BTreeSet<&str> = each("name").collect();
        assert_eq!(unique.len(), variables.len(), "{feature}");
        let references: Vec<usize> =
            each("valueReference").filter_map(|it| it.parse().ok()).collect();
        assert_eq!(references, (0..variables.len()).collect::<Vec<_>>(), "{feature}");
        let units = xml.descendants().filter(|it| it.has_tag_name("Unit"));
        let declared: BTreeSet<&str> = units.filter_map(|it| it.attribute("name")).collect();
        let used: BTreeSet<&str> = each("unit").collect();
        assert_eq!(declared, used, "{feature}");
        let items = xml.descendants().filter(|it| it.has_tag_name("Item"));
        let outcomes: Vec<&str> = items.skip(1).filter_map(|it| it.attribute("name")).collect();
        assert_eq!(outcomes, OutcomeKind::ALL.map(OutcomeKind::name), "{feature}");
    }
}

#[test]
fn the_same_document_gives_the_same_files() {
    let files = || contents::of_scenario(&scenario(&[]), Drive::Inputs).map(|it| it.files);
    assert_eq!(files(), files());
}

#[test]
fn a_drive_that_follows_a_law_leaves_no_room_for_inputs() {
    let loaded = scenario(&["scenario.drive.law=eq18"]);
    let refusal = contents::of_scenario(&loaded, Drive::Inputs).expect_err("a law");
    assert!(refusal.contains("drive.law"), "{refusal}");
    let fmu = Unpacked::of(contents::of_scenario(&loaded, Drive::Document).expect("an FMU").files);
    assert_eq!(names(&fmu, "input"), Vec::<String>::new());
}
