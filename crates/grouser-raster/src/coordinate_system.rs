//! The system of a file's coordinates, carried along.

use std::borrow::Cow;

use crate::wkt;

/// What a file's coordinates refer to: its keys as they are, and a name to show.
///
/// Systems of the Moon and of Mars that no register has pass through as well.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CoordinateSystem {
    directory: Vec<u16>,
    doubles: Vec<f64>,
    text: String,
}

/// The three tags of GeoTIFF that describe a coordinate system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeoKeys<'a> {
    /// `GeoKeyDirectoryTag`, 34735.
    pub directory: &'a [u16],
    /// `GeoDoubleParamsTag`, 34736.
    pub doubles: &'a [f64],
    /// `GeoAsciiParamsTag`, 34737.
    pub text: &'a str,
}

/// The tags with the values of keys.
pub(crate) const DIRECTORY: u16 = 34735;
pub(crate) const DOUBLES: u16 = 34736;
pub(crate) const TEXT: u16 = 34737;

/// The metre's code in the EPSG register.
pub(crate) const METRE: u16 = 9001;

/// The value of the key `GTModelTypeGeoKey` for systems of a projection.
pub(crate) const PROJECTED_MODEL: u16 = 1;

/// Keys of GeoTIFF 1.1 (OGC 19-008r4).
pub(crate) mod key {
    pub(crate) const MODEL: u16 = 1024;
    pub(crate) const POINTS_OR_AREAS: u16 = 1025;
    pub(crate) const CITATION: u16 = 1026;
    pub(crate) const GEODETIC: u16 = 2048;
    pub(crate) const GEODETIC_CITATION: u16 = 2049;
    pub(crate) const SEMI_MAJOR_AXIS: u16 = 2057;
    pub(crate) const SEMI_MINOR_AXIS: u16 = 2058;
    pub(crate) const INVERSE_FLATTENING: u16 = 2059;
    pub(crate) const PROJECTED: u16 = 3072;
    pub(crate) const PROJECTED_CITATION: u16 = 3073;
    pub(crate) const PROJECTION: u16 = 3074;
    pub(crate) const LINEAR_UNIT: u16 = 3076;
    pub(crate) const LINEAR_UNIT_SIZE: u16 = 3077;
    pub(crate) const METHOD: u16 = 3075;
    pub(crate) const FALSE_EASTING: u16 = 3082;
    pub(crate) const FALSE_NORTHING: u16 = 3083;
    pub(crate) const FIRST_PARALLEL: u16 = 3078;
    pub(crate) const SECOND_PARALLEL: u16 = 3079;
    pub(crate) const ORIGIN_LONGITUDE: u16 = 3080;
    pub(crate) const ORIGIN_LATITUDE: u16 = 3081;
    pub(crate) const FALSE_LONGITUDE: u16 = 3084;
    pub(crate) const FALSE_LATITUDE: u16 = 3085;
    pub(crate) const CENTRE_LONGITUDE: u16 = 3088;
    pub(crate) const CENTRE_LATITUDE: u16 = 3089;
    pub(crate) const CENTRE_EASTING: u16 = 3090;
    pub(crate) const CENTRE_NORTHING: u16 = 3091;
    pub(crate) const SCALE_AT_ORIGIN: u16 = 3092;
    pub(crate) const SCALE_AT_CENTRE: u16 = 3093;
    pub(crate) const POLE_LONGITUDE: u16 = 3095;
    pub(crate) const VERTICAL: u16 = 4096;
    pub(crate) const DATUM: u16 = 2050;
    pub(crate) const ANGULAR_UNIT: u16 = 2054;
    pub(crate) const ELLIPSOID: u16 = 2056;
    pub(crate) const VERTICAL_UNIT: u16 = 4099;
    /// A value that is not in the register.
    pub(crate) const USER_DEFINED: u16 = 32767;
}

