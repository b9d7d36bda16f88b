//! `validate`: theories beside measurements, in the words of scripts and of people.

use insta::assert_snapshot;
use serde_json::Value;

use crate::bad_input::{check_is_refusal, check_lines_refused, check_refused};
use crate::program::{Place, keys, number};

/// A test stand that reads the HAKUTO wheel on Toyoura sand, 12 settings three times each.
pub(crate) fn simulate() -> &'static str {
    "wheel-test --load-n 20 --slip-ratio -0.6:0.6:0.24 --slip-angle-deg 0,15 --trials 3"
}

/// The same wheel and sand against a file to be named.
pub(crate) const JUDGE: &str = "validate --wheel hakuto --soil toyoura";

/// A folder with `test.csv`, as the simulated stand writes it.
fn with_test() -> Place {
    let place = Place::new();
    place.write("test.csv", place.results(&format!("{} --format csv", simulate())));
    place
}

// ---- One file ----

#[test]
fn errors_have_the_words_of_the_design() {
    let place = with_test();
    let json = place.json(&format!("{JUDGE} --data test.csv"));
    assert_eq!(json["schema"], "grouser.validate.v1");
    let inputs = &json["inputs"];
    assert_eq!((&inputs["data"], &inputs["model"]), (&"test.csv".into(), &"ishigami".into()));
    let rows = json["rows"].as_array().expect("rows");
    let groups: Vec<_> =
        rows.iter().map(|row| (number(&row["slip_angle_deg"]), &row["motion"])).collect();
    let motion = |word: &str| Value::from(word);
    assert_eq!(
        groups,
        [
            (0.0, &motion("driven")),
            (0.0, &motion("skid")),
            (15.0, &motion("driven")),
            (15.0, &motion("skid"))
        ]
    );
    for row in rows.iter().chain([&json["overall"], &json["driven"], &json["skid"]]) {
        for quantity in ["drawbar_pull_n", "side_force_n", "sinkage_mm", "torque_nm"] {
            let errors = &row[quantity];
            assert_eq!(
                keys(errors),
                [
                    "rmse",
                    "bias",
                    "r2",
                    "repeatability",
                    "cells",
                    "largest_measured",
                    "rmse_share",
                    "bias_share",
                    "aim",
                    "within_aim"
                ]
            );
            assert!(errors["rmse"].is_number() && errors["r2"].is_number(), "{quantity}: {row}");
        }
    }
    let overall = &json["overall"];
    assert!(overall["slip_angle_deg"].is_null() && overall["motion"] == "all");
    assert_eq!((&overall["cells"], &overall["trials"]), (&12.into(), &36.into()));
    assert_eq!(json["cells"].as_array().map(Vec::len), Some(12));
}

/// The mean of three readings is off by a third of their variance: rmse ≈ repeatability/√3. Over
/// 12 cells both scatter by some 20 and 15 percent; twice that and more is allowed.
#[test]
fn the_truth_agrees_as_well_as_the_stand_with_itself() {
    let place = with_test();
    let json = place.json(&format!("{JUDGE} --data test.csv"));
    for (quantity, noise) in
        [("drawbar_pull_n", 0.3), ("side_force_n", 0.3), ("sinkage_mm", 0.5), ("torque_nm", 0.02)]
    {
        let errors = &json["overall"][quantity];
        let (rmse, itself) = (number(&errors["rmse"]), number(&errors["repeatability"]));
        assert!((0.6..1.4).contains(&(itself / noise)), "{quantity}: {errors}");
        assert!((0.5..1.6).contains(&(rmse / noise * 3.0_f64.sqrt())), "{quantity}: {errors}");
    }
    let wrong = place.json("validate --wheel hakuto --soil lunar-nominal --data test.csv");
    let rmse = |json: &Value| number(&json["overall"]["sinkage_mm"]["rmse"]);
    assert!(rmse(&wrong) > 5.0 * rmse(&json));
}

#[test]
fn a_file_of_wheel_test_is_read_without_a_word() {
    let place = Place::new();
    let line = "wheel-test --load-n 10,20 --slip-ratio -0.4,0.2 --slip-angle-deg -15,15";
    place.write("test.csv", place.results(&format!("{line} --format csv")));
    let json = place.json(&format!("{JUDGE} --data test.csv"));
    for quantity in ["drawbar_pull_n", "side_force_n", "sinkage_mm", "torque_nm"] {
        // The file has every digit; the creep of the speeds takes another way.
        assert!(number(&json["overall"][quantity]["rmse"]) < 1e-6, "{quantity}");
    }
}

