//! `rover/1`: a body and its wheels.

use super::super::Kind;
use super::super::field::{
    At, Each, Form, KG, KG_M2, M, Table, list, number, numbers, part, table, text,
};
use super::wheel::{self, WHEEL};
use super::{assumed, name, notes, schema, source};
use grouser_core::units::Vec3;
use grouser_core::vehicle::{Body, Inertia, Mount, RoverParts, WheelUnit};

const NO_INERTIA: Inertia = Inertia { xx: 0.0, yy: 0.0, zz: 0.0 };

/// A rover before its numbers are put in.
pub const BLANK: RoverParts = RoverParts {
    body: Body { mass: 0.0, inertia: NO_INERTIA },
    wheel_unit: WheelUnit { mass: 0.0, inertia: NO_INERTIA, wheel: wheel::BLANK },
    mounts: Vec::new(),
};

pub static ROVER: Table<RoverParts> = Table {
    doc: "A body and three or more equal wheels, rigidly joined.",
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
            "A wheel with its motor; all are the same.",
            &At { inner: &WHEEL_UNIT, at: |rover: &mut RoverParts| &mut rover.wheel_unit },
        ),
        list(
            "mount",
            "Where the wheels sit: three or more, hubs of one height, not in one line.",
            &Each {
                inner: &MOUNT,
                list: |rover: &mut RoverParts| &mut rover.mounts,
                blank: || Mount { name: String::new(), position: Vec3::zeros() },
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

static WHEEL_UNIT: Table<WheelUnit> = Table {
    doc: "A wheel with its motor.",
    fields: &[
        number("mass_kg", KG, 0.01..=1e5, "Mass", |unit| Some(&mut unit.mass)),
        table(
            "inertia_kg_m2",
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

static MOUNT: Table<Mount> = Table {
    doc: "Where a wheel sits.",
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
    ],
};
