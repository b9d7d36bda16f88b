//! What was learnt from a drive: predictions for slopes, what each stretch taught, and warnings.

use super::super::table::Table;
use super::super::unit::{M, ONE, S};
use super::heading::DRAWS;
use super::{
    Column, PROBABILITY_LEVEL, Quantity, SLIP_RATIO, SLOPE, TIME, YAW, quantity, text, whole,
};
use crate::studies::heading_band::SlopeBand;
use crate::studies::learn::{
    Contradiction, Evidence, GrossFault, Learner, Lesson, OneSided, Suspect, Warning,
};

/// The yaw as it was predicted before the drive.
pub const BEFORE_YAW: Quantity = quantity("before_yaw_deg", super::super::unit::DEG);
/// The slip as it was predicted before the drive.
pub const BEFORE_SLIP: Quantity = quantity("before_slip_ratio", ONE);
/// The rims' way since the start.
pub const WAY: Quantity = quantity("way_m", M);
/// Slip as it was expected.
pub const EXPECTED_SLIP: Quantity = quantity("expected_slip_ratio", ONE);
/// Time until something happens.
pub const LEAD_TIME: Quantity = quantity("lead_s", S);
/// Way until something happens.
pub const LEAD_WAY: Quantity = quantity("lead_m", M);
/// What a warning is about.
pub const WARNING: &str = "warning";
/// What was seen.
pub const EVIDENCE: &str = "evidence";
/// How much a stretch narrowed what is believed.
pub const INFORMATION: Quantity = quantity("information_nat", ONE);

/// The part of it that came from the force along the body.
pub const BY_ALONG: Quantity = quantity("information_along_nat", ONE);
/// The part that came from the force across it.
pub const BY_ACROSS: Quantity = quantity("information_across_nat", ONE);
/// The part that came from the yaw moment.
pub const BY_TURNING: Quantity = quantity("information_turning_nat", ONE);
/// The part that came from torques.
pub const BY_TORQUE: Quantity = quantity("information_torque_nat", ONE);
/// The part that came from sinkages.
pub const BY_SINKAGE: Quantity = quantity("information_sinkage_nat", ONE);

/// A slope before a drive and after it.
pub struct PredictedSlope {
    before: SlopeBand,
    after: SlopeBand,
}

/// The columns of [`predictions`].
pub const PREDICTION_COLUMNS: [Column<PredictedSlope>; 9] = [
    SLOPE.given("Slope", |it| Some(it.after.slope)),
    YAW.maybe("Yaw that holds the contour, positive uphill: the median", |it| {
        it.after.yaw.map(|band| band.median).filter(|yaw| yaw.is_finite())
    }),
    YAW.band("The same over all samples; an end is missing where none does", |it| it.after.yaw),
    SLIP_RATIO.maybe("Slip ratio there: the median; 1 where no heading holds the contour", |it| {
        it.after.slip_ratio.map(|band| band.median)
    }),
    SLIP_RATIO.band("The same over all samples", |it| it.after.slip_ratio),
    PROBABILITY_LEVEL.probability(
        "Probability that a heading holds the contour: the share of the samples that have one",
        |it| Some(it.after.level),
    ),
    BEFORE_YAW.band("Yaw as it was predicted before the drive", |it| it.before.yaw),
    BEFORE_SLIP.band("Slip ratio as it was predicted before the drive", |it| it.before.slip_ratio),
    whole(DRAWS, "All samples", |it| Some(it.after.level.trials)),
];

/// A row for each slope.
///
/// * `before`: before the drive, on the same slopes
#[must_use]
pub fn predictions(before: &[SlopeBand], after: &[SlopeBand]) -> Table {
    let bands = before.iter().cloned().zip(after.iter().cloned());
    let rows: Vec<PredictedSlope> =
        bands.map(|(before, after)| PredictedSlope { before, after }).collect();
    Table::of(&PREDICTION_COLUMNS, &rows)
}

/// The columns of [`predictions`] for reading.
#[must_use]
pub fn brief() -> Vec<String> {
    let ends = |quantity: Quantity| {
        let [low, _, high] = quantity.quantiles();
        [low, high]
    };
    let name = |quantity: Quantity| quantity.name.to_owned();
    let [yaw, slip] = [ends(YAW), ends(SLIP_RATIO)];
    let [before_yaw, before_slip] = [ends(BEFORE_YAW), ends(BEFORE_SLIP)];
    [
        vec![name(SLOPE), name(YAW)],
        yaw.into(),
        before_yaw.into(),
        vec![name(SLIP_RATIO)],
        slip.into(),
        before_slip.into(),
    ]
    .concat()
}

