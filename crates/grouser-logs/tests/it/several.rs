//! Drives of several files: as recorders part a log, and one table after another.

use std::ops::Range;
use std::path::PathBuf;

use grouser::document::given_file::GivenFile;
use serde_json::json;

use super::container::{Container, Packed};
use super::*;

/// Between two messages [ns].
const STEP: u64 = 100_000_000;
/// Of some day [ns].
const START: u64 = 1_700_000_000_000_000_000;

/// How a file of MCAP ends.
#[derive(Clone, Copy)]
enum End {
    Whole,
    Indexed,
    Cut,
}

/// Odometry and joints of a rover that goes ever faster, over some of its messages.
fn mcap(steps: Range<u32>, end: End) -> Vec<u8> {
    mcap_of(["/odom", "/joint_states"], steps, end)
}

/// A log of a rover that goes ever faster, with some of the topics `/odom` and `/joint_states`.
fn mcap_of<const N: usize>(topics: [&str; N], steps: Range<u32>, end: End) -> Vec<u8> {
    let mut log = Container::begin(Packed::Zstd);
    // Each file numbers its channels as it likes.
    if steps.start > 0 {
        log.channel("/camera", "sensor_msgs/msg/Image");
    }
    let mut channel = |topic: &str, message: &str| {
        if topics.contains(&topic) { log.channel(topic, message) } else { u16::MAX }
    };
    let odometry = channel("/odom", "nav_msgs/msg/Odometry");
    let joints = channel("/joint_states", "sensor_msgs/msg/JointState");
    for step in steps {
        let time = START + STEP * u64::from(step);
        let stamp = json!({"sec": time / 1_000_000_000, "nanosec": time % 1_000_000_000});
        let header = json!({"stamp": stamp});
        let (x, speed) = (1e-3 * f64::from(step * step), 0.01 * f64::from(step));
        let orientation = json!({"x": 0.1, "y": 0.0, "z": 0.0, "w": 0.99_f64.sqrt()});
        let pose = json!({"position": {"x": x, "y": 0.0, "z": 0.0}, "orientation": orientation});
        let message = json!({"header": header, "pose": {"pose": pose}});
        if topics.contains(&"/odom") {
            log.message(odometry, time, message.to_string().as_bytes());
        }
        let message = json!({"header": header, "name": ["front_left"], "velocity": [speed]});
        if topics.contains(&"/joint_states") {
            log.message(joints, time, message.to_string().as_bytes());
        }
        if step % 7 == 6 {
            log.end_chunk();
        }
    }
    match end {
        End::Whole => log.finish(),
        End::Indexed => log.finish_with_index(),
        End::Cut => log.cut(),
    }
}

struct Files(TempDir);

impl Files {
    fn new() -> Self {
        Self(TempDir::new().unwrap())
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.path().join(name);
        fs::write(&path, bytes).unwrap();
        path
    }
}

type All = (Vec<TelemetryRecord>, Vec<GivenFile>, Vec<String>);

fn read_all(paths: &[PathBuf]) -> Result<All, TelemetryError> {
    let options = LogOptions::default().with_odometry(Some(Odometry::Visual));
    let mut log = TelemetryLog::open_all(paths, &rover(), &options)?;
    let mut records = Vec::new();
    while let Some(record) = log.next_record()? {
        records.push(record);
    }
    assert_eq!(log.rows(), records.len() as u64 + log.lost().rows_out_of_order);
    Ok((records, log.given(), log.notes()))
}

/// The names of files with how many rows each gave.
fn gave(given: &[GivenFile]) -> Vec<(String, u64)> {
    let name =
        |it: &GivenFile| Path::new(&it.file).file_name().unwrap().to_str().unwrap().to_owned();
    given.iter().map(|it| (name(it), it.used)).collect()
}

/// Ways over the border are ways: the same records come from the parts as from the whole, in any
/// order, and from their folder, whatever says what is in it.
#[test]
fn mcap_in_parts_is_the_log_that_it_was() {
    let files = Files::new();
    let (whole, _, _) = read_all(&[files.write("whole.mcap", mcap(0..120, End::Whole))]).unwrap();
    assert_eq!(whole.len(), 120);
    let folder = files.0.path().join("drive");
    fs::create_dir(&folder).unwrap();
    let part = |number: u32, steps, end| {
        files.write(&format!("drive/drive_{number}.mcap"), mcap(steps, end))
    };
    let parts =
        [part(0, 0..41, End::Indexed), part(1, 41..90, End::Cut), part(2, 90..120, End::Whole)];
    for paths in [vec![folder], parts.iter().rev().cloned().collect()] {
        let (records, given, notes) = read_all(&paths).unwrap();
        assert!(records == whole, "{records:?}");
        let expected = [("drive_0.mcap", 41), ("drive_1.mcap", 49), ("drive_2.mcap", 30)];
        assert_eq!(gave(&given), expected.map(|(name, rows)| (name.to_owned(), rows)));
        let is_cut = |it: &String| it.contains("drive_1.mcap: the log ends at byte");
        assert!(notes.iter().any(is_cut), "{notes:?}");
    }
}

