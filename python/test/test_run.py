"""Runs from Python: the laws, and what functions of Python may do."""

import gc
import os
import pathlib
import re
import signal
import subprocess
import sys
import time
import weakref

import numpy as np
import pytest
from robots import QUICK, Environment, cart, change

import rehearse

PROGRAM = pathlib.Path(rehearse.__file__).parents[2] / "rehearse"
EXAMPLE = pathlib.Path(__file__).parents[2] / "examples/robots/pendulum.toml"


def learn(robot, out, **more):
    arguments = dict(trials=2, seed=1, threads=2, progress=None, options=QUICK)
    arguments.update(more)
    return rehearse.learn(robot, out=out, **arguments)


def files(run):
    names = ["trials.csv", "errors.csv", "policy.json", "trajectories/trial-001.csv", "predictions/trial-001.csv"]
    return [(run.folder / name).read_bytes() for name in names]


def test_the_learner_follows_from_the_robot(tmp_path):
    guessed = rehearse.learn(cart(), trials=0, out=tmp_path / "guessed", progress=None)
    alone = rehearse.learn(cart(priors={}), trials=0, out=tmp_path / "alone", progress=None)
    assert 'learner = "gp-mi"' in (guessed.folder / "spec.toml").read_text()
    assert 'learner = "black-drops"' in (alone.folder / "spec.toml").read_text()


def test_any_number_of_threads_gives_the_same_bytes(tmp_path):
    one = learn(cart(), tmp_path / "one", threads=1)
    two = learn(cart(), tmp_path / "two", threads=2)
    assert files(one) == files(two)
    assert len(one.trials) == 2
    assert one.trials["phi.mass"][1] == pytest.approx(1.6, rel=1e-3)


def test_the_page_says_what_the_robot_has_to_do(tmp_path):
    page = learn(cart(summary="go to the origin"), tmp_path / "run").report().read_text()
    assert '"task":"go to the origin"' in page


def test_a_file_gives_the_bytes_of_the_command_line(tmp_path):
    options = [word for name, value in QUICK.items() for word in ("--set", f"{name}={value}")]
    subprocess.run([PROGRAM, "learn", EXAMPLE, "--learner", "gp-mi", "--trials", "2", "--out", tmp_path / "there",
                    *options], check=True, capture_output=True)
    here = learn(EXAMPLE, tmp_path / "here")
    assert files(here) == files(rehearse.open_run(tmp_path / "there"))


def test_formulas_in_python_are_those_of_a_file(tmp_path):
    formula = cart(reward="exp(-position^2 / (2 * 0.3^2))",
                   success=rehearse.Success("abs(position) < 0.2", 0.3),
                   plant=rehearse.Model(rates={"velocity": "(force - friction * velocity) / mass"},
                                        parameters={"mass": 1.6, "friction": 0.3}))
    run = learn(formula, tmp_path / "run")
    assert run.trials["return"][1] == pytest.approx(learn(cart(), tmp_path / "same").trials["return"][1], abs=0.2)


def test_states_are_measured_with_noise_of_their_own(tmp_path):
    noisy = cart(plant=rehearse.Model(change, parameters={"mass": 1.6, "friction": 0.3}),
                 measurement_noise={"position": 0.01})
    rows = learn(noisy, tmp_path / "run").trajectory(1)
    assert np.all(rows["velocity"] == rows["true velocity"]) and np.all(rows["position"] != rows["true position"])


def test_to_look_at_a_run_its_functions_are_not_needed(tmp_path):
    run = learn(cart(), tmp_path / "run")
    seen = rehearse.open_run(tmp_path / "run")
    assert seen.best == run.best and seen.solved_at == run.solved_at
    states = np.array([[0.3, -0.5]])
    np.testing.assert_array_equal(seen.policy()(states), run.policy()(states))
    assert "mass" in seen._repr_html_()
    for command in ("status", "export"):
        more = ["--out", tmp_path / "policy.h"] if command == "export" else []
        shown = subprocess.run([PROGRAM, command, tmp_path / "run", *more], check=True, capture_output=True, text=True).stdout
        assert command == "export" or ("rehearse.open_run(" in shown and " resume " not in shown), shown
    for call in (lambda: seen.evaluate(3), seen.robustness, lambda: seen.resume(3, progress=None), seen.ask):
        with pytest.raises(rehearse.InvalidInput) as refused:
            call()
        assert [line.split("'")[1] for line in str(refused.value).splitlines()] == ["light", "plant"]
        assert str(refused.value).count("in Python the robot is given again, rehearse.open_run(folder, robot)") == 2


