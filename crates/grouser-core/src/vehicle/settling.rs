//! All wheels of a rover settled together: their sinkages, and the loads that depend on the forces
//! there.
//!
//! Load transfer makes a wheel's load depend on all wheels' forces, and those depend on the
//! sinkages. Both are sought at once. Each wheel's forces at the sinkages that were tried are a
//! curve over F_z; where the loads that balance the rover meet all these curves, the next sinkages
//! are tried:
//!
//! ```text
//! N_i = N_i(P, R)        (P, R) = (P, R)_weight + Σ (P, R)_i(N_i)        h_i = h_i(N_i)
//! ```
//!
//! with the moments (P, R) of [`load`]. The curves are polynomials through all points seen, over ln
//! F_z, so that two or three rounds find what settling wheels one by one under loads of the round
//! before finds in ten evaluations of each wheel. The wheels of a motion nearby give the place and
//! the slope with which a search begins.
//!
//! Only the usual case is here: all wheels stand, and F_z grows with the sinkage about as it does
//! for a shallow wheel. Elsewhere nothing is found, and [`reaction`](super::reaction) settles wheel
//! by wheel.

use nalgebra::{Matrix2, Matrix3, Vector3};

use super::load::{self, LoadSharing};
use super::on_ground::{OnGround, ReactionError, Stance, WheelReaction};
use super::parts::Mount;
use crate::contact::discrepancy::{self, Correction};
use crate::contact::equilibrium::{grows_as_usual, is_usual_step};
use crate::contact::load_sinkage::LoadSinkage;
use crate::contact::{Contact, Settled, Slip, WheelForces, WheelSoilModel, settle};
use crate::soil::Soil;
use crate::stored::stored;
use crate::terrain::Ground;
use crate::units::Vec2;
use crate::{elementary, lagrange};

/// The wheels of a motion nearby: where a search begins.
#[derive(Clone, Debug, Default)]
pub(crate) struct Nearby<'a> {
    /// The wheels in the motion nearby; empty where nothing is known.
    pub(crate) wheels: Vec<Known>,
    /// What they met, of the soil of which ground and for which steepness; and where that differs
    /// from wheel to wheel, of none.
    pub(super) contacts: Vec<Contact>,
    pub(super) soil: Option<(&'a Soil, f64)>,
}

/// What is known of all wheels from a motion nearby; nothing as yet by default.
#[derive(Clone, Debug, Default)]
pub struct KnownWheels {
    /// The wheels; empty where nothing is known.
    pub(super) wheels: Vec<WheelReaction>,
    /// What they met; of wheels that cannot be settled together, nothing.
    pub(super) known: Vec<Known>,
}

impl KnownWheels {
    /// Those of a motion whose wheels were settled in any way.
    #[must_use]
    pub fn of(ground: &OnGround<'_>, wheels: &[WheelReaction]) -> Self {
        let known = Known::of_all(ground, wheels).unwrap_or_default();
        Self { wheels: wheels.to_vec(), known }
    }
}

/// What is known of a wheel from a motion nearby.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Known {
    slip: Slip,
    place: Place,
    slope: Slope,
}

stored!(struct Known { slip, place, slope });

/// A sinkage that was tried, and the forces there.
#[derive(Clone, Copy, Debug, Default)]
struct Place {
    /// ln *h*.
    depth: f64,
    /// ln *F_z*.
    load: f64,
    forces: WheelForces,
    /// Moments that the loads balance, of this wheel's forces [N·m].
    moments: Vec2,
}

stored!(struct Place { depth, load, forces, moments });

/// How sinkage and forces change with ln F_z.
#[derive(Clone, Copy, Debug, Default)]
struct Slope {
    depth: f64,
    forces: WheelForces,
    moments: Vec2,
    /// Over how much of ln F_z that was seen.
    width: f64,
}

stored!(struct Slope { depth, forces, moments, width });

/// How exactly forces are sought, in ln F_z: what curves leave out where forces are smooth is below
/// the product of their distances from the points that they go through, and beside a kink below the
/// distance from the nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ForceAccuracy {
    product: f64,
    distance: f64,
}

impl ForceAccuracy {
    /// To rounding.
    pub(crate) const EXACT: Self = Self { product: 1e-13, distance: 1e-8 };

    /// To an error relative to the forces [-], which kinks may exceed; at the most to rounding.
    pub(crate) fn to(error: f64) -> Self {
        Self { product: error.max(Self::EXACT.product), distance: f64::INFINITY }
    }
}

