//! Maps and routes of inputs that are damaged, absurd or hostile: each is refused with what is
//! wrong.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::bad_input::check_is_refusal;
use crate::maps::heights;
use crate::program::{Place, number};

/// Invalid areas, and the words of the answer.
fn no_areas() -> [(&'static str, Value, &'static str); 12] {
    let ring = [[7005, -301], [7009, -301], [7009, -294], [7005, -294], [7005, -301]];
    let tie = [[7006, -299], [7008, -297], [7008, -299], [7006, -297], [7006, -299]];
    let polygon = |rings: Value| json!({"type": "Polygon", "coordinates": rings});
    let feature = |geometry: Value| json!({"type": "Feature", "geometry": geometry});
    let system = json!({"properties": {"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}});
    let mut degrees = feature(polygon(json!([ring])));
    degrees["crs"] = system;
    let point = json!({"type": "Point", "coordinates": [7005, -299]});
    let line = json!({"type": "LineString", "coordinates": [[7005, -299], [7006, -299]]});
    [
        (
            "a tie as a hole",
            feature(polygon(json!([ring, tie]))),
            "crosses itself near x 7007, y -298",
        ),
        (
            "three places",
            feature(polygon(json!([[ring[0], ring[1], ring[0]]]))),
            "the smallest has 4",
        ),
        ("open", feature(polygon(json!([ring[..4]]))), "is not closed"),
        ("on a line", feature(polygon(json!([[[1, 1], [2, 2], [3, 3], [1, 1]]]))), "no inside"),
        ("one place", feature(polygon(json!([[[1, 1], [1, 1], [1, 1], [1, 1]]]))), "no inside"),
        ("no ring", feature(polygon(json!([]))), "a polygon of it has no ring"),
        (
            "no place",
            feature(polygon(json!([[[1e308, 0], [0, 1], [0, 0], [1e308, 0]]]))),
            "beyond every map",
        ),
        ("a point", feature(point), "its geometry is a Point"),
        ("a line", feature(line), "its geometry is a LineString"),
        ("nothing", feature(Value::Null), "it has no geometry"),
        (
            "no feature",
            polygon(json!([ring])),
            "is of type Polygon, and areas are polygons of a Feature",
        ),
        ("degrees", degrees, "has coordinates in degrees"),
    ]
}

/// Places of another zone of UTM than the map's are refused wherever GeoJSON is read, with both
/// systems and the command that helps; of places without a system it is said, and of those of the
/// map's nothing.
#[test]
fn places_of_another_system_than_the_maps_are_refused() {
    let place = Place::new();
    let map = "../grouser-raster/tests/fixtures/tiled-deflate-f32.tif";
    let map = Path::new(env!("CARGO_MANIFEST_DIR")).join(map);
    fs::copy(map, place.file("map.tif")).expect("a copy");
    let terrain = "[terrain]\nfile = \"map.tif\"\nstart_m = [500012.0, 5200020.0]\n";
    let head = "schema = \"scenario/1\"\nname = \"zones\"\nduration_s = 1.0\n";
    place.write("zones.toml", format!("{head}{terrain}soil_file = \"areas.geojson\"\n"));
    let head = "schema = \"mission/1\"\nname = \"a drive\"\nlegs_from = \"line.geojson\"\n";
    place.write("legs.toml", format!("{head}{terrain}"));
    let lines = [
        "route map.tif --from 500012,5200020 --to 500018,5200020 --no-drive --samples 2 --keep-out areas.geojson",
        "route map.tif --no-drive --samples 2 --along line.geojson",
        "traverse zones.toml --simulation quasi-steady",
        "mission legs.toml --nominal",
    ];
    let (x, y) = (500_012, 5_200_020);
    let ring = [[x, y - 9], [x + 4, y - 9], [x + 4, y - 5], [x, y - 5], [x, y - 9]];
    let areas = json!({"type": "Polygon", "coordinates": [ring]});
    let line = json!({"type": "LineString", "coordinates": [[x, y], [x + 4, y]]});
    let write = |system: Option<&str>| {
        for (name, geometry) in [("areas.geojson", &areas), ("line.geojson", &line)] {
            let properties = json!({"soil": "toyoura"});
            let mut feature =
                json!({"type": "Feature", "properties": properties, "geometry": geometry});
            if let Some(system) = system {
                feature["crs"] = json!({"properties": {"name": system}});
            }
            place.write(name, feature.to_string());
        }
    };
    write(Some("EPSG:32632"));
    for line in lines {
        let refused = check_is_refusal(&place.line(line), 2);
        let systems = "coordinates of the system EPSG:32632, and the map those of EPSG:32633";
        assert!(refused.contains(systems), "{refused}");
        assert!(refused.contains("hint: ogr2ogr -t_srs EPSG:32633 "), "{refused}");
    }
    for (system, is_noted) in [(None, true), (Some("urn:ogc:def:crs:EPSG::32633"), false)] {
        write(system);
        for line in lines {
            let answer = place.line(line);
            let note = "it names none, and the map WGS 84 / UTM zone 33N";
            assert_eq!(answer.stderr.contains(note), is_noted, "{}", answer.conversation());
        }
    }
    let way = "route map.tif --from 500012,5200020 --to 500018,5200020 --no-drive --samples 2";
    place.results(&format!("{way} --out way"));
    let again = place.line("route map.tif --no-drive --samples 2 --along way/route.geojson");
    assert!(!again.stderr.contains("was not looked at"), "{}", again.conversation());
}

#[test]
fn areas_that_are_none_are_refused_with_a_reason() {
    let place = Place::new();
    place.write("flat.xyz", heights(|_, _| 2.0));
    let line =
        "route flat.xyz --from 7002,-298 --to 7010.5,-298 --no-drive --keep-out keep.geojson";
    let check = |what: &str, text: &str, words: &str| {
        place.write("keep.geojson", text);
        let message = check_is_refusal(&place.line(line), 2);
        assert!(message.contains("keep.geojson") && message.contains(words), "{what}: {message}");
    };
    for (what, area, words) in no_areas() {
        check(what, &area.to_string(), words);
    }
    let nan =
        r#"{"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [[[NaN, 1]]]}}"#;
    check("no number", nan, "is no GeoJSON: expected value at line 1");
    check("no JSON", "x,y\n1,2\n", "is no GeoJSON");
    check("no end", &format!("{{\"features\":{}", "[".repeat(5000)), "is no GeoJSON");
}

/// A hole in an area is open ground, which nobody can come to.
#[test]
fn an_area_with_a_hole_is_a_wall_around_it() {
    let place = Place::new();
    place.write("flat.xyz", heights(|_, _| 2.0));
    let ring = |low: f64, size: f64| {
        let [x, y] = [7000.0 + low, -300.0 + low];
        json!([[x, y], [x + size, y], [x + size, y + size], [x, y + size], [x, y]])
    };
    let rings = [ring(1.8, 6.4), ring(3.2, 3.6)];
    let area = json!({"type": "Feature", "geometry": {"type": "Polygon", "coordinates": rings}});
    place.write("keep.geojson", area.to_string());
    let line = "route flat.xyz --samples 2 --no-drive --keep-out keep.geojson --from 7004.5,-295.5";
    let within = place.json(&format!("{line} --to 7005,-295"));
    assert_eq!(within["status"], "found", "{within}");
    let out = place.json(&format!("{line} --to 7011,-295"));
    assert_eq!(out["status"], "no-safe-route");
    let reason = out["reason"].as_str().expect("a reason");
    assert!(reason.contains("cannot be crossed within the limits"), "{reason}");
}

#[test]
fn ends_where_nobody_can_be_are_named() {
    let place = Place::new();
    let steep = |x: f64, _: f64| if x > 7.0 { 1.5 * (x - 7.0) } else { 0.0 };
    place.write("steep.xyz", heights(steep));
    for (from, to, words) in [
        (
            "7003,-297",
            "7012,-297",
            "the target at x 7012.00 m, y -297.00 m is a no-go in every direction",
        ),
        (
            "7012,-295",
            "7003,-297",
            "the start at x 7012.00 m, y -295.00 m is a no-go in every direction",
        ),
        (
            "7000,-297",
            "7003,-297",
            "the start at x 7000.00 m, y -297.00 m lies at the edge of the map",
        ),
        ("7003,-297", "7012.5,-298.5", "beside a place without a height"),
    ] {
        let answer = place.json(&format!("route steep.xyz --samples 2 --from {from} --to {to}"));
        assert_eq!(answer["status"], "no-safe-route", "{answer}");
        let reason = answer["reason"].as_str().expect("a reason");
        assert!(reason.contains(words), "{reason}");
    }
    for (flags, words) in [
        (
            "--from 6000,-297 --to 7003,-297",
            "the start at x 6000.00 m, y -297.00 m is not on the map",
        ),
        ("--from nan,1 --to 7003,-297", "--from: expected two numbers"),
        ("--from 7003,-297 --to 7003,inf", "--to: expected two numbers"),
        ("--from 7003,-297 --to 7003,-297,1", "--to: expected two numbers"),
        ("--from 7003,-297 --to 7003,-296 --yaw-deg nan", "--yaw-deg"),
        ("--from 7003,-297 --to 7003,-296 --most-slope-deg nan", "--most-slope-deg"),
    ] {
        let message =
            check_is_refusal(&place.line(&format!("route steep.xyz --samples 2 {flags}")), 2);
        assert!(message.contains(words), "{message}");
    }
    // Who is there need not drive.
    let there = place.json("route steep.xyz --samples 2 --from 7003,-297 --to 7003,-297");
    assert_eq!(there["status"], "found");
    assert_eq!(
        (number(&there["length_m"]), &there["simulated"]["outcome"]),
        (0.0, &json!("completed"))
    );
}

#[test]
fn maps_too_small_for_a_rover_have_no_route() {
    let place = Place::new();
    place.write("one.xyz", "7000 -300 2\n");
    place.write("two.xyz", "7000 -300 2\n7001 -300 2\n7000 -299 2\n7001 -299 2\n");
    for command in
        ["map one.xyz --samples 2 --out m", "route one.xyz --from 7000,-300 --to 7000,-300"]
    {
        let message = check_is_refusal(&place.line(command), 2);
        assert!(message.contains("they make a line, not a grid"), "{message}");
    }
    let map = place.json("map two.xyz --samples 2 --out m");
    assert_eq!((&map["columns"], &map["rows"]), (&json!(2), &json!(2)));
    let route = place.json("route two.xyz --samples 2 --from 7000,-300 --to 7001,-299");
    assert!(
        route["reason"].as_str().expect("a reason").contains("at the edge of the map"),
        "{route}"
    );
}

/// A GeoTIFF that was cut off or whose bits were turned is refused, or read where it still makes
/// sense.
#[test]
fn damaged_files_are_refused_and_nothing_panics() {
    let place = Place::new();
    place.write("hills.xyz", heights(|x, y| 0.4 * (0.7 * x).sin() * (0.5 * y).cos()));
    place.json("map hills.xyz --samples 2 --out hills");
    let whole = fs::read(place.file("hills/slope_deg.tif")).expect("a GeoTIFF");
    // The slope's numbers are heights of another ground.
    let line = |command: &str| match command {
        "map" => "map bad.tif --samples 2 --out m --force".to_owned(),
        _ => "route bad.tif --samples 2 --no-drive --from 7004,-296 --to 7005,-296".to_owned(),
    };
    for kept in [0, 1, 4, 8, 16, 100, whole.len() / 2, whole.len() - 50] {
        fs::write(place.file("bad.tif"), &whole[..kept]).expect("it is written");
        for command in ["map", "route"] {
            let message = check_is_refusal(&place.line(&line(command)), 2);
            assert!(message.contains("bad.tif"), "{kept}: {message}");
        }
    }
    let step = whole.len() / 40;
    let mut refused = 0;
    for (number, at) in (0..whole.len()).step_by(step).enumerate() {
        let mut bytes = whole.clone();
        bytes[at] ^= 1 << (number % 8);
        fs::write(place.file("bad.tif"), &bytes).expect("it is written");
        let answer = place.line(&line("route"));
        assert!([0, 2].contains(&answer.code()), "byte {at}: {}", answer.conversation());
        assert!(!answer.stderr.contains("panicked"), "byte {at}: {}", answer.stderr);
        refused += usize::from(answer.code() == 2);
    }
    assert!(refused > 0, "no bit that was turned made a difference");
}

#[test]
fn lines_that_are_none_are_refused_with_a_reason() {
    let place = Place::new();
    place.write("flat.xyz", heights(|_, _| 2.0));
    let check = |what: &str, text: &str, words: &str| {
        place.write("line.geojson", text);
        let answer = place.line("route flat.xyz --samples 2 --no-drive --along line.geojson");
        let message = check_is_refusal(&answer, 2);
        assert!(message.contains(words), "{what}: {message}");
    };
    let line = |places: Value| json!({"type": "LineString", "coordinates": places});
    let feature = |geometry: Value| json!({"type": "Feature", "geometry": geometry});
    let way = line(json!([[7002, -298], [7008, -298]]));
    let two = json!({"type": "FeatureCollection", "features": [feature(way.clone()), feature(way.clone())]});
    let none = json!({"type": "FeatureCollection", "features": []});
    let point = json!({"type": "Point", "coordinates": [7002, -298]});
    let mut degrees = feature(way);
    degrees["crs"] = json!({"properties": {"name": "EPSG:4326"}});
    for (what, json, words) in [
        ("one place", line(json!([[7002, -298]])), "1 places, and at least two"),
        ("twice the same", line(json!([[7002, -298], [7002, -298]])), "the line has no length"),
        ("no place", line(json!([])), "0 places"),
        ("no y", line(json!([[7002], [7003]])), "a place has an x and no y"),
        (
            "too deep",
            line(json!([[[7002, -298], [7003, -298]]])),
            "where a place is expected there is a list",
        ),
        (
            "a place",
            line(json!([7002, -298])),
            "where a list of places is expected there is a place",
        ),
        ("a point", feature(point.clone()), "its geometry is a Point: a LineString is a way"),
        ("a point by itself", point, "its geometry is a Point"),
        ("nothing", feature(Value::Null), "its feature has no geometry"),
        ("two lines", two, "it has 2 features, and one line is one way"),
        ("no line", none, "it has no feature"),
        ("elsewhere", line(json!([[2000, 3], [2004, 5]])), "the line is not on the map"),
        ("degrees by their numbers", line(json!([[2, 3], [4, 5]])), "look like degrees"),
        ("too long", line(json!([[7002, -298], [1e300, -298]])), "cells of the map long"),
        ("degrees", degrees, "has coordinates in degrees"),
    ] {
        check(what, &json.to_string(), words);
    }
    let nan = r#"{"type": "LineString", "coordinates": [[NaN, 1], [2, 3]]}"#;
    check("no number", nan, "is no GeoJSON: expected value at line 1");
    check("no JSON", "x,y\n1,2\n", "is no GeoJSON");
    let message = check_is_refusal(&place.line("route flat.xyz --along nowhere.geojson"), 1);
    assert!(message.contains("nowhere.geojson"), "{message}");
    for flags in ["--from 7002,-298", "--minimise energy", "--alternatives"] {
        let line = format!("route flat.xyz --along line.geojson {flags}");
        check_is_refusal(&place.line(&line), 2);
    }
}
