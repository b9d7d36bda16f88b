//! `[terrain]` of scenarios and missions: ground with heights, from a map or by a formula, and
//! where on it a run starts.

use super::super::field::{
    DEG, Field, Form, Law, Laws, M, Table, note, number, numbers, positive, whole,
};
use super::zones;
use grouser_core::terrain::surface::{Cone, Crater, Incline, Ramp, Ripple};
use grouser_core::terrain::{Ground, Shape, Surface};
use grouser_core::units::Vec2;

/// The farthest that coordinates of a map may be from its origin [m]: beyond the circumference of
/// any planet.
pub(super) const FARTHEST: f64 = 1e9;
/// The largest hill, crater or wave [m].
const LARGEST: f64 = 1e6;
/// The steepest inclination by a formula [°].
const STEEPEST: f64 = 60.0;

/// The key of a map's file, in the table.
pub(crate) const FILE: &str = "file";
/// The key of the start, in the table.
pub(crate) const START: &str = "start_m";
/// Keys of what a map's file may leave open, in the table.
pub(crate) const CELL_SIZE: &str = "cell_size_m";
/// The place of the first point.
pub(crate) const SOUTH_WEST: &str = "south_west_m";
/// The band of a GeoTIFF.
pub(crate) const BAND: &str = "band";
/// A height that stands for a missing one.
pub(crate) const MISSING: &str = "missing_m";

/// How steep a formula's ground is.
const SLOPE: &str = "slope_deg";

/// Level ground, which is there before anything is said of it.
const LEVEL: Surface = Surface::Incline(Incline { slope: 0.0, uphill: 0.0 });

/// The formula of ground that has one.
fn surface(ground: &mut Ground) -> Option<&mut Surface> {
    match &mut ground.shape {
        Shape::Formula(surface) => Some(surface),
        Shape::Plane(_) | Shape::Map(_) | Shape::Own(_) => None,
    }
}

fn incline(terrain: &mut Ground) -> Option<&mut Incline> {
    match surface(terrain)? {
        Surface::Incline(incline) => Some(incline),
        _ => None,
    }
}

fn ramp(terrain: &mut Ground) -> Option<&mut Ramp> {
    match surface(terrain)? {
        Surface::Ramp(ramp) => Some(ramp),
        _ => None,
    }
}

fn cone(terrain: &mut Ground) -> Option<&mut Cone> {
    match surface(terrain)? {
        Surface::Cone(cone) => Some(cone),
        _ => None,
    }
}

fn ripple(terrain: &mut Ground) -> Option<&mut Ripple> {
    match surface(terrain)? {
        Surface::Ripple(ripple) => Some(ripple),
        _ => None,
    }
}

fn crater(terrain: &mut Ground) -> Option<&mut Crater> {
    match surface(terrain)? {
        Surface::Crater(crater) => Some(crater),
        _ => None,
    }
}

