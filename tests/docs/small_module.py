#!/usr/bin/env python3
"""small_module.py PAGE: runs the Python blocks of a page, a JSON list of [line, text] on standard input, in one namespace.

`rehearse.learn`, `campaign` and `identify` have small budgets here, as small_budget.py gives them to commands. The names that a page
takes for the reader's own are below. Errors name the line of the page.
"""
import functools
import json
import sys
import warnings

import numpy as np
import rehearse

import small_budget


def small(function, given):
    @functools.wraps(function)
    def with_small_budget(*arguments, options=None, **more):
        return function(*arguments, options={**given, **(options or {})}, **more)
    return with_small_budget


def small_campaign(function, given):
    """The same of campaigns whose keys are given; a file is as it stands."""
    @functools.wraps(function)
    def with_small_budget(*arguments, seeds=None, trials=None, set=None, **more):
        if seeds is None:
            return function(*arguments, **more)
        return function(*arguments, seeds="1-2", trials=1, set={**given, **(set or {})}, **more)
    return with_small_budget


def theirs():
    """What stands for a reader's robot, run, data and functions."""
    t, dtheta, theta, _, _, u, _ = np.genfromtxt("log3.csv", delimiter=",", skip_header=1)[:20].T  # cut short
    rng = np.random.default_rng(1)
    X, X_new = rng.uniform(-1, 1, (2, 20, 2))
    return {
        "rehearse": rehearse, "np": np, "Action": rehearse.Action, "robot": "pendulum",
        "run": rehearse.learn("my_robot.toml", trials=0, out="runs/of-python", progress=None),
        "t": t, "dtheta": dtheta, "theta": theta, "u": u,
        "state": np.zeros(2), "time_s": 0.0, "states": np.zeros((len(t), 4)),
        "X": X, "y": np.sin(X[:, 0]), "X_new": X_new, "y_new": np.sin(X_new[:, 0]), "m": np.zeros(2), "S": 0.01 * np.eye(2),
        "start": np.zeros(3), "f": lambda x: -np.sum(np.square(x), axis=1),
        "weights": np.zeros(33),  # 8 hidden units of 2 inputs, 1 action
        "performance": lambda x: -np.sum(np.square(x), axis=1), "descriptors": lambda x: (x[:, :2] + 1) / 2,
    }


def main():
    warnings.simplefilter("ignore")
    budget = dict(option.split("=") for option in small_budget.SMALL)
    rehearse.learn = small(rehearse.learn, budget)
    rehearse.campaign = small_campaign(rehearse.campaign, budget)
    rehearse.identify = small(rehearse.identify, {"rows": 30, "particles": 5})
    sys.path.insert(0, "")  # policy.py of `export`
    namespace = theirs()
    for line, text in json.load(sys.stdin):
        exec(compile("\n" * line + text, sys.argv[1], "exec"), namespace)


if __name__ == "__main__":
    main()
