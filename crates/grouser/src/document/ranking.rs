//! Ranks every wheel–soil model on every data set: those that come with the program, or those of a
//! folder.

mod parts;
mod sets;

use std::path::Path;

use serde::Serialize;

pub use self::parts::RankingError;
use self::parts::{
    DataSet, Part, beside_its_document, data_sets_in, data_sets_of_the_program, heading_study,
};
pub use self::sets::{AnswersRecord, SetRecord, evidence};

use super::measurements::{self, Choice, Limits};
use super::validation::{GroupRecord, PartErrors, ReferenceRecord, SlopeErrorsRecord};
use super::{
    LoadedRover, LoadedSoil, LoadedWheel, Overrides, Source, Tested, read_data_set, read_scenario,
};
use crate::contact::Model;
use crate::soil::SmallWheel;
use crate::studies::measurement::WheelTests;
use crate::studies::slope_tests::SlopeTests;
use crate::studies::slope_validation::{SlopeValidation, SlopeValidationStudy};
use crate::studies::validation::{Validation, ValidationStudy, Yardstick, mean_score};

/// Every model on every part of some data sets.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Ranking {
    /// Part by part, best first.
    pub rows: Vec<RankedModel>,
    /// Predictions without physics, part by part.
    pub yardsticks: Vec<RankedYardstick>,
    /// Each model, and each yardstick, over all parts, best first.
    pub models: Vec<OverAll>,
    /// The band of all models together on each part, and the slips at which the pull vanishes.
    pub sets: Vec<SetRecord>,
}

/// A wheel–soil model with a soil on a part of a data set.
#[derive(Clone, Debug, Serialize)]
pub struct RankedModel {
    /// The data set's name.
    pub data_set: String,
    /// Its part.
    pub case: String,
    /// Place among the models of the part, from 1.
    pub rank: usize,
    /// The model's name.
    pub model: &'static str,
    /// The soil's name.
    pub soil: String,
    /// Whether the soil was fitted to these rows: its errors are in sample, and no prediction.
    pub in_sample: bool,
    /// Root mean square error over the standard deviation of what was measured, averaged over
    /// the measured quantities [-]: 0 is perfect, 1 no better than a constant.
    pub score: Option<f64>,
    /// Trials without a prediction: the soil cannot carry the wheel. Of a rover, slopes without a
    /// yaw.
    pub unsettled_trials: usize,
    /// Errors of the driven cells.
    pub driven: Option<GroupRecord>,
    /// Errors of all cells.
    pub overall: PartErrors,
    /// All errors.
    #[serde(skip)]
    pub found: Found,
}

/// The predictions behind a ranked model.
#[derive(Clone, Debug)]
pub enum Found {
    /// Predictions for a wheel's trials.
    Wheel(Box<Validation>),
    /// Predictions for a rover's slopes.
    Slope(Box<SlopeValidation>),
}

/// A prediction without physics on a part of a data set.
#[derive(Clone, Debug, Serialize)]
pub struct RankedYardstick {
    /// The data set's name.
    pub data_set: String,
    /// Its part.
    pub case: String,
    /// The score, as of a model.
    pub score: Option<f64>,
    /// How it was predicted, and its errors.
    #[serde(flatten)]
    pub reference: ReferenceRecord<PartErrors>,
}

/// A model, or a yardstick, over all parts of all data sets, with soils that were not fitted to
/// them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OverAll {
    /// The model's name; null for a yardstick.
    pub model: Option<&'static str>,
    /// The yardstick's name; null for a model.
    pub yardstick: Option<&'static str>,
    /// Number of parts with a score.
    pub parts: usize,
    /// The mean of their scores [-].
    pub score: Option<f64>,
    /// Number of aims that are met, over all quantities of all parts.
    pub aims_met: usize,
    /// Number of aims.
    pub aims: usize,
    /// Trials without a prediction.
    pub unsettled_trials: usize,
    /// The score on each part, in the order of the parts; null where there is none.
    pub scores: Vec<PartScore>,
}

/// The score on a part.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PartScore {
    /// The data set's name.
    pub data_set: String,
    /// Its part.
    pub case: String,
    /// The score, the mean over the soils [-].
    pub score: Option<f64>,
}

/// Ranks every model on every data set of a folder, or without a folder on those that come with the
/// program: data set by data set and part by part, best first, beside predictions without physics.
///
/// * `limits`: how much of each file is read
///
/// # Errors
/// [`RankingError`] for a folder, a document or a file that cannot be used.
pub fn rank_all(folder: Option<&Path>, limits: Limits) -> Result<Ranking, RankingError> {
    let sets = match folder {
        Some(folder) => data_sets_in(folder)?,
        None => data_sets_of_the_program()?,
    };
    rank_sets(&sets, folder.is_none(), limits)
}

