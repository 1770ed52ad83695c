"""Gaussian processes alone."""

from __future__ import annotations

import math
from typing import Any, Literal, Union, overload

import numpy as np
import numpy.typing as npt

from . import _core
from .arrays import Array
from .checks import not_negative, numbers, option_text, threads_of, truth


class GaussianProcess:
    """GP regression with a squared exponential kernel, a length an input, and noise.

    `fit` maximises the evidence (Rasmussen 2006, eq. 5.8), from several starts; several outputs are independent GPs. The
    mean before data is 0: subtract that of y, where it is far from it.
    trend: adds a quadratic trend, which goes on where there are no data. tolerance: predictions from fewer points, with
    errors up to this fraction of the noise; 0: exact. options: as of `model.gp.fit`, {"starts": 1}. Where there is one
    input, X may be n numbers instead of n × 1. Ctrl-C stops a fit.
    """

    def __init__(self, *, trend: bool = False, tolerance: float = 0.0, threads: int = 0, **options: Any) -> None:
        self.trend = truth("trend", trend)
        self.tolerance = not_negative("tolerance", tolerance)
        self.threads = threads_of(threads)
        self.options = options
        self._core: Union[_core.FittedGp, None] = None
        self._data: tuple[Array, Array] = (np.empty((0, 0)), np.empty((0, 0)))
        self._one, self._inputs = True, 0
        self._tolerance_of_data = 0.0  # `tolerance` is that of the next fit

    def get_params(self, deep: bool = True) -> dict[str, Any]:
        """The arguments, as scikit-learn has them."""
        return {"trend": self.trend, "tolerance": self.tolerance, "threads": self.threads, **self.options}

    def set_params(self, **arguments: Any) -> GaussianProcess:
        """Other arguments, for the next fit."""
        other = GaussianProcess(**{**self.get_params(), **arguments})
        self.trend, self.tolerance, self.threads = other.trend, other.tolerance, other.threads
        self.options = other.options
        return self

    def __repr__(self) -> str:
        known = GaussianProcess().get_params()
        given = ", ".join(f"{name}={value!r}" for name, value in self.get_params().items() if value != known.get(name))
        return f"GaussianProcess({given})"

    @property
    def n_features_in_(self) -> int:
        """The inputs, D, once there are data; as scikit-learn has it."""
        if self._core is None:
            raise AttributeError("n_features_in_: the GP has no data yet")
        return self._inputs

    def fit(self, X: npt.ArrayLike, y: npt.ArrayLike) -> GaussianProcess:
        """X: n × D inputs; y: n targets, or n × E."""
        X, Y, one = _arrays(X, y)
        options = {name: option_text(value) for name, value in self.options.items()}
        return self._knowing(_core.fit_gp(X, Y, self.trend, self.tolerance, options, self.threads), X, Y, one)

    def condition(self, X: npt.ArrayLike, y: npt.ArrayLike, log_hyperparameters: npt.ArrayLike) -> GaussianProcess:
        """The same without a fit: E × (D + 2) logarithms of lengths, σ_f and σ_n."""
        X, Y, one = _arrays(X, y)
        logs = np.atleast_2d(numbers("log_hyperparameters", log_hyperparameters))
        if logs.ndim > 2:
            raise _core.InvalidInput(f"log_hyperparameters has {logs.ndim} dimensions, must be E × (D + 2)")
        return self._knowing(_core.condition_gp(X, Y, logs, self.tolerance), X, Y, one)

    @overload
    def predict(self, X: npt.ArrayLike, return_std: Literal[False] = False,
                return_cov: Literal[False] = False) -> Array: ...
    @overload
    def predict(self, X: npt.ArrayLike, return_std: Literal[True],
                return_cov: Literal[False] = False) -> tuple[Array, Array]: ...
    @overload
    def predict(self, X: npt.ArrayLike, return_std: Literal[False] = False, *,
                return_cov: Literal[True]) -> tuple[Array, Array]: ...
    def predict(self, X: npt.ArrayLike, return_std: bool = False, return_cov: bool = False) -> Any:
        """Means (n, or n × E) at X (n × D), and what is asked for of the function, without noise: its standard deviations
        (as the means), or its covariance over the rows of X (n × n, or n × n × E), as scikit-learn has them. The covariance
        is exact, whatever the tolerance."""
        inputs = _inputs(X)
        if return_std and return_cov:
            raise _core.InvalidInput("return_std and return_cov: only one of them at a time")
        if return_cov:
            mean = self._fitted.predict_mean(inputs)
            covariances = [self._covariance(inputs, logs, jitter)
                           for logs, jitter in zip(self.log_hyperparameters, self._fitted.jitters)]
            return self._shaped(mean), covariances[0] if self._one else np.stack(covariances, axis=-1)
        if not return_std:
            return self._shaped(self._fitted.predict_mean(inputs))
        mean, variance = self._fitted.predict(inputs)
        return self._shaped(mean), self._shaped(np.sqrt(variance))

    def score(self, X: npt.ArrayLike, y: npt.ArrayLike) -> float:
        """R² of the predicted means, 1 at best, as scikit-learn has it: of several outputs the mean. Targets that are all
        the same have 1 where they are predicted exactly, else 0."""
        targets, _ = _targets(y)
        if len(targets) == 0:
            raise _core.InvalidInput("y has no rows, must have one or more")
        means = self._fitted.predict_mean(_inputs(X))
        if targets.shape != means.shape:
            raise _core.InvalidInput(f"y is {targets.shape[0]} × {targets.shape[1]}, must be {means.shape[0]} × "
                                     f"{means.shape[1]}")
        residual = ((targets - means) ** 2).sum(axis=0)
        spread = ((targets - targets.mean(axis=0)) ** 2).sum(axis=0)
        same = spread == 0
        return float(np.mean(np.where(same, residual == 0, 1 - residual / np.where(same, 1, spread))))

    def __getstate__(self) -> dict[str, Any]:
        """For pickle and copy: the data and the hyperparameters; what loads it predicts the same bytes."""
        logs = None if self._core is None else self.log_hyperparameters
        return {**self.__dict__, "_core": logs}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update({"_tolerance_of_data": state["tolerance"], **state})  # older pickles have one tolerance
        logs, self._core = state["_core"], None
        if logs is not None:
            self._core = _core.condition_gp(*self._data, logs, self._tolerance_of_data)

    def match_moments(self, mean: npt.ArrayLike, covariance: npt.ArrayLike) -> tuple[Array, Array, Array]:
        """Mean (E) and covariance (E × E) of the function's values for an input N(mean (D), covariance (D × D)), and
        their covariance with the input (D × E), in closed form (Deisenroth 2011). Not with a trend or a tolerance."""
        m, S = np.asarray(mean, float).reshape(-1), np.atleast_2d(np.asarray(covariance, float))
        fitted, inputs = self._fitted, self._inputs
        if m.shape != (inputs,) or S.shape != (inputs, inputs):
            raise _core.InvalidInput(f"mean and covariance have the shapes {m.shape} and {S.shape}, must have "
                                     f"{(inputs,)} and {(inputs, inputs)}")
        if not np.isfinite(S).all() or (np.abs(S - S.T) > 1e-9 * np.abs(S).max()).any():
            raise _core.InvalidInput("covariance must be finite and symmetric")
        S = (S + S.T) / 2
        if np.linalg.eigvalsh(S).min() < -1e-9 * np.abs(S).max():
            raise _core.InvalidInput("covariance must be positive semi-definite")
        return fitted.match_moments(m, S)

    @property
    def log_evidence(self) -> Union[float, Array]:
        """Nats; one an output."""
        evidence = self._fitted.log_evidence
        return float(evidence[0]) if self._one else evidence

    @property
    def log_hyperparameters(self) -> Array:
        """E × (D + 2): logarithms of lengths, σ_f, σ_n; with a trend E × (2 D + 3)."""
        return self._fitted.log_hyperparameters

    @property
    def lengths(self) -> Array:
        """Length scales of the inputs: D, or E × D."""
        lengths: Array = self._per_output(np.exp(self.log_hyperparameters[:, : self._inputs]))
        return lengths

    @property
    def signal(self) -> Any:
        """Standard deviation of the function, σ_f."""
        return self._per_output(np.exp(self.log_hyperparameters[:, self._inputs]))

    @property
    def noise(self) -> Any:
        """Standard deviation of the noise, σ_n."""
        return self._per_output(np.exp(self.log_hyperparameters[:, self._inputs + 1]))

    def _knowing(self, core: _core.FittedGp, X: Array, Y: Array, one: bool) -> GaussianProcess:
        """Takes what C++ has made of the data; where it refused them, the GP is as before."""
        self._core, self._data, self._one, self._inputs = core, (X, Y), one, X.shape[1]
        self._tolerance_of_data = self.tolerance
        return self

    @property
    def _fitted(self) -> _core.FittedGp:
        if self._core is None:
            raise _core.InvalidInput("the GP has no data yet: fit(X, y)")
        return self._core

    def _covariance(self, X: Array, logs: Array, jitter: float) -> Array:
        """The covariance of one output (Rasmussen 2006, eq. 2.24). jitter: times σ_f², what C++ had to add to that of the
        data."""
        lengths, signal, noise, trend = np.split(np.exp(logs), [self._inputs, self._inputs + 1, self._inputs + 2])

        def kernel(A: Array, B: Array) -> Array:
            squares = sum(((a[:, None] - b) / length) ** 2 for a, b, length in zip(A.T, B.T, lengths))
            values: Array = signal**2 * np.exp(-0.5 * squares)
            if len(trend):
                values = values + (trend[0] ** 2 + A @ np.diag(trend[1:] ** 2) @ B.T) ** 2
            return values

        data = self._data[0]
        factor = _factor(kernel(data, data) + noise**2 * np.eye(len(data)), float(signal[0] ** 2), jitter)
        known = np.linalg.solve(factor, kernel(data, X))
        covariance: Array = kernel(X, X) - known.T @ known
        return covariance

    def _shaped(self, values: Array) -> Array:
        shaped: Array = values[:, 0] if self._one else values
        return shaped

    def _per_output(self, values: Array) -> Any:
        return values[0] if self._one else values


