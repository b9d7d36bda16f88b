//! Wheels that roll in the ruts of those before them (multi-pass).
//!
//! A wheel's rut is a strip as wide as the wheel, along the way that its hub goes. What a following
//! wheel covers of it is compacted, the rest of its width is fresh:
//!
//! ```text
//! o = max(0, 1 − L |sin γ_track|/b)        soil = fresh + o (compacted − fresh)
//! ```
//!
//! with the distance L of both wheels and the angle γ_track between the line through them and the
//! way. Nothing is remembered: the way is taken to be straight as the rover moves now, which holds
//! for steady motion on a plane. A rover that has just turned, or set out, has ruts here that it
//! has not made yet. On uneven ground distances between wheels are those in the body's plane. The
//! bottom of a rut, λh below the surface, counts as the ground of the wheel that rolls in it; the
//! pose does not follow those few millimetres.

use super::parts::Mount;
use super::rover::Rover;
use crate::contact::Slip;
use crate::elementary::wide::hypot;
use crate::soil::Compaction;
use crate::units::Vec2;

/// What wheels leave behind for those that follow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Ruts {
    /// Nothing: every wheel rolls on fresh soil.
    #[default]
    Fresh,
    /// Soil compacted by the passes before, as [`Compaction::of_passes`] has it.
    Compacted,
    /// Soil changed as stated, by however many passes.
    Stated(Compaction),
}

impl Ruts {
    /// What wheels before each have made of its soil, in the mounts' order; none where all roll on
    /// fresh soil.
    ///
    /// * `slips`: of each wheel
    #[must_use]
    pub fn of_wheels(self, rover: &Rover, slips: &[Slip]) -> Option<Vec<Compaction>> {
        let mounts = rover.mounts();
        let each = |wheel: usize| self.of_wheel(mounts, slips, wheel);
        (self != Self::Fresh).then(|| (0..mounts.len()).map(each).collect())
    }

    fn of_wheel(self, mounts: &[Mount], slips: &[Slip], wheel: usize) -> Compaction {
        let way = way(&mounts[wheel], &slips[wheel]);
        let mut before: Vec<(f64, f64, usize)> = (0..mounts.len())
            .filter_map(|other| {
                let lead = mounts[other].position.xy() - mounts[wheel].position.xy();
                let ahead = lead.dot(&way);
                let share = overlap(&mounts[other], &mounts[wheel], lead, way);
                (ahead > 0.0 && share > 0.0).then_some((ahead, share, other))
            })
            .collect();
        // The farthest ahead passed first.
        before.sort_by(|one, other| other.0.total_cmp(&one.0));
        let mut soil = Compaction::NONE;
        for (passed, (_, share, other)) in (1..).zip(before) {
            let after = match self {
                Self::Fresh => Compaction::NONE,
                Self::Compacted => Compaction::of_passes(slips[other].ratio, passed),
                Self::Stated(stated) => stated,
            };
            soil = soil.covered(after, share);
        }
        soil
    }
}

/// Direction of a hub's way in the body frame: a unit vector, and nothing for a hub at rest.
fn way(mount: &Mount, slip: &Slip) -> Vec2 {
    /// A hub counts as at rest well below this speed over the rim's [-].
    const STILL: f64 = 1e-4;
    let hub = mount.body_from_wheel(Vec2::new(slip.forward, slip.lateral));
    hub / hypot(hub.norm(), STILL)
}

/// Share of a wheel's width that lies in the rut of another [-].
///
/// * `lead`: from the wheel to the other, in the body frame [m]
/// * `way`: direction of the wheel's way
#[must_use]
pub fn overlap(other: &Mount, wheel: &Mount, lead: Vec2, way: Vec2) -> f64 {
    let [rut, width] = [other, wheel].map(|mount| mount.unit.wheel.width);
    let aside = lead.perp(&way).abs();
    let length = way.norm();
    // A way that is hardly one has hardly a rut.
    length * ((0.5 * (rut + width) - aside).min(rut).min(width) / width).max(0.0)
}
