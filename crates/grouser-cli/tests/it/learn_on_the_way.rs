//! `learn` while a log grows, and after it was killed: what it prints on the way, and what it goes
//! on from.

use std::fs::{self, OpenOptions};
use std::io::Write as _;
use std::process::Stdio;
use std::thread;
use std::time::Duration;

use serde_json::Value;

use crate::bad_input::check_is_refusal;
use crate::program::{Answer, Place, number};

/// A place with the telemetry of a drive along 8° of a sand that is softer than the prior says.
fn driven() -> Place {
    let place = Place::new();
    let run = "traverse --rover hakuto --soil toyoura --set soil.shear.lateral_m=0.022 --slope-deg \
               8 --set soil.shear.longitudinal_m=0.05 --set scenario.start.yaw_deg=4 --simulation \
               quasi-steady --duration-s 24 --telemetry log.csv --sensor outliers=0.02";
    place.results(run);
    place
}

const LEARN: &str = "learn log.csv --prior toyoura-uncertain --rover hakuto --model ishigami \
                     --predict-slope-deg 10 --samples 8";

/// The files that have to be the same, whatever was between start and end.
const RESULTS: [&str; 6] = [
    "learn.json",
    "predictions.csv",
    "lessons.csv",
    "soil.toml",
    "soil-samples.csv",
    "learn-state.json",
];

fn results(place: &Place, folder: &str) -> Vec<String> {
    let text = |name| place.read(&format!("{folder}/{name}"));
    // The answer says where the soil is.
    RESULTS.map(text).iter().map(|it| it.replace(folder, "FOLDER")).collect()
}

fn lines_of(text: &str) -> Vec<String> {
    text.lines().map(|line| format!("{line}\n")).collect()
}

/// Killed several times while the log grows, the same command goes on: its results are those of a
/// command that was never interrupted, to the last digit.
#[test]
fn a_killed_learner_goes_on_with_the_same_bits() {
    let place = driven();
    let whole = place.read("log.csv");
    place.results(&format!("{LEARN} --out whole"));
    let lines = lines_of(&whole);
    let log = place.file("log.csv");
    for (killed, percent) in [20, 45, 70].into_iter().enumerate() {
        let end = lines.len() * percent / 100;
        // The last row is only half there.
        let half = &lines[end][..lines[end].len() / 2];
        fs::write(&log, lines[..end].concat() + half).unwrap();
        let words = format!("{LEARN} --out parts --follow");
        let mut learner = place
            .command(&words.split_whitespace().collect::<Vec<_>>())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        let state = place.file("parts/learn-state.json");
        let before = fs::read(&state).ok();
        for _ in 0..600 {
            thread::sleep(Duration::from_millis(100));
            if fs::read(&state).ok() != before {
                break;
            }
        }
        assert_ne!(fs::read(&state).ok(), before, "kill {killed}: a state is kept");
        // SIGKILL on Unix: nothing of the program runs any more.
        learner.kill().unwrap();
        learner.wait().unwrap();
    }
    fs::write(&log, &whole).unwrap();
    // The second time there is nothing new: the same again.
    for _ in 0..2 {
        let answer = place.line(&format!("{LEARN} --out parts"));
        assert_eq!(answer.code(), 0, "{}", answer.stderr);
        assert!(answer.stderr.contains("going on after"), "{}", answer.stderr);
        assert_eq!(results(&place, "whole"), results(&place, "parts"));
    }
}

