"""Wraps the prose of the Markdown files at one width: `python3 docs/site/wrap.py [--check] [FILE…]`.

Only paragraphs and list items are touched. Headings, tables, code, front matter, directives and the blocks that
a command makes stay as they are, byte for byte. No well-kept formatter does that: they rewrite tables and directives.
"""

from __future__ import annotations

import re
import subprocess
import sys
import unicodedata
from collections.abc import Iterator
from pathlib import Path

WIDTH = 100
ROOT = Path(__file__).resolve().parents[2]
#: Files of which each line is an entry, or that another tool writes.
LEFT_OUT = {"ARCHITECTURE.md", "CHANGELOG.md"}

_FENCE = re.compile(r"\s*(`{3,}|~{3,}|:{3,})")
_MADE = re.compile(r"<!-- (made|picture|measured) by: ")
_MADE_END = "<!-- end -->"
_ITEM = re.compile(r"(\s*)([-*+]|\d+[.)])(\s+)(?=\S)")
#: What begins neither a paragraph nor an item, nor continues one.
_OTHER = re.compile(r"\s*(#{1,6}\s|\||<!--|>|!\[|\$\$|\[[^\]]+\]:\s|(-{3,}|\*{3,}|={3,})\s*$)")
#: What must not be broken: code, inline mathematics, the target of a link.
_WHOLE = re.compile(r"(`+)(?!`).+?(?<!`)\1(?!`)|\$[^$\s](?:[^$]*[^$\s])?\$|\]\([^)]*\)")
#: Words that would begin another block at the start of a line.
_BEGINS_A_BLOCK = re.compile(r"([-+*]|\d+[.)]|#{1,6}|=+|-+|([>|]|<!--|!\[|:{3}|~{3}|`{3}).*)$")
_SPACE = "\N{SYMBOL FOR SPACE}"


def wrapped(text: str) -> str:
    """The text with its paragraphs and list items at the one width."""
    lines: list[str] = []
    for piece, is_prose in _pieces(text.split("\n")):
        lines += _filled(piece) if is_prose else piece
    new = "\n".join(lines)
    if new.split() != text.split():
        raise ValueError("wrapping would change more than the ends of lines")
    return new


def _pieces(lines: list[str]) -> Iterator[tuple[list[str], bool]]:
    """The lines in groups: a paragraph or a list item, which is prose, or anything else."""
    at = 0
    while at < len(lines):
        start, line = at, lines[at]
        at += 1
        if start == 0 and line == "---":
            at = lines.index("---", 1) + 1
        elif _MADE.match(line):
            at = lines.index(_MADE_END, at) + 1
        elif fence := _FENCE.match(line):
            while lines[at].strip() != fence[1]:
                at += 1
            at += 1
        elif line.strip() and not _OTHER.match(line):
            while at < len(lines) and _continues(lines[at]):
                at += 1
            yield lines[start:at], True
            continue
        yield lines[start:at], False


def _continues(line: str) -> bool:
    return bool(line.strip()) and not (_OTHER.match(line) or _FENCE.match(line) or _ITEM.match(line))


def _filled(piece: list[str]) -> list[str]:
    if any(line.endswith(("  ", "\\")) for line in piece[:-1]):
        return piece
    item = _ITEM.match(piece[0])
    indent = len(piece[0]) - len(piece[0].lstrip())
    first = item[0] if item else " " * indent
    hanging = " " * len(first)
    text = " ".join(line.strip() for line in piece)[len(first.lstrip()) :]
    text = _WHOLE.sub(lambda match: match[0].replace(" ", _SPACE), text)
    lines, line = [], first
    for word in text.split(" "):
        joined = f"{line} {word}" if line.strip() and line != first else line + word
        if _width(joined) > WIDTH and line not in (first, hanging) and not _BEGINS_A_BLOCK.match(word):
            lines.append(line)
            joined = hanging + word
        line = joined
    lines.append(line)
    return [line.replace(_SPACE, " ").rstrip() for line in lines]


def _width(line: str) -> int:
    return sum(not unicodedata.combining(letter) for letter in line)


def main(arguments: list[str]) -> int:
    check = "--check" in arguments
    names = [argument for argument in arguments if argument != "--check"]
    if not names:
        listed = subprocess.run(["git", "ls-files", "*.md"], cwd=ROOT, capture_output=True, text=True, check=True)
        names = [str(ROOT / name) for name in listed.stdout.split("\n") if name and name not in LEFT_OUT]
    changed = 0
    for path in map(Path, names):
        text = path.read_text(encoding="utf-8")
        try:
            new = wrapped(text)
        except ValueError as error:
            raise SystemExit(f"{path}: {error}") from error
        if new != text:
            changed += 1
            print(f"{path} {'is not wrapped' if check else 'wrapped'}")
            if not check:
                path.write_text(new, encoding="utf-8")
    return int(check and changed > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
