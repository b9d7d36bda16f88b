//! What a page promises: the same in every form, and the same bytes every time.

// Colours are written as style sheets write them.
#![allow(clippy::unreadable_literal)]

use grouser_draw::{
    Anchor, BLACK, Cells, Colour, Face, PIXELS_PER_MM, Shape, Sheet, Stroke, Text, width, wrap,
};

fn page() -> Sheet {
    let mut sheet = Sheet::new("Page & <title>", 40.0, 20.0);
    sheet.draw(Shape::rectangle([5.0, 5.0], [10.0, 4.0], BLACK));
    sheet.hatch([20.0, 5.0], [10.0, 4.0], 1.0, Stroke::black(0.2));
    sheet.text(Text::new("13° → 7.3°", 4.0).face(Face::Bold), [5.0, 15.0]);
    sheet.text(Text::new("up < down", 2.0).upright(), [38.0, 18.0]);
    sheet
}

/// The greys of a picture, row by row, and its width.
fn pixels(png: &[u8]) -> (Vec<u8>, usize) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a picture");
    let mut greys = vec![0; reader.output_buffer_size().expect("it has a size")];
    let info = reader.next_frame(&mut greys).expect("it is whole");
    assert_eq!(info.color_type, png::ColorType::Grayscale);
    (greys, info.width as usize)
}

#[test]
fn the_same_page_has_the_same_bytes() {
    assert_eq!(page().to_svg(), page().to_svg());
    assert_eq!(page().to_pdf(), page().to_pdf());
    assert_eq!(page().to_png(), page().to_png());
}

/// A rectangle of 10 mm by 4 mm is black where it is, and the page is white around it.
#[test]
fn a_millimetre_is_ten_pixels() {
    let (greys, across) = pixels(&page().to_png());
    assert_eq!((across, greys.len() / across), (400, 200));
    let at = |x: f64, y: f64| {
        let place = |length: f64| format!("{:.0}", length * PIXELS_PER_MM).parse().expect("whole");
        let (column, row): (usize, usize) = (place(x), place(y));
        greys[row * across + column]
    };
    for (x, y, grey) in [(5.2, 5.2, 0), (14.8, 8.8, 0), (4.8, 6.0, 255), (10.0, 9.3, 255)] {
        assert_eq!(at(x, y), grey, "{x}, {y}");
    }
}

/// Hatching stays inside, and darkens by its share of the area: lines of 0.2 mm, 1 mm apart along
/// the edge at 45°, cover 0.2·√2 of it, but for corners.
#[test]
fn hatching_fills_its_rectangle_and_nothing_else() {
    let (greys, across) = pixels(&page().to_png());
    let darkness = |columns: std::ops::Range<usize>, rows: std::ops::Range<usize>| {
        let count = (columns.len() * rows.len()) as f64;
        let cells = rows.flat_map(|row| columns.clone().map(move |column| row * across + column));
        cells.map(|cell| 1.0 - f64::from(greys[cell]) / 255.0).sum::<f64>() / count
    };
    let inside = darkness(201..299, 51..89);
    assert!((inside - 0.2 * 2.0_f64.sqrt()).abs() < 0.02, "{inside}");
    // A line's end is cut square, and sticks out by half its width at most.
    assert!(darkness(200..300, 92..95) == 0.0 && darkness(302..310, 50..90) == 0.0);
}

#[test]
fn what_has_no_extent_is_not_there() {
    let empty = Sheet::new("t", 10.0, 10.0);
    let mut sheet = empty.clone();
    sheet.draw(Shape::area([], BLACK));
    sheet.draw(Shape::line([[1.0, 1.0]], Stroke::black(0.5)));
    assert_eq!(sheet, empty);
}

#[test]
fn text_can_be_read_and_is_escaped() {
    let svg = page().to_svg();
    assert!(svg.contains(">13° → 7.3°</text>") && svg.contains(">up &lt; down</text>"));
    assert!(svg.contains("<title>Page &amp; &lt;title&gt;</title>"));
    // Letters are drawn once and used often: the font is not needed where the page is shown.
    assert!(!svg.contains("font-family") && svg.contains("<use href=\"#b31\""));
}

/// An SVG document with one of these in it cannot be read at all.
#[test]
fn characters_that_xml_cannot_hold_are_written_out() {
    let mut sheet = Sheet::new("a\u{0}", 40.0, 20.0);
    sheet.text(Text::new("\u{1b}[2J \u{ffff}", 4.0), [5.0, 15.0]);
    let svg = sheet.to_svg();
    assert!(svg.contains("<title>a\\u{0}</title>") && svg.contains(">\\u{1b}[2J \\u{ffff}</text>"));
}

/// A PDF reader finds objects by the table at the end, whose place the last lines tell.
#[test]
fn a_pdf_leads_to_its_table() {
    let pdf = page().to_pdf();
    assert!(pdf.starts_with(b"%PDF-1.") && pdf.trim_ascii_end().ends_with(b"%%EOF"));
    let tail = String::from_utf8_lossy(&pdf[pdf.len() - 60..]).into_owned();
    let place = tail.split("startxref").nth(1).expect("it is told").split_whitespace().next();
    let place: usize = place.expect("a number").parse().expect("a number");
    assert!(pdf[place..].starts_with(b"xref"));
}

#[test]
fn lines_are_no_wider_than_they_may_be() {
    let text = "on at least 95 % of the drawn soils the rover crosses level";
    let lines = wrap(text, Face::Regular, 3.0, 30.0);
    assert!(lines.len() > 1 && lines.iter().all(|line| width(line, Face::Regular, 3.0) <= 30.0));
    assert_eq!(lines.join(" "), text);
    // A word that is too long stands alone.
    assert_eq!(wrap("a longwordindeed b", Face::Regular, 3.0, 5.0).len(), 3);
}

