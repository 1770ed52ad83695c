"""Inputs in other forms, and wrong ones: refused by name, or warned of."""

import datetime
import functools
import warnings

import numpy as np
import pytest
from robots import QUICK, Environment, cart, change

import rehearse
from rehearse import environment
from rehearse.environment import Task
from rehearse.tables import to_csv

FILE = """
format = 1
{summary}
name = "cart"
dt_s = {dt_s}
horizon = {horizon}
[[state]]
name = "velocity"
[[state]]
name = "position"
start = 1.0
[[action]]
name = "force"
bounds = [-5.0, 5.0]
[reward]
formula = "exp(-position^2)"
"""
PLANT = """
[dynamics.plant]
rate = { velocity = "force", position = "velocity" }
"""


@pytest.mark.parametrize("changes, message", [
    ({"states": [rehearse.State("velocity"), rehearse.State("velocity")]}, "line 8, `name = \"velocity\"`: the name 'velocity' is given twice"),
    ({"priors": {"slow motor": rehearse.Model(change, parameters={"mass": 1.0})}}, "'slow motor' must be of letters"),
    ({"priors": {"light": rehearse.Model(change, parameters={"mass.cart": 1.0})}},
     "parameters.*: the name of parameter 'mass.cart' must be of letters"),
    ({"success": rehearse.Success("positon > 1")}, "unknown name 'positon', did you mean 'position'"),
])
def test_a_robot_is_refused_where_it_is_made(changes, message):
    with pytest.raises(rehearse.InvalidInput, match=message):
        cart(**changes)


def learn(robot, out, **more):
    return rehearse.learn(robot, out=out, **{"trials": 1, "threads": 2, "progress": None, "options": QUICK, **more})


def toml(**changes):
    return FILE.format(**{"summary": "", "dt_s": 0.1, "horizon": 15, **changes})


@pytest.fixture
def silent():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


# Columns of episodes.


@pytest.fixture(scope="module")
def moved(tmp_path_factory):
    return learn(cart(), tmp_path_factory.mktemp("whole") / "run").trajectory(1)


@pytest.fixture
def run(tmp_path):
    run = learn(cart(plant=None), tmp_path / "told", trials=0)
    run.ask()
    return run


@pytest.mark.parametrize("like", [
    lambda force: [*force[:-1], None],
    lambda force: force.astype(object),
    lambda force: np.array([*force[:-1], None], dtype=object),
    lambda force: force[:-1].astype(str),
    lambda force: [*map(repr, force[:-1].tolist()), ""],
    lambda force: np.ma.masked_invalid(np.where(np.isnan(force), np.inf, force)),
])
def test_columns_of_other_kinds_are_numbers(moved, run, silent, like):
    columns = {name: moved[name] for name in ("time", "velocity", "position")}
    told = run.tell({**columns, "force": like(moved["force"])})
    assert told["trial"] == 1 and told["notes"] == []
    assert run.details[0].total_reward == pytest.approx(run.details[0].total_reward)
    np.testing.assert_array_equal(run.trajectory(1)["force"], moved["force"])


@pytest.mark.parametrize("wrong, message", [
    (["much"] * 16, "force = 'much', must be a finite number"),
    (np.ones(16) + 1j, r"force = '\(1\+1j\)', must be a finite number"),
    (np.where(np.arange(16) % 4 == 2, np.nan, 1.0), "force = 'nan', must be a finite number"),
])
def test_a_column_without_numbers_is_named(moved, run, wrong, message):
    columns = {name: moved[name] for name in ("time", "velocity", "position")}
    with pytest.raises(rehearse.InvalidInput, match=message):
        run.tell({**columns, "force": wrong})


class Series(np.ndarray):
    """As far as pandas' matters here."""

    def __new__(cls, values):
        return np.asarray(values).view(cls)

    def isna(self):
        given = np.asarray(self)
        return np.isnat(given) if given.dtype.kind in "mM" else np.isnan(given)


