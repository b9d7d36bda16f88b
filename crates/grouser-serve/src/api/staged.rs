//! Answers in stages: the soil as written first, then few samples, then many. Each is a line, the
//! same object as the program prints with `--format json`.

use std::collections::BTreeMap;

use grouser::answers::{Answer, AnswerError, AnswerOptions, Displayed, PageBlock, Sampling};
use grouser::contact::Model;
use grouser::document::{json, label_of};
use grouser::simulation::{Scenario, Trajectory};
use grouser_draw::chart::Drawable as _;
use grouser_draw::{Animation, Sheet, Slide, base64};
use http::StatusCode;
use serde_json::{Value, json};

use super::command::CommandLine;
use super::fields::AskedFields;
use crate::asked::Question;
use crate::progress::Progress;
use crate::refusal::Refusal;

/// A question that samples answer, or none.
pub(super) trait Staged: 'static {
    /// Sets the samples.
    fn sample(&mut self, sampling: Option<Sampling>);

    fn answer(&self, options: &AnswerOptions<'_>) -> Result<Answer, Refusal>;

    /// The words that ask the program for these samples.
    fn add_samples(&self, line: &mut CommandLine, sampling: Option<Sampling>);

    /// What is counted on the way, where somebody watches it: such a study may take long.
    fn counts(&self) -> Option<&'static str> {
        None
    }

    /// Rover and soil, as a slide names them.
    fn whose(&self) -> String;

    /// The picture of a slide, where it is no figure of the answer.
    fn picture(&self) -> Option<Sheet> {
        None
    }

    /// The run of the last answer in three dimensions, as binary glTF, if it has one.
    fn scene(&self) -> Option<Vec<u8>> {
        None
    }

    /// Adds what is shown of the last answer beside its words, such as pictures.
    fn add_shown(&self, _shown: &mut Value) -> Result<(), Refusal> {
        Ok(())
    }
}

/// Which samples are asked for, one after another, and what is to be shown.
#[derive(Clone, Debug)]
pub(super) struct Stages {
    samplings: Vec<Option<Sampling>>,
    /// Whether sentences, documents and the command come along, and what else.
    shown: Option<Shown>,
    is_strict: bool,
    /// With those of every model and of every derivative.
    rows: usize,
}

/// What is shown beside sentences.
#[derive(Clone, Copy, Debug, Default)]
struct Shown {
    /// Whether figures and tables come along.
    draws: bool,
    /// Whether a slide comes along.
    has_slide: bool,
    /// Whether the run comes along in three dimensions.
    has_scene: bool,
}

/// More rows take long without samples, too.
const QUICK_ROWS: usize = 1000;

/// Samples at the most.
const MOST: u64 = 10_000;
/// Rows times samples at the most.
const MOST_ROWS: usize = 1_000_000;
/// Rows times models and derivatives at the most: they are computed to their end.
const MOST_PLAIN: usize = 20_000;
/// Keys of derivatives at the most.
pub(super) const MOST_GRADIENTS: usize = 64;

impl Stages {
    /// * `usual`: the samples where nothing is said of them, as the program has them
    pub(super) fn of(fields: &AskedFields, usual: Option<u32>) -> Result<Self, Refusal> {
        let is_nominal = fields.truth("nominal")?;
        let samples = fields.counts("samples", &(2..=MOST))?;
        let seed = fields.counts("seed", &(0..=u64::MAX))?;
        let stages = fields.counts("stages", &(0..=MOST))?;
        let seed = seed.and_then(|seed| seed.first().copied()).unwrap_or(1);
        let sampling = |count: u64| {
            let count = u32::try_from(count).unwrap_or(u32::MAX);
            (count > 0).then_some(Sampling { count: count.max(2), seed })
        };
        let one = samples.and_then(|samples| samples.first().copied());
        if [is_nominal, one.is_some(), stages.is_some()].into_iter().filter(|it| *it).count() > 1 {
            let message = "`nominal`, `samples` and `stages` exclude each other";
            return Err(Refusal::of_key("samples", message));
        }
        let stages = match (stages, one) {
            (Some(stages), _) if stages.is_empty() || stages.len() > 4 => {
                return Err(Refusal::of_key("stages", "it must be a list of 1 to 4"));
            }
            (Some(stages), _) => stages.into_iter().map(sampling).collect(),
            (None, Some(one)) => vec![sampling(one)],
            (None, None) if is_nominal => vec![None],
            (None, None) => vec![usual.map(|count| Sampling { count, seed })],
        };
        let draws = fields.truth("figures")?;
        let has_slide = fields.truth("slide")?;
        let shows = fields.truth("shown")? || draws || has_slide;
        let shown = shows.then_some(Shown { draws, has_slide, ..Shown::default() });
        Ok(Self { samplings: stages, shown, is_strict: fields.truth("strict")?, rows: 1 })
    }

