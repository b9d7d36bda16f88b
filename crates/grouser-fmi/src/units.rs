//! Units as FMI declares them: exponents of the SI base units, and a factor.

use grouser::document::Unit;

/// A unit in base units.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct InBase {
    /// Exponents of kg, m, s, A, K and rad.
    pub(crate) exponents: [i32; BASE.len()],
    /// How many base units one of it is.
    pub(crate) factor: f64,
    /// Value in base units of its zero.
    pub(crate) offset: f64,
}

/// The base units that FMI has and we use.
pub(crate) const BASE: [&str; 6] = ["kg", "m", "s", "A", "K", "rad"];

/// What the parts of a symbol are in base units, but for their size, which the unit knows itself.
const PARTS: [(&str, [i32; BASE.len()]); 18] = [
    ("1", [0, 0, 0, 0, 0, 0]),
    ("kg", [1, 0, 0, 0, 0, 0]),
    ("m", [0, 1, 0, 0, 0, 0]),
    ("mm", [0, 1, 0, 0, 0, 0]),
    ("s", [0, 0, 1, 0, 0, 0]),
    ("h", [0, 0, 1, 0, 0, 0]),
    ("A", [0, 0, 0, 1, 0, 0]),
    ("K", [0, 0, 0, 0, 1, 0]),
    ("°C", [0, 0, 0, 0, 1, 0]),
    ("rad", [0, 0, 0, 0, 0, 1]),
    ("°", [0, 0, 0, 0, 0, 1]),
    ("N", [1, 1, -2, 0, 0, 0]),
    ("kPa", [1, -1, -2, 0, 0, 0]),
    ("Pa", [1, -1, -2, 0, 0, 0]),
    ("J", [1, 2, -2, 0, 0, 0]),
    ("W", [1, 2, -3, 0, 0, 0]),
    ("V", [1, 2, -3, -1, 0, 0]),
    ("Ω", [1, 2, -3, -2, 0, 0]),
];

/// A unit in base units; none for a number without one, and for a symbol that is not known.
pub(crate) fn in_base(unit: Unit) -> Option<InBase> {
    let mut exponents = [0; BASE.len()];
    let (above, below) = unit.symbol.split_once('/').unwrap_or((unit.symbol, ""));
    let each = |all: &'static str| all.split('·').filter(|part| !part.is_empty());
    let parts = each(above).map(|part| (part, 1)).chain(each(below).map(|part| (part, -1)));
    for (part, sign) in parts {
        let (name, power) = match part.strip_suffix('²') {
            Some(name) => (name, 2),
            None => part.strip_suffix('³').map_or((part, 1), |name| (name, 3)),
        };
        let (_, of_part) = PARTS.iter().find(|(known, _)| *known == name)?;
        for (sum, exponent) in exponents.iter_mut().zip(of_part) {
            *sum += sign * power * exponent;
        }
    }
    /// The freezing point of water [K].
    const ZERO_CELSIUS: f64 = 273.15;
    let offset = if unit.symbol == "°C" { ZERO_CELSIUS } else { 0.0 };
    Some(InBase { exponents, factor: unit.to_si(1.0), offset })
}

#[cfg(test)]
mod tests {
    use super::*;
    use grouser::document::UNITS;
    use grouser::document::unit::{DEG_PER_M, KPA, NM_A, V_RAD, WH};

    #[test]
    fn every_unit_of_documents_and_results_is_known_in_base_units() {
        for (end, unit) in UNITS {
            assert!(in_base(unit).is_some(), "{end}: {}", unit.symbol);
        }
    }

    #[test]
    fn units_are_what_their_symbols_say() {
        let of = |unit| in_base(unit).map(|it| (it.exponents, it.factor));
        assert_eq!(of(KPA), Some(([1, -1, -2, 0, 0, 0], 1e3)));
        assert_eq!(of(NM_A), Some(([1, 2, -2, -1, 0, 0], 1.0)));
        assert_eq!(of(V_RAD), Some(([1, 2, -3, -1, 0, -1], 1.0)));
        assert_eq!(of(WH), Some(([1, 2, -2, 0, 0, 0], 3600.0)));
        assert_eq!(of(DEG_PER_M), Some(([0, -1, 0, 0, 0, 1], 1_f64.to_radians())));
    }
}
