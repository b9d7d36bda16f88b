//! What is uncertain, brought together and checked against the base.

use super::super::check::range_at;
use super::super::error::{DocumentError, Problem};
use super::super::samples::SampleTable;
use super::super::schema::range;
use super::super::text::{Node, Origin};
use super::super::uncertainty::{
    CorrelationSection, DistributionWord, UncertainParameter, UncertaintySection, correlations,
    meant, understood,
};
use super::super::{Document, Kind};
use super::marginals::{Key, check_marginal, out_of_range};
use super::rows::Base;
use super::sections::{ParameterSection, SamplesSection, Settings, Study, Uncertain, soil_of};
use serde_json::{Value as Json, json};

use crate::studies::campaign::design::{SOBOL_DIMENSIONS, Sampling};
use crate::studies::campaign::{Matrix, Plan};
use crate::studies::uncertainty::{Correlation, Distribution};

/// What is uncertain, with everything in its place.
#[derive(Clone, Debug)]
pub(super) struct Prepared {
    /// Keys of the base: those of the parameters, then those of the samples.
    keys: Vec<String>,
    /// What a sensitivity is asked of: the parameters, then the samples as one.
    factors: Vec<String>,
    parameters: Vec<ParameterSection>,
    correlations: Vec<CorrelationSection>,
    /// The samples' table, with the base's keys.
    samples: Option<String>,
    distributions: Vec<Distribution>,
}

/// The factor that rows of samples are.
const SAMPLES: &str = "samples";

impl Prepared {
    pub(super) fn keys(&self) -> &[String] {
        &self.keys
    }

    pub(super) fn factors(&self) -> &[String] {
        &self.factors
    }

    /// The name of a matrix in a row: `a`, `b`, or the factor that is exchanged.
    pub(super) fn matrix(&self, matrix: Matrix) -> &str {
        match matrix {
            Matrix::A => "a",
            Matrix::B => "b",
            Matrix::Exchanged(dimension) => &self.factors[dimension],
        }
    }

    pub(super) fn plan(&self, settings: &Settings) -> Plan {
        let Settings { sampling, runs, seed, sensitivity, .. } = *settings;
        Plan::new(sampling, runs, seed, self.distributions.clone(), sensitivity)
    }

    /// The document with everything that is uncertain in its own keys.
    pub(super) fn resolved(&self, document: &Document) -> Document {
        document.changed(|keys| {
            for place in ["scenario", "wheel_test"] {
                let soil = keys.get_mut(place).and_then(|base| base.get_mut("soil"));
                if let Some(Json::Object(soil)) = soil {
                    soil.shift_remove("uncertainty");
                }
            }
            keys.insert("soil_uncertainty".to_owned(), false.into());
            keys.insert("parameter".to_owned(), json!(self.parameters));
            keys.insert("correlation".to_owned(), json!(self.correlations));
            match &self.samples {
                Some(csv) => keys.insert("samples".to_owned(), json!({ "csv": csv })),
                None => keys.shift_remove("samples"),
            };
        })
    }
}

/// The base of a campaign, and what is uncertain about it.
pub(super) fn prepare(
    document: &Document,
    settings: &Settings,
    tree: &Node,
) -> Result<(Base, Prepared), DocumentError> {
    let place = place(settings, tree)?;
    let node = tree.entry(place).map_or(tree, |entry| &entry.node);
    let said = document.get(place).cloned().unwrap_or_default();
    let base = if place == "scenario" {
        Base::scenario(Document::of(Kind::Scenario, &said), node)?
    } else {
        Base::stand(document, node)?
    };
    let uncertain = serde_json::from_value(document.keys().clone()).unwrap_or_default();
    let reader = Reader { document, settings, uncertain: &uncertain, tree, place, base: &base };
    let soil = reader.soil(node)?;
    let prepared = reader.read(soil)?;
    reader.check_design(&prepared)?;
    Ok((base, prepared))
}

