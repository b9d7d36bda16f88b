//! An independent second model: three-dimensional resistive force theory on a wheel's facets
//! (Agarwal, Goldman and Kamrin, PNAS 2023).
//!
//! Nothing of the classical models is used, neither pressure-sinkage law nor shear modulus: each
//! piece of the wheel's surface is a plate in granular soil, and what it meets depends on its
//! depth, its inclination and the direction of its motion alone. Two constants tell the soil, its
//! unit weight and its friction, and no force is adjusted to wheels.
//!
//! ```text
//! F = ∫ ξ d α(e_n, e_v) dA     v = v_hub + ω × r     over rim, grousers and both side faces
//! ```
//!
//! `facet` has the law α and the stiffness ξ, `surface` the wheel's facets, `sums` what they meet
//! together, `exposure` which of them grousers hide. The law knows no front, so the wheel is the
//! sum of its two halves, each seen with its own mirror; nothing is blended.
//!
//! A wheel below [`CREEP_SPEED`](super::slip::CREEP_SPEED) counts as one that sinks: directions
//! come from the velocity less that speed downward. So a wheel at rest carries its load as a wheel
//! does that is pressed in.

mod exposure;
mod facet;
mod nodes;
mod rays;
mod sums;
mod surface;

use super::coulomb::bounded;
use super::forces::WheelForces;
use super::gauss::{GAUSS_3, GAUSS_16, GAUSS_64};
use super::inputs::Contact;
use super::kernel::InstructionSet;
use super::kernel::dispatch::Work;
use super::model::WheelSoilModel;
use super::patch::ContactPatch;
use crate::soil::{Domain, Span};
use nodes::Nodes;
use surface::FacetedWheel;

/// Three-dimensional resistive force theory.
#[derive(Clone, Copy, Debug)]
pub struct Rft {
    nodes: Nodes,
    /// Without it, the best that the processor has.
    set: Option<InstructionSet>,
}

impl Default for Rft {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl Rft {
    /// Sixteen nodes over half the arc, three across: half of all wheels are off by less than 0.05
    /// % of the load, 99 % by less than 0.8 %, as with twice as many across.
    pub const DEFAULT: Self =
        Self { nodes: Nodes { arc: &GAUSS_16, disc: &GAUSS_3, height: &GAUSS_3 }, set: None };

    /// The same model with four and twenty times as many nodes, to measure the error of the
    /// quadrature.
    #[must_use]
    pub fn reference() -> Self {
        Self { nodes: Nodes { arc: &GAUSS_64, disc: &GAUSS_64, height: &GAUSS_64 }, set: None }
    }

    /// The same model on one instruction set, or on the baseline where the processor lacks it. The
    /// bits are the same.
    #[must_use]
    pub fn on(self, set: InstructionSet) -> Self {
        Self { set: Some(set), ..self }
    }
}

impl WheelSoilModel for Rft {
    fn domain(&self) -> Domain {
        // Any motion. Source: Agarwal, Goldman and Kamrin (2023). Down to the axle, where our
        // surface ends.
        Domain { depth: Span::at_most(1.0), ..Domain::UNSTATED }
    }

    fn forces(&self, contact: &Contact, sinkage: f64) -> WheelForces {
        if sinkage <= 0.0 {
            return WheelForces::default();
        }
        let wheel = FacetedWheel::new(contact, sinkage);
        let set = self.set.unwrap_or_else(InstructionSet::best);
        let (front, back) = set.run(Reaction { wheel: &wheel, nodes: &self.nodes });
        let peak = entering(contact.slip.entering_side, &front, &back);
        let arc = ContactPatch::of_depth(sinkage / contact.wheel.shearing_radius(), 0.0, 1.0);
        let both = WheelForces {
            max_normal_stress: front.max_normal_stress.max(back.max_normal_stress),
            patch: ContactPatch { max_stress: peak, ..arc },
            ..front + back.front_to_back()
        };
        bounded(contact, sinkage, both)
    }

    fn most_normal_force(&self, contact: &Contact, sinkage: f64) -> f64 {
        FacetedWheel::new(contact, sinkage.max(0.0)).most_force()
    }
}

/// What both halves of a wheel meet.
struct Reaction<'a> {
    wheel: &'a FacetedWheel,
    nodes: &'a Nodes,
}

impl Work for Reaction<'_> {
    type Output = (WheelForces, WheelForces);

    #[expect(clippy::inline_always, reason = "compiled once for each instruction set")]
    #[inline(always)]
    fn run(self) -> Self::Output {
        self.wheel.reaction(self.nodes)
    }
}

/// Where the normal stress peaks on the half that enters the soil [rad].
fn entering(side: f64, front: &WheelForces, back: &WheelForces) -> f64 {
    let (front, back) = (front.patch.max_stress, back.patch.max_stress);
    if side > 0.0 {
        front
    } else if side < 0.0 {
        back
    } else {
        front.max(back)
    }
}
