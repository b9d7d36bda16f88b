//! Text inside SVG and HTML.

/// A text as the content of an element, or as the value of an attribute in double quotation marks,
/// of SVG or HTML: whatever it holds, it neither ends the element nor makes the document
/// unreadable. Characters that no document can hold are written out, such as `\u{0}`.
#[must_use]
pub fn markup(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            possible if is_xml(possible) => escaped.push(possible),
            impossible => escaped.extend(impossible.escape_default()),
        }
    }
    escaped
}

/// Whether a document of XML can hold a character.
///
/// Source: W3C, "Extensible Markup Language (XML) 1.0", fifth edition, production 2, `Char`.
fn is_xml(character: char) -> bool {
    matches!(character,
        '\t' | '\n' | '\r' | ' '..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'..='\u{10ffff}')
}