#[test]
fn rows_that_did_not_settle_are_left_out_and_told() {
    let place = Place::new();
    let line = "wheel-test --load-n 20,1e5 --slip-ratio 0.2,0.4 --format csv";
    place.write("test.csv", place.results(line));
    let answer = place.line(&format!("{JUDGE} --data test.csv --format json"));
    assert_eq!(answer.code(), 0);
    assert!(answer.stderr.starts_with("note: 2 rows are left out"), "{}", answer.stderr);
    let json: Value = serde_json::from_str(&answer.stdout).expect("JSON");
    assert_eq!(json["overall"]["cells"], 2);
}

#[test]
fn validations_as_tables_and_csv() {
    let place = with_test();
    let answer = place.line(&format!("{JUDGE} --data test.csv"));
    assert_snapshot!("validate", answer.conversation());
    let csv = place.results(&format!("{JUDGE} --data test.csv --format csv"));
    let mut lines = csv.lines();
    assert_eq!(
        lines.next(),
        Some(
            "slip_angle_deg,motion,quantity,cells,unsettled_trials,rmse,bias,r2,repeatability,\
             largest_measured,rmse_share,bias_share,aim,within_aim,yardstick"
        )
    );
    // 4 groups, driven, skid and all, and 3 yardsticks, of 4 quantities.
    assert_eq!(lines.count(), (7 + 3) * 4);
}

#[test]
fn rows_are_chosen_by_their_columns() {
    let place = with_test();
    let cells = |conditions: &str| {
        let json = place.json(&format!("{JUDGE} --data test.csv {conditions}"));
        number(&json["overall"]["cells"])
    };
    assert_eq!(cells("--where slip_angle_deg=15"), 6.0);
    assert_eq!(cells("--where slip_angle_deg!=15 --where slip_ratio=0.6,-0.6"), 2.0);
    assert_eq!(cells("--where trial=2"), 12.0);
}

#[test]
fn a_validation_is_repeated_from_its_folder() {
    let place = with_test();
    let printed = place.results(&format!(
        "{JUDGE} --data test.csv --set soil.cohesion_kpa=0.3 --gravity-m-s2 9.8 --format json \
         --out run"
    ));
    assert_eq!(printed, place.read("run/validation.json"));
    let again = place.json(
        "validate --data test.csv --wheel run/wheel.toml --soil run/soil.toml --gravity-m-s2 9.8",
    );
    let first: Value = serde_json::from_str(&printed).expect("JSON");
    assert_eq!(first["rows"], again["rows"]);
    let trials = place.read("run/trials.csv");
    assert_eq!(trials.lines().count(), 1 + 36);
    assert_eq!(place.read("run/cells.csv").lines().count(), 1 + 12);
    assert_eq!(place.read("run/validation.csv").lines().count(), 1 + (7 + 3) * 4);
    for name in ["drawbar-pull", "side-force", "sinkage", "torque"] {
        for file in [format!("{name}.svg"), format!("{name}-residuals.svg")] {
            let svg = place.read(&format!("run/figures/{file}"));
            assert!(svg.contains("<svg") && svg.trim_end().ends_with("</svg>"), "{file}");
        }
    }
    let html = place.read("run/report.html");
    assert!(
        html.contains("Root mean square errors of the model") && html.matches("<svg").count() == 8,
        "{html}"
    );
    assert!(!html.contains("<script") && !html.contains(" src="));
    let files = std::fs::read_dir(place.file("run")).expect("a folder").count();
    assert_eq!(files, 8);
}

/// A theory that has no answer for a trial says so, and is not excused.
#[test]
fn trials_without_a_prediction_are_counted() {
    let place = Place::new();
    place.write("test.csv", "slip_ratio,load_n,drawbar_pull_n\n0.2,20,2\n0.4,90000,2\n");
    let json = place.json(&format!("{JUDGE} --data test.csv"));
    assert_eq!(json["overall"]["unsettled_trials"], 1);
    let answer = place.line(&format!("{JUDGE} --data test.csv"));
    assert_snapshot!("validate-without-prediction", answer.conversation());
}

// ---- What is wrong with files and flags ----

