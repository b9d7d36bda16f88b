//! What C reads of wheels and rovers: numbers in SI, each with its unit in its name.

use grouser_core::contact::{SettleError, Settled as CoreSettled, SteppedWheel};
use grouser_core::simulation::{OutcomeKind, Record, State, WheelRecord};

/// Makes the way from the kinds of outcomes to C's enum of them.
macro_rules! outcomes {
    ($($kind:ident)+) => {
        impl From<OutcomeKind> for Outcome {
            fn from(kind: OutcomeKind) -> Self {
                match kind {
                    $(OutcomeKind::$kind => Self::$kind,)+
                }
            }
        }
    };
}

/// What became of a rover.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It is under way.
    UnderWay = 0,
    /// It did what was asked for.
    Completed = 1,
    /// A limit stopped it, or would have on the way ahead; legs of missions only.
    Stopped = 2,
    /// A turn or an arc did not reach its yaw; legs of missions only.
    FellShort = 3,
    /// It is stuck.
    Immobilised = 4,
    /// It slides downhill faster than its wheels turn.
    Sliding = 5,
    /// Its weight fell outside its wheels.
    TippedOver = 6,
    /// Its battery gave out.
    BrownOut = 7,
    /// A wheel came to where the map has no heights.
    OffTheMap = 8,
    /// Its underside came to the ground.
    HighCentred = 9,
}

outcomes! {
    Completed Stopped FellShort Immobilised Sliding TippedOver BrownOut OffTheMap HighCentred
}

/// The soil's reaction on a wheel about its hub, in the wheel frame: x forward, y to the left, z
/// out of the ground. Angles on the rim are from straight down, positive where the wheel enters the
/// soil.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reaction {
    /// Sinkage of the grouser tips.
    pub sinkage_m: f64,
    /// Force along the wheel: thrust less motion resistance.
    pub drawbar_pull_n: f64,
    /// Force across the wheel, positive to the left.
    pub side_force_n: f64,
    /// Force out of the ground.
    pub normal_force_n: f64,
    /// Torque of the drive, positive while it drives the wheel forward.
    pub torque_nm: f64,
    /// Moment about the wheel's long axis.
    pub overturning_moment_nm: f64,
    /// Moment about the wheel's upright axis.
    pub aligning_moment_nm: f64,
    /// Part of the drawbar pull from shear.
    pub thrust_n: f64,
    /// Part of the drawbar pull from normal stress and bulldozing; it counts negative.
    pub motion_resistance_n: f64,
    /// Part of the side force from shear.
    pub side_force_from_shear_n: f64,
    /// Full load of the soil that the side wall pushes aside, before the slip angle's share.
    pub bulldozing_load_n: f64,
    /// Largest normal stress on the rim.
    pub max_normal_stress_pa: f64,
    /// Entry angle.
    pub entry_angle_rad: f64,
    /// Exit angle, not positive.
    pub exit_angle_rad: f64,
    /// Angle of the largest normal stress.
    pub max_stress_angle_rad: f64,
}

/// Whether the soil carries a wheel.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carried {
    /// It does.
    Yes = 0,
    /// Even sunk to the axle the soil carries less than the wheel's load.
    SunkToAxle = 1,
}

/// A wheel that was asked for the sinkage at which the soil carries its load.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settled {
    /// Whether it does.
    pub carried: Carried,
    /// The most that the soil carries; NaN of a wheel that it carries.
    pub capacity_n: f64,
    /// The reaction; all NaN of a wheel that the soil does not carry.
    pub reaction: Reaction,
}

/// A wheel at the end of a time step of another engine.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stepped {
    /// Slip ratio at the end of the step.
    pub slip_ratio: f64,
    /// Slip angle there, positive where the hub moves to the left.
    pub slip_angle_rad: f64,
    /// The reaction that acts over the step.
    pub reaction: Reaction,
}

/// A force and a moment in the axes of the world.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench {
    /// Force along x, y and z.
    pub force_n: [f64; 3],
    /// Moment about them.
    pub moment_nm: [f64; 3],
}

