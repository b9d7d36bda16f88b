"""The native half: documents, arrays of wheels, studies."""

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "CampaignFolder",
    "CampaignManifest",
    "ConsoleServer",
    "Document",
    "EARTH_GRAVITY",
    "FAILED_STATUSES",
    "Footprints",
    "Learner",
    "MARS_GRAVITY",
    "MODELS",
    "MOON_GRAVITY",
    "PathTask",
    "REST_SPEED_M_S",
    "SINKAGE_DAMPING_S_M",
    "Simulators",
    "SlipFromCurrent",
    "SteppingWheels",
    "TelemetryMessages",
    "Terrain",
    "__version__",
    "animation",
    "arrow_stream",
    "calibrate_bevameter",
    "calibrate_wheel_tests",
    "campaign_facts",
    "campaign_frequencies",
    "campaign_manifest",
    "campaign_row",
    "campaign_shard",
    "campaign_summary",
    "card",
    "card_rule",
    "check_document",
    "check_shard",
    "check_height_unit",
    "design",
    "drive_mission",
    "find_campaign",
    "find_document",
    "flag_names",
    "flags",
    "forecast",
    "gravity_of",
    "heading",
    "heading_map",
    "heading_map_band",
    "heading_map_sweep",
    "heading_sweep",
    "import_telemetry",
    "import_wheel_tests",
    "meant_keys",
    "merge_campaign",
    "mission_sweep",
    "mobility_map",
    "most_shard_bytes",
    "not_carried",
    "outcomes",
    "panic",
    "path_columns",
    "present_names",
    "presets",
    "read_document_file",
    "read_document_table",
    "read_document_text",
    "result_columns",
    "range_of",
    "replay",
    "rollout",
    "routes",
    "rover_of_urdf",
    "seal_manifest",
    "settle",
    "settle_gradients",
    "simulate",
    "simulate_band",
    "simulated_wheel_test",
    "simulator_columns",
    "spread_labels",
    "study_difference",
    "style_colours",
    "to_toml",
    "unit_of",
    "validate",
    "validate_all",
    "validate_drives",
    "validate_slopes",
    "wheel_forces",
    "wheel_speeds",
    "wheel_speeds_sweep",
    "wheel_test_band",
]

__version__: str
FAILED_STATUSES: list[str]
MODELS: list[str]
EARTH_GRAVITY: float
MOON_GRAVITY: float
MARS_GRAVITY: float
SINKAGE_DAMPING_S_M: float
REST_SPEED_M_S: float

_Floats = NDArray[np.float64]
_SystemKeys = tuple[list[int], list[float], str]
_Reading = tuple[Sequence[float] | None, int | None, float | None]
_Data = str | os.PathLike[str] | tuple[str, str]
_Asked = tuple[
    Sequence[Document],
    NDArray[np.int64] | None,
    Sequence[Document],
    NDArray[np.int64] | None,
    dict[str, _Floats],
    int,
    bool,
    Sequence[tuple[int, str]],
]
_Swept = list[dict[str, Any]]

@final
class Document:
    @property
    def kind(self) -> str: ...
    @property
    def assumptions(self) -> list[str]: ...
    @property
    def assumed(self) -> list[str]: ...
    @property
    def files(self) -> dict[str, str | Terrain]: ...
    def samples(self, count: int, seed: int) -> list[Document]: ...
    def to_toml(self) -> str: ...
    def to_dict(self) -> dict[str, Any]: ...

@final
class ConsoleServer:
    def __new__(
        cls, folder: str | None, port: int, hosts: Sequence[str], has_page: bool
    ) -> ConsoleServer: ...
    @property
    def page(self) -> Path | None: ...
    @property
    def address(self) -> str: ...
    @property
    def port(self) -> int: ...
    @property
    def is_serving(self) -> bool: ...
    def stop(self) -> None: ...

