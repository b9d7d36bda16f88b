//! Printed pages: each drawn once, in millimetres, and written as SVG, PDF or PNG; several make one PDF.
//!
//! A [`Sheet`] holds shapes and lines of text. Its letters are outlines of a font that comes along
//! (DejaVu Sans Condensed), so that the page looks the same on a machine without fonts, and the same page has the
//! same bytes; text can still be searched and copied from SVG and PDF.
//!
//! ```
//! use grouser_page::{Face, Sheet, Text};
//!
//! let mut sheet = Sheet::new("A page", 210.0, 297.0);
//! sheet.text(Text::new("13°", 10.0).face(Face::Bold), [20.0, 30.0]);
//! assert!(sheet.to_svg().contains("13°"));
//! assert!(sheet.to_pdf().starts_with(b"%PDF-"));
//! ```

mod colour;
mod font;
mod markup;
mod pdf;
mod png;
mod sheet;
mod svg;

pub use colour::{BLACK, Colour, WHITE};
pub use font::{Face, width, wrap};
pub use markup::markup;
pub use pdf::pdf_of;
pub use png::{PIXELS_PER_MM, Picture};
pub use sheet::{Anchor, Place, Shape, Sheet, Stroke, Text};
