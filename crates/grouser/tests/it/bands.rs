//! Bands over samples of soil and model: which models there are, and what a sample without an
//! answer counts as.

use grouser::contact::{Contact, Model, Slip};
use grouser::document::campaign::QuantityStatistics;
use grouser::document::columns::run;
use grouser::document::{
    self, Campaign, DocumentError, Kind, LoadedScenario, LoadedSoil, Overrides, Source,
};
use grouser::simulation::{Outcome, OutcomeKind};
use grouser::soil::{PressureSinkage, Soil};
use grouser::studies::ensemble::models::{ModelSpread, OWN_SHARE, Question, weight};
use grouser::studies::ensemble::samples::{BandInputs, Sample};
use grouser::studies::ensemble::{Band, Probability};
use grouser::studies::heading::HeadingStudy;
use grouser::studies::heading_band::HeadingBand;
use grouser::studies::heading_map::HeadingMap;
use grouser::studies::traverse_band::{RunBand, TraverseBand};
use grouser::studies::wheel_test::WheelTest;
use grouser::studies::wheel_test_band::Sunk;
use grouser::units::deg;

use super::given;

const SEED: u64 = 7;

fn scenario(settings: &[&str]) -> LoadedScenario {
    let overrides = Overrides::parse(settings.iter().copied()).expect("settings");
    document::read_scenario(&Source::default_scenario(), &overrides).expect("a scenario")
}

/// A setting with which the numbers that a soil states are exact.
const EXACT: &str = "soil.priors=none";

fn soil(name: &str) -> LoadedSoil {
    let source = Source::find(Kind::Soil, name).expect("a preset");
    document::read_soil(&source, &Overrides::none()).expect("a soil")
}

fn samples(scenario: &LoadedScenario, count: u32) -> Vec<Sample> {
    BandInputs::of_scenario(scenario).samples(SEED, count).expect("they can be drawn")
}

fn stand(soil: Soil, model: Model) -> WheelTest {
    WheelTest {
        wheel: given::hakuto_wheel(),
        soil,
        gravity: 9.80665,
        model,
        loads: vec![10.0, 17.0],
        slip_angles: vec![0.0, deg(15.0)],
        slip_ratios: vec![-0.2, 0.1, 0.4],
    }
}

fn contains(band: Option<Band>, value: f64) -> bool {
    band.is_some_and(|band| band.low <= value && value <= band.high)
}

// ---- Models ----

/// Any number of samples in a row has the models by their shares, to within a few samples.
#[test]
fn samples_have_the_models_by_their_shares() {
    for spread in [
        ModelSpread::all(None, Question::Across),
        ModelSpread::all(Some(&Model::SmallWheel), Question::Across),
    ] {
        for seed in 0..20 {
            let mut counts = [0.0; 4];
            for index in 0..2000 {
                let model = spread.model(seed, index);
                let place = Model::ALL.iter().position(|it| *it == model).expect("one of them");
                counts[place] += 1.0;
                for (model, share) in spread.shares() {
                    let place = Model::ALL.iter().position(|it| it == model).expect("one");
                    let expected = share * (index + 1) as f64;
                    assert!((counts[place] - expected).abs() < 5.0, "{model:?}, seed {seed}");
                }
            }
        }
    }
}

#[test]
fn a_model_has_its_share_and_the_rest_is_shared_by_weight() {
    let share = |spread: &ModelSpread, model| {
        spread.shares().iter().find(|it| it.0 == model).map_or(0.0, |it| it.1)
    };
    let sum: f64 = Model::ALL.iter().map(weight).sum();
    for made_for in [None, Some(Model::Rft), Some(Model::Bekker)] {
        let spread = ModelSpread::all(made_for.as_ref(), Question::Along);
        let total: f64 = spread.shares().iter().map(|it| it.1).sum();
        assert!((total - 1.0).abs() < 1e-12 && spread.shares().iter().all(|it| it.1 > 0.0));
        match made_for {
            Some(model) => assert_eq!(share(&spread, model), OWN_SHARE),
            None => {
                for model in Model::ALL {
                    let expected = weight(&model) / sum;
                    assert!((share(&spread, model) - expected).abs() < 1e-12);
                }
            }
        }
    }
    let one = ModelSpread::one(Model::Bekker);
    assert!((0..50).all(|index| one.model(SEED, index) == Model::Bekker));
}

