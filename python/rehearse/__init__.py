"""Rehearse teaches a robot a policy in a handful of trials.

>>> import rehearse
>>> run = rehearse.learn("pendubot", learner="gp-mi", prior="misleading", trials=5)

Begin with `Robot` and `learn`. `Run` is what they give, and what `open_run` finds in a folder; `campaign` does many.
The pieces alone are `GaussianProcess`, `Cmaes`, `MapElites` and `identify`.
"""

from ._core import InvalidInput, RunFailed, __version__
from .campaigns import Campaign, campaign, open_campaign
from .check import Checked, check
from .evaluation import Evaluation
from .gp import GaussianProcess
from .identification import Identification, identify
from .integrate import rk4
from .options import Option, learners, options, presets, robots
from .parts import Action, Body, Distance, Limit, Model, State, Success
from .policy import Policy
from .progress import show
from .robot import Robot
from .run import Run, learn, open_run, resume
from .search import Cmaes, MapElites
from .trial import Trial

__all__ = [
    "Action", "Body", "Campaign", "Checked", "Cmaes", "Distance", "Evaluation", "GaussianProcess", "Identification",
    "InvalidInput", "Limit", "MapElites", "Model", "Option", "Policy", "Robot", "Run", "RunFailed", "State", "Success",
    "Trial", "campaign", "check", "identify", "learn", "learners", "open_campaign", "open_run", "options", "presets",
    "resume", "rk4", "robots", "show", "__version__",
]
