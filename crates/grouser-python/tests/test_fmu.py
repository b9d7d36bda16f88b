"""FMUs of the program in FMPy: they are valid, and have the bits of `gr.Run`."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Program

import grouser as gr

fmpy = pytest.importorskip("fmpy", reason="FMPy, which loads FMUs, is not installed")
fmi3 = pytest.importorskip("fmpy.fmi3")
validation = pytest.importorskip("fmpy.validation")

#: What it makes of a path: an FMU of these settings of the program.
Export = Callable[..., Path]

COMMAND = "commanded_wheel_speed_rad_s"
#: A map that rises to the east.
HEIGHTS = "".join(f"{x} {y} {0.05 * x}\n" for y in range(0, 10, 2) for x in range(0, 12, 2))

FEATURES: dict[str, tuple[str, ...]] = {
    "none": (),
    "map": ('scenario.terrain.file="map.xyz"',),
    "formula": ('scenario.terrain.surface="incline"', "scenario.terrain.slope_deg=4"),
    "zones": ('scenario.terrain.file="map.xyz"', 'scenario.terrain.soil_file="zones.geojson"'),
    "suspension": ('scenario.rover="hakuto-rockers"',),
    "motors": ('scenario.rover="hakuto-flight"',),
    "steering": ('scenario.rover="hakuto-steered"',),
    "belief": ('scenario.soil="toyoura-uncertain"',),
    "bekker": ('scenario.model="bekker"',),
    "small-wheel": ('scenario.model="small-wheel"',),
    "rft": ('scenario.model="rft"',),
    "quasi-steady": ('scenario.simulation="quasi-steady"',),
    "prescribed yaw": ("scenario.drive.yaw_deg=[[0, 5], [20, 3]]",),
    "six wheels": ('scenario.rover="sojourner"',),
}


@pytest.fixture(scope="module")
def export(program: Program, tmp_path_factory: pytest.TempPathFactory) -> Export:
    """Makes an FMU of a scenario with settings, once."""
    folder = tmp_path_factory.mktemp("fmu")
    (folder / "map.xyz").write_text(HEIGHTS)
    ring = [[-1.0, -1.0], [13.0, -1.0], [13.0, 9.0], [-1.0, 9.0], [-1.0, -1.0]]
    area = {"type": "Polygon", "coordinates": [ring]}
    zone = {"type": "Feature", "properties": {"soil": "lunar-nominal"}, "geometry": area}
    zones = {"type": "FeatureCollection", "features": [zone]}
    (folder / "zones.geojson").write_text(json.dumps(zones))
    (folder / "scenario.toml").write_text('schema = "scenario/1"\nname = "traverse"\n')

    def made(*settings: str, of: str = "scenario.toml", more: tuple[str, ...] = ()) -> Path:
        path = folder / f"{abs(hash((settings, of, more)))}.fmu"
        if not path.exists():
            sets = [word for setting in settings for word in ("--set", setting)]
            command = [*program.command, "export-fmu", of, "--out", str(path), *sets, *more]
            done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
            assert done.returncode == 0, done.stderr
        return path

    return made


class Instance:
    """An instance of an FMU, by the names of its variables."""

    def __init__(self, fmu: Path) -> None:
        self.folder = fmpy.extract(str(fmu))
        self.description = fmpy.read_model_description(str(fmu))
        self.references = {it.name: it.valueReference for it in self.description.modelVariables}
        self.log: list[str] = []
        self.slave = fmi3.FMU3Slave(
            guid=self.description.instantiationToken,
            unzipDirectory=self.folder,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName="rover",
        )
        keep = fmi3.fmi3LogMessageCallback(
            lambda environment, status, category, message: self.log.append(message.decode())
        )
        self.keep = keep
        self.slave.instantiate(loggingOn=True, logMessage=keep)

    def initialize(self, **parameters: float) -> Instance:
        return self.initialize_with(parameters)

    def initialize_with(self, parameters: Mapping[str, float]) -> Instance:
        for name, value in parameters.items():
            self[name] = value
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
        return self

    def __getitem__(self, name: str) -> float:
        return float(self.slave.getFloat64([self.references[name]])[0])

    def __setitem__(self, name: str, value: float) -> None:
        self.slave.setFloat64([self.references[name]], [value])

    def outcome(self) -> int:
        return int(self.slave.getInt64([self.references["outcome"]])[0])

    def step(self, time: float, span: float) -> None:
        self.slave.doStep(currentCommunicationPoint=time, communicationStepSize=span)

    def close(self) -> None:
        self.slave.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)


@pytest.fixture
def instance() -> Iterator[Callable[[Path], Instance]]:
    """Makes instances, and frees them when the test is over."""
    made: list[Instance] = []

    def make(fmu: Path) -> Instance:
        made.append(Instance(fmu))
        return made[-1]

    yield make
    for one in made:
        one.close()


def scenario_of(fmu: Path) -> gr.Scenario:
    """The document in an FMU."""
    folder = fmpy.extract(str(fmu))
    return gr.Scenario(str(Path(folder) / "resources" / "scenario.toml"))


@pytest.mark.parametrize("feature", FEATURES)
def test_fmpy_finds_nothing_wrong(feature: str, export: Export) -> None:
    assert validation.validate_fmu(str(export(*FEATURES[feature]))) == []


@pytest.mark.parametrize("feature", FEATURES)
def test_steps_have_the_bits_of_a_run(
    feature: str, export: Export, instance: Callable[[Path], Instance]
) -> None:
    fmu = export(*FEATURES[feature])
    rover, run = instance(fmu).initialize(), gr.Run(scenario_of(fmu))
    time = 0.0
    for step, span in enumerate((0.1, 0.05, 0.2, 0.013)):
        speeds = [0.5 + 0.03 * step + 0.04 * wheel for wheel in range(len(run.wheel_names))]
        for name, speed in zip(run.wheel_names, speeds, strict=True):
            rover[f"{name}.{COMMAND}"] = speed
        rover.step(time, span)
        run.step(speeds, span)
        time += span
        state = dict(zip(run.STATE, run.state, strict=True))
        assert {name: rover[name] for name in state} == state
        assert rover["energy_j"] == run.energy_j
        for column in ("slip_ratio", "sinkage_mm", "load_n", "torque_nm"):
            found = [rover[f"{name}.{column}"] for name in run.wheel_names]
            np.testing.assert_array_equal(found, run.wheel[column], err_msg=column)


def test_fmpy_simulates_with_inputs_as_a_run_does(export: Export) -> None:
    fmu = export()
    run = gr.Run(scenario_of(fmu))
    names = [f"{name}.{COMMAND}" for name in run.wheel_names]
    form = np.dtype([("time", np.float64), *((name, np.float64) for name in names)])
    inputs = np.array([(0.0, *4 * [0.5]), (1.0, *4 * [0.5])], dtype=form)
    result = fmpy.simulate_fmu(
        str(fmu), stop_time=1.0, step_size=0.1, output_interval=0.1, input=inputs,
        output=["x_m", "y_m", "front-left.slip_ratio"],
    )  # fmt: skip
    for row in result[1:]:
        run.step(0.5, 0.1)
        assert (row["x_m"], row["y_m"]) == tuple(run.state[:2])
        assert row["front-left.slip_ratio"] == run.wheel["slip_ratio"][run.wheel_names.index("front-left")]
    assert len(result) == 11


@pytest.mark.parametrize(
    ("name", "setting"),
    [
        ("soil.cohesion_kpa", "soil.cohesion_kpa=0.5"),
        ("soil.friction_angle_deg", "soil.friction_angle_deg=31.5"),
        ("slope_deg", "scenario.slope_deg=14"),
        ("gravity_m_s2", "scenario.gravity_m_s2=1.62"),
    ],
)
def test_a_parameter_changes_what_set_changes(
    name: str, setting: str, export: Export, instance: Callable[[Path], Instance]
) -> None:
    value = float(setting.split("=")[1])
    one = instance(export()).initialize_with({name: value})
    other, usual = instance(export(setting)).initialize(), instance(export()).initialize()
    for rover in (one, other, usual):
        rover.step(0.0, 1.0)
    assert one["x_m"] == other["x_m"] != usual["x_m"]
    assert one[name] == value


def test_a_state_as_bytes_goes_on_in_another_process_bit_for_bit(
    export: Export, instance: Callable[[Path], Instance]
) -> None:
    rover = instance(export()).initialize()
    rover[f"front-left.{COMMAND}"] = 0.7
    rover.step(0.0, 0.3)
    state = rover.slave.getFMUState()
    content = bytes(rover.slave.serializeFMUState(state))
    rover.step(0.3, 0.4)
    end = [rover[name] for name in ("x_m", "y_m", "yaw_deg", "energy_j")]
    rover.slave.setFMUState(state)
    rover.step(0.3, 0.4)
    assert [rover[name] for name in ("x_m", "y_m", "yaw_deg", "energy_j")] == end
    rover.slave.freeFMUState(state)
    # Another instance is as far as another process: it was made of the file alone.
    other = instance(export())
    other.slave.setFMUState(other.slave.deserializeFMUState(content))
    other.step(0.3, 0.4)
    assert [other[name] for name in ("x_m", "y_m", "yaw_deg", "energy_j")] == end


def test_wrong_uses_are_errors_with_a_sentence(
    export: Export, instance: Callable[[Path], Instance]
) -> None:
    rover = instance(export())

    def refused(act: Callable[[], Any], words: str) -> None:
        with pytest.raises(Exception, match="fmi3"):
            act()
        assert words in rover.log[-1], rover.log

    command = f"front-left.{COMMAND}"
    refused(lambda: rover.step(0.0, 0.1), "before the initialization")
    refused(lambda: rover["x_m"], "before the initialization")
    refused(lambda: rover.__setitem__("soil.cohesion_kpa", -1.0), "from 0 to 100")
    rover.initialize()
    rover.step(0.0, 0.1)
    refused(lambda: rover.__setitem__(command, float("nan")), "finite")
    refused(lambda: rover.__setitem__("soil.cohesion_kpa", 1.0), "after the initialization")
    refused(lambda: rover.slave.getFloat64([99999]), "no variable with the reference 99999")
    refused(lambda: rover.step(0.0, 0.1), "begins at 0 s")
    refused(lambda: rover.step(0.1, -0.1), "from 1e-6 to 86400")
    refused(lambda: rover.slave.getBoolean([1]), "no variables of that type")
    rover.step(0.1, 0.1)


@pytest.mark.parametrize(
    ("document", "more", "words"),
    [
        ("eq18-corrected", (), "drive.law"),
        ("there-and-back", ("--driven-by", "inputs"), "legs"),
        ("crab-or-yaw", (), "alternatives"),
    ],
)
def test_what_cannot_be_an_fmu_is_refused_by_name(
    document: str, more: tuple[str, ...], words: str, program: Program, tmp_path: Path
) -> None:
    out = tmp_path / "rover.fmu"
    command = [*program.command, "export-fmu", document, "--out", str(out), *more]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 2 and words in done.stderr
    assert not out.exists()


@pytest.mark.parametrize(
    ("document", "more"),
    [("eq18-corrected", ("--driven-by", "document")), ("there-and-back", ())],
)
def test_a_document_drives_its_own_fmu(
    document: str, more: tuple[str, ...], program: Program, export: Export,
    instance: Callable[[Path], Instance],
) -> None:  # fmt: skip
    fmu = export(of=document, more=more)
    assert validation.validate_fmu(str(fmu)) == []
    rover = instance(fmu).initialize()
    if document == "there-and-back":
        end = gr.mission(document).trajectory.x_m[10]
    else:
        end = program("traverse", document)["samples"][10]["x_m"]
    for step in range(10):
        rover.step(step / 10, 0.1)
    assert rover["x_m"] == end
