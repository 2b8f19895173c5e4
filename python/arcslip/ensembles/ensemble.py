"""Ensembles: a study for many samples of parameters."""

from __future__ import annotations

import functools
import json
import os
import shutil
import tempfile
import time
import warnings
import weakref
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _core
from ..errors import ArcslipWarning
from ..files.arrays import as_json
from ..files.sqlite_files import column, connected, quoted
from ..names import nearest
from ..progress import Progress, Report, reporting
from ..tables import Table
from ..threads import available, checked
from .sobol import SobolIndices, indices
from .tables import columns_of, write_npz, write_parquet

if TYPE_CHECKING:
    from ..scene import Scene

#: All samples, however many there are.
ALL = (0, 10**9)
#: Chunks for an executor take about this long, in seconds, after a first one of few samples.
CHUNK_SECONDS = 0.5
FIRST_CHUNK = 4
LARGEST_CHUNK = 10_000
#: A chunk whose worker fails is computed again so many times.
ATTEMPTS = 3
COMMIT_EVERY = 1.0


class Ensemble(Table):
    """The samples of an ensemble, a row each: parameters, `status`, `reason`, `doubt`, `results` and what was kept.

    Columns are read from the file when they are asked for. Of samples that are not complete, numbers are NaN or those up to
    where the computation ended.

    Parameters
    ----------
    path : path
        A file that `Scene.ensemble` or the command has written.

    Raises
    ------
    ValueError
        If the file is no ensemble.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        #: The file.
        self.path = Path(path)
        if not self.path.is_file():
            raise FileNotFoundError(f"found no file {str(self.path)!r}")
        import sqlite3

        try:
            with closing(connected(self.path)) as file:
                self.about = dict(file.execute("SELECT key, value FROM ensemble"))
                (count,) = file.execute("SELECT count(*) FROM samples").fetchone()
                names = [row[1] for row in file.execute("PRAGMA table_info(samples)")]
                units = dict(file.execute("SELECT name, unit FROM columns WHERE of = 'samples' AND unit NOT IN ('', '-')"))
                self._tables = {name for (name,) in file.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
        except sqlite3.Error as error:
            raise ValueError(f"{self.path}: found a file that is no ensemble: {error}") from None
        super().__init__(names, count, lambda i: column(self.path, "samples", names[i], "sample"), units)

    def table(self, name: str) -> Table:
        """Return another table of the file.

        Parameters
        ----------
        name : str
            `"events"` or `"points"`, where they are kept; `"statistics"`, `"histograms"` or `"correlations"`.

        Raises
        ------
        KeyError
            If the file has no such table.
        """
        if name not in self._tables:
            raise KeyError(f"no table {name!r}, must be one of {sorted(self._tables)}")
        with closing(connected(self.path)) as file:
            (count,) = file.execute(f"SELECT count(*) FROM {quoted(name)}").fetchone()
            names = [row[1] for row in file.execute(f"PRAGMA table_info({quoted(name)})")]
            units = dict(file.execute("SELECT name, unit FROM columns WHERE of = ? AND unit NOT IN ('', '-')", (name,)))
        return Table(names, count, lambda i: column(self.path, name, names[i], "rowid"), units)

    def to_parquet(self, path: str | os.PathLike[str]) -> None:
        """Write the samples to a Parquet file, with the unit of each column in its metadata.

        Memory does not grow with their number.

        Raises
        ------
        ImportError
            If pyarrow is not installed: the extra ``arcslip[ensemble]`` has it.
        """
        write_parquet(self, path)

    def to_npz(self, path: str | os.PathLike[str]) -> None:
        """Write the samples to a file that `numpy.load` reads, an array for each column."""
        write_npz(self, path)

    def sobol_indices(self, quantity: str, *, seed: int = 1) -> SobolIndices:
        """Return the Sobol indices of a quantity, by SALib, of an ensemble whose samples are those of `saltelli`.

        Parameters
        ----------
        quantity : str
            A column: "amplitude".
        seed : int
            Of the bootstrap that gives their errors.

        Raises
        ------
        ValueError
            If the samples are others, if some are not complete, or if the quantity does not vary.
        ImportError
            If SALib is not installed: the extra ``arcslip[ensemble]`` has it.
        """
        return indices(self, quantity, seed)

    def __reduce__(self) -> Any:
        return super().__reduce__()

    def __repr__(self) -> str:
        return f"<ensemble of {len(self)} samples: {', '.join(self.heads())}>"


def _rows(samples: Any) -> list[dict[str, float]]:
    columns = {str(name): np.asarray(values, dtype=float) for name, values in columns_of(samples).items()}
    for name, values in columns.items():
        if values.ndim != 1:
            raise ValueError(f"found {values.ndim} dimensions of {name!r}, must be one value for each sample")
    lengths = {name: len(values) for name, values in columns.items()}
    if len(set(lengths.values())) > 1:
        raise ValueError(f"found columns of different lengths: {lengths}")
    if not columns or min(lengths.values()) == 0:
        raise ValueError("found no samples, must be a value of each of some parameters")
    names = list(columns)
    return [dict(zip(names, row, strict=True)) for row in zip(*(values.tolist() for values in columns.values()), strict=True)]


def _with_samples(scene: Scene, samples: Any, study: str | None) -> tuple[_core.Scene, int]:
    """Return the scene with these samples, and the index of its study."""
    core = scene._data
    own = [name for name, _ in core.studies()]
    kinds = [kind["name"] for kind in _core.kinds()]
    if not own and study is None:
        raise ValueError(f"the scene has no study: name a kind of study, as study={kinds[0]!r}")
    if study is not None and study not in [*own, *kinds]:
        raise ValueError(f"found study={study!r}, must be one of {own}, or a kind of study{nearest(study, [*own, *kinds])}")
    if samples is None:
        studies = json.loads(core.write())["studies"]
        wanted = [i for i, each in enumerate(studies) if each["for_each"] and study in (None, each["name"])]
        if not wanted:
            raise ValueError("the study has no samples: give some, or a scene whose study has them as \"for_each\"")
        return core, wanted[0]
    index = own.index(study) if study in own else 0
    for_each = dict(samples) if isinstance(samples, Mapping) and "distributions" in samples else _rows(samples)
    text, _ = as_json({"for_each": for_each})
    if study is not None and study not in own:
        return core.with_study(study, None, text)
    return core.with_study(core.studies()[index][1], index, text)


@functools.lru_cache(maxsize=1)
def first_of_its_kind(scene: Scene) -> Scene:
    """Return the first scene of this content that a process has met, which has its structure reduced."""
    return scene


def compute_chunk(scene: Scene, index: int, keep: str, samples: tuple[int, int]) -> tuple[dict[str, list[Any]], float]:
    """Compute some samples of a study. Return the rows of each table, and the time in seconds."""
    begin = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "chunk.sqlite"
        _, _, error = _core.run_ensemble(first_of_its_kind(scene)._data, index, keep, str(path), samples, 1, None)
        if error is not None:
            raise error
        with closing(connected(path)) as file:
            tables = ["samples", *(name for (name,) in file.execute("SELECT DISTINCT of FROM columns WHERE of != 'samples'"))]
            rows = {name: file.execute(f"SELECT * FROM {quoted(name)} ORDER BY rowid").fetchall() for name in tables}
    return rows, time.perf_counter() - begin


class _Chunks:
    """The samples that are to be computed, in chunks of about the same time."""

    def __init__(self, missing: Sequence[tuple[int, int]]) -> None:
        self._missing = list(reversed(missing))
        self._size = FIRST_CHUNK

    def measured(self, count: int, seconds: float) -> None:
        self._size = int(np.clip(CHUNK_SECONDS * count / max(seconds, 1e-6), 1, min(4 * self._size, LARGEST_CHUNK)))

    def __iter__(self) -> Iterator[tuple[int, int]]:
        while self._missing:
            begin, end = self._missing.pop()
            middle = min(begin + self._size, end)
            if middle < end:
                self._missing.append((middle, end))
            yield begin, middle


class _Collector:
    """What an executor has computed, as it becomes rows of the file."""

    def __init__(self, path: str, report: Report | None) -> None:
        self._file = connected(path, "rw")
        self._file.execute("PRAGMA locking_mode = EXCLUSIVE")
        self._file.execute("PRAGMA journal_mode = WAL")
        self._file.execute("BEGIN")
        self._report = report
        self._committed = time.monotonic()
        counts = "SELECT count(*), count(*) FILTER (WHERE status != 'complete') FROM samples"
        self.done: int
        self.failed: int
        self.done, self.failed = self._file.execute(counts).fetchone()
        (self._all,) = self._file.execute("SELECT value FROM ensemble WHERE key = 'count'").fetchone()
        names = [row[1] for row in self._file.execute("PRAGMA table_info(samples)")]
        self._status = names.index("status")

    def add(self, rows: Mapping[str, list[Any]]) -> bool:
        """Add the rows of a chunk; return False where the caller wants an end."""
        for table, some in rows.items():
            if some:
                marks = ", ".join("?" * len(some[0]))
                self._file.executemany(f"INSERT INTO {quoted(table)} VALUES ({marks})", some)
        self.done += len(rows["samples"])
        self.failed += sum(row[self._status] != "complete" for row in rows["samples"])
        if time.monotonic() - self._committed > COMMIT_EVERY:
            self._file.execute("COMMIT")
            self._file.execute("BEGIN")
            self._committed = time.monotonic()
        return self._report is None or self._report(self._now()) is not False

    def _now(self) -> dict[str, Any]:
        return {
            "branch": self.done,
            "branches": int(self._all),
            "points": self.failed,
            "frequency": 0.0,
            "step": 0.0,
            "share_done": 0.0,
            "item": "sample",
            "counted": "not complete",
            "phase": "",
            "order": 0,
            "best": float("nan"),
        }

    def close(self) -> None:
        self._file.execute("COMMIT")
        self._file.execute("PRAGMA journal_mode = DELETE")
        self._file.close()


def _by_executor(scene: Scene, index: int, keep: str, path: str, executor: Executor, report: Report | None) -> int:
    """Compute what a file does not have, by an executor; return the number of samples that it has."""
    chunks = _Chunks(_core.missing_samples(scene._data, index, keep, path))
    left = iter(chunks)
    at_once = 2 * int(getattr(executor, "_max_workers", None) or available())
    running: dict[Future[Any], tuple[tuple[int, int], int]] = {}

    def submit(samples: tuple[int, int], attempt: int) -> None:
        running[executor.submit(compute_chunk, scene, index, keep, samples)] = samples, attempt

    collector = _Collector(path, report)
    try:
        goes_on = True
        while goes_on:
            while len(running) < at_once and (samples := next(left, None)) is not None:
                submit(samples, 1)
            if not running:
                break
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                samples, attempt = running.pop(future)
                error = future.exception()
                if error is None:
                    rows, seconds = future.result()
                    chunks.measured(samples[1] - samples[0], seconds)
                    goes_on = collector.add(rows) and goes_on
                elif isinstance(error, ValueError) or attempt == ATTEMPTS:
                    raise error
                else:
                    submit(samples, attempt + 1)
    finally:
        for future in running:
            future.cancel()
        collector.close()
    return collector.done


def ensemble(
    scene: Scene,
    samples: Any,
    study: str | None,
    keep: Sequence[str],
    executor: Executor | None,
    threads: int | None,
    path: str | os.PathLike[str] | None,
    progress: Progress | None,
) -> Ensemble:
    """Compute an ensemble: `Scene.ensemble`."""
    checked(threads)
    if executor is not None and not hasattr(executor, "submit"):
        raise TypeError(f"found executor={executor!r}, must be one of concurrent.futures, or None")
    core, index = _with_samples(scene, samples, study)
    names = keep if isinstance(keep, str) else ",".join(keep)
    if path is not None:
        return _computed(type(scene)._of(core), index, names, os.fspath(path), executor, threads, progress)
    folder = tempfile.mkdtemp(prefix="arcslip-")
    try:
        file = os.path.join(folder, "ensemble.sqlite")
        found = _computed(type(scene)._of(core), index, names, file, executor, threads, progress)
    except BaseException:
        shutil.rmtree(folder, ignore_errors=True)
        raise
    weakref.finalize(found, shutil.rmtree, folder, ignore_errors=True)
    return found


def _computed(
    scene: Scene,
    index: int,
    keep: str,
    file: str,
    executor: Executor | None,
    threads: int | None,
    progress: Progress | None,
) -> Ensemble:
    core = scene._data
    error: BaseException | None = None
    with reporting(progress, core.studies()[index][0]) as report:
        if executor is None:
            _, _, error = _core.run_ensemble(core, index, keep, file, ALL, checked(threads), report)
        else:
            _by_executor(scene, index, keep, file, executor, report)
    if error is not None:
        raise error
    with closing(connected(file)) as read:
        (count,) = read.execute("SELECT value FROM ensemble WHERE key = 'count'").fetchone()
        (done,) = read.execute("SELECT count(*) FROM samples").fetchone()
    if done == int(count):
        _core.add_statistics(file)
    else:
        warnings.warn(f"stopped: {done} of {count} samples were computed", ArcslipWarning, 4)
    return Ensemble(file)
