"""Environments with `reset` and `step`, as Gymnasium has them, as robots."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Union

import numpy as np

from ._core import InvalidInput
from .arrays import Array
from .checks import numbers
from .parts import Action, State


class Environment:
    """Speaks to an environment: states in and out, whatever its tuples are.

    `reset` may take a seed, and returns an observation or (observation, info). `step` returns an observation, four
    things (observation, reward, done, info), or five (…, terminated, truncated, info). Its reward is not used: a reward
    must be known for states that nobody has been in. `end`, where it has one, is called after each episode.
    """

    def __init__(self, environment: Any, observe: Union[Callable[[Any], Any], None], task: Task) -> None:
        for method in ("reset", "step"):
            if not callable(getattr(environment, method, None)):
                raise InvalidInput(f"the plant, a {type(environment).__name__}, has no method {method}")
        self._environment = environment
        self._observe = observe
        self._task = task
        self._step = 0
        self._over = False  # the environment's own limit of time was reached
        space = getattr(environment, "action_space", None)
        self._shape = getattr(space, "shape", None)
        self._dtype = getattr(space, "dtype", None)
        whole = self._dtype is not None and np.dtype(self._dtype).kind in "biu"
        if space is not None and (hasattr(space, "n") or whole):
            raise InvalidInput("the environment chooses among actions by number; its actions must be continuous")
        if self._shape is not None:
            task.compare_actions(space)

    def reset(self, seed: int) -> Array:
        self._step, self._over = 0, False
        try:
            result = self._environment.reset(seed=seed)
        except TypeError as error:
            if "seed" not in str(error):
                raise
            result = self._environment.reset()
        if result is None:
            raise ValueError("reset returned None, must be an observation, or (observation, info)")
        two = isinstance(result, tuple) and len(result) == 2 and isinstance(result[1], dict)
        state = self._state(result[0] if two else result)
        self._task.compare(state)
        return state

    def finish(self) -> None:
        """The end of an episode, whatever ended it: nothing is to move the robot until the next reset."""
        end = getattr(self._environment, "end", None)
        if callable(end):
            end()

    def step(self, action: Array) -> tuple[Array, bool]:
        if self._over:
            raise RuntimeError(
                f"the environment ended the episode after {self._step} steps by its own limit of time, and more were asked "
                "for: give it a longer one (max_episode_steps), or the evaluation fewer seconds")
        self._step += 1
        if self._shape is not None:
            action = action.reshape(self._shape).astype(self._dtype or float)
        result = self._environment.step(action)
        if result is None:
            raise ValueError(f"step returned None in step {self._step} of an episode, must be an observation, four things or five")
        if not isinstance(result, tuple):
            return self._state(result), False
        if len(result) == 5:
            observation, _, terminated, truncated, _ = result
            terminated, truncated = self._truth("terminated", terminated), self._truth("truncated", truncated)
        elif len(result) == 4:
            observation, _, done, info = result
            done = self._truth("done", done)
            truncated = bool(done and isinstance(info, Mapping) and info.get("TimeLimit.truncated", False))
            terminated = done and not truncated
        else:
            raise ValueError(f"step returned {len(result)} things in step {self._step} of an episode, must be four or "
                             "five, or an observation")
        self._over = truncated and not terminated
        if self._over and self._step < self._task.horizon:
            raise RuntimeError(
                f"the environment ended the episode after {self._step} of {self._task.horizon} steps by its own limit of "
                "time: give it a longer one (max_episode_steps), or the robot a shorter horizon")
        return self._state(observation), terminated

    def _truth(self, name: str, value: Any) -> bool:
        """A truth, of NumPy too, or 0 or 1. Python would take any text for True, "no" as well."""
        given = np.asarray(value)
        if given.size != 1 or given.dtype.kind not in "biuf" or given.item() not in (0, 1):
            raise ValueError(f"step returned {name} = {value!r} in step {self._step} of an episode, must be True or False")
        return bool(given.item())

    def _state(self, observation: Any) -> Array:
        state = self._observe(observation) if self._observe else observation
        when = f"in step {self._step} of an episode" if self._step else "at the start of an episode"
        if state is None:
            what = "observe returned None" if self._observe else "an observation is None"
            raise ValueError(f"{what} {when}, must be the states")
        try:
            given = numbers(f"an observation {when}", state).reshape(-1)
        except InvalidInput:
            raise
        except (TypeError, ValueError):
            raise ValueError(f"an observation {when} is a {type(observation).__name__}: observe=f(observation) must say how "
                             "it is a state") from None
        if self._task.states and len(given) != len(self._task.states):
            raise ValueError(f"{'observe' if self._observe else 'the environment'} gives {len(given)} numbers {when}, must be "
                             f"the states {', '.join(s.name for s in self._task.states)}: observe=f(observation) says how")
        return given


@dataclass(frozen=True)
class Task:
    """The parts of a task that an environment must keep to. No states or actions: they are not known."""

    horizon: int
    states: Sequence[State] = ()
    actions: Sequence[Action] = ()
    warned: set[str] = field(default_factory=set, compare=False)  # of these states' starts

    def compare(self, given: Array) -> None:
        """Warns where an episode starts elsewhere than the robot says, once a state."""
        for state, value in zip(self.states, given):
            if state.name in self.warned:
                continue
            mean, spread = state.start, state.start_noise
            apart = math.remainder(value - mean, 2 * math.pi) if state.angle and math.isfinite(value) else value - mean
            if abs(apart) > 5 * spread + 1e-3 * (1 + abs(mean)):
                self.warned.add(state.name)
                warnings.warn(f"the environment starts with {state.name} = {value:.4g}, State('{state.name}') says "
                              f"start={mean:g}, start_noise={spread:g}: policies are made for that; start_noise is for starts "
                              "and sensors that vary", stacklevel=2)

    def compare_actions(self, space: Any) -> None:
        """Refuses a space of another size, and warns of other bounds, where the space has some."""
        size = math.prod(space.shape)
        if self.actions and size != len(self.actions):
            raise InvalidInput(f"the environment takes {size} actions (its action_space has the shape "
                               f"{tuple(space.shape)}), the robot has {len(self.actions)}: "
                               f"{', '.join(action.name for action in self.actions)}")
        low, high = (np.broadcast_to(getattr(space, end, end_of_all), space.shape).reshape(-1)
                     for end, end_of_all in (("low", -np.inf), ("high", np.inf)))
        for action, *bounds in zip(self.actions, low, high):
            if any(np.isfinite(theirs) and not np.isclose(theirs, ours, rtol=1e-6)  # they may be of single precision
                   for theirs, ours in zip(bounds, action.bounds)):
                warnings.warn(f"the environment's action_space has {action.name} between {bounds[0]:g} and {bounds[1]:g}, "
                              f"Action('{action.name}') between {action.bounds[0]:g} and {action.bounds[1]:g}: policies "
                              "use the latter", stacklevel=2)


def is_environment(plant: Any) -> bool:
    """One object, for one thread; else a plant makes some. An environment may be callable, too."""
    return hasattr(plant, "reset") and hasattr(plant, "step") and not isinstance(plant, type)


def is_real(plant: Any) -> bool:
    """A class whose objects have `end` drives a robot, of which there is one; with some of its arguments, too."""
    while isinstance(plant, partial):
        plant = plant.func
    return callable(getattr(plant, "end", None))


def _made(make: Callable[[], Any], observe: Any, task: Task) -> Environment:
    return Environment(make(), observe, task)


def environment_maker(plant: Any, observe: Any, task: Task) -> Callable[[], Environment]:
    """Makes what plays the robot: of an environment, or of a function that makes one."""
    if is_environment(plant):
        Environment(plant, observe, task)  # refuses what does not fit before there is a run
        return partial(Environment, plant, observe, task)
    if callable(plant):
        return partial(_made, plant, observe, task)
    raise InvalidInput(f"plant is a {type(plant).__name__}, must be an environment with reset and step, a function that "
                       "makes one, or a Model")
