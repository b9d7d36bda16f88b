//! The family of soils of a calibration: one document with other values of some keys.

use std::ops::RangeInclusive;

use serde_json::{Value as Json, json};

use super::varied::{Key, Numbers, Varied, meant_number};
use super::{Described, Document, Kind, Misfit, range, without_priors_of, without_uncertainty};
use crate::contact::Model;
use crate::error::ParameterError;
use crate::soil::Soil;
use crate::studies::calibration::{Parameter, Scale};

/// The key of what a model gets wrong in a soil.
pub(super) const DISCREPANCY: &str = "discrepancy";

/// A soil's document, and the keys to fit.
#[derive(Clone, Debug)]
pub struct SoilFamily {
    base: Varied<Soil>,
    keys: Vec<Key>,
    parameters: Vec<Parameter>,
}

/// A key to fit, as it was written: `soil.pressure_sinkage.k_phi`, or with bounds of its
/// own, `soil.pressure_sinkage.k_phi=1e6:5e7`.
#[derive(Clone, Debug, PartialEq)]
pub struct FitKey {
    /// The key in the soil's document, with its tables.
    pub path: String,
    /// Bounds, in the key's unit.
    pub bounds: Option<(f64, f64)>,
}

/// A number that may be this many times larger than it is has no natural range: it is searched
/// within [`SEARCHED_FACTOR`] of the document's value.
const OPEN_ENDED: f64 = 10.0;

/// Positive bounds farther apart than this factor are searched by the logarithm.
const DECADES: f64 = 30.0;

/// A number of either sign whose range ends here or further away is a modulus: it keeps its sign
/// where it is positive, as most are.
const MODULUS: f64 = 1e4;

/// How far from the document's value an open-ended number is searched [-]. Source: ours;
/// stiffnesses and moduli of published soils of one kind differ less.
const SEARCHED_FACTOR: f64 = 30.0;

impl FitKey {
    /// Reads `soil.key` or `soil.key=from:to`.
    ///
    /// # Errors
    /// A sentence, if it is not written so.
    pub fn parse(text: &str) -> Result<Self, String> {
        let (key, bounds) = match text.split_once('=') {
            Some((key, bounds)) => (key, Some(bounds)),
            None => (text, None),
        };
        let path = key.trim().strip_prefix("soil.").ok_or_else(|| {
            format!("'{key}' is not a key of a soil: write soil.friction_angle_deg, for instance")
        })?;
        let bounds = bounds.map(|bounds| {
            let ends = bounds.split_once(':').and_then(|(from, to)| {
                Some((from.trim().parse::<f64>().ok()?, to.trim().parse::<f64>().ok()?))
            });
            ends.ok_or_else(|| format!("'{bounds}' are no bounds: write {key}=from:to"))
        });
        Ok(Self { path: path.to_owned(), bounds: bounds.transpose()? })
    }
}

impl SoilFamily {
    /// The family of a document and some of its keys.
    ///
    /// A key without bounds of its own is searched over the range of its schema, evenly; if it is
    /// positive and that range spans decades, by its logarithm, within a factor of 30 of the
    /// document's value.
    ///
    /// # Errors
    /// A sentence for a key that is no number of the document, is named twice, or has bounds
    /// outside its range or without the document's value.
    pub fn new(base: &Document, keys: &[FitKey]) -> Result<Self, String> {
        Self::starting(base, keys, &[])
    }

    /// The family of a document whose keys are searched from other values than its own, within
    /// what their ranges allow.
    ///
    /// * `starts`: one for each key
    ///
    /// # Errors
    /// The same as [`new`](Self::new).
    pub fn around(base: &Document, keys: &[FitKey], starts: &[f64]) -> Result<Self, String> {
        Self::starting(base, keys, starts)
    }

