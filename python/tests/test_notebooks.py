"""The notebooks under examples run, and print what they have kept."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

NOTEBOOKS = sorted((Path(__file__).resolve().parents[2] / "examples/notebooks").glob("*.ipynb"))


def cells(path: Path) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return [cell for cell in found if cell["cell_type"] == "code"]


def printed(path: Path) -> str:
    outputs = [output for cell in cells(path) for output in cell["outputs"]]
    assert not [output for output in outputs if output["output_type"] == "error"]
    return "".join("".join(output["text"]) for output in outputs if output["output_type"] == "stream")


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_runs_and_prints_what_it_keeps(path: Path) -> None:
    code = "import matplotlib; matplotlib.use('agg')\n" + "\n".join("".join(cell["source"]) for cell in cells(path))
    found = subprocess.run(
        [sys.executable, "-P", "-W", "error", "-c", code], cwd=path.parent, capture_output=True, text=True, check=False
    )
    assert found.returncode == 0, found.stderr
    assert found.stdout == printed(path)


def test_notebooks_are_those_of_the_page(examples: Path) -> None:
    assert len(NOTEBOOKS) == 3
    text = (examples.parent / "docs/python.md").read_text(encoding="utf-8")
    for path in NOTEBOOKS:
        assert f"(../examples/notebooks/{path.name})" in text
        assert any("image/png" in output.get("data", {}) for cell in cells(path) for output in cell["outputs"])
