//! The table of the card: numbers, and charts whose axis of slopes is the table's rows.

use grouser::document::columns::card::{DRIFT, MeasuredYaw};
use grouser::document::columns::{POWER, PROBABILITY_LEVEL, Quantity, SLIP_RATIO, YAW};
use grouser_page::{Anchor, Face, Place, Shape, Sheet, Stroke, WHITE};

use super::layout::{LEFT, RIGHT, fitting, shown};
use super::row::CardRow;
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
    fn bottom(&self) -> f64 {
        self.top + self.height * self.rows.len() as f64
    }

    /// Middle of a row, or of where a slope between rows would be [mm].
    fn middle(&self, slope_deg: f64) -> f64 {
        let first = self.rows.first().map_or(1.0, |row| row.slope());
        self.top + self.height * (slope_deg - first + 0.5)
    }
}

/// A number with its chart.
struct Chart {
    /// Two lines of head.
    head: [&'static str; 2],
    /// Where the numbers end, and where the chart begins and ends [mm].
    numbers: Option<f64>,
    from: f64,
    to: f64,
    quantity: Quantity,
    /// Of what is shown to the quantity.
    factor: f64,
    /// Digits of the numbers, counted from the first of the axis' end.
    digits: i32,
}

/// Edges of the first columns [mm].
const STRIP: f64 = 21.0;
const SLOPE: f64 = 40.0;
const HEADING: f64 = 68.0;
const RANGE: f64 = 90.0;
const CHANCE: f64 = 187.0;

const CHARTS: [Chart; 4] = [
    Chart {
        head: ["heading", "degrees uphill"],
        numbers: None,
        from: 91.5,
        to: 112.0,
        quantity: YAW,
        factor: 1.0,
        digits: 2,
    },
    Chart {
        head: ["slip", "%"],
        numbers: Some(121.5),
        from: 122.5,
        to: 137.0,
        quantity: SLIP_RATIO,
        factor: 100.0,
        digits: 2,
    },
    Chart {
        head: ["drift, nose not", "turned: cm per m"],
        numbers: Some(146.5),
        from: 147.5,
        to: 161.5,
        quantity: DRIFT,
        factor: 100.0,
        digits: 2,
    },
    Chart {
        head: ["power", "W"],
        numbers: Some(171.0),
        from: 172.0,
        to: 186.0,
        quantity: POWER,
        factor: 1.0,
        digits: 3,
    },
];

impl Chart {
    /// Its values of a row: low, median and high, or only the middle one.
    fn values(&self, row: CardRow<'_>) -> [Option<f64>; 3] {
        row.band(self.quantity, self.factor)
    }
}

/// Draws the table with its head.
pub(super) fn draw(sheet: &mut Sheet, texts: &Texts, table: &Table<'_>, measured: &[MeasuredYaw]) {
    verdicts(sheet, table);
    heads(sheet, texts, table, !measured.is_empty());
    for chart in &CHARTS {
        axis(sheet, table, chart);
        band(sheet, table, chart);
    }
    measured_points(sheet, table, measured);
    for row in table.rows {
        line(sheet, texts, table, *row);
    }
    frame(sheet, table);
}

/// The strip on the left: white to go, hatched for caution.
fn verdicts(sheet: &mut Sheet, table: &Table<'_>) {
    for (verdict, word) in [("go", "GO"), ("caution", "CAUTION")] {
        let count = table.rows.iter().filter(|row| row.verdict() == verdict).count();
        let Some(first) = table.rows.iter().position(|row| row.verdict() == verdict) else {
            continue;
        };
        let (top, height) = (table.top + table.height * first as f64, table.height * count as f64);
        let (corner, size) = ([LEFT, top], [STRIP - LEFT, height]);
        if verdict == "caution" {
            sheet.hatch(corner, size, 2.4, Stroke::black(0.45));
        }
        sheet.draw(Shape::rectangle(corner, size, WHITE).outlined(Stroke::black(0.6)).unfilled());
        let text =
            shown(word, fitting(word, 7.0, height - 3.0)).face(Face::Bold).anchor(Anchor::Middle);
        let (middle, half) = ([f64::midpoint(LEFT, STRIP), top + height / 2.0], text.width() / 2.0);
        sheet.draw(Shape::rectangle(
            [middle[0] - 3.6, middle[1] - half - 1.2],
            [7.2, 2.0 * half + 2.4],
            WHITE,
        ));
        sheet.text(text.upright(), [middle[0] + 2.5, middle[1]]);
    }
}

fn heads(sheet: &mut Sheet, texts: &Texts, table: &Table<'_>, are_measured: bool) {
    let y = table.top - 2.0;
    let bold = |text: &str, size: f64| shown(text, size).face(Face::Bold).anchor(Anchor::Middle);
    sheet.text(bold("SLOPE", 4.4), [f64::midpoint(STRIP, SLOPE), y - 0.6]);
    let middle = f64::midpoint(SLOPE, HEADING);
    sheet.draw(Shape::rectangle([SLOPE, table.top - 15.0], [HEADING - SLOPE, 15.0], 0.0));
    sheet.text(bold("TURN NOSE", 4.2).grey(WHITE), [middle, y - 6.6]);
    sheet.text(bold("UPHILL BY", 4.2).grey(WHITE), [middle, y - 1.4]);
    let middle = f64::midpoint(HEADING, RANGE);
    let small = |text: &str| shown(text, 3.0).anchor(Anchor::Middle);
    sheet.text(small(&texts.band), [middle, y - 4.0]);
    sheet.text(small(if texts.has_bands { "need" } else { "stated" }), [middle, y]);
    for chart in &CHARTS {
        let from = chart.numbers.map_or(chart.from, |end| end - 8.5);
        let middle = from.midpoint(chart.to);
        sheet.text(small(chart.head[0]).face(Face::Bold), [middle, y - 4.0]);
        let is_marked = are_measured && chart.numbers.is_none();
        let unit = if is_marked { "°; × measured" } else { chart.head[1] };
        sheet.text(small(unit), [middle, y]);
    }
    if texts.has_bands {
        let middle = f64::midpoint(CHANCE, RIGHT);
        for (index, text) in ["part of soils", "that can be", "crossed level"].iter().enumerate() {
            let text = shown(text, 2.35).anchor(Anchor::Middle);
            sheet.text(text, [middle, y - 6.6 + 3.3 * index as f64]);
        }
    }
}

/// One row of numbers.
fn line(sheet: &mut Sheet, texts: &Texts, table: &Table<'_>, row: CardRow<'_>) {
    let large = (table.height * 0.98).min(7.6);
    // Half the height of a digit is 0.365 of the font's. Smaller numbers stand on the same line, so that a row is
    // one line of text for those who copy it, too.
    let line = table.middle(row.slope()) + 0.365 * large;
    let at = |x: f64| [x, line];
    let bold = |text: String, size: f64| shown(text, size).face(Face::Bold).anchor(Anchor::End);
    sheet.text(bold(format!("{}°", row.slope()), large), at(SLOPE - 3.0));
    let [low, heading, high] = CHARTS[0].values(row);
    if let Some(heading) = heading {
        sheet.text(bold(format!("{heading:.1}°"), large), at(HEADING - 3.5));
    }
    let small = (table.height * 0.62).min(4.0);
    if let (Some(low), Some(high)) = (low, high) {
        let text = format!("{low:.1} to {high:.1}°");
        let size = fitting(&text, small, RANGE - HEADING - 2.0);
        sheet.text(shown(text, size).anchor(Anchor::Middle), at(f64::midpoint(HEADING, RANGE)));
    }
    for chart in &CHARTS {
        if let (Some(end), [_, Some(value), _]) = (chart.numbers, chart.values(row)) {
            let text = format!("{value:.*}", decimals(end_of(table, chart), chart.digits));
            sheet.text(shown(text, small).anchor(Anchor::End), at(end));
        }
    }
    if let Some(level) = row.number(PROBABILITY_LEVEL).filter(|_| texts.has_bands) {
        // Rounded down: 100 % is all of them.
        let text = format!("{} %", (level * 100.0 + 1e-9).floor());
        sheet.text(shown(text, small).anchor(Anchor::End), at(RIGHT - 1.5));
    }
}

/// The largest value of a chart, and a round number at or above it to end the axis.
fn end_of(table: &Table<'_>, chart: &Chart) -> f64 {
    let values = table.rows.iter().flat_map(|row| chart.values(*row)).flatten();
    let most = values.fold(0.0, f64::max).max(1e-6);
    let decade = 10.0_f64.powf(most.log10().floor());
    // Their halves are short numbers, too.
    let steps = [1.0, 1.2, 1.6, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    steps.iter().map(|step| step * decade).find(|end| *end >= most * 0.999).unwrap_or(10.0 * decade)
}

/// Decimals that leave a number below the end of an axis so many digits.
fn decimals(end: f64, digits: i32) -> usize {
    /// More do not fit.
    const MOST: f64 = 4.0;
    let before = end.log10().floor() + 1.0;
    let wanted = (f64::from(digits) - before).clamp(0.0, MOST);
    (0..=4_u8).find(|count| f64::from(*count) >= wanted).map_or(0, usize::from)
}

/// Lines at nothing, the half and the whole, with numbers below.
fn axis(sheet: &mut Sheet, table: &Table<'_>, chart: &Chart) {
    let end = end_of(table, chart);
    let bottom = table.bottom();
    for share in [0.0, 0.5, 1.0] {
        let x = chart.from + share * (chart.to - chart.from);
        let stroke = if share == 0.0 { Stroke::black(0.25) } else { Stroke::grey(0.15, 0.55) };
        sheet.draw(Shape::line([[x, table.top], [x, bottom + 0.8]], stroke));
        let anchor = match share {
            0.0 => Anchor::Start,
            1.0 => Anchor::End,
            _ => Anchor::Middle,
        };
        let text = shown(plain(end * share), 2.5).anchor(anchor);
        // The half is left out where it would run into the whole.
        if share != 0.5 || 3.4 * text.width() < chart.to - chart.from {
            sheet.text(text, [x, bottom + 3.2]);
        }
    }
}

/// A round number without a tail.
fn plain(number: f64) -> String {
    let text = format!("{number:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The band between its edges, and the line of the middle.
fn band(sheet: &mut Sheet, table: &Table<'_>, chart: &Chart) {
    let end = end_of(table, chart);
    let across = |value: f64| chart.from + (value / end).clamp(0.0, 1.0) * (chart.to - chart.from);
    let side = |which: usize| {
        let rows = table.rows.iter();
        let point = |row: &CardRow<'_>| {
            Some([across(chart.values(*row)[which]?), table.middle(row.slope())])
        };
        rows.filter_map(point).collect::<Vec<Place>>()
    };
    let (low, high) = (side(0), side(2));
    let around: Vec<Place> = low.iter().copied().chain(high.iter().rev().copied()).collect();
    sheet.draw(Shape::area(around, 0.86));
    for edge in [low, high] {
        sheet.draw(Shape::line(edge, Stroke::black(0.2)));
    }
    sheet.draw(Shape::line(side(1), Stroke::black(0.6)));
}

/// Measured yaws as crosses on the chart of headings.
fn measured_points(sheet: &mut Sheet, table: &Table<'_>, measured: &[MeasuredYaw]) {
    let chart = &CHARTS[0];
    let end = end_of(table, chart);
    let (first, last) = match table.rows {
        [first, .., last] => (first.slope(), last.slope()),
        _ => return,
    };
    for point in measured.iter().filter(|point| (first..=last).contains(&point.slope)) {
        let share = (point.yaw / end).clamp(0.0, 1.0);
        let (x, y) = (chart.from + share * (chart.to - chart.from), table.middle(point.slope));
        for rise in [-1.1, 1.1] {
            let ends = [[x - 1.1, y - rise], [x + 1.1, y + rise]];
            sheet.draw(Shape::line(ends, Stroke::black(0.45)));
        }
    }
}

/// Lines between the rows, heavier at every fifth degree, and around the headings.
fn frame(sheet: &mut Sheet, table: &Table<'_>) {
    for (index, row) in table.rows.iter().enumerate() {
        let y = table.top + table.height * (index + 1) as f64;
        let stroke =
            if row.slope() % 5.0 == 0.0 { Stroke::black(0.45) } else { Stroke::grey(0.15, 0.5) };
        sheet.draw(Shape::line([[STRIP, y], [RIGHT, y]], stroke));
    }
    sheet.draw(Shape::line([[LEFT, table.top], [RIGHT, table.top]], Stroke::black(0.45)));
    for x in [SLOPE, HEADING] {
        sheet.draw(Shape::line([[x, table.top], [x, table.bottom()]], Stroke::black(0.8)));
    }
}
