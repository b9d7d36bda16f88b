//! The rows of a campaign: the base with sampled numbers in their place, run, and its results as
//! cells.

use super::super::columns::flags::{FLAGS, names as names_of};
use super::super::columns::heading::{Held, held};
use super::super::columns::mission::{OUTCOME, kept, kept_of_leg};
use super::super::columns::run::{DRIVE, ELECTRICAL_DRIVE, END, standing};
use super::super::columns::wheel::WHEEL;
use super::super::columns::{
    self, DRAWBAR_PULL, MODEL, OK, SIDE_FORCE, SINKAGE, SLIP_RATIO, TORQUE,
};
use super::super::error::{DocumentError, Problem};
use super::super::given_file::NamedFiles;
use super::super::table::{BETWEEN_NAMES, Cell, ColumnKind};
use super::super::varied::{Key, Numbers, Varied};
use super::super::{Document, Misfit, Node, Plan, map_of};
use super::table::{Column, Role};
use crate::contact::validity::{Finding, Situation};
use crate::contact::{Contact, Model, SettleError, Slip, settle};
use crate::mission::MissionError;
use crate::simulation::{Run, Scenario, Trajectory};
use crate::studies::drive::Drive;
use crate::studies::heading::{HeadingStudy, NoHeading};
use crate::studies::mission::{DrivenLeg, DrivenMission};
use crate::studies::validity::RoverOnSlope;
use crate::studies::wheel_test_band::Sunk;
use crate::vehicle::DriveLaw;
use grouser_io::campaign::{Stand, Study};

/// The base that a campaign varies.
#[derive(Clone, Debug)]
pub(super) enum Base {
    Scenario(Box<Varied<Scenario>>),
    Mission(Box<Varied<Plan>>),
    Stand(Box<Varied<Stand>>),
}

/// What a run of the campaign has instead of the base's.
pub(super) struct Case<'a> {
    /// Keys with values of their own, and those values.
    pub keys: &'a [Key],
    pub values: &'a [f64],
    /// The model, where it is not the base's.
    pub model: Option<Model>,
    /// The campaign's seed.
    pub seed: u64,
    /// Which realisation of what scatters it has.
    pub bed: u64,
}

/// The domain value of a sample.
enum Sampled {
    Scenario(Box<Scenario>),
    Mission(Box<Plan>),
    WheelTest { contact: Box<Contact>, model: Model, load: f64 },
}

/// A run without a result: a status that is the same for all such rows, and the reason of this one.
struct Failure {
    status: &'static str,
    reason: String,
}

/// Numbers that are valid one by one, but not together.
const UNFIT: &str = "not possible together";
/// No heading holds the contour. (The text of version 0.1, by which results are counted.)
const NO_HEADING: &str = "no level attitude";
/// Not even on level ground.
const CANNOT_MOVE: &str = "cannot move";
/// The slope is steeper than the ground stands by its own strength.
const GROUND_STRENGTH: &str = "ground-strength";
/// The soil carries less than the load.
const SUNK: &str = "soil cannot carry the load";
/// The solver gave up.
const NOT_COMPUTED: &str = "not computed";

/// All statuses of a row; `ok` first.
pub const STATUSES: [&str; 7] =
    [OK, UNFIT, NO_HEADING, CANNOT_MOVE, GROUND_STRENGTH, SUNK, NOT_COMPUTED];

/// Statuses of rows that could not be computed: all others are answers, or findings.
pub const FAILED: [&str; 2] = [UNFIT, NOT_COMPUTED];

/// The columns of a study.
///
/// * `keys`: of the inputs
/// * `has_models`: whether the model is one of them
pub(super) fn columns(
    study: Study,
    base: &Base,
    sensitivity: bool,
    keys: &[Key],
    has_models: bool,
) -> Vec<Column> {
    let mut all = vec![Column::new("run", ColumnKind::Whole, Role::Index)];
    if sensitivity {
        all.push(Column::new("point", ColumnKind::Whole, Role::Index));
        all.push(Column::new("matrix", ColumnKind::Text, Role::Index));
    }
    all.extend(keys.iter().map(|key| Column::new(&*key.path, ColumnKind::Float, Role::Input)));
    all.extend(has_models.then(|| Column::new(MODEL, ColumnKind::Text, Role::Input)));
    let words: &[&str] = match study {
        Study::Traverse | Study::Mission => &["status", "reason", OUTCOME, "simulation"],
        Study::Heading | Study::WheelTest => &["status", "reason"],
    };
    all.extend(words.iter().map(|word| Column::new(*word, ColumnKind::Text, Role::Status)));
    let has_motors = base.has_motors();
    let names: Vec<&str> = match study {
        Study::Traverse => {
            let electrical = names(&ELECTRICAL_DRIVE).filter(|_| has_motors);
            names(END).chain(base.standing()).chain(names(&DRIVE)).chain(electrical).collect()
        }
        Study::Heading => names(&held()).collect(),
        Study::Mission => {
            let kept = kept(has_motors).map(|column| column.name);
            names(END).chain(base.standing()).chain(kept).collect()
        }
        Study::WheelTest => names(&WHEEL).collect(),
    };
    all.extend(names.iter().map(|name| Column::new(*name, ColumnKind::Float, Role::Result)));
    all.extend((1..=base.legs()).flat_map(|number| columns_of_leg(number, has_motors)));
    all.push(Column::new(FLAGS, ColumnKind::Text, Role::Status));
    all
}

