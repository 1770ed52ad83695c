"""The pendulum of docs/same-robot.md for `rehearse learn program.toml`: the messages are those of docs/programs.md."""
import json
import math
import sys


def rate(dtheta, theta, u, m, l):
    """The derivatives of the states: a uniform rod, its angle 0 when it hangs."""
    return (u - 0.01 * dtheta - m * 9.82 * l / 2 * math.sin(theta)) / (m * l**2 / 3), dtheta


def change(state, action, parameters, dt, steps=4):
    """The change of a state over a control step, by Runge and Kutta's fourth order."""
    x, h = list(state), dt / steps
    for _ in range(steps):
        k1 = rate(*x, *action, *parameters)
        k2 = rate(*(a + h / 2 * b for a, b in zip(x, k1)), *action, *parameters)
        k3 = rate(*(a + h / 2 * b for a, b in zip(x, k2)), *action, *parameters)
        k4 = rate(*(a + h * b for a, b in zip(x, k3)), *action, *parameters)
        x = [a + h / 6 * (b1 + 2 * b2 + 2 * b3 + b4) for a, b1, b2, b3, b4 in zip(x, k1, k2, k3, k4)]
    return [b - a for a, b in zip(state, x)]


dt = json.loads(sys.stdin.readline())["dt_s"]
print(json.dumps({"rehearse": 1, "states": ["dtheta", "theta"]}), flush=True)
for line in sys.stdin:
    asked = json.loads(line)["change"]
    rows = zip(asked["states"], asked["actions"])
    print(json.dumps({"change": [change(x, u, asked["parameters"], dt) for x, u in rows]}), flush=True)