    /// * `starts`: of the first keys; the others start from the document's values
    fn starting(base: &Document, fitted: &[FitKey], starts: &[f64]) -> Result<Self, String> {
        let mut document = without_uncertainty(base);
        // What an earlier calibration found wrong belongs to other values.
        if !fitted.iter().any(|key| key.path.starts_with(DISCREPANCY)) {
            document = document.changed(|keys| drop(keys.shift_remove(DISCREPANCY)));
        }
        let base = Varied::of(Soil::of(&document), document);
        let (mut keys, mut parameters) = (Vec::<Key>::new(), Vec::new());
        for (place, FitKey { path, bounds }) in fitted.iter().enumerate() {
            let name = format!("soil.{path}");
            if keys.iter().any(|key| key.path == *path) {
                return Err(format!("{name} is named twice"));
            }
            let key = base.key(path).map_err(|_| no_start(&base.document, path))?;
            let start = starts.get(place);
            let start =
                start.map_or(key.value, |start| start.clamp(*key.range.start(), *key.range.end()));
            parameters.push(parameter(name, start, &key.range, *bounds)?);
            keys.push(key);
        }
        Ok(Self { base, keys, parameters })
    }

    /// The keys as parameters: names with `soil.` before them, bounds in the keys' units.
    #[must_use]
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// The keys as the document has them.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.keys.iter().map(|key| &*key.path)
    }

    /// The document that the search starts from, without its own uncertainty.
    #[must_use]
    pub fn base(&self) -> &Document {
        &self.base.document
    }

    /// The soil with these values of the keys.
    ///
    /// # Errors
    /// [`ParameterError`] if they contradict each other.
    pub fn soil(&self, values: &[f64]) -> Result<Soil, ParameterError> {
        self.base.with(&self.keys, values).map_err(Misfit::of_numbers)
    }

    /// The document with these values of the keys, and otherwise as it was.
    #[must_use]
    pub fn document(&self, values: &[f64]) -> Document {
        self.base.document.with(self.keys().zip(values.iter().copied()))
    }

    /// The same as a calibration's result: with its source, and its samples as uncertainty.
    ///
    /// * `source`: where the fitted values come from, before the source of the others
    /// * `model`: that the values belong to, if they belong to one
    /// * `samples`: name of the file of samples beside the document, if there is one
    #[must_use]
    pub fn fitted(
        &self,
        values: &[f64],
        source: &str,
        model: Option<Model>,
        samples: Option<&str>,
    ) -> Document {
        let keys: Vec<&str> = self.keys().collect();
        let document = without_priors_of(&self.document(values), &keys);
        let is_fitted = |assumed: &Json| {
            let key = assumed.as_str().and_then(|text| text.split(':').next());
            self.keys.iter().any(|fitted| Some(&*fitted.path) == key)
        };
        document.changed(|keys| {
            keys["name"] = format!("{}, calibrated", document.name()).into();
            keys["source"] = format!("{source}; other values: {}", document.source()).into();
            // What was said of the old values need not hold for these.
            for key in ["date", "notes", "model"] {
                keys.shift_remove(key);
            }
            if let Some(Json::Array(assumed)) = keys.get_mut("assumed") {
                assumed.retain(|one| !is_fitted(one));
            }
            // Bands keep it with the greater share.
            if let Some(model) = model {
                keys.insert("model".to_owned(), model.name().into());
            }
            if let Some(file) = samples {
                keys.insert("uncertainty".to_owned(), json!({ "samples": file }));
            }
        })
    }
}

/// Why a key has no value to start from.
fn no_start(soil: &Document, path: &str) -> String {
    if range(Kind::Soil, path).is_some() {
        return format!(
            "soil.{path} is not set by this soil: give it a value to start from by the setting \
             soil.{path}=VALUE"
        );
    }
    format!("soil.{path} is not a number of this soil: {}", meant_number(soil, path))
}

