//! A forecast: bands on each ground and slope, the error budget, the mean of each choice, and what
//! tests would show.

use super::super::answer::{ColumnMeaning, meanings};
use super::super::table::Table;
use super::super::unit::{DEG, M_PER_M, ONE};
use super::card::DRIFT;
use super::flags::{self, FLAGS};
use super::{
    Column, ENERGY_PER_METRE, LIMIT_SLOPE, POWER, Quantity, SINKAGE, SLIP_RATIO, SLOPE, YAW,
    quantity, text, whole, words,
};
use crate::studies::ensemble::factorial::VarianceBudget;
use crate::studies::ensemble::statistics::Estimate;
use crate::studies::forecast::{
    FactorKind, Forecast, GroundForecast, REMEDY_OF_INTERACTIONS, SlopeForecast, Support,
    TestForecast,
};

/// Share of the cases in which a heading holds the contour.
const SHARE_LEVEL: Quantity = quantity("share_level", ONE);
/// The probability that a rover slips more than the limit.
pub const PROBABILITY_SLIP: Quantity = quantity("probability_slip_above_limit", ONE);
/// The probability that no heading holds the contour.
pub const PROBABILITY_NO_HEADING: Quantity = quantity("probability_no_heading", ONE);
/// Whose strength and density the ground has.
pub const GROUND: &str = "ground";
/// How moduli scale in the cases of a row.
pub const SCALING: &str = "scaling";
/// What a row rests on.
pub const SUPPORT: &str = "support";

/// A row of one ground.
trait OfGround {
    fn ground(&self) -> &GroundForecast;
}

/// A row with the shares of a variance.
trait WithShares: OfGround {
    /// The parts of the variance.
    fn budget(&self) -> &VarianceBudget;

    /// The share of a factor with an equal share of its interactions; nothing where there is no
    /// variance.
    fn share(&self, kind: FactorKind) -> Option<f64> {
        let (budget, place) = (self.budget(), self.ground().place(kind)?);
        (budget.variance > 0.0).then(|| budget.parts[place].shared / budget.variance)
    }
}

const fn which<R: OfGround>() -> [Column<R>; 3] {
    [
        text(GROUND, "Whose cohesion, friction angle and density the ground has", |it: &R| {
            Some(it.ground().ground.clone())
        }),
        words(SCALING, "How moduli scale with gravity in the cases of the row", |it: &R| {
            it.ground().scalings.iter().map(|scaling| scaling.name()).collect()
        }),
        text(
            SUPPORT,
            "What the row rests on: strength found under the site's gravity (`site-gravity`) or \
             measured under another one (`other-gravity`), or of which the soil's document does \
             not say so (`unstated`); `none`: no measurement supports how moduli scale",
            |it: &R| Some(it.ground().support.name().to_owned()),
        ),
    ]
}

/// The shares that a row has of a variance.
const SHARES: [(FactorKind, Quantity); 5] = [
    (FactorKind::RoverMass, quantity("share_rover_mass", ONE)),
    (FactorKind::Model, quantity("share_model", ONE)),
    (FactorKind::SoilParameters, quantity("share_soil_parameters", ONE)),
    (FactorKind::ModelDiscrepancy, quantity("share_model_discrepancy", ONE)),
    (FactorKind::GravityScaling, quantity("share_gravity_scaling", ONE)),
];

const fn shares<R: WithShares>() -> [Column<R>; 5] {
    const DOC: &str = "Share of the factor in the variance within the ground, of the slip ratio or, \
                       beside a steepest slope, of that, with an equal share of each of its \
                       interactions: the shares of a row add up to 1";
    let [mass, model, soil, discrepancy, scaling] = SHARES;
    [
        mass.1.maybe(DOC, |it: &R| it.share(FactorKind::RoverMass)),
        model.1.maybe(DOC, |it: &R| it.share(FactorKind::Model)),
        soil.1.maybe(DOC, |it: &R| it.share(FactorKind::SoilParameters)),
        discrepancy.1.maybe(DOC, |it: &R| it.share(FactorKind::ModelDiscrepancy)),
        scaling.1.maybe(DOC, |it: &R| it.share(FactorKind::GravityScaling)),
    ]
}

