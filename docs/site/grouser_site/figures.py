"""How the figures of the notebooks look: in the package's own style."""

import tempfile
from pathlib import Path

import grouser


def settings() -> str:
    """A folder with a `matplotlibrc` of that style, which the notebooks' own processes read."""
    folder = Path(tempfile.mkdtemp(prefix="grouser-style-"))
    lines = [f"{key}: {_written(value)}" for key, value in grouser.style.rc_params().items()]
    # In such a file a hash begins a comment, and colours are written without it.
    text = "\n".join(lines).replace("#", "") + "\n"
    (folder / "matplotlibrc").write_text(text, encoding="utf-8")
    return str(folder / "matplotlibrc")


def _written(value: object) -> str:
    return ", ".join(map(str, value)) if isinstance(value, tuple) else str(value)
