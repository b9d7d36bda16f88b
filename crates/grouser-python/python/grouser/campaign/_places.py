"""Where shards go: a folder that is locked, or a URL of fsspec."""

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
    """A campaign whose shards are all there."""

    digest: str
    shards: int
    bytes: int


class Place(Protocol):
    """Takes shards in, whoever computed them."""

    #: Damaged shards that are computed anew, each with what is wrong.
    faults: list[tuple[int, str]]

    def missing(self) -> Iterator[int]:
        """Shards that are not there, in order."""

    def shards(self) -> tuple[int, int]:
        """How many are there, and how many belong here."""

    def runs(self) -> tuple[int, int]:
        """How many runs are there, and how many belong here."""

    def accept(self, shard: int, data: bytes) -> None:
        """Takes a shard in."""

    def adopt(self, shard: int) -> None:
        """Takes a shard in that a worker has put in its place."""

    def writer(self) -> Writer:
        """What a worker puts shards in their place with."""

    def pause(self) -> None:
        """Writes down what was done."""

    def finish(self) -> Finished:
        """The digest of all shards."""

    def close(self) -> None:
        """Lets others have it."""


class FolderPlace:
    """A folder: locked, checked to the last bit, written to by rename."""

    def __init__(self, path: Location, campaign: Campaign, part: tuple[int, int] | None) -> None:
        self._folder = _core.CampaignFolder(path, campaign._document, part)
        self._files = Folder(path)
        self.faults = self._folder.faults()
        self._shards = len(_own(campaign, part))

    def missing(self) -> Iterator[int]:
        # Ranges: a list of all would be longer than memory for the largest campaigns.
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
    """What fsspec reaches: no lock, so that two programs may compute the same shards there. They
    write the same bytes, and what is lost is their time."""

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
        """The manifest that is there, or a new one."""
        fresh: dict[str, Any] = json.loads(_core.campaign_manifest(self._campaign._document, part))
        told = self._files.read(MANIFEST)
        if told is not None:
            return self._checked(told, fresh)
        stranger = next((name for name in self._files.names() if name not in (STUDY, RUNS)), None)
        if stranger is not None:
            raise CampaignError(
                f"{self._where} is not empty, and holds no campaign: {stranger} is in it"
            )
        self._files.make()
        self._files.put(STUDY, self._campaign.to_toml().encode())
        # Last: with it, this is a campaign's.
        self._files.put(MANIFEST, _json(fresh))
        return fresh

    def _checked(self, told: bytes, fresh: dict[str, Any]) -> dict[str, Any]:
        ours = self._campaign.to_toml().encode()
        theirs = self._files.read(STUDY)
        try:
            _core.CampaignManifest(told, self._files.where(MANIFEST))
        except CampaignError:
            # Damaged, or of a form without a hash. The study that is there says whether it is this one; every
            # shard is checked then.
            if theirs != ours:
                raise
            self._files.put(MANIFEST, _json(fresh))
            return fresh
        manifest: dict[str, Any] = json.loads(told)
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
        """Finds out which shards are there and whole. All of them are read for that."""
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
        """The bytes of a shard, whole; None if it is not there."""
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
    """The place at a location, made if it is not there."""
    if is_url(location):
        return UrlPlace(Url(str(location), options), campaign, part)
    return FolderPlace(location, campaign, part)


def _own(campaign: Campaign, part: tuple[int, int] | None) -> range:
    """The shards of a part."""
    index, of = part or (1, 1)
    return range(index - 1, campaign.shard_count, of)


def _runs_in(campaign: Campaign, shards: range) -> int:
    """How many runs some shards have. All but the last of the campaign are alike."""
    if not shards:
        return 0
    others = len(shards) - 1
    return others * len(campaign.runs_of(0)) + len(campaign.runs_of(shards[-1]))


def _number_of(name: str) -> int | None:
    """The shard that a file is named for."""
    digits = name[len("part-") : -len(".parquet")]
    shard = int(digits) if digits.isascii() and digits.isdigit() else None
    return shard if shard is not None and file_name(shard) == name else None


def _json(manifest: dict[str, Any]) -> bytes:
    """A manifest's file, with its hash of itself."""
    return _core.seal_manifest(json.dumps(manifest)).encode()


def _now() -> str:
    return datetime.now(timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
