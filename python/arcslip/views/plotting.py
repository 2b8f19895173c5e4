"""Figures of results with matplotlib, as the command draws them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from ..extras import required
from .marks import MARKS

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
#: More settings than this have a bar of colours in place of a legend.
MOST_LABELS = 10


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
    count = len(drawn.get_legend_handles_labels()[1])
    if ax is None and count > MOST_INSIDE:
        drawn.legend(loc="upper left", bbox_to_anchor=(1, 1))
    elif count > 0:
        drawn.legend()
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
    colours = _colours(ax, results)
    labelled: set[object] = set()
    explained: dict[str, dict[str, Any]] = {}
    for result in results:
        line = _line(result)
        label = "_" if line in labelled or not 1 < len(colours) <= MOST_LABELS else _label(result)
        labelled.add(line)
        for part in _parts(result, x, y):
            style: dict[str, Any] = {"linestyle": "--" if part.unstable else "-", "linewidth": 1.2}
            ax.plot(part.x, part.y, color=colours[line], label=label, **style)
            label = "_"
            if part.unstable:
                explained["unstable"] = style
        explained |= _mark_events(ax, result, x, y, colours[line])
    for words, style in explained.items():
        ax.plot([], [], color="0.3", label=words, **style)
    for axis, name in (("x", x), ("y", y)):
        _set_axis(ax, axis, results, name)


def _mark_events(ax: Axes, result: Result, x: str, y: str, colour: Any) -> dict[str, dict[str, Any]]:
    """Mark the events of kinds that have a mark, but for the ends of a curve of their own kind; return words and styles."""
    at, after_jump = _at_events(result, x, y), _at_events(result, f"{x}_after", f"{y}_after")
    if at is None or "kind" not in result.events:
        return {}
    kinds = result.events.kind
    styles: dict[str, dict[str, Any]] = {}
    for kind in dict.fromkeys(kinds.tolist()):
        if kind not in MARKS or kind == result.facts.get("of"):
            continue
        mark = MARKS[kind]
        styles[mark.words] = {
            "linestyle": "none",
            "marker": mark.marker,
            "fillstyle": "full" if mark.filled else "none",
            "markersize": 6,
        }
        for places in (at, after_jump):
            if places is not None:
                ax.plot(*places[:, kinds == kind], color=colour, label="_", **styles[mark.words])
    return styles


def _set_axis(ax: Axes, axis: str, results: Sequence[Result], name: str) -> None:
    ax.set(**{f"{axis}label": _plain(results[0].labels.get(name, name))})
    if _is_logarithmic(results, name):
        ax.set(**{f"{axis}scale": "log"})
    formatter = getattr(ax, f"{axis}axis").get_major_formatter()
    if hasattr(formatter, "set_powerlimits"):
        formatter.set_powerlimits((-3, 4))


def _plain(text: str) -> str:
    """Return a text in which matplotlib finds no formulas."""
    return text.replace("$", r"\$")


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
    parts = []
    for name, value in _line(result):
        if isinstance(value, str):
            parts.append(MARKS[value].words if value in MARKS else value)
        else:
            parts.append(f"{name} = {value:.6g} {result.set_units.get(name, '')}".rstrip(" -"))
    return _plain(", ".join(parts))


def _colours(ax: Axes, results: Sequence[Result]) -> dict[tuple[tuple[str, Any], ...], Any]:
    """Return a colour for each line; for many values of one parameter along a bar of colours."""
    lines = list(dict.fromkeys(_line(result) for result in results))
    if len(lines) <= MOST_LABELS or any(len(line) != 1 or isinstance(line[0][1], str) for line in lines):
        return {line: f"C{i % 10}" for i, line in enumerate(lines)}
    colours, cm = required("matplotlib.colors", "plot"), required("matplotlib.cm", "plot")
    name = lines[0][0][0]
    values = [line[0][1] for line in lines]
    decades = min(values) > 0 and max(values) > 10 * min(values)
    norm = (colours.LogNorm if decades else colours.Normalize)(min(values), max(values))
    scale = cm.ScalarMappable(norm, "viridis")
    unit = results[0].set_units.get(name, "")
    ax.figure.colorbar(scale, ax=ax, label=_plain(f"{name} ({unit})" if unit not in ("", "-") else name))
    return {line: scale.to_rgba(value) for line, value in zip(lines, values, strict=True)}


def _draw_optima(ax: Axes, results: Sequence[Optimum]) -> None:
    """Draw the amplitude over the one parameter that was varied, with its tolerance ranges, or over the evaluations."""
    for i, optimum in enumerate(results):
        one = optimum.varied[0] if len(optimum.varied) == 1 else None
        amplitude = _numbers(optimum.course, "amplitude")
        at = np.arange(1, len(amplitude) + 1.0) if one is None else _numbers(optimum.course, one)
        colour = f"C{i % 10}"
        ax.plot(at, amplitude, ".", color=colour, label=_label(optimum) or "designs evaluated")
        if one is not None and one in optimum.design:
            ax.plot(optimum.design[one], optimum.amplitude, "*", color=colour, markersize=11, label="_" if i else "optimum")
            _draw_ranges(ax, optimum, one, colour, is_labelled=i == 0)
        elif optimum.design:
            ax.axhline(optimum.amplitude, color=colour, linewidth=0.8, label="_" if i else "optimum")
    if one is None:
        ax.set_xlabel("evaluation")
    else:
        _set_axis(ax, "x", results, one)
    _set_axis(ax, "y", results, "amplitude")


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
