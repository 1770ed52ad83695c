"""Environments with `reset` and `step`, as Gymnasium has them, as robots."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Union

import numpy as np

from ._core import InvalidInput
from .arrays import Array


class Environment:
    """Speaks to an environment: states in and out, whatever its tuples are.

    `reset` may take a seed, and returns an observation or (observation, info). `step` returns an observation, four
    things (observation, reward, done, info), or five (…, terminated, truncated, info). Its reward is not used: a reward
    must be known for states that nobody has been in.
    """

    def __init__(self, environment: Any, observe: Union[Callable[[Any], Any], None], horizon: int) -> None:
        self._environment = environment
        self._observe = observe
        self._horizon = horizon
        self._step = 0
        space = getattr(environment, "action_space", None)
        self._shape = getattr(space, "shape", None)
        self._dtype = getattr(space, "dtype", None)
        if space is not None and hasattr(space, "n"):
            raise InvalidInput("the environment chooses among actions by number; its actions must be continuous")

    def reset(self, seed: int) -> Array:
        self._step = 0
        try:
            result = self._environment.reset(seed=seed)
        except TypeError as error:
            if "seed" not in str(error):
                raise
            result = self._environment.reset()
        two = isinstance(result, tuple) and len(result) == 2 and isinstance(result[1], dict)
        return self._state(result[0] if two else result)

    def step(self, action: Array) -> tuple[Array, bool]:
        self._step += 1
        if self._shape is not None:
            action = action.reshape(self._shape).astype(self._dtype or float)
        result = self._environment.step(action)
        if not isinstance(result, tuple):
            return self._state(result), False
        if len(result) == 5:
            observation, _, terminated, truncated, _ = result
        elif len(result) == 4:
            observation, _, done, info = result
            truncated = bool(done and info.get("TimeLimit.truncated", False))
            terminated = done and not truncated
        else:
            raise ValueError(f"step returned {len(result)} things, must be an observation, four or five")
        if truncated and not terminated and self._step < self._horizon:
            raise RuntimeError(
                f"the environment ended the episode after {self._step} of {self._horizon} steps by its own limit of "
                "time: give it a longer one (max_episode_steps), or the robot a shorter horizon")
        return self._state(observation), bool(terminated)

    def _state(self, observation: Any) -> Array:
        state = self._observe(observation) if self._observe else observation
        return np.asarray(state, dtype=float).reshape(-1)


def environment_maker(plant: Any, observe: Any, horizon: int) -> Callable[[], Environment]:
    """Makes what plays the robot: of an environment, or of a function that makes one."""
    if hasattr(plant, "reset") and hasattr(plant, "step") and not isinstance(plant, type):
        return lambda: Environment(plant, observe, horizon)
    if callable(plant):
        return lambda: Environment(plant(), observe, horizon)
    raise InvalidInput(f"plant is a {type(plant).__name__}, must be an environment with reset and step, a function that "
                       "makes one, or a Model")
