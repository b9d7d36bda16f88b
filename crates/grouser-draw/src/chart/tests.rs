//! What every chart promises, whatever its data are.

use std::collections::BTreeSet;

use super::frame::{Frame, colour};
use super::panel::{Panel, Weight, ink};
use super::*;
use crate::sheet::{Colour, Item, Outline, Place, Shape, Text};
use crate::style::rules_for_dark;

const HOSTILE: &str = "</text><script>alert(1)</script> & \"x\" $a$ \u{202e}\u{1b}[2J\0\n]]>";

fn line(points: impl IntoIterator<Item = (f64, f64)>) -> Series {
    Series::new("line", Style::Line, 1, points)
}

fn dots(points: impl IntoIterator<Item = (f64, f64)>) -> Series {
    Series::new("dots", Style::Dots, 2, points)
}

fn chart(series: Vec<Series>) -> Chart {
    Chart::new("A title", ("slip ratio", "drawbar pull [N]"), series)
}

/// Charts of all kinds of data and texts, each with what it is.
fn charts() -> Vec<(&'static str, Chart)> {
    let waves = |count: usize| {
        (0..count).map(|it| {
            let points = (0..50).map(move |x| (f64::from(x), (0.1 * it as f64) + f64::from(x % 7)));
            Series::new(format!("curve {it} of a family"), Style::of_line(it), it, points)
        })
    };
    let long = "a name that goes on and on, ".to_owned() + &"with_a_very_long_word".repeat(5);
    let long = (long + " ").repeat(3);
    let styles = [Style::Dots, Style::Squares, Style::Triangles, Style::Band, Style::Dashed];
    let hostile = styles.map(|style| Series::new(HOSTILE, style, 0, [(0.0, 0.0), (1.0, 1.0)]));
    vec![
        ("nothing", chart(Vec::new())),
        ("no points", chart(vec![line([]), dots([]), Series::band("band", 6, [])])),
        ("only gaps", chart(vec![line([(f64::NAN, 1.0), (1.0, f64::INFINITY)])])),
        ("one point", chart(vec![line([(0.3, -12.0)]), dots([(0.3, -12.0)])])),
        ("a level line", chart(vec![line([(0.0, 0.1), (1.0, 0.1 + 1e-17)])])),
        ("huge", chart(vec![dots([(-1e299, 1e299), (1e299, -1e299), (1e308, 1e308)])])),
        ("tiny", chart(vec![dots([(1e-300, 0.0), (3e-299, 1e-290)])])),
        ("far and narrow", chart(vec![line([(1e6, 1e9), (1e6 + 0.5, 1e9 + 3.0)])])),
        ("gaps", chart(vec![line([(0.0, 1.0), (1.0, f64::NAN), (2.0, 3.0)])])),
        ("marks at the edges", chart(vec![dots([(0.0, 0.0), (10.0, 5.0)])])),
        (
            "error bars",
            chart(vec![
                dots([(0.0, 0.0), (1.0, 5.0)]).with_error_bars([2.0, f64::NAN]),
                dots([(0.5, 1.0)]).with_bars_across([3.0]),
            ]),
        ),
        (
            "a band",
            chart(vec![Series::band(
                "band",
                6,
                [(0.0, -1.0, 9.0), (1.0, f64::NAN, 9.0), (2.0, 1.0, 2.0), (3.0, 1.0, 2.0)],
            )]),
        ),
        ("many curves", chart(waves(30).collect())),
        (
            "long texts",
            Chart::new(
                long.clone(),
                (long.clone(), long.clone()),
                vec![Series::new(long, Style::Line, 1, [(0.0, 0.0), (1.0, 1.0)])],
            ),
        ),
        ("hostile texts", Chart::new(HOSTILE, (HOSTILE, HOSTILE), hostile.into())),
        ("logarithmic", chart(vec![dots((0..9).map(|it| (f64::from(1 << it), 1.0)))]).with_log_x()),
        ("not logarithmic", chart(vec![dots([(0.0, 1.0), (10.0, 1.0)])]).with_log_x()),
        (
            "names",
            chart(vec![dots((1..=40).map(|it| (0.5, f64::from(it))))])
                .with_y_names((1..=40).map(|it| format!("input number {it}"))),
        ),
    ]
}

