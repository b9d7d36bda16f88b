//! Which numbers of a rover are the best, under limits.

use std::sync::Arc;

use serde_json::{Map, Value, json};

use super::{
    Answer, AnswerError, AnswerOptions, Attached, Displayed, Member, check_flags, meanings,
};
use crate::contact::Model;
use crate::contact::validity::Finding;
use crate::document::columns::design::{self as columns, CHOSEN, DesignRow, MODEL, ROW, SHARE};
use crate::document::columns::{COURSE, SLOPE, flags};
use crate::document::design::Measure;
use crate::document::figure::{Chart, Series, Style, WheelRow, WheelShape};
use crate::document::reading::four_digits;
use crate::document::table::Table;
use crate::document::unit::ONE;
use crate::document::{DesignTask, Kind, LoadedDesign, to_toml};
use crate::studies::design::{
    BestDesign, DesignLimit, DesignStudy, KeptLimit, LimitSide, Nearest, NoDesign,
};
use crate::studies::ensemble::models::{self, Question};

/// The question.
#[derive(Clone, Debug)]
pub struct DesignQuestion {
    /// The task.
    pub task: LoadedDesign,
    /// Whether soils are taken as their documents have them.
    pub is_nominal: bool,
    /// With which random numbers soils are drawn.
    pub seed: u64,
    /// Two measures that are traded for one another, if any are.
    pub trade: Option<[Measure; 2]>,
    /// The task by each of the other models, if what they find is asked for.
    pub by_models: Vec<LoadedDesign>,
}

/// What a row is called that is of the design.
const FOUND: &str = "found";
/// What a row is called that is of what another model finds.
const FOUND_BY_IT: &str = "found by it";
/// The file of the task.
const TASK: &str = "design.toml";
/// Designs along a trade-off.
const TRADE_POINTS: usize = 9;

impl DesignQuestion {
    /// The answer.
    ///
    /// # Errors
    /// [`AnswerError::Design`] where there is no design, [`AnswerError::OutsideDomain`] where no flag
    /// is accepted, and [`AnswerError::Stopped`].
    pub fn answer(&self, name: &str, options: &AnswerOptions<'_>) -> Result<Answer, AnswerError> {
        self.check_trade()?;
        let study = DesignStudy::of(self.task.value.clone(), self.is_nominal, self.seed);
        let why_none = |none: NoDesign| match none {
            NoDesign::Stopped => AnswerError::Stopped,
            _ => AnswerError::Design(self.why_none(&none)),
        };
        let design = study.design_while(options.go_on).map_err(why_none)?;
        let trade_off = |measures| study.trade_off(measures, TRADE_POINTS, options.go_on);
        let trade = self.trade.map(trade_off).transpose().map_err(why_none)?;
        let findings = study.findings(design.candidate, &design.values, None);
        let rows = self.rows(&study, &design, options);
        let (limits, designs) = (columns::limits(&design.kept), self.table(&rows));
        let (limits, designs) = (Arc::new(limits), Arc::new(designs));
        if options.is_strict {
            check_flags([&*findings], &designs.rows_at(&[1]), &[ROW, MODEL])?;
        }
        let mut answer = Answer::new(name, "A design");
        self.state(&mut answer, &study);
        answer.results = vec![
            Member::Value("design", self.free_numbers(&design)),
            Member::Value("objective", json!(design.objective)),
            Member::rows("constraints", Arc::clone(&limits)),
            Member::rows("designs", Arc::clone(&designs)),
            Member::Value(
                "certificate",
                json!({ "probes": design.certificate.probes, "better": design.certificate.better }),
            ),
            Member::Value(
                "starts",
                json!({ "searches": design.certificate.starts, "agreed": design.certificate.agreed }),
            ),
        ];
        answer.tables = vec![
            (name.to_owned(), Arc::clone(&designs)),
            ("constraints".into(), Arc::clone(&limits)),
        ];
        let lines = self.lines(&design, &rows, &findings);
        let brief = brief(&study.task);
        answer.screen = vec![
            Displayed::Words(lines.join("\n") + "\n\n"),
            Displayed::Rows(Arc::clone(&limits), limits_in_brief(&limits)),
            Displayed::Words(if is_by_samples(&design) {
                "\nOn the soil as its document has it:\n".to_owned()
            } else {
                "\n".to_owned()
            }),
            Displayed::Rows(Arc::clone(&designs), brief.clone()),
        ];
        for line in lines {
            answer.verdict(line);
        }
        answer.rows(
            "What is limited, and what loosening it by one is worth",
            &limits,
            limits_in_brief(&limits),
        );
        answer.rows(
            "What it was and what was found, by each model, on the soil as its document has it",
            &designs,
            brief.clone(),
        );
        if let (Some(trade), Some(measures)) = (trade, self.trade) {
            self.add_trade(&mut answer, &study, &trade, measures, &brief);
        }
        answer.findings = Some(findings);
        answer.columns = meanings(columns::LIMITS);
        answer.columns.extend(meanings(columns::DESIGNS));
        answer.attach(TASK, &self.task);
        answer.documents.push(self.rover(&design));
        Ok(answer)
    }

