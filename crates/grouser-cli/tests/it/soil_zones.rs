//! Zones of soil on ground with heights: from classes and polygons, with their legend, in runs,
//! missions and campaigns.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::bad_input::check_is_refusal;
use crate::program::{Place, number};

/// Level ground of 10 m by 10 m about x 1005 m, y 2005 m, as text, each point with a number.
fn raster(number: impl Fn(f64, f64) -> f64) -> String {
    let points = (0..=40).flat_map(|row| (0..=40).map(move |column| [column, row]));
    let line = |at: [u32; 2]| {
        let [x, y] = at.map(|cells| 0.25 * f64::from(cells));
        format!("{} {} {}\n", 1000.0 + x, 2000.0 + y, number(x, y))
    };
    points.map(line).collect()
}

/// Classes: 1 in the west, 2 in the north-east, 7 in the south-east. The rover starts in the
/// middle, in 1.
fn classes() -> String {
    raster(|x, y| match (x < 5.4, y < 4.0) {
        (true, _) => 1.0,
        (false, true) => 7.0,
        (false, false) => 2.0,
    })
}

/// The same border as a polygon.
fn polygon(properties: &str) -> String {
    format!(
        r#"{{"type": "Feature", "properties": {{{properties}}}, "geometry": {{"type": "Polygon", "coordinates":
            [[[1005.375, 2003.875], [1011, 2003.875], [1011, 2011], [1005.375, 2011], [1005.375, 2003.875]]]}}}}"#
    )
}

/// A drive to the east out of class 1 into class 2.
const DRIVE: &str = "schema = \"scenario/1\"\nname = \"zones\"\nsimulation = \"quasi-steady\"\nduration_s = 15.0\n\
    [terrain]\nsurface = \"map\"\nfile = \"map.xyz\"\n";
const LEGEND: &str = "soil_file = \"classes.xyz\"\n[[terrain.zone]]\nclass = 1\n\
    [[terrain.zone]]\nclass = 2\nsoil = \"grc-1\"\n[[terrain.zone]]\nclass = 7\nsoil = \"clay\"\n";

fn place() -> Place {
    let place = Place::new();
    place.write("map.xyz", raster(|_, _| 3.0));
    place.write("classes.xyz", classes());
    place.write("plain.toml", DRIVE);
    place.write("zones.toml", format!("{DRIVE}{LEGEND}"));
    place
}

fn way(run: &Value) -> f64 {
    number(&run["final"]["x_m"]) - 1005.0
}

fn sinkage(sample: &Value, wheel: usize) -> f64 {
    number(&sample["wheels"][wheel]["sinkage_mm"])
}

/// Each wheel has the soil below it: at the start all the scenario's own, at the end all that of
/// the zone.
#[test]
fn wheels_meet_the_soil_of_their_zone() {
    let place = place();
    let run = place.json("traverse zones.toml");
    let plain = place.json("traverse plain.toml");
    let all_soft = place.json("traverse plain.toml --soil grc-1 --model ishigami");
    assert!(way(&run) > 0.4, "{}", way(&run));
    let samples = run["samples"].as_array().expect("samples");
    for (wheel, is_front) in [(0, true), (1, false)] {
        let [start, own] = [&samples[0], &plain["samples"][0]].map(|it| sinkage(it, wheel));
        assert_eq!(start, own);
        let [end, soft] = [&run["final"], &all_soft["final"]].map(|it| sinkage(it, wheel));
        assert!((end / soft - 1.0).abs() < 0.02, "{wheel}, {is_front}: {end} and {soft}");
        assert!((soft / own - 1.0).abs() > 0.2, "{soft} and {own}");
    }
    // Flags are those of the soils that wheels come to.
    let has = |run: &Value| run["flags"].to_string().contains("assumed");
    assert!(has(&run) && !has(&plain), "{} {}", run["flags"], plain["flags"]);
}

/// The folder of a run has all soils; one of a zone is set by its place, as all numbers are.
#[test]
fn a_folder_repeats_a_drive_over_zones() {
    let place = place();
    let first = place.json("traverse zones.toml --out out");
    let again = place.json("traverse out/scenario.toml");
    assert_eq!(first["final"], again["final"]);
    let page = place.read("out/report.html");
    assert!(page.contains("soil by zone: ") && page.contains("classes.xyz"));
    let set = "--set scenario.terrain.zone.1.soil.friction_angle_deg=24";
    let weaker = place.json(&format!("traverse zones.toml {set}"));
    assert!(way(&weaker) < way(&first) - 0.005, "{} and {}", way(&weaker), way(&first));
    let other = place.json("traverse zones.toml --set scenario.terrain.zone.1.soil=clay");
    assert!((way(&other) - way(&first)).abs() > 1e-3);
    let elsewhere = place.json("traverse zones.toml --set scenario.terrain.zone.2.soil=grc-1");
    assert_eq!(elsewhere["final"], first["final"]);
}