/// Places nearer to each other than this tell nothing of a curve through both, and are the place
/// that is sought [ln F_z].
const APART: f64 = 1e-12;
/// Sinkages that are tried.
const MOST_ROUNDS: usize = 8;
/// Points that a curve goes through: a parabola.
const POINTS: usize = 3;

impl OnGround<'_> {
    /// The reaction on every wheel by a search for all of them at once; none where the usual search
    /// fails.
    ///
    /// * `near`: of a motion nearby, and of this one afterwards
    /// * `accuracy`: of the forces
    pub(super) fn settle_together(
        &self,
        stance: &Stance,
        contacts: &[Contact],
        near: &mut Vec<Known>,
        accuracy: ForceAccuracy,
    ) -> Option<Vec<WheelReaction>> {
        let sharing = Sharing::of(self, stance)?;
        if near.len() != contacts.len() {
            near.clear();
        }
        if near.is_empty() && contacts.iter().any(|it| self.model.load_sinkage(it).is_none()) {
            // Who does not know how a shallow wheel sinks has them settle under the weight first.
            let Self { rover, sharing: kind, own_moments, .. } = *self;
            let of_weight = load::moments(rover, stance.pull, kind, own_moments, &[]);
            let wheels = self.settle_under(stance, of_weight, contacts, &[]).ok()?;
            *near = Known::of_all(self, &wheels)?;
        }
        let mut curves = self.curves(contacts, near);
        let mut loads = vec![0.0; curves.len()];
        if near.is_empty() {
            let Self { rover, sharing: kind, own_moments, .. } = *self;
            sharing.at(load::moments(rover, stance.pull, kind, own_moments, &[]), &mut loads)?;
        } else {
            sharing.meet(&curves, &mut loads)?;
        }
        for _ in 0..MOST_ROUNDS {
            self.try_next(&mut curves, &loads)?;
            sharing.meet(&curves, &mut loads)?;
            if curves.iter().zip(&loads).all(|(curve, load)| curve.is_met(*load, accuracy)) {
                let each = curves.iter().zip(&loads).map(|(curve, load)| curve.reaction(*load));
                let (wheels, known) = each.unzip();
                *near = known;
                return Some(wheels);
            }
        }
        None
    }

    /// The reaction in a motion beside the one that is known, by one look at every wheel: to first
    /// order in how far it is, as differences need it. None where the other tells too little.
    pub(super) fn settle_beside(
        &self,
        stance: &Stance,
        contacts: &[Contact],
        near: &[Known],
    ) -> Option<Vec<WheelReaction>> {
        let is_known = near.len() == contacts.len() && near.iter().all(Known::has_slope);
        let sharing = is_known.then(|| Sharing::of(self, stance))??;
        let mut curves = self.curves(contacts, near);
        let mut loads = vec![0.0; curves.len()];
        sharing.meet(&curves, &mut loads)?;
        self.try_next(&mut curves, &loads)?;
        sharing.meet(&curves, &mut loads)?;
        Some(curves.iter().zip(&loads).map(|(curve, load)| curve.reaction(*load).0).collect())
    }

    /// The curves of all wheels, as far as a motion nearby tells.
    fn curves<'c>(&'c self, contacts: &'c [Contact], near: &[Known]) -> Vec<Curve<'c>> {
        let each = contacts.iter().enumerate();
        each.map(|(wheel, contact)| Curve::new(self.model, contact, near.get(wheel))).collect()
    }

    /// Tries the sinkage of each wheel at which it should carry its load [N].
    fn try_next(&self, curves: &mut [Curve<'_>], loads: &[f64]) -> Option<()> {
        let depths = curves.iter().zip(loads).map(|(curve, load)| curve.next_depth(*load));
        let depths: Vec<f64> = depths.collect::<Option<_>>()?;
        for ((curve, mount), depth) in curves.iter_mut().zip(self.rover.mounts()).zip(depths) {
            let forces = curve.forces(depth);
            let moments =
                load::moments_of(self.rover, mount, self.sharing, self.own_moments, &forces);
            curve.add(Place::at(depth, forces, moments)?)?;
        }
        Some(())
    }
}

impl Place {
    /// None where the soil carries nothing there.
    fn at(depth: f64, forces: WheelForces, moments: Vec2) -> Option<Self> {
        let is_carried = forces.normal_force >= f64::MIN_POSITIVE;
        let load = is_carried.then(|| elementary::ln(forces.normal_force))?;
        Some(Self { depth, load, forces, moments })
    }
}

