"""The pieces alone, against NumPy."""

import copy
import pickle
import subprocess
import sys

import numpy as np
import pytest

import rehearse

RNG = np.random.default_rng(7)


def kernel(a, b, lengths, signal):
    d = (a[:, None, :] - b[None, :, :]) / lengths
    return signal**2 * np.exp(-0.5 * (d**2).sum(2))


def data(n=60):
    X = RNG.uniform(-2, 2, (n, 2))
    return X, np.sin(X[:, 0]) + 0.3 * X[:, 1] ** 2 + 0.05 * RNG.normal(size=n)


def test_a_gp_is_that_of_the_textbook():
    X, y = data()
    logs = np.log([0.8, 1.5, 1.2, 0.1])
    gp = rehearse.GaussianProcess().condition(X, y, logs)
    K = kernel(X, X, np.exp(logs[:2]), 1.2) + 0.01 * np.eye(len(X))
    new = RNG.uniform(-2, 2, (20, 2))
    k = kernel(new, X, np.exp(logs[:2]), 1.2)
    mean, std = gp.predict(new, return_std=True)
    np.testing.assert_allclose(mean, k @ np.linalg.solve(K, y), atol=1e-9)
    np.testing.assert_allclose(std**2, 1.44 - np.einsum("ij,ji->i", k, np.linalg.solve(K, k.T)), atol=1e-9)
    evidence = -0.5 * (y @ np.linalg.solve(K, y) + np.linalg.slogdet(K)[1] + len(y) * np.log(2 * np.pi))
    assert gp.log_evidence == pytest.approx(evidence, abs=1e-8)


@pytest.mark.parametrize("trend", [[], np.log([0.4, 0.2, 0.3])])
def test_a_gp_knows_how_its_values_go_together(trend):
    X, y = data()
    logs = np.concatenate([np.log([0.8, 1.5, 1.2, 0.1]), trend])
    gp = rehearse.GaussianProcess().condition(X, y, logs)
    new = RNG.uniform(-3, 3, (20, 2))
    mean, cov = gp.predict(new, return_cov=True)
    _, std = gp.predict(new, return_std=True)
    np.testing.assert_array_equal(mean, gp.predict(new))
    np.testing.assert_allclose(np.diag(cov), std**2, atol=1e-9)
    np.testing.assert_allclose(cov, cov.T, atol=1e-12)
    # A measurement at the first row takes so much of the variance of the others.
    more = rehearse.GaussianProcess().condition(np.vstack([X, new[:1]]), np.append(y, 0), logs)
    left = std**2 - cov[0] ** 2 / (std[0] ** 2 + 0.01)
    np.testing.assert_allclose(more.predict(new, return_std=True)[1] ** 2, left, atol=1e-9)
    both = rehearse.GaussianProcess().condition(X, np.column_stack([y, y]), [logs, logs + 0.1])
    means, covs = both.predict(new, return_cov=True)
    assert means.shape == (20, 2) and covs.shape == (20, 20, 2)
    np.testing.assert_array_equal(covs[..., 0], cov)
    with pytest.raises(rehearse.InvalidInput, match="only one of them"):
        gp.predict(new, return_std=True, return_cov=True)
    with pytest.raises(rehearse.InvalidInput, match="must have 2"):
        gp.predict(new[:, :1], return_cov=True)


def test_measurements_that_repeat_have_a_covariance():
    X = np.repeat([[-2.0], [0.0], [2.0]], 3, axis=0)
    gp = rehearse.GaussianProcess().condition(X, np.sin(X[:, 0]), np.log([0.5, 3.0, 1e-9]))
    new = np.linspace(-3, 3, 13)[:, None]
    _, std = gp.predict(new, return_std=True)
    _, cov = gp.predict(new, return_cov=True)
    np.testing.assert_allclose(np.diag(cov), std**2, atol=1e-8)


