//! A calibration on plate and shear tests, from documents to documents: the moduli of a
//! pressure-sinkage law, and cohesion, friction angle and shear modulus.

use serde::Serialize;
use serde_json::{Map, Value as Json, json};

use super::super::Described;
use super::super::{Document, FitKey, SAMPLES_FILE, SoilFamily, without_priors_of};
use super::{DiscrepancyRecord, ParameterRecord, SamplerRecord, Solved};
use crate::soil::{PressureSinkage, Soil};
use crate::studies::calibration::bevameter::{BevameterCurves, BevameterTest};
use crate::studies::calibration::plate_curve::PlatePoint;
use crate::studies::calibration::repeated_curves::{CurvePoint, INTERVALS};
use crate::studies::calibration::shear_test::{ShearStrength, largest_stress};
use crate::studies::calibration::{
    Calibration, CalibrationError, FitSettings, Observer, ParameterSpace, PlateCurve, PlateLaw,
    Sampling, ShearCurve,
};

/// With one width only the sum of the law's two terms is identifiable; no sampler is needed to find
/// that out.
const ONE_WIDTH: &str = "soil.pressure_sinkage.k_c and soil.pressure_sinkage.k_phi are not \
                         separately identifiable from plates of one width: test a second one";

/// With one normal stress only c + σ tan φ is identifiable.
const ONE_NORMAL_STRESS: &str = "soil.cohesion_kpa and soil.friction_angle_deg are not separately \
                                 identifiable from shear tests under one normal stress: test a \
                                 second one";

/// A modulus is searched to either side of zero, up to so many times what would make up all the
/// stiffness of the stiffest plate [-]. Source: ours; the exponent may change its unit by less.
const SEARCHED_SIZES: f64 = 30.0;

/// A shear modulus is searched within this factor of the displacement in which the curves rise [-].
/// Source: ours.
const SEARCHED_RISES: f64 = 30.0;

/// The keys that shear tests determine.
const SHEAR_KEYS: [&str; 3] = ["cohesion_kpa", "friction_angle_deg", "shear.longitudinal_m"];

/// Curves of plate and shear tests, as they were read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BevameterTests {
    /// Curves of plate tests; those of one width repeat each other.
    pub plates: Vec<PlateCurve>,
    /// Curves of shear tests; those under nearly one normal stress repeat each other.
    pub shear: Vec<ShearCurve>,
}

/// The inputs of a calibration on plate and shear tests.
#[derive(Clone, Debug)]
pub struct BevameterProblem {
    soil: Document,
    curves: BevameterCurves,
    gravity: f64,
    family: SoilFamily,
    notes: Vec<String>,
}

/// The results of a calibration on plate and shear tests.
#[derive(Clone, Debug)]
pub struct BevameterFound {
    /// Parameters, samples, unidentifiable parameters.
    pub solved: Solved,
    /// The soil of the fit.
    pub soil: Document,
}

/// The same as JSON.
#[derive(Clone, Debug, Serialize)]
pub struct BevameterResults<'a> {
    rows: &'a [ParameterRecord],
    discrepancies: &'a [DiscrepancyRecord],
    unidentifiable: &'a [String],
    sampler: &'a Option<SamplerRecord>,
}

/// A point of a plate's curve, measured and with the fit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PlateRecord {
    /// Width of the plate, or radius of a round one [mm].
    pub plate_width_mm: f64,
    /// Sinkage [mm].
    pub sinkage_mm: f64,
    /// Pressure, measured [kPa].
    pub measured_pressure_kpa: f64,
    /// Pressure with the fit [kPa].
    pub pressure_kpa: f64,
}

/// A point of a shear test, measured and with the fit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ShearRecord {
    /// Normal stress [kPa].
    pub normal_stress_kpa: f64,
    /// Shear displacement [mm].
    pub shear_displacement_mm: f64,
    /// Shear stress, measured [kPa].
    pub measured_shear_stress_kpa: f64,
    /// Shear stress with the fit [kPa].
    pub shear_stress_kpa: f64,
}

/// A key to fit, where its search starts and what bounds it, in the key's unit.
struct Searched {
    key: &'static str,
    start: f64,
    bounds: (f64, f64),
}

