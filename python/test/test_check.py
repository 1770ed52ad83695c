"""What `check` finds before anything is learned, and what it leaves alone."""

import pathlib
import shutil
import signal

import numpy as np
import pytest
from robots import Environment, cart, change

import rehearse


def test_check_finds_what_a_learner_would_stumble_over(tmp_path):
    found = rehearse.check(cart())
    assert found.complaints == [] and str(found).endswith("all is well")
    assert found.steps == 45 and list(found.changes) == ["velocity", "position"]
    (light,) = found.priors
    assert light.name == "light" and 0 < light.errors["velocity"] < found.changes["velocity"] and light.notes == []

    def following(states, actions, mass, friction):
        return states + change(states, actions, mass=mass, friction=friction)

    wrong = rehearse.Model(following, parameters={"mass": 1.0, "friction": 0.3}, tune={"mass": (0.2, 5)})
    noted = str(rehearse.check(cart(priors={"light": wrong})))
    assert "it must give changes" in noted and noted.endswith("see what is noted above")
    idle = rehearse.Model(lambda states, actions, mass: 0.1 * states, parameters={"mass": 1.0}, tune={"mass": (0.2, 5)})
    (complaint,) = rehearse.check(cart(Environment, priors={"idle": idle})).complaints
    assert "mass changes no prediction" in complaint
    with pytest.raises(ZeroDivisionError):
        rehearse.check(cart(reward=lambda *of: 1 / 0))
    bodies = [rehearse.Body("cart", ("position", "0"), ("position", "0.1"))]
    rehearse.check(cart(bodies=bodies), out=tmp_path / "cart.html")
    assert "cart: an episode of random actions" in (tmp_path / "cart.html").read_text(encoding="utf-8")
    for page, why in ((tmp_path / "cart.txt", "must end in .html"), (tmp_path / "none" / "cart.html", "none")):
        with pytest.raises(rehearse.InvalidInput, match=why):
            rehearse.check(cart(), out=page)
    with pytest.raises(rehearse.InvalidInput, match="unknown scenario 'pendubott', did you mean 'pendubot'"):
        rehearse.check("pendubott")


class Hot:
    """A robot whose motor gets hot in its fourth step."""

    def __init__(self):
        self.calls = []

    def reset(self, *, seed=None, options=None):
        self.calls.append("reset")
        return np.array([0.0, 1.0]), {}

    def step(self, action):
        self.calls.append("step")
        if self.calls.count("step") == 4:
            raise OSError("the motor is hot")
        return np.array([0.0, 1.0]), 0.0, False, False, {}

    def end(self):
        self.calls.append("end")


def test_a_robot_that_fails_is_not_moved_again_by_check():
    hot = Hot()
    with pytest.raises(OSError, match="the motor is hot"):
        rehearse.check(cart(hot))
    assert hot.calls == ["reset", "step", "step", "step", "step", "end"]


class Stopped(Hot):
    """Ctrl-C comes in its second step."""

    def step(self, action):
        self.calls.append("step")
        if self.calls.count("step") == 2:
            signal.raise_signal(signal.SIGINT)
        return np.array([0.0, 1.0]), 0.0, False, False, {}


def test_ctrl_c_stops_a_robot_that_is_checked():
    robot = Stopped()
    with pytest.raises(KeyboardInterrupt):
        rehearse.check(cart(robot))
    assert robot.calls == ["reset", "step", "step", "end"]


def test_check_counts_episodes_that_end_early():
    class Ends(Environment):
        def step(self, action):
            observation, *rest = super().step(action)
            return observation, 0.0, self.steps == 2, False, {}

    found = rehearse.check(cart(Ends, limits=[rehearse.Limit("position < 1.5", name="near")]))
    assert (found.steps, found.episodes, found.ended, found.broke) == (6, 3, 3, {"near": 0})
    assert str(found).startswith("6 steps under random actions, 3 of 3 episodes ended early")


class Lost(Hot):
    """Its fourth state is not known, which is no exception."""

    def step(self, action):
        self.calls.append("step")
        return np.array([0.0, np.nan if self.calls.count("step") == 4 else 1.0]), 0.0, False, False, {}


def test_findings_are_kept_where_the_plant_fails(tmp_path):
    lost = Lost()
    found = rehearse.check(cart(lost), out=tmp_path / "cart.html")
    assert any("the plant failed in step 4 of episode 1" in line for line in found.complaints)
    assert lost.calls == ["reset", "step", "step", "step", "step", "end"], "it is not moved again for the page"
    assert not (tmp_path / "cart.html").exists()


def test_a_page_needs_a_plant(tmp_path):
    calls = []

    def counted(states, actions, following):
        calls.append(len(states))
        return following[:, 1]

    with pytest.raises(rehearse.InvalidInput, match="^out: there is no plant whose motion it could show"):
        rehearse.check(cart(plant=None, reward=counted), out=tmp_path / "cart.html")
    assert calls == []


def test_nothing_may_be_there_to_try():
    found = rehearse.check(cart(plant=None, priors=None))
    assert (found.steps, found.changes, found.priors, found.complaints) == (0, {}, [], [])
    assert str(found).endswith("\nnothing was tried: there is no prior, and no plant that may move")


@pytest.mark.parametrize("plant, asked", [(None, {}), ("model", {"plant": False})])
def test_a_prior_that_plays_the_robot_has_no_errors(plant, asked):
    guess = dict(parameters={"mass": 2.0, "friction": 0.3}, tune={"mass": (0.2, 5)})
    light = rehearse.Model(change, parameters={"mass": 1.0, "friction": 0.3}, tune={"mass": (0.2, 5)})
    found = rehearse.check(cart(plant, priors={"light": light, "heavy": rehearse.Model(change, **guess)}), **asked)
    assert found.played and found.steps == 45 and not rehearse.check(cart()).played
    assert found.priors[0].errors == {} and found.priors[1].errors["velocity"] > 0
    lines = str(found).splitlines()
    assert lines[0] == "45 steps under random actions (the first prior plays the robot)"
    states = [", the prior errs by " in line for line in lines if ": a step changes it by " in line]
    assert states == [False, False, True, True]


def test_faults_of_a_program_are_noted(tmp_path):
    folder = pathlib.Path(__file__).parents[2] / "examples/same_robot"
    text, known = (folder / "rod.py").read_text(encoding="utf-8"), '    asked = json.loads(line)["change"]\n'
    once = (f'    if len(asked["states"]) > 1 and not pathlib.Path({str(tmp_path / "failed")!r}).exists():\n'
            f'        pathlib.Path({str(tmp_path / "failed")!r}).touch()\n        sys.exit("no memory")\n')
    assert known in text
    (tmp_path / "rod.py").write_text("import pathlib\n" + text.replace(known, known + once), encoding="utf-8")
    shutil.copy(folder / "program.toml", tmp_path)
    found = rehearse.check(tmp_path / "program.toml", plant=False)
    assert any("its program failed at 1 messages" in note for note in found.notes)
    assert found.complaints == [] and str(found).endswith("see what is noted above")