/// The key under which what is varied stands.
fn place(settings: &Settings, tree: &Node) -> Result<&'static str, DocumentError> {
    let (needed, other) = match settings.study {
        Study::Traverse | Study::Attitude => ("scenario", "wheel_test"),
        Study::WheelTest => ("wheel_test", "scenario"),
    };
    if let Some(entry) = tree.entry(other) {
        let problem = Problem::Conflict("the study does not use this table");
        return Err(DocumentError::at(&entry.key_origin, problem)
            .with_hint(format!("what it varies stands in `{needed}`")));
    }
    if tree.entry(needed).is_some() {
        return Ok(needed);
    }
    let problem = Problem::MissingKey { key: needed.to_owned() };
    let hint = match settings.study {
        Study::WheelTest => "it has the soil, the wheel, load_n and slip_ratio".to_owned(),
        _ => "a preset such as scenario = \"traverse-10-deg\", a path, or a table".to_owned(),
    };
    Err(DocumentError::at(&tree.origin, problem).with_hint(hint))
}

/// What the soil says of its own uncertainty, in the base's keys.
#[derive(Default)]
struct OfSoil {
    parameters: Vec<ParameterSection>,
    correlations: Vec<CorrelationSection>,
    samples: Option<SampleTable>,
}

struct Reader<'a> {
    document: &'a Document,
    settings: &'a Settings,
    uncertain: &'a Uncertain,
    tree: &'a Node,
    /// The key of the base in the tree.
    place: &'static str,
    base: &'a Base,
}

