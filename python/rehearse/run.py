"""Runs: begun, gone on with, and looked at."""

from __future__ import annotations

import os
import tempfile
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from html import escape
from pathlib import Path
from typing import Any, Union

import numpy as np

from . import _core
from .arrays import Array
from .checks import (function_or_none, number, option_texts, path_of, path_or_none, read_if_any, text, texts,
                     threads_of, truth, whole, whole_or_none, write_page)
from .evaluation import Evaluation
from .given_robot import Robots, begun_with, robot_of
from .policy import Policy
from .progress import show
from .robot import Robot
from .tables import TEXTS, WHOLE, as_files, from_csv, html_table, read_csv, without_path
from .trial import Trial

PathLike = Union[str, os.PathLike[str]]
Progress = Union[Callable[[dict[str, Any]], None], None]


class Run:
    """A run in its folder. `learn` and `open_run` give one.

    The folder is the truth (docs/run-folder.md): the command line, a campaign and another process see the same.
    """

    def __init__(self, folder: PathLike, robot: Union[Robot, None] = None) -> None:
        self.folder = Path(path_of("folder", folder)).absolute()
        if not (self.folder / "spec.toml").exists():
            raise _core.InvalidInput(f"{folder} is not a run folder")
        self._robot = begun_with(robot)

    # Results.

    @property
    def spec(self) -> dict[str, Any]:
        """The run's settings: robot, learner, prior, seed, planned (trials; 0: by `ask` and `tell`), until_solved, and options,
        every one as `options=` takes it: {"learner.search.finalists": "4", "scenario.start_noise": "0", …}."""
        about = self._describe()
        return {name: about[name] for name in ("robot", "learner", "prior", "seed", "planned", "until_solved", "options")}

    @property
    def asked(self) -> Union[Trial, None]:
        """The trial that `ask` gave the policy of, with what is predicted of it; None before `ask`, and once it is told."""
        asked = self._describe()["asked"]
        return asked and replace(Trial(**asked), total_reward=float("nan"))

    @property
    def trials(self) -> Array:
        """trials.csv as a structured array, a row a trial; pandas.DataFrame takes it."""
        return self.table("trials")

    def table(self, name: str) -> Array:
        """A CSV file of the folder by its name: "errors", "notes", "timings", "limits"."""
        path = self.folder / f"{name}.csv"
        if not path.exists():
            known = ", ".join(sorted(file.stem for file in self.folder.glob("*.csv")))
            raise _core.InvalidInput(f"{self.folder} has no {name}.csv (known: {known})")
        return read_csv(path, TEXTS, WHOLE)

    def trajectory(self, trial: int) -> Array:
        """The robot's motion: time, states measured and true, actions, reward; a row a step."""
        return self._table_of(trial, "trajectories")

    def prediction(self, trial: int) -> Array:
        """The model's expectation: mean and quantiles of each state; a row a step. The trial that is asked for has
        one, too."""
        return self._table_of(trial, "predictions")

    @property
    def details(self) -> list[Trial]:
        """All that is known of each trial."""
        return [Trial(**trial) for trial in self._describe()["trials"]]

    @property
    def best(self) -> Union[Trial, None]:
        """The trial of the highest return, of equals the first, none that was cut short unless all were; None before
        there is one."""
        best = self._describe()["best"]
        return Trial(**best) if best else None

    @property
    def solved_at(self) -> Union[int, None]:
        """The first trial that solved the task."""
        return next((trial.trial for trial in self.details if trial.solved), None)

    def policy(self, trial: Union[int, None] = None) -> Policy:
        """The policy of a trial, by default of the best."""
        return Policy(_core.policy(self._core, str(self.folder), whole_or_none("trial", trial)))

    # Actions.

    def resume(self, trials: Union[int, None] = None, *, threads: int = 0, progress: Progress = show) -> Run:
        """Goes on to the end, or to another number of trials. The same bytes as if it had never stopped."""
        _core.resume(self._core, str(self.folder), whole_or_none("trials", trials), threads_of(threads),
                 function_or_none("progress", progress))
        return self

    def ask(self, *, threads: int = 0, progress: Progress = None) -> Policy:
        """The policy of the next trial, for a robot that you drive. The same until the trial is told.

        `asked` is then what is predicted of it, the risks of limits too; its notes are warnings.
        """
        policy, trial = _core.ask(self._core, str(self.folder), threads_of(threads), function_or_none("progress", progress))
        for note in trial["notes"]:
            warnings.warn(note, stacklevel=2)
        return Policy(policy)

    def tell(self, *episodes: Any, stopped: Union[str, None] = None, at_fault: bool = True,
             threads: int = 0) -> dict[str, Any]:
        """The episode of the trial that was asked for; or, before the first, logs of other controllers.

        An episode is a CSV file, or a structured array, a DataFrame or a dictionary of columns: time [s], every state,
        every action, by name. A horizon of T steps takes T + 1 rows: the last has the final state, and needs no action.
        What is unlike the policy or the clock is warned of. stopped: why it was cut short; at_fault=False: not because of the policy.
        """
        stopped = None if stopped is None else text("stopped", stopped)
        at_fault = truth("at_fault", at_fault)
        if stopped is None and not at_fault:
            raise _core.InvalidInput("at_fault=False goes with stopped, which says why the episode was cut short")
        with tempfile.TemporaryDirectory() as folder:
            files = as_files(episodes, folder, "episode")
            with without_path(folder):
                told = dict(_core.tell(self._core, str(self.folder), files, stopped, at_fault, threads_of(threads)))
        if told["known_before"]:
            warnings.warn("this was told before: nothing changes", stacklevel=2)
        for note in told["notes"]:
            warnings.warn(note, stacklevel=2)
        return told

    def take_back(self, *, threads: int = 0) -> dict[str, Any]:
        """Takes the last `tell` back, when it took the wrong file: the folder is as before, byte for byte, but for
        taken-back, where what was told is kept. Again, it takes back the one before. Returns trial (None: logs) and files."""
        return dict(_core.take_back(self._core, str(self.folder), threads_of(threads)))

    def evaluate(self, episodes: int = 100, *, trial: Union[int, None] = None,
                 policy: Union[Policy, PathLike, None] = None, seconds: float = 0.0, seed: Union[int, None] = None,
                 options: Union[Mapping[str, Any], None] = None, threads: int = 0) -> Evaluation:
        """Episodes of a policy on the plant that are no trials; where there is none, the prior plays the robot, with the
        parameters of the newest model. policy: another than a trial's. seconds: of an episode; 0: the task's. seed: None
        is the run's. options: what is changed, {"plant.m": 0.6}; of an environment there are none, and
        `open_run(folder, other_robot)` evaluates on another one. An environment that is an object, not a function that
        makes one, and a class with `end`, which is a real robot, are used by one thread."""
        result = _core.evaluate(self._core, self._request(trial, policy, episodes, seconds, seed, options), self._threads_of(threads))
        return Evaluation(np.array(result["total_reward"]), result["solved"], result["solved_at_end"],
                          result["ended_s"], result["broke"])

    def robustness(self, episodes: int = 100, *, trial: Union[int, None] = None,
                   policy: Union[Policy, PathLike, None] = None, seconds: float = 0.0, seed: Union[int, None] = None,
                   options: Union[Mapping[str, Any], None] = None, threads: int = 0) -> Array:
        """Such episodes with one parameter of the robot changed at a time, by factors of 0.75 to 1.25: the rows of
        robustness.csv (docs/evaluate.md); a changed robot that fails has none, and a warning says why. An environment has
        no parameters to change."""
        text = _core.robustness(self._core, self._request(trial, policy, episodes, seconds, seed, options), self._threads_of(threads))
        return from_csv(text, TEXTS, WHOLE)

    def report(self, out: Union[PathLike, None] = None) -> Path:
        """Writes the page of the run, by default report.html in its folder."""
        return write_report(self.folder, out)

    def replay(self, trial: int, out: Union[PathLike, None] = None) -> Path:
        """Writes a page that shows how the robot moved in a trial, by default replay-003.html in the folder."""
        return write_replay(self.folder, self._done(trial), out)

    def plot(self, trial: Union[int, None] = None) -> Any:
        """A Matplotlib figure: returns by trial, and the states of one of them as predicted and as they were."""
        from .plots import plot_run

        return plot_run(self, trial)

    def _repr_html_(self) -> str:
        about = self._describe()
        head = f"{about['robot']} learned by {about['learner']}" + (f" from {about['prior']}" if about["prior"] else "")
        names = list(about["trials"][-1]["phi"]) if about["trials"] else []
        columns = ["trial", "return", "predicted", "solved", *names]
        rows = []
        for trial in about["trials"]:
            cells = [trial["trial"], _number(trial["total_reward"]), _number(trial["predicted_return"]),
                     {True: "yes", False: "no", None: ""}[trial["solved"]],
                     *(_number(trial["phi"].get(name)) for name in names)]
            rows.append(cells)
        return f"<p>{escape(head)}, seed {about['seed']}, in {escape(str(self.folder))}</p>{html_table(columns, rows)}"

    def __repr__(self) -> str:
        about = self._describe()
        earned = f", best return {about['best']['total_reward']:.4g}" if about["best"] else ""
        return f"<rehearse.Run {self.folder}: {len(about['trials'])} trials{earned}>"

    @property
    def _core(self) -> Any:
        return self._robot._core if self._robot is not None else _core.Robot("", "", "")

    def _request(self, trial: Union[int, None], policy: Union[Policy, PathLike, None], episodes: int, seconds: float,
                 seed: Union[int, None], options: Union[Mapping[str, Any], None]) -> Any:
        if trial is not None and policy is not None:
            raise _core.InvalidInput("trial and policy name two policies")
        return _core.EvaluationRequest(str(self.folder), whole_or_none("trial", trial), _json_of(policy) or None, option_texts(options),
                                       whole("episodes", episodes), number("seconds", seconds),
                                       None if seed is None else whole("seed", seed, 0, 2**53))

    def _threads_of(self, threads: int) -> int:
        return 1 if self._robot is not None and self._robot.one_at_a_time else threads_of(threads)

    def _table_of(self, trial: int, kind: str) -> Array:
        given = whole("trial", trial)
        path = self.folder / kind / f"trial-{given:03}.csv"
        if path.exists():  # of a trial that was asked for there is a prediction
            return read_csv(path, whole=("particles",) if kind == "predictions" else ())
        self._done(given)
        raise _core.InvalidInput(f"trial {given} of {self.folder} has no {kind}")

    def _done(self, trial: int) -> int:
        given, done = whole("trial", trial), len(self.trials)
        if done == 0:
            raise _core.InvalidInput("no trial is done yet")
        if not 1 <= given <= done:
            raise _core.InvalidInput(f"trial = {given}, must be between 1 and {done}, the trials that are done")
        return given

    def _describe(self) -> dict[str, Any]:
        return dict(_core.describe(self._core, str(self.folder)))


