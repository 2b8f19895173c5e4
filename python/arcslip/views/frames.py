"""Tables as data frames of pandas and as data sets of xarray."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..extras import required
from ..names import nearest

if TYPE_CHECKING:
    import pandas
    import xarray

    from ..results import Result
    from ..tables import Table

#: The dimensions of a data set: results, and rows of their tables.
COMBINATION, POINT = "combination", "point"


def chosen(results: Sequence[Result], table: str | None) -> list[Table]:
    """Return a table of each result: that of a name, or the main one.

    Raises
    ------
    ValueError
        If a result has no such table, or if the main tables of the results differ.
    """
    names = [table or next(iter(result.tables)) for result in results]
    for result, name in zip(results, names, strict=True):
        if name not in result.tables:
            known = list(result.tables)
            raise ValueError(f"found table={name!r}, must be one of {known}{nearest(name, known)}")
    if len(set(names)) > 1:
        kinds = list(dict.fromkeys(result.kind for result in results))
        raise ValueError(f"found results of the kinds {kinds}, which have different tables; name a study of one kind")
    return [result.tables[name] for result, name in zip(results, names, strict=True)]


def data_frame(table: Table) -> pandas.DataFrame:
    """Return a table as a data frame, with the units of its columns in ``attrs["units"]``."""
    pd = required("pandas", "pandas")
    columns = {}
    for name in table.columns:
        values = table[name]
        columns[name] = values if values.ndim == 1 else pd.Series(list(values), dtype=object)
    frame: pandas.DataFrame = pd.DataFrame(columns, index=pd.RangeIndex(len(table), name=POINT))
    frame.attrs["units"] = table.units
    return frame


def joined_frame(results: Sequence[Result], table: str | None) -> pandas.DataFrame:
    """Return the rows of all results as one data frame, with what `for_each` sets in its first columns."""
    pd = required("pandas", "pandas")
    frames = []
    for result, of in zip(results, chosen(results, table), strict=True):
        frame = data_frame(of)
        for i, (name, value) in enumerate(result.set.items()):
            frame.insert(i, name, value)
        frame.attrs = {}
        frames.append(frame)
    some = {i: frame for i, frame in enumerate(frames) if len(frame) > 0} or dict(enumerate(frames[:1]))
    joined: pandas.DataFrame = pd.concat(some, names=[COMBINATION]) if some else pd.DataFrame()
    joined.attrs["units"] = _units(results, table)
    return joined


def data_set(results: Sequence[Result], table: str | None) -> xarray.Dataset:
    """Return the tables of results as a data set over `combination` and `point`, filled up with missing values."""
    xr = required("xarray", "ensemble")
    tables = chosen(results, table)
    units = _units(results, table)
    count = max((len(each) for each in tables), default=0)

    def variable(dimensions: Sequence[str], values: Any, name: str) -> Any:
        return xr.Variable(dimensions, values, {"units": units[name]} if name in units else {})

    variables = {}
    for name in dict.fromkeys(name for each in tables for name in each.columns):
        values = _stacked([each[name] if name in each.columns else None for each in tables], count)
        inner = [f"{name}.{axis}" for axis in range(values.ndim - 2)]
        variables[name] = variable([COMBINATION, POINT, *inner], values, name)
    coordinates = {
        name: variable([COMBINATION], [result.set.get(name, np.nan) for result in results], name)
        for name in dict.fromkeys(name for result in results for name in result.set)
    }
    data: xarray.Dataset = xr.Dataset(variables, coordinates)
    return data


def _units(results: Sequence[Result], table: str | None) -> dict[str, str]:
    units: dict[str, str] = {}
    for result, of in zip(results, chosen(results, table), strict=True):
        units |= {**result.set_units, **of.units}
    return units


def _stacked(columns: Sequence[NDArray[Any] | None], count: int) -> NDArray[Any]:
    """Return columns of up to `count` rows as the rows of one array: missing are NaN, "", or None among objects."""
    there = [column for column in columns if column is not None and len(column) > 0]
    if not there:
        return np.empty((len(columns), count))
    kinds = {column.dtype.kind for column in there}
    if "O" in kinds or len({column.ndim for column in there}) > 1:
        return _stacked_objects(columns, count)
    inner = [max(sizes) for sizes in zip(*(column.shape[1:] for column in there), strict=True)]
    shape = (count, *inner)
    if len(there) == len(columns) and all(column.shape == shape for column in there):
        return np.stack(there)
    are_texts = kinds == {"U"}
    stacked = np.full((len(columns), *shape), "" if are_texts else np.nan, dtype=np.result_type(*there) if are_texts else float)
    for row, column in zip(stacked, columns, strict=True):
        if column is not None and len(column) > 0:
            row[tuple(slice(size) for size in column.shape)] = column
    return stacked


def _stacked_objects(columns: Sequence[NDArray[Any] | None], count: int) -> NDArray[Any]:
    stacked = np.full((len(columns), count), None, dtype=object)
    for i, column in enumerate(columns):
        for j in range(0 if column is None else len(column)):
            stacked[i, j] = column[j]  # type: ignore[index]
    return stacked
