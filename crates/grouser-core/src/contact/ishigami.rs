//! The source paper's model: stresses integrated along the arc (Ishigami et al. 2007).
//!
//! The stresses of [`StressField`](super::stress::StressField) act on the rim of a wheel of
//! shearing radius *r_s* and width *b*; the soil pushed aside acts on its side wall. With θ from
//! straight down, the rim's point is (r_s sin θ, 0, −r_s cos θ), normal stress points to the hub
//! and shear stress along the rim, so
//!
//! ```text
//! F_x = r_s b ∫ (τ_x cos θ − σ sin θ) dθ       T   = r_s² b ∫ τ_x dθ
//! F_y = r_s b ∫ τ_y dθ − F_s sin β             M_x = r_s² b ∫ τ_y cos θ dθ + wall
//! F_z = r_s b ∫ (τ_x sin θ + σ cos θ) dθ       M_z = r_s² b ∫ τ_y sin θ dθ + wall
//! ```
//!
//! `docs/models/ishigami.md` has the assumptions and how to get the parameters.

use std::f64::consts::FRAC_PI_4;

use super::bulldozing::{self, SideWallLoad};
use super::coulomb::bounded;
use super::forces::WheelForces;
use super::inputs::Contact;
use super::kernel::InstructionSet;
use super::load_sinkage::{LoadSinkage, Numerics, Reaction};
use super::model::{SHALLOW, WheelSoilModel};
use super::stress::Response;
use crate::soil::{Domain, Span};

/// The model of Ishigami, Miwa, Nagatani and Yoshida (2007), with the options of its successors.
#[derive(Clone, Copy, Debug)]
pub struct Ishigami {
    numerics: Numerics,
}

impl Default for Ishigami {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl Ishigami {
    /// The model with as many nodes as an error below 1e-6 of the load needs.
    pub const DEFAULT: Self = Self { numerics: Numerics::DEFAULT };

    /// The same model with four times as many nodes as the finest rule, to measure the error of the
    /// quadrature.
    #[must_use]
    pub fn reference() -> Self {
        Self { numerics: Numerics::REFERENCE }
    }

    /// The same model on one instruction set, or on the baseline where the processor lacks it. The
    /// bits are the same.
    #[must_use]
    pub fn on(self, set: InstructionSet) -> Self {
        Self { numerics: Numerics { set: Some(set), ..self.numerics } }
    }

    fn relation(&self, contact: &Contact) -> LoadSinkage {
        LoadSinkage::new(contact, |it| self.numerics.arc(it, &Response::classical(it)), finished)
    }
}

impl WheelSoilModel for Ishigami {
    fn domain(&self) -> Domain {
        Domain {
            depth: SHALLOW,
            // Source: the smallest wheel of Ishigami et al. (2007), and the largest of Wong and
            // Reece (1967).
            radius: Span::new(0.09, 0.63),
            // Source: driven wheels, 0 to 0.8, in Ishigami et al. (2007). A tenth more on both
            // sides is ours, so that wheels that barely skid on level ground are not flagged.
            slip_ratio: Span::new(-0.1, 0.9),
            // Source: Ishigami et al. (2007).
            slip_angle: Span::at_most(FRAC_PI_4),
            ..Domain::UNSTATED
        }
    }

    fn forces(&self, contact: &Contact, sinkage: f64) -> WheelForces {
        self.relation(contact).forces(contact, sinkage)
    }

    fn load_sinkage(&self, contact: &Contact) -> Option<LoadSinkage> {
        Some(self.relation(contact))
    }
}

/// The soil's reaction on a wheel that enters it with its front.
fn finished(contact: &Contact, reaction: &Reaction, sinkage: f64) -> WheelForces {
    bounded(contact, sinkage, forces(contact, reaction, &reaction.side_wall))
}

/// The stresses on the rim and the load on the side wall, added up.
pub(super) fn forces(contact: &Contact, reaction: &Reaction, wall: &SideWallLoad) -> WheelForces {
    let sums = &reaction.sums;
    let r = contact.wheel.shearing_radius();
    let area = r * contact.wheel.width;
    let (across, along) = bulldozing::shares(contact.soil.bulldozing, &contact.slip);
    let (wall_y, wall_x) = (across * wall.force, along * wall.force);

    let thrust = area * sums.shear_forward;
    let motion_resistance = wall_x - area * sums.normal_back;
    let side_force_from_shear = area * sums.lateral;
    WheelForces {
        drawbar_pull: thrust + motion_resistance,
        side_force: side_force_from_shear + wall_y,
        normal_force: area * sums.up,
        torque: area * r * sums.shear,
        overturning_moment: area * r * sums.lateral_below + wall_y * wall.below_hub,
        aligning_moment: area * r * sums.lateral_ahead + wall_y * wall.ahead_of_hub,
        thrust,
        motion_resistance,
        side_force_from_shear,
        bulldozing_load: wall.force,
        max_normal_stress: reaction.max_normal_stress,
        patch: reaction.patch,
    }
}
