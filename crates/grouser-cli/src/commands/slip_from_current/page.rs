//! The page of slip from currents: each wheel's slip over time, and what it comes to.

use grouser::document::columns::slip_from_current::{
    self as columns, ESTIMATE, SHARE_HELD, TRUE_SLIP, WHEEL, brief,
};
use grouser::document::columns::{SLIP_RATIO, STATUS, TIME};
use grouser::document::table::Table;
use grouser::studies::slip_from_current::SlipStatus;
use grouser::vehicle::Rover;
use grouser_draw::chart::{BAND_COLOUR, Chart, Draw, Series, Style};

use super::tables::{self, Tables};
use crate::args::SlipFromCurrentArgs;
use crate::commands::sampling;
use crate::inputs::SlipInputs;
use crate::list::Numbers;
use crate::output::rows::four_digits;
use crate::report::answer::{self, Basis, axis, meanings};
use crate::report::page::Page;

pub(super) fn html(
    args: &SlipFromCurrentArgs,
    inputs: &SlipInputs,
    tables: &Tables,
    notes: &[String],
) -> String {
    let mut page = Page::new("Slip from motor current");
    page.answer(&sentence(&tables.wheels));
    let document = &inputs.scenario.document;
    let name = |key: &str| document.text(key).unwrap_or("unnamed").to_owned();
    page.list([format!("rover: {}", name("rover.name")), format!("soil: {}", name("soil.name"))]);
    page.list(notes);
    page.heading("Each wheel over time");
    for (_, chart) in charts(&inputs.scenario.value.rover, &tables.rows) {
        page.drawing(
            &chart.to_svg(),
            "The median and the 95 % interval from the current; where the interval is wider than 0.2 the \
             current does not give the slip.",
        );
    }
    page.heading("What it comes to");
    let names: Vec<String> = tables.wheels.columns.iter().map(|(name, _)| name.clone()).collect();
    page.rows("Each wheel, and all of them", &tables.wheels, &names);
    let states = tables::meanings(&tables.rows);
    page.list(states.lines());
    page.heading("Every reading");
    page.rows("Readings and slip", &tables.rows, &brief(&tables.rows));
    let of_columns =
        [meanings(&columns::of_reading()), meanings(&ESTIMATE), meanings(&columns::of_truth())];
    let of_columns: Vec<_> = of_columns.into_iter().flatten().collect();
    answer::close(page, &[], &of_columns, &basis(args, inputs))
}

/// What all wheels come to.
fn sentence(wheels: &Table) -> String {
    let last = wheels.rows() - 1;
    let count = |name: &str| {
        let row = serde_json::to_value(wheels.row(last)).unwrap_or_default();
        row.get(name).and_then(serde_json::Value::as_u64).unwrap_or_default()
    };
    let (readings, estimated, ill_posed) =
        (count("readings"), count("estimated"), count("ill_posed"));
    let held = wheels.numbers(SHARE_HELD.name).get(last).copied().flatten();
    let held = held.map_or(String::new(), |share| {
        format!(
            " The 95 % intervals hold the slip that was measured by other means in {} % of them.",
            four_digits(100.0 * share)
        )
    });
    format!(
        "{estimated} of {readings} readings of a current give a slip ratio; in {ill_posed} of these torque \
         hardly changes with slip, so that the interval is wider than 0.2.{held}"
    )
}

/// The slip of each wheel over time, by the wheel's name.
pub(super) fn charts(rover: &Rover, rows: &Table) -> Vec<(String, Chart)> {
    let chart = |name: &String| {
        let of_wheel = rows.texts(WHEEL).iter().enumerate();
        let of_wheel = of_wheel.filter(|(_, wheel)| wheel.as_ref() == Some(name));
        let places: Vec<usize> = of_wheel.map(|(place, _)| place).collect();
        let rows = rows.rows_at(&places);
        let [low, median, high] = SLIP_RATIO.quantiles();
        let ends = rows.points(TIME.name, &low).zip(rows.points(TIME.name, &high));
        let edges: Vec<_> = ends.map(|((time, low), (_, high))| (time, low, high)).collect();
        let states = rows.texts(STATUS).iter().enumerate();
        let ill_posed = states
            .filter(|(_, status)| status.as_deref() == Some(SlipStatus::IllPosed.name()))
            .map(|(place, _)| place);
        let ill_posed = rows.rows_at(&ill_posed.collect::<Vec<_>>());
        let series = [
            Series::band("95 %", BAND_COLOUR, edges),
            Series::new("from the current", Style::Line, 1, rows.points(TIME.name, &median)),
            Series::new("ill-posed", Style::Triangles, 3, ill_posed.points(TIME.name, &median)),
            Series::new("measured", Style::Dashed, 2, rows.points(TIME.name, TRUE_SLIP.name)),
        ];
        let series: Vec<Series> =
            series.into_iter().filter(|series| !series.points.is_empty()).collect();
        let chart =
            Chart::new(format!("Slip ratio of {name}"), (axis(TIME), axis(SLIP_RATIO)), series);
        (!chart.series.is_empty()).then(|| (name.clone(), chart))
    };
    rover.mounts().iter().filter_map(|mount| chart(&mount.name)).collect()
}

fn basis(args: &SlipFromCurrentArgs, inputs: &SlipInputs) -> Basis {
    let list =
        |numbers: &Numbers| numbers.0.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
    let flags = [
        ("--yaw-deg", args.yaw_deg.as_ref()),
        ("--course-deg", args.course_deg.as_ref()),
        ("--relative-noise", Some(&args.relative_noise)),
        ("--noise-nm", Some(&args.noise_nm)),
        ("--slip-ratio", Some(&args.slip_ratio)),
    ];
    let flags = flags.into_iter().filter_map(|(flag, numbers)| Some((flag, list(numbers?))));
    let flags: String = flags.map(|(flag, list)| format!(" {flag}={list}")).collect();
    let ignored = match args.ignore.join(",") {
        names if names.is_empty() => names,
        names => format!(" --ignore {names}"),
    };
    let samples = sampling::flags(&args.uncertainty);
    let repeat = format!(
        "grouser slip-from-current log.csv --scenario scenario.toml{flags}{ignored}{samples}"
    );
    Basis::new(repeat).with("scenario.toml", &inputs.scenario)
}