    /// The inputs of the answer.
    fn state(&self, answer: &mut Answer, study: &DesignStudy) {
        let keys = [
            "rover",
            "soil",
            "gravity_m_s2",
            SLOPE.name,
            COURSE.name,
            "minimise",
            "weights",
            "free",
            "choose",
            "subject_to",
            "also",
        ];
        answer.inputs_of(&self.task.document, keys);
        answer.input("model", self.task.value.model(0).name());
        if study.is_uncertain() {
            answer.input("probability", self.task.value.probability);
            answer.input("samples", DesignStudy::SAMPLES);
            answer.input("fresh_samples", DesignStudy::FRESH_SAMPLES);
            answer.input("seed", self.seed);
        }
    }

    fn free_numbers(&self, design: &BestDesign) -> Value {
        let task = &self.task.value;
        let chosen = task.candidates[design.candidate].chosen.iter().cloned();
        let free = task.free.iter().map(|(key, _)| key.clone());
        let free = free.zip(design.values.iter().map(|value| json!(value)));
        Value::Object(chosen.chain(free).collect::<Map<String, Value>>())
    }

    /// The rover as given, and as found by its model and by the others.
    fn rows(
        &self,
        study: &DesignStudy,
        design: &BestDesign,
        options: &AnswerOptions<'_>,
    ) -> Vec<DesignRow> {
        let task = &self.task.value;
        let row = |name: &str, place: usize, model: &Model, values: &[f64]| DesignRow {
            name: name.to_owned(),
            model: model.name().to_owned(),
            chosen: task.candidates[place].chosen.clone(),
            values: values.to_vec(),
            measures: study.nominal_measures(place, values, model),
            findings: study.findings(place, values, Some(model)),
        };
        let found = design.candidate;
        let (given, own) = (task.model(0), task.model(found));
        let first = if task.candidates[0].chosen.is_empty() { "as given" } else { "first choice" };
        let mut rows = vec![
            row(first, 0, given, &task.candidates[0].given),
            row(FOUND, found, own, &design.values),
        ];
        let question = Question::on_course(task.candidates[found].grounds[0].course);
        let others = Model::ALL.iter().filter(|it| *it != own && models::answers(it, question));
        rows.extend(others.map(|other| row(FOUND, found, other, &design.values)));
        rows.extend(self.by_models.iter().map(|task| {
            let study = DesignStudy::of(task.value.clone(), self.is_nominal, self.seed);
            let model = task.value.model(0);
            match study.design_while(options.go_on) {
                Ok(by) => row(FOUND_BY_IT, by.candidate, model, &by.values),
                Err(_) => DesignRow { measures: None, ..row(FOUND_BY_IT, found, model, &[]) },
            }
        }));
        rows
    }