/// The columns of a leg: `leg_2.outcome`.
///
/// * `number`: counted from 1
fn columns_of_leg(number: usize, has_motors: bool) -> impl Iterator<Item = Column> {
    kept_of_leg(has_motors).map(move |column| {
        let role = if column.kind() == ColumnKind::Text { Role::Status } else { Role::Result };
        Column::new(format!("{LEG}{number}.{}", column.name), column.kind(), role)
    })
}

/// What the columns of a leg begin with.
const LEG: &str = "leg_";
/// The outcome of a leg before which the mission ended.
const NOT_BEGUN: &str = "not_begun";

/// Whether a column has words about a leg: what became of it, or what stopped it.
pub(super) fn is_word_of_leg(column: &Column) -> bool {
    column.role == Role::Status && column.name.starts_with(LEG)
}

fn names<R>(results: &[columns::Column<R>]) -> impl Iterator<Item = &'static str> {
    results.iter().map(|column| column.name)
}

/// Runs the base with what a run has of its own, and adds the results to the row: at least the
/// status.
pub(super) fn run(study: Study, base: &Base, case: &Case<'_>, row: &mut Vec<Cell>) {
    let sampled = base.with(case.keys, case.values).map(|sampled| sampled.of(case));
    let answer = sampled.and_then(|sampled| match (study, sampled) {
        (Study::Heading, Sampled::Scenario(scenario)) => heading(&scenario),
        (_, Sampled::Scenario(scenario)) => traverse(&scenario),
        (_, Sampled::Mission(plan)) => mission(&plan),
        (_, Sampled::WheelTest { contact, model, load }) => wheel_test(&contact, &model, load),
    });
    match answer {
        Ok(cells) => {
            row.push(Cell::text(OK));
            row.extend(cells);
        }
        Err(Failure { status, reason }) => row.extend([Cell::text(status), Cell::text(reason)]),
    }
}

/// What a quantity of a run without an answer counts as in statistics, in the column's unit: values
/// on the safe side, as in bands ([`heading_band`](crate::studies::heading_band),
/// [`wheel_test_band`](crate::studies::wheel_test_band)). Nothing for what could not be computed,
/// and for what has no such value: a yaw, or work and power.
pub(super) fn counted(
    base: &Base,
    keys: &[Key],
    values: &[f64],
    status: &str,
    quantity: &str,
) -> Option<f64> {
    let case = match status {
        NO_HEADING | CANNOT_MOVE | SUNK => base.with(keys, values).ok()?,
        _ => return None,
    };
    match case {
        Sampled::Scenario(scenario) => match quantity {
            name if name == SLIP_RATIO.name => Some(1.0),
            name if name == SINKAGE.name => {
                Some(SINKAGE.unit.from_si(scenario.rover.mean_axle_height()))
            }
            _ => None,
        },
        // A rover that gets stuck is an answer of a mission.
        Sampled::Mission(_) => None,
        Sampled::WheelTest { contact, model, load } => {
            let sunk = Sunk::of(&model, &contact, load);
            let quantities = [
                (SINKAGE, sunk.sinkage),
                (DRAWBAR_PULL, sunk.drawbar_pull),
                (SIDE_FORCE, sunk.side_force),
                (TORQUE, sunk.torque),
            ];
            let (found, value) = quantities.into_iter().find(|(it, _)| it.name == quantity)?;
            Some(found.unit.from_si(value))
        }
    }
}

impl Sampled {
    /// The same in the model and the realisation of a run.
    fn of(mut self, case: &Case<'_>) -> Self {
        let of_case = |scenario: &mut Scenario| {
            if let Some(model) = &case.model {
                scenario.model = model.clone();
            }
            scenario.scatter = scenario.scatter.of_case(case.seed, case.bed);
        };
        match &mut self {
            Self::Scenario(scenario) => of_case(scenario),
            Self::Mission(plan) => of_case(&mut plan.scenario),
            Self::WheelTest { model, .. } => {
                if let Some(drawn) = &case.model {
                    *model = drawn.clone();
                }
            }
        }
        self
    }
}