impl BevameterProblem {
    /// Curves, and the soil for all values that are not fitted.
    ///
    /// * `law`: `bekker` or `reece`; the soil's own without
    /// * `gravity`: *g* [m/s²]
    ///
    /// # Errors
    /// A sentence, if there are no curves, a number of theirs is wrong, or the keys cannot be
    /// fitted.
    pub fn new(
        soil: &Document,
        law: Option<&str>,
        gravity: f64,
        tests: &BevameterTests,
    ) -> Result<Self, String> {
        let curves = BevameterCurves::of(&tests.plates, &tests.shear);
        let curves = curves.map_err(|error| error.to_string())?;
        if curves.plates.is_empty() && curves.shear.is_empty() {
            return Err("there is no curve of a plate or of a shear test".to_owned());
        }
        let soil = law.map_or_else(|| soil.clone(), |law| with_law(soil, law));
        let soil = with_widths(&soil, &curves.plates);
        let sheared = (!curves.shear.is_empty()).then(|| ShearStrength::first_guess(&curves.shear));
        let cohesion = sheared.map_or(Soil::of(&soil).cohesion, |found| found.cohesion);
        let mut searched = Vec::new();
        if !curves.plates.is_empty() {
            searched.extend(plate_keys(&soil, &curves.plates, gravity, cohesion));
        }
        searched.extend(sheared.iter().flat_map(|found| shear_keys(found, &curves.shear)));
        let keys: Vec<FitKey> = searched.iter().map(Searched::key).collect();
        let starts: Vec<f64> = searched.iter().map(|one| one.start).collect();
        let family = SoilFamily::around(&soil, &keys, &starts)?;
        let notes = notes(tests, &curves);
        Ok(Self { soil, curves, gravity, family, notes })
    }

    /// The soil from which the search sets out, under the law that is fitted.
    #[must_use]
    pub fn soil(&self) -> &Document {
        &self.soil
    }

    /// The soils among which it chooses.
    #[must_use]
    pub fn family(&self) -> &SoilFamily {
        &self.family
    }

    /// The curves that are fitted: each the mean over its repeats.
    #[must_use]
    pub fn curves(&self) -> &BevameterCurves {
        &self.curves
    }

    /// What became of long curves and of repeats, a sentence each.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Calibrates.
    ///
    /// * `file`: name of the curves' file or files, for the soil's source
    /// * `sampling`: of the posterior; least squares alone without
    ///
    /// # Errors
    /// [`CalibrationError`] for curves that do not determine the soil, and if the observer stopped
    /// it.
    pub fn solve(
        &self,
        file: &str,
        sampling: Option<Sampling>,
        observer: &dyn Observer,
    ) -> Result<BevameterFound, CalibrationError> {
        let soil_of = |values: &[f64]| self.family.soil(values);
        let test = BevameterTest::new(self.curves.clone(), self.gravity, &soil_of)?;
        let space = ParameterSpace::new(self.family.parameters().to_vec())?;
        let calibration = Calibration::new(&test, space)?;
        let fit = calibration.search(&FitSettings::default(), observer)?;
        let solution = calibration.solve(fit, sampling, observer)?;
        let mut solved = Solved::new(self.family.parameters(), solution);
        let one_each =
            [(self.curves.widths(), ONE_WIDTH), (self.curves.normal_stresses(), ONE_NORMAL_STRESS)];
        for (_, sentence) in one_each.into_iter().filter(|(count, _)| *count == 1) {
            solved.unidentifiable.insert(0, sentence.to_owned());
        }
        Ok(BevameterFound { soil: self.fitted(file, &solved), solved })
    }

    /// The plates' curves beside the fit, point by point.
    #[must_use]
    pub fn plate_records(&self, found: &BevameterFound) -> Vec<PlateRecord> {
        let curves = self.curves.plates.iter();
        let points = curves.flat_map(|it| it.points.iter().map(|one| (it.width, one)));
        let record = |((width, point), pressure): ((f64, &PlatePoint), &f64)| PlateRecord {
            plate_width_mm: (width * 1e6).round() / 1e3,
            sinkage_mm: point.sinkage * 1e3,
            measured_pressure_kpa: point.pressure * 1e-3,
            pressure_kpa: pressure * 1e-3,
        };
        points.zip(&found.solved.solution.fit.predictions).map(record).collect()
    }

