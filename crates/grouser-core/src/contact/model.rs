//! The interface of a wheel–soil model.

use super::forces::WheelForces;
use super::inputs::Contact;
use super::load_sinkage::LoadSinkage;
use crate::soil::{Domain, Span};

/// The sinkage over the shearing radius [-] at which models end that take the pressure under a rim
/// as that under a plate. Source: Bekker (1969), in Wong, Theory of Ground Vehicles: acceptable for
/// sinkages up to a sixth of the diameter.
pub(super) const SHALLOW: Span = Span::at_most(1.0 / 3.0);

/// A wheel–soil model: a contact in, the wheel's forces out.
///
/// A model is stateless and total: for any motion and any sinkage from 0 to the axle's depth
/// it returns finite forces, continuous in the sinkage, and none at sinkage 0.
///
/// A model of your own: how deep does a wheel sink into ground that carries 2 kN for each metre of
/// sinkage, and resists the motion with a tenth of the load?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::contact::{Contact, Slip, WheelForces, WheelSoilModel, settle};
///
/// struct Springs {
///     stiffness: f64,
/// }
/// impl WheelSoilModel for Springs {
///     fn forces(&self, _: &Contact, sinkage: f64) -> WheelForces {
///         let normal_force = self.stiffness * sinkage;
///         WheelForces { normal_force, drawbar_pull: -0.1 * normal_force, ..WheelForces::default() }
///     }
/// }
///
/// let slip = Slip::on_test_stand(0.0, 0.0);
/// let contact = Contact { wheel: paper::hakuto_wheel(), soil: paper::toyoura(), slip, gravity: 9.81 };
/// let settled = settle(&Springs { stiffness: 2e3 }, &contact, 17.0)?;
/// assert_eq!(format!("{:.1} mm", 1e3 * settled.sinkage), "8.5 mm");
/// assert_eq!(format!("{:.1} N", settled.forces.drawbar_pull), "-1.7 N");
/// # Ok::<(), grouser_core::contact::SettleError>(())
/// ```
pub trait WheelSoilModel: Send + Sync {
    /// The reaction of the soil on a wheel sunk by `sinkage` [m].
    fn forces(&self, contact: &Contact, sinkage: f64) -> WheelForces;

    /// The range in which the model was tested, or its simplifications hold; what lies outside is
    /// flagged. What nobody states is not limited.
    fn domain(&self) -> Domain {
        Domain::UNSTATED
    }

    /// More than F_z [N] at this sinkage [m] and at all that are shallower; infinite where the
    /// model does not know. It spares a wheel that the soil cannot carry most of the search.
    ///
    /// A model with a [`load_sinkage`](Self::load_sinkage) relation has it from there.
    fn most_normal_force(&self, contact: &Contact, sinkage: f64) -> f64 {
        let relation = self.load_sinkage(contact);
        relation.map_or(f64::INFINITY, |relation| relation.most_normal_force(sinkage))
    }

    /// The contact made ready for a search over sinkages, if the model knows how.
    ///
    /// Its forces have the bits of [`forces`](Self::forces). A model without it is asked for
    /// all its forces at every sinkage.
    fn load_sinkage(&self, contact: &Contact) -> Option<LoadSinkage> {
        let _ = contact;
        None
    }
}
