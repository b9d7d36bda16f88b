//! What the pages of all commands have in common: the charts of every channel, what the columns
//! are, and all that repeats the answer.

use grouser::answers::{Answer, ColumnMeaning, meanings};
use grouser::contact::validity::Finding;
use grouser::document::columns::run::{
    BELLY_CLEARANCE, ELECTRICAL, ELECTRICAL_RECORD, RECORD, STANDING, STEERING_RECORD, WHEEL_RECORD,
};
use grouser::document::columns::wheel::WHEEL;
use grouser::document::columns::{SLOPE, TIME, X, Y};
use grouser::document::figure::{by_part, by_unit};
use grouser::document::given_file::GivenFile;
use grouser::document::reading::{capitalised, four_digits};
use grouser::document::table::Table;
use grouser::document::{Document, Loaded};
use grouser::simulation::{Record, Scenario};
use grouser_draw::relief_of;

use super::page::Page;

/// What an answer was computed from.
pub(crate) struct Basis {
    /// Names of files beside the page, and their texts.
    documents: Vec<(String, String)>,
    assumptions: Vec<String>,
    /// The command that gives the answer again, typed in the folder of the page.
    repeat: String,
    /// Commands to go on with, typed there, too.
    next: Vec<String>,
    /// What the files gave.
    given: Vec<GivenFile>,
}

impl Basis {
    pub(crate) fn new(repeat: String) -> Self {
        let (documents, assumptions, next, given) = Default::default();
        Self { documents, assumptions, repeat, next, given }
    }

    /// The basis of an answer.
    pub(crate) fn of(answer: &Answer, repeat: &str) -> Self {
        let texts = answer.documents.iter().map(|it| (it.file.clone(), it.toml.clone()));
        Self {
            documents: texts.collect(),
            assumptions: answer.assumptions().into_iter().map(str::to_owned).collect(),
            repeat: repeat.to_owned(),
            next: answer.next.clone(),
            given: answer.given.clone(),
        }
    }

    /// The same with commands to go on with.
    pub(crate) fn followed_by(mut self, next: &[&str]) -> Self {
        self.next = next.iter().map(|it| (*it).to_owned()).collect();
        self
    }

    /// The same with what files gave.
    pub(crate) fn with_files(self, given: Vec<GivenFile>) -> Self {
        Self { given, ..self }
    }

    /// The same with a document that lies beside the page.
    pub(crate) fn with<V>(mut self, file: impl Into<String>, document: &Loaded<V>) -> Self {
        self.documents.push((file.into(), document.to_toml()));
        for assumption in &document.assumptions {
            if !self.assumptions.contains(assumption) {
                self.assumptions.push(assumption.clone());
            }
        }
        self
    }
}

/// Ends a page: what is an extrapolation and what to do next; then, for those who unfold it, what
/// was assumed, what the columns are, and how to have the answer again.
pub(crate) fn close<'f>(
    mut page: Page,
    findings: Option<impl IntoIterator<Item = &'f Finding>>,
    meanings: &[ColumnMeaning],
    basis: &Basis,
) -> String {
    let has_documents = !basis.documents.is_empty();
    page.flags(findings);
    add_next(&mut page, &basis.next);
    if !basis.given.is_empty() {
        page.folded("What the files gave", |page| {
            page.list(basis.given.iter().map(GivenFile::sentence).collect::<Vec<_>>());
        });
    }
    if has_documents {
        page.folded("Assumptions in force", |page| {
            if basis.assumptions.is_empty() {
                page.paragraph("No number of the inputs is marked as assumed.");
            } else {
                page.list(&basis.assumptions);
            }
        });
    }
    page.folded("What the columns are", |page| {
        let header = ["column", "unit", "what it is"].map(str::to_owned);
        let cells =
            meanings.iter().map(|it| [&*it.name, it.unit, it.doc].map(str::to_owned).into());
        page.grid("Columns of the tables and files", &header, &cells.collect::<Vec<_>>());
    });
    page.folded("To have it again", |page| {
        page.paragraph("In the folder of this page:");
        page.code(&basis.repeat);
        if has_documents {
            page.paragraph(
                "The inputs are complete in the files beside this page. The same version gives \
                 the same numbers to the last digit.",
            );
        }
    });
    for (name, text) in &basis.documents {
        page.document(name, text);
    }
    page.to_html()
}

/// The commands to go on with, typed in the folder of the page.
pub(crate) fn add_next(page: &mut Page, next: &[String]) {
    if !next.is_empty() {
        page.heading("What to do next");
        page.paragraph("In the folder of this page, with names of your own in capitals:");
        page.code(&next.join("\n"));
    }
}

