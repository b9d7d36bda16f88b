//! Mobility maps: numbers of `heading-map`, files that open, and maps that were stopped.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::time::Duration;

use grouser_raster::{Raster, ReadOptions};
use serde_json::Value;

use crate::bad_input::check_is_refusal;
use crate::program::{Place, number};

/// A map of 30 × 20 points, 0.5 m apart, each with the height of a formula of the way from its
/// corner; one of them is not there.
pub(crate) fn heights(height: impl Fn(f64, f64) -> f64) -> String {
    let mut text = String::new();
    for (row, column) in (0..20).flat_map(|row| (0..30).map(move |column| (row, column))) {
        let [x, y] = [column, row].map(|cells| 0.5 * f64::from(cells));
        if (column, row) != (25, 3) {
            let _ = writeln!(text, "{:.1} {:.1} {:.9}", 7000.0 + x, -300.0 + y, height(x, y));
        }
    }
    text
}

fn band(answer: &Value, place: &Place, name: &str) -> Raster {
    let files = answer["files"].as_array().expect("files");
    let file = files.iter().find(|file| file["name"] == name).expect("such a band");
    let path = place.file(file["path"].as_str().expect("a path"));
    grouser_raster::read(&path, &ReadOptions::default()).expect("it opens")
}

/// On a plane every place has the row of `heading-map` for its slope, and the heading turns with
/// the plane.
#[test]
fn a_plane_has_the_numbers_of_the_heading_map() {
    let place = Place::new();
    for (number_of, course, rises) in [(0, 0.0, 90.0_f64), (1, 30.0, 210.0)] {
        let (sin, cos) = rises.to_radians().sin_cos();
        let tan = 12_f64.to_radians().tan();
        place.write("plane.xyz", heights(|x, y| tan * (x * cos + y * sin)));
        let out = format!("map-{number_of}");
        let map =
            place.json(&format!("map plane.xyz --course-deg {course} --samples 5 --out {out}"));
        let row = place.json(&format!("attitude-map --slope-deg 12 --course-deg {course}"));
        let row = &row["rows"][0];
        let error = |name: &str| number(&map["interpolation_error"][name]) + 2e-5;
        let check = |name: &str, expected: f64| {
            let found = band(&map, &place, name).height(14, 9).expect("a number");
            let difference = (found - expected).abs();
            assert!(
                difference <= error(name) + 1e-6 * expected.abs(),
                "{name}: {found} {expected}"
            );
        };
        for name in ["slip_ratio", "power_w", "sinkage_mm"] {
            check(name, number(&row[name]));
        }
        let yaw = number(&row["yaw_deg"]).to_radians();
        let on_map = (yaw.sin() * 12_f64.to_radians().cos()).atan2(yaw.cos()).to_degrees();
        let heading = on_map + rises - 90.0;
        let found = band(&map, &place, "heading_deg").height(14, 9).expect("a number");
        let apart = (found - heading + 180.0).rem_euclid(360.0) - 180.0;
        assert!(apart.abs() <= error("heading_deg"), "{found} {heading}");
        assert!((band(&map, &place, "slope_deg").height(3, 4).expect("one") - 12.0).abs() < 1e-3);
    }
}

