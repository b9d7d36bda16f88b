"""Every public call meets every feature: it computes finite numbers of its shape, or it refuses and
names the feature."""

from __future__ import annotations

import copy
import dataclasses
import importlib.util
import inspect
import json
import tempfile
import warnings
from collections.abc import Callable, Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import grouser as gr

gym = pytest.importorskip("grouser.gym")
jax = pytest.importorskip("grouser.jax")
mujoco = pytest.importorskip("grouser.mujoco")
#: Not everyone who runs the tests has PyTorch.
TORCH = (
    {"torch.": importlib.import_module("grouser.torch")}
    if importlib.util.find_spec("torch")
    else {}
)

#: Numbers of an answer, each with the shape that they must have.
Numbers = list[tuple[Any, tuple[int, ...]]]

DATA = Path(__file__).resolve().parents[2] / "grouser" / "data" / "experiments"
TESTS = DATA / "simulated-wheel-test" / "toyoura-20n.csv"
FOLDER = tempfile.TemporaryDirectory()
MOTOR = {
    "resistance_ohm": 10.0,
    "torque_constant_nm_a": 0.01,
    "gear_ratio": 250.0,
    "gear_efficiency": 0.6,
}
#: Ground that rises by 0.05 to the east, 8 m wide.
MAP = gr.Terrain(0.1 * np.arange(5.0) * np.ones((5, 1)), cell_size_m=2.0)
SLOPES = [4.0]
MASSES = {"rover.body.mass_kg": [4.0, 5.0]}
#: The smallest forecast.
ONE_CHOICE: dict[str, Any] = {
    **{"ground": "as-measured", "scaling": "bekker", "mass": "equal-mass"},
    **{"samples": 2, "discrepancies": 2},
}


def zones() -> str:
    """A file whose one zone is where the rovers start."""
    ring = [[-5.0, -5.0], [5.0, -5.0], [5.0, 5.0], [-5.0, 5.0], [-5.0, -5.0]]
    area = {"type": "Polygon", "coordinates": [ring]}
    feature = {"type": "Feature", "properties": {"soil": "crust"}, "geometry": area}
    path = Path(FOLDER.name) / "zones.geojson"
    path.write_text(json.dumps({"type": "FeatureCollection", "features": [feature]}))
    return str(path)


def incline(**more: Any) -> dict[str, Any]:
    return {"terrain": {"surface": "incline", "slope_deg": 4.0, **more}}


#: The keys of a scenario that make each feature, and words of which a refusal has one.
FEATURES: dict[str, tuple[dict[str, Any], tuple[str, ...]]] = {
    "none": ({}, ()),
    "map": ({"terrain": MAP}, ("terrain", "map")),
    "formula": (incline(), ("terrain",)),
    "zones": (
        incline(soil_file=zones(), zone=[{"name": "crust", "soil": "lunar-nominal"}]),
        ("terrain", "zone"),
    ),
    "suspension": ({"rover": "hakuto-rockers"}, ("suspension", "rocker")),
    "motors": ({"rover": gr.Rover("hakuto", motor=MOTOR)}, ("motor",)),
    "steering": ({"rover": "hakuto-steered"}, ("steer",)),
    "belief": ({"soil": "toyoura-uncertain"}, ("uncertain",)),
    "bekker": ({"model": "bekker"}, ("bekker", "model")),
    "small-wheel": ({"model": "small-wheel"}, ("small-wheel", "model")),
    "rft": ({"model": "rft"}, ("rft", "model")),
    "quasi-steady": ({"simulation": "quasi-steady"}, ("quasi-steady",)),
    "moon": ({"gravity_m_s2": gr.MOON_GRAVITY}, ("gravity",)),
    "prescribed yaw": (
        {"drive": {"yaw_deg": [[0.0, 5.0], [20.0, 3.0]]}},
        ("drive.yaw_deg", "drive"),
    ),
    "eq18": ({"drive": {"law": "eq18"}}, ("eq18", "drive")),
    "ruts": ({"ruts": "compacted"}, ("ruts",)),
    "by wheel": ({"by_wheel": {"speed_factor": [1.0, 1.0, 1.0, 1.1]}}, ("by_wheel",)),
    "scatter": ({"scatter": {"seed": 1, "speed_std": 0.02}}, ("scatter",)),
}


@lru_cache(maxsize=None)
def scenario(feature: str) -> gr.Scenario:
    keys = FEATURES[feature][0]
    plane: dict[str, Any] = {} if "terrain" in keys else {"slope_deg": SLOPES[0]}
    return gr.Scenario(duration_s=0.5, **plane, **keys)


