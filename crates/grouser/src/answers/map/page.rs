//! The page of a map.

use std::sync::Arc;

use serde_json::Value;

use super::super::{Answer, PageBlock, meanings};
use super::files::MapFile;
use super::question::MapQuestion;
use crate::document::columns::map::{HEADING, bands};
use crate::document::columns::{POWER, SINKAGE, SLIP_RATIO};
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
        answer.words(self.of_course());
        for MapFile { name, about, .. } in files {
            let (file, caption) = (format!("{name}.svg"), format!("{about}. Empty: no number."));
            answer.page.push(PageBlock::Picture { file, caption });
        }
        answer.heading("What to do on each slope");
        answer.words(
            "A place has the verdict of the slope above its own; the operator's card of the \
                      same rover and soil says the same of it.",
        );
        answer.rows("Advice for each class of slopes", advice, advice.names());
        answer.heading("How exact the map is");
        let error = |name: &str| {
            errors.get(name).and_then(Value::as_f64).map_or_else(String::new, four_digits)
        };
        let [east, north] = self.ground.slope_length();
        answer.words(format!(
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
        ));
        answer.columns = meanings(&bands());
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
