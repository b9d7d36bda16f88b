//! `grouser forecast`: a rover under another gravity than the one its soil was measured under, with
//! one error budget.

mod figures;
mod page;
mod tables;

use grouser::document::columns::SLOPE;
use grouser::document::forecast::notes;
use grouser::document::table::{Row, Table};
use grouser::studies::forecast::{Forecast, ForecastError, Ground};
use serde::Serialize;
use serde_json::{Value, json};

use super::{Answer, sampling, strict};
use crate::args::ForecastArgs;
use crate::failure::Failure;
use crate::inputs::{self, ForecastInputs};
use crate::output::folder::OutputFolder;
use crate::output::rows::Rows;
use crate::output::{self, Format};
use crate::report::REPORT;
use tables::Tables;

impl From<ForecastError> for Failure {
    fn from(error: ForecastError) -> Self {
        match error {
            ForecastError::Parameter(error) => error.into(),
            ForecastError::NothingAccepted(error) => Self::Usage(format!(
                "the uncertainty of a soil reaches too far: {error}\nhint: smaller standard \
                 deviations keep the samples within the ranges of their keys"
            )),
            ForecastError::NotFound(_) => Self::Run(error.to_string()),
        }
    }
}

pub(crate) fn run(args: &ForecastArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let inputs = inputs::forecast(args)?;
    let ForecastInputs { study, band, slopes, .. } = &inputs;
    let found = sampling::with_bar(study.steps(band), |go_on| study.run(band, slopes, go_on));
    let forecast = sampling::whole(found?);
    let tables = Tables::of(&forecast);
    let flags = forecast.slopes.iter().map(|slope| &*slope.findings);
    strict::check(&args.strict, flags, &tables.rows, &[SLOPE.name])?;
    let notes = notes(study, &inputs.scenario, inputs.is_measured_under_stated);
    let answer = Answer::new("forecast", settings(args, &inputs), results(&tables, &notes));
    if let Some(mut folder) = folder {
        write(&mut folder, &inputs, &forecast, &tables, &notes)?;
        folder.add("forecast.json", answer.to_text());
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::show(tables.text(&notes)),
        Format::Csv => output::print(&Rows::of_table(&tables.rows).to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

fn results<'a>(tables: &'a Tables, notes: &'a [String]) -> Results<'a> {
    let Tables { rows, limit, budget, choices, tests } = tables;
    Results { steepest: limit.row(0), rows, budget, choices, tests, notes }
}

#[derive(Serialize)]
struct Results<'a> {
    #[serde(flatten)]
    steepest: Row<'a>,
    rows: &'a Table,
    budget: &'a Table,
    choices: &'a Table,
    tests: &'a Table,
    notes: &'a [String],
}

/// The inputs of the answer.
fn settings(args: &ForecastArgs, inputs: &ForecastInputs) -> Value {
    let ForecastInputs { scenario, study, band, .. } = inputs;
    let (document, choices) = (&scenario.document, &study.choices);
    let scalings: Vec<&str> = choices.scalings.iter().map(|scaling| scaling.name()).collect();
    let grounds: Vec<&str> = choices.grounds.iter().map(Ground::name).collect();
    let masses = choices.masses.iter().map(|mass| (mass.name.clone(), json!(mass.factor)));
    let documents: Vec<Value> =
        inputs.grounds.iter().map(|ground| json!(ground.document)).collect();
    json!({
        "rover": document.get("rover"),
        "soil": document.get("soil"),
        "site": args.site,
        "gravity_m_s2": document.get("gravity_m_s2"),
        "measured_gravity_m_s2": study.measured_under,
        "scaling": scalings,
        "ground": grounds,
        "ground_soils": documents,
        "mass": masses.collect::<serde_json::Map<_, _>>(),
        "slope_deg": args.slope_deg.0,
        "rim_speed_m_s": study.rim_speed,
        "load_transfer": document.get("load_transfer"),
        "wheel_moments": document.get("wheel_moments"),
        "samples": args.samples,
        "discrepancies": args.discrepancies,
        "seed": args.seed,
        sampling::WEIGHTS: sampling::weights(band),
    })
}

fn write(
    folder: &mut OutputFolder,
    inputs: &ForecastInputs,
    forecast: &Forecast,
    tables: &Tables,
    notes: &[String],
) -> Result<(), Failure> {
    let figures = figures::all(forecast, tables);
    folder.add(REPORT, page::html(inputs, forecast, tables, (&figures, notes)));
    for figure in figures {
        folder.add(format!("{}.svg", figure.file), figure.svg);
    }
    let csv = [
        ("forecast", &tables.rows),
        ("budget", &tables.budget),
        ("choices", &tables.choices),
        ("tests", &tables.tests),
    ];
    for (name, table) in csv {
        folder.add(format!("{name}.csv"), Rows::of_table(table).to_csv()?);
    }
    folder.add_document("scenario.toml", &inputs.scenario);
    for (place, ground) in inputs.grounds.iter().enumerate() {
        let place = format!("ground-{}", place + 1);
        folder.add(format!("{place}/soil.toml"), ground.to_toml());
        for companion in &ground.companions {
            folder.add(format!("{place}/{}", companion.name), companion.content.clone());
        }
    }
    Ok(())
}
