//! A page as PDF: its letters are a font of outlines (Type 3), so that its text is text.

use std::collections::{BTreeMap, BTreeSet};

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{LineCapStyle, LineJoinStyle, UnicodeCmap};
use pdf_writer::writers::ExtGraphicsState;
use pdf_writer::{Content, Filter, Finish as _, Name, Pdf, Rect, Ref, Str, TextStr};

use crate::png::channels_of;
use crate::sheet::{
    Cells, Colour, FACES, Face, Item, Outline, Place, Shape, Sheet, Step, Text, WHITE,
};
use crate::svg::letters;

/// Points in a millimetre.
const POINTS: f64 = 72.0 / 25.4;
/// Effort of the compression, of 10.
const EFFORT: u8 = 8;
/// How many letters a font of this kind can have.
const MOST: usize = 255;

/// The codes of a face's letters: from 1; 0 is for letters beyond what a font can have.
type Codes = BTreeMap<char, u8>;

impl Sheet {
    /// The page as a PDF document.
    #[must_use]
    pub fn to_pdf(&self) -> Vec<u8> {
        pdf_of(std::slice::from_ref(self))
    }
}

/// Pages as one PDF document, with the title of the first; one page at least.
#[must_use]
pub fn pdf_of(sheets: &[Sheet]) -> Vec<u8> {
    let mut next = 0;
    let mut id = || {
        next += 1;
        Ref::new(next)
    };
    let [catalog, pages, info] = [id(), id(), id()];
    let kids: Vec<Ref> = sheets.iter().map(|_| id()).collect();
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(pages);
    let count = i32::try_from(kids.len()).unwrap_or(i32::MAX);
    pdf.pages(pages).kids(kids.iter().copied()).count(count);
    let title = sheets.first().map_or("", |sheet| &sheet.title);
    pdf.document_info(info).title(TextStr(title)).producer(TextStr("Grouser"));
    for (sheet, page) in sheets.iter().zip(kids) {
        write_page(&mut pdf, sheet, [pages, page], &mut id);
    }
    pdf.finish()
}

fn write_page(pdf: &mut Pdf, sheet: &Sheet, [pages, page]: [Ref; 2], id: &mut impl FnMut() -> Ref) {
    let content = id();
    let codes: BTreeMap<Face, Codes> =
        FACES.iter().map(|face| (*face, codes(sheet, *face))).collect();
    let fonts: Vec<(Face, Ref)> = FACES.iter().map(|face| (*face, id())).collect();
    let [width, height] = [sheet.width, sheet.height].map(|length| single(length * POINTS));
    let mut writer = pdf.page(page);
    writer.media_box(Rect::new(0.0, 0.0, width, height)).parent(pages).contents(content);
    let mut resources = writer.resources();
    let mut named = resources.fonts();
    for (face, font) in &fonts {
        named.pair(name(*face), *font);
    }
    named.finish();
    let veils = veils(sheet);
    if !veils.is_empty() {
        let mut states = resources.ext_g_states();
        for percent in veils {
            let share = f32::from(percent) / 100.0;
            let mut state =
                states.insert(Name(veil(percent).as_bytes())).start::<ExtGraphicsState>();
            state.non_stroking_alpha(share).stroking_alpha(share);
        }
    }
    let pictures: Vec<(&Cells, [Ref; 2])> =
        pictures(sheet).map(|cells| (cells, [id(), id()])).collect();
    if !pictures.is_empty() {
        let mut named = resources.x_objects();
        for (place, (_, [picture, _])) in pictures.iter().enumerate() {
            named.pair(Name(picture_name(place).as_bytes()), *picture);
        }
    }
    resources.finish();
    writer.finish();
    for (cells, ids) in pictures {
        write_picture(pdf, cells, ids);
    }
    let drawn = compress_to_vec_zlib(&drawing(sheet, &codes), EFFORT);
    pdf.stream(content, &drawn).filter(Filter::FlateDecode);
    for (face, font) in fonts {
        write_font(pdf, face, font, &codes[&face], id);
    }
}

