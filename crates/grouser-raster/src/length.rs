//! Units of length that maps have, but for the metre: by their codes, sizes and names.

/// A unit of length.
struct LengthUnit {
    name: &'static str,
    /// Its code in the register of EPSG.
    code: u16,
    /// [m]
    size: f64,
    /// The same as gdal_calc has it.
    text: &'static str,
    /// Other names of it, in small letters.
    others: &'static [&'static str],
}

const SURVEY_FOOT: u16 = 9003;

const UNITS: [LengthUnit; 5] = [
    LengthUnit {
        name: "millimetres",
        code: 1025,
        size: 0.001,
        text: "0.001",
        others: &["mm", "millimetre", "millimeter"],
    },
    LengthUnit {
        name: "centimetres",
        code: 1033,
        size: 0.01,
        text: "0.01",
        others: &["cm", "centimetre", "centimeter"],
    },
    LengthUnit {
        name: "feet",
        code: 9002,
        size: 0.3048,
        text: "0.3048",
        others: &["ft", "foot", "international foot"],
    },
    LengthUnit {
        name: "US survey feet",
        code: SURVEY_FOOT,
        size: 1200.0 / 3937.0,
        text: "1200/3937",
        others: &["ftus", "us survey foot", "survey foot", "foot_us", "us-ft"],
    },
    LengthUnit {
        name: "kilometres",
        code: 9036,
        size: 1000.0,
        text: "1000",
        others: &["km", "kilometre", "kilometer"],
    },
];

/// A unit by its code in the register of EPSG.
pub(crate) fn name_of_code(code: u16) -> String {
    let known = UNITS.iter().find(|it| it.code == code);
    known.map_or_else(|| format!("a unit with the code EPSG:{code}"), |it| it.name.to_owned())
}

/// A unit by its size [m].
///
/// * `own`: its name, for one that is not known here
pub(crate) fn name_of_size(size: f64, own: &str) -> String {
    match UNITS.iter().find(|it| (size / it.size - 1.0).abs() < 1e-7) {
        Some(known) => known.name.to_owned(),
        None if own.is_empty() => format!("units of {size} m"),
        None => {
            let own: String = own.chars().filter(|c| !c.is_control()).take(40).collect();
            format!("{own} ({size} m)")
        }
    }
}

/// The metres in one of a unit, as gdal_calc has them.
///
/// * `name`: as the functions above or a file have it
pub(crate) fn metres_in(name: &str) -> &'static str {
    let name = name.to_lowercase();
    let is_it = |it: &&LengthUnit| it.name.to_lowercase() == name || it.others.contains(&&*name);
    let known = UNITS.iter().find(is_it);
    // Files call the survey foot by many names.
    let is_survey = name.contains("survey") && name.contains('f');
    let survey = || UNITS.iter().find(|it| is_survey && it.code == SURVEY_FOOT);
    known.or_else(survey).map_or("METRES_IN_ONE", |it| it.text)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// However a unit was found, the command that makes metres of it has its size.
    #[test]
    fn every_unit_has_its_metres() {
        for unit in UNITS {
            for name in [name_of_code(unit.code), name_of_size(unit.size, "own")] {
                assert_eq!(metres_in(&name), unit.text, "{name}");
            }
        }
        assert_eq!(metres_in("US Survey Foot (1960)"), "1200/3937");
        assert_eq!(metres_in("fathom"), "METRES_IN_ONE");
    }
}
