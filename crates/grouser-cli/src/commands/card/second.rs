//! The second page of the card: where to look at the slip, and the other courses, to get there and
//! to get out.

use grouser::document::columns::card::{SLIP_CHECK_EVERY, SLIP_LIMIT};
use grouser::document::columns::card_courses::{COURSE, TURN_DOWNHILL, TURN_WAY, name_of_course};
use grouser::document::columns::verdict::{PROBABILITY_STUCK, VERDICT};
use grouser::document::columns::{Quantity, SLIP_RATIO, SLOPE};
use grouser::document::escape;
use grouser::document::reading::four_digits;
use grouser::document::table;
use grouser::studies::card::courses::{Course, TURN};
use grouser::studies::verdict::{
    BELOW_FRICTION_ANGLE, DRIFT_WAY, MOST_CHECKED_SLIP, SOIL_LENGTH, STUCK_WITH_CHECKS, Verdict,
};
use grouser_draw::{Anchor, BLACK, Face, Shape, Sheet, Stroke, WHITE};

use super::layout::{
    BAR, BLANKS, LEAST_SIZE, LEFT, PAGE, RIGHT, TOP, bar, blanks, date, fitting, lines, lines_of,
    paragraphs, shown, shown_rows, titles,
};
use super::row::{CardRow, upwards};
use super::texts::{Texts, degrees, percent};

/// Where the rows begin [mm], how high the head above them is, and how high they are at most.
const ROWS: f64 = 84.0;
const HEAD: f64 = 21.0;
const HIGHEST_ROW: f64 = 8.4;
/// Where the rows end at the latest [mm].
const ROWS_END: f64 = 205.0;

/// Edges of the slope and of the columns of the slip check [mm].
const SLOPE_EDGE: f64 = 25.0;
const CHECK: [f64; 4] = [SLOPE_EDGE, 35.5, 46.0, 56.5];

