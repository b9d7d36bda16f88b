"""Learns to hold the contour line on slopes of unknown soil, in seconds, with NumPy alone.

    python learn_level_line.py [GENERATIONS]

The policy is linear: it turns by a share of its offset from the line, of the offset's integral and of
its yaw. The cross-entropy method finds these three numbers: each generation samples policies from a
normal distribution, drives them all at once, each over its own slope and soil, and moves the
distribution towards the best quarter. No derivatives, no further packages; a deep policy takes the
place of `turns` in the same loop.
"""

from __future__ import annotations

import sys

import gymnasium
import numpy as np
from numpy.typing import NDArray

import grouser.gym  # noqa: F401  (it registers the environment)

Floats = NDArray[np.float64]
#: Rim speed as a share of the fastest.
DRIVE = 0.6
#: Where the search starts: it does not turn at all; and how wide it starts. Turn per offset [1/m], per its
#: integral [1/(m s)] and per yaw [1/°].
START, WIDTH = np.zeros(3), np.array([5.0, 0.5, 0.05])
#: Share of the policies that a generation keeps.
KEPT = 0.25


def turns(policies: Floats, y_m: Floats, integral_m_s: Floats, yaw_deg: Floats) -> Floats:
    """Turn to the left of each policy, a row of three numbers."""
    inputs = np.stack([y_m, integral_m_s, yaw_deg], axis=1)
    turn: Floats = np.clip((policies * inputs).sum(axis=1), -1.0, 1.0)
    return turn


def returns(policies: Floats, seed: int, steps: int) -> Floats:
    """Sum of the rewards of an episode of each policy, a rover for each."""
    count = len(policies)
    envs = gymnasium.make_vec(
        "grouser/LevelTraverse-v0", num_envs=count, max_episode_steps=None, autoreset_mode="Disabled"
    )
    observations, _ = envs.reset(seed=seed)
    total, integral, driving = np.zeros(count), np.zeros(count), np.ones(count, dtype=bool)
    for _ in range(steps):
        y_m, yaw_deg = observations[:, 0], observations[:, 1]
        integral += 0.5 * y_m
        turn = turns(policies, y_m, integral, yaw_deg)
        observations, rewards, terminated, _, _ = envs.step(np.stack([np.full(count, DRIVE), turn], 1))
        total += np.where(driving, rewards, 0.0)
        driving &= ~terminated
        if terminated.any():
            # One that has lost its line stands at its next start, and no longer counts.
            envs.reset(options={"reset_mask": terminated})
    envs.close()
    return total


def learn(generations: int = 4, policies: int = 24, steps: int = 40, seed: int = 1) -> list[Floats]:
    """The mean policy of each generation, from the start on."""
    random, mean, width = np.random.default_rng(seed), START.copy(), WIDTH.copy()
    means = [mean.copy()]
    for generation in range(generations):
        tried = random.normal(mean, width, (policies, 3))
        found = returns(tried, seed + 1000 * generation, steps)
        best = tried[np.argsort(found)[-max(2, int(KEPT * policies)) :]]
        mean, width = best.mean(axis=0), best.std(axis=0) + 0.02 * WIDTH
        means.append(mean)
        print(f"generation {generation + 1}: median return {np.median(found):8.1f}, best {found.max():6.1f}")
    return means


def judged(policy: Floats, episodes: int = 12, steps: int = 40) -> float:
    """Mean return of one policy on slopes and soils that it was not trained on."""
    return float(returns(np.tile(policy, (episodes, 1)), 10**6, steps).mean())


def main() -> None:
    means = learn(int(sys.argv[1]) if len(sys.argv) > 1 else 4)
    for name, policy in (("straight on", means[0]), ("learned", means[-1])):
        print(f"{name:12} {np.round(policy, 3)}: mean return {judged(policy):.1f}")


if __name__ == "__main__":
    main()
