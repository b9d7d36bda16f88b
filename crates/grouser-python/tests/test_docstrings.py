"""Docstrings say what every public function takes, in the sections of numpydoc."""

from __future__ import annotations

import importlib.util
import inspect
import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import grouser as gr


def members() -> Iterator[tuple[str, Any]]:
    """Every public function and class by its name, without exceptions."""
    modules: list[tuple[str, Any]] = [("", gr), ("campaign.", gr.campaign), ("style.", gr.style)]
    for name in ("gym", "jax", "mujoco"):
        modules.append((f"{name}.", pytest.importorskip(f"grouser.{name}")))
    if importlib.util.find_spec("torch"):
        modules.append(("torch.", importlib.import_module("grouser.torch")))
    for prefix, module in modules:
        for name in module.__all__:
            thing = getattr(module, name)
            if inspect.isfunction(thing):
                yield prefix + name, thing
            if inspect.isclass(thing) and not issubclass(thing, Exception):
                yield prefix + name, thing


def public() -> Iterator[tuple[str, Callable[..., Any]]]:
    """Every public function and method by its name."""
    for name, thing in members():
        if inspect.isclass(thing):
            yield from ((f"{name}.{method}", it) for method, it in methods(thing))
        else:
            yield name, thing


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


MEMBERS = dict(members())


@pytest.mark.parametrize("name", MEMBERS)
def test_everything_has_an_example_or_names_what_makes_it(name: str) -> None:
    doc = inspect.getdoc(MEMBERS[name]) or ""
    assert ">>> " in doc or "\nMade by `" in doc


@pytest.mark.parametrize("name", [name for name, it in MEMBERS.items() if inspect.isfunction(it)])
def test_what_a_function_returns_is_documented(name: str) -> None:
    returns = inspect.signature(MEMBERS[name]).return_annotation
    assert returns in (None, "None") or "\nReturns\n---" in (inspect.getdoc(MEMBERS[name]) or "")
