"""Policies of files that `export` wrote as JSON, on NumPy alone (docs/export.md)."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import numpy as np

from ._core import InvalidInput
from .arrays import Array

_LARGEST_INPUT, _LARGEST_TIME = 1e100, 1e12


def _differences(x: Array, state: Array, angles: Array) -> Array:
    """x less a state, angles the shorter way round."""
    apart = np.clip(x, -_LARGEST_INPUT, _LARGEST_INPUT) - state
    turned = apart - 2 * np.pi * np.floor(apart / (2 * np.pi) + 0.5)
    return np.where(angles, turned, apart)


class Exported:
    """Answers as the original does, but for rounding; it can do what _core.Policy can. A value."""

    def __init__(self, text: str, source: str) -> None:
        wrong = InvalidInput(f"{source} is no policy that `export` wrote as JSON")
        try:
            file = json.loads(text)
            version = file["format"]
        except (KeyError, TypeError, ValueError):
            raise wrong from None
        if version != 1:
            raise InvalidInput(f"{source}: another version of Rehearse wrote it")
        try:
            self._read(file)
            alike = self._answers_alike(file["test"])
        except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError):
            raise wrong from None
        if not alike:
            raise InvalidInput(f"{source}: the policy does not answer as its test says")
        self._text = text

    def _read(self, file: dict[str, Any]) -> None:
        self.theta = np.array(file["theta"], dtype=float)
        self.kind, self.trial, self.dt_s = str(file["policy"]), int(file["trial"]), float(file["dt_s"])
        self._low, self._high = (np.array([action[end] for action in file["actions"]], dtype=float)
                                 for end in ("low", "high"))
        self._commands = file.get("commands", [])
        self._size = len(file["states"])
        self._own = self._size - len(self.start())
        self._numbers = {name: np.array(numbers, dtype=float) if isinstance(numbers, list) and name != "inputs" else numbers
                         for name, numbers in file["computes"].items()}
        self._near = {name: np.array(numbers, dtype=float) for name, numbers in file["computes"].get("near", {}).items()}
        self._form = {"layers": self._layers, "radial": self._radial, "table": self._table,
                      "feedback": self._feedback}[file["computes"]["form"]]

    def _answers_alike(self, test: dict[str, Any]) -> bool:
        said = np.array(test["actions"], dtype=float)
        actions = [self.act(np.array(state, dtype=float), t) for state, t in zip(test["states"], test["times_s"])]
        return bool((np.abs(np.array(actions) - said) <= 1e-9 * (1 + np.abs(said).max())).all())

    def act(self, states: Array, time_s: float) -> Array:
        x = np.atleast_2d(states)
        if states.ndim < 1 or x.ndim != 2 or x.shape[1] != self._size:
            raise InvalidInput(f"states must be an array of {self._size} numbers, or n × {self._size}")
        known = np.isfinite(x).all(axis=1) & np.isfinite(time_s)
        x = np.where(known[:, None], x, 0.0)
        actions = self._form(x, float(np.clip(time_s, 0.0, _LARGEST_TIME)) if np.isfinite(time_s) else 0.0)
        if self._near:
            actions = self._held(x, actions)
        for a, command in enumerate(self._commands):
            if command["last"] is None:
                continue
            last, passes, step = x[:, command["last"]], command["passes"], command["max_step"]
            sent = last + passes * (actions[:, a] - last) if passes < 1 else actions[:, a]
            actions[:, a] = sent if step is None else np.clip(sent, last - step, last + step)
        actions[~known] = np.nan
        answer: Array = actions if states.ndim == 2 else actions[0]
        return answer

    def start(self) -> Array:
        sizes = [command["remembers"] + (command["reached"] is not None) for command in self._commands]
        return np.repeat(np.array([command["start"] for command in self._commands], dtype=float),
                         np.array(sizes, dtype=int))

    def remember(self, states: Array, actions: Array) -> Array:
        after = states.copy()
        for a, command in enumerate(self._commands):
            count, first = command["remembers"], command["last"]
            sent = np.column_stack([actions[:, a], states[:, first : first + count]] if count else [actions[:, a]])
            if command["reached"] is not None:
                whole = int(command["delay"])
                part = command["delay"] - whole
                held = sent[:, whole] if part == 0 else (1 - part) * sent[:, whole] + part * sent[:, whole + 1]
                after[:, command["reached"]] = held + command["stays"] * (states[:, command["reached"]] - held)
            if count:
                after[:, first : first + count] = sent[:, :count]
        memory: Array = after[:, self._own :]
        return memory

    def with_theta(self, theta: Array) -> Any:
        raise InvalidInput("a policy that was loaded knows its own theta alone; that of a run, or Policy.of(robot), may "
                           "have another")

    def to_json(self) -> str:
        return self._text

    def to_c(self, name: str) -> str:
        raise InvalidInput("a policy that was loaded can be written as .json alone: export the run's own, Run.policy()")

    def to_numpy(self) -> str:
        return self.to_c("")

    def _inputs(self, x: Array) -> Array:
        functions: dict[str, Callable[[Array], Array]] = {
            "identity": lambda column: np.clip(column, -_LARGEST_INPUT, _LARGEST_INPUT), "cos": np.cos, "sin": np.sin}
        return np.stack([functions[each["function"]](x[:, each["state"]]) / each["scale"]
                         for each in self._numbers["inputs"]], axis=1)

    def _squashed(self, a: Array) -> Array:
        a = self._numbers["gain"] * a
        if self._numbers["squash"] == "tanh":
            squashed = np.tanh(a)
        else:
            sine = np.sin(np.clip(a, -1e4, 1e4))
            squashed = 0.5 * sine * (3 - sine * sine)
        actions: Array = (self._low + self._high) / 2 + (self._high - self._low) / 2 * squashed
        return np.clip(actions, self._low, self._high)

    def _layers(self, x: Array, time_s: float) -> Array:
        inputs, hidden, output = self._inputs(x), self._numbers["hidden"], self._numbers["output"]
        if len(hidden):
            inputs = np.tanh(inputs @ hidden[:, :-1].T + hidden[:, -1])
        return self._squashed(inputs @ output[:, :-1].T + output[:, -1])

    def _radial(self, x: Array, time_s: float) -> Array:
        apart = self._inputs(x)[:, None, :] - self._numbers["centres"]
        a = [np.exp(-0.5 * np.minimum(((apart / lengths) ** 2).sum(axis=2), 1400.0)) @ weights
             for lengths, weights in zip(self._numbers["lengths"], self._numbers["weights"])]
        return self._squashed(np.stack(a, axis=1))

    def _table(self, x: Array, time_s: float) -> Array:
        actions = self._numbers["actions"]
        row = np.floor(time_s * self._numbers["per_s"] + 0.5)
        row = np.fmod(row, len(actions)) if self._numbers["periodic"] else min(row, len(actions) - 1)
        return np.tile(actions[int(row)], (len(x), 1))

    def _held(self, x: Array, actions: Array) -> Array:
        """The actions, but those of linear feedback near the goal."""
        near = self._near
        apart = _differences(x, near["state"], near["angles"])
        held = np.clip(near["action"] + apart @ near["gain"].T, self._low, self._high)
        inside = (apart * (apart @ near["shape"].T)).sum(axis=1) < 1
        return np.where(inside[:, None], held, actions)

    def _feedback(self, x: Array, time_s: float) -> Array:
        actions, tracked, gains = (self._numbers[name] for name in ("actions", "states", "gains"))

        def of_stage(row: int) -> Array:
            apart = _differences(x, tracked[row], self._numbers["angles"])
            planned: Array = actions[row] + apart @ gains[row].reshape(len(self._low), -1).T
            return planned

        place = min(time_s * self._numbers["per_s"], len(actions) - 1)
        row = int(place + 1e-9)
        beyond = place - row if place - row > 1e-9 else 0.0
        u = of_stage(row)
        u = u + beyond * (of_stage(min(row + 1, len(actions) - 1)) - u)
        return np.clip(u, self._low, self._high)
