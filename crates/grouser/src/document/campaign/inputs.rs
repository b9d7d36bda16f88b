//! The uncertain inputs of a campaign, checked against its base.

use serde_json::{Value as Json, json};

use super::super::error::{DocumentError, Problem};
use super::super::uncertainty::{Inputs, Stated, Statement};
use super::super::varied::{Key, NoNumber, Numbers};
use super::super::{Document, Kind, Misfit, Node, stated_by_priors, stated_of};
use super::rows::Base;
use crate::contact::Model;
use crate::studies::ensemble::design::SOBOL_DIMENSIONS;
use crate::studies::ensemble::models::{ModelSpread, Question};
use crate::studies::ensemble::{Distribution, Ensemble, Marginal, Matrix};
use grouser_io::RowsOfModel;
use grouser_io::campaign::{Sampling, Settings, Study};

/// The uncertain inputs, resolved.
#[derive(Clone, Debug)]
pub(super) struct Prepared {
    /// Keys of the base: those of the parameters, then those of the samples.
    keys: Vec<Key>,
    /// The factors of sensitivities: the parameters, then the samples as one.
    factors: Vec<String>,
    pub(super) ensemble: Ensemble,
    /// The models of the runs, if they are drawn; their place is the last of the ensemble's values.
    models: Option<ModelSpread>,
    /// The document with everything that is uncertain in its own keys.
    pub(super) resolved: Document,
}

/// The factor that rows of samples are.
const SAMPLES: &str = "samples";
/// The factor that the wheel–soil model is.
const MODEL: &str = "model";

impl Prepared {
    pub(super) fn keys(&self) -> &[Key] {
        &self.keys
    }

    pub(super) fn has_models(&self) -> bool {
        self.models.is_some()
    }

    /// The values of the keys, and the model, if it is drawn.
    pub(super) fn split<'v>(&self, values: &'v [f64]) -> (&'v [f64], Option<Model>) {
        let (keys, place) = values.split_at(self.keys.len());
        (keys, self.models.as_ref().zip(place.first()).map(|(models, place)| models.at(*place)))
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
}

/// The base of a campaign, and its uncertain inputs.
pub(super) fn prepare(
    document: &Document,
    settings: &Settings,
    tree: &Node,
) -> Result<(Base, Prepared), DocumentError> {
    let place = place(settings, tree)?;
    let node = tree.entry(place).map_or(tree, |entry| &entry.node);
    let given = document.get(place).cloned().unwrap_or_default();
    let base = match settings.study {
        Study::Traverse | Study::Heading => {
            Base::scenario(Document::of(Kind::Scenario, &given), node)?
        }
        Study::Mission => Base::mission(Document::of(Kind::Mission, &given), node)?,
        Study::WheelTest => Base::stand(document, node)?,
    };
    if settings.study == Study::Heading && node.entry(TERRAIN).is_some() {
        let problem = Problem::Conflict("headings are of planes, and the terrain is none");
        let hint =
            "leave `terrain` out, and state `slope_deg`; runs over it are study = \"traverse\"";
        return Err(DocumentError::at(node.origin_of(TERRAIN), problem).with_hint(hint.to_owned()));
    }
    if base.has_map_in_memory() {
        let problem = Problem::Conflict("the map is an array, which a campaign's document lacks");
        let hint = "write it to a file, numpy.save(\"site.npy\", terrain.heights_m[::-1]), and name \
                    that: file = \"site.npy\", with cell_size_m and south_west_m";
        return Err(DocumentError::at(node.origin_of(MAP_FILE), problem).with_hint(hint.to_owned()));
    }
    let of_soil = if settings.soil_uncertainty { of_soil(document, place, tree)? } else { None };
    let mut statements = Vec::new();
    if let Some(OfSoil { stated, tree, .. }) = &of_soil {
        let (table, prefix) = ("uncertainty.", SOIL);
        statements.push(Statement { stated, tree, table, prefix, yields: false });
    }
    let (stated, table, prefix) = (&settings.uncertain, "", "");
    statements.push(Statement { stated, tree, table, prefix, yields: false });
    // Last, as what gives way comes after what does not.
    if let Some(OfSoil { believed, tree, .. }) = &of_soil {
        let (table, prefix) = ("priors.", SOIL);
        statements.push(Statement { stated: believed, tree, table, prefix, yields: true });
    }
    let numbers = StudyNumbers { study: settings.study, base: base.numbers() };
    let mut inputs = Inputs::read(&numbers, &statements)?.cut();
    let mut models = models(document, settings, place, tree)?;
    let believed = inputs.samples.as_ref().map(|(table, _)| table.by_model());
    let believed = believed.filter(|it| !it.is_empty());
    if let Some(believed) = &believed {
        let rows = if models.is_some() {
            let (spread, rows) = rows_with_models(believed);
            models = Some(spread);
            rows
        } else {
            rows_of(document, place, believed, tree)?
        };
        inputs.distribution = inputs.distribution.without_samples().and(rows);
    } else if models.is_some() {
        let place = Marginal::Uniform { low: 0.0, high: 1.0 };
        let place = Distribution::of_marginals(vec![place], &[]).unwrap_or_default();
        inputs.distribution = inputs.distribution.and(place);
    }
    let drives = matches!(settings.study, Study::Traverse | Study::Mission);
    let scatters = drives && base.scatters();
    let is_alike = !scatters && inputs.distribution.dimensions() == 0;
    if is_alike {
        return Err(nothing_uncertain(tree));
    }
    check_design(settings, &inputs, tree)?;
    let mut factors: Vec<String> =
        inputs.keys[..inputs.parameters].iter().map(|key| key.path.clone()).collect();
    factors.extend(inputs.samples.as_ref().map(|_| SAMPLES.to_owned()));
    factors.extend(models.as_ref().filter(|_| believed.is_none()).map(|_| MODEL.to_owned()));
    let resolved = resolved(document, place, &statements, &inputs);
    let Settings { sampling, runs, seed, sensitivity, .. } = *settings;
    let ensemble = Ensemble::new(sampling, runs, seed, inputs.distribution, sensitivity);
    Ok((base, Prepared { keys: inputs.keys, factors, ensemble, models, resolved }))
}

