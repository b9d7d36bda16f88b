//! The command that projects a grid in degrees, or in a projection for another place.

use grouser_core::units::Vec2;

use crate::coordinate_system::{CoordinateSystem, key};

/// Semi-major axis of the Earth [m]. Source: WGS 84.
const EARTH: f64 = 6_378_137.0;
/// Ellipsoids whose axis is that near to it are of the Earth [m].
const NEAR: f64 = 3_000.0;

/// The body that a map is of.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum MappedBody {
    /// The Earth.
    Earth,
    /// Another one: its semi-major and its semi-minor axis [m].
    Other([f64; 2]),
    /// The file does not say which.
    Unknown,
}

impl MappedBody {
    /// The body with these semi-major and semi-minor axes [m].
    pub(crate) fn of_axes(axes: [f64; 2]) -> Self {
        if (axes[0] - EARTH).abs() > NEAR { Self::Other(axes) } else { Self::Earth }
    }

    /// The body of a system of longitude and latitude.
    pub(crate) fn of_keys(system: &CoordinateSystem) -> Self {
        let registered =
            system.number(key::GEODETIC).is_some_and(|code| !matches!(code, 0 | key::USER_DEFINED));
        let major = system.real(key::SEMI_MAJOR_AXIS).filter(|radius| radius.is_finite());
        let Some(major) = major else {
            return if registered { Self::Earth } else { Self::Unknown };
        };
        let flattened = system.real(key::INVERSE_FLATTENING).filter(|inverse| *inverse > 1.0);
        let by_flattening = flattened.map(|inverse| major * (1.0 - 1.0 / inverse));
        let minor = by_flattening.or(system.real(key::SEMI_MINOR_AXIS)).unwrap_or(major);
        Self::of_axes([major, minor])
    }

    /// The length of a degree of latitude [m].
    pub(crate) fn degree(&self) -> Option<f64> {
        let major = match self {
            Self::Earth => EARTH,
            Self::Other([major, _]) => *major,
            Self::Unknown => return None,
        };
        Some(major.to_radians())
    }
}

/// What a grid is to be projected to.
#[derive(Clone, Debug, PartialEq)]
pub struct Warp {
    /// The system, as PROJ has it.
    target: String,
    /// The size of a cell [m].
    size: Option<f64>,
}

impl Warp {
    /// The command of GDAL that does it.
    ///
    /// * `input`: the file with the grid
    #[must_use]
    pub fn command(&self, input: &str) -> String {
        let size = self.size.map_or("CELL_SIZE_IN_METRES".to_owned(), rounded);
        let target = &self.target;
        format!("gdalwarp -t_srs \"{target}\" -tr {size} {size} -r cubic {input} OUT.tif")
    }
}

/// A projection for a place: the zone of UTM on Earth, else a stereographic one of the body.
///
/// * `place`: longitude, positive to the east, and latitude [°]
/// * `size`: of a cell [m]
pub(crate) fn projection(place: Vec2, body: &MappedBody, size: Option<f64>) -> Warp {
    let (longitude, latitude) = (place.x, place.y.clamp(-90.0, 90.0));
    let target = match body {
        MappedBody::Earth => on_earth(longitude, latitude),
        MappedBody::Other([major, minor]) if major == minor => {
            stereographic(longitude, latitude, &format!("+R={major}"))
        }
        MappedBody::Other([major, minor]) => {
            stereographic(longitude, latitude, &format!("+a={major} +b={minor}"))
        }
        MappedBody::Unknown => stereographic(longitude, latitude, "+R=RADIUS_IN_METRES"),
    };
    Warp { target, size }
}

/// The zone of UTM, or the usual projection of a pole.
fn on_earth(longitude: f64, latitude: f64) -> String {
    /// Latitudes that UTM ends at [°].
    const NORTH: f64 = 84.0;
    const SOUTH: f64 = -80.0;
    if latitude > NORTH {
        return "EPSG:3413".into();
    }
    if latitude < SOUTH {
        return "EPSG:3031".into();
    }
    let turned = (longitude + 180.0).rem_euclid(360.0);
    let zone = 1.0 + (turned / 6.0).floor().min(59.0);
    let first = if latitude < 0.0 { 32700.0 } else { 32600.0 };
    format!("EPSG:{}", first + zone)
}

fn stereographic(longitude: f64, latitude: f64, body: &str) -> String {
    format!(
        "+proj=stere +lat_0={latitude:.4} +lon_0={longitude:.4} +k=1 +x_0=0 +y_0=0 {body} +units=m \
         +no_defs"
    )
}

/// A length with three digits [m].
fn rounded(length: f64) -> String {
    let digits = (2.0 - length.log10().floor()).clamp(0.0, 9.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 9")]
    let digits = digits as usize;
    let text = format!("{length:.digits$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn command(directory: &[u16], doubles: &[f64], middle: (f64, f64), cell: f64) -> String {
        let system = CoordinateSystem::of_keys(directory.to_vec(), doubles.to_vec(), String::new());
        let body = MappedBody::of_keys(&system);
        let size = body.degree().map(|degree| cell * degree);
        projection(Vec2::new(middle.0, middle.1), &body, size).command("IN.tif")
    }

    #[test]
    fn a_grid_in_degrees_gets_a_projection_of_its_own_body() {
        let wgs_84 = [1, 1, 0, 1, key::GEODETIC, 0, 1, 4326];
        let alps = command(&wgs_84, &[], (10.5, 46.5), 1.0 / 3600.0);
        assert_eq!(alps, "gdalwarp -t_srs \"EPSG:32632\" -tr 30.9 30.9 -r cubic IN.tif OUT.tif");
        for (middle, system) in [
            ((-70.0, -24.0), "EPSG:32719"),
            ((179.9, 0.5), "EPSG:32660"),
            ((190.0, 10.0), "EPSG:32602"),
            ((20.0, 88.0), "EPSG:3413"),
            ((20.0, -88.0), "EPSG:3031"),
        ] {
            let command = command(&wgs_84, &[], middle, 0.001);
            assert!(command.contains(&format!("\"{system}\"")), "{command}");
        }
        let moon = [1, 1, 0, 2, key::GEODETIC, 0, 1, 32767, key::SEMI_MAJOR_AXIS, 34736, 1, 0];
        let pole = command(&moon, &[1_737_400.0], (120.0, -89.5), 1.0 / 1024.0);
        assert!(pole.contains("+proj=stere +lat_0=-89.5000 +lon_0=120.0000"), "{pole}");
        assert!(pole.contains("+R=1737400 ") && pole.contains("-tr 29.6 29.6"), "{pole}");
        let mars = [&moon[..], &[key::SEMI_MINOR_AXIS, 34736, 1, 1]].concat();
        let gale = command(&mars, &[3_396_190.0, 3_376_200.0], (137.4, -4.6), 1.0);
        assert!(gale.contains("+a=3396190 +b=3376200") && gale.contains("-tr 59275"), "{gale}");
        let unknown = command(&[1, 1, 0, 0], &[], (1.0, 2.0), 1.0);
        assert!(
            unknown.contains("+R=RADIUS_IN_METRES") && unknown.contains("CELL_SIZE"),
            "{unknown}"
        );
    }
}