pub(super) static TERRAIN: Laws<Ground> = Laws {
    doc: "Ground with heights, in place of the plane. Places are on a map: x east, y north, in \
          metres.",
    key: "surface",
    may_be_left_out: true,
    is_written_last: false,
    all: &[
        Law {
            name: "map",
            word: Some("A map of heights."),
            choose: |terrain| terrain.shape = Shape::Formula(LEVEL),
            table: Table {
                doc: "An elevation model from a file.",
                fields: &[
                    note(
                        FILE,
                        "A GeoTIFF in metres of a projection, a NumPy array (.npy), or text with \
                         x, y and z in each line: a path from this document's folder.",
                    ),
                    STARTS,
                    zones::SOIL_FILE,
                    zones::ZONES,
                    positive(
                        CELL_SIZE,
                        M,
                        LARGEST,
                        "Distance between neighbouring points of a file that does not say it",
                        |_| None,
                    )
                    .optional(),
                    place(
                        SOUTH_WEST,
                        "The point farthest to the south and west of a file that does not say it, \
                         x and y: the middle of its cell; left out, the origin",
                        |_, _| None,
                    ),
                    whole(
                        BAND,
                        1..=65_535,
                        "uint16",
                        "Which band of a GeoTIFF has the heights, from 1.",
                        |_, _| {},
                    )
                    .optional(),
                    number(
                        MISSING,
                        M,
                        -1e38..=1e38,
                        "A height that stands for a missing one, beside those that the file \
                         declares",
                        |_| None,
                    )
                    .optional(),
                ],
            },
        },
        Law {
            name: "incline",
            word: Some("A plane."),
            choose: |terrain| terrain.shape = Shape::Formula(LEVEL),
            table: Table {
                doc: "A plane through the map's origin.",
                fields: &[
                    slope(|it| Some(&mut incline(it)?.slope)),
                    uphill("Direction in which it rises, from east to the left", |it| {
                        Some(&mut incline(it)?.uphill)
                    }),
                    STARTS,
                    zones::SOIL_FILE,
                    zones::ZONES,
                ],
            },
        },
        Law {
            name: "ramp",
            word: Some("An incline between two level pieces of ground."),
            choose: |terrain| terrain.shape = Shape::Formula(Surface::Ramp(NO_RAMP)),
            table: Table {
                doc: "An incline between two level pieces of ground.",
                fields: &[
                    place(
                        "foot_m",
                        "A place on the line where it starts, x and y; left out, the origin",
                        |terrain, axis| ramp(terrain)?.foot.get_mut(axis),
                    ),
                    slope(|it| Some(&mut ramp(it)?.slope)),
                    uphill("Direction in which it rises, from east to the left", |it| {
                        Some(&mut ramp(it)?.uphill)
                    }),
                    positive("length_m", M, LARGEST, "Its length on the map", |it| {
                        Some(&mut ramp(it)?.length)
                    }),
                    rounding(
                        "Length on the map over which the slope changes, at its foot and at \
                              its top",
                        |it| Some(&mut ramp(it)?.rounding),
                    ),
                    STARTS,
                    zones::SOIL_FILE,
                    zones::ZONES,
                ],
            },
        },
        Law {
            name: "cone",
            word: Some("A round hill or pit of even slope."),
            choose: |terrain| terrain.shape = Shape::Formula(Surface::Cone(NO_CONE)),
            table: Table {
                doc: "A cone about a vertical axis.",
                fields: &[
                    place(
                        "tip_m",
                        "Where its axis is, x and y; left out, the origin",
                        |terrain, axis| cone(terrain)?.tip.get_mut(axis),
                    ),
                    number(
                        SLOPE,
                        DEG,
                        -STEEPEST..=STEEPEST,
                        "Inclination: above 0 a hill, below a pit",
                        |it| Some(&mut cone(it)?.slope),
                    ),
                    rounding("How far from the axis the tip is rounded", |it| {
                        Some(&mut cone(it)?.rounding)
                    }),
                    STARTS,
                    zones::SOIL_FILE,
                    zones::ZONES,
                ],
            },
        },
        Law {
            name: "ripple",
            word: Some("Straight waves."),
            choose: |terrain| terrain.shape = Shape::Formula(Surface::Ripple(NO_RIPPLE)),
            table: Table {
                doc: "Straight waves of one length.",
                fields: &[
                    number(
                        "amplitude_m",
                        M,
                        0.0..=LARGEST,
                        "Half of the height from trough to crest",
                        |it| Some(&mut ripple(it)?.amplitude),
                    ),
                    positive("wavelength_m", M, LARGEST, "Distance from crest to crest", |it| {
                        Some(&mut ripple(it)?.wavelength)
                    }),
                    uphill("Direction from crest to crest, from east to the left", |it| {
                        Some(&mut ripple(it)?.across)
                    }),
                    number("phase_deg", DEG, -360.0..=360.0, "Phase at the origin", |it| {
                        Some(&mut ripple(it)?.phase)
                    })
                    .or(0.0),
                    STARTS,
                    zones::SOIL_FILE,
                    zones::ZONES,
                ],
            },
        },
        Law {
            name: "crater",
            word: Some("A bowl with a rim."),
            choose: |terrain| terrain.shape = Shape::Formula(Surface::Crater(NO_CRATER)),
            table: Table {
                doc: "A bowl with a rim, in level ground.",
                fields: &[
                    place(
                        "centre_m",
                        "Where its centre is, x and y; left out, the origin",
                        |terrain, axis| crater(terrain)?.centre.get_mut(axis),
                    ),
                    positive("diameter_m", M, LARGEST, "Diameter of the crest", |it| {
                        Some(&mut crater(it)?.diameter)
                    }),
                    number(
                        "depth_m",
                        M,
                        0.0..=LARGEST,
                        "How far the centre is below the crest",
                        |it| Some(&mut crater(it)?.depth),
                    ),
                    number(
                        "rim_height_m",
                        M,
                        0.0..=LARGEST,
                        "How far the crest is above the ground about it",
                        |it| Some(&mut crater(it)?.rim_height),
                    ),
                    positive(
                        "rim_width_m",
                        M,
                        LARGEST,
                        "How far from the crest the ground is level again",
                        |it| Some(&mut crater(it)?.rim_width),
                    ),
                    STARTS,
                    zones::SOIL_FILE,
                    zones::ZONES,
                ],
            },
        },
    ],
};

const NO_RAMP: Ramp =
    Ramp { foot: Vec2::new(0.0, 0.0), uphill: 0.0, slope: 0.0, length: 0.0, rounding: 0.0 };
const NO_CONE: Cone = Cone { tip: Vec2::new(0.0, 0.0), slope: 0.0, rounding: 0.0 };
const NO_RIPPLE: Ripple = Ripple { amplitude: 0.0, wavelength: 1.0, across: 0.0, phase: 0.0 };
const NO_CRATER: Crater = Crater {
    centre: Vec2::new(0.0, 0.0),
    diameter: 1.0,
    depth: 0.0,
    rim_height: 0.0,
    rim_width: 1.0,
};

const STARTS: Field<Ground> = place(
    START,
    "Where the body's centre of mass is at the start, on the map, x and y; left out, the middle of \
     the map, or the origin of a formula",
    |terrain, axis| terrain.start.get_mut(axis),
);

/// A place on the map that may be left out.
const fn place(
    key: &'static str,
    doc: &'static str,
    reach: fn(&mut Ground, usize) -> Option<&mut f64>,
) -> Field<Ground> {
    numbers(key, M, -FARTHEST..=FARTHEST, Form::Exactly(2), doc, |_, _| {}, reach).optional()
}

/// How steep it is.
const fn slope(reach: fn(&mut Ground) -> Option<&mut f64>) -> Field<Ground> {
    number(SLOPE, DEG, 0.0..=STEEPEST, "Inclination", reach)
}

/// A direction on the map.
const fn uphill(doc: &'static str, reach: fn(&mut Ground) -> Option<&mut f64>) -> Field<Ground> {
    number("direction_deg", DEG, -360.0..=360.0, doc, reach).or(0.0)
}

/// A length over which an edge is rounded.
const fn rounding(doc: &'static str, reach: fn(&mut Ground) -> Option<&mut f64>) -> Field<Ground> {
    number("rounding_m", M, 0.0..=LARGEST, doc, reach).or(0.0)
}
