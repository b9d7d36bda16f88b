//! The small-wheel model: the classical one with the terms that small rovers need. One parameter
//! set serves a wheel and a soil.
//!
//! The stresses of [`ishigami`] on an arc of its own, in a soil that gives way to a moving wheel,
//! and four forces more, all within what the ground resists ([`coulomb_cone`]). The terms are the
//! soil's ([`crate::soil::small_wheel`]); with all of them off the model is `ishigami` within that
//! bound, to the last bit.
//!
//! ```text
//! σ   = K_σ (z/ζ)ⁿ                                     ζ(S, β): the moving wheel digs itself in
//! λ   = λ₀ (1 − f_λ S⁺) + λ_s S⁺ + λ_β |sin β|         within 0 and 1
//! |τ| ≤ c + σ min(tan φ, tan δ)                        friction of the wheel–soil interface
//! F_s = k_f e^(−ζ_b |S|) ∫ R_b(h(θ)) [r_s − h cos θ] dθ     the side wall, loaded by the soil piled up at it
//! X_f = μ_f |F_s sin β| u_x/√(u_x² + v_y²)             u_x = ω r_F − v_x: friction of the side face
//! Q   = −f_front b R_b(h) S⁻ (v_x, v_y)/V              bow wave in front of a skidding wheel
//! X_b = f_behind b R_b(h) S⁺²                          rear mound behind a spinning wheel
//! ```
//!
//! In skid the sinkage grows by ζ alone: where a soil has the term, its exponent's growth in skid
//! is another form of the same and does not count.
//!
//! S is the slip by the total speed ([`Slip::total`]), S⁺ its driving part and S⁻ its skid.
//! `docs/models/small-wheel.md` shows what each term brings, out of sample.
//!
//! [`Slip::total`]: super::slip::Slip::total

use std::f64::consts::FRAC_PI_4;

use super::bulldozing::{self, SideWallLoad, WallResistance};
use super::cohesion::Cohesion;
use super::coulomb_cone;
use super::forces::WheelForces;
use super::inputs::Contact;
use super::ishigami;
use super::kernel::InstructionSet;
use super::load_sinkage::{Finish, LoadSinkage, Numerics, Reaction};
use super::model::WheelSoilModel;
use super::stress::Response;
use crate::elementary::{self, wide};
use crate::soil::{Domain, Span};

/// The classical model with the terms of [`crate::soil::SmallWheel`].
#[derive(Clone, Copy, Debug)]
pub struct SmallWheel {
    numerics: Numerics,
}

impl Default for SmallWheel {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl SmallWheel {
    /// The model with as many nodes as the classical one has.
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
        self.finished_by(contact, finished)
    }

    fn finished_by(&self, contact: &Contact, finish: Finish) -> LoadSinkage {
        LoadSinkage::new(contact, |it| self.numerics.arc(&counted_once(it), &response(it)), finish)
    }

    /// The forces without the ground's bound, of a wheel sunk by `sinkage` [m].
    pub(super) fn unbounded_forces(&self, contact: &Contact, sinkage: f64) -> WheelForces {
        self.finished_by(contact, added_up).forces(contact, sinkage)
    }
}

