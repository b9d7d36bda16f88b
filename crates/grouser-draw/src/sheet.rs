//! The shapes and texts of a page.

mod cells;
mod colour;
mod font;
mod markup;

pub use self::cells::Cells;
pub use self::colour::{BLACK, Colour, WHITE};
pub(crate) use self::font::{FACES, Glyph, Step};
pub use self::font::{Face, width, wrap};
pub use self::markup::markup;

/// A place on the page, or a way across it: to the right, and down [mm].
pub type Place = [f64; 2];

/// A page.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    pub(crate) title: String,
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) ground: Colour,
    pub(crate) items: Vec<Item>,
}

/// What is on it, from the back to the front.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Item {
    Shape(Shape),
    Cells(Cells),
    Text { text: Text, at: Place },
}

/// A line through points, or the area that they enclose; or a circle.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    pub(crate) outline: Outline,
    pub(crate) fill: Option<Colour>,
    pub(crate) stroke: Option<Stroke>,
}

/// The form of a shape.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Outline {
    Points { points: Vec<Place>, closed: bool },
    Circle { centre: Place, radius: f64 },
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Its width [mm].
    pub width: f64,
    /// Its colour.
    pub colour: Colour,
    /// Lengths of a dash, a gap, the next dash and the next gap [mm].
    pub dash: Option<[f64; 4]>,
    /// Whether its ends and corners are round; otherwise ends are cut square and corners are sharp.
    pub round: bool,
}

impl Stroke {
    /// A full line.
    #[must_use]
    pub const fn new(width: f64, colour: Colour) -> Self {
        Self { width, colour, dash: None, round: false }
    }

    /// A full black line.
    #[must_use]
    pub const fn black(width: f64) -> Self {
        Self::new(width, BLACK)
    }

    /// A full grey line.
    #[must_use]
    pub const fn grey(width: f64, level: f64) -> Self {
        Self::new(width, Colour::grey(level))
    }

    /// The same, dashed.
    #[must_use]
    pub const fn dashed(self, on: f64, off: f64) -> Self {
        Self { dash: Some([on, off, on, off]), ..self }
    }

    /// The same with dashes and dots by turns.
    ///
    /// * `off`: gap after each [mm]
    /// * `dot`: length of a dot [mm]
    #[must_use]
    pub const fn dash_dotted(self, on: f64, off: f64, dot: f64) -> Self {
        Self { dash: Some([on, off, dot, off]), ..self }
    }

    /// The same with round ends and corners.
    #[must_use]
    pub const fn rounded(self) -> Self {
        Self { round: true, ..self }
    }
}

impl Shape {
    /// A line through points.
    #[must_use]
    pub fn line(points: impl IntoIterator<Item = Place>, stroke: Stroke) -> Self {
        let outline = Outline::Points { points: points.into_iter().collect(), closed: false };
        Self { outline, fill: None, stroke: Some(stroke) }
    }

    /// An area.
    #[must_use]
    pub fn area(points: impl IntoIterator<Item = Place>, fill: Colour) -> Self {
        let outline = Outline::Points { points: points.into_iter().collect(), closed: true };
        Self { outline, fill: Some(fill), stroke: None }
    }

    /// A filled circle.
    #[must_use]
    pub const fn circle(centre: Place, radius: f64, fill: Colour) -> Self {
        Self { outline: Outline::Circle { centre, radius }, fill: Some(fill), stroke: None }
    }

    /// A rectangle by its upper left corner and its size.
    #[must_use]
    pub fn rectangle([left, top]: Place, [width, height]: Place, fill: Colour) -> Self {
        let (right, bottom) = (left + width, top + height);
        Self::area([[left, top], [right, top], [right, bottom], [left, bottom]], fill)
    }

    /// The same elsewhere and in another size.
    fn placed(&self, at: &impl Fn(Place) -> Place, scale: f64) -> Self {
        let outline = match &self.outline {
            Outline::Points { points, closed } => Outline::Points {
                points: points.iter().map(|it| at(*it)).collect(),
                closed: *closed,
            },
            Outline::Circle { centre, radius } => {
                Outline::Circle { centre: at(*centre), radius: scale * radius }
            }
        };
        let stroke = self.stroke.map(|stroke| Stroke {
            width: scale * stroke.width,
            dash: stroke.dash.map(|lengths| lengths.map(|length| scale * length)),
            ..stroke
        });
        Self { outline, fill: self.fill, stroke }
    }

    /// Only the line around it.
    #[must_use]
    pub fn unfilled(self) -> Self {
        Self { fill: None, ..self }
    }

    /// The same area with a line around it.
    #[must_use]
    pub fn outlined(self, stroke: Stroke) -> Self {
        Self { stroke: Some(stroke), ..self }
    }
}

