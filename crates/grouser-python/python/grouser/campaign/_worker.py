"""The task of a worker. It needs only the arguments of the call, and this package."""

from __future__ import annotations

import contextlib
import functools
import os
import uuid
from dataclasses import dataclass
from typing import Any, Protocol, Union

from .. import _core
from .._errors import ParameterError


class Writer(Protocol):
    """Writes a shard to its place. It is pickled and sent to workers."""

    def put(self, name: str, data: bytes) -> None:
        """Writes a file to its place: complete, or not at all."""


@functools.lru_cache(maxsize=2)
def _campaign(study: str) -> _core.Document:
    """A study that was read; cached, because workers compute many shards of one study."""
    return _core.read_document_text("campaign", "study.toml", study, {}, {})


def file_name(shard: int) -> str:
    """The name of a shard's file."""
    return f"part-{shard:06}.parquet"


def compute(study: str, shard: int, threads: int, writer: Writer | None) -> Union[bytes, int]:
    """Computes a shard: its bytes or, if the worker writes them, their number."""
    data = _core.campaign_shard(_campaign(study), shard, threads)
    if writer is None:
        return data
    writer.put(file_name(shard), data)
    return len(data)


@dataclass(frozen=True)
class FolderWriter:
    """Writes to a folder that all workers share."""

    folder: str

    def put(self, name: str, data: bytes) -> None:
        """Writes a temporary file beside the place, waits until it is on disk, and renames it."""
        # Processes on different machines may have the same number; a UUID is unique.
        beside = os.path.join(self.folder, f".{name}.partial-{uuid.uuid4().hex}")
        try:
            with open(beside, "xb") as file:
                file.write(data)
                file.flush()
                os.fsync(file.fileno())
            os.replace(beside, os.path.join(self.folder, name))
        except BaseException:
            with contextlib.suppress(OSError):
                os.remove(beside)
            raise


#: Stores in which an object appears complete or not at all, and moving is copying: a temporary
#: object would gain nothing.
WHOLE_OBJECTS = frozenset({"s3", "s3a", "gs", "gcs", "az", "abfs", "abfss", "adl", "oss", "memory"})


@dataclass(frozen=True)
class UrlWriter:
    """Writes to a URL of fsspec."""

    url: str
    options: tuple[tuple[str, Any], ...]

    def put(self, name: str, data: bytes) -> None:
        """Writes an object; in a store that shows unfinished objects, under another name, then
        moved."""
        files, folder = open_url(self.url, self.options)
        put(files, folder, name, data)


def put(files: Any, folder: str, name: str, data: bytes) -> None:
    """As `UrlWriter.put`, for a file system of fsspec."""
    place = f"{folder}/{name}"
    protocols = {files.protocol} if isinstance(files.protocol, str) else set(files.protocol)
    if protocols & WHOLE_OBJECTS:
        files.pipe_file(place, data)
        return
    beside = f"{folder}/.{name}.partial-{uuid.uuid4().hex}"
    try:
        files.pipe_file(beside, data)
        files.mv(beside, place)
    except BaseException:
        with contextlib.suppress(Exception):
            files.rm_file(beside)
        raise


def open_url(url: str, options: tuple[tuple[str, Any], ...]) -> tuple[Any, str]:
    """The file system of a URL, and the path in it."""
    try:
        import fsspec
    except ImportError as error:
        raise ImportError(
            "URLs need fsspec: pip install fsspec, and what your store needs, such as s3fs"
        ) from error
    try:
        files, path = fsspec.core.url_to_fs(url, **dict(options))
    except ValueError as error:
        raise ParameterError(f"{url}: {error}", "out", None, "a URL that fsspec knows") from error
    return files, str(path).rstrip("/")
