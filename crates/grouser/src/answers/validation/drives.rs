//! Wheel–soil models beside recorded drives.

use std::sync::Arc;

use serde_json::{Map, Value, json};

use super::super::{Answer, AnswerError, Displayed, Member, meanings, setting};
use super::shown::{number, table};
use super::{figures::Figure, flat, meanings_of_errors};
use crate::contact::Model;
use crate::document::LoadedScenario;
use crate::document::columns::drives::{
    DRIVE, NO_PREDICTION, SPLIT, TRIALS, TURN_RADIUS, cell_columns, cells, drives, quantity_of,
};
use crate::document::columns::learn::gross_in_words;
use crate::document::columns::{MODEL, Quantity, SLOPE, YAW, advice::RIM_SPEED};
use crate::document::figure::{Chart, Series, Style};
use crate::document::given_file::GivenFile;
use crate::document::reading::{capitalised, counted, sentence};
use crate::document::table::Table;
use crate::document::validation::ErrorsRecord;
use crate::soil::SmallWheel;
use crate::studies::drive_validation::{
    DriveQuantity, DriveValidation, DriveValidationStudy, JudgedPrediction, Predictor,
    RecordedDrive, Split,
};
use crate::studies::validation::Yardstick;

/// The name that the files of its answer have.
const FILE: &str = "drives";
const LEGEND: &str = "Errors of each quantity over the cells: root mean square / mean (prediction \
    minus measurement).\nscore: the root mean square over the standard deviation between all cells, \
    averaged over the quantities; 0 is perfect. Rows\nwithout a rank have no physics in them.\n";

/// The question of recorded drives.
#[derive(Clone, Debug)]
pub struct DriveValidationQuestion {
    /// The folder's name.
    pub folder: String,
    /// The scenario whose rover, soil, gravity and load transfer count; with its model alone, if
    /// its document names one.
    pub scenario: LoadedScenario,
    /// The drives.
    pub drives: Vec<RecordedDrive>,
    /// What the log of each gave.
    pub given: Vec<GivenFile>,
    /// Notes on what of the folder was left out.
    pub notes: Vec<String>,
}

/// What was found, as tables and sentences.
struct JudgedDrives {
    validation: DriveValidation,
    /// What was measured of anything.
    quantities: Vec<DriveQuantity>,
    cells: Arc<Table>,
    drives: Arc<Table>,
    sentences: Vec<String>,
    notes: Vec<String>,
}

impl DriveValidationQuestion {
    /// The answer.
    ///
    /// * `schema`: the name that its schema has
    ///
    /// # Errors
    /// [`AnswerError::Empty`]: no stretch of the drives can be compared.
    pub fn answer(&self, schema: &str) -> Result<Answer, AnswerError> {
        let models = self.models();
        let study = DriveValidationStudy {
            drives: &self.drives,
            scenario: &self.scenario.value,
            models: &models,
        };
        let found = self.found(study.run(), &models)?;
        let mut answer = Answer::new(FILE, "Models on recorded drives").with_schema(schema);
        answer.input("drives", self.folder.as_str());
        let document = &self.scenario.document;
        let keys = ["rover", "soil", "gravity_m_s2", "load_transfer", "wheel_moments"];
        answer.inputs_of(document, keys);
        let names: Vec<&str> = models.iter().map(Model::name).collect();
        answer.input("models", json!(names));
        let errors = Arc::new(flat::table_of(&found.rows()));
        answer.results = vec![
            Member::Value("judged_on", json!(found.validation.judged_on.name())),
            Member::Value("sentences", json!(found.sentences)),
            Member::rows("rows", Arc::clone(&errors)),
            Member::rows("cells", Arc::clone(&found.cells)),
            Member::rows(FILE, Arc::clone(&found.drives)),
            Member::Value("compared_stretches", json!(found.validation.compared)),
            Member::Value("notes", json!(found.notes)),
        ];
        answer.tables = vec![
            ("errors".to_owned(), errors),
            ("cells".to_owned(), Arc::clone(&found.cells)),
            (FILE.to_owned(), Arc::clone(&found.drives)),
        ];
        answer.screen = found.screen();
        answer.given.clone_from(&self.given);
        answer.attach("scenario.toml", &self.scenario);
        self.page(&mut answer, &found);
        Ok(answer)
    }

