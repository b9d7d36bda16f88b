//! The flags of validity as a column, and in words.

use super::{Column, words};
use crate::unit::{DEG, KPA, M, M_S2, MM, N, ONE, Unit};
use grouser_core::contact::validity::{Finding, Flag};
use grouser_core::soil::Span;

/// The column of flags.
pub const FLAGS: &str = "flags";

/// Names of flags, in the order of [`Flag::ALL`].
#[must_use]
pub fn names(findings: &[Finding]) -> Vec<&'static str> {
    findings.iter().map(|finding| finding.flag.name()).collect()
}

/// The column of flags, of rows that know theirs.
pub const fn flags<R>(of: fn(&R) -> Vec<&'static str>) -> Column<R> {
    words(
        FLAGS,
        "Why the row is an extrapolation: names of a closed list, none inside the domain",
        of,
    )
}

/// The unit in which the number that a flag compares is written.
fn unit(flag: Flag) -> Unit {
    match flag {
        Flag::LoadOutside | Flag::ForceBeyondFriction => N,
        Flag::RadiusOutside | Flag::OtherWheel => M,
        Flag::SlipAngleOutside | Flag::GrousersApart | Flag::NoSideForce => DEG,
        Flag::GravityOutside | Flag::BekkerGravity => M_S2,
        Flag::GrousersExposed => MM,
        Flag::NoCohesion => KPA,
        Flag::ModulusDoubtful => Unit::si("N/m^(n+2)"),
        Flag::SinkageOutside
        | Flag::SlipOutside
        | Flag::SlopeBeyondStrength
        | Flag::GrouserNumber
        | Flag::TermsMissing
        | Flag::Assumed => ONE,
    }
}

/// A finding with its flag, value and range:
/// `slip-outside: the slip ratio is 0.95, the domain is -0.1 to 0.9`.
#[must_use]
pub fn in_words(finding: &Finding) -> String {
    let Finding { flag, value, allowed } = *finding;
    let unit = unit(flag);
    let number = |value: f64| {
        let written = unit.from_si(value);
        // Four significant digits, without an exponent.
        let rounded: f64 = format!("{written:.3e}").parse().unwrap_or(written);
        rounded.to_string()
    };
    let range = match allowed {
        Span { low, high } if low == high => number(low),
        Span { low, high: f64::INFINITY } => format!("at least {}", number(low)),
        Span { low: f64::NEG_INFINITY, high } => format!("at most {}", number(high)),
        Span { low, high } => format!("{} to {}", number(low), number(high)),
    };
    let symbol = if unit.symbol.is_empty() || unit.symbol == ONE.symbol {
        String::new()
    } else {
        format!(" {}", unit.symbol)
    };
    let (name, quantity) = (flag.name(), flag.rule().quantity);
    format!("{name}: the {quantity} is {}{symbol}, the domain is {range}{symbol}", number(value))
}
