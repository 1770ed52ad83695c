"""Trials of a run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Union


@dataclass(frozen=True)
class Trial:
    """One trial: what was predicted before it, and what came of it.

    phi, intervals: parameters of the prior that chose its policy, and their 95 % intervals. limits: risk and outcome of
    each. cut_short: by no fault of the policy, so that the return does not compare. warnings: what the trials before
    cannot tell of the parameters. None: does not apply, or is not known. total_reward: NaN of a trial that is to come.
    """

    trial: int
    total_reward: float
    predicted_return: Union[float, None]
    solved: Union[bool, None]
    cut_short: bool
    phi: dict[str, float]
    intervals: dict[str, tuple[float, float]]
    limits: list[dict[str, Any]]
    warnings: list[str]
    notes: list[str]
