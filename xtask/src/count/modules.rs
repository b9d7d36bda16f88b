//! Which modules of a crate use which, and where they use each other.
//!
//! A module is a file. It uses another one where it names something that is defined there: a name
//! that a third module only passes on (`use`, `pub use`) counts for the file that defines it, and
//! passing a name on is no use by itself. Tests are left out.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use anyhow::{Context, Result, anyhow};
use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// A module's path from the crate's root: empty for the root itself.
type Module = Vec<String>;

/// The modules of a crate.
#[derive(Debug, PartialEq)]
pub(super) struct Modules {
    pub(super) count: usize,
    /// The largest first.
    pub(super) cycles: Vec<Cycle>,
}

/// Modules that use each other, directly or by way of others: each with those of them that it uses.
pub(super) type Cycle = Vec<(String, Vec<String>)>;

impl Modules {
    /// Reads a crate from the file of its root.
    pub(super) fn read(root: &Path) -> Result<Self> {
        let mut files = BTreeMap::new();
        let folder = root.parent().context("a root lies in a folder")?;
        read_file(root, folder, &[], &mut files)?;
        Ok(Self::of(&files))
    }

    fn of(files: &BTreeMap<Module, File>) -> Self {
        let uses: BTreeMap<&Module, BTreeSet<Module>> =
            files.iter().map(|(module, file)| (module, used_by(module, file, files))).collect();
        let reach: BTreeMap<&Module, BTreeSet<&Module>> =
            uses.keys().map(|module| (*module, reached_from(module, &uses))).collect();
        let mut cycles: Vec<Cycle> = Vec::new();
        let mut seen: BTreeSet<&Module> = BTreeSet::new();
        for module in uses.keys() {
            let mutual = reach[*module].iter().filter(|other| reach[**other].contains(module));
            let cycle: Vec<&Module> = mutual.copied().collect();
            if cycle.len() > 1 && !seen.contains(module) {
                let inside = |module: &&Module| {
                    let used = uses[*module].iter().filter(|other| cycle.contains(other));
                    (name_of(module), used.map(name_of).collect())
                };
                cycles.push(cycle.iter().map(inside).collect());
            }
            seen.extend(cycle);
        }
        cycles.sort_by_key(|cycle| std::cmp::Reverse(cycle.len()));
        Self { count: files.len(), cycles }
    }
}

fn name_of(module: &Module) -> String {
    if module.is_empty() { "the root".into() } else { module.join("::") }
}

/// Modules that one uses, directly or by way of others; itself only where it comes back to itself.
fn reached_from<'m>(
    module: &Module,
    uses: &'m BTreeMap<&Module, BTreeSet<Module>>,
) -> BTreeSet<&'m Module> {
    let mut reached = BTreeSet::new();
    let mut ahead: Vec<&Module> = uses[module].iter().collect();
    while let Some(next) = ahead.pop() {
        if reached.insert(next) {
            ahead.extend(&uses[next]);
        }
    }
    reached
}

/// What is read from a source, as it stands there.
#[derive(Debug, Default)]
struct File {
    /// Names that `use` brings in.
    imports: Vec<Import>,
    /// Other paths, each with the inline module in which it stands.
    paths: Vec<(Module, Vec<String>)>,
    /// Modules that it declares, to be found in files of their own.
    declared: Vec<String>,
}

#[derive(Debug)]
struct Import {
    /// The module in which it stands, inline ones included.
    scope: Module,
    path: Vec<String>,
    /// The name that it brings in; `*` for all.
    name: String,
    /// Whether it passes the name on.
    is_public: bool,
}

/// Reads a module and those that it declares.
///
/// * `folder`: where their files lie
fn read_file(
    path: &Path,
    folder: &Path,
    module: &[String],
    files: &mut BTreeMap<Module, File>,
) -> Result<()> {
    let text = fs::read_to_string(path).with_context(|| path.display().to_string())?;
    let file = File::of(&text, module).with_context(|| path.display().to_string())?;
    for name in &file.declared {
        let places = [folder.join(format!("{name}.rs")), folder.join(name).join("mod.rs")];
        let found = places.iter().find(|place| place.is_file());
        let child = found.with_context(|| format!("{}: no file of `{name}`", path.display()))?;
        read_file(
            child,
            &folder.join(name),
            &[module, std::slice::from_ref(name)].concat(),
            files,
        )?;
    }
    files.insert(module.to_vec(), file);
    Ok(())
}

