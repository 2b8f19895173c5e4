"""Results as data frames of pandas and data sets of xarray."""

from __future__ import annotations

import sys

import numpy as np
import pandas
import pytest
import xarray

import arcslip

LOADS = {"damper.normal_load": [1.0, 4.0]}


@pytest.fixture
def responses(scene: arcslip.Scene) -> arcslip.Results:
    return scene.frf(for_each=LOADS, coefficients=True)


def test_data_frame_has_the_columns_of_the_table(responses: arcslip.Results) -> None:
    branch = responses[0]
    frame = branch.to_dataframe()
    assert isinstance(frame, pandas.DataFrame)
    assert list(frame.columns) == list(branch.points.columns)
    for name in ("frequency", "amplitude", "elements.damper.theta_star"):
        np.testing.assert_array_equal(frame[name].to_numpy(), branch[name])
    np.testing.assert_array_equal(np.stack(frame["coefficients"]), branch["coefficients"])
    assert frame.attrs["units"] == branch.points.units
    assert frame.index.name == "point"
    frame.loc[0, "amplitude"] = -1.0
    assert branch.amplitude[0] > 0


def test_frame_of_events_has_their_kinds(responses: arcslip.Results) -> None:
    for frame in (responses[1].events.to_dataframe(), responses[1].to_dataframe("events")):
        assert frame["kind"].tolist() == responses[1].events.kind.tolist()
        assert frame["amplitude"].tolist() == responses[1].events.amplitude.tolist()


def test_frame_of_all_results_has_what_is_set(responses: arcslip.Results) -> None:
    frame = responses.to_dataframe()
    assert frame.columns[0] == "damper.normal_load"
    assert frame.index.names == ["combination", "point"]
    assert frame.attrs["units"]["damper.normal_load"] == "N"
    assert frame.attrs["units"]["amplitude"] == "m"
    for i, branch in enumerate(responses):
        own = frame.loc[i]
        np.testing.assert_array_equal(own["amplitude"].to_numpy(), branch.amplitude)
        assert set(own["damper.normal_load"]) == set(branch.set.values())


def test_data_set_is_over_combinations_and_points(responses: arcslip.Results) -> None:
    data = responses.to_xarray()
    assert isinstance(data, xarray.Dataset)
    assert dict(data.sizes)["combination"] == 2
    assert data.sizes["point"] == max(len(branch) for branch in responses)
    assert data["damper.normal_load"].values.tolist() == [1.0, 4.0]
    assert data["damper.normal_load"].attrs["units"] == "N"
    for branch, own in zip(responses, data.amplitude, strict=True):
        np.testing.assert_array_equal(own[: len(branch)], branch.amplitude)
        assert np.isnan(own[len(branch) :]).all()
    for name, unit in responses[0].points.units.items():
        assert data[name].attrs == {"units": unit}
    assert data["coefficients"].dims == ("combination", "point", "coefficients.0")


def test_data_set_of_one_result_is_over_points(responses: arcslip.Results) -> None:
    data = responses[1].to_xarray()
    assert dict(data.sizes) == {"point": len(responses[1]), "coefficients.0": responses[1].coefficients.shape[1]}
    assert data["damper.normal_load"].item() == 4
    np.testing.assert_array_equal(data.frequency, responses[1].frequency)


def test_data_set_of_texts_fills_up_with_empty_ones(scene: arcslip.Scene) -> None:
    responses = scene.frf(for_each={"damper.normal_load": [4.0, 1000.0]})
    counts = [len(branch.events) for branch in responses]
    data = responses.to_xarray("events")
    assert data.sizes["point"] == max(counts)
    assert [(own != "").sum().item() for own in data.kind] == counts


