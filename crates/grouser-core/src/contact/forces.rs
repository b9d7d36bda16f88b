//! The soil's reaction on one wheel.

use std::ops::{Add, Mul};

use super::patch::ContactPatch;
use crate::stored::stored;

/// Forces and moments of the soil on a wheel, about its hub, in the wheel frame (x forward, y
/// left, z up), and the parts they are made of.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WheelForces {
    /// Force along the wheel, *F_x* [N]: thrust less motion resistance.
    pub drawbar_pull: f64,
    /// Force across the wheel, *F_y* [N], positive to the left.
    pub side_force: f64,
    /// Force out of the ground, *F_z* [N].
    pub normal_force: f64,
    /// Torque the drive has to hold, *T* [N·m]: positive while it drives the wheel forward.
    pub torque: f64,
    /// Overturning moment, *M_x* [N·m], about the wheel's long axis.
    pub overturning_moment: f64,
    /// Aligning moment, *M_z* [N·m], about the wheel's upright axis.
    pub aligning_moment: f64,
    /// Part of the drawbar pull from shear stress [N].
    pub thrust: f64,
    /// Part of the drawbar pull taken by normal stress and bulldozing [N]; it counts negative.
    pub motion_resistance: f64,
    /// Part of the side force from shear stress, *F_u* [N].
    pub side_force_from_shear: f64,
    /// Full load of the soil pushed aside, *F_s* [N], before the slip angle's share.
    pub bulldozing_load: f64,
    /// Largest normal stress on the rim, *σ_max* [Pa].
    pub max_normal_stress: f64,
    /// The arc in contact, in angles from straight down, positive on the entering side.
    pub patch: ContactPatch,
}

stored!(struct WheelForces {
    drawbar_pull,
    side_force,
    normal_force,
    torque,
    overturning_moment,
    aligning_moment,
    thrust,
    motion_resistance,
    side_force_from_shear,
    bulldozing_load,
    max_normal_stress,
    patch,
});

impl WheelForces {
    /// The same forces seen in a mirror that swaps front and back.
    #[must_use]
    pub fn front_to_back(self) -> Self {
        Self {
            drawbar_pull: -self.drawbar_pull,
            torque: -self.torque,
            aligning_moment: -self.aligning_moment,
            thrust: -self.thrust,
            motion_resistance: -self.motion_resistance,
            ..self
        }
    }
}

/// Forces scaled alike; the patch, which is no force, stays.
impl Mul<f64> for WheelForces {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self {
            drawbar_pull: self.drawbar_pull * factor,
            side_force: self.side_force * factor,
            normal_force: self.normal_force * factor,
            torque: self.torque * factor,
            overturning_moment: self.overturning_moment * factor,
            aligning_moment: self.aligning_moment * factor,
            thrust: self.thrust * factor,
            motion_resistance: self.motion_resistance * factor,
            side_force_from_shear: self.side_force_from_shear * factor,
            bulldozing_load: self.bulldozing_load * factor,
            max_normal_stress: self.max_normal_stress * factor,
            patch: self.patch,
        }
    }
}

/// Forces of two reactions together; the patch is the first one's.
impl Add for WheelForces {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            drawbar_pull: self.drawbar_pull + other.drawbar_pull,
            side_force: self.side_force + other.side_force,
            normal_force: self.normal_force + other.normal_force,
            torque: self.torque + other.torque,
            overturning_moment: self.overturning_moment + other.overturning_moment,
            aligning_moment: self.aligning_moment + other.aligning_moment,
            thrust: self.thrust + other.thrust,
            motion_resistance: self.motion_resistance + other.motion_resistance,
            side_force_from_shear: self.side_force_from_shear + other.side_force_from_shear,
            bulldozing_load: self.bulldozing_load + other.bulldozing_load,
            max_normal_stress: self.max_normal_stress + other.max_normal_stress,
            patch: self.patch,
        }
    }
}
