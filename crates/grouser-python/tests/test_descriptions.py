"""Descriptions are values: frozen, equal by what they say, and back to the documents they are."""

from __future__ import annotations

import copy
import pathlib
import pickle
from typing import Any

import numpy as np
import pytest

import grouser as gr

KINDS = [gr.Soil, gr.Wheel, gr.Rover, gr.Scenario]


def one_of(kind: Any) -> Any:
    return kind(next(iter(kind.presets())))


@pytest.mark.parametrize("kind", KINDS)
def test_every_preset_is_equal_to_itself_after_each_way_out_and_in(kind: Any) -> None:
    for name in kind.presets():
        one = kind(name)
        for again in (
            kind.from_toml(one.to_toml()),
            kind(one.to_dict()),
            kind(**one.to_dict()),
            pickle.loads(pickle.dumps(one)),
            copy.deepcopy(one),
            one.replace(),
        ):
            assert again == one and hash(again) == hash(one), name


@pytest.mark.parametrize("kind", KINDS)
def test_a_description_does_not_change(kind: Any) -> None:
    one = one_of(kind)
    with pytest.raises(AttributeError, match="replace"):
        one.name = "another"
    with pytest.raises(AttributeError):
        del one.name
    one.to_dict()["name"] = "another"
    assert one.name != "another"


@pytest.mark.parametrize("kind", KINDS)
def test_it_shows_itself_in_text_and_html(kind: Any) -> None:
    one = kind(one_of(kind).to_dict() | {"name": "<&>"})
    assert repr(one).startswith(f"{kind.__name__}(") and "name='<&>'" in repr(one)
    page = one._repr_html_()
    assert "&lt;&amp;&gt;" in page and "<&>" not in page


def test_keys_keep_the_order_of_the_document() -> None:
    keys = list(gr.Soil("toyoura").to_dict())
    assert keys[:3] == ["schema", "name", "source"]


def test_a_mapping_changes_single_keys_and_says_so() -> None:
    soil = gr.Soil("toyoura")
    other = soil.replace(pressure_sinkage={"n": 1.2}, cohesion_kpa=np.float32(0.5))
    assert other.pressure_sinkage["n"] == 1.2
    assert other.pressure_sinkage["k_phi"] == soil.pressure_sinkage["k_phi"]
    assert other != soil and other == gr.Soil(
        "toyoura", pressure_sinkage={"n": 1.2}, cohesion_kpa=0.5
    )
    assert any("pressure_sinkage.n: set to 1.2" in it for it in other.assumptions)


def test_a_new_law_brings_its_own_keys() -> None:
    soil = gr.Soil("toyoura", shear={"longitudinal_m": 0.02, "law": "isotropic"})
    assert (soil.shear["law"], soil.shear["longitudinal_m"]) == ("isotropic", 0.02)
    assert "lateral_m" in gr.Soil("toyoura").shear and "lateral_m" not in soil.shear


def test_parts_are_descriptions() -> None:
    wheel = gr.Wheel("hakuto", radius_m=0.2)
    rover = gr.Rover("hakuto", wheel_unit={"wheel": wheel})
    assert rover.wheel == wheel
    run = gr.Scenario(rover=rover, soil=gr.Soil("lunar-nominal"))
    assert run.rover == rover and run.soil == gr.Soil("lunar-nominal")
    assert (
        run.replace(rover={"wheel_unit": {"wheel": {"radius_m": 0.1}}}).rover.wheel.radius_m == 0.1
    )


def test_a_site_stands_for_its_three_keys() -> None:
    site = gr.Site("toyoura", slope_deg=3.0, gravity_m_s2=gr.MOON_GRAVITY)
    run = gr.Scenario(site=site)
    assert run.site == site == pickle.loads(pickle.dumps(site)) == gr.Site.from_toml(site.to_toml())
    assert (run.slope_deg, run.gravity_m_s2) == (3.0, gr.MOON_GRAVITY)
    assert site.replace(soil={"cohesion_kpa": 1.0}).soil.cohesion_kpa == 1.0
    assert len({site, site.replace(slope_deg=4.0), site.replace()}) == 2
    with pytest.raises(gr.ParameterError, match="slope_deg"):
        gr.Scenario(site=site, slope_deg=4.0)
    with pytest.raises(gr.ParameterError, match="60"):
        gr.Site("toyoura", slope_deg=70.0)


def test_a_keyword_out_of_its_range_tells_value_and_range() -> None:
    for make in (
        lambda: gr.Soil("toyoura", cohesion_kpa=-1.0),
        lambda: gr.Soil("toyoura").replace(cohesion_kpa=-1.0),
        lambda: gr.Soil(cohesion_kpa=-1.0),
        lambda: gr.Soil({"cohesion_kpa": -1.0}),
    ):
        with pytest.raises(gr.ParameterError, match="it must be 0 to 100") as caught:
            make()
        error = caught.value
        assert (error.name, error.value, error.expected) == ("cohesion_kpa", -1.0, "0 to 100")
        again = pickle.loads(pickle.dumps(error))
        assert (str(again), again.name, again.value) == (str(error), error.name, error.value)


