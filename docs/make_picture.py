#!/usr/bin/env python3
"""Draws the first two trials of a run, moving one after the other, as an SVG that plays as a picture of a page.

    docs/make_picture.py runs/first > docs/pendubot.svg

The robot is solid, what the model predicted before the trial is dashed. A reader who asks for less motion sees the traces alone.
It takes any robot that moves in a plane: a run folder with motion/ (docs/run-folder.md).
"""
import csv
import json
import pathlib
import sys

WIDTH, HEIGHT = 330, 360   # of a panel
REST_S, END_S = 0.8, 1.6   # the robot stands still after a trial, and at the end
INK, FAINT, GOOD, BAD = "#20303c", "#8a98a3", "#0072b2", "#d55e00"  # readable by colour-blind readers


class Panel:
    def __init__(self, run, left, trial):
        name = f"{int(trial['trial']):03d}.json"
        self.trial, self.left = trial, left
        self.real = json.loads((run / "motion" / f"trial-{name}").read_text())
        self.model = json.loads((run / "motion" / f"prediction-{name}").read_text())
        reach = max(abs(v) for frame in self.real["frames"] + self.model["frames"] for v in frame)
        self.scale = 0.42 * WIDTH / (1.15 * reach)
        self.steps = len(self.real["frames"]) - 1
        self.good = trial["solved"] == "1"
        self.colour = GOOD if self.good else BAD

    def point(self, x, y):
        return f"{self.left + WIDTH / 2 + self.scale * x:.1f},{HEIGHT / 2 + 2 - self.scale * y:.1f}"

    def links(self, frame):
        """The bodies of a frame as one line: each begins where the one before ends."""
        ends = [frame[i:i + 4] for i in range(0, len(frame), 4)]
        return " ".join([self.point(*ends[0][:2])] + [self.point(*end[2:]) for end in ends])

    def moving(self, motion, begin, total, style):
        """A line that goes through all frames while its trial is on, and stands before and after it."""
        shapes = [self.links(frame) for frame in motion["frames"]]
        times = [0] + [(begin + i * self.dt) / total for i in range(len(shapes))] + [1]
        values = ";".join([shapes[0], *shapes, shapes[-1]])
        moments = ";".join(f"{time:.4f}".rstrip("0").rstrip(".") or "0" for time in times)
        return (f'<polyline points="{shapes[0]}" {style}><animate attributeName="points" dur="{total:.2f}s" repeatCount="indefinite" '
                f'keyTimes="{moments}" values="{values}"/></polyline>')

    def svg(self, begin, total):
        middle = self.left + WIDTH / 2
        tip = [frame[-2:] for frame in self.real["frames"]]
        yield f'<text x="{middle}" y="24" class="title">trial {self.trial["trial"]}</text>'
        if self.real["goal"]:
            x, y = self.point(*self.real["goal"]).split(",")
            yield f'<circle cx="{x}" cy="{y}" r="{0.2 * self.scale:.1f}" fill="none" stroke="{FAINT}" stroke-dasharray="3 4"/>'
        trace = " ".join(self.point(*at) for at in tip)
        yield f'<polyline points="{trace}" fill="none" stroke="{self.colour}" stroke-width="1.4" opacity="0.45"/>'
        yield f'<polyline points="{self.links(self.real["frames"][-1])}" class="still" style="stroke:{INK};stroke-width:6"/>'
        yield '<g class="move">'
        yield self.moving(self.model, begin, total, f'style="stroke:{FAINT};stroke-width:3" stroke-dasharray="5 6"')
        yield self.moving(self.real, begin, total, f'style="stroke:{INK};stroke-width:6"')
        yield "</g>"
        x, y = self.point(0, 0).split(",")
        yield f'<circle cx="{x}" cy="{y}" r="5" fill="{INK}"/>'
        word = "swung up" if self.good else "not yet"
        told = f'return {float(self.trial["return"]):.1f}, predicted {float(self.trial["predicted_return"]):.1f}: {word}'
        yield f'<text x="{middle}" y="{HEIGHT - 8}" class="note" fill="{self.colour}">{told}</text>'


def main():
    run = pathlib.Path(sys.argv[1])
    with open(run / "trials.csv", newline="") as file:
        trials = list(csv.DictReader(file))[:2]
    panels = [Panel(run, index * WIDTH, trial) for index, trial in enumerate(trials)]
    for panel in panels:
        panel.dt = float(trials[0]["interaction_s"]) / panel.steps
    lengths = [panel.dt * panel.steps for panel in panels]
    total = REST_S * len(panels) + sum(lengths) + END_S
    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH * len(panels)} {HEIGHT}" role="img" '
          f'aria-label="The robot\'s motion in its first trials">')
    print("<style>text{font:15px sans-serif;text-anchor:middle}.title{font-weight:bold}.note{font-size:14px}"
          "polyline{fill:none;stroke-linecap:round;stroke-linejoin:round}.still{display:none}"
          "@media (prefers-reduced-motion:reduce){.move{display:none}.still{display:inline}}</style>"
          f'<rect width="100%" height="100%" fill="#fff"/>')
    for index, panel in enumerate(panels):
        print("\n".join(panel.svg(REST_S * (index + 1) + sum(lengths[:index]), total)))
    print("</svg>")


if __name__ == "__main__":
    main()
