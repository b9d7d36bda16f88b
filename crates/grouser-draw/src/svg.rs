//! A page as SVG: outlines to be seen, and unseen text to be searched and copied.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use crate::png::png_of;
use crate::sheet::{Cells, Colour, Face, Item, Outline, Place, Shape, Sheet, Step, Text, markup};

impl Sheet {
    /// The page as an SVG document.
    #[must_use]
    pub fn to_svg(&self) -> String {
        write(self)
    }
}

fn write(sheet: &Sheet) -> String {
    let [width, height] = [sheet.width, sheet.height].map(short);
    let title = markup(&sheet.title);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" \
         viewBox=\"0 0 {width} {height}\" role=\"img\">\n<title>{title}</title>\n<defs>\n"
    );
    for (face, character) in letters(sheet) {
        let outline = outline(&face.glyph(character).outline);
        let _ = writeln!(svg, "<path id=\"{}\" d=\"{outline}\"/>", id(face, character));
    }
    svg.push_str("</defs>\n");
    let ground = sheet.ground.code();
    let _ = writeln!(svg, "<path d=\"M0 0H{width}V{height}H0Z\" fill=\"{ground}\"/>");
    for item in &sheet.items {
        match item {
            Item::Shape(shape) => write_shape(&mut svg, shape),
            Item::Cells(cells) => write_cells(&mut svg, cells),
            Item::Text { text, at } => write_text(&mut svg, text, *at),
        }
    }
    svg.push_str("</svg>\n");
    svg
}

/// The letters that a page needs.
pub(crate) fn letters(sheet: &Sheet) -> BTreeSet<(Face, char)> {
    let texts = sheet.items.iter().filter_map(|item| match item {
        Item::Text { text, .. } => Some(text),
        Item::Shape(_) | Item::Cells(_) => None,
    });
    texts.flat_map(|text| text.content.chars().map(|letter| (text.face, letter))).collect()
}

fn write_shape(svg: &mut String, shape: &Shape) {
    let form = match &shape.outline {
        Outline::Points { points, closed } => format!("path d=\"{}\"", path(points, *closed)),
        Outline::Circle { centre: [x, y], radius } => {
            format!("circle cx=\"{}\" cy=\"{}\" r=\"{}\"", short(*x), short(*y), short(*radius))
        }
    };
    let fill = shape.fill.map_or(" fill=\"none\"".to_owned(), |fill| ink("fill", fill));
    let _ = write!(svg, "<{form}{fill}");
    if let Some(stroke) = shape.stroke {
        let (line, width) = (ink("stroke", stroke.colour), short(stroke.width));
        let _ = write!(svg, "{line} stroke-width=\"{width}\"");
        if stroke.round {
            svg.push_str(" stroke-linecap=\"round\" stroke-linejoin=\"round\"");
        }
        if let Some(lengths) = stroke.dash {
            // Dashes that are all alike are written once.
            let count = if lengths[..2] == lengths[2..] { 2 } else { 4 };
            let lengths = lengths[..count].iter().map(|length| short(*length));
            let _ = write!(svg, " stroke-dasharray=\"{}\"", lengths.collect::<Vec<_>>().join(" "));
        }
    }
    svg.push_str("/>\n");
}

fn path(points: &[Place], closed: bool) -> String {
    let mut path = String::new();
    for (index, point) in points.iter().enumerate() {
        let letter = if index == 0 { 'M' } else { 'L' };
        let _ = write!(path, "{letter}{} {}", short(point[0]), short(point[1]));
    }
    if closed {
        path.push('Z');
    }
    path
}

/// A path for each colour, of lines through the middles of cells, as wide as a row; many cells are
/// one picture.
fn write_cells(svg: &mut String, cells: &Cells) {
    if cells.is_picture() {
        return write_picture(svg, cells);
    }
    let mut paths: BTreeMap<String, String> = BTreeMap::new();
    for run in cells.runs() {
        let path = paths.entry(ink("stroke", run.colour)).or_default();
        let _ = write!(path, "M{} {}h{}", run.first, run.row, run.count);
    }
    let ([left, top], [width, height]) = (cells.place.map(short), cells.cell());
    // Smoothed edges would let the ground shine through between cells.
    let _ = writeln!(
        svg,
        "<g transform=\"translate({left} {top}) scale({width:.5} {height:.5}) translate(0 .5)\" \
         stroke-width=\"1.02\" fill=\"none\" shape-rendering=\"crispEdges\">"
    );
    for (ink, path) in paths {
        let _ = writeln!(svg, "<path{ink} d=\"{path}\"/>");
    }
    svg.push_str("</g>\n");
}

/// Cells as a picture that the document holds.
fn write_picture(svg: &mut String, cells: &Cells) {
    let ([left, top], [width, height]) = (cells.place.map(short), cells.size.map(short));
    let _ = writeln!(
        svg,
        "<image x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" \
         preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" \
         href=\"data:image/png;base64,{}\"/>",
        base64(&png_of(cells))
    );
}

