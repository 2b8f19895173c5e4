"""Results from CSV files, format "arcslip-csv-2"."""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from ..optimum import result
from ..results import Result, Results, link
from ..tables import Table
from .cells import column, with_arrays

#: The list, the main table and the format of the results that the column of a number names.
KINDS = {
    "branch": ("branches", "points", "arcslip-branches-1"),
    "motion": ("motions", "history", "arcslip-time-1"),
    "response": ("responses", "history", "arcslip-responses-1"),
    "sweep": ("sweeps", "points", "arcslip-sweeps-1"),
    "comparison": ("comparisons", "trials", "arcslip-accuracy-1"),
    "search": ("optima", "course", "arcslip-optimum-1"),
    "curve": ("optimum_curves", "points", "arcslip-optimum-1"),
}
#: Tables in files of their own.
FURTHER = ("events", "cases")
#: Names with a dot, but for those of parameters and those that begin with these, are of elements: a file calls
#: "elements.damper.force" "damper.force".
GROUPS = ("at_bound", "force_per_displacement", "patches", "responses", "optimum", "maxima", "synthesis", "point")
#: A pair of a list that is also there as a whole.
PAIR = re.compile(r".*[.]\d+[.](re|im)")
TITLE = re.compile(r"(?P<name>.*?)(?: \((?P<unit>[^()]*(?:\([^()]*\))?[^()]*)\))?", re.DOTALL)


class _File:
    """The cells of a file by columns."""

    def __init__(self, path: Path) -> None:
        with path.open(encoding="utf-8", newline="") as file:
            lines = list(csv.reader(file))
        matches = [TITLE.fullmatch(title) for title in (lines or [[]])[0]]
        self.names = [match["name"] for match in matches if match]
        self.units = [match["unit"] or "" for match in matches if match]
        self.rows = lines[1:]
        self.noun = next((name for name in self.names if name in KINDS), "")
        if any(len(row) != len(self.names) for row in self.rows):
            raise ValueError(f"{path} is not complete: its lines have different numbers of cells")

    def cells(self, name: str, rows: Sequence[int]) -> list[str]:
        place = self.names.index(name)
        return [self.rows[i][place] for i in rows]

    def rows_of(self, study: str, number: str) -> list[int]:
        studies, numbers = self.names.index("study"), self.names.index(self.noun)
        return [i for i, row in enumerate(self.rows) if row[studies] == study and row[numbers] == number]


def _parsed(cell: str) -> Any:
    """Return a number, a flag, a list or a text; None for an empty cell."""
    if cell in ("", "true", "false"):
        return cell == "true" if cell else None
    if cell[0] in "[{":
        return with_arrays(json.loads(cell))
    try:
        return float(cell)
    except ValueError:
        return cell[1:] if cell[0] == "'" and cell[1:2] in tuple("=+-@") else cell


def _column(cells: Sequence[str], unit: str) -> NDArray[Any]:
    values = [_parsed(cell) for cell in cells]
    if not unit and values and all(isinstance(value, float) and value.is_integer() for value in values):
        values = [int(value) for value in values]
    found: NDArray[Any] = column(values)
    return found


def _table(file: _File, rows: Sequence[int], own: Sequence[str]) -> Table:
    """Return a table of some rows. own: the names of parameters."""
    first = file.names.index(file.noun) + 1
    names = [name for name in file.names[first:] if not PAIR.fullmatch(name)]
    units = dict(zip(file.names, file.units, strict=True))

    def full(name: str) -> str:
        return name if "." not in name or name in own or name.split(".")[0] in GROUPS else f"elements.{name}"

    known = {full(name): units[name] for name in names if units[name] not in ("", "-")}
    return Table([full(name) for name in names], len(rows), lambda i: _column(file.cells(names[i], rows), units[names[i]]), known)


def _facts(file: _File | None, row: int | None) -> dict[str, Any]:
    """Return a row of a summary as nested facts."""
    facts: dict[str, Any] = {}
    if file is None or row is None:
        return facts
    for name, cell in zip(file.names, file.rows[row], strict=True):
        value = _parsed(cell)
        if value is None:
            continue
        group, _, inside = name.partition(".")
        if inside and file.names.index(name) > file.names.index(file.noun):
            facts.setdefault(group, {})[inside] = value
        else:
            facts[name] = value
    return facts


def _file(path: Path) -> _File | None:
    return _File(path) if path.exists() else None


def _set(file: _File, row: int) -> dict[str, float]:
    """Return what `for_each` set: the columns between the study and the number."""
    of = range(file.names.index("study") + 1, file.names.index(file.noun))
    cells = {file.names[c]: file.rows[row][c] for c in of if file.names[c] != "kind"}
    return {name: float(cell) for name, cell in cells.items() if cell}


def _result(files: Mapping[str, _File], summary: _File | None, study: str, number: str) -> tuple[Result, dict[str, Any]]:
    main = next(iter(files.values()))
    facts = _facts(summary, next(iter(summary.rows_of(study, number)), None) if summary else None)
    whole = {name: int(facts[name]) for name in ("period",) if name in facts}
    list_, main_key, _ = KINDS[main.noun]
    own = [facts["over"]] if "over" in facts else []
    if "amplitude" in main.names and main.noun in ("search", "curve"):  # those that were varied come before
        own = main.names[: main.names.index("amplitude")]
    tables = {
        key: _table(file, file.rows_of(study, number), own)
        for key, file in zip([main_key, *list(files)[1:]], files.values(), strict=True)
    }
    of = summary or main
    row = next(iter(of.rows_of(study, number)))
    about: dict[str, Any] = {key: facts.pop(key, "") for key in ("study", "kind", "status", "doubt")}
    about |= {"study": study, "noun": main.noun, "list": list_, "stop": facts.pop("stop", {}), "set": _set(of, row)}
    units = dict(zip(of.names, of.units, strict=True))
    about["set_units"] = {name: units[name] for name in about["set"] if units[name] not in ("", "-")}
    for name in (*about["set"], main.noun):
        facts.pop(name, None)
    parent = facts.pop("parent", None)
    about["facts"] = facts | whole
    return result(about, tables, {}), {"list": list_, "parent": 0 if parent is None else int(number) - int(parent)}


def of_tables(path: Path) -> Results | None:
    """Read a file and those next to it; None if it holds no results."""
    main = _File(path)
    if "study" not in main.names or not main.noun:
        return None
    for key in (*FURTHER, "summary"):
        if path.name.endswith(f".{key}.csv"):
            raise ValueError(f"{path} has the {key} of {path.name.removesuffix(f'.{key}.csv')}.csv, which is to be named")
    files = {"": main}
    for key in FURTHER:
        further = _file(path.with_name(f"{path.stem}.{key}.csv"))
        if further is not None:
            files[key] = further
    summary = _file(path.with_name(f"{path.stem}.summary.csv"))
    of = summary or main
    numbers = zip(of.cells("study", range(len(of.rows))), of.cells(of.noun, range(len(of.rows))), strict=True)
    found = [_result(files, summary, *number) for number in dict.fromkeys(numbers)]
    results = [each for each, _ in found]
    link(results, [place["list"] for _, place in found], [place["parent"] for _, place in found])
    unit = next((main.units[i] for i, name in enumerate(main.names) if name == "frequency"), "")
    header: dict[str, Any] = {"program": "", "scene_hash": "", "title": "", "frequency_unit": unit, "reduction": {}}
    return Results(header | {"format": KINDS[main.noun][2]}, results)
