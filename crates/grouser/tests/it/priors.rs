//! What a soil does not state: its value in a single answer, its samples, and what fixes it.

use grouser::document::{
    self, DocumentError, FitKey, Kind, LoadedSoil, Overrides, SoilFamily, Source, UncertainSoil,
};
use grouser::soil::{Bulldozing, Exit, Shear, SmallWheel, Soil};
use proptest::prelude::*;
use serde_json::Value;

use crate::documents::Folder;

/// All that a soil has to state: how it carries, how strong it is, one shear modulus.
const STATED: &str =
    "schema = \"soil/1\"\nname = \"sand\"\nsource = \"a test\"\nfriction_angle_deg = 30.0\n";
const TABLES: &str = "[pressure_sinkage]\nlaw = \"bekker\"\nk_c = 0.0\nk_phi = 1e6\nn = 1.0\n\
     [shear]\nlaw = \"anisotropic\"\nlongitudinal_m = 0.02\n";
/// All that it then leaves to priors.
const MISSING: [&str; 12] = [
    "cohesion_kpa",
    "density_kg_m3",
    "constant_volume_share",
    "stress_peak.a0",
    "stress_peak.a1",
    "exit.ratio",
    "shear.lateral_m",
    "shear.longitudinal_per_rad_m",
    "shear.lateral_per_rad_m",
    "small_wheel.sinkage.with_slip",
    "small_wheel.interface.friction_share",
    "bulldozing.law",
];

fn sand(keys: &str, tables: &str) -> String {
    format!("{STATED}{keys}\n{TABLES}{tables}\n")
}

fn read(text: &str) -> Result<LoadedSoil, DocumentError> {
    document::read_soil(&Source::text("sand.toml", text), &Overrides::none())
}

fn soil(text: &str) -> LoadedSoil {
    read(text).unwrap_or_else(|error| panic!("{error}"))
}

fn preset(name: &str) -> LoadedSoil {
    let source = Source::find(Kind::Soil, name).expect("a preset");
    document::read_soil(&source, &Overrides::none()).expect("it is read")
}

fn with(text: &str, settings: &[&str]) -> LoadedSoil {
    let overrides = Overrides::parse(settings).expect("they are written so");
    document::read_soil(&Source::text("sand.toml", text), &overrides)
        .unwrap_or_else(|error| panic!("{error}"))
}

fn assumed(loaded: &LoadedSoil) -> Vec<&str> {
    loaded.assumed.iter().map(|one| &*one.key).collect()
}

fn drawn_keys(loaded: &LoadedSoil) -> Vec<&str> {
    loaded.uncertain.as_ref().map_or(Vec::new(), |soils| soils.keys().collect())
}

fn draws(loaded: &LoadedSoil, count: u32) -> Vec<Soil> {
    let soils = loaded.uncertain.as_ref().expect("it has priors");
    soils.draws(3, count).expect("they can be drawn")
}

fn ratio(soil: &Soil) -> f64 {
    soil.exit.ratio(0.0)
}

// ---- Single answers ----

#[test]
fn a_single_answer_takes_the_medians() {
    let loaded = soil(&sand("", ""));
    assert_eq!(assumed(&loaded), MISSING);
    let number = |key: &str| loaded.document.number(key).expect("it was filled in");
    // Closed forms: of triangles 1 − √½ of the base, or as their corner was chosen.
    let corner = 1.0 - 0.5_f64.sqrt();
    for (key, median) in [
        ("cohesion_kpa", 0.2),
        ("density_kg_m3", 1500.0),
        ("stress_peak.a0", 0.4),
        ("stress_peak.a1", 0.15),
        ("exit.ratio", 0.74 - (0.5_f64 * 0.74 * 0.54).sqrt()),
        ("shear.lateral_m", 0.6 * 0.02),
        ("shear.longitudinal_per_rad_m", 1.2 * corner * 0.02),
        ("shear.lateral_per_rad_m", 1.55 * corner * 0.6 * 0.02),
    ] {
        // Φ is computed to 1e-15 and more roughly inverted; a row's numbers have two digits.
        assert!((number(key) / median - 1.0).abs() < 1e-12, "{key}: {}", number(key));
        let one = loaded.assumed.iter().find(|one| one.key == key).expect("it is listed");
        assert_eq!((one.value, &*one.prior), (Some(number(key)), "General priors"));
        let start = format!("soil sand: {key}: not stated; ");
        assert!(loaded.assumptions.iter().any(|it| it.starts_with(&start)), "{key}");
    }
    assert_eq!(loaded.value.bulldozing, Bulldozing::Sine);
}

