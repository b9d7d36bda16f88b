//! What the chores ask of Markdown: where links lead, what is code, what headings say.

use std::ops::Range;

use pulldown_cmark::{CodeBlockKind, Event, Parser, Tag, TagEnd};

/// A Markdown file, read. Lines count from 1.
#[derive(Debug, Default)]
pub(crate) struct Page {
    /// Targets of links and images, with their lines.
    pub(crate) targets: Vec<(usize, String)>,
    /// Code inside lines, with its lines.
    pub(crate) codes: Vec<(usize, String)>,
    /// Texts of headings.
    pub(crate) headings: Vec<String>,
    /// Where fenced code stands, fences included [bytes].
    fenced: Vec<Range<usize>>,
}

impl Page {
    pub(crate) fn read(text: &str) -> Self {
        let ends: Vec<usize> = text.match_indices('\n').map(|(end, _)| end).collect();
        let line = |place: usize| ends.partition_point(|&end| end < place) + 1;
        let mut page = Self::default();
        let mut heading: Option<String> = None;
        for (event, range) in Parser::new(text).into_offset_iter() {
            match event {
                Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                    page.targets.push((line(range.start), dest_url.into_string()));
                }
                Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(_))) => page.fenced.push(range),
                Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
                Event::End(TagEnd::Heading(_)) => page.headings.extend(heading.take()),
                Event::Text(part) => heading = heading.map(|text| text + &*part),
                Event::Code(code) => {
                    heading = heading.map(|text| text + &*code);
                    page.codes.push((line(range.start), code.into_string()));
                }
                _ => {}
            }
        }
        page
    }

    /// Whether fenced code, or one of its fences, stands at a place [bytes].
    pub(crate) fn is_fenced(&self, place: usize) -> bool {
        self.fenced.iter().any(|range| range.contains(&place))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_code_and_headings_are_found_with_their_lines() {
        let text = "# One `two`\n\nA [link](b.md \"title\") and\n![picture](c.svg), `code`.\n";
        let page = Page::read(text);
        assert_eq!(page.headings, ["One two"]);
        assert_eq!(page.targets, [(3, "b.md".to_owned()), (4, "c.svg".to_owned())]);
        assert_eq!(page.codes, [(1, "two".to_owned()), (4, "code".to_owned())]);
    }

    #[test]
    fn fenced_code_is_told_from_the_rest() {
        let text = "one\n```rust\n[two](x.md)\n```\nthree\n~~~\n```\n~~~\nfour";
        let page = Page::read(text);
        assert!(page.targets.is_empty());
        for (part, is_fenced) in [("one", false), ("two", true), ("three", false), ("four", false)]
        {
            assert_eq!(page.is_fenced(text.find(part).expect("a part")), is_fenced, "{part}");
        }
    }
}