impl Reader<'_> {
    /// * `node`: the base's tree
    fn soil(&self, node: &Node) -> Result<OfSoil, DocumentError> {
        if !self.settings.soil_uncertainty {
            return Ok(OfSoil::default());
        }
        let (Some(soil), Some(entry)) = (soil_of(self.document, self.place), node.entry("soil"))
        else {
            return Ok(OfSoil::default());
        };
        let Some(uncertainty) = UncertaintySection::of(&soil) else {
            let problem = Problem::Conflict("the soil does not say how well it is known");
            return Err(DocumentError::at(self.tree.origin_of("soil_uncertainty"), problem)
                .with_hint(
                    "its document needs an [uncertainty], as that of toyoura-uncertain".to_owned(),
                ));
        };
        // All that can be wrong with it is told in the soil's own words.
        understood(&soil, &entry.node)?;
        OfSoil::of(&uncertainty, &entry.node)
    }

    fn read(&self, soil: OfSoil) -> Result<Prepared, DocumentError> {
        let count = soil.parameters.len();
        let mut keys: Vec<Key> = Vec::new();
        let (mut parameters, mut marginals) = (Vec::new(), Vec::new());
        for (place, section) in soil.parameters.iter().chain(&self.uncertain.parameter).enumerate()
        {
            let path = match place.checked_sub(count) {
                None => "soil_uncertainty".to_owned(),
                Some(own) => format!("parameter.{own}"),
            };
            let key_origin = self.tree.origin_of(&format!("{path}.key"));
            let key = self.key(section.key(), key_origin)?;
            check_new(&keys, &key, key_origin)?;
            let section = section.around(key.value);
            check_marginal(&key, &section, self.tree, &path)?;
            marginals.push(section.marginal());
            keys.push(key);
            parameters.push(section);
        }
        let factors: Vec<String> = keys.iter().map(|key| key.path.clone()).collect();
        let ranges: Vec<_> = keys.iter().map(|key| key.range.clone()).collect();
        let (sections, all) = self.correlations(soil.correlations, &factors)?;
        let mut distributions = Vec::new();
        if !marginals.is_empty() {
            let distribution = Distribution::of_marginals(marginals, &all).map_err(|error| {
                let origin = self.tree.origin_of("correlation");
                DocumentError::at(origin, Problem::Contradiction(error))
            })?;
            distributions.push(distribution.within(&ranges));
        }
        let mut prepared = Prepared {
            keys: factors.clone(),
            factors,
            parameters,
            correlations: sections,
            samples: None,
            distributions,
        };
        self.add_samples(soil.samples, keys, &mut prepared)?;
        Ok(prepared)
    }

    /// The correlations of soil and document, as they are written and by places.
    fn correlations(
        &self,
        of_soil: Vec<CorrelationSection>,
        keys: &[String],
    ) -> Result<(Vec<CorrelationSection>, Vec<Correlation>), DocumentError> {
        let names: Vec<&str> = keys.iter().map(String::as_str).collect();
        // Those of the soil were checked as part of its document.
        let mut all = correlations(&of_soil, &names, self.tree, "soil_uncertainty", Vec::new())?;
        all = correlations(&self.uncertain.correlation, &names, self.tree, "correlation", all)?;
        let sections = of_soil.into_iter().chain(self.uncertain.correlation.clone()).collect();
        Ok((sections, all))
    }

    /// Adds rows of samples, if there are any.
    fn add_samples(
        &self,
        of_soil: Option<SampleTable>,
        mut keys: Vec<Key>,
        prepared: &mut Prepared,
    ) -> Result<(), DocumentError> {
        let (table, prefix) = match (of_soil, &self.uncertain.samples) {
            (Some(_), Some(_)) => {
                let problem = Problem::Conflict(
                    "the soil's uncertainty is a table of samples, too: it is one or the other",
                );
                return Err(DocumentError::at(self.tree.origin_of(SAMPLES), problem));
            }
            (Some(table), None) => (table, "soil."),
            (None, Some(SamplesSection::File(name))) => {
                (SampleTable::read(name, self.tree.origin_of(SAMPLES))?, "")
            }
            (None, Some(SamplesSection::Inline { csv })) => {
                let label = format!("{}, samples", self.tree.origin.text.label);
                (SampleTable::of_text(label, csv.clone())?, "")
            }
            (None, None) => return Ok(()),
        };
        let first = keys.len();
        for (column, name) in table.columns().iter().enumerate() {
            let origin = table.column_origin(column);
            let key = self.key(&format!("{prefix}{name}"), &origin)?;
            check_new(&keys, &key, &origin)?;
            keys.push(key);
        }
        let keys = &keys[first..];
        let names: Vec<String> = keys.iter().map(|key| key.path.clone()).collect();
        for (index, row) in table.rows().iter().enumerate() {
            let outside = keys.iter().zip(row).position(|(key, value)| !key.range.contains(value));
            if let Some(column) = outside {
                let Key { path, range, .. } = &keys[column];
                let problem = out_of_range(path, row[column], range);
                return Err(DocumentError::at(&table.cell_origin(index, column), problem));
            }
            self.base
                .check_with(&names, row)
                .map_err(|error| DocumentError::at(&table.row_origin(index), *error.problem))?;
        }
        prepared.keys.extend(names);
        prepared.factors.push(SAMPLES.to_owned());
        prepared.distributions.push(Distribution::of_samples(table.rows().to_vec()));
        prepared.samples = Some(table.prefixed(prefix));
        Ok(())
    }

    /// A number of the base.
    fn key(&self, path: &str, origin: &Origin) -> Result<Key, DocumentError> {
        let Some(value) = self.base.number(path) else {
            let problem = Problem::UnknownKey { key: path.escape_debug().to_string() };
            return Err(DocumentError::at(origin, problem).with_hint(self.hint(path)));
        };
        let unused = unused_keys(self.settings.study);
        if unused.iter().any(|start| path.starts_with(start)) {
            let problem = Problem::Conflict("the study does not use this key");
            return Err(DocumentError::at(origin, problem));
        }
        let full = format!("{}.{path}", self.place);
        // Entries of a list have the list's key, and so has what depends on a law that is left out.
        let steps = full.split('.').filter(|step| step.parse::<usize>().is_err());
        let listed = steps.collect::<Vec<_>>().join(".");
        let range = range_at(Kind::Campaign, self.tree, &full)
            .or_else(|| range(Kind::Campaign, &listed))
            .unwrap_or(f64::MIN..=f64::MAX);
        Ok(Key { path: path.to_owned(), value, range })
    }

    /// What a key that leads nowhere was meant to be.
    fn hint(&self, path: &str) -> String {
        let last = path.rsplit('.').next().unwrap_or(path);
        let known = self.base.document().number_keys();
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        let same_end = known.iter().find(|key| key.rsplit('.').next() == Some(last));
        match same_end {
            Some(key) => format!("did you mean `{key}`?"),
            None => meant(path, &known),
        }
    }

    fn check_design(&self, prepared: &Prepared) -> Result<(), DocumentError> {
        if prepared.keys.is_empty() {
            let problem = Problem::MissingKey { key: "parameter".to_owned() };
            return Err(DocumentError::at(&self.tree.origin, problem).with_hint(
                "name keys with their distributions as [[parameter]], or a file of samples, or set \
                 soil_uncertainty = true"
                    .to_owned(),
            ));
        }
        if self.settings.sensitivity && !prepared.correlations.is_empty() {
            let problem = Problem::Conflict(
                "inputs that are correlated have no Sobol indices of their own: leave out \
                 `sensitivity` or the correlations",
            );
            return Err(DocumentError::at(self.tree.origin_of("sensitivity"), problem));
        }
        let plan = prepared.plan(self.settings);
        let dimensions = plan.design().dimensions;
        if plan.design().sampling == Sampling::Sobol && dimensions > SOBOL_DIMENSIONS {
            let problem = Problem::WrongLength {
                key: "parameter".to_owned(),
                count: dimensions,
                allowed: format!("at most {SOBOL_DIMENSIONS} dimensions with sampling = \"sobol\""),
            };
            return Err(DocumentError::at(self.tree.origin_of("sampling"), problem));
        }
        Ok(())
    }
}