#[test]
fn wrong_validations() {
    let place = with_test();
    place.write("two.csv", "wheel,slip_ratio,load_n,torque_nm\nbars,0,20,1\nsmooth,0,20,1\n");
    check_lines_refused(
        "validations",
        &place,
        &[
            "validate",
            "validate --data test.csv",
            "validate --data test.csv --wheel hakuto",
            "validate --wheel hakuto --soil toyoura",
            "validate --data none.csv --wheel hakuto --soil toyoura",
            "validate --data cmu-single-weel --wheel hakuto --soil toyoura",
            "validate --data stand --wheel hakuto --soil toyoura",
            "validate --data cmu-single-wheel --wheel hakuto --soil toyoura",
            "validate --data . --wheel hakuto --soil toyoura",
            "validate --data test.csv --wheel hakutto --soil toyoura",
            "validate --data test.csv --wheel hakuto --soil toyora",
            "validate --data test.csv --wheel hakuto --soil toyoura --model bekkr",
            "validate --data test.csv --wheel hakuto --soil toyoura --set rover.body.mass_kg=1",
            "validate --data test.csv --wheel hakuto --soil toyoura --where slip_angle_deg",
            "validate --data test.csv --wheel hakuto --soil toyoura --where slip_angle=0",
            "validate --data test.csv --wheel hakuto --soil toyoura --where slip_angle_deg=7",
            "validate --data two.csv --wheel hakuto --soil toyoura",
            "validate --data test.csv --soil toyoura",
            "validate --data cmu-single-wheel --model rft",
            "validate --data test.csv --wheel hakuto --rover hakuto --soil toyoura",
            "validate --data test.csv --rover hakuto --soil toyoura",
            "validate --data viper-slip-slope --rover mgru3 --soil grc-1 --set \
             scenario.slope_deg=3",
            "validate --data test.csv --all",
            "validate --all --data-dir none",
            "validate --all --data-dir .",
            "validate --all --data-dir . --model bekker",
            "validate --all --data-dir . --where trial=1",
            "validate --data-dir .",
        ],
    );
}

#[test]
fn broken_measurement_files() {
    let place = Place::new();
    let header = "slip_ratio,slip_angle_deg,load_n,sinkage_mm\n";
    for (file, content) in [
        ("a-missing-load", "slip_ratio,sinkage_mm\n0.1,5\n".to_owned()),
        ("a-missing-slip", "load_n,sinkage_mm\n20,5\n".to_owned()),
        ("a-missing-reading", "slip_ratio,load_n\n0.1,20\n".to_owned()),
        ("a-misspelt-load", "slip_ratio,load_N,sinkage_mm\n0.1,20,5\n".to_owned()),
        ("a-slip-in-percent", format!("{header}20,0,20,5\n")),
        ("a-sinkage-in-micrometres", format!("{header}0.2,0,20,5000\n")),
        ("an-angle-too-large", format!("{header}0.2,150,20,5\n")),
        ("a-negative-load", format!("{header}0.2,15,-20,5\n")),
        ("two-loads", "slip_ratio,load_n,normal_force_n,sinkage_mm\n0.1,20,24,5\n".to_owned()),
        ("a-word", format!("{header}0.2,15,20,5\n0.2,15,heavy,5\n")),
        ("a-decimal-comma", format!("{header}\"0,2\",15,20,5\n")),
        ("nan", format!("{header}0.2,15,nan,5\n")),
        ("infinite", format!("{header}0.2,15,inf,5\n")),
        ("a-short-row", format!("{header}0.2,15,20\n")),
        ("semicolons", "slip_ratio;load_n;sinkage_mm\n0.1;20;5\n".to_owned()),
        ("header-twice", format!("{header}0.2,15,20,5\n{header}0.2,15,20,5\n")),
        ("column-twice", "slip_ratio,load_n,load_n,sinkage_mm\n0.1,20,20,5\n".to_owned()),
        ("header-alone", header.to_owned()),
        ("empty", String::new()),
        ("no-row-ok", "slip_ratio,load_n,sinkage_mm,status\n0.1,20,5,stuck\n".to_owned()),
        (
            "slip-against-speeds",
            "slip_ratio,travel_speed_mm_s,rim_speed_mm_s,load_n,sinkage_mm\n0.5,10,12,20,5\n"
                .to_owned(),
        ),
    ] {
        place.write(&format!("{file}.csv"), content);
    }
    place.write("binary.csv", [0x7f, b'E', b'L', b'F', 0, 0xff, 0xfe]);
    place.write("latin-1.csv", b"slip_ratio,load_n,sinkage_mm,by\n0.1,20,5,J\xfcrgen\n");
    let names = place.names();
    let lines: Vec<Vec<&str>> = names
        .iter()
        .map(|name| JUDGE.split(' ').chain(["--data", name.as_str()]).collect())
        .collect();
    let lines: Vec<&[&str]> = lines.iter().map(Vec::as_slice).collect();
    check_refused("measurement-files", &place, &lines);
}