def test_tables_know_their_columns(tmp_path):
    run = learn(cart(), tmp_path / "run")
    assert (run.spec["robot"], run.spec["learner"], run.spec["seed"]) == ("cart", "gp-mi", 1)
    assert run.spec["options"]["learner.model.gp.mirror"] == "off"
    with pytest.raises(rehearse.InvalidInput, match="is a run's spec, not a robot: `rehearse learn "):
        rehearse.learn(run.folder / "spec.toml")
    moved = run.trajectory(1)
    assert moved.dtype.names[:4] == ("time", "velocity", "position", "true velocity")
    assert len(moved) == 16 and np.isnan(moved["force"][-1])
    none = learn(cart(), tmp_path / "none", trials=0).trials
    assert len(none) == 0 and none.dtype == run.trials.dtype, "whatever the values are"
    assert {name for name in none.dtype.names if none.dtype[name] == np.int64} == {"trial", "rollouts", "failed_rollouts"}
    assert run.table("notes").dtype["trial"] == run.prediction(2).dtype["particles"] == np.int64
    assert run.best.trial in (1, 2)
    assert run.best.intervals.get("mass", (0, 2))[0] < 1.7
    html = run._repr_html_()
    assert "<td>2</td>" in html and "mass" in html
    policy = run.policy(1)
    np.testing.assert_allclose(policy.act([[0.0, 1.0]])[0], [moved["force"][0]], rtol=1e-12)
    assert policy(np.array([np.nan, 0.0])).shape == (1,) and np.isnan(policy([np.nan, 0.0])[0])


def test_data_frames_and_figures(tmp_path):
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("matplotlib")
    run = learn(cart(), tmp_path / "run")
    assert list(pandas.DataFrame(run.trials)["trial"]) == [1, 2]
    figure = run.plot()
    assert len(figure.axes) == 4
    figure.savefig(tmp_path / "figure.png")
    assert (tmp_path / "figure.png").stat().st_size > 10000


def test_a_trial_is_replayed(tmp_path):
    run = learn(cart(bodies=[rehearse.Body("cart", ("position", "0"), ("position", "0.1"))]), tmp_path / "run", trials=1)
    assert run.replay(1) == run.folder / "replay-001.html" and (run.folder / "replay-001.html").stat().st_size > 10000
    with pytest.raises(rehearse.InvalidInput, match="trial = 2, must be between 1 and 1"):
        run.replay(2)
    begun = learn(cart(), tmp_path / "begun", trials=0)
    for call in (begun.trajectory, begun.prediction, begun.replay):
        with pytest.raises(rehearse.InvalidInput, match="^no trial is done yet$"):
            call(1)


def test_a_damaged_table_is_named(tmp_path):
    run = learn(cart(), tmp_path / "run", trials=1)
    table = run.folder / "trials.csv"
    whole = table.read_text()
    for text, why in ((whole[:-20], "row 2 has [0-9]+ cells, must have [0-9]+, as the header: it is damaged"),
                      ("", "it is empty, must have a header")):
        table.write_text(text)
        with pytest.raises(rehearse.InvalidInput, match=f"trials.csv: {why}$"):
            run.table("trials")


def test_an_environment_is_the_plant(tmp_path):
    environment = Environment()
    run = learn(cart(environment), tmp_path / "run")
    simulated = learn(cart(), tmp_path / "same")
    assert run.trials["return"][1] == pytest.approx(simulated.trials["return"][1], abs=1e-6)
    assert environment.seeds[0] != environment.seeds[1]
    assert {action.shape for action in environment.actions} == {(1,)}
    evaluation = run.evaluate(3)
    assert evaluation.success_rate in (0.0, 1.0)
    np.testing.assert_array_equal(evaluation.table["return"], evaluation.returns)
    assert evaluation.table.dtype.names == ("return", "solved", "solved_at_end", "ended_s", "broke")
    assert evaluation.broke == [[], [], []] and list(evaluation.table["broke"]) == ["", "", ""]
    assert np.isnan(evaluation.table["ended_s"]).all() and "<td>3</td>" in evaluation._repr_html_()


