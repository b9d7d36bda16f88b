"""Notebooks to download: each page whose cells are run, as a file for Jupyter, without its results."""

from __future__ import annotations

import re
from pathlib import Path

import nbformat
from myst_nb.core.read import create_nb_reader

#: Links to other pages of the site, which lead nowhere from a notebook alone; those to addresses stay.
_LINK = re.compile(r"\[([^\]]*)\]\((?!https?:)[^)]*\)")


def offer(app, page: str, template: str, context: dict, doctree) -> None:
    """Writes the notebook of a page beside it, and has the page link it."""
    source = Path(app.env.doc2path(page)) if page in app.env.found_docs else None
    if source is None or "kernelspec:" not in source.read_text(encoding="utf-8")[:200]:
        return
    reader = create_nb_reader(str(source), app.env.myst_config, app.env.mystnb_config, source.read_text("utf-8"))
    notebook = reader.read(source.read_text(encoding="utf-8"))
    # What is not shown, such as the check of a command, is for the site alone.
    notebook.cells = [one for one in notebook.cells if "remove-cell" not in one.metadata.get("tags", [])]
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            cell.source = _LINK.sub(r"\1", cell.source)
    path = Path(app.outdir, f"{page}.ipynb")
    path.parent.mkdir(parents=True, exist_ok=True)
    nbformat.write(notebook, path)
    context["notebook"] = path.name
