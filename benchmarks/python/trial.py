"""trial.py [THREADS]: a whole trial of GP-MI on the pendubot whose prior is NumPy: as a program in the encoding of doubles
(docs/programs.md), and as a function of this process. The same equations, seeds and searches; seconds of the second trial."""

import importlib.util
import pathlib
import re
import sys
import tempfile

import numpy as np

import rehearse

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "benchmarks/programs/pendubot.py"
NAMES = ["m1", "m2", "l1", "l2", "b1", "b2"]
OPTIONS = {"search.race.max_evaluations": 20000, "retry.searches": 0}


def equations():
    """`change` of the program, without its conversation."""
    source = PROGRAM.read_text().split("hello = ")[0]
    source = re.sub(r"encoding, steps = .*", "steps = 4", source)
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("pendubot", None))
    exec(source, module.__dict__)
    return module.change


def robot(dynamics):
    text = (ROOT / "examples/robots/pendubot.toml").read_text()
    text = text[: text.index("[prior.")] + f"""
[dynamics.numpy]
{dynamics}
parameters = {{ m1 = 0.5, m2 = 0.5, l1 = 0.5, l2 = 0.5, b1 = 0.1, b2 = 0.1 }}
[prior.guess]
dynamics = "numpy"
parameters = {{ m1 = 0.6, m2 = 0.4 }}
tune = {{ m1 = [0.05, 1.2], m2 = [0.05, 1.2] }}
"""
    return text


def seconds(learn):
    with tempfile.TemporaryDirectory() as folder:
        timings = learn(folder + "/run").table("timings")
        return timings["model_s"][1] + timings["search_s"][1]


def by_program(folder, threads):
    with tempfile.TemporaryDirectory() as files:
        path = pathlib.Path(files) / "pendubot.toml"
        path.write_text(robot(f'program = ["{sys.executable}", "pendubot.py", "doubles", "4"]'))  # not a shim, which is slow
        (pathlib.Path(files) / "pendubot.py").write_text(PROGRAM.read_text())
        return rehearse.learn(path, trials=2, out=folder, options=OPTIONS, threads=threads, progress=None)


def by_function(folder, threads):
    change = equations()

    def function(states, actions, **parameters):
        moved = change(np.ascontiguousarray(states.T), actions[:, 0], [parameters[name] for name in NAMES], 0.05)
        return moved.T

    text = robot('function = "numpy"')
    made = rehearse.Robot.__new__(rehearse.Robot)
    made.text, made.name, made.has_environment = text, "pendubot-file", False
    made._functions = [("add_dynamics", "numpy", function, NAMES)]
    made._core = made._make("pendubot.toml", "")
    return rehearse.learn(made, trials=2, out=folder, options=OPTIONS, threads=threads, progress=None)


if __name__ == "__main__":
    threads = int(sys.argv[1]) if len(sys.argv) > 1 else 1
    for repetition in range(3):
        program = seconds(lambda folder: by_program(folder, threads))
        function = seconds(lambda folder: by_function(folder, threads))
        print(f"program {program:.2f} s, function {function:.2f} s: {program / function:.2f} times as fast")
