"""A robot from logs alone."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any, Union

from . import _core
from .arrays import Array
from .checks import option_texts, text, threads_of, write_page
from .given_robot import Robots, robot_of
from .tables import TEXTS, as_files, from_csv, without_path


@dataclass(frozen=True, eq=False, repr=False)
class Identification:
    """The result of `identify`: a robot's parameters as logs tell them (docs/identify.md).

    parameters: value and 95 % interval of each, with those that leave a log out. accuracy: errors and coverage of
    forecasts of logs left out, by horizon and state. tables: all, by name. summary: in words. notes: how logs were
    read. page: HTML.
    """

    tables: dict[str, Array]
    summary: str
    notes: list[str]
    page: str

    @property
    def parameters(self) -> Array:
        """Value and 95 % interval of each, and those without a log; a row a parameter."""
        return self.tables["parameters"]

    @property
    def accuracy(self) -> Array:
        """Errors and coverage of forecasts, a row a horizon and state."""
        return self.tables["accuracy"]

    def report(self, path: Union[str, os.PathLike[str]]) -> Path:
        """Writes the page, which opens in a browser."""
        return write_page(path, self.page)

    def plot(self) -> Any:
        """A Matplotlib figure: each parameter with its 95 % interval and the prior's value."""
        from .plots import plot_parameters

        return plot_parameters(self.parameters)

    def _repr_html_(self) -> str:
        return f"<pre>{escape(self.summary)}</pre>"

    def __repr__(self) -> str:
        found = ", ".join(f"{row['parameter']} {row['value']:.4g} ({row['low']:.4g} to {row['high']:.4g})"
                          for row in self.parameters)
        return f"<rehearse.Identification: {found or 'no parameters'}>"

    def __str__(self) -> str:
        return self.summary


def identify(robot: Robots, logs: Sequence[Any], *, held_out: Sequence[Any] = (), prior: Union[str, None] = None,
             options: Union[Mapping[str, Any], None] = None, threads: int = 0) -> Identification:
    """Parameters of a prior, and what it cannot explain, from logs of whatever controller (docs/identify.md).

    logs, held_out: CSV files, or structured arrays, DataFrames or dictionaries of columns: time, states, actions.
    options: as of `rehearse identify --set`. The same result for any number of threads.
    """
    logs, held_out = _several(logs), _several(held_out)
    prior = None if prior is None else text("prior", prior)
    with tempfile.TemporaryDirectory() as folder, without_path(folder):
        learned_from = as_files(logs, folder, "log")
        forecast = as_files(held_out, folder, "held-out")
        core, scenario = robot_of(robot)
        result = _core.identify(core, scenario, prior, option_texts(options), learned_from, forecast, threads_of(threads))
    tables = {Path(name).stem: from_csv(table, *_kinds_of(name)) for name, table in result["tables"]}
    summary = "\n\n".join("\n  ".join([title, *lines]) for title, lines in result["summary"])
    return Identification(tables, summary, result["notes"], result["page"])


def _several(logs: Any) -> Sequence[Any]:
    """A list of logs, of which there may be one alone."""
    return logs if isinstance(logs, (list, tuple)) else [logs]


def _kinds_of(name: str) -> tuple[Collection[str], Collection[str]]:
    """The columns of a table that are texts, and those of whole numbers. States have columns of their own name in two."""
    if name.startswith("forecasts"):
        return (), ()
    return (("log", "set"), ()) if name.startswith("zeros") else (TEXTS, ("compared",))