@final
class Terrain:
    def __new__(
        cls,
        heights: _Floats,
        south_west_m: Sequence[float],
        spacing_m: Sequence[float],
        north_first: bool,
        crs: str | None,
    ) -> Terrain: ...
    @staticmethod
    def from_file(path: str | os.PathLike[str], reading: _Reading) -> Terrain: ...
    @staticmethod
    def lunar(
        size_m: float,
        cell_size_m: float,
        ground: str,
        crater_share: float,
        largest_crater_m: float,
        seed: int,
    ) -> Terrain: ...
    @staticmethod
    def of_parts(
        name: str,
        reading: _Reading | None,
        base: float,
        south_west_m: Sequence[float],
        spacing_m: Sequence[float],
        heights: NDArray[np.float32],
        system: _SystemKeys | None,
    ) -> Terrain: ...
    def parts(
        self,
    ) -> tuple[
        str,
        _Reading | None,
        float,
        list[float],
        list[float],
        NDArray[np.float32],
        _SystemKeys | None,
    ]: ...
    @property
    def crs(self) -> str | None: ...
    @property
    def extent(self) -> list[float]: ...
    @property
    def shape(self) -> tuple[int, int]: ...
    @property
    def spacing(self) -> list[float]: ...
    @property
    def missing(self) -> int: ...
    def heights(self, x: _Floats, y: _Floats) -> _Floats: ...
    def slopes(self, x: _Floats, y: _Floats) -> _Floats: ...
    def normals(self, x: _Floats, y: _Floats) -> _Floats: ...
    def ground(self, x: _Floats, y: _Floats) -> _Floats: ...
    def __eq__(self, value: object, /) -> bool: ...

@final
class Footprints:
    def __new__(cls, shearing_radius_m: _Floats, width_m: _Floats) -> Footprints: ...
    def points(
        self,
        origin: Sequence[float] | _Floats,
        axes: Sequence[float] | _Floats,
        hubs: _Floats,
        axles: _Floats,
    ) -> tuple[_Floats, _Floats]: ...
    def planes(
        self,
        origin: Sequence[float] | _Floats,
        axes: Sequence[float] | _Floats,
        hubs: _Floats,
        axles: _Floats,
        heights: _Floats,
    ) -> tuple[_Floats, _Floats]: ...
    def planes_on_field(
        self,
        origin: Sequence[float] | _Floats,
        axes: Sequence[float] | _Floats,
        hubs: _Floats,
        axles: _Floats,
        field: NDArray[np.float32],
        half_size: tuple[float, float],
        unit: float,
    ) -> tuple[_Floats, _Floats]: ...

@final
class SteppingWheels:
    def __new__(
        cls,
        soils: Sequence[Document],
        wheels: Sequence[Document],
        setting: Document,
        sinkage_damping_s_m: float,
        rest_speed_m_s: float,
    ) -> SteppingWheels: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def shearing_radius_m(self) -> _Floats: ...
    def apply(
        self,
        duration_s: float,
        poses: Sequence[_Floats],
        distances: _Floats,
        jacobians: _Floats,
        inertia: _Floats,
        velocities: _Floats,
        held: _Floats,
        with_moments: bool,
        gravity_m_s2: float,
    ) -> tuple[_Floats, _Floats, float]: ...

@final
class SlipFromCurrent:
    def __new__(
        cls,
        scenario: Document,
        noise: Sequence[float],
        slips: Sequence[float],
        samples: int,
        seed: int,
    ) -> SlipFromCurrent: ...
    @property
    def wheel_names(self) -> list[str]: ...
    def estimate(
        self, of_wheels: Sequence[_Floats], of_records: Sequence[_Floats]
    ) -> dict[str, Any]: ...

@final
class TelemetryMessages:
    def __new__(
        cls,
        label: str,
        out: str | os.PathLike[str],
        rover: Document,
        mapping: str | os.PathLike[str] | None,
        topics: Sequence[tuple[str, str]],
        choices: Sequence[tuple[str, str]],
        odometry: str | None,
    ) -> TelemetryMessages: ...
    def wants(self, topic: str) -> bool: ...
    def add(self, topic: str, time_ns: int, message: str) -> None: ...
    def damaged(self) -> None: ...
    def finish(self) -> tuple[int, list[str], str]: ...