/// How the weight is shared among wheels that all stand: linear in the moments.
struct Sharing {
    /// Parts of each wheel's load: the one without moments [N], and the one for each of the moments
    /// [1/m].
    loads: Vec<(f64, Vec2)>,
    /// Moments of the weight [N·m].
    of_weight: Vec2,
    /// The least moment that counts [N·m].
    least: f64,
    transfers: bool,
}

impl Sharing {
    /// None where wheels are in one line.
    fn of(ground: &OnGround<'_>, stance: &Stance) -> Option<Self> {
        let (rover, weight) = (ground.rover, stance.weight);
        let arms = rover.load_arms();
        let of_weight = load::moments_of_weight(rover, stance.pull, ground.sharing);
        let reach = arms.iter().map(Vec2::norm).fold(0.0, f64::max);
        let loads = if ground.sharing == LoadSharing::Uniform {
            vec![(weight / arms.len() as f64, Vec2::zeros()); arms.len()]
        } else {
            let row = |arm: &Vec2| Vector3::new(1.0, arm.x / reach, arm.y / reach);
            let rows: Matrix3<f64> = arms.iter().map(|arm| row(arm) * row(arm).transpose()).sum();
            let inverse = rows.try_inverse()?;
            let part = |arm: &Vec2| {
                let part = inverse * row(arm);
                (weight * part.x, Vec2::new(part.y, part.z) / reach)
            };
            arms.iter().map(part).collect()
        };
        /// Least moment that counts, over weight times reach [-]: the step after one of this size
        /// is below rounding.
        const LEAST: f64 = 1e-12;
        Some(Self {
            loads,
            of_weight,
            least: LEAST * weight * reach,
            transfers: ground.is_coupled(),
        })
    }

    /// Sets the loads [N] that balance these moments; none where a wheel would have to pull.
    fn at(&self, moments: Vec2, loads: &mut [f64]) -> Option<()> {
        for (load, (own, by_moments)) in loads.iter_mut().zip(&self.loads) {
            *load = own + by_moments.dot(&moments);
        }
        loads.iter().all(|load| *load > 0.0).then_some(())
    }

    /// Sets the loads [N] that balance the rover with the forces that the curves have under them.
    fn meet(&self, curves: &[Curve<'_>], loads: &mut [f64]) -> Option<()> {
        /// Newton's steps.
        const MOST_STEPS: usize = 8;
        if !self.transfers {
            return self.at(self.of_weight, loads);
        }
        let mut moments = self.of_weight + curves.iter().map(|it| it.last().moments).sum::<Vec2>();
        for _ in 0..MOST_STEPS {
            self.at(moments, loads)?;
            let mut miss = moments - self.of_weight;
            let mut tangent = Matrix2::identity();
            for ((curve, load), (_, by_moments)) in curves.iter().zip(&*loads).zip(&self.loads) {
                miss -= curve.moments_at(elementary::ln(*load));
                tangent -= curve.slope.moments * by_moments.transpose() / *load;
            }
            let step = tangent.try_inverse()? * miss;
            moments -= step;
            if step.norm() <= self.least {
                return self.at(moments, loads);
            }
        }
        None
    }
}

/// A wheel's sinkage and forces over ln F_z, as far as they are known.
pub(super) struct Curve<'a> {
    model: &'a dyn WheelSoilModel,
    contact: &'a Contact,
    relation: Option<LoadSinkage>,
    /// What the soil's discrepancy adds; sinkages in here are the model's own.
    correction: Option<Correction>,
    /// With which F_z grows for shallow sinkage.
    exponent: f64,
    /// ln r_s.
    axle: f64,
    /// The last sinkages tried, or the one of a motion nearby.
    places: [Place; POINTS],
    count: usize,
    slope: Slope,
    /// By how much the motion nearby differs [-].
    change: f64,
    evaluations: u32,
}

