//! How a rover stands on uneven ground, and how its wheels move there.
//!
//! Where its body is, seen from above, and where its nose points are given; height, roll, pitch and
//! the angles of the joints follow from the ground: every wheel stands on the mean plane of its
//! footprint, or is sunk into it. Then a motion of the body along its own x and y axes and about
//! its z axis lifts, rolls and pitches it as the ground does, so that no hub moves along the normal
//! of its ground:
//!
//! ```text
//! gap_i = (P_i − p_i) · n_i − r_s √(1 − (a_i · n_i)²) = −h_i        v_i · n_i = 0
//! v_i = u e_x + v e_y + w e_z + (p e_x + q e_y + r e_z) × d_i + Σ joint rates
//! ```
//!
//! with hub *P*, *d* seen from the body's centre of mass, axle *a*, the plane's point *p* and
//! normal *n* below the hub, and the body's axes *e*. On a plane, w, p, q and the joint rates are
//! zero, and this is the rigid rover's motion along it.
//!
//! A rover with more wheels than its freedoms can bring to the ground stands on their mean plane
//! (least squares of the gaps); a rigid one with four wheels leaves [`Posture::warp`].

use nalgebra::{DMatrix, DVector, Matrix3, Rotation3};

use super::links::{Carried, Hinge};
use super::rover::Rover;
use super::state::RoverState;
use super::suspension::{Joints, Suspension};
use crate::elementary::wide::{acos, atan2, cos, sin_cos};
use crate::terrain::{Footprint, Terrain};
use crate::units::{Vec2, Vec3};

/// A rover as it stands on the ground, in the ground's coordinates.
#[derive(Clone, Debug)]
pub struct Posture {
    /// The body's centre of mass [m].
    pub place: Vec3,
    /// Roll, *φ* [rad]: positive with the right side down.
    pub roll: f64,
    /// Pitch, *θ* [rad]: positive with the nose up.
    pub pitch: f64,
    /// The joints.
    pub joints: Joints,
    /// The rotation from the body's frame to the ground's coordinates.
    pub ground_from_body: Rotation3<f64>,
    /// Its wheels, in the mounts' order.
    pub wheels: Vec<StandingWheel>,
    /// How many joints it has.
    joint_count: usize,
}

/// How a rover's body stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attitude {
    /// Height of the body's centre of mass, in the ground's coordinates [m].
    pub height: f64,
    /// Roll, *φ* [rad]: positive with the right side down.
    pub roll: f64,
    /// Pitch, *θ* [rad]: positive with the nose up.
    pub pitch: f64,
    /// The joints.
    pub joints: Joints,
}

impl Attitude {
    /// How far the body's z axis is from the vertical [rad].
    #[must_use]
    pub fn tilt(&self) -> f64 {
        let (level_across, level_along) = (cos(self.roll), cos(self.pitch));
        acos(level_across * level_along)
    }
}

/// A wheel on its piece of ground, in the ground's coordinates.
#[derive(Clone, Debug)]
pub struct StandingWheel {
    /// Its hub, seen from the body's centre of mass [m].
    pub hub: Vec3,
    /// Direction of its axle, to the left.
    pub axle: Vec3,
    /// Along the wheel, on the ground.
    pub forward: Vec3,
    /// To its left, on the ground.
    pub left: Vec3,
    /// Out of the ground.
    pub normal: Vec3,
    /// Distance of its lowest point from the ground [m], negative where it is sunk.
    pub gap: f64,
    /// Where it meets the ground, seen from above [m].
    pub at: Vec2,
    /// The ground that counts for it.
    pub footprint: Footprint,
    /// The joints that carry it: which, the axis with the sense of a positive angle, and a point of
    /// it seen from the body's centre of mass [m].
    joints: Vec<(usize, Vec3, Vec3)>,
}

/// A small motion of a wheel: of its hub, and about it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Twist {
    pub(super) linear: Vec3,
    pub(super) angular: Vec3,
}

impl Twist {
    /// The work of a force on the hub and a moment about it.
    pub(super) fn work_of(&self, force: &Vec3, moment: &Vec3) -> f64 {
        force.dot(&self.linear) + moment.dot(&self.angular)
    }
}

/// How a rover on uneven ground moves.
#[derive(Clone, Debug, PartialEq)]
pub struct StandingMotion {
    /// Velocity of the body's centre of mass, in the ground's coordinates [m/s].
    pub velocity: Vec3,
    /// How fast its yaw changes, seen from above [rad/s].
    pub yaw_rate: f64,
    /// How fast the body turns about its own z axis [rad/s].
    pub body_rate: f64,
    /// Velocity of each hub along its wheel, and to the wheel's left, on the ground [m/s].
    pub hubs: Vec<Vec2>,
    /// How fast the link that carries each wheel turns about its axle [rad/s]: by so much more than
    /// its motor turns it on the link it turns on the ground.
    pub turns: Vec<f64>,
    /// Velocity of each hub out of the ground, where that makes its wheel sink or rise [m/s].
    pub rises: Vec<f64>,
    /// How fast each wheel turns about its forward axis, and about the normal of its ground
    /// [rad/s].
    pub leans: Vec<Vec2>,
}

