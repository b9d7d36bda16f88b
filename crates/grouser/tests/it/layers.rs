//! No layer imports from one above it, and none but I/O touches the outer world.
//!
//! The sources are read as tokens, without comments and strings. What the layers are, and why, is
//! said in `ARCHITECTURE.md`.

use std::fs;
use std::path::{Path, PathBuf};

/// The modules of each layer, from the foundations up.
const LAYERS: [&[&str]; 9] = [
    &[
        "units",
        "error",
        "difference",
        "elementary",
        "lagrange",
        "newton",
        "peak",
        "random",
        "root",
        "soil",
        "stored",
        "wheel",
        "terrain",
    ],
    &["contact"],
    &["vehicle"],
    &["simulation"],
    &["paper"],
    &["mission"],
    &["studies"],
    &["document"],
    &["answers"],
];
const STUDIES: usize = 6;
const IO: usize = 7;

/// A broken rule.
#[derive(Clone, Debug, PartialEq)]
struct Breach {
    line: usize,
    what: String,
}

#[test]
fn no_source_breaks_a_rule_of_its_layer() {
    let mut breaches = Vec::new();
    let mut count = 0;
    for sources in sources_of_the_library() {
        let is_io = sources.parent().is_some_and(|path| path.ends_with("grouser-io"));
        visit(&sources, &mut |file| {
            let text = fs::read_to_string(file).expect("a source is text");
            let name = file.strip_prefix(&sources).expect("it lies below").display().to_string();
            count += 1;
            // What is a crate below the studies can import none of them; the compiler sees to that.
            let found = if is_io {
                platform_functions(&without_tests(&tokens_of(&text)))
            } else {
                breaches_in(&name, &text)
            };
            for Breach { line, what } in found {
                breaches.push(format!("{name}:{line}: {what}"));
            }
        });
    }
    assert!(count > 30, "only {count} sources were found");
    assert!(breaches.is_empty(), "\n{}\n", breaches.join("\n"));
}

/// The folders of sources of the crates that make up the library.
pub(super) fn sources_of_the_library() -> [PathBuf; 3] {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    ["grouser-core", "grouser-io", "grouser"].map(|name| crates.join(name).join("src"))
}

pub(super) fn visit(folder: &Path, found: &mut dyn FnMut(&Path)) {
    let entries = fs::read_dir(folder).expect("a folder of sources");
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            visit(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found(&path);
        }
    }
}

/// The rules that a source breaks.
///
/// * `name`: its path below `src`, such as `contact/slip.rs`
fn breaches_in(name: &str, text: &str) -> Vec<Breach> {
    let modules: Vec<&str> =
        name.trim_end_matches(".rs").split(['/', '\\']).filter(|part| *part != "mod").collect();
    if modules == ["lib"] {
        // A crate's root lists all its layers.
        return Vec::new();
    }
    let tokens = tokens_of(text);
    let Some(layer) = layer_of(modules[0]) else {
        return vec![Breach { line: 1, what: format!("`{}` belongs to no layer", modules[0]) }];
    };
    let mut breaches = upward_imports(&tokens, &modules, layer);
    let shipped = without_tests(&tokens);
    breaches.extend(outer_world(&shipped, layer));
    breaches.extend(platform_functions(&shipped));
    // The paper prints degrees.
    if layer < IO && modules != ["units"] && modules != ["paper"] {
        breaches.extend(units_of_people(&without_error_texts(&shipped)));
    }
    breaches.sort_by_key(|breach| breach.line);
    breaches
}

fn layer_of(module: &str) -> Option<usize> {
    LAYERS.iter().position(|modules| modules.contains(&module))
}

/// Paths that lead to a module of a higher layer, or to one of no layer.
fn upward_imports(tokens: &[Token], modules: &[&str], layer: usize) -> Vec<Breach> {
    let mut breaches = Vec::new();
    // How many blocks are open, and at how many each open inline module started.
    let (mut depth, mut inline) = (0, Vec::new());
    let mut at = 0;
    while at < tokens.len() {
        match tokens[at].text {
            "{" => depth += 1,
            "}" => {
                depth -= 1;
                inline.retain(|start| *start < depth);
            }
            "mod" if text_at(tokens, at + 2) == "{" => inline.push(depth),
            "crate" | "super" if at == 0 || tokens[at - 1].text != "::" => {
                let mut above = modules.len() + inline.len();
                let mut end = at;
                while tokens[end].text == "super" && text_at(tokens, end + 1) == "::" {
                    above -= 1;
                    end += 2;
                }
                if tokens[end].text == "crate" && text_at(tokens, end + 1) == "::" {
                    above = 0;
                    end += 2;
                }
                // Any other path stays in the module tree it starts from.
                if above == 0 && end > at {
                    for token in heads(tokens, end) {
                        breaches.extend(upward(token, layer));
                    }
                }
            }
            _ => {}
        }
        at += 1;
    }
    breaches
}

