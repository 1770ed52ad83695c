# %% [markdown]
"""A robot with a control loop of its own: ask for a policy, run it, tell what happened.

Days may lie between two steps, and each may be another process: everything is in the run's folder.
"""

# %%
import numpy as np
from own_robot import options, pendulum, robot

import rehearse

# %% [markdown]
"""The robot's side: a loop that measures, asks the policy, and sends what it answers."""


# %%
def run_on_the_robot(policy):
    """Stands for your control loop: here, the pendulum with a little noise of measurement."""
    noise = np.random.default_rng(policy.trial)
    state, rows = np.zeros((1, 2)), []
    for step in range(policy.steps + 1):
        measured = state[0] + 0.001 * noise.normal(size=2)
        action = policy(measured, step * policy.dt_s)
        rows.append((step * policy.dt_s, *measured, *action))
        state = state + pendulum(state, action[None, :], m=0.3, l=0.5, b=0.02)
    time, rate, angle, torque = np.array(rows).T
    return {"time": time, "rate": rate, "angle": angle, "torque": torque[:-1]}


# %% [markdown]
"""Three trials at most; `ask` and `tell` may be in different processes."""

# %%
if __name__ == "__main__":
    run = rehearse.learn(robot, trials=0, options=options, out="runs/hardware", progress=None)  # makes the folder alone
    for _ in range(3):
        policy = run.ask()
        told = run.tell(run_on_the_robot(policy))
        print(f"trial {told['trial']}: return {told['total_reward']:.2f}")
        if run.solved_at:
            break
    print("solved at trial", run.solved_at)
