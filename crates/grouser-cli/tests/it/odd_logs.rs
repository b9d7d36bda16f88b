//! Logs and maps as people have them: read as they are, or refused in words that help.

use crate::program::{Place, number};
use crate::telemetry::{LEARN, RUN};

/// A drive as a table, in a place.
fn drive() -> (Place, String) {
    let place = Place::new();
    place.results(&format!("{RUN} --telemetry drive.csv"));
    let text = place.read("drive.csv");
    (place, text)
}

/// The slip that `learn` predicts after a log.
fn slip_after(place: &Place, log: &str) -> f64 {
    let answer = place.line(&format!("learn {log} {LEARN} --format json"));
    assert_eq!(answer.code(), 0, "{log}: {}", answer.stderr);
    let answer: serde_json::Value = serde_json::from_str(&answer.stdout).expect("JSON");
    number(&answer["predictions"][0]["slip_ratio"])
}

/// The table with another cell for the time in each row.
fn with_times(text: &str, time: impl Fn(f64) -> String) -> String {
    let (header, rows) = text.split_once('\n').expect("a header");
    let row = |line: &str| {
        let (first, rest) = line.split_once(',').expect("cells");
        format!("{},{rest}\n", time(first.parse().expect("a time")))
    };
    format!("{header}\n{}", rows.lines().map(row).collect::<String>())
}

/// The table with its units below the names, in others: milliseconds, millimetres, radians and rpm.
fn with_units_below(text: &str) -> String {
    const UNITS: [(&str, &str, f64); 6] = [
        ("time_s", "ms", 1e3),
        ("_rad_s", "rpm", 30.0 / std::f64::consts::PI),
        ("_deg", "rad", std::f64::consts::PI / 180.0),
        ("_nm", "N·m", 1.0),
        ("_mm", "mm", 1.0),
        ("_m", "mm", 1e3),
    ];
    let unit = |name: &str| UNITS.into_iter().find(|(ending, ..)| name.contains(ending));
    let scaled =
        with_cells(text, |name, number| unit(name).map(|(.., factor)| factor * number(name)));
    let (header, rows) = scaled.split_once('\n').expect("a header");
    let bare = |name: &str| match unit(name) {
        Some(("time_s", ..)) => "t".to_owned(),
        Some((ending, ..)) => name.replacen(ending, "", 1),
        None => name.to_owned(),
    };
    let names: Vec<String> = header.split(',').map(bare).collect();
    let units = header.split(',').map(|name| unit(name).map_or("", |(_, unit, _)| unit));
    format!("{}\n{}\n{rows}", names.join(","), units.collect::<Vec<_>>().join(","))
}

/// The table with a word in each cell that is empty.
fn without_gaps(text: &str) -> String {
    let cell = |cell: &str| if cell.is_empty() { "nan" } else { cell }.to_owned();
    let line = |line: &str| line.split(',').map(cell).collect::<Vec<_>>().join(",") + "\n";
    text.lines().map(line).collect()
}

/// Times in which no drive goes on: what they are is said.
#[test]
fn times_of_other_orders_and_clocks_are_named() {
    let (place, text) = drive();
    let date =
        |time: f64| format!("29/11/2026 10:{:02}:{:06.3}", (time / 60.0).floor(), time % 60.0);
    place.write("day.csv", with_times(&text, date));
    let (header, rows) = text.split_once('\n').expect("a header");
    let falling: String = rows.lines().rev().map(|line| format!("{line}\n")).collect();
    place.write("newest.csv", format!("{header}\n{falling}"));
    for (log, code, part) in
        [("day.csv", 2, "hint: ISO 8601 is read"), ("newest.csv", 1, "sorted newest first")]
    {
        let answer = place.line(&format!("learn {log} {LEARN}"));
        let said = answer.stdout.clone() + &answer.stderr;
        assert!(answer.code() == code && said.contains(part), "{log}: {said}");
    }
    let rounded = with_times(&text, |time| format!("{:.1}", (5.0 * time).floor() / 5.0));
    place.write("rounded.csv", rounded);
    let answer = place.line("import-telemetry rounded.csv --out rounded.parquet");
    assert!(answer.code() == 0 && answer.stderr.contains("rounded to 0.2 s"), "{}", answer.stderr);
}

