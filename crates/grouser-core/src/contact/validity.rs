//! Where a result is an extrapolation: a closed list of flags, each with its rule.
//!
//! A rule compares one number of a wheel, its motion or its result with the range in which the
//! model, or the soil's constants, are known to hold. A result outside is still computed: it
//! carries the rule's [`Flag`]. Ranges are those of the model
//! ([`WheelSoilModel::domain`](super::WheelSoilModel::domain)) and of the soil
//! ([`Domain`](crate::soil::Domain)).

mod rules;
mod situation;

pub use self::situation::{DOUBTFUL_MODULUS, Flag, Rule, Situation};
use crate::soil::Span;

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