/// A state that is not all there, of another prior, rover or slope, or of another log is refused
/// with what to do.
#[test]
fn states_that_do_not_fit_are_refused() {
    let place = driven();
    place.results(&format!("{LEARN} --out today"));
    let state = place.read("today/learn-state.json");
    let again = format!("{LEARN} --out today");
    let refused = |command: &str, words: &str| {
        let said = check_is_refusal(&place.line(command), 2);
        assert!(said.contains(words) && said.contains("--force"), "{words} in {said}");
    };
    refused(&(again.clone() + " --set soil.cohesion_kpa=0.3"), "another prior");
    refused(&again.replace("hakuto", "hakuto-flight"), "another rover");
    refused(&(again.clone() + " --slope-deg 8"), "other settings");
    for (damaged, words) in [
        (state[..state.len() / 2].to_owned(), "damaged"),
        (state.replacen("\"outliers\":", "\"outliers\":1", 1), "check sum"),
        (state.replacen("mass_kg = ", "mass_kg = 1", 1), "check sum"),
        (state.replacen(env!("CARGO_PKG_VERSION"), "0.0.1", 1), "Grouser 0.0.1 wrote it"),
        (String::new(), "damaged"),
    ] {
        place.write("today/learn-state.json", &damaged);
        refused(&again, words);
    }
    place.write("today/learn-state.json", &state);
    let log = place.read("log.csv");
    let lines = lines_of(&log);
    let changed = log.replacen(&lines[5], &lines[6].replacen(',', "1,", 1), 1);
    for other in [changed, lines[..lines.len() / 2].concat()] {
        place.write("log.csv", &other);
        refused(&again, "does not begin with the");
    }
    place.results(&format!("{again} --force"));
}

/// A log that is followed: a line of JSON for each lesson, predictions on the way, and the answer
/// at the end.
#[test]
fn a_growing_log_is_learnt_from_line_by_line() {
    let place = driven();
    let whole = place.read("log.csv");
    let lines = lines_of(&whole);
    let at_once: Value = place.json(LEARN);
    place.write("log.csv", lines[..lines.len() / 2].concat());
    let log = place.file("log.csv");
    let rest = lines[lines.len() / 2..].to_vec();
    let writer = thread::spawn(move || {
        let mut file = OpenOptions::new().append(true).open(log).unwrap();
        for part in rest.chunks(20) {
            thread::sleep(Duration::from_millis(30));
            file.write_all(part.concat().as_bytes()).unwrap();
        }
    });
    let command = format!("{LEARN} --follow --follow-s 3 --every-s 0.2 --format json");
    let printed = place.results(&command);
    writer.join().unwrap();
    let printed: Vec<Value> =
        printed.lines().map(|line| serde_json::from_str(line).expect("a line of JSON")).collect();
    let of = |kind: &str| printed.iter().filter(|it| it["kind"] == kind).collect::<Vec<_>>();
    let (lessons, predictions) = (of("lesson"), of("predictions"));
    assert_eq!(printed.last().unwrap()["kind"], "answer");
    assert_eq!(of("answer")[0]["predictions"], at_once["predictions"]);
    assert_eq!(of("answer")[0]["learnt"], at_once["learnt"]);
    assert!(lessons.len() > 5 && !predictions.is_empty(), "{} lines", printed.len());
    let parts = ["along", "across", "turning", "torque", "sinkage"];
    for lesson in lessons {
        let sum: f64 =
            parts.iter().map(|it| number(&lesson[format!("information_{it}_nat")])).sum();
        assert!((sum - number(&lesson["information_nat"])).abs() < 1e-6, "{lesson}");
    }
    let row = &predictions[0]["predictions"][0];
    assert!(number(&row["yaw_deg_p2_5"]) < number(&row["yaw_deg_p97_5"]), "{row}");
    let said = check_is_refusal(&place.line(&format!("{LEARN} --follow --format csv")), 2);
    assert!(said.contains("--format json"), "{said}");
}

/// Follows a log, of which something becomes meanwhile; the lines of JSON that were printed.
fn followed(place: &Place, meanwhile: impl FnOnce()) -> Vec<Value> {
    let command = format!("{LEARN} --follow --follow-s 3 --format json");
    let words: Vec<&str> = command.split_whitespace().collect();
    let child = place.command(&words).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
    let child = child.expect("the program starts");
    // It reads what there is, and waits.
    thread::sleep(Duration::from_millis(1500));
    meanwhile();
    let answer = Answer::new(&command, &child.wait_with_output().expect("it ends"));
    assert_eq!(answer.code(), 0, "{}", answer.stderr);
    answer.stdout.lines().map(|line| serde_json::from_str(line).expect("a line of JSON")).collect()
}

/// The messages on what became of the log.
fn warnings_of_log(printed: &[Value]) -> String {
    let messages = printed.iter().filter(|it| it["kind"] == "log_warning");
    messages.map(|it| it["message"].as_str().expect("words").to_owned() + "\n").collect()
}

