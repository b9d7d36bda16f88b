//! Results of [routes](crate::studies::route) as they leave the library, with units in their names.

mod opening;

use serde::{Serialize, Serializer};

use self::opening::{opening, worst_of};
use super::columns::completion::RISK;
use super::columns::map::PROBABILITY_NO_GO;
use super::columns::route::{ALONG, COMMONEST_END, PROFILE};
use super::columns::verdict::{ADVICE, ADVICE_OBJECT};
use super::columns::{COURSE, Column, SLOPE, X, Y, YAW};
use super::table::{Table, WithObject};
use crate::studies::route::{
    Answer, Arrival, CheckedLine, Danger, DrivenRoute, Hazard, JudgedLeg, Limits, Line, Objective,
    Route, RouteRisk,
};
use crate::studies::verdict::Advice;

/// A way, as it leaves; without a way there is a reason instead of numbers.
#[derive(Clone, Debug, Default, Serialize)]
pub struct RouteRecord {
    /// How probably it is completed, where it ends otherwise, and the worst verdict of its legs, in
    /// sentences.
    pub sentence: String,
    /// What it has least of; none of a line that was given.
    pub minimise: Option<&'static str>,
    /// `found` or `no-safe-route`; of a line that was given `safe` or `not-safe`, and of a way that
    /// has a leg with the verdict no-go all the same.
    pub status: &'static str,
    /// How probably it is completed, and how it ends otherwise.
    #[serde(flatten)]
    pub risk: RiskOfWay,
    /// The worst verdict of its legs.
    pub verdict: Option<&'static str>,
    /// The leg that has it, from 1.
    pub verdict_leg: Option<usize>,
    /// Why there is none, or why it is not safe.
    pub reason: Option<String>,
    /// Length over the ground.
    pub length_m: Option<f64>,
    /// Time, with turns.
    pub time_s: Option<f64>,
    /// Work of the wheels, with turns.
    pub energy_j: Option<f64>,
    /// What motors and electronics draw, with turns; none where no motor is known.
    pub battery_energy_j: Option<f64>,
    /// Angle of all turns together.
    pub turned_deg: Option<f64>,
    /// Mean slip ratio over the way.
    pub mean_slip_ratio: Option<f64>,
    /// The largest.
    pub most_slip_ratio: Option<f64>,
    /// The steepest slope.
    pub most_slope_deg: Option<f64>,
    /// In which share of the samples some place of the way is a no-go.
    pub probability_no_go: Option<f64>,
    /// x and y of the places where it turns, with the first and the last.
    pub waypoints: Vec<[f64; 2]>,
    /// What it takes up to each of them.
    pub arrivals: Vec<ArrivalRecord>,
    /// What to do on each leg between them.
    pub legs: AdvisedLegs,
    /// What is met along it, piece by piece.
    pub profile: Table,
    /// Where a line that was given is not safe.
    pub hazards: Vec<HazardRecord>,
    /// What simulation makes of it, if it was driven.
    pub simulated: Option<SimulatedRecord>,
}

/// How probably a way is completed, and how it ends otherwise, as entries of an object of JSON.
#[derive(Clone, Debug)]
pub struct RiskOfWay(Table);

impl RiskOfWay {
    fn of(risk: Option<&RouteRisk>) -> Self {
        let completion = [risk.map(|it| &it.completion)];
        Self(Table::default().and(&RISK, &completion).and(&COMMONEST_END, &[risk]))
    }
}

impl Default for RiskOfWay {
    fn default() -> Self {
        Self::of(None)
    }
}

impl Serialize for RiskOfWay {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.row(0).serialize(serializer)
    }
}

/// The legs of a way, with advice for the worst place of each. As JSON they are rows, each with an
/// object `advice`.
#[derive(Clone, Debug, Default)]
pub struct AdvisedLegs {
    /// A row for each leg.
    pub rows: Table,
    /// What to do on it.
    pub advice: Table,
}

impl AdvisedLegs {
    /// * `all`: for each leg, if its ground is known
    #[must_use]
    pub fn of(all: &[Option<JudgedLeg>]) -> Self {
        let legs: Vec<Option<&JudgedLeg>> = all.iter().map(Option::as_ref).collect();
        let advice: Vec<Option<&Advice>> =
            all.iter().map(|leg| leg.as_ref().map(|leg| &leg.advice)).collect();
        let rows = Table::default().and(&LEG, &legs);
        Self { rows, advice: Table::default().and(&ADVICE, &advice) }
    }
}

impl Serialize for AdvisedLegs {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { rows, advice } = self;
        WithObject { rows, name: ADVICE_OBJECT, of: advice }.serialize(serializer)
    }
}

/// The worst place of a leg.
const LEG: [Column<JudgedLeg>; 6] = [
    SLOPE.given("Slope at the worst place, up to a whole degree", |it| Some(it.advice.slope)),
    COURSE.given(
        "Course there, from the contour, positive uphill; missing where the worst of the leg is the \
         turn on the spot before it",
        |it| (!it.advice.is_of_turn()).then_some(it.advice.course),
    ),
    ALONG.number("Length on the map from the start of the way to that place", |it| {
        it.place.along[0]
    }),
    X.number("x of that place", |it| it.place.place.x),
    Y.number("y of that place", |it| it.place.place.y),
    PROBABILITY_NO_GO.number("Share of the samples in which that place is a no-go", |it| {
        it.place.probability_no_go
    }),
];

