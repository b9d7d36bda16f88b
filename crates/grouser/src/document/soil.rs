//! `soil/1`: a soil with the units of soil laboratories.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::{DocumentError, Problem};
use super::text::Node;
use super::uncertainty::{UncertainSoil, UncertaintySection};
use super::{Companion, Document, Kind, Overrides, not_stated, note_birthplace, told_by, unnamed};
use crate::contact::Theory;
use crate::error::ParameterError;
use crate::soil::extended::{ExitShift, Flank, Heap, SinkageGrowth};
use crate::soil::{
    Bulldozing, Exit, Extended, PressureSinkage, Rft, Shear, ShearModulus, SinkageExponent, Soil,
    StressPeak,
};

/// The largest exit-angle ratio that a soil may reach at any slip [-].
const LARGEST_EXIT_RATIO: f64 = 1.5;
/// The smallest and the largest sinkage exponent that a soil may reach at any slip [-].
const SMALLEST_EXPONENT: f64 = 0.3;
const LARGEST_EXPONENT: f64 = 3.0;
/// The smallest and the largest shear deformation modulus at zero slip angle [m].
const SMALLEST_MODULUS: f64 = 1e-4;
const LARGEST_MODULUS: f64 = 1.0;

/// A homogeneous soil: how it carries, how it shears, how it is pushed aside.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SoilDocument {
    /// Kind and version of this document.
    #[serde(default)]
    pub schema: SoilSchema,
    /// What people call it.
    #[serde(default = "unnamed")]
    pub name: String,
    /// Where the values come from.
    #[serde(default = "not_stated")]
    pub source: String,
    /// The day on which the soil was measured or observed to be like this, as 2026-11-20.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String", extend("format" = "date"))]
    pub date: Option<String>,
    /// Anything else worth knowing.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub notes: String,
    /// Values that the source does not give, each as `key: why this value`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub assumed: Vec<String>,
    /// The theory that the values were made for; without it, `ishigami`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "TheoryWord")]
    pub model: Option<TheoryWord>,
    /// Cohesion, c [kPa].
    #[schemars(range(min = 0.0, max = 100.0))]
    pub cohesion_kpa: f64,
    /// Angle of internal friction, φ [°].
    #[schemars(range(min = 5.0, max = 60.0))]
    pub friction_angle_deg: f64,
    /// Bulk density, ρ [kg/m³].
    #[schemars(range(min = 200.0, max = 4000.0))]
    pub density_kg_m3: f64,
    /// How pressure grows with sinkage.
    pub pressure_sinkage: PressureSinkageSection,
    /// Where along the arc the normal stress peaks.
    pub stress_peak: StressPeakSection,
    /// How shear stress is mobilised.
    pub shear: ShearSection,
    /// Where the wheel leaves the soil; without it, ratio = 1.0.
    #[serde(default)]
    pub exit: ExitSection,
    /// How soil pushed aside loads the flank; without it, law = "sine".
    #[serde(default)]
    pub bulldozing: BulldozingSection,
    /// Terms of the theory `extended`, for one wheel on this soil; all off without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "ExtendedSection")]
    pub extended: Option<ExtendedSection>,
    /// Constants of the theory `rft`, resistive force theory; as published without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "RftSection")]
    pub rft: Option<RftSection>,
    /// How well the numbers above are known; exactly, as far as anyone says, without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "UncertaintySection")]
    pub uncertainty: Option<UncertaintySection>,
}

/// The `schema` of a soil.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum SoilSchema {
    /// This version.
    #[default]
    #[serde(rename = "soil/1")]
    Version1,
}

/// A theory of the wheel-soil reaction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TheoryWord {
    /// Stresses along the arc (Ishigami et al. 2007).
    Ishigami,
    /// Bekker's closed form.
    Bekker,
    /// Stresses along the arc, with the terms that small wheels need.
    Extended,
    /// Resistive force theory on the wheel's facets.
    Rft,
}