    /// The shear tests beside the fit, point by point.
    #[must_use]
    pub fn shear_records(&self, found: &BevameterFound) -> Vec<ShearRecord> {
        let before: usize = self.curves.plates.iter().map(|curve| curve.points.len()).sum();
        let curves = self.curves.shear.iter();
        let points = curves.flat_map(|it| it.points.iter().map(|one| (it.normal_stress, one)));
        let record = |((normal, point), stress): ((f64, &CurvePoint), &f64)| ShearRecord {
            normal_stress_kpa: normal * 1e-3,
            shear_displacement_mm: point.at * 1e3,
            measured_shear_stress_kpa: point.value * 1e-3,
            shear_stress_kpa: stress * 1e-3,
        };
        let predictions = found.solved.solution.fit.predictions.iter().skip(before);
        points.zip(predictions).map(record).collect()
    }

    fn fitted(&self, file: &str, solved: &Solved) -> Document {
        let mut parts = Vec::new();
        if !self.curves.plates.is_empty() {
            parts.push(counted(self.curves.plates.iter().map(|it| it.points.len()), "plates"));
        }
        if !self.curves.shear.is_empty() {
            parts.push(counted(self.curves.shear.iter().map(|it| it.points.len()), "shear tests"));
        }
        let keys: Vec<&str> = self.family.keys().collect();
        let source = format!(
            "{} fitted by Grouser {} to {file} ({})",
            keys.join(", "),
            env!("CARGO_PKG_VERSION"),
            parts.join(", ")
        );
        let samples = solved.solution.posterior.as_ref().map(|_| SAMPLES_FILE);
        // A bevameter knows no wheel: the soil keeps the model that it was made for, if any.
        let values = &solved.solution.fit.values;
        let fitted = self.family.fitted(values, &source, self.soil.model(), samples);
        self.with_origin(&fitted)
    }

    /// The soil with what it says of how its constants were measured.
    fn with_origin(&self, soil: &Document) -> Document {
        let sheared = !self.curves.shear.is_empty();
        let mut known: Vec<&str> = Vec::new();
        if !self.curves.plates.is_empty() {
            known.push("pressure_sinkage");
        }
        if sheared {
            known.extend(["strength", "shear"]);
        }
        let told = soil.changed(|keys| {
            if sheared {
                keys.remove(SHARE);
                keys.insert("friction_test".to_owned(), "direct-shear".into());
            }
            let origin = keys.entry("known_from").or_insert_with(|| Json::Object(Map::default()));
            for group in known {
                origin[group] = "this-bed".into();
            }
        });
        if sheared { without_priors_of(&told, &[SHARE]) } else { told }
    }
}

/// The key that the kind of test decides.
const SHARE: &str = "constant_volume_share";

/// How many points of how many curves: `150 points of 3 plates`.
fn counted(points: impl Iterator<Item = usize>, what: &str) -> String {
    let (curves, points) = points.fold((0, 0), |sum, points| (sum.0 + 1, sum.1 + points));
    format!("{points} points of {curves} {what}")
}

/// What became of rows on their way to the curves that are fitted.
fn notes(tests: &BevameterTests, curves: &BevameterCurves) -> Vec<String> {
    let plates = tests.plates.iter().map(|curve| curve.points.len());
    let shear = tests.shear.iter().map(|curve| curve.points.len());
    let long = plates.chain(shear).filter(|points| *points > INTERVALS).count();
    let mut notes = Vec::new();
    if long > 0 {
        notes.push(format!(
            "{long} curves of more than {INTERVALS} rows are averaged over {INTERVALS} intervals \
             of equal length"
        ));
    }
    let (of_plates, of_shear) = &curves.repeats;
    let plates = curves
        .plates
        .iter()
        .zip(of_plates)
        .map(|(curve, count)| (count, format!("the plate of b = {:.1} mm", curve.width * 1e3)));
    let shear = curves.shear.iter().zip(of_shear).map(|(curve, count)| {
        (count, format!("the shear test under {:.1} kPa", curve.normal_stress * 1e-3))
    });
    let repeated = plates.chain(shear).filter(|(count, _)| **count > 1);
    notes.extend(repeated.map(|(count, what)| {
        format!(
            "{what} was repeated: the mean of {count} curves counts, as far as all of them reach, \
             with the scatter between them"
        )
    }));
    notes
}