/// What is odd but readable is told beside the result.
#[test]
fn odd_measurement_files_are_read_with_notes() {
    let place = Place::new();
    let header = "slip_ratio,slip_angle_deg,load_n,drawbar_pull_n,sinkage_mm";
    place.write("one-row.csv", format!("{header}\n0.2,0,20,2,12\n"));
    place.write("radians.csv", format!("{header}\n0.2,0.26,20,2,12\n0.2,0.52,20,2,12\n"));
    place.write("grams.csv", format!("{header}\n0.2,15,20,200,12\n"));
    place.write("metres.csv", format!("{header}\n0.2,15,20,2,0.012\n"));
    place.write("misspelt.csv", format!("{header},torque_Nm,operator\n0.2,15,20,2,12,0.4,me\n"));
    place.write("byte-order-mark.csv", format!("\u{feff}{header}\r\n0.2,15,20,2,12\r\n"));
    let answers = place.names().into_iter().map(|name| {
        let answer = place.line(&format!("{JUDGE} --data {name}"));
        assert_eq!(answer.code(), 0, "{name}: {}", answer.stderr);
        format!("{name}\n{}", answer.stderr)
    });
    assert_snapshot!("odd-measurement-files", answers.collect::<Vec<_>>().join("\n"));
}

// ---- Every theory on every data set ----

const DATA_SET: &str = "schema = \"data-set/1\"\nname = \"Our stand\"\nsource = \"simulated\"\n\
                        file = \"test.csv\"\n\n[[case]]\nname = \"level\"\nwheel = \"hakuto\"\n\
                        where = [\"slip_angle_deg=0\"]\nsoils = [\"lunar-nominal\", \"toyoura\"]\n\n\
                        [[case]]\nname = \"askew\"\nwheel = \"hakuto\"\n\
                        where = [\"slip_angle_deg=15\"]\nsoils = [\"sand.toml\"]\n";

/// A folder `lab` with a data set of our own.
fn with_data_set() -> Place {
    let place = Place::new();
    std::fs::create_dir(place.file("lab")).expect("it can be made");
    place.write("lab/test.csv", place.results(&format!("{} --format csv", simulate())));
    place.write("lab/set.toml", DATA_SET);
    let soil = place.results("presets toyoura");
    place.write("lab/sand.toml", soil);
    place
}

#[test]
fn every_theory_is_ranked_on_a_data_set_of_ones_own() {
    let place = with_data_set();
    let json = place.json("validate --all --data-dir lab");
    assert_eq!(json["schema"], "grouser.validate.v1");
    assert_eq!(json["inputs"]["data_sets"], serde_json::json!(["Our stand"]));
    let rows = json["rows"].as_array().expect("rows");
    for row in rows {
        for word in ["data_set", "case", "rank", "model", "soil", "score", "overall", "driven"] {
            assert!(!row[word].is_null(), "{word} in {row}");
        }
    }
    let of_case =
        |case: &str| -> Vec<&Value> { rows.iter().filter(|row| row["case"] == case).collect() };
    let level = of_case("level");
    assert!(level.len() >= 4, "two soils, two theories or more: {}", level.len());
    assert_eq!((&level[0]["model"], &level[0]["soil"]), (&"ishigami".into(), &"toyoura".into()));
    let scores: Vec<f64> = level.iter().map(|row| number(&row["score"])).collect();
    // At 0° the side force is noise alone: its share of the score says nothing.
    assert!(scores.is_sorted() && scores[0] < 0.7 * scores[1], "{scores:?}");
    // A soil that names its theory is judged with that one alone.
    let askew = of_case("askew");
    assert_eq!((askew.len(), &askew[0]["model"]), (1, &"ishigami".into()));
}

#[test]
fn a_ranking_as_a_table_as_csv_and_in_a_folder() {
    let place = with_data_set();
    let table = place.line("validate --all --data-dir lab --out ranking");
    assert_eq!(table.code(), 0, "{}", table.stderr);
    assert_eq!(table.stdout, place.read("ranking/ranking.txt"));
    let csv = place.results("validate --all --data-dir lab --format csv");
    assert_eq!(csv, place.read("ranking/ranking.csv"));
    let header: Vec<&str> = csv.lines().next().expect("a header").split(',').collect();
    for column in ["data_set", "rank", "overall_sinkage_mm_rmse", "driven_torque_nm_r2"] {
        assert!(header.contains(&column), "{column}");
    }
    assert!(place.read("ranking/ranking.json").contains("grouser.validate.v1"));
    let svg = place.read("ranking/figures/our-stand-level-sinkage-residuals.svg");
    assert!(svg.contains("<svg"));
}

