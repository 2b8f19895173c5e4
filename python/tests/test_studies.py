"""Studies as methods of a scene, and what ends them."""

from __future__ import annotations

import _thread
import contextlib
import inspect
import pickle
import threading
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import arcslip
from arcslip import _core
from arcslip.methods import StudyMethods
from arcslip.studies import COMMON, OF_BRANCHES, argument, stubs


def test_every_kind_of_study_is_a_method_with_its_keys() -> None:
    kinds = _core.kinds()
    assert {"frf", "trace", "peaks", "folds", "bifurcations", "time", "sweep", "point", "modes", "accuracy", "optimize"} <= {
        kind["verb"] for kind in kinds
    }
    for kind in kinds:
        method = getattr(arcslip.Scene, kind["verb"])
        parameters = inspect.signature(method).parameters
        names = [argument(key["name"]) for key in kind["keys"]]
        assert list(parameters)[1 : 1 + len(names)] == names
        assert not set(names) & {*COMMON, *OF_BRANCHES}
        assert all(f"\n{name} : " in method.__doc__ and name.isidentifier() for name in names)


def test_stubs_of_the_methods_are_current() -> None:
    path = Path(arcslip.__file__).with_name("methods.pyi")
    assert path.read_text() == stubs(StudyMethods), "run python -P python/stubs > python/arcslip/methods.pyi"


def test_study_of_the_scene_gives_what_a_call_leaves_out(scene: arcslip.Scene) -> None:
    assert scene.frf()[0].frequency[-1] == 25
    assert scene.frf(to=20)[0].frequency[-1] == 20
    assert scene.studies == (("response", "frf"),)


def test_study_that_the_scene_does_not_have_needs_its_keys(scene: arcslip.Scene) -> None:
    with pytest.raises(arcslip.SceneError) as caught:
        scene.peaks(over="damper.normal_load")
    assert any(fault.pointer.endswith("from") for fault in caught.value.faults)
    (curve,) = scene.peaks(over="damper.normal_load", from_=1, to=6, frequency=[10, 25])
    assert curve["damper.normal_load"][[0, -1]].tolist() == [1, 6]
    assert curve.units["damper.normal_load"] == "N"


def test_unknown_argument_names_the_nearest(scene: arcslip.Scene) -> None:
    with pytest.raises(TypeError, match="the nearest is 'stability'"):
        scene.frf(stabilty=True)  # type: ignore[call-arg]
    with pytest.raises(TypeError):
        scene.frf(10, 20)  # type: ignore[misc]
    with pytest.raises(ValueError, match="response"):
        scene.frf(study="other")
    with pytest.raises(ValueError, match="response"):
        scene.run("other")


def test_unknown_columns_are_refused(scene: arcslip.Scene) -> None:
    with pytest.raises(ValueError, match=r"columns amplitud: must be of .*did you mean amplitude\?"):
        scene.frf(columns=["frequency", "amplitud"])
    with pytest.raises(ValueError, match="did you mean damper.stick_percent"):
        scene.frf(columns=["damper.stick_percen"])
    with pytest.raises(ValueError, match="columns coefficients"):
        scene.frf(columns=["coefficients"])
    for wrong in ["amplitude", [1], 3, []]:
        with pytest.raises(TypeError, match="must be a list of names"):
            scene.frf(columns=wrong)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="has no argument 'columns'"):
        scene.time(columns=["time"])  # type: ignore[call-arg]
    (once,) = scene.frf(columns=(name for name in ["frequency"]))
    (listed,) = scene.frf(columns=["frequency"])
    assert list(once.main.columns) == list(listed.main.columns) != []


@pytest.mark.parametrize("wrong", ["much", None, [10.0], np.nan, {"a": 1}, -1, "a\0b"])
def test_wrong_value_of_a_key_is_a_fault(scene: arcslip.Scene, wrong: Any) -> None:
    with pytest.raises((arcslip.SceneError, ValueError)):
        scene.frf(from_=wrong)


@pytest.mark.parametrize("how", [{"threads": 0}, {"threads": "two"}, {"progress": 1}, {"progress": "bar"}, {"coefficients": 2.5}])
def test_wrong_option_is_refused(scene: arcslip.Scene, how: dict[str, Any]) -> None:
    with pytest.raises((TypeError, ValueError)):
        scene.frf(**how)


def test_for_each_takes_arrays_and_sets_values(scene: arcslip.Scene) -> None:
    branches = scene.frf(for_each={"damper.normal_load": np.array([1.0, 4.0])})
    assert [branch.set for branch in branches] == [{"damper.normal_load": 1.0}, {"damper.normal_load": 4.0}]
    assert np.array_equal(branches[1].amplitude, scene.frf()[0].amplitude)


