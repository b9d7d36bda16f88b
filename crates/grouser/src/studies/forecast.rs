//! A rover's slip, drift, heading, steepest slope and power under another gravity than the one its
//! soil was measured under, and one error budget.
//!
//! Nobody has measured a wheel on the ground of the site, so that a forecast rests on choices that
//! no sample of the soil decides. Each of them is a [factor](FactorKind) with named levels: how
//! moduli scale with gravity, what the ground of the site is, what the rover weighs. Every level
//! meets every level of the others, every wheel–soil model, every sample of the soil and every
//! sample of what a model gets wrong: a full [`factorial`](super::ensemble::factorial) design, on
//! which the parts of a variance add up.
//!
//! Levels of one factor count alike, models by their [shares](super::ensemble::models). A budget is
//! of quantities that every case has: the slip ratio of a contour traverse (1 where no heading
//! holds the contour), the drift with the nose on the contour (1, straight downhill, where the
//! rover slides), and the steepest slope (0 where it cannot drive on level ground). Bands are over
//! all cases: a case without a heading needs more of it, and more power, than any number.

mod case;
mod choices;
mod error;
mod factor;

use self::case::{OfCase, known};
use self::choices::with_strength_of;
pub use self::choices::{Choices, Ground, RoverMass, SiteSoil};
pub use self::error::ForecastError;
pub use self::factor::{Factor, FactorKind, Level, REMEDY_OF_INTERACTIONS};
use super::ensemble::factorial::{Factorial, VarianceBudget};
use super::ensemble::samples::{BandInputs, Sample};
use super::ensemble::{Band, NothingAccepted, outputs_while};
use super::heading::{HeadingStudy, STUCK};
use crate::contact::validity::{Finding, Flag};
use crate::error::positive;
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
    /// What tests where the soil was measured would show.
    pub tests: Vec<TestForecast>,
}

/// A forecast on one slope.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeForecast {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// Share of the cases in which a heading holds the contour [-].
    pub level: f64,
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
    /// The flags of the soil as written, with the first level of every choice.
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
    ///     choices: Choices::of_scalings(GravityScaling::ALL),
    ///     samples: [4, 2],
    ///     seed: 1,
    /// };
    /// let band = BandInputs::of_scenario(&scenario);
    /// let forecast = study.run(&band, &[deg(10.0)], &|| true)?.expect("not stopped");
    /// let means = &forecast.slopes[0].slip_means[5];
    /// assert_eq!(means[0], means[2], "without cohesion unit weight and granular scaling are one");
    /// assert!(means[1] > means[0], "stiffer ground has shorter contacts, which mobilise less shear");
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
        self.choices.check()?;
        let factors = self.factors(band);
        let counts = |factor: &Factor| factor.levels.iter().map(|level| level.count).collect();
        let design = Factorial::new(factors.iter().map(counts).collect());
        let scalings = self.choices.scalings.len();
        let groups = 0..design.cases() / scalings;
        // The scaling varies fastest: the cases of a group differ in it alone.
        let one = |group: usize| self.group(band, &design.levels(group * scalings), slopes);
        let Some(found) = outputs_while(groups, go_on, one) else { return Ok(None) };
        // In order, so that the error is always that of the first case.
        let found = found.into_iter().collect::<Result<Vec<Vec<OfCase>>, _>>()?;
        let cases: Vec<OfCase> = found.into_iter().flatten().collect();
        let Some(tests) = self.tests(band, slopes, go_on)? else { return Ok(None) };
        let findings = self.findings(slopes)?;
        Ok(Some(Forecast::over(factors, &design, &cases, tests, (slopes, findings))))
    }

    /// How often [`run`](Self::run) asks whether to go on.
    #[must_use]
    pub fn steps(&self, band: &BandInputs) -> usize {
        let levels = self.factors(band).into_iter();
        let cases: usize = levels.map(|factor| factor.levels.len()).product();
        let [soils, discrepancies] = self.sample_counts(band);
        let samples = band.models().shares().len() * (soils * discrepancies) as usize;
        cases / self.choices.scalings.len() + self.test_masses().len() * samples
    }

    /// All factors with their levels; the scaling last.
    #[must_use]
    pub fn factors(&self, band: &BandInputs) -> Vec<Factor> {
        let [soils, discrepancies] = self.sample_counts(band);
        let Choices { grounds, masses, scalings } = &self.choices;
        vec![
            Factor::named(FactorKind::Ground, grounds.iter().map(Ground::name)),
            Factor::named(FactorKind::RoverMass, masses.iter().map(|mass| mass.name.as_str())),
            Factor::of_models(band.models()),
            Factor::numbered(FactorKind::SoilParameters, soils),
            Factor::numbered(FactorKind::ModelDiscrepancy, discrepancies),
            Factor::named(FactorKind::GravityScaling, scalings.iter().map(|it| it.name())),
        ]
    }

    /// How many samples there are of soils and of discrepancies: one where there is nothing to
    /// draw.
    fn sample_counts(&self, band: &BandInputs) -> [u32; 2] {
        let [soils, discrepancies] = self.samples;
        let is_open = self.choices.grounds.iter().any(Ground::is_uncertain);
        let soils = if band.has_soils() || is_open { soils } else { 1 };
        [soils, if band.has_soils() { discrepancies } else { 1 }]
    }

    /// The cases of all scalings, at levels of the other factors. Soils that come out alike are
    /// computed once.
    fn group(
        &self,
        band: &BandInputs,
        levels: &[usize],
        slopes: &[f64],
    ) -> Result<Vec<OfCase>, ForecastError> {
        let Choices { grounds, masses, scalings } = &self.choices;
        let sample = self.sample(band, &levels[2..5])?;
        let ground = grounds[levels[0]].drawn(self.seed, levels[3] as u64)?;
        let rover = self.heading.rover.with_mass_factor(masses[levels[1]].factor)?;
        let study = HeadingStudy { rover, ..self.heading.of_sample(&sample) };
        let mut found: Vec<(HeadingStudy, OfCase)> = Vec::new();
        for scaling in scalings {
            // The strength of the site's ground is known there: nothing of it is scaled.
            let scaled = study.soil.under(study.gravity, self.measured_under, *scaling)?;
            let study = HeadingStudy { soil: with_strength_of(scaled, ground), ..study.clone() };
            let same = found.iter().find(|(other, _)| *other == study);
            let case = match same {
                Some((_, case)) => case.clone(),
                None => OfCase::of(&study, self.rim_speed, slopes)?,
            };
            found.push((study, case));
        }
        Ok(found.into_iter().map(|(_, case)| case).collect())
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
        let factors = self.factors(band);
        let counts = |factor: &Factor| factor.levels.iter().map(|level| level.count).collect();
        let design = Factorial::new(factors[2..5].iter().map(counts).collect());
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

    /// The flags on each slope of the soil as written, with the first level of every choice.
    fn findings(&self, slopes: &[f64]) -> Result<Vec<Vec<Finding>>, ForecastError> {
        let Choices { grounds, masses, scalings } = &self.choices;
        let (HeadingStudy { soil, gravity, .. }, measured) = (&self.heading, self.measured_under);
        let scaling = scalings.first().copied().unwrap_or(GravityScaling::Reece);
        let scaled = soil.under(*gravity, measured, scaling)?;
        let soil = with_strength_of(scaled, grounds.first().and_then(Ground::as_written));
        let factor = masses.first().map_or(1.0, |mass| mass.factor);
        let rover = self.heading.rover.with_mass_factor(factor)?;
        let curve = HeadingStudy { rover, soil, ..self.heading.clone() }.curve()?;
        // Bekker's moduli that were scaled are no more under another gravity than they were made
        // for.
        let is_kept = scalings.contains(&GravityScaling::Bekker);
        let holds = |finding: &Finding| is_kept || finding.flag != Flag::BekkerGravity;
        let on_slope = |slope: &f64| {
            let findings = curve.findings(*slope, &curve.at(*slope));
            findings.into_iter().filter(holds).collect()
        };
        Ok(slopes.iter().map(on_slope).collect())
    }
}

