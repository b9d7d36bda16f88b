//! The `[uncertainty]` of soil documents: the way in and out, and everything that can be wrong.

use std::fs;

use grouser::document::{self, DocumentError, Kind, LoadedSoil, Overrides, Source};
use grouser::soil::{PressureSinkage, Soil};
use grouser::units::deg;

use crate::documents::{Folder, changed};

/// Toyoura sand, exact but for this.
fn toyoura_with(uncertainty: &str) -> String {
    let text = document::preset(Kind::Soil, "toyoura").expect("a preset").text;
    let exact = text.replacen("\ncohesion_kpa", "\npriors = \"none\"\ncohesion_kpa", 1);
    format!("{exact}\n{uncertainty}\n")
}

fn read(text: &str) -> Result<LoadedSoil, DocumentError> {
    document::read_soil(&Source::text("sand.toml", text), &Overrides::none())
}

fn draw(loaded: &LoadedSoil, index: u64) -> Soil {
    let uncertain = loaded.uncertain.as_ref().expect("it says so");
    uncertain.draw(3, index).expect("it can be drawn")
}

fn parameter(key: &str, deviation: &str) -> String {
    format!("[[uncertainty.parameter]]\nkey = \"{key}\"\nstandard_deviation = {deviation}\n")
}

fn correlation(one: &str, other: &str, value: &str) -> String {
    format!("[[uncertainty.correlation]]\nbetween = [\"{one}\", \"{other}\"]\nvalue = {value}\n")
}

const FRICTION: &str = "friction_angle_deg";
const K_PHI: &str = "pressure_sinkage.k_phi";
const N: &str = "pressure_sinkage.n";
const N_PER_SLIP: &str = "pressure_sinkage.n_per_slip";

fn uniform(key: &str, low: &str, high: &str) -> String {
    format!(
        "[[uncertainty.parameter]]\nkey = \"{key}\"\ndistribution = \"uniform\"\nlow = {low}\nhigh = {high}\n"
    )
}

#[test]
fn drawn_numbers_take_the_place_of_the_documents() {
    let text = toyoura_with(&(parameter(FRICTION, "1.5") + &parameter(K_PHI, "10")));
    let loaded = read(&text).expect("it is right");
    let nominal = loaded.value;
    let keys: Vec<&str> = loaded.uncertain.as_ref().expect("it says so").keys().collect();
    assert_eq!(keys, [FRICTION, K_PHI]);
    let soils: Vec<Soil> = (0..200).map(|index| draw(&loaded, index)).collect();
    for soil in &soils {
        let PressureSinkage::Reece { k_phi, .. } = soil.pressure_sinkage else {
            panic!("the law is kept")
        };
        let PressureSinkage::Reece { k_c, exponent, .. } = nominal.pressure_sinkage else {
            panic!("the law is Reece's")
        };
        let pressure_sinkage = PressureSinkage::Reece { k_c, k_phi, exponent };
        let expected = Soil { friction_angle: soil.friction_angle, pressure_sinkage, ..nominal };
        assert_eq!(*soil, expected);
    }
    let mean = soils.iter().map(|soil| soil.friction_angle).sum::<f64>() / 200.0;
    // Five standard errors of the mean.
    assert!((mean - deg(38.0)).abs() < 5.0 * deg(1.5) / 200.0_f64.sqrt(), "{mean}");
    assert_eq!(draw(&loaded, 17), soils[17]);
}

#[test]
fn a_drawn_document_is_the_drawn_soil_and_exact() {
    for preset in ["toyoura-uncertain", "toyoura"] {
        let loaded = read(document::preset(Kind::Soil, preset).expect("a preset").text)
            .expect("it is right");
        let uncertain = loaded.uncertain.as_ref().expect("by its own words or by priors");
        for index in 0..20 {
            let document = uncertain.draw_document(3, index).expect("it can be drawn");
            let again = read(&document.to_toml()).expect("it is a soil");
            assert_eq!(again.value, draw(&loaded, index), "{preset}");
            assert!(again.uncertain.is_none(), "{preset}");
        }
    }
}

#[test]
fn without_a_section_nothing_is_uncertain() {
    let loaded = read(&toyoura_with("")).expect("it is right");
    assert!(loaded.uncertain.is_none() && loaded.companions.is_empty());
    assert!(!loaded.to_toml().contains("uncertainty"));
}