    /// The models that are asked: the one that is named, or all, but for the small-wheel model where
    /// the soil has nothing that tells it from the classical one.
    fn models(&self) -> Vec<Model> {
        let scenario = &self.scenario;
        if scenario.document.model().is_some() {
            return vec![scenario.value.model.clone()];
        }
        let is_off = scenario.value.ground.soil.small_wheel == SmallWheel::OFF;
        let all = Model::ALL.into_iter();
        all.filter(|it| !(is_off && *it == Model::SmallWheel)).collect()
    }

    /// Why no stretch is compared: what each drive's gross faults are, and what stretches lack.
    fn not_compared(&self, stretches: impl Iterator<Item = String>) -> AnswerError {
        let faults = self.drives.iter().flat_map(|drive| {
            drive.gross_faults.iter().map(|it| format!("{}: {}", drive.name, gross_in_words(it)))
        });
        let why: Vec<String> = faults.chain(stretches).collect();
        let none = "stretches need an attitude, steadily turning wheels, and a way or torques";
        let why = if why.is_empty() { none.to_owned() } else { why.join("; ") };
        AnswerError::NotCompared("drives", why)
    }

    fn found(
        &self,
        validation: DriveValidation,
        models: &[Model],
    ) -> Result<JudgedDrives, AnswerError> {
        let left_out = validation.not_compared.iter();
        let left_out = left_out.map(|(why, count)| {
            format!(
                "{} not compared: {}",
                counted(*count as u64, "stretch", "stretches"),
                why.meaning()
            )
        });
        let Some(best) = validation.predictions.first().filter(|_| validation.compared > 0) else {
            return Err(self.not_compared(left_out));
        };
        let has = |it: &DriveQuantity| {
            validation.predictions.iter().any(|one| one.errors[*it as usize].is_some())
        };
        let quantities = DriveQuantity::ALL.into_iter().filter(has).collect();
        let names: Vec<&str> = models.iter().map(Model::name).collect();
        let sentences = vec![self.verdict(&validation, best)];
        Ok(JudgedDrives {
            quantities,
            cells: Arc::new(cells(&validation, &names)),
            drives: Arc::new(drives(&self.drives)),
            sentences,
            notes: self.notes.iter().cloned().chain(self.nominal()).chain(left_out).collect(),
            validation,
        })
    }

    /// A note that an uncertain soil predicts by its nominal values, with its uncertain keys.
    fn nominal(&self) -> Option<String> {
        let uncertain = self.scenario.uncertain.as_ref()?;
        let keys: Vec<&str> = uncertain.keys().collect();
        Some(format!(
            "the soil is uncertain ({}): its nominal values predict here, so that what a model misses \
             is its own error and theirs",
            keys.join(", ")
        ))
    }

    /// Which model comes nearest, or that none does.
    fn verdict(&self, validation: &DriveValidation, best: &JudgedPrediction) -> String {
        let split = validation.judged_on;
        let drives = self.drives.iter().filter(|it| it.split == split).count();
        let cells = validation.cells.iter().filter(|it| it.split == split).count();
        let [drives, cells] = [(drives, "drive"), (cells, "cell")]
            .map(|(count, one)| counted(count as u64, one, &format!("{one}s")));
        let on = format!("the {} set, {drives} in {cells}", split.name());
        let none_there = match split {
            Split::Test => "",
            Split::Training => " (the hash puts no drive into the test set)",
        };
        let mean = Predictor::Yardstick(Yardstick::Mean);
        let mean = validation.predictions.iter().find(|it| it.split == split && it.by == mean);
        match (best.score, mean.and_then(|it| it.score)) {
            (Some(score), Some(mean)) if score < mean => {
                let (name, score) = (best.by.name(), number(Some(score)));
                let next = validation.predictions.get(1).filter(|it| it.split == split);
                let next = next.filter(|it| matches!(it.by, Predictor::Model(_)));
                let next = next.map_or(String::new(), |it| {
                    format!(", `{}` follows with {}", it.by.name(), number(it.score))
                });
                format!("`{name}` is nearest on {on}{none_there}: score {score}{next}")
            }
            (Some(_), _) => format!("no model is better than the mean on {on}{none_there}"),
            (None, _) => format!(
                "models cannot be ranked on {on}{none_there}: what was measured does not differ \
                 between cells"
            ),
        }
    }

