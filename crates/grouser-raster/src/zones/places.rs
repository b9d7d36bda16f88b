//! Whether places of GeoJSON are metres of a map, or of another one, or degrees.

use grouser_core::terrain::Extent;

use crate::CoordinateSystem;
use crate::degrees::{are_degrees, may_be_degrees};
use crate::error::Fault;
use crate::remark::Remark;

/// Checks that places of a file of GeoJSON are metres, not degrees of longitude and latitude.
///
/// * `system`: the name of their coordinate system, which says what the numbers are
/// * `places`: what they span
///
/// # Errors
/// [`Fault`] for a system of degrees, and for numbers that look like degrees in a file without one.
pub fn check_places(system: Option<&str>, places: &Extent) -> Result<(), Fault> {
    /// Codes of the EPSG register among which those of degrees are, and few of metres.
    const GEOGRAPHIC: std::ops::Range<u32> = 4000..5000;
    let is_geographic = |name| epsg(name).is_some_and(|code| GEOGRAPHIC.contains(&code));
    match system {
        Some(name) if is_in_degrees(name) || (is_geographic(name) && may_be_degrees(places)) => {
            Err(Fault::SystemInDegrees { name: shown(name) })
        }
        None if are_degrees(places) => Err(Fault::ZonesInDegrees),
        _ => Ok(()),
    }
}

/// Checks that places which all lie off the ground are not degrees: those of ground that lies where
/// no degrees are.
///
/// # Errors
/// [`Fault::ZonesInDegrees`] if they are.
pub fn check_places_on(ground: &Extent, places: &Extent) -> Result<(), Fault> {
    let is_apart = places.is_apart_from(ground);
    let is_elsewhere = is_apart && may_be_degrees(places) && !may_be_degrees(ground);
    if is_elsewhere || (is_apart && are_degrees(places)) {
        return Err(Fault::ZonesInDegrees);
    }
    Ok(())
}

/// Compares the system that a file of GeoJSON names with that of the map that it is for; a remark
/// where one of them alone has a code.
///
/// # Errors
/// [`Fault::OtherSystem`] where the two have different codes.
pub(super) fn compare(
    system: Option<&str>,
    map: &CoordinateSystem,
) -> Result<Option<Remark>, Fault> {
    let (name, of_map) = (system.map(shown), map.name());
    let codes = system.and_then(epsg).zip(map.epsg().map(u32::from));
    let is_same = match codes {
        Some((one, other)) => one == other,
        // GeoJSON has no name for a system without a code.
        None => name.as_ref() == Some(&of_map) || (name.is_none() && map.epsg().is_none()),
    };
    match (name, codes) {
        _ if is_same => Ok(None),
        (Some(name), Some((_, code))) => {
            Err(Fault::OtherSystem { name, map: format!("EPSG:{code}") })
        }
        (places, _) => {
            let map = if map.is_known() { of_map } else { "none".to_owned() };
            Ok(Some(Remark::SystemNotCompared { places, map }))
        }
    }
}

/// The code in the EPSG register that a name of a system ends with.
fn epsg(name: &str) -> Option<u32> {
    let (register, code) = name.rsplit_once(':')?;
    register.to_uppercase().contains("EPSG").then(|| code.parse().ok())?
}

/// Whether a coordinate system of that name has degrees.
pub(super) fn is_in_degrees(name: &str) -> bool {
    // The standard's own, that of GPS, and those of IAU bodies, whose codes of longitude and
    // latitude end in two zeros.
    let name = name.to_uppercase();
    let of_body = name.contains("IAU") && name.ends_with("00");
    of_body || ["CRS84", "CRS:84", ":4326", ":4979"].iter().any(|one| name.ends_with(one))
}

/// A word of the file, fit to be shown.
pub(super) fn shown(word: &str) -> String {
    const LONGEST: usize = 60;
    let shown: String = word.chars().filter(|c| !c.is_control()).take(LONGEST).collect();
    if shown.is_empty() { "nothing".to_owned() } else { shown }
}
