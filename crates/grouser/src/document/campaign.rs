//! `campaign/1`: Monte Carlo campaigns, which sample uncertain inputs and run a study for each
//! sample.
//!
//! A campaign names a study (`traverse`, `heading`, `mission`, `wheel-test`), what it is a study
//! of, and how well the numbers of that are known. Read, it is a [`Campaign`]: ready to run, run by
//! run, in any order and on any machine, each run a row of the same [`Column`]s. These steps lead
//! there:
//!
//! 1. The document is read as any other, with the scenario, the mission, or the soil and the wheel,
//!    that it names.
//! 2. What is uncertain is brought together from `parameter`, `correlation` and `samples`, and from
//!    the soil's own `[uncertainty]` if asked for; each key is a number of the resolved base
//!    (`inputs`).
//! 3. It becomes an [`Ensemble`]. A run puts the ensemble's values in the base document's place of
//!    them, makes a domain's value of it, and computes (`rows`).
//!
//! The resolved document holds all of that in one text: samples, too. Its hash names the campaign.

mod inputs;
mod rows;
mod statistics;
mod table;

pub use grouser_io::campaign::{Sampling, Settings, Stand, Study};
pub use rows::FAILED;
pub use statistics::{Frequencies, QuantityStatistics};
pub use table::{Column, Role};

use self::inputs::Prepared;
use self::rows::Base;
use super::error::DocumentError;
use super::given_file::NamedFiles;
use super::table::{Cell, Table};
use super::{Assumed, Document, Kind, Overrides, Source, Written, assumed, written};
use crate::studies::ensemble::{Ensemble, outputs_while};
pub use rows::STATUSES;

/// A campaign that was read and checked: ready to run.
///
/// What is in the first row of a campaign of wheel tests?
///
/// ```
/// use grouser::document::table::Cell;
/// use grouser::document::{Kind, Overrides, Source, read_campaign};
///
/// let source = Source::find(Kind::Campaign, "campaign-wheel-test")?;
/// let campaign = read_campaign(&source, &Overrides::none())?;
/// assert_eq!(campaign.runs(), 100_000);
/// let row = campaign.run(0);
/// let number = |name: &str| {
///     match &row[campaign.columns().iter().position(|column| column.name == name)?] {
///         Cell::Float(value) => *value,
///         _ => None,
///     }
/// };
/// assert_eq!(format!("{:.2} N", number("load_n").expect("an input")), "17.41 N");
/// assert_eq!(format!("{:.2} N", number("drawbar_pull_n").expect("a result")), "2.99 N");
/// # Ok::<(), grouser::document::DocumentError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Campaign {
    study: Study,
    base: Base,
    shard_runs: u64,
    columns: Vec<Column>,
    prepared: Prepared,
    resolved: String,
    assumptions: Vec<String>,
}

/// Reads a campaign with all that it names.
///
/// # Errors
/// [`DocumentError`] for whatever is wrong first.
pub fn read_campaign(source: &Source, overrides: &Overrides) -> Result<Campaign, DocumentError> {
    let Written { tree, document, assumptions } = written(Kind::Campaign, source, overrides)?;
    let settings = Settings::of(&document);
    let (base, prepared) = inputs::prepare(&document, &settings, &tree)?;
    Ok(Campaign {
        study: settings.study,
        columns: rows::columns(
            settings.study,
            &base,
            settings.sensitivity,
            prepared.keys(),
            prepared.has_models(),
        ),
        base,
        shard_runs: settings.shard_runs,
        resolved: prepared.resolved.to_toml(),
        prepared,
        assumptions,
    })
}

impl Campaign {
    /// What there is to say of files that it names, such as the map.
    #[must_use]
    pub fn files(&self) -> &NamedFiles {
        self.base.files()
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        self.document().name()
    }

    /// The study that every run computes.
    #[must_use]
    pub fn study(&self) -> Study {
        self.study
    }

    /// How many runs there are: the document's `runs` or, with `sensitivity`, that many times two
    /// more than there are inputs.
    #[must_use]
    pub fn runs(&self) -> u64 {
        self.ensemble().runs()
    }

    /// The seed of its samples.
    #[must_use]
    pub fn seed(&self) -> u64 {
        self.ensemble().design().seed
    }

    /// Runs of every shard but the last, which may have fewer.
    #[must_use]
    pub fn shard_runs(&self) -> u64 {
        self.shard_runs
    }

    /// How many shards there are. They are fixed by the document, not by who computes them.
    #[must_use]
    pub fn shards(&self) -> u64 {
        self.runs().div_ceil(self.shard_runs)
    }

    /// The runs of a shard; none beyond the last.
    #[must_use]
    pub fn runs_of(&self, shard: u64) -> std::ops::Range<u64> {
        let start = shard.saturating_mul(self.shard_runs).min(self.runs());
        start..start.saturating_add(self.shard_runs).min(self.runs())
    }

