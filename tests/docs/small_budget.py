#!/usr/bin/env python3
"""`rehearse` as the commands of the documentation find it in tests/docs/blocks.py: the program, PROGRAM, with small budgets.

- `learn` does one trial with searches of 100 rollouts if the learner is of the Black-DROPS family, else none (`--trials 0`, which checks
  scenario, learner, prior, preset and every option); none on the hexapod. The same command with another seed, as in a loop, runs once.
- `resume` does one trial more. `campaign` gets --dry-run, `evaluate` 5 episodes, `identify` few rows and particles.
- `new` may make the file anew. Everything else runs as it stands.
"""
import os
import sys

SMALL = ["search.race.max_evaluations=100", "search.race.descents=2", "search.selection=5", "search.finalists=1", "retry.searches=0",
         "search.restarts.max_evaluations=100", "search.gradient.steps=10", "search.gradient.particles=8", "search.gradient.descents=1",
         "search.gradient.rounds=1"]
FAMILY = {"gp-mi", "mi", "black-drops", "black-drops-prior"}


def value_of(arguments, name, otherwise):
    return arguments[arguments.index(name) + 1] if name in arguments else otherwise


def without(arguments, name):
    if name not in arguments:
        return arguments
    at = arguments.index(name)
    return arguments[:at] + arguments[at + 2:]


def options(values):
    return [text for value in values for text in ("--set", value)]


def lines(path):
    with open(path) as file:
        return file.read().splitlines()


def small(arguments):
    """The same command with small budgets."""
    command = arguments[0] if arguments and "--help" not in arguments else ""
    if command == "learn":
        family = value_of(arguments, "--learner", "gp-mi") in FAMILY and "hexapod" not in arguments
        trials = min(int(value_of(arguments, "--trials", "1")), int(family))
        rest = without(without(arguments, "--trials"), "--threads")
        return rest + ["--trials", str(trials), "--threads", "1"] + options(SMALL if family else [])
    if command == "resume" and "--trials" in arguments:
        trials = os.path.join(arguments[1], "trials.csv")
        done = len(lines(trials)) - 1 if os.path.exists(trials) else 0
        return without(arguments, "--trials") + ["--trials", str(done + 1), "--threads", "1"]
    if command == "campaign":
        return arguments + ["--dry-run"]
    if command == "evaluate":
        return without(arguments, "--episodes") + ["--episodes", "5", "--threads", "1"]
    if command == "identify":
        return arguments + options(["rows=30", "particles=5"])
    if command == "new" and os.path.exists(arguments[1] + ".toml"):
        os.remove(arguments[1] + ".toml")
    return arguments


def main():
    arguments = small(sys.argv[1:])
    if arguments[:1] == ["learn"]:
        what = " ".join(without(arguments, "--seed"))
        if os.path.exists("learned") and what in lines("learned") and "--seed" in arguments:
            return  # another seed of a loop
        with open("learned", "a") as file:
            print(what, file=file)
    os.execv(os.environ["PROGRAM"], [os.environ["PROGRAM"], *arguments])


if __name__ == "__main__":
    main()