def wheel_of(run: gr.Scenario) -> tuple[gr.Soil, gr.Wheel, dict[str, Any]]:
    """Soil, wheel, and what else a call of one wheel takes of a scenario."""
    own = {name: run.to_dict()[name] for name in ("model",) if name in run.to_dict()}
    return run.soil, run.rover.wheel, own


def mission_of(run: gr.Scenario) -> gr.Mission:
    """Half a metre with what a mission takes of a scenario."""
    shared = (
        "rover",
        "soil",
        "model",
        "simulation",
        "gravity_m_s2",
        "by_wheel",
        "scatter",
        "ruts",
        "terrain",
    )
    keys = {name: value for name, value in run.to_dict().items() if name in shared}
    if "terrain" in keys and "file" in keys["terrain"]:
        keys["terrain"] = MAP
    return gr.Mission(keys, leg=[{"drive_m": 0.2}])


def design_of(run: gr.Scenario) -> gr.Design:
    """A radius to be found with what a design takes of a scenario."""
    shared = ("rover", "soil", "model", "gravity_m_s2")
    keys = {name: value for name, value in run.to_dict().items() if name in shared}
    radius = {"rover.wheel_unit.wheel.radius_m": [0.095, 0.105]}
    return gr.Design(keys, slope_deg=SLOPES[0], minimise="energy_j_per_m", free=radius)


def same(one: Any, other: Any) -> Numbers:
    assert one == other
    return []


def of_run(run: gr.Trajectory) -> Numbers:
    count, wheels = len(run.time_s), len(run.wheel_names)
    rover = np.stack([run.x_m, run.y_m, run.yaw_deg, run.energy_j])
    return [(rover, (4, count)), (run.wheel["sinkage_mm"], (count, wheels))]


def of_slopes(found: Any) -> Numbers:
    return [(found[name], found["x_m"].shape) for name in ("x_m", "y_m", "energy_j")]


def of_ends(ends: gr.Rollout, shape: tuple[int, ...]) -> Numbers:
    assert "failed" not in ends.outcome
    return [(ends.x_m, shape), (ends.energy_j, shape)]


def of_columns(data: Any, *names: str) -> Numbers:
    """Columns of a mapping or object, over the slopes."""
    get = data.__getitem__ if isinstance(data, Mapping) else lambda name: getattr(data, name)
    return [(get(name), (len(SLOPES),)) for name in names]


def stepped(run: gr.Scenario) -> Numbers:
    rover = gr.Run(run, commands="rim_speed_m_s")
    return [(rover.step(0.05, 0.5), (6,)), (copy.copy(rover).step(0.05, 0.5), (6,))]


def restored(run: gr.Scenario) -> Numbers:
    rover, other = (gr.Run(run, commands="rim_speed_m_s") for _ in range(2))
    rover.step(0.05, 0.5)
    return [(other.restore(rover.save()), (6,))]


def linearised(run: gr.Scenario) -> Numbers:
    rover = gr.Run(run, commands="rim_speed_m_s")
    rover.step(0.05, 0.5)
    linear = rover.linearise(0.05, 0.5)
    count, wheels = len(linear.states), len(rover.wheel_names)
    return [(linear.A, (count, count)), (linear.B, (count, wheels))]


def one_step(run: gr.Scenario, module: Any) -> Numbers:
    rover = gr.Run(run, commands="rim_speed_m_s")
    rover.step(0.05, 0.5)
    found = np.asarray(module.step(rover, 0.05, 0.5))
    return [(found, (6 if len(found) == 6 else 6 + 2 * len(rover.wheel_names),))]


def campaign(run: gr.Scenario, study: str) -> gr.Campaign:
    spread = {
        "key": "soil.friction_angle_deg",
        "distribution": "uniform",
        "low": 36.0,
        "high": 38.0,
    }
    return gr.Campaign(study=study, runs=2, scenario=run, parameter=[spread])


def of_campaign(run: gr.Scenario, study: str) -> Numbers:
    row = campaign(run, study).rerun(0)
    assert row["status"] == "ok", row["reason"]
    names = ("x_m", "energy_j") if study == "traverse" else ("yaw_deg", "slip_ratio")
    return [(row[name], ()) for name in names]


def run_campaign(run: gr.Scenario) -> Numbers:
    with tempfile.TemporaryDirectory() as folder:
        found = gr.campaign.run(campaign(run, "traverse"), out=folder)
        return [(found.summarise().quantities["x_m"].mean, ())]