/// Recorders of one sensor each write at the same time: their files are read side by side, and are one
/// drive of a folder of drives; what shares a topic with another is a drive alone.
#[test]
fn files_of_one_sensor_each_are_one_drive() {
    let files = Files::new();
    let (whole, ..) = read_all(&[files.write("whole", mcap(0..120, End::Whole))]).unwrap();
    let folder = files.0.path().join("drive");
    fs::create_dir(&folder).unwrap();
    for end in [End::Whole, End::Indexed, End::Cut] {
        let sensor = |name: &str, topic: &str| {
            files.write(&format!("drive/{name}.mcap"), mcap_of([topic], 0..120, end))
        };
        let sensors = [
            sensor("cameras", "/odom"),
            sensor("tags", "/tags"),
            sensor("wheels", "/joint_states"),
        ];
        for paths in [vec![folder.clone()], sensors.to_vec()] {
            let (records, given, _) = read_all(&paths).unwrap();
            assert!(records == whole, "{records:?}");
            let mut given = gave(&given);
            given.sort();
            let expected = [("cameras.mcap", 120), ("tags.mcap", 0), ("wheels.mcap", 120)];
            assert_eq!(given, expected.map(|(name, rows)| (name.to_owned(), rows)));
        }
    }
    let scenario = paper::traverse().unwrap();
    let options = LogOptions::default().with_odometry(Some(Odometry::Visual));
    let drives = || DriveFolder::read(files.0.path(), &scenario, &options).unwrap().drives;
    let found: Vec<(String, usize)> =
        drives().into_iter().map(|it| (it.name, it.records)).collect();
    assert_eq!(found, [("drive".to_owned(), 120)]);
    files.write("drive/again.mcap", mcap_of(["/odom"], 0..20, End::Whole));
    assert_eq!(drives().len(), 3);
}

/// Files of one drive follow one another; a recorder may part a log within the mapping's window.
#[test]
fn files_that_overlap_are_refused_by_name() {
    let files = Files::new();
    let refused = |one: PathBuf, other: PathBuf| {
        let error = read_all(&[other.clone(), one.clone()]).unwrap_err();
        assert!(matches!(error.problem(), Problem::Overlap { .. }), "{error}");
        for path in [&one, &other] {
            let name = path.file_name().unwrap().to_str().unwrap();
            assert!(error.to_string().contains(name), "{error}");
        }
    };
    for end in [End::Whole, End::Indexed, End::Cut] {
        let one = files.write("one.mcap", mcap(0..60, end));
        let within = files.write("within.mcap", mcap(55..80, end));
        let (records, ..) = read_all(&[within, one.clone()]).unwrap();
        assert_eq!(records.len(), 80);
        refused(one, files.write("other.mcap", mcap(40..80, end)));
    }
    let table = |name: &str, times: [f64; 2]| {
        files.write(name, format!("time_s,roll_deg\n{},1\n{},2\n", times[0], times[1]))
    };
    refused(table("a.csv", [0.0, 2.0]), table("b.csv", [1.0, 3.0]));
    refused(table("c.csv", [0.0, 1.0]), table("d.csv", [0.0, 1.0]));
    refused(table("e.csv", [1.7e9, 1.7e9 + 2.0]), files.write("f.mcap", mcap(0..5, End::Whole)));
}

/// What a table has first since a row before it is of nobody knows when.
#[test]
fn tables_follow_one_another_and_the_way_between_them_is_not_known() {
    let files = Files::new();
    let later = files.write(
        "later.csv",
        "time_s;roll_deg;vo_dx_m;extra\n2;1,5;;0\n3;1,5;0,25;0\n4;oops;0,25;0\n",
    );
    let first = files.write("first.csv", "time_s,roll_deg,vo_dx_m\n0,1,\n1,1,0.5\n");
    let (records, given, notes) = read_all(&[later.clone(), first.clone()]).unwrap();
    let times: Vec<f64> = records.iter().map(|it| it.time).collect();
    assert_eq!(times, [0.0, 1.0, 2.0, 3.0, 4.0]);
    let is_known: Vec<bool> = records.iter().map(|it| !it.is_way_incomplete).collect();
    assert_eq!(is_known, [true, true, false, false, true]);
    assert_eq!(gave(&given), [("first.csv".to_owned(), 2), ("later.csv".to_owned(), 3)]);
    for part in ["1 cell of `roll_deg`", "later.csv: columns not used: extra"] {
        assert!(notes.iter().any(|it| it.contains(part)), "{part}: {notes:?}");
    }
    // A log of messages after a table, by the clock of both.
    let day = files.write("day.csv", format!("time_s,roll_deg\n{},1\n", START / 1_000_000_000 - 9));
    let (records, given, _) =
        read_all(&[files.write("log.mcap", mcap(0..10, End::Whole)), day]).unwrap();
    assert_eq!((records.len(), given.len()), (11, 2));
}

#[test]
fn a_file_or_a_folder_that_gives_nothing_is_named() {
    let files = Files::new();
    let table = files.write("a.csv", "time_s,roll_deg\n1,2\n");
    let empty = files.write("empty.csv", "time_s,roll_deg\n");
    let folder = files.0.path().to_owned();
    for (paths, name, part) in [
        (vec![table.clone(), empty], "empty.csv", "has no rows of telemetry"),
        (vec![table.clone(), folder.join("nowhere.csv")], "nowhere.csv", "no such file"),
        (vec![folder.clone()], folder.to_str().unwrap(), "no file's name ends with .mcap"),
    ] {
        let error = read_all(&paths).unwrap_err().to_string();
        assert!(error.contains(name) && error.contains(part), "{error}");
    }
    files.write("drive_0.db3", b"SQLite format 3\0");
    let error = read_all(&[folder]).unwrap_err();
    assert_eq!(error.remedy(), Some(Remedy::Python), "{error}");
    assert_eq!(TelemetryLog::label_of(&[table.clone(), table]).matches("and 1 more").count(), 1);
}

/// A pipe would be at another place once it was looked into.
#[test]
#[cfg(unix)]
fn what_can_be_read_once_is_none_of_several() {
    let files = Files::new();
    let table = files.write("a.csv", "time_s,roll_deg\n1,2\n");
    let error = read_all(&[table, PathBuf::from("/dev/null")]).unwrap_err();
    assert!(matches!(error.problem(), Problem::NotAmongSeveral), "{error}");
    assert_eq!(error.label(), "/dev/null");
}