@pytest.mark.parametrize("like", [
    lambda position: np.ma.masked_array(position, np.arange(16) == 7),
    lambda position: [None if row == 7 else each for row, each in enumerate(position)],
    lambda position: Series(np.where(np.arange(16) == 7, np.nan, position)),
])
def test_missing_samples_are_empty_cells(moved, run, like):
    columns = {name: moved[name] for name in ("time", "velocity", "force")}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of how the episode was read
        assert run.tell({**columns, "position": like(moved["position"])})["trial"] == 1
    between = (moved["position"][6] + moved["position"][8]) / 2
    assert run.trajectory(1)["position"][7] == pytest.approx(between)


BEGUN = datetime.datetime(2026, 1, 2, 3, 4, 5, tzinfo=datetime.timezone.utc)


class Frame(dict):
    """As far as pandas' matters here."""

    def __init__(self, columns, index):
        super().__init__(columns)
        self.index, self.index.name = index, None


@pytest.mark.parametrize("like", [
    lambda spans: spans,
    lambda spans: np.datetime64("2026-01-02T03:04:05") + spans,
    lambda spans: (np.datetime64("2026-01-02T03:04:05") + spans).tolist(),
    lambda spans: spans.tolist(),
    lambda spans: [BEGUN + span for span in spans.tolist()],
])
def test_times_may_be_dates_or_spans(moved, run, silent, like):
    spans = (np.round(moved["time"] * 1e6)).astype("timedelta64[us]")
    assert run.tell({**{name: moved[name] for name in ("velocity", "position", "force")}, "time": like(spans)})["notes"] == []
    np.testing.assert_allclose(run.trajectory(1)["position"], moved["position"], atol=1e-9)


@pytest.mark.parametrize("like", [lambda spans: spans, lambda spans: np.datetime64("2026-01-02") + spans])
def test_an_index_of_dates_needs_no_name(moved, run, silent, like):
    spans = (np.round(moved["time"] * 1e9)).astype("timedelta64[ns]")
    frame = Frame({name: moved[name] for name in ("velocity", "position", "force")}, like(spans).view(Series))
    assert run.tell(frame)["notes"] == []
    np.testing.assert_allclose(run.trajectory(1)["position"], moved["position"], atol=1e-9)


def test_a_date_that_is_missing_is_an_empty_cell():
    time = np.array(["2026-01-01", "NaT", "2026-01-03"], dtype="datetime64[D]")
    assert to_csv({"time": time, "x": [1, 2, 3]}) == "time,x\n0.0,1.0\n,2.0\n172800.0,3.0\n"


def test_what_is_no_column_is_left_out(moved, run, silent):
    columns = {name: moved[name] for name in ("time", "velocity", "position", "force")}
    more = {"operator": "me", "events": ["started", "stopped"], "episode": 5, "images": np.zeros((16, 3, 3))}
    assert run.tell({**columns, **more})["trial"] == 1


def test_a_column_of_another_length_is_named(moved, run):
    columns = {name: moved[name] for name in ("time", "velocity", "position", "force")}
    with pytest.raises(rehearse.InvalidInput, match="column camera has 100 numbers, column time 16"):
        run.tell({**columns, "camera": np.arange(100)})
    with pytest.raises(rehearse.InvalidInput, match="column force has 3 numbers, column time 16"):
        run.tell({**columns, "force": np.ones(3)})


# Asking.


def test_what_is_predicted_of_a_trial_is_kept(moved, run):
    assert run.asked.trial == 1 and np.isnan(run.asked.total_reward)
    run.tell(moved)
    assert run.asked is None
    run.ask()
    assert len(run.prediction(2)) == 16
    with pytest.warns(UserWarning, match="told before"):
        assert run.tell(moved)["trial"] == 1
    assert rehearse.open_run(run.folder).asked.trial == 2, "another process knows it, too"
    assert run.asked.trial == 2 and run.asked.predicted_return > 0 and run.asked.phi["mass"] > 1
    run.take_back()
    assert run.asked.trial == 1, "its policy is asked for, as before it was told"


