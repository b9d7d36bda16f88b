//! Blocks of Markdown files that a command makes. `CONTRIBUTING.md` shows how they look.
//!
//! A block starts with a line `<!-- made by: cargo run --release -- ARGUMENTS -->` (or
//! `picture by`, or `measured by`) and ends with a line `<!-- end -->`. Blocks by
//! `cargo xtask CHORE` are that chore's to write. Markers in fenced code are examples and do not
//! count.

use std::fs;

use anyhow::{Context, Result, bail};

use crate::markdown::Page;
use crate::workspace;

/// What a block shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// What the command prints.
    Output,
    /// A picture that the command writes.
    Picture,
    /// What the command printed on one machine at one time: written, never compared.
    Measurement,
}

/// A block that a command makes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Block {
    pub(crate) kind: Kind,
    /// What the program `grouser` is asked.
    pub(crate) arguments: Vec<String>,
    /// Line of the first marker, from 1.
    pub(crate) line: usize,
    /// What stands between the markers.
    pub(crate) content: String,
}

/// A piece of a Markdown file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Piece {
    /// Lines that nobody but a person writes, the markers among them.
    Text(String),
    /// What stands between two markers.
    Made(Block),
}

const END: &str = "<!-- end -->";
const COMMAND: &str = "cargo run --release -- ";
const CHORE: &str = "cargo xtask ";

/// The pieces of a Markdown file, in their order; put together they are the file again.
pub(crate) fn pieces(markdown: &str) -> Result<Vec<Piece>> {
    let mut pieces = Vec::new();
    let mut text = String::new();
    let mut block: Option<Block> = None;
    let page = Page::read(markdown);
    let mut place = 0;
    for (index, line) in markdown.split_inclusive('\n').enumerate() {
        let start = place;
        place += line.len();
        if let Some(open) = &mut block {
            if line.trim() == END {
                pieces.push(Piece::Text(std::mem::take(&mut text)));
                pieces.extend(block.take().map(Piece::Made));
                text.push_str(line);
            } else {
                open.content.push_str(line);
            }
            continue;
        }
        text.push_str(line);
        if !page.is_fenced(start) {
            block =
                start_of(line.trim(), index + 1).with_context(|| format!("line {}", index + 1))?;
        }
    }
    if let Some(Block { line, .. }) = block {
        bail!("line {line}: the block has no `{END}`");
    }
    pieces.push(Piece::Text(text));
    Ok(pieces)
}

fn start_of(line: &str, number: usize) -> Result<Option<Block>> {
    let Some(comment) = line.strip_prefix("<!--").and_then(|rest| rest.strip_suffix("-->")) else {
        return Ok(None);
    };
    let (kind, command) = match comment.trim().split_once(": ") {
        Some(("made by", command)) => (Kind::Output, command),
        Some(("picture by", command)) => (Kind::Picture, command),
        Some(("measured by", command)) => (Kind::Measurement, command),
        _ => return Ok(None),
    };
    if kind != Kind::Picture && command.trim().starts_with(CHORE) {
        // What a chore makes or measures, it writes itself.
        return Ok(None);
    }
    let Some(arguments) = command.trim().strip_prefix(COMMAND) else {
        bail!("a block is made by `{COMMAND}…`, not by `{}`", command.trim());
    };
    let arguments = shell_words::split(arguments)?;
    Ok(Some(Block { kind, arguments, line: number, content: String::new() }))
}

/// The arguments of each command of a line: `… && cargo run --release -- …` is another one.
pub(crate) fn commands(arguments: &[String]) -> Result<Vec<&[String]>> {
    let start: Vec<&str> = COMMAND.split_whitespace().collect();
    let mut parts = arguments.split(|word| word == "&&");
    let first = parts.next().into_iter().map(Ok);
    let others = parts.map(|words| {
        let is_ours = words.len() > start.len() && words.iter().zip(&start).all(|(a, b)| a == b);
        if is_ours {
            Ok(&words[start.len()..])
        } else {
            bail!("`{COMMAND}…` is wanted after `&&`")
        }
    });
    first.chain(others).collect()
}

/// What a program printed, as Markdown: a table as it is, anything else as fenced code.
pub(crate) fn as_markdown(output: &str, arguments: &[String]) -> String {
    let output = output.trim_matches('\n');
    let mut lines = output.lines().filter(|line| !line.trim().is_empty()).peekable();
    let is_table = lines.peek().is_some() && lines.all(|line| line.trim().starts_with('|'));
    if is_table {
        // Without blank lines around it a table would run into the markers.
        return format!("\n{output}\n\n");
    }
    let language = arguments
        .windows(2)
        .find(|pair| pair[0] == "--format" && (pair[1] == "json" || pair[1] == "csv"))
        .map_or("text", |pair| pair[1].as_str());
    let output = output.lines().map(str::trim_end).collect::<Vec<_>>().join("\n");
    format!("```{language}\n{output}\n```\n")
}

/// The file that a picture's block shows: the target of its only image link.
pub(crate) fn picture_of(content: &str) -> Result<&str> {
    let targets: Vec<&str> = content
        .split("![")
        .skip(1)
        .filter_map(|rest| rest.split_once("](")?.1.split_once(')'))
        .map(|(target, _)| target)
        .collect();
    match targets[..] {
        [target] => Ok(target),
        _ => bail!("a picture's block holds one image link, not {}", targets.len()),
    }
}

