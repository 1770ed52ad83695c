"""What a `Robot` is made of: states, actions, the task's parts, and models of its dynamics. Values alone."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Union

from .arrays import Array

#: function(states, actions, next_states) → n numbers; arrays of n rows
StepFunction = Callable[[Array, Array, Array], Any]
#: the same, or function(states, actions, next_states, actions_before, time_s) → n truths
LimitFunction = Union[StepFunction, Callable[[Array, Array, Array, Array, float], Any]]
#: function(states, actions) → a number; of a whole episode, T + 1 and T rows
EpisodeFunction = Callable[[Array, Array], Any]
#: function(states) → n truths; states: n × dx
StateFunction = Callable[[Array], Any]


@dataclass(frozen=True)
class State:
    """A state that the robot measures.

    unit: for tables and plots. angle: models and policies see its cosine and sine. rate: the state that is its
    derivative by time. parent: the angle of the link that carries this one. input: False for a position that the
    dynamics does not depend on. start, start_noise: mean and standard deviation at the start. scale: what the policy's
    input is divided by.
    """

    name: str
    unit: str = ""
    angle: bool = False
    rate: str = ""
    parent: str = ""
    input: bool = True
    start: float = 0.0
    start_noise: float = 0.0
    scale: float = 1.0


@dataclass(frozen=True)
class Action:
    """A number that moves the robot, inside its bounds, held for a control step.

    max_rate: of the command, in units of the action a second. filter_s: time constant of the low-pass that commands go
    through. delay_s: from the command until the robot gets it. lag_s: time constant with which it then follows. remember:
    policies see the commands of so many last steps. docs/actuators.md says when to use which.
    """

    name: str
    bounds: tuple[float, float]
    unit: str = ""
    max_rate: float = math.inf
    filter_s: float = 0.0
    delay_s: float = 0.0
    lag_s: float = 0.0
    remember: int = 0


@dataclass(frozen=True)
class Distance:
    """The reward exp(−Σ (distance / width)² / 2), of formulas that are all 0 at the goal: "1 + cos(angle)". width: the
    distance at which 0.61 is earned.

    All learners can use it; a function as reward is nothing for PILCO, which needs derivatives.
    """

    of: Union[str, Sequence[str]]
    width: float = 1.0


@dataclass(frozen=True)
class Success:
    """A trial is solved where this holds in the last seconds of a complete episode. when: a formula, or function(states) →
    n truths. last_s: how long [s]; 0: in the last state."""

    when: Union[str, StateFunction]
    last_s: float = 0.0


@dataclass(frozen=True)
class Limit:
    """A condition that every step must keep: a formula, or a function of states, actions and the states that the steps
    reach.

    A function of five arguments is given the actions one step before, too (0 in the first step), and the time since the
    start when the steps begin, in s. risk: the largest probability that an episode of a policy breaks it.
    """

    keep: Union[str, LimitFunction]
    name: str = ""
    risk: float = 0.05


@dataclass(frozen=True)
class Body:
    """How a part of the robot looks: a line between two points [m], formulas of states."""

    name: str
    start: tuple[str, str]
    end: tuple[str, str]
    width_m: float = 0.05


@dataclass(frozen=True)
class Model:
    """How states change in a control step: a prior, or a plant that is simulated.

    change: function(states, actions, **parameters) → the changes of the states, n × dx. It is called with thousands of
    rows, by any thread, one at a time. A row depends on that row alone; one that cannot be simulated is NaN. rates:
    instead, a formula for the derivative of each state by time. parameters: the function's, or the formulas', at the
    values to start from. units: of parameters, for tables and figures. tune: of a prior, those that are learned, between
    bounds (low, high), or among a list of values. delay_s, lag_s: of a plant, by action, where they are others than
    `Action` says.
    """

    change: Union[Callable[..., Any], None] = None
    rates: Mapping[str, str] = field(default_factory=dict)
    parameters: Mapping[str, float] = field(default_factory=dict)
    tune: Mapping[str, Any] = field(default_factory=dict)
    define: Mapping[str, str] = field(default_factory=dict)
    delay_s: Mapping[str, float] = field(default_factory=dict)
    lag_s: Mapping[str, float] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
