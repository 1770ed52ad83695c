# %% [markdown]
"""A robot of your own in Python: a pendulum whose motor is too weak to lift it at once.

Its mass is 0.3 kg. We guess 0.2 kg, and let a learner find the mass and a policy that swings it up.
"""

# %%
import numpy as np

import rehearse

# %% [markdown]
"""The equation: how fast the states change, and the change over a control step."""


# %%
def rates(states, actions, m, l, b):
    """Derivatives of (rate, angle) by time, a row a state; the angle is 0 when it hangs."""
    rate, angle, torque = states[:, 0], states[:, 1], actions[:, 0]
    return np.column_stack([(torque - b * rate - m * 9.81 * l * np.sin(angle)) / (m * l**2), rate])


pendulum = rehearse.rk4(rates, dt_s=0.1, substeps=4)

# %% [markdown]
"""The robot: what it measures, what moves it, its task, what plays it, and what we guess of it."""

# %%
robot = rehearse.Robot(
    "weak-pendulum",
    dt_s=0.1,
    horizon=30,
    states=[
        rehearse.State("rate", "rad/s", scale=10),
        rehearse.State("angle", "rad", angle=True, rate="rate"),
    ],
    actions=[rehearse.Action("torque", (-0.7, 0.7), "N m")],
    reward=rehearse.Distance(["1 + cos(angle)", "sin(angle)"], width=0.5),
    success=rehearse.Success(lambda states: -np.cos(states[:, 1]) > 0.95, last_s=0.5),
    plant=rehearse.Model(pendulum, parameters={"m": 0.3, "l": 0.5, "b": 0.02}),
    priors={"light": rehearse.Model(pendulum, parameters={"m": 0.2, "l": 0.5, "b": 0.02}, tune={"m": (0.05, 1)})},
)

# Simulated episodes a search: for a pendulum a fifth of the default is enough.
options = {"search.race.max_evaluations": 20000}

# %% [markdown]
"""Learning, in a new folder below runs. In a notebook `run` alone is a table, and `run.plot()` a figure."""

# %%
if __name__ == "__main__":
    run = rehearse.learn(robot, learner="gp-mi", trials=4, until_solved=True, options=options)
    print(run.trials)
    print("solved at trial", run.solved_at)
    run.policy().export(run.folder / "policy.h")  # C99, for the robot's own computer
