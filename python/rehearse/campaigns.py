"""Campaigns: grids of runs, with statistics and claims."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any, NamedTuple, Union

import numpy as np

from . import _core
from .arrays import Array
from .checks import function_or_none, mapping, mappings, path_of, path_or_none, read_text, text as text_of, threads_of, whole
from .progress import show
from .robot import Robot
from .given_robot import Robots, begun_with, name_of, robot_of
from .run import PathLike, Progress, Run, write_report
from .tables import WHOLE, column_of, html_table, read_csv, structured
from .toml import quoting, table

Options = Mapping[str, Any]
Names = Union[str, Sequence[str]]

_TEXTS = ("run", "claim", "learner", "prior", "priors", "variant", "variants", "state", "measure", "required", "result",
          "reason")
_QUARTILES = ("quartile_1", "median", "quartile_3")
_RETURNS = tuple(f"{kind}_{which}" for kind in ("return", "best_return") for which in _QUARTILES)


class Campaign:
    """A campaign in its folder (docs/campaigns.md). `campaign` and `open_campaign` give one.

    The tables are structured arrays, which pandas.DataFrame takes. What does not apply is NaN, or an empty text.
    """

    def __init__(self, folder: PathLike, robot: Union[Robot, None] = None) -> None:
        self.folder = Path(path_of("folder", folder)).absolute()
        if not (self._has("summary.json") or self._has("campaign.toml")):
            raise _core.InvalidInput(f"{folder} is not the folder of a campaign")
        self._robot = begun_with(robot)

    def _has(self, name: str) -> bool:
        return (self.folder / name).exists()

    def _table(self, name: str) -> Path:
        if not self._has(name):
            raise _core.InvalidInput(f"{self.folder} has no tables: the same call without share writes them")
        return self.folder / name

    @property
    def trials(self) -> Array:
        """campaign.csv: a row a trial of every run; run, scenario, learner, prior, variant, seed, and what `Run.trials`
        has."""
        return read_csv(self._table("campaign.csv"), ("run", "scenario", "learner", "prior", "variant"), WHOLE)

    @property
    def summary(self) -> dict[str, Any]:
        """summary.json, as docs/campaigns.md describes it."""
        return dict(json.loads(read_text(self._table("summary.json"))))

    @property
    def runs(self) -> Array:
        """A row a run: run (its name), learner, prior, variant, seed, state ("done", "failed" or "unfinished"), trials,
        first_success, best_return, reason (why it failed)."""
        names = ("run", "learner", "prior", "variant", "seed", "state", "trials", "first_success", "best_return",
                 "reason")
        return _table_of([{**run, "reason": run["reason"] or ""} for run in self.summary["runs"]], names)

    @property
    def groups(self) -> Array:
        """A row for the runs that differ in their seeds alone: learner, prior, variant, runs, done, failed; trial, the
        last that one of them has; solved_by, the share that had solved the task by then, and its 95 % interval low to
        high; quartiles of the return of that trial, and of the best until it."""
        return _table_of([_of_group(group) for group in self.summary["groups"]],
                         ("learner", "prior", "variant", "runs", "done", "failed", "trial", "solved_by", "low", "high",
                          *_RETURNS))

    @property
    def curves(self) -> Array:
        """Learning curves, a row a group and trial: learner, prior, variant, trial; runs that have it, with `until_solved`
        also those that ended before; interaction_s; how many had solved the task by then (count), their share
        (solved_by), and its 95 % interval low to high; quartiles of the return of that trial, and of the best until it."""
        return _table_of([{**group, **_of_trial(trial)} for group in self.summary["groups"] for trial in group["trials"]],
                         ("learner", "prior", "variant", "trial", "runs", "interaction_s", "count", "solved_by", "low", "high",
                          *_RETURNS))

    @property
    def claims(self) -> Array:
        """A row for each part of a claim: claim (its text), learner, priors, variants, measure, required, runs, of,
        count, estimate, its 95 % interval low to high, result ("pass", "fail" or "undecided"), reason."""
        names = ("learner", "priors", "variants", "measure", "required", "runs", "of", "count", "estimate", "low", "high",
                 "result", "reason")
        parts = [{**part, "claim": claim["text"], "priors": ",".join(part["priors"]),
                  "variants": ",".join(part["variants"]), "reason": part["reason"] or ""}
                 for claim in self.summary["claims"] for part in claim["parts"]]
        return _table_of(parts, ("claim", *names))

    def run(self, name: str) -> Run:
        """The run of that name; `runs["run"]` has the names."""
        known = self.runs["run"].tolist()
        if name not in known:
            raise _core.InvalidInput(f"{self.folder} has no run '{name}' (known: {', '.join(known)})")
        return Run(self.folder / "runs" / name, self._robot)

    def report(self, out: Union[PathLike, None] = None) -> Path:
        """Writes the page of the campaign, by default report.html in its folder."""
        return write_report(self.folder, out)

    def plot(self) -> Any:
        """A Matplotlib figure: the median return by trial of each learner, prior and variant, with quartiles."""
        from .plots import plot_campaign

        return plot_campaign(self)

    def _repr_html_(self) -> str:
        if not self._has("summary.json"):
            return f"<pre>{escape(repr(self))}</pre>"
        summary, groups, claims = self.summary, self.groups, self.claims
        counts = ", ".join(f"{number} {what}" for what, number in summary["counts"].items() if number or what == "runs")
        parts = [f"<p>{escape(summary['title'])}: {counts}, in {escape(str(self.folder))}</p>"]
        titles = ("learner", "prior", "variant", "done", "trial", "solved by then", "return (quartiles)")
        parts.append(html_table(titles, [_cells(group) for group in groups]))
        if len(claims):
            rows = [(row["result"], row["claim"], row["learner"], row["priors"], row["variants"], row["required"],
                     f"{row['estimate']:.3g}") for row in claims]
            titles = ("", "claim", "learner", "prior", "variant", "required", "estimate")
            parts.append(html_table(titles, rows))
        parts += [f"<p>{escape(row['run'])} failed: {escape(row['reason'])}</p>" for row in self.runs if row["reason"]]
        return "".join(parts)

    def __repr__(self) -> str:
        if not self._has("summary.json"):
            return f"<rehearse.Campaign {self.folder}: without tables>"
        counts = self.summary["counts"]
        failed = f", {counts['failed']} failed" if counts["failed"] else ""
        return f"<rehearse.Campaign {self.folder}: {counts['done']} of {counts['runs']} runs done{failed}>"


def campaign(given: Robots, robot: Union[Robots, None] = None, *, learners: Union[Names, None] = None,
             priors: Union[Names, None] = None, seeds: Union[int, str, Sequence[Union[int, str]], None] = None,
             trials: Union[int, None] = None, until_solved: Union[bool, None] = None, preset: Union[str, None] = None,
             set: Union[Options, None] = None, learner: Union[Mapping[str, Options], None] = None,
             vary: Union[Mapping[str, Sequence[Any]], None] = None, variant: Union[Sequence[Options], None] = None,
             draw: Union[Mapping[str, Sequence[float]], None] = None, claim: Union[Sequence[Options], None] = None,
             title: Union[str, None] = None, out: Union[PathLike, None] = None, share: Union[str, None] = None,
             threads: int = 0, progress: Progress = show) -> Campaign:
    """Runs a grid of learners × priors × varied options × seeds; it goes on where the folder has begun.

    given: a campaign's file, "NAME.toml"; or a robot as `learn` takes it, and the keys of such a file as arguments
    (docs/campaigns.md): learners and seeds ("1-30", [1, 2, 5], or a number: that seed alone) at least. robot: the robot
    that a file's `scenario` names, where it is an object. out: by default runs/NAME of a file, runs/ROBOT-campaign.
    threads: 0 are all cores; as many runs go at once, any number gives the same bytes, which are those of the command
    line. share: "3/20" does every 20th run, from the third on, beside other processes with the other numbers
    (docs/cluster.md); the same call without it writes the tables. An environment that is given as an object, not as a
    function that makes one, and a class with `end`, which is a real robot, are used by one run at a time. progress:
    function(event), see `show`.

    A run that fails is recorded, and does not stop the others. Ctrl-C stops it, and the same call goes on; finished runs
    are not repeated. So does an exception of a function of the robot, which comes out as it is. Raises InvalidInput with
    a line for everything that is wrong, before there is a folder.
    """
    keys = {"title": title, "learners": learners, "priors": priors, "seeds": seeds,
            "trials": None if trials is None else whole("trials", trials), "until_solved": until_solved,
            "preset": preset, "set": set, "learner": learner, "vary": vary, "variant": variant, "draw": draw,
            "claim": claim}
    keys = {key: _entry(key, entry) for key, entry in keys.items()}
    keys = {key: entry for key, entry in keys.items() if entry is not None}
    file = _file_of(given, robot, keys)
    folder = path_or_none("out", out) or f"runs/{Path(file.source).stem}"
    part = "1/1" if share is None else text_of("share", share)
    threads, progress = threads_of(threads), function_or_none("progress", progress)
    if file.robot is not None and file.robot.one_at_a_time:
        threads = 1
    try:
        _core.campaign(file.core, file.text, file.source, file.scenario, folder, part, threads, progress)
    except _core.InvalidInput as error:
        raise _core.InvalidInput(quoting(file.text.decode(errors="replace"), file.source, str(error))) from None
    except KeyboardInterrupt as stopped:
        if stopped.args or not Path(folder).exists():
            raise
        raise KeyboardInterrupt("interrupted: the same call goes on") from None
    return Campaign(folder, file.robot)


def open_campaign(folder: PathLike, robot: Union[Robot, None] = None) -> Campaign:
    """The campaign in a folder. robot: as of `open_run`, for its runs."""
    return Campaign(folder, robot)


def _entry(key: str, entry: Any) -> Any:
    """An argument of `campaign` as an entry of a campaign's file; None: it has none."""
    if entry is None:
        return None
    if key in ("learners", "priors"):
        return [entry] if isinstance(entry, str) else entry
    if key in ("set", "learner", "vary", "draw"):
        return mapping(key, entry)
    return mappings(key, entry) or None if key in ("variant", "claim") else entry


