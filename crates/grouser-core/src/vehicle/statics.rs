//! Loads of wheels on uneven ground: the balance of every freedom of a rover that stands as its
//! suspension lets it.
//!
//! The soil's forces along the ground and its moments are given; sought are the forces along the
//! normals, *N*. Whatever freedom *k* is moved, all forces together do no work (d'Alembert), with
//! the weight and the inertia at the common centre of mass, which accelerates along the body's x
//! and y axes:
//!
//! ```text
//! Σ f_i · v_ik + Σ m_i · ω_ik − Σ μ_j F · v_jk = 0        f_i = N_i n_i + t_i        F = Σ f_i
//! ```
//!
//! with the twists (v, ω) of [`Posture`], the moment *m* that a wheel passes on to its hub, its
//! torque first, and the share *μ* that a part has of the mass: for height, Σ F · e_z balances the
//! weight; for roll and pitch, moments about the common centre of mass vanish; for rockers and
//! bogies, those about their axes, wheels' weights included.
//!
//! A rover on rockers, with or without bogies, or on three wheels has as many freedoms as wheels. A
//! rigid one with more has the loads of least norm, as on a plane. Links weigh nothing but their
//! wheels.

use nalgebra::{DMatrix, DVector, SVector};

use super::load::{LoadSharing, OwnMoments, Tipping};
use super::posture::{OF_BODY, Posture, StandingWheel, Twist};
use super::rover::Rover;
use crate::contact::WheelForces;
use crate::units::Vec3;

/// The soil's forces on a rover, about its body's centre of mass, in the body frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resultant {
    /// Force [N].
    pub force: Vec3,
    /// Moment [N·m].
    pub moment: Vec3,
}

/// What carries the moments of a wheel's forces.
#[derive(Clone, Copy, Debug)]
pub struct Balance {
    /// Whether the wheels' torque is in the balances, or their forces act in the ground.
    pub sharing: LoadSharing,
    /// Whether the wheels' own overturning and aligning moments act.
    pub own_moments: OwnMoments,
}

impl Balance {
    /// Force along the ground [N] and moment about the hub [N·m] of a wheel, in the ground's
    /// coordinates.
    fn along(self, wheel: &StandingWheel, radius: f64, forces: &WheelForces) -> (Vec3, Vec3) {
        let force = forces.drawbar_pull * wheel.forward + forces.side_force * wheel.left;
        let torque = if self.sharing.has_torque() {
            -forces.torque * wheel.axle
        } else {
            -radius * forces.drawbar_pull * wheel.left
        };
        let own = match self.own_moments {
            OwnMoments::Included => {
                forces.overturning_moment * wheel.forward + forces.aligning_moment * wheel.normal
            }
            // A side force in the ground.
            OwnMoments::Neglected => radius * forces.side_force * wheel.forward,
        };
        (force, torque + own)
    }

    /// Loads that balance a rover, in the mounts' order [N]; negative where a wheel would have to
    /// be held down.
    ///
    /// * `weight`: m g, against gravity, in the ground's coordinates [N]
    /// * `forces`: the soil's, of which those along the ground and the moments count; none for
    ///   wheels that only stand
    ///
    /// # Errors
    /// [`Tipping`] where no loads balance it.
    pub fn loads(
        self,
        rover: &Rover,
        posture: &Posture,
        weight: Vec3,
        forces: &[WheelForces],
    ) -> Result<Vec<f64>, Tipping> {
        if self.sharing == LoadSharing::Uniform {
            let into = weight.dot(&posture.axes()[2]);
            return Ok(vec![into / posture.wheels.len() as f64; posture.wheels.len()]);
        }
        let (matrix, side) =
            self.equations(&ways(rover, posture), (rover, posture), weight, forces);
        least_norm(&matrix, &side).ok_or(Tipping)
    }

