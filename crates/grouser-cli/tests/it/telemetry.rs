//! Telemetry of logs of any kind: the same drive teaches the same, whatever it is written as.

use crate::program::{Place, number};

pub(crate) const RUN: &str = "traverse --rover hakuto --soil toyoura --set soil.shear.lateral_m=0.022 \
                   --slope-deg 8 --set soil.shear.longitudinal_m=0.05 --set \
                   scenario.start.yaw_deg=4 --simulation quasi-steady --duration-s 30";
pub(crate) const LEARN: &str =
    "--prior toyoura-uncertain --rover hakuto --model ishigami --predict-slope-deg 10 --samples 20";

/// What `learn` predicts after a log.
fn yaw_after(place: &Place, log: &str) -> f64 {
    let answer = place.json(&format!("learn {log} {LEARN}"));
    number(&answer["predictions"][0]["yaw_deg"])
}

/// What an import that ends well prints; its notes go to the standard error.
fn imported(place: &Place, line: &str) -> String {
    let answer = place.line(&format!("import-telemetry {line}"));
    assert_eq!(answer.code(), 0, "{line}: {}", answer.stderr);
    assert!(answer.stderr.contains("records of telemetry"), "{line}: {}", answer.stderr);
    answer.stdout
}

#[test]
fn a_drive_teaches_the_same_from_mcap_csv_and_parquet() {
    let place = Place::new();
    place.results(&format!("{RUN} --mcap drive.mcap"));
    for out in ["drive.csv", "drive.parquet"] {
        imported(&place, &format!("drive.mcap --rover hakuto --out {out}"));
    }
    let expected = yaw_after(&place, "drive.mcap");
    // All but the last digits, which degrees and radians change.
    for log in ["drive.csv", "drive.parquet"] {
        let found = yaw_after(&place, log);
        assert!((found - expected).abs() < 1e-6, "{log}: {found} for {expected}");
    }
    // What is printed is what the file has, and Parquet is a table again.
    let printed = imported(&place, "drive.parquet --rover hakuto");
    let rows = |text: &str| text.lines().count();
    assert_eq!(rows(&printed), rows(&place.read("drive.csv")));
}

/// A table in Parquet is read by the mapping that reads the same one in CSV.
#[test]
fn parquet_is_read_by_a_mapping_as_csv_is() {
    let place = Place::new();
    place.results(&format!("{RUN} --telemetry drive.csv"));
    imported(&place, "drive.csv --rover hakuto --out drive.parquet");
    let reading = |column: &str, unit: &str| {
        format!(
            "[[reading]]\ntopic = \"/\"\nfield = \"{column}\"\nunit = \"{unit}\"\ncolumn = \"{column}\"\n"
        )
    };
    let columns = [("roll_deg", "rad"), ("pitch_deg", "deg"), ("vo_dx_m", "mm")];
    let readings: String =
        columns.into_iter().map(|(column, unit)| reading(column, unit)).collect();
    let head = "schema = \"telemetry-mapping/1\"\nname = \"ours\"\nodometry = \"fused\"\n";
    place.write("ours.toml", head.to_owned() + &readings);
    let [csv, parquet] = ["drive.csv", "drive.parquet"]
        .map(|log| imported(&place, &format!("{log} --rover hakuto --mapping ours.toml")));
    let cells = |text: &str| -> Vec<f64> {
        text.lines().skip(1).flat_map(|it| it.split(',')).filter_map(|it| it.parse().ok()).collect()
    };
    let (one, other) = (cells(&csv), cells(&parquet));
    assert!(one.len() > 100 && one.len() == other.len(), "{} {}", one.len(), other.len());
    // Parquet has the angles in all their digits.
    assert!(one.iter().zip(&other).all(|(one, other)| (one - other).abs() < 1e-6));
}

