"""A learner of your own from the pieces: GPs of the changes, rollouts in their mean, CMA-ES over a policy."""

import numpy as np
from own_robot import pendulum

import rehearse

STEPS = 30


def truth(states, actions):
    return pendulum(states, actions, m=0.3, l=0.5, b=0.02)


def features(states, actions):
    return np.column_stack([states[:, 0], np.cos(states[:, 1]), np.sin(states[:, 1]), actions[:, 0]])


def policy(theta, states):
    """A network of 8 units, for many θ at once: a row of theta and a row of states each."""
    x = np.column_stack([states[:, 0] / 10, np.cos(states[:, 1]), np.sin(states[:, 1]), np.ones(len(states))])
    hidden = np.tanh(np.einsum("nkd,nd->nk", theta[:, :32].reshape(-1, 8, 4), x))
    return 0.7 * np.tanh(np.einsum("nk,nk->n", theta[:, 32:], hidden))[:, None]


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


if __name__ == "__main__":
    theta, data = np.random.default_rng(1).normal(size=(1, 40)), []
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
