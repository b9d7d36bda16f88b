//! A drive that was replayed: every channel over time, how far measured and predicted are apart,
//! and what that points to.

use super::super::reading::counted;
use super::super::table::Table;
use super::super::unit::{DEG, ONE, S, Unit};
use super::learn::gross_in_words;
use super::run::{FORWARD_SPEED, LATERAL_SPEED, YAW_RATE};
use super::slip_from_current::WHEEL;
use super::{
    Column, ENERGY, PITCH, POWER, Quantity, ROLL, SINKAGE, SLIP_RATIO, SLOPE, TIME, TORQUE, X, Y,
    YAW, number, quantity, text, whole, words,
};
use crate::studies::ensemble::Probability;
use crate::studies::replay::{
    Attribution, Cause, Channel, ChannelSummary, ChannelValue, Ended, Finding, Parameter, Replay,
    ReplayedStretch,
};
use crate::vehicle::Rover;

/// What is compared.
pub const CHANNEL: &str = "channel";
/// What its prediction takes from the telemetry.
pub const PREDICTION: &str = "prediction";
/// The mean of the residuals.
pub const BIAS: &str = "bias";
/// The root of their mean square.
pub const RMS: &str = "rms";
/// Their standard deviation.
pub const SCATTER: &str = "scatter";
/// How many stretches lie within their bands.
pub const SHARE_WITHIN: Quantity = quantity("share_within_band", ONE);
/// What differences may point to.
pub const CAUSE: &str = "cause";
/// A number of a cause.
pub const PARAMETER: &str = "parameter";
/// How far off it is.
pub const ESTIMATE: &str = "estimate";
/// Its standard deviation.
pub const DEVIATION: &str = "deviation";
/// How much of the differences a cause explains.
pub const SHARE: &str = "share";
/// Column of what a cause explains if it is the only one.
pub const SHARE_ALONE: &str = "share_alone";
/// Where the part of a log begins that is replayed, and where it ends.
pub const FROM: Quantity = quantity("from_s", S);
/// The other end.
pub const TO: Quantity = quantity("to_s", S);
/// What the differences say of it.
pub const FINDING: &str = "finding";
/// What cannot be told apart from it.
pub const RIVALS: &str = "indistinguishable_from";

/// The quantity of a channel.
#[must_use]
pub const fn quantity_of(channel: Channel) -> Quantity {
    match channel {
        Channel::ForwardSpeed => FORWARD_SPEED,
        Channel::LateralSpeed => LATERAL_SPEED,
        Channel::YawRate => YAW_RATE,
        Channel::SlipRatio => SLIP_RATIO,
        Channel::Power => POWER,
        Channel::Torque(_) => TORQUE,
        Channel::Sinkage(_) => SINKAGE,
        Channel::X => X,
        Channel::Y => Y,
        Channel::Yaw => YAW,
        Channel::Roll => ROLL,
        Channel::Pitch => PITCH,
    }
}

const fn doc_of(channel: Channel) -> &'static str {
    match channel {
        Channel::ForwardSpeed => {
            "Velocity along the body: measured, predicted, and measured less predicted"
        }
        Channel::LateralSpeed => "Velocity to the body's left, the same",
        Channel::YawRate => "Yaw rate, the same",
        Channel::SlipRatio => "Mean slip ratio of the wheels, the same",
        Channel::Power => "Mechanical power of all wheels, the same",
        Channel::Torque(_) => "Torque on the wheel, the same",
        Channel::Sinkage(_) => "Sinkage of the wheel, the same",
        Channel::X => "Position along the contour, of the free run",
        Channel::Y => "Position uphill, of the free run",
        Channel::Yaw => "Yaw from the contour, positive uphill, of the free run",
        Channel::Roll => "Roll, positive with the right side down, of the free run",
        Channel::Pitch => "Pitch, positive with the nose up, of the free run",
    }
}

