//! `grouser attitude`

use grouser::document::LoadedScenario;
use grouser::document::study::{
    AttitudeBandLimit, AttitudeBandRecord, AttitudeLimit, AttitudeRecord,
};
use grouser::studies::attitude::{AttitudeCurve, AttitudeStudy};
use grouser::vehicle::Rover;
use serde::Serialize;
use serde_json::{Value, json};

use super::Answer;
use super::attitude_band::{self, Bands};
use crate::args::HeadingArgs;
use crate::chart::{Chart, Series, Style};
use crate::failure::Failure;
use crate::inputs;
use crate::output::folder::OutputFolder;
use crate::output::rows::{Rows, rounded_down};
use crate::output::{self, Format};

/// Columns of the table on a terminal.
const COLUMNS: [&str; 7] = [
    "slope_deg",
    "yaw_deg",
    "slip_ratio",
    "sinkage_mm",
    "energy_j_per_m",
    "yaw_moment_nm",
    "status",
];

/// The same, with the draws of an uncertain soil.
const COLUMNS_WITH_BANDS: [&str; 9] = [
    "slope_deg",
    "yaw_deg",
    "yaw_deg_p2_5",
    "yaw_deg_p97_5",
    "slip_ratio",
    "slip_ratio_p97_5",
    "probability_level",
    "draws_level",
    "status",
];

/// * `command`: the name by which it was asked for, which its results and files have
pub(crate) fn run(command: &str, args: &HeadingArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let scenario = inputs::attitude(args)?;
    let curve = AttitudeStudy::of(&scenario.value).curve()?;
    let bands = if args.uncertainty.uncertainty {
        Some(attitude_band::draw(args, &scenario, &curve, folder.is_some())?)
    } else {
        None
    };
    let records = rows(args, &curve, &scenario.value.rover, bands.as_ref());
    let limit = AttitudeLimit::from(&curve);
    let rows = Rows::of(&records);
    let results = Results { limit: &limit, band: bands.as_ref().map(|b| &b.limit), rows: &records };
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
            let columns: &[&str] = if bands.is_some() { &COLUMNS_WITH_BANDS } else { &COLUMNS };
            let band_line = bands.as_ref().map_or(String::new(), Bands::limit_line);
            output::print(&(rows.to_table(columns) + &limit_line(&limit) + &band_line))
        }
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

/// A row for each slope.
fn rows(
    args: &HeadingArgs,
    curve: &AttitudeCurve,
    rover: &Rover,
    bands: Option<&Bands>,
) -> Vec<Row> {
    let slopes = args.slope_deg.0.iter().enumerate();
    let row = |(place, slope): (usize, &f64)| Row {
        attitude: AttitudeRecord::of(curve, rover, slope.to_radians()),
        band: bands.map(|bands| bands.records[place].clone()),
    };
    slopes.map(row).collect()
}

/// What the answer was made from.
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
    limit: &'a AttitudeLimit,
    #[serde(flatten)]
    band: Option<&'a AttitudeBandLimit>,
    rows: &'a [Row],
}

#[derive(Serialize)]
struct Row {
    #[serde(flatten)]
    attitude: AttitudeRecord,
    #[serde(flatten)]
    band: Option<AttitudeBandRecord>,
}

fn limit_line(limit: &AttitudeLimit) -> String {
    match limit.limit_slope_deg {
        Some(slope) => {
            let slope = rounded_down(slope);
            format!("steepest slope with a level attitude: {slope}°, {}\n", limit.limit_reason)
        }
        None => format!("no level attitude on any slope: {}\n", limit.limit_reason),
    }
}

/// Yaw over slope.
fn chart(curve: &AttitudeCurve) -> Chart {
    Chart {
        title: "Yaw that keeps a traverse level".into(),
        x_label: "slope [°]".into(),
        y_label: "yaw, positive uphill [°]".into(),
        series: vec![line("attitude", curve)],
    }
}

fn line(name: &str, curve: &AttitudeCurve) -> Series {
    let attitudes = curve.attitudes();
    let points = attitudes.iter().map(|point| (point.slope.to_degrees(), point.yaw.to_degrees()));
    Series::new(name, Style::Line, 1, points)
}
