//! Many wheels at once: those whose forces come from the same formulas, as lanes of a vector.

#![expect(
    clippy::inline_always,
    reason = "what the kernel runs is compiled once for each instruction set"
)]

use super::bulldozing::WallResistance;
use super::discrepancy;
use super::forces::WheelForces;
use super::inputs::Contact;
use super::kernel::dispatch::Work;
use super::kernel::rule::Nodes;
use super::kernel::wheels::{self, Reactions, Walls, Wheels};
use super::lanes::{Each, WIDE, each};
use super::load_sinkage::{Arc, LoadSinkage};
use super::model::WheelSoilModel;
use super::stress::MobilisedShear;
use super::stress::wheels::StressLaws;

/// Fewer wheels of a kind than this are computed one by one: that takes less than lanes, most of
/// which stay empty. Source: measured.
pub(super) const FEWEST: usize = 12;

/// Wheels of the same kind go through the same formulas.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Kind {
    shear: u8,
    has_pieces: bool,
    blocks: usize,
    set: u8,
}

impl Kind {
    pub(super) fn of(arc: &Arc) -> Self {
        let shear = match arc.law.shear_law() {
            MobilisedShear::Anisotropic(_) => 0,
            MobilisedShear::Bounded(_) => 1,
            MobilisedShear::Isotropic(_) => 2,
        };
        // Rules with as many blocks of nodes of the same form are the same.
        let (has_pieces, blocks) = match arc.nodes() {
            Nodes::BothSides(blocks) => (false, blocks.len()),
            Nodes::Pieces(rule) => (true, rule.blocks()),
        };
        Self { shear, has_pieces, blocks, set: arc.set as u8 }
    }
}

/// Wheels that wait for others of their kind.
pub(super) struct Groups<T> {
    most: usize,
    groups: Vec<(Kind, Vec<T>)>,
}

impl<T> Groups<T> {
    /// * `most`: of a group
    pub(super) fn new(most: usize) -> Self {
        Self { most, groups: Vec::new() }
    }

    /// Puts a wheel into its group, which is returned, to be emptied, when it is full.
    pub(super) fn add(&mut self, kind: Kind, wheel: T) -> Option<&mut Vec<T>> {
        let known = self.groups.iter().position(|(other, _)| *other == kind);
        let known = known.unwrap_or_else(|| {
            self.groups.push((kind, Vec::with_capacity(self.most)));
            self.groups.len() - 1
        });
        let group = &mut self.groups[known].1;
        group.push(wheel);
        (group.len() == self.most).then_some(group)
    }

    /// The groups as they are.
    pub(super) fn rest(self) -> impl Iterator<Item = Vec<T>> {
        self.groups.into_iter().map(|(_, group)| group)
    }
}

/// Some wheels of one kind in the lanes of a vector.
pub(super) struct Lanes {
    pub(super) laws: StressLaws,
    /// r_s b [m²].
    pub(super) areas: Each,
    nodes: Nodes,
    walls: Walls,
}

impl Lanes {
    /// * `wheel`: that of each lane, with its only arc
    pub(super) fn of<'a>(wheel: impl Fn(usize) -> (&'a Contact, &'a LoadSinkage, &'a Arc)) -> Self {
        let wheels: [_; WIDE] = std::array::from_fn(wheel);
        Self {
            laws: StressLaws::of(&wheels.map(|(_, _, arc)| &arc.law)),
            areas: wheels.map(|(_, relation, _)| relation.area()),
            nodes: wheels[0].2.nodes(),
            walls: Walls::of(|lane| WallResistance::of(wheels[lane].0)),
        }
    }

    /// ∫ (τ_x sin θ + σ cos θ) dθ of each wheel [Pa·rad], and all that the kernel computes of them
    /// where there is room for it.
    ///
    /// * `sinkages`: of the wheels [m]
    #[inline(always)]
    pub(super) fn reactions(&self, sinkages: &Each, all: Option<&mut Reactions>) -> Each {
        let wheels = Wheels { laws: &self.laws, sinkages, nodes: self.nodes };
        wheels::reactions(&wheels, all.map(|all| (&self.walls, all)))
    }
}

