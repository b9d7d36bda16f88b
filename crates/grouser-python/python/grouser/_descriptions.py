"""Descriptions of soils, wheels, rovers, sites and runs: immutable values, read from documents."""

from __future__ import annotations

import html
import os
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar, Union

from . import _core, _keys
from ._arrays import whole_number
from ._errors import ParameterError, refuse_vary
from ._terrain import Terrain

_Self = TypeVar("_Self", bound="_Description")
#: The sources of a description: a preset's name, a path, or its keys.
Source = Union[str, "os.PathLike[str]", Mapping[str, Any]]


#: What a description takes from its document only when it is asked for.
_LATER: dict[str, Callable[[_core.Document], Any]] = {
    "_files": lambda document: document.files,
    "_items": lambda document: document.to_dict(),
    "_toml": lambda document: document.to_toml(),
}


@lru_cache(maxsize=None)
def _preset_names(kind: str) -> frozenset[str]:
    return frozenset(name for name, _, _ in _core.presets(kind))


@lru_cache(maxsize=None)
def _preset(kind: str, name: str) -> _core.Document:
    """A preset, which never changes: it is read once."""
    return _core.find_document(kind, name, {})


class _Description:
    """An immutable value with named keys; equal to another with the same keys and values."""

    __slots__ = ("_document", "_files", "_items", "_toml")
    _kind: ClassVar[str]
    _document: _core.Document
    _files: dict[str, str | _core.Terrain]
    _items: dict[str, Any]
    _toml: str

    def __init__(
        self, source: _Description | Source | None = None, /, **changes: Any
    ) -> None:
        self._take(self._read(source, changes))

    def _read(self, source: object, changes: dict[str, Any]) -> _core.Document:
        refuse_vary(changes)
        kind, label = self._kind, f"{type(self).__name__}(…)"
        if isinstance(source, type(self)):
            return _core.read_document_text(kind, label, source._toml, changes, source._files)
        if source is None:
            return self._from_keys(label, changes)
        if isinstance(source, str):
            if not changes and source in _preset_names(kind):
                return _preset(kind, source)
            return _core.find_document(kind, source, changes)
        if isinstance(source, os.PathLike):
            return _core.read_document_file(kind, os.fspath(source), changes)
        if isinstance(source, Mapping):
            return _core.read_document_table(kind, label, dict(source), changes, {})
        given = type(source).__name__
        raise TypeError(
            f"{type(self).__name__} is made from a preset's name, a path, a mapping or keywords, "
            f"not from {given}"
        )

    def _from_keys(self, label: str, keys: dict[str, Any]) -> _core.Document:
        return _core.read_document_table(self._kind, label, keys, {}, {})

    def _take(self, document: _core.Document) -> None:
        object.__setattr__(self, "_document", document)

    @classmethod
    def from_toml(
        cls: type[_Self], text: str, files: Mapping[str, str | Terrain] | None = None
    ) -> _Self:
        """The description that a TOML text gives.

        Parameters
        ----------
        text : str
            The document.
        files : mapping of str to str or Terrain, optional
            The content of the files that it names, in the form of `files`.

        Raises
        ------
        DocumentError
            With line and column, if the text is not a valid document.
        DocumentNotFoundError
            If a file that it names is neither among ``files`` nor in the current folder.
        """
        made = cls.__new__(cls)
        made._take(_core.read_document_text(cls._kind, "TOML", text, {}, _given(files)))
        return made

    @classmethod
    def _of(
        cls: type[_Self], items: Mapping[str, Any], files: Mapping[str, str | _core.Terrain]
    ) -> _Self:
        """A part of another description, with its files."""
        label = f"{cls.__name__}(…)"
        made = cls.__new__(cls)
        made._take(_core.read_document_table(cls._kind, label, dict(items), {}, dict(files)))
        return made

    @classmethod
    def presets(cls) -> dict[str, str]:
        """Names of the presets, each with its title and source."""
        return {name: f"{title} ({source})" for name, title, source in _core.presets(cls._kind)}

    def replace(self: _Self, **changes: Any) -> _Self:
        """The same with other values.

        A mapping changes single keys of a table: ``soil.replace(pressure_sinkage={"n": 1.1})``. A
        changed value is noted among the ``assumptions``, because the source no longer applies to
        it.

        Parameters
        ----------
        **changes
            Keys with other values.

        Raises
        ------
        ParameterError
            If a key does not exist, or its value is not allowed.
        """
        return type(self)(self, **changes)

    def to_toml(self) -> str:
        """The complete document as TOML. Read again, with its `files`, it gives an equal
        description."""
        return self._toml

    @property
    def files(self) -> Mapping[str, str | Terrain]:
        """Names and contents of the files that the document names; a copy. A soil whose uncertainty
        is given by samples has one, as text; ground with heights has a map, as a `Terrain`."""
        return {name: _file(content) for name, content in self._files.items()}

    def to_dict(self) -> dict[str, Any]:
        """Keys and values of the document; a copy."""
        return self._document.to_dict()

    @property
    def assumptions(self) -> tuple[str, ...]:
        """The assumed values, each with the name of its document."""
        return tuple(self._document.assumptions)

    @property
    def assumed(self) -> tuple[str, ...]:
        """The keys that it, or its soil, takes from priors because they are not stated."""
        return tuple(self._document.assumed)

    # Type checkers see the keys of `_keys`, and so find misspelt ones.
    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            if name in _LATER:
                value = _LATER[name](self._document)
                object.__setattr__(self, name, value)
                return value
            if name.startswith("_"):
                raise AttributeError(name)
            if name not in self._items:
                meant = " or ".join(self._meant(name))
                hint = f"did you mean {meant}?" if meant else f"it has {', '.join(self._items)}"
                raise AttributeError(f"{type(self).__name__} has no key {name!r}; {hint}")
            return _frozen(self._items[name])

    def _meant(self, name: str) -> list[str]:
        """The keys that an unknown name was probably meant to be, as Python gets their values."""
        paths = _core.meant_keys(self._kind, name)
        found = (_written(type(self).__name__.lower(), self, path.split(".")) for path in paths)
        return [written for written in found if written is not None]

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self._items})

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(
            f"a {type(self).__name__} does not change; .replace({name}=…) gives another"
        )

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"a {type(self).__name__} does not change")

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        if self._document is other._document:
            return True
        return self._toml == other._toml and self._files == other._files

    def __hash__(self) -> int:
        return hash((type(self), self._toml))

    def __reduce__(self) -> tuple[object, ...]:
        return type(self).from_toml, (self._toml, self.files)

    def __copy__(self: _Self) -> _Self:
        return self

    def __deepcopy__(self: _Self, memo: object) -> _Self:
        return self

    def __repr__(self) -> str:
        skipped = {"schema", "source", "notes", "assumed"}
        shown = (
            f"{key}={_short(value)}" for key, value in self._items.items() if key not in skipped
        )
        return f"{type(self).__name__}({', '.join(shown)})"

    def _repr_html_(self) -> str:
        title = html.escape(str(self._items.get("name", "")))
        return f"<b>{type(self).__name__}</b> {title}{_html_table(self._items)}"


