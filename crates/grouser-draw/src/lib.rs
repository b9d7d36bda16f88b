//! All pictures of Grouser: sheets as SVG, PDF or PNG, charts, drawings of the theory, maps, and
//! animations of runs.
//!
//! A [`Sheet`] holds shapes and lines of text in millimetres. Its letters are outlines of a font
//! that comes along (DejaVu Sans Condensed), so that it looks the same on a machine without fonts,
//! and the same sheet has the same bytes; text can still be searched and copied from SVG and PDF.
//! Everything else is drawn on sheets: a [`chart`] is data, [`drawings`] and animations show
//! recorded results. None of them computes a force.
//!
//! Colours are named by what they stand for ([`style`]), so that every picture has a light and a
//! dark form, and all of them look alike.
//!
//! ```
//! use grouser_draw::style::{Ground, Role};
//! use grouser_draw::{Face, Shape, Sheet, Text};
//!
//! let ground = Ground::Dark;
//! let mut sheet = Sheet::new("A slope", 40.0, 30.0).on(Role::Paper.on(ground));
//! sheet.draw(Shape::area([[0.0, 30.0], [40.0, 10.0], [40.0, 30.0]], Role::Soil.on(ground)));
//! sheet.text(Text::new("13°", 5.0).face(Face::Bold).colour(Role::Ink.on(ground)), [4.0, 8.0]);
//! assert!(sheet.to_svg().contains("13°"));
//! assert!(sheet.to_pdf().starts_with(b"%PDF-"));
//! ```

mod animation;
mod camera;
pub mod chart;
pub mod drawings;
mod forces;
mod form;
mod gif;
mod glb;
mod html;
pub mod labels;
pub mod map;
mod marks;
pub mod motion;
mod mp4;
mod outline;
mod path;
mod pdf;
mod png;
mod relief;
pub mod rover;
mod scale;
mod scene;
mod sheet;
mod shown;
mod slide;
mod step;
pub mod style;
mod svg;
mod title;

pub use animation::Animation;
pub use forces::newtons_per_metre;
pub use form::{Form, UnknownEnding};
pub use mp4::VideoError;
pub use outline::{draw_outline, reach};
pub use path::path_of;
pub use pdf::pdf_of;
pub use png::{PIXELS_PER_MM, Picture};
pub use relief::{relief_of, shade_of};
pub use scale::{Scale, Stop};
pub use sheet::{
    Anchor, BLACK, Cells, Colour, Face, Place, Shape, Sheet, Stroke, Text, WHITE, markup, width,
    wrap,
};
pub use shown::Shown;
pub use slide::Slide;
pub use step::round_step;
pub use svg::{base64, from_base64};
pub use title::title_of;
