//! Faults of meaning: one good drive, damaged in every way in which logs are, is refused, warned of or
//! noted, or teaches what the good one teaches.

use std::f64::consts::PI;
use std::fmt::Write as _;

use crate::odd_logs::{by_wheels, drive, times, with_cells};
use crate::program::{Place, number};
use crate::telemetry::LEARN;

/// What `learn` makes of a log.
struct Learnt {
    code: i32,
    /// Quantiles of the slip ratio that it predicts; nothing of a log that is refused.
    slip: Option<[f64; 3]>,
    warnings: Vec<String>,
    notes: Vec<String>,
}

impl Learnt {
    fn of(place: &Place, log: &str) -> Self {
        let answer = place.line(&format!("learn {log} {LEARN} --format json"));
        let found: serde_json::Value = serde_json::from_str(&answer.stdout).unwrap_or_default();
        let texts = |list: &serde_json::Value, key: &str| -> Vec<String> {
            let all = list.as_array().cloned().unwrap_or_default();
            let text =
                |it: &serde_json::Value| if key.is_empty() { it } else { &it[key] }.to_string();
            all.iter().map(text).collect()
        };
        let first = found["predictions"].get(0);
        let slip = first.map(|it| {
            ["slip_ratio_p2_5", "slip_ratio", "slip_ratio_p97_5"].map(|name| number(&it[name]))
        });
        let warnings = texts(&found["warnings"], "evidence").into_iter();
        Self {
            code: answer.code(),
            slip,
            warnings: warnings.chain(texts(&found["contradictions"], "")).collect(),
            notes: texts(&found["notes"], ""),
        }
    }

    /// What becomes of a fault, in a word; nothing where it passes for a good drive.
    fn outcome(&self, good: &Self) -> Option<&'static str> {
        let plain = |note: &String| note.replace(|it: char| it.is_ascii_digit(), "");
        let known: Vec<String> = good.notes.iter().map(plain).collect();
        let [low, _, high] = good.slip.expect("predictions");
        match self.slip {
            None => Some("refused"),
            Some(_) if self.code != 0 => Some("refused"),
            Some(_) if !self.warnings.is_empty() => Some("warned of"),
            Some(_) if self.notes.iter().any(|it| !known.contains(&plain(it))) => Some("noted"),
            Some([_, median, _]) if (low..high).contains(&median) => Some("harmless"),
            Some(_) => None,
        }
    }
}

/// The table with its rows changed.
fn with_rows(text: &str, change: impl Fn(Vec<String>) -> Vec<String>) -> String {
    let (header, rows) = text.split_once('\n').expect("a header");
    let rows = change(rows.lines().map(str::to_owned).collect());
    format!("{header}\n{}\n", rows.join("\n"))
}

/// The table with the names of two columns exchanged.
fn swapped(text: &str, one: &str, other: &str) -> String {
    let (header, rows) = text.split_once('\n').expect("a header");
    let name = |it: &str| {
        if it == one {
            other
        } else if it == other {
            one
        } else {
            it
        }
        .to_owned()
    };
    let header: Vec<String> = header.split(',').map(name).collect();
    format!("{}\n{rows}", header.join(","))
}

/// The table with a column that stays as it is.
fn frozen(text: &str, column: &str, at: f64) -> String {
    with_cells(text, |name, _| (name == column).then_some(at))
}

fn units(text: &str) -> Vec<(&'static str, String)> {
    let angles = |factor: f64| {
        with_cells(text, |name, number| {
            ["roll_deg", "pitch_deg"].contains(&name).then(|| factor * number(name))
        })
    };
    vec![
        ("torques in N·mm", times(text, "wheel_torque", 1e3)),
        ("torques in kN·m", times(text, "wheel_torque", 1e-3)),
        ("wheel speeds in rpm", times(text, "wheel_speed", 30.0 / PI)),
        ("wheel speeds in rad/s as rpm", times(text, "wheel_speed", PI / 30.0)),
        ("wheel speeds in °/s", times(text, "wheel_speed", 180.0 / PI)),
        ("ways in mm", times(text, "vo_d", 1e3)),
        ("ways in m as mm", times(text, "vo_d", 1e-3)),
        ("rotations in radians", times(text, "vo_dyaw", PI / 180.0)),
        ("roll and pitch in radians", angles(PI / 180.0)),
        ("roll and pitch in degrees as radians", angles(180.0 / PI)),
        ("sinkages in µm", times(text, "sinkage", 1e3)),
        ("sinkages in m", times(text, "sinkage", 1e-3)),
        ("times in ms", times(text, "time_s", 1e3)),
        ("times in ks", times(text, "time_s", 1e-3)),
    ]
}

