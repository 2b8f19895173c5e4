"""Threads: how many there are, of which libraries, and what sets them."""

from __future__ import annotations

import multiprocessing
import os
import threading
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import threadpoolctl

import arcslip


def pools() -> dict[str, int]:
    """The threads of the libraries that the package carries, by the names of their files."""
    config = arcslip.show_config("dicts")
    assert config is not None
    return {
        Path(pool["filepath"]).name: pool["num_threads"]
        for pool in config["threads"]["pools"]
        if Path(pool["filepath"]).parent.name == "arcslip.libs"
    }


def test_threads_of_libraries_are_named_and_set(scene: arcslip.Scene) -> None:
    scene.frf()
    assert any("openblas" in name for name in pools()) and any("gomp" in name for name in pools())
    with threadpoolctl.threadpool_limits(1):
        assert set(pools().values()) == {1}
        limited = scene.frf()[0].amplitude
    assert np.array_equal(limited, scene.frf()[0].amplitude)


def test_default_is_what_this_process_may_use() -> None:
    config = arcslip.show_config("dicts")
    assert config is not None and config["threads"]["arcslip"] == len(os.sched_getaffinity(0))


@pytest.mark.parametrize("threads", [0, -1])
def test_fewer_than_one_are_refused(scene: arcslip.Scene, threads: int) -> None:
    with pytest.raises(ValueError, match="must be at least 1"):
        scene.frf(threads=threads)


def test_results_do_not_depend_on_threads(scene: arcslip.Scene) -> None:
    loads = {"damper.normal_load": [1.0, 2.0, 3.0, 4.0]}
    one, two = (scene.frf(for_each=loads, threads=count) for count in (1, 2))
    assert [each.amplitude.tolist() for each in one] == [each.amplitude.tolist() for each in two]


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_workers_compute_what_their_parent_does(method: str, examples: Path) -> None:
    scene = arcslip.Scene(examples / "cantilever/solid.json")
    here = scene.run("responses")  # with factors of sparse matrices, whose library has threads of OpenMP
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context(method)) as executor:
        for found in [executor.submit(scene.run, "responses") for _ in range(2)]:
            there = found.result(timeout=120)
            assert [each.amplitude.tolist() for each in there] == [each.amplitude.tolist() for each in here]


def test_callbacks_come_from_the_thread_that_called(slow: Callable[..., arcslip.Results]) -> None:
    threads = set()

    def report(now: dict[str, Any]) -> bool:
        threads.add(threading.get_ident())
        return len(threads) < 1

    with pytest.warns(arcslip.ArcslipWarning):
        slow(progress=report)
    assert threads == {threading.get_ident()}
