"""A rover's description as a MuJoCo model."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any
from xml.etree import ElementTree as Xml

from .. import _core
from .._descriptions import Rover, Source

#: Gain of the motors' speed control, relative to the gain that would bring a wheel to its speed
#: within a step [-]: the rim then differs from its command by less than a thousandth.
_GAIN = 1e4
#: Mass of a link of the suspension, relative to the body's [-]: `grouser.simulate` has none, MuJoCo
#: needs one.
_LINK_MASS = 2e-4


def rover_xml(
    rover: Rover | Source,
    *,
    slope_deg: float = 0.0,
    yaw_deg: float = 0.0,
    gravity_m_s2: float = _core.EARTH_GRAVITY,
    timestep_s: float = 0.002,
) -> str:
    """Writes a MuJoCo model (MJCF) of a rover on a plane, as `grouser.simulate` has it.

    The body carries the wheels on hinges, each with a motor under speed control, whose command is
    the wheel's speed [rad/s]; where the rover has a ``suspension``, by rockers with a differential,
    and bogies where it has them. The world is the slope frame: x along the contour, y
    uphill, z out of the ground, with gravity inclined by the slope. The rover stands on the
    grousers' tips at the origin, and sinks from there.

    Names: the geom ``ground``, the body ``body`` with its joint ``free``, bodies and hinges of the
    wheels by their mounts' names, motors ``NAME-motor``, rockers and bogies with their joints
    ``left-rocker``, ``right-rocker``, ``left-bogie``, ``right-bogie``.

    Parameters
    ----------
    rover : Rover, name, path or mapping
        The rover.
    slope_deg : float
        Inclination of the plane [°].
    yaw_deg : float
        Yaw [°], positive uphill.
    gravity_m_s2 : float
        Gravity [m/s²].
    timestep_s : float
        Step of the integrator [s], which is ``implicitfast``.

    Returns
    -------
    str
        The text of an MJCF file.

    Examples
    --------
    >>> from grouser.mujoco import rover_xml
    >>> rover_xml("hakuto").count('<joint type="hinge"')
    4
    """
    rover = rover if isinstance(rover, Rover) else Rover(rover)
    slope, yaw = math.radians(slope_deg), math.radians(yaw_deg)
    down = (0.0, -gravity_m_s2 * math.sin(slope), -gravity_m_s2 * math.cos(slope))
    root = Xml.Element("mujoco", model=str(rover.name))
    _add(root, "option", timestep=timestep_s, gravity=down, integrator="implicitfast")
    world = _add(root, "worldbody")
    _add(world, "light", pos=(0, 0, 5), dir=(0, 0, -1))
    _add(world, "geom", name="ground", type="plane", size=(50, 50, 0.1), rgba=(0.76, 0.66, 0.5, 1))
    units: list[dict[str, Any]] = [{**rover.wheel_unit, **mount} for mount in rover.mount]
    radii = [_shearing_radius(unit["wheel"]) for unit in units]
    hubs = [unit["position_m"] for unit in units]
    body = _add(
        world,
        "body",
        name="body",
        pos=(0, 0, radii[0] - hubs[0][2]),
        quat=(math.cos(yaw / 2), 0, 0, math.sin(yaw / 2)),
    )
    _add(body, "freejoint", name="free")
    _add(body, "inertial", pos=(0, 0, 0), **_mass(rover.body))
    half = [max(abs(hub[axis]) for hub in hubs) for axis in (0, 1)]
    inner = half[1] - 0.5 * max(unit["wheel"]["width_m"] for unit in units)
    box = (0.8 * half[0], 0.8 * inner, 0.3 * min(radii))
    _add(body, "geom", type="box", size=box, mass=0, contype=0, conaffinity=0)
    links = _links(root, body, rover, timestep_s)
    motors = _add(root, "actuator")
    for unit, radius in zip(units, radii):
        name, steering = unit["name"], math.radians(unit.get("steering_deg", 0.0))
        turned = {"quat": (math.cos(steering / 2), 0, 0, math.sin(steering / 2))}
        link, pivot = links.get(name, (body, (0.0, 0.0, 0.0)))
        pos = tuple(hub - at for hub, at in zip(unit["position_m"], pivot))
        hub = _add(link, "body", name=name, pos=pos, **(turned if steering else {}))
        _add(hub, "joint", type="hinge", name=name, axis=(0, 1, 0))
        _add(hub, "inertial", pos=(0, 0, 0), **_mass(unit))
        _add(
            hub,
            "geom",
            type="cylinder",
            size=(radius, 0.5 * unit["wheel"]["width_m"]),
            euler=(90, 0, 0),
            mass=0,
            contype=0,
            conaffinity=0,
            rgba=(0.25, 0.25, 0.28, 1),
        )
        gain = _GAIN * unit["inertia_kg_m2"]["yy"] / timestep_s
        _add(motors, "velocity", name=f"{name}-motor", joint=name, kv=gain)
    Xml.indent(root)
    return Xml.tostring(root, encoding="unicode")


#: A link, and where its axis is in the body's frame [m].
_Link = tuple[Xml.Element, tuple[float, float, float]]


def _links(
    root: Xml.Element, body: Xml.Element, rover: Rover, timestep_s: float
) -> dict[str, _Link]:
    """The link of each wheel of a rover on rockers, which a differential turns against each
    other; of a rigid rover none."""
    items = rover.to_dict()
    suspension = items.get("suspension")
    if suspension is None:
        return {}
    links: dict[str, _Link] = {}
    mass = _LINK_MASS * items["body"]["mass_kg"]
    for side, sign in (("left", 1.0), ("right", -1.0)):
        wheels = [mount for mount in items["mount"] if sign * mount["position_m"][1] > 0.0]
        wheels.sort(key=lambda mount: mount["position_m"][0])
        rocker = _link((body, (0.0, 0.0, 0.0)), f"{side}-rocker", suspension["pivot_m"], mass)
        links |= {mount["name"]: rocker for mount in wheels}
        bogie = suspension.get("bogie")
        if bogie is not None:
            carried = wheels[:2] if bogie["end"] == "rear" else wheels[-2:]
            link = _link(rocker, f"{side}-bogie", bogie["pivot_m"], mass)
            links |= {mount["name"]: link for mount in carried}
    joints = {"joint1": "left-rocker", "joint2": "right-rocker"}
    # As stiff as a step allows: the constraint of a joint is settled over two steps and more.
    stiff = {"solref": (2.0 * timestep_s, 1), "solimp": (0.9999, 0.9999, 0.001)}
    _add(_add(root, "equality"), "joint", **joints, polycoef=(0, -1, 0, 0, 0), **stiff)
    return links


def _link(parent: _Link, name: str, pivot_m: list[float], mass: float) -> _Link:
    """A link that turns about an axis across the body."""
    element, start = parent
    pivot = (pivot_m[0], 0.0, pivot_m[1])
    link = _add(element, "body", name=name, pos=tuple(it - at for it, at in zip(pivot, start)))
    _add(link, "joint", type="hinge", name=name, axis=(0, 1, 0))
    # That of a link about 0.2 m long: the wheels' inertia is far larger.
    _add(link, "inertial", pos=(0, 0, 0), mass=mass, diaginertia=(0.01 * mass,) * 3)
    return link, pivot


def _shearing_radius(wheel: Mapping[str, Any]) -> float:
    """Radius of the grousers' tips [m]."""
    grousers = wheel.get("grousers")
    return float(wheel["radius_m"] + (grousers["height_m"] if grousers else 0))


def _mass(part: object) -> dict[str, object]:
    """Mass and moments of inertia of a part about its own centre."""
    inertia = part["inertia_kg_m2"]  # type: ignore[index]
    moments = tuple(inertia[axis] for axis in ("xx", "yy", "zz"))
    return {"mass": part["mass_kg"], "diaginertia": moments}  # type: ignore[index]


def _add(parent: Xml.Element, tag: str, **attributes: object) -> Xml.Element:
    """An element whose attributes are texts, numbers, or rows of numbers."""
    return Xml.SubElement(parent, tag, {key: _text(value) for key, value in attributes.items()})


def _text(value: object) -> str:
    if isinstance(value, (tuple, list)):
        return " ".join(_text(item) for item in value)
    return str(value)
