//! The colours of numbers beside what is drawn in them.

use super::axis::{Axis, Tick};
use super::frame::{MIDDLE, text};
use crate::scale::Scale;
use crate::sheet::{Cells, Face, Place, Sheet, width};
use crate::style::Role;

/// Width of the bar, and from it to its numbers [mm].
const BAR: f64 = 5.0;
const GAP: f64 = 1.6;
/// Shades of colours that are mixed.
const SHADES: usize = 64;
/// From number to number, at least [mm].
const APART: f64 = 12.0;

/// Numbers or words of a scale, each at its share of the bar from the bottom up.
fn labels(scale: &Scale, height: f64) -> Vec<(f64, String)> {
    let words = scale.stops().iter().filter_map(|stop| stop.word);
    let count = scale.stops().len() as f64;
    let words: Vec<(f64, String)> =
        words.enumerate().map(|(place, it)| ((place as f64 + 0.5) / count, it.into())).collect();
    if !words.is_empty() {
        return words;
    }
    let [low, high] = scale.ends();
    let ticks = if scale.is_cycle() {
        let quarter = |place: i32| low + 0.25 * f64::from(place) * (high - low);
        let label = |at: f64| at.to_string().replace('-', "−");
        (0..=4).map(quarter).map(|at| Tick { at, label: label(at) }).collect()
    } else {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few")]
        let most = (height / APART).clamp(2.0, 8.0) as usize;
        Axis::linear(Some([low, high]), most).ticks
    };
    let share = |at: f64| (at - low) / (high - low);
    // Half a shade beyond an end is the end.
    let is_on = |at: f64| (-0.01..=1.01).contains(&share(at));
    ticks.into_iter().filter(|tick| is_on(tick.at)).map(|it| (share(it.at), it.label)).collect()
}

/// Width of a bar with its numbers [mm].
pub(crate) fn colour_bar_width(scale: &Scale, height: f64, size: f64) -> f64 {
    let labels = labels(scale, height);
    let widths = labels.iter().map(|(_, label)| width(label, Face::Regular, size));
    BAR + GAP + widths.fold(0.0, f64::max)
}

/// Draws the colours of a scale with round numbers, or words, from the bottom up.
///
/// * `at`: upper left corner
/// * `height`: of the bar [mm]
/// * `size`: height of letters [mm]
pub(crate) fn colour_bar(sheet: &mut Sheet, scale: &Scale, at: Place, height: f64, size: f64) {
    let [left, top] = at;
    let [low, high] = scale.ends();
    let colours: Vec<_> = if scale.is_of_words() {
        scale.stops().iter().rev().map(|stop| Some(stop.colour)).collect()
    } else {
        let shade = |place: usize| (place as f64 + 0.5) / SHADES as f64;
        let shades = (0..SHADES).rev().map(shade);
        shades.map(|share| Some(scale.colour(low + share * (high - low)))).collect()
    };
    sheet.cells(Cells::new(at, [BAR, height], 1, colours));
    for (share, label) in labels(scale, height) {
        let y = top + height * (1.0 - share) + MIDDLE * size;
        sheet.text(text(&label, size, Role::Faint), [left + BAR + GAP, y]);
    }
}
