"""Messages of the library, which is the command line's too, as they help in Python."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Union

from ._core import InvalidInput
from .robot import Robot

_FUNCTION = re.compile(r"^.*: line \d+: '([^']*)' is a function of the program that wrote this file, .*\n?", re.MULTILINE)
_OPTION = re.compile(r"(unknown option '(?:scenario\.)?plant\.[^']*').*")
_PARAMETER = re.compile(r".*has no parameter scenario\.plant\.NAME that could be changed")
_ENVIRONMENT = ("the plant is an environment, whose parameters Rehearse does not know. A robot with another environment "
                "can be tried: rehearse.open_run(folder, other_robot).evaluate(100)")


@contextmanager
def said_for_python(robot: Union[Robot, None] = None, run: Union[Path, None] = None) -> Iterator[None]:
    """What is refused inside is said as `for_python` says it."""
    try:
        yield
    except InvalidInput as error:
        said = for_python(str(error), robot, run)
        if said == str(error):
            raise
        raise InvalidInput(said) from None


def for_python(message: str, robot: Union[Robot, None] = None, run: Union[Path, None] = None) -> str:
    """run: the folder of the run that it is about, if it is about one."""
    names = list(dict.fromkeys(_FUNCTION.findall(message)))
    if names and robot is None and run is not None:
        line = (f"{run}: its robot has functions of Python ({', '.join(names)}), which no folder keeps. Give the robot "
                f"again: {_opened(run)}")
        message = "\n".join(filter(None, [line, _FUNCTION.sub("", message).rstrip("\n")]))
    if robot is not None and robot.plays_environment:
        message = _OPTION.sub(lambda found: f"{found[1]}: {_ENVIRONMENT}", message)
        message = _PARAMETER.sub(lambda _: f"robustness changes parameters of the plant, and {_ENVIRONMENT}", message)
    return message.replace("`list` of ", "`rehearse.options` of ")


def _opened(run: Path) -> str:
    """How a run is opened with its robot."""
    alone = "rehearse.open_run(folder, robot)"
    of_campaign = run.parent.name == "runs" and (run.parent.parent / "campaign.toml").exists()
    return f"rehearse.open_campaign(folder, robot).run('{run.name}'), or {alone}" if of_campaign else alone
