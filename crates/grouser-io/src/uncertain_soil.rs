//! Samples soils from the `[uncertainty]` of a document, and from its priors.
//!
//! A sample replaces numbers of the document and passes the same checks as the document itself.
//!
//! Rows of samples may name the wheel–soil model that each is believed under: then the soil differs
//! from model to model, and so does how much is believed of each.

use super::describe::uncertainty::UNCERTAINTY;
use super::document::Document;
use super::error::{DocumentError, Problem};
use super::field::Inner as _;
use super::given_file::GivenFile;
use super::kind::Kind;
use super::priors::{stated_by_priors, without_priors_of};
use super::samples::{MODEL, RowsOfModel};
use super::stated::{Samples, Stated};
use super::tree::Companion;
use super::tree::Node;
use super::uncertainty::{Inputs, Statement};
use super::values::Described;
use super::varied::{Key, Varied};
use crate::statistics::{Distribution, NothingAccepted};
use grouser_core::contact::Model;
use grouser_core::soil::Soil;

/// A soil with uncertain numbers.
///
/// Between which friction angles are 95 % of the sands that `toyoura-uncertain` may be?
///
/// ```
/// use grouser_io::statistics::Band;
/// use grouser_io::{Kind, Overrides, Source, read_soil};
///
/// let toyoura = Source::find(Kind::Soil, "toyoura-uncertain")?;
/// let uncertain = read_soil(&toyoura, &Overrides::none())?.uncertain.expect("it is uncertain");
/// let soils = uncertain.draws(7, 1000)?;
/// let band = Band::of(soils.iter().map(|soil| soil.friction_angle)).expect("a thousand soils");
/// assert_eq!(format!("{:.1}°", band.low.to_degrees()), "34.9°");
/// assert_eq!(format!("{:.1}°", band.high.to_degrees()), "40.9°");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct UncertainSoil {
    base: Varied<Soil>,
    /// Those of distributions, then those of samples.
    keys: Vec<Key>,
    /// How many are of distributions.
    parameters: usize,
    distribution: Distribution,
    /// Whether sample *i* has row *i* of the samples.
    is_in_order: bool,
    /// Whether the document itself says how well its numbers are known.
    is_stated: bool,
    /// The soils under each model that rows of samples name.
    of_models: Vec<OfModel>,
}

/// What is believed under a wheel–soil model.
#[derive(Clone, Debug, PartialEq)]
struct OfModel {
    model: Model,
    /// How much is believed of it [-].
    share: f64,
    /// Its soils, in the order of their rows.
    soils: UncertainSoil,
}

/// The name of the samples' file beside a resolved document.
pub const SAMPLES_FILE: &str = "soil-samples.csv";

impl UncertainSoil {
    /// Soil number `index`, which depends on the seed and that number alone. Samples outside the
    /// range of a key, or that are no valid soil together, are drawn again. Where rows of samples
    /// name models it is under any of them, by their shares.
    ///
    /// # Errors
    /// [`NothingAccepted`] if that does not end.
    pub fn draw(&self, seed: u64, index: u64) -> Result<Soil, NothingAccepted> {
        self.distribution.draw(seed, index, |values| self.soil(values))
    }

    /// Soil number `index` under a model: that of row `index` where rows of samples name the model,
    /// from the last on again the first, whatever the seed; otherwise as [`draw`](Self::draw) has
    /// it.
    ///
    /// # Errors
    /// The same as [`draw`](Self::draw).
    pub fn draw_under(
        &self,
        model: &Model,
        seed: u64,
        index: u64,
    ) -> Result<Soil, NothingAccepted> {
        let soils = self.under(model);
        soils.draw_with_point(seed, index, |values| soils.soil(values)).map(|(_, soil)| soil)
    }

