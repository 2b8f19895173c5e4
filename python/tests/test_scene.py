"""Scenes: where they come from, and that they are values."""

from __future__ import annotations

import copy
import json
import math
import os
import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.sparse

import arcslip
from arcslip.files.arrays import matrix_market


def test_path_text_and_dict_give_the_same_scene(tmp_path: Path, oscillator: dict[str, Any]) -> None:
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(oscillator))
    scenes = [
        arcslip.Scene(path),
        arcslip.Scene(str(path)),
        arcslip.Scene(json.dumps(oscillator)),
        arcslip.Scene(oscillator),
        arcslip.Scene(arcslip.Scene(oscillator).to_json()),
        arcslip.Scene(arcslip.Scene(oscillator).to_dict()),
    ]
    assert len(set(scenes)) == 1
    assert scenes[0] != scenes[0].replace({"c.value": 3})
    assert scenes[0] != "scene"


def test_scene_is_equal_after_replacing_a_value_and_setting_it_back(scene: arcslip.Scene) -> None:
    assert scene.replace({"c.value": 3}).replace({"c.value": 2}) == scene


def test_scene_does_not_change(scene: arcslip.Scene) -> None:
    with pytest.raises(AttributeError, match="replace"):
        scene.title = "other"  # type: ignore[misc]
    with pytest.raises(AttributeError):
        del scene._data
    assert copy.deepcopy(scene) == scene


def test_parameters_have_value_unit_bounds_and_help(scene: arcslip.Scene) -> None:
    load = scene.parameters["damper.normal_load"]
    assert (load, load.unit, load.lower, load.upper) == (4.0, "N", 0.0, math.inf)
    assert "slip limit" in load.help
    assert repr(load) == "4.0 N"
    assert "force.cosine" in scene.parameters
    assert pickle.loads(pickle.dumps(load)).unit == "N"
    assert scene.replace({"damper.normal_load": 5}).parameters["damper.normal_load"] == 5
    with pytest.raises(KeyError):
        scene.parameters["damper.load"]


def test_unknown_parameter_names_the_nearest(scene: arcslip.Scene) -> None:
    with pytest.raises(arcslip.ParameterError, match="damper.normal_load"):
        scene.replace({"damper.normal_lod": 5})
    with pytest.raises(arcslip.ParameterError, match="at least 0"):
        scene.replace({"damper.normal_load": -5})


def test_numbers_follow_formulas_and_have_units(scene: arcslip.Scene) -> None:
    followed = scene.replace({"damper.stiffness": "0.25*k", "damper.normal_load": "3 kN"})
    stiffness = followed.parameters["damper.stiffness"]
    assert stiffness == 0.25 * followed.parameters["k.value"]
    assert (stiffness.formula, followed.parameters["k.value"].formula) == ("0.25*k", None)
    assert followed.parameters["damper.normal_load"] == 3000
    assert followed.replace({"k": 8}).parameters["damper.stiffness"] == 2
    assert arcslip.Scene(followed.to_dict()) == followed
    with pytest.raises(arcslip.ParameterError, match="given by the formula"):
        followed.replace({"damper.stiffness": 3})
    for wrong in ["much", "k + ", "m", "3 kg", "2*damper.stiffness"]:
        with pytest.raises(arcslip.ParameterError):
            scene.replace({"damper.stiffness": wrong})


@pytest.mark.parametrize("wrong", [None, [1, 2], 1j])
def test_value_of_a_wrong_type_is_refused(scene: arcslip.Scene, wrong: object) -> None:
    with pytest.raises((TypeError, ValueError)):
        scene.replace({"damper.normal_load": wrong})  # type: ignore[dict-item]


def test_all_faults_of_a_scene_are_reported(oscillator: dict[str, Any]) -> None:
    oscillator["elements"][0]["normal_lod"] = 1
    oscillator["structure"]["masses"][0]["value"] = -1
    with pytest.raises(arcslip.SceneError) as caught:
        arcslip.Scene(oscillator)
    faults = {fault.pointer: fault.message for fault in caught.value.faults}
    assert set(faults) == {"/elements/0/normal_lod", "/structure/masses/0/value"}
    assert "normal_load" in faults["/elements/0/normal_lod"]
    assert str(caught.value).count("\n") == 1
    assert pickle.loads(pickle.dumps(caught.value)).faults == caught.value.faults


