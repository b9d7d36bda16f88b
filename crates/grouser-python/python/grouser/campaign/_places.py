"""The destination of shards: a folder that is locked, or a URL of fsspec."""

from __future__ import annotations

import hashlib
import itertools
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from datetime import datetime, timezone
from typing import Any, Protocol

from .. import _core
from .._errors import CampaignError
from ._files import MANIFEST, RUNS, STUDY, Folder, Location, Url, is_url
from ._study import Campaign
from ._worker import Writer, file_name


@dataclass(frozen=True)
class Finished:
    """A campaign whose shards are all finished."""

    digest: str
    shards: int
    bytes: int


class Place(Protocol):
    """Collects shards of any worker."""

    #: Damaged shards, which are computed again, each with its fault.
    faults: list[tuple[int, str]]

    def missing(self) -> Iterator[int]:
        """Missing shards, in order."""

    def shards(self) -> tuple[int, int]:
        """Numbers of finished shards and of all shards."""

    def runs(self) -> tuple[int, int]:
        """Numbers of finished runs and of all runs."""

    def accept(self, shard: int, data: bytes) -> None:
        """Adds a shard."""

    def adopt(self, shard: int) -> None:
        """Counts a shard that a worker has written to its place."""

    def writer(self) -> Writer:
        """The writer for workers."""

    def pause(self) -> None:
        """Writes the session to the manifest."""

    def finish(self) -> Finished:
        """The digest of all shards."""

    def close(self) -> None:
        """Unlocks the destination."""


class FolderPlace:
    """A locked folder: every bit is checked, files are written by rename."""

    def __init__(self, path: Location, campaign: Campaign, part: tuple[int, int] | None) -> None:
        self._folder = _core.CampaignFolder(path, campaign._document, part)
        self._files = Folder(path)
        self.faults = self._folder.faults()
        self._shards = len(_own(campaign, part))

    def missing(self) -> Iterator[int]:
        # Ranges: a list of all shards would not fit into memory for the largest campaigns.
        ranges = self._folder.missing()
        return itertools.chain.from_iterable(
            range(first, first + step * count, step) for first, step, count in ranges
        )

    def shards(self) -> tuple[int, int]:
        return self._shards - self._folder.missing_count(), self._shards

    def runs(self) -> tuple[int, int]:
        return self._folder.runs()

    def accept(self, shard: int, data: bytes) -> None:
        self._folder.accept(shard, data)

    def adopt(self, shard: int) -> None:
        self._folder.adopt(shard)

    def writer(self) -> Writer:
        return self._files.writer()

    def pause(self) -> None:
        self._folder.pause()

    def finish(self) -> Finished:
        return Finished(*self._folder.finish())

    def close(self) -> None:
        self._folder.close()


