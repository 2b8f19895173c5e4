"""NumPy arrays and sparse matrices in place of the files that a scene names, without the disk between."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

#: Keys of a scene that name a file with a matrix, or a vector as a matrix of one column.
MATRIX_KEYS = frozenset(
    ["mass", "stiffness", "damping", "stiffness_speed_squared", "gyroscopic", "circulatory", "shape", "imaginary_shape"]
)


def _is_array(value: Any) -> bool:
    return isinstance(value, np.ndarray) or hasattr(value, "tocoo")


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
    entries = zip(rows.tolist(), columns.tolist(), values.astype(np.float64).tolist(), strict=True)
    lines = [f"{i + 1} {j + 1} {value!r}\n" for i, j, value in entries]
    head = f"%%MatrixMarket matrix coordinate real general\n{shape[0]} {shape[1]} {len(lines)}\n"
    return (head + "".join(lines)).encode()


def named_rows(rows: Mapping[str, int]) -> bytes:
    """Return names of rows, which count from 0, as the text of a file of names."""
    return ("name,row\n" + "".join(f"{name},{int(row) + 1}\n" for name, row in rows.items())).encode()


class Files:
    """Takes the arrays out of a scene, and puts the names of files in their place."""

    def __init__(self) -> None:
        self.contents: dict[str, bytes] = {}

    def add(self, key: str, content: bytes) -> str:
        extension = "csv" if content.startswith(b"name,row") else "mtx"
        path = f"arrays/{key}.{extension}"
        number = 1
        while self.contents.get(path, content) != content:
            number += 1
            path = f"arrays/{key}_{number}.{extension}"
        self.contents[path] = content
        return path

    def plain(self, value: Any, key: str = "", inside: str = "") -> Any:
        """Return a value of a scene as JSON has it."""
        if key in MATRIX_KEYS and _is_array(value) and getattr(value, "ndim", 2) > 0:
            return self.add(key, matrix_market(value))
        if key == "names" and isinstance(value, Mapping):
            return self.add(key, named_rows(value))
        if isinstance(value, Mapping):
            return {str(name): self.plain(each, str(name), key) for name, each in value.items()}
        if isinstance(value, (np.ndarray, np.generic)):
            return value.tolist()
        if isinstance(value, Sequence) and not isinstance(value, (str, bytes)):
            return [self.plain(each) for each in value]
        return value


def as_json(value: Any) -> tuple[str, dict[str, bytes]]:
    """Return a scene, or keys of one, as the text of a JSON file and the files that stand for its arrays."""
    files = Files()
    plain = files.plain(value)
    return json.dumps(plain), files.contents
