//! One wheel by itself.

use super::search::{Search, Start};
use super::settled::{LoadedWheel, SettleError, Settled};
use crate::contact::load_sinkage::LoadSinkage;

pub(super) fn settle_wheel(wheel: &LoadedWheel<'_>) -> Result<Settled, SettleError> {
    settle_wheel_counted(wheel).0
}

/// The result, and how often the model was evaluated.
pub(super) fn settle_wheel_counted(wheel: &LoadedWheel<'_>) -> (Result<Settled, SettleError>, u32) {
    let &LoadedWheel { model, contact, load, .. } = wheel;
    if !(load.is_finite() && load >= 0.0) {
        return (Err(SettleError::BadLoad { load }), 0);
    }
    if load == 0.0 {
        let forces = model.forces(contact, 0.0);
        return (Ok(Settled { sinkage: 0.0, forces, evaluations: 1 }), 1);
    }
    settle_ready(wheel, model.load_sinkage(contact).as_ref())
}

/// The same under a load that a wheel can carry, and that is not 0.
///
/// * `relation`: of the wheel, if its model has one
pub(super) fn settle_ready(
    wheel: &LoadedWheel<'_>,
    relation: Option<&LoadSinkage>,
) -> (Result<Settled, SettleError>, u32) {
    let mut search = Search::new(wheel, relation, Start::of(wheel, relation));
    let settled = search.root().map(|log_sinkage| {
        let (sinkage, forces) = search.reaction(log_sinkage);
        Settled::of(wheel.contact, sinkage, forces, search.evaluations())
    });
    (settled, search.evaluations())
}