def drive(run: gr.Scenario, rovers: Any) -> dict[str, Any]:
    """Telemetry of half a minute along a contour."""
    names = [mount["name"] for mount in rovers.mount]
    times = 0.5 * np.arange(40)
    still = {"time_s": times, "roll_deg": np.full(40, 4.0), "pitch_deg": np.full(40, 0.2)}
    rims = {f"wheel_speed_rad_s_{name}": np.full(40, 0.55) for name in names}
    return {**still, "vo_dx_m": np.full(40, 0.025), **rims}


def learnt(run: gr.Scenario) -> Numbers:
    learner = gr.learn(drive(run, run.rover), run, prior="toyoura-uncertain")
    return of_columns(learner.predict(SLOPES, samples=4), "yaw_deg_p2_5", "yaw_deg_p97_5")


def streamed(run: gr.Scenario) -> Numbers:
    learner = gr.Learner(run, prior="toyoura-uncertain")
    columns = drive(run, run.rover)
    records = ({name: float(it[k]) for name, it in columns.items()} for k in range(40))
    count = len(list(learner.stream(records)))
    return [(learner.learnt["stretches"] / count, ())]


def replayed(run: gr.Scenario) -> Numbers:
    found = gr.replay(drive(run, run.rover), run)
    return [(found.forward_speed_m_s.values, (found.sizes["time_s"],))]


def judged(run: gr.Scenario) -> Numbers:
    folder = Path(FOLDER.name) / f"drives-{len(run.rover.mount)}"
    folder.mkdir(exist_ok=True)
    true = gr.simulate(
        rover=run.rover, slope_deg=6.0, duration_s=40.0, model="ishigami", simulation="quasi-steady"
    )
    log = {"time_s": true.time_s, "x_m": true.x_m, "y_m": true.y_m, "yaw_deg": true.yaw_deg}
    log["roll_deg"] = 6.0 + 0.0 * true.time_s
    for wheel, name in enumerate(true.wheel_names):
        log[f"wheel_speed_rad_s_{name}"] = true.wheel["wheel_speed_rad_s"][:, wheel]
    rows = [",".join(log), *(",".join(map(str, row)) for row in zip(*log.values()))]
    (folder / "drive.csv").write_text("\n".join(rows) + "\n")
    found = gr.validate_drives(folder, run.soil, run.rover)
    return [(found.cells["slip_ratio"], (len(found.cells["model"]),))]


def slip_read(run: gr.Scenario) -> Numbers:
    names = gr.SlipEstimator(run).wheel_names
    found = gr.SlipEstimator(run).estimate(np.full(len(names), 0.03), np.full(len(names), 0.55))
    return [(found["load_n"], (len(names),))]


def checked(run: gr.Scenario) -> Numbers:
    path = Path(FOLDER.name) / "scenario.toml"
    path.write_text(run.to_toml())
    return same(gr.check(path).kind, "scenario")


def fitted(run: gr.Scenario) -> Numbers:
    soil, wheel, own = wheel_of(run)
    found = gr.calibrate(
        TESTS,
        soil,
        wheel,
        fit="shear.longitudinal_m",
        point_fit=True,
        where="slip_angle_deg=0",
        **own,
    )
    return of_fit(found)


def of_fit(found: gr.Calibration) -> Numbers:
    return [(found.fit, (len(found.key),))]


def validated(run: gr.Scenario) -> Numbers:
    soil, wheel, own = wheel_of(run)
    found = gr.validate(TESTS, soil, wheel, where="slip_angle_deg=0", **own)
    return [(found.to_pandas().select_dtypes("number").notna().to_numpy().any(), ())]


def of_env(env: Any, count: int | None = None) -> Numbers:
    action = np.array([0.6, 0.0]) if count is None else np.tile([0.6, 0.0], (count, 1))
    env.reset(seed=1)
    observation, reward, *_ = env.step(action)
    assert np.abs(reward).max() < 10.0
    shape = env.observation_space.shape
    return [(observation, shape), (reward, shape[:-1] if count else ())]


class Climb(gym.RoverEnv):  # type: ignore[misc, name-defined]
    def reward(self, before: Mapping[str, float], ended: bool) -> float:
        return float(self.state["y_m"] - before["y_m"])


