"""Learns to hold the contour line on slopes of unknown soil by proximal policy optimisation (PPO),
in plain JAX.

    python ppo_level_line.py [--updates N] [--seed SEED] [--compare]

A small network computes a rover's next command from its observation, and another one estimates the
return that is still to come. Each update drives 64 rovers with random deviations from the commands,
estimates how much better than expected each command was (its *advantage*), and makes the better
ones more probable, by a limited step. The method is that of [Schulman2017], the estimate of
advantages that of [Schulman2016], the optimiser Adam, [KingmaBa2015]. `--compare` also learns the
linear policy of learn_level_line.py and drives it over the same slopes and soils.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import gymnasium
import jax
import jax.numpy as jnp
import numpy as np
from numpy.typing import NDArray

import grouser.gym  # noqa: F401  (it registers the environment)

Floats = NDArray[np.float64]
#: From observations, a row for each rover, to actions.
Controller = Callable[[Floats], Floats]
#: Weights and biases of each layer of a network.
Layers = list[tuple[jax.Array, jax.Array]]

#: Rovers that drive at once, and steps of each for an update: 20 s, on a new slope and soil.
ROVERS, STEPS = 64, 40
#: Rovers and steps by which a policy is judged: the environment's whole episodes, of a minute.
JUDGED_ROVERS, JUDGED_STEPS = 64, 120
#: Units of the hidden layers.
HIDDEN = (32, 32)
#: The untrained policy's commands: drive straight on, with this standard deviation.
START, DEVIATION = (0.6, 0.0), 0.15
#: γ: a reward k steps later counts γ^k times, half after 23 steps, which are 11 s.
DISCOUNT = 0.97
#: λ of the estimate of advantages: at 0 it trusts the estimated values, which are biased, at 1 the
#: rewards of the drive, which scatter. [Schulman2017], Table 3.
TRACE = 0.95
#: ε: the relative change of a command's probability beyond which an update gains nothing.
#: [Schulman2017], Table 1, the best of three.
CLIP = 0.2
#: How often an update uses its data, and in how many parts; each part is a step of the optimiser.
PASSES, PARTS = 16, 8
#: Step size of the optimiser at the start. It falls linearly to 0.
STEP_SIZE = 4e-3
#: Factor of the rewards, with which returns are of the order of 1.
REWARD_SCALE = 0.05


class Parameters(NamedTuple):
    """All that is learned."""

    policy: Layers
    value: Layers
    log_deviation: jax.Array


class Drives(NamedTuple):
    """What was driven: arrays over steps and rovers."""

    observation: Any
    action: Any
    reward: Any
    #: The observation after the step; where the episode terminated, of the next one.
    after: Any
    terminated: Any


def untrained(random: np.random.Generator, observed: int) -> Parameters:
    def layers(sizes: tuple[int, ...]) -> Layers:
        weights = [random.normal(0.0, n**-0.5, (n, m)) for n, m in zip(sizes, sizes[1:])]
        return [(jnp.asarray(weight), jnp.zeros(weight.shape[1])) for weight in weights]

    policy, value = layers((observed, *HIDDEN, 2)), layers((observed, *HIDDEN, 1))
    policy[-1] = 0.01 * policy[-1][0], jnp.asarray(START)
    return Parameters(policy, value, jnp.full(2, np.log(DEVIATION)))


@jax.jit
def output(layers: Layers, inputs: Any) -> Any:
    for weights, biases in layers[:-1]:
        inputs = jnp.tanh(inputs @ weights + biases)
    return inputs @ layers[-1][0] + layers[-1][1]


def log_probability(parameters: Parameters, drives: Drives) -> Any:
    """Of each action, which is normally distributed about the policy's output."""
    mean, log_deviation = output(parameters.policy, drives.observation), parameters.log_deviation
    z = (drives.action - mean) / jnp.exp(log_deviation)
    return -(0.5 * z**2 + log_deviation + 0.5 * np.log(2.0 * np.pi)).sum(axis=-1)


