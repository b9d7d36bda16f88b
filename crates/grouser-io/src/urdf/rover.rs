//! A rover's document of links that are known as wheels and body.

use std::f64::consts::FRAC_PI_2;
use std::fmt::Write as _;

use nalgebra::{Matrix3, Vector3};

use super::error::UrdfError;
use super::links::{Together, Wheel, joint_name};
use super::options::UrdfOptions;
use super::tree::Robot;

/// How far apart two places are that should be one [m].
const SAME: f64 = 1e-3;

/// A rover that was found.
#[derive(Debug)]
pub(super) struct Found {
    body: Together,
    mounts: Vec<Mount>,
    suspension: Option<Suspension>,
    pub(super) notes: Vec<String>,
}

#[derive(Debug)]
struct Mount {
    name: String,
    /// The name of the joint that turns it, if that is another.
    joint: Option<String>,
    /// From the body's centre of mass [m].
    position: Vector3<f64>,
    /// How far it is steered to either side [rad], and from its centre to the axis [m].
    steering: Option<(f64, [f64; 2])>,
    unit: Unit,
}

/// A wheel with its motor.
#[derive(Clone, Debug, PartialEq)]
struct Unit {
    mass: f64,
    inertia: [f64; 3],
    radius: f64,
    width: f64,
}

#[derive(Debug)]
struct Suspension {
    /// (x, z) from the body's centre of mass [m].
    pivot: [f64; 2],
    bogie: Option<([f64; 2], &'static str)>,
}

impl Found {
    pub(super) fn of(robot: &Robot, options: &UrdfOptions) -> Result<Self, UrdfError> {
        let mut notes = Vec::new();
        let wheels = Wheel::all(robot, options, &mut notes)?;
        let turned: Vec<usize> = wheels.iter().map(|wheel| wheel.turned).collect();
        let is_of_wheel = robot.hanging_on(&turned);
        let others = (0..robot.links.len()).filter(|link| !is_of_wheel[*link]);
        let body = Together::of(robot, others);
        if body.mass <= 0.0 {
            return Err(UrdfError::NoBody);
        }
        if off_diagonal(&body.inertia) > 0.05 {
            notes.push(
                "the body's products of inertia are left out: the rover's axes are taken as \
                        its principal axes"
                    .to_owned(),
            );
        }
        let suspension = suspension(robot, &wheels, &body, options)?;
        let mounts = wheels
            .iter()
            .map(|wheel| mount(robot, wheel, &body, &mut notes))
            .collect::<Result<_, _>>()?;
        notes.push("wheels are smooth: URDF has no grousers".to_owned());
        Ok(Self { body, mounts, suspension, notes })
    }