/// Columns of every stretch.
pub const STRETCH: [Column<ReplayedStretch>; 2] = [
    TIME.number("End of the stretch", |it| it.time),
    SLOPE.maybe("Slope of the ground, as it was read", |it| it.attitude.map(|it| it[0])),
];

/// The columns of a channel: measured, predicted and residual, and the band where samples were
/// drawn.
#[must_use]
pub fn columns_of(channel: Channel) -> [Column<ChannelValue>; 2] {
    let quantity = quantity_of(channel);
    [
        quantity.replayed(doc_of(channel), |it| [it.measured, it.predicted, it.residual]),
        quantity.band("The same over samples of soil and model", |it| it.band),
    ]
}

/// What a channel's names begin with: nothing, or its wheel.
#[must_use]
pub fn prefix_of(channel: Channel, rover: &Rover) -> String {
    let wheel = channel.wheel().map(|wheel| rover.mounts()[wheel].name.as_str());
    wheel.map_or_else(String::new, |name| format!("{name}."))
}

/// The channels that anything was measured of, with their places in [`ReplayedStretch::values`].
#[must_use]
pub fn measured_channels(replay: &Replay, rover: &Rover) -> Vec<(usize, Channel)> {
    let all = Channel::all(rover.wheel_count()).into_iter().enumerate();
    let is_measured =
        |place: usize| replay.stretches.iter().any(|it| it.values[place].measured.is_some());
    all.filter(|(place, _)| is_measured(*place)).collect()
}

/// A row for each stretch, with the channels that anything was measured of.
#[must_use]
pub fn over_time(replay: &Replay, rover: &Rover) -> Table {
    let mut table = Table::of(&STRETCH, &replay.stretches);
    for (place, channel) in measured_channels(replay, rover) {
        let values: Vec<Option<&ChannelValue>> =
            replay.stretches.iter().map(|it| it.values.get(place)).collect();
        let has_band = values.iter().flatten().any(|it| it.band.is_some());
        let columns = columns_of(channel);
        let shown = if has_band { &columns[..] } else { &columns[..1] };
        table = table.and_named(&prefix_of(channel, rover), shown, &values);
    }
    table
}

/// A channel with its wheel, in its own unit.
struct Summarised {
    summary: ChannelSummary,
    wheel: Option<String>,
}

impl Summarised {
    fn unit(&self) -> Unit {
        quantity_of(self.summary.channel).unit
    }
}

const CHANNELS: [Column<Summarised>; 9] = [
    text(CHANNEL, "What is compared, with the unit of the numbers beside it", |it| {
        Some(quantity_of(it.summary.channel).name.to_owned())
    }),
    text(WHEEL, "The wheel, of torques and sinkages", |it| it.wheel.clone()),
    text(
        PREDICTION,
        "`prescribed`: at the attitude, wheel speeds and steering angles that were read; \
         `free-run`: from the first pose, with these wheel speeds",
        |it| Some(it.summary.channel.prediction().name().to_owned()),
    ),
    whole("stretches", "Stretches that have both", |it| Some(it.summary.count)),
    number("measured_mean", ONE, "Mean of what was measured", |it| {
        it.unit().from_si(it.summary.means[0])
    }),
    number(BIAS, ONE, "Mean of the residuals, measured less predicted", |it| {
        it.unit().from_si(it.summary.bias)
    }),
    number(RMS, ONE, "Root of the mean square of the residuals", |it| {
        it.unit().from_si(it.summary.rms)
    }),
    number(SCATTER, ONE, "Standard deviation of the residuals", |it| {
        it.unit().from_si(it.summary.scatter)
    }),
    SHARE_WITHIN
        .probability("Share of the stretches that lie within the 95 % band over samples", within),
];

fn within(it: &Summarised) -> Option<Probability> {
    it.summary.within
}