    /// The page, but for what all pages end with.
    fn page(&self, answer: &mut Answer, found: &JudgedDrives) {
        found.sentences.iter().for_each(|it| answer.verdict(sentence(it)));
        answer.list(setting(&self.scenario.document));
        answer.list([format!("stretches compared: {}", found.validation.compared)]);
        answer.list(found.notes.clone());
        answer.words(LEGEND.trim());
        for (caption, split) in [
            ("Errors on the test set", Split::Test),
            ("Errors on the training set", Split::Training),
        ] {
            if let Some(errors) = found.errors(split) {
                answer.rows(caption, &errors, errors.names());
            }
        }
        answer.heading("Every cell");
        answer.rows(
            "Measured, and by the nearest model",
            &found.of_model(found.best()),
            found.brief(),
        );
        answer.heading("Figures");
        for Figure { file, chart, caption } in found.figures() {
            answer.figure(Some(&format!("figures/{file}")), chart, caption);
        }
        answer.folded("The drives", |answer| {
            answer.rows("Each drive", &found.drives, found.drives.names());
        });
        answer.columns = meanings(&cell_columns());
        answer.columns.extend(meanings(&DRIVE));
        answer.columns.extend(meanings_of_errors());
    }
}

impl JudgedDrives {
    /// A row for each prediction, set and quantity.
    fn rows(&self) -> Vec<Map<String, Value>> {
        let other = Split::Training;
        let sets = [self.validation.judged_on, other];
        let sets = sets.into_iter().take(1 + usize::from(sets[0] != other));
        let placed = sets.flat_map(|split| self.of_set(split).enumerate());
        placed.flat_map(|(place, it)| self.rows_of(place, it)).collect()
    }

    fn rows_of(&self, place: usize, it: &JudgedPrediction) -> Vec<Map<String, Value>> {
        let rank = matches!(it.by, Predictor::Model(_)).then_some(place + 1);
        let row = |of: &DriveQuantity| {
            let (errors, quantity) = (it.errors[*of as usize]?, quantity_of(*of));
            let row = json!({
                "rank": rank,
                "prediction": it.by.name(),
                (SPLIT): it.split.name(),
                "score": it.score,
                (TRIALS): it.trials[0],
                (NO_PREDICTION): it.trials[1],
                "quantity": quantity.name,
                "quantity_score": it.scores[*of as usize],
            });
            let errors = serde_json::to_value(ErrorsRecord::new(&errors, quantity.unit)).ok()?;
            let mut row = row.as_object()?.clone();
            row.extend(errors.as_object()?.clone());
            Some(row)
        };
        self.quantities.iter().filter_map(row).collect()
    }

    /// Errors on a set for reading; `None` where it has no drives.
    fn errors(&self, split: Split) -> Option<Arc<Table>> {
        let of_set: Vec<&JudgedPrediction> = self.of_set(split).collect();
        let header = ["rank", "prediction", "score", "no prediction"].map(str::to_owned);
        let header = header.into_iter().chain(self.columns().map(|it| it.name.to_owned()));
        let rows = of_set.iter().enumerate().map(|(place, it)| self.line(place + 1, it));
        let last = self.quantities.iter().map(|of| {
            let errors = of_set.first()?.errors[*of as usize]?;
            Some(quantity_of(*of).unit.from_si(errors.repeatability?))
        });
        let last: Vec<String> = last.map(number).collect();
        let names = ["-", "between drives of a cell", "-", "-"].map(str::to_owned);
        let last = names.into_iter().chain(last).collect();
        let rows = rows.chain([last]).collect();
        (!of_set.is_empty()).then(|| table(&header.collect::<Vec<_>>(), rows))
    }

    fn line(&self, rank: usize, it: &JudgedPrediction) -> Vec<String> {
        let (rank, without) = match it.by {
            Predictor::Model(_) => {
                (rank.to_string(), format!("{} of {}", it.trials[1], it.trials[0]))
            }
            Predictor::Yardstick(_) => ("-".to_owned(), "-".to_owned()),
        };
        let names = [rank, it.by.name().to_owned(), number(it.score), without];
        let errors = self.quantities.iter().map(|of| {
            let unit = quantity_of(*of).unit;
            let Some(errors) = it.errors[*of as usize] else { return "-".to_owned() };
            let [rmse, bias] = [errors.rmse, errors.bias].map(|it| number(Some(unit.from_si(it))));
            format!("{rmse} / {bias}")
        });
        names.into_iter().chain(errors).collect()
    }

