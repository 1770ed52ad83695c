"""CSV files of run folders as structured arrays, and arrays as CSV files of episodes."""

from __future__ import annotations

import csv
import io
import os
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import date, timedelta
from html import escape
from pathlib import Path
from typing import Any, Union

import numpy as np

from ._core import InvalidInput
from .arrays import Array
from .checks import numbers, read_text, write_text


#: Columns of texts in the tables of runs and of `identify`, also where all their cells are empty. Tables of states by name
#: have others.
TEXTS = frozenset({"limit", "note", "warning", "notes", "file", "settings", "broke", "parameter", "unit", "state", "set", "kind", "text"})

#: Columns of whole numbers in these tables. All other numbers are doubles, whatever the values are, and whether there are any.
WHOLE = frozenset({"trial", "seed", "rollouts", "failed_rollouts", "cut_short", "broken", "horizon", "compared", "failed", "log", "steps",
                   "episodes", "elite", "learned", "runs", "of", "done", "trials"})


def structured(columns: Mapping[str, Array]) -> Array:
    """Columns of one length, by name, as a structured array; pandas.DataFrame takes it as it is."""
    rows = max((len(column) for column in columns.values()), default=0)
    table = np.empty(rows, dtype=[(name, column.dtype) for name, column in columns.items()])
    for name, column in columns.items():
        table[name] = column
    return table


def column_of(values: Sequence[Any], *, text: bool = False, whole: bool = False) -> Array:
    """Texts, whole numbers, or numbers, of which None is NaN."""
    if text:
        return _texts_of([str(value) for value in values])
    return np.array(values, dtype=np.int64 if whole else float)


def from_csv(text: str, texts: Collection[str] = (), whole: Collection[str] = ()) -> Array:
    """A structured array, a field a column: numbers (NaN where a cell is empty), or texts.

    Names are those of the header without their units. texts: columns that are texts, whatever is in them; whole: those of
    whole numbers. Raises InvalidInput where a row has not as many cells as the header, or there is none.
    """
    rows = list(csv.reader(io.StringIO(text)))
    if not rows:
        raise InvalidInput("it is empty, must have a header")
    for number, row in enumerate(rows, 1):
        if len(row) != len(rows[0]):
            raise InvalidInput(f"row {number} has {len(row)} cells, must have {len(rows[0])}, as the header: it is damaged")
    header = [re.sub(r" \[.*\]$", "", name) for name in rows[0]]
    cells = {name: [row[i] for row in rows[1:]] for i, name in enumerate(header)}
    return structured({name: _texts_of(column) if name in texts else _parsed(column, name in whole)
                       for name, column in cells.items()})


def read_csv(path: Union[str, os.PathLike[str]], texts: Collection[str] = (), whole: Collection[str] = ()) -> Array:
    text = read_text(path)
    try:
        return from_csv(text, texts, whole)
    except InvalidInput as error:
        raise InvalidInput(f"{path}: {error}") from None


def _texts_of(cells: list[str]) -> Array:
    return np.array(cells, dtype=str) if cells else np.empty(0, dtype="U1")


def _parsed(cells: list[str], whole: bool) -> Array:
    """Numbers where all cells are, else texts. Another version may have left a cell empty that should be a whole number."""
    try:
        values = np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return _texts_of(cells)
    return values.astype(np.int64) if whole and all(cell.lstrip("-").isdigit() for cell in cells) else values


def to_csv(columns: Any) -> str:
    """An episode as a file: a structured array, a DataFrame, or a dictionary of columns.

    An index with a name is a column, too; one without, of dates or spans, is `time`. A column may be one shorter than
    `time`: no action follows the last state. What is masked, None, and what pandas takes for missing are empty cells, which are missing samples. What is no column
    of numbers is written as it is, for the reader to say so where the task has it, else to leave it.
    """
    if isinstance(columns, np.ndarray) and columns.dtype.names:
        named = {name: columns[name] for name in columns.dtype.names}
    elif isinstance(columns, Mapping) or hasattr(columns, "columns"):
        named = {str(name): columns[name] for name in columns}
        index: Any = getattr(columns, "index", None)  # of pandas, where times may stand
        if getattr(index, "name", None) is not None:
            named.setdefault(str(index.name), index)
        elif getattr(getattr(index, "dtype", None), "kind", "") in ("m", "M"):
            named.setdefault("time", index)
    else:
        raise TypeError(f"{type(columns).__name__}: an episode is a path, a structured array, a DataFrame, or a "
                        "dictionary of columns: time, states and actions by name")
    if "time" in named:
        named["time"] = _seconds(named["time"])
    numeric = {name: array for name, column in named.items() if (array := _numbers(name, column)) is not None}
    rows = len(numeric["time"]) if "time" in numeric else max((len(column) for column in numeric.values()), default=0)
    for name, column in numeric.items():
        if not rows - 1 <= len(column) <= rows:
            raise InvalidInput(f"column {name} has {len(column)} numbers, column time {rows}" if "time" in numeric else
                               f"column {name} has {len(column)} numbers, the longest {rows}")
    cells = {name: _cells(numeric[name], _missing(column), rows) if name in numeric else _texts(column)
             for name, column in named.items()}
    table = [[name, *column, *[""] * (rows - len(column))] for name, column in cells.items()
             if rows - 1 <= len(column) <= rows]
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows(zip(*table))
    return out.getvalue()


