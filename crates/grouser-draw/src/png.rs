//! A page as a picture of pixels.

use std::collections::BTreeSet;

use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, PremultipliedColorU8,
    Rect, Stroke as Pen, StrokeDash, Transform,
};

use crate::sheet::{Cells, Colour, Glyph, Item, Outline, Place, Shape, Sheet, Step, Text};

/// Resolution of a picture: 254 dots per inch.
pub const PIXELS_PER_MM: f64 = 10.0;

/// A page as pixels, row by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// How many pixels it is wide.
    pub width: u32,
    /// How many pixels it is high.
    pub height: u32,
    /// Red, green and blue of each pixel.
    pub pixels: Vec<[u8; 3]>,
}

impl Sheet {
    /// The page as a PNG picture: in greys where it has no colours.
    #[must_use]
    pub fn to_png(&self) -> Vec<u8> {
        encoded(&self.to_picture(PIXELS_PER_MM), PIXELS_PER_MM, self.is_grey())
    }

    /// The page as pixels.
    ///
    /// * `pixels_per_mm`: the resolution
    ///
    /// # Panics
    ///
    /// If the page is not one pixel wide and high.
    #[must_use]
    pub fn to_picture(&self, pixels_per_mm: f64) -> Picture {
        let [width, height] =
            [self.width, self.height].map(|length| pixels(length * pixels_per_mm));
        let mut canvas = Pixmap::new(width, height).expect("a page has a size");
        canvas.fill(colour(self.ground));
        for item in &self.items {
            match item {
                Item::Shape(shape) => draw_shape(&mut canvas, shape, pixels_per_mm),
                Item::Cells(cells) => draw_cells(&mut canvas, cells, pixels_per_mm),
                Item::Text { text, at } => draw_text(&mut canvas, text, *at, pixels_per_mm),
            }
        }
        // The page is opaque: no channel is scaled.
        let channels = |pixel: &PremultipliedColorU8| [pixel.red(), pixel.green(), pixel.blue()];
        Picture { width, height, pixels: canvas.pixels().iter().map(channels).collect() }
    }

    fn is_grey(&self) -> bool {
        let is_grey = |item: &Item| match item {
            Item::Shape(shape) => {
                shape.fill.is_none_or(Colour::is_grey)
                    && shape.stroke.is_none_or(|stroke| stroke.colour.is_grey())
            }
            Item::Cells(cells) => cells.colours.iter().flatten().all(|colour| colour.is_grey()),
            Item::Text { text, .. } => text.colour.is_grey(),
        };
        self.ground.is_grey() && self.items.iter().all(is_grey)
    }
}

impl Picture {
    /// The picture as PNG, in colours.
    ///
    /// * `pixels_per_mm`: its resolution on paper
    #[must_use]
    pub fn to_png(&self, pixels_per_mm: f64) -> Vec<u8> {
        encoded(self, pixels_per_mm, false)
    }
}

fn encoded(picture: &Picture, pixels_per_mm: f64, is_grey: bool) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, picture.width, picture.height);
    encoder.set_color(if is_grey { png::ColorType::Grayscale } else { png::ColorType::Rgb });
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    let per_metre = pixels(1000.0 * pixels_per_mm);
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header().expect("memory takes what is written");
    let channels = if is_grey { 1 } else { 3 };
    let data: Vec<u8> =
        picture.pixels.iter().flat_map(|pixel| pixel.iter().take(channels)).copied().collect();
    writer.write_image_data(&data).expect("there are all channels of each pixel");
    writer.finish().expect("memory takes what is written");
    bytes
}

/// Cells as a PNG picture, a pixel each; empty ones are transparent. Few colours are a palette.
pub(crate) fn png_of(cells: &Cells) -> Vec<u8> {
    let known: BTreeSet<[u8; 4]> =
        cells.colours.iter().map(Option::as_ref).map(channels_of).collect();
    let palette: Vec<[u8; 4]> = known.into_iter().collect();
    let [width, height] =
        [cells.columns, cells.rows()].map(|it| u32::try_from(it).expect("a page has fewer cells"));
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    let channels = cells.colours.iter().map(Option::as_ref).map(channels_of);
    let data: Vec<u8> = if palette.len() <= 256 {
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_palette(palette.iter().flat_map(|it| &it[..3]).copied().collect::<Vec<_>>());
        encoder.set_trns(palette.iter().map(|it| it[3]).collect::<Vec<_>>());
        let place = |it: [u8; 4]| palette.binary_search(&it).unwrap_or_default();
        #[expect(clippy::cast_possible_truncation, reason = "at most 256 colours")]
        channels.map(|it| place(it) as u8).collect()
    } else {
        encoder.set_color(png::ColorType::Rgba);
        channels.flatten().collect()
    };
    let mut writer = encoder.write_header().expect("memory takes what is written");
    writer.write_image_data(&data).expect("there are all channels of each pixel");
    writer.finish().expect("memory takes what is written");
    bytes
}

