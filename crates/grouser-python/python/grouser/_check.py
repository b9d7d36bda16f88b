"""Checks documents."""

from __future__ import annotations

import os
from dataclasses import dataclass

from . import _core


@dataclass(frozen=True)
class Checked:
    """A valid document, and what it leaves open.

    Made by `check`, which has an example.
    """

    kind: str
    """``soil``, ``wheel``, ``rover``, ``scenario``, ``campaign``, ``data-set`` or ``prior``."""
    not_stated: tuple[tuple[str, float | None, str], ...]
    """Keys that it does not state, each with the value that is taken, if it is a number, and the
    name of the priors that it is from."""
    notes: tuple[str, ...]
    """What is valid and hardly meant, a sentence each."""


def check(source: str | os.PathLike[str], /) -> Checked:
    """Checks a document of any kind, as the program's ``check`` does.

    Parameters
    ----------
    source : str or path
        A path, or the TOML text of a document: a str with a line end is a text.

    Returns
    -------
    Checked

    Raises
    ------
    DocumentError
        For the first fault, with line, column and a hint.
    DocumentNotFoundError
        If the file does not exist.

    Examples
    --------
    >>> import grouser as gr
    >>> gr.check(gr.Wheel("hakuto").to_toml()).kind
    'wheel'
    >>> try:
    ...     gr.check('schema = "wheel/1"\\nradius_m = 0.1\\nwidht_m = 0.08\\n')
    ... except gr.DocumentError as error:
    ...     error.key, error.line, error.hint
    ('widht_m', 3, 'did you mean `width_m`?')
    """
    is_text = isinstance(source, str) and "\n" in source
    name = "TOML" if is_text else os.fspath(source)
    kind, not_stated, notes = _core.check_document(name, str(source) if is_text else None)
    return Checked(kind, tuple(not_stated), tuple(notes))
