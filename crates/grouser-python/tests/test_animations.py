"""Animations: the forms, the files, and the player in a notebook."""

from __future__ import annotations

from pathlib import Path

import grouser as gr
import pytest


@pytest.fixture(scope="module")
def run() -> gr.Trajectory:
    return gr.simulate(slope_deg=15.0, duration_s=1.0)


@pytest.mark.parametrize(
    ("form", "start"),
    [
        ("gif", b"GIF89a"),
        ("html", b"<!doctype html>"),
        ("glb", b"glTF"),
        ("svg", b"<svg"),
        ("png", b"\x89PNG"),
    ],
)
def test_the_ending_decides_what_is_written(
    run: gr.Trajectory, tmp_path: Path, form: str, start: bytes
) -> None:
    path = tmp_path / f"run.{form}"
    animation = run.animate(path)
    written = path.read_bytes()
    assert written.startswith(start)
    assert animation.to_bytes(form) == written  # the same run, the same bytes


def test_an_unknown_ending_is_refused(run: gr.Trajectory, tmp_path: Path) -> None:
    with pytest.raises(gr.ParameterError, match=r"\.glb") as caught:
        run.animate(tmp_path / "run.avi")
    assert caught.value.name == "path"
    assert not (tmp_path / "run.avi").exists()


def test_a_notebook_shows_the_player_in_a_frame(run: gr.Trajectory) -> None:
    shown = run.animate()._repr_html_()
    assert shown.startswith('<iframe srcdoc="&lt;!doctype html&gt;')
    # Nothing in the page ends the attribute that holds it.
    assert shown.count('"') == 8


def test_runs_beside_each_other_have_their_names(run: gr.Trajectory) -> None:
    turned = gr.simulate(slope_deg=15.0, duration_s=1.0, start={"yaw_deg": 9.56})
    page = run.animate(beside=[turned], names=["straight", "turned"]).to_html()
    assert '"name":"straight"' in page and '"name":"turned"' in page
    with pytest.raises(gr.ParameterError, match="one for each of 2 runs"):
        run.animate(beside=[turned], names=["straight"])
