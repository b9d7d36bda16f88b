//! What a map's coordinates and heights mean: one check for all that maps come from.

use grouser_core::units::Vec2;

use crate::advice::{self, MappedBody};
use crate::coordinate_system::{CoordinateSystem, METRE, PROJECTED_MODEL, key};
use crate::error::Fault;
use crate::length::{name_of_code, name_of_size};
use crate::projection::Projection;
use crate::remark::{Remark, TOLD};
use crate::wkt::{PROJECTED, inside, part, values};

/// The middle of a map, and its cells, in units of its coordinates.
#[derive(Clone, Copy, Debug)]
pub struct MapSite {
    /// Its middle.
    pub middle: Vec2,
    /// Distance of neighbours to the north.
    pub cell: f64,
    /// What it spans to the east and to the north.
    pub size: Vec2,
}

/// Checks a system of coordinates that a text describes (well-known text of the first or second
/// edition, as rasterio and xarray have it; a code such as `EPSG:32633`, words of PROJ): projected,
/// in metres, heights too, and about as long as the ground.
///
/// ```
/// use grouser_core::units::Vec2;
/// use grouser_raster::{Fault, MapSite, check_system};
///
/// let degrees = r#"GEOGCS["Moon",DATUM["Moon",SPHEROID["Moon",1737400,0]],PRIMEM["0",0],UNIT["degree",0.0174532925199433]]"#;
/// let site = MapSite { middle: Vec2::new(120.0, -89.0), cell: 0.001, size: Vec2::zeros() };
/// assert!(matches!(check_system(degrees, site), Err(Fault::Degrees { .. })));
/// ```
///
/// # Errors
/// [`Fault`] for degrees, other units, depths, and a map far larger or smaller than its ground.
pub fn check_system(text: &str, site: MapSite) -> Result<Option<Remark>, Fault> {
    let projected = part(text, &PROJECTED);
    let of_places = projected.or_else(|| part(text, &LOCAL));
    let is_cartesian = ["GEOCCS[", "Cartesian"].iter().any(|it| text.contains(it));
    if is_cartesian && of_places.is_none() {
        return Err(Fault::Geocentric);
    }
    check_heights(text)?;
    let projection = Projection::of_text(text);
    let is_projected = projection.is_some() || projected.is_some();
    if !is_projected && part(text, &["GEOGCS", "GEOGCRS", "GEODCRS", "GEODETICCRS"]).is_some() {
        return Err(in_degrees(&MappedBody::Unknown, site));
    }
    // Of other systems nothing but the unit is known.
    let of_others = of_places.filter(|_| projection.is_none());
    if let Some(unit) = of_others.and_then(foreign_unit_of) {
        return Err(Fault::Unit { unit });
    }
    let name = text.split('"').nth(1).unwrap_or(text);
    check(projection.as_ref(), name, site)
}

/// What texts call systems of a site of its own.
const LOCAL: [&str; 4] = ["LOCAL_CS", "LOCALCS", "ENGCRS", "ENGINEERINGCRS"];

/// The fault of a map in degrees, with a projection of its body.
fn in_degrees(body: &MappedBody, site: MapSite) -> Fault {
    let size = body.degree().map(|degree| site.cell * degree);
    Fault::Degrees { warp: advice::projection(site.middle, body, size) }
}

/// The unit that a text states of a system, if that is not the metre.
fn foreign_unit_of(system: &str) -> Option<String> {
    const UNITS: [&str; 2] = ["UNIT", "LENGTHUNIT"];
    let of_axis = || inside(inside(system, &["AXIS"])?, &UNITS);
    let mut unit = values(inside(system, &UNITS).or_else(of_axis)?);
    let (name, size) = (unit.next()?, unit.next()?.parse::<f64>().ok()?);
    (size != 1.0).then(|| name_of_size(size, name))
}

/// Checks the system of heights that a text describes, if it does.
fn check_heights(text: &str) -> Result<(), Fault> {
    const HEIGHTS: [&str; 4] = ["VERT_CS", "VERTCRS", "VERTICALCRS", "VERTCS"];
    let Some(heights) = part(text, &HEIGHTS) else { return Ok(()) };
    if [",down", ",DOWN", "\"Direction\",-1"].iter().any(|it| heights.contains(it)) {
        return Err(Fault::Depths);
    }
    foreign_unit_of(heights).map_or(Ok(()), |unit| Err(Fault::HeightUnit { unit }))
}

/// Checks the keys of a GeoTIFF likewise.
pub(crate) fn check_keys(
    system: &CoordinateSystem,
    site: MapSite,
) -> Result<Option<Remark>, Fault> {
    let model = system.number(key::MODEL);
    // ArcGIS leaves systems of its own without a code: their name or their unit tells them.
    let is_named = system.text_of(key::PROJECTED_CITATION).is_some()
        || system.number(key::LINEAR_UNIT).is_some();
    let is_projected = system.number(key::PROJECTED).or(system.number(key::PROJECTION)).is_some()
        || (is_named && model != Some(GEOGRAPHIC));
    if model == Some(GEOCENTRIC) {
        return Err(Fault::Geocentric);
    }
    let has_degrees = model == Some(GEOGRAPHIC) || system.number(key::GEODETIC).is_some();
    if model != Some(PROJECTED_MODEL) && !is_projected && has_degrees {
        return Err(in_degrees(&MappedBody::of_keys(system), site));
    }
    if let Some(unit) = foreign_unit(system) {
        return Err(Fault::Unit { unit });
    }
    match system.number(key::VERTICAL_UNIT) {
        None | Some(0 | METRE) => check_registered_heights(system)?,
        Some(code) => return Err(Fault::HeightUnit { unit: name_of_code(code) }),
    }
    for id in [key::CITATION, key::PROJECTED_CITATION] {
        system.text_of(id).map_or(Ok(()), |text| check_heights(&text))?;
    }
    if !is_projected {
        return Ok(None);
    }
    // What the file says of its unit goes before the register.
    let projection = Projection::of_keys(system);
    let stated = system.number(key::LINEAR_UNIT).is_some_and(|unit| unit != 0);
    match projection.filter(|it| !stated || it.unit() == 1.0) {
        None if stated && system.epsg().is_some() => Ok(None),
        projection => check(projection.as_ref(), &system.name(), site),
    }
}

