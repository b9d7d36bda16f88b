//! One evaluation of the motion: state in, rates out. It reads as a table of contents of the
//! equations.

use std::cell::{Cell, RefCell};

use super::allowance::Allowance;
use super::point::Point;
use super::power;
use super::scenario::Scenario;
use super::turning::Turning;
use super::work::Work;
use crate::contact::Slip;
use crate::stored::stored;
use crate::units::Vec2;
use crate::vehicle::kinematics::{wheel_slips, wheel_velocity};
use crate::vehicle::on_ground::forces_of;
use crate::vehicle::posture::{Attitude, StandingMotion};
use crate::vehicle::stability::stability_margin;
use crate::vehicle::standing::{KnownStanding, NearbyStanding};
use crate::vehicle::statics::centre_of_mass;
use crate::vehicle::{
    Acceleration, BellyPoint, Drive, Driven, Electrical, MotorLimits, OwnMoments, Posture,
    ReactionError, Rover, RoverState, Stance, Standing, Underside, WheelReaction, dynamics,
    on_ground::OnGround, settling::ForceAccuracy, settling::Known, settling::Nearby,
};

/// The equations of motion of a rover whose motors are set to given speeds.
pub struct Equations<'a> {
    on_ground: OnGround<'a>,
    rim_speeds: &'a [f64],
    wheel_speeds: Vec<f64>,
    /// Whether the speed of some wheel depends on its load.
    droops: bool,
    /// What each motor may take at most besides its own limits; nothing where there are no others.
    limits: &'a [MotorLimits],
    /// The yaw rate that is held, if one is [rad/s].
    held_yaw_rate: Option<f64>,
    work: Cell<Work>,
    /// How much of it there may be.
    allowance: Allowance,
    failure: RefCell<Option<ReactionError>>,
    /// The last evaluation of wheels whose speeds depend on their loads: an integral alone changes
    /// nothing of it.
    last: RefCell<Option<(RoverState, Vec<f64>, Evaluation)>>,
    /// The wheels of the last attempt, near which those of the next settle.
    nearby: RefCell<Nearby<'a>>,
    /// The same on uneven ground, and where the rover stood how.
    nearby_standing: RefCell<NearbyStanding>,
    last_posture: RefCell<Option<(Vec2, f64, Posture)>>,
}

/// What acts on a rover in motion.
struct Acting {
    wheels: Vec<WheelReaction>,
    /// Pull of the weight, in the body frame [N].
    pull: Vec2,
    /// The soil's force [N] and moment [N·m], in the body frame.
    soil: (Vec2, f64),
    /// Velocity of each hub along its wheel and to its left [m/s].
    hubs: Vec<Vec2>,
    /// How fast links turn about their axles [rad/s]; on a plane none does.
    turns: Vec<f64>,
    /// What the soil gives the rover beside its forces along the ground [W]: by hubs that rise, and
    /// by wheels that lean or turn.
    beside: f64,
    /// Yaw rate with which aligning moments act on a rover on a plane; 0 elsewhere [rad/s].
    aligning_work_rate: f64,
    /// Velocity of the body's centre of mass, in the ground's coordinates [m/s].
    velocity: Vec2,
    /// [rad/s]
    yaw_rate: f64,
    /// Rate at which the body turns about its own z axis where its yaw rate is held [rad/s].
    held: Option<f64>,
}

/// How a rover on uneven ground stands with its wheels sunk.
pub(super) struct Sunk {
    pub(super) attitude: Attitude,
    /// [rad]
    pub(super) stability_margin: f64,
    /// [m]; none where nothing is known of it, and on a plane.
    pub(super) belly_clearance: Option<f64>,
}

/// One evaluation of the motion: its rates, and the wheels that they come from.
#[derive(Clone, Debug, PartialEq)]
pub struct Evaluation {
    /// Rates of change.
    pub rates: Rates,
    /// Each wheel, settled, in the mounts' order.
    pub wheels: Vec<WheelReaction>,
}

/// What is known of the wheels from one piece of a run to the next; nothing at its start.
#[derive(Clone, Debug, Default)]
pub(super) struct LastWheels {
    pub(super) on_plane: Vec<Known>,
    /// On uneven ground.
    pub(super) standing: KnownStanding,
}

stored!(struct LastWheels { on_plane, standing });

