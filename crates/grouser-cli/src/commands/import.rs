//! `grouser import`: converts another laboratory's CSV file.

use grouser::document::measurements::bevameter_columns::{
    PLATE_DIAMETER, PLATE_RADIUS, PLATE_WIDTH, PRESSURE, SHEAR_DISPLACEMENT, SHEAR_STRESS,
};
use grouser::document::measurements::{
    self, Choice, Imported, Layout, Limits, MeasurementError, MeasurementProblem, SlipDefinition,
    import,
};
use grouser::document::{escape, plates, shear_tests};
use grouser::studies::measurement::Quantity;

use crate::args::{ImportArgs, SlipChoice};
use crate::failure::Failure;
use crate::output::{self, file};

pub(crate) fn run(args: &ImportArgs) -> Result<(), Failure> {
    if let Some(out) = &args.out {
        file::check_new(out, args.force)?;
    }
    let layout = Layout {
        delimiter: delimiter(&args.delimiter)?,
        decimal_comma: args.decimal_comma,
        skipped_lines: args.skip_lines,
        slip: match args.slip_definition {
            SlipChoice::Larger => SlipDefinition::Larger,
            SlipChoice::Rim => SlipDefinition::Rim,
            SlipChoice::Hub => SlipDefinition::Hub,
        },
        limits: args.read.limits(),
    };
    let label = escape::path(&args.file);
    let bytes = measurements::read_bytes(&args.file, layout.limits)?;
    let Imported { text, left_out } = import(&label, bytes.as_slice(), &args.columns, &layout)?;
    if !left_out.is_empty() {
        output::message(&format!("note: columns not taken: {}", left_out.join(", ")));
    }
    check(&label, &text, layout.limits)?;
    match &args.out {
        Some(out) => file::write_result(out, text.as_bytes()),
        None => output::print(&text),
    }
}

/// Checks that the new file can be read, and prints what is in it.
fn check(label: &str, text: &str, limits: Limits) -> Result<(), Failure> {
    let label = format!("{label} as imported");
    // Numbers that are converted may have more digits, and so more bytes.
    let limits = Limits { rows: limits.rows.saturating_mul(4) };
    let header = text.lines().next().unwrap_or_default();
    let has = |name: &str| header.split(',').any(|column| column == name);
    if [PLATE_WIDTH, PLATE_DIAMETER, PLATE_RADIUS, PRESSURE].into_iter().any(has) {
        return check_plates(&label, text, limits);
    }
    if has(SHEAR_STRESS) || has(SHEAR_DISPLACEMENT) {
        return check_shear(&label, text, limits);
    }
    let choice = Choice { limits, ..Choice::default() };
    // Rows of several wheels are no fault here.
    let measured = match measurements::read_from(&label, text.as_bytes(), &choice) {
        Ok(measured) => measured,
        Err(error) if error.is_of_several_wheels() => return Ok(()),
        Err(error) => return Err(of_import(&label, error)),
    };
    for note in &measured.notes {
        output::message(&format!("note: {note}"));
    }
    let tests = &measured.tests;
    let counts = Quantity::ALL.map(|quantity| {
        let read = tests.trials.iter().filter(|trial| trial.readings[quantity].is_some());
        (column_name(quantity), read.count())
    });
    let counts: Vec<String> =
        counts.iter().map(|(word, count)| format!("{word} {count}")).collect();
    let (trials, cells) = (tests.trials.len(), tests.cells.len());
    output::message(&format!("{trials} trials in {cells} cells; readings: {}", counts.join(", ")));
    Ok(())
}

/// Reads plate tests as a calibration does, and tells what it finds.
fn check_plates(label: &str, text: &str, limits: Limits) -> Result<(), Failure> {
    let read = plates::read_from(label, text.as_bytes(), limits);
    let plates::PlateMeasurements { curves, notes, .. } =
        read.map_err(|error| of_import(label, error))?;
    let rows: usize = curves.iter().map(|curve| curve.points.len()).sum();
    tell_curves(&notes, rows, curves.len(), "plates");
    Ok(())
}

/// Reads shear tests as a calibration does, and tells what it finds.
fn check_shear(label: &str, text: &str, limits: Limits) -> Result<(), Failure> {
    let read = shear_tests::read_from(label, text.as_bytes(), limits);
    let shear_tests::ShearMeasurements { curves, notes, .. } =
        read.map_err(|error| of_import(label, error))?;
    let rows: usize = curves.iter().map(|curve| curve.points.len()).sum();
    tell_curves(&notes, rows, curves.len(), "shear tests");
    Ok(())
}

fn tell_curves(notes: &[String], rows: usize, curves: usize, what: &str) {
    for note in notes {
        output::message(&format!("note: {note}"));
    }
    output::message(&format!("{rows} rows in {curves} curves of {what}"));
}

/// What is missing was not mapped: the hint to import the file would lead in a circle.
fn of_import(label: &str, error: MeasurementError) -> Failure {
    match error.problem() {
        problem @ MeasurementProblem::MissingColumn { .. } => Failure::Usage(format!(
            "{label}: {problem}\nhint: say which column of theirs it is: --column OURS=THEIRS"
        )),
        _ => error.into(),
    }
}

fn column_name(quantity: Quantity) -> &'static str {
    grouser::document::columns::fit::column_of(quantity).name
}

fn delimiter(text: &str) -> Result<u8, Failure> {
    match (text, text.as_bytes()) {
        ("tab", _) => Ok(b'\t'),
        (_, [byte]) => Ok(*byte),
        _ => Err(Failure::Usage(format!(
            "--delimiter {text}: it must be one character, such as ';', or tab"
        ))),
    }
}