impl File {
    fn of(text: &str, module: &[String]) -> Result<Self> {
        let tokens: TokenStream = text.parse().map_err(|error| anyhow!("{error}"))?;
        let mut file = Self::default();
        file.scan(tokens, module, module);
        Ok(file)
    }

    /// * `module`: the file's
    /// * `scope`: the same, or an inline module of it
    fn scan(&mut self, tokens: TokenStream, module: &[String], scope: &[String]) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut at = 0;
        while at < tokens.len() {
            match word(&tokens, at).as_deref() {
                _ if is_test(&tokens, at) => at = end_of_item(&tokens, at),
                Some("use") if !is_sign(&tokens, at + 1, '<') => {
                    let end = end_of_item(&tokens, at);
                    let is_public = at > 0 && is_visibility(&tokens, at - 1);
                    self.import(&tokens[at + 1..end], &[], scope, is_public);
                    // The brace of a group is not the item's end.
                    at = end;
                }
                Some("mod") => {
                    let name = word(&tokens, at + 1);
                    match (name, tokens.get(at + 2)) {
                        (Some(name), Some(TokenTree::Group(body))) => {
                            let inner = [scope, &[name]].concat();
                            self.scan(body.stream(), module, &inner);
                            at += 2;
                        }
                        (Some(name), _) if scope == module => self.declared.push(name),
                        _ => {}
                    }
                }
                Some(_) if starts_path(&tokens, at) => {
                    let (path, end) = path_at(&tokens, at);
                    self.paths.push((scope.to_vec(), path));
                    at = end - 1;
                }
                _ => {
                    if let TokenTree::Group(group) = &tokens[at] {
                        self.scan(group.stream(), module, scope);
                    }
                }
            }
            at += 1;
        }
    }

    /// Takes the tree of a `use` apart: `a::b`, `a as b`, `{a, b::c}`, `*`.
    fn import(&mut self, tree: &[TokenTree], before: &[String], scope: &[String], is_public: bool) {
        for part in tree.split(
            |token| matches!(token, TokenTree::Punct(sign) if [',', ';'].contains(&sign.as_char())),
        ) {
            if part.is_empty() {
                continue;
            }
            let (path, end) = path_at(part, 0);
            let mut path = [before, &path].concat();
            if let Some(TokenTree::Group(group)) = part.get(end) {
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                self.import(&inner, &path, scope, is_public);
                continue;
            }
            let renamed = (word(part, end).as_deref() == Some("as")).then(|| word(part, end + 1));
            let all = is_sign(part, end, '*').then(|| "*".to_owned());
            let last = all.or_else(|| path.last().cloned());
            if path.last().is_some_and(|last| last == "self") {
                path.pop();
            }
            let own = if last.as_deref() == Some("self") { path.last().cloned() } else { last };
            if let Some(name) = renamed.flatten().or(own) {
                self.imports.push(Import { scope: scope.to_vec(), path, name, is_public });
            }
        }
    }
}

fn word(tokens: &[TokenTree], at: usize) -> Option<String> {
    match tokens.get(at)? {
        TokenTree::Ident(ident) => Some(ident.to_string().trim_start_matches("r#").to_owned()),
        _ => None,
    }
}

fn is_sign(tokens: &[TokenTree], at: usize, sign: char) -> bool {
    matches!(tokens.get(at), Some(TokenTree::Punct(punct)) if punct.as_char() == sign)
}

/// Whether `::` stands at a place.
fn is_separator(tokens: &[TokenTree], at: usize) -> bool {
    is_sign(tokens, at, ':') && is_sign(tokens, at + 1, ':')
}

/// Whether `#[cfg(test)]` stands at a place.
fn is_test(tokens: &[TokenTree], at: usize) -> bool {
    let Some(TokenTree::Group(group)) = tokens.get(at + 1) else { return false };
    is_sign(tokens, at, '#') && group.stream().to_string().replace(' ', "") == "cfg(test)"
}