impl LastWheels {
    /// Whether a rover with so many wheels can have it.
    pub(super) fn is_of(&self, count: usize) -> bool {
        self.standing.lifted.is_none_or(|wheel| wheel < count)
    }
}

/// Rates of change of a rover's motion, and the powers of its energy balance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    /// Velocity in the slope frame [m/s].
    pub velocity_slope: Vec2,
    /// Yaw rate [rad/s].
    pub yaw_rate: f64,
    /// Rates of the velocities.
    pub acceleration: Acceleration,
    /// Power of the motors [W].
    pub motor_power: f64,
    /// Power into the soil [W].
    pub soil_power: f64,
    /// Electrical power of the motors that are known [W].
    pub electrical_power: f64,
}

/// Where the search for sinkages and loads begins: the answers agree but for their last digits.
#[derive(Clone, Copy)]
enum Search {
    /// From shallow sinkages: the same whatever was evaluated before.
    Anew,
    /// From the wheels of the last attempt.
    Nearby(ForceAccuracy),
    /// Beside the last attempt, which stays the last: to first order in how far.
    Beside,
}

/// Time in which a yaw rate returns to the one that is held [s]. It never leaves it by more than
/// rounding: the time only tells a solver the way. Source: ours, as long as slip takes to settle.
const BACK_TO_HELD_RATE: f64 = 1e-2;

impl<'a> Equations<'a> {
    /// The equations of a scenario, for wheels that turn at these rim speeds, ω r_s [m/s].
    #[must_use]
    pub fn of(scenario: &'a Scenario, rim_speeds: &'a [f64]) -> Self {
        Self::new(scenario.on_ground(), rim_speeds)
    }

    /// The equations for wheels that turn at these rim speeds, ω r_s [m/s].
    #[must_use]
    pub fn new(on_ground: OnGround<'a>, rim_speeds: &'a [f64]) -> Self {
        let wheel_speeds = on_ground.rover.wheel_speeds(rim_speeds).collect();
        Self {
            droops: on_ground.rover.has_droop(),
            limits: &[],
            on_ground,
            rim_speeds,
            wheel_speeds,
            held_yaw_rate: None,
            work: Cell::default(),
            allowance: Allowance::unlimited(),
            failure: RefCell::new(None),
            last: RefCell::new(None),
            nearby: RefCell::default(),
            nearby_standing: RefCell::default(),
            last_posture: RefCell::default(),
        }
    }

    /// The same for a rover whose yaw rate something holds, if it does [rad/s].
    pub(super) fn holding(self, yaw_rate: Option<f64>) -> Self {
        Self { held_yaw_rate: yaw_rate, ..self }
    }

    /// Whether something holds its yaw rate.
    pub(super) fn is_held(&self) -> bool {
        self.held_yaw_rate.is_some()
    }

    /// The same for motors that may take less than their own limits allow.
    ///
    /// * `limits`: of each motor; nothing where there are no others
    pub(super) fn limited(self, limits: &'a [MotorLimits]) -> Self {
        Self { limits, ..self }
    }

    /// The same with what is known of the wheels in a motion nearby.
    pub(super) fn near(self, wheels: LastWheels) -> Self {
        self.nearby.borrow_mut().wheels = wheels.on_plane;
        *self.nearby_standing.borrow_mut() = NearbyStanding::of(wheels.standing);
        self
    }

    /// What is known of the wheels now.
    pub(super) fn take_near(&self) -> LastWheels {
        let on_plane = std::mem::take(&mut self.nearby.borrow_mut().wheels);
        LastWheels { on_plane, standing: self.nearby_standing.take().known }
    }

    /// The soil's reaction on each wheel: kinematics, slip, loads, sinkage, forces.
    ///
    /// # Errors
    /// [`ReactionError`] if the rover tips over or a wheel does not settle.
    pub fn reactions(&self, state: &RoverState) -> Result<Vec<WheelReaction>, ReactionError> {
        self.reactions_anew(state, self.rim_speeds)
    }

    fn reactions_anew(
        &self,
        state: &RoverState,
        rim_speeds: &[f64],
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        if self.on_ground.is_uneven() {
            return Ok(self.acting_on_uneven_ground(state, rim_speeds, Search::Anew)?.wheels);
        }
        self.reactions_at(state, &self.on_ground.stance(state), rim_speeds, Search::Anew)
    }

