//! `learn`: what it makes of the telemetry of a run on another soil, its folder, and what it
//! refuses.

use crate::bad_input::check_is_refusal;
use crate::program::{Place, number};

/// A place with the log of a drive along 8° of a sand that is softer than the prior says.
fn driven() -> Place {
    let place = Place::new();
    let run = "traverse --rover hakuto --soil toyoura --set soil.shear.lateral_m=0.022 --slope-deg \
               8 --set soil.shear.longitudinal_m=0.05 --set scenario.start.yaw_deg=4 --simulation \
               quasi-steady --duration-s 30 --format csv";
    place.write("log.csv", place.results(run));
    place
}

const COMMAND: &str = "learn log.csv --prior toyoura-uncertain --rover hakuto --model ishigami \
                       --slope-deg 8 --predict-slope-deg 5,10 --samples 60";

/// The command's contract: headings and slips with bands, that hold what the soil of the drive has.
#[test]
fn a_drive_narrows_the_next_slopes() {
    let place = driven();
    let answer = place.json(&format!("{COMMAND} --out today"));
    assert_eq!(answer["schema"], "grouser.learn.v1");
    let rows = answer["predictions"].as_array().expect("predictions");
    assert_eq!(rows.len(), 2);
    // What `heading` has for the soil of the drive.
    for (row, (slope, yaw, slip)) in rows.iter().zip([(5.0, 3.68, 0.104), (10.0, 8.90, 0.163)]) {
        assert_eq!(number(&row["slope_deg"]), slope);
        for (name, truth) in [("yaw_deg", yaw), ("slip_ratio", slip)] {
            let [low, high] = ["2_5", "97_5"].map(|end| number(&row[format!("{name}_p{end}")]));
            let median = number(&row[name]);
            assert!((low..=high).contains(&truth) && low < median && median < high, "{name} {row}");
            let [least, most] =
                ["2_5", "97_5"].map(|end| number(&row[format!("before_{name}_p{end}")]));
            assert!(high - low < 0.9 * (most - least), "{name} is narrower than before: {row}");
        }
    }
    assert_eq!(answer["warnings"].as_array().map(Vec::len), Some(0));
    assert!(!place.read("today/soil.toml").contains("date ="), "the log's clock says no day");
    // The soil that was learnt is a soil for all other commands.
    let soil = answer["soil"].as_str().expect("a path");
    let again = place.json(&format!("heading --rover hakuto --soil {soil} --slope-deg 10"));
    let yaw = number(&again["rows"][0]["yaw_deg"]);
    assert!((yaw - 8.9).abs() < 2.5, "{yaw}");
    for name in ["report.html", "predictions.csv", "lessons.csv", "soil-samples.csv"] {
        assert!(place.file(&format!("today/{name}")).exists(), "{name}");
    }
}

