//! The sinkage at which a wheel carries its load.

mod interpolation;
mod many;
mod one;
mod search;
mod settled;

pub(crate) use interpolation::{grows_as_usual, is_usual_step};
pub use many::{settle_each, settle_many};
pub use settled::{LoadedWheel, SettleError, Settled};

use self::one::{settle_wheel, settle_wheel_counted};
use super::inputs::Contact;
use super::model::WheelSoilModel;

/// The smallest sinkage at which the soil carries `load` [N] (F_z = W), and the forces there.
///
/// F_z starts at 0 and grows like a power of the sinkage, so the search goes by the logarithms of
/// both, where it is nearly a straight line. It starts where a shallow wheel without shear would
/// settle, and interpolates through all that it has seen: three or four evaluations of F_z, and one
/// of all forces. Where they do not close in as they should, the root is bracketed before it is
/// closed in on, and where the growth ends before the load is reached (deep, skidding wheels on
/// strong soil) the highest F_z is sought before the wheel is given up. (In cohesive soil without
/// [`ShearBound::Coulomb`](crate::soil::ShearBound::Coulomb) F_z may also rise and fall while the
/// wheel has hardly sunk and shear outweighs pressure; there the answer is one of the sinkages with
/// F_z = W, not always the smallest.)
///
/// Where the soil has a [`Discrepancy`](crate::soil::Discrepancy), it is added to what the model
/// finds.
///
/// How deep does a wheel of HAKUTO sink under 17 N, and how hard does it pull at a slip ratio of
/// 0.2?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::contact::{Contact, Ishigami, Slip, settle};
/// use grouser_core::units::EARTH_GRAVITY;
///
/// let slip = Slip::on_test_stand(0.2, 0.0);
/// let (wheel, soil) = (paper::hakuto_wheel(), paper::toyoura());
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

/// Does what [`settle`] does, from a sinkage [m] near which the answer is expected: the sinkage of
/// the same wheel a moment ago.
///
/// The answer is the same whatever the guess, but for its last digits: F_z and load agree to 1e-12.
/// A guess is therefore an input like any other where results have to repeat bit for bit. Where
/// several sinkages carry the load, the guess may decide which is found.
///
/// # Errors
/// The same as [`settle`].
pub fn settle_from(
    model: &dyn WheelSoilModel,
    contact: &Contact,
    load: f64,
    guess: f64,
) -> Result<Settled, SettleError> {
    settle_wheel(&LoadedWheel { model, contact, load, guess: Some(guess) })
}

/// Does what [`settle`] does; returns also how often the model was evaluated, for F_z alone or for
/// all forces, whatever came of it: what the answer cost.
///
/// # Errors
/// The same as [`settle`].
pub fn settle_counted(
    model: &dyn WheelSoilModel,
    contact: &Contact,
    load: f64,
) -> (Result<Settled, SettleError>, u32) {
    settle_wheel_counted(&LoadedWheel { model, contact, load, guess: None })
}
