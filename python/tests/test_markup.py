"""Scenes and results as HTML: complete, and with nothing in it that a name or a title has put there."""

from __future__ import annotations

from html.parser import HTMLParser
from typing import Any

import numpy as np
import pytest

import arcslip

HOSTILE = "</td><script>alert('x')</script>&lt;\"'\u202e"
TAGS = {"table", "caption", "thead", "tbody", "tr", "th", "td", "p"}


class Read(HTMLParser):
    """The cells of a text, whose tags must be known and nested."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.open: list[str] = []
        self.cells: list[str] = []
        self.feed(text)
        self.close()
        assert not self.open

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        assert tag in TAGS and not attributes
        self.open.append(tag)
        self.cells.append("")

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open[-1] in ("td", "th", "caption", "p"):
            self.cells[-1] += data


def cells(of: Any) -> list[str]:
    return Read(of._repr_html_()).cells


def test_scene_shows_its_studies_and_parameters(scene: arcslip.Scene) -> None:
    shown = cells(scene)
    assert {"response", "frf", "damper.normal_load", "4", "N"} <= set(shown)
    assert scene.parameters["damper.normal_load"].help in shown


def test_results_show_their_settings_and_rows(scene: arcslip.Scene) -> None:
    results = scene.frf(for_each={"damper.normal_load": [1.0, 4.0]})
    shown = cells(results)
    assert {"damper.normal_load (N)", "1", "4", "complete", str(len(results[0]))} <= set(shown)
    shown = cells(results[1])
    assert "frequency (Hz)" in shown and "amplitude (m)" in shown and "..." in shown
    assert f"{results[1].frequency[0]:.6g}" in shown and f"{results[1].frequency[-1]:.6g}" in shown
    assert f"{results[1].frequency[len(results[1]) // 2]:.6g}" not in shown
    assert "resonance" not in shown and "peak" in cells(results[1].events)
    assert cells(results[1].points[:3]).count("...") == 0


def test_many_results_are_cut_off(scene: arcslip.Scene) -> None:
    results = scene.frf(from_=10, to=10.1, for_each={"damper.normal_load": np.linspace(1, 2, 25)})
    shown = cells(results)
    assert any(cell.endswith("25; 5 more") for cell in shown)
    assert shown.count("complete") == 20


@pytest.mark.parametrize("place", ["title", "study", "element"])
def test_hostile_names_are_escaped(oscillator: dict[str, Any], place: str) -> None:
    if place == "title":
        oscillator["title"] = HOSTILE
    elif place == "study":
        oscillator["studies"][0]["name"] = HOSTILE.replace("/", "").replace("\u202e", "")
    else:
        oscillator["elements"][0]["name"] = HOSTILE.replace(" ", "")
    scene = arcslip.Scene(oscillator)
    loads = {f"{oscillator['elements'][0]['name']}.normal_load": [1.0, 4.0]}
    results = scene.frf(from_=10, to=10.1, for_each=loads)
    shown = [of._repr_html_() for of in (scene, results, results[0], results[0].points)]
    assert not any("<script" in text or "\u202e" in text for text in shown)
    assert any("alert" in text for text in shown)
    for of in (scene, results, results[0], results[0].points):
        cells(of)
