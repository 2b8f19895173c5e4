"""The command arcslip, which the package carries."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import NoReturn

from .files.mat_program import provide

PROGRAM = Path(__file__).parent / "bin" / "arcslip"


def main() -> NoReturn:
    """Become the command, with the arguments of this process."""
    provide()
    os.execv(PROGRAM, ["arcslip", *sys.argv[1:]])