fn upward(module: &Token, layer: usize) -> Option<Breach> {
    let what = match layer_of(module.text) {
        Some(other) if other <= layer => return None,
        Some(other) => format!("layer {layer} imports `{}` of layer {other}", module.text),
        None => format!("`{}` belongs to no layer", module.text),
    };
    Some(Breach { line: module.line, what })
}

/// The first names of a path's end: one, or those of a group `{a::b, c}`.
fn heads<'t>(tokens: &'t [Token<'t>], start: usize) -> Vec<&'t Token<'t>> {
    if text_at(tokens, start) != "{" {
        return tokens.get(start).into_iter().collect();
    }
    let mut heads = Vec::new();
    let mut depth = 0;
    for (at, token) in tokens.iter().enumerate().skip(start) {
        match token.text {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            break;
        }
        let first = at > start && matches!(tokens[at - 1].text, "{" | ",");
        if depth == 1 && first && token.text != "," {
            heads.push(token);
        }
    }
    heads
}

/// Files, clocks, the environment and printing below I/O; threads below the studies.
fn outer_world(tokens: &[Token], layer: usize) -> Vec<Breach> {
    const MODULES: [&str; 6] = ["fs", "time", "env", "process", "net", "io"];
    const PRINTING: [&str; 5] = ["println", "print", "eprintln", "eprint", "dbg"];
    let mut breaches = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        let is_macro = text_at(tokens, at + 1) == "!";
        if token.text == "std" && text_at(tokens, at + 1) == "::" {
            for module in heads(tokens, at + 2) {
                if layer < IO && MODULES.contains(&module.text) {
                    let what = format!("`std::{}` below I/O", module.text);
                    breaches.push(Breach { line: module.line, what });
                }
                if layer < STUDIES && module.text == "thread" {
                    let what = "threads below the studies".into();
                    breaches.push(Breach { line: module.line, what });
                }
            }
        } else if layer < STUDIES && token.text == "rayon" {
            let what = "threads below the studies".into();
            breaches.push(Breach { line: token.line, what });
        } else if layer < IO && is_macro && PRINTING.contains(&token.text) {
            let what = format!("`{}!` below I/O", token.text);
            breaches.push(Breach { line: token.line, what });
        }
    }
    breaches
}

/// Functions of the platform, whose last bits differ between systems: `elementary` has all of them.
///
/// What is exact everywhere passes: roots, roundings, remainders, and powers that multiply once or
/// twice.
fn platform_functions(tokens: &[Token]) -> Vec<Breach> {
    const FUNCTIONS: [&str; 29] = [
        "sin", "cos", "tan", "sin_cos", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh",
        "asinh", "acosh", "atanh", "exp", "exp2", "exp_m1", "ln", "ln_1p", "log", "log2", "log10",
        "powf", "powi", "hypot", "cbrt", "mul_add", "gamma", "ln_gamma",
    ];
    /// Made of an angle by sine and cosine of the platform.
    const ROTATIONS: [&str; 4] = ["Rotation2", "Rotation3", "UnitComplex", "UnitQuaternion"];
    let exact = |at: usize| {
        tokens[at].text == "powi"
            && ["2", "3"].contains(&text_at(tokens, at + 2))
            && text_at(tokens, at + 3) == ")"
    };
    let is_call = |at: usize, text: &str| {
        let before = |back: usize| at.checked_sub(back).map_or("", |place| tokens[place].text);
        let of_number = before(1) == "::" && ["f64", "f32"].contains(&before(2));
        let of_value = before(1) == "." && text_at(tokens, at + 1) == "(";
        let turned = text == "new" && before(1) == "::" && ROTATIONS.contains(&before(2));
        (FUNCTIONS.contains(&text) && (of_number || of_value) && !exact(at)) || turned
    };
    let calls = tokens.iter().enumerate().filter(|(at, token)| is_call(*at, token.text));
    calls
        .map(|(_, Token { line, text })| Breach {
            line: *line,
            what: format!("`{text}` is the platform's: take that of `elementary`"),
        })
        .collect()
}

