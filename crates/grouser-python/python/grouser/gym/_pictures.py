"""Pictures of the rovers of an environment, from above."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from .._errors import ParameterError
from .._rendering import Camera
from ._rovers import Rovers, places


class Pictures:
    """Pictures of rovers from above, with the path of each since its episode started."""

    def __init__(self, rovers: Rovers, mode: str | None) -> None:
        self._rovers = rovers
        self._mode = mode
        self._camera: Camera | None = None
        #: Where each rover was since its episode started.
        self.paths: list[list[tuple[float, float]]] = [[] for _ in range(len(rovers.batch))]

    def start(self, which: NDArray[np.bool_]) -> None:
        """Forgets the paths of some rovers."""
        for k in places(which):
            self.paths[k] = []

    def add(self, which: NDArray[np.bool_]) -> None:
        """Adds the places of some rovers to their paths, if there are pictures."""
        if self._mode is None:
            return
        state = self._rovers.batch.state
        for k in places(which):
            self.paths[k].append((float(state[k, 0]), float(state[k, 1])))

    def drawn(self, k: int) -> Camera:
        """The camera, with rover k before it."""
        if not self.paths[k]:
            raise gymnasium.error.ResetNeeded("reset the environment before it is rendered")
        batch = self._rovers.batch
        if self._camera is None:
            try:
                rover = batch.scenarios[0].rover
                self._camera = Camera(rover, str(self._mode), self._rovers.route)
            except ImportError as error:
                raise gymnasium.error.DependencyNotInstalled(
                    "rendering needs matplotlib: pip install matplotlib"
                ) from error
        outcome = self._rovers.outcome(k)
        title = f"slope {self._rovers.slope_deg[k]:.1f}°, {batch.time_s[k]:.1f} s"
        title += f", {outcome}" if outcome else ""
        yaw_deg = float(batch.state[k, batch.STATE.index("yaw_deg")])
        self._camera.draw(np.array(self.paths[k]), yaw_deg, title)
        return self._camera

    def __getstate__(self) -> dict[str, Any]:
        # A copy opens a window of its own when it is first drawn.
        return {**self.__dict__, "_camera": None}

    def close(self) -> None:
        if self._camera is not None:
            self._camera.close()
            self._camera = None


def check_render_mode(mode: str | None, modes: Sequence[str]) -> None:
    if mode not in (None, *modes):
        known = f"{', '.join(map(repr, modes))} or None"
        raise ParameterError(
            f"render_mode is {mode!r}, it must be {known}", "render_mode", None, known
        )
