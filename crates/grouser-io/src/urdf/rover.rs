//! A rover's document of links that are known as wheels and body.

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write as _;

use nalgebra::{Matrix3, Vector3};

use super::error::UrdfError;
use super::found::FoundWheel;
use super::inertia::{Together, placeholders};
use super::links::{Wheel, joint_name};
use super::options::UrdfOptions;
use super::shapes::Meshes;
use super::suspension::Suspension;
use super::tree::Robot;
use crate::describe::rover::MASS;
use crate::reading::four_digits;

/// A rover that was found.
#[derive(Debug)]
pub(super) struct Found {
    body: Together,
    mounts: Vec<Mount>,
    suspension: Option<Suspension>,
    pub(super) notes: Vec<String>,
    pub(super) wheels: Vec<FoundWheel>,
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

impl Found {
    pub(super) fn of(
        robot: &Robot,
        options: &UrdfOptions,
        meshes: &Meshes<'_>,
    ) -> Result<Self, UrdfError> {
        let mut notes = Vec::new();
        let wheels = Wheel::all(robot, options, meshes, &mut notes)?;
        let turned: Vec<usize> = wheels.iter().map(|wheel| wheel.turned).collect();
        let is_of_wheel = robot.hanging_on(&turned);
        let others = (0..robot.links.len()).filter(|link| !is_of_wheel[*link]);
        let body = Together::of(robot, others);
        if body.mass <= 0.0 {
            return Err(UrdfError::NoBody);
        }
        check_mass("the body, all links that are no wheels".to_owned(), body.mass)?;
        if off_diagonal(&body.inertia) > 0.05 {
            notes.push(
                "the body's products of inertia are left out: the rover's axes are taken as \
                        its principal axes"
                    .to_owned(),
            );
        }
        let mut wheels = wheels;
        let suspension = Suspension::of(robot, &wheels, &body, options)?;
        let hubs: Vec<Vector3<f64>> = wheels.iter().map(|it| it.centre).collect();
        notes.extend(level(&mut wheels));
        let mounts = wheels
            .iter()
            .zip(hubs)
            .map(|(wheel, hub)| mount(robot, wheel, hub, &body, &mut notes))
            .collect::<Result<Vec<_>, _>>()?;
        let mut body = body;
        if let Some(why) = body.flaw() {
            body.inertia = of_box(&body, &wheels);
            notes.push(format!("the body's inertia {why}: it is taken as that of a uniform box"));
        }
        notes.extend(doubts(robot, &wheels, &body));
        if options.is_rigid {
            notes.push("rockers and bogies are taken as they stand: the rover is rigid".to_owned());
        }
        notes.push("wheels are smooth: URDF has no grousers".to_owned());
        let wheels = wheels.iter().map(|wheel| found_wheel(robot, wheel, &body)).collect();
        Ok(Self { body, mounts, suspension, notes, wheels })
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

/// Checks a mass [kg] by what documents have.
fn check_mass(what: String, mass: f64) -> Result<(), UrdfError> {
    if MASS.contains(&mass) {
        return Ok(());
    }
    let (written, expected) = (shown(mass), "0.01 to 100000 kg");
    Err(UrdfError::Number { what, attribute: "mass", written, expected })
}

/// The inertia of a uniform cylinder [kg m²].
fn of_cylinder(mass: f64, wheel: &Wheel) -> [f64; 3] {
    let (square, width) = (wheel.radius * wheel.radius, wheel.width);
    let across = mass * (3.0 * square + width * width) / 12.0;
    [across, 0.5 * mass * square, across]
}

/// Puts the wheels on one plane, and says so.
fn level(wheels: &mut [Wheel]) -> Option<String> {
    let bottom = |wheel: &Wheel| wheel.centre.z - wheel.radius;
    let ground = wheels.iter().map(bottom).sum::<f64>() / wheels.len() as f64;
    let most = wheels.iter().map(|it| (bottom(it) - ground).abs()).fold(0.0, f64::max);
    for wheel in wheels {
        wheel.centre.z = ground + wheel.radius;
    }
    (most > 1e-6).then(|| {
        format!(
            "wheels stand {} m higher or lower where all joints are at zero: they are put on \
                 one plane",
            four_digits(most)
        )
    })
}

/// The least and the largest coordinate of the wheels' centres along an axis [m].
fn ends(wheels: &[Wheel], axis: usize) -> [f64; 2] {
    let places = wheels.iter().map(|it| it.centre[axis]);
    places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], it| [low.min(it), high.max(it)])
}

/// The inertia of a uniform box between the wheels, as high as half a wheel base [kg m²].
fn of_box(body: &Together, wheels: &[Wheel]) -> Matrix3<f64> {
    let over = |axis: usize| {
        let [low, high] = ends(wheels, axis);
        high - low
    };
    let (length, width) = (over(0), over(1));
    let height = 0.5 * length;
    let about = |one: f64, other: f64| body.mass * (one * one + other * other) / 12.0;
    Matrix3::from_diagonal(&Vector3::new(
        about(width, height),
        about(length, height),
        about(length, width),
    ))
}

/// What is to be doubted of the inertias.
fn doubts(robot: &Robot, wheels: &[Wheel], body: &Together) -> Vec<String> {
    let reach = wheels.iter().map(|it| (it.centre - body.centre).norm() + it.radius);
    let reach = reach.fold(0.0, f64::max);
    let of_wheels = wheels.iter().map(|wheel| {
        let is_part = robot.hanging_on(&[wheel.turned]);
        let parts = (0..robot.links.len()).filter(|link| is_part[*link]);
        (&*robot.links[wheel.link].name, Together::of(robot, parts), wheel.radius)
    });
    let mut all = placeholders((body, reach), of_wheels);
    all.extend(lopsided(wheels, body));
    all
}

/// Says that the body's centre of mass is to one side of its wheels, or not between them.
fn lopsided(wheels: &[Wheel], body: &Together) -> Option<String> {
    /// Over the distance between the sides, as far as robots are symmetric [-]. Source: ours.
    const ASIDE: f64 = 0.1;
    let from_body = |axis: usize| ends(wheels, axis).map(|it| it - body.centre[axis]);
    let ([rear, front], [right, left]) = (from_body(0), from_body(1));
    let middle = 0.5 * (left + right);
    if rear > 0.0 || front < 0.0 {
        let which = if rear > 0.0 { "behind" } else { "before" };
        return Some(format!(
            "the body's centre of mass is {which} all wheels: the rover tips over, unless a mass or \
             its place is wrong"
        ));
    }
    let side = if middle > 0.0 { "right" } else { "left" };
    (middle.abs() > ASIDE * (left - right)).then(|| {
        format!(
            "the body's centre of mass is {} m to the {side} of the middle between the wheels, as \
             the <inertial> of its links have it: is that so?",
            four_digits(middle.abs())
        )
    })
}

fn found_wheel(robot: &Robot, wheel: &Wheel, body: &Together) -> FoundWheel {
    let name = |link: usize| joint_name(robot, link);
    FoundWheel {
        link: robot.links[wheel.link].name.clone(),
        joint: name(wheel.turned),
        radius: wheel.radius,
        width: wheel.width,
        position: (wheel.centre - body.centre).into(),
        steered_by: wheel.steered.map(name),
        hangs_on: wheel.hinges.iter().copied().map(name).collect(),
    }
}

/// * `hub`: where the links have the wheel's centre
fn mount(
    robot: &Robot,
    wheel: &Wheel,
    hub: Vector3<f64>,
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
    /// The density of air on Earth [kg/m³]: every wheel is heavier.
    const AIR: f64 = 1.2;
    let (radius, width, mass) = (wheel.radius, wheel.width, together.mass);
    if mass < AIR * PI * radius * radius * width {
        return Err(UrdfError::Millimetres { link: name.clone(), radius, width, mass });
    }
    /// The density of osmium [kg/m³]: no wheel is heavier.
    const METAL: f64 = 22_600.0;
    if mass > METAL * PI * radius * radius * width {
        return Err(UrdfError::Grams { link: name.clone(), radius, width, mass });
    }
    check_mass(format!("link {name}, a wheel"), mass)?;
    let steering = wheel.steered.map(|link| {
        let limits = robot.links[link].limits();
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
    // Zero is at an end of what it turns: no rover steers so.
    let steering = steering.filter(|(limit, _)| *limit > 0.0);
    let mut inertia = diagonal(&together.inertia_about(hub));
    if let Some(why) = together.flaw() {
        inertia = of_cylinder(together.mass, wheel);
        notes.push(format!(
            "link {name}: its inertia {why}: it is taken as that of a uniform cylinder"
        ));
    }
    let unit = Unit { mass: together.mass, inertia, radius: wheel.radius, width: wheel.width };
    let joint = joint_name(robot, wheel.turned);
    // About an axis to the right a wheel that rolls forward turns backward.
    let is_reversed = robot.links[wheel.turned].axis().is_some_and(|axis| axis.y < 0.0);
    let joint =
        if is_reversed { Some(format!("-{joint}")) } else { Some(joint).filter(|it| it != name) };
    let position = wheel.centre - body.centre;
    Ok(Mount { name: name.clone(), joint, position, steering, unit })
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