_Taught = tuple[dict[str, Any], dict[str, Any]]

@final
class Learner:
    def __new__(cls, scenario: Document, slope_is_known: bool) -> Learner: ...
    @staticmethod
    def from_state(
        text: str, scenario: Document | None = None, slope_is_known: bool | None = None
    ) -> Learner: ...
    def state(self) -> str: ...
    def scenario(self) -> Document: ...
    @property
    def wheel_names(self) -> list[str]: ...
    def update(
        self, names: Sequence[str], values: Sequence[_Floats], odometry: str | None
    ) -> _Taught: ...
    def update_log(
        self, logs: Sequence[str], odometry: str | None, max_unpacked_mib: int | None
    ) -> _Taught: ...
    def files(self) -> str: ...
    def finished(self) -> Learner: ...
    def taught(self) -> _Taught: ...
    def predict(self, slope_deg: _Floats, samples: int, seed: int) -> dict[str, Any]: ...
    def samples(self, samples: int, seed: int, is_before: bool) -> tuple[list[str], _Floats]: ...
    def narrowed(self, samples: int, seed: int) -> dict[str, float]: ...
    def models(self) -> dict[str, float]: ...
    def learnt(self) -> dict[str, Any]: ...
    def notes(self) -> list[str]: ...
    def soil(self, log: str, samples: int, seed: int) -> Document: ...
    def scenario_now(self, log: str, samples: int, seed: int) -> Document: ...

_Stop = dict[str, Any]

@final
class PathTask:
    @staticmethod
    def through(places: _Floats, within_m: float, stop: _Stop) -> PathTask: ...
    @staticmethod
    def arc(
        radius_m: float, heading_deg: float, angle_deg: float, within_m: float, stop: _Stop
    ) -> PathTask: ...
    @staticmethod
    def of_content(bytes: bytes) -> PathTask: ...
    @property
    def content(self) -> bytes: ...
    def __reduce__(self) -> tuple[Any, tuple[bytes]]: ...
    @property
    def length_m(self) -> float: ...
    @property
    def limits(self) -> list[tuple[str, float]]: ...
    def at(self, along_m: _Floats) -> _Floats: ...

@final
class Simulators:
    def __new__(
        cls, scenarios: Sequence[Document], path: PathTask | None = None
    ) -> Simulators: ...
    def __len__(self) -> int: ...
    def copy(self) -> Simulators: ...
    def __deepcopy__(self, _memo: Any) -> Simulators: ...
    def states(self) -> list[bytes]: ...
    def restore(self, places: Sequence[int], states: Sequence[bytes]) -> None: ...
    def linear_step(
        self, commands: _Floats, are_rim_speeds: bool, dt_s: float
    ) -> tuple[_Floats, _Floats, _Floats, NDArray[np.bool_], list[str]]: ...
    def state_numbers(self) -> tuple[_Floats, list[str]]: ...
    def precise_steps(
        self, points: _Floats, are_rim_speeds: bool, dt_s: float, has_slopes: bool
    ) -> _Floats: ...
    @property
    def wheel_names(self) -> list[str]: ...
    def reset(
        self,
        places: Sequence[int],
        seeds: Sequence[int | None],
        slope_deg: Sequence[float | None],
        yaw_deg: Sequence[float | None],
    ) -> None: ...
    def step(
        self, commands: _Floats, are_rim_speeds: bool, dt_s: float, active: NDArray[np.bool_]
    ) -> None: ...
    def samples(self) -> _Floats: ...
    def wheel_samples(self) -> _Floats: ...
    def statuses(self) -> list[tuple[str | None, str | None, str]]: ...
    def path_samples(self, ways: Sequence[float]) -> _Floats: ...
    def path_outcomes(
        self,
    ) -> list[tuple[str | None, str | None, float | None, str | None]]: ...