/// No posture was found.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("at {x:.3} m, {y:.3} m the wheels do not come to stand: gaps of {gap:.1e} m \
         remain", x = place.x, y = place.y)]
pub struct NoPosture {
    /// Where that is, seen from above [m].
    pub place: Vec2,
    /// The last change of a gap [m].
    pub gap: f64,
}

/// Freedoms of the body: height, and two rotations.
pub(super) const OF_BODY: usize = 3;

impl Posture {
    /// The posture of a rover with its body at a place, its nose in a direction and its wheels
    /// sunk.
    ///
    /// * `place`: below the body's centre of mass [m]
    /// * `yaw`: of the nose, seen from above, from x towards y [rad]
    /// * `sinkages`: of each wheel [m]
    ///
    /// # Errors
    /// [`NoPosture`] where the wheels do not come to stand.
    pub fn of(
        rover: &Rover,
        terrain: &dyn Terrain,
        place: Vec2,
        yaw: f64,
        sinkages: &[f64],
    ) -> Result<Self, NoPosture> {
        let level = Attitude::level_with(rover, terrain, place, yaw);
        Self::sought(rover, terrain, (place, yaw), sinkages, level, None)
    }

    /// Does what [`of`](Self::of) does, sought from this posture nearby: the answer is the same but
    /// for its last digits.
    ///
    /// # Errors
    /// The same as [`of`](Self::of).
    pub fn near(
        &self,
        rover: &Rover,
        terrain: &dyn Terrain,
        place: Vec2,
        yaw: f64,
        sinkages: &[f64],
    ) -> Result<Self, NoPosture> {
        let normals = self.wheels.iter().map(|wheel| wheel.normal).collect();
        let pose = self.attitude();
        Self::sought(rover, terrain, (place, yaw), sinkages, pose, Some(normals))
            .or_else(|_| Self::of(rover, terrain, place, yaw, sinkages))
    }

