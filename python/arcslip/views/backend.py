"""Figures, `results::Figure` of the library, drawn by matplotlib."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ..extras import required

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: The markers of shapes; those of filled ones are the same.
MARKERS = {
    "plus": "+",
    "cross": "x",
    "star": "*",
    "square": "s",
    "circle": "o",
    "triangle": "^",
    "inverted_triangle": "v",
    "diamond": "D",
    "pentagon": "p",
}
#: Of texts next to places.
TEXT_SIZE = 8.0  # points
#: The width of a character and the height of a line, in sizes of the text.
CHARACTER, LINE = 0.55, 1.25


def plain(text: str) -> str:
    """Return a text in which matplotlib finds no formulas."""
    return text.replace("$", r"\$")


def pixels(ax: Axes) -> tuple[int, int]:
    """Return the size of axes, in pixels of 1/96 inch."""
    box, scale = ax.get_window_extent(), 96 / ax.figure.dpi
    return max(int(scale * box.width), 100), max(int(scale * box.height), 80)


def set_axis(ax: Axes, name: str, axis: Mapping[str, Any]) -> None:
    """Give an axis, "x" or "y", its label and its scale; its numbers are `factor` times those of the data."""
    ticker = required("matplotlib.ticker", "plot")
    ax.set(**{f"{name}label": plain(axis["label"])})
    if axis["logarithmic"]:
        ax.set(**{f"{name}scale": "log"})
    factor = axis["factor"]
    of = getattr(ax, f"{name}axis")
    of.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{factor * value:.6g}"))

    def between_decades(value: float, _: int) -> str:
        """Return the number of a minor tick: where there are few decades of 2 and 5, where there is not one of all."""
        lower, upper = sorted(of.get_view_interval())
        decades = math.log10(upper / lower) if lower > 0 else math.inf
        digit = round(value / 10 ** math.floor(math.log10(value) + 1e-9)) if value > 0 else 0
        return f"{factor * value:.6g}" if decades < 0.7 or (decades < 2.5 and digit in (2, 5)) else ""

    of.set_minor_formatter(ticker.FuncFormatter(between_decades) if axis["logarithmic"] else ticker.NullFormatter())


def draw_figure(ax: Axes, figure: Mapping[str, Any]) -> None:
    """Draw a figure: its curves, dashed where they are unstable, its fills, marks and texts, and a key of them."""
    for fill in figure["fills"]:
        for strip in fill["strips"]:
            x, lower, upper = zip(*strip, strict=True)
            ax.fill_between(x, lower, upper, color=fill["colour"], alpha=fill["opacity"], linewidth=0, label="_")
    for curve in figure["curves"]:
        for first, last, unstable in curve["stretches"]:
            style = "--" if unstable else "-"
            points = curve["x"][first:last], curve["y"][first:last]
            ax.plot(*points, color=curve["colour"], linestyle=style, linewidth=1.2, label="_")
    for shape, colour, x, y in figure["symbols"]:
        ax.plot([x], [y], color=colour, label="_", **_marker(shape))
    for text, colour, x, y, right, up, alignment in figure["texts"]:
        ax.annotate(
            plain(text),
            (x, y),
            xytext=(TEXT_SIZE * CHARACTER * right, TEXT_SIZE * LINE * up),
            textcoords="offset points",
            color=colour,
            fontsize=TEXT_SIZE,
            horizontalalignment={-1: "right", 0: "center", 1: "left"}[alignment],
            verticalalignment="center",
            annotation_clip=True,
        )
    for name in ("x", "y"):
        set_axis(ax, name, figure[name])
    if figure["note"]:
        ax.set_title(plain(figure["note"]), fontsize=TEXT_SIZE)
    _add_key(ax, figure)


def _marker(shape: str) -> dict[str, Any]:
    filled = shape.startswith("filled_")
    marker = MARKERS[shape.removeprefix("filled_")]
    return {"linestyle": "none", "marker": marker, "fillstyle": "full" if filled else "none", "markersize": 5}


def _add_key(ax: Axes, figure: Mapping[str, Any]) -> None:
    """Add what the entries of the legend stand for, and a legend that has its title."""
    for entry in figure["key"]:
        label = plain(entry["text"])
        if entry["of"] == "mark":
            ax.plot([], [], color=entry["colour"], label=label, **_marker(entry["shape"]))
        elif entry["of"] == "fill":
            ax.fill_between([], [], [], color=entry["colour"], alpha=entry["opacity"], linewidth=0, label=label)
        else:
            style = "--" if entry["of"] == "unstable" else "-"
            ax.plot([], [], color=entry["colour"], linestyle=style, linewidth=1.2, label=label)
    if figure["key"]:
        ax.legend(title=plain("\n".join(figure["key_title"])))