/// The name of a ground in figures and sentences: with the scaling where no measurement supports
/// it.
#[must_use]
pub fn name(it: &GroundForecast) -> String {
    let scalings = it.scalings.iter().map(|scaling| scaling.name());
    match it.support {
        Support::None => format!("{} ({})", it.ground, scalings.collect::<Vec<_>>().join(", ")),
        _ => it.ground.clone(),
    }
}

/// A slope of a ground.
struct SlopeOfGround<'f> {
    ground: &'f GroundForecast,
    slope: &'f SlopeForecast,
}

impl OfGround for SlopeOfGround<'_> {
    fn ground(&self) -> &GroundForecast {
        self.ground
    }
}

impl WithShares for SlopeOfGround<'_> {
    fn budget(&self) -> &VarianceBudget {
        &self.slope.slip_budget
    }
}

const fn slopes<'f>() -> [Column<SlopeOfGround<'f>>; 9] {
    [
        SLOPE.given("Slopes", |it| Some(it.slope.slope)),
        SLIP_RATIO.band(
            "Slip ratio of every wheel on a contour traverse; 1 where no heading holds the contour",
            |it| it.slope.slip_ratio,
        ),
        YAW.band(
            "Yaw that holds the contour, positive uphill; an end is missing where no heading does \
             so",
            |it| it.slope.yaw,
        ),
        PROBABILITY_SLIP.estimate(
            "Probability that the wheels slip more than `no_go_slip_ratio` of the inputs, or that \
             no heading holds the contour: the share of the cases",
            |it| ends(it.slope.slip_above_limit),
        ),
        PROBABILITY_NO_HEADING.estimate(
            "Probability that no heading holds the contour: the share of the cases",
            |it| ends(it.slope.no_heading),
        ),
        DRIFT.band(
            "Drift per metre with the nose on the contour, positive downhill; 1 where the rover \
             slides",
            |it| it.slope.drift,
        ),
        SINKAGE.band(
            "Mean sinkage of the wheels; down to the axles where no heading holds the contour",
            |it| it.slope.sinkage,
        ),
        POWER.band(
            "Mechanical power of the motors at the rim speed; an end is missing as of the yaw",
            |it| it.slope.power,
        ),
        ENERGY_PER_METRE.band("Work of the wheels per metre along the contour, likewise", |it| {
            it.slope.energy_per_metre
        }),
    ]
}

const fn flags_of<'f>() -> [Column<SlopeOfGround<'f>>; 1] {
    [flags::flags(|it| flags::names(&it.slope.findings))]
}

fn ends(Estimate { value, low, high }: Estimate) -> [f64; 3] {
    [value, low, high]
}

/// A row for each ground and slope.
#[must_use]
pub fn table(forecast: &Forecast) -> Table {
    let rows = on_slopes(forecast, |ground, slope| vec![SlopeOfGround { ground, slope }]);
    let all: Vec<_> = rows.iter().map(Some).collect();
    Table::of(&which(), &rows).and(&slopes(), &all).and(&shares(), &all).and(&flags_of(), &all)
}

/// The rows of each slope of each ground.
fn on_slopes<'f, R>(
    forecast: &'f Forecast,
    rows: impl Fn(&'f GroundForecast, &'f SlopeForecast) -> Vec<R>,
) -> Vec<R> {
    let of_ground = |ground: &'f GroundForecast| ground.slopes.iter().map(move |it| (ground, it));
    forecast.grounds.iter().flat_map(of_ground).flat_map(|(ground, it)| rows(ground, it)).collect()
}