#[test]
fn a_default_can_be_uncertain_too() {
    let text = toyoura_with(&parameter("pressure_sinkage.n_per_slip", "0.1"));
    let loaded = read(&text).expect("the key has its default");
    assert_ne!(draw(&loaded, 0), draw(&loaded, 1));
}

/// The range of a key is that of the law in force, and what lies outside is drawn again.
#[test]
fn draws_stay_within_the_ranges() {
    let loaded = read(&toyoura_with(&parameter(FRICTION, "30"))).expect("it is right");
    for index in 0..200 {
        let angle = draw(&loaded, index).friction_angle;
        assert!((deg(5.0)..=deg(60.0)).contains(&angle), "{angle}");
    }
    // The range of Reece's modulus ends at 1e5, that of Bekker's at 1e12.
    let text = toyoura_with(&parameter(K_PHI, "1e6"));
    let loaded = read(&text).expect("some draws are inside");
    for index in 0..50 {
        let PressureSinkage::Reece { k_phi, .. } = draw(&loaded, index).pressure_sinkage else {
            panic!("the law is kept")
        };
        assert!((0.0..=1e5).contains(&k_phi), "{k_phi}");
    }
}

/// n stays in its range at every slip, which only several keys together tell.
#[test]
fn draws_that_are_no_soil_together_are_drawn_again() {
    let loaded = read(&toyoura_with(&parameter("pressure_sinkage.n_per_slip", "2"))).expect("so");
    for index in 0..100 {
        let PressureSinkage::Reece { exponent, .. } = draw(&loaded, index).pressure_sinkage else {
            panic!("the law is kept")
        };
        assert!((0.3..=3.0).contains(&exponent.at(1.0)), "{exponent:?}");
    }
}

#[test]
fn the_mean_is_the_documents_even_if_it_was_set_from_outside() {
    let text = toyoura_with(&parameter(FRICTION, "0"));
    let overrides = Overrides::parse(["soil.friction_angle_deg=33"]).expect("a value");
    let loaded = document::read_soil(&Source::text("sand.toml", text), &overrides).expect("so");
    assert_eq!(draw(&loaded, 5), loaded.value);
    let overrides =
        Overrides::parse(["soil.uncertainty.parameter.0.standard_deviation=2"]).expect("a value");
    let preset = Source::find(Kind::Soil, "toyoura-uncertain").expect("a preset");
    let changed = document::read_soil(&preset, &overrides).expect("it can be set");
    let plain = document::read_soil(&preset, &Overrides::none()).expect("a preset");
    assert_ne!(draw(&changed, 0), draw(&plain, 0));
}

fn check_wrong(text: &str, spot: &str, message: &str) {
    let error = read(text).expect_err(message).to_string();
    assert!(error.starts_with("sand.toml"), "{error}");
    assert!(error.contains(message), "no `{message}` in: {error}");
    let shown = error.lines().nth(2).unwrap_or_default();
    assert!(shown.contains(spot), "no `{spot}` in: {error}");
}

