"""Results that were loaded or unpickled as the text of a JSON file."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from ..results import Result, Results
    from ..tables import Table

#: Tables that are written as a list for each column, and not as an object for each row.
BY_COLUMNS = ("history",)


def _plain(value: Any) -> Any:
    """Return a value as JSON has it: numbers that are not finite are null."""
    if isinstance(value, Mapping):
        return {key: _plain(each) for key, each in value.items()}
    if isinstance(value, np.ndarray | list | tuple):
        return [_plain(each) for each in (value.tolist() if isinstance(value, np.ndarray) else value)]
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _nested(row: Iterable[tuple[str, Any]]) -> dict[str, Any]:
    nested: dict[str, Any] = {}
    for name, value in row:
        *groups, last = name.split(".")
        inside = nested
        for group in groups:
            inside = inside.setdefault(group, {})
        inside[last] = value
    return nested


def _rows(table: Table, key: str) -> Any:
    columns = {name: _plain(table[name]) for name in table.columns}
    if key in BY_COLUMNS:
        return _nested(columns.items())
    return [_nested((name, values[i]) for name, values in columns.items()) for i in range(len(table))]


def _document_of(one: Result, number: int, parent: int | None) -> dict[str, Any]:
    about: dict[str, Any] = {"study": one.study, "kind": one.kind, "id": number}
    if parent is not None:
        about["parent"] = parent
    about |= {key: _plain(value) for key, value in one.facts.items()}
    about["set"] = _plain(one.set)
    about |= {key: _rows(table, key) for key, table in one.tables.items()}
    about |= {"status": one.status, "stop": _plain(one.stop)}
    return about | ({"doubt": one.doubt} if one.doubt else {})


def as_document(results: Results) -> str:
    """Return the text of a file with results that were loaded or unpickled."""
    lists: dict[str, list[Result]] = {}
    for each in results:
        lists.setdefault(each._list, []).append(each)
    document: dict[str, Any] = {"format": results._format, "program": results.program}
    document |= {"scene_hash": results.scene_hash, "title": results.title, "frequency_unit": results.frequency_unit}
    document |= {"notes": results.notes} if results.notes else {}
    document["units"] = {key: _units(all_) for key, all_ in lists.items()}
    document |= {"reduction": _plain(results.reduction)} if results.reduction else {}
    for key, all_ in lists.items():
        numbers = {id(one): i for i, one in enumerate(all_, 1)}
        parents = [None if one.parent is None else numbers.get(id(one.parent)) for one in all_]
        document[key] = [_document_of(one, i, parents[i - 1]) for i, one in enumerate(all_, 1)]
    return json.dumps(document, allow_nan=False) + "\n"


def _units(results: Sequence[Result]) -> dict[str, dict[str, str]]:
    """Return the units of columns that have one, by table."""
    all_: dict[str, dict[str, str]] = {}
    for one in results:
        for key, units in [("set", one.set_units), *((key, table.units) for key, table in one.tables.items())]:
            if known := {name: unit for name, unit in units.items() if unit not in ("", "-")}:
                all_.setdefault(key, {}).update(known)
    return all_