/// Red, green, blue and what it hides of a cell's colour.
pub(crate) fn channels_of(colour: Option<&Colour>) -> [u8; 4] {
    let Some(colour) = colour else { return [0; 4] };
    let [red, green, blue] = colour.bytes();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
    let hides = (255.0 * colour.hides()).round() as u8;
    [red, green, blue, hides]
}

fn draw_shape(canvas: &mut Pixmap, shape: &Shape, pixels_per_mm: f64) {
    let mut builder = PathBuilder::new();
    match &shape.outline {
        Outline::Points { points, closed } => {
            for (index, point) in points.iter().enumerate() {
                let [x, y] = point.map(|length| single(length * pixels_per_mm));
                if index == 0 {
                    builder.move_to(x, y);
                } else {
                    builder.line_to(x, y);
                }
            }
            if *closed {
                builder.close();
            }
        }
        Outline::Circle { centre, radius } => {
            let [x, y] = centre.map(|length| single(length * pixels_per_mm));
            builder.push_circle(x, y, single(radius * pixels_per_mm));
        }
    }
    // A single point is no path, and shows nothing.
    let Some(path) = builder.finish() else { return };
    if let Some(colour) = shape.fill {
        fill(canvas, &path, colour, Transform::identity());
    }
    if let Some(stroke) = shape.stroke {
        let dash = stroke.dash.and_then(|lengths| {
            let lengths = lengths.map(|length| single(length * pixels_per_mm));
            StrokeDash::new(lengths.to_vec(), 0.0)
        });
        let pen = Pen {
            width: single(stroke.width * pixels_per_mm),
            line_cap: if stroke.round { LineCap::Round } else { LineCap::Butt },
            line_join: if stroke.round { LineJoin::Round } else { LineJoin::Miter },
            dash,
            ..Pen::default()
        };
        canvas.stroke_path(&path, &paint(stroke.colour), &pen, Transform::identity(), None);
    }
}

/// Cells with edges between pixels, so that none shines through between them.
fn draw_cells(canvas: &mut Pixmap, cells: &Cells, pixels_per_mm: f64) {
    let [width, height] = cells.cell();
    let edge = |start: f64, length: f64, count: usize| {
        single(((start + length * count as f64) * pixels_per_mm).round())
    };
    for run in cells.runs() {
        let [left, right] =
            [run.first, run.first + run.count].map(|at| edge(cells.place[0], width, at));
        let [top, bottom] = [run.row, run.row + 1].map(|at| edge(cells.place[1], height, at));
        // A cell of less than a pixel may have no area.
        if let Some(area) = Rect::from_ltrb(left, top, right, bottom) {
            canvas.fill_rect(area, &paint(run.colour), Transform::identity(), None);
        }
    }
}

fn draw_text(canvas: &mut Pixmap, text: &Text, at: Place, pixels_per_mm: f64) {
    let ([x, y], [right, down]) = text.base_line(at);
    let scale = text.size / text.face.units();
    let per_unit = scale * pixels_per_mm;
    let mut gone = 0.0;
    for letter in text.content.chars() {
        let glyph = text.face.glyph(letter);
        let origin = [x + gone * scale * right, y + gone * scale * down];
        gone += glyph.advance;
        let Some(path) = outline(&glyph) else { continue };
        let [tx, ty] = origin.map(|length| single(length * pixels_per_mm));
        // Letters are upright with y up; the page has y down.
        let [a, b] = [right * per_unit, down * per_unit].map(single);
        let place = Transform::from_row(a, b, b, -a, tx, ty);
        fill(canvas, &path, text.colour, place);
    }
}

fn outline(glyph: &Glyph) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for step in &glyph.outline {
        match *step {
            Step::Move([x, y]) => builder.move_to(x, y),
            Step::Line([x, y]) => builder.line_to(x, y),
            Step::Curve([u, v], [x, y]) => builder.quad_to(u, v, x, y),
            Step::Close => builder.close(),
        }
    }
    builder.finish()
}

fn fill(canvas: &mut Pixmap, path: &Path, colour: Colour, place: Transform) {
    canvas.fill_path(path, &paint(colour), FillRule::Winding, place, None);
}

fn paint(with: Colour) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color(colour(with));
    paint
}

fn colour(colour: Colour) -> Color {
    let [red, green, blue] = colour.parts().map(single);
    Color::from_rgba(red, green, blue, single(colour.hides())).unwrap_or(Color::BLACK)
}

/// A page has thousands of pixels: well within what the narrower types hold.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
fn pixels(length: f64) -> u32 {
    length.round() as u32
}

#[expect(clippy::cast_possible_truncation)]
fn single(value: f64) -> f32 {
    value as f32
}