def _file(content: str | _core.Terrain) -> str | Terrain:
    """The content of a file, as a caller has it."""
    return content if isinstance(content, str) else Terrain._of(content)


def _given(files: Mapping[str, str | Terrain] | None) -> dict[str, str | _core.Terrain]:
    """Files of a caller."""
    return {
        name: content._native if isinstance(content, Terrain) else content
        for name, content in dict(files or {}).items()
    }


def _frozen(value: Any) -> Any:
    """A read-only view of a value."""
    if isinstance(value, dict):
        return MappingProxyType({key: _frozen(item) for key, item in value.items()})
    if isinstance(value, list):
        return tuple(_frozen(item) for item in value)
    return value


def _written(name: str, thing: Any, path: list[str]) -> str | None:
    """How the value under a path is written, as in ``rover.body["mass_kg"]``; None where there is
    no value."""
    for step in path:
        of_description = isinstance(thing, _Description)
        keys = thing._items if of_description else thing
        if not isinstance(keys, Mapping) or step not in keys:
            return None
        name += f".{step}" if of_description else f'["{step}"]'
        thing = getattr(thing, step) if of_description else thing[step]
    return name


def _short(value: Any) -> str:
    if isinstance(value, dict):
        if "name" in value and "schema" in value:
            return f"<{value['name']}>"
        return "{" + ", ".join(f"{key}: {_short(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(_short(item) for item in value) + "]"
    return repr(value)


