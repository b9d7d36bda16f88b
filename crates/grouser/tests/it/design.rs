//! Designs: closed forms, random designs that are worse, probabilities, and what has none.

use std::sync::atomic::{AtomicU32, Ordering};

use grouser::answers::design::DesignQuestion;
use grouser::answers::{AnswerError, AnswerOptions};
use grouser::contact::validity::Flag;
use grouser::document::design::Measure;
use grouser::document::{DocumentError, Kind, LoadedDesign, Overrides, Source, read_design};
use grouser::studies::design::{BestDesign, DesignStudy, NoDesign};
use grouser::units::{MARS_GRAVITY, MOON_GRAVITY};

const LIGHTER: &str = "design-lighter-wheels";

fn read(settings: &[&str]) -> Result<LoadedDesign, DocumentError> {
    let source = Source::find(Kind::Design, LIGHTER)?;
    read_design(&source, &Overrides::parse(settings)?)
}

fn read_text(text: &str) -> Result<LoadedDesign, DocumentError> {
    read_design(&Source::text("design.toml", text), &Overrides::none())
}

/// The study of a text below a head that all have.
fn study_of(text: &str) -> DesignStudy {
    let text = format!("schema = \"design/1\"\nslope_deg = 10.0\n{text}");
    DesignStudy::of(read_text(&text).expect("a design").value, false, 1)
}

fn measure(design: &BestDesign, measure: Measure) -> f64 {
    measure.unit().from_si(design.measures[measure.place()])
}

/// The excess of every limit, in its unit, and the aim of a design with other numbers.
fn misses(study: &DesignStudy, found: &BestDesign, values: &[f64]) -> Option<(f64, bool)> {
    let model = &study.task.candidates[0].grounds[0].scenario.value.model;
    let measures = study.nominal_measures(0, values, model)?;
    let keeps = found.kept.iter().all(|it| it.limit.holds(measures[it.limit.measure.place()]));
    Some((measures[Measure::WheelMass.place()], keeps))
}

#[test]
fn the_lightest_wheels_keep_their_limits_and_every_start_finds_them() {
    let study = DesignStudy::of(read(&[]).expect("a preset").value, false, 1);
    let found = study.design().expect("a design");
    assert_eq!(found.certificate.agreed, found.certificate.starts, "{found:?}");
    assert_eq!(found.certificate.better, 0, "{found:?}");
    assert!(measure(&found, Measure::LimitSlope) >= 21.0);
    assert!((measure(&found, Measure::SinkageRatio) - 0.1).abs() < 1e-6);
    // The price is what the aim falls by.
    let price = |name: Measure| {
        found.kept.iter().find(|it| it.limit.measure == name).map_or(f64::NAN, |it| it.price)
    };
    let loosened = read(&["design.subject_to.sinkage_ratio.at_most=0.1001"]).expect("a design");
    let loosened = DesignStudy::of(loosened.value, false, 1).design().expect("a design");
    let fell = (found.objective - loosened.objective) / 1e-4;
    assert!((fell / price(Measure::SinkageRatio) - 1.0).abs() < 0.01, "{fell} {found:?}");
    assert_eq!(price(Measure::LimitSlope), 0.0);
}

#[test]
fn no_random_design_is_better() {
    random_designs_are_worse(200);
}

#[test]
#[ignore = "minutes"]
fn none_of_ten_thousand_random_designs_is_better() {
    random_designs_are_worse(10_000);
}

fn random_designs_are_worse(count: u32) {
    let study = DesignStudy::of(read(&[]).expect("a preset").value, false, 1);
    let found = study.design().expect("a design");
    let mut feasible = 0;
    for number in 0..count {
        let share = |factor: f64| (0.5 + f64::from(number) * factor).fract();
        let shares = [share(0.754_877_666), share(0.569_840_290)];
        let values = study.task.free.iter().zip(shares);
        let values: Vec<f64> =
            values.map(|((_, [least, most]), share)| least + share * (most - least)).collect();
        if let Some((mass, true)) = misses(&study, &found, &values) {
            feasible += 1;
            assert!(mass > found.objective, "{values:?} {mass} {found:?}");
        }
    }
    assert!(feasible * 10 > count, "{feasible} of {count} keep the limits");
}

