//! Maps of the folder: their places agree with the heading, and nothing outside is read.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::time::Duration;

use grouser::document::{Kind, preset};
use grouser_raster::ReadOptions;
use grouser_serve::{Limits, Settings};
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::served::Served;

/// A plane of 20 × 20 points, 1 m apart, that rises to the north.
///
/// * `slope`: [°]
fn plane(slope: f64) -> String {
    let mut text = String::new();
    for (row, column) in (0..20).flat_map(|row| (0..20).map(move |column| (row, column))) {
        let [x, y] = [column, row].map(f64::from);
        let _ = writeln!(text, "{x} {y} {}", y * slope.to_radians().tan());
    }
    text
}

fn served(limits: Limits) -> (TempDir, Served) {
    let outside = tempfile::tempdir().unwrap();
    let folder = outside.path().join("folder");
    fs::create_dir_all(&folder).unwrap();
    fs::write(outside.path().join("secret.xyz"), plane(10.0)).unwrap();
    fs::write(folder.join("plane.xyz"), plane(11.5)).unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink(outside.path().join("secret.xyz"), folder.join("link.xyz")).unwrap();
    let server = Served::start(&Settings { folder: Some(folder), limits, ..Settings::default() });
    (outside, server)
}

fn refusal(server: &Served, question: &str, body: &Value) -> Value {
    let reply = server.post(question, body);
    assert_eq!(reply.status, 422, "{reply:?}");
    reply.lines().remove(0)
}

/// What is asked of the plane: 16 samples.
fn asked(more: &Value) -> Value {
    let mut asked = json!({"dem": "plane.xyz", "soil": "toyoura-uncertain", "samples": 16});
    for (key, value) in more.as_object().into_iter().flatten() {
        asked[key] = value.clone();
    }
    asked
}

/// Verdict and reason are the heading's on the whole degree above; the numbers those of the slope.
#[test]
fn a_place_agrees_with_the_heading() {
    let (_folder, server) = served(Limits::default());
    let body = asked(&json!({"at_m": [7.3, 12.2], "shown": true}));
    let lines = server.post("map-place", &body).lines();
    let place = &lines[0];
    assert_eq!((&place["x_m"], &place["y_m"]), (&json!(7.0), &json!(12.0)));
    let heading = json!({"soil": "toyoura-uncertain", "slope_deg": 12, "samples": 16});
    let row = server.post("heading", &heading).lines().remove(0)["rows"][0].clone();
    for column in ["verdict", "reason"] {
        assert_eq!(place["advice"][column], row["advice"][column], "{place} {row}");
    }
    let said = lines[1]["sentences"][0].as_str().unwrap();
    assert!(said.starts_with(&row["verdict"].as_str().unwrap().replace('_', " ")), "{said}");
    let written = json!({"soil": "toyoura-uncertain", "slope_deg": 11.5, "nominal": true});
    let row = server.post("heading", &written).lines().remove(0)["rows"][0].clone();
    for column in ["slip_ratio", "sinkage_mm"] {
        let [found, expected] = [&place[column], &row[column]].map(|it| it.as_f64().unwrap());
        assert!((found / expected - 1.0).abs() < 0.01, "{column}: {found} {expected}");
    }
    assert!((place["slope_deg"].as_f64().unwrap() - 11.5).abs() < 1e-3);
    let beyond = refusal(&server, "map-place", &asked(&json!({"at_m": [25, 3]})));
    assert_eq!(beyond["key"], "at_m");
}

