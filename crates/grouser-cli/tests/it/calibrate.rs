//! `calibrate`: a known truth is found, said and kept; a run that was killed goes on.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use serde_json::Value;

use crate::bad_input::{check_is_refusal, check_lines_refused};
use crate::program::{Place, number};

/// A test stand that reads the HAKUTO wheel on Toyoura sand: 8 settings three times each.
const STAND: &str =
    "wheel-test --load-n 20 --slip-ratio 0:0.6:0.2 --slip-angle-deg 0,15 --trials 3 --format csv";

/// Two keys of that sand, searched from elsewhere.
const FIT: &str = "calibrate --data test.csv --wheel hakuto --soil toyoura \
                   --set soil.shear.longitudinal_m=0.1 --set soil.pressure_sinkage.k_phi=60 \
                   --fit soil.pressure_sinkage.k_phi,soil.shear.longitudinal_m";

/// What Toyoura's document says of them.
const TRUTH: [f64; 2] = [122.727, 0.036];

fn with_test() -> Place {
    let place = Place::new();
    place.write("test.csv", place.results(STAND));
    place
}

fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}

fn json(place: &Place, line: &str) -> Value {
    let line = format!("{line} --format json");
    let answer = place.run(&words(&line));
    assert_eq!(answer.code(), 0, "{}", answer.conversation());
    serde_json::from_str(&answer.stdout).expect("it is JSON")
}

/// Four standard deviations: one try in ten thousand misses by more. The noise is seeded.
#[test]
fn the_truth_is_found_within_its_uncertainty() {
    let place = with_test();
    let found = json(&place, &format!("{FIT} --steps 100"));
    assert_eq!(found["schema"], "grouser.calibrate.v1");
    let rows = found["rows"].as_array().expect("rows");
    let keys = ["soil.pressure_sinkage.k_phi", "soil.shear.longitudinal_m"];
    for ((row, key), truth) in rows.iter().zip(keys).zip(TRUTH) {
        assert_eq!(row["key"], key);
        let (fit, std) = (number(&row["fit"]), number(&row["fit_std"]));
        assert!((fit - truth).abs() < 4.0 * std && std < 0.2 * truth, "{row}");
        let (low, high) = (number(&row["p2_5"]), number(&row["p97_5"]));
        assert!(low < number(&row["p50"]) && number(&row["p50"]) < high);
        assert!((low - 2.0 * std..high + 2.0 * std).contains(&truth), "{row}");
    }
    assert_eq!(found["unidentifiable"], Value::Array(Vec::new()));
    assert_eq!(found["proposals"].as_array().map(Vec::len), Some(3));
    for proposal in found["proposals"].as_array().expect("proposals") {
        assert!(number(&proposal["std_after"]) < number(&proposal["std_before"]));
    }
}

/// A data set of the program by its name, and its file by a path, give the same soil.
#[test]
fn a_data_set_of_the_program_is_fitted_by_its_name() {
    let place = Place::new();
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../grouser-io/data/measurements");
    fs::copy(format!("{data}/cmu_single_wheel.csv"), place.file("rows.csv")).expect("it is there");
    let fit = "calibrate --wheel cmu-smooth --soil direct-90 --where slip_angle_deg=0 \
               --fit soil.shear.longitudinal_m --point-fit --data";
    let by_name = json(&place, &format!("{fit} cmu-single-wheel"));
    let by_path = json(&place, &format!("{fit} rows.csv"));
    assert_eq!(by_name["rows"], by_path["rows"]);
    let (inputs, of_path) = (&by_name["inputs"], &by_path["inputs"]);
    assert_eq!(
        (&inputs["data"], &of_path["data"]),
        (&"cmu-single-wheel".into(), &"rows.csv".into())
    );
    assert_eq!(inputs["data_fingerprint"], of_path["data_fingerprint"]);
}