impl<'a> Curve<'a> {
    /// Starts the curve of a wheel whose model gives its shallow sinkage, or of which a motion
    /// nearby is known.
    pub(super) fn new(
        model: &'a dyn WheelSoilModel,
        contact: &'a Contact,
        known: Option<&Known>,
    ) -> Self {
        let relation = model.load_sinkage(contact);
        let exponent = relation.as_ref().map_or(USUAL_EXPONENT, LoadSinkage::exponent);
        let (place, slope, change) = match known {
            Some(known) => (known.place, known.slope, difference(&known.slip, &contact.slip)),
            None => (Place::default(), Slope::default(), f64::INFINITY),
        };
        let axle = elementary::ln(contact.wheel.shearing_radius());
        let places = [place; POINTS];
        Self {
            model,
            contact,
            relation,
            correction: Correction::of(contact),
            exponent,
            axle,
            places,
            count: 0,
            slope,
            change,
            evaluations: 0,
        }
    }

    /// The forces at a sinkage ln *h*.
    fn forces(&self, depth: f64) -> WheelForces {
        let sinkage = elementary::exp(depth);
        let own = match &self.relation {
            Some(relation) => relation.forces(self.contact, sinkage),
            None => self.model.forces(self.contact, sinkage),
        };
        self.correction.map_or(own, |correction| correction.forces(own))
    }

    /// The reaction under a load [N], and what is known of it for a motion nearby.
    pub(super) fn reaction(&self, load: f64) -> (WheelReaction, Known) {
        let place = self.at(elementary::ln(load));
        let (own, slip) = (elementary::exp(place.depth), self.contact.slip);
        let sinkage = self.correction.map_or(own, |correction| correction.sinkage(own));
        let settled = Settled { sinkage, forces: place.forces, evaluations: self.evaluations };
        (WheelReaction { slip, load, settled }, Known { slip, place, slope: self.slope })
    }

    /// The reaction without a load.
    pub(super) fn unloaded(&self) -> Option<WheelReaction> {
        let settled = settle(self.model, self.contact, 0.0).ok()?;
        Some(WheelReaction { slip: self.contact.slip, load: 0.0, settled })
    }

    /// Whether no place was tried.
    pub(super) fn is_new(&self) -> bool {
        self.count == 0
    }

    /// The place last tried, or the one of a motion nearby.
    fn last(&self) -> &Place {
        &self.places[self.count.saturating_sub(1)]
    }

    /// Whether a place is known, here or in a motion nearby.
    pub(super) fn is_known(&self) -> bool {
        self.count > 0 || self.change.is_finite()
    }

    /// The next sinkage to try for a load [N], ln *h*; none where the search leaves its usual way.
    fn next_depth(&self, load: f64) -> Option<f64> {
        if !self.is_known() {
            let (factor, power) = self.relation.as_ref()?.shallow();
            let depth = elementary::ln(load / factor) / power;
            return (depth < self.axle).then_some(depth);
        }
        let depth = self.depth_at(elementary::ln(load));
        is_usual_step(self.last().depth, depth, self.axle).then_some(depth)
    }

    /// Looks at the forces at the sinkage at which it should carry a load [N]; none where the search
    /// leaves its usual way.
    pub(super) fn look(&mut self, load: f64) -> Option<()> {
        let depth = self.next_depth(load)?;
        self.add(Place::at(depth, self.forces(depth), Vec2::zeros())?)
    }

    /// The forces under a load [N], and how they change with it [1/N].
    pub(super) fn under(&self, load: f64) -> (WheelForces, WheelForces) {
        (self.at(elementary::ln(load)).forces, self.slope.forces * (1.0 / load))
    }

    /// The sinkage under a load [N], and how it changes with it [m/N].
    pub(super) fn sinkage(&self, load: f64) -> (f64, f64) {
        let own = elementary::exp(self.depth_at(elementary::ln(load)));
        let sinkage = self.correction.map_or(own, |correction| correction.sinkage(own));
        (sinkage, sinkage * self.slope.depth / load)
    }

    /// Adds a place that was tried; none where F_z does not grow with the sinkage as it should.
    fn add(&mut self, place: Place) -> Option<()> {
        self.evaluations += 1;
        if self.count == 0 {
            if !self.change.is_finite() {
                self.slope = self.shallow_slope(&place);
            }
            (self.places[0], self.count) = (place, 1);
            return Some(());
        }
        let before = *self.last();
        let (rise, width) = (place.depth - before.depth, place.load - before.load);
        let is_usual = grows_as_usual(width / rise, self.exponent);
        let places = &self.places[..self.count];
        if !is_usual || places.iter().any(|known| (known.load - place.load).abs() < APART) {
            return None;
        }
        if self.count == POINTS {
            self.places.rotate_left(1);
        } else {
            self.count += 1;
        }
        self.places[self.count - 1] = place;
        /// A slope is seen over so much of ln F_z at least: rounding is a millionth of it.
        const LEAST_WIDTH: f64 = 1e-9;
        if width.abs() > LEAST_WIDTH {
            self.slope = self.slope_at(place.load);
        }
        Some(())
    }

