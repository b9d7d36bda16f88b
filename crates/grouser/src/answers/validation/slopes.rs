//! Errors of a model against a rover's measured slip and yaw on slopes.

use std::sync::Arc;

use serde_json::json;

use super::super::{Answer, AnswerError, AnswerOptions, Displayed, Member, setting};
use super::shown::{number, table, yes_or_no};
use super::{FILE, draw, figures, meanings_of_errors, written};
use crate::document::LoadedScenario;
use crate::document::columns::{SLIP_RATIO, YAW, slope};
use crate::document::measurements::Condition;
use crate::document::measurements::slope_tests::{SlopePoint, SlopeTests};
use crate::document::reading::sentence;
use crate::document::table::Table;
use crate::document::validation::{ErrorsRecord, ReferenceRecord, SlopeErrorsRecord};
use crate::studies::heading::HeadingStudy;
use crate::studies::slope_validation::{SlopeValidation, SlopeValidationStudy};

/// The question of a rover that was measured on slopes.
#[derive(Clone, Debug)]
pub struct SlopeValidationQuestion {
    /// The name of a data set, or of a file with its folder.
    pub data: String,
    /// What each row meets.
    pub conditions: Vec<Condition>,
    /// The rows.
    pub tests: SlopeTests,
    /// The scenario whose rover, soil, gravity and load transfer count.
    pub scenario: LoadedScenario,
}

/// Slopes and errors, as tables and words.
struct Found {
    validation: SlopeValidation,
    overall: SlopeErrorsRecord,
    yardsticks: Vec<ReferenceRecord<SlopeErrorsRecord>>,
    /// A row for each slope and course.
    slopes: Arc<Table>,
    /// The errors of the model and of each yardstick, for reading.
    errors: Arc<Table>,
}

impl SlopeValidationQuestion {
    /// The answer.
    ///
    /// * `schema`: the name that its schema has
    ///
    /// # Errors
    /// [`AnswerError`]: a soil, a gravity or a course that is not valid, a wheel that is steered,
    /// or a flag where none is accepted.
    pub fn answer(&self, schema: &str, options: &AnswerOptions<'_>) -> Result<Answer, AnswerError> {
        let heading = HeadingStudy::of(&self.scenario.value);
        let study = SlopeValidationStudy { tests: &self.tests, heading: &heading };
        let found = Found::of(study.run()?);
        let flags = found.validation.points.iter().map(|point| &*point.findings);
        options.check(flags, &found.slopes, &slope::SETTINGS)?;
        let mut answer = Answer::new(FILE, "Measured and predicted on slopes").with_schema(schema);
        self.state(&mut answer);
        answer.results = vec![
            Member::Value("overall", json!(found.overall)),
            Member::Value("yardsticks", json!(found.yardsticks)),
            Member::rows("rows", Arc::clone(&found.slopes)),
            Member::Value("notes", json!(self.tests.notes)),
        ];
        answer.tables.push((FILE.to_owned(), Arc::clone(&found.slopes)));
        answer.screen = found.screen();
        answer.attach("scenario.toml", &self.scenario);
        answer.given.push(self.tests.given.clone());
        if options.has_page {
            self.page(&mut answer, &found);
        }
        Ok(answer)
    }

    /// The inputs of the answer.
    fn state(&self, answer: &mut Answer) {
        let document = &self.scenario.document;
        answer.input("data", self.data.as_str());
        answer.input("where", written(&self.conditions));
        let keys = ["rover", "soil", "gravity_m_s2", "load_transfer", "wheel_moments"];
        answer.inputs_of(document, keys);
        answer.input("model", self.scenario.value.model.name());
        answer.input("slopes", self.tests.points.len());
    }

    /// The page, but for what all pages end with.
    fn page(&self, answer: &mut Answer, found: &Found) {
        answer.list(setting(&self.scenario.document));
        answer.list([format!("wheel–soil model: {}", self.scenario.value.model.name())]);
        answer.list(self.tests.notes.clone());
        answer.heading("Every slope, and the errors");
        let points = &found.validation.points;
        answer.rows("Each slope and course", &found.slopes, slope::brief(points));
        let (caption, columns) = ("Errors of each prediction", found.errors.names());
        answer.rows(caption, &found.errors, columns);
        if let Some(line) = found.missing() {
            answer.words(sentence(&line));
        }
        answer.heading("Figures");
        draw(answer, figures::of_slopes(&found.validation));
        let findings = points.iter().flat_map(|it| it.findings.iter().copied());
        answer.findings = Some(findings.collect());
        answer.columns = meanings_of_errors();
    }
}