/// A model that is asked for by name is alone; a soil keeps the one that it was made for, with the
/// greater share.
#[test]
fn documents_decide_which_models_there_are() {
    let shares = |inputs: BandInputs| inputs.models().shares().to_vec();
    let own = ModelSpread::all(Some(&Model::Ishigami), Question::Across);
    let default = own.shares().to_vec();
    assert_eq!(shares(BandInputs::of_scenario(&scenario(&[]))), default);
    let chosen = scenario(&["scenario.model=rft"]);
    assert_eq!(shares(BandInputs::of_scenario(&chosen)), [(Model::Rft, 1.0)]);
    let own = ModelSpread::all(Some(&Model::SmallWheel), Question::Across).shares().to_vec();
    let fitted = scenario(&["scenario.soil=cmu-direct90-smooth"]);
    assert_eq!(shares(BandInputs::of_scenario(&fitted)), own);
    let fitted = soil("cmu-direct90-smooth");
    assert_eq!(shares(BandInputs::of_soil(&fitted, None)), own);
    let chosen = BandInputs::of_soil(&fitted, Some(Model::Bekker));
    assert_eq!(shares(chosen), [(Model::Bekker, 1.0)]);
}

#[test]
fn a_sample_depends_on_the_seed_and_its_number_alone() {
    let uncertain = scenario(&["scenario.soil=toyoura-uncertain"]);
    let inputs = BandInputs::of_scenario(&uncertain);
    let many = samples(&uncertain, 40);
    assert_eq!(many[..10], samples(&uncertain, 10));
    assert_eq!(many[33], inputs.sample(SEED, 33).expect("it can be drawn"));
    let other = inputs.samples(SEED + 1, 40).expect("they can be drawn");
    assert!(many.iter().zip(&other).all(|(one, other)| one.soil != other.soil));
    let starts = (0..40).map(|seed| ModelSpread::all(None, Question::Across).model(seed, 0));
    let rft = starts.filter(|model| *model == Model::Rft).count();
    assert!((4..=26).contains(&rft), "{rft} of 40 seeds start with rft");
}

// ---- Exact soils ----

#[test]
fn the_band_of_an_exact_soil_contains_every_model_of_the_spread() {
    let scenario = scenario(&[EXACT]);
    let soil = scenario.value.ground.soil;
    let samples = samples(&scenario, 200);
    let test = stand(soil, Model::Ishigami);
    let bands = test.bands(&samples, &|| true).expect("not stopped");
    let study = HeadingStudy::of(&scenario.value);
    let slopes = [5.0, 10.0, 15.0].map(deg);
    let band = HeadingBand::of(&study, &samples, &slopes, &|| true);
    let band = band.expect("sand").expect("not stopped");
    for (model, _) in ModelSpread::all(None, Question::Across).shares() {
        for (row, band) in stand(soil, model.clone()).run().iter().zip(&bands) {
            let settled = row.result.expect("sand carries it");
            assert!(contains(band.sinkage, settled.sinkage), "{model:?} {row:?}");
            assert!(contains(band.drawbar_pull, settled.forces.drawbar_pull), "{model:?}");
            assert!(contains(band.side_force, settled.forces.side_force), "{model:?}");
            assert!(contains(band.torque, settled.forces.torque), "{model:?}");
        }
        let curve = HeadingStudy { model: model.clone(), ..study.clone() }.curve().expect("sand");
        for on_slope in &band.slopes {
            let heading = curve.at(on_slope.slope).expect("not steep");
            assert!(contains(on_slope.yaw, heading.yaw), "{model:?}");
            assert!(contains(on_slope.slip_ratio, heading.slip_ratio), "{model:?}");
            assert!(contains(on_slope.sinkage, heading.mean_sinkage()), "{model:?}");
        }
    }
}

