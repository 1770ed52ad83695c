"""A Furuta pendulum for `rehearse learn furuta.toml`: the messages are those of docs/programs.md."""
import json
import sys

import numpy as np

ARM, GRAVITY, DAMPING = 0.085, 9.81, 5e-5  # m, m/s², N m s


def rate(x, torque, mass, length, inertia):
    """dx/dt of states (darm, dpole, arm, pole), a column each; a uniform rod swings at the arm's end."""
    darm, dpole, pole = x[0], x[1], x[3]
    s, c = np.sin(pole), np.cos(pole)
    half, about = mass * length / 2, mass * length**2 / 3
    m11, m12 = inertia + mass * ARM**2 + about * s**2, half * ARM * c
    f1 = torque - DAMPING * darm - 2 * about * s * c * darm * dpole + half * ARM * s * dpole**2
    f2 = about * s * c * darm**2 + half * GRAVITY * s - DAMPING * dpole
    determinant = m11 * about - m12**2
    return np.stack([(about * f1 - m12 * f2) / determinant, (m11 * f2 - m12 * f1) / determinant, darm, dpole])


def change(states, actions, parameters, dt, steps=3):
    """Changes of states (4 × n) over a control step, by Runge and Kutta's fourth order."""
    x, u, h = states, actions[0], dt / steps
    for _ in range(steps):
        k1 = rate(x, u, *parameters)
        k2 = rate(x + h / 2 * k1, u, *parameters)
        k3 = rate(x + h / 2 * k2, u, *parameters)
        k4 = rate(x + h * k3, u, *parameters)
        x = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return x - states


hello = json.loads(sys.stdin.readline())
dx, du, dphi = len(hello["states"]), len(hello["actions"]), len(hello["parameters"])
print(json.dumps({"rehearse": 1, "states": ["darm", "dpole", "arm", "pole"], "encoding": "doubles"}), flush=True)

numbers, answers = sys.stdin.buffer, sys.stdout.buffer
while header := numbers.read(8):  # how many rows; then parameters, states and actions, variable by variable
    rows = int.from_bytes(header, "little")
    given = np.frombuffer(numbers.read(8 * (dphi + rows * (dx + du))))
    states, actions = given[dphi : dphi + rows * dx].reshape(dx, rows), given[dphi + rows * dx :].reshape(du, rows)
    answers.write(header + change(states, actions, given[:dphi], hello["dt_s"]).tobytes())
    answers.flush()