#[test]
fn a_map_has_its_layers_its_frame_and_its_areas() {
    let (_folder, server) = served(Limits::default());
    let body =
        asked(&json!({"layers": ["slope_deg", "heading_deg"], "shown": true, "areas": true}));
    let lines = server.post("map", &body).lines();
    let shown = &lines[1];
    let names: Vec<_> =
        shown["drawings"].as_array().unwrap().iter().map(|it| &it["name"]).collect();
    assert_eq!(names, ["slope_deg", "heading_deg"]);
    assert_eq!(shown["layers"].as_array().unwrap().len(), 8);
    assert_eq!(shown["frame"]["south_west_m"], json!([-0.5, -0.5]));
    assert_eq!(shown["frame"]["north_east_m"], json!([19.5, 19.5]));
    // All of the plane is a go or a caution: there are no areas, and the answer says why.
    assert!(shown.get("files").is_none() && lines[0]["keep_out"].is_null());
    let unknown = refusal(&server, "map", &asked(&json!({"layers": "slop_deg"})));
    assert_eq!(unknown["key"], "layers");
    let nominal = refusal(&server, "map", &json!({"dem": "plane.xyz", "nominal": true}));
    assert_eq!(nominal["key"], "nominal");
}

/// A map that is there is not computed again, and one whose file was written anew is.
#[test]
fn what_is_kept_is_of_the_file_as_it_is() {
    let (outside, server) = served(Limits::default());
    let first = server.post("map", &asked(&json!({})));
    assert_eq!(server.post("map", &asked(&json!({}))).body, first.body);
    fs::write(outside.path().join("folder/plane.xyz"), plane(5.0)).unwrap();
    let other = server.post("map", &asked(&json!({}))).lines().remove(0);
    let slope = other["files"][0]["most"].as_f64().unwrap();
    assert!((slope - 5.0).abs() < 1e-3, "{slope}");
}

#[test]
fn a_way_has_its_line() {
    let (_folder, server) = served(Limits::default());
    let ends = json!({"samples": 4, "from_m": [3, 3], "to_m": [15, 3], "shown": true});
    let lines = server.post("route", &asked(&ends)).lines();
    assert_eq!(lines[0]["status"], "found");
    let line = lines[1]["files"]["route.geojson"].as_str().unwrap();
    let line: Value = serde_json::from_str(line).unwrap();
    assert_eq!(line["features"][0]["geometry"]["coordinates"], lines[0]["waypoints"]);
    for (key, ends) in [
        ("to_m", json!({"from_m": [3, 3], "to_m": [33, 3]})),
        ("from_m", json!({"from_m": [-9, 3], "to_m": [3, 3]})),
        ("from_m", json!({"to_m": [3, 3]})),
        ("minimise", json!({"from_m": [3, 3], "to_m": [9, 3], "minimise": "fun"})),
    ] {
        assert_eq!(refusal(&server, "route", &asked(&ends))["key"], key);
    }
}

#[test]
fn no_map_and_no_areas_are_read_outside_of_the_folder() {
    let (outside, server) = served(Limits::default());
    let listed = server.ask("GET", "/api/files", "", "").lines().remove(0);
    assert_eq!(listed["rows"], json!([{"kind": "map", "path": "plane.xyz"}]));
    let secret = outside.path().join("secret.xyz");
    let mut names = vec!["../secret.xyz", secret.to_str().unwrap(), "/etc/passwd"];
    if cfg!(unix) {
        names.push("link.xyz");
    }
    for name in names {
        let said = |question: &str, body: &Value, key: &str| {
            let error = refusal(&server, question, body);
            assert_eq!(error["key"], key, "{error}");
            let said = error["error"].as_str().unwrap();
            assert!(said.contains("leads out"), "{error}");
        };
        said("map", &json!({ "dem": name }), "dem");
        let ends = json!({"from_m": [3, 3], "to_m": [15, 3], "keep_out": name});
        said("route", &asked(&ends), "keep_out");
    }
    let absent = refusal(&server, "map", &json!({"dem": "absent.xyz"}));
    assert!(!absent["error"].as_str().unwrap().contains(&*Path::new("folder").to_string_lossy()));
    let none = Served::usual();
    assert_eq!(refusal(&none, "map", &json!({"dem": "Cargo.toml"}))["key"], "dem");
}

