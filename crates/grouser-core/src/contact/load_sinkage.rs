//! The load–sinkage relation of one wheel: the load that the soil carries at any sinkage, made
//! ready for a search.
//!
//! A wheel that settles asks for F_z at several sinkages. What does not depend on the sinkage, and
//! what F_z does not depend on, is left out of that loop.

#![expect(clippy::inline_always, reason = "part of the kernel")]

use super::bulldozing::{self, SideWallLoad, WallResistance};
use super::forces::WheelForces;
use super::inputs::Contact;
use super::kernel::InstructionSet;
use super::kernel::dispatch::Work;
use super::kernel::integral::{self, StressSums};
use super::kernel::rule::{self, ArcRule, Nodes};
use super::mirror::{Side, from_both_sides};
use super::patch::ContactPatch;
use super::stress::{Response, StressLaw};

/// The vertical force of the soil on one wheel as a function of its sinkage.
///
/// Which load does the soil carry under a rolling wheel at sinkages of 10 and 20 mm?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::contact::{Contact, Ishigami, Slip, WheelSoilModel};
/// use grouser_core::units::mm;
///
/// let slip = Slip::on_test_stand(0.0, 0.0);
/// let contact = Contact { wheel: paper::hakuto_wheel(), soil: paper::toyoura(), slip, gravity: 9.81 };
/// let relation = Ishigami::DEFAULT.load_sinkage(&contact).expect("this model has one");
/// assert_eq!(format!("{:.1} N", relation.normal_force(mm(10.0))), "10.2 N");
/// assert_eq!(format!("{:.1} N", relation.normal_force(mm(20.0))), "46.4 N");
/// ```
#[derive(Clone, Debug)]
pub struct LoadSinkage {
    views: Views,
    /// r_s b [m²].
    area: f64,
    finish: Finish,
}

/// How a model makes forces of what the kernel computed of a wheel that enters the soil with its
/// front: for a contact, and at a sinkage [m].
pub(super) type Finish = fn(&Contact, &Reaction, f64) -> WheelForces;

/// Which ends of the wheel enter the soil, with their shares ([`super::mirror::from_both_sides`]).
#[derive(Clone, Debug)]
enum Views {
    One(Side, Arc),
    Both(Box<[(Arc, f64); 2]>),
}

impl LoadSinkage {
    pub(super) fn new(contact: &Contact, arc: impl Fn(&Contact) -> Arc, finish: Finish) -> Self {
        let area = contact.wheel.shearing_radius() * contact.wheel.width;
        let front = || arc(contact);
        let back = || arc(&contact.front_to_back());
        let (front_share, back_share) = contact.slip.shares_of_sides();
        let views = if back_share <= 0.0 {
            Views::One(Side::Front, front())
        } else if front_share <= 0.0 {
            Views::One(Side::Back, back())
        } else {
            Views::Both(Box::new([(front(), front_share), (back(), back_share)]))
        };
        Self { views, area, finish }
    }

    /// *F_z* [N] at a sinkage [m]: the bits of the model's
    /// [`forces`](super::model::WheelSoilModel::forces).
    #[must_use]
    pub fn normal_force(&self, sinkage: f64) -> f64 {
        if sinkage <= 0.0 {
            return 0.0;
        }
        match &self.views {
            Views::One(_, arc) => self.area * arc.up(sinkage),
            Views::Both(sides) => {
                let [front, back] = &**sides;
                let force = |(arc, share): &(Arc, f64)| self.area * arc.up(sinkage) * share;
                force(front) + force(back)
            }
        }
    }

    /// More than *F_z* [N] at this sinkage [m] and at all that are shallower: what full pressure
    /// and the soil's full strength on the whole arc would carry.
    #[must_use]
    pub fn most_normal_force(&self, sinkage: f64) -> f64 {
        let force = |arc: &Arc| self.area * arc.law.most_up(sinkage.max(0.0));
        match &self.views {
            Views::One(_, arc) => force(arc),
            Views::Both(sides) => sides.iter().map(|(arc, share)| force(arc) * share).sum(),
        }
    }

    /// All forces at a sinkage [m], of the contact that this was made of.
    #[must_use]
    pub fn forces(&self, contact: &Contact, sinkage: f64) -> WheelForces {
        from_both_sides(contact, sinkage, |contact, side| {
            let wall = WallResistance::of(contact);
            let reaction = self.arc(side).reaction(&wall, sinkage);
            (self.finish)(contact, &reaction, sinkage)
        })
    }

