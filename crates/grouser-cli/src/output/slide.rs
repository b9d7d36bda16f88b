//! An answer as a slide: the file of `--slide`.

use std::ffi::OsString;
use std::path::Path;

use grouser::answers::Answer;
use grouser::document::escape;
use grouser_draw::{Sheet, Slide};

use super::file;
use crate::args::SlideArgs;
use crate::failure::Failure;

/// Makes a file of a sheet.
type Writer = fn(&Sheet) -> Vec<u8>;

/// Forms of a slide, by what the file's name ends in.
const FORMS: [(&str, Writer); 3] =
    [("svg", |sheet| sheet.to_svg().into_bytes()), ("png", Sheet::to_png), ("pdf", Sheet::to_pdf)];

/// A file that a slide is to be written to.
pub(crate) struct SlideFile<'a> {
    file: &'a Path,
    write: Writer,
}

impl<'a> SlideFile<'a> {
    /// The file that is asked for, if one is: checked before anything is computed.
    ///
    /// * `may_replace`: whether a file that is there is replaced
    pub(crate) fn of(args: &'a SlideArgs, may_replace: bool) -> Result<Option<Self>, Failure> {
        let Some(file) = args.slide.as_deref() else { return Ok(None) };
        let ending = file.extension().map(|it| it.to_string_lossy().to_lowercase());
        let form = FORMS.iter().find(|(known, _)| ending.as_deref() == Some(*known));
        let Some((_, write)) = form else {
            return Err(Failure::Usage(format!(
                "--slide {}: a slide ends in .svg, .png or .pdf",
                escape::path(file)
            )));
        };
        file::check_new(file, may_replace)?;
        Ok(Some(Self { file, write: *write }))
    }

    /// Writes a slide.
    ///
    /// * `says`: its sentence
    /// * `whose`: rover and soil
    pub(crate) fn write(&self, says: &str, picture: &Sheet, whose: &str) -> Result<(), Failure> {
        let command = command(std::env::args_os().skip(1));
        let slide = Slide::of_answer(says, picture, whose, command);
        file::write_result(self.file, &(self.write)(&slide))
    }

    /// Writes the first sentence and the first figure of an answer that has a page.
    pub(crate) fn write_answer(&self, answer: &Answer, whose: &str) -> Result<(), Failure> {
        let Some(picture) = Slide::picture_of(answer) else {
            return Err(Failure::Run("this answer has no picture for a slide".to_owned()));
        };
        self.write_over(answer, &picture, whose)
    }

    /// Writes the first sentence of an answer that has a page over a picture of one's own.
    pub(crate) fn write_over(
        &self,
        answer: &Answer,
        picture: &Sheet,
        whose: &str,
    ) -> Result<(), Failure> {
        self.write(Slide::sentence_of(answer), picture, whose)
    }
}

/// The command that was typed, without the slide's file: it gives the answer again.
///
/// * `arguments`: those after the program's name
fn command(arguments: impl Iterator<Item = OsString>) -> String {
    let mut words = vec!["grouser".to_owned()];
    let mut arguments = arguments.map(|it| it.to_string_lossy().into_owned());
    while let Some(word) = arguments.next() {
        match word.as_str() {
            "--slide" => drop(arguments.next()),
            "--force" => {}
            other if other.starts_with("--slide=") => {}
            other => words.push(quoted(other)),
        }
    }
    words.join(" ")
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let is_plain = |letter: char| letter.is_alphanumeric() || "-_./,:=+%@".contains(letter);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_is_that_which_was_typed_but_for_the_slide() {
        let typed = ["heading", "my rover.toml", "--slide", "a.svg", "--slope-deg=5,10", "--force"];
        let found = command(typed.into_iter().map(OsString::from));
        assert_eq!(found, "grouser heading 'my rover.toml' --slope-deg=5,10");
    }
}