/// Ranks every model on one data set: a preset, or a document beside its file of measurements. A
/// text in memory has no such file, and no rows.
///
/// # Errors
/// The same as [`rank_all`].
pub fn rank_one(source: &Source, limits: Limits) -> Result<Ranking, RankingError> {
    let set = read_data_set(source, &Overrides::none())?;
    let data_set = match source {
        Source::Preset(preset) => {
            let rows = measurements::Source::preset(preset.name);
            rows.map(|rows| DataSet { set, rows, named_at: None })
        }
        Source::File(path) | Source::Confined { path, .. } => Some(beside_its_document(set, path)?),
        // A text in memory has no file beside it.
        Source::Text { .. } => None,
    };
    rank_sets(data_set.as_slice(), false, limits)
}

/// * `are_known`: whether these are all sets of the program
fn rank_sets(sets: &[DataSet], are_known: bool, limits: Limits) -> Result<Ranking, RankingError> {
    let mut ranking = Ranking::default();
    for DataSet { set, rows, named_at } in sets {
        for case in &set.value.cases {
            let part = Part { set, case };
            let ranked = part.rank(rows, limits, &mut ranking);
            ranked.map_err(|error| match (error, named_at) {
                (RankingError::Measurements(error), Some(place)) => {
                    RankingError::Measurements(error.named_at(place.clone()))
                }
                (error, _) => error,
            })?;
        }
    }
    ranking.models = over_all(&ranking);
    ranking.sets = sets::records(sets, are_known, limits)?;
    Ok(ranking)
}

impl Part<'_> {
    /// Every model with the soils of the part, best first, and the yardsticks.
    fn rank(
        &self,
        rows: &measurements::Source,
        limits: Limits,
        into: &mut Ranking,
    ) -> Result<(), RankingError> {
        let conditions = self.case.conditions.clone();
        let choice = Choice { conditions, wheel: None, limits };
        let mut all = match &self.case.tested {
            Tested::Wheel(wheel) => self.of_wheel(wheel, &rows.read(&choice)?.tests),
            Tested::Rover(rover) => {
                self.of_rover(rover, &rows.read_slopes(&choice, &rover.value)?)?
            }
        };
        // What has no prediction for a trial ranks below whatever has one for each.
        let key = |one: &RankedModel| (one.unsettled_trials, one.score.unwrap_or(f64::INFINITY));
        all.sort_by(|one, other| {
            let ((unsettled, score), (others, other_score)) = (key(one), key(other));
            unsettled.cmp(&others).then(score.total_cmp(&other_score))
        });
        for (place, one) in all.iter_mut().enumerate() {
            one.rank = place + 1;
        }
        if let Some(one) = all.first() {
            into.yardsticks.extend(self.yardsticks(&one.found));
        }
        into.rows.extend(all);
        Ok(())
    }

    /// Each soil with each model that may be judged with it.
    fn pairs(&self) -> impl Iterator<Item = (&String, &LoadedSoil, Model)> {
        self.case.soils.iter().flat_map(move |(name, soil)| {
            Model::ALL.into_iter().filter_map(move |model| {
                let is_for = |soil: &LoadedSoil| soil.document.model().is_none_or(|it| it == model);
                // A soil that was made for a model is judged with that one; where these rows chose
                // it and there is no other, the rest stand beside it.
                let is_alone = self.case.is_fitted(name) && self.case.soils.len() == 1;
                let for_another = !is_for(soil) && !is_alone;
                // Without its terms the small-wheel model is the classical one.
                let same = model == Model::SmallWheel && soil.value.small_wheel == SmallWheel::OFF;
                (!for_another && !same).then_some((name, soil, model))
            })
        })
    }

    fn of_wheel(&self, wheel: &LoadedWheel, tests: &WheelTests) -> Vec<RankedModel> {
        let one = |(name, soil, model): (&String, &LoadedSoil, Model)| {
            let (wheel, soil, gravity) = (wheel.value, soil.value, self.set.value.gravity);
            let validation =
                ValidationStudy { tests, wheel, soil, model: model.clone(), gravity }.run();
            RankedModel {
                score: validation.overall.score(),
                unsettled_trials: validation.overall.unsettled,
                driven: validation.driven.as_ref().map(GroupRecord::from),
                overall: PartErrors::Wheel(GroupRecord::from(&validation.overall)),
                ..self.ranked(&model, name, Found::Wheel(Box::new(validation)))
            }
        };
        self.pairs().map(one).collect()
    }

    fn of_rover(
        &self,
        rover: &LoadedRover,
        tests: &SlopeTests,
    ) -> Result<Vec<RankedModel>, RankingError> {
        let usual = read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
        let one = |(name, soil, model): (&String, &LoadedSoil, Model)| {
            let gravity = self.set.value.gravity;
            let heading = heading_study(&usual, rover, soil, model.clone(), gravity);
            let validation = SlopeValidationStudy { tests, heading: &heading }.run()?;
            Ok(RankedModel {
                score: validation.score(),
                unsettled_trials: validation.no_prediction(),
                overall: PartErrors::Slope(SlopeErrorsRecord::from(&validation)),
                ..self.ranked(&model, name, Found::Slope(Box::new(validation)))
            })
        };
        self.pairs().map(one).collect()
    }

    /// A model with a soil, before its errors are put in.
    fn ranked(&self, model: &Model, soil: &str, found: Found) -> RankedModel {
        RankedModel {
            data_set: self.set.document.name().to_owned(),
            case: self.case.name.clone(),
            rank: 0,
            model: model.name(),
            soil: soil.to_owned(),
            in_sample: self.case.is_fitted(soil),
            score: None,
            unsettled_trials: 0,
            driven: None,
            overall: PartErrors::Slope(SlopeErrorsRecord::NONE),
            found,
        }
    }

    fn yardsticks(&self, found: &Found) -> Vec<RankedYardstick> {
        let ranked = |reference: ReferenceRecord<PartErrors>, score| RankedYardstick {
            data_set: self.set.document.name().to_owned(),
            case: self.case.name.clone(),
            score,
            reference,
        };
        match found {
            Found::Wheel(validation) => validation
                .references
                .iter()
                .map(|it| {
                    ranked(ReferenceRecord::from(it).map(PartErrors::Wheel), it.overall.score())
                })
                .collect(),
            Found::Slope(validation) => validation
                .references
                .iter()
                .map(|it| ranked(ReferenceRecord::from(it).map(PartErrors::Slope), it.score()))
                .collect(),
        }
    }
}

