//! The ranges within which a soil's constants were measured or fitted.

use super::super::super::field::{DEG, Field, Form, M, M_S2, N, ONE, Table, Unit, note, numbers};
use grouser_core::soil::{Domain, Span};
use std::ops::RangeInclusive;

pub(super) static DOMAIN: Table<Domain> = Table {
    doc: "The ranges within which the constants were measured or fitted, each as [smallest, \
          largest]; results outside carry flags.",
    fields: &[
        note("wheel", "The wheel of the fit, by its preset's name.").optional(),
        range("load_n", N, 0.0..=1e5, "Loads on the wheel", |it, place| end(&mut it.load, place)),
        range("radius_m", M, 0.01..=1.0, "Radii of the rims, without grousers, r", |it, place| {
            end(&mut it.radius, place)
        }),
        range("width_m", M, 0.001..=1.0, "Widths of the wheels or plates, b", |it, place| {
            end(&mut it.width, place)
        }),
        range("sinkage_over_radius", ONE, 0.0..=2.0, "Sinkages, as h/r_s", |it, place| {
            end(&mut it.depth, place)
        }),
        range("slip_ratio", ONE, -2.0..=2.0, "Slip ratios, s", |it, place| {
            end(&mut it.slip_ratio, place)
        }),
        range("slip_angle_deg", DEG, 0.0..=90.0, "Sizes of the slip angles, |β|", |it, place| {
            end(&mut it.slip_angle, place)
        }),
        range("gravity_m_s2", M_S2, 0.01..=30.0, "Gravities, g", |it, place| {
            end(&mut it.gravity, place)
        }),
    ],
};

const fn range(
    key: &'static str,
    unit: Unit,
    range: RangeInclusive<f64>,
    doc: &'static str,
    reach: fn(&mut Domain, usize) -> Option<&mut f64>,
) -> Field<Domain> {
    numbers(key, unit, range, Form::Exactly(2), doc, |_, _| {}, reach).optional()
}

fn end(span: &mut Span, place: usize) -> Option<&mut f64> {
    [&mut span.low, &mut span.high].into_iter().nth(place)
}
