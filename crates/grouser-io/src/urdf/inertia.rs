//! What links weigh together, and whether that is a measurement at all.

use nalgebra::{Matrix3, Vector3};

use super::tree::Robot;
use crate::reading::four_digits;

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

    /// Why the inertia is that of no body, in words.
    pub(super) fn flaw(&self) -> Option<&'static str> {
        let moments = self.inertia.diagonal();
        if self.inertia.norm() == 0.0 {
            return Some("is not stated");
        }
        let (least, most) = (moments.min(), moments.max());
        // A flat body has both alike.
        let is_of_a_body = least > 0.0 && most <= (moments.sum() - most) * (1.0 + 1e-9);
        (!is_of_a_body).then_some("is that of no body (a moment is above the two others together)")
    }
}

/// What a mass away from a point adds to the inertia about it (Huygens and Steiner).
fn parallel_axis(mass: f64, away: Vector3<f64>) -> Matrix3<f64> {
    mass * (Matrix3::identity() * away.norm_squared() - away * away.transpose())
}

/// Sentences on inertias that are placeholders: those of bodies larger than the robot, or than a
/// wheel, and those of hardly more than a point.
///
/// * `body`: with how far the rover reaches from its centre [m]
/// * `wheels`: each with its name and radius [m]
pub(super) fn placeholders<'a>(
    (body, reach): (&Together, f64),
    wheels: impl Iterator<Item = (&'a str, Together, f64)>,
) -> Vec<String> {
    /// Radii of gyration over a wheel's radius, and over a rover's reach, as far as they are small
    /// and credible [-]. Source: ours; a disk has 0.7 and a box 0.3.
    const LEAST_OF_WHEEL: f64 = 0.1;
    const LEAST_OF_BODY: f64 = 0.03;
    let gyration = |it: &Together| (it.inertia.diagonal().max() / it.mass).sqrt();
    let sentence = |what: &str, gyration: f64, size: &str, reach: f64| {
        let compared = if gyration > reach { "larger" } else { "far smaller" };
        let [gyration, reach] = [gyration, reach].map(four_digits);
        format!(
            "inertia of {what}: its radius of gyration of {gyration} m is {compared} than {size} of \
             {reach} m: it looks like a placeholder, and yaw and load transfer go wrong with it"
        )
    };
    let is_credible = |gyration: f64, least: f64, most: f64| (least..=most).contains(&gyration);
    let of_body = Some(gyration(body)).filter(|it| !is_credible(*it, LEAST_OF_BODY * reach, reach));
    let mut all: Vec<String> = of_body
        .map(|it| sentence("the body", it, "the rover's reach", reach))
        .into_iter()
        .collect();
    let mut others = wheels.filter(|(_, wheel, radius)| {
        // What is that of no body is estimated, and said so.
        wheel.flaw().is_none()
            && !is_credible(gyration(wheel), LEAST_OF_WHEEL * radius, 1.5 * radius)
    });
    if let Some((name, wheel, radius)) = others.next() {
        let more = match others.count() {
            0 => String::new(),
            1 => " and 1 other".to_owned(),
            more => format!(" and {more} others"),
        };
        all.push(sentence(&format!("wheel {name}{more}"), gyration(&wheel), "its radius", radius));
    }
    all
}
