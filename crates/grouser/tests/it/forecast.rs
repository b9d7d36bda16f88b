//! Forecasts under another gravity: each ground stands by itself, its error budget adds up, a choice
//! that is made takes its part away, and what is known to be so comes out so.

use std::sync::LazyLock;

use grouser::document::columns::forecast as columns;
use grouser::document::table::Table;
use grouser::document::{self, Kind, LoadedScenario, Overrides, Source};
use grouser::soil::GravityScaling;
use grouser::studies::ensemble::factorial::VarianceBudget;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::forecast::{
    Choices, FactorKind, Forecast, ForecastStudy, Ground, GroundForecast, RoverMass, SlopeForecast,
    Support,
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

/// Every kind of choice open, on two grounds.
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
        no_go_slip_ratio: 0.6,
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

/// The first ground, by the scalings that something supports.
fn first(forecast: &Forecast) -> &GroundForecast {
    &forecast.grounds[0]
}

fn slip(ground: &GroundForecast) -> &SlopeForecast {
    &ground.slopes[0]
}

fn budgets(ground: &GroundForecast) -> [&VarianceBudget; 3] {
    let slope = slip(ground);
    [&slope.slip_budget, &slope.drift_budget, &ground.limit_budget]
}

/// The mean slip at each level of a factor.
fn slip_means(ground: &GroundForecast, kind: FactorKind) -> &[f64] {
    &slip(ground).slip_means[ground.place(kind).expect("a factor")]
}

/// Sand of the laboratory and the firm ground between craters have little in common: neither band
/// has anything of the other, and each is that of a forecast of the ground alone.
#[test]
fn each_ground_is_as_if_it_were_asked_for_alone() {
    let all = all_choices();
    let supports = [Support::OtherGravity, Support::SiteGravity, Support::None, Support::None];
    assert_eq!(WHOLE.grounds.iter().map(|it| it.support).collect::<Vec<_>>(), supports);
    for (place, ground) in all.grounds.iter().enumerate() {
        let alone = at(Choices { grounds: vec![ground.clone()], ..all.clone() });
        let [supported, kept] = &alone.grounds[..] else { panic!("two rows") };
        assert_eq!((supported, kept), (&WHOLE.grounds[place], &WHOLE.grounds[place + 2]));
    }
    let [loose, firm] = [0, 1].map(|place| slip(&WHOLE.grounds[place]).slip_ratio.expect("cases"));
    assert!(loose.median > firm.high, "{loose:?} and {firm:?}");
    assert!(
        WHOLE.grounds[0].limit.expect("cases").median
            < WHOLE.grounds[1].limit.expect("cases").median
    );
}

/// The sampling of the site's ground is that ground's alone: with a soil that is exact the other
/// one has one sample.
#[test]
fn an_uncertain_ground_gives_no_samples_to_an_exact_one() {
    let scenario = scenario(&["scenario.soil=toyoura", "soil.priors=none"]);
    let choices = Choices {
        grounds: vec![Ground::AsMeasured, site("lunar-0-15-cm")],
        ..Choices::of_scalings([GravityScaling::Reece])
    };
    let forecast = forecast(&scenario, choices, &[12.0]);
    assert_eq!([3, 3 * 2], [0, 1].map(|place| forecast.grounds[place].cases));
    let exact = slip(first(&forecast)).no_heading;
    assert_eq!((exact.low, exact.high), (exact.value, exact.value), "nothing is sampled");
}

/// Bekker's moduli under another gravity than their own are in no band of the other laws.
#[test]
fn what_no_measurement_supports_stands_apart() {
    let scenario = scenario(&[UNCERTAIN]);
    let of = |scalings: &[GravityScaling]| {
        forecast(&scenario, Choices::of_scalings(scalings.iter().copied()), &[12.0]).grounds
    };
    let [reece, bekker] = [GravityScaling::Reece, GravityScaling::Bekker];
    let both = of(&[reece, bekker]);
    assert_eq!(both, [of(&[reece]), of(&[bekker])].concat());
    assert_eq!(
        both.iter().map(|it| it.support.name()).collect::<Vec<_>>(),
        ["other-gravity", "none"]
    );
}

/// Probabilities are shares of the cases, and their intervals have them inside; a greater limit is
/// exceeded no more often, and a rover without a heading exceeds all.
#[test]
fn the_probability_of_too_much_slip_is_that_of_its_cases() {
    let scenario = scenario(&[UNCERTAIN]);
    let choices = Choices::of_scalings([GravityScaling::Reece]);
    let of = |limit: f64| {
        let study = ForecastStudy { no_go_slip_ratio: limit, ..study(&scenario, choices.clone()) };
        let found = study.run(&BandInputs::of_scenario(&scenario), &[deg(27.0)], &|| true);
        slip(first(&found.expect("soils").expect("not stopped"))).clone()
    };
    let [any, usual, all] = [0.0, 0.6, 1.0].map(of);
    for slope in [&any, &usual, &all] {
        for it in [slope.slip_above_limit, slope.no_heading] {
            assert!(it.low <= it.value && it.value <= it.high && it.low < it.high, "{it:?}");
        }
        assert_eq!(slope.no_heading, usual.no_heading);
    }
    let [any, usual, all] =
        [any, usual, all].map(|it| (it.slip_above_limit.value, it.no_heading.value));
    assert!(any.0 >= usual.0 && usual.0 >= all.0, "{any:?}, {usual:?}, {all:?}");
    assert_eq!(all.0, all.1);
    assert!(usual.1 > 0.0 && usual.1 < 1.0);
    let unreal = ForecastStudy { no_go_slip_ratio: 1.5, ..study(&scenario, choices) };
    assert!(unreal.run(&BandInputs::of_scenario(&scenario), &[0.1], &|| true).is_err());
}

#[test]
fn the_parts_of_a_budget_add_up_to_the_whole() {
    assert_eq!(WHOLE.grounds.iter().map(|it| it.cases).collect::<Vec<_>>(), [48, 48, 24, 24]);
    for budget in budgets(first(&WHOLE)) {
        let parts: f64 = budget.parts.iter().map(|part| part.first).sum();
        let whole = budget.variance;
        assert!(
            whole > 0.0 && (parts + budget.interactions() - whole).abs() < WITHIN * whole.max(1.0)
        );
        for part in &budget.parts {
            assert!(0.0 <= part.first && part.first <= part.total + WITHIN && part.total <= whole);
            assert!(part.total >= 0.0, "{budget:?}");
        }
        let shared: f64 = budget.parts.iter().map(|part| part.shared).sum();
        assert!((shared - whole).abs() < WITHIN * whole.max(1.0));
    }
    // Rows have the shares with their interactions, which add up within each ground.
    for table in [columns::table(&WHOLE), columns::steepest(&WHOLE)] {
        let names = table.names();
        let shares = names.iter().filter(|name| name.starts_with("share_"));
        let shares: Vec<&[Option<f64>]> = shares.map(|name| table.numbers(name)).collect();
        assert_eq!((shares.len(), table.rows()), (5, 4));
        for row in 0..table.rows() {
            let sum: f64 = shares.iter().map(|share| share[row].expect("a variance")).sum();
            assert!((sum - 1.0).abs() < WITHIN, "{sum}");
        }
    }
    // The table has the same numbers: shares of the parts, and their sum.
    let table = columns::budget(&WHOLE);
    let (factors, shares) = (table.texts("factor"), table.numbers("variance_share"));
    let quantities = table.texts("quantity");
    let of_first = |row: &usize| {
        table.texts("ground")[*row].as_deref() == Some("as-measured")
            && table.texts("support")[*row].as_deref() != Some("none")
    };
    for name in ["slip_ratio", "downhill_m_per_m", "limit_slope_deg"] {
        let of = (0..table.rows()).filter(of_first);
        let of = of.filter(|row| quantities[*row].as_deref() == Some(name));
        let own: Vec<(usize, f64)> = of.filter_map(|row| Some((row, shares[row]?))).collect();
        let (last, parts) = own.split_last().expect("rows");
        assert_eq!(factors[last.0].as_deref(), Some("whole"));
        assert!((parts.iter().map(|(_, share)| share).sum::<f64>() - 1.0).abs() < WITHIN);
        assert!(parts.is_sorted_by(|one, other| one.1 >= other.1), "largest first: {parts:?}");
    }
}

/// Mean variance that is left if a factor is known, and what the budget says of it.
fn check_part(kind: FactorKind, whole: &Forecast, known: &[Forecast]) {
    let (whole, known) = (first(whole), known.iter().map(first));
    let place = whole.place(kind).expect("a factor");
    assert_eq!(whole.factors[place].levels.len(), known.len());
    for (quantity, budget) in budgets(whole).into_iter().enumerate() {
        let factor = &whole.factors[place];
        let shares = factor.levels.iter().map(|level| factor.share(level));
        let left = known.clone().zip(shares).map(|(it, w)| w * budgets(it)[quantity].variance);
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
fn every_choice_that_is_made_shrinks_the_variance_by_its_part() {
    let all = Choices { grounds: vec![Ground::AsMeasured], ..all_choices() };
    // Of a soil with cohesion, which laws of scaling differ about.
    let scenario = scenario(&["scenario.soil=simulant-2007"]);
    let at = |choices| forecast(&scenario, choices, &[12.0]);
    let whole = at(all.clone());
    let scalings = [GravityScaling::Reece, GravityScaling::Granular];
    let scalings = scalings.map(|it| at(Choices { scalings: vec![it], ..all.clone() }));
    check_part(FactorKind::GravityScaling, &whole, &scalings);
    assert!(
        slip_means(first(&whole), FactorKind::GravityScaling).windows(2).all(|it| it[0] != it[1])
    );
    let masses =
        all.masses.iter().map(|it| at(Choices { masses: vec![it.clone()], ..all.clone() }));
    check_part(FactorKind::RoverMass, &whole, &masses.collect::<Vec<_>>());
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
    let ground = first(&forecast);
    let factor = &ground.factors[ground.place(FactorKind::Model).expect("a factor")];
    let shares: Vec<(&str, f64)> =
        factor.levels.iter().map(|level| (level.name.as_str(), factor.share(level))).collect();
    let own = shares.iter().find(|(name, _)| *name == "small-wheel").expect("the soil's model");
    assert!((own.1 - 0.8).abs() < 1e-12, "{shares:?}");
    let mean: f64 =
        shares.iter().zip(slip_means(ground, FactorKind::Model)).map(|((_, w), m)| w * m).sum();
    assert!((mean - slip(ground).slip_budget.mean).abs() < WITHIN);
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
    assert_eq!(slip(first(&one)), slip(first(&two)));
    assert_eq!(first(&one).limit, first(&two).limit);
}

#[test]
fn a_soil_that_is_exact_has_no_part_in_the_budget() {
    let exact = scenario(&["scenario.soil=toyoura", "soil.priors=none"]);
    let forecast = forecast(&exact, Choices::of_scalings(GravityScaling::ALL), &[10.0]);
    let ground = first(&forecast);
    let levels = |kind| ground.factors[ground.place(kind).expect("a factor")].levels.len();
    assert_eq!(levels(FactorKind::SoilParameters), 1);
    assert_eq!(levels(FactorKind::ModelDiscrepancy), 1);
    assert_eq!((ground.cases, forecast.grounds[1].cases), (6, 3));
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
    let means = slip_means(first(&forecast), FactorKind::GravityScaling);
    assert_eq!(means[0], means[1], "reece and granular-scaling");
    let kept = slip(&forecast.grounds[1]).slip_budget.mean;
    assert!((kept - means[0]).abs() > 1e-3, "bekker: {kept}, {means:?}");
    let [same_mass, same_weight] = &forecast.tests[..] else { panic!("two tests") };
    assert_eq!((same_mass.mass.name.as_str(), same_mass.mass.factor), ("equal-mass", 1.0));
    assert!((same_weight.mass.factor - 1.62 / EARTH_GRAVITY).abs() < 1e-15);
    let alone = |scaling| {
        let choices = Choices::of_scalings([scaling]);
        let alone = super::forecast::forecast(&scenario, choices, &[12.0]);
        slip(first(&alone)).slip_ratio.expect("cases")
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
    let means = slip_means(first(&forecast), FactorKind::GravityScaling);
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
    let [ground] = &forecast.grounds[..] else { panic!("no law is needed: nothing stands apart") };
    assert_eq!(ground.support, Support::SiteGravity);
    let place = ground.place(FactorKind::GravityScaling).expect("a factor");
    for budget in budgets(ground) {
        assert!(budget.parts[place].total < 1e-30 && budget.variance > 0.0, "{budget:?}");
    }
    assert!(forecast.tests.is_empty());
}

/// Cases without a heading stay: they slip by 1, and need more yaw and power than any number.
#[test]
fn cases_without_a_heading_are_counted() {
    let forecast = forecast(
        &scenario(&[UNCERTAIN]),
        Choices::of_scalings([GravityScaling::Reece]),
        &[5.0, 27.0, 45.0],
    );
    let [easy, steep, beyond] = &first(&forecast).slopes[..] else { panic!("three slopes") };
    let [none, some, all] = [easy, steep, beyond].map(|it| it.no_heading);
    assert_eq!((none.value, none.low, all.value, all.high), (0.0, 0.0, 1.0, 1.0));
    assert!(some.value > 0.0 && some.value < 1.0 && none.high < 1.0 && all.low > 0.0, "{some:?}");
    let band = |band: Option<grouser::studies::ensemble::Band>| band.expect("cases");
    assert_eq!(band(steep.slip_ratio).high, 1.0);
    assert!(band(steep.yaw).high.is_infinite() && band(steep.power).high.is_infinite());
    assert_eq!((band(beyond.slip_ratio).low, band(beyond.drift).low), (1.0, 1.0));
    assert_eq!(beyond.slip_budget.variance, 0.0);
    let table = columns::table(&forecast);
    assert_eq!(table.numbers("yaw_deg_p97_5")[1], None);
    assert_eq!(table.numbers("probability_no_heading")[2], Some(1.0));
    assert_eq!(table.numbers("share_model")[2], None);
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
    let means = |it: &GroundForecast| (slip(it).slip_budget.mean, it.limit_budget.mean);
    let (slips, limits): (Vec<f64>, Vec<f64>) = forecast.grounds.iter().map(means).unzip();
    assert!(slips.is_sorted_by(|one, other| one >= other), "{slips:?}");
    assert!(limits.is_sorted(), "{limits:?}");
    assert_eq!(forecast.grounds[2].ground, "lunar-0-15-cm");
}

/// Moduli of Bekker's law that are scaled are flagged no more; kept ones are.
#[test]
fn only_kept_moduli_are_flagged() {
    let scenario = scenario(&["scenario.soil=grc-1", "scenario.model=ishigami"]);
    for scaling in GravityScaling::ALL {
        let forecast = forecast(&scenario, Choices::of_scalings([scaling]), &[5.0]);
        let names: Vec<&str> =
            slip(first(&forecast)).findings.iter().map(|it| it.flag.name()).collect();
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
