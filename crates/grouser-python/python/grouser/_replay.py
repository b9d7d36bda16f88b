"""The telemetry of a drive beside what is predicted for it."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _tables
from ._arrays import whole_number
from ._descriptions import Scenario, Source
from ._errors import ParameterError
from ._studies import scenario_of
from ._telemetry import Files, budget_of, files_of

if TYPE_CHECKING:
    import pandas
    import xarray

#: A file of telemetry, or several of one drive, or its columns.
Log = Union[Files, Mapping[str, ArrayLike], "pandas.DataFrame"]


def replay(
    log: Log,
    scenario: Scenario | Source | None = None,
    /,
    *,
    slope_deg: float | None = None,
    from_s: float | None = None,
    to_s: float | None = None,
    odometry: str | None = None,
    max_unpacked_mib: int | None = None,
    uncertainty: bool = False,
    samples: int = 200,
    seed: int = 1,
    **changes: Any,
) -> xarray.Dataset:
    """What was measured over a drive beside what is predicted for it, channel by channel, and what
    the differences point to. The numbers are those of the program's ``grouser replay``, bit for
    bit; ``docs/guide/replay.md`` explains them.

    Parameters
    ----------
    log : path, list of paths, mapping of arrays, or pandas.DataFrame
        Telemetry: a file of CSV, Parquet, Arrow or MCAP, files of one drive, or columns by name
        (``time_s``, ``wheel_speed_rad_s_WHEEL``, ``roll_deg``, ``vo_dx_m``, …); NaN where nothing was read.
    scenario : Scenario, name, path or mapping, optional
        Its rover, soil, gravity, model and load transfer are used.
    slope_deg : float, optional
        Slope of the plane of the free run, and of the ground where the telemetry has neither roll
        nor pitch [°]; without it the median of the slopes that roll and pitch give.
    from_s, to_s : float, optional
        Replay the records from and up to these times alone [s], as if the log had no others.
    odometry : str, optional
        What measured ways and rotations, in place of what a mapping says: ``"visual"``,
        ``"wheels"`` (which show no slip, and are left out), ``"fused"`` with wheels, or
        ``"motion-capture"``.
    max_unpacked_mib : int, optional
        The most that is unpacked of a packed log [MiB], in place of 256 and 64 for each of its own.
    uncertainty : bool
        Whether bands are added over samples of the soil, as its document says, and of the
        wheel–soil model, where none is asked for by ``model``.
    samples, seed : int
        Number of samples, 2 to 100000, and their seed.
    **changes
        Keys of the scenario with other values: ``rover``, ``soil``, ``gravity_m_s2``, ``model``, …

    Returns
    -------
    xarray.Dataset
        Over ``time_s``, the end of each stretch of the way: ``measured_…``, the prediction under
        the quantity's own name, ``residual_…`` (measured less predicted), and with ``uncertainty``
        the quantiles ``…_p2_5``, ``…_p50`` and ``…_p97_5``; ``torque_nm`` and ``sinkage_mm`` over
        ``wheel``, too. Its ``attrs`` have ``points_to``, sentences on what the differences point
        to, ``findings`` and ``channels``, a mapping for each row of these tables, ``notes``,
        and ``files``, what the log and the files of documents gave.

    Raises
    ------
    ParameterError
        For columns that do not fit together, telemetry without a stretch to replay, and values out
        of their ranges.
    DocumentError, DocumentNotFoundError
        As `simulate`, and for telemetry that cannot be read.

    Examples
    --------
    A drive along 8°, whose encoders say a twentieth less than the wheels turned:

    >>> import grouser as gr
    >>> run = gr.simulate(slope_deg=8.0, model="ishigami", duration_s=60.0)
    >>> log = {"time_s": run.time_s, "x_m": run.x_m, "y_m": run.y_m, "yaw_deg": run.yaw_deg}
    >>> for k, name in enumerate(run.wheel_names):
    ...     log[f"wheel_speed_rad_s_{name}"] = run.wheel["wheel_speed_rad_s"][:, k] / 1.05
    ...     log[f"wheel_torque_nm_{name}"] = run.wheel["torque_nm"][:, k]
    >>> found = gr.replay(log, slope_deg=8.0, model="ishigami")
    >>> found.attrs["points_to"][0].split(":")[0]
    'speed'
    >>> found.torque_nm.dims
    ('time_s', 'wheel')
    """
    if slope_deg is not None:
        changes["slope_deg"] = slope_deg
    count = whole_number("samples", samples, most=100_000)
    if count < 2:
        raise ParameterError(f"samples is {count}, it must be from 2 to 100000", "samples")
    run = scenario_of(scenario, changes)
    paths, text = _source(log)
    drive = (slope_deg is not None, from_s, to_s)
    drawn = count if uncertainty else 0
    sampling, budget = (drawn, whole_number("seed", seed)), budget_of(max_unpacked_mib)
    tables, points_to, notes, wheels, files = _core.replay(
        run._document, paths, text, drive, sampling, (odometry, budget)
    )
    over_time, channels, findings = tables
    attrs = {
        "points_to": points_to,
        "findings": _rows(findings),
        "channels": _rows(channels),
        "notes": notes,
        "files": json.loads(files),
    }
    return _dataset(over_time, wheels, attrs)


def _source(log: Any) -> tuple[list[str], str | None]:
    """The files, or the text of a table in their place."""
    files = files_of(log)
    if files is not None:
        return files, None
    names = [str(name) for name in log]
    columns = [np.asarray(log[name], dtype=float) for name in log]
    lengths = {column.shape for column in columns}
    if len(lengths) != 1 or any(column.ndim != 1 for column in columns):
        shapes = ", ".join(f"{name} {column.shape}" for name, column in zip(names, columns))
        raise ParameterError(f"log has columns of shapes {shapes}, they must be of one length", "log")
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    cells = [["" if np.isnan(value) else repr(float(value)) for value in column] for column in columns]
    writer.writerows(zip(*cells))
    return [], text.getvalue()


def _rows(table: Mapping[str, Any]) -> list[dict[str, Any]]:
    """A table as a mapping for each row."""
    names = list(table)
    columns = [
        values.tolist() if isinstance(values, np.ndarray) else list(values)
        for values in table.values()
    ]
    return [dict(zip(names, row)) for row in zip(*columns)]


def _dataset(
    table: Mapping[str, Any], wheels: list[str], attrs: Mapping[str, Any]
) -> xarray.Dataset:
    """Columns over time; those of wheels together, over time and wheel."""
    import xarray

    whole: dict[str, Any] = {}
    of_wheels: dict[str, dict[str, NDArray[np.float64]]] = {}
    for name, values in table.items():
        wheel = next((it for it in wheels if name.startswith(f"{it}.")), None)
        if wheel is None:
            whole[name] = values
        else:
            of_wheels.setdefault(name[len(wheel) + 1 :], {})[wheel] = values
    time = whole.pop("time_s")
    missing = np.full(len(time), np.nan)
    variables = {name: _tables.variable(("time_s",), name, values) for name, values in whole.items()}
    for name, found in of_wheels.items():
        stacked = np.stack([found.get(wheel, missing) for wheel in wheels], axis=1)
        variables[name] = _tables.variable(("time_s", "wheel"), name, stacked)
    coords = {"time_s": _tables.variable(("time_s",), "time_s", time), "wheel": list(wheels)}
    return xarray.Dataset(variables, coords=coords, attrs=dict(attrs))
