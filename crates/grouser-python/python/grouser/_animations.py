"""Runs as moving pictures."""

from __future__ import annotations

import html
import os
from collections.abc import Sequence
from pathlib import Path

from . import _core
from ._descriptions import Mission, Scenario
from ._errors import ParameterError


class Animation:
    """Runs as a moving picture: rovers on their slope, with tracks, forces and a few numbers.

    Made by `Trajectory.animate`. In a notebook it is a player.

    Examples
    --------
    >>> import grouser as gr
    >>> run = gr.simulate(slope_deg=15.0, duration_s=1.0)
    >>> animation = run.animate()
    >>> animation.to_bytes("glb")[:4]
    b'glTF'
    """

    def __init__(self, runs: Sequence[tuple[Scenario | Mission, str]], names: Sequence[str]) -> None:
        """
        Parameters
        ----------
        runs
            A scenario, or a mission with the name of its alternative, empty where it has none.
        names
            What the runs are called.
        """
        if len(names) != len(runs):
            raise ParameterError(
                f"names has {len(names)} entries, it must be one for each of {len(runs)} runs",
                "names",
            )
        self._runs = tuple(runs)
        self._names = tuple(names)

    def to_bytes(self, form: str) -> bytes:
        """The animation in a form.

        Parameters
        ----------
        form : {"gif", "mp4", "html", "glb", "svg", "png"}
            Pictures, a film (by an installed ffmpeg), a page with a player, a scene in three
            dimensions (glTF 2.0); or the end of the run as one picture.

        Raises
        ------
        ParameterError
            For another form.
        FileNotFoundError
            For a film where ffmpeg is not installed.
        """
        return self._drawn(Path(f"run.{form}"))

    def to_html(self) -> str:
        """A page with a player, which needs no other file."""
        return self.to_bytes("html").decode()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the animation; the ending of the name decides the form.

        Parameters
        ----------
        path : path
            A file that ends in ``.gif``, ``.mp4``, ``.html``, ``.glb``, ``.svg`` or ``.png``. A
            file that is there already is replaced.

        Raises
        ------
        ParameterError
            For another ending.
        FileNotFoundError
            For a film where ffmpeg is not installed.
        """
        Path(path).write_bytes(self._drawn(Path(path)))

    def _drawn(self, path: Path) -> bytes:
        sources = [(source._document, alternative) for source, alternative in self._runs]
        return _core.animation(sources, list(self._names), path)

    def _repr_html_(self) -> str:
        # A frame keeps the styles of page and player apart.
        page = html.escape(self.to_html())
        height = 36 + 4 * len(self._runs)
        return (
            f'<iframe srcdoc="{page}" title="Animation of a run" sandbox="allow-scripts" '
            f'style="width: 100%; max-width: 62rem; height: {height}rem; border: 0"></iframe>'
        )

    def __repr__(self) -> str:
        return f"<Animation of {', '.join(self._names)}>"
