"""``python -m grouser.campaign run STUDY --out DIR``: campaigns on processes, Dask or Ray, from a shell.

The program's ``grouser campaign run --executor …`` comes here. Flags, output and exit codes are the
program's: 0 done; 1 the run or the environment failed; 2 wrong use or a bad document; 3 some runs
failed; 130 interrupted.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Sequence
from typing import Any

from .. import _core
from .._errors import (
    CampaignDiskError,
    CampaignError,
    CampaignLockedError,
    DocumentUnreadableError,
    GrouserError,
)
from ._progress import Progress
from ._results import Results
from ._run import run
from ._study import Campaign

#: The least time between two lines for machines [s].
_BETWEEN_S = 1.0


def _arguments(words: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser("python -m grouser.campaign", description=__doc__)
    commands = parser.add_subparsers(required=True)
    command = commands.add_parser("run", help="compute what is missing of a campaign")
    add = command.add_argument
    add("study", metavar="STUDY", help="a campaign document's file or preset")
    add(
        "--out",
        metavar="DIR_OR_URL",
        required=True,
        help="folder, or URL of fsspec, for the results",
    )
    add("--executor", choices=["threads", "processes", "dask", "ray"], default="processes")
    add("--scheduler", metavar="ADDRESS", help="where the cluster's scheduler listens")
    add("--workers", metavar="N", type=int, help="how many workers to start on this machine")
    add("--shard", metavar="I/N", type=_part, help="only part I of N, counted from 1")
    add("--write", choices=["coordinator", "workers"], default="coordinator", help="who writes")
    add("--set", metavar="DOCUMENT.KEY=VALUE", action="append", default=[], dest="settings")
    add("--format", choices=["table", "json"], default="table")
    return parser.parse_args(words)


def _part(word: str) -> tuple[int, int]:
    index, slash, of = word.partition("/")
    if not (slash and index.isdigit() and of.isdigit() and 1 <= int(index) <= int(of)):
        raise argparse.ArgumentTypeError(f"{word!r} is not I/N with 1 <= I <= N")
    return int(index), int(of)


class _Teller:
    """Says how far the campaign is: a line that is written over for people, lines for machines."""

    def __init__(self, format: str) -> None:
        self._json = format == "json"
        self._people = not self._json and sys.stderr.isatty()
        self._last = float("-inf")
        self.rate: float | None = None

    def __call__(self, now: Progress) -> None:
        self.rate = now.runs_per_s
        if time.monotonic() - self._last < _BETWEEN_S and now.runs_done < now.runs:
            return
        self._last = time.monotonic()
        if self._json:
            line = {
                "schema": "grouser.campaign.progress.v1",
                "runs_done": now.runs_done,
                "runs": now.runs,
                "elapsed_s": now.elapsed_s,
                "runs_per_s": now.runs_per_s,
                "left_s": now.left_s,
            }
            print(json.dumps(line), flush=True)
        elif self._people:
            lost = f", {now.lost} given to other workers" if now.lost else ""
            left = f", {now.left_s:.0f} s left" if now.left_s is not None else ""
            text = (
                f"{now.runs_done} of {now.runs} runs, {now.runs_per_s:.0f} per second{left}{lost}"
            )
            print(f"\r\x1b[K{text}", end="", file=sys.stderr, flush=True)

    def end(self) -> None:
        """Leaves the line."""
        if self._people and self.rate is not None:
            print(file=sys.stderr)


def _report(results: Results, teller: _Teller, format: str) -> int:
    """Says what was found; the exit code."""
    statuses, size = results.count()
    runs = sum(statuses.values())
    if format == "json":
        print(json.dumps(_answer(results, teller, statuses, size), ensure_ascii=False))
    else:
        state = (
            f"is finished: {runs} runs, {teller.rate:.0f} per second"
            if teller.rate is not None
            else f"is finished, there is nothing to do: {runs} runs"
        )
        print(f"{results.location} {state}")
        print(", ".join(f"{word}: {count}" for word, count in statuses.items()))
        shards = results.shard_count
        files = "file" if shards == 1 else "files"
        print(f"{shards} {files}, {size / 1e6:.1f} MB, SHA-256 {results.digest}")
    failed = sum(count for word, count in statuses.items() if word in _core.FAILED_STATUSES)
    if failed:
        _say(f"{failed} of {runs} runs failed; the column `reason` says why")
    return 3 if failed else 0


def _answer(
    results: Results, teller: _Teller, statuses: dict[str, int], size: int
) -> dict[str, Any]:
    manifest = results.manifest
    return {
        "schema": "grouser.campaign.run.v1",
        "version": manifest["version"],
        "inputs": {
            "study": manifest["name"],
            **{key: manifest[key] for key in ("study_sha256", "seed", "runs", "part")},
        },
        "finished_before": teller.rate is None,
        "digest": results.digest,
        "shards": results.shard_count,
        "bytes": size,
        "statuses": statuses,
        "runs_per_s": teller.rate,
    }


def _say(message: object) -> None:
    print(f"error: {message}", file=sys.stderr)


def main(words: Sequence[str] | None = None) -> int:
    """Does what is asked; the exit code."""
    asked = _arguments(words)
    teller = _Teller(asked.format)
    try:
        campaign = Campaign._of_document(_core.find_campaign(asked.study, asked.settings))
        results = run(
            campaign,
            out=asked.out,
            executor=asked.executor,
            scheduler=asked.scheduler,
            workers=asked.workers,
            part=asked.shard,
            write=asked.write,
            progress=teller,
        )
        teller.end()
        return _report(results, teller, asked.format)
    except KeyboardInterrupt:
        teller.end()
        print("interrupted: what was finished is kept; the same command goes on", file=sys.stderr)
        return 130
    except GrouserError as error:
        teller.end()
        _say(error)
        environment = (CampaignDiskError, CampaignLockedError, DocumentUnreadableError)
        usage = isinstance(error, (ValueError, CampaignError)) and not isinstance(
            error, environment
        )
        # A campaign that something else ended: nobody asked wrongly.
        ended = isinstance(error, CampaignError) and error.__cause__ is not None
        return 2 if usage and not ended else 1
    except (ImportError, OSError) as error:
        teller.end()
        _say(error)
        return 1


if __name__ == "__main__":
    sys.exit(main())
