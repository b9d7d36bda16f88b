//! A question that was read: what answers it, line by line.

use std::any::Any;

use crate::console::Console;
use crate::refusal::Refusal;

/// Reads a question.
pub(crate) type Read = fn(&Console, &[u8]) -> Result<Question, Refusal>;

/// Takes a line, from any thread; whether somebody reads it.
pub(crate) type Send<'a> = &'a (dyn Fn(String) -> bool + Sync);

/// What a computation asks on its way.
pub(crate) trait GoOn: Sync {
    /// Whether to go on.
    fn is_on(&self) -> bool;

    /// What a study goes by that shows its progress: it may take long.
    fn of_study(&self) -> Box<dyn GoOn>;

    /// Waits for the turn of what takes long, which is over when the result is dropped; nothing if
    /// nobody waits for the answer any more. What is quick needs no turn, so that it is not behind
    /// what takes long.
    fn turn(&self) -> Option<Box<dyn Any>>;
}

/// A question.
pub(crate) struct Question(Box<Answering>);

/// What answers a question.
type Answering = dyn FnOnce(&dyn GoOn, Send<'_>) -> Result<(), Refusal>;

impl Question {
    pub(crate) fn new(
        answer: impl FnOnce(&dyn GoOn, Send<'_>) -> Result<(), Refusal> + 'static,
    ) -> Self {
        Self(Box::new(answer))
    }

    /// Computes the answer, and sends it line by line.
    pub(crate) fn answer(self, go_on: &dyn GoOn, send: Send<'_>) -> Result<(), Refusal> {
        (self.0)(go_on, send)
    }
}