def test_an_environment_must_fit_the_robot(tmp_path):
    with pytest.raises(ValueError, match="the environment gives 2 numbers at the start of an episode, must be the states velocity"):
        learn(cart(Environment, states=[rehearse.State("velocity")], reward="velocity", success=None,
                   priors={"light": rehearse.Model(rates={"velocity": "force"})}), tmp_path / "run")
    with pytest.warns(UserWarning, match="starts with position = 1, .* says start=0.5") as warned:
        learn(cart(Environment, states=[rehearse.State("velocity"), rehearse.State("position", start=0.5)]),
              tmp_path / "other", trials=2)
    assert len(warned) == 1, "once a state, not in each trial"
    with pytest.raises(ValueError, match="observe=f"):
        learn(cart(Environment, observe=lambda observation: {"x": 1}), tmp_path / "third")


def test_an_environment_may_end_an_episode(tmp_path):
    far = cart(Environment, states=[rehearse.State("velocity"), rehearse.State("position", rate="velocity", start=1.0)],
               reward=lambda states, actions, following: following[:, 1])
    run = learn(far, tmp_path / "run", trials=1)
    assert len(run.trajectory(1)) < 16 and run.details[0].solved is False


def test_an_environment_with_a_shorter_time_is_refused(tmp_path):
    with pytest.raises(RuntimeError, match="ended the episode after 10 of 15 steps"):
        learn(cart(Environment(limit=10)), tmp_path / "run")


def test_an_exception_of_a_function_comes_out_and_the_run_goes_on(tmp_path):
    calls = []

    def failing(states, actions, following):
        calls.append(len(states))
        if len(calls) == 200:
            raise ZeroDivisionError("the two hundredth call")
        return np.exp(-following[:, 1] ** 2 / (2 * 0.3**2))

    robot = cart(reward=failing)
    with pytest.raises(ZeroDivisionError, match="two hundredth") as raised:
        learn(robot, tmp_path / "run")
    if sys.version_info >= (3, 11):
        assert "raised in reward" in raised.value.__notes__
    again = rehearse.resume(tmp_path / "run", robot, progress=None)
    assert files(again) == files(learn(cart(), tmp_path / "never"))


@pytest.mark.parametrize("wrong, message", [
    (lambda x, u, n: np.zeros(3), r"reward returned an array of shape \(3,\), must be \(\d+,\)"),
    (lambda x, u, n: "much", "reward returned texts, must be an array of numbers"),
    (lambda x, u: np.zeros(len(x)), "positional arguments"),
    (lambda x, u, n: None, "reward returned None, must be an array of numbers"),
    (lambda x, u, n: n[:, 1] + 1j, "reward returned complex numbers, must be an array of numbers"),
    (lambda x, u, n: [None, *n[1:, 1]], "reward returned None among its numbers, must be an array of numbers"),
    (lambda x, u, n: n[:, 1].astype(str), "reward returned texts, must be an array of numbers"),
    (lambda x, u, n: ["1", *n[1:, 1]], "reward returned texts, must be an array of numbers"),
    (lambda x, u, n: np.full(len(n), "2020-01-01", "M8[s]"), "reward returned times, must be an array of numbers"),
])
def test_wrong_results_say_what_they_must_be(tmp_path, wrong, message):
    with pytest.raises((ValueError, TypeError), match=message):
        learn(cart(reward=wrong), tmp_path / "run")


@pytest.mark.parametrize("returned, message", [
    (None, "None"),
    (np.zeros(16), r"an array of shape \(16,\)"),
    ("1.5", "str"),
    (np.complex64(1j), "a complex number"),
])
def test_the_reward_of_an_episode_is_a_number(tmp_path, returned, message):
    with pytest.raises(ValueError, match=f"^episode_reward returned {message}, must be a number$"):
        learn(cart(episode_reward=lambda states, actions: returned), tmp_path / "run")