#[test]
fn a_table_may_lack_a_single_key() {
    let loaded = soil(&sand("cohesion_kpa = 0.0", "[stress_peak]\na1 = 0.32\n[exit]\n"));
    assert_eq!((loaded.value.stress_peak.a0, loaded.value.stress_peak.a1), (0.4, 0.32));
    let keys = assumed(&loaded);
    assert!(keys.contains(&"stress_peak.a0") && keys.contains(&"exit.ratio"));
    assert!(!keys.contains(&"stress_peak.a1") && !keys.contains(&"cohesion_kpa"));
}

/// Where another law has no such key there is nothing to assume.
#[test]
fn priors_follow_the_laws_of_the_soil() {
    let quadratic =
        "[exit]\nlaw = \"quadratic-in-slip\"\nat_zero = 0.8\nper_slip = -1.9\nper_slip2 = 2.1\n";
    let text = sand("", quadratic).replace("anisotropic", "isotropic");
    let loaded = soil(&text);
    let keys = assumed(&loaded);
    assert!(!keys.contains(&"exit.ratio") && !keys.contains(&"shear.lateral_m"), "{keys:?}");
    assert!(keys.contains(&"shear.longitudinal_per_rad_m"));
    assert!(matches!(loaded.value.shear, Shear::Isotropic { .. }));
    assert!(matches!(loaded.value.exit, Exit::QuadraticInSlip { .. }));
}

/// A loose sand without a cohesion has little; of a clay no prior knows it.
#[test]
fn a_firm_soil_states_its_cohesion() {
    let error = read(&sand("consistency = \"firm\"", "")).expect_err("clay").to_string();
    assert!(error.contains("`cohesion_kpa` is missing"), "{error}");
    assert!(error.contains("priors have none"), "{error}");
    let loaded = soil(&sand("consistency = \"firm\"\ncohesion_kpa = 4.0", ""));
    assert!((loaded.value.density - 1700.0).abs() < 1e-9, "{}", loaded.value.density);
}

#[test]
fn without_priors_everything_is_stated_and_exact() {
    let error = read(&sand("priors = \"none\"", "")).expect_err("no exit").to_string();
    assert!(error.contains("is missing") && error.contains("priors have none"), "{error}");
    let text = document::preset(Kind::Soil, "toyoura").expect("a preset").text;
    let exact = soil(&text.replacen("\ncohesion", "\npriors = \"none\"\ncohesion", 1));
    assert_eq!((exact.uncertain, exact.value), (None, preset("toyoura").value));
    assert!(exact.assumed.is_empty());
}

// ---- Samples ----

#[test]
fn samples_depend_on_seed_and_number_alone() {
    let soils = soil(&sand("", "")).uncertain.expect("it has priors");
    let alone = soils.draw(5, 17).expect("drawn");
    let all = soils.draws(5, 20).expect("drawn");
    assert_eq!(alone, all[17]);
    assert_ne!(alone, soils.draw(6, 17).expect("drawn"));
    assert_ne!(alone, all[16]);
}