/// What is odd about heights is said, and declared with the flag that helps; names of columns count.
#[test]
fn what_is_odd_about_heights_is_said_with_the_flag_that_helps() {
    let place = Place::new();
    let void = |x: f64, y: f64| if x > 12.9 && y > 8.9 { -9999.0 } else { 100.0 + 0.1 * x };
    place.write("void.xyz", heights(void));
    let note = "8 cells of -9999 m are 10099 m below all others: missing heights? ";
    let found = place.line("map void.xyz --samples 2 --out one");
    assert!(found.stderr.contains(&format!("{note}`--missing-m -9999`")), "{}", found.stderr);
    let json: Value = serde_json::from_str(&place.read("one/map.json")).expect("JSON");
    assert!(json["verdicts"]["no_go"].as_u64() > Some(0));
    let declared = place.line("map void.xyz --missing-m -9999 --samples 2 --out two");
    assert!(declared.stdout.contains("The map: x from 7000 to "), "{}", declared.stdout);
    assert!(!declared.stderr.contains("missing heights"), "{}", declared.stderr);
    let json: Value = serde_json::from_str(&place.read("two/map.json")).expect("JSON");
    assert_eq!((&json["verdicts"]["no_go"], &json["verdicts"]["unknown"]), (&0.into(), &9.into()));
    let quick = "--duration-s 1 --simulation quasi-steady";
    let driven = place.line(&format!("traverse --terrain void.xyz {quick}"));
    let flag = "`--set scenario.terrain.missing_m=-9999`";
    assert!(driven.stderr.contains(&format!("{note}{flag}")), "{}", driven.stderr);
    place.write(
        "many.toml",
        "schema = \"campaign/1\"\nname = \"many\"\nstudy = \"traverse\"\nruns = 2\n\
         [scenario]\nduration_s = 1.0\nterrain = { file = \"void.xyz\" }\n\
         [[parameter]]\nkey = \"soil.friction_angle_deg\"\ndistribution = \"normal\"\n\
         standard_deviation = 1.0\n",
    );
    let sampled = place.line("campaign run many.toml --out many");
    assert!(sampled.stderr.contains(&format!("{note}`terrain.missing_m`")), "{}", sampled.stderr);
    let named = heights(|x, _| 0.1 * x).replace(' ', ",").replace(',', ",7,");
    let named: String =
        named.lines().map(|line| format!("{}\n", line.replacen(",7,", ",", 1))).collect();
    place.write("named.csv", format!("x,y,intensity,z\n{named}"));
    let driven = place.line(&format!("traverse --terrain named.csv {quick} --format csv"));
    assert!(driven.stderr.contains("columns not used: intensity"), "{}", driven.stderr);
    place.write("degrees.csv", "lon,lat,z\n15,54,1\n15.1,54,2\n15,54.1,3\n15.1,54.1,4\n");
    let refused = check_is_refusal(&place.line("map degrees.csv --out three"), 2);
    assert!(refused.contains("column lon is in degrees"), "{refused}");
}

/// A system that stands in notes beside the map is that of the files that are written.
#[test]
fn the_system_beside_a_map_is_written_with_its_bands() {
    let place = Place::new();
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../grouser-raster/tests/fixtures");
    fs::copy(fixtures.join("no-place.tif"), place.file("site.tif")).expect("a copy");
    let place_of = "<GeoTransform>500000, 2, 0, 20000, 0, -2</GeoTransform>";
    for (text, code) in [("EPSG:32633", Some(32633)), (SITE, None)] {
        let system = text.replace('"', "&quot;");
        let notes = format!("<PAMDataset><SRS>{system}</SRS>{place_of}</PAMDataset>");
        place.write("site.tif.aux.xml", notes);
        let map = place.json("map site.tif --samples 2 --out map --force");
        let written = band(&map, &place, "slope_deg").coordinates;
        assert_eq!((written.epsg(), written.to_text().as_deref()), (code, Some(text)));
    }
}

/// A system of a site, without a code.
const SITE: &str = r#"PROJCS["site",GEOGCS["Moon",DATUM["Moon",SPHEROID["Moon",1737400,0]],PRIMEM["0",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",15],PARAMETER["scale_factor",1],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1]]"#;

