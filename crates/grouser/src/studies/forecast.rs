//! A rover's slip, drift, heading, steepest slope and power under another gravity than the one its
//! soil was measured under, on each ground that the site may have, and an error budget for each.
//!
//! Nobody has measured a wheel on the ground of the site, so that a forecast rests on choices that
//! no sample of the soil decides. Two of them are not averaged over: which [`Ground`] the site has,
//! and whether moduli are carried by a law that something [supports](Support). Each ground has a
//! forecast of its own, and another one with the laws that no measurement supports. It is the same,
//! bit for bit, as if that ground alone were asked for.
//!
//! All else is a [factor](FactorKind) within a ground: what the rover weighs, the wheel–soil model,
//! the samples of the soil, what a model gets wrong, and how moduli scale. Every level meets every
//! level of the others: a full [`factorial`](super::ensemble::factorial) design, on which the parts
//! of a variance add up.
//!
//! Levels of one factor count alike, models by their [shares](super::ensemble::models). A budget is
//! of quantities that every case has: the slip ratio of a contour traverse (1 where no heading
//! holds the contour), the drift with the nose on the contour (1, straight downhill, where the
//! rover slides), and the steepest slope (0 where it cannot drive on level ground). Bands are over
//! all cases of the ground: a case without a heading needs more of it, and more power, than any
//! number.

mod case;
mod choices;
mod error;
mod factor;
mod ground_study;
mod support;

use self::case::known;
pub use self::choices::{Choices, Ground, RoverMass, SiteSoil};
pub use self::error::ForecastError;
pub use self::factor::{Factor, FactorKind, Level, REMEDY_OF_INTERACTIONS};
use self::ground_study::GroundStudy;
pub use self::support::Support;
use super::ensemble::factorial::{Factorial, VarianceBudget};
use super::ensemble::samples::{BandInputs, Sample};
use super::ensemble::statistics::Estimate;
use super::ensemble::{Band, NothingAccepted, outputs_while};
use super::heading::{HeadingStudy, STUCK};
use crate::contact::validity::Finding;
use crate::error::{ParameterError, positive};
use crate::soil::GravityScaling;

/// What a forecast is made for.
#[derive(Clone, Debug)]
pub struct ForecastStudy {
    /// Rover, soil as its document has it, gravity of the site, model and load transfer.
    pub heading: HeadingStudy,
    /// Gravity under which the soil's constants were measured, *g₀* [m/s²].
    pub measured_under: f64,
    /// Rim speed ω r_s [m/s], for the power.
    pub rim_speed: f64,
    /// Slip ratio of which a forecast says how probably it is exceeded [-].
    pub no_go_slip_ratio: f64,
    /// What no sample decides.
    pub choices: Choices,
    /// How many samples there are of the soil and, each with each, of what a model gets wrong.
    pub samples: [u32; 2],
    /// Seed of the samples.
    pub seed: u64,
}

/// A forecast.
#[derive(Clone, Debug, PartialEq)]
pub struct Forecast {
    /// Each ground in its order, by the scalings that something supports; then each by those that
    /// no measurement supports.
    pub grounds: Vec<GroundForecast>,
    /// What tests where the soil was measured would show.
    pub tests: Vec<TestForecast>,
}

/// A forecast on one ground.
#[derive(Clone, Debug, PartialEq)]
pub struct GroundForecast {
    /// The ground's name.
    pub ground: String,
    /// How moduli scale in its cases.
    pub scalings: Vec<GravityScaling>,
    /// What it rests on.
    pub support: Support,
    /// The factors with their levels, those of one level too.
    pub factors: Vec<Factor>,
    /// On each slope that was asked for, in that order.
    pub slopes: Vec<SlopeForecast>,
    /// Steepest slope on which a heading holds the contour [rad]; 0 where the rover cannot drive on
    /// level ground.
    pub limit: Option<Band>,
    /// The same in parts.
    pub limit_budget: VarianceBudget,
    /// The mean of the same at each level of each factor.
    pub limit_means: Vec<Vec<f64>>,
    /// How many cases there are.
    pub cases: usize,
}

/// A forecast on one slope of a ground.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeForecast {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// Probability that a rover on a contour traverse slips more than the limit, or that no heading
    /// holds the contour [-].
    pub slip_above_limit: Estimate,
    /// Probability that no heading holds the contour [-].
    pub no_heading: Estimate,
    /// Yaw, *γ* [rad], positive uphill; above every number where no heading holds the contour.
    pub yaw: Option<Band>,
    /// Slip ratio of every wheel on a contour traverse, *s* [-]; 1 where no heading holds the
    /// contour.
    pub slip_ratio: Option<Band>,
    /// Mean sinkage of the wheels [m]; down to the axles where no heading holds the contour.
    pub sinkage: Option<Band>,
    /// Drift per metre with the nose on the contour [-]; 1 where the rover slides.
    pub drift: Option<Band>,
    /// Mechanical power of the motors [W]; above every number where no heading holds the contour.
    pub power: Option<Band>,
    /// Work of the wheels per metre along the contour [J/m], likewise.
    pub energy_per_metre: Option<Band>,
    /// The slip ratio in parts.
    pub slip_budget: VarianceBudget,
    /// The drift in parts.
    pub drift_budget: VarianceBudget,
    /// The mean slip ratio at each level of each factor.
    pub slip_means: Vec<Vec<f64>>,
    /// The mean drift at each level of each factor.
    pub drift_means: Vec<Vec<f64>>,
    /// The share with a heading at each level of each factor.
    pub level_means: Vec<Vec<f64>>,
    /// The flags of the ground as written, with the first level of every choice.
    pub findings: Vec<Finding>,
}

