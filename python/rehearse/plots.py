"""Figures of runs, on Matplotlib. Imported where one is asked for, since Matplotlib may be missing."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any, Union

from matplotlib.figure import Figure

from .arrays import Array

if TYPE_CHECKING:
    from .campaigns import Campaign
    from .run import Run


class _Shown(Figure):  # type: ignore[misc]
    """A figure that pyplot does not know: it would keep all of them, and a notebook would show each twice. Notebooks show
    this one as what a cell returns, also where pyplot was never imported."""

    def _repr_png_(self) -> bytes:
        page = io.BytesIO()
        self.savefig(page, format="png")
        return page.getvalue()


def plot_parameters(parameters: Array) -> Any:
    if len(parameters) == 0:
        raise ValueError("the prior has no parameters to tune")
    figure = _Shown(figsize=(7, 0.6 + 0.9 * len(parameters)))
    axes = figure.subplots(len(parameters), 1, squeeze=False)
    for axis, row in zip(axes[:, 0], parameters):
        axis.plot([row["low"], row["high"]], [0, 0], "|-", markersize=12, label="95 % interval")
        axis.plot(row["value"], 0, "o", color="C0", label="value")
        axis.plot(row["prior"], 0, "x", color="C1", label="the prior's")
        axis.set(yticks=[], ylabel=row["parameter"], xlabel=row["unit"])
    axes[0, 0].legend(loc="best", fontsize="small")
    figure.tight_layout()
    return figure


def plot_run(run: Run, trial: Union[int, None]) -> Any:
    trials, best = run.trials, run.best
    if best is None:
        raise ValueError(f"{run.folder} has no trial yet")
    number = best.trial if trial is None else trial
    moved = run.trajectory(number)
    about = run._describe()
    panels = 1 + len(about["states"]) + len(about["actions"])
    figure = _Shown(figsize=(7, 2.0 * panels))
    axes = figure.subplots(panels, 1)
    axes[0].plot(trials["trial"], trials["return"], "o-", label="on the robot")
    axes[0].plot(trials["trial"], trials["predicted_return"], "x", label="predicted")
    axes[0].set(xlabel="trial", ylabel="return")
    axes[0].xaxis.get_major_locator().set_params(integer=True)
    axes[0].legend()
    expected = run.prediction(number) if (run.folder / "predictions" / f"trial-{number:03}.csv").exists() else None
    for axis, (name, unit) in zip(axes[1:], about["states"]):
        if expected is not None:
            axis.fill_between(expected["time"], expected[f"{name} 5%"], expected[f"{name} 95%"], alpha=0.3,
                              color="C1", label="90 % of simulated episodes")
            axis.plot(expected["time"], expected[f"{name} mean"], "--", color="C1", label="predicted mean")
        axis.plot(moved["time"], moved[name], label=f"trial {number}")
        axis.set(xlabel="time [s]", ylabel=f"{name} [{unit}]" if unit else name)
    for axis, (name, unit) in zip(axes[1 + len(about["states"]) :], about["actions"]):
        axis.step(moved["time"], moved[name], where="post")
        axis.set(xlabel="time [s]", ylabel=f"{name} [{unit}]" if unit else name)
    axes[1].legend()
    figure.tight_layout()
    return figure


def plot_campaign(campaign: Campaign) -> Any:
    figure = _Shown(figsize=(7, 4))
    axis = figure.subplots()
    for group in campaign.summary["groups"]:
        trials = [trial["trial"] for trial in group["trials"]]
        low, median, high = ([trial["return"][which] for trial in group["trials"]]
                             for which in ("quartile_1", "median", "quartile_3"))
        label = " ".join(part for part in (group["learner"], group["prior"], group["variant"]) if part)
        (line,) = axis.plot(trials, median, "o-", label=label)
        axis.fill_between(trials, low, high, alpha=0.2, color=line.get_color())
    axis.set(xlabel="trial", ylabel="return: median and quartiles", title=campaign.summary["title"])
    axis.xaxis.get_major_locator().set_params(integer=True)
    if campaign.summary["groups"]:
        axis.legend()
    figure.tight_layout()
    return figure