@pytest.mark.parametrize("number", [-2, np.float32(-2), np.array(-2.0)])
def test_the_reward_of_an_episode_may_be_any_number(tmp_path, number):
    plain = learn(cart(), tmp_path / "plain", trials=1).trials["return"]
    run = learn(cart(episode_reward=lambda states, actions: number), tmp_path / "run", trials=1)
    np.testing.assert_allclose(run.trials["return"], plain - 2)


@pytest.mark.parametrize("masked", [False, True])
def test_rows_that_are_nan_end_their_rollouts_alone(tmp_path, masked):
    def holes(states, actions, mass, friction):
        moved = change(states, actions, mass=mass, friction=friction)
        left_out = states[:, 0] < -1.5
        if masked:
            return np.ma.masked_array(moved, mask=np.column_stack([left_out, left_out]))
        moved[left_out] = np.nan
        return moved

    prior = rehearse.Model(holes, parameters={"mass": 1.0, "friction": 0.3}, tune={"mass": (0.2, 5)})
    run = learn(cart(priors={"holes": prior}), tmp_path / "run")
    assert run.trials["failed_rollouts"].max() > 0


def test_arrays_may_be_kept(tmp_path):
    kept = []

    def keeping(states, actions, following):
        kept.append((states, states[:, 0], states.copy()))
        return np.exp(-following[:, 1] ** 2 / (2 * 0.3**2))

    learn(cart(reward=keeping), tmp_path / "run", trials=1)
    for array, view, copy in kept:
        assert (array == copy).all() and (view == copy[:, 0]).all()


def test_progress_may_stop_a_run(tmp_path):
    seen = []

    def stop(event):
        seen.append(event["kind"])
        if event["kind"] == "trial":
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        learn(cart(), tmp_path / "run", progress=stop)
    assert seen[0] == "started" and seen[-1] == "trial"
    rest = rehearse.open_run(tmp_path / "run", cart()).resume(progress=None)
    assert files(rest) == files(learn(cart(), tmp_path / "whole"))


def test_control_c_stops_it_and_resume_goes_on(tmp_path):
    script = f"""
import sys; sys.path.insert(0, {str(pathlib.Path(__file__).parent)!r})
from robots import cart
import rehearse
rehearse.learn(cart(), trials=3, out={str(tmp_path / "run")!r}, threads=2, options={{"search.race.max_evaluations": 30000}})
"""
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    for line in process.stdout:
        if line.startswith("trial 1"):
            break
    time.sleep(0.3)
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=60)
    assert "KeyboardInterrupt: interrupted: rehearse.resume(" in error and process.returncode != 0
    assert len(rehearse.open_run(tmp_path / "run", cart()).trials) in (1, 2)
    rest = rehearse.resume(tmp_path / "run", cart(), progress=None)
    whole = learn(cart(), tmp_path / "whole", trials=3, options={"search.race.max_evaluations": 30000})
    assert files(rest) == files(whole)


def test_control_c_in_a_function_of_the_robot_is_no_failure(tmp_path):
    def stopped(states, actions, mass, friction):
        raise KeyboardInterrupt

    prior = rehearse.Model(stopped, parameters={"mass": 1.0, "friction": 0.3})
    with pytest.raises(KeyboardInterrupt):
        learn(cart(priors={"light": prior}), tmp_path / "run")
    assert not (tmp_path / "run/failed").exists()


