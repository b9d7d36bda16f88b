//! The page of a map.

use std::sync::Arc;

use serde_json::Value;

use super::super::{Answer, PageBlock, meanings, setting};
use super::files::MapFile;
use super::question::MapQuestion;
use crate::document::columns::map::{HEADING, VERDICT, bands};
use crate::document::columns::{POWER, SINKAGE, SLIP_RATIO, SLOPE};
use crate::document::reading::four_digits;
use crate::document::table::Table;
use crate::studies::mobility::CourseChoice;

impl MapQuestion<'_> {
    /// The page, but for what all pages end with.
    ///
    /// * `errors`: how far numbers of the map are from those of its curves, at most
    /// * `advice`: for each class of slopes
    /// * `verdict`: what the map comes to
    pub(super) fn page(
        &self,
        answer: &mut Answer,
        files: &[MapFile],
        (errors, advice): (&Value, &Arc<Table>),
        verdict: String,
    ) {
        answer.verdict(verdict);
        answer.list(setting(&self.scenario.document).into_iter().chain([self.of_course()]));
        let of = |name: &str| files.iter().find(|file| file.name == name);
        [VERDICT, SLOPE.name].into_iter().filter_map(of).for_each(|file| picture(answer, file));
        answer.heading("What to do on each slope");
        answer.words(
            "A place has the verdict of the slope above its own; the operator's card of the \
                      same rover and soil says the same of it.",
        );
        answer.rows("Advice for each class of slopes", advice, advice.names());
        answer.folded("The other numbers of each place", |answer| {
            let others = files.iter().filter(|file| ![VERDICT, SLOPE.name].contains(&file.name));
            others.for_each(|file| picture(answer, file));
        });
        answer.folded("How exact the map is", |answer| answer.words(self.exactness(errors)));
        answer.columns = meanings(&bands());
    }

    /// How far numbers of the map may be from those of the heading on the same slope.
    fn exactness(&self, errors: &Value) -> String {
        let error = |name: &str| {
            errors.get(name).and_then(Value::as_f64).map_or_else(String::new, four_digits)
        };
        let [east, north] = self.ground.slope_length();
        format!(
            "Slopes are taken over {} m to the east and {} m to the north. Numbers are read from a \
             table over slope, which is within {}° of the heading, {} of the slip ratio, {} W and \
             {} mm of what the search for the heading finds on the same slope. What a map cannot \
             know: steps and stones between its points, and soil that differs from place to place.",
            four_digits(east),
            four_digits(north),
            error(HEADING.name),
            error(SLIP_RATIO.name),
            error(POWER.name),
            error(SINKAGE.name),
        )
    }

    /// Which course each place has.
    fn of_course(&self) -> String {
        match self.course {
            CourseChoice::Best => {
                "Each place has the course that is least often a no-go there, or on the way back, \
                 and of several the one with the least slip."
                    .to_owned()
            }
            CourseChoice::Worst => {
                "Each place has the course that is most often a no-go there, and of several the \
                 one with the most slip."
                    .to_owned()
            }
            CourseChoice::Fixed(_) => format!(
                "The course is {}°, counted from the contour with the hill on the left, positive \
                 uphill. On a rover that is its own mirror image it is the same with the hill on \
                 the right.",
                self.given_course
            ),
        }
    }
}

/// The picture of a band.
fn picture(answer: &mut Answer, MapFile { name, about, .. }: &MapFile) {
    let caption = format!("{about}. Grey: no number; empty: no height.");
    answer.page.push(PageBlock::Picture { file: format!("{name}.svg"), caption });
}
