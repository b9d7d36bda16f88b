//! The letters: outlines and widths of the font that comes along.

use ttf_parser::{GlyphId, OutlineBuilder};

/// A face of the font.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Face {
    /// For reading.
    Regular,
    /// For emphasis.
    Bold,
}

/// Both of them.
pub(crate) const FACES: [Face; 2] = [Face::Regular, Face::Bold];

/// A step of an outline, in units of the font, y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Step {
    Move([f32; 2]),
    Line([f32; 2]),
    /// By one control point.
    Curve([f32; 2], [f32; 2]),
    Close,
}

/// A letter.
pub(crate) struct Glyph {
    pub(crate) outline: Vec<Step>,
    /// Way to the next letter, in units of the font.
    pub(crate) advance: f64,
}

impl Face {
    fn parsed(self) -> ttf_parser::Face<'static> {
        let bytes = match self {
            Self::Regular => dejavu::sans_condensed::regular(),
            Self::Bold => dejavu::sans_condensed::bold(),
        };
        ttf_parser::Face::parse(bytes, 0).expect("the font that comes along is one")
    }

    /// Units of the font in its height.
    pub(crate) fn units(self) -> f64 {
        f64::from(self.parsed().units_per_em())
    }

    /// Left, bottom, right and top of the box that holds every letter, in units of the font.
    pub(crate) fn bounds(self) -> [f32; 4] {
        let bounds = self.parsed().global_bounding_box();
        [bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max].map(f32::from)
    }

    /// The letter for a character; a box for one that the font does not have.
    pub(crate) fn glyph(self, character: char) -> Glyph {
        let face = self.parsed();
        let id = face.glyph_index(character).unwrap_or(GlyphId(0));
        let mut outline = Outline(Vec::new());
        // A blank has no outline.
        let _ = face.outline_glyph(id, &mut outline);
        Glyph { outline: outline.0, advance: f64::from(face.glyph_hor_advance(id).unwrap_or(0)) }
    }
}

/// Width of a text [mm].
///
/// * `size`: height of the font [mm]
#[must_use]
pub fn width(text: &str, face: Face, size: f64) -> f64 {
    let parsed = face.parsed();
    let advance = |character| {
        let id = parsed.glyph_index(character).unwrap_or(GlyphId(0));
        f64::from(parsed.glyph_hor_advance(id).unwrap_or(0))
    };
    text.chars().map(advance).sum::<f64>() * size / f64::from(parsed.units_per_em())
}

/// A text in lines that are no wider than they may be, as long as no word is.
///
/// * `most`: width of a line [mm]
#[must_use]
pub fn wrap(text: &str, face: Face, size: f64, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(&format!("{line} {word}"), face, size) <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

struct Outline(Vec<Step>);

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.0.push(Step::Move([x, y]));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.0.push(Step::Line([x, y]));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.0.push(Step::Curve([x1, y1], [x, y]));
    }

    /// TrueType has no such curves; if one came, its middle would do.
    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.0.push(Step::Curve([x1.midpoint(x2), y1.midpoint(y2)], [x, y]));
    }

    fn close(&mut self) {
        self.0.push(Step::Close);
    }
}