    /// The slope of the curve at a load ln *F_z*, of two places or more.
    fn slope_at(&self, load: f64) -> Slope {
        let weights = self.slope_weights(load);
        let each = || self.places.iter().zip(weights);
        Slope {
            depth: each().map(|(place, weight)| weight * place.depth).sum(),
            forces: blended(self.places.iter().map(|place| &place.forces).zip(weights)),
            moments: each().map(|(place, weight)| weight * place.moments).sum(),
            width: self.far(load),
        }
    }

    /// Product of the distances from all places but the last [ln F_z].
    fn far(&self, load: f64) -> f64 {
        let others = self.places[..self.count - 1].iter();
        others.map(|place| (load - place.load).abs()).product()
    }

    /// The slope of a shallow wheel, whose forces all grow like its load.
    fn shallow_slope(&self, place: &Place) -> Slope {
        let depth = 1.0 / self.exponent;
        Slope { depth, forces: place.forces, moments: place.moments, width: f64::INFINITY }
    }

    /// Whether the curve under a load [N] is as exact as that.
    pub(super) fn is_met(&self, load: f64, accuracy: ForceAccuracy) -> bool {
        let load = elementary::ln(load);
        let near = (load - self.last().load).abs();
        let others =
            if self.count > 1 { self.far(load) } else { self.slope.width.max(self.change) };
        near <= APART || near <= accuracy.distance && near * others.max(near) <= accuracy.product
    }

    /// Weights of the places at a load ln *F_z*.
    fn weights(&self, load: f64) -> [f64; POINTS] {
        let loads = self.places.each_ref().map(|place| place.load);
        lagrange::weights(&loads[..self.count], load)
    }

    /// How fast these weights change [1/ln F_z].
    fn slope_weights(&self, load: f64) -> [f64; POINTS] {
        let mut weights = [0.0; POINTS];
        for (at, weight) in weights.iter_mut().enumerate().take(self.count) {
            let here = self.places[at].load;
            let others = || (0..self.count).filter(|other| *other != at);
            let span: f64 = others().map(|other| here - self.places[other].load).product();
            // The derivative of a product of one or two differences.
            let rate = match self.count {
                2 => 1.0,
                _ => others().map(|other| load - self.places[other].load).sum(),
            };
            *weight = rate / span;
        }
        weights
    }

    fn depth_at(&self, load: f64) -> f64 {
        if self.count < 2 {
            let last = self.last();
            return last.depth + self.slope.depth * (load - last.load);
        }
        self.places.iter().zip(self.weights(load)).map(|(place, weight)| weight * place.depth).sum()
    }

    fn moments_at(&self, load: f64) -> Vec2 {
        if self.count < 2 {
            let last = self.last();
            return last.moments + self.slope.moments * (load - last.load);
        }
        self.places
            .iter()
            .zip(self.weights(load))
            .map(|(place, weight)| weight * place.moments)
            .sum()
    }

    /// The place at which the curve has a load ln *F_z*.
    fn at(&self, load: f64) -> Place {
        let forces = if self.count < 2 {
            let last = self.last();
            blended([(&last.forces, 1.0), (&self.slope.forces, load - last.load)])
        } else {
            blended(self.places.iter().map(|place| &place.forces).zip(self.weights(load)))
        };
        Place { depth: self.depth_at(load), load, forces, moments: self.moments_at(load) }
    }
}

/// The exponent with which F_z of a model grows that does not tell it.
const USUAL_EXPONENT: f64 = 1.5;

/// By how much two motions differ [-].
fn difference(one: &Slip, other: &Slip) -> f64 {
    let apart = [
        one.ratio - other.ratio,
        one.angle - other.angle,
        one.forward - other.forward,
        one.lateral - other.lateral,
        one.sideways - other.sideways,
    ];
    apart.iter().fold(0.0, |most: f64, part| most.max(part.abs()))
}

/// Forces of several places by their weights.
fn blended<'a>(weighted: impl IntoIterator<Item = (&'a WheelForces, f64)>) -> WheelForces {
    let mut sum = WheelForces::default();
    for (forces, weight) in weighted {
        add_weighted(&mut sum, forces, weight);
    }
    sum
}