    /// The same with the point of the unit cube at which its values are.
    pub(super) fn draw_with_point<T>(
        &self,
        seed: u64,
        index: u64,
        accept: impl FnMut(&[f64]) -> Option<T>,
    ) -> Result<(Vec<f64>, T), NothingAccepted> {
        if self.is_in_order {
            return self.distribution.draw_in_order(seed, index, accept);
        }
        self.distribution.draw_with_point(seed, index, accept)
    }

    /// The models that rows of samples name, with how much is believed of each [-]; none where
    /// they name none.
    pub fn models(&self) -> impl Iterator<Item = (&Model, f64)> {
        self.of_models.iter().map(|it| (&it.model, it.share))
    }

    /// The soils under a model: those of its rows of samples, or, where rows name other models
    /// alone, of the one that most is believed of; all of them where they name none.
    #[must_use]
    pub fn under(&self, model: &Model) -> &Self {
        let most = || self.of_models.iter().max_by(|one, other| one.share.total_cmp(&other.share));
        let own = self.of_models.iter().find(|it| it.model == *model).or_else(most);
        own.map_or(self, |it| &it.soils)
    }

    /// The first soils.
    ///
    /// # Errors
    /// The same as [`draw`](Self::draw), for the first soil that cannot be drawn.
    pub fn draws(&self, seed: u64, count: u32) -> Result<Vec<Soil>, NothingAccepted> {
        (0..count).map(|index| self.draw(seed, index.into())).collect()
    }

    /// The same soil as a document of its own, whose numbers are exact; with the model that it is
    /// under, where rows of samples name models.
    ///
    /// # Errors
    /// The same as [`draw`](Self::draw).
    pub fn draw_document(&self, seed: u64, index: u64) -> Result<Document, NothingAccepted> {
        let accept = |values: &[f64]| self.soil(values).map(|_| values.to_vec());
        let values = self.distribution.draw(seed, index, accept)?;
        let keys: Vec<&str> = self.keys().collect();
        let document = self.base.document.with(keys.iter().copied().zip(values.iter().copied()));
        let exact = without_priors_of(&document, &keys);
        let Some(model) = self.model_of(&values) else { return Ok(exact) };
        Ok(exact.changed(|keys| drop(keys.insert(MODEL.to_owned(), model.name().into()))))
    }

    /// The model under which these values are a row of samples.
    fn model_of(&self, values: &[f64]) -> Option<&Model> {
        let row = &values[self.parameters..];
        let has_row = |soils: &Self| {
            soils.distribution.sample_rows().is_some_and(|rows| rows.iter().any(|it| it == row))
        };
        self.of_models.iter().find(|it| has_row(&it.soils)).map(|it| &it.model)
    }

    /// Whether the document itself says how well its numbers are known. Otherwise all that is known
    /// of that is its priors'.
    #[must_use]
    pub fn is_stated(&self) -> bool {
        self.is_stated
    }

    /// The keys that differ from sample to sample.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.keys.iter().map(|key| &*key.path)
    }

    /// Those of them that rows of samples give a value.
    pub fn sampled_keys(&self) -> impl Iterator<Item = &str> {
        self.keys().skip(self.parameters)
    }

    /// Its keys: those of distributions, then those of samples.
    pub(super) fn all_keys(&self) -> &[Key] {
        &self.keys
    }

    /// The distribution of their values.
    pub(super) fn distribution(&self) -> &Distribution {
        &self.distribution
    }

    /// The soil with these values of its keys, if they can be.
    pub(super) fn soil(&self, values: &[f64]) -> Option<Soil> {
        let mut pairs = self.keys.iter().zip(values);
        // NaN is in no range.
        let are_inside = pairs.all(|(key, value)| key.range.contains(value));
        are_inside.then(|| self.base.with(&self.keys, values).ok())?
    }

    /// Checks that samples can be drawn: if one takes too many tries here, every one does.
    fn check_first_draw(&self, tree: &Node) -> Result<(), DocumentError> {
        self.draw(0, 0).map(drop).map_err(|error| {
            let range = |key: &Key| format!("`{}` {}", key.path, key.range_in_words());
            let ranges: Vec<String> = self.keys.iter().map(range).collect();
            let hint =
                format!("a sample has to lie within the ranges of its keys: {}", ranges.join(", "));
            DocumentError::at(tree.origin_of("uncertainty"), Problem::NoDraws(error))
                .with_hint(hint)
        })
    }
}