#[test]
fn wrong_uncertainties_say_what_where_and_how_to_mend_it() {
    let good = parameter(FRICTION, "1.5") + &parameter(K_PHI, "10");
    for (section, spot, message) in [
        (parameter("friction_angle", "1"), "\"friction_angle\"", "mean `friction_angle_deg`?"),
        (parameter("k_phi", "1"), "\"k_phi\"", "did you mean `pressure_sinkage.k_phi`?"),
        (parameter("colour", "1"), "\"colour\"", "hint: there are cohesion_kpa,"),
        (parameter("", "1"), "key = \"\"", "unknown key ``"),
        (parameter("shear", "1"), "\"shear\"", "`shear` is not a number of this soil"),
        (parameter("name", "1"), "\"name\"", "`name` is not a number of this soil"),
        (parameter("shear.law", "1"), "\"shear.law\"", "`shear.law` is not a number of this soil"),
        (
            parameter("small_wheel.mounds.bow_wave", "1"),
            "\"small_wheel.mounds.bow_wave\"",
            "the document gives this key no value",
        ),
        (parameter(FRICTION, "-1"), "-1", "standard_deviation` is -1, it must be 0 to"),
        (parameter(FRICTION, "nan"), "nan", "is NaN, it must be a finite number"),
        (parameter(FRICTION, "\"1\""), "\"1\"", "a number is written without quotes"),
        (good.clone() + &parameter(FRICTION, "2"), FRICTION, "a second time"),
        (
            parameter(FRICTION, "1") + "distribution = \"gauss\"",
            "gauss",
            "it must be \"normal\", \"lognormal\", \"uniform\" or \"triangular\"",
        ),
        (
            parameter("cohesion_kpa", "1") + "distribution = \"lognormal\"",
            "cohesion_kpa",
            "`cohesion_kpa` is 0, it must be above 0 to be lognormal",
        ),
        (parameter(FRICTION, "1") + "low = 3", "low", "unknown key `uncertainty.parameter.0.low`"),
        (
            parameter(FRICTION, "1") + "low = 3",
            "low",
            "it goes with distribution = \"uniform\" or \"triangular\"",
        ),
        (uniform(FRICTION, "30", "61"), "61", "`friction_angle_deg` is 61, it must be 5 to 60"),
        (uniform(FRICTION, "40", "30"), "30", "above low, 40"),
        (good.clone() + &correlation(FRICTION, K_PHI, "1.1"), "1.1", "is 1.1, it must be -1 to 1"),
        (good.clone() + &correlation(FRICTION, K_PHI, "1"), "correlation", "not positive definite"),
        (good.clone() + &correlation(FRICTION, "k_phi", "0"), "k_phi", "`pressure_sinkage.k_phi`?"),
        (
            good.clone() + &correlation(FRICTION, "density_kg_m3", "0"),
            "density_kg_m3",
            "`density_kg_m3` has a correlation, but no standard deviation",
        ),
        (
            good.clone() + &correlation(FRICTION, FRICTION, "0"),
            FRICTION,
            "no correlation with itself",
        ),
        (
            good.clone() + &correlation(FRICTION, K_PHI, "0") + &correlation(K_PHI, FRICTION, "0"),
            K_PHI,
            "a second time",
        ),
        (
            good.clone() + "[[uncertainty.correlation]]\nbetween = [\"exit.ratio\"]\nvalue = 0",
            "exit.ratio",
            "has 1 entries, it must have 2",
        ),
        ("[uncertainty]".to_owned(), "uncertainty", "`uncertainty.parameter` is missing"),
        ("[uncertainty]\nsample = \"x\"".to_owned(), "sample", "hint: did you mean `samples`"),
        ("[uncertainty]\nsamples = 1".to_owned(), "1", "it must be a text in quotes"),
        (
            "[uncertainty]\nsamples = { csv = \"friction_angle_deg\\n38\\n39\" }\n".to_owned()
                + &good,
            "friction_angle_deg",
            "a second time",
        ),
        (
            "[uncertainty]\nsamples = \"no/such.csv\"".to_owned(),
            "no/such.csv",
            "there is no file of samples no/such.csv",
        ),
        (parameter(FRICTION, "1e9"), FRICTION, "less than 1 % of the samples"),
        (parameter(FRICTION, "1e9"), FRICTION, "5 to 60"),
        (
            uniform(N, "2.9", "3") + &uniform(N_PER_SLIP, "0.5", "1"),
            "uncertainty",
            "1000 tries of sample 0 gave nothing",
        ),
        (
            uniform(N, "2.9", "3") + &uniform(N_PER_SLIP, "0.5", "1"),
            "uncertainty",
            "`pressure_sinkage.n` 0.3 to 3, `pressure_sinkage.n_per_slip`",
        ),
    ] {
        check_wrong(&toyoura_with(&section), spot, message);
    }
}

/// A soil has the distributions of campaigns, a mean beside its value, and rows beside
/// distributions.
#[test]
fn soils_and_campaigns_speak_one_language() {
    let text = toyoura_with(
        &("[uncertainty]\nsamples = { csv = \"cohesion_kpa\\n0.25\\n0.5\" }\n".to_owned()
            + &parameter(FRICTION, "0")
            + "mean = 35\n"
            + &uniform("exit.ratio", "0.5", "0.75")),
    );
    let loaded = read(&text).expect("it is right");
    let again = read(&loaded.to_toml()).expect("it is resolved");
    assert!(loaded.companions.is_empty() && again.document == loaded.document);
    // Soils have the word after the numbers, as it always was: fingerprints depend on it.
    let written = "key = \"friction_angle_deg\"\nmean = 35.0\nstandard_deviation = 0.0\ndistribution = \"normal\"";
    assert!(loaded.to_toml().contains(written), "{}", loaded.to_toml());
    let soils = loaded.uncertain.as_ref().expect("it says so");
    assert_eq!(soils.keys().collect::<Vec<_>>(), [FRICTION, "exit.ratio", "cohesion_kpa"]);
    assert_eq!(soils.sampled_keys().collect::<Vec<_>>(), ["cohesion_kpa"]);
    for index in 0..50 {
        let soil = draw(&loaded, index);
        assert_eq!(soil.friction_angle, deg(35.0));
        assert!((0.5..=0.75).contains(&soil.exit.ratio(0.0)));
        assert!([250.0, 500.0].contains(&soil.cohesion));
        assert_eq!(soil, draw(&again, index));
    }
}