impl TheoryWord {
    /// The word of a theory's name.
    pub(super) fn named(name: &str) -> Option<Self> {
        toml::Value::String(name.to_owned()).try_into().ok()
    }

    /// The theory of that name.
    #[must_use]
    pub fn theory(self) -> Theory {
        match self {
            Self::Ishigami => Theory::Ishigami,
            Self::Bekker => Theory::Bekker,
            Self::Extended => Theory::Extended,
            Self::Rft => Theory::Rft,
        }
    }
}

/// Pressure over sinkage, σ = K_σ zⁿ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case", deny_unknown_fields)]
pub enum PressureSinkageSection {
    /// K_σ = (c k_c + γ b k_phi) / bⁿ (Reece 1965).
    Reece {
        /// Cohesive modulus, k'_c [-].
        #[schemars(range(min = 0.0, max = 1e4))]
        k_c: f64,
        /// Frictional modulus, k'_φ [-].
        #[schemars(range(min = 0.0, max = 1e5))]
        k_phi: f64,
        /// Sinkage exponent at zero slip, n [-].
        #[schemars(range(min = SMALLEST_EXPONENT, max = LARGEST_EXPONENT))]
        n: f64,
        /// Growth of n with the slip ratio while driving [-].
        #[serde(default)]
        #[schemars(range(min = -3.0, max = 3.0))]
        n_per_slip: f64,
        /// Growth of n with the size of the slip ratio while skidding [-].
        #[serde(default)]
        #[schemars(range(min = -3.0, max = 3.0))]
        n_per_skid: f64,
    },
    /// K_σ = k_c/b + k_phi (Bekker 1960).
    Bekker {
        /// Cohesive modulus, k_c [N/m^(n+1)].
        #[schemars(range(min = 0.0, max = 1e9))]
        k_c: f64,
        /// Frictional modulus, k_φ [N/m^(n+2)].
        #[schemars(range(min = 0.0, max = 1e12))]
        k_phi: f64,
        /// Sinkage exponent at zero slip, n [-].
        #[schemars(range(min = SMALLEST_EXPONENT, max = LARGEST_EXPONENT))]
        n: f64,
        /// Growth of n with the slip ratio while driving [-].
        #[serde(default)]
        #[schemars(range(min = -3.0, max = 3.0))]
        n_per_slip: f64,
        /// Growth of n with the size of the slip ratio while skidding [-].
        #[serde(default)]
        #[schemars(range(min = -3.0, max = 3.0))]
        n_per_skid: f64,
    },
}

/// θ_m = (a0 + a1 |s|) θ_f.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StressPeakSection {
    /// Share of the entry angle at zero slip, a₀ [-].
    #[schemars(range(min = 0.0, max = 1.0))]
    pub a0: f64,
    /// Its growth with the slip ratio, a₁ [-].
    #[schemars(range(min = 0.0, max = 1.0))]
    pub a1: f64,
}

