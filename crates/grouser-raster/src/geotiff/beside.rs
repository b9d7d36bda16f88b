//! What GDAL leaves beside a file: a mask (`.msk`), its notes (`.aux.xml`), a world file (`.tfw`).
//!
//! Its order of precedence: the notes, the file itself, the world file.

use std::ffi::OsString;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use roxmltree::{Document, Node};
use tiff_reader::{OpenOptions, TiffFile};

use super::affine::Affine;
use super::metadata::check_unit;
use super::opened_file::OpenedFile;
use crate::MapPath;
use crate::error::Fault;

/// What lies beside a file, as far as it is there.
#[derive(Default)]
pub(super) struct Sidecars {
    pub(super) mask: Option<TiffFile>,
    pub(super) notes: PamNotes,
    pub(super) world: Option<Affine>,
}

/// GDAL's notes.
#[derive(Default)]
pub(super) struct PamNotes {
    pub(super) place: Option<Affine>,
    /// The system of coordinates, as well-known text.
    pub(super) system: Option<String>,
    pub(super) nodata: Option<f64>,
    pub(super) scale: Option<f64>,
    pub(super) offset: Option<f64>,
}

/// The files beside a map that are read with it, of those that are there; links, too, that lead to
/// none.
#[must_use]
pub fn beside(map: &Path) -> Vec<PathBuf> {
    let after = [".msk", ".aux.xml"].map(|ending| with_ending(map, ending));
    let worlds = WORLDS.map(|ending| map.with_extension(ending));
    after.into_iter().chain(worlds).filter(|it| it.is_file() || it.is_symlink()).collect()
}

/// Endings of files with a map's place, in the order in which they are looked for.
const WORLDS: [&str; 4] = ["tfw", "TFW", "tifw", "wld"];

fn with_ending(map: &Path, ending: &str) -> PathBuf {
    let mut name = OsString::from(map);
    name.push(ending);
    PathBuf::from(name)
}

impl Sidecars {
    /// * `band`: with the heights, from 1
    /// * `limits`: of the mask
    pub(super) fn of(path: MapPath<'_>, band: usize, limits: OpenOptions) -> Result<Self, Fault> {
        let MapPath { path, open } = path;
        let with = |ending: &str| Some(with_ending(path, ending)).filter(|it| it.is_file());
        let text = |path: &Path| text(MapPath { path, open });
        let mask = |path: PathBuf| -> Result<TiffFile, Fault> {
            let source = OpenedFile::of(MapPath { path: &path, open })?;
            Ok(TiffFile::from_source_with_options(Arc::new(source), limits)?)
        };
        let mask = with(".msk").map(mask).transpose();
        let mask = mask.map_err(|fault| of_part(fault, ".msk"))?;
        let notes = with(".aux.xml").map(|it| PamNotes::of(&text(&it)?, band)).transpose();
        let notes = notes.map_err(|fault| of_part(fault, ".aux.xml"))?.unwrap_or_default();
        let worlds = WORLDS.map(|it| path.with_extension(it));
        let world = worlds.iter().find(|it| it.is_file());
        let world = world.map(|it| world_of(&text(it)?)).transpose();
        let world = world.map_err(|fault| of_part(fault, "world"))?;
        Ok(Self { mask, notes, world })
    }
}

/// A fault of a file beside another one.
fn of_part(fault: Fault, ending: &str) -> Fault {
    match fault {
        Fault::Tiff { problem } => {
            Fault::Tiff { problem: format!("the {ending} file beside it: {problem}") }
        }
        other => other,
    }
}

fn text(path: MapPath<'_>) -> Result<String, Fault> {
    /// The longest that is read: histograms and tables of colours may be in it [bytes].
    const LONGEST: u64 = 1 << 22;
    let file = path.opened()?;
    let length = file.metadata()?.len();
    if length > LONGEST {
        return Err(damaged(&format!("it has {length} bytes, and at most {LONGEST} are read")));
    }
    let mut bytes = Vec::new();
    file.take(LONGEST).read_to_end(&mut bytes)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

fn damaged(problem: &str) -> Fault {
    Fault::Tiff { problem: problem.to_owned() }
}

impl PamNotes {
    /// Reads a `PAMDataset`.
    fn of(text: &str, band: usize) -> Result<Self, Fault> {
        let document = Document::parse(text).map_err(|error| damaged(&error.to_string()))?;
        let root = document.root_element();
        let inside = |of: Node<'_, '_>, name: &str| -> Option<String> {
            let node = of.children().find(|node| node.has_tag_name(name))?;
            Some(node.text()?.trim().to_owned()).filter(|text| !text.is_empty())
        };
        let numbers = |text: &str| numbers(text, ',');
        let place = inside(root, "GeoTransform").map(|text| match numbers(&text)[..] {
            [x0, a, b, y0, c, d] => Ok(Affine { x0, y0, a, b, c, d }),
            _ => Err(damaged("its GeoTransform has not six numbers")),
        });
        let is_band = |node: &Node<'_, '_>| {
            node.has_tag_name("PAMRasterBand")
                && node.attribute("band").and_then(|it| it.parse().ok()) == Some(band)
        };
        let mut notes =
            Self { place: place.transpose()?, system: inside(root, "SRS"), ..Self::default() };
        let Some(of_band) = root.children().find(is_band) else { return Ok(notes) };
        let number = |name: &str| -> Result<Option<f64>, Fault> {
            let Some(text) = inside(of_band, name) else { return Ok(None) };
            let number = text.parse().map_err(|_| damaged(&format!("its {name} is no number")))?;
            Ok(Some(number))
        };
        (notes.nodata, notes.scale) = (number("NoDataValue")?, number("Scale")?);
        notes.offset = number("Offset")?;
        inside(of_band, "UnitType").map_or(Ok(()), |unit| check_unit(&unit))?;
        Ok(notes)
    }
}

/// A world file: how far a column and a row lead, and the middle of the first cell.
fn world_of(text: &str) -> Result<Affine, Fault> {
    match numbers(text, '\n')[..] {
        [a, c, b, d, x, y] => {
            Ok(Affine { x0: x - 0.5 * (a + b), y0: y - 0.5 * (c + d), a, b, c, d })
        }
        _ => Err(damaged("it has not six numbers")),
    }
}

fn numbers(text: &str, apart: char) -> Vec<f64> {
    let words = text.split(apart).map(str::trim).filter(|word| !word.is_empty());
    let numbers = words.map(|word| word.parse().ok().filter(|it: &f64| it.is_finite()));
    numbers.collect::<Option<Vec<f64>>>().unwrap_or_default()
}