/// Motors of one side that are mounted the other way round turn no rover on the spot.
#[test]
fn mirrored_sides_are_named_and_no_replay_succeeds() {
    let (place, text) = drive();
    let front = times(&text, "wheel_speed_rad_s_front-right", -1.0);
    place.write("mirrored.csv", times(&front, "wheel_speed_rad_s_rear-right", -1.0));
    for command in
        [format!("learn mirrored.csv {LEARN}"), "replay mirrored.csv --soil toyoura".to_owned()]
    {
        let answer = place.line(&command);
        let said = answer.stdout.clone() + &answer.stderr;
        assert_eq!(answer.code(), 1, "{command}: {said}");
        assert!(said.contains("all wheels of the right side turn backward"), "{command}: {said}");
    }
}

#[test]
fn units_that_a_column_cannot_have_are_refused_by_its_name() {
    let place = Place::new();
    for (table, part) in [
        ("t,roll\ns,m\n0,1\n", "`roll` has m below its name, which must be one of deg, rad"),
        ("time_s,roll_deg\ns,rad\n0,1\n", "`roll_deg` has rad below its name"),
        ("t,roll\nfortnights,deg\n0,1\n", "`t` has fortnights below its name"),
    ] {
        place.write("drive.csv", table);
        let answer = place.line("learn drive.csv --prior toyoura-uncertain");
        assert_eq!(answer.code(), 2, "{table}");
        assert!(answer.stderr.contains(part), "{}", answer.stderr);
    }
}

#[test]
fn a_table_is_read_however_it_is_written() {
    let (place, text) = drive();
    let expected = slip_after(&place, "drive.csv");
    let epoch = 1_700_000_000.0;
    let date = |time: f64| {
        let [minutes, seconds] = [(time / 60.0).floor(), time % 60.0];
        format!("2026-11-26T10:{minutes:02}:{seconds:06.3}Z")
    };
    for (name, table) in [
        ("semicolons", text.replace('.', "|").replace(',', ";").replace('|', ",")),
        ("tabs", text.replace(',', "\t")),
        ("bars", text.replace(',', " | ")),
        ("spaces", without_gaps(&text).replace(',', "  ")),
        ("comments", format!("# a drive in sand, by hand\n#\n{text}# the end\n")),
        ("behind", format!("# {text}")),
        ("units", with_units_below(&text)),
        ("dates", with_times(&text, date)),
        ("nanoseconds", with_times(&text, |time| format!("{:.0}", (epoch + time) * 1e9))),
        ("milliseconds", with_times(&text, |time| format!("{:.0}", (epoch + time) * 1e3))),
        (
            "named",
            with_times(&text, |time| format!("{:.0}", time * 1e3)).replacen("time_s", "time_ms", 1),
        ),
    ] {
        let log = format!("{name}.csv");
        place.write(&log, table);
        let found = slip_after(&place, &log);
        assert!((found - expected).abs() < 1e-3, "{name}: {found} for {expected}");
    }
}

/// Times that were rounded to a fifth of a second leave every second row without one of its own: its
/// way is not lost.
#[test]
fn ways_of_rows_that_share_a_time_are_kept() {
    let (place, text) = drive();
    let expected = slip_after(&place, "drive.csv");
    place.write(
        "rounded.csv",
        with_times(&text, |time| format!("{:.1}", (5.0 * time).floor() / 5.0)),
    );
    let found = slip_after(&place, "rounded.csv");
    assert!((found - expected).abs() < 0.03, "{found} for {expected}");
    // Rows without a time are handed on, too; a row that nobody can read breaks the way.
    for (name, every, cell) in [("holes", 7, ""), ("broken", 5, "x,y,z,")] {
        let (header, rows) = text.split_once('\n').expect("a header");
        let row = |(place, line): (usize, &str)| match line.split_once(',') {
            Some((_, rest)) if place % every == 3 => format!("{cell},{rest}\n"),
            _ => format!("{line}\n"),
        };
        let table: String = rows.lines().enumerate().map(row).collect();
        place.write(&format!("{name}.csv"), format!("{header}\n{table}"));
        let found = slip_after(&place, &format!("{name}.csv"));
        assert!((found - expected).abs() < 0.03, "{name}: {found} for {expected}");
    }
}