#[test]
fn one_model_on_an_exact_soil_is_a_point() {
    let scenario = scenario(&["scenario.model=rft", EXACT]);
    let samples = samples(&scenario, 20);
    let test = stand(scenario.value.ground.soil, Model::Rft);
    let mut computed = std::sync::atomic::AtomicUsize::new(0);
    let count = || {
        computed.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        true
    };
    let bands = test.bands(&samples, &count).expect("not stopped");
    for (row, band) in test.run().iter().zip(&bands) {
        let settled = row.result.expect("sand carries it");
        let exactly = |value| Some(Band { low: value, median: value, high: value });
        assert_eq!(band.sinkage, exactly(settled.sinkage));
        assert_eq!(band.drawbar_pull, exactly(settled.forces.drawbar_pull));
        assert_eq!(band.side_force, exactly(settled.forces.side_force));
        assert_eq!(band.torque, exactly(settled.forces.torque));
        assert_eq!(band.carried, Probability { successes: 20, trials: 20 });
    }
    assert_eq!(*computed.get_mut(), 1, "samples that are alike are computed once");
}

// ---- Samples without an answer ----

/// Sand so loose that the wheel sinks to its axle.
fn mire() -> Soil {
    let sand = scenario(&[]).value.ground.soil;
    let PressureSinkage::Reece { k_c, k_phi, exponent } = sand.pressure_sinkage else {
        panic!("Toyoura sand has Reece's law")
    };
    let pressure_sinkage = PressureSinkage::Reece { k_c, k_phi: k_phi / 1e3, exponent };
    Soil { pressure_sinkage, ..sand }
}

#[test]
fn a_wheel_that_sinks_to_its_axle_is_not_left_out() {
    let sand = scenario(&[]).value.ground.soil;
    let of = |soil| Sample { soil, model: Model::Ishigami };
    let test = stand(sand, Model::Ishigami);
    let bands = test.bands(&[of(sand), of(mire()), of(mire())], &|| true).expect("not stopped");
    let radius = given::hakuto_wheel().shearing_radius();
    for (row, band) in test.run().iter().zip(&bands) {
        assert_eq!(band.carried, Probability { successes: 1, trials: 3 });
        let settled = row.result.expect("sand carries it");
        let [sinkage, pull, torque] =
            [band.sinkage, band.drawbar_pull, band.torque].map(|it| it.expect("samples"));
        // Two of three: the median is theirs.
        assert_eq!((sinkage.median, pull.median), (radius, -row.load));
        assert_eq!(torque.median, (row.load * radius).copysign(row.slip_ratio));
        assert!(sinkage.low >= settled.sinkage && sinkage.low < radius);
        assert!(pull.high <= settled.forces.drawbar_pull && pull.high > -row.load);
        assert!(contains(band.side_force, 0.0));
    }
}

#[test]
fn a_row_without_a_nominal_value_keeps_its_band() {
    let scenario = scenario(&["scenario.soil=toyoura-uncertain"]);
    let studies = [HeadingStudy::of(&scenario.value)];
    let (courses, slopes) = ([0.0, deg(90.0)], [10.0, 22.0].map(deg));
    let map = HeadingMap::of(&studies, &courses, &slopes).expect("sand");
    let samples = [samples(&scenario, 30)];
    let bands = map.bands(&studies, &samples, &|| true).expect("sand").expect("not stopped");
    for (row, band) in map.rows.iter().zip(&bands) {
        assert!(row.cells[0].is_ok() && row.cells[1].is_err());
        assert!(band.slopes[0].level.successes > band.slopes[1].level.successes);
        let slip = band.slopes[1].slip_ratio.expect("there are samples");
        assert!(slip.low < 1.0 && slip.high == 1.0, "{slip:?}");
    }
    // The contour's row is the study of the contour.
    let contour = HeadingBand::of(&studies[0], &samples[0], &slopes, &|| true);
    assert_eq!(contour.expect("sand").as_ref(), Some(&bands[0]));
}

