"""Ensembles: rows against closed forms and the command, whoever computes them."""

from __future__ import annotations

import gc
import math
import multiprocessing
import os
import pickle
import shutil
import subprocess
import sys
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import arcslip
from arcslip.ensembles.ensemble import first_of_its_kind

DISTRIBUTIONS = {
    "distributions": {"k.value": {"uniform": [9e3, 1.1e4]}, "damper.normal_load": {"normal": [4, 0.4]}},
    "count": 60,
    "design": "latin_hypercube",
}


@pytest.fixture
def linear(oscillator: dict[str, Any]) -> arcslip.Scene:
    oscillator["elements"][0]["friction_coefficient"] = 0.0
    return arcslip.Scene(oscillator)


def same(a: arcslip.Ensemble, b: arcslip.Ensemble) -> bool:
    return a.columns == b.columns and all(
        np.array_equal(a[name], b[name], equal_nan=a[name].dtype.kind == "f") for name in a.columns
    )


def test_peaks_of_samples_are_those_of_the_closed_form(linear: arcslip.Scene) -> None:
    k, c = np.linspace(9e3, 1.1e4, 30), np.linspace(1.5, 3.0, 30)
    found = linear.ensemble({"k.value": k, "c.value": c}, keep=["peak.amplitude", "frequency"])
    assert len(found) == 30
    np.testing.assert_array_equal(found["k.value"], k)
    np.testing.assert_allclose(found["peak.amplitude"], 1 / (c * np.sqrt(k - c**2 / 4)), rtol=1e-8)
    np.testing.assert_allclose(found.frequency, np.sqrt(k - c**2 / 2) / (2 * np.pi), rtol=1e-6)
    assert found.units["frequency"] == "Hz"
    assert set(found.status) == {"complete"}
    assert found.results.dtype == np.int64


def test_worker_processes_keep_the_scene_that_they_have_reduced(linear: arcslip.Scene) -> None:
    first = first_of_its_kind(linear)
    assert first_of_its_kind(pickle.loads(pickle.dumps(linear))) is first
    other = linear.replace({"k.value": 9e3})
    assert first_of_its_kind(other) is other


def test_threads_processes_and_the_command_give_the_same(
    oscillator: dict[str, Any], command: Path, tmp_path: Path
) -> None:
    oscillator["studies"][0]["for_each"] = DISTRIBUTIONS
    scene = arcslip.Scene(oscillator)
    by_threads = scene.ensemble()
    assert same(scene.ensemble(threads=1), by_threads)
    with ThreadPoolExecutor(2) as executor:
        assert same(scene.ensemble(executor=executor), by_threads)
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as executor:
        assert same(scene.ensemble(executor=executor), by_threads)
    (tmp_path / "scene.json").write_text(scene.to_json())
    subprocess.run(
        [command, "ensemble", "scene.json", "--out", "a.sqlite"], cwd=tmp_path, check=True, capture_output=True
    )
    assert same(arcslip.Ensemble(tmp_path / "a.sqlite"), by_threads)


def test_samples_from_distributions_are_an_argument(scene: arcslip.Scene) -> None:
    found = scene.ensemble(DISTRIBUTIONS, keep=["amplitude"])
    assert len(found) == 60
    assert len(set(np.floor((found["k.value"] - 9e3) / (2e3 / 60)))) == 60


def test_statistics_are_those_of_numpy(scene: arcslip.Scene) -> None:
    found = scene.ensemble(DISTRIBUTIONS, keep=["amplitude"])
    of = found.table("statistics")
    row = next(row for row in of if row["name"] == "amplitude")
    assert row["mean"] == pytest.approx(found.amplitude.mean(), rel=1e-12)
    assert row["standard_deviation"] == pytest.approx(found.amplitude.std(ddof=1), rel=1e-9)
    assert row["q05"] == pytest.approx(np.quantile(found.amplitude, 0.05), rel=1e-12)
    pairs = found.table("correlations")
    expected = np.corrcoef(found.amplitude, found["damper.normal_load"])[0, 1]
    chosen = (pairs["name"] == "amplitude") & (pairs["other"] == "damper.normal_load")
    assert pairs["coefficient"][chosen] == pytest.approx([expected], abs=1e-10)
    with pytest.raises(KeyError, match="no table 'event'"):
        found.table("event")


