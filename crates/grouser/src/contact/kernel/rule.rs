//! Where on the arc the nodes are, and how many.
//!
//! At both ends of the arc the stress starts like a power *n* of the distance, which is no
//! polynomial. Squaring the variable there (θ = θ_f − span x²) turns it into 2n + 1, smooth
//! enough for a Gauss rule from n = 0.5 on.

use std::f64::consts::FRAC_PI_2;

use super::super::gauss::{
    GAUSS_7, GAUSS_9, GAUSS_10, GAUSS_14, GAUSS_16, GAUSS_64, Rule as Gauss,
};
use super::super::model::Contact;
use super::{LANES, Lanes};
use crate::soil::{Shear, ShearModulus};

/// A few nodes on two spans that follow each other: before the stress peak and behind it.
///
/// A node lies `front` first spans and `rear` second spans behind the entry, and stands for as many
/// of them as its widths.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pack {
    pub front: Lanes,
    pub rear: Lanes,
    pub front_width: Lanes,
    pub rear_width: Lanes,
}

/// How an arc is integrated.
#[derive(Debug)]
pub(in crate::contact) struct ArcRule {
    /// An arc of two pieces, as every driving wheel has.
    pub(super) whole: &'static [Pack],
    /// One piece (its nodes lie on the first span): at the entry, within the arc, at the exit.
    pub(super) opening: &'static [Pack],
    pub(super) inner: &'static [Pack],
    pub(super) closing: &'static [Pack],
}

impl ArcRule {
    /// The one with as few nodes as 1e-6 of the load allows.
    ///
    /// It follows from the wheel and the soil alone, never from the motion or the sinkage: a wheel
    /// that moves in one soil keeps its rule, and no force jumps. Shear that is mobilised over a short
    /// length bends the stress near the entry; so does a peak that lies there; and in the isotropic
    /// law the stress turns under a wheel that nearly rolls.
    pub(in crate::contact) fn of(contact: &Contact) -> &'static Self {
        /// The largest r_s/K [-] and θ_m/θ_f [-]. Source: measured, `docs/models/ishigami.md`.
        const COARSE_UP_TO: f64 = 10.0;
        const MEDIUM_UP_TO: f64 = 40.0;
        const PEAK_UP_TO: f64 = 0.7;
        let (soil, radius) = (&contact.soil, contact.wheel.shearing_radius());
        let Shear::Anisotropic { longitudinal, lateral } = &soil.shear else { return &FINE };
        let smallest = |modulus: &ShearModulus| modulus.at(0.0).min(modulus.at(FRAC_PI_2));
        let hardness = radius / smallest(longitudinal).min(smallest(lateral));
        let peak = soil.stress_peak.share(0.0).max(soil.stress_peak.share(1.0));
        if peak > PEAK_UP_TO || hardness > MEDIUM_UP_TO {
            &FINE
        } else if hardness > COARSE_UP_TO {
            &MEDIUM
        } else {
            &COARSE
        }
    }
}

/// How a piece's variable runs.
#[derive(Clone, Copy)]
enum Ends {
    Opening,
    Inner,
    Closing,
}

const fn share(ends: Ends, (x, weight): (f64, f64)) -> (f64, f64) {
    match ends {
        Ends::Opening => (x * x, 2.0 * x * weight),
        Ends::Inner => (x, weight),
        Ends::Closing => (1.0 - x * x, 2.0 * x * weight),
    }
}

impl Pack {
    const EMPTY: Self = Self {
        front: [0.0; LANES],
        rear: [0.0; LANES],
        front_width: [0.0; LANES],
        rear_width: [0.0; LANES],
    };
}

/// One piece, on the first span.
const fn piece<const PACKS: usize>(ends: Ends, rule: &Gauss) -> [Pack; PACKS] {
    assert!(rule.len() == PACKS * LANES, "the nodes fill the lanes");
    let mut packs = [Pack::EMPTY; PACKS];
    let mut k = 0;
    while k < rule.len() {
        let (pack, lane) = (&mut packs[k / LANES], k % LANES);
        (pack.front[lane], pack.front_width[lane]) = share(ends, rule[k]);
        k += 1;
    }
    packs
}

/// Two pieces, from the entry to the exit.
const fn arc<const PACKS: usize>(front: &Gauss, rear: &Gauss) -> [Pack; PACKS] {
    assert!(front.len() + rear.len() == PACKS * LANES, "the nodes fill the lanes");
    let mut packs = [Pack::EMPTY; PACKS];
    let mut k = 0;
    while k < PACKS * LANES {
        let (pack, lane) = (&mut packs[k / LANES], k % LANES);
        if k < front.len() {
            (pack.front[lane], pack.front_width[lane]) = share(Ends::Opening, front[k]);
        } else {
            pack.front[lane] = 1.0;
            let node = rear[k - front.len()];
            (pack.rear[lane], pack.rear_width[lane]) = share(Ends::Closing, node);
        }
        k += 1;
    }
    packs
}

static OPENING_16: [Pack; 2] = piece(Ends::Opening, &GAUSS_16);
static INNER_16: [Pack; 2] = piece(Ends::Inner, &GAUSS_16);
static CLOSING_16: [Pack; 2] = piece(Ends::Closing, &GAUSS_16);
static ARC_16: [Pack; 2] = arc(&GAUSS_7, &GAUSS_9);
static ARC_24: [Pack; 3] = arc(&GAUSS_10, &GAUSS_14);
static ARC_32: [Pack; 4] = arc(&GAUSS_16, &GAUSS_16);
static OPENING_64: [Pack; 8] = piece(Ends::Opening, &GAUSS_64);
static INNER_64: [Pack; 8] = piece(Ends::Inner, &GAUSS_64);
static CLOSING_64: [Pack; 8] = piece(Ends::Closing, &GAUSS_64);
static ARC_128: [Pack; 16] = arc(&GAUSS_64, &GAUSS_64);

const fn sixteen_each(whole: &'static [Pack]) -> ArcRule {
    ArcRule { whole, opening: &OPENING_16, inner: &INNER_16, closing: &CLOSING_16 }
}

/// For soils in which shear is mobilised over lengths like a tenth of the wheel's radius and more.
pub(in crate::contact) static COARSE: ArcRule = sixteen_each(&ARC_16);
/// For soils in which it is mobilised over a fortieth and more.
pub(in crate::contact) static MEDIUM: ArcRule = sixteen_each(&ARC_24);
/// For all.
pub(in crate::contact) static FINE: ArcRule = sixteen_each(&ARC_32);
/// Four times as many as the finest, to measure the others' error.
pub(in crate::contact) static REFERENCE: ArcRule =
    ArcRule { whole: &ARC_128, opening: &OPENING_64, inner: &INNER_64, closing: &CLOSING_64 };
