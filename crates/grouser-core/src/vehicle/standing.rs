//! The reaction on a rover that stands on uneven ground, or on a suspension.
//!
//! Its posture follows from the ground as if that were firm, as on a plane: what wheels sink
//! changes no lever. Loads and reactions are sought together, N = N(forces(N)), by Newton's method
//! with Broyden's updates from the loads of wheels that only stand, or from those of a motion
//! nearby; usually by `together`, which looks at each wheel as it settles.

mod together;

use std::cell::{Cell, RefCell};

use nalgebra::{DMatrix, DVector, Dyn};

use super::load::Tipping;
use super::on_ground::{OnGround, ReactionError, Stance, WheelReaction, forces_of};
use super::posture::{OF_BODY, Posture, StandingMotion};
use super::settling::ForceAccuracy;
use super::several_soils::Met;
use super::state::RoverState;
use super::statics::{Balance, Resultant};
use crate::contact::{Contact, LoadedWheel, Settled, Slip, WheelForces, settle_each};
use crate::elementary::wide::atan2;
use crate::newton::{self, Zero};
use crate::root;
use crate::soil::Soil;
use crate::terrain::{Footprint, Patch, Share, Terrain};
use crate::units::{Vec2, Vec3};
pub(crate) use together::KnownStanding;

/// The plane of the slope frame: level in it.
struct Flat;

impl Terrain for Flat {
    fn patch(&self, _: Vec2, _: Footprint) -> Patch {
        Patch { height: 0.0, normal: Vec3::z() }
    }
}

/// A rover on its ground, standing and in motion.
#[derive(Clone, Debug)]
pub struct Standing {
    /// How it stands.
    pub posture: Posture,
    /// How it moves.
    pub motion: StandingMotion,
    /// Against gravity, in the ground's coordinates.
    pub up: Vec3,
}

impl Standing {
    /// The weight's pull along the body's x and y axes [N].
    ///
    /// * `weight`: m g [N]
    #[must_use]
    pub fn pull(&self, weight: f64) -> Vec2 {
        let [x, y, _] = self.posture.axes();
        -weight * Vec2::new(x.dot(&self.up), y.dot(&self.up))
    }
}