/// Shear stress over shear displacement (Janosi and Hanamoto 1961).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case", deny_unknown_fields)]
pub enum ShearSection {
    /// Each axis on its own, with moduli linear in the slip angle (Ishigami et al. 2007).
    Anisotropic {
        /// Modulus along the wheel at zero slip angle, K_x [m].
        #[schemars(range(min = SMALLEST_MODULUS, max = LARGEST_MODULUS))]
        longitudinal_m: f64,
        /// Its growth with the slip angle [m/rad].
        #[serde(default)]
        #[schemars(range(min = -1.0, max = 1.0))]
        longitudinal_per_rad_m: f64,
        /// Modulus across the wheel at zero slip angle, K_y [m].
        #[schemars(range(min = SMALLEST_MODULUS, max = LARGEST_MODULUS))]
        lateral_m: f64,
        /// Its growth with the slip angle [m/rad].
        #[serde(default)]
        #[schemars(range(min = -1.0, max = 1.0))]
        lateral_per_rad_m: f64,
    },
    /// Each axis on its own, with moduli quadratic in the slip angle (the laboratory's, 2007).
    AnisotropicQuadratic {
        /// Modulus along the wheel at zero slip angle, K_x [m].
        #[schemars(range(min = SMALLEST_MODULUS, max = LARGEST_MODULUS))]
        longitudinal_m: f64,
        /// Its growth with the slip angle [m/rad].
        #[serde(default)]
        #[schemars(range(min = -1.0, max = 1.0))]
        longitudinal_per_rad_m: f64,
        /// Its growth with the square of the slip angle [m/rad²].
        #[serde(default)]
        #[schemars(range(min = -1.0, max = 1.0))]
        longitudinal_per_rad2_m: f64,
        /// Modulus across the wheel at zero slip angle, K_y [m].
        #[schemars(range(min = SMALLEST_MODULUS, max = LARGEST_MODULUS))]
        lateral_m: f64,
        /// Its growth with the slip angle [m/rad].
        #[serde(default)]
        #[schemars(range(min = -1.0, max = 1.0))]
        lateral_per_rad_m: f64,
        /// Its growth with the square of the slip angle [m/rad²].
        #[serde(default)]
        #[schemars(range(min = -1.0, max = 1.0))]
        lateral_per_rad2_m: f64,
        /// The largest slip angle that the fits know; beyond it they stay [°].
        #[serde(default = "right_angle")]
        #[schemars(range(min = 0.0, max = 90.0))]
        slip_angle_limit_deg: f64,
    },
    /// One stress, against the slip velocity; never above c + σ tan φ.
    Isotropic {
        /// Modulus at zero slip angle, K [m].
        #[schemars(range(min = SMALLEST_MODULUS, max = LARGEST_MODULUS))]
        longitudinal_m: f64,
        /// Its growth with the slip angle [m/rad].
        #[serde(default)]
        #[schemars(range(min = -1.0, max = 1.0))]
        longitudinal_per_rad_m: f64,
    },
}

/// Exit-angle ratio λ: the share of the sinkage that the soil recovers behind the wheel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ExitSection {
    /// The same for every slip.
    Ratio(RatioSection),
    /// λ = at_zero + per_slip s + per_slip2 s², skid counting as s = 0, λ never below 0.
    QuadraticInSlip(QuadraticSection),
}

/// A constant λ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RatioSection {
    /// The law; may be left out.
    #[serde(default)]
    pub law: RatioWord,
    /// Exit-angle ratio, λ [-].
    #[schemars(range(min = 0.0, max = LARGEST_EXIT_RATIO))]
    pub ratio: f64,
}

/// The name of the constant exit law.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RatioWord {
    /// The same for every slip.
    #[default]
    Ratio,
}

/// A λ that follows the slip.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct QuadraticSection {
    /// The law.
    pub law: QuadraticWord,
    /// λ at zero slip [-].
    #[schemars(range(min = 0.0, max = LARGEST_EXIT_RATIO))]
    pub at_zero: f64,
    /// Its growth with the slip ratio [-].
    #[schemars(range(min = -10.0, max = 10.0))]
    pub per_slip: f64,
    /// Its growth with the square of the slip ratio [-].
    #[schemars(range(min = -10.0, max = 10.0))]
    pub per_slip2: f64,
}

/// The name of the quadratic exit law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum QuadraticWord {
    /// Quadratic in the slip ratio.
    QuadraticInSlip,
}

impl Default for ExitSection {
    fn default() -> Self {
        Self::Ratio(RatioSection { law: RatioWord::Ratio, ratio: 1.0 })
    }
}

/// How soil pushed aside loads the flank.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BulldozingSection {
    /// How that force depends on the slip angle.
    pub law: BulldozingWord,
}

/// Dependence of the bulldozing force on the slip angle β.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BulldozingWord {
    /// No such force.
    None,
    /// Full force whatever the size of β; it jumps at β = 0.
    Sign,
    /// In proportion to sin β.
    #[default]
    Sine,
    /// In proportion to sin² β, with its part along the wheel and the surcharge of piled soil.
    SineSquared,
}

