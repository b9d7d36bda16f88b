"""Telemetry of a drive from logs of robots: bags of ROS, MCAP, Parquet and CSV."""

from __future__ import annotations

import dataclasses
import json
import math
import os
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Union

import numpy as np

from . import _core
from ._arrays import whole_number
from ._errors import DocumentError, DocumentNotFoundError, ParameterError
from ._studies import scenario_of

#: A file, or several of one drive.
Files = Union[str, "os.PathLike[str]", Sequence[Union[str, "os.PathLike[str]"]]]

#: How files begin whose messages this package decodes by `rosbags`.
_BAGS = (b"#ROSBAG V", b"SQLite format 3")


@dataclass(frozen=True)
class ImportedTelemetry:
    """What became of a log.

    Made by `import_telemetry`.
    """

    path: Path
    """The table."""
    records: int
    """Its rows."""
    notes: tuple[str, ...]
    """What of the log was left out, and why."""
    files: tuple[dict[str, Any], ...]
    """What the log, and a mapping of your own, gave: ``file``, ``content``, ``counted``, ``there``
    and ``used``, as ``inputs.files`` of the program's answers has them."""


def import_telemetry(
    log: Files,
    out: str | os.PathLike[str],
    mapping: str | os.PathLike[str] | None = None,
    *,
    rover: Any = None,
    topics: Mapping[str, str] | None = None,
    odometry: str | None = None,
    max_unpacked_mib: int | None = None,
    force: bool = False,
) -> ImportedTelemetry:
    """Converts a log of a drive to the telemetry that ``grouser learn`` reads.

    Bags of ROS 1, and of ROS 2 in SQLite or as a folder, are decoded by the package ``rosbags``
    (``pip install 'grouser[ros]'``); all other logs, those of MCAP with messages of ROS too, are
    read as the program's ``import-telemetry`` reads them. Memory does not grow with the log.

    Parameters
    ----------
    log : str or path, or a list of them
        A ``.bag`` of ROS 1, the folder or the file of a bag of ROS 2, or a log of MCAP, Parquet,
        Arrow or CSV; of these several files of one drive, too, or a folder of MCAP files.
    out : str or path
        The file to write: Parquet if its name ends with ``.parquet``, or else CSV.
    mapping : str or path, optional
        Which topics and fields are which columns: a file (``docs/guide/telemetry.md`` has its
        reference) or ``"ros"``, ``"foxglove"`` or ``"grouser"``. Without it the one of these that
        fits.
    rover : Rover, name, path or mapping, optional
        The rover that was driven, for the names of its wheels; without it that of the default
        scenario.
    topics : mapping of str to str, optional
        For a type of messages the topic that is meant, where several have it:
        ``{"sensor_msgs/Imu": "/imu/front"}``.
    odometry : str, optional
        What measured ways and rotations, in place of what a mapping says: ``"visual"``,
        ``"wheels"`` (which show no slip, and are left out), ``"fused"`` with wheels, or
        ``"motion-capture"``.
    max_unpacked_mib : int, optional
        The most that is unpacked of a packed log [MiB], in place of 256 and 64 for each of its own.
    force : bool
        Whether a file that is there is replaced.

    Returns
    -------
    ImportedTelemetry

    Raises
    ------
    DocumentError, DocumentNotFoundError
        For a log or a mapping that cannot be used; the message names the choices where several
        topics fit, and what to say where nothing says how the way of the rover was measured.
    ParameterError
        For a file that is there already.
    ImportError
        For a bag, without the package ``rosbags``.

    Examples
    --------
    >>> import os, tempfile
    >>> import grouser as gr
    >>> folder = tempfile.TemporaryDirectory()
    >>> log, out = (os.path.join(folder.name, name) for name in ("log.csv", "drive.parquet"))
    >>> with open(log, "w") as file:
    ...     _ = file.write("time_s,roll_deg\\n0.0,1.5\\n0.5,oops\\n1.0,1.6\\n")
    >>> found = gr.import_telemetry(log, out)
    >>> found.records, found.notes
    (3, ('1 cell of `roll_deg` is no number within its range, and counts as a gap',))
    >>> found.files[0]["there"], found.files[0]["used"]
    (3, 3)
    >>> folder.cleanup()
    """
    logs, out = [Path(it) for it in files_of(log) or []], Path(out)
    if out.exists() and not force:
        raise ParameterError(f"{out} exists already: force=True replaces it", "out")
    scenario = scenario_of(None, {} if rover is None else {"rover": rover})
    choices = [(str(what), str(topic)) for what, topic in (topics or {}).items()]
    path = None if mapping is None else os.fspath(mapping)
    settings = (scenario._document, path, choices, odometry)
    budget = budget_of(max_unpacked_mib)
    with _beside(out) as new:
        records, notes, files = _converted(logs, new, *settings, budget)
    return ImportedTelemetry(out, records, tuple(notes), tuple(json.loads(files)))


