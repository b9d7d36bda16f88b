//! Which links are wheels, and what they hang on.

use nalgebra::Vector3;

use super::error::UrdfError;
use super::options::UrdfOptions;
use super::shapes::{self, ALONG, Meshes, Rim};
use super::tree::Robot;

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
        meshes: &Meshes<'_>,
        notes: &mut Vec<String>,
    ) -> Result<Vec<Self>, UrdfError> {
        check_named(robot, &options.passive)?;
        let links = if options.wheels.is_empty() {
            guessed(robot, options, meshes, notes)?
        } else {
            named(robot, &options.wheels)?
        };
        if links.len() > MOST {
            return Err(UrdfError::TooManyWheels { count: links.len(), most: MOST });
        }
        check_count(robot, &links)?;
        let of = |link: usize| {
            let wheel = Self::of(robot, link, options, meshes)?;
            notes.extend(wheel.1.map(|note| format!("link {}: {note}", robot.links[link].name)));
            note_still(robot, &wheel.0, options, notes);
            Ok(wheel.0)
        };
        let wheels: Vec<Self> = links.into_iter().map(of).collect::<Result<_, _>>()?;
        check_types(robot, &wheels)?;
        for (number, wheel) in wheels.iter().enumerate() {
            if let Some(other) = wheels[..number].iter().find(|it| it.turned == wheel.turned) {
                let [one, two] =
                    [other.link, wheel.link].map(|link| robot.links[link].name.clone());
                return Err(UrdfError::OneWheelTwice(one, two));
            }
        }
        Ok(wheels)
    }

    /// A wheel, and what is to be said of its rim.
    fn of(
        robot: &Robot,
        link: usize,
        options: &UrdfOptions,
        meshes: &Meshes<'_>,
    ) -> Result<(Self, Option<String>), UrdfError> {
        let name = &robot.links[link].name;
        let rim = rim(robot, link, options, meshes)?;
        let (Some(radius), Some(width)) = (rim.radius, rim.width) else {
            return Err(UrdfError::NoRim { link: name.clone(), found: rim.lacks });
        };
        let mut moving = robot.up_from(link).filter(|it| is_turned(robot, *it));
        let turned = moving.next().filter(|it| is_across(robot, *it));
        let turned = turned.ok_or_else(|| UrdfError::DoesNotRoll(name.clone()))?;
        let (mut steered, mut hinges) = (None, Vec::new());
        for above in moving.filter(|it| !is_locked(robot, *it, options)) {
            if is_across(robot, above) {
                hinges.insert(0, above);
            } else if is_upright(robot, above) && steered.is_none() && hinges.is_empty() {
                steered = Some(above);
            } else if !options.is_rigid {
                return Err(UrdfError::Askew(joint_name(robot, above)));
            }
        }
        if options.is_rigid {
            hinges.clear();
        }
        if hinges.len() > 2 {
            return Err(UrdfError::TooManyJoints(name.clone()));
        }
        Ok((Self { link, turned, steered, hinges, radius, width, centre: rim.centre }, rim.note))
    }
}

fn rim(
    robot: &Robot,
    link: usize,
    options: &UrdfOptions,
    meshes: &Meshes<'_>,
) -> Result<Rim, UrdfError> {
    let link = &robot.links[link];
    shapes::rim(&link.shapes, &link.frame, options, meshes)
}

/// Whether a joint between a wheel and the body cannot turn: its limits are one angle. Where a
/// caller speaks of rockers, such limits are placeholders.
fn is_locked(robot: &Robot, link: usize, options: &UrdfOptions) -> bool {
    let is_hinge = options.has_differential && is_across(robot, link);
    !is_hinge && robot.links[link].limits().is_some_and(|[low, high]| high <= low)
}

/// Says that what slides between a wheel and the body, or is locked, is taken as it stands.
fn note_still(robot: &Robot, wheel: &Wheel, options: &UrdfOptions, notes: &mut Vec<String>) {
    for above in robot.up_from(wheel.turned).skip(1) {
        let joint = joint_name(robot, above);
        let note = if kind(robot, above) == "prismatic" {
            format!(
                "joint {joint} slides, as springs do: the rover is taken as rigid, and this joint \
                 as it stands at zero"
            )
        } else if is_turned(robot, above) && is_locked(robot, above, options) {
            format!("joint {joint} cannot turn by its limits: it is taken as it stands at zero")
        } else {
            continue;
        };
        if !notes.contains(&note) {
            notes.push(note);
        }
    }
}

/// Checks the types of the joints that wheels hang on: what carries the whole robot may float.
fn check_types(robot: &Robot, wheels: &[Wheel]) -> Result<(), UrdfError> {
    const KNOWN: [&str; 4] = ["fixed", "continuous", "revolute", "prismatic"];
    let carries_all = |link: usize| {
        let is_above = |wheel: &Wheel| robot.up_from(wheel.turned).any(|it| it == link);
        ["floating", "planar"].contains(&kind(robot, link)) && wheels.iter().all(is_above)
    };
    let above = wheels.iter().flat_map(|wheel| robot.up_from(wheel.turned));
    let mut jointed = above.filter(|it| robot.links[*it].joint.is_some());
    let unknown = jointed.find(|it| !KNOWN.contains(&kind(robot, *it)) && !carries_all(*it));
    unknown.map_or(Ok(()), |link| {
        let (joint, kind) = (joint_name(robot, link), kind(robot, link).to_owned());
        Err(UrdfError::JointType { joint, kind })
    })
}