def contact(run: gr.Scenario) -> Numbers:
    import mujoco as engine

    keys = run.to_dict()
    xml = mujoco.rover_xml(run.rover, slope_deg=4.0, gravity_m_s2=keys["gravity_m_s2"])
    model = engine.MjModel.from_xml_string(xml)
    data = engine.MjData(model)
    wheels = {mount["name"]: mount.get("wheel", run.rover.wheel) for mount in run.rover.mount}
    soil, _, own = wheel_of(run)
    ground: Any = MAP if "file" in keys.get("terrain", {}) else "ground"
    mujoco.SoilContact(model, soil=soil, wheels=wheels, ground=ground, **own).step(data, 5)
    return [(data.qpos, (model.nq,))]


def one_wheel(run: gr.Scenario, call: Callable[..., Any], **motion: Any) -> Numbers:
    soil, wheel, own = wheel_of(run)
    found = call(soil, wheel, slip_ratio=[0.1, 0.3], **motion, **own)
    pull = found["drawbar_pull_n"] if isinstance(found, dict) else found.drawbar_pull_n
    return [(np.asarray(pull), (2,))]


def on_stand(run: gr.Scenario) -> Numbers:
    soil, wheel, own = wheel_of(run)
    found = gr.wheel_test(soil, wheel, load_n=17.0, slip_ratio=[0.1, 0.3], **own)
    return [(found.wheels.drawbar_pull_n, np.shape(found.wheels.sinkage_mm))]


def stands(run: gr.Scenario) -> Numbers:
    soil, wheel, own = wheel_of(run)
    found = gr.wheel_test(
        soil, wheel, load_n=17.0, slip_ratio=[0.1, 0.3], vary={"wheel.width_m": [0.05, 0.06]}, **own
    )
    return [(found.drawbar_pull_n, (2, 1, 1, 2))]


def of_sweep(found: gr.Sweep, rows: int = 1) -> Numbers:
    assert set(found.status.ravel()) == {"ok"}
    return [(found.yaw_deg.reshape(2, rows), (2, rows))]


def mapped(run: gr.Scenario) -> Numbers:
    found = gr.map(MAP, run, samples=2)
    return [(np.nan_to_num(found.slope_deg.values), MAP.shape)]


def routed(run: gr.Scenario) -> Numbers:
    found = gr.route(MAP, run, from_m=(2.0, 4.0), to_m=(6.0, 4.0), samples=2)
    return [(found.energy_j.values, (found.sizes["waypoint"],))]