#[test]
fn what_cannot_be_imported_says_what_to_do() {
    let place = Place::new();
    place.write("bag.db3", b"SQLite format 3\0");
    place.write("drive.feather", b"FEA1\0\0\0\0");
    place.write("drive.arrow", b"ARROW1\0\0\xff\xff\xff\xff");
    place.write("drive.csv", "time_s,roll_deg\n1,2\n");
    place.write("empty.csv", "time_s,roll_deg\n");
    place.write("wrong.toml", "schema = \"telemetry-mapping/1\"\nname = \"x\"\nreading = []\n");
    for (line, part) in [
        ("import-telemetry bag.db3", "python -m grouser import-telemetry"),
        ("import-telemetry nowhere.mcap", "there is no such file"),
        (
            "import-telemetry drive.csv --mapping ros",
            "reads none of its columns, which are time_s, roll_deg; it looks for",
        ),
        ("import-telemetry drive.csv --topic a=b", "which is read by the names of its columns"),
        (
            "import-telemetry drive.csv --mapping wrong.toml",
            "wrong.toml:3:11: `reading` has 0 entries, it must have 1 or more",
        ),
        ("import-telemetry drive.csv --mapping nowhere.toml", "did you mean `wrong.toml`?"),
        ("import-telemetry drive.csv --mapping zzz", "grouser, ros, foxglove"),
        ("import-telemetry drive.csv --topic imu", "is not of the form TYPE=TOPIC"),
        ("import-telemetry empty.csv", "has no rows of telemetry"),
        ("import-telemetry --print-mapping none", "it is one of grouser, ros, foxglove"),
        ("learn bag.db3 --prior toyoura-uncertain", "python -m grouser import-telemetry"),
        ("replay drive.arrow", "no Arrow that can be read: it has no description of its columns"),
        ("replay drive.feather", "pandas.read_feather('LOG').to_parquet('drive.parquet')"),
    ] {
        let answer = place.line(line);
        assert_eq!(answer.code(), 2, "{line}: {}", answer.stderr);
        assert!(answer.stderr.contains(part), "{line}: {}", answer.stderr);
    }
    let mapping = place.results("import-telemetry --print-mapping ros");
    place.write("ours.toml", mapping);
    let answer = place.line("import-telemetry drive.csv --mapping ours.toml");
    assert!(answer.stderr.contains("reads none of its columns"), "{}", answer.stderr);
}

/// Files of one drive, in whatever order they are named, teach what the whole does.
#[test]
fn a_drive_may_be_several_files() {
    let place = Place::new();
    place.results(&format!("{RUN} --telemetry drive.csv --mcap drive.mcap"));
    let table = place.read("drive.csv");
    let (header, rows) = table.split_once('\n').expect("a header");
    let rows: Vec<&str> = rows.lines().collect();
    for (name, part) in
        ["a.csv", "b.csv", "c.csv"].into_iter().zip(rows.chunks(rows.len().div_ceil(3)))
    {
        place.write(name, format!("{header}\n{}\n", part.join("\n")));
    }
    let (whole, parts) = (yaw_after(&place, "drive.csv"), yaw_after(&place, "c.csv a.csv b.csv"));
    // A way over a border is not known, where a table does not say since when it is.
    assert!((whole - parts).abs() < 0.1, "{parts} for {whole}");
    let answer = place.json(&format!("learn c.csv a.csv b.csv {LEARN}"));
    let files = answer["inputs"]["files"].as_array().expect("files").iter();
    let used: f64 =
        files.clone().filter(|it| it["content"] == "telemetry").map(|it| number(&it["used"])).sum();
    assert!((used - rows.len() as f64).abs() < 0.5, "{used} of {}", rows.len());
    let names: Vec<_> = files.map(|it| it["file"].as_str().unwrap_or_default()).collect();
    assert_eq!(names[..3], ["a.csv", "b.csv", "c.csv"]);
    let answer =
        place.json("replay b.csv c.csv a.csv --rover hakuto --soil toyoura --model ishigami");
    assert_eq!(answer["inputs"]["log"], "b.csv, c.csv, a.csv");
    let joined = imported(&place, "b.csv a.csv c.csv --rover hakuto");
    assert_eq!(joined.lines().count(), table.lines().count());
    // A folder of MCAP needs nothing that says what is in it.
    std::fs::create_dir(place.file("bag")).expect("a folder");
    place.write("bag/drive_0.mcap", std::fs::read(place.file("drive.mcap")).expect("it is there"));
    let [log, folder] =
        ["drive.mcap", "bag"].map(|log| imported(&place, &format!("{log} --rover hakuto")));
    assert_eq!(log, folder);
    for (line, part) in [
        (
            "learn a.csv b.csv --follow --prior toyoura-uncertain",
            "--follow: a.csv and 1 more: one log is followed",
        ),
        ("learn a.csv - --prior toyoura-uncertain", "standard input (-) is a log alone"),
        ("replay a.csv drive.csv --rover hakuto", "files of one drive follow one another"),
        ("import-telemetry a.csv nowhere.csv --rover hakuto", "nowhere.csv: there is no such file"),
        ("slip-from-current a.csv b.csv", "unexpected argument 'b.csv'"),
    ] {
        let answer = place.line(line);
        assert_eq!(answer.code(), 2, "{line}: {}", answer.stderr);
        assert!(answer.stderr.contains(part), "{line}: {}", answer.stderr);
    }
}
