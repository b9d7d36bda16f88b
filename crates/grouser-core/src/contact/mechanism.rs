//! The wheels of a mechanism that another engine of rigid bodies moves: from their poses and
//! Jacobians to the motion and the effective inverse mass that [`time_step`](super::time_step)
//! needs, and from its forces to wrenches.
//!
//! ```text
//! h° = r_s √(1 − (a · n)²) − d          the lowest point of a circle that leans
//! x = a × n / |a × n|,  y = n × x       the wheel's directions along the ground
//! A = J_u M⁻¹ J_fᵀ                      J_u, J_f: rows of J along (x, y, n; r_s a), (…; x, n)
//! u° = J_u (v − Δt M⁻¹ Jᵀ w)            without the wrenches w that acted in the step that led here
//! ```
//!
//! with axle *a*, normal of the ground *n* and the hub's distance from it *d*, in the world's axes.
//! *M* is the inertia that the engine steps with: of an implicit integrator with its derivatives of
//! forces. After Stewart and Trinkle (1996), as engines of rigid bodies have it.

use nalgebra::{DMatrix, DVector, DVectorView};

use super::forces::WheelForces;
use super::time_step::{FORCES, MOTIONS};
use crate::units::Vec3;

/// A force and a moment, in the world's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench {
    /// Force [N].
    pub force: Vec3,
    /// Moment [N·m].
    pub moment: Vec3,
}

/// A wheel at the end of a preliminary step, in the world's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MountedWheel {
    /// Shearing radius, *r_s* [m].
    pub radius: f64,
    /// Direction of the axle, to the left of a wheel that rolls forward.
    pub axle: Vec3,
    /// From the centre of mass of the wheel's body to its hub [m].
    pub arm: Vec3,
    /// Normal of the ground under it.
    pub normal: Vec3,
    /// Distance of the hub from the ground [m].
    pub distance: f64,
    /// What acted on its body about the centre of mass in the preliminary step.
    pub held: Wrench,
}

/// Wheels that are coupled by what carries them.
#[derive(Clone, Copy, Debug)]
pub struct Mechanism<'a> {
    /// The wheels.
    pub wheels: &'a [MountedWheel],
    /// For each wheel how the velocity of its hub, three rows, and its angular velocity, three
    /// more, follow from the generalised velocities: row by row.
    pub jacobians: &'a [f64],
    /// Inertia, *M*: row by row.
    pub inertia: &'a [f64],
    /// Generalised velocities after the preliminary step, *v*.
    pub velocities: &'a [f64],
    /// Whether overturning and aligning moments act.
    pub with_moments: bool,
}

/// What a step needs of a mechanism: [`time_step`](super::time_step) has its meaning.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// Effective inverse mass, *A* [1/kg, 1/(kg·m)].
    pub inverse_mass: DMatrix<f64>,
    /// Velocities at the end of the step without the soil, *u°* [m/s].
    pub free: DVector<f64>,
    /// Velocities at the end of the preliminary step, J_u v [m/s]: with the wrenches that acted in
    /// it, and so near those at the end of the step.
    pub preliminary: DVector<f64>,
}

impl Response {
    /// Whether all its numbers are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let motions = self.free.iter().chain(self.preliminary.iter());
        self.inverse_mass.iter().chain(motions).all(|number| number.is_finite())
    }
}

/// Rows of a wheel's Jacobian.
const ROWS: usize = 6;

impl MountedWheel {
    /// Sinkage at the end of the preliminary step, *h°* [m].
    #[must_use]
    pub fn sinkage(&self) -> f64 {
        let leaning = self.axle.dot(&self.normal);
        self.radius * (1.0 - (leaning * leaning).min(1.0)).sqrt() - self.distance
    }

    /// Along the wheel, and to its left, on the ground.
    fn directions(&self) -> [Vec3; 2] {
        let forward = self.axle.cross(&self.normal);
        // A wheel that lies flat has no forward direction, and no sinkage either.
        let forward = forward / forward.norm().max(1e-9);
        [forward, self.normal.cross(&forward)]
    }

    /// Directions of each of the forces and moments about the hub; the hub's motion along the first
    /// [`MOTIONS`] is the wheel's.
    fn axes(&self, with_moments: bool) -> [Wrench; FORCES] {
        let [forward, left] = self.directions();
        let of_force = |force| Wrench { force, moment: Vec3::zeros() };
        let of_moment = |moment| Wrench { force: Vec3::zeros(), moment };
        let acting = if with_moments { 1.0 } else { 0.0 };
        [
            of_force(forward),
            of_force(left),
            of_force(self.normal),
            of_moment(self.radius * self.axle),
            of_moment(acting * forward),
            of_moment(acting * self.normal),
        ]
    }

    /// The soil's forces as they act on the wheel's body, about its centre of mass.
    #[must_use]
    pub fn wrench(&self, forces: &WheelForces, with_moments: bool) -> Wrench {
        let [forward, left] = self.directions();
        let force = forces.drawbar_pull * forward
            + forces.side_force * left
            + forces.normal_force * self.normal;
        let mut moment = self.arm.cross(&force) - forces.torque * self.axle;
        if with_moments {
            moment += forces.overturning_moment * forward + forces.aligning_moment * self.normal;
        }
        Wrench { force, moment }
    }
}