class _File(NamedTuple):
    """A campaign's file, and the robot that it is of."""

    text: bytes
    source: str
    scenario: str  # empty: the file alone says which
    core: Any  # the robot, for C++; empty where the scenario is
    robot: Union[Robot, None]  # as it was given, where it is an object


def _file_of(given: Robots, robot: Union[Robots, None], keys: dict[str, Any]) -> _File:
    name = "" if isinstance(given, Robot) else name_of(given)
    if name.endswith(".toml") and not keys:
        core, scenario = (_core.Robot("", "", ""), "") if robot is None else robot_of(robot)
        return _File(Path(name).read_bytes(), name, scenario, core, robot if isinstance(robot, Robot) else None)
    if name.endswith(".toml") and "learners" not in keys:
        raise _core.InvalidInput(f"learners is missing: {name} is taken for a robot's file, since that of a campaign is "
                                 "given without keys")
    if robot is not None:
        raise TypeError("robot goes with a campaign's file; else it is the first argument")
    core, scenario = robot_of(given)
    text = _text({"format": 1, "scenario": scenario, **keys})
    return _File(text.encode(), f"{scenario}-campaign", scenario, core, given if isinstance(given, Robot) else None)


def _text(keys: Mapping[str, Any]) -> str:
    """A campaign's file: values first, then tables, and lists of tables."""
    tables = {key: entry for key, entry in keys.items() if isinstance(entry, Mapping)}
    lists = {key: entry for key, entry in keys.items()
             if isinstance(entry, (list, tuple)) and entry and all(isinstance(each, Mapping) for each in entry)}
    parts = [table("", {key: entry for key, entry in keys.items() if key not in tables and key not in lists})]
    parts += [table(f"[{key}]", entry, every=True) for key, entry in tables.items()]
    parts += [table(f"[[{key}]]", each, every=True) for key, entries in lists.items() for each in entries]
    return "\n\n".join(parts) + "\n"


