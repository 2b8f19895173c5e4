"""Scenes and results as HTML, for notebooks. All texts are escaped: names and titles may hold anything."""

from __future__ import annotations

import html
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ..results import Result, Results
    from ..scene import Scene
    from ..tables import Table

#: Rows and columns that a table shows; of more, the first and the last rows.
MOST_ROWS, MOST_COLUMNS = 10, 8
MOST_RESULTS, MOST_PARAMETERS = 20, 30


def escaped(value: Any) -> str:
    """Return a value as HTML; characters that cannot be seen, such as those that reverse a text, as their codes."""
    text = f"{value:.6g}" if isinstance(value, float) else str(value)
    shown = "".join(each if each.isprintable() else each.encode("unicode_escape", "replace").decode() for each in text)
    return html.escape(shown)


def grid(head: Sequence[str], rows: Iterable[Sequence[Any]], caption: str = "") -> str:
    """Return a table of values under titles."""

    def line(tag: str, values: Iterable[Any]) -> str:
        return f"<tr>{''.join(f'<{tag}>{escaped(value)}</{tag}>' for value in values)}</tr>"

    body = "".join(line("td", row) for row in rows)
    title = f"<caption>{escaped(caption)}</caption>" if caption else ""
    return f"<table>{title}<thead>{line('th', head)}</thead><tbody>{body}</tbody></table>"


def of_table(table: Table, caption: str = "") -> str:
    """Return the first and last rows of a table, with the first of its columns of numbers and texts."""
    names = [name for name in table.columns if table[name].ndim == 1 and table[name].dtype.kind != "O"][:MOST_COLUMNS]
    titles = [f"{name} ({table.units[name]})" if table.units.get(name, "-") != "-" else name for name in names]
    count = len(table)
    half = MOST_ROWS // 2
    shown = range(count) if count <= MOST_ROWS else [*range(half), *range(count - half, count)]
    rows: list[Sequence[Any]] = [[i, *(table[name][i] for name in names)] for i in shown]
    if count > MOST_ROWS:
        rows.insert(half, ["..."] * (len(names) + 1))
    return grid(["", *titles], rows, caption)


def of_result(result: Result) -> str:
    """Return what a result is, and its main table."""
    words = [repr(result), result.stop.get("message", ""), result.doubt]
    return of_table(result.main, "; ".join(word for word in words if word))


def of_results(results: Results) -> str:
    """Return a line for each result."""
    names = list(dict.fromkeys(name for result in results for name in result.set))
    units = {name: unit for result in results for name, unit in result.set_units.items() if unit != "-"}
    head = ["", "study", "result", *(f"{name} ({units[name]})" if units.get(name) else name for name in names), "rows", "status"]
    rows = [
        [i, result.study, result.noun, *(result.set.get(name, "") for name in names), len(result), result.status]
        for i, result in enumerate(results[:MOST_RESULTS])
    ]
    more = f"; {len(results) - MOST_RESULTS} more" if len(results) > MOST_RESULTS else ""
    return grid(head, rows, f"results of {results.title!r}: {len(results)}{more}")


def of_scene(scene: Scene) -> str:
    """Return the studies and the parameters of a scene."""
    values = list(scene.parameters.items())
    more = f"; {len(values) - MOST_PARAMETERS} more" if len(values) > MOST_PARAMETERS else ""
    rows = [(name, float(value), value.unit, value.help) for name, value in values[:MOST_PARAMETERS]]
    return (
        f"<p>{escaped(repr(scene))}</p>"
        + grid(["study", "kind"], scene.studies)
        + grid(["parameter", "value", "unit", "meaning"], rows, f"{len(values)} parameters{more}")
    )
