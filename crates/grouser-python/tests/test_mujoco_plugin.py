"""The plugin of MuJoCo's engine: the bits of `SoilContact`, wherever the engine steps."""

from __future__ import annotations

import os
import re
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import grouser as gr
import mujoco
from grouser.mujoco import SoilContact, rover_xml
from mujoco import rollout

Floats = NDArray[np.float64]
PLUGIN = os.environ.get("GROUSER_MUJOCO_PLUGIN", "")
pytestmark = pytest.mark.skipif(not PLUGIN, reason="the plugin of MuJoCo's engine is not built")
#: What the plugin's state has of each wheel, after the wrench on its body.
RESULTS = ["sinkage_mm", "slip_ratio", "slip_angle_deg"]
PER_WHEEL, SINKAGE = 13, 6
STATE = int(mujoco.mjtState.mjSTATE_FULLPHYSICS)
DUNES = """<asset><hfield name="dunes" nrow="3" ncol="4" size="2 2 0.05 0.1"
 elevation="0 1 0 0.5  0.4 0 1 0.2  0 0.6 0.3 1"/></asset>"""


@pytest.fixture(scope="module", autouse=True)
def load() -> None:
    mujoco.mj_loadPluginLibrary(PLUGIN)


def plain_xml(ground: str = "plane", **options: Any) -> str:
    """The model of a rover without soil."""
    xml = rover_xml(gr.Rover("hakuto"), **options)
    if ground == "field":
        plane = re.search(r'<geom name="ground"[^>]*/>', xml)
        assert plane is not None
        field = '<geom name="ground" type="hfield" hfield="dunes" contype="0" conaffinity="0"/>'
        xml = xml.replace(plane.group(), field).replace("<worldbody>", DUNES + "<worldbody>")
    return xml


def with_plugin(xml: str, **changes: str) -> str:
    """The same with the plugin."""
    names = " ".join(mount["name"] for mount in gr.Rover("hakuto").mount)
    given = {"soil": "toyoura", "wheel": "hakuto", "wheels": names, "ground": "ground", **changes}
    keys = "".join(f'<config key="{key}" value="{value}"/>' for key, value in given.items())
    instance = f'<instance name="soil">{keys}</instance>'
    extension = f'<extension><plugin plugin="grouser.soil">{instance}</plugin></extension>'
    xml = re.sub(r"(<mujoco[^>]*>)", r"\1" + extension, xml, count=1)
    return re.sub(r'(<body name="body"[^>]*>)', r'\1<plugin instance="soil"/>', xml, count=1)


def plugged(**changes: str) -> tuple[Any, Any]:
    model = mujoco.MjModel.from_xml_string(with_plugin(plain_xml(), **changes))
    return model, mujoco.MjData(model)


def contact_of(mj_model: Any, **options: Any) -> SoilContact:
    rover = gr.Rover("hakuto")
    usual = {"wheels": {mount["name"]: rover.wheel for mount in rover.mount}}
    return SoilContact(mj_model, **{"soil": "toyoura", "ground": "ground", **usual, **options})


def drive(model: Any, data: Any, steps: int, apply: Any = None) -> list[list[float]]:
    """Drives, stops, and drives on with unequal speeds."""
    poses = []
    for step in range(steps):
        third = step * 3 // steps
        data.ctrl[:] = [[0.55] * 4, [0.0] * 4, [0.2, 0.8, 0.3, 0.9]][third]
        if apply is not None:
            apply(data)
        mujoco.mj_step(model, data)
        poses.append([*data.qpos, *data.qvel])
    return poses


# ---- bits ----


@pytest.mark.parametrize("integrator", ["Euler", "implicit", "implicitfast"])
@pytest.mark.parametrize("ground", ["plane", "field"])
def test_it_has_the_bits_of_the_python_contact(ground: str, integrator: str) -> None:
    xml = plain_xml(ground, slope_deg=8.0, yaw_deg=20.0)
    if integrator == "Euler":
        # It takes no stiff motors, and damping of joints at the step's end.
        xml = re.sub(r'kv="[^"]*"', 'kv="0.05"', xml)
        xml = xml.replace('type="hinge"', 'type="hinge" damping="0.01"')
    models = [mujoco.MjModel.from_xml_string(one) for one in (xml, with_plugin(xml))]
    for model in models:
        model.opt.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{integrator.upper()}")
    plain, plugged = models
    soil = contact_of(plain)
    data, own = mujoco.MjData(plain), mujoco.MjData(plugged)
    expected = drive(plain, data, 600, soil.apply)
    assert drive(plugged, own, 600) == expected
    found = own.plugin_state.reshape(4, PER_WHEEL)
    assert found[:, :SINKAGE].tolist() == [
        data.xfrc_applied[plain.body(name).id].tolist() for name in soil.names
    ]
    of_python = [getattr(soil.forces, name) for name in RESULTS]
    of_plugin = [found[:, SINKAGE] * 1e3, found[:, SINKAGE + 1], np.degrees(found[:, SINKAGE + 2])]
    np.testing.assert_allclose(of_plugin, of_python, rtol=1e-15)


