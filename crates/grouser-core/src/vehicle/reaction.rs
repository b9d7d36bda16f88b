//! All wheels settled under their share of the weight: load transfer and soil together.

use nalgebra::DVector;

use super::by_wheel::Differences;
use super::load;
use super::on_ground::{OnGround, ReactionError, Stance, WheelReaction, forces_of};
use super::ruts::Ruts;
use super::settling::{ForceAccuracy, Known, KnownWheels, Nearby};
use crate::contact::{Contact, Slip, WheelForces, settle_from, settle_many};
use crate::newton;
use crate::soil::Soil;
use crate::units::Vec2;

/// Agreement of the moments, over weight times reach [-], where rounds that come nearer go in
/// circles of the size to which sinkages are found.
const NEARLY_AGREED: f64 = 1e-9;

impl<'a> OnGround<'a> {
    /// The reaction on every wheel, in the mounts' order.
    ///
    /// Where the loads depend on the wheels' own torque or moments, loads and reactions are
    /// computed in turn until they agree. Wheels on rockers are loaded as these let them.
    ///
    /// # Errors
    /// [`ReactionError`] if the rover tips, a wheel sinks to its axle, or the turns do not agree.
    pub fn reactions(
        &self,
        stance: &Stance,
        slips: &[Slip],
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        self.reactions_near(stance, slips, &[])
    }

    /// Does what [`reactions`](Self::reactions) does, from the reactions in a stance and a motion
    /// nearby: loads and sinkages are sought from there. The answer is the same but for its last
    /// digits, as that of [`settle_from`], and where several sinkages carry a load, as in some
    /// cohesive soils, what is near may decide which is found.
    ///
    /// * `near`: of all wheels, or of none
    ///
    /// # Errors
    /// The same as [`reactions`](Self::reactions).
    pub fn reactions_near(
        &self,
        stance: &Stance,
        slips: &[Slip],
        near: &[WheelReaction],
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        if self.rover.suspension().is_some() {
            return self.reactions_on_links(stance, slips, near);
        }
        let mut contacts = Vec::with_capacity(slips.len());
        self.meet(stance, slips, &mut contacts);
        if self.is_coupled()
            && let Some(mut known) = Known::of_all(self, near)
            && let Some(wheels) =
                self.settle_together(stance, &contacts, &mut known, ForceAccuracy::EXACT)
        {
            return Ok(wheels);
        }
        self.settle_in_turns(stance, &contacts, near)
    }

    /// Does what [`reactions_near`](Self::reactions_near) does, by what is known of a motion nearby,
    /// forces' slopes too, which spares a search one look at every wheel in two or three; this motion
    /// is known afterwards.
    ///
    /// # Errors
    /// The same as [`reactions`](Self::reactions).
    pub fn reactions_by(
        &self,
        stance: &Stance,
        slips: &[Slip],
        near: &mut KnownWheels,
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        let wheels = if self.rover.suspension().is_none() && self.is_coupled() {
            let mut contacts = Vec::with_capacity(slips.len());
            self.meet(stance, slips, &mut contacts);
            let known = &mut near.known;
            let together = self.settle_together(stance, &contacts, known, ForceAccuracy::EXACT);
            if let Some(wheels) = together {
                wheels
            } else {
                let wheels = self.settle_in_turns(stance, &contacts, &near.wheels)?;
                near.known = Known::of_all(self, &wheels).unwrap_or_default();
                wheels
            }
        } else {
            self.reactions_near(stance, slips, &near.wheels)?
        };
        near.wheels.clone_from(&wheels);
        Ok(wheels)
    }

    /// The reaction on every wheel, loads and wheels in turn.
    fn settle_in_turns(
        &self,
        stance: &Stance,
        contacts: &[Contact],
        near: &[WheelReaction],
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        let Self { rover, sharing, own_moments, .. } = *self;
        if !self.is_coupled() {
            let moments = load::moments(rover, stance.pull, sharing, own_moments, &[]);
            return self.settle_under(stance, moments, contacts, near);
        }
        let reach = rover.load_arms().iter().map(Vec2::norm).fold(0.0, f64::max);
        let scale = rover.mass() * self.gravity * reach;
        let in_turns = self.settle_by_rounds(stance, contacts, near, scale);
        in_turns.or_else(|error| match error {
            ReactionError::Unsettled { .. } => {
                self.settle_by_damped_steps(stance, contacts, scale).ok_or(error)
            }
            ReactionError::Tipping(_) => self.settle_rocking(stance, contacts, scale, error),
            error => Err(error),
        })
    }

