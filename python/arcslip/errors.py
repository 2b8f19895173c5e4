"""Exceptions and warnings."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple


class Fault(NamedTuple):
    """A fault of a scene.

    Attributes
    ----------
    pointer : str
        JSON pointer of the place in the scene, "" for the scene as a whole.
    message : str
        What was found, what is allowed, and the nearest known word, if any.
    """

    pointer: str
    message: str

    def __str__(self) -> str:
        return f"{self.pointer}: {self.message}" if self.pointer else self.message


class SceneError(ValueError):
    """A scene with faults.

    Attributes
    ----------
    faults : tuple of Fault
        All of them.
    """

    def __init__(self, faults: Iterable[tuple[str, str]]) -> None:
        self.faults: tuple[Fault, ...] = tuple(Fault(*fault) for fault in faults)
        super().__init__(self.faults)

    def __str__(self) -> str:
        return "\n".join(str(fault) for fault in self.faults)


class ParameterError(ValueError):
    """An unknown parameter, or a value outside its bounds."""


class ArcslipWarning(UserWarning):
    """A result that ended early, or that is less accurate than it seems."""