@pytest.mark.parametrize(
    "changes, options",
    [
        ({"model": "bekker"}, {"model": "bekker"}),
        ({"changes": "soil.cohesion_kpa=2; wheel.grousers.count=20"}, {}),
        ({"wheel_moments": "neglected"}, {"wheel_moments": "neglected"}),
        ({"soil": "toyoura toyoura toyoura lunar-nominal"}, {}),
        ({"sinkage_damping_s_m": "2", "rest_speed_m_s": "1e-3"}, {}),
    ],
)
def test_each_setting_is_that_of_the_python_contact(
    changes: dict[str, str], options: dict[str, Any]
) -> None:
    model = mujoco.MjModel.from_xml_string(plain_xml())
    data = mujoco.MjData(model)
    if "soil" in changes:
        options = {"soil": changes["soil"].split()}
    if "changes" in changes:
        soil, wheel = gr.Soil("toyoura", cohesion_kpa=2), gr.Rover("hakuto").wheel.to_dict()
        wheel["grousers"]["count"] = 20
        names = [mount["name"] for mount in gr.Rover("hakuto").mount]
        options = {"soil": soil, "wheels": dict.fromkeys(names, gr.Wheel(wheel))}
    if "rest_speed_m_s" in changes:
        options = {key: float(value) for key, value in changes.items()}
    expected = drive(model, data, 150, contact_of(model, **options).apply)
    assert drive(*plugged(**changes), 150) == expected
    assert drive(*plugged(), 150) != expected


def test_gravity_and_masses_are_those_of_each_step() -> None:
    moon, heavy, usual = plugged(), plugged(), plugged()
    drive(*usual, 150)
    for model, data in (moon, heavy):
        drive(model, data, 150)
    moon[0].opt.gravity[:] *= 1.62 / 9.81
    heavy[0].body_mass[:] *= 2.0
    sunk = {}
    for name, (model, data) in {"moon": moon, "heavy": heavy, "usual": usual}.items():
        for _ in range(1500):
            mujoco.mj_step(model, data)
        sunk[name] = data.plugin_state.reshape(4, PER_WHEEL)[:, SINKAGE].mean()
    # Less weight makes the soil lighter, too: wheels sink as deep, or a little deeper.
    assert sunk["heavy"] > 1.2 * sunk["usual"]
    made = mujoco.MjModel.from_xml_string(plain_xml())
    made.opt.gravity[:] *= 1.62 / 9.81
    at_rest = mujoco.MjData(made)
    soil = contact_of(made)
    at_rest.ctrl[:] = moon[1].ctrl
    soil.step(at_rest, 1500)
    assert abs(sunk["moon"] * 1e3 - soil.forces.sinkage_mm.mean()) < 0.5


# ---- state ----


def test_a_state_goes_on_with_the_same_bits() -> None:
    model, data = plugged()
    drive(model, data, 300)
    kept = np.zeros(mujoco.mj_stateSize(model, STATE))
    mujoco.mj_getState(model, data, kept, STATE)
    # Looking at a state, as viewers do, changes nothing.
    mujoco.mj_forward(model, data)
    again = mujoco.MjData(model)
    mujoco.mj_setState(model, again, kept, STATE)
    again.qacc_warmstart[:] = data.qacc_warmstart
    assert drive(model, again, 100) == drive(model, data, 100)


def test_rollouts_by_threads_are_steps() -> None:
    model, data = plugged()
    drive(model, data, 150)
    count, steps = 64, 60
    start = np.zeros(mujoco.mj_stateSize(model, STATE))
    mujoco.mj_getState(model, data, start, STATE)
    control = np.linspace(-0.4, 0.9, count)[:, None, None] * np.ones((count, steps, model.nu))
    expected = []
    for one in control:
        alone = mujoco.MjData(model)
        mujoco.mj_setState(model, alone, start, STATE)
        for now in one:
            alone.ctrl[:] = now
            mujoco.mj_step(model, alone)
        reached = np.zeros_like(start)
        mujoco.mj_getState(model, alone, reached, STATE)
        expected.append(reached.tolist())
    threads = [mujoco.MjData(model) for _ in range(4)]
    states, _ = rollout.rollout(model, threads, np.tile(start, (count, 1)), control)
    assert states[:, -1].tolist() == expected


# ---- wrong uses ----


@pytest.mark.parametrize(
    "changes",
    [
        {"soil": "toyura"},
        {"wheels": "body"},
        {"wheels": "nobody"},
        {"wheels": ""},
        {"soil": "toyoura toyoura"},
        {"ground": "floor"},
        {"model": "becker"},
        {"wheel_moments": "some"},
        {"rest_speed_m_s": "slow"},
        {"rest_speed_m_s": "0"},
        {"changes": "soil.cohesion=1"},
        {"wheel": "sojourner"},
    ],
)
def test_what_is_wrong_is_refused(changes: dict[str, str]) -> None:
    with pytest.raises(Exception, match="plugin"):
        plugged(**changes)


def test_an_integrator_and_a_contact_that_cannot_be_are_refused() -> None:
    xml = with_plugin(plain_xml())
    fourth = re.sub(r'integrator="\w+"', 'integrator="RK4"', xml)
    touching = xml.replace('contype="0" conaffinity="0"', 'contype="1" conaffinity="1"')
    for wrong in (fourth, touching):
        assert wrong != xml
        with pytest.raises(Exception, match="plugin"):
            mujoco.MjData(mujoco.MjModel.from_xml_string(wrong))