    /// The reaction on every wheel of a rover that stands firmly, and that its own acceleration
    /// would tip over: wheels whose speed is set anew pull with all their friction for the
    /// hundredths of a second until the ground moves below them with that speed. In that time a
    /// rover turns by far less than it takes to fall: its weight acts on the edge that it would
    /// tip over, and what is left of the moments rocks it.
    ///
    /// * `scale`: weight times reach [N·m]
    /// * `tipping`: of a rover that does not stand firmly, or whose loads are not found
    ///
    /// # Errors
    /// That, or [`ReactionError::Wheel`] for a wheel that sinks to its axle under what it carries on
    /// the edge.
    fn settle_rocking(
        &self,
        stance: &Stance,
        contacts: &[Contact],
        scale: f64,
        tipping: ReactionError,
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        /// How far within its wheels a rover stands firmly, over its reach [-]: farther than forces
        /// that move it steadily shift where its weight acts.
        const FIRMLY: f64 = 0.2;
        /// By how much the weight acts within the edge, over how far it does at rest [-].
        const WITHIN: f64 = 1e-6;
        const MOST_ROUNDS: u32 = 100;
        let Self { rover, sharing, own_moments, .. } = *self;
        let (polygon, weight) = (rover.support_polygon(), stance.weight);
        let at_rest = rover.centre_height() * stance.pull / weight;
        let reach = scale / (rover.mass() * self.gravity);
        if polygon.margin(at_rest) < FIRMLY * reach {
            return Err(tipping);
        }
        let onto = |moments: Vec2| {
            let foot = moments / weight;
            let edge = polygon.nearest(foot);
            if edge == foot { moments } else { edge.lerp(&at_rest, WITHIN) * weight }
        };
        let mut moments = onto(load::moments(rover, stance.pull, sharing, own_moments, &[]));
        let mut wheels: Vec<WheelReaction> = Vec::new();
        for _ in 0..MOST_ROUNDS {
            wheels = self.settle_under(stance, moments, contacts, &wheels)?;
            let forces: Vec<WheelForces> = forces_of(&wheels).copied().collect();
            let next = onto(load::moments(rover, stance.pull, sharing, own_moments, &forces));
            if (next - moments).norm() <= NEARLY_AGREED * scale {
                return Ok(wheels);
            }
            // Half of the way: rounds that overshoot close in, too.
            moments = moments.lerp(&next, 0.5);
        }
        Err(tipping)
    }

    /// The reaction on every wheel, by rounds of loads and of the forces under them.
    ///
    /// * `scale`: weight times reach [N·m]
    fn settle_by_rounds(
        &self,
        stance: &Stance,
        contacts: &[Contact],
        near: &[WheelReaction],
        scale: f64,
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        let Self { rover, sharing, own_moments, .. } = *self;
        const MOST_ROUNDS: u32 = 60;
        /// Agreement of the moments, over weight times reach [-]: well under the integrator's.
        const AGREED: f64 = 1e-11;
        let forces: Vec<WheelForces> = forces_of(near).copied().collect();
        let mut moments = load::moments(rover, stance.pull, sharing, own_moments, &forces);
        let mut wheels = self.settle_under(stance, moments, contacts, near)?;
        let mut change = f64::INFINITY;
        let mut mixing = Mixing::default();
        for _ in 0..MOST_ROUNDS {
            let forces: Vec<WheelForces> = forces_of(&wheels).copied().collect();
            let next = load::moments(rover, stance.pull, sharing, own_moments, &forces);
            change = (next - moments).norm() / scale;
            if change <= AGREED {
                return Ok(wheels);
            }
            let mixed = mixing.next(moments, next);
            // A point that the secants lead to may not exist where the one after this round does.
            (moments, wheels) = match self.settle_under(stance, mixed, contacts, &wheels) {
                Ok(settled) => (mixed, settled),
                Err(_) => (next, self.settle_under(stance, next, contacts, &wheels)?),
            };
        }
        if change <= NEARLY_AGREED {
            return Ok(wheels);
        }
        let forces: Vec<WheelForces> = forces_of(&wheels).copied().collect();
        let next = load::moments(rover, stance.pull, sharing, own_moments, &forces);
        // Where the weight then falls outside the wheels, the heaviest one loses most.
        let loads = load::wheel_loads(rover, sharing, stance.weight, next)
            .unwrap_or_else(|_| vec![0.0; wheels.len()]);
        let changes = loads.iter().zip(&wheels).map(|(load, wheel)| load - wheel.load);
        let most = DVector::from_iterator(wheels.len(), changes).iamax();
        let wheel = rover.mounts()[most].name.clone();
        Err(ReactionError::Unsettled { wheel, rounds: MOST_ROUNDS, change })
    }

