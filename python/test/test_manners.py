"""Manners that Python expects of objects: copies, representations, errors by name, any locale."""

import copy
import functools
import os
import pathlib
import pickle
import subprocess
import sys

import numpy as np
import pytest
from robots import QUICK, Environment, cart, change

import rehearse


def learn(robot, out, **more):
    return rehearse.learn(robot, out=out, **{"trials": 1, "threads": 1, "progress": None, "options": QUICK, **more})


def near(states):
    return np.abs(states[:, 1]) < 0.2


def slow(states, actions, following):
    return np.abs(following[:, 0]) < 100


def named(plant="model", **changes):
    """The cart without lambdas."""
    return cart(plant, success=rehearse.Success(near, 0.3), limits=[rehearse.Limit(slow)], **changes)


# Copies.


@pytest.mark.parametrize("plant", ["model", Environment, Environment(), functools.partial(Environment, 50)])
def test_robots_and_their_runs_can_be_pickled_and_copied(tmp_path, plant):
    robot = named(plant)
    first = learn(robot, tmp_path / "first")
    for number, again in enumerate((pickle.loads(pickle.dumps(robot)), copy.copy(robot), copy.deepcopy(robot))):
        run = learn(again, tmp_path / str(number))
        assert (run.folder / "trials.csv").read_bytes() == (first.folder / "trials.csv").read_bytes()
    run = pickle.loads(pickle.dumps(first)).resume(2, progress=None)
    assert len(run.trials) == 2 and run.evaluate(2).returns.shape == (2,)


def test_what_a_robot_cannot_take_along_is_named(tmp_path):
    with pytest.raises((AttributeError, pickle.PicklingError), match="lambda"):
        pickle.dumps(cart())
    file = tmp_path / "cart.toml"
    file.write_text(FILE, encoding="utf-8")
    assert pickle.loads(pickle.dumps(rehearse.Robot.from_file(file))).text == FILE


FILE = """format = 1
name = "cart"
dt_s = 0.1
horizon = 15
[[state]]
name = "position"
unit = "°"
[[action]]
name = "force"
bounds = [-5, 5]
[reward]
formula = "position"
[dynamics.line]
rate.position = "force"
[plant]
"""


def test_a_file_is_found_wherever_the_program_goes(tmp_path, monkeypatch):
    monkeypatch.chdir(pathlib.Path(__file__).parents[2] / "examples/same_robot")
    robot = rehearse.Robot.from_file("program.toml")
    monkeypatch.chdir(tmp_path)
    assert (learn(robot, "run", trials=0, options={}).folder / "robot" / "rod.py").exists()


# Representations.


def test_results_are_short_in_a_terminal(tmp_path):
    run = learn(cart(), tmp_path / "run")
    found = rehearse.identify(cart(), run.trajectory(1), options={"beyond": "nothing"}, threads=1)
    assert repr(found).startswith("<rehearse.Identification: mass 1.6 (1.6 to ") and len(repr(found)) < 80
    assert repr(rehearse.Cmaes([0.0], 1.0)) == "<rehearse.Cmaes after 0 evaluations>"
    assert "after 0 evaluations" in repr(rehearse.MapElites([(0, 1)], [(0, 1)], bins=[3]))
    assert rehearse.Evaluation(np.empty(0), [], [], [], []).table["broke"].dtype.kind == "U"
    evaluated = run.evaluate(2, threads=1)
    assert evaluated == evaluated and evaluated != run.evaluate(2, threads=1) and len({evaluated, found}) == 2


# Files are UTF-8 in any locale.


def test_the_locale_changes_nothing(tmp_path):
    script = f"""
import sys; sys.path.insert(0, {str(pathlib.Path(__file__).parent)!r})
import locale, pathlib, rehearse
from robots import QUICK
assert locale.getpreferredencoding(False).upper() not in ("UTF-8", "UTF8")
pathlib.Path("cart.toml").write_bytes({FILE.encode()!r})
options = {{**QUICK, "policy": "linear"}}
run = rehearse.learn("cart.toml", "black-drops-prior", prior="oracle", trials=1, options=options, out="run", progress=None)
policy = run.policy()
files = [policy.export("policy" + ending) for ending in (".h", ".json", ".py")]
assert b"\\xc2\\xb0" in files[1].read_bytes()
rehearse.Policy.load("policy.json")
rehearse.learn("cart.toml", "black-drops-prior", prior="oracle", trials=0, options=options, policy="policy.json", out="next",
               progress=None)
moved = run.trajectory(1)
assert moved.dtype.names[:2] == ("time", "position") and (run.folder / "robot.toml").exists()
run.report()
"""
    environment = {**os.environ, "LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    done = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, env=environment, capture_output=True, text=True,
                          encoding="utf-8")
    assert done.returncode == 0, done.stderr


