"""Text of TOML files."""

from __future__ import annotations

import json
import math
import numbers
import re
from collections.abc import Mapping
from typing import Any

from ._core import InvalidInput


def value(given: Any) -> str:
    """A value as TOML has it; also a key in quotes."""
    if hasattr(given, "tolist"):  # of NumPy
        given = given.tolist()
    if isinstance(given, bool):
        return "true" if given else "false"
    if isinstance(given, numbers.Integral):
        return str(int(given))
    if isinstance(given, numbers.Real):
        if not math.isfinite(given):
            raise InvalidInput(f"{given} must be a finite number")
        return repr(float(given))
    if isinstance(given, str):
        return json.dumps(given, ensure_ascii=False)
    if isinstance(given, Mapping):
        return "{ " + ", ".join(f"{value(str(k))} = {value(v)}" for k, v in given.items()) + " }"
    if isinstance(given, (list, tuple, range)):
        return "[" + ", ".join(value(each) for each in given) + "]"
    raise InvalidInput(f"{given!r} must be a text, a number, a truth, or a list or dictionary of them")


def quoting(text: str, source: str, message: str) -> str:
    """A message in which the lines of a text are quoted that it names: nobody may have seen the text."""
    lines = ["", *text.split("\n")]
    return re.sub(rf"^({re.escape(source)}: line (\d+)): ", lambda at: f"{at[1]}, `{lines[int(at[2])]}`: ", message,
                  flags=re.MULTILINE)


def _line(head: str, key: Any, entry: Any) -> str:
    try:
        return f"{_key(str(key))} = {value(entry)}"
    except InvalidInput as error:
        raise InvalidInput(f"{head} {key}: {error}".lstrip()) from None


def table(head: str, entries: Mapping[str, Any], *, every: bool = False) -> str:
    """A table with its head. every: with all entries; else without those that are None or an empty text or dictionary."""
    lines = [_line(head, key, entry) for key, entry in entries.items()
             if every or entry is not None and not (isinstance(entry, (str, Mapping)) and not entry)]
    if head and not lines:
        return "" if head in ("[define]", "[policy]") else head
    return "\n".join([head, *lines] if head else lines)


def _key(name: str) -> str:
    """In quotes where it must be."""
    return name if re.fullmatch(r"[A-Za-z0-9_-]+(\.[A-Za-z0-9_-]+)*", name) else value(name)
