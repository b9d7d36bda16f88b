//! `rover/1`: a body and its wheels.

use std::ops::RangeInclusive;

use super::super::field::{
    At, DEG, DEG_S, Each, Field, Form, Inner, KG, KG_M2, M, Reach, Table, list, number, numbers,
    part, positive, table, text, word, words,
};
use super::super::kind::Kind;
use super::about::{assumed, name, notes, schema, source};
use super::power::{BATTERY, MOTOR, NO_BATTERY, NO_MOTOR};
use super::wheel::{self, WHEEL};
use grouser_core::units::{Vec2, Vec3};
use grouser_core::vehicle::{
    Body, Bogie, End, Inertia, MountParts, RoverParts, SteeringParts, Suspension, WheelUnit,
};

const NO_INERTIA: Inertia = Inertia { xx: 0.0, yy: 0.0, zz: 0.0 };

/// A rover before its numbers are put in.
pub(crate) const BLANK: RoverParts = RoverParts {
    body: Body { mass: 0.0, inertia: NO_INERTIA },
    wheel_unit: WheelUnit { mass: 0.0, inertia: NO_INERTIA, wheel: wheel::BLANK, motor: None },
    steering: NO_STEERING,
    mounts: Vec::new(),
    battery: None,
    suspension: None,
    belly_clearance: None,
};

const NO_STEERING: SteeringParts = SteeringParts { limit: None, rate: None };

pub(crate) static ROVER: Table<RoverParts> = Table {
    doc: "A body and three or more wheels, rigidly joined or on rockers.",
    fields: &[
        schema("rover/1"),
        name(),
        source(),
        notes(),
        assumed(),
        table(
            "body",
            "The body, without its wheels.",
            &At { inner: &BODY, at: |rover: &mut RoverParts| &mut rover.body },
        ),
        table(
            "wheel_unit",
            "A wheel with its motor: that of every mount that has no other.",
            &At { inner: &WHEEL_UNIT, at: |rover: &mut RoverParts| &mut rover.wheel_unit },
        ),
        part(
            "motor",
            Kind::Motor,
            "The motor of every wheel whose mount has no other: a preset's name, a path from this \
             document's folder, or a motor's keys; without it nothing is said of current and \
             battery.",
            &At {
                inner: &MOTOR,
                at: |rover: &mut RoverParts| rover.wheel_unit.motor.get_or_insert(NO_MOTOR),
            },
        )
        .optional(),
        steering_limit(
            "How far every wheel can be steered to either side; left out, wheels keep their angles",
            |rover: &mut RoverParts| Some(rover.steering.limit.get_or_insert(0.0)),
        )
        .optional(),
        steering_rate(
            "How fast every wheel is steered; left out, 10 °/s (assumed)",
            |rover: &mut RoverParts| Some(rover.steering.rate.get_or_insert(0.0)),
        )
        .optional(),
        table(
            "battery",
            "The battery, and what the electronics draw from it; without it nothing is known of \
             its voltage and charge.",
            &At {
                inner: &BATTERY,
                at: |rover: &mut RoverParts| rover.battery.get_or_insert(NO_BATTERY),
            },
        )
        .optional(),
        table(
            "suspension",
            "How the wheels are joined to the body: on rockers with a differential, two wheels on \
             a side, or with bogies three; left out, rigidly.",
            &At {
                inner: &SUSPENSION,
                at: |rover: &mut RoverParts| rover.suspension.get_or_insert(NO_SUSPENSION),
            },
        )
        .optional(),
        number(
            "belly_clearance_m",
            M,
            0.0..=10.0,
            "Height of the body's flat underside, between the wheels' hubs, over level hard \
             ground; left out, nothing is said of high-centring",
            |rover: &mut RoverParts| Some(rover.belly_clearance.get_or_insert(0.0)),
        )
        .optional(),
        list(
            "mount",
            "Where the wheels sit: three or more, standing on one plane, not in one line.",
            &Each {
                inner: &MOUNT,
                list: |rover: &mut RoverParts| &mut rover.mounts,
                blank: || MountParts {
                    name: String::new(),
                    joint: None,
                    position: Vec3::zeros(),
                    steering: 0.0,
                    steered: NO_STEERING,
                    kingpin_offset: Vec2::zeros(),
                    wheel: None,
                    mass: None,
                    inertia: None,
                    motor: None,
                },
            },
            3,
        ),
    ],
};

