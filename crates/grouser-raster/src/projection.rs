//! What a map's projection does to lengths, through `proj4rs`, which no other file of ours knows;
//! registered systems are those of `crs-definitions`, texts are read by `proj4wkt`.

use grouser_core::elementary::wide::sin_cos;
use grouser_core::units::{Vec2, Vec3};
use proj4rs::Proj;

use crate::coordinate_system::{CoordinateSystem, code_of_text, key};

/// A system of coordinates whose formulas are known.
pub(crate) struct Projection {
    proj: Proj,
}

impl Projection {
    /// The projection that keys of GeoTIFF describe: by its code in the register, by its method and
    /// parameters, or by the text that ArcGIS leaves among the names.
    pub(crate) fn of_keys(system: &CoordinateSystem) -> Option<Self> {
        if let Some(code) = system.epsg() {
            return Self::registered(code);
        }
        let of_text = || Self::of_text(&system.well_known_text()?);
        by_method(system).and_then(|definition| Self::of(&definition)).or_else(of_text)
    }

    /// The definition, in words of PROJ 4, of a system whose keys have a method and parameters.
    pub(crate) fn words_of(system: &CoordinateSystem) -> Option<String> {
        by_method(system).map(|words| words.split_whitespace().collect::<Vec<_>>().join(" "))
    }

    /// The projection that a text describes: well-known text of the first or second edition, a code
    /// of the register, or words of PROJ 4.
    pub(crate) fn of_text(text: &str) -> Option<Self> {
        if text.starts_with('+') {
            return Self::of(text);
        }
        // A code goes before formulas, which texts of web Mercator's have for another body.
        if let Some(registered) = code_of_text(text).and_then(Self::registered) {
            return Some(registered);
        }
        let of = |text: &str| Self::of(&proj4wkt::wkt_to_projstring(text).ok()?);
        // ArcGIS puts a system of heights behind that of coordinates.
        of(text).or_else(|| of(text.split_once(",VERTCS[")?.0))
    }

    pub(crate) fn registered(code: u16) -> Option<Self> {
        Self::of(crs_definitions::from_code(code)?.proj4)
    }

    /// * `definition`: in the words of PROJ 4
    fn of(definition: &str) -> Option<Self> {
        Some(Self { proj: Proj::from_proj_string(&on_own_datum(definition)).ok()? })
    }

    /// Whether both give places of the body the same coordinates, to a centimetre.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        /// Coordinates of which every system of a site has some: about the origin, and where zones
        /// have their middles.
        const PLACES: [[f64; 2]; 5] =
            [[0.0, 0.0], [1e4, 2e4], [5e5, 1e6], [5e5, 5.2e6], [-2e5, -3e5]];
        const NEAR: f64 = 0.01;
        let is_alike =
            |at: [f64; 2]| match (self.on_body(Vec2::from(at)), other.on_body(Vec2::from(at))) {
                (Some(one), Some(other)) => Some((one - other).norm() < NEAR),
                (None, None) => None,
                _ => Some(false),
            };
        let found: Vec<bool> = PLACES.into_iter().filter_map(is_alike).collect();
        !found.is_empty() && found.into_iter().all(|it| it)
    }

    /// Whether its coordinates are longitude and latitude.
    pub(crate) fn is_in_degrees(&self) -> bool {
        self.proj.is_latlong()
    }

    /// The length of one of its coordinates [m].
    pub(crate) fn unit(&self) -> f64 {
        self.proj.to_meter()
    }

    /// Semi-major and semi-minor axis of the body [m].
    pub(crate) fn axes(&self) -> [f64; 2] {
        let (major, minor) = self.proj.ellipse_parameters();
        [major, minor]
    }

    /// Longitude, positive to the east, and latitude of a place [rad].
    pub(crate) fn place(&self, at: Vec2) -> Option<Vec2> {
        let [major, minor] = self.axes();
        let globe = Proj::from_proj_string(&format!("+proj=longlat +a={major} +b={minor}")).ok()?;
        let mut place = (at.x, at.y);
        proj4rs::transform::transform(&self.proj, &globe, &mut place).ok()?;
        let place = Vec2::new(place.0, place.1);
        (place.x.is_finite() && place.y.is_finite()).then_some(place)
    }

    /// Lengths on the map over lengths on the ground about a place, in the direction where they are
    /// least and where they are most [-].
    ///
    /// The singular values of the map's derivative, by differences of places on the body: it has
    /// one at its poles as well.
    pub(crate) fn scale(&self, at: Vec2) -> Option<[f64; 2]> {
        /// Steps on the map [m].
        const STEP: f64 = 10.0;
        let step = STEP / self.unit();
        let on_body = |dx: f64, dy: f64| self.on_body(at + step * Vec2::new(dx, dy));
        let east = (on_body(1.0, 0.0)? - on_body(-1.0, 0.0)?) / (2.0 * STEP);
        let north = (on_body(0.0, 1.0)? - on_body(0.0, -1.0)?) / (2.0 * STEP);
        let (sum, apart) = (east.norm_squared() + north.norm_squared(), east.cross(&north).norm());
        let root = (0.25 * sum * sum - apart * apart).max(0.0).sqrt();
        let [most, least] =
            [0.5 * sum + root, 0.5 * sum - root].map(|it| it.max(0.0).sqrt().recip());
        (most.is_finite() && least.is_finite()).then_some([most, least])
    }

    /// A place from the centre of the body [m].
    fn on_body(&self, at: Vec2) -> Option<Vec3> {
        let place = self.place(at)?;
        let [major, minor] = self.axes();
        let (sin_east, cos_east) = sin_cos(place.x);
        let (sin_north, cos_north) = sin_cos(place.y);
        let squared = 1.0 - (minor / major) * (minor / major);
        let normal = major / (1.0 - squared * sin_north * sin_north).sqrt();
        let out = normal * cos_north;
        Some(Vec3::new(out * cos_east, out * sin_east, normal * (1.0 - squared) * sin_north))
    }
}