/// What is missing is drawn from its prior, what is printed within what prints are known to.
#[test]
fn samples_spread_as_the_priors_say() {
    let loaded = soil(&sand("cohesion_kpa = 0.5", ""));
    let stated = ["friction_angle_deg", "cohesion_kpa", "pressure_sinkage.k_phi"];
    let keys = drawn_keys(&loaded);
    assert!(stated.iter().all(|key| keys.contains(key)), "{keys:?}");
    // A modulus of zero stays what it is.
    assert!(!keys.contains(&"pressure_sinkage.k_c") && !keys.contains(&"bulldozing.law"));
    let soils = draws(&loaded, 4000);
    let share = |is: &dyn Fn(&Soil) -> bool| {
        soils.iter().filter(|soil| is(soil)).count() as f64 / soils.len() as f64
    };
    // Four standard errors of a share of a half over 4000: 0.032.
    let nominal = loaded.value;
    assert!((share(&|soil| ratio(soil) < ratio(&nominal)) - 0.5).abs() < 0.032);
    assert!((share(&|soil| soil.stress_peak.a1 < 0.15) - 0.5).abs() < 0.032);
    assert!((share(&|soil| soil.friction_angle < nominal.friction_angle) - 0.5).abs() < 0.032);
    assert!(soils.iter().all(|soil| (0.0..=1.0).contains(&ratio(soil))));
    // λ: a triangle from 0 over 0.2 to 0.74 has 1 − 0.24²/(0.74 · 0.54) below 0.5.
    assert!((share(&|soil| ratio(soil) < 0.5) - 0.8559).abs() < 0.023);
    let angles: Vec<f64> = soils.iter().map(|it| it.friction_angle.to_degrees()).collect();
    let mean = angles.iter().sum::<f64>() / 4000.0;
    let variance = angles.iter().map(|it| (it - mean).powi(2)).sum::<f64>() / 3999.0;
    // Four standard errors of a standard deviation over 4000 are 4.5 %.
    assert!((variance.sqrt() / 1.5 - 1.0).abs() < 0.045, "{}", variance.sqrt());
}

/// Moduli of one sand go together: the correlation of their logarithms is 0.5 by the prior.
#[test]
fn moduli_by_direction_are_correlated() {
    let soils = draws(&soil(&sand("", "")), 4000);
    let logarithms: Vec<(f64, f64)> = soils
        .iter()
        .map(|soil| match soil.shear {
            Shear::Anisotropic { longitudinal, lateral } => {
                (longitudinal.at(0.0).ln(), lateral.at(0.0).ln())
            }
            Shear::Isotropic { .. } => panic!("the law is kept"),
        })
        .collect();
    let count = logarithms.len() as f64;
    let (x, y) = logarithms.iter().fold((0.0, 0.0), |sum, it| (sum.0 + it.0, sum.1 + it.1));
    let (x, y) = (x / count, y / count);
    let product = |of: &dyn Fn(&(f64, f64)) -> f64| logarithms.iter().map(of).sum::<f64>();
    let covariance = product(&|it| (it.0 - x) * (it.1 - y));
    let (of_x, of_y) = (product(&|it| (it.0 - x).powi(2)), product(&|it| (it.1 - y).powi(2)));
    let correlation = covariance / (of_x * of_y).sqrt();
    // Four standard errors, (1 − ρ²)/√N: 0.047.
    assert!((correlation - 0.5).abs() < 0.047, "{correlation}");
}

/// What the soil says itself wins over priors: its distribution, and its median where it has no
/// value.
#[test]
fn a_soils_own_uncertainty_goes_before_its_priors() {
    let own = "[[uncertainty.parameter]]\nkey = \"exit.ratio\"\ndistribution = \"uniform\"\n\
               low = 0.5\nhigh = 0.75\n[[uncertainty.parameter]]\nkey = \"friction_angle_deg\"\n\
               standard_deviation = 0.0\n";
    let loaded = soil(&sand("", own));
    assert_eq!(ratio(&loaded.value), 0.625);
    assert!(!assumed(&loaded).contains(&"exit.ratio"));
    assert!(loaded.stated_uncertainty().is_some());
    let soils = draws(&loaded, 200);
    assert!(soils.iter().all(|soil| (0.5..=0.75).contains(&ratio(soil))));
    assert!(soils.iter().all(|soil| soil.friction_angle == loaded.value.friction_angle));
    // Others are drawn beside them.
    assert_ne!(soils[0].stress_peak.a0, soils[1].stress_peak.a0);
    assert_eq!(drawn_keys(&loaded)[..2], ["exit.ratio", "friction_angle_deg"]);
}

/// Samples belong to the numbers with which they were found.
#[test]
fn beside_rows_of_samples_printed_numbers_are_exact() {
    let rows = "[uncertainty]\nsamples = { csv = \"friction_angle_deg\\n30\\n32\" }\n";
    let loaded = soil(&sand("cohesion_kpa = 0.5", rows));
    let keys = drawn_keys(&loaded);
    assert!(keys.contains(&"friction_angle_deg") && keys.contains(&"exit.ratio"), "{keys:?}");
    assert!(!keys.contains(&"cohesion_kpa") && !keys.contains(&"pressure_sinkage.n"), "{keys:?}");
}

