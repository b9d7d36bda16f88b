//! `grouser wheel-test`

use grouser::document::study::WheelTestRecord;
use grouser::studies::wheel_test::WheelTest;
use serde::Serialize;
use serde_json::json;

use super::Answer;
use crate::args::WheelTestArgs;
use crate::chart::{Chart, Series, Style};
use crate::failure::Failure;
use crate::inputs;
use crate::output::folder::OutputFolder;
use crate::output::rows::Rows;
use crate::output::{self, Format};

/// Columns of the table on a terminal.
const COLUMNS: [&str; 9] = [
    "load_n",
    "slip_angle_deg",
    "slip_ratio",
    "sinkage_mm",
    "drawbar_pull_n",
    "side_force_n",
    "torque_nm",
    "entry_angle_deg",
    "status",
];

pub(crate) fn run(args: &WheelTestArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let inputs = inputs::wheel_test(args)?;
    let test = WheelTest {
        wheel: inputs.wheel.value,
        soil: inputs.soil.value,
        gravity: inputs.gravity,
        theory: inputs.theory,
        loads: args.load_n.0.clone(),
        slip_angles: args.slip_angle_deg.0.iter().map(|angle| angle.to_radians()).collect(),
        slip_ratios: args.slip_ratio.0.clone(),
    };
    let records: Vec<WheelTestRecord> = test.run().iter().map(WheelTestRecord::from).collect();
    let rows = Rows::of(&records);
    let settings = json!({
        "soil": inputs.soil.document,
        "wheel": inputs.wheel.document,
        "gravity_m_s2": inputs.gravity,
        "model": inputs.theory.name(),
        "load_n": args.load_n.0,
        "slip_angle_deg": args.slip_angle_deg.0,
        "slip_ratio": args.slip_ratio.0,
    });
    let answer = Answer::new("wheel-test", settings, Results { rows: &records });
    if let Some(mut folder) = folder {
        folder.add("wheel-test.json", answer.to_text());
        folder.add("wheel-test.csv", rows.to_csv()?);
        folder.add("wheel-test.svg", chart(&records).to_svg());
        folder.add_document("soil.toml", &inputs.soil);
        folder.add_document("wheel.toml", &inputs.wheel);
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::print(&rows.to_table(&COLUMNS)),
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

#[derive(Serialize)]
struct Results<'a> {
    rows: &'a [WheelTestRecord],
}

/// Drawbar pull over slip ratio, a curve for each load and slip angle.
fn chart(records: &[WheelTestRecord]) -> Chart {
    let mut series: Vec<Series> = Vec::new();
    for record in records {
        let name = format!("{} N, {}°", record.load_n, record.slip_angle_deg);
        if series.last().is_none_or(|last| last.name != name) {
            series.push(Series::new(name, Style::Line, series.len(), []));
        }
        if let (Some(last), Some(pull)) = (series.last_mut(), record.wheel.drawbar_pull_n) {
            last.points.push((record.slip_ratio, pull));
        }
    }
    Chart {
        title: "Drawbar pull".into(),
        x_label: "slip ratio".into(),
        y_label: "drawbar pull [N]".into(),
        series,
    }
}
