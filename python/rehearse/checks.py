"""Arguments, checked before C++ sees them."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping
from operator import index
from pathlib import Path
from typing import Any, Union

import numpy as np

from . import _core
from ._core import InvalidInput
from .arrays import Array


def whole(name: str, value: Any, least: int = -(2**63), most: int = 2**63 - 1) -> int:
    try:
        if isinstance(value, (bool, np.bool_)):  # Python takes them for 0 and 1
            raise TypeError
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
    return whole("threads", value, 0, 1024)


def number(name: str, value: Any) -> float:
    try:
        if not isinstance(value, (str, bytes)):
            return float(value)
    except (TypeError, ValueError):
        pass
    raise TypeError(f"{name} = {value!r}, must be a number")


def not_negative(name: str, value: Any) -> float:
    given = number(name, value)
    if not (given >= 0 and math.isfinite(given)):
        raise InvalidInput(f"{name} = {given:g}, must be finite and ≥ 0")
    return given


def truth(name: str, value: Any) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} = {value!r}, must be True or False")
    return bool(value)


def text(name: str, value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError(f"{name} = {value!r}, must be a text")
    return value


def texts(name: str, value: Any, kinds: str) -> list[str]:
    """One text, or several. kinds: what it must be, for the message."""
    several = [value] if isinstance(value, str) or not isinstance(value, Iterable) else list(value)
    if not all(isinstance(each, str) for each in several):
        raise TypeError(f"{name} = {value!r}, must be {kinds}")
    return several


def path_of(name: str, value: Any, kinds: str = "a path") -> str:
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"{name} = {value!r}, must be {kinds}")
    return os.fsdecode(value)


def path_or_none(name: str, value: Any, kinds: str = "a path or None") -> str:
    """An empty text is none."""
    return "" if value is None else path_of(name, value, kinds)


def mapping(name: str, value: Any) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise TypeError(f"{name} is a {type(value).__name__}, must be a dictionary")
    return value


def function_or_none(name: str, value: Any) -> Any:
    if value is not None and not callable(value):
        raise TypeError(f"{name} = {value!r}, must be a function or None")
    return value


def mappings(name: str, given: Any) -> list[Mapping[str, Any]]:
    if not isinstance(given, (list, tuple)) or not all(isinstance(each, Mapping) for each in given):
        raise TypeError(f"{name} = {given!r}, must be a list of dictionaries")
    return list(given)


def numbers(name: str, given: Any, *, texts: bool = False) -> Array:
    """A new array of doubles; what is masked, or NA of pandas, is NaN. texts: those that are numbers are taken."""
    array: Array = np.asarray(given)
    if not texts and (array.dtype.kind in "US" or
                      array.dtype.kind == "O" and any(isinstance(each, (str, bytes)) for each in array.flat)):
        raise InvalidInput(f"{name} has texts, must have numbers")
    if array.dtype.kind == "c":
        raise InvalidInput(f"{name} has complex numbers, must have real ones")
    if array.dtype.kind in "mM":
        raise InvalidInput(f"{name} has times of the calendar or spans of it, must have numbers")
    if array.dtype.kind == "O" and hasattr(given, "isna"):
        given = np.where(given.isna(), np.nan, array)
    array = np.array(given, dtype=float, order="F")
    if isinstance(given, np.ma.MaskedArray):
        array[np.ma.getmaskarray(given)] = np.nan  # type: ignore[no-untyped-call]
    return array


def vector(name: str, given: Any) -> Array:
    """n numbers, or a column of them."""
    array = numbers(name, given)
    if array.ndim != 1 and not (array.ndim == 2 and array.shape[1] == 1):
        raise InvalidInput(f"{name} is an array of shape {array.shape}, must be n numbers")
    return array.reshape(-1)


def option_text(value: Any) -> str:
    """An option's value as `--set` has it: several texts with commas."""
    if hasattr(value, "tolist"):  # of NumPy
        value = value.tolist()
    if isinstance(value, (list, tuple)) and all(isinstance(each, str) for each in value):
        return ",".join(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value) if isinstance(value, float) else str(value)


def option_texts(options: Union[Mapping[str, Any], None]) -> list[tuple[str, str]]:
    return [(text("a name in options", name), option_text(value))
            for name, value in mapping("options", options or {}).items()]


def read_text(path: Union[str, os.PathLike[str]]) -> str:
    """The text of a file of ours, which is UTF-8 whatever the locale. Its line ends stay, since its bytes have a checksum."""
    try:
        return Path(path_of("path", path)).read_bytes().decode("utf-8")
    except UnicodeDecodeError:
        raise InvalidInput(f"{os.fspath(path)} is no text: it has bytes that are not UTF-8") from None


def read_if_any(name: str, path: Any, kinds: str) -> str:
    """The text of a file of ours; of None an empty one. kinds: what the argument must be, for the message."""
    given = path_or_none(name, path, kinds)
    return read_text(given) if given else ""


def write_page(path: Union[str, os.PathLike[str]], page: str) -> Path:
    """Writes a page. A file of that name that is none is left as it is."""
    _core.write_page(path_of("path", path), page)
    return Path(path)


def write_text(path: Union[str, os.PathLike[str]], content: str) -> Path:
    """Writes the whole file, or leaves the one that was there."""
    target = Path(path)
    beside = target.with_name(f".{target.name}.{os.getpid()}")
    try:
        beside.write_text(content, encoding="utf-8")
        os.replace(beside, target)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise
    return target
