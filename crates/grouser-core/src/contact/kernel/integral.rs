//! The force integral itself.

#![expect(clippy::inline_always, reason = "all of it is compiled once for each instruction set")]

use super::super::patch::ContactPatch;
use super::super::stress::{MobilisedShear, RimPoint, RimStress, ShearLaw, StressField};
use super::rule::{ArcRule, NodeBlock, Nodes};
use super::{LANES, Lanes, sum};

/// Integrals of the stresses over the arc [Pa·rad].
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::contact) struct StressSums {
    /// ∫ τ_x cos θ dθ
    pub shear_forward: f64,
    /// ∫ σ sin θ dθ
    pub normal_back: f64,
    /// ∫ (τ_x sin θ + σ cos θ) dθ
    pub up: f64,
    /// ∫ τ_x dθ
    pub shear: f64,
    /// ∫ τ_y dθ
    pub lateral: f64,
    /// ∫ τ_y cos θ dθ
    pub lateral_below: f64,
    /// ∫ τ_y sin θ dθ
    pub lateral_ahead: f64,
}

/// The same, for each lane's nodes.
#[derive(Default)]
struct LaneSums {
    shear_forward: Lanes,
    normal_back: Lanes,
    up: Lanes,
    shear: Lanes,
    lateral: Lanes,
    lateral_below: Lanes,
    lateral_ahead: Lanes,
}

/// The whole integral.
#[inline(always)]
pub(in crate::contact) fn all(field: &StressField, rule: &ArcRule) -> StressSums {
    let mut sums = LaneSums::default();
    over_arc::<true>(field, rule, &mut sums);
    StressSums {
        shear_forward: sum(&sums.shear_forward),
        normal_back: sum(&sums.normal_back),
        up: sum(&sums.up),
        shear: sum(&sums.shear),
        lateral: sum(&sums.lateral),
        lateral_below: sum(&sums.lateral_below),
        lateral_ahead: sum(&sums.lateral_ahead),
    }
}

/// [`StressSums::up`] alone, with the same bits.
#[inline(always)]
pub(in crate::contact) fn up(field: &StressField, rule: &ArcRule) -> f64 {
    let mut sums = LaneSums::default();
    over_arc::<false>(field, rule, &mut sums);
    sum(&sums.up)
}

#[inline(always)]
fn over_arc<const ALL: bool>(field: &StressField, rule: &ArcRule, sums: &mut LaneSums) {
    match field.law().shear_law() {
        MobilisedShear::Anisotropic(law) => over_pieces::<ALL>(field, &law, rule, sums),
        MobilisedShear::Bounded(law) => over_pieces::<ALL>(field, &law, rule, sums),
        MobilisedShear::Isotropic(law) => over_pieces::<ALL>(field, &law, rule, sums),
    }
}

/// Piece by piece: each of them is smooth.
#[inline(always)]
fn over_pieces<const ALL: bool>(
    field: &StressField,
    law: &impl ShearLaw,
    rule: &ArcRule,
    sums: &mut LaneSums,
) {
    let pieces = match rule.nodes(field.law()) {
        Nodes::BothSides(blocks) => {
            for block in blocks {
                over_both_sides::<ALL>(field, law, block, sums);
            }
            return;
        }
        Nodes::Pieces(pieces) => pieces,
    };
    let (count, breaks) = field.breaks();
    for (number, ends) in breaks[..count].windows(2).enumerate() {
        let blocks = match number {
            0 => pieces.opening,
            _ if number == count - 2 => pieces.closing,
            _ => pieces.inner,
        };
        let (start, span) = (breaks[0] - ends[0], ends[0] - ends[1]);
        for block in blocks {
            over_piece::<ALL>(field, law, block, start, span, sums);
        }
    }
}

/// No branch, no call, and no order among the lanes: this loop becomes vectors.
///
/// The normal stress behind the peak mirrors that before it, so two nodes that mirror each other
/// share it.
#[inline(always)]
fn over_both_sides<const ALL: bool>(
    field: &StressField,
    law: &impl ShearLaw,
    block: &NodeBlock,
    sums: &mut LaneSums,
) {
    let ContactPatch { entry, max_stress, exit } = field.patch;
    let (front, rear) = (entry - max_stress, max_stress - exit);
    for lane in 0..LANES {
        let (abscissa, width) = (block.abscissa[lane], block.width[lane]);
        let before = field.point(abscissa * front);
        let behind = field.point((front + rear) - abscissa * rear);
        let normal = field.front_normal(before.height);
        sums.add::<ALL>(lane, &before, field.stress(law, normal, &before), width * front);
        sums.add::<ALL>(lane, &behind, field.stress(law, normal, &behind), width * rear);
    }
}

/// The same for one piece of the arc, which begins `start` [rad] behind the entry.
#[inline(always)]
fn over_piece<const ALL: bool>(
    field: &StressField,
    law: &impl ShearLaw,
    block: &NodeBlock,
    start: f64,
    span: f64,
    sums: &mut LaneSums,
) {
    for lane in 0..LANES {
        let point = field.point(start + block.abscissa[lane] * span);
        let stress = field.stress(law, field.normal(&point), &point);
        sums.add::<ALL>(lane, &point, stress, block.width[lane] * span);
    }
}

impl LaneSums {
    #[inline(always)]
    fn add<const ALL: bool>(
        &mut self,
        lane: usize,
        point: &RimPoint,
        stress: RimStress,
        width: f64,
    ) {
        let (sin, cos) = (point.sin, point.cosine());
        let (along, inward) = (stress.longitudinal * width, stress.normal * width);
        self.up[lane] += along * sin + inward * cos;
        if ALL {
            let across = stress.lateral * width;
            self.shear_forward[lane] += along * cos;
            self.normal_back[lane] += inward * sin;
            self.shear[lane] += along;
            self.lateral[lane] += across;
            self.lateral_below[lane] += across * cos;
            self.lateral_ahead[lane] += across * sin;
        }
    }
}