// ---- Settings ----

#[test]
fn a_key_that_is_set_is_stated_and_not_drawn() {
    let text = sand("", "");
    let resolved = soil(&text).to_toml();
    for text in [&text, &resolved] {
        let loaded = with(text, &["soil.exit.ratio=0.4", "soil.friction_angle_deg=33"]);
        assert_eq!(ratio(&loaded.value), 0.4);
        assert!(!assumed(&loaded).contains(&"exit.ratio"));
        assert!(draws(&loaded, 50).iter().all(|soil| ratio(soil) == 0.4));
        let angle = loaded.value.friction_angle;
        assert!(draws(&loaded, 50).iter().all(|soil| soil.friction_angle == angle));
        let notes: Vec<_> =
            loaded.assumptions.iter().filter(|it| it.contains("exit.ratio:")).collect();
        assert!(matches!(notes[..], [one] if one.contains("set to 0.4")), "{notes:?}");
        let again = soil(&loaded.to_toml());
        assert_eq!((&again.value, &again.assumed), (&loaded.value, &loaded.assumed));
        assert_eq!(draws(&again, 20), draws(&loaded, 20));
    }
    let other = with(&resolved, &["soil.shear.law=isotropic"]);
    assert!(!assumed(&other).contains(&"shear.lateral_m"));
}

#[test]
fn rows_of_priors_are_set_like_other_keys() {
    let loaded = with(&sand("", ""), &["soil.priors.missing.6.high=0.5"]);
    assert_eq!(assumed(&loaded)[5], "exit.ratio");
    // A triangle from 0 over 0.2 to 0.5.
    assert!((ratio(&loaded.value) - (0.5 - (0.5_f64 * 0.5 * 0.3).sqrt())).abs() < 1e-12);
    let error = Overrides::parse(["wheel.radius_m=1", "prior.missing.0.high=1"])
        .expect("they are written so")
        .check_kinds(&[Kind::Wheel]);
    assert!(error.is_err());
}

// ---- Resolved documents ----

/// Complete enough to run again: value, samples and what is assumed.
#[test]
fn a_resolved_soil_is_the_same_soil() {
    for preset in document::presets(Kind::Soil) {
        let first = document::read_soil(&Source::Preset(preset), &Overrides::none());
        let first = first.unwrap_or_else(|error| panic!("{error}"));
        let again = soil(&first.to_toml());
        assert_eq!(first.value, again.value, "{}", preset.name);
        assert_eq!(first.assumed, again.assumed, "{}", preset.name);
        assert_eq!(first.assumptions, again.assumptions, "{}", preset.name);
        assert_eq!(drawn_keys(&first), drawn_keys(&again), "{}", preset.name);
        assert_eq!(draws(&first, 5), draws(&again, 5), "{}", preset.name);
        assert_eq!(first.fingerprint(), again.fingerprint(), "{}", preset.name);
    }
}

#[test]
fn a_resolved_run_has_the_same_soils() {
    let overrides = Overrides::parse(["scenario.soil=dry-sand"]).expect("a name");
    let read = |source: &Source, overrides: &Overrides| {
        document::read_scenario(source, overrides).unwrap_or_else(|error| panic!("{error}"))
    };
    let first = read(&Source::default_scenario(), &overrides);
    let again = read(&Source::text("run", first.to_toml()), &Overrides::none());
    assert!(first.assumed.iter().any(|one| one.key == "exit.ratio"));
    assert_eq!((&first.value, &first.assumed), (&again.value, &again.assumed));
    let draw = |loaded: &document::LoadedScenario| {
        loaded.uncertain.as_ref().expect("it has priors").draw(1, 4).expect("drawn")
    };
    assert_eq!(draw(&first), draw(&again));
    assert!(first.stated_uncertainty().is_none() && first.soils_of_bands().is_some());
}