/// The columns of [`lessons`].
pub const LESSON_COLUMNS: [Column<Lesson>; 12] = [
    TIME.number("End of the stretch", |it| it.stretch.time[1]),
    WAY.number("Way of the rims since the start", |it| it.way),
    SLOPE.maybe("Slope of the ground", |it| it.stretch.attitude.map(|it| it[0])),
    YAW.maybe("Yaw from the contour, positive uphill", |it| it.stretch.attitude.map(|it| it[1])),
    SLIP_RATIO.maybe("Mean slip ratio of the wheels, where a way was read", |it| it.slip_ratio),
    EXPECTED_SLIP.number("The same as it was expected before", |it| it.expected_slip),
    INFORMATION.number("How much it narrowed what is believed of the soil", |it| it.information),
    BY_ALONG.number("The part of it from the force along the body", |it| it.by_kind.along),
    BY_ACROSS.number("The part that the force across the body added", |it| it.by_kind.across),
    BY_TURNING.number("The part that the yaw moment added", |it| it.by_kind.turning),
    BY_TORQUE.number("The part that torques added", |it| it.by_kind.torque),
    BY_SINKAGE.number("The part that sinkages added", |it| it.by_kind.sinkage),
];

/// A row for each stretch that taught something.
#[must_use]
pub fn lessons(lessons: &[Lesson]) -> Table {
    Table::of(&LESSON_COLUMNS, lessons)
}

/// The columns of [`warnings`].
pub const WARNING_COLUMNS: [Column<Warning>; 6] = [
    text(WARNING, "What it is about", |it| Some(it.kind.name().to_owned())),
    TIME.number("When it was noticed", |it| it.time),
    WAY.number("Way of the rims until then", |it| it.way),
    LEAD_TIME.maybe("Time until it happens, if it is ahead", |it| it.lead_time),
    LEAD_WAY.maybe("Way over the ground until it happens, if it is ahead", |it| it.lead_way),
    text(EVIDENCE, "What was seen", |it| Some(sentence(&it.evidence))),
];

/// A row for each warning.
#[must_use]
pub fn warnings(warnings: &[Warning]) -> Table {
    Table::of(&WARNING_COLUMNS, warnings)
}

/// What was seen, in words and degrees.
#[must_use]
pub fn sentence(evidence: &Evidence) -> String {
    let degrees = |angle: f64| SLOPE.unit.from_si(angle);
    match evidence {
        Evidence::Strange { slip_ratio, expected, drift, expected_drift } => format!(
            "three or more stretches move as the soil learnt so far does not let them: now a slip \
             ratio of {slip_ratio:.2} where {expected:.2} was expected, and {:.0} mm to the left \
             for each metre of the wheels' way where {:.0} were",
            1e3 * drift,
            1e3 * expected_drift
        ),
        Evidence::Spinning { slip_ratio } => format!("the slip ratio is {slip_ratio:.2}"),
        Evidence::Growing { slip_ratio } => {
            format!("the slip ratio is {slip_ratio:.2}, and grows")
        }
        Evidence::Weakening { slip_ratio, loss, spare } => format!(
            "the ground grows weaker, by a pull of {:.1} % of the weight for each metre; on this \
             course it has {:.1} % to spare, and the slip ratio is {slip_ratio:.2}",
            100.0 * loss,
            100.0 * spare.max(0.0)
        ),
        Evidence::Rising { slip_ratio, slope, limit } => format!(
            "the ground rises, and on this course the soil holds the rover up to {:.1}° only; the \
             slope is {:.1}° now, the slip ratio {slip_ratio:.2}",
            degrees(*limit),
            degrees(*slope)
        ),
        Evidence::Contradiction { reported, by_attitude } => format!(
            "the yaw is {:.0}°, but {:.0}° by roll and pitch",
            degrees(*reported),
            degrees(*by_attitude)
        ),
        Evidence::Gross(fault) => gross_in_words(fault),
        Evidence::OneSided { what, deviations } => one_sided_in_words(*what, *deviations),
        Evidence::Outrun { slip_ratio } => format!(
            "odometry has the rover faster than its wheels turn, by a slip ratio of \
             {slip_ratio:.2}: its scale, or a wheel speed, is wrong"
        ),
        Evidence::Idle { wheel, share } => format!(
            "{wheel} has less than {:.0} % of the torque of the other wheels",
            100.0 * share
        ),
    }
}

