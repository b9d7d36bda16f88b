//! Pictures of rovers and wheels: animations of runs, drawings of the theory.
//!
//! A picture draws recorded results; it computes no force. Its colours are named by what they stand for
//! ([`style`]), so that every picture has a light and a dark form, and all of them look alike.
//!
//! ```
//! use grouser_page::{Shape, Sheet};
//! use grouser_pictures::style::{Ground, Role};
//!
//! let ground = Ground::Dark;
//! let mut sheet = Sheet::new("A slope", 40.0, 30.0).on(Role::Paper.on(ground));
//! sheet.draw(Shape::area([[0.0, 30.0], [40.0, 10.0], [40.0, 30.0]], Role::Soil.on(ground)));
//! assert!(sheet.to_svg().contains(&Role::Paper.on(ground).code()));
//! ```

mod animation;
mod camera;
pub mod drawings;
mod form;
mod gif;
mod glb;
mod html;
pub mod labels;
mod marks;
pub mod motion;
mod mp4;
mod outline;
mod path;
mod relief;
pub mod rover;
mod scene;
mod shown;
mod step;
pub mod style;
mod title;

pub use animation::Animation;
pub use form::{Form, UnknownEnding};
pub use mp4::VideoError;
pub use outline::{draw_outline, reach};
pub use path::path_of;
pub use relief::{relief_of, shade_of};
pub use shown::Shown;
pub use step::round_step;
pub use title::title_of;
