//! A question that was read: what answers it, line by line.

use crate::console::Console;
use crate::refusal::Refusal;
use crate::runs::GoOn;

/// Reads a question.
pub(crate) type Read = fn(&Console, &[u8]) -> Result<Question, Refusal>;

/// Takes a line, from any thread; whether somebody reads it.
pub(crate) type Send<'a> = &'a (dyn Fn(String) -> bool + Sync);

/// A question.
pub(crate) struct Question(Box<Answering>);

/// What answers a question.
type Answering = dyn FnOnce(&GoOn, Send<'_>) -> Result<(), Refusal>;

impl Question {
    pub(crate) fn new(
        answer: impl FnOnce(&GoOn, Send<'_>) -> Result<(), Refusal> + 'static,
    ) -> Self {
        Self(Box::new(answer))
    }

    /// Computes the answer, and sends it line by line.
    pub(crate) fn answer(self, go_on: &GoOn, send: Send<'_>) -> Result<(), Refusal> {
        (self.0)(go_on, send)
    }
}