/// What stands in the block of a chore.
///
/// * `by`: how its marker begins and names the chore, such as
///   `measured by: cargo xtask python-times`
pub(crate) fn content_by<'t>(markdown: &'t str, by: &str) -> Result<&'t str> {
    let start = format!("<!-- {by} -->\n");
    let (_, rest) = markdown.split_once(&start).with_context(|| format!("no block `{by}`"))?;
    let (content, _) = rest.split_once(END).with_context(|| format!("`{by}` has no `{END}`"))?;
    Ok(content)
}

/// Prints another content of the block of a chore, and writes it into its document.
///
/// * `file`: the document, as a path from the root
/// * `by`: as in [`content_by`]
pub(crate) fn write_content_by(file: &str, by: &str, content: &str) -> Result<()> {
    let path = workspace::root().join(file);
    let markdown = fs::read_to_string(&path).with_context(|| file.to_owned())?;
    let written = with_content_by(&markdown, by, content).with_context(|| file.to_owned())?;
    print!("{content}");
    fs::write(&path, written).with_context(|| file.to_owned())
}

/// A text with another content in the block of a chore.
pub(crate) fn with_content_by(markdown: &str, by: &str, content: &str) -> Result<String> {
    let old = content_by(markdown, by)?;
    let start = old.as_ptr() as usize - markdown.as_ptr() as usize;
    let (before, after) = (&markdown[..start], &markdown[start + old.len()..]);
    Ok(format!("{before}{}{after}", as_markdown(content, &[])))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "\
# Title

<!-- made by: cargo run --release -- attitude --slope-deg 5,10 -->
old
<!-- end -->
between
<!-- picture by: cargo run --release -- reproduce -->
![Curves](docs/pictures/fig10.svg)
<!-- end -->
";

    fn blocks(markdown: &str) -> Vec<Block> {
        let pieces = pieces(markdown).expect("a good file");
        pieces
            .into_iter()
            .filter_map(|piece| match piece {
                Piece::Made(block) => Some(block),
                Piece::Text(_) => None,
            })
            .collect()
    }

    #[test]
    fn blocks_are_found_with_their_commands() {
        let blocks = blocks(FILE);
        assert_eq!(blocks.len(), 2);
        assert_eq!(blocks[0].arguments, ["attitude", "--slope-deg", "5,10"]);
        assert_eq!((blocks[0].kind, blocks[0].line), (Kind::Output, 3));
        assert_eq!(blocks[0].content, "old\n");
        assert_eq!(blocks[1].kind, Kind::Picture);
        assert_eq!(picture_of(&blocks[1].content).ok(), Some("docs/pictures/fig10.svg"));
    }

    #[test]
    fn a_line_may_have_several_commands() {
        let split = |line: &str| {
            let words = shell_words::split(line).expect("words");
            let parts = commands(&words)?;
            Ok::<_, anyhow::Error>(parts.iter().map(|it| it.join(" ")).collect::<Vec<_>>())
        };
        let both = split("terrain moon --force && cargo run --release -- map site.tif");
        assert_eq!(both.expect("two"), ["terrain moon --force", "map site.tif"]);
        assert_eq!(split("draw").expect("one"), ["draw"]);
        assert!(split("draw && rm site.tif").is_err());
    }

    #[test]
    fn the_pieces_are_the_file() {
        let together: String = pieces(FILE)
            .expect("a good file")
            .into_iter()
            .map(|piece| match piece {
                Piece::Text(text) => text,
                Piece::Made(block) => block.content,
            })
            .collect();
        assert_eq!(together, FILE);
    }

    #[test]
    fn markers_in_fenced_code_are_examples() {
        assert!(blocks(&format!("```markdown\n{FILE}```\n")).is_empty());
    }

    #[test]
    fn what_a_block_holds_is_not_looked_into() {
        let nested =
            "<!-- made by: cargo run --release -- presets -->\n```text\n# x\n<!-- end -->\n";
        assert_eq!(blocks(nested)[0].content, "```text\n# x\n");
    }

    #[test]
    fn a_block_without_end_or_with_a_bad_command_is_refused() {
        assert!(pieces("<!-- made by: cargo run --release -- presets -->\n").is_err());
        assert!(pieces("<!-- made by: rm -rf . -->\n<!-- end -->\n").is_err());
        let open = "<!-- made by: cargo run --release -- card --name 'open -->\n<!-- end -->\n";
        assert!(pieces(open).is_err());
    }

    #[test]
    fn the_blocks_of_chores_are_left_to_them() {
        for by in ["measured by: cargo xtask python-times", "made by: cargo xtask count"] {
            let markdown = format!("a\n<!-- {by} -->\nold\n<!-- end -->\nb\n");
            assert!(blocks(&markdown).is_empty());
            let written = with_content_by(&markdown, by, "1 s\n").expect("its block");
            let expected = format!("a\n<!-- {by} -->\n```text\n1 s\n```\n<!-- end -->\nb\n");
            assert_eq!(written, expected);
            assert!(with_content_by("a", by, "1").is_err());
        }
    }

    #[test]
    fn tables_stay_and_the_rest_is_fenced() {
        let none: &[String] = &[];
        assert_eq!(as_markdown("| a |\n|---|\n", none), "\n| a |\n|---|\n\n");
        assert_eq!(as_markdown("a  \n b\n", none), "```text\na\n b\n```\n");
        let json = ["--format".to_string(), "json".to_string()];
        assert_eq!(as_markdown("{}\n", &json), "```json\n{}\n```\n");
    }
}
