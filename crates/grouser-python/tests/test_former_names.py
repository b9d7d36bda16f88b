"""Names of version 0.1 mean what they meant, and warn at the line that uses them."""

from __future__ import annotations

import inspect
import pickle
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import grouser as gr
from grouser import _former_names

#: The package without its types, which do not have former names.
UNTYPED: Any = gr


@pytest.mark.parametrize("former, now", _former_names.NAMES.items())
def test_a_former_name_is_its_present_one(former: str, now: str) -> None:
    with pytest.warns(DeprecationWarning, match=rf"grouser\.{former} is now grouser\.{now}") as found:
        assert getattr(gr, former) is getattr(gr, now)
    assert found[0].filename == __file__


def test_former_names_are_not_listed() -> None:
    assert not set(_former_names.NAMES) & {*gr.__all__, *dir(gr)}
    assert {*_former_names.NAMES.values()} <= {*gr.__all__}


def test_former_names_can_be_imported() -> None:
    with pytest.warns(DeprecationWarning, match="grouser.Simulator is now") as found:
        exec("from grouser import Simulator", {})
    assert found[0].filename == "<string>"


def test_nothing_warns_without_a_former_name() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert not hasattr(gr, "atitude") and not hasattr(gr.Scenario(), "load")
        with pytest.raises(AttributeError, match="module 'grouser' has no attribute 'atitude'"):
            UNTYPED.atitude
        ends = gr.rollout([], duration_s=1.0)
        with pytest.raises(AttributeError, match="'Rollout' object has no attribute 'narrowing'"):
            ends.narrowing  # type: ignore[attr-defined]


def test_a_pickle_of_a_result_by_its_former_name_is_read() -> None:
    level = gr.heading(slope_deg=[5.0])
    former = pickle.dumps(level, protocol=0).replace(b"cgrouser\nHeadings", b"cgrouser\nAttitudes")
    assert b"Attitudes" in former
    with pytest.warns(DeprecationWarning):
        again = pickle.loads(former)
    assert type(again) is gr.Headings and again.yaw_deg.tolist() == level.yaw_deg.tolist()


def same(one: Any, other: Any) -> bool:
    return bool(one.to_pandas().equals(other.to_pandas()))


@pytest.mark.parametrize(
    "study",
    [
        lambda **speed: gr.heading_map(slope_deg=[5.0], course_deg=[0.0], **speed),
        lambda **speed: gr.rollout(duration_s=0.5, **speed),
        lambda **speed: gr.rollout(
            gr.Scenario(drive={"law": "eq18", "ground_speed_m_s": 0.05}), duration_s=0.5, **speed
        ),
    ],
    ids=["heading_map", "rollout", "rollout under Eq. 18"],
)
def test_a_rim_speed_by_its_former_name(study: Callable[..., Any]) -> None:
    with pytest.warns(DeprecationWarning, match="the argument speed_m_s is now rim_speed_m_s"):
        former = study(speed_m_s=0.04)
    assert same(former, study(rim_speed_m_s=0.04)) and not same(former, study(rim_speed_m_s=0.06))
    with pytest.raises(gr.ParameterError, match="is the former name of rim_speed_m_s") as found:
        study(speed_m_s=0.04, rim_speed_m_s=0.04)
    assert found.value.name == "speed_m_s"


def test_a_rim_speed_out_of_its_range_is_named() -> None:
    for study in (gr.rollout, gr.heading_map):
        with pytest.raises(gr.ParameterError, match="rim_speed_m_s is 99, it must be") as found:
            study(rim_speed_m_s=99.0)
        assert found.value.name == "rim_speed_m_s" and found.value.value == 99.0


def test_signatures_have_the_present_names() -> None:
    assert "rim_speed_m_s" in inspect.signature(gr.rollout).parameters
    assert "speed_m_s" not in inspect.signature(gr.heading_map).parameters


@pytest.mark.parametrize("make", [gr.Run, lambda **it: gr.RunBatch([gr.Scenario()], **it)])
def test_commands_by_their_former_name(make: Callable[..., Any]) -> None:
    with pytest.warns(DeprecationWarning, match="commands='speed_m_s' is now 'rim_speed_m_s'") as found:
        former = make(commands="speed_m_s")
    assert found[0].filename == __file__
    now = make(commands="rim_speed_m_s")
    assert former.step(0.05, 0.1).tolist() == now.step(0.05, 0.1).tolist()


