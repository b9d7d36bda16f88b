"""Flags of validity: why a result is an extrapolation."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._arrays import Floats
from ._errors import OutsideDomainError

#: Every flag of the closed list, with what it means.
FLAGS: dict[str, str] = dict(_core.flags())


def flags_of(bits: Floats) -> NDArray[np.object_]:
    """Names of flags, joined by ``;``, from their bits."""
    return _core.flag_names(bits.ravel()).reshape(bits.shape)


def require_inside(result: Any) -> Any:
    """Accepts no extrapolation: raises if any row of a result carries a flag.

    Parameters
    ----------
    result : Settled, WheelTest, Headings, HeadingMap, Trajectory or Validation
        A result with ``flags``.

    Returns
    -------
    The same result.

    Raises
    ------
    OutsideDomainError
        With the flags, and the first entry that carries each.

    Examples
    --------
    >>> import grouser as gr
    >>> wheel = gr.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=[0.2, 0.99])
    >>> wheel.flags.tolist()
    ['', 'slip-outside']
    >>> gr.require_inside(wheel)
    Traceback (most recent call last):
    ...
    grouser.OutsideDomainError: results are outside the domain of the model or the soil
    slip-outside at (1,): The slip ratio is outside the tests of the model or of the soil's fit, or near 1.
    """
    first: dict[str, tuple[int, ...]] = {}
    for place, names in np.ndenumerate(np.asarray(result.flags, dtype=object)):
        for name in names.split(";") if names else ():
            first.setdefault(name, place)
    if not first:
        return result
    raised = [name for name in FLAGS if name in first]
    lines = [f"{name} at {first[name]}: {FLAGS[name]}" for name in raised]
    head = "results are outside the domain of the model or the soil"
    raise OutsideDomainError("\n".join([head, *lines]), tuple(raised))