    /// How the loads of least norm follow from the forces along the ground, which is linear while
    /// the rover stands so; none where no loads balance it, and where forces move none.
    ///
    /// * `weight`: as for [`loads`](Self::loads)
    pub(super) fn transfer(
        self,
        rover: &Rover,
        posture: &Posture,
        weight: Vec3,
    ) -> Option<Transfer> {
        if self.sharing == LoadSharing::Uniform {
            return None;
        }
        let ways = ways(rover, posture);
        let (matrix, side) = self.equations(&ways, (rover, posture), weight, &[]);
        let inverse = right_inverse(&matrix)?;
        let each = posture.wheels.iter().zip(rover.mounts()).zip(ways);
        let by_forces = each.map(|((wheel, mount), ways)| {
            let of_unit = |unit: &WheelForces| {
                let (force, moment) = self.along(wheel, mount.shearing_radius(), unit);
                let work = ways.iter().map(|way| -way.work_of(&force, &moment));
                &inverse * DVector::from_iterator(ways.len(), work)
            };
            DMatrix::from_columns(&units().each_ref().map(of_unit))
        });
        let by_forces = by_forces.collect();
        Some(Transfer { of_weight: inverse * side, by_forces })
    }

    /// Loads of least norm that balance a rigid rover on the wheels that are left when one is
    /// lifted, in the mounts' order [N]. In the lifted wheel's place is the load that it would have
    /// as one of them: where that is negative, it would have to be held down.
    ///
    /// None where the others do not balance the rover, and none for a rover with as many freedoms
    /// as wheels.
    ///
    /// * `weight`, `forces`: as for [`loads`](Self::loads)
    pub(super) fn loads_on_others(
        self,
        rover: &Rover,
        posture: &Posture,
        weight: Vec3,
        forces: &[WheelForces],
        lifted: usize,
    ) -> Option<Vec<f64>> {
        if self.sharing == LoadSharing::Uniform || posture.freedoms() >= posture.wheels.len() {
            return None;
        }
        let (matrix, side) =
            self.equations(&ways(rover, posture), (rover, posture), weight, forces);
        let mut others = matrix.clone();
        others.column_mut(lifted).fill(0.0);
        let solved = (&others * others.transpose()).lu().solve(&side)?;
        let loads = matrix.transpose() * solved;
        loads.iter().all(|load| load.is_finite()).then(|| loads.iter().copied().collect())
    }

    /// What each wheel's load does in the balance of each freedom, a row, and what the loads
    /// together have to do there.
    ///
    /// * `ways`: how each wheel moves with each freedom
    fn equations(
        self,
        ways: &[Vec<Twist>],
        (rover, posture): (&Rover, &Posture),
        weight: Vec3,
        forces: &[WheelForces],
    ) -> (DMatrix<f64>, DVector<f64>) {
        let mut matrix = DMatrix::zeros(posture.freedoms(), posture.wheels.len());
        let mut side = DVector::zeros(posture.freedoms());
        side[0] = weight.dot(&posture.axes()[2]);
        let still = WheelForces::default();
        let each = posture.wheels.iter().zip(rover.mounts()).zip(ways);
        for (column, ((wheel, mount), ways)) in each.enumerate() {
            let forces = forces.get(column).unwrap_or(&still);
            let (force, moment) = self.along(wheel, mount.shearing_radius(), forces);
            for (row, way) in ways.iter().enumerate() {
                matrix[(row, column)] = wheel.normal.dot(&way.linear);
                side[row] -= way.work_of(&force, &moment);
            }
        }
        (matrix, side)
    }

    /// The soil's forces together.
    ///
    /// * `forces`: of each wheel
    #[must_use]
    pub fn resultant(self, rover: &Rover, posture: &Posture, forces: &[WheelForces]) -> Resultant {
        let (mut force, mut moment) = (Vec3::zeros(), Vec3::zeros());
        for ((wheel, mount), forces) in posture.wheels.iter().zip(rover.mounts()).zip(forces) {
            let (along, own) = self.along(wheel, mount.shearing_radius(), forces);
            let all = along + forces.normal_force * wheel.normal;
            force += all;
            moment += wheel.hub.cross(&all) + own;
        }
        let body = posture.ground_from_body;
        Resultant { force: body.inverse() * force, moment: body.inverse() * moment }
    }
}

