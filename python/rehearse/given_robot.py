"""A robot as functions take it: a `Robot`, the name of a built-in one, or a robot's TOML file."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Union

from . import _core
from .checks import path_of
from .robot import Robot

Robots = Union[Robot, str, os.PathLike[str]]


def robot_of(robot: Robots) -> tuple[Any, str]:
    """The robot for C++, and the name of its scenario."""
    if isinstance(robot, Robot):
        return robot._core, robot.name
    name = name_of(robot)
    if Path(name).name == "spec.toml":
        raise _core.InvalidInput(f"{name} is a run's spec, not a robot: `rehearse learn {name}` repeats the run")
    if name.endswith(".toml"):
        return robot_of(Robot.from_file(name))
    return _core.Robot("", "", ""), name


def name_of(robot: Union[str, os.PathLike[str]]) -> str:
    """The name or the path of a robot that is no object."""
    return path_of("robot", robot, "a Robot, the name of a built-in one, or a path")


def begun_with(robot: Any) -> Union[Robot, None]:
    """The robot that a folder is opened with, or None."""
    if robot is not None and not isinstance(robot, Robot):
        raise TypeError(f"robot is {robot!r}, must be the Robot that the folder began with")
    return robot
