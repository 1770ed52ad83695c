"""A robot as Python describes it: what it measures, what moves it, the task, and guesses of its dynamics.

The keys are those of a robot's file (docs/own-robot.md). Where a file has a formula, a function may stand.
"""

from __future__ import annotations

import inspect
import os
import warnings
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, Union

import numpy as np

from . import _core
from .arrays import Array
from .checks import mapping, number, read_text, text, texts, whole
from .environment import Task, environment_maker, is_environment, is_real
from .parts import (Action, Body, Distance, EpisodeFunction, Limit, Model, State, StateFunction, StepFunction,
                    Success)
from .toml import quoting, table, value


class Robot:
    """A robot, its task, and guesses of its dynamics.

    name: letters, digits, - and _. dt_s: seconds of a control step. horizon: control steps of an episode. states,
    actions: lists of `State` and `Action`, in the order of the columns that functions get. success: a `Success`, or
    None. limits: a list of `Limit`. define: names for parts of formulas. bodies: a list of `Body`, what reports draw.
    summary: a line about it.
    reward: what a step earns by the state that it reaches: a `Distance`, a formula, or function(states, actions,
    next_states) → n numbers. cost: a formula that is subtracted. episode_reward: what a whole episode adds to
    its return, a formula (docs/own-robot.md) or function(states, actions) → a number, of T + 1 and T rows. floor: what every step earns that a fall leaves out.
    ended: a fall, a formula or function(states) → n truths (True or False).
    plant: what plays the robot: an environment with `reset` and `step` as Gymnasium has them, a function that makes
    one, a `Model`, or None: the trials are yours (`Run.ask`, `Run.tell`). observe: function(observation) → state, where
    an environment's observations are no states. measurement_noise: a number for every state, or {"angle": 0.002} for
    those that have some, where the plant is a `Model`.
    priors: guesses by name, the first is the default. policy: options of the policy, {"hidden": 20}.

    Raises InvalidInput at once, with a line for everything that is wrong.
    """


    def __init__(
        self,
        name: str,
        *,
        dt_s: float,
        horizon: int,
        states: Sequence[State],
        actions: Sequence[Action],
        reward: Union[Distance, str, StepFunction],
        success: Union[Success, None] = None,
        ended: Union[str, StateFunction, None] = None,
        limits: Sequence[Limit] = (),
        plant: Any = None,
        priors: Union[Mapping[str, Model], None] = None,
        observe: Union[Callable[[Any], Any], None] = None,
        measurement_noise: Union[float, Mapping[str, float]] = 0.0,
        cost: str = "",
        episode_reward: Union[str, EpisodeFunction, None] = None,
        floor: float = 0.0,
        define: Union[Mapping[str, str], None] = None,
        policy: Union[Mapping[str, Any], None] = None,
        bodies: Sequence[Body] = (),
        summary: str = "",
    ) -> None:
        if callable(cost):
            raise TypeError("cost is a function, must be a formula; what a function costs is subtracted in reward")
        _require(states, State, "states", "[State(\"angle\", angle=True), …]")
        _require(actions, Action, "actions", "[Action(\"torque\", (-1, 1)), …]")
        _require(limits, Limit, "limits", "[Limit(\"abs(x) < 1\"), …]")
        _require(bodies, Body, "bodies", "[Body(…), …]")
        _require([success] if success is not None else [], Success, "success", "Success(when, last_s)")
        if priors is not None and not isinstance(priors, Mapping):
            raise TypeError(f"priors is a {type(priors).__name__}, must be a dictionary: {{\"guess\": Model(…)}}")
        _require(list((priors or {}).values()), Model, "priors", "{\"guess\": Model(…)}")
        self.name = name
        self._dt_s, horizon = number("dt_s", dt_s), whole("horizon", horizon)
        self._functions: list[tuple[Any, ...]] = []
        self.one_at_a_time = False  # its plant: one object, or a real robot
        _refuse_observe(plant, observe)
        parts = [table("", {"format": 1, "name": name, "summary": summary, "dt_s": self._dt_s, "horizon": horizon,
                            "ended": self._formula("ended", ended)})]
        parts += [_state(state) for state in states]
        parts += [_action(action) for action in actions]
        parts.append(table("[define]", mapping("define", define or {})))
        parts.append(table("[reward]", {**self._reward(reward), "cost": cost or None,
                                      "episode": self._formula("episode_reward", episode_reward, "add_episode_function"),
                                      "floor": number("floor", floor)}))
        if success is not None:
            when = self._formula("success", success.when)
            parts.append(table("[success]", {"when": when, "last_s": number("last_s", success.last_s)}))
        for count, limit in enumerate(limits, 1):
            parts.append(table("[[limit]]", self._limit(limit, f"limit {count}" if len(limits) > 1 else "limit")))
        for prior, model in {str(key): each for key, each in (priors or {}).items()}.items():
            if model.delay_s or model.lag_s:
                raise _core.InvalidInput(f"{prior}: delay_s and lag_s are of a Model that is the plant; what models know "
                                         "of them is in Action")
            parts.append(self._dynamics(prior, model))
            tune = {n: _tune(f"{prior}: tune of {n}", t) for n, t in mapping(f"{prior}: tune", model.tune).items()}
            parts.append(table(f"[prior.{value(prior)}]", {"dynamics": prior, "tune": tune}))
        parts += self._plant(plant, observe, Task(horizon, states, actions), list(map(str, priors or {})),
                             measurement_noise)
        parts.append(table("[policy]", mapping("policy", policy or {}), every=True))
        parts += [table("[[body]]", {"name": b.name, "from": list(b.start), "to": list(b.end), "width_m": b.width_m})
                  for b in bodies]
        self.text = "\n".join(part for part in parts if part)
        self._source, self._folder = f"robot {name}", ""
        self._check()

    @classmethod
    def from_file(cls, path: Union[str, os.PathLike[str]], *, plant: Any = None,
                  observe: Union[Callable[[Any], Any], None] = None) -> Robot:
        """The robot of a TOML file (docs/own-robot.md). plant: an environment, where the file has no [plant]."""
        _refuse_observe(plant, observe)
        robot = cls.__new__(cls)
        robot.text = read_text(path)
        robot._functions = []
        robot.one_at_a_time = False
        robot._source, robot._folder = os.fspath(path), _core.folder_of_files(os.path.abspath(path))
        about = robot._core.about()
        robot.name, robot._dt_s = about["name"], about["dt_s"]
        if plant is not None:
            if about["has_plant"]:
                raise _core.InvalidInput(f"{robot._source} has a [plant], and plant= is another: give one of them")
            task = Task(about["horizon"], [State(**state) for state in about["states"]],
                        [Action(**action) for action in about["actions"]])
            robot.text += "\n\n" + "\n".join(robot._plant(plant, observe, task, about["dynamics"], 0.0))
        robot._core.check()
        return robot

    def __repr__(self) -> str:
        return f"<rehearse.Robot {self.name}>"

    @property
    def _core(self) -> Any:
        """The robot for C++, made anew: the garbage collector could not see what functions of a kept one hold."""
        core = _core.Robot(self.text, self._source, self._folder)
        for add, *arguments in self._functions:
            getattr(core, add)(*arguments)
        return core

    def _check(self) -> None:
        """Refuses a robot that is wrong; lines of its text, which nobody may have seen, are quoted."""
        try:
            self._core.check()
        except _core.InvalidInput as error:
            raise _core.InvalidInput(quoting(self.text, self._source, str(error))) from None

    def _formula(self, name: str, formula: Any, add: str = "add_state_function") -> Union[str, None]:
        if not callable(formula):
            return None if formula is None else str(formula)
        self._functions.append((add, name, formula))
        return "@" + name

    def _reward(self, reward: Any) -> dict[str, Any]:
        if isinstance(reward, Distance):
            of = texts("of of Distance", reward.of, "a formula, or several")
            return {"distance": of, "width": number("width", reward.width)}
        return {"formula": self._formula("reward", reward, "add_step_function")}

    def _limit(self, limit: Limit, nameless: str) -> dict[str, Any]:
        """nameless: the name of a function that has none."""
        name = limit.name or (limit.keep if isinstance(limit.keep, str) else getattr(limit.keep, "__name__", nameless))
        if name == "<lambda>":
            name = nameless
        keep: Any = limit.keep
        if callable(keep):
            self._functions.append(("add_step_condition", name, _of_whole_steps(keep)))
            keep = "@" + name
        return {"name": name, "keep": keep, "risk": number("risk", limit.risk)}

    def _dynamics(self, name: str, model: Model) -> str:
        if (model.change is None) == (not model.rates):
            raise _core.InvalidInput(f"{name}: a Model has either change=, a function, or rates=, formulas")
        if not isinstance(model.rates, Mapping):
            raise TypeError(f"{name}: rates is a {type(model.rates).__name__}, must be formulas by state; a function is "
                            "change=, and change=rk4(f, dt_s) where it returns derivatives")
        if model.change is not None and not callable(model.change):
            raise TypeError(f"{name}: change is a {type(model.change).__name__}, must be a function; formulas are rates=")
        if model.change is not None and model.define:
            raise _core.InvalidInput(f"{name}: define is for the formulas of rates=, and change= is a function")
        dt_s = getattr(model.change, "dt_s", None)  # of rk4
        if dt_s is not None and dt_s != self._dt_s:
            raise _core.InvalidInput(f"{name}: rk4 was given dt_s = {dt_s}, the robot {self._dt_s}")
        how: dict[str, Any] = {"rate": dict(model.rates), "define": dict(mapping(f"{name}: define", model.define))}
        if model.change is not None:
            how = {"function": name}
            names = [text(f"{name}: a name of parameters", key) for key in model.parameters]
            self._functions.append(("add_dynamics", name, model.change, names))
        return table(f"[dynamics.{value(name)}]", {**how, "parameters": _parameters(name, model)})

    def _plant(self, plant: Any, observe: Any, task: Task, taken: Sequence[str],
               noise: Union[float, Mapping[str, float]]) -> list[str]:
        """taken: names of dynamics; a run's robot keeps the name, so it is "plant" wherever it can be."""
        given: Any = ({key: number(f"measurement_noise of {key}", of) for key, of in noise.items()}
                      if isinstance(noise, Mapping) else number("measurement_noise", noise) or None)
        if plant is None:
            if given:
                raise _core.InvalidInput("measurement_noise is of a plant, and plant is None; where a prior plays the robot, "
                                         "options={\"measurement_noise\": …} of evaluate has it")
            return []
        if isinstance(plant, Model):
            if plant.tune:
                raise _core.InvalidInput("plant: tune is of priors; a plant's parameters are what they are")
            name = "the plant" if "plant" in taken else "plant"  # no prior has a name with a space
            return [self._dynamics(name, plant),
                    table("[plant]", {"dynamics": name, "measurement_noise": given,
                                      "delay_s": dict(mapping("plant: delay_s", plant.delay_s)),
                                      "lag_s": dict(mapping("plant: lag_s", plant.lag_s))})]
        self.one_at_a_time = is_environment(plant) or is_real(plant)
        self._functions.append(("add_plant", "plant", environment_maker(plant, observe, task)))
        return [table("[plant]", {"function": "plant", "measurement_noise": given})]


