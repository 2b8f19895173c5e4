"""Figures of results with matplotlib, as the command draws them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from .. import _core
from ..extras import required
from .backend import draw_figure, pixels, plain, set_axis

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ..optimum import Optimum
    from ..results import Result
    from ..tables import Table

#: The columns of the axes for kinds of studies; of others they are those of a response. "over" is the parameter that a branch
#: is over.
AXES = {
    "trace": ("over", "amplitude"),
    "peaks": ("over", "amplitude"),
    "folds": ("frequency", "over"),
    "bifurcations": ("frequency", "over"),
    "modes": ("amplitude", "frequency"),
    "point": ("time", "displacement"),
    "time": ("time", "displacement"),
    "accuracy": ("seconds_per_point", "error"),
    "optimum": ("over", "amplitude"),
}
RESPONSE = ("frequency", "amplitude")
#: Kinds whose amplitudes are always on a logarithmic axis, so that no resonance dwarfs the others.
LOGARITHMIC = ("frf", "sweep")
#: Columns that are never on one.
LINEAR = ("frequency", "omega", "damping_ratio", "time", "angle")
#: A legend of more entries stands at the side of a figure of its own.
MOST_INSIDE = 5


class Part(NamedTuple):
    """A part of a branch of one stability, between jumps."""

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    unstable: bool


def draw(results: Sequence[Result], ax: Axes | None, x: str | None, y: str | None) -> Axes:
    """Draw results of one kind; those with the same values of `for_each` have the same colour.

    Raises
    ------
    ValueError
        If there is nothing to draw, if the results are of several kinds, or if a column is not one of numbers.
    KeyError
        If there is no such column.
    """
    pyplot = required("matplotlib.pyplot", "plot")
    results = _with_rows(results)
    default = _axes(results[0])
    columns = x or default[0], y or default[1]
    for result in results:
        for name in columns:
            _numbers(result.main, name)  # no figure is left where a column is refused
    drawn: Axes = pyplot.subplots(layout="constrained")[1] if ax is None else ax
    if x is None and y is None and results[0].noun == "comparison":
        _draw_comparison(drawn, results)
    elif x is None and y is None and results[0].noun == "search":
        _draw_optima(drawn, cast("Sequence[Optimum]", results))
    else:
        _draw_lines(drawn, results, *columns)
    handles, labels = drawn.get_legend_handles_labels()
    before = drawn.get_legend()
    title = before.get_title().get_text() if before is not None else ""
    if ax is None and len(handles) > MOST_INSIDE:
        drawn.legend(loc="upper left", bbox_to_anchor=(1, 1), title=title)
    elif labels:
        drawn.legend(title=title)
    return drawn


def _with_rows(results: Sequence[Result]) -> list[Result]:
    kinds = list(dict.fromkeys((result.kind, result.noun) for result in results))
    if len(kinds) > 1:
        raise ValueError(f"found results of the kinds {[kind for kind, _ in kinds]}, must be of one; name a study")
    there = [result for result in results if len(result) > 0]
    if not there:
        why = results[0].stop.get("message", results[0].status) if results else "no results"
        raise ValueError(f"nothing to plot: {why}")
    return there


def _axes(result: Result) -> tuple[str, str]:
    """Return the columns of the axes."""
    over = result.facts.get("over") or result.facts.get("along") or result.main.columns[0]
    x, y = AXES.get(result.kind, RESPONSE)
    return (over if x == "over" else x), (over if y == "over" else y)


def _numbers(table: Table, name: str) -> NDArray[np.float64]:
    values = table[name]
    if not isinstance(values, np.ndarray) or values.ndim != 1 or values.dtype.kind not in "biuf":
        raise ValueError(f"found the column {name!r}, must be one of numbers")
    return values.astype(np.float64, copy=False)


def _at_events(result: Result, x: str, y: str) -> NDArray[np.float64] | None:
    """Return two columns of the points at events, shape (2, events), or None where there are no events that have them."""
    events = result.tables.get("events")
    if events is None or len(events) == 0:
        return None
    names = [f"point.{name}" if f"point.{name}" in events.columns else name for name in (x, y)]
    return np.stack([_numbers(events, name) for name in names]) if set(names) <= set(events.columns) else None


def _ends(result: Result, x: str, y: str, points: NDArray[Any], unstable: NDArray[np.bool_]) -> dict[int, NDArray[Any]]:
    """Return where a part ends and the next one begins, shape (2, 2), by the index of the first point of the next one."""
    ends = {}
    for i in (np.flatnonzero(unstable[1:] != unstable[:-1]) + 1).tolist():
        middle = points[:, i - 1 : i + 1].mean(axis=1)
        ends[i] = np.stack([middle, middle], axis=1)
    at, after_jump = _at_events(result, x, y), _at_events(result, f"{x}_after", f"{y}_after")
    if at is None or "after" not in result.events:
        return ends
    for k, i in enumerate((result.events.after + 1).tolist()):
        if after_jump is not None:
            ends[i] = np.stack([at[:, k], after_jump[:, k]], axis=1)
        elif i in ends:
            ends[i] = np.stack([at[:, k], at[:, k]], axis=1)
    return ends


def _parts(result: Result, x: str, y: str) -> Iterator[Part]:
    """Return the points of a branch in parts of one stability, which meet at the events between them, or half way.

    A sweep has parts between its jumps, which do not meet.
    """
    table = result.main
    points = np.stack([_numbers(table, x), _numbers(table, y)])
    unstable = _numbers(table, "stable") == 0 if "stable" in table.columns else np.zeros(len(table), dtype=np.bool_)
    ends = _ends(result, x, y, points, unstable)
    begin, first = 0, points[:, :0]
    for i in sorted(i for i in ends if 0 < i < len(table)):
        part = np.concatenate([first, points[:, begin:i], ends[i][:, :1]], axis=1)
        yield Part(part[0], part[1], bool(unstable[begin]))
        begin, first = i, ends[i][:, 1:]
    part = np.concatenate([first, points[:, begin:]], axis=1)
    yield Part(part[0], part[1], bool(unstable[begin]))


def _draw_lines(ax: Axes, results: Sequence[Result], x: str, y: str) -> None:
    lines: dict[tuple[tuple[str, Any], ...], list[Result]] = {}
    for result in results:
        line = _line(result)
        if result.noun == "response" and line in lines:  # another one at the same frequency
            line = (*line, ("response", len(lines)))
        lines.setdefault(line, []).append(result)
    parameters = list(dict.fromkeys(name for result in results for name in result.set)) if len(lines) > 1 else []
    data = {
        "columns": [_column(results, name) for name in (x, y)],
        "lines": [_line_data(of, x, y, is_labelled=len(lines) > 1) for of in lines.values()],
        "parameters": parameters,
    }
    draw_figure(ax, _core.figure(data, *pixels(ax)))


def _column(results: Sequence[Result], name: str) -> dict[str, str]:
    words, unit = results[0]._words(name)
    scale = "percent" if unit == "%" else "logarithmic" if _is_logarithmic(results, name) else "linear"
    return {"words": words, "unit": unit, "scale": scale}


def _line_data(results: Sequence[Result], x: str, y: str, *, is_labelled: bool) -> dict[str, Any]:
    """Return the results that share a line as data of a figure: parts, and events but for those that curves are made of."""
    parts = [part for result in results for part in _parts(result, x, y)]
    marks: dict[str, list[NDArray[np.float64]]] = {}
    for result in results:
        if "kind" not in result.tables.get("events", ()):
            continue
        kinds = result.events.kind
        for places in (_at_events(result, x, y), _at_events(result, f"{x}_after", f"{y}_after")):
            if places is None:
                continue
            for kind in dict.fromkeys(kinds.tolist()):
                if kind != result.facts.get("of"):
                    marks.setdefault(kind, []).append(places[:, kinds == kind])
    label = _label(results[0])
    if results[0].noun == "response":
        stable = {True: "stable", False: "unstable"}.get(results[0].facts.get("stable", ""), "")
        amplitude = results[0].facts.get("amplitude", 0.0)
        label = ", ".join(word for word in (label, f"{1e3 * amplitude:.4g} mm", stable) if word)
    return {
        "label": label if is_labelled else "",
        "parts": [np.stack([part.x, part.y], axis=1) for part in parts],
        "unstable": [part.unstable for part in parts],
        "marks": {kind: np.ascontiguousarray(np.concatenate(places, axis=1).T) for kind, places in marks.items()},
    }


def _is_logarithmic(results: Sequence[Result], name: str) -> bool:
    if name in LINEAR or name.endswith("_percent"):
        return False
    values = np.concatenate([_numbers(result.main, name) for result in results])
    values = values[np.isfinite(values)]
    if name == "amplitude" and results[0].kind in LOGARITHMIC:
        return bool((values > 0).any())
    return bool(len(values) > 0 and values.min() > 0 and values.max() > 10 * values.min())


def _line(result: Result) -> tuple[tuple[str, Any], ...]:
    """Return what distinguishes the line of a result: what `for_each` sets, the kind of a curve, the direction of a sweep."""
    return (*result.set.items(), *((name, result.facts[name]) for name in ("of", "direction") if name in result.facts))


def _label(result: Result) -> str:
    """Return the values that distinguish a line: "3 N, 0.1 N s/m"."""
    words = [
        value.replace("_", " ") if isinstance(value, str) else f"{value:.6g} {result.set_units.get(name, '')}".rstrip(" -")
        for name, value in _line(result)
    ]
    return ", ".join(words)


def _draw_optima(ax: Axes, results: Sequence[Optimum]) -> None:
    """Draw the amplitude over the one parameter that was varied, with its tolerance ranges, or over the evaluations."""
    for i, optimum in enumerate(results):
        one = optimum.varied[0] if len(optimum.varied) == 1 else None
        amplitude = _numbers(optimum.course, "amplitude")
        at = np.arange(1, len(amplitude) + 1.0) if one is None else _numbers(optimum.course, one)
        colour = f"C{i % 10}"
        ax.plot(at, amplitude, ".", color=colour, label=plain(_label(optimum)) or "designs evaluated")
        if one is not None and one in optimum.design:
            ax.plot(optimum.design[one], optimum.amplitude, "*", color=colour, markersize=11, label="_" if i else "optimum")
            _draw_ranges(ax, optimum, one, colour, is_labelled=i == 0)
        elif optimum.design:
            ax.axhline(optimum.amplitude, color=colour, linewidth=0.8, label="_" if i else "optimum")
    amplitudes = _column(results, "amplitude")
    if one is None:
        ax.set_xlabel("evaluation")
    axes = [_column(results, one) if one else {"words": "", "unit": "", "scale": "linear"}, amplitudes]
    values = np.stack([_numbers(results[0].main, one or "amplitude"), _numbers(results[0].main, "amplitude")], axis=1)
    lines = [{"label": "", "parts": [values], "unstable": [False], "marks": {}}]
    figure = _core.figure({"columns": axes, "lines": lines, "parameters": []}, *pixels(ax))
    if one is not None:
        set_axis(ax, "x", figure["x"])
    set_axis(ax, "y", figure["y"])


def _draw_ranges(ax: Axes, optimum: Optimum, parameter: str, colour: str, *, is_labelled: bool) -> None:
    """Draw the tolerance ranges, the widest first, and the amplitudes at their ends where neither a bound nor a limit is."""
    for each in reversed(optimum.ranges.get(parameter, ())):
        label = f"within {100 * each.share:g} %" if is_labelled else "_"
        ax.axvspan(each.lower, each.upper, color=colour, alpha=0.12, linewidth=0, label=label)
        for end, is_cut in (
            (each.lower, each.lower_is_bound or each.lower_is_limit),
            (each.upper, each.upper_is_bound or each.upper_is_limit),
        ):
            if not is_cut:
                ax.plot(end, (1 + each.share) * optimum.amplitude, ".", color=colour, label="_")


def _draw_comparison(ax: Axes, results: Sequence[Result]) -> None:
    """Draw the error of each trial over its time for a point; the best ones are joined."""
    for result in results:
        trials = result.trials
        seconds, error = _numbers(trials, "seconds_per_point"), np.maximum(_numbers(trials, "error"), 1e-16)
        for i, method in enumerate(dict.fromkeys(trials.method.tolist())):
            rows = trials.method == method
            ax.loglog(seconds[rows], error[rows], "o", color=f"C{i}", markersize=4, label=method)
        best = np.flatnonzero(trials.best)
        best = best[np.argsort(seconds[best])]
        ax.loglog(seconds[best], error[best], "-", color="0.5", linewidth=1, zorder=1, label="best")
    ax.set_xlabel("time for a point (s)")
    ax.set_ylabel("relative error of the highest peak")
