//! The interface of a wheel–soil model.

use super::forces::WheelForces;
use super::inputs::Contact;
use super::load_sinkage::LoadSinkage;

/// A wheel–soil model: a contact in, the wheel's forces out.
///
/// A model is stateless and total: for any motion and any sinkage from 0 to the axle's depth
/// it returns finite forces, continuous in the sinkage, and none at sinkage 0.
pub trait WheelSoilModel: Sync {
    /// The reaction of the soil on a wheel sunk by `sinkage` [m].
    fn forces(&self, contact: &Contact, sinkage: f64) -> WheelForces;

    /// The contact made ready for a search over sinkages, if the model knows how.
    ///
    /// Its normal force has the bits of [`forces`](Self::forces). A model without it is asked for
    /// all its forces at every sinkage.
    fn load_sinkage(&self, contact: &Contact) -> Option<LoadSinkage> {
        let _ = contact;
        None
    }

    /// [`forces`](Self::forces) of a contact that was made ready before, with the same bits.
    fn forces_of(&self, contact: &Contact, relation: &LoadSinkage, sinkage: f64) -> WheelForces {
        let _ = relation;
        self.forces(contact, sinkage)
    }
}