    fn table(&self, rows: &[DesignRow]) -> Table {
        let keys: Vec<&str> = self.task.value.free.iter().map(|(key, _)| &**key).collect();
        columns::designs(rows, &keys)
    }

    /// What is said of the design.
    fn lines(&self, design: &BestDesign, rows: &[DesignRow], findings: &[Finding]) -> Vec<String> {
        let task = &self.task.value;
        let numbers =
            self.numbers_in_words(&task.candidates[design.candidate].chosen, &design.values);
        let aim = self.aim();
        let is_least = design.certificate.better == 0;
        let mut lines = vec![format!(
            "{aim} is {} {}, with {numbers}.",
            four_digits(design.objective),
            if is_least { "at the least" } else { "at the best that was found" }
        )];
        if is_by_samples(design) {
            lines.push(format!(
                "The soil is uncertain: that is the mean over samples, and every limit is to be kept \
                 with a probability of {}.",
                four_digits(task.probability)
            ));
        }
        lines.extend(design.kept.iter().filter_map(|kept| self.price_line(kept)));
        lines.extend(self.ends_line(design));
        lines.extend(design.kept.iter().filter_map(|kept| short_line(kept, task.probability)));
        lines.extend(models_line(design, rows));
        lines.extend(self.choices_line(design, rows));
        lines.extend(domain_line(findings));
        if !is_least {
            lines.push("It is not the least: designs near it are better.".to_owned());
        }
        let it = design.certificate;
        lines.push(format!(
            "{} of {} searches came to it; {} of {} designs within 1 % of the bounds are better.",
            it.agreed, it.starts, it.better, it.probes
        ));
        lines
    }

    /// What the aim is called.
    fn aim(&self) -> String {
        let weights = Measure::ALL.into_iter().zip(self.task.value.weights);
        let all: Vec<(Measure, f64)> = weights.filter(|(_, weight)| *weight != 0.0).collect();
        if let [(measure, _)] = all[..] {
            return measure.name().to_owned();
        }
        let terms = all.iter().map(|(it, weight)| format!("{weight} {}", it.name()));
        terms.collect::<Vec<_>>().join(" + ")
    }

    /// Numbers of a design, those that were chosen first.
    fn numbers_in_words(&self, chosen: &[(String, Value)], values: &[f64]) -> String {
        let chosen = chosen.iter().map(|(key, value)| format!("{key} = {value}"));
        let pairs = self.task.value.free.iter().zip(values);
        let free = pairs.map(|((key, _), value)| format!("{key} = {}", four_digits(*value)));
        chosen.chain(free).collect::<Vec<_>>().join(", ")
    }

    /// What a limit costs.
    fn price_line(&self, kept: &KeptLimit) -> Option<String> {
        let unit = kept.limit.measure.unit();
        // A ratio is loosened by a hundredth.
        let (by, price) = if unit == ONE {
            ("0.01".to_owned(), 0.01 * kept.price)
        } else {
            (format!("1 {}", unit.symbol), kept.price)
        };
        (kept.price > 0.0).then(|| {
            format!(
                "{} holds it back: {by} {} would save {} of {}.",
                limit_in_words(&kept.limit),
                if kept.limit.side == LimitSide::AtMost { "more" } else { "less" },
                four_digits(price),
                self.aim()
            )
        })
    }

    /// What each of the other models chooses, where they were asked.
    fn choices_line(&self, design: &BestDesign, rows: &[DesignRow]) -> Option<String> {
        /// Choices that differ by less, over the bounds, are one [-].
        const APART: f64 = 0.01;
        let free = &self.task.value.free;
        let chosen = &self.task.value.candidates[design.candidate].chosen;
        let differs = |row: &&DesignRow| {
            let pairs = row.values.iter().zip(&design.values).zip(free);
            let mut moved =
                pairs.map(|((one, other), (_, ends))| (one - other) / (ends[1] - ends[0]));
            row.values.is_empty() || row.chosen != *chosen || moved.any(|it| it.abs() > APART)
        };
        let by_others: Vec<&DesignRow> = rows.iter().filter(|it| it.name == FOUND_BY_IT).collect();
        let of = |row: &DesignRow| match &row.values[..] {
            [] => format!("{}: no design", row.model),
            values => format!("{}: {}", row.model, self.numbers_in_words(&row.chosen, values)),
        };
        let others = by_others.iter().copied().filter(differs).map(of).collect::<Vec<_>>();
        (!by_others.is_empty()).then(|| match &others[..] {
            [] => "The choice does not change with the model.".to_owned(),
            _ => format!("The choice changes with the model: {}.", others.join("; ")),
        })
    }