def test_a_fit_finds_noise_and_beats_a_guess():
    X, y = data(150)
    gp = rehearse.GaussianProcess().fit(X, y)
    assert gp.noise == pytest.approx(0.05, rel=0.4)
    assert gp.log_evidence > rehearse.GaussianProcess().condition(X, y, np.log([1, 1, 1, 0.2])).log_evidence
    both = rehearse.GaussianProcess(starts=1).fit(X, np.column_stack([y, 2 * y]))
    assert both.predict(X).shape == (150, 2) and both.lengths.shape == (2, 2)
    with pytest.raises(rehearse.InvalidInput, match="150 rows and y 3"):
        rehearse.GaussianProcess().fit(X, y[:3])
    with pytest.raises(rehearse.InvalidInput, match="must have 2"):
        gp.predict(X[:, :1])
    with pytest.raises(rehearse.InvalidInput, match="did you mean 'starts'"):
        rehearse.GaussianProcess(start=1).fit(X, y)
    with pytest.raises(rehearse.InvalidInput, match="no data yet"):
        rehearse.GaussianProcess().predict(X)


def test_a_gp_scores_and_is_copied():
    X, y = data()
    gp = rehearse.GaussianProcess(trend=True, starts=1).fit(X, y)
    X_new, y_new = data()
    expected = 1 - ((gp.predict(X_new) - y_new) ** 2).sum() / ((y_new - y_new.mean()) ** 2).sum()
    assert gp.score(X_new, y_new) == pytest.approx(expected, abs=1e-12)
    assert gp.score(X_new, y_new) > 0.9
    with pytest.raises(rehearse.InvalidInput, match="must be 60 × 1"):
        gp.score(X_new, y_new[:5])
    assert gp.score(X_new, np.zeros(60)) == 0 and gp.score(X_new[:1], gp.predict(X_new[:1])) == 1
    X[:] = 0  # the data are its own
    loaded = pickle.loads(pickle.dumps(gp))
    np.testing.assert_array_equal(loaded.predict(X_new, return_std=True), gp.predict(X_new, return_std=True))
    assert loaded.log_evidence == gp.log_evidence
    assert pickle.loads(pickle.dumps(rehearse.GaussianProcess(starts=2))).options == {"starts": 2}


def test_a_copy_of_a_gp_has_the_tolerance_of_its_data():
    X, logs = np.linspace(-2, 2, 200), np.log([1.5, 1, 0.2])
    gp, exact = (rehearse.GaussianProcess(tolerance=most).condition(X, np.sin(X), logs) for most in (0.1, 0))
    before = gp.predict(X, return_std=True)
    assert (exact.predict(X, return_std=True)[1] != before[1]).any(), "the tolerance matters"
    gp.set_params(tolerance=0)
    for again in (copy.copy(gp), copy.deepcopy(gp), pickle.loads(pickle.dumps(gp))):
        np.testing.assert_array_equal(again.predict(X, return_std=True), before)


def test_a_gp_has_the_manners_of_scikit_learn():
    gp = rehearse.GaussianProcess(trend=True, starts=1)
    assert gp.get_params() == {"trend": True, "tolerance": 0.0, "threads": 0, "starts": 1}
    assert repr(gp) == "GaussianProcess(trend=True, starts=1)" and repr(rehearse.GaussianProcess()) == "GaussianProcess()"
    assert not hasattr(gp, "n_features_in_")
    assert gp.set_params(trend=False, starts=2) is gp and gp.get_params()["starts"] == 2 and not gp.trend
    with pytest.raises(rehearse.InvalidInput, match="tolerance"):
        gp.set_params(tolerance=-1)
    with pytest.raises(TypeError, match="trend = 'no', must be True or False"):
        rehearse.GaussianProcess(trend="no")
    with pytest.raises(rehearse.InvalidInput, match="did you mean 'tolerance'"):
        rehearse.GaussianProcess(tolerence=0.1).fit(*data(20))
    assert gp.fit(*data(20)).n_features_in_ == 2
    sklearn = pytest.importorskip("sklearn.base")
    assert sklearn.clone(gp).get_params() == gp.get_params()