impl CoordinateSystem {
    /// A text from which other programs know the system: its code, else its well-known text, else
    /// the words of PROJ; none where no formula is known.
    #[must_use]
    pub fn to_text(&self) -> Option<String> {
        self.code_name().or_else(|| self.well_known_text()).or_else(|| Projection::words_of(self))
    }

    /// Whether two systems give a place the same coordinates; nothing where that is not known.
    #[must_use]
    pub fn is_same(&self, other: &Self) -> Option<bool> {
        if let Some((one, other)) = self.epsg().zip(other.epsg()) {
            return Some(one == other);
        }
        if self == other {
            return Some(true);
        }
        let [one, other] = [Projection::of_keys(self)?, Projection::of_keys(other)?];
        Some(one.is_like(&other))
    }
}

/// A definition without what leads from its datum to that of others, which needs files and changes
/// no length that matters.
fn on_own_datum(definition: &str) -> String {
    const DATUM: [&str; 5] = ["+nadgrids", "+geoidgrids", "+towgs84", "+wktext", "+no_defs"];
    let words = definition.split_whitespace();
    let own = words.filter(|word| !DATUM.iter().any(|it| word.starts_with(it)));
    own.map(|word| if word == "+datum=NAD27" { "+ellps=clrk66" } else { word })
        .collect::<Vec<_>>()
        .join(" ")
}

/// The definition of a system by its method and parameters, as GDAL writes the keys.
fn by_method(system: &CoordinateSystem) -> Option<String> {
    let first = |keys: &[u16]| keys.iter().find_map(|id| system.real(*id));
    let longitude = first(&[
        key::POLE_LONGITUDE,
        key::ORIGIN_LONGITUDE,
        key::FALSE_LONGITUDE,
        key::CENTRE_LONGITUDE,
    ]);
    let latitude = first(&[key::ORIGIN_LATITUDE, key::FALSE_LATITUDE, key::CENTRE_LATITUDE]);
    let [first_parallel, second_parallel] =
        [key::FIRST_PARALLEL, key::SECOND_PARALLEL].map(|id| system.real(id));
    let mut words = Vec::new();
    let mut put = |name: &str, value: Option<f64>| {
        words.extend(value.map(|value| format!("+{name}={value}")));
    };
    // Codes of the standard's register.
    let name = match system.number(key::METHOD)? {
        1 => "tmerc",
        7 => "merc",
        8 | 9 => "lcc",
        10 => "laea",
        11 => "aea",
        12 => "aeqd",
        13 => "eqdc",
        14 | 15 => "stere",
        16 => "sterea",
        17 => "eqc",
        18 => "cass",
        24 => "sinu",
        _ => return None,
    };
    if system.number(key::METHOD) == Some(15) {
        // Its latitude is that of true scale.
        put("lat_ts", latitude);
        put("lat_0", latitude.map(|it| 90.0_f64.copysign(it)));
    } else if name == "eqc" || name == "merc" {
        put("lat_ts", first_parallel);
        put("lat_0", latitude.filter(|_| name == "eqc"));
    } else {
        put("lat_1", first_parallel.or(latitude.filter(|_| name == "lcc")));
        put("lat_2", second_parallel);
        put("lat_0", latitude);
    }
    put("lon_0", longitude);
    put("k", first(&[key::SCALE_AT_ORIGIN, key::SCALE_AT_CENTRE]));
    put("x_0", first(&[key::FALSE_EASTING, key::CENTRE_EASTING]));
    put("y_0", first(&[key::FALSE_NORTHING, key::CENTRE_NORTHING]));
    Some(format!("+proj={name} {} {} {}", words.join(" "), unit(system), body(system)?))
}

