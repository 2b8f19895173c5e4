"""Results from JSON files."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..optimum import result
from ..results import HEADER, Result, Results, link
from ..tables import Table, packed
from .cells import column, with_arrays

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


def _table(of: Any, units: Mapping[str, str]) -> Table:
    if isinstance(of, dict):
        columns = _flat(of)
        count = max((len(values) for values in columns.values()), default=0)
    else:
        rows = [_flat(row) for row in of]
        names = dict.fromkeys(name for row in rows for name in row)
        columns = {name: [row.get(name) for row in rows] for name in names}
        count = len(rows)
    lists = list(columns.values())
    known = {name: units[name] for name in columns if name in units}
    return Table(list(columns), count, lambda i: column([with_arrays(value) for value in lists[i]]), known)


def _result(of: Mapping[str, Any], list_: str, units: Mapping[str, Mapping[str, str]]) -> Result:
    tables = {
        key: _table(value, units.get(key, {}))
        for key, value in of.items()
        if key in TABLES and isinstance(value, (list, dict))
    }
    facts = {key: packed(with_arrays(value)) for key, value in of.items() if key not in tables and key not in HEAD}
    about = {key: of.get(key, "") for key in ("study", "kind", "status", "doubt")}
    about |= {"noun": NOUNS.get(list_, list_.removesuffix("s")), "list": list_, "facts": facts}
    about |= {"set": of.get("set", {}), "set_units": dict(units.get("set", {})), "stop": of.get("stop", {})}
    return result(about, tables, {})


def of_document(path: Path) -> Results | None:
    """Read a file; None if it holds no results."""
    with path.open(encoding="utf-8") as file:
        try:
            all_ = json.load(file)
        except json.JSONDecodeError as error:
            raise ValueError(f"{path} is no JSON, or not complete: {error}") from None
    if not isinstance(all_, dict) or not str(all_.get("format", "")).startswith("arcslip-") or "scene_hash" not in all_:
        return None
    units = all_.get("units", {})
    results, lists, parents = [], [], []
    for list_, members in all_.items():
        if not isinstance(members, list) or not members or not isinstance(members[0], dict) or "status" not in members[0]:
            continue
        for each in members:
            results.append(_result(each, list_, units.get(list_, {})))
            lists.append(list_)
            parents.append(each["id"] - each["parent"] if "parent" in each else 0)
    link(results, lists, parents)
    header = {key: all_.get(key, {} if key == "reduction" else "") for key in HEADER}
    return Results(header | {"format": all_["format"]}, results)