def _table_of(rows: Sequence[Mapping[str, Any]], names: Sequence[str]) -> Array:
    return structured({name: column_of([row[name] for row in rows], text=name in _TEXTS, whole=name in WHOLE)
                       for name in names})


def _of_group(group: Mapping[str, Any]) -> dict[str, Any]:
    """A group of summary.json as a row, with its last trial."""
    return {**_of_trial(group["trials"][-1] if group["trials"] else {"trial": 0}),
            **{name: group[name] for name in ("learner", "prior", "variant", "runs", "done", "failed")}}


def _of_trial(trial: Mapping[str, Any]) -> dict[str, Any]:
    """A trial of a group of summary.json; what is not known is None."""
    solved = trial.get("solved_by") or {}
    return {"trial": trial["trial"], "runs": trial.get("runs"), "interaction_s": trial.get("interaction_s"),
            "count": solved.get("count"), "solved_by": solved.get("rate"), "low": solved.get("low"), "high": solved.get("high"),
            **{f"{kind}_{which}": (trial.get(kind) or {}).get(which) for kind in ("return", "best_return")
               for which in _QUARTILES}}


def _cells(group: Any) -> list[Any]:
    """A row of `groups` for the page of a notebook."""
    solved = "" if np.isnan(group["solved_by"]) else (f"{group['solved_by']:.0%} ({group['low']:.2g} to "
                                                      f"{group['high']:.2g})")
    quartiles = f"({group['return_quartile_1']:.3g} to {group['return_quartile_3']:.3g})"
    returns = f"{group['return_median']:.3g} {quartiles}" if group["trial"] else ""
    return [group["learner"], group["prior"], group["variant"], f"{group['done']}/{group['runs']}", group["trial"],
            solved, returns]