/// Readings that stay on one side of what is expected, in words.
fn one_sided_in_words(what: OneSided, deviations: f64) -> String {
    let size = deviations.abs();
    let [above, below] = if deviations > 0.0 { ["above", "below"] } else { ["below", "above"] };
    let of_torques = |one: &str, other: &str, causes: &str| {
        format!(
            "torques of the wheels {one} stay {above} what the soil learnt so far expects, those \
             {other} {below} it, by {size:.1} standard deviations on the mean: {causes}"
        )
    };
    match what {
        OneSided::FrontTorques => of_torques(
            "in front",
            "in the rear",
            "their names may be exchanged, or the centre of mass, or the pitch, be another",
        ),
        OneSided::LeftTorques => of_torques(
            "on the left",
            "on the right",
            "their names may be exchanged, or the centre of mass, or the roll, be another",
        ),
        OneSided::Leftward => {
            let side = if deviations > 0.0 { "left" } else { "right" };
            format!(
                "the ways to the side stay farther to the {side} than the soil learnt so far \
                 expects, by {size:.1} standard deviations on the mean: their sign, the mounting of \
                 what measures them, or the roll may be another"
            )
        }
    }
}

/// What contradicts itself in what was learnt, a sentence each: gross faults of the telemetry,
/// readings that no soil explains, and numbers of the soil that are far off their priors.
#[must_use]
pub fn contradictions(learner: &Learner) -> Vec<String> {
    let of_soil = learner.contradictions();
    let gross = learner.gross_faults().iter().map(gross_in_words);
    let one_sided = learner.on_one_side().map(|(what, it)| one_sided_in_words(what, it));
    gross.chain(one_sided).chain(of_soil.iter().map(contradiction_in_words)).collect()
}

/// A number that is far off its prior, in words.
pub(crate) fn contradiction_in_words(it: &Contradiction) -> String {
    let side = if it.deviations > 0.0 { "above" } else { "below" };
    let size = it.deviations.abs();
    format!(
        "`{}` was learnt {size:.1} standard deviations {side} its prior: the prior, the rover's \
         document or the telemetry is wrong",
        it.key
    )
}

/// A gross fault in words.
#[must_use]
pub fn gross_in_words(fault: &GrossFault) -> String {
    let (what, beside) = match fault.suspect {
        Suspect::WheelOdometry => {
            return "wheel odometry: the way by odometry is that of the wheels, with no slip along \
                    and none across, whatever slope and torques are; it holds no information on \
                    slip, and is left out"
                .to_owned();
        }
        Suspect::Drift => {
            return "drift: the ways to the side go uphill across the slope, where wheels that are \
                    not steered drift downhill: they, or the roll, have another sign; ways are \
                    left out"
                .to_owned();
        }
        Suspect::LostWays => {
            return "lost-ways: ways do not grow with the time since the last one: rows or readings \
                    are lost with their ways, which would pass for slip; ways are left out"
                .to_owned();
        }
        Suspect::StillAttitude => {
            return "still-attitude: roll and pitch stay exactly the same while the ways scatter: no \
                    sensor measures them; they are left out"
                .to_owned();
        }
        Suspect::Torque => ("torques, or currents,", "what the rover's weight and slope need"),
        Suspect::Speed => ("ways by odometry", "those of the wheels"),
        Suspect::Attitude => ("roll and pitch", "what the wheels' torques and the ground allow"),
        Suspect::Turning => ("rotations by odometry", "the changes of yaw"),
        Suspect::Sinkage => ("sinkages", "what wheels of this radius have"),
    };
    let name = fault.suspect.name();
    let left_out = if fault.is_of_wheel_speeds() {
        "one of both is wrong, so that nothing that rests on either is used, and what was warned of \
         before may be wrong"
    } else {
        "they are left out"
    };
    if fault.factor < 0.0 {
        return format!("{name}: {what} have another sign than {beside}; {left_out}");
    }
    let times = number_of_times(fault.factor);
    let unit = fault.unit().map_or_else(String::new, |(factor, unit)| {
        format!(", as {unit} are: a factor of {}", number_of_times(factor))
    });
    format!("{name}: {what} are {times} times {beside}{unit}; {left_out}")
}

/// A factor, in three digits or as a share of one.
fn number_of_times(factor: f64) -> String {
    let digits = |it: f64| {
        let text = if it < 100.0 { format!("{it:.2}") } else { format!("{it:.0}") };
        let has_point = text.contains('.');
        let trimmed = text.trim_end_matches('0').trim_end_matches('.').to_owned();
        if has_point { trimmed } else { text }
    };
    if factor < 1.0 { format!("1/{}", digits(1.0 / factor)) } else { digits(factor) }
}
