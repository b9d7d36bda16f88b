//! An animation as a film in H.264, which an installed ffmpeg makes of the pictures.

use std::fs;
use std::io::{ErrorKind, Write as _};
use std::process::{Command, Stdio};

use crate::animation::{Animation, RATE, STAYS};
use crate::shown::WIDTH;
use crate::style::Ground;

/// Width of the film [px].
const PIXELS: f64 = 1280.0;

/// Why there is no film.
#[derive(Debug, thiserror::Error)]
pub enum VideoError {
    /// There is no such program.
    #[error(
        "an .mp4 is made by ffmpeg, which is not installed: install it (such as by `apt install \
         ffmpeg` or `brew install ffmpeg`), or write a .gif or .html"
    )]
    NoProgram,
    /// It did not make a film.
    #[error("ffmpeg made no film: {0}")]
    Failed(String),
    /// It could not be talked to.
    #[error("ffmpeg made no film: {0}")]
    System(#[from] std::io::Error),
}

impl Animation {
    /// The animation as a film, 1280 pixels wide.
    ///
    /// * `go_on`: called before each picture
    ///
    /// # Errors
    /// [`VideoError`] if ffmpeg is missing or fails.
    pub fn to_mp4(&self, ground: Ground, go_on: &mut dyn FnMut()) -> Result<Vec<u8>, VideoError> {
        let scale = PIXELS / WIDTH;
        let folder = tempfile::tempdir()?;
        let film = folder.path().join("film.mp4");
        let first = self.picture(0, ground).to_picture(scale);
        let mut ffmpeg = Command::new("ffmpeg");
        ffmpeg.args(["-hide_banner", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24"]);
        ffmpeg.arg("-s").arg(format!("{}x{}", first.width, first.height));
        ffmpeg.arg("-r").arg(RATE.to_string()).args(["-i", "-"]);
        // Players want even numbers of pixels, and colours at half the resolution.
        ffmpeg.args(["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"]);
        ffmpeg.args(["-c:v", "libx264", "-crf", "18", "-threads", "1"]);
        // The same pictures give the same bytes.
        ffmpeg.args(["-fflags", "+bitexact", "-flags:v", "+bitexact", "-movflags", "+faststart"]);
        ffmpeg.arg(&film).stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
        let mut child = ffmpeg.spawn().map_err(|error| match error.kind() {
            ErrorKind::NotFound => VideoError::NoProgram,
            _ => error.into(),
        })?;
        let mut written = Ok(());
        if let Some(mut input) = child.stdin.take() {
            for (index, picture) in self.pictures(ground, scale).enumerate() {
                go_on();
                let times = if index + 1 == self.len() { STAYS } else { 1 };
                let bytes = picture.pixels.as_flattened();
                for _ in 0..times {
                    written = written.and_then(|()| input.write_all(bytes));
                }
                if written.is_err() {
                    break;
                }
            }
        }
        let output = child.wait_with_output()?;
        if !output.status.success() {
            let said = String::from_utf8_lossy(&output.stderr);
            let last = said.lines().last().unwrap_or("it gave no reason");
            return Err(VideoError::Failed(last.escape_default().to_string()));
        }
        written?;
        Ok(fs::read(film)?)
    }
}