impl OnGround<'_> {
    /// Whether wheels have pieces of ground of their own, or links that carry them.
    #[must_use]
    pub fn is_uneven(&self) -> bool {
        !self.ground.is_plane() || self.rover.suspension().is_some()
    }

    /// How the rover stands in a state, with its wheels sunk.
    ///
    /// # Errors
    /// [`ReactionError`] beyond the known ground, and where the wheels do not come to stand.
    pub fn posture(&self, state: &RoverState, sinkages: &[f64]) -> Result<Posture, ReactionError> {
        self.posture_near(state, sinkages, None)
    }

    /// The same, sought from a posture nearby, if one is known.
    ///
    /// # Errors
    /// The same as [`posture`](Self::posture).
    pub fn posture_near(
        &self,
        state: &RoverState,
        sinkages: &[f64],
        near: Option<&Posture>,
    ) -> Result<Posture, ReactionError> {
        let terrain: &dyn Terrain = if self.ground.is_plane() { &Flat } else { self.ground };
        let (place, yaw) = (state.position, state.yaw);
        let posture = match near {
            Some(near) => near.near(self.rover, terrain, place, yaw, sinkages)?,
            None => Posture::of(self.rover, terrain, place, yaw, sinkages)?,
        };
        for (wheel, mount) in posture.wheels.iter().zip(self.rover.mounts()) {
            if !terrain.covers(wheel.at, wheel.footprint) {
                let place = self.ground.start + wheel.at;
                return Err(ReactionError::OffTheMap { wheel: mount.name.clone(), place });
            }
        }
        Ok(posture)
    }

    /// How the rover stands in a state on ground that is firm.
    ///
    /// # Errors
    /// The same as [`posture`](Self::posture).
    pub fn standing_posture(&self, state: &RoverState) -> Result<Posture, ReactionError> {
        self.posture(state, &vec![0.0; self.rover.wheel_count()])
    }

    /// How the rover moves that stands so in a state.
    ///
    /// * `held_yaw_rate`: how fast the yaw, seen from above, is made to change, if it is [rad/s];
    ///   then the body turns as fast as that takes, whatever the state says
    ///
    /// # Errors
    /// [`ReactionError`] where its wheels allow no motion along the ground.
    pub fn moving(
        &self,
        posture: Posture,
        state: &RoverState,
        held_yaw_rate: Option<f64>,
    ) -> Result<Standing, ReactionError> {
        let motion = match held_yaw_rate {
            None => posture.motion(state)?,
            Some(rate) => posture.motion_at_yaw_rate(state, rate)?,
        };
        Ok(Standing { posture, motion, up: self.up(state) })
    }

    /// Against gravity, in the ground's coordinates: on a plane, those of the slope.
    pub(crate) fn up(&self, state: &RoverState) -> Vec3 {
        self.ground.lie(state.position, self.rover.footprint(&state.slope_from_body())).0.up
    }

    /// The reaction on every wheel of a rover that stands so, in the mounts' order.
    ///
    /// * `up`: against gravity, in the ground's coordinates
    /// * `near`: of all wheels in a motion nearby, or of none
    ///
    /// # Errors
    /// [`ReactionError`] if the rover tips, a wheel sinks to its axle, or loads and reactions do
    /// not agree.
    pub fn reactions_standing(
        &self,
        posture: &Posture,
        up: Vec3,
        slips: &[Slip],
        near: &[WheelReaction],
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        let mut near = NearbyStanding { wheels: near.to_vec(), ..NearbyStanding::default() };
        self.reactions_standing_after(posture, up, slips, &mut near, ForceAccuracy::EXACT)
    }

    /// The same by what is known of a motion nearby; this one is known afterwards.
    ///
    /// # Errors
    /// The same as [`reactions_standing`](Self::reactions_standing).
    pub(crate) fn reactions_standing_after(
        &self,
        posture: &Posture,
        up: Vec3,
        slips: &[Slip],
        near: &mut NearbyStanding,
        accuracy: ForceAccuracy,
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        let sought = self.sought(posture, up, slips, &near.wheels);
        let wheels = if let Some(wheels) = sought.together(&mut near.known, accuracy) {
            near.inverse = None;
            wheels
        } else {
            let wheels = sought.in_turns(near)?;
            near.known = sought.known_of(&wheels).unwrap_or_default();
            wheels
        };
        near.wheels.clone_from(&wheels);
        Ok(wheels)
    }

    /// The reaction in a motion beside the one that is known, by one look at every wheel: to first
    /// order in how far it is. The other stays known, unless it tells too little.
    ///
    /// # Errors
    /// The same as [`reactions_standing`](Self::reactions_standing).
    pub(crate) fn reactions_standing_beside(
        &self,
        posture: &Posture,
        up: Vec3,
        slips: &[Slip],
        near: &mut NearbyStanding,
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        let beside = self.sought(posture, up, slips, &[]).beside(&near.known);
        let anew = || self.reactions_standing_after(posture, up, slips, near, ForceAccuracy::EXACT);
        beside.map_or_else(anew, Ok)
    }

    /// * `before`: the wheels in a motion nearby, or none
    pub(crate) fn sought<'a>(
        &'a self,
        posture: &'a Posture,
        up: Vec3,
        slips: &[Slip],
        before: &[WheelReaction],
    ) -> Sought<'a> {
        let sinkages = RefCell::new(before.iter().map(|wheel| wheel.settled.sinkage).collect());
        let weight = self.rover.mass() * self.gravity * up;
        Sought { ground: self, posture, met: self.met(posture, slips), weight, sinkages }
    }

    /// The same of a rover on a suspension on a plane.
    ///
    /// # Errors
    /// The same as [`reactions_standing`](Self::reactions_standing).
    pub(super) fn reactions_on_links(
        &self,
        stance: &Stance,
        slips: &[Slip],
        near: &[WheelReaction],
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        let turn = stance.slope_from_body;
        let yaw = atan2(turn[(1, 0)], turn[(0, 0)]);
        let state = RoverState { position: stance.place, yaw, ..RoverState::default() };
        let posture = self.standing_posture(&state)?;
        self.reactions_standing(&posture, self.up(&state), slips, near)
    }

    /// The soil's forces together, of wheels that stand.
    #[must_use]
    pub fn resultant(&self, standing: &Standing, wheels: &[WheelReaction]) -> Resultant {
        let forces: Vec<WheelForces> = forces_of(wheels).copied().collect();
        self.balance().resultant(self.rover, &standing.posture, &forces)
    }

    fn balance(&self) -> Balance {
        Balance { sharing: self.sharing, own_moments: self.own_moments }
    }

    /// What each wheel meets.
    fn met(&self, posture: &Posture, slips: &[Slip]) -> Vec<Met> {
        let Self { rover, ground, gravity, ref differences, .. } = *self;
        let ruts = differences.ruts.of_wheels(rover, slips);
        let each = posture.wheels.iter().zip(rover.mounts()).zip(slips).enumerate();
        each.map(|(number, ((standing, mount), slip))| {
            let own = ground.soil_under(standing.at, standing.footprint);
            let normal = standing.normal;
            let steepness = normal.xy().norm() / normal.z;
            let rut = ruts.as_ref().map(|ruts| ruts[number]);
            let on_slope =
                |soil: &Soil| differences.soil_on(steepness, number, standing.at, rut, soil);
            let met =
                |soil| Met::one(Contact { wheel: mount.unit.wheel, soil, slip: *slip, gravity });
            let Some(zones) = &ground.zones else { return met(on_slope(&own)) };
            let shares = zones.under(ground.start, standing.at, standing.footprint);
            let soils = shares
                .iter()
                .map(|Share { soil, weight }| (on_slope(soil.unwrap_or(&own)), *weight));
            met(on_slope(&own)).on(soils.collect())
        })
        .collect()
    }

    /// The wheels under their loads [N]; one that is lifted has none.
    ///
    /// * `near`: a sinkage near which each is expected [m]
    fn settle_standing(
        &self,
        met: &[Met],
        loads: &[f64],
        near: impl Fn(usize) -> Option<f64>,
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        let mixtures: Vec<_> = met.iter().map(|met| met.mixture(self.model)).collect();
        let loaded: Vec<LoadedWheel<'_>> = met
            .iter()
            .zip(&mixtures)
            .zip(loads)
            .enumerate()
            .map(|(wheel, ((met, mixture), load))| LoadedWheel {
                model: mixture.as_ref().map_or(self.model, |mixture| mixture),
                contact: met.contact(),
                load: load.max(0.0),
                guess: near(wheel),
            })
            .collect();
        let settled = settle_each(&loaded).into_iter().zip(&loaded).zip(self.rover.mounts());
        settled
            .map(|((settled, wheel), mount)| {
                let of = |settled: Settled| WheelReaction {
                    slip: wheel.contact.slip,
                    load: wheel.load,
                    settled,
                };
                let named = |source| ReactionError::Wheel { wheel: mount.name.clone(), source };
                settled.map(of).map_err(named)
            })
            .collect()
    }
}