def path_columns() -> list[str]: ...
def simulator_columns() -> tuple[list[str], list[str]]: ...
def unit_of(name: str) -> str | None: ...
def result_columns() -> dict[str, list[tuple[str, str | None, str]]]: ...
def arrow_stream(
    columns: Sequence[tuple[str, str | None, Any]], notes: dict[str, str]
) -> object: ...
def check_height_unit(unit: str) -> None: ...
def find_document(kind: str, name: str, changes: dict[str, Any]) -> Document: ...
def read_document_file(
    kind: str, path: str | os.PathLike[str], changes: dict[str, Any]
) -> Document: ...
def read_document_text(
    kind: str, label: str, text: str, changes: dict[str, Any], files: dict[str, str | Terrain]
) -> Document: ...
def read_document_table(
    kind: str, label: str, table: dict[str, Any], changes: dict[str, Any], files: dict[str, str | Terrain]
) -> Document: ...
def check_document(
    name: str | os.PathLike[str], text: str | None
) -> tuple[str, list[tuple[str, float | None, str]], list[str]]: ...
def import_wheel_tests(
    file: str | os.PathLike[str],
    columns: Sequence[str],
    delimiter: str,
    decimal_comma: bool,
    skip_lines: int,
    slip_definition: str,
) -> tuple[str, list[str], list[str]]: ...
def import_telemetry(
    logs: Sequence[str],
    out: str | os.PathLike[str],
    rover: Document,
    mapping: str | os.PathLike[str] | None,
    choices: Sequence[tuple[str, str]],
    how: tuple[str | None, int | None],
) -> tuple[int, list[str], str]: ...
def meant_keys(kind: str, name: str) -> list[str]: ...
def present_names(name: str) -> list[str]: ...
def presets(kind: str) -> list[tuple[str, str, str]]: ...
def rover_of_urdf(
    path: str | os.PathLike[str],
    named: tuple[list[str], list[str]],
    sizes: tuple[float | None, float | None],
    forward: str,
    has: tuple[bool, bool],
) -> Document: ...
def to_toml(label: str, table: dict[str, Any]) -> str: ...
def settle(
    soils: Sequence[Document],
    wheels: Sequence[Document],
    setting: Document,
    load_n: _Floats,
    slip_ratio: _Floats,
    slip_angle_deg: _Floats,
    soil_index: NDArray[np.int64] | None,
    wheel_index: NDArray[np.int64] | None,
    vary: dict[str, Any],
    outside_is_nan: bool,
) -> tuple[_Floats, list[str]]: ...
def settle_gradients(
    soils: Sequence[Document],
    wheel: Document,
    setting: Document,
    load_n: _Floats,
    slip_ratio: _Floats,
    slip_angle_deg: _Floats,
    soil_index: NDArray[np.int64] | None,
    vary: dict[str, Any],
    keys: Sequence[str],
    outside_is_nan: bool,
) -> tuple[_Floats, NDArray[np.bool_], list[str], list[str]]: ...
def wheel_forces(
    soils: Sequence[Document],
    wheels: Sequence[Document],
    setting: Document,
    sinkage_mm: _Floats,
    slip_ratio: _Floats,
    slip_angle_deg: _Floats,
    soil_index: NDArray[np.int64] | None,
    wheel_index: NDArray[np.int64] | None,
    vary: dict[str, Any],
    outside_is_nan: bool,
) -> tuple[_Floats, list[str]]: ...
def flag_names(bits: _Floats) -> NDArray[np.object_]: ...
def flags() -> list[tuple[str, str]]: ...
def outcomes() -> list[tuple[str, str, str, str, bool]]: ...
def panic(is_listening: bool) -> None: ...
def range_of(document: Document, key: str) -> tuple[float, float]: ...
def not_carried(load_n: _Floats, capacity_n: _Floats) -> list[str]: ...
def animation(
    sources: Sequence[tuple[Document, str]], names: Sequence[str], path: os.PathLike[str]
) -> bytes: ...
def spread_labels(
    wanted: Sequence[float], heights: Sequence[float], room: tuple[float, float]
) -> list[float]: ...
def style_colours(dark: bool) -> dict[str, list[str]]: ...
def simulate(scenario: Document, gradients: Sequence[str] | None = None) -> dict[str, Any]: ...
def design(
    design: Document, is_nominal: bool, seed: int, trade: tuple[str, str] | None
) -> tuple[dict[str, Any], dict[str, dict[str, Any]], str]: ...
def drive_mission(
    mission: Document, sampling: tuple[int, int] | None
) -> list[dict[str, Any]]: ...
def rollout(
    asked: _Asked, keep: bool, gradients: Sequence[str] | None
) -> dict[str, Any]: ...
def card(
    scenario: Document,
    slope_deg: _Floats,
    seed_and_samples: tuple[int, int],
    rim_speed_m_s: float | None,
    is_uphill_right_holds_heading_accepts_contradiction: tuple[bool, bool, bool],
    rule: Sequence[float],
) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any]]: ...
def card_rule() -> dict[str, float]: ...
def gravity_of(text: str) -> float | None: ...
def forecast(
    scenario: Document,
    slope_deg: _Floats,
    measured_gravity_m_s2: float | None,
    choices: tuple[Sequence[tuple[str, Document | None]] | None, Sequence[str], Sequence[str]],
    rim_speed_m_s: float | None,
    no_go_slip_ratio: float,
    counts: Sequence[int],
    seed: int,
) -> dict[str, Any]: ...
def heading(
    scenario: Document,
    slope_deg: _Floats,
    steering: str,
    sampling: tuple[int, int] | None,
    rule: Sequence[float],
    gradients: Sequence[str] | None,
) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any] | None]: ...
def heading_sweep(asked: _Asked, slope_deg: _Floats, steering: str) -> _Swept: ...
def heading_map_sweep(
    asked: _Asked, slope_deg: _Floats, course_deg: _Floats, rim_speed_m_s: float
) -> _Swept: ...
def wheel_speeds_sweep(
    asked: _Asked, slope_deg: _Floats, most_speed_ratio: float
) -> _Swept: ...
def mission_sweep(asked: _Asked, ways: int, legs: int) -> _Swept: ...
def simulated_wheel_test(
    soil: Document,
    wheel: Document,
    setting: Document,
    load_n: _Floats,
    slip_angle_deg: _Floats,
    slip_ratio: _Floats,
    trials: int,
    noise: Sequence[float],
    seed: int,
) -> dict[str, Any]: ...
def mobility_map(
    scenario: Document,
    terrain: Terrain,
    course: float | str,
    rim_speed_m_s: float | None,
    samples: int,
    seed: int,
) -> tuple[list[tuple[str, str, str, Any]], _Floats, _Floats, dict[str, Any]]: ...
def replay(
    scenario: Document,
    paths: Sequence[str],
    text: str | None,
    drive: tuple[bool, float | None, float | None],
    sampling: tuple[int, int],
    how: tuple[str | None, int | None] = ...,
) -> tuple[
    tuple[dict[str, Any], dict[str, Any], dict[str, Any]], list[str], list[str], list[str], str
]: ...
def routes(
    scenario: Document, terrain: Terrain, task: dict[str, Any]
) -> list[dict[str, Any]]: ...
def heading_map(
    scenarios: Sequence[Document], slope_deg: _Floats, course_deg: _Floats, rim_speed_m_s: float
) -> dict[str, Any]: ...
def heading_map_band(
    scenarios: Sequence[Document],
    slope_deg: _Floats,
    course_deg: _Floats,
    seed: int,
    samples: int,
) -> tuple[dict[str, Any], list[dict[str, float]]]: ...
def wheel_speeds(
    scenario: Document, slope_deg: _Floats, most_speed_ratio: float
) -> tuple[dict[str, Any], dict[str, Any], list[str]]: ...
def wheel_test_band(
    soil: Document,
    wheel: Document,
    setting: Document,
    load_n: _Floats,
    slip_angle_deg: _Floats,
    slip_ratio: _Floats,
    seed: int,
    samples: int,
) -> dict[str, Any]: ...
def simulate_band(
    scenario: Document, seed: int, samples: int
) -> tuple[dict[str, Any], dict[str, Any]]: ...
def validate(
    data: _Data,
    soil: Document,
    wheel: Document,
    setting: Document,
    wheel_label: str | None,
    conditions: Sequence[str],
) -> dict[str, Any]: ...
def validate_slopes(
    data: _Data, scenario: Document, conditions: Sequence[str]
) -> dict[str, Any]: ...
def validate_all(folder: str | os.PathLike[str] | None) -> dict[str, Any]: ...
def validate_drives(
    folder: str | os.PathLike[str],
    scenario: Document,
    mapping: str | os.PathLike[str] | None,
    choices: Sequence[tuple[str, str]],
    how: tuple[str | None, int | None],
) -> tuple[dict[str, Any], dict[str, dict[str, Any]], str]: ...
def calibrate_wheel_tests(
    data: _Data,
    soil: Document,
    wheel: Document,
    setting: Document,
    wheel_label: str | None,
    conditions: Sequence[str],
    keys: Sequence[tuple[str, tuple[float, float] | None]],
    aim: tuple[str, int, Sequence[float] | None, Sequence[float], Sequence[float]],
    seed: int,
    steps: int | None,
    cross_validate: bool,
) -> dict[str, Any]: ...
def calibrate_bevameter(
    plates: _Data | None,
    shear: _Data | None,
    soil: Document,
    setting: Document,
    law: str | None,
    seed: int,
    steps: int | None,
) -> dict[str, Any]: ...