fn signs_and_order(text: &str) -> Vec<(&'static str, String)> {
    let reversed = with_rows(text, |rows| rows.into_iter().rev().collect());
    vec![
        ("torques of the other sign", times(text, "wheel_torque", -1.0)),
        ("roll of the other sign", times(text, "roll_deg", -1.0)),
        ("pitch of the other sign", times(text, "pitch_deg", -1.0)),
        ("yaw of the other sign", times(text, "yaw_deg", -1.0)),
        ("ways forward of the other sign", times(text, "vo_dx", -1.0)),
        ("ways to the side of the other sign", times(text, "vo_dy", -1.0)),
        ("rotations of the other sign", times(text, "vo_dyaw", -1.0)),
        ("a wheel of the other sign", times(text, "wheel_speed_rad_s_front-left", -1.0)),
        ("rows in the opposite order", reversed),
        ("one time", with_cells(text, |name, _| (name == "time_s").then_some(5.0))),
        ("torques of two wheels exchanged", {
            swapped(text, "wheel_torque_nm_front-left", "wheel_torque_nm_rear-right")
        }),
        ("ways exchanged", swapped(text, "vo_dx_m", "vo_dy_m")),
        ("roll and pitch exchanged", swapped(text, "roll_deg", "pitch_deg")),
    ]
}

fn sources_and_loss(text: &str) -> Vec<(&'static str, String)> {
    let some = |keep: fn(usize) -> bool| {
        with_rows(text, |rows| {
            let rows = rows.into_iter().enumerate();
            rows.filter(|(place, _)| keep(*place)).map(|(_, row)| row).collect()
        })
    };
    vec![
        ("odometry of wheels", by_wheels(text)),
        ("odometry of smaller wheels", times(&by_wheels(text), "vo_dx", 0.95)),
        ("a roll that is frozen", frozen(text, "roll_deg", 8.0)),
        ("a pitch that is frozen", frozen(text, "pitch_deg", 0.5)),
        ("a torque that is frozen", frozen(text, "wheel_torque_nm_front-left", 0.2)),
        ("ways that are frozen", frozen(text, "vo_dx_m", 0.0055)),
        ("torques of 0", times(text, "wheel_torque", 0.0)),
        ("names of torques", text.replace("wheel_torque_nm", "effort")),
        ("names of ways", text.replace("vo_d", "odom_d")),
        ("a third of the rows lost", some(|place| place % 3 != 0)),
        ("half of the rows lost at random", some(|place| place * 7919 % 101 < 50)),
    ]
}

#[test]
#[ignore = "it learns forty times"]
fn faults_of_meaning_are_noticed_or_harmless() {
    let (place, text) = drive();
    let good = Learnt::of(&place, "drive.csv");
    assert!(good.code == 0 && good.warnings.is_empty(), "{:?}", good.warnings);
    let (mut table, mut silent) = (String::new(), Vec::new());
    for (name, log) in [units(&text), signs_and_order(&text), sources_and_loss(&text)].concat() {
        place.write("damaged.csv", log);
        let found = Learnt::of(&place, "damaged.csv");
        let outcome = found.outcome(&good);
        let median = found.slip.map_or(f64::NAN, |it| it[1]);
        let said: String =
            found.warnings.first().cloned().unwrap_or_default().chars().take(70).collect();
        let word = outcome.unwrap_or("SILENT");
        let _ = writeln!(table, "{name:40} {word:10} slip {median:6.3}  {said}");
        silent.extend(outcome.is_none().then_some(name));
    }
    println!("good: {:?}\n{table}", good.slip);
    assert_eq!(silent, Vec::<&str>::new(), "{table}");
}
