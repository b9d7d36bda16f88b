//! Sums of what the facets of a wheel meet, for each lane.

#![expect(clippy::inline_always, reason = "all of it is compiled once for each instruction set")]

use super::super::forces::WheelForces;
use super::super::kernel::{LANES, Lanes, sum};
use super::facet::{Vector, added};

/// Reactions of the rim with its grousers and of both side faces.
#[derive(Default)]
pub(super) struct Sums {
    pub middle: LaneSums,
    pub left: LaneSums,
    pub right: LaneSums,
}

/// To which part of the wheel a facet belongs.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    Rim,
    Grouser,
    SideWall,
}

/// Forces [N] and moments [N·m], for each lane's facets.
#[derive(Default)]
pub(super) struct LaneSums {
    thrust: Lanes,
    motion_resistance: Lanes,
    side_force_from_shear: Lanes,
    bulldozing_load: Lanes,
    side_force: Lanes,
    normal_force: Lanes,
    moment: [Lanes; 3],
    /// The largest normal stress on the rim [Pa], and the angle [rad] where it is.
    peak: (Lanes, Lanes),
}

impl LaneSums {
    /// Adds the normal and the shear force [N] on a facet at a place [m] from the hub.
    #[inline(always)]
    pub(super) fn add(
        &mut self,
        part: Part,
        lane: usize,
        place: Vector,
        push: Vector,
        shear: Vector,
    ) {
        let [x, y, z] = place;
        let force = added(push, shear);
        match part {
            Part::Rim => {
                self.motion_resistance[lane] += push[0];
                self.thrust[lane] += shear[0];
                self.side_force_from_shear[lane] += force[1];
            }
            Part::Grouser => {
                self.thrust[lane] += force[0];
                self.side_force_from_shear[lane] += force[1];
            }
            Part::SideWall => {
                self.thrust[lane] += force[0];
                self.bulldozing_load[lane] += push[1].abs();
            }
        }
        self.side_force[lane] += force[1];
        self.normal_force[lane] += force[2];
        self.moment[0][lane] += y * force[2] - z * force[1];
        self.moment[1][lane] += z * force[0] - x * force[2];
        self.moment[2][lane] += x * force[1] - y * force[0];
    }

    /// Takes a normal stress [Pa] at an angle [rad], if it is the largest so far.
    #[inline(always)]
    pub(super) fn note_pressure(&mut self, lane: usize, pressure: f64, angle: f64) {
        let (most, at) = (self.peak.0[lane], self.peak.1[lane]);
        let larger = pressure > most;
        self.peak.0[lane] = if larger { pressure } else { most };
        self.peak.1[lane] = if larger { angle } else { at };
    }

    #[inline(always)]
    fn total(&self) -> WheelForces {
        let mut forces = WheelForces {
            side_force: sum(&self.side_force),
            normal_force: sum(&self.normal_force),
            torque: -sum(&self.moment[1]),
            overturning_moment: sum(&self.moment[0]),
            aligning_moment: sum(&self.moment[2]),
            thrust: sum(&self.thrust),
            motion_resistance: sum(&self.motion_resistance),
            side_force_from_shear: sum(&self.side_force_from_shear),
            bulldozing_load: sum(&self.bulldozing_load),
            ..WheelForces::default()
        };
        for lane in 0..LANES {
            if self.peak.0[lane] > forces.max_normal_stress {
                forces.max_normal_stress = self.peak.0[lane];
                forces.patch.max_stress = self.peak.1[lane];
            }
        }
        forces
    }
}

impl Sums {
    /// All together.
    #[inline(always)]
    pub(super) fn total(&self) -> WheelForces {
        let middle = self.middle.total();
        // The sides together first, so that a mirror between left and right keeps every bit.
        let mut sum = middle + (self.left.total() + self.right.total());
        // Largest values and their places do not add up.
        sum.max_normal_stress = middle.max_normal_stress;
        sum.drawbar_pull = sum.thrust + sum.motion_resistance;
        sum
    }
}
