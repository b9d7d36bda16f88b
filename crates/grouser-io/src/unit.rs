//! Units at the end of names, and their conversion to and from SI, for documents and results.

use std::ops::RangeInclusive;

/// Directions that are taken [°]: any angle, of which whole turns do not count. Source: ours; far
/// beyond, a number no longer says where between two turns it points.
pub const DIRECTION_DEG: RangeInclusive<f64> = -1e9..=1e9;

/// A direction less its whole turns, from −180 to 180 [°]; one that is there already is not
/// touched, and no other is rounded: −179 for 181.
///
/// ```
/// use grouser_io::unit::less_whole_turns;
///
/// assert_eq!([181.0, -190.5, 720.0, -180.0].map(less_whole_turns), [-179.0, 169.5, 0.0, -180.0]);
/// ```
#[must_use]
pub fn less_whole_turns(degrees: f64) -> f64 {
    if degrees.abs() <= 180.0 {
        return degrees;
    }
    // All three are exact: the remainder always is, and so is a difference of two numbers of which
    // neither is twice the other.
    let within = degrees % 360.0;
    if within > 180.0 {
        within - 360.0
    } else if within < -180.0 {
        within + 360.0
    } else {
        // Not −0 for −360.
        within + 0.0
    }
}

/// A unit outside the library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit {
    /// Symbol in tables and labels: `kPa`.
    pub symbol: &'static str,
    scale: Scale,
}

/// How a unit and its SI unit differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scale {
    Same,
    /// A thousand SI units.
    Kilo,
    /// A thousandth of the SI unit.
    Milli,
    /// Hours for seconds.
    Hours,
    /// Degrees for radians.
    Degrees,
}

impl Unit {
    /// A unit that is SI already.
    #[must_use]
    pub const fn si(symbol: &'static str) -> Self {
        Self { symbol, scale: Scale::Same }
    }

    const fn scaled(symbol: &'static str, scale: Scale) -> Self {
        Self { symbol, scale }
    }

    /// The value in SI units and radians.
    #[must_use]
    pub fn to_si(self, value: f64) -> f64 {
        match self.scale {
            Scale::Same => value,
            Scale::Kilo => value * 1e3,
            Scale::Milli => value * 1e-3,
            Scale::Hours => value * 3600.0,
            Scale::Degrees => value.to_radians(),
        }
    }

    /// A value in SI units and radians, in this unit.
    #[must_use]
    pub fn from_si(self, value: f64) -> f64 {
        match self.scale {
            Scale::Same => value,
            Scale::Kilo => value * 1e-3,
            Scale::Milli => value * 1e3,
            Scale::Hours => value / 3600.0,
            Scale::Degrees => value.to_degrees(),
        }
    }

    /// The same of a value that came in with this unit, as it was written: 15°, not
    /// 14.999999999999998°.
    #[must_use]
    pub fn as_given(self, value: f64) -> f64 {
        let exact = self.from_si(value);
        let rounded = (exact * 1e9).round() / 1e9;
        let is_same = self.to_si(rounded) == value || (rounded - exact).abs() < 1e-12;
        if is_same { rounded } else { exact }
    }
}

/// Kilopascals.
pub const KPA: Unit = Unit::scaled("kPa", Scale::Kilo);
/// Millimetres.
pub const MM: Unit = Unit::scaled("mm", Scale::Milli);
/// Degrees.
pub const DEG: Unit = Unit::scaled("°", Scale::Degrees);
/// Degrees per metre of way.
pub const DEG_PER_M: Unit = Unit::scaled("°/m", Scale::Degrees);
/// Degrees per second.
pub const DEG_S: Unit = Unit::scaled("°/s", Scale::Degrees);
/// Kilograms per cubic metre.
pub const KG_M3: Unit = Unit::si("kg/m³");
/// Kilograms.
pub const KG: Unit = Unit::si("kg");
/// Kilogram square metres: a moment of inertia.
pub const KG_M2: Unit = Unit::si("kg·m²");
/// Metres.
pub const M: Unit = Unit::si("m");
/// One over metres.
pub const PER_M: Unit = Unit::si("1/m");
/// Metres per metre.
pub const M_PER_M: Unit = Unit::si("m/m");
/// Metres per radian.
pub const M_PER_RAD: Unit = Unit::si("m/rad");
/// Metres per square radian.
pub const M_PER_RAD2: Unit = Unit::si("m/rad²");
/// Metres per second.
pub const M_S: Unit = Unit::si("m/s");
/// Millimetres per second.
pub const MM_S: Unit = Unit::scaled("mm/s", Scale::Milli);
/// Metres per second squared.
pub const M_S2: Unit = Unit::si("m/s²");
/// Radians per second.
pub const RAD_S: Unit = Unit::si("rad/s");
/// Seconds.
pub const S: Unit = Unit::si("s");
/// Seconds per metre.
pub const S_M: Unit = Unit::si("s/m");
/// Newtons.
pub const N: Unit = Unit::si("N");
/// Newton metres.
pub const NM: Unit = Unit::si("N·m");
/// Newton metres per ampere: the torque constant of a motor.
pub const NM_A: Unit = Unit::si("N·m/A");
/// Ohms.
pub const OHM: Unit = Unit::si("Ω");
/// Amperes.
pub const A: Unit = Unit::si("A");
/// Volts.
pub const V: Unit = Unit::si("V");
/// Volt seconds per radian: the gain of a speed controller.
pub const V_S_RAD: Unit = Unit::si("V·s/rad");
/// Volts per radian: the integral gain of a speed controller.
pub const V_RAD: Unit = Unit::si("V/rad");
/// Degrees Celsius.
pub const DEG_C: Unit = Unit::si("°C");
/// Kelvins per watt.
pub const K_W: Unit = Unit::si("K/W");
/// Joules per kelvin.
pub const J_K: Unit = Unit::si("J/K");
/// Watts.
pub const W: Unit = Unit::si("W");
/// Joules.
pub const J: Unit = Unit::si("J");
/// Watt-hours.
pub const WH: Unit = Unit::scaled("W·h", Scale::Hours);
/// Joules per metre.
pub const J_PER_M: Unit = Unit::si("J/m");
/// Radian.
pub const RAD: Unit = Unit::si("rad");
/// The unit of a dimensionless number.
pub const ONE: Unit = Unit::si("-");
/// The unit of another key.
pub const OF_KEY: Unit = Unit::si("");