#[test]
fn a_width_that_is_asked_for_is_the_closed_form() {
    // The mass of a sheet wheel goes with its width, and the rover's width is that of its track and one
    // wheel: both are straight lines.
    let study = study_of(
        "minimise = \"wheel_mass_kg\"\n[free]\n\"rover.wheel_unit.wheel.width_m\" = [0.05, 0.2]\n\
         [subject_to]\nwidth_m = { at_least = 0.6 }\n",
    );
    let ground = &study.task.candidates[0].grounds[0].scenario.value;
    let mounts = ground.rover.mounts();
    let track = 2.0 * mounts.iter().map(|it| it.position.y.abs()).fold(0.0, f64::max);
    let unit = ground.rover.parts().wheel_unit;
    let per_metre = mounts.len() as f64 * unit.mass / unit.wheel.width;
    let found = study.design().expect("a design");
    assert!((found.values[0] - (0.6 - track)).abs() < 1e-7, "{found:?} {track}");
    assert!((found.objective - per_metre * (0.6 - track)).abs() < 1e-6, "{found:?}");
    let width = found.kept.iter().find(|it| it.limit.measure == Measure::Width).expect("a limit");
    assert!((width.price - per_metre).abs() < 1e-3 * per_metre, "{width:?} {per_metre}");
}

/// The wider the track, the less the lower wheels sink on a cross slope: a limit on the width says how
/// wide it gets, and wheels that are tied move with the one that is free.
#[test]
fn a_track_of_tied_wheels_is_the_closed_form() {
    let study = study_of(
        "minimise = \"sinkage_ratio\"\n[free]\n\"rover.mount.0.position_m.1\" = [0.15, 0.4]\n\
         [tied]\n\"rover.mount.1.position_m.1\" = \"rover.mount.0.position_m.1\"\n\
         \"rover.mount.2.position_m.1\" = \"-rover.mount.0.position_m.1\"\n\
         \"rover.mount.3.position_m.1\" = \"-rover.mount.0.position_m.1\"\n\
         [subject_to]\nwidth_m = { at_most = 0.62 }\n",
    );
    let found = study.design().expect("a design");
    let rover = study.rover(&found).expect("a rover");
    let half = 0.5 * (0.62 - rover.parts().wheel_unit.wheel.width);
    assert!((found.values[0] - half).abs() < 1e-6, "{found:?}");
    for (mount, side) in rover.mounts().iter().zip([1.0, 1.0, -1.0, -1.0]) {
        assert_eq!(mount.position.y, side * found.values[0]);
    }
}

#[test]
fn what_is_chosen_is_the_best_of_all_that_may_be() {
    let body = "minimise = \"energy_j_per_m\"\n\
                [free]\n\"rover.wheel_unit.wheel.radius_m\" = [0.08, 0.12]\n\
                [subject_to]\nwheel_mass_kg = { at_most = 1.8 }\n";
    let one = |count: u32| {
        study_of(&format!(
            "{body}[choose]\n\"rover.wheel_unit.wheel.grousers.count\" = [{count}]\n"
        ))
    };
    let each: Vec<f64> =
        [8, 24].map(|count| one(count).design().expect("a design").objective).into();
    let both =
        study_of(&format!("{body}[choose]\n\"rover.wheel_unit.wheel.grousers.count\" = [8, 24]\n"));
    let found = both.design().expect("a design");
    assert_eq!(found.objective, each[0].min(each[1]));
    assert_ne!(each[0], each[1]);
    let rovers = study_of(&format!("{body}[choose]\nrover = [\"hakuto\", \"mgru3\"]\n"));
    assert_eq!(rovers.task.candidates.len(), 2);
    assert_ne!(
        rovers.task.candidates[0].grounds[0].scenario.value.rover,
        rovers.task.candidates[1].grounds[0].scenario.value.rover
    );
}

#[test]
fn a_chosen_wheel_weighs_what_the_same_wheel_weighs_that_is_free() {
    let with = |more: &str| {
        let free = "minimise = \"wheel_mass_kg\"\n[free]\n\"rover.wheel_unit.wheel.width_m\" = [0.05, 0.06]\n";
        study_of(&format!("{free}{more}")).design().expect("a design").objective
    };
    let chosen = with("[choose]\nrover.wheel_unit.wheel.radius_m = [0.09]\n");
    let free = with("\"rover.wheel_unit.wheel.radius_m\" = [0.09, 0.12]\n");
    assert!((chosen - free).abs() < 1e-6 * free, "{chosen} {free}");
}

