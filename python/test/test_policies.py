"""Policies that are loaded, pickled and copied."""

import copy
import json
import pickle
import runpy

import numpy as np
import pytest
from robots import QUICK, cart

import rehearse


def learn(robot, out, **more):
    return rehearse.learn(robot, out=out, **{"trials": 2, "threads": 2, "progress": None, "options": QUICK, **more})


def runs(tmp_path):
    """Policies of every form."""
    late = cart(actions=[rehearse.Action("force", (-5, 5), max_rate=40, delay_s=0.25, lag_s=0.1, filter_s=0.05)])
    formula = rehearse.Model(rates={"velocity": "(force - friction * velocity) / mass"},
                             parameters={"mass": 1.0, "friction": 0.3}, tune={"mass": (0.2, 5)})
    states = [rehearse.State("velocity"), rehearse.State("angle", angle=True, rate="velocity", start=1.0)]
    turning = dict(states=states, reward=rehearse.Distance(["1 - cos(angle)", "sin(angle)"], width=0.5), success=None,
                   priors={"light": formula})
    yield learn(cart(), tmp_path / "linear"), 2
    yield learn(late, tmp_path / "late"), 2
    yield learn(cart(policy={"policy": "mlp"}, **turning), tmp_path / "mlp"), 2
    yield learn(cart(policy={"policy": "rbf"}, **turning), tmp_path / "rbf"), 2
    yield learn(cart(**turning, horizon=40), tmp_path / "near", options={**QUICK, "search.hand_over": True}), 2
    yield learn(cart(priors=None), tmp_path / "schedule", learner="black-drops", trials=1), 1
    yield learn(cart(**turning), tmp_path / "tracking", learner="gp-ilqg", options={}), 2


def test_what_is_loaded_or_pickled_answers_as_the_original(tmp_path):
    forms, near = set(), []
    for run, trial in runs(tmp_path):
        policy = run.policy(trial)
        file = policy.export(tmp_path / "policy.json")
        computes = json.loads(file.read_text())["computes"]
        forms.add(computes["form"])
        near += [computes["near"]] if "near" in computes else []
        x = np.random.default_rng(1).normal(size=(50, 2)) * 3
        for again in (rehearse.Policy.load(file), pickle.loads(pickle.dumps(policy)), copy.deepcopy(policy)):
            memory, same = policy.start(50), again.start(50)
            for t in (0.0, 0.1, 0.13, 0.2, 99.0):
                np.testing.assert_allclose(again(x, t, same), policy(x, t, memory), rtol=1e-9, atol=1e-9)
                np.testing.assert_allclose(same, memory, rtol=1e-9, atol=1e-9)
            one = (np.concatenate([x[0], memory[0]]), 0.1)
            np.testing.assert_allclose(again(*one), policy(*one), rtol=1e-9, atol=1e-9)
            assert np.isnan(again(np.full_like(one[0], np.nan), 0.1)).all()
            assert (again.kind, again.trial, again.dt_s) == (policy.kind, policy.trial, policy.dt_s)
            np.testing.assert_array_equal(again.theta, policy.theta)
            assert again.export(tmp_path / "again.json").read_bytes() == file.read_bytes()
            with pytest.raises(rehearse.InvalidInput, match="states must be an array of"):
                again([0.0])
    assert forms == {"layers", "radial", "table", "feedback"}
    assert len(near) == 1, "one of them hands over to feedback"


def test_each_row_may_have_its_time(tmp_path):
    times = np.array([0.3, 0.0, 0.1, np.nan, 0.3, 99.0])
    x = np.random.default_rng(3).normal(size=(6, 2))
    kinds = set()
    for run, trial in runs(tmp_path):
        own = run.policy(trial)
        for policy in own, pickle.loads(pickle.dumps(own)):
            memory, rows = policy.start(6), policy.start(6)
            actions = policy(x, times.tolist(), memory)
            for row, time_s in enumerate(times):
                np.testing.assert_allclose(policy(x[row], time_s, rows[row]), actions[row], rtol=1e-12)
            np.testing.assert_allclose(memory, rows, rtol=1e-12)
            assert policy(np.empty((0, 2)), [], policy.start(0)).shape == (0, 1)
            np.testing.assert_array_equal(policy(x, [0.1], policy.start(6)), policy(x, 0.1, policy.start(6)))
            for wrong in times[:5], times.reshape(2, 3):
                with pytest.raises(rehearse.InvalidInput, match="^time_s "):
                    policy(x, wrong, memory)
        written = own.export(tmp_path / "written.py")
        module = runpy.run_path(str(written))
        more = [module["start"](6)] if len(own.start()) else []
        np.testing.assert_allclose(module["act"](x, times, *more), own(x, times, own.start(6)), rtol=1e-9, atol=1e-9)
        kinds.add(own.kind)
    assert {"schedule", "tracking"} < kinds, "these know the time"


def test_theta_is_a_copy(tmp_path):
    own = rehearse.Policy.of(cart(), [0.1, 0.2, 0.3])
    loaded = rehearse.Policy.load(own.export(tmp_path / "policy.json"))
    for policy in own, loaded, copy.copy(loaded), pickle.loads(pickle.dumps(own)):
        theta = policy.theta
        theta *= 0.5
        np.testing.assert_array_equal(policy.theta, [0.1, 0.2, 0.3])