/// A row for each channel that was measured and predicted.
#[must_use]
pub fn channels(replay: &Replay, rover: &Rover) -> Table {
    let row = |summary: &ChannelSummary| {
        let wheel = summary.channel.wheel().map(|wheel| rover.mounts()[wheel].name.clone());
        Summarised { summary: *summary, wheel }
    };
    Table::of(&CHANNELS, &replay.channels.iter().map(row).collect::<Vec<_>>())
}

/// The columns of [`channels`] for reading.
#[must_use]
pub fn brief_channels(replay: &Replay) -> Vec<&'static str> {
    let has_bands = replay.channels.iter().any(|it| it.within.is_some());
    let shown = [CHANNEL, WHEEL, PREDICTION, "measured_mean", BIAS, RMS, SCATTER];
    shown.into_iter().chain(has_bands.then_some(SHARE_WITHIN.name)).collect()
}

/// The name and unit of a parameter.
#[must_use]
pub const fn quantity_of_parameter(parameter: Parameter) -> Quantity {
    match parameter {
        Parameter::Strength => quantity("soil_strength", ONE),
        Parameter::ShearModulus => quantity("soil_shear_moduli", ONE),
        Parameter::Stiffness => quantity("soil_stiffness", ONE),
        Parameter::Speed => quantity("rim_speed", ONE),
        Parameter::Slope => SLOPE,
        Parameter::Roll => ROLL,
        Parameter::Pitch => PITCH,
        Parameter::Yaw => quantity("attitude_yaw_deg", DEG),
        Parameter::Odometry => quantity("odometry_yaw_deg", DEG),
        Parameter::YawRate => YAW_RATE,
        Parameter::Torque => quantity("torque_scale", ONE),
    }
}

/// The columns of [`findings`].
pub const FINDINGS: [Column<Finding>; 10] = [
    text(CAUSE, "What may be wrong", |it| Some(it.parameter.cause().name().to_owned())),
    text(
        FINDING,
        "`points-to`, `underdetermined`, `nothing`, or `cannot-tell` where the differences leave \
         its numbers as uncertain as before",
        |it| Some(verdict_name(&it.verdict).to_owned()),
    ),
    text(
        PARAMETER,
        "How far it is off, with the unit of the two numbers beside it; without a unit a share: \
         0.05 is 5 %",
        |it| Some(quantity_of_parameter(it.parameter).name.to_owned()),
    ),
    number(
        ESTIMATE,
        ONE,
        "By how much what is true is above what was read or assumed; of sensors, by how much they \
         read too much",
        |it| quantity_of_parameter(it.parameter).unit.from_si(it.estimate),
    ),
    number(DEVIATION, ONE, "Its standard deviation", |it| {
        quantity_of_parameter(it.parameter).unit.from_si(it.deviation)
    }),
    number(
        SHARE,
        ONE,
        "Share of the squares of the differences, over their noise, that the cause explains",
        |it| it.share,
    ),
    number(
        "evidence_ln",
        ONE,
        "Evidence for the cause, ln of the Bayes factor: very strong above 5",
        |it| it.evidence,
    ),
    number(
        SHARE_ALONE,
        ONE,
        "Share that the cause explains if it is the only one; causes that do the same on this \
         drive explain the same",
        |it| it.alone.share,
    ),
    words(RIVALS, "Causes that explain the differences as well", |it| match &it.verdict {
        Attribution::Underdetermined(rivals) => rivals.iter().map(|it| it.name()).collect(),
        _ => Vec::new(),
    }),
    text("meaning", "What the cause means", |it| Some(it.parameter.cause().meaning().to_owned())),
];

/// The columns of [`findings`] for reading.
#[must_use]
pub fn brief_findings() -> [&'static str; 7] {
    [CAUSE, FINDING, PARAMETER, ESTIMATE, DEVIATION, SHARE, RIVALS]
}