/// Names of presets need no row, and rows come before presets.
#[test]
fn polygons_have_the_soils_that_they_name() {
    let place = place();
    place.write("zones.geojson", polygon("\"soil\": \"grc-1\""));
    let line = "traverse plain.toml --set scenario.terrain.soil_file=zones.geojson";
    let by_polygon = place.json(&format!("{line} --out out"));
    let by_classes = place.json("traverse zones.toml");
    assert!((way(&by_polygon) - way(&by_classes)).abs() < 1e-6);
    assert_eq!(place.json("traverse out/scenario.toml")["final"], by_polygon["final"]);

    let renamed =
        "soil_file = \"zones.geojson\"\n[[terrain.zone]]\nname = \"grc-1\"\nsoil = \"clay\"\n";
    place.write("renamed.toml", format!("{DRIVE}{renamed}"));
    let clay = place.json("traverse zones.toml --set scenario.terrain.zone.1.soil=clay");
    assert!((way(&place.json("traverse renamed.toml")) - way(&clay)).abs() < 1e-6);

    place.write("unit.geojson", polygon("\"soil\": \"crust of salt\""));
    let refused = place.line("traverse plain.toml --set scenario.terrain.soil_file=unit.geojson");
    let refused = check_is_refusal(&refused, 2);
    assert!(refused.contains("no soil for: \"crust of salt\""), "{refused}");
}

/// The guide's files, drive and numbers of rows.
#[test]
fn the_guide_s_example_drives_over_three_soils() {
    let guide = include_str!("../../../../docs/guide/terrain.md");
    let section = guide.split_once("## Soil by zone").expect("a section").1;
    let block = |language: &str| {
        let text = section.split_once(&format!("```{language}\n")).expect("a block").1;
        text.split_once("```").expect("its end").0
    };
    let place = Place::new();
    place.write("zones.geojson", block("json"));
    place.write("drive.toml", block("toml"));
    let line = block("sh").trim().strip_prefix("grouser ").expect("a command");
    let run = place.json(line);
    let samples = run["samples"].as_array().expect("samples");
    let front = |sample: &Value| sinkage(sample, 0);
    let sinkages = [&samples[0], &samples[80], &run["final"]].map(front);
    for (one, other) in [(0, 1), (1, 2), (0, 2)] {
        let ratio = sinkages[one] / sinkages[other];
        assert!((ratio - 1.0).abs() > 0.1, "{sinkages:?}");
    }
    let set = "--set scenario.terrain.zone.0.soil.friction_angle_deg=10";
    let weaker = place.json(&format!("{line} {set}").replace("--out run", ""));
    assert!((number(&weaker["final"]["x_m"]) - number(&run["final"]["x_m"])).abs() > 1e-3);
}

/// A raster of classes is in the system of the map, or refused by both names.
#[test]
fn classes_of_another_system_than_the_maps_are_refused() {
    let place = Place::new();
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../grouser-raster/tests/fixtures");
    let copy =
        |from: &str, to: &str| fs::copy(fixtures.join(from), place.file(to)).expect("a copy");
    copy("tiled-deflate-f32.tif", "map.tif");
    copy("classes-palette-u8.tif", "classes.tif");
    let head = "schema = \"scenario/1\"\nname = \"zones\"\nduration_s = 1.0\n[terrain]\n";
    let classes = grouser_raster::read_zones(
        &place.file("classes.tif"),
        &grouser_raster::ReadOptions::default(),
        None,
    )
    .expect("classes")
    .0;
    let rows: String = classes
        .keys()
        .iter()
        .map(|class| format!("[[terrain.zone]]\nclass = {class}\nsoil = \"grc-1\"\n"))
        .collect();
    place.write(
        "zones.toml",
        format!("{head}file = \"map.tif\"\nsoil_file = \"classes.tif\"\nstart_m = [500012.0, 5200020.0]\n{rows}"),
    );
    let line = "traverse zones.toml --simulation quasi-steady";
    let own = place.line(line);
    assert_eq!((own.code(), own.stderr.contains("not looked at")), (0, false), "{}", own.stderr);
    place.write("classes.tif.aux.xml", "<PAMDataset><SRS>EPSG:32632</SRS></PAMDataset>");
    let refused = check_is_refusal(&place.line(line), 2);
    let systems = "coordinates of the system EPSG:32632, and the map those of EPSG:32633";
    assert!(refused.contains(systems), "{refused}");
    assert!(refused.contains("hint: gdalwarp -r near -t_srs EPSG:32633 "), "{refused}");
}

