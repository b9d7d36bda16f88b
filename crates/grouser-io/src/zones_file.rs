//! Files of zones of soil that scenarios and missions name.

use std::path::Path;
use std::sync::Arc;

use serde_json::Value as Json;

use super::describe::zones::{CLASS, FILE, LEGEND, NAME, SOIL};
use super::document::Document;
use super::error::{DocumentError, Problem};
use super::file;
use super::given_file::{FileContent, GivenFile};
use super::kind::Kind;
use super::presets::preset;
use super::raster_file::{Found, found, key, options};
use super::tree::{Entry, Node, Origin, Value};
use grouser_core::soil::Soil;
use grouser_core::terrain::{Ground, Shape, SoilZones};
use grouser_raster::zones::ZoneCounts;
use grouser_raster::{
    CoordinateSystem, Fault, MapFrame, MapPath, ReadOptions, Remark, ZoneKey, read_zones,
    zone_names,
};

/// Gives each name of a file's zones that the legend does not have, and that is a preset's, a row
/// with that preset: the document has then all soils of the run.
///
/// * `terrain`: the table, with whole paths; what is wrong with it, or with the file, is found
///   later
pub(crate) fn name_presets(terrain: &mut Node) {
    let Some(Entry { node, .. }) = terrain.entry(FILE) else { return };
    let Value::String(path) = &node.value else { return };
    let (path, origin) = (Path::new(path), node.origin.clone());
    let within = origin.text.within();
    if file::check_regular(path, within).is_err() {
        return;
    }
    let open = &file::opener(within);
    let Ok(names) = zone_names(MapPath { path, open }) else { return };
    let Value::Table(entries) = &mut terrain.value else { return };
    let place = entries.iter().position(|entry| entry.key == LEGEND).unwrap_or_else(|| {
        let node = Node { value: Value::List(Vec::new()), origin: origin.clone() };
        entries.push(Entry { key: LEGEND.to_owned(), key_origin: origin.clone(), node });
        entries.len() - 1
    });
    let Value::List(rows) = &mut entries[place].node.value else { return };
    let is_named = |name: &String, row: &Node| {
        let Some(Entry { node, .. }) = row.entry(NAME) else { return false };
        matches!(&node.value, Value::String(named) if named == name)
    };
    for name in names {
        if preset(Kind::Soil, &name).is_some() && !rows.iter().any(|row| is_named(&name, row)) {
            rows.push(row(&name, &origin));
        }
    }
    if rows.is_empty() {
        entries.remove(place);
    }
}

/// A row of the legend for a preset.
fn row(name: &str, origin: &Origin) -> Node {
    let entry = |key: &str| Entry {
        key: key.to_owned(),
        key_origin: origin.clone(),
        node: Node { value: Value::String(name.to_owned()), origin: origin.clone() },
    };
    Node { value: Value::Table(vec![entry(NAME), entry(SOIL)]), origin: origin.clone() }
}

/// Reads the zones that a document names, if it names some, and puts them into its ground; what
/// their file gave, and what is to be remarked about it.
///
/// * `tree`: the document as it was written
/// * `system`: of the map, if that is not known to be that of the zones
pub(crate) fn read(
    ground: &mut Ground,
    document: &Document,
    tree: &Node,
    system: Option<&CoordinateSystem>,
) -> Result<Option<(GivenFile, Option<Remark>)>, DocumentError> {
    let rows = document.get(&key(LEGEND)).and_then(Json::as_array);
    let rows: &[Json] = rows.map_or(&[], Vec::as_slice);
    let Some(path) = document.text(&key(FILE)) else {
        ground.zones = None;
        if rows.is_empty() {
            return Ok(None);
        }
        let problem = Problem::Conflict("zones have soils, and no file says where they lie");
        let hint = Some("`soil_file` names it".to_owned());
        return Err(DocumentError::at(tree.origin_of(&key(LEGEND)), problem).with_hint(hint));
    };
    let mut soils = ground.zones.take().map_or_else(Vec::new, |zones| zones.soils.clone());
    let mut legend: Vec<(ZoneKey, Option<usize>)> = Vec::new();
    for (number, row) in rows.iter().enumerate() {
        let misfit = |problem| {
            let key = format!("{}.{number}", key(LEGEND));
            DocumentError::at(tree.origin_of(&key), Problem::Conflict(problem))
        };
        let of = zone_key(row).ok_or_else(|| misfit("a zone has either a class or a name"))?;
        if legend.iter().any(|(other, _)| *other == of) {
            return Err(misfit("a row above has the soil of this zone"));
        }
        let has_soil = row.get(SOIL).is_some();
        if !has_soil && let Some(soil) = soils.get_mut(number) {
            *soil = ground.soil;
        }
        legend.push((of, has_soil.then_some(number)));
    }
    let map = match &ground.shape {
        Shape::Map(model) => Some(MapFrame { system, extent: model.extent() }),
        Shape::Plane(_) | Shape::Formula(_) | Shape::Own(_) => None,
    };
    let path = Path::new(path);
    let within = tree.origin_of(&key(FILE)).text.within();
    file::check_regular(path, within)
        .map_err(|problem| DocumentError::at(tree.origin_of(&key(FILE)), problem.into()))?;
    let file = MapPath { path, open: &file::opener(within) };
    let zones = zones(file, &options(document, within), map, &legend, soils);
    let (zones, given, remark) = zones.map_err(|(problem, hint)| {
        DocumentError::at(tree.origin_of(&key(FILE)), problem).with_hint(hint)
    })?;
    ground.zones = Some(Arc::new(zones));
    Ok(Some((given, remark)))
}

/// What a row of the legend is of; none if it does not say, or says both.
fn zone_key(row: &Json) -> Option<ZoneKey> {
    let class = row.get(CLASS).and_then(Json::as_i64).map(ZoneKey::Class);
    let name = row.get(NAME).and_then(Json::as_str).map(|name| ZoneKey::Name(name.to_owned()));
    class.xor(name)
}

fn zones(
    file: MapPath<'_>,
    options: &ReadOptions,
    on: Option<MapFrame<'_>>,
    legend: &[(ZoneKey, Option<usize>)],
    soils: Vec<Soil>,
) -> Result<(SoilZones, GivenFile, Option<Remark>), Found> {
    let path = file.path;
    // A band, and the height that stands for a missing one, are those of the map.
    let options = ReadOptions { band: None, missing: None, ..*options };
    let fault = |fault: &Fault| found("file of zones", path, fault);
    let map = read_zones(file, &options, on.as_ref());
    let (map, remark) = map.map_err(|error| fault(&error.fault))?;
    let hint =
        "a row `[[terrain.zone]]` has `class` or `name`, and `soil`; names of presets need none";
    let ZoneCounts { there, used } = map.counts(on.map(|it| it.extent).as_ref());
    let content = if map.is_raster() { FileContent::ZoneCells } else { FileContent::Zones };
    let given = GivenFile::new(path.display().to_string(), content, there, used);
    let zones = map.with_legend(legend, soils).map_err(|it| {
        let (problem, own) = fault(&it);
        (problem, own.or_else(|| Some(hint.to_owned())))
    })?;
    Ok((zones, given, remark))
}