/// The wheels of a rover that stands in a motion nearby: where a search begins.
#[derive(Clone, Debug, Default)]
pub(crate) struct NearbyStanding {
    /// The wheels in the motion nearby; empty where nothing is known.
    wheels: Vec<WheelReaction>,
    /// How loads follow from by how much they do not agree with the forces under them, where that
    /// is known.
    inverse: Option<DMatrix<f64>>,
    /// What wheels that settled together know.
    pub(crate) known: KnownStanding,
}

impl NearbyStanding {
    /// By what wheels that settled together know.
    pub(crate) fn of(known: KnownStanding) -> Self {
        Self { known, ..Self::default() }
    }
}

/// The last step of a load, over the weight [-]: what is left of it disturbs an integrator's steps.
const AGREED: f64 = 1e-13;
/// This is enough where rounding lets steps become no shorter [-].
const NEARLY: f64 = 1e-11;
/// The lightest load of a wheel that a search begins with, over the weight [-].
const LIGHT: f64 = 1e-4;

/// Loads of wheels that stand, on their way to those that balance the rover.
pub(crate) struct Sought<'a> {
    ground: &'a OnGround<'a>,
    posture: &'a Posture,
    met: Vec<Met>,
    /// m g, against gravity [N].
    weight: Vec3,
    /// Near which each is expected: those of a motion nearby, then those of the round before; none
    /// where nothing is known.
    sinkages: RefCell<Vec<f64>>,
}

