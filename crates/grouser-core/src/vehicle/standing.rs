//! The reaction on a rover that stands on uneven ground, or on a suspension.
//!
//! Its posture follows from the ground as if that were firm, as on a plane: what wheels sink changes no lever. Loads and
//! reactions are sought together, N = N(forces(N)), by Newton's method with Broyden's updates from the loads of wheels that
//! only stand, or from those of a motion nearby.

use std::borrow::Cow;
use std::cell::{Cell, RefCell};

use nalgebra::{DMatrix, DVector};

use super::load::Tipping;
use super::posture::{Posture, StandingMotion};
use super::reaction::{Ground, ReactionError, WheelReaction, forces_of};
use super::statics::{Balance, Resultant};
use super::state::RoverState;
use crate::contact::{Contact, LoadedWheel, Settled, Slip, WheelForces, settle_each};
use crate::newton;
use crate::soil::Soil;
use crate::terrain::{Footprint, Patch, Terrain};
use crate::units::{Vec2, Vec3};

/// Heights of the ground, seen from the place where a rover starts.
#[derive(Clone, Copy)]
pub struct Relief<'a> {
    /// The ground; its soil is not asked for.
    pub terrain: &'a dyn Terrain,
    /// The start of the rover in its coordinates [m].
    pub origin: Vec2,
}

impl Terrain for Relief<'_> {
    fn patch(&self, at: Vec2, footprint: Footprint) -> Patch<'_> {
        self.terrain.patch(self.origin + at, footprint)
    }

    fn covers(&self, at: Vec2, footprint: Footprint) -> bool {
        self.terrain.covers(self.origin + at, footprint)
    }
}

/// The plane of the slope frame: level in it.
struct Flat<'a>(&'a Soil);

impl Terrain for Flat<'_> {
    fn patch(&self, _: Vec2, _: Footprint) -> Patch<'_> {
        Patch { height: 0.0, normal: Vec3::z(), soil: Cow::Borrowed(self.0) }
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

