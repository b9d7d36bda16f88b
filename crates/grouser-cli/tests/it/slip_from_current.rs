//! `slip-from-current`: what it makes of a run's own currents, its folder, and what it refuses.

use crate::bad_input::check_is_refusal;
use crate::motors::{MOTOR, rover};
use crate::program::{Place, number};

/// A place with a rover that has motors, and the log of its drive straight up 8°.
fn driven() -> Place {
    let place = Place::new();
    place.write("r.toml", rover(&format!("resistance_ohm = 10.0\n{MOTOR}")));
    let run = "traverse --rover r.toml --slope-deg 8 --set scenario.start.yaw_deg=90 --simulation \
               quasi-steady --duration-s 2 --format csv";
    place.write("log.csv", place.results(run));
    place
}

const COMMAND: &str = "slip-from-current log.csv --rover r.toml --slope-deg 8";

/// The command's contract: the slip of a run from its currents alone, beside its own.
#[test]
fn a_runs_currents_give_its_slip() {
    let place = driven();
    for ignore in ["", " --ignore load_n,slip_angle_deg"] {
        let answer = place.json(&format!("{COMMAND}{ignore}"));
        assert_eq!(answer["schema"], "grouser.slip-from-current.v1");
        let rows = answer["rows"].as_array().expect("rows");
        assert_eq!(rows.len(), 4 * 21);
        for row in rows {
            let [low, median, high] =
                ["2_5", "50", "97_5"].map(|it| number(&row[format!("slip_ratio_p{it}")]));
            assert!(low < median && median < high && high - low < 0.1, "{row}");
            assert!((median - number(&row["true_slip_ratio"])).abs() < 0.005, "{row}");
            assert_eq!((&row["status"], &row["is_in_interval"]), (&"ok".into(), &"yes".into()));
        }
        let wheels = answer["wheels"].as_array().expect("wheels");
        assert_eq!((wheels.len(), &wheels[4]["wheel"]), (5, &"all".into()));
        assert_eq!((&wheels[4]["readings"], number(&wheels[4]["share_held"])), (&84.into(), 1.0));
        assert_eq!(answer["notes"].as_array().expect("notes").is_empty(), ignore.is_empty());
    }
    // Without slip in the log there is nothing beside the estimate.
    let alone = place.json(&format!("{COMMAND} --ignore slip_ratio"));
    assert!(alone["rows"][0].get("true_slip_ratio").is_none());
    // Of an uncertain soil nothing more than a wide interval is left.
    let open = place.json(&format!("{COMMAND} --uncertainty --samples 30"));
    assert_eq!(
        (&open["rows"][0]["status"], &open["inputs"]["samples"]),
        (&"ill-posed".into(), &30.into())
    );
}

/// What is printed says what its words mean, and that it is not all.
#[test]
fn the_table_is_short_and_explains_itself() {
    let place = driven();
    let text = place.results(&format!("{COMMAND} --ignore load_n --uncertainty --samples 10"));
    for part in
        ["12 of 84 readings", "ill-posed: the current does not", "share_held", "note: loads follow"]
    {
        assert!(text.contains(part), "{part} in\n{text}");
    }
}

#[test]
fn a_folder_repeats_itself() {
    let place = driven();
    place.results(&format!("{COMMAND} --ignore load_n --noise-nm 0.01 --out out"));
    let page = place.read("out/report.html");
    for part in ["Slip ratio of front-left", "<svg", "Width of that interval", "84 of 84 readings"]
    {
        assert!(page.contains(part), "{part}");
    }
    let repeat = "slip-from-current out/log.csv --scenario out/scenario.toml --noise-nm=0.01 \
                  --ignore load_n";
    assert!(page.contains("--noise-nm=0.01") && page.contains("--scenario scenario.toml"));
    assert_eq!(
        place.results(&format!("{repeat} --format csv")),
        place.read("out/slip-from-current.csv")
    );
    assert!(place.read("out/figures/rear-right.svg").contains("<svg"));
    assert!(place.read("out/wheels.csv").starts_with("wheel,readings,"));
}

#[test]
fn what_cannot_be_used_is_refused_with_what_would_help() {
    let place = driven();
    place.write("bare.csv", "time_s,front-left.wheel_speed_rad_s\n0,0.5\n");
    place.write("nose.csv", "time_s,nose.current_a,nose.wheel_speed_rad_s\n0,0.2,0.5\n");
    for (rest, message) in [
        ("log.csv --rover hakuto", "rover HAKUTO: no wheel of the rover has a [motor]"),
        ("none.csv --rover r.toml", "there is no such file"),
        ("bare.csv --rover r.toml", "a run has currents if its rover's document has a [motor]"),
        ("nose.csv --rover r.toml", "`nose` is no wheel of the rover: its wheels are front-left"),
        ("log.csv --rover r.toml --ignore loadn", "did you mean `load_n`?"),
        ("log.csv --rover r.toml --ignore current_a", "no column that a log can do without"),
        ("log.csv --rover r.toml --slip-ratio 0.5", "expected two values"),
        ("log.csv --rover r.toml --slip-ratio 0.5,0.1", "above the lowest"),
        (
            "log.csv --rover r.toml --relative-noise 0 --noise-nm 0",
            "above 0 where the absolute noise is 0",
        ),
        ("log.csv --rover r.toml --set scenario.slope_deg=4", "those of the log or of --slope-deg"),
        ("log.csv --rover r.toml --max-rows 3", "--max-rows"),
    ] {
        let refused = check_is_refusal(&place.line(&format!("slip-from-current {rest}")), 2);
        assert!(refused.contains(message), "{rest}: {refused}");
    }
}

/// Telemetry is read as `learn` reads it, whatever it is written as: its currents give the slip that
/// the run's own table gives.
#[test]
fn telemetry_of_any_kind_gives_the_same_slip() {
    let place = driven();
    let run = "traverse --rover r.toml --slope-deg 8 --set scenario.start.yaw_deg=90 --simulation \
               quasi-steady --duration-s 2 --telemetry tele.csv --sensor perfect";
    place.results(run);
    assert_eq!(place.line("import-telemetry tele.csv --rover r.toml --out tele.parquet").code(), 0);
    let medians = |log: &str| -> Vec<f64> {
        let line = COMMAND.replacen("log.csv", log, 1) + " --ignore load_n,slip_angle_deg";
        let rows = place.json(&line)["rows"].as_array().expect("rows").clone();
        rows.iter().map(|row| number(&row["slip_ratio_p50"])).collect()
    };
    let expected = medians("log.csv");
    for log in ["tele.csv", "tele.parquet"] {
        let found = medians(log);
        assert_eq!(found.len(), expected.len(), "{log}");
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).abs() < 0.005, "{log}: {found} for {expected}");
        }
    }
    // What has no currents says so.
    place.results(&run.replace("r.toml", "hakuto").replace("tele.csv", "bare.csv"));
    let answer = place.line(&COMMAND.replacen("log.csv", "bare.csv", 1));
    assert!(answer.code() == 2 && answer.stderr.contains("current"), "{}", answer.stderr);
}
