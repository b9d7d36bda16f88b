//! The sinkage at which a wheel carries its load.

mod interpolation;
mod many;
mod search;

pub(crate) use interpolation::{grows_as_usual, is_usual_step};
pub use many::{LoadedWheel, settle_each, settle_many};

use self::search::{Search, Start};
use super::discrepancy;
use super::forces::WheelForces;
use super::inputs::Contact;
use super::load_sinkage::LoadSinkage;
use super::model::WheelSoilModel;

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

/// The smallest sinkage at which the soil carries `load` [N] (F_z = W), and the forces there.
///
/// F_z starts at 0 and grows like a power of the sinkage, so the search goes by the logarithms of
/// both, where it is nearly a straight line. It starts where a shallow wheel without shear would
/// settle, and interpolates through all that it has seen: three or four evaluations of F_z, and one
/// of all forces. Where they do not close in as they should, the root is bracketed before it is
/// closed in on, and where the growth ends before the load is reached (deep, skidding
/// wheels on strong soil) the highest F_z is sought before the wheel is given up. (In cohesive soil
/// F_z may also rise and fall while the wheel has hardly sunk and shear outweighs pressure; there
/// the answer is one of the sinkages with F_z = W, not always the smallest.)
///
/// Where the soil has a [`Discrepancy`](crate::soil::Discrepancy), it is added to what the model
/// finds.
///
/// How deep does a wheel of HAKUTO sink under 17 N, and how hard does it pull at a slip ratio of 0.2?
///
/// ```
/// # mod hakuto { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/by_hand/hakuto.rs")); }
/// use grouser_core::contact::{Contact, Ishigami, Slip, settle};
/// use grouser_core::units::EARTH_GRAVITY;
///
/// let slip = Slip::on_test_stand(0.2, 0.0);
/// let (wheel, soil) = (hakuto::wheel(), hakuto::sand());
/// let contact = Contact { wheel, soil, slip, gravity: EARTH_GRAVITY };
/// let settled = settle(&Ishigami::DEFAULT, &contact, 17.0)?;
///
/// assert_eq!(format!("{:.1} mm", 1e3 * settled.sinkage), "13.0 mm");
/// assert_eq!(format!("{:.2} N", settled.forces.drawbar_pull), "1.82 N");
/// # Ok::<(), grouser_core::contact::SettleError>(())
/// ```
///
/// # Errors
/// [`SettleError::SunkToAxle`] if the soil carries less at every sinkage down to the axle;
/// [`SettleError::BadLoad`] if the load is negative or not finite.
pub fn settle(
    model: &dyn WheelSoilModel,
    contact: &Contact,
    load: f64,
) -> Result<Settled, SettleError> {
    settle_wheel(&LoadedWheel { model, contact, load, guess: None })
}

/// As [`settle`], from a sinkage [m] near which the answer is expected: that of the same wheel a
/// moment ago.
///
/// The answer is the same whatever the guess, but for its last digits: F_z and load agree to 1e-12.
/// A guess is therefore an input like any other where results have to repeat bit for bit. Where
/// several sinkages carry the load, the guess may decide which is found.
///
/// # Errors
/// As [`settle`].
pub fn settle_from(
    model: &dyn WheelSoilModel,
    contact: &Contact,
    load: f64,
    guess: f64,
) -> Result<Settled, SettleError> {
    settle_wheel(&LoadedWheel { model, contact, load, guess: Some(guess) })
}

fn settle_wheel(wheel: &LoadedWheel<'_>) -> Result<Settled, SettleError> {
    settle_wheel_counted(wheel).0
}

/// As [`settle`], with how often the model was evaluated, for F_z alone or for all forces, whatever came
/// of it: what the answer cost.
///
/// # Errors
/// As [`settle`].
pub fn settle_counted(
    model: &dyn WheelSoilModel,
    contact: &Contact,
    load: f64,
) -> (Result<Settled, SettleError>, u32) {
    settle_wheel_counted(&LoadedWheel { model, contact, load, guess: None })
}

/// The result, and how often the model was evaluated.
fn settle_wheel_counted(wheel: &LoadedWheel<'_>) -> (Result<Settled, SettleError>, u32) {
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
fn settle_ready(
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

impl Settled {
    /// What a model finds, with what the soil's discrepancy adds.
    fn of(contact: &Contact, sinkage: f64, forces: WheelForces, evaluations: u32) -> Self {
        Self {
            sinkage: discrepancy::corrected_sinkage(contact, sinkage),
            forces: discrepancy::corrected(contact, forces),
            evaluations,
        }
    }
}
