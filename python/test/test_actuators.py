"""Actions whose commands must not jump, or arrive late: docs/actuators.md."""

import runpy

import numpy as np
import pytest
from robots import QUICK, Environment, cart, change

import rehearse

FORCE = dict(max_rate=40, delay_s=0.2, remember=1)


def late_cart(**changes):
    return cart(actions=[rehearse.Action("force", (-5, 5), "N", **FORCE)], **changes)


def learn(robot, out, **more):
    return rehearse.learn(robot, out=out, **{**dict(trials=2, seed=1, threads=2, progress=None, options=QUICK), **more})


def commands(act, memory, moved):
    """What is sent in the states of a trajectory."""
    states = np.column_stack([moved["velocity"], moved["position"]])[:-1]
    return np.concatenate([act(x, t, memory) for x, t in zip(states, moved["time"])])


def test_policies_remember_what_they_sent(tmp_path):
    run = learn(late_cart(), tmp_path / "run")
    moved = run.trajectory(2)
    sent = moved["force"][:-1]
    np.testing.assert_array_equal(moved["force_last"][1:], sent)
    np.testing.assert_array_equal(moved["force_last2"][2:], sent[:-1])
    assert np.abs(np.diff(sent, prepend=0)).max() <= 4 * (1 + 1e-12)
    policy = run.policy(2)
    np.testing.assert_allclose(commands(policy, policy.start(), moved), sent, rtol=0, atol=1e-12)
    policy.export(tmp_path / "policy.py")
    alone = runpy.run_path(str(tmp_path / "policy.py"))
    np.testing.assert_allclose(commands(alone["act"], alone["start"](), moved), sent, rtol=0, atol=1e-12)
    many = policy.start(3)
    actions = policy.act(np.array([[0.0, 1.0], [np.nan, 0.0], [0.5, 0.5]]), 0.0, many)
    assert np.isnan(actions).ravel().tolist() == [False, True, False]
    np.testing.assert_array_equal(many[:, 0], [actions[0, 0], 0, actions[2, 0]])
    for wrong in (many.tolist(), many[:2], many.astype(int)):
        with pytest.raises(rehearse.InvalidInput, match="memory must be an array of doubles of the shape"):
            policy.act(np.zeros((3, 2)), 0.0, wrong)
    assert run.trials["phi.mass"][1] == pytest.approx(1.6, rel=1e-3)  # of the cart behind its delay


def test_identify_learns_what_moves_behind_a_delay(tmp_path):
    whole = learn(late_cart(), tmp_path / "whole")
    log = whole.trajectory(1)
    columns = {name: log[name] for name in ("time", "velocity", "position", "force")}
    for beyond in ("nothing", "gp"):
        found = rehearse.identify(late_cart(plant=None), [columns], options={"beyond": beyond})
        assert found.parameters["value"][0] == pytest.approx(1.6, rel=0.05)


def test_what_is_told_needs_no_memory(tmp_path):
    whole = learn(late_cart(), tmp_path / "whole")
    run = learn(late_cart(plant=None), tmp_path / "told", trials=0)
    for trial in (1, 2):
        run.ask()
        moved = whole.trajectory(trial)
        run.tell({name: moved[name] for name in ("time", "velocity", "position", "force")})
    assert (run.folder / "trials.csv").read_bytes() == (whole.folder / "trials.csv").read_bytes()


class Late(Environment):
    """A cart with a delay of its own: two steps."""

    def reset(self, **arguments):
        self.way = [0.0, 0.0]
        return super().reset(**arguments)

    def step(self, action):
        self.way.append(float(action[0]))
        return super().step([self.way.pop(0)])


def test_an_environment_has_its_own_delay(tmp_path):
    simulated = learn(late_cart(), tmp_path / "simulated")
    run = learn(late_cart(plant=Late), tmp_path / "environment")
    for column in ("position", "force", "force_last2"):
        np.testing.assert_allclose(run.trajectory(2)[column], simulated.trajectory(2)[column], atol=1e-6)


def test_a_plant_may_have_another_delay(tmp_path):
    late = rehearse.Model(change, parameters={"mass": 1.6, "friction": 0.3}, delay_s={"force": 0.3})
    moved = learn(late_cart(plant=late), tmp_path / "late", trials=1).trajectory(1)
    np.testing.assert_array_equal(moved["velocity"][:4], np.zeros(4))
    assert moved["velocity"][4] != 0


def test_a_wrong_value_is_named(tmp_path):
    with pytest.raises(rehearse.InvalidInput, match=r"line \d+, `delay_s = 11`: delay_s = 11, must be between 0 and 10"):
        cart(actions=[rehearse.Action("force", (-5, 5), delay_s=11)])