impl Sought<'_> {
    /// The reaction on every wheel, loads and wheels in turn, from those of a motion nearby.
    pub(crate) fn in_turns(
        &self,
        near: &mut NearbyStanding,
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        let weight = self.weight.norm();
        let NearbyStanding { wheels: before, inverse, .. } = std::mem::take(near);
        let guess = if before.is_empty() {
            DVector::from_vec(self.balanced(&[])?)
        } else {
            DVector::from_iterator(before.len(), before.iter().map(|wheel| wheel.load))
        };
        let size = guess.len();
        let found = inverse
            .and_then(|inverse| self.by_newton(&guess, inverse, weight))
            .or_else(|| self.by_newton(&guess, DMatrix::identity(size, size), weight));
        let (loads, wheels) = match found {
            Some(found) => {
                near.inverse = Some(found.inverse);
                (found.at, found.value)
            }
            // Where wheels lift, loads have corners, which Newton's steps do not find.
            None => self.by_damped_steps(guess, weight)?,
        };
        if loads.iter().all(|load| *load >= -NEARLY * weight) {
            return Ok(wheels);
        }
        // A rigid rover stands on the others, as on a plane.
        near.inverse = None;
        let (_, wheels) = self.on_others(&loads, weight).ok_or(Tipping)?;
        Ok(wheels)
    }

    /// How far loads [N] are from those that balance the forces under them, and the wheels under
    /// them.
    fn next(
        &self,
        loads: &DVector<f64>,
    ) -> Result<(DVector<f64>, Vec<WheelReaction>), ReactionError> {
        let mut sinkages = self.sinkages.borrow_mut();
        let near = |wheel: usize| sinkages.get(wheel).copied();
        let wheels = self.ground.settle_standing(&self.met, loads.as_slice(), near)?;
        *sinkages = wheels.iter().map(|wheel| wheel.settled.sinkage).collect();
        let forces: Vec<WheelForces> = forces_of(&wheels).copied().collect();
        let balanced = DVector::from_vec(self.balanced(&forces)?);
        let next = match self.warp() {
            Some(warp) => self.warped(&warp, &balanced)?,
            None => balanced,
        };
        Ok((loads - next, wheels))
    }

    /// The same by Newton's method with Broyden's updates; none where it does not come to an end.
    ///
    /// * `inverse`: how loads follow from by how much they do not agree
    /// * `weight`: m g [N]
    fn by_newton(
        &self,
        guess: &DVector<f64>,
        inverse: DMatrix<f64>,
        weight: f64,
    ) -> Option<Zero<Vec<WheelReaction>, Dyn>> {
        let size = |step: &DVector<f64>| step.amax() / weight;
        let last = Cell::new(f64::INFINITY);
        let is_found = |_: &DVector<f64>, step: &DVector<f64>| {
            let before = last.replace(size(step));
            size(step) <= AGREED || size(step) <= NEARLY && size(step) >= before
        };
        newton::zero_near(|loads| self.next(loads).ok(), guess, inverse, size, 1.0, is_found)
    }

    /// Loads that balance the rover and the wheels under them: by small steps, and where these go
    /// round in circles or away with each of a rigid rover's wheels lifted, then by Newton's steps,
    /// damped; from the guess and from the loads of wheels that only stand.
    ///
    /// * `weight`: m g [N]
    fn by_damped_steps(
        &self,
        guess: DVector<f64>,
        weight: f64,
    ) -> Result<(DVector<f64>, Vec<WheelReaction>), ReactionError> {
        let agreed = NEARLY * weight;
        let small = self.by_small_steps(guess.clone(), agreed);
        if !matches!(small, Err(ReactionError::LoadsDoNotSettle { .. })) {
            return small;
        }
        let still = DVector::from_vec(self.balanced(&[])?);
        let guesses = [&guess, &still];
        let found = guesses.into_iter().find_map(|guess| self.on_others(guess, weight));
        let found = found.or_else(|| {
            guesses.into_iter().find_map(|guess| {
                newton::damped_zero(|loads| self.next(loads).ok(), guess, weight, agreed)
            })
        });
        found.ok_or_else(|| self.why_none(guess, weight))
    }

    /// Loads that balance a rigid rover with one of its wheels lifted, and the wheels under them;
    /// none where it stands on all of them or tips, and none for a rover whose links load every
    /// wheel.
    ///
    /// Where one wheel lifts and another is about to, loads have a corner; and a wheel's forces
    /// grow without bound with the first of its load, in cohesive soil like its root. With the
    /// lifted wheel given and roots of the loads sought, neither is left: Newton's steps, damped,
    /// then find loads that turns and steps over all wheels do not.
    ///
    /// * `guess`: loads near which they are sought; its lightest wheel is lifted first [N]
    /// * `weight`: m g [N]
    fn on_others(
        &self,
        guess: &DVector<f64>,
        weight: f64,
    ) -> Option<(DVector<f64>, Vec<WheelReaction>)> {
        let mut order: Vec<usize> = (0..guess.len()).collect();
        order.sort_by(|one, other| guess[*one].total_cmp(&guess[*other]));
        let warp = self.warp();
        // What lifts a wheel of a warped rover is the warp: it lies where that takes load off.
        let is_lifted = |wheel: &usize| warp.as_ref().is_none_or(|gaps| gaps[*wheel] > 0.0);
        order.into_iter().filter(is_lifted).find_map(|lifted| {
            let others = |wheel: &usize| *wheel != lifted;
            let loads_of = |roots: &DVector<f64>| {
                // Below zero a load changes no forces.
                let load = |root: f64| weight * if root > 0.0 { root * root } else { root };
                roots.map(load).insert_row(lifted, 0.0)
            };
            let miss = |roots: &DVector<f64>| {
                let loads = loads_of(roots);
                let (next, wheels) = self.next_on_others(&loads, lifted, warp.as_ref())?;
                let off = (&loads - &next).remove_row(lifted) / weight;
                Some((off, (loads, next, wheels)))
            };
            let roots = (0..guess.len()).filter(others).map(|wheel| {
                // Of a wheel without a load forces say nothing yet.
                (guess[wheel] / weight).max(LIGHT).sqrt()
            });
            let roots = DVector::from_iterator(guess.len() - 1, roots);
            let (_, (loads, next, wheels)) = newton::damped_zero(miss, &roots, 1.0, NEARLY)?;
            let is_carried = loads.iter().all(|load| *load >= 0.0);
            let stays = match &warp {
                Some(_) => self.next(&loads).ok()?.0.amax() <= 2.0 * NEARLY * weight,
                None => next[lifted] <= 0.0,
            };
            (is_carried && stays).then_some((loads, wheels))
        })
    }

    /// The loads that balance the forces under loads [N] with a wheel lifted, and the wheels under
    /// them.
    ///
    /// * `warp`: the gaps of a rover on warped ground: then the lifted wheel's load is zero; else
    ///   it is what it would have
    fn next_on_others(
        &self,
        loads: &DVector<f64>,
        lifted: usize,
        warp: Option<&DVector<f64>>,
    ) -> Option<(DVector<f64>, Vec<WheelReaction>)> {
        let Self { ground, posture, weight, .. } = self;
        let wheels = ground.settle_standing(&self.met, loads.as_slice(), |_| None).ok()?;
        let forces: Vec<WheelForces> = forces_of(&wheels).copied().collect();
        let next = if let Some(gaps) = warp {
            let balanced = DVector::from_vec(self.balanced(&forces).ok()?);
            let along = -balanced[lifted] / gaps[lifted];
            balanced + along * gaps
        } else {
            let (balance, rover) = (ground.balance(), ground.rover);
            DVector::from_vec(balance.loads_on_others(rover, posture, *weight, &forces, lifted)?)
        };
        Some((next, wheels))
    }

    /// Why no loads balance the rover: those that do not agree move load from wheel to wheel, and
    /// where that lifts all wheels but two, the rover tips over.
    ///
    /// Loads that all but agree move slowly, so that one step in four is at least a twentieth of
    /// the weight long.
    ///
    /// * `weight`: m g [N]
    fn why_none(&self, mut loads: DVector<f64>, weight: f64) -> ReactionError {
        /// Share of the way that loads go at once [-], and how often.
        const SHARE: f64 = 0.7;
        const MOST_STEPS: usize = 200;
        const LONG: usize = 4;
        /// Over the weight [-].
        const LEAST: f64 = 0.05;
        let mut last = DVector::zeros(loads.len());
        for step in 1..=MOST_STEPS {
            if loads.iter().filter(|load| **load > NEARLY * weight).count() < OF_BODY {
                return Tipping.into();
            }
            let off = match self.next(&loads) {
                Ok((off, _)) => off,
                Err(error) => return error,
            };
            let size = off.amax();
            let is_long = step % LONG == 0 && size > 0.0;
            let share = if is_long { SHARE.max(LEAST * weight / size) } else { SHARE };
            loads -= share * &off;
            last = off;
        }
        self.unsettled(&last)
    }

    /// * `off`: how far each load is from those that balance the rover [N]
    fn unsettled(&self, off: &DVector<f64>) -> ReactionError {
        let wheel = self.ground.rover.mounts()[off.iamax()].name.clone();
        ReactionError::LoadsDoNotSettle { wheel, change: off.amax() / self.weight.norm() }
    }

    /// The same by steps that go a part of the way.
    ///
    /// * `agreed`: the last step of a load [N]
    fn by_small_steps(
        &self,
        mut loads: DVector<f64>,
        agreed: f64,
    ) -> Result<(DVector<f64>, Vec<WheelReaction>), ReactionError> {
        const MOST_STEPS: usize = 100;
        let mut share = 0.7;
        let mut before = f64::INFINITY;
        let mut last = DVector::zeros(loads.len());
        for _ in 0..MOST_STEPS {
            let (off, wheels) = self.next(&loads)?;
            let size = off.amax();
            if size <= agreed {
                return Ok((loads, wheels));
            }
            if size > 0.9 * before {
                share = f64::max(0.7 * share, 0.05);
            }
            before = size;
            loads -= share * &off;
            last = off;
        }
        Err(self.unsettled(&last))
    }

    fn balanced(&self, forces: &[WheelForces]) -> Result<Vec<f64>, Tipping> {
        let Self { ground, posture, weight, .. } = self;
        ground.balance().loads(ground.rover, posture, *weight, forces)
    }

    /// The gaps that a rigid rover with more wheels than freedoms cannot close [m], if there are
    /// any.
    fn warp(&self) -> Option<DVector<f64>> {
        /// Less than this is rounding [m].
        const FLAT: f64 = 1e-10;
        let gaps = self.posture.wheels.iter().map(|wheel| wheel.gap);
        let gaps = DVector::from_iterator(self.posture.wheels.len(), gaps);
        (self.posture.freedoms() < gaps.len() && gaps.norm() > FLAT).then_some(gaps)
    }

    /// The loads of a rigid rover on warped ground: those of least norm, and as much along the warp
    /// as makes the sinkages differ by it from those under loads of least norm. A wheel that would
    /// have to pull is lifted.
    ///
    /// ```text
    /// p · (h(N) − h(N°)) = −|gaps|        p = gaps / |gaps|        N = N° + λ p
    /// ```
    ///
    /// * `balanced`: the loads of least norm, *N°* [N]
    fn warped(
        &self,
        gaps: &DVector<f64>,
        balanced: &DVector<f64>,
    ) -> Result<DVector<f64>, ReactionError> {
        /// A difference of sinkages up to this counts as zero [m].
        const SAME: f64 = 1e-15;
        let size = gaps.norm();
        let mode = gaps / size;
        let under = |along: f64| {
            let loads = balanced + along * &mode;
            // From no guess: what a guess leaves in the last digits disturbs an integrator's steps.
            self.ground.settle_standing(&self.met, loads.as_slice(), |_| None)
        };
        let least = under(0.0)?;
        let failure = Cell::new(None);
        let miss = |along: f64| match under(along) {
            Ok(wheels) => {
                let change = |(wheel, least): (&WheelReaction, &WheelReaction)| {
                    wheel.settled.sinkage - least.settled.sinkage
                };
                let changes = wheels.iter().zip(&least).map(change);
                size + changes.zip(mode.iter()).map(|(change, share)| share * change).sum::<f64>()
            }
            Err(error) => {
                failure.set(Some(error));
                f64::NAN
            }
        };
        let lifts = |(share, load): (&f64, &f64)| {
            if *share > 0.0 { -load / share } else { f64::NEG_INFINITY }
        };
        let lifted = mode.iter().zip(balanced.iter()).map(lifts).fold(f64::NEG_INFINITY, f64::max);
        let low = (lifted, if lifted < 0.0 { miss(lifted) } else { 0.0 });
        let along = if low.1 < 0.0 {
            root::bracketed(&miss, low, (0.0, size), 0.0, SAME).0
        } else {
            lifted
        };
        if let Some(error) = failure.take() {
            return Err(error);
        }
        Ok(balanced + along * mode)
    }
}
