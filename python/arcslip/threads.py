"""How many threads a computation uses."""

from __future__ import annotations

import os


def available() -> int:
    """Return the number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def checked(threads: int | None) -> int:
    """Return the threads that are asked for, by default all that are available.

    Raises
    ------
    ValueError
        If they are fewer than one.
    """
    if threads is None:
        return available()
    if threads < 1:
        raise ValueError(f"found threads={threads}, must be at least 1")
    return threads
