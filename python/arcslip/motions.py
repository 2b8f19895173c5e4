"""Motions over a period, as the histories of results have them."""

from __future__ import annotations

import math
import operator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .tables import Row, Table

if TYPE_CHECKING:
    from .results import Result

#: Instants at the ends of a period differ from them by rounding, relative to the period.
ROUNDING = 1e-9
#: Instants of a period: a computation of more would take minutes, which nothing ends.
MOST_STEPS = 1_000_000


class Loop(NamedTuple):
    """A hysteresis loop: the force of an element over its displacement, in the order of time.

    Attributes
    ----------
    displacement : array, shape (instants,)
        m
    force : array, shape (instants,)
        N, against the motion.
    """

    displacement: NDArray[np.float64]
    force: NDArray[np.float64]


class Motion(Table):
    """The instants of a period, with the columns of the history that it is a part of.

    ``motion.time``, ``motion.displacement`` and ``motion.velocity`` are those of the response, in s, m and m/s;
    ``motion.elements.damper.force`` and so on those of elements, where the history has them.

    Attributes
    ----------
    period : float
        s
    """

    def __init__(self, instants: Table, period: float) -> None:
        names = instants.columns
        super().__init__(names, len(instants), lambda i: instants[names[i]], instants.units)
        self.period = period

    @property
    def loops(self) -> dict[str, Loop]:
        """The loops of the elements by their names, of further directions of an element by "element.direction"."""
        loops = {}
        for column in self.columns:
            place, _, quantity = column.rpartition(".")
            if quantity == "force" and f"{place}.displacement" in self.columns:
                name = place.removeprefix("elements.").replace(".directions.", ".")
                loops[name] = Loop(self[f"{place}.displacement"], self[column])
        return loops

    def __reduce__(self) -> Any:
        return Motion, (self[:], self.period)


def motion_of(result: Result, of: Any, steps: int | None) -> Motion:
    """Return the motion of a result, at a row of a branch or over a period of a history.

    Raises
    ------
    ValueError
        If the result has no motions, or if the row is that of another result.
    TypeError
        If `of` is neither an index nor a row of a branch.
    IndexError
        If there is no such point, or if the history has no such period.
    """
    history = result.tables.get("history")
    if history is None:
        return _at_row(result, of, 1000 if steps is None else steps)
    if steps is not None:
        raise ValueError(f"found steps={steps}, must be given to the study of kind {result.kind!r}")
    if len(history) == 0:
        raise ValueError(f"the {result.noun} has no history: {result.stop.get('message', result.status)}")
    return _of_period(result, history, of)


def _at_row(result: Result, of: Any, steps: int) -> Motion:
    if isinstance(of, Row):
        table, row = of._place()
    else:
        if not isinstance(of, (int, np.integer)):
            raise TypeError(f"found {of!r}, must be the index of a point, or a row of events")
        if not -len(result.main) <= of < len(result.main):
            raise IndexError(f"found point {of}, the {result.noun} has {len(result.main)}")
        table, row = result.main, range(len(result.main))[of]
    names = [name for name, each in result.tables.items() if each is table]
    if not names:
        raise ValueError(f"found a row that is not of this {result.noun}")
    if not 1 <= steps <= MOST_STEPS:
        raise ValueError(f"found steps={steps}, must be from 1 to {MOST_STEPS}")
    history = result._history(list(result.tables).index(names[0]), row, steps) if result._history else None
    if history is None:
        raise ValueError(
            f"found a {result.noun} of kind {result.kind!r} without motions: only those of branches and modes by harmonic"
            " balance are kept, and not in files; scene.point(frequency=...) and scene.time(frequency=...) compute others"
        )
    return Motion(history, float(history["time"][-1]))


def _of_period(result: Result, history: Table, of: Any) -> Motion:
    time = history["time"]
    period = result.facts["period"] * math.tau / result.facts["omega"]
    count = max(1, round((time[-1] - time[0]) / period))
    try:
        number = range(count)[operator.index(of)]
    except IndexError:
        raise IndexError(f"found period {of}, the history has {count}") from None
    begin, end = time[0] + period * (number - ROUNDING), time[0] + period * (number + 1 + ROUNDING)
    return Motion(history[np.searchsorted(time, begin) : np.searchsorted(time, end, "right")], period)
