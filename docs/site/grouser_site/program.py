"""The reference of the program: a page for each command, from what it says about itself."""

from __future__ import annotations

import os
import re
import subprocess
import textwrap
from collections.abc import Iterator

from sphinx.errors import ExtensionError

from .pages import escaped, write


def write_pages(app) -> None:
    program = os.environ.get("GROUSER_PROGRAM")
    if not program:
        raise ExtensionError("GROUSER_PROGRAM must name the built program `grouser`")
    write(app, "program", dict(pages(program)))


def pages(program: str, *above: str) -> Iterator[tuple[str, str]]:
    """Names and texts of the pages of a command's own commands."""
    # Groups of commands stand before the options; arguments are written in brackets.
    listed = help_of(program, *above).partition("\nOptions:\n")[0]
    for name in re.findall(r"^  ([a-z-]+)", listed, flags=re.M):
        if name != "help":
            command = (*above, name)
            yield "-".join(command), page(" ".join(command), help_of(program, *command))
            yield from pages(program, *command)


def help_of(program: str, *command: str) -> str:
    arguments = [program, *command, "--help"]
    environment = {**os.environ, "NO_COLOR": "1", "COLUMNS": "100"}
    return subprocess.run(
        arguments, env=environment, check=True, capture_output=True, text=True
    ).stdout


def page(name: str, text: str) -> str:
    """A command's help as Markdown: usage as it is, arguments and options as definitions."""
    about, _, rest = text.partition("Usage: ")
    usage, _, rest = rest.partition("\n\n")
    lines = [f"# grouser {name}", "", paragraphs(about), ""]
    lines += ["```sh", re.sub(r"^\S+", "grouser", usage.strip()), "```", ""]
    # A section starts at the margin: `Options:`; what follows the last one may be closing words.
    for section in re.split(r"\n(?=\S)", "\n" + rest.strip("\n")):
        title, _, body = section.strip("\n").partition("\n")
        if not title.endswith(":") or not body.startswith(" "):
            lines += [paragraphs(section), ""]
            continue
        lines += [f"## {title.removesuffix(':')}", ""]
        if title.startswith("Example"):
            lines += ["```sh", textwrap.dedent(body), "```", ""]
            continue
        for entry in re.split(r"\n+(?= {2,6}\S)", "\n" + body):
            if entry.strip():
                lines += [definition(entry), ""]
    return "\n".join(lines)


def definition(entry: str) -> str:
    """An argument or option: its name, and below it what it does."""
    term, _, body = entry.strip().partition("\n")
    # Short texts stand on the line of the name, two spaces or more behind it.
    term, _, beside = term.partition("  ")
    said = "\n".join(line.strip() for line in [beside, *body.splitlines()]).strip()
    told = "\n\n".join(filter(None, map(paragraph, re.split(r"\n\s*\n", said))))
    first, *others = told.splitlines()
    return "\n".join([f"`{term}`", f": {first}", *(f"  {line}" if line else "" for line in others)])


def paragraph(text: str) -> str:
    if text.startswith("[default:"):
        return f"Default: `{text.removeprefix('[default:').removesuffix(']').strip()}`"
    if text.startswith("Possible values:"):
        # A value goes on where a line does not start with a dash.
        values = re.sub(r"\n(?!- )", " ", text).splitlines()[1:]
        named = [value.removeprefix("- ").partition(":") for value in values]
        return "\n".join(f"- `{name}`: {escaped(said.strip())}" for name, _, said in named)
    return escaped(" ".join(text.split()))


def paragraphs(text: str) -> str:
    return "\n\n".join(escaped(" ".join(part.split())) for part in text.strip().split("\n\n"))