/// Rockers before their numbers are put in.
const NO_SUSPENSION: Suspension = Suspension { pivot: Vec2::new(0.0, 0.0), bogie: None };

static SUSPENSION: Table<Suspension> = Table {
    doc: "Rockers on both sides, alike, with a differential that turns them against each other.",
    fields: &[
        pivot(
            "Axis of the rockers, seen from the side, from the body's centre of mass: x forward, z \
             up",
            |it: &mut Suspension, axis| it.pivot.get_mut(axis),
        ),
        table(
            "bogie",
            "The bogie of each rocker, which carries two of three wheels on a side.",
            &At {
                inner: &BOGIE,
                at: |it: &mut Suspension| {
                    it.bogie.get_or_insert(Bogie { pivot: Vec2::zeros(), end: End::Rear })
                },
            },
        )
        .optional(),
    ],
};

static BOGIE: Table<Bogie> = Table {
    doc: "A link with two wheels, joined to a rocker.",
    fields: &[
        pivot(
            "Its axis, seen from the side, from the body's centre of mass where the rover stands \
             on a plane: x forward, z up",
            |it: &mut Bogie, axis| it.pivot.get_mut(axis),
        ),
        words(
            "end",
            "The end of the rover at which it is.",
            &[
                word("front", "Where its nose is.", |it: &mut Bogie| it.end = End::Front),
                word("rear", "Where its tail is.", |it: &mut Bogie| it.end = End::Rear),
            ],
        ),
    ],
};

/// The axis of a joint.
const fn pivot<T>(doc: &'static str, reach: fn(&mut T, usize) -> Option<&mut f64>) -> Field<T> {
    numbers("pivot_m", M, -10.0..=10.0, Form::Exactly(2), doc, |_, _| {}, reach)
}

/// How far wheels are steered.
const fn steering_limit<T>(doc: &'static str, reach: Reach<T>) -> Field<T> {
    number("steering_limit_deg", DEG, 0.0..=90.0, doc, reach)
}

/// How fast they are.
const fn steering_rate<T>(doc: &'static str, reach: Reach<T>) -> Field<T> {
    positive("steering_rate_deg_s", DEG_S, 3600.0, doc, reach)
}

/// Masses of bodies, and of wheels with their motors [kg].
pub(crate) const MASS: RangeInclusive<f64> = 0.01..=1e5;

static BODY: Table<Body> = Table {
    doc: "The body.",
    fields: &[
        number("mass_kg", KG, MASS, "Mass", |body| Some(&mut body.mass)),
        table(
            "inertia_kg_m2",
            "Moments of inertia about its centre of mass [kg·m²].",
            &At { inner: &INERTIA, at: |body: &mut Body| &mut body.inertia },
        ),
    ],
};

/// Mass of a wheel with its motor.
const fn unit_mass<T>(doc: &'static str, reach: Reach<T>) -> Field<T> {
    number("mass_kg", KG, MASS, doc, reach)
}

/// Inertia of a wheel with its motor.
const fn unit_inertia<T>(doc: &'static str, inner: &'static dyn Inner<T>) -> Field<T> {
    table("inertia_kg_m2", doc, inner)
}

static WHEEL_UNIT: Table<WheelUnit> = Table {
    doc: "A wheel with its motor.",
    fields: &[
        unit_mass("Mass", |unit: &mut WheelUnit| Some(&mut unit.mass)),
        unit_inertia(
            "Moments of inertia about its hub [kg·m²].",
            &At { inner: &INERTIA, at: |unit: &mut WheelUnit| &mut unit.inertia },
        ),
        part(
            "wheel",
            Kind::Wheel,
            "Its geometry: a preset's name, a path from this document's folder, or a wheel's keys.",
            &At { inner: &WHEEL, at: |unit: &mut WheelUnit| &mut unit.wheel },
        ),
    ],
};

