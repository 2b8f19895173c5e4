"""Files of results."""

from __future__ import annotations

import os
from pathlib import Path

from ..results import Results
from .csv_files import of_tables
from .json_files import of_document

SQLITE = b"SQLite format 3\0"


def load(path: str | os.PathLike[str]) -> Results:
    """Read results from a file that the command wrote, or `Results.save`: JSON or CSV.

    Of CSV the file of the points, or of what else the main table has, is named; those of events, cases and summary are read
    where they stand next to it. Such files do not tell all that those of JSON do: the title and the hash of the scene, and
    lists of facts. Columns whose values have members are a column for each member.

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
        If it holds no results, or an ensemble, which `Ensemble` reads.
    """
    path = Path(path)
    with path.open("rb") as file:
        start = file.read(len(SQLITE))
    if start == SQLITE:
        raise ValueError(f"{path} holds an ensemble: arcslip.Ensemble({os.fspath(path)!r}) reads it")
    found = of_document(path) if start.lstrip()[:1] in (b"{", b"[") else of_tables(path)
    if found is None:
        raise ValueError(f"{path} holds no results of arcslip")
    return found