/// The key of ground with heights.
const TERRAIN: &str = "terrain";
/// The key of a map's file.
const MAP_FILE: &str = "terrain.file";

/// The keys under which a base may stand.
pub(super) const PLACES: [&str; 3] = ["scenario", "mission", "wheel_test"];

/// The key of the base that is varied.
fn place(settings: &Settings, tree: &Node) -> Result<&'static str, DocumentError> {
    let needed = match settings.study {
        Study::Traverse | Study::Heading => "scenario",
        Study::Mission => "mission",
        Study::WheelTest => "wheel_test",
    };
    let mut others = PLACES.iter().filter(|place| **place != needed);
    if let Some(entry) = others.find_map(|other| tree.entry(other)) {
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
        Study::Mission => {
            "a preset such as mission = \"slip-check\", a path, or a table".to_owned()
        }
        Study::Traverse | Study::Heading => {
            "a preset such as scenario = \"traverse-10-deg\", a path, or a table".to_owned()
        }
    };
    Err(DocumentError::at(&tree.origin, problem).with_hint(hint))
}

/// The models of the runs, if they are drawn.
///
/// * `place`: the key of the base
fn models(
    document: &Document,
    settings: &Settings,
    place: &str,
    tree: &Node,
) -> Result<Option<ModelSpread>, DocumentError> {
    if !settings.model_uncertainty {
        return Ok(None);
    }
    if document.model_at(&format!("{place}.model")).is_some() {
        let problem = Problem::Conflict("the base names its model, which is then that of all runs");
        let origin = tree.origin_of("model_uncertainty");
        return Err(DocumentError::at(origin, problem)
            .with_hint(format!("leave out `{place}.model` or `model_uncertainty`")));
    }
    let made_for = document.model_at(&format!("{place}.soil.model"));
    Ok(Some(ModelSpread::all(made_for.as_ref(), Question::Across)))
}

/// The models of rows of samples, and the rows, each with the place of its model behind it.
fn rows_with_models(believed: &[RowsOfModel]) -> (ModelSpread, Distribution) {
    let shares = believed.iter().map(|it| (it.model.clone(), it.share)).collect();
    let spread = ModelSpread::of_shares(shares);
    let rows = believed.iter().flat_map(|RowsOfModel { model, share, rows }| {
        let place = spread.place_of(model);
        let weight = share / rows.len() as f64;
        rows.iter().map(move |row| ([&row[..], &[place]].concat(), weight))
    });
    let rows = rows.collect();
    (spread, Distribution::of_weighted_samples(rows))
}

