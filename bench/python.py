"""What the Python package costs on top of the solver: python bench/python.py, where the package is installed.

Ratios of times in this run: a frequency response by `Scene.frf` over the same study in C++ (study/one_load of arcslip_bench, where it
is built), and over the time that its branch took in the solver; a thousand variations of a load with their arrays in two threads
over the same in one.
"""

from __future__ import annotations

import json
import math
import statistics
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import arcslip

SCENE = Path(__file__).resolve().parents[1] / "examples/al_sayed_2011/scene.json"


def seconds(work: Callable[[], object], repeats: int) -> float:
    """Return the median time of some calls."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def seconds_of_cpp() -> float:
    """Return the least time of the study in C++; nan where its benchmark is not built."""
    program = SCENE.parents[2] / "build/release/bench/arcslip_bench"
    if not program.exists():
        return math.nan
    arguments = [program, "--benchmark_filter=study/one_load", "--benchmark_format=json"]
    done = subprocess.run(arguments, cwd=SCENE.parents[2], check=True, text=True, capture_output=True)
    return float(json.loads(done.stdout)["benchmarks"][0]["seconds"])


def main() -> None:
    scene = arcslip.Scene(SCENE).replace({"damper.normal_load": 3.0}, harmonics=7)
    inside: list[float] = []

    def response() -> None:
        (branch,) = scene.frf(for_each={}, threads=1)
        inside.append(branch.facts["solver"]["seconds"])
        branch.amplitude.max()

    cpp, whole = seconds_of_cpp(), seconds(response, 301)
    print(f"frequency response: {1e3 * whole:.2f} ms, {whole / statistics.median(inside):.2f} of the solver's time")
    print(f"the same study in C++: {1e3 * cpp:.2f} ms, ratio {whole / cpp:.2f}")
    loads = np.linspace(1.0, 6.0, 1000)

    def variations(threads: int) -> None:
        results = scene.frf(for_each={"damper.normal_load": loads}, threads=threads)
        np.array([branch.amplitude.max() for branch in results])

    one, two = (seconds(lambda count=count: variations(count), 3) for count in (1, 2))
    print(f"1000 variations: {two:.2f} s in two threads, {one / two:.2f} times as fast as in one")


if __name__ == "__main__":
    main()
