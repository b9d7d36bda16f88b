"""The console: a page in the browser, served from this process."""

from __future__ import annotations

import html
import os
import webbrowser
from collections.abc import Sequence
from types import TracebackType

from . import _core
from ._arrays import whole_number


class Console:
    """A server of the console, in a thread of its own until it is stopped, the end of a ``with``
    block or the end of Python.

    Made by `serve`.
    """

    def __init__(self, server: _core.ConsoleServer) -> None:
        self._server = server

    @property
    def address(self) -> str:
        """The address of the page. It has the token: who knows it may ask this server anything."""
        return self._server.address

    @property
    def port(self) -> int:
        """The port on the loopback."""
        return self._server.port

    @property
    def is_serving(self) -> bool:
        """Whether it answers: not after `stop`, nor in a process forked from the one that serves."""
        return self._server.is_serving

    def stop(self) -> None:
        """End it: what it computes is stopped, or after two seconds no longer waited for. To stop it
        twice is to stop it once."""
        self._server.stop()

    def __enter__(self) -> Console:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.stop()

    def __repr__(self) -> str:
        state = f"at {self.address}" if self.is_serving else "stopped"
        return f"<Console {state}>"

    def _repr_html_(self) -> str:
        if not self.is_serving:
            return html.escape(repr(self))
        address = html.escape(self.address, quote=True)
        return f'<a href="{address}" target="_blank" rel="noreferrer">The console</a>'


def serve(
    folder: str | os.PathLike[str] | None = None,
    *,
    port: int = 0,
    hosts: Sequence[str] = (),
    open_browser: bool = True,
) -> Console:
    """Serve the console, a page to try things on, to a browser on this machine.

    It listens on the loopback alone, and answers whoever has the token in its address. In a
    notebook the result is a link to it.

    Parameters
    ----------
    folder : path, optional
        A folder of documents to choose from; no file outside of it is opened. Without it there are
        the presets.
    port : int
        The port; 0 takes a free one.
    hosts : sequence of str
        Names by which the page is reached beside those of the loopback, as that of a tunnel.
    open_browser : bool
        Whether to open the page in the user's browser.

    Returns
    -------
    Console
        With its address; it goes on until it is stopped, or Python ends.

    Raises
    ------
    ParameterError
        For a folder that cannot be read, and a port that another program has.

    Examples
    --------
    >>> import grouser as gr
    >>> with gr.serve(open_browser=False) as console:
    ...     console.is_serving
    True
    >>> console
    <Console stopped>
    """
    path = None if folder is None else os.fspath(folder)
    names = [hosts] if isinstance(hosts, str) else list(hosts)
    server = _core.ConsoleServer(path, whole_number("port", port, most=65535), names, open_browser)
    if server.page is not None:
        # A private file: all users of a machine can read the address on a command line.
        webbrowser.open(server.page.as_uri())
    return Console(server)