def _factor(covariance: Array, scale: float, jitter: float) -> Array:
    """Its Cholesky factor with this jitter times the scale, or more where NumPy, which rounds otherwise, needs it."""
    for more in (jitter, *(rung for rung in (1e-10, 1e-8, 1e-6) if rung > jitter)):
        try:
            factor: Array = np.linalg.cholesky(covariance + more * scale * np.eye(len(covariance)))
            return factor
        except np.linalg.LinAlgError:
            continue
    raise _core.InvalidInput("the hyperparameters are too extreme for a covariance")


def _inputs(X: npt.ArrayLike) -> Array:
    """n × D, a copy; n numbers are n × 1."""
    inputs = numbers("X", X)
    if inputs.ndim == 1:
        return inputs[:, None]
    if inputs.ndim != 2:
        raise _core.InvalidInput(f"X has {inputs.ndim} dimensions, must be n × D, or n numbers where D = 1")
    return inputs


def _targets(y: npt.ArrayLike) -> tuple[Array, bool]:
    """n × E, a copy, and whether y is of one output."""
    targets = numbers("y", y)
    if targets.ndim == 0:
        raise _core.InvalidInput("y is a number, must be n, or n × E")
    if targets.ndim > 2:
        raise _core.InvalidInput(f"y has {targets.ndim} dimensions, must be n, or n × E")
    return np.asfortranarray(targets.reshape(len(targets), math.prod(targets.shape[1:]))), targets.ndim == 1


def _arrays(X: npt.ArrayLike, y: npt.ArrayLike) -> tuple[Array, Array, bool]:
    """As C++ takes them, copies, since the data are kept; and whether y is of one output."""
    inputs, (targets, one) = _inputs(X), _targets(y)
    if len(inputs) == 0:
        raise _core.InvalidInput("X has no rows, must have one or more")
    for name, array in (("X", inputs), ("y", targets)):
        for row, column in np.argwhere(~np.isfinite(array))[:1]:
            raise _core.InvalidInput(f"{name} has {array[row, column]} in row {row}, must be finite")
    return inputs, targets, one