def test_a_file_that_is_no_text_is_refused(tmp_path):
    file = tmp_path / "latin.toml"
    file.write_bytes(FILE.encode("latin-1"))
    for read in (rehearse.Robot.from_file, rehearse.Policy.load, lambda path: learn(cart(), tmp_path / "none", policy=path)):
        with pytest.raises(rehearse.InvalidInput, match="latin.toml is no text: it has bytes that are not UTF-8"):
            read(file)


# Errors by name.


@pytest.mark.parametrize("changes, message", [
    ({"dt_s": None}, "^dt_s = None, must be a number$"),
    ({"floor": "0"}, "^floor = '0', must be a number$"),
    ({"reward": rehearse.Distance("position", width=None)}, "^width = None, must be a number$"),
    ({"measurement_noise": [0.1]}, r"^measurement_noise = \[0.1\], must be a number$"),
    ({"policy": [1]}, "^policy is a list, must be a dictionary$"),
    ({"actions": [rehearse.Action("force", 5)]}, r"^bounds of force = 5, must be \(low, high\)$"),
    ({"actions": [rehearse.Action("force", ("a", 1))]}, "^bounds of force = 'a', must be a number$"),
    ({"priors": {"light": rehearse.Model(change, parameters=["mass"])}}, "^light: parameters is a list, must be a dictionary$"),
    ({"priors": {"light": rehearse.Model(change, parameters={"mass": None})}}, "^light: mass = None, must be a number$"),
    ({"priors": {"light": rehearse.Model(change, parameters={"mass": 1}, tune={"mass": 2})}},
     r"^light: tune of mass = 2, must be \(low, high\)$"),
    ({"priors": {"light": rehearse.Model(change, parameters={"mass": 1}, tune=["mass"])}},
     "^light: tune is a list, must be a dictionary$"),
])
def test_a_wrong_part_of_a_robot_is_named(changes, message):
    with pytest.raises(TypeError, match=message):
        cart(**changes)


def test_a_wrong_value_of_a_file_is_said_with_its_key():
    with pytest.raises(TypeError, match="cost is a function, must be a formula"):
        cart(cost=lambda states: states)
    with pytest.raises(rehearse.InvalidInput, match=r"^\[reward\] cost: <object object .* must be a text, a number"):
        cart(cost=object())
    with pytest.raises(rehearse.InvalidInput, match=r"^\[\[action\]\] bounds: -inf must be a finite number"):
        cart(actions=[rehearse.Action("force", (-np.inf, 5))])


def test_numbers_of_numpy_are_numbers(tmp_path):
    robot = cart(horizon=np.int32(15), dt_s=np.float32(0.125), policy={"policy": "linear", "policy_gain": np.array(1.0)},
                 states=[rehearse.State("velocity", input=np.True_),
                         rehearse.State("position", rate="velocity", start=np.array(1.0))],
                 plant=rehearse.Model(rates={"velocity": "force"}),
                 priors={1: rehearse.Model(rates={"velocity": "force * k"}, parameters={"k": 2},
                                           tune={"k": np.array([1.0, 3.0])})})
    assert len(learn(robot, tmp_path / "run").trials) == 1


def test_a_wrong_argument_is_named(tmp_path):
    policy, search = rehearse.Policy.of("pendulum"), rehearse.Cmaes([0.0], 0.3)
    run = learn(cart(), tmp_path / "run")
    search.ask()
    for call, message in (
            (lambda: learn(cart(), tmp_path / "none", options=[1]), "options is a list, must be a dictionary"),
            (lambda: learn(cart(), tmp_path / "none", options={1: 2}), "a name in options = 1, must be a text"),
            (lambda: learn(cart(), tmp_path / "none", learner=None), "learner = None, must be a text"),
            (lambda: learn(cart(), tmp_path / "none", until_solved="no"), "until_solved = 'no', must be True or False"),
            (lambda: learn(3, tmp_path / "none"), "robot = 3, must be a Robot, the name of a built-in one, or a path"),
            (lambda: learn(cart(), tmp_path / "none", progress=3), "progress = 3, must be a function or None"),
            (lambda: learn(cart(), tmp_path / "none", prior=3), "prior = 3, must be a name, several, or None"),
            (lambda: learn(cart(), tmp_path / "none", prior=["light", 3]), r"prior = \['light', 3\], must be a name, .*"),
            (lambda: learn(cart(), 3), "out = 3, must be a path or None"),
            (lambda: learn(cart(), tmp_path / "none", policy=0), "policy = 0, must be a Policy, its JSON file, or None"),
            (lambda: cart(reward=rehearse.Distance(3)), "of of Distance = 3, must be a formula, or several"),
            (lambda: rehearse.open_run(3), "folder = 3, must be a path"),
            (lambda: rehearse.open_campaign(None), "folder = None, must be a path"),
            (lambda: rehearse.campaign("pendulum", learners="gp-mi", seeds=1, out=3), "out = 3, must be a path or None"),
            (lambda: rehearse.identify(cart(), [], prior=3), "prior = 3, must be a text"),
            (lambda: rehearse.Policy.load(3), "path = 3, must be a path"),
            (lambda: policy.export(3), "path = 3, must be a path"),
            (lambda: run.report(3), "out = 3, must be a path or None"),
            (lambda: run.evaluate(2, policy=3), "policy = 3, must be a Policy, its JSON file, or None"),
            (lambda: run.evaluate(2, seconds=None), "seconds = None, must be a number"),
            (lambda: run.tell({}, at_fault=0), "at_fault = 0, must be True or False"),
            (lambda: policy([0, 0], None), "time_s = None, must be a number"),
            (lambda: rehearse.Cmaes([0.0], "a"), "sigma = 'a', must be a number"),
            (lambda: rehearse.rk4(change, 0.1, substeps=2.5), "substeps = 2.5, must be a whole number")):
        with pytest.raises(TypeError, match=f"^{message}$"):
            call()
    for call, message in ((lambda: policy.with_theta(None), r"theta is an array of shape \(\), must be n numbers"),
                          (lambda: search.tell(None), r"values is an array of shape \(\), must be n numbers"),
                          (lambda: rehearse.Cmaes(np.zeros((2, 2)), 1), r"mean is an array of shape \(2, 2\), must be n numbers"),
                          (lambda: rehearse.rk4(change, 0.1, substeps=0), "substeps = 0, must be ≥ 1"),
                          (lambda: rehearse.GaussianProcess().fit(np.array(["2026-01-01"], "M8"), [1]), "X has times of the calendar")):
        with pytest.raises(rehearse.InvalidInput, match=f"^{message}"):
            call()
    assert not (tmp_path / "none").exists()


