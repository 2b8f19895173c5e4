"""Cells of files as columns."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..tables import as_array


def column(values: Sequence[Any]) -> Any:
    """Return the cells of a column, with None where they are missing, as an array of the type that they have."""
    there = {type(value) for value in values if value is not None}
    if there <= {float, int, bool}:
        if len(there) == 1 and None not in values:
            return np.array(values, dtype=there.pop())
        return np.array([np.nan if value is None else value for value in values], dtype=float)
    return as_array(values, "text" if there == {str} else "value")


def with_arrays(value: Any) -> Any:
    """Return a value with lists of numbers as arrays."""
    if isinstance(value, dict):
        return {key: with_arrays(each) for key, each in value.items()}
    if not isinstance(value, list):
        return value
    if any(isinstance(each, float) for each in value) and all(isinstance(each, float | None) for each in value):
        return np.array([np.nan if each is None else each for each in value])
    return [with_arrays(each) for each in value]