def test_results_without_rows_change_no_type(scene: arcslip.Scene) -> None:
    loads = {"damper.normal_load": [4.0, 1.0]}
    between = float(np.mean([branch.events["peak"].frequency[0] for branch in scene.frf(for_each=loads)]))
    responses = scene.frf(from_=10, to=between, for_each=loads, coefficients=True)
    assert [len(branch.events) for branch in responses] == [0, 1]
    for name, type_ in [("amplitude", "f"), ("after", "i"), ("nonsmooth", "b")]:
        assert responses[0].events[name].dtype.kind == type_
    frame = responses.to_dataframe("events")
    assert len(frame) == 1 and frame.amplitude.dtype == float and frame.after.dtype.kind == "i"
    data = responses.to_xarray("events")
    assert data.amplitude.dtype == float and np.isnan(data.amplitude[0, 0]) and data.amplitude[1, 0] > 0
    assert data.coefficients.ndim == 3
    assert len(responses[0].events.to_dataframe()) == 0
    none = scene.frf(from_=10, to=11).to_xarray("events")
    assert none.sizes["point"] == 0 and none.amplitude.dtype == float


def test_column_of_some_results_is_missing_in_the_others() -> None:
    def result(columns: list[str], count: int) -> arcslip.Result:
        table = arcslip.Table(columns, count, [np.arange(count), np.array([[1.0, 2.0]] * count)].__getitem__)
        about = dict.fromkeys(["noun", "list", "study", "status", "doubt"], "") | {"kind": "k", "facts": {}, "stop": {}}
        return arcslip.Result(about | {"set": {}, "set_units": {}}, {"points": table}, {})

    header = dict.fromkeys(["program", "format", "scene_hash", "title", "frequency_unit"], "") | {"reduction": {}}
    results = arcslip.Results(header, [result(["a"], 3), result(["a", "b"], 2)])
    data = results.to_xarray()
    assert data["b"].shape == (2, 3, 2)
    assert np.isnan(data["b"][0]).all() and np.isnan(data["b"][1, 2]).all()
    assert data["a"].dtype == float and np.isnan(data["a"][1, 2])
    assert results.to_dataframe()["b"].isna().sum() == 3
    whole = results[1].to_xarray()["a"]
    assert whole.dtype.kind == "i" and whole.values.tolist() == [0, 1]
    assert dict(arcslip.Results(header, []).to_xarray().sizes) == {}
    assert arcslip.Results(header, []).to_dataframe().empty


def test_unknown_table_or_study_names_the_nearest(responses: arcslip.Results) -> None:
    for call in (responses.to_dataframe, responses.to_xarray, responses[0].to_dataframe, responses[0].to_xarray):
        with pytest.raises(ValueError, match="found table='event', .* the nearest is 'events'"):
            call("event")
    for call in (responses.to_dataframe, responses.to_xarray):
        with pytest.raises(ValueError, match="found study='respons', .* the nearest is 'response'"):
            call(study="respons")


def test_results_of_several_kinds_need_the_name_of_a_study(scene: arcslip.Scene) -> None:
    results = arcslip.Scene(
        scene.to_dict() | {"studies": [*scene.to_dict()["studies"], {"name": "at", "kind": "point", "frequency": 18.0}]}
    ).run()
    for call in (results.to_dataframe, results.to_xarray):
        with pytest.raises(ValueError, match="found results of the kinds .*'frf', 'point'"):
            call()
        assert len(call(study="at")) > 0


@pytest.mark.parametrize(("package", "extra"), [("pandas", "pandas"), ("xarray", "ensemble")])
def test_package_that_is_missing_names_the_extra_that_installs_it(
    responses: arcslip.Results, monkeypatch: pytest.MonkeyPatch, package: str, extra: str
) -> None:
    calls = {"pandas": [responses.to_dataframe, responses[0].to_dataframe, responses[0].events.to_dataframe]}
    monkeypatch.setitem(sys.modules, package, None)
    for call in calls.get(package, [responses.to_xarray, responses[0].to_xarray]):
        with pytest.raises(ImportError, match=f"{package} is not installed, .*arcslip.{extra}.") as caught:
            call()
        assert caught.value.name == package
