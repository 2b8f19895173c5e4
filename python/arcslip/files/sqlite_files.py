"""Files of SQLite."""

from __future__ import annotations

import os
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..tables import as_array

if TYPE_CHECKING:
    import sqlite3


def quoted(name: str) -> str:
    """Return a name as SQL has it."""
    return '"' + name.replace('"', '""') + '"'


def connected(path: str | os.PathLike[str], mode: str = "ro") -> sqlite3.Connection:
    """Return a connection to a file."""
    import sqlite3  # which not every build of Python has

    return sqlite3.connect(f"{Path(path).absolute().as_uri()}?mode={mode}", uri=True, isolation_level=None)


def column(path: Path, table: str, name: str, order: str) -> Any:
    """Return a column of a table: numbers with NaN where there is none, else texts."""
    with closing(connected(path)) as file:
        count, texts = file.execute(
            f"SELECT count(*), count(*) FILTER (WHERE typeof({quoted(name)}) = 'text') FROM {quoted(table)}"
        ).fetchone()
        rows = file.execute(f"SELECT {quoted(name)} FROM {quoted(table)} ORDER BY {order}")
        declared = {row[1]: row[2] for row in file.execute(f"PRAGMA table_info({quoted(table)})")}
        if texts or declared[name] == "TEXT":
            return as_array([None if value is None else str(value) for (value,) in rows], "text")
        whole = declared[name] == "INTEGER"
        values = np.fromiter((np.nan if value is None else value for (value,) in rows), float, count)
    return values.astype(np.int64) if whole and not np.isnan(values).any() else values
