"""``python -m grouser import-telemetry``: logs of robots as telemetry, bags of ROS too."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from ._errors import DocumentUnreadableError, GrouserError
from ._telemetry import import_telemetry


def _choice(text: str) -> tuple[str, str]:
    what, separator, topic = text.partition("=")
    if not separator:
        raise argparse.ArgumentTypeError(f"{text!r} is not of the form TYPE=TOPIC")
    return what.strip(), topic.strip()


def _arguments(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m grouser",
        description="What needs packages of Python; all else is in the program `grouser`.",
    )
    commands = parser.add_subparsers(dest="command", required=True)
    command = commands.add_parser(
        "import-telemetry",
        help="convert a log of a drive to telemetry",
        description="Converts a bag of ROS 1 or ROS 2, or a log of MCAP, Parquet, Arrow or CSV, to "
        "the telemetry that `grouser learn` reads.",
    )
    command.add_argument(
        "log", metavar="LOG", nargs="+", help="the bag or the log; several files of one drive"
    )
    command.add_argument(
        "--out", required=True, metavar="FILE", help="the file to write: .csv or .parquet"
    )
    command.add_argument(
        "--mapping", metavar="FILE|NAME", help="which topics and fields are which columns"
    )
    command.add_argument(
        "--rover", metavar="NAME|FILE", help="the rover that was driven: a preset or a file"
    )
    command.add_argument(
        "--topic",
        dest="topics",
        action="append",
        default=[],
        type=_choice,
        metavar="TYPE=TOPIC",
        help="the topic that is meant where several have messages of a type; can be repeated",
    )
    command.add_argument(
        "--odometry",
        choices=["visual", "wheels", "fused", "motion-capture"],
        help="what measured ways and rotations, in place of what the mapping says",
    )
    command.add_argument("--force", action="store_true", help="replace the file if it is there")
    return parser.parse_args(arguments)


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; returns the exit code."""
    asked = _arguments(arguments)
    try:
        found = import_telemetry(
            asked.log,
            asked.out,
            asked.mapping,
            rover=asked.rover,
            topics=dict(asked.topics),
            odometry=asked.odometry,
            force=asked.force,
        )
    except (GrouserError, ImportError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        is_usage = isinstance(error, ValueError) and not isinstance(error, DocumentUnreadableError)
        return 2 if is_usage else 1
    for note in found.notes:
        print(f"note: {note}", file=sys.stderr)
    print(f"{found.records} records of telemetry", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
