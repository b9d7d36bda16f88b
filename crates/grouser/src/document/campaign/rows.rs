//! From drawn numbers to a row: the base with the numbers in their place, run, and put into words.

use super::super::Document;
use super::super::error::DocumentError;
use super::super::study::{OK, WheelRecord};
use super::super::text::Node;
use super::super::values::{Described, Misfit};
use super::sections::{Stand, Study};
use super::table::{Cell, Column, ColumnKind, Role};
use crate::contact::{Contact, SettleError, Slip, Theory, settle};
use crate::simulation::{Run, Scenario};
use crate::studies::attitude::{AttitudeStudy, NoAttitude};
use crate::studies::campaign::drive::Drive;
use crate::vehicle::DriveLaw;

/// What a campaign varies.
#[derive(Clone, Debug)]
pub(super) enum Base {
    Scenario(Box<Varied<Scenario>>),
    Stand(Box<Varied<Stand>>),
}

/// A value whose numbers are exchanged, and what its document says.
#[derive(Clone, Debug)]
pub(super) struct Varied<V> {
    value: V,
    document: Document,
}

impl<V: Described> Varied<V> {
    fn new(document: Document, tree: &Node) -> Result<Self, DocumentError> {
        let value = V::of(&document).settled().map_err(|misfit| misfit.of(tree))?;
        Ok(Self { value, document })
    }

    /// The number under a key.
    fn number(&self, key: &str) -> Option<f64> {
        self.document.number(key).filter(|_| self.value.has(key))
    }

    fn with(&self, keys: &[String], values: &[f64]) -> Result<V, Misfit> {
        self.value.with(keys.iter().map(String::as_str).zip(values.iter().copied()))
    }
}

/// A draw's domain value.
enum Case {
    Scenario(Box<Scenario>),
    WheelTest { contact: Box<Contact>, theory: Theory, load: f64 },
}

/// Why a row has no answer: a word that is the same for all such rows, and the reason of this one.
struct Failure {
    status: &'static str,
    reason: String,
}

/// Numbers that are fine one by one, but not together.
const UNFIT: &str = "not possible together";
/// There is no yaw that keeps a traverse level.
const NO_ATTITUDE: &str = "no level attitude";
/// Not even on level ground.
const CANNOT_MOVE: &str = "cannot move";
/// The soil carries less than the load.
const SUNK: &str = "soil cannot carry the load";
/// The solver gave up.
const NOT_COMPUTED: &str = "not computed";

/// All statuses of a row; `ok` first.
pub const STATUSES: [&str; 6] = [OK, UNFIT, NO_ATTITUDE, CANNOT_MOVE, SUNK, NOT_COMPUTED];

/// Statuses of rows that could not be computed: all others are answers, or findings.
pub const FAILED: [&str; 2] = [UNFIT, NOT_COMPUTED];

const ATTITUDE: [&str; 7] = [
    "yaw_deg",
    "slip_ratio",
    "sinkage_mm",
    "torque_nm",
    "power_w",
    "energy_j_per_m",
    "yaw_moment_nm",
];

const TRAVERSE: [&str; 11] = [
    "time_s",
    "x_m",
    "y_m",
    "yaw_deg",
    "distance_m",
    "drift_m_per_m",
    "slip_ratio",
    "sinkage_mm",
    "power_w",
    "energy_j",
    "energy_j_per_m",
];

const WHEEL_TEST: [&str; 15] = [
    "sinkage_mm",
    "entry_angle_deg",
    "exit_angle_deg",
    "max_stress_angle_deg",
    "drawbar_pull_n",
    "side_force_n",
    "side_force_from_shear_n",
    "bulldozing_load_n",
    "normal_force_n",
    "torque_nm",
    "overturning_moment_nm",
    "aligning_moment_nm",
    "thrust_n",
    "motion_resistance_n",
    "max_normal_stress_kpa",
];

/// The columns of a study.
///
/// * `keys`: what is drawn
pub(super) fn columns(study: Study, sensitivity: bool, keys: &[String]) -> Vec<Column> {
    let mut all = vec![Column::new("run", ColumnKind::Whole, Role::Index)];
    if sensitivity {
        all.push(Column::new("point", ColumnKind::Whole, Role::Index));
        all.push(Column::new("matrix", ColumnKind::Text, Role::Index));
    }
    all.extend(keys.iter().map(|key| Column::new(key, ColumnKind::Float, Role::Input)));
    let words: &[&str] = match study {
        Study::Traverse => &["status", "reason", "outcome", "simulation"],
        Study::Attitude | Study::WheelTest => &["status", "reason"],
    };
    all.extend(words.iter().map(|word| Column::new(*word, ColumnKind::Text, Role::Status)));
    let results: &[&str] = match study {
        Study::Traverse => &TRAVERSE,
        Study::Attitude => &ATTITUDE,
        Study::WheelTest => &WHEEL_TEST,
    };
    all.extend(results.iter().map(|word| Column::new(*word, ColumnKind::Float, Role::Result)));
    all
}

/// Runs the base with drawn values, and adds what comes of it to the row: at least the status.
pub(super) fn run(study: Study, base: &Base, keys: &[String], values: &[f64], row: &mut Vec<Cell>) {
    let answer = base.with(keys, values).and_then(|case| match (study, case) {
        (Study::Attitude, Case::Scenario(scenario)) => attitude(&scenario),
        (_, Case::Scenario(scenario)) => traverse(&scenario),
        (_, Case::WheelTest { contact, theory, load }) => wheel_test(&contact, theory, load),
    });
    match answer {
        Ok(cells) => {
            row.push(Cell::text(OK));
            row.extend(cells);
        }
        Err(Failure { status, reason }) => row.extend([Cell::text(status), Cell::text(reason)]),
    }
}