/// The place of the `;` or the body at which an item ends.
fn end_of_item(tokens: &[TokenTree], at: usize) -> usize {
    let is_use = word(tokens, at).as_deref() == Some("use");
    let is_end = |place: &usize| match &tokens[*place] {
        TokenTree::Group(group) => !is_use && group.delimiter() == Delimiter::Brace,
        _ => is_sign(tokens, *place, ';'),
    };
    (at..tokens.len()).find(is_end).unwrap_or(tokens.len() - 1)
}

/// Whether `pub`, or the brackets after it, stand at a place.
fn is_visibility(tokens: &[TokenTree], at: usize) -> bool {
    let is_pub = |at: usize| word(tokens, at).as_deref() == Some("pub");
    is_pub(at) || (matches!(tokens[at], TokenTree::Group(_)) && at > 0 && is_pub(at - 1))
}

/// Whether a path of several names starts at a place.
fn starts_path(tokens: &[TokenTree], at: usize) -> bool {
    let continues = at > 0 && (is_sign(tokens, at - 1, ':') || is_sign(tokens, at - 1, '.'));
    // `field: crate::x` has one colon before it.
    let continues =
        continues && (is_sign(tokens, at - 1, '.') || at > 1 && is_sign(tokens, at - 2, ':'));
    !continues && is_separator(tokens, at + 1)
}

/// The names of the path at a place, and the place after it and its last `::`.
fn path_at(tokens: &[TokenTree], mut at: usize) -> (Vec<String>, usize) {
    let mut names = Vec::new();
    if is_separator(tokens, at) {
        at += 2;
    }
    while let Some(name) = word(tokens, at) {
        names.push(name);
        at += 1;
        if !is_separator(tokens, at) {
            break;
        }
        at += 2;
    }
    (names, at)
}

/// Modules that one uses.
fn used_by(module: &Module, file: &File, files: &BTreeMap<Module, File>) -> BTreeSet<Module> {
    let imported = file.imports.iter().filter(|import| !import.is_public).filter_map(|import| {
        let path = absolute(module, &import.scope, &import.path, files, 0)?;
        let (definer, is_item) = definer_of(&path, files, 0)?;
        (is_item || import.name == "*").then_some(definer)
    });
    let named = file.paths.iter().filter_map(|(scope, path)| {
        let path = absolute(module, scope, path, files, 0)?;
        Some(definer_of(&path, files, 0)?.0)
    });
    imported.chain(named).filter(|other| other != module).collect()
}

/// Names that pass on names that pass on names: more than any source has.
const DEEPEST: usize = 32;

/// A path from the crate's root; none for one that leads into another crate, or is a type's own.
///
/// * `module`: the file's
/// * `scope`: the module in which the path stands
fn absolute(
    module: &Module,
    scope: &[String],
    path: &[String],
    files: &BTreeMap<Module, File>,
    depth: usize,
) -> Option<Vec<String>> {
    let head = path.first()?;
    match head.as_str() {
        "crate" => return Some(path[1..].to_vec()),
        "self" => return Some([scope, &path[1..]].concat()),
        "super" => {
            let ups = path.iter().take_while(|name| *name == "super").count();
            let above = scope.len().checked_sub(ups)?;
            return Some([&scope[..above], &path[ups..]].concat());
        }
        _ => {}
    }
    let child = [scope, &path[..1]].concat();
    if files.contains_key(&child) {
        return Some([scope, path].concat());
    }
    if depth > DEEPEST {
        return None;
    }
    let import = files.get(module)?.imports.iter().find(|import| import.name == *head)?;
    // `use name::…` names a crate, never itself.
    if import.path.first() == Some(head) {
        return None;
    }
    let start = absolute(module, &import.scope, &import.path, files, depth + 1)?;
    Some([&start, &path[1..]].concat())
}

