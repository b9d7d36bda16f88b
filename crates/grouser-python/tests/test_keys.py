"""Keys of descriptions are typed attributes: those of the schemas, which are made from the library's rows."""

from __future__ import annotations

import importlib.util
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import grouser as gr

GENERATOR = Path(__file__).resolve().parents[1] / "generate_keys.py"


def generator() -> Any:
    spec = importlib.util.spec_from_file_location("generate_keys", GENERATOR)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def generated() -> str:
    text: str = generator().written()
    return text


def test_the_types_are_those_of_the_schemas() -> None:
    file = Path(gr.__file__).parent / "_keys.py"
    assert file.read_text("utf-8") == generated(), "run crates/grouser-python/generate_keys.py"


def declared(text: str) -> dict[str, dict[str, str]]:
    """Keys with their types by class: properties, and fields of tables."""
    found: dict[str, dict[str, str]] = {}
    for part in re.split(r"(?m)^class ", text)[1:]:
        name = re.match(r"\w+", part)
        assert name is not None
        properties = re.findall(r"(?m)^        def (\w+)\(self\) -> (.+):$", part)
        found[name.group()] = dict(properties + re.findall(r"(?m)^    (\w+): (.+)$", part))
    return found


def test_no_table_is_declared_twice() -> None:
    tables = re.split(r"(?m)^class \w+\(TypedDict, total=False\):\n", generated())[1:]
    bodies = [re.split(r"(?m)^class ", table)[0] for table in tables]
    assert len(bodies) > 10
    assert len(bodies) == len(set(bodies))


def test_a_key_to_which_laws_give_types_has_each_once() -> None:
    number, numbers = {"type": "number"}, {"type": "array", "items": {"type": "number"}}
    either = {"anyOf": [number, numbers]}
    several = {"type": "array", "items": {"anyOf": [number, {"type": "string"}]}}
    laws = [{"type": "object", "properties": {"key": it}} for it in (either, number, several)]
    writer = generator().Writer({}, {})
    assert writer.type_of({"oneOf": laws}, "Law") == "Law"
    assert declared("\n".join(writer.tables["Law"])) == {
        "Law": {"key": "float | tuple[float, ...] | tuple[float | str, ...]"}
    }


@pytest.mark.parametrize("kind", [gr.Soil, gr.Wheel, gr.Rover, gr.Scenario, gr.Mission])
def test_every_key_of_a_preset_is_declared(kind: Any) -> None:
    classes = declared(generated())

    def check(value: Any, type_of_it: str) -> None:
        if isinstance(value, list):
            for item in value:
                check(item, type_of_it)
        if isinstance(value, dict):
            [name] = [word for word in re.findall(r"\w+", type_of_it) if word in classes]
            always = {key for key, of in classes[name].items() if of.startswith("Required[")}
            assert always <= value.keys() <= classes[name].keys(), name
            for key, item in value.items():
                check(item, classes[name][key])

    described = [kind()] if kind is gr.Scenario else [kind(name) for name in kind.presets()]
    assert described
    for one in described:
        for key, value in one.to_dict().items():
            if kind in (gr.Scenario, gr.Mission) and key in ("rover", "soil"):
                continue
            check(value, classes[f"{kind.__name__}Keys"][key])


#: Lines with the type that a checker finds, or a part of the error that it reports.
LINES = {
    'reveal_type(gr.Soil("toyoura").cohesion_kpa)': "float",
    'gr.Soil("toyoura").cohesion_kap': 'has no attribute "cohesion_kap"',
    'gr.Soil("toyoura").pressure_sinkage["k_pi"]': 'has no key "k_pi"',
    'gr.Soil("toyoura").cohesion_kpa = 1.0': "read-only",
    'reveal_type(gr.Rover("hakuto").mount[0]["position_m"])': "tuple[",
    'reveal_type(gr.Scenario().soil)': "Soil",
    'reveal_type(gr.Mission("arc").leg[0]["drive_m"])': "float",
    'gr.Mission("arc").leg[0]["drive_mm"]': 'has no key "drive_mm"',
    'reveal_type(gr.Site("toyoura").slope_deg)': "float",
    'gr.Scenario().slope': 'has no attribute "slope"',
}


def test_a_strict_checker_finds_misspelt_keys(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    script = tmp_path / "script.py"
    script.write_text("import grouser as gr\n" + "\n".join(LINES) + "\n")
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path), str(script)]
    found = subprocess.run(command, capture_output=True, text=True, check=False).stdout
    for number, (line, expected) in enumerate(LINES.items(), start=2):
        here = [one for one in found.splitlines() if f"script.py:{number}:" in one]
        assert any(expected in one for one in here), (line, found)
    assert found.count("error:") == sum("reveal" not in line for line in LINES)
