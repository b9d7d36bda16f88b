//! Damaged logs, and logs that claim to be larger than they are: read as far as they go, and never
//! more.

use std::io::Write as _;

use flate2::Compression;
use flate2::write::GzEncoder;

use super::container::{Container, Packed, header};
use super::format::{Chunk, Record as _, compression};
use super::*;

const MAPPING: &str = "schema = \"telemetry-mapping/1\"\nname = \"ours\"\n[[reading]]\ntopic = \"/roll\"\nfield = \"roll\"\ncolumn = \"roll_deg\"\n";

/// Four chunks of 25 messages.
fn log(packed: Packed) -> Vec<u8> {
    let mut log = Container::begin(packed);
    let channel = log.channel("/roll", "roll");
    for step in 0..100_u64 {
        log.message(channel, step * 1_000_000_000, br#"{"roll": 1.5}"#);
        if step % 25 == 24 && step < 99 {
            log.end_chunk();
        }
    }
    log.finish()
}

/// A log that ends anywhere is read to there, and the notes say so.
#[test]
fn a_log_that_is_cut_off_is_read_to_its_end() {
    for packed in [Packed::Not, Packed::Zstd, Packed::Lz4] {
        let whole = log(packed);
        let mut most = 0;
        for length in (200..whole.len()).step_by(37) {
            // Where not even the topic is there yet, the error says that.
            let Ok((records, notes)) = read(&whole[..length], Some(MAPPING)) else { continue };
            assert!(records.len() >= most, "{length} bytes");
            most = records.len();
            // Behind the end of all data there is nothing to miss.
            let is_cut = notes.iter().any(|it| it.contains("without its end"));
            assert!(is_cut || records.len() == 100, "{length}: {notes:?}");
        }
        assert_eq!(most, 100, "{packed:?}");
    }
}

#[test]
fn a_damaged_chunk_costs_no_other() {
    for packed in [Packed::Zstd, Packed::Lz4] {
        let mut bytes = log(packed);
        let middle = bytes.len() / 2;
        bytes[middle..middle + 8].fill(0xa5);
        let (records, notes) = read(&bytes, Some(MAPPING)).unwrap();
        assert!((74..100).contains(&records.len()), "{}", records.len());
        assert!(
            notes.iter().any(|it| it.contains("chunks are damaged") || it.contains("checksum")),
            "{notes:?}"
        );
    }
}

#[test]
fn sizes_that_cannot_be_are_passed_over() {
    let mut huge = Container::begin(Packed::Not).cut();
    // A chunk that says it unpacks to 2^60 bytes.
    let chunk =
        Chunk { size: 1 << 60, compression: compression::ZSTD.to_owned(), ..Chunk::default() };
    huge.extend(chunk.to_bytes());
    let whole = log(Packed::Not);
    // What follows is read.
    huge.extend(&whole[header().len()..]);
    let (records, notes) = read(&huge, Some(MAPPING)).unwrap();
    assert_eq!(records.len(), 100);
    assert!(notes.iter().any(|it| it.starts_with("1 chunks or records are larger")), "{notes:?}");
    // A record that is longer than the file ends it.
    let mut long = whole[..whole.len() - 60].to_vec();
    long.extend([7]);
    long.extend(u64::MAX.to_le_bytes());
    assert!(read(&long, Some(MAPPING)).is_ok());
}

#[test]
fn messages_that_are_none_are_counted() {
    let mut log = Container::begin(Packed::Not);
    let channel = log.channel("/roll", "roll");
    log.message(channel, 1, b"{\"roll\": ");
    log.message(channel, u64::MAX, br#"{"roll": 1.5}"#);
    log.message(channel, 2, br#"{"roll": "1.5"}"#);
    log.message(channel, 3, br#"{"pitch": 1.5}"#);
    log.message(channel, 4, br#"{"roll": [1]}"#);
    let (records, notes) = read(&log.finish(), Some(MAPPING)).unwrap();
    assert_eq!(records.iter().filter(|it| it.roll.is_some()).count(), 1);
    for part in [
        "2 messages cannot be decoded",
        "1 readings of /roll without a field",
        "1 readings of /roll are no numbers",
    ] {
        assert!(notes.iter().any(|it| it.contains(part)), "{part}: {notes:?}");
    }
}

/// Parquet has its table of content at its end: what is cut off is no table.
#[test]
fn damaged_parquet_is_refused_or_counted() {
    let mut writer =
        grouser_logs::TelemetryWriter::begin(Path::new("a.parquet"), Vec::new(), &rover()).unwrap();
    for step in 0..1000_u32 {
        let record = TelemetryRecord {
            time: f64::from(step),
            roll: Some(0.1),
            wheels: vec![WheelTelemetry::default(); 4],
            ..TelemetryRecord::default()
        };
        writer.write(&record).unwrap();
    }
    let whole = writer.finish().unwrap();
    for length in (4..whole.len()).step_by(101) {
        assert!(read(&whole[..length], None).is_err(), "{length}");
    }
    let mut damaged = whole.clone();
    // The first page's header.
    damaged[4..24].fill(0xff);
    match read(&damaged, None) {
        Ok((records, notes)) => assert!(records.len() < 1000 && !notes.is_empty(), "{notes:?}"),
        Err(error) => assert!(error.to_string().contains("log: "), "{error}"),
    }
}

/// A chunk of nothing but empty records unpacks to ten thousand times its size.
#[test]
fn a_log_that_unpacks_to_more_than_any_of_its_size_is_refused() {
    let mut log = Container::begin(Packed::Zstd);
    let channel = log.channel("/roll", "roll");
    log.message(channel, 1, b"{\"roll\": 1.0}");
    let whole = log.cut();
    let mut log = Container::begin(Packed::Zstd);
    log.channel("/roll", "roll");
    log.stuff(60_000_000);
    let bomb = log.finish();
    assert!(bomb.len() < 1 << 20, "{}", bomb.len());
    assert_eq!(read(&whole, Some(MAPPING)).unwrap().0.len(), 1);
    let error = read(&bomb, Some(MAPPING)).unwrap_err();
    assert!(error.to_string().contains("unpack to more than"), "{error}");
    assert_eq!(error.remedy(), Some(Remedy::Budget));
}

/// A table of short rows that are packed well; what is allowed counts in place of what
/// its size allows.
#[test]
fn a_packed_table_is_read_within_its_budget() {
    let mut table = b"time_s,roll_deg\n".to_vec();
    (0..40_000_u32).for_each(|row| table.extend(format!("{row}.0,1.5\n").into_bytes()));
    let mut packed = GzEncoder::new(Vec::new(), Compression::best());
    packed.write_all(&table).unwrap();
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("log.csv.gz");
    fs::write(&path, packed.finish().unwrap()).unwrap();
    let count = |most_unpacked: Option<u64>| {
        let options = LogOptions::default().with_most_unpacked(most_unpacked);
        let mut log = TelemetryLog::open(&path, &rover(), &options)?;
        let mut count = 0;
        while log.next_record()?.is_some() {
            count += 1;
        }
        Ok::<_, TelemetryError>(count)
    };
    assert_eq!(count(None).unwrap(), 40_000);
    assert_eq!(count(Some(table.len() as u64)).unwrap(), 40_000);
    let refused = count(Some(table.len() as u64 - 1)).unwrap_err();
    assert!(refused.to_string().contains("unpack to more than 0 MiB"), "{refused}");
    assert_eq!(refused.remedy(), Some(Remedy::Budget));

    let bytes = log(Packed::Zstd);
    fs::write(&path, &bytes).unwrap();
    let refused = |most: u64| {
        let mapping = Some(Mapping::parse("mapping.toml", MAPPING).unwrap());
        let options = LogOptions::default().with_mapping(mapping).with_most_unpacked(Some(most));
        let mut log = match TelemetryLog::open(&path, &rover(), &options) {
            Ok(log) => log,
            Err(error) => return Some(error.to_string()),
        };
        (0..100).find_map(|_| log.next_record().err()).map(|error| error.to_string())
    };
    assert!(refused(1 << 20).is_none());
    let refused = refused(1 << 10).expect("it unpacks to more than a kilobyte");
    assert!(refused.contains("the most that are read of it"), "{refused}");
}