    /// These stages of a run, which comes along in three dimensions where that is asked for.
    pub(super) fn with_scene(mut self, fields: &AskedFields) -> Result<Self, Refusal> {
        if fields.truth("scene")? {
            self.shown.get_or_insert_default().has_scene = true;
        }
        Ok(self)
    }

    /// Whether any stage has samples.
    pub(super) fn has_samples(&self) -> bool {
        self.samplings.iter().any(Option::is_some)
    }

    /// Checks that each stage has samples, and that no flag is to be an error: a map, and what is
    /// made of it, has no other answer.
    pub(super) fn of_samples(self) -> Result<Self, Refusal> {
        if self.samplings.iter().any(Option::is_none) {
            return Err(Refusal::of_key("nominal", "what is made of a map is always of samples"));
        }
        if self.is_strict {
            return Err(Refusal::of_key("strict", "what is made of a map has flags all the same"));
        }
        Ok(self)
    }

    /// The same, none of which is quick.
    pub(super) fn in_turn(self) -> Self {
        Self { rows: QUICK_ROWS + 1, ..self }
    }

    /// The same without samples.
    pub(super) fn without_samples(self) -> Self {
        Self { samplings: vec![None], ..self }
    }

    /// Checks that samples of so many rows are not more than anyone can have meant.
    ///
    /// * `key`: of what there are so many of
    /// * `has_every_model`, `gradients`: what each row has
    pub(super) fn of_rows(
        self,
        (key, rows): (&str, usize),
        has_every_model: bool,
        gradients: usize,
    ) -> Result<Self, Refusal> {
        let models = if has_every_model { Model::ALL.len() } else { 1 };
        if gradients > MOST_GRADIENTS {
            let message = format!("{gradients} keys, it may have {MOST_GRADIENTS}");
            return Err(Refusal::of_key("gradients", message));
        }
        let plain = rows.saturating_mul(models).saturating_mul(1 + gradients);
        if plain > MOST_PLAIN {
            let message = format!(
                "{rows} rows of {models} models and {gradients} derivatives: together they must be \
                 at most {MOST_PLAIN}"
            );
            return Err(Refusal::of_key(key, message));
        }
        self.check_samples_of(rows)?;
        Ok(Self { rows: plain, ..self })
    }

    /// Checks that samples of so many rows each can be kept.
    pub(super) fn check_samples_of(&self, rows: usize) -> Result<(), Refusal> {
        let samples = self.samplings.iter().flatten().map(|it| it.count).max().unwrap_or(1);
        if rows.saturating_mul(samples as usize) <= MOST_ROWS {
            return Ok(());
        }
        let message = format!(
            "{rows} rows of {samples} samples each: together they must be at most {MOST_ROWS}"
        );
        Err(Refusal::of_key("samples", message))
    }

    /// The question, answered stage by stage.
    pub(super) fn question(self, mut asked: impl Staged, line: CommandLine) -> Question {
        Question::new(move |go_on, send| {
            let progress = asked.counts().map(|what| Progress::new(send, what, 0, None));
            let of_study = progress.as_ref().map(|_| go_on.of_study());
            let go_on = of_study.as_deref().unwrap_or(go_on);
            let has_scene = self.shown.is_some_and(|it| it.has_scene);
            for sampling in self.samplings {
                let is_quick = sampling.is_none() && self.rows <= QUICK_ROWS && !has_scene;
                let turn = if is_quick { None } else { go_on.turn() };
                if turn.is_none() && !is_quick {
                    return Err(refused(AnswerError::Stopped));
                }
                asked.sample(sampling);
                let is_on = || {
                    progress.iter().for_each(Progress::count);
                    go_on.is_on()
                };
                let options = AnswerOptions {
                    has_page: self.shown.is_some_and(|it| it.draws || it.has_slide),
                    is_strict: self.is_strict,
                    go_on: &is_on,
                };
                let answer = asked.answer(&options)?;
                let scene = if has_scene { asked.scene() } else { None };
                drop(turn);
                if !go_on.is_on() {
                    return Err(refused(AnswerError::Stopped));
                }
                if !send(json::line(&answer)) {
                    return Ok(());
                }
                if let Some(Shown { draws, has_slide, .. }) = self.shown {
                    let mut line = line.clone();
                    asked.add_samples(&mut line, sampling);
                    let mut shown = shown(&answer, &line, draws);
                    asked.add_shown(&mut shown)?;
                    if has_slide {
                        shown["slide"] = json!(slide(&asked, &answer, &line));
                    }
                    if has_scene {
                        shown["scene"] = json!(scene.as_deref().map(base64));
                    }
                    if !send(json::line(&shown)) {
                        return Ok(());
                    }
                }
            }
            Ok(())
        })
    }
}