impl CoordinateSystem {
    /// The system that a text describes: well-known text, or a code such as `EPSG:32633`.
    ///
    /// Without a code of the EPSG register, the text itself is among the keys, where ArcGIS writes
    /// it and GDAL reads it.
    #[must_use]
    pub fn of_text(text: &str) -> Self {
        /// A text that a key can hold [bytes].
        const LONGEST: usize = 60_000;
        let mut keys = Keys::default();
        keys.whole(key::MODEL, PROJECTED_MODEL);
        if let Some(code) = code_of_text(text) {
            keys.whole(key::PROJECTED, code);
        } else if text.len() < LONGEST && !text.is_empty() {
            keys.whole(key::PROJECTED, key::USER_DEFINED);
            let text = text.replace(['|', '\n'], " ");
            keys.words(key::PROJECTED_CITATION, &format!("{BEFORE_TEXT}{text}"));
        } else {
            return Self::default();
        }
        keys.system()
    }

    /// The system of keys as they were.
    #[must_use]
    pub fn of_keys(directory: Vec<u16>, doubles: Vec<f64>, text: String) -> Self {
        Self { directory, doubles, text }
    }

    /// The text that ArcGIS leaves among the names.
    pub(crate) fn well_known_text(&self) -> Option<String> {
        [key::PROJECTED_CITATION, key::CITATION].into_iter().find_map(|id| {
            let text = self.text_of(id)?;
            Some(text.strip_prefix(BEFORE_TEXT)?.trim_end_matches('|').to_owned())
        })
    }

    /// A stereographic projection of the Moon about a place, in metres.
    ///
    /// * `centre`: longitude, positive to the east, and latitude of the place at the origin [°]
    /// * `name`: of the system, in ASCII
    #[must_use]
    pub fn of_the_moon(centre: [f64; 2], name: &str) -> Self {
        /// The Moon's radius [m] and inverse flattening (none): IAU 2015.
        const SPHERE: [f64; 2] = [1_737_400.0, 0.0];
        /// Codes of the standard's register.
        const AREAS: u16 = 1;
        const DEGREE: u16 = 9102;
        const STEREOGRAPHIC: u16 = 14;
        let mut keys = Keys::default();
        keys.whole(key::MODEL, PROJECTED_MODEL);
        keys.whole(key::POINTS_OR_AREAS, AREAS);
        keys.words(key::CITATION, name);
        keys.whole(key::GEODETIC, key::USER_DEFINED);
        keys.words(key::GEODETIC_CITATION, "Moon (2015) - Sphere");
        keys.whole(key::DATUM, key::USER_DEFINED);
        keys.whole(key::ANGULAR_UNIT, DEGREE);
        keys.whole(key::ELLIPSOID, key::USER_DEFINED);
        keys.real(key::SEMI_MAJOR_AXIS, SPHERE[0]);
        keys.real(key::INVERSE_FLATTENING, SPHERE[1]);
        keys.whole(key::PROJECTED, key::USER_DEFINED);
        keys.words(key::PROJECTED_CITATION, name);
        keys.whole(key::PROJECTION, key::USER_DEFINED);
        keys.whole(key::METHOD, STEREOGRAPHIC);
        keys.whole(key::LINEAR_UNIT, METRE);
        keys.real(key::FALSE_EASTING, 0.0);
        keys.real(key::FALSE_NORTHING, 0.0);
        keys.real(key::CENTRE_LONGITUDE, centre[0]);
        keys.real(key::CENTRE_LATITUDE, centre[1]);
        keys.real(key::SCALE_AT_CENTRE, 1.0);
        keys.system()
    }

    /// Whether the file says anything about it.
    #[must_use]
    pub fn is_known(&self) -> bool {
        !self.directory.is_empty()
    }