impl Base {
    /// * `tree`: where the scenario was written
    pub(super) fn scenario(document: Document, tree: &Node) -> Result<Self, DocumentError> {
        Ok(Self::Scenario(Box::new(Varied::new(document, tree)?)))
    }

    /// * `tree`: where the mission was written
    pub(super) fn mission(document: Document, tree: &Node) -> Result<Self, DocumentError> {
        let varied = Varied::<Plan>::new(document, tree)?;
        let is_one = varied.value.missions().iter().all(|(name, _)| name.is_empty());
        if !is_one {
            let problem = Problem::Conflict("a campaign drives one way, without alternatives");
            return Err(DocumentError::at(tree.origin_of("alternative"), problem)
                .with_hint("give the mission the legs of one of them, as [[leg]]".to_owned()));
        }
        Ok(Self::Mission(Box::new(varied)))
    }

    /// * `campaign`: with the stand
    /// * `tree`: where the stand was written
    pub(super) fn stand(campaign: &Document, tree: &Node) -> Result<Self, DocumentError> {
        let document = campaign.table("wheel_test");
        Ok(Self::Stand(Box::new(Varied::new(document, tree)?)))
    }

    /// What there is to say of files that it names.
    pub(super) fn files(&self) -> &NamedFiles {
        match self {
            Self::Scenario(varied) => &varied.files,
            Self::Mission(varied) => &varied.files,
            Self::Stand(varied) => &varied.files,
        }
    }

    /// Whether it drives on a map that no file has: other processes cannot read it.
    pub(super) fn has_map_in_memory(&self) -> bool {
        let map = match self {
            Self::Scenario(varied) => map_of(&varied.value, &varied.document),
            Self::Mission(varied) => map_of(&varied.value.scenario, &varied.document),
            Self::Stand(_) => None,
        };
        map.is_some_and(|map| map.options.is_none())
    }

    /// Whether runs differ by more than their numbers.
    pub(super) fn scatters(&self) -> bool {
        match self {
            Self::Scenario(varied) => varied.value.scatter.is_any(),
            Self::Mission(varied) => varied.value.scenario.scatter.is_any(),
            Self::Stand(_) => false,
        }
    }

    /// Whether its rover's motors are known.
    fn has_motors(&self) -> bool {
        match self {
            Self::Scenario(varied) => varied.value.rover.has_motors(),
            Self::Mission(varied) => varied.value.scenario.rover.has_motors(),
            Self::Stand(_) => false,
        }
    }

    /// Names of the columns of how its rover stands at the end; none on a plane.
    fn standing(&self) -> impl Iterator<Item = &'static str> + use<> {
        let scenario = match self {
            Self::Scenario(varied) => Some(&varied.value),
            Self::Mission(varied) => Some(&varied.value.scenario),
            Self::Stand(_) => None,
        };
        scenario.map(standing).into_iter().flatten().map(|column| column.name)
    }

    /// How many legs its mission has; none for what is no mission.
    pub(super) fn legs(&self) -> usize {
        match self {
            Self::Mission(varied) => varied.value.mission().legs.len(),
            Self::Scenario(_) | Self::Stand(_) => 0,
        }
    }

    /// What can be varied.
    pub(super) fn numbers(&self) -> &dyn Numbers {
        match self {
            Self::Scenario(varied) => &**varied,
            Self::Mission(varied) => &**varied,
            Self::Stand(varied) => &**varied,
        }
    }

    fn with(&self, keys: &[Key], values: &[f64]) -> Result<Sampled, Failure> {
        self.case_of(keys, values)
            .map_err(|misfit| Failure { status: UNFIT, reason: misfit.problem.to_string() })
    }

    fn case_of(&self, keys: &[Key], values: &[f64]) -> Result<Sampled, Misfit> {
        Ok(match self {
            Self::Scenario(varied) => Sampled::Scenario(Box::new(varied.with(keys, values)?)),
            Self::Mission(varied) => Sampled::Mission(Box::new(varied.with(keys, values)?)),
            Self::Stand(varied) => {
                let stand = varied.with(keys, values)?;
                let contact = Contact {
                    wheel: stand.wheel,
                    soil: stand.soil,
                    slip: Slip::on_test_stand(stand.slip_ratio, stand.slip_angle),
                    gravity: stand.gravity,
                };
                let (model, load) = (stand.model, stand.load);
                Sampled::WheelTest { contact: Box::new(contact), model, load }
            }
        })
    }
}

