"""Results: equal to those of the command, and arrays that live on their own."""

from __future__ import annotations

import gc
import json
import os
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import arcslip

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
ALL = sorted(path.relative_to(EXAMPLES) for path in EXAMPLES.glob("*/*.json"))
SOME = ["duffing_jenkins", "double_well", "damped_mode", "gap_limited_chain", "frequency_sweep", "two_dampers"]
SCENES = ALL if os.environ.get("ARCSLIP_FULL") else [Path(name, "scene.json") for name in SOME]


def without_times(of: Any) -> Any:
    """What does not change from run to run."""
    if isinstance(of, dict):
        return {key: without_times(value) for key, value in of.items() if key != "seconds"}
    return [without_times(each) for each in of] if isinstance(of, list) else of


def assert_same_table(a: arcslip.Table, b: arcslip.Table) -> None:
    """All columns of b, which leaves out those without a value, are in a."""
    assert len(a) == len(b)
    for name in b.columns:
        if name not in a and isinstance(a[name.split(".")[0]][0], dict):
            continue  # a value with members, which a file does not tell from columns
        first, second = a[name], b[name]
        if second.dtype == object:
            assert all(np.array_equal(x, y) for x, y in zip(first, second, strict=True) if y is not None)
        else:
            np.testing.assert_array_equal(first, second)
    for name in set(a.columns) - {each if each in a else each.split(".")[0] for each in b.columns}:
        column = a[name]
        assert all(value is None or value in ("", {}) or value != value for value in column.tolist()), name


@pytest.mark.filterwarnings("ignore::arcslip.ArcslipWarning")
@pytest.mark.parametrize("name", SCENES, ids=str)
def test_results_are_those_of_the_command_to_the_last_bit(
    name: Path, command: Path, tmp_path: Path
) -> None:
    path, file = EXAMPLES / name, tmp_path / "results.json"
    subprocess.run([command, "run", path, "--json", file, "--out", tmp_path / "out", "--quiet"], check=False)
    if not file.exists():
        pytest.skip("the command does not run this scene")
    results = arcslip.Scene(path).run()
    text = results.to_json()
    assert without_times(json.loads(text)) == without_times(json.loads(file.read_text()))
    loaded = arcslip.load(file)
    assert (loaded.program, loaded.scene_hash) == (results.program, results.scene_hash)
    by_list = sorted(results, key=lambda result: [r.noun for r in results].index(result.noun))
    for a, b in zip(by_list, loaded, strict=True):
        assert (a.study, a.kind, a.noun, a.set, a.status, a.doubt) == (b.study, b.kind, b.noun, b.set, b.status, b.doubt)
        assert (a.parent is None) == (b.parent is None)
        assert list(a.tables) == list(b.tables)
        for key in a.tables:
            assert_same_table(a.tables[key], b.tables[key])


@pytest.fixture
def branch(scene: arcslip.Scene) -> arcslip.Result:
    return scene.frf()[0]


def test_columns_are_items_and_attributes(branch: arcslip.Result) -> None:
    assert branch["amplitude"] is branch.amplitude
    assert branch.amplitude.dtype == np.float64
    assert branch.elements.damper.stick_percent is branch["elements.damper.stick_percent"]
    assert len(branch.amplitude) == len(branch) == len(branch.points)
    assert branch.units["amplitude"] == "m" and branch.units["frequency"] == "Hz"
    assert branch.labels["amplitude"] == "amplitude (m)"
    assert branch.points.unbounded.dtype == np.float64 or branch.points.unbounded.dtype == np.bool_
    assert "amplitude" in dir(branch) and "events" in dir(branch)
    assert branch.stop["reason"] == "boundary" and branch.status == "complete" and branch.doubt == ""


def test_unknown_column_names_the_nearest(branch: arcslip.Result) -> None:
    with pytest.raises(KeyError, match="amplitude"):
        branch["amplitud"]
    with pytest.raises(AttributeError, match="amplitude"):
        branch.amplitud  # noqa: B018


