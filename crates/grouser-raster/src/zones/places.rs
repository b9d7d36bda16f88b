//! Whether places of GeoJSON are metres of a map, or of another one, or degrees.

use grouser_core::terrain::Extent;

use crate::coordinate_system::code_of;
use crate::degrees::{are_degrees, may_be_degrees};
use crate::error::Fault;
use crate::projection::Projection;
use crate::remark::Remark;
use crate::{CoordinateSystem, Raster};

/// Checks that places of a file of GeoJSON are metres, not degrees of longitude and latitude.
///
/// * `system`: the name of their coordinate system, which says what the numbers are
/// * `places`: what they span
///
/// # Errors
/// [`Fault`] for a system of degrees, and for numbers that look like degrees in a file without one.
pub fn check_places(system: Option<&str>, places: &Extent) -> Result<(), Fault> {
    match system {
        Some(name) if is_in_degrees(name) => Err(Fault::SystemInDegrees { name: shown(name) }),
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

/// A map that places of a file are for.
#[derive(Clone, Copy, Debug)]
pub struct MapFrame<'m> {
    /// The system of its coordinates; nothing where the file was compared with it before.
    pub system: Option<&'m CoordinateSystem>,
    /// What it spans.
    pub extent: Extent,
}

impl Raster {
    /// The frame of this map, against which places of other files are checked.
    #[must_use]
    pub fn frame(&self) -> MapFrame<'_> {
        MapFrame { system: Some(&self.coordinates), extent: self.grid.extent() }
    }
}

/// The system that the places of a file are in.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum PlacesSystem {
    /// The name of it, if the file has one.
    Named(Option<String>),
    /// That of a grid.
    OfGrid(CoordinateSystem),
}

impl PlacesSystem {
    /// Compares it with that of the map that the places are for; a remark where nobody can.
    ///
    /// # Errors
    /// [`Fault::OtherSystem`] where it is another one.
    pub(super) fn compare(&self, map: &CoordinateSystem) -> Result<Option<Remark>, Fault> {
        let of_map = map.name();
        let (name, own) = match self {
            Self::Named(Some(name)) if *name == of_map => return Ok(None),
            Self::Named(name) => {
                let code = name.as_deref().filter(|it| code_of(it).is_some());
                (name.clone(), code.map(CoordinateSystem::of_text))
            }
            Self::OfGrid(system) if system.is_known() => {
                (Some(system.name()), Some(system.clone()))
            }
            Self::OfGrid(_) => (None, None),
        };
        // GeoJSON has no name for a system without a code.
        if name.is_none() && map.epsg().is_none() {
            return Ok(None);
        }
        match own.as_ref().and_then(|own| own.is_same(map)) {
            Some(true) => Ok(None),
            Some(false) => {
                let map_name = map.code_name().unwrap_or(of_map);
                let target = map.to_text().unwrap_or_else(|| "SYSTEM_OF_THE_MAP".to_owned());
                let name = own.and_then(|own| own.code_name()).or(name).unwrap_or_default();
                let is_grid = matches!(self, Self::OfGrid(_));
                Err(Fault::OtherSystem { name, map: map_name, target, is_grid })
            }
            None => {
                let map = if map.is_known() { of_map } else { "none".to_owned() };
                Ok(Some(Remark::SystemNotCompared { places: name, map }))
            }
        }
    }
}

/// Whether a coordinate system of that name has degrees.
pub(super) fn is_in_degrees(name: &str) -> bool {
    // The standard's own, those of the register, and those of IAU bodies, whose codes of longitude
    // and latitude end in two zeros.
    let registered = code_of(name).and_then(Projection::registered);
    let name = name.to_uppercase();
    let of_body = name.contains("IAU") && name.ends_with("00");
    let of_standard = ["CRS84", "CRS:84"].iter().any(|one| name.ends_with(one));
    of_body || of_standard || registered.is_some_and(|it| it.is_in_degrees())
}

/// A word of the file, fit to be shown.
pub(super) fn shown(word: &str) -> String {
    const LONGEST: usize = 60;
    let shown: String = word.chars().filter(|c| !c.is_control()).take(LONGEST).collect();
    if shown.is_empty() { "nothing".to_owned() } else { shown }
}