/// A map of hills has all its files, in the coordinates of the heights; places without a height
/// have no number.
#[test]
fn a_map_has_its_bands_styles_and_page() {
    let place = Place::new();
    place.write("hills.xyz", heights(|x, y| 0.8 * (0.7 * x).sin() * (0.5 * y).cos()));
    let map = place
        .json("map hills.xyz --course-deg best --soil toyoura-uncertain --samples 8 --out map");
    let names: Vec<&str> = map["files"]
        .as_array()
        .unwrap()
        .iter()
        .map(|file| file["name"].as_str().unwrap())
        .collect();
    assert_eq!(
        names,
        [
            "slope_deg",
            "heading_deg",
            "slip_ratio",
            "drift_m_per_m",
            "power_w",
            "sinkage_mm",
            "verdict",
            "probability_no_go",
            "course_deg",
        ]
    );
    let heights = grouser_raster::read(&place.file("hills.xyz"), &ReadOptions::default()).unwrap();
    let counts = ["go", "caution", "no_go", "unknown"].map(|word| number(&map["verdicts"][word]));
    assert_eq!(counts.iter().sum::<f64>(), 600.0);
    for name in names {
        let band = band(&map, &place, name);
        assert_eq!(band.grid, heights.grid, "{name}");
        assert_eq!(band.height(25, 3), None, "{name}");
        let style = place.read(&format!("map/{name}.qml"));
        assert!(
            style.starts_with("<!DOCTYPE qgis>") && style.contains("<rasterrenderer"),
            "{style}"
        );
    }
    let verdict = band(&map, &place, "verdict");
    let probability = band(&map, &place, "probability_no_go");
    for (column, row) in (0..20).flat_map(|row| (0..30).map(move |column| (column, row))) {
        let (Some(verdict), Some(share)) =
            (verdict.height(column, row), probability.height(column, row))
        else {
            continue;
        };
        assert!((1.0..=3.0).contains(&verdict) && (0.0..=1.0).contains(&share));
        assert!(share <= 0.2 || verdict == 3.0, "{column} {row}: {verdict} {share}");
    }
    let page = place.read("map/map.html");
    assert_eq!(page.matches("<svg").count(), 9, "a picture of each band");
    assert_eq!(page.matches("<image ").count(), 9, "each is one picture of pixels");
    // The verdict, then why, then what to do; the rest is folded.
    let (seen, folded) = page.split_once("<details").expect("folded parts");
    assert_eq!((seen.matches("<svg").count(), folded.matches("<svg").count()), (2, 7));
    let order = ["Whether to drive there", "Slope of the ground", "What to do next"];
    let places = order.map(|words| seen.find(words).unwrap_or_else(|| panic!("{words}")));
    assert!(places.is_sorted(), "{places:?}");
    let verdict = place.read("map/verdict.svg");
    for words in ["HAKUTO", "the best course of each place", ">N</text>", ">5 m</text>"] {
        assert!(verdict.contains(words), "{words}: {verdict}");
    }
    assert!(place.read("map/slope_deg.svg").contains(">15 to 20°</text>"));
    for directions in ["heading_deg", "course_deg"] {
        let arrows = place.read(&format!("map/{directions}.svg"));
        assert!(arrows.contains("an arrow: the cell in the middle of"), "{directions}");
    }
    assert!(!place.names().iter().any(|name| name.contains("in-the-making")));
}

