//! The inputs of slip from currents.

use std::ops::RangeInclusive;

use grouser::answers::slip_from_current::SlipQuestion;
use grouser::document::given_file::GivenFile;
use grouser::document::measurements::motor_log::{
    LogChoice, MotorLog, MotorLogOfTelemetry, is_telemetry, read_motor_log,
};
use grouser::document::measurements::read_bytes;
use grouser::document::unit::{DEG, DIRECTION_DEG, less_whole_turns};
use grouser::document::{self, escape};
use grouser::studies::slip_from_current::{NoEstimator, SlipEstimator, SlipSettings, TorqueNoise};
use grouser::vehicle::Rover;

use super::{
    balanced_overrides, check_numbers, check_share_used, refuse_sampled_keys, scenario_source,
    single, telemetry_without_way,
};
use crate::args::SlipFromCurrentArgs;
use crate::commands::sampling;
use crate::failure::Failure;
use crate::list::Numbers;

/// The inputs of slip from currents.
pub(crate) struct SlipInputs {
    pub(crate) question: SlipQuestion,
    pub(crate) estimator: SlipEstimator,
    pub(crate) log: MotorLog,
    /// What was left out of telemetry.
    pub(crate) notes: Vec<String>,
    /// The log as it was read.
    pub(crate) bytes: Vec<u8>,
}

/// Noise that flags may state, as a share and in N·m.
const NOISE: RangeInclusive<f64> = 0.0..=100.0;
/// Yaws and courses that flags may state [°].
const TURN_DEG: RangeInclusive<f64> = DIRECTION_DEG;

pub(crate) fn slip_from_current(args: &SlipFromCurrentArgs) -> Result<SlipInputs, Failure> {
    const COMMAND: &str = "slip-from-current";
    let (parts, setting) = (&args.parts, &args.setting);
    let (rover, soil) = (parts.rover.as_ref(), parts.soil.as_ref());
    let mut overrides = balanced_overrides(COMMAND, rover, soil, setting, &args.balance)?;
    let level = args.scenario.is_none().then(|| "0".to_owned());
    if let Some(slope) = args.slope_deg.clone().or(level) {
        overrides.flag("--slope-deg", "scenario.slope_deg", &slope)?;
    }
    let source = scenario_source("--scenario", args.scenario.as_deref())?;
    let scenario = document::read_scenario(&source, &overrides)?;
    let settings = settings(args)?;
    let sampling = args.uncertainty.sampling();
    let samples = match sampling {
        Some(it) => {
            refuse_sampled_keys(setting, scenario.uncertain.as_ref())?;
            sampling::draw_of(&scenario, it)?
        }
        None => Vec::new(),
    };
    let estimator = SlipEstimator::new(&scenario.value, samples, settings);
    let estimator = estimator.map_err(|error| match error {
        NoEstimator::NoMotor => {
            let name = scenario.document.text("rover.name").unwrap_or("without a name");
            Failure::Usage(format!(
                "rover {}: {error}\nhint: docs/models/rover.md has an example of a [motor]",
                escape::line(name)
            ))
        }
        NoEstimator::Parameter(error) => error.into(),
    })?;
    let choice = choice(args)?;
    let bytes = read_bytes(&args.log, choice.limits)?;
    let label = escape::path(&args.log);
    let (log, given, notes) = if is_telemetry(&bytes) {
        of_telemetry(args, &choice, &scenario.value.rover)?
    } else {
        let log = read_motor_log(&label, &bytes, &choice, &scenario.value.rover)?;
        let given = vec![log.given(&label)];
        (log, given, Vec::new())
    };
    let one = |numbers: &Option<Numbers>| numbers.as_ref().map(|it| it.0[0]);
    let question = SlipQuestion {
        log: args.log.display().to_string(),
        given,
        ignored: args.ignore.clone(),
        scenario,
        given_yaw: one(&args.yaw_deg),
        given_course: one(&args.course_deg),
        settings,
        sampling,
    };
    Ok(SlipInputs { question, estimator, log, notes, bytes })
}

/// Telemetry, by the reader of `learn`; what it gave, and what of it was left out.
fn of_telemetry(
    args: &SlipFromCurrentArgs,
    choice: &LogChoice,
    rover: &Rover,
) -> Result<(MotorLog, Vec<GivenFile>, Vec<String>), Failure> {
    let mut telemetry = telemetry_without_way(&args.log, &args.log_args, rover)?;
    let mut log = MotorLogOfTelemetry::default();
    let most = choice.limits.rows;
    while let Some(record) = telemetry.next_record()? {
        if log.count() == most {
            let label = telemetry.label();
            let why = format!("{label}: has more than {most} rows\nhint: --max-rows reads more");
            return Err(Failure::Usage(why));
        }
        log.add(&record, choice, rover);
    }
    check_share_used(telemetry.label(), telemetry.share_used(), &args.log_args)?;
    Ok((log.finish(telemetry.label())?, telemetry.given(), telemetry.notes()))
}

fn settings(args: &SlipFromCurrentArgs) -> Result<SlipSettings, Failure> {
    let noise = TorqueNoise {
        relative: single("--relative-noise", &args.relative_noise, &NOISE)?,
        absolute: single("--noise-nm", &args.noise_nm, &NOISE)?,
    };
    let [low, high] = args.slip_ratio.0[..] else {
        return Err(Failure::Usage(
            "--slip-ratio: expected two values, the lowest and the highest".to_owned(),
        ));
    };
    check_numbers("--slip-ratio", &args.slip_ratio, &(-1.0..=1.0))?;
    let settings = SlipSettings { noise, slips: [low, high] };
    settings.check()?;
    Ok(settings)
}

fn choice(args: &SlipFromCurrentArgs) -> Result<LogChoice, Failure> {
    let angle = |flag: &str, numbers: &Option<Numbers>, range| {
        let number = numbers.as_ref().map(|numbers| single(flag, numbers, range)).transpose()?;
        Ok::<_, Failure>(number.map(|number| DEG.to_si(less_whole_turns(number))))
    };
    let mut choice = LogChoice {
        yaw: angle("--yaw-deg", &args.yaw_deg, &TURN_DEG)?,
        course: angle("--course-deg", &args.course_deg, &TURN_DEG)?,
        limits: args.read.limits(),
        ..LogChoice::default()
    };
    for name in &args.ignore {
        choice.ignore(name.trim()).map_err(|text| Failure::Usage(format!("--ignore {text}")))?;
    }
    Ok(choice)
}