/// Checks that there are as many wheels as a rover stands on.
fn check_count(robot: &Robot, wheels: &[usize]) -> Result<(), UrdfError> {
    const LEAST: usize = 3;
    if wheels.len() >= LEAST {
        return Ok(());
    }
    let names = wheels.iter().map(|wheel| robot.links[*wheel].name.clone());
    let is_wheel = |link: usize| wheels.contains(&link);
    let beside = (0..robot.links.len())
        .filter(|link| !is_wheel(*link) && robot.links[*link].parent.is_some());
    let beside = beside.filter_map(|link| {
        Some(format!(
            "{} of link {}",
            shapes::kinds(&robot.links[link].shapes)?,
            robot.links[link].name
        ))
    });
    Err(UrdfError::TooFewWheels {
        wheels: names.collect::<Vec<_>>().join(", "),
        count: wheels.len(),
        beside: beside.map(|it| format!(" and {it}")).collect(),
    })
}

/// What rolls about an axis across the rover, reaches the ground, and comes in pairs.
fn guessed(
    robot: &Robot,
    options: &UrdfOptions,
    meshes: &Meshes<'_>,
    notes: &mut Vec<String>,
) -> Result<Vec<usize>, UrdfError> {
    let is_passive =
        |link: usize| options.passive.iter().any(|it| fits(it, &robot.links[link].name));
    let rolling = |axis: fn(&Robot, usize) -> bool| {
        let links = 0..robot.links.len();
        links
            .filter(|link| rolls(robot, *link) && axis(robot, *link) && !is_passive(*link))
            .collect::<Vec<_>>()
    };
    let mut found = Vec::new();
    for link in rolling(is_across) {
        found.push(Rolling { link, rim: rim(robot, link, options, meshes)? });
    }
    found.retain(|it| !robot.links[it.link].shapes.is_empty() || options.wheel_radius.is_some());
    let carrying = carrying(robot, &found);
    found.retain(|it| !carrying[it.link]);
    let (casters, found): (Vec<_>, Vec<_>) = found.into_iter().partition(|it| is_caster(robot, it));
    if !casters.is_empty() {
        notes.push(format!(
            "casters, by their names or as they trail, and no driven wheels: {}",
            names(robot, &casters)
        ));
    }
    let in_pairs = in_pairs(&on_ground(&found));
    if in_pairs.is_empty() {
        let askew = rolling(|robot, link| !is_across(robot, link) && !is_along(robot, link));
        return Err(UrdfError::NoWheels {
            links: link_names(robot),
            along: rolling(is_along).len(),
            askew: askew.into_iter().map(|it| robot.links[it].name.clone()).collect(),
        });
    }
    let is_other = |it: &&Rolling| in_pairs.iter().all(|wheel| wheel.link != it.link);
    let others: Vec<Rolling> = found.iter().filter(is_other).cloned().collect();
    check_tracks(robot, &others, &in_pairs)?;
    notes.push(format!(
        "wheels: {}, which roll about axes across the rover, reach the ground and come in pairs",
        names(robot, &in_pairs)
    ));
    if !others.is_empty() {
        notes.push(format!("not taken as wheels, though they roll: {}", names(robot, &others)));
    }
    Ok(in_pairs.iter().map(|it| it.link).collect())
}

/// Names of links that roll, for sentences.
fn names(robot: &Robot, all: &[Rolling]) -> String {
    all.iter().map(|it| &*robot.links[it.link].name).collect::<Vec<_>>().join(", ")
}

/// Whether each link carries one of some that roll, as rockers, arms and legs do.
fn carrying(robot: &Robot, rolling: &[Rolling]) -> Vec<bool> {
    let mut carrying = vec![false; robot.links.len()];
    for above in rolling.iter().flat_map(|it| robot.up_from(it.link).skip(1)) {
        carrying[above] = true;
    }
    carrying
}

/// Whether a wheel is a caster: it is called so, or what holds it turns freely about an upright axis
/// which it trails.
fn is_caster(robot: &Robot, wheel: &Rolling) -> bool {
    /// Over a radius, how far casters trail their axes at least [-]. Source: ours.
    const TRAIL: f64 = 0.15;
    /// Links from a caster's wheel to what it turns on.
    const NEAR: usize = 4;
    robot.up_from(wheel.link).take(NEAR).any(|link| {
        let names =
            format!("{} {}", robot.links[link].name, joint_name(robot, link)).to_lowercase();
        let trail = (robot.links[link].pivot().x - wheel.rim.centre.x).abs();
        let is_free = kind(robot, link) == "continuous" && is_upright(robot, link);
        let trails = is_free && trail > TRAIL * wheel.rim.radius.unwrap_or(0.0);
        trails || names.contains("caster") || names.contains("castor")
    })
}

