//! The page of a drive: today beside yesterday, advice, and what each stretch taught.

use super::super::{Answer, meanings};
use super::figures;
use super::question::{LearnQuestion, LearntDrive};
use super::tables::DriveTables;
use super::words::{lines, slope_in_words, verdicts};
use crate::document::columns::advice::{SLOPE_COLUMNS, TEST_COLUMNS};
use crate::document::columns::learn::{LESSON_COLUMNS, PREDICTION_COLUMNS, WARNING_COLUMNS, brief};
use crate::document::reading::sentence;

impl LearnQuestion {
    /// The page, but for what all pages end with.
    pub(super) fn page(&self, answer: &mut Answer, found: &LearntDrive, tables: &DriveTables) {
        let predictions = &tables.predictions;
        let slopes = (0..predictions.rows()).filter_map(|row| slope_in_words(predictions, row));
        let slopes: Vec<String> = slopes.collect();
        answer.verdict(sentence(&verdicts(found)));
        answer.verdict(format!("To hold the contour: {}.", slopes.join("; ")));
        let document = &self.scenario.document;
        answer.list([
            format!("rover: {}", document.name_of("rover")),
            format!("soil before the drive: {}", document.name_of("soil")),
        ]);
        answer.list(lines(found));
        answer.heading("Today beside yesterday");
        let caption = "Heading and slip of the next slopes, after the drive and before it";
        answer.rows(caption, predictions, brief());
        answer.charts(figures::predictions(predictions));
        if let Some(advice) = &tables.advice {
            advice.add_to(answer);
        }
        answer.folded("What each stretch taught", |answer| {
            let lessons = &tables.lessons;
            answer.charts(vec![figures::over_way(lessons), figures::information(lessons)]);
        });
        if let Some(slips) = &tables.slips {
            answer.folded("Slip from currents beside slip that was seen", |answer| {
                let caption = "Slip from currents, wheel by wheel, beside that seen";
                answer.rows(caption, &slips.wheels, slips.wheels.names());
                answer.charts(figures::slips(&self.scenario.value.rover, &slips.rows));
            });
        }
        answer.columns = meanings(&PREDICTION_COLUMNS);
        answer.columns.extend(meanings(&LESSON_COLUMNS));
        answer.columns.extend(meanings(&WARNING_COLUMNS));
        if tables.advice.is_some() {
            answer.columns.extend(meanings(&SLOPE_COLUMNS));
            answer.columns.extend(meanings(&TEST_COLUMNS));
        }
    }
}