/// The areas of a map, where it is a no-go, are those that a route goes around: over a ridge that
/// ends before the edge of the map.
#[test]
fn a_route_keeps_out_of_the_no_go_of_a_map() {
    let place = Place::new();
    let ridge =
        |x: f64, y: f64| 3.0 * (1.0 - ((x - 7.0) / 1.5).abs()).max(0.0) * (5.5 - y).clamp(0.0, 1.0);
    place.write("ridge.xyz", heights(ridge));
    let map = place
        .json("map ridge.xyz --course-deg best --soil toyoura-uncertain --samples 8 --out map");
    assert_eq!(map["keep_out"], "map/keep-out.geojson");
    let areas: Value = serde_json::from_str(&place.read("map/keep-out.geojson")).expect("JSON");
    let areas = areas["features"].as_array().expect("areas");
    let no_go = areas.iter().find(|it| it["properties"]["verdict"] == "no_go").expect("a no-go");
    let polygons = no_go["geometry"]["coordinates"].as_array().expect("polygons");
    let cells = number(&map["verdicts"]["no_go"]);
    assert!(!polygons.is_empty() && (polygons.len() as f64) < 0.5 * cells, "{cells}: {no_go}");
    // Level ground all around it: limits that let a route over the ridge do not let it in.
    let route = "route ridge.xyz --from 7002,-298 --to 7011,-298 --soil toyoura-uncertain \
                 --samples 8 --no-drive --keep-out map/keep-out.geojson";
    let route = place.json(route);
    assert_eq!(route["status"], "found", "{route}");
    let north = route["waypoints"].as_array().expect("places").iter().map(|at| number(&at[1]));
    assert!(north.fold(f64::NEG_INFINITY, f64::max) > -295.0, "{route}");
    let inside = place.json(
        "route ridge.xyz --from 7006.5,-298 --to 7011,-298 --samples 2 --no-drive --keep-out \
         map/keep-out.geojson",
    );
    assert!(inside["reason"].as_str().expect("why").contains("where nobody may go"), "{inside}");
    place.write("flat.xyz", heights(|_, _| 2.0));
    let flat = place.json("map flat.xyz --soil toyoura-uncertain --samples 4 --out flat");
    assert_eq!(flat["keep_out"], Value::Null);
    let unknown = place.results("map flat.xyz --samples 4 --out unknown");
    assert!(unknown.contains("nothing would be left to drive on"), "{unknown}");
}

/// What was there when a map was stopped stays, and the rest is the same to the byte as of a map
/// that was not.
#[test]
fn a_map_that_was_stopped_goes_on() {
    let place = Place::new();
    place.write("hills.xyz", heights(|x, y| 0.8 * (0.7 * x).sin() * (0.5 * y).cos()));
    place.results("map hills.xyz --samples 4 --out whole");
    // A folder where a band is to be written stops that one.
    fs::create_dir_all(place.file("stopped/.power_w.part")).unwrap();
    let stopped = place.line("map hills.xyz --samples 4 --out stopped --force");
    assert_eq!(stopped.code(), 1, "{}", stopped.conversation());
    assert!(stopped.stderr.contains(".power_w.part: cannot be written"), "{}", stopped.stderr);
    fs::remove_dir(place.file("stopped/.power_w.part")).unwrap();
    assert!(place.file("stopped/slope_deg.tif").exists());
    assert!(
        !place.file("stopped/power_w.tif").exists() && !place.file("stopped/map.json").exists()
    );
    let made = |name: &str| fs::metadata(place.file(name)).unwrap().modified().unwrap();
    let before = made("stopped/slope_deg.tif");
    let other = check_is_refusal(&place.line("map hills.xyz --samples 5 --out stopped"), 2);
    assert!(other.contains("has a map in the making, of other inputs"), "{other}");
    place.results("map hills.xyz --samples 4 --out stopped");
    assert_eq!(made("stopped/slope_deg.tif"), before);
    for entry in fs::read_dir(place.file("whole")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        if name.contains(".tif") || name.contains(".qml") {
            let [one, other] =
                ["whole", "stopped"].map(|it| fs::read(place.file(&format!("{it}/{name}"))));
            assert!(one.unwrap() == other.unwrap(), "{name}");
        }
    }
    assert!(!place.file("stopped/map-in-the-making.json").exists());
}

/// All files of a folder with what is in them, in order.
fn files_of(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entry = |entry: std::io::Result<fs::DirEntry>| {
        let path = entry.unwrap().path();
        (path.file_name().unwrap().display().to_string(), fs::read(&path).unwrap())
    };
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(entry).collect();
    files.sort();
    files
}

/// Kills the making of a map, without a warning, as soon as a file of it is there.
fn kill_when_there_is(place: &Place, arguments: &[&str], file: &str) -> bool {
    let mut child = place.command(arguments).spawn().expect("it starts");
    while !place.file(file).exists() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_micros(200));
    }
    child.kill().expect("it can be killed");
    !child.wait().unwrap().success()
}

