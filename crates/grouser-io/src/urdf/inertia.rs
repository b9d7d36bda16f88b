//! What links weigh together, and whether that is a measurement at all.

use nalgebra::{Matrix3, Vector3};

use super::tree::Robot;

/// Mass [kg], centre of mass in the root's frame [m], and inertia about that along the root's axes
/// [kg m²].
#[derive(Clone, Copy, Debug)]
pub(super) struct Together {
    pub(super) mass: f64,
    pub(super) centre: Vector3<f64>,
    pub(super) inertia: Matrix3<f64>,
}

impl Together {
    /// Links as one body.
    pub(super) fn of(robot: &Robot, links: impl Iterator<Item = usize> + Clone) -> Self {
        let parts = links.filter_map(|link| {
            let inertial = robot.links[link].inertial?;
            let placed = robot.links[link].frame * inertial.origin;
            let turn = placed.rotation.to_rotation_matrix();
            let inertia = turn.matrix() * inertial.inertia * turn.matrix().transpose();
            Some((inertial.mass, placed.translation.vector, inertia))
        });
        let mass: f64 = parts.clone().map(|(mass, ..)| mass).sum();
        let moment: Vector3<f64> = parts.clone().map(|(mass, at, _)| mass * at).sum();
        let centre = if mass > 0.0 { moment / mass } else { Vector3::zeros() };
        let about = |(mass, at, inertia): (f64, Vector3<f64>, Matrix3<f64>)| {
            inertia + parallel_axis(mass, at - centre)
        };
        Self { mass, centre, inertia: parts.map(about).sum() }
    }

    /// The inertia about another point.
    ///
    /// * `point`: in the root's frame [m]
    pub(super) fn inertia_about(&self, point: Vector3<f64>) -> Matrix3<f64> {
        self.inertia + parallel_axis(self.mass, point - self.centre)
    }
}

/// What a mass away from a point adds to the inertia about it (Huygens and Steiner).
fn parallel_axis(mass: f64, away: Vector3<f64>) -> Matrix3<f64> {
    mass * (Matrix3::identity() * away.norm_squared() - away * away.transpose())
}

/// Sentences on inertias that are placeholders: those of bodies larger than the robot, or than a
/// wheel.
///
/// * `body`: with how far the rover reaches from its centre [m]
/// * `wheels`: each with its name and radius [m]
pub(super) fn placeholders<'a>(
    (body, reach): (&Together, f64),
    wheels: impl Iterator<Item = (&'a str, Together, f64)>,
) -> Vec<String> {
    let gyration = |it: &Together| (it.inertia.diagonal().max() / it.mass).sqrt();
    let sentence = |what: &str, gyration: f64, size: &str, reach: f64| {
        format!(
            "inertia of {what}: its radius of gyration of {gyration:.2} m is larger than {size} of \
             {reach:.2} m: it looks like a placeholder, and yaw and load transfer go wrong with it"
        )
    };
    let of_body = Some(gyration(body)).filter(|it| *it > reach);
    let mut all: Vec<String> = of_body
        .map(|it| sentence("the body", it, "the rover's reach", reach))
        .into_iter()
        .collect();
    let mut large = wheels.filter(|(_, wheel, radius)| gyration(wheel) > 1.5 * radius);
    if let Some((name, wheel, radius)) = large.next() {
        let more = large.count();
        let more = if more > 0 { format!(" and {more} others") } else { String::new() };
        all.push(sentence(&format!("wheel {name}{more}"), gyration(&wheel), "its radius", radius));
    }
    all
}
