//! Maps of heights that scenarios and missions name.

use std::mem::take;
use std::path::{Path, absolute};
use std::sync::Arc;

use super::describe::run::{SLOPE, TERRAIN};
use super::describe::terrain::{BAND, CELL_SIZE, FILE, MISSING, SOUTH_WEST, START};
use super::describe::zones::FILE as SOIL_FILE;
use super::document::Document;
use super::error::{DocumentError, Problem};
use super::file;
use super::given_file::{FileContent, GivenFile, NamedFiles};
use super::legs_file;
use super::raster_file::{Found, found, key, options};
use super::tree::{Entry, HeldMap, Node, Value};
use super::zones_file;
use grouser_core::simulation::Scenario;
use grouser_core::terrain::{ElevationModel, Extent, Shape};
use grouser_core::units::Vec2;
use grouser_raster::{CoordinateSystem, MapPath, ReadOptions, Remark};

/// Gives maps that a document names their whole paths, so that the resolved document finds them
/// from anywhere, and ground with heights no slope beside them.
///
/// # Errors
/// [`DocumentError`] for a map outside of the folder that it has to be in.
pub(crate) fn locate(tree: &mut Node) -> Result<(), DocumentError> {
    let Some(entry) = tree.entry_mut(TERRAIN) else { return Ok(()) };
    let key_origin = entry.key_origin.clone();
    for key in [FILE, SOIL_FILE] {
        if let Some(Entry { node, .. }) = entry.node.entry_mut(key)
            && let Value::String(name) = &mut node.value
            && !name.is_empty()
            && !node.origin.text.beside.maps.iter().any(|map| map.name == *name)
        {
            let path = node.origin.text.path_of(name);
            let path = path.map_err(|why| DocumentError::at(&node.origin, why.into()))?;
            if let Some(within) = &node.origin.text.beside.within {
                // What is read with a map has to be in the folder, too.
                file::check_beside(&path, within)
                    .map_err(|why| DocumentError::at(&node.origin, why.into()))?;
            }
            if let Ok(path) = absolute(path) {
                *name = path.display().to_string();
            }
        }
    }
    zones_file::name_presets(&mut entry.node);
    if let Value::Table(entries) = &mut tree.value
        && entries.iter().all(|entry| entry.key != SLOPE)
    {
        let node = Node { value: Value::Float(0.0), origin: key_origin.clone() };
        entries.push(Entry { key: SLOPE.to_owned(), key_origin, node });
    }
    Ok(())
}

/// Reads the map that a scenario's document names, if it names one, and puts it into the scenario.
///
/// * `tree`: the document as it was written
pub(crate) fn read(
    scenario: &mut Scenario,
    document: &Document,
    tree: &Node,
) -> Result<NamedFiles, DocumentError> {
    let ground = &mut scenario.ground;
    if ground.is_plane() {
        return Ok(NamedFiles::default());
    }
    let Some(path) = document.text(&key(FILE)) else {
        let zones = zones_file::read(ground, document, tree, None)?;
        let given = zones.into_iter().map(|(given, _)| given).collect();
        return Ok(NamedFiles { given, notes: Vec::new() });
    };
    let fault = |key_of: &str, (problem, hint)| {
        DocumentError::at(tree.origin_of(&key(key_of)), problem).with_hint(hint)
    };
    let (model, system, mut notes) = if let Some(map) = held(path, document, tree)? {
        (map.model, map.system, Vec::new())
    } else {
        let within = tree.origin_of(&key(FILE)).text.within();
        let read = map(Path::new(path), within, &options(document, within));
        let Map { model, remarks, system } = read.map_err(|found| fault(FILE, found))?;
        let declared = |height: f64| format!("`{}` = {height}", key(MISSING));
        let note = |remark: &Remark| format!("{}: {}", name_of(path), remark.in_words(declared));
        (Arc::new(model), Some(system), remarks.iter().map(note).collect())
    };
    if let Some(system) = &system {
        notes.extend(legs_file::compare_systems(tree, system)?);
    }
    if document.get(&key(START)).is_none() {
        ground.start = middle(model.extent());
    }
    let heights = given_heights(path, &model);
    ground.shape = Shape::Map(model);
    let mut given = vec![heights];
    if let Some((zones, remark)) = zones_file::read(ground, document, tree, system.as_ref())? {
        notes.extend(remark.map(|remark| format!("{}: {remark}", name_of(&zones.file))));
        given.push(zones);
    }
    Ok(NamedFiles { given, notes })
}