/// Without a folder those that come with the program are ranked: the theory that was fitted to them
/// comes first, and each case of each data set is there.
#[test]
fn without_a_folder_the_data_sets_of_the_program_are_ranked() {
    let place = with_data_set();
    let json = place.json("validate --all");
    assert_eq!(
        json["inputs"]["data_sets"],
        serde_json::json!([
            "CMU single wheel",
            "HAKUTO across slopes",
            "Published wheel tests",
            "VIPER rover up slopes, simulated"
        ])
    );
    let rows = json["rows"].as_array().expect("rows");
    let of_cmu = rows.iter().filter(|row| row["data_set"] == "CMU single wheel");
    let first = of_cmu.filter(|row| row["rank"] == 1);
    let best: Vec<[&Value; 3]> =
        first.map(|row| [&row["case"], &row["model"], &row["soil"]]).collect();
    assert_eq!(
        best,
        [
            ["smooth", "small-wheel", "cmu-direct90-smooth"],
            ["grousers", "small-wheel", "cmu-direct90-grouser"]
        ]
    );
    // Soils that were fitted to the rows count in no sum over the parts.
    for row in rows {
        let is_fitted = ["cmu-direct90-smooth", "cmu-direct90-grouser", "toyoura"]
            .iter()
            .any(|soil| row["soil"] == *soil);
        assert_eq!(row["in_sample"], is_fitted, "{row}");
    }
    let models = json["models"].as_array().expect("models");
    let rft = models.iter().find(|one| one["model"] == "rft").expect("it needs no fitted soil");
    assert_eq!((&rft["parts"], &rft["scores"][6]["score"]), (&6.into(), &Value::Null));
    check_sets(&json);
    let own = place.json("validate --all --data-dir lab");
    assert_eq!(own["inputs"]["data_sets"], serde_json::json!(["Our stand"]));
}

/// What scripts read of the band of all models on each set.
///
/// * `json`: a ranking
fn check_sets(json: &Value) {
    let sets = json["sets"].as_array().expect("sets");
    let case = |name: &str| sets.iter().find(|it| it["case"] == name).expect("it is there");
    assert_eq!(sets.len(), 7);
    for set in sets {
        assert!(number(&set["interval_score"]) > 0.0, "{set}");
        assert!(set["zero_pull_slip_measured"].is_null() || set["answers"][0]["kind"] != "yaw");
    }
    // A tenth in the radius would move it by a tenth.
    let viper = case("viper-trec-grc3");
    let [measured, predicted] =
        ["measured", "predicted"].map(|end| number(&viper[format!("zero_pull_slip_{end}")]));
    assert!((measured - 0.007).abs() < 0.001 && (measured - predicted).abs() < 0.03, "{viper}");
    assert_eq!(viper["zero_pull_is_doubtful"], false);
    assert!(case("mgru3-grc1")["zero_pull_slip_measured"].is_null());
}

/// A data set by its name alone: every model, with the published soils, and no physics beside them.
#[test]
fn a_data_set_alone_ranks_every_model_on_it() {
    let place = with_data_set();
    let json = place.json("validate --data published-wheel-tests");
    assert_eq!(json["inputs"]["data_sets"], serde_json::json!(["Published wheel tests"]));
    let rows = json["rows"].as_array().expect("rows");
    let quantities = ["drawbar_pull_n", "side_force_n", "sinkage_mm", "torque_nm"];
    for (case, measured) in [
        ("ding-2011-smooth", [true, false, true, true]),
        ("rashid-fjs1", [true, false, true, false]),
        ("viper-trec-grc3", [true, false, false, false]),
    ] {
        let models: Vec<&Value> = rows.iter().filter(|row| row["case"] == case).collect();
        assert!(models.len() >= 3, "{case}");
        let yardsticks = json["yardsticks"].as_array().expect("yardsticks").iter();
        let yardsticks: Vec<&Value> = yardsticks.filter(|row| row["case"] == case).collect();
        let names: Vec<&Value> = yardsticks.iter().map(|row| &row["yardstick"]).collect();
        assert_eq!(
            names,
            ["mean", "interpolation"],
            "one slip angle leaves none to predict it from"
        );
        assert!((number(&yardsticks[0]["score"]) - 1.0).abs() < 1e-12);
        for row in models.iter().chain(&yardsticks) {
            for (quantity, is_measured) in quantities.iter().zip(measured) {
                let errors = &row["overall"][quantity];
                assert_eq!(errors.is_object(), is_measured, "{case}, {quantity}");
                if is_measured {
                    let share = number(&errors["rmse"]) / number(&errors["largest_measured"]);
                    assert!((number(&errors["rmse_share"]) - share).abs() < 1e-12);
                    let is_met = number(&errors["rmse"]) <= number(&errors["aim"]);
                    assert_eq!(errors["within_aim"], is_met, "{case}, {quantity}");
                }
            }
        }
    }
    let text = place.results("validate --data published-wheel-tests");
    assert!(
        text.contains("torque_nm") && text.contains(" within") && text.contains(" miss"),
        "{text}"
    );
    let own = place.json("validate --data lab/set.toml");
    assert_eq!(own["rows"], place.json("validate --all --data-dir lab")["rows"]);
}

// ---- A rover on slopes ----

const CLIMBS: &str = "slope_deg,course_deg,slip_ratio,trial\n0,90,0.05,1\n10,90,0.2,1\n10,90,0.3,2\n\
                      45,90,0.9,1\n";

