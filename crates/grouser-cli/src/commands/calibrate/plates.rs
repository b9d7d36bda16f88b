//! Calibration on plate tests: the moduli of a pressure-sinkage law.

use std::path::Path;

use grouser::document::calibration::{PlateProblem, Solved};
use grouser::document::checkpoint::fingerprint;
use grouser::document::plates::{self, PlateMeasurements};
use grouser::document::{Document, escape, measurements};
use grouser::studies::calibration::PlateCurve;
use serde_json::{Value, json};

use super::super::Answer;
use super::checkpoint::{Checkpoint, open_folder};
use super::progress::{Progress, sampling};
use super::report;
use crate::args::{CalibrateArgs, PlateLawChoice};
use crate::chart::{Chart, Series, Style};
use crate::failure::Failure;
use crate::inputs;
use crate::output;
use crate::output::text::Text;
use crate::report::page::Page;

pub(super) fn run(args: &CalibrateArgs, file: &Path) -> Result<(), Failure> {
    let folder = open_folder(args)?;
    let (soil, gravity) = inputs::soil(&args.soil, &args.setting)?;
    let limits = args.read.limits();
    // Read once: of a pipe there is no second time.
    let bytes = measurements::read_bytes(file, limits)?;
    let measured = plates::read_from(&escape::path(file), bytes.as_slice(), limits)?;
    let PlateMeasurements { curves, notes } = measured;
    for note in &notes {
        output::message(&format!("note: {note}"));
    }
    let law = args.plate_law.map(PlateLawChoice::name);
    let problem =
        PlateProblem::new(&soil.document, law, gravity, curves).map_err(Failure::Usage)?;
    let settings = settings(args, file, &bytes, problem.soil(), gravity);
    let checkpoint = Checkpoint::open(args, settings.to_string())?;
    let name = file.file_name().map_or_else(String::new, |it| it.to_string_lossy().into());
    let progress = Progress::new(checkpoint.as_ref());
    let found = problem
        .solve(&name, sampling(args, checkpoint.as_ref()), &progress)
        .map_err(|error| progress.failure(error))?;
    let solved = &found.solved;
    report::tell(&solved.notes());
    let answer = Answer::new("calibrate", settings, found.results());
    let blocks = [vec![report::parameters(&solved.records)], report::conclusions(solved)].concat();
    let text = Text::blocks(blocks);
    if let Some(mut folder) = folder {
        folder.add("calibration.json", answer.to_text());
        report::add_soil(&mut folder, problem.family(), solved, &found.soil)?;
        let mut page = Page::new("Calibration on plate tests");
        page.heading("Results");
        report::add_parameters(&mut page, solved);
        let chart = chart(problem.curves(), solved).to_svg();
        page.drawing(&chart, "Pressure over sinkage, measured and with the fit.");
        folder.add("figures/plates.svg", chart);
        report::add_posterior(&mut folder, &mut page, solved);
        folder.add("report.html", page.to_html());
        folder.finish()?;
    }
    if let Some(checkpoint) = checkpoint {
        checkpoint.remove()?;
    }
    report::print(args, text, solved, &answer)
}

fn settings(
    args: &CalibrateArgs,
    file: &Path,
    bytes: &[u8],
    soil: &Document,
    gravity: f64,
) -> Value {
    json!({
        "plates": file.display().to_string(),
        "data_fingerprint": fingerprint(bytes),
        "soil": soil,
        "gravity_m_s2": gravity,
        "seed": args.seed,
        "steps": args.steps,
    })
}

fn chart(curves: &[PlateCurve], solved: &Solved) -> Chart {
    let mut series = Vec::new();
    let mut predicted = solved.solution.fit.predictions.iter();
    for (place, curve) in curves.iter().enumerate() {
        let width = (curve.width * 1e6).round() / 1e3;
        let measured = curve.points.iter().map(|it| (it.sinkage * 1e3, it.pressure * 1e-3));
        let bars = curve.points.iter().map(|it| it.scatter * 1e-3);
        let dots = Series::new(format!("{width} mm"), Style::Dots, place, measured);
        series.push(dots.with_error_bars(bars));
        let mut fit: Vec<(f64, f64)> = curve
            .points
            .iter()
            .zip(predicted.by_ref())
            .map(|(point, pressure)| (point.sinkage * 1e3, pressure * 1e-3))
            .collect();
        fit.sort_by(|one, other| one.0.total_cmp(&other.0));
        series.push(Series::new(format!("{width} mm, fit"), Style::Line, place, fit));
    }
    Chart::new("Plate tests", ("sinkage [mm]", "pressure [kPa]"), series)
}
