"""How a run goes, in terminals and notebooks."""

from __future__ import annotations

import math
import sys
import time
from typing import Any

_QUIET_S = 30.0  # between lines on what is being done, where the last line cannot be written anew
_said_s = time.monotonic()


def show(event: dict[str, Any]) -> None:
    """Prints a line a trial; a last line says what is being done, which elsewhere than on a terminal or in a notebook is a line
    every half a minute.

    Give another function(event) as `progress=`, or None. An event is a dictionary whose `kind` is
    "started" (robot, learner, prior, seed, trials, done, folder),
    "progress" (trial, phase, done from 0 to 1, best predicted return, rollouts, rollouts_per_s), at most ten a second, or
    "trial" (what `Trial` has). A campaign has
    "campaign" at its start (title, robot, trials, runs, ended: how many of these before, notes),
    "progress" with `run`, the name of its run, at most ten a second of all runs, and
    "run" at the end of each (run, learner, prior, variant, seed, failed: why or None, trials, first_success,
    best_return, ended, runs).
    """
    global _said_s
    kind = event["kind"]
    live = sys.stdout.isatty() or "ipykernel" in sys.modules
    if kind == "progress" and not live and time.monotonic() < _said_s + _QUIET_S:
        return
    _said_s = time.monotonic()
    if kind == "progress":
        known = event["rollouts"] and math.isfinite(event["best"])
        best = f", best predicted return {event['best']:.3f}" if known else ""
        run = f"{event['run']}: " if "run" in event else ""
        text = f"{run}trial {event['trial']}: {event['phase']} {100 * event['done']:.0f} %{best}"
        print(f"\r{text[:100]:100}" if live else text, end="" if live else "\n", flush=True)
    elif kind == "trial":
        predicted = event["predicted_return"]
        text = f"trial {event['trial']}: return {event['total_reward']:.3f}"
        text += "" if predicted is None else f", predicted {predicted:.3f}"
        text += {True: ", solved", False: ", not solved", None: ""}[event["solved"]]
        text += "".join(f", broke {limit['name']}" for limit in event["limits"] if limit["broken"])
        text += "".join(f", {name} {number:.4g}" for name, number in event["phi"].items())
        print(f"\r{text:100}" if live else text, flush=True)
        for note in event["notes"]:
            print(f"  {note}", flush=True)
    elif kind == "started":
        prior = f" from prior {event['prior']}" if event["prior"] else ""
        print(f"{event['robot']} learned by {event['learner']}{prior}, seed {event['seed']}, in {event['folder']}",
              flush=True)
    elif kind == "campaign":
        print(f"{event['title']}: {event['runs']} runs, {event['ended']} done already", flush=True)
        for note in event["notes"]:
            print(f"  {note}", flush=True)
    elif kind == "run":
        solved = "not solved" if event["first_success"] is None else f"solved at trial {event['first_success']}"
        text = f"[{event['ended']}/{event['runs']}] {event['run']}: "
        text += f"FAILED: {event['failed']}" if event["failed"] else f"{solved}, best return {event['best_return']:.3f}"
        print(f"\r{text:100}" if live else text, flush=True)