def advantages(parameters: Parameters, drives: Drives) -> tuple[Any, Any]:
    """How much better each action was than expected, by generalised advantage estimation (GAE),
    and the return that the value network should have expected. [Schulman2016], Eq. (16).

    A step was better than expected by δ = r + γ V(s') − V(s): its reward r and the value of the
    state after it, less the value of the state before it. An action's advantage is the sum of δ
    from its step to the end of the episode, weighted by (γλ)^k after k steps. The value after a
    termination is 0. After the last step it is not: the rover would have gone on.
    """
    value, after = (output(parameters.value, x)[..., 0] for x in (drives.observation, drives.after))
    goes_on = 1.0 - drives.terminated
    delta = drives.reward + DISCOUNT * goes_on * after - value

    def add(later: Any, step: Any) -> tuple[Any, Any]:
        advantage = step[0] + DISCOUNT * TRACE * step[1] * later
        return advantage, advantage

    last = jnp.zeros_like(delta[0])
    _, advantage = jax.lax.scan(add, last, (delta, goes_on), reverse=True)
    return advantage, advantage + value


def loss(parameters: Parameters, drives: Drives, old: Any, advantage: Any, target: Any) -> Any:
    """The value's squared error less the clipped objective, [Schulman2017], Eq. (7).

    The ratio says how many times as probable an action is as when it was driven. With a positive
    advantage the objective grows with the ratio, but only up to 1 + ε; with a negative one it grows
    as the ratio falls, but only down to 1 − ε. So an update gains nothing by a policy far from the
    one that drove, of which its data say little.
    """
    ratio = jnp.exp(log_probability(parameters, drives) - old)
    clipped = jnp.clip(ratio, 1.0 - CLIP, 1.0 + CLIP)
    objective = jnp.minimum(ratio * advantage, clipped * advantage).mean()
    error = output(parameters.value, drives.observation)[..., 0] - target
    return 0.5 * (error**2).mean() - objective


@jax.jit
def updated(parameters: Parameters, moments: Any, drives: Drives, parts: Any, size: Any) -> Any:
    """Parameters and Adam's moments after a step for each part of the data, a row of indices."""
    advantage, target = advantages(parameters, drives)
    advantage = (advantage - advantage.mean()) / (advantage.std() + 1e-8)
    data = (drives, log_probability(parameters, drives), advantage, target)
    rows = jax.tree.map(lambda it: it.reshape(-1, *it.shape[2:]), data)

    def step(learned: Any, part: Any) -> tuple[Any, None]:
        """One step of Adam, [KingmaBa2015], section 2, in its faster form, with the decay rates proposed there."""
        parameters, (mean, square, before) = learned
        count = before + 1
        gradient = jax.grad(loss)(parameters, *jax.tree.map(lambda it: it[part], rows))
        mean = jax.tree.map(lambda m, g: 0.9 * m + 0.1 * g, mean, gradient)
        square = jax.tree.map(lambda v, g: 0.999 * v + 0.001 * g**2, square, gradient)
        rate = size * jnp.sqrt(1.0 - 0.999**count) / (1.0 - 0.9**count)
        moves = jax.tree.map(lambda m, v: rate * m / (jnp.sqrt(v) + 1e-8), mean, square)
        parameters = jax.tree.map(jnp.subtract, parameters, moves)
        return (parameters, (mean, square, count)), None

    return jax.lax.scan(step, (parameters, moments), parts)[0]


@dataclass(frozen=True)
class Policy:
    """From observations, a row for each rover, to actions without deviations."""

    parameters: Parameters
    #: Mean and standard deviation of observations, by which metres and watts become alike in size.
    mean: Any = 0.0
    deviation: Any = 1.0

    def scaled(self, observation: Floats) -> Floats:
        return np.asarray(((observation - self.mean) / self.deviation).clip(-5.0, 5.0))

    def __call__(self, observation: Floats) -> Floats:
        action = output(self.parameters.policy, self.scaled(observation))
        return np.asarray(action, dtype=np.float64)


class Clock:
    """Processor time of the environment and of the learner, all threads together [s]."""

    def __init__(self) -> None:
        self.environment = self.learner = 0.0
        self.last = time.process_time()

    def lap(self) -> float:
        last, self.last = self.last, time.process_time()
        return self.last - last


def environments(rovers: int) -> Any:
    """Rovers whose episodes end by a termination alone, at which the next one starts at once."""
    return gymnasium.make_vec(
        "grouser/LevelTraverse-v0",
        num_envs=rovers,
        max_episode_steps=None,
        autoreset_mode="SameStep",
        scenario={"simulation": "quasi-steady"},
    )


