//! The map of heights that a question is about, and the rover and soil that are to drive on it.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

use grouser::document::LoadedScenario;
use grouser::document::file::CONFINED_CELLS;
use grouser::document::study::MAP_SPEED_M_S;
use grouser::studies::verdict::{Rule, SlopeStudy};
use grouser_raster::{MapPath, Raster, ReadOptions, beside};
use http::StatusCode;
use serde_json::{Value, json};

use super::command::CommandLine;
use super::fields::AskedFields;
use super::parts::ScenarioParts;
use super::rule;
use crate::console::Console;
use crate::folder::ServedFolder;
use crate::kept::Kept;
use crate::refusal::Refusal;

/// What a question says of its map, and of who drives on it.
pub(super) struct GroundFields {
    dem: String,
    missing: Option<f64>,
    rim_speed: Option<f64>,
    rule: Rule,
    parts: ScenarioParts,
}

/// A map, and who drives on it.
pub(super) struct AskedGround {
    /// The path of the map, as the question has it.
    pub(super) dem: PathBuf,
    /// The file, without links.
    path: PathBuf,
    pub(super) folder: ServedFolder,
    missing: Option<f64>,
    pub(super) scenario: LoadedScenario,
    pub(super) study: SlopeStudy,
    rasters: Arc<Kept<Raster>>,
}

impl GroundFields {
    pub(super) fn of(fields: &AskedFields) -> Result<Self, Refusal> {
        let dem = fields.text("dem")?.ok_or_else(|| {
            Refusal::of_key("dem", "it must be the path of a map of heights in the folder")
        })?;
        Ok(Self {
            dem,
            missing: fields.number("missing_m", &(f64::MIN..=f64::MAX))?,
            rim_speed: fields.number("rim_speed_m_s", &MAP_SPEED_M_S)?,
            rule: rule::of(fields)?,
            parts: ScenarioParts::of(fields)?,
        })
    }

    /// Reads the documents, and finds the map.
    pub(super) fn open(&self, console: &Console) -> Result<AskedGround, Refusal> {
        if self.parts.common().has_every_model() {
            let message = "what is made of a map is of one model, or of those that are believed";
            return Err(Refusal::of_key("model", message).with_hint("leave it out"));
        }
        let scenario = self.parts.scenarios(&console.folder, true)?.into_iter().next();
        let scenario = scenario.ok_or_else(|| {
            Refusal::new(StatusCode::INTERNAL_SERVER_ERROR, "there is no scenario")
        })?;
        let path = console.folder.find_map(&self.dem);
        let path = path.map_err(|problem| Refusal::of_key("dem", problem.to_string()))?;
        let rim_speed = self.rim_speed.unwrap_or(scenario.value.drive.nominal_rim_speed());
        let study = SlopeStudy { rim_speed, rule: self.rule, ..SlopeStudy::of(&scenario) };
        Ok(AskedGround {
            dem: PathBuf::from(&self.dem),
            path,
            folder: console.folder.clone(),
            missing: self.missing,
            scenario,
            study,
            rasters: Arc::clone(&console.kept.rasters),
        })
    }

    /// The command line, but for what it is to find out.
    pub(super) fn line(&self, command: &str) -> CommandLine {
        let mut line = CommandLine::new(command);
        line.word(&self.dem);
        self.parts.add_words(&mut line);
        let number = |number: Option<f64>| number.map(|it| it.to_string());
        line.maybe("missing-m", number(self.missing).as_deref());
        line.maybe("rim-speed-m-s", number(self.rim_speed).as_deref());
        rule::add_words(&self.rule, &mut line);
        line
    }
}

impl AskedGround {
    /// The heights.
    pub(super) fn raster(&self) -> Result<Arc<Raster>, Refusal> {
        self.rasters.get_or(&json!([self.stamp(), self.missing]).to_string(), || {
            let (cells, missing) = (Some(CONFINED_CELLS), self.missing);
            let options = ReadOptions { cells, missing, ..ReadOptions::default() };
            let open = &|path: &Path| self.folder.open_file(path);
            grouser_raster::read(MapPath { path: &self.path, open }, &options).map_err(|error| {
                let (message, hint) = error.fault.in_parts("map", Some(&error.file));
                Refusal { hint, ..Refusal::of_key("dem", message) }
            })
        })
    }

    /// All that a result depends on.
    ///
    /// * `more`: beside map, documents, rim speed and rule
    pub(super) fn key(&self, more: &Value) -> String {
        let SlopeStudy { rim_speed, rule, .. } = &self.study;
        let of_map = json!([self.stamp(), self.missing]);
        json!([of_map, self.scenario.document, rim_speed, rule, more]).to_string()
    }

    /// By it files are known that were written anew: the map, those beside it, and those that the
    /// documents name.
    fn stamp(&self) -> Value {
        let named = self.scenario.given.iter().map(|given| PathBuf::from(&given.file));
        let files = std::iter::once(self.path.clone()).chain(beside(&self.path)).chain(named);
        files.map(|file| stamp(&file)).collect()
    }
}

fn stamp(path: &Path) -> Value {
    let file = std::fs::metadata(path).ok();
    let since = |time: SystemTime| time.duration_since(SystemTime::UNIX_EPOCH).ok();
    let written = file.as_ref().and_then(|it| it.modified().ok()).and_then(since);
    let written = written.map(|it| it.as_nanos().to_string());
    json!([shown(path), file.map(|it| it.len()), written])
}

/// A path as answers have it.
pub(super) fn shown(path: &Path) -> String {
    path.display().to_string()
}

/// What is odd about heights.
pub(super) fn remarks(raster: &Raster) -> Vec<String> {
    let declared = |height: f64| format!("`missing_m` = {height}");
    raster.remarks.iter().map(|remark| remark.in_words(declared)).collect()
}