def files_of(log: Any) -> list[str] | None:
    """The paths of a log; nothing of what is no file and no list of files."""
    files = log if isinstance(log, (list, tuple)) else [log]
    if not files or not all(isinstance(it, (str, os.PathLike)) for it in files):
        return None
    return [os.fspath(it) for it in files]


def budget_of(max_unpacked_mib: int | None) -> int | None:
    """The budget of a packed log [MiB], checked."""
    if max_unpacked_mib is None:
        return None
    return whole_number("max_unpacked_mib", max_unpacked_mib, most=1 << 20)


@contextmanager
def _beside(out: Path) -> Iterator[Path]:
    """A file that takes the place of another when it is whole."""
    with tempfile.TemporaryDirectory(dir=out.absolute().parent) as folder:
        new = Path(folder) / out.name
        yield new
        os.replace(new, out)


def _converted(
    logs: list[Path],
    out: Path,
    rover: _core.Document,
    mapping: str | None,
    choices: list[tuple[str, str]],
    odometry: str | None,
    max_unpacked_mib: int | None,
) -> tuple[int, list[str], str]:
    for log in logs:
        if not log.exists():
            raise DocumentNotFoundError(f"{log}: there is no such file", str(log))
    if len(logs) != 1 or not _is_bag(logs[0]):
        try:
            settings = (rover, mapping, choices, (odometry, max_unpacked_mib))
            return _core.import_telemetry([str(it) for it in logs], out, *settings)
        except DocumentError as error:
            # Messages of ROS whose types are described in IDL, or nowhere, in an MCAP log.
            if error.key != "encoding" or len(logs) != 1:
                raise
    return _converted_bag(logs[0], out, rover, mapping, choices, odometry)


def _is_bag(log: Path) -> bool:
    if log.is_dir():
        return not any(it.suffix.lower() == ".mcap" for it in log.iterdir())
    with log.open("rb") as file:
        return file.read(16).startswith(_BAGS)


def _converted_bag(
    log: Path,
    out: Path,
    rover: _core.Document,
    mapping: str | None,
    choices: list[tuple[str, str]],
    odometry: str | None,
) -> tuple[int, list[str], str]:
    try:
        from rosbags.highlevel import AnyReader, AnyReaderError
        from rosbags.typesys import Stores, get_typestore
    except ImportError as error:
        raise ImportError(
            f"{log} is read by the package rosbags: pip install 'grouser[ros]'"
        ) from error
    # Bags of ROS 2 in SQLite may have names of types without what they are.
    usual = get_typestore(Stores.ROS2_HUMBLE)
    try:
        with AnyReader([log], default_typestore=usual) as reader:
            topics = sorted({(it.topic, it.msgtype) for it in reader.connections})
            rows = _core.TelemetryMessages(str(log), out, rover, mapping, topics, choices, odometry)
            wanted = [it for it in reader.connections if rows.wants(it.topic)]
            _add_all(reader, wanted, rows)
            return rows.finish()
    except AnyReaderError as error:
        raise DocumentError(f"{log}: no bag that can be read: {error}", str(log)) from error


def _add_all(reader: Any, wanted: list[Any], rows: _core.TelemetryMessages) -> None:
    """Adds the messages of some connections; one that cannot be decoded is counted."""
    if not wanted:
        return
    for connection, time, data in reader.messages(connections=wanted):
        try:
            message = reader.deserialize(data, connection.msgtype)
            text = json.dumps(_plain(message), allow_nan=False)
        except Exception:  # noqa: BLE001 - whatever a damaged message makes of the decoder
            rows.damaged()
            continue
        rows.add(connection.topic, time, text)


def _plain(value: Any) -> Any:
    """A message as lists and mappings: NaN is nothing, and bytes are left out."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        names = (field.name for field in dataclasses.fields(value))
        return {name: _plain(getattr(value, name)) for name in names if name != "__msgtype__"}
    if isinstance(value, np.ndarray):
        return None if value.dtype == np.uint8 else [_plain(it) for it in value.tolist()]
    if isinstance(value, (list, tuple)):
        return [_plain(it) for it in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else (None if math.isnan(value) else str(value))
    if isinstance(value, (bytes, bytearray)):
        return None
    return value