/// What taught nothing, has nothing or lost most ends so.
#[test]
fn an_outcome_has_its_exit_code() {
    let (place, text) = drive();
    place.write("nothing.csv", with_times(&text, |_| "soon".to_owned()));
    let answer = place.line(&format!("learn nothing.csv {LEARN} --out out"));
    assert!(
        answer.code() == 1 && answer.stderr.contains("nothing was learnt"),
        "{}",
        answer.stderr
    );
    assert!(!place.file("out/soil.toml").exists());
    place.write("other.csv", "time_s,voltage,mood\n0,1,2\n1,2,3\n");
    for command in [
        "learn other.csv --prior toyoura-uncertain",
        "import-telemetry other.csv",
        "replay other.csv",
    ] {
        let answer = place.line(command);
        let says = |part: &str| answer.stderr.contains(part);
        assert!(
            answer.code() == 2 && says("voltage, mood") && says("wheel_torque_nm"),
            "{command}: {}",
            answer.stderr
        );
    }
    // Of three rows the first two are damaged.
    let (header, rows) = text.split_once('\n').expect("a header");
    let count = rows.lines().count();
    let damaged = |(place, line): (usize, &str)| {
        if 3 * place < 2 * count { format!("{line},1,2,3\n") } else { format!("{line}\n") }
    };
    let table: String = rows.lines().enumerate().map(damaged).collect();
    place.write("most.csv", format!("{header}\n{table}"));
    let learn = format!("learn most.csv {LEARN}");
    for command in [learn.as_str(), "import-telemetry most.csv", "replay most.csv"] {
        let answer = place.line(command);
        assert!(
            answer.code() == 3 && answer.stderr.contains("--accept-loss"),
            "{command}: {}",
            answer.stderr
        );
        assert_eq!(place.line(&format!("{command} --accept-loss")).code(), 0, "{command}");
    }
}

/// A pipe without a writer would be waited for.
#[cfg(unix)]
#[test]
fn no_input_is_waited_for() {
    let place = Place::new();
    assert_eq!(place.shell("mkfifo f.tif").code(), 0);
    for command in [
        "map f.tif --out o",
        "route f.tif --from 0,0 --to 1,1",
        "traverse --terrain f.tif",
        "import-telemetry f.tif",
        "learn f.tif --prior toyoura-uncertain",
        "replay f.tif",
    ] {
        let answer = place.line(command);
        assert!(
            answer.code() == 2 && answer.stderr.contains("pipe"),
            "{command}: {}",
            answer.stderr
        );
    }
}

