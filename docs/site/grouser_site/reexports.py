"""Docstrings of attributes.

The names of the package say that they live in `grouser`, where they are found; the lines below a field are in
the file that defines it. This tells the one reader of such lines where they are."""

from __future__ import annotations

import pkgutil

import grouser
from sphinx.pycode import ModuleAnalyzer


def gather(app) -> None:
    whole = ModuleAnalyzer.for_module("grouser")
    whole.analyze()
    for module in pkgutil.iter_modules(grouser.__path__):
        if module.name == "_core":
            continue
        part = ModuleAnalyzer.for_module(f"grouser.{module.name}")
        part.analyze()
        for found in ("annotations", "attr_docs", "overloads", "tagorder"):
            getattr(whole, found).update(getattr(part, found))
