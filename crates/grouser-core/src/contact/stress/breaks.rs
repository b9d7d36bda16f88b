//! Where the stresses along an arc are not smooth.

#![expect(clippy::inline_always, reason = "part of the kernel")]

use super::{MobilisedShear, RimMotion, StressField, TURNS_UNDER_HUB};
use crate::contact::patch::ContactPatch;
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
    pub(in crate::contact) fn breaks(&self) -> Breaks {
        self.breaks_with(|which| {
            let ends = Ends::of(self, which);
            ends.holds_zero(self).then(|| self.zero_within(ends.angles, self.newton_zero(which)))
        })
    }

    /// The same with a way to find the zeros of *j_x*: the first after the entry (−1) and the
    /// second (1).
    pub(super) fn breaks_with(&self, zero: impl Fn(f64) -> Option<f64>) -> Breaks {
        let ContactPatch { entry, max_stress, exit } = self.patch;
        let mut breaks = [entry, max_stress, exit, exit, exit, exit, exit];
        let mut count = 3;
        let mut add = |angle: f64| {
            if angle > exit && angle < entry {
                breaks[count] = angle;
                count += 1;
            }
        };
        let RimMotion { rim, forward, still, .. } = self.law.motion;
        let is_skidding = !still.is_nan();
        if matches!(self.law.shear, MobilisedShear::Isotropic(_)) {
            if is_skidding {
                add(still);
                add(-still);
            } else if (1.0..TURNS_UNDER_HUB).contains(&(rim / forward)) {
                add(0.0);
            }
        }
        if is_skidding {
            ZEROS.into_iter().filter_map(zero).for_each(add);
        }
        breaks[..count].sort_by(|a, b| b.total_cmp(a));
        (count, breaks)
    }

    /// Two angles between which *j_x* is monotone, and one of its zeros lies if it lies on the arc.
    #[inline(always)]
    fn monotone_span(&self, which: f64) -> (f64, f64) {
        let ContactPatch { entry, exit, .. } = self.patch;
        let still = self.law.motion.still;
        let (low, high) = if which < 0.0 { (-still, still) } else { (exit, -still) };
        (low.max(exit), high.min(entry))
    }

    /// *j_x* [m] at an angle.
    #[inline(always)]
    fn displacement_along(&self, angle: f64) -> f64 {
        self.displacement(&self.point(self.patch.entry - angle)).0
    }

    /// The zero of *j_x* between two angles at which its signs differ.
    ///
    /// * `newton`: what Newton's method found, if anything
    pub(super) fn zero_within(&self, (low, high): (f64, f64), newton: Option<f64>) -> f64 {
        /// A corner this near to a piece's end [rad] no longer costs digits.
        const NEAR_ENOUGH: f64 = 1e-12;
        let displacement = |angle: f64| self.displacement_along(angle);
        newton
            .filter(|angle| (low..high).contains(angle))
            .unwrap_or_else(|| root::between(displacement, low, high, NEAR_ENOUGH))
    }

    /// A zero of *j_x* but the entry, by Newton's method from where a shallow arc has it.
    fn newton_zero(&self, which: f64) -> Option<f64> {
        let mut newton = Newton::started(self, which);
        for _ in 0..MOST_STEPS {
            newton = newton.next(self);
            if newton.is_done {
                return Some(self.patch.entry - newton.behind);
            }
        }
        None
    }
}

/// The zeros of *j_x* that are sought: the first after the entry, and the second.
pub(super) const ZEROS: [f64; 2] = [-1.0, 1.0];

/// How many of the numbers count, and they.
pub(super) type Breaks = (usize, [f64; MOST_BREAKS]);

/// The ends of the span in which a zero is sought, and *j_x* there [m].
#[derive(Clone, Copy, Default)]
pub(super) struct Ends {
    pub(super) angles: (f64, f64),
    displacements: (f64, f64),
}

impl Ends {
    #[inline(always)]
    pub(super) fn of(field: &StressField, which: f64) -> Self {
        let (low, high) = field.monotone_span(which);
        let displacements = (field.displacement_along(low), field.displacement_along(high));
        Self { angles: (low, high), displacements }
    }

    /// Whether a zero lies between them.
    #[inline(always)]
    pub(super) fn holds_zero(&self, field: &StressField) -> bool {
        let (low, high) = self.angles;
        // From the entry on it grows until the rim is as fast as the soil.
        low < high && high < field.patch.entry && self.displacements.0 * self.displacements.1 < 0.0
    }
}

/// Newton's method has found its zero by then, or finds none.
pub(super) const MOST_STEPS: usize = 6;

/// Newton's method for a zero of *j_x* but the entry, from where a shallow arc has it.
///
/// With d half the way from the entry, j_x = 0 reads cos(θ_f − d) sin d = d r_s ω/v_x, which to
/// second order is ⅔ d² − θ_f d + ½ θ_f² = 1 − r_s ω/v_x.
#[derive(Clone, Copy)]
pub(super) struct Newton {
    /// From the entry [rad].
    pub(super) behind: f64,
    pub(super) is_done: bool,
}

impl Newton {
    #[inline(always)]
    pub(super) fn started(field: &StressField, which: f64) -> Self {
        let RimMotion { rim, forward, .. } = field.law.motion;
        let entry = field.patch.entry;
        let square = (8.0 * (1.0 - rim / forward) - entry * entry) / 3.0;
        Self { behind: 1.5 * (entry + which * square.max(0.0).sqrt()), is_done: false }
    }

    /// A step on, unless it is done.
    #[inline(always)]
    pub(super) fn next(self, field: &StressField) -> Self {
        /// The next step is the square of this one [rad].
        const LAST_STEP: f64 = 1e-7;
        let RimMotion { rim, forward, .. } = field.law.motion;
        let still = rim / forward;
        let (sin, cos) = elementary::sin_cos(field.patch.entry - self.behind);
        let step = (still * self.behind - (field.entry_sin - sin)) / (still - cos);
        let behind = if self.is_done { self.behind } else { self.behind - step };
        Self { behind, is_done: self.is_done || step.abs() < LAST_STEP }
    }
}
