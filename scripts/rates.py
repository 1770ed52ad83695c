"""Rates with their 95 % intervals (Clopper and Pearson 1934), for scripts/tables and scripts/limits."""
import math


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