def test_a_file_is_continued(scene: arcslip.Scene, tmp_path: Path) -> None:
    path = tmp_path / "a.sqlite"
    samples = {"damper.normal_load": np.linspace(3, 5, 40)}
    calls = []

    def stop(now: dict[str, Any]) -> bool:
        calls.append(now["branch"])
        return len(calls) < 2

    with ThreadPoolExecutor(1) as executor, pytest.warns(arcslip.ArcslipWarning, match="stopped: .* of 40 samples"):
        part = scene.ensemble(samples, path=path, executor=executor, progress=stop)
    assert 0 < len(part) < 40
    whole = scene.ensemble(samples, path=path)
    assert len(whole) == 40
    assert same(whole, scene.ensemble(samples))
    with pytest.raises(ValueError, match="the scene has changed since"):
        scene.ensemble({"damper.normal_load": np.linspace(3, 6, 40)}, path=path)
    (tmp_path / "text").write_text("no database, but a text that is long enough")
    with pytest.raises(OSError, match="no SQLite database"):
        scene.ensemble(samples, path=tmp_path / "text")
    with pytest.raises(ValueError, match="no ensemble"):
        arcslip.Ensemble(tmp_path / "text")
    with pytest.raises(FileNotFoundError):
        arcslip.Ensemble(tmp_path / "none")


class Failing(Executor):
    """An executor that loses each third chunk."""

    def __init__(self, always: bool) -> None:
        self.count = 0
        self.always = always

    def submit(self, function: Any, /, *arguments: Any, **keywords: Any) -> Future[Any]:
        self.count += 1
        future: Future[Any] = Future()
        if self.always or self.count % 3 == 0:
            future.set_exception(RuntimeError("the worker was lost"))
        else:
            future.set_result(function(*arguments, **keywords))
        return future


def test_lost_chunks_are_computed_again(scene: arcslip.Scene, tmp_path: Path) -> None:
    samples = {"damper.normal_load": np.linspace(3, 5, 40)}
    found = scene.ensemble(samples, executor=Failing(False))
    assert same(found, scene.ensemble(samples))
    with pytest.raises(RuntimeError, match="the worker was lost"):
        scene.ensemble(samples, executor=Failing(True), path=tmp_path / "a.sqlite")
    assert len(scene.ensemble(samples, path=tmp_path / "a.sqlite")) == 40


def test_a_sample_that_fails_is_a_row(oscillator: dict[str, Any]) -> None:
    oscillator["excitation"].append({"name": "weight", "at": "x", "harmonic": 0, "cosine": 1.0})
    found = arcslip.Scene(oscillator).ensemble({"k.value": [1e4, 0.0]})
    assert list(found.status) == ["complete", "failed"]
    assert "no spring holds the mean position" in found.reason[1]
    assert np.isfinite(found.amplitude[0]) and np.isnan(found.amplitude[1])


def test_whole_tables_are_kept(scene: arcslip.Scene) -> None:
    found = scene.ensemble({"damper.normal_load": [3.0, 4.0]}, keep=["amplitude", "events", "points"])
    points, events = found.table("points"), found.table("events")
    assert set(points["sample"]) == {0, 1}
    for i, load in enumerate([3.0, 4.0]):
        branch = scene.replace({"damper.normal_load": load}).frf()[0]
        np.testing.assert_allclose(points["amplitude"][points["sample"] == i], branch.amplitude)
        assert events["amplitude"][events["sample"] == i].max() == found.amplitude[i]


