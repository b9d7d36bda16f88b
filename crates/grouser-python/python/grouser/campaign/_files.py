"""Files of a campaign, in a folder or under a URL of fsspec."""

from __future__ import annotations

import contextlib
import os
import stat
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Protocol, Union

from .._errors import CampaignError, CampaignNotFoundError
from ._worker import FolderWriter, UrlWriter, Writer, open_url, put

#: Folder or URL of a campaign.
Location = Union[str, "os.PathLike[str]"]

MANIFEST = "manifest.json"
STUDY = "study.toml"
RUNS = "runs"
#: The most bytes of a manifest or of a resolved study: samples are in it.
MOST_BYTES = 1 << 30


def is_url(location: Location) -> bool:
    """Whether a location is a URL of fsspec."""
    return isinstance(location, str) and "://" in location


class Files(Protocol):
    """Access to the files of a folder or a URL."""

    location: str

    def read(self, name: str, most: int = MOST_BYTES) -> bytes | None:
        """The content of a file; None if it does not exist. Type and size are checked before it is
        opened: a pipe or a device has no end, and a file longer than `most` bytes is not one of a
        campaign."""

    def where(self, name: str) -> str:
        """The name of a file in messages."""

    def names(self, folder: str = "") -> list[str]:
        """The names in a folder, sorted; empty if it does not exist."""

    def writer(self) -> Writer:
        """The writer of shards."""


class Folder:
    """A folder of this machine, or of a shared disk."""

    def __init__(self, location: Location) -> None:
        self._path = Path(location)
        self.location = str(location)

    def read(self, name: str, most: int = MOST_BYTES) -> bytes | None:
        path = self._path / name
        try:
            about = path.stat()
            if not stat.S_ISREG(about.st_mode):
                raise _not_regular(self.where(name))
            _check_size(self.where(name), about.st_size, most)
            with path.open("rb") as file:
                # It may grow meanwhile: one byte more than allowed shows that.
                data = file.read(most + 1)
        except FileNotFoundError:
            return None
        _check_size(self.where(name), len(data), most)
        return data

    def where(self, name: str) -> str:
        return str(self._path / name)

    def names(self, folder: str = "") -> list[str]:
        with contextlib.suppress(FileNotFoundError):
            return sorted(os.listdir(self._path / folder))
        return []

    def writer(self) -> Writer:
        return FolderWriter(str((self._path / RUNS).resolve()))


class Url:
    """A location that fsspec reads and writes."""

    def __init__(self, location: str, options: Mapping[str, Any] | None) -> None:
        self._options = tuple(sorted((options or {}).items()))
        self._files, self._path = open_url(location, self._options)
        self.location = location

    def read(self, name: str, most: int = MOST_BYTES) -> bytes | None:
        place = f"{self._path}/{name}"
        try:
            about = self._files.info(place)
            if about.get("type", "file") != "file":
                raise _not_regular(self.where(name))
            if about.get("size") is not None:
                _check_size(self.where(name), about["size"], most)
            data: bytes = self._files.cat_file(place)
        except FileNotFoundError:
            return None
        return data

    def where(self, name: str) -> str:
        return f"{self.location.rstrip('/')}/{name}"

    def names(self, folder: str = "") -> list[str]:
        # Other machines write there: an earlier listing is out of date.
        self._files.invalidate_cache()
        place = f"{self._path}/{folder}".rstrip("/")
        try:
            found = self._files.ls(place, detail=False)
        except FileNotFoundError:
            return []
        return sorted(str(path).rstrip("/").rsplit("/", 1)[-1] for path in found)

    def put(self, name: str, data: bytes) -> None:
        """Writes a file to its place: complete, or not at all."""
        folder, _, last = f"{self._path}/{name}".rpartition("/")
        put(self._files, folder, last, data)

    def remove(self, name: str) -> None:
        """Removes a file."""
        self._files.rm_file(f"{self._path}/{name}")

    def make(self) -> None:
        """Makes the folders, if a store has folders."""
        self._files.makedirs(f"{self._path}/{RUNS}", exist_ok=True)

    def writer(self) -> Writer:
        return UrlWriter(f"{self.location.rstrip('/')}/{RUNS}", self._options)


def files_of(location: Location, options: Mapping[str, Any] | None) -> Files:
    """The files at a location."""
    return Url(str(location), options) if is_url(location) else Folder(location)


def _not_regular(file: str) -> CampaignError:
    return CampaignError(f"{file}: it is not a regular file")


def _check_size(file: str, size: int, most: int) -> None:
    if size > most:
        raise CampaignError(
            f"{file}: the file has {size} bytes, more than the {most} that it may have in this campaign"
        )


def need(files: Files, name: str, most: int = MOST_BYTES) -> bytes:
    """The content of a file that must exist."""
    data = files.read(name, most)
    if data is None:
        message = f"{files.location} holds no campaign: it has no {name}"
        raise CampaignNotFoundError(message, files.location)
    return data
