"""The pendubot by NumPy, in the encoding of its argument, with so many steps of Runge and Kutta's fourth order."""
import json
import sys

import numpy as np

encoding, steps = sys.argv[1], int(sys.argv[2])


def rate(x, u, m1, m2, l1, l2, b1, b2):
    turn = x[2] - x[3]
    s, c = np.sin(turn), np.cos(turn)
    coupling = m2 * l1 * l2 / 2
    a11, a12, a22 = l1 * l1 * (m1 / 3 + m2), coupling * c, m2 * l2 * l2 / 3
    swing = coupling * s
    f1 = 9.82 * l1 * (m1 / 2 + m2) * np.sin(x[2]) + u - swing * x[1] ** 2 - b1 * x[0]
    f2 = 9.82 * l2 * m2 / 2 * np.sin(x[3]) + swing * x[0] ** 2 - b2 * x[1]
    determinant = a11 * a22 - a12 * a12
    out = np.empty_like(x)
    out[0], out[1], out[2], out[3] = (a22 * f1 - a12 * f2) / determinant, (a11 * f2 - a12 * f1) / determinant, x[0], x[1]
    return out


def change(states, u, parameters, dt):
    x, h = states, dt / steps
    for _ in range(steps):
        k1 = rate(x, u, *parameters)
        k2 = rate(x + h / 2 * k1, u, *parameters)
        k3 = rate(x + h / 2 * k2, u, *parameters)
        k4 = rate(x + h * k3, u, *parameters)
        x = x + h / 6 * (k1 + 2 * (k2 + k3) + k4)
    return x - states


hello = json.loads(sys.stdin.readline())
dt = hello["dt_s"]
print(json.dumps({"rehearse": 1, "encoding": encoding}), flush=True)
if encoding == "json":
    for line in sys.stdin:
        asked = json.loads(line)["change"]
        states, actions = np.array(asked["states"]).T, np.array(asked["actions"]).T
        changes = change(states, actions[0], asked["parameters"], dt)
        print(json.dumps({"change": changes.T.tolist()}), flush=True)
else:
    numbers, answers = sys.stdin.buffer, sys.stdout.buffer
    while header := numbers.read(8):
        n = int.from_bytes(header, "little")
        given = np.frombuffer(numbers.read(8 * (6 + 5 * n)))
        answers.write(header + change(given[6 : 6 + 4 * n].reshape(4, n), given[6 + 4 * n :], given[:6], dt).tobytes())
        answers.flush()