def test_events_are_a_sequence_with_kinds(branch: arcslip.Result) -> None:
    (peak,) = branch.events["peak"]
    assert peak.kind == "peak"
    assert peak.amplitude >= branch.amplitude.max() * (1 - 1e-9)
    assert isinstance(peak.amplitude, float)
    assert peak.elements.damper.stick_percent == peak["elements.damper.stick_percent"]
    assert peak.location_estimate >= 0
    assert [event.kind for event in branch.events] == branch.events.kind.tolist()
    assert branch.events[-1].kind == branch.events.kind[-1]
    assert peak.to_dict()["kind"] == "peak"
    with pytest.raises(IndexError):
        branch.events[100]
    with pytest.raises(KeyError):
        branch.events["fold"]


def test_missing_values_are_nan(branch: arcslip.Result) -> None:
    theta = branch["elements.damper.theta_star"]
    assert np.isnan(theta).any() and not np.isinf(theta).any()


def test_columns_share_the_memory_of_the_computation(branch: arcslip.Result) -> None:
    amplitude = branch.amplitude
    assert not amplitude.flags.owndata and not amplitude.flags.writeable
    assert np.shares_memory(amplitude, branch.main["amplitude"])
    with pytest.raises(ValueError, match="read-only"):
        amplitude[0] = 1


def test_arrays_outlive_all_that_they_come_from(oscillator: dict[str, Any]) -> None:
    results = arcslip.Scene(oscillator).frf(coefficients=True)
    amplitude, angles = results[0].amplitude, results[0]["elements.damper.slip_angles"]
    kept = amplitude.copy()
    del results
    gc.collect()
    for _ in range(20):
        arcslip.Scene(oscillator).frf()
    assert np.array_equal(amplitude, kept)
    assert len(angles) == len(kept)


def test_coefficients_are_rows_of_an_array(scene: arcslip.Scene) -> None:
    (branch,) = scene.frf(coefficients=True)
    names = [name for name in branch.points.columns if name.startswith("coefficients")]
    assert names and all(branch[name].ndim == 2 for name in names)


def test_memory_is_flat_over_many_results(oscillator: dict[str, Any]) -> None:
    def resident() -> int:
        return int(Path("/proc/self/statm").read_text().split()[1]) * 4096

    scene = arcslip.Scene(oscillator)

    def cycles(count: int) -> None:
        for i in range(count):
            arcslip.Scene(oscillator).replace({"c.value": 1.0})
            if i % 10 == 0:
                branch = scene.frf(from_=10, to=10.2)[0]
                branch.amplitude.sum()
                branch.motion(0, steps=10)

    cycles(3000)
    before = resident()
    cycles(10_000)
    assert resident() - before < 8e6


def test_columns_that_are_asked_for_are_computed_alone_and_equal_to_those_among_all(scene: arcslip.Scene) -> None:
    loads = {"damper.normal_load": [2.0, 4.0]}
    all_of_them = scene.frf(for_each=loads, coefficients=True)
    some = scene.frf(for_each=loads, columns=["damper.stick_percent", "elements.damper.energy", "frequency"])
    assert len(some) == len(all_of_them) == 2
    for branch, whole in zip(some, all_of_them, strict=True):
        names = ("frequency", "elements.damper.stick_percent", "elements.damper.energy")
        assert (branch.points.columns, branch.events.columns) == (names, ("kind", *names))
        for name in names:
            np.testing.assert_array_equal(branch[name], whole[name])
            np.testing.assert_array_equal(branch.events["peak"][name], whole.events["peak"][name])
        assert branch.units["elements.damper.energy"] == "J"
        assert (branch.set, branch.status, branch.facts.keys()) == (whole.set, whole.status, whole.facts.keys() - {"harmonics"})
        np.testing.assert_array_equal(branch.motion(3).displacement, whole.motion(3).displacement)
    (curve,) = scene.trace(over="damper.normal_load", from_=2, to=4, frequency=15, columns=["damper.normal_load"], coefficients=True)
    assert curve.points.columns == ("damper.normal_load", "coefficients")
    assert curve.coefficients.shape == (len(curve), 8)


def test_results_with_some_columns_are_saved_and_loaded(scene: arcslip.Scene, tmp_path: Path) -> None:
    (branch,) = found = scene.frf(columns=["frequency", "amplitude"])
    found.save(tmp_path / "some.json")
    (loaded,) = arcslip.load(tmp_path / "some.json")
    np.testing.assert_array_equal(loaded.amplitude, branch.amplitude)
    assert loaded.events.kind.tolist() == branch.events.kind.tolist() != []
