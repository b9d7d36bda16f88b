//! What is believed of a soil under several wheel–soil models, and of the models themselves.

use super::archive::{Archive, numbers};
use super::filter::{Filter, Taken};
use super::motion::{NotUsed, SeenMotion};
use super::settings::LearnSettings;
use super::unknowns::{LearntSample, Unknowns};
use crate::contact::Model;
use crate::elementary::exp;
use crate::studies::ensemble::models::ModelSpread;
use crate::studies::ensemble::samples::BandInputs;
use crate::studies::heading::HeadingStudy;
use grouser_io::statistics::NothingAccepted;

/// A filter for each model, with its weight.
#[derive(Clone, Debug)]
pub(super) struct Bank {
    filters: Vec<Filter>,
    /// The models' shares beforehand [-].
    shares: Vec<f64>,
    /// The logarithm of what the observations say for each.
    evidence: Vec<f64>,
}

/// What a motion taught the model with the greatest share.
#[derive(Clone, Debug)]
pub(super) struct Taught {
    /// The number of its filter.
    pub(super) filter: usize,
    /// What the filter made of it.
    pub(super) taken: Taken,
    /// How much it narrowed what is believed [nat].
    pub(super) information: f64,
}

impl Bank {
    /// What is believed beforehand; `None` of a soil that is known exactly.
    pub(super) fn new(inputs: &BandInputs) -> Option<Self> {
        let models = inputs.models().shares();
        let filters: Option<Vec<Filter>> = models
            .iter()
            .map(|(model, _)| Unknowns::of(model.clone(), inputs).map(Filter::new))
            .collect();
        let shares = models.iter().map(|(_, share)| *share).collect();
        Some(Self { filters: filters?, shares, evidence: vec![0.0; models.len()] })
    }

    /// The models with their shares [-].
    ///
    /// What the observations say for a model counts by [`LearnSettings::trust`], and a part of the
    /// shares is what it was beforehand: no model is right, and a likelihood that takes one for
    /// right would leave only one.
    pub(super) fn models(&self, settings: &LearnSettings) -> ModelSpread {
        let most = self.evidence.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let told: Vec<f64> = self
            .shares
            .iter()
            .zip(&self.evidence)
            .map(|(share, evidence)| share * exp(settings.trust * (evidence - most)))
            .collect();
        let sum: f64 = told.iter().sum();
        let kept = settings.kept_share;
        let shares = self
            .shares
            .iter()
            .zip(told)
            .map(|(before, told)| kept * before + (1.0 - kept) * told / sum);
        let models = self.filters.iter().map(|it| it.unknowns.model().clone());
        ModelSpread::of_shares(models.zip(shares).collect())
    }

    /// The filter of the model with the greatest share.
    pub(super) fn best(&self, settings: &LearnSettings) -> &Filter {
        let models = self.models(settings);
        let shares = models.shares().iter().map(|(_, share)| *share).enumerate();
        let best = shares.max_by(|one, other| one.1.total_cmp(&other.1)).map_or(0, |it| it.0);
        &self.filters[best]
    }

    /// Learns from a motion.
    ///
    /// # Errors
    /// [`NotUsed`] where no model has anything to say of it.
    pub(super) fn learn(
        &mut self,
        study: &HeadingStudy,
        motion: &SeenMotion,
        settings: &LearnSettings,
        way: f64,
    ) -> Result<Taught, NotUsed> {
        let models = self.models(settings);
        let mut densities = Vec::new();
        let mut best: Option<(f64, Taught)> = None;
        for (place, filter) in self.filters.iter_mut().enumerate() {
            filter.wander(way, settings.wandering);
            let before = filter.knowledge();
            let learnt = filter.learn(study, motion, &settings.noise);
            let Ok(taken) = learnt else { continue };
            let information = filter.knowledge() - before;
            let share = models.shares()[place].1;
            densities.push((place, taken.surprise.log_density));
            if best.as_ref().is_none_or(|(most, _)| share > *most) {
                best = Some((share, Taught { filter: place, taken, information }));
            }
        }
        let (_, taught) = best.ok_or(NotUsed::NotCarried)?;
        let least = densities.iter().map(|it| it.1).fold(f64::INFINITY, f64::min);
        // A model under which the rover could not be there has the density of the worst that could.
        for (place, evidence) in self.evidence.iter_mut().enumerate() {
            let own = densities.iter().find(|it| it.0 == place).map_or(least, |it| it.1);
            // Stretches near each other say the same: what they say counts once.
            *evidence += own / settings.noise.together(way);
        }
        let most = self.evidence.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        self.evidence.iter_mut().for_each(|it| *it -= most);
        Ok(taught)
    }

    /// How many unknowns filter number `filter` has; `None` if there is no such filter.
    pub(super) fn unknowns(&self, filter: u64) -> Option<usize> {
        let filter = self.filters.get(usize::try_from(filter).ok()?)?;
        Some(filter.unknowns.count())
    }

    /// What filter number `filter` believes.
    pub(super) fn filter(&self, filter: usize) -> &Filter {
        &self.filters[filter]
    }

    /// Forgets all that was learnt: the soil is another.
    pub(super) fn forget(&mut self) {
        self.filters.iter_mut().for_each(Filter::forget);
        self.evidence.fill(0.0);
    }

    /// Sample number `index` of what is believed, which depends on the seed and that number alone.
    /// Before anything is learnt it is that of [`BandInputs::sample`].
    ///
    /// # Errors
    /// [`NothingAccepted`] if no soil can be drawn.
    pub(super) fn sample(
        &self,
        settings: &LearnSettings,
        seed: u64,
        index: u64,
    ) -> Result<LearntSample, NothingAccepted> {
        self.sample_of(&self.models(settings).model(seed, index), seed, index)
    }

    /// The same under one model.
    ///
    /// # Errors
    /// The same as [`sample`](Self::sample).
    pub(super) fn sample_of(
        &self,
        model: &Model,
        seed: u64,
        index: u64,
    ) -> Result<LearntSample, NothingAccepted> {
        self.of_model(model).sample(seed, index)
    }

    /// What one model believes.
    pub(super) fn of_model(&self, model: &Model) -> &Filter {
        let of_model = self.filters.iter().find(|it| it.unknowns.model() == model);
        of_model.unwrap_or(&self.filters[0])
    }

    /// The keys of the soil that a sample has values of.
    pub(super) fn keys(&self) -> impl Iterator<Item = &str> {
        self.filters[0].unknowns.keys()
    }
}

impl Bank {
    /// Writes or reads what is believed; the rest follows from the soil's document.
    pub(super) fn walk(&mut self, archive: &mut dyn Archive) {
        let Self { filters, shares: _, evidence } = self;
        numbers(archive, "evidence", evidence);
        let count = archive.list("beliefs", filters.len());
        for filter in filters.iter_mut().take(count) {
            archive.group("");
            filter.walk(archive);
            archive.end();
        }
        archive.end();
    }

    /// Whether it is of as many numbers as there are unknowns.
    pub(super) fn is_whole(&self) -> bool {
        self.evidence.len() == self.filters.len() && self.filters.iter().all(Filter::is_whole)
    }
}
