"""Kinds of columns for scripts/tables: (heading, text of the runs of a row)."""
import math

from rates import mean_interval, rate
from runs import quantile, read_runs

NONE, NOT_RUN = "–", "?"


def number(value, digits):
    text = f"{value:.{digits}f}"
    return (text[1:] if float(text) == 0 and text[0] == "-" else text).replace("-", "−")


def spread(values, digits, end=None):
    """Median (quartiles), and the smallest or largest with end = min or max."""
    q1, q2, q3 = (number(quantile(values, p), digits) for p in (0.25, 0.5, 0.75))
    return f"{q2} ({q1} to {q3})" + (f", {number(end(values), digits)}" if end else "")


def field(heading, name, labels=None):
    return heading, lambda runs: (labels or {}).get(getattr(runs[0], name), str(getattr(runs[0], name)))


def firsts(heading, seeds):
    """At which trial each of these seeds first solved the task."""

    def text(runs):
        at = {run.seed: run.solved_at() or NONE for run in runs}
        return " ".join(str(at.get(seed, NOT_RUN)) for seed in seeds)

    return heading, text


def firsts_of(prior, seeds):
    """The same of the runs with this prior alone."""
    text = firsts(prior, seeds)[1]
    return prior, lambda runs: text([run for run in runs if run.prior == prior])


def counts(heading):
    """How many runs first solved the task at trial 1, 2, 3, …"""

    def text(runs):
        at = [run.solved_at() for run in runs if run.solved_at()]
        return " ".join(str(at.count(trial)) for trial in range(1, max(at, default=0) + 1))

    return heading, text


def solved(heading, by=math.inf, of="/"):
    def is_solved(run):
        return run.solved_at() is not None and run.solved_at() <= by

    return heading, lambda runs: f"{sum(map(is_solved, runs))}{of}{len(runs)}"


def more_than(heading, file, variant, unsolved):
    """By how many trials runs of a row take longer than those of another variant with their seeds: mean (95 %)."""
    others = {run.seed: run.solved_at() or unsolved for run in read_runs(file) if run.variant == variant}

    def text(runs):
        if runs[0].variant == variant:
            return ""
        more = [(run.solved_at() or unsolved) - others[run.seed] for run in runs if run.seed in others]
        low, high = mean_interval(more)
        return f"{number(sum(more) / len(more), 2)} ({number(low, 2)} to {number(high, 2)})"

    return heading, text


def times_as_much(heading, file):
    """The return of the last trial of this file's run with the same variant and seed, as a multiple of this run's."""
    others = {(run.variant, run.seed): last(run) for run in read_runs(file)}

    def text(runs):
        other = others.get((runs[0].variant, runs[0].seed))
        return NOT_RUN if other is None else NONE if last(runs[0]) <= 0 else number(other / last(runs[0]), 2)

    return heading, text


def first_text(trial):
    """Between a trial and none there is none."""
    return f"{trial:g}" if math.isfinite(trial) else NONE


def median_first(heading):
    """The trial that first solved the task: median (quartiles); one that solves nothing comes after all others."""

    def text(runs):
        at = [run.solved_at() or math.inf for run in runs]
        q1, q2, q3 = (first_text(quantile(at, p)) for p in (0.25, 0.5, 0.75))
        return f"{q2} ({q1} to {q3})"

    return heading, text


def spread_of(heading, value, digits, end=None):
    return heading, lambda runs: spread([value(run) for run in runs], digits, end)


def median(heading, values, digits):
    """Of all values of all runs of a row."""
    return heading, lambda runs: number(quantile([v for run in runs for v in values(run)], 0.5), digits)


def total(heading, value):
    return heading, lambda runs: str(sum(value(run) for run in runs))


def each(heading, digits, mark=""):
    """The return of each trial of the one run of a row; those that solved the task are marked."""

    def text(runs):
        return " ".join(number(float(t["return"]), digits) + (mark if t["solved"] == "1" else "")
                        for t in runs[0].trials)

    return heading, text


def broken(heading, said):
    """How many of the trials that were said to be so (scripts/limits) broke a limit."""

    def text(runs):
        trials = [trial for run in runs for trial in run.trials if trial["said"] == said]
        return rate(sum(trial["broken"] == "1" for trial in trials), len(trials))

    return heading, text


# Columns of lines without trials.


def in_order(heading, name):
    """A column of the lines of a row, one after the other."""
    return heading, lambda lines: " ".join(getattr(line, name) for line in lines)


def holds(heading, name, good, of="/"):
    """How many lines have a number in this column that is good."""
    return heading, lambda lines: f"{sum(good(float(getattr(line, name))) for line in lines)}{of}{len(lines)}"


def percent(heading, part, whole, chosen):
    """The share of the sums of two columns, over the lines that are chosen."""

    def text(lines):
        parts, wholes = (sum(int(getattr(line, name)) for line in filter(chosen, lines)) for name in (part, whole))
        return number(100 * parts / wholes, 0)

    return heading, text


def first_at(heading, good):
    return heading, lambda runs: str(runs[0].first(good) or NONE)


def one(heading, value, digits):
    """A number of the one run of a row."""
    return heading, lambda runs: number(value(runs[0]), digits)


def last(run):
    return run.returns()[-1]


def best(run):
    return max(run.returns())


def trial(k):
    return lambda run: run.returns()[k - 1]


def falls(run, episode_s=4):
    return sum(seconds < episode_s for seconds in run.seconds())


def solved_now(row):
    return row["solved"] == "1"


def reached(least):
    return lambda row: float(row["return"]) >= least
