//! Units in which others write their numbers.

/// What a unit measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// A way, a sinkage.
    Length,
    /// A force.
    Force,
    /// A pressure, a stress.
    Stress,
    /// A torque.
    Moment,
    /// An angle.
    Angle,
    /// A speed.
    Speed,
    /// An angular speed.
    AngularSpeed,
    /// A current.
    Current,
    /// A ratio.
    Share,
    /// A label, or a column that is taken as it is.
    Text,
}

/// Units by name, with what they measure and their size in SI.
const UNITS: [(&str, Dimension, f64); 42] = [
    ("m", Dimension::Length, 1.0),
    ("cm", Dimension::Length, 1e-2),
    ("mm", Dimension::Length, 1e-3),
    ("um", Dimension::Length, 1e-6),
    ("in", Dimension::Length, 0.0254),
    ("N", Dimension::Force, 1.0),
    ("kN", Dimension::Force, 1e3),
    ("mN", Dimension::Force, 1e-3),
    ("kgf", Dimension::Force, 9.806_65),
    ("gf", Dimension::Force, 9.806_65e-3),
    ("lbf", Dimension::Force, 4.448_221_615_260_5),
    ("Pa", Dimension::Stress, 1.0),
    ("kPa", Dimension::Stress, 1e3),
    ("MPa", Dimension::Stress, 1e6),
    ("N/cm2", Dimension::Stress, 1e4),
    ("bar", Dimension::Stress, 1e5),
    ("psi", Dimension::Stress, 4.448_221_615_260_5 / (0.0254 * 0.0254)),
    ("Nm", Dimension::Moment, 1.0),
    ("N.m", Dimension::Moment, 1.0),
    ("mNm", Dimension::Moment, 1e-3),
    ("Nmm", Dimension::Moment, 1e-3),
    ("kNm", Dimension::Moment, 1e3),
    ("kgf.m", Dimension::Moment, 9.806_65),
    ("kgf.cm", Dimension::Moment, 9.806_65e-2),
    ("lbf.in", Dimension::Moment, 4.448_221_615_260_5 * 0.0254),
    ("lbf.ft", Dimension::Moment, 4.448_221_615_260_5 * 0.3048),
    ("deg", Dimension::Angle, DEGREE),
    ("rad", Dimension::Angle, 1.0),
    ("mrad", Dimension::Angle, 1e-3),
    ("m/s", Dimension::Speed, 1.0),
    ("cm/s", Dimension::Speed, 1e-2),
    ("mm/s", Dimension::Speed, 1e-3),
    ("km/h", Dimension::Speed, 1.0 / 3.6),
    ("m/min", Dimension::Speed, 1.0 / 60.0),
    ("rad/s", Dimension::AngularSpeed, 1.0),
    ("deg/s", Dimension::AngularSpeed, DEGREE),
    ("rpm", Dimension::AngularSpeed, std::f64::consts::PI / 30.0),
    ("A", Dimension::Current, 1.0),
    ("mA", Dimension::Current, 1e-3),
    ("%", Dimension::Share, 1e-2),
    ("percent", Dimension::Share, 1e-2),
    ("1", Dimension::Share, 1.0),
];

/// Whether a name is that of a unit.
pub(super) fn is_unit(name: &str) -> bool {
    named(name).next().is_some()
}

/// The units that a name may mean. Products may be written with a dot of any kind, a star, a space or
/// a hyphen, in either order: `kgf·cm`, `kgf cm`, `cm.kgf`.
fn named(name: &str) -> impl Iterator<Item = &'static (&'static str, Dimension, f64)> {
    let dotted = name.replace(['·', '⋅', '*', ' ', '-'], ".");
    let turned = dotted.split_once('.').map(|(first, second)| format!("{second}.{first}"));
    let name = name.to_owned();
    let is_it = move |unit: &str| unit == name || unit == dotted || turned.as_deref() == Some(unit);
    UNITS.iter().filter(move |(unit, ..)| is_it(unit))
}

const DEGREE: f64 = std::f64::consts::PI / 180.0;

impl Dimension {
    /// The size of a unit in SI, however its product is written.
    ///
    /// # Errors
    /// The names of the units that measure this, where the name is not one of them.
    pub fn size_of(self, unit: &str) -> Result<f64, Vec<&'static str>> {
        let is_ours = |(_, of, _): &&(&str, Self, f64)| *of == self;
        let fitting = || UNITS.iter().filter(is_ours).map(|(name, ..)| *name).collect();
        named(unit).find(is_ours).map(|(_, _, size)| *size).ok_or_else(fitting)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_written_in_many_ways() {
        for name in ["kgf.cm", "kgf·cm", "kgf*cm", "kgf cm", "kgf-cm", "cm·kgf"] {
            assert_eq!(Dimension::Moment.size_of(name), Ok(9.806_65e-2), "{name}");
        }
        assert_eq!(Dimension::Moment.size_of("in·lbf"), Dimension::Moment.size_of("lbf.in"));
        assert_eq!(Dimension::Moment.size_of("N·m"), Ok(1.0));
        assert!(Dimension::Force.size_of("kgf.cm").is_err());
    }
}
