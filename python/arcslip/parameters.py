"""The parameters of a scene."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from . import _core
from .names import nearest
from .quantities import Quantity


class Parameter(Quantity):
    """The value of a parameter: a number that knows its unit, bounds and meaning.

    Attributes
    ----------
    name : str
    lower, upper : float
        Closed bounds, but where `lower_open`.
    lower_open : bool
        Whether the lower bound itself is not allowed.
    help : str
    formula : str or None
        Of other parameters, which the value follows; None where it is a number of its own.
    """

    name: str
    lower: float
    upper: float
    lower_open: bool
    help: str
    formula: str | None


class Parameters(Mapping[str, Parameter]):
    """The parameters of a scene by name, "part.field" or a constant."""

    def __init__(self, core: _core.Scene) -> None:
        self._all = {
            each["name"]: Parameter(each.pop("value"), **each) for each in core.parameters()
        }

    def __getitem__(self, name: str) -> Parameter:
        if name not in self._all:
            raise KeyError(f"no parameter {name!r}{nearest(name, self._all)}")
        return self._all[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._all)

    def __len__(self) -> int:
        return len(self._all)

    def __repr__(self) -> str:
        lines = [f"{name} = {value!r}" for name, value in self._all.items()]
        return "\n".join(lines if len(lines) <= 30 else [*lines[:28], f"... {len(lines) - 28} more"])