/// A run in three dimensions, as binary glTF, as `--animate FILE.glb` writes it. Its rover is the
/// node `rover`.
pub(super) fn scene_of(whose: &str, run: &Trajectory, scenario: &Scenario) -> Vec<u8> {
    Animation::of(whose, &[grouser_draw::Shown { name: "rover", run, scenario }]).to_glb()
}

/// The first sentence of an answer over its picture, if it has one.
fn slide(asked: &impl Staged, answer: &Answer, line: &CommandLine) -> Option<String> {
    let picture = asked.picture().or_else(|| Slide::picture_of(answer))?;
    let (says, command) = (Slide::sentence_of(answer), line.text().to_owned());
    Some(Slide::of_answer(says, &picture, &asked.whose(), command).to_svg())
}

/// What a page shows of an answer beside its numbers.
fn shown(answer: &Answer, line: &CommandLine, draws: bool) -> Value {
    let words = answer.screen.iter().filter_map(|shown| match shown {
        Displayed::Words(words) => Some(words.lines()),
        _ => None,
    });
    let documents = answer.documents.iter().map(|it| (it.file.as_str(), it.toml.as_str()));
    let figure = |caption: &str, svg: String| json!({ "caption": caption, "svg": svg });
    let figures = answer.blocks().filter(|_| draws).flat_map(|block| match block {
        PageBlock::Figure { figure: one, caption, .. } => vec![figure(caption, one.to_svg())],
        PageBlock::Charts(all) => {
            all.iter().map(|chart| figure(&chart.title, chart.to_svg())).collect()
        }
        _ => Vec::new(),
    });
    let tables = answer.blocks().filter(|_| draws).filter_map(|block| match block {
        PageBlock::Rows { caption, table, columns } => {
            let (names, all): (Vec<&str>, Vec<usize>) =
                (columns.iter().map(|it| &**it).collect(), (0..table.rows()).collect());
            Some(shown_table(caption, &names, &json!(table.select(&names, &all))))
        }
        _ => None,
    });
    json!({
        "schema": "grouser.shown.v1",
        "command": line.text(),
        "sentences": words.flatten().collect::<Vec<_>>(),
        "assumptions": answer.assumptions(),
        "documents": documents.collect::<BTreeMap<_, _>>(),
        "figures": figures.collect::<Vec<_>>(),
        "tables": tables.collect::<Vec<_>>(),
    })
}

/// A table to be shown: rows with labels for their columns, and for names that stand in cells.
pub(super) fn shown_table(caption: &str, columns: &[impl AsRef<str>], rows: &Value) -> Value {
    let columns: Vec<&str> = columns.iter().map(AsRef::as_ref).collect();
    let cells = rows.as_array().into_iter().flatten().filter_map(Value::as_object);
    let texts = cells.flat_map(|row| row.values()).filter_map(Value::as_str);
    let words: BTreeMap<&str, String> =
        texts.filter(|text| is_name(text)).map(|text| (text, in_words(text))).collect();
    let labels: Vec<String> = columns.iter().map(|column| in_words(column)).collect();
    json!({ "caption": caption, "columns": columns, "labels": labels, "words": words, "rows": rows })
}

/// Whether a text is a column's name or a key, and not in words.
fn is_name(text: &str) -> bool {
    let is_of_names = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "_.".contains(c);
    text.contains('_') && text.chars().all(is_of_names)
}

/// A column or a key in words, with its unit; what is in words already as it is.
fn in_words(name: &str) -> String {
    if is_name(name) { label_of(name) } else { name.to_owned() }
}

/// Why there is no answer.
pub(super) fn refused(error: AnswerError) -> Refusal {
    match error {
        AnswerError::Stopped => Refusal::stopped(),
        AnswerError::Key(error) => Refusal::of_key("gradients", error.to_string()),
        AnswerError::Together(..) => {
            Refusal::new(StatusCode::UNPROCESSABLE_ENTITY, error.to_string())
        }
        AnswerError::Samples(error) => {
            let message = format!("the soil's uncertainty reaches too far: {error}");
            Refusal::of_key("soil", message).with_hint(
                "smaller standard deviations keep the samples within the ranges of their keys",
            )
        }
        error => Refusal::new(StatusCode::UNPROCESSABLE_ENTITY, error.to_string()),
    }
}