/// Each model and each yardstick over all parts: first the models, then the yardsticks, best first.
fn over_all(ranking: &Ranking) -> Vec<OverAll> {
    let mut parts: Vec<(&str, &str)> = Vec::new();
    for row in &ranking.rows {
        let part = (row.data_set.as_str(), row.case.as_str());
        if !parts.contains(&part) {
            parts.push(part);
        }
    }
    let models = Model::ALL.into_iter().map(|model| {
        let rows = ranking.rows.iter().filter(|row| row.model == model.name() && !row.in_sample);
        let rows = rows.map(|row| Judged {
            part: (&row.data_set, &row.case),
            score: row.score,
            unsettled_trials: row.unsettled_trials,
            errors: &row.overall,
        });
        OverAll { model: Some(model.name()), ..OverAll::of(&parts, &rows.collect::<Vec<_>>()) }
    });
    let yardsticks = Yardstick::ALL.into_iter().map(|yardstick| {
        let name = yardstick.name();
        let rows = ranking.yardsticks.iter().filter(|row| row.reference.yardstick == name);
        let rows = rows.map(|row| Judged {
            part: (&row.data_set, &row.case),
            score: row.score,
            unsettled_trials: 0,
            errors: &row.reference.overall,
        });
        OverAll { yardstick: Some(name), ..OverAll::of(&parts, &rows.collect::<Vec<_>>()) }
    });
    let best_first = |all: &mut Vec<OverAll>| {
        let score = |one: &OverAll| one.score.unwrap_or(f64::INFINITY);
        all.retain(|one| one.parts > 0);
        all.sort_by(|one, other| score(one).total_cmp(&score(other)));
    };
    let (mut models, mut yardsticks): (Vec<_>, Vec<_>) = (models.collect(), yardsticks.collect());
    best_first(&mut models);
    best_first(&mut yardsticks);
    models.into_iter().chain(yardsticks).collect()
}

/// A model or yardstick on a part.
struct Judged<'a> {
    part: (&'a str, &'a str),
    score: Option<f64>,
    unsettled_trials: usize,
    errors: &'a PartErrors,
}

impl OverAll {
    fn of(parts: &[(&str, &str)], rows: &[Judged<'_>]) -> Self {
        let scores = parts.iter().map(|part| PartScore {
            data_set: part.0.to_owned(),
            case: part.1.to_owned(),
            score: mean_score(
                rows.iter().filter(|row| row.part == *part).filter_map(|row| row.score),
            ),
        });
        let scores: Vec<PartScore> = scores.collect();
        let aims = rows.iter().flat_map(|row| row.errors.measured());
        let aims: Vec<bool> = aims.filter_map(|(_, errors)| errors.within_aim).collect();
        Self {
            model: None,
            yardstick: None,
            parts: scores.iter().filter(|part| part.score.is_some()).count(),
            score: mean_score(scores.iter().filter_map(|part| part.score)),
            aims_met: aims.iter().filter(|met| **met).count(),
            aims: aims.len(),
            unsettled_trials: rows.iter().map(|row| row.unsettled_trials).sum(),
            scores,
        }
    }
}
