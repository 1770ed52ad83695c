"""Searches without derivatives, to be asked and told."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _core
from .arrays import Array
from .checks import number, numbers, option_text, vector, whole


class _Search:
    @property
    def evaluations(self) -> int:
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"<rehearse.{type(self).__name__} after {self.evaluations} evaluations>"

    def __reduce__(self) -> Any:
        raise TypeError(f"a {type(self).__name__} cannot be pickled or copied, since C++ alone knows how far it is: keep "
                        "its arguments and what it was told, which make the same search again")


class Cmaes(_Search):
    """CMA-ES (Hansen 2016). It MAXIMISES.

    mean: where it starts, n. sigma: the first step. bounds: (low, high) of each coordinate, n × 2; None: unbounded. The same
    seed gives the same candidates. max_evaluations: it stops with the generation that reaches them; None: when it has
    converged. options: as of `search.restarts.cmaes`, population=20.

    >>> search = Cmaes([3.0, 1.0], 0.5)
    >>> while not search.stop:
    ...     search.tell(-np.sum(search.ask() ** 2, axis=1))
    """

    def __init__(self, mean: npt.ArrayLike, sigma: float, bounds: Union[npt.ArrayLike, None] = None, *,
                 seed: int = 1, max_evaluations: Union[int, None] = None, **options: Any) -> None:
        self._max_evaluations = None if max_evaluations is None else whole("max_evaluations", max_evaluations, 1)
        texts = {name: option_text(value) for name, value in options.items()}
        start = vector("mean", np.atleast_1d(numbers("mean", mean)))
        pairs = [] if bounds is None else _pairs("bounds", bounds)
        if bounds is not None and len(pairs) != len(start):
            raise _core.InvalidInput(f"bounds has {len(pairs)} pairs, must have {len(start)}, one for each number of mean")
        for i, (x, (low, high)) in enumerate(zip(start, pairs)):
            if low < high and not low <= x <= high:
                raise _core.InvalidInput(f"mean[{i}] = {x:g}, must be between {low:g} and {high:g}")
        self._core = _core.Cmaes(start, number("sigma", sigma), pairs, _seed(seed), texts)

    def ask(self) -> Array:
        """The candidates of this generation, λ × n; the same until `tell`."""
        return self._core.ask()

    def tell(self, values: npt.ArrayLike) -> None:
        """Their values, λ; what is not finite is the worst."""
        self._core.tell(vector("values", values))

    @property
    def stop(self) -> Union[str, None]:
        """Why it is over; None: it is not."""
        if self._max_evaluations is not None and self.evaluations >= self._max_evaluations:
            return f"{self._max_evaluations} evaluations"
        return self._core.stop

    @property
    def population(self) -> int:
        """λ, the candidates of a generation."""
        return self._core.population

    @property
    def best_x(self) -> Array:
        """The best candidate that was told, n."""
        return self._core.best_x

    @property
    def best_value(self) -> float:
        """Its value."""
        return self._core.best_value

    @property
    def mean(self) -> Array:
        """The middle of the next candidates, n: where noise is large, a better answer than the best one."""
        return self._core.mean

    @property
    def sigma(self) -> float:
        """The step."""
        return self._core.sigma

    @property
    def evaluations(self) -> int:
        """Candidates that were told."""
        return self._core.evaluations


class MapElites(_Search):
    """MAP-Elites (Mouret 2015): the best solution of each niche of a space of descriptors. It MAXIMISES.

    bounds: (low, high) of each parameter of a solution. descriptor_bounds: of each descriptor. niches: of a centroidal
    Voronoi tessellation, 1000 by default; bins: instead, of a grid, one number a descriptor. options: batch=512,
    initial=1024, ….
    """

    def __init__(self, bounds: npt.ArrayLike, descriptor_bounds: npt.ArrayLike, *,
                 niches: Union[int, None] = None, bins: Union[Sequence[int], None] = None, seed: int = 1,
                 **options: Any) -> None:
        texts = {name: option_text(value) for name, value in options.items()}
        if niches is not None and bins is not None:
            raise _core.InvalidInput("niches and bins: only one of them at a time")
        grid = [] if bins is None else [whole("bins", each) for each in np.atleast_1d(np.asarray(bins, dtype=object))]
        if bins is not None and not grid:
            raise _core.InvalidInput("bins is empty, must be a number for each descriptor")
        self._core = _core.MapElites(_pairs("bounds", bounds), _pairs("descriptor_bounds", descriptor_bounds), grid,
                                     whole("niches", 1000 if niches is None else niches), _seed(seed), texts)

    def ask(self) -> Array:
        """Solutions to evaluate, batch × P; the same until `tell`."""
        return self._core.ask()

    def tell(self, performances: npt.ArrayLike, descriptors: npt.ArrayLike) -> None:
        """Takes the values of the points that were asked for (batch), and how they did it (batch × D)."""
        given = np.atleast_1d(numbers("descriptors", descriptors))
        if given.ndim > 2:
            raise _core.InvalidInput(f"descriptors has {given.ndim} dimensions, must be batch × D")
        self._core.tell(vector("performances", performances), given)

    @property
    def elites(self) -> dict[str, Array]:
        """solutions (k × P), descriptors (k × D), performances (k), niches (k)."""
        elites = self._core.elites()
        return {**elites, "niches": np.asarray(elites["niches"], dtype=np.int64)}

    def statistics(self, floor: float = 0.0) -> dict[str, float]:
        """filled niches, coverage, qd_score (sum of performances above floor), best, mean."""
        return dict(self._core.statistics(number("floor", floor)))

    @property
    def evaluations(self) -> int:
        """Solutions that were told."""
        return self._core.evaluations


def _pairs(name: str, bounds: npt.ArrayLike) -> list[tuple[float, float]]:
    array = numbers(name, bounds)
    if array.size and (array.ndim != 2 or array.shape[1] != 2):
        raise _core.InvalidInput(f"{name} is an array of shape {array.shape}, must be n × 2: (low, high) of each")
    return [(float(low), float(high)) for low, high in array.reshape(-1, 2)]


def _seed(value: Any) -> int:
    return whole("seed", value, 0, 2**64 - 1)