def test_ask_and_tell_are_learn(tmp_path):
    whole = learn(cart(), tmp_path / "whole", trials=2)
    run = learn(cart(plant=None), tmp_path / "told", trials=0)
    for trial in (1, 2):
        policy = run.ask()
        assert policy.trial == trial
        told = run.tell(whole.trajectory(trial))
        assert told["trial"] == trial
    assert (run.folder / "trials.csv").read_bytes() == (whole.folder / "trials.csv").read_bytes()
    run.ask()
    with pytest.raises(rehearse.InvalidInput, match="force"):
        run.tell({"time": [0, 0.1], "position": [1, 1], "velocity": [0, 0]})
    still = {"time": [0, 0.1, 0.2], "position": [1, 1, 1], "velocity": [0, 0, 0], "force": [0, 0]}
    with pytest.warns(UserWarning, match="stopped by the operator: wall"):
        assert run.tell(still, stopped="wall")["trial"] == 3
    run.ask()
    with pytest.warns(UserWarning, match="by no fault of the policy: battery"):
        run.tell({**still, "position": [1, 1, 0.99]}, stopped="battery", at_fault=False)
    assert [trial.cut_short for trial in run.details] == [False, False, False, True]
    assert run.details[3].solved is None and run.best.trial < 4
    assert len(run.evaluate(3).returns) == 3  # the prior plays the robot
    heavy = run.evaluate(3, options={"prior.mass": 4.5})
    assert (heavy.returns != run.evaluate(3).returns).all()
    changed = run.robustness(3, options={"prior.mass": 4.5})
    assert set(changed["parameter"]) == {"mass", "friction"} and list(changed["factor"]) == [0.75, 0.875, 1, 1.125, 1.25] * 2
    assert changed["return_50"][2] == np.median(heavy.returns)


def test_trials_that_do_not_get_better_are_looked_at_again(tmp_path):
    """The force acts two steps late, which no model knows."""
    late = rehearse.Model(change, parameters={"mass": 1.0, "friction": 0.3}, delay_s={"force": 0.2})
    prior = rehearse.Model(change, parameters={"mass": 1.3, "friction": 0.3}, tune={"mass": (0.2, 5)})
    robot = cart(plant=late, priors={"light": prior}, success=rehearse.Success("position > 1e6"))
    with pytest.warns(UserWarning, match="actions seem to act 0.2 s later"):
        run = learn(robot, tmp_path / "run", trials=3)
    told = learn(cart(plant=None, priors={"light": prior}, success=rehearse.Success("position > 1e6")), tmp_path / "told", trials=0)
    for trial in (1, 2):
        told.ask()
        told.tell(run.trajectory(trial))
    told.ask()
    with pytest.warns(UserWarning, match="actions seem to act 0.2 s later"):
        told.tell(run.trajectory(3))


def test_a_prior_that_fails_when_trials_are_looked_at_again_hides_none(tmp_path):
    raised = []

    def worn(states, actions, mass, friction):
        if (tmp_path / "run" / "done").exists():
            raised.append(len(states))
            raise RuntimeError("worn out")
        return change(states, actions, mass=mass, friction=friction)

    prior = rehearse.Model(worn, parameters={"mass": 1.3, "friction": 0.3}, tune={"mass": (0.2, 5)})
    robot = cart(priors={"light": prior}, success=rehearse.Success("position > 1e6"))
    assert len(learn(robot, tmp_path / "run", trials=3).trials) == 3
    assert raised


def test_what_was_told_can_be_taken_back(tmp_path):
    anew = {**QUICK, "start_from_best": False}  # the policies of both trials differ
    whole = learn(cart(), tmp_path / "whole", options=anew)
    run = learn(cart(plant=None), tmp_path / "told", trials=0, options=anew)
    policy = run.ask()
    before = (run.folder / "checkpoint").read_bytes()
    with pytest.warns(UserWarning, match="force"):
        run.tell(whole.trajectory(2))
    taken = run.take_back()
    assert taken["trial"] == 1 and len(taken["files"]) == 1
    np.testing.assert_array_equal(np.genfromtxt(taken["files"][0], delimiter=",", names=True)["force"],
                                  whole.trajectory(2)["force"])
    assert (run.folder / "checkpoint").read_bytes() == before
    assert run.ask().trial == policy.trial == 1
    run.tell(whole.trajectory(1))
    run.ask()
    run.tell(whole.trajectory(2))
    assert (run.folder / "trials.csv").read_bytes() == (whole.folder / "trials.csv").read_bytes()
    with pytest.raises(rehearse.InvalidInput, match="no file was told"):
        whole.take_back()


