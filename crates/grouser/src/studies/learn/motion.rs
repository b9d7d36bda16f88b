//! The motion that a soil expects where the rover was seen, with the torques and sinkages that go
//! with it.
//!
//! Attitude and rim speeds are taken as they were read. The velocities (u, v) and the yaw rate ω
//! are those that leave neither a force nor a yaw moment over,
//!
//! ```text
//! ΣF_x(u, v, ω) + G_x = 0        ΣF_y(u, v, ω) + G_y = 0        ΣM_z(u, v, ω) + r_g × G = 0
//! ```
//!
//! and are compared with those that were read, not the forces at those that were read: where wheels
//! hardly slip, forces turn within the noise of odometry, and a soil that is judged by forces at a
//! noisy motion is judged too weak. The same goes for the yaw rate: at one that is off, in either
//! direction, wheels of one side slip more than those of the other, which costs pull, and takes a
//! weaker soil for the same way. A soil in which nothing balances holds the rover where it is.

use nalgebra::{DVector, Matrix3, Vector3};

use super::noise::ModelNoise;
use super::stretch::{Reading, Stretch};
use crate::contact::Slip;
use crate::elementary::wide::{hypot, ln};
use crate::newton;
use crate::studies::ensemble::samples::Sample;
use crate::studies::heading::HeadingStudy;
use crate::units::Vec2;
use crate::vehicle::kinematics::wheel_slips;
use crate::vehicle::on_ground::{OnGround, forces_of};
use crate::vehicle::{Rover, RoverState, WheelReaction, dynamics};

/// A motion that was seen, with what was read of forces and sinkages in it.
#[derive(Clone, Debug)]
pub(super) struct SeenMotion {
    rover: Rover,
    slope: f64,
    yaw: f64,
    rim_speeds: Vec<f64>,
    /// Distance of the farthest wheel from the centre of mass [m].
    reach: f64,
    /// Velocity along the body and to its left [m/s], and yaw rate [rad/s].
    velocities: [Reading; 3],
    torques: Vec<Option<Reading>>,
    sinkages: Vec<Option<Reading>>,
    way: f64,
    /// Whether the way along the body was read.
    is_way_known: bool,
}

/// Why nothing is learnt from a stretch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NotUsed {
    /// Neither roll nor pitch, and no slope.
    NoAttitude,
    /// No way along the body, nor torques or sinkages.
    NoMotion,
    /// The wheels stand.
    Standing,
    /// The wheels turn in different directions, or change their speeds.
    Manoeuvre,
    /// Its records are farther apart in time than the motion is known in between.
    Apart,
    /// The rover tips, or no soil that is believed possible carries it.
    NotCarried,
}

impl NotUsed {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::NoAttitude,
        Self::NoMotion,
        Self::Standing,
        Self::Manoeuvre,
        Self::Apart,
        Self::NotCarried,
    ];

    /// One word.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::NoAttitude => "no-attitude",
            Self::NoMotion => "no-motion",
            Self::Standing => "standing",
            Self::Manoeuvre => "manoeuvre",
            Self::Apart => "apart",
            Self::NotCarried => "not-carried",
        }
    }

    /// What it means for an operator.
    #[must_use]
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::NoAttitude => "roll and pitch are not known",
            Self::NoMotion => "there is no way by odometry or fixes, nor a torque or a sinkage",
            Self::Standing => "the wheels stand",
            Self::Manoeuvre => "the wheels turn in different directions, or change their speeds",
            Self::Apart => {
                "records are more than 5 s apart, between which nobody knows the motion (times in \
                 milliseconds are `time_ms`)"
            }
            Self::NotCarried => {
                "the rover would tip there, or sink to its axles in every soil that is believed \
                 possible"
            }
        }
    }
}

/// Rims that are slower than this stand [m/s].
const STANDS: f64 = 1e-3;
/// Rims whose speeds scatter more than this over their size change them [-].
const STEADY: f64 = 0.25;
/// How far a way that was not read is unknown, over the rims' speed [-]: more than any slip.
const UNKNOWN_WAY: f64 = 100.0;
/// How far a way to the side that was not read is unknown, over the rims' speed [-].
const UNKNOWN_SIDE: f64 = 0.15;
/// How far a yaw rate that was not read is unknown, its speed at the farthest wheel over the rims'
/// [-].
const UNKNOWN_TURN: f64 = 0.05;
/// Odometry is this uncertain however many of it are averaged, over the rims' speed [-]: its scale
/// and mounting. Source: ours.
pub(in crate::studies) const ODOMETRY: f64 = 0.005;