/// Bytes as text.
///
/// Source: RFC 4648, section 4.
#[must_use]
pub fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let byte = |place: usize| u32::from(chunk.get(place).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for digit in 0..4 {
            let is_there = digit <= chunk.len();
            let sextet = (bits >> (18 - 6 * digit)) & 63;
            text.push(if is_there { char::from(DIGITS[sextet as usize]) } else { '=' });
        }
    }
    text
}

/// The bytes that were made [text](base64); nothing if the text was made of none.
#[must_use]
pub fn from_base64(text: &str) -> Option<Vec<u8>> {
    let digit = |letter: u8| match letter {
        b'A'..=b'Z' => Some(letter - b'A'),
        b'a'..=b'z' => Some(letter - b'a' + 26),
        b'0'..=b'9' => Some(letter - b'0' + 52),
        b'+' => Some(62),
        b'/' => Some(63),
        _ => None,
    };
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    for chunk in text.trim_end_matches('=').as_bytes().chunks(4) {
        let digits = chunk.iter().map(|letter| digit(*letter)).collect::<Option<Vec<u8>>>()?;
        let bits = digits.iter().fold(0, |bits, digit| bits << 6 | u32::from(*digit));
        let whole = bits << (6 * (4 - digits.len())) << 8;
        bytes.extend(&whole.to_be_bytes()[..digits.len() * 6 / 8]);
    }
    (base64(&bytes) == text).then_some(bytes)
}

fn write_text(svg: &mut String, text: &Text, at: Place) {
    let ([x, y], _) = text.base_line(at);
    let scale = text.size / text.face.units();
    let turn = if text.upright { " rotate(-90)" } else { "" };
    let (left, top) = (short(x), short(y));
    let _ = write!(
        svg,
        "<g transform=\"translate({left} {top}){turn}\"><g transform=\"scale({scale:.7} \
         {:.7})\"{}>",
        -scale,
        ink("fill", text.colour)
    );
    let mut gone = 0.0;
    for letter in text.content.chars() {
        if letter != ' ' {
            let _ = write!(svg, "<use href=\"#{}\" x=\"{gone}\"/>", id(text.face, letter));
        }
        gone += text.face.glyph(letter).advance;
    }
    // Any font will do for what is not seen: its width is given.
    let _ = writeln!(
        svg,
        "</g><text font-size=\"{}\" textLength=\"{}\" lengthAdjust=\"spacingAndGlyphs\" \
         fill-opacity=\"0\">{}</text></g>",
        short(text.size),
        short(text.width()),
        markup(&text.content)
    );
}

fn outline(steps: &[Step]) -> String {
    let mut path = String::new();
    for step in steps {
        // Writing to a string does not fail.
        let _ = match step {
            Step::Move([x, y]) => write!(path, "M{x} {y}"),
            Step::Line([x, y]) => write!(path, "L{x} {y}"),
            Step::Curve([u, v], [x, y]) => write!(path, "Q{u} {v} {x} {y}"),
            Step::Close => write!(path, "Z"),
        };
    }
    path
}

fn id(face: Face, letter: char) -> String {
    let name = match face {
        Face::Regular => 'r',
        Face::Bold => 'b',
    };
    format!("{name}{:x}", u32::from(letter))
}

/// The attributes of a fill or a stroke in a colour.
fn ink(of: &str, colour: Colour) -> String {
    let ink = format!(" {of}=\"{}\"", colour.code());
    if colour.hides() < 1.0 {
        return format!("{ink} {of}-opacity=\"{}\"", short(colour.hides()));
    }
    ink
}

/// A micrometre is fine enough.
fn short(length: f64) -> String {
    let text = format!("{length:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Source: RFC 4648, section 10.
    #[test]
    fn base64_has_the_test_vectors() {
        let found =
            ["", "f", "fo", "foo", "foob", "fooba", "foobar"].map(|it| base64(it.as_bytes()));
        assert_eq!(found, ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"]);
        let back = found.map(|it| from_base64(&it).unwrap());
        assert_eq!(back.map(|it| it.len()), [0, 1, 2, 3, 4, 5, 6]);
        for wrong in ["Z", "Zg", "Zg=", "Zh==", "Zm9v=", "Zm 9", "Zg==Zg=="] {
            assert_eq!(from_base64(wrong), None, "{wrong}");
        }
    }

    /// A hundred by a hundred cells: fewer are shapes.
    #[test]
    fn many_cells_are_one_picture() {
        let mut sheet = Sheet::new("many", 20.0, 20.0);
        let colour = |cell: u32| (!cell.is_multiple_of(7)).then(|| Colour::hex(cell % 251));
        sheet.cells(Cells::new([0.0; 2], [20.0; 2], 100, (0..10_000).map(colour)));
        let svg = sheet.to_svg();
        assert!(svg.contains("<image") && !svg.contains("stroke-width=\"1.02\""), "{svg}");
        assert!(!sheet.to_pdf().is_empty());
    }
}
