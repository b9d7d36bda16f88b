//! The folder of a map: bands come to their place one by one, so that one that is there is whole.
//!
//! While a map is in the making a file beside its bands says of what: the same command goes on,
//! another one does not mix its bands with them. The file goes when all is done.

use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

use grouser::document::escape;
use grouser_raster::Raster;
use serde_json::{Value, json};

use crate::failure::Failure;
use crate::interrupt;
use crate::output::folder::{OldFiles, OutputFolder, make_folder};

/// The file that says of what a map in the making is.
const IN_THE_MAKING: &str = "map-in-the-making.json";

pub(super) struct MapFolder {
    target: PathBuf,
}

impl MapFolder {
    /// Prepares the folder: empty, or with a map of the same that was stopped.
    ///
    /// * `settings`: all that the map depends on, with the heights
    pub(super) fn open(
        target: &Path,
        force: bool,
        settings: &Value,
        raster: &Raster,
    ) -> Result<Self, Failure> {
        let folder = Self { target: target.to_owned() };
        let identity = identity(settings, raster);
        let mark = target.join(IN_THE_MAKING);
        match fs::read_to_string(&mark) {
            Ok(found) if found == identity => {
                make_folder(target)?;
                return Ok(folder);
            }
            Ok(_) if !force => {
                let shown = escape::path(target);
                return Err(Failure::Usage(format!(
                    "{shown} has a map in the making, of other inputs\nhint: choose another folder, or add --force to \
                     begin anew"
                )));
            }
            _ => (),
        }
        let old_files = if force { OldFiles::Replace } else { OldFiles::Keep };
        // The usual checks of a folder.
        drop(OutputFolder::open(target, old_files)?);
        let _deferred = interrupt::defer_ctrl_c();
        make_folder(target)?;
        for entry in fs::read_dir(target).map_err(Failure::at("cannot look into", target))? {
            let path = entry.map_err(Failure::at("cannot look into", target))?.path();
            if path.extension().is_some_and(|end| end == "tif") {
                fs::remove_file(&path).map_err(Failure::at("cannot remove", &path))?;
            }
        }
        // A kill leaves the whole of it, or nothing.
        let unfinished = target.join(format!(".{IN_THE_MAKING}.part"));
        fs::write(&unfinished, identity).map_err(Failure::at("cannot write", &unfinished))?;
        fs::rename(&unfinished, &mark).map_err(Failure::at("cannot write", &mark))?;
        Ok(folder)
    }

    /// Where a file of a name is, seen from the caller's folder.
    pub(super) fn path(&self, name: &str) -> String {
        self.target.join(name).display().to_string()
    }

    /// Whether a band is there.
    pub(super) fn has(&self, band: &str) -> bool {
        self.band(band).is_file()
    }

    fn band(&self, band: &str) -> PathBuf {
        self.target.join(format!("{band}.tif"))
    }

    /// Has a band written beside its place, and moves it there.
    pub(super) fn make(
        &self,
        band: &str,
        write: impl FnOnce(&Path) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let unfinished = self.target.join(format!(".{band}.part"));
        write(&unfinished)?;
        let place = self.band(band);
        fs::rename(&unfinished, &place).map_err(Failure::at("cannot write", &place))
    }

    /// The rest of the files, which are written at the end.
    pub(super) fn output(&self) -> Result<OutputFolder, Failure> {
        OutputFolder::open(&self.target, OldFiles::Replace)
    }

    /// Nothing is in the making any more.
    pub(super) fn finish(&self) -> Result<(), Failure> {
        let mark = self.target.join(IN_THE_MAKING);
        fs::remove_file(&mark).map_err(Failure::at("cannot remove", &mark))
    }
}

/// All that a map depends on, as text.
fn identity(settings: &Value, raster: &Raster) -> String {
    // The same program hashes the same numbers alike.
    let mut heights = DefaultHasher::new();
    raster.heights.iter().for_each(|height| height.to_bits().hash(&mut heights));
    let keys = raster.coordinates.keys();
    (keys.directory, keys.text).hash(&mut heights);
    let grid = &raster.grid;
    let place = [raster.base, grid.south_west.x, grid.south_west.y, grid.spacing.x, grid.spacing.y];
    let identity = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "settings": settings,
        "columns": grid.columns,
        "rows": grid.rows,
        "place": place,
        "heights": heights.finish(),
    });
    identity.to_string() + "\n"
}