/// Repeated rows are averaged; where no heading holds the course uphill, the slip counts as 1.
#[test]
fn a_rovers_own_slip_on_slopes_is_compared() {
    let place = Place::new();
    place.write("climbs.csv", CLIMBS);
    let judge = "validate --data climbs.csv --rover hakuto --soil toyoura";
    let json = place.json(&format!("{judge} --out run"));
    assert_eq!(json["schema"], "grouser.validate.v1");
    let rows = json["rows"].as_array().expect("rows");
    let slopes: Vec<f64> = rows.iter().map(|row| number(&row["slope_deg"])).collect();
    assert_eq!(slopes, [0.0, 10.0, 45.0]);
    let map =
        place.json("heading-map --rover hakuto --soil toyoura --slope-deg 0,10 --course-deg 90");
    for (row, held) in rows.iter().zip(map["rows"].as_array().expect("rows")) {
        assert_eq!(row["slip_ratio"], held["slip_ratio"], "as the heading map has it");
    }
    assert_eq!((&rows[1]["measured_slip_ratio"], &rows[1]["trials"]), (&0.25.into(), &2.into()));
    assert_eq!(rows[2]["slip_ratio"], 1.0);
    assert!(rows[2]["status"].as_str().is_some_and(|why| why.starts_with("ground-strength")));
    let overall = &json["overall"];
    assert_eq!((&overall["cells"], &overall["not_held"]), (&3.into(), &1.into()));
    let errors =
        rows.iter().map(|row| number(&row["slip_ratio"]) - number(&row["measured_slip_ratio"]));
    let bias = errors.sum::<f64>() / 3.0;
    assert!((number(&overall["slip_ratio"]["bias"]) - bias).abs() < 1e-12);
    assert!(overall["yaw_deg"].is_null() && overall["sinkage_mm"].is_null());
    let csv = place.results(&format!("{judge} --format csv"));
    assert_eq!(csv, place.read("run/validation.csv"));
    assert!(csv.starts_with("slope_deg,course_deg,trials,measured_slip_ratio,"), "{csv}");
    let text = place.line(judge);
    assert_snapshot!("validate-slopes", text.conversation());
    assert!(place.read("run/figures/slip-ratio.svg").contains("<svg"));
    let again =
        place.json("validate --data climbs.csv --rover hakuto --soil toyoura --where trial=1");
    assert_eq!(again["rows"][1]["measured_slip_ratio"], 0.2);
}

/// A slope without a prediction is in no error of the model, but in those of the yardsticks.
#[test]
fn slopes_without_a_prediction_are_counted() {
    let place = Place::new();
    place.write("yaws.csv", "slope_deg,course_deg,yaw_deg\n5,0,2\n10,0,4.5\n25,0,20\n");
    let judge = "validate --data yaws.csv --rover hakuto --soil toyoura";
    let json = place.json(judge);
    assert_eq!(json["overall"]["no_prediction"], 1);
    assert_eq!(json["overall"]["yaw_deg"]["cells"], 2);
    assert_eq!(json["yardsticks"][0]["overall"]["no_prediction"], 0);
    assert_eq!(json["yardsticks"][0]["overall"]["yaw_deg"]["cells"], 3);
    let text = place.results(judge);
    let row = |name: &str| {
        let line = text.lines().find(|line| line.starts_with(name)).expect("a row");
        line.split_whitespace().take(4).map(str::to_owned).collect::<Vec<_>>()
    };
    assert!(text.contains("slopes  no prediction"), "{text}");
    assert_eq!(row("model "), ["model", "yaw_deg", "2", "1"]);
    assert_eq!(row("mean "), ["mean", "yaw_deg", "3", "0"]);
    assert!(text.contains("1 of 3 slopes have no prediction"), "{text}");
    // Nothing at all is predicted: the row is there, without errors.
    place.write("yaws.csv", "slope_deg,course_deg,yaw_deg\n25,0,15\n30,0,20\n");
    let text = place.results(judge);
    let line = text.lines().find(|line| line.starts_with("model ")).expect("a row");
    let cells: Vec<&str> = line.split_whitespace().collect();
    assert_eq!(cells, ["model", "yaw_deg", "0", "2", "-", "-", "-", "-"]);
}

/// Bands are no measurements, and are known.
#[test]
fn bands_beside_results_are_passed_over_in_silence() {
    let place = Place::new();
    let line = "wheel-test --slip-ratio 0.1,0.3 --uncertainty --samples 3 --format csv";
    let csv = place.results(line);
    place.write("bands.csv", &csv);
    let judged = place.results(&format!("{JUDGE} --data bands.csv"));
    assert!(judged.starts_with("drawbar_pull_n\n"), "{judged}");
    // Another's column is asked about.
    place.write("bands.csv", csv.replacen("sinkage_mm_p2_5", "sinkage_mm_p5", 1));
    let answer = place.line(&format!("{JUDGE} --data bands.csv"));
    assert_eq!(answer.stderr.matches("note: ").count(), 1, "{}", answer.stderr);
    assert!(answer.stderr.contains("`sinkage_mm_p5`"), "{}", answer.stderr);
}