/// The rows of samples of the base's model.
fn rows_of(
    document: &Document,
    place: &str,
    believed: &[RowsOfModel],
    tree: &Node,
) -> Result<Distribution, DocumentError> {
    let named = document.model_at(&format!("{place}.model"));
    let model = named.unwrap_or_else(|| document.usual_model(&format!("{place}.soil")));
    let own = believed.iter().find(|it| it.model == model);
    let own = own.map(|it| Distribution::of_samples(it.rows.clone()));
    own.ok_or_else(|| {
        let problem = Problem::Conflict("no row of the samples is of the base's model");
        let names: Vec<_> = believed.iter().map(|it| it.model.name()).collect();
        DocumentError::at(&tree.origin, problem).with_hint(format!(
            "the base has {}, the rows {}: name one of those, or set model_uncertainty = true \
             without a model of the base",
            model.name(),
            names.join(", ")
        ))
    })
}

/// What keys of the base's soil begin with.
const SOIL: &str = "soil.";

/// The uncertainty of the base's own soil.
struct OfSoil<'t> {
    /// What it states.
    stated: Stated,
    /// What its priors have besides.
    believed: Stated,
    tree: &'t Node,
}

/// The uncertainty of the base's own soil.
fn of_soil<'t>(
    document: &Document,
    place: &str,
    tree: &'t Node,
) -> Result<Option<OfSoil<'t>>, DocumentError> {
    let soil = document.part(Kind::Soil, &format!("{place}.soil"));
    let entry = tree.entry(place).and_then(|base| base.node.entry("soil"));
    let (Some(soil), Some(entry)) = (soil, entry) else { return Ok(None) };
    let (stated, believed) = (stated_of(&soil, &entry.node)?, stated_by_priors(&soil));
    if stated.is_some() || !believed.parameters.is_empty() {
        let stated = stated.unwrap_or_default();
        return Ok(Some(OfSoil { stated, believed, tree: &entry.node }));
    }
    let problem =
        Problem::Conflict("the soil does not say how well it is known, nor do its priors");
    Err(DocumentError::at(tree.origin_of("soil_uncertainty"), problem)
        .with_hint("its document needs an [uncertainty], as that of toyoura-uncertain".to_owned()))
}

/// The numbers of the base that a study looks at.
struct StudyNumbers<'a> {
    study: Study,
    base: &'a dyn Numbers,
}

impl Numbers for StudyNumbers<'_> {
    fn key(&self, path: &str) -> Result<Key, NoNumber> {
        let key = self.base.key(path)?;
        if unused_keys(self.study).iter().any(|start| path.starts_with(start)) {
            let problem = Problem::Conflict("the study does not use this key");
            return Err(NoNumber { problem, hint: None, is_lacking: false });
        }
        if path == START_YAW && self.base.key(FIRST_YAW).is_ok() {
            let problem = Problem::Conflict("the first leg begins with a yaw of its own");
            let hint = Some(format!("that is `{FIRST_YAW}`"));
            return Err(NoNumber { problem, hint, is_lacking: false });
        }
        Ok(key)
    }

    fn check_with(&self, keys: &[Key], values: &[f64]) -> Result<(), Misfit> {
        self.base.check_with(keys, values)
    }
}

/// The yaw at the start of a run, and the yaw of a mission's first leg, which goes before it.
const START_YAW: &str = "start.yaw_deg";
const FIRST_YAW: &str = "leg.0.yaw_deg";

/// What keys that a study does not look at start with.
fn unused_keys(study: Study) -> &'static [&'static str] {
    match study {
        Study::Heading => &[
            "start.",
            "duration_s",
            "sample_interval_s",
            "drive.reference_slip_ratio",
            "by_wheel.",
            "scatter.",
        ],
        Study::Traverse | Study::Mission => &["sample_interval_s"],
        Study::WheelTest => &[],
    }
}

