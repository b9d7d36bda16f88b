use std::fs;

use grouser_core::paper;
use grouser_core::soil::Soil;
use grouser_core::terrain::Extent;
use grouser_core::units::{Vec2, deg};
use grouser_raster::zones::geojson;
use grouser_raster::{
    Content, CoordinateSystem, Fault, MapFrame, ReadOptions, ZoneKey, ZoneMap, read, read_zones,
};

use crate::ground::fixture;

fn soils(count: u8) -> Vec<Soil> {
    let soil =
        |number: u8| Soil { friction_angle: deg(30.0 + f64::from(number)), ..paper::toyoura() };
    (0..count).map(soil).collect()
}

fn names(all: &[&str]) -> Vec<ZoneKey> {
    all.iter().map(|name| ZoneKey::Name((*name).to_owned())).collect()
}

fn from_text(name: &str, text: &str) -> Result<ZoneMap, Fault> {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join(name);
    fs::write(&file, text).expect("written");
    read_zones(&file, &ReadOptions::default(), None)
        .map(|(map, _)| map)
        .map_err(|error| error.fault)
}

/// A feature of a soil, by the rings of its polygon.
fn feature(soil: &str, rings: &str) -> String {
    format!(
        r#"{{"type":"Feature","properties":{{"id":[1,{{}}],"soil":{soil}}},"geometry":{{"type":"Polygon","coordinates":{rings}}}}}"#
    )
}

fn collection(features: &[String]) -> String {
    format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, features.join(","))
}

const SQUARE: &str = "[[[0,0],[90.5,0],[90.5,500],[0,500],[0,0]]]";

/// Cells of a palette are classes, their nodata is no zone.
#[test]
fn a_geotiff_of_classes_has_zones() {
    let map = read_zones(&fixture("classes-palette-u8.tif"), &ReadOptions::default(), None)
        .map(|(map, _)| map);
    let map = map.expect("zones");
    assert_eq!(map.keys(), [ZoneKey::Class(3), ZoneKey::Class(7)]);
    let legend =
        [(ZoneKey::Class(7), Some(0)), (ZoneKey::Class(3), None), (ZoneKey::Class(9), Some(1))];
    let zones = map.clone().with_legend(&legend, soils(2)).expect("a legend");
    // As `tests/fixtures/make.py` has them: north-western corner of the map, cells of 2 m.
    let at = |column: f64, row: f64| Vec2::new(500_000.5 + 2.0 * column, 5_200_060.25 - 2.0 * row);
    for (column, row, expected) in [
        (1.0, 1.0, None),
        (5.1, 1.0, Some(0)),
        (1.0, 4.1, Some(0)),
        (1.0, 11.9, Some(0)),
        (1.0, 12.1, None),
    ] {
        assert_eq!(zones.zone(at(column, row)), expected, "column {column}, row {row}");
    }
    let missing = map.with_legend(&[(ZoneKey::Class(3), Some(0))], soils(1)).expect_err("7 is not");
    assert_eq!(missing.to_string(), "has zones that the legend has no soil for: 7");
    // As heights a palette stays refused.
    let heights = read(&fixture("classes-palette-u8.tif"), &ReadOptions::default());
    assert!(matches!(heights.expect_err("colours").fault, Fault::Samples { .. }));
}

#[test]
fn text_of_classes_has_zones_and_heights_are_none() {
    let map = from_text("zones.xyz", "0 0 -4\n1 0 12\n0 1 12\n1 1 nan\n").expect("zones");
    assert_eq!(map.keys(), [ZoneKey::Class(-4), ZoneKey::Class(12)]);
    let heights = from_text("zones.xyz", "0 0 1\n1 0 12.5\n0 1 12\n1 1 0\n").expect_err("heights");
    assert!(matches!(heights, Fault::NoClass { number: 12.5, x: 1.0, y: 0.0 }), "{heights}");
    let points = (0..400).map(|i| format!("{} {} {i}\n", i % 20, i / 20));
    let many = from_text("zones.xyz", &points.collect::<String>()).expect_err("too many");
    assert!(matches!(many, Fault::TooManyZones { zones: 256 }), "{many}");
    let far = from_text("zones.xyz", "0 0 1\n1 0 20000001\n0 1 12\n1 1 0\n").expect_err("rounded");
    assert!(matches!(far, Fault::NoClass { .. }), "{far}");
}