fn shapes(sheet: &Sheet) -> impl Iterator<Item = &Shape> {
    sheet.items.iter().filter_map(|item| match item {
        Item::Shape(shape) => Some(shape),
        _ => None,
    })
}

/// Left, top, right and bottom of a shape, without its line's width [mm].
fn bounds(shape: &Shape) -> [f64; 4] {
    match &shape.outline {
        Outline::Circle { centre: [x, y], radius } => {
            [x - radius, y - radius, x + radius, y + radius]
        }
        Outline::Points { points, .. } => points.iter().fold(
            [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY],
            |[l, t, r, b], [x, y]| [l.min(*x), t.min(*y), r.max(*x), b.max(*y)],
        ),
    }
}

fn texts(sheet: &Sheet) -> Vec<(&Text, [f64; 4])> {
    let texts = sheet.items.iter().filter_map(|item| match item {
        Item::Text { text, at } => Some((text, at)),
        _ => None,
    });
    let bounds = |(text, at): (&'_ Text, &Place)| {
        let ([x, y], _) = text.base_line(*at);
        [x, y - 0.76 * text.size, x + text.width(), y + 0.2 * text.size]
    };
    texts.map(|(text, at)| (text, bounds((text, at)))).collect()
}

/// All is on the page, no text lies over another, and the document can be read.
fn check_sheet(what: &str, sheet: &Sheet) {
    let [width, height] = sheet.size();
    let is_on_page =
        |[l, t, r, b]: [f64; 4]| l > -0.1 && t > -0.1 && r < width + 0.1 && b < height + 0.1;
    for shape in shapes(sheet) {
        assert!(is_on_page(bounds(shape)), "{what}: {shape:?} on {width} × {height} mm");
    }
    let texts = texts(sheet);
    for (place, (text, own)) in texts.iter().enumerate() {
        assert!(is_on_page(*own), "{what}: {:?} at {own:?} on {width} × {height} mm", text.content);
        for (other, [l, t, r, b]) in &texts[place + 1..] {
            let is_over = own[0] < *r && *l < own[2] && own[1] < *b && *t < own[3];
            assert!(!is_over, "{what}: {:?} over {:?}", text.content, other.content);
        }
    }
    let svg = on_both_grounds(sheet);
    roxmltree::Document::parse(&svg).unwrap();
    assert!(!svg.contains("NaN") && !svg.contains("inf\""), "{what}");
}

#[test]
fn no_text_lies_over_another_and_all_is_on_the_page() {
    for (what, chart) in charts() {
        check_sheet(what, &sheet_of(&chart, PAGE));
        check_sheet(what, &sheet_of(&chart, SMALL));
        check_sheet(what, &Grid { title: what.into(), cells: vec![vec![Some(chart)]] }.sheet());
    }
}

#[test]
fn nothing_of_the_data_is_outside_of_the_frame() {
    /// A line that is one point is a dot as wide as a line [mm]; marks are larger.
    const EDGE_OF_LINE: f64 = 0.51;
    let frame = Frame { left: 20.0, top: 10.0, width: 120.0, height: 70.0 };
    for (what, chart) in charts() {
        let x = Panel::x_axis(&chart, INTERVALS, frame.width, LETTERS);
        let y = y_axis(&chart, frame.height, 60.0);
        let mut sheet = sheet("", PAGE);
        Panel { chart: &chart, x, y, frame, weight: Weight::Full }.draw(&mut sheet);
        for shape in shapes(&sheet) {
            let [left, top, right, bottom] = bounds(shape);
            let is_inside = left > frame.left - EDGE_OF_LINE
                && right < frame.right() + EDGE_OF_LINE
                && top > frame.top - EDGE_OF_LINE
                && bottom < frame.bottom() + EDGE_OF_LINE;
            assert!(is_inside, "{what}: {shape:?}");
        }
    }
}

/// The shapes of a chart in the colour of a series.
fn in_colour(chart: &Chart, place: usize) -> Vec<Shape> {
    let series = Series::new("", Style::Line, place, []);
    let ink = ink(&series).code();
    let has = |colour: Option<Colour>| colour.is_some_and(|colour| colour.code() == ink);
    let mut sheet = sheet("", PAGE);
    let frame = Frame { left: 0.0, top: 0.0, width: 100.0, height: 100.0 };
    let (x, y) = (Panel::x_axis(chart, 5, 100.0, 3.0), Panel::y_axis(chart, 100.0, 3.0));
    Panel { chart, x, y, frame, weight: Weight::Full }.draw(&mut sheet);
    let all = shapes(&sheet).filter(|it| has(it.fill) || has(it.stroke.map(|it| it.colour)));
    all.cloned().collect()
}

