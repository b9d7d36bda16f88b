//! `grouser heading`: the heading offset that holds the contour on a slope.

use grouser::document::LoadedScenario;
use grouser::document::columns::heading::{self, LIMIT_REASON};
use grouser::document::columns::{LIMIT_SLOPE, SLOPE, YAW};
use grouser::document::table::{Row, Table};
use grouser::studies::heading::{HeadingCurve, HeadingStudy};
use serde::Serialize;
use serde_json::{Value, json};

use super::heading_band::{self, Bands};
use super::{Answer, strict};
use crate::args::HeadingArgs;
use crate::chart::{Chart, Series, Style};
use crate::failure::Failure;
use crate::inputs;
use crate::output::folder::OutputFolder;
use crate::output::rows::{Rows, rounded_down};
use crate::output::{self, Format};

/// * `command`: the name by which it was asked for, which its results and files have
pub(crate) fn run(command: &str, args: &HeadingArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let scenario = inputs::heading(args)?;
    let curve = HeadingStudy::of(&scenario.value).curve()?;
    let bands = if args.uncertainty.uncertainty {
        Some(heading_band::bands(args, &scenario, &curve, folder.is_some())?)
    } else {
        None
    };
    let slopes: Vec<f64> = args.slope_deg.0.iter().map(|slope| SLOPE.unit.to_si(*slope)).collect();
    let mut table = heading::table(&curve, &scenario.value.rover, &slopes);
    if args.strict.strict {
        let flags = heading::findings(&curve, &slopes);
        strict::check(&args.strict, flags.iter().map(|it| &**it), &table, &[SLOPE.name])?;
    }
    if let Some(bands) = &bands {
        table = heading::with_bands(table, &bands.asked);
    }
    let limit = heading::steepest(&curve);
    let rows = Rows::of_table(&table);
    let band = bands.as_ref().map(|bands| bands.limit.row(0));
    let results = Results { limit: limit.row(0), band, rows: &table };
    let answer = Answer::new(command, settings(args, &scenario), results);
    if let Some(mut folder) = folder {
        folder.add(format!("{command}.json"), answer.to_text());
        folder.add(format!("{command}.csv"), rows.to_csv()?);
        match &bands {
            None => folder.add(format!("{command}.svg"), chart(&curve).to_svg()),
            Some(bands) => {
                folder.add(
                    format!("{command}.svg"),
                    bands.chart(line("soil as written", &curve)).to_svg(),
                );
                folder.add("probability.svg", bands.chance_chart().to_svg());
            }
        }
        folder.add_document("scenario.toml", &scenario);
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => {
            let brief = if bands.is_some() { heading::bands_brief() } else { heading::brief() };
            let band_line = bands.as_ref().map_or(String::new(), Bands::limit_line);
            output::print(&(rows.to_table(&brief) + &limit_line(&limit) + &band_line))
        }
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

/// The inputs of the answer.
fn settings(args: &HeadingArgs, scenario: &LoadedScenario) -> Value {
    let document = &scenario.document;
    let mut settings = json!({
        "rover": document.get("rover"),
        "soil": document.get("soil"),
        "gravity_m_s2": document.get("gravity_m_s2"),
        "model": scenario.value.theory.name(),
        "loads": document.get("loads"),
        "moments": document.get("moments"),
        "slope_deg": args.slope_deg.0,
    });
    if args.uncertainty.uncertainty {
        settings["samples"] = args.uncertainty.samples.into();
        settings["seed"] = args.uncertainty.seed.into();
    }
    settings
}

#[derive(Serialize)]
struct Results<'a> {
    #[serde(flatten)]
    limit: Row<'a>,
    #[serde(flatten)]
    band: Option<Row<'a>>,
    rows: &'a Table,
}

fn limit_line(limit: &Table) -> String {
    let slope = limit.numbers(LIMIT_SLOPE.name)[0];
    let reason = limit.texts(LIMIT_REASON)[0].as_deref().unwrap_or_default();
    match slope {
        Some(slope) => {
            let slope = rounded_down(slope);
            format!("steepest slope on which a heading holds the contour: {slope}°, {reason}\n")
        }
        None => format!("no heading holds the contour on any slope: {reason}\n"),
    }
}

/// Yaw over slope.
fn chart(curve: &HeadingCurve) -> Chart {
    Chart {
        title: "Heading offset that holds the contour".into(),
        x_label: "slope [°]".into(),
        y_label: "yaw, positive uphill [°]".into(),
        series: vec![line("heading offset", curve)],
    }
}

fn line(name: &str, curve: &HeadingCurve) -> Series {
    let points = heading::curve(curve);
    Series::new(name, Style::Line, 1, points.points(SLOPE.name, YAW.name))
}
