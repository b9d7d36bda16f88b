//! The operator's card: for each slope, the heading that holds the contour, slip and power there, the drift without
//! it, and a verdict to go or not.
//!
//! Every number has a band over samples of soil and model, and a slope is judged by the share of them in which a
//! heading holds the contour at an acceptable slip. Where the soil's own uncertainty is not stated, the samples
//! differ by their models alone, and a slope is judged as if it were steeper by a margin. Without samples there is
//! one curve and no band, with the same margin.
//! The [`Rule`] is the caller's; a verdict never gets better on a steeper slope.

use super::ensemble::samples::{Sample, outputs_of_samples};
use super::ensemble::{Band, Probability};
use super::heading::{HeadingCurve, HeadingOffset, HeadingStudy};
use crate::contact::validity::Finding;
use crate::error::ParameterError;

/// Whether to drive on a slope.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Drive.
    Go,
    /// Drive only after a second check: measured slip, a stop on the way, a person's decision.
    Caution,
    /// Do not drive.
    NoGo,
}

/// The limits of the verdicts. Source of all numbers: ours; a mission has its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// Go: a contour traverse exists and slips at most this much [-] …
    pub go_slip_ratio: f64,
    /// … in at least this share of the samples [-].
    pub go_probability: f64,
    /// No-go: a contour traverse exists and slips at most this much [-] …
    pub no_go_slip_ratio: f64,
    /// … in less than this share of the samples [-].
    pub no_go_probability: f64,
    /// Without stated uncertainty a slope is judged as if it were steeper by this [rad].
    pub margin: f64,
}

impl Rule {
    /// Slip 0.3: rims go 1.4 times the way, and thrust still grows with slip. 0.95: the share of a
    /// 95 % band.
    /// Slip 0.6: rims go 2.5 times the way, and thrust hardly grows any more: nothing is left to
    /// get out with. 0.8: on one soil in five no heading holds the contour.
    /// 5°: about as far as the stated deviations of Toyoura sand move the steepest slope down.
    pub const DEFAULT: Self = Self {
        go_slip_ratio: 0.3,
        go_probability: 0.95,
        no_go_slip_ratio: 0.6,
        no_go_probability: 0.8,
        margin: 5.0 * std::f64::consts::PI / 180.0,
    };

    /// Checks that no slope can be both a go and a no-go.
    ///
    /// # Errors
    /// [`ParameterError`] for shares and slip ratios outside 0 to 1, a go that asks for less than
    /// a no-go, and a margin outside 0 to π/3.
    pub fn check(&self) -> Result<(), ParameterError> {
        let within = |name: &str, value: f64, most: f64, expected: &'static str| {
            let inside = (0.0..=most).contains(&value);
            inside.then_some(()).ok_or_else(|| ParameterError::new(name, value, expected))
        };
        let (slip, share) = (self.no_go_slip_ratio, self.go_probability);
        within("the no-go slip ratio", slip, 1.0, "0 to 1")?;
        within("the go slip ratio", self.go_slip_ratio, slip, "0 to the no-go slip ratio")?;
        within("the go probability", share, 1.0, "0 to 1")?;
        let most = "0 to the go probability";
        within("the no-go probability", self.no_go_probability, share, most)?;
        within("the margin [rad]", self.margin, std::f64::consts::FRAC_PI_3, "0 to π/3")
    }

    /// The verdict on a slope.
    ///
    /// * `slips`: slip ratio of the contour traverse in each sample, `None` where no heading holds the contour
    fn verdict(&self, slips: &[Option<f64>]) -> Verdict {
        let share_within = |most: f64| {
            let count = slips.iter().flatten().filter(|slip| **slip <= most).count();
            count as f64 / slips.len() as f64
        };
        if share_within(self.go_slip_ratio) >= self.go_probability {
            Verdict::Go
        } else if share_within(self.no_go_slip_ratio) < self.no_go_probability {
            Verdict::NoGo
        } else {
            Verdict::Caution
        }
    }
}

/// The inputs of a card.
#[derive(Clone, Debug, PartialEq)]
pub struct CardStudy {
    /// Rover, soil as its document has it, gravity, model and load transfer.
    pub heading: HeadingStudy,
    /// Rim speed ω r_s [m/s], for the power.
    pub rim_speed: f64,
    /// The limits of the verdicts.
    pub rule: Rule,
    /// Whether the samples are of an uncertain soil. If not, they differ by their models alone, and slopes are
    /// judged with the rule's margin.
    pub is_soil_uncertain: bool,
}