/// What a small wheel's soil does beyond the classical law. Each key is off by default.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ExtendedSection {
    /// How a moving wheel sinks deeper than a plate.
    pub sinkage: SinkageGrowthSection,
    /// How the exit moves with the motion.
    pub exit: ExitShiftSection,
    /// Friction between rim and soil.
    pub rim: RimSection,
    /// The soil's load on the flank.
    pub flank: FlankSection,
    /// Soil pushed by the width of the rim.
    pub heap: HeapSection,
}

/// Sinkage growth ζ: the moving wheel meets at depth z what a plate meets at z/ζ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SinkageGrowthSection {
    /// Growth per sin β/(cos β + 0.3) [-].
    #[schemars(range(min = 0.0, max = 10.0))]
    pub with_slip_angle: f64,
    /// Growth with the slip by total speed, S/(1 − bend S) [-].
    #[schemars(range(min = 0.0, max = 20.0))]
    pub with_slip: f64,
    /// How that growth bends: above 0 it speeds up with slip, below 0 it slows down [-].
    #[schemars(range(min = -10.0, max = 0.95))]
    pub bend: f64,
    /// Growth of a locked wheel [-].
    #[schemars(range(min = 0.0, max = 20.0))]
    pub locked: f64,
    /// How much the larger of two growths hides the smaller; at 1 they add up [-].
    #[schemars(range(min = 1.0, max = 20.0))]
    pub sharpness: f64,
}

/// What is added to the exit-angle ratio λ; it stays within 0 and 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ExitShiftSection {
    /// Growth with the slip by total speed, while driving [-].
    #[schemars(range(min = -2.0, max = 2.0))]
    pub with_slip: f64,
    /// Growth with |sin β| [-].
    #[schemars(range(min = -2.0, max = 2.0))]
    pub with_slip_angle: f64,
}

/// Friction between rim and soil.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RimSection {
    /// Friction angle between rim and soil, δ, where below the soil's own [°].
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 1.0, max = 60.0))]
    pub friction_angle_deg: Option<f64>,
}

/// The soil's load on the flank.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FlankSection {
    /// Factor on the passive pressure, for the heap on it and for its ends [-].
    #[schemars(range(min = 0.0, max = 20.0))]
    pub pressure_factor: f64,
    /// How fast the load fades with slip or skid: e^(−fading |S|) [-].
    #[schemars(range(min = 0.0, max = 10.0))]
    pub fading: f64,
    /// Coefficient of friction of the side face, μ_f [-].
    #[schemars(range(min = 0.0, max = 1.0))]
    pub friction: f64,
}

/// Soil pushed by the width of the rim, as factors on b R_b(h).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct HeapSection {
    /// In front of a wheel that skids [-].
    #[schemars(range(min = 0.0, max = 20.0))]
    pub front: f64,
    /// Behind a wheel that spins [-].
    #[schemars(range(min = 0.0, max = 20.0))]
    pub behind: f64,
}

/// What resistive force theory asks of a soil beside its density and friction angle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RftSection {
    /// Factor on the stiffness that follows from density and friction angle [-].
    #[schemars(range(min = 0.01, max = 100.0))]
    pub scale: f64,
    /// Friction angle between the wheel and the soil, δ [°]; without it the soil's own.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 1.0, max = 60.0))]
    pub surface_friction_angle_deg: Option<f64>,
}

impl Default for RftSection {
    fn default() -> Self {
        Self { scale: Rft::PUBLISHED.scale, surface_friction_angle_deg: None }
    }
}

impl Default for SinkageGrowthSection {
    fn default() -> Self {
        let SinkageGrowth { with_slip_angle, with_slip, bend, locked, sharpness } =
            Extended::OFF.sinkage;
        Self { with_slip_angle, with_slip, bend, locked, sharpness }
    }
}

impl Default for ExitShiftSection {
    fn default() -> Self {
        let ExitShift { with_slip, with_slip_angle } = Extended::OFF.exit;
        Self { with_slip, with_slip_angle }
    }
}