/// Rows of another wheel: the discrepancy that the samples allow for leaves the least squares
/// outside of their interval, and a note says so.
#[test]
fn samples_that_contradict_the_least_squares_are_named() {
    let place = Place::new();
    let asked = "calibrate --data cmu-single-wheel --soil toyoura --fit soil.shear.longitudinal_m \
                 --where wheel=grouser --steps 100 --wheel";
    let wrong = place.line(&format!("{asked} hakuto"));
    let said =
        "soil.shear.longitudinal_m: the least-squares value, 0.06147, is outside the interval";
    assert!(wrong.stderr.contains(said), "{}", wrong.stderr);
    let truth = place.line(
        "calibrate --data cmu-single-wheel --soil cmu-direct90-grouser --wheel \
                            cmu-grouser --fit soil.shear.longitudinal_m --where slip_angle_deg=0 \
                            --steps 100",
    );
    assert!(truth.status.success() && !truth.stderr.contains("is outside"), "{}", truth.stderr);
}

#[test]
fn the_folder_holds_a_soil_that_other_commands_take() {
    let place = with_test();
    let found = json(&place, &format!("{FIT} --steps 100 --cross-validate --out fit"));
    let names = [
        "calibration.json",
        "figures",
        "parameters.csv",
        "report.html",
        "soil-samples.csv",
        "soil.toml",
        "start-soil.toml",
        "wheel.toml",
    ];
    let mut there: Vec<String> = fs::read_dir(place.file("fit"))
        .expect("it is there")
        .map(|entry| entry.expect("a name").file_name().to_string_lossy().into_owned())
        .collect();
    there.sort();
    assert_eq!(there, names);
    let soil = place.read("fit/soil.toml");
    assert!(soil.contains("fitted by Grouser") && soil.contains("test.csv"), "{soil}");
    assert!(soil.contains("soil-samples.csv"), "{soil}");
    let page = place.read("fit/report.html").replace("http://www.w3.org/", "");
    assert!(!page.contains("://") && !page.contains("<script"), "nothing is loaded from outside");
    assert_eq!(place.run(&["check", "fit/soil.toml", "fit/start-soil.toml"]).code(), 0);
    let judged = json(&place, "validate --data test.csv --wheel hakuto --soil fit/soil.toml");
    let rmse = |overall: &Value| number(&overall["drawbar_pull_n"]["rmse"]);
    assert!((rmse(&judged["overall"]) - rmse(&found["overall"])).abs() < 1e-9);
    // Every sample has what the model gets wrong, for each quantity that was read.
    let samples = place.read("fit/soil-samples.csv");
    let columns: Vec<&str> = samples.lines().next().expect("a header").split(',').collect();
    assert_eq!(columns.len(), 2 + 20 + 15 + 20 + 20);
    assert!(columns.contains(&"discrepancy.side_force.14"), "{columns:?}");
    assert!(soil.contains("[discrepancy]"), "{soil}");
    assert_eq!(found["correlation_lengths"].as_array().map(Vec::len), Some(2));
    for group in found["cross_validation"].as_array().expect("groups") {
        let pull = &group["drawbar_pull_n"];
        let (narrow, wide) = (number(&pull["coverage_50"]), number(&pull["coverage_95"]));
        assert!((0.0..=wide).contains(&narrow) && wide <= 1.0, "{group}");
        assert!(number(&pull["interval_score"]) > 0.0, "{group}");
    }
    assert_eq!(found["cross_validation_overall"]["motion"], "all");
    // Left out of the fit, an angle is predicted no better than with it, or little.
    assert_eq!(found["cross_validation"].as_array().map(Vec::len), Some(2));
    let band =
        json(&place, "attitude --soil fit/soil.toml --slope-deg 10 --uncertainty --samples 20");
    assert_eq!(
        band["rows"][0]["draws"].as_u64().or(band["rows"][0]["draws_level"].as_u64()),
        Some(20)
    );
}

/// The same bits for any number of threads, and after a kill half-way.
#[cfg(unix)]
#[test]
fn a_killed_run_goes_on_to_the_same_bits() {
    let place = with_test();
    let line = format!("{FIT} --steps 200");
    let whole = place
        .command(&words(&format!("{line} --out whole")))
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .expect("it starts");
    assert!(whole.status.success());
    let state = place.file("killed/unfinished-calibration");
    let asked = format!("{line} --out killed");
    let mut kills = 0;
    while !ends_before_it_keeps_more(&place, &asked, &state) {
        kills += 1;
        assert!(kills < 20, "it does not get on");
    }
    assert!(kills > 0, "it was never killed");
    assert!(!state.exists());
    for file in ["parameters.csv", "soil.toml", "soil-samples.csv", "report.html"] {
        assert_eq!(
            place.read(&format!("whole/{file}")),
            place.read(&format!("killed/{file}")),
            "{file}"
        );
    }
}

