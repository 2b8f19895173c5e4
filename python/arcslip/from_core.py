"""Results of a computation, as the extension hands them over."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

from . import _core
from .errors import ArcslipWarning
from .optimum import result
from .results import Results, link
from .tables import Table, as_array, packed


def _table(core: _core.Results, i: int, t: int, schema: Mapping[str, Any], count: int) -> Table:
    columns = schema["columns"]
    names = [".".join(column["path"]) for column in columns]
    units = {name: column["unit"] for name, column in zip(names, columns, strict=True) if column["unit"]}

    def load(c: int) -> Any:
        values = core.column(i, t, c)
        return as_array([] if values is None else values, columns[c]["type"])

    return Table(names, count, load, units)


def from_core(core: _core.Results, labels: Mapping[str, str]) -> Results:
    """Return the results of a computation."""
    schemas = core.schemas()
    results, lists, parents = [], [], []
    for i in range(len(core)):
        about = core.facts(i)
        schema = schemas[about["schema"]]
        about["noun"] = schema["noun"]
        about["facts"] = packed(about["facts"])
        tables = {
            table["key"]: _table(core, i, t, table, count)
            for t, (table, count) in enumerate(zip(schema["tables"], core.counts(i), strict=True))
        }
        results.append(result(about, tables, labels))
        lists.append(schema["list"])
        parents.append(about["parent"])
    link(results, lists, parents)
    return Results(core.header(), results, core)


def warn(core: _core.Results, stacklevel: int) -> None:
    """Warn of results that ended early and of those in doubt, in the words of the command."""
    for remarks in core.remarks():
        for sentence in remarks[:5]:
            warnings.warn(sentence, ArcslipWarning, stacklevel=stacklevel + 1)
        if len(remarks) > 5:
            warnings.warn(f"and {len(remarks) - 5} more such results", ArcslipWarning, stacklevel=stacklevel + 1)