impl Mechanism<'_> {
    /// How the wheels' motion follows from the soil's forces; nothing if the inertia is singular,
    /// or the lengths do not fit.
    ///
    /// * `duration`: of the step [s]
    #[must_use]
    pub fn response(&self, duration: f64) -> Option<Response> {
        let (count, size) = (self.wheels.len(), self.velocities.len());
        let lengths = [self.jacobians.len(), self.inertia.len()];
        if lengths != [ROWS * count * size, size * size] {
            return None;
        }
        // A column for each force of each wheel, and one for all that acted in the preliminary
        // step.
        let mut sides = DMatrix::zeros(size, FORCES * count + 1);
        for (place, wheel) in self.wheels.iter().enumerate() {
            for (force, axis) in wheel.axes(self.with_moments).iter().enumerate() {
                let column = self.generalised(place, axis);
                sides.set_column(FORCES * place + force, &column);
            }
            let Wrench { force, moment } = wheel.held;
            let held = Wrench { force, moment: moment - wheel.arm.cross(&force) };
            let mut last = sides.column_mut(FORCES * count);
            last += self.generalised(place, &held);
        }
        let motions = DMatrix::from_fn(MOTIONS * count, size, |row, column| {
            sides[(column, FORCES * (row / MOTIONS) + row % MOTIONS)]
        });
        let inertia = DMatrix::from_row_slice(size, size, self.inertia);
        let response = &motions * inertia.lu().solve(&sides)?;
        let velocities = DVectorView::from_slice(self.velocities, size);
        let preliminary = motions * velocities;
        let free = &preliminary - duration * response.column(FORCES * count);
        let inverse_mass = response.columns(0, FORCES * count).into_owned();
        Some(Response { inverse_mass, free, preliminary })
    }

    /// A force and a moment about a wheel's hub as generalised forces.
    fn generalised(&self, place: usize, wrench: &Wrench) -> DVector<f64> {
        let size = self.velocities.len();
        let rows = self.jacobians[ROWS * size * place..].chunks_exact(size.max(1)).take(ROWS);
        let parts = wrench.force.iter().chain(wrench.moment.iter());
        let mut all = DVector::zeros(size);
        for (row, part) in rows.zip(parts).filter(|(_, part)| **part != 0.0) {
            all.axpy(*part, &DVectorView::from_slice(row, size), 1.0);
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A free body of 2 kg whose hub is its centre of mass: its velocity, then its angular
    /// velocity.
    fn free_body(wheel: MountedWheel, velocities: &[f64; 6]) -> Response {
        let unit = DMatrix::<f64>::identity(6, 6);
        let inertia =
            DMatrix::from_diagonal(&DVector::from_row_slice(&[2.0, 2.0, 2.0, 0.1, 0.2, 0.1]));
        let mechanism = Mechanism {
            wheels: &[wheel],
            jacobians: unit.as_slice(),
            inertia: inertia.as_slice(),
            velocities,
            with_moments: true,
        };
        mechanism.response(0.01).expect("it has an inertia")
    }

    fn upright() -> MountedWheel {
        MountedWheel {
            radius: 0.1,
            axle: Vec3::y(),
            arm: Vec3::zeros(),
            normal: Vec3::z(),
            distance: 0.08,
            held: Wrench { force: Vec3::zeros(), moment: Vec3::zeros() },
        }
    }

    #[test]
    fn a_free_wheel_moves_as_newton_says() {
        let Response { inverse_mass, free, preliminary } =
            free_body(upright(), &[0.3, 0.1, -0.2, 0.0, 5.0, 0.0]);
        assert_eq!(free.as_slice(), [0.3, 0.1, -0.2, 0.5]);
        assert_eq!(preliminary, free, "nothing acted before");
        let diagonal: Vec<f64> =
            (0..MOTIONS).map(|motion| inverse_mass[(motion, motion)]).collect();
        // 1/m along the axes, and r_s²/I for the rim.
        for (found, expected) in diagonal.iter().zip([0.5, 0.5, 0.5, 0.01 / 0.2]) {
            assert!((found - expected).abs() < 1e-15, "{found}, not {expected}");
        }
        assert!((upright().sinkage() - 0.02).abs() < 1e-15);
    }

    #[test]
    fn what_acted_before_is_taken_back() {
        let held = Wrench { force: Vec3::new(4.0, 0.0, 0.0), moment: Vec3::new(0.0, 2.0, 0.0) };
        let Response { free, preliminary, .. } =
            free_body(MountedWheel { held, ..upright() }, &[0.0; 6]);
        assert_eq!(preliminary.as_slice(), [0.0; MOTIONS]);
        // −Δt F/m, and −Δt M r_s/I.
        assert!((free[0] + 0.01 * 4.0 / 2.0).abs() < 1e-15);
        assert!((free[3] + 0.01 * 2.0 * 0.1 / 0.2).abs() < 1e-15);
    }

    #[test]
    fn forces_act_along_the_wheel_and_about_its_centre_of_mass() {
        let wheel = MountedWheel { arm: Vec3::new(0.0, 0.5, 0.0), ..upright() };
        let forces = WheelForces {
            drawbar_pull: 3.0,
            side_force: 2.0,
            normal_force: 10.0,
            torque: 0.4,
            overturning_moment: 0.1,
            aligning_moment: 0.2,
            ..WheelForces::default()
        };
        let Wrench { force, moment } = wheel.wrench(&forces, true);
        assert_eq!(force, Vec3::new(3.0, 2.0, 10.0));
        // The arm lifts M_x by 0.5 · 10 and lowers M_z by 0.5 · 3; a driving torque turns the body
        // backward.
        assert!((moment - Vec3::new(5.1, -0.4, -1.3)).norm() < 1e-15, "{moment}");
        let without = wheel.wrench(&forces, false).moment;
        assert!((without - Vec3::new(5.0, -0.4, -1.5)).norm() < 1e-15, "{without}");
    }
}
