//! What differs from wheel to wheel and from place to place in a run: tables of a scenario.

use super::super::field::{
    DEG, Field, Fill, Form, M, ONE, Table, number, numbers, positive, whole,
};
use grouser_core::simulation::Scatter;
pub(super) use grouser_core::simulation::scatter::LARGEST_SEED;
use grouser_core::vehicle::{ByWheel, PerWheel};

pub(super) static BY_WHEEL: Table<ByWheel> = Table {
    doc: "What is known to differ from wheel to wheel: one number for all, or a list with one for \
          each mount, in their order.",
    fields: &[
        per_wheel(
            numbers(
                "friction_angle_offset_deg",
                DEG,
                -20.0..=20.0,
                FORM,
                "Added to the soil's angle of internal friction, Δφ []",
                |all: &mut ByWheel, count| all.friction_angle = room(count),
                |all: &mut ByWheel, place| all.friction_angle.number_mut(place),
            ),
            0.0,
        ),
        per_wheel(
            numbers(
                "stiffness_factor",
                ONE,
                0.1..=10.0,
                FORM,
                "Factor on the soil's stiffness: on k_c and k_phi, and on that of resistive force \
                 theory []",
                |all: &mut ByWheel, count| all.stiffness = room(count),
                |all: &mut ByWheel, place| all.stiffness.number_mut(place),
            ),
            1.0,
        ),
        per_wheel(
            numbers(
                "speed_factor",
                ONE,
                0.1..=10.0,
                FORM,
                "Factor on the speed that the drive tells the motor []",
                |all: &mut ByWheel, count| all.speed = room(count),
                |all: &mut ByWheel, place| all.speed.number_mut(place),
            ),
            1.0,
        ),
    ],
};

const FORM: Form = Form::OneOrEach("For every wheel", "For each mount, in the mounts' order");

const fn per_wheel(field: Field<ByWheel>, usual: f64) -> Field<ByWheel> {
    field.otherwise(Fill::Number(usual))
}

/// Room for one number, or for as many.
pub(super) fn room(count: Option<usize>) -> PerWheel {
    count.map_or(PerWheel::All(0.0), |count| PerWheel::Each(vec![0.0; count]))
}

pub(super) static SCATTER: Table<Scatter> = Table {
    doc: "What scatters unknown: standard deviations, and which of the beds and motors that they \
          describe a run has.",
    fields: &[
        number(
            "friction_angle_std_deg",
            DEG,
            0.0..=10.0,
            "Standard deviation of the angle of internal friction from place to place",
            |all: &mut Scatter| Some(&mut all.soil.friction_angle),
        )
        .or(0.0),
        number(
            "stiffness_std",
            ONE,
            0.0..=1.0,
            "Standard deviation of the soil's stiffness from place to place, as a share of it (of \
             its logarithm)",
            |all: &mut Scatter| Some(&mut all.soil.stiffness),
        )
        .or(0.0),
        positive(
            "correlation_length_m",
            M,
            1000.0,
            "Distance at which the correlation of the soil has fallen to 1/e; not below a \
             footprint's length",
            |all: &mut Scatter| Some(&mut all.soil.correlation_length),
        )
        .or(Scatter::USUAL_LENGTH),
        number(
            "speed_std",
            ONE,
            0.0..=0.2,
            "Standard deviation of each wheel's speed over a run, as a share of the speed that its \
             motor is set to (of its logarithm)",
            |all: &mut Scatter| Some(&mut all.speed),
        )
        .or(0.0),
        whole(
            "seed",
            0..=LARGEST_SEED,
            "uint64",
            "Which realisation a single run has; the runs of a campaign have one each, by its own \
             seed.",
            |all: &mut Scatter, seed| all.seed = seed,
        )
        .otherwise(Fill::Whole(0)),
    ],
};
