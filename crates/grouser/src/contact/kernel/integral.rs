//! The force integral itself.

#![expect(clippy::inline_always, reason = "all of it is compiled once for each instruction set")]

use super::super::patch::ContactPatch;
use super::super::stress::{MobilisedShear, ShearLaw, StressField};
use super::rule::{ArcRule, Pack};
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
    match field.shear_law() {
        MobilisedShear::Anisotropic(law) => over_pieces::<ALL>(field, &law, rule, sums),
        MobilisedShear::Isotropic(law) => over_pieces::<ALL>(field, &law, rule, sums),
    }
}

/// Piece by piece: each of them is smooth. Under a wheel that skids or is locked the soil shears at
/// once, however soft it is: there every piece has the finest rule's nodes.
#[inline(always)]
fn over_pieces<const ALL: bool>(
    field: &StressField,
    law: &impl ShearLaw,
    rule: &ArcRule,
    sums: &mut LaneSums,
) {
    if field.has_two_pieces() {
        let ContactPatch { entry, max_stress, exit } = field.patch;
        let spans = Spans { start: 0.0, front: entry - max_stress, rear: max_stress - exit };
        return over_packs::<ALL>(field, law, rule.whole, &spans, sums);
    }
    let (count, breaks) = field.breaks();
    for (number, ends) in breaks[..count].windows(2).enumerate() {
        let packs = match number {
            0 => rule.opening,
            _ if number == count - 2 => rule.closing,
            _ => rule.inner,
        };
        let spans = Spans { start: breaks[0] - ends[0], front: ends[0] - ends[1], rear: 0.0 };
        over_packs::<ALL>(field, law, packs, &spans, sums);
    }
}

/// The pieces that nodes lie on [rad].
struct Spans {
    /// From the entry to the first piece.
    start: f64,
    front: f64,
    rear: f64,
}

#[inline(always)]
fn over_packs<const ALL: bool>(
    field: &StressField,
    law: &impl ShearLaw,
    packs: &[Pack],
    spans: &Spans,
    sums: &mut LaneSums,
) {
    let Spans { start, front, rear } = *spans;
    for pack in packs {
        // No branch, no call, and no order among the lanes: this loop becomes vectors.
        for lane in 0..LANES {
            let behind_entry = start + (pack.front[lane] * front + pack.rear[lane] * rear);
            let width = pack.front_width[lane] * front + pack.rear_width[lane] * rear;
            let point = field.point(behind_entry);
            let stress = field.stress(law, &point);
            let (sin, cos) = (point.sin, point.cos());
            sums.up[lane] += (stress.longitudinal * sin + stress.normal * cos) * width;
            if ALL {
                sums.shear_forward[lane] += stress.longitudinal * cos * width;
                sums.normal_back[lane] += stress.normal * sin * width;
                sums.shear[lane] += stress.longitudinal * width;
                sums.lateral[lane] += stress.lateral * width;
                sums.lateral_below[lane] += stress.lateral * cos * width;
                sums.lateral_ahead[lane] += stress.lateral * sin * width;
            }
        }
    }
}
