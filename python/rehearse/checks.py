"""Numbers that are given, before C++ sees them."""

from __future__ import annotations

import math
from operator import index
from typing import Any, Union

import numpy as np

from ._core import InvalidInput
from .arrays import Array


def whole(name: str, value: Any, least: int = -(2**63), most: int = 2**63 - 1) -> int:
    try:
        number = index(value)
    except TypeError:
        raise TypeError(f"{name} = {value!r}, must be a whole number") from None
    if number < least:
        raise InvalidInput(f"{name} = {number}, must be ≥ {least}")
    if number > most:
        raise InvalidInput(f"{name} = {number}, must be ≤ {most}")
    return number


def whole_or_none(name: str, value: Any) -> Union[int, None]:
    return None if value is None else whole(name, value)


def threads_of(value: Any) -> int:
    """0 are all cores."""
    return whole("threads", value, 0, 2**31 - 1)


def not_negative(name: str, value: Any) -> float:
    number = float(value)
    if not (number >= 0 and math.isfinite(number)):
        raise InvalidInput(f"{name} = {number:g}, must be finite and ≥ 0")
    return number


def numbers(name: str, given: Any) -> Array:
    """A new array of doubles; what is masked is NaN."""
    if np.asarray(given).dtype.kind == "c":
        raise InvalidInput(f"{name} has complex numbers, must have real ones")
    array: Array = np.array(given, dtype=float, order="F")
    if isinstance(given, np.ma.MaskedArray):
        array[np.ma.getmaskarray(given)] = np.nan  # type: ignore[no-untyped-call]
    return array
