//! Where the stresses along an arc are not smooth.

use super::{MobilisedShear, StressField, TURNS_UNDER_HUB};
use crate::contact::patch::ContactPatch;
use crate::contact::slip::Slip;
use crate::{elementary, root};

/// At most this many points divide the arc into pieces on which the stresses are smooth: entry,
/// exit, stress peak, two zeros of the shear displacement, two of the slip velocity.
const MOST_BREAKS: usize = 7;

impl StressField {
    /// The ends of the pieces of the arc on which the stresses are smooth, in falling order:
    /// how many of the array's numbers count, and they.
    ///
    /// A driving wheel has two pieces, before and behind the stress peak. Where the rim skids,
    /// the shear displacement (or, in the isotropic law, the slip velocity) changes sign within
    /// the arc; a quadrature across that corner would lose most of its digits.
    pub(in crate::contact) fn breaks(&self) -> (usize, [f64; MOST_BREAKS]) {
        let ContactPatch { entry, max_stress, exit } = self.patch;
        let mut breaks = [entry, max_stress, exit, exit, exit, exit, exit];
        let mut count = 3;
        let mut add = |angle: f64| {
            if angle > exit && angle < entry {
                breaks[count] = angle;
                count += 1;
            }
        };
        // Where the rim is as fast as the soil under it: cos θ = r_s ω / v_x.
        let still = self.law.slip.rim / self.law.slip.forward;
        if matches!(self.law.shear, MobilisedShear::Isotropic(_)) {
            if still > 0.0 && still < 1.0 {
                let still = elementary::wide::acos(still);
                add(still);
                add(-still);
            } else if (1.0..TURNS_UNDER_HUB).contains(&still) {
                add(0.0);
            }
        }
        if still > 0.0 && still < 1.0 {
            let still = elementary::wide::acos(still);
            // Between these angles j_x is monotone.
            self.displacement_zero(-still, still, -1.0).map(&mut add);
            self.displacement_zero(exit, -still, 1.0).map(&mut add);
        }
        breaks[..count].sort_by(|a, b| b.total_cmp(a));
        (count, breaks)
    }

    /// The angle between two others at which *j_x* changes sign, if it does: for the first time after
    /// the entry (`which` −1) or the second (1).
    fn displacement_zero(&self, low: f64, high: f64, which: f64) -> Option<f64> {
        let ContactPatch { entry, exit, .. } = self.patch;
        let (low, high) = (low.max(exit), high.min(entry));
        let displacement = |angle: f64| self.displacement(&self.point(entry - angle)).0;
        // From the entry on it grows until the rim is as fast as the soil.
        if low >= high || high >= entry || displacement(low) * displacement(high) >= 0.0 {
            return None;
        }
        /// A corner this near to a piece's end [rad] no longer costs digits.
        const NEAR_ENOUGH: f64 = 1e-12;
        let zero = self.newton_zero(which).filter(|angle| (low..high).contains(angle));
        Some(zero.unwrap_or_else(|| root::between(displacement, low, high, NEAR_ENOUGH)))
    }

    /// A zero of *j_x* but the entry, by Newton's method from where a shallow arc has it.
    ///
    /// With d half the way from the entry, j_x = 0 reads cos(θ_f − d) sin d = d r_s ω/v_x, which to second
    /// order is ⅔ d² − θ_f d + ½ θ_f² = 1 − r_s ω/v_x.
    fn newton_zero(&self, which: f64) -> Option<f64> {
        const MOST_STEPS: usize = 6;
        /// The next step is the square of this one [rad].
        const LAST_STEP: f64 = 1e-7;
        let Slip { rim, forward, .. } = self.law.slip;
        let entry = self.patch.entry;
        let still = rim / forward;
        let square = (8.0 * (1.0 - still) - entry * entry) / 3.0;
        let mut behind = 1.5 * (entry + which * square.max(0.0).sqrt());
        for _ in 0..MOST_STEPS {
            let (sin, cos) = elementary::sin_cos(entry - behind);
            let step = (still * behind - (self.entry_sin - sin)) / (still - cos);
            behind -= step;
            if step.abs() < LAST_STEP {
                return Some(entry - behind);
            }
        }
        None
    }
}