/// What a way takes up to a waypoint, before it turns there.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ArrivalRecord {
    /// Length over the ground.
    pub length_m: f64,
    /// Time, with turns.
    pub time_s: f64,
    /// Work of the wheels, with turns.
    pub energy_j: f64,
}

/// A stretch of a line that is not safe.
#[derive(Clone, Debug, Serialize)]
pub struct HazardRecord {
    /// One word, such as `too-steep`.
    pub danger: &'static str,
    /// Where it begins, as length on the map from the start of the line.
    pub from_m: f64,
    /// Where it ends.
    pub to_m: f64,
    /// x where it begins.
    pub x_m: f64,
    /// y where it begins.
    pub y_m: f64,
    /// The steepest slope of the stretch, if that is what is wrong.
    pub most_slope_deg: Option<f64>,
    /// Its largest slip ratio, if that is what is wrong.
    pub most_slip_ratio: Option<f64>,
    /// The largest share of the samples in which it is a no-go, if that is what is wrong.
    pub most_no_go: Option<f64>,
    /// All of it as a sentence.
    pub sentence: String,
}

/// What simulation makes of a way.
#[derive(Clone, Debug, Serialize)]
pub struct SimulatedRecord {
    /// One word: `completed`, or what ended it.
    pub outcome: &'static str,
    /// How many of the legs between waypoints were completed.
    pub legs: usize,
    /// Length over the ground.
    pub length_m: f64,
    /// Time, with turns.
    pub time_s: f64,
    /// Work of the wheels, with turns.
    pub energy_j: f64,
    /// What motors and electronics took, with turns; none where no motor is known.
    pub battery_energy_j: Option<f64>,
    /// Slip ratio over all legs.
    pub slip_ratio: Option<f64>,
    /// How far from the target it ended.
    pub miss_m: f64,
    /// How far the predicted time is from it, over it.
    pub time_error: f64,
    /// How far the predicted work is from it, over it.
    pub energy_error: f64,
}

impl RouteRecord {
    /// What came of seeking a way.
    ///
    /// * `driven`: what simulation makes of it, if it was driven
    /// * `legs`: what to do on each
    #[must_use]
    pub fn of(
        objective: Objective,
        answer: &Answer,
        driven: Option<&DrivenRoute>,
        legs: &[Option<JudgedLeg>],
    ) -> Self {
        let minimise = objective.name();
        match answer {
            Answer::Route(route) => {
                let hazards: Vec<HazardRecord> =
                    legs.iter().flatten().filter_map(HazardRecord::of_leg).collect();
                Self {
                    minimise: Some(minimise),
                    status: if hazards.is_empty() { "found" } else { NOT_SAFE },
                    reason: reason_of(&hazards),
                    hazards,
                    ..Self::of_route(route, driven).judged(route, legs)
                }
            }
            Answer::NoSafeRoute(reason) => Self {
                sentence: format!("No safe route: {reason}."),
                minimise: Some(minimise),
                status: "no-safe-route",
                reason: Some(reason.to_string()),
                ..Self::default()
            },
        }
    }

    /// What came of looking along a line.
    ///
    /// * `driven`: what simulation makes of it, if it was driven
    /// * `legs`: what to do on each
    #[must_use]
    pub fn of_line(
        line: &Line,
        found: &CheckedLine,
        limits: &Limits,
        driven: Option<&DrivenRoute>,
        legs: &[Option<JudgedLeg>],
    ) -> Self {
        let record =
            found.route.as_ref().map_or_else(Self::default, |it| Self::of_route(it, driven));
        // A verdict on a place that is not safe anyway says nothing new.
        let is_named = |leg: &JudgedLeg| {
            let begin = leg.place.along[0];
            found.hazards.iter().any(|it| (it.along[0]..it.along[1]).contains(&begin))
        };
        let of_legs = legs.iter().flatten().filter(|leg| !is_named(leg));
        let mut hazards: Vec<HazardRecord> =
            found.hazards.iter().map(|hazard| HazardRecord::of(hazard, limits)).collect();
        hazards.extend(of_legs.filter_map(HazardRecord::of_leg));
        hazards.sort_by(|one, other| one.from_m.total_cmp(&other.from_m));
        Self {
            status: if hazards.is_empty() { "safe" } else { NOT_SAFE },
            reason: reason_of(&hazards),
            waypoints: line.places().iter().map(|it| [it.x, it.y]).collect(),
            hazards,
            ..record.judged(&found.seen, legs)
        }
    }

    /// The same with what is known of all ground that was looked at, and the verdicts on its legs.
    fn judged(self, seen: &Route, legs: &[Option<JudgedLeg>]) -> Self {
        let worst = worst_of(legs);
        Self {
            sentence: opening(seen, legs),
            risk: RiskOfWay::of(seen.risk.as_ref()),
            verdict: worst.map(|(_, leg)| leg.verdict().name()),
            verdict_leg: worst.map(|(number, _)| number),
            legs: AdvisedLegs::of(legs),
            profile: Table::of(&PROFILE, &seen.profile),
            ..self
        }
    }

