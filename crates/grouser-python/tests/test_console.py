"""The console, served from Python."""

from __future__ import annotations

import contextlib
import http.client
import json
import os
import socket
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import url2pathname

import pytest

import grouser as gr


def ask(console: gr.Console, path: str, token: str | None, body: str | None = None) -> tuple[int, str]:
    """What the console answers: its status and text."""
    connection = http.client.HTTPConnection("127.0.0.1", console.port, timeout=60)
    headers = {"Content-Type": "application/json"}
    if token is not None:
        headers["Authorization"] = f"Bearer {token}"
    connection.request("GET" if body is None else "POST", path, body, headers)
    answer = connection.getresponse()
    text = answer.read().decode()
    connection.close()
    return answer.status, text


def token_of(console: gr.Console) -> str:
    """The token in the address of a console."""
    address = urlsplit(console.address)
    assert (address.scheme, address.hostname, address.port) == ("http", "127.0.0.1", console.port)
    return address.query.partition("token=")[2] or address.fragment.partition("token=")[2]


def test_it_answers_as_the_package() -> None:
    with gr.serve(open_browser=False) as console:
        token = token_of(console)
        assert ask(console, "/api/presets", None)[0] == 401
        assert ask(console, "/api/presets", token)[0] == 200
        body = json.dumps({"slope_deg": [10.0], "samples": 40})
        status, text = ask(console, "/api/heading", token, body)
    assert status == 200, text
    rows = json.loads(text.strip().splitlines()[-1])["rows"]
    assert rows[0]["yaw_deg"] == gr.heading(slope_deg=10.0).yaw_deg.item()


def test_it_ends_when_it_is_stopped() -> None:
    console = gr.serve(open_browser=False)
    assert console.is_serving and console.address in repr(console)
    assert console.address in console._repr_html_()
    console.stop()
    console.stop()
    assert not console.is_serving and repr(console) == "<Console stopped>"
    assert "stopped" in console._repr_html_() and "href" not in console._repr_html_()
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection(("127.0.0.1", console.port), timeout=5)
    # The port is free again.
    with gr.serve(port=console.port, open_browser=False) as again:
        assert again.port == console.port


def test_whoever_stops_it_waits_for_its_end() -> None:
    console = gr.serve(open_browser=False)
    token, body = token_of(console), json.dumps({"soil": "toyoura-uncertain", "samples": 10000})

    def asked() -> None:
        # It is cut off.
        with contextlib.suppress(OSError, http.client.HTTPException):
            ask(console, "/api/heading", token, body)

    asking = threading.Thread(target=asked)
    asking.start()

    def stop() -> bool:
        console.stop()
        with socket.socket() as other:
            return other.connect_ex(("127.0.0.1", console.port)) != 0

    with ThreadPoolExecutor(4) as pool:
        stops = [pool.submit(stop) for _ in range(4)]
        assert all(it.result(60) for it in stops)
    asking.join(60)


def test_the_browser_is_opened_with_a_private_file(monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    with gr.serve() as console:
        (address,) = opened
        assert address.startswith("file:") and token_of(console) not in address
        page = Path(url2pathname(urlsplit(address).path))
        assert console.address in page.read_text()
        assert os.name == "nt" or page.stat().st_mode & 0o777 == 0o600
    assert not page.exists()


def test_python_goes_on_beside_it() -> None:
    with gr.serve(open_browser=False) as console:
        token, body = token_of(console), json.dumps({"slope_deg": [5.0, 10.0], "samples": 40})
        answers: list[int] = []
        asking = threading.Thread(
            target=lambda: answers.append(ask(console, "/api/heading", token, body)[0])
        )
        asking.start()
        assert gr.heading(slope_deg=[2.0, 4.0]).yaw_deg.shape == (2,)
        asking.join(60)
    assert answers == [200]


def test_documents_of_a_folder_and_none_outside(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(gr.Soil("toyoura").to_toml())
    with gr.serve(tmp_path, open_browser=False) as console:
        token = token_of(console)
        assert "mine.toml" in ask(console, "/api/documents", token)[1]
        body = json.dumps({"slope_deg": [5.0], "soil": "../secret.toml"})
        assert ask(console, "/api/heading", token, body)[0] != 200


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"folder": "no-such-folder"}, "no-such-folder"),
        ({"port": 65536}, "from 0 to 65535"),
        ({"port": -1}, "from 0 to 65535"),
        ({"port": 8.5}, "whole number"),
    ],
)
def test_what_it_cannot_serve_is_refused(arguments: dict[str, object], said: str) -> None:
    with pytest.raises(gr.ParameterError, match=said):
        gr.serve(open_browser=False, **arguments)  # type: ignore[arg-type]


def test_a_port_that_is_taken_is_refused() -> None:
    with gr.serve(open_browser=False) as console:
        with pytest.raises(gr.ParameterError, match=str(console.port)):
            gr.serve(port=console.port, open_browser=False)


#: A process of its own: those of tests have threads, and to fork them is warned of.
FORKS = """
import os
import grouser as gr

with gr.serve(open_browser=False) as console:
    child = os.fork()
    if child == 0:
        heading = gr.heading(slope_deg=10.0)
        console.stop()
        os._exit(0 if not console.is_serving and heading.yaw_deg > 0.0 else 1)
    assert os.waitpid(child, 0)[1] == 0
    assert console.is_serving
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system cannot fork")
def test_a_forked_process_does_not_serve_and_can_compute() -> None:
    script = [sys.executable, "-W", "ignore::DeprecationWarning", "-c", FORKS]
    ended = subprocess.run(script, capture_output=True, text=True, timeout=120)
    assert ended.returncode == 0, ended.stderr
