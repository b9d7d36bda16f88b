//! A wheel under its load, and what becomes of it.

use crate::contact::discrepancy::{self, Correction};
use crate::contact::forces::WheelForces;
use crate::contact::inputs::Contact;
use crate::contact::model::WheelSoilModel;
use crate::stored::stored;

/// A wheel under its load: what settles.
#[derive(Clone, Copy)]
pub struct LoadedWheel<'a> {
    /// The wheel–soil model.
    pub model: &'a dyn WheelSoilModel,
    /// The wheel on its soil, in its motion.
    pub contact: &'a Contact,
    /// Its load [N].
    pub load: f64,
    /// A sinkage [m] near which the answer is expected, if one is known ([`settle_from`]).
    ///
    /// [`settle_from`]: super::settle_from
    pub guess: Option<f64>,
}

/// A wheel that has sunk until the soil carries it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settled {
    /// Sinkage of the grouser tips, *h* [m].
    pub sinkage: f64,
    /// The soil's reaction there.
    pub forces: WheelForces,
    /// How often the model was evaluated, for F_z alone or for all forces.
    pub evaluations: u32,
}

stored!(struct Settled { sinkage, forces, evaluations });

/// Why no sinkage carries the load.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SettleError {
    /// Even sunk to the axle, the soil carries less than the wheel's load.
    #[error("the soil carries at most {capacity:.4} N down to axle depth, the load is {load:.4} N")]
    SunkToAxle {
        /// The wheel's load [N].
        load: f64,
        /// The most that the soil carries at any sinkage down to the axle [N].
        capacity: f64,
    },
    /// The load is not a number that a wheel can carry.
    #[error("a wheel load must be finite and not negative, it is {load} N")]
    BadLoad {
        /// The load [N].
        load: f64,
    },
}

impl LoadedWheel<'_> {
    /// The model's own sinkage at the guess [m]; NaN if there is none.
    pub(super) fn usable_guess(&self) -> f64 {
        let usable = self.guess.filter(|guess| guess.is_finite() && *guess > 0.0);
        usable.map_or(f64::NAN, |guess| discrepancy::own_sinkage(self.contact, guess))
    }
}

impl Settled {
    /// What a model finds, with what the soil's discrepancy adds.
    pub(in crate::contact) fn of(
        contact: &Contact,
        sinkage: f64,
        forces: WheelForces,
        evaluations: u32,
    ) -> Self {
        match Correction::of(contact) {
            Some(it) => {
                Self { sinkage: it.sinkage(sinkage), forces: it.forces(forces), evaluations }
            }
            None => Self { sinkage, forces, evaluations },
        }
    }
}
