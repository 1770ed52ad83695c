"""One robot, one thread, one object: what is used twice at once."""

import gc
import threading
import weakref

import numpy as np
import pytest
from robots import QUICK, cart, reward

import rehearse


def learn(robot, out, **more):
    return rehearse.learn(robot, out=out, **{"trials": 1, "threads": 1, "progress": None, "options": QUICK, **more})


def test_a_function_of_a_robot_begins_no_other_work(tmp_path):
    def nested(states, actions, following):
        learn("pendulum", tmp_path / "inner")
        return reward(states, actions, following)

    with pytest.raises(rehearse.InvalidInput, match="a function of a robot may not begin work on robots"):
        learn(cart(reward=nested), tmp_path / "out")
    assert not (tmp_path / "inner").exists()


def test_progress_may_begin_other_work(tmp_path):
    def listen(event):
        if event["kind"] == "trial":
            learn(cart(), tmp_path / "inner")

    learn(cart(), tmp_path / "out", progress=listen)
    assert (tmp_path / "inner" / "trials.csv").read_bytes() == (tmp_path / "out" / "trials.csv").read_bytes()


def test_a_run_goes_on_with_the_robot_of_its_name_alone(tmp_path):
    run = learn(cart(), tmp_path / "cart")
    before = (run.folder / "trials.csv").read_bytes()
    boat = rehearse.Robot("boat", dt_s=0.1, horizon=7, states=[rehearse.State("v"), rehearse.State("x", rate="v", start=1.0)],
                          actions=[rehearse.Action("f", (-1, 1))], reward=reward, policy={"policy": "linear"},
                          plant=rehearse.Model(lambda states, actions: -0.3 * states))
    other = "is a run of the robot 'cart', the one that is given is 'boat'"
    with pytest.raises(rehearse.InvalidInput, match=other):
        rehearse.resume(run.folder, boat, 2, progress=None)
    opened = rehearse.open_run(run.folder, boat)
    for use in (opened.evaluate, opened.ask, opened.policy):
        with pytest.raises(rehearse.InvalidInput, match=other):
            use()
    assert (run.folder / "trials.csv").read_bytes() == before


class Owner:
    """A robot whose reward holds whoever holds the robot."""

    def __init__(self):
        self.robot = cart(reward=self.reward)

    def reward(self, states, actions, following):
        return reward(states, actions, following)


def test_a_robot_goes_with_its_owner(tmp_path):
    owner = Owner()
    learn(owner.robot, tmp_path / "out")
    gone = weakref.ref(owner)
    del owner
    gc.collect()
    assert gone() is None


@pytest.mark.parametrize("make, told", [
    (lambda: rehearse.MapElites([(-1, 1)] * 10, [(0, 1)] * 2, bins=[20, 20], batch=200, initial=200),
     lambda x: (x.sum(axis=1), np.abs(x[:, :2]))),
    (lambda: rehearse.Cmaes(np.zeros(10), 0.5, population=200), lambda x: (-np.sum(x**2, axis=1),)),
])
def test_threads_may_share_a_search(make, told):
    search = make()

    def loop():
        for _ in range(50):
            try:
                search.tell(*told(search.ask()))
            except rehearse.InvalidInput:  # another thread told before
                pass

    threads = [threading.Thread(target=loop) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert search.evaluations >= 200


def test_threads_may_share_a_robot(tmp_path):
    robot = cart()
    threads = [threading.Thread(target=learn, args=(robot, tmp_path / str(i))) for i in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len({(tmp_path / str(i) / "trials.csv").read_bytes() for i in range(3)}) == 1
