//! Ground with heights: maps that are driven on, places in their coordinates, and maps that cannot
//! be used.

use std::fmt::Write as _;

use crate::bad_input::check_is_refusal;
use crate::program::{Place, keys, number};
use serde_json::Value;

/// Where the south-western point of the test's maps is [m].
const CORNER: [f64; 2] = [-25_000.0, 310_000.0];

/// A map of 6 m by 6 m as text, each point with the height of a formula of the way from its corner.
fn map(height: impl Fn(f64, f64) -> f64) -> String {
    let mut text = String::new();
    for (row, column) in (0..=60).flat_map(|row| (0..=60).map(move |column| (row, column))) {
        let [x, y] = [column, row].map(|cells| 0.1 * f64::from(cells));
        let [east, north] = [CORNER[0] + x, CORNER[1] + y];
        let _ = writeln!(text, "{east:.1} {north:.1} {:.9}", height(x, y));
    }
    text
}

/// A drive over a map, from a place seen from its corner.
fn drive(place: &Place, from: [f64; 2], more: &str) -> Value {
    let [x, y] = [0, 1].map(|axis| CORNER[axis] + from[axis]);
    place.json(&format!("traverse --terrain map.xyz --start-x-m {x} --start-y-m {y} {more}"))
}

fn numbers<const N: usize>(of: &Value, keys: [&str; N]) -> [f64; N] {
    keys.map(|key| number(&of[key]))
}

/// What a drive over a plane comes to, by the plane's axes and by the map's: 0.1 % in the way, the
/// drift, slip, heading and work, whichever way the plane rises.
#[test]
fn a_plane_as_a_map_is_the_plane() {
    let place = Place::new();
    let slope = 10_f64.to_radians();
    let plane = place.json("traverse --slope-deg 10 --yaw-deg 5");
    let [along, uphill, yaw] = numbers(&plane["final"], ["x_m", "y_m", "yaw_deg"]);
    for rises in [90.0_f64, 30.0] {
        let turned = rises.to_radians();
        let height = |x: f64, y: f64| slope.tan() * (x * turned.cos() + y * turned.sin());
        place.write("map.xyz", map(height));
        // A yaw on the plane, seen from above and from east.
        let on_map = |yaw: f64| {
            let (sin, cos) = yaw.to_radians().sin_cos();
            (slope.cos() * sin).atan2(cos).to_degrees() + rises - 90.0
        };
        let from = [3.0, 3.0];
        let run = drive(&place, from, &format!("--yaw-deg {}", on_map(5.0)));
        let [x, y, z] = numbers(&run["final"], ["x_m", "y_m", "z_m"]);
        let [east, north] = [x - CORNER[0] - from[0], y - CORNER[1] - from[1]];
        // The body leans by another 0.2° once its wheels have side forces.
        let start = number(&run["samples"][0]["z_m"]);
        assert!((z - start - uphill * slope.sin()).abs() < 2e-4, "{z} {start}");
        let across = east * turned.sin() - north * turned.cos();
        let up = (east * turned.cos() + north * turned.sin()) / slope.cos();
        assert!((across - along).abs() < 1e-3 * along, "rises {rises}: {across} {along}");
        assert!((up - uphill).abs() < 1e-3 * along, "rises {rises}: {up} {uphill}");
        let heading = number(&run["final"]["yaw_deg"]);
        assert!((heading - on_map(yaw)).abs() < 1e-3 * 5.0, "{heading} {}", on_map(yaw));
        let work = [&run, &plane].map(|run| number(&run["energy_j"]));
        assert!((work[0] / work[1] - 1.0).abs() < 1e-3, "{work:?}");
        for wheel in 0..4 {
            let slip =
                [&run, &plane].map(|run| number(&run["final"]["wheels"][wheel]["slip_ratio"]));
            assert!((slip[0] - slip[1]).abs() < 1e-4, "{slip:?}");
        }
        let [roll, pitch] = numbers(&run["samples"][0], ["roll_deg", "pitch_deg"]);
        // By the slope's parts across and along the body, but for the wheels' sinkages.
        assert!((roll - 9.96).abs() < 0.3 && (pitch - 0.87).abs() < 0.3, "{roll} {pitch}");
    }
}