/// Degrees of longitude and latitude are no metres, on ground without an end and from the start of a
/// mission, too.
#[test]
fn degrees_are_not_taken_for_metres() {
    let place = Place::new();
    let polygon = |corners: &str| {
        format!(
            "{{\"type\":\"FeatureCollection\",\"features\":[{{\"type\":\"Feature\",\
             \"properties\":{{\"soil\":\"clay\"}},\"geometry\":{{\"type\":\"Polygon\",\
             \"coordinates\":[[{corners}]]}}}}]}}"
        )
    };
    place.write("z.geojson", polygon("[138.1,35.2],[138.2,35.2],[138.2,35.3],[138.1,35.2]"));
    place.write("near.geojson", polygon("[1,-2],[3,-2],[3,2],[1,-2]"));
    let scenario = |zones: &str| {
        format!(
            "schema = \"scenario/1\"\nname = \"z\"\nsoil = \"toyoura\"\n\
             simulation = \"quasi-steady\"\nduration_s = 5.0\n[terrain]\nsurface = \"incline\"\nslope_deg = 5.0\ndirection_deg = 90.0\n\
             soil_file = \"{zones}\"\n"
        )
    };
    place.write("z.toml", scenario("z.geojson"));
    let answer = place.line("traverse z.toml");
    assert!(answer.code() == 2 && answer.stderr.contains("degrees"), "{}", answer.stderr);
    place.write("near.toml", scenario("near.geojson"));
    assert_eq!(
        place.line("traverse near.toml").code(),
        0,
        "{}",
        place.line("traverse near.toml").stderr
    );

    let way = |crs: &str| {
        format!(
            "{{\"type\":\"FeatureCollection\",{crs}\"features\":[{{\"type\":\"Feature\",\
             \"geometry\":{{\"type\":\"LineString\",\"coordinates\":\
             [[8.4,49.0],[8.40001,49.0]]}},\"properties\":{{}}}}]}}"
        )
    };
    place.write("m.toml", "schema = \"mission/1\"\nname = \"m\"\nslope_deg = 5.0\n");
    place.write("way.geojson", way(""));
    let mission = "mission m.toml --nominal --simulation quasi-steady --legs-from way.geojson";
    let answer = place.line(mission);
    assert!(answer.code() == 2 && answer.stderr.contains("degrees"), "{}", answer.stderr);
    assert!(answer.stderr.contains("hint: ogr2ogr"), "{}", answer.stderr);
    let metres = "\"crs\":{\"type\":\"name\",\"properties\":{\"name\":\"EPSG:32632\"}},";
    place.write("way.geojson", way(metres));
    assert_eq!(place.line(mission).code(), 0, "{}", place.line(mission).stderr);
}

/// A way in degrees, or on another map, is refused by the name of its file; and who types flags is
/// answered in flags.
#[test]
fn messages_name_files_and_flags_that_were_given() {
    let place = Place::new();
    let ground = |west: f64, south: f64, height: &dyn Fn(usize, usize) -> f64| -> String {
        let rows = (0..12).flat_map(|row| (0..12).map(move |column| (row, column)));
        rows.map(|(row, column)| {
            let [x, y] = [west + column as f64, south + row as f64];
            format!("{x} {y} {}\n", height(row, column))
        })
        .collect()
    };
    place.write("far.xyz", ground(500_000.0, 5_400_000.0, &|_, _| 0.0));
    place.write("void.xyz", ground(0.0, 0.0, &|row, _| if row == 11 { -9999.0 } else { 0.0 }));
    let line = |x: f64| {
        format!("{{\"type\":\"LineString\",\"coordinates\":[[{x},49.0],[{},49.1]]}}", x + 0.1)
    };
    place.write("degrees.geojson", line(8.4));
    place.write("elsewhere.geojson", line(1000.0));
    let parts = "--rover hakuto --soil toyoura";
    for (way, part) in [("degrees", "look like degrees"), ("elsewhere", "is not on the map")] {
        let answer =
            place.line(&format!("route far.xyz {parts} --samples 2 --along {way}.geojson"));
        let says = |part: &str| answer.stderr.contains(part);
        assert_eq!(answer.code(), 2, "{way}");
        assert!(says(&format!("error: {way}.geojson: ")) && says(part), "{}", answer.stderr);
    }
    let run = format!("traverse {parts} --duration-s 0.5 --simulation quasi-steady");
    for (flags, part) in [
        ("--terrain void.xyz", "? `--set scenario.terrain.missing_m=-9999` takes them as such"),
        ("--terrain far.xyz --start-x-m 5 --start-y-m 5", "x of the start, on a map from 500000"),
        ("--ground-speed-m-s 0.1", "hint: it goes with --drive \"eq18"),
    ] {
        let answer = place.line(&format!("{run} {flags}"));
        assert!(answer.stderr.contains(part), "{flags}: {}", answer.stderr);
    }
}