#[test]
fn geojson_has_zones_in_its_order_with_holes() {
    let island = "[[[0,0],[10,0],[10,10],[0,10],[0,0]],[[4,4],[6,4],[6,6],[4,6],[4,4]]]";
    let several = r#"{"type":"Feature","properties":{"soil":2},"geometry":{"coordinates":
        [[[[20,0,5.5],[30,0,7],[30,10,1],[20,0,5.5]]],[[[8,8],[9,8],[9,9],[8,8]]]],"type":"MultiPolygon"}}"#;
    let text = collection(&[feature("\"dune\"", island), several.to_owned()]);
    let map = from_text("zones.geojson", &format!("\u{feff} {text}")).expect("zones");
    let keys = [ZoneKey::Class(2), ZoneKey::Name("dune".into())];
    assert_eq!(map.keys(), keys);
    let extent = map.extent().expect("some");
    assert_eq!((extent.south_west, extent.north_east), (Vec2::zeros(), Vec2::new(30.0, 10.0)));
    let legend = [(keys[0].clone(), Some(1)), (keys[1].clone(), Some(0))];
    let zones = map.with_legend(&legend, soils(2)).expect("a legend");
    for (x, y, expected) in [
        (1.0, 1.0, Some(0)),
        (5.0, 5.0, None),
        (8.8, 8.4, Some(1)),
        (29.0, 5.0, Some(1)),
        (21.0, 9.0, None),
    ] {
        assert_eq!(zones.zone(Vec2::new(x, y)), expected, "{x}, {y}");
    }
    let one = from_text("zones.json", &feature("\"crust\"", SQUARE)).expect("a feature alone");
    assert_eq!(one.keys(), names(&["crust"]));
}

#[test]
fn keys_without_a_soil_are_listed() {
    let features: Vec<String> =
        (10..40).map(|i| feature(&format!("\"unit {i}\""), SQUARE)).collect();
    let map = geojson::decode(collection(&features).as_bytes()).expect("zones");
    let fault = map.with_legend(&[(ZoneKey::Name("unit 10".into()), None)], Vec::new());
    let text = fault.expect_err("29 of them").to_string();
    assert!(text.contains("\"unit 11\", \"unit 12\"") && text.ends_with("and 9 more"), "{text}");
}