    /// What a row has, in the order of [`run`](Self::run) and [`shard`](Self::shard).
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The columns of words about legs, whose [`Frequencies`] are counted: `leg_1.outcome`,
    /// `leg_1.stopped_by`. Only missions have some.
    #[must_use]
    pub fn words_of_legs(&self) -> Vec<&str> {
        let words = self.columns.iter().filter(|column| rows::is_word_of_leg(column));
        words.map(|column| &*column.name).collect()
    }

    /// The inputs of its runs.
    #[must_use]
    pub fn ensemble(&self) -> &Ensemble {
        &self.prepared.ensemble
    }

    /// The factors of sensitivities, in the ensemble's order of dimensions: the keys, and `samples`
    /// for rows of samples, which are one.
    #[must_use]
    pub fn factors(&self) -> &[String] {
        self.prepared.factors()
    }

    /// The document with everything in its place, samples included.
    #[must_use]
    pub fn document(&self) -> &Document {
        &self.prepared.resolved
    }

    /// The document with everything in its place, samples included, as TOML: read again it is the
    /// same campaign, and its hash names the campaign.
    #[must_use]
    pub fn resolved(&self) -> &str {
        &self.resolved
    }

    /// What was assumed, each with the name of the document that says so.
    #[must_use]
    pub fn assumptions(&self) -> &[String] {
        &self.assumptions
    }

    /// The keys that its soil takes from priors because they are not stated.
    #[must_use]
    pub fn assumed(&self) -> Vec<Assumed> {
        let soil = |place: &&str| self.document().part(Kind::Soil, &format!("{place}.soil"));
        let soil = inputs::PLACES.iter().find_map(soil);
        soil.as_ref().map_or_else(Vec::new, assumed)
    }

    /// Run number `index`: its row. It depends on the document and the number alone.
    #[must_use]
    pub fn run(&self, index: u64) -> Vec<Cell> {
        let inputs = self.ensemble().inputs(index);
        let mut row = Vec::with_capacity(self.columns.len());
        row.push(Cell::Whole(Some(index)));
        if let Some(place) = inputs.place {
            row.push(Cell::Whole(Some(place.point)));
            row.push(Cell::text(self.prepared.matrix(place.matrix)));
        }
        let (values, model) = self.prepared.split(&inputs.values);
        row.extend(values.iter().map(|value| Cell::Float(Some(*value))));
        row.extend(model.as_ref().map(|model| Cell::text(model.name())));
        // The runs of a point of a design for sensitivities differ by their inputs alone.
        let bed = inputs.place.map_or(index, |place| place.point);
        let keys = self.prepared.keys();
        let case = rows::Case { keys, values, model, seed: self.seed(), bed };
        rows::run(self.study, &self.base, &case, &mut row);
        // A row without an answer has its status, and nothing in the columns after it.
        let missing = self.columns[row.len()..].iter().map(|column| Cell::none(column.kind));
        row.extend(missing);
        row
    }

    /// What the runs count as in the statistics of a quantity: their values, and where a run has
    /// none because the rover does not get on, or the soil does not carry the wheel, one on the
    /// safe side (slip 1, sunk to the axles), so that it is not left out. A run that could not be
    /// computed, and a quantity that such a run has no value of, stay without.
    ///
    /// * `runs`: their numbers, in order
    /// * `values`, `statuses`: theirs
    #[must_use]
    pub fn counted(
        &self,
        quantity: &str,
        runs: &[std::ops::Range<u64>],
        values: &[Option<f64>],
        statuses: &[Option<String>],
    ) -> Vec<Option<f64>> {
        let one = |(run, (value, status)): (u64, (&Option<f64>, &Option<String>))| {
            value.or_else(|| {
                let inputs = self.ensemble().inputs(run);
                let (values, _) = self.prepared.split(&inputs.values);
                let status = status.as_deref()?;
                rows::counted(&self.base, self.prepared.keys(), values, status, quantity)
            })
        };
        runs.iter().cloned().flatten().zip(values.iter().zip(statuses)).map(one).collect()
    }

    /// All runs of a shard, shared among threads and in their order; `None` if `go_on` was false
    /// before the end.
    ///
    /// * `go_on`: asked before each run, from any thread
    #[must_use]
    pub fn shard(&self, shard: u64, go_on: &(dyn Fn() -> bool + Sync)) -> Option<Table> {
        let rows = outputs_while(self.runs_of(shard), go_on, |index| self.run(index))?;
        let columns = self.columns.iter().map(|column| (column.name.as_str(), column.kind));
        Some(Table::of_cells(columns, rows))
    }
}