    /// The reaction on every wheel, the moments sought by Newton's steps, damped, where turns go
    /// round in circles.
    ///
    /// * `scale`: weight times reach [N·m]
    fn settle_by_damped_steps(
        &self,
        stance: &Stance,
        contacts: &[Contact],
        scale: f64,
    ) -> Option<Vec<WheelReaction>> {
        let Self { rover, sharing, own_moments, .. } = *self;
        let of = |wheels: &[WheelReaction]| {
            let forces: Vec<WheelForces> = forces_of(wheels).copied().collect();
            load::moments(rover, stance.pull, sharing, own_moments, &forces)
        };
        let miss = |moments: &DVector<f64>| {
            let moments = Vec2::new(moments[0], moments[1]);
            let wheels = self.settle_under(stance, moments, contacts, &[]).ok()?;
            let off = moments - of(&wheels);
            Some((DVector::from_row_slice(off.as_slice()), wheels))
        };
        /// How far from the middle towards each wheel the weight is taken to act [-], where steps
        /// from the wheels that only stand end in a corner.
        const TOWARDS_WHEELS: [f64; 2] = [0.5, 0.9];
        let towards = TOWARDS_WHEELS.iter().flat_map(|share| {
            rover.load_arms().iter().map(move |arm| *share * stance.weight * *arm)
        });
        std::iter::once(of(&[])).chain(towards).find_map(|guess| {
            let guess = DVector::from_row_slice(guess.as_slice());
            newton::damped_zero(miss, &guess, scale, NEARLY_AGREED * scale)
                .map(|(_, wheels)| wheels)
        })
    }

    /// Does what [`reactions`](Self::reactions) does, by what is known of a motion nearby; this
    /// motion is known afterwards.
    pub(crate) fn reactions_after(
        &self,
        stance: &Stance,
        slips: &[Slip],
        near: &mut Nearby<'a>,
        accuracy: ForceAccuracy,
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        self.meet_near(stance, slips, near);
        let alone = |contacts: &[Contact]| self.settle_in_turns(stance, contacts, &[]);
        near.settle(self, stance, accuracy, alone)
    }

    /// Does the same for a motion beside the one that is known, which stays known: to first order in
    /// how far it is, by one look at every wheel.
    pub(crate) fn reactions_beside(
        &self,
        stance: &Stance,
        slips: &[Slip],
        near: &mut Nearby<'a>,
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        self.meet_near(stance, slips, near);
        let beside = near.beside(self, stance);
        let anew = || self.reactions_after(stance, slips, near, ForceAccuracy::EXACT);
        beside.map_or_else(anew, Ok)
    }

    /// What each wheel meets, kept with what is known of a motion nearby.
    fn meet_near(&self, stance: &Stance, slips: &[Slip], near: &mut Nearby<'a>) {
        let soil = self.only_soil().map(|soil| (soil, stance.steepness));
        let is_same = matches!((soil, near.soil), (Some((one, steepness)), Some((other, before)))
            if std::ptr::eq(one, other) && steepness == before);
        if is_same && near.contacts.len() == slips.len() {
            for (contact, slip) in near.contacts.iter_mut().zip(slips) {
                contact.slip = *slip;
            }
        } else {
            self.meet(stance, slips, &mut near.contacts);
            near.soil = soil;
        }
    }