def learn(robot: Robots, learner: str = "", *, prior: Union[str, Sequence[str], None] = None, trials: int = 10,
          until_solved: bool = False, seed: int = 1, preset: PathLike = "",
          policy: Union[Policy, PathLike, None] = None, options: Union[Mapping[str, Any], None] = None,
          out: Union[PathLike, None] = None, threads: int = 0, progress: Progress = show) -> Run:
    """Learns a policy in a handful of trials, in a new folder.

    robot: a `Robot`, the name of a built-in one (`robots()`), or a robot's TOML file. learner: see `learners()`; "": gp-mi,
    without a prior black-drops.
    prior: a name, several, or None: the first. trials: 0 makes the folder alone, and `Run.ask` and `Run.tell` go on.
    policy: one to begin with, a `Policy` or its JSON file: searches start from it, too, and without a prior it is the
    first trial. options: as of `--set`, {"hidden": 20}. out: by default runs/ROBOT-LEARNER-PRIOR-SEED. threads: 0 are all cores; any
    number gives the same bytes, which are those of the command line. progress: function(event), see `show`.

    Where three trials or more are not solved, and actions seem to act late or the other way, a warning says so.
    Ctrl-C stops it, and `Run.resume` goes on. An exception of a function of the robot stops it, too, and comes out as
    it is. Raises InvalidInput with a line for everything that is wrong, RunFailed where plant or learner fail.
    """
    trials, seed, threads = whole("trials", trials), whole("seed", seed, 0, 2**53), threads_of(threads)
    core, scenario = robot_of(robot)
    names = ",".join(texts("prior", [] if prior is None else prior, "a name, several, or None"))
    own = robot if isinstance(robot, Robot) else None
    folder = _core.learn(core, scenario, text("learner", learner), names, path_of("preset", preset, "a name or a path"),
                         _json_of(policy), trials, truth("until_solved", until_solved), seed, option_texts(options),
                         path_or_none("out", out), threads, function_or_none("progress", progress))
    return Run(folder, own)