    /// The only arc there is, unless the wheel enters the soil with both its ends.
    pub(super) fn only_arc(&self) -> Option<&Arc> {
        match &self.views {
            Views::One(_, arc) => Some(arc),
            Views::Both(_) => None,
        }
    }

    /// r_s b [m²], by which F_z is more than what [`Arc`] has of it.
    pub(super) fn area(&self) -> f64 {
        self.area
    }

    /// [`forces`](Self::forces) of a wheel with one arc, from what the kernel computed of it.
    pub(super) fn finished(
        &self,
        contact: &Contact,
        reaction: &Reaction,
        sinkage: f64,
    ) -> WheelForces {
        match self.views {
            Views::One(Side::Back, _) => {
                (self.finish)(&contact.front_to_back(), reaction, sinkage).front_to_back()
            }
            _ => (self.finish)(contact, reaction, sinkage),
        }
    }

    /// The arc of the side that enters the soil, or of one of both.
    fn arc(&self, side: Side) -> &Arc {
        match &self.views {
            Views::One(_, arc) => arc,
            Views::Both(sides) => &sides[usize::from(side == Side::Back)].0,
        }
    }

    /// F_z of a shallow wheel without shear: the factor [N/m^p] and the power p of its sinkage. A
    /// search starts there.
    #[must_use]
    pub fn shallow(&self) -> (f64, f64) {
        let (factor, power) = self.arc(Side::Front).law.shallow();
        (self.area * factor, power)
    }

    /// The power [-] of the sinkage with which F_z of a shallow wheel grows, that of
    /// [`shallow`](Self::shallow).
    pub(crate) fn exponent(&self) -> f64 {
        self.arc(Side::Front).law.shallow_exponent()
    }
}

/// The arc of a wheel that enters the soil with its front.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arc {
    pub(super) law: StressLaw,
    rule: &'static ArcRule,
    /// Among many.
    pub(super) set: InstructionSet,
    /// Alone.
    alone: InstructionSet,
}

/// What the kernel computes of an arc at one sinkage.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reaction {
    pub patch: ContactPatch,
    pub sums: StressSums,
    /// Load on a side wall, with level soil or with what the bulldozing law piles up.
    pub side_wall: SideWallLoad,
    pub max_normal_stress: f64,
}

/// How a model runs the kernel.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Numerics {
    /// Without it, as many nodes as the contact needs.
    pub rule: Option<&'static ArcRule>,
    /// Without it, the best that the processor has.
    pub set: Option<InstructionSet>,
}

impl Numerics {
    pub(super) const DEFAULT: Self = Self { rule: None, set: None };
    pub(super) const REFERENCE: Self = Self { rule: Some(&rule::REFERENCE), set: None };

    pub(super) fn arc(&self, contact: &Contact, response: &Response) -> Arc {
        Arc {
            law: StressLaw::new(contact, response),
            rule: self.rule.unwrap_or_else(|| ArcRule::of(contact)),
            set: self.set.unwrap_or_else(InstructionSet::best),
            alone: self.set.unwrap_or_else(InstructionSet::best_of_one_wheel),
        }
    }
}

impl Arc {
    /// The nodes of its integral.
    pub(super) fn nodes(&self) -> Nodes {
        self.rule.nodes(&self.law)
    }

    /// ∫ (τ_x sin θ + σ cos θ) dθ [Pa·rad].
    #[inline]
    fn up(&self, sinkage: f64) -> f64 {
        self.alone.run(Up { arc: self, sinkage })
    }

    #[inline]
    fn reaction(&self, wall: &WallResistance, sinkage: f64) -> Reaction {
        self.alone.run(All { arc: self, wall, sinkage })
    }
}

struct Up<'a> {
    arc: &'a Arc,
    sinkage: f64,
}

impl Work for Up<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        integral::up(&self.arc.law.sunk(self.sinkage), self.arc.rule)
    }
}

struct All<'a> {
    arc: &'a Arc,
    wall: &'a WallResistance,
    sinkage: f64,
}

impl Work for All<'_> {
    type Output = Reaction;

    #[inline(always)]
    fn run(self) -> Reaction {
        let field = self.arc.law.sunk(self.sinkage);
        let wall = self.wall.pressed(field.cohesion_share());
        Reaction {
            sums: integral::all(&field, self.arc.rule),
            side_wall: bulldozing::side_wall_load(&wall, &field.patch, self.arc.law.radius()),
            max_normal_stress: field.max_normal(),
            patch: field.patch,
        }
    }
}
