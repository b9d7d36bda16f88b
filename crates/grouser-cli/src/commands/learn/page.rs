//! What a drive taught, as text and as a page.

use grouser::answers::meanings;
use grouser::document::LoadedScenario;
use grouser::document::columns::learn::{
    self as columns, BY_ACROSS, BY_ALONG, BY_SINKAGE, BY_TORQUE, BY_TURNING, EXPECTED_SLIP,
    INFORMATION, LESSON_COLUMNS, PREDICTION_COLUMNS, WARNING_COLUMNS, WAY,
};
use grouser::document::columns::slip_from_current::{TRUE_SLIP, WHEEL};
use grouser::document::columns::{SLIP_RATIO, SLOPE, TIME};
use grouser::document::figure::axis;
use grouser::document::reading::four_digits;
use grouser::document::table::Table;
use grouser::vehicle::Rover;
use grouser_draw::chart::{BAND_COLOUR, Chart, Series, Style};

use super::advice;
use super::cards::Cards;
use super::found::{Found, of_row, shares, warning};
use super::tables::Tables;
use crate::args::LearnArgs;
use crate::output::rows::Rows;
use crate::output::text::Text;
use crate::report::answer::{self, Basis};
use crate::report::page::Page;

/// For reading: predictions with those before the drive, warnings and notes.
pub(super) fn text(found: &Found) -> Text {
    let lines: String = lines(found).iter().map(|line| format!("{line}\n")).collect();
    let text =
        Rows::of_table(&found.predictions).to_table(&columns::brief()) + format!("\n{lines}");
    match &found.advice {
        Some(advice) => text + "\n".to_owned() + advice.text(),
        None => text,
    }
}

/// What was learnt from, what to warn of, and notes: a line each.
fn lines(found: &Found) -> Vec<String> {
    let learner = found.drive.learner();
    let (learnt, models) = (learner.learnt(), shares(learner));
    let models: Vec<String> =
        models.iter().map(|(name, share)| format!("{name} {:.0} %", 100.0 * share)).collect();
    let whole = format!(
        "learnt from {} stretches, {} m of the wheels' way, in {} records; models: {}",
        learnt.stretches,
        four_digits(learnt.way),
        learnt.records,
        models.join(", ")
    );
    let narrowed: Vec<String> = found
        .narrowed
        .iter()
        .map(|(key, share)| format!("{key} {:.0} %", 100.0 * share.min(1.0)))
        .collect();
    let narrowed = format!("what is left of the uncertainty: {}", narrowed.join(", "));
    let notes = found.notes.iter().map(|note| format!("note: {note}"));
    let warnings = found.drive.warnings().iter().map(warning);
    [whole, narrowed].into_iter().chain(warnings).chain(notes).collect()
}

pub(super) fn html(
    args: &LearnArgs,
    scenario: &LoadedScenario,
    found: &Found,
    (tables, cards): (&Tables, Option<&Cards>),
) -> String {
    let mut page = Page::new("Learnt from the drive");
    let rows = (0..found.predictions.rows()).filter_map(|row| of_row(&found.predictions, row));
    let sentences: Vec<String> = rows.collect();
    page.answer(&format!("To hold the contour: {}.", sentences.join("; ")));
    page.list([
        format!("rover: {}", scenario.document.name_of("rover")),
        format!("soil before the drive: {}", scenario.document.name_of("soil")),
    ]);
    page.list(lines(found));
    page.heading("Today beside yesterday");
    page.rows(
        "Heading and slip of the next slopes, after the drive and before it",
        &found.predictions,
        &columns::brief(),
    );
    page.charts(&predictions(&found.predictions));
    if let Some(advice) = &found.advice {
        advice.add_to(&mut page);
    }
    page.heading("What each stretch taught");
    page.charts(&[over_way(&tables.lessons), information(&tables.lessons)]);
    if let Some(slips) = &tables.slips {
        page.heading("Slip from currents beside slip that was seen");
        let names: Vec<&String> = slips.wheels.columns.iter().map(|(name, _)| name).collect();
        page.rows("Slip from currents, wheel by wheel, beside that seen", &slips.wheels, &names);
        page.charts(&slips_from_currents(&scenario.value.rover, &slips.rows));
    }
    if let Some(cards) = cards {
        cards.show(&mut page);
    }
    let of_columns =
        [meanings(&PREDICTION_COLUMNS), meanings(&LESSON_COLUMNS), meanings(&WARNING_COLUMNS)];
    let mut of_columns: Vec<_> = of_columns.into_iter().flatten().collect();
    if found.advice.is_some() {
        of_columns.extend(advice::of_columns());
    }
    answer::close(page, &[], &of_columns, &basis(args, scenario))
}