impl Searched {
    fn key(&self) -> FitKey {
        FitKey { path: self.key.to_owned(), bounds: Some(self.bounds) }
    }

    /// Returns a key that is searched over both signs, up to a size; a start beyond that is moved
    /// to it.
    fn signed(key: &'static str, start: f64, size: f64, most: f64) -> Self {
        let size = (SEARCHED_SIZES * size.max(start.abs())).min(most);
        Self { key, start: start.clamp(-size, size), bounds: (-size, size) }
    }

    /// Positive, by decades.
    fn positive(key: &'static str, start: f64, factor: f64, most: f64) -> Self {
        Self { key, start, bounds: (start / factor, (start * factor).min(most)) }
    }
}

/// The keys of a pressure-sinkage law.
fn plate_keys(
    soil: &Document,
    plates: &[PlateCurve],
    gravity: f64,
    cohesion: f64,
) -> Vec<Searched> {
    const NAMES: [&str; 3] =
        ["pressure_sinkage.k_c", "pressure_sinkage.k_phi", "pressure_sinkage.n"];
    let value = Soil::of(soil);
    let law = match value.pressure_sinkage {
        PressureSinkage::Reece { .. } => {
            PlateLaw::Reece { cohesion, unit_weight: value.unit_weight(gravity) }
        }
        PressureSinkage::Bekker { .. } => PlateLaw::Bekker,
    };
    let most = |at: usize| value.range(NAMES[at]).map_or(f64::MAX, |range| *range.end());
    let [k_c, k_phi, n] = law.first_guess(plates);
    let exponent = Searched { key: NAMES[2], start: n, bounds: (0.3, 3.0) };
    let moduli = match law.largest_moduli(plates) {
        Some(sizes) => [(k_c, 0), (k_phi, 1)]
            .map(|(start, at)| Searched::signed(NAMES[at], start, sizes[at], most(at))),
        // Which of the two carries is open; both stay positive.
        None => [(k_c, 0), (k_phi, 1)]
            .map(|(start, at)| Searched::positive(NAMES[at], start, SEARCHED_SIZES, most(at))),
    };
    moduli.into_iter().chain([exponent]).collect()
}

/// The keys of what shears a soil.
fn shear_keys(found: &ShearStrength, curves: &[ShearCurve]) -> Vec<Searched> {
    let ShearStrength { cohesion, friction_angle, modulus } = *found;
    let most = (largest_stress(curves) * 1e-3).clamp(0.1, 100.0);
    let [c, phi, k] = SHEAR_KEYS;
    vec![
        Searched { key: c, start: (cohesion * 1e-3).min(most), bounds: (0.0, most) },
        Searched {
            key: phi,
            start: friction_angle.to_degrees().clamp(5.0, 60.0),
            bounds: (5.0, 60.0),
        },
        Searched::positive(k, modulus, SEARCHED_RISES, 1.0),
    ]
}

/// The same soil with another pressure-sinkage law, `bekker` or `reece`, and moduli of 1 to be
/// fitted.
fn with_law(soil: &Document, law: &str) -> Document {
    soil.changed(|keys| {
        let table = &mut keys["pressure_sinkage"];
        table["law"] = law.into();
        table["k_c"] = 1.0.into();
        table["k_phi"] = 1.0.into();
    })
}

/// The same soil, known to hold for the widths of some plates: over them the moduli are fitted, and
/// over them one may be negative. With one width, which says nothing of others, it is as it was.
fn with_widths(soil: &Document, plates: &[PlateCurve]) -> Document {
    let (Some(narrow), Some(wide)) = (plates.first(), plates.last()) else { return soil.clone() };
    if narrow.width == wide.width {
        return soil.clone();
    }
    let domain = soil.get("domain").cloned().unwrap_or_else(|| json!({}));
    soil.changed(|keys| {
        keys.insert("domain".to_owned(), domain);
        keys["domain"]["width_m"] = json!([narrow.width, wide.width]);
    })
}

impl BevameterFound {
    /// The results for JSON.
    #[must_use]
    pub fn results(&self) -> BevameterResults<'_> {
        BevameterResults {
            rows: &self.solved.records,
            discrepancies: &self.solved.discrepancies,
            unidentifiable: &self.solved.unidentifiable,
            sampler: &self.solved.sampler,
        }
    }
}