/// The reaction of the soil on many wheels, each at a sinkage [m], in their order; each has the
/// bits that it has alone. Where the soil has a [`Discrepancy`](crate::soil::Discrepancy) they are
/// those with it, at the sinkage with it: a settled wheel's own.
///
/// How much harder does a wheel pull the more it slips, at the same sinkage?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::contact::{Contact, Ishigami, Slip, forces_many};
/// use grouser_core::units::{EARTH_GRAVITY, mm};
///
/// let (wheel, soil, gravity) = (paper::hakuto_wheel(), paper::toyoura(), EARTH_GRAVITY);
/// let sunk = [0.1, 0.2, 0.4].map(|ratio| {
///     (Contact { wheel, soil, slip: Slip::on_test_stand(ratio, 0.0), gravity }, mm(13.0))
/// });
/// let forces = forces_many(&Ishigami::DEFAULT, &sunk);
/// let pulls: Vec<String> = forces.iter().map(|it| format!("{:.1} N", it.drawbar_pull)).collect();
/// assert_eq!(pulls, ["0.7 N", "1.8 N", "3.3 N"]);
/// ```
pub fn forces_many(model: &dyn WheelSoilModel, wheels: &[(Contact, f64)]) -> Vec<WheelForces> {
    if wheels.iter().all(|(contact, _)| contact.soil.discrepancy.is_none()) {
        return own_forces_many(model, wheels);
    }
    let own = |(contact, sinkage): &(Contact, f64)| {
        (*contact, discrepancy::own_sinkage(contact, *sinkage))
    };
    let found = own_forces_many(model, &wheels.iter().map(own).collect::<Vec<_>>());
    let pairs = wheels.iter().zip(found);
    pairs.map(|((contact, _), forces)| discrepancy::corrected(contact, forces)).collect()
}

/// The same by the model alone.
pub(super) fn own_forces_many(
    model: &dyn WheelSoilModel,
    wheels: &[(Contact, f64)],
) -> Vec<WheelForces> {
    if wheels.len() < FEWEST {
        return wheels.iter().map(|(contact, sinkage)| model.forces(contact, *sinkage)).collect();
    }
    let mut results = vec![WheelForces::default(); wheels.len()];
    let mut groups = Groups::new(WIDE);
    for (place, (contact, sinkage)) in wheels.iter().enumerate() {
        let relation = model.load_sinkage(contact);
        let kind = relation.as_ref().and_then(LoadSinkage::only_arc).map(Kind::of);
        let (Some(relation), Some(kind), true) = (relation, kind, *sinkage > 0.0) else {
            results[place] = model.forces(contact, *sinkage);
            continue;
        };
        if let Some(full) = groups.add(kind, Sunk { place, contact, relation, sinkage: *sinkage }) {
            finish(full, &mut results);
        }
    }
    groups.rest().for_each(|mut group| finish(&mut group, &mut results));
    results
}

/// A wheel at a sinkage [m], and its place among the results.
struct Sunk<'a> {
    place: usize,
    contact: &'a Contact,
    relation: LoadSinkage,
    sinkage: f64,
}

/// Computes the wheels of a group, of which there are no more than lanes, and empties it.
fn finish(group: &mut Vec<Sunk<'_>>, results: &mut [WheelForces]) {
    if group.len() < FEWEST {
        for Sunk { place, contact, relation, sinkage } in group.drain(..) {
            results[place] = relation.forces(contact, sinkage);
        }
        return;
    }
    let of = |lane: usize| &group[lane.min(group.len() - 1)];
    let arc =
        |lane: usize| of(lane).relation.only_arc().expect("wheels with two are not among them");
    let lanes = Lanes::of(|lane| (of(lane).contact, &of(lane).relation, arc(lane)));
    let sinkages = each(|lane| of(lane).sinkage);
    let mut reactions = Reactions::default();
    arc(0).set.run(AtOnce { lanes: &lanes, sinkages: &sinkages, reactions: &mut reactions });
    for (lane, Sunk { place, contact, relation, sinkage }) in group.drain(..).enumerate() {
        results[place] = relation.finished(contact, &reactions.of(lane), sinkage);
    }
}

/// All forces at given sinkages [m].
struct AtOnce<'a> {
    lanes: &'a Lanes,
    sinkages: &'a Each,
    reactions: &'a mut Reactions,
}

impl Work for AtOnce<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let _ = self.lanes.reactions(self.sinkages, Some(self.reactions));
    }
}