    /// * `name`: of the robot
    pub(super) fn to_toml(&self, name: &str) -> String {
        let mut text = String::from("schema = \"rover/1\"\n");
        let _ = writeln!(text, "name = {}", quoted(name));
        let _ = writeln!(text, "source = {}", quoted(&format!("URDF of the robot {name}")));
        let assumed: Vec<String> = self.notes.iter().map(|note| quoted(note)).collect();
        let _ = writeln!(text, "assumed = [\n    {},\n]", assumed.join(",\n    "));
        let unit = &self.mounts[0].unit;
        let inertia = diagonal(&self.body.inertia);
        let _ = writeln!(
            text,
            "\n[body]\nmass_kg = {}\n{}",
            shown(self.body.mass),
            inertia_of(inertia)
        );
        let _ = writeln!(text, "\n[wheel_unit]\n{}", unit.to_toml());
        if let Some(Suspension { pivot, bogie }) = &self.suspension {
            let _ = writeln!(text, "\n[suspension]\npivot_m = {}", list(pivot));
            if let Some((pivot, end)) = bogie {
                let _ = writeln!(
                    text,
                    "\n[suspension.bogie]\npivot_m = {}\nend = \"{end}\"",
                    list(pivot)
                );
            }
        }
        for mount in &self.mounts {
            let place = list(mount.position.as_slice());
            let _ =
                writeln!(text, "\n[[mount]]\nname = {}\nposition_m = {place}", quoted(&mount.name));
            if let Some(joint) = &mount.joint {
                let _ = writeln!(text, "joint = {}", quoted(joint));
            }
            if let Some((limit, kingpin)) = mount.steering {
                let _ =
                    writeln!(text, "steering_limit_deg = {}", shown(limit.to_degrees().min(90.0)));
                let _ = writeln!(text, "kingpin_offset_m = {}", list(&kingpin));
            }
            if mount.unit != *unit {
                let _ = writeln!(text, "{}", mount.unit.to_toml());
            }
        }
        text
    }
}

impl Unit {
    /// The keys of a wheel unit, or of a mount that has another.
    fn to_toml(&self) -> String {
        let [radius, width] = [self.radius, self.width].map(shown);
        format!(
            "mass_kg = {}\n{}\nwheel = {{ name = \"wheel\", source = \"URDF\", radius_m = {radius}, width_m = {width} }}",
            shown(self.mass),
            inertia_of(self.inertia),
        )
    }
}

fn mount(
    robot: &Robot,
    wheel: &Wheel,
    body: &Together,
    notes: &mut Vec<String>,
) -> Result<Mount, UrdfError> {
    let is_part = robot.hanging_on(&[wheel.turned]);
    let all = (0..robot.links.len()).filter(|link| is_part[*link]);
    let together = Together::of(robot, all);
    let name = &robot.links[wheel.link].name;
    if together.mass <= 0.0 {
        let what = format!("link {name}, a wheel,");
        return Err(UrdfError::Lacks { what, lacks: "mass: give it an <inertial>" });
    }
    let steering = wheel.steered.map(|link| {
        let limits = robot.links[link].joint.as_ref().and_then(|joint| joint.limits);
        let axis = robot.links[link].pivot() - wheel.centre;
        // A joint without limits turns as far as wheels are steered at all.
        let limit = limits.map_or(FRAC_PI_2, |[lower, upper]| {
            let less = lower.abs().min(upper.abs());
            if (upper.abs() - lower.abs()).abs() > 1e-3 {
                let [lower, upper, less] = [lower, upper, less].map(|it| shown(it.to_degrees()));
                let joint = joint_name(robot, link);
                notes.push(format!(
                    "joint {joint} steers from {lower} to {upper} degrees: the rover steers by \
                     {less} degrees to either side"
                ));
            }
            less
        });
        (limit, [axis.x, axis.y])
    });
    let unit = Unit {
        mass: together.mass,
        inertia: diagonal(&together.inertia_about(wheel.centre)),
        radius: wheel.radius,
        width: wheel.width,
    };
    let joint = Some(joint_name(robot, wheel.turned)).filter(|it| it != name);
    let position = wheel.centre - body.centre;
    Ok(Mount { name: name.clone(), joint, position, steering, unit })
}

/// The rockers, and bogies, that wheels hang on; none where they hang on the body.
fn suspension(
    robot: &Robot,
    wheels: &[Wheel],
    body: &Together,
    options: &UrdfOptions,
) -> Result<Option<Suspension>, UrdfError> {
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
    if !options.has_differential {
        return Err(UrdfError::Differential(joint_name(robot, left.rocker)));
    }
    Ok(Some(Suspension { pivot: place(left.rocker), bogie }))
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

// ---- Numbers ----

fn diagonal(tensor: &Matrix3<f64>) -> [f64; 3] {
    [0, 1, 2].map(|axis| tensor[(axis, axis)])
}

/// The largest product of inertia over the least moment [-].
fn off_diagonal(tensor: &Matrix3<f64>) -> f64 {
    let products = [tensor[(0, 1)], tensor[(0, 2)], tensor[(1, 2)]];
    let least = diagonal(tensor).into_iter().fold(f64::INFINITY, f64::min);
    products.into_iter().fold(0.0, |most: f64, it| most.max(it.abs())) / least.max(1e-12)
}

/// A number as documents have it, without what rounding left.
fn shown(value: f64) -> String {
    let digits = format!("{value:.8e}").parse().unwrap_or(value);
    let value = if f64::abs(digits) < 1e-9 { 0.0 } else { digits };
    format!("{value:?}")
}

fn list(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|value| shown(*value)).collect();
    format!("[{}]", values.join(", "))
}

fn inertia_of([xx, yy, zz]: [f64; 3]) -> String {
    let [xx, yy, zz] = [xx, yy, zz].map(shown);
    format!("inertia_kg_m2 = {{ xx = {xx}, yy = {yy}, zz = {zz} }}")
}

/// A text of TOML.
fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}