_Part = tuple[int, int] | None

@final
class CampaignFolder:
    def __new__(
        cls, path: str | os.PathLike[str], campaign: Document, part: _Part
    ) -> CampaignFolder: ...
    def missing(self) -> list[tuple[int, int, int]]: ...
    def missing_count(self) -> int: ...
    def faults(self) -> list[tuple[int, str]]: ...
    def runs(self) -> tuple[int, int]: ...
    def accept(self, shard: int, data: bytes) -> None: ...
    def adopt(self, shard: int) -> None: ...
    def pause(self) -> None: ...
    def finish(self) -> tuple[str, int, int]: ...
    def close(self) -> None: ...

@final
class CampaignManifest:
    def __new__(cls, data: bytes, file: str | os.PathLike[str]) -> CampaignManifest: ...
    def check_study(self, study: bytes, file: str | os.PathLike[str]) -> None: ...
    def check_campaign(self, campaign: Document, file: str | os.PathLike[str]) -> None: ...
    def shard_of(self, name: str) -> int | None: ...
    def shards(self) -> int: ...
    def runs_of(self, shard: int) -> tuple[int, int]: ...
    def most_bytes(self, shard: int) -> int: ...
    def read(
        self, shard: int, data: bytes, columns: Sequence[str], file: str | os.PathLike[str]
    ) -> dict[str, Any]: ...

