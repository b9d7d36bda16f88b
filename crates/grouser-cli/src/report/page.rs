//! The page: one HTML file that needs nothing from outside.

use grouser::contact::validity::{Finding, Flag};
use grouser::document::reading::capitalised;
use grouser_draw::chart::{Chart, small_svg};
use std::fmt::Write as _;

use grouser::document::escape;
use grouser::document::table as results;

use super::figures::Figure;
use super::tables::Table;
use crate::output::rows::Rows;
use crate::output::text::{Part, Text};

/// A table of more rows is shown when a reader asks for it.
const MOST_ROWS: usize = 40;

/// The element by which a page is known as ours.
pub(crate) const GENERATOR: &str = "<meta name=\"generator\" content=\"Grouser";

/// A page in the making.
pub(crate) struct Page {
    title: String,
    body: String,
    /// What stands after all else.
    rest: String,
}

impl Page {
    pub(crate) fn new(title: &str) -> Self {
        let body = format!("<h1>{}</h1>\n", escaped(title));
        Self { title: title.to_owned(), body, rest: String::new() }
    }

    /// A section after all else, which a reader unfolds, and which is printed only then.
    ///
    /// * `add`: what it has
    pub(crate) fn folded(&mut self, title: &str, add: impl FnOnce(&mut Self)) {
        let before = std::mem::take(&mut self.body);
        add(self);
        let section = std::mem::replace(&mut self.body, before);
        let title = escaped(title);
        // Writing to a string does not fail.
        let _ = write!(
            self.rest,
            "<details class=\"rest\"><summary>{title}</summary>\n{section}</details>\n"
        );
    }

    /// A section's heading.
    pub(crate) fn heading(&mut self, text: &str) {
        self.push(&format!("<h2>{}</h2>\n", escaped(text)));
    }

    /// A paragraph.
    pub(crate) fn paragraph(&mut self, text: &str) {
        self.push(&format!("<p>{}</p>\n", escaped(text)));
    }

    /// A paragraph that answers the question of the page.
    pub(crate) fn answer(&mut self, text: &str) {
        self.push(&format!("<p class=\"answer\">{}</p>\n", escaped(text)));
    }

    /// A list.
    pub(crate) fn list<S: AsRef<str>>(&mut self, items: impl IntoIterator<Item = S>) {
        self.push("<ul>\n");
        for item in items {
            self.push(&format!("<li>{}</li>\n", escaped(item.as_ref())));
        }
        self.push("</ul>\n");
    }

