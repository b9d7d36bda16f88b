//! A wheel on several soils at once, as at the border between two.

use super::settling::add_weighted;
use crate::contact::{Contact, WheelForces, WheelSoilModel};
use crate::soil::{Discrepancy, Soil};

/// What a wheel meets.
pub(super) struct Met {
    /// The contact; on several soils, with that of the largest share.
    contact: Contact,
    /// All soils with their shares [-], where there are several.
    shares: Vec<(Soil, f64)>,
}

impl Met {
    /// One soil.
    pub(super) fn one(contact: Contact) -> Self {
        Self { contact, shares: Vec::new() }
    }

    /// The same wheel in the same motion on other soils.
    ///
    /// * `shares`: of each [-], 1 together
    pub(super) fn on(self, mut shares: Vec<(Soil, f64)>) -> Self {
        let largest = shares.iter().max_by(|one, other| one.1.total_cmp(&other.1));
        let Some((soil, _)) = largest else { return self };
        let mut contact = Contact { soil: *soil, ..self.contact };
        if shares.len() > 1 {
            contact.soil.discrepancy = mean_discrepancy(&shares);
        } else {
            shares.clear();
        }
        Self { contact, shares }
    }

    pub(super) fn contact(&self) -> &Contact {
        &self.contact
    }

    /// The model of all its soils, where there are several.
    pub(super) fn mixture<'a>(&'a self, model: &'a dyn WheelSoilModel) -> Option<Mixture<'a>> {
        (!self.shares.is_empty()).then_some(Mixture { model, shares: &self.shares })
    }
}

/// A wheel–soil model on several soils at once: the mean of its forces at one sinkage, by their
/// shares.
///
/// A rigid wheel sinks into all of them by the same depth, and each pushes on its part of the rim.
/// The soils' constants are not averaged: they belong to laws of different forms, and forces are no
/// linear functions of them.
pub(super) struct Mixture<'a> {
    model: &'a dyn WheelSoilModel,
    shares: &'a [(Soil, f64)],
}

impl WheelSoilModel for Mixture<'_> {
    fn forces(&self, contact: &Contact, sinkage: f64) -> WheelForces {
        let mut sum = WheelForces::default();
        for &(soil, share) in self.shares {
            let alone = self.model.forces(&Contact { soil, ..*contact }, sinkage);
            add_weighted(&mut sum, &alone, share);
        }
        sum
    }

    fn most_normal_force(&self, contact: &Contact, sinkage: f64) -> f64 {
        let each = self.shares.iter().map(|&(soil, share)| {
            share * self.model.most_normal_force(&Contact { soil, ..*contact }, sinkage)
        });
        each.sum()
    }
}

/// The mean of what the model gets wrong, which is added to shares of the load: nothing where it is
/// right in all soils.
fn mean_discrepancy(shares: &[(Soil, f64)]) -> Option<Discrepancy> {
    shares.iter().any(|(soil, _)| soil.discrepancy.is_some()).then(|| {
        let mut mean = Discrepancy::NONE;
        for (soil, share) in shares {
            let Some(one) = soil.discrepancy else { continue };
            let lists: [(&mut [f64], &[f64]); 4] = [
                (&mut mean.drawbar_pull, &one.drawbar_pull),
                (&mut mean.side_force, &one.side_force),
                (&mut mean.sinkage, &one.sinkage),
                (&mut mean.torque, &one.torque),
            ];
            for (to, from) in lists.into_iter().flat_map(|(to, from)| to.iter_mut().zip(from)) {
                *to += share * from;
            }
        }
        mean
    })
}
