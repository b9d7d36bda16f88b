"""Writes `python/grouser/_keys.py`: the keys of the documents as attributes, for type checkers.

The keys, their types and sentences are those of `schema/*.json`, which `cargo xtask schema` makes from the
rows of the documents' tables. `tests/test_keys.py` fails if the file is not what this program writes.
"""

from __future__ import annotations

import ast
import json
import keyword
import textwrap
from collections.abc import Iterable
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
TARGET = HERE / "python" / "grouser" / "_keys.py"
#: Descriptions, each with the schema that has its keys, and the keys that the class has itself.
KINDS = {
    "Soil": ("soil", set()),
    "Wheel": ("wheel", set()),
    "Rover": ("rover", set()),
    "Scenario": ("scenario", {"rover", "soil"}),
    "Mission": ("mission", {"rover", "soil"}),
}
#: Keys of a site, which are a scenario's.
SITE = ("slope_deg", "gravity_m_s2")

HEAD = '''"""Keys of the documents as attributes, for type checkers. Written by ``generate_keys.py`` from the
schemas of the documents; a description finds its keys itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypedDict

if TYPE_CHECKING:
    from typing_extensions import Required


'''


class Writer:
    """Types of keys, and the tables that they name.

    Parameters
    ----------
    known
        The name of each table that is written already, by all that is below its name: a table that is like
        another has the other's name.
    """

    def __init__(self, schema: dict[str, Any], known: dict[tuple[str, ...], str]) -> None:
        self.defs = schema.get("$defs", {})
        self.tables: dict[str, list[str]] = {}
        self.known = known

    def type_of(self, schema: dict[str, Any], name: str) -> str:
        """The type of what a resolved document has under a key.

        Parameters
        ----------
        name
            What a table under it is called.
        """
        if "$ref" in schema:
            return self.type_of(self.defs[schema["$ref"].rsplit("/", 1)[-1]], name)
        choices = schema.get("anyOf") or schema.get("oneOf")
        doc = schema.get("description", "")
        if choices:
            return self.choice(choices, name, doc)
        kind = schema.get("type")
        if kind == "object":
            return self.table([schema], name, doc)
        if kind == "array":
            return f"tuple[{self.type_of(schema.get('items', {}), name)}, ...]"
        return {"number": "float", "integer": "int", "string": "str", "boolean": "bool"}.get(
            str(kind), "object"
        )

    def choice(self, choices: list[dict[str, Any]], name: str, doc: str) -> str:
        whole = [self.defs[it["$ref"].rsplit("/", 1)[-1]] if "$ref" in it else it for it in choices]
        tables = [it for it in whole if it.get("type") == "object"]
        # A name or path stands for a table, which a resolved document has in its place.
        if tables:
            return self.table(tables, name, doc)
        return union(self.type_of(it, name) for it in whole)

    def table(self, laws: list[dict[str, Any]], name: str, doc: str) -> str:
        """A table, with the keys of all its laws; those that each law asks for are there."""
        always = set.intersection(*(always_in(law) for law in laws))
        types: dict[str, list[str]] = {}
        docs: dict[str, str] = {}
        for law in laws:
            properties = law.get("properties", {})
            for key, schema in properties.items():
                # A resolved document has numbers in their own units, not in thousands of them.
                if key.endswith("_kn") and key.removesuffix("_kn") in properties:
                    continue
                part = name + "".join(word.capitalize() for word in key.split("_"))
                types.setdefault(key, []).append(self.type_of(schema, part))
                docs.setdefault(key, schema.get("description", ""))
        lines = [*doc_of(doc or laws[0].get("description", name), "    "), ""]
        reserved = {key: union(found) for key, found in types.items() if keyword.iskeyword(key)}
        for key, found in types.items():
            if key not in reserved:
                kind = f"Required[{union(found)}]" if key in always else union(found)
                lines += [f"    {key}: {kind}", *doc_of(docs[key], "    ")]
        first = self.known.setdefault((*lines, *reserved), name)
        if first == name:
            self.tables[name] = [*table_head(name, reserved), *lines]
        return first


def always_in(law: dict[str, Any]) -> set[str]:
    """The keys that a resolved table has: those that are asked for, alone or in thousands of their unit."""
    either = [rule.get("else", {}).get("required", ()) for rule in law.get("allOf", ())]
    return set(law.get("required", ())).union(*either)


def table_head(name: str, reserved: dict[str, str]) -> list[str]:
    """How the class of a table begins. Keys that are Python's own words cannot be fields of a class: a base has
    them."""
    if not reserved:
        return [f"class {name}(TypedDict, total=False):"]
    base = f"_{name}Reserved"
    keys = ", ".join(f'"{key}": {kind}' for key, kind in reserved.items())
    head = [f'{base} = TypedDict("{base}", {{{keys}}}, total=False)', "", ""]
    return [*head, f"class {name}({base}, total=False):"]


def union(types: Iterable[str]) -> str:
    """A type that is any of some, each of which may be such a union: each type once."""
    return " | ".join(dict.fromkeys(part for one in types for part in parts_of(ast.parse(one, mode="eval").body)))


def parts_of(node: ast.expr) -> list[str]:
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitOr):
        return [*parts_of(node.left), *parts_of(node.right)]
    return [ast.unparse(node)]


def doc_of(text: str, indent: str) -> list[str]:
    """A docstring, wrapped."""
    text = text.replace("\\", "\\\\")
    return textwrap.wrap(f'"""{text}"""', 99, initial_indent=indent, subsequent_indent=indent) if text else []


def attributes_of(owner: str, name: str, keys: dict[str, tuple[str, str]]) -> list[str]:
    lines = [f"class {owner}:", f'    """Keys of a {name}."""', "", "    __slots__ = ()", ""]
    lines.append("    if TYPE_CHECKING:")
    for key, (kind, doc) in keys.items():
        lines += ["", "        @property", f"        def {key}(self) -> {kind}:"]
        lines += [*(doc_of(doc, " " * 12) or ['            """As the document has it."""']), "            ..."]
    return lines


def written() -> str:
    """The content of the file."""
    parts: list[list[str]] = []
    scenario: dict[str, tuple[str, str]] = {}
    known: dict[tuple[str, ...], str] = {}
    for owner, (kind, own) in KINDS.items():
        schema = json.loads((HERE / f"../../schema/{kind}.json").read_text(encoding="utf-8"))
        writer, keys = Writer(schema, known), {}
        for key, of in schema["properties"].items():
            if key not in own:
                part = owner + "".join(word.capitalize() for word in key.split("_"))
                keys[key] = (writer.type_of(of, part), of.get("description", ""))
        parts += writer.tables.values()
        parts.append(attributes_of(f"{owner}Keys", kind, keys))
        scenario = keys if kind == "scenario" else scenario
    parts.append(attributes_of("SiteKeys", "site", {key: scenario[key] for key in SITE}))
    return HEAD + "\n\n\n".join("\n".join(lines) for lines in parts) + "\n"


if __name__ == "__main__":
    TARGET.write_text(written(), encoding="utf-8")