/// What the columns of all tables are, those of slopes first.
#[must_use]
pub fn all_meanings() -> Vec<ColumnMeaning> {
    let rows = [
        meanings(&which::<SlopeOfGround>()),
        meanings(&slopes()),
        meanings(&shares::<SlopeOfGround>()),
    ];
    let more = [meanings(&flags_of()), meanings(&LIMIT), meanings(&parts_of())];
    let rest = [meanings(&levels()), meanings(&of_tests())];
    let mut known = Vec::new();
    for meaning in rows.into_iter().chain(more).chain(rest).flatten() {
        if !known.contains(&meaning) {
            known.push(meaning);
        }
    }
    known
}

/// The columns of [`table`] for reading, without the shares.
#[must_use]
pub fn brief() -> Vec<String> {
    let bands = [SLIP_RATIO, YAW].into_iter().flat_map(Quantity::quantiles);
    let ends = [PROBABILITY_NO_HEADING.name, SUPPORT, FLAGS].map(String::from);
    let first = [GROUND, SCALING, SLOPE.name].map(String::from).into_iter();
    first.chain(bands).chain(PROBABILITY_SLIP.interval()).chain(ends).collect()
}

/// The columns of factors that are open, with their names.
#[must_use]
pub fn open_shares(forecast: &Forecast) -> Vec<(FactorKind, Quantity)> {
    let is_open = |kind: FactorKind| {
        let factors = forecast.grounds.iter().flat_map(|it| &it.factors);
        factors.filter(|it| it.kind == kind).any(|it| it.levels.len() > 1)
    };
    SHARES.into_iter().filter(|(kind, _)| is_open(*kind)).collect()
}

/// The shares of [`table`], or of [`steepest`], for reading.
///
/// * `before`: columns of the table that stand before them
#[must_use]
pub fn shares_brief(forecast: &Forecast, before: &[String]) -> Vec<String> {
    let shares = open_shares(forecast).into_iter().map(|(_, it)| it.name.to_owned());
    [GROUND, SCALING].map(String::from).into_iter().chain(before.to_vec()).chain(shares).collect()
}

impl OfGround for GroundForecast {
    fn ground(&self) -> &GroundForecast {
        self
    }
}

impl WithShares for GroundForecast {
    fn budget(&self) -> &VarianceBudget {
        &self.limit_budget
    }
}

const LIMIT: [Column<GroundForecast>; 2] = [
    LIMIT_SLOPE.band(
        "Steepest slope on which a heading holds the contour; 0 where the rover cannot drive on \
         level ground",
        |it| it.limit,
    ),
    whole("cases", "All cases of the ground", |it| Some(it.cases)),
];

/// The steepest slope, and how many cases there are: a row for each ground.
#[must_use]
pub fn steepest(forecast: &Forecast) -> Table {
    let all: Vec<_> = forecast.grounds.iter().map(Some).collect();
    Table::of(&which(), &forecast.grounds).and(&LIMIT, &all).and(&shares(), &all)
}

/// What a budget is of.
const QUANTITY: &str = "quantity";
/// A factor, [`INTERACTIONS`] or the whole.
const FACTOR: &str = "factor";
/// What no factor has alone.
const INTERACTIONS: &str = "interactions";
/// The whole variance.
const WHOLE: &str = "whole";
/// The share of a factor alone.
const VARIANCE_SHARE: Quantity = quantity("variance_share", ONE);
const TOTAL_SHARE: Quantity = quantity("total_share", ONE);
/// The share of a factor with an equal share of its interactions.
const SHARED_SHARE: Quantity = quantity("shared_share", ONE);
/// The square root of a part.
const DEVIATION: Quantity = quantity("standard_deviation", ONE);

/// A part of a budget.
struct Part<'f> {
    ground: &'f GroundForecast,
    quantity: Quantity,
    slope: Option<f64>,
    factor: &'static str,
    /// How many levels the factor has; none of what is no factor.
    levels: Option<usize>,
    /// The part, the total and the shared part, as shares of the variance; none where there is no
    /// variance.
    first: Option<f64>,
    total: Option<f64>,
    shared: Option<f64>,
    /// In SI.
    deviation: f64,
    remedy: &'static str,
}

impl OfGround for Part<'_> {
    fn ground(&self) -> &GroundForecast {
        self.ground
    }
}

