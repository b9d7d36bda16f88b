//! Text from outside inside SVG and HTML.

/// A text as the content of an element, or as the value of an attribute in double quotation marks, of SVG or
/// HTML: whatever it holds, it is shown, and neither ends the element nor makes the document
/// unreadable. Line feeds and tabs stay.
#[must_use]
pub fn markup(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\n' | '\t' => escaped.push(character),
            hidden if is_hidden(hidden) => escaped.extend(hidden.escape_default()),
            shown => escaped.push(shown),
        }
    }
    escaped
}

/// A line of text for a page: what is hidden is written out, such as `\u{202e}`.
pub(crate) fn visible(text: &str) -> String {
    let mut visible = String::with_capacity(text.len());
    for character in text.chars() {
        if is_hidden(character) {
            visible.extend(character.escape_default());
        } else {
            visible.push(character);
        }
    }
    visible
}

/// Whether a character does something else than show itself: control characters, line separators,
/// marks that change the direction of writing, tags, and what XML forbids.
#[must_use]
pub fn is_hidden(character: char) -> bool {
    character.is_control()
        || matches!(
            character,
            '\u{61c}'
                | '\u{200e}'..='\u{200f}'
                | '\u{2028}'..='\u{202e}'
                | '\u{2066}'..='\u{2069}'
                | '\u{feff}'
                | '\u{fff9}'..='\u{fffb}'
                | '\u{fffe}'..='\u{ffff}'
                | '\u{e0000}'..='\u{e007f}'
        )
}