#: What each public call answers, by its name; in brackets what is asked of it. The second entry has
#: words that its own refusals have, whatever the feature.
CALLS: dict[str, tuple[Callable[[gr.Scenario], Numbers], tuple[str, ...]]] = {
    name: it if isinstance(it, tuple) else (it, ())
    for name, it in {
        "Scenario": lambda s: same(gr.Scenario.from_toml(s.to_toml(), s.files), s),
        "Soil": lambda s: same(gr.Soil.from_toml(s.soil.to_toml(), s.soil.files), s.soil),
        "Wheel": lambda s: same(gr.Wheel(s.rover.wheel.to_dict()), s.rover.wheel),
        "Rover": lambda s: same(gr.Rover.from_toml(s.rover.to_toml()), s.rover),
        "Site": lambda s: same(s.site.soil, s.soil),
        "Mission": lambda s: same(mission_of(s).rover, s.rover),
        "Design": lambda s: same(design_of(s).rover, s.rover),
        "Terrain": lambda s: [(MAP.height_m([1.0, 2.0], 3.0), (2,))],
        "Run.reset[slope_deg]": lambda s: [(gr.Run(s).reset(slope_deg=8.0), (6,))],
        "Run.reset[yaw_deg]": lambda s: [(gr.Run(s).reset(yaw_deg=8.0, seed=1), (6,))],
        "Run.step": stepped,
        "Run.restore": restored,
        "Run.linearise": (linearised, ("prescribes the yaw",)),
        "range_of": lambda s: [(gr.range_of("gravity_m_s2", s), (2,))],
        "RunBatch": lambda s: [(gr.RunBatch([s, s]).step(0.5, 0.5), (2, 6))],
        "simulate": lambda s: of_run(gr.simulate(s)),
        "simulate[slope_deg]": lambda s: of_run(gr.simulate(s, slope_deg=5.0)),
        "simulate[gradients]": lambda s: of_slopes(
            gr.simulate(s, gradients=["soil.friction_angle_deg"]).gradient
        ),
        "rollout[gradients]": lambda s: of_slopes(
            gr.rollout(s, rim_speed_m_s=[0.05], gradients=["soil.friction_angle_deg"]).gradient
        ),
        "simulate[uncertainty]": lambda s: of_run(gr.simulate(s, uncertainty=True, samples=2)),
        "rollout[slope_deg]": lambda s: of_ends(gr.rollout(s, slope_deg=[4.0, 8.0]), (2,)),
        "rollout[yaw_deg]": lambda s: of_ends(gr.rollout(s, yaw_deg=[4.0, 8.0]), (2,)),
        "rollout[soil]": lambda s: of_ends(gr.rollout(s, soil="lunar-nominal"), ()),
        "rollout[vary]": lambda s: of_ends(
            gr.rollout(s, vary={"rover.body.mass_kg": [4.0, 5.0]}), (2,)
        ),
        "heading": lambda s: of_columns(gr.heading(s, slope_deg=SLOPES, samples=2), "yaw_deg"),
        "heading[nominal]": lambda s: of_columns(
            gr.heading(s, slope_deg=SLOPES, nominal=True), "yaw_deg", "slip_ratio"
        ),
        "heading[gradients]": lambda s: of_columns(
            gr.heading(s, slope_deg=SLOPES, nominal=True, gradients="soil.friction_angle_deg"),
            "yaw_deg",
        ),
        "heading[crab]": (
            lambda s: of_columns(gr.heading(s, slope_deg=SLOPES, steering="crab"), "steering_deg"),
            ("steered",),
        ),
        "heading_map": lambda s: [
            (gr.heading_map(s, slope_deg=SLOPES, course_deg=[0.0]).yaw_deg, (1, 1, 1))
        ],
        "heading[vary]": lambda s: of_sweep(gr.heading(s, slope_deg=SLOPES, vary=MASSES, samples=2)),
        "heading[vary, nominal]": lambda s: of_sweep(
            gr.heading(s, slope_deg=SLOPES, vary=MASSES, nominal=True)
        ),
        "heading_map[vary]": lambda s: of_sweep(
            gr.heading_map(s, slope_deg=SLOPES, course_deg=[0.0], vary=MASSES)
        ),
        "wheel_speeds[vary]": lambda s: of_sweep(
            gr.wheel_speeds(s, slope_deg=SLOPES, most_speed_ratio=1.2, vary=MASSES), 3
        ),
        "card[vary]": lambda s: of_sweep(gr.card(s, slope_deg=SLOPES, samples=2, vary=MASSES)),
        "mission[vary]": lambda s: [(gr.mission(mission_of(s), vary=MASSES).x_m, (2,))],
        "wheel_speeds": lambda s: [
            (gr.wheel_speeds(s, slope_deg=SLOPES, most_speed_ratio=1.2).slip_ratio, (1, 3))
        ],
        "design": lambda s: [(gr.design(design_of(s), nominal=True).objective, ())],
        "card": lambda s: of_columns(gr.card(s, slope_deg=SLOPES, samples=2), "yaw_deg"),
        "forecast": lambda s: of_columns(
            gr.forecast(s, site="moon", slope_deg=SLOPES, **ONE_CHOICE).columns, "slope_deg"
        ),
        "map": mapped,
        "route": routed,
        "mission": lambda s: [(gr.mission(mission_of(s)).x_m, ())],
        "mission[samples]": lambda s: [(gr.mission(mission_of(s), samples=2).x_m, ())],
        "settle": lambda s: one_wheel(s, gr.settle, load_n=17.0),
        "wheel_forces": lambda s: one_wheel(s, gr.wheel_forces, sinkage_mm=10.0),
        "wheel_test": on_stand,
        "wheel_test[vary]": stands,
        "calibrate": fitted,
        "calibrate_plates": lambda s: of_fit(
            gr.calibrate_plates("cullinan-plates", s.soil, point_fit=True)
        ),
        "calibrate_shear": lambda s: of_fit(
            gr.calibrate_shear("cullinan-shear", s.soil, point_fit=True)
        ),
        "validate": validated,
        "validate_slopes": lambda s: same(
            len(gr.validate_slopes("hakuto-slope", s.soil, s.rover).to_pandas()) > 0, True
        ),
        "validate_drives": judged,
        "learn": learnt,
        "Learner": streamed,
        "replay": replayed,
        "SlipEstimator": (slip_read, ("motor",)),
        # The text alone, without the map that it names.
        "check": (checked, ("no such file",)),
        "Campaign[traverse]": lambda s: of_campaign(s, "traverse"),
        "Campaign[heading]": lambda s: of_campaign(s, "heading"),
        "campaign.run": run_campaign,
        "gym.LevelTraverseEnv": lambda s: of_env(gym.LevelTraverseEnv(scenario=s)),
        "gym.LevelTraverseVectorEnv": lambda s: of_env(
            gym.LevelTraverseVectorEnv(2, scenario=s), 2
        ),
        "gym.PathFollowingEnv": lambda s: of_env(gym.PathFollowingEnv(scenario=s)),
        "gym.PathFollowingVectorEnv": lambda s: of_env(
            gym.PathFollowingVectorEnv(2, scenario=s), 2
        ),
        "gym.RoverEnv": lambda s: of_env(Climb(scenario=s)),
        "mujoco.SoilContact": contact,
        "mujoco.rover_xml": lambda s: same(mujoco.rover_xml(s.rover).count("<motor"), 0),
        "jax.settle": lambda s: one_wheel(s, jax.settle, load_n=17.0),
        "jax.step": (lambda s: one_step(s, jax), ("prescribes the yaw",)),
        **{
            f"{prefix}settle": lambda s, it=it: one_wheel(s, it.settle, load_n=17.0)
            for prefix, it in TORCH.items()
        },
        **{
            f"{prefix}step": (lambda s, it=it: one_step(s, it), ("prescribes the yaw",))
            for prefix, it in TORCH.items()
        },
    }.items()
}


