//! The writer of answers: to a terminal, as JSON, as CSV, and into a folder with a page.

use grouser::answers::{Answer, AnswerError, Displayed, PageBlock};
use grouser::document::escape;
use grouser::document::given_file::GivenFile;
use grouser::document::json;
use grouser::document::learn::NotBelieved;
use grouser::document::statistics::NothingAccepted;
use grouser::document::table::Table;
use grouser_draw::chart::Drawable;

use super::folder::OutputFolder;
use super::remedy;
use super::rows::Rows;
use super::text::Text;
use super::{Format, crossed};
use crate::failure::Failure;
use crate::report::REPORT;
use crate::report::answer::{Basis, close};
use crate::report::page::Page;

/// Pictures that a command draws: the name of each one's file, and its SVG.
pub(crate) type Pictures = [(String, String)];

/// Writes an answer into its folder, if it has one, and prints it.
///
/// * `repeat`: the command that gives the answer again, typed in its folder
pub(crate) fn give(
    answer: &Answer,
    repeat: &str,
    folder: Option<OutputFolder>,
    format: Format,
) -> Result<(), Failure> {
    give_with_pictures(answer, repeat, &[], folder, format)
}

/// The same of an answer whose page has pictures that the command draws.
///
/// * `pictures`: all that the page names, if there is a folder
pub(crate) fn give_with_pictures(
    answer: &Answer,
    repeat: &str,
    pictures: &Pictures,
    folder: Option<OutputFolder>,
    format: Format,
) -> Result<(), Failure> {
    write(answer, repeat, pictures, folder)?;
    print(answer, format)
}

/// Writes an answer into its folder, if it has one.
pub(crate) fn write(
    answer: &Answer,
    repeat: &str,
    pictures: &Pictures,
    folder: Option<OutputFolder>,
) -> Result<(), Failure> {
    let Some(mut folder) = folder else { return Ok(()) };
    add_to(&mut folder, answer, repeat, pictures)?;
    folder.finish()
}

/// Prints an answer.
pub(crate) fn print(answer: &Answer, format: Format) -> Result<(), Failure> {
    match format {
        Format::Table => super::show(text(answer)),
        Format::Csv => match answer.tables.first() {
            Some((_, table)) => super::print(&Rows::of_table(table).to_csv()?),
            None => Ok(()),
        },
        Format::Json => super::print_json(answer),
    }
}

/// The files of an answer.
fn add_to(
    folder: &mut OutputFolder,
    answer: &Answer,
    repeat: &str,
    pictures: &Pictures,
) -> Result<(), Failure> {
    folder.add(format!("{}.json", answer.name), json::text(answer) + "\n");
    for (name, table) in &answer.tables {
        folder.add(format!("{name}.csv"), Rows::of_table(table).to_csv()?);
    }
    for block in answer.blocks() {
        if let PageBlock::Figure { figure, file: Some(file), .. } = block {
            folder.add(format!("{file}.svg"), figure.to_svg());
        }
    }
    add_pictures(folder, pictures);
    folder.add(REPORT, html(answer, repeat, pictures));
    for document in &answer.documents {
        folder.add(document.file.as_str(), document.toml.as_str());
        let beside = document.file.rfind('/').map_or("", |end| &document.file[..=end]);
        for companion in &document.companions {
            folder.add(format!("{beside}{}", companion.name), companion.content.clone());
        }
    }
    Ok(())
}

/// The files of pictures.
pub(crate) fn add_pictures(folder: &mut OutputFolder, pictures: &Pictures) {
    for (file, svg) in pictures {
        folder.add(file.as_str(), svg.as_str());
    }
}