#[test]
fn coordinates_that_are_no_metres_of_the_map_are_refused() {
    let with_system = |name: &str| {
        let text = collection(&[feature("\"a\"", SQUARE)]);
        let system = format!(r#"{{"crs":{{"type":"name","properties":{{"name":"{name}"}}}},"#);
        from_text("zones.geojson", &text.replacen('{', &system, 1))
    };
    for degrees in ["urn:ogc:def:crs:OGC:1.3:CRS84", "urn:ogc:def:crs:EPSG::4326", "IAU_2015:30100"]
    {
        let fault = with_system(degrees).expect_err("degrees");
        assert!(fault.hint(None).is_some_and(|it| it.contains("-t_srs")), "{fault}");
    }
    for metres in ["urn:ogc:def:crs:EPSG::32633", "IAU_2015:30135"] {
        assert!(with_system(metres).is_ok(), "{metres}");
    }

    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("zones.geojson");
    let fault = |rings: &str, ground: (f64, f64)| {
        fs::write(&file, feature("\"a\"", rings)).expect("written");
        let south_west = Vec2::new(ground.0, ground.1);
        let extent = Extent { south_west, north_east: south_west + Vec2::new(100.0, 100.0) };
        let ground = MapFrame { system: None, extent };
        read_zones(&file, &ReadOptions::default(), Some(&ground)).map(|_| ())
    };
    let degrees = "[[[10.1,46.2],[10.2,46.2],[10.2,46.3],[10.1,46.2]]]";
    let found = fault(degrees, (500_000.0, 5_200_000.0)).expect_err("degrees").fault;
    assert!(matches!(found, Fault::ZonesInDegrees), "{found}");
    // A site with coordinates of its own is no degrees.
    assert!(fault(degrees, (-50.0, 0.0)).is_ok());
    let found = fault(SQUARE, (500_000.0, 5_200_000.0)).expect_err("elsewhere").fault;
    assert!(matches!(found, Fault::Elsewhere { .. }), "{found}");
    assert!(found.to_string().contains("x = 0 to 90.5 m"), "{found}");
}

/// A system by its code in the register, the map's, another one, and none: the first is the map's,
/// the second is refused with both, and of the rest it is said that nobody looked.
#[test]
fn the_system_that_places_name_is_that_of_the_map() {
    let map = |name: &str| {
        let raster = read(&fixture(name), &ReadOptions::default()).expect("a map");
        raster.coordinates
    };
    let [utm_33, moon] = ["tiled-deflate-f32.tif", "moon-cog-deflate-f32.tif"].map(map);
    let arcgis = CoordinateSystem::of_text(&UTM_33.replace(",AUTHORITY[\"EPSG\",\"32633\"]]", "]"));
    let compared = |name: Option<&str>, map: &CoordinateSystem| {
        let crs = name.map_or_else(String::new, |name| {
            format!(r#""crs": {{"type": "name", "properties": {{"name": "{name}"}}}},"#)
        });
        let text = format!(r#"{{"type": "FeatureCollection", {crs} "features": []}}"#);
        let found = geojson::compare_system(text.as_bytes(), map);
        found
            .map(|remark| remark.map(|it| it.to_string()))
            .map_err(|fault| fault.in_parts("file", None))
    };
    for same in ["urn:ogc:def:crs:EPSG::32633", "EPSG:32633", "WGS 84 / UTM zone 33N"] {
        assert_eq!(compared(Some(same), &utm_33), Ok(None));
    }
    let (sentence, hint) = compared(Some("EPSG:32632"), &utm_33).expect_err("another zone");
    assert!(sentence.contains("EPSG:32632") && sentence.contains("EPSG:32633"), "{sentence}");
    assert_eq!(hint.as_deref(), Some("ogr2ogr -t_srs EPSG:32633 OUT.geojson IN.geojson"));
    // Systems without a code are compared by their formulas.
    assert_eq!(compared(Some("EPSG:32633"), &arcgis), Ok(None));
    for other in [&arcgis, &moon] {
        let (sentence, _) = compared(Some("EPSG:32632"), other).expect_err("another system");
        assert!(sentence.contains("coordinates of the system EPSG:32632"), "{sentence}");
    }
    for (name, map, words) in [
        (None, &utm_33, "it names none, and the map WGS 84 / UTM zone 33N"),
        (Some("IAU_2015:30135"), &moon, "it names IAU_2015:30135, and the map"),
        (Some("IAU_2015:30135"), &CoordinateSystem::default(), "and the map none"),
    ] {
        let remark = compared(name, map).expect("it is not refused").expect("a remark");
        assert!(remark.contains(words), "{remark}");
    }
    for nameless in [&moon, &CoordinateSystem::default()] {
        assert_eq!(compared(None, nameless), Ok(None));
    }
    assert_eq!(geojson::compare_system(b"0 0 1\n", &utm_33).expect("text"), None);
}

/// UTM 33 as rasterio has it.
const UTM_33: &str = r#"PROJCS["WGS 84 / UTM zone 33N",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433],AUTHORITY["EPSG","4326"]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",15],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1],AUTHORITY["EPSG","32633"]]"#;

/// Texts become codes, or keys from which the same text comes back.
#[test]
fn systems_of_texts_are_those_of_keys() {
    let of_code = CoordinateSystem::of_text(UTM_33);
    assert_eq!((of_code.epsg(), of_code.to_text().as_deref()), (Some(32633), Some("EPSG:32633")));
    let own = UTM_33.replace(",AUTHORITY[\"EPSG\",\"32633\"]]", "]");
    let of_own = CoordinateSystem::of_text(&own);
    assert_eq!((of_own.epsg(), of_own.to_text()), (None, Some(own)));
    assert_eq!(of_own.name(), "WGS 84 / UTM zone 33N");
    assert_eq!(of_own.is_same(&of_code), Some(true));
    assert_eq!(of_own.is_same(&CoordinateSystem::of_text("EPSG:32632")), Some(false));
    assert_eq!(of_own.is_same(&CoordinateSystem::of_text("LOCAL_CS[\"site\"]")), None);
    let moon = read(&fixture("moon-cog-deflate-f32.tif"), &ReadOptions::default()).expect("a map");
    let words = moon.coordinates.to_text().expect("its method is known");
    assert!(words.starts_with("+proj=stere") && words.contains("=1737400"), "{words}");
    assert_eq!(moon.coordinates.is_same(&CoordinateSystem::of_text(&words)), Some(true));
    assert_eq!(moon.coordinates.is_same(&of_code), Some(false));
}

/// Classes of the map's system, of another one, and of none.
#[test]
fn classes_are_in_the_system_of_the_map() {
    let classes = read(&fixture("classes-palette-u8.tif"), &options_of_classes()).expect("classes");
    let on = |system: &CoordinateSystem| {
        let frame = MapFrame { system: Some(system), extent: classes.grid.extent() };
        read_zones(&fixture("classes-palette-u8.tif"), &ReadOptions::default(), Some(&frame))
            .map(|(_, remark)| remark)
            .map_err(|error| (error.fault.to_string(), error.fault.hint(Some(&error.file))))
    };
    assert_eq!(on(&classes.coordinates), Ok(None));
    let other = CoordinateSystem::of_text("EPSG:32610");
    let (problem, hint) = on(&other).expect_err("another system");
    assert!(problem.contains("and the map those of EPSG:32610"), "{problem}");
    assert!(hint.expect("a command").starts_with("gdalwarp -r near -t_srs EPSG:32610 "));
    let unknown = on(&CoordinateSystem::of_text("LOCAL_CS[\"site\"]")).expect("not refused");
    assert!(unknown.expect("a remark").to_string().contains("was not looked at"));
}

fn options_of_classes() -> ReadOptions {
    ReadOptions { content: Content::Classes, ..ReadOptions::default() }
}

/// Class numbers jump as no heights do, and nothing is odd about that.
#[test]
fn classes_are_not_looked_at_as_heights_are() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("classes.xyz");
    let class = |x: u8, y: u8| if (x, y) == (3, 3) { 200 } else { 1 };
    let lines = (0..7).flat_map(|y| (0..7).map(move |x| format!("{x} {y} {}\n", class(x, y))));
    fs::write(&file, lines.collect::<String>()).expect("written");
    let remarks = |content: Content| {
        let options = ReadOptions { content, ..ReadOptions::default() };
        read(&file, &options).expect("a grid").remarks
    };
    assert!(!remarks(Content::Heights).is_empty());
    assert_eq!(remarks(Content::Classes), []);
}

/// The words of a refusal.
fn refused(text: &str, words: &str) {
    let start: String = text.chars().take(200).collect();
    let fault = geojson::decode(text.as_bytes()).expect_err(&start).to_string();
    assert!(fault.contains(words) && fault.len() < 500, "{start}: {fault}");
}

#[test]
fn features_that_are_no_zones_are_refused_by_their_number() {
    let with = |soil: &str, rings: &str| collection(&[feature("1", SQUARE), feature(soil, rings)]);
    refused(
        &with("\"a\"", "[[[0,0],[1,0],[1,1],[0,1]]]"),
        "in feature 2, counted from 1: its ring 1 is not closed: it begins at 0, 0 and ends at 0, \
         1",
    );
    refused(&with("\"a\"", "[[[0,0],[1,0],[0,0]]]"), "has 3 places");
    refused(&with("\"a\"", "[[]]"), "ring 1 is empty");
    refused(&with("\"a\"", "[[0,0],[1,0],[1,1],[0,0]]"), "a list of places is expected");
    refused(&with("\"a\"", "[[[[0,0],[1,0],[1,1],[0,0]]]]"), "a place is expected");
    refused(&with("null", SQUARE), "no property \"soil\"");
    refused(&with("1.5", SQUARE), "neither a text nor a whole number");
    refused(&with("[true]", SQUARE), "neither a text nor a whole number");
    let point = r#"{"type":"Feature","properties":{"soil":1},"geometry":{"type":"Point","coordinates":[1,2]}}"#;
    refused(point, "its geometry is a Point");
    refused(r#"{"type":"Feature","properties":{"soil":1},"geometry":null}"#, "no geometry");
    refused(r#"{"type":"Feature","geometry":null}"#, "no property");
    refused(r#"{"type":"Polygon","coordinates":[]}"#, "is of type Polygon");
    refused(r#"{"type":"Topology","objects":{}}"#, "is of type Topology");
    refused("{}", "is of type nothing");
    refused("[]", "is of type nothing");
}

#[test]
fn hostile_geojson_is_refused() {
    for text in [
        "",
        "{",
        "{\"type\":\"Feature\"",
        "nul",
        r#"{"type":"Feature","geometry":{"type":"Polygon","coordinates":[[[1e999,0]]]}}"#,
        r#"{"type":"Feature","geometry":{"type":"Polygon","coordinates":[[[0]]]}}"#,
        r#"{"type":"Feature","geometry":{"type":"Polygon","coordinates":[[[0,"x"]]]}}"#,
        r#"{"type":"Feature","geometry":{"type":"Polygon","coordinates":[[[0,0],7]]}}"#,
        r#"{"type":"Feature","geometry":{"type":"Polygon","coordinates":7}}"#,
        r#"{"type":"FeatureCollection","features":{}}"#,
        r#"{"type":"FeatureCollection","features":null}"#,
    ] {
        refused(text, "is no GeoJSON");
    }
    let deep = 100_000;
    let nested = format!("{}{}", "[".repeat(deep), "]".repeat(deep));
    refused(&feature("1", &nested), "recursion limit");
    // What is passed over may be as deep as it likes.
    refused(&feature(&nested, SQUARE), "neither a text nor a whole number");
    refused(&format!("{{\"a\":{}", "{\"a\":".repeat(deep)), "is no GeoJSON");
    let many = vec!["{}"; 100_001].join(",");
    refused(&format!(r#"{{"type":"FeatureCollection","features":[{many}]}}"#), "100000 features");
    let long = " ".repeat(usize::try_from(geojson::LARGEST_FILE).expect("small"));
    refused(&(long + "{}"), "larger than 32 MiB");
    // Names steer no terminal and fill no screen.
    refused(&format!(r#"{{"type":"\u001b[31m{}"}}"#, "x".repeat(9999)), "is of type [31mxxx");
}

/// Degrees are known by ground that lies elsewhere, by how near places are to each other, and by the
/// code of a system; metres of a small map are none.
#[test]
fn degrees_are_known_by_places_and_by_systems() {
    let extent = |[x, y]: [f64; 2], size: f64| Extent {
        south_west: Vec2::new(x, y),
        north_east: Vec2::new(x + size, y + size),
    };
    let ground = extent([500_000.0, 5_400_000.0], 100.0);
    let legs = extent([8.4, 49.0], 2.0);
    assert!(grouser_raster::check_places_on(&ground, &legs).is_err());
    assert!(grouser_raster::check_places_on(&ground, &ground).is_ok());
    assert!(grouser_raster::check_places_on(&extent([0.0, 0.0], 50.0), &legs).is_ok());
    for (system, places, is_metres) in [
        (None, extent([0.00001, 0.00002], 0.00002), false),
        (None, extent([0.0, 0.0], 0.5), true),
        (Some("urn:ogc:def:crs:EPSG::4258"), legs, false),
        (Some("urn:ogc:def:crs:EPSG::32632"), legs, true),
    ] {
        let found = grouser_raster::check_places(system, &places);
        assert_eq!(found.is_ok(), is_metres, "{system:?} {places:?}");
    }
}