class UrlPlace:
    """A URL of fsspec: there is no lock, so two programs may compute the same shards. They write
    the same bytes, and only time is lost."""

    def __init__(self, files: Url, campaign: Campaign, part: tuple[int, int] | None) -> None:
        self._files = files
        self._campaign = campaign
        self._own = _own(campaign, part)
        self._there: set[int] = set()
        self._in_session = False
        self.faults: list[tuple[int, str]] = []
        self._manifest = self._open(part)
        self._check_shards()

    def _open(self, part: tuple[int, int] | None) -> dict[str, Any]:
        """The existing manifest, or a new one."""
        fresh: dict[str, Any] = json.loads(_core.campaign_manifest(self._campaign._document, part))
        found = self._files.read(MANIFEST)
        if found is not None:
            return self._checked(found, fresh)
        stranger = next((name for name in self._files.names() if name not in (STUDY, RUNS)), None)
        if stranger is not None:
            raise CampaignError(
                f"{self._where} is not empty, and holds no campaign: {stranger} is in it"
            )
        self._files.make()
        self._files.put(STUDY, self._campaign.to_toml().encode())
        # Last: the manifest makes this the location of a campaign.
        self._files.put(MANIFEST, _json(fresh))
        return fresh

    def _checked(self, found: bytes, fresh: dict[str, Any]) -> dict[str, Any]:
        ours = self._campaign.to_toml().encode()
        theirs = self._files.read(STUDY)
        try:
            _core.CampaignManifest(found, self._files.where(MANIFEST))
        except CampaignError:
            # Damaged, or of a form without a hash. It is renewed if the study is the same; every
            # shard is checked then.
            if theirs != ours:
                raise
            self._files.put(MANIFEST, _json(fresh))
            return fresh
        manifest: dict[str, Any] = json.loads(found)
        version, study, part = (manifest[key] for key in ("version", "study_sha256", "part"))
        if study != fresh["study_sha256"]:
            text = (theirs or b"").decode(errors="replace")
            difference = _core.study_difference(text, self._campaign.to_toml())
            raise CampaignError(f"{self._where} has the runs of another study: {difference}")
        if version != fresh["version"]:
            raise CampaignError(
                f"{self._where} has runs of grouser {version}, this is {fresh['version']}: "
                "their numbers may differ"
            )
        if part != fresh["part"]:
            raise CampaignError(f"{self._where} is for another part of the campaign")
        if theirs != ours:
            self._files.put(STUDY, ours)
        return manifest

    @property
    def _where(self) -> str:
        return self._files.location

    def _check_shards(self) -> None:
        """Finds the shards that are complete. All of them are read for that."""
        for name in self._files.names(RUNS):
            if name.startswith("."):
                if ".partial-" in name:
                    self._files.remove(f"{RUNS}/{name}")
            elif name.endswith(".parquet"):
                shard = _number_of(name)
                if shard is None or shard not in self._own:
                    raise CampaignError(
                        f"{self._where}/{RUNS}/{name} is no shard of this campaign: move it away"
                    )
                self._check(shard)

    def _check(self, shard: int) -> None:
        try:
            if self._read(shard) is not None:
                self._there.add(shard)
        except CampaignError as error:
            self.faults.append((shard, str(error)))

    def _read(self, shard: int) -> bytes | None:
        """The checked bytes of a shard; None if it is missing."""
        most = _core.most_shard_bytes(self._campaign._document, shard)
        data = self._files.read(f"{RUNS}/{file_name(shard)}", most)
        if data is not None:
            _core.check_shard(self._campaign._document, shard, data)
        return data

    def missing(self) -> Iterator[int]:
        return (shard for shard in self._own if shard not in self._there)

    def shards(self) -> tuple[int, int]:
        return len(self._there), len(self._own)

    def runs(self) -> tuple[int, int]:
        done = sum(len(self._campaign.runs_of(shard)) for shard in self._there)
        return done, _runs_in(self._campaign, self._own)

    def accept(self, shard: int, data: bytes) -> None:
        if shard in self._there:
            return
        _core.check_shard(self._campaign._document, shard, data)
        self._begin_session()
        self._files.put(f"{RUNS}/{file_name(shard)}", data)
        self._count(shard)

    def adopt(self, shard: int) -> None:
        # It is read once, with all others, when the campaign is finished.
        self._begin_session()
        self._count(shard)

    def _count(self, shard: int) -> None:
        self._there.add(shard)
        self._manifest["sessions"][-1]["shards"] += 1

    def _begin_session(self) -> None:
        if not self._in_session:
            self._manifest["sessions"].append({"started": _now(), "ended": None, "shards": 0})
            self._files.put(MANIFEST, _json(self._manifest))
            self._in_session = True

    def writer(self) -> Writer:
        return self._files.writer()

    def pause(self) -> None:
        if self._in_session:
            self._manifest["sessions"][-1]["ended"] = _now()
            self._files.put(MANIFEST, _json(self._manifest))

    def finish(self) -> Finished:
        digest, size = hashlib.sha256(), 0
        for shard in self._own:
            data = self._read(shard)
            if data is None:
                raise CampaignError(
                    f"shard {shard} is missing in {self._where}: run the campaign again"
                )
            digest.update(data)
            size += len(data)
        found, recorded = digest.hexdigest(), self._manifest["digest"]
        if recorded not in (None, found):
            raise CampaignError(f"{self._where}: its digest was {recorded}, now it is {found}")
        if recorded is None:
            self._manifest["digest"] = found
            self._files.put(MANIFEST, _json(self._manifest))
        self.pause()
        return Finished(found, len(self._own), size)

    def close(self) -> None:
        """There is no lock."""


def place_of(
    location: Location,
    options: Mapping[str, Any] | None,
    campaign: Campaign,
    part: tuple[int, int] | None,
) -> Place:
    """The destination at a location, made if it does not exist."""
    if is_url(location):
        return UrlPlace(Url(str(location), options), campaign, part)
    return FolderPlace(location, campaign, part)


def _own(campaign: Campaign, part: tuple[int, int] | None) -> range:
    """The shards of a part."""
    index, of = part or (1, 1)
    return range(index - 1, campaign.shard_count, of)


def _runs_in(campaign: Campaign, shards: range) -> int:
    """Number of runs of some shards. All but the last shard of the campaign have the same
    number."""
    if not shards:
        return 0
    others = len(shards) - 1
    return others * len(campaign.runs_of(0)) + len(campaign.runs_of(shards[-1]))


def _number_of(name: str) -> int | None:
    """The shard that the name of a file gives."""
    digits = name[len("part-") : -len(".parquet")]
    shard = int(digits) if digits.isascii() and digits.isdigit() else None
    return shard if shard is not None and file_name(shard) == name else None


def _json(manifest: dict[str, Any]) -> bytes:
    """A manifest's file, with its hash of itself."""
    return _core.seal_manifest(json.dumps(manifest)).encode()


def _now() -> str:
    return datetime.now(timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