/// A wheel that another engine moves, at the end of a preliminary step, in the axes of the world.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MountedWheel {
    /// Unit vector along the axle, to the left of a wheel that rolls forward.
    pub axle: [f64; 3],
    /// From the centre of mass of the wheel's body to its hub.
    pub arm_m: [f64; 3],
    /// Unit normal of the ground under the wheel.
    pub normal: [f64; 3],
    /// Distance of the hub from the ground.
    pub hub_height_m: f64,
    /// What acted on its body about the centre of mass in the preliminary step.
    pub held: Wrench,
}

/// Where a rover is and how it moves. Position and yaw are in the slope frame (x along the contour,
/// y uphill), velocities in the body frame (x forward, y to the left).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Time since the start.
    pub time_s: f64,
    /// Position of the body's centre of mass along the contour, from its start.
    pub x_m: f64,
    /// The same uphill.
    pub y_m: f64,
    /// Yaw; positive turns the nose uphill.
    pub yaw_rad: f64,
    /// Velocity of the body's centre of mass forward.
    pub velocity_x_m_s: f64,
    /// The same to the left.
    pub velocity_y_m_s: f64,
    /// Yaw rate.
    pub yaw_rate_rad_s: f64,
    /// Work of the motors since the start.
    pub motor_energy_j: f64,
    /// Electrical energy since the start; 0 where no motor is known.
    pub electrical_energy_j: f64,
}

/// How a rover stands on ground with heights, or on a suspension; all NaN on a plane without one.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attitude {
    /// Height of the body's centre of mass.
    pub height_m: f64,
    /// Roll, positive with the right side down.
    pub roll_rad: f64,
    /// Pitch, positive with the nose up.
    pub pitch_rad: f64,
}

/// A wheel of a rover.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheel {
    /// Angular speed.
    pub wheel_speed_rad_s: f64,
    /// Steering angle, positive to the left.
    pub steering_angle_rad: f64,
    /// Slip ratio, positive while the rim outruns the hub.
    pub slip_ratio: f64,
    /// Slip angle, positive where the hub moves to the left.
    pub slip_angle_rad: f64,
    /// Load.
    pub load_n: f64,
    /// Mechanical power of its motor.
    pub power_w: f64,
    /// Current of its motor; NaN where no motor is known.
    pub current_a: f64,
    /// Sinkage and the soil's reaction.
    pub reaction: Reaction,
}

/// A leg of a mission that was driven.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// What became of it.
    pub outcome: Outcome,
    /// Way over the ground in its manoeuvre.
    pub distance_m: f64,
    /// How long it took, with a turn before it.
    pub duration_s: f64,
    /// Work of the motors in that time.
    pub motor_energy_j: f64,
    /// Slip ratio over the manoeuvre; NaN of turns and waits.
    pub slip_ratio: f64,
    /// Yaw by which it turned, positive to the left; NaN where no arc or turn was driven.
    pub turned_rad: f64,
}

impl Reaction {
    /// No reaction: that of a wheel that the soil does not carry.
    const NONE: Self = Self {
        sinkage_m: f64::NAN,
        drawbar_pull_n: f64::NAN,
        side_force_n: f64::NAN,
        normal_force_n: f64::NAN,
        torque_nm: f64::NAN,
        overturning_moment_nm: f64::NAN,
        aligning_moment_nm: f64::NAN,
        thrust_n: f64::NAN,
        motion_resistance_n: f64::NAN,
        side_force_from_shear_n: f64::NAN,
        bulldozing_load_n: f64::NAN,
        max_normal_stress_pa: f64::NAN,
        entry_angle_rad: f64::NAN,
        exit_angle_rad: f64::NAN,
        max_stress_angle_rad: f64::NAN,
    };

