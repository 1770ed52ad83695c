"""identify_coverage.py [SEEDS]: how often the 95 % intervals of `identify` hold the truth, and how wide they are. An arm of one
joint is simulated under random torques, with noise; its inertia J and damping b are identified. Errors are in standard deviations
as the intervals have them, so their root mean square is 1 where intervals are as wide as 95 % needs, and less where they are
wider."""

import sys

import numpy as np

import rehearse

DT, STEPS, TRUTH = 0.05, 160, {"J": 1.0, "b": 0.4}
OPTIONS = {"beyond": "nothing", "every_s": 2, "particles": 5}  # forecasts are of no interest here

#: Noise of the angle [rad] and of the speed [rad/s], logs of 8 s, dry friction that the prior does not have [N m].
SETTINGS = [(0.003, 0.01, 3, 0.0), (0.003, 0.01, 1, 0.0), (0.02, 0.1, 3, 0.0), (0.003, 0.01, 3, 0.1), (0.003, 0.01, 3, 0.3)]


def robot():
    arm = rehearse.Model(rates={"w": "(u - b*w - 2*sin(q))/J"}, parameters={"J": 0.5, "b": 0.1}, tune={"J": (0.1, 3), "b": (0, 2)})
    return rehearse.Robot("arm", dt_s=DT, horizon=40, states=[rehearse.State("w", "rad/s"), rehearse.State("q", "rad", rate="w", angle=True)],
                          actions=[rehearse.Action("u", (-3, 3), "N m")], reward="-q^2", priors={"arm": arm})


def log(random, noise, speed_noise, dry):
    torques = np.repeat(random.uniform(-3, 3, STEPS // 5), 5)
    state, rows, substeps = np.zeros(2), [], 50
    for torque in [*torques, 0.0]:
        rows.append(state + random.normal(0, [speed_noise, noise]))
        for _ in range(substeps):
            w, q = state
            moment = torque - TRUTH["b"] * w - dry * np.tanh(w / 0.02) - 2 * np.sin(q)
            w += DT / substeps * moment / TRUTH["J"]
            state = np.array([w, q + DT / substeps * w])
    measured = np.array(rows)
    return {"time": np.arange(STEPS + 1) * DT, "w": measured[:, 0], "q": measured[:, 1], "u": torques}


def main(seeds):
    print("noise, speed noise, logs, dry friction: parameter, of how many intervals hold the truth, rms error, median width")
    for noise, speed_noise, logs, dry in SETTINGS:
        errors, widths = [], []
        for seed in range(1, seeds + 1):
            random = np.random.default_rng(seed)
            found = rehearse.identify(robot(), [log(random, noise, speed_noise, dry) for _ in range(logs)], options=OPTIONS, threads=1)
            width = found.parameters["high"] - found.parameters["low"]
            errors.append((found.parameters["value"] - list(TRUTH.values())) / (width / (2 * 1.96)))
            widths.append(width)
        for i, name in enumerate(TRUTH if dry == 0 else ["J"]):  # no b is that of dry friction
            of = np.array(errors)[:, i]
            print(f"{noise:g} {speed_noise:g} {logs} {dry:g}: {name} {np.count_nonzero(abs(of) < 1.96)} of {seeds}, "
                  f"{np.sqrt(np.mean(of**2)):.2f}, {np.median(np.array(widths)[:, i]):.3g}", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 30)
