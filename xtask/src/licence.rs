//! Licence expressions of crates, such as `(MIT OR Apache-2.0) AND Unicode-3.0`.

/// The names in the list `allow` of a policy's text.
pub(crate) fn accepted(policy: &str) -> Vec<String> {
    let list = policy.split_once("\nallow = [").and_then(|(_, rest)| rest.split_once("\n]"));
    let lines = list.map_or("", |(list, _)| list).lines();
    let quoted = |line: &str| Some(line.split('"').nth(1)?.to_owned());
    lines.filter_map(quoted).collect()
}

/// Whether what an expression allows includes terms that we accept: one side of each OR, both of
/// each AND. (An old `MIT/Apache-2.0` means OR.)
pub(crate) fn accepts(accepted: &[String], expression: &str) -> bool {
    let expression = expression.replace('/', " OR ");
    let whole = expression.trim();
    // AND binds more tightly than OR.
    let alternatives = split(whole, " OR ");
    if alternatives.len() > 1 {
        return alternatives.iter().any(|part| accepts(accepted, part));
    }
    let parts = split(whole, " AND ");
    if parts.len() > 1 {
        return parts.iter().all(|part| accepts(accepted, part));
    }
    match whole.strip_prefix('(').and_then(|rest| rest.strip_suffix(')')) {
        Some(inner) => accepts(accepted, inner),
        None => accepted.iter().any(|name| name == whole),
    }
}

/// Splits at a word that stands outside of all parentheses.
fn split<'a>(expression: &'a str, word: &str) -> Vec<&'a str> {
    let mut parts = Vec::new();
    let (mut depth, mut start) = (0, 0);
    for (at, character) in expression.char_indices() {
        match character {
            '(' => depth += 1,
            ')' => depth -= 1,
            ' ' if depth == 0 && at >= start && expression[at..].starts_with(word) => {
                parts.push(&expression[start..at]);
                start = at + word.len();
            }
            _ => {}
        }
    }
    parts.push(&expression[start..]);
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_alternative_is_enough_and_all_conjuncts_are_needed() {
        let list = accepted("[licenses]\nallow = [\n    \"MIT\",\n    \"Unicode-3.0\",\n]\n");
        assert_eq!(list, ["MIT", "Unicode-3.0"]);
        for good in ["MIT", "MIT/Apache-2.0", "GPL-3.0 OR MIT", "(MIT OR X) AND Unicode-3.0"] {
            assert!(accepts(&list, good), "{good}");
        }
        for bad in ["", "GPL-3.0", "MIT AND GPL-3.0", "MIT WITH X", "(X OR Y) AND Unicode-3.0"] {
            assert!(!accepts(&list, bad), "{bad}");
        }
    }
}
