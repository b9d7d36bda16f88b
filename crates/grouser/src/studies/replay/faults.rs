//! What may be wrong where measured and predicted differ: one number for each kind, and what it
//! does to a prediction.

use std::f64::consts::PI;

use super::prescribed::{Predicted, Situation};
use crate::elementary::wide::{atan2, exp_m1, tan};
use crate::soil::{Shear, ShearModulus, Soil, SoilDifference};
use crate::vehicle::{RoverState, roll_and_pitch, slope_and_yaw};

/// What differences may point to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cause {
    /// The soil is another than that of the document.
    Soil,
    /// The rims move at other speeds than wheel speeds and radii say: the radius, an encoder, or
    /// the scale of the odometry, which does the same.
    Speed,
    /// The ground is steeper or flatter than was read or told.
    Slope,
    /// The sensor of the attitude is mounted with a roll.
    RollMounting,
    /// The same with a pitch.
    PitchMounting,
    /// The same with a yaw.
    YawMounting,
    /// The sensor of the odometry is mounted with a yaw.
    OdometryMounting,
    /// The yaw rate is read with a bias.
    YawRate,
    /// Torques are read by another scale.
    Torque,
}

impl Cause {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Soil,
        Self::Speed,
        Self::Slope,
        Self::RollMounting,
        Self::PitchMounting,
        Self::YawMounting,
        Self::OdometryMounting,
        Self::YawRate,
        Self::Torque,
    ];

    /// A word of program output.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Soil => "soil",
            Self::Speed => "speed",
            Self::Slope => "slope",
            Self::RollMounting => "roll-mounting",
            Self::PitchMounting => "pitch-mounting",
            Self::YawMounting => "yaw-mounting",
            Self::OdometryMounting => "odometry-mounting",
            Self::YawRate => "yaw-rate",
            Self::Torque => "torque",
        }
    }

    /// What it means for an engineer.
    #[must_use]
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Soil => "the soil is another than that of the document",
            Self::Speed => {
                "the rims move at another speed than was read: the wheels' radius, an encoder's \
                 scale, or the odometry's"
            }
            Self::Slope => "the ground is steeper or flatter than was read or stated",
            Self::RollMounting => "the sensor of roll and pitch is mounted with a roll",
            Self::PitchMounting => "the sensor of roll and pitch is mounted with a pitch",
            Self::YawMounting => "the sensor of roll and pitch is mounted with a yaw",
            Self::OdometryMounting => "the sensor of the odometry is mounted with a yaw",
            Self::YawRate => "the yaw rate is read with a bias",
            Self::Torque => "torques, or currents, are read by another scale",
        }
    }
}

/// A number that says how far off something is; 0 where all is as it was read and as the documents
/// say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// How much stronger the soil is than assumed, the logarithm of the ratio: c and tan φ [-].
    Strength,
    /// The same of its shear deformation moduli [-].
    ShearModulus,
    /// The same of the pressure that it bears at a sinkage [-].
    Stiffness,
    /// By which share rims move faster than was read [-].
    Speed,
    /// By how much the ground is steeper than was read or told [rad].
    Slope,
    /// By how much the roll is read too large [rad].
    Roll,
    /// By how much the pitch is read too large [rad].
    Pitch,
    /// By how much the sensor of roll and pitch is turned to the left [rad].
    Yaw,
    /// By how much the sensor of the odometry is turned to the left [rad].
    Odometry,
    /// By how much the yaw rate is read too large [rad/s].
    YawRate,
    /// By which share torques are read too large [-].
    Torque,
}

/// How many parameters there are.
pub(super) const COUNT: usize = Parameter::ALL.len();

impl Parameter {
    /// All of them, those of a cause together.
    pub const ALL: [Self; 11] = [
        Self::Strength,
        Self::ShearModulus,
        Self::Stiffness,
        Self::Speed,
        Self::Slope,
        Self::Roll,
        Self::Pitch,
        Self::Yaw,
        Self::Odometry,
        Self::YawRate,
        Self::Torque,
    ];

    /// The cause that it belongs to.
    #[must_use]
    pub const fn cause(self) -> Cause {
        match self {
            Self::Strength | Self::ShearModulus | Self::Stiffness => Cause::Soil,
            Self::Speed => Cause::Speed,
            Self::Slope => Cause::Slope,
            Self::Roll => Cause::RollMounting,
            Self::Pitch => Cause::PitchMounting,
            Self::Yaw => Cause::YawMounting,
            Self::Odometry => Cause::OdometryMounting,
            Self::YawRate => Cause::YawRate,
            Self::Torque => Cause::Torque,
        }
    }

    /// How large it is where something is wrong, its standard deviation beforehand, in SI. Source:
    /// ours: sands of one name differ by 4° of friction and by half of their moduli, wheels with
    /// grousers by a twentieth of their radius; sensors are mounted by eye.
    #[must_use]
    pub fn usual(self) -> f64 {
        match self {
            Self::Strength => 0.15,
            Self::ShearModulus | Self::Stiffness => 0.5,
            Self::Speed => 0.05,
            // 2°, 4°, half a degree a second.
            Self::Slope | Self::Roll | Self::Pitch => PI / 90.0,
            Self::Yaw | Self::Odometry => PI / 45.0,
            Self::YawRate => PI / 360.0,
            Self::Torque => 0.2,
        }
    }