/// Killed when it has begun, at the first band, and at the last: the same command goes on, to the
/// same bytes.
#[test]
fn a_map_that_was_killed_goes_on_to_the_same_bytes() {
    let mut text = String::new();
    for (row, column) in (0..160).flat_map(|row| (0..200).map(move |column| (row, column))) {
        let [x, y] = [column, row].map(|cells| 0.5 * f64::from(cells));
        let height = 0.8 * (0.7 * x).sin() * (0.5 * y).cos();
        let _ = writeln!(text, "{:.1} {:.1} {height:.6}", 7000.0 + x, -300.0 + y);
    }
    let arguments = ["map", "hills.xyz", "--samples", "4", "--course-deg", "30", "--out", "map"];
    let made = |stops: &[&str]| {
        let place = Place::new();
        place.write("hills.xyz", &text);
        let killed = stops.iter().map(|file| kill_when_there_is(&place, &arguments, file));
        let killed: Vec<bool> = killed.collect();
        // One that was done before the kill is not made again.
        if killed.last() != Some(&false) {
            let answer = place.run(&arguments);
            assert_eq!(answer.code(), 0, "{stops:?}: {}", answer.conversation());
        }
        (killed, files_of(&place.file("map")))
    };
    let (_, whole) = made(&[]);
    assert!(whole.len() > 16, "{}", whole.len());
    for stops in [
        &["map/map-in-the-making.json"][..],
        &["map/.slope_deg.part"],
        &["map/slope_deg.tif"],
        &["map/map-in-the-making.json", "map/sinkage_mm.tif"],
    ] {
        let (killed, files) = made(stops);
        if stops[0].ends_with("making.json") {
            assert!(killed[0], "it was done before it was killed");
        }
        let names = |files: &[(String, Vec<u8>)]| -> Vec<String> {
            files.iter().map(|(name, _)| name.clone()).collect()
        };
        assert_eq!(names(&files), names(&whole), "{stops:?}");
        for ((name, one), (_, other)) in files.iter().zip(&whole) {
            assert!(one == other, "{stops:?}: {name}");
        }
    }
}

#[test]
fn maps_that_cannot_be_made_say_why() {
    let place = Place::new();
    place.write("hills.xyz", heights(|x, _| 0.1 * x));
    place.write("picture.tif", "no tiff");
    for (line, words) in [
        (
            "map hills.xyz --course-deg up --out m",
            "--course-deg up: expected an angle of -90 to 90, best or worst",
        ),
        ("map hills.xyz --course-deg 91 --out m", "--course-deg"),
        ("map nowhere.tif --out m", "nowhere.tif"),
        ("map picture.tif --out m", "picture.tif"),
        ("map hills.xyz --set scenario.slope_deg=5 --out m", "slopes are those of the ground"),
        ("map hills.xyz --out hills.xyz", "is a file"),
        ("map hills.xyz --go-slip-ratio 0.7 --out m", "go slip ratio"),
        ("map hills.xyz", "--out"),
    ] {
        let answer = place.line(line);
        assert!(answer.code() == 1 || answer.code() == 2, "{}", answer.conversation());
        assert!(answer.stderr.contains(words), "{}", answer.conversation());
        assert!(!place.file("m").exists(), "{line}");
    }
}

#[test]
fn a_map_for_gazebo_has_the_slip_of_its_slopes() {
    let place = Place::new();
    // Level in the west, 12° uphill in the east.
    place.write("ramp.xyz", heights(|x, _| 0.2126 * (x - 6.0).max(0.0)));
    place.json("map ramp.xyz --samples 2 --gazebo --out out");
    let picture = std::fs::read(place.file("out/gazebo_slip.png")).expect("a picture");
    assert!(picture.starts_with(b"\x89PNG\r\n\x1a\n"));
    let systems = place.read("out/gazebo_slip.sdf");
    for words in [
        "gz::sim::systems::LookupWheelSlip",
        "<slip_map>gazebo_slip.png</slip_map>",
        "<wheel_link_name>",
        "<slip_compliance_longitudinal_delta>",
    ] {
        assert!(systems.contains(words), "{words}: {systems}");
    }
}
