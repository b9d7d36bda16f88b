//! The table of the card: a row for each slope, a column for each thing that a driver sets, reads
//! or may not exceed.

use grouser::document::columns::card::{
    CORRECT_EVERY, DRIVEN_DRIFT, PITCH_ENDS, RIM_WAY, SLIP_LIMIT, TIPPING_MARGIN,
};
use grouser::document::columns::{CURRENT, Quantity, ROLL, SINKAGE, TORQUE};
use grouser::document::reading::four_digits;
use grouser_draw::{Anchor, BLACK, Face, Shape, Sheet, Stroke, WHITE};

use super::layout::{LEFT, RIGHT, fitting, shown};
use super::row::{CardRow, in_steps, upwards};
use super::texts::Texts;

/// Rows on the page.
pub(super) struct Table<'a> {
    /// Where the first one begins [mm].
    pub(super) top: f64,
    /// Height of each [mm].
    pub(super) height: f64,
    pub(super) rows: &'a [CardRow<'a>],
}

impl Table<'_> {
    pub(super) fn bottom(&self) -> f64 {
        self.top + self.height * self.rows.len() as f64
    }
}

/// Height of the head above the rows [mm].
pub(super) const HEAD: f64 = 16.0;

/// Right edges of the first columns [mm].
const STRIP: f64 = 19.0;
const SLOPE: f64 = 35.0;
const HEADING: f64 = 59.0;
const RANGE: f64 = 80.0;
/// Edges of the readings at which to stop [mm].
const STOP: [f64; 2] = [121.0, 173.0];

