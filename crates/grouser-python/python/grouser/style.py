"""One style of figures for matplotlib: that of the program's pictures and reports.

Colours stay apart for colour-blind eyes, there is a light and a dark form, and curves have their
names at their ends instead of in a box.

Examples
--------
>>> import grouser as gr
>>> with gr.style.context():
...     axes = gr.heading(slope_deg=[5, 10, 15]).plot(label="Toyoura sand")
...     axes = gr.style.name_curves(axes)
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    from matplotlib.axes import Axes

__all__ = ["colours", "context", "name_curves", "rc_params", "use"]


def colours(*, dark: bool = False) -> dict[str, list[str]]:
    """The colours of all pictures, by what they stand for.

    Parameters
    ----------
    dark : bool
        Those for a dark screen.

    Returns
    -------
    dict
        Lists of codes such as ``"#0072b2"``: ``"series"`` has the colours of curves in their order,
        ``"ink"``, ``"paper"``, ``"faint"`` and ``"grid"`` one each.

    Examples
    --------
    >>> import grouser as gr
    >>> gr.style.colours()["series"][1]
    '#0072b2'
    """
    return _core.style_colours(dark)


def rc_params(*, dark: bool = False) -> dict[str, Any]:
    """The settings of matplotlib that make the style.

    Parameters
    ----------
    dark : bool
        For a dark screen.

    Returns
    -------
    dict
        For ``matplotlib.rcParams``.

    Examples
    --------
    >>> import grouser as gr
    >>> light, dark = (gr.style.rc_params(dark=it)["figure.facecolor"] for it in (False, True))
    >>> light != dark                                               # colours as matplotlib writes them
    True
    """
    from cycler import cycler

    found = colours(dark=dark)
    [ink], [paper], [faint], [grid] = (found[name] for name in ("ink", "paper", "faint", "grid"))
    # The first colour is that of text.
    series = found["series"][1:]
    return {
        "figure.figsize": (7.0, 3.8),
        "figure.dpi": 160,
        "figure.constrained_layout.use": True,
        "figure.facecolor": paper,
        "savefig.facecolor": paper,
        "axes.facecolor": paper,
        "axes.edgecolor": faint,
        "axes.labelcolor": ink,
        "axes.titlecolor": ink,
        "axes.grid": True,
        "axes.axisbelow": True,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.prop_cycle": cycler(color=series),
        "font.size": 10,
        "grid.color": grid,
        "grid.linewidth": 0.6,
        "legend.frameon": False,
        "lines.linewidth": 1.8,
        "text.color": ink,
        "xtick.color": faint,
        "xtick.labelcolor": ink,
        "ytick.color": faint,
        "ytick.labelcolor": ink,
        "image.cmap": "viridis",
    }


def use(*, dark: bool = False) -> None:
    """Makes the style that of all figures from now on.

    Parameters
    ----------
    dark : bool
        For a dark screen.

    Examples
    --------
    >>> import grouser as gr
    >>> import matplotlib as mpl
    >>> with mpl.rc_context():                                      # only so that it ends here
    ...     gr.style.use()
    ...     bool(mpl.rcParams["axes.grid"])
    True
    """
    import matplotlib as mpl

    # matplotlib's own types know its keys one by one.
    settings: Any = rc_params(dark=dark)
    mpl.rcParams.update(settings)


def context(*, dark: bool = False) -> AbstractContextManager[None]:
    """The style for the figures made within a ``with`` block.

    Parameters
    ----------
    dark : bool
        For a dark screen.

    Returns
    -------
    context manager
        That of ``matplotlib.rc_context``.

    Examples
    --------
    >>> import grouser as gr
    >>> import matplotlib.pyplot as plt
    >>> with gr.style.context():
    ...     axes = plt.subplots()[1]
    >>> gr.simulate(duration_s=1.0).plot(axes).get_xlabel()
    'along the contour, x [m]'
    """
    import matplotlib as mpl

    settings: Any = rc_params(dark=dark)
    return mpl.rc_context(settings)


def name_curves(axes: Axes | None = None) -> Axes:
    """Writes the label of each curve at its end, in its colour, so that no legend is needed.

    Labels that would overlap are moved apart. Call it when all curves are drawn and the limits of
    the axes stand.

    Parameters
    ----------
    axes : matplotlib.axes.Axes, optional
        Without it the current ones.

    Returns
    -------
    matplotlib.axes.Axes
        The same axes.

    Examples
    --------
    >>> import grouser as gr
    >>> import matplotlib.pyplot as plt
    >>> axes = plt.subplots()[1]
    >>> for name in ("toyoura", "lunar-nominal"):
    ...     level = gr.heading(soil=name, slope_deg=[5, 10, 15], nominal=True)
    ...     axes = level.plot(axes, label=name)
    >>> [text.get_text() for text in gr.style.name_curves(axes).texts]
    ['lunar-nominal', 'toyoura']
    """
    if axes is None:
        import matplotlib.pyplot as plt

        axes = plt.gca()
    # matplotlib sets limits when somebody asks for them.
    axes.get_xlim(), axes.get_ylim()
    to_pixels, size = axes.transData.transform, axes.get_window_extent()
    curves = []
    for line in axes.get_lines():
        name = str(line.get_label())
        points = np.asarray(line.get_xydata(), dtype=float)
        points = points[np.isfinite(points).all(axis=1)]
        if name.startswith("_") or len(points) == 0:
            continue
        end = to_pixels(points[np.argmax(points[:, 0])])
        curves.append((float(np.clip(end[1], size.y0, size.y1)), name, line.get_color()))
    # From the top down, as text is read.
    curves.sort(key=lambda curve: -curve[0])
    from matplotlib.font_manager import FontProperties

    points_high = FontProperties(size="small").get_size_in_points()
    line_height = 1.35 * points_high * axes.figure.dpi / 72.0
    wanted = [size.y1 - height for height, _, _ in curves]
    room = (0.0, size.y1 - size.y0)
    middles = _core.spread_labels(wanted, [line_height] * len(wanted), room)
    for middle, (_, name, colour) in zip(middles, curves, strict=True):
        height = 1.0 - middle / max(room[1], 1.0)
        axes.annotate(
            name,
            (1.0, height),
            xycoords="axes fraction",
            xytext=(6, 0),
            textcoords="offset points",
            va="center",
            fontsize="small",
            color=colour,
            annotation_clip=False,
        )
    return axes
