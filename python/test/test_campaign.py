"""Campaigns from Python: the command line's bytes, robots with functions, and what stops them."""

import gc
import json
import pathlib
import signal
import subprocess
import sys
import threading
import time
import weakref

import numpy as np
import pytest
from robots import QUICK, Environment, cart, reward

import rehearse

PROGRAM = pathlib.Path(rehearse.__file__).parents[2] / "rehearse"
EXAMPLE = pathlib.Path(__file__).parents[2] / "examples/robots/pendulum.toml"
FILE = """
format = 1
scenario = "{scenario}"
learners = ["gp-mi", "black-drops"]
priors = {priors}
seeds = "1-2"
trials = 2
[set]
""" + "\n".join(f"{name} = {value}" for name, value in QUICK.items()) + """
[learner.gp-mi]
search.selection = 12
[[claim]]
text = "something is solved"
learner = "gp-mi"
solved_by = 2
at_least_runs = 1
"""
TABLES = ["campaign.csv", "summary.json", "campaign.toml"]


def campaign(given, out, *arguments, **more):
    """A campaign of the cart with a quick search, where keys are given."""
    if not str(given).endswith(".toml"):
        more = {"learners": "gp-mi", "seeds": [1, 2], "trials": 2, "set": QUICK, **more}
    return rehearse.campaign(given, *arguments, out=out, **{"threads": 2, "progress": None, **more})


def files(done, names=TABLES):
    return [(done.folder / name).read_bytes() for name in names]


@pytest.mark.parametrize("scenario, priors", [("pendulum", '["misleading"]'), (EXAMPLE, '["useful"]')])
def test_a_file_gives_the_bytes_of_the_command_line(tmp_path, scenario, priors):
    file = tmp_path / "grid.toml"
    file.write_text(FILE.format(scenario=scenario, priors=priors))
    command = [PROGRAM, "campaign", file, "--threads", "1", "--out"]
    subprocess.run([*command, tmp_path / "there"], check=True, capture_output=True)
    here = campaign(file, tmp_path / "here")
    assert files(here) == files(rehearse.open_campaign(tmp_path / "there"))
    assert len(here.trials) == 8 and here.summary["complete"]
    again = subprocess.run([*command, here.folder], check=True, capture_output=True, text=True)
    assert "4 of 4 runs done already" in again.stdout


def test_arguments_are_the_keys_of_a_file(tmp_path):
    file = tmp_path / "grid.toml"
    file.write_text(FILE.format(scenario="pendulum", priors='["misleading"]'))
    claims = [{"text": "something is solved", "learner": "gp-mi", "solved_by": 2, "at_least_runs": 1}]
    keys = dict(learners=["gp-mi", "black-drops"], priors="misleading", seeds=range(1, 3), trials=np.int64(2), set=QUICK,
                learner={"gp-mi": {"search": {"selection": 12}}}, claim=claims)
    named = campaign("pendulum", tmp_path / "named", title="grid", **keys)
    filed = campaign(file, tmp_path / "filed")
    assert files(named, ["campaign.csv"]) == files(filed, ["campaign.csv"])
    summaries = [dict(done.summary, claims=[]) for done in (named, filed)]
    assert summaries[0] == summaries[1]
    np.testing.assert_array_equal(named.claims, filed.claims)


def test_a_robot_with_functions_in_any_number_of_threads(tmp_path):
    one, two = (campaign(cart(), tmp_path / str(threads), threads=threads) for threads in (1, 2))
    assert files(one) == files(two)
    single = rehearse.learn(cart(), seed=2, trials=2, out=tmp_path / "run", options=QUICK, progress=None)
    assert files(one.run("cart-gp-mi-light-2"), ["trials.csv"]) == files(single, ["trials.csv"])
    np.testing.assert_array_equal(one.trials["return"][2:], single.trials["return"])
    assert one.trials["variant"].tolist() == [""] * 4
    longer = one.run("cart-gp-mi-light-2").resume(3, progress=None)
    assert len(longer.trials) == 3 and len(campaign(cart(), one.folder).trials) == 4