def open_run(folder: PathLike, robot: Union[Robot, None] = None) -> Run:
    """The run in a folder. robot: the `Robot` that it began with, where that has functions of Python, and the run is to
    go on or to be evaluated; to look at it, it is not needed. A robot whose environment is another evaluates on that."""
    return Run(folder, robot)


def resume(folder: PathLike, robot: Union[Robot, None] = None, trials: Union[int, None] = None, *, threads: int = 0,
           progress: Progress = show) -> Run:
    """Goes on with a run; see `Run.resume`."""
    return Run(folder, robot).resume(trials, threads=threads, progress=progress)


def write_report(folder: Path, out: Union[PathLike, None]) -> Path:
    """The page of a run or of a campaign."""
    from .__main__ import share

    return write_page(path_or_none("out", out) or folder / "report.html", _core.report(str(folder), str(share())))


def write_replay(folder: Path, trial: int, out: Union[PathLike, None], headline: str = "") -> Path:
    """The page of a trial's motion. headline: "": learner and robot."""
    from .__main__ import share

    page = _core.replay(str(folder), trial, headline, str(share()))
    return write_page(path_or_none("out", out) or folder / f"replay-{trial:03}.html", page)


def _json_of(policy: Union[Policy, PathLike, None]) -> str:
    """The text of a policy, or of its file; "": none."""
    return (policy._core.to_json() if isinstance(policy, Policy)
            else read_if_any("policy", policy, "a Policy, its JSON file, or None"))


def _number(value: Union[float, None]) -> str:
    return "" if value is None else f"{value:.4g}"
