//! The layout of the card.
//!
//! One row for a degree: the eye finds the slope on the left, reads the heading in the largest
//! digits of the page beside it, and goes on to the charts, whose axes run across the same rows. What
//! must not be driven has no row, but a black bar.
//!
//! The page is A4; what is on it fits into the margins of a letter page as well.

use grouser::document::columns::card::MeasuredYaw;
use grouser::document::{escape, table};
use grouser_page::{Anchor, BLACK, Face, Place, Shape, Sheet, Stroke, Text, WHITE, width, wrap};

use super::columns::{self, Table};
use super::row::CardRow;
use super::texts::Texts;

/// Size of the page, and the box that everything stands in [mm].
const PAGE: [f64; 2] = [210.0, 297.0];
pub(super) const LEFT: f64 = 10.0;
pub(super) const RIGHT: f64 = 200.0;
const TOP: f64 = 17.0;
const BOTTOM: f64 = 280.0;

/// Where the table begins, its header included, and where it ends at the latest [mm].
const TABLE_TOP: f64 = 59.0;
const TABLE_BOTTOM: f64 = 212.0;
const HEADER: f64 = 16.0;
/// Below the rows: numbers of the axes, then the bar of what is not to be driven [mm].
const AXES: f64 = 4.2;
const BAR: f64 = 10.0;
/// The highest row [mm].
const HIGHEST_ROW: f64 = 7.4;

/// Draws the card.
pub(super) fn draw(texts: &Texts, card: &table::Table, measured: &[MeasuredYaw]) -> Sheet {
    let title = format!("Operator's card: {}", texts.title);
    let mut sheet = Sheet::new(&escape::line(&title), PAGE[0], PAGE[1]);
    head(&mut sheet, texts);
    pictogram(&mut sheet, [167.0, 45.0]);
    // Level ground needs no card, and slopes between whole degrees were asked for elsewhere.
    let whole = |row: &CardRow<'_>| row.slope() >= 1.0 && row.slope().fract() == 0.0;
    let driven: Vec<CardRow<'_>> =
        CardRow::all(card).filter(whole).filter(|row| !row.is_no_go()).collect();
    let room = TABLE_BOTTOM - TABLE_TOP - HEADER - AXES - BAR;
    let height = (room / driven.len().max(1) as f64).min(HIGHEST_ROW);
    let table = Table { top: TABLE_TOP + HEADER, height, rows: &driven };
    columns::draw(&mut sheet, texts, &table, measured);
    let end = table.top + height * driven.len() as f64 + AXES;
    let first = CardRow::all(card).find(|row| row.is_no_go() && row.slope().fract() == 0.0);
    if let Some(first) = first {
        bar(&mut sheet, end, first.slope());
    }
    foot(&mut sheet, texts, end + BAR + 4.5);
    sheet
}

fn head(sheet: &mut Sheet, texts: &Texts) {
    /// Room beside the picture [mm].
    const ROOM: f64 = 138.0;
    let size = fitting(&texts.title, 8.6, RIGHT - LEFT);
    sheet.text(shown(&texts.title, size).face(Face::Bold), [LEFT, TOP + 7.0]);
    sheet.text(
        shown("OPERATOR'S CARD: how to cross a slope without drifting down", 4.6).face(Face::Bold),
        [LEFT, TOP + 14.5],
    );
    let steps = [
        "1  Find the slope in the left column.".to_owned(),
        "2  Turn the nose uphill by the large number beside it.".to_owned(),
        "3  Drive on: it goes straight across the slope, neither up nor down.".to_owned(),
        texts.side.to_owned(),
        texts.setting.clone(),
    ];
    for (index, step) in steps.iter().enumerate() {
        let size = fitting(step, 4.0, ROOM);
        sheet.text(shown(step, size), [LEFT, TOP + 21.0 + 5.0 * index as f64]);
    }
}