/// How a mission ends is its result, whatever it is.
#[test]
fn a_mission_that_ends_early_has_succeeded_as_a_command() {
    let place = Place::new();
    let arc = "arc = { radius_m = 0.5, angle_deg = 90.0 }";
    let mission = |slope: f64| {
        format!(
            "schema = \"mission/1\"\nname = \"arc\"\nrover = \"hakuto\"\nsoil = \"toyoura\"\nslope_deg = \
             {slope:.1}\n[[leg]]\n{arc}\n"
        )
    };
    let mut outcomes = Vec::new();
    for slope in [0.0, 12.0, 16.0, 24.0] {
        place.write("arc.toml", mission(slope));
        let answer = place.line("mission arc.toml --nominal --format json");
        assert_eq!(answer.code(), 0, "{slope}: {}", answer.stderr);
        let answer: serde_json::Value = serde_json::from_str(&answer.stdout).expect("JSON");
        outcomes.push(answer["outcome"].to_string());
    }
    outcomes.dedup();
    assert!(outcomes.len() > 1, "{outcomes:?}");
}

/// A table whose cells are others.
///
/// * `cell`: of each row, by the name of a column, what it becomes; nothing to leave it
fn with_cells(text: &str, cell: impl Fn(&str, &dyn Fn(&str) -> f64) -> Option<f64>) -> String {
    let (header, rows) = text.split_once('\n').expect("a header");
    let names: Vec<&str> = header.split(',').collect();
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |name: &str| {
            let place = names.iter().position(|it| *it == name).expect("a column");
            cells[place].parse().unwrap_or(f64::NAN)
        };
        let new = names.iter().zip(&cells).map(|(name, old)| {
            cell(name, &number).map_or_else(
                || (*old).to_owned(),
                |it| {
                    if it.is_nan() { String::new() } else { it.to_string() }
                },
            )
        });
        new.collect::<Vec<_>>().join(",") + "\n"
    };
    format!("{header}\n{}", rows.lines().map(row).collect::<String>())
}

/// The same with each column of a name that begins so multiplied.
fn times(text: &str, column: &str, factor: f64) -> String {
    with_cells(text, |name, number| name.starts_with(column).then(|| factor * number(name)))
}

/// The drive with odometry that is the turning of its wheels.
fn by_wheels(text: &str) -> String {
    /// Rims of the preset at the tips of their grousers [m].
    const RADIUS: f64 = 0.11;
    let wheels = ["front-left", "front-right", "rear-left", "rear-right"];
    let times: Vec<f64> =
        text.lines().skip(1).filter_map(|it| it.split(',').next()?.parse().ok()).collect();
    let step = times[1] - times[0];
    with_cells(text, |name, number| match name {
        "vo_dx_m" => {
            let read = wheels.map(|wheel| number(&format!("wheel_speed_rad_s_{wheel}")));
            let read: Vec<f64> = read.into_iter().filter(|it| it.is_finite()).collect();
            Some(RADIUS * step * read.iter().sum::<f64>() / read.len() as f64)
        }
        "vo_dy_m" | "vo_dyaw_deg" => Some(0.0),
        _ => None,
    })
}

/// What `learn` answers, whatever its exit code is.
fn learnt(place: &Place, log: &str) -> serde_json::Value {
    let answer = place.line(&format!("learn {log} {LEARN} --format json"));
    serde_json::from_str(&answer.stdout).unwrap_or_else(|_| panic!("{}", answer.stderr))
}