/// The card's numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Card {
    /// On each slope that was asked for, in that order.
    pub rows: Vec<CardRow>,
    /// Steepest slope on which a heading holds the contour on the soil as written [rad], and what ends it; `Err`
    /// with the reason where the rover cannot move.
    pub limit: Result<(f64, String), String>,
    /// The same over the samples; 0 where the rover cannot move.
    pub limit_band: Option<Band>,
    /// Number of samples; `None` if there are none.
    pub draws: Option<usize>,
}

/// One slope of the card.
#[derive(Clone, Debug, PartialEq)]
pub struct CardRow {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// The verdict.
    pub verdict: Verdict,
    /// On the soil as written; `None` where no heading holds the contour.
    pub level: Option<Level>,
    /// Why no heading holds the contour on the soil as written; nothing where one does.
    pub refusal: Option<String>,
    /// Drift on the soil as written, way downhill for a metre along the contour with the nose on
    /// the contour [-]; `None` where the rover slides.
    pub drift: Option<f64>,
    /// Over the samples; `None` if there are none.
    pub bands: Option<CardBands>,
    /// The flags of the contour traverse on the soil as written.
    pub findings: Vec<Finding>,
}

/// A contour traverse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Yaw, *γ* [rad], positive uphill.
    pub yaw: f64,
    /// Slip ratio of every wheel, *s* [-].
    pub slip_ratio: f64,
    /// Power of the motors [W].
    pub power: f64,
}

/// One slope over the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CardBands {
    /// Samples in which a heading holds the contour: yaw and power are over them.
    pub level: Probability,
    /// Yaw, *γ* [rad].
    pub yaw: Option<Band>,
    /// Slip ratio, *s* [-], over all samples: 1 where no heading holds the contour.
    pub slip_ratio: Option<Band>,
    /// Power of the motors [W].
    pub power: Option<Band>,
    /// Samples in which the rover does not slide with the nose on the contour.
    pub held: Probability,
    /// Drift [-], over all samples: 1, straight downhill, where the rover slides.
    pub drift: Option<Band>,
}

/// One sample: the numbers that the card needs.
#[derive(Clone)]
struct Draw {
    limit: Result<(f64, String), String>,
    /// On each slope.
    levels: Vec<Option<Level>>,
    refusals: Vec<Option<String>>,
    drifts: Vec<Option<f64>>,
}

impl CardStudy {
    /// Computes the card. Samples are shared among threads and keep their order: the result is the same for
    /// any number of threads.
    ///
    /// Go or no-go on 5°, 10° and 20°, where nothing is known of the soil's uncertainty?
    ///
    /// ```
    /// use grouser::document::{self, Overrides, Source};
    /// use grouser::studies::heading::HeadingStudy;
    /// use grouser::studies::card::{CardStudy, Rule, Verdict};
    /// use grouser::units::deg;
    ///
    /// let scenario = document::read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
    /// let heading = HeadingStudy::of(&scenario);
    /// let rule = Rule::DEFAULT;
    /// let study = CardStudy { heading, rim_speed: 0.06, rule, is_soil_uncertain: false };
    /// let card = study.card(&[], &[5.0, 10.0, 20.0].map(deg), &|| ())?;
    /// let verdicts: Vec<Verdict> = card.rows.iter().map(|row| row.verdict).collect();
    /// assert_eq!(verdicts, [Verdict::Go, Verdict::Go, Verdict::NoGo]);
    /// let level = card.rows[1].level.expect("10° can be crossed");
    /// assert_eq!(format!("{:.2} W", level.power), "0.40 W");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// * `samples`: of soil and model; with none there are no bands
    /// * `slopes`: [rad], rising
    /// * `done`: called after each sample that is computed, from any thread; samples that are alike are one
    ///
    /// # Errors
    /// [`ParameterError`] for a rule or a rim speed out of range, slopes that do not rise, and the
    /// first invalid soil.
    pub fn card(
        &self,
        samples: &[Sample],
        slopes: &[f64],
        done: &(dyn Fn() + Sync),
    ) -> Result<Card, ParameterError> {
        self.rule.check()?;
        crate::error::positive("rim speed [m/s]", self.rim_speed)?;
        if let Some(pair) = slopes.windows(2).find(|pair| pair[0] >= pair[1]) {
            return Err(ParameterError::new("slope [rad]", pair[1], "above the one before it"));
        }
        let nominal = self.draw(&self.nominal(), slopes)?;
        let curve = self.heading.curve()?;
        let findings: Vec<_> =
            slopes.iter().map(|slope| curve.findings(*slope, &curve.at(*slope))).collect();
        let drawn = |sample: &Sample| {
            let draw = self.draw(sample, slopes);
            done();
            draw
        };
        // In order, so that the error is always that of the first soil.
        let draws = Self::draws(samples, drawn)?;
        let slips_of = |draws: &[Draw]| {
            (0..slopes.len()).map(|place| slips_at(draws, place)).collect::<Vec<_>>()
        };
        let judged = if self.is_soil_uncertain && !draws.is_empty() {
            slips_of(&draws)
        } else {
            let steeper: Vec<f64> = slopes.iter().map(|slope| slope + self.rule.margin).collect();
            let nominal = [self.nominal()];
            let samples = if samples.is_empty() { &nominal } else { samples };
            slips_of(&Self::draws(samples, |sample| self.draw(sample, &steeper))?)
        };
        let limit_of = |draw: &Draw| draw.limit.as_ref().map_or(0.0, |(slope, _)| *slope);
        Ok(Card {
            rows: self.rows(slopes, &nominal, &draws, &judged, &findings),
            limit: nominal.limit,
            limit_band: Band::of(draws.iter().map(limit_of)),
            draws: (!draws.is_empty()).then_some(draws.len()),
        })
    }

