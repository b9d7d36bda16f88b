//! `--gradients`: derivatives beside the results, and what is refused.

use serde_json::Value;

use crate::program::{Place, number};

const FRICTION: &str = "soil.friction_angle_deg";

/// A result and its derivative in a row.
fn with_derivative(row: &Value, result: &str, key: &str) -> [f64; 2] {
    [number(&row[result]), number(&row[format!("d_{result}_d_{key}")])]
}

/// Half of the change from one answer to another whose key is two apart.
fn half_change(rows: [&Value; 2], result: &str) -> f64 {
    let [less, more] = rows.map(|row| number(&row[result]));
    (more - less) / 2.0
}

#[test]
fn a_wheel_test_has_the_derivatives_of_its_results() {
    let place = Place::new();
    let line = |rest: &str| place.json(&format!("wheel-test --slip-ratio 0.2 {rest}"));
    let found = line(&format!("--gradients {FRICTION},load_n,soil.cohesion_kpa"));
    assert_eq!(found["inputs"]["gradients"][1], "load_n");
    let row = &found["rows"][0];
    assert_eq!(row["one_sided"], serde_json::json!([]));
    let [less, more] = [16.99, 17.01].map(|load| line(&format!("--load-n {load}")));
    for result in ["sinkage_mm", "drawbar_pull_n", "torque_nm", "normal_force_n"] {
        let [_, derivative] = with_derivative(row, result, "load_n");
        let reference = half_change([&less["rows"][0], &more["rows"][0]], result) / 0.01;
        assert!((derivative - reference).abs() < 1e-5, "{result}: {derivative} for {reference}");
    }
    // Toyoura has no cohesion: what it would add is known to one side.
    assert!(with_derivative(row, "drawbar_pull_n", "soil.cohesion_kpa")[1] > 0.0);
}

#[test]
fn a_heading_and_the_steepest_slope_have_theirs() {
    let place = Place::new();
    let found = place.json(&format!("heading --slope-deg 10 --gradients {FRICTION}"));
    let [_, by_friction] = with_derivative(&found["rows"][0], "yaw_deg", FRICTION);
    let [_, limit] = with_derivative(&found, "limit_slope_deg", FRICTION);
    let of = |degrees: f64| {
        let line = format!("heading --slope-deg 10 --nominal --set {FRICTION}={degrees}");
        place.json(&line)
    };
    let [less, more] = [37.99, 38.01].map(of);
    let yaw = half_change([&less["rows"][0], &more["rows"][0]], "yaw_deg") / 0.01;
    assert!((by_friction - yaw).abs() < 1e-4, "{by_friction} for {yaw}");
    let reference = half_change([&less, &more], "limit_slope_deg") / 0.01;
    assert!((limit - reference).abs() < 1e-4, "{limit} for {reference}");
    let map =
        place.json(&format!("heading-map --slope-deg 10 --course-deg 0 --gradients {FRICTION}"));
    for result in ["yaw_deg", "limit_slope_deg"] {
        let [_, derivative] = with_derivative(&map["rows"][0], result, FRICTION);
        let own = if result == "yaw_deg" { by_friction } else { limit };
        assert!((derivative - own).abs() < 1e-9, "{result}: {derivative} for {own}");
    }
}

#[test]
fn keys_that_do_not_act_give_none_and_those_that_lack_say_so() {
    let place = Place::new();
    let found = place.results("wheel-test --gradients all --slip-ratio 0 --format csv");
    let header = found.lines().next().unwrap_or_default();
    assert!(header.contains("d_torque_nm_d_wheel.grousers.height_m"), "{header}");
    assert!(found.contains("d_sinkage_mm_d_slip_ratio"), "the kink at no slip is listed");
    let rows = place.json("heading --gradients duration_s,slope_deg --slope-deg 10");
    assert_eq!(with_derivative(&rows["rows"][0], "yaw_deg", "duration_s")[1], 0.0);
    assert!(with_derivative(&rows["rows"][0], "yaw_deg", "slope_deg")[1] > 0.5);
}

#[test]
fn a_traverse_has_the_derivatives_of_its_records() {
    let place = Place::new();
    let line = "traverse --simulation quasi-steady --duration-s 10";
    let found = place.json(&format!("{line} --gradients {FRICTION},slope_deg"));
    assert_eq!(found["inputs"]["gradients"][1], "slope_deg");
    let [less, more] =
        [37.99, 38.01].map(|angle| place.json(&format!("{line} --set {FRICTION}={angle}")));
    let last = found["samples"].as_array().and_then(|all| all.last()).expect("samples");
    assert_eq!(last, &found["final"]);
    for result in ["x_m", "y_m", "yaw_deg", "energy_j"] {
        let [_, derivative] = with_derivative(&found["final"], result, FRICTION);
        let reference = half_change([&less["final"], &more["final"]], result) / 0.01;
        assert!((derivative - reference).abs() < 1e-6, "{result}: {derivative} for {reference}");
    }
    // Each model has a row with the same columns; the table has those that are of most interest.
    let all = place.results(&format!("{line} --model all --gradients {FRICTION} --format csv"));
    assert_eq!(all.lines().count(), 5, "{all}");
    assert!(all.lines().next().is_some_and(|it| it.contains("d_y_m_d_soil.friction_angle_deg")));
    let table = place.results(&format!("{line} --gradients {FRICTION}"));
    assert!(table.contains("d_energy_j_d_soil.friction_angle_deg"), "{table}");
}

#[test]
fn what_has_no_derivatives_is_refused_by_name() {
    let place = Place::new();
    for (line, words) in [
        ("wheel-test --gradients soil.frction_angle_deg", "did you mean `friction_angle_deg`"),
        ("wheel-test --gradients radius_m", "did you mean `wheel.radius_m`"),
        ("heading --gradients wheel.radius_m", "did you mean `rover.wheel_unit.wheel.radius_m`"),
        ("heading --soil toyoura-uncertain --gradients soil.cohesion_kpa", "--nominal"),
        ("heading --samples 40 --gradients soil.cohesion_kpa", "derivatives"),
        ("heading --wheel-speeds --gradients soil.cohesion_kpa", "derivatives"),
        ("wheel-test --uncertainty --gradients load_n", "derivatives"),
        ("wheel-test --trials 3 --gradients load_n", "derivatives"),
        ("heading-map --uncertainty --gradients slope_deg", "derivatives"),
        ("traverse --uncertainty --gradients slope_deg", "derivatives"),
        ("traverse --gradients duration_s", "records"),
        ("traverse --gradients wheel.radius_m", "did you mean `rover.wheel_unit.wheel.radius_m`"),
    ] {
        let answer = place.line(line);
        assert_eq!(answer.code(), 2, "{line}");
        assert!(answer.stderr.contains(words), "{line}: {}", answer.stderr);
    }
}
