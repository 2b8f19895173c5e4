"""Results of a computation, as the extension hands them over."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from . import _core
from .errors import ArcslipWarning
from .optimum import result
from .results import Results, link
from .tables import Table, as_array, packed


def _table(schema: Mapping[str, Any], count: int, column: Callable[[int], Any]) -> Table:
    columns = schema["columns"]
    names = [".".join(column["path"]) for column in columns]
    units = {name: column["unit"] for name, column in zip(names, columns, strict=True) if column["unit"]}

    def load(c: int) -> Any:
        values = column(c)
        return as_array([] if values is None else values, columns[c]["type"])

    return Table(names, count, load, units)


def _history(core: _core.Results, i: int, table: int, row: int, steps: int) -> Table | None:
    record = core.motion(i, table, row, steps)
    return None if record is None else _table(record.schema(), len(record), record.column)


def from_core(core: _core.Results, labels: Mapping[str, str]) -> Results:
    """Return the results of a computation."""
    schemas = core.schemas()
    results, lists, parents = [], [], []
    for i in range(len(core)):
        about = core.facts(i)
        schema = schemas[about["schema"]]
        about["noun"], about["list"] = schema["noun"], schema["list"]
        about["facts"] = packed(about["facts"])
        tables = {
            table["key"]: _table(table, count, partial(core.column, i, t))
            for t, (table, count) in enumerate(zip(schema["tables"], core.counts(i), strict=True))
        }
        results.append(result(about, tables, labels))
        results[-1]._history = partial(_history, core, i)
        lists.append(schema["list"])
        parents.append(about["parent"])
    link(results, lists, parents)
    formats = {schema["format"] for schema in schemas}
    format_ = formats.pop() if len(formats) == 1 else "arcslip-results-1"
    return Results(core.header() | {"format": format_}, results, core)


def warn(core: _core.Results, stacklevel: int) -> None:
    """Warn of results that ended early and of those in doubt, in the words of the command."""
    for remarks in core.remarks():
        for sentence in remarks[:5]:
            warnings.warn(sentence, ArcslipWarning, stacklevel=stacklevel + 1)
        if len(remarks) > 5:
            warnings.warn(f"and {len(remarks) - 5} more such results", ArcslipWarning, stacklevel=stacklevel + 1)
