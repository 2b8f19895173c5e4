"""The examples of the pages and of the docstrings run, and the page lists what is public."""

from __future__ import annotations

import doctest
import importlib
import pkgutil
import re
from pathlib import Path
from typing import Any

import matplotlib
import pytest
from matplotlib import pyplot

import arcslip

matplotlib.use("agg")
PUBLIC = [name for name in arcslip.__all__ if name != "__version__"]


@pytest.fixture(autouse=True)
def in_the_root(examples: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.chdir(examples.parent)
    yield
    pyplot.close("all")


@pytest.mark.parametrize("page", ["README.md", "docs/python.md"])
def test_examples_of_the_page_run(page: str, capsys: pytest.CaptureFixture[str]) -> None:
    blocks = re.findall(r"```python\n(.*?)```", Path(page).read_text(encoding="utf-8"), re.DOTALL)
    names: dict[str, Any] = {}
    for block in blocks:
        exec(compile(block, page, "exec"), names)  # noqa: S102
    assert blocks and capsys.readouterr().out


def test_examples_of_docstrings_run() -> None:
    finder, runner = doctest.DocTestFinder(recurse=True), doctest.DocTestRunner()
    modules = [importlib.import_module(each.name) for each in pkgutil.walk_packages(arcslip.__path__, "arcslip.")]
    for module in [arcslip, *modules]:
        for test in finder.find(module, module.__name__, globs={"arcslip": arcslip}):
            runner.run(test)
    assert runner.tries > 10
    assert runner.failures == 0


def test_all_public_names_have_docstrings() -> None:
    for name in PUBLIC:
        assert getattr(arcslip, name).__doc__, name
    for name, member in members(arcslip.Scene) | members(arcslip.Result) | members(arcslip.Optimum) | members(arcslip.Results):
        assert member.__doc__, name


def members(cls: type) -> set[tuple[str, Any]]:
    """The public attributes that a class has from this package."""
    own = [each for each in cls.__mro__ if each.__module__.startswith("arcslip")]
    return {(name, member) for each in own for name, member in vars(each).items() if not name.startswith("_")}


def test_page_lists_all_public_names() -> None:
    text = Path("docs/python.md").read_text(encoding="utf-8").split("## Public names")[1]
    listed = set(re.findall(r"`(\w+)`", text))
    assert set(arcslip.__all__) <= listed
    for name in PUBLIC:
        if isinstance(getattr(arcslip, name), type):
            own = {member for member, _ in members(getattr(arcslip, name))}
            assert own <= listed, f"{name}: {own - listed}"