/// Checks a system of heights of the EPSG register that has no unit beside it.
fn check_registered_heights(system: &CoordinateSystem) -> Result<(), Fault> {
    /// Systems of heights in feet, in US survey feet, and of depths. Source: EPSG register 12.
    const FEET: [u16; 6] = [5754, 6130, 6131, 6132, 8050, 8228];
    const SURVEY_FEET: [u16; 3] = [5702, 6360, 8052];
    const DEPTHS: [u16; 52] = [
        5336, 5612, 5614, 5706, 5715, 5734, 5739, 5789, 5831, 5861, 5862, 5863, 5864, 5865, 5866,
        5867, 5873, 6357, 6358, 6359, 7976, 8051, 8053, 8358, 8378, 8897, 9287, 9288, 9672, 10150,
        10151, 10349, 10364, 10370, 10371, 10372, 10373, 10374, 10375, 10376, 10377, 10378, 10379,
        10547, 10548, 10549, 10550, 10551, 10552, 10649, 10650, 10678,
    ];
    match system.number(key::VERTICAL) {
        Some(code) if FEET.contains(&code) => Err(Fault::HeightUnit { unit: "feet".into() }),
        Some(code) if SURVEY_FEET.contains(&code) => {
            Err(Fault::HeightUnit { unit: "US survey feet".into() })
        }
        Some(code) if DEPTHS.contains(&code) => Err(Fault::Depths),
        _ => Ok(()),
    }
}

/// Checks what a projection does to lengths.
///
/// * `name`: of the system
fn check(
    projection: Option<&Projection>,
    name: &str,
    site: MapSite,
) -> Result<Option<Remark>, Fault> {
    /// How far the scale may be from 1 at the middle of the map before it is refused [-]: a slope of
    /// 20° is wrong by a degree.
    ///
    /// The scale changes by tan φ / R for a metre to the north on Mercator's map, and by half of the
    /// sine of the way from the middle over R on stereographic ones: by less than 0.5 % over maps
    /// of 10 km that are not refused, so that it is one number for most maps, and a range for those
    /// of hundreds of kilometres.
    const REFUSED: f64 = 0.05;
    let Some(projection) = projection else {
        return Ok(Some(Remark::UnknownScale { system: name.to_owned() }));
    };
    let body = MappedBody::of_axes(projection.axes());
    if projection.is_in_degrees() {
        return Err(in_degrees(&body, site));
    }
    if (projection.unit() - 1.0).abs() > 1e-9 {
        return Err(Fault::Unit { unit: name_of_size(projection.unit(), "") });
    }
    let (Some(factors), Some(place)) =
        (projection.scale(site.middle), projection.place(site.middle))
    else {
        return Ok(Some(Remark::UnknownScale { system: name.to_owned() }));
    };
    let off = |factors: [f64; 2]| (factors[0] - 1.0).abs().max((factors[1] - 1.0).abs());
    if off(factors) > REFUSED {
        let size = Some(site.cell / factors[1]);
        let warp = advice::projection(place.map(f64::to_degrees), &body, size);
        return Err(Fault::Scale { factors, warp });
    }
    let over_map = over_map(projection, site, factors);
    Ok((off(over_map) > TOLD).then_some(Remark::Scale { factors, over_map }))
}

/// The least and the greatest scale of a map at its middle, corners and sides, where it is known
/// [-].
///
/// * `factors`: at its middle
fn over_map(projection: &Projection, site: MapSite, factors: [f64; 2]) -> [f64; 2] {
    const STEPS: [f64; 3] = [-0.5, 0.0, 0.5];
    let all = STEPS.into_iter().flat_map(|x| STEPS.map(|y| Vec2::new(x, y)));
    let scales = all.filter_map(|it| projection.scale(site.middle + it.component_mul(&site.size)));
    scales.fold(factors, |[least, most], [low, high]| [least.min(low), most.max(high)])
}

/// Other values of the key `GTModelTypeGeoKey`.
const GEOGRAPHIC: u16 = 2;
const GEOCENTRIC: u16 = 3;

/// The unit of the coordinates as the file states it, if that is not the metre.
fn foreign_unit(system: &CoordinateSystem) -> Option<String> {
    match system.number(key::LINEAR_UNIT) {
        None | Some(0 | METRE) => None,
        Some(key::USER_DEFINED) => {
            let size = system.linear_unit().unwrap_or(1.0);
            (size != 1.0).then(|| name_of_size(size, ""))
        }
        Some(code) => Some(name_of_code(code)),
    }
}
