//! `rover/1`: a body and its wheels.

use super::super::field::{
    At, DEG, Each, Field, Form, Inner, KG, KG_M2, M, Reach, Table, list, number, numbers, part,
    table, text,
};
use super::super::kind::Kind;
use super::about::{assumed, name, notes, schema, source};
use super::wheel::{self, WHEEL};
use grouser_core::units::Vec3;
use grouser_core::vehicle::{Body, Inertia, MountParts, RoverParts, WheelUnit};

const NO_INERTIA: Inertia = Inertia { xx: 0.0, yy: 0.0, zz: 0.0 };

/// A rover before its numbers are put in.
pub(crate) const BLANK: RoverParts = RoverParts {
    body: Body { mass: 0.0, inertia: NO_INERTIA },
    wheel_unit: WheelUnit { mass: 0.0, inertia: NO_INERTIA, wheel: wheel::BLANK },
    mounts: Vec::new(),
};

pub(crate) static ROVER: Table<RoverParts> = Table {
    doc: "A body and three or more wheels, rigidly joined.",
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
        list(
            "mount",
            "Where the wheels sit: three or more, standing on one plane, not in one line.",
            &Each {
                inner: &MOUNT,
                list: |rover: &mut RoverParts| &mut rover.mounts,
                blank: || MountParts {
                    name: String::new(),
                    position: Vec3::zeros(),
                    steering: 0.0,
                    wheel: None,
                    mass: None,
                    inertia: None,
                },
            },
            3,
        ),
    ],
};

static BODY: Table<Body> = Table {
    doc: "The body.",
    fields: &[
        number("mass_kg", KG, 0.01..=1e5, "Mass", |body| Some(&mut body.mass)),
        table(
            "inertia_kg_m2",
            "Moments of inertia about its centre of mass [kg·m²].",
            &At { inner: &INERTIA, at: |body: &mut Body| &mut body.inertia },
        ),
    ],
};

/// Mass of a wheel with its motor.
const fn unit_mass<T>(doc: &'static str, reach: Reach<T>) -> Field<T> {
    number("mass_kg", KG, 0.01..=1e5, doc, reach)
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
        numbers(
            "position_m",
            M,
            -100.0..=100.0,
            Form::Exactly(3),
            "The wheel's centre from the body's centre of mass: x forward, y left, z up",
            |_, _| {},
            |mount, axis| mount.position.get_mut(axis),
        ),
        number(
            "steering_deg",
            DEG,
            -90.0..=90.0,
            "Steering angle, δ: the wheel is turned to the left by this much, for good; left out, it points straight ahead",
            |mount: &mut MountParts| Some(&mut mount.steering),
        )
        .optional(),
        unit_mass(
            "Mass of this wheel with its motor, instead of the wheel unit's",
            |mount: &mut MountParts| Some(mount.mass.get_or_insert(0.0)),
        )
        .optional(),
        unit_inertia(
            "Moments of inertia of this wheel with its motor about its hub [kg·m²], instead of the wheel unit's.",
            &At {
                inner: &INERTIA,
                at: |mount: &mut MountParts| mount.inertia.get_or_insert(NO_INERTIA),
            },
        )
        .optional(),
        part(
            "wheel",
            Kind::Wheel,
            "The geometry of this wheel, instead of the wheel unit's: a preset's name, a path from this document's folder, or a wheel's keys.",
            &At {
                inner: &WHEEL,
                at: |mount: &mut MountParts| mount.wheel.get_or_insert(wheel::BLANK),
            },
        )
        .optional(),
    ],
};