def as_files(episodes: Iterable[Any], folder: Union[str, os.PathLike[str]], name: str) -> list[str]:
    """Paths as they are; other episodes as files of the folder, NAME-1.csv, …."""
    files = []
    for number, episode in enumerate(episodes, 1):
        if isinstance(episode, (str, os.PathLike)):
            files.append(os.fspath(episode))
            continue
        files.append(str(write_text(Path(folder) / f"{name}-{number}.csv", to_csv(episode))))
    return files


def html_table(titles: Iterable[str], rows: Iterable[Iterable[Any]]) -> str:
    head = "".join(f"<th>{escape(title)}</th>" for title in titles)
    body = "".join("<tr>" + "".join(f"<td>{escape(str(cell))}</td>" for cell in row) + "</tr>" for row in rows)
    return f"<table><tr>{head}</tr>{body}</table>"


@contextmanager
def without_path(folder: str) -> Iterator[None]:
    """What is wrong with a file that was made of arrays is said without the folder that it was in."""
    try:
        yield
    except InvalidInput as error:
        raise InvalidInput(str(error).replace(folder + os.sep, "")) from None


def _numbers(name: str, column: Any) -> Union[Array, None]:
    """None: it holds something else, such as texts, complex numbers, times of day, images, or one number alone."""
    try:
        array = numbers(name, column, texts=True)
    except (TypeError, ValueError):
        return None
    if array.ndim == 2 and array.shape[1] == 1:
        array = array[:, 0]
    return array if array.ndim == 1 else None


def _seconds(column: Any) -> Any:
    """A column of dates as seconds from the first, one of spans as seconds; any other as it is."""
    if isinstance(column, (str, bytes, Mapping)) or not isinstance(column, Collection):
        return column
    array = np.asarray(column)
    if array.dtype.kind == "O" and array.ndim == 1 and all(isinstance(each, (date, timedelta)) for each in array):
        apart = [each if isinstance(each, timedelta) else each - array[0] for each in array]  # those with a zone, too
        array = np.array([each.total_seconds() for each in apart])
    elif array.dtype.kind == "m" and array.ndim == 1 and np.datetime_data(array.dtype)[0] not in ("Y", "M"):
        array = array / np.timedelta64(1, "s")
    elif array.dtype.kind == "M" and array.ndim == 1:
        array = array.astype("datetime64[ns]")
        known = array[~np.isnat(array)]
        array = (array - (known[0] if len(known) else array.dtype.type(0, "ns"))) / np.timedelta64(1, "s")
    else:
        return column
    return [None if np.isnan(each) else each for each in array.tolist()]


def _missing(column: Any) -> Array:
    """Whether each number of a column stands for a sample that is missing. NaN of NumPy alone may as well come of
    a sensor that failed."""
    if hasattr(column, "isna"):
        return np.asarray(column.isna())
    if isinstance(column, np.ma.MaskedArray):
        mask: Array = np.ma.getmaskarray(column)  # type: ignore[no-untyped-call]
        return mask.reshape(-1)
    return np.array([each is None for each in column], dtype=bool)


def _cells(column: Array, missing: Array, rows: int) -> list[str]:
    """The last row may have no action."""
    return ["" if left_out or (np.isnan(number) and row == rows - 1) else repr(float(number))
            for row, (number, left_out) in enumerate(zip(column, missing))]


def _texts(column: Any) -> list[str]:
    """[]: it is one thing, such as a text or a number, or it is images."""
    one = isinstance(column, (str, bytes, Mapping)) or not isinstance(column, Collection)
    if one or getattr(column, "ndim", 1) not in (1, 2) or any(getattr(value, "ndim", 0) > 1 for value in column):
        return []
    return ["" if value is None else str(value) for value in column]
