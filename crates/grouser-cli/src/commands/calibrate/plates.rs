//! Calibration on plate tests: the moduli of a pressure-sinkage law.

use std::path::Path;

use grouser::document::checkpoint::fingerprint;
use grouser::document::plates::PlateMeasurements;
use grouser::document::{FitKey, SAMPLES_FILE, SoilDocument, SoilFamily, plates};
use grouser::studies::calibration::{
    Calibration, FitSettings, ParameterSpace, PlateCurve, PlateLaw, PlateTest,
};
use serde::Serialize;
use serde_json::{Value, json};

use super::super::Answer;
use super::checkpoint::{Checkpoint, open_folder};
use super::report;
use super::solve::{self, Solved};
use crate::args::{CalibrateArgs, PlateLawWord};
use crate::chart::{Chart, Series, Style};
use crate::failure::Failure;
use crate::inputs;
use crate::output;
use crate::report::page::Page;

/// The sum of the law's two terms is all that one width shows, and no sampler need find that out.
const ONE_WIDTH: &str = "soil.pressure_sinkage.k_c and soil.pressure_sinkage.k_phi are not told \
                         apart by plates of one width: test a second one";

#[derive(Serialize)]
struct Results<'a> {
    rows: &'a [grouser::document::calibration::ParameterRecord],
    discrepancies: &'a [solve::DiscrepancyRecord],
    cannot_tell_apart: &'a [String],
    sampler: &'a Option<solve::SamplerRecord>,
}

pub(super) fn run(args: &CalibrateArgs, file: &Path) -> Result<(), Failure> {
    let folder = open_folder(args)?;
    let (soil, gravity) = inputs::soil(&args.soil, &args.setting)?;
    let PlateMeasurements { curves, notes } = plates::read(file)?;
    for note in &notes {
        output::tell(&format!("note: {note}"));
    }
    let (document, law) = with_law(args, &soil.document, gravity);
    let keys: Vec<FitKey> = PlateLaw::PARAMETERS
        .iter()
        .map(|name| FitKey { path: format!("pressure_sinkage.{name}"), bounds: None })
        .collect();
    let family =
        SoilFamily::around(&document, &keys, &first_guess(law, &curves)).map_err(Failure::Usage)?;
    let test = PlateTest::new(law, curves.clone())?;
    let calibration = Calibration::new(&test, ParameterSpace::new(family.parameters().to_vec())?)?;
    let settings = settings(args, file, &document, gravity)?;
    let checkpoint = Checkpoint::open(args, settings.to_string())?;
    let fit = solve::fit(&calibration, &FitSettings::default())?;
    let mut solved =
        solve::solve(args, &calibration, fit, family.parameters(), checkpoint.as_ref())?;
    if test.widths() < 2 {
        solved.questions.insert(0, ONE_WIDTH.to_owned());
    }
    let results = Results {
        rows: &solved.records,
        discrepancies: &solved.discrepancies,
        cannot_tell_apart: &solved.questions,
        sampler: &solved.sampler,
    };
    let answer = Answer::new("calibrate", settings, results);
    let blocks = [vec![report::parameters(&solved.records)], report::said(&solved)].concat();
    let text = blocks.join("\n");
    if let Some(mut folder) = folder {
        let name = file.file_name().map_or_else(String::new, |it| it.to_string_lossy().into());
        let points: usize = curves.iter().map(|curve| curve.points.len()).sum();
        let source = format!(
            "pressure_sinkage fitted by Grouser {} to {name} ({points} points of {} plates)",
            env!("CARGO_PKG_VERSION"),
            curves.len()
        );
        let samples = solved.samples.as_ref().map(|_| SAMPLES_FILE);
        let theory = document.theory().unwrap_or_default();
        let fitted = family.fitted(&solved.fit.values, &source, theory, samples);
        folder.add("calibration.json", answer.to_text());
        report::add_soil(&mut folder, &family, &solved, &fitted)?;
        let mut page = Page::new("Calibration on plate tests");
        page.heading("What was found");
        report::add_parameters(&mut page, &solved);
        let chart = chart(&curves, &solved).to_svg();
        page.drawing(&chart, "Pressure over sinkage, measured and with the fit.");
        folder.add("figures/plates.svg", chart);
        report::add_posterior(&mut folder, &mut page, &solved);
        folder.add("report.html", page.to_html());
        folder.finish()?;
    }
    if let Some(checkpoint) = checkpoint {
        checkpoint.remove()?;
    }
    report::print(args, &text, &solved, &answer)
}

/// The soil with the law that is asked for, and that law.
fn with_law(args: &CalibrateArgs, soil: &SoilDocument, gravity: f64) -> (SoilDocument, PlateLaw) {
    let document = match args.plate_law {
        None => soil.clone(),
        Some(PlateLawWord::Bekker) => soil.with_law("bekker"),
        Some(PlateLawWord::Reece) => soil.with_law("reece"),
    };
    let law = if document.follows_reece() {
        PlateLaw::Reece {
            cohesion: document.cohesion_kpa * 1e3,
            unit_weight: document.density_kg_m3 * gravity,
        }
    } else {
        PlateLaw::Bekker
    };
    (document, law)
}

/// k_c, k_phi and n near the curves: the slope of log pressure over log sinkage of the widest
/// plate, with no cohesive part.
fn first_guess(law: PlateLaw, curves: &[PlateCurve]) -> [f64; 3] {
    let widest = curves.iter().max_by(|one, other| one.width.total_cmp(&other.width));
    let points = widest.map_or(&[][..], |curve| curve.points.as_slice());
    let positive = points.iter().filter(|point| point.sinkage > 0.0 && point.pressure > 0.0);
    let logs: Vec<(f64, f64)> =
        positive.map(|point| (point.sinkage.ln(), point.pressure.ln())).collect();
    let count = logs.len().max(1) as f64;
    let (x, y) = logs.iter().fold((0.0, 0.0), |sum, log| (sum.0 + log.0, sum.1 + log.1));
    let (x, y) = (x / count, y / count);
    let (above, below) = logs.iter().fold((0.0, 0.0), |sum, log| {
        (sum.0 + (log.0 - x) * (log.1 - y), sum.1 + (log.0 - x).powi(2))
    });
    let slope = if below > 0.0 { above / below } else { 1.0 };
    let n = slope.clamp(0.4, 2.5);
    let width = widest.map_or(1.0, |curve| curve.width);
    let stiffness = (y - n * x).exp();
    match law {
        PlateLaw::Bekker => [0.1 * stiffness * width, stiffness, n],
        PlateLaw::Reece { unit_weight, .. } => {
            [1.0, stiffness * width.powf(n) / (unit_weight * width), n]
        }
    }
}

fn settings(
    args: &CalibrateArgs,
    file: &Path,
    soil: &SoilDocument,
    gravity: f64,
) -> Result<Value, Failure> {
    let bytes = std::fs::read(file).map_err(Failure::at("cannot read", file))?;
    Ok(json!({
        "plates": file.display().to_string(),
        "data_fingerprint": fingerprint(&bytes),
        "soil": soil,
        "gravity_m_s2": gravity,
        "seed": args.seed,
        "steps": args.steps,
    }))
}

fn chart(curves: &[PlateCurve], solved: &Solved) -> Chart {
    let mut series = Vec::new();
    let mut predicted = solved.fit.predictions.iter();
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
    Chart {
        title: "Plate tests".into(),
        x_label: "sinkage [mm]".into(),
        y_label: "pressure [kPa]".into(),
        series,
    }
}