    /// Which numbers lie at an end of what they may be.
    fn ends_line(&self, design: &BestDesign) -> Option<String> {
        let at_end = self.at_ends(&design.values);
        (!at_end.is_empty()).then(|| format!("Bounds hold it back, too: {}.", at_end.join(", ")))
    }

    /// The numbers at an end of what they may be, in words.
    fn at_ends(&self, values: &[f64]) -> Vec<String> {
        /// Nearer to an end than this, over the bounds, is at it [-].
        const AT_END: f64 = 1e-6;
        let pairs = self.task.value.free.iter().zip(values);
        let at_end = pairs.filter_map(|((key, [least, most]), value)| {
            let near = AT_END * (most - least);
            let end = if value - least < near {
                "the least"
            } else if most - value < near {
                "the most"
            } else {
                return None;
            };
            Some(format!("{key} is {end} that it may be"))
        });
        at_end.collect()
    }

    /// Checks that every rover has what is traded.
    fn check_trade(&self) -> Result<(), AnswerError> {
        let is_traded = self.trade.iter().flatten().any(|it| *it == Measure::Current);
        let mut rovers = self.task.value.candidates.iter().map(|it| &it.grounds[0].scenario.value);
        if is_traded && rovers.any(|it| !it.rover.has_motors()) {
            return Err(AnswerError::Design(format!(
                "{} is traded, and no motor of the rover is known: give it one, rover.motor",
                Measure::Current.name()
            )));
        }
        Ok(())
    }

    /// Designs between the least of one measure and of another.
    fn add_trade(
        &self,
        answer: &mut Answer,
        study: &DesignStudy,
        trade: &[BestDesign],
        [first, second]: [Measure; 2],
        brief: &[String],
    ) {
        let row = |design: &BestDesign| DesignRow {
            name: FOUND.to_owned(),
            model: String::new(),
            chosen: self.task.value.candidates[design.candidate].chosen.clone(),
            values: design.values.clone(),
            measures: Some(design.measures),
            findings: study.findings(design.candidate, &design.values, None),
        };
        let rows: Vec<DesignRow> = trade.iter().map(row).collect();
        let table = Arc::new(self.table(&rows));
        let of = |measure: Measure| format!("{} [{}]", measure.doc(), measure.unit().symbol);
        let point = |design: &BestDesign| {
            let [y, x] = [first, second].map(|it| it.unit().from_si(design.measures[it.place()]));
            (x, y)
        };
        let line = Series::new(FOUND, Style::Line, 0, trade.iter().map(point));
        let chart =
            Chart::new("What one is worth in the other", (of(second), of(first)), vec![line]);
        answer.charts(vec![chart]);
        let wheels = trade.iter().filter_map(|it| drawn(study, it, [first, second])).collect();
        let title = format!("From the best {} to the best {}", first.name(), second.name());
        answer.figure(Some("wheels"), WheelRow { title, wheels }, WHEELS_CAPTION);
        let skipped = [ROW, MODEL, first.name(), second.name()];
        let own = brief.iter().filter(|it| !skipped.contains(&&***it)).cloned();
        let traded = [first, second].map(|it| it.name().to_owned());
        let names: Vec<String> = own.chain(traded).collect();
        answer.rows("Designs along the trade-off", &table, names.clone());
        let is_one = trade
            .iter()
            .all(|it| (it.candidate, &it.values) == (trade[0].candidate, &trade[0].values));
        let (first, second) = (first.name(), second.name());
        answer.screen.push(Displayed::Words(if is_one {
            format!("\nOne design has the best {first} and the best {second}:\n")
        } else {
            format!("\nBetween the best {first} and the best {second}:\n")
        }));
        answer.screen.push(Displayed::Rows(Arc::clone(&table), names));
        answer.results.push(Member::rows("trade", Arc::clone(&table)));
        answer.tables.push(("trade".into(), table));
    }

