//! The wheel–soil models of a band: where no model is asked for, each sample has one of several, by
//! weight.
//!
//! Models disagree by more than the parameters of any of them vary, so that a band of one model's
//! parameters alone is too narrow. [`weight`] is the one place of their weights, which follow from
//! what the models have achieved ([`evidence`](crate::studies::evidence)).

use crate::contact::Model;
use crate::studies::random;

/// The weight of a model where a soil was made for none of them [-]; only their ratios count.
///
/// Source: stacking over the measured wheels and the simulated rover of the data sets that come
/// with the library ([`stacked`](crate::studies::evidence::stacked)), to two digits; a test
/// computes them anew. With any one set left out they move by up to a tenth. Nobody knows what a
/// model of your own is worth: it has no weight unless it is asked for.
#[must_use]
pub const fn weight(model: &Model) -> f64 {
    match model {
        Model::Ishigami => 0.15,
        Model::Bekker => 0.21,
        Model::SmallWheel => 0.50,
        Model::Rft => 0.14,
        Model::Own(_) => 0.0,
    }
}

/// Which forces a question needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Question {
    /// Those along a wheel alone: straight ahead on level ground, straight up or down a slope.
    Along,
    /// Those across it too.
    Across,
}

impl Question {
    /// Returns the question about a wheel at a slip angle [rad].
    #[must_use]
    pub fn at_slip_angle(slip_angle: f64) -> Self {
        if slip_angle == 0.0 { Self::Along } else { Self::Across }
    }

    /// Combines several questions into one that needs all forces that they need.
    #[must_use]
    pub fn of_all(mut questions: impl Iterator<Item = Self>) -> Self {
        if questions.any(|it| it == Self::Across) { Self::Across } else { Self::Along }
    }

    /// Returns the question about a rover on a slope.
    ///
    /// * `course`: from the contour [rad]
    #[must_use]
    pub fn on_course(course: f64) -> Self {
        /// Straight up or down, but for round-off [rad].
        const STRAIGHT: f64 = 1e-9;
        let off = (course.abs() - std::f64::consts::FRAC_PI_2).abs();
        if off < STRAIGHT { Self::Along } else { Self::Across }
    }
}

/// Whether a model has the forces that a question needs. Bekker's closed form has one stress under
/// the whole wheel and no measured side force: across a slope it finds headings where nobody else
/// does, or none.
#[must_use]
pub const fn answers(model: &Model, question: Question) -> bool {
    !matches!((model, question), (Model::Bekker, Question::Across))
}

/// How many models have the forces across a wheel.
pub const ACROSS: usize = {
    const ALL: &[Model] = &Model::ALL;
    let (mut count, mut place) = (0, 0);
    while place < ALL.len() {
        count += answers(&ALL[place], Question::Across) as usize;
        place += 1;
    }
    count
};

/// The share of the model that a soil was made for [-]; the others have the rest, by their
/// [`weight`]. Source: ours: constants fitted with one model mean less in another, but a fit does
/// not make its model right elsewhere.
pub const OWN_SHARE: f64 = 0.8;

/// The models that samples may have, with their shares.
///
/// ```
/// use grouser::contact::Model;
/// use grouser::studies::ensemble::models::{ModelSpread, Question};
///
/// let count = |question, model| {
///     let spread = ModelSpread::all(None, question);
///     (0..300).filter(|index| spread.model(1, *index) == model).count()
/// };
/// assert!(count(Question::Along, Model::SmallWheel) > count(Question::Along, Model::Ishigami));
/// // Bekker's closed form has no part in a question about side forces.
/// assert!(count(Question::Along, Model::Bekker) > 0);
/// assert_eq!(count(Question::Across, Model::Bekker), 0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ModelSpread {
    /// Shares above 0, with the sum 1 but for round-off.
    shares: Vec<(Model, f64)>,
}

impl ModelSpread {
    /// One model alone: what is asked for by name.
    #[must_use]
    pub fn one(model: Model) -> Self {
        Self { shares: vec![(model, 1.0)] }
    }

    /// All models that can answer a question, by their [`weight`]; with [`OWN_SHARE`] for one that
    /// the soil was made for, whatever the question.
    #[must_use]
    pub fn all(made_for: Option<&Model>, question: Question) -> Self {
        Self::by(weight, made_for, question)
    }