/// What a map of heights gave.
///
/// * `file`: its name
fn given_heights(file: &str, model: &ElevationModel) -> GivenFile {
    let (cells, missing) = (model.grid().columns * model.grid().rows, model.missing());
    GivenFile::new(file, FileContent::Heights, cells as u64, (cells - missing) as u64)
}

/// The name of a file without its folder.
fn name_of(path: &str) -> String {
    Path::new(path).file_name().unwrap_or_default().display().to_string()
}

/// The map in memory that a document names, if it does.
fn held(name: &str, document: &Document, tree: &Node) -> Result<Option<HeldMap>, DocumentError> {
    let origin = tree.origin_of(&key(FILE));
    let Some(map) = origin.text.beside.maps.iter().find(|map| map.name == name) else {
        return Ok(None);
    };
    if let Some(read_with) = &map.options {
        // Read otherwise, the file is another map.
        return Ok((*read_with == options(document, origin.text.within())).then(|| map.clone()));
    }
    let of_files = [CELL_SIZE, SOUTH_WEST, BAND, MISSING].map(key);
    if let Some(key) = of_files.iter().find(|key| document.get(key).is_some()) {
        let problem = Problem::Conflict("a map in memory has this already");
        return Err(DocumentError::at(tree.origin_of(key), problem));
    }
    Ok(Some(map.clone()))
}

/// The map of heights of a scenario that was read, under the name that its document has for it:
/// texts that name it too need not read it again.
#[must_use]
pub fn map_of(scenario: &Scenario, document: &Document) -> Option<HeldMap> {
    let Shape::Map(model) = &scenario.ground.shape else { return None };
    let name = document.text(&key(FILE))?.to_owned();
    // A resolved document has whole paths.
    let options = Path::new(&name).is_absolute().then(|| options(document, None));
    Some(HeldMap { name, model: model.clone(), options, system: None })
}

/// Reads a map from a file, to be shared by documents that name it; and what is odd about it.
///
/// # Errors
/// [`DocumentError`] if it cannot be read, with what helps.
pub fn read_map(
    path: &Path,
    options: ReadOptions,
) -> Result<(HeldMap, Vec<Remark>), DocumentError> {
    let whole = absolute(path).unwrap_or_else(|_| path.to_owned());
    let name = whole.display().to_string();
    let Map { model, remarks, system } =
        map(&whole, None, &options).map_err(|(problem, hint)| {
            // Options stand in no table.
            let hint = hint.map(|hint| hint.replace("`terrain.", "`"));
            DocumentError::whole(&name, problem).with_hint(hint)
        })?;
    let (model, options, system) = (Arc::new(model), Some(options), Some(system));
    Ok((HeldMap { name, model, options, system }, remarks))
}

/// A map as its file has it.
struct Map {
    model: ElevationModel,
    remarks: Vec<Remark>,
    system: CoordinateSystem,
}

/// * `within`: the folder that it has to be in
fn map(path: &Path, within: Option<&Path>, options: &ReadOptions) -> Result<Map, Found> {
    // Neither a device nor a pipe is waited for.
    file::check_regular(path, within).map_err(|problem| (Problem::from(problem), None))?;
    let file = MapPath { path, open: &file::opener(within) };
    let mut raster =
        grouser_raster::read(file, options).map_err(|error| found("map", path, &error.fault))?;
    let (remarks, system) = (take(&mut raster.remarks), take(&mut raster.coordinates));
    let model = raster.model().map_err(|error| found("map", path, &error.into()))?;
    Ok(Map { model, remarks, system })
}

fn middle(extent: Extent) -> Vec2 {
    0.5 * (extent.south_west + extent.north_east)
}

pub(crate) fn contains(extent: Extent, at: Vec2) -> bool {
    let Extent { south_west, north_east } = extent;
    (south_west.x..=north_east.x).contains(&at.x) && (south_west.y..=north_east.y).contains(&at.y)
}

pub(crate) fn spans(extent: Extent) -> String {
    let Extent { south_west: low, north_east: high } = extent;
    format!("x is from {} to {} m, y from {} to {} m", low.x, high.x, low.y, high.y)
}