impl Forecast {
    fn over(
        factors: Vec<Factor>,
        design: &Factorial,
        cases: &[OfCase],
        tests: Vec<TestForecast>,
        (slopes, findings): (&[f64], Vec<Vec<Finding>>),
    ) -> Self {
        let limits: Vec<f64> = cases.iter().map(|case| case.limit).collect();
        let on_slope = |((place, slope), findings): ((usize, &f64), Vec<Finding>)| {
            SlopeForecast::over(design, cases, place, (*slope, findings))
        };
        Self {
            slopes: slopes.iter().enumerate().zip(findings).map(on_slope).collect(),
            limit: Band::of(design.repeated(&limits)),
            limit_budget: design.budget(&limits),
            limit_means: means(design, &factors, &limits),
            cases: cases.len(),
            factors,
            tests,
        }
    }

    /// The place of a factor.
    #[must_use]
    pub fn place(&self, kind: FactorKind) -> Option<usize> {
        self.factors.iter().position(|factor| factor.kind == kind)
    }
}

impl SlopeForecast {
    fn over(
        design: &Factorial,
        cases: &[OfCase],
        place: usize,
        (slope, findings): (f64, Vec<Finding>),
    ) -> Self {
        let of = |of: &dyn Fn(&case::OnSlope) -> f64| -> Vec<f64> {
            cases.iter().map(|case| of(&case.slopes[place])).collect()
        };
        let band = |values: &[f64]| Band::of(design.repeated(values));
        let (slips, drifts) = (of(&|it| it.slip_ratio), of(&|it| it.drift));
        let held = of(&|it| f64::from(u8::from(it.yaw.is_finite())));
        let all = |outputs: &[f64]| -> Vec<Vec<f64>> {
            (0..design.levels(0).len()).map(|factor| design.means(factor, outputs)).collect()
        };
        Self {
            slope,
            level: design.mean(&held),
            yaw: band(&of(&|it| it.yaw)),
            slip_ratio: band(&slips),
            sinkage: band(&of(&|it| it.sinkage)),
            drift: band(&drifts),
            power: band(&of(&|it| it.power)),
            energy_per_metre: band(&of(&|it| it.energy_per_metre)),
            slip_budget: design.budget(&slips),
            drift_budget: design.budget(&drifts),
            slip_means: all(&slips),
            drift_means: all(&drifts),
            level_means: all(&held),
            findings,
        }
    }
}

/// The mean output at each level of each factor.
fn means(design: &Factorial, factors: &[Factor], outputs: &[f64]) -> Vec<Vec<f64>> {
    (0..factors.len()).map(|factor| design.means(factor, outputs)).collect()
}