def test_attributes_of_results_by_their_former_names() -> None:
    ends: Any = gr.rollout(duration_s=0.5, trajectories=True)
    with pytest.warns(DeprecationWarning, match=r"Rollout\.samples is now Rollout\.records"):
        assert ends.samples is ends.records
    # A calibration without its fit: what it holds does not matter here.
    found: Any = object.__new__(gr.Calibration)
    found.__dict__.update(unidentifiable=("one",), posterior_contraction=np.ones(1))
    for former, now in _former_names.ATTRIBUTES["Calibration"].items():
        with pytest.warns(DeprecationWarning, match=f"Calibration.{former} is now Calibration.{now}"):
            assert getattr(found, former) is getattr(found, now)


def test_moments_in_mujoco_by_their_former_name() -> None:
    mujoco = pytest.importorskip("mujoco")
    from grouser.mujoco import SoilContact, rover_xml

    rover = gr.Rover("hakuto")
    model = mujoco.MjModel.from_xml_string(rover_xml(rover))
    wheels = {mount["name"]: rover.wheel for mount in rover.mount}

    def along(**moments: Any) -> list[float]:
        data = mujoco.MjData(model)
        # Turning wheels on the spot: their moments act.
        data.ctrl[:] = [0.5, 0.5, -0.5, -0.5]
        SoilContact(model, soil="toyoura", wheels=wheels, ground="ground", **moments).step(data, 20)
        return list(data.qpos)

    with pytest.warns(DeprecationWarning, match="the argument moments is now wheel_moments"):
        former = along(moments="neglected")
    assert former == along(wheel_moments="neglected") != along()


#: Keys of scenarios: former keywords, present ones.
KEYWORDS: list[tuple[dict[str, Any], dict[str, Any]]] = [
    ({"loads": "uniform"}, {"load_transfer": "uniform"}),
    ({"moments": "included"}, {"wheel_moments": "included"}),
    ({"drive": {"speed_m_s": 0.03}}, {"drive": {"rim_speed_m_s": 0.03}}),
    (
        {"drive": {"law": "eq18", "speed_m_s": 0.03}},
        {"drive": {"law": "eq18", "ground_speed_m_s": 0.03}},
    ),
    ({"model": "extended"}, {"model": "small-wheel"}),
]


@pytest.mark.parametrize("former, now", KEYWORDS, ids=lambda keys: next(iter(keys)))
def test_keywords_of_a_scenario_by_their_former_names(
    former: dict[str, Any], now: dict[str, Any]
) -> None:
    assert gr.Scenario(**former) == gr.Scenario(**now)
    assert gr.Scenario(former) == gr.Scenario(now)
    # A change is noted among the assumptions by the key that was given: the rest is equal.
    kept, changed = gr.Scenario().replace(**former).to_dict(), gr.Scenario().replace(**now).to_dict()
    for name in {*kept, *changed} - {"assumed"}:
        assert kept[name] == changed[name], name


def test_keys_of_descriptions_are_read_by_their_former_names() -> None:
    run = gr.Scenario(load_transfer="uniform", wheel_moments="included")
    soil = gr.Soil("cmu-direct90-smooth")
    eq18 = gr.Scenario(drive={"law": "eq18", "ground_speed_m_s": 0.03})
    for read, expected in (
        (lambda: run.loads, "uniform"),
        (lambda: run.moments, "included"),
        (lambda: run.drive["speed_m_s"], run.drive["rim_speed_m_s"]),
        (lambda: eq18.drive["speed_m_s"], 0.03),
        (lambda: soil.extended, soil.small_wheel),
        (lambda: soil.small_wheel["flank"], soil.small_wheel["side_wall"]),
        (lambda: soil.small_wheel["heap"]["front"], soil.small_wheel["mounds"]["bow_wave"]),
    ):
        with pytest.warns(DeprecationWarning, match="is now"):
            assert read() == expected
    with pytest.raises(KeyError):
        run.drive["flank"]


def test_models_studies_and_presets_by_their_former_names() -> None:
    former, now = (
        gr.settle("cmu-direct90-smooth", "hakuto", load_n=20, slip_ratio=0.2, model=name)
        for name in ("extended", "small-wheel")
    )
    assert former.sinkage_mm.tolist() == now.sinkage_mm.tolist()
    assert gr.Campaign("campaign-attitude") == gr.Campaign("campaign-heading")
    studies = (gr.Campaign("campaign-heading", study=name) for name in ("attitude", "heading"))
    assert [one.study for one in studies] == ["heading", "heading"]