impl Default for FlankSection {
    fn default() -> Self {
        let Flank { pressure_factor, fading, friction } = Extended::OFF.flank;
        Self { pressure_factor, fading, friction }
    }
}

impl Default for HeapSection {
    fn default() -> Self {
        let Heap { front, behind } = Extended::OFF.heap;
        Self { front, behind }
    }
}

fn right_angle() -> f64 {
    90.0
}

impl Document for SoilDocument {
    const KIND: Kind = Kind::Soil;
    type Value = Soil;

    fn to_domain(&self, tree: &Node) -> Result<Soil, DocumentError> {
        if self.date.as_deref().is_some_and(|date| !is_day(date)) {
            let problem = Problem::Conflict("`date` is no day: it is written as \"2026-11-20\"");
            return Err(DocumentError::at(tree.origin_of("date"), problem));
        }
        self.meaning().map_err(|Misfit { path, error }| {
            DocumentError::at(tree.origin_of(path), Problem::Unfit(error))
        })
    }

    fn prepare(&mut self, tree: &Node) -> Result<(), DocumentError> {
        let Some(mut uncertainty) = self.uncertainty.take() else { return Ok(()) };
        uncertainty.prepare(self, tree)?;
        self.uncertainty = Some(uncertainty);
        Ok(())
    }

    fn companions(&self) -> Vec<Companion> {
        self.uncertainty.iter().filter_map(UncertaintySection::companion).collect()
    }

    fn note(&mut self, tree: &Node, overrides: &Overrides) {
        if tree.entry("exit").is_none() {
            self.assumed.push("exit.ratio: not given; 1.0, as for Toyoura sand".to_owned());
        }
        if tree.entry("bulldozing").is_none() {
            self.assumed.push("bulldozing.law: not given; \"sine\", the smooth one".to_owned());
        }
        note_birthplace(Self::KIND, tree, overrides, &mut self.assumed);
    }

    fn assumptions(&self) -> Vec<String> {
        told_by(Self::KIND, &self.name, &self.assumed, &self.source)
    }
}

/// Whether a text is a day of the calendar, year-month-day (ISO 8601).
fn is_day(text: &str) -> bool {
    let fields: Vec<&str> = text.split('-').collect();
    let all_digits = |field: &&str| field.bytes().all(|byte| byte.is_ascii_digit());
    let lengths: Vec<usize> = fields.iter().map(|field| field.len()).collect();
    if lengths != [4, 2, 2] || !fields.iter().all(all_digits) {
        return false;
    }
    let numbers: Vec<u32> = fields.iter().filter_map(|field| field.parse().ok()).collect();
    let [year, month, day] = numbers[..] else { return false };
    let is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    let days = match month {
        1 | 3 | 5 | 7 | 8 | 10 | 12 => 31,
        4 | 6 | 9 | 11 => 30,
        2 if is_leap => 29,
        2 => 28,
        _ => 0,
    };
    (1..=days).contains(&day)
}

/// Values that are fine one by one, but not together.
pub(super) struct Misfit {
    /// The table they stand in.
    pub path: &'static str,
    /// What is wrong with them.
    pub error: ParameterError,
}

impl SoilDocument {
    /// The same soil with another pressure-sinkage law, `bekker` or `reece`, and moduli of 1 that
    /// wait to be found.
    #[must_use]
    pub fn with_law(&self, law: &str) -> Self {
        let (n, n_per_slip, n_per_skid) = match self.pressure_sinkage {
            PressureSinkageSection::Reece { n, n_per_slip, n_per_skid, .. }
            | PressureSinkageSection::Bekker { n, n_per_slip, n_per_skid, .. } => {
                (n, n_per_slip, n_per_skid)
            }
        };
        let (k_c, k_phi) = (1.0, 1.0);
        let pressure_sinkage = if law == "reece" {
            PressureSinkageSection::Reece { k_c, k_phi, n, n_per_slip, n_per_skid }
        } else {
            PressureSinkageSection::Bekker { k_c, k_phi, n, n_per_slip, n_per_skid }
        };
        Self { pressure_sinkage, ..self.clone() }
    }

