//! `grouser heading`: the heading offset that holds the contour on a slope.

mod of_model;
mod page;

use grouser::document::LoadedScenario;
use grouser::document::columns::SLOPE;
use grouser::document::columns::heading::{self};
use grouser::document::columns::wheel_speeds;
use grouser::document::table::{Row, Table};
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::heading::{HeadingCurve, HeadingStudy, Steering};
use grouser::studies::wheel_speeds::{WheelSpeedStudy, WheelSpeeds};
use grouser_draw::chart::Draw;
use serde::Serialize;
use serde_json::{Value, json};

use self::of_model::{OfModel, brief, figures};
use super::heading_band;
use super::{Answer, sampling, strict};
use crate::args::{EVERY_MODEL, HeadingArgs, SettingArgs, UncertaintyArgs};
use crate::failure::Failure;
use crate::inputs;
use crate::output::folder::OutputFolder;
use crate::output::rows::Rows;
use crate::output::{self, Format};
use crate::report::REPORT;

/// * `command`: the name by which it was asked for, which its results and files have
pub(crate) fn run(command: &str, args: &HeadingArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let each = |setting| of_model(args, &setting, folder.is_some());
    let all: Vec<OfModel> =
        args.setting.each_model().into_iter().map(each).collect::<Result<_, _>>()?;
    let (mut table, mut limits) = (Table::default(), Table::default());
    for of_model in &all {
        table.append(of_model.named(args, &of_model.table));
        let limit = of_model.own_speeds.as_ref().unwrap_or(&of_model.limit);
        limits.append(of_model.named(args, limit));
    }
    let rows = Rows::of_table(&table);
    let limit = if args.setting.has_every_model() || args.wheel_speeds {
        Limits::Each { limits: &limits }
    } else {
        Limits::One(limits.row(0))
    };
    let answer = Answer::new(command, settings(args, &all[0]), Results { limit, rows: &table });
    if let Some(mut folder) = folder {
        folder.add(format!("{command}.json"), answer.to_text());
        folder.add(format!("{command}.csv"), rows.to_csv()?);
        for (name, chart, _) in figures(command, &all) {
            folder.add(name, chart.to_svg());
        }
        folder.add(REPORT, page::html(command, args, &all, &table));
        for of_model in &all {
            let end = of_model.end(all.len());
            folder.add_document(&format!("scenario{end}.toml"), &of_model.scenario);
        }
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => {
            let lines = all.iter().map(|of_model| of_model.lines(all.len())).collect::<String>();
            let model = inputs::model_line(&all[0].scenario.document, "soil");
            let is_spread =
                args.uncertainty.sampling.uncertainty && !args.setting.has_every_model();
            let weights = || sampling::line(&BandInputs::of_scenario(&all[0].scenario));
            let weights = is_spread.then(weights).unwrap_or_default();
            output::show(rows.to_table(&brief(args, &all[0])) + lines + model + weights)
        }
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

/// * `setting`: with one model
/// * `charted`: whether there will be charts
fn of_model(args: &HeadingArgs, setting: &SettingArgs, charted: bool) -> Result<OfModel, Failure> {
    let scenario = inputs::heading(args, setting)?;
    let steering = args.steering.into();
    let curve = HeadingStudy { steering, ..HeadingStudy::of(&scenario.value) }.curve()?;
    let bands = if args.uncertainty.sampling.uncertainty {
        Some(heading_band::bands(args, &scenario, &curve, charted)?)
    } else {
        None
    };
    let slopes: Vec<f64> = args.slope_deg.0.iter().map(|slope| SLOPE.unit.to_si(*slope)).collect();
    let mut table = heading::table(&curve, &scenario.value.rover, &slopes);
    if args.strict.strict {
        let flags = heading::findings(&curve, &slopes);
        strict::check(&args.strict, flags.iter().map(|it| &**it), &table, &[SLOPE.name])?;
    }
    let mut limit = heading::steepest(&curve);
    let own_speeds = own_speeds(args, &scenario, &curve)?;
    if let Some(own) = &own_speeds {
        table = wheel_speeds::table(own, &slopes);
    }
    let own_speeds = own_speeds.map(|own| wheel_speeds::limits(&own));
    if let Some(bands) = &bands {
        table = heading::with_bands(table, &bands.asked);
        limit.columns.extend(bands.limit.columns.clone());
    }
    Ok(OfModel { scenario, curve, bands, own_speeds, table, limit })
}

/// Wheels at speeds of their own, where they are asked for.
fn own_speeds(
    args: &HeadingArgs,
    scenario: &LoadedScenario,
    curve: &HeadingCurve,
) -> Result<Option<WheelSpeeds>, Failure> {
    if !args.wheel_speeds {
        return Ok(None);
    }
    let heading = HeadingStudy::of(&scenario.value);
    let study = WheelSpeedStudy { heading, most_ratio: args.most_speed_ratio };
    Ok(Some(WheelSpeeds::from(study, curve.clone())?))
}

/// The inputs of the answer.
fn settings(args: &HeadingArgs, first: &OfModel) -> Value {
    let document = &first.scenario.document;
    let every = args.setting.has_every_model();
    let mut settings = json!({
        "rover": document.get("rover"),
        "soil": document.get("soil"),
        "gravity_m_s2": document.get("gravity_m_s2"),
        "model": if every { EVERY_MODEL } else { first.name() },
        "load_transfer": document.get("load_transfer"),
        "wheel_moments": document.get("wheel_moments"),
        "slope_deg": args.slope_deg.0,
    });
    let steering = Steering::from(args.steering);
    if steering != Steering::None {
        settings["steering"] = steering.name().into();
    }
    if args.wheel_speeds {
        settings["most_speed_ratio"] = args.most_speed_ratio.into();
    }
    let UncertaintyArgs { sampling, seed } = args.uncertainty;
    if sampling.uncertainty {
        settings["samples"] = sampling.samples.into();
        settings["seed"] = seed.into();
        if !every {
            settings[sampling::WEIGHTS] =
                sampling::weights(&BandInputs::of_scenario(&first.scenario));
        }
    }
    settings
}

#[derive(Serialize)]
struct Results<'a> {
    #[serde(flatten)]
    limit: Limits<'a>,
    rows: &'a Table,
}

/// The steepest slopes, with their bands.
#[derive(Serialize)]
#[serde(untagged)]
enum Limits<'a> {
    One(Row<'a>),
    /// A row for each model, and for each freedom of the wheels' speeds.
    Each {
        limits: &'a Table,
    },
}
