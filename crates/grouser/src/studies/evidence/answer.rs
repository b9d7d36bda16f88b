//! Numbers that were measured, with what each model predicts of them.

use crate::contact::Model;
use crate::studies::ensemble::models::Question;

/// What a number answers. Each kind counts alike in the weights, however many of its numbers were
/// measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnswerKind {
    /// Drawbar pull, over the load [-].
    Pull,
    /// Side force, over the load [-].
    SideForce,
    /// Sinkage, over the shearing radius [-].
    Sinkage,
    /// Slip ratio of a rover on a slope [-].
    Slip,
    /// Yaw that holds a rover's course on a slope [rad].
    Heading,
}

impl AnswerKind {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::Pull, Self::SideForce, Self::Sinkage, Self::Slip, Self::Heading];

    /// Its name in answers.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Pull => "drawbar_pull",
            Self::SideForce => "side_force",
            Self::Sinkage => "sinkage",
            Self::Slip => "slip_ratio",
            Self::Heading => "yaw",
        }
    }

    /// How exactly such numbers are read off published figures [-, rad]. Source: ours; a newton, a
    /// millimetre, two hundredths of slip and a degree, as the data sets say of themselves.
    pub(super) fn noise(self) -> f64 {
        match self {
            Self::Pull | Self::SideForce | Self::Slip => 0.02,
            Self::Sinkage => 0.01,
            Self::Heading => 0.017,
        }
    }
}

/// A number that was measured, and what each model predicts of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// What it answers.
    pub kind: AnswerKind,
    /// Which forces the question needs.
    pub question: Question,
    /// What was measured, in the kind's unit.
    pub measured: f64,
    /// The predictions of each model, in the order of [`Model::ALL`], sample by sample.
    pub predicted: [Vec<f64>; Model::COUNT],
}

/// A part of a data set on one soil.
#[derive(Clone, Debug, PartialEq)]
pub struct Evidence {
    /// The data set's name.
    pub data_set: String,
    /// The part's.
    pub case: String,
    /// The soil's.
    pub soil: String,
    /// Where its constants are from: parts of one source are left out together.
    pub source: String,
    /// The model that the soil was made for with these rows in view: they are no evidence then.
    pub in_sample: Option<Model>,
    /// What was measured.
    pub answers: Vec<Answer>,
}