/// Slip by the rim without grousers is that of the same motion, seen from their tips.
#[test]
fn slip_without_grousers_is_converted() {
    let place = Place::new();
    place.write("rim.csv", "slope_deg,slip_ratio_without_grousers\n5,0.12\n");
    let json = place.json("validate --data rim.csv --rover hakuto --soil toyoura");
    let tips = 1.0 - 0.88 * 0.10 / 0.11;
    assert!((number(&json["rows"][0]["measured_slip_ratio"]) - tips).abs() < 1e-12);
    assert_eq!(json["rows"][0]["course_deg"], 90.0);
}

#[test]
fn broken_slope_files() {
    let place = Place::new();
    for (file, content) in [
        ("no-slope", "slip_ratio\n0.1\n"),
        ("misspelt-slope", "slope_dge,slip_ratio\n5,0.1\n"),
        ("no-reading", "slope_deg,course_deg\n5,90\n"),
        ("empty-readings", "slope_deg,slip_ratio,yaw_deg\n5,,nan\n"),
        ("two-slips", "slope_deg,slip_ratio,slip_ratio_without_grousers\n5,0.1,0.1\n"),
        ("percent", "slope_deg,slip_ratio\n5,10\n"),
        ("too-steep", "slope_deg,slip_ratio\n75,0.1\n"),
        ("course", "slope_deg,course_deg,slip_ratio\n5,120,0.1\n"),
        ("a-word", "slope_deg,slip_ratio\n5,little\n"),
        ("slope-missing", "slope_deg,slip_ratio\n,0.1\n"),
        ("infinite", "slope_deg,slip_ratio\n5,inf\n"),
        ("header-alone", "slope_deg,slip_ratio\n"),
        ("header-twice", "slope_deg,slip_ratio\nslope_deg,slip_ratio\n5,0.1\n"),
        ("column-twice", "slope_deg,slope_deg,slip_ratio\n5,5,0.1\n"),
        ("not-ok", "slope_deg,slip_ratio,status\n5,0.1,stuck\n"),
        ("nothing", ""),
    ] {
        place.write(&format!("{file}.csv"), content);
    }
    let names = place.names();
    let judge = "validate --rover hakuto --soil toyoura";
    let lines: Vec<Vec<&str>> = names
        .iter()
        .map(|name| judge.split(' ').chain(["--data", name.as_str()]).collect())
        .collect();
    let lines: Vec<&[&str]> = lines.iter().map(Vec::as_slice).collect();
    check_refused("slope-files", &place, &lines);
}

/// A copy of the file of a data set of the program is ranked as that data set; where a document in
/// the folder claims the file, once and as the document says.
#[test]
fn a_copy_of_the_programs_file_is_ranked_once() {
    let place = with_data_set();
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../grouser-io/data/measurements");
    let rows = std::fs::read(format!("{data}/cmu_single_wheel.csv")).expect("it is there");
    place.write("lab/cmu_single_wheel.csv", rows);
    let both = place.json("validate --all --data-dir lab");
    let names = serde_json::json!(["CMU single wheel", "Our stand"]);
    assert_eq!(both["inputs"]["data_sets"], names);
    let document = place.results("presets cmu-single-wheel");
    place.write("lab/cmu.toml", document.replace("CMU single wheel", "Theirs"));
    let claimed = place.json("validate --all --data-dir lab");
    assert_eq!(claimed["inputs"]["data_sets"], serde_json::json!(["Our stand", "Theirs"]));
}

/// A data set of the program by its name, and its file by a path, are the same rows; the name goes
/// before a file that is called so.
#[test]
fn a_data_set_of_the_program_is_found_by_its_name() {
    let place = Place::new();
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../grouser-io/data/measurements");
    let rows = std::fs::read(format!("{data}/cmu_single_wheel.csv")).expect("it is there");
    place.write("rows.csv", rows);
    place.write("cmu-single-wheel", "not measurements");
    let judge = "validate --wheel cmu-smooth --soil direct-90 --where slip_angle_deg=0 --data";
    let json = |data: &str| -> Value {
        let answer = place.line(&format!("{judge} {data} --format json"));
        assert!(answer.stderr.starts_with("note: `side_force_n`"), "{}", answer.stderr);
        serde_json::from_str(&answer.stdout).expect("JSON")
    };
    let (mut by_name, by_path) = (json("cmu-single-wheel"), json("rows.csv"));
    assert_eq!(by_name["inputs"]["data"], "cmu-single-wheel");
    by_name["inputs"]["data"] = "rows.csv".into();
    by_name["inputs"]["files"][0]["file"] = "rows.csv".into();
    assert_eq!(by_name, by_path);
    let wrong = place.line(&format!("{judge} ./cmu-single-wheel"));
    assert_eq!(wrong.code(), 2, "{}", wrong.stdout);
}

