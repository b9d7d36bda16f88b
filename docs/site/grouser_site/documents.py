"""The reference of documents: a page for each kind, from the schemas that editors use."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

from .pages import escaped, write


def write_pages(app) -> None:
    schemas = sorted(Path(app.srcdir, "..", "schema").glob("*.json"))
    kinds = {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in schemas}
    write(app, "documents", {kind: Kind(kinds, kind).page() for kind in kinds})


class Kind:
    """A kind of document, and what has been said about it so far."""

    def __init__(self, kinds: dict[str, Any], name: str) -> None:
        self.schema = kinds[name]
        # The documents that may stand inside this one are told on their own pages.
        self.others = self.schema.get("$defs", {})
        self.name = name
        self.lines: list[str] = []

    def page(self) -> str:
        self.say(
            f"# {self.schema['title']}: {article(self.name)}", escaped(self.schema["description"])
        )
        self.say(
            f"`grouser check FILE` checks one, `schema/{self.name}.json` lets an editor complete and check the keys. "
            "Keys in **bold** are needed."
        )
        self.table(self.schema, "")
        return "\n\n".join(self.lines) + "\n"

    def say(self, *paragraphs: str) -> None:
        self.lines += paragraphs

    def table(self, section: dict[str, Any], path: str) -> None:
        """The keys of a table, and then the tables below it."""
        # A table that may start from a preset needs no key where it does.
        needed = section.get("required", []) + section.get("then", {}).get("required", [])
        rows = ["| key | takes | default | meaning |", "|---|---|---|---|"]
        below = []
        for key, value in section["properties"].items():
            told = f"**`{key}`**" if key in needed else f"`{key}`"
            meaning = escaped(" ".join(value.get("description", "The law.").split()))
            words = self.words(value) if "const" not in self.followed(value) else []
            if len(words) > 1:
                meaning += " " + "; ".join(f"`{word}`: {escaped(said)}" for word, said in words)
            rows.append(f"| {told} | {self.takes(value)} | {default_of(value)} | {meaning} |")
            array, inner = self.resolved(value)
            if self.is_table(inner):
                brackets = "[[{}]]" if array else "[{}]"
                below.append((path + key, brackets.format(path + key), inner, meaning))
        self.say("\n".join(rows))
        for where, title, inner, meaning in below:
            self.section(where, title, inner, meaning)

    def section(self, path: str, title: str, inner: dict[str, Any], meaning: str) -> None:
        self.say(f"## `{title}`", meaning)
        for variant in self.variants(inner):
            law = self.words(variant["properties"].get("law", {}))
            if law:
                said = escaped(variant.get("description", ""))
                self.say(f'**`law = "{law[0][0]}"`** {said}'.rstrip())
            self.table(variant, f"{path}.")

    def resolved(self, value: dict[str, Any]) -> tuple[bool, dict[str, Any]]:
        """Whether it is a list, and what it, or an entry, is."""
        value = self.followed(value)
        array = value.get("type") == "array"
        inner = self.followed(value["items"]) if array else value
        # A number may stand for a table with one of its keys: the table says what all are.
        forms = inner.get("anyOf", [])
        tables = [one for one in forms if "properties" in one]
        has_number = any(one.get("type") == "number" for one in forms)
        return array, tables[0] if tables and has_number else inner

    def followed(self, value: dict[str, Any]) -> dict[str, Any]:
        name = value.get("$ref", "").removeprefix("#/$defs/")
        return self.others[name] if name else value

    def variants(self, value: dict[str, Any]) -> list[dict[str, Any]]:
        value = self.followed(value)
        several = value.get("oneOf", value.get("anyOf"))
        return [self.followed(one) | described(one) for one in several] if several else [value]

    def is_table(self, value: dict[str, Any]) -> bool:
        """Whether it has keys of its own, in every form that it takes."""
        return all("properties" in one for one in self.variants(value))

    def words(self, value: dict[str, Any]) -> list[tuple[str, str]]:
        """The words that a key may take, each with its meaning."""
        value = self.followed(value)
        several = value.get("oneOf", [value])
        return [(one["const"], one.get("description", "")) for one in several if "const" in one]

    def takes(self, value: dict[str, Any]) -> str:
        name = value.get("$ref", "").removeprefix("#/$defs/")
        if name in self.others:
            return f"the keys of [{article(name)}]({name}.md)"
        value = self.followed(value)
        words = self.words(value)
        if words:
            return " or ".join(f'`"{word}"`' for word, _ in words)
        if "anyOf" in value and not self.is_table(value):
            return ", or ".join(self.takes(one) for one in value["anyOf"])
        if value.get("type") == "array":
            count = value.get("minItems", 0)
            exactly = f"{count} × " if count and count == value.get("maxItems") else ""
            return f"list of {exactly}{self.takes(value['items'])}"
        if value.get("type") in ("number", "integer"):
            return limits(value)
        if value.get("type") == "boolean":
            return "`true` or `false`"
        return "table" if self.is_table(value) else "text"


def limits(value: dict[str, Any]) -> str:
    """The range of a number."""
    whole = "whole number " if value["type"] == "integer" else ""
    low, high = value.get("minimum"), value.get("maximum")
    if low is None and "exclusiveMinimum" in value:
        return f"{whole}above {value['exclusiveMinimum']:g}, to {short(high)}"
    if low is None or high is None:
        return whole.strip() or "number"
    return f"{whole}{short(low)} to {short(high)}"


def short(number: float) -> str:
    """Without the zeros of an exponent: 1e9."""
    return re.sub(r"e([+-])0*", lambda match: "e" + match[1].strip("+"), f"{number:g}")


def default_of(value: dict[str, Any]) -> str:
    if "default" not in value:
        return ""
    default = value["default"]
    if isinstance(default, dict):
        return ", ".join(f"`{key} = {json.dumps(one)}`" for key, one in default.items())
    return f"`{json.dumps(default)}`"


def described(value: dict[str, Any]) -> dict[str, str]:
    return {"description": value["description"]} if "description" in value else {}


def article(kind: str) -> str:
    return f"a {kind.replace('-', ' ')}"