/// The contract of places: the start is where it was asked for, or in the map's middle, and heights
/// are metres of the map.
#[test]
fn places_are_those_of_the_map() {
    let place = Place::new();
    place.write("map.xyz", map(|_, _| 1234.5));
    let run = drive(&place, [1.5, 2.0], "--yaw-deg 90 --duration-s 2");
    let [x, y, z, yaw] = numbers(&run["samples"][0], ["x_m", "y_m", "z_m", "yaw_deg"]);
    assert_eq!([x, y, yaw], [CORNER[0] + 1.5, CORNER[1] + 2.0, 90.0]);
    assert!((1234.55..1234.70).contains(&z), "{z}");
    let end = numbers(&run["final"], ["x_m", "y_m"]);
    assert!((end[0] - x).abs() < 1e-6 && (0.1..0.12).contains(&(end[1] - y)), "{end:?}");
    let middle = place.json("traverse --terrain map.xyz --duration-s 1");
    assert_eq!(numbers(&middle["samples"][0], ["x_m", "y_m"]), [CORNER[0] + 3.0, CORNER[1] + 3.0]);
    let plane = place.json("traverse --duration-s 1");
    assert!(!keys(&plane["final"]).contains(&"z_m"));
}

/// A crest under the belly ends a drive where the rover's document says how high that is; a start
/// on one is refused.
#[test]
fn a_drive_over_a_crest_ends_on_the_belly() {
    let place = Place::new();
    place.write("map.xyz", map(|x, _| 0.06 * (std::f64::consts::TAU * x / 1.2).cos()));
    let over = "--yaw-deg 0 --duration-s 15 --simulation quasi-steady";
    let free = drive(&place, [1.8, 3.0], over);
    assert_eq!(free["outcome"], "completed");
    assert!(free["final"]["belly_clearance_m"].is_null());
    assert!(number(&free["final"]["stability_margin_deg"]) > 20.0);
    let low = "--set scenario.rover.belly_clearance_m=0.03";
    let stuck = drive(&place, [1.8, 3.0], &format!("{over} {low}"));
    assert_eq!(stuck["outcome"], "high_centred");
    let reason = stuck["reason"].as_str().expect("a reason");
    assert!(reason.starts_with("its underside touches the ground at x = -24997."), "{reason}");
    let clearances: Vec<f64> = stuck["samples"]
        .as_array()
        .expect("samples")
        .iter()
        .map(|sample| number(&sample["belly_clearance_m"]))
        .collect();
    let (last, before) = clearances.split_last().expect("some");
    assert!(*last <= 0.0 && before.iter().all(|clearance| *clearance > 0.0), "{clearances:?}");
    let [x, y] = [CORNER[0] + 2.4, CORNER[1] + 3.0];
    let on_it = format!("traverse --terrain map.xyz --start-x-m {x} --start-y-m {y} {over} {low}");
    let refused = place.line(&on_it).stderr;
    assert!(refused.contains("where the rover starts its underside touches"), "{refused}");
}

/// Over heights a run is quasi-steady where nobody asks for another, and says how to.
#[test]
fn over_heights_a_run_is_quasi_steady_unless_dynamic_is_asked_for() {
    let place = Place::new();
    place.write("map.xyz", map(|x, _| 0.1 * x));
    let usual = drive(&place, [2.0, 2.0], "--duration-s 2");
    let dynamic = drive(&place, [2.0, 2.0], "--duration-s 2 --simulation dynamic");
    let ways = [&usual, &dynamic].map(|run| run["simulation"].as_str());
    assert_eq!(ways, [Some("quasi-steady"), Some("dynamic")]);
    let [one, other] = [&usual, &dynamic].map(|run| numbers(&run["final"], ["x_m", "y_m"]));
    // What slip takes to settle at the start.
    assert!((0..2).all(|axis| (one[axis] - other[axis]).abs() < 2e-3), "{one:?} and {other:?}");
    let said = place.line("traverse --terrain map.xyz --duration-s 1").stdout;
    assert!(said.contains("quasi-steady; --simulation dynamic"), "{said}");
    let plane = place.line("traverse --duration-s 1").stdout;
    assert!(!plane.contains("simulation:"), "{plane}");
}

