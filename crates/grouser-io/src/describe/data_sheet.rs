//! What the data sheet of a rover gives that is no number of its document: whole masses and sizes.

use super::super::field::{KG, M, Table, number, whole};

/// A rover as its data sheet has it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct DataSheet {
    /// Mass of all [kg].
    pub mass: f64,
    /// Pairs of wheels.
    pub axles: u32,
    /// From the first axle to the last [m].
    pub wheelbase: f64,
    /// From the middle of a left wheel to that of the right one [m].
    pub track: f64,
    /// Height of the common centre of mass over the ground [m].
    pub centre_height: f64,
    /// Length, width and height of the body [m].
    pub body: [f64; 3],
}

pub(crate) static DATA_SHEET: Table<DataSheet> = Table {
    doc: "A rover by its data sheet.",
    fields: &[
        number(
            "total_mass_kg",
            KG,
            0.1..=1e5,
            "Mass of the whole rover, with its wheels",
            |sheet: &mut DataSheet| Some(&mut sheet.mass),
        ),
        whole(
            "axle_count",
            2..=10,
            "uint32",
            "Axles, each with a wheel on the left and one on the right: 2 for four wheels, 3 for \
             six.",
            |sheet: &mut DataSheet, count| sheet.axles = u32::try_from(count).unwrap_or(u32::MAX),
        ),
        number("wheelbase_m", M, 0.02..=50.0, "From the first axle to the last", |sheet| {
            Some(&mut sheet.wheelbase)
        }),
        number(
            "track_m",
            M,
            0.02..=50.0,
            "From the middle of a left wheel to the middle of the right one",
            |sheet| Some(&mut sheet.track),
        ),
        number(
            "centre_of_mass_height_m",
            M,
            0.01..=50.0,
            "Height of the centre of mass of body and wheels over the ground",
            |sheet| Some(&mut sheet.centre_height),
        ),
        number("body_length_m", M, 0.01..=50.0, "Length of the body, for its inertia", |sheet| {
            Some(&mut sheet.body[0])
        }),
        number("body_width_m", M, 0.01..=50.0, "Width of the body, for its inertia", |sheet| {
            Some(&mut sheet.body[1])
        }),
        number("body_height_m", M, 0.01..=50.0, "Height of the body, for its inertia", |sheet| {
            Some(&mut sheet.body[2])
        }),
    ],
};