// ---- Files of samples ----

const SAMPLES: &str = "friction_angle_deg,shear.longitudinal_m\n36.5,0.03\n38.25,0.036\n40,0.05\n";

/// A soil whose samples are in a file, in a folder of its own.
fn sampled(name: &str, samples: impl AsRef<[u8]>) -> (Folder, Source) {
    let folder = Folder::new(name);
    folder.file("soils/posterior.csv", samples);
    let text = toyoura_with("[uncertainty]\nsamples = \"posterior.csv\"");
    let path = folder.file("soils/sand.toml", text);
    (folder, Source::file(path))
}

fn read_sampled(name: &str, samples: impl AsRef<[u8]>) -> Result<LoadedSoil, DocumentError> {
    let (_folder, source) = sampled(name, samples);
    document::read_soil(&source, &Overrides::none())
}

#[test]
fn each_draw_is_a_row_of_the_samples() {
    let loaded = read_sampled("samples", SAMPLES).expect("it is right");
    let angles = [36.5, 38.25, 40.0].map(deg);
    let mut seen = [false; 3];
    for index in 0..60 {
        let angle = draw(&loaded, index).friction_angle;
        let row = angles.iter().position(|known| *known == angle).expect("it is a row's");
        seen[row] = true;
    }
    assert_eq!(seen, [true; 3]);
}

/// What a caller without files has: the text, and what stands beside it.
#[test]
fn a_text_and_its_companions_are_as_good_as_files() {
    let from_files = read_sampled("beside", SAMPLES).expect("it is right");
    let (text, files) = (from_files.to_toml(), from_files.companions.clone());
    let source = Source::text_with("sand", text.clone(), files.clone());
    let again = document::read_soil(&source, &Overrides::none()).expect("its files are there");
    assert_eq!(again.companions, files);
    assert_eq!(draw(&again, 5), draw(&from_files, 5));
    assert!(read(&text).is_err(), "without its companions it has no samples");

    let mut changes = Overrides::none();
    let key = "{ samples = \"soil-samples.csv\" }";
    changes.change("soil.uncertainty", key, files).expect("it is a table");
    let plain = Source::find(Kind::Soil, "toyoura").expect("a preset");
    let changed = document::read_soil(&plain, &changes).expect("its file is there");
    assert_eq!(draw(&changed, 5), draw(&from_files, 5));
}

#[test]
fn samples_are_written_in_several_ways() {
    let plain = read_sampled("plain", SAMPLES).expect("it is right");
    for (name, samples) in [
        ("crlf", SAMPLES.replace('\n', "\r\n")),
        ("bom", format!("\u{feff}{SAMPLES}")),
        ("blanks", format!("\n{}\n\n", SAMPLES.replace(',', " , "))),
        ("quotes", SAMPLES.replacen(FRICTION, "\"friction_angle_deg\"", 1)),
        ("exponents", SAMPLES.replacen("0.036", "3.6e-2", 1)),
        ("no-end", SAMPLES.trim_end().to_owned()),
    ] {
        let loaded = read_sampled(name, samples).unwrap_or_else(|error| panic!("{error}"));
        for index in 0..20 {
            assert_eq!(draw(&loaded, index), draw(&plain, index), "{name}");
        }
    }
}

