//! `grouser wheel-test`: forces and sinkage of one wheel on a test stand.

mod charted;
mod page;

use grouser::document::columns::{self, DRAWBAR_PULL, MODEL, SINKAGE, TORQUE};
use grouser::document::table::Table;
use grouser::studies::ensemble::models::Question;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::measurement::PerQuantity;
use grouser::studies::simulated_test::SimulatedTest;
use grouser::studies::wheel_test::WheelTest;
use grouser_draw::chart::{Draw, Style};
use serde::Serialize;
use serde_json::{Value, json};

use self::charted::{Charted, brief, plan};
use super::{Answer, sampling, strict};
use crate::args::{EVERY_MODEL, StandArgs, WheelTestArgs};
use crate::failure::Failure;
use crate::inputs::{self, StandInputs};
use crate::output::folder::OutputFolder;
use crate::output::rows::Rows;
use crate::output::{self, Format};
use crate::report::REPORT;

pub(crate) fn run(args: &WheelTestArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let stands = inputs::wheel_test(args)?;
    let mut results = Results::default();
    for stand in &stands {
        let mut of_model = of_model(args, stand)?;
        if args.setting.has_every_model() {
            of_model = of_model.with_word(MODEL, stand.model.name());
        }
        results.rows.append(of_model);
    }
    output_results(args, folder, &stands, &results)
}

/// The rows of one model.
fn of_model(args: &WheelTestArgs, stand: &StandInputs) -> Result<Table, Failure> {
    let test = plan(args, stand);
    let found = test.run();
    let table = columns::wheel_test::table(&found);
    let flags = found.iter().map(|row| &*row.findings);
    strict::check(&args.strict, flags, &table, &columns::wheel_test::SETTINGS)?;
    if let Some(trials) = args.stand.trials {
        return Ok(columns::stand::table(&on_a_stand(test, &args.stand, trials).run()));
    }
    if !args.sampling.uncertainty {
        return Ok(table);
    }
    let samples =
        sampling::draw(&band_inputs(args, stand), args.sampling.samples, args.stand.seed)?;
    let bands = sampling::with_bar(samples.len(), |go_on| test.bands(&samples, go_on));
    Ok(columns::wheel_test::with_bands(table, &sampling::whole(bands)))
}

/// The inputs of the answer.
fn settings(args: &WheelTestArgs, stand: &StandInputs) -> Value {
    let every = args.setting.has_every_model();
    let mut settings = json!({
        "soil": stand.soil.document,
        "wheel": stand.wheel.document,
        "gravity_m_s2": stand.gravity,
        "model": if every { EVERY_MODEL } else { stand.model.name() },
        "load_n": args.load_n.0,
        "slip_angle_deg": args.slip_angle_deg.0,
        "slip_ratio": args.slip_ratio.0,
    });
    if let Some(trials) = args.stand.trials {
        settings["simulated_stand"] = json!({
            "trials": trials,
            "noise_n": args.stand.noise_n,
            "noise_mm": args.stand.noise_mm,
            "noise_nm": args.stand.noise_nm,
            "seed": args.stand.seed,
        });
    }
    if args.sampling.uncertainty {
        settings["samples"] = args.sampling.samples.into();
        settings["seed"] = args.stand.seed.into();
        if !every {
            settings[sampling::WEIGHTS] = sampling::weights(&band_inputs(args, stand));
        }
    }
    settings
}

/// What bands are drawn from. A wheel that runs straight needs no force across it.
fn band_inputs(args: &WheelTestArgs, stand: &StandInputs) -> BandInputs {
    let angles = args.slip_angle_deg.0.iter().map(|angle| Question::at_slip_angle(*angle));
    stand.band.clone().asked(Question::of_all(angles))
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

#[derive(Default, Serialize)]
struct Results {
    rows: Table,
}

fn output_results(
    args: &WheelTestArgs,
    folder: Option<OutputFolder>,
    stands: &[StandInputs],
    results: &Results,
) -> Result<(), Failure> {
    let rows = Rows::of_table(&results.rows);
    // Stands differ by their models alone.
    let inputs = &stands[0];
    let answer = Answer::new("wheel-test", settings(args, inputs), results);
    if let Some(mut folder) = folder {
        folder.add("wheel-test.json", answer.to_text());
        folder.add("wheel-test.csv", rows.to_csv()?);
        let dense = dense(args, stands);
        let style = if args.stand.trials.is_some() { Style::Dots } else { Style::Line };
        let charted =
            Charted { rows: &results.rows, drawn: dense.as_ref().unwrap_or(&results.rows), style };
        folder.add("wheel-test.svg", charted.chart(DRAWBAR_PULL).to_svg());
        folder.add("sinkage.svg", charted.chart(SINKAGE).to_svg());
        folder.add("torque.svg", charted.chart(TORQUE).to_svg());
        folder.add(REPORT, page::html(args, stands, &charted));
        folder.add_document("soil.toml", &inputs.soil);
        folder.add_document("wheel.toml", &inputs.wheel);
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::show(rows.to_table(&brief(args)) + model_line(args, inputs)),
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

/// Which model the rows have, where nobody names one, and which ones their bands.
fn model_line(args: &WheelTestArgs, stand: &StandInputs) -> String {
    let weights = if args.sampling.uncertainty {
        sampling::line(&band_inputs(args, stand))
    } else {
        String::new()
    };
    match args.setting.model {
        Some(_) => String::new(),
        None => inputs::model_line(&stand.soil.document, "") + &weights,
    }
}

/// The same test at slip ratios so close that curves are smooth; nothing where the rows have noise
/// or bands, or are of few slip ratios.
fn dense(args: &WheelTestArgs, stands: &[StandInputs]) -> Option<Table> {
    /// Points of a curve.
    const POINTS: u32 = 120;
    let slips = &args.slip_ratio.0;
    let [low, high] = [f64::min, f64::max].map(|end| slips.iter().copied().fold(f64::NAN, end));
    if slips.len() < 3 || args.stand.trials.is_some() || args.sampling.uncertainty {
        return None;
    }
    let share = |point| f64::from(point) / f64::from(POINTS);
    let between = (0..=POINTS).map(|point| low + (high - low) * share(point));
    let slip_ratios: Vec<f64> = between.collect();
    let mut table = Table::default();
    for stand in stands {
        let test = WheelTest { slip_ratios: slip_ratios.clone(), ..plan(args, stand) };
        let of_model = columns::wheel_test::table(&test.run());
        let every = args.setting.has_every_model();
        table.append(if every { of_model.with_word(MODEL, stand.model.name()) } else { of_model });
    }
    Some(table)
}