def _refuse_observe(plant: Any, observe: Any) -> None:
    """Refuses what would not be called."""
    if observe is not None and (plant is None or isinstance(plant, Model)):
        raise _core.InvalidInput(f"observe goes with an environment, and plant is {'None' if plant is None else 'a Model'}")


def _of_whole_steps(keep: Callable[..., Any]) -> Callable[..., Any]:
    """The function of a limit, with all five arguments."""
    try:
        parameters = list(inspect.signature(keep).parameters.values())
    except (TypeError, ValueError):  # it does not say
        parameters = []
    positional = [p for p in parameters if p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD)]
    needed = [p for p in positional if p.default is p.empty]
    if len(needed) == 5 or len(positional) == 5 and positional[4].name in ("time_s", "time", "t"):
        return keep
    return partial(_of_three, keep)


def _of_three(keep: Callable[..., Any], states: Array, actions: Array, next_states: Array, *_: Any) -> Any:
    return keep(states, actions, next_states)


def _parameters(name: str, model: Model) -> dict[str, Any]:
    units = mapping(f"{name}: units", model.units)
    given = {key: number(f"{name}: {key}", of) for key, of in mapping(f"{name}: parameters", model.parameters).items()}
    for key in units:
        if key not in given:
            raise _core.InvalidInput(f"{name}: units of {key}, which is no parameter (there are: {', '.join(given)})")
    return {key: {"value": of, "unit": str(units[key])} if key in units else of for key, of in given.items()}