def find_campaign(study: str, settings: Sequence[str]) -> Document: ...
def campaign_facts(campaign: Document) -> dict[str, Any]: ...
def campaign_shard(campaign: Document, shard: int, threads: int) -> bytes: ...
def campaign_row(campaign: Document, run: int) -> dict[str, Any]: ...
def campaign_manifest(campaign: Document, part: _Part) -> str: ...
def check_shard(campaign: Document, shard: int, data: bytes) -> None: ...
def study_difference(theirs: str, ours: str) -> str: ...
def most_shard_bytes(campaign: Document, shard: int) -> int: ...
def seal_manifest(manifest: str) -> str: ...
def merge_campaign(
    target: str | os.PathLike[str],
    campaign: Document,
    folders: Sequence[str | os.PathLike[str]],
) -> tuple[str, int, int]: ...
def campaign_frequencies(
    campaign: Document,
    runs: Sequence[tuple[int, int]],
    statuses: Sequence[str | None],
    outcomes: Sequence[str | None],
    of_legs: Sequence[tuple[str, Sequence[str | None]]],
) -> dict[str, Any]: ...
def campaign_summary(
    campaign: Document,
    runs: Sequence[tuple[int, int]],
    columns: Sequence[tuple[str, _Floats]],
    statuses: Sequence[str | None],
    shares: Sequence[float],
) -> list[dict[str, Any]]: ...
