//! Logs of runs: where they go, and what they have.

use std::io::Write;
use std::path::Path;

use grouser::document::{Loaded, LoadedMission, LoadedScenario, escape};
use grouser::simulation::Trajectory;
use grouser::studies::mission::DrivenMission;
use grouser::studies::replay::Replay;
use grouser_draw::title_of;
use grouser_logs::{Log, LogError, write_replay};

use super::place::Place;
use crate::failure::Failure;
use crate::output::folder::OutputFolder;

/// How the names of logs end.
const ENDING: &str = "mcap";

/// Where a log goes.
pub(super) struct Target<'a> {
    place: Place<'a>,
}

impl<'a> Target<'a> {
    /// What would fail once the run is done fails now.
    ///
    /// * `has_folder`: whether other results go into a folder
    pub(super) fn of(path: &'a Path, has_folder: bool, may_replace: bool) -> Result<Self, Failure> {
        if path.extension().is_none_or(|ending| !ending.eq_ignore_ascii_case(ENDING)) {
            let shown = escape::path(path);
            return Err(Failure::Usage(format!(
                "--mcap {shown}: the name of a log ends with `.{ENDING}`, by which Foxglove and \
                 Rerun know it"
            )));
        }
        Ok(Self { place: Place::of(path, has_folder, may_replace)? })
    }

    /// Writes the log of a run, or adds it to the folder.
    pub(super) fn write(
        &self,
        scenario: &LoadedScenario,
        run: &Trajectory,
        folder: Option<&mut OutputFolder>,
    ) -> Result<(), Failure> {
        self.write_with(folder, |out| {
            let mut log = Log::begin(out, &title_of(scenario), &scenario.value)?;
            log.append(&run.records)?;
            log.outcome(run.last().time, &run.outcome)?;
            finish(log, "scenario.toml", scenario)
        })
    }

    /// The same of a mission.
    pub(super) fn write_mission(
        &self,
        document: &LoadedMission,
        mission: &DrivenMission,
        folder: Option<&mut OutputFolder>,
    ) -> Result<(), Failure> {
        self.write_with(folder, |out| {
            let mut log = Log::begin(out, &title_of(document), &document.value.scenario)?;
            log.mission(mission)?;
            finish(log, "mission.toml", document)
        })
    }

    /// The same of a replayed drive.
    pub(super) fn write_replay(
        &self,
        scenario: &LoadedScenario,
        replay: &Replay,
        folder: Option<&mut OutputFolder>,
    ) -> Result<(), Failure> {
        let mut documents = vec![("scenario.toml".to_owned(), scenario.to_toml().into_bytes())];
        let companions = scenario.companions.iter();
        documents.extend(companions.map(|it| (it.name.clone(), it.content.clone().into())));
        self.write_with(folder, |out| {
            let drive = (replay, &scenario.value.rover);
            write_replay(out, &title_of(scenario), drive, &documents).map(drop)
        })
    }

    fn write_with(
        &self,
        folder: Option<&mut OutputFolder>,
        content: impl Fn(&mut dyn Write) -> Result<(), LogError>,
    ) -> Result<(), Failure> {
        let content = |out: &mut dyn Write| {
            content(out).map_err(|error| match error {
                LogError::Write(error) => self.place.failed()(error),
                other => Failure::Run(other.to_string()),
            })
        };
        self.place.write(folder, content)
    }
}

/// Puts the document that determined a run into its log, and ends that.
fn finish<V>(
    mut log: Log<&mut dyn Write>,
    name: &str,
    document: &Loaded<V>,
) -> Result<(), LogError> {
    log.attach(name, "application/toml", document.to_toml().as_bytes())?;
    for companion in &document.companions {
        log.attach(&companion.name, "text/plain", companion.content.as_bytes())?;
    }
    log.finish().map(drop)
}
