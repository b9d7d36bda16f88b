//! What is drawn of a curve that swings faster than can be seen: its envelope, between the least and
//! the largest of each column, with the mean; drawn as it is it would be a solid block.

use crate::sheet::Place;

/// A swing that is seen, from turn to turn [mm].
const AMPLITUDE: f64 = 0.8;
/// Turns nearer to each other than so are not seen one by one [mm].
const APART: f64 = 0.6;
/// Width of a column, in which there are two turns at least [mm].
const COLUMN: f64 = 1.5;
/// As many turns as near to each other, at least: fewer are an event.
const TURNS: usize = 6;

/// A part of a curve on the page.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Part {
    /// As it is.
    Line(Vec<Place>),
    /// By columns: the lower and the upper edge, and the mean.
    Envelope { low: Vec<Place>, high: Vec<Place>, mean: Vec<Place> },
}

/// The parts of a curve through places from left to right; one that goes back is drawn as it is.
pub(super) fn parts(places: &[Place]) -> Vec<Part> {
    let goes_back = places.windows(2).any(|pair| pair[1][0] < pair[0][0]);
    let fast = if goes_back { Vec::new() } else { fast(places, &turns(places)) };
    let (mut parts, mut from) = (Vec::new(), 0);
    for [first, last] in fast {
        if first > from {
            parts.push(Part::Line(places[from..=first].to_vec()));
        }
        parts.push(envelope(&places[first..=last]));
        from = last;
    }
    if parts.is_empty() || from + 1 < places.len() {
        parts.push(Part::Line(places[from..].to_vec()));
    }
    parts
}

/// Where the curve turns up or down by more than [`AMPLITUDE`].
fn turns(places: &[Place]) -> Vec<usize> {
    let mut turns = Vec::new();
    // The extreme since the last turn, and whether it is one of going down on the page.
    let (mut extreme, mut is_down): (usize, Option<bool>) = (0, None);
    for (place, [_, y]) in places.iter().enumerate() {
        let way = y - places[extreme][1];
        match is_down {
            Some(down) if (way > 0.0) == down || way == 0.0 => extreme = place,
            _ if way.abs() < AMPLITUDE => {}
            _ => {
                turns.push(extreme);
                (extreme, is_down) = (place, Some(way > 0.0));
            }
        }
    }
    turns
}

/// The stretches in which turns follow each other too fast: the first and the last place of each.
fn fast(places: &[Place], turns: &[usize]) -> Vec<[usize; 2]> {
    let x = |turn: usize| places[turn][0];
    let runs = turns.chunk_by(|one, next| x(*next) - x(*one) < APART);
    let runs = runs.filter(|run| run.len() >= TURNS);
    let mut all: Vec<[usize; 2]> = Vec::new();
    for run in runs {
        let [first, last] = [run[0], run[run.len() - 1]];
        match all.last_mut() {
            // What lies between is less than a column.
            Some(before) if x(first) - x(before[1]) < COLUMN => before[1] = last,
            _ => all.push([first, last]),
        }
    }
    all
}

/// * `places`: two or more, from left to right
fn envelope(places: &[Place]) -> Part {
    let (left, right) = (places[0][0], places[places.len() - 1][0]);
    let count = ((right - left) / COLUMN).floor().max(1.0);
    let width = (right - left) / count;
    let [mut low, mut high, mut mean] = [Vec::new(), Vec::new(), Vec::new()];
    let mut rest = places;
    for column in (0_u32..).map(f64::from).take_while(|it| *it < count) {
        let end = left + (column + 1.0) * width;
        let is_last = column + 1.0 >= count;
        let within = if is_last { rest.len() } else { rest.partition_point(|at| at[0] < end) };
        // Neighbouring columns share the place between them.
        let own = &rest[..within];
        rest = &rest[within.saturating_sub(1)..];
        let Some(of) = Column::of(own) else { continue };
        let edges = if column == 0.0 { vec![left, end] } else { vec![end - 0.5 * width, end] };
        let edges = if is_last || column == 0.0 { edges } else { vec![end - 0.5 * width] };
        for x in edges {
            low.push([x, of.bottom]);
            high.push([x, of.top]);
            mean.push([x, of.mean]);
        }
    }
    Part::Envelope { low, high, mean }
}

/// What a column has, downwards on the page [mm].
struct Column {
    top: f64,
    bottom: f64,
    mean: f64,
}

impl Column {
    fn of(places: &[Place]) -> Option<Self> {
        let first = places.first()?;
        let heights = places.iter().map(|at| at[1]);
        let (top, bottom) = heights
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
        let pairs = places.windows(2);
        let area: f64 =
            pairs.map(|pair| (pair[1][0] - pair[0][0]) * 0.5 * (pair[0][1] + pair[1][1])).sum();
        let width = places[places.len() - 1][0] - first[0];
        let mean = if width > 0.0 { area / width } else { first[1] };
        Some(Self { top, bottom, mean })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A curve 100 mm long, a tenth of a millimetre from place to place.
    fn curve(y: impl Fn(f64) -> f64) -> Vec<Place> {
        (0..=1000).map(|step| [0.1 * f64::from(step), y(0.1 * f64::from(step))]).collect()
    }

    /// Every 0.2 mm up or down between 20 and 30 mm, a third of the time up.
    #[test]
    fn a_curve_that_switches_fast_is_its_envelope_with_the_mean() {
        let places = curve(|x| if (x / 0.1).round() % 3.0 == 0.0 { 30.0 } else { 20.0 });
        let parts = parts(&places);
        // What comes after the last turn is a line.
        let [Part::Envelope { low, high, mean }, Part::Line(end)] = &parts[..] else {
            panic!("{parts:?}")
        };
        assert!(end.len() == 2 && end[0][0] == low[low.len() - 1][0], "{end:?}");
        assert!(low.iter().all(|at| at[1] == 30.0) && high.iter().all(|at| at[1] == 20.0));
        assert!(mean.iter().all(|at| (at[1] - 23.3).abs() < 0.6), "{mean:?}");
        assert!(low.len() < 80 && low[0][0] == 0.0 && low[low.len() - 1][0] > 99.0, "{low:?}");
    }

    #[test]
    fn slow_curves_and_noise_below_what_is_seen_are_drawn_as_they_are() {
        for y in [|x: f64| 20.0 + 5.0 * (0.5 * x).sin(), |x: f64| 0.3 * (40.0 * x).sin(), |_| 1.0] {
            let places = curve(y);
            assert_eq!(parts(&places), [Part::Line(places.clone())]);
        }
        let back = [[0.0, 1.0], [5.0, 2.0], [3.0, 1.0]];
        assert_eq!(parts(&back), [Part::Line(back.to_vec())]);
        assert_eq!(parts(&[[1.0, 2.0]]), [Part::Line(vec![[1.0, 2.0]])]);
    }

    /// Calm, then fast from 40 to 60 mm, then calm: the parts meet.
    #[test]
    fn only_the_fast_stretch_is_an_envelope() {
        let is_fast = |x: f64| (40.0..60.0).contains(&x);
        let places =
            curve(|x| if is_fast(x) && (x / 0.1).round() % 2.0 == 0.0 { 30.0 } else { 20.0 });
        let parts = parts(&places);
        let [Part::Line(before), Part::Envelope { low, .. }, Part::Line(after)] = &parts[..] else {
            panic!("{} parts", parts.len())
        };
        assert!((before[before.len() - 1][0] - low[0][0]).abs() < 1e-9);
        assert!((low[0][0] - 40.0).abs() < 0.2 && (after[0][0] - 60.0).abs() < 0.2);
    }
}
