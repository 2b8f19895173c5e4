"""Optima: the design, its certificate and its tolerance ranges."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest

import arcslip


@pytest.fixture(scope="module")
def scene(examples: Path) -> arcslip.Scene:
    return arcslip.Scene(examples / "al_sayed_2011/scene.json").replace(harmonics=5)


@pytest.fixture(scope="module")
def optimum(scene: arcslip.Scene) -> arcslip.Optimum:
    (found,) = scene.optimize()
    assert isinstance(found, arcslip.Optimum)
    return found


def highest_peak(scene: arcslip.Scene, load: float) -> float:
    peaks = scene.replace({"damper.normal_load": load}).frf(for_each={})[0].events["peak"]
    return float(peaks.amplitude.max())


def test_design_has_units_and_sets_the_scene(scene: arcslip.Scene, optimum: arcslip.Optimum) -> None:
    assert list(optimum.design) == ["damper.normal_load"]
    load = optimum.design["damper.normal_load"]
    assert load.unit == "N" and repr(load).endswith(" N")
    assert scene.replace(optimum.design).parameters["damper.normal_load"] == load
    assert optimum.amplitude.unit == "m"
    assert highest_peak(scene, load) == pytest.approx(optimum.amplitude, rel=1e-8)


def test_neighbours_of_the_design_have_higher_peaks(scene: arcslip.Scene, optimum: arcslip.Optimum) -> None:
    load = optimum.design["damper.normal_load"]
    assert min(highest_peak(scene, load * factor) for factor in (0.99, 1.01)) > optimum.amplitude


def test_ends_of_the_tolerance_ranges_have_their_share_more(scene: arcslip.Scene, optimum: arcslip.Optimum) -> None:
    ranges = optimum.ranges["damper.normal_load"]
    shares = [each.share for each in ranges]
    assert len(ranges) > 1 and shares == sorted(shares)
    for each in ranges:
        assert not each.lower_is_bound and not each.upper_is_bound
        for end in (each.lower, each.upper):
            assert highest_peak(scene, end) == pytest.approx((1 + each.share) * optimum.amplitude, rel=1e-4)


def test_certificate_is_that_of_a_minimum(optimum: arcslip.Optimum) -> None:
    certificate = optimum.certificate
    assert certificate is not None
    assert certificate.stationarity <= 1e-5
    assert np.shape(certificate.curvature) == (1, 1) and certificate.curvature[0, 0] > 0
    assert any(peak.active for peak in certificate.peaks)
    assert optimum.gradient["damper.normal_load"].unit == "m/N"
    assert optimum.gradient["damper.normal_load"] == certificate.gradient["damper.normal_load"]
    assert optimum.feasible
    assert optimum.response.frequency == pytest.approx(certificate.peaks[0].frequency, rel=1e-6)
    assert "feasible" not in optimum.response and "damper.normal_load" not in optimum.response
    with pytest.raises(AttributeError, match="no fact 'stationary'; the nearest is 'stationarity'"):
        certificate.stationary  # noqa: B018


def test_items_are_attributes(optimum: arcslip.Optimum) -> None:
    for name in ("design", "amplitude", "ranges", "gradient", "feasible"):
        assert optimum[name] == getattr(optimum, name)
        assert name in dir(optimum)
    assert optimum.course.amplitude.min() >= optimum.amplitude * (1 - 1e-9)
    assert "damper.normal_load = 3." in repr(optimum) and "complete" in repr(optimum)


def test_optimum_is_pickled_and_loaded_as_one(scene: arcslip.Scene, optimum: arcslip.Optimum, tmp_path: Path) -> None:
    results = scene.optimize()
    results.save(tmp_path / "optimum.json")
    for same in (pickle.loads(pickle.dumps(results))[0], arcslip.load(tmp_path / "optimum.json")[0]):
        assert isinstance(same, arcslip.Optimum)
        assert same.design == optimum.design and same.amplitude == optimum.amplitude
        assert same.ranges == optimum.ranges and same.gradient == optimum.gradient
    assert pickle.loads(pickle.dumps(optimum.certificate)).stationarity == optimum.facts["certificate"]["stationarity"]


def test_search_without_an_optimum_has_no_design(scene: arcslip.Scene) -> None:
    with pytest.warns(arcslip.ArcslipWarning):
        (none,) = scene.replace({"c.value": 0}).optimize(bounds=[[1e-7, 1e-6]])
    assert none.status == "failed"
    assert isinstance(none, arcslip.Optimum)
    assert none.design == {} and np.isnan(none.amplitude) and not none.feasible
    assert none.certificate is None and none.gradient == {} and none.ranges == {}


@pytest.mark.parametrize(("unit", "per"), [("N", "m/N"), ("N s/m", "m/(N s/m)"), ("-", "m"), ("", "")])
def test_unit_of_a_gradient(unit: str, per: str) -> None:
    table = arcslip.Table(["p", "amplitude"], 0, lambda i: np.empty(0), {"p": unit} if unit else {})
    about = dict.fromkeys(["noun", "list", "study", "kind", "status", "doubt"], "") | {"set": {}, "set_units": {}, "stop": {}}
    facts = {"certificate": {"gradient": {"p": 1.0}}}
    assert arcslip.Optimum(about | {"facts": facts}, {"course": table}, {}).gradient["p"].unit == per


def test_facts_are_a_mapping_with_attributes() -> None:
    facts = arcslip.Facts({"inner": {"value": 1.0}, "list": [{"value": 2.0}]})
    assert facts.inner.value == 1 and facts["list"][0].value == 2
    assert facts == {"inner": {"value": 1.0}, "list": facts["list"]}
    assert pickle.loads(pickle.dumps(facts)) == facts
    assert repr(facts.inner) == "<value=1.0>"