def test_a_bad_file_tells_file_line_and_column(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "soil.toml"
    path.write_text(
        gr.Soil("toyoura").to_toml().replace("density_kg_m3 = 1490.0", "density_kg_m3 = 1.5")
    )
    with pytest.raises(gr.DocumentError, match="it must be 200 to 4000") as caught:
        gr.Soil(path)
    error = caught.value
    assert error.file == str(path) and error.key == "density_kg_m3" and error.value == 1.5
    assert error.line and path.read_text().splitlines()[error.line - 1] == "density_kg_m3 = 1.5"
    assert error.column == len("density_kg_m3 = ") + 1
    assert pickle.loads(pickle.dumps(error)).line == error.line


def test_a_missing_file_is_a_file_not_found_error(tmp_path: pathlib.Path) -> None:
    for source in ("toyora", "nowhere/soil.toml", tmp_path / "soil.toml"):
        with pytest.raises(FileNotFoundError) as caught:
            gr.Soil(source)
        assert isinstance(caught.value, gr.DocumentError)
        assert caught.value.filename == str(source)
    with pytest.raises(gr.DocumentNotFoundError, match="did you mean `toyoura`"):
        gr.Soil("toyora")
    with pytest.raises(OSError, match="folder"):
        gr.Soil(tmp_path)


def test_what_is_no_document_says_what_is() -> None:
    with pytest.raises(TypeError, match="preset's name"):
        gr.Soil(3)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="soil.cohesion_kpa is of type object"):
        gr.Soil("toyoura", cohesion_kpa=object())
    round_about: dict[str, Any] = {}
    round_about["shear"] = round_about
    with pytest.raises(RecursionError):
        gr.Soil(round_about)
    with pytest.raises(gr.DocumentError, match="a `soil/1` document is needed"):
        gr.Soil.from_toml(gr.Wheel("hakuto").to_toml())
    with pytest.raises(AttributeError, match="it has schema, name"):
        gr.Soil("toyoura").nothing  # noqa: B018


def test_a_soil_put_into_a_scenario_keeps_what_it_leaves_to_priors() -> None:
    own = gr.Scenario(soil="lunar-nominal")
    for soil in ("lunar-nominal", gr.Soil("lunar-nominal")):
        other = gr.Scenario().replace(soil=soil)
        assert other.to_dict()["soil"] == own.to_dict()["soil"] and other.assumed == own.assumed
    stated = own.replace(soil={"exit": {"ratio": 0.5}})
    assert "exit.ratio" in own.assumed and "exit.ratio" not in stated.assumed


@pytest.mark.parametrize(
    ("make", "written"),
    [
        (lambda: gr.simulate(yaw_deg=5), 'did you mean start={"yaw_deg": 5}?'),
        (lambda: gr.Run(yaw=5), 'did you mean start={"yaw_deg": 5}?'),
        (lambda: gr.Scenario("traverse-10-deg", yaw_deg=5), 'did you mean start={"yaw_deg": 5}?'),
        (lambda: gr.Scenario(start={"slope_deg": 5}), "did you mean slope_deg=5?"),
        (lambda: gr.heading(cohesion_kpa=0.5), "did you mean soil=Soil(…, cohesion_kpa=0.5)?"),
        (lambda: gr.Soil("toyoura", friction_angle=30), "did you mean friction_angle_deg=30?"),
        (lambda: gr.Soil("toyoura").replace(n=1.1), 'did you mean pressure_sinkage={"n": 1.1}?'),
        (
            lambda: gr.Rover("hakuto", mass_kg=9),
            'did you mean body={"mass_kg": 9} or wheel_unit={"mass_kg": 9}?',
        ),
        (
            lambda: gr.simulate(radius_m=0.1),
            'did you mean rover=Rover(…, wheel_unit={"wheel": {"radius_m": 0.1}})?',
        ),
        (lambda: gr.Scenario(yaw_deg=[[k, 1.0] for k in range(40)]), 'drive={"yaw_deg": …}'),
    ],
)
def test_a_misplaced_keyword_is_answered_by_what_to_write(make: Any, written: str) -> None:
    with pytest.raises(gr.ParameterError) as caught:
        make()
    assert written in str(caught.value)


def test_what_is_to_be_written_can_be_written() -> None:
    assert gr.Scenario(start={"yaw_deg": 5}).start["yaw_deg"] == 5.0
    assert gr.Rover("hakuto", body={"mass_kg": 9}).body["mass_kg"] == 9.0
    assert gr.Scenario(soil=gr.Soil("toyoura", cohesion_kpa=0.5)).soil.cohesion_kpa == 0.5


@pytest.mark.parametrize(
    ("owner", "name", "written"),
    [
        (gr.Rover("hakuto"), "mass_kg", 'rover.body["mass_kg"] or rover.wheel_unit["mass_kg"]'),
        (gr.Rover("hakuto"), "radius_m", 'rover.wheel_unit["wheel"]["radius_m"]'),
        (gr.Soil("toyoura"), "friction_angle", "soil.friction_angle_deg"),
        (gr.Soil("toyoura"), "n", 'soil.pressure_sinkage["n"]'),
        (gr.Scenario(), "yaw_deg", 'scenario.start["yaw_deg"]'),
        (gr.Scenario(), "cohesion_kpa", "scenario.soil.cohesion_kpa"),
        (gr.Site("toyoura"), "cohesion_kpa", "site.soil.cohesion_kpa"),
    ],
)
def test_a_misplaced_attribute_is_answered_by_where_it_is(owner: Any, name: str, written: str) -> None:
    with pytest.raises(AttributeError, match="has no key") as caught:
        getattr(owner, name)
    assert str(caught.value).endswith(f"; did you mean {written}?")
    kind = type(owner).__name__.lower()
    for one in written.split(" or "):
        assert isinstance(eval(one, {kind: owner}), float)


def test_an_attribute_like_no_key_is_answered_by_all_keys() -> None:
    for owner, name in ((gr.Rover("hakuto"), "colour"), (gr.Site("toyoura"), "mass_kg")):
        with pytest.raises(AttributeError, match=f"has no key '{name}'; it has "):
            getattr(owner, name)
