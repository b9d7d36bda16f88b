//! What to do tomorrow: headings, looks at the slip, and test drives.

use std::sync::Arc;

use serde_json::{Value, json};

use super::super::{Answer, Displayed};
use crate::document::columns::SLOPE;
use crate::document::columns::advice as columns;
use crate::document::reading::{four_digits, sentence};
use crate::document::table::Table;
use crate::studies::learn::Drive;
use crate::studies::learn::advice::{
    AdviceSettings, CheckSettings, DriveAdvice, Instruments, Limits, TestCost, TestSettings,
};
use crate::vehicle::Rover;

/// What advice after a drive is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct AdviceQuestion {
    /// The slip to keep.
    pub limits: Limits,
    /// How slip is checked.
    pub checks: CheckSettings,
    /// Time that odometry needs for a look at the slip while the rover goes on [s]; 0 where it
    /// stands meanwhile.
    pub look_time: f64,
    /// Slopes that there are for test drives [°], as they were given.
    pub test_slopes_deg: Vec<f64>,
    /// Way of the rims of a test drive [m].
    pub test_way: f64,
    /// What a test drive costs.
    pub test_cost: TestCost,
}

impl AdviceQuestion {
    /// What was given, by keys of inputs.
    #[must_use]
    pub fn given(&self) -> [(&'static str, String); 11] {
        let Self { limits, checks, .. } = self;
        let change = checks.soil.change_way.unwrap_or(0.0);
        let slopes: Vec<String> = self.test_slopes_deg.iter().map(ToString::to_string).collect();
        [
            ("no_go_slip_ratio", limits.slip_ratio.to_string()),
            ("no_go_probability", limits.no_go_probability.to_string()),
            ("stuck_probability", checks.stuck_probability.to_string()),
            ("false_stops", checks.false_stops.to_string()),
            ("odometry_error", checks.odometry_error.to_string()),
            ("soil_change_m", change.to_string()),
            ("ways", checks.ways.to_string()),
            ("look_s", self.look_time.to_string()),
            ("test_slope_deg", slopes.join(",")),
            ("test_way_m", self.test_way.to_string()),
            ("test_cost", self.test_cost.name().to_owned()),
        ]
    }

    /// The settings of the study after a drive.
    ///
    /// * `drive`: its last lesson has what is read on a drive
    /// * `seed`: of the soils ahead
    pub(super) fn after(&self, drive: &Drive, rover: &Rover, seed: u64) -> AdviceSettings {
        let slopes = SLOPE.in_si(&self.test_slopes_deg);
        let mut tests = TestSettings::on_slopes(&slopes, self.test_way);
        tests.cost = self.test_cost;
        if let Some(last) = drive.lessons().last() {
            tests.instruments = Instruments::of(&last.stretch, rover);
        }
        let &Self { limits, checks, look_time, .. } = self;
        AdviceSettings { limits, checks, look_time, tests, seed }
    }
}

/// The tables of an advice.
pub(super) struct AdviceTables {
    slopes: Arc<Table>,
    /// The legs to drive, one after the other.
    test_drives: Arc<Table>,
    /// Every leg on its own.
    legs: Arc<Table>,
    test_cost: &'static str,
    /// The slope of the band that test drives are compared by.
    heading_width_slope_deg: Option<f64>,
}

impl AdviceTables {
    pub(super) fn of(advice: &DriveAdvice) -> Self {
        Self {
            slopes: columns::slopes(advice).into(),
            test_drives: columns::test_drives(&advice.tests.chosen).into(),
            legs: columns::test_drives(&advice.tests.legs).into(),
            test_cost: advice.cost.name(),
            heading_width_slope_deg: advice.tests.slope.map(|slope| SLOPE.unit.as_given(slope)),
        }
    }

    pub(super) fn to_json(&self) -> Value {
        json!({
            "slopes": *self.slopes,
            "test_drives": *self.test_drives,
            "legs": *self.legs,
            "test_cost": self.test_cost,
            "heading_width_slope_deg": self.heading_width_slope_deg,
        })
    }

    /// The files of CSV, by their names.
    pub(super) fn files(&self) -> [(&'static str, &Arc<Table>); 2] {
        [("advice", &self.slopes), ("test-drives", &self.legs)]
    }

    /// What a terminal shows.
    pub(super) fn screen(&self) -> Vec<Displayed> {
        let sentences: String = self.sentences().iter().map(|it| format!("{it}\n")).collect();
        let mut shown = vec![
            Displayed::Rows(Arc::clone(&self.slopes), columns::slopes_brief()),
            Displayed::Words(format!("\n{sentences}\n{}\n", self.about_drives())),
        ];
        if self.test_drives.rows() > 0 {
            shown.push(Displayed::Rows(Arc::clone(&self.test_drives), columns::tests_brief()));
        }
        shown
    }

    /// What to do on each slope.
    fn sentences(&self) -> Vec<String> {
        self.slopes.texts(columns::SENTENCE).iter().flatten().cloned().collect()
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

    /// Adds its part of the page.
    pub(super) fn add_to(&self, answer: &mut Answer) {
        answer.heading("Advice");
        answer.list(self.sentences());
        answer.rows("What to do on each slope", &self.slopes, columns::slopes_brief());
        answer.words(sentence(self.about_drives().trim_end_matches(':')));
        if self.test_drives.rows() > 0 {
            let caption = "Test drives to make, one after the other";
            answer.rows(caption, &self.test_drives, columns::legs_brief());
            answer.rows("All legs, each on its own", &self.legs, columns::legs_brief());
        }
    }
}
