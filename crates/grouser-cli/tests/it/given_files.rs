//! What files gave: a line of every answer for each file, and among the inputs of JSON.

use serde_json::{Value, json};

use crate::program::Place;

/// Level ground of 6 m by 6 m in cells of 1 m; the south-western one has no height.
fn heights() -> String {
    let points = (0..7).flat_map(|y| (0..7).map(move |x| (x, y)));
    points.map(|(x, y)| format!("{x} {y} {}\n", if x + y == 0 { -99 } else { 2 })).collect()
}

fn area(west: f64, properties: &str) -> String {
    let east = west + 1.0;
    format!(
        r#"{{"type": "Feature", "properties": {{{properties}}}, "geometry": {{"type": "Polygon",
            "coordinates": [[[{west}, 0], [{east}, 0], [{east}, 6], [{west}, 6], [{west}, 0]]]}}}}"#
    )
}

fn areas(all: &[String]) -> String {
    format!(r#"{{"type": "FeatureCollection", "features": [{}]}}"#, all.join(", "))
}

const TERRAIN: &str =
    "[terrain]\nfile = \"map.xyz\"\nmissing_m = -99.0\nsoil_file = \"zones.geojson\"\n";

/// A map, zones of which the drive meets one, one lies beside its way and one off the map.
fn place() -> Place {
    let place = Place::new();
    place.write("map.xyz", heights());
    let zone = |west: f64, soil: &str| area(west, &format!("\"soil\": \"{soil}\""));
    let zones = [zone(3.2, "grc-1"), zone(0.0, "clay"), zone(40.0, "grc-3")];
    place.write("zones.geojson", areas(&zones));
    let run = "schema = \"scenario/1\"\nname = \"a drive\"\nsimulation = \"quasi-steady\"\n";
    place.write("drive.toml", format!("{run}duration_s = 10.0\n{TERRAIN}"));
    let mission = "schema = \"mission/1\"\nname = \"a drive\"\nlegs_from = \"legs.csv\"\n";
    place.write("mission.toml", format!("{mission}{TERRAIN}"));
    place.write("legs.csv", "drive_m,speed_m_s\n0.1,0.05\n0.2,0.05\n");
    place.write("keep-out.geojson", areas(&[area(5.0, ""), area(50.0, "")]));
    place
}

/// The names of files without their folders, and what they gave.
fn files(answer: &Value) -> Vec<Value> {
    let files = answer["inputs"]["files"].as_array().expect("files");
    let without_folder = |file: &Value| {
        let mut file = file.clone();
        let name = file["file"].as_str().expect("a name");
        file["file"] = json!(name.rsplit('/').next());
        file
    };
    files.iter().map(without_folder).collect()
}

fn given(file: &str, content: &str, counted: &str, [there, used]: [u64; 2]) -> Value {
    json!({"file": file, "content": content, "counted": counted, "there": there, "used": used})
}

#[test]
fn a_drive_says_which_zones_it_met_and_which_it_did_not() {
    let place = place();
    let mut zones = given("zones.geojson", "zones of soil", "areas", [3, 2]);
    zones["zones_met"] = json!(["grc-1"]);
    zones["zones_not_met"] = json!(["clay", "grc-3"]);
    let map = given("map.xyz", "heights", "cells", [49, 48]);
    let run = place.json("traverse drive.toml --out run");
    assert_eq!(files(&run), [map.clone(), zones.clone()]);
    let legs = given("legs.csv", "legs", "legs", [2, 2]);
    let mission = place.json("mission mission.toml --samples 4");
    assert_eq!(files(&mission), [map, zones, legs]);

    let line = "zones of soil, 2 of 3 areas; met: grc-1; not met: clay, grc-3";
    for command in ["traverse drive.toml", "mission mission.toml --nominal"] {
        let text = place.line(command).stdout;
        assert!(text.contains("map.xyz: heights, 48 of 49 cells\n"), "{text}");
        assert!(text.contains(line), "{text}");
    }
    assert!(place.read("run/report.html").contains(line));
}

#[test]
fn maps_and_routes_say_what_their_files_gave() {
    let place = place();
    place.write(
        "line.geojson",
        r#"{"type": "LineString", "coordinates": [[2, 2], [3, 3], [4, 3]]}"#,
    );
    let map = given("map.xyz", "heights", "cells", [49, 48]);
    let made = place.json("map map.xyz --missing-m=-99 --samples 2 --out map");
    assert_eq!(files(&made), std::slice::from_ref(&map));
    let route = "route map.xyz --missing-m=-99 --samples 2 --no-drive";
    let way = place.json(&format!("{route} --from 2,2 --to 4,4 --keep-out keep-out.geojson"));
    let areas = given("keep-out.geojson", "areas to keep out of", "areas", [2, 1]);
    assert_eq!(files(&way), [map.clone(), areas]);
    let along = place.json(&format!("{route} --along line.geojson"));
    assert_eq!(files(&along), [map, given("line.geojson", "a way", "places", [3, 3])]);
}

/// Rows that are left out do not count: of a log those without a time, of tests those that are not
/// asked for or say that they failed.
#[test]
fn logs_and_tests_say_how_many_rows_count() {
    let place = place();
    let line = "traverse --rover hakuto --slope-deg 5 --duration-s 20 --telemetry drive.csv";
    assert_eq!(place.line(line).code(), 0);
    let drive = place.read("drive.csv");
    let rows = drive.lines().count() as u64 - 1;
    let cut: Vec<&str> = drive.lines().collect();
    let broken = format!("{}\n{}\n", cut.join("\n"), cut[1]);
    place.write("drive.csv", broken);
    let log = given("drive.csv", "telemetry", "rows", [rows + 1, rows]);
    let replay = place.json("replay drive.csv --soil toyoura");
    assert_eq!(files(&replay), std::slice::from_ref(&log));
    let learnt = place.json("learn drive.csv --prior toyoura-uncertain --samples 10");
    assert_eq!(files(&learnt), [log]);

    place.write(
        "tests.csv",
        "load_n,slip_ratio,drawbar_pull_n,status\n20,0.1,1,ok\n20,0.2,2,ok\n20,0.3,3,stuck\n20,0.4,4,ok\n",
    );
    let tests = given("tests.csv", "wheel tests", "rows", [4, 2]);
    let chosen = "--data tests.csv --wheel hakuto --soil toyoura --where load_n=20";
    let judged = place.json(&format!("validate {chosen} --where slip_ratio=0.1,0.4"));
    assert_eq!(files(&judged), [tests]);

    place.write(
        "plates.csv",
        "plate_width_mm,sinkage_mm,pressure_kpa\n50,-1,0\n50,5,20\n50,10,45\n80,5,18\n80,10,41\n80,15,70\n50,15,80\n",
    );
    let fit = "calibrate --plates plates.csv --plate-law bekker --soil dry-sand --point-fit";
    let found = place.line(&format!("{fit} --format json")).stdout;
    let found = serde_json::from_str(&found).expect("JSON");
    assert_eq!(files(&found), [given("plates.csv", "plate tests", "rows", [7, 6])]);
    let text = place.line(fit).stdout;
    assert!(text.contains("plates.csv: plate tests, 6 of 7 rows"), "{text}");
}

/// Samples that a soil names, limits of a mission that are not its own, and a mapping: each has its
/// line.
#[test]
fn files_that_documents_and_options_name_say_what_they_gave() {
    let place = place();
    let soil = place.results("presets toyoura --kind soil");
    place.write("soil.toml", soil + "[uncertainty]\nsamples = \"samples.csv\"\n");
    place.write("samples.csv", "friction_angle_deg,exit.ratio\n38,1.0\n37,0.9\n36.5,0.95\n");
    let samples = given("samples.csv", "samples of a soil", "rows", [3, 3]);
    let heading = place.json("heading --soil soil.toml --slope-deg 5");
    assert_eq!(files(&heading), std::slice::from_ref(&samples));

    let mission = "schema = \"mission/1\"\nname = \"m\"\nstop_from = \"stops.toml\"\n[stop]\nroll_deg = 20.0\n\
                   [[leg]]\ndrive_m = 0.1\nspeed_m_s = 0.05\n";
    place.write("stopped.toml", mission);
    place.write("stops.toml", "[stop]\nroll_deg = 10.0\nslip_ratio = 0.9\n");
    let driven = place.json("mission stopped.toml --nominal");
    assert_eq!(files(&driven), [given("stops.toml", "limits", "limits", [2, 1])]);

    let line = "traverse --rover hakuto --slope-deg 5 --duration-s 20 --mcap drive.mcap";
    assert_eq!(place.line(line).code(), 0);
    let mapping = place.results("import-telemetry --print-mapping grouser");
    let readings = mapping.matches("[[reading]]").count() as u64 + 1;
    let unknown =
        "\n[[reading]]\ntopic = \"/nowhere\"\nfield = \"x\"\ncolumn = \"x_m\"\noptional = true\n";
    place.write("ours.toml", mapping + unknown);
    let replay = place.json("replay drive.mcap --soil toyoura --mapping ours.toml");
    // A run without motors has no topics of currents; nobody has that of the reading added.
    let found = &files(&replay)[1];
    let used = found["used"].as_u64().expect("a count");
    assert!((1..readings).contains(&used), "{found}");
    assert_eq!(*found, given("ours.toml", "a mapping of telemetry", "readings", [readings, used]));
}
