"""Equations of motion as changes over a control step."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from .arrays import Array


def rk4(rates: Callable[..., Any], dt_s: float, substeps: int = 4) -> Callable[..., Array]:
    """A function for `Model(change=…)` of rates(states, actions, **parameters) → derivatives by time, n × dx.

    It takes `substeps` steps of Runge and Kutta's fourth order in a control step, the action held.
    """
    h = dt_s / substeps

    def change(states: Array, actions: Array, **parameters: float) -> Array:
        x = states
        for _ in range(substeps):
            k1 = np.asarray(rates(x, actions, **parameters))
            k2 = np.asarray(rates(x + 0.5 * h * k1, actions, **parameters))
            k3 = np.asarray(rates(x + 0.5 * h * k2, actions, **parameters))
            k4 = np.asarray(rates(x + h * k3, actions, **parameters))
            x = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        return x - states

    change.dt_s = dt_s  # type: ignore[attr-defined]  # a Robot compares it with its own
    return change
