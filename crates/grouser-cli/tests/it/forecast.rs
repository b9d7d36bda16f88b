//! `forecast`: its numbers, its folder, and what it refuses.

use serde_json::{Value, json};

use crate::program::{Place, number};

/// Few samples: what is asked here does not depend on their number.
const MOON: &str = "forecast --rover hakuto --soil toyoura-uncertain --site moon --slope-deg 10 \
                    --samples 2 --discrepancies 2";

fn texts<'a>(rows: &'a Value, key: &str) -> Vec<&'a str> {
    let rows = rows.as_array().expect("rows").iter();
    rows.map(|row| row[key].as_str().expect("a text")).collect()
}

#[test]
fn json_has_the_choices_the_bands_and_the_budget() {
    let answer = Place::new().json(MOON);
    assert_eq!(answer["schema"], "grouser.forecast.v1");
    let inputs = &answer["inputs"];
    assert_eq!(inputs["scaling"], json!(["reece", "bekker", "granular-scaling"]));
    assert_eq!(inputs["ground"], json!(["as-measured", "lunar-nominal", "lunar-0-15-cm"]));
    assert_eq!(inputs["mass"], json!({"equal-mass": 1.0}));
    assert_eq!(
        (&inputs["gravity_m_s2"], &inputs["measured_gravity_m_s2"]),
        (&json!(1.62), &json!(9.80665))
    );
    assert_eq!(inputs["no_go_slip_ratio"], 0.6);
    let grounds = ["as-measured", "lunar-nominal", "lunar-0-15-cm"];
    assert_eq!(texts(&answer["rows"], "ground"), [grounds, grounds].concat());
    let supports = ["other-gravity", "site-gravity", "site-gravity", "none", "none", "none"];
    assert_eq!(texts(&answer["rows"], "support"), supports);
    assert_eq!(answer["steepest"][0]["cases"], 3 * 2 * 2 * 2);
    assert_eq!(answer["steepest"][5]["scaling"], json!(["bekker"]));
    let row = &answer["rows"][0];
    for key in
        ["slip_ratio", "downhill_m_per_m", "yaw_deg", "power_w", "energy_j_per_m", "sinkage_mm"]
    {
        let [low, median, high] =
            ["_p2_5", "_p50", "_p97_5"].map(|end| number(&row[format!("{key}{end}")]));
        assert!(low <= median && median <= high, "{key}: {row}");
    }
    assert_eq!(row["probability_no_heading"], 0.0);
    let [low, chance, high] =
        ["_low", "", "_high"].map(|end| number(&row[format!("probability_slip_above_limit{end}")]));
    assert!(low <= chance && chance < high, "{row}");
    let shares = row.as_object().expect("a row").iter();
    let shares = shares.filter(|(name, _)| name.starts_with("share_"));
    assert!((shares.map(|(_, share)| number(share)).sum::<f64>() - 1.0).abs() < 1e-12);
    let slip = answer["budget"].as_array().expect("a budget").iter();
    let slip = slip.filter(|it| it["ground"] == "lunar-nominal" && it["support"] != "none");
    let slip: Vec<&Value> = slip.filter(|it| it["quantity"] == "slip_ratio").collect();
    let (whole, parts) = slip.split_last().expect("parts");
    assert_eq!((&whole["factor"], &whole["variance_share"]), (&json!("whole"), &json!(1.0)));
    let sum: f64 = parts.iter().map(|part| number(&part["variance_share"])).sum();
    assert!((sum - 1.0).abs() < 1e-12);
    assert!(parts.iter().all(|part| part["what_would_shrink_it"] != ""));
    assert_eq!(texts(&answer["tests"], "test"), ["equal-mass", "equal-weight"]);
    let notes: Vec<&str> =
        answer["notes"].as_array().expect("notes").iter().filter_map(Value::as_str).collect();
    assert!(notes.iter().any(|note| note.contains("`bekker` keeps moduli")), "{notes:?}");
    assert!(notes.iter().any(|note| note.contains("mechanical")), "{notes:?}");
}

/// A forecast of one ground has the rows that it has among others, on the terminal too.
#[test]
fn a_ground_among_others_has_the_rows_that_it_has_alone() {
    let place = Place::new();
    let (all, alone) = (place.json(MOON), place.json(&format!("{MOON} --ground lunar-nominal")));
    for key in ["rows", "steepest", "budget", "choices"] {
        let rows = all[key].as_array().expect("rows").iter();
        let own: Vec<&Value> = rows.filter(|row| row["ground"] == "lunar-nominal").collect();
        assert!(!own.is_empty());
        assert_eq!(own, alone[key].as_array().expect("rows").iter().collect::<Vec<_>>(), "{key}");
    }
    let text = place.results(MOON);
    let lines: Vec<&str> = text.lines().skip(1).take(3).collect();
    for (line, ground) in lines.iter().zip(["as-measured", "lunar-nominal", "lunar-0-15-cm"]) {
        assert!(line.starts_with(ground), "{text}");
    }
}

