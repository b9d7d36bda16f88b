"""The progress of a campaign."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Progress:
    """The progress of a campaign, reported after every shard.

    Made by `run`, for its argument ``progress``.
    """

    shards_done: int
    """Number of finished shards."""
    shards: int
    """Number of all shards of the campaign, or of its part."""
    runs_done: int
    """Number of finished runs."""
    runs: int
    """Number of all runs of the campaign, or of its part."""
    elapsed_s: float
    """Time since the start [s]."""
    runs_per_s: float
    """Runs computed since the start, per second; 0 before the first shard."""
    lost: int
    """Number of shards whose worker died; other workers compute them again."""

    @property
    def left_s(self) -> float | None:
        """Remaining time at this rate [s]; None before the first shard."""
        return (self.runs - self.runs_done) / self.runs_per_s if self.runs_per_s > 0 else None
