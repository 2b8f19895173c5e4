"""The program arcslip-mat of the package: reads a matrix of a MATLAB file by SciPy or h5py, as lib/scene/files/mat_protocol.hpp says."""

from __future__ import annotations

import os
import sys
import sysconfig
from pathlib import Path
from typing import Any

import numpy as np

from ..extras import required

MUST = ", must be a real matrix of doubles, sparse or full"
DAMAGED = "found a file that cannot be read; it may be damaged"


class MatFault(Exception):
    """What was found in the place of a matrix, and in which variable."""

    def __init__(self, cause: str, variable: str = "") -> None:
        super().__init__(cause)
        self.variable = variable


def provide() -> None:
    """Name the program for this process and those that it starts, unless the user has named one."""
    program = Path(sysconfig.get_path("scripts")) / "arcslip-mat"
    if "ARCSLIP_MAT" not in os.environ and program.exists():
        os.environ["ARCSLIP_MAT"] = str(program)


def _checked(matrix: Any, name: str) -> Any:
    """Return a matrix as SciPy's compressed columns."""
    sparse = required("scipy.sparse", "mat")
    if not (isinstance(matrix, np.ndarray) or sparse.issparse(matrix)):
        raise MatFault(f"found an object{MUST}", name)
    if matrix.dtype.names is not None:
        raise MatFault(f"found a struct{MUST}", name)
    if matrix.dtype.kind == "c":
        raise MatFault(f"found a complex matrix{MUST}", name)
    if matrix.dtype.kind == "b":
        raise MatFault(f"found a logical matrix{MUST}", name)
    if matrix.dtype.kind != "f" or matrix.dtype.itemsize != 8:
        words = {"O": "a cell array", "U": "characters", "S": "characters"}
        raise MatFault(f"found {words.get(matrix.dtype.kind, matrix.dtype.name)}{MUST}", name)
    if matrix.ndim != 2:
        raise MatFault(f"found an array of {matrix.ndim} dimensions{MUST}", name)
    found = sparse.csc_array(matrix) if sparse.issparse(matrix) else sparse.csc_array(sparse.coo_array(matrix))
    found.sum_duplicates()
    return found


def _read_version_5(path: str, name: str) -> tuple[str, Any] | list[str]:
    io = required("scipy.io", "mat")
    names = [str(each) for each, _, _ in io.whosmat(path)]
    chosen = name or (names[0] if len(names) == 1 else "")
    if chosen not in names:
        return names
    kinds = {str(each): str(kind) for each, _, kind in io.whosmat(path)}
    if kinds[chosen] in ("logical",):
        raise MatFault(f"found a logical matrix{MUST}", chosen)
    if kinds[chosen] not in ("double", "sparse"):  # numbers may be stored in fewer bytes than their class has
        words = {"cell": "a cell array", "struct": "a struct", "char": "characters", "single": "singles"}
        raise MatFault(f"found {words.get(kinds[chosen], kinds[chosen])}{MUST}", chosen)
    matrix = io.loadmat(path, variable_names=[chosen])[chosen]
    return chosen, matrix.astype(np.float64) if matrix.dtype.kind in "iu" else matrix


def _read_version_73(path: str, name: str) -> tuple[str, Any] | list[str]:
    h5py = required("h5py", "mat")
    sparse = required("scipy.sparse", "mat")
    with h5py.File(path, "r") as file:
        names = [each for each in file if not each.startswith("#")]
        chosen = name or (names[0] if len(names) == 1 else "")
        if chosen not in names:
            return names
        found = file[chosen]
        if "MATLAB_sparse" in found.attrs:
            columns = np.asarray(found["jc"], dtype=np.int64)
            shape = int(found.attrs["MATLAB_sparse"]), len(columns) - 1
            data = np.asarray(found["data"]) if "data" in found else np.empty(0)
            rows = np.asarray(found["ir"], dtype=np.int64) if "ir" in found else np.empty(0, dtype=np.int64)
            return chosen, sparse.csc_array((data, rows, columns), shape=shape)
        kind = bytes(found.attrs.get("MATLAB_class", b"")).decode()
        if kind != "double" or not isinstance(found, h5py.Dataset):
            words = {"cell": "a cell array", "struct": "a struct", "char": "characters", "logical": "a logical matrix"}
            raise MatFault(f"found {words.get(kind, kind or 'an object')}{MUST}", chosen)
        if found.dtype.names is not None:
            raise MatFault(f"found a complex matrix{MUST}", chosen)
        if "MATLAB_empty" in found.attrs:
            return chosen, np.zeros([int(size) for size in found[()]])
        return chosen, np.asarray(found, dtype=np.float64).T


def read(path: str, name: str) -> tuple[str, Any] | list[str]:
    """Return the name of a variable and its matrix; where none was asked for and there are several, all names.

    Raises
    ------
    MatFault
        If it is no such matrix.
    """
    with open(path, "rb") as file:
        is_hdf5 = file.read(10) == b"MATLAB 7.3"
    found = (_read_version_73 if is_hdf5 else _read_version_5)(path, name)
    return found if isinstance(found, list) else (found[0], _checked(found[1], found[0]))


def _bytes(found: tuple[str, Any] | list[str]) -> bytes:
    if isinstance(found, list):
        all_ = b"".join(name.encode()[:200] + b"\0" for name in found)
        return b"arcslip-mat 1 variables %d %d\n" % (len(found), len(all_)) + all_
    name, matrix = found[0].encode()[:200], found[1]
    head = b"arcslip-mat 1 matrix %d %d %d %d\n" % (len(name), *matrix.shape, matrix.nnz)
    return head + name + b"".join(
        [matrix.indptr.astype(np.int32).tobytes(), matrix.indices.astype(np.int32).tobytes(), matrix.data.tobytes()]
    )


def answer(arguments: list[str]) -> bytes:
    """Return what the program writes for a file and, if one is asked for, the name of a variable."""
    try:
        return _bytes(read(arguments[0], arguments[1] if len(arguments) > 1 else ""))
    except MatFault as fault:
        cause, variable = str(fault), fault.variable
    except ImportError as error:
        cause, variable = str(error), ""
    except Exception:  # of what a damaged file leads to
        cause, variable = DAMAGED, ""
    text, name = cause.encode("ascii", "replace")[:1000], variable.encode()[:200]
    return b"arcslip-mat 1 fault %d %d\n" % (len(name), len(text)) + name + text


def main() -> int:
    """Write a matrix of a MATLAB file on standard output, for arcslip to read."""
    if not 2 <= len(sys.argv) <= 3:
        print("usage: arcslip-mat FILE [VARIABLE]\nWrites a matrix of a MATLAB file, for arcslip to read.", file=sys.stderr)
        return 2
    sys.stdout.buffer.write(answer(sys.argv[1:]))
    return 0
