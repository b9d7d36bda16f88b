//! Layer 1, contact: what the soil does to one wheel.
//!
//! The order of reading is the order of computing. [`slip`] turns speeds into slip ratio and slip
//! angle; [`patch`] says which arc of the rim touches the soil; [`stress`] gives the normal and
//! shear stress along it; [`bulldozing`] the soil pushed by the side wall; [`forces`] is what comes
//! out. A wheel–soil model puts these together behind the trait [`WheelSoilModel`]: [`ishigami`] is
//! the source paper's, [`small_wheel`] adds what small wheels need within what the ground resists
//! ([`coulomb_cone`]), [`bekker`] is a closed form to check them against, and [`rft`] shares
//! nothing with any of them. [`equilibrium`] finds the sinkage at which a wheel carries its load,
//! and adds what the soil's [`discrepancy`] says of the model; [`batch`] does this for many wheels
//! at once; [`gradient`] says how a settled wheel changes with any number; [`time_step`] lends the
//! reaction to engines of rigid bodies, whose wheels a [`mechanism`] carries; [`validity`] flags
//! results that are extrapolations.
//!
//! The wheel frame has x forward, y to the left and z up, its origin at the hub. Angles on the rim
//! are measured from straight down, positive towards the side at which the wheel enters the soil.

pub mod batch;
pub mod bekker;
pub mod bulldozing;
pub mod cohesion;
pub mod coulomb;
pub mod coulomb_cone;
pub mod discrepancy;
pub mod equilibrium;
pub mod forces;
mod gauss;
pub mod gradient;
mod inputs;
pub mod ishigami;
mod kernel;
mod lanes;
pub mod load_sinkage;
pub mod mechanism;
mod mirror;
pub mod model;
mod models;
pub mod patch;
pub mod rft;
pub mod slip;
pub mod small_wheel;
pub mod stress;
pub mod time_step;
pub mod validity;

pub use batch::forces_many;
pub use bekker::Bekker;
pub use equilibrium::{
    LoadedWheel, SettleError, Settled, settle, settle_counted, settle_each, settle_from,
    settle_many,
};
pub use forces::WheelForces;
pub use inputs::Contact;
pub use ishigami::Ishigami;
pub use kernel::InstructionSet;
pub use load_sinkage::LoadSinkage;
pub use model::WheelSoilModel;
pub use models::{Model, OwnModel};
pub use patch::ContactPatch;
pub use rft::Rft;
pub use slip::Slip;
pub use small_wheel::SmallWheel;
pub use time_step::{Stepped, SteppedWheel, SteppingWheel, TimeStep};
