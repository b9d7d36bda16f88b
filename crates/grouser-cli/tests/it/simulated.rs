//! Simulated test stands: `wheel-test --trials`, and the file that was made so.

use crate::program::{Place, keys, number};

/// The command in the file's own description makes the file.
#[test]
fn the_simulated_experiment_is_fresh() {
    let folder = "../grouser/data/experiments/simulated-wheel-test";
    let read = |name: &str| {
        std::fs::read_to_string(format!("{folder}/{name}")).unwrap_or_else(|it| panic!("{it}"))
    };
    let readme = read("README.md").replace("\\\n", " ");
    let command = readme.lines().find_map(|line| line.strip_prefix("grouser wheel-test "));
    let (command, _) = command.and_then(|line| line.split_once('>')).expect("it has the command");
    let made = Place::new().results(&format!("wheel-test {command}"));
    assert_eq!(made, read("toyoura-20n.csv"), "stale: write what the command prints");
}

#[test]
fn a_stand_reads_less_than_the_theory_says() {
    let place = Place::new();
    let line = "wheel-test --slip-ratio 0,0.4 --slip-angle-deg 0,10 --trials 3 --seed 7";
    let json = place.json(line);
    let rows = json["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 2 * 2 * 3);
    let expected = [
        "load_n",
        "slip_angle_deg",
        "slip_ratio",
        "trial",
        "status",
        "sinkage_mm",
        "drawbar_pull_n",
        "side_force_n",
        "torque_nm",
    ];
    assert_eq!(keys(&rows[0]), expected);
    let trials: Vec<f64> = rows.iter().map(|row| number(&row["trial"])).collect();
    assert_eq!(trials[..6], [1.0, 2.0, 3.0, 1.0, 2.0, 3.0]);
    assert_eq!(json["inputs"]["simulated_stand"]["seed"], 7);
    assert_eq!(json, place.json(line));
    let another = line.replace("--seed 7", "--seed 8");
    assert_ne!(json["rows"], place.json(&another)["rows"]);
}

/// Half a unit of the last digit that a stand shows.
const DIGITS: f64 = 0.5001e-4;

#[test]
fn a_stand_without_noise_reads_what_the_theory_says() {
    let place = Place::new();
    let truth = place.json("wheel-test --slip-ratio -0.5:0.5:0.5 --slip-angle-deg 20");
    let read = place.json(
        "wheel-test --slip-ratio -0.5:0.5:0.5 --slip-angle-deg 20 --trials 1 --noise-n 0 \
         --noise-mm 0 --noise-nm 0",
    );
    for (truth, read) in [0, 1, 2].map(|row| (&truth["rows"][row], &read["rows"][row])) {
        for word in ["sinkage_mm", "drawbar_pull_n", "side_force_n", "torque_nm"] {
            assert!((number(&truth[word]) - number(&read[word])).abs() < DIGITS, "{word}: {read}");
        }
    }
}

#[test]
fn a_stand_cannot_read_a_wheel_that_does_not_settle() {
    let row = &Place::new().json("wheel-test --load-n 1e5 --slip-ratio 0 --trials 1")["rows"][0];
    assert!(row["status"].as_str().is_some_and(|status| status.contains("carries")), "{row}");
    assert!(row["drawbar_pull_n"].is_null() && row["trial"] == 1);
}
