"""What was built, told at the end: `cargo xtask site` reads it."""

from __future__ import annotations

from collections import Counter

_CELLS: Counter[str] = Counter()


def cells(app, doctree) -> None:
    """Counts the cells of a notebook that were run."""
    code = doctree.findall(
        lambda node: node.get("nb_element") == "cell_code" if hasattr(node, "get") else False
    )
    _CELLS[app.env.docname] = sum(1 for _ in code)


def tell(app, exception) -> None:
    if exception is None:
        notebooks = [name for name, count in _CELLS.items() if count]
        print(
            f"{len(app.env.found_docs)} pages, {len(notebooks)} notebooks, {_CELLS.total()} cells run"
        )
