//! What an animation is written as, by the ending of its file's name.

use std::path::Path;

use crate::animation::Animation;
use crate::mp4::VideoError;
use crate::shown::WIDTH;
use crate::style::Ground;

/// Width of a single picture [px].
const PIXELS: f64 = 1600.0;

/// What an animation is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Pictures for pages and slides.
    Gif,
    /// A film, by an installed ffmpeg.
    Mp4,
    /// A page with a player.
    Html,
    /// A scene in three dimensions, binary glTF 2.0.
    Glb,
    /// The last picture, as drawn.
    Svg,
    /// The last picture, in pixels.
    Png,
}

/// The ending of a name is not that of a form.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the ending decides what is written: `.gif`, `.mp4`, `.html` or `.glb` for the run, `.svg` or \
     `.png` for its last picture"
)]
pub struct UnknownEnding;

impl Form {
    /// All of them.
    pub const ALL: [Self; 6] = [Self::Gif, Self::Mp4, Self::Html, Self::Glb, Self::Svg, Self::Png];

    /// The ending of its files' names, without a dot.
    #[must_use]
    pub const fn ending(self) -> &'static str {
        match self {
            Self::Gif => "gif",
            Self::Mp4 => "mp4",
            Self::Html => "html",
            Self::Glb => "glb",
            Self::Svg => "svg",
            Self::Png => "png",
        }
    }

    /// The form that a file's name asks for.
    ///
    /// # Errors
    /// [`UnknownEnding`] if its ending is not that of a form.
    pub fn of_path(path: &Path) -> Result<Self, UnknownEnding> {
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        let ending = ending.to_ascii_lowercase();
        Self::ALL.into_iter().find(|form| form.ending() == ending).ok_or(UnknownEnding)
    }
}

impl Animation {
    /// The animation in a form, on a light ground; pages are dark where their reader's browser is.
    ///
    /// * `go_on`: called before each picture of a film or a GIF
    ///
    /// # Errors
    /// [`VideoError`] if a film is asked for and ffmpeg is missing or fails.
    pub fn to_bytes(&self, form: Form, go_on: &mut dyn FnMut()) -> Result<Vec<u8>, VideoError> {
        let last = || self.picture(self.len() - 1, Ground::Light);
        Ok(match form {
            Form::Gif => self.to_gif(Ground::Light, go_on),
            Form::Mp4 => return self.to_mp4(Ground::Light, go_on),
            Form::Html => self.to_html().into_bytes(),
            Form::Glb => self.to_glb(),
            Form::Svg => last().to_svg().into_bytes(),
            Form::Png => last().to_picture(PIXELS / WIDTH).to_png(PIXELS / WIDTH),
        })
    }
}
