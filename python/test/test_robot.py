"""Robots as Python describes them: names, environments, and several runs of one."""

import pathlib
import shutil
import subprocess
import sys

import numpy as np
import pytest
from robots import QUICK, Environment, cart, change

import rehearse

FILE = """
format = 1
name = "cart"
dt_s = 0.1
horizon = {horizon}
[[state]]
name = "velocity"
unit = "m/s"
[[state]]
name = "position"
unit = "m"
start = 1.0
[[action]]
name = "force"
bounds = [-5.0, 5.0]
[reward]
formula = "exp(-position^2)"
"""


def learn(robot, out, **more):
    return rehearse.learn(robot, out=out, **{"trials": 1, "threads": 2, "progress": None, "options": QUICK, **more})


def test_a_limit_may_have_the_name_of_the_reward(tmp_path):
    def near(states, actions, following):
        return following[:, 1] < 100

    runs = [learn(cart(limits=[rehearse.Limit(near, name=name)]), tmp_path / name) for name in ("near", "reward")]
    assert runs[0].trials["return"][0] == runs[1].trials["return"][0]
    assert runs[1].details[0].limits[0]["name"] == "reward" and not runs[1].details[0].limits[0]["broken"]


def test_a_limit_may_use_the_action_before_and_the_time(tmp_path):
    def gentle(states, actions, following, before, time_s):
        assert actions.shape == before.shape and (time_s > 0 or np.all(before == 0))
        return np.abs(actions - before)[:, 0] < 100 + time_s

    limits = [rehearse.Limit(gentle), rehearse.Limit("abs(force - force_before) < 100 + time")]
    run = learn(cart(limits=limits), tmp_path / "run")
    assert [limit["broken"] for limit in run.details[0].limits] == [False, False]
    run = learn(cart(limits=[rehearse.Limit("time < 0.35", "short")]), tmp_path / "short")
    assert run.details[0].limits[0]["broken"] and len(run.trajectory(1)) == 6
    evaluation = run.evaluate(2)
    assert evaluation.broke == [["short"], ["short"]] and list(evaluation.table["broke"]) == ["short", "short"]


def test_a_whole_episode_may_be_rewarded(tmp_path):
    def farthest(states, actions):
        assert states.shape[1] == 2 and len(states) == len(actions) + 1
        return -100 * states[:, 1].max()

    runs = [learn(cart(episode_reward=reward), tmp_path / name)
            for name, reward in (("function", farthest), ("formula", "-100 * position_max"))]
    assert runs[0].trials["return"][0] == runs[1].trials["return"][0] < -80
    with pytest.raises(rehearse.InvalidInput, match="reward of whole episodes"):
        learn(cart(episode_reward=farthest), tmp_path / "planned", learner="gp-ilqg", options={})
    with pytest.raises(ValueError):
        learn(cart(episode_reward=lambda states, actions: "much"), tmp_path / "text")


def test_two_threads_may_fail_at_once(tmp_path):
    script = f"""
import sys, threading, time; sys.path.insert(0, {str(pathlib.Path(__file__).parent)!r})
from robots import QUICK, Environment, cart, change
import rehearse

both, noted = threading.Barrier(2, timeout=20), []

class Noted(Exception):
    def add_note(self, note):
        noted.append(note)
        time.sleep(0.3)  # the other thread runs, and fails

class Failing(Environment):
    def step(self, action):
        both.wait()
        raise Noted("both")

plants = [Environment]
run = rehearse.learn(cart(lambda: plants[-1]()), trials=1, out={str(tmp_path / "run")!r}, progress=None, options=QUICK)
plants.append(Failing)
try:
    run.evaluate(200, threads=2)
except Noted as error:
    print(error, noted)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert done.stdout == "both ['raised in plant']\n", done.stderr


def test_two_runs_of_one_robot_do_not_share_failures(tmp_path):
    robot = cart()

    class Noted(Exception):
        def add_note(self, note):  # while the failure of the first run is kept
            assert len(learn(robot, tmp_path / "second").trials) == 1

    def fail(event):
        raise Noted("the first")

    with pytest.raises(Noted, match="the first"):
        learn(robot, tmp_path / "first", progress=fail)
    assert len(rehearse.open_run(tmp_path / "second").trials) == 1


def test_an_environment_that_can_be_called_is_one_object(tmp_path):
    class Callable(Environment):
        def __call__(self):
            raise AssertionError("it is no function that makes environments")

    assert cart(Callable()).one_at_a_time and cart(Environment()).one_at_a_time
    real = type("Real", (Callable,), {"end": lambda self: None})
    assert cart(real).one_at_a_time, "there is one robot, however often its class is called"
    assert not cart(Callable).one_at_a_time and not cart(lambda: Callable()).one_at_a_time
    assert len(learn(cart(Callable()), tmp_path / "run").evaluate(30).returns) == 30


def test_a_file_may_write_its_horizon_as_toml_has_it(tmp_path):
    file = tmp_path / "cart.toml"
    for horizon in ("1_5", "0xF", "+15"):
        file.write_text(FILE.format(horizon=horizon))
        with pytest.raises(RuntimeError, match="ended the episode after 10 of 15 steps"):
            learn(rehearse.Robot.from_file(file, plant=Environment(limit=10)), tmp_path / "run", learner="black-drops")
        shutil.rmtree(tmp_path / "run", ignore_errors=True)
    file.write_text(FILE.format(horizon="15.5"))
    with pytest.raises(rehearse.InvalidInput, match="horizon = 15.5, must be a whole number"):
        rehearse.Robot.from_file(file, plant=Environment())


def test_an_environment_is_not_asked_for_more_than_its_time(tmp_path):
    run = learn(cart(Environment(limit=15)), tmp_path / "run")
    assert len(run.evaluate(12).returns) == 12
    with pytest.raises(RuntimeError, match="ended the episode after 15 steps by its own limit of time, and more"):
        run.evaluate(2, seconds=2.0)
    assert len(run.evaluate(2, seconds=1.5).returns) == 2


@pytest.mark.parametrize("plant", ["cart(Environment())", "cart()"])
def test_the_interpreter_may_end_while_a_daemon_thread_learns(tmp_path, plant):
    script = f"""
