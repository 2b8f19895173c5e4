"""What the tests have in common."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import arcslip
from arcslip.command import PROGRAM


@pytest.fixture(scope="session")
def examples() -> Path:
    return Path(__file__).resolve().parents[2] / "examples"


@pytest.fixture(scope="session")
def command() -> Path:
    """The command that the package carries."""
    return PROGRAM


@pytest.fixture
def oscillator() -> dict[str, Any]:
    """A Duffing oscillator with a friction damper."""
    return {
        "format": "arcslip-scene-1",
        "title": "oscillator",
        "structure": {
            "dofs": ["x"],
            "masses": [{"name": "m", "at": "x", "value": 1.0}],
            "springs": [{"name": "k", "at": "x", "value": 1e4}],
            "dampers": [{"name": "c", "at": "x", "value": 2.0}],
        },
        "elements": [
            {
                "name": "damper",
                "type": "jenkins",
                "at": "x",
                "stiffness": 4000.0,
                "friction_coefficient": 0.5,
                "normal_load": 4.0,
            }
        ],
        "excitation": [{"name": "force", "at": "x", "cosine": 1.0}],
        "harmonics": {"order": 7},
        "studies": [{"name": "response", "kind": "frf", "from": 10.0, "to": 25.0}],
    }


@pytest.fixture
def scene(oscillator: dict[str, Any]) -> arcslip.Scene:
    return arcslip.Scene(oscillator)


@pytest.fixture
def slow(oscillator: dict[str, Any]) -> Callable[..., arcslip.Results]:
    """A study that takes minutes."""
    many = [float(i) for i in range(1, 20001)]
    return lambda **how: arcslip.Scene(oscillator).frf(for_each={"damper.normal_load": many}, **how)