def test_what_a_gp_refuses_leaves_it_as_it_was():
    X, y = data()
    gp = rehearse.GaussianProcess().condition(X, y, np.log([0.8, 1.5, 1.2, 0.1]))
    before, lengths = gp.predict(X, return_cov=True)[1], gp.lengths
    with pytest.raises(rehearse.InvalidInput, match="60 rows and y 3"):
        gp.fit(np.hstack([X, X]), np.zeros((3, 2)))
    with pytest.raises(rehearse.InvalidInput, match="must have one an output"):
        gp.condition(X[:, :1], np.column_stack([y, y]), np.log([[0.8, 1.2, 0.1]]))
    np.testing.assert_array_equal(gp.predict(X, return_cov=True)[1], before)
    np.testing.assert_array_equal(gp.lengths, lengths)
    assert isinstance(gp.log_evidence, float)
    with pytest.raises(rehearse.InvalidInput, match="y has no columns"):
        gp.condition(np.zeros((3, 1)), np.zeros((3, 0)), np.zeros((0, 3)))
    with pytest.raises(rehearse.InvalidInput, match="y has no columns"):
        gp.fit(np.zeros((3, 1)), np.zeros((3, 0)))


def test_moments_are_those_of_samples():
    X, y = data()
    gp = rehearse.GaussianProcess().condition(X, y, np.log([0.8, 1.5, 1.2, 0.1]))
    m, S = np.array([0.3, -0.5]), np.array([[0.05, 0.01], [0.01, 0.02]])
    mean, covariance, with_input = gp.match_moments(m, S)
    x = RNG.multivariate_normal(m, S, 200_000)
    f, std = gp.predict(x, return_std=True)
    assert mean[0] == pytest.approx(f.mean(), abs=3e-3)
    assert covariance[0, 0] == pytest.approx(f.var() + (std**2).mean(), rel=0.02)
    np.testing.assert_allclose(with_input[:, 0], np.cov(np.column_stack([x, f]).T)[:2, 2], atol=1e-3)
    np.testing.assert_array_equal(gp.match_moments(m[:, None], S)[0], mean)
    with pytest.raises(rehearse.InvalidInput, match="must be positive semi-definite"):
        gp.match_moments(m, -S)
    with pytest.raises(rehearse.InvalidInput, match="must be finite and symmetric"):
        gp.match_moments(m, [[0.05, 0.04], [0.01, 0.02]])
    with pytest.raises(rehearse.InvalidInput, match=r"must have \(2,\) and \(2, 2\)"):
        gp.match_moments(m, S[:1])


def test_moments_take_all_points():
    X = np.linspace(-2, 2, 200)[:, None]
    few = rehearse.GaussianProcess(tolerance=0.1).condition(X, np.sin(X[:, 0]), np.log([1.5, 1, 0.2]))
    with pytest.raises(rehearse.InvalidInput, match="tolerance must be 0"):
        few.match_moments([0.0], [[0.1]])


