//! Questions and their answers, as a front end asks them.

use grouser::answers::heading::HeadingQuestion;
use grouser::answers::heading_map::HeadingMapQuestion;
use grouser::answers::wheel_test::{SimulatedStand, WheelTestQuestion};
use grouser::answers::{Answer, AnswerError, AnswerOptions, Sampling};
use grouser::document::{
    self, Kind, LoadedScenario, Overrides, Source, read_scenario, read_soil, read_wheel,
};
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::heading::Steering;
use grouser::studies::verdict::Rule;

const SAMPLING: Sampling = Sampling { count: 3, seed: 1 };

fn scenario() -> LoadedScenario {
    read_scenario(&Source::default_scenario(), &Overrides::none()).expect("the default scenario")
}

fn headings() -> HeadingQuestion {
    HeadingQuestion {
        scenarios: vec![scenario()],
        slopes_deg: vec![5.0, 10.0],
        steering: Steering::None,
        most_speed_ratio: None,
        sampling: None,
        gradients: None,
        rule: Rule::DEFAULT,
    }
}

fn heading_map() -> HeadingMapQuestion {
    HeadingMapQuestion {
        scenarios: vec![scenario()],
        has_every_model: false,
        slopes_deg: vec![5.0, 10.0],
        courses_deg: vec![0.0, 0.0, 30.0],
        rim_speed: 0.06,
        sampling: None,
        gradients: None,
    }
}

fn wheel_test() -> WheelTestQuestion {
    let find = |kind, name| Source::find(kind, name).expect("a preset");
    let soil = read_soil(&find(Kind::Soil, "toyoura"), &Overrides::none()).expect("a soil");
    let wheel = read_wheel(&find(Kind::Wheel, "hakuto"), &Overrides::none()).expect("a wheel");
    let model = soil.document.usual_model("");
    let band = BandInputs::of_soil(&soil, None);
    WheelTestQuestion {
        soil,
        wheel,
        gravity: 9.80665,
        models: vec![(model, band)],
        is_model_named: false,
        loads: vec![17.0],
        slip_angles_deg: vec![0.0],
        slip_ratios: vec![0.1, 0.2, 0.3],
        stand: None,
        sampling: None,
        gradients: None,
    }
}

/// The number of rows of an answer's first table.
fn rows(answer: &Result<Answer, AnswerError>) -> usize {
    answer.as_ref().expect("an answer").tables[0].1.rows()
}

#[test]
fn questions_have_their_rows_with_and_without_a_page() {
    for has_page in [false, true] {
        let options = AnswerOptions { has_page, ..AnswerOptions::ROWS };
        assert_eq!(rows(&headings().answer("heading", &options)), 2);
        assert_eq!(rows(&heading_map().answer("heading-map", &options)), 6);
        assert_eq!(rows(&wheel_test().answer("wheel-test", &options)), 3);
    }
}

#[test]
fn an_answer_is_the_same_with_and_without_a_page() {
    let json = |has_page| {
        let options = AnswerOptions { has_page, ..AnswerOptions::ROWS };
        let question = HeadingQuestion { sampling: Some(SAMPLING), ..headings() };
        let answer = question.answer("heading", &options).expect("an answer");
        assert_eq!(answer.page.is_empty(), !has_page);
        serde_json::to_string(&answer).expect("an answer is JSON")
    };
    assert_eq!(json(false), json(true));
}

#[test]
fn a_stop_is_no_answer() {
    let options = AnswerOptions { go_on: &|| false, ..AnswerOptions::ROWS };
    let sampling = Some(SAMPLING);
    let stopped = [
        HeadingQuestion { sampling, ..headings() }.answer("heading", &options),
        HeadingMapQuestion { sampling, ..heading_map() }.answer("heading-map", &options),
        WheelTestQuestion { sampling, ..wheel_test() }.answer("wheel-test", &options),
    ];
    for answer in stopped {
        assert_eq!(answer.err(), Some(AnswerError::Stopped));
    }
}

#[test]
fn flags_are_errors_where_none_is_accepted() {
    let moon = document::read_scenario(
        &Source::default_scenario(),
        &Overrides::parse(["scenario.gravity_m_s2=1.62"]).expect("a setting"),
    );
    let scenarios = vec![moon.expect("a scenario")];
    let question = HeadingQuestion { scenarios, ..headings() };
    let strict = AnswerOptions { is_strict: true, ..AnswerOptions::ROWS };
    let refused = question.answer("heading", &strict);
    assert!(matches!(refused, Err(AnswerError::OutsideDomain(_))), "{refused:?}");
    assert!(question.answer("heading", &AnswerOptions::ROWS).is_ok());
}

#[test]
fn what_has_no_answer_is_refused_by_name() {
    let options = &AnswerOptions::ROWS;
    let (sampling, steering) = (Some(SAMPLING), Steering::Crab);
    let noise = SimulatedStand { trials: 2, noise_n: 0.3, noise_mm: 0.5, noise_nm: 0.02, seed: 1 };
    for (answer, what) in [
        (HeadingQuestion { scenarios: Vec::new(), ..headings() }.answer("a", options), "scenarios"),
        (HeadingQuestion { sampling, steering, ..headings() }.answer("a", options), "steered"),
        (
            HeadingMapQuestion { courses_deg: vec![], ..heading_map() }.answer("a", options),
            "courses",
        ),
        (WheelTestQuestion { models: Vec::new(), ..wheel_test() }.answer("a", options), "models"),
        (
            WheelTestQuestion { stand: Some(noise), sampling, ..wheel_test() }.answer("a", options),
            "simulated stand",
        ),
    ] {
        let error = answer.expect_err("no answer").to_string();
        assert!(error.contains(what), "{error}");
    }
}
