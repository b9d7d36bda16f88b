//! `grouser wheel-test`: forces and sinkage of one wheel on a test stand.

use grouser::document::columns::{self, DRAWBAR_PULL, LOAD, SINKAGE, SLIP_ANGLE, SLIP_RATIO};
use grouser::document::table::Table;
use grouser::studies::measurement::PerQuantity;
use grouser::studies::simulated_test::SimulatedTest;
use grouser::studies::wheel_test::WheelTest;
use serde::Serialize;
use serde_json::{Value, json};

use super::{Answer, strict};
use crate::args::{StandArgs, WheelTestArgs};
use crate::chart::{Chart, Series, Style};
use crate::failure::Failure;
use crate::inputs::{self, StandInputs};
use crate::output::folder::OutputFolder;
use crate::output::rows::Rows;
use crate::output::{self, Format};

pub(crate) fn run(args: &WheelTestArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let inputs = inputs::wheel_test(args)?;
    let test = WheelTest {
        wheel: inputs.wheel.value,
        soil: inputs.soil.value,
        gravity: inputs.gravity,
        theory: inputs.theory,
        loads: args.load_n.0.clone(),
        slip_angles: args
            .slip_angle_deg
            .0
            .iter()
            .map(|angle| SLIP_ANGLE.unit.to_si(*angle))
            .collect(),
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
            let found = test.run();
            let table = columns::wheel_test::table(&found);
            let flags = found.iter().map(|row| &*row.findings);
            strict::check(&args.strict, flags, &table, &columns::wheel_test::SETTINGS)?;
            let brief = columns::wheel_test::brief();
            output_results(
                args,
                folder,
                &inputs,
                settings,
                &table,
                &brief,
                &chart(&table, Style::Line),
            )
        }
        Some(trials) => {
            settings["simulated_stand"] = json!({
                "trials": trials,
                "noise_n": args.stand.noise_n,
                "noise_mm": args.stand.noise_mm,
                "noise_nm": args.stand.noise_nm,
                "seed": args.stand.seed,
            });
            let rows = test.run();
            let flags = rows.iter().map(|row| &*row.findings);
            let without_noise = columns::wheel_test::table(&rows);
            strict::check(&args.strict, flags, &without_noise, &columns::wheel_test::SETTINGS)?;
            let table = columns::stand::table(&on_a_stand(test, &args.stand, trials).run());
            let brief = columns::stand::brief();
            output_results(
                args,
                folder,
                &inputs,
                settings,
                &table,
                &brief,
                &chart(&table, Style::Dots),
            )
        }
    }
}

fn on_a_stand(plan: WheelTest, args: &StandArgs, trials: usize) -> SimulatedTest {
    let noise = PerQuantity {
        drawbar_pull: args.noise_n,
        side_force: args.noise_n,
        sinkage: SINKAGE.unit.to_si(args.noise_mm),
        torque: args.noise_nm,
    };
    SimulatedTest { plan, trials, noise, seed: args.seed }
}

#[derive(Serialize)]
struct Results<'a> {
    rows: &'a Table,
}

fn output_results(
    args: &WheelTestArgs,
    folder: Option<OutputFolder>,
    inputs: &StandInputs,
    settings: Value,
    table: &Table,
    brief: &[String],
    chart: &Chart,
) -> Result<(), Failure> {
    let rows = Rows::of_table(table);
    let answer = Answer::new("wheel-test", settings, Results { rows: table });
    if let Some(mut folder) = folder {
        folder.add("wheel-test.json", answer.to_text());
        folder.add("wheel-test.csv", rows.to_csv()?);
        folder.add("wheel-test.svg", chart.to_svg());
        folder.add_document("soil.toml", &inputs.soil);
        folder.add_document("wheel.toml", &inputs.wheel);
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::print(&rows.to_table(brief)),
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

/// Drawbar pull over slip ratio, a series for each load and slip angle.
fn chart(table: &Table, style: Style) -> Chart {
    let mut series: Vec<Series> = Vec::new();
    let [loads, angles, ratios, pulls] =
        [LOAD, SLIP_ANGLE, SLIP_RATIO, DRAWBAR_PULL].map(|it| table.numbers(it.name));
    for (row, pull) in pulls.iter().enumerate() {
        let [load, angle, slip_ratio] =
            [loads, angles, ratios].map(|column| column[row].unwrap_or_default());
        let name = format!("{load} N, {angle}°");
        if series.last().is_none_or(|last| last.name != name) {
            series.push(Series::new(name, style, series.len(), []));
        }
        if let (Some(last), Some(pull)) = (series.last_mut(), *pull) {
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
