"""The same study with every wheel–soil model."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from . import _core, _tables

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

_Result = TypeVar("_Result", bound=_tables.Tabular)

#: Names of the wheel–soil models.
MODELS: tuple[str, ...] = tuple(_core.MODELS)


class ByModel(_tables.Tabular, Mapping[str, _Result]):
    """Results of one study by the name of the wheel–soil model: what ``model="all"`` gives.

    A mapping: ``found["bekker"]`` is the result of a model, ``found.items()`` are all of them.
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