impl WheelSoilModel for SmallWheel {
    // Source: the single-wheel tests of Pavlov and Johnson (2022) to which the model was made,
    // without the slip angle of 90°.
    fn domain(&self) -> Domain {
        Domain {
            depth: Span::at_most(0.95),
            slip_ratio: Span::new(-1.0, 0.975),
            slip_angle: Span::at_most(75.0 / 45.0 * FRAC_PI_4),
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
    coulomb_cone::within_the_cone(contact, added_up(contact, reaction, sinkage), sinkage)
}

/// The terms of the model, which the ground has not bounded yet.
fn added_up(contact: &Contact, reaction: &Reaction, sinkage: f64) -> WheelForces {
    let wall_load = on_side_wall(contact, &reaction.side_wall);
    let share = Cohesion::of(&contact.soil).share(reaction.max_normal_stress);
    let wall = WallResistance::of(contact).pressed(share);
    let pushed = contact.wheel.width * wall.at(sinkage);

    // Only the first of them carries.
    ishigami::forces(contact, reaction, &wall_load)
        + face_friction(contact, &wall_load)
        + bow_wave(contact, pushed, sinkage)
        + rear_mound(contact, pushed)
}

/// The contact, with the sinkage that skid adds counted once: by the model's term, where the soil
/// has one.
fn counted_once(contact: &Contact) -> Contact {
    let mut soil = contact.soil;
    if soil.small_wheel.sinkage.locked > 0.0 {
        soil.pressure_sinkage = soil.pressure_sinkage.unchanged_in_skid();
    }
    Contact { soil, ..*contact }
}

/// What the soil makes of a wheel's motion.
fn response(contact: &Contact) -> Response {
    let classical = Response::classical(contact);
    let terms = &contact.soil.small_wheel;
    let (total_slip, beta) = (contact.slip.total(), contact.slip.angle);
    Response {
        sinkage_growth: terms.sinkage.at(total_slip, beta),
        exit_ratio: terms.exit.ratio(classical.exit_ratio, total_slip, beta),
        friction: terms
            .interface
            .friction_angle_of(&contact.wheel, &contact.soil)
            .map_or(classical.friction, |delta| classical.friction.min(wide::tan(delta))),
    }
}

/// The load on the side wall: larger than on a bare wall, and fading as the wheel slips or skids.
fn on_side_wall(contact: &Contact, bare: &SideWallLoad) -> SideWallLoad {
    let terms = &contact.soil.small_wheel.side_wall;
    let fading = elementary::exp(-terms.fading * contact.slip.total().abs());
    SideWallLoad { force: bare.force * (terms.pressure_factor * fading), ..*bare }
}

/// Friction of the loaded side face, along the wheel.
///
/// The face slides over the soil with u_x = ω r_F − v_x at the load's line of action, r_F below
/// the hub, and presses into it with v_y. Friction acts against the sum of both; its part across
/// belongs to the side wall's load already.
fn face_friction(contact: &Contact, load: &SideWallLoad) -> WheelForces {
    let slip = &contact.slip;
    let (across, _) = bulldozing::shares(contact.soil.bulldozing, slip);
    let below = load.below_hub / contact.wheel.shearing_radius();
    let sliding = slip.rim * below - slip.forward;
    let speed = wide::hypot(wide::hypot(sliding, slip.lateral), slip.creep());
    if speed == 0.0 {
        return WheelForces::default();
    }
    let limit = contact.soil.small_wheel.side_wall.friction * (across * load.force).abs();
    let force = limit * sliding / speed;
    WheelForces {
        drawbar_pull: force,
        thrust: force,
        torque: force * load.below_hub,
        ..WheelForces::default()
    }
}

/// The bow wave in front of a skidding wheel: a wall of the rim's width and of the sinkage's
/// height.
///
/// It acts against the hub's motion, at two thirds of the depth, and on the arc it has no lever
/// about the axle.
fn bow_wave(contact: &Contact, pushed: f64, sinkage: f64) -> WheelForces {
    let slip = &contact.slip;
    let travel = wide::hypot(slip.forward, slip.lateral);
    let skid = (-slip.total()).max(0.0);
    if travel == 0.0 || skid == 0.0 {
        return WheelForces::default();
    }
    let force = contact.soil.small_wheel.mounds.bow_wave * pushed * skid;
    let (along, across) = (-force * slip.forward / travel, -force * slip.lateral / travel);
    /// The pressure's centre, above the lowest point, in sinkages. Source: Rankine.
    const HEIGHT_OF_CENTRE: f64 = 1.0 / 3.0;
    WheelForces {
        drawbar_pull: along,
        motion_resistance: along,
        side_force: across,
        overturning_moment: across * (contact.wheel.shearing_radius() - HEIGHT_OF_CENTRE * sinkage),
        ..WheelForces::default()
    }
}

/// The rear mound behind a spinning wheel, against which the rim pushes itself off.
///
/// Its lever is the shearing radius: what the rim does on the mound the drive has to hold.
fn rear_mound(contact: &Contact, pushed: f64) -> WheelForces {
    let slip = &contact.slip;
    let spin = slip.total().max(0.0);
    let force = contact.soil.small_wheel.mounds.rear_mound * pushed * spin * spin * slip.rim;
    WheelForces {
        drawbar_pull: force,
        thrust: force,
        torque: force * contact.wheel.shearing_radius(),
        ..WheelForces::default()
    }
}