/// A course with the right edge of its column [mm].
struct Place {
    course: Course,
    /// In three lines.
    head: [&'static str; 3],
    left: f64,
    right: f64,
}

const PLACES: [Place; 7] = [
    Place { course: Course::Up, head: ["UP", "nose first", ""], left: CHECK[3], right: 71.0 },
    Place {
        course: Course::BackDown,
        head: ["BACK DOWN", "rear first, out", "of a way up"],
        left: 71.0,
        right: 90.0,
    },
    Place { course: Course::Down, head: ["DOWN", "nose first", ""], left: 90.0, right: 108.0 },
    Place {
        course: Course::BackUp,
        head: ["BACK UP", "rear first, out", "of a way down"],
        left: 108.0,
        right: 127.0,
    },
    Place {
        course: Course::BackAcross,
        head: ["BACK ACROSS", "rear first, and", "REAR UPHILL"],
        left: 127.0,
        right: 147.0,
    },
    Place {
        course: Course::Turn,
        head: ["ON THE WAY", "uphill wheels", "half speed"],
        left: 147.0,
        right: 165.0,
    },
    Place {
        course: Course::TurnOnTheSpot,
        head: ["ON THE", "SPOT", ""],
        left: 186.0,
        right: RIGHT,
    },
];

/// Edges of what a turn on the way takes [mm].
const TURN_EDGES: [f64; 3] = [165.0, 175.5, 186.0];

/// Draws the page.
pub(super) fn draw(texts: &Texts, card: &table::Table, courses: &table::Table) -> Sheet {
    let title = format!("Operator's card, page 2: {}", texts.title);
    let mut sheet = Sheet::new(&escape::line(&title), PAGE[0], PAGE[1]);
    titles(&mut sheet, texts, "When to look at the slip, and how to get there and out", 2);
    steps(&mut sheet, texts);
    let rows = shown_rows(card);
    let height = ((ROWS_END - ROWS - BAR) / rows.len().max(1) as f64).min(HIGHEST_ROW);
    heads(&mut sheet, texts);
    let bottom = ROWS + height * rows.len() as f64;
    for (place, row) in rows.iter().enumerate() {
        line(&mut sheet, *row, courses, [ROWS + height * place as f64, height]);
    }
    frame(&mut sheet, bottom);
    let first = CardRow::all(card).find(|row| row.is_no_go() && row.slope().fract() == 0.0);
    if let Some(first) = first {
        bar(&mut sheet, bottom + 1.0, first.slope());
    }
    foot(&mut sheet, texts, bottom + 1.0 + BAR + 5.0);
    blanks(&mut sheet);
    sheet
}

fn steps(sheet: &mut Sheet, texts: &Texts) {
    let steps = [
        "1  Stop every so many metres and look at the slip since the last stop.",
        "2  Above the limit: turn back, backwards by the way you came. Across the slope the REAR \
         goes uphill then,",
        "    by as much as page 1 turns the nose. Never go on where the table is black.",
        "3  Turn on the way, with the uphill wheels at half speed; on the spot only where it is \
         not black.",
    ];
    let y = lines(sheet, &steps, TOP + 18.5, RIGHT - LEFT);
    date(sheet, &texts.date, y + 1.5);
}

fn heads(sheet: &mut Sheet, texts: &Texts) {
    let top = ROWS - HEAD;
    let bold = |text: &str, size: f64| shown(text, size).face(Face::Bold).anchor(Anchor::Middle);
    let mut group = |[left, right]: [f64; 2], text: &str| {
        sheet.draw(Shape::rectangle([left, top], [right - left, 5.0], BLACK));
        let size = fitting(text, 3.2, right - left - 1.0).max(LEAST_SIZE);
        sheet.text(bold(text, size).colour(WHITE), [left.midpoint(right), top + 3.7]);
    };
    group([CHECK[0], CHECK[3]], "SLIP CHECK");
    let slip = if texts.has_bands {
        "SLIP ON OTHER COURSES, %: 95 % of samples"
    } else {
        "SLIP ON OTHER COURSES, %"
    };
    group([CHECK[3] + 0.4, PLACES[4].right], slip);
    group([PLACES[5].left + 0.4, RIGHT], &format!("TURN UPHILL: slip, %; by {}", degrees(TURN)));
    sheet.text(bold("SLOPE", 3.4), [LEFT.midpoint(SLOPE_EDGE), ROWS - 2.0]);
    let mut column = |[left, right]: [f64; 2], lines: [&str; 3]| {
        let styles = [(9.0, Face::Bold), (5.4, Face::Regular), (2.0, Face::Regular)];
        for (text, (rise, face)) in lines.iter().zip(styles) {
            let size = fitting(text, 2.7, right - left - 0.6).max(LEAST_SIZE);
            let text = shown(text, size).face(face).anchor(Anchor::Middle);
            sheet.text(text, [left.midpoint(right), ROWS - rise]);
        }
    };
    column([CHECK[0], CHECK[1]], ["look", "every", "m"]);
    column([CHECK[1], CHECK[2]], ["back if", "above", "%"]);
    column([CHECK[2], CHECK[3]], ["stuck", "anyway", "%"]);
    for place in &PLACES {
        column([place.left, place.right], place.head);
    }
    column([TURN_EDGES[0], TURN_EDGES[1]], ["takes", "", "m"]);
    column([TURN_EDGES[1], TURN_EDGES[2]], ["lower", "by", "cm"]);
}

/// One slope.
fn line(sheet: &mut Sheet, row: CardRow<'_>, courses: &table::Table, [top, height]: [f64; 2]) {
    let large = (height * 0.9).min(6.4);
    let small = (height * 0.56).min(3.6);
    let y = top + height / 2.0 + 0.365 * large;
    let at = |left: f64, right: f64| [left.midpoint(right), y];
    let middle = |text: String, size: f64| shown(text, size).anchor(Anchor::Middle);
    let slope = format!("{}°", row.slope());
    let bold = middle(slope, large).face(Face::Bold);
    let every = row.number(SLIP_CHECK_EVERY).map_or("all the way".to_owned(), four_digits);
    let limit = row.number(SLIP_LIMIT).map(|limit| upwards(limit * 100.0, 1)).unwrap_or_default();
    let stuck = row.number(PROBABILITY_STUCK);
    let percent = |stuck: f64| {
        if stuck > 0.0 { upwards(stuck * 100.0, 1) } else { "0".to_owned() }
    };
    let stuck = stuck.map(percent).unwrap_or_default();
    for (place, text) in [every, limit, stuck].into_iter().enumerate() {
        let [left, right] = [CHECK[place], CHECK[place + 1]];
        let size = fitting(&text, small, right - left - 1.0).max(LEAST_SIZE);
        sheet.text(middle(text, size), at(left, right));
    }
    for place in &PLACES {
        let Some(cell) = Cell::of(courses, row.slope(), place.course) else { continue };
        cell.draw(sheet, [place.left, place.right], [top, height], (y, small));
        if place.course == Course::Turn {
            let numbers = [cell.high(TURN_WAY), cell.high(TURN_DOWNHILL)];
            let [way, downhill] = numbers;
            let texts = [
                way.map(|way| upwards(way, 1)),
                downhill.map(|downhill| upwards((downhill * 100.0).max(1.0), 1)),
            ];
            for (text, place) in texts.into_iter().zip([0, 1]) {
                let text = text.unwrap_or_default();
                sheet.text(middle(text, small), at(TURN_EDGES[place], TURN_EDGES[place + 1]));
            }
        }
    }
    sheet.text(bold, at(LEFT, SLOPE_EDGE));
    let stroke = Stroke::grey(0.15, 0.5);
    sheet.draw(Shape::line([[LEFT, top + height], [RIGHT, top + height]], stroke));
}

/// A course on a slope, as its table has it.
struct Cell<'a> {
    table: &'a table::Table,
    place: usize,
}

