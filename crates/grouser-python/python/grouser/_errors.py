"""The exceptions of the package. A rover that gets stuck or slides is a result, never one of
them."""

from __future__ import annotations

import errno
from collections.abc import Callable, Container
from functools import wraps
from typing import ParamSpec, TypeVar

_P = ParamSpec("_P")
_R = TypeVar("_R")


class GrouserError(Exception):
    """Base class of all exceptions of this package."""


class ParameterError(GrouserError, ValueError):
    """An invalid argument or keyword.

    Attributes
    ----------
    name : str or None
        The argument, or the key of a description.
    value : float or None
        The given value, if it is a number.
    expected : str or None
        The allowed values.
    """

    def __init__(
        self,
        message: str,
        name: str | None = None,
        value: float | None = None,
        expected: str | None = None,
    ) -> None:
        super().__init__(message)
        self.name = name
        self.value = value
        self.expected = expected

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self), self.name, self.value, self.expected)


class DocumentError(GrouserError, ValueError):
    """An invalid document.

    Attributes
    ----------
    file : str or None
        The file, or ``preset NAME``.
    line, column : int or None
        Where in it, from 1; columns count characters.
    key : str or None
        The key, with the tables that contain it.
    value : float or None
        Its value, if that is a number.
    expected : str or None
        The allowed values.
    hint : str or None
        How to correct it.
    """

    def __init__(
        self,
        message: str,
        file: str | None = None,
        line: int | None = None,
        column: int | None = None,
        key: str | None = None,
        value: float | None = None,
        expected: str | None = None,
        hint: str | None = None,
    ) -> None:
        super().__init__(message)
        self.file = file
        self.line = line
        self.column = column
        self.key = key
        self.value = value
        self.expected = expected
        self.hint = hint

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> tuple[object, ...]:
        values = (self.line, self.column, self.key, self.value, self.expected, self.hint)
        return type(self), (str(self), self.file, *values)


class DocumentNotFoundError(DocumentError, FileNotFoundError):
    """A name that is neither a preset nor a file, or a path without a file."""

    def __init__(self, message: str, file: str | None = None, hint: str | None = None) -> None:
        super().__init__(message, file, hint=hint)
        self.errno = errno.ENOENT
        self.filename = file

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self), self.file, self.hint)


class DocumentUnreadableError(GrouserError, OSError):
    """A file that exists and cannot be read: a folder, no permission, a failing disk."""

    def __init__(self, message: str, file: str | None = None) -> None:
        super().__init__(message)
        self.filename = file

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self), self.filename)


class OutsideDomainError(GrouserError, ValueError):
    """Results carry flags of validity where none is accepted.

    Attributes
    ----------
    flags : tuple of str
        The flags, in the order of the list.
    """

    def __init__(self, message: str, flags: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.flags = flags

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self), self.flags)


class SimulationError(GrouserError, ArithmeticError):
    """A run that cannot be computed.

    Attributes
    ----------
    time_s : float or None
        The time of the failure [s].
    """

    def __init__(self, message: str, time_s: float | None = None) -> None:
        super().__init__(message)
        self.time_s = time_s

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self), self.time_s)


class CalibrationError(GrouserError, ArithmeticError):
    """A calibration that cannot be computed: no start gives finite predictions, for instance. A key
    that the data leave underdetermined is a result."""


class InternalError(GrouserError, RuntimeError):
    """A fault of this package, whatever the arguments: please report it, with what was called."""


class CampaignError(GrouserError):
    """A campaign that cannot continue: a folder with another study, a shard that no worker can
    compute."""


class CampaignLockedError(CampaignError, BlockingIOError):
    """A folder to which another program is writing."""

    def __init__(self, message: str, folder: str | None = None) -> None:
        super().__init__(message)
        self.filename = folder

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self), self.filename)


class CampaignNotFoundError(CampaignError, FileNotFoundError):
    """A folder without a campaign."""

    def __init__(self, message: str, folder: str | None = None) -> None:
        super().__init__(message)
        self.errno = errno.ENOENT
        self.filename = folder

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self), self.filename)


class CampaignDiskError(CampaignError, OSError):
    """A disk that is full, fails or denies permission. Files written before are kept."""

    def __init__(self, message: str, number: int | None = None, file: str | None = None) -> None:
        super().__init__(message)
        self.errno = number
        self.filename = file

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self), self.errno, self.filename)


def present_name(name: str, known: Container[str]) -> str:
    """The end of a message about an unknown name: its present one, where it is withdrawn and that is
    among the known ones."""
    from . import _core

    present = [it for it in _core.present_names(name) if it in known]
    return f"; did you mean {' or '.join(present)}?" if present else ""


def refuse_vary(keywords: Container[str]) -> None:
    """Refuses ``vary`` among the keywords of a call that does not take it, and says which do."""
    if "vary" not in keywords:
        return
    import inspect

    import grouser

    calls = {name: getattr(grouser, name) for name in sorted(grouser.__all__)}
    functions = (name for name, it in calls.items() if inspect.isfunction(it))
    takers = [it for it in functions if "vary" in inspect.signature(calls[it]).parameters]
    raise ParameterError(
        f"vary is no key here, it is an argument of {', '.join(takers)}, of which rollout is for runs: "
        "elsewhere call once for each of several descriptions, as .replace(…) makes them, or take a "
        "Campaign, whose parameters vary",
        "vary",
    )


def refusing_vary(call: Callable[_P, _R]) -> Callable[_P, _R]:
    """A call without keywords of its own that says the same."""

    @wraps(call)
    def refusing(*args: _P.args, **kwargs: _P.kwargs) -> _R:
        refuse_vary(kwargs)
        return call(*args, **kwargs)

    return refusing
