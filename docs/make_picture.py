#!/usr/bin/env python3
"""Draws docs/pendubot.svg from a run folder: every trial's motion, and its return.

    docs/make_picture.py runs/demo > docs/pendubot.svg
"""
import csv
import math
import pathlib
import sys

WIDTH, HEIGHT = 290, 330  # of a panel
INK, FAINT, GOOD, BAD = "#20303c", "#8a98a3", "#0072b2", "#d55e00"  # readable by colour-blind readers


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def tip(row, x, y, scale):
    first = float(row["true theta1 [rad]"])
    second = float(row["true theta2 [rad]"])
    elbow = (x - scale * math.sin(first), y - scale * math.cos(first))
    end = (elbow[0] - scale * math.sin(second), elbow[1] - scale * math.cos(second))
    return elbow, end


def panel(left, trial, rows):
    x, y, scale = left + WIDTH / 2, 178, 62
    good = trial["solved"] == "1"
    colour = GOOD if good else BAD
    yield f'<text x="{x}" y="24" class="title">trial {trial["trial"]}</text>'
    yield f'<circle cx="{x}" cy="{y - 2 * scale}" r="{0.2 / 0.5 * scale:.1f}" fill="none" stroke="{FAINT}" stroke-dasharray="3 4"/>'
    path = []
    for index, row in enumerate(rows):
        elbow, end = tip(row, x, y, scale)
        path.append(end)
        opacity = 0.08 + 0.5 * (index / (len(rows) - 1)) ** 2
        yield (f'<polyline points="{x:.1f},{y} {elbow[0]:.1f},{elbow[1]:.1f} {end[0]:.1f},{end[1]:.1f}" fill="none" '
               f'stroke="{INK}" stroke-width="3" stroke-linecap="round" opacity="{opacity:.2f}"/>')
    yield '<polyline points="{}" fill="none" stroke="{}" stroke-width="1.6"/>'.format(
        " ".join(f"{px:.1f},{py:.1f}" for px, py in path), colour)
    yield f'<circle cx="{path[-1][0]:.1f}" cy="{path[-1][1]:.1f}" r="5" fill="{colour}"/>'
    word = "swung up" if good else "not yet"
    yield f'<text x="{x}" y="{HEIGHT - 6}" class="note">return {float(trial["return"]):.1f}, predicted {float(trial["predicted_return"]):.1f}: {word}</text>'


def main():
    run = pathlib.Path(sys.argv[1])
    trials = read(run / "trials.csv")[:3]
    width = WIDTH * len(trials)
    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {HEIGHT + 10}" role="img" '
          f'aria-label="The pendubot\'s motion in its first trials">')
    print(f'<style>text{{font:14px sans-serif;text-anchor:middle;fill:{INK}}}.title{{font-weight:bold}}'
          f'.note{{font-size:13px}}</style><rect width="100%" height="100%" fill="#fff"/>')
    for index, trial in enumerate(trials):
        rows = read(run / "trajectories" / f"trial-{int(trial['trial']):03d}.csv")
        print("\n".join(panel(index * WIDTH, trial, rows)))
    print("</svg>")


if __name__ == "__main__":
    main()
