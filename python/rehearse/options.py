"""Robots, learners and presets that there are, and their options."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Union

from . import _core
from .checks import truth
from .given_robot import Robots, robot_of


@dataclass(frozen=True)
class Option:
    """An option of a learner or a robot, as `options=` of `learn` takes it. value: the default; it and published, the
    paper's value where that is another, are texts. bounds: what it may be; choices: one of these, if any."""

    value: str
    help: str
    bounds: str
    choices: list[str]
    published: Union[str, None]
    expert: bool


def options(of: Robots, *, expert: bool = False) -> dict[str, Option]:
    """The options, by name, of a learner, of a robot as `learn` takes it, or of "identify". expert: those, too, that
    few need to know. docs/options.md has all.

    >>> rehearse.options("gp-mi")["search.race.max_evaluations"].value
    '100000'
    """
    named = isinstance(of, str) and of in (*learners(), "identify")
    robot, name = (_core.Robot("", "", ""), str(of)) if named else robot_of(of)
    entry, all_of_them = json.loads(_core.entry(robot, name)), truth("expert", expert)
    return {field["name"]: Option(field["value"], field["help"], field["bounds"], field["choices"],
                                  entry["published"].get(field["name"], {}).get("value"), field["expert"])
            for field in entry["fields"] if all_of_them or not field["expert"]}


def robots() -> dict[str, tuple[str, list[str]]]:
    """The built-in robots: what each is, and its priors."""
    return dict(_core.known()["robots"])


def learners() -> dict[str, str]:
    """The learners, and what each is."""
    return dict(_core.known()["learners"])


def presets() -> dict[str, str]:
    """The presets, and what each is."""
    return dict(_core.known()["presets"])