def _html_table(items: Mapping[str, Any]) -> str:
    def cell(value: Any) -> str:
        if isinstance(value, dict):
            return _html_table(value)
        if isinstance(value, list) and any(isinstance(item, dict) for item in value):
            return "".join(cell(item) for item in value)
        return html.escape(", ".join(map(str, value)) if isinstance(value, list) else str(value))

    rows = (
        f"<tr><th style='text-align:left'>{html.escape(key)}</th><td>{cell(value)}</td></tr>"
        for key, value in items.items()
        if key != "schema"
    )
    return f"<table>{''.join(rows)}</table>"


class Soil(_Description, _keys.SoilKeys):
    """A soil: its strength, and how stresses grow with sinkage and shear displacement.

    ``Soil("toyoura")`` is a preset, ``Soil("my-soil.toml")`` or ``Soil(pathlib.Path(…))`` a file,
    ``Soil({…})`` and ``Soil(cohesion_kpa=0.0, …)`` give its keys. Keywords beside a source change
    single keys: ``Soil("toyoura", cohesion_kpa=0.5)``.

    Keys, each also an attribute (``schema/soil.json`` has all, with their ranges): ``cohesion_kpa``
    [kPa], ``friction_angle_deg`` [°], ``density_kg_m3`` [kg/m³], and the tables
    ``pressure_sinkage``, ``stress_peak``, ``shear``, ``exit``, ``bulldozing``.

    Raises
    ------
    ParameterError
        For an unknown keyword, or a value out of its range.
    DocumentError
        For an invalid file, with line and column.
    DocumentNotFoundError
        If there is neither a preset nor a file of this name; also a ``FileNotFoundError``.

    Examples
    --------
    >>> import grouser as gr
    >>> sand = gr.Soil("toyoura")
    >>> sand.friction_angle_deg, sand.pressure_sinkage["n"]
    (38.0, 1.703)
    >>> firm = sand.replace(cohesion_kpa=0.5, pressure_sinkage={"n": 1.2})
    >>> firm.cohesion_kpa, firm == sand, gr.Soil.from_toml(firm.to_toml()) == firm
    (0.5, False, True)
    """

    __slots__ = ()
    _kind = "soil"

    if TYPE_CHECKING:

        @property
        def files(self) -> dict[str, str]:
            """The samples of an uncertain soil, as text by the name of their file; a copy."""
            ...

    def sample(self, n: int, seed: int = 1) -> list[Soil]:
        """Samples of an uncertain soil, by the deviations or the samples that its document states,
        and by priors where it states none: the soils of the studies that have samples.

        Sample *i* depends on the seed and *i* alone, so that more samples begin with the same ones.
        Those studies sample the error of the wheel–soil model as well, which is not a number of the
        soil.

        Parameters
        ----------
        n : int
            Number of samples, up to 100000.
        seed : int
            Seed of the samples.

        Returns
        -------
        list of Soil
            Exact soils, without uncertainty.

        Raises
        ------
        ParameterError
            For a soil that is exact.

        Examples
        --------
        >>> import grouser as gr
        >>> soils = gr.Soil("toyoura-uncertain").sample(100, seed=1)
        >>> wheels = gr.settle(soils, "hakuto", load_n=17.0, slip_ratio=0.2)
        >>> wheels.drawbar_pull_n.shape
        (100,)
        """
        count = whole_number("n", n, most=100_000)
        made = []
        for document in self._document.samples(count, whole_number("seed", seed)):
            soil = Soil.__new__(Soil)
            soil._take(document)
            made.append(soil)
        return made


class Wheel(_Description, _keys.WheelKeys):
    """A rigid wheel with a flat rim: ``radius_m`` [m], ``width_m`` [m], and ``grousers`` with
    ``height_m`` [m] and ``count``, left out for a smooth wheel. Sources and errors are those of
    `Soil`.

    Examples
    --------
    Do higher grousers pull more?

    >>> import grouser as gr
    >>> wheel = gr.Wheel(radius_m=0.1, width_m=0.08, grousers={"height_m": 0.005, "count": 24})
    >>> higher = wheel.replace(grousers={"height_m": 0.01})
    >>> low, high = (gr.settle("toyoura", it, load_n=17.0, slip_ratio=0.3) for it in (wheel, higher))
    >>> bool(high.drawbar_pull_n > low.drawbar_pull_n)
    True
    """

    __slots__ = ()
    _kind = "wheel"