    /// The rover's document with the numbers that were found.
    fn rover(&self, design: &BestDesign) -> Attached {
        let ground = &self.task.value.candidates[design.candidate].grounds[0];
        let document = &ground.scenario.document;
        let numbers = design.numbers.iter().map(|(key, value)| (&**key, *value));
        let changed = document.with(numbers).part(Kind::Rover, "rover");
        Attached {
            file: "rover.toml".into(),
            toml: changed.map_or_else(String::new, |rover| to_toml(&rover)),
            companions: Vec::new(),
            assumptions: Vec::new(),
        }
    }

    fn keys(&self) -> String {
        self.task.value.free.iter().map(|(key, _)| &**key).collect::<Vec<_>>().join(", ")
    }

    /// Why there is no design, in words that name the task's keys.
    #[must_use]
    pub fn why_none(&self, none: &NoDesign) -> String {
        match none {
            NoDesign::Unreachable(nearest) => self.why_missed(none, nearest),
            NoDesign::BeyondGround { limit, stands } => format!(
                "no wheel within these bounds crosses {}° of this soil{}: the ground's own limit is \
                 {}°; ask for less (`{}`), or on another soil",
                four_digits(limit.bound.to_degrees()),
                on_ground(limit),
                four_digits(stands.to_degrees()),
                if limit.bound > self.task.value.candidates[0].grounds[limit.ground].slope {
                    "subject_to.limit_slope_deg"
                } else {
                    "slope_deg"
                },
            ),
            NoDesign::Constant => format!(
                "{} does not depend on any number that is free ({}): free one that acts on it, or \
                 minimise another measure",
                self.aim(),
                self.keys()
            ),
            NoDesign::NothingMoves => format!(
                "{none}: other bounds of {}, or another soil or gravity, may have one",
                self.keys()
            ),
            NoDesign::NotFound | NoDesign::NoSample(_) | NoDesign::Stopped => none.to_string(),
        }
    }

    /// Which limits the nearest design misses, and what to change.
    fn why_missed(&self, none: &NoDesign, nearest: &Nearest) -> String {
        let Nearest { candidate, values, missed } = nearest;
        let each = missed.iter().map(|(limit, value)| {
            let has = four_digits(limit.measure.unit().from_si(*value));
            format!("{} where it has {has}", limit_in_words(limit))
        });
        let ends = self.at_ends(values);
        let ends = if ends.is_empty() {
            String::new()
        } else {
            format!(", or widen the bounds that hold it back ({})", ends.join(", "))
        };
        format!(
            "{none}: the nearest, with {}, misses {}; loosen that{ends}",
            self.numbers_in_words(&self.task.value.candidates[*candidate].chosen, values),
            each.collect::<Vec<_>>().join(" and ")
        )
    }
}

/// What the drawing of wheels shows.
const WHEELS_CAPTION: &str = "The first wheel of each design along the trade-off, to one scale, from \
                              its side and from behind, as deep in the soil as the deepest wheel.";