/// Twice the size is twice the width, and anchors only move a text.
#[test]
fn widths_go_with_the_size() {
    let once = width("Heading 13°", Face::Bold, 3.0);
    assert!((width("Heading 13°", Face::Bold, 6.0) - 2.0 * once).abs() < 1e-12);
    let placed = |anchor: Anchor, x: f64| {
        let mut sheet = Sheet::new("t", 60.0, 10.0);
        sheet.text(Text::new("Heading 13°", 3.0).face(Face::Bold).anchor(anchor), [x, 5.0]);
        sheet.to_svg()
    };
    let start = placed(Anchor::Start, 10.0);
    assert_eq!(placed(Anchor::End, 10.0 + once), start);
    assert_eq!(placed(Anchor::Middle, 10.0 + once / 2.0), start);
}

/// Half of blue over white is light blue in every form.
#[test]
fn colours_and_what_they_hide_are_in_every_form() {
    let mut sheet = Sheet::new("t", 10.0, 10.0).on(Colour::hex(0xffffff));
    let blue = Colour::hex(0x0000ff);
    sheet.draw(Shape::rectangle([0.0, 0.0], [10.0, 5.0], blue.opacity(0.5)));
    sheet.draw(Shape::line([[0.0, 8.0], [10.0, 8.0]], Stroke::new(2.0, blue).rounded()));
    let picture = sheet.to_picture(2.0);
    assert_eq!((picture.width, picture.height), (20, 20));
    let [red, green, blue] = picture.pixels[5 * 20 + 10];
    assert!(red == green && (127..=128).contains(&red) && blue == 255, "{red} {green} {blue}");
    assert_eq!(picture.pixels[16 * 20 + 10], [0, 0, 255]);
    let svg = sheet.to_svg();
    assert!(svg.contains("fill=\"#0000ff\" fill-opacity=\"0.5\""));
    assert!(svg.contains("stroke-linecap=\"round\""));
    let pdf = String::from_utf8_lossy(&sheet.to_pdf()).into_owned();
    assert!(pdf.contains("/V50") && pdf.contains("/ca 0.5"));
    let png = sheet.to_png();
    let reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a picture");
    assert_eq!(reader.info().color_type, png::ColorType::Rgb);
}

#[test]
fn colours_mix_and_have_codes() {
    assert_eq!(Colour::hex(0x0072b2).code(), "#0072b2");
    assert_eq!(BLACK.mixed(Colour::hex(0xff0000), 0.5).bytes(), [128, 0, 0]);
    assert_eq!(Colour::grey(0.5).bytes(), [128; 3]);
}

/// A circle covers π r² of the page in pixels, and is one in SVG and PDF.
#[test]
fn circles_are_round_in_every_form() {
    let mut sheet = Sheet::new("t", 20.0, 20.0);
    sheet.draw(Shape::circle([10.0, 10.0], 6.0, BLACK));
    let (greys, _) = pixels(&sheet.to_png());
    let dark: f64 = greys.iter().map(|grey| 1.0 - f64::from(*grey) / 255.0).sum();
    let share = dark / (PIXELS_PER_MM * PIXELS_PER_MM * std::f64::consts::PI * 36.0);
    assert!((share - 1.0).abs() < 0.002, "{share}");
    assert!(sheet.to_svg().contains("<circle cx=\"10\" cy=\"10\" r=\"6\" fill=\"#000000\"/>"));
    assert!(sheet.to_pdf().len() > Sheet::new("t", 20.0, 20.0).to_pdf().len());
}

/// Cells fill their place without gaps, and an empty one shows the page.
#[test]
fn cells_fill_their_place_without_seams() {
    let (red, blue) = (Colour::hex(0xff0000), Colour::hex(0x0000ff));
    let mut sheet = Sheet::new("t", 10.0, 10.0);
    let colours = [Some(red), Some(red), Some(blue), None, Some(blue), Some(red)];
    sheet.cells(Cells::new([1.0, 2.0], [7.0, 5.0], 3, colours));
    let picture = sheet.to_picture(10.0);
    let at = |x: usize, y: usize| picture.pixels[y * 100 + x];
    let (red, blue, white) = ([255, 0, 0], [0, 0, 255], [255; 3]);
    assert_eq!([at(10, 20), at(56, 44), at(57, 20), at(79, 44)], [red, red, blue, blue]);
    assert_eq!(
        [at(20, 45), at(45, 69), at(79, 69), at(80, 69), at(79, 70)],
        [white, blue, red, white, white]
    );
    let all = picture.pixels.iter().all(|pixel| [red, blue, white].contains(pixel));
    assert!(all, "no pixel is mixed");
    let svg = sheet.to_svg();
    assert!(svg.contains("stroke=\"#ff0000\" d=\"M0 0h2M2 1h1\""), "{svg}");
}

#[test]
fn dashes_and_dots_are_written_as_short_as_they_are() {
    let mut sheet = Sheet::new("t", 10.0, 10.0);
    let (from, to) = ([0.0, 5.0], [10.0, 5.0]);
    sheet.draw(Shape::line([from, to], Stroke::black(0.2).dashed(2.0, 1.0)));
    sheet.draw(Shape::line([from, to], Stroke::black(0.2).dash_dotted(2.0, 1.0, 0.5)));
    let svg = sheet.to_svg();
    assert!(svg.contains("\"2 1\"") && svg.contains("\"2 1 0.5 1\""), "{svg}");
}
