//! Where a result is an extrapolation: a closed list of flags, each with its rule.
//!
//! A rule compares one number of a wheel, its motion or its result with the range in which the model, or the
//! soil's constants, are known to hold. A result outside is still computed: it carries the rule's [`Flag`].
//! Ranges are those of the model ([`Theory::domain`]) and of the soil ([`Domain`]).

mod rules;
mod situation;

use std::f64::consts::FRAC_PI_4;

pub use self::situation::{DOUBTFUL_MODULUS, Flag, Rule, Situation};
use super::theory::Theory;
use crate::soil::{Domain, Span};

impl Flag {
    /// Its rule.
    #[must_use]
    pub fn rule(self) -> &'static Rule {
        &rules::RULES[self as usize]
    }

    /// Its name in results.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.rule().name
    }

    /// The flag of a name.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|flag| flag.name() == name)
    }
}

/// A flag that was raised: the number, and the range that it is outside of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// The flag.
    pub flag: Flag,
    /// The number, in SI units.
    pub value: f64,
    /// Where it would have raised nothing, in SI units.
    pub allowed: Span,
}

impl Situation<'_> {
    /// The flags that are raised, in the order of [`Flag::ALL`].
    #[must_use]
    pub fn findings(&self) -> Vec<Finding> {
        let mut found = Vec::new();
        self.add_to(&mut found);
        found
    }

    /// Adds the flags that are raised and not there yet.
    pub fn add_to(&self, found: &mut Vec<Finding>) {
        for rule in &rules::RULES {
            let Some((value, allowed)) = (rule.judge)(self) else { continue };
            let flag = rule.flag;
            if !allowed.holds(value) && found.iter().all(|it| it.flag != flag) {
                found.push(Finding { flag, value, allowed });
            }
        }
    }
}

/// The flags of several wheels together, each once, in the order of [`Flag::ALL`].
#[must_use]
pub fn union<'a>(situations: impl Iterator<Item = Situation<'a>>) -> Vec<Finding> {
    let mut found = Vec::new();
    situations.for_each(|situation| situation.add_to(&mut found));
    found.sort_by_key(|finding| finding.flag);
    found
}

impl Theory {
    /// The range in which the model was tested, or its simplifications hold. What nobody states is not
    /// limited.
    #[must_use]
    pub fn domain(self) -> Domain {
        // The pressure under a rim is taken as that under a plate. Source: Bekker (1969), in Wong, Theory of
        // Ground Vehicles: acceptable for sinkages up to a sixth of the diameter.
        const SHALLOW: Span = Span::at_most(1.0 / 3.0);
        match self {
            Self::Ishigami => Domain {
                depth: SHALLOW,
                // Source: the smallest wheel of Ishigami et al. (2007), and the largest of Wong and Reece (1967).
                radius: Span::new(0.09, 0.63),
                // Source: driven wheels, 0 to 0.8, in Ishigami et al. (2007). A tenth more on both sides is ours,
                // so that wheels that barely skid on level ground are not flagged.
                slip_ratio: Span::new(-0.1, 0.9),
                // Source: Ishigami et al. (2007).
                slip_angle: Span::at_most(FRAC_PI_4),
                ..Domain::UNSTATED
            },
            Self::Bekker => Domain {
                depth: SHALLOW,
                // Source: Bekker (1969), in Wong, Theory of Ground Vehicles: less accurate for wheels below 20 inches
                // in diameter, the more so the smaller they are.
                radius: Span::at_least(0.25),
                slip_ratio: Span::new(-0.1, 0.9),
                ..Domain::UNSTATED
            },
            // Source: the single-wheel tests of Pavlov and Johnson (2022) to which the model was made, without the
            // slip angle of 90°.
            Self::SmallWheel => Domain {
                depth: Span::at_most(0.95),
                slip_ratio: Span::new(-1.0, 0.975),
                slip_angle: Span::at_most(75.0 / 45.0 * FRAC_PI_4),
                ..Domain::UNSTATED
            },
            // Any motion. Source: Agarwal, Goldman and Kamrin (2023). Down to the axle, where our surface ends.
            Self::Rft => Domain { depth: Span::at_most(1.0), ..Domain::UNSTATED },
        }
    }
}
