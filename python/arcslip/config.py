"""What the package was built with, and the threads that it uses."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any, Literal

from . import _core
from .command import PROGRAM
from .extras import required
from .threads import available

LICENCES = Path(__file__).parent / "licences"
LIBRARY = re.compile(r"(?P<name>.+?) (?P<version>[^ ,]+), (?P<licence>.+)")


def _of_command() -> dict[str, str]:
    """Return what the command says of its build, by the words before the colons, and the libraries."""
    found = subprocess.run([PROGRAM, "--version", "--verbose"], capture_output=True, text=True, check=True)
    lines = found.stdout.splitlines()[1:]
    return dict(line.split(": ", 1) for line in lines if ": " in line) | {
        "libraries": "\n".join(line for line in lines if ": " not in line)
    }


def _pools() -> list[dict[str, Any]] | None:
    """Return the pools of threads of this process, those of NumPy as well; None without threadpoolctl."""
    try:
        pools: list[dict[str, Any]] = required("threadpoolctl", "ensemble").threadpool_info()
    except ImportError:
        return None
    return pools


def _config() -> dict[str, Any]:
    build = _of_command()
    matches = (LIBRARY.fullmatch(line) for line in build["libraries"].splitlines())
    return {
        "version": _core.__version__,
        "python": sys.version.split()[0],
        "commit": build["commit"],
        "compiler": build["compiler"],
        "libraries": [match.groupdict() for match in matches if match],
        "licences": {path.stem: os.fspath(path) for path in sorted(LICENCES.glob("*.txt"))},
        "threads": {"arcslip": available(), "pools": _pools()},
    }


def _lines(config: dict[str, Any]) -> list[str]:
    lines = [f"{key}: {config[key]}" for key in ("version", "python", "commit", "compiler")]
    lines += ["libraries:"] + [f"  {each['name']} {each['version']}, {each['licence']}" for each in config["libraries"]]
    lines += [f"licences: {LICENCES}: {', '.join(config['licences']) or 'none'}", "threads:"]
    lines.append(f"  arcslip: {config['threads']['arcslip']}, or those of threads=")
    for pool in config["threads"]["pools"] or []:
        lines.append(f"  {pool['internal_api']}: {pool['num_threads']}, {pool['filepath']}")
    if config["threads"]["pools"] is None:
        lines.append("  of BLAS and OpenMP not known: threadpoolctl, of the extra arcslip[ensemble], is not installed")
    return lines


def show_config(mode: Literal["stdout", "dicts"] = "stdout") -> dict[str, Any] | None:
    """Show what the package was built with: libraries, their licences, and the threads that they use.

    Parameters
    ----------
    mode : "stdout" or "dicts"
        Whether it is printed or returned.

    Returns
    -------
    dict or None
        With "dicts": `version`, `python`, `commit`, `compiler`; `libraries`, each with its name, version and licence;
        `licences`, the files of their texts; `threads`: how many a study uses by default, and the `pools` of BLAS and OpenMP
        in this process, as threadpoolctl has them, or None where it is not installed.

    Examples
    --------
    >>> config = arcslip.show_config("dicts")
    >>> [each["licence"] for each in config["libraries"] if each["name"] == "Eigen"]
    ['MPL-2.0']
    """
    if mode not in ("stdout", "dicts"):
        raise ValueError(f'found mode={mode!r}, must be "stdout" or "dicts"')
    config = _config()
    if mode == "dicts":
        return config
    print("\n".join(_lines(config)))
    return None