/// Grids of so many cells that they are pictures.
fn pictures(sheet: &Sheet) -> impl Iterator<Item = &Cells> {
    sheet.items.iter().filter_map(|item| match item {
        Item::Cells(cells) if cells.is_picture() => Some(cells),
        _ => None,
    })
}

fn picture_name(place: usize) -> String {
    format!("P{place}")
}

/// A picture of cells, with what each hides of the page.
fn write_picture(pdf: &mut Pdf, cells: &Cells, [picture, mask]: [Ref; 2]) {
    let size = [cells.columns, cells.rows()].map(|it| i32::try_from(it).unwrap_or(i32::MAX));
    let channels = || cells.colours.iter().map(Option::as_ref).map(channels_of);
    let colours: Vec<u8> =
        channels().flat_map(|[red, green, blue, _]| [red, green, blue]).collect();
    let hides: Vec<u8> = channels().map(|[.., hides]| hides).collect();
    let [colours, hides] = [colours, hides].map(|it| compress_to_vec_zlib(&it, EFFORT));
    let mut image = pdf.image_xobject(picture, &colours);
    image.filter(Filter::FlateDecode);
    image.width(size[0]).height(size[1]).bits_per_component(8);
    image.color_space().device_rgb();
    image.s_mask(mask);
    image.finish();
    let mut image = pdf.image_xobject(mask, &hides);
    image.filter(Filter::FlateDecode);
    image.width(size[0]).height(size[1]).bits_per_component(8);
    image.color_space().device_gray();
    image.finish();
}

fn codes(sheet: &Sheet, face: Face) -> Codes {
    let own = letters(sheet).into_iter().filter(|(of, _)| *of == face).map(|(_, letter)| letter);
    own.take(MOST).zip(1..=u8::MAX).collect()
}

fn name(face: Face) -> Name<'static> {
    match face {
        Face::Regular => Name(b"R"),
        Face::Bold => Name(b"B"),
    }
}

/// A font whose letters are drawings.
fn write_font(pdf: &mut Pdf, face: Face, font: Ref, codes: &Codes, id: &mut impl FnMut() -> Ref) {
    let units = face.units();
    let glyphs: Vec<(String, Ref, char, u8)> = std::iter::once((&'\u{fffd}', &0))
        .chain(codes)
        .map(|(letter, code)| (format!("g{code}"), id(), *letter, *code))
        .collect();
    let unicode = id();
    let advances = glyphs.iter().map(|(_, _, letter, _)| single(face.glyph(*letter).advance));
    let mut writer = pdf.type3_font(font);
    let [left, bottom, right, top] = face.bounds();
    writer.bbox(Rect::new(left, bottom, right, top));
    let per_unit = single(1.0 / units);
    writer.matrix([per_unit, 0.0, 0.0, per_unit, 0.0, 0.0]);
    writer.first_char(0).last_char(glyphs.last().map_or(0, |last| last.3));
    writer.widths(advances);
    let mut drawings = writer.char_procs();
    for (name, drawing, _, _) in &glyphs {
        drawings.pair(Name(name.as_bytes()), *drawing);
    }
    drawings.finish();
    let mut encoding = writer.encoding_custom();
    let mut differences = encoding.differences();
    differences.consecutive(0, glyphs.iter().map(|(name, ..)| Name(name.as_bytes())));
    differences.finish();
    encoding.finish();
    writer.to_unicode(unicode);
    writer.finish();

    let mut map = UnicodeCmap::<u8>::new(
        Name(b"Letters"),
        pdf_writer::types::SystemInfo {
            registry: Str(b"Grouser"),
            ordering: Str(b"Letters"),
            supplement: 0,
        },
    );
    for (_, drawing, letter, code) in &glyphs {
        map.pair(*code, *letter);
        let drawn = compress_to_vec_zlib(&letter_drawing(face, *letter), EFFORT);
        pdf.stream(*drawing, &drawn).filter(Filter::FlateDecode);
    }
    let text = compress_to_vec_zlib(&map.finish(), EFFORT);
    pdf.stream(unicode, &text).filter(Filter::FlateDecode);
}