def test_a_file_may_name_a_robot_that_is_given(tmp_path):
    file = tmp_path / "carts.toml"
    file.write_text(FILE.format(scenario="cart", priors='["light"]'))
    done = campaign(file, tmp_path / "out", cart())
    assert done.runs["run"].tolist() == [f"cart-{learner}-{seed}" for learner in ("gp-mi-light", "black-drops-none")
                                         for seed in (1, 2)]
    file.write_text(FILE.format(scenario="pendulum", priors='["misleading"]'))
    with pytest.raises(rehearse.InvalidInput, match="scenario = 'pendulum', but the robot that is given is 'cart'"):
        campaign(file, tmp_path / "other", cart())
    file.write_text(FILE.format(scenario="cart", priors='["light"]'))
    with pytest.raises(rehearse.InvalidInput, match="unknown scenario 'cart'"):
        campaign(file, tmp_path / "other")
    assert not (tmp_path / "other").exists()


def test_tables_of_all_that_varies(tmp_path):
    claims = [{"text": "all", "learner": "gp-mi", "solved_by": 2, "at_least_rate": 0.99},
              {"text": "better", "learner": "gp-mi", "variants": ["small"], "metric": "return",
               "better_than": {"variant": "default"}}]
    done = campaign(cart(), tmp_path / "out", learners=["gp-mi", "black-drops"], claim=claims,
                    set={**QUICK, "retry.searches": np.int64(0)}, draw={"plant.mass": (1.2, 1.8)},
                    variant=[{"name": "default"}, {"name": "small", "set": {"policy_gain": 0.5}}])
    assert done.trials.dtype.names[:7] == ("run", "scenario", "learner", "prior", "variant", "seed", "trial")
    assert done.trials["prior"].tolist() == ["light"] * 8 + [""] * 8
    assert set(done.runs["state"]) == {"done"} and done.runs["first_success"].dtype == float
    assert [tuple(row)[:6] for row in done.groups] == [
        ("gp-mi", "light", "default", 2, 2, 0), ("gp-mi", "light", "small", 2, 2, 0),
        ("black-drops", "", "default", 2, 2, 0), ("black-drops", "", "small", 2, 2, 0)]
    assert done.groups["trial"].tolist() == [2] * 4 and 0 <= done.groups["low"][0] <= done.groups["solved_by"][0]
    medians = [np.median(done.trials["return"][(done.trials["trial"] == 2) & (done.trials["run"] == f"cart-gp-mi-light-default-{seed}")])
               for seed in (1, 2)]
    assert done.groups["return_median"][0] == pytest.approx(np.mean(medians))
    assert done.claims["claim"].tolist() == ["all", "all", "better"]
    assert done.claims["variants"].tolist() == ["default", "small", "small"]
    assert done.claims["result"][2] == "undecided" and "pairs" in done.claims["reason"][2]
    html = done._repr_html_()
    assert "<td>black-drops</td>" in html and "better" in html and "failed:" not in html
    assert repr(done).endswith("out: 8 of 8 runs done>")
    drawn = [(done.folder / "runs" / f"cart-{learner}-default-1/spec.toml").read_text() for learner in
             ("gp-mi-light", "black-drops-none")]
    masses = [line for text in drawn for line in text.splitlines() if "plant.mass" in line]
    assert len(masses) == 2 and masses[0] == masses[1] and "1.6" != masses[0][-3:]


def test_curves_have_the_runs_that_ended_before(tmp_path):
    robot = cart(success=rehearse.Success(lambda states: np.abs(states[:, 1]) < 0.05, 0.0))
    done = campaign(robot, tmp_path / "out", seeds="1-4", trials=3, until_solved=True, learners=["gp-mi", "black-drops"])
    curves = done.curves
    assert len(set(np.bincount(done.trials["trial"]))) > 2, "some runs ended before"
    assert curves["trial"].tolist() == [1, 2, 3] * 2 and curves["learner"].tolist() == ["gp-mi"] * 3 + ["black-drops"] * 3
    assert (curves["runs"] == 4).all() and curves["runs"].dtype == np.int64 and curves["return_median"].dtype == float
    np.testing.assert_array_equal(curves["solved_by"], curves["count"] / 4)
    assert (curves["low"] <= curves["solved_by"]).all() and (curves["solved_by"] <= curves["high"]).all()
    first = done.trials[(done.trials["learner"] == "gp-mi") & (done.trials["trial"] == 1)]
    assert curves["return_median"][0] == curves["best_return_median"][0] == pytest.approx(np.median(first["return"]))
    assert curves["interaction_s"][0] == pytest.approx(1.5)
    for curve, group in zip(curves[2::3], done.groups):
        same = ["learner", "trial", "solved_by", "low", "high", "return_median", "best_return_quartile_3"]
        assert curve[same].tolist() == group[same].tolist()