/// Today's answers of these stand: they state every number, or the paper's.
#[test]
fn toyoura_and_the_fitted_soils_state_everything() {
    for preset in document::presets(Kind::Soil) {
        let loaded = document::read_soil(&Source::Preset(preset), &Overrides::none()).expect("so");
        let name = preset.name;
        let states_all =
            name.starts_with("toyoura") || name.starts_with("cmu-") || name == "simulant-2007";
        assert_eq!(loaded.assumed.is_empty(), states_all, "{name}: {:?}", loaded.assumed);
    }
    let uncertain = preset("toyoura-uncertain");
    assert_eq!(
        drawn_keys(&uncertain),
        [
            "friction_angle_deg",
            "pressure_sinkage.k_phi",
            "shear.longitudinal_m",
            "shear.lateral_m",
            "exit.ratio"
        ]
    );
    assert!(preset("toyoura").stated_uncertainty().is_none());
}

// ---- Documents of priors ----

#[test]
fn every_prior_says_why() {
    for preset in document::presets(Kind::Prior) {
        let priors = document::read_priors(&Source::Preset(preset), &Overrides::none());
        let priors = priors.unwrap_or_else(|error| panic!("{error}"));
        for list in ["missing", "keyword", "stated", "correlation"] {
            let rows = priors.get(list).and_then(Value::as_array);
            for row in rows.into_iter().flatten() {
                let has = |key: &str| row[key].as_str().is_some_and(|text| text.len() > 10);
                assert!(has("reason"), "{}: {row}", preset.name);
                assert!(list == "correlation" || has("source"), "{}: {row}", preset.name);
            }
        }
    }
    let silent = "schema = \"prior/1\"\n[[missing]]\nkey = \"exit.ratio\"\n\
                  distribution = \"uniform\"\nlow = 0.0\nhigh = 1.0\n";
    let error = document::check(&Source::file(Folder::new("silent").file("priors.toml", silent)));
    let error = error.expect_err("it does not say why").to_string();
    assert!(error.contains("`missing.0.reason` is missing"), "{error}");
}

/// Rows of a soil's own: of optional tables too, and only for those that do not state them.
#[test]
fn a_prior_may_cover_any_number_of_a_soil() {
    let rows = "[[priors.missing]]\nkey = \"small_wheel.sinkage.with_slip\"\n\
                unless = \"small_wheel\"\ndistribution = \"lognormal\"\nmedian = 1.5\n\
                standard_deviation = 0.5\n[[priors.missing]]\nkey = \"small_wheel.sinkage.bend\"\n\
                unless = \"small_wheel\"\nmean = 0.5\nstandard_deviation = 0.1\n";
    let text = document::preset(Kind::Soil, "toyoura").expect("a preset").text;
    let loaded = soil(&format!("{text}\n{rows}"));
    assert_eq!(assumed(&loaded), ["small_wheel.sinkage.with_slip", "small_wheel.sinkage.bend"]);
    let growth = loaded.value.small_wheel.sinkage;
    assert!((growth.with_slip - 1.5).abs() < 1e-12 && growth.bend == 0.5, "{growth:?}");
    let soils = draws(&loaded, 50);
    assert_ne!(soils[0].small_wheel.sinkage.with_slip, soils[1].small_wheel.sinkage.with_slip);
    let again = soil(&loaded.to_toml());
    assert_eq!((&again.value, &again.assumed), (&loaded.value, &loaded.assumed));
    assert_eq!(draws(&again, 50), soils);
    let stated = soil(&format!("{text}\n[small_wheel.sinkage]\nlocked = 2.0\n{rows}"));
    let general = SmallWheel::GENERAL.sinkage.with_slip;
    assert!(stated.assumed.is_empty() && stated.value.small_wheel.sinkage.with_slip == general);
}

#[test]
fn a_soil_may_name_other_priors() {
    let folder = Folder::new("priors");
    let mine = document::preset(Kind::Prior, "general").expect("a preset").text;
    let mine = mine.replace("General priors", "Mine").replace(
        "distribution = \"uniform\"\nlow    = 0.0\nhigh   = 0.3",
        "distribution = \"uniform\"\nlow    = 0.2\nhigh   = 0.3",
    );
    folder.file("soils/mine.toml", mine);
    let path = folder.file("soils/sand.toml", sand("priors = \"mine.toml\"", ""));
    let loaded = document::read_soil(&Source::file(path), &Overrides::none()).expect("so");
    assert!((loaded.value.stress_peak.a1 - 0.25).abs() < 1e-12);
    assert!(loaded.assumed.iter().all(|one| one.prior == "Mine"));
}

