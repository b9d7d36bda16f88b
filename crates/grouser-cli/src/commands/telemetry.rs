//! Simulated telemetry of runs: where it goes, and what is in it.

use std::io::Write;

use grouser::document::measurements::telemetry::{csv_header, csv_line};
use grouser::document::sensors::sensor_models;
use grouser::simulation::{Scenario, Trajectory};
use grouser::studies::simulated_telemetry::{Sensors, truth};

use super::place::Place;
use crate::args::RunArgs;
use crate::failure::Failure;
use crate::output::folder::OutputFolder;

/// Where telemetry goes, and the instruments that it is of.
pub(super) struct Target<'a> {
    place: Place<'a>,
    sensors: Sensors,
}

impl<'a> Target<'a> {
    /// What would fail once the run is done fails now; nothing where no telemetry is asked for.
    ///
    /// * `has_folder`: whether other results go into a folder
    pub(super) fn of(
        args: &'a RunArgs,
        has_folder: bool,
        may_replace: bool,
    ) -> Result<Option<Self>, Failure> {
        let Some(path) = &args.telemetry else { return Ok(None) };
        let models = sensor_models(args.sensors.iter().map(String::as_str))
            .map_err(|text| Failure::Usage(format!("--sensor: {text}")))?;
        let sensors = Sensors::new(models, args.sensor_seed)?;
        Ok(Some(Self { place: Place::of(path, has_folder, may_replace)?, sensors }))
    }

    /// Writes the telemetry of a run, or adds it to the folder.
    pub(super) fn write(
        &self,
        scenario: &Scenario,
        run: &Trajectory,
        folder: Option<&mut OutputFolder>,
    ) -> Result<(), Failure> {
        let seen = self.sensors.clone().read_all(&truth(run, scenario));
        self.place.write(folder, |out: &mut dyn Write| {
            let mut write = |text: String| {
                out.write_all(text.as_bytes()).map_err(|error| self.place.failed()(error))
            };
            write(csv_header(&scenario.rover))?;
            seen.iter().try_for_each(|record| write(csv_line(record)))
        })
    }
}