/// How each wheel moves against the common centre of mass with each freedom.
fn ways(rover: &Rover, posture: &Posture) -> Vec<Vec<Twist>> {
    let centre = centre_of_mass(rover, posture);
    let [x, y, z] = posture.axes();
    let twists = |wheel| posture.twists(wheel, [z, x, y], centre);
    // Links: what all wheels' share of the acceleration and the weight takes of each force.
    let mut carried = vec![Vec3::zeros(); posture.freedoms()];
    for (wheel, mount) in posture.wheels.iter().zip(rover.mounts()) {
        let share = mount.unit.mass / rover.mass();
        for (sum, twist) in carried.iter_mut().zip(twists(wheel)).skip(OF_BODY) {
            *sum += share * twist.linear;
        }
    }
    let against = |(twist, carried): (Twist, &Vec3)| Twist {
        linear: twist.linear - carried,
        angular: twist.angular,
    };
    posture.wheels.iter().map(|wheel| twists(wheel).zip(&carried).map(against).collect()).collect()
}

/// How loads follow from forces while a rover stands as it does.
pub(super) struct Transfer {
    /// Of wheels that only stand [N].
    of_weight: DVector<f64>,
    /// For each wheel, what one of each of its [`parts`] adds to all loads.
    by_forces: Vec<DMatrix<f64>>,
}

impl Transfer {
    /// Loads of least norm of wheels that only stand [N].
    pub(super) fn of_weight(&self) -> &DVector<f64> {
        &self.of_weight
    }

    /// What a wheel's forces add to all loads [N].
    pub(super) fn of(&self, wheel: usize, forces: &WheelForces) -> DVector<f64> {
        &self.by_forces[wheel] * SVector::from(parts(forces))
    }
}

/// The forces of a wheel that move loads [N, N·m].
fn parts(forces: &WheelForces) -> [f64; 5] {
    let WheelForces {
        drawbar_pull, side_force, torque, overturning_moment, aligning_moment, ..
    } = *forces;
    [drawbar_pull, side_force, torque, overturning_moment, aligning_moment]
}

/// One of each of them.
fn units() -> [WheelForces; 5] {
    let none = WheelForces::default();
    [
        WheelForces { drawbar_pull: 1.0, ..none },
        WheelForces { side_force: 1.0, ..none },
        WheelForces { torque: 1.0, ..none },
        WheelForces { overturning_moment: 1.0, ..none },
        WheelForces { aligning_moment: 1.0, ..none },
    ]
}

/// The common centre of mass of body and wheels, seen from the body's, in the ground's coordinates
/// [m].
#[must_use]
pub fn centre_of_mass(rover: &Rover, posture: &Posture) -> Vec3 {
    let wheels = posture.wheels.iter().zip(rover.mounts());
    wheels.map(|(wheel, mount)| wheel.hub * (mount.unit.mass / rover.mass())).sum()
}

/// The shortest vector with these balances; none where no vector has them.
fn least_norm(matrix: &DMatrix<f64>, side: &DVector<f64>) -> Option<Vec<f64>> {
    let transposed = matrix.transpose();
    let shortest = if matrix.is_square() {
        matrix.clone().lu().solve(side)?
    } else {
        &transposed * (matrix * &transposed).lu().solve(side)?
    };
    shortest.iter().all(|load| load.is_finite()).then(|| shortest.iter().copied().collect())
}

/// The matrix that makes of balances the shortest vector that has them; none where some have none.
fn right_inverse(matrix: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let inverse = if matrix.is_square() {
        matrix.clone().try_inverse()?
    } else {
        let transposed = matrix.transpose();
        let square = (matrix * &transposed).try_inverse()?;
        transposed * square
    };
    inverse.iter().all(|part| part.is_finite()).then_some(inverse)
}
