//! The operator's card as a file: the program draws it that serves the console.

use grouser::document::LoadedScenario;
use grouser::studies::verdict::Rule;

/// What a card is of.
pub struct CardOrder {
    /// Rover, soil and model.
    pub scenario: LoadedScenario,
    /// The limits of go and no-go.
    pub rule: Rule,
}

/// Draws the card of an order as PDF; `None` if `go_on` was false before the end. An error says why
/// there is no card.
pub type CardMaker =
    fn(CardOrder, go_on: &(dyn Fn() -> bool + Sync)) -> Result<Option<Vec<u8>>, String>;
