"""Policies that were learned."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Union

import numpy as np

from . import _core
from .arrays import Array
import numpy.typing as npt


class Policy:
    """A deterministic policy: states in, actions inside their bounds out. Any thread.

    theta: its parameters. kind: "mlp", "rbf", "linear", "schedule". trial: that it was, or is to be, tried in. dt_s:
    how long an action is held.
    """

    def __init__(self, core: _core.Policy) -> None:
        self._core = core

    def act(self, states: npt.ArrayLike, time_s: float = 0.0) -> Array:
        """Actions (du, or n × du) for states (dx, or n × dx) at a time since the start. NaN where a state is."""
        return self._core.act(np.asarray(states, dtype=float), time_s)

    def __call__(self, states: npt.ArrayLike, time_s: float = 0.0) -> Array:
        return self.act(states, time_s)

    @property
    def theta(self) -> Array:
        return self._core.theta

    @property
    def kind(self) -> str:
        return self._core.kind

    @property
    def trial(self) -> int:
        return self._core.trial

    @property
    def dt_s(self) -> float:
        return self._core.dt_s

    def export(self, path: Union[str, os.PathLike[str]]) -> Path:
        """Writes it for others: .h (C99), .json, or .py (NumPy alone), by the name's end (docs/export.md)."""
        path = Path(path)
        name = path.stem
        texts = {".h": lambda: self._core.to_c(name), ".json": self._core.to_json, ".py": self._core.to_numpy}
        if path.suffix not in texts:
            raise ValueError(f"{path}: must end with {', '.join(texts)}")
        path.write_text(texts[path.suffix]())
        return path

    def __repr__(self) -> str:
        return f"<rehearse.Policy {self.kind}, {len(self.theta)} parameters, trial {self.trial}>"
