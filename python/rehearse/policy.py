"""Policies that were learned."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._core import InvalidInput
from .arrays import Array
from .checks import number, numbers, option_texts, path_of, read_text, vector, whole
from .exported import Exported
from .given_robot import Robots, robot_of

Times = Union[float, npt.ArrayLike]


class Policy:
    """A deterministic policy: states in, actions inside their bounds out. Any thread.

    theta: its parameters. kind: "mlp", "rbf", "linear", "schedule", "tracking", "hand-over", "gait". trial: that it was,
    or is to be, tried in. dt_s: how long an action is held. Pickle keeps what the JSON file has.
    """

    def __init__(self, core: Union[_core.Policy, Exported]) -> None:
        if not isinstance(core, (_core.Policy, Exported)):
            raise TypeError("policies come of Run.policy, Policy.of, and of files by Policy.load")
        self._core = core

    @classmethod
    def load(cls, path: Union[str, os.PathLike[str]]) -> Policy:
        """The policy of a JSON file that `export` wrote. It answers as the original does, but for rounding, and `learn` may
        begin with it. It can be exported as JSON alone."""
        return cls(Exported(read_text(path), str(path)))

    @classmethod
    def of(cls, robot: Robots, theta: Union[npt.ArrayLike, None] = None, *,
           options: Union[Mapping[str, Any], None] = None) -> Policy:
        """The policy that learners of a robot search for, at any θ; None: zeros. robot: as in `learn`; options: of the
        policy, {"policy": "mlp", "hidden": 8}. docs/python.md has the order of θ."""
        core, scenario = robot_of(robot)
        given = None if theta is None else vector("theta", theta)
        return cls(_core.policy_for(core, scenario, option_texts(options), given))

    def with_theta(self, theta: npt.ArrayLike) -> Policy:
        """The same with other parameters."""
        return Policy(self._core.with_theta(vector("theta", theta)))

    def __getstate__(self) -> dict[str, Any]:
        return {"json": self._core.to_json()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._core = Exported(state["json"], "what was pickled")

    def __copy__(self) -> Policy:
        return self

    def __deepcopy__(self, known: Any) -> Policy:
        return self

    def act(self, states: npt.ArrayLike, time_s: Times = 0.0, memory: Union[Array, None] = None) -> Array:
        """Actions (du, or n × du) for states (dx, or n × dx) at a time since the start, one for all or one a row. NaN where
        a state is masked, or it or the time is not finite.

        memory: of a robot whose actions have a rate, a filter, a delay, a lag or are remembered: what `start` gave
        before the first step. It holds the last commands, and is changed: act once each time step. Without it the
        states must have its columns, too, as trajectories do.
        """
        x = numbers("states", states)
        if memory is None:
            return self._act(x, time_s)
        shape = (*x.shape[:-1], len(self._core.start()))
        if not isinstance(memory, np.ndarray) or memory.shape != shape or memory.dtype != float:
            raise InvalidInput(f"memory must be an array of doubles of the shape {shape}, as start() gives it")
        x = np.concatenate([x, memory], axis=-1)
        actions = self._act(x, time_s)
        after = self._core.remember(np.atleast_2d(x), np.atleast_2d(actions)).reshape(memory.shape)
        memory[...] = np.where(np.isfinite(actions).all(axis=-1, keepdims=True), after, memory)
        return actions

    def _act(self, x: Array, time_s: Times) -> Array:
        if np.ndim(time_s) == 0 or x.ndim != 2:
            return self._core.act(x, number("time_s", time_s))
        times = vector("time_s", time_s)
        if len(times) == 1:
            return self._core.act(x, float(times[0]))
        if len(times) != len(x):
            raise InvalidInput(f"time_s has {len(times)} numbers, must be one, or as many as states has rows, {len(x)}")
        actions = self._core.act(x, 0.0)
        order = np.argsort(times, kind="stable")
        for rows in np.split(order, np.flatnonzero(np.diff(times[order])) + 1):  # those of one time
            actions[rows] = self._core.act(x[rows], float(times[rows[0]]) if len(rows) else 0.0)
        return actions

    def __call__(self, states: npt.ArrayLike, time_s: Times = 0.0, memory: Union[Array, None] = None) -> Array:
        return self.act(states, time_s, memory)

    def start(self, n: Union[int, None] = None) -> Array:
        """The memory of n episodes (n rows), or of one, before the first step."""
        memory = np.array(self._core.start(), dtype=float)
        return memory if n is None else np.tile(memory, (whole("n", n, 0), 1))

    @property
    def theta(self) -> Array:
        """Its parameters, a copy."""
        return np.array(self._core.theta)

    @property
    def kind(self) -> str:
        """Its name: mlp, rbf, linear, schedule, …"""
        return self._core.kind

    @property
    def trial(self) -> int:
        """The trial that it was, or is to be, tried in."""
        return self._core.trial

    @property
    def dt_s(self) -> float:
        """How long an action is held [s]."""
        return self._core.dt_s

    @property
    def steps(self) -> int:
        """Control steps of a trial."""
        return int(self._file["steps"])

    @property
    def states(self) -> list[str]:
        """The names of the states, in their order; the last are the memory of actuators, if there is any."""
        return [state["name"] for state in self._file["states"]]

    @property
    def bounds(self) -> dict[str, tuple[float, float]]:
        """The bounds of each action, by name, in their order."""
        return {action["name"]: (action["low"], action["high"]) for action in self._file["actions"]}

    @property
    def _file(self) -> dict[str, Any]:
        return dict(json.loads(self._core.to_json()))

    def export(self, path: Union[str, os.PathLike[str]]) -> Path:
        """Writes it for others: .h (C99), .json, or .py (NumPy alone), by the name's end (docs/export.md). A file of
        that name that is no policy is left as it is."""
        path = Path(path_of("path", path))
        name = path.stem
        texts = {".h": lambda: self._core.to_c(name), ".json": self._core.to_json, ".py": self._core.to_numpy}
        if path.suffix not in texts:
            raise InvalidInput(f"{path}: must end in {', '.join(texts)}")
        _core.write_policy(str(path), texts[path.suffix]())
        return path

    def __repr__(self) -> str:
        return f"<rehearse.Policy {self.kind}, {len(self.theta)} parameters, trial {self.trial}>"
