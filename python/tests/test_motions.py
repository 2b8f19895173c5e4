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


def agrees(motion: arcslip.Motion, row: arcslip.Row) -> None:
    """Check a motion by what is known of its row: the period, the amplitude and the dissipated energy."""
    assert np.abs(motion.displacement).max() == pytest.approx(row.amplitude, rel=1e-4)
    displacement, force = motion.loops["damper"]
    assert np.trapezoid(force, displacement) == pytest.approx(row["elements.damper.energy"], rel=1e-4, abs=1e-12)
    assert force[0] == pytest.approx(force[-1], abs=1e-9) and motion.period == motion.time[-1]


def test_points_and_events_of_branches_have_motions(scene: arcslip.Scene) -> None:
    loads = {"damper.normal_load": [2.0, 4.0]}
    for branch in scene.frf(for_each=loads):
        (peak,) = branch.events["peak"]
        for row in (branch.points[0], branch.points[-1], peak, branch.points[10:20][3]):
            agrees(branch.motion(row), row)
            assert branch.motion(row).period == pytest.approx(1 / row.frequency, rel=1e-14)
        assert branch.motion(-1).displacement.tolist() == branch.motion(branch.points[-1]).displacement.tolist()
        assert len(branch.motion(peak, steps=50)) < 60
        (response,) = scene.replace({"damper.normal_load": branch.set["damper.normal_load"]}).point(
            frequency=peak.frequency, steps=200
        )
        ours, other = branch.motion(peak, steps=200), response.motion()
        np.testing.assert_allclose(ours.displacement, other.displacement, atol=1e-9 * peak.amplitude)
        np.testing.assert_allclose(ours.elements.damper.force, other.elements.damper.force, atol=1e-7)


def test_curves_over_a_parameter_have_motions(scene: arcslip.Scene) -> None:
    load = "damper.normal_load"
    for (branch,) in (
        scene.trace(over=load, from_=1.0, to=6.0, frequency=18.0),
        scene.peaks(over=load, from_=1.0, to=6.0, frequency=[14, 25]),
    ):
        for row in (branch.points[0], branch.points[len(branch) // 2], branch.points[-1]):
            agrees(branch.motion(row), row)


def test_motion_has_the_harmonics_of_its_branch(scene: arcslip.Scene) -> None:
    (branch,) = scene.replace(harmonics=101, accuracy=1e-3).frf()
    assert branch.points["order"].max() < 101
    for row in (branch.events["peak"][0], branch.points[0]):
        agrees(branch.motion(row), row)


def test_branches_of_twice_the_period_have_motions(examples: Path) -> None:
    branches = arcslip.Scene(examples / "double_well/scene.json").frf(branches="all", for_each={})
    doubled = [branch for branch in branches if branch.facts["period"] == 2]
    for branch in doubled:
        row = branch.points[len(branch) // 2]
        motion = branch.motion(row)
        assert motion.period == pytest.approx(2 * math.tau / row.omega, rel=1e-14)
        middle = np.interp(motion.period / 2, motion.time, motion.displacement)
        assert abs(middle - motion.displacement[0]) > 1e-3 * row.amplitude
        assert np.abs(motion.displacement).max() == pytest.approx(row.amplitude, rel=1e-4)
    assert doubled


def test_modes_have_motions(scene: arcslip.Scene) -> None:
    (mode,) = scene.modes(amplitude=[1e-4, 3e-3])
    for row in (mode.points[0], mode.points[-1]):
        agrees(mode.motion(row), row)
        assert mode.motion(row).period == pytest.approx(1 / row.frequency, rel=1e-12)


def test_results_without_motions_say_so(scene: arcslip.Scene, oscillator: dict[str, object], tmp_path: Path) -> None:
    branches = scene.frf()
    with pytest.raises(ValueError, match="found a branch of kind 'frf' without motions"):
        pickle.loads(pickle.dumps(branches))[0].motion(0)
    branches.save(tmp_path / "branches.json")
    with pytest.raises(ValueError, match="scene.point"):
        arcslip.load(tmp_path / "branches.json")[0].motion(0)
    (exact,) = scene.frf(method="shooting")
    with pytest.raises(ValueError, match="without motions"):
        exact.motion(0)
    (branch,) = branches
    with pytest.raises(IndexError):
        branch.motion(len(branch))
    with pytest.raises(ValueError, match="a row that is not of this branch"):
        branch.motion(exact.events[0])
    for steps in (0, 10**9, 2**40):
        with pytest.raises(ValueError, match=f"found steps={steps}, must be from 1 to"):
            branch.motion(0, steps=steps)
    with pytest.raises(TypeError):
        branch.motion("peak")  # type: ignore[arg-type]
    unbounded = scene.replace({"c.value": 0, "damper.normal_load": 0}).frf()
    rows = [row for each in unbounded for row in each.events if not math.isfinite(row.amplitude)]
    assert rows
    with pytest.raises(ValueError, match="an unbounded response has no history"):
        unbounded[0].motion(rows[0])


def test_row_is_no_number_of_a_period(response: arcslip.Result) -> None:
    with pytest.raises(ValueError, match="found steps=10, must be given to the study"):
        response.motion(0, steps=10)
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