const fn parts_of<'f>() -> [Column<Part<'f>>; 9] {
    [
        text(QUANTITY, "What the budget is of", |it| Some(it.quantity.name.to_owned())),
        SLOPE.given("Slopes; none for the steepest slope", |it| it.slope),
        text(FACTOR, "A factor, `interactions` of several, or the `whole`", |it| {
            Some(it.factor.to_owned())
        }),
        whole("levels", "How many levels the factor has", |it| it.levels),
        VARIANCE_SHARE.maybe(
            "Share of the variance that the factor has alone: by so much the variance shrinks, on \
             average, if it is known",
            |it| it.first,
        ),
        TOTAL_SHARE.maybe(
            "The same with all of its interactions: so much of the variance would be left if all \
             others were known",
            |it| it.total,
        ),
        SHARED_SHARE.maybe(
            "The same with an equal share of each of its interactions: these add up to 1 over the \
             factors",
            |it| it.shared,
        ),
        DEVIATION.number("Square root of the part, in the unit of the quantity", |it| {
            it.quantity.unit.from_si(it.deviation)
        }),
        text("what_would_shrink_it", "What would make the part smaller", |it| {
            Some(it.remedy.to_owned())
        }),
    ]
}

/// The error budgets of each ground: of the slip ratio and of the drift on each slope, and of the
/// steepest slope. In each the parts, largest first, then the whole, which is their sum. Factors of
/// one level are left out.
#[must_use]
pub fn budget(forecast: &Forecast) -> Table {
    let rows: Vec<Part> = forecast.grounds.iter().flat_map(budgets_of).collect();
    Table::of(&which(), &rows).and(&parts_of(), &rows.iter().map(Some).collect::<Vec<_>>())
}

fn budgets_of(it: &GroundForecast) -> Vec<Part<'_>> {
    let on_slopes = it.slopes.iter().flat_map(|slope| {
        let budgets = [(SLIP_RATIO, &slope.slip_budget), (DRIFT, &slope.drift_budget)];
        budgets.map(|(quantity, budget)| parts(it, quantity, Some(slope.slope), budget))
    });
    on_slopes.chain([parts(it, LIMIT_SLOPE, None, &it.limit_budget)]).flatten().collect()
}

fn parts<'f>(
    ground: &'f GroundForecast,
    quantity: Quantity,
    slope: Option<f64>,
    budget: &VarianceBudget,
) -> Vec<Part<'f>> {
    let share = |part: f64| (budget.variance > 0.0).then(|| part / budget.variance);
    let part = |factor, levels, first: f64, remedy| Part {
        ground,
        quantity,
        slope,
        factor,
        levels,
        first: share(first),
        total: None,
        shared: None,
        deviation: first.sqrt(),
        remedy,
    };
    let factors = ground.factors.iter().zip(&budget.parts);
    let open = factors.filter(|(factor, _)| factor.levels.len() > 1);
    let own = open.map(|(factor, it)| {
        let (kind, levels) = (factor.kind, factor.levels.len());
        let part = part(kind.name(), Some(levels), it.first, kind.remedy());
        Part { total: share(it.total), shared: share(it.shared), ..part }
    });
    let interactions = part(INTERACTIONS, None, budget.interactions(), REMEDY_OF_INTERACTIONS);
    let mut parts: Vec<Part> = own.chain([interactions]).collect();
    parts.sort_by(|one, other| other.deviation.total_cmp(&one.deviation));
    parts.push(part(WHOLE, None, budget.variance, ""));
    parts
}

/// A choice or a model.
const CHOICE: &str = "choice";
const MEAN_SLIP: Quantity = quantity("mean_slip_ratio", ONE);
const MEAN_DRIFT: Quantity = quantity("mean_downhill_m_per_m", M_PER_M);
const MEAN_LIMIT: Quantity = quantity("mean_limit_slope_deg", DEG);

/// A level of a factor on a slope of a ground.
struct OfLevel<'a> {
    ground: &'a GroundForecast,
    factor: usize,
    level: usize,
    slope: &'a SlopeForecast,
}