const fn verdict_name(verdict: &Attribution) -> &'static str {
    match verdict {
        Attribution::PointsTo => "points-to",
        Attribution::Underdetermined(_) => "underdetermined",
        Attribution::Nothing => "nothing",
        Attribution::CannotTell => "cannot-tell",
    }
}

/// A row for each parameter, those of a cause together.
#[must_use]
pub fn findings(replay: &Replay) -> Table {
    Table::of(&FINDINGS, &replay.findings)
}

/// What the differences point to: a sentence for each cause, that which explains most first.
#[must_use]
pub fn sentences(replay: &Replay) -> Vec<String> {
    // Gross faults first: beside one of them the others are of no account.
    let gross: Vec<String> = replay.gross_faults.iter().map(gross_in_words).collect();
    let of_differences = differences_in_words(replay);
    let has_gross = !gross.is_empty();
    // What is left out for its fault leaves causes as uncertain as before: that was said of it.
    let says_more = |it: &String| it != NOTHING && !it.starts_with(CANNOT_TELL);
    gross
        .into_iter()
        .chain(of_differences.into_iter().filter(|it| !has_gross || says_more(it)))
        .collect()
}

/// What differences point to that are within the noise.
const NOTHING: &str =
    "the differences are within the noise of instruments and model, and point to nothing";

/// How sentences begin on what this drive says nothing of.
const CANNOT_TELL: &str = "cannot tell";

fn differences_in_words(replay: &Replay) -> Vec<String> {
    let records = counted(replay.taken.records, "record", "records");
    if replay.explained_stretches == 0 {
        return vec![format!("{CANNOT_TELL}: no stretch of {records} could be predicted")];
    }
    let is_pointed_to = |it: &Finding| {
        matches!(it.verdict, Attribution::PointsTo | Attribution::Underdetermined(_))
    };
    let mut causes = causes(replay, is_pointed_to);
    causes.sort_by(|(_, one), (_, other)| other.total_cmp(one));
    let mut sentences: Vec<String> =
        causes.iter().map(|(cause, _)| sentence(replay, *cause)).collect();
    let hidden = self::causes(replay, |it| it.verdict == Attribution::CannotTell);
    let hidden: Vec<&str> = hidden.iter().map(|(cause, _)| cause.name()).collect();
    const UNCERTAIN: &str = "what was read on this drive leaves them as uncertain as before";
    if hidden.len() == Cause::ALL.len() {
        let why = missing_readings(replay).unwrap_or_else(|| UNCERTAIN.to_owned());
        let of = if replay.part.is_whole() { String::new() } else { format!(" from {records}") };
        return vec![format!("{CANNOT_TELL}{of}: {why}")];
    }
    if sentences.is_empty() {
        sentences.push(NOTHING.to_owned());
    }
    if !hidden.is_empty() {
        sentences.push(format!("{CANNOT_TELL} of {}: {UNCERTAIN}", hidden.join(", ")));
    }
    sentences
}

/// What each of the best causes explains as the only one; nothing where none explains anything.
#[must_use]
pub fn best_in_words(replay: &Replay) -> Option<String> {
    let best: Vec<String> = replay
        .best_causes()
        .iter()
        .map(|(cause, share)| format!("{} {:.0} %", cause.name(), 100.0 * share))
        .collect();
    (!best.is_empty())
        .then(|| format!("each as the only cause explains of the differences: {}", best.join(", ")))
}

/// The causes of some findings, each with the share of the differences that it explains.
fn causes(replay: &Replay, which: impl Fn(&Finding) -> bool) -> Vec<(Cause, f64)> {
    let mut causes: Vec<(Cause, f64)> = Vec::new();
    for finding in replay.findings.iter().filter(|it| which(it)) {
        let cause = finding.parameter.cause();
        if causes.iter().all(|(known, _)| *known != cause) {
            causes.push((cause, finding.share));
        }
    }
    causes
}