/// A line of text from anywhere, its hidden characters written out.
pub(super) fn shown(content: impl AsRef<str>, size: f64) -> Text {
    Text::new(escape::line(content.as_ref()), size)
}

/// The largest size at which a text fits [mm], up to one.
pub(super) fn fitting(text: &str, most: f64, room: f64) -> f64 {
    most.min(most * room / width(text, Face::Bold, most).max(f64::MIN_POSITIVE))
}

/// A rover from above, its nose turned uphill of the way it goes.
fn pictogram(sheet: &mut Sheet, centre: Place) {
    let heading = 20.0_f64.to_radians();
    let (sin, cos) = heading.sin_cos();
    let at = |forward: f64, left: f64| {
        [centre[0] + forward * cos - left * sin, centre[1] - forward * sin - left * cos]
    };
    // The contour, and the way along it.
    let line = |ends: [Place; 2], stroke: Stroke| Shape::line(ends, stroke);
    let (from, to) = ([centre[0] - 15.0, centre[1]], [centre[0] + 24.0, centre[1]]);
    sheet.draw(line([from, to], Stroke::black(0.5).dashed(1.6, 1.0)));
    sheet.draw(arrow_head([to[0] + 3.5, to[1]], [1.0, 0.0], 3.5));
    let travel = shown("travel", 3.2).anchor(Anchor::End);
    sheet.text(travel, [to[0] + 2.0, to[1] + 4.4]);
    // Body and wheels.
    let corners = |x: f64, y: f64, length: f64, width: f64| {
        let (a, b) = (length / 2.0, width / 2.0);
        [at(x + a, y + b), at(x + a, y - b), at(x - a, y - b), at(x - a, y + b)]
    };
    sheet.draw(Shape::area(corners(0.0, 0.0, 13.0, 6.5), WHITE).outlined(Stroke::black(0.5)));
    for (x, y) in [(4.5, 4.8), (4.5, -4.8), (-4.5, 4.8), (-4.5, -4.8)] {
        sheet.draw(Shape::area(corners(x, y, 4.6, 2.0), BLACK));
    }
    // The nose, and the angle that is asked for.
    sheet.draw(line([at(2.0, 0.0), at(18.0, 0.0)], Stroke::black(0.8)));
    let tip = at(21.5, 0.0);
    sheet.draw(arrow_head(tip, [cos, -sin], 3.5));
    sheet.text(
        shown("nose", 3.2).face(Face::Bold).anchor(Anchor::End),
        [tip[0] - 2.0, tip[1] - 1.0],
    );
    let arc = (0..=10).map(|step| {
        let angle = heading * f64::from(step) / 10.0;
        [centre[0] + 16.0 * angle.cos(), centre[1] - 16.0 * angle.sin()]
    });
    sheet.draw(Shape::line(arc, Stroke::black(0.5)));
    // Uphill.
    let foot = [centre[0] - 19.0, centre[1] + 8.0];
    let top = [foot[0], foot[1] - 14.0];
    sheet.draw(line([foot, top], Stroke::black(0.9)));
    sheet.draw(arrow_head([top[0], top[1] - 3.8], [0.0, -1.0], 3.8));
    sheet.text(shown("UPHILL", 3.2).face(Face::Bold).upright(), [foot[0] - 1.6, foot[1]]);
}

/// An arrow's head.
///
/// * `way`: unit vector that it points along
fn arrow_head(tip: Place, way: Place, length: f64) -> Shape {
    let back = [tip[0] - way[0] * length, tip[1] - way[1] * length];
    let aside = [way[1] * length * 0.42, -way[0] * length * 0.42];
    let ends =
        [tip, [back[0] + aside[0], back[1] + aside[1]], [back[0] - aside[0], back[1] - aside[1]]];
    Shape::area(ends, BLACK)
}