    /// Leaves the numbers alone.
    pub(super) fn forget_words(&mut self) {
        self.assumed.clear();
        for text in [&mut self.name, &mut self.source, &mut self.notes] {
            text.clear();
        }
        self.uncertainty = None;
    }

    /// Whether its pressure-sinkage law is Reece's.
    #[must_use]
    pub fn follows_reece(&self) -> bool {
        matches!(self.pressure_sinkage, PressureSinkageSection::Reece { .. })
    }

    /// The soil, in SI units and radians.
    pub(super) fn meaning(&self) -> Result<Soil, Misfit> {
        let soil = Soil {
            cohesion: self.cohesion_kpa * 1e3,
            friction_angle: self.friction_angle_deg.to_radians(),
            density: self.density_kg_m3,
            pressure_sinkage: self.pressure_sinkage.to_domain(),
            stress_peak: StressPeak { a0: self.stress_peak.a0, a1: self.stress_peak.a1 },
            shear: self.shear.to_domain(),
            exit: self.exit.to_domain(),
            bulldozing: self.bulldozing.law.to_domain(),
            extended: self.extended.as_ref().map_or(Extended::OFF, ExtendedSection::to_domain),
            rft: self.rft.as_ref().map_or(Rft::PUBLISHED, RftSection::to_domain),
        };
        let at = |path: &'static str| move |error: ParameterError| Misfit { path, error };
        soil.pressure_sinkage.check(soil.cohesion).map_err(at("pressure_sinkage"))?;
        check_exponent(soil.pressure_sinkage).map_err(at("pressure_sinkage"))?;
        soil.shear.check().map_err(at("shear"))?;
        soil.extended.check().map_err(at("extended"))?;
        soil.rft.check().map_err(at("rft"))?;
        check_exit(soil.exit).map_err(at("exit"))?;
        soil.check().map_err(at("schema"))?;
        Ok(soil)
    }

    /// The soils that it may be, if it says how well it is known.
    #[must_use]
    pub fn uncertain(&self) -> Option<&UncertainSoil> {
        self.uncertainty.as_ref()?.soils()
    }

    /// Whether its uncertainty is a file of samples.
    #[must_use]
    pub fn is_sampled(&self) -> bool {
        self.uncertainty.as_ref().is_some_and(|uncertainty| uncertainty.samples.is_some())
    }

    /// The theory that the soil was made for, if it says one.
    #[must_use]
    pub fn theory(&self) -> Option<Theory> {
        self.model.map(TheoryWord::theory)
    }
}

/// That n stays in its range at every slip: it is linear, so its ends tell.
fn check_exponent(law: PressureSinkage) -> Result<(), ParameterError> {
    let (PressureSinkage::Reece { exponent, .. } | PressureSinkage::Bekker { exponent, .. }) = law;
    for slip_ratio in [-1.0, 1.0] {
        let n = exponent.at(slip_ratio);
        if !(SMALLEST_EXPONENT..=LARGEST_EXPONENT).contains(&n) {
            let name = format!("the sinkage exponent n at a slip ratio of {slip_ratio}");
            return Err(ParameterError::new(name, n, "0.3 to 3"));
        }
    }
    Ok(())
}

/// That λ stays in its range at every slip.
fn check_exit(exit: Exit) -> Result<(), ParameterError> {
    for percent in 0..=100 {
        let slip_ratio = f64::from(percent) / 100.0;
        let ratio = exit.ratio(slip_ratio);
        if ratio > LARGEST_EXIT_RATIO {
            let name = format!("the exit-angle ratio at a slip ratio of {slip_ratio}");
            return Err(ParameterError::new(name, ratio, "0 to 1.5"));
        }
    }
    Ok(())
}

