"""``python -m grouser.campaign run STUDY --out DIR``: campaigns on processes, Dask or Ray, from a
shell.

The program's ``grouser campaign run --executor …`` calls this module. Flags, output and exit codes
are the program's: 0 done; 1 the run or the environment failed; 2 wrong use or a bad document; 3
some runs failed; 130 interrupted.
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

#: The least time between two lines of progress [s].
_BETWEEN_S = 1.0


def _arguments(given: Sequence[str] | None) -> argparse.Namespace:
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
    return parser.parse_args(given)


def _part(text: str) -> tuple[int, int]:
    index, slash, of = text.partition("/")
    if not (slash and index.isdigit() and of.isdigit() and 1 <= int(index) <= int(of)):
        raise argparse.ArgumentTypeError(f"{text!r} is not I/N with 1 <= I <= N")
    return int(index), int(of)


class _ProgressLine:
    """Prints the progress of a campaign: one line, overwritten, for people; a line each for
    programs."""

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
            now_as_json = {
                "schema": "grouser.campaign.progress.v1",
                "runs_done": now.runs_done,
                "runs": now.runs,
                "elapsed_s": now.elapsed_s,
                "runs_per_s": now.runs_per_s,
                "left_s": now.left_s,
            }
            print(json.dumps(now_as_json), flush=True)
        elif self._people:
            lost = f", {now.lost} given to other workers" if now.lost else ""
            left = f", {now.left_s:.0f} s left" if now.left_s is not None else ""
            text = (
                f"{now.runs_done} of {now.runs} runs, {now.runs_per_s:.0f} per second{left}{lost}"
            )
            print(f"\r\x1b[K{text}", end="", file=sys.stderr, flush=True)

    def end(self) -> None:
        """Ends the line."""
        if self._people and self.rate is not None:
            print(file=sys.stderr)


def _report(results: Results, line: _ProgressLine, format: str) -> int:
    """Prints the statuses of the runs; returns the exit code."""
    statuses, size = results.count()
    runs = sum(statuses.values())
    if format == "json":
        print(json.dumps(_answer(results, line, statuses, size), ensure_ascii=False))
    else:
        state = (
            f"is finished: {runs} runs, {line.rate:.0f} per second"
            if line.rate is not None
            else f"is finished, there is nothing to do: {runs} runs"
        )
        print(f"{results.location} {state}")
        print(", ".join(f"{status}: {count}" for status, count in statuses.items()))
        shards = results.shard_count
        files = "file" if shards == 1 else "files"
        print(f"{shards} {files}, {size / 1e6:.1f} MB, SHA-256 {results.digest}")
    failed = sum(count for status, count in statuses.items() if status in _core.FAILED_STATUSES)
    if failed:
        _print_error(f"{failed} of {runs} runs failed; the column `reason` says why")
    return 3 if failed else 0


def _answer(
    results: Results, line: _ProgressLine, statuses: dict[str, int], size: int
) -> dict[str, Any]:
    manifest = results.manifest
    return {
        "schema": "grouser.campaign.run.v1",
        "version": manifest["version"],
        "inputs": {
            "study": manifest["name"],
            **{key: manifest[key] for key in ("study_sha256", "seed", "runs", "part")},
        },
        "finished_before": line.rate is None,
        "digest": results.digest,
        "shards": results.shard_count,
        "bytes": size,
        "statuses": statuses,
        "runs_per_s": line.rate,
    }


def _print_error(message: object) -> None:
    print(f"error: {message}", file=sys.stderr)


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; returns the exit code."""
    asked = _arguments(arguments)
    line = _ProgressLine(asked.format)
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
            progress=line,
        )
        line.end()
        return _report(results, line, asked.format)
    except KeyboardInterrupt:
        line.end()
        print("interrupted: what was finished is kept; the same command goes on", file=sys.stderr)
        return 130
    except GrouserError as error:
        line.end()
        _print_error(error)
        environment = (CampaignDiskError, CampaignLockedError, DocumentUnreadableError)
        usage = isinstance(error, (ValueError, CampaignError)) and not isinstance(
            error, environment
        )
        # A campaign that another error ended: the arguments were right.
        ended = isinstance(error, CampaignError) and error.__cause__ is not None
        return 2 if usage and not ended else 1
    except (ImportError, OSError) as error:
        line.end()
        _print_error(error)
        return 1


if __name__ == "__main__":
    sys.exit(main())
