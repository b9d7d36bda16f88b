//! Forecasts under another gravity: the error budget adds up, a choice that is made takes its part
//! away, and what is known to be so comes out so.

use std::sync::LazyLock;

use grouser::document::columns::forecast as columns;
use grouser::document::table::Table;
use grouser::document::{self, Kind, LoadedScenario, Overrides, Source};
use grouser::soil::GravityScaling;
use grouser::studies::ensemble::factorial::VarianceBudget;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::forecast::{
    Choices, FactorKind, Forecast, ForecastStudy, Ground, RoverMass, SlopeForecast,
};
use grouser::studies::heading::HeadingStudy;
use grouser::units::{EARTH_GRAVITY, deg};

/// Round-off of sums of some hundred squares of numbers below 1.
const WITHIN: f64 = 1e-12;

fn scenario(settings: &[&str]) -> LoadedScenario {
    let moon = ["scenario.gravity_m_s2=1.62"].into_iter();
    let overrides = Overrides::parse(moon.chain(settings.iter().copied())).expect("settings");
    document::read_scenario(&Source::default_scenario(), &overrides).expect("a scenario")
}

fn site(name: &str) -> Ground {
    let source = Source::find(Kind::Soil, name).expect("a preset");
    Ground::of_soil(name, &document::read_soil(&source, &Overrides::none()).expect("a soil"))
}

fn mass(name: &str, factor: f64) -> RoverMass {
    RoverMass { name: name.to_owned(), factor }
}

/// Every kind of choice open.
fn all_choices() -> Choices {
    Choices {
        scalings: GravityScaling::ALL.into(),
        grounds: vec![Ground::AsMeasured, site("lunar-0-15-cm")],
        masses: vec![mass("equal-mass", 1.0), mass("heavy", 1.5)],
    }
}

fn study(scenario: &LoadedScenario, choices: Choices) -> ForecastStudy {
    ForecastStudy {
        heading: HeadingStudy::of(&scenario.value),
        measured_under: EARTH_GRAVITY,
        rim_speed: 0.06,
        choices,
        samples: [2, 2],
        seed: 5,
    }
}

/// Forecast for an uncertain soil on one slope with every choice open, made once for all tests that
/// read it.
static WHOLE: LazyLock<Forecast> =
    LazyLock::new(|| forecast(&scenario(&[UNCERTAIN]), all_choices(), &[12.0]));

fn forecast(scenario: &LoadedScenario, choices: Choices, slopes: &[f64]) -> Forecast {
    let slopes: Vec<f64> = slopes.iter().map(|slope| deg(*slope)).collect();
    let found = study(scenario, choices).run(&BandInputs::of_scenario(scenario), &slopes, &|| true);
    found.expect("soils that can be drawn").expect("not stopped")
}

const UNCERTAIN: &str = "scenario.soil=toyoura-uncertain";

fn slip(forecast: &Forecast) -> &SlopeForecast {
    &forecast.slopes[0]
}

fn budgets(forecast: &Forecast) -> [&VarianceBudget; 3] {
    let slope = slip(forecast);
    [&slope.slip_budget, &slope.drift_budget, &forecast.limit_budget]
}

#[test]
fn the_parts_of_a_budget_add_up_to_the_whole() {
    assert_eq!(WHOLE.cases, 3 * 2 * 2 * 2 * 3 * 2);
    for budget in budgets(&WHOLE) {
        let parts: f64 = budget.parts.iter().map(|part| part.first).sum();
        let whole = budget.variance;
        assert!(
            whole > 0.0 && (parts + budget.interactions() - whole).abs() < WITHIN * whole.max(1.0)
        );
        for part in &budget.parts {
            assert!(0.0 <= part.first && part.first <= part.total + WITHIN && part.total <= whole);
            assert!(part.total > 0.0, "every factor matters here: {budget:?}");
        }
        let shared: f64 = budget.parts.iter().map(|part| part.shared).sum();
        assert!((shared - whole).abs() < WITHIN * whole.max(1.0));
    }
    // The table has the same numbers: shares of the parts, and their sum.
    let table = columns::budget(&WHOLE);
    let (factors, shares) = (table.texts("factor"), table.numbers("variance_share"));
    let quantities = table.texts("quantity");
    for name in ["slip_ratio", "downhill_m_per_m", "limit_slope_deg"] {
        let of = (0..table.rows()).filter(|row| quantities[*row].as_deref() == Some(name));
        let own: Vec<(usize, f64)> = of.filter_map(|row| Some((row, shares[row]?))).collect();
        let (last, parts) = own.split_last().expect("rows");
        assert_eq!(factors[last.0].as_deref(), Some("whole"));
        assert!((parts.iter().map(|(_, share)| share).sum::<f64>() - 1.0).abs() < WITHIN);
        assert!(parts.is_sorted_by(|one, other| one.1 >= other.1), "largest first: {parts:?}");
    }
}