static INERTIA: Table<Inertia> = Table {
    doc: "Moments of inertia about the principal axes [kg·m²].",
    fields: &[
        number("xx", KG_M2, 1e-9..=1e9, "About x, forward", |inertia| Some(&mut inertia.xx)),
        number("yy", KG_M2, 1e-9..=1e9, "About y, to the left", |inertia| Some(&mut inertia.yy)),
        number("zz", KG_M2, 1e-9..=1e9, "About z, up", |inertia| Some(&mut inertia.zz)),
    ],
};

static MOUNT: Table<MountParts> = Table {
    doc: "Where a wheel sits, and what it has instead of the common wheel unit.",
    fields: &[
        text("name", 1, "The wheel's name, such as `front-left`; no two alike.", |mount, name| {
            name.clone_into(&mut mount.name);
        }),
        text(
            "joint",
            1,
            "What logs of the robot call the joint that turns it, as URDF does, if that is another \
             name; with a minus before it where the joint's positive speeds roll the wheel backward, \
             as about an axis that points to the right.",
            |mount: &mut MountParts, joint| mount.joint = Some(joint.to_owned()),
        )
        .optional(),
        numbers(
            "position_m",
            M,
            -100.0..=100.0,
            Form::Exactly(3),
            "The wheel's centre, at a steering angle of zero, from the body's centre of mass: x \
             forward, y left, z up",
            |_, _| {},
            |mount, axis| mount.position.get_mut(axis),
        ),
        number(
            "steering_deg",
            DEG,
            -90.0..=90.0,
            "Steering angle, δ: the wheel is turned to the left by this much, for good if it has \
             no limit of steering; left out, it points straight ahead",
            |mount: &mut MountParts| Some(&mut mount.steering),
        )
        .optional(),
        steering_limit(
            "How far this wheel can be steered to either side, instead of the rover's; 0 if it is \
             not steered",
            |mount: &mut MountParts| Some(mount.steered.limit.get_or_insert(0.0)),
        )
        .optional(),
        steering_rate(
            "How fast this wheel is steered, instead of the rover's",
            |mount: &mut MountParts| Some(mount.steered.rate.get_or_insert(0.0)),
        )
        .optional(),
        numbers(
            "kingpin_offset_m",
            M,
            -10.0..=10.0,
            Form::Exactly(2),
            "Kingpin offset, k: from the wheel's centre, at a steering angle of zero, to the \
             upright axis about which it is steered: x forward, y left",
            |_, _| {},
            |mount: &mut MountParts, axis| mount.kingpin_offset.get_mut(axis),
        )
        .optional(),
        unit_mass(
            "Mass of this wheel with its motor, instead of the wheel unit's",
            |mount: &mut MountParts| Some(mount.mass.get_or_insert(0.0)),
        )
        .optional(),
        unit_inertia(
            "Moments of inertia of this wheel with its motor about its hub [kg·m²], instead of the \
             wheel unit's.",
            &At {
                inner: &INERTIA,
                at: |mount: &mut MountParts| mount.inertia.get_or_insert(NO_INERTIA),
            },
        )
        .optional(),
        part(
            "wheel",
            Kind::Wheel,
            "The geometry of this wheel, instead of the wheel unit's: a preset's name, a path from \
             this document's folder, or a wheel's keys.",
            &At {
                inner: &WHEEL,
                at: |mount: &mut MountParts| mount.wheel.get_or_insert(wheel::BLANK),
            },
        )
        .optional(),
        part(
            "motor",
            Kind::Motor,
            "The motor of this wheel, instead of the rover's: a preset's name, a path from this \
             document's folder, or a motor's keys.",
            &At { inner: &MOTOR, at: |mount: &mut MountParts| mount.motor.get_or_insert(NO_MOTOR) },
        )
        .optional(),
    ],
};