def _tune(name: str, given: Any) -> Any:
    """Bounds, or choices among a list."""
    if isinstance(given, Mapping):
        return given
    if not isinstance(given, list):
        return _bounds(name, given)
    if len(given) == 2 and any(isinstance(each, float) for each in given):
        warnings.warn(f"{name} = {given}: a list is two choices; bounds are a tuple, ({given[0]:g}, {given[1]:g})", stacklevel=4)
    return {"choices": given}


def _bounds(name: str, given: Any) -> list[float]:
    if not isinstance(given, (list, tuple, np.ndarray)):
        raise TypeError(f"{name} = {given!r}, must be (low, high)")
    return [number(name, bound) for bound in given]


def _require(given: Any, kind: type, name: str, like: str) -> None:
    if not isinstance(given, (list, tuple)) or not all(isinstance(each, kind) for each in given):
        raise TypeError(f"{name} must be like {like}")


def _state(state: State) -> str:
    known = State("")
    given = {key: getattr(state, key) for key in State.__dataclass_fields__}
    return table("[[state]]", {k: v for k, v in given.items() if k == "name" or v != getattr(known, k)}, every=True)


def _action(action: Action) -> str:
    known = Action("", (0.0, 0.0))
    given = {key: getattr(action, key) for key in ("max_rate", "filter_s", "delay_s", "lag_s", "remember")}
    return table("[[action]]", {"name": action.name, "unit": action.unit, "bounds": _bounds(f"bounds of {action.name}", action.bounds),
                                **{k: v for k, v in given.items() if v != getattr(known, k)}}, every=True)
