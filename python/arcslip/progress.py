"""Progress of computations: a bar, a callable of the user's, and the logger "arcslip"."""

from __future__ import annotations

import logging
import math
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any, Protocol

#: True for a bar, or a callable that is given the progress as a dict, and that ends the computation by returning False.
Progress = bool | Callable[[dict[str, Any]], object]
Report = Callable[[dict[str, Any]], object]

LOGGER = logging.getLogger("arcslip")
LOGGER.addHandler(logging.NullHandler())

#: Where the output is no terminal, a line is written each time that this share of the work more is done.
LINE_EVERY = 0.1


class Bar(Protocol):
    """What shows a share, from 0 to 1, and a text."""

    def show(self, share: float, text: str) -> None: ...
    def close(self) -> None: ...


class TqdmBar:
    """A bar of tqdm, in terminals and in notebooks."""

    def __init__(self, title: str) -> None:
        from tqdm.auto import tqdm  # type: ignore[import-untyped]

        self._bar = tqdm(total=1.0, desc=title, bar_format="{l_bar}{bar}| {elapsed}<{remaining}{postfix}")

    def show(self, share: float, text: str) -> None:
        self._bar.n = share
        self._bar.set_postfix_str(text)

    def close(self) -> None:
        self._bar.close()


class TextBar:
    """A line on the standard error, rewritten in terminals."""

    def __init__(self, title: str) -> None:
        self._title = title
        self._width = 0
        self._next = 0.0

    def show(self, share: float, text: str) -> None:
        line = f"{self._title}: {100 * share:3.0f} %  {text}"
        if sys.stderr.isatty():
            sys.stderr.write("\r" + line.ljust(self._width))
            self._width = len(line)
        elif share >= self._next:
            sys.stderr.write(line + "\n")
            self._next = share + LINE_EVERY
        sys.stderr.flush()

    def close(self) -> None:
        if self._width > 0:
            sys.stderr.write("\n")
            sys.stderr.flush()


def bar(title: str) -> Bar:
    """Return a bar of tqdm where it is installed, else one of plain text."""
    try:
        return TqdmBar(title)
    except ImportError:
        return TextBar(title)


def share_done(now: Mapping[str, Any]) -> float:
    """Return the share of a study that is done, from 0 to 1; what is not known counts as nothing."""
    of_branch = now["share_done"] if math.isfinite(now["share_done"]) else 0.0
    share: float = min(max((now["branch"] + of_branch) / max(now["branches"], 1), 0.0), 1.0)
    return share


def summary(now: Mapping[str, Any]) -> str:
    """Return the progress in words: "branch 3/12, 45 points"."""
    words = [f"{now['item']} {min(now['branch'] + 1, max(now['branches'], 1))}/{max(now['branches'], 1)}"]
    if now["order"] > 0:
        words.append(f"order {now['order']}")
    if now["phase"]:
        words.append(now["phase"])
    words.append(f"{now['points']} {now['counted']}")
    if math.isfinite(now["best"]):
        words.append(f"best {now['best']:.5g} m")
    return ", ".join(words)


@contextmanager
def reporting(progress: Progress | None, title: str) -> Iterator[Report | None]:
    """Log the begin and the end of a computation, and give what reports its progress.

    Raises
    ------
    TypeError
        If `progress` is neither a bool nor callable.
    """
    if progress is not None and not isinstance(progress, bool) and not callable(progress):
        raise TypeError(f"found progress={progress!r}, must be True or callable")
    shown = bar(title) if progress is True else None
    own = progress if callable(progress) else None

    def report(now: dict[str, Any]) -> object:
        LOGGER.debug("%s: %s", title, summary(now))
        if shown is not None:
            shown.show(share_done(now), summary(now))
        return None if own is None else own(now)

    LOGGER.info("%s: computation begins", title)
    begin = time.perf_counter()
    try:
        is_reported = shown is not None or own is not None or LOGGER.isEnabledFor(logging.DEBUG)
        yield report if is_reported else None
        if shown is not None:
            shown.show(1.0, "")
    finally:
        if shown is not None:
            shown.close()
        LOGGER.info("%s: computation ended after %.1f s", title, time.perf_counter() - begin)
