//! Today's card beside yesterday's: of the soil before the drive, and after it.

use std::sync::Arc;

use grouser::answers::Answer;
use grouser::document::LoadedScenario;
use grouser::document::columns::card_days;
use grouser::document::learn::LearntSoil;
use grouser::document::table::Table;
use grouser_draw::{markup, pdf_of};

use crate::args::LearnArgs;
use crate::commands::card::Pages;
use crate::failure::Failure;
use crate::output::folder::OutputFolder;

/// Both cards.
pub(super) struct Cards {
    before: Pages,
    after: Pages,
    /// A row for each slope.
    table: Arc<Table>,
}

impl Cards {
    pub(super) fn of(
        args: &LearnArgs,
        scenario: &LoadedScenario,
        learnt: &LearntSoil,
    ) -> Result<Self, Failure> {
        let today = learnt.in_scenario(scenario)?;
        let pages = |scenario| Pages::of(scenario, args.samples, args.seed);
        let (before, after) = (pages(scenario.clone())?, pages(today)?);
        let table = card_days::table(&before.card, &after.card).into();
        Ok(Self { before, after, table })
    }

    /// Adds the cards to a folder, and the table of both to its answer.
    pub(super) fn add_to(&self, folder: &mut OutputFolder, answer: &mut Answer) {
        let [before, after] = [&self.before, &self.after].map(|it| &it.sheets);
        // Facing pages: yesterday's on the left, today's on the right.
        let facing = before.iter().zip(after).flat_map(|(before, after)| [before, after]);
        let facing: Vec<_> = facing.cloned().collect();
        folder.add("cards.pdf", pdf_of(&facing));
        folder.add("card.pdf", pdf_of(after));
        folder.add("cards.html", self.html());
        answer.tables.push(("cards".to_owned(), Arc::clone(&self.table)));
        answer.heading("Today's card beside yesterday's");
        answer.words(
            "The cards themselves are in cards.html and cards.pdf, yesterday's on the left; \
             today's alone is in card.pdf.",
        );
        answer.rows("Both cards, slope by slope", &self.table, card_days::brief());
    }

    /// Both cards side by side; below each other where there is no room.
    fn html(&self) -> String {
        let sides = [("Yesterday", &self.before), ("Today", &self.after)].map(|(name, pages)| {
            let sheets = pages.sheets.iter().map(grouser_draw::Sheet::to_svg);
            let sheets: String = sheets.collect();
            format!("<section aria-label=\"{name}\">\n<h2>{name}</h2>\n{sheets}</section>\n")
        });
        let [first, _] = &self.after.sheets;
        let title = markup(first.title());
        format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width\">\n\
             <meta name=\"generator\" content=\"Grouser {}\">\n<title>{title}: yesterday and today</title>\n<style>\n\
             body {{ margin: 0; font-family: sans-serif }}\n\
             main {{ display: flex; flex-wrap: wrap; justify-content: center; gap: 8mm }}\n\
             section {{ flex: 1 1 120mm; max-width: 210mm }}\nh1, h2 {{ margin: 4mm; font-size: 1.2rem }}\n\
             svg {{ display: block; width: 100%; height: auto }}\n\
             @page {{ size: A3 landscape; margin: 0 }}\n\
             </style>\n</head>\n<body>\n<h1>{title}</h1>\n<main>\n{}</main>\n</body>\n</html>\n",
            env!("CARGO_PKG_VERSION"),
            sides.concat(),
        )
    }
}
