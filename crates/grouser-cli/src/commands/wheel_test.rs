//! `grouser wheel-test`

use grouser::document::simulated_test::SimulatedTrialRecord;
use grouser::document::study::WheelTestRecord;
use grouser::studies::measurement::PerQuantity;
use grouser::studies::simulated_test::SimulatedTest;
use grouser::studies::wheel_test::WheelTest;
use serde::Serialize;
use serde_json::{Value, json};

use super::Answer;
use crate::args::{StandArgs, WheelTestArgs};
use crate::chart::{Chart, Series, Style};
use crate::failure::Failure;
use crate::inputs::{self, StandInputs};
use crate::output::folder::OutputFolder;
use crate::output::rows::Rows;
use crate::output::{self, Format};

/// Columns of the table on a terminal.
const COLUMNS_OF_STAND: [&str; 9] = [
    "load_n",
    "slip_angle_deg",
    "slip_ratio",
    "trial",
    "sinkage_mm",
    "drawbar_pull_n",
    "side_force_n",
    "torque_nm",
    "status",
];

/// The same, for what the theory itself says.
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
    let mut settings = json!({
        "soil": inputs.soil.document,
        "wheel": inputs.wheel.document,
        "gravity_m_s2": inputs.gravity,
        "model": inputs.theory.name(),
        "load_n": args.load_n.0,
        "slip_angle_deg": args.slip_angle_deg.0,
        "slip_ratio": args.slip_ratio.0,
    });
    match args.stand.trials {
        None => {
            let records: Vec<_> = test.run().iter().map(WheelTestRecord::from).collect();
            let pulls = records
                .iter()
                .map(|it| (it.load_n, it.slip_angle_deg, it.slip_ratio, it.wheel.drawbar_pull_n));
            let chart = chart(pulls, Style::Line);
            tell(args, folder, &inputs, settings, &records, &COLUMNS, &chart)
        }
        Some(trials) => {
            settings["simulated_stand"] = json!({
                "trials": trials,
                "noise_n": args.stand.noise_n,
                "noise_mm": args.stand.noise_mm,
                "noise_nm": args.stand.noise_nm,
                "seed": args.stand.seed,
            });
            let records: Vec<_> = on_a_stand(test, &args.stand, trials)
                .run()
                .iter()
                .map(SimulatedTrialRecord::from)
                .collect();
            let pulls = records
                .iter()
                .map(|it| (it.load_n, it.slip_angle_deg, it.slip_ratio, it.drawbar_pull_n));
            let chart = chart(pulls, Style::Dots);
            tell(args, folder, &inputs, settings, &records, &COLUMNS_OF_STAND, &chart)
        }
    }
}

fn on_a_stand(plan: WheelTest, args: &StandArgs, trials: usize) -> SimulatedTest {
    let noise = PerQuantity {
        drawbar_pull: args.noise_n,
        side_force: args.noise_n,
        sinkage: args.noise_mm * 1e-3,
        torque: args.noise_nm,
    };
    SimulatedTest { plan, trials, noise, seed: args.seed }
}

#[derive(Serialize)]
struct Results<'a, T> {
    rows: &'a [T],
}

fn tell<T: Serialize>(
    args: &WheelTestArgs,
    folder: Option<OutputFolder>,
    inputs: &StandInputs,
    settings: Value,
    records: &[T],
    columns: &[&str],
    chart: &Chart,
) -> Result<(), Failure> {
    let rows = Rows::of(records);
    let answer = Answer::new("wheel-test", settings, Results { rows: records });
    if let Some(mut folder) = folder {
        folder.add("wheel-test.json", answer.to_text());
        folder.add("wheel-test.csv", rows.to_csv()?);
        folder.add("wheel-test.svg", chart.to_svg());
        folder.add_document("soil.toml", &inputs.soil);
        folder.add_document("wheel.toml", &inputs.wheel);
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::print(&rows.to_table(columns)),
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

/// Drawbar pull over slip ratio, a series for each load and slip angle.
///
/// * `pulls`: load, slip angle, slip ratio, drawbar pull, as they are printed
fn chart(pulls: impl Iterator<Item = (f64, f64, f64, Option<f64>)>, style: Style) -> Chart {
    let mut series: Vec<Series> = Vec::new();
    for (load, angle, slip_ratio, pull) in pulls {
        let name = format!("{load} N, {angle}°");
        if series.last().is_none_or(|last| last.name != name) {
            series.push(Series::new(name, style, series.len(), []));
        }
        if let (Some(last), Some(pull)) = (series.last_mut(), pull) {
            last.points.push((slip_ratio, pull));
        }
    }
    Chart {
        title: "Drawbar pull".into(),
        x_label: "slip ratio".into(),
        y_label: "drawbar pull [N]".into(),
        series,
    }
}
