"""Numbers with units, and facts by their names."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Self

from .names import Named, nearest


class Quantity(float):
    """A number that knows its unit.

    Attributes
    ----------
    unit : str
        "N", "N s/m"; "-" for a pure number, "" where it is not known, as in results that were loaded.
    """

    unit: str

    def __new__(cls, value: float, **about: Any) -> Self:
        made = super().__new__(cls, value)
        made.__dict__.update(about)
        return made

    def __getnewargs_ex__(self) -> tuple[tuple[float], dict[str, Any]]:
        return (float(self),), dict(self.__dict__)

    def __repr__(self) -> str:
        number = float.__repr__(self)
        return number if self.unit in ("", "-") else f"{number} {self.unit}"


class Facts(Named, Mapping[str, Any]):
    """Facts by their names, as items and as attributes; facts that have members are such mappings, too."""

    __slots__ = ("_of",)

    def __init__(self, of: Mapping[str, Any]) -> None:
        self._of = dict(of)

    def _names(self) -> Iterator[str]:
        return iter(self._of)

    def __getitem__(self, name: str) -> Any:
        if name not in self._of:
            raise KeyError(f"no fact {name!r}{nearest(name, self._of)}")
        return as_facts(self._of[name])

    def __iter__(self) -> Iterator[str]:
        return iter(self._of)

    def __len__(self) -> int:
        return len(self._of)

    def __reduce__(self) -> Any:
        return Facts, (self._of,)

    def __repr__(self) -> str:
        return f"<{', '.join(f'{name}={value!r}' for name, value in self.items())}>"


def as_facts(value: Any) -> Any:
    """Return a value with its mappings, also in lists, as facts."""
    if isinstance(value, Mapping):
        return Facts(value)
    return tuple(as_facts(each) for each in value) if isinstance(value, list) else value