#[test]
fn a_current_is_that_of_the_largest_torque() {
    let study = study_of(
        "minimise = \"current_a\"\ncourse_deg = 90.0\n\
         [free]\n\"rover.wheel_unit.wheel.radius_m\" = [0.08, 0.12]\n\
         [choose]\nrover.motor = [\"maxon-re-30\", \"maxon-re-25\"]\n",
    );
    let found = study.design().expect("a design");
    let rover = study.rover(&found).expect("a rover");
    let motor = rover.mounts()[0].unit.motor.expect("a motor");
    let torque = measure(&found, Measure::Torque);
    // Uphill every wheel drives: T = N η (k i − τ_f).
    let current =
        (torque / (motor.gear_ratio * motor.efficiency) + motor.friction) / motor.torque_constant;
    assert!((measure(&found, Measure::Current) - current).abs() < 1e-9 * current, "{found:?}");
    assert_eq!(found.objective, measure(&found, Measure::Current));
    assert_eq!(measure(&found, Measure::BrakingTorque), 0.0);
}

#[test]
fn wheels_brake_downhill() {
    let body = "minimise = \"wheel_mass_kg\"\nslope_deg = 20.0\ncourse_deg = -90.0\n\
                [free]\n\"rover.wheel_unit.wheel.radius_m\" = [0.08, 0.16]\n";
    let of = |more: &str| {
        let text = format!("schema = \"design/1\"\n{body}{more}");
        let study = DesignStudy::of(read_text(&text).expect("a design").value, false, 1);
        study.design().expect("a design")
    };
    let free = of("");
    let braking = measure(&free, Measure::BrakingTorque);
    assert!(braking > 0.0 && braking == measure(&free, Measure::Torque), "{free:?}");
    let more = format!("[subject_to]\nbraking_torque_nm = {{ at_least = {} }}\n", 1.1 * braking);
    let limited = of(&more);
    assert!((measure(&limited, Measure::BrakingTorque) / braking - 1.1).abs() < 1e-6);
    assert!(limited.objective > free.objective, "{limited:?}");
}

#[test]
fn a_gravity_is_a_number_or_a_word() {
    let body = "minimise = \"wheel_mass_kg\"\n\
                [free]\n\"rover.wheel_unit.wheel.radius_m\" = [0.06, 0.16]\n\
                [[also]]\ngravity_m_s2 = ";
    let gravities = |word: &str| {
        let study = study_of(&format!("gravity_m_s2 = \"mars\"\n{body}{word}\n"));
        let grounds = study.task.candidates[0].grounds.iter();
        grounds.map(|it| it.scenario.value.gravity).collect::<Vec<f64>>()
    };
    assert_eq!(gravities("\"moon\""), [MARS_GRAVITY, MOON_GRAVITY]);
    assert_eq!(gravities("1.5"), [MARS_GRAVITY, 1.5]);
}

#[test]
fn a_design_beyond_its_models_domain_says_so() {
    let study = study_of(
        "minimise = \"wheel_mass_kg\"\nmodel = \"ishigami\"\n\
         [free]\n\"rover.wheel_unit.wheel.radius_m\" = [0.06, 0.16]\n",
    );
    let of = |radius: f64| study.findings(0, &[radius], None);
    let is_too_small = |radius: f64| of(radius).iter().any(|it| it.flag == Flag::RadiusOutside);
    // Ishigami's wheels were of 0.09 m and more.
    assert!(is_too_small(0.07) && !is_too_small(0.1), "{:?}", of(0.1));
    assert_eq!(study.design().expect("a design").values, [0.06]);
}

#[test]
fn a_search_is_stopped_on_its_way() {
    let study = study_of(
        "minimise = \"wheel_mass_kg\"\nsoil = \"toyoura-uncertain\"\n\
         [free]\n\"rover.wheel_unit.wheel.radius_m\" = [0.06, 0.16]\n",
    );
    for most in [0, 3, 40] {
        let measured = AtomicU32::new(0);
        let go_on = || measured.fetch_add(1, Ordering::Relaxed) < most;
        assert_eq!(study.design_while(&go_on).map(drop), Err(NoDesign::Stopped), "{most}");
        // What was asked of other threads before they were stopped.
        assert!(measured.into_inner() < most + 200, "{most}");
    }
}