/// What the channels of a run are.
pub(crate) fn run_meanings(scenario: &Scenario) -> Vec<ColumnMeaning> {
    let rover = &scenario.rover;
    let has_motors = rover.has_motors();
    let electrical = |columns: Vec<ColumnMeaning>| if has_motors { columns } else { Vec::new() };
    [
        meanings(&RECORD),
        if scenario.ground.is_plane() { Vec::new() } else { meanings(&STANDING) },
        electrical(meanings(&ELECTRICAL_RECORD)),
        meanings(&WHEEL_RECORD),
        meanings(&WHEEL),
        electrical(meanings(&ELECTRICAL)),
        if rover.is_steerable() { meanings(&STEERING_RECORD) } else { Vec::new() },
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The slope of the ground, or what has its heights and its soils.
///
/// * `document`: of the run
pub(crate) fn ground(document: &Document, scenario: &Scenario) -> String {
    if let Some(slope) = scenario.ground.plane_slope() {
        return format!("slope: {}°", four_digits(SLOPE.unit.from_si(slope)));
    }
    let shape = document.text("terrain.file").or_else(|| document.text("terrain.surface"));
    let zones = document.text("terrain.soil_file");
    let zones = zones.map_or_else(String::new, |file| format!("; soil by zone: {file}"));
    format!("terrain: {}{zones}", shape.unwrap_or("unnamed"))
}

/// A run over ground with heights, from above, obliquely and cut along the way; nothing of one on a
/// plane.
pub(crate) fn drawing_of_ground(scenario: &Scenario, records: &[Record]) -> Option<String> {
    relief_of("The ground and the way over it", scenario, records)
}

/// The same on a page.
pub(crate) fn over_ground(page: &mut Page, scenario: &Scenario, records: &[Record]) {
    const CAPTION: &str = "The ground, the way of the body's centre of mass over it, and the rover \
        at its start, on the way and at its end, to scale. Numbers are the map's coordinates; the \
        body is a likeness.";
    if let Some(drawing) = drawing_of_ground(scenario, records) {
        page.drawing(&drawing, CAPTION);
    }
}

/// Every channel of a run over time, folded.
///
/// * `name`: of the run among several; empty where it is alone
/// * `table`: a row for each record
pub(crate) fn over_time(page: &mut Page, name: &str, table: &Table, scenario: &Scenario) {
    const ENVELOPE: &str = "Where a number changes faster than can be drawn, the shade is between \
        its least and its largest, and the line is its mean.";
    page.folded(&title_of_part(name, "the rover over time"), |page| {
        page.paragraph(ENVELOPE);
        rover_over_time(page, table, scenario);
    });
    page.folded(&title_of_part(name, "each wheel over time"), |page| {
        page.paragraph(ENVELOPE);
        let mounts = scenario.rover.mounts().iter();
        let wheels: Vec<(String, String)> =
            mounts.map(|mount| (format!("{}.", mount.name), mount.name.clone())).collect();
        page.charts(&by_part(table, TIME, &wheels, &WHEEL_RECORD));
        page.charts(&by_part(table, TIME, &wheels, &WHEEL));
        page.charts(&by_part(table, TIME, &wheels, &ELECTRICAL));
        page.charts(&by_part(table, TIME, &wheels, &STEERING_RECORD));
    });
}

/// The title of a part of a page about a run.
///
/// * `name`: of the run among several; empty where it is alone
pub(crate) fn title_of_part(name: &str, part: &str) -> String {
    if name.is_empty() { capitalised(part) } else { format!("{name}: {part}") }
}

fn rover_over_time(page: &mut Page, table: &Table, scenario: &Scenario) {
    if scenario.ground.is_plane() {
        page.charts(&by_unit(table, TIME, &RECORD));
    } else {
        // Coordinates on a map are too far apart for one axis.
        for place in [X.name, Y.name] {
            let column: Vec<_> = RECORD.into_iter().filter(|it| it.name == place).collect();
            page.charts(&by_unit(table, TIME, &column));
        }
        let (belly, standing): (Vec<_>, Vec<_>) =
            STANDING.into_iter().partition(|it| it.name == BELLY_CLEARANCE.name);
        page.charts(&by_unit(table, TIME, &standing));
        page.charts(&by_unit(table, TIME, &belly));
        let others = RECORD.into_iter().filter(|it| ![X.name, Y.name].contains(&it.name));
        page.charts(&by_unit(table, TIME, &others.collect::<Vec<_>>()));
    }
    page.charts(&by_unit(table, TIME, &ELECTRICAL_RECORD));
}
