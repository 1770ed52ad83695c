"""Rates with their 95 % intervals (Clopper and Pearson 1934), and means with theirs, for scripts/tables and scripts/limits."""
import math
import random

_ALL_SUBSETS_UP_TO = 14


def _binomial_tail(n, k, p):
    """P(X ≥ k)."""
    return sum(math.comb(n, i) * p**i * (1 - p) ** (n - i) for i in range(k, n + 1))


def _bisect(f):
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if f(middle) < 0.025 else (low, middle)
    return low


def interval(k, n):
    low = 0.0 if k == 0 else _bisect(lambda p: _binomial_tail(n, k, p))
    high = 1.0 if k == n else 1 - _bisect(lambda q: 1 - _binomial_tail(n, k + 1, 1 - q))
    return low, high


def rate(k, n):
    """As a text; – where there is nothing to count."""
    if n == 0:
        return "–"
    low, high = interval(k, n)
    return f"{k} of {n} ({100 * k / n:.3g} %; {100 * low:.2g} to {_percent(high)} %)"


def _percent(high):
    return "100" if high > 0.995 else f"{100 * high:.2g}"


def mean_interval(values):
    """The interval of a mean by the sign-flip test, as statistics/intervals.hpp; above 14 values of random subsets, which
    are others there. Needs 6 values."""
    if len(values) < 6:
        return math.nan, math.nan
    rng, most = random.Random(1), 2**min(len(values), _ALL_SUBSETS_UP_TO)
    all_of_them = len(values) <= _ALL_SUBSETS_UP_TO
    subsets = range(1, most) if all_of_them else (rng.randrange(1, 2**len(values)) for _ in range(1, most))
    means = []
    for subset in subsets:
        chosen = [value for i, value in enumerate(values) if subset >> i & 1]
        means.append(sum(chosen) / len(chosen))
    means.sort()
    rank = int(0.025 * most)
    return means[rank - 1], means[-rank]
