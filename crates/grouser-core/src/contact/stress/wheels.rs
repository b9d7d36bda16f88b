//! The stresses of many wheels side by side: number by number, as vectors read them.

use super::breaks::{Breaks, Ends, MOST_STEPS, Newton, ZEROS};
use super::{
    AnisotropicShear, BoundedShear, IsotropicShear, MobilisedShear, RimMotion, ShearLaw,
    StressField, StressLaw,
};
use crate::contact::cohesion::Cohesion;
use crate::contact::lanes::{Each, WIDE, each};
use crate::contact::patch::ContactPatch;

/// A shear law as two numbers, so that many of the same kind are two rows.
pub(in crate::contact) trait ShearNumbers: ShearLaw {
    /// The law with these numbers.
    fn of(numbers: [f64; 2]) -> Self;
}

impl ShearNumbers for AnisotropicShear {
    #[inline(always)]
    fn of([per_longitudinal, per_lateral]: [f64; 2]) -> Self {
        Self { per_longitudinal, per_lateral }
    }
}

impl ShearNumbers for BoundedShear {
    #[inline(always)]
    fn of(numbers: [f64; 2]) -> Self {
        Self(AnisotropicShear::of(numbers))
    }
}

impl ShearNumbers for IsotropicShear {
    #[inline(always)]
    fn of([per_modulus, _]: [f64; 2]) -> Self {
        Self { per_modulus }
    }
}

impl MobilisedShear {
    #[inline(always)]
    fn numbers(&self) -> [f64; 2] {
        match *self {
            Self::Anisotropic(AnisotropicShear { per_longitudinal, per_lateral })
            | Self::Bounded(BoundedShear(AnisotropicShear { per_longitudinal, per_lateral })) => {
                [per_longitudinal, per_lateral]
            }
            Self::Isotropic(IsotropicShear { per_modulus }) => [per_modulus, 0.0],
        }
    }
}

/// A number of each law.
#[inline(always)]
fn each_of(laws: &[&StressLaw; WIDE], number: impl Fn(&StressLaw) -> f64) -> Each {
    each(|wheel| number(laws[wheel]))
}

/// The laws of many wheels, all with the same kind of shear law.
pub(in crate::contact) struct StressLaws {
    pub(in crate::contact) radius: Each,
    rim: Each,
    forward: Each,
    lateral: Each,
    still: Each,
    pressure: Each,
    scale: Each,
    exponent: Each,
    cohesion: Each,
    tension: Each,
    friction: Each,
    shear: [Each; 2],
    peak_share: Each,
    exit_ratio: Each,
    /// The kind of the shear law, with the numbers of the first.
    kind: MobilisedShear,
}

impl StressLaws {
    pub(in crate::contact) fn of(laws: &[&StressLaw; WIDE]) -> Self {
        Self {
            radius: each_of(laws, |law| law.radius),
            rim: each_of(laws, |law| law.motion.rim),
            forward: each_of(laws, |law| law.motion.forward),
            lateral: each_of(laws, |law| law.motion.lateral),
            still: each_of(laws, |law| law.motion.still),
            pressure: each_of(laws, |law| law.pressure),
            scale: each_of(laws, |law| law.scale),
            exponent: each_of(laws, |law| law.exponent),
            cohesion: each_of(laws, |law| law.cohesion.full),
            tension: each_of(laws, |law| law.cohesion.tension),
            friction: each_of(laws, |law| law.friction),
            shear: [
                each_of(laws, |law| law.shear.numbers()[0]),
                each_of(laws, |law| law.shear.numbers()[1]),
            ],
            peak_share: each_of(laws, |law| law.peak_share),
            exit_ratio: each_of(laws, |law| law.exit_ratio),
            kind: laws[0].shear,
        }
    }

    /// The kind of their shear law.
    pub(in crate::contact) fn kind(&self) -> MobilisedShear {
        self.kind
    }

    /// The law of one of them, with a shear law of the same kind; its own is
    /// [`shear`](Self::shear).
    #[inline(always)]
    pub(in crate::contact) fn law(&self, wheel: usize) -> StressLaw {
        StressLaw {
            radius: self.radius[wheel],
            motion: RimMotion {
                rim: self.rim[wheel],
                forward: self.forward[wheel],
                lateral: self.lateral[wheel],
                still: self.still[wheel],
            },
            pressure: self.pressure[wheel],
            scale: self.scale[wheel],
            exponent: self.exponent[wheel],
            cohesion: Cohesion { full: self.cohesion[wheel], tension: self.tension[wheel] },
            friction: self.friction[wheel],
            shear: self.kind,
            peak_share: self.peak_share[wheel],
            exit_ratio: self.exit_ratio[wheel],
        }
    }

