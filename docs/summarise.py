#!/usr/bin/env python3
"""A table of run folders: for each learner and prior, when each seed first solved the task, and the best return.

    docs/summarise.py runs/*  > table.md
    docs/summarise.py --csv runs/* > trials.csv     every row of every run, with learner, prior and seed
"""
import csv
import pathlib
import statistics
import sys
import tomllib


def read(folder):
    spec = tomllib.loads((folder / "spec.toml").read_text())["run"]
    with open(folder / "trials.csv", newline="") as file:
        return spec, list(csv.DictReader(file))


def write_csv(runs):
    columns = ["learner", "prior", "seed"] + max((list(rows[0]) for _, rows in runs), key=len)
    out = csv.DictWriter(sys.stdout, columns, restval="")
    out.writeheader()
    for spec, rows in runs:
        for row in rows:
            out.writerow({"learner": spec["learner"], "prior": spec.get("prior", ""), "seed": spec["seed"]} | row)


def quartiles(values):
    if len(values) < 2:
        return f"{values[0]:.1f}"
    low, middle, high = statistics.quantiles(values, n=4, method="inclusive")
    return f"{middle:.1f} ({low:.1f} to {high:.1f})"


def write_table(runs):
    groups = {}
    for spec, rows in runs:
        groups.setdefault((spec["learner"], spec.get("prior", "")), []).append((spec["seed"], rows))
    print("| learner | prior | trials | seeds | first solved at trial, by seed | solved | last return: median (quartiles) | best return |")
    print("|---|---|---|---|---|---|---|---|")
    for (learner, prior), members in sorted(groups.items()):
        members.sort()
        first = [next((row["trial"] for row in rows if row["solved"] == "1"), "–") for _, rows in members]
        last = [float(rows[-1]["return"]) for _, rows in members]
        best = [max(float(row["return"]) for row in rows) for _, rows in members]
        seeds = f"{members[0][0]}–{members[-1][0]}" if len(members) > 1 else members[0][0]
        solved = f"{sum(f != '–' for f in first)}/{len(first)}"
        print(f"| {learner} | {prior or 'none'} | {max(len(rows) for _, rows in members)} | {seeds} | {' '.join(first)} | {solved} "
              f"| {quartiles(last)} | {quartiles(best)} |")


def main():
    arguments = sys.argv[1:]
    as_csv = arguments[:1] == ["--csv"]
    runs = [read(pathlib.Path(folder)) for folder in arguments[as_csv:]]
    (write_csv if as_csv else write_table)(runs)


if __name__ == "__main__":
    main()