#: Calls that take no soil, wheel, rover or scenario, or only what another call made of one.
WITHOUT_FEATURES = {
    *("ByModel", "import_telemetry", "import_wheel_tests", "require_inside", "serve", "validate_all"),
    *("campaign.Results", "campaign.merge", "campaign.results"),
    *(f"style.{name}" for name in gr.style.__all__),
}


def public() -> set[str]:
    """Every public call by its name: what raises and what a call returns is none."""
    modules = {"": gr, "campaign.": gr.campaign, "style.": gr.style}
    modules |= {"gym.": gym, "jax.": jax, "mujoco.": mujoco, **TORCH}
    found = {
        prefix + name: getattr(it, name) for prefix, it in modules.items() for name in it.__all__
    }
    made = {
        name
        for name, it in found.items()
        if inspect.isclass(it)
        and (
            issubclass(it, Exception)
            or dataclasses.is_dataclass(it)
            or "Made by `" in (it.__doc__ or "")
        )
    }
    return {name for name, it in found.items() if callable(it) and name not in made}


def test_every_public_call_is_in_the_matrix() -> None:
    calls = {name.split("[")[0] for name in CALLS}
    methods = {"Run.reset", "Run.step", "Run.restore", "Run.linearise"}
    assert (calls - methods) | WITHOUT_FEATURES | {"Run", "campaign.Campaign"} == public()


#: Calls that take up to seconds meet those features alone that change what they ask.
SLOW = ("wheel_speeds", "wheel_speeds[vary]", "route", "map", "forecast", "design")
CHANGED = ("none", "map", "zones", "motors", "steering", "belief")
PAIRS = [(it, call) for it in FEATURES for call in CALLS if call not in SLOW or it in CHANGED]


@pytest.mark.parametrize(("feature", "call"), PAIRS)
def test_a_call_computes_with_a_feature_or_refuses_it_by_name(feature: str, call: str) -> None:
    answer, own = CALLS[call]
    run, words = scenario(feature), (*FEATURES[feature][1], *own)
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        try:
            numbers = answer(run)
        # JAX makes errors of what it calls back its own.
        except (gr.GrouserError, ValueError, RuntimeError) as refusal:
            assert not isinstance(refusal, gr.InternalError)
            assert any(word in str(refusal) for word in words), str(refusal)
            return
    for warning in warned:
        assert any(word in str(warning.message) for word in words), str(warning.message)
    for values, shape in numbers:
        assert np.shape(values) == shape
        assert np.isfinite(np.asarray(values, dtype=np.float64)).all()


@pytest.mark.parametrize(
    "call", ["heading[nominal]", "heading_map", "wheel_speeds", "card", "forecast"]
)
def test_an_answer_about_planes_says_that_a_terrain_is_not_used(call: str) -> None:
    with pytest.warns(UserWarning, match=r"the \[terrain\] is not used"):
        CALLS[call][0](scenario("map"))


@pytest.mark.parametrize("is_listening", [False, True])
def test_a_panic_leaves_as_an_error_of_this_package(is_listening: bool) -> None:
    with pytest.raises(gr.InternalError, match="a fault of grouser.*as a test asked for"):
        gr._core.panic(is_listening)
