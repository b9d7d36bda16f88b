//! Where on the arc the nodes are, and how many.
//!
//! At both ends of the arc the stress starts like a power *n* of the distance, which is no
//! polynomial. Squaring the variable there (θ = θ_f − span x²) turns it into 2n + 1, smooth
//! enough for a Gauss rule from n = 0.5 on.

use std::f64::consts::FRAC_PI_2;

use super::super::gauss::{GAUSS_8, GAUSS_16, GAUSS_64, Rule as Gauss};
use super::super::inputs::Contact;
use super::super::stress::StressLaw;
use super::{LANES, Lanes};
use crate::soil::{Shear, ShearModulus};

/// Nodes on a span.
///
/// A node lies its abscissa, a share of the span, behind the span's front end (behind the peak:
/// before its rear end), and stands for its width of it.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct NodeBlock {
    pub abscissa: Lanes,
    pub width: Lanes,
}

/// How an arc is integrated.
#[derive(Debug)]
pub(in crate::contact) struct ArcRule {
    /// Each half of an arc of two pieces, as every driving wheel has.
    pub(super) two_piece: &'static [NodeBlock],
    /// The same where the slip velocity turns under the hub.
    pub(super) near_stall: &'static [NodeBlock],
    /// The pieces of any other arc.
    pub(super) pieces: &'static PieceRule,
    /// The same under a wheel that is almost locked: the soil shears at once, however soft it is.
    pub(super) fast_slip: &'static PieceRule,
}

/// The nodes of one arc.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) enum Nodes {
    /// Each half of an arc of two pieces.
    BothSides(&'static [NodeBlock]),
    /// Piece by piece.
    Pieces(&'static PieceRule),
}

/// How a piece is integrated at the entry, within the arc, and at the exit.
#[derive(Debug)]
pub(in crate::contact) struct PieceRule {
    pub opening: &'static [NodeBlock],
    pub inner: &'static [NodeBlock],
    pub closing: &'static [NodeBlock],
}

impl PieceRule {
    /// Blocks of nodes on a piece.
    pub(in crate::contact) fn blocks(&self) -> usize {
        self.inner.len()
    }
}

impl ArcRule {
    /// The one with as few nodes as 1e-6 of the load allows.
    ///
    /// It follows from the wheel and the soil, never from the sinkage. Shear that is mobilised over
    /// a short length bends the stress near the entry; so does a peak that lies there. The motion
    /// has a say only under wheels that skid fast and, in the isotropic law, under wheels that slip
    /// little: where it changes the rule, forces jump by no more than the error that is allowed.
    pub(in crate::contact) fn of(contact: &Contact) -> &'static Self {
        /// The largest r_s/K [-] and θ_m/θ_f [-]. Source: measured, `docs/models/ishigami.md`.
        const COARSE_UP_TO: f64 = 10.0;
        const PEAK_UP_TO: f64 = 0.56;
        let (soil, radius) = (&contact.soil, contact.wheel.shearing_radius());
        let smallest = |modulus: &ShearModulus| modulus.at(0.0).min(modulus.at(FRAC_PI_2));
        let (coarse, softest) = match &soil.shear {
            Shear::Anisotropic { longitudinal, lateral } => {
                (&COARSE, smallest(longitudinal).min(smallest(lateral)))
            }
            Shear::Isotropic { modulus } => (&COARSE_ISOTROPIC, smallest(modulus)),
        };
        let peak = soil.stress_peak.a0 + soil.stress_peak.a1.max(0.0);
        if peak <= PEAK_UP_TO && radius <= COARSE_UP_TO * softest { coarse } else { &FINE }
    }

    /// The nodes under a wheel, by how it moves.
    #[inline]
    pub(in crate::contact) fn nodes(&self, law: &StressLaw) -> Nodes {
        if law.has_two_pieces() {
            let near_stall = law.turns_under_hub();
            Nodes::BothSides(if near_stall { self.near_stall } else { self.two_piece })
        } else {
            Nodes::Pieces(if law.shears_at_once() { self.fast_slip } else { self.pieces })
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

const fn abscissa(ends: Ends, (x, weight): (f64, f64)) -> (f64, f64) {
    match ends {
        Ends::Opening => (x * x, 2.0 * x * weight),
        Ends::Inner => (x, weight),
        Ends::Closing => (1.0 - x * x, 2.0 * x * weight),
    }
}

/// One piece.
const fn piece<const BLOCKS: usize>(ends: Ends, rule: &Gauss) -> [NodeBlock; BLOCKS] {
    assert!(rule.len() == BLOCKS * LANES, "the nodes fill the lanes");
    let mut blocks = [NodeBlock { abscissa: [0.0; LANES], width: [0.0; LANES] }; BLOCKS];
    let mut k = 0;
    while k < rule.len() {
        let (block, lane) = (&mut blocks[k / LANES], k % LANES);
        (block.abscissa[lane], block.width[lane]) = abscissa(ends, rule[k]);
        k += 1;
    }
    blocks
}

/// Nodes for what is smooth at both ends.
pub(in crate::contact) static EVEN: NodeBlock = piece::<1>(Ends::Inner, &GAUSS_8)[0];

static OPENING_8: [NodeBlock; 1] = piece(Ends::Opening, &GAUSS_8);
static INNER_8: [NodeBlock; 1] = piece(Ends::Inner, &GAUSS_8);
static CLOSING_8: [NodeBlock; 1] = piece(Ends::Closing, &GAUSS_8);
static OPENING_16: [NodeBlock; 2] = piece(Ends::Opening, &GAUSS_16);
static INNER_16: [NodeBlock; 2] = piece(Ends::Inner, &GAUSS_16);
static CLOSING_16: [NodeBlock; 2] = piece(Ends::Closing, &GAUSS_16);
static OPENING_64: [NodeBlock; 8] = piece(Ends::Opening, &GAUSS_64);
static INNER_64: [NodeBlock; 8] = piece(Ends::Inner, &GAUSS_64);
static CLOSING_64: [NodeBlock; 8] = piece(Ends::Closing, &GAUSS_64);

static PIECES_8: PieceRule =
    PieceRule { opening: &OPENING_8, inner: &INNER_8, closing: &CLOSING_8 };
static PIECES_16: PieceRule =
    PieceRule { opening: &OPENING_16, inner: &INNER_16, closing: &CLOSING_16 };
static PIECES_64: PieceRule =
    PieceRule { opening: &OPENING_64, inner: &INNER_64, closing: &CLOSING_64 };

/// For soils in which shear is mobilised over lengths like a tenth of the wheel's radius and more.
pub(in crate::contact) static COARSE: ArcRule = ArcRule {
    two_piece: &OPENING_8,
    near_stall: &OPENING_8,
    pieces: &PIECES_8,
    fast_slip: &PIECES_16,
};
/// The same for the isotropic law, whose stress turns where the rim is nearly as fast as the soil.
pub(in crate::contact) static COARSE_ISOTROPIC: ArcRule = ArcRule {
    two_piece: &OPENING_8,
    near_stall: &OPENING_16,
    pieces: &PIECES_16,
    fast_slip: &PIECES_16,
};
/// For all.
pub(in crate::contact) static FINE: ArcRule = ArcRule {
    two_piece: &OPENING_16,
    near_stall: &OPENING_16,
    pieces: &PIECES_16,
    fast_slip: &PIECES_16,
};
/// Four times as many as the finest, to measure the others' error.
pub(in crate::contact) static REFERENCE: ArcRule = ArcRule {
    two_piece: &OPENING_64,
    near_stall: &OPENING_64,
    pieces: &PIECES_64,
    fast_slip: &PIECES_64,
};