/// Slope and yaw of a stretch over which the motion may be taken as steady [rad].
///
/// # Errors
/// [`NotUsed`] where it may not, or its attitude is not known.
pub(in crate::studies) fn steady_attitude(stretch: &Stretch) -> Result<[f64; 2], NotUsed> {
    let rims = &stretch.rim_speeds;
    if rims.iter().all(|it| it.abs() < STANDS) {
        return Err(NotUsed::Standing);
    }
    let turns_both_ways = rims.iter().any(|it| *it > STANDS) && rims.iter().any(|it| *it < -STANDS);
    if turns_both_ways || stretch.rim_scatter > STEADY {
        return Err(NotUsed::Manoeuvre);
    }
    stretch.attitude.ok_or(NotUsed::NoAttitude)
}

impl SeenMotion {
    /// What can be learnt from a stretch.
    pub(super) fn of(stretch: &Stretch, rover: &Rover) -> Result<Self, NotUsed> {
        let [slope, yaw] = steady_attitude(stretch)?;
        if stretch.way <= 0.0 {
            return Err(NotUsed::Apart);
        }
        let rims = &stretch.rim_speeds;
        let fastest = rims.iter().map(|it| it.abs()).fold(0.0, f64::max);
        let [forward, leftward] = stretch.velocity;
        let reach = rover.load_arms().iter().map(Vec2::norm).fold(f64::MIN_POSITIVE, f64::max);
        let unknown = |share: f64| Reading { value: 0.0, deviation: share * fastest };
        let has_other = stretch.torques.iter().chain(&stretch.sinkages).any(Option::is_some);
        if forward.is_none() && !has_other {
            return Err(NotUsed::NoMotion);
        }
        // Without a way nothing is known of the slip, in either direction.
        let side = if forward.is_some() { UNKNOWN_SIDE } else { UNKNOWN_WAY };
        let leftward = leftward.unwrap_or(unknown(side));
        let mean = rims.iter().sum::<f64>() / rims.len() as f64;
        let is_way_known = forward.is_some();
        let forward = forward.unwrap_or(Reading { value: mean, ..unknown(UNKNOWN_WAY) });
        let turning = stretch.yaw_rate.unwrap_or(unknown(UNKNOWN_TURN / reach));
        let floor = ODOMETRY * fastest;
        let with_floor = |reading: Reading, floor: f64| {
            let deviation = hypot(reading.deviation, floor);
            Reading { deviation, ..reading }
        };
        let velocities = [
            with_floor(forward, floor),
            with_floor(leftward, floor),
            with_floor(turning, floor / reach),
        ];
        Ok(Self {
            rover: steered(rover, &stretch.steering),
            slope,
            yaw,
            rim_speeds: rims.clone(),
            reach,
            velocities,
            torques: stretch.torques.clone(),
            sinkages: stretch.sinkages.clone(),
            way: stretch.way,
            is_way_known,
        })
    }

    /// Mean slip ratio of the wheels, and way to the left over that of the fastest rim, as they
    /// were seen [-].
    pub(super) fn slip_and_drift(&self) -> [f64; 2] {
        self.slip_and_drift_of(&self.read())
    }

    /// Whether the way along the body was read, and with it the slip.
    pub(super) fn is_way_known(&self) -> bool {
        self.is_way_known
    }

    /// The same as a soil expects them [-].
    pub(super) fn expected_slip_and_drift(&self, expected: &Expected) -> [f64; 2] {
        self.slip_and_drift_of(&expected.balance.motion)
    }

    fn slip_and_drift_of(&self, motion: &Vector3<f64>) -> [f64; 2] {
        let slips = self.slips(motion);
        let slip = slips.iter().map(|it| it.ratio).sum::<f64>() / slips.len() as f64;
        [slip, motion.y / self.fastest()]
    }

    /// The motion that was read, as [`Balance::motion`] has it.
    fn read(&self) -> Vector3<f64> {
        let [forward, leftward, turning] = self.velocities.map(|it| it.value);
        Vector3::new(forward, leftward, turning * self.reach)
    }

    /// The slope of the ground [rad].
    pub(super) fn slope(&self) -> f64 {
        self.slope
    }

    /// The same motion on another slope [rad], at the same yaw.
    pub(super) fn on_slope(&self, slope: f64) -> Self {
        Self { slope, ..self.clone() }
    }