def test_cmaes_finds_the_top_of_a_ridge():
    search = rehearse.Cmaes([3.0, -2.0, 1.0], 0.5, seed=3)
    while not search.stop:
        x = search.ask()
        assert x.shape == (search.ask().shape[0], 3)
        search.tell(-(100 * (x[:, 1] - x[:, 0] ** 2) ** 2 + (1 - x[:, 0]) ** 2 + x[:, 2] ** 2))
    np.testing.assert_allclose(search.best_x, [1, 1, 0], atol=1e-4)
    inside = rehearse.Cmaes([0.5], 0.3, bounds=[(0, 1)], population=8)
    assert inside.population == 8
    for _ in range(20):
        x = inside.ask()
        assert (x >= 0).all() and (x <= 1).all() and len(x) == 8
        inside.tell(x[:, 0])
    assert inside.best_x[0] == pytest.approx(1.0)
    with pytest.raises(rehearse.InvalidInput, match="one a candidate"):
        inside.tell([1.0])
    with pytest.raises(rehearse.InvalidInput, match="did you mean 'population'"):
        rehearse.Cmaes([0.5], 0.3, populatoin=8)
    with pytest.raises(rehearse.InvalidInput, match="^bounds has 1 pairs, must have 2, one for each number of mean"):
        rehearse.Cmaes([0.5, 0.5], 0.3, [(0, 1)])
    with pytest.raises(rehearse.InvalidInput, match=r"^mean\[1\] = 5, must be between 0 and 1"):
        rehearse.Cmaes([0.5, 5], 0.3, [(0, 1), (0, 1)])
    with pytest.raises(rehearse.InvalidInput, match="did you mean 'max_evaluations'"):
        rehearse.Cmaes([0.5], 0.3, max_evaluation=8)
    with pytest.raises(rehearse.InvalidInput, match="max_evaluations = 0, must be ≥ 1"):
        rehearse.Cmaes([0.5], 0.3, max_evaluations=0)
    short = rehearse.Cmaes([3.0, -2.0, 1.0], 0.5, max_evaluations=50, population=8)
    while not short.stop:
        short.tell(-np.sum(short.ask() ** 2, axis=1))
    assert short.evaluations == 56 and short.stop == "50 evaluations"


def test_map_elites_fill_their_niches():
    search = rehearse.MapElites([(-1, 1)] * 3, [(-1, 1)] * 2, bins=[10, 10], batch=64, initial=128, seed=2)
    for _ in range(60):
        x = search.ask()
        search.tell(-(x[:, 2] ** 2), x[:, :2])
    elites, statistics = search.elites, search.statistics(floor=-1)
    assert statistics["filled"] == len(elites["performances"]) > 80
    assert np.unique(elites["niches"]).size == len(elites["niches"])
    assert elites["performances"].max() > -1e-3
    np.testing.assert_array_equal(elites["solutions"][:, :2], elites["descriptors"])
    with pytest.raises(rehearse.InvalidInput, match="must be"):
        search.tell([0.0], [[0.0, 0.0]])
    voronoi = rehearse.MapElites([(-1, 1)] * 3, [(-1, 1)] * 2, niches=50, batch=64, initial=64)
    x = voronoi.ask()
    voronoi.tell(x[:, 2], x[:, :2])
    assert voronoi.statistics()["coverage"] > 0.5


def test_one_input_may_be_numbers_alone():
    X = np.linspace(-2, 2, 20)
    gp = rehearse.GaussianProcess().condition(X, np.sin(X), np.log([0.8, 1.2, 0.1]))
    column = rehearse.GaussianProcess().condition(X[:, None], np.sin(X), np.log([0.8, 1.2, 0.1]))
    for asked in ({}, {"return_std": True}, {"return_cov": True}):
        for one, other in zip(gp.predict(X[:5], **asked), column.predict(X[:5, None], **asked)):
            np.testing.assert_array_equal(one, other)
    assert gp.score(X, np.sin(X)) == column.score(X[:, None], np.sin(X)) > 0.99
    assert rehearse.GaussianProcess(starts=1).fit(X, np.sin(X)).predict(X).shape == (20,)
    for wrong in (0.5, np.zeros((2, 2, 1))):
        with pytest.raises(rehearse.InvalidInput, match="dimensions, must be n × D, or n numbers where D = 1"):
            gp.predict(wrong)


def test_what_pieces_cannot_use_is_refused_by_name():
    for tolerance in (-1, np.nan, np.inf):
        with pytest.raises(rehearse.InvalidInput, match=f"tolerance = {tolerance}, must be finite and ≥ 0"):
            rehearse.GaussianProcess(tolerance=tolerance)
    with pytest.raises(rehearse.InvalidInput, match="seed = -1, must be ≥ 0"):
        rehearse.Cmaes([0.5], 0.3, seed=-1)
    with pytest.raises(TypeError, match="bins = 3.5, must be a whole number"):
        rehearse.MapElites([(0, 1)], [(0, 1)], bins=[3.5])
    with pytest.raises(rehearse.InvalidInput, match="bins is empty, must be a number for each descriptor"):
        rehearse.MapElites([(0, 1)], [(0, 1)], bins=[])
    with pytest.raises(rehearse.InvalidInput, match="niches and bins: only one of them at a time"):
        rehearse.MapElites([(0, 1)], [(0, 1)], bins=[3], niches=7)
    with pytest.raises(TypeError, match="seed = True, must be a whole number"):
        rehearse.Cmaes([0.5], 0.3, seed=True)
    with pytest.raises(rehearse.InvalidInput, match=r"bounds is an array of shape \(2,\), must be n × 2"):
        rehearse.Cmaes([0.5], 0.3, bounds=(0, 1))