impl<'a> Cell<'a> {
    fn of(table: &'a table::Table, slope: f64, course: Course) -> Option<Self> {
        let (slopes, names) = (table.numbers(SLOPE.name), table.texts(COURSE));
        let is_it = |place: &usize| {
            slopes[*place] == Some(slope)
                && names[*place].as_deref() == Some(name_of_course(course))
        };
        (0..table.rows()).find(is_it).map(|place| Self { table, place })
    }

    fn number(&self, name: &str) -> Option<f64> {
        self.table.numbers(name).get(self.place).copied().flatten()
    }

    fn high(&self, quantity: Quantity) -> Option<f64> {
        let [.., high] = quantity.quantiles();
        self.number(&high)
    }

    fn verdict(&self) -> &'a str {
        self.table.texts(VERDICT)[self.place].as_deref().unwrap_or_default()
    }

    /// The band of the slip in whole per cent, its ends rounded outwards.
    fn slip(&self) -> Option<String> {
        let [low, _, high] = SLIP_RATIO.quantiles();
        let (low, high) = (self.number(&low)?, self.number(&high)?);
        let low = (low * 100.0).floor() + 0.0;
        /// All slip is no reading to wait for [-].
        const ANY: f64 = 1.0;
        let text = if high >= ANY {
            format!("{low} to –")
        } else {
            format!("{low} to {}", (high * 100.0).ceil() + 0.0)
        };
        Some(text.replace('-', "−"))
    }

    /// White to go, hatched for caution, densely where nobody can tell, black for no-go.
    fn draw(
        &self,
        sheet: &mut Sheet,
        [left, right]: [f64; 2],
        [top, height]: [f64; 2],
        (y, size): (f64, f64),
    ) {
        let (corner, area) = ([left, top], [right - left, height]);
        if self.verdict() == Verdict::NoGo.name() {
            sheet.draw(Shape::rectangle(corner, area, BLACK));
            let text = shown("NO-GO", size).face(Face::Bold).colour(WHITE).anchor(Anchor::Middle);
            return sheet.text(text, [left.midpoint(right), y]);
        }
        let text = self.slip().unwrap_or_default();
        let size = fitting(&text, size, right - left - 3.0).max(LEAST_SIZE);
        let text = shown(text, size).anchor(Anchor::Middle);
        if self.verdict() != Verdict::Go.name() {
            let distance = if self.verdict() == Verdict::Caution.name() { 1.8 } else { 0.9 };
            sheet.hatch(corner, area, distance, Stroke::black(0.35));
            let width = text.width() + 1.2;
            let corner = [left.midpoint(right) - width / 2.0, top + 0.14 * height];
            sheet.draw(Shape::rectangle(corner, [width, 0.72 * height], WHITE));
        }
        sheet.text(text, [left.midpoint(right), y]);
    }
}

