# %% [markdown]
"""A campaign: which learner, how much of the guess, and on how many seeds? One robot, many runs.

The pendulum of own_robot.py is learned with our guess of its dynamics and without one. Its mass differs from run to run,
since a result on one robot may be luck.
"""

# %%
import rehearse
from own_robot import options, robot

# %% [markdown]
"""The arguments are the keys of a campaign's file (docs/campaigns.md). Interrupted, the same call goes on."""

# %%
campaign = rehearse.campaign(
    robot,
    learners=["gp-mi", "black-drops"],
    seeds="1-2",
    trials=2,
    until_solved=True,
    set=options,
    draw={"plant.m": [0.25, 0.35]},
    claim=[{"text": "a guess pays", "learner": "gp-mi", "metric": "return", "better_than": {"learner": "black-drops"}}],
    out="runs/guess",
)

# %% [markdown]
"""Results: a row a trial, a run, a group of seeds, and a part of a claim. Six seeds are the fewest that can prove it."""

# %%
print(campaign.groups[["learner", "prior", "done", "solved_by", "return_median"]])
print(campaign.claims[["claim", "estimate", "low", "high", "result", "reason"]])

# %% [markdown]
"""One of the runs is as `learn` gives it."""

# %%
best = campaign.runs[campaign.runs["best_return"].argmax()]
print(best["run"], campaign.run(best["run"]).best.phi)
