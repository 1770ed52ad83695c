"""Equations of motion as changes over a control step."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .arrays import Array
from .checks import number, numbers, whole


def rk4(rates: Callable[..., Any], dt_s: float, substeps: int = 4) -> Callable[..., Array]:
    """A function for `Model(change=…)` of rates(states, actions, **parameters) → derivatives by time, n × dx.

    It takes `substeps` steps of Runge and Kutta's fourth order in a control step, the action held.
    """
    if not callable(rates):
        raise TypeError(f"rates is a {type(rates).__name__}, must be a function(states, actions, **parameters)")
    return _Change(rates, number("dt_s", dt_s), whole("substeps", substeps, 1))


@dataclass(frozen=True)
class _Change:
    """The function that `rk4` gives; pickle keeps it where it keeps rates."""

    rates: Callable[..., Any]
    dt_s: float  # a Robot compares it with its own
    substeps: int

    def __call__(self, states: Array, actions: Array, /, **parameters: float) -> Array:
        h, x = self.dt_s / self.substeps, states
        for _ in range(self.substeps):
            k1 = self._rates(x, actions, parameters)
            k2 = self._rates(x + 0.5 * h * k1, actions, parameters)
            k3 = self._rates(x + 0.5 * h * k2, actions, parameters)
            k4 = self._rates(x + h * k3, actions, parameters)
            x = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        return x - states

    def _rates(self, states: Array, actions: Array, parameters: Mapping[str, float]) -> Array:
        # Columns stay contiguous: NumPy's sine of others differs in its last bit with their address. The function has
        # copies, since it may write into what it is given.
        own = (np.array(given, order="F") for given in (states, actions))
        given = self.rates(*own, **parameters)
        if type(given) is not np.ndarray or given.dtype != float:
            given = _numbers(given)
        if given.shape != states.shape:
            raise ValueError(f"rates returned an array of shape {given.shape}, must be {states.shape}")
        return np.asfortranarray(given)


def _numbers(given: Any) -> Array:
    """What rates returned as an array of doubles. NumPy would take None for NaN."""
    array = np.asanyarray(given)
    if array.dtype == object and any(each is None for each in array.flat):
        raise ValueError("rates returned None, must be an array of numbers")
    return numbers("rates", given)
