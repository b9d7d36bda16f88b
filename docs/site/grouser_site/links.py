"""Links of the chapters to files that are no pages of the site.

On the code host every relative link leads somewhere. Here those to pages do; one to a file outside `docs/`
becomes a download of that file."""

from __future__ import annotations

import re
from pathlib import Path

_LINK = re.compile(r"\]\((\.\./[^)\s]+)\)")


def lead_outside(app, name: str, source: list[str]) -> None:
    docs = Path(app.srcdir)
    root = docs.parent
    here = (docs / name).parent

    def answered(match: re.Match[str]) -> str:
        target = match[1].partition("#")[0]
        path = (here / target).resolve()
        if path.is_relative_to(docs) or not path.is_relative_to(root):
            return match[0]
        if path.is_file():
            return f"](path:{target})"
        return match[0]

    source[0] = _LINK.sub(answered, source[0])
