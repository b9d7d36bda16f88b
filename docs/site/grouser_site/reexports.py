"""Docstrings of attributes, and signatures.

The names of the package say that they live in `grouser`, where they are found; the lines below a field are in
the file that defines it. This tells the one reader of such lines where they are."""

from __future__ import annotations

import dataclasses
import pkgutil
import re
import shutil
from pathlib import Path

import grouser.campaign
import grouser.gym
import grouser.jax
import grouser.mujoco
from sphinx.pycode import ModuleAnalyzer
from sphinx.util import logging


def gather(app) -> None:
    # Pages of names that are gone would stay.
    shutil.rmtree(Path(app.srcdir, "reference", "generated", "python"), ignore_errors=True)
    for package in (grouser, grouser.campaign, grouser.gym):
        whole = ModuleAnalyzer.for_module(package.__name__)
        whole.analyze()
        for module in pkgutil.iter_modules(package.__path__):
            # PyTorch is not installed for a page that a sentence stands for.
            if module.name in ("_core", "__main__", "torch"):
                continue
            part = ModuleAnalyzer.for_module(f"{package.__name__}.{module.name}")
            part.analyze()
            for found in ("annotations", "attr_docs", "overloads", "tagorder"):
                getattr(whole, found).update(getattr(part, found))


def signature(app, what, name, thing, options, arguments, returns):
    """Nobody makes a result or an error by hand: how is not said."""
    if (
        arguments
        and what in ("class", "exception")
        and (dataclasses.is_dataclass(thing) or issubclass(thing, Exception))
    ):
        return "", returns
    return arguments, returns


def from_below(app, env, node, inner):
    """A name of `grouser` in the docstrings of the packages within it."""
    if node.get("refdomain") != "py" or node["reftarget"] not in grouser.__all__:
        return None
    whole = f"grouser.{node['reftarget']}"
    python = env.domains["py"]
    return python.resolve_xref(env, node["refdoc"], app.builder, "obj", whole, node, inner)


def complete(app) -> None:
    """Warns of names of the package that the reference leaves out."""
    page = Path(app.srcdir, "reference", "python.md").read_text(encoding="utf-8")
    told = set(
        re.findall(r"^ +(?:\.\. py:data:: )?(\w+)$|^\.\. py:data:: (\w+)$", page, flags=re.M)
    )
    packages = (grouser, grouser.campaign, grouser.gym, grouser.jax, grouser.mujoco)
    names = {name for package in packages for name in package.__all__}
    # A package within is told by its own names.
    names -= {package.__name__.removeprefix("grouser.") for package in packages}
    # So is this module, whose functions are listed as `style.use`.
    names.discard("style")
    for name in sorted(names - {a or b for a, b in told}):
        logging.getLogger(__name__).warning("reference/python.md leaves out %s", name)
