//! What to do tomorrow: headings, looks at the slip, and test drives, as JSON, text and part of the
//! page.

use grouser::answers::{ColumnMeaning, meanings};
use grouser::document::LoadedScenario;
use grouser::document::columns::SLOPE;
use grouser::document::columns::advice as columns;
use grouser::document::reading::capitalised;
use grouser::document::reading::four_digits;
use grouser::document::table::Table;
use grouser::studies::heading_band::HeadingBand;
use grouser::studies::learn::advice::{Advice, Instruments, TestCost};
use grouser::studies::learn::{Drive, LearntSample};
use serde::Serialize;

use crate::args::{AdviceArgs, LearnArgs};
use crate::commands::sampling;
use crate::failure::Failure;
use crate::inputs;
use crate::list::Numbers;
use crate::output::rows::Rows;
use crate::output::text::Text;
use crate::report::page::Page;

/// The tables of an advice.
#[derive(Serialize)]
pub(super) struct AdviceTables {
    slopes: Table,
    /// The legs to drive, one after the other.
    test_drives: Table,
    /// Every leg on its own.
    legs: Table,
    test_cost: &'static str,
    /// The slope of the band that test drives are compared by.
    heading_width_slope_deg: Option<f64>,
}

/// The advice that is asked for, if any is.
///
/// * `drive`: its last lesson has what is read on a drive
pub(super) fn of(
    args: &LearnArgs,
    scenario: &LoadedScenario,
    drive: &Drive,
    (samples, band): (&[LearntSample], &HeadingBand),
) -> Result<Option<AdviceTables>, Failure> {
    if !args.advice.advice {
        return Ok(None);
    }
    let mut settings = inputs::advice(&args.advice, scenario, args.seed)?;
    if let Some(last) = drive.lessons().last() {
        settings.tests.instruments = Instruments::of(&last.stretch, &scenario.value.rover);
    }
    let learner = drive.learner();
    let found =
        sampling::with_bar(samples.len(), |go_on| learner.advice(samples, band, &settings, go_on));
    let found = found.map_err(|error| Failure::Usage(error.to_string()))?;
    Ok(Some(AdviceTables::of(&sampling::whole(found))))
}

impl AdviceTables {
    fn of(advice: &Advice) -> Self {
        Self {
            slopes: columns::slopes(advice),
            test_drives: columns::test_drives(&advice.tests.chosen),
            legs: columns::test_drives(&advice.tests.legs),
            test_cost: advice.cost.name(),
            heading_width_slope_deg: advice.tests.slope.map(|slope| SLOPE.unit.as_given(slope)),
        }
    }

    /// The files of the folder, with their names.
    pub(super) fn files(&self) -> Result<Vec<(&'static str, String)>, Failure> {
        Ok(vec![
            ("advice.csv", Rows::of_table(&self.slopes).to_csv()?),
            ("test-drives.csv", Rows::of_table(&self.legs).to_csv()?),
        ])
    }

    /// For reading.
    pub(super) fn text(&self) -> Text {
        let sentences: String =
            self.sentences().iter().map(|sentence| format!("{sentence}\n")).collect();
        let slopes = Rows::of_table(&self.slopes).to_table(&columns::slopes_brief());
        let drives = Rows::of_table(&self.test_drives);
        let text = slopes + format!("\n{sentences}\n{}\n", self.about_drives());
        if self.test_drives.rows() == 0 {
            return text;
        }
        text + drives.to_table(&columns::tests_brief())
    }

    /// What to do on each slope.
    fn sentences(&self) -> Vec<String> {
        let texts = Rows::of_table(&self.slopes).cells(&[columns::SENTENCE.to_owned()]);
        texts.into_iter().flatten().collect()
    }

    fn about_drives(&self) -> String {
        match self.heading_width_slope_deg {
            Some(slope) if self.test_drives.rows() > 0 => format!(
                "test drives, one after the other, that tell most of these slopes for their {}; \
                 the heading is least certain on {}°:",
                self.test_cost,
                four_digits(slope)
            ),
            _ => "no test drive tells anything of these slopes".to_owned(),
        }
    }

    /// The part of the page.
    pub(super) fn add_to(&self, page: &mut Page) {
        page.heading("Advice");
        page.list(self.sentences());
        page.rows("What to do on each slope", &self.slopes, &columns::slopes_brief());
        page.paragraph(&format!("{}.", capitalised(self.about_drives().trim_end_matches(':'))));
        if self.test_drives.rows() > 0 {
            let brief = columns::legs_brief();
            page.rows("Test drives to make, one after the other", &self.test_drives, &brief);
            page.rows("All legs, each on its own", &self.legs, &brief);
        }
    }
}

/// The flags that ask for the same advice again, after a blank; nothing where none is asked for.
pub(super) fn flags(args: &AdviceArgs) -> String {
    let flags = settings(args).into_iter().flatten();
    let flags = flags.map(|(flag, value)| format!(" --{}={value}", flag.replace('_', "-")));
    flags.fold(if args.advice { " --advice".to_owned() } else { String::new() }, |all, one| {
        all + &one
    })
}

/// The settings of the advice, by the names of their flags; `None` where none is asked for.
pub(super) fn settings(args: &AdviceArgs) -> Option<Vec<(&'static str, String)>> {
    let list =
        |numbers: &Numbers| numbers.0.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
    let cost = TestCost::from(args.test_cost);
    args.advice.then(|| {
        vec![
            ("no_go_slip_ratio", list(&args.no_go_slip_ratio)),
            ("no_go_probability", list(&args.no_go_probability)),
            ("stuck_probability", list(&args.stuck_probability)),
            ("false_stops", list(&args.false_stops)),
            ("odometry_error", list(&args.odometry_error)),
            ("soil_change_m", list(&args.soil_change_m)),
            ("ways", args.ways.to_string()),
            ("look_s", list(&args.look_s)),
            ("test_slope_deg", list(&args.test_slope_deg)),
            ("test_way_m", list(&args.test_way_m)),
            ("test_cost", cost.name().to_owned()),
        ]
    })
}

/// What the columns are.
pub(super) fn of_columns() -> Vec<ColumnMeaning> {
    let both = [meanings(&columns::SLOPE_COLUMNS), meanings(&columns::TEST_COLUMNS)];
    both.into_iter().flatten().collect()
}