fn parameter(
    name: String,
    start: f64,
    allowed: &RangeInclusive<f64>,
    bounds: Option<(f64, f64)>,
) -> Result<Parameter, String> {
    let (least, most) = (*allowed.start(), *allowed.end());
    let is_open_ended = start != 0.0 && most > OPEN_ENDED * start.abs();
    let (lower, upper) = bounds.unwrap_or(if !is_open_ended {
        (least, most)
    } else if start > 0.0 && (least >= 0.0 || most >= MODULUS) {
        (least.max(start / SEARCHED_FACTOR), most.min(start * SEARCHED_FACTOR))
    } else if most >= MODULUS {
        // Of one that is negative, either sign.
        (least.max(start * SEARCHED_FACTOR), most.min(-start * SEARCHED_FACTOR))
    } else {
        (least, most)
    });
    if !(allowed.contains(&lower) && allowed.contains(&upper) && lower < upper) {
        return Err(format!(
            "{name}={lower}:{upper}: bounds must rise, and lie within {least} to {most}"
        ));
    }
    if !(lower..=upper).contains(&start) {
        return Err(format!(
            "{name}={lower}:{upper}: the soil's own value, {start}, must lie between the bounds; \
             give it another by the setting {name}=VALUE"
        ));
    }
    let scale =
        if lower > 0.0 && upper > DECADES * lower { Scale::Logarithmic } else { Scale::Linear };
    Ok(Parameter { name, lower, upper, scale, start })
}

#[cfg(test)]
mod tests {
    use super::super::{Overrides, Source, read_soil};
    use super::*;

    fn toyoura() -> Document {
        let source = Source::find(Kind::Soil, "toyoura").unwrap();
        read_soil(&source, &Overrides::none()).unwrap().document
    }

    fn family(keys: &[&str]) -> Result<SoilFamily, String> {
        let keys: Vec<FitKey> = keys.iter().map(|key| FitKey::parse(key).unwrap()).collect();
        SoilFamily::new(&toyoura(), &keys)
    }

    #[test]
    fn values_go_to_their_keys_and_units() {
        let family = family(&["soil.friction_angle_deg", "soil.shear.longitudinal_m"]).unwrap();
        let soil = family.soil(&[30.0, 0.05]).unwrap();
        assert_eq!(soil.friction_angle, 30.0_f64.to_radians());
        let document = family.document(&[30.0, 0.05]);
        assert_eq!(document.number("friction_angle_deg"), Some(30.0));
        assert_eq!(Soil::of(&document).settled().ok(), Some(soil));
        assert_eq!((document.name(), document.source()), (toyoura().name(), toyoura().source()));
    }

    #[test]
    fn stiffnesses_are_searched_by_decades_and_angles_evenly() {
        let family = family(&["soil.pressure_sinkage.k_phi", "soil.friction_angle_deg"]).unwrap();
        let [stiffness, angle] = family.parameters() else { panic!("two") };
        assert_eq!(stiffness.scale, Scale::Logarithmic);
        assert!((stiffness.upper / stiffness.start - SEARCHED_FACTOR).abs() < 1e-9);
        assert_eq!((angle.scale, angle.lower, angle.upper), (Scale::Linear, 5.0, 60.0));
    }

    #[test]
    fn keys_that_cannot_be_fitted_say_why() {
        for (key, part) in [
            ("soil.cohesion", "cohesion_kpa"),
            ("soil.bulldozing.law", "not a number"),
            ("soil.rft.scale", "by the setting soil.rft.scale=VALUE"),
            ("soil.friction_angle_deg=40:50", "must lie between"),
            ("soil.friction_angle_deg=30:90", "within 5 to 60"),
            ("soil.friction_angle_deg=45:30", "must rise"),
        ] {
            let error = family(&[key]).unwrap_err();
            assert!(error.contains(part), "{error}");
        }
        let twice = family(&["soil.cohesion_kpa", "soil.cohesion_kpa"]).unwrap_err();
        assert!(twice.contains("twice"), "{twice}");
        for text in ["cohesion_kpa", "soil.cohesion_kpa=1", "soil.cohesion_kpa=a:b"] {
            assert!(FitKey::parse(text).is_err(), "{text}");
        }
    }
}