def test_a_run_may_begin_with_a_policy_that_was_loaded(tmp_path):
    policy = learn(cart(), tmp_path / "before").policy(2)
    loaded = rehearse.Policy.load(policy.export(tmp_path / "policy.json"))
    alone = learn(cart(priors=None), tmp_path / "alone", learner="black-drops", policy=loaded, trials=1)
    np.testing.assert_array_equal(alone.policy(1).theta, policy.theta)
    with pytest.raises(rehearse.InvalidInput, match="as .json alone"):
        loaded.export(tmp_path / "policy.h")


def test_a_policy_may_have_another_theta(tmp_path):
    x = np.random.default_rng(2).normal(size=(5, 2))
    for run, trial in runs(tmp_path):
        policy = run.policy(trial)
        other = policy.with_theta(0.5 * policy.theta)
        np.testing.assert_array_equal(other.theta, 0.5 * policy.theta)
        loaded = rehearse.Policy.load(other.export(tmp_path / "other.json"))
        np.testing.assert_allclose(loaded(x, 0.1, loaded.start(5)), other(x, 0.1, other.start(5)), rtol=1e-9, atol=1e-9)
        with pytest.raises(rehearse.InvalidInput, match="theta has .* numbers, must have"):
            policy.with_theta([*policy.theta, 0.0])
        with pytest.raises(rehearse.InvalidInput, match="knows its own theta alone"):
            loaded.with_theta(policy.theta)


def test_a_policy_needs_no_run(tmp_path):
    robot = cart(policy={"policy": "mlp"})
    still = rehearse.Policy.of(robot, options={"hidden": 3})
    assert still.kind == "mlp" and len(still.theta) == 13 and (still([[1.0, 2.0]]) == 0).all()
    theta = np.random.default_rng(1).normal(size=13)
    policy, (hidden, output) = rehearse.Policy.of(robot, theta, options={"hidden": 3}), np.split(theta, [9])
    units = np.tanh(hidden.reshape(3, 3) @ [1.0, 2.0, 1.0])
    np.testing.assert_allclose(policy([1.0, 2.0]), [5 * np.tanh(output @ [*units, 1.0])])
    run = learn(cart(policy={"policy": "mlp", "hidden": 3}, priors=None), tmp_path / "run", learner="black-drops",
                policy=policy, trials=1)
    np.testing.assert_array_equal(run.policy(1).theta, theta)
    with pytest.raises(rehearse.InvalidInput, match="unknown option"):
        rehearse.Policy.of(robot, options={"hiden": 3})
    with pytest.raises(rehearse.InvalidInput, match="unknown option 'start_from_best'"):  # a learner's
        rehearse.Policy.of(robot, options={"start_from_best": False})


def test_a_file_that_is_no_policy_is_refused(tmp_path):
    text = learn(cart(), tmp_path / "run").policy(2).export(tmp_path / "policy.json").read_text()
    other = tmp_path / "other.json"
    for wrong in ("", "[]", "{}", '{"format": 1}', text.replace('"layers"', '"lines"'), text.replace('"theta"', '"phi"'),
                  text.replace('"hidden"', '"output"')):
        other.write_text(wrong)
        with pytest.raises(rehearse.InvalidInput, match="other.json is no policy that `export` wrote as JSON"):
            rehearse.Policy.load(other)
    file = json.loads(text)
    file["computes"]["gain"] *= 2
    other.write_text(json.dumps(file))
    with pytest.raises(rehearse.InvalidInput, match="does not answer as its test says"):
        rehearse.Policy.load(other)
    other.write_text(json.dumps({**file, "format": 2}))
    with pytest.raises(rehearse.InvalidInput, match="another version"):
        rehearse.Policy.load(other)


def test_searches_say_why_they_are_not_copied():
    for search in (rehearse.Cmaes([0.0], 1.0), rehearse.MapElites([(0, 1)], [(0, 1)], bins=[3])):
        for keep in (pickle.dumps, copy.copy, copy.deepcopy):
            with pytest.raises(TypeError, match=f"a {type(search).__name__} cannot be pickled or copied"):
                keep(search)


def test_another_policy_can_be_evaluated(tmp_path):
    run = rehearse.learn(cart(), trials=1, out=tmp_path / "run", threads=1, progress=None, options=QUICK)
    own = run.policy()
    still = own.with_theta(np.zeros_like(own.theta))
    assert run.evaluate(1, policy=own).returns == run.evaluate(1).returns
    moved = run.evaluate(1, policy=still).returns
    assert moved != run.evaluate(1).returns
    assert run.evaluate(1, policy=still.export(tmp_path / "still.json")).returns == moved
    with pytest.raises(rehearse.InvalidInput, match="trial and policy name two policies"):
        run.evaluate(1, trial=1, policy=still)


def test_a_policy_knows_what_it_is_for(tmp_path):
    own = rehearse.Policy.of(cart())
    for policy in own, rehearse.Policy.load(own.export(tmp_path / "policy.json")):
        assert (policy.steps, policy.states, policy.bounds) == (15, ["velocity", "position"], {"force": (-5, 5)})


def test_no_action_follows_from_what_is_no_number(tmp_path):
    run = rehearse.learn(cart(), trials=1, out=tmp_path / "run", threads=1, progress=None, options=QUICK)
    own = run.policy()
    for policy in own, rehearse.Policy.load(own.export(tmp_path / "policy.json")):
        for states, time_s in ([np.inf, 1], 0), ([np.nan, 1], 0), ([0, 1], np.nan), ([0, 1], np.inf):
            assert np.isnan(policy.act(states, time_s)).all()
        assert np.isnan(policy.act(np.ma.array([0.5, 1.0], mask=[True, False]))).all()
        assert np.isfinite(policy.act([[0, 1], [1, 0]])).all()