/// Cells and time have bounds, and an answer says so.
#[test]
fn maps_are_bounded() {
    let (outside, server) =
        served(Limits { run_time: Duration::from_millis(300), ..Limits::default() });
    let long = server.post("map", &asked(&json!({"samples": 10_000})));
    assert_eq!(long.status, 503, "{long:?}");
    let mut header = b"\x93NUMPY\x01\x00\x76\x00".to_vec();
    header.extend(b"{'descr': '<f4', 'fortran_order': False, 'shape': (2000, 2000), }");
    header.resize(128, b' ');
    header.resize(128 + 16_000_000, 0);
    fs::write(outside.path().join("folder/large.npy"), header).unwrap();
    let large = refusal(&server, "map", &json!({"dem": "large.npy"}));
    assert_eq!(large["key"], "dem", "{large}");
    assert!(large["error"].as_str().unwrap().contains("1048576"), "{large}");
}

/// What lies beside a map, or is named by a document, belongs to it.
#[test]
fn a_changed_file_beside_a_map_is_seen() {
    let (outside, server) = served(Limits::default());
    let folder = outside.path().join("folder");
    let raster = grouser_raster::read(&folder.join("plane.xyz"), &ReadOptions::default()).unwrap();
    let map = grouser_map::elevation_model(Path::new("plane.tif"), &raster).unwrap();
    fs::write(folder.join("plane.tif"), map).unwrap();
    let with_cells = |size: f64| {
        let place = format!("<GeoTransform>0, {size}, 0, 0, 0, -{size}</GeoTransform>");
        let notes = format!("<PAMDataset>{place}</PAMDataset>");
        fs::write(folder.join("plane.tif.aux.xml"), notes).unwrap();
    };
    let answer = |more: &Value| {
        let mut question = asked(more);
        question["dem"] = "plane.tif".into();
        let reply = server.post("map", &question);
        assert_eq!(reply.status, 200, "{reply:?}");
        reply.lines().remove(0)
    };
    let steepest = || answer(&json!({}))["files"][0]["most"].as_f64().unwrap();
    let at_first = steepest();
    with_cells(2.0);
    let wider = steepest();
    assert!(wider < 0.6 * at_first, "{at_first}, {wider}");
    with_cells(4.0);
    assert!(steepest() < 0.6 * wider);

    let sand = preset(Kind::Soil, "toyoura").unwrap().text;
    let sampled = format!("{sand}\n[uncertainty]\nsamples = \"samples.csv\"\n");
    fs::write(folder.join("sampled.toml"), sampled).unwrap();
    let friction = |angle: f64| {
        let rows: String =
            (0..20).map(|at| format!("{}\n", angle + 0.01 * f64::from(at))).collect();
        fs::write(folder.join("samples.csv"), format!("friction_angle_deg\n{rows}")).unwrap();
        answer(&json!({"soil": "sampled.toml"}))["files"].clone()
    };
    // On its own slope, for which the weaker soil is too weak.
    with_cells(1.0);
    assert_ne!(friction(38.0), friction(12.0));
}

/// Nor are larger ones read that a document names, nor longer ones.
#[test]
fn maps_of_documents_are_bounded() {
    let (outside, server) = served(Limits::default());
    let folder = outside.path().join("folder");
    let mut header = b"\x93NUMPY\x01\x00\x76\x00".to_vec();
    header.extend(b"{'descr': '<f4', 'fortran_order': False, 'shape': (2000, 2000), }");
    header.resize(128, b' ');
    header.resize(128 + 16_000_000, 0);
    fs::write(folder.join("large.npy"), header).unwrap();
    let long = fs::File::create(folder.join("long.xyz")).unwrap();
    long.set_len((1 << 26) + 1).unwrap();
    for (name, said) in [("large.npy", "1048576"), ("long.xyz", "67108864 bytes")] {
        let set = json!({"scenario.terrain.file": name, "scenario.terrain.cell_size_m": 1});
        let error = refusal(&server, "traverse", &json!({ "set": set }));
        assert!(error["error"].as_str().unwrap().contains(said), "{error}");
    }
    let error = refusal(&server, "map", &json!({"dem": "long.xyz"}));
    assert!(error["error"].as_str().unwrap().contains("67108864 bytes"), "{error}");
}