impl PressureSinkageSection {
    fn to_domain(&self) -> PressureSinkage {
        let exponent_of = |n, n_per_slip, n_per_skid| SinkageExponent {
            at_zero: n,
            per_slip: n_per_slip,
            per_skid: n_per_skid,
        };
        match *self {
            Self::Reece { k_c, k_phi, n, n_per_slip, n_per_skid } => {
                let exponent = exponent_of(n, n_per_slip, n_per_skid);
                PressureSinkage::Reece { k_c, k_phi, exponent }
            }
            Self::Bekker { k_c, k_phi, n, n_per_slip, n_per_skid } => {
                let exponent = exponent_of(n, n_per_slip, n_per_skid);
                PressureSinkage::Bekker { k_c, k_phi, exponent }
            }
        }
    }
}

impl ShearSection {
    fn to_domain(&self) -> Shear {
        let linear = |at_zero, per_radian| ShearModulus::Linear { at_zero, per_radian };
        match *self {
            Self::Anisotropic {
                longitudinal_m,
                longitudinal_per_rad_m,
                lateral_m,
                lateral_per_rad_m,
            } => Shear::Anisotropic {
                longitudinal: linear(longitudinal_m, longitudinal_per_rad_m),
                lateral: linear(lateral_m, lateral_per_rad_m),
            },
            Self::AnisotropicQuadratic {
                longitudinal_m,
                longitudinal_per_rad_m,
                longitudinal_per_rad2_m,
                lateral_m,
                lateral_per_rad_m,
                lateral_per_rad2_m,
                slip_angle_limit_deg,
            } => {
                let quadratic = |at_zero, per_radian, per_radian_squared| ShearModulus::Quadratic {
                    at_zero,
                    per_radian,
                    per_radian_squared,
                    angle_limit: slip_angle_limit_deg.to_radians(),
                };
                Shear::Anisotropic {
                    longitudinal: quadratic(
                        longitudinal_m,
                        longitudinal_per_rad_m,
                        longitudinal_per_rad2_m,
                    ),
                    lateral: quadratic(lateral_m, lateral_per_rad_m, lateral_per_rad2_m),
                }
            }
            Self::Isotropic { longitudinal_m, longitudinal_per_rad_m } => {
                Shear::Isotropic { modulus: linear(longitudinal_m, longitudinal_per_rad_m) }
            }
        }
    }
}

impl ExitSection {
    fn to_domain(&self) -> Exit {
        match self {
            Self::Ratio(RatioSection { ratio, .. }) => Exit::Ratio(*ratio),
            Self::QuadraticInSlip(QuadraticSection { at_zero, per_slip, per_slip2, .. }) => {
                Exit::QuadraticInSlip {
                    at_zero: *at_zero,
                    per_slip: *per_slip,
                    per_slip_squared: *per_slip2,
                }
            }
        }
    }
}

impl ExtendedSection {
    fn to_domain(&self) -> Extended {
        let Self { sinkage, exit, rim, flank, heap } = self;
        Extended {
            sinkage: SinkageGrowth {
                with_slip_angle: sinkage.with_slip_angle,
                with_slip: sinkage.with_slip,
                bend: sinkage.bend,
                locked: sinkage.locked,
                sharpness: sinkage.sharpness,
            },
            exit: ExitShift { with_slip: exit.with_slip, with_slip_angle: exit.with_slip_angle },
            rim_friction_angle: rim.friction_angle_deg.map(f64::to_radians),
            flank: Flank {
                pressure_factor: flank.pressure_factor,
                fading: flank.fading,
                friction: flank.friction,
            },
            heap: Heap { front: heap.front, behind: heap.behind },
        }
    }
}

impl RftSection {
    fn to_domain(&self) -> Rft {
        let surface_friction_angle = self.surface_friction_angle_deg.map(f64::to_radians);
        Rft { scale: self.scale, surface_friction_angle }
    }
}

impl BulldozingWord {
    fn to_domain(self) -> Bulldozing {
        match self {
            Self::None => Bulldozing::None,
            Self::Sign => Bulldozing::Sign,
            Self::Sine => Bulldozing::Sine,
            Self::SineSquared => Bulldozing::SineSquared,
        }
    }
}
