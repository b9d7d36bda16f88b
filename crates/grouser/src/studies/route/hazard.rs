//! Why a line is not safe to drive along, and where.

use crate::studies::verdict::Judgement;
use crate::units::Vec2;

/// What makes a piece of a line unsafe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Danger {
    /// It lies beyond the map, at its edge, or beside a place without a height.
    UnknownGround,
    /// It lies in an area where nobody may go.
    KeptOut,
    /// No heading holds its course on the soil as written.
    NoHeading,
    /// The ground is steeper than the limit; the worst is the slope [rad].
    TooSteep,
    /// The wheels slip more than the limit; the worst is the slip ratio [-].
    TooMuchSlip,
    /// It is a no-go in as many of the samples as the limit, or more; the worst is their share [-].
    NoGo,
    /// It has the verdict no-go, for the reason of this one.
    Verdict(Judgement),
    /// It turns on the spot there, and the verdict on that is no-go, for the reason of this one.
    TurnVerdict(Judgement),
    /// The line turns there, and the rover cannot turn on the spot on level ground.
    NoTurn,
}

/// A stretch of a line that is not safe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hazard {
    /// Why.
    pub danger: Danger,
    /// Where it begins and ends, as length on the map from the start of the line [m].
    pub along: [f64; 2],
    /// Where it begins [m].
    pub place: Vec2,
    /// The worst number of the stretch that is beyond its limit, if the danger has one.
    pub worst: Option<f64>,
}

impl Danger {
    /// One word of the reports, such as `too-steep`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::UnknownGround => "unknown-ground",
            Self::KeptOut => "kept-out",
            Self::NoHeading => "no-heading",
            Self::TooSteep => "too-steep",
            Self::TooMuchSlip => "too-much-slip",
            Self::NoGo => "no_go",
            Self::Verdict(_) => "no-go-verdict",
            Self::TurnVerdict(_) => "no-go-turn",
            Self::NoTurn => "no-turn",
        }
    }
}

/// Stretches in the making: pieces of one danger that follow each other are one.
#[derive(Debug, Default)]
pub(super) struct Hazards {
    found: Vec<Hazard>,
}

impl Hazards {
    /// Adds a piece.
    pub(super) fn add(&mut self, piece: Hazard) {
        /// Ends of pieces that are so near are one place [m].
        const NEAR: f64 = 1e-6;
        let before = self.found.iter_mut().rev().find(|it| it.danger == piece.danger);
        match before {
            Some(before) if piece.along[0] - before.along[1] < NEAR => {
                before.along[1] = piece.along[1];
                before.worst = before.worst.zip(piece.worst).map(|(one, other)| one.max(other));
            }
            _ => self.found.push(piece),
        }
    }

    /// All of them, in the order in which they begin.
    pub(super) fn finish(self) -> Vec<Hazard> {
        self.found
    }
}
