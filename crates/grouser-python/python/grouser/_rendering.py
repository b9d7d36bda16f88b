"""A rover on its slope, seen from above, as pictures of matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ._arrays import Floats

if TYPE_CHECKING:
    from ._descriptions import Rover

#: Size of a picture [inch], and its dots per inch.
_SIZE, _DPI = (6.0, 4.0), 100
#: What is shown around the rover, along the contour and uphill [m].
_AROUND = (1.5, 1.0)


class Camera:
    """Draws a rover, its path, and what it should follow: points, or without them the contour line
    through its start."""

    def __init__(self, rover: Rover, mode: str, route: Floats | None = None) -> None:
        from matplotlib.figure import Figure

        if mode == "human":
            import matplotlib.pyplot as plt

            self.figure: Any = plt.figure(figsize=_SIZE, dpi=_DPI)
        else:
            from matplotlib.backends.backend_agg import FigureCanvasAgg

            self.figure = Figure(figsize=_SIZE, dpi=_DPI)
            FigureCanvasAgg(self.figure)
        self.mode = mode
        self._route = route
        self.axes: Any = self.figure.add_subplot()
        self._mounts = np.array([mount["position_m"][:2] for mount in rover.mount])
        wheel = rover.wheel_unit["wheel"]
        radius, half = float(wheel["radius_m"]), 0.5 * float(wheel["width_m"])
        self._wheel = _rectangle(-radius, radius, -half, half)
        low, high = self._mounts.min(axis=0), self._mounts.max(axis=0)
        self._body = _rectangle(low[0], high[0], low[1] + half, high[1] - half)

    def draw(self, path: Floats, yaw_deg: float, title: str) -> None:
        """Draws the rover at the end of a path.

        Parameters
        ----------
        path : array of shape (places, 2)
            x along the contour and y uphill [m].
        """
        axes, yaw = self.axes, np.radians(yaw_deg)
        turned = np.array([[np.cos(yaw), np.sin(yaw)], [-np.sin(yaw), np.cos(yaw)]])
        axes.clear()
        if self._route is None:
            axes.axhline(0.0, color="0.6", lw=0.8, ls="--")
        else:
            axes.plot(self._route[:, 0], self._route[:, 1], color="0.6", lw=0.8, ls="--")
        axes.plot(path[:, 0], path[:, 1], lw=1.5)
        here = path[-1]
        axes.fill(*(self._body @ turned + here).T, color="0.75", ec="0.3")
        for mount in self._mounts:
            axes.fill(*((self._wheel + mount) @ turned + here).T, color="0.25")
        axes.set_xlim(here[0] - _AROUND[0], here[0] + _AROUND[0])
        axes.set_ylim(here[1] - _AROUND[1], here[1] + _AROUND[1])
        axes.set_aspect("equal")
        axes.set_xlabel("along the contour, x [m]")
        axes.set_ylabel("uphill, y [m]")
        axes.set_title(title)

    def pixels(self) -> NDArray[np.uint8]:
        """The picture: rows, columns, and red, green and blue from 0 to 255."""
        self.figure.canvas.draw()
        return np.array(self.figure.canvas.buffer_rgba(), dtype=np.uint8)[..., :3]

    def show(self) -> None:
        """Shows the picture in its window."""
        import matplotlib.pyplot as plt

        self.figure.canvas.draw_idle()
        plt.pause(1e-3)

    def close(self) -> None:
        """Closes the window, if there is one."""
        if self.mode == "human":
            import matplotlib.pyplot as plt

            plt.close(self.figure)


def _rectangle(left: float, right: float, low: float, high: float) -> Floats:
    return np.array([[left, low], [right, low], [right, high], [left, high]])