    /// Soil and model without uncertainty.
    fn nominal(&self) -> Sample {
        Sample { soil: self.heading.soil, theory: self.heading.theory }
    }

    /// The numbers of each sample, or the error of the first that has one.
    fn draws(
        samples: &[Sample],
        one: impl Fn(&Sample) -> Result<Draw, ParameterError> + Sync + Send,
    ) -> Result<Vec<Draw>, ParameterError> {
        let all = outputs_of_samples(samples, &|| true, one);
        all.into_iter().flatten().collect()
    }

    fn rows(
        &self,
        slopes: &[f64],
        nominal: &Draw,
        draws: &[Draw],
        judged: &[Vec<Option<f64>>],
        findings: &[Vec<Finding>],
    ) -> Vec<CardRow> {
        let mut worst = Verdict::Go;
        let ground = self.heading.ground_limit();
        let row = |(place, slope): (usize, &f64)| {
            // Ground that slides by itself is no place to drive, whatever samples of it would hold.
            let verdict =
                if *slope > ground { Verdict::NoGo } else { self.rule.verdict(&judged[place]) };
            worst = worst.max(verdict);
            CardRow {
                slope: *slope,
                verdict: worst,
                level: nominal.levels[place],
                refusal: nominal.refusals[place].clone(),
                drift: nominal.drifts[place],
                bands: (!draws.is_empty()).then(|| CardBands::over(draws, place)),
                findings: findings[place].clone(),
            }
        };
        slopes.iter().enumerate().map(row).collect()
    }

    fn draw(&self, sample: &Sample, slopes: &[f64]) -> Result<Draw, ParameterError> {
        let study = self.heading.of_sample(sample);
        let (level, drift) = (study.curve()?, study.drift_curve()?);
        let keep = |heading: &HeadingOffset| Level {
            yaw: heading.yaw,
            slip_ratio: heading.slip_ratio,
            power: heading.power(&study.rover, self.rim_speed),
        };
        let on = |curve: &HeadingCurve, slope: f64| curve.at(slope).ok();
        Ok(Draw {
            limit: level
                .limit()
                .map(|(slope, reason)| (slope, reason.to_owned()))
                .map_err(|error| error.to_string()),
            refusals: slopes
                .iter()
                .map(|slope| Some(level.at(*slope).err()?.to_string()))
                .collect(),
            levels: slopes.iter().map(|slope| on(&level, *slope).as_ref().map(keep)).collect(),
            drifts: slopes.iter().map(|slope| Some(on(&drift, *slope)?.drift())).collect(),
        })
    }
}

/// Slip ratios of the contour traverses on one of the slopes.
fn slips_at(draws: &[Draw], place: usize) -> Vec<Option<f64>> {
    draws.iter().map(|draw| draw.levels[place].map(|level| level.slip_ratio)).collect()
}

impl CardBands {
    fn over(draws: &[Draw], place: usize) -> Self {
        let levels: Vec<Level> = draws.iter().filter_map(|draw| draw.levels[place]).collect();
        let drifts = || draws.iter().map(|draw| draw.drifts[place]);
        let slips = slips_at(draws, place).into_iter().map(|slip| slip.unwrap_or(STUCK));
        let trials = draws.len();
        Self {
            level: Probability { successes: levels.len(), trials },
            yaw: Band::of(levels.iter().map(|level| level.yaw)),
            slip_ratio: Band::of(slips),
            power: Band::of(levels.iter().map(|level| level.power)),
            held: Probability { successes: drifts().flatten().count(), trials },
            drift: Band::of(drifts().map(|drift| drift.unwrap_or(STRAIGHT_DOWN))),
        }
    }
}

/// Slip ratio of a rover that holds no course [-].
const STUCK: f64 = 1.0;
/// Drift of a rover that slides: straight downhill [m/m].
const STRAIGHT_DOWN: f64 = 1.0;