/// Mean variance that is left if a factor is known, and what the budget says of it.
fn check_part(kind: FactorKind, whole: &Forecast, known: &[Forecast]) {
    let place = whole.place(kind).expect("a factor");
    assert_eq!(whole.factors[place].levels.len(), known.len());
    for (quantity, budget) in budgets(whole).into_iter().enumerate() {
        let factor = &whole.factors[place];
        let shares = factor.levels.iter().map(|level| factor.share(level));
        let left = known.iter().zip(shares).map(|(it, w)| w * budgets(it)[quantity].variance);
        let shrunk = budget.variance - left.sum::<f64>();
        let said = budget.parts[place].first;
        assert!((shrunk - said).abs() < WITHIN, "{kind:?}: {shrunk} and {said}");
    }
}

/// The forecast with some choices on one slope.
fn at(choices: Choices) -> Forecast {
    forecast(&scenario(&[UNCERTAIN]), choices, &[12.0])
}

#[test]
fn a_choice_that_is_made_shrinks_the_variance_by_its_part() {
    let all = all_choices();
    let grounds =
        all.grounds.iter().map(|it| at(Choices { grounds: vec![it.clone()], ..all.clone() }));
    check_part(FactorKind::Ground, &WHOLE, &grounds.collect::<Vec<_>>());
}

#[test]
#[ignore = "half a minute"]
fn every_choice_that_is_made_shrinks_the_variance_by_its_part() {
    let all = all_choices();
    let scalings = all.scalings.iter().map(|it| at(Choices { scalings: vec![*it], ..all.clone() }));
    check_part(FactorKind::GravityScaling, &WHOLE, &scalings.collect::<Vec<_>>());
    let masses =
        all.masses.iter().map(|it| at(Choices { masses: vec![it.clone()], ..all.clone() }));
    check_part(FactorKind::RoverMass, &WHOLE, &masses.collect::<Vec<_>>());
}

#[test]
fn a_model_that_is_known_shrinks_the_variance_by_its_part() {
    let models = ["ishigami", "small-wheel", "rft"].map(|model| {
        let setting = format!("scenario.model={model}");
        forecast(&scenario(&[UNCERTAIN, &setting]), all_choices(), &[12.0])
    });
    check_part(FactorKind::Model, &WHOLE, &models);
}

/// A model that a soil was made for counts more than the others: its share is that of bands.
#[test]
fn models_count_by_their_shares() {
    let settings = ["scenario.soil=toyoura", "soil.priors=none", "soil.model=small-wheel"];
    let forecast =
        forecast(&scenario(&settings), Choices::of_scalings([GravityScaling::Reece]), &[5.0]);
    let place = forecast.place(FactorKind::Model).expect("a factor");
    let factor = &forecast.factors[place];
    let shares: Vec<(&str, f64)> =
        factor.levels.iter().map(|level| (level.name.as_str(), factor.share(level))).collect();
    let own = shares.iter().find(|(name, _)| *name == "small-wheel").expect("the soil's model");
    assert!((own.1 - 0.8).abs() < 1e-12, "{shares:?}");
    let mean: f64 =
        shares.iter().zip(&slip(&forecast).slip_means[place]).map(|((_, w), m)| w * m).sum();
    assert!((mean - slip(&forecast).slip_budget.mean).abs() < WITHIN);
}

/// Case i depends on the study and i alone, whatever the threads.
#[test]
fn any_number_of_threads_makes_the_same_bits() {
    let scenario = scenario(&[UNCERTAIN]);
    let choices = || Choices { scalings: vec![GravityScaling::Reece], ..all_choices() };
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| forecast(&scenario, choices(), &[8.0]))
    };
    assert_eq!(with(1), with(3));
}