    /// All models that can answer a question, by weights of which only the ratios count; with
    /// [`OWN_SHARE`] for one that the soil was made for.
    pub(in crate::studies) fn by(
        weight: impl Fn(&Model) -> f64,
        made_for: Option<&Model>,
        question: Question,
    ) -> Self {
        let can_answer = |model: &Model| answers(model, question);
        let others = || Model::ALL.into_iter().filter(|model| Some(model) != made_for);
        let others = || others().filter(can_answer);
        let sum: f64 = others().map(|model| weight(&model)).sum();
        let rest = if made_for.is_some() { 1.0 - OWN_SHARE } else { 1.0 };
        let share = |model| rest * weight(&model) / sum;
        let others = others().map(|model| (model.clone(), share(model)));
        let own = made_for.map(|model| (model.clone(), OWN_SHARE));
        Self { shares: own.into_iter().chain(others).filter(|(_, share)| *share > 0.0).collect() }
    }

    /// The models that are believed in and can answer a question, by how much is believed of each;
    /// `None` if there are none.
    pub(in crate::studies) fn believed(
        mut shares: Vec<(Model, f64)>,
        question: Question,
    ) -> Option<Self> {
        shares.retain(|(model, _)| answers(model, question));
        let sum: f64 = shares.iter().map(|(_, share)| share).sum();
        for (_, share) in &mut shares {
            *share /= sum;
        }
        (!shares.is_empty()).then_some(Self { shares })
    }

    /// Some models with their shares [-], above 0 and with the sum 1.
    #[must_use]
    pub(crate) fn of_shares(shares: Vec<(Model, f64)>) -> Self {
        Self { shares }
    }

    /// The share of each listed model [-], in the order of [`Model::ALL`].
    #[must_use]
    pub fn in_order(&self) -> [f64; Model::COUNT] {
        let share = |model: &Model| self.shares.iter().find(|it| it.0 == *model).map(|it| it.1);
        std::array::from_fn(|place| share(&Model::ALL[place]).unwrap_or(0.0))
    }

    /// The models with their shares [-].
    #[must_use]
    pub fn shares(&self) -> &[(Model, f64)] {
        &self.shares
    }

    /// The model of sample number `index`, which depends on the seed and that number alone.
    ///
    /// Steps of the golden ratio around a circle whose arcs are the shares, from a start that the
    /// seed gives: any number of samples in a row have the models by their shares, to within a few
    /// samples (Weyl 1916; the golden ratio's discrepancy is the smallest).
    #[must_use]
    pub fn model(&self, seed: u64, index: u64) -> Model {
        let mut random = random::generator(seed, STREAM);
        self.at((random::uniform(&mut random) + golden_steps(index)).fract())
    }

    /// The middle of a model's arc on the circle of the shares: a place at which [`at`](Self::at)
    /// finds it.
    pub(crate) fn place_of(&self, model: &Model) -> f64 {
        let before = self.shares.iter().take_while(|it| it.0 != *model);
        let own = self.shares.iter().find(|it| it.0 == *model).map_or(0.0, |it| it.1);
        before.map(|it| it.1).sum::<f64>() + 0.5 * own
    }

    /// The model at a place on the circle of the shares.
    ///
    /// * `place`: 0 to 1
    #[must_use]
    pub fn at(&self, place: f64) -> Model {
        let mut end = 0.0;
        let within = self.shares.iter().find(|(_, share)| {
            end += share;
            place < end
        });
        // Round-off may leave the last end just below 1.
        within.or(self.shares.last()).map_or_else(Model::default, |(model, _)| model.clone())
    }
}

/// A stream of random numbers that no sample has.
const STREAM: u64 = u64::MAX;

/// The fraction of `index` golden ratios [-], in whole numbers: the same on every machine.
fn golden_steps(index: u64) -> f64 {
    /// (√5 − 1)/2 in units of 2⁻⁶⁴.
    const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;
    const PARTS: f64 = (1_u64 << 53) as f64;
    (index.wrapping_mul(GOLDEN) >> 11) as f64 / PARTS
}
