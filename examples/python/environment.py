# %% [markdown]
"""An environment as Gymnasium has them is the robot: reset() and step(), whoever wrote it.

The learner does not use the environment's reward: it needs one for states that nobody has been in. The prior is
formulas here; it knows nothing of the friction.
"""

# %%
import numpy as np

import rehearse

# %% [markdown]
"""The environment, which may be anybody's: `gymnasium.make` is a function that makes one, too."""


# %%
class Pendulum:
    """A pendulum with friction; observations are cosine and sine of its angle, and its rate."""

    def reset(self, *, seed=None, options=None):
        self.rate, self.angle = 0.0, 0.0
        return self.observation(), {}

    def step(self, action):
        for _ in range(50):
            torque = float(action[0]) - 0.05 * self.rate
            self.rate += 0.001 * (torque - 0.3 * 9.81 * 0.5 * np.sin(self.angle)) / (0.3 * 0.5**2)
            self.angle += 0.001 * self.rate
        return self.observation(), -np.cos(self.angle), False, False, {}

    def observation(self):
        return np.array([np.cos(self.angle), np.sin(self.angle), self.rate])


# %% [markdown]
"""The robot. `observe` makes states of observations; turns of the angle are counted on."""

# %%
robot = rehearse.Robot(
    "pendulum-environment",
    dt_s=0.05,
    horizon=60,
    states=[
        rehearse.State("rate", "rad/s", scale=10),
        rehearse.State("angle", "rad", angle=True, rate="rate"),
    ],
    actions=[rehearse.Action("torque", (-0.7, 0.7), "N m")],
    reward=rehearse.Distance(["1 + cos(angle)", "sin(angle)"], width=0.5),
    success=rehearse.Success("cos(angle) < -0.95", last_s=0.5),
    plant=Pendulum,
    observe=lambda observation: [observation[2], np.arctan2(observation[1], observation[0])],
    priors={
        "frictionless": rehearse.Model(
            rates={"rate": "(torque - m * 9.81 * 0.5 * sin(angle)) / (m * 0.5^2)"},
            parameters={"m": 0.2},
            tune={"m": (0.05, 1)},
        )
    },
)

# %% [markdown]
"""Learning."""

# %%
if __name__ == "__main__":
    run = rehearse.learn(robot, trials=5, until_solved=True)
    print("solved at trial", run.solved_at)
