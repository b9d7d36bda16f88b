"""Rovers from URDF: as the program's `import-urdf` makes them."""

from __future__ import annotations

from pathlib import Path

import grouser as gr
import pytest

RIM = '<cylinder radius="{}" length="{}"/>'
PLACES = {"fl": (0.2, 0.2), "fr": (0.2, -0.2), "rl": (-0.2, 0.2), "rr": (-0.2, -0.2)}


def link(name: str, mass: float, inertia: float, shapes: str = "") -> str:
    return (
        f'<link name="{name}"><inertial><mass value="{mass}"/><inertia ixx="{inertia}" '
        f'iyy="{inertia}" izz="{inertia}"/></inertial>{shapes}</link>'
    )


def joint(name: str, kind: str, ends: tuple[str, str], at: str, rest: str = "") -> str:
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{ends[0]}"/><child link="{ends[1]}"/>'
        f'<origin xyz="{at}"/>{rest}</joint>'
    )


def collision(shape: str, rpy: str = "1.5707963 0 0") -> str:
    return f'<collision><origin rpy="{rpy}"/><geometry>{shape}</geometry></collision>'


AXIS = '<axis xyz="0 1 0"/>'
WHEEL = collision(RIM.format(0.1, 0.08))


def cart(shapes: str = WHEEL, rest: str = "", axis: str = AXIS, inertia: float = 0.002) -> str:
    text = link("body", 6, 100 * inertia)
    for name, (x, y) in PLACES.items():
        text += link(name, 0.5, inertia, shapes)
        text += joint(f"{name}_joint", "continuous", ("body", name), f"{x} {y} -0.1", axis)
    return text + rest


def rockers(multiplier: float) -> str:
    text = link("body", 6, 0.2)
    for side, y in (("left", 0.2), ("right", -0.2)):
        rocker = f"{side}_rocker"
        mimic = f'<mimic joint="left_rocker_joint" multiplier="{multiplier}"/>'
        text += link(rocker, 0.4, 0.01) + joint(
            f"{rocker}_joint",
            "revolute",
            ("body", rocker),
            f"0 {y} 0",
            AXIS + '<limit lower="-0.3" upper="0.3"/>' + (mimic if side == "right" else ""),
        )
        for end, x in (("front", 0.2), ("rear", -0.2)):
            wheel = f"{side}_{end}"
            text += link(wheel, 0.5, 0.002, WHEEL)
            text += joint(f"{wheel}_joint", "continuous", (rocker, wheel), f"{x} 0 -0.1", AXIS)
    return text


def sprung() -> str:
    text = link("body", 6, 0.2)
    for name, (x, y) in PLACES.items():
        text += link(f"{name}_strut", 0.1, 1e-4) + link(name, 0.5, 0.002, WHEEL)
        text += joint(f"{name}_sus", "prismatic", ("body", f"{name}_strut"), f"{x} {y} 0")
        text += joint(f"{name}_joint", "continuous", (f"{name}_strut", name), "0 0 -0.1", AXIS)
    return text


def rover(folder: Path, text: str, **options: object) -> gr.Rover:
    file = folder / "robot.urdf"
    file.write_text(f'<?xml version="1.0"?><robot name="cart">{text}</robot>')
    return gr.Rover.from_urdf(file, **options)  # type: ignore[arg-type]


def check_refused(folder: Path, text: str, *expected: str, **options: object) -> None:
    with pytest.raises(gr.DocumentError) as refused:
        rover(folder, text, **options)
    for part in expected:
        assert part in str(refused.value), str(refused.value)


def test_what_does_not_count_is_not_read(tmp_path: Path) -> None:
    mast = link("mast", 0.3, 0.001)
    mast += joint("mast_joint", "fixed", ("body", "mast"), "0.1 0 0.3", '<axis xyz="0 0 0"/>')
    undeclared = '<gazebo><sensor:camera name="c"><update>1</update></sensor:camera></gazebo>'
    found = rover(tmp_path, cart(rest=mast + undeclared))
    assert [mount["name"] for mount in found.mount] == list(PLACES)
    assert found.mount[0]["joint"] == "fl_joint"
    assert found.body["mass_kg"] == pytest.approx(6.3)


def test_the_largest_radius_counts_and_both_are_named(tmp_path: Path) -> None:
    found = rover(tmp_path, cart(collision(RIM.format(0.09, 0.08)) + collision(RIM.format(0.1, 0.05))))
    assert (found.wheel.radius_m, found.wheel.width_m) == (0.1, 0.05)
    assert any("the largest of 0.09, 0.1 m" in note for note in found.assumptions)


