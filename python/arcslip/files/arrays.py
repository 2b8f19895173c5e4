"""NumPy arrays, sparse matrices and tables in place of the files that a scene names, without the disk between."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

#: Keys of a scene that name a file with a matrix, or a vector as a matrix of one column.
MATRIX_KEYS = frozenset(
    ["mass", "stiffness", "damping", "stiffness_speed_squared", "gyroscopic", "circulatory", "shape", "imaginary_shape"]
)


def _is_array(value: Any) -> bool:
    return isinstance(value, np.ndarray) or hasattr(value, "tocoo")


def _as_matrix(value: Any) -> Any:
    """Return an array of a matrix, also of a data frame or of lists of rows; None for something else."""
    if hasattr(value, "to_numpy"):
        return value.to_numpy()
    if isinstance(value, list) and value and all(isinstance(row, list) for row in value):
        return np.asarray(value, dtype=float)
    return value if _is_array(value) and getattr(value, "ndim", 2) > 0 else None


def matrix_market(value: Any) -> bytes:
    """Return a matrix, sparse or full, or a vector as the text of a Matrix Market file, to the last bit."""
    if hasattr(value, "tocoo"):
        csr = value.tocsr(copy=True)
        csr.sum_duplicates()
        csr.eliminate_zeros()
        coo = csr.tocoo()
        rows, columns, values, shape = coo.row, coo.col, coo.data, coo.shape
    else:
        full = np.atleast_1d(value)
        full = full[:, np.newaxis] if full.ndim == 1 else full
        if full.ndim != 2:
            raise TypeError(f"found an array of {full.ndim} dimensions, must be a matrix or a vector")
        rows, columns = np.nonzero(full)
        values, shape = full[rows, columns], full.shape
    if values.dtype.kind not in "fiub":
        raise TypeError(f"found an array of {values.dtype}, must be real numbers")
    wrong = np.flatnonzero(~np.isfinite(values.astype(np.float64)))
    if len(wrong):
        i = wrong[0]
        raise ValueError(f"found {values[i]} at [{rows[i]}, {columns[i]}] of a matrix, must be finite")
    entries = zip(rows.tolist(), columns.tolist(), values.astype(np.float64).tolist(), strict=True)
    lines = [f"{i + 1} {j + 1} {value!r}\n" for i, j, value in entries]
    head = f"%%MatrixMarket matrix coordinate real general\n{shape[0]} {shape[1]} {len(lines)}\n"
    return (head + "".join(lines)).encode()


def named_rows(rows: Mapping[str, int]) -> bytes:
    """Return names of rows, which count from 0, as the text of a file of names."""
    return ("name,row\n" + "".join(f"{name},{int(row) + 1}\n" for name, row in rows.items())).encode()


def face_pairs(pairs: Any) -> bytes:
    """Return pairs of rows, shape (pairs, 2), which count from 0, as the text of a file of faces."""
    found = np.asarray(pairs)
    if found.ndim != 2 or found.shape[1] != 2 or found.dtype.kind not in "iu":
        raise TypeError(f"found faces of the shape {found.shape} and {found.dtype}, must be pairs of rows, whole numbers")
    return ("own,next\n" + "".join(f"{own + 1},{next_ + 1}\n" for own, next_ in found.tolist())).encode()


def _columns(value: Any) -> dict[str, list[Any]] | None:
    """Return the columns of a mapping, a data frame or a structured array; None for something else."""
    if isinstance(value, Mapping):
        columns = {str(name): np.asarray(each).tolist() for name, each in value.items()}
    elif isinstance(value, np.ndarray) and value.dtype.names:
        columns = {name: value[name].tolist() for name in value.dtype.names}
    elif hasattr(value, "to_dict") and hasattr(value, "columns"):
        columns = {str(name): list(each) for name, each in value.to_dict("list").items()}
    else:
        return None
    if any(not isinstance(each, list) for each in columns.values()) or len({len(each) for each in columns.values()}) > 1:
        raise ValueError(f"found columns of different lengths, {', '.join(columns)}, must be lists of the same one")
    return columns


def csv_table(columns: Mapping[str, Sequence[Any]]) -> bytes:
    """Return columns as the text of a CSV file; missing values are empty cells."""

    def cell(value: Any) -> str:
        text = "" if value is None or value != value else value if isinstance(value, str) else repr(value)
        if any(character in text for character in ',"\r\n'):
            raise ValueError(f"found {text!r} in a table, must be without commas, quotes and line breaks")
        return text

    lines = [",".join(map(cell, columns)), *(",".join(map(cell, row)) for row in zip(*columns.values(), strict=True))]
    return ("\n".join(lines) + "\n").encode()


class FileContent:
    """What stands in a dict in place of a file that is nowhere but in a scene."""

    def __init__(self, path: str, content: bytes) -> None:
        self.path = path
        self.content = content

    def __repr__(self) -> str:
        return f"<content of {self.path}, {len(self.content)} bytes>"


def with_contents(value: Any, files: Mapping[str, bytes]) -> Any:
    """Return a value of a scene with these files in place of their paths."""
    if isinstance(value, dict):
        return {key: with_contents(each, files) for key, each in value.items()}
    if isinstance(value, list):
        return [with_contents(each, files) for each in value]
    return FileContent(value, files[value]) if isinstance(value, str) and value in files else value


class Files:
    """Takes the arrays out of a scene, and puts the names of files in their place."""

    def __init__(self) -> None:
        self.contents: dict[str, bytes] = {}

    def add(self, key: str, content: bytes) -> str:
        extension = "mtx" if content.startswith(b"%%") else "csv"
        path = f"arrays/{key}.{extension}"
        number = 1
        while self.contents.get(path, content) != content:
            number += 1
            path = f"arrays/{key}_{number}.{extension}"
        self.contents[path] = content
        return path

    def plain(self, value: Any, key: str = "", inside: str = "") -> Any:
        """Return a value of a scene as JSON has it."""
        if isinstance(value, FileContent):
            self.contents[value.path] = value.content
            return value.path
        if key in MATRIX_KEYS and (matrix := _as_matrix(value)) is not None:
            return self.add(key, matrix_market(matrix))
        if key == "names" and isinstance(value, Mapping):
            return self.add(key, named_rows(value))
        if key == "faces" and not isinstance(value, str):
            return self.add(key, face_pairs(value))
        if key == "file" and (columns := _columns(value)) is not None:
            return self.add("table", csv_table(columns))
        if key == "for_each" and not isinstance(value, Mapping) and (columns := _columns(value)) is not None:
            return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]
        if isinstance(value, Mapping):
            return {str(name): self.plain(each, str(name), key) for name, each in value.items()}
        if isinstance(value, (np.ndarray, np.generic)):
            value = value.tolist()
        if isinstance(value, Sequence) and not isinstance(value, (str, bytes)):
            return [self.plain(each, inside=key or inside) for each in value]
        if isinstance(value, float) and not math.isfinite(value):
            raise ValueError(f"found {value} in {key or inside!r}, must be a finite number")
        return value


def as_json(value: Any) -> tuple[str, dict[str, bytes]]:
    """Return a scene, or keys of one, as the text of a JSON file and the files that stand for its arrays."""
    files = Files()
    plain = files.plain(value)
    return json.dumps(plain), files.contents