/// Adds weighted forces to others; their patches too.
pub(crate) fn add_weighted(sum: &mut WheelForces, forces: &WheelForces, weight: f64) {
    let (patch, more) = (sum.patch, forces.patch);
    *sum = *sum + *forces * weight;
    sum.patch.entry = patch.entry + weight * more.entry;
    sum.patch.exit = patch.exit + weight * more.exit;
    sum.patch.max_stress = patch.max_stress + weight * more.max_stress;
}

impl Nearby<'_> {
    /// The reaction on every wheel, and what is known of them for a motion nearby.
    ///
    /// * `accuracy`: of wheels that settle together
    /// * `alone`: the reaction of wheels that are settled one by one
    pub(super) fn settle(
        &mut self,
        ground: &OnGround<'_>,
        stance: &Stance,
        accuracy: ForceAccuracy,
        alone: impl FnOnce(&[Contact]) -> Result<Vec<WheelReaction>, ReactionError>,
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        let together = ground.settle_together(stance, &self.contacts, &mut self.wheels, accuracy);
        if let Some(wheels) = together {
            return Ok(wheels);
        }
        self.wheels.clear();
        let wheels = alone(&self.contacts)?;
        self.wheels = Known::of_all(ground, &wheels).unwrap_or_default();
        Ok(wheels)
    }
}

impl Nearby<'_> {
    /// The reaction on every wheel of a motion beside the one that is known; none where that does
    /// not tell it.
    pub(super) fn beside(
        &self,
        ground: &OnGround<'_>,
        stance: &Stance,
    ) -> Option<Vec<WheelReaction>> {
        ground.settle_beside(stance, &self.contacts, &self.wheels)
    }
}

impl Known {
    /// Returns what is known of wheels that were settled; none where one is not carried.
    pub(crate) fn of_all(ground: &OnGround<'_>, wheels: &[WheelReaction]) -> Option<Vec<Self>> {
        let each = wheels.iter().zip(ground.rover.mounts());
        each.map(|(wheel, mount)| Self::of(ground, mount, wheel)).collect()
    }

    /// What several motions of a wheel tell of one that they point to, by their weights, of which the
    /// last one is the nearest; none of none.
    pub(crate) fn blended<'k>(
        weighted: impl Iterator<Item = (&'k Self, f64)> + Clone,
    ) -> Option<Self> {
        let (nearest, _) = weighted.clone().last()?;
        let number =
            |of: fn(&Self) -> f64| weighted.clone().map(|(it, weight)| weight * of(it)).sum();
        let slip = Slip {
            ratio: number(|it| it.slip.ratio),
            angle: number(|it| it.slip.angle),
            forward: number(|it| it.slip.forward),
            lateral: number(|it| it.slip.lateral),
            ..nearest.slip
        };
        let place = Place {
            depth: number(|it| it.place.depth),
            load: number(|it| it.place.load),
            forces: blended(weighted.clone().map(|(it, weight)| (&it.place.forces, weight))),
            moments: weighted.map(|(it, weight)| weight * it.place.moments).sum(),
        };
        // Seen at another slip.
        let width = nearest.slope.width + difference(&nearest.slip, &slip);
        Some(Self { slip, place, slope: Slope { width, ..nearest.slope } })
    }

    /// Whether how forces change with the load was seen.
    pub(super) fn has_slope(&self) -> bool {
        self.slope.width.is_finite()
    }

    /// Returns what is known of a wheel; as yet its forces change with the load as those of a
    /// shallow one.
    pub(super) fn of(ground: &OnGround<'_>, mount: &Mount, wheel: &WheelReaction) -> Option<Self> {
        let forces = wheel.settled.forces;
        let OnGround { ground: Ground { soil, .. }, gravity, .. } = *ground;
        let contact = Contact { wheel: mount.unit.wheel, soil: *soil, slip: wheel.slip, gravity };
        let sinkage = discrepancy::own_sinkage(&contact, wheel.settled.sinkage);
        if sinkage <= 0.0 {
            return None;
        }
        let moments =
            load::moments_of(ground.rover, mount, ground.sharing, ground.own_moments, &forces);
        let place = Place::at(elementary::ln(sinkage), forces, moments)?;
        let slope = Slope { depth: 1.0 / USUAL_EXPONENT, forces, moments, width: f64::INFINITY };
        Some(Self { slip: wheel.slip, place, slope })
    }
}