#[test]
fn the_number_of_threads_changes_no_band() {
    let scenario = scenario(&["scenario.soil=toyoura-uncertain"]);
    let study = HeadingStudy::of(&scenario.value);
    let test = stand(study.soil, study.model.clone());
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads can be started").install(|| {
            let samples = samples(&scenario, 16);
            let uphill = HeadingBand::on_course(&study, deg(90.0), &samples, &[deg(9.0)], &|| true);
            (test.bands(&samples, &|| true), uphill.expect("sand"))
        })
    };
    assert_eq!(on(1), on(3));
}

/// The solver's part of a traverse: an exact soil and one model give the run itself.
#[test]
fn a_traverse_of_one_model_is_its_run_and_of_several_contains_each() {
    let settings = ["scenario.duration_s=2", "scenario.slope_deg=8", EXACT];
    let spread = scenario(&settings);
    let times = [0.0, 1.0, 2.0];
    let band = |scenario: &LoadedScenario, count| {
        let samples = samples(scenario, count);
        let band = TraverseBand::of(&scenario.value, &samples, &times, &|| true);
        band.expect("it can be computed").expect("not stopped")
    };
    // The rarest model has one sample in sixteen.
    let of_all = band(&spread, 40);
    assert_eq!(of_all.run.completed, Probability { successes: 40, trials: 40 });
    for model in ["ishigami", "rft"] {
        let model = format!("scenario.model={model}");
        let one = scenario(&[settings[0], settings[1], settings[2], &model]);
        let run = given::run(&one.value);
        let alone = band(&one, 3);
        for (place, time) in times.iter().enumerate() {
            let record = run.records.iter().find(|it| (it.time - time).abs() < 1e-9);
            let state = record.expect("a record").state;
            let (alone, all) = (alone.times[place], of_all.times[place]);
            let exactly = |value| Some(Band { low: value, median: value, high: value });
            assert_eq!((alone.x, alone.y), (exactly(state.position.x), exactly(state.position.y)));
            assert!(contains(all.y, state.position.y) && contains(all.yaw, state.yaw));
        }
    }
}

/// A rover that gets stuck counts as slip 1 from then on, where it is.
#[test]
fn a_run_that_gets_stuck_is_not_left_out() {
    let good = scenario(&["scenario.duration_s=6", "scenario.slope_deg=5"]).value;
    let mut slick = good.ground.soil;
    slick.friction_angle = deg(5.0);
    let of = |soil| Sample { soil, model: Model::Ishigami };
    let samples = [of(good.ground.soil), of(slick), of(slick)];
    let mut stuck = good.clone();
    stuck.ground.soil = slick;
    let run = given::run(&stuck);
    assert!(run.outcome != Outcome::Completed && run.last().time < 6.0, "{:?}", run.outcome);
    let band = TraverseBand::of(&good, &samples, &[0.1, 6.0], &|| true);
    let band = band.expect("it can be computed").expect("not stopped");
    assert_eq!(band.run.completed, Probability { successes: 1, trials: 3 });
    let ends = band.run.ends;
    let stuck = ends.count(OutcomeKind::Immobilised);
    assert_eq!((stuck, ends.early(), ends.in_band()), (2, 2, 3));
    let at_end = band.times[1];
    let slip = at_end.slip_ratio.expect("there are samples");
    assert!(slip.median == 1.0 && slip.low < 0.2, "{slip:?}");
    let x = at_end.x.expect("there are samples");
    assert_eq!(x.median, run.last().state.position.x);
    let energy = band.run.energy_per_metre.expect("there are samples");
    assert!(energy.median == f64::INFINITY && energy.high == f64::INFINITY, "{energy:?}");
}