def test_results_outlive_what_made_them_and_are_pickled(scene: arcslip.Scene) -> None:
    found = scene.ensemble({"damper.normal_load": [3.0, 4.0]})
    folder = found.path.parent
    restored = pickle.loads(pickle.dumps(found))
    np.testing.assert_array_equal(restored["amplitude"], found["amplitude"])
    assert folder.exists()
    del found
    gc.collect()
    assert not folder.exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"samples": {}}, "found no samples"),
        ({"samples": {"k.value": []}}, "found no samples"),
        ({"samples": {"k.value": [1.0], "c.value": [1.0, 2.0]}}, "different lengths"),
        ({"samples": {"k.value": [[1.0]]}}, "found 2 dimensions"),
        ({"samples": None}, "the study has no samples"),
        ({"samples": {"k.value": [1.0]}, "study": "x"}, "must be one of"),
        ({"samples": {"k.value": [1e4]}, "keep": ["amplitud"]}, 'did you mean "amplitude"'),
        ({"samples": {"k.value": [1e4]}, "threads": 0}, "threads=0"),
    ],
)
def test_what_cannot_be_is_refused(scene: arcslip.Scene, arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        scene.ensemble(**arguments)


def test_values_out_of_bounds_are_faults(scene: arcslip.Scene) -> None:
    with pytest.raises(arcslip.SceneError, match="must be at least 0"):
        scene.ensemble({"damper.normal_load": [1.0, -1.0]})


def test_dask_computes_the_same(scene: arcslip.Scene) -> None:
    distributed = pytest.importorskip("distributed")
    samples = {"damper.normal_load": np.linspace(3, 5, 40)}
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=False, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            found = scene.ensemble(samples, executor=client.get_executor())
    assert same(found, scene.ensemble(samples))


def test_ranks_of_mpi_compute_the_same(oscillator: dict[str, Any], tmp_path: Path) -> None:
    pytest.importorskip("mpi4py")
    mpiexec = shutil.which("mpiexec")
    if mpiexec is None:
        pytest.skip("needs mpiexec")
    oscillator["studies"][0]["for_each"] = DISTRIBUTIONS
    (tmp_path / "scene.json").write_text(arcslip.Scene(oscillator).to_json())
    (tmp_path / "run.py").write_text(
        "import arcslip\n"
        "from mpi4py.futures import MPIPoolExecutor\n"
        "if __name__ == '__main__':\n"
        "    with MPIPoolExecutor() as executor:\n"
        "        arcslip.Scene('scene.json').ensemble(executor=executor, path='mpi.sqlite')\n"
    )
    ranks = [mpiexec, "--allow-run-as-root", "--oversubscribe", "-n", "3", sys.executable, "-P", "-m", "mpi4py.futures", "run.py"]
    environment = os.environ | {"OMPI_MCA_btl_vader_single_copy_mechanism": "none", "OMPI_MCA_rmaps_base_oversubscribe": "1"}
    subprocess.run(ranks, cwd=tmp_path, check=True, capture_output=True, env=environment, timeout=120)
    assert same(arcslip.Ensemble(tmp_path / "mpi.sqlite"), arcslip.Scene(oscillator).ensemble())


def test_samples_are_columns_of_files_and_tables(scene: arcslip.Scene, tmp_path: Path) -> None:
    arrow, pandas = pytest.importorskip("pyarrow"), pytest.importorskip("pandas")
    parquet = pytest.importorskip("pyarrow.parquet")
    columns = {"k.value": np.linspace(9e3, 1.1e4, 12), "damper.normal_load": np.linspace(3, 5, 12)}
    expected = scene.ensemble(columns)
    parquet.write_table(arrow.table(columns), tmp_path / "mc.parquet")
    pandas.DataFrame(columns).to_csv(tmp_path / "mc.csv", index=False, float_format="%.17g")
    rows = np.array(list(zip(*columns.values(), strict=True)), dtype=[(name, float) for name in columns])
    expected.to_parquet(tmp_path / "own.parquet")
    for samples in (tmp_path / "own.parquet", expected.to_dataframe(), tmp_path / "mc.parquet", str(tmp_path / "mc.csv"), arrow.table(columns), rows, pandas.DataFrame(columns)):
        assert same(scene.ensemble(samples), expected)
    with pytest.raises(ValueError, match="is the file of the ensemble itself"):
        expected.to_npz(expected.path)
    with pytest.raises(TypeError, match="found executor=4"):
        scene.ensemble(columns, executor=4)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="found samples of type ndarray"):
        scene.ensemble(np.ones((3, 2)))
    (tmp_path / "wrong.csv").write_text("k.value\n1,2\n")
    with pytest.raises(ValueError, match="found 2 columns"):
        scene.ensemble(tmp_path / "wrong.csv")