class Rover(_Description, _keys.RoverKeys):
    """A rover: ``body``, ``wheel_unit`` with its ``wheel``, and a ``mount`` for each wheel with its
    ``position_m`` [m] from the body's centre of mass, in the body frame (x forward, y left, z up).
    A mount may have a ``wheel``, ``mass_kg`` and ``inertia_kg_m2`` of its own, and ``steering_deg``
    [°], positive to the left. Sources and errors are those of `Soil`.

    Examples
    --------
    >>> import grouser as gr
    >>> rover = gr.Rover("hakuto")
    >>> len(rover.mount), rover.wheel.radius_m, rover.body["mass_kg"]
    (4, 0.1, 5.24)
    >>> heavier = rover.replace(body={"mass_kg": 2.0 * rover.body["mass_kg"]})
    >>> usual, loaded = (gr.simulate(rover=it, duration_s=5.0) for it in (rover, heavier))
    >>> bool((loaded.wheel["sinkage_mm"][-1] > usual.wheel["sinkage_mm"][-1]).all())
    True
    """

    __slots__ = ()
    _kind = "rover"

    @property
    def wheel(self) -> Wheel:
        """The wheel of every mount that has no other."""
        return Wheel(self._items["wheel_unit"]["wheel"])

    @classmethod
    def from_urdf(
        cls,
        path: str | os.PathLike[str],
        /,
        *,
        wheels: Sequence[str] = (),
        passive: Sequence[str] = (),
        wheel_radius_m: float | None = None,
        wheel_width_m: float | None = None,
        forward: str = "x",
        differential: bool = False,
        rigid: bool = False,
    ) -> Rover:
        """The rover of a URDF file, as the program's ``import-urdf`` makes it: what was taken for
        granted on the way stands in ``assumptions``.

        Parameters
        ----------
        path : str or path
            The file: of xacro, what ``xacro FILE`` prints. Meshes of wheels are looked for beside
            it and in the folders above.
        wheels : sequence of str
            Links that are wheels, with ``*`` for any letters. Without any they are guessed.
        passive : sequence of str
            Links that roll and are no driven wheels.
        wheel_radius_m, wheel_width_m : float, optional
            Size of the wheels [m], where their shapes do not tell it, or another.
        forward : {"x", "y", "-x", "-y"}
            Which way of the root link is forward.
        differential : bool
            A differential joins the rockers of both sides, where no ``<mimic>`` says so.
        rigid : bool
            Joints of the suspension are taken as they stand.

        Raises
        ------
        DocumentError
            For a file that is no rover; the message names links and joints.
        ParameterError
            For a size or a way forward that is invalid.

        Examples
        --------
        >>> import grouser as gr
        >>> rover = gr.Rover.from_urdf("cart.urdf", passive=["*drum*"])  # doctest: +SKIP
        >>> gr.simulate(rover=rover, duration_s=5.0).outcome  # doctest: +SKIP
        'completed'
        """
        for name, size in (("wheel_radius_m", wheel_radius_m), ("wheel_width_m", wheel_width_m)):
            if size is not None and not 0.0 < size <= 10.0:
                raise ParameterError(f"{name} is {size}, it must be above 0 and up to 10", name)
        if differential and rigid:
            raise ParameterError("a rigid rover has no differential", "rigid")
        if wheels and passive:
            raise ParameterError("passive goes with guessed wheels, not with wheels", "passive")
        made = cls.__new__(cls)
        made._take(
            _core.rover_of_urdf(
                path,
                (list(wheels), list(passive)),
                (wheel_radius_m, wheel_width_m),
                forward,
                (differential, rigid),
            )
        )
        return made


class _OnGround(_Description):
    """What a rover does on its ground: with a rover, and a soil on a slope under a gravity."""

    __slots__ = ()

    def __init__(
        self,
        source: _OnGround | Source | None = None,
        /,
        *,
        site: Site | None = None,
        **changes: Any,
    ) -> None:
        if site is not None:
            if not isinstance(site, Site):
                raise TypeError(f"site is a Site, not {type(site).__name__}")
            twice = site._items.keys() & changes.keys()
            if twice:
                name = sorted(twice)[0]
                raise ParameterError(f"{name} is given by the site already", name)
            changes = {**changes, **site._keys()}
        super().__init__(source, **changes)

    @property
    def rover(self) -> Rover:
        """The rover."""
        return Rover(self._items["rover"])

    @property
    def soil(self) -> Soil:
        """The soil."""
        return Soil._of(self._items["soil"], self._files)

    @property
    def site(self) -> Site:
        """Soil, slope and gravity."""
        keys = ("slope_deg", "gravity_m_s2")
        return Site(self.soil, **{key: self._items[key] for key in keys})


