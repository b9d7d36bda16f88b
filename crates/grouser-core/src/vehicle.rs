//! Layer 2, vehicle: the rover as a rigid body on wheels.
//!
//! [`rover`] is what it is, [`state`] where it is and how it moves. From the state,
//! [`kinematics`] gives the motion of each hub (Eqs 2-3), [`load`] the share of the weight on each
//! wheel (Eqs 12-14) and, with the soil's reaction on the wheels, [`dynamics`] the acceleration
//! (Eqs 5-11). [`drive`] says how fast the wheels turn (Eq. 18). Equations are those of
//! [FourWheel], in the corrected form that `docs/equations.md` lists.
//!
//! Frames: `slope` has x along the contour, y uphill and z out of the ground; `body` has x
//! forward, y left and z up, its origin at the centre of mass of the body without its wheels; a
//! `wheel` frame is the body's, turned to the left by the wheel's steering angle, at its hub.

pub mod battery;
pub mod belly;
pub mod by_wheel;
pub mod drive;
pub mod drive_unit;
pub mod dynamics;
pub mod estimate;
pub mod kinematics;
mod links;
pub mod load;
pub mod motor;
pub mod on_ground;
pub mod parts;
pub mod posture;
pub mod reaction;
pub mod rover;
pub mod ruts;
pub(crate) mod settling;
mod several_soils;
pub mod speed_control;
pub mod stability;
pub mod standing;
pub mod state;
pub mod statics;
pub mod support_polygon;
pub mod suspension;
pub mod winding;

pub use battery::{Battery, Terminals};
pub use belly::{BellyPoint, Underside};
pub use by_wheel::{ByWheel, Differences, PerWheel};
pub use drive::DriveLaw;
pub use drive_unit::{Drive, Driven};
pub use load::{LoadSharing, OwnMoments, Weight};
pub use motor::{Electrical, Motor};
pub use on_ground::{OnGround, ReactionError, Stance, WheelReaction};
pub use parts::{
    Body, Inertia, Mount, MountParts, RoverParts, SteeringAxis, SteeringParts, WheelUnit,
};
pub use posture::{Attitude, NoPosture, Posture};
pub use rover::Rover;
pub use ruts::Ruts;
pub use settling::KnownWheels;
pub use speed_control::{MotorLimits, SpeedControl};
pub use standing::Standing;
pub use state::{Acceleration, RoverState, roll_and_pitch, slope_and_yaw};
pub use statics::{Balance, Resultant};
pub use suspension::{Bogie, End, Joints, Suspension};
pub use winding::Winding;
