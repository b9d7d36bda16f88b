//! What a map means: systems, units, scales, masks and notes beside it; heights that no ground has.

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use grouser_core::units::Vec2;
use grouser_raster::{Fault, MapSite, Raster, ReadOptions, Remark, check_system, read, xyz};

use crate::ground;

/// A copy of a fixture in a folder of its own, for files beside it.
fn copy(folder: &tempfile::TempDir, name: &str) -> PathBuf {
    let path = folder.path().join(name);
    fs::copy(ground::fixture(name), &path).expect("it is copied");
    path
}

fn opened(path: &std::path::Path) -> Raster {
    read(path, &ReadOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// A plane of a hundred cells a side, 1 m apart, rising to the east, with heights of one's own.
fn text(height: impl Fn(u32, u32, f64) -> f64) -> Raster {
    let mut text = String::new();
    for row in 0..100 {
        for column in 0..100 {
            let plane = 100.0 + 0.1 * f64::from(column) + 0.013 * f64::from(row);
            let _ = writeln!(text, "{column} {row} {}", height(column, row, plane));
        }
    }
    xyz::decode(text.as_bytes(), &ReadOptions::default()).expect("a grid")
}

#[test]
fn heights_of_ground_are_not_remarked_upon() {
    assert_eq!(text(|_, _, plane| plane).remarks, []);
    let hilly =
        text(|x, y, _| (0.11 * f64::from(x)).sin() * 3.0 + (0.07 * f64::from(y)).cos() * 5.0);
    assert_eq!(hilly.remarks, []);
    // A roof: a ramp and a level, both of one step or none.
    let roof = text(|x, _, _| 0.25 * f64::from(x.min(50)));
    assert_eq!(roof.remarks, []);
}

#[test]
fn voids_that_no_tag_declares_are_found_with_their_height() {
    for (void, side) in [(-9999.0, -1.0), (-32768.0, -1.0), (0.0, -1.0), (32767.0, 1.0)] {
        let found = text(|x, y, plane| if x / 4 == 5 && y / 4 == 5 { void } else { plane });
        let [Remark::Void { cells: 16, height, gap }] = found.remarks[..] else {
            panic!("{void}: {:?}", found.remarks);
        };
        assert!((height - void).abs() < 1e-3, "{height}");
        assert_eq!(f64::signum(gap), side);
        assert!(found.remarks[0].to_string().contains("missing_m"), "{}", found.remarks[0]);
    }
    let two = text(|x, y, plane| match (x / 4, y / 4) {
        (5, 5) => -9999.0,
        (9, 9) => 32767.0,
        _ => plane,
    });
    assert_eq!(two.remarks.len(), 2, "{:?}", two.remarks);
    // Declared, they are missing.
    let options = ReadOptions { missing: Some(-9999.0), ..ReadOptions::default() };
    let declared =
        xyz::decode(&b"0 0 1\n1 0 -9999\n0 1 2\n1 1 2.5\n"[..], &options).expect("a grid");
    assert_eq!((declared.height(1, 0), &declared.remarks[..]), (None, &[][..]));
}

#[test]
fn heights_in_steps_are_found() {
    let whole = text(|_, _, plane| plane.round());
    let [Remark::Steps { step, slope }] = whole.remarks[..] else { panic!("{:?}", whole.remarks) };
    assert!((step - 1.0).abs() < 1e-6 && (slope.to_degrees() - 45.0).abs() < 1e-6);
    assert!(whole.remarks[0].to_string().contains("45°"), "{}", whole.remarks[0]);
    // Centimetres do no harm.
    assert_eq!(text(|_, _, plane| (100.0 * plane).round() / 100.0).remarks, []);
}

#[test]
fn spikes_and_pits_are_found_with_their_place() {
    let found = text(|x, y, plane| match (x, y) {
        (30, 40) => plane + 9.0,
        (31, 70) => plane - 12.0,
        // A boulder of a man's height is ground.
        (60, 60) => plane + 1.8,
        _ => plane,
    });
    let [Remark::Spikes { cells: 2, height, at }] = found.remarks[..] else {
        panic!("{:?}", found.remarks);
    };
    assert_eq!(at, Vec2::new(31.0, 70.0));
    assert!((height + 11.9).abs() < 0.2, "{height}");
}

#[test]
fn columns_are_found_by_their_names() {
    let decode = |text: &str| xyz::decode(text.as_bytes(), &ReadOptions::default());
    let named = decode("x,y,intensity,z\n0,0,212,1\n1,0,213,2\n0,1,214,3\n1,1,215,4\n").unwrap();
    assert_eq!(named.height(1, 1), Some(4.0));
    assert_eq!(named.remarks, [Remark::UnusedColumns { columns: vec!["intensity".into()] }]);
    for header in ["northing;easting;height [m]", "\"Y\";\"X\";\"Z\"", "# y x z", "N\tE\tH_m"] {
        let found = decode(&format!("{header}\n5;1;0,5\n6;1;0,75\n5;2;1\n6;2;2\n")).unwrap();
        assert_eq!(found.grid.south_west, Vec2::new(1.0, 5.0), "{header}");
        assert_eq!((found.height(0, 0), found.height(0, 1)), (Some(0.5), Some(0.75)), "{header}");
        assert_eq!(found.remarks, []);
    }
    let only = decode("x,y,dem_1\n0,0,1\n1,0,2\n0,1,3\n1,1,4\n").unwrap();
    assert_eq!(only.remarks, [Remark::TakenForHeight { column: "dem_1".into() }]);
    // A title has not a name for each column.
    assert_eq!(decode("Survey of the site\n0 0 1\n1 0 2\n0 1 3\n1 1 4\n").unwrap().remarks, []);
    let numbered = decode("0 0 1 7\n1 0 2 7\n0 1 3 7\n1 1 4 7\n").unwrap();
    assert_eq!(numbered.remarks, [Remark::UnusedColumns { columns: vec!["4".into()] }]);
    for (header, words) in [
        ("lon,lat,z", "in degrees"),
        ("a,b,c", "a, b, c: x, y and z"),
        ("x_ft,y_ft,z_ft", "in ft"),
        ("x,y,z [cm]", "in cm"),
    ] {
        let error = decode(&format!("{header}\n0,0,1\n1,0,2\n0,1,3\n1,1,4\n")).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
    }
}

/// GDAL's notes and world file beside a file, in its order of precedence.
#[test]
fn what_lies_beside_a_file_is_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = copy(&folder, "no-place.tif");
    assert!(matches!(
        read(&path, &ReadOptions::default()).unwrap_err().fault,
        Fault::NotReferenced
    ));
    fs::write(path.with_extension("tfw"), "2.0\n0.0\n0.0\n-2.0\n1001.0\n4999.0\n").unwrap();
    let by_world = opened(&path);
    let rows = by_world.grid.rows as f64;
    assert_eq!(by_world.grid.south_west, Vec2::new(1001.0, 4999.0 - 2.0 * (rows - 1.0)));
    let notes = |text: &str| {
        let notes = folder.path().join("no-place.tif.aux.xml");
        fs::write(notes, format!("<PAMDataset>{text}</PAMDataset>")).unwrap();
    };
    notes("<GeoTransform> 7.0, 1.0, 0.0, 90.0, 0.0, -1.0</GeoTransform>");
    assert_eq!(opened(&path).grid.south_west, Vec2::new(7.5, 90.0 - rows + 0.5));
    let first = by_world.height(0, 0).expect("known");
    let band = |inside: &str| notes(&format!("<PAMRasterBand band=\"1\">{inside}</PAMRasterBand>"));
    band(&format!("<NoDataValue>{first}</NoDataValue>"));
    assert_eq!(opened(&path).height(0, 0), None);
    band("<Scale>0.5</Scale><Offset>10</Offset>");
    assert_eq!(opened(&path).height(0, 0), Some(0.5 * first + 10.0));
    band("<UnitType>ft</UnitType>");
    let feet = read(&path, &ReadOptions::default()).unwrap_err();
    assert!(matches!(feet.fault, Fault::HeightUnit { .. }), "{feet}");
    notes("<SRS>GEOGCS[\"WGS 84\"]</SRS>");
    let degrees = read(&path, &ReadOptions::default()).unwrap_err();
    assert!(matches!(degrees.fault, Fault::Degrees { .. }), "{degrees}");
    notes("<GeoTransform>1, 2</GeoTransform>");
    let damaged = read(&path, &ReadOptions::default()).unwrap_err().to_string();
    assert!(damaged.contains(".aux.xml file beside it: its GeoTransform has not six"), "{damaged}");
}

/// Texts as PROJ writes them.
#[test]
fn systems_of_texts_are_checked() {
    const UTM: &str = r#"PROJCS["UTM 33",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",15],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1]]"#;
    let site =
        MapSite { middle: Vec2::new(500_000.0, 6_000_000.0), cell: 2.0, size: Vec2::new(1e3, 1e3) };
    assert_eq!(check_system(UTM, site).unwrap(), None);
    let with = |heights: &str| check_system(&format!("COMPD_CS[\"both\",{UTM},{heights}]"), site);
    let feet = with(
        r#"VERT_CS["NAVD88",VERT_DATUM["x",2005],UNIT["US survey foot",0.304800609601219],AXIS["Up",UP]]"#,
    );
    assert!(
        matches!(&feet, Err(Fault::HeightUnit { unit }) if unit == "US survey feet"),
        "{feet:?}"
    );
    let depths =
        with(r#"VERT_CS["depth",VERT_DATUM["x",2005],UNIT["metre",1],AXIS["Depth",DOWN]]"#);
    assert!(matches!(depths, Err(Fault::Depths)), "{depths:?}");
    assert_eq!(
        with(r#"VERT_CS["EGM96",VERT_DATUM["x",2005],UNIT["metre",1],AXIS["Up",UP]]"#).unwrap(),
        None
    );
    let feet = UTM.replace(r#"UNIT["metre",1]"#, r#"UNIT["foot",0.3048]"#);
    assert!(matches!(check_system(&feet, site), Err(Fault::Unit { unit }) if unit == "feet"));
    // Far from its meridian the same projection is larger than the ground: 0.9996 cosh(x/R).
    let east = MapSite {
        middle: Vec2::new(1_300_000.0, 6_000_000.0),
        cell: 2.0,
        size: Vec2::new(1e3, 1e3),
    };
    let Ok(Some(Remark::Scale { factors, .. })) = check_system(UTM, east) else {
        panic!("a remark")
    };
    assert!(
        (factors[0] - 1.0074).abs() < 2e-4 && (factors[1] - factors[0]).abs() < 1e-6,
        "{factors:?}"
    );
    let mercator = UTM.replace("Transverse_Mercator", "Mercator_1SP").replace("15]", "0]");
    let north =
        MapSite { middle: Vec2::new(500_000.0, 8_400_000.0), cell: 2.0, size: Vec2::new(1e3, 1e3) };
    let Err(Fault::Scale { factors, warp }) = check_system(&mercator, north) else {
        panic!("refused")
    };
    let command = warp.command("IN.tif");
    assert!((factors[0] - 2.0).abs() < 0.02, "{factors:?}");
    assert!(command.contains("EPSG:326") && command.contains("-tr 0.99"), "{command}");
    let unknown = check_system("LOCAL_CS[\"site\"]", site).unwrap();
    assert_eq!(unknown, Some(Remark::UnknownScale { system: "site".into() }));
    // Of a system without a formula the unit still counts, and degrees below heights are degrees.
    for feet in [
        r#"LOCAL_CS["site",UNIT["foot",0.3048],AXIS["x",EAST],AXIS["y",NORTH]]"#,
        r#"ENGCRS["site",EDATUM["x"],CS[Cartesian,2],AXIS["x",east,LENGTHUNIT["foot",0.3048]],AXIS["y",north,LENGTHUNIT["foot",0.3048]]]"#,
    ] {
        let fault = check_system(feet, site);
        assert!(matches!(&fault, Err(Fault::Unit { unit }) if unit == "feet"), "{fault:?}");
    }
    let degrees = r#"COMPD_CS["both",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],VERT_CS["EGM96",VERT_DATUM["x",2005],UNIT["metre",1],AXIS["Up",UP]]]"#;
    let tile =
        MapSite { middle: Vec2::new(10.5, 46.5), cell: 1.0 / 3600.0, size: Vec2::new(1.0, 1.0) };
    for text in [degrees, "EPSG:4326", "+proj=longlat +a=3396190 +b=3376200"] {
        let fault = check_system(text, tile);
        assert!(matches!(fault, Err(Fault::Degrees { .. })), "{text}: {fault:?}");
    }
}

/// A map of hundreds of kilometres has another scale at its edge: measured on a stereographic map of
/// the Moon's south pole, k = 1 + (r / 2R)², and on Mercator's at 15° N, k = 1 / cos φ.
#[test]
fn a_scale_that_varies_over_the_map_is_said() {
    let pole = "+proj=stere +lat_0=-90 +R=1737400";
    let scale = |text: &str, middle: Vec2, side: f64| {
        let site = MapSite { middle, cell: 100.0, size: Vec2::new(side, side) };
        check_system(text, site).expect("it is not refused")
    };
    assert_eq!(scale(pole, Vec2::zeros(), 100_000.0), None);
    let remark = scale(pole, Vec2::zeros(), 600_000.0).expect("a remark");
    let Remark::Scale { factors, over_map } = &remark else { panic!("{remark}") };
    let corner: f64 = 300_000.0 * 2.0_f64.sqrt() / (2.0 * 1_737_400.0);
    assert!((factors[1] - 1.0).abs() < 1e-6 && (over_map[0] - 1.0).abs() < 1e-6);
    assert!((over_map[1] - (1.0 + corner * corner)).abs() < 1e-4, "{over_map:?}");
    let words = "1.000 m on the map at its middle, and 1.000 to 1.015 m over all of it";
    assert!(remark.to_string().contains(words), "{remark}");
    let north = Vec2::new(0.0, 1_689_200.0);
    for (side, varies) in [(10_000.0, false), (100_000.0, false), (400_000.0, true)] {
        let remark = scale("+proj=merc +R=6378137", north, side).expect("it is 1.035");
        assert_eq!(remark.to_string().contains("over all of it"), varies, "{side}: {remark}");
    }
}

/// Files of GDAL whose meaning is not that of their numbers.
#[test]
fn files_that_mean_something_else_are_refused_or_applied() {
    let fault = |name: &str| read(&ground::fixture(name), &ReadOptions::default()).unwrap_err();
    for name in ["mercator-60.tif", "mercator-60-arcgis.tif"] {
        let Fault::Scale { factors, warp } = fault(name).fault else { panic!("{name}") };
        let command = warp.command("IN.tif");
        assert!((factors[0] - 2.0).abs() < 0.01, "{name}: {factors:?}");
        assert!(command.contains("EPSG:32633"), "{name}: {command}");
        let text = fault(name).to_string();
        assert!(
            text.contains("m in place of a metre") || text.contains("by the direction"),
            "{text}"
        );
    }
    let feet = fault("heights-in-survey-feet.tif").fault;
    assert!(matches!(&feet, Fault::HeightUnit { unit } if unit == "US survey feet"), "{feet}");
    // 7° from where the projection is true a note is enough.
    let polar = opened(&ground::fixture("polar-63.tif"));
    let [Remark::Scale { factors, .. }] = polar.remarks[..] else { panic!("{:?}", polar.remarks) };
    assert!(factors[0] > 1.005 && factors[1] < 1.05, "{factors:?}");
    let masked = opened(&ground::fixture("mask-beside.tif"));
    let missing = masked.heights.iter().filter(|height| height.is_nan()).count();
    assert_eq!((missing, masked.height(1, 2), masked.height(0, 2)), (1, None, Some(4.0)));
}