def test_notes_of_a_trial_to_come_are_warnings(tmp_path):
    model = rehearse.Model(rates={"velocity": "(force - friction * velocity) / mass"},
                           parameters={"mass": 1.0, "friction": 0.3}, tune={"mass": (0.2, 5)})
    robot = cart(plant=None, success=None, priors={"light": model}, limits=[rehearse.Limit("position < 0.5", "near")])
    run = learn(robot, tmp_path / "run", trials=0, options={**QUICK, "search.safety.searches": 0})
    with pytest.warns(UserWarning):
        run.ask()
    assert run.asked.limits[0]["name"] == "near" and run.asked.limits[0]["risk"] > 0.05 and run.asked.notes


# Robots.


def test_a_limit_may_be_anything_that_can_be_called(tmp_path):
    class Near:
        def __call__(self, states, actions, following):
            return following[:, 1] < 100

    part = functools.partial(lambda most, states, actions, following: following[:, 1] < most, 100)
    run = learn(cart(limits=[rehearse.Limit(part), rehearse.Limit(Near())]), tmp_path / "two")
    assert [limit["name"] for limit in run.details[0].limits] == ["limit 1", "limit 2"]
    run = learn(cart(limits=[rehearse.Limit(part)]), tmp_path / "one")
    assert [limit["name"] for limit in run.details[0].limits] == ["limit"]


def test_a_prior_may_be_called_plant(tmp_path):
    light = rehearse.Model(change, parameters={"mass": 1.0, "friction": 0.3}, tune={"mass": (0.2, 5)})
    run = learn(cart(priors={"plant": light}), tmp_path / "run")
    assert run.details[0].total_reward == learn(cart(priors={"light": light}), tmp_path / "same").details[0].total_reward


def test_what_a_model_does_not_have_is_refused():
    given = dict(parameters={"mass": 1.0, "friction": 0.3})
    with pytest.raises(rehearse.InvalidInput, match="late: delay_s and lag_s are of a Model that is the plant"):
        cart(priors={"late": rehearse.Model(change, delay_s={"force": 0.1}, **given)})
    with pytest.raises(rehearse.InvalidInput, match="plant: tune is of priors"):
        cart(plant=rehearse.Model(change, tune={"mass": (0.2, 5)}, **given))


def test_a_file_is_read_as_toml(tmp_path):
    file = tmp_path / "robot.toml"
    file.write_text(toml(summary='summary = """\nname = other\nhorizon = 3\n"""', horizon="15.0"))
    robot = rehearse.Robot.from_file(file, plant=Environment())
    assert robot.name == "cart"
    assert len(learn(robot, tmp_path / "run", learner="black-drops").trajectory(1)) == 16
    file.write_text(toml(dt_s="'a'"))
    with pytest.raises(rehearse.InvalidInput, match="robot.toml: .*dt_s"):
        rehearse.Robot.from_file(file, plant=Environment())


def test_a_file_has_one_plant(tmp_path):
    file = tmp_path / "robot.toml"
    file.write_text(toml() + PLANT + '[plant]\ndynamics = "plant"\n')
    assert rehearse.Robot.from_file(file).name == "cart"
    for plant in (Environment(), rehearse.Model(change)):
        with pytest.raises(rehearse.InvalidInput, match=r"robot.toml has a \[plant\], and plant= is another"):
            rehearse.Robot.from_file(file, plant=plant)
    file.write_text(toml() + PLANT)
    still = rehearse.Model(lambda states, actions: np.zeros_like(states))
    robot = rehearse.Robot.from_file(file, plant=still)
    run = learn(robot, tmp_path / "run", learner="black-drops")
    assert (run.trajectory(1)["position"] == 1).all()


def test_messages_are_of_the_module():
    assert rehearse.InvalidInput.__module__ == rehearse.RunFailed.__module__ == "rehearse"
    assert "a line for everything that is wrong" in rehearse.InvalidInput.__doc__ and rehearse.RunFailed.__doc__


# Environments.


class Box:
    def __init__(self, low, high):
        self.low, self.high = np.array(low, dtype=np.float32), np.array(high, dtype=np.float32)
        self.shape, self.dtype = self.low.shape, self.low.dtype


def boxed(space, **changes):
    environment = Environment()
    environment.action_space = space
    return cart(environment, **changes)


