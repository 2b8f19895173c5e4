"""Exceptions and warnings."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

#: The parts of a message: "found X, must be Y; did you mean "Z"?". Quoted texts may have anything in them.
QUOTED = r'"(?:[^"\\]|\\.)*"'
FOUND = re.compile(rf"(?:[^\"]*?: )?found (?P<found>(?:{QUOTED}|[^\"])+?)[,;:] must be (?P<allowed>.*)", re.DOTALL)
NEAR = re.compile(rf"(?P<before>.*); did you mean (?P<near>{QUOTED})\?", re.DOTALL)
ESCAPES = {r"\"": '"', r"\\": "\\", r"\n": "\n", r"\t": "\t"}


class Fault(NamedTuple):
    """A fault of a scene.

    Attributes
    ----------
    pointer : str
        JSON pointer of the place in the scene, "" for the scene as a whole.
    message : str
        What was found, what is allowed, and the nearest known word, if any.
    found : str or None
        What was found, as the message has it: a number, a quoted text. None where the message does not say it.
    allowed : str or None
        What is allowed instead: "at least 0 kg". None where the message does not say it.
    near : str or None
        The known word that is nearest to an unknown one. None where no known word is similar.
    """

    pointer: str
    message: str

    @property
    def found(self) -> str | None:
        match = FOUND.fullmatch(self._parts[0])
        return match["found"] if match else None

    @property
    def allowed(self) -> str | None:
        match = FOUND.fullmatch(self._parts[0])
        return match["allowed"] if match else None

    @property
    def near(self) -> str | None:
        return self._parts[1]

    @property
    def _parts(self) -> tuple[str, str | None]:
        """The message before the nearest word, and that word."""
        match = NEAR.fullmatch(self.message)
        if match is None:
            return self.message, None
        return match["before"], re.sub(r"\\.", lambda escape: ESCAPES.get(escape[0], escape[0]), match["near"][1:-1])

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
