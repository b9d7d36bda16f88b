//! `grouser design`: the answer, its folder, and what is refused.

use serde_json::{Value, json};

use crate::program::{Place, number};

const LIGHTER: &str = "design design-lighter-wheels";

/// A column of an answer's rows.
fn column<'a>(rows: &'a Value, name: &str) -> Vec<&'a Value> {
    rows.as_array().expect("rows").iter().map(|row| &row[name]).collect()
}

#[test]
fn an_answer_has_the_numbers_their_limits_and_what_shows_that_they_are_the_best() {
    let place = Place::new();
    let found = place.json(LIGHTER);
    assert_eq!(number(&found["objective"]), number(&found["designs"][1]["wheel_mass_kg"]));
    assert_eq!(column(&found["constraints"], "name"), ["limit_slope_deg", "sinkage_ratio"]);
    let [slope, sinkage] = [0, 1].map(|place| &found["constraints"][place]);
    assert!(number(&slope["value"]) > number(&slope["bound"]) && slope["price"] == 0.0);
    assert!((number(&sinkage["value"]) - 0.1).abs() < 1e-6 && number(&sinkage["price"]) > 0.0);
    assert_eq!(found["certificate"]["better"], 0);
    assert_eq!(found["starts"]["searches"], found["starts"]["agreed"]);
    // What the program measures of the rover that was found is what the answer says.
    place.results(&format!("{LIGHTER} --out found"));
    let again = place.json("heading --rover found/rover.toml --slope-deg 10 --nominal");
    let limit = number(&found["designs"][1]["limit_slope_deg"]);
    assert!((number(&again["limit_slope_deg"]) - limit).abs() < 1e-9, "{again}");
    let report = place.read("found/report.html");
    assert!(report.contains("sinkage_ratio ≤ 0.1 holds it back"), "{report}");
    // The folder's own document repeats the answer.
    assert_eq!(place.json("design found/design.toml")["design"], found["design"]);
}

#[test]
fn two_measures_are_traded_and_other_models_choose_for_themselves() {
    let place = Place::new();
    let found = place.json(&format!("{LIGHTER} --trade energy_j_per_m,wheel_mass_kg --model all"));
    let masses: Vec<f64> =
        column(&found["trade"], "wheel_mass_kg").into_iter().map(number).collect();
    assert_eq!(masses.len(), 9);
    assert!(masses.windows(2).all(|pair| pair[0] >= pair[1] - 1e-6), "{masses:?}");
    assert!(column(&found["designs"], "flags").iter().all(|flags| flags.is_array()));
    let rows = column(&found["designs"], "row");
    assert_eq!(rows.iter().filter(|row| **row == "found by it").count(), 3, "{rows:?}");
}

#[test]
fn wheels_are_drawn_along_the_trade_off() {
    let place = Place::new();
    place.results(&format!("{LIGHTER} --trade energy_j_per_m,wheel_mass_kg --out found"));
    let (drawing, page) = (place.read("found/wheels.svg"), place.read("found/report.html"));
    let table = place.read("found/trade.csv");
    assert_eq!(table.lines().count(), 10, "{table}");
    // Each wheel says how wide it is.
    assert_eq!(drawing.matches(" mm</text>").count(), 9 * 3, "{drawing}");
    assert!(page.contains("The first wheel of each design along the trade-off"), "{page}");
    assert!(page.contains("Checked on the soil as written"), "{page}");
}

#[test]
fn a_design_that_names_files_is_repeated_from_its_folder() {
    let place = Place::new();
    place.write("own-rover.toml", place.results("presets hakuto --kind rover"));
    place.write("own-soil.toml", place.results("presets toyoura"));
    place.write(
        "task.toml",
        "schema = \"design/1\"\nminimise = \"wheel_mass_kg\"\n\
         [free]\n\"rover.wheel_unit.wheel.radius_m\" = [0.06, 0.16]\n\
         [subject_to]\nsinkage_ratio = { at_most = 0.15 }\n\
         [choose]\nrover = [\"own-rover.toml\", \"hakuto-flight\"]\n\
         [[also]]\nsoil = \"own-soil.toml\"\ngravity_m_s2 = \"moon\"\n",
    );
    let found = place.json("design task.toml --out found");
    let again = place.json("design found/design.toml");
    for key in ["objective", "constraints", "certificate"] {
        assert_eq!(again[key], found[key], "{key}");
    }
    // All commands take the rover.
    for line in [
        "heading --rover found/rover.toml --slope-deg 5 --nominal",
        "card --rover found/rover.toml --out card --samples 8",
        "check found/rover.toml",
    ] {
        assert_eq!(place.line(line).code(), 0, "{line}");
    }
}

#[test]
fn a_design_outside_of_domains_is_said_to_be() {
    let place = Place::new();
    let narrow = "--set design.free.rover.wheel_unit.wheel.radius_m=[0.06,0.08] \
                  --set design.subject_to.sinkage_ratio.at_most=0.3 \
                  --set design.subject_to.limit_slope_deg.at_least=10";
    let words = place.results(&format!("{LIGHTER} {narrow}"));
    assert!(words.contains("outside what its model and soil were tested for: "), "{words}");
    assert!(words.contains("radius-outside: "), "{words}");
    let strict = place.line(&format!("{LIGHTER} {narrow} --strict"));
    assert!(strict.code() != 0 && strict.stderr.contains("radius-outside"), "{}", strict.stderr);
}

#[test]
fn what_cannot_be_is_refused_in_words() {
    let place = Place::new();
    let ends = |line: &str, code: i32, words: &[&str]| {
        let answer = place.line(line);
        assert_eq!(answer.code(), code, "{line}\n{}", answer.stderr);
        for word in words {
            assert!(answer.stderr.contains(word), "{line}\n{}", answer.stderr);
        }
    };
    let steep = "design.subject_to.limit_slope_deg.at_least=35";
    ends(
        &format!("{LIGHTER} --set {steep}"),
        1,
        &["35° of this soil", "subject_to.limit_slope_deg", "31.01°"],
    );
    ends(&format!("{LIGHTER} --trade wheel_mass_kg"), 2, &["two measures"]);
    ends(&format!("{LIGHTER} --trade wheel_mass_kg,mass"), 2, &["energy_j_per_m"]);
    ends(&format!("{LIGHTER} --nominal --seed 2"), 2, &["--seed"]);
    ends("design no-such-design", 2, &["design-lighter-wheels"]);
    // A document of another kind.
    place.write("soil.toml", place.results("presets toyoura"));
    ends("design soil.toml", 2, &["soil"]);
}

#[test]
fn a_belief_asks_for_a_probability_and_nominal_for_none() {
    let place = Place::new();
    let line = "--set design.soil=toyoura-uncertain --set design.model=ishigami \
                --set design.subject_to.limit_slope_deg.at_least=12 \
                --set design.subject_to.sinkage_ratio.at_most=0.2";
    let believed = place.json(&format!("{LIGHTER} {line}"));
    assert_eq!(believed["inputs"]["probability"], json!(0.95));
    assert!(number(&believed["constraints"][0]["share"]) > 0.8, "{believed}");
    let nominal = place.json(&format!("{LIGHTER} {line} --nominal"));
    assert_eq!(nominal["constraints"][0]["share"], Value::Null);
    assert!(number(&nominal["objective"]) < number(&believed["objective"]));
}