/// What a terminal shows.
pub(crate) fn text(answer: &Answer) -> Text {
    let shown = |shown: &Displayed| match shown {
        Displayed::Rows(table, columns) => Rows::of_table(table).to_table(columns),
        Displayed::Crossed { table, columns, crossing } => match super::terminal::width() {
            Some(_) => crossed::text(table, crossing),
            None => Rows::of_table(table).to_table(columns),
        },
        Displayed::Excerpt { table, columns, most, what } => excerpt(table, columns, *most, what),
        Displayed::Words(words) => words.into(),
    };
    let hints = remedy::of_answer(answer).into_iter().map(|hint| Text::from(hint + "\n"));
    answer.screen.iter().map(shown).chain(hints).chain([given(&answer.given)]).collect()
}

/// What files gave: a line each.
pub(crate) fn given(files: &[GivenFile]) -> Text {
    let lines = files.iter().map(|file| format!("{}\n", escape::line(&file.sentence())));
    Text::from(lines.collect::<String>())
}

/// Some of many rows, as far apart as each other, and where all are.
fn excerpt(table: &Table, columns: &[String], most: usize, what: &str) -> Text {
    let count = table.rows();
    let shown: Vec<usize> = (0..count.min(most)).map(|row| row * count / count.min(most)).collect();
    let rows = Rows::of_table(&table.rows_at(&shown)).to_table(columns);
    if count <= most {
        return rows;
    }
    rows + format!("{most} of {count} {what}; --format csv prints all\n")
}

/// The page of an answer.
///
/// * `repeat`: the command that gives the answer again, typed in its folder
/// * `pictures`: all that the page names
pub(crate) fn html(answer: &Answer, repeat: &str, pictures: &Pictures) -> String {
    let mut page = Page::new(&answer.title);
    for block in &answer.page {
        add_block(&mut page, block, pictures);
    }
    for hint in remedy::of_answer(answer) {
        page.paragraph(&hint);
    }
    close(page, answer.findings.as_ref(), &answer.columns, &Basis::of(answer, repeat))
}

fn add_block(page: &mut Page, block: &PageBlock, pictures: &Pictures) {
    match block {
        PageBlock::Verdict(text) => page.answer(text),
        PageBlock::Heading(text) => page.heading(text),
        PageBlock::Words(text) => page.paragraph(text),
        PageBlock::List(items) => page.list(items),
        PageBlock::Rows { caption, table, columns } => page.rows(caption, table, columns),
        PageBlock::Figure { figure, caption, .. } => page.drawing(&figure.to_svg(), caption),
        PageBlock::Charts(charts) => page.charts(charts),
        PageBlock::Picture { file, caption } => page.drawing(drawn(pictures, file), caption),
        PageBlock::Folded { title, blocks } => page.folded(title, |page| {
            for block in blocks {
                add_block(page, block, pictures);
            }
        }),
    }
}

/// The SVG of a picture. A command draws every one that the page of its answer names.
fn drawn<'p>(pictures: &'p Pictures, file: &str) -> &'p str {
    let Some((_, svg)) = pictures.iter().find(|(name, _)| name == file) else {
        unreachable!("{file} was not drawn")
    };
    svg
}

impl From<AnswerError> for Failure {
    fn from(error: AnswerError) -> Self {
        match error {
            AnswerError::Parameter(error) => error.into(),
            AnswerError::OutsideDomain(error) => error.into(),
            AnswerError::Samples(error) => error.into(),
            AnswerError::Design(why) => Self::Run(why),
            AnswerError::Stopped => Self::Interrupted(error.to_string()),
            AnswerError::Empty(_)
            | AnswerError::NotCompared(..)
            | AnswerError::Together(..)
            | AnswerError::Key(_) => Self::Usage(error.to_string()),
        }
    }
}

impl From<NotBelieved> for Failure {
    fn from(error: NotBelieved) -> Self {
        match error {
            NotBelieved::Soil(error) => error.into(),
            NotBelieved::Document(error) => error.into(),
        }
    }
}

impl From<NothingAccepted> for Failure {
    fn from(error: NothingAccepted) -> Self {
        Self::Usage(format!(
            "the soil's uncertainty reaches too far: {error}\nhint: smaller standard deviations \
             keep the samples within the ranges of their keys"
        ))
    }
}
