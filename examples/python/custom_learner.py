# %% [markdown]
"""A learner of your own from the pieces: GPs of the changes, rollouts in their mean, CMA-ES over a policy."""

# %%
import numpy as np
from own_robot import pendulum, robot

import rehearse

STEPS, UNITS = 30, 8

# %% [markdown]
"""The robot that is learned on, and what a GP sees of a step."""


# %%
def truth(states, actions):
    return pendulum(states, actions, m=0.3, l=0.5, b=0.02)


def features(states, actions):
    return np.column_stack([states[:, 0], np.cos(states[:, 1]), np.sin(states[:, 1]), actions[:, 0]])


# %% [markdown]
"""The policy: a network for many θ at once, a row of theta and a row of states each. Its θ has the order of those that
learn with Rehearse: weights and bias of each unit, then of the output. So what is learned can be exported."""


# %%
def policy(theta, states):
    ones = np.ones(len(states))
    x = np.column_stack([states[:, 0] / 10, np.cos(states[:, 1]), np.sin(states[:, 1]), ones])
    hidden = np.tanh(np.einsum("nkd,nd->nk", theta[:, : 4 * UNITS].reshape(-1, UNITS, 4), x))
    output = np.einsum("nk,nk->n", theta[:, 4 * UNITS :], np.column_stack([hidden, ones]))
    return 0.7 * np.tanh(output)[:, None]


def returns(theta, change):
    """The return of each θ in lockstep, and the episode of the first."""
    states, total, episode = np.zeros((len(theta), 2)), np.zeros(len(theta)), []
    for _ in range(STEPS):
        actions = policy(theta, states)
        moved = change(states, actions)
        episode.append((states[0], actions[0], moved[0]))
        states = states + moved
        distance = (1 + np.cos(states[:, 1])) ** 2 + np.sin(states[:, 1]) ** 2
        total += np.exp(-distance / (2 * 0.5**2))
    return total, [np.array(part) for part in zip(*episode)]


# %% [markdown]
"""Learning: an episode, a model of all episodes, a search on the model."""

# %%
if __name__ == "__main__":
    theta, data = np.random.default_rng(1).normal(size=(1, 5 * UNITS + 1)), []
    for trial in range(6):
        total, episode = returns(theta, truth)
        print(f"trial {trial + 1}: return {total[0]:.2f}")
        data.append(episode)
        X, U, dX = (np.concatenate(parts) for parts in zip(*data))
        model = rehearse.GaussianProcess(starts=1).fit(features(X, U), dX)
        search = rehearse.Cmaes(theta[0], 0.5, seed=trial + 1, population=40)
        for _ in range(60):
            search.tell(returns(search.ask(), lambda x, u: model.predict(features(x, u)))[0])
        theta = search.best_x[None, :]

# %% [markdown]
"""What was learned, for the robot's own computer."""

# %%
if __name__ == "__main__":
    learned = rehearse.Policy.of(robot, theta[0], options={"policy": "mlp", "hidden": UNITS})
    states = np.array(episode[0])
    np.testing.assert_allclose(learned(states), policy(np.repeat(theta, len(states), axis=0), states), atol=1e-12)
    learned.export("policy.h")  # C99