#[test]
fn wrong_priors_say_what_and_where() {
    let row =
        |row: &str| format!("schema = \"prior/1\"\n[[missing]]\nreason = \"for a test\"\n{row}\n");
    for (text, spot, message) in [
        (row("key = \"exit.ration\"\nmean = 1\nstandard_deviation = 1"), "exit.ration", "unknown"),
        (
            row("key = \"exit.ratio\"\nstandard_deviation = 0.1"),
            "exit.ratio",
            "`median` is missing",
        ),
        (
            row("key = \"exit.ratio\"\nmean = 0.2\nmedian = 0.2\nstandard_deviation = 0.01"),
            "median",
            "a mean or a median",
        ),
        (
            row("key = \"exit.ratio\"\nmean = 0.0\nstandard_deviation = 1"),
            "exit.ratio",
            "more than 1 %",
        ),
        (
            row("key = \"exit.ratio\"\ndistribution = \"uniform\"\nlow = 0.5\nhigh = 0.2"),
            "exit.ratio",
            "or it is none",
        ),
        (
            row(
                "key = \"shear.lateral_m\"\nrelative_to = \"shear.k\"\nmean = 1\nstandard_deviation = 1",
            ),
            "shear.k",
            "unknown key `shear.k`",
        ),
        (
            row(
                "key = \"exit.ratio\"\nmean = 0.5\nstandard_deviation = 0.1\n[[correlation]]\nreason = \"for a test\"\nbetween = [\"exit.ratio\", \"cohesion_kpa\"]\nvalue = 0.5",
            ),
            "cohesion_kpa",
            "no standard deviation",
        ),
    ] {
        let error = document::read_priors(&Source::text("mine.toml", &text), &Overrides::none());
        let error = error.expect_err(message).to_string();
        assert!(error.contains(message) && error.contains(spot), "{message}: {error}");
    }
}

/// What editors say of such a document.
#[test]
fn the_schema_lets_a_soil_leave_them_out() {
    let schema: Value = serde_json::from_str(&document::schema(Kind::Soil)).expect("JSON");
    let required = |schema: &Value| -> Vec<String> {
        let all = schema["required"].as_array().into_iter().flatten();
        all.map(|key| key.as_str().expect("a key").to_owned()).collect()
    };
    assert_eq!(required(&schema), ["schema", "friction_angle_deg", "pressure_sinkage", "shear"]);
    assert!(required(&schema["properties"]["stress_peak"]).is_empty());
    for law in schema["properties"]["shear"]["oneOf"].as_array().expect("laws") {
        assert_eq!(required(law), ["law", "longitudinal_m"]);
    }
    for law in schema["properties"]["exit"]["anyOf"].as_array().expect("laws") {
        assert!(!required(law).contains(&"ratio".to_owned()));
    }
}

// ---- Studies ----

fn campaign(keys: &str, parameters: &str) -> document::Campaign {
    let text = format!(
        "schema = \"campaign/1\"\nname = \"test\"\nstudy = \"wheel-test\"\nruns = 6\n{keys}\n\
         [wheel_test]\nsoil = \"dry-sand\"\nwheel = \"hakuto\"\nload_n = 17.0\nslip_ratio = 0.2\n{parameters}"
    );
    document::read_campaign(&Source::text("campaign", text), &Overrides::none())
        .unwrap_or_else(|error| panic!("{error}"))
}

/// A campaign over a missing key: without a mean it is about the median.
#[test]
fn a_campaign_varies_a_key_that_the_soil_lacks() {
    let row = "[[parameter]]\nkey = \"soil.exit.ratio\"\ndistribution = \"normal\"\n\
               standard_deviation = 0.0\n";
    let fixed = campaign("", row);
    let place = fixed.columns().iter().position(|it| it.name == "soil.exit.ratio");
    let cell = &fixed.run(3)[place.expect("an input")];
    let median = preset("dry-sand").document.number("exit.ratio");
    assert_eq!(*cell, document::table::Cell::Float(median));
}

