"""Objects used in ways that they were not made for: exceptions, never a crash."""

from __future__ import annotations

import gc
import pickle
import threading
from typing import Any

import numpy as np
import pytest

import arcslip
from arcslip import _core


def test_scene_may_be_dropped_while_threads_use_it(oscillator: dict[str, Any]) -> None:
    scenes = [arcslip.Scene(oscillator)]
    started, failures = threading.Barrier(5), []

    def compute() -> None:
        scene = scenes[0]
        started.wait()
        try:
            assert len(scene.frf()[0]) > 10
        except Exception as error:  # noqa: BLE001
            failures.append(error)

    threads = [threading.Thread(target=compute) for _ in range(4)]
    for thread in threads:
        thread.start()
    started.wait()
    scenes.clear()
    gc.collect()
    for thread in threads:
        thread.join()
    assert not failures


def test_callback_may_use_the_scene_and_drop_it(oscillator: dict[str, Any]) -> None:
    holder = [arcslip.Scene(oscillator)]

    def report(now: dict[str, Any]) -> bool:
        if holder:
            assert len(holder.pop().frf()[0]) > 10
        gc.collect()
        return False

    many = [float(i) for i in range(1, 20001)]
    with pytest.warns(arcslip.ArcslipWarning):
        results = holder[0].frf(for_each={"damper.normal_load": many}, progress=report)
    assert not holder and len(results) > 0


def test_extension_refuses_what_is_not_there(scene: arcslip.Scene) -> None:
    core = scene._data
    results, _, _ = _core.run(core, [0], False, None, 1, None)
    for call in [
        lambda: _core.run(core, [1], False, None, 1, None),
        lambda: results.facts(5),
        lambda: results.column(0, 9, 0),
        lambda: results.column(0, 0, 999),
        lambda: results.counts(7),
    ]:
        with pytest.raises(IndexError):
            call()
    with pytest.raises((TypeError, ValueError)):
        core.with_study("frf", None, "[]")
    with pytest.raises((IndexError, ValueError)):
        core.with_study("frf", 7, "{}")
    with pytest.raises(ValueError, match="unknown kind"):
        core.with_study("none", None, "{}")
    with pytest.raises(TypeError):
        core.replace([("c.value", None)], None, None)  # type: ignore[list-item]
    with pytest.raises(TypeError):
        _core.Scene()


@pytest.mark.filterwarnings("ignore:nanobind:RuntimeWarning")
def test_objects_without_their_inside_are_refused(scene: arcslip.Scene) -> None:
    empty = arcslip.Scene.__new__(arcslip.Scene)
    with pytest.raises(AttributeError):
        empty.frf()
    with pytest.raises(AttributeError):
        hash(empty)
    with pytest.raises(TypeError):
        _core.Scene.__new__(_core.Scene).write()
    for kind in (arcslip.Result, arcslip.Table, arcslip.Row):
        with pytest.raises(AttributeError):
            kind.__new__(kind).amplitude


@pytest.mark.parametrize("name", ["a\0b", "", "c.value\0", "\N{SNOWMAN}", "c" * 100000])
def test_odd_names_of_parameters_are_unknown(scene: arcslip.Scene, name: str) -> None:
    with pytest.raises(arcslip.ParameterError):
        scene.replace({name: 1.0})
    assert name not in scene.parameters


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 1e999])
def test_numbers_that_are_not_finite_are_refused(scene: arcslip.Scene, value: float) -> None:
    with pytest.raises((arcslip.ParameterError, arcslip.SceneError)):
        scene.replace({"k.value": value})


@pytest.mark.parametrize(
    "array", [np.array([4.0, 1.0], ">f8"), np.arange(8.0)[::4] + 1, np.float32([1, 4]), np.array([1, 4])]
)
def test_lists_of_values_are_arrays_of_any_layout(scene: arcslip.Scene, array: Any) -> None:
    array.flags.writeable = False
    assert [b.set["damper.normal_load"] for b in scene.frf(for_each={"damper.normal_load": array})] == array.tolist()


@pytest.mark.parametrize("array", [np.array([]), np.array([np.nan]), np.ones((2, 2)), np.array(["a"]), np.array([1j])])
def test_wrong_lists_of_values_are_refused(scene: arcslip.Scene, array: Any) -> None:
    with pytest.raises((arcslip.SceneError, TypeError, ValueError)):
        scene.frf(for_each={"damper.normal_load": array})


def test_nested_scene_is_refused(oscillator: dict[str, Any]) -> None:
    oscillator["comment"] = oscillator
    with pytest.raises((RecursionError, ValueError)):
        arcslip.Scene(oscillator)


@pytest.mark.parametrize("data", [b"", b"\x80\x04."])
def test_pickle_that_is_cut_off_is_refused(scene: arcslip.Scene, data: bytes) -> None:
    with pytest.raises((EOFError, pickle.UnpicklingError, IndexError)):
        pickle.loads(data)
    with pytest.raises(Exception):  # noqa: B017
        pickle.loads(pickle.dumps(scene)[:-40])