def test_a_prior_without_anything_to_tune_is_warned_of(tmp_path):
    fixed = rehearse.Model(change, parameters={"mass": 1.2, "friction": 0.3})
    with pytest.warns(UserWarning, match="prior fixed has nothing to tune, so gp-mi learns no parameters"):
        learn(cart(priors={"fixed": fixed}), tmp_path / "fixed", trials=0)


def test_what_is_told_is_checked(tmp_path):
    whole = learn(cart(), tmp_path / "whole", trials=1).trajectory(1)
    run = learn(cart(plant=None), tmp_path / "told", trials=0)
    run.ask()
    holed = whole.copy()
    holed["position"][7] = np.nan
    with pytest.raises(rehearse.InvalidInput, match=r"^episode-1.csv: row 9.*position"):
        run.tell(holed)
    with pytest.raises(rehearse.InvalidInput, match="14 of 15 steps, which take 16 rows"):
        run.tell(whole[:-1])
    with pytest.raises(rehearse.InvalidInput, match=r"force = '\[0. 0.\]', must be a finite number"):
        run.tell({"time": whole["time"], "force": np.zeros((16, 2))})
    other = {name: whole[name] for name in ("time", "velocity", "position")}
    with pytest.warns(UserWarning, match="force"):
        run.tell({**other, "force": -whole["force"], "mode": ["automatic"] * 16})


def test_a_function_that_cannot_be_called_leaves_no_folder(tmp_path):
    with pytest.raises(ZeroDivisionError):
        learn(cart(reward=lambda states, actions, following: 1 / 0), tmp_path / "run")
    nowhere = rehearse.Model(lambda states, actions: np.full_like(states, np.nan))
    with pytest.raises(rehearse.InvalidInput, match="prior lost changes the start by what is not finite"):
        learn(cart(priors={"lost": nowhere}), tmp_path / "run")
    with pytest.raises(ZeroDivisionError):
        learn(cart(rehearse.Model(lambda states, actions: 1 / 0)), tmp_path / "run")
    assert not (tmp_path / "run").exists()


def test_logs_come_first(tmp_path):
    log = learn(cart(), tmp_path / "other", trials=1).trajectory(1)
    run = learn(cart(plant=None), tmp_path / "told", trials=0)
    assert run.tell(log)["logs"] == ["episode-1.csv"]
    run.ask()


def test_what_is_wrong_is_said_in_lines(tmp_path):
    with pytest.raises(rehearse.InvalidInput) as raised:
        learn(cart(horizon=0, states=[rehearse.State("velocity", rate="speed")]), tmp_path / "run")
    assert "horizon = 0, must be between 1 and 1000000" in str(raised.value)
    with pytest.raises(rehearse.InvalidInput, match="did you mean 'gp-mi'"):
        learn(cart(), tmp_path / "run", learner="gp-m")
    with pytest.raises(rehearse.InvalidInput, match="did you mean 'hidden'|unknown option"):
        learn(cart(), tmp_path / "run", options={"hiden": 3})
    with pytest.raises(rehearse.InvalidInput, match="rehearse.open_run"):
        rehearse.resume(learn(cart(), tmp_path / "run").folder, trials=3, progress=None)
    with pytest.raises(rehearse.InvalidInput, match="neither|either"):
        cart(priors={"none": rehearse.Model()})
    with pytest.raises(TypeError, match="priors is a Model, must be a dictionary"):
        cart(priors=rehearse.Model(change))
    with pytest.raises(TypeError, match="success must be like"):
        cart(success=lambda states: states[:, 0] > 1)
    with pytest.raises(rehearse.InvalidInput, match="rk4 was given dt_s = 0.5"):
        cart(plant=rehearse.Model(rehearse.rk4(lambda x, u: x, 0.5)))
    with pytest.raises(rehearse.InvalidInput, match="last_s = 9 is more than the 1.5 s"):
        learn(cart(success=rehearse.Success("velocity > 1", 9)), tmp_path / "none")
    with pytest.raises(ValueError, match="success returned numbers, must be truths"):
        learn(cart(success=rehearse.Success(lambda states: states[:, 0])), tmp_path / "none")
    with pytest.raises(ValueError, match="success returned None, must be an array of numbers"):
        learn(cart(success=rehearse.Success(lambda states: None)), tmp_path / "none")
    with pytest.raises(ValueError, match="success returned a masked array, must be truths"):
        learn(cart(success=rehearse.Success(lambda states: np.ma.masked_array(states[:, 0] > 1))), tmp_path / "none")
    with pytest.raises(ValueError, match="success returned list, must be an array of numbers"):
        learn(cart(success=rehearse.Success(lambda states: [[True], [True, False]])), tmp_path / "none")
    with pytest.raises(rehearse.InvalidInput, match="is not a run folder"):
        rehearse.open_run(tmp_path / "nowhere")
    assert not (tmp_path / "none").exists()