def test_an_environment_has_the_actions_of_the_robot(tmp_path, silent):
    with pytest.raises(rehearse.InvalidInput, match=r"takes 2 actions \(.* shape \(2,\)\), the robot has 1: force"):
        learn(boxed(Box([-5, -5], [5, 5])), tmp_path / "two")
    third = [rehearse.Action("force", (-5 / 3, 5 / 3))]
    learn(boxed(Box([-5 / 3], [5 / 3]), actions=third), tmp_path / "same")
    learn(boxed(Box([-np.inf], [np.inf])), tmp_path / "unbounded")
    whole = Box([-5], [5])
    whole.dtype = np.dtype("int64")
    with pytest.raises(rehearse.InvalidInput, match="its actions must be continuous"):
        learn(boxed(whole), tmp_path / "whole")
    with pytest.raises(UserWarning, match=r"has force between -1 and 1, Action\('force'\) between -5 and 5"):
        learn(boxed(Box([-1], [1])), tmp_path / "other")


def test_an_angle_may_be_turns_away_from_its_start(tmp_path, silent):
    turned = Environment()
    states = [rehearse.State("velocity"), rehearse.State("angle", angle=True, start=1 - 2 * np.pi)]
    learn(cart(turned, states=states, reward=rehearse.Distance("1 - cos(angle)"), success=None, priors=None),
          tmp_path / "run", learner="black-drops")


class Wheel:
    """Turns by these rad, one a step, whatever the action; its angle is between low and low + 2 π, or counts on."""

    def __init__(self, low, rates):
        self.low, self.rates = low, rates

    def shown(self):
        return [self.angle if np.isinf(self.low) else (self.angle - self.low) % (2 * np.pi) + self.low]

    def reset(self, seed=None):
        self.angle, self.step_of = 0.5, 0
        return self.shown()

    def step(self, action):
        self.angle += self.rates[self.step_of]
        self.step_of += 1
        return self.shown()


def angles_of(wheel, folder, angle=True):
    """The state of a wheel in each of two trials."""
    robot = rehearse.Robot("wheel", dt_s=0.1, horizon=len(wheel.rates),
                           states=[rehearse.State("angle", angle=angle, start=0.5)],
                           actions=[rehearse.Action("push", (0, 2))], reward="cos(angle)", plant=wheel)
    run = learn(robot, folder, learner="black-drops", trials=2)
    return [run.trajectory(trial)["angle"] for trial in (1, 2)]


@pytest.mark.parametrize("low", [-np.pi, 0, -np.inf])
def test_an_angle_inside_of_one_turn_is_counted_on(low, tmp_path, silent):
    there_and_back = [1.0] * 10 + [-1.0] * 20
    for angles in angles_of(Wheel(low, there_and_back), tmp_path / "run"):
        assert angles[0] == 0.5
        np.testing.assert_allclose(np.diff(angles), there_and_back)
    if np.isinf(low):
        np.testing.assert_allclose(angles_of(Wheel(low, [20.0]), tmp_path / "fast")[0], [0.5, 20.5])
    plain = angles_of(Wheel(-np.pi, [3.0]), tmp_path / "plain", angle=False)
    assert plain[0][1] == pytest.approx(3.5 - 2 * np.pi)


@pytest.mark.parametrize("returned, message", [
    ((None, {}), "^an observation is None at the start of an episode, must be the states"),
    ((["1", "2"], {}), "^an observation at the start of an episode has texts, must have numbers"),
    ((["1", 2.0, None], {}), "^an observation at the start of an episode has texts, must have numbers"),
    (None, "reset returned None, must be an observation"),
])
def test_what_an_environment_leaves_out_is_named(returned, message):
    env = Environment()
    env.reset = lambda **_: returned
    played = environment.Environment(env, None, Task(3))
    with pytest.raises(ValueError, match=message):
        played.reset(1)
    env.step = lambda _: None
    with pytest.raises(ValueError, match="step returned None in step 1 of an episode, must be an observation, four things or five"):
        played.step(np.zeros(1))
    env.step = lambda _: ([0.0], 0.0, True, None)
    assert played.step(np.zeros(1)) == ([0.0], True)


