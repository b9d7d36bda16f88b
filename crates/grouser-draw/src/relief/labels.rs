//! Room and letters of the drawing: names of views, and numbers along axes.

use crate::sheet::{Anchor, Place};

use crate::scene::Label;
use crate::style::Role;

/// Width of the drawing [mm].
pub(super) const WIDTH: f64 = 180.0;
/// Room to the left of the columns, for numbers [mm].
pub(super) const LEFT: f64 = 16.0;
/// Room above views, for their names [mm].
pub(super) const ABOVE: f64 = 9.0;
/// Room below views, for numbers [mm].
pub(super) const BELOW: f64 = 14.0;
/// Size of letters [mm].
pub(super) const LETTERS: f64 = 3.2;

/// What a view is.
pub(super) fn name(text: impl Into<String>, x: f64, y: f64) -> Label {
    Label::new(text, [x, y], Anchor::Start)
}

/// A number of an axis [m].
pub(super) fn number(value: f64, at: Place, anchor: Anchor) -> Label {
    let shown = format!("{}", (value * 1e3).round() / 1e3 + 0.0);
    Label::new(shown, at, anchor).coloured(Role::Faint)
}

/// The whole multiples of a step within a range.
pub(super) fn multiples(step: f64, from: f64, to: f64) -> impl Iterator<Item = f64> {
    let first = (from / step).ceil();
    let numbers = std::iter::successors(Some(first), |line| Some(line + 1.0));
    numbers.map(move |line| line * step).take_while(move |at| *at <= to)
}