/// A rover that leaves its map is not stuck: until then it counts as it is, and then it leaves the
/// band.
#[test]
fn a_run_that_leaves_its_map_leaves_the_band_then() {
    // A level map of 2 m by 2 m; from its middle, its edge is 1 m ahead of the rover.
    let file = std::env::temp_dir().join(format!("grouser-edge-{}.xyz", std::process::id()));
    let points =
        (0..81).map(|k| format!("{} {} 0\n", 0.25 * f64::from(k % 9), 0.25 * f64::from(k / 9)));
    std::fs::write(&file, points.collect::<String>()).expect("it can be written");
    let text = format!(
        "schema = \"scenario/1\"\nduration_s = 30.0\n\
         [terrain]\nfile = {:?}\n",
        file.display().to_string()
    );
    let overrides = Overrides::parse([EXACT]).expect("settings");
    let read = document::read_scenario(&Source::text("an edge", text), &overrides);
    let good = read.expect("a scenario").value;
    std::fs::remove_file(&file).expect("it was written");
    let soil = good.ground.soil;
    let run = given::run(&good);
    assert!(matches!(run.outcome, Outcome::OffTheMap { .. }), "{:?}", run.outcome);
    let off = run.last().time;
    let samples = vec![Sample { soil, model: good.model.clone() }; 3];
    let band = TraverseBand::of(&good, &samples, &[0.5 * off, 30.0], &|| true);
    let band = band.expect("it can be computed").expect("not stopped");
    let [before, after] = &band.times[..] else { panic!("two times") };
    assert!(before.sinkage.is_some_and(|it| it.high < 0.03), "{before:?}");
    assert_eq!((before.ends.early(), before.ends.in_band()), (0, 3));
    assert_eq!((after.x, after.slip_ratio, after.sinkage), (None, None, None));
    assert_eq!((after.ends.count(OutcomeKind::OffTheMap), after.ends.in_band()), (3, 0));
    let sinkage = band.run.sinkage.expect("its time in the band");
    assert!(sinkage.high < 0.03 && sinkage.low > 0.0, "{sinkage:?}");
    assert_eq!((band.run.x, band.run.distance), (None, None));
    assert!(band.run.energy_per_metre.is_some_and(|it| it.high.is_finite()));
    assert_eq!(band.run.ends.in_words().as_deref(), Some("off_map 100.0 %"));
}

/// Ripples of 4 cm, over which a rover pitches.
const RIPPLE: &str =
    "surface = \"ripple\", amplitude_m = 0.02, wavelength_m = 2.0, start_m = [0.5, 3.0]";

/// A scenario over ripples.
fn over_ripples(settings: &[&str]) -> LoadedScenario {
    let text = format!(
        "schema = \"scenario/1\"\nsimulation = \"quasi-steady\"\nduration_s = 20.0\nterrain = {{ {RIPPLE} }}\n"
    );
    let overrides = Overrides::parse(settings.iter().copied()).expect("settings");
    document::read_scenario(&Source::text("ripples", text), &overrides).expect("a scenario")
}

/// Over heights a band has how the rover stands; for one soil and model that is the run.
#[test]
fn a_band_over_heights_has_height_roll_and_pitch() {
    let scenario = over_ripples(&[EXACT]);
    let run = given::run(&scenario.value);
    let end = run.last();
    let standing = end.standing().expect("it stands");
    assert!(standing.pitch.abs() > deg(0.5), "{standing:?}");
    let times = [0.0, end.time];
    let band = |scenario: &LoadedScenario, samples: &[Sample]| {
        let band = TraverseBand::of(&scenario.value, samples, &times, &|| true);
        band.expect("it can be computed").expect("not stopped")
    };
    let same = Sample { soil: scenario.value.ground.soil, model: scenario.value.model.clone() };
    let alone = band(&scenario, &[same.clone(), same.clone(), same]);
    let exactly = |value| Some(Band { low: value, median: value, high: value });
    for [height, roll, pitch] in [
        [alone.times[1].height, alone.times[1].roll, alone.times[1].pitch],
        [alone.run.height, alone.run.roll, alone.run.pitch],
    ] {
        assert_eq!(height, exactly(standing.height));
        assert_eq!((roll, pitch), (exactly(standing.roll), exactly(standing.pitch)));
    }
    let table = run::time_bands(&alone.times, &scenario.value);
    for name in ["x_m_p50", "y_m_p2_5", "z_m_p50", "roll_deg_p97_5", "pitch_deg_p50"] {
        assert!(table.numbers(name).iter().all(Option::is_some), "{name}");
    }
    // Several soils and models spread along the way, and so in height.
    let spread = over_ripples(&[]);
    let of_all = band(&spread, &samples(&spread, 9));
    let height = of_all.run.height.expect("there are samples");
    assert!(height.low < height.high && contains(of_all.run.height, height.median));
    // A plane has none of these.
    let plane = band_on_a_plane();
    assert_eq!((plane.height, plane.roll, plane.pitch), (None, None, None));
}

