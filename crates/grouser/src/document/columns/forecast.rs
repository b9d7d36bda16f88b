//! A forecast: bands on each slope, the error budget, the mean of each choice, and what tests would
//! show.

use super::super::answer::{ColumnMeaning, meanings};
use super::super::table::Table;
use super::super::unit::{DEG, M_PER_M, ONE};
use super::card::DRIFT;
use super::flags::{self, FLAGS};
use super::{
    Column, ENERGY_PER_METRE, LIMIT_SLOPE, POWER, Quantity, SINKAGE, SLIP_RATIO, SLOPE, YAW,
    quantity, text, whole,
};
use crate::studies::ensemble::factorial::VarianceBudget;
use crate::studies::forecast::{
    FactorKind, Forecast, REMEDY_OF_INTERACTIONS, SlopeForecast, TestForecast,
};

/// Share of the cases in which a heading holds the contour.
pub const SHARE_LEVEL: Quantity = quantity("share_level", ONE);

const SLOPES: [Column<SlopeForecast>; 9] = [
    SLOPE.given("Slopes", |it| Some(it.slope)),
    SLIP_RATIO.band(
        "Slip ratio of every wheel on a contour traverse; 1 where no heading holds the contour",
        |it| it.slip_ratio,
    ),
    DRIFT.band(
        "Drift per metre with the nose on the contour, positive downhill; 1 where the rover slides",
        |it| it.drift,
    ),
    YAW.band(
        "Yaw that holds the contour, positive uphill; an end is missing where no heading does so",
        |it| it.yaw,
    ),
    SINKAGE.band(
        "Mean sinkage of the wheels; down to the axles where no heading holds the contour",
        |it| it.sinkage,
    ),
    POWER.band(
        "Mechanical power of the motors at the rim speed; an end is missing as of the yaw",
        |it| it.power,
    ),
    ENERGY_PER_METRE
        .band("Work of the wheels per metre along the contour, likewise", |it| it.energy_per_metre),
    SHARE_LEVEL.number("Share of the cases in which a heading holds the contour", |it| it.level),
    flags::flags(|it| flags::names(&it.findings)),
];

/// A row for each slope.
#[must_use]
pub fn table(forecast: &Forecast) -> Table {
    Table::of(&SLOPES, &forecast.slopes)
}

/// What the columns of all tables are, those of slopes first.
#[must_use]
pub fn all_meanings() -> Vec<ColumnMeaning> {
    let all = [meanings(&SLOPES), meanings(&PARTS), meanings(&levels()), meanings(&of_tests())];
    let mut known = Vec::new();
    for meaning in all.into_iter().flatten() {
        if !known.contains(&meaning) {
            known.push(meaning);
        }
    }
    known
}

/// The columns of [`table`] for reading.
#[must_use]
pub fn brief() -> Vec<String> {
    let whole = [SLIP_RATIO, DRIFT].into_iter().flat_map(Quantity::quantiles);
    let upper = [YAW, POWER].into_iter().flat_map(|it| it.quantiles().into_iter().skip(1));
    let ends = [SHARE_LEVEL.name, FLAGS].map(String::from);
    std::iter::once(SLOPE.name.to_owned()).chain(whole).chain(upper).chain(ends).collect()
}

/// How many cases there are.
const CASES: &str = "cases";

/// The steepest slope, and how many cases there are: one row.
#[must_use]
pub fn steepest(forecast: &Forecast) -> Table {
    const LIMIT: [Column<Forecast>; 2] = [
        LIMIT_SLOPE.band(
            "Steepest slope on which a heading holds the contour; 0 where the rover cannot drive \
             on level ground",
            |it| it.limit,
        ),
        whole(CASES, "All cases", |it| Some(it.cases)),
    ];
    Table::of(&LIMIT, std::slice::from_ref(forecast))
}

/// What a budget is of.
pub const QUANTITY: &str = "quantity";
/// A factor, [`INTERACTIONS`] or [`WHOLE`].
pub const FACTOR: &str = "factor";
/// What no factor has alone.
pub const INTERACTIONS: &str = "interactions";
/// The whole variance.
pub const WHOLE: &str = "whole";
/// The share of a factor alone.
pub const VARIANCE_SHARE: Quantity = quantity("variance_share", ONE);
const TOTAL_SHARE: Quantity = quantity("total_share", ONE);
/// The share of a factor with an equal share of its interactions.
pub const SHARED_SHARE: Quantity = quantity("shared_share", ONE);
/// The square root of a part.
pub const DEVIATION: Quantity = quantity("standard_deviation", ONE);