def test_fault_has_what_was_found_what_is_allowed_and_the_nearest_word(oscillator: dict[str, Any]) -> None:
    oscillator["elements"][0]["normal_lod"] = 1
    oscillator["structure"]["masses"][0]["value"] = -1
    oscillator["structure"]["masses"][0]["at"] = 'x", must be "y'
    del oscillator["structure"]["springs"][0]["value"]
    with pytest.raises(arcslip.SceneError) as caught:
        arcslip.Scene(oscillator)
    faults = {fault.pointer: fault for fault in caught.value.faults}
    unknown = faults["/elements/0/normal_lod"]
    assert unknown.found == 'the unknown key "normal_lod"'
    assert unknown.near == "normal_load"
    assert unknown.allowed is not None and unknown.allowed.startswith("one of ") and "did you mean" not in unknown.allowed
    bound = faults["/structure/masses/0/value"]
    assert (bound.found, bound.allowed, bound.near) == ("-1", "at least 0 kg", None)
    place = faults["/structure/masses/0/at"]
    assert place.found is not None and place.found.endswith(r'"x\", must be \"y"')
    missing = faults["/structure/springs/0/value"]
    assert missing.found == 'no key "value", which is required' and missing.allowed


def test_message_of_another_form_has_no_parts() -> None:
    fault = arcslip.Fault("/a", "must be a name of at least one character")
    assert (fault.found, fault.allowed, fault.near) == (None, None, None)
    escaped = arcslip.Fault("", r'found "a", must be "\"b\n"; did you mean "\"b\n"?')
    assert escaped.near == '"b\n' and escaped.allowed == r'"\"b\n"'


@pytest.mark.parametrize(
    "text", ["{", "{}", '{"format": "arcslip-scene-1"}', "{\0}", '{"title": NaN}', "{" * 1000, '{"a": "\ud800"}']
)
def test_text_that_is_no_scene_is_refused(text: str) -> None:
    with pytest.raises((arcslip.SceneError, UnicodeEncodeError)):
        arcslip.Scene(text)


@pytest.mark.parametrize("wrong", [None, 1, b"{}", [1], object()])
def test_source_of_a_wrong_type_is_refused(wrong: object) -> None:
    with pytest.raises(TypeError, match="must be a path, a text or a dict"):
        arcslip.Scene(wrong)  # type: ignore[arg-type]


def test_missing_file_is_an_error_of_the_system(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="No such file"):
        arcslip.Scene(tmp_path / "none.json")
    with pytest.raises(OSError, match="directory"):
        arcslip.Scene(tmp_path)
    with pytest.raises((OSError, ValueError)):
        arcslip.Scene("a\0b")


def test_repr_fits_a_screen(scene: arcslip.Scene, examples: Path) -> None:
    assert "oscillator" in repr(scene)
    for path in [examples / "contact_patch/scene.json", examples / "al_sayed_2011/scene.json"]:
        assert len(repr(arcslip.Scene(path))) < 500
        assert repr(arcslip.Scene(path).parameters).count("\n") < 40


def test_pickled_scene_carries_its_files(examples: Path, tmp_path: Path) -> None:
    for name in ["contact_patch", "blade"]:
        folder = tmp_path / name
        folder.mkdir()
        for file in (examples / name).iterdir():
            if file.is_file():
                (folder / file.name).write_bytes(file.read_bytes())
        scene = arcslip.Scene(folder / "scene.json")
        data = pickle.dumps(scene)
        for file in folder.iterdir():
            file.unlink()
        assert pickle.loads(data) == scene == arcslip.Scene(examples / name / "scene.json")


def test_scene_is_the_same_in_another_process(scene: arcslip.Scene) -> None:
    code = "import pickle, sys; print(pickle.load(sys.stdin.buffer)._content())"
    found = subprocess.run([sys.executable, "-P", "-c", code], input=pickle.dumps(scene), capture_output=True, check=True)
    assert found.stdout.decode().strip() == scene._content()


def chain(mass: Any, stiffness: Any) -> dict[str, Any]:
    return {
        "format": "arcslip-scene-1",
        "structure": {
            "matrices": {"mass": mass, "stiffness": stiffness},
            "names": {"first": 0, "tip": 2},
            "damping": [{"name": "damping", "type": "rayleigh", "alpha": 0.1, "beta": 1e-5}],
        },
        "elements": [
            {
                "name": "damper",
                "type": "jenkins",
                "at": "first",
                "stiffness": 1e4,
                "friction_coefficient": 0.5,
                "normal_load": 4.0,
            }
        ],
        "excitation": [{"name": "force", "shape": np.array([0.0, 0.0, 1.0]), "cosine": 1.0}],
        "response": {"at": "tip"},
        "harmonics": {"order": 5},
        "studies": [{"name": "response", "kind": "frf", "from": 5.0, "to": 15.0}],
    }


MASS = np.eye(3) * 1.5
STIFFNESS = np.array([[2e4, -1e4, 0.0], [-1e4, 2e4, -1e4], [0.0, -1e4, 1e4]]) * (1 + 1 / 3)