class Scenario(_OnGround, _keys.ScenarioKeys):
    """One run of one rover on one plane of soil: ``rover``, ``soil``, ``slope_deg`` [°],
    ``gravity_m_s2`` [m/s²], ``duration_s`` [s], ``sample_interval_s`` [s], ``model``,
    ``load_transfer``, ``wheel_moments``, ``simulation``, ``drive``, ``by_wheel``, ``scatter``,
    ``ruts``, ``slope_stability``, ``start``.
    Every key has a default: together they are the source paper's traverse of a slope of 10°, with a
    complete load transfer. ``drive={"yaw_deg": [[0, 5.51], [20, 3.1]]}`` prescribes the yaw over time. A ``site=Site(…)``
    gives ``soil``, ``slope_deg`` and ``gravity_m_s2`` together.

    Sources and errors are those of `Soil`.

    Examples
    --------
    The rover starts with its nose 8° uphill, on the Moon:

    >>> import grouser as gr
    >>> scenario = gr.Scenario(slope_deg=12.0, gravity_m_s2=gr.MOON_GRAVITY, start={"yaw_deg": 8.0})
    >>> scenario.start["yaw_deg"], scenario.soil.name, scenario.rover.name
    (8.0, 'Toyoura sand', 'HAKUTO')
    >>> gr.simulate(scenario, duration_s=2.0).outcome
    'completed'
    """

    __slots__ = ()
    _kind = "scenario"


class Mission(_OnGround, _keys.MissionKeys):
    """Legs that a rover drives one after the other over a plane of soil, and limits at which it
    stops.

    ``Mission("there-and-back")`` is a preset, ``Mission("my-mission.toml")`` a file, and
    ``Mission(leg=[…], stop={…}, …)`` gives its keys. A leg is a mapping with one of ``drive_m`` [m],
    ``turn_deg`` [°], ``arc``, ``goto`` and ``wait_s`` [s]; ``stop`` has limits under the names of their
    numbers, a mapping or what the number may not be above: ``slip_ratio``, ``drift_m`` [m],
    ``off_path_m`` [m] and more. ``alternative`` is a list of ways from the same start, each with a
    ``name`` and legs, ``legs_from`` a file with legs, and ``stop_from`` one with limits.
    ``schema/mission.json`` has all keys, with their ranges. A ``site=Site(…)`` gives ``soil``,
    ``slope_deg`` and ``gravity_m_s2`` together. `mission` drives it.

    Sources and errors are those of `Soil`; the message about a leg names it.

    Examples
    --------
    Two metres along the contour of a slope of 10°, unless slip or drift become too large:

    >>> import grouser as gr
    >>> along = gr.Mission(
    ...     slope_deg=10.0,
    ...     stop={"slip_ratio": 0.4, "drift_m": {"above": 0.1}},
    ...     leg=[{"drive_m": 2.0, "heading": "contour"}],
    ... )
    >>> along.leg[0]["drive_m"], along.stop["drift_m"]["over_m"], along.soil.name
    (2.0, 1.0, 'Toyoura sand')
    >>> gr.mission(along).outcome
    'completed'
    """

    __slots__ = ()
    _kind = "mission"

    @property
    def scenario(self) -> Scenario:
        """Rover, ground, model and start as a scenario, which has a drive and a duration of its
        own."""
        own = ("schema", "leg", "alternative", "stop")
        items = {key: value for key, value in self._items.items() if key not in own}
        return Scenario._of(items, self._files)