/// Names that convert to or from the units in which people talk, or carry such a unit.
fn units_of_people(tokens: &[Token]) -> Vec<Breach> {
    const CONVERSIONS: [&str; 5] = ["to_degrees", "to_radians", "deg", "kpa", "mm"];
    const SUFFIXES: [&str; 5] = ["_deg", "_degrees", "_kpa", "_mm", "_kn"];
    let breaks = |name: &str| {
        let lower = name.to_lowercase();
        CONVERSIONS.contains(&name) || SUFFIXES.iter().any(|suffix| lower.ends_with(suffix))
    };
    tokens
        .iter()
        .filter(|token| breaks(token.text))
        .map(|Token { line, text }| Breach {
            line: *line,
            what: format!("`{text}`: inside there are SI units only"),
        })
        .collect()
}

/// A word or a sign of Rust; `::` is one sign.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Token<'t> {
    line: usize,
    text: &'t str,
}

fn text_at<'t>(tokens: &[Token<'t>], at: usize) -> &'t str {
    tokens.get(at).map_or("", |token| token.text)
}

/// The tokens of a source, without comments, strings, characters and lifetimes.
fn tokens_of(text: &str) -> Vec<Token<'_>> {
    let mut tokens = Vec::new();
    let (mut at, mut line) = (0, 1);
    while let Some(first) = text[at..].chars().next() {
        let rest = &text[at..];
        let length = skipped(rest).unwrap_or_else(|| {
            let is_word = |c: char| c.is_alphanumeric() || c == '_';
            let length = if is_word(first) {
                rest.find(|c| !is_word(c)).unwrap_or(rest.len())
            } else if rest.starts_with("::") {
                2
            } else {
                first.len_utf8()
            };
            if !first.is_whitespace() {
                tokens.push(Token { line, text: &rest[..length] });
            }
            length
        });
        line += rest[..length].matches('\n').count();
        at += length;
    }
    tokens
}

/// Length of the comment, string, character or lifetime that a text starts with, if it does.
pub(super) fn skipped(text: &str) -> Option<usize> {
    if text.starts_with("//") {
        return Some(text.find('\n').unwrap_or(text.len()));
    }
    if text.starts_with("/*") {
        return Some(block_comment(text));
    }
    let raw = ["r", "br", "cr"].iter().find_map(|prefix| text.strip_prefix(prefix));
    if let Some(raw) = raw.filter(|raw| raw.trim_start_matches('#').starts_with('"')) {
        let hashes = raw.len() - raw.trim_start_matches('#').len();
        let close = format!("\"{}", "#".repeat(hashes));
        let start = text.len() - raw.len() + hashes + 1;
        return Some(
            text[start..].find(&close).map_or(text.len(), |end| start + end + close.len()),
        );
    }
    if text.starts_with('"') {
        return Some(quoted(text, '"'));
    }
    if let Some(rest) = text.strip_prefix('\'') {
        let mut chars = rest.chars();
        let (first, second) = (chars.next(), chars.next());
        let is_lifetime = first != Some('\\') && second != Some('\'');
        return Some(if is_lifetime { 1 } else { quoted(text, '\'') });
    }
    None
}

fn block_comment(text: &str) -> usize {
    let (mut depth, mut at) = (0, 0);
    while at < text.len() {
        let rest = &text[at..];
        if rest.starts_with("/*") {
            (depth, at) = (depth + 1, at + 2);
        } else if rest.starts_with("*/") {
            (depth, at) = (depth - 1, at + 2);
            if depth == 0 {
                return at;
            }
        } else {
            at += rest.chars().next().map_or(1, char::len_utf8);
        }
    }
    text.len()
}

/// Length of what stands in quotes, the quotes included.
fn quoted(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            c if c == quote => return at + 1,
            _ => {}
        }
    }
    text.len()
}

/// The tokens without modules for tests: there one writes what the source prints.
fn without_tests<'t>(tokens: &[Token<'t>]) -> Vec<Token<'t>> {
    const START: [&str; 8] = ["#", "[", "cfg", "(", "test", ")", "]", "mod"];
    without(tokens, &START, "{", "}")
}

/// The tokens without the texts of errors: those are for people, who talk in degrees.
fn without_error_texts<'t>(tokens: &[Token<'t>]) -> Vec<Token<'t>> {
    without(tokens, &["#", "[", "error"], "(", ")")
}

/// The tokens without what begins with `start` and ends where the brackets that follow close.
fn without<'t>(tokens: &[Token<'t>], start: &[&str], open: &str, close: &str) -> Vec<Token<'t>> {
    let mut kept = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let texts = tokens[at..].iter().map(|token| token.text);
        if tokens.len() - at >= start.len() && texts.take(start.len()).eq(start.iter().copied()) {
            let mut depth = 0;
            at += start.len();
            while at < tokens.len() {
                if tokens[at].text == open {
                    depth += 1;
                } else if tokens[at].text == close {
                    depth -= 1;
                    if depth == 0 {
                        break;
                    }
                }
                at += 1;
            }
        } else {
            kept.push(tokens[at]);
        }
        at += 1;
    }
    kept
}