/// Where a text's place is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Anchor {
    /// At its start.
    #[default]
    Start,
    /// In its middle.
    Middle,
    /// At its end.
    End,
}

/// A line of text.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    pub(crate) content: String,
    /// Height of the font [mm]; a capital is 0.73 of it.
    pub(crate) size: f64,
    pub(crate) face: Face,
    pub(crate) colour: Colour,
    anchor: Anchor,
    /// Reads from the bottom up.
    pub(crate) upright: bool,
}

impl Text {
    /// Text in a regular face, black, starting at its place. Its characters are drawn as they are,
    /// from left to right: a caller that takes text from outside decides before what may be in it.
    #[must_use]
    pub fn new(content: impl Into<String>, size: f64) -> Self {
        Self {
            content: content.into(),
            size,
            face: Face::Regular,
            colour: BLACK,
            anchor: Anchor::Start,
            upright: false,
        }
    }

    /// The same in another face.
    #[must_use]
    pub fn face(self, face: Face) -> Self {
        Self { face, ..self }
    }

    /// The same in another colour.
    #[must_use]
    pub fn colour(self, colour: Colour) -> Self {
        Self { colour, ..self }
    }

    /// The same with its place elsewhere.
    #[must_use]
    pub fn anchor(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    /// The same, read from the bottom up.
    #[must_use]
    pub fn upright(self) -> Self {
        Self { upright: true, ..self }
    }

    /// How wide it is [mm].
    #[must_use]
    pub fn width(&self) -> f64 {
        width(&self.content, self.face, self.size)
    }

    /// How far left of its place it starts [mm].
    fn offset(&self) -> f64 {
        match self.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => self.width() / 2.0,
            Anchor::End => self.width(),
        }
    }

    /// Where its base line starts, and the way along it for a millimetre of text.
    pub(crate) fn base_line(&self, at: Place) -> (Place, Place) {
        let offset = self.offset();
        if self.upright {
            ([at[0], at[1] + offset], [0.0, -1.0])
        } else {
            ([at[0] - offset, at[1]], [1.0, 0.0])
        }
    }
}

impl Sheet {
    /// An empty white page of a size [mm].
    #[must_use]
    pub fn new(title: &str, width: f64, height: f64) -> Self {
        Self { title: title.to_owned(), width, height, ground: WHITE, items: Vec::new() }
    }

    /// The same page on a ground of another colour.
    #[must_use]
    pub fn on(self, ground: Colour) -> Self {
        Self { ground, ..self }
    }

    /// Width and height of the page [mm].
    #[must_use]
    pub fn size(&self) -> [f64; 2] {
        [self.width, self.height]
    }

    /// The title of the page.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Draws a shape; one of less than two points shows nothing.
    pub fn draw(&mut self, shape: Shape) {
        if matches!(&shape.outline, Outline::Points { points, .. } if points.len() < 2) {
            return;
        }
        self.items.push(Item::Shape(shape));
    }

    /// Draws a grid of cells.
    pub fn cells(&mut self, cells: Cells) {
        self.items.push(Item::Cells(cells));
    }

    /// Writes a line of text with its base line at a place.
    pub fn text(&mut self, text: Text, at: Place) {
        self.items.push(Item::Text { text, at });
    }

    /// Draws all that is on another page, larger or smaller, with its upper left corner at a place.
    pub fn place(&mut self, page: &Self, corner: Place, scale: f64) {
        let at = |[x, y]: Place| [corner[0] + scale * x, corner[1] + scale * y];
        let item = |item: &Item| match item {
            Item::Shape(shape) => Item::Shape(shape.placed(&at, scale)),
            Item::Cells(cells) => Item::Cells(Cells {
                place: at(cells.place),
                size: cells.size.map(|side| scale * side),
                ..cells.clone()
            }),
            Item::Text { text, at: place } => Item::Text {
                text: Text { size: scale * text.size, ..text.clone() },
                at: at(*place),
            },
        };
        self.items.extend(page.items.iter().map(item));
    }

    /// Fills a rectangle with parallel lines that rise to the right at 45°.
    ///
    /// * `distance`: from line to line, along the rectangle's edge [mm]
    pub fn hatch(
        &mut self,
        [left, top]: Place,
        [width, height]: Place,
        distance: f64,
        stroke: Stroke,
    ) {
        // The line that starts at (left + c, bottom) and rises is x + y = c, y counted upwards.
        let mut c = distance / 2.0 - height;
        while c < width {
            let start = c.max(0.0);
            let end = (c + height).min(width);
            let at = |x: f64| [left + x, top + height - (x - c)];
            self.draw(Shape::line([at(start), at(end)], stroke));
            c += distance;
        }
    }
}
