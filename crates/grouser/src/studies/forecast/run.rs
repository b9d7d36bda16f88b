//! Computes a forecast, ground by ground.

use super::case::known;
use super::choices::{Choices, Ground, RoverMass};
use super::error::ForecastError;
use super::ground_study::GroundStudy;
use super::result::{Forecast, TestForecast};
use super::study::{ForecastStudy, design_of};
use super::support::Support;
use crate::error::{ParameterError, positive};
use crate::soil::GravityScaling;
use crate::studies::ensemble::samples::BandInputs;
use crate::studies::ensemble::{Band, outputs_while};
use crate::studies::heading::{HeadingStudy, STUCK};

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