/// Ends of keys and columns, and the units that they stand for, longer ends first: `_m_per_m` is no
/// `_m`. The Python package asks this table; a test compares it with that of `docs/conventions.md`.
pub const UNITS: [(&str, Unit); 37] = [
    ("_m_per_m", M_PER_M),
    ("_deg_per_m", DEG_PER_M),
    ("_j_per_m", J_PER_M),
    ("_per_m", PER_M),
    ("_per_rad2_m", M_PER_RAD2),
    ("_per_rad_m", M_PER_RAD),
    ("_kg_m2.xx", KG_M2),
    ("_kg_m2.yy", KG_M2),
    ("_kg_m2.zz", KG_M2),
    ("_kg_m2", KG_M2),
    ("_kg_m3", KG_M3),
    ("_nm_a", NM_A),
    ("_ohm", OHM),
    ("_v_s_rad", V_S_RAD),
    ("_v_rad", V_RAD),
    ("_degc", DEG_C),
    ("_k_w", K_W),
    ("_j_k", J_K),
    ("_m_s2", M_S2),
    ("_rad_s", RAD_S),
    ("_deg_s", DEG_S),
    ("_m_s", M_S),
    ("_s_m", S_M),
    ("_deg", DEG),
    ("_rad", RAD),
    ("_kpa", KPA),
    ("_kg", KG),
    ("_mm", MM),
    ("_nm", NM),
    ("_wh", WH),
    ("_n", N),
    ("_m", M),
    ("_s", S),
    ("_w", W),
    ("_j", J),
    ("_a", A),
    ("_v", V),
];

/// Ends of the names of quantiles: `yaw_deg_p2_5` is in degrees.
pub const QUANTILES: [&str; 3] = ["_p2_5", "_p50", "_p97_5"];

/// The name of a column, or a key, in words, with its unit.
///
/// ```
/// let labels = ["time_s", "yaw_deg_p97_5", "p2_5"].map(grouser_io::label_of);
/// assert_eq!(labels, ["time [s]", "yaw, 97.5 % [°]", "2.5 %"]);
/// let keys = ["shear.longitudinal_m", "pressure_sinkage.n"].map(grouser_io::label_of);
/// assert_eq!(keys, ["shear longitudinal [m]", "pressure sinkage n"]);
/// ```
#[must_use]
pub fn label_of(name: &str) -> String {
    let quantiles = || QUANTILES.into_iter().zip(["2.5 %", "50 %", "97.5 %"]);
    if let Some((_, words)) = quantiles().find(|(end, _)| name == end.trim_start_matches('_')) {
        return words.to_owned();
    }
    let found = quantiles().find_map(|(end, words)| Some((name.strip_suffix(end)?, words)));
    let (name, words) = found.unwrap_or((name, ""));
    let unit = UNITS.iter().find_map(|(end, unit)| Some((name.strip_suffix(end)?, unit.symbol)));
    let (stem, symbol) = unit.unwrap_or((name, ""));
    let comma = if words.is_empty() { "" } else { ", " };
    let label = format!("{}{comma}{words}", stem.replace(['_', '.'], " "));
    if symbol.is_empty() { label } else { format!("{label} [{symbol}]") }
}

/// The unit that a key or a column ends with; none for a number without.
#[must_use]
pub fn unit_of(name: &str) -> Option<Unit> {
    // An entry of a list has its list's unit, a quantile its quantity's.
    let name = match name.rsplit_once('.') {
        Some((list, place)) if place.parse::<usize>().is_ok() => list,
        _ => name,
    };
    let name = QUANTILES.iter().find_map(|end| name.strip_suffix(end)).unwrap_or(name);
    UNITS.iter().find(|(end, _)| name.ends_with(end)).map(|(_, unit)| *unit)
}
