//! `grouser heading-map`: the heading offset over slope, course and soil.

mod page;
mod pivot;

use grouser::document::columns::{COURSE, MODEL, Quantity, SLIP_RATIO, SLOPE, YAW, heading};
use grouser::document::table::{Table, Values};
use grouser::document::{LoadedScenario, escape};
use grouser::studies::ensemble::models::Question;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::heading::{HeadingOffset, HeadingStudy};
use grouser::studies::heading_map::HeadingMap;
use grouser_draw::chart::{Draw, HeatMap};
use serde::Serialize;
use serde_json::{Value, json};

use super::{Answer, sampling, strict};
use crate::args::{HeadingMapArgs, UncertaintyArgs};
use crate::failure::Failure;
use crate::inputs;
use crate::output::folder::OutputFolder;
use crate::output::rows::Rows;
use crate::output::{self, Format};
use crate::report::REPORT;

/// * `command`: the name by which it was asked for, which its results and files have
pub(crate) fn run(command: &str, args: &HeadingMapArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let scenarios = inputs::heading_map(args)?;
    let studies: Vec<HeadingStudy> =
        scenarios.iter().map(|scenario| HeadingStudy::of(&scenario.value)).collect();
    let in_si = |quantity: Quantity, list: &[f64]| {
        list.iter().map(|number| quantity.unit.to_si(*number)).collect::<Vec<_>>()
    };
    let courses = in_si(COURSE, &args.course_deg.0);
    let slopes = in_si(SLOPE, &args.slope_deg.0);
    let map = HeadingMap::of(&studies, &courses, &slopes)?;
    let names: Vec<String> = scenarios.iter().map(soil_name).collect();
    let table = table(args, &scenarios, &studies, &map, &names)?;
    let flags = map.rows.iter().flat_map(|row| &row.findings);
    strict::check(&args.strict, flags.map(|it| &**it), &table, &heading::SETTINGS)?;
    let rows = Rows::of_table(&table);
    let answer = Answer::new(command, settings(args, &scenarios), Results { rows: &table });
    if let Some(mut folder) = folder {
        folder.add(format!("{command}.json"), answer.to_text());
        folder.add(format!("{command}.csv"), rows.to_csv()?);
        let mut maps = Vec::new();
        for (place, (scenario, name)) in scenarios.iter().zip(&names).enumerate() {
            // One soil needs no number.
            let number =
                if scenarios.len() > 1 { format!("-{}", place + 1) } else { String::new() };
            let name = title(args, scenario, name);
            for (file, figure) in figures(args, &map, place, &name) {
                folder.add(format!("{file}{number}.svg"), figure.to_svg());
                maps.push(figure);
            }
            if let Some(figure) = slip_figure(args, &table, place, &name) {
                folder.add(format!("slip-p97_5{number}.svg"), figure.to_svg());
                maps.push(figure);
            }
            folder.add_document(&format!("scenario{number}.toml"), scenario);
        }
        folder.add(REPORT, page::html(command, args, &scenarios, &map, (&maps, &table)));
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => {
            let titles: Vec<String> = scenarios
                .iter()
                .zip(&names)
                .map(|(scenario, name)| title(args, scenario, name))
                .collect();
            let text = match output::terminal::width() {
                Some(_) => pivot::text(&table, args, &titles),
                None => rows.to_table(&brief(args)),
            };
            output::show(text + model_lines(args, &scenarios, &names))
        }
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

/// What bands are drawn from. Straight up or down a slope no model needs forces across the wheels.
fn band_inputs(args: &HeadingMapArgs, scenario: &LoadedScenario) -> BandInputs {
    let courses = args.course_deg.0.iter().map(|course| Question::on_course(course.to_radians()));
    BandInputs::of_scenario(scenario).asked(Question::of_all(courses))
}

/// A row for each model that is asked for, soil, course and slope, with the bands that are asked
/// for.
fn table(
    args: &HeadingMapArgs,
    scenarios: &[LoadedScenario],
    studies: &[HeadingStudy],
    map: &HeadingMap,
    names: &[String],
) -> Result<Table, Failure> {
    let rover = &scenarios[0].value.rover;
    let mut table = heading::map_table(map, names, rover, args.rim_speed_m_s.0[0]);
    let UncertaintyArgs { sampling, seed } = args.uncertainty;
    if sampling.uncertainty {
        let draw = |scenario: &LoadedScenario| {
            inputs::refuse_sampled_keys(&args.setting, scenario.uncertain.as_ref())?;
            sampling::draw(&band_inputs(args, scenario), sampling.samples, seed)
        };
        let samples = scenarios.iter().map(draw).collect::<Result<Vec<_>, _>>()?;
        let count = samples.iter().map(Vec::len).sum::<usize>() * args.course_deg.0.len();
        let bands = sampling::with_bar(count, |go_on| map.bands(studies, &samples, go_on));
        table = heading::map_with_bands(table, &sampling::whole(bands?));
    }
    if args.setting.has_every_model() {
        let rows = scenarios.iter().flat_map(|scenario| {
            let count = args.course_deg.0.len() * args.slope_deg.0.len();
            std::iter::repeat_n(scenario.value.model.name(), count)
        });
        let words = rows.map(|name| Some(name.to_owned())).collect();
        table.columns.insert(0, (MODEL.to_owned(), Values::Text(words)));
    }
    Ok(table)
}

/// Which model the rows of a soil have, where nobody names one; with the soil's name if there are
/// several.
///
/// * `names`: of the soils
fn model_lines(args: &HeadingMapArgs, scenarios: &[LoadedScenario], names: &[String]) -> String {
    let line = |(scenario, name): (&LoadedScenario, &String)| {
        let is_spread = args.uncertainty.sampling.uncertainty && !args.setting.has_every_model();
        let weights = || sampling::line(&band_inputs(args, scenario));
        let weights = is_spread.then(weights).unwrap_or_default();
        let line = inputs::model_line(&scenario.document, "soil") + &weights;
        let is_named = scenarios.len() > 1 && !line.is_empty();
        if is_named { format!("{}: {line}", escape::line(name)) } else { line }
    };
    scenarios.iter().zip(names).map(line).collect()
}

/// The columns for reading.
fn brief(args: &HeadingMapArgs) -> Vec<String> {
    let has_bands = args.uncertainty.sampling.uncertainty;
    let mut names = if has_bands { heading::map_bands_brief() } else { heading::map_brief() };
    if args.setting.has_every_model() {
        names.insert(0, MODEL.to_owned());
    }
    names
}

/// What a figure is of: the soil, and the model where there are several.
fn title(args: &HeadingMapArgs, scenario: &LoadedScenario, soil: &str) -> String {
    let model = scenario.value.model.name();
    if args.setting.has_every_model() { format!("{soil}, {model}") } else { soil.to_owned() }
}

#[derive(Serialize)]
struct Results<'a> {
    rows: &'a Table,
}

fn soil_name(scenario: &LoadedScenario) -> String {
    scenario.document.text("soil.name").unwrap_or("unnamed").to_owned()
}

/// The inputs of the answer.
fn settings(args: &HeadingMapArgs, scenarios: &[LoadedScenario]) -> Value {
    let first = &scenarios[0].document;
    let soils: Vec<_> = scenarios.iter().map(|scenario| scenario.document.get("soil")).collect();
    let models: Vec<_> = scenarios.iter().map(|scenario| scenario.value.model.name()).collect();
    let mut settings = json!({
        "rover": first.get("rover"),
        "soils": soils,
        "models": models,
        "gravity_m_s2": first.get("gravity_m_s2"),
        "load_transfer": first.get("load_transfer"),
        "wheel_moments": first.get("wheel_moments"),
        "course_deg": args.course_deg.0,
        "slope_deg": args.slope_deg.0,
        "rim_speed_m_s": args.rim_speed_m_s.0[0],
    });
    let UncertaintyArgs { sampling, seed } = args.uncertainty;
    if sampling.uncertainty {
        settings["samples"] = sampling.samples.into();
        settings["seed"] = seed.into();
        let weights = scenarios.iter().map(|it| sampling::weights(&band_inputs(args, it)));
        settings[sampling::WEIGHTS] = sampling::one_or_each(weights.collect());
    }
    settings
}

/// A heat map of the upper end of the slip's band, if there is one.
fn slip_figure(args: &HeadingMapArgs, table: &Table, study: usize, name: &str) -> Option<HeatMap> {
    let [_, _, high] = SLIP_RATIO.quantiles();
    let (courses, slopes) = (args.course_deg.0.len(), args.slope_deg.0.len());
    let values = table.numbers(&high).chunks(slopes).skip(study * courses).take(courses);
    let values: Vec<Vec<Option<f64>>> = values.map(<[_]>::to_vec).collect();
    (!values.is_empty()).then(|| HeatMap {
        title: format!("Slip ratio that 97.5 % of the samples stay below, on {name}"),
        x_label: "slope [°]".into(),
        columns: args.slope_deg.0.clone(),
        y_label: "course, positive uphill [°]".into(),
        rows: args.course_deg.0.clone(),
        values,
    })
}

/// Heat maps of the yaw beyond the course and of the slip over slope and course.
fn figures(
    args: &HeadingMapArgs,
    map: &HeadingMap,
    soil: usize,
    name: &str,
) -> [(&'static str, HeatMap); 2] {
    let figure = |title: &str, value: fn(&HeadingOffset) -> f64| {
        let rows = map.rows.iter().filter(|row| row.study == soil);
        let values = rows.map(|row| {
            row.cells.iter().map(|cell| cell.as_ref().ok().map(value)).collect::<Vec<_>>()
        });
        HeatMap {
            title: format!("{title}, on {name}"),
            x_label: "slope [°]".into(),
            columns: args.slope_deg.0.clone(),
            y_label: "course, positive uphill [°]".into(),
            rows: args.course_deg.0.clone(),
            values: values.collect(),
        }
    };
    [
        (
            "crab",
            figure("Yaw beyond the course [°]", |heading| {
                YAW.unit.from_si(heading.yaw - heading.course)
            }),
        ),
        ("slip", figure("Slip ratio", |heading| heading.slip_ratio)),
    ]
}
