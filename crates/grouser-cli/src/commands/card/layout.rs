//! The layout of the card's first page.
//!
//! A row for each degree, or for every second one: the eye finds the slope on the left, reads the
//! heading in the largest digits of the page beside it, and goes on to what instruments show and
//! where to stop. What must not be driven has no row, but a black bar.
//!
//! The page is A4; what is on it fits into the margins of a letter page as well.

use grouser::document::{escape, table};
use grouser_draw::{Anchor, BLACK, Face, Shape, Sheet, Stroke, Text, WHITE, width, wrap};

use super::columns::{self, Table};
use super::picture::Picture;
use super::row::CardRow;
use super::texts::{Date, Texts};

/// Size of the page, and the box that everything stands in [mm].
pub(super) const PAGE: [f64; 2] = [210.0, 297.0];
pub(super) const LEFT: f64 = 10.0;
pub(super) const RIGHT: f64 = 200.0;
pub(super) const TOP: f64 = 17.0;
const BOTTOM: f64 = 280.0;

/// No letter is smaller [mm]: 7 points.
pub(super) const LEAST_SIZE: f64 = 2.47;

/// Where the table begins, its header included, and where it ends at the latest [mm].
const TABLE_TOP: f64 = 64.0;
const TABLE_BOTTOM: f64 = 194.0;
/// Height of the bar of what is not to be driven [mm].
pub(super) const BAR: f64 = 8.5;
/// The highest row [mm].
const HIGHEST_ROW: f64 = 7.2;
/// Rows that fit at arm's length.
const MOST_ROWS: usize = 16;
/// Where the blanks to fill in stand [mm].
pub(super) const BLANKS: f64 = BOTTOM;
/// From the bar to the first line below it [mm].
const BELOW_BAR: f64 = 4.0;
/// Sizes of what stands below the table that are tried [mm].
const FOOT_SIZES: [f64; 6] = [3.2, 3.0, 2.8, 2.7, 2.6, 2.5];
/// Where that ends at the latest [mm].
const FOOT_END: f64 = BLANKS - 3.5;

/// Draws the card.
pub(super) fn draw(texts: &Texts, picture: &Picture, card: &table::Table) -> Sheet {
    let title = format!("Operator's card: {}", texts.title);
    let mut sheet = Sheet::new(&escape::line(&title), PAGE[0], PAGE[1]);
    head(&mut sheet, texts);
    picture.draw(&mut sheet, [167.0, 48.0]);
    let rows = shown_rows(card);
    let bottom = TABLE_BOTTOM.min(FOOT_END - least_foot(texts) - BELOW_BAR);
    let room = bottom - TABLE_TOP - columns::HEAD - BAR;
    let height = (room / rows.len().max(1) as f64).min(HIGHEST_ROW);
    let table = Table { top: TABLE_TOP + columns::HEAD, height, rows: &rows };
    columns::draw(&mut sheet, texts, &table);
    let end = table.bottom() + 1.0;
    let first = CardRow::all(card).find(|row| row.is_no_go() && row.slope().fract() == 0.0);
    if let Some(first) = first {
        bar(&mut sheet, end, first.slope());
    }
    foot(&mut sheet, texts, end + BAR + BELOW_BAR);
    blanks(&mut sheet);
    sheet
}

/// The slopes of whole degrees that are driven, or every second of them, third and so on where
/// there are many. Level ground needs no card, and slopes between whole degrees were asked for
/// elsewhere.
pub(super) fn shown_rows(card: &table::Table) -> Vec<CardRow<'_>> {
    let whole = |row: &CardRow<'_>| row.slope() >= 1.0 && row.slope().fract() == 0.0;
    let driven: Vec<CardRow<'_>> =
        CardRow::all(card).take_while(|row| !row.is_no_go()).filter(whole).collect();
    let step = driven.len().div_ceil(MOST_ROWS).max(1) as f64;
    driven.into_iter().filter(|row| row.slope() % step == 0.0).collect()
}

/// The slopes of the page [°].
pub(super) fn slopes(card: &table::Table) -> Vec<f64> {
    shown_rows(card).into_iter().map(CardRow::slope).collect()
}

fn head(sheet: &mut Sheet, texts: &Texts) {
    /// Room beside the picture [mm].
    const ROOM: f64 = 126.0;
    titles(sheet, texts, "OPERATOR'S CARD: how to cross a slope without drifting down", 1);
    let y = lines(sheet, &texts.steps, TOP + 18.5, ROOM);
    let after = date(sheet, &texts.date, y + 1.5);
    let size = fitting(&texts.setting, 3.6, ROOM + LEFT - after);
    sheet.text(shown(&texts.setting, size), [after, y + 1.5]);
}

/// Lines of one size, below each other; where they end [mm].
pub(super) fn lines(sheet: &mut Sheet, all: &[impl AsRef<str>], top: f64, room: f64) -> f64 {
    let fits = |line: &str| fitting(line, 4.0, room);
    let size = all.iter().map(|line| fits(line.as_ref())).fold(f64::INFINITY, f64::min);
    let mut y = top;
    for line in all {
        sheet.text(shown(line, size), [LEFT, y]);
        y += 5.0;
    }
    y
}