/// Lines between the columns.
fn frame(sheet: &mut Sheet, bottom: f64) {
    sheet.draw(Shape::line([[LEFT, ROWS], [RIGHT, ROWS]], Stroke::black(0.45)));
    let light = PLACES.iter().map(|place| (place.right, Stroke::grey(0.15, 0.5)));
    let turn = TURN_EDGES.iter().map(|x| (*x, Stroke::grey(0.15, 0.5)));
    let heavy = [CHECK[0], CHECK[3], PLACES[4].right].map(|x| (x, Stroke::black(0.8)));
    let check = [CHECK[1], CHECK[2]].map(|x| (x, Stroke::grey(0.15, 0.5)));
    for (x, stroke) in light.chain(turn).chain(check).chain(heavy) {
        sheet.draw(Shape::line([[x, ROWS], [x, bottom]], stroke));
    }
}

/// What the columns are, and by which rule.
fn foot(sheet: &mut Sheet, texts: &Texts, top: f64) {
    const SIZES: [f64; 6] = [3.8, 3.4, 3.0, 2.8, 2.6, 2.5];
    let all = notes(texts);
    let nowhere = || Sheet::new("", PAGE[0], PAGE[1]);
    let end =
        |sheet: &mut Sheet, size: f64| paragraphs(sheet, &lines_of(&all), [LEFT, RIGHT], size, top);
    let fits = |size: &f64| end(&mut nowhere(), *size) <= BLANKS - 3.5;
    let size = SIZES.into_iter().find(fits).unwrap_or(SIZES[5]);
    end(sheet, size);
}

fn notes(texts: &Texts) -> Vec<(&'static str, String)> {
    let ways = format!("{} m", four_digits(DRIFT_WAY));
    let check = format!(
        "with these stops at most {stuck} of ways of {ways} along the contour get stuck between \
         two looks. The soil is taken to change on the way: slip at each place is that of one of \
         the samples, places x apart are correlated by e^(−x/{length} m) (assumed). 5 m at most; \
         'all the way': not even stops every half metre suffice. 'Stuck anyway': on how many ways, \
         with these stops. The limit is the one of page 1: 97.5 % of the samples that hold the \
         contour by their own heading stay below, {most} at most.",
        stuck = percent(STUCK_WITH_CHECKS),
        length = four_digits(SOIL_LENGTH),
        most = percent(MOST_CHECKED_SLIP),
    );
    let range = if texts.has_bands {
        "95 % of the samples are in the range; stop above it, and above 40 % wherever it ends. "
    } else {
        ""
    };
    vec![
        ("Look every", check),
        (
            "Slip",
            format!(
                "mean of the wheels, in per cent of the rims' way. {range}Below 0 the rover runs \
                 ahead of its rims and skids. '–': in more than 2.5 % of the samples the rover is \
                 stuck."
            ),
        ),
        (
            "Turn",
            format!(
                "from the heading of page 1 uphill. For {turn} it takes up to so many metres, and \
                 the rover comes lower by up to so many centimetres, in 97.5 % of the samples that \
                 turn: a correction is a fifth of it. On the spot the two sides run against each \
                 other; samples that do not turn count as stuck.",
                turn = degrees(TURN)
            ),
        ),
        (
            "Verdicts",
            format!(
                "white: go; hatched: caution; dense: nobody can tell; black: no-go. Up and down by \
                 all of page 1's rule, on the spot by who gets stuck, others by slip. None is \
                 driven within {below} of the friction angle. Page 1's no-go slopes have none.",
                below = degrees(BELOW_FRICTION_ANGLE)
            ),
        ),
        (
            "Leaves out",
            "how deep wheels have dug already: where the rover is stuck no row holds. Turning \
             downhill, starts, stops, and steered wheels. Power, torque and wheel way on page 1 \
             are mechanical."
                .to_owned(),
        ),
    ]
}
