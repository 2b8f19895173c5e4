"""The marks of events in figures, as those of the command have them."""

from __future__ import annotations

from typing import NamedTuple


class Mark(NamedTuple):
    """A marker of matplotlib for a kind of events, and its words in a legend."""

    marker: str
    filled: bool
    words: str


#: Of the kinds of events that figures mark.
MARKS = {
    "peak": Mark("o", True, "resonance peak"),
    "fold": Mark("s", False, "fold"),
    "maximum": Mark("^", True, "maximum"),
    "minimum": Mark("v", True, "minimum"),
    "cusp": Mark("D", True, "cusp"),
    "turn": Mark("s", True, "turn"),
    "period_doubling": Mark("^", False, "period doubling"),
    "neimark_sacker": Mark("o", False, "Neimark-Sacker point"),
    "symmetry_breaking": Mark("D", False, "break of symmetry"),
    "stability_lost": Mark("x", False, "loss of stability"),
    "jump": Mark("*", False, "jump"),
    "resonance_1_1": Mark("p", True, "resonance 1:1"),
    "resonance_1_2": Mark("p", False, "resonance 1:2"),
    "resonance_1_3": Mark("v", True, "resonance 1:3"),
    "resonance_1_4": Mark("+", False, "resonance 1:4"),
    "turning_point": Mark("s", True, "turning point"),
}
