//! Sums of what the facets of half a wheel meet.

#![expect(clippy::inline_always, reason = "all of it is compiled once for each instruction set")]

use super::super::forces::WheelForces;
use super::super::lanes::{Each, WIDE, sum};
use super::rays::Rays;

/// Forces [N] on the facets along each ray, in directions of its own: out of the rim, along it the
/// way of growing angles, and to the left.
#[derive(Default)]
pub(super) struct RaySums {
    outward: Each,
    along: Each,
    across: Each,
    /// Moments [N·m]: force times distance from the axle.
    along_arm: Each,
    across_arm: Each,
}

impl RaySums {
    /// Adds the force on a facet at a radius [m].
    #[inline(always)]
    pub(super) fn add(&mut self, lane: usize, radius: f64, outward: f64, along: f64, across: f64) {
        self.outward[lane] += outward;
        self.along[lane] += along;
        self.across[lane] += across;
        self.along_arm[lane] += radius * along;
        self.across_arm[lane] += radius * across;
    }
}

/// The same for both side faces.
#[derive(Default)]
pub(super) struct SideSums {
    pub left: RaySums,
    pub right: RaySums,
}

/// Forces [N] and moments [N·m] in the wheel frame, for each lane's facets.
#[derive(Default)]
pub(super) struct Sums {
    thrust: Each,
    motion_resistance: Each,
    side_force_from_shear: Each,
    bulldozing_load: Each,
    side_force: Each,
    normal_force: Each,
    torque: Each,
    overturning_moment: Each,
    aligning_moment: Each,
    /// The largest normal stress on the rim [Pa], and the angle [rad] where it is.
    peak: (Each, Each),
}

impl Sums {
    /// A cylinder's facets: what pushes points inward, and all else is shear.
    #[inline(always)]
    pub(super) fn add_cylinder(&mut self, rays: &Rays, forces: &RaySums) {
        for lane in 0..WIDE {
            let (sin, cos) = (rays.sin[lane], rays.cos[lane]);
            self.thrust[lane] += forces.along[lane] * cos;
            self.motion_resistance[lane] += forces.outward[lane] * sin;
        }
        self.add_upright_forces(rays, forces);
    }

    /// Facets of grousers: whatever meets them is thrust.
    #[inline(always)]
    pub(super) fn add_grousers(&mut self, rays: &Rays, forces: &RaySums) {
        for lane in 0..WIDE {
            let (sin, cos) = (rays.sin[lane], rays.cos[lane]);
            self.thrust[lane] += forces.along[lane] * cos + forces.outward[lane] * sin;
        }
        self.add_upright_forces(rays, forces);
    }

    /// What both have alike.
    #[inline(always)]
    fn add_upright_forces(&mut self, rays: &Rays, forces: &RaySums) {
        for lane in 0..WIDE {
            let (sin, cos) = (rays.sin[lane], rays.cos[lane]);
            self.normal_force[lane] += forces.along[lane] * sin - forces.outward[lane] * cos;
            self.side_force_from_shear[lane] += forces.across[lane];
            self.side_force[lane] += forces.across[lane];
            self.torque[lane] += forces.along_arm[lane];
            self.overturning_moment[lane] += cos * forces.across_arm[lane];
            self.aligning_moment[lane] += sin * forces.across_arm[lane];
        }
    }

    /// Both side faces, half a width [m] beside the hub. They are added to each other first, so
    /// that a mirror between left and right keeps every bit.
    #[inline(always)]
    pub(super) fn add_sides(&mut self, rays: &Rays, forces: &SideSums, half_width: f64) {
        let SideSums { left, right } = forces;
        for lane in 0..WIDE {
            let (sin, cos) = (rays.sin[lane], rays.cos[lane]);
            let forward = |side: &RaySums| side.along[lane] * cos + side.outward[lane] * sin;
            let upward = |side: &RaySums| side.along[lane] * sin - side.outward[lane] * cos;
            let across_arm = left.across_arm[lane] + right.across_arm[lane];
            self.thrust[lane] += forward(left) + forward(right);
            self.normal_force[lane] += upward(left) + upward(right);
            self.bulldozing_load[lane] += left.across[lane].abs() + right.across[lane].abs();
            self.side_force[lane] += left.across[lane] + right.across[lane];
            self.torque[lane] += left.along_arm[lane] + right.along_arm[lane];
            self.overturning_moment[lane] +=
                half_width * (upward(left) - upward(right)) + cos * across_arm;
            self.aligning_moment[lane] +=
                sin * across_arm - half_width * (forward(left) - forward(right));
        }
    }

    /// Takes a normal stress [Pa] at an angle [rad], if it is the largest so far.
    #[inline(always)]
    pub(super) fn note_pressure(&mut self, lane: usize, pressure: f64, angle: f64) {
        let (most, at) = (self.peak.0[lane], self.peak.1[lane]);
        let larger = pressure > most;
        self.peak.0[lane] = if larger { pressure } else { most };
        self.peak.1[lane] = if larger { angle } else { at };
    }

    /// All together; the patch holds the angle of the largest normal stress.
    #[inline(always)]
    pub(super) fn total(&self) -> WheelForces {
        let (thrust, motion_resistance) = (sum(&self.thrust), sum(&self.motion_resistance));
        let mut forces = WheelForces {
            drawbar_pull: thrust + motion_resistance,
            side_force: sum(&self.side_force),
            normal_force: sum(&self.normal_force),
            torque: sum(&self.torque),
            overturning_moment: sum(&self.overturning_moment),
            aligning_moment: sum(&self.aligning_moment),
            thrust,
            motion_resistance,
            side_force_from_shear: sum(&self.side_force_from_shear),
            bulldozing_load: sum(&self.bulldozing_load),
            ..WheelForces::default()
        };
        for lane in 0..WIDE {
            if self.peak.0[lane] > forces.max_normal_stress {
                forces.max_normal_stress = self.peak.0[lane];
                forces.patch.max_stress = self.peak.1[lane];
            }
        }
        forces
    }
}
