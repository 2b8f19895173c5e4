"""Motions over a period, with the forces and loops of elements."""

from __future__ import annotations

import math
import pickle
from pathlib import Path

import numpy as np
import pytest

import arcslip


@pytest.fixture
def response(scene: arcslip.Scene) -> arcslip.Result:
    return scene.point(frequency=18.0)[0]


def test_motion_of_a_response_is_its_history(response: arcslip.Result) -> None:
    motion = response.motion()
    assert isinstance(motion, arcslip.Motion)
    assert motion.period == pytest.approx(1 / 18, rel=1e-14)
    assert len(motion) == len(response.history)
    for name in response.history.columns:
        assert np.shares_memory(motion[name], response.history[name])
    assert motion.units["displacement"] == "m" and motion.units["elements.damper.force"] == "N"
    assert motion.time[0] == 0 and motion.time[-1] == pytest.approx(motion.period, rel=1e-12)
    assert np.abs(motion.displacement).max() == pytest.approx(response.amplitude, rel=1e-4)


def test_velocity_is_the_rate_of_the_displacement(response: arcslip.Result) -> None:
    motion = response.motion()
    work = np.trapezoid(motion.velocity**2, motion.time)
    assert work == pytest.approx(np.trapezoid(motion.velocity, motion.displacement), rel=1e-3)


def test_loop_encloses_the_dissipated_energy(response: arcslip.Result) -> None:
    loops = response.motion().loops
    assert list(loops) == ["damper"]
    displacement, force = loops["damper"]
    assert np.trapezoid(force, displacement) == pytest.approx(response["elements"]["damper"]["energy"], rel=1e-4)
    assert np.abs(force).max() == pytest.approx(2.0, rel=1e-12)  # slip limit: friction coefficient times normal load


def test_recorded_periods_are_counted_from_the_first(scene: arcslip.Scene) -> None:
    (motion,) = scene.time(frequency=18.0, recorded=3, steps=200)
    periods = [motion.motion(k) for k in range(3)]
    for k, each in enumerate(periods):
        assert each.time[0] == pytest.approx(k / 18, abs=1e-9) and each.time[-1] == pytest.approx((k + 1) / 18, abs=1e-9)
        assert len(each) == len(periods[0])
        np.testing.assert_allclose(each.displacement, periods[0].displacement, atol=1e-6 * motion.amplitude)
    assert motion.motion(-1).time.tolist() == periods[2].time.tolist()
    with pytest.raises(IndexError, match="found period 3, the history has 3"):
        motion.motion(3)
    with pytest.raises(IndexError, match="found period -4"):
        motion.motion(-4)


def test_loops_of_further_directions_have_their_names(examples: Path) -> None:
    response = arcslip.Scene(examples / "rubbing_pad/scene.json").run("levels")[0]
    motion = response.motion()
    directions = [name for name in motion.columns if ".directions." in name and name.endswith(".force")]
    assert directions
    for name in directions:
        element, direction = name.removeprefix("elements.").removesuffix(".force").split(".directions.")
        assert motion.loops[f"{element}.{direction}"].force is motion[name]


def test_branch_has_no_motion_and_says_which_studies_have(scene: arcslip.Scene) -> None:
    (branch,) = scene.frf()
    for of in (0, branch.events[0]):
        with pytest.raises(ValueError, match="found a branch of kind 'frf', .*scene.point"):
            branch.motion(of)


def test_row_is_no_number_of_a_period(scene: arcslip.Scene, response: arcslip.Result) -> None:
    with pytest.raises(TypeError):
        response.motion(response.history[0])
    with pytest.raises(TypeError):
        response.motion(slice(0, 1))  # type: ignore[arg-type]


def test_result_without_a_history_says_why(scene: arcslip.Scene) -> None:
    scene = scene.replace({"c.value": 0, "damper.normal_load": 0})
    with pytest.warns(arcslip.ArcslipWarning):
        (response,) = scene.point(frequency=100 / math.tau)
    with pytest.raises(ValueError, match="the response has no history: "):
        response.motion()


def test_motion_can_be_pickled_and_loaded(response: arcslip.Result, tmp_path: Path, scene: arcslip.Scene) -> None:
    motion = response.motion()
    same = pickle.loads(pickle.dumps(motion))
    assert isinstance(same, arcslip.Motion) and same.period == motion.period
    assert same.loops["damper"].force.tolist() == motion.loops["damper"].force.tolist()
    scene.point(frequency=18.0).save(tmp_path / "point.json")
    (loaded,) = arcslip.load(tmp_path / "point.json")
    assert loaded.motion().loops["damper"].force.tolist() == motion.loops["damper"].force.tolist()
