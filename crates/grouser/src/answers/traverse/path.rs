//! The path of a run: where it ended, in a sentence, and a chart of it.

use crate::document::columns::YAW;
use crate::document::escape;
use crate::document::figure::{BAND_COLOUR, Chart, Series, Style};
use crate::document::reading::{capitalised, four_digits, metres};
use crate::simulation::{Scenario, Trajectory};
use crate::studies::drive::Drive;
use crate::studies::ensemble::Band;
use crate::studies::traverse_band::{TimeBand, TraverseBand};
use crate::units::Vec2;

/// Where a rover ended up, and what that took, in a sentence.
#[must_use]
pub fn sentence(scenario: &Scenario, run: &Trajectory) -> String {
    let (end, drive) = (run.last(), Drive::of(run, scenario));
    let yaw = four_digits(YAW.unit.from_si(end.state.yaw));
    let place = match end.standing() {
        Some(standing) => format!(
            "at x {} m, y {} m and a height of {} m, the nose at {yaw}° from east",
            metres(end.place().x),
            metres(end.place().y),
            metres(standing.height),
        ),
        None => on_slope(end.state.position, &yaw),
    };
    let energy = drive
        .energy_per_metre
        .map_or(String::new(), |it| format!(", {} J for each metre", four_digits(it)));
    format!(
        "{} after {} s{}: {place}. The motors did {} J{energy}.",
        capitalised(&run.outcome.kind().in_words()),
        four_digits(end.time),
        reason(run),
        four_digits(drive.energy),
    )
}

/// Where the rover is on a slope [m], and how it is turned [°].
fn on_slope(place: Vec2, yaw: &str) -> String {
    let side = if place.y < 0.0 { "below" } else { "above" };
    let (along, off) = (four_digits(place.x), four_digits(place.y.abs()));
    format!(
        "{along} m along the contour and {off} m {side} it, the nose at {yaw}° (positive uphill)"
    )
}

/// The reason of an outcome, after a colon, on one line.
#[must_use]
pub fn reason(run: &Trajectory) -> String {
    run.outcome.reason().map_or(String::new(), |reason| format!(": {}", escape::line(&reason)))
}

/// A path of a chart: its model's name, the run, and what samples make of it.
pub type Path<'r> = (&'r str, &'r Trajectory, Option<&'r TraverseBand>);

/// Some paths, seen from above, each with its band if there is one.
#[must_use]
pub fn path_chart(on_a_map: bool, all: &[Path<'_>]) -> Chart {
    let mut series = Vec::new();
    for (place, (name, _, band)) in all.iter().enumerate() {
        let Some(band) = band else { continue };
        let name = if all.len() > 1 { *name } else { "the samples" };
        let name = format!("95 % of {name}");
        let colour = if all.len() > 1 { place + 1 } else { BAND_COLOUR };
        if on_a_map {
            series.extend(spread(&band.times, name, colour));
        } else {
            series.push(Series::band(name, colour, along_contour(&band.times)));
        }
    }
    for (place, (name, run, _)) in all.iter().enumerate() {
        let points = run.records.iter().map(|record| (record.place().x, record.place().y));
        let name = if all.len() > 1 { name } else { "" };
        series.push(Series::new(name, Style::Line, place + 1, points));
    }
    if on_a_map {
        return Chart::new("Path on the map", ("east, x [m]", "north, y [m]"), series);
    }
    Chart::new("Path on the slope", ("along the contour, x [m]", "uphill, y [m]"), series)
}

/// The edges of a band beside a path along the contour: it is over one time, and drawn where the
/// rover is then, in the middle of the samples.
fn along_contour(times: &[TimeBand]) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
    times.iter().filter_map(|at| {
        let (x, y) = (at.x?, at.y?);
        Some((x.median, y.low, y.high))
    })
}

/// The places of samples on a map at a few times, as crosses: a way there goes in any direction.
fn spread(times: &[TimeBand], name: String, colour: usize) -> [Series; 2] {
    /// At most as many, besides the start.
    const CROSSES: usize = 8;
    let last = times.len() - 1;
    let count = CROSSES.min(last);
    let chosen = (0..=count).map(|cross| &times[cross * last / count.max(1)]);
    let bands: Vec<(Band, Band)> = chosen.filter_map(|at| Some((at.x?, at.y?))).collect();
    let middle = |band: &Band| 0.5 * (band.low + band.high);
    let half = |band: &Band| 0.5 * (band.high - band.low);
    let points = || bands.iter().map(|(x, y)| (middle(x), middle(y)));
    let upright = Series::new(name, Style::Dots, colour, points());
    let across = Series::new("", Style::Dots, colour, points());
    [
        upright.with_error_bars(bands.iter().map(|(_, y)| half(y))),
        across.with_bars_across(bands.iter().map(|(x, _)| half(x))),
    ]
}