fn letter_drawing(face: Face, letter: char) -> Vec<u8> {
    let glyph = face.glyph(letter);
    let mut content = Content::new();
    let ends = glyph.outline.iter().flat_map(|step| match *step {
        Step::Move(to) | Step::Line(to) => vec![to],
        Step::Curve(by, to) => vec![by, to],
        Step::Close => Vec::new(),
    });
    let [left, bottom, right, top] =
        ends.fold([0.0_f32; 4], |[l, b, r, t], [x, y]| [l.min(x), b.min(y), r.max(x), t.max(y)]);
    content.start_shape_glyph(single(glyph.advance), left, bottom, right, top);
    let mut here = [0.0; 2];
    for step in glyph.outline {
        match step {
            Step::Move(to) => {
                content.move_to(to[0], to[1]);
                here = to;
            }
            Step::Line(to) => {
                content.line_to(to[0], to[1]);
                here = to;
            }
            Step::Curve(by, to) => {
                // The cubic that is this quadratic: its control points are two thirds of the way.
                let two_thirds = |end: [f32; 2]| [0, 1].map(|k| (end[k] + 2.0 * by[k]) / 3.0);
                let [[a, b], [c, d]] = [two_thirds(here), two_thirds(to)];
                content.cubic_to(a, b, c, d, to[0], to[1]);
                here = to;
            }
            Step::Close => {
                content.close_path();
            }
        }
    }
    content.fill_nonzero();
    content.finish().to_vec()
}

fn drawing(sheet: &Sheet, codes: &BTreeMap<Face, Codes>) -> Vec<u8> {
    let mut content = Content::new();
    let place = |[x, y]: Place| [x * POINTS, (sheet.height - y) * POINTS].map(single);
    if sheet.ground != WHITE {
        let ground = Shape::rectangle([0.0, 0.0], [sheet.width, sheet.height], sheet.ground);
        draw_shape(&mut content, &ground, &place);
    }
    let mut pictures = 0;
    for item in &sheet.items {
        match item {
            Item::Shape(shape) => draw_shape(&mut content, shape, &place),
            Item::Cells(cells) if cells.is_picture() => {
                draw_picture(&mut content, cells, &picture_name(pictures), &place);
                pictures += 1;
            }
            Item::Cells(cells) => draw_cells(&mut content, cells, &place),
            Item::Text { text, at } => {
                draw_text(&mut content, text, *at, &codes[&text.face], &place);
            }
        }
    }
    content.finish().to_vec()
}

fn draw_shape(content: &mut Content, shape: &Shape, place: &impl Fn(Place) -> [f32; 2]) {
    content.save_state();
    if let Some(colour) = shape.fill {
        set_fill(content, colour);
    }
    if let Some(stroke) = shape.stroke {
        set_stroke(content, stroke.colour);
        if stroke.round {
            content.set_line_cap(LineCapStyle::RoundCap).set_line_join(LineJoinStyle::RoundJoin);
        }
        content.set_line_width(single(stroke.width * POINTS));
        if let Some(lengths) = stroke.dash {
            content.set_dash_pattern(lengths.map(|length| single(length * POINTS)), 0.0);
        }
    }
    trace(content, &shape.outline, place);
    let hides = shape.fill.or(shape.stroke.map(|stroke| stroke.colour));
    if let Some(percent) = hides.and_then(percent) {
        content.set_parameters(Name(veil(percent).as_bytes()));
    }
    match (shape.fill, shape.stroke) {
        (Some(_), Some(_)) => content.fill_nonzero_and_stroke(),
        (Some(_), None) => content.fill_nonzero(),
        (None, Some(_)) => content.stroke(),
        (None, None) => content.end_path(),
    };
    content.restore_state();
}

