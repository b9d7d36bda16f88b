"""Gymnasium environments: rovers on slopes of unknown soil.

Importing this module registers ``grouser/LevelTraverse-v0``, in which a rover holds its contour,
and ``grouser/PathFollowing-v0``, in which it follows a path under stop conditions. Both have a
vector form that simulates all its rovers at once on all cores. `RoverEnv` is the base class of your
own environments. It needs Gymnasium: ``pip install gymnasium``; and matplotlib for pictures.

Examples
--------
>>> import gymnasium
>>> import grouser.gym
>>> env = gymnasium.make("grouser/LevelTraverse-v0")
>>> observation, info = env.reset(seed=1)
>>> observation, reward, terminated, truncated, info = env.step([0.6, 0.0])
>>> observation.shape, terminated
((17,), False)
>>> envs = gymnasium.make_vec("grouser/LevelTraverse-v0", num_envs=8)
>>> observations, infos = envs.reset(seed=1)
>>> bool((observations[0] == env.reset(seed=1)[0]).all())
True
"""

try:
    import gymnasium as _gymnasium
except ImportError as _missing:
    raise ImportError(
        "grouser.gym needs Gymnasium: pip install gymnasium", name="gymnasium"
    ) from _missing

from ._level import ENV_ID, MAX_EPISODE_STEPS, LevelTraverseEnv, LevelTraverseVectorEnv
from ._path import MAX_PATH_STEPS, PATH_ENV_ID, PathFollowingEnv, PathFollowingVectorEnv
from ._rover import RoverEnv
from ._rovers import EnvState

__all__ = [
    "EnvState",
    "LevelTraverseEnv",
    "LevelTraverseVectorEnv",
    "PathFollowingEnv",
    "PathFollowingVectorEnv",
    "RoverEnv",
]

# One canonical path for each name, in messages and in documentation.
for _name in __all__:
    globals()[_name].__module__ = __name__
del _name

_gymnasium.register(
    id=ENV_ID,
    entry_point="grouser.gym:LevelTraverseEnv",
    vector_entry_point="grouser.gym:LevelTraverseVectorEnv",
    max_episode_steps=MAX_EPISODE_STEPS,
)
_gymnasium.register(
    id=PATH_ENV_ID,
    entry_point="grouser.gym:PathFollowingEnv",
    vector_entry_point="grouser.gym:PathFollowingVectorEnv",
    max_episode_steps=MAX_PATH_STEPS,
)
