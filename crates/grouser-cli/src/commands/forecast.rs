//! `grouser forecast`: a rover under another gravity than the one its soil was measured under, with one error
//! budget.

mod figures;
mod page;

use grouser::document::columns::forecast::{self as columns, DEVIATION, FACTOR, QUANTITY, WHOLE};
use grouser::document::columns::{LIMIT_SLOPE, SLIP_RATIO, SLOPE};
use grouser::document::forecast::BEKKER_IS_CARRIED;
use grouser::document::table::{Row, Table};
use grouser::soil::GravityScaling;
use grouser::studies::forecast::{Forecast, ForecastError, Ground};
use serde::Serialize;
use serde_json::{Value, json};

use super::{Answer, sampling, strict};
use crate::args::ForecastArgs;
use crate::failure::Failure;
use crate::inputs::{self, ForecastInputs};
use crate::output::folder::OutputFolder;
use crate::output::rows::{Rows, rounded_down};
use crate::output::{self, Format};

/// The tables of a forecast.
struct Tables {
    rows: Table,
    limit: Table,
    budget: Table,
    choices: Table,
    tests: Table,
}

impl From<ForecastError> for Failure {
    fn from(error: ForecastError) -> Self {
        match error {
            ForecastError::Parameter(error) => error.into(),
            ForecastError::NothingAccepted(error) => Self::Usage(format!(
                "the uncertainty of a soil reaches too far: {error}\nhint: smaller standard \
                 deviations keep the samples within the ranges of their keys"
            )),
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
    let notes = notes(&inputs);
    let answer = Answer::new("forecast", settings(args, &inputs), tables.results(&notes));
    if let Some(mut folder) = folder {
        write(&mut folder, &inputs, &forecast, &tables, &notes)?;
        folder.add("forecast.json", answer.to_text());
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::print(&tables.text(&notes)),
        Format::Csv => output::print(&Rows::of_table(&tables.rows).to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

impl Tables {
    fn of(forecast: &Forecast) -> Self {
        Self {
            rows: columns::table(forecast),
            limit: columns::steepest(forecast),
            budget: columns::budget(forecast),
            choices: columns::choices(forecast),
            tests: columns::tests(forecast),
        }
    }

    fn results<'a>(&'a self, notes: &'a [String]) -> Results<'a> {
        let Self { rows, limit, budget, choices, tests } = self;
        Results { steepest: limit.row(0), rows, budget, choices, tests, notes }
    }

    /// The budget of a quantity.
    fn budget_of(&self, names: &[&str]) -> Table {
        let quantities = self.budget.texts(QUANTITY).iter().enumerate();
        let is_asked =
            |name: &Option<String>| name.as_deref().is_some_and(|it| names.contains(&it));
        let places = quantities.filter(|(_, name)| is_asked(name)).map(|(place, _)| place);
        self.budget.rows_at(&places.collect::<Vec<_>>())
    }

    /// The slope on which the slip is least known [°].
    fn widest_slip(&self) -> Option<f64> {
        let slip = self.budget_of(&[SLIP_RATIO.name]);
        let factors = slip.texts(FACTOR);
        let deviation = |row: &usize| slip.numbers(DEVIATION.name)[*row].unwrap_or_default();
        let whole = (0..slip.rows()).filter(|row| factors[*row].as_deref() == Some(WHOLE));
        let widest = whole.max_by(|one, other| deviation(one).total_cmp(&deviation(other)));
        widest.and_then(|row| slip.numbers(SLOPE.name)[row])
    }

    /// For reading.
    fn text(&self, notes: &[String]) -> String {
        let budget = self.budget_of(&[SLIP_RATIO.name, LIMIT_SLOPE.name]);
        let budget = Rows::of_table(&budget).to_table(&columns::budget_brief());
        let tests = if self.tests.rows() == 0 {
            String::new()
        } else {
            let names: Vec<&String> = self.tests.columns.iter().map(|(name, _)| name).collect();
            format!(
                "\ntests where the soil was measured\n{}",
                Rows::of_table(&self.tests).to_table(&names)
            )
        };
        let notes: String = notes.iter().map(|note| format!("note: {note}\n")).collect();
        format!(
            "{}{}\nerror budget of the slip ratio and of the steepest slope\n{budget}{tests}\n{notes}",
            Rows::of_table(&self.rows).to_table(&columns::brief()),
            self.limit_line(),
        )
    }

    /// The steepest slope, in a line.
    fn limit_line(&self) -> String {
        let ends = LIMIT_SLOPE.quantiles().map(|name| self.limit.numbers(&name)[0]);
        let [low, median, high] = ends.map(|end| rounded_down(end.unwrap_or_default()));
        format!(
            "steepest slope on which a heading holds the contour: {low}° to {high}° (95 %), median \
             {median}°\n"
        )
    }
}

/// What has to be said beside the numbers.
fn notes(inputs: &ForecastInputs) -> Vec<String> {
    let study = &inputs.study;
    let (gravity, measured) = (study.heading.gravity, study.measured_under);
    let source = if inputs.is_measured_under_stated { "" } else { ", which is assumed" };
    let mut notes = vec![format!(
        "the soil was measured under {measured} m/s²{source}; the site has {gravity} m/s²"
    )];
    if gravity != measured && study.choices.scalings.contains(&GravityScaling::Bekker) {
        notes.push(BEKKER_IS_CARRIED.to_owned());
    }
    if inputs.scenario.stated_uncertainty().is_none() {
        notes.push(match &inputs.scenario.uncertain {
            Some(_) => {
                "no uncertainty of this soil is stated: its samples are of priors".to_owned()
            }
            None => {
                "nothing of this soil is uncertain: the budget has no part of its numbers, and \
                     none of what a model gets wrong"
                    .to_owned()
            }
        });
    }
    notes.push("power is mechanical: motors and their losses come on top".to_owned());
    notes
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
        "speed_m_s": study.rim_speed,
        "loads": document.get("loads"),
        "moments": document.get("moments"),
        "samples": args.samples,
        "discrepancies": args.discrepancies,
        "seed": args.seed,
        sampling::SHARES: sampling::shares(band),
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
    folder.add("forecast.html", page::html(inputs, forecast, tables, (&figures, notes)));
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