impl Found {
    fn of(validation: SlopeValidation) -> Self {
        let overall = SlopeErrorsRecord::from(&validation);
        let yardsticks: Vec<ReferenceRecord<SlopeErrorsRecord>> =
            validation.references.iter().map(ReferenceRecord::from).collect();
        Self {
            slopes: Arc::new(slope::slopes(&validation.points)),
            errors: errors(&validation, &overall, &yardsticks),
            validation,
            overall,
            yardsticks,
        }
    }

    /// For reading: every slope, then the errors beside those of the yardsticks, and what could not
    /// be predicted.
    fn screen(&self) -> Vec<Displayed> {
        let missing = self.missing().map_or(String::new(), |line| line + "\n");
        let brief = slope::brief(&self.validation.points);
        vec![
            Displayed::Rows(Arc::clone(&self.slopes), brief),
            Displayed::Words("\n".to_owned()),
            Displayed::Rows(Arc::clone(&self.errors), self.errors.names()),
            Displayed::Words(missing),
        ]
    }

    /// How many slopes have no prediction, if any has none.
    fn missing(&self) -> Option<String> {
        let (missing, all) = (self.overall.no_prediction, self.overall.cells);
        (missing > 0).then(|| {
            format!(
                "{missing} of {all} slopes have no prediction: no heading holds the course there. \
                 They are in no error of the model, but in those of the predictions without \
                 physics."
            )
        })
    }
}

/// The columns of the errors.
const ERRORS: [&str; 8] = [
    "prediction",
    "quantity",
    "slopes",
    "no prediction",
    "rmse",
    "bias",
    "rmse_share",
    "within_aim",
];

/// A row for each quantity of the model, then of each yardstick.
fn errors(
    validation: &SlopeValidation,
    overall: &SlopeErrorsRecord,
    yardsticks: &[ReferenceRecord<SlopeErrorsRecord>],
) -> Arc<Table> {
    let of_yardsticks = yardsticks.iter().map(|it| (it.yardstick, &it.overall));
    let all = [("model", overall)].into_iter().chain(of_yardsticks);
    let rows = all.flat_map(|(of, errors)| {
        let quantities = quantities(validation, errors);
        quantities.map(move |(name, measured, errors)| row([of, name], measured, errors.as_ref()))
    });
    table(&ERRORS.map(str::to_owned), rows.collect())
}

/// The quantities that were measured, each with the number of slopes on which it was, and its
/// errors.
fn quantities(
    validation: &SlopeValidation,
    errors: &SlopeErrorsRecord,
) -> impl Iterator<Item = (&'static str, usize, Option<ErrorsRecord>)> {
    let count = |is_measured: fn(&SlopePoint) -> bool| {
        validation.points.iter().filter(|it| is_measured(&it.point)).count()
    };
    let all = [
        (SLIP_RATIO.name, count(|point| point.slip_ratio.is_some()), errors.slip_ratio),
        (YAW.name, count(|point| point.yaw.is_some()), errors.yaw),
    ];
    all.into_iter().filter(|(_, measured, _)| *measured > 0)
}

/// * `of`: the prediction, and the quantity
/// * `measured`: on how many slopes
/// * `errors`: over the slopes with a prediction; `None` if no slope has one
fn row(of: [&str; 2], measured: usize, errors: Option<&ErrorsRecord>) -> Vec<String> {
    let slopes = errors.map_or(0, |it| it.cells);
    let [of, quantity] = of.map(str::to_owned);
    vec![
        of,
        quantity,
        slopes.to_string(),
        (measured - slopes).to_string(),
        number(errors.map(|it| it.rmse)),
        number(errors.map(|it| it.bias)),
        number(errors.and_then(|it| it.rmse_share)),
        yes_or_no(errors.and_then(|it| it.within_aim)),
    ]
}
