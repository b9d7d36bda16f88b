"""Lines of the guides through a type checker, as an editor shows them to whoever copies them."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
#: What the text around a block introduces.
GIVEN = """from typing import Any
import rasterio, rioxarray
records: Any
heights: Any
places: Any
current_a: Any
wheel_speed_rad_s: Any
yaw_deg: Any
"""


def blocks(text: str) -> list[str]:
    """The lines of Python in a page: blocks, cells of notebooks without their options, and examples with
    prompts without their answers."""
    found = []
    for block in re.findall(r"```(?:python|\{code-cell\}[^\n]*)\n(.*?)```", text, re.DOTALL):
        lines = re.sub(r"\A(?:(?::.*\n)+|---\n(?:.*\n)*?---\n)", "", block)
        prompted = [line[4:] for line in lines.splitlines() if line.startswith((">>>", "..."))]
        found.append("\n".join(prompted) if prompted else lines)
    return found


def test_a_type_checker_agrees_with_every_line(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    pages = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    scripts = {page: blocks(page.read_text("utf-8")) for page in pages}
    scripts = {page: found for page, found in scripts.items() if found}
    assert len(scripts) > 30
    for page, found in scripts.items():
        name = "_".join(page.relative_to(ROOT).with_suffix("").parts).replace("-", "_")
        (tmp_path / f"{name}.py").write_text("\n".join([GIVEN, *found]), encoding="utf-8")
    examples = sorted((ROOT / "crates/grouser-python/examples").glob("*.py"))
    # Other packages have functions without types.
    options = ["--strict", "--allow-untyped-calls", "--ignore-missing-imports", "--allow-redefinition-new"]
    options += ["--local-partial-types", "--disable-error-code=import-untyped", "--cache-dir", str(tmp_path)]
    command = [sys.executable, "-m", "mypy", *options, *map(str, tmp_path.glob("*.py")), *map(str, examples)]
    found = subprocess.run(command, capture_output=True, text=True, check=False)
    assert found.returncode == 0, found.stdout + found.stderr