/// A design's first wheel.
///
/// * `traded`: the measures that are traded
fn drawn(study: &DesignStudy, design: &BestDesign, traded: [Measure; 2]) -> Option<WheelShape> {
    let rover = study.rover(design)?;
    let wheel = rover.mounts().first()?.unit.wheel;
    let sinkage = design.measures[Measure::SinkageRatio.place()] * wheel.shearing_radius();
    let measured = traded.map(|measure| {
        let unit = measure.unit();
        let value = four_digits(unit.from_si(design.measures[measure.place()]));
        if unit == ONE { value } else { format!("{value} {}", unit.symbol) }
    });
    let millimetres = |letter: &str, size: f64| format!("{letter} {:.0} mm", 1e3 * size);
    let mut lines = measured.to_vec();
    lines.extend([millimetres("r", wheel.radius), millimetres("b", wheel.width)]);
    if let Some(grousers) = wheel.grousers {
        lines.push(format!("{} × {:.0} mm", grousers.count, 1e3 * grousers.height));
    }
    Some(WheelShape { wheel, sinkage, lines })
}

/// Whether a design was found by samples of a soil that is uncertain.
fn is_by_samples(design: &BestDesign) -> bool {
    design.kept.iter().any(|it| it.share.is_some())
}

/// A sentence on flags.
fn domain_line(findings: &[Finding]) -> Option<String> {
    let all: Vec<String> = findings.iter().map(flags::in_words).collect();
    (!all.is_empty()).then(|| {
        format!(
            "The design lies outside what its model and soil were tested for: {}.",
            all.join("; ")
        )
    })
}

/// On which ground, where it is not the first.
fn on_ground(limit: &DesignLimit) -> String {
    if limit.ground == 0 { String::new() } else { format!(" on ground {}", limit.ground + 1) }
}

/// Which other models say that the design misses a limit.
fn models_line(design: &BestDesign, rows: &[DesignRow]) -> Option<String> {
    let nominal = |kept: &&KeptLimit| kept.limit.ground == 0;
    let misses =
        |row: &&DesignRow| {
            let measures = row.measures.as_ref();
            design.kept.iter().filter(nominal).any(|kept| {
                measures.is_none_or(|it| !kept.limit.holds(it[kept.limit.measure.place()]))
            })
        };
    // The first is by the design's own model.
    let others = rows.iter().filter(|row| row.name == FOUND).skip(1);
    let names: Vec<&str> = others.filter(misses).map(|row| &*row.model).collect();
    (!names.is_empty()).then(|| format!("By other models it misses a limit: {}.", names.join(", ")))
}

/// A limit, such as `limit_slope_deg ≥ 21`.
fn limit_in_words(limit: &DesignLimit) -> String {
    let sign = match limit.side {
        LimitSide::AtLeast => "≥",
        LimitSide::AtMost => "≤",
    };
    let bound = four_digits(limit.measure.unit().from_si(limit.bound));
    format!("{} {sign} {bound}{}", limit.measure.name(), on_ground(limit))
}

/// A sentence on a limit that fewer fresh samples keep than are to.
fn short_line(kept: &KeptLimit, probability: f64) -> Option<String> {
    let share = kept.share.filter(|share| *share < probability)?;
    Some(format!(
        "Of {} soils that took no part only {} % keep {}.",
        DesignStudy::FRESH_SAMPLES,
        four_digits(100.0 * share),
        limit_in_words(&kept.limit)
    ))
}

/// The columns of limits that are there.
fn limits_in_brief(limits: &Table) -> Vec<String> {
    let has = |name: &String| name != SHARE || limits.numbers(SHARE).iter().any(Option::is_some);
    limits.names().into_iter().filter(has).collect()
}

/// The columns of designs for reading: what was chosen, the free numbers, what is to be least, what
/// is limited.
fn brief(task: &DesignTask) -> Vec<String> {
    let asked = |measure: &Measure| {
        let ends = task.limits[measure.place()];
        task.weights[measure.place()] != 0.0 || ends.least.is_finite() || ends.most.is_finite()
    };
    let measures = Measure::ALL.into_iter().filter(asked).map(|it| it.name().to_owned());
    let free = task.free.iter().map(|(key, _)| key.clone());
    let chosen = (task.candidates.len() > 1).then(|| CHOSEN.to_owned());
    [ROW, MODEL].map(String::from).into_iter().chain(chosen).chain(free).chain(measures).collect()
}