#[test]
fn wrong_data_sets() {
    let place = Place::new();
    let test = place.results(&format!("{} --format csv", simulate()));
    let sets = [
        ("no-file", "test.csv", "tset.csv"),
        ("no-soil", "\"toyoura\"", "\"toyora\""),
        ("no-wheel", "wheel = \"hakuto\"", "wheel = \"mine.toml\""),
        ("no-condition", "slip_angle_deg=0", "slip_angle_deg"),
        ("no-column", "slip_angle_deg=0", "slip_angel_deg=0"),
        ("no-row", "slip_angle_deg=0", "slip_angle_deg=7"),
        ("misspelt", "soils =", "soil ="),
        ("gravity", "file =", "gravity_m_s2 = 0\nfile ="),
        ("both", "wheel = \"hakuto\"", "wheel = \"hakuto\"\nrover = \"hakuto\""),
        ("neither", "wheel = \"hakuto\"\n", ""),
        ("no-rover", "wheel = \"hakuto\"", "rover = \"hakutto\""),
        ("rows-of-wheels", "wheel = \"hakuto\"", "rover = \"hakuto\""),
        ("fitted", "soils = [\"sand.toml\"]", "soils = [\"sand.toml\"]\nfitted = [\"toyoura\"]"),
        ("no-schema", "schema =", "# schema ="),
    ];
    for (folder, from, to) in sets {
        std::fs::create_dir(place.file(folder)).expect("it can be made");
        let set = DATA_SET.replacen(from, to, 1);
        assert_ne!(set, DATA_SET, "{folder}");
        place.write(&format!("{folder}/test.csv"), &test);
        place.write(&format!("{folder}/sand.toml"), place.results("presets toyoura"));
        place.write(&format!("{folder}/set.toml"), set);
    }
    let lines = sets.map(|(folder, ..)| format!("validate --all --data-dir {folder}"));
    check_lines_refused("data-sets", &place, &lines.each_ref().map(String::as_str));
}

#[test]
fn a_data_set_is_a_document_like_any_other() {
    let place = with_data_set();
    let answer = place.line("check lab/set.toml");
    assert_eq!((answer.code(), answer.stderr.as_str()), (0, ""), "{}", answer.stdout);
    assert!(place.results("presets cmu-single-wheel").contains("data-set/1"));
    let schema: Value = serde_json::from_str(&place.results("schema data-set")).expect("JSON");
    assert!(schema["properties"]["case"].is_object());
}

// ---- Disks and signals ----

#[cfg(unix)]
#[test]
fn a_full_disk_leaves_no_validation() {
    let place = with_test();
    let answer = place.shell(&format!("ulimit -f 1; grouser {JUDGE} --data test.csv --out a/b"));
    assert_eq!(answer.code(), 1, "{}", answer.stderr);
    assert!(answer.stderr.starts_with("error: cannot write "), "{}", answer.stderr);
    assert_eq!(place.names(), ["test.csv"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_cannot_be_made_is_the_disks_fault() {
    let place = with_test();
    let answer = place.line(&format!("{JUDGE} --data test.csv --out test.csv/below"));
    check_is_refusal(&answer, 1);
    assert_eq!(place.names(), ["test.csv"]);
}

#[cfg(unix)]
#[test]
fn an_interrupted_validation_is_whole_or_not_there() {
    use std::process::{Command, Stdio};
    let place = Place::new();
    let rows: String = (0..60_000).map(|row| format!("0.{row:05},20,5\n")).collect();
    place.write("test.csv", format!("slip_ratio,load_n,sinkage_mm\n{rows}"));
    for moment in [0, 100, 400] {
        let line = format!("{JUDGE} --data test.csv --out run");
        let mut command = place.command(&line.split(' ').collect::<Vec<_>>());
        let mut child =
            command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts");
        std::thread::sleep(std::time::Duration::from_millis(moment));
        if child.try_wait().expect("it can be asked").is_none() {
            let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
            assert!(sent.expect("there is a kill").success());
        }
        let code = child.wait().expect("it ends").code();
        let names = place.names();
        match code {
            Some(0) => assert_eq!(names, ["run", "test.csv"]),
            // `None`: before its first line, when it had no handler yet.
            Some(130) | None => assert_eq!(names, ["test.csv"]),
            code => panic!("{code:?}"),
        }
        if code == Some(0) {
            break;
        }
    }
}