    /// The fastest rim's speed [m/s].
    fn fastest(&self) -> f64 {
        self.rim_speeds.iter().map(|it| it.abs()).fold(0.0, f64::max)
    }

    fn state(&self, motion: &Vector3<f64>) -> RoverState {
        let yaw_rate = motion.z / self.reach;
        RoverState { yaw: self.yaw, velocity: motion.xy(), yaw_rate, ..RoverState::default() }
    }

    fn slips(&self, motion: &Vector3<f64>) -> Vec<Slip> {
        wheel_slips(&self.rover, &self.state(motion), &self.rim_speeds).collect()
    }

    /// What each wheel does in a motion, and what is left over: the force over the weight, and the
    /// yaw moment over the weight at the [`reach`](Self::reach) [-]; `None` where the soil does not
    /// carry the rover.
    fn left_over(
        &self,
        under: Under<'_>,
        motion: &Vector3<f64>,
        near: &[WheelReaction],
    ) -> Option<(Vector3<f64>, Vec<WheelReaction>)> {
        let study = under.study;
        let plane = study.plane(self.slope);
        let ground = OnGround { rover: &self.rover, ..study.on_ground(&plane) };
        let stance = ground.stance(&self.state(motion));
        let wheels = ground.reactions_near(&stance, &self.slips(motion), near).ok()?;
        let (soil, moment) =
            dynamics::soil_resultant(&self.rover, forces_of(&wheels), study.own_moments);
        let force = soil + stance.pull;
        let moment = moment + self.rover.centre_of_mass().perp(&stance.pull);
        let left = Vector3::new(force.x, force.y, moment / self.reach);
        Some((left / (self.rover.mass() * study.gravity) + under.unexplained, wheels))
    }

    /// What a soil expects; `None` where it does not carry the rover even at rest.
    ///
    /// * `near`: what a soil that is nearly alike expects, to begin with
    pub(super) fn expected(
        &self,
        study: &HeadingStudy,
        sample: &Sample,
        near: Option<&Expected>,
    ) -> Option<Expected> {
        self.expected_under(study, sample, near, Vector3::zeros())
    }

    /// The same with a force besides those of soil and slope: along the body and to its left, and
    /// the yaw moment at the [`reach`](Self::reach), each over the weight [-].
    pub(super) fn expected_under(
        &self,
        study: &HeadingStudy,
        sample: &Sample,
        near: Option<&Expected>,
        unexplained: Vector3<f64>,
    ) -> Option<Expected> {
        let study = &study.of_sample(sample);
        let under = Under { study, unexplained };
        let mut found = near.and_then(|near| self.balanced_near(under, near));
        if found.is_none() {
            found = self.starts().into_iter().find_map(|at| self.balanced_from(under, at));
        }
        let balance = match found {
            Some(balance) => balance,
            None => self.stuck(under)?,
        };
        Some(self.numbers(study, balance))
    }

    /// Where a balance is sought: at the motion as it was seen, then at lighter and heavier slips.
    fn starts(&self) -> Vec<Vector3<f64>> {
        let mean = self.rim_speeds.iter().sum::<f64>() / self.rim_speeds.len() as f64;
        let lighter = [0.97, 0.85, 0.6, 0.3].map(|share| Vector3::new(share * mean, 0.0, 0.0));
        [self.read()].into_iter().chain(lighter).collect()
    }

    fn balanced_near(&self, under: Under<'_>, near: &Expected) -> Option<Balance> {
        let zero = newton::zero_near(
            |at| {
                let (left, wheels) = self.left_over(under, at, &near.balance.wheels)?;
                Some((left, wheels))
            },
            &near.balance.motion,
            near.balance.inverse?,
            |step| step.norm() / self.fastest(),
            LONGEST,
            |left, _| left.norm() < BALANCED,
        )?;
        let (motion, wheels) = (zero.at, zero.value);
        Some(Balance { motion, wheels, inverse: Some(zero.inverse) })
    }