#[test]
fn each_datum_has_one_mark() {
    for style in [Style::Dots, Style::Squares, Style::Triangles] {
        for count in [0_u32, 1, 7, 200] {
            let points = (0..count).map(|it| (f64::from(it), f64::from(it % 3)));
            let missing = [(f64::NAN, 1.0), (1.0, f64::NAN)];
            let series = Series::new("", style, 2, points.chain(missing));
            let marks = in_colour(&chart(vec![series]), 2).len();
            assert_eq!(u32::try_from(marks), Ok(count), "{style:?}");
        }
    }
}

#[test]
fn a_missing_number_breaks_a_line_and_a_band() {
    let numbers = [0.0, 1.0, f64::NAN, 3.0, f64::INFINITY, 5.0, 6.0, 7.0];
    let points = || numbers.into_iter().enumerate().map(|(x, y)| (x as f64, y));
    let count = |shape: &Shape| match &shape.outline {
        Outline::Points { points, .. } => points.len(),
        Outline::Circle { .. } => 1,
    };
    let pieces = in_colour(&chart(vec![line(points())]), 1);
    assert_eq!(pieces.iter().map(count).collect::<Vec<_>>(), [2, 1, 3]);
    let band = Series::band("", 6, points().map(|(x, y)| (x, y, y + 1.0)));
    let pieces = in_colour(&chart(vec![band]), 6);
    assert_eq!(pieces.iter().map(count).collect::<Vec<_>>(), [4, 2, 6]);
}

/// The middle of a chart from 0 to 10 is 5, and a band is named there.
#[test]
fn data_are_where_their_numbers_say() {
    let at = |point: (f64, f64)| {
        let chart = chart(vec![line([(0.0, 0.0), (10.0, 10.0)])]);
        let frame = Frame { left: 20.0, top: 10.0, width: 100.0, height: 50.0 };
        let (x, y) = (Panel::x_axis(&chart, 5, 100.0, 3.0), Panel::y_axis(&chart, 50.0, 3.0));
        Panel { chart: &chart, x, y, frame, weight: Weight::Full }.at(point)
    };
    assert_eq!(at((5.0, 5.0)), Some([70.0, 35.0]));
    assert_eq!(at((0.0, 10.0)), Some([20.0, 10.0]));
    assert_eq!(at((f64::NAN, 10.0)), None);
}

#[test]
fn texts_from_anywhere_are_escaped() {
    let svg = Chart::new(
        HOSTILE,
        (HOSTILE, HOSTILE),
        vec![Series::new(HOSTILE, Style::Line, 1, [(0.0, 0.0), (1.0, 1.0)])],
    )
    .to_svg();
    let document = roxmltree::Document::parse(&svg).unwrap();
    assert!(!document.descendants().any(|node| node.has_tag_name("script")));
    let texts = document.descendants().filter(|node| node.has_tag_name("text"));
    let all: String = texts.filter_map(|node| node.text().map(str::to_owned)).collect();
    assert!(all.contains("<script>alert(1)</script>") && all.contains("$a$"), "{all}");
    assert!(!svg.contains('\u{202e}') && all.contains("\\u{202e}") && !svg.contains('\u{1b}'));
}

#[test]
fn every_colour_of_a_chart_has_one_for_a_dark_screen() {
    let rules = rules_for_dark();
    for (what, chart) in charts() {
        let sheet = sheet_of(&chart, PAGE);
        let of_shapes =
            shapes(&sheet).flat_map(|it| [it.fill, it.stroke.map(|stroke| stroke.colour)]);
        let of_texts = texts(&sheet).into_iter().map(|(text, _)| text.colour);
        let colours = of_shapes.flatten().chain(of_texts);
        for colour in colours.map(Colour::code).collect::<BTreeSet<String>>() {
            assert!(rules.contains(&format!("[fill=\"{colour}\" i]")), "{what}: {colour}");
        }
    }
}

