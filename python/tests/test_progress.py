"""Progress of computations: bars, callables and the log."""

from __future__ import annotations

import io
import logging
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import tqdm.auto

import arcslip
from arcslip.progress import TextBar, reporting, share_done, summary

Slow = Callable[..., arcslip.Results]
NOW = {"branch": 2, "branches": 4, "points": 45, "frequency": 19.2, "step": 0.1, "share_done": 0.5}
NOW |= {"item": "branch", "counted": "points", "phase": "", "order": 0, "best": np.nan}


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def interrupt(slow: Slow, progress: Any) -> None:
    """Run a long study for some reports."""
    reports = 0

    def count(now: dict[str, Any]) -> bool:
        nonlocal reports
        reports += 1
        return progress(now) is not False and reports < 4

    with pytest.warns(arcslip.ArcslipWarning):
        slow(progress=count)


def test_share_and_words_of_a_report() -> None:
    assert share_done(NOW) == 2.5 / 4
    assert share_done(NOW | {"share_done": np.nan}) == 0.5
    assert share_done(NOW | {"branch": 9}) == 1
    assert summary(NOW) == "branch 3/4, 45 points"
    more = {"order": 7, "phase": "certificate", "best": 1e-3, "item": "search", "counted": "designs"}
    assert summary(NOW | more) == "search 3/4, order 7, certificate, 45 designs, best 0.001 m"


def test_bar_is_that_of_tqdm_where_it_is_installed(slow: Slow, monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[tuple[float, str]] = []

    class Bar(tqdm.std.tqdm):  # type: ignore[type-arg]
        def set_postfix_str(self, s: str = "", refresh: bool = True) -> None:
            super().set_postfix_str(s, refresh)
            shown.append((self.n, s))

    monkeypatch.setattr(tqdm.auto, "tqdm", Bar)
    with reporting(True, "response") as report:
        assert report is not None
        interrupt(slow, report)
    assert len(shown) == 5 and all(0 <= share < 1 for share, _ in shown[:4]) and shown[4][0] == 1
    assert "/20000" in shown[0][1]


@pytest.mark.parametrize("progress", [True, False, None])
def test_study_takes_a_bar_or_none(scene: arcslip.Scene, progress: bool | None, capsys: pytest.CaptureFixture[str]) -> None:
    assert len(scene.frf(progress=progress)) == 1
    assert len(scene.run(progress=progress)) == 1
    assert ("response" in capsys.readouterr().err) == (progress is True)


def test_bar_without_tqdm_is_a_line_that_is_rewritten(
    slow: Slow, scene: arcslip.Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "tqdm", None)
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    monkeypatch.setattr(sys, "stderr", Terminal())
    with reporting(True, "response") as report:
        assert report is not None
        interrupt(slow, report)
    text = sys.stderr.getvalue()  # type: ignore[attr-defined]
    assert text.count("\rresponse: ") == 5 and text.endswith("\n") and text.count("\n") == 1
    assert text.rsplit("\r", 1)[1].startswith("response: 100 %")


def test_bar_of_no_terminal_is_a_line_for_each_tenth(monkeypatch: pytest.MonkeyPatch) -> None:
    output = io.StringIO()
    monkeypatch.setattr(sys, "stderr", output)
    bar = TextBar("response")
    for share in np.arange(100) / 100:
        bar.show(float(share), "points")
    bar.close()
    lines = output.getvalue().splitlines()
    assert len(lines) == 10 and lines[0] == "response:   0 %  points"


def test_bar_is_closed_where_a_callback_fails(slow: Slow, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stderr", Terminal())
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)

    def fail(now: dict[str, Any]) -> None:
        raise RuntimeError("own")

    with pytest.raises(RuntimeError, match="own"), reporting(True, "response") as report:
        assert report is not None
        report(NOW)
        slow(progress=fail)
    assert sys.stderr.getvalue().endswith("\n")  # type: ignore[attr-defined]


def test_wrong_progress_is_refused() -> None:
    with pytest.raises(TypeError, match="found progress=1, must be True or callable"):
        reporting(1, "response").__enter__()  # type: ignore[arg-type]


def test_log_has_the_begin_and_the_end(scene: arcslip.Scene, caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.INFO, logger="arcslip"):
        scene.frf()
    assert [record.name for record in caplog.records] == ["arcslip", "arcslip"]
    assert caplog.messages[0] == "response: computation begins"
    assert caplog.messages[1].startswith("response: computation ended after ")


def test_log_of_a_debugging_level_has_the_progress(slow: Slow, caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.DEBUG, logger="arcslip"):
        interrupt(slow, lambda now: True)
    assert sum("/20000, " in message for message in caplog.messages) == 4


def test_log_is_silent_unless_it_is_asked_for(scene: arcslip.Scene, capfd: pytest.CaptureFixture[str]) -> None:
    scene.frf()
    assert capfd.readouterr() == ("", "")


def test_combinations_that_were_not_begun_are_counted(scene: arcslip.Scene) -> None:
    loads = {"damper.normal_load": [float(i) for i in range(1, 201)]}
    with pytest.warns(arcslip.ArcslipWarning) as warned:
        results = scene.frf(for_each=loads, progress=lambda now: False)
    said = f"stopped: {200 - len(results)} of 200 combinations of 'response' were not started"
    assert len(results) < 200 and said in [str(each.message) for each in warned]
