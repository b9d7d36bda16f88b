//! What a band is drawn from: soils as their document has them, and wheel–soil models.

use rayon::prelude::*;

use super::model_discrepancy::with_discrepancy;
use super::models::{ModelSpread, Question};
use super::outputs_while;
use crate::contact::Model;
use crate::soil::Soil;
use grouser_io::statistics::NothingAccepted;
use grouser_io::{LoadedScenario, LoadedSoil, UncertainSoil};

/// One sample: a soil, and the wheel–soil model that is taken for right.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// The soil.
    pub soil: Soil,
    /// The wheel–soil model.
    pub model: Model,
}

/// What a band is drawn from.
#[derive(Clone, Debug)]
pub struct BandInputs {
    /// The soil as its document has it.
    soil: Soil,
    /// The soils that it may be, if its document leaves any of that open.
    soils: Option<UncertainSoil>,
    /// The model that its values, and their discrepancy, were found with.
    made_for: Option<Model>,
    /// The model that is asked for by name.
    chosen: Option<Model>,
    models: ModelSpread,
}

impl BandInputs {
    /// The soil of a scenario, with the model that the scenario names, or that is your own, or else
    /// the spread of models that know forces across a wheel ([`asked`](Self::asked)).
    #[must_use]
    pub fn of_scenario(scenario: &LoadedScenario) -> Self {
        let model = &scenario.value.model;
        // No document names a model of your own, so that its scenario is the only one to ask for
        // it.
        let is_asked_for = scenario.document.model().is_some() || matches!(model, Model::Own(_));
        let chosen = is_asked_for.then(|| model.clone());
        let made_for = scenario.document.model_of_soil();
        Self::new(scenario.value.ground.soil, scenario.uncertain.clone(), made_for, chosen)
    }

    /// A soil, with a model or else the spread of models.
    ///
    /// * `chosen`: the model that is asked for by name
    #[must_use]
    pub fn of_soil(soil: &LoadedSoil, chosen: Option<Model>) -> Self {
        Self::new(soil.value, soil.uncertain.clone(), soil.document.model(), chosen)
    }

    fn new(
        soil: Soil,
        soils: Option<UncertainSoil>,
        made_for: Option<Model>,
        chosen: Option<Model>,
    ) -> Self {
        let models = ModelSpread::one(Model::default());
        Self { soil, soils, made_for, chosen, models }.asked(Question::Across)
    }

    /// The same for a question, whose forces not every model has.
    #[must_use]
    pub fn asked(self, question: Question) -> Self {
        let believed = self.soils.iter().flat_map(UncertainSoil::models);
        let believed = believed.map(|(model, share)| (model.clone(), share)).collect();
        let models = match &self.chosen {
            Some(model) => ModelSpread::one(model.clone()),
            None => ModelSpread::believed(believed, question)
                .unwrap_or_else(|| ModelSpread::all(self.made_for.as_ref(), question)),
        };
        Self { models, ..self }
    }

    /// The models with their shares.
    #[must_use]
    pub fn models(&self) -> &ModelSpread {
        &self.models
    }

    /// Whether one soil and one model are all there is: then there is nothing to draw.
    #[must_use]
    pub fn is_certain(&self) -> bool {
        self.soils.is_none() && self.models.shares().len() == 1
    }

    /// Sample number `index`, which depends on the seed and that number alone: a soil with what its
    /// document leaves open and with what a model may get wrong in it, and a model. A soil whose
    /// numbers are all taken as exact is the same in every sample.
    ///
    /// # Errors
    /// [`NothingAccepted`] if no soil can be drawn.
    pub fn sample(&self, seed: u64, index: u64) -> Result<Sample, NothingAccepted> {
        self.crossed(self.models.model(seed, index), seed, [index, index])
    }

    /// A model with the soil of one sample and what a model may get wrong in another, so that the
    /// two can be told apart. It depends on its arguments alone.
    ///
    /// * `numbers`: of the soil, and of the discrepancy
    ///
    /// # Errors
    /// The same as [`sample`](Self::sample).
    pub fn crossed(
        &self,
        model: Model,
        seed: u64,
        numbers: [u64; 2],
    ) -> Result<Sample, NothingAccepted> {
        let [number, discrepancy] = numbers;
        let soil = match &self.soils {
            Some(soils) => {
                let drawn = self.as_known_to(&model, soils.draw_under(&model, seed, number)?);
                with_discrepancy(drawn, seed, discrepancy)
            }
            None => self.soil,
        };
        Ok(Sample { soil, model })
    }

    /// The soil as its document has it, without what a calibration found wrong with another model
    /// than this.
    pub(in crate::studies) fn nominal(&self, model: &Model) -> Soil {
        self.as_known_to(model, self.soil)
    }

    /// Whether soils differ from sample to sample; if not, no model gets anything wrong in them
    /// either.
    #[must_use]
    pub fn has_soils(&self) -> bool {
        self.soils.is_some()
    }

    /// The soils that it may be under a model, if its document leaves any of that open.
    pub(in crate::studies) fn soils_under(&self, model: &Model) -> Option<&UncertainSoil> {
        self.soils.as_ref().map(|soils| soils.under(model))
    }

    /// A soil without what a calibration found wrong with another model than this.
    pub(in crate::studies) fn as_known_to(&self, model: &Model, soil: Soil) -> Soil {
        let has_own = || self.soils.iter().flat_map(UncertainSoil::models).any(|it| it.0 == model);
        match &self.made_for {
            Some(own) if own != model && !has_own() => Soil { discrepancy: None, ..soil },
            _ => soil,
        }
    }

    /// The first samples.
    ///
    /// # Errors
    /// The same as [`sample`](Self::sample), for the first that cannot be drawn.
    pub fn samples(&self, seed: u64, count: u32) -> Result<Vec<Sample>, NothingAccepted> {
        let all: Vec<_> =
            (0..count).into_par_iter().map(|it| self.sample(seed, it.into())).collect();
        all.into_iter().collect()
    }
}

/// Computes samples in their order, those that are alike once; nothing if `go_on` was false before
/// the end.
///
/// * `go_on`: asked before each that is computed, from any thread
/// * `one`: computes a sample
pub fn outputs_of_samples<T: Clone + Send>(
    samples: &[Sample],
    go_on: &(dyn Fn() -> bool + Sync),
    one: impl Fn(&Sample) -> T + Sync + Send,
) -> Option<Vec<T>> {
    outputs_of_places(samples, go_on, |place| one(&samples[place]))
}

/// The same for what is computed from a sample's place among the others.
///
/// * `one`: computes the sample at a place; the same for samples that are alike
pub(in crate::studies) fn outputs_of_places<T: Clone + Send>(
    samples: &[Sample],
    go_on: &(dyn Fn() -> bool + Sync),
    one: impl Fn(usize) -> T + Sync + Send,
) -> Option<Vec<T>> {
    // Where the soil is the same in all samples there is one result for each model: looking at the
    // first sample of a model is enough to find it.
    let source = |(place, sample): (usize, &Sample)| {
        let first = samples.iter().position(|it| it.model == sample.model);
        first.filter(|first| samples[*first] == *sample).unwrap_or(place)
    };
    let sources: Vec<usize> = samples.iter().enumerate().map(source).collect();
    let computed: Vec<usize> =
        (0..samples.len()).filter(|place| sources[*place] == *place).collect();
    let found = outputs_while(&computed, go_on, |place| one(*place))?;
    let result = |source: &usize| computed.binary_search(source).ok().map(|at| found[at].clone());
    sources.iter().map(result).collect()
}