    /// The same at a point of a run, whose wheels may turn at other speeds than they are set to.
    pub(super) fn reactions_of(&self, point: &Point) -> Result<Vec<WheelReaction>, ReactionError> {
        self.reactions_anew(&point.state, self.turning(point))
    }

    /// The reactions at a point of a run on a plane, sought from what is known of the wheels in a
    /// motion nearby, and what is known of them there.
    pub(super) fn reactions_near(
        &self,
        point: &Point,
        known: Vec<Known>,
    ) -> Result<(Vec<WheelReaction>, Vec<Known>), ReactionError> {
        let state = &point.state;
        let slips: Vec<Slip> =
            wheel_slips(self.on_ground.rover, state, self.turning(point)).collect();
        self.count(|work| work.settled_wheels += slips.len() as u64);
        let (stance, exact) = (self.on_ground.stance(state), ForceAccuracy::EXACT);
        let near = &mut self.nearby.borrow_mut();
        let attempted = std::mem::replace(&mut near.wheels, known);
        let wheels = self.on_ground.reactions_after(&stance, &slips, near, exact);
        let known = std::mem::replace(&mut near.wheels, attempted);
        Ok((wheels?, known))
    }

    /// What is known on a plane of wheels that were settled in any way; nothing of wheels that are not
    /// carried.
    pub(super) fn known_of(&self, wheels: &[WheelReaction]) -> Vec<Known> {
        Known::of_all(&self.on_ground, wheels).unwrap_or_default()
    }

    /// The rim speeds of the wheels at a point of a run [m/s].
    pub(super) fn turning<'p>(&'p self, point: &'p Point) -> &'p [f64] {
        point.turning.as_ref().map_or(self.rim_speeds, Turning::rim_speeds)
    }

    fn reactions_at(
        &self,
        state: &RoverState,
        stance: &Stance,
        rim_speeds: &[f64],
        search: Search,
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        let slips: Vec<Slip> = wheel_slips(self.on_ground.rover, state, rim_speeds).collect();
        self.count(|work| work.settled_wheels += slips.len() as u64);
        match search {
            Search::Anew => self.on_ground.reactions(stance, &slips),
            Search::Nearby(accuracy) => {
                let near = &mut self.nearby.borrow_mut();
                self.on_ground.reactions_after(stance, &slips, near, accuracy)
            }
            Search::Beside => {
                self.on_ground.reactions_beside(stance, &slips, &mut self.nearby.borrow_mut())
            }
        }
    }

    /// The slip of every wheel at a point of a run, from the motion alone.
    pub(super) fn slips(&self, point: &Point) -> Vec<Slip> {
        let rim_speeds = self.turning(point);
        if self.on_ground.is_uneven()
            && let Ok(standing) = self.standing(&point.state)
        {
            return slips_of(self.on_ground.rover, &standing, rim_speeds);
        }
        wheel_slips(self.on_ground.rover, &point.state, rim_speeds).collect()
    }

    /// The rates at a state.
    ///
    /// # Errors
    /// [`ReactionError`] if the rover tips over or a wheel does not settle.
    pub fn rates(&self, state: &RoverState) -> Result<Rates, ReactionError> {
        self.evaluate(state).map(|evaluation| evaluation.rates)
    }

    /// The rates at a state, and the wheels there.
    ///
    /// # Errors
    /// The same as [`rates`](Self::rates).
    pub fn evaluate(&self, state: &RoverState) -> Result<Evaluation, ReactionError> {
        self.evaluate_with(state, self.rim_speeds, &self.wheel_speeds, Search::Anew)
    }