def driven(envs: Any, policy: Policy, random: np.random.Generator, clock: Clock) -> Drives:
    """Drives all rovers for some steps, with random deviations from the policy."""
    observation, _ = envs.reset()
    steps, deviation = [], np.exp(policy.parameters.log_deviation)
    for _ in range(STEPS):
        before = policy.scaled(observation)
        action = policy(observation) + deviation * random.normal(size=(ROVERS, 2))
        clock.learner += clock.lap()
        observation, reward, terminated, _, _ = envs.step(action)
        clock.environment += clock.lap()
        after = policy.scaled(observation)
        steps.append(Drives(before, action, REWARD_SCALE * reward, after, terminated))
    return Drives(*map(np.stack, zip(*steps)))


def learn(updates: int, seed: int = 1, clock: Clock | None = None) -> tuple[Policy, Policy]:
    """The policy before and after some updates."""
    clock, random, envs = clock or Clock(), np.random.default_rng(seed), environments(ROVERS)
    observed = envs.reset(seed=seed)[0].shape[1]
    policy = Policy(untrained(random, observed))
    # First drives, which nothing is learned from, say how large observations are.
    seen = driven(envs, policy, random, clock).observation
    first = policy = Policy(policy.parameters, seen.mean((0, 1)), seen.std((0, 1)) + 1e-6)
    nothing = jax.tree.map(jnp.zeros_like, policy.parameters)
    moments = nothing, nothing, 0
    for k in range(updates):
        drives = driven(envs, policy, random, clock)
        orders = [random.permutation(ROVERS * STEPS) for _ in range(PASSES)]
        parts = np.reshape(orders, (PASSES * PARTS, -1))
        size = STEP_SIZE * (1.0 - k / updates)
        parameters, moments = updated(policy.parameters, moments, drives, parts, size)
        policy = replace(policy, parameters=jax.device_get(parameters))
        clock.learner += clock.lap()
        reward, lost = drives.reward.mean() / REWARD_SCALE, drives.terminated.sum()
        print(f"update {k + 1:3}: mean reward {reward:6.3f}, {lost} episodes terminated")
    envs.close()
    return first, policy


def judged(act: Controller, seed: int = 10**6) -> tuple[float, float]:
    """Mean of the sums of rewards of whole episodes, and root mean square offset from the line
    [mm] until they ended, on slopes and soils not trained on."""
    envs = environments(JUDGED_ROVERS)
    observation, _ = envs.reset(seed=seed)
    total, driving, offsets = np.zeros(JUDGED_ROVERS), np.ones(JUDGED_ROVERS, dtype=bool), []
    for _ in range(JUDGED_STEPS):
        observation, reward, terminated, _, _ = envs.step(act(observation))
        total += np.where(driving, reward, 0.0)
        driving &= ~terminated
        offsets.extend(1e3 * observation[driving, 0])
    envs.close()
    return float(total.mean()), float(np.sqrt(np.mean(np.square(offsets))))


def linear() -> Controller:
    """The policy that learn_level_line.py learns."""
    import learn_level_line as example

    learned, integral = example.learn()[-1], np.zeros(1)

    def act(observation: Floats) -> Floats:
        nonlocal integral
        y_m, yaw_deg = observation[:, 0], observation[:, 1]
        integral = integral + 0.5 * y_m
        turn = example.turns(learned[None], y_m, integral, yaw_deg)
        return np.stack([np.full(len(turn), example.DRIVE), turn], axis=1)

    return act


def main() -> None:
    parser = argparse.ArgumentParser(description="Learns to hold the contour line by PPO.")
    parser.add_argument("--updates", type=int, default=30, help="updates of the policy")
    parser.add_argument("--seed", type=int, default=1, help="seed of all random values")
    parser.add_argument("--compare", action="store_true", help="learn the linear policy as well")
    options, clock = parser.parse_args(), Clock()
    first, last = learn(options.updates, options.seed, clock)
    steps = (options.updates + 1) * ROVERS * STEPS
    print(f"{steps} steps; processor time of the environment {clock.environment:.1f} s, ", end="")
    print(f"of the learner {clock.learner:.1f} s")
    policies: dict[str, Controller] = {"untrained": first, "trained": last}
    if options.compare:
        policies["linear"] = linear()
    for name, policy in policies.items():
        total, offset = judged(policy)
        print(f"{name:9}: mean return {total:6.1f}, RMS offset {offset:5.1f} mm")


if __name__ == "__main__":
    main()
