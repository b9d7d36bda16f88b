//! A page as a picture in greys.

use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke as Pen,
    StrokeDash, Transform,
};

use crate::font::{Glyph, Step};
use crate::sheet::{Grey, Item, Place, Shape, Sheet, Text};

/// Resolution of a picture: 254 dots per inch.
pub const PIXELS_PER_MM: f64 = 10.0;

impl Sheet {
    /// The page as a PNG picture in greys.
    #[must_use]
    pub fn to_png(&self) -> Vec<u8> {
        write(self)
    }
}

fn write(sheet: &Sheet) -> Vec<u8> {
    let [width, height] = [sheet.width, sheet.height].map(pixels);
    let mut canvas = Pixmap::new(width, height).expect("a page has a size");
    canvas.fill(Color::WHITE);
    for item in &sheet.items {
        match item {
            Item::Shape(shape) => draw_shape(&mut canvas, shape),
            Item::Text { text, at } => draw_text(&mut canvas, text, *at),
        }
    }
    // The page is opaque, and all its colours are greys: any channel is the grey.
    let greys: Vec<u8> = canvas.pixels().iter().map(|pixel| pixel.red()).collect();
    encoded(&greys, [width, height])
}

fn encoded(greys: &[u8], [width, height]: [u32; 2]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    let per_metre = pixels(1000.0);
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header().expect("memory takes what is written");
    writer.write_image_data(greys).expect("there is a grey for each pixel");
    writer.finish().expect("memory takes what is written");
    bytes
}

fn draw_shape(canvas: &mut Pixmap, shape: &Shape) {
    let mut builder = PathBuilder::new();
    for (index, point) in shape.points.iter().enumerate() {
        let [x, y] = point.map(|length| single(length * PIXELS_PER_MM));
        if index == 0 {
            builder.move_to(x, y);
        } else {
            builder.line_to(x, y);
        }
    }
    if shape.closed {
        builder.close();
    }
    // A single point is no path, and shows nothing.
    let Some(path) = builder.finish() else { return };
    if let Some(grey) = shape.fill {
        fill(canvas, &path, grey, Transform::identity());
    }
    if let Some(stroke) = shape.stroke {
        let dash = stroke.dash.and_then(|lengths| {
            let lengths = lengths.map(|length| single(length * PIXELS_PER_MM));
            StrokeDash::new(lengths.to_vec(), 0.0)
        });
        let pen = Pen {
            width: single(stroke.width * PIXELS_PER_MM),
            line_cap: LineCap::Butt,
            line_join: LineJoin::Miter,
            dash,
            ..Pen::default()
        };
        canvas.stroke_path(&path, &paint(stroke.grey), &pen, Transform::identity(), None);
    }
}

fn draw_text(canvas: &mut Pixmap, text: &Text, at: Place) {
    let ([x, y], [right, down]) = text.base_line(at);
    let scale = text.size / text.face.units();
    let per_unit = scale * PIXELS_PER_MM;
    let mut gone = 0.0;
    for letter in text.content.chars() {
        let glyph = text.face.glyph(letter);
        let origin = [x + gone * scale * right, y + gone * scale * down];
        gone += glyph.advance;
        let Some(path) = outline(&glyph) else { continue };
        let [tx, ty] = origin.map(|length| single(length * PIXELS_PER_MM));
        // Letters are upright with y up; the page has y down.
        let [a, b] = [right * per_unit, down * per_unit].map(single);
        let place = Transform::from_row(a, b, b, -a, tx, ty);
        fill(canvas, &path, text.grey, place);
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

fn fill(canvas: &mut Pixmap, path: &Path, grey: Grey, place: Transform) {
    canvas.fill_path(path, &paint(grey), FillRule::Winding, place, None);
}

fn paint(grey: Grey) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    let level = single(grey.clamp(0.0, 1.0));
    paint.set_color(Color::from_rgba(level, level, level, 1.0).unwrap_or(Color::BLACK));
    paint
}

/// A page has thousands of pixels: well within what the narrower types hold.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
fn pixels(length: f64) -> u32 {
    (length * PIXELS_PER_MM).round() as u32
}

#[expect(clippy::cast_possible_truncation)]
fn single(value: f64) -> f32 {
    value as f32
}