    /// The shear law of one of them.
    #[inline(always)]
    pub(in crate::contact) fn shear<L: ShearNumbers>(&self, wheel: usize) -> L {
        L::of([self.shear[0][wheel], self.shear[1][wheel]])
    }
}

/// The stresses of many wheels, each at a sinkage.
pub(in crate::contact) struct StressFields<'a> {
    pub(in crate::contact) laws: &'a StressLaws,
    pub(in crate::contact) entry: Each,
    pub(in crate::contact) max_stress: Each,
    pub(in crate::contact) exit: Each,
    entry_sin: Each,
    entry_height: Each,
    per_scale: Each,
    squeeze: Each,
    pub(in crate::contact) max_normal: Each,
    cohesion: Each,
}

impl<'a> StressFields<'a> {
    /// * `sinkages`: of the wheels [m]
    #[inline(always)]
    pub(in crate::contact) fn new(laws: &'a StressLaws, sinkages: &Each) -> Self {
        let zeros = [0.0; WIDE];
        let mut fields = Self {
            laws,
            entry: zeros,
            max_stress: zeros,
            exit: zeros,
            entry_sin: zeros,
            entry_height: zeros,
            per_scale: zeros,
            squeeze: zeros,
            max_normal: zeros,
            cohesion: zeros,
        };
        for (wheel, &sinkage) in sinkages.iter().enumerate() {
            let field = fields.laws.law(wheel).sunk(sinkage);
            fields.entry[wheel] = field.patch.entry;
            fields.max_stress[wheel] = field.patch.max_stress;
            fields.exit[wheel] = field.patch.exit;
            fields.entry_sin[wheel] = field.entry_sin;
            fields.entry_height[wheel] = field.entry_height;
            fields.per_scale[wheel] = field.per_scale;
            fields.squeeze[wheel] = field.squeeze;
            fields.max_normal[wheel] = field.max_normal;
            fields.cohesion[wheel] = field.cohesion;
        }
        fields
    }

    /// One of them; a loop over wheels loads no more of it than it uses.
    #[inline(always)]
    pub(in crate::contact) fn field(&self, wheel: usize) -> StressField {
        StressField {
            patch: self.patch(wheel),
            law: self.laws.law(wheel),
            entry_sin: self.entry_sin[wheel],
            entry_height: self.entry_height[wheel],
            per_scale: self.per_scale[wheel],
            squeeze: self.squeeze[wheel],
            max_normal: self.max_normal[wheel],
            cohesion: self.cohesion[wheel],
        }
    }

    /// Where the stresses of each are not smooth ([`StressField::breaks`]).
    #[inline(always)]
    pub(in crate::contact) fn breaks(&self) -> [Breaks; WIDE] {
        let none = Ends::default();
        let mut zeros = [([none; WIDE], [0.0; WIDE], [false; WIDE]); 2];
        for ((ends, angles, found), which) in zeros.iter_mut().zip(ZEROS) {
            let (mut behind, mut done) = ([0.0; WIDE], [false; WIDE]);
            for wheel in 0..WIDE {
                let field = self.field(wheel);
                ends[wheel] = Ends::of(&field, which);
                behind[wheel] = Newton::started(&field, which).behind;
            }
            for _ in 0..MOST_STEPS {
                for wheel in 0..WIDE {
                    let newton = Newton { behind: behind[wheel], is_done: done[wheel] };
                    let Newton { behind: next, is_done } = newton.next(&self.field(wheel));
                    (behind[wheel], done[wheel]) = (next, is_done);
                }
                if done == [true; WIDE] {
                    break;
                }
            }
            for wheel in 0..WIDE {
                angles[wheel] = self.entry[wheel] - behind[wheel];
            }
            *found = done;
        }
        std::array::from_fn(|wheel| {
            let field = self.field(wheel);
            field.breaks_with(|which| {
                let (ends, angles, found) = &zeros[usize::from(which > 0.0)];
                let ends = &ends[wheel];
                let newton = found[wheel].then_some(angles[wheel]);
                ends.holds_zero(&field).then(|| field.zero_within(ends.angles, newton))
            })
        })
    }

    /// The arc of one of them.
    #[inline(always)]
    pub(in crate::contact) fn patch(&self, wheel: usize) -> ContactPatch {
        ContactPatch {
            entry: self.entry[wheel],
            max_stress: self.max_stress[wheel],
            exit: self.exit[wheel],
        }
    }
}