fn bars(rows: Vec<(String, Vec<f64>)>) -> Bars {
    let parts = ["soil", "wheel", "what is left over"].map(String::from).into();
    let (title, x_label) = ("Budget".into(), "share of the variance [%]".into());
    Bars { title, x_label, parts, has_rest: true, rows }
}

#[test]
fn parts_of_bars_lie_end_to_end_and_as_long_as_they_are() {
    let bars = bars(vec![
        ("one".into(), vec![20.0, 30.0, 50.0]),
        ("two".into(), vec![40.0, -10.0, f64::NAN]),
    ]);
    let sheet = bars.sheet();
    check_sheet("bars", &sheet);
    let thick = |it: &&Shape| (bounds(it)[3] - bounds(it)[1] - 6.0).abs() < 1e-9;
    let boxes: Vec<[f64; 4]> = shapes(&sheet).filter(thick).map(bounds).collect();
    let widths: Vec<f64> = boxes.iter().map(|it| it[2] - it[0]).collect();
    assert_eq!(boxes.len(), 5);
    for (width, length) in widths.iter().zip([20.0, 30.0, 50.0, 40.0, 10.0]) {
        assert!((width / widths[0] - length / 20.0).abs() < 1e-9, "{widths:?}");
    }
    assert!(boxes.windows(2).take(2).all(|pair| (pair[0][2] - pair[1][0]).abs() < 1e-9));
    // Below zero to the left of where the others begin.
    assert!((boxes[4][2] - boxes[3][0]).abs() < 1e-9 && boxes[3][1] > boxes[0][3]);
}

#[test]
fn bars_of_any_names_and_numbers_are_drawn() {
    let long = "a_name_without_blanks_that_is_longer_than_any_margin_could_ever_be ".repeat(4);
    for rows in [
        Vec::new(),
        vec![(HOSTILE.to_owned(), vec![0.0, 0.0, 0.0])],
        vec![(long, vec![1e-12, 1e12, 3.0]); 25],
    ] {
        check_sheet("bars", &bars(rows).sheet());
    }
}

fn heat_map(columns: usize, rows: usize, value: impl Fn(usize) -> Option<f64>) -> HeatMap {
    HeatMap {
        title: "Slip ratio, on dry sand".into(),
        x_label: "slope [°]".into(),
        columns: (0..columns).map(|it| 0.25 * it as f64).collect(),
        y_label: "course, positive uphill [°]".into(),
        rows: (0..rows).map(|it| -90.0 + it as f64).collect(),
        values: (0..rows)
            .map(|it| (0..columns).map(|k| value(it * columns + k)).collect())
            .collect(),
    }
}

#[test]
fn a_heat_map_has_a_cell_for_each_value_from_the_bottom_up() {
    for (columns, rows) in [(0, 0), (1, 1), (3, 2), (200, 300)] {
        let sheet = heat_map(columns, rows, |it| (it != 1).then_some(it as f64)).sheet();
        check_sheet("heat map", &sheet);
        let cells = sheet.items.iter().find_map(|item| match item {
            Item::Cells(cells) => Some(cells),
            _ => None,
        });
        let cells = cells.expect("the table comes first");
        assert_eq!(cells.colours.len(), columns * rows);
        if (columns, rows) == (3, 2) {
            // The second value of the first row is missing: it lies in the lower row.
            let grey = Some(colour(Role::Grid));
            assert_eq!(cells.colours.iter().position(|it| *it == grey), Some(4));
            assert_eq!(cells.colours[3], Some(crate::Scale::ramp(0.0, 1.0).colour(0.0)));
        }
    }
    check_sheet("one value", &heat_map(2, 2, |_| Some(0.3)).sheet());
    check_sheet("no values", &heat_map(2, 2, |_| None).sheet());
}

/// In a triangle of charts only the lowest of a column have numbers under them, where they share an
/// axis.
#[test]
fn charts_of_a_grid_share_their_numbers() {
    let chart = || Chart::new("", ("x", "y"), vec![dots([(0.0, 1.0), (10.0, 2.0)])]);
    let sheet = Grid {
        title: "Posterior".into(),
        cells: vec![vec![Some(chart()), None], vec![Some(chart()), Some(chart())]],
    }
    .sheet();
    check_sheet("grid", &sheet);
    let count = |what: &str| texts(&sheet).iter().filter(|it| it.0.content == what).count();
    assert_eq!((count("10"), count("x"), count("y")), (2, 2, 3));
}