/// Runs until the state has changed, then kills; or until the end, if that comes first.
#[cfg(unix)]
fn ends_before_it_keeps_more(place: &Place, line: &str, state: &Path) -> bool {
    let changed = || fs::metadata(state).and_then(|it| it.modified()).ok();
    let before = changed();
    let mut command = place.command(&words(line));
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts");
    loop {
        if let Some(status) = child.try_wait().expect("it can be asked") {
            assert!(status.success());
            return true;
        }
        let now = changed();
        if now.is_some() && now != before {
            let sent = Command::new("kill").args(["-KILL", &child.id().to_string()]).status();
            assert!(sent.expect("there is a kill").success());
            child.wait().expect("it ends");
            return false;
        }
        std::thread::sleep(Duration::from_millis(2));
    }
}

#[test]
fn an_unfinished_run_with_other_inputs_is_not_gone_on_with() {
    let place = with_test();
    fs::create_dir(place.file("fit")).expect("a folder can be made");
    place.write("fit/unfinished-calibration", "not a state");
    let refused = place.run(&words(&format!("{FIT} --steps 100 --out fit")));
    let said = check_is_refusal(&refused, 2);
    assert!(said.contains("damaged") && said.contains("--force"), "{said}");
    assert_eq!(
        json(&place, &format!("{FIT} --steps 100 --out fit --force"))["rows"][0]["key"],
        "soil.pressure_sinkage.k_phi"
    );
    assert!(!place.file("fit/unfinished-calibration").exists());
}

/// A fit without samples would end as if it had finished what is unfinished.
#[test]
fn a_point_fit_leaves_an_unfinished_run_alone() {
    let place = with_test();
    fs::create_dir(place.file("fit")).expect("a folder can be made");
    place.write("fit/unfinished-calibration", "days of work");
    let line = format!("{FIT} --point-fit --out fit");
    let said = check_is_refusal(&place.run(&words(&line)), 2);
    assert!(said.contains("not empty"), "{said}");
    json(&place, &format!("{line} --force"));
    assert_eq!(place.read("fit/unfinished-calibration"), "days of work");
}

/// What samples cannot change is refused before they are drawn: with a million steps the sampling
/// would take hours.
#[test]
fn nothing_is_sampled_for_what_is_refused() {
    let place = with_test();
    fs::create_dir(place.file("old")).expect("a folder can be made");
    place.write("old/unfinished-calibration", "not a state");
    let line = format!("{FIT} --steps 999999");
    for (flags, part) in [
        ("--cross-validate --where slip_angle_deg=0", "at one"),
        ("--candidate-slip-angle-deg 0,400", "from -90 to 90"),
        ("--candidate-slip-ratio nan", "from -2 to 2"),
        ("--candidate-load-n -1", "from 0 to"),
        ("--candidate-slip-ratio 0:1:0.001", "at most"),
        ("--out old", "damaged"),
    ] {
        let said = check_is_refusal(&place.run(&words(&format!("{line} {flags}"))), 2);
        assert!(said.contains(part), "{flags}: {said}");
    }
}