def test_samples_become_parquet_and_arrays(scene: arcslip.Scene, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    monkeypatch.setattr("arcslip.ensembles.tables.BATCH", 7)
    found = scene.ensemble(DISTRIBUTIONS, keep=["amplitude", "fold.frequency"])
    found.to_parquet(tmp_path / "a.parquet")
    found.to_npz(tmp_path / "a.npz")
    table, arrays = parquet.read_table(tmp_path / "a.parquet"), np.load(tmp_path / "a.npz")
    assert table.column_names == list(found.columns) == list(arrays)
    assert table.schema.field("amplitude").metadata == {b"unit": b"m"}
    assert table.schema.metadata[b"count"] == b"60"
    for name in found.columns:
        read = table[name].to_numpy()
        if found[name].dtype.kind == "f":
            np.testing.assert_array_equal(read.astype(float), found[name])
        np.testing.assert_array_equal(arrays[name], found[name])


def test_sobol_indices_are_those_of_a_product(scene: arcslip.Scene) -> None:
    pytest.importorskip("SALib")
    scene = scene.replace({"damper.normal_load": 0.0, "c.value": 1e-3})
    spread = {"k.value": 0.1, "m.value": 0.05}
    mean = {"k.value": 1e4, "m.value": 1.0}
    lognormal = {name: {"lognormal": [mean[name], mean[name] * spread[name]]} for name in spread}
    found = scene.ensemble(arcslip.saltelli(lognormal | {"c.value": {"uniform": [1e-3, 2e-3]}}, 256), study="response")
    indices = found.sobol_indices("frequency")
    # frequency = sqrt(k/m)/(2 pi): of lognormal k and m the logarithms have the variances log(1 + spread^2)
    variance = {name: math.log(1 + each**2) for name, each in spread.items()}
    terms = {name: math.expm1(each / 4) for name, each in variance.items()}
    whole = math.expm1(sum(variance.values()) / 4)
    assert indices.parameters == ("k.value", "m.value", "c.value")
    first = [terms["k.value"] / whole, terms["m.value"] / whole, 0]
    total = [terms["k.value"] * (1 + terms["m.value"]) / whole, terms["m.value"] * (1 + terms["k.value"]) / whole, 0]
    assert np.all(np.abs(indices.first - first) <= np.maximum(indices.first_error, 1e-6))
    assert np.all(np.abs(indices.total - total) <= np.maximum(indices.total_error, 1e-6))
    assert indices.first_error.max() < 0.15
    with pytest.raises(ValueError, match="other samples than those of arcslip.saltelli"):
        scene.ensemble(DISTRIBUTIONS).sobol_indices("frequency")
    with pytest.raises(ValueError, match="found count=100, must be a power of two"):
        arcslip.saltelli(lognormal, 100)
    for nothing in ({}, {"k.value": {}}):
        with pytest.raises(ValueError, match="must have one distribution"):
            arcslip.saltelli(nothing, 8)
    with pytest.raises(ValueError, match="found the distribution 'gamma' of 'k.value'"):
        arcslip.saltelli({"k.value": {"gamma": [1, 2]}}, 8)
    with pytest.raises(ValueError, match="is the same in all samples"):
        found.sobol_indices("results")


def test_scene_without_studies_takes_a_kind(oscillator: dict[str, Any]) -> None:
    studies = oscillator.pop("studies")
    samples = {"damper.normal_load": [3.0, 4.0]}
    scene = arcslip.Scene(oscillator)
    with pytest.raises(ValueError, match="the scene has no study: name a kind"):
        scene.ensemble(samples)
    found = scene.ensemble(samples, study="frf")
    expected = arcslip.Scene(oscillator | {"studies": studies}).ensemble(samples)
    np.testing.assert_allclose(found.amplitude, expected.amplitude, rtol=1e-6)