/// Which kinds of readings a log does not have, if it lacks any.
fn missing_readings(replay: &Replay) -> Option<String> {
    type Is = fn(&Channel) -> bool;
    let kinds: [(&str, Is); 4] = [
        ("velocities of the body", |it| {
            matches!(it, Channel::ForwardSpeed | Channel::LateralSpeed)
        }),
        ("yaw rate", |it| *it == Channel::YawRate),
        ("torques", |it| matches!(it, Channel::Torque(_))),
        ("sinkages", |it| matches!(it, Channel::Sinkage(_))),
    ];
    let is_missing = |is: Is| !replay.channels.iter().any(|it| is(&it.channel));
    let missing: Vec<&str> =
        kinds.into_iter().filter(|(_, is)| is_missing(*is)).map(|(name, _)| name).collect();
    (!missing.is_empty()).then(|| format!("the log has no {}", missing.join(", no ")))
}

fn sentence(replay: &Replay, cause: Cause) -> String {
    let of_cause: Vec<&Finding> =
        replay.findings.iter().filter(|it| it.parameter.cause() == cause).collect();
    let numbers: Vec<String> = of_cause.iter().map(|it| estimate_of(it)).collect();
    let share = of_cause.first().map_or(0.0, |it| it.share);
    let rivals = match of_cause.first().map(|it| &it.verdict) {
        Some(Attribution::Underdetermined(rivals)) => {
            let names: Vec<&str> = rivals.iter().map(|it| it.name()).collect();
            format!("; on this drive that cannot be told apart from {}", names.join(", "))
        }
        _ => String::new(),
    };
    format!(
        "{}: {} ({}); explains {:.0} % of the differences{rivals}",
        cause.name(),
        cause.meaning(),
        numbers.join(", "),
        // Without the sign that rounding leaves of less than nothing.
        (100.0 * share).round() + 0.0
    )
}

/// An estimate with its standard deviation.
fn estimate_of(finding: &Finding) -> String {
    let quantity = quantity_of_parameter(finding.parameter);
    let label = quantity.label();
    if quantity.unit == ONE {
        let [estimate, deviation] = [finding.estimate, finding.deviation].map(|it| 100.0 * it);
        return format!("{label} {estimate:+.1} ± {deviation:.1} %");
    }
    let [estimate, deviation] =
        [finding.estimate, finding.deviation].map(|it| quantity.unit.from_si(it));
    format!("{label} {estimate:+.2} ± {deviation:.2} {}", quantity.unit.symbol)
}

/// What to know of the drive and its predictions: a sentence each.
#[must_use]
pub fn notes(replay: &Replay) -> Vec<String> {
    let mut notes = Vec::new();
    if replay.every > 1 {
        let every = replay.every;
        notes.push(format!("the drive is long: one of {every} stretches is compared"));
    }
    for (why, count) in &replay.not_predicted {
        let stretches = counted(*count, "stretch has", "stretches have");
        notes.push(format!("{stretches} no prescribed motion: {}", why.meaning()));
    }
    if replay.taken.outliers > 0 {
        let outliers = replay.taken.outliers;
        notes.push(counted(
            outliers,
            "reading far from those around it is left out",
            "readings far from those around them are left out",
        ));
    }
    let starts = replay.free_run.starts.len();
    if starts > 1 {
        notes.push(format!(
            "the free run is set on the measured pose {starts} times: at the start, and behind \
             each gap"
        ));
    }
    if let Some((time, ended)) = &replay.free_run.ended {
        let why = match ended {
            Ended::Outcome(outcome) => outcome.kind().in_words(),
            Ended::Failed(why) => why.clone(),
        };
        notes.push(format!("the free run ends at {time:.1} s: {why}"));
    }
    notes
}

/// Work of the wheels, measured and predicted.
pub const WORK: [Column<[f64; 2]>; 1] =
    [ENERGY.measured("Work of the wheels over the stretches that have both", |it| it.map(Some))];