#[test]
fn missions_and_campaigns_cross_zones() {
    let place = place();
    let leg = "[[leg]]\nspeed_m_s = 0.06\ndrive_m = 0.8\n";
    let mission = DRIVE.replace("scenario/1", "mission/1").replace("duration_s = 15.0\n", "");
    place.write("mission.toml", format!("{mission}{LEGEND}{leg}"));
    place.write("plain-mission.toml", format!("{mission}{leg}"));
    let [over, plain] =
        ["mission.toml", "plain-mission.toml"].map(|file| place.json(&format!("mission {file}")));
    let [time, before] = [&over, &plain].map(|run| number(&run["legs"][0]["time_s"]));
    assert!((time - before).abs() > 0.05, "{time} and {before}");

    let scenario = format!("{DRIVE}{LEGEND}").replace("[terrain]", "[scenario.terrain]");
    let scenario = scenario.replace("[[terrain", "[[scenario.terrain");
    let scenario = scenario.split_once("name = \"zones\"\n").expect("a name").1;
    let campaign = format!(
        "schema = \"campaign/1\"\nname = \"zones\"\nstudy = \"traverse\"\nruns = 6\n[scenario]\n{scenario}\
        [[parameter]]\nkey = \"terrain.zone.1.soil.friction_angle_deg\"\ndistribution = \"uniform\"\nlow = 25.0\nhigh = 40.0\n"
    );
    place.write("campaign.toml", campaign);
    assert_eq!(place.line("campaign run campaign.toml --out runs").code(), 0);
    let cases = [0, 1].map(|case| place.json(&format!("campaign rerun runs {case}")));
    let [one, other] = cases.each_ref().map(|case| number(&case["row"]["slip_ratio"]));
    assert!((one - other).abs() > 1e-3, "{one} and {other}");
}

#[test]
fn zones_that_cannot_be_are_refused() {
    let place = place();
    let row = |more: &str| format!("[[terrain.zone]]\n{more}\n");
    place.write(
        "open.geojson",
        polygon("\"soil\": \"clay\"").replace(", [1005.375, 2003.875]]]", "]]"),
    );
    let degrees = r#"{"type": "Feature", "properties": {"soil": "clay"}, "geometry": {"type": "Polygon",
        "coordinates": [[[10.1, 46.2], [10.2, 46.2], [10.2, 46.3], [10.1, 46.2]]]}}"#;
    place.write("degrees.geojson", degrees);
    place.write("heights.xyz", raster(|x, _| 0.1 * x));
    for (name, terrain, expected) in [
        ("no file", row("class = 1"), "`soil_file` names it"),
        ("no such file", "soil_file = \"none.tif\"\n".into(), "there is no such file"),
        ("a folder", "soil_file = \".\"\n".into(), "this is a folder"),
        ("a class short", LEGEND.replace("class = 7", "class = 8"), "no soil for: 7"),
        ("no key", format!("{LEGEND}{}", row("soil = \"clay\"")), "either a class or a name"),
        (
            "two keys",
            format!("{LEGEND}{}", row("class = 3\nname = \"a\"")),
            "either a class or a name",
        ),
        ("a class twice", format!("{LEGEND}{}", row("class = 7")), "a row above"),
        ("no such soil", LEGEND.replace("clay", "mud"), "no soil preset"),
        ("a class below zero", LEGEND.replace("class = 7", "class = -7"), "terrain.zone.2.class"),
        ("an open ring", "soil_file = \"open.geojson\"\n".into(), "is not closed"),
        ("degrees", "soil_file = \"degrees.geojson\"\n".into(), "degrees of longitude"),
        ("heights", "soil_file = \"heights.xyz\"\n".into(), "class numbers are whole"),
        (
            "no soil",
            LEGEND.replace("soil = \"clay\"", "[terrain.zone.soil]\ncohesion_kpa = 1.0"),
            "terrain.zone.2.soil",
        ),
    ] {
        place.write("bad.toml", format!("{DRIVE}{terrain}"));
        let refused = check_is_refusal(&place.line("traverse bad.toml"), 2);
        assert!(refused.contains(expected), "{name}: {refused}");
    }
    let unfit = "--set scenario.terrain.zone.1.soil.exit.ratio=-3";
    let refused = check_is_refusal(&place.line(&format!("traverse zones.toml {unfit}")), 2);
    assert!(refused.contains("exit.ratio"), "{refused}");
}