/// What a test of a rover would show on the soil, and under the gravity, that was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct TestForecast {
    /// The rover's mass there, over that of its document.
    pub mass: RoverMass,
    /// On each slope: its slip ratio, and the share of the cases in which a heading holds the
    /// contour.
    pub slopes: Vec<(Option<Band>, f64)>,
}

impl ForecastStudy {
    /// Computes the forecast. Cases are shared among threads and keep their order: the result is
    /// the same for any number of threads. Case *i* depends on the study and on *i* alone.
    ///
    /// How much of what is not known of a slip on the Moon is due to how moduli scale, on a sand
    /// without cohesion?
    ///
    /// ```
    /// use grouser::document::{self, Overrides, Source};
    /// use grouser::soil::GravityScaling;
    /// use grouser::studies::ensemble::samples::BandInputs;
    /// use grouser::studies::forecast::{Choices, ForecastStudy};
    /// use grouser::studies::heading::HeadingStudy;
    /// use grouser::units::{EARTH_GRAVITY, deg};
    ///
    /// let overrides = Overrides::parse(["scenario.gravity_m_s2=1.62", "scenario.model=ishigami"])?;
    /// let scenario = document::read_scenario(&Source::default_scenario(), &overrides)?;
    /// let study = ForecastStudy {
    ///     heading: HeadingStudy::of(&scenario.value),
    ///     measured_under: EARTH_GRAVITY,
    ///     rim_speed: 0.06,
    ///     no_go_slip_ratio: 0.6,
    ///     choices: Choices::of_scalings(GravityScaling::ALL),
    ///     samples: [4, 2],
    ///     seed: 1,
    /// };
    /// let band = BandInputs::of_scenario(&scenario);
    /// let forecast = study.run(&band, &[deg(10.0)], &|| true)?.expect("not stopped");
    /// let [supported, kept] = &forecast.grounds[..] else { panic!("Bekker's moduli stand apart") };
    /// let means = &supported.slopes[0].slip_means[4];
    /// assert_eq!(means[0], means[1], "without cohesion unit weight and granular scaling are one");
    /// let stiff = kept.slopes[0].slip_means[4][0];
    /// assert!(stiff > means[0], "stiffer ground has shorter contacts, which mobilise less shear");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// * `band`: soils and models, as of the scenario
    /// * `slopes`: [rad]
    /// * `go_on`: asked before each of the [`steps`](Self::steps), from any thread; without it
    ///   there is no result
    ///
    /// # Errors
    /// [`ForecastError`] for values out of range, and for the first soil that cannot be drawn or
    /// computed with.
    pub fn run(
        &self,
        band: &BandInputs,
        slopes: &[f64],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Forecast>, ForecastError> {
        positive("rim speed [m/s]", self.rim_speed)?;
        let limit = self.no_go_slip_ratio;
        if !(0.0..=1.0).contains(&limit) {
            return Err(ParameterError::new("the no-go slip ratio", limit, "0 to 1").into());
        }
        self.choices.check()?;
        let mut grounds = Vec::new();
        for ground in self.grounds(band) {
            let Some(found) = ground.forecast(slopes, go_on)? else { return Ok(None) };
            grounds.push(found);
        }
        let tests = self.tests(band, slopes, go_on)?;
        Ok(tests.map(|tests| Forecast { grounds, tests }))
    }

    /// How often [`run`](Self::run) asks whether to go on.
    #[must_use]
    pub fn steps(&self, band: &BandInputs) -> usize {
        let groups: usize = self.grounds(band).iter().map(GroundStudy::groups).sum();
        groups + self.test_masses().len() * design_of(&self.sampled(band, None)).cases()
    }

    /// How many cases there are on all grounds.
    #[must_use]
    pub fn cases(&self, band: &BandInputs) -> usize {
        self.grounds(band).iter().map(|it| it.groups() * it.scalings.len()).sum()
    }

    /// Each ground with the scalings that something supports, then with the others.
    fn grounds<'s>(&'s self, band: &'s BandInputs) -> Vec<GroundStudy<'s>> {
        let Choices { grounds, scalings, .. } = &self.choices;
        let is_away = self.heading.gravity != self.measured_under;
        let has_none = |it: &GravityScaling| is_away && *it == GravityScaling::Bekker;
        let (none, some): (Vec<_>, Vec<_>) = scalings.iter().copied().partition(has_none);
        let apart = [(some, false), (none, true)].into_iter().filter(|(it, _)| !it.is_empty());
        let on = |ground: &'s Ground, scalings: &[GravityScaling], has_no_law: bool| {
            let strength = Support::of(ground, self.measured_under, self.heading.gravity);
            let support = if has_no_law { Support::None } else { strength };
            GroundStudy { study: self, band, ground, scalings: scalings.to_vec(), support }
        };
        let on_all = |(scalings, has_no_law): (Vec<GravityScaling>, bool)| {
            grounds.iter().map(move |ground| on(ground, &scalings, has_no_law))
        };
        apart.flat_map(on_all).collect()
    }

