//! What models have achieved, and the weights that follow: the law of stacking, the weights that
//! are in force, and the bands of all models on the sets that come with the library.

use std::sync::LazyLock;

use grouser::contact::Model;
use grouser::document::measurements::Limits;
use grouser::document::ranking::evidence;
use grouser::studies::ensemble::models::{Question, answers, weight};
use grouser::studies::evidence::{
    Answer, AnswerKind, Evidence, SHRINKAGE, Shares, judged, stacked, without,
};

/// Number of samples, as in `validate`; half as many move a weight by a hundredth or two.
const SAMPLES: u64 = 100;

static ALL: LazyLock<Vec<Evidence>> =
    LazyLock::new(|| evidence(SAMPLES, 1, Limits::default()).expect("the library's own sets"));

/// A set with one kind of answer, of which each model's samples lie about a number of its own.
fn set(source: &str, kind: AnswerKind, question: Question, middles: [f64; 4]) -> Evidence {
    let spread = |middle: f64| (0..50).map(|it| middle + 1e-3 * f64::from(it - 25)).collect();
    let predicted: [Vec<f64>; 4] = middles.map(spread);
    let answer = Answer { kind, question, measured: 0.0, predicted };
    Evidence {
        data_set: source.to_owned(),
        case: String::new(),
        soil: String::new(),
        source: source.to_owned(),
        in_sample: None,
        answers: vec![answer; 3],
    }
}

fn near(one: &Shares, other: &Shares, tolerance: f64) -> bool {
    one.iter().zip(other).all(|(one, other)| (one - other).abs() < tolerance)
}

/// Models that cannot be told apart share alike; one that alone is right has all but what shrinkage
/// takes.
#[test]
fn stacking_has_its_limits() {
    let alike = set("a", AnswerKind::Pull, Question::Along, [0.1; 4]);
    assert!(near(&stacked(&[&alike]), &[0.25; 4], 1e-9));
    let one = set("a", AnswerKind::Pull, Question::Along, [0.0, 9.0, 9.0, 9.0]);
    let kept = SHRINKAGE / 4.0 / (1.0 + SHRINKAGE);
    let found = stacked(&[&one]);
    assert!(near(&found, &[1.0 - 3.0 * kept, kept, kept, kept], 1e-3), "{found:?}");
}

/// A kind of answer counts as one, however many sets and numbers have it.
#[test]
fn no_kind_rules_by_its_number_of_points() {
    let pull = set("a", AnswerKind::Pull, Question::Along, [0.0, 9.0, 9.0, 9.0]);
    let mut sinkage = set("b", AnswerKind::Sinkage, Question::Along, [9.0, 9.0, 0.0, 9.0]);
    let few = stacked(&[&pull, &sinkage]);
    sinkage.answers = vec![sinkage.answers[0].clone(); 90];
    let many = stacked(&[&pull, &sinkage, &sinkage]);
    assert!(near(&few, &many, 1e-9) && (few[0] - few[2]).abs() < 1e-3, "{few:?} {many:?}");
}

/// Where it is not asked a model neither gains nor loses: Bekker's closed form knows no force
/// across a wheel.
#[test]
fn a_question_that_a_model_cannot_answer_tells_nothing_of_it() {
    let across = set("a", AnswerKind::SideForce, Question::Across, [0.0, 0.0, 9.0, 9.0]);
    let found = stacked(&[&across]);
    let place = |model| Model::ALL.iter().position(|it| *it == model).expect("one of them");
    let bekker = found[place(Model::Bekker)];
    assert!((bekker - 0.25).abs() < 1e-6, "{found:?}");
    assert!(found[place(Model::Ishigami)] > 0.65, "{found:?}");
    assert!(answers(&Model::Bekker, Question::Along) && !answers(&Model::Bekker, Question::Across));
}

/// The shares that are in force are those of the evidence: whoever changes a model, a prior or a
/// set finds them here.
#[test]
fn the_weights_are_those_of_the_evidence() {
    let open: Vec<&Evidence> = ALL.iter().filter(|it| it.in_sample.is_none()).collect();
    let found = stacked(&open);
    for (model, share) in Model::ALL.iter().zip(found) {
        assert!((share - weight(model)).abs() < 0.03, "{}: {share}", model.name());
    }
    // By how much they move with one set left out, as the guide says.
    for set in &open {
        let left: Shares = without(set, &ALL);
        assert!(near(&left, &found, 0.13), "without {}: {left:?}", set.case);
    }
}

/// The band of weights that were found without a set holds what was measured there, and the median
/// is near.
#[test]
fn bands_hold_sets_that_their_weights_have_not_seen() {
    let (mut numbers, mut held) = (0, 0);
    for set in &*ALL {
        for it in judged(set, &without(set, &ALL)) {
            numbers += it.count;
            held += it.held;
            let most = match (set.case.as_str(), it.kind) {
                ("ding-2011-smooth" | "viper-trec-grc3", AnswerKind::Pull) => 0.08,
                ("rashid-fjs1", AnswerKind::Pull) => 0.20,
                ("mgru3-grc1", AnswerKind::Slip) => 0.15,
                _ => continue,
            };
            assert!(it.rmse < most, "{}, {}: {}", set.case, it.kind.name(), it.rmse);
        }
    }
    let share = f64::from(u32::try_from(held).expect("few")) / numbers as f64;
    assert!(share > 0.9, "{share}");
}

/// The card's own physics on the paper's sand: the mean yaws of the measured runs, which chose no
/// weight.
#[test]
fn headings_of_hakuto_are_near_those_that_were_measured() {
    let set = ALL.iter().find(|it| it.case == "contour").expect("the paper's runs");
    assert_eq!(set.in_sample, Some(Model::Ishigami));
    let shares = without(set, &ALL);
    for (answer, most) in set.answers.iter().zip([1.5, 1.5, 1.5, 3.0]) {
        let error = (answer.quantile(&shares, 0.5) - answer.measured).to_degrees();
        assert!(error.abs() < most, "{:.1}°: {error:.2}°", answer.measured.to_degrees());
    }
}