/// What a folder keeps repeats the run from anywhere, and its table and page know the heights.
#[test]
fn a_folder_repeats_a_drive_over_a_map() {
    let place = Place::new();
    place.write("map.xyz", map(|x, _| 0.1 * x));
    let first = drive(&place, [2.0, 2.0], "--duration-s 2 --out out");
    let again = place.json("traverse out/scenario.toml");
    assert_eq!(first["final"], again["final"]);
    let head = place.read("out/traverse.csv").lines().next().expect("columns").to_owned();
    assert!(head.contains(",z_m,roll_deg,pitch_deg,"), "{head}");
    let page = place.read("out/report.html");
    assert!(page.contains("map.xyz") && page.contains("Height of the body"));
    assert!(page.contains("along the way"));
    assert!(place.read("out/ground.svg").contains("along the way"));
    let table = place.line("traverse out/scenario.toml").stdout;
    assert!(table.contains("x -22998") || table.contains("x -24997."), "{table}");
}

#[test]
fn ground_by_formulas_stands_in_documents() {
    let place = Place::new();
    let head = "schema = \"scenario/1\"\nname = \"ripples\"\nsimulation = \"quasi-steady\"\n";
    let ripple = "[terrain]\nsurface = \"ripple\"\namplitude_m = 0.02\nwavelength_m = 2.0\nstart_m = [0.5, 3.0]\n";
    place.write("s.toml", format!("{head}{ripple}"));
    let run = place.json("traverse s.toml");
    let [x, y] = numbers(&run["samples"][0], ["x_m", "y_m"]);
    assert_eq!([x, y], [0.5, 3.0]);
    // On a crest the body is level, and its hubs as far above it as on a plane.
    assert!(number(&run["samples"][0]["pitch_deg"]).abs() < 0.3);
    let steepest = (0.02 * std::f64::consts::PI).atan().to_degrees();
    let pitches = run["samples"].as_array().expect("samples").iter();
    let lowest = pitches.map(|it| number(&it["pitch_deg"])).fold(0.0, f64::min);
    assert!((-1.1 * steepest..-0.7 * steepest).contains(&lowest), "{lowest} {steepest}");
    let crater = "--set scenario.terrain.surface=crater --set scenario.terrain.diameter_m=10 --set \
                  scenario.terrain.depth_m=1 --set scenario.terrain.rim_height_m=0.2 --set \
                  scenario.terrain.rim_width_m=2";
    let at_rim = place
        .json(&format!("traverse s.toml {crater} --start-x-m -5 --start-y-m 0 --duration-s 1"));
    let [rim, level] = [&at_rim, &run].map(|run| number(&run["samples"][0]["z_m"]));
    assert!((rim - 0.2 - (level - 0.02)).abs() < 0.02, "{rim} {level}");
}

/// Legs over a map go to its places; roll and pitch stop a rover by how it stands.
#[test]
fn missions_are_driven_on_maps() {
    let place = Place::new();
    place.write("map.xyz", map(|x, _| 0.02 * (x - 3.0).max(0.0).powi(2)));
    let [x, y] = [CORNER[0] + 2.0, CORNER[1] + 3.0];
    let goto = format!("[[leg]]\nspeed_m_s = 0.06\ngoto = {{ x_m = {}, y_m = {y} }}\n", x + 3.0);
    let head = "schema = \"mission/1\"\nname = \"m\"\nsimulation = \"quasi-steady\"\n";
    place.write("m.toml", format!("{head}{goto}"));
    let start = format!("--terrain map.xyz --start-x-m {x} --start-y-m {y}");
    let all = place.json(&format!("mission m.toml {start}"));
    assert_eq!(all["outcome"], "completed");
    let leg = &all["legs"][0];
    let within = (number(&leg["x_m"]) - x - 3.0).hypot(number(&leg["y_m"]) - y);
    assert!(within < 0.11, "{within}");
    assert_eq!(leg["manoeuvre"], format!("go to {}, {y} m", x + 3.0));
    place.write("m.toml", format!("{head}[stop]\npitch_deg = {{ above = 3.0 }}\n{goto}"));
    let stopped = place.json(&format!("mission m.toml {start} --out out"));
    assert_eq!(stopped["legs"][0]["stopped_by"], "pitch_deg");
    assert!((number(&stopped["final"]["pitch_deg"]) - 3.0).abs() < 0.1, "{}", stopped["final"]);
}

