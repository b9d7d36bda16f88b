//! A replayed drive, as text and as a page.

use grouser::document::LoadedScenario;
use grouser::document::columns::replay::{
    FINDINGS, STRETCH, brief_channels, brief_findings, columns_of, measured_channels, prefix_of,
    quantity_of,
};
use grouser::document::columns::{ENERGY, TIME};
use grouser::document::table::Table;
use grouser::studies::replay::{Channel, Prediction};
use grouser::vehicle::Rover;
use grouser_draw::chart::{BAND_COLOUR, Chart, Series, Style};

use super::found::Found;
use crate::args::ReplayArgs;
use crate::commands::sampling;
use crate::output::rows::{Rows, four_digits};
use crate::output::text::{Text, capitalised};
use crate::report::answer::{self, Basis, axis, meanings};
use crate::report::page::Page;

/// For reading: the channels, what their differences point to, and notes.
pub(super) fn text(found: &Found) -> Text {
    let lines: String = lines(found).iter().map(|line| format!("{line}\n")).collect();
    let channels = Rows::of_table(&found.channels).to_table(&brief_channels(&found.replay));
    let findings = Rows::of_table(&found.findings).to_table(&brief_findings());
    channels + "\n".to_owned() + findings + format!("\n{lines}")
}

/// What the differences point to, what was replayed, and notes: a line each.
fn lines(found: &Found) -> Vec<String> {
    let points = found.sentences.iter().map(|it| format!("points to: {it}"));
    let notes = found.notes.iter().map(|note| format!("note: {note}"));
    points.chain(whole(found)).chain(notes).collect()
}

fn whole(found: &Found) -> Vec<String> {
    let replay = &found.replay;
    let taken = &replay.taken;
    let compared = format!("replayed {} stretches of {} records", taken.stretches, taken.records);
    let work = replay.energy.map(|work| {
        let [measured, predicted] = work.map(|it| four_digits(ENERGY.unit.from_si(it)));
        let unit = ENERGY.unit.symbol;
        format!("work of the wheels: measured {measured} {unit}, predicted {predicted} {unit}")
    });
    [compared].into_iter().chain(work).collect()
}

pub(super) fn html(args: &ReplayArgs, scenario: &LoadedScenario, found: &Found) -> String {
    let mut page = Page::new("The drive, replayed");
    for sentence in &found.sentences {
        page.answer(&format!("{}.", capitalised(sentence)));
    }
    let name = |key: &str| scenario.document.text(key).unwrap_or("unnamed").to_owned();
    page.list([
        format!("rover: {}", name("rover.name")),
        format!("soil: {}", name("soil.name")),
        format!("model: {}", scenario.value.model.name()),
    ]);
    page.list(whole(found));
    page.list(&found.notes);
    page.heading("What the differences point to");
    page.rows("What may be wrong, and by how much", &found.findings, &brief_findings());
    page.heading("Measured less predicted");
    page.rows("Each channel, in its own unit", &found.channels, &brief_channels(&found.replay));
    let rover = &scenario.value.rover;
    for (title, prediction) in [
        ("At the attitude and wheel speeds that were read", Prediction::Prescribed),
        ("Run freely from the first pose", Prediction::FreeRun),
    ] {
        page.heading(title);
        let charts = charts(found, rover, prediction);
        page.charts(charts.iter().flatten());
    }
    let first = |it: &Channel| *it == it.of_first_wheel();
    let channels = Channel::all(rover.wheel_count()).into_iter().filter(first);
    let of_channels: Vec<_> = channels.flat_map(|it| meanings(&columns_of(it))).collect();
    let of_columns = [meanings(&STRETCH), of_channels, meanings(&FINDINGS)];
    let of_columns: Vec<_> = of_columns.into_iter().flatten().collect();
    answer::close(page, &[], &of_columns, &basis(args, scenario))
}

/// Two charts of each channel: both sides over time, and the residual.
fn charts(found: &Found, rover: &Rover, prediction: Prediction) -> Vec<[Chart; 2]> {
    let channels = measured_channels(&found.replay, rover).into_iter().map(|(_, it)| it);
    let shown = channels.filter(|it| it.prediction() == prediction);
    shown.map(|channel| of_channel(&found.over_time, channel, rover)).collect()
}

fn of_channel(table: &Table, channel: Channel, rover: &Rover) -> [Chart; 2] {
    let (quantity, prefix) = (quantity_of(channel), prefix_of(channel, rover));
    let over = |name: &str| -> Vec<(f64, f64)> {
        table.points(TIME.name, &format!("{prefix}{name}")).collect()
    };
    let [low, _, high] = quantity.quantiles();
    let edges: Vec<_> = over(&low)
        .into_iter()
        .zip(over(&high))
        .map(|((time, low), (_, high))| (time, low, high))
        .collect();
    let mut series = Vec::new();
    if !edges.is_empty() {
        series.push(Series::band("95 %", BAND_COLOUR, edges));
    }
    series.push(Series::new("measured", Style::Line, 1, over(&quantity.measurement())));
    series.push(Series::new("predicted", Style::Dashed, 2, over(quantity.name)));
    let title = capitalised(&quantity.label());
    let title = if prefix.is_empty() {
        title
    } else {
        format!("{title}, {}", prefix.trim_end_matches('.'))
    };
    let residual = Series::new("", Style::Line, 1, over(&quantity.residual()));
    [
        Chart::new(title.clone(), (axis(TIME), axis(quantity)), series),
        Chart::new(
            format!("{title}: measured less predicted"),
            (axis(TIME), axis(quantity)),
            vec![residual],
        ),
    ]
}

fn basis(args: &ReplayArgs, scenario: &LoadedScenario) -> Basis {
    let slope = args.slope_deg.as_ref().map_or(String::new(), |it| format!(" --slope-deg={it}"));
    let samples = sampling::flags(&args.uncertainty);
    let repeat = format!("grouser replay log.csv --scenario scenario.toml{slope}{samples}");
    Basis::new(repeat).with("scenario.toml", scenario)
}
