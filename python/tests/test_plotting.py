"""Figures of results."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
import pytest
from matplotlib import pyplot
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

import arcslip
from arcslip import _core
from arcslip.views.backend import draw_figure

matplotlib.use("agg")
OVER_LOAD = {"over": "damper.normal_load", "from_": 1.0, "to": 6.0}
WINDOW = {"frequency": [10.0, 25.0]}


@pytest.fixture(autouse=True)
def closed_figures() -> Iterator[None]:
    yield
    for number in pyplot.get_fignums():
        pyplot.figure(number).canvas.draw()  # texts that matplotlib cannot set are an error here
    pyplot.close("all")


def lines(ax: Axes, style: str) -> list[Line2D]:
    return [line for line in ax.lines if line.get_linestyle() == style and len(line.get_xdata()) > 0]  # type: ignore[arg-type]


def drawn(ax: Axes, style: str = "-") -> set[tuple[float, float]]:
    return {(x, y) for line in lines(ax, style) for x, y in np.transpose(line.get_data())}


def labels(ax: Axes) -> list[str]:
    return ax.get_legend_handles_labels()[1]


@pytest.mark.parametrize(
    ("kind", "keys", "x", "y"),
    [
        ("frf", {}, "frequency", "amplitude"),
        ("trace", {**OVER_LOAD, "frequency": 18.0}, "damper.normal_load", "amplitude"),
        ("peaks", {**OVER_LOAD, **WINDOW}, "damper.normal_load", "amplitude"),
        ("modes", {"amplitude": [1e-4, 1e-3]}, "amplitude", "frequency"),
        ("point", {"frequency": 18.0}, "time", "displacement"),
        ("time", {"frequency": 18.0}, "time", "displacement"),
        ("sweep", {"from_": 17.0, "to": 20.0, "points": 7}, "frequency", "amplitude"),
    ],
)
def test_each_kind_has_its_axes(scene: arcslip.Scene, kind: str, keys: dict[str, Any], x: str, y: str) -> None:
    results = getattr(scene, kind)(**keys)
    result = results[0]
    ax = result.plot()
    assert isinstance(ax, Axes)
    assert [label.split(" (")[0] for label in (ax.get_xlabel(), ax.get_ylabel())] == [x, y]
    assert "(" in ax.get_xlabel() and "(" in ax.get_ylabel()
    assert set(zip(result[x], result[y], strict=True)) <= drawn(ax)
    assert len(lines(results.plot(), "-")) >= len(results)


def test_folds_are_drawn_as_the_parameter_over_the_frequency(examples: Path) -> None:
    scene = arcslip.Scene(examples / "duffing_jenkins/scene.json")
    folds = scene.folds()
    ax = folds.plot()
    assert ax.get_xlabel() == "frequency (rad/s)" and ax.get_ylabel() == "damper.normal_load (N)"
    assert set(zip(folds[0].frequency, folds[0]["damper.normal_load"], strict=True)) <= drawn(ax)


def test_unstable_parts_are_dashed_and_meet_at_the_folds(examples: Path) -> None:
    scene = arcslip.Scene(examples / "duffing_jenkins/scene.json").replace({"damper.normal_load": 0.8})
    (branch,) = scene.frf(stability=True)
    ax = branch.plot()
    for stable, style in ((True, "-"), (False, "--")):
        rows = branch.stable == stable
        assert rows.any()
        assert set(zip(branch.frequency[rows], branch.amplitude[rows], strict=True)) <= drawn(ax, style)
    folds = set(zip(branch.events["fold"].frequency, branch.events["fold"].amplitude, strict=True))
    assert len(folds) == 2 and folds == drawn(ax, "-") & drawn(ax, "--")
    assert "unstable" in labels(ax)


def test_events_are_marked_and_labelled(scene: arcslip.Scene) -> None:
    (branch,) = scene.frf()
    ax = branch.plot()
    (peak,) = branch.events["peak"]
    assert (peak.frequency, peak.amplitude) in drawn(ax, "None")
    assert labels(ax) == ["resonance peak"] and ax.get_legend() is not None
    assert ax.get_yscale() == "log" and ax.get_xscale() == "linear"


@pytest.mark.parametrize(
    ("kind", "marker", "filled"),
    [("peak", "o", True), ("fold", "s", False), ("period_doubling", "^", False), ("jump", "*", False), ("turning_point", "s", True)],
)
def test_marks_are_those_of_the_command(kind: str, marker: str, filled: bool) -> None:
    part = np.array([[1.0, 2.0], [3.0, 4.0]])
    line = {"label": "", "parts": [part], "unstable": [False], "marks": {kind: part, "unknown": part}}
    column = {"words": "a", "unit": "", "scale": "linear"}
    ax = pyplot.subplots()[1]
    draw_figure(ax, _core.figure({"columns": [column, column], "lines": [line], "parameters": []}, 800, 500))
    marks = lines(ax, "None")
    assert {(mark.get_marker(), mark.get_fillstyle() == "full") for mark in marks} == {(marker, filled)}
    assert drawn(ax, "None") == {(1.0, 2.0), (3.0, 4.0)}
    assert labels(ax) == [kind.replace("_", " ") if kind != "peak" else "resonance peak"]


def test_results_have_a_colour_for_each_setting(scene: arcslip.Scene) -> None:
    responses = scene.frf(for_each={"damper.normal_load": [1.0, 4.0]})
    ax = responses.plot()
    assert labels(ax) == ["1 N", "4 N", "resonance peak"]
    legend = ax.get_legend()
    assert legend is not None and legend.get_title().get_text() == "damper.normal_load"
    assert len({line.get_color() for line in lines(ax, "-")}) == 2
    assert {text.get_text() for text in ax.texts} == {"1 N", "4 N"}  # next to their curves
    two = scene.frf(for_each={"damper.normal_load": [1.0, 4.0], "c.value": [1.0, 2.0]}).plot()
    assert labels(two)[0] == "1 N, 1 N s/m"


def test_axes_have_a_prefix_that_suits_their_numbers(scene: arcslip.Scene) -> None:
    (branch,) = scene.frf()
    ax = branch.plot()
    ax.figure.canvas.draw()
    assert ax.get_ylabel() == "amplitude (mm)" and ax.get_xlabel() == "frequency (Hz)"
    ticks = [(float(text.get_text()), text.get_position()[1]) for text in ax.get_yticklabels() if text.get_text()]
    assert ticks and all(shown == pytest.approx(1e3 * value, rel=1e-5) for shown, value in ticks)


def test_axis_without_a_power_of_ten_has_numbers(scene: arcslip.Scene) -> None:
    ax = scene.replace({"damper.normal_load": 20.0}).frf(from_=10.0, to=11.5)[0].plot()
    ax.figure.canvas.draw()
    shown = [text.get_text() for text in (*ax.get_yticklabels(), *ax.get_yticklabels(minor=True)) if text.get_text()]
    assert ax.get_yscale() == "log" and len(shown) >= 2 and all(float(text) > 0 for text in shown)


def test_responses_at_one_frequency_are_drawn_apart(examples: Path) -> None:
    scene = arcslip.Scene(examples / "duffing_jenkins/scene.json").replace({"damper.normal_load": 0.8})
    folds = scene.frf(for_each={})[0].events["fold"].frequency
    responses = scene.point(frequency=float(folds.mean()), stability=True)
    assert len(responses) == 3
    ax = responses.plot()
    assert len({line.get_color() for line in lines(ax, "-")}) == 3
    assert sum("unstable" in label for label in labels(ax)) == 1


def test_hundreds_of_curves_are_bands_and_say_so(scene: arcslip.Scene) -> None:
    loads = np.linspace(1, 6, 250)
    responses = scene.frf(for_each={"damper.normal_load": loads}, from_=15.0, to=20.0)
    ax = responses.plot()
    assert ax.get_title().startswith("250 curves: their median, and bands")
    assert labels(ax) == ["median", "nine tenths of the curves", "a half of them"]
    (median,) = lines(ax, "-")
    at, height = median.get_data()
    expected = [np.median([np.interp(x, each.frequency, each.amplitude) for each in responses]) for x in at[5:-5:20]]
    np.testing.assert_allclose(height[5:-5:20], expected, rtol=0.02)


def test_long_legend_stands_at_the_side(scene: arcslip.Scene) -> None:
    for count, is_inside in ((2, True), (7, False)):
        ax = scene.frf(for_each={"damper.normal_load": np.linspace(1, 6, count)}).plot()
        ax.figure.canvas.draw()
        legend = ax.get_legend()
        assert legend is not None
        assert (legend.get_window_extent().x0 < ax.get_window_extent().x1) == is_inside
        assert legend.get_window_extent().x1 <= ax.figure.bbox.x1


def test_sweep_is_interrupted_at_its_jumps(examples: Path) -> None:
    sweeps = arcslip.Scene(examples / "frequency_sweep/scene.json").sweep(for_each={})
    up = sweeps[0]
    ax = up.plot()
    (jump,) = up.events["jump"]
    ends = [line.get_xdata()[-1] for line in lines(ax, "-")]  # type: ignore[index]
    assert ends[0] == jump.frequency and len(ends) == 2
    assert {(jump.frequency, jump.amplitude), (jump.frequency_after, jump.amplitude_after)} <= drawn(ax, "None")
    assert labels(sweeps.plot()) == ["up", "down", "jump"]


def test_search_is_drawn_with_its_optimum_and_tolerances(examples: Path) -> None:
    scene = arcslip.Scene(examples / "al_sayed_2011/scene.json").replace(harmonics=3)
    (optimum,) = scene.optimize()
    assert isinstance(optimum, arcslip.Optimum)
    ax = optimum.plot()
    assert (optimum.design["damper.normal_load"], optimum.amplitude) in drawn(ax, "None")
    for each in optimum.ranges["damper.normal_load"]:
        assert (each.upper, (1 + each.share) * optimum.amplitude) in drawn(ax, "None")
    assert set(labels(ax)) == {"designs evaluated", "optimum", "within 1 %", "within 5 %"}
    assert ax.get_xlabel() == "damper.normal_load (N)" and ax.get_ylabel() == "amplitude (mm)"


def test_search_over_several_parameters_is_drawn_over_its_evaluations(examples: Path) -> None:
    scene = arcslip.Scene(examples / "two_dampers/scene.json").replace(harmonics=3)
    (optimum,) = scene.optimize()
    ax = optimum.plot()
    assert ax.get_xlabel() == "evaluation"
    amplitudes = [y for _, y in sorted(drawn(ax, "None"))]
    np.testing.assert_array_equal(amplitudes, optimum.course.amplitude)


def test_comparison_is_drawn_by_method(scene: arcslip.Scene) -> None:
    (comparison,) = scene.accuracy(from_=15.0, to=20.0, order=3)
    ax = comparison.plot()
    assert set(labels(ax)) == {*comparison.trials.method.tolist(), "best"}
    assert ax.get_xscale() == ax.get_yscale() == "log"


def test_axes_that_are_given_are_taken(scene: arcslip.Scene) -> None:
    figure, (first, second) = pyplot.subplots(2)
    (branch,) = scene.frf()
    first.set_yscale("log")
    assert branch.plot(second) is second
    assert not first.lines and pyplot.get_fignums() == [figure.number]
    assert scene.frf().plot(ax=first) is first


def test_columns_may_be_chosen(scene: arcslip.Scene) -> None:
    (response,) = scene.point(frequency=18.0)
    ax = response.plot(x="elements.damper.displacement", y="elements.damper.force")
    loop = response.motion().loops["damper"]
    assert set(zip(*loop, strict=True)) <= drawn(ax)
    (branch,) = scene.frf()
    ax = branch.plot(y="elements.damper.stick_percent")
    assert ax.get_ylabel() == "elements.damper.stick_percent (%)" and ax.get_yscale() == "linear"
    open_figures = pyplot.get_fignums()
    with pytest.raises(KeyError, match="no column 'amplitud'; the nearest is 'amplitude'"):
        branch.plot(y="amplitud")
    with pytest.raises(ValueError, match="found the column 'elements.damper.slip_angles', must be one of numbers"):
        branch.plot(y="elements.damper.slip_angles")
    assert pyplot.get_fignums() == open_figures


def test_texts_of_a_scene_are_no_formulas(oscillator: dict[str, Any]) -> None:
    oscillator["elements"][0]["name"] = "$\\frac{_^$"
    oscillator["labels"] = {"amplitude": "a $\\bad"}
    results = arcslip.Scene(oscillator).frf(for_each={"$\\frac{_^$.normal_load": [1.0, 4.0]})
    ax = results.plot()
    assert ax.get_ylabel().startswith("a \\$")


def test_what_cannot_be_drawn_is_refused(scene: arcslip.Scene) -> None:
    mixed = arcslip.Scene(
        scene.to_dict() | {"studies": [*scene.to_dict()["studies"], {"name": "at", "kind": "point", "frequency": 18.0}]}
    ).run()
    with pytest.raises(ValueError, match="found results of the kinds .*'frf', 'point'.*; name a study"):
        mixed.plot()
    assert isinstance(mixed.plot(study="at"), Axes)
    with pytest.warns(arcslip.ArcslipWarning):
        failed = scene.replace({"c.value": 0, "damper.normal_load": 0}).point(frequency=100 / (2 * np.pi))
    with pytest.raises(ValueError, match="nothing to plot: no response is bounded"):
        failed.plot()


def test_missing_matplotlib_names_the_extra_that_installs_it(scene: arcslip.Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    (branch,) = scene.frf()
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(ImportError, match=r"matplotlib is not installed, .*arcslip\[plot\]"):
        branch.plot()
