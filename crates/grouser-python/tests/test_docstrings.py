"""Docstrings say what every public function takes, in the sections of numpydoc."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import grouser as gr


def public() -> Iterator[tuple[str, Callable[..., Any]]]:
    """Every public function, class and method by its name."""
    modules: list[tuple[str, Any, list[str]]] = [("", gr, list(gr.__all__))]
    modules.append(("campaign.", gr.campaign, list(gr.campaign.__all__)))
    for name in ("gym", "mujoco"):
        module = pytest.importorskip(f"grouser.{name}")
        modules.append((f"{name}.", module, list(module.__all__)))
    for prefix, module, names in modules:
        for name in names:
            thing = getattr(module, name)
            if inspect.isfunction(thing):
                yield prefix + name, thing
            if inspect.isclass(thing) and not issubclass(thing, Exception):
                yield from ((f"{prefix}{name}.{method}", it) for method, it in methods(thing))


def methods(owner: type) -> Iterator[tuple[str, Callable[..., Any]]]:
    for name, thing in vars(owner).items():
        it = thing.__func__ if isinstance(thing, (classmethod, staticmethod)) else thing
        if inspect.isfunction(it) and not name.startswith("_"):
            yield name, it


def documented(doc: str) -> set[str]:
    """The names in the section of the parameters."""
    section = re.search(r"(?ms)^Parameters\n-+\n(.*?)(?=^\S[^\n]*\n-+$|\Z)", doc)
    if section is None:
        return set()
    heads = [line for line in section.group(1).splitlines() if line and not line.startswith(" ")]
    names = (name for head in heads for name in head.split(" : ")[0].split(","))
    return {name.strip().lstrip("*") for name in names}


FUNCTIONS = dict(public())


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_argument_is_documented(name: str) -> None:
    function = FUNCTIONS[name]
    doc = inspect.getdoc(function)
    assert doc, "it has no docstring"
    parameters = inspect.signature(function).parameters
    taken = {it for it in parameters if it not in ("self", "cls") and not it.startswith("_")}
    assert documented(doc) == taken