/// What was learnt is one belief: with as many samples and the same seed, `heading` of the soil that
/// `learn` wrote has the models, the bands and the advice of `learn`, and another day that teaches
/// nothing leaves them as they are.
#[test]
fn other_commands_believe_what_was_learnt() {
    let place = driven();
    // At nine in the morning of a day in Greenwich.
    let log = place.read("log.csv");
    let clocked = log.lines().enumerate().map(|(row, line)| match line.split_once(',') {
        Some((time, rest)) if row > 0 => {
            format!("{},{rest}\n", 1_795_770_000.0 + time.parse::<f64>().expect("a time"))
        }
        _ => format!("{line}\n"),
    });
    place.write("log.csv", clocked.collect::<String>());
    let learn = "learn log.csv --prior toyoura-uncertain --rover hakuto --slope-deg 8 \
                 --predict-slope-deg 5,10 --samples 60 --out today";
    let learnt = place.json(learn);
    assert!(place.read("today/soil.toml").contains("date = \"2026-11-27\"\n"));
    let heading = "heading --rover hakuto --soil today/soil.toml --slope-deg 5,10 --samples 60";
    let found = place.json(heading);
    for (model, share) in learnt["models"].as_object().expect("models") {
        let weight = number(&found["belief"]["model_weights"][model]);
        assert!((number(share) - weight).abs() < 1e-9, "{model}: {share} {weight}");
    }
    let pairs = learnt["predictions"].as_array().unwrap().iter();
    for (one, other) in pairs.zip(found["rows"].as_array().unwrap()) {
        for key in ["yaw_deg_p2_5", "yaw_deg_p97_5", "probability_level"] {
            let [one, other] = [one, other].map(|it| number(&it[key]));
            assert!((one - other).abs() < 1e-6, "{key}: {one} {other}");
        }
        assert_eq!(one["advice"], other["advice"]);
    }
    // What was learnt states how uncertain it is, even if what was believed before did not.
    let bare = learn.replace("toyoura-uncertain", "toyoura").replace("today", "bare");
    let (learnt_of_bare, soil) = (place.json(&bare), "bare/soil.toml");
    let found_of_bare = place.json(&heading.replace("today/soil.toml", soil));
    let pairs = learnt_of_bare["predictions"].as_array().unwrap().iter();
    for (one, other) in pairs.zip(found_of_bare["rows"].as_array().unwrap()) {
        assert_eq!(one["advice"], other["advice"]);
        assert_ne!(one["advice"]["reason"], "no_stated_uncertainty");
    }
    place.write("idle.csv", "time_s,roll_deg,pitch_deg,vo_dx_m\n0,8,0,\n1,8,0,0\n");
    let idle = place.line(
        "learn idle.csv --prior today/soil.toml --rover hakuto --slope-deg 8 --predict-slope-deg \
         5,10 --samples 60 --out tomorrow --format json",
    );
    assert!(idle.code() == 1 && idle.stderr.contains("nothing was learnt"), "{}", idle.stderr);
    assert!(!place.file("tomorrow/soil.toml").exists(), "what was believed is in today/soil.toml");
    let idle_text = place
        .line("learn idle.csv --prior today/soil.toml --rover hakuto --slope-deg 8 --samples 4");
    let words = "nothing was learnt; by what was known before: 5° ";
    assert!(idle_text.stdout.contains(words), "{}", idle_text.stdout);
    let again: serde_json::Value = serde_json::from_str(&idle.stdout).expect("JSON");
    let pairs = again["predictions"].as_array().unwrap().iter();
    for (one, other) in pairs.zip(learnt["predictions"].as_array().unwrap()) {
        for key in ["yaw_deg_p2_5", "yaw_deg_p97_5"] {
            assert!((number(&one[key]) - number(&other[key])).abs() < 1e-6, "{key} {one} {other}");
        }
        assert_eq!(one["advice"]["verdict"], other["advice"]["verdict"]);
    }
    // One model by its name has the samples of that model.
    let one = place.json(&format!("{heading} --model rft"));
    assert_eq!(one["belief"]["model_weights"]["rft"], 1.0);
    let campaign = "schema = \"campaign/1\"\nname = \"belief\"\nstudy = \"heading\"\nruns = 60\n\
                    seed = 1\nsampling = \"monte-carlo\"\nsoil_uncertainty = true\n\
                    model_uncertainty = true\n[scenario]\nrover = \"hakuto\"\n\
                    slope_deg = 10.0\nsoil = \"today/soil.toml\"\n";
    place.write("campaign.toml", campaign);
    let run = place.line("campaign run campaign.toml --out runs");
    assert_eq!(run.code(), 0, "{}", run.stderr);
}

/// What the instruments of a simulated mission say: the same again from the same seed, other noise
/// from another, and enough to learn from. Without a fault it is the run itself.
#[test]
fn a_run_has_telemetry() {
    let place = Place::new();
    let run = "traverse --rover hakuto --soil toyoura --slope-deg 6 --simulation quasi-steady \
               --duration-s 30 --set scenario.start.yaw_deg=3";
    for (name, flags) in [
        ("one.csv", "--sensor outliers=0.05"),
        ("again.csv", "--sensor outliers=0.05 --sensor-seed 1"),
        ("other.csv", "--sensor outliers=0.05 --sensor-seed 2"),
        ("perfect.csv", "--sensor perfect --sensor rate_hz=2"),
    ] {
        place.results(&format!("{run} --telemetry {name} {flags}"));
    }
    assert_eq!(place.read("one.csv"), place.read("again.csv"));
    assert_ne!(place.read("one.csv"), place.read("other.csv"));
    let perfect = place.read("perfect.csv");
    assert_eq!(perfect.lines().count(), 1 + 61, "two readings a second");
    let column = |name: &str| {
        let place = perfect.lines().next().unwrap().split(',').position(|it| it == name).unwrap();
        let cells = perfect.lines().skip(1).map(move |line| line.split(',').nth(place).unwrap());
        cells.filter_map(|cell| cell.parse::<f64>().ok()).collect::<Vec<_>>()
    };
    let (roll, way) = (column("roll_deg"), column("vo_dx_m"));
    assert!((roll[0] - 5.99).abs() < 0.02, "roll has almost all of the slope: {}", roll[0]);
    assert_eq!((roll.len(), way.len()), (61, 60));
    let learnt =
        "learn one.csv --prior toyoura-uncertain --rover hakuto --model ishigami --samples 20";
    let answer = place.json(learnt);
    assert!(answer["learnt"]["stretches"].as_u64().unwrap() > 10, "{}", answer["learnt"]);
    assert_eq!(answer["learnt"]["stretches_not_used"], 0);
    for (flags, words) in [
        ("--telemetry a.csv --sensor colour=1", "there is no 'colour'"),
        ("--telemetry a.csv --model all", "--telemetry logs one run"),
        ("--sensor perfect", "--telemetry"),
        ("--telemetry other.csv", "add --force to replace it"),
    ] {
        let said = check_is_refusal(&place.line(&format!("{run} {flags}")), 2);
        assert!(said.contains(words), "{words} in {said}");
    }
    place.results(&format!("{run} --telemetry other.csv --sensor outliers=0.05 --force"));
    assert_eq!(place.read("other.csv"), place.read("one.csv"));
}

