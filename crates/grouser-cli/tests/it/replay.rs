//! `replay`: the telemetry of a run beside what is predicted for it, its folder and log, and what
//! it refuses.

use crate::bad_input::check_is_refusal;
use crate::program::{Place, number};

/// A place with the telemetry of a drive along 8°.
fn driven() -> Place {
    let place = Place::new();
    place.results(
        "traverse --rover hakuto --soil toyoura --model ishigami --slope-deg 8 --simulation \
         quasi-steady --set scenario.start.yaw_deg=4 --duration-s 60 --telemetry drive.csv \
         --format csv",
    );
    place
}

const COMMAND: &str = "replay drive.csv --rover hakuto --soil toyoura --model ishigami";

/// The command's contract: each channel with its residuals, what they point to, and the files of
/// the folder.
#[test]
fn a_drive_beside_its_prediction() {
    let place = driven();
    let answer = place.json(&format!("{COMMAND} --out replayed --mcap drive.mcap"));
    assert_eq!(answer["schema"], "grouser.replay.v1");
    let channels = answer["channels"].as_array().expect("channels");
    let of = |name: &str| channels.iter().find(|it| it["channel"] == name).expect(name);
    assert_eq!(of("forward_speed_m_s")["prediction"], "prescribed");
    assert_eq!(of("yaw_deg")["prediction"], "free-run");
    assert!(number(&of("forward_speed_m_s")["rms"]) < 5e-3, "{}", of("forward_speed_m_s"));
    assert!(number(&of("y_m")["rms"]) < 0.05, "{}", of("y_m"));
    let points = answer["points_to"].as_array().expect("sentences");
    assert!(points[0].as_str().expect("words").contains("point to nothing"), "{points:?}");
    let stretch = &answer["stretches"][3];
    let [measured, predicted, residual] = ["measured_torque_nm", "torque_nm", "residual_torque_nm"]
        .map(|name| number(&stretch[format!("front-left.{name}")]));
    assert!((measured - predicted - residual).abs() < 1e-12);
    for name in
        ["report.html", "replay.csv", "channels.csv", "findings.csv", "drive.mcap", "scenario.toml"]
    {
        assert!(place.file(&format!("replayed/{name}")).exists(), "{name}");
    }
    assert!(!place.file("replayed/rover.toml").exists(), "nothing points to a rover");
}

/// A part of a log is replayed as if it had no other records, and its answer says which it is.
#[test]
fn a_part_of_a_log_is_replayed_alone() {
    let place = driven();
    let answer = place.json(&format!("{COMMAND} --from-s 20 --to-s 40"));
    assert_eq!(
        (number(&answer["inputs"]["from_s"]), number(&answer["inputs"]["to_s"])),
        (20.0, 40.0)
    );
    let stretches = answer["stretches"].as_array().expect("stretches");
    let ends: Vec<f64> = stretches.iter().map(|it| number(&it["time_s"])).collect();
    assert!(ends[0] > 20.0 && ends[ends.len() - 1] <= 40.0, "{ends:?}");
    let log = place.read("drive.csv");
    let is_in = |line: &&str| {
        let time = line.split(',').next().and_then(|it| it.parse::<f64>().ok());
        time.is_none_or(|time| (20.0..=40.0).contains(&time))
    };
    place.write("part.csv", log.lines().filter(is_in).collect::<Vec<_>>().join("\n"));
    let alone = place.json(&COMMAND.replace("drive.csv", "part.csv"));
    for key in ["channels", "findings", "best_causes", "stretches", "points_to"] {
        assert_eq!(answer[key], alone[key], "{key}");
    }
    let screen = place.results(&format!("{COMMAND} --from-s 20 --to-s 40"));
    assert!(screen.contains(" from 20 s to 40 s"), "{screen}");
    for (part, says) in [
        ("--from-s 5 --to-s 5", "not after 5 s"),
        ("--to-s 0.01", "nothing can be told from 1 record"),
    ] {
        let refused = place.line(&format!("{COMMAND} {part}"));
        assert!(refused.code() == 2 && refused.stderr.contains(says), "{}", refused.stderr);
    }
}

/// Without odometry, torques and sinkages nothing was compared, and the answer says so; whether a
/// result is outside a domain is not looked for.
#[test]
fn nothing_that_was_compared_is_no_agreement() {
    let place = driven();
    let log = place.read("drive.csv");
    let mut rows = log.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = rows.next().expect("a header");
    let is_kept = |name: &str| {
        matches!(name, "time_s" | "roll_deg" | "pitch_deg") || name.starts_with("wheel_speed_rad_s")
    };
    let kept: Vec<usize> = (0..header.len()).filter(|place| is_kept(header[*place])).collect();
    assert!(kept.len() > 4, "{header:?}");
    let line = |row: &Vec<&str>| kept.iter().map(|at| row[*at]).collect::<Vec<_>>().join(",");
    let lines: Vec<String> =
        std::iter::once(line(&header)).chain(rows.map(|it| line(&it))).collect();
    place.write("bare.csv", lines.join("\n"));
    let answer =
        place.json("replay bare.csv --rover hakuto --soil toyoura --model ishigami --out bare");
    let points = answer["points_to"].as_array().expect("sentences");
    assert!(points[0].as_str().expect("words").starts_with("cannot tell"), "{points:?}");
    let findings = answer["findings"].as_array().expect("findings");
    assert!(findings.len() == 11 && findings.iter().all(|it| it["finding"] == "cannot-tell"));
    let page = place.read("bare/report.html");
    assert!(page.contains("Not checked: ") && !page.contains("No result on the soil"));
}

