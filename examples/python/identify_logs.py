# %% [markdown]
"""A robot from logs alone: parameters with intervals, and how far predictions hold."""

# %%
import numpy as np
from own_robot import pendulum, robot

import rehearse

# %% [markdown]
"""The logs."""


# %%
def log(seed, steps=100):
    """A log of whatever moved the robot; yours is a CSV file, a DataFrame, or a dictionary like this one."""
    random = np.random.default_rng(seed)
    state, torque, rows = np.array([[0.0, 1.0]]), 0.0, []
    for step in range(steps):
        if step % 4 == 0:
            torque = random.uniform(-0.5, 0.5)
        rows.append((0.1 * step, *(state[0] + 0.002 * random.normal(size=2)), torque))
        state = state + pendulum(state, np.array([[torque]]), m=0.3, l=0.5, b=0.02)
    return dict(zip(("time", "rate", "angle", "torque"), np.array(rows).T))


# %% [markdown]
"""What two of them tell, and how well that forecasts the third. In a notebook `found.plot()` is a figure."""

# %%
if __name__ == "__main__":
    found = rehearse.identify(robot, [log(1), log(2)], held_out=[log(3)])
    print(found)
    print(found.parameters)
    found.report("identify.html")
