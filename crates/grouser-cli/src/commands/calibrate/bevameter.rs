//! Calibration on plate and shear tests: the moduli of a pressure-sinkage law, cohesion, friction
//! angle and shear modulus.

use std::path::Path;

use grouser::document::calibration::{BevameterFound, BevameterProblem, BevameterTests, Solved};
use grouser::document::checkpoint::fingerprint;
use grouser::document::given_file::GivenFile;
use grouser::document::measurements::Limits;
use grouser::document::measurements::bevameter_sets::rows_of;
use grouser::document::{Document, escape, plates, shear_tests};
use grouser_draw::chart::{Chart, Drawable, Series, Style};
use serde_json::{Value, json};

use super::super::{Answer, add_files};
use super::checkpoint::{Checkpoint, open_folder};
use super::progress::{Progress, sampling};
use super::report;
use crate::args::{CalibrateArgs, PlateLawChoice};
use crate::failure::Failure;
use crate::inputs;
use crate::output;
use crate::output::folder::OutputFolder;
use crate::output::text::Text;
use crate::report::answer::add_next;
use crate::report::page::Page;

pub(super) fn run(args: &CalibrateArgs) -> Result<(), Failure> {
    let folder = open_folder(args)?;
    let (soil, gravity) = inputs::soil(&args.soil, &args.setting)?;
    let files = Files::read(args)?;
    let (tests, given) = files.tests(args.read.limits())?;
    let law = args.plate_law.map(PlateLawChoice::name);
    let problem =
        BevameterProblem::new(&soil.document, law, gravity, &tests).map_err(Failure::Usage)?;
    output::notes(problem.notes());
    let mut settings = settings(args, &files, problem.soil(), gravity);
    let checkpoint = Checkpoint::open(args, settings.to_string())?;
    let progress = Progress::new(checkpoint.as_ref());
    let found = problem
        .solve(&files.names(), sampling(args, checkpoint.as_ref()), &progress)
        .map_err(|error| progress.failure(error))?;
    let solved = &found.solved;
    output::notes(solved.notes());
    add_files(&mut settings, &given);
    let answer = Answer::new("calibrate", settings, found.results());
    let blocks = [vec![report::parameters(&solved.records)], report::conclusions(solved)].concat();
    let text = Text::blocks(blocks) + output::answer::given(&given);
    if let Some(mut folder) = folder {
        folder.add("calibration.json", answer.to_text());
        report::add_soil(&mut folder, problem.family(), solved, &found.soil)?;
        add_page(&mut folder, &problem, &found);
        folder.finish()?;
    }
    if let Some(checkpoint) = checkpoint {
        checkpoint.remove()?;
    }
    report::print(args, text, solved, &answer)
}