/// A forecast of some slopes has the numbers of one of more slopes.
#[test]
fn slopes_do_not_depend_on_each_other() {
    let scenario = scenario(&[UNCERTAIN]);
    let choices = || Choices::of_scalings([GravityScaling::Bekker]);
    let (one, two) =
        (forecast(&scenario, choices(), &[10.0]), forecast(&scenario, choices(), &[10.0, 15.0]));
    assert_eq!(one.slopes[0], two.slopes[0]);
    assert_eq!(one.limit, two.limit);
}

#[test]
fn a_soil_that_is_exact_has_no_part_in_the_budget() {
    let exact = scenario(&["scenario.soil=toyoura", "soil.priors=none"]);
    let forecast = forecast(&exact, Choices::of_scalings(GravityScaling::ALL), &[10.0]);
    let levels = |kind| forecast.factors[forecast.place(kind).expect("a factor")].levels.len();
    assert_eq!(levels(FactorKind::SoilParameters), 1);
    assert_eq!(levels(FactorKind::ModelDiscrepancy), 1);
    assert_eq!(forecast.cases, 9);
    let factors = columns::budget(&forecast);
    let has = |name: &str| factors.texts("factor").iter().any(|it| it.as_deref() == Some(name));
    assert!(has("gravity-scaling") && has("model") && !has("soil-parameters") && !has("ground"));
}

/// Without cohesion the unit weight and granular scaling are one, and the forecast of both is the
/// test of the same rover on Earth; a lightened rover shows something else, and so do constants
/// that are kept.
#[test]
fn a_test_of_the_same_rover_on_sand_without_cohesion_is_the_forecast() {
    let scenario = scenario(&[UNCERTAIN]);
    let forecast = forecast(&scenario, Choices::of_scalings(GravityScaling::ALL), &[12.0]);
    let place = forecast.place(FactorKind::GravityScaling).expect("a factor");
    let means = &slip(&forecast).slip_means[place];
    assert_eq!(means[0], means[2], "reece and granular-scaling");
    assert!((means[1] - means[0]).abs() > 1e-3, "bekker: {means:?}");
    let [same_mass, same_weight] = &forecast.tests[..] else { panic!("two tests") };
    assert_eq!((same_mass.mass.name.as_str(), same_mass.mass.factor), ("equal-mass", 1.0));
    assert!((same_weight.mass.factor - 1.62 / EARTH_GRAVITY).abs() < 1e-15);
    let alone = |scaling| {
        let choices = Choices::of_scalings([scaling]);
        super::forecast::forecast(&scenario, choices, &[12.0]).slopes[0].slip_ratio.expect("cases")
    };
    let granular = alone(GravityScaling::Granular);
    let tested = same_mass.slopes[0].0.expect("cases");
    for (a, b) in
        [(granular.low, tested.low), (granular.median, tested.median), (granular.high, tested.high)]
    {
        assert!((a - b).abs() < 1e-9, "{granular:?} and {tested:?}");
    }
    let lightened = same_weight.slopes[0].0.expect("cases");
    assert!((lightened.median - tested.median).abs() > 1e-3);
}

/// What is known of the site's ground was found there: no cohesion of it is scaled.
#[test]
fn the_strength_of_the_site_is_not_scaled() {
    let scenario = scenario(&[UNCERTAIN]);
    let choices = Choices {
        grounds: vec![site("lunar-0-15-cm")],
        ..Choices::of_scalings([GravityScaling::Reece, GravityScaling::Granular])
    };
    let forecast = forecast(&scenario, choices, &[12.0]);
    let place = forecast.place(FactorKind::GravityScaling).expect("a factor");
    let means = &slip(&forecast).slip_means[place];
    assert_eq!(means[0], means[1], "the sand itself has no cohesion");
}

/// A soil that was measured at the site needs no scaling, and there is nothing to test elsewhere.
#[test]
fn at_home_scalings_agree() {
    let scenario = scenario(&["scenario.soil=lunar-nominal"]);
    let study = ForecastStudy {
        measured_under: 1.62,
        ..study(&scenario, Choices::of_scalings(GravityScaling::ALL))
    };
    let found = study.run(&BandInputs::of_scenario(&scenario), &[deg(10.0)], &|| true);
    let forecast = found.expect("soils").expect("not stopped");
    let place = forecast.place(FactorKind::GravityScaling).expect("a factor");
    for budget in budgets(&forecast) {
        assert!(budget.parts[place].total < 1e-30 && budget.variance > 0.0, "{budget:?}");
    }
    assert!(forecast.tests.is_empty());
}

