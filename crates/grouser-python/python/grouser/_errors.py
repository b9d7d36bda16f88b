"""What can be wrong, as exceptions with names. What a rover does is never one of them."""

from __future__ import annotations

import errno


class GrouserError(Exception):
    """Whatever this package finds wrong."""


class ParameterError(GrouserError, ValueError):
    """An argument that nothing can have, or that is not allowed.

    Attributes
    ----------
    name : str or None
        The argument, or the key of a description.
    value : float or None
        What was given, where it is a number.
    expected : str or None
        What would be allowed.
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
    """A document that cannot be used.

    Attributes
    ----------
    file : str or None
        The file, or ``preset NAME``.
    line, column : int or None
        Where in it, from 1; columns count characters.
    key : str or None
        The key, with the tables it stands in.
    value : float or None
        What it is, where that is a number.
    expected : str or None
        What it may be.
    hint : str or None
        How it may be mended.
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
    """Neither a preset nor a file; or a path that leads nowhere."""

    def __init__(self, message: str, file: str | None = None, hint: str | None = None) -> None:
        super().__init__(message, file, hint=hint)
        self.errno = errno.ENOENT
        self.filename = file

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self), self.file, self.hint)


class DocumentUnreadableError(GrouserError, OSError):
    """A file that is there, and cannot be read: a folder, no permission, a failing disk."""

    def __init__(self, message: str, file: str | None = None) -> None:
        super().__init__(message)
        self.filename = file

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self), self.filename)


class SimulationError(GrouserError, ArithmeticError):
    """A run that cannot be computed.

    Attributes
    ----------
    time_s : float or None
        When [s].
    """

    def __init__(self, message: str, time_s: float | None = None) -> None:
        super().__init__(message)
        self.time_s = time_s

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self), self.time_s)


class CalibrationError(GrouserError, ArithmeticError):
    """A calibration that cannot be computed: no start gives finite predictions, for instance. That
    data leave a key open is a result."""


class CampaignError(GrouserError):
    """A campaign that cannot go on: a folder with another study, a shard that nobody can compute."""


class CampaignLockedError(CampaignError, BlockingIOError):
    """Another program writes to the folder."""

    def __init__(self, message: str, folder: str | None = None) -> None:
        super().__init__(message)
        self.filename = folder

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self), self.filename)


class CampaignNotFoundError(CampaignError, FileNotFoundError):
    """There is no campaign in the folder."""

    def __init__(self, message: str, folder: str | None = None) -> None:
        super().__init__(message)
        self.errno = errno.ENOENT
        self.filename = folder

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self), self.filename)


class CampaignDiskError(CampaignError, OSError):
    """The disk is full or fails, or does not permit it. What was written before is kept."""

    def __init__(self, message: str, number: int | None = None, file: str | None = None) -> None:
        super().__init__(message)
        self.errno = number
        self.filename = file

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self), self.errno, self.filename)
