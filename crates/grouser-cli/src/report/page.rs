//! The page: one HTML file that needs nothing from outside.

use grouser::contact::validity::{Finding, Flag};
use std::fmt::Write as _;

use grouser::document::escape;

use super::figures::Figure;
use super::tables::Table;

/// The element by which a page is known as ours.
pub(crate) const GENERATOR: &str = "<meta name=\"generator\" content=\"Grouser";

/// A page in the making.
pub(crate) struct Page {
    title: String,
    body: String,
}

impl Page {
    pub(crate) fn new(title: &str) -> Self {
        Self { title: title.to_owned(), body: format!("<h1>{}</h1>\n", escaped(title)) }
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

    /// Commands or documents, as they are.
    /// What is an extrapolation, each flag once.
    pub(crate) fn flags<'f>(&mut self, findings: impl IntoIterator<Item = &'f Finding>) {
        let mut flags: Vec<Flag> = findings.into_iter().map(|finding| finding.flag).collect();
        flags.sort();
        flags.dedup();
        self.heading("Validity");
        if flags.is_empty() {
            self.paragraph("No result is outside the stated domain of the model or the soil.");
        } else {
            self.paragraph("Some results are extrapolations. Flags and their meanings:");
            self.list(flags.iter().map(|flag| format!("{}: {}", flag.name(), flag.rule().meaning)));
        }
    }

    pub(crate) fn code(&mut self, text: &str) {
        self.push(&format!("<pre>{}</pre>\n", escaped(text)));
    }

    /// A table.
    pub(crate) fn table(&mut self, table: &Table) {
        self.grid(table.caption, &table.header(), &table.cells());
    }

    /// A table from its cells.
    pub(crate) fn grid(&mut self, caption: &str, header: &[String], cells: &[Vec<String>]) {
        let row = |tag: &str, cells: &[String]| {
            let cells: Vec<String> =
                cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", escaped(cell))).collect();
            format!("<tr>{}</tr>\n", cells.concat())
        };
        let head = row("th", header);
        let body: String = cells.iter().map(|cells| row("td", cells)).collect();
        let caption = escaped(caption);
        self.push(&format!(
            "<div class=\"table\"><table><caption>{caption}</caption>\n<thead>{head}</thead>\n\
             <tbody>{body}</tbody></table></div>\n"
        ));
    }

    /// A figure with its drawing in the page.
    pub(crate) fn figure(&mut self, figure: &Figure, svg: &str) {
        self.drawing(svg, &figure.caption);
    }

    /// A drawing with a caption.
    pub(crate) fn drawing(&mut self, svg: &str, caption: &str) {
        // Only the element: a declaration has no place inside a page.
        let element = svg.find("<svg").map_or(svg, |start| &svg[start..]);
        let caption = escaped(caption);
        self.push(&format!("<figure>{element}<figcaption>{caption}</figcaption></figure>\n"));
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
             <title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
            env!("CARGO_PKG_VERSION"),
            escaped(&self.title),
            include_str!("report.css"),
            self.body
        );
        html
    }

    fn push(&mut self, html: &str) {
        self.body.push_str(html);
    }
}

/// A text from anywhere as HTML, its hidden characters written out.
fn escaped(text: &str) -> String {
    grouser_page::markup(&escape::visible(text))
}

#[cfg(test)]
mod tests {
    use super::*;

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
