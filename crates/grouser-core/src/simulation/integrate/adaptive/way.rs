//! How far a motion has come, and what its last step knows of the next one: how long that should
//! be, and by which method.

use super::super::step::{Numbers, Step};
use crate::stored::stored;

/// Steps that are longer than this, times the motion's fastest rate, are implicit: explicit ones
/// are stable up to 3.3. Source: Hairer and Wanner (1996), section IV.2.
pub(super) const STIFF: f64 = 3.0;
/// Steps that are shorter than this, times the same, are explicit. Source: ours, half of it, so
/// that there is no swinging between both.
const MILD: f64 = 1.5;

/// Steps that after so many are not this many times as long as the first of them are stuck.
/// Explicit ones are then followed by an implicit one: their own estimate of the fastest rate may
/// miss it, and where slip settles steps become longer faster. Source: ours.
const STAGNANT: u32 = 8;
const LONGER: f64 = 1.5;
/// Implicit steps that are stuck are followed by one of at most this length, times the motion's
/// fastest rate. They are linear in the rates; where those have a kink, as where a hub all but rests, long
/// steps keep an error that no shorter one of them loses, and one that follows the fastest motion
/// does.
const SETTLING: f64 = 0.5;

/// A motion on its way.
#[derive(Clone, Copy)]
pub(super) struct Way<const N: usize> {
    /// The last step: when it began [s], how long it is [s], where it led, and how.
    pub(super) start: f64,
    pub(super) span: f64,
    pub(super) step: Step<N>,
    pub(super) implicit: bool,
    pub(super) next: Outlook<N>,
    /// When and where the motion was last looked at.
    pub(super) seen: (f64, Numbers<N>),
}

stored!(struct Way<const N> { start, span, step, implicit, next, seen });

/// What is known of the next step.
#[derive(Clone, Copy)]
pub(super) struct Outlook<const N: usize> {
    /// The rates at its start, if they were needed already.
    pub(super) rates: Option<Numbers<N>>,
    /// How long it should be [s], and whether implicit.
    pub(super) span: f64,
    pub(super) implicit: bool,
    /// Steps since they last became markedly longer, and how long they were then [s].
    pub(super) stagnant: (u32, f64),
}

stored!(struct Outlook<const N> { rates, span, implicit, stagnant });

impl<const N: usize> Outlook<N> {
    pub(super) fn first(span: f64, implicit: bool) -> Self {
        Self { rates: None, span, implicit, stagnant: (0, span) }
    }

    /// What the step that this foresaw knows of the next one.
    ///
    /// * `span`: how long that may be for its error [s]
    /// * `fastest`: the fastest rate of the motion [1/s], from an explicit step at least its order
    pub(super) fn after(self, span: f64, fastest: f64) -> Self {
        let Self { implicit, stagnant: (count, length), .. } = self;
        let (count, length) = if span <= LONGER * length { (count + 1, length) } else { (0, span) };
        let stuck = count >= STAGNANT;
        let stiff = span * fastest > if implicit { MILD } else { STIFF };
        // Mild ones, too: explicit steps would follow, overshoot a kink that they do not see, and be
        // stuck again, by turns with these.
        if implicit && stuck {
            return Self::first(span.min(SETTLING / fastest), true);
        }
        let next = stiff || stuck && !implicit;
        Self { rates: None, span, implicit: next, stagnant: (count, length) }
    }
}

impl<const N: usize> Way<N> {
    pub(super) fn end(&self) -> f64 {
        self.start + self.span
    }

    /// The point at a time [s] within the last step.
    pub(super) fn look(&mut self, time: f64) -> Numbers<N> {
        let share = if time == self.end() { 1.0 } else { (time - self.start) / self.span };
        let point = self.step.at(share);
        self.seen = (time, point);
        point
    }
}