fn band_on_a_plane() -> RunBand {
    let plane = scenario(&["scenario.duration_s=1", EXACT]);
    let band = TraverseBand::of(&plane.value, &samples(&plane, 2), &[1.0], &|| true);
    band.expect("it can be computed").expect("not stopped").run
}

// ---- Campaigns ----

/// Rows of traverses and missions over heights have how the rover stands at the end, and their
/// statistics read it.
#[test]
fn campaigns_over_heights_have_height_and_attitude() {
    let traverse = format!(
        "study = \"traverse\"\n[scenario]\nsimulation = \"quasi-steady\"\nduration_s = 10.0\nterrain = {{ {RIPPLE} }}"
    );
    let mission = format!(
        "study = \"mission\"\n[mission]\nsimulation = \"quasi-steady\"\nterrain = {{ {RIPPLE} }}\n\
         [[mission.leg]]\nspeed_m_s = 0.06\nheading = \"hold\"\ndrive_m = 0.5"
    );
    for base in [traverse, mission] {
        let campaign = campaign(&base).expect("a campaign");
        let names: Vec<&str> = campaign.columns().iter().map(|it| it.name.as_str()).collect();
        let table = campaign.shard(0, &|| true).expect("not stopped");
        for name in ["z_m", "roll_deg", "pitch_deg", "stability_margin_deg"] {
            assert!(names.contains(&name), "{name} of {names:?}");
            let values = table.numbers(name);
            assert!(!values.is_empty() && values.iter().all(Option::is_some), "{name}");
        }
        assert!(!names.contains(&"belly_clearance_m"));
        let all = 0..campaign.runs();
        let runs = std::slice::from_ref(&all);
        let values: Vec<Option<f64>> = table.numbers("z_m").to_vec();
        let statistics = QuantityStatistics::of(&campaign, runs, &values, &[0.5]);
        let summary = statistics.summary.expect("there are runs");
        assert!((0.1..0.4).contains(&summary.mean.value), "{summary:?}");
    }
    let plane = campaign("study = \"traverse\"\n[scenario]\nduration_s = 1.0").expect("a campaign");
    assert!(plane.columns().iter().all(|it| it.name != "z_m"));
}

fn campaign(base: &str) -> Result<Campaign, DocumentError> {
    let text = format!(
        "schema = \"campaign/1\"\nruns = 30\nsampling = \"latin-hypercube\"\n\
         model_uncertainty = true\n{base}\n"
    );
    document::read_campaign(&Source::text("study.toml", text), &Overrides::none())
}