/// What is drawn of a run on a plane is drawn of one over heights: of one, of two yaws, of all
/// models and of a mission.
#[test]
fn runs_over_heights_are_animated() {
    let place = Place::new();
    place.write("map.xyz", map(|x, y| 0.1 * (x + 0.5 * y).sin()));
    let start = format!("--start-x-m {} --start-y-m {}", CORNER[0] + 2.0, CORNER[1] + 3.0);
    let on_it = format!("--terrain map.xyz {start} --duration-s 2 --simulation quasi-steady");
    for name in ["run.html", "run.glb", "run.svg", "run.png", "run.gif"] {
        let answer = place.line(&format!("traverse {on_it} --animate {name}"));
        assert_eq!(answer.code(), 0, "{}", answer.stderr);
        assert!(std::fs::read(place.file(name)).expect("it is written").len() > 1000, "{name}");
    }
    assert!(place.read("run.svg").contains(">from above, north up</text>"));
    let line = format!("traverse {on_it} --beside-yaw-deg 30 --animate yaws.svg");
    assert_eq!(place.line(&line).code(), 0);
    let line = format!("traverse {on_it} --model all --animate models.svg");
    assert_eq!(place.line(&line).code(), 0);
    let models = place.read("models.svg");
    assert!(
        ["ishigami", "bekker", "rft"].iter().all(|it| models.contains(&format!(">{it}</text>")))
    );
    let head = "schema = \"mission/1\"\nname = \"m\"\nsimulation = \"quasi-steady\"\n";
    let leg = "[[leg]]\nspeed_m_s = 0.06\nheading = \"hold\"\ndrive_m = 0.3\n";
    place.write("m.toml", format!("{head}{leg}"));
    let line = format!("mission m.toml --terrain map.xyz {start} --animate m.svg");
    let answer = place.line(&line);
    assert_eq!(answer.code(), 0, "{}", answer.stderr);
    assert!(place.read("m.svg").contains(">along the way"));
}

/// Bands over heights have every column of a plane's, and how the rover stands.
#[test]
fn bands_over_heights_have_place_height_and_attitude() {
    let place = Place::new();
    place.write("map.xyz", map(|x, y| 0.1 * (x + 0.5 * y).sin()));
    let start = format!("--start-x-m {} --start-y-m {}", CORNER[0] + 2.0, CORNER[1] + 3.0);
    let line = format!(
        "traverse --terrain map.xyz {start} --duration-s 4 --simulation quasi-steady --yaw-deg 90 \
         --uncertainty --samples 10"
    );
    let json = place.json(&line);
    let names = keys(&json["bands"][0]);
    for name in ["x_m", "y_m", "z_m", "roll_deg", "pitch_deg", "yaw_deg", "slip_ratio", "energy_j"]
    {
        for quantile in ["p2_5", "p50", "p97_5"] {
            let key = format!("{name}_{quantile}");
            assert!(names.contains(&key.as_str()), "{key} of {names:?}");
            assert!(json["band"][&key].is_number(), "{key}");
        }
    }
    let table = place.line(&line);
    assert!(table.stdout.contains("z_m_p2_5"), "{}", table.stdout);
    assert_eq!(place.line(&format!("{line} --out out")).code(), 0);
    assert!(place.read("out/traverse.csv").contains("pitch_deg_p97_5"));
    assert!(place.read("out/report.html").contains("95 % of the samples"));
    let plane = place.json("traverse --duration-s 1 --uncertainty --samples 4");
    assert!(keys(&plane["bands"][0]).iter().all(|name| !name.starts_with("z_m")));
}