impl OfSoil {
    /// * `soil`: the tree of its document
    fn of(uncertainty: &UncertaintySection, soil: &Node) -> Result<Self, DocumentError> {
        let in_base = |key: &String| format!("soil.{key}");
        let parameter = |UncertainParameter { key, standard_deviation, distribution }: &_| {
            let (key, mean, standard_deviation) = (in_base(key), None, *standard_deviation);
            match distribution {
                DistributionWord::Normal => {
                    ParameterSection::Normal { key, mean, standard_deviation }
                }
                DistributionWord::Lognormal => {
                    ParameterSection::Lognormal { key, mean, standard_deviation }
                }
            }
        };
        let correlation = |CorrelationSection { between, value }: &_| CorrelationSection {
            between: between.each_ref().map(in_base),
            value: *value,
        };
        let read = |name: &String| SampleTable::read(name, soil.origin_of("uncertainty.samples"));
        Ok(Self {
            parameters: uncertainty.parameter.iter().map(parameter).collect(),
            correlations: uncertainty.correlation.iter().map(correlation).collect(),
            samples: uncertainty.samples.as_ref().map(read).transpose()?,
        })
    }
}

/// What keys that a study does not look at start with.
fn unused_keys(study: Study) -> &'static [&'static str] {
    match study {
        Study::Attitude => {
            &["start.", "duration_s", "sample_interval_s", "drive.reference_slip_ratio"]
        }
        Study::Traverse => &["sample_interval_s"],
        Study::WheelTest => &[],
    }
}

/// That a key is not uncertain twice.
fn check_new(keys: &[Key], key: &Key, origin: &Origin) -> Result<(), DocumentError> {
    if keys.iter().all(|other| other.path != key.path) {
        return Ok(());
    }
    let problem = Problem::RepeatedName { key: "key".to_owned(), name: key.path.clone() };
    Err(DocumentError::at(origin, problem))
}
