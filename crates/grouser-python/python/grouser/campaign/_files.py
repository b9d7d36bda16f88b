"""Files of a campaign, in a folder or under a URL of fsspec."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Protocol, Union

from .._errors import CampaignNotFoundError
from ._worker import FolderWriter, UrlWriter, Writer, open_url, put

#: Where a campaign is.
Location = Union[str, "os.PathLike[str]"]

MANIFEST = "manifest.json"
STUDY = "study.toml"
RUNS = "runs"


def is_url(location: Location) -> bool:
    """Whether fsspec has to reach it."""
    return isinstance(location, str) and "://" in location


class Files(Protocol):
    """What is needed of a folder, or of what looks like one."""

    location: str

    def read(self, name: str) -> bytes | None:
        """What a file has; None if there is none."""

    def names(self, folder: str = "") -> list[str]:
        """The names in a folder, sorted; none if it does not exist."""

    def writer(self) -> Writer:
        """What puts shards in their place."""


class Folder:
    """A folder of this machine, or of a disk that it shares."""

    def __init__(self, location: Location) -> None:
        self._path = Path(location)
        self.location = str(location)

    def read(self, name: str) -> bytes | None:
        try:
            return (self._path / name).read_bytes()
        except FileNotFoundError:
            return None

    def names(self, folder: str = "") -> list[str]:
        with contextlib.suppress(FileNotFoundError):
            return sorted(os.listdir(self._path / folder))
        return []

    def writer(self) -> Writer:
        return FolderWriter(str((self._path / RUNS).resolve()))


class Url:
    """What fsspec reaches."""

    def __init__(self, location: str, options: Mapping[str, Any] | None) -> None:
        self._options = tuple(sorted((options or {}).items()))
        self._files, self._path = open_url(location, self._options)
        self.location = location

    def read(self, name: str) -> bytes | None:
        try:
            data: bytes = self._files.cat_file(f"{self._path}/{name}")
            return data
        except FileNotFoundError:
            return None

    def names(self, folder: str = "") -> list[str]:
        # Other machines write there: what was listed before does not count.
        self._files.invalidate_cache()
        place = f"{self._path}/{folder}".rstrip("/")
        try:
            found = self._files.ls(place, detail=False)
        except FileNotFoundError:
            return []
        return sorted(str(path).rstrip("/").rsplit("/", 1)[-1] for path in found)

    def put(self, name: str, data: bytes) -> None:
        """Puts a file in its place: whole, or not at all."""
        folder, _, last = f"{self._path}/{name}".rpartition("/")
        put(self._files, folder, last, data)

    def remove(self, name: str) -> None:
        """Removes a file."""
        self._files.rm_file(f"{self._path}/{name}")

    def make(self) -> None:
        """Makes the folders, where a store has such."""
        self._files.makedirs(f"{self._path}/{RUNS}", exist_ok=True)

    def writer(self) -> Writer:
        return UrlWriter(f"{self.location.rstrip('/')}/{RUNS}", self._options)


def files_of(location: Location, options: Mapping[str, Any] | None) -> Files:
    """The files at a location."""
    return Url(str(location), options) if is_url(location) else Folder(location)


def need(files: Files, name: str) -> bytes:
    """A file that must be there."""
    data = files.read(name)
    if data is None:
        message = f"{files.location} holds no campaign: it has no {name}"
        raise CampaignNotFoundError(message, files.location)
    return data