/// A turn on the spot goes to and fro within a stretch: the free run turns as the rover did, and is
/// not stuck.
#[test]
fn a_free_run_turns_on_the_spot() {
    let place = Place::new();
    let leg = "drive_m = 0.3\nspeed_m_s = 0.06";
    place.write(
        "turn.toml",
        format!(
            "schema = \"mission/1\"\nname = \"a turn\"\nrover = \"hakuto\"\n\
             soil = \"toyoura-uncertain\"\nslope_deg = 8\n[[leg]]\n{leg}\nheading = \"contour\"\n\
             [[leg]]\nturn_deg = 60\nspeed_m_s = 0.05\n[[leg]]\n{leg}\n"
        ),
    );
    place.results("mission turn.toml --nominal --telemetry log.csv --format csv");
    let answer = place.line("replay log.csv --rover hakuto --soil toyoura-uncertain --format json");
    assert!(!answer.stdout.contains("the free run ends"), "{}", answer.stdout);
    let answer: serde_json::Value = serde_json::from_str(&answer.stdout).expect("JSON");
    let channels = answer["channels"].as_array().expect("channels");
    for (channel, most) in [("x_m", 0.05), ("y_m", 0.05), ("yaw_deg", 2.0)] {
        let found = channels.iter().find(|it| it["channel"] == channel).expect(channel);
        assert!(number(&found["rms"]) < most, "{found}");
    }
}

/// Wheels that are assumed a twentieth too small, and bands over samples of the soil.
#[test]
fn a_wrong_radius_is_named() {
    let place = driven();
    let answer = place.json(&format!("{COMMAND} --set wheel.radius_m=0.095"));
    let findings = answer["findings"].as_array().expect("findings");
    let speed = findings.iter().find(|it| it["cause"] == "speed").expect("speed");
    assert_ne!(speed["finding"], "nothing", "{speed}");
    assert!((number(&speed["estimate"]) - 0.048).abs() < 0.02, "{speed}");
    // The rover that it points to is the one that was driven, of 0.1 m.
    place.json(&format!("{COMMAND} --set wheel.radius_m=0.095 --out replayed"));
    let checked = place.results("check replayed/rover.toml");
    assert!(checked.contains("a valid rover document"), "{checked}");
    let rover = place.read("replayed/rover.toml");
    let radius = rover.lines().find_map(|line| line.strip_prefix("radius_m = ")).expect("a radius");
    let radius: f64 = radius.parse().expect("a number");
    assert!((radius - 0.1).abs() < 2e-3, "{radius}");
    assert!(
        rover.contains("by a replay of drive.csv") && rover.contains("it was 0.095"),
        "{rover}"
    );
    let again = "replay drive.csv --scenario replayed/scenario.toml --rover replayed/rover.toml";
    let findings = place.json(again)["findings"].clone();
    let speed = findings.as_array().expect("findings").iter().find(|it| it["cause"] == "speed");
    assert!(number(&speed.expect("speed")["estimate"]).abs() < 0.02, "{speed:?}");
    let banded = "replay drive.csv --rover hakuto --soil toyoura-uncertain --model ishigami \
                  --uncertainty --samples 8 --seed 2";
    let answer = place.json(banded);
    let first = &answer["stretches"][0];
    assert!(number(&first["slip_ratio_p2_5"]) <= number(&first["slip_ratio_p97_5"]), "{first}");
    let channels = answer["channels"].as_array().expect("channels");
    assert!(channels.iter().all(|it| it["share_within_band"].is_number()), "{channels:?}");
}

#[test]
fn telemetry_that_cannot_be_replayed_is_refused() {
    let place = Place::new();
    place.write("still.csv", "time_s,roll_deg\n0,1\n1,1\n");
    for (command, words) in [
        ("replay missing.csv", "there is no such file"),
        ("replay still.csv", "wheel speeds"),
        ("replay still.csv --mcap log.txt", "ends with `.mcap`"),
        ("replay still.csv --set scenario.duration_s=3", "speeds and times are those of the log"),
    ] {
        let said = check_is_refusal(&place.line(command), 2);
        assert!(said.contains(words), "{words} in {said}");
    }
}