#[test]
fn maps_that_cannot_be_driven_on_are_refused() {
    let place = Place::new();
    place.write("map.xyz", map(|_, _| 0.0));
    place.write("words.xyz", "here be craters\n");
    let mut array = b"\x93NUMPY\x01\x00\x46\x00".to_vec();
    array.extend(
        format!("{:69}\n", "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 3), }").bytes(),
    );
    array.extend([0; 36]);
    place.write("map.npy", array);
    for (line, expected) in [
        ("--terrain none.tif", "there is no such file"),
        ("--terrain .", "this is a folder"),
        ("--terrain words.xyz", "the map has no points"),
        ("--terrain map.npy", "give `terrain.cell_size_m`"),
        ("--terrain map.xyz --slope-deg 5", "cannot be used with"),
        ("--terrain map.xyz --set scenario.slope_deg=5", "leave out `slope_deg`"),
        ("--terrain map.xyz --start-x-m 5 --start-y-m 5", "x is from -25000 to -24994 m"),
        ("--terrain map.xyz --start-x-m 5", "--start-y-m"),
        ("--terrain map.xyz --start-x-m nan --start-y-m 0", "finite"),
    ] {
        let refused = check_is_refusal(&place.line(&format!("traverse {line}")), 2);
        assert!(refused.contains(expected), "{line}: {refused}");
    }
    let cells = "--set scenario.terrain.cell_size_m=2 --set scenario.terrain.south_west_m=[100,50]";
    let run = place.json(&format!("traverse --terrain map.npy {cells} --duration-s 1"));
    assert_eq!(numbers(&run["samples"][0], ["x_m", "y_m"]), [102.0, 52.0]);
    let gone = place.json("traverse --terrain map.xyz --duration-s 90 --simulation quasi-steady");
    assert_eq!(gone["outcome"], "off_map");
    let reason = gone["reason"].as_str().expect("a reason");
    assert!(reason.contains("where the map has no heights"), "{reason}");
    let last = gone["samples"].as_array().and_then(|samples| samples.last());
    assert!(last.is_some_and(|last| last["time_s"].as_f64() > Some(1.0)), "{last:?}");
}

/// Wheels that turn against each other on an incline: 2 ms after the start no loads are found that
/// balance the rover.
#[test]
fn records_until_an_error_are_kept() {
    let place = Place::new();
    let document = r#"
        schema = "scenario/1"
        rover = "mgru3"
        soil = "lunar-30-60-cm"
        gravity_m_s2 = 3.71
        load_transfer = "complete"
        duration_s = 1.0
        [start]
        yaw_deg = 149.36432159986919
        [drive]
        law = "constant"
        rim_speed_m_s = [0.1819479748384682, 0.04642286608673571, -0.16731717111073519, -0.16446917055779153]
        [terrain]
        surface = "incline"
        slope_deg = 6.2408963189508
        direction_deg = -141.4859465271653
        start_m = [2.537584704845827, 2.2423018904523584]
    "#;
    place.write("scenario.toml", document);
    // On soil as strong as this the loads of wheels that turn against each other do not settle.
    let strong = "--set soil.constant_volume_share=0 --set soil.small_wheel.mounds.rear_mound=0";
    let answer = place.line(&format!("traverse scenario.toml --out out {strong}"));
    assert_eq!(answer.code(), 1, "{}", answer.stderr);
    let said = "the records until then are in traverse.csv";
    assert!(answer.stderr.contains(said), "{}", answer.stderr);
    let records = place.read("out/traverse.csv");
    assert!(records.starts_with("time_s,x_m") && records.lines().count() >= 2, "{records}");
    assert!(place.read("out/scenario.toml").contains("scenario/1"));
}