    /// Searches from a pose.
    ///
    /// * `normals`: of the ground under each wheel, if known
    fn sought(
        rover: &Rover,
        terrain: &dyn Terrain,
        (place, yaw): (Vec2, f64),
        sinkages: &[f64],
        mut pose: Attitude,
        mut normals: Option<Vec<Vec3>>,
    ) -> Result<Self, NoPosture> {
        /// Changes below this end the search [m]; rounding of map coordinates of 10⁴ km is a
        /// thousandth of it.
        const SETTLED: f64 = 1e-12;
        const MOST_STEPS: usize = 60;
        let scale = rover.centre_height();
        let mut change = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let posture = pose.on(rover, terrain, place, yaw, normals.as_deref());
            let Some(step) = posture.step_to(sinkages, yaw) else { break };
            let before = change;
            change = step.iter().enumerate().fold(0.0, |most: f64, (freedom, by)| {
                most.max(if freedom == 0 { by.abs() } else { scale * by.abs() })
            });
            // Rounding ends it where it goes no further.
            if change <= SETTLED || change < 1e3 * SETTLED && change >= 0.5 * before {
                return Ok(posture);
            }
            normals = Some(posture.wheels.iter().map(|wheel| wheel.normal).collect());
            pose.move_by(&step);
        }
        Err(NoPosture { place, gap: change })
    }

    /// How the body stands.
    #[must_use]
    pub fn attitude(&self) -> Attitude {
        let Self { place, roll, pitch, joints, .. } = *self;
        Attitude { height: place.z, roll, pitch, joints }
    }

    /// The body's x, y and z axes.
    #[must_use]
    pub fn axes(&self) -> [Vec3; 3] {
        [0, 1, 2].map(|axis| self.ground_from_body.matrix().column(axis).into_owned())
    }

    /// By how much the ground under wheel after wheel is warped against the plane that they stand
    /// on [m]: their gaps and sinkages together, which no posture of a rigid rover closes.
    ///
    /// * `sinkages`: of each wheel [m]
    #[must_use]
    pub fn warp(&self, sinkages: &[f64]) -> Vec<f64> {
        self.wheels.iter().zip(sinkages).map(|(wheel, sinkage)| wheel.gap + sinkage).collect()
    }

    /// How it moves.
    ///
    /// * `state`: of which the velocities count: along the body's x and y axes, and about its z
    ///   axis
    ///
    /// # Errors
    /// [`NoPosture`] where the wheels allow no motion along the ground.
    pub fn motion(&self, state: &RoverState) -> Result<StandingMotion, NoPosture> {
        let [x, y, z] = self.axes();
        let given = state.velocity.x * x + state.velocity.y * y;
        let turning = state.yaw_rate * z;
        let free = |wheel: &StandingWheel| given + turning.cross(&wheel.hub);
        let approach = self.wheels.iter().map(|wheel| -free(wheel).dot(&wheel.normal));
        let rates = least_squares(
            &self.along_normals([z, x, y], Vec3::zeros()),
            &DVector::from_iterator(self.wheels.len(), approach),
        );
        let lost = NoPosture { place: self.place.xy(), gap: f64::INFINITY };
        let rates = rates.ok_or(lost)?;
        let (mut hubs, mut turns) = (Vec::new(), Vec::new());
        let (mut rises, mut leans) = (Vec::new(), Vec::new());
        for wheel in &self.wheels {
            let (mut velocity, mut turned) = (free(wheel), turning);
            for (twist, rate) in self.twists(wheel, [z, x, y], Vec3::zeros()).zip(rates.iter()) {
                velocity += *rate * twist.linear;
                turned += *rate * twist.angular;
            }
            hubs.push(Vec2::new(velocity.dot(&wheel.forward), velocity.dot(&wheel.left)));
            turns.push(turned.dot(&wheel.axle));
            rises.push(velocity.dot(&wheel.normal));
            leans.push(Vec2::new(turned.dot(&wheel.forward), turned.dot(&wheel.normal)));
        }
        let velocity = given + rates[0] * z;
        let nose = (turning + rates[1] * x + rates[2] * y).cross(&x);
        let yaw_rate = x.xy().perp(&nose.xy()) / x.xy().norm_squared();
        let body_rate = state.yaw_rate;
        Ok(StandingMotion { velocity, yaw_rate, body_rate, hubs, turns, rises, leans })
    }

    /// The same of a body whose yaw, seen from above, changes at a rate [rad/s], which is linear in
    /// the body's own.
    ///
    /// # Errors
    /// The same as [`motion`](Self::motion).
    pub fn motion_at_yaw_rate(
        &self,
        state: &RoverState,
        yaw_rate: f64,
    ) -> Result<StandingMotion, NoPosture> {
        let at = |body_rate: f64| self.motion(&RoverState { yaw_rate: body_rate, ..*state });
        let (still, turning) = (at(0.0)?.yaw_rate, at(1.0)?.yaw_rate);
        let motion = at((yaw_rate - still) / (turning - still))?;
        // But for rounding it is so already.
        Ok(StandingMotion { yaw_rate, ..motion })
    }

    /// What the freedoms do to a wheel: the body's, then those of the joints.
    ///
    /// * `body`: the direction in which its height is counted, and the two axes about which it
    ///   turns
    /// * `centre`: through which these axes go, seen from the body's centre of mass [m]
    pub(super) fn twists<'a>(
        &'a self,
        wheel: &'a StandingWheel,
        body: [Vec3; OF_BODY],
        centre: Vec3,
    ) -> impl Iterator<Item = Twist> + 'a {
        let turned = move |axis: Vec3, centre: Vec3| Twist {
            linear: axis.cross(&(wheel.hub - centre)),
            angular: axis,
        };
        let [up, one, other] = body;
        let height = Twist { linear: up, angular: Vec3::zeros() };
        let of_body = [height, turned(one, centre), turned(other, centre)];
        let of_joint = move |joint: usize| {
            let carrying = wheel.joints.iter().find(|(which, ..)| *which == joint);
            match carrying {
                Some((_, axis, through)) => turned(*axis, *through),
                None => Twist { linear: Vec3::zeros(), angular: Vec3::zeros() },
            }
        };
        of_body.into_iter().chain((0..self.joint_count).map(of_joint))
    }

    /// How many freedoms it has: the body's and the joints'.
    pub(super) fn freedoms(&self) -> usize {
        OF_BODY + self.joint_count
    }

    /// How far each freedom, a column, moves each hub along its normal, a row.
    fn along_normals(&self, body: [Vec3; OF_BODY], centre: Vec3) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(self.wheels.len(), self.freedoms());
        for (row, wheel) in self.wheels.iter().enumerate() {
            for (column, twist) in self.twists(wheel, body, centre).enumerate() {
                matrix[(row, column)] = twist.linear.dot(&wheel.normal);
            }
        }
        matrix
    }

    /// The next step of the search for a posture: of height, roll, pitch and joints.
    fn step_to(&self, sinkages: &[f64], yaw: f64) -> Option<Vec<f64>> {
        let [x, ..] = self.axes();
        let (sin, cos) = sin_cos(yaw);
        // A nose that rises turns about the axis to the right.
        let body = [Vec3::z(), x, Vec3::new(sin, -cos, 0.0)];
        let matrix = self.along_normals(body, Vec3::zeros());
        let misses = self.warp(sinkages);
        let step = least_squares(&matrix, &-DVector::from_vec(misses))?;
        step.iter().all(|by| by.is_finite()).then(|| step.iter().copied().collect())
    }
}

