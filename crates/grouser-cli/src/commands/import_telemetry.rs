//! `grouser import-telemetry`: a log of any kind as a table of telemetry.

mod dialogue;

use std::io::{BufReader, IsTerminal as _, Write, stderr, stdin};
use std::path::Path;

use grouser::document::measurements::telemetry::numbers;
use grouser::document::reading::counted;
use grouser::document::{self, Kind, escape};
use grouser::vehicle::Rover;
use grouser_logs::{Problem, TelemetryLog, TelemetryWriter};

use crate::args::ImportTelemetryArgs;
use crate::failure::Failure;
use crate::inputs;
use crate::output::{self, activity, file};

pub(crate) fn run(args: &ImportTelemetryArgs) -> Result<(), Failure> {
    if let Some(name) = &args.print_mapping {
        return print_mapping(name);
    }
    if let Some(out) = &args.out {
        file::check_new(out, args.force)?;
    }
    let rover = inputs::driven_rover(args.rover.as_deref())?;
    let mut log = opened(args, &rover)?;
    match &args.out {
        Some(out) => file::write_by(out, |writer| {
            let failed = |error| Failure::at("cannot write", out)(error);
            convert(&mut log, (out, writer), &rover, failed)
        })
        .inspect(|()| {
            file::say_written(out);
            let out = escape::path(out);
            output::message(&format!(
                "next: grouser replay {out} --rover ROVER --soil SOIL --out REPLAYED, then grouser \
                 learn {out} --rover ROVER --soil SOIL --out LEARNT"
            ));
        }),
        None => output::print_by(|writer| {
            convert(&mut log, (Path::new("-"), writer), &rover, output::failed_to_print)
        }),
    }?;
    inputs::check_share_used(log.label(), log.share_used(), &args.telemetry.log)
}

fn print_mapping(name: &str) -> Result<(), Failure> {
    let kind = Kind::TelemetryMapping;
    let mapping = document::preset(kind, name).ok_or_else(|| {
        let names: Vec<_> = document::presets(kind).map(|preset| preset.name).collect();
        let (name, names) = (escape::line(name), names.join(", "));
        Failure::Usage(format!(
            "--print-mapping {name}: there is no such mapping\nhint: it is one of {names}"
        ))
    })?;
    output::print(mapping.text)
}

/// The log, after questions on what is ambiguous in it, where somebody can answer.
fn opened(args: &ImportTelemetryArgs, rover: &Rover) -> Result<TelemetryLog, Failure> {
    if !stdin().is_terminal() {
        return inputs::telemetry(&args.logs, &args.telemetry, rover, None);
    }
    let mut options =
        inputs::log_options(&args.telemetry.log)?.with_odometry(args.telemetry.odometry());
    loop {
        let error = match TelemetryLog::open_all(&args.logs, rover, &options) {
            Ok(log) => return Ok(log),
            Err(error) => error,
        };
        let (what, topics) = match error.problem() {
            // A choice that was made already and is asked for again is not one of the topics.
            Problem::Ambiguous { what, topics } if !options.topics.contains_key(what) => {
                (what, topics)
            }
            _ => return Err(error.into()),
        };
        activity::end();
        let topic = dialogue::ask(what, topics, &mut BufReader::new(stdin()), &mut stderr())?;
        options.topics.insert(what.clone(), topic);
    }
}

/// Writes all records, and says what was noticed.
fn convert(
    log: &mut TelemetryLog,
    (name, out): (&Path, &mut dyn Write),
    rover: &Rover,
    failed: impl Fn(std::io::Error) -> Failure,
) -> Result<(), Failure> {
    let mut writer = TelemetryWriter::begin(name, out, rover).map_err(&failed)?;
    let (mut records, mut has_readings): (u64, bool) = (0, false);
    while let Some(record) = log.next_record()? {
        writer.write(&record).map_err(&failed)?;
        records += 1;
        has_readings |= numbers(&record).flatten().nth(1).is_some();
    }
    if !has_readings {
        let notes = log.notes().join("\nnote: ");
        let what =
            if records == 0 { "no rows of telemetry" } else { "times, and no other reading" };
        return Err(Failure::Usage(format!("{}: has {what}\nnote: {notes}", log.label())));
    }
    writer.finish().map_err(&failed)?;
    output::notes(log.notes().iter().map(|note| escape::line(note)));
    let records = counted(records, "record", "records");
    output::message(&format!("{records} of telemetry"));
    Ok(())
}