    /// The soil under all wheels, where the ground has one in all places and no wheel changes it.
    fn only_soil(&self) -> Option<&'a Soil> {
        let Differences { by_wheel, by_place, ruts } = self.differences;
        if by_wheel.is_some() || by_place.is_some() || ruts != Ruts::Fresh {
            return None;
        }
        Some(&self.ground.soil)
    }

    /// What each wheel meets.
    fn meet(&self, stance: &Stance, slips: &[Slip], contacts: &mut Vec<Contact>) {
        let Self { rover, ground, gravity, ref differences, .. } = *self;
        let Stance { place, slope_from_body, steepness, .. } = *stance;
        let ruts = differences.ruts.of_wheels(rover, slips);
        contacts.clear();
        for (wheel, (&slip, mount)) in slips.iter().zip(rover.mounts()).enumerate() {
            let at = place + slope_from_body * mount.position.xy();
            let soil = ground.soil_under(at, mount.footprint(&slope_from_body));
            let rut = ruts.as_ref().map(|ruts| ruts[wheel]);
            let soil = differences.soil_on(steepness, wheel, at, rut, &soil);
            contacts.push(Contact { wheel: mount.unit.wheel, soil, slip, gravity });
        }
    }

    /// * `before`: the wheels in the round before, near which they settle now, or none
    pub(super) fn settle_under(
        &self,
        stance: &Stance,
        moments: Vec2,
        contacts: &[Contact],
        before: &[WheelReaction],
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        let loads = load::wheel_loads(self.rover, self.sharing, stance.weight, moments)?;
        let loaded: Vec<(Contact, f64)> = contacts.iter().copied().zip(loads).collect();
        let settled = if before.is_empty() {
            settle_many(self.model, &loaded)
        } else {
            let each = loaded.iter().zip(before);
            let near = |((contact, load), near): (&(Contact, f64), &WheelReaction)| {
                settle_from(self.model, contact, *load, near.settled.sinkage)
            };
            each.map(near).collect()
        };
        let each = settled.into_iter().zip(loaded).zip(self.rover.mounts());
        each.map(|((settled, (contact, load)), mount)| match settled {
            Ok(settled) => Ok(WheelReaction { slip: contact.slip, load, settled }),
            Err(source) => Err(ReactionError::Wheel { wheel: mount.name.clone(), source }),
        })
        .collect()
    }
}

/// Rounds of a fixed point, each of which starts where the last two point to.
///
/// The moments that follow from moments are nearly a linear function of them. Of two rounds before
/// this one the secants tell where it ends (Anderson 1965, with as many rounds as there are
/// moments); rounds that tell nothing of a direction leave it as it is.
#[derive(Default)]
struct Mixing {
    /// The changes of a round, and what came out of it: the last first.
    before: Vec<(Vec2, Vec2)>,
}

impl Mixing {
    /// Where the next round starts.
    fn next(&mut self, moments: Vec2, found: Vec2) -> Vec2 {
        /// Secants whose directions differ less than this tell of one only [-].
        const PARALLEL: f64 = 1e-6;
        let change = found - moments;
        let secant = |one: (Vec2, Vec2), other: (Vec2, Vec2)| (one.0 - other.0, one.1 - other.1);
        let mixed = match self.before[..] {
            [last, ..] if change.norm() >= last.0.norm() => found,
            [last, first] => {
                let (here, there) = (secant((change, found), last), secant(last, first));
                let across = here.0.perp(&there.0);
                if across.abs() <= PARALLEL * here.0.norm() * there.0.norm() {
                    along_one(change, found, here)
                } else {
                    let shares = (change.perp(&there.0) / across, here.0.perp(&change) / across);
                    found - here.1 * shares.0 - there.1 * shares.1
                }
            }
            [last] => along_one(change, found, secant((change, found), last)),
            _ => found,
        };
        self.before.insert(0, (change, found));
        self.before.truncate(2);
        mixed
    }
}

/// What is found, less what one secant explains of the change.
fn along_one(change: Vec2, found: Vec2, secant: (Vec2, Vec2)) -> Vec2 {
    let size = secant.0.norm_squared();
    if size == 0.0 { found } else { found - secant.1 * (secant.0.dot(&change) / size) }
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix2;

    use super::*;

    /// A linear map is at its fixed point after three rounds, however slowly plain rounds close in.
    #[test]
    fn mixing_solves_a_linear_map_in_three_rounds() {
        let map = Matrix2::new(0.7, 0.3, -0.2, -0.5);
        let offset = Vec2::new(1.0, -2.0);
        let fixed = (Matrix2::identity() - map).try_inverse().expect("it has one") * offset;
        let mut mixing = Mixing::default();
        let mut moments = Vec2::new(5.0, 3.0);
        for _ in 0..3 {
            moments = mixing.next(moments, map * moments + offset);
        }
        assert!((moments - fixed).norm() < 1e-12, "{moments} and {fixed}");
    }
}
