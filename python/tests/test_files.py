"""Files of results, which the command writes and the package reads, and the reverse."""

from __future__ import annotations

import json
import pickle
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import arcslip

SCENES = ["duffing_jenkins", "double_well", "damped_mode", "gap_limited_chain", "frequency_sweep", "levels"]


def equal(a: Any, b: Any) -> bool:
    """Whether columns are equal, with NaN where a value is missing."""
    if a.dtype == object or b.dtype == object:
        return all(x is None and y is None or np.array_equal(x, y) for x, y in zip(a, b, strict=True))
    return np.array_equal(a, b, equal_nan=a.dtype.kind == "f")


def same_tables(a: arcslip.Result, b: arcslip.Result) -> None:
    """Check that b has the columns of a that have values, with their units."""
    for key, table in a.tables.items():
        other = b.tables[key]
        assert len(table) == len(other)
        for name in table.columns:
            if name in other:
                assert equal(table[name], other[name]), (key, name)
                assert table.units.get(name) == other.units.get(name), (key, name)
            else:  # the file has a value with members in one column
                assert other[name.split(".")[0]].dtype == object, (key, name)


def head(result: arcslip.Result) -> tuple[Any, ...]:
    return result.study, result.kind, result.noun, result.status, result.doubt, result.set, result.parent is None


@pytest.mark.filterwarnings("ignore::arcslip.ArcslipWarning")
@pytest.mark.parametrize("name", SCENES)
def test_tables_of_csv_are_those_of_json(name: str, command: Path, examples: Path, tmp_path: Path) -> None:
    subprocess.run([command, "run", examples / name / "scene.json", "--out", tmp_path, "--quiet"], check=True)
    files = [path for path in tmp_path.glob("*.json") if path.with_suffix(".csv").exists()]
    assert files
    for path in files:
        for a, b in zip(arcslip.load(path), arcslip.load(path.with_suffix(".csv")), strict=True):
            assert head(a) == head(b)
            assert a.stop["reason"] == b.stop["reason"] and a.stop["message"] == b.stop["message"]
            same_tables(a, b)


@pytest.mark.filterwarnings("ignore::arcslip.ArcslipWarning")
@pytest.mark.parametrize("name", SCENES)
def test_what_was_loaded_is_saved(name: str, examples: Path, tmp_path: Path) -> None:
    computed = arcslip.Scene(examples / name / "scene.json").run()
    computed.save(tmp_path / "first.json")
    loaded = arcslip.load(tmp_path / "first.json")
    loaded.save(tmp_path / "second.json")
    pickle.loads(pickle.dumps(computed)).save(tmp_path / "third.json")
    again = arcslip.load(tmp_path / "second.json")
    assert (again.program, again.scene_hash, again.title) == (computed.program, computed.scene_hash, computed.title)
    for other in (again, arcslip.load(tmp_path / "third.json")):
        for a, b in zip(loaded, other, strict=True):
            assert head(a) == head(b) and a.stop == b.stop
            same_tables(a, b)
    first, second = (json.loads((tmp_path / file).read_text()) for file in ("first.json", "second.json"))
    assert first.keys() == second.keys() and first["format"] == second["format"]


def test_results_of_a_file_have_units(scene: arcslip.Scene, tmp_path: Path) -> None:
    results = scene.frf(for_each={"damper.normal_load": [2.0, 4.0]})
    results.save(tmp_path / "results.json")
    loaded = arcslip.load(tmp_path / "results.json")
    for a, b in zip(results, loaded, strict=True):
        assert b.units == {name: unit for name, unit in a.units.items() if unit != "-"}
        assert b.set_units == {"damper.normal_load": "N"}
        assert b.events["peak"][0].amplitude == a.events["peak"][0].amplitude
        assert b.parameters == a.parameters
        assert repr(a) == repr(b)


def test_points_alone_are_read_from_csv(command: Path, examples: Path, tmp_path: Path) -> None:
    text = subprocess.run(
        [command, "frf", examples / "duffing/scene.json", "--csv", "-"], capture_output=True, text=True, check=True
    ).stdout
    (tmp_path / "points.csv").write_text(text)
    for branch in arcslip.load(tmp_path / "points.csv"):
        assert branch.amplitude.max() > 0 and branch.status == "" and list(branch.tables) == ["points"]


def test_file_that_holds_no_results_is_refused(tmp_path: Path, examples: Path, scene: arcslip.Scene) -> None:
    with pytest.raises(ValueError, match="no results"):
        arcslip.load(examples / "duffing/scene.json")
    with pytest.raises(OSError):
        arcslip.load(tmp_path / "none.json")
    for name, text in [("list.json", "[]"), ("other.csv", "a,b\n1,2\n"), ("empty.csv", "")]:
        (tmp_path / name).write_text(text)
        with pytest.raises(ValueError, match="no results"):
            arcslip.load(tmp_path / name)
    (tmp_path / "cut.csv").write_text("study,branch,amplitude (m)\nfrf,1,0.5\nfrf,1\n")
    with pytest.raises(ValueError, match="not complete"):
        arcslip.load(tmp_path / "cut.csv")
    scene.ensemble({"damper.normal_load": [2.0, 3.0]}, study="response", path=tmp_path / "samples.sqlite")
    with pytest.raises(ValueError, match=r"holds an ensemble: arcslip.Ensemble\("):
        arcslip.load(tmp_path / "samples.sqlite")


def test_files_of_events_and_damaged_ones_are_not_taken_for_points(command: Path, examples: Path, tmp_path: Path) -> None:
    subprocess.run([command, "frf", examples / "duffing/scene.json", "--csv", tmp_path / "c.csv", "--quiet"], check=True, capture_output=True)
    for name in ("events", "summary"):
        with pytest.raises(ValueError, match=f"has the {name} of c.csv, which is to be named"):
            arcslip.load(tmp_path / f"c.{name}.csv")
    (tmp_path / "cut.json").write_text('{"format": "arcslip-branches-1", ')
    with pytest.raises(ValueError, match="cut.json is no JSON, or not complete"):
        arcslip.load(tmp_path / "cut.json")