def test_data_that_are_no_numbers_are_refused_by_name():
    X, y = data(10)
    gp, search = rehearse.GaussianProcess(starts=1), rehearse.Cmaes([0.5], 0.3, population=4)
    archive = rehearse.MapElites([(0, 1)], [(0, 1)], bins=[3], initial=4, batch=4)
    for wrong, message in (((np.zeros((0, 2)), []), "^X has no rows, must have one or more$"),
                           ((X, np.where(np.arange(10) == 3, np.nan, y)), "^y has nan in row 3, must be finite$"),
                           ((np.ma.masked_array(X, X == X[4]), y), "^X has nan in row 4, must be finite$"),
                           ((X, y.reshape(-1, 1, 1)), "^y has 3 dimensions, must be n, or n × E$"),
                           ((X + 1j, y), "^X has complex numbers, must have real ones$")):
        with pytest.raises(rehearse.InvalidInput, match=message):
            gp.fit(*wrong)
        with pytest.raises(rehearse.InvalidInput, match=message):
            gp.condition(*wrong, np.zeros((1, 4)))
    with pytest.raises(rehearse.InvalidInput, match="^log_hyperparameters has 3 dimensions"):
        gp.condition(X, y, np.zeros((1, 1, 4)))
    with pytest.raises(rehearse.InvalidInput, match="^y has no rows"):
        gp.condition(X, y, np.zeros((1, 4))).score(np.zeros((0, X.shape[1])), [])
    with pytest.raises(rehearse.InvalidInput, match="^descriptors has 3 dimensions"):
        archive.tell(np.zeros(4), np.zeros((4, 1, 1)))
    for tell in (lambda: search.tell(np.zeros(4) + 1j), lambda: archive.tell(np.zeros(4), np.zeros((4, 1)) + 1j)):
        with pytest.raises(rehearse.InvalidInput, match="has complex numbers"):
            tell()
    x = search.ask()
    search.tell(np.ma.masked_array([4.0, 3.0, 2.0, 1.0], mask=[True, False, False, False]))
    np.testing.assert_array_equal(search.best_x, x[1])


def test_bounds_may_be_arrays():
    bounds = np.array([[0.0, 1.0], [0.0, 2.0]])
    x = rehearse.Cmaes([0.5, 0.5], 0.3, bounds=bounds, seed=4).ask()
    np.testing.assert_array_equal(x, rehearse.Cmaes([0.5, 0.5], 0.3, bounds=[(0, 1), (0, 2)], seed=4).ask())
    search = rehearse.MapElites(bounds, bounds[:1], bins=np.array([3]))
    assert search.elites["niches"].dtype == np.int64 and len(search.elites["niches"]) == 0
    assert search.ask().max() > 1


@pytest.mark.parametrize("work", [
    "X = rng.normal(size=(1500, 6)); rehearse.GaussianProcess(threads=1, part_rows=0).fit(X, np.sin(X[:, 0]))",
    "rehearse.MapElites([(0, 1)], [(0, 1)] * 6, niches=50_000)",
])
def test_control_c_stops_a_piece(work):
    script = f"""
import os, signal, threading, time
import numpy as np, rehearse
rng = np.random.default_rng(0)
threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
begun = time.monotonic()
try:
    {work}
except KeyboardInterrupt:
    print(time.monotonic() - begun)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120)
    assert float(done.stdout) < 10, done.stderr
