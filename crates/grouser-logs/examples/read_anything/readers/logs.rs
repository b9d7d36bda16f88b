//! Telemetry of every format, and kept states of learning.

use std::error::Error;
use std::io::Write as _;
use std::path::Path;

use flate2::Compression;
use flate2::write::GzEncoder;
use grouser::document::learn::{KeptDrive, state_text};
use grouser::simulation::{Run, Scenario};
use grouser::studies::learn::{Drive, LearnSettings, Learner};
use grouser::studies::simulated_telemetry::truth;
use grouser_core::paper;
use grouser_io::measurements::telemetry::{Odometry, numbers};
use grouser_io::{Kind, Overrides, Source, fnv_1a, preset, read_scenario};
use grouser_logs::{Log, LogOptions, Mapping, TelemetryError, TelemetryLog, TelemetryWriter};
use serde_json::Value;

use super::{Outcome, Reader, Stage, refused};
use crate::corpus;

/// The key of a state's check sum.
const CHECK_SUM: &str = "check_sum";

pub(super) fn all() -> Result<Vec<Reader>, Box<dyn Error>> {
    let [csv, parquet, own] = drives()?;
    let mut packed = GzEncoder::new(Vec::new(), Compression::default());
    packed.write_all(&csv)?;
    let mcap = |name, share, files, read| Reader {
        mend: Some(|log| without_sums(log)),
        ..Reader::new(name, share, files, read)
    };
    Ok(vec![
        Reader::new("telemetry, CSV", 10, vec![csv, corpus::DRIVE.into()], |bytes, stage| {
            log(bytes, None, stage)
        }),
        Reader::new("telemetry, gzip", 5, vec![packed.finish()?], |bytes, stage| {
            log(bytes, None, stage)
        }),
        Reader::new("telemetry, Parquet", 10, vec![parquet], |bytes, stage| {
            log(bytes, None, stage)
        }),
        Reader::new("telemetry, PlotJuggler", 3, vec![corpus::PLOTTED.into()], |bytes, stage| {
            log(bytes, Some("ros"), stage)
        }),
        mcap("MCAP, Protocol Buffers", 2, vec![own], |bytes, stage| log(bytes, None, stage)),
        mcap("MCAP, JSON", 10, corpus::mcap_of_json(), |bytes, stage| log(bytes, None, stage)),
        mcap("MCAP, CDR and ROS 1", 10, corpus::mcap_of_ros(), |bytes, stage| {
            log(bytes, Some(corpus::ROLL), stage)
        }),
        Reader {
            mend: Some(with_sum),
            ..Reader::new("state of learning", 1, vec![state()?], |bytes, _| kept(bytes))
        },
    ])
}

/// The records of a log, one by one.
///
/// * `mapping`: the name of a built-in one, or a document
fn log(bytes: &[u8], mapping: Option<&str>, stage: &Stage) -> Outcome {
    match records(&stage.file("log", bytes), mapping, stage) {
        Ok(outcome) => outcome,
        Err(error) => refused(&error),
    }
}

fn records(path: &Path, mapping: Option<&str>, stage: &Stage) -> Result<Outcome, TelemetryError> {
    let mapping = mapping.map(|it| match it.lines().count() {
        1 => Mapping::find(Path::new(it)),
        _ => Mapping::parse("mapping.toml", it),
    });
    let options = LogOptions::default().with_mapping(mapping.transpose()?);
    let options = options.with_odometry(Some(Odometry::Visual));
    let mut log = TelemetryLog::open(path, &stage.rover, &options)?;
    while let Some(record) = log.next_record()? {
        // Looking at them takes less than showing them.
        let is_finite = record.time.is_finite() && numbers(&record).flatten().all(f64::is_finite);
        if !is_finite {
            return Ok(crate::finite::finite(&record));
        }
    }
    let _ = std::hint::black_box((log.notes(), log.given(), log.share_used(), log.rows()));
    Ok(Outcome::Read)
}

/// Some seconds of a drive as CSV, Parquet and MCAP.
fn drives() -> Result<[Vec<u8>; 3], Box<dyn Error>> {
    let scenario = Scenario { duration: 1.0, ..paper::traverse()? };
    let run = Run::new(&scenario).and_then(Run::to_end)?;
    let table = |name: &str| {
        let mut writer = TelemetryWriter::begin(Path::new(name), Vec::new(), &scenario.rover)?;
        truth(&run, &scenario).iter().try_for_each(|record| writer.write(record))?;
        writer.finish()
    };
    let mut log = Log::begin(Vec::new(), "a run", &scenario)?;
    log.append(&run.records)?;
    Ok([table("drive.csv")?, table("drive.parquet")?, log.finish()?])
}

/// An MCAP log without check sums: zero stands for none there.
fn without_sums(log: &mut [u8]) {
    const MAGIC: usize = 8;
    /// The kinds of records that have a sum, with the sum's place in each.
    const SUMS: [(u8, usize); 3] = [(0x02, 16), (0x06, 24), (0x0f, 0)];
    let mut at = MAGIC;
    while let Some(head) = log.get(at..at + 9) {
        let kind = head[0];
        let length = head[1..].iter().rev().fold(0_u64, |sum, byte| (sum << 8) | u64::from(*byte));
        let content = at + 9;
        if let Some((_, offset)) = SUMS.iter().find(|(of, _)| *of == kind)
            && let Some(sum) = log.get_mut(content + offset..content + offset + 4)
        {
            sum.fill(0);
        }
        let Some(next) = usize::try_from(length).ok().and_then(|it| content.checked_add(it)) else {
            return;
        };
        at = next;
        if at > log.len() {
            return;
        }
    }
}

/// A state of learning, and the drive that it is of.
fn kept(bytes: &[u8]) -> Outcome {
    let read = KeptDrive::read(&String::from_utf8_lossy(bytes)).and_then(|kept| {
        let scenario = kept.scenario()?;
        kept.drive(&scenario, kept.slope_is_known())
    });
    match read {
        Ok(drive) => {
            let _ = std::hint::black_box((drive.last_time(), drive.lessons().len()));
            Outcome::Read
        }
        Err(error) => refused(&error),
    }
}

/// The state of a drive of a second.
fn state() -> Result<Vec<u8>, Box<dyn Error>> {
    let soil = preset(Kind::Soil, "toyoura-uncertain").ok_or("it comes with the library")?.name;
    let text = format!(
        "schema = \"scenario/1\"\nname = \"a slope\"\nsoil = \"{soil}\"\nslope_deg = 10.0\nmodel = \"ishigami\"\n"
    );
    let scenario = read_scenario(&Source::text("a slope", text), &Overrides::none())?;
    let learner = Learner::new(&scenario, true, LearnSettings::USUAL)?;
    let mut drive = Drive::new(learner);
    let scenario_run = Scenario { duration: 3.0, ..scenario.value.clone() };
    let run = Run::new(&scenario_run).and_then(Run::to_end)?;
    for record in truth(&run, &scenario_run) {
        drive.update(record);
    }
    Ok(state_text(&drive, &scenario, true).into_bytes())
}

/// A state with the check sum of its content.
fn with_sum(state: &mut Vec<u8>) {
    let Ok(Value::Object(mut document)) = serde_json::from_slice(state) else { return };
    document.remove(CHECK_SUM);
    let sum = fnv_1a(Value::Object(document.clone()).to_string().bytes());
    document.insert(CHECK_SUM.to_owned(), format!("{sum:016x}").into());
    *state = Value::Object(document).to_string().into_bytes();
}