impl Ground<'_> {
    /// Whether wheels have pieces of ground of their own, or links that carry them.
    #[must_use]
    pub fn is_uneven(&self) -> bool {
        self.relief.is_some() || self.rover.suspension().is_some()
    }

    /// How the rover stands in a state, with its wheels sunk.
    ///
    /// * `near`: a posture near it
    ///
    /// # Errors
    /// [`ReactionError`] beyond the known ground, and where the wheels do not come to stand.
    pub fn posture(
        &self,
        state: &RoverState,
        sinkages: &[f64],
        near: Option<&Posture>,
    ) -> Result<Posture, ReactionError> {
        let soil = self.site.terrain.soil(state.position, self.rover.footprint(&state.slope_from_body()));
        let flat = Flat(&soil);
        let terrain: &dyn Terrain = match &self.relief {
            Some(relief) => relief,
            None => &flat,
        };
        let posture = Posture::of(self.rover, terrain, state.position, state.yaw, sinkages, near)?;
        for (wheel, mount) in posture.wheels.iter().zip(self.rover.mounts()) {
            if !terrain.covers(wheel.at, wheel.footprint) {
                let origin = self.relief.map_or(Vec2::zeros(), |relief| relief.origin);
                let place = origin + wheel.at;
                return Err(ReactionError::OffTheMap { wheel: mount.name.clone(), place });
            }
        }
        Ok(posture)
    }

    /// How the rover stands and moves in a state.
    ///
    /// # Errors
    /// As of [`posture`](Self::posture).
    pub fn standing(
        &self,
        state: &RoverState,
        near: Option<&Posture>,
    ) -> Result<Standing, ReactionError> {
        self.moving(self.posture(state, &vec![0.0; self.rover.wheel_count()], near)?, state)
    }

    /// How the rover moves that stands so in a state.
    ///
    /// # Errors
    /// [`ReactionError`] where its wheels allow no motion along the ground.
    pub fn moving(&self, posture: Posture, state: &RoverState) -> Result<Standing, ReactionError> {
        let motion = posture.motion(state)?;
        Ok(Standing { posture, motion, up: self.up(state) })
    }

    /// Against gravity, in the ground's coordinates: on a plane, those of the slope.
    fn up(&self, state: &RoverState) -> Vec3 {
        if self.relief.is_some() {
            return Vec3::z();
        }
        let footprint = self.rover.footprint(&state.slope_from_body());
        let patch = self.site.terrain.patch(state.position, footprint);
        let unit = self.site.weight(1.0 / self.site.gravity, &patch);
        Vec3::new(unit.uphill.x, unit.uphill.y, unit.into)
    }

    /// The reaction on every wheel of a rover that stands, in the mounts' order.
    ///
    /// * `near`: of all wheels in a motion nearby, or of none
    ///
    /// # Errors
    /// [`ReactionError`] if the rover tips, a wheel sinks to its axle, or loads and reactions do not agree.
    pub fn reactions_standing(
        &self,
        standing: &Standing,
        slips: &[Slip],
        near: &[WheelReaction],
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        /// The last step of a load, over the weight [-]: what is left of it disturbs an integrator's steps.
        const AGREED: f64 = 1e-13;
        /// This is enough where rounding lets steps become no shorter [-].
        const NEARLY: f64 = 1e-11;
        let contacts = self.contacts(&standing.posture, slips);
        let weight = self.rover.mass() * self.site.gravity;
        let near_forces: Vec<WheelForces> = forces_of(near).copied().collect();
        let first = self.loads(standing, weight, &near_forces)?;
        let guess = DVector::from_vec(first);
        let size = |step: &DVector<f64>| step.amax() / weight;
        let (failure, last) = (RefCell::new(None), Cell::new(f64::INFINITY));
        let found = newton::zero_near(
            |loads| {
                let wheels = self.settle_standing(&contacts, loads.as_slice(), near);
                let next = wheels.and_then(|wheels| {
                    let forces: Vec<WheelForces> = forces_of(&wheels).copied().collect();
                    let next = self.loads(standing, weight, &forces)?;
                    Ok((loads - DVector::from_vec(next), wheels))
                });
                next.map_err(|error| *failure.borrow_mut() = Some(error)).ok()
            },
            &guess,
            DMatrix::identity(guess.len(), guess.len()),
            size,
            1.0,
            |_, step| {
                let before = last.replace(size(step));
                size(step) <= AGREED || size(step) <= NEARLY && size(step) >= before
            },
        );
        let Some(found) = found else {
            let unsettled = ReactionError::Unsettled { rounds: 0, change: f64::INFINITY };
            return Err(failure.into_inner().unwrap_or(unsettled));
        };
        if found.at.iter().any(|load| *load < 0.0) {
            return Err(Tipping.into());
        }
        Ok(found.value)
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

    fn loads(
        &self,
        standing: &Standing,
        weight: f64,
        forces: &[WheelForces],
    ) -> Result<Vec<f64>, Tipping> {
        self.balance().loads(self.rover, &standing.posture, weight * standing.up, forces)
    }

    /// What each wheel meets.
    fn contacts(&self, posture: &Posture, slips: &[Slip]) -> Vec<Contact> {
        let Self { rover, site, ref differences, .. } = *self;
        let ruts = differences.ruts.of_wheels(rover, slips);
        let each = posture.wheels.iter().zip(rover.mounts()).zip(slips).enumerate();
        each.map(|(number, ((standing, mount), slip))| {
            let soil = site.terrain.soil(standing.at, standing.footprint);
            let normal = standing.normal;
            let steepness = normal.xy().norm() / normal.z;
            let rut = ruts.as_ref().map(|ruts| ruts[number]);
            let soil = differences.soil_on(steepness, number, standing.at, rut, &soil);
            Contact { wheel: mount.unit.wheel, soil, slip: *slip, gravity: site.gravity }
        })
        .collect()
    }

    /// The wheels under their loads [N]; one that is lifted has none.
    fn settle_standing(
        &self,
        contacts: &[Contact],
        loads: &[f64],
        near: &[WheelReaction],
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        let loaded: Vec<LoadedWheel<'_>> = contacts
            .iter()
            .zip(loads)
            .enumerate()
            .map(|(wheel, (contact, load))| LoadedWheel {
                model: self.model,
                contact,
                load: load.max(0.0),
                guess: near.get(wheel).map(|near| near.settled.sinkage),
            })
            .collect();
        let settled = settle_each(&loaded).into_iter().zip(&loaded).zip(self.rover.mounts());
        settled
            .map(|((settled, wheel), mount)| {
                let of = |settled: Settled| WheelReaction { slip: wheel.contact.slip, load: wheel.load, settled };
                let named = |source| ReactionError::Wheel { wheel: mount.name.clone(), source };
                settled.map(of).map_err(named)
            })
            .collect()
    }
}
