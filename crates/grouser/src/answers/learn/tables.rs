//! The tables of a drive: predictions, what stretches taught, warnings, advice, and slips from
//! currents beside those that were seen.

use std::sync::Arc;

use super::super::Displayed;
use super::advice::AdviceTables;
use super::question::{LearntDrive, SlipsFromCurrents};
use crate::document::columns::{learn as columns, slip_from_current};
use crate::document::table::Table;
use crate::vehicle::Rover;

/// The tables of a drive.
pub(super) struct DriveTables {
    pub(super) predictions: Arc<Table>,
    pub(super) lessons: Arc<Table>,
    pub(super) warnings: Arc<Table>,
    pub(super) advice: Option<AdviceTables>,
    pub(super) slips: Option<SlipTables>,
}

/// The tables of slips from currents.
pub(super) struct SlipTables {
    /// A row for each stretch and wheel.
    pub(super) rows: Arc<Table>,
    /// A row for each wheel, and one for all.
    pub(super) wheels: Arc<Table>,
}

impl DriveTables {
    pub(super) fn of(found: &LearntDrive, rover: &Rover) -> Self {
        Self {
            predictions: columns::predictions(&found.before.slopes, &found.after.slopes).into(),
            lessons: columns::lessons(found.drive.lessons()).into(),
            warnings: columns::warnings(found.drive.warnings()).into(),
            advice: found.advice.as_ref().map(AdviceTables::of),
            slips: found.slips.as_ref().map(|slips| SlipTables::of(slips, rover)),
        }
    }

    /// The files of CSV with their names, the answer first.
    pub(super) fn files(&self) -> Vec<(String, Arc<Table>)> {
        let mut files = vec![("predictions", &self.predictions), ("lessons", &self.lessons)];
        files.extend(self.advice.iter().flat_map(AdviceTables::files));
        files.push(("warnings", &self.warnings));
        files.extend(self.slips.iter().map(|slips| ("slip-from-current", &slips.rows)));
        files.into_iter().map(|(name, table)| (name.to_owned(), Arc::clone(table))).collect()
    }

    /// What a terminal shows: predictions with those before the drive, some lines, and advice.
    pub(super) fn screen(&self, lines: &[String]) -> Vec<Displayed> {
        let lines: String = lines.iter().map(|line| format!("{line}\n")).collect();
        let mut shown = vec![
            Displayed::Rows(Arc::clone(&self.predictions), columns::brief()),
            Displayed::Words(format!("\n{lines}")),
        ];
        if let Some(advice) = &self.advice {
            shown.push(Displayed::Words("\n".into()));
            shown.extend(advice.screen());
        }
        shown
    }
}

impl SlipTables {
    fn of(slips: &SlipsFromCurrents, rover: &Rover) -> Self {
        let SlipsFromCurrents { log, estimates } = slips;
        Self {
            rows: slip_from_current::table(rover, log, estimates).into(),
            wheels: slip_from_current::summary(rover, log, estimates).into(),
        }
    }
}