def test_arrays_stand_in_place_of_files(tmp_path: Path) -> None:
    big_endian = np.asfortranarray(STIFFNESS).astype(">f8")
    strided = np.repeat(np.repeat(STIFFNESS, 2, 0), 2, 1)[::2, ::2]
    read_only = STIFFNESS.copy()
    read_only.flags.writeable = False
    scenes = [
        arcslip.Scene(chain(mass, stiffness))
        for mass in [MASS, scipy.sparse.csr_matrix(MASS), scipy.sparse.dia_array(MASS)]
        for stiffness in [STIFFNESS, scipy.sparse.csc_array(STIFFNESS), big_endian, strided, read_only]
    ]
    assert len(set(scenes)) == 1
    assert len({scene.frf()[0].amplitude.tobytes() for scene in scenes[:5]}) == 1
    of_files = chain("M.mtx", "K.mtx")
    of_files["structure"]["names"] = "names.csv"
    of_files["excitation"][0]["shape"] = "shape.mtx"
    (tmp_path / "M.mtx").write_bytes(matrix_market(MASS))
    (tmp_path / "K.mtx").write_bytes(matrix_market(STIFFNESS))
    (tmp_path / "shape.mtx").write_bytes(matrix_market(np.array([0.0, 0.0, 1.0])))
    (tmp_path / "names.csv").write_text("name,row\nfirst,1\ntip,3\n")
    assert arcslip.Scene(of_files, folder=tmp_path) == scenes[0]
    assert pickle.loads(pickle.dumps(scenes[0])) == scenes[0]
    assert scenes[0].parameters["damper.normal_load"] == 4


@pytest.mark.parametrize(
    "wrong",
    [
        np.full((3, 3), np.nan),
        np.ones((2, 3)),
        np.ones((2, 2)),
        np.ones((3, 3, 3)),
        np.eye(3) * 1j,
        np.array([["a"]]),
        np.array([[None]]),
        np.zeros((0, 0)),
    ],
)
def test_wrong_matrices_are_refused(wrong: Any) -> None:
    with pytest.raises((arcslip.SceneError, TypeError, ValueError)):
        arcslip.Scene(chain(MASS, wrong))


def test_schema_lists_the_kinds_of_studies() -> None:
    text = json.dumps(arcslip.schema())
    assert all(f'"{kind}"' in text for kind in ["frf", "trace", "optimum"])


def test_scene_can_be_read_in_a_forked_process(scene: arcslip.Scene) -> None:
    scene.frf()
    child = os.fork()
    if child == 0:
        os._exit(0 if len(scene.frf()[0]) > 10 else 1)
    assert os.waitpid(child, 0)[1] == 0


PATCH = {
    "tangential": ["t", "t", "t"],
    "normal": ["n + 0.02*tilt", "n", "n - 0.02*tilt"],
    "area": [1e-4, 2e-4, 1e-4],
    "pressure": [1e6, 2e6, 1e6],
}


def flange(examples: Path, contacts: object) -> dict[str, Any]:
    of: dict[str, Any] = json.loads((examples / "contact_patch/scene.json").read_text())
    of["patches"][0]["file"] = contacts
    of["studies"] = [{"name": "response", "kind": "frf", "from": 60, "to": 100}]
    return of