fn trace(content: &mut Content, outline: &Outline, place: &impl Fn(Place) -> [f32; 2]) {
    /// Control points of a quarter circle, over its radius: the curve's middle lies on the circle.
    const QUARTER: f64 = 0.552_284_75;
    match outline {
        Outline::Points { points, closed } => {
            for (index, point) in points.iter().enumerate() {
                let [x, y] = place(*point);
                if index == 0 {
                    content.move_to(x, y);
                } else {
                    content.line_to(x, y);
                }
            }
            if *closed {
                content.close_path();
            }
        }
        Outline::Circle { centre: [x, y], radius } => {
            let at = |right: f64, down: f64| place([x + radius * right, y + radius * down]);
            let [right, down] = at(1.0, 0.0);
            content.move_to(right, down);
            for [u, v] in [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]] {
                // A quarter turn on is (−v, u).
                let [a, b] = at(u - QUARTER * v, v + QUARTER * u);
                let [c, d] = at(QUARTER * u - v, QUARTER * v + u);
                let [e, f] = at(-v, u);
                content.cubic_to(a, b, c, d, e, f);
            }
            content.close_path();
        }
    }
}

/// Cells a little wider and higher than they are: readers smooth edges, and the ground would shine
/// through.
fn draw_cells(content: &mut Content, cells: &Cells, place: &impl Fn(Place) -> [f32; 2]) {
    let ([left, top], [width, height]) = (cells.place, cells.cell());
    content.save_state();
    for run in cells.runs() {
        set_fill(content, run.colour);
        let over = 1.02;
        let (x, y) = (left + run.first as f64 * width, top + (run.row as f64 + over) * height);
        let [x, y] = place([x, y]);
        let size = [(run.count as f64 + over - 1.0) * width, over * height];
        let [width, height] = size.map(|length| single(length * POINTS));
        content.rect(x, y, width, height).fill_nonzero();
    }
    content.restore_state();
}

/// A picture where its cells are: as a unit square that is made as large.
fn draw_picture(
    content: &mut Content,
    cells: &Cells,
    name: &str,
    place: &impl Fn(Place) -> [f32; 2],
) {
    let ([left, top], [width, height]) = (cells.place, cells.size);
    let [x, y] = place([left, top + height]);
    let [width, height] = [width, height].map(|length| single(length * POINTS));
    content.save_state();
    content.transform([width, 0.0, 0.0, height, x, y]);
    content.x_object(Name(name.as_bytes()));
    content.restore_state();
}

fn draw_text(
    content: &mut Content,
    text: &Text,
    at: Place,
    codes: &Codes,
    place: &impl Fn(Place) -> [f32; 2],
) {
    let (start, [right, down]) = text.base_line(at);
    let [x, y] = place(start);
    let [a, b] = [right, -down].map(single);
    let bytes: Vec<u8> =
        text.content.chars().map(|letter| codes.get(&letter).copied().unwrap_or(0)).collect();
    content.begin_text();
    set_fill(content, text.colour);
    content.set_font(name(text.face), single(text.size * POINTS));
    content.set_text_matrix([a, b, -b, a, x, y]);
    content.show(Str(&bytes));
    content.end_text();
}

fn set_fill(content: &mut Content, colour: Colour) {
    let [red, green, blue] = colour.parts().map(single);
    if colour.is_grey() {
        content.set_fill_gray(red);
    } else {
        content.set_fill_rgb(red, green, blue);
    }
}

fn set_stroke(content: &mut Content, colour: Colour) {
    let [red, green, blue] = colour.parts().map(single);
    if colour.is_grey() {
        content.set_stroke_gray(red);
    } else {
        content.set_stroke_rgb(red, green, blue);
    }
}

/// The percentages by which shapes hide what is below them. A shape has one: its fill's if it has
/// one.
fn veils(sheet: &Sheet) -> BTreeSet<u8> {
    let hides = sheet.items.iter().filter_map(|item| match item {
        Item::Shape(shape) => shape.fill.or(shape.stroke.map(|stroke| stroke.colour)),
        Item::Cells(_) | Item::Text { .. } => None,
    });
    hides.filter_map(percent).collect()
}

/// How much a colour hides, unless it hides all.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
fn percent(colour: Colour) -> Option<u8> {
    (colour.hides() < 1.0).then_some((colour.hides() * 100.0).round() as u8)
}

/// The name of a state in which shapes hide a percentage of what is below them.
fn veil(percent: u8) -> String {
    format!("V{percent}")
}

/// Lengths on a page are well within what the narrower type holds.
#[expect(clippy::cast_possible_truncation)]
fn single(value: f64) -> f32 {
    value as f32
}