/// The unit of coordinates that is not the metre.
fn unit(system: &CoordinateSystem) -> String {
    system.linear_unit().map_or_else(String::new, |size| format!("+to_meter={size}"))
}

/// The body's axes, of the keys or of the registered system of longitude and latitude.
fn body(system: &CoordinateSystem) -> Option<String> {
    if let Some(major) = system.real(key::SEMI_MAJOR_AXIS) {
        let minor = system.real(key::SEMI_MINOR_AXIS);
        let flattening = system.real(key::INVERSE_FLATTENING).filter(|inverse| *inverse > 1.0);
        return Some(match (flattening, minor) {
            (Some(inverse), _) => format!("+a={major} +rf={inverse}"),
            (None, Some(minor)) => format!("+a={major} +b={minor}"),
            (None, None) => format!("+R={major}"),
        });
    }
    let code = system.number(key::GEODETIC).filter(|code| *code != key::USER_DEFINED)?;
    let of_globe = crs_definitions::from_code(code)?.proj4.split_whitespace();
    Some(of_globe.filter(|word| !word.starts_with("+proj")).collect::<Vec<_>>().join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(definition: &str, at: [f64; 2]) -> [f64; 2] {
        let projection = Projection::of(definition).expect("it is known");
        projection.scale(Vec2::new(at[0], at[1])).expect("it has one")
    }

    fn assert_near(found: [f64; 2], expected: [f64; 2], within: f64) {
        let near = |i: usize| (found[i] - expected[i]).abs() <= within;
        assert!(near(0) && near(1), "{found:?} for {expected:?}");
    }

    /// Closed forms on a sphere.
    #[test]
    fn scales_are_those_of_the_formulas() {
        let radius: f64 = 1_737_400.0;
        let latitude = 60_f64.to_radians();
        let y = radius * (0.25 * std::f64::consts::PI + 0.5 * latitude).tan().ln();
        assert_near(scale("+proj=merc +R=1737400", [1000.0, y]), [2.0, 2.0], 1e-6);
        let y = radius * latitude;
        assert_near(scale("+proj=eqc +R=1737400", [1000.0, y]), [1.0, 2.0], 1e-6);
        assert_near(scale("+proj=eqc +lat_ts=60 +R=1737400", [0.0, y]), [1.0, 1.0], 1e-6);
        // Stereographic about a pole: 2/(1 + sin φ), also at the pole itself.
        let pole = "+proj=stere +lat_0=-90 +R=1737400";
        assert_near(scale(pole, [0.0, 0.0]), [1.0, 1.0], 1e-6);
        let out = 2.0 * radius * 15_f64.to_radians().tan();
        let at_60 = 2.0 / (1.0 + latitude.sin());
        assert_near(scale(pole, [out, 0.0]), [at_60, at_60], 1e-6);
    }

    /// Facts of the register: UTM has 0.9996 on its central meridian.
    #[test]
    fn registered_systems_have_their_units_and_scales() {
        let utm = Projection::registered(32633).expect("it is known");
        assert_near(utm.scale(Vec2::new(500_000.0, 5_200_000.0)).unwrap(), [0.9996; 2], 1e-5);
        let feet = Projection::registered(2227).expect("it is known");
        assert!((feet.unit() - 1200.0 / 3937.0).abs() < 1e-9);
        let old = Projection::registered(26710).expect("it is known");
        assert_near(old.scale(Vec2::new(500_000.0, 4_000_000.0)).unwrap(), [0.9996; 2], 1e-5);
    }
}