#[test]
fn limits_hold_on_every_ground() {
    let body = "minimise = \"wheel_mass_kg\"\n\
                [free]\n\"rover.wheel_unit.wheel.radius_m\" = [0.06, 0.16]\n\
                [subject_to]\nsinkage_ratio = { at_most = 0.12 }\n";
    let alone = study_of(body).design().expect("a design");
    let both = study_of(&format!("{body}[[also]]\nslope_deg = 18.0\ncourse_deg = 60.0\n"));
    let found = both.design().expect("a design");
    assert!(found.objective > alone.objective, "{alone:?} {found:?}");
    let grounds: Vec<usize> = found.kept.iter().map(|it| it.limit.ground).collect();
    assert!(grounds.contains(&0) && grounds.contains(&1), "{grounds:?}");
    assert!(found.kept.iter().all(|it| it.limit.holds(it.value)), "{found:?}");
    let holding = found.kept.iter().find(|it| it.price > 0.0).expect("a limit that holds it back");
    assert_eq!(holding.limit.ground, 1, "{found:?}");
}

#[test]
fn a_limit_on_an_uncertain_soil_is_kept_by_the_share_that_is_asked_for() {
    let body = "soil = \"toyoura-uncertain\"\nmodel = \"ishigami\"\nminimise = \"wheel_mass_kg\"\n\
                [free]\n\"rover.wheel_unit.wheel.radius_m\" = [0.06, 0.16]\n\
                [subject_to]\nsinkage_ratio = { at_most = 0.2 }\n";
    let with = |probability: f64| {
        // A key of the whole document stands before its tables.
        study_of(&format!("probability = {probability}\n{body}")).design().expect("a design")
    };
    let [half, most] = [0.5, 0.95].map(with);
    assert!(half.objective < most.objective, "{half:?} {most:?}");
    let share = |design: &BestDesign| {
        let of = |measure: Measure| {
            design.kept.iter().find(|it| it.limit.measure == measure).and_then(|it| it.share)
        };
        of(Measure::SinkageRatio).expect("a share")
    };
    // Of 40 samples that were looked at and 200 that were not: two standard deviations of both.
    assert!((share(&half) - 0.5).abs() < 0.18, "{half:?}");
    assert!(share(&most) > 0.86, "{most:?}");
}

#[test]
fn a_trade_off_leads_from_one_least_to_the_other() {
    let study = DesignStudy::of(read(&[]).expect("a preset").value, false, 1);
    let [first, second] = [Measure::EnergyPerMetre, Measure::WheelMass];
    let designs = study.trade_off([first, second], 5, &|| true).expect("designs");
    assert_eq!(designs.len(), 5);
    for pair in designs.windows(2) {
        assert!(measure(&pair[0], first) <= measure(&pair[1], first) + 1e-6, "{pair:?}");
        assert!(measure(&pair[0], second) >= measure(&pair[1], second) - 1e-6, "{pair:?}");
    }
}

#[test]
fn a_weighted_sum_lies_between_its_parts() {
    let body = "[free]\n\"rover.wheel_unit.wheel.radius_m\" = [0.06, 0.16]\n\
                \"rover.wheel_unit.wheel.grousers.height_m\" = [0.002, 0.02]\n";
    let design = |head: &str| study_of(&format!("{head}\n{body}")).design().expect("a design");
    let both = design(
        "minimise = \"weighted_sum\"\nweights = { wheel_mass_kg = 2.0, energy_j_per_m = 0.5 }",
    );
    let mass = design("minimise = \"wheel_mass_kg\"");
    let energy = design("minimise = \"energy_j_per_m\"");
    let sum = |it: &BestDesign| {
        2.0 * measure(it, Measure::WheelMass) + 0.5 * measure(it, Measure::EnergyPerMetre)
    };
    assert!((sum(&both) - both.objective).abs() < 1e-9 * both.objective, "{both:?}");
    assert!(sum(&both) <= sum(&mass) + 1e-6 && sum(&both) <= sum(&energy) + 1e-6);
}