def test_figures_and_the_page(tmp_path):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    done = campaign(cart(), tmp_path / "out", vary={"search.finalists": np.array([1, 2])}, claim=[], variant=[])
    figure = done.plot()
    assert pyplot.get_fignums() == []
    assert len(figure.axes[0].lines) == 2 and figure.axes[0].get_title() == "cart-campaign"
    np.testing.assert_array_equal(figure.axes[0].lines[0].get_ydata()[-1], done.groups["return_median"][0])
    assert "cart-gp-mi-light-search.finalists=1-2" in done.report().read_text()
    pandas = pytest.importorskip("pandas")
    assert list(pandas.DataFrame(done.groups)["variant"]) == ["search.finalists=1", "search.finalists=2"]


def test_the_interpreter_may_end_while_a_daemon_thread_has_a_campaign(tmp_path):
    script = f"""
import sys, threading; sys.path.insert(0, {str(pathlib.Path(__file__).parent)!r})
from robots import cart
import rehearse

begun = threading.Event()

def work():
    rehearse.campaign(cart(), learners="gp-mi", seeds="1-2", trials=3, out={str(tmp_path / "out")!r}, threads=2,
                      progress=lambda event: begun.set() if event["kind"] == "progress" else None)

threading.Thread(target=work, daemon=True).start()
begun.wait(30)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and "FATAL" not in done.stderr, done.stderr
    assert not rehearse.open_campaign(tmp_path / "out").summary["complete"]


def test_functions_and_events_are_let_go(tmp_path):
    of_rows = lambda x, u, following: np.exp(-following[:, 1] ** 2)  # noqa: E731
    hear = lambda event: None  # noqa: E731
    kept = [weakref.ref(of_rows), weakref.ref(hear)]
    campaign(cart(reward=of_rows), tmp_path / "out", progress=hear)
    del of_rows, hear
    gc.collect()
    assert [reference() for reference in kept] == [None, None]


def test_shares_make_the_tables_of_the_whole(tmp_path):
    for share in ("1/2", "2/2"):
        part = campaign(cart(), tmp_path / "shared", share=share)
    assert "without tables" in repr(part) and "without tables" in part._repr_html_()
    with pytest.raises(rehearse.InvalidInput, match="no tables: the same call without share"):
        part.groups
    events = []
    done = campaign(cart(), tmp_path / "shared", progress=events.append)
    assert [event["kind"] for event in events] == ["campaign"], "a share left a run undone"
    assert files(done) == files(campaign(cart(), tmp_path / "whole"))


def test_functions_are_called_by_one_thread_at_a_time(tmp_path):
    at_once, most, threads = 0, 0, set()

    def counted(states, actions, following):
        nonlocal at_once, most
        at_once += 1
        most = max(most, at_once)
        threads.add(threading.get_ident())
        time.sleep(1e-3)  # lets other threads go on
        at_once -= 1
        return reward(states, actions, following)

    campaign(cart(reward=counted), tmp_path / "out", trials=1)
    assert most == 1 and len(threads) > 1


def test_control_c_stops_it_and_the_same_call_goes_on(tmp_path):
    script = f"""
import sys; sys.path.insert(0, {str(pathlib.Path(__file__).parent)!r})
from robots import cart
import rehearse
rehearse.campaign(cart(), learners="gp-mi", seeds="1-2", trials=2, out={str(tmp_path / "out")!r}, threads=2,
                  set={{"search.race.max_evaluations": 15000}},
                  progress=lambda event: print(event["kind"], event.get("trial"), flush=True))
"""
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    for line in process.stdout:
        if line == "progress 2\n":
            break
    begun = time.monotonic()
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=60)
    assert time.monotonic() - begun < 5
    assert "KeyboardInterrupt: interrupted: the same call goes on" in error and process.returncode != 0
    options = {"search.race.max_evaluations": 15000}
    stopped = rehearse.open_campaign(tmp_path / "out")
    assert stopped.summary["counts"]["unfinished"] >= 1 and len(stopped.trials) < 4
    rest = campaign(cart(), tmp_path / "out", seeds="1-2", set=options)
    assert files(rest) == files(campaign(cart(), tmp_path / "whole", seeds="1-2", set=options))


def test_control_c_is_seen_while_another_thread_has_the_last_run(tmp_path):
    script = f"""