def test_meshes_need_a_size_or_their_file(tmp_path: Path) -> None:
    mesh = collision('<mesh filename="package://cart/meshes/wheel.stl" scale="0.001 0.001 0.001"/>', "0 0 0")
    check_refused(tmp_path, cart(mesh), "link fl", "wheel.stl", "was not found")
    found = rover(tmp_path, cart(mesh), wheel_radius_m=0.1, wheel_width_m=0.08)
    assert (found.wheel.radius_m, found.wheel.width_m) == (0.1, 0.08)
    (tmp_path / "meshes").mkdir()
    corners = "solid\nvertex -90 -30 -90\nvertex 90 30 90\n"
    (tmp_path / "meshes/wheel.stl").write_text(corners)
    found = rover(tmp_path, cart(mesh))
    assert found.wheel.radius_m == pytest.approx(0.09)
    assert found.wheel.width_m == pytest.approx(0.06)


def test_drums_are_no_wheels(tmp_path: Path) -> None:
    drums = ""
    for name, x in (("drum_front", 0.4), ("drum_back", -0.4)):
        drums += link(name, 0.5, 0.002, collision(RIM.format(0.12, 0.5)))
        drums += joint(f"{name}_joint", "continuous", ("body", name), f"{x} 0 -0.05", AXIS)
    found = rover(
        tmp_path,
        cart(collision('<mesh filename="wheel.dae"/>', "0 0 0"), drums),
        wheel_radius_m=0.1,
        wheel_width_m=0.08,
    )
    assert [mount["name"] for mount in found.mount] == list(PLACES)
    assert any(note.endswith("drum_front, drum_back") for note in found.assumptions)


def test_suspensions(tmp_path: Path) -> None:
    found = rover(tmp_path, rockers(-1.0))
    assert found.suspension["pivot_m"] == pytest.approx([0.0, 0.0])
    for options in ({}, {"differential": True}):
        check_refused(tmp_path, rockers(1.0), "turn the same way", **options)
    assert "suspension" not in rover(tmp_path, rockers(1.0), rigid=True).to_dict()
    notes = rover(tmp_path, sprung()).assumptions
    assert sum("the rover is taken as rigid" in note for note in notes) == 4


def test_two_wheels_are_refused_by_name(tmp_path: Path) -> None:
    text = link("body", 6, 0.2)
    for name, y in (("left", 0.2), ("right", -0.2)):
        text += link(name, 0.5, 0.002, WHEEL)
        text += joint(f"{name}_joint", "continuous", ("body", name), f"0 {y} -0.1", AXIS)
    sphere = '<collision><geometry><sphere radius="0.05"/></geometry></collision>'
    text += f'<link name="caster">{sphere}</link>'
    text += joint("cj", "fixed", ("body", "caster"), "-0.2 0 -0.15")
    check_refused(tmp_path, text, "2 wheels (left, right) and a sphere of link caster")


def test_placeholders_are_doubted(tmp_path: Path) -> None:
    notes = rover(tmp_path, cart(inertia=1.0)).assumptions
    assert sum("looks like a placeholder" in note for note in notes) == 2


def test_rovers_may_face_along_y(tmp_path: Path) -> None:
    text = cart(collision(RIM.format(0.1, 0.08), "0 1.5707963 0"), axis='<axis xyz="1 0 0"/>')
    check_refused(tmp_path, text, "4 links roll about axes along x: is y the rover's way forward?")
    found = rover(tmp_path, text, forward="y")
    assert found.mount[0]["position_m"] == pytest.approx([0.2, -0.2, -0.1])


def test_other_errors(tmp_path: Path) -> None:
    with pytest.raises(gr.DocumentNotFoundError, match=r"none\.urdf"):
        gr.Rover.from_urdf(tmp_path / "none.urdf")
    for options, name in (
        ({"wheel_radius_m": 0.0}, "wheel_radius_m"),
        ({"forward": "z"}, "forward"),
        ({"differential": True, "rigid": True}, "rigid"),
        ({"wheels": ["fl"], "passive": ["rr"]}, "passive"),
    ):
        with pytest.raises(gr.ParameterError, match=name):
            rover(tmp_path, cart(), **options)  # type: ignore[arg-type]
    found = rover(tmp_path, cart())
    assert gr.simulate(rover=found, duration_s=2.0).outcome == "completed"