def test_results_do_not_depend_on_threads(scene: arcslip.Scene) -> None:
    loads = {"damper.normal_load": [1.0, 2.0, 3.0, 4.0]}
    one, several = (scene.frf(for_each=loads, threads=threads) for threads in (1, 3))
    assert [a.amplitude.tobytes() for a in one] == [b.amplitude.tobytes() for b in several]


def test_threads_of_python_compute_at_the_same_time(scene: arcslip.Scene) -> None:
    found: list[arcslip.Results] = []
    threads = [threading.Thread(target=lambda: found.append(scene.frf(threads=1))) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len({results[0].amplitude.tobytes() for results in found}) == 1
    assert len(found) == 8


def test_lock_of_the_interpreter_is_released(slow: Callable[..., arcslip.Results]) -> None:
    stop = threading.Event()

    def compute() -> None:
        with contextlib.suppress(arcslip.ArcslipWarning):
            slow(progress=lambda now: not stop.is_set())

    thread = threading.Thread(target=compute)
    thread.start()
    begin = time.perf_counter()
    count = 0
    while time.perf_counter() - begin < 0.3:
        count += 1
        time.sleep(0.001)
    stop.set()
    thread.join(5)
    assert not thread.is_alive()
    assert count > 50


def interrupt_after(seconds: float) -> threading.Timer:
    timer = threading.Timer(seconds, _thread.interrupt_main)
    timer.start()
    return timer


def test_interrupt_returns_within_a_second_with_the_results_so_far(slow: Callable[..., arcslip.Results]) -> None:
    for threads in (1, 2):
        timer = interrupt_after(0.7)
        begin = time.perf_counter()
        with pytest.raises(KeyboardInterrupt) as caught:
            slow(threads=threads)
        assert time.perf_counter() - begin < 1.7
        timer.join()
        results = caught.value.results  # type: ignore[attr-defined]
        assert 0 < len(results) < 20000
        assert results[0].status == "complete"


def test_exception_of_a_callback_comes_back_as_it_was(slow: Callable[..., arcslip.Results]) -> None:
    class Own(Exception):
        pass

    seen: list[dict[str, Any]] = []

    def report(now: dict[str, Any]) -> None:
        seen.append(now)
        if len(seen) == 3:
            raise Own("enough")

    with pytest.raises(Own, match="enough") as caught:
        slow(progress=report)
    assert len(seen) == 3
    assert seen[0]["branches"] == 20000
    assert len(caught.value.results) > 0  # type: ignore[attr-defined]


def test_callback_that_returns_false_stops(slow: Callable[..., arcslip.Results]) -> None:
    with pytest.warns(arcslip.ArcslipWarning, match="stopped"):
        results = slow(progress=lambda now: False)
    assert len(results) < 20000
    assert results[-1].status in ("stopped", "complete")


def test_doubt_is_a_warning_and_an_attribute(scene: arcslip.Scene) -> None:
    scene = scene.replace(harmonics=3, accuracy=1e-8)
    with pytest.warns(arcslip.ArcslipWarning, match="accuracy") as caught:
        (branch,) = scene.frf()
    assert branch.doubt and branch.status == "complete"
    assert branch.accuracy["order"] == 3 and branch.accuracy["wanted"] == 1e-8
    assert caught[0].filename == __file__


def test_results_can_be_pickled(scene: arcslip.Scene) -> None:
    results = scene.frf(for_each={"damper.normal_load": [1.0, 4.0]}, stability=True)
    same = pickle.loads(pickle.dumps(results))
    assert same.scene_hash == results.scene_hash
    for a, b in zip(same, results, strict=True):
        assert a.set == b.set and a.units == b.units and a.stop == b.stop
        for name in b.points.columns:
            assert pickle.dumps(a[name]) == pickle.dumps(b[name].copy())


def test_studies_that_a_stop_leaves_out_are_warned_of(oscillator: dict[str, Any]) -> None:
    many = {"damper.normal_load": [float(i) for i in range(1, 20001)]}
    frf = {"kind": "frf", "from": 18, "to": 22}
    oscillator["studies"] = [{"name": "long", **frf, "for_each": many}, {"name": "next", **frf}]
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        results = arcslip.Scene(oscillator).run(progress=lambda now: False)
    assert str(seen[-1].message) == "stopped: 1 of 2 studies were not started"
    assert {result.study for result in results} == {"long"}
