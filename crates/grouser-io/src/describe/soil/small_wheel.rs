//! Terms of the model `small-wheel`.

use super::super::super::field::{At, DEG, Fill, ONE, Table, number, table};
use grouser_core::soil::SmallWheel;
use grouser_core::soil::small_wheel::{ExitShift, Interface, Mounds, SideWall, SinkageGrowth};

const DEFAULTS: Fill = Fill::Keys(&[]);
const GENERAL: SmallWheel = SmallWheel::GENERAL;

pub(super) static SMALL_WHEEL: Table<SmallWheel> = Table {
    doc: "What a small wheel's soil does beyond the classical law. A key that is left out has its \
          general value.",
    fields: &[
        table(
            "sinkage",
            "How a moving wheel sinks deeper than a plate.",
            &At { inner: &SINKAGE_GROWTH, at: |terms: &mut SmallWheel| &mut terms.sinkage },
        )
        .otherwise(DEFAULTS),
        table(
            "exit",
            "How the exit moves with the motion.",
            &At { inner: &EXIT_SHIFT, at: |terms: &mut SmallWheel| &mut terms.exit },
        )
        .otherwise(DEFAULTS),
        table(
            "interface",
            "Friction between wheel and soil.",
            &At { inner: &INTERFACE, at: |terms: &mut SmallWheel| &mut terms.interface },
        )
        .otherwise(DEFAULTS),
        table(
            "side_wall",
            "The soil's load on the side wall of the wheel.",
            &At { inner: &SIDE_WALL, at: |terms: &mut SmallWheel| &mut terms.side_wall },
        )
        .otherwise(DEFAULTS),
        table(
            "mounds",
            "Soil pushed by the width of the rim.",
            &At { inner: &MOUNDS, at: |terms: &mut SmallWheel| &mut terms.mounds },
        )
        .otherwise(DEFAULTS),
    ],
};

static SINKAGE_GROWTH: Table<SinkageGrowth> = Table {
    doc: "Sinkage growth ζ: the moving wheel meets at depth z what a plate meets at z/ζ.",
    fields: &[
        number(
            "with_slip_angle",
            ONE,
            0.0..=10.0,
            "Growth per sin β/(cos β + 0.3)",
            |growth: &mut SinkageGrowth| Some(&mut growth.with_slip_angle),
        )
        .or(GENERAL.sinkage.with_slip_angle),
        number(
            "with_slip",
            ONE,
            0.0..=20.0,
            "Growth with the slip by total speed, S/(1 − bend S)",
            |growth: &mut SinkageGrowth| Some(&mut growth.with_slip),
        )
        .or(GENERAL.sinkage.with_slip),
        number(
            "bend",
            ONE,
            -10.0..=0.95,
            "How that growth bends: above 0 it speeds up with slip, below 0 it slows down",
            |growth: &mut SinkageGrowth| Some(&mut growth.bend),
        )
        .or(GENERAL.sinkage.bend),
        number(
            "locked",
            ONE,
            0.0..=20.0,
            "Growth of a locked wheel",
            |growth: &mut SinkageGrowth| Some(&mut growth.locked),
        )
        .or(GENERAL.sinkage.locked),
        number(
            "sharpness",
            ONE,
            1.0..=20.0,
            "How much the larger of two growths hides the smaller; at 1 they add up",
            |growth: &mut SinkageGrowth| Some(&mut growth.sharpness),
        )
        .or(GENERAL.sinkage.sharpness),
    ],
};

static EXIT_SHIFT: Table<ExitShift> = Table {
    doc: "How the wheel sinkage ratio λ moves with the motion; it stays within 0 and 1.",
    fields: &[
        number(
            "fading",
            ONE,
            0.0..=1.0,
            "Share of λ that a wheel spinning on the spot has lost, in proportion to the slip by \
             total speed",
            |shift: &mut ExitShift| Some(&mut shift.fading),
        )
        .or(GENERAL.exit.fading),
        number(
            "with_slip",
            ONE,
            -2.0..=2.0,
            "Growth with the slip by total speed, while driving",
            |shift: &mut ExitShift| Some(&mut shift.with_slip),
        )
        .or(GENERAL.exit.with_slip),
        number(
            "with_slip_angle",
            ONE,
            -2.0..=2.0,
            "Growth with |sin β|",
            |shift: &mut ExitShift| Some(&mut shift.with_slip_angle),
        )
        .or(GENERAL.exit.with_slip_angle),
    ],
};

static INTERFACE: Table<Interface> = Table {
    doc: "Friction between wheel and soil.",
    fields: &[
        number(
            "friction_angle_deg",
            DEG,
            1.0..=60.0,
            "Friction angle of the wheel-soil interface, δ, where below the soil's own",
            |interface: &mut Interface| Some(interface.friction_angle.get_or_insert(0.0)),
        )
        .optional(),
        number(
            "friction_share",
            ONE,
            0.01..=1.0,
            "Without it: δ of a wheel without grousers, as a share of the soil's friction angle",
            |interface: &mut Interface| Some(&mut interface.friction_share),
        )
        .or(GENERAL.interface.friction_share),
    ],
};

static SIDE_WALL: Table<SideWall> = Table {
    doc: "The soil's load on the side wall of the wheel.",
    fields: &[
        number(
            "pressure_factor",
            ONE,
            0.0..=20.0,
            "Factor on the passive pressure, for the bow wave at the wall and for its ends",
            |wall: &mut SideWall| Some(&mut wall.pressure_factor),
        )
        .or(GENERAL.side_wall.pressure_factor),
        number(
            "fading",
            ONE,
            0.0..=10.0,
            "How fast the load fades with slip or skid: e^(−fading |S|)",
            |wall: &mut SideWall| Some(&mut wall.fading),
        )
        .or(GENERAL.side_wall.fading),
        number(
            "friction",
            ONE,
            0.0..=1.0,
            "Coefficient of friction of the side face, μ_f",
            |wall: &mut SideWall| Some(&mut wall.friction),
        )
        .or(GENERAL.side_wall.friction),
    ],
};

static MOUNDS: Table<Mounds> = Table {
    doc: "Soil pushed by the width of the rim, as factors on b R_b(h).",
    fields: &[
        number(
            "bow_wave",
            ONE,
            0.0..=20.0,
            "In front of a wheel that skids",
            |mounds: &mut Mounds| Some(&mut mounds.bow_wave),
        )
        .or(GENERAL.mounds.bow_wave),
        number(
            "rear_mound",
            ONE,
            0.0..=20.0,
            "Behind a wheel that spins",
            |mounds: &mut Mounds| Some(&mut mounds.rear_mound),
        )
        .or(GENERAL.mounds.rear_mound),
    ],
};