/// The module that defines what a path from the root leads to, and whether that is something in it
/// rather than the module itself; none if another crate does.
fn definer_of(
    path: &[String],
    files: &BTreeMap<Module, File>,
    depth: usize,
) -> Option<(Module, bool)> {
    let mut module = Module::new();
    for (index, name) in path.iter().enumerate() {
        let child = [module.as_slice(), std::slice::from_ref(name)].concat();
        if files.contains_key(&child) {
            module = child;
            continue;
        }
        let imports = &files.get(&module)?.imports;
        let passed_on = imports.iter().find(|import| import.name == *name);
        let Some(import) = passed_on.filter(|_| depth < DEEPEST) else {
            return Some((module, true));
        };
        let target = absolute(&module, &import.scope, &import.path, files, depth + 1)?;
        return definer_of(&[&target, &path[index + 1..]].concat(), files, depth + 1);
    }
    Some((module, false))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cycles(sources: &[(&str, &str)]) -> Vec<Vec<String>> {
        let files = sources.iter().map(|(path, text)| {
            let module: Module =
                path.split("::").filter(|part| !part.is_empty()).map(String::from).collect();
            let file = File::of(text, &module).expect("Rust");
            (module, file)
        });
        let cycles = Modules::of(&files.collect()).cycles;
        let names = |cycle: Cycle| cycle.into_iter().map(|(module, _)| module).collect();
        cycles.into_iter().map(names).collect()
    }

    #[test]
    fn modules_that_use_each_other_are_a_cycle() {
        for there in [
            "use super::b::Two;",
            "fn f() -> crate::b::Two { todo!() }",
            "use crate::{b::{self, Two}};",
        ] {
            for back in [
                "use crate::a::One;",
                "use super::a; fn g(x: a::One) {}",
                "fn f() { x(super::a::one()) }",
            ] {
                let found = cycles(&[("", "mod a; mod b;"), ("a", there), ("b", back)]);
                assert_eq!(found, [["a", "b"]], "{there} {back}");
            }
        }
        let three = [
            ("", ""),
            ("a", "use crate::b::X;"),
            ("b", "use crate::c::Z;"),
            ("c", "use crate::a::Y;"),
        ];
        assert_eq!(cycles(&three), [["a", "b", "c"]]);
    }

    #[test]
    fn one_way_is_no_cycle() {
        assert!(
            cycles(&[
                ("", ""),
                ("a", "use crate::b::X; use std::a::Y;"),
                ("b", "struct X; use a::Z;")
            ])
            .is_empty()
        );
        let tested = "struct X; #[cfg(test)] mod tests { use crate::a::One; }";
        assert!(cycles(&[("", ""), ("a", "use crate::b::X;"), ("b", tested)]).is_empty());
        let commented =
            "/// [`crate::a::One`]\nstruct X; // crate::a::One\nconst S: &str = \"crate::a::One\";";
        assert!(cycles(&[("", ""), ("a", "use crate::b::X;"), ("b", commented)]).is_empty());
    }

    /// A parent that only passes on what its children define is not used by them.
    #[test]
    fn a_name_that_is_passed_on_counts_where_it_is_defined() {
        let facade = "pub mod one; mod two; pub use one::One; pub use two::{Two as Second};";
        let two = "use super::One; fn f() -> crate::a::One { One }";
        let sources = [
            ("", "pub use a::Second;"),
            ("a", facade),
            ("a::one", "pub struct One;"),
            ("a::two", two),
        ];
        assert!(cycles(&sources).is_empty());
        let back = "pub struct One; use crate::Second;";
        let sources =
            [("", "pub use a::Second;"), ("a", facade), ("a::one", back), ("a::two", two)];
        assert_eq!(cycles(&sources), [["a::one", "a::two"]]);
    }

    #[test]
    fn a_parent_and_its_child_can_be_a_cycle() {
        let parent = "mod child; pub struct One; fn f() { child::g() }";
        assert_eq!(
            cycles(&[("", ""), ("a", parent), ("a::child", "use super::One;")]),
            [["a", "a::child"]]
        );
        let inner = "mod inner { use super::super::One; }";
        assert_eq!(cycles(&[("", ""), ("a", parent), ("a::child", inner)]), [["a", "a::child"]]);
    }
}