/// Yaw and slip over the slope, before the drive and after it.
fn predictions(table: &Table) -> [Chart; 2] {
    use grouser::document::columns::YAW;
    use grouser::document::columns::learn::{BEFORE_SLIP, BEFORE_YAW};
    [(YAW, BEFORE_YAW, "Heading that holds the contour"), (SLIP_RATIO, BEFORE_SLIP, "Slip ratio")]
        .map(|(after, before, title)| {
            let band =
                |name: &str, colour: usize, quantity: grouser::document::columns::Quantity| {
                    let [low, _, high] = quantity.quantiles();
                    Series::band(name, colour, table.edges(SLOPE, [&low, &high]))
                };
            let median = table.points(SLOPE.name, after.name);
            let series = vec![
                band("before, 95 %", BAND_COLOUR, before),
                band("after, 95 %", AFTER, after),
                Series::new("after", Style::Line, 1, median),
            ];
            Chart::new(title.to_owned(), (axis(SLOPE), axis(after)), series)
        })
}

/// The colour of bands after the drive, among those of charts.
const AFTER: usize = 1;

fn over_way(lessons: &Table) -> Chart {
    let series = vec![
        Series::new("seen", Style::Line, 1, lessons.points(WAY.name, SLIP_RATIO.name)),
        Series::new(
            "expected before",
            Style::Dashed,
            2,
            lessons.points(WAY.name, EXPECTED_SLIP.name),
        ),
    ];
    Chart::new("Slip ratio along the way".to_owned(), (axis(WAY), axis(SLIP_RATIO)), series)
}

fn information(lessons: &Table) -> Chart {
    let parts = [
        (INFORMATION, "all"),
        (BY_ALONG, "force along the body"),
        (BY_ACROSS, "force across it"),
        (BY_TURNING, "yaw moment"),
        (BY_TORQUE, "torques"),
        (BY_SINKAGE, "sinkages"),
    ];
    let series = parts.into_iter().zip(1..).filter_map(|((quantity, name), colour)| {
        let points: Vec<_> = lessons.points(WAY.name, quantity.name).collect();
        let taught = points.iter().any(|(_, value)| *value != 0.0);
        taught.then(|| Series::new(name, Style::Line, colour, points))
    });
    let title = "Knowledge of the soil gained".to_owned();
    Chart::new(title, (axis(WAY), axis(INFORMATION)), series.collect())
}

/// A chart for each wheel: the slip that its current gives, with the band, and the slip that was
/// seen.
fn slips_from_currents(rover: &Rover, rows: &Table) -> Vec<Chart> {
    let names = rows.texts(WHEEL);
    let [low, median, high] = SLIP_RATIO.quantiles();
    let of_wheel = |wheel: &str| {
        let own = names.iter().enumerate();
        let own = own.filter(|(_, name)| name.as_deref() == Some(wheel)).map(|(place, _)| place);
        let own = rows.rows_at(&own.collect::<Vec<_>>());
        let series = vec![
            Series::band("from its current, 95 %", AFTER, own.edges(TIME, [&low, &high])),
            Series::new("from its current", Style::Line, 1, own.points(TIME.name, &median)),
            Series::new("seen", Style::Dashed, 2, own.points(TIME.name, TRUE_SLIP.name)),
        ];
        Chart::new(wheel.to_owned(), (axis(TIME), axis(SLIP_RATIO)), series)
    };
    rover.mounts().iter().map(|mount| of_wheel(&mount.name)).collect()
}

fn basis(args: &LearnArgs, scenario: &LoadedScenario) -> Basis {
    let list = |numbers: &crate::list::Numbers| {
        numbers.0.iter().map(ToString::to_string).collect::<Vec<_>>().join(",")
    };
    let slope = args.slope_deg.as_ref().map_or(String::new(), |it| format!(" --slope-deg={it}"));
    let repeat = format!(
        "grouser learn log.csv --scenario scenario.toml{slope} --predict-slope-deg {} --samples {} \
         --seed {}{}",
        list(&args.predict_slope_deg),
        args.samples,
        args.seed,
        advice::flags(&args.advice)
    );
    Basis::new(repeat).with("scenario.toml", scenario)
}
