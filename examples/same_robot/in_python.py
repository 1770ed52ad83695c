"""The pendulum of docs/same-robot.md in Python: in_python.py [OUT] learns it in at most two trials."""
import sys

import rehearse

rates = {"dtheta": "(u - 0.01 * dtheta - m * 9.82 * l / 2 * sin(theta)) / (m * l^2 / 3)"}

robot = rehearse.Robot(
    "pendulum-python",
    dt_s=0.1,
    horizon=40,
    states=[
        rehearse.State("dtheta", "rad/s", scale=10),
        rehearse.State("theta", "rad", angle=True, rate="dtheta"),
    ],
    actions=[rehearse.Action("u", (-2.5, 2.5), "N m")],
    reward=rehearse.Distance(["1 + cos(theta)", "sin(theta)"], width=0.5),
    success=rehearse.Success("-cos(theta) > cos(10 * pi / 180)", last_s=0.5),
    plant=rehearse.Model(rates=rates, parameters={"m": 1, "l": 1}),
    priors={
        "useful": rehearse.Model(rates=rates, parameters={"m": 1.3, "l": 0.8}, tune={"m": (0.05, 2), "l": (0.05, 2)}),
    },
)

if __name__ == "__main__":
    out = sys.argv[1] if len(sys.argv) > 1 else "runs/pendulum-python"
    print(rehearse.learn(robot, learner="gp-mi", trials=2, until_solved=True, out=out).trials)