/// A log that is rotated, or copied and cut, is gone on with: what is learnt is what the whole of
/// it tells.
#[test]
fn a_log_that_is_rotated_is_gone_on_with() {
    let place = driven();
    let whole = place.read("log.csv");
    let at_once: Value = place.json(LEARN);
    let lines = lines_of(&whole);
    let many = lines.len() * 7 / 10;
    let (first, rest) = (lines[..many].concat(), lines[0].clone() + &lines[many..].concat());
    let log = place.file("log.csv");
    let rotate = || {
        fs::rename(&log, place.file("log.1")).unwrap();
        thread::sleep(Duration::from_millis(500));
        fs::write(&log, &rest).unwrap();
    };
    let cut = || fs::write(&log, &rest).unwrap();
    let accidents: [(&dyn Fn(), &[&str]); 2] = [
        (&rotate, &["removed or moved", "another file took its place"]),
        (&cut, &["it became shorter"]),
    ];
    for (accident, words) in accidents {
        place.write("log.csv", &first);
        let printed = followed(&place, accident);
        let warnings = warnings_of_log(&printed);
        assert!(words.iter().all(|word| warnings.contains(word)), "{words:?} in {warnings}");
        let answer = printed.last().expect("an answer");
        assert_eq!(answer["predictions"], at_once["predictions"]);
        assert_eq!(answer["learnt"], at_once["learnt"]);
    }
}

/// Rows that nobody can learn from, and silence, are said while they last.
#[test]
fn a_clock_that_is_set_back_is_said_at_once() {
    let place = driven();
    let lines = lines_of(&place.read("log.csv"));
    let log = place.file("log.csv");
    let printed = followed(&place, || {
        let mut file = OpenOptions::new().append(true).open(&log).unwrap();
        file.write_all(lines[1..40].concat().as_bytes()).unwrap();
    });
    let warnings = warnings_of_log(&printed);
    assert!(warnings.contains("rows cannot be used") && warnings.contains("clock"), "{warnings}");
}

#[test]
fn a_log_without_data_is_said_to_be_silent() {
    let place = driven();
    let answer = place.line(&format!("{LEARN} --follow --follow-s 12"));
    assert!(answer.stdout.contains("no data for 10 s"), "{}", answer.stdout);
}

/// A soil learnt yesterday is a prior: today goes on from it, and knows more.
#[test]
fn a_learnt_soil_is_a_prior() {
    let place = driven();
    place.results(&format!("{LEARN} --samples 40 --out yesterday").replace("--samples 8 ", ""));
    let today = LEARN.replace("toyoura-uncertain", "yesterday/soil.toml");
    let answer =
        place.json(&format!("{today} --samples 40 --out today").replace("--samples 8 ", ""));
    // What `heading` has for the soil of the drive; the first day's error is within a degree
    // already.
    let yaw = number(&answer["predictions"][0]["yaw_deg"]);
    assert!((yaw - 8.9).abs() < 1.0, "{yaw}");
    let left = number(&answer["narrowed"]["shear.lateral_m"]);
    assert!(left < 0.99, "the second day narrows the first day's soil: {left}");
    // The second day tells less that is new.
    let [yesterday, today] = ["yesterday", "today"].map(|day| {
        let text = place.read(&format!("{day}/lessons.csv"));
        let cells = text.lines().skip(1).map(|line| line.split(',').nth(6).unwrap().to_owned());
        cells.map(|cell| cell.parse::<f64>().unwrap()).sum::<f64>()
    });
    assert!(today > 0.5 && today < 0.5 * yesterday, "{yesterday} {today}");
    // The samples of both days are there, each where its document says.
    let [before, after] =
        ["prior-samples.csv", "soil-samples.csv"].map(|name| place.read(&format!("today/{name}")));
    assert_eq!(before, place.read("yesterday/soil-samples.csv"));
    assert_ne!(before, after);
    assert!(place.read("today/scenario.toml").contains("prior-samples.csv"));
    place.results("check today/soil.toml");
    place.results("check today/scenario.toml");
}