def test_the_module_is_the_command_line(tmp_path):
    told = subprocess.run([sys.executable, "-m", "rehearse", "list"], capture_output=True, text=True, check=True)
    assert "pendubot" in told.stdout and "gp-mi" in told.stdout
    wrong = subprocess.run([sys.executable, "-m", "rehearse", "learn", "pendubo"], capture_output=True, text=True)
    assert wrong.returncode == 2 and "did you mean" in wrong.stderr
    assert set(rehearse.robots()) >= {"pendubot", "cartpole", "pendulum"}
    assert set(rehearse.learners()) >= {"gp-mi", "black-drops", "pilco", "ite", "gp-ilqg", "pi-rem"}


def test_a_run_may_begin_with_a_policy(tmp_path):
    policy = learn(cart(), tmp_path / "before").policy(2)
    alone = learn(cart(priors=None), tmp_path / "alone", learner="black-drops", policy=policy, trials=1)
    np.testing.assert_array_equal(alone.policy(1).theta, policy.theta)
    policy.export(tmp_path / "policy.json")
    again = learn(cart(priors=None), tmp_path / "again", learner="black-drops", policy=tmp_path / "policy.json", trials=1)
    assert (again.folder / "trials.csv").read_bytes() == (alone.folder / "trials.csv").read_bytes()
    assert "start = " in (again.folder / "spec.toml").read_text()
    with pytest.raises(rehearse.InvalidInput, match="no policy that `export` wrote"):
        learn(cart(), tmp_path / "wrong", policy=alone.folder / "spec.toml")


def test_a_policy_can_be_taken_along(tmp_path):
    run = learn(cart(), tmp_path / "run")
    policy = run.policy()
    for name in ("push.h", "push.json", "push.py"):
        policy.export(tmp_path / name)
    space = {}
    exec((tmp_path / "push.py").read_text(), space)
    states = np.random.default_rng(1).normal(size=(50, 2))
    np.testing.assert_allclose(space["act"](states, 0.0), policy(states), rtol=1e-12, atol=1e-12)
    assert re.search(r"push_act", (tmp_path / "push.h").read_text())
    with pytest.raises(ValueError, match="must end in"):
        policy.export(tmp_path / "push.txt")


@pytest.mark.skipif("asan" in os.environ.get("LD_PRELOAD", ""), reason="the sanitizer keeps memory that was freed")
def test_memory_does_not_grow_with_runs(tmp_path):
    status = pathlib.Path("/proc/self/statm")
    if not status.exists():
        pytest.skip("no /proc")
    kept, sizes = [], []
    for number in range(int(os.environ.get("REHEARSE_RUNS", "50"))):
        held = np.ones(250_000)  # 2 MB, which the reward holds
        reward = lambda x, u, following, held=held: np.exp(-following[:, 1] ** 2) * held[0]  # noqa: E731
        kept.append(weakref.ref(reward))
        run = learn(cart(reward=reward), tmp_path / str(number), learner="mi", trials=1, threads=1,
                    options={"search.race.max_evaluations": 200, "retry.searches": 0})
        del reward, run, held
        gc.collect()
        sizes.append(int(status.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20)
    assert all(reward() is None for reward in kept)
    assert max(sizes) < sizes[9] + 10, sizes[9::10]  # MB: a tenth of what is held, and 250 kB a run of C++
