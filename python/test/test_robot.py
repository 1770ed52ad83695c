"""Robots as Python describes them: names, environments, and several runs of one."""

from robots import QUICK, cart

import rehearse


def learn(robot, out, **more):
    return rehearse.learn(robot, out=out, **{"trials": 1, "threads": 2, "progress": None, "options": QUICK, **more})


def test_a_limit_may_have_the_name_of_the_reward(tmp_path):
    def near(states, actions, following):
        return following[:, 1] < 100

    runs = [learn(cart(limits=[rehearse.Limit(near, name=name)]), tmp_path / name) for name in ("near", "reward")]
    assert runs[0].trials["return"][0] == runs[1].trials["return"][0]
    assert runs[1].details[0].limits[0]["name"] == "reward" and not runs[1].details[0].limits[0]["broken"]
