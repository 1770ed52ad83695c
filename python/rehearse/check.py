"""Checks of a robot: faults that a learner would stumble over, found before anything is learned."""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Union

from . import _core
from ._core import InvalidInput
from .checks import path_or_none, truth
from .given_robot import Robots, robot_of
from .run import learn, write_replay
from .tables import without_path


@dataclass(frozen=True)
class PriorChecked:
    """A prior on the plant's steps. errors: of each state, root mean square error of its change in a step, NaN where there is
    no prediction; empty where this prior plays the robot. failed: rows without one. rows_per_s: on one thread. notes: on
    what may be wrong."""

    name: str
    errors: dict[str, float]
    failed: int
    rows_per_s: float
    notes: list[str]


@dataclass(frozen=True)
class Checked:
    """The findings of `check`. steps: of the plant, in so many episodes; played: the first prior played the robot instead;
    ended: episodes that ended early; broke: of each limit, those that broke it. changes: of each state, root mean square
    change in a step; empty where there was no step. notes: on what may be wrong with the task or its programs;
    complaints: what is wrong; a line each."""

    steps: int
    episodes: int
    played: bool
    ended: int
    broke: dict[str, int]
    changes: dict[str, float]
    priors: list[PriorChecked]
    notes: list[str]
    complaints: list[str]

    def __str__(self) -> str:
        early = [f"{self.ended} of {self.episodes} episodes ended early"] if self.ended else []
        early += [f"{count} of {self.episodes} episodes broke the limit {limit}" for limit, count in self.broke.items() if count]
        plays = " (the first prior plays the robot)" if self.played else ""
        lines = [", ".join([f"{self.steps} steps under random actions{plays}", *early]), *self.notes]
        for prior in self.priors:
            failed = f", {prior.failed} rows failed" if prior.failed else ""
            lines.append(f"prior {prior.name}: {prior.rows_per_s:.2g} rows a second on one thread{failed}")
            for state, change in self.changes.items():
                errs = f", the prior errs by {prior.errors[state]:.3g}" if state in prior.errors else ""
                lines.append(f"  {state}: a step changes it by {change:.3g}{errs}")
            lines += ["  " + note for note in prior.notes]
        noted = self.notes or any(prior.notes or prior.failed for prior in self.priors)
        well = ("nothing was tried: there is no prior, and no plant that may move" if self.steps == 0 else
                "nothing is broken, but see what is noted above" if noted else "all is well")
        return "\n".join([*lines, *(self.complaints or [well])])


def check(robot: Robots, *, plant: bool = True, out: Union[str, os.PathLike[str], None] = None) -> Checked:
    """Tries plant and priors on three episodes of random actions, which the plant does twice, as `rehearse check` does
    (docs/does-not-learn.md).

    Where there is no plant, or plant=False, the first prior plays the robot. out: a page, "robot.html", that shows how the
    plant moves in one more episode; it is left out where the plant fails, which then does not move again. A plant that is
    a real robot moves. Raises InvalidInput, or what a function raises.

    >>> print(rehearse.check(robot))
    """
    if out is not None and not truth("plant", plant):
        raise InvalidInput("out shows the plant's motion: leave plant=False out")
    page = path_or_none("out", out)
    if page:
        from .__main__ import share

        _core.check_page(page, str(share()))  # before the robot moves
    found = _core.check(*robot_of(robot), truth("plant", plant), bool(page))
    priors, failed = [PriorChecked(**prior) for prior in found.pop("priors")], found.pop("plant_failed")
    if page and not failed:
        _show_motion(robot, Path(page))
    return Checked(priors=priors, **found)


def _show_motion(robot: Robots, page: Path) -> None:
    """The first trial of a learner that has no model yet: random actions."""
    with tempfile.TemporaryDirectory() as folder, without_path(folder):
        run = learn(robot, "black-drops", trials=1, out=Path(folder) / "run", progress=None)
        write_replay(run.folder, 1, page, f"{run.spec['robot']}: an episode of random actions")
