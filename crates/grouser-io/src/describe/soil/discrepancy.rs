//! What a model gets wrong, as a calibration finds it.

use super::super::super::field::{Field, Form, ONE, Table, numbers};
use grouser_core::soil::Discrepancy;
use grouser_core::soil::discrepancy::{LARGEST, SIDE_VALUES, VALUES};

pub(super) static DISCREPANCY: Table<Discrepancy> = Table {
    doc: "What a model gets wrong in this soil under one wheel, as a function of slip and slip \
          angle: none for keys that are left out. Each list has the values at slips by the total \
          speed of -1, -0.5, 0, 0.5 and 1 for a slip angle of 0°, then for 15°, 45° and 90°. They \
          come from a calibration's samples, and are not to be set by hand.",
    fields: &[
        values(
            "drawbar_pull",
            VALUES,
            "Added to the drawbar pull, in shares of the load",
            |all, place| all.drawbar_pull.get_mut(place),
        ),
        values(
            "side_force",
            SIDE_VALUES,
            "Added to the side force, in shares of the load; it begins with 15°, since there is \
             none at 0°",
            |all, place| all.side_force.get_mut(place),
        ),
        values("sinkage", VALUES, "Added to the logarithm of the sinkage", |all, place| {
            all.sinkage.get_mut(place)
        }),
        values(
            "torque",
            VALUES,
            "Added to the torque, in shares of the load times the shearing radius",
            |all, place| all.torque.get_mut(place),
        ),
    ],
};

const fn values(
    key: &'static str,
    count: usize,
    doc: &'static str,
    reach: fn(&mut Discrepancy, usize) -> Option<&mut f64>,
) -> Field<Discrepancy> {
    numbers(key, ONE, -LARGEST..=LARGEST, Form::Exactly(count as u64), doc, |_, _| {}, reach)
        .optional()
}
