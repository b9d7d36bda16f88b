//! `grouser attitude`

use grouser::document::study::{AttitudeLimit, AttitudeRecord};
use grouser::studies::attitude::{AttitudeCurve, AttitudeStudy};
use serde::Serialize;
use serde_json::json;

use super::Answer;
use crate::args::AttitudeArgs;
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

pub(crate) fn run(args: &AttitudeArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let scenario = inputs::attitude(args)?;
    let curve = AttitudeStudy::of(&scenario.value).curve()?;
    let rover = &scenario.value.rover;
    let records: Vec<AttitudeRecord> = args
        .slope_deg
        .0
        .iter()
        .map(|slope| AttitudeRecord::of(&curve, rover, slope.to_radians()))
        .collect();
    let limit = AttitudeLimit::from(&curve);
    let rows = Rows::of(&records);
    let document = &scenario.document;
    let inputs = json!({
        "rover": document.rover,
        "soil": document.soil,
        "gravity_m_s2": document.gravity_m_s2,
        "model": scenario.value.theory.name(),
        "loads": document.loads,
        "moments": document.moments,
        "slope_deg": args.slope_deg.0,
    });
    let answer = Answer::new("attitude", inputs, Results { limit: &limit, rows: &records });
    if let Some(mut folder) = folder {
        folder.add("attitude.json", answer.to_text());
        folder.add("attitude.csv", rows.to_csv()?);
        folder.add("attitude.svg", chart(&curve).to_svg());
        folder.add("scenario.toml", scenario.to_toml());
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::print(&(rows.to_table(&COLUMNS) + &limit_line(&limit))),
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

#[derive(Serialize)]
struct Results<'a> {
    #[serde(flatten)]
    limit: &'a AttitudeLimit,
    rows: &'a [AttitudeRecord],
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
    let attitudes = curve.attitudes();
    let points = attitudes.iter().map(|point| (point.slope.to_degrees(), point.yaw.to_degrees()));
    Chart {
        title: "Yaw that keeps a traverse level".into(),
        x_label: "slope [°]".into(),
        y_label: "yaw, positive uphill [°]".into(),
        series: vec![Series::new("attitude", Style::Line, 1, points)],
    }
}