/// Odometry of wheels makes every sand a road: it is named, and nothing of it is learnt.
#[test]
fn wheel_odometry_is_named_and_tells_no_slip() {
    let (place, text) = drive();
    let expected = slip_after(&place, "drive.csv");
    place.write("wheels.csv", by_wheels(&text));
    let check_band = |answer: &serde_json::Value| {
        let of = |name: &str| number(&answer["predictions"][0][name]);
        let (low, high) = (of("slip_ratio_p2_5"), of("slip_ratio_p97_5"));
        assert!(low < expected && expected < high, "{low} to {high} for {expected}");
    };
    let answer = learnt(&place, "wheels.csv");
    let warnings = answer["warnings"].to_string();
    assert!(warnings.contains("wheel odometry"), "{warnings}");
    check_band(&answer);
    // Who says so is not warned.
    let answer = learnt(&place, "wheels.csv --odometry wheels");
    assert!(answer["notes"].to_string().contains("odometry is that of wheels"), "{answer}");
    assert_eq!(answer["warnings"].to_string(), "[]");
    check_band(&answer);
    // What cameras see is not taken for it.
    let answer = learnt(&place, "drive.csv");
    assert_eq!(answer["warnings"].to_string(), "[]");
    let replayed = place.json("replay wheels.csv --rover hakuto --soil toyoura --model ishigami");
    let first = replayed["points_to"][0].as_str().expect("a sentence");
    assert!(first.starts_with("wheel odometry"), "{first}");
}

/// A unit that is taken for another is named by its factor, by `learn` and `replay` alike, the
/// larger it is the more.
#[test]
fn gross_faults_are_named_by_their_factors() {
    let (place, text) = drive();
    let replay = |log: &str| {
        let line = format!("replay {log} --rover hakuto --soil toyoura --model ishigami");
        place.json(&line)["points_to"].to_string()
    };
    place.write("drive.csv", &text);
    assert!(!replay("drive.csv").contains("left out"), "a healthy drive");
    for (column, factor, named) in [
        ("wheel_torque_nm", 1e3, "N·mm, or mA, taken for N·m, or A are: a factor of 1000"),
        ("wheel_torque_nm", 1e-3, "a factor of 1/1000"),
        ("wheel_torque_nm", -1.0, "torque: torques, or currents, have another sign"),
        (
            "wheel_speed_rad_s",
            30.0 / std::f64::consts::PI,
            "rpm taken for rad/s are: a factor of 1/9.55",
        ),
        ("wheel_speed_rad_s", std::f64::consts::PI / 30.0, "taken for rpm are: a factor of 9.55"),
        ("vo_d", 1e3, "ways in mm taken for m are: a factor of 1000"),
        ("sinkage_mm", 1e3, "µm taken for mm are: a factor of 1000"),
    ] {
        let log = format!("{column}-{factor}.csv");
        place.write(&log, times(&text, column, factor));
        let found = replay(&log);
        assert!(found.contains(named), "{log}: {found}");
        let warnings = learnt(&place, &log)["warnings"].to_string();
        assert!(warnings.contains(named), "{log}: {warnings}");
    }
}

/// What contradicts itself is in the soil's document, and no card is made of it unless it is asked
/// for by name.
#[test]
fn a_soil_that_contradicts_itself_makes_no_card_unasked() {
    let (place, text) = drive();
    place.write("large.csv", times(&text, "wheel_torque_nm", 1e3));
    // Across a slope a rover that hardly drifts: on no soil of the prior does it.
    place.write("straight.csv", times(&text, "vo_dy_m", 0.05));
    for (log, named) in
        [("drive", None), ("large", Some("torque:")), ("straight", Some("its prior"))]
    {
        place.line(&format!("learn {log}.csv {LEARN} --out {log}"));
        let soil = place.read(&format!("{log}/soil.toml"));
        let card = format!("card --rover hakuto --soil {log}/soil.toml --samples 2");
        let Some(named) = named else {
            assert!(!soil.contains("contradictions"), "{soil}");
            continue;
        };
        assert!(soil.contains("contradictions") && soil.contains(named), "{log}: {soil}");
        let answer = place.line(&card);
        let says = |part: &str| answer.stderr.contains(part);
        assert!(
            answer.code() == 2 && says(named) && says("--accept-contradiction"),
            "{log}: {}",
            answer.stderr
        );
        assert_eq!(place.line(&format!("{card} --accept-contradiction")).code(), 0, "{log}");
    }
}
