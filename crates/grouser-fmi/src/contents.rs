//! The files of an FMU.

use std::fs;
use std::path::Path;

use grouser::document::{Loaded, LoadedMission, LoadedScenario};
use serde_json::Value as Json;

use crate::description::{IDENTIFIER, description, page};
use crate::drive::Drive;
use crate::model::{FmuModel, file_name, token};

/// Keys of files with heights and with zones of soil, in the table `terrain`; and the folder of
/// each in an FMU.
const FILES: [(&str, &str); 2] = [("file", "terrain"), ("soil_file", "zones")];

/// A file of an FMU: its path there, and what is in it.
pub type File = (String, Vec<u8>);

/// What an FMU has, all but the library.
#[derive(Debug)]
pub struct Contents {
    /// Its files, in the order of their names.
    pub files: Vec<File>,
    /// What it says and takes.
    pub model: FmuModel,
}

/// The FMU of a scenario.
///
/// * `drive`: who turns the wheels
///
/// # Errors
/// A sentence for a scenario that cannot be one, and for files that it names and that cannot be
/// read.
pub fn of_scenario(loaded: &LoadedScenario, drive: Drive) -> Result<Contents, String> {
    contents(loaded, FmuModel::of_scenario(loaded, drive)?)
}

/// The FMU of a mission.
///
/// # Errors
/// The same as [`of_scenario`].
pub fn of_mission(loaded: &LoadedMission, drive: Drive) -> Result<Contents, String> {
    contents(loaded, FmuModel::of_mission(loaded, drive)?)
}

/// Where the library of this system is in an FMU; none where FMI has no name for the system.
#[must_use]
pub fn library_path() -> Option<String> {
    let (architecture, system) = (std::env::consts::ARCH, std::env::consts::OS);
    let system = match system {
        "linux" | "windows" => system,
        "macos" => "darwin",
        _ => return None,
    };
    let end = std::env::consts::DLL_SUFFIX;
    let is_named = ["x86_64", "x86", "aarch64", "riscv64"].contains(&architecture);
    is_named.then(|| format!("binaries/{architecture}-{system}/{IDENTIFIER}{end}"))
}

fn contents<V>(loaded: &Loaded<V>, model: FmuModel) -> Result<Contents, String> {
    let mut files = Vec::new();
    let mut document = loaded.document.clone();
    for (key, folder) in FILES {
        let Some(path) = document.text(&format!("terrain.{key}")).map(str::to_owned) else {
            continue;
        };
        let name = file_name_of(&path)?;
        files.extend(family(Path::new(&path), folder)?);
        document = document.changed(|keys| {
            if let Some(terrain) = keys.get_mut("terrain").and_then(Json::as_object_mut) {
                terrain.insert(key.to_owned(), format!("{folder}/{name}").into());
            }
        });
    }
    let text = document.to_toml();
    let token = token(model.drive, &text);
    for companion in &loaded.companions {
        let content = companion.content.clone().into_bytes();
        files.push((format!("resources/{}", companion.name), content));
    }
    files.push((format!("resources/{}", file_name(model.kind())), text.into_bytes()));
    files.push(("documentation/index.html".to_owned(), page(&model).into_bytes()));
    files.push(("modelDescription.xml".to_owned(), description(&model, &token).into_bytes()));
    files.sort();
    Ok(Contents { files, model })
}

fn file_name_of(path: &str) -> Result<&str, String> {
    let name = Path::new(path).file_name().and_then(|name| name.to_str());
    name.ok_or_else(|| format!("{path} has no name that an FMU could give it"))
}

/// A file with those beside it that have its name and another end: labels, projections, headers.
fn family(path: &Path, folder: &str) -> Result<Vec<File>, String> {
    let unreadable = |error: std::io::Error| format!("cannot read {}: {error}", path.display());
    let parent = path.parent().unwrap_or(Path::new("."));
    let mut files = Vec::new();
    for entry in fs::read_dir(parent).map_err(unreadable)? {
        let beside = entry.map_err(unreadable)?.path();
        let name = beside.file_name().and_then(|name| name.to_str()).map(str::to_owned);
        let (Some(name), true) = (name, beside.file_stem() == path.file_stem()) else { continue };
        if beside.is_file() {
            let content = fs::read(&beside).map_err(unreadable)?;
            files.push((format!("resources/{folder}/{name}"), content));
        }
    }
    Ok(files)
}
