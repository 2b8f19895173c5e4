"""Files of results."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .optimum import result
from .results import HEADER, Result, Results, link
from .tables import Table, as_array, packed

#: The members of a result that are tables.
TABLES = ("points", "events", "history", "trials", "course", "cases")
HEAD = ("study", "kind", "id", "parent", "set", "status", "stop", "doubt")
NOUNS = {"branches": "branch", "optima": "search", "optimum_curves": "curve"}


def _flat(of: Mapping[str, Any], before: str = "") -> dict[str, Any]:
    """Return nested members by dotted names."""
    flat: dict[str, Any] = {}
    for key, value in of.items():
        if isinstance(value, dict):
            flat.update(_flat(value, f"{before}{key}."))
        else:
            flat[before + key] = value
    return flat


def _value(value: Any) -> Any:
    """Return a value with lists of numbers as arrays."""
    if isinstance(value, dict):
        return {key: _value(each) for key, each in value.items()}
    if not isinstance(value, list):
        return value
    if any(isinstance(each, float) for each in value) and all(isinstance(each, float | None) for each in value):
        return np.array([np.nan if each is None else each for each in value])
    return [_value(each) for each in value]


def _column(values: Sequence[Any]) -> Any:
    """Return the cells of a column, with None where they are missing, as an array of the type that they have."""
    there = {type(value) for value in values if value is not None}
    if there <= {float, int, bool}:
        if len(there) == 1 and None not in values:
            return np.array(values, dtype=there.pop())
        return np.array([np.nan if value is None else value for value in values], dtype=float)
    return as_array([_value(value) for value in values], "text" if there == {str} else "value")


def _table(of: Any) -> Table:
    if isinstance(of, dict):
        columns = _flat(of)
        count = max((len(values) for values in columns.values()), default=0)
    else:
        rows = [_flat(row) for row in of]
        names = dict.fromkeys(name for row in rows for name in row)
        columns = {name: [row.get(name) for row in rows] for name in names}
        count = len(rows)
    lists = list(columns.values())
    return Table(list(columns), count, lambda i: _column(lists[i]))


def _result(of: Mapping[str, Any], list_: str) -> Result:
    tables = {key: _table(value) for key, value in of.items() if key in TABLES and isinstance(value, (list, dict))}
    facts = {key: packed(_value(value)) for key, value in of.items() if key not in tables and key not in HEAD}
    about = {key: of.get(key, "") for key in ("study", "kind", "status", "doubt")}
    about |= {"noun": NOUNS.get(list_, list_.removesuffix("s")), "facts": facts, "set_units": {}}
    about |= {"set": of.get("set", {}), "stop": of.get("stop", {})}
    return result(about, tables, {})


def load(path: str | os.PathLike[str]) -> Results:
    """Read results from a JSON file that the command wrote.

    Columns have no units, which such a file does not have. Columns whose values have members, are a column for
    each member.

    Parameters
    ----------
    path : path

    Returns
    -------
    Results

    Raises
    ------
    OSError
        If the file cannot be read.
    ValueError
        If it holds no results.
    """
    with open(path, encoding="utf-8") as file:
        all_ = json.load(file)
    if not isinstance(all_, dict) or not str(all_.get("format", "")).startswith("arcslip-") or "scene_hash" not in all_:
        raise ValueError(f"{os.fspath(path)} holds no results of arcslip")
    results, lists, parents = [], [], []
    for list_, members in all_.items():
        if not isinstance(members, list) or not members or not isinstance(members[0], dict) or "status" not in members[0]:
            continue
        for each in members:
            results.append(_result(each, list_))
            lists.append(list_)
            parents.append(each["id"] - each["parent"] if "parent" in each else 0)
    link(results, lists, parents)
    header = {key: all_.get(key, {} if key == "reduction" else "") for key in HEADER}
    return Results(header, results)