    /// The same for wheels that turn at other speeds than they are set to.
    ///
    /// * `rim_speeds`, `wheel_speeds`: of each wheel [m/s, rad/s]
    fn evaluate_with(
        &self,
        state: &RoverState,
        rim_speeds: &[f64],
        wheel_speeds: &[f64],
        search: Search,
    ) -> Result<Evaluation, ReactionError> {
        let rover = self.on_ground.rover;
        let Acting {
            wheels,
            pull,
            soil,
            hubs,
            turns,
            beside,
            aligning_work_rate,
            velocity,
            yaw_rate,
            held,
        } = if self.on_ground.is_uneven() {
            self.acting_on_uneven_ground(state, rim_speeds, search)?
        } else {
            self.acting_on_a_plane(state, rim_speeds, search)?
        };
        let (acceleration, holding_moment) = match held {
            None => (dynamics::acceleration(rover, pull, state, soil), 0.0),
            Some(rate) => {
                let back = (rate - state.yaw_rate) / BACK_TO_HELD_RATE;
                dynamics::held_acceleration(rover, pull, state, soil, back)
            }
        };
        let (motor_power, mut soil_power) =
            power::powers(&wheels, wheel_speeds, hubs.into_iter(), aligning_work_rate);
        soil_power -= beside;
        for (forces, turn) in forces_of(&wheels).zip(turns) {
            soil_power += forces.torque * turn;
        }
        let rates = Rates {
            velocity_slope: velocity,
            yaw_rate,
            acceleration,
            motor_power: motor_power + holding_moment * state.yaw_rate,
            soil_power,
            electrical_power: power::electrical_power(rover, &wheels, wheel_speeds),
        };
        Ok(Evaluation { rates, wheels })
    }

    fn acting_on_a_plane(
        &self,
        state: &RoverState,
        rim_speeds: &[f64],
        search: Search,
    ) -> Result<Acting, ReactionError> {
        let OnGround { rover, own_moments, .. } = self.on_ground;
        let stance = self.on_ground.stance(state);
        let wheels = self.reactions_at(state, &stance, rim_speeds, search)?;
        let soil = dynamics::soil_resultant(rover, forces_of(&wheels), own_moments);
        let hubs = rover.mounts().iter().map(|mount| wheel_velocity(state, mount)).collect();
        let velocity = stance.slope_from_body * state.velocity;
        let (pull, yaw_rate, turns) = (stance.pull, state.yaw_rate, Vec::new());
        let held = self.held_yaw_rate;
        let is_included = own_moments == OwnMoments::Included;
        let aligning_work_rate = if is_included { state.yaw_rate } else { 0.0 };
        Ok(Acting {
            wheels,
            pull,
            soil,
            hubs,
            turns,
            aligning_work_rate,
            beside: 0.0,
            velocity,
            yaw_rate,
            held,
        })
    }

    fn acting_on_uneven_ground(
        &self,
        state: &RoverState,
        rim_speeds: &[f64],
        search: Search,
    ) -> Result<Acting, ReactionError> {
        let OnGround { rover, gravity, own_moments, .. } = self.on_ground;
        let standing = self.standing(state)?;
        let slips = slips_of(rover, &standing, rim_speeds);
        self.count(|work| work.settled_wheels += slips.len() as u64);
        let (posture, up) = (&standing.posture, standing.up);
        let (near, ground) = (&self.nearby_standing, &self.on_ground);
        let wheels = match search {
            Search::Anew => ground.reactions_standing(posture, up, &slips, &[]),
            Search::Nearby(accuracy) => {
                let near = &mut near.borrow_mut();
                ground.reactions_standing_after(posture, up, &slips, near, accuracy)
            }
            Search::Beside => {
                ground.reactions_standing_beside(posture, up, &slips, &mut near.borrow_mut())
            }
        }?;
        let resultant = self.on_ground.resultant(&standing, &wheels);
        let pull = standing.pull(rover.mass() * gravity);
        let motion = standing.motion;
        let beside = power::beside_the_ground(&wheels, &motion, own_moments);
        Ok(Acting {
            aligning_work_rate: 0.0,
            beside,
            wheels,
            pull,
            soil: (resultant.force.xy(), resultant.moment.z),
            hubs: motion.hubs,
            turns: motion.turns,
            velocity: motion.velocity.xy(),
            yaw_rate: motion.yaw_rate,
            held: self.held_yaw_rate.map(|_| motion.body_rate),
        })
    }

    /// How the rover stands and moves in a state. The posture depends on its place and yaw alone,
    /// which mostly are those of the evaluation before.
    fn standing(&self, state: &RoverState) -> Result<Standing, ReactionError> {
        let mut last = self.last_posture.borrow_mut();
        let posture = match &*last {
            Some((place, yaw, posture)) if *place == state.position && *yaw == state.yaw => posture,
            _ => {
                let near = last.as_ref().map(|(.., posture)| posture);
                let firm = vec![0.0; self.on_ground.rover.wheel_count()];
                let posture = self.on_ground.posture_near(state, &firm, near)?;
                &last.insert((state.position, state.yaw, posture)).2
            }
        };
        self.on_ground.moving(posture.clone(), state, self.held_yaw_rate)
    }