/// A log without roll and pitch teaches nothing unless the slope is given, and the note says so.
#[test]
fn what_taught_nothing_is_said() {
    let place = driven();
    let answer = place.line(&COMMAND.replace("--slope-deg 8", ""));
    assert!(
        answer.code() == 1 && answer.stderr.contains("no soil is written"),
        "{}",
        answer.stderr
    );
    let text = answer.stdout;
    for part in ["taught nothing: roll and pitch are not known", "columns not used: forward_speed"]
    {
        assert!(text.contains(part), "{part} in\n{text}");
    }
    // Times in milliseconds from 0 are seconds that no motion is known between.
    let log = place.read("log.csv");
    let slow = log.lines().enumerate().map(|(row, line)| match line.split_once(',') {
        Some((time, rest)) if row > 0 => {
            format!("{},{rest}\n", 1e3 * time.parse::<f64>().expect("a time"))
        }
        _ => format!("{line}\n"),
    });
    place.write("slow.csv", slow.collect::<String>());
    let answer = place.line(&COMMAND.replace("log.csv", "slow.csv"));
    assert_eq!(answer.code(), 1, "{}", answer.stdout);
    for part in ["more than 5 s apart", "`time_ms`"] {
        assert!(answer.stderr.contains(part), "{part} in\n{}", answer.stderr);
    }
}

#[test]
fn logs_that_are_none_are_refused() {
    let place = Place::new();
    place.write("empty.csv", "");
    place.write("rows.csv", "time_s,roll_deg\n");
    place.write("wheel.csv", "time_s,wheel_speed_rad_s_middle\n1,1\n");
    for (file, words) in [
        ("empty.csv", "has no header"),
        ("rows.csv", "has no rows"),
        ("wheel.csv", "is no wheel of the rover"),
        ("nothing.csv", "there is no such file"),
        (".", "this is a folder"),
    ] {
        let command = COMMAND.replace("log.csv", file);
        let said = check_is_refusal(&place.line(&command), 2);
        assert!(said.contains(words), "{words} in {said}");
    }
    let exact = COMMAND.replace("toyoura-uncertain", "toyoura --set soil.priors=none");
    place.write("log.csv", "time_s,roll_deg\n1,1\n");
    let said = check_is_refusal(&place.line(&exact), 2);
    assert!(said.contains("taken as exact") && said.contains("--prior"), "{said}");
}

/// Advice is given when it is asked for: a heading within its band, looks at the slip, legs in the
/// order of what they tell for their work; in JSON, files and the page. Its flags stand for nothing
/// without it.
#[test]
fn advice_is_given_when_it_is_asked_for() {
    let place = driven();
    let few = COMMAND.replace("--samples 60", "--samples 20");
    let flags = "--advice --ways 100 --stuck-probability 0.1 --test-slope-deg 0,8";
    let answer = place.json(&format!("{few} {flags} --out today"));
    let advice = &answer["advice"];
    let slopes = advice["slopes"].as_array().expect("slopes");
    for (row, predicted) in slopes.iter().zip(answer["predictions"].as_array().unwrap()) {
        let yaw = number(&row["yaw_deg"]);
        assert_eq!(yaw, number(&predicted["yaw_deg"]));
        assert!(yaw < number(&row["steepest_yaw_deg"]), "{row}");
        assert_eq!(number(&row["slip_check_every_m"]), 5.0);
    }
    let legs = advice["legs"].as_array().expect("legs");
    let told: Vec<f64> = legs.iter().map(|leg| number(&leg["information_nat_per_joule"])).collect();
    assert_eq!(told.len(), 6);
    assert!(told.is_sorted_by(|one, other| one >= other) && told[5] > 0.0, "{told:?}");
    for name in ["today/advice.csv", "today/test-drives.csv"] {
        assert!(place.read(name).starts_with("slope_deg,yaw_deg,"), "{name}");
    }
    let page = place.read("today/report.html");
    assert!(page.contains("<h2>Advice</h2>") && page.contains("look at the slip every 5 m"));
    assert_eq!(place.json(&few)["advice"], serde_json::Value::Null);
    for (flags, words) in [
        ("--stuck-probability 0.1", "--advice"),
        ("--advice --no-go-slip-ratio 2", "from 0 to 1"),
        ("--advice --test-way-m 0", "from 0.1 to 100"),
        ("--advice --look-s nan", "from 0 to"),
    ] {
        let said = check_is_refusal(&place.line(&format!("{few} {flags}")), 2);
        assert!(said.contains(words), "{words} in {said}");
    }
}