import sys, threading; sys.path.insert(0, {str(pathlib.Path(__file__).parent)!r})
from robots import Environment, cart
import rehearse

begun = threading.Event()

def learn():
    rehearse.learn({plant}, trials=3, out={str(tmp_path / "run")!r}, progress=lambda event: begun.set())

threading.Thread(target=learn, daemon=True).start()
begun.wait(30)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and "FATAL" not in done.stderr, done.stderr
    assert len(rehearse.open_run(tmp_path / "run").trials) < 3


def test_an_argument_that_would_not_be_used_is_refused(tmp_path):
    given, known = dict(parameters={"mass": 1.0, "friction": 0.3}), {"double": "2 * velocity"}
    file = tmp_path / "cart.toml"
    file.write_text(FILE.format(horizon=15))
    for make, message in (
            (lambda: cart(observe=list), "observe goes with an environment, and plant is a Model"),
            (lambda: cart(None, observe=list), "observe goes with an environment, and plant is None"),
            (lambda: rehearse.Robot.from_file(file, observe=list), "observe goes with an environment, and plant is None"),
            (lambda: cart(None, measurement_noise=0.1), "measurement_noise is of a plant, and plant is None"),
            (lambda: cart(None, measurement_noise={"position": 0.1}), "measurement_noise is of a plant"),
            (lambda: cart(rehearse.Model(change, define=known, **given)), "plant: define is for the formulas of rates="),
            (lambda: cart(priors={"light": rehearse.Model(change, define=known, **given)}), "light: define is for")):
        with pytest.raises(rehearse.InvalidInput, match=f"^{message}"):
            make()
    assert cart(None, measurement_noise=0.0).name == rehearse.Robot.from_file(file, plant=Environment(), observe=list).name


def test_parameters_may_have_units():
    light = rehearse.Model(change, parameters={"mass": 1.0, "friction": 0.3}, tune={"mass": (0.2, 5)}, units={"mass": "kg"})
    robot = cart(priors={"light": light})
    assert '"mass" = { "value" = 1.0, "unit" = "kg" }, "friction" = 0.3 }' in robot.text
    with pytest.raises(rehearse.InvalidInput, match=r"light: units of mas, which is no parameter \(there are: mass, friction\)"):
        cart(priors={"light": rehearse.Model(change, parameters={"mass": 1.0, "friction": 0.3}, units={"mas": "kg"})})


def test_two_numbers_in_a_list_are_choices():
    with pytest.warns(UserWarning, match=r"light: tune of mass = \[0.2, 5\]: a list is two choices; bounds are a tuple"):
        with pytest.raises(rehearse.InvalidInput, match="must be one of 0.2, 5"):
            cart(priors={"light": rehearse.Model(change, parameters={"mass": 1.0, "friction": 0.3}, tune={"mass": [0.2, 5]})})


def test_the_robot_of_a_run_finds_its_files(tmp_path):
    programs = pathlib.Path(__file__).parents[2] / "examples/programs"
    (tmp_path / "robot").mkdir()
    shutil.copy(programs / "furuta.py", tmp_path / "robot")
    shutil.copy(programs / "furuta.toml", tmp_path / "robot.toml")
    with pytest.raises(rehearse.InvalidInput, match="furuta.py"):
        rehearse.Robot.from_file(tmp_path / "robot.toml")
    (tmp_path / "spec.toml").touch()  # so it is a run's
    assert rehearse.Robot.from_file(tmp_path / "robot.toml").name.startswith("furuta")


def test_a_file_keeps_its_line_ends(tmp_path):
    programs = pathlib.Path(__file__).parents[2] / "examples/robots"
    text = (programs / "acrobot.toml").read_bytes().replace(b"\n", b"\r\n")
    (tmp_path / "acrobot.toml").write_bytes(text)
    run = rehearse.learn(tmp_path / "acrobot.toml", trials=0, out=tmp_path / "run", progress=None)
    assert (run.folder / "robot.toml").read_bytes() == text
