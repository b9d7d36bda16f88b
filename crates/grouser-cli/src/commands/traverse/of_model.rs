//! What a wheel–soil model answers about a traverse.

use grouser::answers::AnswerError;
use grouser::answers::traverse::{Path, RunGradient, path_chart};
use grouser::document::columns::{MODEL, TIME, run};
use grouser::document::given_file::GivenFile;
use grouser::document::given_to_drives;
use grouser::document::gradient::{GradientKeys, RunKeys};
use grouser::document::table::Table;
use grouser::document::{LoadedScenario, escape};
use grouser::simulation::{Run, RunError, Trajectory};
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::traverse_band::{TraverseBand, record_times};
use grouser_draw::chart::Chart;

use crate::args::{SettingArgs, TraverseArgs, UncertaintyArgs};
use crate::commands::{sampling, strict};
use crate::failure::Failure;
use crate::inputs;
use crate::output::folder::OutputFolder;
use crate::output::rows::Rows;

/// The file of a run's records.
pub(super) const RECORDS: &str = "traverse.csv";

/// What a model answers.
pub(super) struct OfModel {
    pub(super) scenario: LoadedScenario,
    pub(super) run: Trajectory,
    pub(super) band: Option<TraverseBand>,
    pub(super) gradient: Option<RunGradient>,
}

impl OfModel {
    /// * `setting`: with one model
    /// * `gradients`: keys of derivatives
    /// * `folder`: takes the records until an error
    pub(super) fn of(
        args: &TraverseArgs,
        setting: &SettingArgs,
        gradients: Option<&GradientKeys>,
        folder: &mut Option<OutputFolder>,
    ) -> Result<Self, Failure> {
        let scenario = inputs::traverse(args, setting, args.yaw_deg.as_deref())?;
        let mut run = Run::new(&scenario.value)?;
        let done = run.run_to_end();
        let run = run.finish();
        if let Err(error) = done {
            return Err(unfinished(&scenario, &run, error, folder.take()));
        }
        if args.strict.strict {
            let flags = run::each_findings(&run, &scenario.value);
            let records = run::table(&run, &scenario.value);
            strict::check(&args.strict, flags.iter().map(|it| &**it), &records, &[TIME.name])?;
        }
        let UncertaintyArgs { sampling, seed } = args.uncertainty;
        if !sampling.uncertainty {
            let keys = gradients.map(|it| RunKeys::of(&scenario, it)).transpose();
            let gradient = keys.map_err(AnswerError::from)?.map(|keys| {
                sampling::with_bar_of("runs", keys.runs(), |go_on| {
                    sampling::whole(RunGradient::of(&scenario, &run, keys, go_on))
                })
            });
            return Ok(Self { scenario, run, band: None, gradient });
        }
        if gradients.is_some() {
            return Err(Failure::Usage(
                "--gradients: derivatives are of the run as its documents are written, and \
                 --uncertainty asks for samples\nhint: leave one of them out"
                    .to_owned(),
            ));
        }
        inputs::refuse_sampled_keys(setting, scenario.uncertain.as_ref())?;
        let samples = sampling::draw(&BandInputs::of_scenario(&scenario), sampling.samples, seed)?;
        let times = record_times(&run, &scenario.value);
        let band = sampling::with_bar(samples.len(), |go_on| {
            TraverseBand::of(&scenario.value, &samples, &times, go_on)
        });
        Ok(Self { scenario, run, band: Some(sampling::whole(band?)), gradient: None })
    }

    pub(super) fn name(&self) -> &'static str {
        self.scenario.value.model.name()
    }

    /// A row for each record, with the bands at its time.
    pub(super) fn rows(&self) -> Table {
        let mut table = run::table(&self.run, &self.scenario.value);
        if let Some(gradient) = &self.gradient {
            table.columns.extend(gradient.rows.columns.iter().cloned());
        }
        match &self.band {
            Some(band) => run::with_bands(table, &band.times, &self.scenario.value),
            None => table,
        }
    }

    /// The end and the means, with their bands: one row.
    pub(super) fn summary(&self) -> Table {
        let scenario = &self.scenario.value;
        let mut table = run::summary(&self.run, scenario);
        if let Some(band) = &self.band {
            table = run::with_run_band(table, &band.run, scenario);
        }
        if let Some(gradient) = &self.gradient {
            let last = gradient.rows.rows_at(&[self.run.records.len() - 1]);
            table.columns.extend(last.columns);
        }
        table.with_word(MODEL, self.name())
    }
}

/// The failure of a run that ends with an error, whose records until then go to the folder, if
/// there is one.
fn unfinished(
    scenario: &LoadedScenario,
    run: &Trajectory,
    error: RunError,
    folder: Option<OutputFolder>,
) -> Failure {
    let Some(mut folder) = folder else { return error.into() };
    let kept = Rows::of_table(&run::table(run, &scenario.value)).to_csv().and_then(|rows| {
        folder.add(RECORDS, rows);
        folder.add_document("scenario.toml", scenario);
        folder.finish()
    });
    match kept {
        Ok(()) => Failure::Run(format!(
            "{}; the records until then are in {RECORDS}",
            escape::line(&error.to_string())
        )),
        Err(failure) => failure,
    }
}

/// The paths, seen from above, each with its band if there is one.
pub(super) fn chart(all: &[OfModel]) -> Chart {
    let on_a_map = all.iter().any(|it| !it.scenario.value.ground.is_plane());
    let paths: Vec<Path<'_>> =
        all.iter().map(|it| (it.name(), &it.run, it.band.as_ref())).collect();
    path_chart(on_a_map, &paths)
}

/// What the files gave.
pub(super) fn given(all: &[OfModel]) -> Vec<GivenFile> {
    let scenario = &all[0].scenario;
    given_to_drives(scenario, &scenario.value, all.iter().map(|it| &it.run))
}