    /// How a rover on uneven ground stands with its wheels sunk; none where it does not come to
    /// stand, and on a plane where it has no suspension.
    pub(super) fn sunk(&self, state: &RoverState, wheels: &[WheelReaction]) -> Option<Sunk> {
        let posture = self.sunk_posture(state, wheels)?;
        Some(Sunk {
            attitude: posture.attitude(),
            stability_margin: stability_margin(
                self.on_ground.rover,
                &posture,
                self.on_ground.up(state),
            ),
            belly_clearance: self.belly_over(&posture).map(|belly| belly.clearance),
        })
    }

    /// Whether the weight falls outside the wheels of a rover on ground with heights: on a plane no
    /// loads then balance it.
    pub(super) fn is_overhanging(&self, state: &RoverState) -> bool {
        self.has_relief()
            && self.standing(state).is_ok_and(|Standing { posture, up, .. }| {
                stability_margin(self.on_ground.rover, &posture, up) < 0.0
            })
    }

    /// Whether the ground may touch the rover's underside.
    pub(super) fn has_belly(&self) -> bool {
        self.on_ground.rover.parts().belly_clearance.is_some() && self.has_relief()
    }

    /// The point of the rover's underside that is nearest to the ground, its wheels sunk; none
    /// where its belly clearance is not known, and on a plane.
    pub(super) fn belly(&self, state: &RoverState, wheels: &[WheelReaction]) -> Option<BellyPoint> {
        if !self.has_belly() {
            return None;
        }
        self.belly_over(&self.sunk_posture(state, wheels)?)
    }

    fn belly_over(&self, posture: &Posture) -> Option<BellyPoint> {
        if !self.has_relief() {
            return None;
        }
        Some(Underside::of(self.on_ground.rover)?.nearest(posture, self.on_ground.ground))
    }

    fn sunk_posture(&self, state: &RoverState, wheels: &[WheelReaction]) -> Option<Posture> {
        if !self.on_ground.is_uneven() || wheels.is_empty() {
            return None;
        }
        let sinkages: Vec<f64> = wheels.iter().map(|wheel| wheel.settled.sinkage).collect();
        let last = self.last_posture.borrow();
        let near = last.as_ref().map(|(.., posture)| posture);
        self.on_ground.posture_near(state, &sinkages, near).ok()
    }

    /// Potential energy [J]; what the rover sinks does not count.
    pub(super) fn potential_energy(&self, state: &RoverState) -> f64 {
        let OnGround { rover, ground, gravity, .. } = self.on_ground;
        if self.on_ground.is_uneven()
            && let Ok(standing) = self.standing(state)
        {
            let Standing { posture, up, .. } = standing;
            let centre = posture.place + centre_of_mass(rover, &posture);
            return rover.mass() * gravity * centre.dot(&up);
        }
        power::potential_energy(rover, ground, gravity, state)
    }

    /// The rover that moves.
    #[must_use]
    pub fn rover(&self) -> &Rover {
        self.on_ground.rover
    }

    /// Whether the soil differs from place to place.
    pub(super) fn has_uneven_soil(&self) -> bool {
        self.on_ground.differences.by_place.is_some()
    }

    /// Whether wheels stand as uneven ground or a suspension has them.
    pub(super) fn is_uneven(&self) -> bool {
        self.on_ground.is_uneven()
    }

    /// Whether the ground has heights of its own.
    pub(super) fn has_relief(&self) -> bool {
        !self.on_ground.ground.is_plane()
    }

    /// Whether the soil differs by zone.
    pub(super) fn has_zones(&self) -> bool {
        self.on_ground.ground.zones.is_some()
    }

    /// Where the run started, in the coordinates of ground with heights [m].
    pub(super) fn origin(&self) -> Option<Vec2> {
        self.has_relief().then_some(self.on_ground.ground.start)
    }

    /// Rates of place and yaw in a state [m/s, rad/s]; none where the rover does not come to stand.
    pub(super) fn pose_rates(&self, state: &RoverState) -> Option<(Vec2, f64)> {
        let motion = self.standing(state).ok()?.motion;
        Some((motion.velocity.xy(), motion.yaw_rate))
    }

