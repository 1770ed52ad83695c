"""The runs of results/*.csv, for scripts/tables and scripts/figures."""
import csv
import math
import os
from types import SimpleNamespace

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


class Run:
    """The trials of one run, in order, as the columns of campaign.csv."""

    def __init__(self, key):
        self.learner, self.prior, self.variant, self.seed = key
        self.trials = []

    def first(self, good):
        """The first trial that is good, or None."""
        return next((i for i, trial in enumerate(self.trials, 1) if good(trial)), None)

    def solved_at(self):
        return self.first(lambda trial: trial["solved"] == "1")

    def numbers(self, column):
        return [float(trial[column]) for trial in self.trials]

    def returns(self):
        return self.numbers("return")

    def seconds(self):
        """Of each trial on the robot."""
        ends = [0.0] + self.numbers("interaction_s")
        return [round(end - begin, 9) for begin, end in zip(ends, ends[1:])]


def read_runs(name):
    """In the order of results/NAME. A file without trials has lines instead, whose columns are attributes."""
    with open(os.path.join(ROOT, "results", name), encoding="utf-8", newline="") as file:
        lines = list(csv.DictReader(file))
    if "trial" not in lines[0]:
        return [SimpleNamespace(**line) for line in lines]
    runs = {}
    for line in lines:
        key = (line["learner"], line["prior"], line["variant"], int(line["seed"]))
        runs.setdefault(key, Run(key)).trials.append(line)
    return list(runs.values())


def quantile(values, p):
    """Linear between order statistics, as statistics/quantiles.hpp."""
    values = sorted(values)
    at = p * (len(values) - 1)
    low, high = math.floor(at), math.ceil(at)
    return values[low] + (at - low) * (values[high] - values[low])
