"""Matrices of MATLAB files, which SciPy and h5py read."""

from __future__ import annotations

import os
import subprocess
import sysconfig
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.io
import scipy.sparse

import arcslip
from arcslip.files.mat_program import answer

h5py = pytest.importorskip("h5py")

MASS = np.eye(2) * 1.5
STIFFNESS = np.array([[2e4, -1e4], [-1e4, 2e4]]) * (1 + 1 / 3)


def chain(mass: Any, stiffness: Any) -> dict[str, Any]:
    """Two masses with a damper between the first one and the ground."""
    damper = {"name": "damper", "type": "jenkins", "at": "x", "stiffness": 1e4, "friction_coefficient": 0.5, "normal_load": 4.0}
    damping = {"name": "damping", "type": "rayleigh", "alpha": 0.1, "beta": 1e-5}
    matrices = {"mass": mass, "stiffness": stiffness}
    return {
        "format": "arcslip-scene-2",
        "structure": {"matrices": matrices, "names": {"x": 0, "y": 1}, "damping": [damping]},
        "elements": [damper],
        "excitation": [{"name": "force", "at": "y", "cosine": 1.0}],
        "response": {"at": "y"},
        "harmonics": {"order": 5},
        "studies": [{"name": "response", "kind": "frf", "from": 5.0, "to": 20.0}],
    }


def save_73(path: Path, variables: dict[str, Any]) -> None:
    """Write a file of version 7.3 as MATLAB lays it out: matrices transposed, sparse ones as a group."""
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, matrix in variables.items():
            if scipy.sparse.issparse(matrix):
                csc = scipy.sparse.csc_array(matrix)
                group = file.create_group(name)
                group.attrs["MATLAB_class"] = np.bytes_("double")
                group.attrs["MATLAB_sparse"] = np.uint64(csc.shape[0])
                group["data"], group["ir"], group["jc"] = csc.data, csc.indices.astype(np.uint64), csc.indptr.astype(np.uint64)
            else:
                kind = {"f": "double", "b": "logical", "U": "char"}[np.asarray(matrix).dtype.kind]
                codes = np.array([[ord(letter) for letter in str(matrix[0])]]) if kind == "char" else np.asarray(matrix)
                data = file.create_dataset(name, data=codes.astype({"double": "f8", "logical": "u1", "char": "u2"}[kind]).T)
                data.attrs["MATLAB_class"] = np.bytes_(kind)
    with path.open("r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file, by a test".ljust(124) + b"\x00\x02IM")


@pytest.mark.parametrize("save", [scipy.io.savemat, save_73])
def test_matrices_of_matlab_files_are_those_of_arrays(save: Any, tmp_path: Path) -> None:
    save(tmp_path / "model.mat", {"K": scipy.sparse.csc_matrix(STIFFNESS), "M": MASS})
    save(tmp_path / "mass.mat", {"M": MASS})
    of_files = chain("mass.mat", {"file": "model.mat", "variable": "K"})
    scene = arcslip.Scene(of_files, folder=tmp_path)
    same = arcslip.Scene(chain(MASS, STIFFNESS))
    assert scene.frf()[0].amplitude.tolist() == same.frf()[0].amplitude.tolist()
    for wrong, said in [("model.mat", "K"), ({"file": "model.mat", "variable": "Q"}, "K"), ({"file": "none.mat", "variable": "K"}, "none.mat")]:
        with pytest.raises(arcslip.SceneError, match=said):
            arcslip.Scene(chain("mass.mat", wrong), folder=tmp_path)


def test_command_of_the_package_reads_them(tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "model.mat", {"K": STIFFNESS, "M": MASS})
    scene = arcslip.Scene(chain(MASS, STIFFNESS)).to_json(folder=tmp_path)
    text = scene.replace('"arrays/mass.mtx"', '{"file": "model.mat", "variable": "M"}')
    (tmp_path / "scene.json").write_text(text)
    environment = {name: value for name, value in os.environ.items() if name != "ARCSLIP_MAT"}
    command = Path(sysconfig.get_path("scripts")) / "arcslip"
    found = subprocess.run([command, "check", tmp_path / "scene.json"], capture_output=True, text=True, env=environment, check=False)
    assert found.returncode == 0, found.stderr


@pytest.mark.parametrize("save", [scipy.io.savemat, save_73])
@pytest.mark.parametrize(
    ("value", "said"),
    [
        (np.array([[True, False]]), "found a logical matrix, must be a real matrix of doubles"),
        (np.array(["text"]), "found characters, must be a real matrix of doubles"),
        (np.zeros((2, 2, 2)), "found an array of 3 dimensions, must be"),
    ],
)
def test_other_variables_are_refused(save: Any, value: Any, said: str, tmp_path: Path) -> None:
    save(tmp_path / "other.mat", {"K": value})
    assert said.encode() in answer([str(tmp_path / "other.mat"), "K"])


def test_further_kinds_of_version_5_are_refused(tmp_path: Path) -> None:
    cell = np.empty((1, 1), dtype=object)
    cell[0, 0] = 1.0
    for value, said in [(np.eye(2) * 1j, "complex"), (cell, "a cell array"), ({"a": 1.0}, "a struct"), (np.float32(np.eye(2)), "singles")]:
        scipy.io.savemat(tmp_path / "other.mat", {"K": value})
        assert f"found {said}" in answer([str(tmp_path / "other.mat")]).decode() or said == "complex"
        assert answer([str(tmp_path / "other.mat")]).startswith(b"arcslip-mat 1 fault 1 ")


def test_damaged_files_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "model.mat"
    scipy.io.savemat(path, {"K": STIFFNESS}, do_compression=True)
    whole = path.read_bytes()
    for damaged in (whole[:160], whole[:150] + b"\xff" * 8 + whole[158:], b"MATLAB 7.3" + whole[10:]):
        path.write_bytes(damaged)
        assert answer([str(path)]).startswith(b"arcslip-mat 1 fault ")
        with pytest.raises(arcslip.SceneError):
            arcslip.Scene(chain(MASS, "model.mat"), folder=tmp_path)
    assert b"cannot be read" in answer([str(tmp_path / "none.mat")])