    /// Newton's method with steps that are halved until less is left over.
    fn balanced_from(&self, under: Under<'_>, mut at: Vector3<f64>) -> Option<Balance> {
        const ROUNDS: usize = 20;
        const HALVINGS: usize = 6;
        let longest = LONGEST * self.fastest();
        let (mut left, mut wheels) = self.left_over(under, &at, &[])?;
        for _ in 0..ROUNDS {
            let inverse = self.stiffness(under, &at, &left, &wheels)?.try_inverse()?;
            if left.norm() < BALANCED {
                return Some(Balance { motion: at, wheels, inverse: Some(inverse) });
            }
            let mut way = -(inverse * left);
            way *= (longest / way.norm()).min(1.0);
            let found = halves(HALVINGS).find_map(|share| {
                let there = at + way * share;
                let (left_there, wheels_there) = self.left_over(under, &there, &wheels)?;
                (left_there.norm() < left.norm()).then_some((there, left_there, wheels_there))
            });
            (at, left, wheels) = found?;
        }
        None
    }

    /// How what is left over changes with the motion [s/m].
    fn stiffness(
        &self,
        under: Under<'_>,
        at: &Vector3<f64>,
        left: &Vector3<f64>,
        wheels: &[WheelReaction],
    ) -> Option<Matrix3<f64>> {
        /// Over the fastest rim: forces turn within a thousandth where wheels hardly slip.
        const STEP: f64 = 1e-4;
        let step = STEP * self.fastest();
        let mut stiffness = Matrix3::zeros();
        for axis in 0..3 {
            let mut there = *at;
            there[axis] += step;
            let (ahead, _) = self.left_over(under, &there, wheels)?;
            stiffness.set_column(axis, &((ahead - left) / step));
        }
        Some(stiffness)
    }

    /// The rover where nothing balances: its wheels turn on the spot.
    fn stuck(&self, under: Under<'_>) -> Option<Balance> {
        let motion = Vector3::zeros();
        let (_, wheels) = self.left_over(under, &motion, &[])?;
        Some(Balance { motion, wheels, inverse: None })
    }

    /// The numbers that go with a balance, as [`seen`](Self::seen) has those that were read.
    fn numbers(&self, study: &HeadingStudy, balance: Balance) -> Expected {
        let mut numbers: Vec<f64> = (balance.motion / self.fastest()).iter().copied().collect();
        for (place, wheel) in balance.wheels.iter().enumerate() {
            if self.torques[place].is_some() {
                numbers.push(wheel.settled.forces.torque / self.torque_scale(study, place));
            }
        }
        for (wheel, read) in balance.wheels.iter().zip(&self.sinkages) {
            if read.is_some() {
                numbers.push(ln(wheel.settled.sinkage.max(SHALLOWEST)));
            }
        }
        Expected { numbers: DVector::from_vec(numbers), balance }
    }

    /// What was read: the motion over the fastest rim's speed, torques over weight times shearing
    /// radius, logarithms of sinkages.
    pub(super) fn seen(&self, study: &HeadingStudy) -> DVector<f64> {
        let motion = self.read() / self.fastest();
        let torques = self
            .torques
            .iter()
            .enumerate()
            .filter_map(|(place, read)| Some((*read)?.value / self.torque_scale(study, place)));
        let sinkages = self.sinkages.iter().flatten().map(|it| ln(it.value.max(SHALLOWEST)));
        DVector::from_vec(motion.iter().copied().chain(torques).chain(sinkages).collect())
    }

    /// What torques are measured by [N·m].
    fn torque_scale(&self, study: &HeadingStudy, wheel: usize) -> f64 {
        self.rover.mounts()[wheel].shearing_radius() * self.rover.mass() * study.gravity
    }

    /// The variances of what was read, and those of a right soil's torques and sinkages, which are
    /// the same over a patch.
    pub(super) fn variances(
        &self,
        study: &HeadingStudy,
        expected: &Expected,
        noise: &ModelNoise,
    ) -> Variances {
        let fastest = self.fastest();
        let read = self.velocities.map(|it| it.deviation);
        let read = [read[0], read[1], read[2] * self.reach];
        let mut all: Vec<[f64; 2]> = read.iter().map(|it| [(it / fastest).powi(2), 0.0]).collect();
        for (place, wheel) in expected.balance.wheels.iter().enumerate() {
            if let Some(read) = self.torques[place] {
                let share = noise.torque_share * wheel.settled.forces.torque;
                let of_model = hypot(share, noise.torque);
                let scale = self.torque_scale(study, place);
                all.push([read.deviation, of_model].map(|it| (it / scale).powi(2)));
            }
        }
        for read in self.sinkages.iter().flatten() {
            let share = read.deviation / read.value.max(SHALLOWEST);
            all.push([share, noise.sinkage].map(|it| it.powi(2)));
        }
        let of = |which: usize| all.iter().map(|it| it[which]).collect::<Vec<f64>>().into();
        Variances { own: of(0), of_patch: of(1) }
    }