/// Constants that are kept are warned of only where they are, and under another gravity.
#[test]
fn nothing_is_noted_of_choices_that_are_not_made() {
    let place = Place::new();
    let reece = place.json(&format!("{MOON} --scaling reece --ground as-measured"));
    assert!(!reece["notes"].to_string().contains("bekker"), "{}", reece["notes"]);
    let factors = texts(&reece["budget"], "factor");
    assert!(!factors.contains(&"gravity-scaling"), "{factors:?}");
    assert!(!reece["notes"].to_string().contains("averaged"), "{}", reece["notes"]);
    let home = place.json(
        "forecast --soil lunar-nominal --site moon --slope-deg 10 --samples 2 --discrepancies 2",
    );
    assert_eq!(home["inputs"]["ground"], json!(["as-measured"]));
    assert_eq!(home["tests"], json!([]));
    assert!(!home["notes"].to_string().contains("`bekker`"), "{}", home["notes"]);
    let assumed = place.json(
        "forecast --soil dry-sand --site mars --slope-deg 5 --samples 2 --discrepancies 2 --model \
         ishigami",
    );
    assert!(assumed["notes"].to_string().contains("which is assumed"), "{}", assumed["notes"]);
    assert!(assumed["notes"].to_string().contains("priors"), "{}", assumed["notes"]);
}

#[test]
fn the_folder_has_the_page_and_all_that_repeats_it() {
    let place = Place::new();
    let text = place.results(&format!("{MOON} --mass equal-mass,flight=0.65 --out moon"));
    for part in [
        "within each ground",
        "steepest slope",
        "share_rover_mass",
        "nothing is averaged over grounds",
        "tests where the soil was measured",
        "equal-weight",
        "note: power is mechanical",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    for name in [
        "forecast.json",
        "forecast.csv",
        "steepest.csv",
        "budget.csv",
        "choices.csv",
        "tests.csv",
        "budget.svg",
        "slip.svg",
    ] {
        assert!(!place.read(&format!("moon/{name}")).is_empty(), "{name}");
    }
    let page = place.read("moon/report.html");
    for part in [
        "What would shrink it",
        "On 10° the slip ratio is",
        "It is least known on as-measured",
        "95 %, lunar-0-15-cm",
        "lunar-0-15-cm (bekker)",
        "with its share of interactions",
        "granular-scaling",
        "flight",
        "Error budget",
        "<svg",
        "lunar-0-15-cm",
    ] {
        assert!(page.contains(part), "{part}");
    }
    place.results("check moon/scenario.toml moon/ground-1/soil.toml moon/ground-2/soil.toml");
    // From the folder's documents the same numbers.
    let again = place.json(
        "forecast moon/scenario.toml --site moon --slope-deg 10 --samples 2 --discrepancies 2 \
         --mass equal-mass,flight=0.65 --ground \
         as-measured,moon/ground-1/soil.toml,moon/ground-2/soil.toml",
    );
    let first: Value = serde_json::from_str(&place.read("moon/forecast.json")).expect("JSON");
    // The grounds have other names now: those of their files.
    for (again, first) in
        again["rows"].as_array().into_iter().flatten().zip(first["rows"].as_array().expect("rows"))
    {
        assert_eq!(again["slip_ratio_p97_5"], first["slip_ratio_p97_5"]);
        assert_eq!(again["yaw_deg_p50"], first["yaw_deg_p50"]);
    }
    assert_eq!(again["version"], first["version"]);
}

#[test]
fn strict_accepts_no_extrapolation() {
    let answer = Place::new().line(&format!("{MOON} --strict"));
    assert_eq!(answer.code(), 2);
    assert!(answer.stderr.contains("gravity-outside"), "{}", answer.stderr);
}

#[test]
fn what_it_refuses_names_the_flag_and_says_what_to_write() {
    let place = Place::new();
    for (rest, parts) in [
        ("--site venus", &["--site venus", "one of earth, moon, mars"][..]),
        ("--site mon", &["did you mean `moon`?"]),
        ("--site 0", &["--site 0", "from 0.001"]),
        ("", &["--site"]),
        ("--site moon --scaling rece", &["--scaling rece", "did you mean `reece`?"]),
        ("--site moon --scaling reece,reece", &["--scaling: reece is named twice"]),
        ("--site moon --mass heavy", &["--mass 'heavy'", "equal-weight", "flight=0.65"]),
        ("--site moon --mass flight=0", &["--mass 'flight=0'", "0.001"]),
        ("--site moon --ground nowhere", &["--ground nowhere"]),
        ("--site moon --samples 1", &["--samples"]),
        ("--site moon --slope-deg 70", &["--slope-deg 70"]),
        ("--site moon --no-go-slip-ratio 1.5", &["--no-go-slip-ratio 1.5"]),
        ("--site moon --measured-gravity-m-s2 x", &["--measured-gravity-m-s2 x"]),
        ("--site moon --set scenario.gravity_m_s2=3", &["gravity_m_s2"]),
    ] {
        let answer = place.line(&format!("forecast {rest}"));
        assert_eq!(answer.code(), 2, "{rest}: {}", answer.stderr);
        for part in parts {
            assert!(answer.stderr.contains(part), "{rest}: {part}: {}", answer.stderr);
        }
    }
}