def test_columns_stand_in_place_of_tables(examples: Path, tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    kinds = [("tangential", "U20"), ("normal", "U20"), ("area", float), ("pressure", float)]
    rows = np.array(list(zip(*PATCH.values(), strict=True)), dtype=kinds)
    scenes = [arcslip.Scene(flange(examples, each)) for each in (PATCH, pandas.DataFrame(PATCH), rows)]
    lines = [",".join(PATCH), *(",".join(map(str, row)) for row in zip(*PATCH.values(), strict=True))]
    (tmp_path / "flange.csv").write_text("\n".join(lines))
    of_file = arcslip.Scene(flange(examples, "flange.csv"), folder=tmp_path)
    assert len(set(scenes)) == 1
    assert scenes[0].frf()[0].amplitude.tolist() == of_file.frf()[0].amplitude.tolist()
    with pytest.raises(ValueError, match="different lengths"):
        arcslip.Scene(flange(examples, PATCH | {"area": [1e-4]}))
    with pytest.raises(ValueError, match="must be without commas"):
        arcslip.Scene(flange(examples, PATCH | {"normal": ["n, t", "n", "n"]}))
    with pytest.raises(arcslip.SceneError):
        arcslip.Scene(flange(examples, {"area": [1.0]}))


def test_faces_are_pairs_of_rows(examples: Path) -> None:
    path = examples / "disk_sector/scene.json"
    of_file = arcslip.Scene(path)
    scene = json.loads(path.read_text())
    name = scene["structure"]["matrices"]["faces"]
    pairs = np.loadtxt(path.parent / name, delimiter=",", skiprows=1, dtype=int) - 1
    scene["structure"]["matrices"]["faces"] = pairs
    same = arcslip.Scene(scene, folder=path.parent)
    study = of_file.studies[0].name
    first, second = of_file.run(study), same.run(study)
    assert [each.amplitude.tolist() for each in first] == [each.amplitude.tolist() for each in second]
    for wrong in (pairs[:, 0], pairs + 0.5, np.zeros((3, 3), int)):
        scene["structure"]["matrices"]["faces"] = wrong
        with pytest.raises(TypeError, match="must be pairs of rows"):
            arcslip.Scene(scene, folder=path.parent)


def test_rows_of_a_data_frame_are_combinations(scene: arcslip.Scene) -> None:
    pandas = pytest.importorskip("pandas")
    rows = {"damper.normal_load": [2.0, 4.0], "k.value": [1.0e4, 1.1e4]}
    found = scene.frf(for_each=pandas.DataFrame(rows))
    assert [branch.set for branch in found] == [{"damper.normal_load": 2.0, "k.value": 1e4}, {"damper.normal_load": 4.0, "k.value": 1.1e4}]


def test_scene_is_written_into_a_folder_with_its_arrays(examples: Path, tmp_path: Path) -> None:
    scene = arcslip.Scene(chain(MASS, STIFFNESS))
    (tmp_path / "scene.json").write_text(scene.to_json(folder=tmp_path))
    assert sorted(path.name for path in (tmp_path / "arrays").iterdir()) == ["mass.mtx", "names.csv", "shape.mtx", "stiffness.mtx"]
    assert arcslip.Scene(tmp_path / "scene.json") == scene
    scene.to_json(folder=tmp_path)  # the same files again
    (tmp_path / "arrays/mass.mtx").write_text("of somebody else")
    with pytest.raises(FileExistsError, match="is another file"):
        scene.to_json(folder=tmp_path)
    assert (tmp_path / "arrays/mass.mtx").read_text() == "of somebody else"
    other = arcslip.Scene(chain(2 * MASS, STIFFNESS), folder=tmp_path)  # whose arrays have the names of those files
    with pytest.raises(FileExistsError):
        other.to_json(folder=tmp_path)
    of_files = arcslip.Scene(examples / "contact_patch/scene.json")
    (tmp_path / "patch.json").write_text(of_files.to_json(folder=tmp_path))
    assert arcslip.Scene(tmp_path / "patch.json").frf(to=70)[0].amplitude.tolist() == of_files.frf(to=70)[0].amplitude.tolist()
    assert len(list((tmp_path / "arrays").iterdir())) == 4


def test_dict_of_a_scene_has_its_arrays() -> None:
    scene = arcslip.Scene(chain(MASS, STIFFNESS))
    found = scene.to_dict()
    assert arcslip.Scene(found) == scene
    assert "content of arrays/mass.mtx" in repr(found["structure"]["matrices"]["mass"])
    found["studies"].append({"name": "mode", "kind": "modes", "amplitude": [1e-5, 1e-3]})
    assert len(arcslip.Scene(found).studies) == 2


def test_matrices_may_be_lists_of_rows_and_data_frames() -> None:
    pandas = pytest.importorskip("pandas")
    expected = arcslip.Scene(chain(MASS, STIFFNESS))
    assert arcslip.Scene(chain(MASS.tolist(), pandas.DataFrame(STIFFNESS))) == expected


def test_numbers_that_are_not_finite_have_their_place(oscillator: dict[str, Any]) -> None:
    stiffness = STIFFNESS.copy()
    stiffness[1, 2] = np.nan
    with pytest.raises(ValueError, match=r"found nan at \[1, 2\] of a matrix"):
        arcslip.Scene(chain(MASS, stiffness))
    scene = arcslip.Scene(oscillator)
    with pytest.raises(ValueError, match="found inf in 'to', must be a finite number"):
        scene.frf(to=math.inf)
    with pytest.raises(ValueError, match="found nan in 'damper.normal_load'"):
        scene.frf(for_each={"damper.normal_load": [1.0, math.nan]})


def test_wrong_values_name_their_parameter(scene: arcslip.Scene) -> None:
    with pytest.raises(TypeError, match=r"found array\(\[1., 2.\]\) for 'damper.normal_load'"):
        scene.replace({"damper.normal_load": np.array([1.0, 2.0])})  # type: ignore[dict-item]
    with pytest.raises(TypeError):
        scene.replace(harmonics=7.5)  # type: ignore[arg-type]
    with pytest.raises(KeyError, match="no parameter 'damper.normal_lod'; the nearest is 'damper.normal_load'"):
        scene.parameters["damper.normal_lod"]
