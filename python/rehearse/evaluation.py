"""Results of episodes of one policy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Union

import numpy as np

from .arrays import Array
from .tables import html_table, structured


@dataclass(frozen=True, eq=False)
class Evaluation:
    """Episodes of one policy: returns (n), and solved, solved_at_end, ended_s and broke (the limits that ended it) of
    each; None: does not apply."""

    returns: Array
    solved: list[Union[bool, None]]
    solved_at_end: list[Union[bool, None]]
    ended_s: list[Union[float, None]]
    broke: list[list[str]]

    def __repr__(self) -> str:
        return (f"<rehearse.Evaluation of {len(self.returns)} episodes: median return {np.median(self.returns):.4g}, "
                f"success rate {self.success_rate:.3g}>")

    @property
    def table(self) -> Array:
        """A row an episode: return, solved and solved_at_end (1, 0, or NaN), ended_s, broke (separated by "; ");
        pandas.DataFrame takes it."""
        columns: dict[str, Any] = {"return": self.returns, "solved": self.solved, "solved_at_end": self.solved_at_end,
                                   "ended_s": self.ended_s}
        numbers = {name: np.array(column, dtype=float) for name, column in columns.items()}
        return structured({**numbers, "broke": np.array(["; ".join(limits) for limits in self.broke], dtype=str)})

    def _repr_html_(self) -> str:
        quantiles = np.quantile(self.returns, [0.05, 0.5, 0.95])  # of one episode at least
        cells = [len(self.returns), *(f"{value:.4g}" for value in quantiles), f"{self.success_rate:.3g}"]
        return html_table(["episodes", "return 5%", "median", "95%", "success rate"], [cells])

    @property
    def success_rate(self) -> float:
        """The share of episodes that are solved at their end; NaN where the task cannot say."""
        known = [solved for solved in self.solved_at_end if solved is not None]
        return float(np.mean(known)) if known else float("nan")
