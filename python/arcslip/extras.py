"""Packages that arcslip uses where they are installed, and imports only when they are needed."""

from __future__ import annotations

import importlib
from typing import Any


def required(module: str, extra: str) -> Any:
    """Return a module of a package that an extra of arcslip installs.

    Raises
    ------
    ImportError
        If the package is not installed.
    """
    package = module.split(".")[0]
    try:
        importlib.import_module(package)
    except ModuleNotFoundError as error:
        if error.name != package:
            raise
        raise ImportError(
            f"{package} is not installed, which this needs; the extra arcslip[{extra}] installs it", name=package
        ) from None
    return importlib.import_module(module)