    /// The keys, untouched; empty if the file has none.
    #[must_use]
    pub fn keys(&self) -> GeoKeys<'_> {
        GeoKeys { directory: &self.directory, doubles: &self.doubles, text: &self.text }
    }

    /// The code of the projected system in the EPSG register, if it has one.
    #[must_use]
    pub fn epsg(&self) -> Option<u16> {
        self.number(key::PROJECTED).filter(|code| !matches!(*code, 0 | key::USER_DEFINED))
    }

    /// That code as a name, such as `EPSG:32633`.
    pub(crate) fn code_name(&self) -> Option<String> {
        self.epsg().map(|code| format!("EPSG:{code}"))
    }

    /// The member of a GeoJSON object that names the system, as GDAL writes it and reads it, with a
    /// comma behind it; nothing for a system without a code.
    #[must_use]
    pub fn geojson_member(&self) -> String {
        self.epsg().map_or_else(String::new, |code| {
            format!(
                r#""crs":{{"type":"name","properties":{{"name":"urn:ogc:def:crs:EPSG::{code}"}}}},"#
            )
        })
    }

    /// A name for people: the file's own, else the register's code, else the body's radius.
    #[must_use]
    pub fn name(&self) -> String {
        /// What writers put down where they have no name.
        const NAMELESS: [&str; 4] = ["", "unknown", "unnamed", "user-defined"];
        let own = [key::PROJECTED_CITATION, key::CITATION, key::GEODETIC_CITATION];
        // Some citations are lists such as `GCS Name = Moon 2000|Datum = …`, those of ArcGIS texts
        // such as `ESRI PE String = PROJCS["Moon 2000",…`.
        let ends = ["CS[\"", "CRS[\""];
        let of_list = |text: String| {
            let name = text.split('|').next().unwrap_or_default();
            let name = name.split_once("Name = ").map_or(name, |(_, name)| name);
            let quoted = ends.iter().find_map(|end| name.split_once(*end)?.1.split('"').next());
            quoted.unwrap_or(name).trim().to_owned()
        };
        let mut own = own.into_iter().filter_map(|id| self.words(id)).map(of_list);
        let own = own.find(|name| !NAMELESS.contains(&name.to_lowercase().as_str()));
        own.or_else(|| self.code_name()).unwrap_or_else(|| match self.real(key::SEMI_MAJOR_AXIS) {
            Some(radius) => format!("a system without a name, on a body of radius {radius} m"),
            None if self.is_known() => "a system without a name".to_owned(),
            None => "not stated".to_owned(),
        })
    }

    /// The value of a key that is a whole number.
    pub(crate) fn number(&self, id: u16) -> Option<u16> {
        self.entry(id).filter(|entry| entry[1] == 0).map(|entry| entry[3])
    }

    /// The value of a key that is a real number.
    pub(crate) fn real(&self, id: u16) -> Option<f64> {
        let entry = self.entry(id).filter(|entry| entry[1] == DOUBLES)?;
        self.doubles.get(usize::from(entry[3])).copied()
    }

    /// The length of a coordinate in units of its own [m].
    pub(crate) fn linear_unit(&self) -> Option<f64> {
        let unit = self.number(key::LINEAR_UNIT)?;
        if unit == key::USER_DEFINED { self.real(key::LINEAR_UNIT_SIZE) } else { None }
    }

    /// The value of a key that is text, fit to be shown.
    pub(crate) fn words(&self, id: u16) -> Option<String> {
        /// Characters of a name that are shown.
        const LONGEST: usize = 120;
        let text = self.text_of(id)?;
        let shown = text.chars().filter(|c| !c.is_control()).take(LONGEST).collect::<String>();
        Some(shown.trim().to_owned())
    }

    /// The value of a key that is text, as it is.
    pub(crate) fn text_of(&self, id: u16) -> Option<Cow<'_, str>> {
        let entry = self.entry(id).filter(|entry| entry[1] == TEXT)?;
        let (count, start) = (usize::from(entry[2]), usize::from(entry[3]));
        let bytes = self.text.as_bytes().get(start..)?;
        Some(String::from_utf8_lossy(&bytes[..count.min(bytes.len())]))
    }

    /// A key's identity, tag, count and value.
    fn entry(&self, id: u16) -> Option<&[u16]> {
        self.directory.get(4..)?.chunks_exact(4).find(|entry| entry[0] == id)
    }
}