impl Attitude {
    /// Returns the attitude of a rover on the mean plane below all of it.
    fn level_with(rover: &Rover, terrain: &dyn Terrain, place: Vec2, yaw: f64) -> Self {
        let (sin, cos) = sin_cos(yaw);
        let nose =
            nalgebra::Rotation2::from_matrix_unchecked(nalgebra::Matrix2::new(cos, -sin, sin, cos));
        let patch = terrain.patch(place, rover.footprint(&nose));
        let normal = patch.normal;
        let rise = -(normal.x * cos + normal.y * sin) / normal.z;
        let forward = Vec3::new(cos, sin, rise).normalize();
        let left = normal.cross(&forward);
        let over = rover.centre_height() / normal.z;
        Self {
            height: patch.height + over,
            roll: atan2(left.z, normal.z),
            pitch: atan2(rise, 1.0),
            joints: Joints::default(),
        }
    }

    fn move_by(&mut self, step: &[f64]) {
        self.height += step[0];
        self.roll += step[1];
        self.pitch += step[2];
        self.joints = self.joints.moved(&step[OF_BODY..]);
    }

    /// The rover so, and the ground under its wheels.
    ///
    /// * `normals`: of the ground under each wheel, as far as known
    fn on(
        &self,
        rover: &Rover,
        terrain: &dyn Terrain,
        place: Vec2,
        yaw: f64,
        normals: Option<&[Vec3]>,
    ) -> Posture {
        let Self { height, roll, pitch, joints } = *self;
        let ground_from_body = attitude(yaw, pitch, roll);
        let place = Vec3::new(place.x, place.y, height);
        let (mounts, suspension) = (rover.mounts(), rover.suspension());
        let up = ground_from_body * Vec3::z();
        let across = ground_from_body * -Vec3::y();
        let wheel = |(number, mount): (usize, &super::parts::Mount)| {
            let carried = Carried::of(suspension, mount, mounts, &joints);
            let (hub, axle) = (ground_from_body * carried.hub, ground_from_body * carried.axle);
            let radius = mount.shearing_radius();
            let known = normals.map_or(up, |normals| normals[number]);
            let at = (place + hub - radius * known).xy();
            let footprint = Footprint::of_wheel(axle, radius, mount.unit.wheel.width);
            let patch = terrain.patch(at, footprint);
            let normal = patch.normal;
            let leaning = axle.dot(&normal);
            let lowest = radius * (1.0 - (leaning * leaning).min(1.0)).sqrt();
            let over = place + hub - Vec3::new(at.x, at.y, patch.height);
            let forward = axle.cross(&normal);
            let forward = forward / forward.norm().max(1e-9);
            let hinge = |it: &Hinge| (it.joint, it.sense * across, ground_from_body * it.pivot);
            StandingWheel {
                hub,
                axle,
                forward,
                left: normal.cross(&forward),
                normal,
                gap: over.dot(&normal) - lowest,
                at,
                footprint,
                joints: carried.hinges.iter().map(hinge).collect(),
            }
        };
        Posture {
            place,
            roll,
            pitch,
            joints,
            ground_from_body,
            wheels: mounts.iter().enumerate().map(wheel).collect(),
            joint_count: suspension.map_or(0, Suspension::joint_count),
        }
    }
}

/// The rotation from the body's frame to the ground's coordinates, by yaw, pitch and roll [rad].
fn attitude(yaw: f64, pitch: f64, roll: f64) -> Rotation3<f64> {
    let ((sy, cy), (sp, cp), (sr, cr)) = (sin_cos(yaw), sin_cos(pitch), sin_cos(roll));
    let turn = Matrix3::new(cy, -sy, 0.0, sy, cy, 0.0, 0.0, 0.0, 1.0);
    let nose_up = Matrix3::new(cp, 0.0, -sp, 0.0, 1.0, 0.0, sp, 0.0, cp);
    let left_up = Matrix3::new(1.0, 0.0, 0.0, 0.0, cr, -sr, 0.0, sr, cr);
    Rotation3::from_matrix_unchecked(turn * nose_up * left_up)
}

/// The vector of which a matrix comes nearest to a right-hand side; none where that is not one
/// vector.
fn least_squares(matrix: &DMatrix<f64>, side: &DVector<f64>) -> Option<DVector<f64>> {
    if matrix.is_square() {
        return matrix.clone().lu().solve(side);
    }
    let transposed = matrix.transpose();
    (&transposed * matrix).lu().solve(&(transposed * side))
}