/// On 22° not all of the models hold the contour: the others' runs have no slip, and count as
/// slip 1.
#[test]
fn a_campaign_draws_models_and_leaves_no_run_out() {
    let base = "study = \"heading\"\nscenario = { soil = \"toyoura\", slope_deg = 22.0 }";
    let campaign = campaign(base).expect("a campaign");
    let table = campaign.shard(0, &|| true).expect("not stopped");
    let (models, statuses) = (table.texts("model"), table.texts("status"));
    let all = 0..campaign.runs();
    let runs = std::slice::from_ref(&all);
    let slips = table.numbers("slip_ratio");
    let counted = campaign.counted("slip_ratio", runs, slips, statuses);
    let yaws = campaign.counted("yaw_deg", runs, table.numbers("yaw_deg"), statuses);
    let study = HeadingStudy::of(&scenario(&[]).value);
    let (mut held, mut lost) = (0, 0);
    for (model, share) in ModelSpread::all(Some(&Model::Ishigami), Question::Across).shares() {
        let of_model = HeadingStudy { model: model.clone(), ..study.clone() };
        let found = of_model.on_slope(deg(22.0)).expect("sand").ok();
        let is_own = |run: &usize| models[*run].as_deref() == Some(model.name());
        let own: Vec<usize> = (0..table.rows()).filter(is_own).collect();
        // A Latin hypercube has the models by their shares.
        assert!((own.len() as f64 - 30.0 * share).abs() < 1.0, "{model:?}: {}", own.len());
        for run in own {
            assert_eq!(slips[run], found.as_ref().map(|heading| heading.slip_ratio));
            assert_eq!(counted[run], slips[run].or(Some(1.0)));
            assert_eq!(yaws[run].is_some(), found.is_some());
        }
        *(if found.is_some() { &mut held } else { &mut lost }) += 1;
    }
    assert!(held > 0 && lost > 0, "{held} models hold the contour, {lost} do not");
    assert_eq!(campaign.factors(), ["model"]);
    let named = base.replace("slope_deg", "model = \"rft\", slope_deg");
    let error = self::campaign(&named).expect_err("the model is named");
    assert!(error.to_string().contains("the base names its model"), "{error}");
}

/// A wheel that the soil does not carry counts as what the bands of a wheel test have for it.
#[test]
fn a_campaign_counts_wheels_that_sink() {
    let base = "study = \"wheel-test\"\nwheel_test = { soil = \"toyoura\", wheel = \"hakuto\", \
                load_n = 60000.0, slip_ratio = 0.2 }";
    let campaign = campaign(base).expect("a campaign");
    let table = campaign.shard(0, &|| true).expect("not stopped");
    let all = 0..campaign.runs();
    let (statuses, runs) = (table.texts("status"), std::slice::from_ref(&all));
    assert!(statuses.iter().all(|it| it.as_deref() == Some("soil cannot carry the load")));
    let all = |name: &str, value: f64| {
        let counted = campaign.counted(name, runs, table.numbers(name), statuses);
        counted.iter().all(|it| it.is_some_and(|it| (it - value).abs() < 1e-9 * value.abs()))
    };
    assert!(
        all("sinkage_mm", 110.0) && all("drawbar_pull_n", -60000.0) && all("torque_nm", 6600.0)
    );
    let thrust = campaign.counted("thrust_n", runs, table.numbers("thrust_n"), statuses);
    assert!(thrust.iter().all(Option::is_none));
}

/// Where the model has more drag and torque at the axle than the load, that counts: a locked wheel
/// that has dug itself in.
#[test]
fn a_locked_wheel_that_sinks_counts_with_the_drag_at_the_axle() {
    let test = stand(soil("fjs-1-loose").value, Model::SmallWheel);
    let slip = Slip::on_test_stand(-1.0, 0.0);
    let contact = Contact { wheel: test.wheel, soil: test.soil, slip, gravity: test.gravity };
    let at_axle = test.model.as_ref().forces(&contact, contact.wheel.shearing_radius());
    let load = 10.0 * at_axle.normal_force;
    let light = Sunk::of(&test.model, &contact, 0.1);
    assert!(at_axle.drawbar_pull < -0.1 && light.drawbar_pull == at_axle.drawbar_pull);
    assert!(light.torque == at_axle.torque && light.torque < 0.0);
    let heavy = Sunk::of(&test.model, &contact, load.max(-10.0 * at_axle.drawbar_pull));
    assert!(heavy.drawbar_pull <= 10.0 * at_axle.drawbar_pull);
}

// ---- What the guide says ----

#[test]
fn the_guide_has_the_weights_of_the_models() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/guide/uncertainty.md");
    let guide = std::fs::read_to_string(path).expect("the guide");
    for model in &Model::ALL {
        let row = format!("| `{}` | {} |", model.name(), weight(model));
        assert!(guide.contains(&row), "{row}");
    }
    assert!(guide.contains(&format!("{} %", 100.0 * OWN_SHARE)), "the own share");
}