    /// Models, samples of the soil and of what a model gets wrong: one sample where there is
    /// nothing to draw.
    ///
    /// * `ground`: `None` where the soil was measured
    fn sampled(&self, band: &BandInputs, ground: Option<&Ground>) -> [Factor; 3] {
        let [soils, discrepancies] = self.samples;
        let is_open = band.has_soils() || ground.is_some_and(Ground::is_uncertain);
        let soils = if is_open { soils } else { 1 };
        let discrepancies = if band.has_soils() { discrepancies } else { 1 };
        [
            Factor::of_models(band.models()),
            Factor::numbered(FactorKind::SoilParameters, soils),
            Factor::numbered(FactorKind::ModelDiscrepancy, discrepancies),
        ]
    }

    /// Model and soil at levels of model, soil and discrepancy, as under the gravity of the
    /// measurement.
    fn sample(&self, band: &BandInputs, levels: &[usize]) -> Result<Sample, NothingAccepted> {
        let (model, _) = &band.models().shares()[levels[0]];
        band.crossed(model.clone(), self.seed, [levels[1] as u64, levels[2] as u64])
    }

    /// Rovers that could be tested where the soil was measured: as heavy as the first of the
    /// choices, and lightened so that they weigh there what it weighs at the site. None where
    /// gravity is the same.
    fn test_masses(&self) -> Vec<RoverMass> {
        let q = self.heading.gravity / self.measured_under;
        if q == 1.0 {
            return Vec::new();
        }
        let factor = self.choices.masses.first().map_or(1.0, |mass| mass.factor);
        let named = |name: &str, factor| RoverMass { name: name.to_owned(), factor };
        vec![named("equal-mass", factor), named("equal-weight", factor * q)]
    }

    /// What tests show where the soil was measured, over models and samples.
    fn tests(
        &self,
        band: &BandInputs,
        slopes: &[f64],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Vec<TestForecast>>, ForecastError> {
        let design = design_of(&self.sampled(band, None));
        let mut tests = Vec::new();
        for mass in self.test_masses() {
            let rover = self.heading.rover.with_mass_factor(mass.factor)?;
            let here = HeadingStudy { rover, gravity: self.measured_under, ..self.heading.clone() };
            let one = |case: usize| -> Result<Vec<Option<f64>>, ForecastError> {
                let sample = self.sample(band, &design.levels(case))?;
                let curve = here.of_sample(&sample).curve()?;
                let slip = |slope: &f64| known(curve.at(*slope)).map(|it| Some(it?.slip_ratio));
                slopes.iter().map(slip).collect()
            };
            let Some(found) = outputs_while(0..design.cases(), go_on, one) else { return Ok(None) };
            let found = found.into_iter().collect::<Result<Vec<_>, _>>()?;
            let on_slope = |place: usize| {
                let slips = |stuck: f64| -> Vec<f64> {
                    found.iter().map(|it| it[place].unwrap_or(stuck)).collect()
                };
                let is_held = |it: &Vec<Option<f64>>| f64::from(u8::from(it[place].is_some()));
                let held: Vec<f64> = found.iter().map(is_held).collect();
                (Band::of(design.repeated(&slips(STUCK))), design.mean(&held))
            };
            tests.push(TestForecast { mass, slopes: (0..slopes.len()).map(on_slope).collect() });
        }
        Ok(Some(tests))
    }
}

/// Every level of each factor with every level of the others.
fn design_of(factors: &[Factor]) -> Factorial {
    Factorial::new(factors.iter().map(Factor::counts).collect())
}

impl Forecast {
    /// Whether a ground is among those that are answered first: with the scalings that something
    /// supports, if there are any.
    #[must_use]
    pub fn is_first(&self, ground: &GroundForecast) -> bool {
        self.grounds.first().is_some_and(|it| it.scalings == ground.scalings)
    }
}

impl GroundForecast {
    /// The place of a factor.
    #[must_use]
    pub fn place(&self, kind: FactorKind) -> Option<usize> {
        self.factors.iter().position(|factor| factor.kind == kind)
    }
}