# Figures and frames.


def test_a_trial_that_was_cut_short_is_not_the_figure_of_the_best(tmp_path):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    run = learn(cart(reward="-position^2", floor=-1, plant=None), tmp_path / "run", trials=0)
    moved = learn(cart(reward="-position^2", floor=-1), tmp_path / "moved").trajectory(1)
    for rows, more in ((moved[:3], {"stopped": "the battery was empty", "at_fault": False}), (moved, {})):
        run.ask(threads=1)
        run.tell(rows, threads=1, **more)
    assert run.trials["return"].argmax() == 0 and run.best.trial == 2
    figure = run.plot()
    assert "trial 2" in [text.get_text() for text in figure.axes[1].get_legend().get_texts()]
    assert pyplot.get_fignums() == [], "pyplot keeps none"
    assert figure._repr_png_().startswith(b"\x89PNG"), "notebooks show it"


def test_frames_have_their_times_in_the_index_and_lack_numbers(tmp_path):
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(learn(cart(), tmp_path / "run").trajectory(1))
    known = rehearse.identify(cart(), frame, options={"beyond": "nothing"}, threads=1).parameters[["value", "low", "high"]]
    for same in (frame.set_index("time"), frame.convert_dtypes(), frame.sample(frac=1, axis=1, random_state=1)):
        found = rehearse.identify(cart(), same, options={"beyond": "nothing"}, threads=1)
        np.testing.assert_array_equal(found.parameters[["value", "low", "high"]], known)
    with pytest.raises(rehearse.InvalidInput, match="^X has nan in row 1, must be finite$"):
        rehearse.GaussianProcess().fit(pandas.DataFrame({"x": [1, None, 3]}, dtype="Int64"), [1.0, 2.0, 3.0])


# Files of somebody else.


def test_a_file_of_somebody_else_is_left_as_it_is(tmp_path):
    run = learn(cart(), tmp_path / "run")
    mine = tmp_path / "thesis.html"
    mine.write_text("<html>mine</html>")
    with pytest.raises(rehearse.InvalidInput, match="thesis.html is no page of Rehearse and is left as it is"):
        run.report(mine)
    with pytest.raises(rehearse.InvalidInput, match="must end in .html"):
        run.report(tmp_path / "cart.py")
    script = tmp_path / "mine.py"
    script.write_text("print('mine')")
    with pytest.raises(rehearse.InvalidInput, match="mine.py is no policy of Rehearse and is left as it is"):
        run.policy().export(script)
    assert mine.read_text() == "<html>mine</html>" and script.read_text() == "print('mine')"
    assert run.report(tmp_path / "page.html") == run.report(tmp_path / "page.html")
    assert run.policy().export(tmp_path / "policy.py") == run.policy().export(tmp_path / "policy.py")


# Options.


def test_options_can_be_listed():
    options = rehearse.options("gp-mi")
    assert options["search.race.max_evaluations"].value == "100000"
    assert options["search.method"].choices == ["race", "restarts", "gradient", "polish"]
    assert options["search.method"].published == "restarts"
    assert set(options) < set(rehearse.options("gp-mi", expert=True))
    assert "plant.m_pole" in rehearse.options("cartpole") and rehearse.options("identify")
    assert rehearse.options(cart())["hidden"].value == "10"
    assert "as-published" in rehearse.presets()
    with pytest.raises(rehearse.InvalidInput, match="unknown scenario or learner 'gpmi', did you mean 'gp-mi'"):
        rehearse.options("gpmi")