/// What the card is of, what the page is about, and which of the two it is.
pub(super) fn titles(sheet: &mut Sheet, texts: &Texts, about: &str, page: u8) {
    let size = fitting(&texts.title, 8.0, RIGHT - LEFT).max(LEAST_SIZE);
    let title = shortened(&texts.title, size, RIGHT - LEFT);
    sheet.text(shown(title, size).face(Face::Bold), [LEFT, TOP + 6.0]);
    sheet.text(shown(about, 4.4).face(Face::Bold), [LEFT, TOP + 12.5]);
    let place = shown(format!("page {page} of 2"), 3.0).anchor(Anchor::End);
    sheet.text(place, [RIGHT, TOP - 1.0]);
}

/// The day of the soil, loud where it is not known; where it ends [mm].
pub(super) fn date(sheet: &mut Sheet, date: &Date, y: f64) -> f64 {
    let text = match date {
        Date::Stated(date) => shown(format!("Date of the soil: {date}"), 3.6).face(Face::Bold),
        Date::NotStated => {
            shown("DATE OF THE SOIL: NOT STATED", 3.6).face(Face::Bold).colour(WHITE)
        }
    };
    let width = text.width();
    let margin = if matches!(date, Date::NotStated) { 1.5 } else { 0.0 };
    if margin > 0.0 {
        sheet.draw(Shape::rectangle([LEFT, y - 3.9], [width + 2.0 * margin, 5.2], BLACK));
    }
    sheet.text(text, [LEFT + margin, y]);
    LEFT + width + 2.0 * margin + 3.0
}

/// What is filled in by hand.
pub(super) fn blanks(sheet: &mut Sheet) {
    let mut x = LEFT;
    for (name, end) in
        [("Card no.", 46.0), ("Date", 80.0), ("Signature", 142.0), ("Superseded by", RIGHT)]
    {
        let text = shown(name, 3.0).face(Face::Bold);
        let from = x + text.width() + 1.5;
        sheet.text(text, [x, BLANKS]);
        sheet.draw(Shape::line([[from, BLANKS + 0.6], [end, BLANKS + 0.6]], Stroke::black(0.3)));
        x = end + 3.0;
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

/// The part of a text that fits at a size [mm].
pub(super) fn shortened(text: &str, size: f64, room: f64) -> String {
    let fits = |text: &str| width(text, Face::Bold, size) <= room;
    if fits(&escape::line(text)) {
        return text.to_owned();
    }
    let ends = text.char_indices().map(|(place, _)| format!("{}…", &text[..place]));
    ends.take_while(|part| fits(&escape::line(part))).last().unwrap_or_default()
}

/// A black bar for the no-go slopes.
pub(super) fn bar(sheet: &mut Sheet, top: f64, from_deg: f64) {
    sheet.draw(Shape::rectangle([LEFT, top], [RIGHT - LEFT, BAR], BLACK));
    let text = match from_deg {
        0.0 => "NO-GO   on any slope".to_owned(),
        _ => format!("NO-GO   {from_deg}° and steeper"),
    };
    sheet.text(shown(text, 6.4).face(Face::Bold).colour(WHITE), [LEFT + 3.0, top + 6.6]);
    let what = "do not cross";
    sheet.text(shown(what, 4.2).colour(WHITE).anchor(Anchor::End), [RIGHT - 3.0, top + 5.8]);
}

/// Rule, facts and assumptions, as large as they fit.
fn foot(sheet: &mut Sheet, texts: &Texts, top: f64) {
    let nowhere = || Sheet::new("", PAGE[0], PAGE[1]);
    let fits = |size: &f64, most: usize| below(&mut nowhere(), texts, *size, most, top) <= FOOT_END;
    let all = FOOT_SIZES.into_iter().find(|size| fits(size, usize::MAX));
    let size = all.unwrap_or(FOOT_SIZES[5]);
    let most = (0..=texts.assumed.len()).rev().find(|most| fits(&size, *most));
    below(sheet, texts, size, most.unwrap_or(0), top);
}

/// The least height of what stands below the table: in the smallest letters, with a few of the
/// assumptions [mm].
fn least_foot(texts: &Texts) -> f64 {
    const FEW: usize = 3;
    below(&mut Sheet::new("", PAGE[0], PAGE[1]), texts, FOOT_SIZES[5], FEW, 0.0)
}

/// What stands below the table; where it ends [mm].
///
/// * `most`: how many assumptions there is room for
fn below(sheet: &mut Sheet, texts: &Texts, size: f64, most: usize, top: f64) -> f64 {
    const GAP: f64 = 4.0;
    const SPACE: f64 = 0.8;
    let middle = f64::midpoint(LEFT, RIGHT);
    let all = [LEFT, RIGHT];
    let top = paragraphs(sheet, &lines_of(&texts.legend), all, size, top) + SPACE;
    let top = paragraphs(sheet, &lines_of(&texts.rule), all, size, top) + SPACE;
    let facts = lines_of(&texts.facts);
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
    let outside = texts.outside.join("  ·  ");
    let mut rest = vec![("Holds for", &*texts.holds_for), ("Leaves out", &*texts.leaves_out)];
    if !outside.is_empty() {
        rest.push(("Outside", &outside));
    }
    if !assumed.is_empty() {
        rest.push(("Assumed", &assumed));
    }
    paragraphs(sheet, &rest, all, size, ends[0].max(ends[1]) + SPACE)
}

pub(super) fn lines_of<'a>(all: &'a [(&'static str, String)]) -> Vec<(&'a str, &'a str)> {
    all.iter().map(|(name, text)| (*name, &**text)).collect()
}

/// Named paragraphs below each other; where they end [mm].
pub(super) fn paragraphs(
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