import sys, threading, time; sys.path.insert(0, {str(pathlib.Path(__file__).parent)!r})
from robots import QUICK, cart, reward
import rehearse

def slow_elsewhere(*arguments):
    if threading.current_thread() is not threading.main_thread():
        time.sleep(0.2)
    return reward(*arguments)

rehearse.campaign(cart(reward=slow_elsewhere), learners="gp-mi", seeds="1-2", out={str(tmp_path / "out")!r}, threads=2,
                  set=QUICK, trials=1, progress=lambda event: print(event["kind"], flush=True))
"""
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "campaign\n"
    time.sleep(2)
    begun = time.monotonic()
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=60)
    assert time.monotonic() - begun < 3 and "the same call goes on" in error


def test_an_exception_comes_out_and_the_same_call_goes_on(tmp_path):
    calls = []

    def failing(states, actions, following):
        calls.append(len(states))
        if len(calls) == 300:
            raise ZeroDivisionError("the three hundredth call")
        return reward(states, actions, following)

    robot = cart(reward=failing)
    with pytest.raises(ZeroDivisionError, match="three hundredth"):
        campaign(robot, tmp_path / "out")
    assert not rehearse.open_campaign(tmp_path / "out").summary["complete"]
    assert files(campaign(robot, tmp_path / "out")) == files(campaign(cart(), tmp_path / "never"))


def test_progress_hears_of_it_and_may_stop_it(tmp_path):
    events = []
    campaign(cart(), tmp_path / "whole", progress=events.append)
    assert events[0]["kind"] == "campaign" and events[0]["runs"] == 2 and events[0]["ended"] == 0
    ended = [event for event in events if event["kind"] == "run"]
    assert [event["ended"] for event in ended] == [1, 2] and {event["seed"] for event in ended} == {1, 2}
    assert all(event["failed"] is None and event["trials"] == 2 for event in ended)
    progress = [event for event in events if event["kind"] == "progress"]
    assert progress and {event["run"] for event in progress} <= {event["run"] for event in ended}
    single = []
    rehearse.learn(cart(), "gp-mi", trials=1, out=tmp_path / "run", options=QUICK, progress=single.append)
    of_run = next(event for event in single if event["kind"] == "progress")
    assert set(progress[0]) == {"run", *of_run}

    def stop(event):
        if event["kind"] == "run":
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        campaign(cart(), tmp_path / "out", progress=stop, threads=1)
    assert rehearse.open_campaign(tmp_path / "out").runs["state"].tolist() == ["done", "unfinished"]
    assert files(campaign(cart(), tmp_path / "out")) == files(rehearse.open_campaign(tmp_path / "whole"))


def test_it_shows_how_it_goes(tmp_path, capsys):
    campaign(cart(), tmp_path / "out", progress=rehearse.show, threads=1)
    campaign(cart(), tmp_path / "out", progress=rehearse.show)
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "cart-campaign: 2 runs, 0 done already" and lines[-1] == "cart-campaign: 2 runs, 2 done already"
    assert lines[1].startswith("[1/2] cart-gp-mi-light-1: ") and "best return" in lines[1]


def test_a_run_that_fails_does_not_stop_the_others(tmp_path):
    begun = campaign(cart(), tmp_path / "out", seeds=1)
    (begun.folder / "runs/cart-gp-mi-light-1/spec.toml").write_text("damaged")
    events = []
    done = campaign(cart(), tmp_path / "out", progress=events.append)
    assert done.runs["state"].tolist() == ["failed", "done"] and "spec.toml" in done.runs["reason"][0]
    assert "cannot be used: cart-gp-mi-light-1" in events[0]["notes"][0]
    assert "cart-gp-mi-light-1 failed:" in done._repr_html_() and "1 failed" in repr(done)


def test_one_environment_is_used_by_one_run_at_a_time(tmp_path):
    class Watched(Environment):
        def reset(self, **arguments):
            self.user = threading.get_ident()
            return super().reset(**arguments)

        def step(self, action):
            time.sleep(0.01)  # another run may come here
            assert self.user == threading.get_ident()
            return super().step(action)

    shared = campaign(cart(Watched()), tmp_path / "shared")
    assert files(shared) == files(campaign(cart(Environment), tmp_path / "each"))


def test_what_is_wrong_is_said_and_leaves_no_folder(tmp_path):
    def refused(match, given, error=rehearse.InvalidInput, **keys):
        with pytest.raises(error, match=match):
            campaign(given, tmp_path / "none", **keys)

    refused("did you mean 'gp-mi'", cart(), learners=["gp-m"])
    refused("seeds has 1 twice", cart(), seeds=[1, 1])
    refused("did you mean|unknown option", cart(), set={"hiden": 3})
    refused("trials = 1.5, must be a whole number", cart(), TypeError, trials=1.5)
    refused("^variant = {'name': 'alone'}, must be a list of dictionaries$", cart(), TypeError, variant={"name": "alone"})
    refused(r"^claim = \[3\], must be a list of dictionaries$", cart(), TypeError, claim=[3])
    refused("^set is a list, must be a dictionary$", cart(), TypeError, set=["hidden"])
    refused("learners must be a list of names", cart(), learners=[])
    refused("priors must be a list of names", cart(), priors=[])
    refused("hidden: None must be a text, a number", cart(), set={"hidden": None})
    refused("search.selection = , must be a whole number", cart(), set={"search.selection": ""})
    refused("nan must be a finite number", cart(), set={"plant.mass": float("nan")})
    refused("threads = -1, must be ≥ 0", cart(), threads=-1)
    refused("share = '3/2', must be 'K/N' with K from 1 to N", cart(), share="3/2")
    refused("^progress = 3, must be a function or None$", cart(), TypeError, progress=3)
    refused("unknown option '1'", cart(), set={1: 3})
    refused("^robot = 3, must be a Robot, the name of a built-in one, or a path$", 3, TypeError)
    refused("prior lost changes the start", cart(priors={"lost": rehearse.Model(lambda x, u: np.full_like(x, np.nan))}))
    refused("division", cart(reward=lambda states, actions, following: 1 / 0), ZeroDivisionError)
    with pytest.raises(rehearse.InvalidInput, match="learners is missing"):
        rehearse.campaign(cart(), out=tmp_path / "none")
    with pytest.raises(rehearse.InvalidInput, match="learners is missing: .* taken for a robot's file"):
        rehearse.campaign(EXAMPLE, seeds=1, out=tmp_path / "none")
    with pytest.raises(TypeError, match="robot goes with a campaign's file"):
        campaign(cart(), tmp_path / "none", "pendulum")
    with pytest.raises(FileNotFoundError):
        campaign(tmp_path / "nowhere.toml", tmp_path / "none")
    with pytest.raises(rehearse.InvalidInput, match="is not the folder of a campaign"):
        rehearse.open_campaign(tmp_path)
    assert not (tmp_path / "none").exists()
    done = campaign(cart(), tmp_path / "out", seeds=1, trials=1)
    with pytest.raises(rehearse.InvalidInput, match="was begun with other options of cart-gp-mi-light-1"):
        campaign(cart(), tmp_path / "out", seeds=1, trials=1, set={**QUICK, "search.selection": 11})
    with pytest.raises(rehearse.InvalidInput, match="has no run 'x' .known: cart-gp-mi-light-1"):
        done.run("x")
    with pytest.raises(rehearse.InvalidInput, match=r"the robot is given again, rehearse.open_run\(folder, robot\)"):
        rehearse.open_campaign(done.folder).run("cart-gp-mi-light-1").evaluate(2)
    assert len(rehearse.open_campaign(done.folder, cart()).run("cart-gp-mi-light-1").evaluate(2).returns) == 2
    with pytest.raises(TypeError, match="^robot is 'cart', must be the Robot that the folder began with$"):
        rehearse.open_campaign(done.folder, "cart")
    assert json.loads(files(done)[1])["complete"]


def test_errors_quote_the_keys_that_they_are_about(tmp_path):
    with pytest.raises(rehearse.InvalidInput, match=r"cart-campaign: line \d+, `hiden = 3`: unknown option 'hiden'"):
        campaign(cart(), tmp_path / "out", set={"hiden": 3})