/// The soils that a document, or its soil, may be; none if it is known exactly. The samples' file
/// is given the name that it has beside a resolved document.
///
/// * `place`: the key of the soil, or nothing
/// * `tree`: the soil's tree
pub(crate) fn read(
    document: &mut Document,
    place: &str,
    tree: &Node,
    (companions, given): (&mut Vec<Companion>, &mut Vec<GivenFile>),
) -> Result<Option<UncertainSoil>, DocumentError> {
    let soil =
        if place.is_empty() { Some(document.clone()) } else { document.part(Kind::Soil, place) };
    let Some(soil) = soil else { return Ok(None) };
    let (stated, believed) = (stated_of(&soil, tree)?, stated_by_priors(&soil));
    if stated.is_none() && believed.parameters.is_empty() {
        return Ok(None);
    }
    let own = without_uncertainty(&soil);
    let base = Varied::of(Soil::of(&soil), own);
    let (own, is_stated) = (stated.clone().unwrap_or_default(), stated.is_some());
    let statements = [
        Statement { stated: &own, tree, table: "uncertainty.", prefix: "", yields: false },
        Statement { stated: &believed, tree, table: "priors.", prefix: "", yields: true },
    ];
    let Inputs { keys, parameters, samples, distribution, .. } = Inputs::read(&base, &statements)?;
    let mut soils = UncertainSoil {
        base,
        keys,
        parameters,
        distribution,
        is_in_order: false,
        is_stated,
        of_models: Vec::new(),
    };
    soils.check_first_draw(tree)?;
    if let Some((table, _)) = &samples {
        let of_model = |RowsOfModel { model, share, rows }| {
            let rows = Distribution::of_samples(rows);
            let distribution = soils.distribution.clone().without_samples().and(rows);
            OfModel {
                model,
                share,
                soils: UncertainSoil { distribution, is_in_order: true, ..soils.clone() },
            }
        };
        let of_models = table.by_model().into_iter().map(of_model).collect();
        soils.of_models = of_models;
    }
    if let (Some((table, _)), Some(Samples::File(_))) = (samples, own.samples) {
        let name = SAMPLES_FILE.to_owned();
        *document = document.changed(|keys| {
            let soil = if place.is_empty() { Some(keys) } else { keys[place].as_object_mut() };
            if let Some(samples) = soil.and_then(|soil| soil["uncertainty"].get_mut("samples")) {
                *samples = name.clone().into();
            }
        });
        given.push(table.given());
        companions.push(Companion { name, content: table.into_content() });
    }
    Ok(Some(soils))
}

/// The uncertainty that a soil states, if it has the table.
///
/// * `tree`: the soil's tree
///
/// # Errors
/// [`DocumentError`] if the table names neither parameters nor samples.
pub fn stated_of(soil: &Document, tree: &Node) -> Result<Option<Stated>, DocumentError> {
    let Some(given) = soil.get("uncertainty") else { return Ok(None) };
    let mut stated = Stated::default();
    UNCERTAINTY.put(&mut stated, given);
    if stated.samples.is_some() || !stated.parameters.is_empty() {
        return Ok(Some(stated));
    }
    let problem = Problem::MissingKey { key: "uncertainty.parameter".to_owned() };
    let hint = "name keys with their standard deviations, or a file of samples: \
                samples = \"posterior.csv\"";
    Err(DocumentError::at(tree.origin_of("uncertainty"), problem).with_hint(hint.to_owned()))
}

/// A soil without its uncertainty, whose numbers are not the soil's.
#[must_use]
pub fn without_uncertainty(soil: &Document) -> Document {
    soil.changed(|keys| drop(keys.shift_remove("uncertainty")))
}