/// The files of a bevameter, with what stands in them: of a pipe there is no second time.
struct Files<'a> {
    plates: Option<(&'a Path, Vec<u8>)>,
    shear: Option<(&'a Path, Vec<u8>)>,
}

impl<'a> Files<'a> {
    fn read(args: &'a CalibrateArgs) -> Result<Self, Failure> {
        let limits = args.read.limits();
        let read = |file: &'a Path| Ok::<_, Failure>((file, rows_of(file, limits)?.into_owned()));
        Ok(Self {
            plates: args.plates.as_deref().map(read).transpose()?,
            shear: args.shear.as_deref().map(read).transpose()?,
        })
    }

    /// The tests, and what the files gave.
    fn tests(&self, limits: Limits) -> Result<(BevameterTests, Vec<GivenFile>), Failure> {
        let (mut tests, mut given) = (BevameterTests::default(), Vec::new());
        if let Some((file, bytes)) = &self.plates {
            let read = plates::read_from(&escape::path(file), bytes.as_slice(), limits)?;
            output::notes(&read.notes);
            given.push(read.given);
            tests.plates = read.curves;
        }
        if let Some((file, bytes)) = &self.shear {
            let read = shear_tests::read_from(&escape::path(file), bytes.as_slice(), limits)?;
            output::notes(&read.notes);
            given.push(read.given);
            tests.shear = read.curves;
        }
        Ok((tests, given))
    }

    fn each(&self) -> impl Iterator<Item = &(&'a Path, Vec<u8>)> {
        self.plates.iter().chain(&self.shear)
    }

    /// The names of the files, without their folders.
    fn names(&self) -> String {
        let name = |(file, _): &(&Path, _)| {
            file.file_name().map_or_else(String::new, |it| it.to_string_lossy().into_owned())
        };
        self.each().map(name).collect::<Vec<_>>().join(" and ")
    }
}

fn settings(args: &CalibrateArgs, files: &Files<'_>, soil: &Document, gravity: f64) -> Value {
    let name =
        |file: &Option<(&Path, Vec<u8>)>| file.as_ref().map(|(file, _)| file.display().to_string());
    let bytes: Vec<u8> = files.each().flat_map(|(_, bytes)| bytes.iter().copied()).collect();
    let mut settings = json!({
        "data_fingerprint": fingerprint(&bytes),
        "soil": soil,
        "gravity_m_s2": gravity,
        "seed": args.seed,
        "steps": args.steps,
    });
    for (key, name) in [("plates", name(&files.plates)), ("shear", name(&files.shear))] {
        if let Some(name) = name {
            settings[key] = name.into();
        }
    }
    settings
}

fn add_page(folder: &mut OutputFolder, problem: &BevameterProblem, found: &BevameterFound) {
    let solved = &found.solved;
    let mut page = Page::new("Calibration on plate and shear tests");
    page.heading("Results");
    report::add_parameters(&mut page, solved);
    if !problem.curves().plates.is_empty() {
        let chart = plate_chart(problem, solved).to_svg();
        page.drawing(&chart, "Pressure over sinkage, measured and with the fit.");
        folder.add("figures/plates.svg", chart);
    }
    if !problem.curves().shear.is_empty() {
        let chart = shear_chart(problem, solved).to_svg();
        page.drawing(&chart, "Shear stress over displacement, measured and with the fit.");
        folder.add("figures/shear.svg", chart);
    }
    report::add_posterior(folder, &mut page, solved);
    add_next(&mut page, &report::next()[..2]);
    folder.add("report.html", page.to_html());
}

/// A curve as it is drawn: its label, and for each point place, value and scatter.
struct Drawn {
    label: String,
    points: Vec<(f64, f64, f64)>,
}

fn plate_chart(problem: &BevameterProblem, solved: &Solved) -> Chart {
    let curves = problem.curves().plates.iter().map(|curve| Drawn {
        label: format!("{} mm", (curve.width * 1e6).round() / 1e3),
        points: curve.points.iter().map(|it| (it.sinkage, it.pressure, it.scatter)).collect(),
    });
    let predicted = solved.solution.fit.predictions.iter().copied();
    let series = series(curves, predicted);
    Chart::new("Plate tests", ("sinkage [mm]", "pressure [kPa]"), series)
}

fn shear_chart(problem: &BevameterProblem, solved: &Solved) -> Chart {
    let curves = problem.curves();
    let of_plates: usize = curves.plates.iter().map(|curve| curve.points.len()).sum();
    let drawn = curves.shear.iter().map(|curve| Drawn {
        label: format!("{:.1} kPa", curve.normal_stress * 1e-3),
        points: curve.points.iter().map(|it| (it.at, it.value, it.scatter)).collect(),
    });
    let predicted = solved.solution.fit.predictions.iter().copied().skip(of_plates);
    let series = series(drawn, predicted);
    Chart::new("Shear tests", ("displacement [mm]", "shear stress [kPa]"), series)
}

/// Dots of what was measured and lines of the fit, in millimetres and kilopascals.
fn series(
    curves: impl Iterator<Item = Drawn>,
    mut predicted: impl Iterator<Item = f64>,
) -> Vec<Series> {
    let mut series = Vec::new();
    for (place, Drawn { label, points }) in curves.enumerate() {
        let measured = points.iter().map(|(at, value, _)| (at * 1e3, value * 1e-3));
        let bars = points.iter().map(|(.., scatter)| scatter * 1e-3);
        let dots = Series::new(label.clone(), Style::Dots, place, measured);
        series.push(dots.with_error_bars(bars));
        let fit = points.iter().zip(predicted.by_ref());
        let mut fit: Vec<(f64, f64)> =
            fit.map(|((at, ..), value)| (at * 1e3, value * 1e-3)).collect();
        fit.sort_by(|one, other| one.0.total_cmp(&other.0));
        series.push(Series::new(format!("{label}, fit"), Style::Line, place, fit));
    }
    series
}