    fn columns(&self) -> impl Iterator<Item = Quantity> {
        self.quantities.iter().map(|it| quantity_of(*it))
    }

    /// The name of the model that is nearest.
    fn best(&self) -> &'static str {
        self.validation.predictions.first().map_or("", |it| it.by.name())
    }

    /// The cells beside a model.
    fn of_model(&self, name: &str) -> Arc<Table> {
        let models = self.cells.texts(MODEL).iter().enumerate();
        let rows = models.filter(|(_, it)| it.as_deref() == Some(name)).map(|(row, _)| row);
        Arc::new(self.cells.rows_at(&rows.collect::<Vec<_>>()))
    }

    /// The columns of the cells for reading: conditions, and what was measured with its prediction.
    fn brief(&self) -> Vec<String> {
        let conditions = [SPLIT, SLOPE.name, YAW.name, TURN_RADIUS.name, RIM_SPEED.name, TRIALS];
        let pairs = self.columns().flat_map(|it| [it.measurement(), it.name.to_owned()]);
        conditions.map(str::to_owned).into_iter().chain(pairs).collect()
    }

    fn screen(&self) -> Vec<Displayed> {
        let mut screen = vec![Displayed::Words(LEGEND.to_owned())];
        for split in [Split::Test, Split::Training] {
            if let Some(errors) = self.errors(split) {
                screen.push(Displayed::Words(format!("\n{} set\n", split.name())));
                screen.push(Displayed::Rows(Arc::clone(&errors), errors.names()));
            }
        }
        screen.push(Displayed::Words(format!("\nevery cell, by {}\n", self.best())));
        screen.push(Displayed::Rows(self.of_model(self.best()), self.brief()));
        let found = self.sentences.iter().map(|it| format!("finding: {it}\n"));
        let notes = self.notes.iter().map(|it| format!("note: {it}\n"));
        screen.push(Displayed::Words(format!("\n{}", found.chain(notes).collect::<String>())));
        screen
    }

    /// For each quantity what each model predicts over what was measured, cell by cell.
    fn figures(&self) -> Vec<Figure> {
        let judged = self.of_set(self.validation.judged_on);
        let models = judged.filter(|it| matches!(it.by, Predictor::Model(_)));
        let cells: Vec<(&str, Arc<Table>)> =
            models.map(|it| (it.by.name(), self.of_model(it.by.name()))).collect();
        self.columns().map(|quantity| figure(quantity, &cells)).collect()
    }

    /// What predicts on a set, best first.
    fn of_set(&self, split: Split) -> impl Iterator<Item = &JudgedPrediction> {
        self.validation.predictions.iter().filter(move |it| it.split == split)
    }
}

/// * `cells`: beside each model, with its name, best first
fn figure(quantity: Quantity, cells: &[(&str, Arc<Table>)]) -> Figure {
    let measured = quantity.measurement();
    let (name, unit) = (quantity.label(), quantity.unit.symbol);
    let all = cells.iter().flat_map(|(_, of_model)| of_model.points(&measured, &measured));
    let all: Vec<f64> = all.map(|(it, _)| it).collect();
    let ends = [f64::min, f64::max].map(|of| all.iter().copied().reduce(of).unwrap_or(0.0));
    let equal = Series::new("equal", Style::Dotted, 0, ends.map(|it| (it, it)));
    let models = cells.iter().enumerate().map(|(place, (model, of_model))| {
        let style = [Style::Dots, Style::Squares, Style::Triangles][place.min(2)];
        Series::new(*model, style, place + 1, of_model.points(&measured, quantity.name))
    });
    Figure {
        file: name.replace(' ', "-"),
        chart: Chart::new(
            format!("{}: predicted over measured", capitalised(&name)),
            (format!("measured {name} [{unit}]"), format!("predicted {name} [{unit}]")),
            [equal].into_iter().chain(models).collect(),
        ),
        caption: "Each mark is a cell of the training or the test set.",
    }
}
