//! Parts of well-known texts of coordinate systems, of the first and second edition.

/// What texts call systems of a projection.
pub(crate) const PROJECTED: [&str; 3] = ["PROJCS", "PROJCRS", "PROJECTEDCRS"];

/// The first part of a text with one of these names, brackets and all: `UNIT["metre",1]`.
pub(crate) fn part<'t>(text: &'t str, names: &[&str]) -> Option<&'t str> {
    parts(text).find(|(_, part)| is_called(part, names)).map(|(_, part)| part)
}

/// The last part of those directly inside of another one.
pub(crate) fn inside<'t>(outer: &'t str, names: &[&str]) -> Option<&'t str> {
    parts(outer).filter(|(depth, part)| *depth == 1 && is_called(part, names)).last().map(|it| it.1)
}

/// A part's values that are no parts, without quotation marks: `metre` and `1`.
pub(crate) fn values(part: &str) -> impl Iterator<Item = &str> {
    let inner = part.split_once(['[', '(']).map_or("", |(_, inner)| inner);
    let inner = inner.trim_end_matches([']', ')']);
    inner.split(',').map(|value| value.trim().trim_matches('"'))
}

/// The code in the EPSG register that a part has for itself.
pub(crate) fn epsg(part: &str) -> Option<u16> {
    let mut of_register = values(inside(part, &["AUTHORITY", "ID"])?);
    (of_register.next()? == "EPSG").then(|| of_register.next()?.parse().ok())?
}

fn is_called(part: &str, names: &[&str]) -> bool {
    // ArcGIS has words before the first one.
    let name = part.split(['[', '(']).next().and_then(|it| it.rsplit([' ', '=']).next());
    name.is_some_and(|name| names.contains(&name))
}

/// All parts of a text, each with how many others it is in, in the order in which they begin.
fn parts(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut found: Vec<(usize, usize, usize)> = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    let (mut is_quoted, mut start) = (false, 0);
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'"' => is_quoted = !is_quoted,
            _ if is_quoted => {}
            b'[' | b'(' => {
                found.push((open.len(), start, text.len()));
                open.push(found.len() - 1);
                start = at + 1;
            }
            b']' | b')' => {
                if let Some(place) = open.pop() {
                    found[place].2 = at + 1;
                }
                start = at + 1;
            }
            b',' => start = at + 1,
            _ => {}
        }
    }
    found.into_iter().map(|(depth, start, end)| (depth, text[start..end].trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"COMPD_CS["a [b], (c)",PROJCS["UTM",GEOGCS["WGS",AUTHORITY["EPSG","4326"]],UNIT["metre",1],AXIS["x",EAST],AUTHORITY["EPSG","32633"]],VERT_CS["up",UNIT["foot",0.3048]]]"#;

    #[test]
    fn parts_are_found_by_their_names() {
        let projected = part(TEXT, &["PROJCS", "PROJCRS"]).expect("it has one");
        assert_eq!(epsg(projected), Some(32633));
        assert_eq!(inside(projected, &["UNIT"]), Some(r#"UNIT["metre",1]"#));
        assert_eq!(epsg(TEXT), None);
        let up = part(TEXT, &["VERT_CS"]).expect("it has one");
        assert_eq!(values(inside(up, &["UNIT"]).unwrap()).collect::<Vec<_>>(), ["foot", "0.3048"]);
        assert_eq!(part("no text", &["UNIT"]), None);
        assert_eq!(inside("UNIT[", &["UNIT"]), None);
    }
}