/// A part of a budget.
struct Part {
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

const PARTS: [Column<Part>; 9] = [
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
];

/// The error budgets: of the slip ratio and of the drift on each slope, and of the steepest slope.
/// In each the parts, largest first, then the whole, which is their sum. Factors of one level are
/// left out.
#[must_use]
pub fn budget(forecast: &Forecast) -> Table {
    let on_slopes = forecast.slopes.iter().flat_map(|it| {
        [(SLIP_RATIO, Some(it.slope), &it.slip_budget), (DRIFT, Some(it.slope), &it.drift_budget)]
    });
    let limit = (LIMIT_SLOPE, None, &forecast.limit_budget);
    let all = on_slopes.chain([limit]);
    let parts = all.flat_map(|(quantity, slope, budget)| parts(forecast, quantity, slope, budget));
    Table::of(&PARTS, &parts.collect::<Vec<_>>())
}

fn parts(
    forecast: &Forecast,
    quantity: Quantity,
    slope: Option<f64>,
    budget: &VarianceBudget,
) -> Vec<Part> {
    let share = |part: f64| (budget.variance > 0.0).then(|| part / budget.variance);
    let part = |factor, levels, first: f64, remedy| Part {
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
    let factors = forecast.factors.iter().zip(&budget.parts);
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

/// The columns of [`budget`] for reading.
#[must_use]
pub fn budget_brief() -> Vec<String> {
    let shares = [VARIANCE_SHARE, SHARED_SHARE, TOTAL_SHARE, DEVIATION].map(|it| it.name);
    [QUANTITY, SLOPE.name, FACTOR].into_iter().chain(shares).map(String::from).collect()
}

/// A choice or a model.
pub const CHOICE: &str = "choice";
const MEAN_SLIP: Quantity = quantity("mean_slip_ratio", ONE);
const MEAN_DRIFT: Quantity = quantity("mean_downhill_m_per_m", M_PER_M);
const MEAN_LIMIT: Quantity = quantity("mean_limit_slope_deg", DEG);

/// A level of a factor on a slope.
struct OfLevel<'a> {
    forecast: &'a Forecast,
    factor: usize,
    level: usize,
    slope: &'a SlopeForecast,
}

const fn levels<'a>() -> [Column<OfLevel<'a>>; 8] {
    [
        text(FACTOR, "The factor", |it| {
            Some(it.forecast.factors[it.factor].kind.name().to_owned())
        }),
        text(CHOICE, "Its level", |it| {
            Some(it.forecast.factors[it.factor].levels[it.level].name.clone())
        }),
        quantity("weight", ONE).number("Its share among the levels of the factor", |it| {
            let factor = &it.forecast.factors[it.factor];
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
            it.forecast.limit_means[it.factor][it.level]
        }),
    ]
}

/// The means of each choice and model on each slope. Factors of one level are left out.
#[must_use]
pub fn choices(forecast: &Forecast) -> Table {
    let named = forecast.factors.iter().enumerate();
    let named = named.filter(|(_, factor)| factor.is_named() && factor.levels.len() > 1);
    let rows = named.flat_map(|(factor, it)| {
        let levels = (0..it.levels.len()).map(move |level| (factor, level));
        levels.flat_map(|(factor, level)| {
            let on = move |slope| OfLevel { forecast, factor, level, slope };
            forecast.slopes.iter().map(on)
        })
    });
    Table::of(&levels(), &rows.collect::<Vec<_>>())
}

/// The columns of [`choices`] for reading.
#[must_use]
pub fn choices_brief() -> Vec<String> {
    let numbers = [SLOPE, MEAN_SLIP, MEAN_DRIFT, SHARE_LEVEL, MEAN_LIMIT].map(|it| it.name);
    [FACTOR, CHOICE].into_iter().chain(numbers).map(String::from).collect()
}

/// The mean slip of a choice over the slope, as points of a chart.
///
/// * `kind`: a factor
#[must_use]
pub fn slips_of_choices(forecast: &Forecast, kind: FactorKind) -> Vec<(String, Vec<(f64, f64)>)> {
    let Some(place) = forecast.place(kind) else { return Vec::new() };
    let point = |slope: &SlopeForecast, level: usize| {
        (SLOPE.unit.as_given(slope.slope), slope.slip_means[place][level])
    };
    let levels = forecast.factors[place].levels.iter().enumerate();
    let curve = |(level, it): (usize, &crate::studies::forecast::Level)| {
        let points = forecast.slopes.iter().map(|slope| point(slope, level));
        (it.name.clone(), points.collect())
    };
    levels.map(curve).collect()
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
        let slopes = forecast.slopes.iter().enumerate();
        slopes.map(move |(place, it)| OnTest { test, slope: it.slope, place })
    };
    Table::of(&of_tests(), &forecast.tests.iter().flat_map(of_test).collect::<Vec<_>>())
}
