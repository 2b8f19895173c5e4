"""Ensembles as Parquet and NPZ files, and samples from tables."""

from __future__ import annotations

import os
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..extras import required
from ..files.sqlite_files import connected

if TYPE_CHECKING:
    from .ensemble import Ensemble

#: Rows that are in memory at the same time.
BATCH = 65536


def _batches(ensemble: Ensemble) -> Iterator[list[tuple[Any, ...]]]:
    with closing(connected(ensemble.path)) as file:
        rows = file.execute("SELECT * FROM samples ORDER BY sample")
        while batch := rows.fetchmany(BATCH):
            yield batch


def _check_place(ensemble: Ensemble, path: str | os.PathLike[str]) -> None:
    if Path(path).exists() and Path(path).samefile(ensemble.path):
        raise ValueError(f"{os.fspath(path)} is the file of the ensemble itself, which is left as it is")


def write_parquet(ensemble: Ensemble, path: str | os.PathLike[str]) -> None:
    """Write the samples, some at a time; the metadata of each column has its unit."""
    _check_place(ensemble, path)
    arrow, parquet = required("pyarrow", "ensemble"), required("pyarrow.parquet", "ensemble")
    kinds = {"INTEGER": arrow.int64(), "REAL": arrow.float64(), "TEXT": arrow.string()}
    with closing(connected(ensemble.path)) as file:
        declared = {row[1]: row[2] for row in file.execute("PRAGMA table_info(samples)")}
    schema = arrow.schema(
        [
            arrow.field(name, kinds.get(kind, arrow.float64()), metadata={"unit": ensemble.units.get(name, "")})
            for name, kind in declared.items()
        ],
        metadata={str(key): str(value) for key, value in ensemble.about.items()},
    )
    with parquet.ParquetWriter(os.fspath(path), schema) as writer:
        for batch in _batches(ensemble):
            columns = [arrow.array(values, field.type) for values, field in zip(zip(*batch, strict=True), schema, strict=True)]
            writer.write_table(arrow.Table.from_arrays(columns, schema=schema))


def write_npz(ensemble: Ensemble, path: str | os.PathLike[str]) -> None:
    """Write the samples as `numpy.load` reads them, a column at a time."""
    _check_place(ensemble, path)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in ensemble.columns:
            with archive.open(f"{name}.npy", "w", force_zip64=True) as file:
                np.lib.format.write_array(file, np.asarray(ensemble._load(ensemble._places[name])), allow_pickle=False)


def columns_of(samples: Any) -> Mapping[str, Any]:
    """Return the columns of samples: of a mapping, a data frame, a structured array, or a file, Parquet or CSV.

    Raises
    ------
    TypeError
        If they are something else.
    """
    if isinstance(samples, (str, os.PathLike)):
        return _parameters_of(_columns_of_file(Path(samples)))
    if isinstance(samples, np.ndarray) and samples.dtype.names:
        return {name: samples[name] for name in samples.dtype.names}
    if isinstance(samples, Mapping):
        return samples
    if hasattr(samples, "column_names"):  # of pyarrow
        return _parameters_of({name: samples[name].to_numpy() for name in samples.column_names})
    if hasattr(samples, "keys"):
        return _parameters_of({str(name): samples[name] for name in samples.keys()})  # noqa: SIM118, of data frames
    raise TypeError(f"found samples of type {type(samples).__name__}, must be columns by name, or a file with some")


def _parameters_of(columns: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return the parameters of the samples of an ensemble, between their numbers and their status; else all columns."""
    names = list(columns)
    if names[:1] != ["sample"] or "status" not in names:
        return columns
    return {name: columns[name] for name in names[1 : names.index("status")]}


def _columns_of_file(path: Path) -> Mapping[str, Any]:
    if path.suffix == ".parquet":
        table = required("pyarrow.parquet", "ensemble").read_table(os.fspath(path))
        return {name: table[name].to_numpy() for name in table.column_names}
    with path.open(encoding="utf-8") as file:
        names = [name.strip() for name in file.readline().lstrip("#").split(",")]
        rows = np.loadtxt(file, delimiter=",", ndmin=2)
    if rows.shape[1] != len(names):
        raise ValueError(f"{path}: found {rows.shape[1]} columns, must be as many as the {len(names)} names of the header")
    return dict(zip(names, rows.T, strict=True))