/// A run's folder has to work on its own.
#[test]
fn a_resolved_document_is_read_again_with_its_companions() {
    let (folder, source) = sampled("again", SAMPLES);
    let scenario = format!(
        "schema = \"scenario/1\"\nsoil = \"{}\"\n",
        folder.0.join("soils/sand.toml").display()
    );
    let path = folder.file("run.toml", scenario);
    let run = document::read_scenario(&Source::file(path), &Overrides::none()).expect("right");
    let soil = document::read_soil(&source, &Overrides::none()).expect("it is right");
    assert_eq!(run.companions, soil.companions);
    folder.file("out/run.toml", run.to_toml());
    for companion in &run.companions {
        folder.file(&format!("out/{}", companion.name), &companion.content);
    }
    fs::remove_dir_all(folder.0.join("soils")).expect("it is ours");
    let again = Source::file(folder.0.join("out/run.toml"));
    let again = document::read_scenario(&again, &Overrides::none()).expect("it is all there");
    assert_eq!(again.document, run.document);
    let first = run.uncertain.expect("so");
    let second = again.uncertain.expect("so");
    for index in 0..10 {
        assert_eq!(first.draw(1, index), second.draw(1, index));
    }
}

#[test]
fn wrong_samples_say_what_where_and_how_to_mend_it() {
    for (name, samples, place, message) in [
        ("unknown", SAMPLES.replacen(FRICTION, "friction", 1), ":1:1", "`friction_angle_deg`?"),
        ("word", SAMPLES.replacen(FRICTION, "name", 1), ":1:1", "`name` is not a number"),
        ("twice", SAMPLES.replacen("shear.longitudinal_m", FRICTION, 1), ":1:20", "a second time"),
        ("outside", SAMPLES.replacen("38.25", "380", 1), ":3:1", "is 380, it must be 5 to 60"),
        ("nan", SAMPLES.replacen("0.036", "nan", 1), ":3:7", "must be a finite number"),
        ("text", SAMPLES.replacen("0.036", "stiff", 1), ":3:7", "the text \"stiff\""),
        ("gap", SAMPLES.replacen("0.036", "", 1), ":3:7", "is missing, it must be a number"),
        ("short", SAMPLES.replacen(",0.036", "", 1), ":3:1", "this row has 1 values"),
        ("semicolons", SAMPLES.replace(",0", ";0"), ":2:1", "separated by commas"),
        ("one", SAMPLES.lines().take(2).collect::<Vec<_>>().join("\n"), "", "1 rows of numbers"),
        ("empty", String::new(), "", "0 rows of numbers"),
        (
            "together",
            "pressure_sinkage.n,pressure_sinkage.n_per_slip\n1.7,0.1\n2.9,0.3\n".to_owned(),
            ":3:1",
            "at a slip ratio of 1 is 3.2, it must be",
        ),
    ] {
        let error = read_sampled(name, samples).expect_err(name).to_string();
        assert!(error.contains(&format!("posterior.csv{place}: ")), "{name}: {error}");
        assert!(error.contains(message), "{name}: {error}");
    }
    let error = read_sampled("binary", [0xff, 0xfe, b'1']).expect_err("binary").to_string();
    assert!(error.contains("posterior.csv: is not a text"), "{error}");
}

#[test]
fn samples_that_are_gone_are_the_documents_fault() {
    let (folder, source) = sampled("gone", SAMPLES);
    fs::remove_file(folder.0.join("soils/posterior.csv")).expect("it is ours");
    let error = document::check(&source).expect_err("they are gone");
    assert!(error.place().document.ends_with("sand.toml"), "{error}");
    assert!(error.to_string().contains("hint: looked for"), "{error}");
    assert!(!error.is_environment());
    fs::create_dir(folder.0.join("soils/posterior.csv")).expect("it is ours");
    assert!(document::check(&source).is_err());
}

#[test]
fn the_uncertain_preset_is_toyoura_sand_otherwise() {
    let read = |name| {
        let source = Source::find(Kind::Soil, name).expect("a preset");
        document::read_soil(&source, &Overrides::none()).expect("it is read")
    };
    let uncertain = read("toyoura-uncertain");
    assert_eq!(uncertain.value, read("toyoura").value);
    // Every deviation says why.
    let soils = uncertain.uncertain.as_ref().expect("it says so");
    for key in soils.keys() {
        let reason = format!("uncertainty.{key}: ");
        assert!(uncertain.assumptions.iter().any(|one| one.contains(&reason)), "{key}");
    }
    let other = changed(
        Kind::Soil,
        "toyoura-uncertain",
        "standard_deviation = 1.5",
        "standard_deviation = 0",
    );
    let other = document::read_soil(&Source::text("other", other), &Overrides::none()).expect("so");
    assert_eq!(draw(&other, 4).friction_angle, uncertain.value.friction_angle);
}