    /// The rover on its ground.
    #[must_use]
    pub fn on_ground(&self) -> &OnGround<'a> {
        &self.on_ground
    }

    /// The rim speeds that the wheels are set to, *ω_0 r_s* [m/s].
    #[must_use]
    pub fn rim_speeds(&self) -> &[f64] {
        self.rim_speeds
    }

    /// The wheels' angular speeds that they are set to, *ω_0* [rad/s].
    #[must_use]
    pub fn wheel_speeds(&self) -> &[f64] {
        &self.wheel_speeds
    }

    /// Does what [`evaluate`](Self::evaluate) does, for a solver: sought near the last attempt, so
    /// that the answer differs in its last digits. A solver may try states that no rover can have,
    /// so the reason of a failure is kept for when it gives up.
    pub(super) fn attempt(&self, state: &RoverState) -> Option<Evaluation> {
        self.attempt_by(Search::Nearby(ForceAccuracy::EXACT), state)
    }

    /// Does the same to an error relative to the forces [-], where a solver is still on its way.
    pub(super) fn attempt_to(&self, error: f64, state: &RoverState) -> Option<Evaluation> {
        self.attempt_by(Search::Nearby(ForceAccuracy::to(error)), state)
    }

    /// Attempts a state beside the last attempt, for a difference: to first order in how far it is.
    pub(super) fn attempt_beside(&self, state: &RoverState) -> Option<Evaluation> {
        self.attempt_by(Search::Beside, state)
    }

    fn attempt_by(&self, search: Search, state: &RoverState) -> Option<Evaluation> {
        if self.is_spent() {
            return None;
        }
        self.count(|work| work.evaluations += 1);
        let evaluated = self.evaluate_with(state, self.rim_speeds, &self.wheel_speeds, search);
        evaluated.map_err(|failure| self.keep(failure)).ok()
    }

    /// The same for wheels whose speeds depend on their loads: how these change, too.
    pub(super) fn attempt_turning(
        &self,
        state: &RoverState,
        turning: &Turning,
    ) -> Option<(Rates, Turning)> {
        let rover = self.on_ground.rover;
        let rim_speeds = turning.rim_speeds();
        let Evaluation { mut rates, wheels } = self.attempt_at(state, rim_speeds)?;
        let mut changes = Turning::at(&vec![0.0; rim_speeds.len()]);
        for (wheel, mount) in rover.mounts().iter().enumerate() {
            let Some(driven) = self.driven(wheel, turning) else { continue };
            let torque = wheels[wheel].settled.forces.torque;
            let spin_rate = (driven.torque - torque) / mount.unit.inertia.yy;
            changes.set(wheel, mount.shearing_radius() * spin_rate, driven.integral_rate);
            rates.electrical_power += driven.electrical.power
                - power::electrical(mount, torque, rim_speeds[wheel] / mount.shearing_radius())
                    .map_or(0.0, |it| it.power);
        }
        Some((rates, changes))
    }

    /// Does what [`attempt`](Self::attempt) does, for wheels that turn at other speeds than they
    /// are set to.
    ///
    /// * `rim_speeds`: of each wheel [m/s]
    pub(super) fn attempt_at(&self, state: &RoverState, rim_speeds: &[f64]) -> Option<Evaluation> {
        if let Some((known_state, known_rims, evaluation)) = &*self.last.borrow()
            && (known_state, known_rims.as_slice()) == (state, rim_speeds)
        {
            return Some(evaluation.clone());
        }
        if self.is_spent() {
            return None;
        }
        self.count(|work| work.evaluations += 1);
        let wheel_speeds: Vec<f64> = self.on_ground.rover.wheel_speeds(rim_speeds).collect();
        let search = Search::Nearby(ForceAccuracy::EXACT);
        let evaluated = self.evaluate_with(state, rim_speeds, &wheel_speeds, search);
        let evaluation = evaluated.map_err(|failure| self.keep(failure)).ok()?;
        *self.last.borrow_mut() = Some((*state, rim_speeds.to_vec(), evaluation.clone()));
        Some(evaluation)
    }

    /// The rim speed at which a wheel's motor turns it in the end under the soil's torque [m/s].
    pub(super) fn rim_speed_under(&self, wheel: usize, reaction: &WheelReaction) -> f64 {
        let mount = &self.on_ground.rover.mounts()[wheel];
        let Some(motor) = mount.unit.motor else { return self.rim_speeds[wheel] };
        let (set, torque) = (self.wheel_speeds[wheel], reaction.settled.forces.torque);
        mount.shearing_radius() * motor.speed_under(torque, set, self.limits_of(wheel))
    }

    /// What the integral of a wheel's controller adds to the voltage in the end [V].
    ///
    /// * `rim_speed`: of the wheel [m/s]
    pub(super) fn settled_integral(
        &self,
        wheel: usize,
        rim_speed: f64,
        reaction: &WheelReaction,
    ) -> f64 {
        let mount = &self.on_ground.rover.mounts()[wheel];
        let (motor, torque) = (mount.unit.motor, reaction.settled.forces.torque);
        let (set, speed) = (self.wheel_speeds[wheel], rim_speed / mount.shearing_radius());
        motor.map_or(0.0, |motor| motor.settled_integral(torque, set, speed))
    }

    /// What a wheel's motor does, where its speed depends on its load.
    ///
    /// * `wheel`: its place among the mounts
    pub(super) fn driven(&self, wheel: usize, turning: &Turning) -> Option<Driven> {
        let mount = &self.on_ground.rover.mounts()[wheel];
        let motor = mount.unit.motor.filter(|motor| motor.control.is_some())?;
        let speed = turning.rim_speeds()[wheel] / mount.shearing_radius();
        let (set, integral) = (self.wheel_speeds[wheel], turning.integral(wheel));
        Some(motor.driven(Drive { set, speed, integral }, self.limits_of(wheel)))
    }

    /// What each motor takes whose winding is at 20 °C, where that is known.
    ///
    /// * `wheels`: of the rover at the point, or none
    pub(super) fn taken(&self, point: &Point, wheels: &[WheelReaction]) -> Vec<Option<Electrical>> {
        let rover = self.on_ground.rover;
        let speeds = rover.wheel_speeds(self.turning(point));
        let each = wheels.iter().zip(speeds).zip(rover.mounts()).enumerate();
        each.map(|(wheel, ((reaction, speed), mount))| {
            let driven = point.turning.and_then(|turning| self.driven(wheel, &turning));
            let steady = || power::electrical(mount, reaction.settled.forces.torque, speed);
            driven.map(|driven| driven.electrical).or_else(steady)
        })
        .collect()
    }

    /// What a wheel's motor may take at most besides its own limits.
    pub(super) fn limits_of(&self, wheel: usize) -> MotorLimits {
        self.limits.get(wheel).copied().unwrap_or(MotorLimits::NONE)
    }

    /// Whether the speed of some wheel depends on its load.
    pub(super) fn droops(&self) -> bool {
        self.droops
    }

    /// How many numbers of motors move.
    pub(super) fn moving_motors(&self) -> usize {
        if self.droops { 2 * self.on_ground.rover.wheel_count() } else { 0 }
    }

    /// Keeps the reason of a failed attempt.
    fn keep(&self, failure: ReactionError) {
        self.allowance.charge_failure();
        *self.failure.borrow_mut() = Some(failure);
    }

    /// Why the last failed attempt failed.
    pub(super) fn take_failure(&self) -> Option<ReactionError> {
        self.failure.borrow_mut().take()
    }

    /// Allows from here on what a run may compute between two looks of the watch: beyond it every
    /// attempt fails.
    pub(super) fn renew_allowance(&self) {
        self.allowance.renew(self.work());
    }

    /// Whether that was too little.
    pub(super) fn is_spent(&self) -> bool {
        self.allowance.is_spent(self.work())
    }

    /// What was computed so far.
    pub(super) fn work(&self) -> Work {
        self.work.get()
    }

    /// Counts work done.
    pub(super) fn count(&self, add: impl Fn(&mut Work)) {
        let mut work = self.work.get();
        add(&mut work);
        self.work.set(work);
    }
}

/// The slip of every wheel of a rover that stands.
///
/// * `rim_speeds`: ω r_s of each wheel on its link [m/s]
fn slips_of(rover: &Rover, standing: &Standing, rim_speeds: &[f64]) -> Vec<Slip> {
    let StandingMotion { hubs, turns, .. } = &standing.motion;
    let each = hubs.iter().zip(turns).zip(rover.mounts()).zip(rim_speeds);
    each.map(|(((hub, turn), mount), rim_speed)| {
        Slip::of_motion(rim_speed + mount.shearing_radius() * turn, *hub)
    })
    .collect()
}