/// Cases without a heading stay: they slip by 1, and need more yaw and power than any number.
#[test]
fn cases_without_a_heading_are_counted() {
    let forecast = forecast(
        &scenario(&[UNCERTAIN]),
        Choices::of_scalings(GravityScaling::ALL),
        &[5.0, 27.0, 45.0],
    );
    let [easy, steep, beyond] = &forecast.slopes[..] else { panic!("three slopes") };
    assert_eq!(easy.level, 1.0);
    assert!(steep.level > 0.0 && steep.level < 1.0, "{}", steep.level);
    assert_eq!(beyond.level, 0.0);
    let band = |band: Option<grouser::studies::ensemble::Band>| band.expect("cases");
    assert_eq!(band(steep.slip_ratio).high, 1.0);
    assert!(band(steep.yaw).high.is_infinite() && band(steep.power).high.is_infinite());
    assert_eq!((band(beyond.slip_ratio).low, band(beyond.drift).low), (1.0, 1.0));
    assert_eq!(beyond.slip_budget.variance, 0.0);
    let table = columns::table(&forecast);
    assert_eq!(table.numbers("yaw_deg_p97_5")[1], None);
    assert_eq!(table.numbers("share_level")[2], Some(0.0));
    // Shares of nothing are missing.
    let budget: Table = columns::budget(&forecast);
    let (slopes, shares) = (budget.numbers("slope_deg"), budget.numbers("variance_share"));
    let of = (0..budget.rows()).filter(|row| slopes[*row].is_some_and(|it| it > 40.0));
    assert!(of.map(|row| shares[row]).all(|share| share.is_none()));
}

/// The ground of a site has the strength and density of its soil, and the moduli of the one that
/// was measured.
#[test]
fn a_stronger_ground_is_steeper_and_slips_less() {
    let scenario = scenario(&[UNCERTAIN]);
    let choices = Choices {
        grounds: vec![
            Ground::AsMeasured,
            site("lunar-nominal"),
            site("lunar-0-15-cm"),
            site("lunar-30-60-cm"),
        ],
        ..Choices::of_scalings([GravityScaling::Reece])
    };
    let forecast = forecast(&scenario, choices, &[12.0]);
    let place = forecast.place(FactorKind::Ground).expect("a factor");
    let (slips, limits) = (&slip(&forecast).slip_means[place], &forecast.limit_means[place]);
    assert!(slips.is_sorted_by(|one, other| one >= other), "{slips:?}");
    assert!(limits.is_sorted(), "{limits:?}");
    let levels = &forecast.factors[place].levels;
    assert_eq!(levels[2].name, "lunar-0-15-cm");
}

/// Moduli of Bekker's law that are scaled are flagged no more; kept ones are.
#[test]
fn only_kept_moduli_are_flagged() {
    let scenario = scenario(&["scenario.soil=grc-1", "scenario.model=ishigami"]);
    for scaling in GravityScaling::ALL {
        let forecast = forecast(&scenario, Choices::of_scalings([scaling]), &[5.0]);
        let names: Vec<&str> = slip(&forecast).findings.iter().map(|it| it.flag.name()).collect();
        assert!(names.contains(&"gravity-outside"), "{names:?}");
        assert_eq!(
            names.contains(&"bekker-gravity"),
            scaling == GravityScaling::Bekker,
            "{names:?}"
        );
    }
}

#[test]
fn what_is_no_choice_is_an_error() {
    let scenario = scenario(&[]);
    let band = BandInputs::of_scenario(&scenario);
    let none = Choices::of_scalings([]);
    assert!(study(&scenario, none).run(&band, &[0.1], &|| true).is_err());
    let weightless = Choices { masses: vec![mass("none", 0.0)], ..all_choices() };
    assert!(study(&scenario, weightless).run(&band, &[0.1], &|| true).is_err());
    let stopped = study(&scenario, all_choices()).run(&band, &[0.1], &|| false);
    assert!(stopped.expect("no error").is_none());
}
