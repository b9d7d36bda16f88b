//! Tables of measurements, and robots as URDF.

use grouser::document::{plates, shear_tests};
use grouser_io::measurements::columns::COLUMNS;
use grouser_io::measurements::motor_log::{LogChoice, read_motor_log};
use grouser_io::measurements::slope_tests::read_slopes;
use grouser_io::measurements::{self, Choice, Layout, Limits, Mapping};
use grouser_io::urdf::{UrdfOptions, import};
use grouser_io::{Kind, Overrides, Source, presets, read_rover};

use super::{Outcome, Reader, finite, refused};
use crate::corpus;

pub(super) fn all() -> Vec<Reader> {
    let mut of_wheels: Vec<Vec<u8>> = vec![corpus::WHEEL_TESTS.into()];
    of_wheels.extend(data_sets(COLUMNS[0].name));
    let mut of_slopes: Vec<Vec<u8>> = vec![corpus::SLOPE_TESTS.into()];
    of_slopes.extend(data_sets("slope_deg"));
    vec![
        Reader::new("wheel tests", 10, of_wheels, |bytes, _| {
            finite(&measurements::read_from("tests.csv", bytes, &Choice::default()))
        }),
        Reader::new("slope tests", 10, of_slopes, |bytes, stage| {
            finite(&read_slopes("climbs.csv", bytes, &Choice::default(), &stage.rover))
        }),
        Reader::new("plate tests", 10, vec![corpus::PLATE_TESTS.into()], |bytes, _| {
            finite(&plates::read_from("plates.csv", bytes, Limits::default()))
        }),
        Reader::new("shear tests", 10, vec![corpus::SHEAR_TESTS.into()], |bytes, _| {
            finite(&shear_tests::read_from("shear.csv", bytes, Limits::default()))
        }),
        Reader::new("log of motors", 10, vec![corpus::MOTOR_LOG.into()], |bytes, stage| {
            finite(&read_motor_log("log.csv", bytes, &LogChoice::default(), &stage.motors))
        }),
        Reader::new("another's table", 10, vec![corpus::OTHER_TABLE.into()], |bytes, _| {
            others(bytes)
        }),
        Reader::new("texts", 10, vec![corpus::SLOPE_TESTS.into()], |bytes, stage| {
            finite(&measurements::read_texts(&stage.file("t.csv", bytes), Limits::default()))
        }),
        Reader::new(
            "URDF",
            10,
            vec![corpus::ROBOT.into(), corpus::ROBOT_OF_MESHES.into()],
            |bytes, _| robot(bytes, None),
        ),
        Reader::new("STL", 5, corpus::stl(), |bytes, _| mesh("stl", bytes)),
        Reader::new("OBJ", 5, vec![corpus::OBJ.into()], |bytes, _| mesh("obj", bytes)),
        Reader::new("COLLADA", 5, vec![corpus::COLLADA.into()], |bytes, _| mesh("dae", bytes)),
    ]
}

/// The rows of data sets that come with the program and have a column.
fn data_sets(column: &str) -> impl Iterator<Item = Vec<u8>> {
    /// Some rows are as good as all.
    const LINES: usize = 40;
    let rows = presets(Kind::DataSet).filter_map(|preset| preset.rows);
    let has = move |rows: &&str| rows.lines().any(|line| line.split(',').any(|it| it == column));
    rows.filter(has).map(|rows| {
        rows.lines().take(LINES).map(|line| format!("{line}\n")).collect::<String>().into()
    })
}

/// A table in other columns and units, and what becomes of it.
fn others(bytes: &[u8]) -> Outcome {
    let mappings = ["load_n=W", "slip_ratio=slip:%", "sinkage_mm=z:cm"];
    let mappings: Result<Vec<Mapping>, _> = mappings.into_iter().map(Mapping::parse).collect();
    let layout = Layout { delimiter: b';', decimal_comma: true, ..Layout::default() };
    let mappings = mappings.unwrap_or_else(|problem| panic!("{problem}"));
    match measurements::import("lab.csv", bytes, &mappings, &layout) {
        Ok(table) => {
            finite(&measurements::read_from("ours", table.text.as_bytes(), &Choice::default()))
        }
        Err(error) => refused(&error),
    }
}

/// A robot, and the rover that its document says it is.
fn robot(bytes: &[u8], mesh: Option<&[u8]>) -> Outcome {
    let meshes = |_: &str| mesh.map(<[u8]>::to_vec);
    let options = UrdfOptions { has_differential: true, ..UrdfOptions::default() };
    let found = match import(bytes, &options, &meshes) {
        Ok(found) => found,
        Err(error) => return refused(&error),
    };
    if let fault @ Outcome::Wrong(_) = crate::finite::finite(&found.wheels) {
        return fault;
    }
    super::any(&read_rover(&Source::text("a robot", found.toml), &Overrides::none()))
}

/// A robot whose wheels have these meshes.
fn mesh(ending: &str, bytes: &[u8]) -> Outcome {
    robot(corpus::ROBOT_OF_MESHES.replace("ENDING", ending).as_bytes(), Some(bytes))
}
