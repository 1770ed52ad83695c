"""Environments that play a robot, their angles and the end of their episodes; functions of all kinds."""

import functools

import numpy as np
import pytest
from robots import QUICK, Environment, cart, change

import rehearse


def learn(robot, out, **more):
    return rehearse.learn(robot, out=out, **{**dict(trials=2, seed=1, threads=2, progress=None, options=QUICK), **more})


def test_an_environment_is_told_that_an_episode_is_over(tmp_path):
    torques = []

    class Driver(Environment):
        def end(self):
            torques.append(0.0)

    learn(cart(Driver()), tmp_path / "run", trials=2)
    assert len(torques) == 2


def test_an_end_that_fails_ends_the_run(tmp_path):
    class Broken(Environment):
        def end(self):
            raise OSError("the bus is off")

    with pytest.raises(OSError, match="the bus is off"):
        learn(cart(Broken()), tmp_path / "run", trials=2)


def test_a_rate_of_another_sign_is_noted(tmp_path):
    robot = cart(Environment(), observe=lambda observation: observation * [-1, 1])
    expected = "position changes -1 times as fast as velocity says"
    run = learn(robot, tmp_path / "run", trials=1)
    assert any(note.startswith(expected) for note in run.best.notes)
    assert any(note.startswith(expected) for note in rehearse.check(robot).notes)
    assert rehearse.check(cart(Environment())).notes == []


def test_angles_begin_in_the_turn_of_the_start(tmp_path):
    class Hanging:
        def reset(self, seed=None):
            return np.array([0.0, -np.pi + 0.01])

        def step(self, action):
            return np.array([0.0, np.pi - 0.01])

    robot = rehearse.Robot("hanging", dt_s=0.1, horizon=3,
                           states=[rehearse.State("rate"), rehearse.State("angle", angle=True, start=np.pi, start_noise=0.1)],
                           actions=[rehearse.Action("u", (-1, 1))], reward="exp(-(angle - pi)^2)", plant=Hanging())
    run = learn(robot, tmp_path / "run", learner="black-drops")
    assert np.abs(run.trajectory(1)["angle"] - np.pi).max() < 0.02


def test_angles_of_single_precision_are_counted_on(tmp_path):
    """The π of single precision is larger than π."""

    class Single:
        def reset(self, seed=None):
            return np.array([0.0, np.pi], dtype=np.float32)

        def step(self, action):
            return np.array([0.0, 0.02 - np.pi], dtype=np.float32)

    robot = rehearse.Robot("hanging", dt_s=0.1, horizon=1,
                           states=[rehearse.State("rate"), rehearse.State("angle", angle=True, start=np.pi)],
                           actions=[rehearse.Action("u", (-1, 1))], reward="exp(-(angle - pi)^2)", plant=Single())
    angles = learn(robot, tmp_path / "run", learner="black-drops", trials=1).trajectory(1)["angle"]
    assert angles[0] == np.float32(np.pi) > np.pi
    np.testing.assert_allclose(angles[1], np.pi + 0.02, atol=1e-6)


def test_a_real_robot_is_made_once_at_a_time_however_it_is_made():
    class Real(Environment):
        def end(self):
            pass

    made = functools.partial(functools.partial(Real, 50), limit=20)
    assert cart(Real).one_at_a_time and cart(made).one_at_a_time
    assert not cart(functools.partial(Environment, 50)).one_at_a_time


def test_an_environment_that_does_not_fit_is_refused_with_the_robot():
    two = Environment()
    two.action_space = type("Space", (), {"shape": (2,), "dtype": np.dtype(float)})()
    with pytest.raises(rehearse.InvalidInput, match="takes 2 actions .* the robot has 1: force"):
        cart(two)


def test_a_real_robot_can_be_left_alone():
    class Moved(Environment):
        def step(self, action):
            raise AssertionError("it moved")

    robot = cart(Moved())
    assert rehearse.check(robot, plant=False).steps > 0
    with pytest.raises(TypeError, match="plant = 1, must be True or False"):
        rehearse.check(robot, plant=1)


def test_a_limit_of_five_arguments_may_have_defaults(tmp_path):
    given = []

    def keep(states, actions, next_states, actions_before=None, time_s=None):
        given.append(time_s)
        return np.ones(len(states), dtype=bool)

    learn(cart(limits=[rehearse.Limit(keep)]), tmp_path / "run", trials=1)
    assert given and None not in given


@pytest.mark.parametrize("wrong, message", [
    (dict(reward=lambda s, a, n: np.log(-n[:, 1])), "reward is not finite at the start"),
    (dict(ended=lambda s: s[:, 1] > 0.5), "`ended` holds at the start"),
])
def test_functions_that_make_each_episode_useless_are_refused(tmp_path, wrong, message):
    with np.errstate(invalid="ignore"), pytest.raises(rehearse.InvalidInput, match=message):
        learn(cart(**wrong), tmp_path / "run")


def test_episodes_are_tried_at_their_length(tmp_path):
    run = learn(cart(episode_reward=lambda states, actions: -abs(states[15, 1])), tmp_path / "run", trials=1)
    assert len(run.trials) == 1


def test_evaluations_have_the_seed_of_the_run(tmp_path):
    run = learn(cart(measurement_noise=0.1), tmp_path / "run", trials=1, seed=3)
    returns, same, other = run.evaluate(3).returns, run.evaluate(3, seed=3).returns, run.evaluate(3, seed=1).returns
    assert (returns == same).all() and (returns != other).all()


class Heavy(Environment):
    """A cart of another mass."""

    def __init__(self, mass):
        super().__init__()
        self.mass = mass

    def step(self, action):
        self.state = self.state + change(self.state, np.atleast_2d(action), mass=self.mass, friction=0.3)
        return self.state[0].copy(), 0.0, False, False, {}


def test_a_policy_is_tried_on_another_environment(tmp_path):
    run = learn(cart(functools.partial(Heavy, 1.6)), tmp_path / "run", trials=1)
    own, heavy = (rehearse.open_run(run.folder, cart(functools.partial(Heavy, mass))).evaluate(2).returns for mass in (1.6, 3))
    assert (own == run.evaluate(2).returns).all() and (heavy != own).all()
    with pytest.raises(rehearse.InvalidInput, match="^unknown option 'plant.mass': the plant of cart has no parameters that are options$"):
        run.evaluate(2, options={"plant.mass": 3})
    with pytest.raises(rehearse.InvalidInput, match="^measurement_noise: the plant is a function, which measures by itself, noise included$"):
        run.evaluate(2, options={"measurement_noise": 0.1})
    with pytest.raises(rehearse.InvalidInput, match="^scenario cart has no parameter plant.NAME that could be changed$"):
        run.robustness(2)


def test_an_observation_that_does_not_fit_is_named_with_its_step(tmp_path):
    class Short(Environment):
        def step(self, action):
            observation, *rest = super().step(action)
            return observation[: 1 if self.steps == 3 else 2], *rest

    with pytest.raises(ValueError, match="^the environment gives 1 numbers in step 3 of an episode, must be the states velocity, "):
        learn(cart(Short), tmp_path / "run", trials=1)


def test_options_are_looked_up_in_python(tmp_path):
    run = learn(cart(), tmp_path / "run", trials=1)
    for call in (lambda: run.evaluate(2, options={"colour": 3}), lambda: learn(cart(), tmp_path / "other", options={"colour": 3}),
                 lambda: rehearse.Policy.of(cart(), options={"colour": 3})):
        with pytest.raises(rehearse.InvalidInput, match="^unknown option 'colour': .* in Python `rehearse.options`$"):
            call()