/// Refuses tracks: above the wheels on the ground their sprockets and rollers roll in pairs.
///
/// * `others`: what rolls and is no wheel
fn check_tracks(robot: &Robot, others: &[Rolling], wheels: &[Rolling]) -> Result<(), UrdfError> {
    /// The fewest that look like tracks. Source: ours; a sprocket and an idler on each side.
    const LEAST: usize = 4;
    let rollers = in_pairs(others);
    if rollers.len() < LEAST {
        return Ok(());
    }
    Err(UrdfError::Tracks { wheels: names(robot, wheels), rollers: names(robot, &rollers) })
}

/// A link that rolls about an axis across the rover.
#[derive(Clone, Debug)]
struct Rolling {
    link: usize,
    rim: Rim,
}

impl Rolling {
    /// How low it reaches, as far as its radius is known [m].
    fn bottom(&self) -> f64 {
        self.rim.centre.z - self.rim.radius.unwrap_or(0.0)
    }
}

/// Those that reach about as low as the lowest does: wheels of which no radius is known are compared
/// by their middles.
fn on_ground(found: &[Rolling]) -> Vec<Rolling> {
    /// Over a radius [-]. Source: ours; a rover's wheels at zero stand on one plane.
    const ABOUT: f64 = 0.5;
    let knows_all = found.iter().all(|it| it.rim.radius.is_some());
    let low = |it: &Rolling| if knows_all { it.bottom() } else { it.rim.centre.z };
    let lowest = found.iter().map(low).fold(f64::INFINITY, f64::min);
    let usual = found.iter().filter_map(|it| it.rim.radius).fold(0.0, f64::max).max(0.02);
    found.iter().filter(|it| low(it) - lowest <= ABOUT * usual).cloned().collect()
}

/// Those that have a partner on the other side; and those in the middle, where two pairs are not
/// there.
fn in_pairs(found: &[Rolling]) -> Vec<Rolling> {
    /// Over the distance between the sides [-]. Source: ours.
    const ALIKE: f64 = 0.1;
    let middle = {
        let sides = found.iter().map(|it| it.rim.centre.y);
        let (low, high) = sides.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), it| {
            (low.min(it), high.max(it))
        });
        0.5 * (low + high)
    };
    let is_partner = |one: &Rolling, other: &Rolling| {
        let (a, b) = (one.rim.centre, other.rim.centre);
        let across = (a.y - b.y).abs();
        let is_opposite = (a.y - middle) * (b.y - middle) < 0.0;
        let is_level = (a.x - b.x).abs().max((a.z - b.z).abs()) <= ALIKE * across;
        is_opposite && is_level && (a.y + b.y - 2.0 * middle).abs() <= ALIKE * across
    };
    let has_partner = |it: &Rolling| found.iter().any(|other| is_partner(it, other));
    let is_paired: Vec<bool> = found.iter().map(has_partner).collect();
    let is_pair = is_paired.iter().filter(|it| **it).count() == 2;
    let reach = found.iter().map(|it| (it.rim.centre.y - middle).abs()).fold(0.0, f64::max);
    let is_middle = |it: &Rolling| (it.rim.centre.y - middle).abs() <= 2.0 * ALIKE * reach;
    let all = found.iter().zip(is_paired);
    let those = all.filter(|(it, is_paired)| *is_paired || is_pair && is_middle(it));
    those.map(|(it, _)| it.clone()).collect()
}

/// Whether a link rolls: without end, or with limits of some turns.
fn rolls(robot: &Robot, link: usize) -> bool {
    let limits = robot.links[link].limits();
    match kind(robot, link) {
        "continuous" => true,
        "revolute" => limits.is_some_and(|[low, high]| high - low > 4.0 * std::f64::consts::PI),
        _ => false,
    }
}

/// Checks that each pattern is that of a link.
fn check_named(robot: &Robot, patterns: &[String]) -> Result<(), UrdfError> {
    let is_of_none = |it: &&String| !robot.links.iter().any(|link| fits(it, &link.name));
    let Some(pattern) = patterns.iter().find(is_of_none) else { return Ok(()) };
    let joints = robot.links.iter().filter_map(|link| {
        let joint = &link.joint.as_ref()?.name;
        fits(pattern, joint).then(|| [joint.clone(), link.name.clone()])
    });
    let (joints, links) = (joints.collect(), link_names(robot));
    Err(UrdfError::NoSuchWheel { pattern: pattern.clone(), links, joints })
}

fn named(robot: &Robot, patterns: &[String]) -> Result<Vec<usize>, UrdfError> {
    check_named(robot, patterns)?;
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

fn is_along(robot: &Robot, link: usize) -> bool {
    robot.links[link].axis().is_some_and(|axis| axis.x.abs() > ALONG)
}

fn is_upright(robot: &Robot, link: usize) -> bool {
    robot.links[link].axis().is_some_and(|axis| axis.z.abs() > ALONG)
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