impl Base {
    /// * `tree`: where the scenario was written
    pub(super) fn scenario(document: Document, tree: &Node) -> Result<Self, DocumentError> {
        Ok(Self::Scenario(Box::new(Varied::new(document, tree)?)))
    }

    /// * `campaign`: with the stand
    /// * `tree`: where the stand was written
    pub(super) fn stand(campaign: &Document, tree: &Node) -> Result<Self, DocumentError> {
        let document = campaign.table("wheel_test");
        Ok(Self::Stand(Box::new(Varied::new(document, tree)?)))
    }

    /// What it says.
    pub(super) fn document(&self) -> &Document {
        match self {
            Self::Scenario(varied) => &varied.document,
            Self::Stand(varied) => &varied.document,
        }
    }

    /// The number under a key.
    pub(super) fn number(&self, key: &str) -> Option<f64> {
        match self {
            Self::Scenario(varied) => varied.number(key),
            Self::Stand(varied) => varied.number(key),
        }
    }

    /// That it means something with other values of some keys.
    pub(super) fn check_with(&self, keys: &[String], values: &[f64]) -> Result<(), Misfit> {
        self.case_of(keys, values).map(drop)
    }

    fn with(&self, keys: &[String], values: &[f64]) -> Result<Case, Failure> {
        self.case_of(keys, values)
            .map_err(|misfit| Failure { status: UNFIT, reason: misfit.problem.to_string() })
    }

    fn case_of(&self, keys: &[String], values: &[f64]) -> Result<Case, Misfit> {
        Ok(match self {
            Self::Scenario(varied) => Case::Scenario(Box::new(varied.with(keys, values)?)),
            Self::Stand(varied) => {
                let stand = varied.with(keys, values)?;
                let contact = Contact {
                    wheel: stand.wheel,
                    soil: stand.soil,
                    slip: Slip::on_test_stand(stand.slip_ratio, stand.slip_angle),
                    gravity: stand.gravity,
                };
                let (theory, load) = (stand.theory, stand.load);
                Case::WheelTest { contact: Box::new(contact), theory, load }
            }
        })
    }
}

fn attitude(scenario: &Scenario) -> Result<Vec<Cell>, Failure> {
    let attitude = AttitudeStudy::of(scenario)
        .on_slope(scenario.site.terrain.slope)
        .map_err(|error| Failure { status: UNFIT, reason: error.to_string() })?
        .map_err(|error| {
            let status = match error {
                NoAttitude::CannotMove(_) => CANNOT_MOVE,
                NoAttitude::TooSteep { .. } => NO_ATTITUDE,
            };
            Failure { status, reason: error.to_string() }
        })?;
    let power = match scenario.drive {
        DriveLaw::Constant(speed) => Some(attitude.power(&scenario.rover, speed)),
        _ => None,
    };
    let floats = [
        Some(attitude.yaw.to_degrees()),
        Some(attitude.slip_ratio),
        Some(attitude.mean_sinkage() * 1e3),
        Some(attitude.torque()),
        power,
        Some(attitude.energy_per_metre(&scenario.rover)),
        Some(attitude.yaw_moment),
    ];
    Ok(std::iter::once(Cell::Text(None)).chain(floats.map(Cell::Float)).collect())
}

fn traverse(scenario: &Scenario) -> Result<Vec<Cell>, Failure> {
    let run = Run::new(scenario)
        .and_then(Run::to_end)
        .map_err(|error| Failure { status: NOT_COMPUTED, reason: error.to_string() })?;
    let (end, drive) = (run.last(), Drive::of(&run));
    let words = [
        Cell::Text(run.outcome.reason()),
        Cell::text(run.outcome.name()),
        Cell::text(run.method.name()),
    ];
    let floats = [
        Some(end.time),
        Some(end.state.position.x),
        Some(end.state.position.y),
        Some(end.state.yaw.to_degrees()),
        Some(drive.distance),
        drive.drift,
        drive.slip_ratio,
        drive.sinkage.map(|sinkage| sinkage * 1e3),
        drive.power,
        Some(drive.energy),
        drive.energy_per_metre,
    ];
    Ok(words.into_iter().chain(floats.map(Cell::Float)).collect())
}

fn wheel_test(contact: &Contact, theory: Theory, load: f64) -> Result<Vec<Cell>, Failure> {
    let settled = settle(theory.model(), contact, load).map_err(|error| {
        let status = match error {
            SettleError::SunkToAxle { .. } => SUNK,
            SettleError::BadLoad { .. } => UNFIT,
        };
        Failure { status, reason: error.to_string() }
    })?;
    let wheel = WheelRecord::new(&settled);
    let floats = [
        wheel.sinkage_mm,
        wheel.entry_angle_deg,
        wheel.exit_angle_deg,
        wheel.max_stress_angle_deg,
        wheel.drawbar_pull_n,
        wheel.side_force_n,
        wheel.side_force_from_shear_n,
        wheel.bulldozing_load_n,
        wheel.normal_force_n,
        wheel.torque_nm,
        wheel.overturning_moment_nm,
        wheel.aligning_moment_nm,
        wheel.thrust_n,
        wheel.motion_resistance_n,
        wheel.max_normal_stress_kpa,
    ];
    Ok(std::iter::once(Cell::Text(None)).chain(floats.map(Cell::Float)).collect())
}
