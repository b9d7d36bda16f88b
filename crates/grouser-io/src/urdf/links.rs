//! Which links are wheels, what they hang on, and what links weigh together.

use nalgebra::{Matrix3, Vector3};

use super::error::UrdfError;
use super::options::UrdfOptions;
use super::tree::{Rim, Robot};

/// Cosine of the angle by which an axis may be off its direction: 10°.
const ALONG: f64 = 0.985;

/// The most wheels of a rover.
const MOST: usize = 64;

/// A wheel with the joints between it and the body.
#[derive(Clone, Debug)]
pub(super) struct Wheel {
    /// The link that has its rim, and its name.
    pub(super) link: usize,
    /// The link that its axle turns: all that hangs on it is the wheel's.
    pub(super) turned: usize,
    /// The link that steers it.
    pub(super) steered: Option<usize>,
    /// Links that turn about axes across the rover, from the body out.
    pub(super) hinges: Vec<usize>,
    /// [m]
    pub(super) radius: f64,
    pub(super) width: f64,
    /// The middle of its rim, in the root's frame [m].
    pub(super) centre: Vector3<f64>,
}

impl Wheel {
    pub(super) fn all(
        robot: &Robot,
        options: &UrdfOptions,
        notes: &mut Vec<String>,
    ) -> Result<Vec<Self>, UrdfError> {
        let links = if options.wheels.is_empty() {
            guessed(robot, notes)?
        } else {
            named(robot, &options.wheels)?
        };
        if links.len() > MOST {
            return Err(UrdfError::TooManyWheels { count: links.len(), most: MOST });
        }
        let wheels: Vec<Self> =
            links.into_iter().map(|link| Self::of(robot, link, notes)).collect::<Result<_, _>>()?;
        for (number, wheel) in wheels.iter().enumerate() {
            if let Some(other) = wheels[..number].iter().find(|it| it.turned == wheel.turned) {
                let [one, two] =
                    [other.link, wheel.link].map(|link| robot.links[link].name.clone());
                return Err(UrdfError::OneWheelTwice(one, two));
            }
        }
        Ok(wheels)
    }

    fn of(robot: &Robot, link: usize, notes: &mut Vec<String>) -> Result<Self, UrdfError> {
        let name = &robot.links[link].name;
        let no_rim = |found| UrdfError::NoRim { link: name.clone(), found };
        let Rim::Cylinder { radius, length, origin } = robot.links[link].rim else {
            let Rim::Other(found) = robot.links[link].rim else { return Err(no_rim("")) };
            return Err(no_rim(found));
        };
        let placed = robot.links[link].frame * origin;
        let centre = placed.translation.vector;
        if (placed.rotation * Vector3::z()).y.abs() <= ALONG {
            return Err(UrdfError::RimAcross(name.clone()));
        }
        let mut moving = robot.up_from(link).filter(|it| is_turned(robot, *it));
        let turned = moving.next().filter(|it| is_across(robot, *it));
        let turned = turned.ok_or_else(|| UrdfError::DoesNotRoll(name.clone()))?;
        let (mut steered, mut hinges) = (None, Vec::new());
        for above in moving {
            if is_across(robot, above) {
                hinges.insert(0, above);
            } else if is_upright(robot, above) && steered.is_none() && hinges.is_empty() {
                steered = Some(above);
            } else {
                return Err(UrdfError::Askew(joint_name(robot, above)));
            }
        }
        if hinges.len() > 2 {
            return Err(UrdfError::TooManyJoints(name.clone()));
        }
        for sliding in robot.up_from(turned).filter(|it| kind(robot, *it) == "prismatic") {
            let joint = joint_name(robot, sliding);
            notes.push(format!("joint {joint} slides: it is taken as it stands at zero"));
        }
        Ok(Self { link, turned, steered, hinges, radius, width: length, centre })
    }
}

/// Cylinders that roll without end about an axis across the rover.
fn guessed(robot: &Robot, notes: &mut Vec<String>) -> Result<Vec<usize>, UrdfError> {
    let rolls = |link: &usize| {
        let is_round = matches!(robot.links[*link].rim, Rim::Cylinder { .. });
        is_round && kind(robot, *link) == "continuous" && is_across(robot, *link)
    };
    let wheels: Vec<usize> = (0..robot.links.len()).filter(rolls).collect();
    if wheels.is_empty() {
        return Err(UrdfError::NoWheels(link_names(robot)));
    }
    let names: Vec<&str> = wheels.iter().map(|link| &*robot.links[*link].name).collect();
    notes.push(format!(
        "wheels: {}, the cylinders that roll without end about axes across the rover",
        names.join(", ")
    ));
    Ok(wheels)
}

fn named(robot: &Robot, patterns: &[String]) -> Result<Vec<usize>, UrdfError> {
    for pattern in patterns {
        if !robot.links.iter().any(|link| fits(pattern, &link.name)) {
            let links = link_names(robot);
            return Err(UrdfError::NoSuchWheel { pattern: pattern.clone(), links });
        }
    }
    let is_meant = |link: &usize| patterns.iter().any(|it| fits(it, &robot.links[*link].name));
    Ok((0..robot.links.len()).filter(is_meant).collect())
}

/// Whether a name is what a pattern says, in which `*` stands for any letters.
fn fits(pattern: &str, name: &str) -> bool {
    let Some((first, rest)) = pattern.split_once('*') else { return pattern == name };
    let Some(mut name) = name.strip_prefix(first) else { return false };
    let mut parts: Vec<&str> = rest.split('*').collect();
    let last = parts.pop().unwrap_or_default();
    for part in parts {
        // The first place that fits leaves most for those that follow.
        let Some(at) = name.find(part) else { return false };
        name = &name[at + part.len()..];
    }
    name.ends_with(last)
}

/// The names of some links, for messages.
fn link_names(robot: &Robot) -> String {
    const SHOWN: usize = 30;
    let names = robot.links.iter().map(|link| &*link.name);
    let shown: Vec<&str> = names.take(SHOWN).collect();
    let more = if robot.links.len() > SHOWN { ", …" } else { "" };
    shown.join(", ") + more
}

fn kind(robot: &Robot, link: usize) -> &str {
    robot.links[link].joint.as_ref().map_or("", |joint| &joint.kind)
}

pub(super) fn joint_name(robot: &Robot, link: usize) -> String {
    robot.links[link].joint.as_ref().map_or(String::new(), |joint| joint.name.clone())
}

fn is_turned(robot: &Robot, link: usize) -> bool {
    matches!(kind(robot, link), "continuous" | "revolute")
}

fn is_across(robot: &Robot, link: usize) -> bool {
    robot.links[link].axis().is_some_and(|axis| axis.y.abs() > ALONG)
}

fn is_upright(robot: &Robot, link: usize) -> bool {
    robot.links[link].axis().is_some_and(|axis| axis.z.abs() > ALONG)
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_stand_for_any_letters() {
        for (pattern, name, is_meant) in [
            ("wheel", "wheel", true),
            ("wheel", "wheel_1", false),
            ("*wheel*", "left_wheel_1", true),
            ("*_wheel", "wheel", false),
            ("a*b*c", "abbc", true),
            ("a*b*c", "acb", false),
            ("*", "", true),
            ("ab*ab", "ab", false),
        ] {
            assert_eq!(fits(pattern, name), is_meant, "{pattern} {name}");
        }
    }
}