    /// What is an extrapolation, each flag once.
    pub(crate) fn flags<'f>(&mut self, findings: Option<impl IntoIterator<Item = &'f Finding>>) {
        self.heading("Validity");
        let Some(findings) = findings else {
            return self.paragraph(
                "Not checked: whether results are outside the stated domain of the model or the \
                 soil.",
            );
        };
        let mut flags: Vec<Flag> = findings.into_iter().map(|finding| finding.flag).collect();
        flags.sort();
        flags.dedup();
        if flags.is_empty() {
            self.paragraph(
                "Checked on the soil as written: no result is outside the stated domains.",
            );
        } else {
            self.paragraph(
                "Checked on the soil as written: some results are extrapolations. Their flags:",
            );
            self.list(flags.iter().map(|flag| format!("{}: {}", flag.name(), flag.rule().meaning)));
        }
    }

    /// Commands or documents, as they are.
    pub(crate) fn code(&mut self, text: &str) {
        self.push(&format!("<pre tabindex=\"0\">{}</pre>\n", escaped(text)));
    }

    /// A document after all else, which a reader unfolds.
    pub(crate) fn document(&mut self, name: &str, text: &str) {
        self.folded(name, |page| page.code(text));
    }

    /// Some columns of a table of results, for reading.
    pub(crate) fn rows(
        &mut self,
        caption: &str,
        table: &results::Table,
        names: &[impl AsRef<str>],
    ) {
        let header: Vec<String> = names.iter().map(|name| name.as_ref().to_owned()).collect();
        self.grid(caption, &header, &Rows::of_table(table).cells(names));
    }

    /// Small charts, side by side where there is room.
    pub(crate) fn charts<'c>(&mut self, charts: impl IntoIterator<Item = &'c Chart>) {
        self.push("<div class=\"charts\">\n");
        for chart in charts {
            self.push(&format!("<figure>{}</figure>\n", element(&small_svg(chart))));
        }
        self.push("</div>\n");
    }

    /// A table.
    pub(crate) fn table(&mut self, table: &Table) {
        self.grid(table.caption, &table.header(), &table.cells());
    }

    /// A text with its tables as tables, each under the words before it.
    pub(crate) fn text(&mut self, text: &Text) {
        let mut words = "";
        for part in &text.0 {
            match part {
                Part::Grid(grid) => {
                    self.grid(&capitalised(words), &grid.header, &grid.rows);
                    self.meanings(&grid.notes);
                    words = "";
                }
                Part::Words(next) => {
                    if !words.is_empty() {
                        self.paragraph(words);
                    }
                    words = next.trim();
                }
            }
        }
        if !words.is_empty() {
            self.paragraph(words);
        }
    }

    /// What names under a table mean.
    fn meanings(&mut self, notes: &[(String, String)]) {
        if !notes.is_empty() {
            self.list(notes.iter().map(|(name, meaning)| format!("{name}: {meaning}")));
        }
    }

    /// A table from its cells; a long one is shown when a reader asks for it.
    pub(crate) fn grid(&mut self, caption: &str, header: &[String], cells: &[Vec<String>]) {
        // Words stand on the left with their header, numbers and the dashes for them on the right.
        let is_word = |cell: &String| cell.starts_with(char::is_alphabetic);
        let has_words =
            |column: usize| cells.iter().filter_map(|cells| cells.get(column)).any(is_word);
        let words: Vec<bool> = (0..header.len()).map(has_words).collect();
        let row = |tag: &str, cells: &[String]| {
            let cell = |(column, cell): (usize, &String)| {
                let is_text = words.get(column).copied().unwrap_or(false);
                let side = if is_text { " class=\"text\"" } else { "" };
                format!("<{tag}{side}>{}</{tag}>", escaped(cell))
            };
            format!("<tr>{}</tr>\n", cells.iter().enumerate().map(cell).collect::<String>())
        };
        let head = row("th", header);
        let body: String = cells.iter().map(|cells| row("td", cells)).collect();
        let caption = escaped(caption);
        let table = format!(
            "<div class=\"table\" role=\"region\" aria-label=\"{caption}\" tabindex=\"0\"><table><caption>{caption}</caption>\n<thead>{head}</thead>\n\
             <tbody>{body}</tbody></table></div>\n"
        );
        if cells.len() > MOST_ROWS {
            let count = cells.len();
            self.push(&format!(
                "<details class=\"rows\"><summary>{caption}: {count} rows</summary>{table}</details>\n"
            ));
        } else {
            self.push(&table);
        }
    }

    /// A figure with its drawing in the page.
    pub(crate) fn figure(&mut self, figure: &Figure, svg: &str) {
        self.drawing(svg, &figure.caption);
    }

    /// A drawing with a caption.
    pub(crate) fn drawing(&mut self, svg: &str, caption: &str) {
        let element = element(svg);
        let caption = escaped(caption);
        let caption = indexed(&caption);
        self.push(&format!(
            "<figure><div class=\"wide\" role=\"group\" aria-label=\"drawing\" tabindex=\"0\">{element}</div>\
             <figcaption>{caption}</figcaption></figure>\n"
        ));
    }

    /// The whole page.
    pub(crate) fn to_html(&self) -> String {
        let mut html = String::from("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n");
        // Writing to a string does not fail.
        let _ = write!(
            html,
            "<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             {GENERATOR} {}\">\n\
             <title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n<main>\n{}{}<p class=\"made\">Made by grouser {}.</p>\n</main>\n</body>\n</html>\n",
            env!("CARGO_PKG_VERSION"),
            escaped(&self.title),
            include_str!("report.css"),
            self.body,
            self.rest,
            env!("CARGO_PKG_VERSION")
        );
        html
    }

    fn push(&mut self, html: &str) {
        self.body.push_str(html);
    }
}

/// A text with indices set as such: in `θ_f` a letter has an index; `yaw_deg` is a name, and stays.
fn indexed(text: &str) -> String {
    let letters: Vec<char> = text.chars().collect();
    let at = |place: usize| letters.get(place).copied().unwrap_or(' ');
    let is_index = |place: usize| {
        let stands_alone = place < 2 || !at(place - 2).is_alphanumeric();
        at(place) == '_'
            && stands_alone
            && place > 0
            && at(place - 1).is_alphabetic()
            && at(place + 1).is_alphabetic()
            && !at(place + 2).is_alphanumeric()
    };
    let mut html = String::new();
    for (place, letter) in letters.iter().enumerate() {
        match (is_index(place), place > 0 && is_index(place - 1)) {
            (true, _) => html.push_str("<sub>"),
            (false, true) => {
                html.push(*letter);
                html.push_str("</sub>");
            }
            (false, false) => html.push(*letter),
        }
    }
    html
}

/// Only the element of a drawing: a declaration has no place inside a page.
fn element(svg: &str) -> &str {
    svg.find("<svg").map_or(svg, |start| &svg[start..])
}

/// A text from anywhere as HTML, its hidden characters written out.
fn escaped(text: &str) -> String {
    grouser_draw::markup(&escape::visible(text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_letter_with_an_index_is_set_as_one_and_a_name_is_not() {
        assert_eq!(indexed("θ_f, X_c and yaw_deg"), "θ<sub>f</sub>, X<sub>c</sub> and yaw_deg");
        assert_eq!(indexed("_a a_ b_cd"), "_a a_ b_cd");
    }

    #[test]
    fn data_neither_begins_nor_ends_an_element() {
        let mut page = Page::new("a</title><script>");
        page.list(["]]>\u{202e}\u{1b}[2J\0"]);
        page.grid("\"'>", &["<th>".to_owned()], &[vec!["&amp;".to_owned()]]);
        let html = page.to_html();
        assert!(html.contains("<title>a&lt;/title&gt;&lt;script&gt;</title>"), "{html}");
        assert!(html.contains("<li>]]&gt;\\u{202e}\\u{1b}[2J\\u{0}</li>"), "{html}");
        assert!(html.contains("<caption>&quot;'&gt;</caption>"), "{html}");
        assert!(html.contains("<th>&lt;th&gt;</th>") && html.contains("<td>&amp;amp;</td>"));
    }
}
