//! Arrow, as pyarrow writes it.

use std::fs;
use std::path::PathBuf;

use super::{place, read, read_file};

const FILES: [&str; 4] = ["uncompressed.feather", "lz4.feather", "zstd.feather", "stream.arrows"];

fn path(name: &str) -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/it/arrow")).join(name)
}

/// Packed or not, as a file and as a stream: the same drive, whatever columns stand between.
#[test]
fn a_drive_of_arrow_is_that_of_csv() {
    for name in FILES {
        let (records, notes) = read_file(&path(name), None, &[]).unwrap();
        let unused = "columns not used: remark, not used, scans, place, kind";
        assert_eq!(notes, [unused], "{name}");
        let times: Vec<f64> = records.iter().map(|it| it.time).collect();
        assert_eq!(times, [0.0, 0.1, 0.2, 0.3, 0.4], "{name}");
        let degrees = |angle: Option<f64>| angle.map(|it| (it.to_degrees() * 1e9).round() / 1e9);
        let of = |of: fn(&_) -> Option<f64>| -> Vec<_> {
            records.iter().map(|it| degrees(of(it))).collect()
        };
        assert_eq!(of(|it| it.roll), [Some(1.5), None, Some(2.5), None, Some(0.1)], "{name}");
        assert_eq!(of(|it| it.pitch), [0.0, -1.0, 2.0, -3.0, 4.0].map(Some), "{name}");
        assert_eq!(of(|it| it.yaw), [10.0, 11.0, 12.0, 13.0, 14.0].map(Some), "{name}");
        assert_eq!(records[4].displacement[0], Some(0.04), "{name}");
        assert_eq!(records[2].wheels[place("front-left")].speed, Some(0.5), "{name}");
    }
}

/// Cut off anywhere, or with any byte another, it is read to there or refused: nothing panics, and
/// nothing takes the memory that a number claims.
#[test]
fn damaged_arrow_is_read_to_its_damage_or_refused() {
    for name in FILES {
        let bytes = fs::read(path(name)).unwrap();
        let mut records = 0;
        let mut attempt = |bytes: &[u8]| {
            if let Ok((found, _)) = read(bytes, None) {
                assert!(found.iter().all(|it| it.time.is_finite()), "{name}");
                records += found.len();
            }
        };
        for end in (0..bytes.len()).step_by(7) {
            attempt(&bytes[..end]);
        }
        for place in (0..bytes.len()).step_by(5) {
            for value in [0, 0x7f, 0xff] {
                let mut bytes = bytes.clone();
                bytes[place] = value;
                attempt(&bytes);
            }
        }
        assert!(records > 1000, "{name}: {records} records");
    }
}