    fn of_route(route: &Route, driven: Option<&DrivenRoute>) -> Self {
        Self {
            status: "found",
            length_m: Some(route.length),
            time_s: Some(route.time),
            energy_j: Some(route.energy),
            battery_energy_j: route.drawn,
            turned_deg: Some(YAW.unit.from_si(route.turned)),
            mean_slip_ratio: Some(route.mean_slip_ratio),
            most_slip_ratio: Some(route.most_slip_ratio),
            most_slope_deg: Some(SLOPE.unit.from_si(route.most_slope)),
            probability_no_go: Some(route.probability_no_go),
            waypoints: route.waypoints.iter().map(|it| [it.x, it.y]).collect(),
            arrivals: route.arrivals.iter().map(ArrivalRecord::of).collect(),
            simulated: driven.map(|driven| SimulatedRecord::of(route, driven)),
            ..Self::default()
        }
    }
}

impl ArrivalRecord {
    fn of(arrival: &Arrival) -> Self {
        Self { length_m: arrival.length, time_s: arrival.time, energy_j: arrival.energy }
    }
}

/// The status of a way that is not safe.
const NOT_SAFE: &str = "not-safe";

/// Why a way is not safe.
fn reason_of(hazards: &[HazardRecord]) -> Option<String> {
    hazards.first().map(|first| match hazards.len() {
        1 => first.sentence.clone(),
        2 => format!("{}; another stretch is not safe", first.sentence),
        count => format!("{}; {} more stretches are not safe", first.sentence, count - 1),
    })
}

impl HazardRecord {
    /// What is not safe about a leg.
    fn of_leg(leg: &JudgedLeg) -> Option<Self> {
        // Its verdict has limits of its own.
        let limits = Limits { most_slope: 0.0, most_slip_ratio: 0.0, most_no_go: 0.0 };
        leg.hazard().map(|hazard| Self::of(&hazard, &limits))
    }

    fn of(hazard: &Hazard, limits: &Limits) -> Self {
        let Hazard { danger, along: [from, to], place, worst } = *hazard;
        let only = |of: Danger| worst.filter(|_| danger == of);
        let mut record = Self {
            danger: danger.name(),
            from_m: from,
            to_m: to,
            x_m: place.x,
            y_m: place.y,
            most_slope_deg: only(Danger::TooSteep).map(|slope| SLOPE.unit.from_si(slope)),
            most_slip_ratio: only(Danger::TooMuchSlip),
            most_no_go: only(Danger::NoGo),
            sentence: String::new(),
        };
        record.sentence = format!(
            "from {from:.2} to {to:.2} m along the line, at x {:.2} m, y {:.2} m, {}",
            place.x,
            place.y,
            record.why(danger, limits)
        );
        record
    }

    /// What is wrong there.
    fn why(&self, danger: Danger, limits: &Limits) -> String {
        let number = |number: Option<f64>| number.unwrap_or(f64::NAN);
        match danger {
            Danger::UnknownGround => {
                "the ground is not known all around: beyond the map, at its edge, or beside a \
                 place without a height"
                    .to_owned()
            }
            Danger::KeptOut => "it leads where nobody may go".to_owned(),
            Danger::NoHeading => "no heading holds the course".to_owned(),
            Danger::TooSteep => format!(
                "the slope is up to {:.1}°, and at most {:.1}° are allowed",
                number(self.most_slope_deg),
                SLOPE.unit.from_si(limits.most_slope)
            ),
            Danger::TooMuchSlip => format!(
                "the slip ratio is up to {:.3}, and at most {:.3} is allowed",
                number(self.most_slip_ratio),
                limits.most_slip_ratio
            ),
            Danger::NoGo => format!(
                "it is a no-go in up to {:.0} % of the samples, and less than {:.0} % are allowed",
                100.0 * number(self.most_no_go),
                100.0 * limits.most_no_go
            ),
            Danger::Verdict(why) => format!("the verdict is no-go: {}", why.meaning()),
            Danger::TurnVerdict(why) => {
                format!("it turns on the spot, and the verdict on that is no-go: {}", why.meaning())
            }
            Danger::NoTurn => "the line turns, and the rover cannot turn on the spot".to_owned(),
        }
    }
}

impl SimulatedRecord {
    fn of(route: &Route, driven: &DrivenRoute) -> Self {
        let error = |predicted: f64, simulated: f64| {
            if predicted == simulated { 0.0 } else { predicted / simulated - 1.0 }
        };
        Self {
            outcome: driven.outcome,
            legs: driven.legs,
            length_m: driven.distance,
            time_s: driven.time,
            energy_j: driven.energy,
            battery_energy_j: driven.drawn,
            slip_ratio: driven.slip_ratio,
            miss_m: driven.miss,
            time_error: error(route.time, driven.time),
            energy_error: error(route.energy, driven.energy),
        }
    }
}
