//! What driving may tell of a soil under one wheel–soil model, in coordinates that are standard
//! normal beforehand.

use crate::contact::Model;
use crate::soil::{Discrepancy, Soil};
use crate::studies::ensemble::model_discrepancy::{DiscrepancyCoordinates, drawn};
use crate::studies::ensemble::samples::{BandInputs, Sample};
use grouser_io::soil_coordinates::{SoilCoordinates, SoilDraw};
use grouser_io::statistics::NothingAccepted;

/// The coordinates: of the soil's numbers, and of what the model gets wrong in it.
#[derive(Clone, Debug)]
pub(super) struct Unknowns {
    model: Model,
    inputs: BandInputs,
    soil: SoilCoordinates,
    /// Coordinates of what the model gets wrong, where the soil's samples do not bring it.
    discrepancy: Option<DiscrepancyCoordinates>,
}

/// A sample of what is believed beforehand, and its coordinates.
#[derive(Clone, Debug)]
pub(super) struct Draw {
    soil: SoilDraw,
    /// With what the model gets wrong.
    sample: Sample,
    pub(super) coordinates: Vec<f64>,
}

/// A sample of what is believed, with the values of the soil's keys in their own units.
#[derive(Clone, Debug, PartialEq)]
pub struct LearntSample {
    /// Soil and model.
    pub sample: Sample,
    /// The values of the soil's uncertain keys.
    pub values: Vec<f64>,
}

impl Unknowns {
    /// `None` of a soil that is known exactly.
    pub(super) fn of(model: Model, inputs: &BandInputs) -> Option<Self> {
        let soil = SoilCoordinates::of(inputs.soils_under(&model)?);
        let brings_own = inputs.nominal(&model).discrepancy.is_some();
        let discrepancy = (!brings_own).then(DiscrepancyCoordinates::new);
        Some(Self { model, inputs: inputs.clone(), soil, discrepancy })
    }

    /// The model.
    pub(super) fn model(&self) -> &Model {
        &self.model
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.soil.count() + self.discrepancy.as_ref().map_or(0, DiscrepancyCoordinates::count)
    }

    /// How many of them, the first, are of the soil.
    pub(super) fn of_soil(&self) -> usize {
        self.soil.count()
    }

    /// The keys of the soil that differ.
    pub(super) fn keys(&self) -> impl Iterator<Item = &str> {
        self.soil.keys()
    }

    /// The values of the soil's uncertain keys at a place, in their own units.
    pub(super) fn values(&self, coordinates: &[f64]) -> Option<Vec<f64>> {
        self.soil.values(&coordinates[..self.soil.count()])
    }

    /// The sample at a place; `None` where there is no such soil.
    pub(super) fn sample(&self, coordinates: &[f64]) -> Option<Sample> {
        let (of_soil, of_model) = coordinates.split_at(self.soil.count());
        let soil = self.inputs.as_known_to(&self.model, self.soil.soil(of_soil)?);
        let discrepancy = self.discrepancy.as_ref();
        let moved = discrepancy.map(|it| it.moved(&Discrepancy::NONE, of_model));
        let soil = Soil { discrepancy: moved.or(soil.discrepancy), ..soil };
        Some(Sample { soil, model: self.model.clone() })
    }

    /// Sample number `index` of what is believed beforehand: that of [`BandInputs::sample`], for
    /// this model.
    pub(super) fn draw(&self, seed: u64, index: u64) -> Result<Draw, NothingAccepted> {
        let soil = self.soil.draw(seed, index)?;
        let mut coordinates = soil.coordinates.clone();
        let mut drawn_soil = self.inputs.as_known_to(&self.model, soil.soil);
        if let Some(axes) = &self.discrepancy {
            let discrepancy = drawn(seed, index);
            coordinates.extend(axes.of(&discrepancy));
            drawn_soil.discrepancy = Some(discrepancy);
        }
        let sample = Sample { soil: drawn_soil, model: self.model.clone() };
        Ok(Draw { soil, sample, coordinates })
    }

    /// A sample moved to another place, with the values of its soil's keys in their own units;
    /// `None` where there is no such soil. What no coordinate has, it keeps.
    pub(super) fn moved(&self, draw: &Draw, coordinates: &[f64]) -> Option<(Vec<f64>, Sample)> {
        let (of_soil, of_model) = coordinates.split_at(self.soil.count());
        let (values, moved) = self.soil.moved(&draw.soil, of_soil)?;
        let mut soil = self.inputs.as_known_to(&self.model, moved);
        if let (Some(axes), Some(own)) = (&self.discrepancy, draw.sample.soil.discrepancy) {
            let before = &draw.coordinates[self.soil.count()..];
            let step: Vec<f64> = of_model.iter().zip(before).map(|(to, from)| to - from).collect();
            soil.discrepancy = Some(axes.moved(&own, &step));
        }
        Some((values, Sample { soil, model: self.model.clone() }))
    }
}
