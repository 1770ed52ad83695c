"""A cart that is pushed to the origin, in functions, formulas, and as an environment."""

import numpy as np

import rehearse

def rates(states, actions, mass, friction):
    return np.column_stack([(actions[:, 0] - friction * states[:, 0]) / mass, states[:, 0]])


change = rehearse.rk4(rates, 0.1, substeps=2)


def reward(states, actions, next_states):
    return np.exp(-next_states[:, 1] ** 2 / (2 * 0.3**2))


def cart(plant="model", **changes):
    """The cart; plant: "model", or what Robot takes. changes: other arguments of Robot."""
    if isinstance(plant, str):
        plant = rehearse.Model(change, parameters={"mass": 1.6, "friction": 0.3})
    light = rehearse.Model(change, parameters={"mass": 1.0, "friction": 0.3}, tune={"mass": (0.2, 5)})
    arguments = dict(
        dt_s=0.1, horizon=15,
        states=[rehearse.State("velocity", "m/s"),
                rehearse.State("position", "m", rate="velocity", start=1.0)],
        actions=[rehearse.Action("force", (-5, 5), "N")],
        reward=reward,
        success=rehearse.Success(lambda states: np.abs(states[:, 1]) < 0.2, 0.3),
        plant=plant,
        priors={"light": light},
        policy={"policy": "linear"},
    )
    arguments.update(changes)
    return rehearse.Robot("cart", **arguments)


#: A search that takes a tenth of a second.
QUICK = {"search.race.max_evaluations": 600, "search.selection": 10, "search.finalists": 2, "retry.searches": 0}


class Environment:
    """The cart as Gymnasium would have it."""

    def __init__(self, limit=100):
        self.limit, self.actions, self.seeds = limit, [], []

    def reset(self, *, seed=None, options=None):
        self.state, self.steps = np.array([[0.0, 1.0]]), 0
        self.seeds.append(seed)
        return self.state[0].copy(), {}

    def step(self, action):
        self.actions.append(action)
        self.state = self.state + change(self.state, np.atleast_2d(action), mass=1.6, friction=0.3)
        self.steps += 1
        return self.state[0].copy(), 0.0, bool(abs(self.state[0, 1]) > 3), self.steps >= self.limit, {}