    /// An estimate of it, and its standard deviation, as a reader expects them: logarithms become
    /// shares.
    pub(super) fn as_share(self, [estimate, deviation]: [f64; 2]) -> [f64; 2] {
        if self.cause() == Cause::Soil {
            return [exp_m1(estimate), (1.0 + exp_m1(estimate)) * deviation];
        }
        [estimate, deviation]
    }

    /// Whether predictions have to be computed anew for it; if not, it is what instruments add to
    /// them.
    pub(super) fn moves_rover(self) -> bool {
        !matches!(self, Self::Odometry | Self::YawRate | Self::Torque)
    }
}

/// What is wrong, by [`Parameter::ALL`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Faults([f64; COUNT]);

/// Errors over their usual size are looked at within this [-]: models are no tangents farther out.
const FARTHEST: f64 = 2.5;

impl Faults {
    /// These values over their usual sizes, as far as that is sensible.
    pub(super) fn of(over_usual: [f64; COUNT]) -> Self {
        let mut values = over_usual.map(|it| it.clamp(-FARTHEST, FARTHEST));
        for (value, parameter) in values.iter_mut().zip(Parameter::ALL) {
            *value *= parameter.usual();
        }
        Self(values)
    }

    /// The same with one more.
    pub(super) fn and(mut self, parameter: Parameter, value: f64) -> Self {
        self.0[parameter as usize] += value;
        self
    }

    /// Each over its usual size.
    pub(super) fn over_usual(&self) -> Vec<f64> {
        let pairs = self.0.iter().zip(Parameter::ALL);
        pairs.map(|(value, parameter)| value / parameter.usual()).collect()
    }

    fn get(&self, parameter: Parameter) -> f64 {
        self.0[parameter as usize]
    }

    /// The ratio of which it is the logarithm, or by which share it is off.
    fn factor(&self, parameter: Parameter) -> f64 {
        let value = self.get(parameter);
        if parameter.cause() == Cause::Soil { 1.0 + exp_m1(value) } else { 1.0 + value }
    }

    /// A soil that is off by them.
    pub(super) fn soil(&self, soil: &Soil) -> Soil {
        let strength = self.factor(Parameter::Strength);
        let friction = strength * tan(soil.friction_angle);
        let stiffness = self.factor(Parameter::Stiffness);
        Soil {
            cohesion: strength * soil.cohesion,
            friction_angle: atan2(friction, 1.0),
            shear: scaled(soil.shear, self.factor(Parameter::ShearModulus)),
            ..soil.differing(SoilDifference { friction_angle: 0.0, stiffness })
        }
    }

    /// What was true where the situation was read.
    ///
    /// ```text
    /// what is read = what is true + offset
    /// ```
    pub(super) fn situation(&self, read: &Situation) -> Situation {
        let [roll, pitch] = roll_and_pitch(read.slope, read.yaw - self.get(Parameter::Yaw));
        let [roll, pitch] = [roll - self.get(Parameter::Roll), pitch - self.get(Parameter::Pitch)];
        let [slope, yaw] = slope_and_yaw(roll, pitch);
        // On level ground the yaw is what it was.
        let yaw = if slope == 0.0 { read.yaw } else { yaw };
        let steeper = slope + self.get(Parameter::Slope);
        let (slope, yaw) = if steeper < 0.0 { (-steeper, yaw + PI) } else { (steeper, yaw) };
        let factor = self.factor(Parameter::Speed);
        let rim_speeds = read.rim_speeds.iter().map(|it| factor * it).collect();
        Situation { study: read.study.clone(), slope, yaw, rim_speeds }
    }

    /// What instruments with these faults read of a motion.
    pub(super) fn read(&self, mut truth: Predicted) -> Predicted {
        let turned = RoverState { yaw: -self.get(Parameter::Odometry), ..RoverState::default() };
        truth.velocity = turned.slope_from_body() * truth.velocity;
        truth.yaw_rate += self.get(Parameter::YawRate);
        let factor = self.factor(Parameter::Torque);
        truth.torques.iter_mut().for_each(|it| *it *= factor);
        truth
    }
}

fn scaled(shear: Shear, factor: f64) -> Shear {
    let modulus = |it: ShearModulus| match it {
        ShearModulus::Linear { at_zero, per_radian } => {
            ShearModulus::Linear { at_zero: factor * at_zero, per_radian: factor * per_radian }
        }
        ShearModulus::Quadratic { at_zero, per_radian, per_radian_squared, angle_limit } => {
            ShearModulus::Quadratic {
                at_zero: factor * at_zero,
                per_radian: factor * per_radian,
                per_radian_squared: factor * per_radian_squared,
                angle_limit,
            }
        }
    };
    match shear {
        Shear::Anisotropic { longitudinal, lateral } => {
            Shear::Anisotropic { longitudinal: modulus(longitudinal), lateral: modulus(lateral) }
        }
        Shear::Isotropic { modulus: it } => Shear::Isotropic { modulus: modulus(it) },
    }
}
