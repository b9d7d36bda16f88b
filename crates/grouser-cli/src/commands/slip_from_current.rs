//! `grouser slip-from-current`: the slip of each wheel from a log of its motor's current and speed.

mod page;
mod tables;

use grouser::document::columns::slip_from_current as columns;
use grouser::document::columns::{COURSE, SLOPE};
use grouser::document::table::Table;
use grouser::studies::slip_from_current::{MotorReading, MotorRecord};
use grouser_draw::chart::Draw;
use serde::Serialize;
use serde_json::{Value, json};

use self::tables::Tables;
use super::{Answer, sampling};
use crate::args::SlipFromCurrentArgs;
use crate::failure::Failure;
use crate::inputs::{self, SlipInputs};
use crate::output::folder::OutputFolder;
use crate::output::rows::{Rows, four_digits};
use crate::output::{self, Format};
use crate::report::REPORT;

pub(crate) fn run(args: &SlipFromCurrentArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let inputs = inputs::slip_from_current(args)?;
    let SlipInputs { estimator, log, .. } = &inputs;
    let found = sampling::with_bar(estimator.log_steps(log), |go_on| estimator.of_log(log, go_on));
    let found = sampling::whole(found);
    let rover = estimator.rover();
    let tables = Tables {
        rows: columns::table(rover, log, &found),
        wheels: columns::summary(rover, log, &found),
    };
    let notes = notes(&inputs);
    let results = Results { wheels: &tables.wheels, rows: &tables.rows, notes: &notes };
    let answer = Answer::new("slip-from-current", settings(args, &inputs), results);
    if let Some(mut folder) = folder {
        folder.add("slip-from-current.json", answer.to_text());
        folder.add("slip-from-current.csv", Rows::of_table(&tables.rows).to_csv()?);
        folder.add("wheels.csv", Rows::of_table(&tables.wheels).to_csv()?);
        for (wheel, chart) in page::charts(rover, &tables.rows) {
            folder.add(format!("figures/{wheel}.svg"), chart.to_svg());
        }
        folder.add(REPORT, page::html(args, &inputs, &tables, &notes));
        folder.add("log.csv", inputs.bytes.clone());
        folder.add_document("scenario.toml", &inputs.scenario);
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::show(tables.text(&notes)),
        Format::Csv => output::print(&Rows::of_table(&tables.rows).to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

#[derive(Serialize)]
struct Results<'a> {
    wheels: &'a Table,
    rows: &'a Table,
    notes: &'a [String],
}

/// Where loads and slip angles come from.
fn notes(inputs: &SlipInputs) -> Vec<String> {
    let log = &inputs.log;
    let lacks = |of: fn(&MotorReading) -> bool| {
        log.records.iter().any(|record| record.wheels.iter().flatten().any(of))
    };
    let some = |of: fn(&MotorRecord) -> bool| log.records.iter().any(of);
    let mut notes = Vec::new();
    if lacks(|reading| reading.load.is_none()) {
        let slope = if some(|record| record.slope.is_some()) {
            "the log's slope".to_owned()
        } else {
            let slope = inputs.scenario.value.ground.plane_slope().unwrap_or(0.0);
            let slope = SLOPE.unit.from_si(slope);
            format!("a slope of {}°", four_digits(slope))
        };
        let yaw = if some(|record| record.yaw.is_some()) { "its yaw" } else { "a yaw of 0°" };
        notes.push(format!(
            "loads follow from {slope}, {yaw} and the torques of all wheels, in steady motion"
        ));
    }
    if lacks(|reading| reading.slip_angle.is_none()) {
        notes.push(if some(|record| record.course.is_some()) {
            "slip angles are those of the yaw against the course".to_owned()
        } else {
            "slip angles are those of a rover that goes where it points; --course-deg 0 if it holds the contour"
                .to_owned()
        });
    }
    notes
}

/// The inputs of the answer.
fn settings(args: &SlipFromCurrentArgs, inputs: &SlipInputs) -> Value {
    let document = &inputs.scenario.document;
    let sampling = &args.uncertainty.sampling;
    let mut settings = json!({
        "log": args.log.display().to_string(),
        "ignore": args.ignore,
        "rover": document.get("rover"),
        "soil": document.get("soil"),
        "slope_deg": document.get("slope_deg"),
        "yaw_deg": args.yaw_deg.as_ref().map(|it| it.0[0]),
        (COURSE.name): args.course_deg.as_ref().map(|it| it.0[0]),
        "gravity_m_s2": document.get("gravity_m_s2"),
        "load_transfer": document.get("load_transfer"),
        "wheel_moments": document.get("wheel_moments"),
        "model": inputs.scenario.value.model.name(),
        "relative_noise": inputs.settings.noise.relative,
        "noise_nm": inputs.settings.noise.absolute,
        "slip_ratio": inputs.settings.slips,
    });
    if sampling.uncertainty {
        settings["samples"] = sampling.samples.into();
        settings["seed"] = args.uncertainty.seed.into();
        settings[sampling::WEIGHTS] = sampling::weights(&inputs.band);
    }
    settings
}