def stepping(*ends):
    """An environment whose steps end with these."""
    env = Environment()
    env.step = lambda _: ([0.0, 1.0], 0.0, *ends)
    return environment.Environment(env, None, Task(3))


@pytest.mark.parametrize("ends, message", [
    (("no", False, {}), "step returned terminated = 'no' in step 1 of an episode, must be True or False"),
    ((None, False, {}), "step returned terminated = None in step 1 of an episode, must"),
    ((2, False, {}), "step returned terminated = 2 in step 1 of an episode, must"),
    ((np.array([True, False]), False, {}), r"step returned terminated = array\(\[ True, False\]\) in step 1 of an episode, must"),
    ((False, "no", {}), "step returned truncated = 'no' in step 1 of an episode, must"),
    (("False", {}), "step returned done = 'False' in step 1 of an episode, must"),
])
def test_an_episode_is_over_or_not(ends, message):
    with pytest.raises(ValueError, match=f"^{message}"):
        stepping(*ends).step(np.zeros(1))


@pytest.mark.parametrize("like", [bool, int, float, np.bool_, np.int64, lambda truth: np.array([truth])])
def test_an_episode_is_over_by_any_truth(like):
    for truth in (False, True):
        assert stepping(like(truth), like(False), {}).step(np.zeros(1))[1] is truth
        assert stepping(like(truth), {}).step(np.zeros(1))[1] is truth


# Numbers.


@pytest.mark.parametrize("horizon", [60.0, 50.5, "60", None])
def test_a_horizon_is_a_whole_number(horizon):
    with pytest.raises(TypeError, match=f"^horizon = {horizon!r}, must be a whole number$"):
        cart(horizon=horizon)
    assert cart(horizon=np.int64(60)).text == cart(horizon=60).text


def test_numbers_are_refused_by_name(tmp_path):
    run = learn(cart(), tmp_path / "run", trials=2)
    calls = [lambda n: run.resume(3, threads=n, progress=None), lambda n: run.evaluate(3, threads=n),
             lambda n: run.ask(threads=n), lambda n: run.tell(threads=n), lambda n: run.take_back(threads=n),
             lambda n: rehearse.identify(cart(), [], threads=n), lambda n: rehearse.GaussianProcess(threads=n),
             lambda n: learn(cart(), tmp_path / "none", threads=n)]
    for call in calls:
        with pytest.raises(rehearse.InvalidInput, match="threads = -3, must be ≥ 0"):
            call(-3)
        with pytest.raises(TypeError, match="threads = 1.5, must be a whole number"):
            call(1.5)
    for call in (run.policy, run.trajectory, run.prediction):
        with pytest.raises(TypeError, match="trial = 1.0, must be a whole number"):
            call(1.0)
        for trial in (-1, 0, 3):
            with pytest.raises(rehearse.InvalidInput, match=f"trial = {trial}, must be between 1 and 2"):
                call(trial)
    with pytest.raises(TypeError, match="trials = 2.5, must be a whole number"):
        run.resume(2.5)
    with pytest.raises(rehearse.InvalidInput, match="^trials = -3, must be ≥ 1 where Rehearse drives the plant$"):
        run.resume(-3)
    with pytest.raises(rehearse.InvalidInput, match="seed = 9223372036854775808, must be ≤ 9007199254740992"):
        learn(cart(), tmp_path / "none", seed=2**63)
    with pytest.raises(rehearse.InvalidInput, match="seed = -1, must be ≥ 0"):
        run.evaluate(3, seed=-1)
    with pytest.raises(rehearse.InvalidInput, match="seed = 9007199254740993, must be ≤ 9007199254740992"):
        run.evaluate(3, seed=2**53 + 1)
    for episodes in (0, 10**12):
        with pytest.raises(rehearse.InvalidInput, match=f"episodes = {episodes}, must be between 1 and 1000000$"):
            run.evaluate(episodes)
    with pytest.raises(rehearse.InvalidInput, match="trial 1 of .* has no predictions"):
        learn(cart(priors=None), tmp_path / "first", learner="black-drops").prediction(1)
    assert not (tmp_path / "none").exists()