/// A black bar for the no-go slopes.
fn bar(sheet: &mut Sheet, top: f64, from_deg: f64) {
    sheet.draw(Shape::rectangle([LEFT, top], [RIGHT - LEFT, BAR], BLACK));
    let text = match from_deg {
        0.0 => "NO-GO   on any slope".to_owned(),
        _ => format!("NO-GO   {from_deg}° and steeper"),
    };
    sheet.text(shown(text, 7.0).face(Face::Bold).grey(WHITE), [LEFT + 3.0, top + 7.5]);
    let what = "no heading: do not cross";
    sheet.text(shown(what, 4.2).grey(WHITE).anchor(Anchor::End), [RIGHT - 3.0, top + 6.6]);
}

/// Rule, facts and assumptions, as large as they fit.
fn foot(sheet: &mut Sheet, texts: &Texts, top: f64) {
    /// Size of the rule [mm], which is read more often than the rest.
    const RULE: f64 = 3.3;
    /// Sizes that are tried for the rest [mm]; the smallest is that of a footnote.
    const SIZES: [f64; 8] = [3.0, 2.8, 2.65, 2.5, 2.35, 2.2, 2.1, 2.0];
    let rules: Vec<(&str, &str)> = texts.rule.iter().map(|(name, text)| (*name, &**text)).collect();
    let top = paragraphs(sheet, &rules, [LEFT, RIGHT], RULE, top) + 1.0;
    let fits = |size: &f64| {
        below(&mut Sheet::new("", PAGE[0], PAGE[1]), texts, *size, usize::MAX, top) <= BOTTOM
    };
    let smallest = SIZES[SIZES.len() - 1];
    let size = SIZES.into_iter().find(fits).unwrap_or(smallest);
    let most = (0..=texts.assumed.len()).rev().find(|most| {
        below(&mut Sheet::new("", PAGE[0], PAGE[1]), texts, size, *most, top) <= BOTTOM
    });
    below(sheet, texts, size, most.unwrap_or(0), top);
}

/// What stands below the rule; where it ends [mm].
///
/// * `most`: how many assumptions there is room for
fn below(sheet: &mut Sheet, texts: &Texts, size: f64, most: usize, top: f64) -> f64 {
    const GAP: f64 = 4.0;
    let middle = f64::midpoint(LEFT, RIGHT);
    let facts: Vec<(&str, &str)> =
        texts.facts.iter().map(|(name, text)| (*name, &**text)).collect();
    let (left, right) = facts.split_at(facts.len().div_ceil(2));
    let ends = [
        paragraphs(sheet, left, [LEFT, middle - GAP / 2.0], size, top),
        paragraphs(sheet, right, [middle + GAP / 2.0, RIGHT], size, top),
    ];
    let mut assumed =
        texts.assumed.iter().take(most).cloned().collect::<Vec<String>>().join("  ·  ");
    if let Some(more @ 1..) = texts.assumed.len().checked_sub(most) {
        assumed = format!("{assumed}  ·  and {more} more, in the documents");
    }
    let mut rest = vec![("Holds for", &*texts.holds_for), ("Leaves out", &*texts.leaves_out)];
    if !assumed.is_empty() {
        rest.push(("Assumed", &assumed));
    }
    paragraphs(sheet, &rest, [LEFT, RIGHT], size, ends[0].max(ends[1]))
}

/// Named paragraphs below each other; where they end [mm].
fn paragraphs(
    sheet: &mut Sheet,
    all: &[(&str, &str)],
    [left, right]: [f64; 2],
    size: f64,
    top: f64,
) -> f64 {
    /// From line to line, over the height of the font [-].
    const LEADING: f64 = 1.22;
    let names = all.iter().map(|(name, _)| width(name, Face::Bold, size));
    let indent = left + names.fold(0.0, f64::max) + size;
    let mut y = top;
    for (name, text) in all {
        sheet.text(shown(name, size).face(Face::Bold), [left, y]);
        for line in wrap(text, Face::Regular, size, right - indent) {
            sheet.text(shown(line, size), [indent, y]);
            y += size * LEADING;
        }
    }
    y
}
