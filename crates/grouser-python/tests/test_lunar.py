"""Lunar ground by chance."""

import pytest

import grouser as gr


def test_a_seed_gives_the_same_ground_and_another_one_other_ground() -> None:
    one, again, other = (gr.Terrain.lunar(size_m=50.0, seed=seed) for seed in (1, 1, 2))
    assert one == again
    assert one != other
    assert one.shape == (51, 51)
    assert one.extent_m == (-25.0, -25.0, 25.0, 25.0)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"size_m": 1e9}, "8 to 4096"),
        ({"crater_share": 2.0}, "0 to 1"),
        ({"ground": "sea"}, "'mare' or 'highlands'"),
        ({"seed": -1}, "seed is -1"),
    ],
)
def test_limits_are_stated(changes: dict, words: str) -> None:
    with pytest.raises(gr.ParameterError, match=words):
        gr.Terrain.lunar(**changes)