class Design(_OnGround):
    """Numbers of a rover that are free between bounds, what is to be least, and what is limited.

    ``Design("design-lighter-wheels")`` is a preset, ``Design("my-design.toml")`` a file, and
    ``Design(free={…}, minimise=…, subject_to={…})`` gives its keys. ``free`` has keys of the rover,
    each with the least and the most that it may be; ``choose`` lists of numbers or names;
    ``subject_to`` limits, each with ``at_least`` or ``at_most``; ``also`` grounds on which limits
    hold as well. ``schema/design.json`` has all keys. `design` finds the numbers.

    Sources and errors are those of `Soil`.

    Examples
    --------
    >>> import grouser as gr
    >>> lighter = gr.Design(
    ...     minimise="wheel_mass_kg",
    ...     free={"rover.wheel_unit.wheel.radius_m": [0.06, 0.16]},
    ...     subject_to={"sinkage_ratio": {"at_most": 0.1}},
    ... )
    >>> lighter.rover.name, lighter.slope_deg
    ('HAKUTO', 10.0)
    """

    __slots__ = ()
    _kind = "design"


class Site(_Description, _keys.SiteKeys):
    """Where a rover drives: a plane of one soil on a slope, under a gravity.

    Parameters
    ----------
    soil : Soil, str, path or mapping
        The soil, or a source of one.
    slope_deg : float
        Inclination of the plane [°], 0 to 60; it rises along +y.
    gravity_m_s2 : float
        Gravity [m/s²], 0.01 to 30; see ``MOON_GRAVITY`` and ``MARS_GRAVITY``.

    Raises
    ------
    ParameterError
        For a value out of its range.

    Examples
    --------
    >>> import grouser as gr
    >>> crater = gr.Site("lunar-nominal", slope_deg=15.0, gravity_m_s2=gr.MOON_GRAVITY)
    >>> run = gr.simulate(site=crater, duration_s=2.0)
    >>> run.scenario.slope_deg, run.scenario.soil == crater.soil
    (15.0, True)
    """

    __slots__ = ()
    # A site has no document of its own: it is checked as a part of a scenario.
    _kind = "scenario"
    _KEYS: ClassVar[tuple[str, ...]] = ("soil", "slope_deg", "gravity_m_s2")

    def __init__(
        self,
        soil: Soil | Source,
        *,
        slope_deg: float = 0.0,
        gravity_m_s2: float = _core.EARTH_GRAVITY,
    ) -> None:
        soil = soil if isinstance(soil, Soil) else Soil(soil)
        keys = {"soil": soil, "slope_deg": slope_deg, "gravity_m_s2": gravity_m_s2}
        self._take(_core.read_document_table("scenario", "Site(…)", keys, {}, {}))

    def _take(self, document: _core.Document) -> None:
        items = document.to_dict()
        kept = {key: items[key] for key in self._KEYS}
        object.__setattr__(self, "_document", document)
        object.__setattr__(self, "_files", document.files)
        object.__setattr__(self, "_items", kept)
        object.__setattr__(self, "_toml", _core.to_toml("site", kept))

    def _keys(self) -> dict[str, Any]:
        return {**self._items, "soil": self.soil}

    @property
    def soil(self) -> Soil:
        """The soil."""
        return Soil._of(self._items["soil"], self._files)

    @classmethod
    def from_toml(cls, text: str, files: Mapping[str, str | Terrain] | None = None) -> Site:
        """A site from a TOML text with ``soil``, ``slope_deg`` and ``gravity_m_s2``, or from a
        scenario's.

        Parameters
        ----------
        text : str
            The document.
        files : mapping of str to str, optional
            The content of the files that it names, in the form of `files`.
        """
        if "schema" not in text.split("[", 1)[0]:
            text = 'schema = "scenario/1"\n' + text
        return Scenario.from_toml(text, files).site

    @classmethod
    def presets(cls) -> dict[str, str]:
        """Empty: there are no presets of sites."""
        return {}

    def replace(self, **changes: Any) -> Site:
        """The same with another soil, slope or gravity.

        Parameters
        ----------
        **changes
            ``soil``, ``slope_deg`` or ``gravity_m_s2``; a mapping for ``soil`` changes single keys.
        """
        for name in changes:
            if name not in self._KEYS:
                raise ParameterError(f"a Site has no {name}", name, None, ", ".join(self._KEYS))
        soil = changes.get("soil", self.soil)
        if isinstance(soil, Mapping):
            changes["soil"] = self.soil.replace(**soil)
        return Site(**{**self._keys(), **changes})

    def to_dict(self) -> dict[str, Any]:
        """Its three keys, the soil's as a table; a copy."""
        return {key: self._document.to_dict()[key] for key in self._KEYS}