#[test]
fn what_has_no_design_says_which_limit_and_how_far() {
    let question = |settings: &[&str]| DesignQuestion {
        task: read(settings).expect("a design"),
        is_nominal: false,
        seed: 1,
        trade: None,
        by_models: Vec::new(),
    };
    let why = |settings: &[&str]| match question(settings).answer("design", &AnswerOptions::ROWS) {
        Err(AnswerError::Design(why)) => why,
        other => panic!("{other:?}"),
    };
    let steep = why(&["design.subject_to.limit_slope_deg.at_least=35"]);
    assert!(
        steep.contains("crosses 35° of this soil: the ground's own limit is 31.01°"),
        "{steep}"
    );
    assert!(steep.contains("subject_to.limit_slope_deg"), "{steep}");
    let between = why(&["design.subject_to.limit_slope_deg.at_least=30"]);
    assert!(between.contains("limit_slope_deg ≥ 30 where it has 2"), "{between}");
    assert!(between.contains("radius_m is the most that it may be"), "{between}");
    let shallow = why(&["design.subject_to.sinkage_ratio.at_most=0.01"]);
    assert!(shallow.contains("sinkage_ratio ≤ 0.01"), "{shallow}");
    let text = "schema = \"design/1\"\nminimise = \"wheel_mass_kg\"\n[free]\n\
                \"rover.body.mass_kg\" = [3.0, 5.0]\n";
    let constant = DesignQuestion { task: read_text(text).expect("a design"), ..question(&[]) };
    let constant = constant.answer("design", &AnswerOptions::ROWS).map(drop);
    let Err(AnswerError::Design(constant)) = constant else { panic!("{constant:?}") };
    assert!(constant.contains("does not depend on any number that is free (rover.body.mass_kg)"));
}

#[test]
fn documents_that_say_nothing_that_can_be_are_refused_where_they_say_it() {
    let refused = |text: &str| {
        let text = format!("schema = \"design/1\"\n{text}");
        read_text(&text).map(drop).expect_err("it is refused").to_string()
    };
    let mass = "minimise = \"wheel_mass_kg\"\n[free]\n";
    for (text, words) in [
        (format!("{mass}\"rover.wheel_unit.wheel.radius_m\" = [0.2, 0.1]"), "below the second"),
        (format!("{mass}\"rover.wheel_unit.wheel.radus_m\" = [0.1, 0.2]"), "radius_m"),
        (format!("{mass}\"rover.wheel_unit.wheel.radius_m\" = [0.1, 200.0]"), "200"),
        (format!("{mass}\"soil.friction_angle_deg\" = [20, 40]"), "only numbers of the rover"),
        (
            format!(
                "{mass}\"rover.mount.0.position_m.1\" = [0.1, 0.2]\n[tied]\n\
                 \"rover.mount.1.position_m.1\" = \"rover.mount.2.position_m.1\""
            ),
            "what it is tied to is not free",
        ),
        (format!("{mass}\"rover.mount.0.position_m.2\" = [-0.2, -0.1]"), "alone leaves no rover"),
        (
            format!(
                "{mass}\"rover.mount.0.position_m.1\" = [0.1, 0.2]\n[tied]\n\
                 \"rover.mount.7.position_m.1\" = \"rover.mount.0.position_m.1\""
            ),
            "rover.mount.7",
        ),
        (
            format!(
                "{mass}\"rover.wheel_unit.wheel.radius_m\" = [0.1, 0.2]\n[subject_to]\n\
                 slip_ratio = {{ at_least = 0.5, at_most = 0.2 }}"
            ),
            "`at_least` is above `at_most`",
        ),
        (
            format!(
                "slope_deg = 10.0\n{mass}\"rover.wheel_unit.wheel.radius_m\" = [0.1, 0.2]\n\
                 [subject_to]\nlimit_slope_deg = {{ at_most = 8.0 }}"
            ),
            "which is to be crossed",
        ),
        (
            format!(
                "{mass}\"rover.wheel_unit.wheel.radius_m\" = [0.1, 0.2]\n\
                 [subject_to]\ncurrent_a = {{ at_most = 1.0 }}"
            ),
            "no motor of the rover is known",
        ),
        (
            format!(
                "{mass}\"rover.wheel_unit.wheel.radius_m\" = [0.1, 0.2]\n\
                 [subject_to]\nsinkage_rato = {{ at_most = 1.0 }}"
            ),
            "did you mean `sinkage_ratio`?",
        ),
        (
            "minimise = \"weighted_sum\"\n[free]\n\
             \"rover.wheel_unit.wheel.radius_m\" = [0.1, 0.2]"
                .to_owned(),
            "`weights`",
        ),
        (
            format!(
                "{mass}\"rover.wheel_unit.wheel.radius_m\" = [0.1, 0.2]\n[choose]\n\
                 rover = [\"no-such-rover\"]"
            ),
            "no-such-rover",
        ),
        (
            format!(
                "{mass}\"rover.wheel_unit.wheel.radius_m\" = [0.1, 0.2]\n[choose]\n\
                 slope_deg = [2.0, 10.0]"
            ),
            "may be chosen",
        ),
    ] {
        let message = refused(&text);
        assert!(message.contains(words), "{text}\n{message}");
    }
}