    /// The reaction at a sinkage [m].
    pub(crate) fn new(sinkage: f64, forces: &grouser_core::contact::WheelForces) -> Self {
        Self {
            sinkage_m: sinkage,
            drawbar_pull_n: forces.drawbar_pull,
            side_force_n: forces.side_force,
            normal_force_n: forces.normal_force,
            torque_nm: forces.torque,
            overturning_moment_nm: forces.overturning_moment,
            aligning_moment_nm: forces.aligning_moment,
            thrust_n: forces.thrust,
            motion_resistance_n: forces.motion_resistance,
            side_force_from_shear_n: forces.side_force_from_shear,
            bulldozing_load_n: forces.bulldozing_load,
            max_normal_stress_pa: forces.max_normal_stress,
            entry_angle_rad: forces.patch.entry,
            exit_angle_rad: forces.patch.exit,
            max_stress_angle_rad: forces.patch.max_stress,
        }
    }
}

impl From<Result<CoreSettled, SettleError>> for Settled {
    fn from(settled: Result<CoreSettled, SettleError>) -> Self {
        match settled {
            Ok(CoreSettled { sinkage, forces, .. }) => Self {
                carried: Carried::Yes,
                capacity_n: f64::NAN,
                reaction: Reaction::new(sinkage, &forces),
            },
            Err(error) => Self {
                carried: Carried::SunkToAxle,
                capacity_n: match error {
                    SettleError::SunkToAxle { capacity, .. } => capacity,
                    // Loads were checked.
                    SettleError::BadLoad { .. } => f64::NAN,
                },
                reaction: Reaction::NONE,
            },
        }
    }
}

impl From<&SteppedWheel> for Stepped {
    fn from(wheel: &SteppedWheel) -> Self {
        Self {
            slip_ratio: wheel.slip.ratio,
            slip_angle_rad: wheel.slip.angle,
            reaction: Reaction::new(wheel.sinkage, &wheel.forces),
        }
    }
}

impl From<&State> for Pose {
    fn from(state: &State) -> Self {
        let rover = state.rover();
        Self {
            time_s: state.time(),
            x_m: rover.position.x,
            y_m: rover.position.y,
            yaw_rad: rover.yaw,
            velocity_x_m_s: rover.velocity.x,
            velocity_y_m_s: rover.velocity.y,
            yaw_rate_rad_s: rover.yaw_rate,
            motor_energy_j: state.motor_work(),
            electrical_energy_j: state.electrical_work(),
        }
    }
}

impl From<&Record> for Attitude {
    fn from(record: &Record) -> Self {
        let attitude = record.attitude.as_ref();
        let [height_m, roll_rad, pitch_rad] =
            attitude.map_or([f64::NAN; 3], |it| [it.height, it.roll, it.pitch]);
        Self { height_m, roll_rad, pitch_rad }
    }
}

impl Wheel {
    /// No wheel: that of a rover that has just tipped over or sunk.
    pub(crate) const NONE: Self = Self {
        wheel_speed_rad_s: f64::NAN,
        steering_angle_rad: f64::NAN,
        slip_ratio: f64::NAN,
        slip_angle_rad: f64::NAN,
        load_n: f64::NAN,
        power_w: f64::NAN,
        current_a: f64::NAN,
        reaction: Reaction::NONE,
    };
}

impl From<&WheelRecord> for Wheel {
    fn from(wheel: &WheelRecord) -> Self {
        let WheelRecord { reaction, .. } = wheel;
        Self {
            wheel_speed_rad_s: wheel.wheel_speed,
            steering_angle_rad: wheel.steering,
            slip_ratio: reaction.slip.ratio,
            slip_angle_rad: reaction.slip.angle,
            load_n: reaction.load,
            power_w: wheel.power(),
            current_a: wheel.electrical.map_or(f64::NAN, |taken| taken.current),
            reaction: Reaction::new(reaction.settled.sinkage, &reaction.settled.forces),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The numbers of C's enum are those of the table of outcomes, one later: 0 is under way.
    #[test]
    fn outcomes_are_numbered_as_their_table() {
        for (place, kind) in OutcomeKind::ALL.into_iter().enumerate() {
            assert_eq!(Outcome::from(kind) as usize, place + 1);
        }
    }
}
