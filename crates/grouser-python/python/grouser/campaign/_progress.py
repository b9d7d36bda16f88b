"""How far a campaign is."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Progress:
    """How far a campaign is, told after every shard."""

    shards_done: int
    """Shards that are there."""
    shards: int
    """All that belong here."""
    runs_done: int
    """Runs that are there."""
    runs: int
    """All that belong here."""
    elapsed_s: float
    """Since the start [s]."""
    runs_per_s: float
    """Runs that were computed since the start, per second; 0 before the first shard."""
    lost: int
    """Shards whose worker died; they were given to others."""

    @property
    def left_s(self) -> float | None:
        """The time that is left at this rate [s]; None before the first shard."""
        return (self.runs - self.runs_done) / self.runs_per_s if self.runs_per_s > 0 else None
