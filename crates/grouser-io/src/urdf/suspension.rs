//! Rockers, bogies and the differential between the two sides.

use super::error::UrdfError;
use super::inertia::Together;
use super::links::{Wheel, joint_name};
use super::options::UrdfOptions;
use super::tree::Robot;

/// How far apart two places are that should be one [m].
const SAME: f64 = 1e-3;

/// Rockers, and the bogies on them.
#[derive(Debug)]
pub(super) struct Suspension {
    /// (x, z) from the body's centre of mass [m].
    pub(super) pivot: [f64; 2],
    pub(super) bogie: Option<([f64; 2], &'static str)>,
}

impl Suspension {
    /// The rockers, and bogies, that wheels hang on; none where they hang on the body.
    pub(super) fn of(
        robot: &Robot,
        wheels: &[Wheel],
        body: &Together,
        options: &UrdfOptions,
    ) -> Result<Option<Self>, UrdfError> {
        if wheels.iter().all(|wheel| wheel.hinges.is_empty()) {
            return Ok(None);
        }
        let middle = body.centre.y;
        let side = |is_left: bool| {
            let of_side = wheels.iter().filter(|it| (it.centre.y > middle) == is_left);
            Side::of(of_side.collect())
        };
        let (left, right) = (side(true)?, side(false)?);
        let alike = |what, one: usize, other: usize| {
            let away = robot.links[one].pivot() - robot.links[other].pivot();
            if away.x.abs().max(away.z.abs()) <= SAME {
                return Ok(());
            }
            Err(UrdfError::Sides(what, joint_name(robot, one), joint_name(robot, other)))
        };
        alike("rockers", left.rocker, right.rocker)?;
        let place = |link: usize| {
            let pivot = robot.links[link].pivot() - body.centre;
            [pivot.x, pivot.z]
        };
        let bogie = match (left.bogie, right.bogie) {
            (Some((one, end)), Some((other, other_end))) if end == other_end => {
                alike("bogies", one, other)?;
                Some((place(one), end))
            }
            (None, None) => None,
            _ => return Err(UrdfError::OtherSuspension),
        };
        check_differential(robot, [left.rocker, right.rocker], options.has_differential)?;
        Ok(Some(Self { pivot: place(left.rocker), bogie }))
    }
}

/// Checks that the rockers turn against each other: by a `<mimic>`, or because a caller says so.
fn check_differential(
    robot: &Robot,
    rockers: [usize; 2],
    is_stated: bool,
) -> Result<(), UrdfError> {
    /// How far a ratio is from that of equal turns, where rounding made it [-]. Source: ours.
    const EQUAL: f64 = 0.01;
    let [left, right] = rockers.map(|link| joint_name(robot, link));
    match ratio(robot, rockers) {
        Some(ratio) if ratio > 0.0 => Err(UrdfError::TurnTogether(left, right)),
        Some(ratio) if (ratio + 1.0).abs() > EQUAL => {
            Err(UrdfError::TurnUnequally { left, right, ratio: -ratio })
        }
        None if !is_stated => Err(UrdfError::Differential(left)),
        _ => Ok(()),
    }
}

/// How far the right rocker turns about y for a turn of the left one, where `<mimic>` joins them.
fn ratio(robot: &Robot, rockers: [usize; 2]) -> Option<f64> {
    let [left, right] = rockers.map(|link| led_by(robot, link));
    (left.0 == right.0).then(|| right.1 / left.1).filter(|ratio| ratio.is_finite())
}

/// The joint that leads a link's joint by way of `<mimic>`, and how far the link turns about y for
/// a turn of that.
fn led_by(robot: &Robot, link: usize) -> (String, f64) {
    /// The most joints in a row.
    const MOST: usize = 10;
    let joint = |name: &str| {
        robot.links.iter().filter_map(|it| it.joint.as_ref()).find(|it| it.name == name)
    };
    let across = robot.links[link].axis().map_or(1.0, |axis| axis.y);
    let (mut name, mut factor) = (joint_name(robot, link), across);
    for _ in 0..MOST {
        let Some((with, by)) = joint(&name).and_then(|it| it.mimic.clone()) else { break };
        (name, factor) = (with, factor * by);
    }
    (name, factor)
}

/// The links that turn on a side.
struct Side {
    rocker: usize,
    bogie: Option<(usize, &'static str)>,
}

impl Side {
    fn of(wheels: Vec<&Wheel>) -> Result<Self, UrdfError> {
        let mut rockers = wheels.iter().map(|wheel| wheel.hinges.first());
        let Some(Some(rocker)) = rockers.next() else { return Err(UrdfError::OtherSuspension) };
        if !rockers.all(|it| it == Some(rocker)) {
            return Err(UrdfError::OtherSuspension);
        }
        let (on_bogie, on_rocker): (Vec<&Wheel>, Vec<&Wheel>) =
            wheels.into_iter().partition(|wheel| wheel.hinges.len() > 1);
        match (&on_bogie[..], &on_rocker[..]) {
            ([], [_, _]) => Ok(Self { rocker: *rocker, bogie: None }),
            ([one, other], [alone]) if one.hinges == other.hinges => {
                let is_front = one.centre.x + other.centre.x > 2.0 * alone.centre.x;
                let end = if is_front { "front" } else { "rear" };
                Ok(Self { rocker: *rocker, bogie: Some((one.hinges[1], end)) })
            }
            _ => Err(UrdfError::OtherSuspension),
        }
    }
}
