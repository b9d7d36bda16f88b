//! Weights of models by stacking, and bands of the weighted models.

use super::answer::{Answer, AnswerKind, Evidence};
use super::density::density;
use crate::contact::Model;
use crate::studies::ensemble::models::{self, ModelSpread, Question};
use grouser_io::statistics::{interval_score, weighted_quantile};

/// A share for each model, in the order of [`Model::ALL`], with the sum 1 [-].
pub type Shares = [f64; Model::COUNT];

/// How strongly shares are drawn towards equal ones [-]: as much as evidence of this weight, where
/// one is all that there is. Source: ours; sets are few, and each has one wheel on one bed.
pub const SHRINKAGE: f64 = 0.1;

/// The shares by which a set is judged: those of all sets whose soils are from elsewhere. A soil
/// that was made for a model with the set in view has that model with
/// [`OWN_SHARE`](models::OWN_SHARE).
#[must_use]
pub fn without(set: &Evidence, all: &[Evidence]) -> Shares {
    let others = all.iter().filter(|it| it.in_sample.is_none() && it.source != set.source);
    let shares = stacked(&others.collect::<Vec<_>>());
    let Some(own) = &set.in_sample else { return shares };
    let stacked = |model: &Model| {
        Model::ALL.iter().zip(shares).find(|(it, _)| *it == model).map_or(0.0, |(_, share)| share)
    };
    ModelSpread::by(stacked, Some(own), Question::Along).in_order()
}

/// The shares w under which the mixture of all models makes what was measured most probable:
///
/// ```text
/// max  Σ_k (1/K) Σ_s (1/S_k) (1/N_ks) Σ_i log Σ_m w_m p_m(y_i)  +  κ Σ_m (1/M) log w_m
/// ```
///
/// over kinds k of answer, the sets s that have them and their numbers i: each kind counts alike,
/// and so does each set within a kind. p_m is the density of a model's samples; a question that a
/// model cannot answer is put to the others, in proportion of their shares. κ is the [`SHRINKAGE`].
/// (Yao et al. 2018; the maximum is found by expectation and maximisation.)
#[must_use]
pub fn stacked(evidence: &[&Evidence]) -> Shares {
    let answers = weighted(evidence);
    let equal = 1.0 / Model::COUNT as f64;
    let mut shares = [equal; Model::COUNT];
    for _ in 0..ROUNDS {
        let mut next = [SHRINKAGE * equal / (1.0 + SHRINKAGE); Model::COUNT];
        for Weighted { weight, densities } in &answers {
            let part = weight / (1.0 + SHRINKAGE);
            for (share, owned) in next.iter_mut().zip(owners(&shares, densities)) {
                *share += part * owned;
            }
        }
        shares = next;
    }
    shares
}

/// Rounds until nothing moves by more than a millionth.
const ROUNDS: usize = 2000;

/// An answer with its weight.
struct Weighted {
    weight: f64,
    densities: [Option<f64>; Model::COUNT],
}

fn weighted(evidence: &[&Evidence]) -> Vec<Weighted> {
    let of = |kind: AnswerKind| {
        let sets = evidence.iter().map(move |set| {
            set.answers.iter().filter(|it| it.kind == kind).collect::<Vec<&Answer>>()
        });
        sets.filter(|answers| !answers.is_empty()).collect::<Vec<_>>()
    };
    let kinds: Vec<Vec<Vec<&Answer>>> =
        AnswerKind::ALL.into_iter().map(of).filter(|sets| !sets.is_empty()).collect();
    let mut all = Vec::new();
    for sets in &kinds {
        for answers in sets {
            let weight = 1.0 / (kinds.len() * sets.len() * answers.len()) as f64;
            all.extend(answers.iter().map(|it| Weighted { weight, densities: it.densities() }));
        }
    }
    all
}

/// To which model an answer belongs, with which probability. One that a model was not asked belongs
/// to that model as often as any other: it tells nothing of it.
fn owners(shares: &Shares, densities: &[Option<f64>; Model::COUNT]) -> Shares {
    let pairs = || shares.iter().zip(densities);
    let asked: f64 = pairs().filter_map(|(share, density)| density.map(|_| share)).sum();
    let sum: f64 = pairs().filter_map(|(share, density)| density.map(|it| share * it)).sum();
    let one = |place: usize| match densities[place] {
        Some(density) => asked * shares[place] * density / sum,
        None => shares[place],
    };
    std::array::from_fn(one)
}

impl Answer {
    /// The density of each model's samples at what was measured, where the model is asked.
    fn densities(&self) -> [Option<f64>; Model::COUNT] {
        let is_asked = |model: &Model| models::answers(model, self.question);
        std::array::from_fn(|place| {
            is_asked(&Model::ALL[place])
                .then(|| density(&self.predicted[place], self.kind.noise(), self.measured))
        })
    }

    /// The value that a share of the weighted samples lies below.
    #[must_use]
    pub fn quantile(&self, shares: &Shares, share: f64) -> f64 {
        let mut all: Vec<(f64, f64)> = Vec::new();
        for (place, samples) in self.predicted.iter().enumerate() {
            if models::answers(&Model::ALL[place], self.question) {
                let weight = shares[place] / samples.len() as f64;
                all.extend(samples.iter().map(|sample| (*sample, weight)));
            }
        }
        weighted_quantile(all, share).unwrap_or(f64::NAN)
    }
}

/// How good a band is, over the numbers of one kind in one set, in the kind's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judged {
    /// What was asked.
    pub kind: AnswerKind,
    /// How many numbers.
    pub count: usize,
    /// Root mean square of the weighted median minus what was measured.
    pub rmse: f64,
    /// The largest difference.
    pub worst: f64,
    /// How many of them the 95 % band holds.
    pub held: usize,
    /// The band's mean width.
    pub width: f64,
    /// Its mean interval score: width, and forty times by how much it misses.
    pub interval_score: f64,
}

/// A set judged by the band of some shares, kind by kind.
#[must_use]
pub fn judged(evidence: &Evidence, shares: &Shares) -> Vec<Judged> {
    let one = |kind: AnswerKind| {
        let answers: Vec<&Answer> = evidence.answers.iter().filter(|it| it.kind == kind).collect();
        (!answers.is_empty()).then(|| Judged::of(kind, &answers, shares))
    };
    AnswerKind::ALL.into_iter().filter_map(one).collect()
}

impl Judged {
    fn of(kind: AnswerKind, answers: &[&Answer], shares: &Shares) -> Self {
        let mut all = Self {
            kind,
            count: answers.len(),
            rmse: 0.0,
            worst: 0.0,
            held: 0,
            width: 0.0,
            interval_score: 0.0,
        };
        let share = 1.0 / answers.len() as f64;
        for answer in answers {
            let [low, middle, high] = [0.025, 0.5, 0.975].map(|it| answer.quantile(shares, it));
            let error = middle - answer.measured;
            all.rmse += share * error * error;
            all.worst = all.worst.max(error.abs());
            all.held += usize::from((low..=high).contains(&answer.measured));
            all.width += share * (high - low);
            all.interval_score += share * interval_score([low, high], answer.measured);
        }
        Self { rmse: all.rmse.sqrt(), ..all }
    }
}