/// A column of small numbers.
#[derive(Clone, Copy)]
struct Small {
    /// Two lines of head, and the unit.
    head: [&'static str; 3],
    /// Its right edge [mm].
    right: f64,
    text: fn(CardRow<'_>) -> Option<String>,
}

const SMALL: [Small; 9] = [
    Small {
        head: ["roll", "reads", "°"],
        right: 90.0,
        text: |row| Some(in_steps(row.number(ROLL)?, 1.0)),
    },
    Small {
        head: ["pitch", "reads", "°"],
        right: 107.0,
        text: |row| {
            let [least, most] = PITCH_ENDS.map(|end| row.number(end));
            let [least, most] = [in_steps(least?, 0.5), in_steps(most?, 0.5)];
            Some(if least == most { least } else { format!("{least} to {most}") })
        },
    },
    Small {
        head: ["correct", "every", "m"],
        right: STOP[0],
        text: |row| {
            let itself = || row.number(SLIP_LIMIT).map(|_| "itself".to_owned());
            row.number(CORRECT_EVERY).map(four_digits).or_else(itself)
        },
    },
    Small {
        head: ["", "slip", "%"],
        right: 133.0,
        text: |row| Some(upwards(row.number(SLIP_LIMIT)? * 100.0, 1)),
    },
    Small {
        head: ["", "drift", "cm/m"],
        right: 146.0,
        text: |row| {
            /// Straight downhill is no reading to wait for [-].
            const ANY: f64 = 1.0;
            let drift = high(row, DRIVEN_DRIFT)?;
            Some(if drift < ANY { upwards((drift * 100.0).max(1.0), 1) } else { "–".to_owned() })
        },
    },
    Small {
        head: ["", "sinkage", "mm"],
        right: 159.5,
        text: |row| Some(upwards(high(row, SINKAGE)?, 1)),
    },
    Small {
        head: ["", "torque", "N·m"],
        right: STOP[1],
        text: |row| Some(upwards(high(row, TORQUE)?, 2)),
    },
    Small {
        head: ["wheel", "way", "m/m"],
        right: 186.5,
        text: |row| {
            let [_, median, _] = row.band(RIM_WAY);
            Some(format!("{:.1}", median?))
        },
    },
    Small {
        head: ["tips over", "at", "° more"],
        right: RIGHT,
        text: |row| Some(format!("{}", row.number(TIPPING_MARGIN)?.floor())),
    },
];

/// In place of the torque where motors are known: what a driver reads.
const OF_MOTOR: Small = Small {
    head: ["", "current", "A"],
    right: STOP[1],
    text: |row| Some(upwards(high(row, CURRENT)?, 2)),
};

/// The columns of small numbers on a card.
fn small_columns(rows: &[CardRow<'_>]) -> [Small; 9] {
    let has_current = rows.iter().any(|row| high(*row, CURRENT).is_some());
    SMALL.map(|column| {
        let [_, what, _] = column.head;
        if has_current && what == "torque" { OF_MOTOR } else { column }
    })
}

fn high(row: CardRow<'_>, quantity: Quantity) -> Option<f64> {
    let [_, _, high] = row.band(quantity);
    high
}

/// Draws the table with its head.
pub(super) fn draw(sheet: &mut Sheet, texts: &Texts, table: &Table<'_>) {
    verdicts(sheet, table);
    heads(sheet, texts, table);
    for (place, row) in table.rows.iter().enumerate() {
        line(sheet, table, (place, *row));
    }
    frame(sheet, table);
}

/// The strip on the left: white to go, hatched for caution, densely where nobody can tell.
fn verdicts(sheet: &mut Sheet, table: &Table<'_>) {
    let mut first = 0;
    for rows in table.rows.chunk_by(|one, other| one.verdict() == other.verdict()) {
        let (word, hatch) = match rows[0].verdict() {
            "go" => ("GO", None),
            "caution" => ("CAUTION", Some(2.4)),
            _ => ("CANNOT TELL", Some(1.2)),
        };
        let (top, height) =
            (table.top + table.height * first as f64, table.height * rows.len() as f64);
        first += rows.len();
        let (corner, size) = ([LEFT, top], [STRIP - LEFT, height]);
        if let Some(distance) = hatch {
            sheet.hatch(corner, size, distance, Stroke::black(0.45));
        }
        sheet.draw(Shape::rectangle(corner, size, WHITE).outlined(Stroke::black(0.6)).unfilled());
        let text = strip_word(word, height);
        let is_wide = height < LOW_STRIP && text.width() > STRIP - LEFT - 1.0;
        if is_wide && word != "GO" {
            let parts = if word == "CAUTION" { ["CAU-", "TION"] } else { ["CANNOT", "TELL"] };
            broken(sheet, parts, [f64::midpoint(LEFT, STRIP), top + height / 2.0]);
            continue;
        }
        let (middle, half) = ([f64::midpoint(LEFT, STRIP), top + height / 2.0], text.width() / 2.0);
        if height >= LOW_STRIP {
            let (corner, size) =
                ([middle[0] - 3.3, middle[1] - half - 1.2], [6.6, 2.0 * half + 2.4]);
            sheet.draw(Shape::rectangle(corner, size, WHITE));
            sheet.text(text.upright(), [middle[0] + 2.2, middle[1]]);
        } else {
            let (corner, size) =
                ([middle[0] - half - 0.4, middle[1] - 1.7], [2.0 * half + 0.8, 3.4]);
            sheet.draw(Shape::rectangle(corner, size, WHITE));
            sheet.text(text, [middle[0], middle[1] + 0.9]);
        }
    }
}

/// A strip that is lower has its word along the row [mm].
const LOW_STRIP: f64 = 14.0;

/// A word on two lines about a place, on white.
fn broken(sheet: &mut Sheet, parts: [&str; 2], [x, y]: [f64; 2]) {
    let size = super::layout::LEAST_SIZE;
    let texts = parts.map(|part| shown(part, size).face(Face::Bold).anchor(Anchor::Middle));
    let half = texts.iter().map(|text| text.width() / 2.0).fold(0.0, f64::max) + 0.4;
    sheet.draw(Shape::rectangle([x - half, y - size], [2.0 * half, 2.0 * size], WHITE));
    let [above, below] = texts;
    sheet.text(above, [x, y - 0.2]);
    sheet.text(below, [x, y + size - 0.4]);
}

fn strip_word(word: &str, height: f64) -> grouser_draw::Text {
    let size = if height >= LOW_STRIP {
        fitting(word, 6.4, height - 3.0)
    } else {
        fitting(word, 3.4, STRIP - LEFT - 1.0)
    };
    shown(word, size.max(super::layout::LEAST_SIZE)).face(Face::Bold).anchor(Anchor::Middle)
}

fn heads(sheet: &mut Sheet, texts: &Texts, table: &Table<'_>) {
    let y = table.top - 2.0;
    let bold = |text: &str, size: f64| shown(text, size).face(Face::Bold).anchor(Anchor::Middle);
    sheet.text(bold("SLOPE", 4.2), [f64::midpoint(STRIP, SLOPE), y - 0.6]);
    let black = |sheet: &mut Sheet, [left, right]: [f64; 2], height: f64| {
        let corner = [left, table.top - HEAD + 1.0];
        sheet.draw(Shape::rectangle(corner, [right - left, height], BLACK));
    };
    black(sheet, [SLOPE, HEADING], HEAD - 1.0);
    let middle = f64::midpoint(SLOPE, HEADING);
    sheet.text(bold("TURN NOSE", 3.8).colour(WHITE), [middle, y - 6.6]);
    sheet.text(bold("UPHILL BY", 3.8).colour(WHITE), [middle, y - 1.4]);
    let middle = f64::midpoint(HEADING, RANGE);
    let range =
        if texts.has_bands { ["95 % of", "samples", "°"] } else { ["no band", "stated", ""] };
    black(sheet, STOP, 5.0);
    let stop = if texts.has_bands { "STOP IF ABOVE" } else { "EXPECTED" };
    let at = [STOP[0].midpoint(STOP[1]), table.top - HEAD + 4.8];
    sheet.text(bold(stop, 3.4).colour(WHITE), at);
    three(sheet, range, middle, y);
    let mut left = RANGE;
    for column in small_columns(table.rows) {
        three(sheet, column.head, left.midpoint(column.right), y);
        left = column.right;
    }
}

/// Two lines of head and the unit.
fn three(sheet: &mut Sheet, lines: [&str; 3], middle: f64, y: f64) {
    let styles = [(7.4, Face::Bold), (3.7, Face::Bold), (0.0, Face::Regular)];
    for (text, (rise, face)) in lines.iter().zip(styles).filter(|(text, _)| !text.is_empty()) {
        sheet.text(shown(text, 2.8).face(face).anchor(Anchor::Middle), [middle, y - rise]);
    }
}

/// One row of numbers.
fn line(sheet: &mut Sheet, table: &Table<'_>, (place, row): (usize, CardRow<'_>)) {
    let large = (table.height * 0.98).min(7.4);
    // Half the height of a digit is 0.365 of the font's. Smaller numbers stand on the same line, so
    // that a row is one line of text for those who copy it, too.
    let line = table.top + table.height * (place as f64 + 0.5) + 0.365 * large;
    let at = |x: f64| [x, line];
    let bold = |text: String, size: f64| shown(text, size).face(Face::Bold).anchor(Anchor::End);
    sheet.text(bold(format!("{}°", row.slope()), large), at(SLOPE - 2.0));
    if let Some(heading) = row.heading() {
        let text = format!("{}°", in_steps(heading, row.heading_step()));
        sheet.text(bold(text, large), at(HEADING - 4.0));
    }
    let small = (table.height * 0.62).min(3.9);
    let middle = |text: String, size: f64| shown(text, size).anchor(Anchor::Middle);
    if let Some(text) = row.heading_range() {
        let size = fitting(&text, small, RANGE - HEADING - 1.5);
        sheet.text(middle(text, size), at(f64::midpoint(HEADING, RANGE)));
    }
    let mut left = RANGE;
    for column in small_columns(table.rows) {
        if let Some(text) = (column.text)(row) {
            let size = fitting(&text, small, column.right - left - 1.0);
            sheet.text(middle(text, size), at(left.midpoint(column.right)));
        }
        left = column.right;
    }
}

/// Lines between the rows, and between the groups of columns.
fn frame(sheet: &mut Sheet, table: &Table<'_>) {
    for place in 1..=table.rows.len() {
        let y = table.top + table.height * place as f64;
        sheet.draw(Shape::line([[STRIP, y], [RIGHT, y]], Stroke::grey(0.15, 0.5)));
    }
    sheet.draw(Shape::line([[LEFT, table.top], [RIGHT, table.top]], Stroke::black(0.45)));
    let light = |x: &f64| (*x, Stroke::grey(0.15, 0.5));
    let edges = SMALL.map(|column| column.right);
    let inner = edges[..edges.len() - 1].iter().chain([&RANGE]).map(light);
    let heavy = [SLOPE, HEADING, STOP[0], STOP[1]].map(|x| (x, Stroke::black(0.8)));
    for (x, stroke) in inner.chain(heavy) {
        sheet.draw(Shape::line([[x, table.top], [x, table.bottom()]], stroke));
    }
}