/// Checks that a made-up source breaks a rule at each of these lines, and nowhere else.
fn check_breaches(name: &str, text: &str, lines: &[usize]) {
    let found = breaches_in(name, text);
    let found_lines: Vec<usize> = found.iter().map(|breach| breach.line).collect();
    assert_eq!(found_lines, lines, "{name}: {text}\n{found:?}");
}

#[test]
fn an_upward_import_is_seen_however_it_is_written() {
    for text in [
        "use crate::simulation::Scenario;",
        "use crate::{soil::Soil, simulation::{Scenario, Trajectory}};",
        "fn f() { crate::vehicle::f() }",
        "use super::super::vehicle::Rover;",
        "use super::super::{terrain, vehicle};",
        "mod inner { use super::super::super::vehicle::Rover; }",
        "use crate::document;",
        "#[cfg(test)] mod tests { use crate::studies::heading; }",
    ] {
        check_breaches("contact/slip.rs", text, &[1]);
    }
    check_breaches("soil.rs", "\n\nuse super::contact::Slip;\n", &[3]);
}

#[test]
fn imports_on_the_same_layer_and_downward_pass() {
    for text in [
        "use crate::soil::Soil;\nuse super::patch::ContactPatch;",
        "use crate::{error::finite, soil};",
        "mod inner { use super::super::patch; }\nuse super::model;",
        "mod tests { use super::*; }",
        "/// As [`crate::simulation::Scenario`].\nfn f() { \"crate::vehicle\"; r#\"crate::vehicle\"#; }",
        "/* crate::vehicle /* nested */ */ fn f(c: char) -> bool { c == '\"' || c == '\\'' }",
        "pub(crate) fn f<'a>(x: &'a str) -> &'a str { x }",
    ] {
        check_breaches("contact/slip.rs", text, &[]);
    }
}

#[test]
fn a_module_without_a_layer_is_seen() {
    check_breaches("helpers.rs", "", &[1]);
    check_breaches("soil.rs", "use crate::helpers::f;", &[1]);
}

#[test]
fn the_outer_world_stays_outside() {
    for text in [
        "use std::fs;",
        "use std::{f64, time::Instant};",
        "fn f() { std::env::var(\"X\"); }",
        "fn f() { println!(\"x\"); }",
        "fn f() { eprint!(\"x\"); }",
    ] {
        check_breaches("studies/heading.rs", text, &[1]);
        check_breaches("document/soil.rs", text, &[]);
    }
    check_breaches("studies/heading.rs", "use std::f64::consts::PI; fn print() {}", &[]);
}

#[test]
fn threads_start_with_the_studies() {
    for text in ["use std::thread;", "use rayon::prelude::*;"] {
        check_breaches("simulation/run.rs", text, &[1]);
        check_breaches("studies/campaign.rs", text, &[]);
    }
}

#[test]
fn functions_of_the_platform_are_seen() {
    for text in
        ["x.acos()", "f64::exp(x)", "x.map(f64::ln)", "x.powi(n)", "x.powi(-2)", "x.powi(16)"]
    {
        check_breaches("contact/slip.rs", &format!("fn f() {{ {text}; }}"), &[1]);
    }
    check_breaches("vehicle/state.rs", "fn f() { nalgebra::Rotation2::new(yaw); }", &[1]);
    for text in ["x.powi(2)", "x.sqrt()", "wide::exp(x)", "self.exp", "x.rem_euclid(4.0)"] {
        check_breaches("contact/slip.rs", &format!("fn f() {{ {text}; }}"), &[]);
    }
    let in_tests = "#[cfg(test)]\nmod tests { fn f() { x.sin(); } }";
    check_breaches("elementary/wide.rs", in_tests, &[]);
}

#[test]
fn units_of_people_stay_at_the_door() {
    for text in
        ["fn f(x: f64) { x.to_degrees(); }", "let slope_deg = 1.0;", "use crate::units::kpa;"]
    {
        check_breaches("contact/slip.rs", text, &[1]);
        check_breaches("document/soil.rs", text, &[]);
        check_breaches("units.rs", text, &[]);
    }
    let for_people = "#[error(\"{:.1}°\", .limit.to_degrees())] struct TooSteep { limit: f64 }";
    check_breaches("studies/heading.rs", for_people, &[]);
    let in_tests = "#[cfg(test)]\nmod tests { fn f() { deg(15.0); } }\nfn f() { deg(1.0); }";
    check_breaches("studies/heading.rs", in_tests, &[3]);
}
