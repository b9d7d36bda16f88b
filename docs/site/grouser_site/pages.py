"""Pages that are made at each build, in a folder that is not under version control."""

from __future__ import annotations

import re
from pathlib import Path

#: Characters that Markdown would take for its own.
_SPECIAL = re.compile(r"([\\\[\]<>*_|{}$#~])")


def write(app, folder: str, pages: dict[str, str]) -> None:
    """Writes pages by name, and removes what was there and is no longer made."""
    place = Path(app.srcdir, "reference", "generated", folder)
    place.mkdir(parents=True, exist_ok=True)
    for old in place.glob("*.md"):
        if old.stem not in pages:
            old.unlink()
    for name, text in pages.items():
        page = place / f"{name}.md"
        if not page.exists() or page.read_text(encoding="utf-8") != text:
            page.write_text(text, encoding="utf-8")


def escaped(text: str) -> str:
    """Plain words as Markdown; what stands between backticks stays code."""
    parts = text.split("`")
    return "`".join(part if k % 2 else _SPECIAL.sub(r"\\\1", part) for k, part in enumerate(parts))