/// All runs would be alike.
fn nothing_uncertain(tree: &Node) -> DocumentError {
    let problem = Problem::MissingKey { key: "parameter".to_owned() };
    DocumentError::at(&tree.origin, problem).with_hint(
        "name keys with their distributions as [[parameter]], or a file of samples, or set \
         soil_uncertainty = true or model_uncertainty = true, or give the scenario a [scatter]"
            .to_owned(),
    )
}

fn check_design(settings: &Settings, inputs: &Inputs, tree: &Node) -> Result<(), DocumentError> {
    if settings.sensitivity && inputs.distribution.dimensions() == 0 {
        let problem =
            Problem::Conflict("there is no input whose share of the variance could be told");
        return Err(DocumentError::at(tree.origin_of("sensitivity"), problem)
            .with_hint("name keys with their distributions as [[parameter]]".to_owned()));
    }
    if settings.sensitivity && inputs.is_correlated {
        let problem = Problem::Conflict(
            "inputs that are correlated have no Sobol indices of their own: leave out \
             `sensitivity` or the correlations",
        );
        return Err(DocumentError::at(tree.origin_of("sensitivity"), problem));
    }
    let points = if settings.sensitivity { 2 } else { 1 };
    let dimensions = points * inputs.distribution.dimensions();
    if settings.sampling == Sampling::Sobol && dimensions > SOBOL_DIMENSIONS {
        let problem = Problem::WrongLength {
            key: "parameter".to_owned(),
            count: dimensions,
            allowed: format!("at most {SOBOL_DIMENSIONS} dimensions with sampling = \"sobol\""),
        };
        return Err(DocumentError::at(tree.origin_of("sampling"), problem));
    }
    Ok(())
}

/// The document with everything that is uncertain in its own keys.
///
/// * `place`: the key of the base
fn resolved(
    document: &Document,
    place: &str,
    statements: &[Statement<'_>],
    inputs: &Inputs,
) -> Document {
    let (mut parameters, mut correlations) = (Vec::new(), Vec::new());
    for Statement { stated, prefix, .. } in statements.iter().filter(|it| !it.yields) {
        let table = if prefix.is_empty() { "" } else { &*format!("{place}.soil.uncertainty.") };
        let all = |key: &str| document.get(&format!("{table}{key}")).and_then(Json::as_array);
        for (given, parameter) in all("parameter").into_iter().flatten().zip(&stated.parameters) {
            let key = &inputs.keys[parameters.len()];
            let mut given = given.clone();
            given["key"] = key.path.clone().into();
            if parameter.has_no_mean() {
                given["mean"] = key.value.into();
            }
            parameters.push(given);
        }
        for (given, pair) in all("correlation").into_iter().flatten().zip(&stated.correlations) {
            let mut given = given.clone();
            given["between"] = json!(pair.between.each_ref().map(|key| format!("{prefix}{key}")));
            correlations.push(given);
        }
    }
    for Statement { stated, prefix, .. } in statements.iter().filter(|it| it.yields) {
        for parameter in &stated.parameters {
            let key = format!("{prefix}{}", parameter.key);
            let kept = inputs.keys[..inputs.parameters].get(parameters.len());
            if kept.is_some_and(|kept| kept.path == key) {
                parameters.push(parameter.to_json(&key));
            }
        }
        let is_kept = |key: &str| inputs.keys[..inputs.parameters].iter().any(|it| it.path == key);
        for pair in &stated.correlations {
            let between = pair.between.each_ref().map(|key| format!("{prefix}{key}"));
            if between.iter().all(|key| is_kept(key)) {
                correlations.push(json!({ "between": between, "value": pair.value }));
            }
        }
    }
    document.changed(|keys| {
        let base = keys.get_mut(place).and_then(|base| base.get_mut("soil"));
        if let Some(Json::Object(soil)) = base {
            soil.shift_remove("uncertainty");
        }
        keys.insert("soil_uncertainty".to_owned(), false.into());
        keys.insert("parameter".to_owned(), parameters.into());
        keys.insert("correlation".to_owned(), correlations.into());
        match &inputs.samples {
            Some((table, prefix)) => {
                keys.insert(SAMPLES.to_owned(), json!({ "csv": table.prefixed(prefix) }))
            }
            None => keys.shift_remove(SAMPLES),
        };
    })
}
