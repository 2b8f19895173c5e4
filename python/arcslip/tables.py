"""Tables of results by columns."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from .names import Named, nearest
from .views.frames import data_frame
from .views.markup import of_table

if TYPE_CHECKING:
    import pandas


#: The types of columns without rows; of others they follow from the values.
EMPTY = {"number": np.float64, "whole": np.int64, "flag": np.bool_}


class Row(Named):
    """A row of a table, such as a point or an event: its values as items and attributes, missing ones are NaN or None."""

    __slots__ = ("_index", "_table")

    def __init__(self, table: Table, index: int) -> None:
        self._table = table
        self._index = index

    def __getitem__(self, name: str) -> Any:
        found = self._table[name]
        if isinstance(found, Table):
            return Row(found, self._index)
        value = found[self._index]
        return value.item() if isinstance(value, np.generic) else value

    def _names(self) -> list[str]:
        return self._table.heads()

    def _place(self) -> tuple[Table, int]:
        """Return the table that the row was taken from, and its index in it."""
        return self._table._place(self._index)

    def to_dict(self) -> dict[str, Any]:
        """Return all values by the names of their columns."""
        return {name: self[name] for name in self._table.columns}

    def __repr__(self) -> str:
        values = []
        for name in self._table.columns:
            value = self[name]
            if isinstance(value, (str, bool, int, float)) and value == value and value != "":
                values.append(f"{name}={value:.6g}" if isinstance(value, float) else f"{name}={value}")
        return f"<{', '.join(values[:6])}{', ...' if len(values) > 6 else ''}>"


class Table(Named, Sequence[Row]):
    """Rows of equal columns: ``table["amplitude"]``, or ``table.amplitude``, is a column, ``table[0]`` a row.

    Columns have dotted names: ``table["elements.damper.stick_percent"]`` is ``table.elements.damper.stick_percent``.
    A column of numbers is an array of float, with NaN where a value is missing; of whole numbers and of flags an array of
    int or bool, or of float where one is missing; of texts an array of str, with "" where one is missing; of lists of numbers
    of the same length an array of rows; of other values an array of objects. Those that the computation filled are read-only.
    """

    def __init__(
        self,
        columns: Sequence[str],
        count: int,
        load: Callable[[int], NDArray[Any]],
        units: dict[str, str] | None = None,
    ) -> None:
        self._places = {name: i for i, name in enumerate(columns)}
        self._count = count
        self._load = load
        self._loaded: dict[str, NDArray[Any]] = {}
        self._units = units or {}
        self._origin: tuple[Table, NDArray[np.intp]] | None = None  # the table that these rows are some of

    @property
    def columns(self) -> tuple[str, ...]:
        """The names of all columns."""
        return tuple(self._places)

    @property
    def units(self) -> dict[str, str]:
        """The units of columns that have one."""
        return dict(self._units)

    def heads(self) -> list[str]:
        """Return the first keys of the names."""
        return list(dict.fromkeys(name.split(".")[0] for name in self._places))

    def __len__(self) -> int:
        return self._count

    def __iter__(self) -> Iterator[Row]:
        return (Row(self, i) for i in range(self._count))

    def __contains__(self, name: object) -> bool:
        return name in self._places

    @overload
    def __getitem__(self, of: int) -> Row: ...
    @overload
    def __getitem__(self, of: slice) -> Table: ...
    @overload
    def __getitem__(self, of: str) -> Any: ...
    def __getitem__(self, of: int | slice | str) -> Any:
        if isinstance(of, str):
            return self._by_name(of)
        if isinstance(of, slice):
            return self._some(of)
        index = range(self._count)[of]
        return Row(self, index)

    def _names(self) -> list[str]:
        return self.heads()

    def _by_name(self, name: str) -> Any:
        if name in self._loaded:
            return self._loaded[name]
        if name in self._places:
            self._loaded[name] = self._load(self._places[name])
            return self._loaded[name]
        within = name + "."
        inner = [each for each in self._places if each.startswith(within)]
        if inner:
            short = [each.removeprefix(within) for each in inner]
            units = {s: self._units[i] for s, i in zip(short, inner, strict=True) if i in self._units}
            return Table(short, self._count, lambda i: self._by_name(inner[i]), units)
        if "kind" in self._places and name in (kinds := self._by_name("kind")):
            return self._some(np.flatnonzero(kinds == name))
        kinds = dict.fromkeys(self._by_name("kind").tolist()) if "kind" in self._places else ()
        raise KeyError(f"no column {name!r}{nearest(name, [*self._places, *self.heads(), *kinds])}")

    def to_dataframe(self) -> pandas.DataFrame:
        """Return the table as a data frame, a column for each column.

        Lists of numbers, such as Fourier coefficients, are a column of arrays.

        Returns
        -------
        pandas.DataFrame
            With the units of columns in ``attrs["units"]``. It owns its values.

        Raises
        ------
        ImportError
            If pandas is not installed: the extra ``arcslip[pandas]`` has it.

        Examples
        --------
        >>> branch, = arcslip.Scene("examples/duffing_jenkins/scene.json").frf()
        >>> peaks = branch.events["peak"].to_dataframe()
        >>> peaks.attrs["units"]["amplitude"]
        'm'
        """
        return data_frame(self)

    def _some(self, rows: slice | NDArray[np.intp]) -> Table:
        names = self.columns
        taken = np.arange(self._count)[rows]
        some = Table(names, len(taken), lambda i: self._by_name(names[i])[rows], self._units)
        table, before = self._origin or (self, np.arange(self._count))
        some._origin = table, before[rows]
        return some

    def _place(self, index: int) -> tuple[Table, int]:
        """Return the table that these rows were taken from, and the index of a row in it."""
        table, rows = self._origin or (self, np.arange(self._count))
        return table, int(rows[index])

    def __reduce__(self) -> Any:
        return _restored, (self.columns, self._count, [self[name] for name in self.columns], self._units)

    def __repr__(self) -> str:
        heads = ", ".join(self.heads())
        return f"<table of {self._count} rows: {heads if len(heads) < 300 else heads[:297] + '...'}>"

    def _repr_html_(self) -> str:
        return of_table(self)


def _restored(columns: Sequence[str], count: int, values: list[NDArray[Any]], units: dict[str, str]) -> Table:
    return Table(columns, count, values.__getitem__, units)


def as_array(values: Any, type_: str) -> NDArray[Any]:
    """Return a column of a type of the schema, with None where a value is missing, as an array."""
    if isinstance(values, np.ndarray):
        return values
    if len(values) == 0 and type_ in EMPTY:
        return np.empty(0, EMPTY[type_])
    if type_ == "text":
        return np.array(["" if value is None else value for value in values], dtype=np.str_)
    return pack([packed(value) for value in values])


def packed(value: Any) -> Any:
    """Return a value with lists of arrays of equal shape as arrays, within dicts, too."""
    if isinstance(value, dict):
        return {key: packed(each) for key, each in value.items()}
    if not isinstance(value, list):
        return value
    inner = [packed(each) for each in value]
    return np.array(inner) if _of_one_shape(inner) else inner


def pack(values: list[Any]) -> NDArray[Any]:
    """Return values as an array with one more axis, where they are arrays of one shape, else as an array of objects."""
    if _of_one_shape(values):
        return np.array(values)
    objects = np.empty(len(values), dtype=object)
    for i, value in enumerate(values):
        objects[i] = value
    return objects


def _of_one_shape(values: list[Any]) -> bool:
    return len({value.shape if isinstance(value, np.ndarray) else None for value in values} | {None}) == 2 and all(
        isinstance(value, np.ndarray) for value in values
    )
