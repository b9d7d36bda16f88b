"""The same study with every wheel–soil model."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from . import _core, _tables

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes

_Result = TypeVar("_Result", bound=_tables.Tabular)

#: Names of the wheel–soil models.
MODELS: tuple[str, ...] = tuple(_core.MODELS)


class ByModel(_tables.Tabular, Mapping[str, _Result]):
    """Results of one study by the name of the wheel–soil model: what ``model="all"`` gives.

    A mapping: ``found["bekker"]`` is the result of a model, ``found.items()`` are all of them.

    Examples
    --------
    How far do the models disagree about the heading offset on the soil as written?

    >>> import grouser as gr
    >>> found = gr.heading("traverse-10-deg", slope_deg=10.0, model="all", nominal=True)
    >>> tuple(found) == gr.MODELS
    True
    >>> yaws = [float(level.yaw_deg[0]) for level in found.values()]
    >>> max(yaws) - min(yaws) < 10.0
    True
    """

    __slots__ = ("_results",)

    def __init__(self, results: Mapping[str, _Result]) -> None:
        self._results = dict(results)

    def __getitem__(self, model: str) -> _Result:
        return self._results[model]

    def __iter__(self) -> Iterator[str]:
        return iter(self._results)

    def __len__(self) -> int:
        return len(self._results)

    def _table(self) -> dict[str, Any]:
        tables = {name: dict(result._table()) for name, result in self._results.items()}
        flat = {
            name: {key: np.ravel(np.asarray(cells)) for key, cells in table.items()}
            for name, table in tables.items()
        }
        counts = [len(next(iter(table.values()))) for table in flat.values()]
        model = np.repeat(np.array(list(flat), dtype=object), counts)
        keys = next(iter(flat.values()))
        columns = {key: np.concatenate([table[key] for table in flat.values()]) for key in keys}
        return {"model": model, **columns}

    def to_pandas(self) -> pandas.DataFrame:
        """The tables of all models, one below the other, with a column ``model``."""
        return _tables.frame(self._table())

    def to_xarray(self) -> xarray.Dataset:
        """The datasets of all models as one, with the dimension ``model`` before theirs.

        Runs that end at different times have NaN after their ends. Attributes of the single
        datasets, such as the ``outcome`` of a run, are coordinates over ``model``.

        Examples
        --------
        >>> import grouser as gr
        >>> pulls = gr.wheel_test("toyoura", load_n=17.0, slip_ratio=[0.1, 0.3], model="all").to_xarray()
        >>> pulls.sizes["model"] == len(gr.MODELS)
        True
        >>> spread = pulls.drawbar_pull_n.max("model") - pulls.drawbar_pull_n.min("model")
        >>> bool((spread > 0.0).all())
        True
        """
        import xarray

        each = [result.to_xarray() for result in self._results.values()]  # type: ignore[attr-defined]
        notes = [data.attrs for data in each]
        data: xarray.Dataset = xarray.concat(
            each,
            "model",
            data_vars="all",
            coords="minimal",
            compat="override",
            join="outer",
            combine_attrs="override",
        )
        data.attrs = {name: it for name, it in notes[0].items() if name == "Conventions"}
        names = dict.fromkeys(name for own in notes for name in own if name not in data.attrs)
        of_model = {name: ("model", [own.get(name, "") for own in notes]) for name in names}
        return data.assign_coords({"model": list(self._results), **of_model})

    def plot(self, axes: Axes | None = None, **style: Any) -> Axes:
        """Plots each model's result on the same axes, labelled with its name.

        Parameters
        ----------
        axes : matplotlib axes, optional
            Axes to plot on; by default those of a new figure.
        **style
            Arguments of the results' own ``plot``.
        """
        axes = _tables.axes_or_new(axes)
        for name, result in self._results.items():
            result.plot(axes, **{"label": name, **style})  # type: ignore[attr-defined]
        axes.legend()
        return axes

    def __repr__(self) -> str:
        lines = (f"  {name}: {repr(it).partition(chr(10))[0]}" for name, it in self.items())
        return "\n".join(["<ByModel>", *lines])


def each_model(study: Callable[[str], _Result]) -> ByModel[_Result]:
    """A study with every model by its name."""
    return ByModel({name: study(name) for name in MODELS})