impl OfGround for OfLevel<'_> {
    fn ground(&self) -> &GroundForecast {
        self.ground
    }
}

const fn levels<'a>() -> [Column<OfLevel<'a>>; 8] {
    [
        text(FACTOR, "The factor", |it| Some(it.ground.factors[it.factor].kind.name().to_owned())),
        text(CHOICE, "Its level", |it| {
            Some(it.ground.factors[it.factor].levels[it.level].name.clone())
        }),
        quantity("weight", ONE).number("Its share among the levels of the factor", |it| {
            let factor = &it.ground.factors[it.factor];
            factor.share(&factor.levels[it.level])
        }),
        SLOPE.given("Slopes", |it| Some(it.slope.slope)),
        MEAN_SLIP
            .number("Mean slip ratio of its cases; 1 where no heading holds the contour", |it| {
                it.slope.slip_means[it.factor][it.level]
            }),
        MEAN_DRIFT.number("Mean drift of its cases; 1 where the rover slides", |it| {
            it.slope.drift_means[it.factor][it.level]
        }),
        SHARE_LEVEL.number("Share of its cases in which a heading holds the contour", |it| {
            it.slope.level_means[it.factor][it.level]
        }),
        MEAN_LIMIT.number("Mean steepest slope of its cases, the same on every slope", |it| {
            it.ground.limit_means[it.factor][it.level]
        }),
    ]
}

/// The means of each choice and model on each slope of each ground. Factors of one level are left
/// out.
#[must_use]
pub fn choices(forecast: &Forecast) -> Table {
    let rows = on_slopes(forecast, of_choices);
    Table::of(&which(), &rows).and(&levels(), &rows.iter().map(Some).collect::<Vec<_>>())
}

fn of_choices<'f>(ground: &'f GroundForecast, slope: &'f SlopeForecast) -> Vec<OfLevel<'f>> {
    let named = ground.factors.iter().enumerate();
    let named = named.filter(|(_, factor)| factor.is_named() && factor.levels.len() > 1);
    let levels = named.flat_map(|(factor, it)| (0..it.levels.len()).map(move |it| (factor, it)));
    levels.map(|(factor, level)| OfLevel { ground, factor, level, slope }).collect()
}

/// The columns of [`choices`] for reading.
#[must_use]
pub fn choices_brief() -> Vec<String> {
    let numbers = [SLOPE, MEAN_SLIP, MEAN_DRIFT, SHARE_LEVEL, MEAN_LIMIT].map(|it| it.name);
    [GROUND, SCALING, FACTOR, CHOICE].into_iter().chain(numbers).map(String::from).collect()
}

/// A test on a slope.
struct OnTest<'a> {
    test: &'a TestForecast,
    slope: f64,
    place: usize,
}

const fn of_tests<'a>() -> [Column<OnTest<'a>>; 5] {
    [
        text("test", "The rover's mass: `equal-mass` or `equal-weight`", |it| {
            Some(it.test.mass.name.clone())
        }),
        quantity("mass_factor", ONE)
            .number("Its mass over that of the document", |it| it.test.mass.factor),
        SLOPE.given("Slopes", |it| Some(it.slope)),
        SLIP_RATIO.band(
            "Slip ratio of every wheel on a contour traverse; 1 where no heading holds the contour",
            |it| it.test.slopes[it.place].0,
        ),
        SHARE_LEVEL.number("Share of the cases in which a heading holds the contour", |it| {
            it.test.slopes[it.place].1
        }),
    ]
}

/// What tests would show on the soil, and under the gravity, that was measured: a row for each test
/// and slope.
#[must_use]
pub fn tests(forecast: &Forecast) -> Table {
    let of_test = |test| {
        let slopes =
            forecast.grounds.first().into_iter().flat_map(|it| it.slopes.iter().enumerate());
        slopes.map(move |(place, it)| OnTest { test, slope: it.slope, place })
    };
    Table::of(&of_tests(), &forecast.tests.iter().flat_map(of_test).collect::<Vec<_>>())
}