fn heading(scenario: &Scenario) -> Result<Vec<Cell>, Failure> {
    let slope = scenario.ground.plane_slope().unwrap_or(0.0);
    let heading = HeadingStudy::of(scenario)
        .on_slope(slope)
        .map_err(|error| Failure { status: UNFIT, reason: error.to_string() })?
        .map_err(|error| {
            let status = match error {
                NoHeading::CannotMove(_) => CANNOT_MOVE,
                NoHeading::TooSteep { .. } => NO_HEADING,
                NoHeading::GroundStrength { .. } => GROUND_STRENGTH,
                NoHeading::NotFound { .. } => NOT_COMPUTED,
            };
            Failure { status, reason: error.to_string() }
        })?;
    let rim_speed = match scenario.drive {
        DriveLaw::Constant(speed) => Some(speed),
        _ => None,
    };
    let held_row = Held { heading: &heading, rover: &scenario.rover, rim_speed };
    let flags = RoverOnSlope::of(scenario).findings(heading.wheels.iter());
    Ok(cells([Cell::Text(None)], &held(), &held_row).chain([joined(&flags)]).collect())
}

/// Flags as one text: shards have no lists.
fn joined(findings: &[Finding]) -> Cell {
    Cell::text(names_of(findings).join(BETWEEN_NAMES))
}

/// Words, then the results of a row.
fn cells<'r, R, const WORDS: usize>(
    words: [Cell; WORDS],
    columns: &'r [columns::Column<R>],
    row: &'r R,
) -> impl Iterator<Item = Cell> + 'r {
    words.into_iter().chain(columns.iter().flat_map(move |column| column.cells(row)))
}

fn traverse(scenario: &Scenario) -> Result<Vec<Cell>, Failure> {
    let run = Run::new(scenario)
        .and_then(Run::to_end)
        .map_err(|error| Failure { status: NOT_COMPUTED, reason: error.to_string() })?;
    let (end, drive) = (run.last(), Drive::of(&run, scenario));
    let words = [
        Cell::Text(run.outcome.reason()),
        Cell::text(run.outcome.name()),
        Cell::text(run.method.name()),
    ];
    let flags = raised(scenario, &run);
    let stands = standing(scenario).flat_map(|column| column.cells(end));
    let mut row: Vec<Cell> =
        cells(words, END, end).chain(stands).chain(cells([], &DRIVE, &drive)).collect();
    if scenario.rover.has_motors() {
        row.extend(cells([], &ELECTRICAL_DRIVE, &drive));
    }
    row.push(flags);
    Ok(row)
}

/// The flags of a run.
fn raised(scenario: &Scenario, run: &Trajectory) -> Cell {
    let raised = RoverOnSlope::of(scenario).over(run);
    joined(&raised.iter().map(|it| it.finding).collect::<Vec<_>>())
}

fn mission(plan: &Plan) -> Result<Vec<Cell>, Failure> {
    let driven = DrivenMission::drive("", &plan.mission()).map_err(|error| {
        let status = match error {
            MissionError::Plan(_) => UNFIT,
            MissionError::Run(_) => NOT_COMPUTED,
        };
        Failure { status, reason: error.to_string() }
    })?;
    let run = &driven.report.trajectory;
    let words = [
        Cell::Text(driven.legs.last().and_then(DrivenLeg::reason)),
        Cell::text(driven.report.outcome()),
        Cell::text(run.method.name()),
    ];
    let mut row: Vec<Cell> = cells(words, END, run.last()).collect();
    row.extend(standing(&plan.scenario).flat_map(|column| column.cells(run.last())));
    let has_motors = plan.scenario.rover.has_motors();
    row.extend(kept(has_motors).flat_map(|column| column.cells(&driven)));
    for place in 0..driven.planned {
        match driven.legs.get(place) {
            Some(leg) => row.extend(kept_of_leg(has_motors).flat_map(|column| column.cells(leg))),
            None => row.extend(kept_of_leg(has_motors).map(|column| match column.name {
                OUTCOME => Cell::text(NOT_BEGUN),
                _ => Cell::none(column.kind()),
            })),
        }
    }
    row.push(raised(&plan.scenario, run));
    Ok(row)
}

fn wheel_test(contact: &Contact, model: &Model, load: f64) -> Result<Vec<Cell>, Failure> {
    let settled = settle(model.as_ref(), contact, load).map_err(|error| {
        let status = match error {
            SettleError::SunkToAxle { .. } => SUNK,
            SettleError::BadLoad { .. } => UNFIT,
        };
        Failure { status, reason: error.to_string() }
    })?;
    let situation = Situation {
        model,
        wheel: &contact.wheel,
        soil: &contact.soil,
        gravity: contact.gravity,
        slope: 0.0,
        load: Some(load),
        slip: Some(contact.slip),
        settled: Some(&settled),
    };
    let flags = joined(&situation.findings());
    Ok(cells([Cell::Text(None)], &WHEEL, &settled).chain([flags]).collect())
}
