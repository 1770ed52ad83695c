"""CSV files of run folders as structured arrays, and arrays as CSV files of episodes."""

from __future__ import annotations

import csv
import io
import os
import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Union

import numpy as np

from ._core import InvalidInput
from .arrays import Array


def from_csv(text: str) -> Array:
    """A structured array, a field a column: whole numbers, numbers (NaN where a cell is empty), or texts.

    Names are those of the header without their units; pandas.DataFrame takes it as it is.
    """
    rows = list(csv.reader(io.StringIO(text)))
    header = [re.sub(r" \[[^\]]*\]$", "", name) for name in rows[0]] if rows else []
    columns = [_column([row[i] for row in rows[1:]]) for i in range(len(header))]
    table = np.empty(max(len(rows) - 1, 0), dtype=[(name, column.dtype) for name, column in zip(header, columns)])
    for name, column in zip(header, columns):
        table[name] = column
    return table


def read_csv(path: Union[str, os.PathLike[str]]) -> Array:
    return from_csv(Path(path).read_text())


def _column(cells: list[str]) -> Array:
    try:
        numbers = np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array(cells, dtype=str) if cells else np.empty(0, dtype="U1")
    whole = cells and all(cell.lstrip("-").isdigit() for cell in cells)
    return numbers.astype(np.int64) if whole else numbers


def to_csv(columns: Any) -> str:
    """An episode as a file: a structured array, a DataFrame, or a dictionary of columns.

    A column may be one shorter than the longest: no action follows the last state.
    """
    if isinstance(columns, np.ndarray) and columns.dtype.names:
        named = {name: columns[name] for name in columns.dtype.names}
    elif isinstance(columns, Mapping) or hasattr(columns, "columns"):
        named = {str(name): np.asarray(columns[name]) for name in columns}
    else:
        raise TypeError(f"{type(columns).__name__}: an episode is a path, a structured array, a DataFrame, or a "
                        "dictionary of columns: time, states and actions by name")
    named = {name: _numbers(name, column) for name, column in named.items() if _is_numeric(column)}
    rows = max((len(column) for column in named.values()), default=0)
    for name, column in named.items():
        if len(column) < rows - 1:
            raise InvalidInput(f"column {name} has {len(column)} numbers, the longest {rows}")
    cells = [[name, *(_cell(number, row == rows - 1) for row, number in enumerate(column)), *[""] * (rows - len(column))]
             for name, column in named.items()]
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows(zip(*cells))
    return out.getvalue()


def as_files(episodes: Iterable[Any], folder: Union[str, os.PathLike[str]], name: str) -> list[str]:
    """Paths as they are; other episodes as files of the folder, NAME-1.csv, …."""
    files = []
    for number, episode in enumerate(episodes, 1):
        if isinstance(episode, (str, os.PathLike)):
            files.append(os.fspath(episode))
            continue
        path = Path(folder) / f"{name}-{number}.csv"
        path.write_text(to_csv(episode))
        files.append(str(path))
    return files


@contextmanager
def without_path(folder: str) -> Iterator[None]:
    """What is wrong with a file that was made of arrays is said without the folder that it was in."""
    try:
        yield
    except InvalidInput as error:
        raise InvalidInput(str(error).replace(folder + os.sep, "")) from None


def _is_numeric(column: Any) -> bool:
    return np.asarray(column).dtype.kind in "biuf"


def _numbers(name: str, column: Any) -> Array:
    numbers: Array = np.asarray(column, dtype=float)
    if numbers.ndim == 2 and numbers.shape[1] == 1:
        numbers = numbers[:, 0]
    if numbers.ndim != 1:
        raise InvalidInput(f"column {name} is an array of shape {numbers.shape}, must be one number a row")
    return numbers


def _cell(number: float, last: bool) -> str:
    return "" if last and np.isnan(number) else repr(float(number))  # no action follows the last state
