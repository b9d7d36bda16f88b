//! A calibration on plate tests, from documents to documents: the moduli of a pressure-sinkage law.

use serde::Serialize;

use super::super::Described;
use super::super::{Document, FitKey, SAMPLES_FILE, SoilFamily};
use super::{DiscrepancyRecord, ParameterRecord, SamplerRecord, Solved};
use crate::soil::{PressureSinkage, Soil};
use crate::studies::calibration::plate_test::PlatePoint;
use crate::studies::calibration::{
    Calibration, CalibrationError, FitSettings, Observer, ParameterSpace, PlateCurve, PlateLaw,
    PlateTest, Sampling,
};

/// With one width only the sum of the law's two terms is identifiable; no sampler is needed to find that out.
const ONE_WIDTH: &str = "soil.pressure_sinkage.k_c and soil.pressure_sinkage.k_phi are not \
                         separately identifiable from plates of one width: test a second one";

/// The inputs of a calibration on plate tests.
#[derive(Clone, Debug)]
pub struct PlateProblem {
    soil: Document,
    law: PlateLaw,
    curves: Vec<PlateCurve>,
    family: SoilFamily,
}

/// The results of a calibration on plate tests.
#[derive(Clone, Debug)]
pub struct PlateFound {
    /// Parameters, samples, unidentifiable parameters.
    pub solved: Solved,
    /// The soil of the fit.
    pub soil: Document,
}

/// The same as JSON.
#[derive(Clone, Debug, Serialize)]
pub struct PlateResults<'a> {
    rows: &'a [ParameterRecord],
    discrepancies: &'a [DiscrepancyRecord],
    #[serde(rename = "cannot_tell_apart")]
    unidentifiable: &'a [String],
    sampler: &'a Option<SamplerRecord>,
}

/// A point of a curve, measured and with the fit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PlateRecord {
    /// Width of the plate [mm].
    pub plate_width_mm: f64,
    /// Sinkage [mm].
    pub sinkage_mm: f64,
    /// Pressure, measured [kPa].
    pub measured_pressure_kpa: f64,
    /// Pressure with the fit [kPa].
    pub pressure_kpa: f64,
}

impl PlateProblem {
    /// Curves, and the soil for all values that are not fitted.
    ///
    /// * `law`: `bekker` or `reece`; the soil's own without
    /// * `gravity`: *g* [m/s²]
    ///
    /// # Errors
    /// A sentence, if the law's keys cannot be fitted.
    pub fn new(
        soil: &Document,
        law: Option<&str>,
        gravity: f64,
        curves: Vec<PlateCurve>,
    ) -> Result<Self, String> {
        let soil = law.map_or_else(|| soil.clone(), |law| with_law(soil, law));
        let value = Soil::of(&soil);
        let law = match value.pressure_sinkage {
            PressureSinkage::Reece { .. } => PlateLaw::Reece {
                cohesion: value.cohesion,
                unit_weight: value.unit_weight(gravity),
            },
            PressureSinkage::Bekker { .. } => PlateLaw::Bekker,
        };
        let key = |name: &&str| FitKey { path: format!("pressure_sinkage.{name}"), bounds: None };
        let keys: Vec<FitKey> = PlateLaw::PARAMETERS.iter().map(key).collect();
        let family = SoilFamily::around(&soil, &keys, &law.first_guess(&curves))?;
        Ok(Self { soil, law, curves, family })
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

    /// The curves.
    #[must_use]
    pub fn curves(&self) -> &[PlateCurve] {
        &self.curves
    }

    /// Calibrates.
    ///
    /// * `file`: name of the curves' file, for the soil's source
    /// * `sampling`: of the posterior; least squares alone without
    ///
    /// # Errors
    /// [`CalibrationError`] for curves that do not determine the law, and if the observer stopped it.
    pub fn solve(
        &self,
        file: &str,
        sampling: Option<Sampling>,
        observer: &dyn Observer,
    ) -> Result<PlateFound, CalibrationError> {
        let test = PlateTest::new(self.law, self.curves.clone())?;
        let space = ParameterSpace::new(self.family.parameters().to_vec())?;
        let calibration = Calibration::new(&test, space)?;
        let fit = calibration.search(&FitSettings::default(), observer)?;
        let solution = calibration.solve(fit, sampling, observer)?;
        let mut solved = Solved::new(self.family.parameters(), solution);
        if test.widths() < 2 {
            solved.unidentifiable.insert(0, ONE_WIDTH.to_owned());
        }
        Ok(PlateFound { soil: self.fitted(file, &solved), solved })
    }

    /// The curves beside the fit, point by point.
    #[must_use]
    pub fn records(&self, found: &PlateFound) -> Vec<PlateRecord> {
        let points = self.curves.iter().flat_map(|it| it.points.iter().map(|one| (it.width, one)));
        let record = |((width, point), pressure): ((f64, &PlatePoint), &f64)| PlateRecord {
            plate_width_mm: (width * 1e6).round() / 1e3,
            sinkage_mm: point.sinkage * 1e3,
            measured_pressure_kpa: point.pressure * 1e-3,
            pressure_kpa: pressure * 1e-3,
        };
        points.zip(&found.solved.solution.fit.predictions).map(record).collect()
    }

    fn fitted(&self, file: &str, solved: &Solved) -> Document {
        let points: usize = self.curves.iter().map(|curve| curve.points.len()).sum();
        let source = format!(
            "pressure_sinkage fitted by Grouser {} to {file} ({points} points of {} plates)",
            env!("CARGO_PKG_VERSION"),
            self.curves.len()
        );
        let samples = solved.solution.posterior.as_ref().map(|_| SAMPLES_FILE);
        // Plates know no wheel: the soil keeps the model that it was made for, if any.
        self.family.fitted(&solved.solution.fit.values, &source, self.soil.model(), samples)
    }
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

impl PlateFound {
    /// The results for JSON.
    #[must_use]
    pub fn results(&self) -> PlateResults<'_> {
        PlateResults {
            rows: &self.solved.records,
            discrepancies: &self.solved.discrepancies,
            unidentifiable: &self.solved.unidentifiable,
            sampler: &self.solved.sampler,
        }
    }
}