/// Bekker's law from three plates without noise: p = (k_c/b + k_φ) zⁿ.
#[test]
fn plates_give_the_moduli_and_one_width_says_what_it_cannot() {
    let (k_c, k_phi, n) = (2.0e3, 8.0e5, 1.1);
    let curve = |width_mm: f64| -> String {
        (1..=8)
            .map(|step| {
                let sinkage_mm = 5.0 * f64::from(step);
                let pressure = (k_c / (width_mm * 1e-3) + k_phi) * (sinkage_mm * 1e-3_f64).powf(n);
                format!("{width_mm},{sinkage_mm},{}\n", pressure * 1e-3)
            })
            .collect()
    };
    let place = Place::new();
    let header = "plate_width_mm,sinkage_mm,pressure_kpa\n";
    let widths = [25.0, 50.0, 100.0].map(curve).concat();
    place.write("plates.csv", format!("{header}{widths}"));
    place.write("one.csv", format!("{header}{}", curve(50.0)));
    let line = "calibrate --soil dry-sand --plate-law bekker";
    let found = json(&place, &format!("{line} --plates plates.csv --point-fit"));
    for (row, truth) in found["rows"].as_array().expect("rows").iter().zip([k_c, k_phi, n]) {
        assert!((number(&row["fit"]) / truth - 1.0).abs() < 1e-3, "{row}");
    }
    let found = json(&place, &format!("{line} --plates one.csv --steps 100"));
    let open = found["unidentifiable"].to_string();
    assert!(open.contains("k_c"), "{open}");
    let answer = place.run(&words(&format!("{line} --plates plates.csv --steps 100 --out fit")));
    assert_eq!(answer.code(), 0, "{}", answer.conversation());
    assert_eq!(place.run(&["check", "fit/soil.toml"]).code(), 0);
}

/// τ = (c + σ tan φ)(1 − e^(−j/K)) without noise, after an import from other units: c 2 kPa, φ 30°,
/// K 10 mm.
#[test]
fn shear_tests_of_another_laboratory_give_their_soil() {
    let place = Place::new();
    let mut rows = vec!["sigma,j,tau".to_owned()];
    for sigma in [10.0, 20.0, 40.0] {
        for step in 1..=8 {
            let j_cm = 0.5 * f64::from(step);
            let strength = 2.0 + sigma * 30.0_f64.to_radians().tan();
            let tau = strength * (1.0 - (-j_cm).exp());
            rows.push(format!("{},{j_cm},{}", 1e-2 * sigma, 1e3 * tau));
        }
    }
    place.write("lab.csv", rows.join("\n"));
    let import = "import lab.csv --column normal_stress_kpa=sigma:bar --column \
                  shear_displacement_mm=j:cm --column shear_stress_kpa=tau:Pa --out shear.csv";
    let answer = place.run(&words(import));
    assert_eq!(answer.code(), 0, "{}", answer.conversation());
    let found = json(&place, "calibrate --soil dry-sand --shear shear.csv --point-fit");
    let rows = found["rows"].as_array().expect("rows");
    for (row, truth) in rows.iter().zip([2.0, 30.0, 0.01]) {
        assert!((number(&row["fit"]) / truth - 1.0).abs() < 1e-3, "{row}");
    }
    let answer =
        place.run(&words("calibrate --soil dry-sand --shear shear.csv --steps 100 --out fit"));
    assert_eq!(answer.code(), 0, "{}", answer.conversation());
    assert_eq!(place.run(&["check", "fit/soil.toml"]).code(), 0);
}

#[test]
fn what_cannot_be_fitted_is_refused() {
    let place = with_test();
    place.write("few.csv", "slip_ratio,load_n,sinkage_mm\n0.1,20,5\n");
    place.write("plates.csv", "plate_width_mm,sinkage_mm\n50,1\n");
    let stand = "calibrate --data test.csv --wheel hakuto --soil toyoura";
    check_lines_refused(
        "calibrate",
        &place,
        &[
            "calibrate --data test.csv --wheel hakuto --soil toyoura",
            "calibrate --soil toyoura",
            &format!("{stand} --fit cohesion_kpa"),
            &format!("{stand} --fit soil.cohesion"),
            &format!("{stand} --fit soil.bulldozing.law"),
            &format!("{stand} --fit soil.friction_angle_deg=50:60"),
            &format!("{stand} --fit soil.friction_angle_deg,soil.friction_angle_deg"),
            &format!("{stand} --fit soil.friction_angle_deg --target pull"),
            &format!("{stand} --fit soil.friction_angle_deg --target torque_nm:speed=1"),
            &format!("{stand} --fit soil.friction_angle_deg --steps 1"),
            "calibrate --data few.csv --wheel hakuto --soil toyoura --fit \
             soil.friction_angle_deg,soil.cohesion_kpa",
            "calibrate --plates plates.csv --soil toyoura",
            "calibrate --plates nowhere.csv --soil toyoura",
        ],
    );
}
