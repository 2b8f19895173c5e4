"""Names that are items and attributes."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from typing import Any


class Named:
    """Has each of its named items as an attribute: ``table["amplitude"]`` is ``table.amplitude``."""

    __slots__ = ()

    def _names(self) -> Iterable[str]:
        """Return the names of the items."""
        raise NotImplementedError

    def __getitem__(self, name: Any, /) -> Any:
        raise NotImplementedError

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(str(error.args[0])) from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._names()]


def nearest(name: str, known: Iterable[str]) -> str:
    """Return "; the nearest is 'name'", or "" if no known name is similar."""
    near = difflib.get_close_matches(name, list(known), 1)
    return f"; the nearest is {near[0]!r}" if near else ""