#[test]
fn a_campaign_draws_the_priors_of_its_soil() {
    let own = "[[parameter]]\nkey = \"soil.stress_peak.a1\"\ndistribution = \"uniform\"\n\
               low = 0.1\nhigh = 0.2\n";
    let first = campaign("soil_uncertainty = true", own);
    let factors: Vec<&str> = first.factors().iter().map(String::as_str).collect();
    assert_eq!(factors[0], "soil.stress_peak.a1");
    assert_eq!(factors.iter().filter(|it| **it == "soil.stress_peak.a1").count(), 1);
    assert!(factors.contains(&"soil.exit.ratio") && factors.contains(&"soil.friction_angle_deg"));
    let again = Source::text("again", first.resolved());
    let again = document::read_campaign(&again, &Overrides::none()).expect("it is resolved");
    assert_eq!(again.resolved(), first.resolved());
    for index in 0..first.runs() {
        assert_eq!(format!("{:?}", again.run(index)), format!("{:?}", first.run(index)));
    }
    assert_eq!(again.assumed(), first.assumed());
    assert!(first.assumed().iter().any(|one| one.key == "exit.ratio"));
}

#[test]
fn a_calibrated_key_is_no_longer_assumed() {
    let sand = preset("dry-sand");
    let keys = [FitKey::parse("soil.exit.ratio").expect("a key")];
    let family = SoilFamily::new(&sand.document, &keys).expect("it has a value to start from");
    assert_eq!(family.parameters()[0].start, ratio(&sand.value));
    let fitted = family.fitted(&[0.4], "a test", Some(grouser::contact::Model::Ishigami), None);
    let loaded = soil(&fitted.to_toml());
    assert_eq!(ratio(&loaded.value), 0.4);
    let keys = assumed(&loaded);
    assert!(!keys.contains(&"exit.ratio") && keys.contains(&"stress_peak.a0"), "{keys:?}");
    // Beside samples the others are held, and still not the source's.
    let held = soil(&document::with_priors_held(&fitted).to_toml());
    assert_eq!((&held.value, assumed(&held)), (&loaded.value, keys));
    assert!(draws(&held, 20).iter().all(|soil| *soil == held.value));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    /// A prior relative to a modulus scales with it: with K, K_y and both growths.
    #[test]
    fn relative_priors_scale(modulus in 1e-3..0.5_f64) {
        let text = |modulus: f64| sand("", "").replace("0.02\n", &format!("{modulus}\n"));
        let (one, other) = (soil(&text(0.02)), soil(&text(modulus)));
        for key in MISSING.iter().filter(|key| key.starts_with("shear.")) {
            let (of, at) = (one.document.number(key), other.document.number(key));
            let factor = at.expect("filled in") / of.expect("filled in");
            prop_assert!((factor / (modulus / 0.02) - 1.0).abs() < 1e-9, "{}: {}", key, factor);
        }
    }
}

/// A soil may stand in a scenario's argument as a whole: it has the spread that it has as a file.
#[test]
fn a_soil_given_as_one_argument_is_a_document_like_any_other() {
    let text = sand("", "");
    let file = soil(&text);
    let table: toml::Table = toml::from_str(&text).expect("it is TOML");
    let inline = format!("scenario.soil={}", inline(&toml::Value::Table(table)));
    let settings = Overrides::parse([inline]).expect("a key with a value");
    let scenario = document::read_scenario(&Source::default_scenario(), &settings).expect("read");
    let keys = |soils: Option<&UncertainSoil>| {
        soils.map_or(Vec::new(), |soils| soils.keys().map(str::to_owned).collect::<Vec<_>>())
    };
    assert_eq!(keys(scenario.uncertain.as_ref()), keys(file.uncertain.as_ref()));
    assert_eq!(scenario.assumed.len(), file.assumed.len());
    let changed = Overrides::parse(["soil.shear.longitudinal_m=0.02"]).expect("a key with a value");
    let changed = document::read_scenario(&Source::default_scenario(), &changed).expect("read");
    let is_shear = |key: &String| key.ends_with("shear.longitudinal_m");
    assert!(!keys(changed.uncertain.as_ref()).iter().any(is_shear), "what is set is exact");
}

/// A value on one line.
fn inline(value: &toml::Value) -> String {
    match value {
        toml::Value::Table(table) => {
            let pairs = table.iter().map(|(key, value)| format!("{key} = {}", inline(value)));
            format!("{{{}}}", pairs.collect::<Vec<_>>().join(", "))
        }
        other => other.to_string(),
    }
}