    /// Which of the rover's readings each number of an observation is: the motion's, then the
    /// torques of all wheels, then their sinkages.
    pub(super) fn readings(&self) -> Vec<u64> {
        const OF_MOTION: usize = 3;
        let wheels = self.torques.len();
        let of = |first: usize, read: &[Option<Reading>]| {
            let read = read.iter().enumerate().filter(|(_, read)| read.is_some());
            read.map(|(wheel, _)| (first + wheel) as u64).collect::<Vec<u64>>()
        };
        let torques = of(OF_MOTION, &self.torques);
        let sinkages = of(OF_MOTION + wheels, &self.sinkages);
        (0..OF_MOTION as u64).chain(torques).chain(sinkages).collect()
    }

    /// The sign of a force along the body that is against the way of the wheels [-].
    pub(super) fn against(&self) -> f64 {
        if self.rim_speeds.iter().sum::<f64>() < 0.0 { 1.0 } else { -1.0 }
    }

    /// The rims' way of the stretch [m].
    pub(super) fn way(&self) -> f64 {
        self.way
    }

    /// The rover, its wheels steered as they were read.
    pub(super) fn rover(&self) -> &Rover {
        &self.rover
    }

    /// The wheels' torques as they were read [N·m].
    pub(super) fn torques(&self) -> &[Option<Reading>] {
        &self.torques
    }
}

/// A force over the weight that is nothing [-].
const BALANCED: f64 = 1e-7;
/// The longest step towards a balance, over the fastest rim's speed [-].
const LONGEST: f64 = 0.3;
/// Sinkages below this count as this [m].
pub(in crate::studies) const SHALLOWEST: f64 = 1e-4;

/// What a motion balances.
#[derive(Clone, Copy)]
struct Under<'a> {
    study: &'a HeadingStudy,
    /// A force besides those of soil and slope: along the body and to its left, and the yaw moment
    /// at the [`reach`](SeenMotion::reach), each over the weight [-].
    unexplained: Vector3<f64>,
}

/// A motion that leaves neither a force nor a yaw moment over.
#[derive(Clone, Debug)]
struct Balance {
    /// Velocity along the body and to its left, and the speed at the [`reach`](SeenMotion::reach)
    /// that turning makes [m/s].
    motion: Vector3<f64>,
    wheels: Vec<WheelReaction>,
    /// How the motion changes with what is left over [m/s]; `None` where nothing balances.
    inverse: Option<Matrix3<f64>>,
}

/// The variances of an observation's numbers.
#[derive(Clone, Debug)]
pub(super) struct Variances {
    /// Variances of the readings, a stretch's own.
    pub(super) own: DVector<f64>,
    /// What no soil explains of torques and sinkages, the same over a patch of the ground.
    pub(super) of_patch: DVector<f64>,
}

/// What a soil expects of a motion.
#[derive(Clone, Debug)]
pub(super) struct Expected {
    /// Motion over the fastest rim's speed, torques over weight times shearing radius, logarithms
    /// of sinkages.
    pub(super) numbers: DVector<f64>,
    balance: Balance,
}

impl Expected {
    /// The wheels' torques [N·m].
    pub(super) fn torques(&self) -> impl Iterator<Item = f64> {
        self.balance.wheels.iter().map(|it| it.settled.forces.torque)
    }

    /// Whether there is a motion in which forces balance; else the wheels turn on the spot.
    pub(super) fn balances(&self) -> bool {
        self.balance.inverse.is_some()
    }
}

/// 1, ½, ¼, …
pub(super) fn halves(count: usize) -> impl Iterator<Item = f64> {
    std::iter::successors(Some(1.0), |share| Some(0.5 * share)).take(count)
}

/// The rover with its wheels steered as they were read.
pub(in crate::studies) fn steered(rover: &Rover, read: &[Option<f64>]) -> Rover {
    let mounts = rover.mounts().iter().zip(read);
    let angles: Vec<f64> = mounts
        .map(|(mount, read)| {
            let axis = mount.steering_axis.as_ref();
            let within = axis.zip(*read).map(|(axis, it)| it.clamp(-axis.limit, axis.limit));
            within.unwrap_or(mount.steering)
        })
        .collect();
    // Within its limits a rover can be steered.
    rover.steered(&angles).unwrap_or_else(|_| rover.clone())
}