/// What ArcGIS puts before the text of a system.
const BEFORE_TEXT: &str = "ESRI PE String = ";

/// The code of a name such as `EPSG:32633` or `urn:ogc:def:crs:EPSG::32633`.
pub(crate) fn code_of(name: &str) -> Option<u16> {
    let (register, code) = name.rsplit_once(':')?;
    register.to_uppercase().contains("EPSG").then(|| code.parse().ok())?
}

/// The code that a text has for its projected system: well-known text, or a name as above.
pub(crate) fn code_of_text(text: &str) -> Option<u16> {
    let projected = || wkt::part(text, &wkt::PROJECTED);
    code_of(text).or_else(|| wkt::epsg(projected()?))
}

/// Keys in the making, in ascending order of their identities.
#[derive(Default)]
struct Keys {
    entries: Vec<[u16; 4]>,
    doubles: Vec<f64>,
    text: String,
}

impl Keys {
    fn whole(&mut self, id: u16, value: u16) {
        self.entries.push([id, 0, 1, value]);
    }

    fn real(&mut self, id: u16, value: f64) {
        self.entries.push([id, DOUBLES, 1, short(self.doubles.len())]);
        self.doubles.push(value);
    }

    fn words(&mut self, id: u16, value: &str) {
        let start = self.text.len();
        self.text += value;
        self.text.push('|');
        self.entries.push([id, TEXT, short(self.text.len() - start), short(start)]);
    }

    fn system(self) -> CoordinateSystem {
        /// Version of the directory and of its keys: GeoTIFF 1.1.
        const VERSION: [u16; 3] = [1, 1, 1];
        let mut directory = VERSION.to_vec();
        directory.push(short(self.entries.len()));
        directory.extend(self.entries.iter().flatten());
        CoordinateSystem::of_keys(directory, self.doubles, self.text)
    }
}

/// A place or a length in a few keys of our own, as they are stored.
fn short(count: usize) -> u16 {
    u16::try_from(count).expect("names are short")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name(text: &str, epsg: u16) -> String {
        let count = u16::try_from(text.len()).expect("short");
        let directory = [1, 1, 0, 2, key::CITATION, TEXT, count, 0, key::PROJECTED, 0, 1, epsg];
        CoordinateSystem::of_keys(directory.to_vec(), Vec::new(), text.to_owned()).name()
    }

    #[test]
    fn names_are_those_of_the_file_or_of_the_register() {
        assert_eq!(name("Moon2000 south pole|", 32767), "Moon2000 south pole");
        assert_eq!(
            name("PCS Name = Mars equirectangular|Datum = x|", 32767),
            "Mars equirectangular"
        );
        assert_eq!(name("unnamed|", 32633), "EPSG:32633");
        assert_eq!(name("unknown|", 32767), "a system without a name");
        assert_eq!(name("\u{1b}[31mred|", 32767), "[31mred");
        assert_eq!(CoordinateSystem::default().name(), "not stated");
    }

    /// A directory may say anything.
    #[test]
    fn keys_that_lead_nowhere_are_none() {
        let directory =
            [1, 1, 0, 9, key::CITATION, TEXT, 99, 3, key::SEMI_MAJOR_AXIS, DOUBLES, 1, 7];
        let system = CoordinateSystem::of_keys(directory.to_vec(), vec![1.0], "abcd".into());
        assert_eq!(system.words(key::CITATION).as_deref(), Some("d"));
        assert_eq!(
            (system.real(key::SEMI_MAJOR_AXIS), system.number(key::PROJECTED)),
            (None, None)
        );
    }
}
